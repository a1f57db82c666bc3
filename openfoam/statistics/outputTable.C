// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "outputTable.H"
#include "exactText.H"
#include "OSspecific.H"
#include "Pstream.H"

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
    *file_ << endl;
}
