// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "basicSprayCloud.H"
#include "nearWallInteraction.H"

makeNearWallInteraction(basicSprayCloud)
