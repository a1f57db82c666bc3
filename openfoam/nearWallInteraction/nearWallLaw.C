/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallLaw.H.
\*---------------------------------------------------------------------------*/

#include "nearWallLaw.H"
#include "nearWallCompat.H"
#include "nearWallToml.H"
#include "IOstreams.H"

namespace
{

using namespace Foam;

//- The path with <case>, <constant>, ~ and $VAR expanded; a relative one is
//  taken from the case, wherever the solver was started
fileName modelPath(const dictionary& dict, const Time& time)
{
    fileName path(nearWall::read<fileName>(dict, "model"));
    path.expand();
    return path.isAbsolute() ? path : nearWall::caseFolder(time)/path;
}


nearwall::model load(const dictionary& dict, const Time& time)
{
    if (dict.isDict("model"))
    {
        return nearwall::model::from_toml
        (
            nearWall::tomlFrom(dict.subDict("model")),
            nearWall::lawOrigin(dict, time)
        );
    }
    return nearwall::model::from_file(modelPath(dict, time));
}

} // End anonymous namespace


Foam::string Foam::nearWall::lawOrigin
(
    const dictionary& dict,
    const Time& time
)
{
    if (dict.isDict("model"))
    {
        return "inline model of " + dict.subDict("model").name();
    }
    return modelPath(dict, time);
}


Foam::nearWall::lawPtr Foam::nearWall::loadLaw
(
    const dictionary& dict,
    const Time& time
)
{
    if (!dict.found("model"))
    {
        FatalIOErrorInFunction(dict)
            << "key 'model' is missing; give the wall model's file, as in" << nl
            << "    model \"<constant>/nearWall.toml\";" << nl
            << "or its keys inline, model { ... }" << exit(FatalIOError);
    }

    try
    {
        return std::make_shared<const nearwall::model>(load(dict, time));
    }
    catch (const nearwall::error& fault)
    {
        FatalIOErrorInFunction(dict)
            << "the wall model cannot be used:" << nl
            << fault.what() << exit(FatalIOError);
    }
    return lawPtr();
}
