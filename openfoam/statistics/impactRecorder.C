// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "impactRecorder.H"
#include "dictionaryChecks.H"
#include "exactText.H"
#include "impactKey.H"
#include "particle.H"
#include "OSspecific.H"
#include "outputTable.H"
#include "versionCompat.H"
#include "wordReList.H"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <tuple>

#include <unistd.h>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

#define INPUT_NAME(input) #input ","
#define INPUT_VALUE(input) scalar(e.impact.input),

//- Names of the columns: numbers, the first of which identify the parcel, then
//  the others as impactRecorder::add() writes them; those of the inputs that
//  the models declare follow.
//
//  `time` is the end of the time step. `parcel_age` orders the impacts of a
//  parcel within a step: OpenFOAM's parcels carry it over ranks and restarts, and
//  it grows with each move. The fraction of the step would not do: OpenFOAM moves
//  a parcel twice in the step of its injection, and an MPPIC cloud moves all
//  parcels a second time to correct them, both from fraction 0. After the latter
//  OpenFOAM resets the age, also where the parcel meets a rank boundary: impacts
//  before and after such a boundary may then be in the wrong order.
const std::string firstColumns
(
    "time,x,y,z,origProcId,origId,parcel_age,n_particles,"
    NW_IMPACT_INPUTS(INPUT_NAME)
    "patch,wall,injector,mass,regime,outcome,e_n,e_t"
);

//- The numbers, in the order of their columns
std::vector<scalar> numbers(const scalar time, const impactEvent& e)
{
    const vector& at = e.position;
    return
    {
        time, at.x(), at.y(), at.z(),
        scalar(e.origProc), scalar(e.origId), e.age, e.particles,
        NW_IMPACT_INPUTS(INPUT_VALUE)
    };
}

#undef INPUT_NAME
#undef INPUT_VALUE

//- Time, position, identity of the parcel, age
const label nIdentifying = 7;


//- Hash of the parcel's identity: all impacts of a parcel are chosen or none,
//  whatever their outcome
std::uint64_t hashOf(const label origProc, const label origId)
{
    impactKey key;
    key.addExact(std::uint64_t(origProc)).addExact(std::uint64_t(origId));
    return key.value();
}


//- How many halvings of the sample an impact survives
label halvingsOf(std::uint64_t hash)
{
    label n = 0;
    while (n < impactRecorder::nHalvings - 1 && !(hash >> 63))
    {
        hash <<= 1;
        ++n;
    }
    return n;
}


//- Number of commas between the cells of a line; a quoted cell may have others
label commas(const std::string& line)
{
    label n = 0;
    bool quoted = false;
    for (const char c : line)
    {
        if (c == '"') quoted = !quoted;
        n += c == ',' && !quoted;
    }
    return n;
}


//- Read the identifying numbers of a line; false for a line of another number
//  of columns, which is incomplete or of another model
bool readRow
(
    const std::string& line,
    const std::string& header,
    impactRecorder::row& r
)
{
    if (commas(line) != commas(header)) return false;

    scalar id[nIdentifying];
    const char* at = line.c_str();
    for (label i = 0; i < nIdentifying; ++i)
    {
        char* end = nullptr;
        id[i] = std::strtod(at, &end);
        if (end == at || *end != ',') return false;
        at = end + 1;
    }
    const label origProc = label(id[4]);
    const label origId = label(id[5]);
    r = {id[0], origProc, origId, id[6], hashOf(origProc, origId), line};
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


//- The names of all columns
std::string headerOf(const std::vector<std::string>& extraInputs)
{
    std::string header(firstColumns);
    for (const std::string& name : extraInputs) header += "," + csvCell(name);
    return header;
}


//- The value of an input that a model declares, blank where it has none
std::string extraText(const impactEvent& e, const std::string& name)
{
    const std::vector<extraInput>& inputs = e.rule->extraInputs;
    for (std::size_t i = 0; i < inputs.size(); ++i)
    {
        if (inputs[i].name == name) return inputs[i].text(e.impact.extra[i]);
    }
    return std::string();
}


std::string fraction(const label level)
{
    return level ? "1 in " + exactText(std::pow(2.0, level)) : "all";
}

} // End anonymous namespace


