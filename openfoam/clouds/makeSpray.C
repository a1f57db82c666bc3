/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        Registers the model with basicSprayCloud.
\*---------------------------------------------------------------------------*/

#include "basicSprayCloud.H"
#include "nearWallInteraction.H"

makeNearWallInteraction(basicSprayCloud)
