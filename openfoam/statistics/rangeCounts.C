// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "rangeCounts.H"
#include "exactText.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "outputTable.H"
#include "versionCompat.H"

#include <cerrno>
#include <sstream>

Foam::nearWall::rangeCounts::rangeCounts(const statisticsSource& source)
:
    mesh_(source.mesh),
    folder_(source.folder)
{
    const dictionary saved(source.savedAs("outsideRange"));
    for (label i = 0; saved.found(word("range" + std::to_string(i))); ++i)
    {
        const dictionary& row = saved.subDict(word("range" + std::to_string(i)));
        base_[string(row.lookup("range"))] = readExact(row, "hits");
    }
}


void Foam::nearWall::rangeCounts::add(const impactEvent& e)
{
    if (!e.outsideRange || !e.model) return;

    const std::string patch(patchesOf(mesh_)[e.patch].name());
    std::istringstream lines(e.model->beyond(e.impact));
    for (std::string line; std::getline(lines, line);)
    {
        added_[patch + " " + line] += 1;
    }
}


void Foam::nearWall::rangeCounts::clear()
{
    base_.clear();
    added_.clear();
}


std::map<std::string, Foam::scalar>
Foam::nearWall::rangeCounts::totals() const
{
    List<List<string>> known(Pstream::nProcs());
    for (const auto& each : added_)
    {
        known[Pstream::myProcNo()].append(string(each.first));
    }
    Pstream::gatherList(known);
    Pstream::scatterList(known);

    std::map<range, scalar> all(base_);
    for (const List<string>& list : known)
    {
        for (const string& one : list) all.emplace(one, 0);
    }
    scalarList sums(label(all.size()), scalar(0));
    label i = 0;
    for (const auto& each : all)
    {
        const auto own = added_.find(each.first);
        if (own != added_.end()) sums[i] = own->second;
        ++i;
    }
    sumOverRanks(sums);
    i = 0;
    for (auto& each : all) each.second += sums[i++];
    return all;
}


void Foam::nearWall::rangeCounts::writeFile
(
    const std::map<range, scalar>& totals
) const
{
    if (!Pstream::master()) return;

    mkDir(folder_);
    const fileName path(folder_/"outsideRange.txt");
    OFstream file(path);
    file<< "# hits patch range" << nl;
    for (const auto& each : totals)
    {
        file<< exactText(each.second).c_str() << ' ' << each.first.c_str()
            << nl;
    }
    errno = 0;
    file<< flush;
    requireWritten(file.stdStream().good(), path);
}


Foam::dictionary Foam::nearWall::rangeCounts::write(Ostream& os) const
{
    const std::map<range, scalar> all(totals());
    dictionary saved;
    if (all.empty()) return saved;

    writeFile(all);
    os  << "    Hits outside of a stated range" << nl;
    label i = 0;
    for (const auto& each : all)
    {
        os  << "        " << exactText(each.second).c_str() << ": "
            << each.first.c_str() << nl;
        dictionary row;
        row.add("range", string(each.first));
        addExact(row, "hits", each.second);
        saved.add(keyType(word("range" + std::to_string(i++))), row);
    }
    return saved;
}