Foam::nearWall::impactRecorder::impactRecorder(const statisticsSource& source)
:
    mesh_(source.mesh),
    rules_(source.rules()),
    injectors_(source.models.injectors()),
    extraInputs_(source.models.extraInputs()),
    header_(headerOf(extraInputs_)),
    maxRows_(0),
    recorded_(rules_.size(), false),
    file_(source.folder/"impacts.csv"),
    saved_(source.savedAs("record")),
    level_(label(readExact(saved_, "halvings"))),
    seen_(0),
    opened_(false),
    fileLevel_(0),
    // After the rounding of the time's name, before the next step
    start_(mesh_.time().value() + 1e-3*mesh_.time().deltaTValue()),
    identities_(readOr<labelList>(saved_, "identities", labelList()))
{
    inFile_.fill(0);
    if (!source.coeffs.found("record")) return;

    const dictionary& dict = source.coeffs.subDict("record");
    refuseUnknownKeys(dict, wordList({"maxRows", "patches"}), "record");
    maxRows_ = readChecked<label>
    (
        dict, "maxRows", 100000, [](label n) { return n >= 1; }, "1 or more"
    );
    readPatches(dict);
}


void Foam::nearWall::impactRecorder::readPatches(const dictionary& dict)
{
    const bool named = dict.found("patches");
    wordReList names;
    if (named) names = nearWall::read<wordReList>(dict, "patches");

    std::vector<bool> used(names.size(), false);
    DynamicList<word> possible;
    forAll(rules_, patchi)
    {
        if (rules_[patchi].type != patchRule::interact) continue;

        const polyPatch& pp = patchesOf(mesh_)[patchi];
        recorded_[patchi] = !named;
        possible.append(pp.name());
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
                << "record: '" << names[i] << "' matches no patch and no patch"
                << " group of type interact." << nl
                << "    The patches of this type are " << wordList(possible)
                << exit(FatalIOError);
        }
    }
}


void Foam::nearWall::impactRecorder::add(const impactEvent& e)
{
    if (!recorded_[e.patch]) return;

    const std::vector<scalar> values(numbers(mesh_.time().value(), e));
    const std::uint64_t hash = hashOf(e.origProc, e.origId);
    row r{values[0], e.origProc, e.origId, e.age, hash, std::string()};
    seen_ += 1;
    if (halvingsOf(r.hash) < level_) return;

    for (const scalar value : values) r.text += exactText(value) + ",";
    r.text += csvCell(patchesOf(mesh_)[e.patch].name());
    r.text += "," + csvCell(rules_[e.patch].wallName);
    r.text += "," + csvCell(injectors_.name(e.injector));
    r.text += "," + exactText(e.mass) + ",";
    r.text += nw_regime_name(nw_regime(e.regime));
    r.text +=
        e.result == impactEvent::stuck
      ? ",stick,,"
      : ",rebound," + exactText(e.en) + "," + exactText(e.et);
    for (const std::string& name : extraInputs_)
    {
        r.text += "," + csvCell(extraText(e, name));
    }
    rows_.push_back(r);

    // The sample of all ranks is larger than that of one: halving here gives
    // the same sample as halving at the next write
    while (label(rows_.size()) > maxRows_ && level_ < nHalvings - 1)
    {
        ++level_;
        thin();
    }
}


void Foam::nearWall::impactRecorder::reserveIdentities() const
{
    const label rank = Pstream::myProcNo();
    if (!on() || rank >= identities_.size()) return;

    label& next = nextParticle<particle>();
    next = max(next, identities_[rank]);
}


Foam::labelList Foam::nearWall::impactRecorder::identities() const
{
    scalarList counts(max(Pstream::nProcs(), identities_.size()), scalar(0));
    counts[Pstream::myProcNo()] = nextParticle<particle>();
    sumOverRanks(counts);

    labelList next(counts.size());
    forAll(next, i)
    {
        const label before = i < identities_.size() ? identities_[i] : 0;
        next[i] = max(label(counts[i]), before);
    }
    return next;
}


void Foam::nearWall::impactRecorder::thin()
{
    const label level = level_;
    rows_.erase
    (
        std::remove_if
        (
            rows_.begin(), rows_.end(),
            [level](const row& r) { return halvingsOf(r.hash) < level; }
        ),
        rows_.end()
    );
}


std::vector<Foam::nearWall::impactRecorder::row>
Foam::nearWall::impactRecorder::gathered() const
{
    List<List<string>> texts(Pstream::nProcs());
    List<string>& own = texts[Pstream::myProcNo()];
    own.setSize(label(rows_.size()));
    forAll(own, i) own[i] = rows_[i].text;
    Pstream::gatherList(texts);

    std::vector<row> rows;
    if (!Pstream::master()) return rows;
    for (const List<string>& list : texts)
    {
        for (const string& text : list)
        {
            row r{};
            readRow(text, header_, r);
            rows.push_back(r);
        }
    }

    // Impacts at one instant, as in a corner, stay in the order of their rank
    std::stable_sort
    (
        rows.begin(), rows.end(),
        [](const row& a, const row& b)
        {
            return
                std::tie(a.time, a.origProc, a.origId, a.age)
              < std::tie(b.time, b.origProc, b.origId, b.age);
        }
    );
    return rows;
}


