/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallMemory.H.
\*---------------------------------------------------------------------------*/

#include "nearWallMemory.H"
#include "nearWallCompat.H"
#include "mathematicalConstants.H"
#include "surfaceFields.H"

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

wordList columnNames()
{
    return wordList
    ({
        "initial_kg", "arrived_kg", "drained_kg", "from_other_patches_kg"
    });
}


//- What a row says of a patch beyond its ledger
wordList tableColumns()
{
    return wordList
    ({
        "time_s", "initial_kg", "arrived_kg", "drained_kg",
        "from_other_patches_kg", "molten_kg", "powder_kg", "residual",
        "molten_mean_kg_m2", "molten_max_kg_m2",
        "powder_mean_kg_m2", "powder_max_kg_m2",
        "layer_thickness_mean_m", "layer_thickness_max_m",
        "coverage_mean", "coverage_max", "conversion_mean",
        "wall_temperature_mean_K", "wall_temperature_max_K"
    });
}


volScalarField wallField
(
    const fvMesh& mesh,
    const word& name,
    const dimensionSet& dimensions
)
{
    return volScalarField
    (
        IOobject
        (
            name,
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        mesh,
        dimensionedScalar("zero", dimensions, 0)
    );
}


scalar readVoidage(const dictionary& dict)
{
    const scalar voidage = readOr<scalar>(dict, "voidage", 0.5);
    if (voidage < 0 || voidage >= 1)
    {
        FatalIOErrorInFunction(dict)
            << "key 'voidage' is " << voidage
            << ", must be from 0 to below 1" << exit(FatalIOError);
    }
    return voidage;
}


//- Does the model know how thick the melt on any of the walls is?
void requireViscosity
(
    const dictionary& dict,
    const nearwall::model& law,
    const patchRules& rules,
    const labelList& patches
)
{
    forAll(patches, i)
    {
        nw_deposit melt(nearwall::make_deposit(rules[patches[i]].wall));
        melt.molten = 1;
        scalar speed = 0;

        // Hotter than any table begins
        law.film_velocity(melt, 1e4, 1, speed);
        if (speed > 0) return;
    }
    FatalIOErrorInFunction(dict)
        << "film yes: the model knows no viscosity of what melts on the walls"
        << nl << "    Give the model [capture] model = \"viscosity\" and the"
        << " particle, or the slag of a wall, a composition or a viscosity;"
        << " or model = \"droplet\""
        << exit(FatalIOError);
}


//- Mean by area, and largest value, of a field on a patch
struct extent
{
    scalar mean = 0;
    scalar most = 0;
};

extent extentOf(const scalarField& x, const scalarField& area)
{
    extent e;
    scalarList sums(2, scalar(0));
    forAll(x, i)
    {
        sums[0] += x[i]*area[i];
        sums[1] += area[i];
        e.most = max(e.most, x[i]);
    }
    sumOverRanks(sums);
    reduce(e.most, maxOp<scalar>());
    e.mean = sums[1] > 0 ? sums[0]/sums[1] : 0;
    return e;
}

} // End anonymous namespace


Foam::nearWall::wallMemory::wallMemory
(
    const dictionary& dict,
    const fvMesh& mesh,
    const word& cloudName,
    const patchRules& rules,
    const lawPtr& law,
    const vector& gravity,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    rules_(rules),
    law_(law),
    voidage_(readVoidage(dict)),
    molten_(wallField(mesh, cloudName + ":moltenMass", dimMass/dimArea)),
    powder_(wallField(mesh, cloudName + ":powderMass", dimMass/dimArea)),
    layer_(wallField(mesh, cloudName + ":layerThickness", dimLength)),
    cover_(wallField(mesh, cloudName + ":coverArea", dimless)),
    coverage_(wallField(mesh, cloudName + ":coverage", dimless)),
    conversion_(wallField(mesh, cloudName + ":depositConversion", dimless)),
    temperature_
    (
        wallField(mesh, cloudName + ":wallTemperature", dimTemperature)
    ),
    arrived_(rules.size())
{
    refuseUnknownKeys(dict, wordList({"voidage", "film"}), "memory");

    DynamicList<label> ours;
    forAll(rules, patchi)
    {
        if (rules[patchi].what == fate::interact) ours.append(patchi);
    }
    patches_ = ours;
    if (isNew()) start();
    check();

    ledgers_.setSize(patches_.size());
    added_.resize(patches_.size());
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const word& name = mesh.boundaryMesh()[patchi].name();
        arrived_[patchi].setSize
        (
            mesh.boundaryMesh()[patchi].size(), nearwall::make_arrivals()
        );
        ledgers_[i] = ledger(columnNames());
        ledgers_[i].load(saved.subOrEmptyDict(name));
        if (!saved.found(name)) book(i, initial, mass(i));
        tables_.emplace_back(folder/(name + ".wall.dat"), tableColumns());
        setCoverage(patchi);
    }

    const bool film = readOr<Switch>(dict, "film", Switch(false));
    if (film)
    {
        requireViscosity(dict, *law, rules, patches_);
        film_.reset(new wallFilm(mesh, patches_, law, gravity));
    }
    Info<< "    nearWallInteraction, memory of the walls: voidage " << voidage_
        << ", film " << (film ? "yes" : "no") << nl;
}


