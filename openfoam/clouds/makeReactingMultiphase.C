// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "basicReactingMultiphaseCloud.H"
#include "nearWallInteraction.H"

// Also serves coalCloud, whose base cloud type is the same
makeNearWallInteraction(basicReactingMultiphaseCloud)
