// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "massBalance.H"
#include "versionCompat.H"

#include <cstdio>

namespace
{

using namespace Foam;

//- Names of the terms, in their order: keys of a restart and columns
const wordList names
({
    "injected_kg", "read_back_kg", "stuck_removed_kg", "escaped_kg",
    "reacted_kg", "unusable_removed_kg", "in_cloud_kg"
});


std::string digits(const scalar x)
{
    char text[40];
    std::snprintf(text, sizeof(text), "%.15g", x);
    return text;
}

} // End anonymous namespace


Foam::nearWall::massBalance::massBalance
(
    const dictionary& saved,
    const fileName& folder,
    const scalar injectorsAtStart
)
:
    sums_(names, saved),
    table_(folder/"balance.dat"),
    injectorsAtStart_(injectorsAtStart)
{}


void Foam::nearWall::massBalance::start(const scalar mass)
{
    started_ = true;
    add(readBack, mass);

    // All ranks know the mass that was written; one of them subtracts it
    if (Pstream::master()) add(readBack, -sums_.base()[inCloud]);
}


Foam::scalarList Foam::nearWall::massBalance::totals
(
    const scalar injectors,
    const content& onThisRank,
    content& onAllRanks
) const
{
    scalarList sums(sums_.added());
    const label n = sums.size();
    sums.append(onThisRank.airborne);
    sums.append(onThisRank.stuck);
    sumOverRanks(sums);

    onAllRanks.airborne = sums[n];
    onAllRanks.stuck = sums[n + 1];
    sums.setSize(n);

    forAll(sums, i) sums[i] += sums_.base()[i];
    sums[injected] = sums_.base()[injected] + (injectors - injectorsAtStart_);
    sums[inCloud] = onAllRanks.airborne + onAllRanks.stuck;
    return sums;
}


Foam::scalar Foam::nearWall::massBalance::residual
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


void Foam::nearWall::massBalance::report
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


void Foam::nearWall::massBalance::writeRow
(
    const scalar time,
    const scalarList& t,
    const content& now,
    const scalar parcels
)
{
    tableRow row;
    row.add("time_s", time);
    for (const term i : {injected, readBack}) row.add(names[i], t[i]);
    row.add("airborne_kg", now.airborne);
    row.add("stuck_in_cloud_kg", now.stuck);
    for (const term i : {stuckRemoved, escaped, reacted, unusableRemoved})
    {
        row.add(names[i], t[i]);
    }
    row.add("injected_parcels", parcels);
    row.add("residual", residual(t, now));
    table_.write(row);
}
