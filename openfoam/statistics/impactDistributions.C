// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "impactDistributions.H"
#include "exactText.H"
#include "surfaceFields.H"
#include "unitConversion.H"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

typedef const impactEvent& Event;
typedef scalar (*impactFunction)(Event);

//- A column: what is summed for each class. The sum of squares tells how many
//  parcels of equal weight a class is worth.
struct column
{
    const char* name;
    impactFunction increment;
};

scalar arrivingEnergy(Event e)
{
    return 0.5*e.mass*sqr(e.speed);
}

scalar isStuck(Event e)
{
    return e.result == impactEvent::stuck;
}

const column columns[] =
{
    {"hits", [](Event) { return scalar(1); }},
    {"particles", [](Event e) { return e.particles; }},
    {"particles_squared", [](Event e) { return sqr(e.particles); }},
    {"mass_kg", [](Event e) { return e.mass; }},
    {"sticks", isStuck},
    {"stick_particles", [](Event e) { return isStuck(e)*e.particles; }},
    {"stick_mass_kg", [](Event e) { return isStuck(e)*e.mass; }},
    {"energy_in_J", arrivingEnergy},
    {"energy_out_J", [](Event e) { return arrivingEnergy(e)*sqr(e.eg); }}
};

const label nColumns = sizeof(columns)/sizeof(columns[0]);

label columnIndex(const std::string& name)
{
    label i = 0;
    while (columns[i].name != name) ++i;
    return i;
}


//- A quantity and its classes
struct quantity
{
    std::string name;
    impactFunction value;

    //- Lower ends of the classes; the upper end of the last one is `top`
    std::vector<scalar> low;
    scalar top;

    label size() const
    {
        return label(low.size());
    }

    scalar high(const label i) const
    {
        return i + 1 < size() ? low[i + 1] : top;
    }

    label classOf(Event e) const
    {
        const auto above = std::upper_bound(low.begin(), low.end(), value(e));
        return above == low.begin() ? 0 : label(above - low.begin()) - 1;
    }
};


//- Classes from 0 to the lowest decade, 8 classes a decade, and one above
quantity logarithmic
(
    const std::string& name,
    const impactFunction value,
    const label lowest,
    const label highest
)
{
    const label perDecade = 8;
    quantity q{name, value, {0}, std::numeric_limits<scalar>::infinity()};
    for (label i = lowest*perDecade; i <= highest*perDecade; ++i)
    {
        // A whole decade exactly as it is written in decimal
        q.low.push_back
        (
            i % perDecade
          ? std::pow(10.0, scalar(i)/perDecade)
          : std::atof(("1e" + std::to_string(i/perDecade)).c_str())
        );
    }
    return q;
}


quantity angle()
{
    const impactFunction fromWall = [](Event e)
    {
        return radToDeg(std::atan2(e.impact.v_n, e.impact.v_t));
    };
    quantity q{"angle_deg", fromWall, {}, 90};
    for (label i = 0; i < 18; ++i) q.low.push_back(5*i);
    return q;
}


const std::vector<quantity>& quantities()
{
    static const std::vector<quantity> all
    {
        logarithmic("speed_m_s", [](Event e) { return e.speed; }, -3, 3),
        angle(),
        logarithmic("diameter_m", [](Event e) { return e.impact.d; }, -8, -2)
    };
    return all;
}


//- Names of the sums of a series: all columns of the first class, then of the
//  next ...
const wordList& sumNames()
{
    static wordList names;
    if (names.empty())
    {
        DynamicList<word> all;
        for (const quantity& q : quantities())
        {
            for (label i = 0; i < q.size(); ++i)
            {
                const std::string key(q.name + "_" + std::to_string(i) + "_");
                for (const column& c : columns) all.append(key + c.name);
            }
        }
        names = all;
    }
    return names;
}


//- Name of an injector's dictionary among the saved ones
const std::string savedAs = "injector";

word savedName(const label injector)
{
    return savedAs + std::to_string(injector);
}


//- Sum of a column over all classes of the first quantity
scalar columnSum(const scalarList& totals, const std::string& name)
{
    scalar s = 0;
    for (label i = 0; i < quantities().front().size(); ++i)
    {
        s += totals[i*nColumns + columnIndex(name)];
    }
    return s;
}

} // End anonymous namespace


Foam::nearWall::impactDistributions::impactDistributions
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
            seriesOf(patchi, std::atoi(key.c_str() + savedAs.size()));
        }
    }
    synchronise();
    written_ = runningTotals::totals(sums_);
}


const Foam::word& Foam::nearWall::impactDistributions::patchName
(
    const label series
) const
{
    return mesh_.boundaryMesh()[patchOf_[series]].name();
}


