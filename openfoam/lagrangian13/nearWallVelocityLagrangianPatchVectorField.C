// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallVelocityLagrangianPatchVectorField.H"
#include "dictionaryChecks.H"
#include "impactInputs.H"
#include "wallRule.H"

#include "addToRunTimeSelectionTable.H"
#include "LagrangianMesh.H"
#include "LagrangianSchemes.H"
#include "LagrangianSolution.H"
#include "LagrangianSubFields.H"
#include "volFields.H"

#include <cmath>

// Members have other names after Foundation 13, which was the last version with
// this header
#if __has_include("unitConversion.H")
    #define NEARWALL_13_OR_LATER(in13, later) in13
#else
    #define NEARWALL_13_OR_LATER(in13, later) later
#endif

namespace
{

using namespace Foam;

//- The patch of the mesh
inline const polyPatch& polyPatchOf(const LagrangianPatch& p)
{
    return NEARWALL_13_OR_LATER(p.patch(), p.poly());
}


//- The mesh that the parcels are in
inline const polyMesh& polyMeshOf(const LagrangianMesh& m)
{
    return NEARWALL_13_OR_LATER(m.mesh(), m.poly());
}


//- A registered field; null if there is none
template<class FieldType>
const FieldType* findField(const objectRegistry& db, const word& name)
{
    return
        db.foundObject<FieldType>(name)
      ? &db.lookupObject<FieldType>(name)
      : nullptr;
}


//- Stop where the model needs a value that this condition does not pass on
void refuseExtraInputs(const dictionary& dict, const nearwall::model& model)
{
    const std::vector<std::string> names(model.extra_inputs());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        if (!std::isnan(model.extra_input_default(std::uint32_t(i)))) continue;

        FatalIOErrorInFunction(dict)
            << "The model declares the input '" << names[i].c_str()
            << "' without a default, and nearWallVelocity passes on none." << nl
            << "    Give the input a default in the model."
            << exit(FatalIOError);
    }
}

} // End anonymous namespace


// * * * * * * * * * * * * * * * Private Classes * * * * * * * * * * * * * * //

struct Foam::nearWallVelocityLagrangianPatchVectorField::settings
{
    const dictionary dict;
    const nearWall::wallModelPtr model;
    const bool removesStuck;
    const std::uint64_t seed;
    const word gasVelocity;

    //- Temperature of parcels without one [K]
    const scalar particleTemperature;

    //- The field of its temperature is looked up at the first impact: tools
    //  such as decomposePar have no fields
    nearWall::wallRule wall;

    settings(const dictionary& given, const polyPatch& pp, const Time& time)
    :
        dict(checkedKeys(given)),
        model(nearWall::readWallModel(dict, time)),
        removesStuck(readRemovesStuck(dict)),
        seed(std::uint64_t(nearWall::readOr<label>(dict, "seed", 1))),
        gasVelocity(nearWall::readOr<word>(dict, "U", word("U"))),
        particleTemperature
        (
            nearWall::readChecked<scalar>
            (
                dict, "particleTemperature", 293.15,
                [](scalar T) { return T > 0; }, "above 0, in K"
            )
        )
    {
        wall.readWall(dict, pp, *model, "the wall model");
        wall.readTemperature(dict, pp);
        refuseExtraInputs(dict, *model);
    }

    static const dictionary& checkedKeys(const dictionary& given)
    {
        nearWall::refuseUnknownKeys
        (
            given,
            wordList
            ({
                "type", "patchType", "model", "wall", "wallTemperature",
                "field", "U", "stuck", "seed", "particleTemperature"
            }),
            "nearWallVelocity"
        );
        return given;
    }

    static bool readRemovesStuck(const dictionary& dict)
    {
        static const nearWall::Enum<bool> names
        ({
            {false, "react"},
            {true, "remove"}
        });
        const word name(nearWall::readOr<word>(dict, "stuck", word("react")));
        return nearWall::checkedChoice(dict, "stuck", name, names);
    }
};


struct Foam::nearWallVelocityLagrangianPatchVectorField::fieldInputs
{
    const settings& given;
    nearWall::wallRule wall;
    const LagrangianMesh& cloud;
    const polyMesh& mesh;
    const polyPatch& pp;

