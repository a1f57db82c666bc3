/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallTally.H.
\*---------------------------------------------------------------------------*/

#include "nearWallTally.H"

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- Names of the ledger's columns: also what a restart looks for
wordList columnNames()
{
    wordList names(tally::nColumns);
    names[tally::hits] = "hits";
    names[tally::hitParticles] = "hit_particles";
    names[tally::hitMass] = "hit_mass_kg";
    names[tally::rebounds] = "rebounds";
    names[tally::reboundMass] = "rebound_mass_kg";
    names[tally::sticks] = "sticks";
    names[tally::stickParticles] = "stick_particles";
    names[tally::stickMass] = "stick_mass_kg";
    names[tally::escapes] = "escapes";
    names[tally::escapeMass] = "escape_mass_kg";
    names[tally::unusable] = "unusable";
    names[tally::unusableMass] = "unusable_mass_kg";
    names[tally::speedSum] = "impact_speed_sum_m_s";
    names[tally::normalSpeedSum] = "normal_speed_sum_m_s";
    names[tally::enSum] = "e_n_sum";
    names[tally::enSquareSum] = "e_n2_sum";
    names[tally::egSum] = "e_g_sum";

    for (label r = 0; r < 4; ++r)
    {
        const word regime(nw_regime_name(nw_regime(r)));
        names[tally::regimeSticks + r] = "sticks_" + regime;
        names[tally::regimeMass + r] = "stick_mass_" + regime + "_kg";
    }
    for (label b = 0; b < 10; ++b)
    {
        names[tally::conversionMass + b] =
            "stick_mass_conversion_0." + Foam::name(b) + "_kg";
    }
    names[tally::outsideRange] = "outside_range";
    return names;
}


//- The table adds the time in front and two efficiencies before the last
wordList tableColumns()
{
    const wordList own(columnNames());
    DynamicList<word> names;
    names.append("time_s");
    for (label i = 0; i < tally::outsideRange; ++i) names.append(own[i]);
    names.append("capture_by_particles");
    names.append("capture_by_mass");
    names.append(own[tally::outsideRange]);
    return wordList(names);
}


scalar ratio(const scalar part, const scalar whole)
{
    return whole > 0 ? part/whole : 0;
}


label conversionBin(const scalar conversion)
{
    return max(label(0), min(label(9), label(10*conversion)));
}


scalarList tableRow(const scalar time, const scalarList& t)
{
    DynamicList<scalar> row;
    row.append(time);
    for (label i = 0; i < tally::outsideRange; ++i) row.append(t[i]);
    row.append(ratio(t[tally::stickParticles], t[tally::hitParticles]));
    row.append(ratio(t[tally::stickMass], t[tally::hitMass]));
    row.append(t[tally::outsideRange]);
    return scalarList(row);
}


void reportPatch(Ostream& os, const word& name, const scalarList& t)
{
    os  << "        " << name << ": hits " << t[tally::hits]
        << " (" << t[tally::hitMass] << " kg)";
    if (t[tally::rebounds]) os << ", rebounds " << t[tally::rebounds];
    if (t[tally::sticks])
    {
        os  << ", sticks " << t[tally::sticks]
            << " (" << t[tally::stickMass] << " kg, captured "
            << 100*ratio(t[tally::stickMass], t[tally::hitMass])
            << " % of mass)";
    }
    if (t[tally::escapes])
    {
        os  << ", escapes " << t[tally::escapes]
            << " (" << t[tally::escapeMass] << " kg)";
    }
    if (t[tally::unusable])
    {
        os  << ", unusable " << t[tally::unusable]
            << " (" << t[tally::unusableMass] << " kg)";
    }
    if (t[tally::outsideRange])
    {
        os  << ", outside the model's stated range " << t[tally::outsideRange];
    }
    os  << nl;
}

} // End anonymous namespace


Foam::nearWall::tally::tally
(
    const fvMesh& mesh,
    const patchRules& rules,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    ledgerOf_(rules.size(), label(-1))
{
    const wordList names(columnNames());
    DynamicList<label> ours;
    forAll(rules, patchi)
    {
        if (rules[patchi].what != fate::pass)
        {
            ledgerOf_[patchi] = ours.size();
            ours.append(patchi);
        }
    }
    patches_ = ours;

    ledgers_.setSize(patches_.size());
    written_.setSize(patches_.size());
    forAll(patches_, i)
    {
        const word& name = mesh.boundaryMesh()[patches_[i]].name();
        ledgers_[i] = ledger(names);
        ledgers_[i].load(saved.subOrEmptyDict(name));
        tables_.emplace_back(folder/(name + ".dat"), tableColumns());
    }
}


void Foam::nearWall::tally::hit(const event& e)
{
    add(e.patch, hits, 1);
    add(e.patch, hitParticles, e.particles);
    add(e.patch, hitMass, e.mass);
    add(e.patch, speedSum, e.speed);
    add(e.patch, normalSpeedSum, e.arrived.v_n);
    if (e.outsideRange) add(e.patch, outsideRange, 1);
}


void Foam::nearWall::tally::addRebound(const event& e)
{
    hit(e);
    add(e.patch, rebounds, 1);
    add(e.patch, reboundMass, e.mass);
    add(e.patch, enSum, e.en);
    add(e.patch, enSquareSum, sqr(e.en));
    add(e.patch, egSum, e.eg);
}


void Foam::nearWall::tally::addStick(const event& e)
{
    hit(e);
    add(e.patch, sticks, 1);
    add(e.patch, stickParticles, e.particles);
    add(e.patch, stickMass, e.mass);
    if (e.regime >= 0)
    {
        add(e.patch, regimeSticks + e.regime, 1);
        add(e.patch, regimeMass + e.regime, e.mass);
    }
    add(e.patch, conversionMass + conversionBin(e.arrived.conversion), e.mass);
}


void Foam::nearWall::tally::addEscape(const event& e)
{
    hit(e);
    add(e.patch, escapes, 1);
    add(e.patch, escapeMass, e.mass);
}


void Foam::nearWall::tally::addUnusable(const event& e)
{
    hit(e);
    add(e.patch, unusable, 1);
    add(e.patch, unusableMass, e.mass);
}


Foam::dictionary Foam::nearWall::tally::saved
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


void Foam::nearWall::tally::report
(
    Ostream& os,
    const List<scalarList>& totals
) const
{
    os  << "    Near-wall impacts since the start of the case" << nl;
    forAll(patches_, i)
    {
        if (totals[i][hits])
        {
            reportPatch
            (
                os,
                mesh_.boundaryMesh()[patches_[i]].name(),
                totals[i]
            );
        }
    }
}


void Foam::nearWall::tally::writeRows
(
    const scalar time,
    const List<scalarList>& totals
)
{
    forAll(totals, i)
    {
        if (totals[i] != written_[i])
        {
            written_[i] = totals[i];
            tables_[i].row(tableRow(time, totals[i]));
        }
    }
}


Foam::scalar Foam::nearWall::tally::sum
(
    const List<scalarList>& totals,
    const label column
)
{
    scalar s = 0;
    forAll(totals, i) s += totals[i][column];
    return s;
}
