// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "dictionaryChecks.H"

void Foam::nearWall::refuseUnknownKeys
(
    const dictionary& dict,
    const wordList& known,
    const string& where
)
{
    forAllConstIter(dictionary, dict, iter)
    {
        const word key((*iter).keyword());
        bool isKnown = false;
        forAll(known, i) isKnown = isKnown || known[i] == key;

        if (!isKnown)
        {
            FatalIOErrorInFunction(dict)
                << where.c_str() << ": unknown key '" << key << "'." << nl
                << "    The known keys are " << known << exit(FatalIOError);
        }
    }
}


void Foam::nearWall::warnOfCelsius(const scalar T, const string& where)
{
    // Assumed: few walls, coolants and particles are colder
    if (T >= 150) return;

    Info<< "    nearWallInteraction, warning: " << where.c_str() << " is " << T
        << " K. If that is in degrees Celsius, write " << T + 273.15 << nl;
}
