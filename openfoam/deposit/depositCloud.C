// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "depositCloud.H"
#include "versionCompat.H"

#ifdef OPENFOAM
namespace Foam
{
    defineTemplateTypeNameAndDebug(Cloud<nearWallDepositParticle>, 0);
}
#endif

Foam::nearWall::depositCloud::depositCloud
(
    const fvMesh& mesh,
    const word& cloudName
)
:
    nearWallDepositParticle::cloudType(mesh, cloudName + "Deposit", false),
    topologyMayChange_(nearWall::topologyMayChange(mesh))
{
    nearWallDepositParticle::readFields(*this);
}


std::shared_ptr<Foam::nearWall::depositCloud>
Foam::nearWall::depositCloud::read(const fvMesh& mesh, const word& cloudName)
{
    // OpenFOAM numbers the particles of all clouds with one counter, which each
    // cloud sets when it is read: the solver's cloud must keep its own value
    const label count = nextParticle<particle>();
    std::shared_ptr<depositCloud> cloud(new depositCloud(mesh, cloudName));
    nextParticle<particle>() = count;
    return cloud;
}


bool Foam::nearWall::depositCloud::hasParcels() const
{
    return sumOfRanks(size()) > 0;
}


Foam::scalar Foam::nearWall::depositCloud::mass() const
{
    scalar sum = 0;
    for (const nearWallDepositParticle& p : *this) sum += p.state().mass;
    return sum;
}


void Foam::nearWall::depositCloud::storePositions()
{
    #ifndef OPENFOAM
    storeGlobalPositions();
    #else
    // Assumed: OpenFOAM stops the run when rounding puts a particle outside the
    // mesh, so a position on the wall is shifted inwards by this fraction
    const scalar inside = 1e-9;

    positions_.setSize(size());
    label i = 0;
    for (const nearWallDepositParticle& p : *this)
    {
        const point position(positionOf(p, pMesh()));
        const point& centre = pMesh().cellCentres()[p.cell()];
        positions_[i++] = position + inside*(centre - position);
    }
    #endif
}


void Foam::nearWall::depositCloud::endStep()
{
    // An empty deposit leaves no files
    if (pMesh().time().writeTime())
    {
        setWriteOption
        (
            *this, hasParcels() ? IOobject::AUTO_WRITE : IOobject::NO_WRITE
        );
    }
    if (topologyMayChange_) storePositions();
}


void Foam::nearWall::depositCloud::archive(stateArchive& state)
{
    label n = size();
    state(n);
    state.require(n <= size());
    label i = 0;
    for (nearWallDepositParticle& p : *this)
    {
        if (i++ >= n) deleteParticle(p);
    }
}


#ifdef OPENFOAM
void Foam::nearWall::depositCloud::autoMap(const mapPolyMesh& mapper)
{
    pMesh().tetBasePtIs();

    label i = 0;
    for (nearWallDepositParticle& p : *this) p.autoMap(positions_[i++], mapper);
}
#endif
