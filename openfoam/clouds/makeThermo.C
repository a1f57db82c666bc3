// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "makeNearWallTransport.H"
#include "nearWallInteraction.H"
#include NEARWALL_EITHER("basicThermoCloud.H", "thermoCloud.H")

#define solverCloud NEARWALL_EITHER(basicThermoCloud, thermoCloud)

makeNearWallInteraction(solverCloud)
makeNearWallTransport(solverCloud)
