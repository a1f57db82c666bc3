/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallFields.H.
\*---------------------------------------------------------------------------*/

#include "nearWallFields.H"
#include "surfaceFields.H"

namespace
{

using namespace Foam;

IOobject wallFieldIO(const fvMesh& mesh, const word& name)
{
    return IOobject
    (
        name,
        mesh.time().timeName(),
        mesh,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    );
}

} // End anonymous namespace


Foam::nearWall::wallFields::wallFields
(
    const fvMesh& mesh,
    const word& cloudName
)
:
    depositedMass_
    (
        wallFieldIO(mesh, cloudName + ":depositedMass"),
        mesh,
        dimensionedScalar("zero", dimMass/dimArea, 0)
    ),
    hitCount_
    (
        wallFieldIO(mesh, cloudName + ":hitCount"),
        mesh,
        dimensionedScalar("zero", dimless, 0)
    ),
    meanImpactSpeed_
    (
        wallFieldIO(mesh, cloudName + ":meanImpactSpeed"),
        mesh,
        dimensionedScalar("zero", dimVelocity, 0)
    )
{}


void Foam::nearWall::wallFields::addHit
(
    const label patchi,
    const label facei,
    const scalar speed
)
{
    scalar& n = hitCount_.boundaryFieldRef()[patchi][facei];
    scalar& mean = meanImpactSpeed_.boundaryFieldRef()[patchi][facei];
    n += 1;
    mean += (speed - mean)/n;
}


void Foam::nearWall::wallFields::addDeposit
(
    const label patchi,
    const label facei,
    const scalar mass
)
{
    const scalar area =
        depositedMass_.mesh().magSf().boundaryField()[patchi][facei];
    depositedMass_.boundaryFieldRef()[patchi][facei] += mass/area;
}
