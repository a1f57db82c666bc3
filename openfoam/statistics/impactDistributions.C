// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "impactDistributions.H"
#include "exactText.H"
#include "mathematicalConstants.H"
#include "surfaceFields.H"
#include "versionCompat.H"

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
        return std::atan2(e.impact.v_n, e.impact.v_t)*180/constant::mathematical::pi;
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
    const statisticsSource& source
)
:
    mesh_(source.mesh),
    injectors_(source.models.injectors()),
    folder_(source.folder),
    loaded_(source.savedAs("statistics")),
    latest_(nullptr),
    lastTime_(mesh_.time().value())
{
    forAll(patchesOf(mesh_), patchi)
    {
        const dictionary ofPatch(loaded_.subOrEmptyDict(patchName(patchi)));
        for (const word& key : ofPatch.toc())
        {
            const label injector = std::atoi(key.c_str() + savedAs.size());
            seriesOf(patchAndInjector(patchi, injector));
        }
    }
}


const Foam::word& Foam::nearWall::impactDistributions::patchName
(
    const label patchi
) const
{
    return patchesOf(mesh_)[patchi].name();
}


Foam::nearWall::impactDistributions::series&
Foam::nearWall::impactDistributions::seriesOf(const patchAndInjector& key)
{
    const auto found = series_.find(key);
    if (found != series_.end()) return found->second;

    const dictionary ofPatch(loaded_.subOrEmptyDict(patchName(key.first)));
    const runningTotals sums
    (
        sumNames(), ofPatch.subOrEmptyDict(savedName(key.second))
    );
    return series_[key] = series{key, sums, sums.base(), sums.base()};
}


void Foam::nearWall::impactDistributions::clear()
{
    oneSecond_ = true;
    for (auto& each : series_)
    {
        each.second.sums.clear();
        each.second.written = 0;
    }
}


void Foam::nearWall::impactDistributions::add(const impactEvent& e)
{
    if (!std::isfinite(e.speed) || !std::isfinite(e.mass)) return;

    const patchAndInjector key(e.patch, e.injector);
    if (!latest_ || latest_->key != key) latest_ = &seriesOf(key);

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
            latest_->sums.add(at + i, increments[i]);
        }
        first += nColumns*q.size();
    }
}


void Foam::nearWall::impactDistributions::synchronise()
{
    List<labelList> known(Pstream::nProcs());
    labelList& own = known[Pstream::myProcNo()];
    for (const auto& each : series_)
    {
        own.append(each.first.first);
        own.append(each.first.second);
    }
    Pstream::gatherList(known);
    Pstream::scatterList(known);
    for (const labelList& list : known)
    {
        for (label i = 0; i < list.size(); i += 2)
        {
            seriesOf(patchAndInjector(list[i], list[i + 1]));
        }
    }

    DynamicList<runningTotals> sums;
    for (const auto& each : series_) sums.append(each.second.sums);
    const List<scalarList> totals(runningTotals::totals(sums));
    label i = 0;
    for (auto& each : series_) each.second.totals = totals[i++];
}


Foam::nearWall::outputTable& Foam::nearWall::impactDistributions::table
(
    const series& s,
    const std::string& kind
)
{
    const std::string file(patchName(s.key.first) + "." + kind + ".dat");
    return tables_.emplace(file, outputTable(folder_/file)).first->second;
}


void Foam::nearWall::impactDistributions::writeDistributions
(
    const series& s,
    const scalar time
)
{
    label at = 0;
    for (const quantity& q : quantities())
    {
        for (label i = 0; i < q.size(); ++i, at += nColumns)
        {
            if (s.totals[at + columnIndex("hits")] == 0) continue;

            tableRow row;
            row.add("time_s", time);
            row.add("injector", injectors_.name(s.key.second));
            row.add("quantity", q.name);
            row.add("low", q.low[i]);
            row.add("high", q.high(i));
            for (label j = 0; j < nColumns; ++j)
            {
                row.add(columns[j].name, s.totals[at + j]);
            }
            table(s, "distributions").write(row);
        }
    }
}


void Foam::nearWall::impactDistributions::writeFlux
(
    const series& s,
    const scalar time
)
{
    const scalar area = gSum(mesh_.magSf().boundaryField()[s.key.first]);
    if (area <= 0) return;

    const scalar duration = oneSecond_ ? 1 : time - lastTime_;
    const auto flux = [&](const std::string& name)
    {
        const scalar since =
            columnSum(s.totals, name) - columnSum(s.written, name);
        return since/(area*duration);
    };
    tableRow row;
    row.add("time_s", time);
    row.add("since_s", lastTime_);
    row.add("injector", injectors_.name(s.key.second));
    row.add("area_m2", area);
    row.add("mass_flux_kg_m2_s", flux("mass_kg"));
    row.add("stick_mass_flux_kg_m2_s", flux("stick_mass_kg"));
    table(s, "flux").write(row);
}


Foam::dictionary Foam::nearWall::impactDistributions::saved() const
{
    dictionary all;
    for (const auto& each : series_)
    {
        // Most classes are empty; they are left out
        const scalarList& totals = each.second.totals;
        dictionary sums;
        forAll(totals, j)
        {
            if (totals[j] != 0) addExact(sums, sumNames()[j], totals[j]);
        }
        dictionary ofPatch;
        ofPatch.add(keyType(savedName(each.first.second)), sums);
        all.add(keyType(patchName(each.first.first)), ofPatch, true);
    }
    return all;
}


Foam::dictionary Foam::nearWall::impactDistributions::write()
{
    synchronise();
    const scalar time = mesh_.time().value();

    // A cloud may move several times a time step; the tables grow once
    if (time > lastTime_)
    {
        std::set<label> changed;
        for (const auto& each : series_)
        {
            const series& s = each.second;
            if (s.totals != s.written) changed.insert(s.key.first);
        }
        for (auto& each : series_)
        {
            series& s = each.second;
            if (changed.count(s.key.first)) writeDistributions(s, time);
            writeFlux(s, time);
            if (!oneSecond_) s.written = s.totals;
        }
        lastTime_ = time;
    }
    return saved();
}


void Foam::nearWall::impactDistributions::archive(stateArchive& state)
{
    // What was put back lies elsewhere
    latest_ = nullptr;
    state(lastTime_);
    state(oneSecond_);
    state(series_);

    // Tables that came since stay, without rows
    std::size_t n = tables_.size();
    state(n);
    auto next = tables_.begin();
    for (std::size_t i = 0; i < n; ++i, ++next)
    {
        std::string name(state.saves() ? next->first : std::string());
        state(name);
        for (; !state.saves() && next->first != name; ++next) next->second.clear();
        next->second.archive(state);
    }
    for (; next != tables_.end(); ++next) next->second.clear();
}
