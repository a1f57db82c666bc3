// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallMemory.H"
#include "dictionaryChecks.H"
#include "impactKey.H"
#include "mathematicalConstants.H"
#include "nearWallDepositTemperatureFvPatchScalarField.H"
#include "surfaceFields.H"
#include "versionCompat.H"
#include "wallHitFields.H"

namespace Foam { namespace nearWall {
    defineTypeNameAndDebug(wallMemory, 0);
}}

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- Rise of a surface's temperature in a step above which the log warns [K]
const scalar largestSoundRise = 5;


//- Names of the terms, in their order: keys of a restart and columns
const wordList termNames
({
    "initial_kg", "arrived_kg", "drained_kg", "from_other_patches_kg",
    "shed_kg", "resuspended_kg"
});


//- A film needs the viscosity of the melt on one of the walls
void requireViscosity
(
    const dictionary& dict,
    const nearwall::model& model,
    const List<patchRule>& rules,
    const labelList& patches
)
{
    // Above the range of any table
    const scalar hot = 1e4;
    forAll(patches, i)
    {
        nw_deposit melt(nearwall::make_deposit(rules[patches[i]].wall));
        melt.molten = 1;
        scalar speed = 0;
        model.film_velocity(melt, hot, 1, speed);
        if (speed > 0) return;
    }
    FatalIOErrorInFunction(dict)
        << "Key 'film' is yes, but the model knows no viscosity of the melt on"
        << " the walls." << nl
        << "    Give the model [capture] model = \"viscosity\" and the"
        << " particle, or the slag of a wall, a composition or a viscosity;"
        << nl
        << "    or give it [capture] model = \"droplet\"."
        << exit(FatalIOError);
}


//- What a row has the mean and the largest value of
enum faceQuantity
{
    moltenOf, powderOf, layerOf, coverageOf, wallTOf, heatFluxOf, nQuantities
};

const char* const quantityNames[] =
{
    "molten", "powder", "layer_thickness", "coverage", "wall_temperature",
    "heat_flux"
};

const char* const quantityUnits[] =
{
    "_kg_m2", "_kg_m2", "_m", "", "_K", "_W_m2"
};


struct largerOf
{
    void operator()(scalar& x, const scalar y) const
    {
        x = max(x, y);
    }
};


//- Sums and largest values over the faces of all patches and all ranks, in
//  one exchange each: a reduction for each number would cost the latency of
//  the network some twenty times a patch
struct faceSums
{
    //- For each patch: area, mass of converted deposit, each quantity by area
    static const label perPatch = 2 + nQuantities;

    List<scalar> sums;
    List<scalar> largest;

    //- `rise` is the largest one on this rank, kept behind the quantities
    faceSums(const label nPatches, const scalar rise)
    :
        sums(nPatches*perPatch, Zero),
        largest(nPatches*nQuantities + 1, Zero)
    {
        largest.last() = rise;
    }

    //- Known on the master
    scalar rise() const { return largest.last(); }

    void add
    (
        const label i,
        const scalarField& area,
        const scalarField& conversion,
        const std::vector<const scalarField*>& values
    )
    {
        scalar* const sum = &sums[i*perPatch];
        sum[0] = Foam::sum(area);
        sum[1] = Foam::sum
        (
            (*values[moltenOf] + *values[powderOf])*area*conversion
        );
        for (label q = 0; q < nQuantities; ++q)
        {
            sum[2 + q] = Foam::sum(*values[q]*area);
            scalar& most = largest[i*nQuantities + q];
            for (const scalar x : *values[q]) most = max(most, x);
        }
    }

    void overRanks()
    {
        sumOverRanks(sums);
        Pstream::listCombineGather(largest, largerOf());
    }

    scalar converted(const label i) const { return sums[i*perPatch + 1]; }

    scalar integral(const label i, const label q) const
    {
        return sums[i*perPatch + 2 + q];
    }

    scalar mean(const label i, const label q) const
    {
        return integral(i, q)/max(sums[i*perPatch], VSMALL);
    }

    //- Known on the master, which writes
    scalar maximum(const label i, const label q) const
    {
        return largest[i*nQuantities + q];
    }
};

} // End anonymous namespace


