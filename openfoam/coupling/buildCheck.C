// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "buildCheck.H"
#include "versionCompat.H"
#include "nearwall.h"

// Written by Allwmake: defines NEARWALL_BUILT_FOR, a text
#include "nearWallStamp.H"

extern "C"
{
    //- Kept in the file's symbol table for tools
    extern const char nearWallInteraction_built_for[];
    const char nearWallInteraction_built_for[] =
        "nearwall built-for: " NEARWALL_BUILT_FOR;
}


void Foam::nearWall::checkBuild()
{
    static bool done = false;
    if (done) return;
    done = true;

    Info<< "nearWallInteraction: nearwall " << nw_version()
        << ", built for " << NEARWALL_BUILT_FOR << endl;

    if (runningApi() != builtApi())
    {
        FatalErrorInFunction
            << "libnearWallInteraction.so was built for " << NEARWALL_BUILT_FOR
            << ", but " << runningVersion() << " is running." << nl
            << "    Run openfoam/Allwmake in the environment of this OpenFOAM."
            << exit(FatalError);
    }
}
