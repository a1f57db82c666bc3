// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "rewindable.H"
#include "particle.H"
#include "stateArchive.H"
#include "versionCompat.H"

namespace Foam { namespace nearWall {
    defineTypeNameAndDebug(rewindable, 0);
}}

namespace
{

//- Behind the name of the cloud in the registry
const char* const suffix = ":nearWall";

} // End anonymous namespace


Foam::nearWall::rewindable::rewindable
(
    const fvMesh& mesh,
    const word& cloudName
)
:
    regIOobject
    (
        IOobject
        (
            cloudName + suffix,
            mesh.time().constant(),
            mesh,
            IOobject::NO_READ,
            IOobject::NO_WRITE
        )
    ),
    mesh_(mesh)
{}


Foam::wordList Foam::nearWall::rewindable::clouds(const objectRegistry& mesh)
{
    wordList names(mesh.lookupClass<rewindable>().sortedToc());
    for (word& name : names) name = name.substr(0, name.rfind(':'));
    return names;
}


Foam::nearWall::rewindable& Foam::nearWall::rewindable::of
(
    const objectRegistry& mesh,
    const word& cloudName
)
{
    const word name(cloudName + suffix);
    if (!mesh.foundObject<rewindable>(name))
    {
        FatalErrorInFunction
            << "No cloud '" << cloudName << "' with nearWallInteraction. There"
            << " are " << clouds(mesh) << exit(FatalError);
    }
    return const_cast<rewindable&>(mesh.lookupObject<rewindable>(name));
}


void Foam::nearWall::rewindable::archiveAll(stateArchive& state)
{
    state.same(std::string(name()));
    state.same(mesh_.nPoints());
    state.same(mesh_.nFaces());
    state.same(mesh_.nCells());
    state(nextParticle<particle>());
    archive(state);
}


Foam::nearWall::rewindable::state Foam::nearWall::rewindable::save()
{
    stateArchive out;
    archiveAll(out);
    return out.bytes();
}


void Foam::nearWall::rewindable::restore(const state& saved)
{
    stateArchive in(saved);
    archiveAll(in);
    in.require(in.atEnd());
}