Foam::nearWall::wallMemory::wallMemory
(
    const dictionary& dict,
    const fvMesh& mesh,
    const word& cloudName,
    const List<patchRule>& rules,
    const wallModelPtr& model,
    const vector& gravity,
    const wallShear& shear,
    const dictionary& saved,
    const fileName& folder
)
:
    regIOobject
    (
        IOobject
        (
            cloudName + ":memory",
            mesh.time().constant(),
            mesh,
            IOobject::NO_READ,
            IOobject::NO_WRITE
        )
    ),
    mesh_(mesh),
    rules_(rules),
    model_(model),
    voidage_
    (
        readChecked<scalar>
        (
            dict, "voidage", 0.5, [](scalar v) { return v >= 0 && v < 1; },
            "from 0 to below 1"
        )
    ),
    acceleration_
    (
        readChecked<scalar>
        (
            dict, "acceleration", 1, [](scalar a) { return a >= 1; },
            "1 or more"
        )
    ),
    gravity_(gravity),
    shear_(shear),
    molten_(readWallField(mesh, cloudName + ":moltenMass", dimMass/dimArea)),
    powder_(readWallField(mesh, cloudName + ":powderMass", dimMass/dimArea)),
    layer_(readWallField(mesh, cloudName + ":layerThickness", dimLength)),
    cover_(readWallField(mesh, cloudName + ":coverArea", dimless)),
    coverage_(readWallField(mesh, cloudName + ":coverage", dimless)),
    conversion_(readWallField(mesh, cloudName + ":depositConversion", dimless)),
    temperature_
    (
        readWallField(mesh, cloudName + ":wallTemperature", dimTemperature)
    ),
    resistance_(rules.size()),
    captured_(rules.size())
{
    refuseUnknownKeys(dict, wordList({"voidage", "film", "acceleration"}), "memory");

    forAll(rules, patchi)
    {
        if (rules[patchi].type == patchRule::interact) patches_.append(patchi);
    }
    setCooled(cloudName);
    for (const label patchi : patches_)
    {
        if (resuspended_ || !canResuspend(patchi)) continue;

        resuspended_.reset
        (
            new volScalarField
            (
                readWallField(mesh, cloudName + ":resuspendedShare", dimless)
            )
        );
    }
    setInitial();

    added_.resize(patches_.size());
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const polyPatch& pp = patchesOf(mesh)[patchi];
        const word& name = pp.name();
        captured_[patchi].setSize(pp.size(), nearwall::make_deposit_source());
        sums_.append
        (
            runningTotals(termNames, saved.subOrEmptyDict(name), name)
        );
        if (!saved.found(name))
        {
            const scalarField& area = mesh.magSf().boundaryField()[patchi];
            const scalarField& molten = molten_.boundaryField()[patchi];
            const scalarField& powder = powder_.boundaryField()[patchi];
            addToSum(i, initial, sum((molten + powder)*area));
        }
        tables_.emplace_back(folder/(name + ".wall.dat"));
        setCoverage(patchi);
    }

    if (readOr<Switch>(dict, "film", Switch(false)))
    {
        requireViscosity(dict, *model, rules, patches_);
        film_.reset(new wallFilm(mesh, patches_, model, gravity));
    }
    Info<< "    nearWallInteraction, memory of the walls: voidage " << voidage_
        << ", film " << (film_ ? "yes" : "no") << nl;
    if (acceleration_ > 1)
    {
        Info<< "        acceleration " << acceleration_ << ": 1 s of the flow is "
            << acceleration_ << " s of the deposit" << nl;
    }
}


const Foam::nearWall::wallMemory* Foam::nearWall::wallMemory::find
(
    const objectRegistry& mesh,
    const word& cloudName,
    const label patchi
)
{
    const wallMemory* found = nullptr;
    for (const word& name : mesh.lookupClass<wallMemory>().toc())
    {
        const wallMemory& one = mesh.lookupObject<wallMemory>(name);
        const bool named =
            cloudName.empty() || one.name() == cloudName + ":memory";
        if (!named || one.rules_[patchi].type != patchRule::interact) continue;
        if (found)
        {
            FatalErrorInFunction
                << "Two clouds have a deposit on patch '"
                << patchesOf(one.mesh_)[patchi].name() << "': " << found->name()
                << " and " << one.name() << "." << nl
                << "    Name one of them in the temperature's condition,"
                << " cloud ...;" << exit(FatalError);
        }
        found = &one;
    }
    return found;
}


const Foam::nearWallDepositTemperatureFvPatchScalarField*
Foam::nearWall::wallMemory::condition(const label patchi) const
{
    const patchRule& rule = rules_[patchi];
    if (!mesh_.foundObject<volScalarField>(rule.temperatureField)) return nullptr;

    return dynamic_cast<const nearWallDepositTemperatureFvPatchScalarField*>
    (
        &rule.temperatureOn(mesh_, patchi)
    );
}


