// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "patchTotals.H"

#include <functional>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- A column of the table, which is also the key that a restart reads
struct column
{
    //- Name, ending with the unit
    std::string name;

    //- What an impact adds to the sum
    std::function<scalar(const impactEvent&)> increment;

    //- For a ratio of two sums, which is not saved: their names
    std::string part, whole;
};


//- An increment for impacts of one result
std::function<scalar(const impactEvent&)> of
(
    const impactEvent::resultType result,
    const std::function<scalar(const impactEvent&)>& increment
)
{
    return [=](const impactEvent& e)
    {
        return e.result == result ? increment(e) : 0;
    };
}


//- An increment for parcels that the model held in one regime
std::function<scalar(const impactEvent&)> inRegime
(
    const label regime,
    const std::function<scalar(const impactEvent&)>& increment
)
{
    return [=](const impactEvent& e)
    {
        return e.stuckByModel() && e.regime == regime ? increment(e) : 0;
    };
}


label conversionClass(const scalar conversion)
{
    return max(label(0), min(label(9), label(10*conversion)));
}


//- All columns after the time, in the order of the table
std::vector<column> makeColumns()
{
    typedef const impactEvent& E;
    const auto count = [](E) { return scalar(1); };
    const auto particles = [](E e) { return e.particles; };
    const auto mass = [](E e) { return e.mass; };
    const auto rebounded = impactEvent::rebounded;
    const auto stuck = impactEvent::stuck;
    const auto escaped = impactEvent::escaped;
    const auto unusable = impactEvent::unusable;

    std::vector<column> all
    {
        {"hits", count, "", ""},
        {"hit_particles", particles, "", ""},
        {"hit_mass_kg", mass, "", ""},
        {"rebounds", of(rebounded, count), "", ""},
        {"rebound_mass_kg", of(rebounded, mass), "", ""},
        {"sticks", of(stuck, count), "", ""},
        {"stick_particles", of(stuck, particles), "", ""},
        {"stick_mass_kg", of(stuck, mass), "", ""},
        {"escapes", of(escaped, count), "", ""},
        {"escape_mass_kg", of(escaped, mass), "", ""},
        {"unusable", of(unusable, count), "", ""},
        {"unusable_mass_kg", of(unusable, mass), "", ""},
        {"impact_speed_sum_m_s", [](E e) { return e.speed; }, "", ""},
        {"normal_speed_sum_m_s", [](E e) { return e.impact.v_n; }, "", ""},
        {"e_n_sum", [](E e) { return e.en; }, "", ""},
        {"e_n2_sum", [](E e) { return sqr(e.en); }, "", ""},
        {"e_g_sum", [](E e) { return e.eg; }, "", ""}
    };
    const auto regimeName = [](const label r)
    {
        return std::string(nw_regime_name(nw_regime(r)));
    };
    for (label r = 0; r < 4; ++r)
    {
        all.push_back({"sticks_" + regimeName(r), inRegime(r, count), "", ""});
    }
    for (label r = 0; r < 4; ++r)
    {
        all.push_back
        ({
            "stick_mass_" + regimeName(r) + "_kg", inRegime(r, mass), "", ""
        });
    }
    for (label b = 0; b < 10; ++b)
    {
        const auto inClass = [b](E e)
        {
            return conversionClass(e.impact.conversion) == b ? e.mass : 0;
        };
        all.push_back
        ({
            "stick_mass_conversion_0." + std::to_string(b) + "_kg",
            of(stuck, inClass), "", ""
        });
    }
    all.push_back
    ({
        "capture_by_particles", nullptr, "stick_particles", "hit_particles"
    });
    all.push_back({"capture_by_mass", nullptr, "stick_mass_kg", "hit_mass_kg"});
    all.push_back
    ({
        "outside_range", [](E e) { return scalar(e.outsideRange); }, "", ""
    });
    return all;
}


