// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "outputTable.H"
#include "exactText.H"
#include "OSspecific.H"
#include "Pstream.H"

#include <cerrno>
#include <cstring>

#include <unistd.h>

void Foam::nearWall::requireWritable
(
    const dictionary& coeffs, const fileName& folder
)
{
    if (!Pstream::master()) return;

    fileName at(folder);
    while (!exists(at) && at.size() > 1) at = at.path();

    const bool isFolder = isDir(at);
    if (isFolder && access(at.c_str(), W_OK) == 0) return;
    const int fault = errno;    // before another call changes it

    FatalIOErrorInFunction(coeffs)
        << "nearWallInteraction cannot write its tables to " << folder.c_str() << nl
        << "    " << at.c_str() << ": "
        << (isFolder ? std::strerror(fault) : "a file, not a folder") << nl
        << "    Run in a copy of the case that you may write to."
        << exit(FatalIOError);
}


void Foam::nearWall::requireWritten(const bool isWritten, const fileName& file)
{
    if (isWritten) return;

    const int fault = errno;    // before another call changes it
    FatalErrorInFunction
        << "nearWallInteraction cannot write " << file << ": "
        << (fault ? std::strerror(fault) : "the file cannot be opened") << nl
        << "    Make room, then go on from the last written time; no row is lost"
        << " or counted twice." << exit(FatalError);
}


void Foam::nearWall::outputTable::write(const tableRow& row)
{
    if (!Pstream::master()) return;

    if (!file_)
    {
        mkDir(path_.path());
        file_.reset(new OFstream(path_));
        *file_ << "#";
        for (const auto& c : row.cells_) *file_ << ' ' << c.column.c_str();
        *file_ << nl;
    }

    const char* separator = "";
    for (const auto& c : row.cells_)
    {
        const std::string text(c.text.empty() ? exactText(c.number) : c.text);
        *file_ << separator << text.c_str();
        separator = " ";
    }
    errno = 0;
    *file_ << endl;
    requireWritten(file_->stdStream().good(), path_);
}


void Foam::nearWall::outputTable::archive(stateArchive& state)
{
    // No file, but on the master after the first row
    long length = file_ ? long(file_->stdStream().tellp()) : -1;
    state(length);
    if (!state.saves()) cutTo(length);
}


void Foam::nearWall::outputTable::cutTo(const long length)
{
    if (!file_) return;

    if (length < 0)
    {
        file_.reset();
        rm(path_);
        return;
    }
    errno = 0;
    file_->stdStream().flush();
    const bool isCut = truncate(path_.c_str(), length) == 0;
    file_->stdStream().seekp(length);
    requireWritten(isCut && file_->stdStream().good(), path_);
}