void Foam::nearWall::wallMemory::setCooled(const word& cloudName)
{
    bool any = false;
    for (const label patchi : patches_)
    {
        if (cooled(patchi)) any = true;
        else if (condition(patchi))
        {
            Info<< "    nearWallInteraction, warning: patch "
                << patchesOf(mesh_)[patchi].name() << " has the temperature"
                << " condition nearWallDepositTemperature, but impacts meet the"
                << " number of wallTemperature; write wallTemperature field;"
                << nl;
        }
    }
    if (!any) return;

    closed_.reset
    (
        new volScalarField
        (
            readWallField(mesh_, cloudName + ":closedVoids", dimLength)
        )
    );
    heatFlux_.reset
    (
        new volScalarField
        (
            readWallField
            (
                mesh_, cloudName + ":wallHeatFlux", dimPower/dimArea
            )
        )
    );
    for (const label patchi : patches_)
    {
        if (!cooled(patchi)) continue;

        resistance_[patchi].setSize(patchesOf(mesh_)[patchi].size(), -1);
        nw_deposit all(nearwall::make_deposit(rules_[patchi].wall));
        all.molten = all.powder = all.cover = 1;
        all.solid = 1e-3;
        nw_wall_cooling cooling(nearwall::make_wall_cooling());
        cooling.coolant_temperature = cooling.gas_temperature = 1000;
        cooling.wall_resistance = cooling.gas_coefficient = 1;
        heatUnder(all, patchi, cooling);
    }
}


nw_wall_heat Foam::nearWall::wallMemory::heatUnder
(
    const nw_deposit& d,
    const label patchi,
    const nw_wall_cooling& cooling
) const
{
    nw_wall_heat found(nearwall::make_wall_heat());
    const nw_status status = model_->heat(d, voidage_, cooling, found);
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "The temperature under the deposit on patch '"
            << patchesOf(mesh_)[patchi].name() << "' cannot be computed (gas or"
            << " surface " << cooling.gas_temperature << " K, coolant "
            << cooling.coolant_temperature << " K): " << nw_status_text(status)
            << exit(FatalError);
    }
    return found;
}


nw_deposit Foam::nearWall::wallMemory::deposit
(
    const label patchi,
    const label facei
) const
{
    nw_deposit d(nearwall::make_deposit(rules_[patchi].wall));
    d.molten = molten_.boundaryField()[patchi][facei];
    d.powder = powder_.boundaryField()[patchi][facei];
    if (closed_) d.closed = closed_->boundaryField()[patchi][facei];
    d.solid =
        (layer_.boundaryField()[patchi][facei] + d.closed)*(1 - voidage_);
    d.cover = cover_.boundaryField()[patchi][facei];
    d.conversion = conversion_.boundaryField()[patchi][facei];
    if (resuspended_) d.resuspended = resuspended_->boundaryField()[patchi][facei];
    return d;
}


void Foam::nearWall::wallMemory::setDeposit
(
    const label patchi,
    const label facei,
    const nw_deposit& d
)
{
    molten_.boundaryFieldRef()[patchi][facei] = d.molten;
    powder_.boundaryFieldRef()[patchi][facei] = d.powder;
    layer_.boundaryFieldRef()[patchi][facei] =
        d.solid/(1 - voidage_) - d.closed;
    if (closed_) closed_->boundaryFieldRef()[patchi][facei] = d.closed;
    cover_.boundaryFieldRef()[patchi][facei] = d.cover;
    conversion_.boundaryFieldRef()[patchi][facei] = d.conversion;
    if (resuspended_)
    {
        resuspended_->boundaryFieldRef()[patchi][facei] = d.resuspended;
    }
}


void Foam::nearWall::wallMemory::setInitial()
{
    std::vector<volScalarField*> fields
    ({
        &molten_, &powder_, &layer_, &cover_, &conversion_
    });
    if (resuspended_) fields.push_back(resuspended_.get());
    bool given = false;
    for (volScalarField* const field : fields)
    {
        given = field->headerOk() || given;
    }
    if (!onAnyRank(given))
    {
        for (const label patchi : patches_)
        {
            const std::uint32_t wall = rules_[patchi].wall;
            const nw_deposit d(model_->initial_deposit(wall, voidage_));
            forAll(patchesOf(mesh_)[patchi], facei)
            {
                setDeposit(patchi, facei, d);
            }
        }
    }

    for (const volScalarField* const field : fields)
    {
        const bool isShare =
            field == &conversion_ || field == resuspended_.get();
        const scalar most = isShare ? 1 : GREAT;
        for (const label patchi : patches_)
        {
            for (const scalar x : field->boundaryField()[patchi])
            {
                if (x >= 0 && x <= most) continue;

                FatalErrorInFunction
                    << "Field " << field->name() << " of time "
                    << timeName(mesh_.time()) << " is " << x << " on patch '"
                    << patchesOf(mesh_)[patchi].name()
                    << "'; it must be from 0 to " << most << "."
                    << exit(FatalError);
            }
        }
    }
}


