/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallPatches.H.
\*---------------------------------------------------------------------------*/

#include "nearWallPatches.H"
#include "nearWallCompat.H"
#include "processorPolyPatch.H"
#include "volFields.H"
#include "wallPolyPatch.H"
#include "wordRe.H"

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

const wordList fateNames({"interact", "escape", "rebound", "stick"});


//- The keys that a rule may have
wordList keysOf(const fate what)
{
    if (what == fate::interact)
    {
        return wordList({"type", "wall", "wallTemperature", "field"});
    }
    if (what == fate::rebound)
    {
        return wordList({"type", "e", "mu"});
    }
    return wordList({"type"});
}


bool isOurs(const polyPatch& pp)
{
    return !pp.coupled() && !polyPatch::constraintType(pp.type());
}


bool inGroup(const polyPatch& pp, const word& group)
{
    forAll(pp.inGroups(), i)
    {
        if (pp.inGroups()[i] == group) return true;
    }
    return false;
}


//- How well an entry fits a patch: 0 not, 1 expression, 2 group, 3 name
int fit(const keyType& key, const polyPatch& pp)
{
    if (key.isPattern())
    {
        return wordRe(key).match(pp.name()) ? 1 : 0;
    }
    if (key == pp.name()) return 3;
    return inGroup(pp, key) ? 2 : 0;
}


//- The entry for a patch; of equally good ones the last, as in OpenFOAM
const entry* entryFor(const dictionary& patches, const polyPatch& pp)
{
    const entry* best = nullptr;
    int bestFit = 0;
    forAllConstIter(dictionary, patches, iter)
    {
        const int f = fit((*iter).keyword(), pp);
        if (f > 0 && f >= bestFit)
        {
            best = &(*iter);
            bestFit = f;
        }
    }
    return best;
}


wordList ownPatchNames(const polyBoundaryMesh& pbm)
{
    DynamicList<word> names;
    forAll(pbm, patchi)
    {
        if (isOurs(pbm[patchi])) names.append(pbm[patchi].name());
    }
    return wordList(names);
}


//- Every entry is a dictionary and fits some patch
void checkEntries(const dictionary& patches, const polyBoundaryMesh& pbm)
{
    forAllConstIter(dictionary, patches, iter)
    {
        const keyType& key = (*iter).keyword();
        if (!(*iter).isDict())
        {
            FatalIOErrorInFunction(patches)
                << "patches: '" << key << "' must be a dictionary, as in" << nl
                << "    " << key << " { type interact; }" << exit(FatalIOError);
        }

        int best = 0;
        forAll(pbm, patchi)
        {
            const int f = fit(key, pbm[patchi]);
            best = max(best, f);
            if (f == 3 && !isOurs(pbm[patchi]))
            {
                FatalIOErrorInFunction(patches)
                    << "patches: '" << key << "' is a " << pbm[patchi].type()
                    << " patch, which OpenFOAM itself handles; remove the entry"
                    << exit(FatalIOError);
            }
        }
        if (best == 0)
        {
            FatalIOErrorInFunction(patches)
                << "patches: no patch, patch group or expression '" << key
                << "' in this mesh" << nl
                << "    The mesh has " << ownPatchNames(pbm)
                << exit(FatalIOError);
        }
    }
}


fate fateFrom(const dictionary& rule, const word& patchName)
{
    const word type(nearWall::read<word>(rule, "type"));
    if (type == "interact") return fate::interact;
    if (type == "escape") return fate::escape;
    if (type == "rebound") return fate::rebound;
    if (type == "stick") return fate::stick;

    FatalIOErrorInFunction(rule)
        << "patch '" << patchName << "': unknown type '" << type << "'" << nl
        << "    Use one of " << fateNames << exit(FatalIOError);
    return fate::pass;
}


scalar fraction(const dictionary& rule, const word& key, const scalar fallback)
{
    const scalar x = readOr<scalar>(rule, key, fallback);
    if (x < 0 || x > 1)
    {
        FatalIOErrorInFunction(rule)
            << "key '" << key << "' is " << x << ", must be from 0 to 1"
            << exit(FatalIOError);
    }
    return x;
}


