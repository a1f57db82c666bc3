/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallRecorder.H.
\*---------------------------------------------------------------------------*/

#include "nearWallRecorder.H"
#include "nearWallCompat.H"
#include "nearWallLedger.H"
#include "nearWallParcel.H"
#include "OSspecific.H"
#include "wordReList.H"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

const label defaultRows = 100000;

//- The columns from which an impact is known again come first
const std::string header =
    "time,x,y,z,v_n,v_t,d,"
    "T_p,T_w,conversion,layer_thickness,film_thickness,v_gas,roughness,omega,"
    "coverage,patch,wall,injector,mass,regime,outcome,e_n,e_t";

const label nKnownBy = 7;

const label nHalvings = recorder::nHalvings;


//- What an impact is known by, from its numbers: time, place, v_n, v_t, d.
//  Ranks and restarts differ in the last digits, which do not count.
std::uint64_t hashOf(const scalar* known)
{
    const scalar speed = std::sqrt(sqr(known[4]) + sqr(known[5]));
    impactKey key;
    key << known[0] << speed << known[6];
    // 1e-8 m: finer than parcels meet a wall, coarser than rounding
    key.add(vector(known[1], known[2], known[3]), 0.1);
    key.add(vector(known[4], known[5], 0), speed);
    // Not the key of the impact's draws: which parcels stick must not decide
    // which ones are recorded
    return mix(key.value() ^ 0x5851f42d4c957f2dULL);
}


//- How often the sample can be halved before this impact goes
label staysFor(std::uint64_t hash)
{
    label n = 0;
    while (n < nHalvings - 1 && !(hash >> 63))
    {
        hash <<= 1;
        ++n;
    }
    return n;
}


//- The numbers at the beginning of a line; false for a line that was cut off
bool readKnown(const std::string& line, scalar* known)
{
    const auto commas = [](const std::string& s)
    {
        return std::count(s.begin(), s.end(), ',');
    };
    if (commas(line) < commas(header)) return false;

    const char* at = line.c_str();
    for (label i = 0; i < nKnownBy; ++i)
    {
        char* end = nullptr;
        known[i] = std::strtod(at, &end);
        if (end == at || *end != ',') return false;
        at = end + 1;
    }
    return true;
}


//- A name as a cell of a CSV file
std::string csvCell(const std::string& name)
{
    if (name.find_first_of(",\"\n") == std::string::npos) return name;
    std::string quoted("\"");
    for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}


//- Kept as text, as the totals are: all digits
scalar savedNumber(const dictionary& saved, const word& name)
{
    if (!saved.found(name)) return 0;
    return std::atof(nearWall::read<string>(saved, name).c_str());
}


void addNumber(dictionary& dict, const word& name, const scalar x)
{
    dict.add(keyType(name), string(exactText(x)));
}


std::string share(const label level)
{
    return level ? "1 in " + exactText(std::pow(2.0, level)) : "all";
}

} // End anonymous namespace


