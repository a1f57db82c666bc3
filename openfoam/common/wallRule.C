// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallRule.H"
#include "dictionaryChecks.H"
#include "versionCompat.H"

void Foam::nearWall::wallRule::readWall
(
    const dictionary& dict,
    const polyPatch& pp,
    const nearwall::model& model,
    const string& modelName
)
{
    const bool given = dict.found("wall");
    DynamicList<string> names;
    if (given)
    {
        names.append(nearWall::read<word>(dict, "wall"));
    }
    else
    {
        names.append(pp.name());
        forAll(pp.inGroups(), i) names.append(pp.inGroups()[i]);
        names.append("default");
    }

    forAll(names, i)
    {
        wallName = names[i];
        if (model.find_wall(wallName, wall)) return;
    }

    FatalIOErrorInFunction(dict)
        << "Patch '" << pp.name() << "': " << modelName.c_str()
        << " has no wall '" << names[0].c_str() << "'"
        << (given ? "" : " and no default") << "." << nl
        << "    Add [walls." << names[0].c_str() << "]"
        << (given ? "" : " or [walls.default]")
        << " to that model, or name one of its walls with the key 'wall'."
        << exit(FatalIOError);
}


void Foam::nearWall::wallRule::readTemperature
(
    const dictionary& dict,
    const polyPatch& pp
)
{
    temperatureField = readOr<word>(dict, "field", word("T"));
    temperatureFromField = true;
    needsField = dict.found("field") || dict.found("wallTemperature");
    if (!dict.found("wallTemperature")) return;

    const tokenList& given = dict.lookup("wallTemperature");
    const token t(given.size() == 1 ? given[0] : token());
    if (t.isWord() && t.wordToken() == "field") return;
    if (t.isNumber() && t.number() > 0)
    {
        temperature = t.number();
        warnOfCelsius(temperature, "wallTemperature of patch '" + pp.name() + "'");
        temperatureFromField = needsField = false;
        return;
    }
    FatalIOErrorInFunction(dict)
        << "Patch '" << pp.name()
        << "': wallTemperature must be 'field' or a number above 0, in K."
        << nl << "    Give the number without a unit: wallTemperature 673.15;"
        << exit(FatalIOError);
}


void Foam::nearWall::wallRule::findField
(
    const dictionary& dict,
    const polyPatch& pp,
    const objectRegistry& mesh
)
{
    if (!temperatureFromField) return;
    if (mesh.foundObject<volScalarField>(temperatureField)) return;

    temperatureFromField = false;
    if (!needsField) return;

    FatalIOErrorInFunction(dict)
        << "Patch '" << pp.name() << "': the wall temperature is to come"
        << " from a field, but no field '" << temperatureField
        << "' is registered." << nl
        << "    If this solver has no temperature, give a number in K,"
        << " wallTemperature 300;" << nl
        << "    otherwise give the name of its temperature field, field T;"
        << exit(FatalIOError);
}


const Foam::fvPatchScalarField& Foam::nearWall::wallRule::temperatureOn
(
    const objectRegistry& mesh,
    const label patchi
) const
{
    return
        mesh.lookupObject<volScalarField>(temperatureField)
       .boundaryField()[patchi];
}
