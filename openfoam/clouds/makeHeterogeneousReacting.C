// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The Foundation's versions have no such cloud
#ifdef OPENFOAM

#include "basicHeterogeneousReactingCloud.H"
#include "makeNearWallTransport.H"
#include "nearWallInteraction.H"

makeNearWallInteraction(basicHeterogeneousReactingCloud)
makeNearWallTransport(basicHeterogeneousReactingCloud)

#endif
