// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallHeat.H"
#include "surfaceFields.H"
#include "versionCompat.H"
#include "wallCooling.H"
#include "wallField.H"

namespace
{

using namespace Foam;

//- Names of the terms, in their order: keys of a restart and columns
const wordList names
({
    "gas_J", "radiation_J", "particles_J", "condensation_J", "coolant_J",
    "melting_J", "landed", "duration_s"
});


//- Parcels for which a face that is hit waits in tau
const scalar smoothedParcels = 20;


//- The lag passes on over so many times after which gas and radiation answer.
//  Over an insulated wall, which always takes the same heat, lag' = lag - (lag
//  before)/lagTimes: with 4 it soon halves in each step, with 1 it swings for ever
const scalar lagTimes = 4;


//- Temperature of a surface [K] that takes a heat flux [W/m2], by Newton's method
//  from a first guess
scalar surfaceThatTakes
(
    const nw_wall_cooling& c,
    const scalar flux,
    const scalar guess
)
{
    // As the library's own
    const scalar sigma = 5.670374419e-8;
    scalar T = guess;
    for (int step = 0; step < 50; ++step)
    {
        const scalar slope = c.gas_coefficient + 4*c.emissivity*sigma*pow3(T);
        if (slope <= 0) return T;

        const scalar taken =
            c.gas_coefficient*(c.gas_temperature - T)
          + c.emissivity*(c.irradiation - sigma*pow4(T)) + c.further_flux;
        const scalar change = (taken - flux)/slope;
        T = max(T + change, scalar(1));
        if (mag(change) <= 1e-12*T) break;
    }
    return T;
}

} // End anonymous namespace


