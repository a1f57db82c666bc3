/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallStatistics.H.
\*---------------------------------------------------------------------------*/

#include "nearWallStatistics.H"
#include "surfaceFields.H"
#include "unitConversion.H"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <utility>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- The classes of one quantity
struct classes
{
    std::string quantity;

    //- Their lower ends; the last one's upper end is `top`
    std::vector<scalar> low;
    scalar top;

    scalar high(const std::size_t i) const
    {
        return i + 1 < low.size() ? low[i + 1] : top;
    }
};


//- From 0 to the lowest decade, 8 classes a decade, and what lies above
classes logarithmic
(
    const std::string& quantity,
    const label lowest,
    const label highest
)
{
    const label perDecade = 8;
    classes c{quantity, {0}, std::numeric_limits<scalar>::infinity()};
    for (label i = lowest*perDecade; i <= highest*perDecade; ++i)
    {
        // A whole decade as the number that one writes for it
        c.low.push_back
        (
            i % perDecade
          ? std::pow(10.0, scalar(i)/perDecade)
          : std::atof(("1e" + std::to_string(i/perDecade)).c_str())
        );
    }
    return c;
}


classes ofAngle()
{
    classes c{"angle_deg", {}, 90};
    for (label i = 0; i < 18; ++i) c.low.push_back(5*i);
    return c;
}


//- All quantities, in the order in which a ledger holds their classes
const std::vector<classes>& quantities()
{
    static const std::vector<classes> all
    {
        logarithmic("speed_m_s", -3, 3),
        ofAngle(),
        logarithmic("diameter_m", -8, -2)
    };
    return all;
}


std::size_t classOf(const classes& c, const scalar x)
{
    const auto above = std::upper_bound(c.low.begin(), c.low.end(), x);
    return above == c.low.begin() ? 0 : above - c.low.begin() - 1;
}


wordList columnNames()
{
    wordList names(statistics::nColumns);
    names[statistics::hits] = "hits";
    names[statistics::particles] = "particles";
    names[statistics::particlesSquared] = "particles_squared";
    names[statistics::mass] = "mass_kg";
    names[statistics::sticks] = "sticks";
    names[statistics::stickParticles] = "stick_particles";
    names[statistics::stickMass] = "stick_mass_kg";
    names[statistics::energyIn] = "energy_in_J";
    names[statistics::energyOut] = "energy_out_J";
    return names;
}


//- Names of a ledger's columns: all columns of the first class, of the next ...
const wordList& ledgerNames()
{
    static wordList names;
    if (names.empty())
    {
        DynamicList<word> all;
        const wordList columns(columnNames());
        for (const classes& c : quantities())
        {
            for (std::size_t i = 0; i < c.low.size(); ++i)
            {
                for (const word& column : columns)
                {
                    all.append(c.quantity + "_" + std::to_string(i) + "_" + column);
                }
            }
        }
        names = all;
    }
    return names;
}


wordList distributionColumns()
{
    wordList names({"time_s", "injector", "quantity", "low", "high"});
    names.append(columnNames());
    return names;
}


wordList fluxColumns()
{
    return wordList
    ({
        "time_s", "since_s", "injector", "area_m2",
        "mass_flux_kg_m2_s", "stick_mass_flux_kg_m2_s"
    });
}


//- A ledger is saved under its patch and this
const std::string savedAs = "injector";

word keyOf(const label injector)
{
    return savedAs + Foam::name(injector);
}


//- Sum of a column over all classes of the first quantity
scalar columnSum(const scalarList& totals, const label column)
{
    scalar s = 0;
    for (std::size_t i = 0; i < quantities().front().low.size(); ++i)
    {
        s += totals[i*statistics::nColumns + column];
    }
    return s;
}

} // End anonymous namespace


