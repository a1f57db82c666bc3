// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "gasTurbulence.H"
#include "linearGradient.H"

void Foam::nearWall::gasTurbulence::read
(
    const volScalarField& k,
    const volScalarField& epsilon,
    const volScalarField& rho,
    const volVectorField& U,
    const volScalarField& mu
)
{
    wall_.update();
    const wallShear shear(rho, U, mu);
    const scalarField onWall
    (
        wall_.toCells
        (
            [&](const label patchi)
            {
                return Foam::sqrt(mag(shear.stress(patchi))/shear.density(patchi));
            }
        )
    );

    // The walk needs the gradient of the very field that it meets
    const vectorField slope(linearGradient(k));
    const scalar leastShare = 0.7*Foam::pow(0.09, 0.25);
    cells_.setSize(mesh_.nCells());
    forAll(cells_, celli)
    {
        const scalar energy = max(k[celli], scalar(0));
        const scalar sigma = Foam::sqrt(2*energy/3);
        cell& c = cells_[celli];
        c.fluctuation = sigma;
        c.gradient = slope[celli]/(3*max(sigma, ROOTVSMALL));
        c.time = energy/(7*max(epsilon[celli], ROOTVSMALL));
        c.frictionVelocity = max(onWall[celli], leastShare*Foam::sqrt(energy));
        c.viscosity = mu[celli]/rho[celli];
    }
}


bool Foam::nearWall::gasTurbulence::describe
(
    nw_walk& walk,
    const label celli,
    const point& place
) const
{
    const cell& c = cells_[celli];
    if (!(c.fluctuation > ROOTVSMALL && c.time > ROOTVSMALL)) return false;

    walk.core_fluctuation = c.fluctuation + (c.gradient & (place - mesh_.C()[celli]));
    walk.core_fluctuation = max(walk.core_fluctuation, 0.1*c.fluctuation);
    walk.core_time = c.time;
    walk.kinematic_viscosity = c.viscosity;
    walk.friction_velocity = 0;
    vector normal(Zero);
    if (wall_.found(celli))
    {
        const vector way(wall_.from(celli, place));
        walk.wall_distance = mag(way);
        walk.friction_velocity = c.frictionVelocity;
        normal = walk.wall_distance > SMALL ? way/walk.wall_distance : wall_.normal(celli);
    }
    for (direction i = 0; i < 3; ++i)
    {
        walk.core_gradient[i] = c.gradient[i];
        walk.normal[i] = normal[i];
    }
    return true;
}
