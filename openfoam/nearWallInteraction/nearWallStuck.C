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

namespace
{

using namespace Foam;

//- Does a film run on the walls?
bool filmWanted(const dictionary& coeffs)
{
    return
        coeffs.found("memory") && coeffs.isDict("memory")
     && nearWall::readOr<Switch>
        (
            coeffs.subDict("memory"), "film", Switch(false)
        );
}

} // End anonymous namespace


Foam::nearWall::stuckFate Foam::nearWall::readStuckFate
(
    const dictionary& coeffs
)
{
    const word what(readOr<word>(coeffs, "stuck", word("keep")));
    if (what == "keep") return stuckFate::keep;
    if (what == "react") return stuckFate::react;
    if (what == "remove") return stuckFate::remove;
    if (what == "slide" && filmWanted(coeffs)) return stuckFate::slide;

    if (what == "slide")
    {
        FatalIOErrorInFunction(coeffs)
            << "key 'stuck' is 'slide', but no film runs on the walls" << nl
            << "    Add  memory { film yes; }  or say keep, react or remove"
            << exit(FatalIOError);
    }
    FatalIOErrorInFunction(coeffs)
        << "key 'stuck' is '" << what
        << "', must be keep, react, remove or slide" << exit(FatalIOError);
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

        case stuckFate::slide:
            Info<< "molten ones join the film on the wall, others are kept in"
                << " the cloud " << depositName << ", inert";
            break;
    }
    Info<< nl;
}
