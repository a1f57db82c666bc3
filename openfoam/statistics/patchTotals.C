// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "patchTotals.H"
#include "versionCompat.H"

#include <functional>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- What an impact adds to a sum
typedef std::function<scalar(const impactEvent&)> increment;

//- A column of the table, which is also the key that a restart reads
struct column
{
    //- Name, ending with the unit
    std::string name;

    //- Null for a ratio of two sums, which is not saved
    increment add;

    //- Names of the two sums
    std::string part, whole;
};


//- An increment for impacts of one result
increment of(const impactEvent::resultType result, const increment& add)
{
    return [=](const impactEvent& e)
    {
        return e.result == result ? add(e) : 0;
    };
}


//- An increment for parcels that the model held in one regime
increment inRegime(const label regime, const increment& add)
{
    return [=](const impactEvent& e)
    {
        return e.stuckByModel() && e.regime == regime ? add(e) : 0;
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

    std::vector<column> all;
    const auto sum = [&all](const std::string& name, const increment& add)
    {
        all.push_back({name, add, "", ""});
    };
    sum("hits", count);
    sum("hit_particles", particles);
    sum("hit_mass_kg", mass);
    sum("rebounds", of(rebounded, count));
    sum("rebound_mass_kg", of(rebounded, mass));
    sum("sticks", of(stuck, count));
    sum("stick_particles", of(stuck, particles));
    sum("stick_mass_kg", of(stuck, mass));
    sum("escapes", of(escaped, count));
    sum("escape_mass_kg", of(escaped, mass));
    sum("unusable", of(unusable, count));
    sum("unusable_mass_kg", of(unusable, mass));
    sum("impact_speed_sum_m_s", [](E e) { return e.speed; });
    sum("normal_speed_sum_m_s", [](E e) { return e.impact.v_n; });
    sum("e_n_sum", [](E e) { return e.en; });
    sum("e_n2_sum", [](E e) { return sqr(e.en); });
    sum("e_g_sum", [](E e) { return e.eg; });
    const auto regimeName = [](const label r)
    {
        return std::string(nw_regime_name(nw_regime(r)));
    };
    for (label r = 0; r < 4; ++r)
    {
        sum("sticks_" + regimeName(r), inRegime(r, count));
    }
    for (label r = 0; r < 4; ++r)
    {
        sum("stick_mass_" + regimeName(r) + "_kg", inRegime(r, mass));
    }
    for (label b = 0; b < 10; ++b)
    {
        const auto inClass = [b](E e)
        {
            return conversionClass(e.impact.conversion) == b ? e.mass : 0;
        };
        const std::string from("0." + std::to_string(b));
        sum("stick_mass_conversion_" + from + "_kg", of(stuck, inClass));
    }
    all.push_back
    ({
        "capture_by_particles", nullptr, "stick_particles", "hit_particles"
    });
    all.push_back({"capture_by_mass", nullptr, "stick_mass_kg", "hit_mass_kg"});
    sum("eroded_volume_m3", [](E e) { return e.eroded; });
    sum("outside_range", [](E e) { return scalar(e.outsideRange); });
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
        if (c.add && c.name == name) return totals[i];
        if (c.add) ++i;
    }
    FatalErrorInFunction
        << "The table of a patch has no sum '" << name.c_str() << "'."
        << abort(FatalError);
    return 0;
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


Foam::nearWall::patchTotals::patchTotals
(
    const fvMesh& mesh,
    const List<patchRule>& rules,
    const dictionary& saved,
    const fileName& folder
)
:
    indices_(rules.size(), label(-1))
{
    DynamicList<word> names;
    for (const column& c : columns())
    {
        if (c.add) names.append(c.name);
    }

    forAll(rules, patchi)
    {
        if (rules[patchi].type == patchRule::pass) continue;

        indices_[patchi] = sums_.size();
        const word& name = patchesOf(mesh)[patchi].name();
        const dictionary ofPatch(saved.subOrEmptyDict(name));
        sums_.append(runningTotals(wordList(names), ofPatch, name));
        tables_.emplace_back(folder/(name + ".dat"));
    }
    written_.setSize(sums_.size());
}


void Foam::nearWall::patchTotals::add(const impactEvent& e)
{
    runningTotals& sums = sums_[indices_[e.patch]];
    label i = 0;
    for (const column& c : columns())
    {
        if (c.add) sums.add(i++, c.add(e));
    }
}


void Foam::nearWall::patchTotals::report
(
    Ostream& os,
    const List<scalarList>& totals
) const
{
    os  << "    Near-wall impacts " << since_ << nl;
    forAll(totals, i)
    {
        const scalarList& t = totals[i];
        if (total(t, "hits")) reportPatch(os, sums_[i].name(), t);
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
            row.add(c.name, c.add ? t[k++] : ratio(t, c.part, c.whole));
        }
        tables_[i].write(row);
    }
}
