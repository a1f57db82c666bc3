// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "runningTotals.H"
#include "exactText.H"
#include "versionCompat.H"

Foam::nearWall::runningTotals::runningTotals
(
    const wordList& names,
    const dictionary& saved,
    const word& name
)
:
    name_(name),
    names_(names),
    base_(names.size()),
    added_(names.size(), scalar(0))
{
    forAll(names_, i) base_[i] = readExact(saved, names_[i]);
}


Foam::dictionary Foam::nearWall::runningTotals::saved
(
    const scalarList& totals
) const
{
    dictionary dict;
    forAll(names_, i) addExact(dict, names_[i], totals[i]);
    return dict;
}


Foam::dictionary Foam::nearWall::runningTotals::saved
(
    const UList<runningTotals>& sums,
    const UList<scalarList>& totals
)
{
    dictionary dict;
    forAll(sums, i) dict.add(keyType(sums[i].name()), sums[i].saved(totals[i]));
    return dict;
}


Foam::List<Foam::scalarList> Foam::nearWall::runningTotals::totals
(
    const UList<runningTotals>& sums
)
{
    DynamicList<scalar> all;
    forAll(sums, i) all.append(sums[i].added());
    scalarList added(all);
    sumOverRanks(added);

    List<scalarList> totals(sums.size());
    label n = 0;
    forAll(sums, i)
    {
        totals[i] = sums[i].base();
        forAll(totals[i], j) totals[i][j] += added[n++];
    }
    return totals;
}
