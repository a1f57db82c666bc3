// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallHitFields.H"
#include "surfaceFields.H"
#include "wallField.H"

Foam::nearWall::wallHitFields::wallHitFields
(
    const fvMesh& mesh,
    const word& cloudName,
    const bool erodes
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
{
    if (!erodes) return;

    erodedDepth_.reset
    (
        new volScalarField
        (
            readWallField(mesh, cloudName + ":erodedDepth", dimLength)
        )
    );
}


void Foam::nearWall::wallHitFields::clear()
{
    depositedMass_.boundaryFieldRef() = 0;
    hitCount_.boundaryFieldRef() = 0;
    meanImpactSpeed_.boundaryFieldRef() = 0;
    if (erodedDepth_) erodedDepth_->boundaryFieldRef() = 0;
}


void Foam::nearWall::wallHitFields::add(const impactEvent& e)
{
    scalar& n = hitCount_.boundaryFieldRef()[e.patch][e.face];
    scalar& mean = meanImpactSpeed_.boundaryFieldRef()[e.patch][e.face];
    n += 1;
    mean += (e.speed - mean)/n;

    const scalar area =
        hitCount_.mesh().magSf().boundaryField()[e.patch][e.face];
    if (e.result == impactEvent::stuck)
    {
        depositedMass_.boundaryFieldRef()[e.patch][e.face] += e.mass/area;
    }
    if (erodedDepth_)
    {
        erodedDepth_->boundaryFieldRef()[e.patch][e.face] += e.eroded/area;
    }
}


void Foam::nearWall::wallHitFields::archive(stateArchive& state)
{
    for
    (
        volScalarField* const field :
        {&depositedMass_, &hitCount_, &meanImpactSpeed_, erodedDepth_.get()}
    )
    {
        if (!field) continue;

        auto& patches = field->boundaryFieldRef();
        forAll(patches, patchi) state.values(patches[patchi]);
    }
}
