/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallEdges.H.
\*---------------------------------------------------------------------------*/

#include "nearWallEdges.H"
#include "nearWallCompat.H"
#include "Map.H"
#include "syncTools.H"

void Foam::nearWall::wallEdges::findEdges()
{
    // Also edges that have none of our faces on this rank: another rank's face
    // may be there
    labelHashSet edges;
    forAll(mesh_.boundaryMesh(), patchi)
    {
        const polyPatch& pp = mesh_.boundaryMesh()[patchi];
        if (pp.coupled()) continue;
        forAll(pp.meshEdges(), i) edges.insert(pp.meshEdges()[i]);
    }
    meshEdges_ = edges.sortedToc();
}


void Foam::nearWall::wallEdges::count(const labelList& patches)
{
    Map<label> place(2*meshEdges_.size());
    forAll(meshEdges_, i) place.insert(meshEdges_[i], i);

    const labelHashSet isOurs(patches);

    faces_.setSize(meshEdges_.size(), label(0));
    ours_.setSize(meshEdges_.size(), label(0));
    constraints_.setSize(meshEdges_.size(), label(0));
    forAll(mesh_.boundaryMesh(), patchi)
    {
        const polyPatch& pp = mesh_.boundaryMesh()[patchi];
        if (pp.coupled()) continue;

        const bool isConstraint = polyPatch::constraintType(pp.type());
        forAll(pp.faceEdges(), facei)
        {
            const labelList& edges = pp.faceEdges()[facei];
            forAll(edges, i)
            {
                const label e = place[pp.meshEdges()[edges[i]]];
                ++faces_[e];
                if (isOurs.found(patchi)) ++ours_[e];
                if (isConstraint) ++constraints_[e];
            }
        }
    }

    labelList* const counts[] = {&faces_, &ours_, &constraints_};
    for (labelList* const each : counts)
    {
        syncTools::syncEdgeList
        (
            mesh_, meshEdges_, *each, addTo(), label(0)
        );
    }
}


void Foam::nearWall::wallEdges::findSides(const labelList& patches)
{
    Map<label> place(2*meshEdges_.size());
    forAll(meshEdges_, i) place.insert(meshEdges_[i], i);

    sides_.setSize(patches.size());
    forAll(patches, i)
    {
        const polyPatch& pp = mesh_.boundaryMesh()[patches[i]];
        sides_[i].setSize(pp.size());
        forAll(pp, facei)
        {
            const face& f = pp[facei];
            const point centre(pp.faceCentres()[facei]);
            const vector area(pp.faceAreas()[facei]);
            const vector normal(area/mag(area));
            const labelList& edges = pp.faceEdges()[facei];

            List<side>& sides = sides_[i][facei];
            sides.setSize(f.size());
            forAll(edges, k)
            {
                const edge& e = mesh_.edges()[pp.meshEdges()[edges[k]]];
                vector outward(e.vec(mesh_.points()) ^ normal);
                if ((outward & (e.centre(mesh_.points()) - centre)) < 0)
                {
                    outward = -outward;
                }
                sides[k].edge = place[pp.meshEdges()[edges[k]]];
                sides[k].outward = outward;
            }
        }
    }
}


Foam::nearWall::wallEdges::wallEdges
(
    const fvMesh& mesh,
    const labelList& patches
)
:
    mesh_(mesh)
{
    findEdges();
    count(patches);
    findSides(patches);
}


void Foam::nearWall::wallEdges::sum(scalarField& given) const
{
    syncTools::syncEdgeList
    (
        mesh_, meshEdges_, given, addTo(), scalar(0)
    );
}
