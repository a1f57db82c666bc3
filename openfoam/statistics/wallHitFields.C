// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallHitFields.H"
#include "surfaceFields.H"

Foam::volScalarField Foam::nearWall::readWallField
(
    const fvMesh& mesh,
    const word& name,
    const dimensionSet& dimensions
)
{
    return volScalarField
    (
        IOobject
        (
            name,
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        mesh,
        dimensionedScalar("zero", dimensions, 0)
    );
}


Foam::nearWall::wallHitFields::wallHitFields
(
    const fvMesh& mesh,
    const word& cloudName
)
:
    depositedMass_
    (
        readWallField(mesh, cloudName + ":depositedMass", dimMass/dimArea)
    ),
    hitCount_(readWallField(mesh, cloudName + ":hitCount", dimless)),
    meanImpactSpeed_
    (
        readWallField(mesh, cloudName + ":meanImpactSpeed", dimVelocity)
    )
{}


void Foam::nearWall::wallHitFields::add(const impactEvent& e)
{
    scalar& n = hitCount_.boundaryFieldRef()[e.patch][e.face];
    scalar& mean = meanImpactSpeed_.boundaryFieldRef()[e.patch][e.face];
    n += 1;
    mean += (e.speed - mean)/n;

    if (e.result == impactEvent::stuck)
    {
        const scalarField& area =
            depositedMass_.mesh().magSf().boundaryField()[e.patch];
        depositedMass_.boundaryFieldRef()[e.patch][e.face] +=
            e.mass/area[e.face];
    }
}