void Foam::nearWall::wallMemory::addToSum
(
    const label i,
    const term t,
    const scalar mass
)
{
    const scalar added = added_[i][t].add(mass);
    sums_[i].add(t, added - sums_[i].added()[t]);
}


void Foam::nearWall::wallMemory::applyDeposit(impactEvent& e) const
{
    // The status needs no check: it refuses only a temperature for which the
    // impact will be refused as well
    model_->apply_deposit(deposit(e.patch, e.face), voidage_, e.impact);
}


nw_status Foam::nearWall::wallMemory::addToSource
(
    const impactEvent& e,
    nw_deposit_source& sum
) const
{
    const scalar area = mesh_.magSf().boundaryField()[e.patch][e.face];
    const scalar volume =
        e.particles*constant::mathematical::pi/6*pow3(e.impact.d);
    return e.model->add_captured
    (
        e.impact, acceleration_*e.mass/area, e.mass/volume, sum
    );
}


bool Foam::nearWall::wallMemory::joinsFilm(const impactEvent& e) const
{
    if (!film_ || !e.stuckByModel() || e.mass <= 0) return false;

    nw_deposit_source alone(nearwall::make_deposit_source());
    return addToSource(e, alone) == NW_OK && alone.molten > 0;
}


void Foam::nearWall::wallMemory::addCaptured(const impactEvent& e)
{
    if (e.mass <= 0) return;

    const nw_status status = addToSource(e, captured_[e.patch][e.face]);
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "A parcel that stuck on patch '"
            << patchesOf(mesh_)[e.patch].name() << "' (" << e.mass
            << " kg, diameter " << e.impact.d
            << " m) cannot be added to the deposit: "
            << nw_status_text(status) << exit(FatalError);
    }
}


void Foam::nearWall::wallMemory::require
(
    const nw_status status,
    const label patchi,
    const char* const what
) const
{
    if (status == NW_OK) return;

    FatalErrorInFunction
        << "The deposit on patch '" << patchesOf(mesh_)[patchi].name()
        << "' cannot " << what << ": " << nw_status_text(status)
        << exit(FatalError);
}


void Foam::nearWall::wallMemory::addSources(const label i)
{
    const label patchi = patches_[i];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    List<nw_deposit_source>& faces = captured_[patchi];
    scalar mass = 0;
    forAll(faces, facei)
    {
        if (!faces[facei].count) continue;

        nw_deposit d(deposit(patchi, facei));
        const nw_status status = nearwall::add(faces[facei], d);
        require(status, patchi, "grow");
        setDeposit(patchi, facei, d);
        mass += (faces[facei].molten + faces[facei].powder)*area[facei];
        nw_deposit_source_init(&faces[facei]);
    }
    addToSum(i, arrived, mass);
}


void Foam::nearWall::wallMemory::setTemperature(const label patchi)
{
    const patchRule& rule = rules_[patchi];
    scalarField& T = temperature_.boundaryFieldRef()[patchi];
    if (rule.temperatureFromField) T = rule.temperatureOn(mesh_, patchi);
    else T = rule.temperature;
}


void Foam::nearWall::wallMemory::setCoverage(const label patchi)
{
    const scalarField& cover = cover_.boundaryField()[patchi];
    scalarField& coverage = coverage_.boundaryFieldRef()[patchi];
    forAll(cover, facei)
    {
        coverage[facei] = -std::expm1(-cover[facei]);
    }
}


