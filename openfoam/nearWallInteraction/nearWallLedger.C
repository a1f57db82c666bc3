/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallLedger.H.
\*---------------------------------------------------------------------------*/

#include "nearWallLedger.H"
#include "nearWallCompat.H"
#include "OSspecific.H"

#include <cmath>
#include <cstdio>
#include <cstdlib>

std::string Foam::nearWall::exactText(const scalar x)
{
    char text[40];

    // Counts, and much else: no need to try. isless() is quiet about NaN.
    if
    (
        std::isless(std::fabs(x), 1e9)
     && x == std::floor(x)
     && !std::signbit(x)
    )
    {
        return std::to_string(static_cast<long>(x));
    }
    for (int digits = 15; digits <= 17; ++digits)
    {
        std::snprintf(text, sizeof(text), "%.*g", digits, x);
        if (std::atof(text) == x) break;
    }
    return text;
}


Foam::nearWall::ledger::ledger(const wordList& names)
:
    names_(names),
    base_(names.size(), scalar(0)),
    added_(names.size(), scalar(0))
{}


void Foam::nearWall::ledger::load(const dictionary& dict)
{
    forAll(names_, i)
    {
        if (dict.found(names_[i]))
        {
            base_[i] =
                std::atof(nearWall::read<string>(dict, names_[i]).c_str());
        }
    }
}


Foam::dictionary Foam::nearWall::ledger::saved(const scalarList& totals) const
{
    dictionary dict;
    forAll(names_, i)
    {
        dict.add(keyType(names_[i]), string(exactText(totals[i])), true);
    }
    return dict;
}


Foam::List<Foam::scalarList> Foam::nearWall::totals
(
    const UList<ledger>& ledgers
)
{
    label n = 0;
    forAll(ledgers, i) n += ledgers[i].added().size();

    scalarList all(n);
    n = 0;
    forAll(ledgers, i)
    {
        forAll(ledgers[i].added(), j) all[n++] = ledgers[i].added()[j];
    }

    sumOverRanks(all);

    List<scalarList> sums(ledgers.size());
    n = 0;
    forAll(ledgers, i)
    {
        sums[i] = ledgers[i].base();
        forAll(sums[i], j) sums[i][j] += all[n++];
    }
    return sums;
}


Foam::nearWall::table::table(const fileName& path, const wordList& columns)
:
    path_(path),
    columns_(columns)
{}


void Foam::nearWall::table::row(const scalarList& values)
{
    if (!Pstream::master()) return;

    std::vector<std::string> cells;
    cells.reserve(values.size());
    forAll(values, i) cells.push_back(exactText(values[i]));
    row(cells);
}


void Foam::nearWall::table::row(const std::vector<std::string>& cells)
{
    if (!Pstream::master()) return;

    if (!file_)
    {
        mkDir(path_.path());
        file_.reset(new OFstream(path_));
        *file_ << "#";
        forAll(columns_, i) *file_ << ' ' << columns_[i].c_str();
        *file_ << nl;
    }

    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        *file_ << (i ? " " : "") << cells[i].c_str();
    }
    *file_ << endl;
}