Foam::label Foam::nearWall::impactDistributions::seriesOf
(
    const label patchi,
    const label injector
)
{
    forAll(sums_, i)
    {
        if (patchOf_[i] == patchi && injectorOf_[i] == injector) return i;
    }

    const dictionary ofPatch
    (
        loaded_.subOrEmptyDict(mesh_.boundaryMesh()[patchi].name())
    );
    patchOf_.append(patchi);
    injectorOf_.append(injector);
    sums_.append
    (
        runningTotals(sumNames(), ofPatch.subOrEmptyDict(savedName(injector)))
    );
    written_.append(scalarList(sumNames().size(), scalar(0)));
    return sums_.size() - 1;
}


void Foam::nearWall::impactDistributions::add(const impactEvent& e)
{
    if (!std::isfinite(e.speed) || !std::isfinite(e.mass)) return;

    if
    (
        latest_ < 0
     || patchOf_[latest_] != e.patch
     || injectorOf_[latest_] != e.injector
    )
    {
        latest_ = seriesOf(e.patch, e.injector);
    }

    scalar increments[nColumns];
    for (label i = 0; i < nColumns; ++i)
    {
        increments[i] = columns[i].increment(e);
    }

    label first = 0;
    for (const quantity& q : quantities())
    {
        const label at = first + nColumns*q.classOf(e);
        for (label i = 0; i < nColumns; ++i)
        {
            sums_[latest_].add(at + i, increments[i]);
        }
        first += nColumns*q.size();
    }
}


void Foam::nearWall::impactDistributions::synchronise()
{
    List<labelList> known(Pstream::nProcs());
    labelList& own = known[Pstream::myProcNo()];
    forAll(sums_, i)
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
    for (const auto& p : all) order.append(seriesOf(p.first, p.second));

    patchOf_ = labelList(UIndirectList<label>(patchOf_, order));
    injectorOf_ = labelList(UIndirectList<label>(injectorOf_, order));
    sums_ = List<runningTotals>(UIndirectList<runningTotals>(sums_, order));
    written_ = List<scalarList>(UIndirectList<scalarList>(written_, order));
    latest_ = -1;
}


Foam::nearWall::outputTable& Foam::nearWall::impactDistributions::table
(
    const label series,
    const std::string& kind
)
{
    const std::string file(patchName(series) + "." + kind + ".dat");
    return tables_.emplace(file, outputTable(folder_/file)).first->second;
}


void Foam::nearWall::impactDistributions::writeDistributions
(
    const label series,
    const scalar time,
    const scalarList& totals
)
{
    label at = 0;
    for (const quantity& q : quantities())
    {
        for (label i = 0; i < q.size(); ++i, at += nColumns)
        {
            if (totals[at + columnIndex("hits")] == 0) continue;

            tableRow row;
            row.add("time_s", time);
            row.add("injector", injectors_.name(injectorOf_[series]));
            row.add("quantity", q.name);
            row.add("low", q.low[i]);
            row.add("high", q.high(i));
            for (label j = 0; j < nColumns; ++j)
            {
                row.add(columns[j].name, totals[at + j]);
            }
            table(series, "distributions").write(row);
        }
    }
}


void Foam::nearWall::impactDistributions::writeFlux
(
    const label series,
    const scalar time,
    const scalarList& totals
)
{
    const scalar area = gSum(mesh_.magSf().boundaryField()[patchOf_[series]]);
    if (area <= 0) return;

    const auto flux = [&](const std::string& name)
    {
        const scalar since =
            columnSum(totals, name) - columnSum(written_[series], name);
        return since/(area*(time - lastTime_));
    };
    tableRow row;
    row.add("time_s", time);
    row.add("since_s", lastTime_);
    row.add("injector", injectors_.name(injectorOf_[series]));
    row.add("area_m2", area);
    row.add("mass_flux_kg_m2_s", flux("mass_kg"));
    row.add("stick_mass_flux_kg_m2_s", flux("stick_mass_kg"));
    table(series, "flux").write(row);
}


Foam::dictionary Foam::nearWall::impactDistributions::saved
(
    const List<scalarList>& totals
) const
{
    dictionary all;
    forAll(sums_, i)
    {
        // Most classes are empty; they are left out
        dictionary series;
        forAll(totals[i], j)
        {
            const scalar x = totals[i][j];
            if (x != 0) addExact(series, sumNames()[j], x);
        }
        dictionary ofPatch;
        ofPatch.add(keyType(savedName(injectorOf_[i])), series);
        all.add(keyType(patchName(i)), ofPatch, true);
    }
    return all;
}


Foam::dictionary Foam::nearWall::impactDistributions::write()
{
    synchronise();
    const List<scalarList> totals(runningTotals::totals(sums_));
    const scalar time = mesh_.time().value();

    // A cloud may move several times a time step; the tables grow once
    if (time > lastTime_)
    {
        std::set<label> changed;
        forAll(sums_, i)
        {
            if (totals[i] != written_[i]) changed.insert(patchOf_[i]);
        }
        forAll(sums_, i)
        {
            if (changed.count(patchOf_[i]))
            {
                writeDistributions(i, time, totals[i]);
            }
            writeFlux(i, time, totals[i]);
        }
        written_ = totals;
        lastTime_ = time;
    }
    return saved(totals);
}
