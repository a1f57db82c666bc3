/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        The build stamp. `strings libnearWallInteraction.so | grep built-for` reads
        it without loading the library.
\*---------------------------------------------------------------------------*/

#include "nearWallBuild.H"
#include "nearWallCompat.H"
#include "nearWallLibrary.H"
#include "nearwall.h"

// Written by Allwmake: NEARWALL_BUILT_FOR, a text
#include "nearWallStamp.H"

extern "C"
{
    //- Kept in the file's symbol table for tools
    extern const char nearWallInteraction_built_for[];
    const char nearWallInteraction_built_for[] =
        "nearwall built-for: " NEARWALL_BUILT_FOR;
}


void Foam::nearWall::announceBuild(const dictionary& dict)
{
    static bool done = false;
    if (done) return;
    done = true;

    const std::string fault(openLibrary());
    if (!fault.empty())
    {
        FatalIOErrorInFunction(dict)
            << "patchInteractionModel nearWallInteraction: libnearwall.so"
            << " cannot be opened:" << nl
            << "    " << fault << nl
            << "    Run openfoam/Allwmake of nearwall again: it puts "
            << libraryPath() << nl
            << "    beside libnearWallInteraction.so; move or copy the two"
            << " together." << exit(FatalIOError);
    }

    Info<< "nearWallInteraction: nearwall " << nw_version()
        << ", built for " << NEARWALL_BUILT_FOR << endl;

    if (nw_abi_version() != NW_ABI_VERSION)
    {
        FatalErrorInFunction
            << "libnearwall.so speaks version " << label(nw_abi_version())
            << " of its interface, libnearWallInteraction.so was built for "
            << label(NW_ABI_VERSION) << nl
            << "    Run openfoam/Allwmake again; the two belong together."
            << exit(FatalError);
    }

    if (runningApi() != builtApi())
    {
        FatalErrorInFunction
            << "libnearWallInteraction.so was built for " << NEARWALL_BUILT_FOR
            << " but " << runningVersion() << " is running" << nl
            << "    Run openfoam/Allwmake in the environment of this OpenFOAM."
            << exit(FatalError);
    }
}
