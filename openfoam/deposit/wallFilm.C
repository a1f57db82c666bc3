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
    const depositFields& fields,
    const label patchi,
    const label facei
) const
{
    const vector& area = mesh_.Sf().boundaryField()[patchi][facei];
    const vector normal(area/mag(area));
    const vector along(gravity_ - (gravity_ & normal)*normal);
    const scalar g = mag(along);
    if (g <= SMALL*mag(gravity_)) return Zero;

    nw_deposit here(nearwall::make_deposit(walls_[patchi]));
    here.molten = fields.on(depositFields::molten, patchi)[facei];
    const scalar T = fields.on(depositFields::temperature, patchi)[facei];
    const scalar flux =
        fields.has(depositFields::heatFlux)
      ? fields.on(depositFields::heatFlux, patchi)[facei]
      : 0;
    scalar speed = 0;
    const nw_status status = model_->film_velocity(here, T, flux, g, speed);
    if (status != NW_OK)
    {
        FatalErrorInFunction
            << "The velocity of the film on patch '"
            << mesh_.boundary()[patchi].name() << "' cannot be computed: "
            << nw_status_text(status) << " (molten " << here.molten
            << " kg/m2 at " << T << " K)."
            << exit(FatalError);
    }
    return speed/g*along;
}


Foam::List<Foam::scalarField> Foam::nearWall::wallFilm::outflows
(
    const depositFields& fields,
    scalar& rate
) const
{
    List<scalarField> out(patches_.size());
    rate = 0;
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        const scalarField& molten = fields.on(depositFields::molten, patchi);
        const scalarField& area = mesh_.magSf().boundaryField()[patchi];
        DynamicList<scalar> flows(4*molten.size());
        forAll(molten, facei)
        {
            const vector u
            (
                molten[facei] > 0 ? velocity(fields, patchi, facei) : vector(Zero)
            );
            scalar all = 0;
            for (const wallEdges::side& side : edges_.sides(i, facei))
            {
                const scalar flow =
                    edges_.isClosed(side.edge)
                  ? 0
                  : max(scalar(0), u & side.outward);
                flows.append(flow);
                all += flow;
            }

            // A wave has three times the mean velocity
            rate = max(rate, 3*all/area[facei]);
        }
        out[i] = scalarField(flows);
    }
    rate = largestOfRanks(rate);
    return out;
}


void Foam::nearWall::wallFilm::exchange
(
    depositFields& fields,
    const label i,
    const label facei,
    const scalar* const out,
    const edgeSums& given,
    const scalar dt,
    passage& passed
)
{
    const label patchi = patches_[i];
    const List<wallEdges::side>& sides = edges_.sides(i, facei);
    scalar& molten = fields.on(depositFields::molten, patchi)[facei];
    scalar& conversion = fields.on(depositFields::conversion, patchi)[facei];
    scalar change = 0;
    scalar convertedChange = 0;
    forAll(sides, k)
    {
        const label e = sides[k].edge;
        if (edges_.isClosed(e)) continue;

        const scalar own = dt*out[k]*molten;
        const scalar received = (given.mass[e] - own)*edges_.share(e);
        const scalar lost = own*edges_.lost(e);
        const scalar ownConverted = own*conversion;
        change += received - own;
        convertedChange +=
            (given.converted[e] - ownConverted)*edges_.share(e) - ownConverted;
        passed.drained += lost;
        passed.fromOthers += received - (own - lost);
    }
    if (change == 0 && convertedChange == 0) return;

    const scalar area = mesh_.magSf().boundaryField()[patchi][facei];
    const scalar rest =
        fields.on(depositFields::frozen, patchi)[facei]
      + fields.on(depositFields::powder, patchi)[facei];
    const scalar before = molten + rest;
    molten = max(scalar(0), molten + change/area);
    const scalar after = molten + rest;
    if (after > 0)
    {
        const scalar sum = before*conversion + convertedChange/area;
        conversion = max(scalar(0), min(scalar(1), sum/after));
    }
}


void Foam::nearWall::wallFilm::step
(
    depositFields& fields,
    const List<scalarField>& out,
    const scalar dt,
    List<passage>& passed
)
{
    edgeSums given
    {
        scalarField(edges_.size(), Zero), scalarField(edges_.size(), Zero)
    };
    forAll(patches_, i)
    {
        const scalarField& molten = fields.on(depositFields::molten, patches_[i]);
        const scalarField& conversion =
            fields.on(depositFields::conversion, patches_[i]);
        label n = 0;
        forAll(molten, facei)
        {
            for (const wallEdges::side& side : edges_.sides(i, facei))
            {
                const scalar mass = dt*out[i][n++]*molten[facei];
                given.mass[side.edge] += mass;
                given.converted[side.edge] += mass*conversion[facei];
            }
        }
    }
    edges_.sum(given.mass);
    edges_.sum(given.converted);

    forAll(patches_, i)
    {
        label n = 0;
        forAll(patchesOf(mesh_)[patches_[i]], facei)
        {
            exchange(fields, i, facei, &out[i][n], given, dt, passed[i]);
            n += edges_.sides(i, facei).size();
        }
    }
}


Foam::nearWall::wallFilm::wallFilm
(
    const fvMesh& mesh,
    const labelList& patches,
    const List<std::uint32_t>& walls,
    const wallModelPtr& model,
    const vector& gravity
)
:
    mesh_(mesh),
    patches_(patches),
    walls_(walls),
    model_(model),
    gravity_(gravity),
    edges_(mesh, patches)
{}


Foam::List<Foam::nearWall::wallFilm::passage>
Foam::nearWall::wallFilm::flow
(
    depositFields& fields,
    const scalar duration
)
{
    List<passage> passed(patches_.size());
    scalar left = duration;
    while (left > 0)
    {
        scalar rate = 0;
        const List<scalarField> out(outflows(fields, rate));
        if (rate <= 0) break;

        // Equal steps to the end, or the rest of it
        const scalar steps = ceil(left*rate/courant);
        const scalar dt = left/max(steps, scalar(1));
        step(fields, out, dt, passed);
        left = steps > 1 ? left - dt : 0;
    }
    return passed;
}