void Foam::nearWall::wallMemory::flow(const scalar duration)
{
    List<filmPatch> film(patches_.size());
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        film[i].wall = rules_[patchi].wall;
        film[i].area = mesh_.magSf().boundaryField()[patchi];
        film[i].T = temperature_.boundaryField()[patchi];
        film[i].heatFlux =
            heatFlux_
          ? scalarField(heatFlux_->boundaryField()[patchi])
          : scalarField(film[i].T.size(), Zero);
        film[i].molten = molten_.boundaryField()[patchi];
        film[i].solid = powder_.boundaryField()[patchi];
        film[i].conversion = conversion_.boundaryField()[patchi];
    }
    film_->flow(film, duration);
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        scalarField& molten = molten_.boundaryFieldRef()[patchi];
        molten = film[i].molten;
        scalarField& conversion = conversion_.boundaryFieldRef()[patchi];
        conversion = film[i].conversion;
        addToSum(i, drained, film[i].drained);
        addToSum(i, fromOthers, film[i].fromOthers);
    }
}


void Foam::nearWall::wallMemory::age
(
    const label patchi,
    const scalar duration
)
{
    const nearWallDepositTemperatureFvPatchScalarField* const T = cooled(patchi);
    if (!T) return;

    const scalarField gas(T->voidConductivity());
    scalarField& flux = heatFlux_->boundaryFieldRef()[patchi];
    scalarField& resistance = resistance_[patchi];
    forAll(flux, facei)
    {
        nw_deposit d(deposit(patchi, facei));
        const nw_wall_heat found
        (
            heatUnder(d, patchi, T->cooling(facei, gas[facei]))
        );
        flux[facei] = found.heat_flux;
        const scalar rise =
            flux[facei]*(found.deposit_resistance - resistance[facei]);
        if (resistance[facei] >= 0) largestRise_ = max(largestRise_, mag(rise));
        resistance[facei] = found.deposit_resistance;
        if (d.powder <= 0) continue;

        require(model_->age(voidage_, found, duration, d), patchi, "age");
        setDeposit(patchi, facei, d);
    }
}


bool Foam::nearWall::wallMemory::canResuspend(const label patchi) const
{
    // Grains of 10 um in a storm
    nw_deposit loose(nearwall::make_deposit(rules_[patchi].wall));
    loose.powder = 1e-3;
    loose.solid = 1e-6;
    loose.cover = 0.15;
    const nw_status status =
        model_->resuspend(voidage_, 1, 1e-5, 1000, 1, loose);
    return status == NW_OK && loose.powder < 1e-3;
}


void Foam::nearWall::wallMemory::resuspendFrom
(
    const label i,
    const scalar duration
)
{
    const label patchi = patches_[i];
    if (!canResuspend(patchi)) return;

    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    const scalarField& rho = shear_.density(patchi);
    const scalarField nu(shear_.kinematicViscosity(patchi));
    const scalarField uTau(sqrt(mag(shear_.stress(patchi))/rho));
    scalar mass = 0;
    forAll(area, facei)
    {
        nw_deposit d(deposit(patchi, facei));
        const scalar before = d.powder;
        if (before <= 0) continue;

        const nw_status status = model_->resuspend
        (
            voidage_, rho[facei], nu[facei], uTau[facei], duration, d
        );
        require(status, patchi, "be carried away by the gas");
        mass += (before - d.powder)*area[facei];
        setDeposit(patchi, facei, d);
    }
    addToSum(i, resuspended, mass);
}


bool Foam::nearWall::wallMemory::canShed(const label patchi) const
{
    nw_deposit heavy(nearwall::make_deposit(rules_[patchi].wall));
    heavy.molten = 1;
    const scalar huge = 1e100;
    return
        model_->shed(huge, huge, 0, 0, 0, heavy) == NW_OK && heavy.molten == 0;
}


void Foam::nearWall::wallMemory::shedFrom(const label i)
{
    const label patchi = patches_[i];
    if (!canShed(patchi)) return;

    const vectorField& Sf = mesh_.Sf().boundaryField()[patchi];
    const vectorField& centres = mesh_.Cf().boundaryField()[patchi];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    const vectorField stress(shear_.stress(patchi));
    scalar mass = 0;
    forAll(centres, facei)
    {
        nw_deposit d(deposit(patchi, facei));
        const scalar before = d.molten + d.powder;
        if (before <= 0) continue;

        // Into the gas
        const vector n(-Sf[facei]/area[facei]);
        const scalar outward = gravity_ & n;
        const vector slope(gravity_ - outward*n);
        const scalar along = mag(slope);
        const vector down(slope/max(along, VSMALL));
        const scalar shearDown = stress[facei] & down;
        const scalar shearAcross = mag(stress[facei] - shearDown*down);

        // The place ranks the same on any ranks and after any restart
        impactKey place;
        place.add(centres[facei], mesh_.bounds().mag());
        const scalar draw = scalar(place.value() >> 11)/9007199254740992.0;
        const nw_status status =
            model_->shed(outward, along, shearDown, shearAcross, draw, d);
        require(status, patchi, "fall off");

        const scalar after = d.molten + d.powder;
        if (after >= before) continue;

        mass += (before - after)*area[facei];
        setDeposit(patchi, facei, d);
    }
    addToSum(i, shed, mass);
}


