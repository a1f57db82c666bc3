// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "makeNearWallTransport.H"
#include "nearWallContact.H"
#include NEARWALL_EITHER("basicKinematicCollidingCloud.H", "collidingCloud.H")

#define solverCloud NEARWALL_EITHER(basicKinematicCollidingCloud, collidingCloud)

makeNearWallInteraction(solverCloud)
makeNearWallTransport(solverCloud)
makeWallModelType(nearWallContact, solverCloud)
