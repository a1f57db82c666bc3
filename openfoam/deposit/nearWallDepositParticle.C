// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallDepositParticle.H"
#include "IOField.H"

namespace
{

using namespace Foam;
using nearWall::capturedState;

typedef nearWallDepositParticle::cloudType depositCloud;

//- A member of the state and the name of its file
template<class Type>
struct column
{
    const char* name;
    Type capturedState::* member;
};

const column<scalar> scalarColumns[] =
{
    {"d", &capturedState::d},
    {"nParticle", &capturedState::nParticle},
    {"mass", &capturedState::mass},
    {"T", &capturedState::T},
    {"conversion", &capturedState::conversion},
    {"captureTime", &capturedState::captureTime}
};

const column<label> labelColumns[] =
{
    {"regime", &capturedState::regime},
    {"typeId", &capturedState::typeId}
};


//- Call an action with each column
template<class Action>
void forEachColumn(const Action& action)
{
    for (const column<scalar>& c : scalarColumns) action(c);
    for (const column<label>& c : labelColumns) action(c);
}


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
        values[i++] = p.state().*c.member;
    }
}


struct writeColumn
{
    const depositCloud& cloud;

    template<class Type>
    void operator()(const column<Type>& c) const
    {
        IOField<Type> values
        (
            nearWall::fieldFile(cloud, c.name, IOobject::NO_READ),
            cloud.size()
        );
        copyColumn(cloud, c, values);
        values.write(cloud.size() > 0);
    }
};


#ifdef OPENFOAM
struct registerColumn
{
    const depositCloud& cloud;
    objectRegistry& registry;

    template<class Type>
    void operator()(const column<Type>& c) const
    {
        copyColumn
        (
            cloud,
            c,
            cloud::createIOField<Type>(c.name, cloud.size(), registry)
        );
    }
};
#endif


//- All ranks read, also those without parcels
struct readColumn
{
    const depositCloud& cloud;
    List<capturedState>& states;

    template<class Type>
    void operator()(const column<Type>& c) const
    {
        const IOField<Type> values
        (
            nearWall::fieldFile(cloud, c.name, IOobject::MUST_READ),
            cloud.size() > 0
        );
        cloud.checkFieldIOobject(cloud, values);
        forAll(states, i) states[i].*c.member = values[i];
    }
};

} // End anonymous namespace


Foam::nearWallDepositParticle::nearWallDepositParticle
(
    const particle& p,
    const nearWall::capturedState& state
)
:
    particle(p),
    state_(state)
{
    // Its tetrahedron is that of the points at the end of the step
    stepFraction() = 1;
}


void Foam::nearWallDepositParticle::readFields
(
    cloudType& cloud
)
{
    particle::readFields(cloud);

    List<nearWall::capturedState> states(cloud.size());
    forEachColumn(readColumn{cloud, states});

    label i = 0;
    for (nearWallDepositParticle& p : cloud) p.state_ = states[i++];
}


void Foam::nearWallDepositParticle::writeFields
(
    const cloudType& cloud
)
{
    particle::writeFields(cloud);
    forEachColumn(writeColumn{cloud});
}


#ifdef OPENFOAM
void Foam::nearWallDepositParticle::writeObjects
(
    const cloudType& cloud,
    objectRegistry& registry
)
{
    particle::writeObjects(cloud, registry);
    forEachColumn(registerColumn{cloud, registry});
}
#endif
