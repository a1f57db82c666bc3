// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "basicThermoCloud.H"
#include "nearWallInteraction.H"

makeNearWallInteraction(basicThermoCloud)
