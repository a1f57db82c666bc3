// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "makeNearWallTransport.H"
#include "nearWallInteraction.H"
#include NEARWALL_EITHER("basicReactingMultiphaseCloud.H", "reactingMultiphaseCloud.H")

#define solverCloud NEARWALL_EITHER(basicReactingMultiphaseCloud, reactingMultiphaseCloud)

// Also serves coalCloud, whose base cloud type is the same
makeNearWallInteraction(solverCloud)
makeNearWallTransport(solverCloud)
