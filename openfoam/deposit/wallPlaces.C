// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallPlaces.H"
#include "impactKey.H"
#include "pointIOField.H"
#include "surfaceFields.H"
#include "versionCompat.H"

Foam::pointField Foam::nearWall::wallPlaces::firstPoints() const
{
    const fileName made(mesh_.facesInstance());
    if (made == mesh_.pointsInstance()) return mesh_.points();

    return pointIOField
    (
        IOobject
        (
            "points", made, polyMesh::meshSubDir, mesh_, IOobject::MUST_READ,
            IOobject::NO_WRITE, false
        )
    );
}


Foam::nearWall::wallPlaces::wallPlaces
(
    const fvMesh& mesh,
    const labelList& patches
)
:
    mesh_(mesh),
    patches_(patches),
    nFaces_(mesh.nFaces()),
    nCells_(mesh.nCells()),
    areas_(patches.size()),
    ranks_(patches.size())
{
    const pointField points(firstPoints());
    const scalar size = boundBox(points).mag();
    forAll(patches_, i)
    {
        const polyPatch& pp = patchesOf(mesh_)[patches_[i]];
        areas_[i] = mesh_.magSf().boundaryField()[patches_[i]];
        ranks_[i].setSize(pp.size());
        forAll(pp, facei)
        {
            impactKey place;
            place.add(pp[facei].centre(points), size);
            ranks_[i][facei] = scalar(place.value() >> 11)/9007199254740992.0;
        }
    }
}


void Foam::nearWall::wallPlaces::requireTopology() const
{
    const bool isSame =
        !topologyChanged(mesh_) && mesh_.nFaces() == nFaces_
     && mesh_.nCells() == nCells_;
    if (isSame) return;

    FatalErrorInFunction
        << "The cells or faces of the mesh have changed at time "
        << timeName(mesh_.time()) << ": key 'memory' of nearWallInteraction"
        << " cannot give the deposit to other faces." << nl
        << "    Take a mesh that only moves (dynamicMotionSolverFvMesh), or"
        << " remove the key." << exit(FatalError);
}


Foam::List<Foam::scalarField> Foam::nearWall::wallPlaces::follow()
{
    List<scalarField> factors(patches_.size());
    forAll(patches_, i)
    {
        const scalarField& now = mesh_.magSf().boundaryField()[patches_[i]];
        factors[i] = areas_[i]/now;
        areas_[i] = now;
    }
    return factors;
}
