/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallDepositCloud.H.
\*---------------------------------------------------------------------------*/

#include "nearWallDepositCloud.H"
#include "mapPolyMesh.H"
#include "nearWallCompat.H"

namespace Foam
{
    defineTemplateTypeNameAndDebug(Cloud<nearWallDepositParticle>, 0);
}

Foam::nearWall::depositCloud::depositCloud(const fvMesh& mesh, const word& cloudName)
:
    Cloud<nearWallDepositParticle>(mesh, nameFor(cloudName), false),
    topologyMayChange_(nearWall::topologyMayChange(mesh))
{
    nearWallDepositParticle::readFields(*this);
}


std::shared_ptr<Foam::nearWall::depositCloud> Foam::nearWall::depositCloud::read
(
    const fvMesh& mesh,
    const word& cloudName
)
{
    // OpenFOAM numbers the particles of all clouds with one counter, and each
    // cloud that is read sets it: the solver's cloud must find its own again
    const label count = particle::particleCount_;
    std::shared_ptr<depositCloud> cloud(new depositCloud(mesh, cloudName));
    particle::particleCount_ = count;
    return cloud;
}


bool Foam::nearWall::depositCloud::anywhere() const
{
    return returnReduce(size(), sumOp<label>()) > 0;
}


Foam::scalar Foam::nearWall::depositCloud::mass() const
{
    scalar sum = 0;
    for (const nearWallDepositParticle& p : *this)
    {
        sum += p.asCaptured().mass;
    }
    return sum;
}


void Foam::nearWall::depositCloud::rememberPlaces()
{
    // Assumed: OpenFOAM stops the run when rounding puts a particle outside
    // the mesh, so a place on the wall is taken that much inside of it
    const scalar inside = 1e-9;

    places_.setSize(size());
    label i = 0;
    for (const nearWallDepositParticle& p : *this)
    {
        const point place(p.position());
        const point& centre = pMesh().cellCentres()[p.cell()];
        places_[i++] = place + inside*(centre - place);
    }
}


void Foam::nearWall::depositCloud::endStep()
{
    if (pMesh().time().writeTime())
    {
        // An empty deposit leaves no files
        setWritten(*this, anywhere(), 0);
    }
    if (topologyMayChange_)
    {
        rememberPlaces();
    }
}


void Foam::nearWall::depositCloud::autoMap(const mapPolyMesh& mapper)
{
    pMesh().tetBasePtIs();

    label i = 0;
    for (nearWallDepositParticle& p : *this)
    {
        p.autoMap(places_[i++], mapper);
    }
}


void Foam::nearWall::depositCloud::writeObjects(objectRegistry& registry) const
{
    nearWallDepositParticle::writeObjects(*this, registry);
}
