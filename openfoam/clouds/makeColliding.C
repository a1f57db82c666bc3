// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "basicKinematicCollidingCloud.H"
#include "nearWallContact.H"

makeNearWallInteraction(basicKinematicCollidingCloud)
makeWallModelType(nearWallContact, basicKinematicCollidingCloud)
