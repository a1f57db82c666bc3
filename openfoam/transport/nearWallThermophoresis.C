// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallThermophoresis.H"
#include "buildCheck.H"
#include "dictionaryChecks.H"
#include "linearGradient.H"
#include "nearwall.h"

template<class CloudType>
Foam::nearWallThermophoresis<CloudType>::nearWallThermophoresis
(
    CloudType& owner,
    const fvMesh& mesh,
    const dictionary& dict
)
:
    ParticleForce<CloudType>(owner, mesh, dict, typeName, true),
    TName_
    (
        nearWall::readOr<word>
        (
            dict, "T", IOobject::groupName("T", owner.U().group())
        )
    ),
    conductivity_(nearWall::read<scalar>(dict, "conductivity")),
    gasConductivity_(nearWall::readOr<scalar>(dict, "gasConductivity", 0)),
    pressure_(nearWall::readOr<scalar>(dict, "pressure", 0))
{
    nearWall::checkBuild();
    nearWall::refuseUnknownKeys
    (
        dict,
        wordList({"conductivity", "gasConductivity", "pressure", "T"}),
        typeName
    );
    if (!(conductivity_ > 0 && gasConductivity_ >= 0 && pressure_ >= 0))
    {
        FatalIOErrorInFunction(dict)
            << "Conductivities and pressure must be greater than zero."
            << exit(FatalIOError);
    }
}


template<class CloudType>
const Foam::volScalarField&
Foam::nearWallThermophoresis<CloudType>::field(const word& name) const
{
    const fvMesh& mesh = this->mesh();
    if (!mesh.template foundObject<volScalarField>(name))
    {
        FatalErrorInFunction
            << "The solver has no field " << name << ": thermophoresis needs"
            << " the temperature of the gas (key 'T') and its pressure (key"
            << " 'pressure', a number)." << exit(FatalError);
    }
    return mesh.template lookupObject<volScalarField>(name);
}


template<class CloudType>
const Foam::volScalarField*
Foam::nearWallThermophoresis<CloudType>::pressureField() const
{
    if (pressure_ > 0) return nullptr;
    const volScalarField& p = field("p");
    if (p.dimensions() != dimPressure)
    {
        FatalErrorInFunction
            << "The field p of this solver is no pressure in Pa: give the key"
            << " 'pressure' [Pa]." << exit(FatalError);
    }
    return &p;
}


template<class CloudType>
Foam::scalarField
Foam::nearWallThermophoresis<CloudType>::gasConductivity() const
{
    const fvMesh& mesh = this->mesh();
    if (gasConductivity_ > 0) return scalarField(mesh.nCells(), gasConductivity_);

    const word name
    (
        IOobject::groupName(nearWall::thermoName(), this->owner().U().group())
    );
    if (!mesh.template foundObject<basicThermo>(name))
    {
        FatalErrorInFunction
            << "The solver has no thermophysical model " << name
            << ": give the key 'gasConductivity' [W/m/K]." << exit(FatalError);
    }
    const tmp<volScalarField> kappa
    (
        mesh.template lookupObject<basicThermo>(name).kappa()
    );
    return scalarField(kappa());
}


template<class CloudType>
void Foam::nearWallThermophoresis<CloudType>::cacheFields(const bool store)
{
    if (!store) return;
    const volScalarField& T = field(TName_);
    gas_ = std::make_shared<const gasFields>
    (
        gasFields
        {
            T, pressureField(), nearWall::linearGradient(T), gasConductivity()
        }
    );
}


template<class CloudType>
Foam::forceSuSp Foam::nearWallThermophoresis<CloudType>::calcCoupled
(
    const parcelType& p,
    const typename parcelType::trackingData& td,
    const scalar,
    const scalar,
    const scalar,
    const scalar muc
) const
{
    const fvMesh& mesh = this->mesh();
    const label celli = p.cell();
    const vector& gradient = gas_->gradient[celli];
    const scalar T =
        gas_->T[celli]
      + (gradient & (nearWall::positionOf(p, mesh) - mesh.C()[celli]));
    const scalar pressure = gas_->p ? (*gas_->p)[celli] : pressure_;

    // Of an ideal gas, with the definition that goes with viscosity
    const scalar path =
        muc*Foam::sqrt(constant::mathematical::pi/(2*td.rhoc()*pressure));
    double overGradient = 0;
    const nw_status status = nw_thermophoresis
    (
        T, td.rhoc(), muc, gas_->conductivity[celli], path, p.d(),
        conductivity_, &overGradient
    );
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "Cloud " << this->owner().name() << ": temperature " << T
            << " K, density " << td.rhoc() << ", viscosity " << muc
            << ", pressure " << pressure << " or diameter " << p.d()
            << " is not greater than zero." << exit(FatalError);
    }
    return forceSuSp(overGradient*gradient, 0);
}
