// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallFilm.H"
#include "surfaceFields.H"
#include "versionCompat.H"

namespace
{

using namespace Foam;

//- Fraction of a face that a wave of the film crosses in one step; below 1, as
//  a wave may become faster within it
const scalar courant = 0.5;

} // End anonymous namespace


Foam::vector Foam::nearWall::wallFilm::velocity
(
    const filmPatch& p,
    const label patchi,
    const label facei
) const
{
    const vector& area = mesh_.Sf().boundaryField()[patchi][facei];
    const vector normal(area/mag(area));
    const vector along(gravity_ - (gravity_ & normal)*normal);
    const scalar g = mag(along);
    if (g <= SMALL*mag(gravity_)) return Zero;

    nw_deposit here(nearwall::make_deposit(p.wall));
    here.molten = p.molten[facei];
    scalar speed = 0;
    const nw_status status =
        model_->film_velocity(here, p.T[facei], p.heatFlux[facei], g, speed);
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "The velocity of the film on patch '"
            << mesh_.boundary()[patchi].name() << "' cannot be computed: "
            << nw_status_text(status) << " (molten " << p.molten[facei]
            << " kg/m2 at " << p.T[facei] << " K)."
            << exit(FatalError);
    }
    return speed/g*along;
}


Foam::List<Foam::scalarField> Foam::nearWall::wallFilm::outflows
(
    const List<filmPatch>& film,
    scalar& rate
) const
{
    List<scalarField> out(film.size());
    rate = 0;
    forAll(film, i)
    {
        const filmPatch& p = film[i];
        DynamicList<scalar> flows(4*p.molten.size());
        forAll(p.molten, facei)
        {
            const List<wallEdges::side>& sides = edges_.sides(i, facei);
            const vector u
            (
                p.molten[facei] > 0
              ? velocity(p, patches_[i], facei)
              : vector(Zero)
            );
            scalar all = 0;
            forAll(sides, k)
            {
                const scalar flow =
                    edges_.isClosed(sides[k].edge)
                  ? 0
                  : max(scalar(0), u & sides[k].outward);
                flows.append(flow);
                all += flow;
            }

            // A wave has three times the mean velocity
            rate = max(rate, 3*all/p.area[facei]);
        }
        out[i] = scalarField(flows);
    }
    rate = largestOfRanks(rate);
    return out;
}


void Foam::nearWall::wallFilm::step
(
    List<filmPatch>& film,
    const List<scalarField>& out,
    const scalar dt
)
{
    // Outflow of all faces over each edge: mass, and mass times conversion [kg]
    scalarField given(edges_.size(), scalar(0));
    scalarField converted(edges_.size(), scalar(0));
    forAll(film, i)
    {
        label n = 0;
        forAll(film[i].molten, facei)
        {
            const List<wallEdges::side>& sides = edges_.sides(i, facei);
            forAll(sides, k)
            {
                const scalar mass = dt*out[i][n++]*film[i].molten[facei];
                given[sides[k].edge] += mass;
                converted[sides[k].edge] += mass*film[i].conversion[facei];
            }
        }
    }
    edges_.sum(given);
    edges_.sum(converted);

    forAll(film, i)
    {
        filmPatch& p = film[i];
        label n = 0;
        forAll(p.molten, facei)
        {
            const List<wallEdges::side>& sides = edges_.sides(i, facei);
            scalar change = 0;
            scalar convertedChange = 0;
            forAll(sides, k)
            {
                const label e = sides[k].edge;
                const scalar own = dt*out[i][n++]*p.molten[facei];
                if (edges_.isClosed(e)) continue;

                const scalar received = (given[e] - own)*edges_.share(e);
                const scalar lost = own*edges_.lost(e);
                const scalar ownConverted = own*p.conversion[facei];
                change += received - own;
                convertedChange +=
                    (converted[e] - ownConverted)*edges_.share(e)
                  - ownConverted;
                p.drained += lost;
                p.fromOthers += received - (own - lost);
            }
            if (change == 0 && convertedChange == 0) continue;

            const scalar area = p.area[facei];
            const scalar before = p.molten[facei] + p.solid[facei];
            p.molten[facei] = max(scalar(0), p.molten[facei] + change/area);
            const scalar after = p.molten[facei] + p.solid[facei];
            if (after > 0)
            {
                const scalar sum =
                    before*p.conversion[facei] + convertedChange/area;
                p.conversion[facei] =
                    max(scalar(0), min(scalar(1), sum/after));
            }
        }
    }
}


Foam::nearWall::wallFilm::wallFilm
(
    const fvMesh& mesh,
    const labelList& patches,
    const wallModelPtr& model,
    const vector& gravity
)
:
    mesh_(mesh),
    patches_(patches),
    model_(model),
    gravity_(gravity),
    edges_(mesh, patches)
{}


void Foam::nearWall::wallFilm::flow
(
    List<filmPatch>& film,
    const scalar duration
)
{
    scalar left = duration;
    while (left > 0)
    {
        scalar rate = 0;
        const List<scalarField> out(outflows(film, rate));
        if (rate <= 0) return;

        // Equal steps to the end, or the rest of it
        const scalar steps = ceil(left*rate/courant);
        const scalar dt = left/max(steps, scalar(1));
        step(film, out, dt);
        left = steps > 1 ? left - dt : 0;
    }
}
