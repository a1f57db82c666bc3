// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cloudTraits.H"
#include "versionCompat.H"

void Foam::nearWall::reportCarbon
(
    const dictionary& coeffs,
    const wordList& solids
)
{
    const word carbon(readOr<word>(coeffs, "carbon", word("C")));
    forAll(solids, i)
    {
        if (solids[i] == carbon)
        {
            Info<< "    nearWallInteraction: carbon conversion from solid"
                << " component '" << carbon << "'" << nl;
            return;
        }
    }

    if (coeffs.found("carbon"))
    {
        FatalIOErrorInFunction(coeffs)
            << "Key 'carbon': this cloud has no solid component '" << carbon
            << "'." << nl;
        if (solids.size())
        {
            FatalIOError << "    The solid has " << solids;
        }
        else
        {
            FatalIOError
                << "    It has no solid components at all; remove the key.";
        }
        FatalIOError << exit(FatalIOError);
    }

    Info<< "    nearWallInteraction: no carbon in this cloud, conversion 1"
        << nl;
}


void Foam::nearWall::checkReturning
(
    const dictionary& coeffs,
    const bool hasDrops,
    const bool stuckAreRemoved,
    const bool oneModel
)
{
    const dictionary& shed = coeffs.subDict("memory").subDict("shed");
    const char* why = nullptr;
    if (NEARWALL_EITHER(false, true))
    {
        why = "is for OpenFOAM.com's versions only.\n    Write parcels no;";
    }
    else if (hasDrops)
    {
        why =
            "is not for the drops of this cloud, whose density follows from"
            " their temperature.\n    Write parcels no;";
    }
    else if (!stuckAreRemoved)
    {
        why =
            "would give back what the key 'stuck' keeps in the deposit cloud or"
            " in the solver's.\n    Write stuck remove;";
    }
    else if (!oneModel)
    {
        why =
            "gives back parcels of no injector, and each injector has a model of"
            " its own.\n    Write parcels no; or remove the key 'injectors'.";
    }
    if (why)
    {
        FatalIOErrorInFunction(shed)
            << "Key 'parcels' of memory, shed: it " << why << exit(FatalIOError);
    }
}


void Foam::nearWall::refuseWallSpring(const dictionary& subModels)
{
    const word collision(readOr<word>(subModels, "collisionModel", word("none")));
    const dictionary coeffs(subModels.subOrEmptyDict(collision + "Coeffs"));
    const word wall(readOr<word>(coeffs, "wallModel", word("none")));
    if (collision == "none" || wall == "none" || wall == "nearWall") return;

    FatalIOErrorInFunction(coeffs)
        << "The springs of wallModel '" << wall << "' turn parcels back before"
        << " their centres reach a wall, so that nearWallInteraction would"
        << " decide nothing." << nl
        << "    Let it decide where the surfaces touch: wallModel nearWall; nearWallCoeffs { }"
        << exit(FatalIOError);
}