    //- Fields of the cloud; null where it has none, which stops for d
    const LagrangianScalarDynamicField* const d;
    const LagrangianScalarDynamicField* const rho;
    const LagrangianScalarDynamicField* const T;

    //- Velocity of the gas; null where there is none
    const volVectorField* const gasU;

    fieldInputs(const settings& s, const LagrangianPatch& patch)
    :
        given(s),
        wall(s.wall),
        cloud(patch.boundaryMesh().mesh()),
        mesh(polyMeshOf(cloud)),
        pp(polyPatchOf(patch)),
        d(findField<LagrangianScalarDynamicField>(cloud, "d")),
        rho(findField<LagrangianScalarDynamicField>(cloud, "rho")),
        T(findField<LagrangianScalarDynamicField>(cloud, "T")),
        gasU(findField<volVectorField>(mesh, s.gasVelocity))
    {
        wall.findField(given.dict, pp, mesh);
        if (!d)
        {
            FatalIOErrorInFunction(given.dict)
                << "Patch '" << pp.name() << "': the cloud '" << cloud.name()
                << "' has no diameter 'd', which the wall model needs." << nl
                << "    Use a cloud of spherical particles, or another velocity"
                << " condition." << exit(FatalIOError);
        }
    }

    //- A parcel as setInputs() takes it
    struct parcel
    {
        const fieldInputs& in;
        const label i;

        scalar d() const { return (*in.d)[i]; }

        scalar rho() const { return in.rho ? (*in.rho)[i] : 0; }

        scalar T() const
        {
            return in.T ? (*in.T)[i] : in.given.particleTemperature;
        }
    };

    //- The impact of a parcel
    nw_impact impactOf
    (
        const label parceli,
        const nearWall::relativeVelocity& v,
        const vector& U
    ) const
    {
        nw_impact impact = nearwall::make_impact();
        impact.wall = wall.wall;
        impact.seed = given.seed;
        impact.key =
            nearWall::keyOf(mesh, cloud.position(parceli), U, (*d)[parceli]);
        const label facei = cloud.facei()[parceli] - pp.start();
        const nearWall::impactSurroundings at
        {
            given.particleTemperature,
            impact.conversion,
            wall.temperatureAt(mesh, pp.index(), facei),
            gasU ? (*gasU)[cloud.celli()[parceli]] : v.wall
        };
        nearWall::setInputs(impact, parcel{*this, parceli}, v, at);
        return impact;
    }
};


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::nearWallVelocityLagrangianPatchVectorField::
nearWallVelocityLagrangianPatchVectorField
(
    const LagrangianPatch& p,
    const regIOobject& iIo,
    const dictionary& dict
)
:
    cloudVelocityLagrangianPatchVectorField(p, iIo, dict),
    settings_
    (
        std::make_shared<const settings>
        (
            dict, polyPatchOf(p), p.boundaryMesh().mesh().time()
        )
    )
{
    Info<< "nearWallVelocity: nearwall " << nw_version() << ", patch "
        << p.name() << ", "
        << nearWall::wallModelOrigin(dict, p.boundaryMesh().mesh().time())
           .c_str()
        << endl;
}


Foam::nearWallVelocityLagrangianPatchVectorField::
nearWallVelocityLagrangianPatchVectorField
(
    const nearWallVelocityLagrangianPatchVectorField& ptf
)
:
    cloudVelocityLagrangianPatchVectorField(ptf),
    settings_(ptf.settings_)
{}


Foam::nearWallVelocityLagrangianPatchVectorField::
nearWallVelocityLagrangianPatchVectorField
(
    const nearWallVelocityLagrangianPatchVectorField& ptf,
    const regIOobject& iIo
)
:
    cloudVelocityLagrangianPatchVectorField(ptf, iIo),
    settings_(ptf.settings_)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::LagrangianState
Foam::nearWallVelocityLagrangianPatchVectorField::stuckState() const
{
    return static_cast<LagrangianState>
    (
        static_cast<label>(LagrangianState::onPatchZero)
      + polyPatchOf(patch()).index()
    );
}