nw_deposit Foam::nearWall::wallMemory::deposit
(
    const label patchi,
    const label facei
) const
{
    nw_deposit d;
    nw_deposit_init(&d);
    d.wall = rules_[patchi].wall;
    d.molten = molten_.boundaryField()[patchi][facei];
    d.powder = powder_.boundaryField()[patchi][facei];
    d.solid = layer_.boundaryField()[patchi][facei]*(1 - voidage_);
    d.cover = cover_.boundaryField()[patchi][facei];
    d.conversion = conversion_.boundaryField()[patchi][facei];
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
    layer_.boundaryFieldRef()[patchi][facei] = d.solid/(1 - voidage_);
    cover_.boundaryFieldRef()[patchi][facei] = d.cover;
    conversion_.boundaryFieldRef()[patchi][facei] = d.conversion;
}


bool Foam::nearWall::wallMemory::isNew()
{
    volScalarField* const fields[] =
        {&molten_, &powder_, &layer_, &cover_, &conversion_};
    bool given = false;
    for (volScalarField* const field : fields)
    {
        given = field->headerOk() || given;
    }
    return !returnReduce(given, orOp<bool>());
}


void Foam::nearWall::wallMemory::start()
{
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const nw_deposit d
        (
            law_->initial_deposit(rules_[patchi].wall, voidage_)
        );
        forAll(mesh_.boundaryMesh()[patchi], facei)
        {
            setDeposit(patchi, facei, d);
        }
    }
}


void Foam::nearWall::wallMemory::check() const
{
    const volScalarField* const fields[] =
        {&molten_, &powder_, &layer_, &cover_, &conversion_};
    for (const volScalarField* const field : fields)
    {
        const scalar most = field == &conversion_ ? 1 : GREAT;
        forAll(patches_, i)
        {
            const scalarField& x = field->boundaryField()[patches_[i]];
            forAll(x, facei)
            {
                if (x[facei] >= 0 && x[facei] <= most) continue;

                FatalErrorInFunction
                    << "field " << field->name() << " of time "
                    << mesh_.time().timeName() << " is " << x[facei]
                    << " on patch '"
                    << mesh_.boundaryMesh()[patches_[i]].name()
                    << "', must be from 0 to " << most << exit(FatalError);
            }
        }
    }
}


Foam::scalar Foam::nearWall::wallMemory::mass(const label i) const
{
    const label patchi = patches_[i];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    const scalarField& molten = molten_.boundaryField()[patchi];
    const scalarField& powder = powder_.boundaryField()[patchi];
    return sum((molten + powder)*area);
}


void Foam::nearWall::wallMemory::dress
(
    const label patchi,
    const label facei,
    nw_impact& impact
) const
{
    // Refused is only a temperature that the impact will be refused for, too
    law_->apply_deposit(deposit(patchi, facei), voidage_, impact);
}


nw_status Foam::nearWall::wallMemory::arrive
(
    const event& e,
    nw_deposit_source& sum
) const
{
    const scalar area = mesh_.magSf().boundaryField()[e.patch][e.face];
    const scalar volume =
        e.particles*constant::mathematical::pi/6*pow3(e.arrived.d);
    return law_->add_captured(e.arrived, e.mass/area, e.mass/volume, sum);
}


bool Foam::nearWall::wallMemory::joinsFilm(const event& e) const
{
    // A patch that always captures has no regime, and no memory
    if (!film_ || e.regime < 0 || e.mass <= 0) return false;

    nw_deposit_source alone(nearwall::make_arrivals());
    return arrive(e, alone) == NW_OK && alone.molten > 0;
}


void Foam::nearWall::wallMemory::add(const event& e)
{
    if (e.mass <= 0) return;

    const nw_status status = arrive(e, arrived_[e.patch][e.face]);
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "a parcel that stuck on patch '"
            << mesh_.boundaryMesh()[e.patch].name() << "' (" << e.mass
            << " kg, diameter " << e.arrived.d << " m): "
            << nw_status_text(status) << exit(FatalError);
    }
}


void Foam::nearWall::wallMemory::book
(
    const label i,
    const column c,
    const scalar mass
)
{
    longSum& sum = added_[i][c];
    sum.add(mass);
    ledgers_[i].add(c, sum.sum - ledgers_[i].added()[c]);
}