void Foam::nearWall::impactRecorder::rewrite
(
    const fileName& from,
    const scalar until
)
{
    inFile_.fill(0);
    fileLevel_ = level_;
    mkDir(file_.path());
    const fileName newFile(file_ + ".new");
    {
        std::ofstream to(newFile.c_str());
        to  << "# nearWallInteraction, recorded impacts: " << fraction(level_)
            << " since the start of the case, chosen by parcel\n" << header_
            << '\n';

        std::ifstream rows(from.c_str());
        std::string line;
        while (std::getline(rows, line))
        {
            row r{};
            if (!readRow(line, header_, r) || r.time > until) continue;
            const label halvings = halvingsOf(r.hash);
            if (halvings < level_) continue;
            inFile_[halvings] += 1;
            to << line << '\n';
        }
        errno = 0;
        to.close();
        requireWritten(bool(to), newFile);
    }
    mv(newFile, file_);
}


void Foam::nearWall::impactRecorder::open()
{
    if (opened_ || !Pstream::master()) return;
    opened_ = true;
    const fileName previous
    (
        saved_.found("start")
      ? file_.path().path()/nearWall::read<string>(saved_, "start")/file_.name()
      : fileName()
    );
    rewrite(previous, start_);

    const scalar before = readExact(saved_, "rows");
    if (rowsInFile() < before)
    {
        WarningInFunction
            << "Of " << before << " impacts recorded before "
            << rowsInFile() << " are left in " << previous << nl
            << "    The record is no even sample of the time before this run."
            << endl;
    }
}


void Foam::nearWall::impactRecorder::append(const std::vector<row>& rows)
{
    std::ofstream to(file_.c_str(), std::ios::app);
    for (const row& r : rows)
    {
        to << r.text << '\n';
        inFile_[halvingsOf(r.hash)] += 1;
    }
    errno = 0;
    to.close();
    requireWritten(bool(to), file_);
}


Foam::scalar Foam::nearWall::impactRecorder::rowsInFile() const
{
    scalar rows = 0;
    for (const scalar n : inFile_) rows += n;
    return rows;
}


void Foam::nearWall::impactRecorder::setLevel(const scalarList& survivors)
{
    scalar rows = 0;
    label level = nHalvings;
    while (level > 0 && rows + survivors[level - 1] <= maxRows_)
    {
        rows += survivors[--level];
    }
    level_ = max(min(level, nHalvings - 1), largestOfRanks(level_));
}


Foam::dictionary Foam::nearWall::impactRecorder::write(Ostream& os)
{
    dictionary dict;
    if (!on()) return dict;

    open();
    scalarList sums(nHalvings + 1, scalar(0));
    for (label i = 0; i < nHalvings; ++i) sums[i] = inFile_[i];
    for (const row& r : rows_) sums[halvingsOf(r.hash)] += 1;
    sums[nHalvings] = seen_;
    sumOverRanks(sums);

    setLevel(sums);
    thin();
    if (Pstream::master() && fileLevel_ < level_)
    {
        rewrite(file_, std::numeric_limits<scalar>::infinity());
    }

    const std::vector<row> all(gathered());
    rows_.clear();
    if (Pstream::master()) append(all);

    const scalar written = rowsInFile();
    const scalar impacts = readExact(saved_, "impacts") + sums[nHalvings];
    os  << "    Near-wall record: " << exactText(written).c_str() << " rows, "
        << fraction(level_).c_str() << " of " << exactText(impacts).c_str()
        << " impacts" << nl;

    addExact(dict, "halvings", level_);
    addExact(dict, "impacts", impacts);
    addExact(dict, "rows", largestOfRanks(written));
    dict.add(keyType("start"), string(file_.path().name()));
    dict.add(keyType("identities"), identities());
    return dict;
}


void Foam::nearWall::impactRecorder::archive(stateArchive& state)
{
    if (!on()) return;

    scalar time = mesh_.time().value() + 1e-3*mesh_.time().deltaTValue();
    long length = opened_ ? long(fileSize(file_)) : -1;
    const label levelNow = fileLevel_;
    state(time);
    state(length);
    state(seen_);
    state(rows_);
    state(level_);
    state(opened_);
    state(fileLevel_);
    state(inFile_);
    if (state.saves() || !opened_) return;

    if (levelNow > fileLevel_)
    {
        // Rows that were thinned out do not come back
        level_ = levelNow;
        rewrite(file_, time);
        return;
    }
    errno = 0;
    requireWritten(truncate(file_.c_str(), length) == 0, file_);
}
