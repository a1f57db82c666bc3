/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallBalance.H.
\*---------------------------------------------------------------------------*/

#include "nearWallBalance.H"
#include "nearWallCompat.H"

#include <cstdio>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

wordList columnNames()
{
    wordList names(balance::nColumns);
    names[balance::injected] = "injected_kg";
    names[balance::readBack] = "read_back_kg";
    names[balance::stuckRemoved] = "stuck_removed_kg";
    names[balance::escaped] = "escaped_kg";
    names[balance::reacted] = "reacted_kg";
    names[balance::unusableRemoved] = "unusable_removed_kg";
    names[balance::inCloud] = "in_cloud_kg";
    return names;
}


wordList tableColumns()
{
    return wordList
    ({
        "time_s", "injected_kg", "read_back_kg", "airborne_kg",
        "stuck_in_cloud_kg", "stuck_removed_kg", "escaped_kg", "reacted_kg",
        "unusable_removed_kg", "residual"
    });
}


std::string digits(const scalar x)
{
    char text[40];
    std::snprintf(text, sizeof(text), "%.15g", x);
    return text;
}

} // End anonymous namespace


Foam::nearWall::balance::balance
(
    const dictionary& saved,
    const fileName& folder,
    const scalar injectorsAtStart
)
:
    ledger_(columnNames()),
    table_(folder/"balance.dat", tableColumns()),
    injectorsAtStart_(injectorsAtStart)
{
    ledger_.load(saved);
}


void Foam::nearWall::balance::start(const scalar mass)
{
    started_ = true;

    // The written mass is the same number on all ranks: one subtracts it
    add(readBack, mass);
    if (Pstream::master())
    {
        add(readBack, -ledger_.base()[inCloud]);
    }
}


Foam::scalarList Foam::nearWall::balance::totals
(
    const scalar injectors,
    const content& onThisRank,
    content& onAllRanks
) const
{
    scalarList sums(ledger_.added());
    sums.append(onThisRank.airborne);
    sums.append(onThisRank.stuck);
    sumOverRanks(sums);

    onAllRanks.airborne = sums[nColumns];
    onAllRanks.stuck = sums[nColumns + 1];
    sums.setSize(nColumns);

    forAll(sums, i) sums[i] += ledger_.base()[i];
    sums[injected] =
        ledger_.base()[injected] + (injectors - injectorsAtStart_);
    sums[inCloud] = onAllRanks.airborne + onAllRanks.stuck;
    return sums;
}


Foam::scalar Foam::nearWall::balance::residual
(
    const scalarList& t,
    const content& now
)
{
    const scalar in = t[injected] + t[readBack];
    const scalar out =
        now.airborne + now.stuck + t[stuckRemoved] + t[escaped] + t[reacted]
      + t[unusableRemoved];
    return in > 0 ? (in - out)/in : 0;
}


void Foam::nearWall::balance::report
(
    Ostream& os,
    const scalarList& t,
    const content& now
) const
{
    os  << "    Near-wall mass balance [kg]: injected "
        << digits(t[injected]).c_str();
    if (t[readBack] != 0)
    {
        os  << " + read back " << digits(t[readBack]).c_str();
    }
    os  << " = airborne " << digits(now.airborne).c_str()
        << " + stuck " << digits(now.stuck + t[stuckRemoved]).c_str()
        << " + escaped " << digits(t[escaped]).c_str()
        << " + reacted " << digits(t[reacted]).c_str();
    if (t[unusableRemoved] != 0)
    {
        os  << " + unusable " << digits(t[unusableRemoved]).c_str();
    }
    os  << "; relative residual " << residual(t, now) << nl;
}


void Foam::nearWall::balance::writeRow
(
    const scalar time,
    const scalarList& t,
    const content& now
)
{
    const scalar row[] =
    {
        time, t[injected], t[readBack], now.airborne, now.stuck,
        t[stuckRemoved], t[escaped], t[reacted], t[unusableRemoved],
        residual(t, now)
    };
    scalarList values(sizeof(row)/sizeof(row[0]));
    forAll(values, i) values[i] = row[i];
    table_.row(values);
}


Foam::dictionary Foam::nearWall::balance::saved
(
    const scalarList& totals
) const
{
    return ledger_.saved(totals);
}