void Foam::nearWall::wallMemory::addArrivals(const label i)
{
    const label patchi = patches_[i];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    List<nw_deposit_source>& faces = arrived_[patchi];
    scalar mass = 0;
    forAll(faces, facei)
    {
        if (!faces[facei].count) continue;

        nw_deposit d(deposit(patchi, facei));
        const nw_status status = nearwall::add(faces[facei], d);
        if (status != NW_OK)
        {
            FatalErrorInFunction
                << "the deposit on patch '"
                << mesh_.boundaryMesh()[patchi].name() << "': "
                << nw_status_text(status) << exit(FatalError);
        }
        setDeposit(patchi, facei, d);
        mass += (faces[facei].molten + faces[facei].powder)*area[facei];
        nw_deposit_source_init(&faces[facei]);
    }
    book(i, arrived, mass);
}


void Foam::nearWall::wallMemory::setTemperature(const label patchi)
{
    const patchRule& rule = rules_[patchi];
    scalarField& T = temperature_.boundaryFieldRef()[patchi];
    if (rule.temperatureFromField)
    {
        T = mesh_.lookupObject<volScalarField>(rule.temperatureField)
           .boundaryField()[patchi];
    }
    else
    {
        T = rule.temperature;
    }
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
        film[i].molten = molten_.boundaryField()[patchi];
        film[i].other = powder_.boundaryField()[patchi];
        film[i].conversion = conversion_.boundaryField()[patchi];
    }
    film_->flow(film, duration);
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        scalarField& molten = molten_.boundaryFieldRef()[patchi];
        scalarField& conversion = conversion_.boundaryFieldRef()[patchi];
        molten = film[i].molten;
        conversion = film[i].conversion;
        book(i, drained, film[i].drained);
        book(i, fromOthers, film[i].fromOthers);
    }
}


void Foam::nearWall::wallMemory::finishStep(const scalar duration)
{
    if (mesh_.changing())
    {
        FatalErrorInFunction
            << "the mesh moves or changes: walls cannot remember what lies on"
            << " their faces; remove the key 'memory'" << exit(FatalError);
    }
    forAll(patches_, i) setTemperature(patches_[i]);

    // What comes now runs in the next step: an explicit step of arrival and
    // flow together, so that a steady film is that of the flow alone
    if (film_) flow(duration);
    forAll(patches_, i)
    {
        addArrivals(i);
        setCoverage(patches_[i]);
    }
}


void Foam::nearWall::wallMemory::report
(
    Ostream& os,
    const List<scalarList>& totals,
    const scalar time,
    const bool writeRow
)
{
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const word& name = mesh_.boundaryMesh()[patchi].name();
        const scalarField& area = mesh_.magSf().boundaryField()[patchi];
        const scalarField& molten = molten_.boundaryField()[patchi];
        const scalarField& powder = powder_.boundaryField()[patchi];
        const scalarField& conversion = conversion_.boundaryField()[patchi];

        scalarList lies(3, scalar(0));
        forAll(area, facei)
        {
            lies[0] += molten[facei]*area[facei];
            lies[1] += powder[facei]*area[facei];
            lies[2] +=
                (molten[facei] + powder[facei])*area[facei]*conversion[facei];
        }
        sumOverRanks(lies);

        const scalarList& t = totals[i];
        const scalar in = t[initial] + t[arrived];
        const scalar on = lies[0] + lies[1];
        const scalar rest = in + t[fromOthers] - t[drained] - on;
        const scalar all = max(in, in + t[fromOthers]);
        const extent coverage
        (
            extentOf(coverage_.boundaryField()[patchi], area)
        );
        if (in > 0 || on > 0)
        {
            os  << "        " << name << ", memory: molten " << lies[0]
                << " kg, powder " << lies[1] << " kg, coverage "
                << coverage.mean;
            if (film_) os << ", drained " << t[drained] << " kg";
            os  << nl;
        }
        if (!writeRow) continue;

        const extent melt(extentOf(molten, area));
        const extent dust(extentOf(powder, area));
        const extent layer(extentOf(layer_.boundaryField()[patchi], area));
        const extent T(extentOf(temperature_.boundaryField()[patchi], area));
        const scalar row[] =
        {
            time, t[initial], t[arrived], t[drained], t[fromOthers],
            lies[0], lies[1], all > 0 ? rest/all : 0,
            melt.mean, melt.most, dust.mean, dust.most,
            layer.mean, layer.most, coverage.mean, coverage.most,
            on > 0 ? lies[2]/on : 0, T.mean, T.most
        };
        scalarList values(sizeof(row)/sizeof(row[0]));
        forAll(values, k) values[k] = row[k];
        tables_[i].row(values);
    }
}


Foam::dictionary Foam::nearWall::wallMemory::saved
(
    const List<scalarList>& totals
) const
{
    dictionary dict;
    forAll(patches_, i)
    {
        const word& name = mesh_.boundaryMesh()[patches_[i]].name();
        dict.add(keyType(name), ledgers_[i].saved(totals[i]));
    }
    return dict;
}
