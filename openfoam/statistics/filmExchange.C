// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "filmExchange.H"
#include "mathematicalConstants.H"
#include "versionCompat.H"
#include "volFields.H"

#ifdef NEARWALL_SURFACE_FILM
    #include "surfaceFilmRegionModel.H"
#endif

Foam::scalar Foam::nearWall::filmExchange::inSource() const
{
    const char* const source = "rhoSpf";
    scalar mass = 0;
    if (!mesh_.foundObject<volScalarField>(source)) return mass;

    for (const scalarField& onPatch : mesh_.lookupObject<volScalarField>(source).boundaryField())
    {
        mass -= sum(onPatch);
    }
    return mass;
}


Foam::scalar Foam::nearWall::filmExchange::begin()
{
    atStart_ = inSource();
    scalar given = 0;

    #ifdef NEARWALL_SURFACE_FILM
    using regionModels::surfaceFilmModels::surfaceFilmRegionModel;

    const word name("surfaceFilmProperties");
    const objectRegistry& all = mesh_.time();
    if (!all.foundObject<surfaceFilmRegionModel>(name)) return given;

    const auto& film = all.lookupObject<surfaceFilmRegionModel>(name);
    if (!film.active()) return given;

    for (const label patchi : film.intCoupledPatchIDs())
    {
        const scalarField& mass = film.cloudMassTrans().boundaryField()[patchi];
        const scalarField& d = film.cloudDiameterTrans().boundaryField()[patchi];
        const scalarField& rho = film.rho().boundaryField()[patchi];
        forAll(mass, facei)
        {
            if (d[facei] <= 0) continue;

            const scalar ofOne =
                constant::mathematical::pi/6*rho[facei]*pow3(d[facei]);
            if (mass[facei] > 0.001*ofOne) given += mass[facei];
        }
    }
    #endif

    return given;
}
