// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearestWall.H"
#include "FaceCellWave.H"
#include "globalIndex.H"
#include "wallFvPatch.H"

namespace
{

using namespace Foam;

//- Radius of the disc around the centre of a face that holds all its points
scalar radiusOf(const polyPatch& patch, const label facei)
{
    scalar square = 0;
    for (const label pointi : patch[facei])
    {
        square = max(square, magSqr(patch.points()[pointi] - patch.faceCentres()[facei]));
    }
    return Foam::sqrt(square);
}

} // End anonymous namespace


bool Foam::nearWall::nearestWall::isWall(const fvPatch& patch)
{
    return isA<wallFvPatch>(patch);
}


Foam::labelList Foam::nearWall::nearestWall::listOwn()
{
    DynamicList<label> meshFaces;
    DynamicList<point> centres;
    DynamicList<vector> normals;
    DynamicList<scalar> radii;
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (!isWall(patch)) continue;
        normals.append(vectorField(-patch.nf()));
        forAll(patch, i)
        {
            meshFaces.append(patch.start() + i);
            centres.append(patch.Cf()[i]);
            radii.append(radiusOf(patchesOf(mesh_)[patch.index()], i));
        }
    }
    centres_.transfer(centres);
    normals_.transfer(normals);
    radii_.transfer(radii);
    return labelList(meshFaces);
}


void Foam::nearWall::nearestWall::find()
{
    const labelList meshFaces(listOwn());
    const globalIndex numbers(meshFaces.size());
    List<WallFaceInfo> start(meshFaces.size());
    forAll(start, i)
    {
        start[i] = wallFaceInfo(centres_[i], numbers.toGlobal(i));
    }
    List<WallFaceInfo> onFaces(mesh_.nFaces()), inCells(mesh_.nCells());
    FaceCellWave<WallFaceInfo>
    (
        mesh_, meshFaces, start, onFaces, inCells, mesh_.globalData().nTotalCells() + 1
    );

    faceOf_.setSize(mesh_.nCells());
    int unused = 0;
    forAll(faceOf_, celli)
    {
        const WallFaceInfo& info = inCells[celli];
        faceOf_[celli] = info.valid(unused) ? info.data() : -1;
    }

    takeOwnFaces(meshFaces, numbers);
    List<Map<label>> compact;
    map_.reset(new DistributionMap(numbers, faceOf_, compact));
    bring(centres_);
    bring(normals_);
    bring(radii_);
}


void Foam::nearWall::nearestWall::takeOwnFaces
(
    const labelList& meshFaces,
    const globalIndex& numbers
)
{
    scalarField nearest(mesh_.nCells(), GREAT);
    forAll(meshFaces, i)
    {
        const label celli = mesh_.faceOwner()[meshFaces[i]];
        const scalar distance = (mesh_.C()[celli] - centres_[i]) & normals_[i];
        if (distance < nearest[celli])
        {
            nearest[celli] = distance;
            faceOf_[celli] = numbers.toGlobal(i);
        }
    }
}
