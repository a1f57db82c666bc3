// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallStay.H"
#include "versionCompat.H"
#include "volFields.H"

Foam::nearWall::nearWallStay::nearWallStay(const statisticsSource& source)
:
    mesh_(source.mesh)
{
    const dictionary saved(source.savedAs("nearWallStay"));
    const wordList names({"mass_time_kg_s", "volume_time_m3_s", "since_s"});
    forAll(source.rules(), patchi)
    {
        const patchRule::ruleType type = source.rules()[patchi].type;
        if (type == patchRule::pass || type == patchRule::escape) continue;

        patches_.append(patchi);
        const word& name = patchesOf(mesh_)[patchi].name();
        sums_.append(runningTotals(names, saved.subOrEmptyDict(name), name));
        tables_.emplace_back(source.folder/(name + ".nearWall.dat"));
    }
    findCells();
}


void Foam::nearWall::nearWallStay::findCells()
{
    first_.setSize(mesh_.nCells());
    first_ = -1;
    walls_.clear();
    next_.clear();
    volumes_.setSize(patches_.size());
    volumes_ = 0;
    forAll(patches_, wall)
    {
        for (const label celli : mesh_.boundary()[patches_[wall]].faceCells())
        {
            addCell(celli, wall);
        }
    }
}


void Foam::nearWall::nearWallStay::addCell(const label celli, const label wall)
{
    // Walls come in turn, so a cell's first place is its latest wall
    const label known = first_[celli];
    if (known >= 0 && walls_[known] == wall) return;

    first_[celli] = walls_.size();
    walls_.append(wall);
    next_.append(known);
    volumes_[wall] += mesh_.V()[celli];
}


void Foam::nearWall::nearWallStay::beginStep(const scalar duration)
{
    if (mesh_.changing()) findCells();
    forAll(sums_, wall)
    {
        sums_[wall].add(volumeTime, volumes_[wall]*duration);
        if (Pstream::master()) sums_[wall].add(time, duration);
    }
}


Foam::dictionary Foam::nearWall::nearWallStay::write(const scalar injectedMass)
{
    const List<scalarList> totals(runningTotals::totals(sums_));
    forAll(totals, wall)
    {
        const scalarList& t = totals[wall];
        const scalar seconds = max(t[time], VSMALL);
        const scalar volume = t[volumeTime]/seconds;
        tableRow row;
        row.add("time_s", mesh_.time().value());
        row.add("mean_mass_kg", t[massTime]/seconds);
        row.add("volume_m3", volume);
        row.add
        (
            "concentration_kg_m3",
            volume > 0 ? t[massTime]/t[volumeTime] : 0
        );
        row.add
        (
            "residence_s", injectedMass > 0 ? t[massTime]/injectedMass : 0
        );
        tables_[wall].write(row);
    }
    return runningTotals::saved(sums_, totals);
}
