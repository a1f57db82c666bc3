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
    "gas_J", "radiation_J", "particles_J", "coolant_J", "melting_J", "landed",
    "duration_s"
});


//- Parcels for which a face that is hit waits in tau
const scalar smoothedParcels = 20;

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
    held_(readWallField(mesh, cloudName + ":heldHeat", dimEnergy/dimArea)),
    lag_(readWallField(mesh, cloudName + ":laggingHeat", dimEnergy/dimArea)),
    flux_
    (
        readWallField(mesh, cloudName + ":particleHeatFlux", dimPower/dimArea)
    ),
    started_(!saved.empty()),
    taken_(patchesOf(mesh).size()),
    share_(patches.size(), scalar(1))
{
    added_.resize(patches_.size(), std::vector<kahanSum>(nTerms));
    for (const label patchi : patches_)
    {
        const word& name = patchesOf(mesh)[patchi].name();
        sums_.append(runningTotals(names, saved.subOrEmptyDict(name), name));
        tables_.emplace_back(folder/(name + ".heat.dat"));
        taken_[patchi].setSize(patchesOf(mesh)[patchi].size(), 0);
    }
}


void Foam::nearWall::wallHeat::add
(
    const label i,
    const label t,
    const scalar value
)
{
    const scalar added = added_[i][t].add(value);
    sums_[i].add(t, added - sums_[i].added()[t]);
}


void Foam::nearWall::wallHeat::addCaptured
(
    const label patchi,
    const label facei,
    const scalar heat
)
{
    forAll(patches_, i)
    {
        if (patches_[i] != patchi) continue;

        held_.boundaryFieldRef()[patchi][facei] += heat;
        add(i, particles, heat*mesh_.magSf().boundaryField()[patchi][facei]);
        add(i, landed, 1);
    }
}


void Foam::nearWall::wallHeat::beginStep(const scalar flow)
{
    const label n = patches_.size();
    scalarList sums(2*n, scalar(0));
    forAll(patches_, i)
    {
        for (const scalar held : held_.boundaryField()[patches_[i]])
        {
            sums[i] += held != 0;
        }
        if (Pstream::master()) add(i, duration, flow);
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


void Foam::nearWall::wallHeat::beginPatch
(
    const label patchi,
    const wallCooling& condition,
    const scalar before,
    const scalar time
)
{
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    const scalarField fromGas(before*condition.fromGas());
    const scalarField fromRadiation(before*condition.fromRadiation());
    const scalarField& held = held_.boundaryField()[patchi];
    const scalarField& lag = lag_.boundaryField()[patchi];
    scalarField& flux = flux_.boundaryFieldRef()[patchi];
    forAll(patches_, i)
    {
        if (patches_[i] != patchi || !started_) continue;

        taken_[patchi] = fromGas + fromRadiation;
        flux = (share_[i]*held + lag)/time;
        add(i, gas, sum(fromGas*area));
        add(i, radiation, sum(fromRadiation*area));
    }
}


void Foam::nearWall::wallHeat::add
(
    const label patchi,
    const label facei,
    const nw_deposit_losses& crossed
)
{
    if (!started_) return;

    forAll(patches_, i)
    {
        if (patches_[i] != patchi) continue;

        const scalar area = mesh_.magSf().boundaryField()[patchi][facei];
        scalar& held = held_.boundaryFieldRef()[patchi][facei];
        scalar& lag = lag_.boundaryFieldRef()[patchi][facei];
        const scalar passedOn = share_[i]*held;
        held -= passedOn;
        lag += taken_[patchi][facei] + passedOn - crossed.heat_taken;
        add(i, coolant, area*crossed.heat_to_coolant);
        add(i, melting, area*crossed.heat_of_fusion);
    }
}


void Foam::nearWall::wallHeat::reportPatch
(
    Ostream& os,
    const label i,
    const scalarList& totals,
    const scalar held,
    const scalar time,
    const bool writeRow
)
{
    const scalar in = totals[gas] + totals[radiation] + totals[particles];
    const scalar out = totals[coolant] + totals[melting] + held;
    const scalar all = max
    (
        mag(totals[gas]) + mag(totals[radiation]) + mag(totals[particles]),
        mag(totals[coolant]) + mag(totals[melting])
    );
    const scalar residual = all > 0 ? (in - out)/all : 0;
    if (all > 0)
    {
        os  << "        " << sums_[i].name() << ", heat [J]: gas " << totals[gas]
            << " + radiation " << totals[radiation] << " + particles "
            << totals[particles] << " = coolant " << totals[coolant]
            << " + melting " << totals[melting] << " + held " << held
            << "; relative residual " << residual << nl;
    }
    if (!writeRow) return;

    tableRow row;
    row.add("time_s", time);
    for (label t = 0; t < nTerms; ++t) row.add(names[t], totals[t]);
    row.add("held_J", held);
    row.add("residual", residual);
    tables_[i].write(row);
}


Foam::dictionary Foam::nearWall::wallHeat::report
(
    Ostream& os,
    const scalar time,
    const bool writeRow
)
{
    started_ = true;
    scalarList held(patches_.size(), scalar(0));
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const scalarField& area = mesh_.magSf().boundaryField()[patchi];
        held[i] = sum
        (
            area
           *(held_.boundaryField()[patchi] + lag_.boundaryField()[patchi])
        );
    }
    sumOverRanks(held);
    const List<scalarList> totals(runningTotals::totals(sums_));
    forAll(patches_, i)
    {
        reportPatch(os, i, totals[i], held[i], time, writeRow);
    }
    return runningTotals::saved(sums_, totals);
}
