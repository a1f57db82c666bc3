/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallStuck.H.
\*---------------------------------------------------------------------------*/

#include "nearWallStuck.H"
#include "nearWallCompat.H"

Foam::nearWall::stuckFate Foam::nearWall::readStuckFate
(
    const dictionary& coeffs
)
{
    const word what(readOr<word>(coeffs, "stuck", word("keep")));
    if (what == "keep") return stuckFate::keep;
    if (what == "react") return stuckFate::react;
    if (what == "remove") return stuckFate::remove;

    FatalIOErrorInFunction(coeffs)
        << "key 'stuck' is '" << what << "', must be keep, react or remove"
        << exit(FatalIOError);
    return stuckFate::keep;
}


void Foam::nearWall::reportStuckFate
(
    const stuckFate what,
    const word& depositName
)
{
    Info<< "    nearWallInteraction, stuck parcels: ";
    switch (what)
    {
        case stuckFate::keep:
            Info<< "kept in the cloud " << depositName << ", inert";
            break;

        case stuckFate::react:
            Info<< "stay in this cloud and go on reacting";
            break;

        case stuckFate::remove:
            Info<< "removed";
            break;
    }
    Info<< nl;
}
