// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "densityCheck.H"
#include "versionCompat.H"

void Foam::nearWall::densityCheck::report(Ostream& os)
{
    // Assumed: the density of a material is known to some 50 %
    const scalar allowed = 1.5;

    for (densities& found : first_)
    {
        if (found.isDone) continue;

        const bool seen = found.material > 0 && found.parcel > 0;
        const scalar ratio = seen ? found.parcel/found.material : 1;
        const scalar factor = seen ? max(ratio, 1/ratio) : 0;
        const scalar largest = largestOfRanks(factor);
        found.isDone = largest > 0;
        if (largest <= allowed) continue;

        // Those of the rank with the largest factor
        const bool mine = factor == largest;
        const scalar parcel = largestOfRanks(mine ? found.parcel : 0);
        const scalar material = largestOfRanks(mine ? found.material : 0);
        os  << "    nearWallInteraction, warning: parcels";
        if (!found.injector.empty()) os << " of injector " << found.injector;
        os  << " have a density of " << parcel << " kg/m3, the material in the"
            << " model " << material << " kg/m3; impacts have that of the"
            << " parcels. Is it the right material?" << nl;
    }
}