//- The wall in the model: the one asked for, or by patch, group, default
void findWall
(
    patchRule& rule,
    const dictionary& dict,
    const polyPatch& pp,
    const nearwall::model& law
)
{
    if (dict.found("wall"))
    {
        rule.wallName = nearWall::read<word>(dict, "wall");
        if (law.find_wall(rule.wallName, rule.wall)) return;

        FatalIOErrorInFunction(dict)
            << "patch '" << pp.name() << "': the wall model has no wall '"
            << rule.wallName.c_str() << "'" << nl
            << "    Add [walls." << rule.wallName.c_str()
            << "] to the model, or name another wall" << exit(FatalIOError);
    }

    DynamicList<string> names;
    names.append(pp.name());
    forAll(pp.inGroups(), i) names.append(pp.inGroups()[i]);
    names.append("default");

    forAll(names, i)
    {
        if (law.find_wall(names[i], rule.wall))
        {
            rule.wallName = names[i];
            return;
        }
    }

    FatalIOErrorInFunction(dict)
        << "patch '" << pp.name() << "': no wall in the model for it" << nl
        << "    Add [walls." << pp.name() << "] or [walls.default] to the model,"
        << " or name one: " << pp.name() << " { type interact; wall ...; }"
        << exit(FatalIOError);
}


bool hasField(const fvMesh& mesh, const word& name)
{
    return mesh.foundObject<volScalarField>(name);
}


void requireField
(
    const fvMesh& mesh,
    const dictionary& dict,
    const polyPatch& pp,
    const word& name
)
{
    if (hasField(mesh, name)) return;

    FatalIOErrorInFunction(dict)
        << "patch '" << pp.name() << "': the wall temperature is to come from"
        << " a field, but no field '" << name << "' is registered" << nl
        << "    This solver may have no temperature: give a number in K,"
        << " wallTemperature 300;" << nl
        << "    or the field's name, field T;" << exit(FatalIOError);
}


//- wallTemperature field | <number>; without it the field that `field` names,
//  or the field T where there is one
void readTemperature
(
    patchRule& rule,
    const dictionary& dict,
    const polyPatch& pp,
    const fvMesh& mesh
)
{
    rule.temperatureField = readOr<word>(dict, "field", word("T"));

    if (!dict.found("wallTemperature"))
    {
        if (dict.found("field"))
        {
            requireField(mesh, dict, pp, rule.temperatureField);
        }
        rule.temperatureFromField = hasField(mesh, rule.temperatureField);
        return;
    }

    const tokenList& given = dict.lookup("wallTemperature");
    if (given.size() == 1)
    {
        const token& t = given[0];
        if (t.isNumber() && t.number() > 0)
        {
            rule.temperature = t.number();
            return;
        }
        if (t.isWord() && t.wordToken() == "field")
        {
            rule.temperatureFromField = true;
            requireField(mesh, dict, pp, rule.temperatureField);
            return;
        }
    }

    FatalIOErrorInFunction(dict)
        << "patch '" << pp.name()
        << "': wallTemperature must be 'field' or a number above 0, in K" << nl
        << "    Give it without a unit: wallTemperature 673.15;"
        << exit(FatalIOError);
}


//- A wall outside the tables of its material would refuse every impact: say so
//  now, from the temperature given or the field as it is at the start
void requireKnownTemperature
(
    const patchRule& rule,
    const dictionary& dict,
    const polyPatch& pp,
    const fvMesh& mesh,
    const nearwall::model& law
)
{
    scalar lowest = rule.temperature;
    scalar highest = rule.temperature;
    if (rule.temperatureFromField)
    {
        const scalarField& T =
            mesh.lookupObject<volScalarField>(rule.temperatureField)
           .boundaryField()[pp.index()];
        if (returnReduce(T.size(), sumOp<label>()) == 0) return;
        lowest = gMin(T);
        highest = gMax(T);
    }

    const nearwall::temperature_ranges known = law.ranges(rule.wall);
    if (lowest >= known.wall_low && highest <= known.wall_high) return;

    FatalIOErrorInFunction(dict)
        << "patch '" << pp.name() << "': wall temperature " << lowest << " to "
        << highest << " K, but the properties of wall '"
        << rule.wallName.c_str() << "' are known from " << known.wall_low
        << " to " << known.wall_high << " K" << nl
        << "    Correct " << (rule.temperatureFromField ? "field " : "wallTemperature")
        << (rule.temperatureFromField ? rule.temperatureField : word())
        << ", or widen the tables of the wall's material in the model"
        << exit(FatalIOError);
}


