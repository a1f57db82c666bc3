/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallCloud.H.
\*---------------------------------------------------------------------------*/

#include "nearWallCloud.H"
#include "nearWallCompat.H"
#include "IOstreams.H"

void Foam::nearWall::announceCarbon
(
    const dictionary& coeffs,
    const wordList& solids
)
{
    const word carbon(readOr<word>(coeffs, "carbon", word("C")));
    forAll(solids, i)
    {
        if (solids[i] == carbon)
        {
            Info<< "    nearWallInteraction: carbon conversion from solid"
                << " component '" << carbon << "'" << nl;
            return;
        }
    }

    if (coeffs.found("carbon"))
    {
        FatalIOErrorInFunction(coeffs)
            << "carbon: this cloud has no solid component '" << carbon << "'"
            << nl;
        if (solids.size())
        {
            FatalIOError << "    The solid has " << solids;
        }
        else
        {
            FatalIOError
                << "    It has no solid components at all: remove the key";
        }
        FatalIOError << exit(FatalIOError);
    }

    Info<< "    nearWallInteraction: no carbon in this cloud, conversion 1"
        << nl;
}