const std::vector<column>& columns()
{
    static const std::vector<column> all(makeColumns());
    return all;
}


//- A named sum among the totals of a patch
scalar total(const scalarList& totals, const std::string& name)
{
    label i = 0;
    for (const column& c : columns())
    {
        if (c.name == name) break;
        if (c.increment) ++i;
    }
    return totals[i];
}


scalar ratio
(
    const scalarList& totals,
    const std::string& part,
    const std::string& whole
)
{
    const scalar all = total(totals, whole);
    return all > 0 ? total(totals, part)/all : 0;
}


void reportPatch(Ostream& os, const word& name, const scalarList& t)
{
    os  << "        " << name << ": hits " << total(t, "hits")
        << " (" << total(t, "hit_mass_kg") << " kg)";
    if (total(t, "rebounds")) os << ", rebounds " << total(t, "rebounds");
    if (total(t, "sticks"))
    {
        os  << ", sticks " << total(t, "sticks")
            << " (" << total(t, "stick_mass_kg") << " kg, captured "
            << 100*ratio(t, "stick_mass_kg", "hit_mass_kg") << " % of mass)";
    }
    if (total(t, "escapes"))
    {
        os  << ", escapes " << total(t, "escapes")
            << " (" << total(t, "escape_mass_kg") << " kg)";
    }
    if (total(t, "unusable"))
    {
        os  << ", unusable " << total(t, "unusable")
            << " (" << total(t, "unusable_mass_kg") << " kg)";
    }
    if (total(t, "outside_range"))
    {
        os  << ", outside the model's stated range "
            << total(t, "outside_range");
    }
    os  << nl;
}

} // End anonymous namespace


const Foam::word& Foam::nearWall::patchTotals::patchName(const label i) const
{
    return mesh_.boundaryMesh()[patches_[i]].name();
}


Foam::nearWall::patchTotals::patchTotals
(
    const fvMesh& mesh,
    const List<patchRule>& rules,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    indices_(rules.size(), label(-1))
{
    DynamicList<word> names;
    for (const column& c : columns())
    {
        if (c.increment) names.append(c.name);
    }

    forAll(rules, patchi)
    {
        if (rules[patchi].type == patchRule::pass) continue;

        indices_[patchi] = patches_.size();
        patches_.append(patchi);
        const word& name = mesh.boundaryMesh()[patchi].name();
        sums_.append
        (
            runningTotals(wordList(names), saved.subOrEmptyDict(name))
        );
        tables_.emplace_back(folder/(name + ".dat"));
    }
    written_.setSize(patches_.size());
}


void Foam::nearWall::patchTotals::add(const impactEvent& e)
{
    runningTotals& sums = sums_[indices_[e.patch]];
    label i = 0;
    for (const column& c : columns())
    {
        if (c.increment) sums.add(i++, c.increment(e));
    }
}


Foam::dictionary Foam::nearWall::patchTotals::saved
(
    const List<scalarList>& totals
) const
{
    dictionary dict;
    forAll(sums_, i)
    {
        dict.add(keyType(patchName(i)), sums_[i].saved(totals[i]));
    }
    return dict;
}


void Foam::nearWall::patchTotals::report
(
    Ostream& os,
    const List<scalarList>& totals
) const
{
    os  << "    Near-wall impacts since the start of the case" << nl;
    forAll(totals, i)
    {
        if (total(totals[i], "hits")) reportPatch(os, patchName(i), totals[i]);
    }
}


void Foam::nearWall::patchTotals::writeRows
(
    const scalar time,
    const List<scalarList>& totals
)
{
    forAll(totals, i)
    {
        const scalarList& t = totals[i];
        if (t == written_[i]) continue;

        written_[i] = t;
        tableRow row;
        row.add("time_s", time);
        label k = 0;
        for (const column& c : columns())
        {
            row.add(c.name, c.increment ? t[k++] : ratio(t, c.part, c.whole));
        }
        tables_[i].write(row);
    }
}