patchRule ruleFor
(
    const dictionary& coeffs,
    const entry* given,
    const polyPatch& pp,
    const fvMesh& mesh,
    const nearwall::model& law
)
{
    patchRule rule;
    rule.origin = given ? string(given->keyword()) : string("default");

    // Messages about a patch without an entry name the coefficients
    const dictionary& dict = given ? given->dict() : coeffs;
    const dictionary none;
    const dictionary& values = given ? given->dict() : none;

    if (given)
    {
        rule.what = fateFrom(dict, pp.name());
        refuseUnknownKeys
        (
            dict,
            keysOf(rule.what),
            "patch '" + pp.name() + "', type "
          + nearWall::read<word>(dict, "type")
        );
    }
    else
    {
        rule.what = isA<wallPolyPatch>(pp) ? fate::interact : fate::escape;
    }

    if (rule.what == fate::interact)
    {
        findWall(rule, dict, pp, law);
        readTemperature(rule, given ? dict : values, pp, mesh);
        requireKnownTemperature(rule, dict, pp, mesh, law);
    }
    if (rule.what == fate::rebound)
    {
        rule.e = fraction(values, "e", 1);
        rule.mu = fraction(values, "mu", 0);
    }
    return rule;
}


void reportRule(const patchRule& rule, const polyPatch& pp)
{
    Info<< "        " << pp.name() << ": ";
    switch (rule.what)
    {
        case fate::pass:     break;
        case fate::escape:   Info<< "escape"; break;
        case fate::stick:    Info<< "stick"; break;
        case fate::rebound:
            Info<< "rebound, e " << rule.e << ", mu " << rule.mu;
            break;
        case fate::interact:
            Info<< "interact, wall '" << rule.wallName.c_str()
                << "', temperature ";
            if (rule.temperatureFromField)
            {
                Info<< "from field " << rule.temperatureField;
            }
            else
            {
                Info<< rule.temperature << " K";
            }
            break;
    }
    Info<< (rule.origin == "default" ? " (not named, default)" : "") << nl;
}

} // End anonymous namespace


void Foam::nearWall::refuseUnknownKeys
(
    const dictionary& dict,
    const wordList& known,
    const string& where
)
{
    forAllConstIter(dictionary, dict, iter)
    {
        const word key((*iter).keyword());
        bool fits = false;
        forAll(known, i) fits = fits || known[i] == key;

        if (!fits)
        {
            FatalIOErrorInFunction(dict)
                << where.c_str() << ": unknown key '" << key << "'" << nl
                << "    Known keys are " << known << exit(FatalIOError);
        }
    }
}


Foam::nearWall::patchRules Foam::nearWall::readPatchRules
(
    const dictionary& coeffs,
    const fvMesh& mesh,
    const nearwall::model& law
)
{
    const polyBoundaryMesh& pbm = mesh.boundaryMesh();
    const dictionary patches(coeffs.subOrEmptyDict("patches"));
    checkEntries(patches, pbm);

    patchRules rules(pbm.size());
    forAll(pbm, patchi)
    {
        const polyPatch& pp = pbm[patchi];
        if (isOurs(pp))
        {
            rules[patchi] = ruleFor(coeffs, entryFor(patches, pp), pp, mesh, law);
        }
    }
    return rules;
}


void Foam::nearWall::reportPatchRules
(
    const patchRules& rules,
    const fvMesh& mesh
)
{
    Info<< "    nearWallInteraction, patches:" << nl;
    forAll(rules, patchi)
    {
        if (rules[patchi].what != fate::pass)
        {
            reportRule(rules[patchi], mesh.boundaryMesh()[patchi]);
        }
    }
    Info<< endl;
}
