// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallField.H"
#include "versionCompat.H"

Foam::volScalarField Foam::nearWall::readWallField
(
    const fvMesh& mesh,
    const word& name,
    const dimensionSet& dimensions
)
{
    return volScalarField
    (
        IOobject
        (
            name,
            nearWall::timeName(mesh.time()),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        mesh,
        dimensionedScalar("zero", dimensions, 0)
    );
}