void Foam::nearWall::wallMemory::finishStep(const scalar duration)
{
    if (mesh_.changing())
    {
        FatalErrorInFunction
            << "The mesh moves or changes, and walls cannot remember a deposit"
            << " on such a mesh. Remove the key 'memory'." << exit(FatalError);
    }
    forAll(patches_, i) setTemperature(patches_[i]);

    // What was captured in this step flows in the next one. So a steady film is
    // that of the flow alone.
    if (film_) flow(acceleration_*duration);
    forAll(patches_, i)
    {
        addSources(i);
        age(patches_[i], acceleration_*duration);
        resuspendFrom(i, acceleration_*duration);
        shedFrom(i);
        setCoverage(patches_[i]);
    }
}


void Foam::nearWall::wallMemory::reportRise(Ostream& os, const scalar rise)
{
    if (rise <= largestSoundRise) return;

    os  << "    nearWallInteraction, warning: the deposit grew so much in this"
        << " step that the surface of a face changes by some " << rise
        << " K; take shorter steps or less acceleration" << nl;
}


void Foam::nearWall::wallMemory::report
(
    Ostream& os,
    const List<scalarList>& totals,
    const scalar time,
    const bool writeRow
)
{
    faceSums faces(patches_.size(), largestRise_);
    largestRise_ = 0;
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const scalarField none(patchesOf(mesh_)[patchi].size(), Zero);
        faces.add
        (
            i,
            mesh_.magSf().boundaryField()[patchi],
            conversion_.boundaryField()[patchi],
            {
                &molten_.boundaryField()[patchi],
                &powder_.boundaryField()[patchi],
                &layer_.boundaryField()[patchi],
                &coverage_.boundaryField()[patchi],
                &temperature_.boundaryField()[patchi],
                heatFlux_ ? &heatFlux_->boundaryField()[patchi] : &none
            }
        );
    }
    faces.overRanks();
    reportRise(os, faces.rise());

    forAll(patches_, i)
    {
        const scalar moltenMass = faces.integral(i, moltenOf);
        const scalar powderMass = faces.integral(i, powderOf);
        const scalarList& t = totals[i];
        const scalar in = t[initial] + t[arrived];
        const scalar deposited = moltenMass + powderMass;
        const scalar rest =
            in + t[fromOthers] - t[drained] - t[shed] - t[resuspended]
          - deposited;
        const scalar all = max(in, in + t[fromOthers]);
        if (in > 0 || deposited > 0)
        {
            os  << "        " << sums_[i].name() << ", memory: molten "
                << moltenMass << " kg, powder " << powderMass
                << " kg, coverage " << faces.mean(i, coverageOf);
            if (film_) os << ", drained " << t[drained] << " kg";
            if (t[shed] > 0) os << ", shed " << t[shed] << " kg";
            if (t[resuspended] > 0)
            {
                os << ", resuspended " << t[resuspended] << " kg";
            }
            os  << nl;
        }
        if (!writeRow) continue;

        tableRow row;
        const auto addMeanAndMax = [&](const label q)
        {
            const std::string name(quantityNames[q]);
            row.add(name + "_mean" + quantityUnits[q], faces.mean(i, q));
            row.add(name + "_max" + quantityUnits[q], faces.maximum(i, q));
        };
        row.add("time_s", time);
        for (label k = 0; k < shed; ++k) row.add(termNames[k], t[k]);
        row.add("molten_kg", moltenMass);
        row.add("powder_kg", powderMass);
        row.add("residual", all > 0 ? rest/all : 0);
        for (const faceQuantity q : {moltenOf, powderOf, layerOf, coverageOf})
        {
            addMeanAndMax(q);
        }
        const scalar converted = faces.converted(i);
        row.add("conversion_mean", deposited > 0 ? converted/deposited : 0);
        addMeanAndMax(wallTOf);
        for (const term k : {shed, resuspended}) row.add(termNames[k], t[k]);
        if (cooled(patches_[i])) addMeanAndMax(heatFluxOf);
        tables_[i].write(row);
    }
}
