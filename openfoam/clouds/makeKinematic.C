// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "basicKinematicCloud.H"
#include "nearWallInteraction.H"

makeNearWallInteraction(basicKinematicCloud)