Foam::nearWall::recorder::recorder
(
    const dictionary& coeffs,
    const fvMesh& mesh,
    const patchRules& rules,
    const injectorNames& injectors,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    injectors_(injectors),
    maxRows_(0),
    recorded_(rules.size(), false),
    walls_(rules.size()),
    file_(folder/"impacts.csv"),
    level_(label(savedNumber(saved, "halvings"))),
    before_(savedNumber(saved, "impacts")),
    seen_(0),
    opened_(false),
    fileLevel_(0),
    previous_
    (
        saved.found("start")
      ? folder.path()/nearWall::read<string>(saved, "start")/"impacts.csv"
      : fileName()
    ),
    previousRows_(savedNumber(saved, "rows")),
    // Past the rounding of the time's name, before the next step
    start_(mesh.time().value() + 1e-3*mesh.time().deltaTValue())
{
    inFile_.fill(0);
    if (!coeffs.found("record")) return;

    const dictionary& dict = coeffs.subDict("record");
    refuseUnknownKeys(dict, wordList({"maxRows", "patches"}), "record");
    maxRows_ = nearWall::readOr<label>(dict, "maxRows", defaultRows);
    if (maxRows_ < 1)
    {
        FatalIOErrorInFunction(dict)
            << "record: 'maxRows' is " << maxRows_
            << ", must be a number of rows, 1 or more" << exit(FatalIOError);
    }
    readPatches(dict, rules);
}


void Foam::nearWall::recorder::readPatches
(
    const dictionary& dict,
    const patchRules& rules
)
{
    const bool named = dict.found("patches");
    wordReList names;
    if (named) names = nearWall::read<wordReList>(dict, "patches");

    std::vector<bool> used(names.size(), false);
    DynamicList<word> can;
    forAll(rules, patchi)
    {
        if (rules[patchi].what != fate::interact) continue;

        const polyPatch& pp = mesh_.boundaryMesh()[patchi];
        walls_[patchi] = rules[patchi].wallName;
        recorded_[patchi] = !named;
        can.append(pp.name());
        forAll(names, i)
        {
            bool fits = names[i].match(pp.name());
            forAll(pp.inGroups(), j)
            {
                fits = fits || names[i] == pp.inGroups()[j];
            }
            if (fits) recorded_[patchi] = used[i] = true;
        }
    }
    forAll(names, i)
    {
        if (!used[i])
        {
            FatalIOErrorInFunction(dict)
                << "record: no patch, patch group or expression '" << names[i]
                << "' at which the model decides (type interact)" << nl
                << "    There are " << wordList(can) << exit(FatalIOError);
        }
    }
}


void Foam::nearWall::recorder::add(const event& e)
{
    if (!recorded_[e.patch]) return;

    row r;
    r.impact = e;
    r.time = mesh_.time().value();
    const scalar known[nKnownBy] =
    {
        r.time, e.position.x(), e.position.y(), e.position.z(),
        e.arrived.v_n, e.arrived.v_t, e.arrived.d
    };
    r.hash = hashOf(known);
    seen_ += 1;

    if (staysFor(r.hash) < level_) return;
    rows_.push_back(r);

    // What one rank alone has too much of, all together have: halving here
    // comes to the same as halving at the next write
    while (label(rows_.size()) > maxRows_ && level_ < nHalvings - 1)
    {
        ++level_;
        thin();
    }
}


void Foam::nearWall::recorder::thin()
{
    const label level = level_;
    rows_.erase
    (
        std::remove_if
        (
            rows_.begin(), rows_.end(),
            [level](const row& r) { return staysFor(r.hash) < level; }
        ),
        rows_.end()
    );
}


std::string Foam::nearWall::recorder::text(const row& r) const
{
    const event& e = r.impact;
    const nw_impact& a = e.arrived;
    const scalar numbers[] =
    {
        r.time, e.position.x(), e.position.y(), e.position.z(),
        a.v_n, a.v_t, a.d, a.T_p, a.T_w, a.conversion, a.layer_thickness,
        a.film_thickness, a.v_gas, a.roughness, a.omega, a.coverage
    };
    std::string line;
    for (const scalar x : numbers) line += exactText(x) + ",";

    line += csvCell(mesh_.boundaryMesh()[e.patch].name());
    line += "," + csvCell(walls_[e.patch]);
    line += "," + csvCell(injectors_.of(e.injector));
    line += "," + exactText(e.mass);
    line += std::string(",") + nw_regime_name(nw_regime(e.regime));
    if (e.stuck) return line + ",stick,,";
    return line + ",rebound," + exactText(e.en) + "," + exactText(e.et);
}


std::vector<Foam::nearWall::recorder::line>
Foam::nearWall::recorder::gathered() const
{
    List<List<string>> texts(Pstream::nProcs());
    List<string>& own = texts[Pstream::myProcNo()];
    own.setSize(label(rows_.size()));
    forAll(own, i) own[i] = text(rows_[i]);
    Pstream::gatherList(texts);

    std::vector<line> lines;
    if (Pstream::master())
    {
        for (const List<string>& list : texts)
        {
            for (const string& text : list)
            {
                scalar known[nKnownBy];
                readKnown(text, known);
                lines.push_back(line{known[0], hashOf(known), text});
            }
        }
    }

    // In an order that does not depend on who had them
    std::sort
    (
        lines.begin(), lines.end(),
        [](const line& a, const line& b)
        {
            if (a.time != b.time) return a.time < b.time;
            return a.hash != b.hash ? a.hash < b.hash : a.text < b.text;
        }
    );
    return lines;
}


void Foam::nearWall::recorder::rewrite(const fileName& from, const scalar until)
{
    inFile_.fill(0);
    fileLevel_ = level_;
    mkDir(file_.path());
    const fileName aside(file_ + ".new");
    {
        std::ofstream to(aside.c_str());
        to  << "# nearWallInteraction, recorded impacts: " << share(level_)
            << " since the start of the case, evenly chosen\n" << header << '\n';

        std::ifstream rows(from.c_str());
        std::string line;
        while (std::getline(rows, line))
        {
            scalar known[nKnownBy];
            if (!readKnown(line, known) || known[0] > until) continue;
            const label stays = staysFor(hashOf(known));
            if (stays < level_) continue;
            inFile_[stays] += 1;
            to << line << '\n';
        }
        to.close();
        if (!to)
        {
            WarningInFunction << "cannot write " << aside << endl;
            return;
        }
    }
    mv(aside, file_);
}


void Foam::nearWall::recorder::open()
{
    if (opened_ || !Pstream::master()) return;
    opened_ = true;
    rewrite(previous_, start_);

    scalar carried = 0;
    for (const scalar n : inFile_) carried += n;
    if (carried < previousRows_)
    {
        WarningInFunction
            << "of " << previousRows_ << " impacts recorded before "
            << carried << " are left in " << previous_ << nl
            << "    the record is no even sample of the time before this run"
            << endl;
    }
}


void Foam::nearWall::recorder::append(const std::vector<line>& lines)
{
    std::ofstream to(file_.c_str(), std::ios::app);
    for (const line& one : lines)
    {
        to << one.text << '\n';
        inFile_[staysFor(one.hash)] += 1;
    }
    to.close();
    if (!to)
    {
        WarningInFunction << "cannot write to " << file_ << endl;
    }
}


Foam::dictionary Foam::nearWall::recorder::write(Ostream& os)
{
    dictionary dict;
    if (!on()) return dict;

    open();
    scalarList sums(nHalvings + 1, scalar(0));
    for (label i = 0; i < nHalvings; ++i) sums[i] = inFile_[i];
    for (const row& r : rows_) sums[staysFor(r.hash)] += 1;
    sums[nHalvings] = seen_;
    sumOverRanks(sums);

    // The largest even sample that fits: each rank comes to the same one
    scalar rows = 0;
    label level = nHalvings;
    while (level > 0 && rows + sums[level - 1] <= maxRows_)
    {
        rows += sums[--level];
    }
    const label needed = min(level, nHalvings - 1);
    level_ = max(needed, returnReduce(level_, maxOp<label>()));
    thin();
    if (Pstream::master() && fileLevel_ < level_)
    {
        rewrite(file_, std::numeric_limits<scalar>::infinity());
    }

    const std::vector<line> lines(gathered());
    rows_.clear();
    if (Pstream::master()) append(lines);

    rows = 0;
    for (const scalar n : inFile_) rows += n;
    const scalar impacts = before_ + sums[nHalvings];
    os  << "    Near-wall record: " << exactText(rows).c_str() << " rows, "
        << share(level_).c_str() << " of " << exactText(impacts).c_str()
        << " impacts" << nl;

    addNumber(dict, "halvings", level_);
    addNumber(dict, "impacts", impacts);
    addNumber(dict, "rows", returnReduce(rows, maxOp<scalar>()));
    dict.add(keyType("start"), string(file_.path().name()));
    return dict;
}
