// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallMemory.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "surfaceFields.H"
#include "versionCompat.H"
#include "wallCooling.H"

namespace Foam { namespace nearWall {
    defineTypeNameAndDebug(wallMemory, 0);
}}

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

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


void printSettings(const scalar voidage, const bool film, const scalar acceleration)
{
    Info<< "    nearWallInteraction, memory of the walls: voidage " << voidage
        << ", film " << (film ? "yes" : "no") << nl;
    if (acceleration > 1)
    {
        Info<< "        acceleration " << acceleration << ": 1 s of the flow is "
            << acceleration << " s of the deposit" << nl;
    }
}


scalar readVoidage(const dictionary& dict)
{
    return readChecked<scalar>
    (
        dict, "voidage", 0.5, [](scalar v) { return v >= 0 && v < 1; },
        "from 0 to below 1"
    );
}


scalar readAcceleration(const dictionary& dict)
{
    return readChecked<scalar>
    (
        dict, "acceleration", 1, [](scalar a) { return a >= 1; }, "1 or more"
    );
}


//- The dictionary `shed`; empty without one
dictionary readShed(const dictionary& dict)
{
    if (dict.found("shed") && !dict.isDict("shed"))
    {
        FatalIOErrorInFunction(dict)
            << "Key 'shed' must be a dictionary, as in shed { parcels yes; }"
            << exit(FatalIOError);
    }
    return dict.subOrEmptyDict("shed");
}


//- Patches for which the wall model decides; one at least
labelList patchesWithModel(const dictionary& dict, const List<patchRule>& rules)
{
    labelList found;
    forAll(rules, patchi)
    {
        if (rules[patchi].type == patchRule::interact) found.append(patchi);
    }
    if (found.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Key 'memory': no patch has the type interact, so no wall would"
            << " remember anything." << nl
            << "    Give a wall in 'patches' the type interact, or remove the key."
            << exit(FatalIOError);
    }
    return found;
}


//- Key of the names of the fields among the totals of the patches
const char* const fieldNames = "all:fields";


//- Does a process that is wanted act on a wall of the model?
template<class Wanted>
bool acts
(
    const nearwall::model& model,
    const std::uint32_t wall,
    const Wanted& wanted
)
{
    const std::vector<nearwall::process> all(nearwall::processes());
    const std::uint32_t acting = model.wall_processes(wall);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
        if ((acting >> k & 1) && wanted(all[k])) return true;
    }
    return false;
}


bool takesMass(const nearwall::process& process)
{
    return !process.loss.empty();
}


bool bringsMass(const nearwall::process& process)
{
    return !process.gain.empty();
}


//- Largest change of a deposit in one piece of an interval, as a share of it
const scalar largestChange = 0.1;

//- Change of a deposit as a share of it: of its mass, and of its thickness
scalar changeOf
(
    const nw_deposit& before,
    const nw_deposit& after,
    const scalar voidage
)
{
    const scalar mass = before.molten + before.frozen + before.powder;
    const scalar thickness = before.solid/(1 - voidage);
    const scalar moved = max
    (
        mag(after.powder - before.powder),
        max(mag(after.molten - before.molten), mag(after.frozen - before.frozen))
    );
    const scalar closed = mag(after.closed - before.closed);
    return max(moved/max(mass, VSMALL), closed/max(thickness, VSMALL));
}

} // End anonymous namespace


//- What surrounds the deposit on each face of a patch
class Foam::nearWall::wallMemory::patchSurroundings
{
    const wallMemory& memory_;
    const label i_;
    const vectorField& Sf_;

    //- The gas; empty where no process takes mass from the wall
    scalarField density_;
    scalarField viscosity_;
    vectorField stress_;

public:

    //- Of the i-th patch
    patchSurroundings(const wallMemory& memory, const label i)
    :
        memory_(memory),
        i_(i),
        Sf_(memory.mesh_.Sf().boundaryField()[memory.patches_[i]])
    {
        const label patchi = memory.patches_[i];
        if (!acts(*memory.model_, memory.rules_[patchi].wall, takesMass)) return;

        density_ = memory.shear_.density(patchi);
        viscosity_ = memory.shear_.kinematicViscosity(patchi);
        stress_ = memory.shear_.stress(patchi);
    }

    //- Does the gas or gravity take mass from the faces?
    bool losesMass() const { return stress_.size() > 0; }

    nw_deposit_surroundings at(const label facei) const
    {
        nw_deposit_surroundings found
        (
            nearwall::make_deposit_surroundings(memory_.voidage_)
        );
        if (!losesMass()) return found;

        // Into the gas
        const vector n(-Sf_[facei]/mag(Sf_[facei]));
        const vector& gravity = memory_.gravity_;
        found.gravity_outward = gravity & n;
        const vector slope(gravity - found.gravity_outward*n);
        found.gravity_along = mag(slope);

        const vector down(slope/max(found.gravity_along, VSMALL));
        found.gas_density = density_[facei];
        found.kinematic_viscosity = viscosity_[facei];
        found.shear_down = stress_[facei] & down;
        found.shear_across = mag(stress_[facei] - found.shear_down*down);

        found.draw = memory_.places_.rank(i_, facei);
        return found;
    }
};


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
    voidage_(readVoidage(dict)),
    acceleration_(readAcceleration(dict)),
    gravity_(gravity),
    shear_(shear),
    patches_(patchesWithModel(dict, rules)),
    isThick_(patches_.size(), false),
    fields_(initialFields(cloudName, saved)),
    interval_(dict, saved),
    places_(mesh, patches_),
    balance_(mesh, patches_, fields_, saved, folder),
    heat_(mesh, cloudName, cooledPatches(), saved.subOrEmptyDict("heat"), folder),
    returning_
    (
        readShed(dict), mesh, cloudName, patches_, acceleration_,
        saved.subOrEmptyDict("returned"), folder
    ),
    resistance_(rules.size()),
    captured_(rules.size())
{
    refuseUnknownKeys
    (
        dict,
        wordList
        ({
            "voidage", "film", "acceleration", "interval", "intervalSteps", "shed"
        }),
        "memory"
    );
    checkCooled();
    for (const label patchi : patches_) fields_.setCoverage(patchi);
    if (readOr<Switch>(dict, "film", Switch(false)))
    {
        requireViscosity(dict, *model, rules, patches_);
        List<std::uint32_t> walls(rules.size());
        forAll(rules, patchi) walls[patchi] = rules[patchi].wall;
        film_.reset(new wallFilm(mesh, patches_, walls, model, gravity));
    }
    printSettings(voidage_, bool(film_), acceleration_);
    interval_.report(Info);
    reportInitial();
    reportThick(Info);
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


Foam::wordList Foam::nearWall::wallMemory::clouds(const objectRegistry& mesh)
{
    wordList names(mesh.lookupClass<wallMemory>().sortedToc());
    for (word& name : names) name = name.substr(0, name.rfind(':'));
    return names;
}


const Foam::nearWall::wallCooling* Foam::nearWall::wallMemory::condition
(
    const label patchi
) const
{
    const patchRule& rule = rules_[patchi];
    if (!mesh_.foundObject<volScalarField>(rule.temperatureField)) return nullptr;

    return dynamic_cast<const wallCooling*>(&rule.temperatureOn(mesh_, patchi));
}


Foam::labelList Foam::nearWall::wallMemory::cooledPatches() const
{
    labelList found;
    for (const label patchi : patches_)
    {
        if (cooled(patchi)) found.append(patchi);
    }
    return found;
}


bool Foam::nearWall::wallMemory::anyProcess(const char* const name) const
{
    const auto isNamed =
        [name](const nearwall::process& process) { return process.name == name; };
    for (const label patchi : patches_)
    {
        if (acts(*model_, rules_[patchi].wall, isNamed)) return true;
    }
    return false;
}


void Foam::nearWall::wallMemory::refuseResting(const scalar mass) const
{
    if (mass <= 0 || !returning_.on()) return;

    FatalErrorInFunction
        << "Key 'parcels' of memory, shed: stuck parcels of an earlier run, "
        << mass << " kg, rest on the walls. The deposit holds their mass, too,"
        << " and would give it back a second time." << nl
        << "    Write stuck remove; and start the case anew, or remove the"
        << " clouds and the deposit from " << timeName(mesh_.time())
        << exit(FatalError);
}


void Foam::nearWall::wallMemory::checkCooled()
{
    for (const label patchi : patches_)
    {
        if (cooled(patchi))
        {
            resistance_[patchi].setSize(patchesOf(mesh_)[patchi].size(), -1);
            nw_deposit all(nearwall::make_deposit(rules_[patchi].wall));
            all.molten = all.frozen = all.powder = all.cover = 1;
            all.solid = 1e-3;
            nw_wall_cooling cooling(nearwall::make_wall_cooling());
            cooling.coolant_temperature = cooling.gas_temperature = 1000;
            cooling.wall_resistance = cooling.gas_coefficient = 1;
            heatUnder(all, patchi, cooling);
        }
        else if (condition(patchi))
        {
            Info<< "    nearWallInteraction, warning: patch "
                << patchesOf(mesh_)[patchi].name() << " has the temperature"
                << " condition nearWallDepositTemperature, but impacts meet the"
                << " number of wallTemperature; write wallTemperature field;"
                << nl;
        }
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


Foam::nearWall::depositFields Foam::nearWall::wallMemory::initialFields
(
    const word& cloudName,
    const dictionary& saved
) const
{
    depositFields fields
    (
        mesh_, cloudName, voidage_, cooledPatches().size() > 0, anyProcess("resuspension")
    );
    fields.requireComplete
    (
        saved.found(fieldNames)
      ? std::string(nearWall::read<string>(saved, fieldNames))
      : std::string()
    );
    if (!fields.given())
    {
        for (const label patchi : patches_)
        {
            const nw_deposit d
            (
                model_->initial_deposit(rules_[patchi].wall, voidage_)
            );
            forAll(patchesOf(mesh_)[patchi], facei) fields.set(patchi, facei, d);
        }
    }
    fields.check(patches_);
    return fields;
}


Foam::scalar Foam::nearWall::wallMemory::thickness
(
    const label patchi,
    const label facei
) const
{
    nw_impact here;
    nw_impact_init(&here);
    const scalar T = fields_.on(depositFields::temperature, patchi)[facei];
    if (T > 0) here.T_w = T;

    // Refused only at a temperature without a density; the slag then counts 0
    model_->apply_deposit(deposit(patchi, facei), voidage_, here);
    return
        here.melt_thickness + fields_.on(depositFields::layer, patchi)[facei];
}


void Foam::nearWall::wallMemory::reportInitial() const
{
    for (const label patchi : patches_)
    {
        const scalarField& area = mesh_.magSf().boundaryField()[patchi];
        scalar mass = 0, volume = 0;
        label faces = 0;
        forAll(area, facei)
        {
            const nw_deposit d(deposit(patchi, facei));
            const scalar here = d.molten + d.frozen + d.powder;
            mass += here*area[facei];
            volume += thickness(patchi, facei)*area[facei];
            faces += here > 0;
        }
        mass = sumOfRanks(mass);
        if (mass <= 0) continue;

        const scalar mean =
            1e3*sumOfRanks(volume)/sumOfRanks(Foam::sum(area));
        Info<< "    nearWallInteraction, deposit on patch "
            << patchesOf(mesh_)[patchi].name() << " in the beginning: " << mass
            << " kg on " << sumOfRanks(faces) << " of "
            << sumOfRanks(area.size()) << " faces, mean thickness " << mean
            << " mm" << nl;
    }
}


void Foam::nearWall::wallMemory::reportThick(Ostream& os)
{
    const scalar domain = mesh_.bounds().mag();
    forAll(patches_, i)
    {
        if (isThick_[i]) continue;

        const label patchi = patches_[i];
        const scalarField& area = mesh_.magSf().boundaryField()[patchi];
        const labelUList& cells = mesh_.boundary()[patchi].faceCells();
        scalar thickest = 0, ofCell = 0;
        forAll(area, facei)
        {
            const scalar cell = mesh_.V()[cells[facei]]/area[facei];
            const scalar here = thickness(patchi, facei);
            thickest = max(thickest, here);
            ofCell = max(ofCell, here/cell);
        }
        thickest = largestOfRanks(thickest);
        ofCell = largestOfRanks(ofCell);
        if (ofCell <= 1 && thickest <= 0.01*domain) continue;

        isThick_[i] = true;
        os  << "    nearWallInteraction, warning: the deposit on patch "
            << patchesOf(mesh_)[patchi].name() << " is up to " << 1e3*thickest
            << " mm thick, " << ofCell << " of the cell beside it and "
            << 100*thickest/domain << " % of the domain. The gas flows as if it"
            << " were not there" << nl
            << "        Are layer_thickness and the fields in m and kg/m2? Else"
            << " take less acceleration, or move the wall in the mesh" << nl;
    }
}


Foam::dictionary Foam::nearWall::wallMemory::saved
(
    const List<scalarList>& totals
) const
{
    dictionary dict(balance_.saved(totals));
    dict.add(keyType(word(fieldNames)), string(fields_.names()));
    dict.add("heat", savedHeat_);
    dict.add("returned", savedReturned_);
    interval_.save(dict);
    return dict;
}


void Foam::nearWall::wallMemory::archive(stateArchive& state)
{
    fields_.archive(state, patches_);
    state(interval_);
    state(places_);
    state(balance_);
    state(heat_);
    state(returning_);
    state(resistance_);
    state(largestRise_);
    state(captured_);
}


void Foam::nearWall::wallMemory::applyDeposit(impactEvent& e) const
{
    // The status needs no check: it refuses only a temperature for which the
    // impact will be refused as well
    model_->apply_deposit(deposit(e.patch, e.face), voidage_, e.impact);
    if (resistance_[e.patch].size())
    {
        e.impact.T_under = fields_.on(depositFields::under, e.patch)[e.face];
    }
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

    nw_deposit_source& sum =
        captured_[e.patch].emplace(e.face, nearwall::make_deposit_source())
       .first->second;
    const nw_status status = addToSource(e, sum);
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "A parcel that stuck on patch '"
            << patchesOf(mesh_)[e.patch].name() << "' (" << e.mass
            << " kg, diameter " << e.impact.d
            << " m) cannot be added to the deposit: "
            << nw_status_text(status) << exit(FatalError);
    }
    returning_.addCaptured(e);
    heat_.addCaptured(e, acceleration_);
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


void Foam::nearWall::wallMemory::setTemperature(const label patchi)
{
    const patchRule& rule = rules_[patchi];
    scalarField& T = fields_.on(depositFields::temperature, patchi);
    if (rule.temperatureFromField) T = rule.temperatureOn(mesh_, patchi);
    else T = rule.temperature;
}


void Foam::nearWall::wallMemory::noteHeat
(
    const label patchi,
    const label facei,
    const nw_wall_cooling& cooling,
    const nw_deposit_losses& crossed,
    const scalar duration
)
{
    const scalar toCoolant = crossed.heat_to_coolant/duration;
    fields_.on(depositFields::heatFlux, patchi)[facei] = toCoolant;
    fields_.on(depositFields::under, patchi)[facei] =
        cooling.coolant_temperature + toCoolant*cooling.wall_resistance;

    scalar& resistance = resistance_[patchi][facei];
    const scalar rise = toCoolant*(crossed.deposit_resistance - resistance);
    if (resistance >= 0) largestRise_ = max(largestRise_, mag(rise));
    resistance = crossed.deposit_resistance;
    heat_.add(patchi, facei, cooling, crossed, duration);
}


Foam::scalar Foam::nearWall::wallMemory::addCaptured
(
    nw_deposit& d,
    const label patchi,
    const label facei
)
{
    const auto captured = captured_[patchi].find(facei);
    if (captured == captured_[patchi].end()) return 0;

    const nw_deposit_source& sum = captured->second;
    require(nearwall::add(sum, d), patchi, "grow");
    return sum.molten + sum.powder;
}


void Foam::nearWall::wallMemory::addCaptured(const label i)
{
    const label patchi = patches_[i];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    scalar arrived = 0;
    for (const auto& captured : captured_[patchi])
    {
        const label facei = captured.first;
        nw_deposit d(deposit(patchi, facei));
        arrived += addCaptured(d, patchi, facei)*area[facei];
        fields_.set(patchi, facei, d);
        fields_.setCoverage(patchi, facei);
    }
    balance_.add(i, wallBalance::arrived, arrived);
}


nw_deposit_losses Foam::nearWall::wallMemory::advance
(
    const nw_deposit_surroundings& around,
    const nw_wall_cooling* const heating,
    const scalar duration,
    const label patchi,
    nw_deposit& d
) const
{
    const auto by = [&](const scalar time, nw_deposit& now)
    {
        nw_deposit_losses lost(nearwall::make_deposit_losses());
        const nw_status status =
            heating
          ? model_->advance(around, *heating, time, now, lost)
          : model_->advance(around, time, now, lost);
        require(status, patchi, "advance");
        return lost;
    };

    nw_deposit after(d);
    nw_deposit_losses all(by(duration, after));
    const scalar wanted = changeOf(d, after, voidage_)/largestChange;
    const label pieces = label(min(scalar(interval_.steps()), ceil(wanted)));
    if (pieces <= 1)
    {
        d = after;
        return all;
    }

    all = nearwall::make_deposit_losses();
    for (label piece = 0; piece < pieces; ++piece)
    {
        const nw_deposit_losses lost(by(duration/pieces, d));
        for (label k = 0; k < NW_PROCESSES; ++k) all.mass[k] += lost.mass[k];
        all.heat_taken += lost.heat_taken;
        all.heat_to_coolant += lost.heat_to_coolant;
        all.heat_of_fusion += lost.heat_of_fusion;
        all.heat_released += lost.heat_released;
        if (piece == 0) all.deposit_resistance = lost.deposit_resistance;
    }
    return all;
}


nw_deposit_losses Foam::nearWall::wallMemory::advanceFace
(
    const patchSurroundings& surroundings,
    const label i,
    const label facei,
    nw_wall_cooling* const heating,
    const scalar duration,
    nw_deposit& d
)
{
    const label patchi = patches_[i];
    nw_deposit_surroundings around(surroundings.at(facei));
    around.wall_temperature =
        fields_.on(depositFields::temperature, patchi)[facei];
    if (heating) heat_.heat(patchi, facei, *heating);
    const nw_deposit_losses here(advance(around, heating, duration, patchi, d));
    returning_.addLost(i, facei, here);
    if (heating) noteHeat(patchi, facei, *heating, here, duration);
    return here;
}


Foam::List<nw_wall_cooling> Foam::nearWall::wallMemory::beginHeating
(
    const label patchi,
    const scalar duration
)
{
    const wallCooling* const cooling = cooled(patchi);
    if (!cooling) return List<nw_wall_cooling>();

    heat_.beginPatch(patchi, duration, acceleration_*cooling->answersAfter());
    return cooling->heating();
}


void Foam::nearWall::wallMemory::advance(const label i, const scalar duration)
{
    const label patchi = patches_[i];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    List<nw_wall_cooling> heating(beginHeating(patchi, duration));
    const bool isCooled = heating.size() > 0;
    const patchSurroundings surroundings(*this, i);
    const bool gainsMass = acts(*model_, rules_[patchi].wall, bringsMass);

    scalar arrived = 0;
    nw_deposit_losses lost(nearwall::make_deposit_losses());
    forAll(area, facei)
    {
        const bool isHit = captured_[patchi].count(facei) > 0;
        const bool changes = isCooled || isHit || gainsMass;
        if (!changes && !fields_.holds(patchi, facei)) continue;

        nw_deposit d(deposit(patchi, facei));
        arrived += addCaptured(d, patchi, facei)*area[facei];
        const scalar slag = d.molten + d.frozen;
        if
        (
            isCooled || slag > 0 || gainsMass
         || (d.powder > 0 && surroundings.losesMass())
        )
        {
            nw_wall_cooling* const by = isCooled ? &heating[facei] : nullptr;
            const nw_deposit_losses here
            (
                advanceFace(surroundings, i, facei, by, duration, d)
            );
            for (label k = 0; k < NW_PROCESSES; ++k)
            {
                lost.mass[k] += here.mass[k]*area[facei];
            }
        }
        else if (!isHit) continue;

        fields_.set(patchi, facei, d);
    }
    balance_.add(i, wallBalance::arrived, arrived);
    balance_.addLosses(i, lost);
    fields_.setCoverage(patchi);
}


void Foam::nearWall::wallMemory::flow(const scalar duration)
{
    if (!film_) return;

    const List<wallFilm::passage> passed(film_->flow(fields_, duration));
    forAll(patches_, i)
    {
        balance_.add(i, wallBalance::drained, passed[i].drained);
        balance_.add(i, wallBalance::fromOthers, passed[i].fromOthers);
    }
}


void Foam::nearWall::wallMemory::follow()
{
    if (!mesh_.moving()) return;

    const List<scalarField> factors(places_.follow());
    forAll(patches_, i)
    {
        fields_.spread(patches_[i], factors[i]);
        heat_.spread(patches_[i], factors[i]);
        returning_.spread(patches_[i], factors[i]);
    }
    if (film_) film_->move();
}


void Foam::nearWall::wallMemory::collectHeat()
{
    // That of the last step, which ended with the present temperatures
    const scalar before = acceleration_*mesh_.time().deltaT0Value();
    for (const label patchi : patches_)
    {
        const wallCooling* const cooling = cooled(patchi);
        if (cooling) heat_.collect(patchi, *cooling, before);
    }
}


void Foam::nearWall::wallMemory::finishStep(const scalar duration)
{
    follow();
    for (const label patchi : patches_) setTemperature(patchi);
    collectHeat();

    interval_.add(duration);
    if (interval_.isDue())
    {
        // What was captured in this step flows in the next one. So a steady
        // film is that of the flow alone.
        const scalar ofDeposit = acceleration_*interval_.elapsed();
        heat_.beginStep(interval_.elapsed());
        flow(ofDeposit);
        forAll(patches_, i) advance(i, ofDeposit);
        interval_.begin();
    }
    else
    {
        forAll(patches_, i) addCaptured(i);
    }
    for (const label patchi : patches_) captured_[patchi].clear();
}


void Foam::nearWall::wallMemory::report
(
    Ostream& os,
    const List<scalarList>& totals,
    const scalar time,
    const bool writeRow
)
{
    boolList isCooled(patches_.size());
    forAll(patches_, i) isCooled[i] = cooled(patches_[i]) != nullptr;
    balance_.report
    (
        os, fields_, totals, largestRise_, isCooled, bool(film_), time, writeRow
    );
    largestRise_ = 0;
    savedHeat_ = heat_.report(os, fields_, time, writeRow);
    savedReturned_ = returning_.report(os, time, writeRow);
}