void
Foam::nearWallVelocityLagrangianPatchVectorField::checkStuckCanStay() const
{
    const LagrangianMesh& cloud = patch().boundaryMesh().mesh();
    const word tracking
    (
        nearWall::read<word>
        (
            NEARWALL_13_OR_LATER(cloud.schemes().schemesDict(), cloud.schemes()),
            "tracking"
        )
    );
    const scalar longest = cloud.solution().lookup<scalar>
    (
        "maxTimeStepFraction"
    );
    const bool isMoving = polyMeshOf(cloud).moving();
    if (!isMoving && longest >= 1 && tracking == "linear") return;

    FatalIOErrorInFunction(settings_->dict)
        << "Patch '" << patch().name() << "': with 'stuck react' a stuck parcel"
        << " of the cloud '" << cloud.name()
        << "' would be decided again within a step, because "
        << (
               isMoving ? "the mesh moves"
             : longest < 1 ? "maxTimeStepFraction is below 1"
             : "tracking is not linear"
           )
        << "." << nl << "    "
        << (
               isMoving ? "Choose 'stuck remove'."
             : longest < 1
             ? "Set maxTimeStepFraction 1; or choose 'stuck remove'."
             : "Set tracking linear; or choose 'stuck remove'."
           )
        << exit(FatalIOError);
}


void Foam::nearWallVelocityLagrangianPatchVectorField::warnUnusable
(
    const string& reason
)
{
    const label step = patch().boundaryMesh().mesh().time().timeIndex();
    if (warned_ == step) return;
    warned_ = step;

    Pout<< "nearWallVelocity, warning: patch " << patch().name()
        << ", an impact of this step could not be decided (" << reason.c_str()
        << "); the parcel rebounds without loss, or is removed if its velocity"
        << " is not a number" << endl;
}


Foam::LagrangianState
Foam::nearWallVelocityLagrangianPatchVectorField::decide
(
    const fieldInputs& inputs,
    const label parceli,
    const vector& normal,
    const vector& wall,
    vector& U
)
{
    const nearWall::relativeVelocity v(U, normal, wall);

    // No impact: the gas has turned the parcel around
    if (v.vn <= 0) return LagrangianState::inCell;

    const nw_impact impact(inputs.impactOf(parceli, v, U));
    nw_outcome outcome;
    nw_outcome_init(&outcome);

    const nearwall::model& model = *settings_->model;
    if (model.resolve(impact, outcome) != NW_OK)
    {
        warnUnusable(model.explain(impact));
        if (!std::isfinite(v.vn + v.vt)) return LagrangianState::toBeRemoved;
        U = v.rebound(U, 1, 0);
        return LagrangianState::inCell;
    }
    if (outcome.stuck)
    {
        U = wall;
        if (settings_->removesStuck) return LagrangianState::toBeRemoved;
        checkStuckCanStay();
        return stuckState();
    }
    U = v.rebound(U, outcome.e_n, 1 - outcome.e_t);
    return LagrangianState::inCell;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::nearWallVelocityLagrangianPatchVectorField::evaluate
(
    PstreamBuffers& pBufs,
    const LagrangianInternalDynamicField<scalar>& fraction
)
{
    cloudVelocityLagrangianPatchVectorField::evaluate(pBufs, fraction);

    const LagrangianSubMesh& parcels = patch().mesh();
    if (parcels.empty()) return;

    const fieldInputs inputs(*settings_, patch());
    const vectorField normals(parcels.nf<vectorField>(fraction));
    const vectorField wall(parcels.Uf<vectorField>(fraction));
    vectorField U(primitiveSubField());
    List<LagrangianState>& states =
        inputs.mesh.lookupObjectRef<LagrangianMesh>(inputs.cloud.name())
       .states();

    forAll(U, i)
    {
        const label parceli = parcels.start() + i;

        // At an impact the state is that of state(). At the start of a step
        // the cloud evaluates only its stuck parcels, with theirs.
        if (states[parceli] == stuckState())
        {
            U[i] = wall[i];
        }
        else
        {
            states[parceli] =
                decide(inputs, parceli, normals[i], wall[i], U[i]);
        }
    }

    LagrangianPatchVectorField::operator=(U);
}


Foam::LagrangianState
Foam::nearWallVelocityLagrangianPatchVectorField::state() const
{
    return LagrangianState::inCell;
}


void Foam::nearWallVelocityLagrangianPatchVectorField::write(Ostream& os) const
{
    settings_->dict.write(os, false);
}


// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
    makeLagrangianPatchTypeField
    (
        LagrangianPatchVectorField,
        nearWallVelocityLagrangianPatchVectorField
    );
}
