// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallShear.H"

Foam::vectorField Foam::nearWall::wallShear::stress(const label patchi) const
{
    const fvPatchVectorField& U = U_.boundaryField()[patchi];
    const vectorField n(U.patch().nf());
    const vectorField gradient(U.snGrad());
    scalarField viscosity(mu_.boundaryField()[patchi]);

    const word nut(IOobject::groupName("nut", U_.group()));
    if (U_.db().foundObject<volScalarField>(nut))
    {
        const volScalarField& field = U_.db().lookupObject<volScalarField>(nut);
        viscosity += density(patchi)*field.boundaryField()[patchi];
    }
    return vectorField(-viscosity*(gradient - n*(n & gradient)));
}