Foam::nearWall::statistics::statistics
(
    const fvMesh& mesh,
    const injectorNames& injectors,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    injectors_(injectors),
    folder_(folder),
    loaded_(saved),
    latest_(-1),
    lastTime_(mesh.time().value())
{
    forAll(mesh.boundaryMesh(), patchi)
    {
        const dictionary ofPatch
        (
            saved.subOrEmptyDict(mesh.boundaryMesh()[patchi].name())
        );
        for (const word& key : ofPatch.toc())
        {
            open(patchi, std::atoi(key.c_str() + savedAs.size()));
        }
    }
    gatherBooks();
    written_ = nearWall::totals(ledgers_);
}


Foam::label Foam::nearWall::statistics::find
(
    const label patchi,
    const label injector
) const
{
    forAll(ledgers_, i)
    {
        if (patchOf_[i] == patchi && injectorOf_[i] == injector) return i;
    }
    return -1;
}


Foam::label Foam::nearWall::statistics::open
(
    const label patchi,
    const label injector
)
{
    const label known = find(patchi, injector);
    if (known >= 0) return known;

    patchOf_.append(patchi);
    injectorOf_.append(injector);
    ledgers_.append(ledger(ledgerNames()));
    written_.append(scalarList(ledgerNames().size(), scalar(0)));

    const label book = ledgers_.size() - 1;
    const dictionary ofPatch(loaded_.subOrEmptyDict(patchName(book)));
    ledgers_[book].load(ofPatch.subOrEmptyDict(keyOf(injector)));
    return book;
}


const Foam::word& Foam::nearWall::statistics::patchName(const label book) const
{
    return mesh_.boundaryMesh()[patchOf_[book]].name();
}


void Foam::nearWall::statistics::add(const event& e)
{
    // Nothing can be said of what is not a number
    if (!std::isfinite(e.speed) || !std::isfinite(e.mass)) return;

    if
    (
        latest_ < 0
     || patchOf_[latest_] != e.patch
     || injectorOf_[latest_] != e.injector
    )
    {
        latest_ = open(e.patch, e.injector);
    }

    const scalar arriving = 0.5*e.mass*sqr(e.speed);
    scalar values[nColumns];
    values[hits] = 1;
    values[particles] = e.particles;
    values[particlesSquared] = sqr(e.particles);
    values[mass] = e.mass;
    values[sticks] = e.stuck;
    values[stickParticles] = e.stuck ? e.particles : 0;
    values[stickMass] = e.stuck ? e.mass : 0;
    values[energyIn] = arriving;
    values[energyOut] = e.stuck ? 0 : arriving*sqr(e.eg);

    const scalar of[3] =
    {
        e.speed,
        radToDeg(std::atan2(e.arrived.v_n, e.arrived.v_t)),
        e.arrived.d
    };

    ledger& book = ledgers_[latest_];
    label first = 0;
    for (label q = 0; q < 3; ++q)
    {
        const classes& c = quantities()[q];
        const label at = first + nColumns*label(classOf(c, of[q]));
        for (label i = 0; i < nColumns; ++i) book.add(at + i, values[i]);
        first += nColumns*label(c.low.size());
    }
}


void Foam::nearWall::statistics::gatherBooks()
{
    List<labelList> known(Pstream::nProcs());
    labelList& own = known[Pstream::myProcNo()];
    forAll(ledgers_, i)
    {
        own.append(patchOf_[i]);
        own.append(injectorOf_[i]);
    }
    Pstream::gatherList(known);
    Pstream::scatterList(known);

    std::set<std::pair<label, label>> all;
    for (const labelList& list : known)
    {
        for (label i = 0; i < list.size(); i += 2)
        {
            all.insert(std::make_pair(list[i], list[i + 1]));
        }
    }

    labelList order;
    for (const auto& book : all) order.append(open(book.first, book.second));

    patchOf_ = labelList(UIndirectList<label>(patchOf_, order));
    injectorOf_ = labelList(UIndirectList<label>(injectorOf_, order));
    ledgers_ = List<ledger>(UIndirectList<ledger>(ledgers_, order));
    written_ = List<scalarList>(UIndirectList<scalarList>(written_, order));
    latest_ = -1;
}


void Foam::nearWall::statistics::writeDistributions
(
    const label book,
    const scalar time,
    const scalarList& totals
)
{
    const label patchi = patchOf_[book];
    const auto place = distributions_.emplace
    (
        patchi,
        table
        (
            folder_/(patchName(book) + ".distributions.dat"),
            distributionColumns()
        )
    );
    table& rows = place.first->second;

    label at = 0;
    for (const classes& c : quantities())
    {
        for (std::size_t i = 0; i < c.low.size(); ++i, at += nColumns)
        {
            if (totals[at + hits] == 0) continue;

            std::vector<std::string> cells
            ({
                exactText(time),
                injectors_.of(injectorOf_[book]),
                c.quantity,
                exactText(c.low[i]),
                exactText(c.high(i))
            });
            for (label j = 0; j < nColumns; ++j)
            {
                cells.push_back(exactText(totals[at + j]));
            }
            rows.row(cells);
        }
    }
}


void Foam::nearWall::statistics::writeFlux
(
    const label book,
    const scalar time,
    const scalar area,
    const scalarList& totals
)
{
    const label patchi = patchOf_[book];
    const auto place = fluxes_.emplace
    (
        patchi,
        table(folder_/(patchName(book) + ".flux.dat"), fluxColumns())
    );
    const auto flux = [&](const label column)
    {
        const scalar since =
            columnSum(totals, column) - columnSum(written_[book], column);
        return exactText(since/(area*(time - lastTime_)));
    };
    place.first->second.row
    (
        std::vector<std::string>
        ({
            exactText(time),
            exactText(lastTime_),
            injectors_.of(injectorOf_[book]),
            exactText(area),
            flux(mass),
            flux(stickMass)
        })
    );
}


Foam::scalarList Foam::nearWall::statistics::areas() const
{
    scalarList sums(ledgers_.size(), scalar(0));
    forAll(sums, i)
    {
        for (const scalar area : mesh_.magSf().boundaryField()[patchOf_[i]])
        {
            sums[i] += area;
        }
    }
    sumOverRanks(sums);
    return sums;
}


Foam::dictionary Foam::nearWall::statistics::saved
(
    const List<scalarList>& totals
) const
{
    dictionary all;
    forAll(ledgers_, i)
    {
        // Nearly all classes are empty and need no place in a file
        dictionary book;
        forAll(totals[i], j)
        {
            if (totals[i][j] != 0)
            {
                book.add
                (
                    keyType(ledgerNames()[j]),
                    string(exactText(totals[i][j]))
                );
            }
        }
        dictionary ofPatch;
        ofPatch.add(keyType(keyOf(injectorOf_[i])), book);
        all.add(keyType(patchName(i)), ofPatch, true);
    }
    return all;
}


Foam::dictionary Foam::nearWall::statistics::write()
{
    gatherBooks();
    const List<scalarList> totals(nearWall::totals(ledgers_));
    const scalarList area(areas());
    const scalar time = mesh_.time().value();

    // A cloud may move several times a time step; its tables grow once
    if (time > lastTime_)
    {
        std::set<label> changed;
        forAll(ledgers_, i)
        {
            if (totals[i] != written_[i]) changed.insert(patchOf_[i]);
        }
        forAll(ledgers_, i)
        {
            if (changed.count(patchOf_[i]))
            {
                writeDistributions(i, time, totals[i]);
            }
            if (area[i] > 0) writeFlux(i, time, area[i], totals[i]);
        }
        written_ = totals;
        lastTime_ = time;
    }
    return saved(totals);
}
