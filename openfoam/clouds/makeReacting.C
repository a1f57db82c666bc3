// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "makeNearWallTransport.H"
#include "nearWallInteraction.H"
#include NEARWALL_EITHER("basicReactingCloud.H", "reactingCloud.H")

#define solverCloud NEARWALL_EITHER(basicReactingCloud, reactingCloud)

makeNearWallInteraction(solverCloud)
makeNearWallTransport(solverCloud)
