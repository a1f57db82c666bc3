// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "patchSums.H"
#include "versionCompat.H"

Foam::nearWall::patchSums::patchSums
(
    const fvMesh& mesh,
    const labelList& patches,
    const wordList& names,
    const dictionary& saved,
    const fileName& folder,
    const word& ending
)
:
    added_(patches.size(), std::vector<kahanSum>(names.size()))
{
    for (const label patchi : patches)
    {
        const word& name = patchesOf(mesh)[patchi].name();
        sums_.append(runningTotals(names, saved.subOrEmptyDict(name), name));
        tables_.emplace_back(folder/(name + ending));
    }
}


void Foam::nearWall::patchSums::add
(
    const label i,
    const label t,
    const scalar value
)
{
    const scalar added = added_[i][t].add(value);
    sums_[i].add(t, added - sums_[i].added()[t]);
}
