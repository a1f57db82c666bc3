// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallEdges.H"
#include "syncTools.H"
#include "versionCompat.H"

void Foam::nearWall::wallEdges::findEdges()
{
    // Also edges without a face of the given patches on this rank: another rank
    // may have one there
    labelHashSet edges;
    forAll(patchesOf(mesh_), patchi)
    {
        const polyPatch& pp = patchesOf(mesh_)[patchi];
        if (pp.coupled()) continue;
        forAll(pp.meshEdges(), i) edges.insert(pp.meshEdges()[i]);
    }
    meshEdges_ = edges.sortedToc();
    forAll(meshEdges_, i) index_.insert(meshEdges_[i], i);
}


void Foam::nearWall::wallEdges::countFaces()
{
    const labelHashSet isOwn(patches_);

    faces_.setSize(meshEdges_.size(), label(0));
    ownFaces_.setSize(meshEdges_.size(), label(0));
    constraintFaces_.setSize(meshEdges_.size(), label(0));
    forAll(patchesOf(mesh_), patchi)
    {
        const polyPatch& pp = patchesOf(mesh_)[patchi];
        if (pp.coupled()) continue;

        const bool constrained = isConstraint(pp);
        forAll(pp.faceEdges(), facei)
        {
            const labelList& edges = pp.faceEdges()[facei];
            forAll(edges, i)
            {
                const label e = index_[pp.meshEdges()[edges[i]]];
                ++faces_[e];
                if (isOwn.found(patchi)) ++ownFaces_[e];
                if (constrained) ++constraintFaces_[e];
            }
        }
    }

    labelList* const counts[] = {&faces_, &ownFaces_, &constraintFaces_};
    for (labelList* const each : counts)
    {
        syncTools::syncEdgeList(mesh_, meshEdges_, *each, addTo(), label(0));
    }
}


void Foam::nearWall::wallEdges::findSides()
{
    sides_.setSize(patches_.size());
    forAll(patches_, i)
    {
        const polyPatch& pp = patchesOf(mesh_)[patches_[i]];
        sides_[i].setSize(pp.size());
        forAll(pp, facei)
        {
            const point centre(pp.faceCentres()[facei]);
            const vector area(pp.faceAreas()[facei]);
            const vector normal(area/mag(area));
            const labelList& edges = pp.faceEdges()[facei];

            List<side>& sides = sides_[i][facei];
            sides.setSize(edges.size());
            forAll(edges, k)
            {
                const label meshEdge = pp.meshEdges()[edges[k]];
                const edge& e = mesh_.edges()[meshEdge];
                vector outward(e.vec(mesh_.points()) ^ normal);
                if ((outward & (e.centre(mesh_.points()) - centre)) < 0)
                {
                    outward = -outward;
                }
                sides[k].edge = index_[meshEdge];
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
    mesh_(mesh),
    patches_(patches)
{
    findEdges();
    countFaces();
    findSides();
}


void Foam::nearWall::wallEdges::sum(scalarField& values) const
{
    syncTools::syncEdgeList(mesh_, meshEdges_, values, addTo(), scalar(0));
}
