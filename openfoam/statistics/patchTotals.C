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

    column
    (
        const char* name,
        const increment& add,
        const char* part = "",
        const char* whole = ""
    )
    :
        name(name), add(add), part(part), whole(whole)
    {}
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


//- Mass that stuck with a conversion of this tenth
increment inConversionClass(const label tenth)
{
    const auto massInClass = [=](const impactEvent& e)
    {
        const label found = label(10*e.impact.conversion);
        return max(label(0), min(label(9), found)) == tenth ? e.mass : 0;
    };
    return of(impactEvent::stuck, massInClass);
}


typedef const impactEvent& E;
const increment count = [](E) { return scalar(1); };
const increment particles = [](E e) { return e.particles; };
const increment mass = [](E e) { return e.mass; };
const auto rebounded = impactEvent::rebounded;
const auto stuck = impactEvent::stuck;
const auto escaped = impactEvent::escaped;
const auto unusable = impactEvent::unusable;

//- All columns after the time, in the order of the table
const std::vector<column> columns
{
    {"hits", count},
    {"hit_particles", particles},
    {"hit_mass_kg", mass},
    {"rebounds", of(rebounded, count)},
    {"rebound_mass_kg", of(rebounded, mass)},
    {"sticks", of(stuck, count)},
    {"stick_particles", of(stuck, particles)},
    {"stick_mass_kg", of(stuck, mass)},
    {"escapes", of(escaped, count)},
    {"escape_mass_kg", of(escaped, mass)},
    {"unusable", of(unusable, count)},
    {"unusable_mass_kg", of(unusable, mass)},
    {"impact_speed_sum_m_s", [](E e) { return e.speed; }},
    {"normal_speed_sum_m_s", [](E e) { return e.impact.v_n; }},
    {"e_n_sum", [](E e) { return e.en; }},
    {"e_n2_sum", [](E e) { return sqr(e.en); }},
    {"e_g_sum", [](E e) { return e.eg; }},
    {"sticks_NSP-NSW", inRegime(NW_NSP_NSW, count)},
    {"sticks_NSP-SW", inRegime(NW_NSP_SW, count)},
    {"sticks_SP-NSW", inRegime(NW_SP_NSW, count)},
    {"sticks_SP-SW", inRegime(NW_SP_SW, count)},
    {"stick_mass_NSP-NSW_kg", inRegime(NW_NSP_NSW, mass)},
    {"stick_mass_NSP-SW_kg", inRegime(NW_NSP_SW, mass)},
    {"stick_mass_SP-NSW_kg", inRegime(NW_SP_NSW, mass)},
    {"stick_mass_SP-SW_kg", inRegime(NW_SP_SW, mass)},
    {"stick_mass_conversion_0.0_kg", inConversionClass(0)},
    {"stick_mass_conversion_0.1_kg", inConversionClass(1)},
    {"stick_mass_conversion_0.2_kg", inConversionClass(2)},
    {"stick_mass_conversion_0.3_kg", inConversionClass(3)},
    {"stick_mass_conversion_0.4_kg", inConversionClass(4)},
    {"stick_mass_conversion_0.5_kg", inConversionClass(5)},
    {"stick_mass_conversion_0.6_kg", inConversionClass(6)},
    {"stick_mass_conversion_0.7_kg", inConversionClass(7)},
    {"stick_mass_conversion_0.8_kg", inConversionClass(8)},
    {"stick_mass_conversion_0.9_kg", inConversionClass(9)},
    {"capture_by_particles", nullptr, "stick_particles", "hit_particles"},
    {"capture_by_mass", nullptr, "stick_mass_kg", "hit_mass_kg"},
    {"contact_heat_J", [](E e) { return e.contactHeat; }},
    {"eroded_volume_m3", [](E e) { return e.eroded; }},
    {"outside_range", [](E e) { return scalar(e.outsideRange); }}
};


//- A named sum among the totals of a patch
scalar total(const scalarList& totals, const std::string& name)
{
    label i = 0;
    for (const column& c : columns)
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


Foam::nearWall::patchTotals::patchTotals(const statisticsSource& source)
:
    indices_(source.rules().size(), label(-1))
{
    wordList names;
    for (const column& c : columns)
    {
        if (c.add) names.append(c.name);
    }

    const dictionary saved(source.savedAs("patches"));
    forAll(indices_, patchi)
    {
        if (source.rules()[patchi].type == patchRule::pass) continue;

        indices_[patchi] = sums_.size();
        const word& name = patchesOf(source.mesh)[patchi].name();
        sums_.append(runningTotals(names, saved.subOrEmptyDict(name), name));
        tables_.emplace_back(source.folder/(name + ".dat"));
    }
    written_.setSize(sums_.size());
}


void Foam::nearWall::patchTotals::add(const impactEvent& e)
{
    runningTotals& sums = sums_[indices_[e.patch]];
    label i = 0;
    for (const column& c : columns)
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
        for (const column& c : columns)
        {
            row.add(c.name, c.add ? t[k++] : ratio(t, c.part, c.whole));
        }
        tables_[i].write(row);
    }
}