Foam::nearWall::wallHeat::wallHeat
(
    const fvMesh& mesh,
    const word& cloudName,
    const labelList& patches,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    patches_(patches),
    capacity_
    (
        readWallField
        (
            mesh, cloudName + ":heldCapacity", dimEnergy/dimArea/dimTemperature
        )
    ),
    enthalpy_
    (
        readWallField(mesh, cloudName + ":heldEnthalpy", dimEnergy/dimArea)
    ),
    lag_(readWallField(mesh, cloudName + ":laggingHeat", dimEnergy/dimArea)),
    taken_(readWallField(mesh, cloudName + ":takenHeat", dimEnergy/dimArea)),
    flux_
    (
        readWallField(mesh, cloudName + ":particleHeatFlux", dimPower/dimArea)
    ),
    sums_(mesh, patches, names, saved, folder, ".heat.dat"),
    started_(!saved.empty()),
    share_(patches.size(), scalar(1)),
    coefficient_(patchesOf(mesh).size()),
    given_(patchesOf(mesh).size())
{
    // Zero where a condition cools a wall whose deposit does not know of it
    forAll(patchesOf(mesh), patchi)
    {
        const scalarField none(patchesOf(mesh)[patchi].size(), Zero);
        coefficient_[patchi] = none;
        given_[patchi] = none;
    }
}


void Foam::nearWall::wallHeat::addCaptured
(
    const impactEvent& e,
    const scalar acceleration
)
{
    scalar heat = 0;
    if
    (
        !e.bringsHeat || place(e.patch) < 0
     || e.model->heat_brought(e.impact, e.heatCapacity, heat) != NW_OK
    )
    {
        return;
    }
    const scalar area = mesh_.magSf().boundaryField()[e.patch][e.face];
    const scalar mass = acceleration*e.mass/area;
    const scalar capacity = mass*e.heatCapacity;
    capacity_.boundaryFieldRef()[e.patch][e.face] += capacity;
    enthalpy_.boundaryFieldRef()[e.patch][e.face] +=
        mass*heat + capacity*e.impact.T_w;
    sums_.add(place(e.patch), landed, 1);
}


void Foam::nearWall::wallHeat::addContact
(
    const impactEvent& e,
    const scalar acceleration
)
{
    if (place(e.patch) < 0) return;

    const scalar area = mesh_.magSf().boundaryField()[e.patch][e.face];
    enthalpy_.boundaryFieldRef()[e.patch][e.face] +=
        acceleration*e.contactHeat/area;
    sums_.add(place(e.patch), landed, 1);
}


void Foam::nearWall::wallHeat::beginStep(const scalar flow)
{
    // Without a message between ranks
    if (patches_.empty()) return;

    const label n = patches_.size();
    scalarList sums(2*n, scalar(0));
    forAll(patches_, i)
    {
        for (const scalar held : enthalpy_.boundaryField()[patches_[i]])
        {
            sums[i] += held != 0;
        }
        if (Pstream::master()) sums_.add(i, duration, flow);
        sums[n + i] = sums_[i].added()[landed];
    }
    sumOverRanks(sums);
    forAll(patches_, i)
    {
        // The master alone has added to the duration
        scalar time = sums_[i].added()[duration];
        time = sums_[i].base()[duration] + largestOfRanks(time);
        const scalar parcels = sums_[i].base()[landed] + sums[n + i];
        const scalar hit = max(sums[i], scalar(1));
        const scalar tau = smoothedParcels*hit*time/max(parcels, scalar(1));
        share_[i] = parcels > 0 ? -std::expm1(-flow/tau) : 1;
    }
}


void Foam::nearWall::wallHeat::collect
(
    const label patchi,
    const wallCooling& condition,
    const scalar before
)
{
    if (!started_) return;

    const label i = place(patchi);
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    const scalarField fromGas(before*condition.fromGas());
    const scalarField fromRadiation(before*condition.fromRadiation());
    scalarField& taken = taken_.boundaryFieldRef()[patchi];
    taken += fromGas + fromRadiation;
    sums_.add(i, gas, sum(fromGas*area));
    sums_.add(i, radiation, sum(fromRadiation*area));
}


void Foam::nearWall::wallHeat::beginPatch
(
    const label patchi,
    const scalar time,
    const scalar answer
)
{
    if (!started_) return;

    const scalar share = share_[place(patchi)];
    coefficient_[patchi] = share*capacity_.boundaryField()[patchi]/time;
    given_[patchi] =
        share*enthalpy_.boundaryField()[patchi]/time
      + lag_.boundaryField()[patchi]/(lagTimes*max(time, answer));
}


void Foam::nearWall::wallHeat::spread
(
    const label patchi,
    const scalarField& factors
)
{
    for (volScalarField* const field : kept())
    {
        scalarField& values = field->boundaryFieldRef()[patchi];
        values *= factors;
    }
}


void Foam::nearWall::wallHeat::archive(stateArchive& state)
{
    for (const label patchi : patches_)
    {
        for (volScalarField* const field : kept())
        {
            state.values(field->boundaryFieldRef()[patchi]);
        }
    }
    state(sums_);
    state(started_);
    state(share_);
    state(coefficient_);
    state(given_);
}


void Foam::nearWall::wallHeat::heat
(
    const label patchi,
    const label facei,
    nw_wall_cooling& cooling
) const
{
    const scalar coefficient = coefficient_[patchi][facei];
    // What lands carries no vapour
    if (cooling.vapour_coefficient == 0)
    {
        cooling.vapour_coefficient = cooling.gas_coefficient;
    }
    cooling.gas_coefficient += coefficient;
    cooling.further_flux +=
        given_[patchi][facei] - coefficient*cooling.gas_temperature;
}


void Foam::nearWall::wallHeat::add
(
    const label patchi,
    const label facei,
    const nw_wall_cooling& cooling,
    const nw_deposit_losses& crossed,
    const scalar time
)
{
    if (!started_) return;

    const scalar T = surfaceThatTakes
    (
        cooling, crossed.heat_taken/time, cooling.other_temperature
    );
    const label i = place(patchi);
    const scalar area = mesh_.magSf().boundaryField()[patchi][facei];
    scalar& capacity = capacity_.boundaryFieldRef()[patchi][facei];
    scalar& enthalpy = enthalpy_.boundaryFieldRef()[patchi][facei];
    scalar& taken = taken_.boundaryFieldRef()[patchi][facei];
    const scalar brought = share_[i]*(enthalpy - capacity*T);
    capacity -= share_[i]*capacity;
    enthalpy -= share_[i]*enthalpy;
    flux_.boundaryFieldRef()[patchi][facei] = brought/time;
    lag_.boundaryFieldRef()[patchi][facei] +=
        taken + brought - crossed.heat_taken;
    taken = 0;
    sums_.add(i, particles, area*brought);
    sums_.add(i, condensation, area*crossed.heat_released);
    sums_.add(i, coolant, area*crossed.heat_to_coolant);
    sums_.add(i, melting, area*crossed.heat_of_fusion);
}


void Foam::nearWall::wallHeat::reportPatch
(
    Ostream& os,
    const label i,
    const scalarList& totals,
    const scalar lagging,
    const scalar waiting,
    const scalar time,
    const bool writeRow
)
{
    const scalar in =
        totals[gas] + totals[radiation] + totals[particles]
      + totals[condensation];
    const scalar out = totals[coolant] + totals[melting] + lagging;
    const scalar all = max
    (
        mag(totals[gas]) + mag(totals[radiation]) + mag(totals[particles])
      + mag(totals[condensation]),
        mag(totals[coolant]) + mag(totals[melting])
    );
    const scalar residual = all > 0 ? (in - out)/all : 0;
    if (all > 0)
    {
        os  << "        " << sums_[i].name() << ", heat [J]: gas " << totals[gas]
            << " + radiation " << totals[radiation] << " + particles "
            << totals[particles] << " + condensation "
            << totals[condensation] << " = coolant " << totals[coolant]
            << " + melting " << totals[melting] << " + lagging " << lagging
            << "; relative residual " << residual << nl;
    }
    if (!writeRow) return;

    tableRow row;
    row.add("time_s", time);
    for (label t = 0; t < nTerms; ++t) row.add(names[t], totals[t]);
    row.add("lagging_J", lagging);
    row.add("waiting_J", waiting);
    row.add("residual", residual);
    sums_.table(i).write(row);
}


Foam::dictionary Foam::nearWall::wallHeat::report
(
    Ostream& os,
    const depositFields& fields,
    const scalar time,
    const bool writeRow
)
{
    if (patches_.empty()) return dictionary();

    started_ = true;
    const label n = patches_.size();
    scalarList sums(2*n, scalar(0));
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const scalarField& area = mesh_.magSf().boundaryField()[patchi];
        const scalarField& T = fields.on(depositFields::temperature, patchi);
        sums[i] = sum
        (
            area
           *(lag_.boundaryField()[patchi] + taken_.boundaryField()[patchi])
        );
        sums[n + i] = sum
        (
            area
           *(
                enthalpy_.boundaryField()[patchi]
              - T*capacity_.boundaryField()[patchi]
            )
        );
    }
    sumOverRanks(sums);
    const List<scalarList> totals(sums_.totals());
    forAll(patches_, i)
    {
        reportPatch(os, i, totals[i], sums[i], sums[n + i], time, writeRow);
    }
    return sums_.saved(totals);
}
