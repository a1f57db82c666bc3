// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "makeNearWallTransport.H"
#include "nearWallInteraction.H"
#include NEARWALL_EITHER("basicSprayCloud.H", "sprayCloud.H")

#define solverCloud NEARWALL_EITHER(basicSprayCloud, sprayCloud)

makeNearWallInteraction(solverCloud)
makeNearWallTransport(solverCloud)
