/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallDepositParticle.H.
\*---------------------------------------------------------------------------*/

#include "nearWallDepositParticle.H"
#include "IOField.H"

namespace
{

using namespace Foam;
using nearWall::captured;

typedef Cloud<nearWallDepositParticle> depositCloud;

//- A member of captured and the name of its file
template<class Type>
struct column
{
    const char* name;
    Type captured::* member;
};

const column<scalar> scalarColumns[] =
{
    {"d", &captured::d},
    {"nParticle", &captured::nParticle},
    {"mass", &captured::mass},
    {"T", &captured::T},
    {"conversion", &captured::conversion},
    {"captureTime", &captured::captureTime}
};

const column<label> labelColumns[] =
{
    {"regime", &captured::regime},
    {"typeId", &captured::typeId}
};


template<class Type>
void copyColumn
(
    const depositCloud& cloud,
    const column<Type>& c,
    Field<Type>& values
)
{
    label i = 0;
    for (const nearWallDepositParticle& p : cloud)
    {
        values[i++] = p.asCaptured().*c.member;
    }
}


template<class Type>
void writeColumn(const depositCloud& cloud, const column<Type>& c)
{
    IOField<Type> values
    (
        cloud.fieldIOobject(c.name, IOobject::NO_READ),
        cloud.size()
    );
    copyColumn(cloud, c, values);
    values.write(cloud.size() > 0);
}


template<class Type>
void registerColumn
(
    const depositCloud& cloud,
    const column<Type>& c,
    objectRegistry& registry
)
{
    copyColumn
    (
        cloud,
        c,
        cloud::createIOField<Type>(c.name, cloud.size(), registry)
    );
}


//- All ranks read, also those without parcels
template<class Type>
void readColumn
(
    const depositCloud& cloud,
    const column<Type>& c,
    List<captured>& parcels
)
{
    const IOField<Type> values
    (
        cloud.fieldIOobject(c.name, IOobject::MUST_READ),
        cloud.size() > 0
    );
    cloud.checkFieldIOobject(cloud, values);
    forAll(parcels, i) parcels[i].*c.member = values[i];
}

} // End anonymous namespace


Foam::nearWallDepositParticle::nearWallDepositParticle
(
    const particle& p,
    const nearWall::captured& captured
)
:
    particle(p),
    captured_(captured)
{
    // Its tetrahedron is that of the points at the end of the step
    stepFraction() = 1;
}


Foam::nearWallDepositParticle::nearWallDepositParticle
(
    const polyMesh& mesh,
    Istream& is,
    bool readFields,
    bool newFormat
)
:
    particle(mesh, is, readFields, newFormat)
{
    stepFraction() = 1;
}


void Foam::nearWallDepositParticle::readFields
(
    Cloud<nearWallDepositParticle>& cloud
)
{
    particle::readFields(cloud);

    List<nearWall::captured> parcels(cloud.size());
    for (const column<scalar>& c : scalarColumns) readColumn(cloud, c, parcels);
    for (const column<label>& c : labelColumns) readColumn(cloud, c, parcels);

    label i = 0;
    for (nearWallDepositParticle& p : cloud)
    {
        p.captured_ = parcels[i++];
    }
}


void Foam::nearWallDepositParticle::writeFields
(
    const Cloud<nearWallDepositParticle>& cloud
)
{
    particle::writeFields(cloud);
    for (const column<scalar>& c : scalarColumns) writeColumn(cloud, c);
    for (const column<label>& c : labelColumns) writeColumn(cloud, c);
}


void Foam::nearWallDepositParticle::writeObjects
(
    const Cloud<nearWallDepositParticle>& cloud,
    objectRegistry& registry
)
{
    particle::writeObjects(cloud, registry);
    for (const column<scalar>& c : scalarColumns)
    {
        registerColumn(cloud, c, registry);
    }
    for (const column<label>& c : labelColumns)
    {
        registerColumn(cloud, c, registry);
    }
}
