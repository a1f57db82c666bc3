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
    "reacted_kg", "unusable_removed_kg", "to_film_kg", "in_cloud_kg"
});


std::string digits(const scalar x)
{
    char text[40];
    std::snprintf(text, sizeof(text), "%.15g", x);
    return text;
}

} // End anonymous namespace


Foam::nearWall::massBalance::massBalance(const statisticsSource& source)
:
    sums_(names, source.savedAs("balance")),
    table_(source.folder/"balance.dat"),
    injectorsAtStart_(source.injectedMass)
{}


void Foam::nearWall::massBalance::start(const scalar mass)
{
    started_ = true;
    add(readBack, mass);

    // All ranks know the mass that was written; one of them subtracts it
    if (Pstream::master()) add(readBack, -sums_.base()[inCloud]);
}


Foam::nearWall::massBalance::state Foam::nearWall::massBalance::now
(
    const content& onThisRank
) const
{
    scalarList sums(sums_.added());
    const label n = sums.size();
    sums.append(onThisRank.airborne);
    sums.append(onThisRank.stuck);
    sumOverRanks(sums);

    state s;
    s.now = onThisRank;
    s.now.airborne = sums[n];
    s.now.stuck = sums[n + 1];
    sums.setSize(n);

    const scalarList& base = sums_.base();
    forAll(sums, i) sums[i] += base[i];
    sums[injected] = base[injected] + (s.now.injected - injectorsAtStart_);
    sums[inCloud] = s.now.airborne + s.now.stuck;
    s.totals = sums;
    return s;
}


Foam::scalar Foam::nearWall::massBalance::state::residual() const
{
    const scalarList& t = totals;
    const scalar in = t[injected] + t[readBack];
    const scalar out =
        now.airborne + now.stuck + t[stuckRemoved] + t[escaped] + t[reacted]
      + t[unusableRemoved] + t[toFilm];
    return in > 0 ? (in - out)/in : 0;
}


void Foam::nearWall::massBalance::report(Ostream& os, const state& s) const
{
    const scalarList& t = s.totals;
    os  << "    Near-wall mass balance [kg]: injected "
        << digits(t[injected]).c_str();
    if (t[readBack] != 0)
    {
        os  << " + read back " << digits(t[readBack]).c_str();
    }
    os  << " = airborne " << digits(s.now.airborne).c_str()
        << " + stuck " << digits(s.now.stuck + t[stuckRemoved]).c_str()
        << " + escaped " << digits(t[escaped]).c_str()
        << " + reacted " << digits(t[reacted]).c_str();
    if (t[unusableRemoved] != 0)
    {
        os  << " + unusable " << digits(t[unusableRemoved]).c_str();
    }
    if (t[toFilm] != 0)
    {
        os  << " + to the film " << digits(t[toFilm]).c_str();
    }
    os  << "; relative residual " << s.residual() << nl;
}


void Foam::nearWall::massBalance::writeRow(const scalar time, const state& s)
{
    tableRow row;
    row.add("time_s", time);
    for (const term i : {injected, readBack}) row.add(names[i], s.totals[i]);
    row.add("airborne_kg", s.now.airborne);
    row.add("stuck_in_cloud_kg", s.now.stuck);
    for
    (
        const term i : {stuckRemoved, escaped, reacted, unusableRemoved, toFilm}
    )
    {
        row.add(names[i], s.totals[i]);
    }
    row.add("injected_parcels", s.now.parcels);
    row.add("residual", s.residual());
    table_.write(row);
}
