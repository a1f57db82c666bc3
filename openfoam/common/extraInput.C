// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "extraInput.H"
#include "exactText.H"
#include "versionCompat.H"
#include "volFields.H"

#include <algorithm>
#include <cmath>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

const word dictionaryKey("extraInputs");


//- The dictionary `extraInputs` of another one; null if there is none
const dictionary* inputsOf(const dictionary& dict)
{
    if (!dict.found(dictionaryKey)) return nullptr;
    if (!dict.isDict(dictionaryKey))
    {
        FatalIOErrorInFunction(dict)
            << "Key 'extraInputs' must be a dictionary, as in" << nl
            << "    extraInputs { humidity 0.4; }" << exit(FatalIOError);
    }
    return &dict.subDict(dictionaryKey);
}


//- The entry of an input; null if there is none. The name of an input may be
//  no word of OpenFOAM, its key is then in quotation marks.
const entry* findInput(const dictionary* dict, const std::string& name)
{
    if (!dict) return nullptr;
    forAllConstIter(dictionary, *dict, iter)
    {
        if ((*iter).keyword() == name) return &(*iter);
    }
    return nullptr;
}


//- A number, word or text as it is written; empty for anything else
std::string writtenText(const entry& given)
{
    if (!given.isStream()) return std::string();
    const tokenList& tokens = given.stream();
    if (tokens.size() != 1) return std::string();

    const token& t = tokens[0];
    if (t.isWord()) return t.wordToken();
    if (t.isString()) return t.stringToken();
    if (t.isLabel()) return std::to_string(t.labelToken());
    return t.isNumber() ? exactText(t.number()) : std::string();
}


//- Reads the values of one input on one patch; FatalIOError on any fault
struct inputReader
{
    const polyPatch& pp;
    const fvMesh& mesh;
    const nearwall::model& model;
    const string& modelName;

    //- Register the field unless the solver has done so
    void readField(const dictionary& dict, const std::string& name) const
    {
        const word field(name);
        if (mesh.foundObject<volScalarField>(field)) return;

        IOobject io
        (
            field, timeName(mesh.time()), mesh,
            IOobject::MUST_READ, IOobject::AUTO_WRITE
        );
        if (field == name && hasFile<volScalarField>(io))
        {
            regIOobject::store(new volScalarField(io, mesh));
            return;
        }
        FatalIOErrorInFunction(dict)
            << "Patch '" << pp.name() << "': the input '" << name.c_str()
            << "' is to come from a field, but no field '" << name.c_str()
            << "' is registered or in " << mesh.time().timePath() << nl
            << "    Write a volScalarField of that name there, or give a"
            << " number." << exit(FatalIOError);
    }

    //- Values without a meaning in a field would leave every impact undecided
    void checkField(const dictionary& dict, const extraInput& input) const
    {
        const scalarField& values =
            mesh.lookupObject<volScalarField>(word(input.name))
           .boundaryField()[pp.index()];
        const scalar end = input.words.size();
        bool isGood = true;
        forAll(values, i)
        {
            const scalar x = values[i];
            const bool isFinite = std::isfinite(x);
            const bool isPlace =
                isFinite && x >= 0 && x < end && x == std::floor(x);
            isGood = isGood && (input.words.empty() ? isFinite : isPlace);
        }
        if (onEveryRank(isGood)) return;

        FatalIOErrorInFunction(dict)
            << "Patch '" << pp.name() << "': the field '" << input.name.c_str()
            << "' has values that are not "
            << (end > 0 ? "the place of one of its words, counted from 0" : "finite")
            << "." << nl << "    Correct the field." << exit(FatalIOError);
    }

    //- Take the default of the model file, which must have one
    scalar fallback
    (
        const dictionary& coeffs,
        const label index,
        const extraInput& input
    ) const
    {
        const scalar value = model.extra_input_default(index);
        if (std::isfinite(value)) return value;

        FatalIOErrorInFunction(coeffs)
            << "Patch '" << pp.name() << "': " << modelName.c_str()
            << " has the input '" << input.name.c_str()
            << "', which has no default." << nl << "    Give its value, as in"
            << " extraInputs { " << input.name.c_str() << " "
            << (input.words.empty() ? "0" : input.words[0].c_str()) << "; },"
            << " or a default in the model." << exit(FatalIOError);
        return value;
    }

    //- Read the entry of an input
    void readEntry
    (
        const dictionary& dict,
        const entry& given,
        const label index,
        extraInput& input
    ) const
    {
        const std::string text(writtenText(given));
        if (text == "field")
        {
            input.fromField = true;
            readField(dict, input.name);
            checkField(dict, input);
            return;
        }
        try
        {
            input.value = model.extra_input_value(index, text);
        }
        catch (const nearwall::error& fault)
        {
            FatalIOErrorInFunction(dict)
                << "Patch '" << pp.name() << "': the input '"
                << input.name.c_str() << "' must be "
                << (input.words.empty() ? "a number" : "one of its words")
                << " or 'field': " << fault.what() << exit(FatalIOError);
        }
    }
};


//- Stop when a dictionary of inputs, if there is one, has another name
void checkDeclared
(
    const dictionary* dict,
    const std::vector<std::string>& declared
)
{
    if (!dict) return;
    forAllConstIter(dictionary, *dict, iter)
    {
        const std::string name((*iter).keyword());
        if (std::count(declared.begin(), declared.end(), name)) continue;

        std::string list;
        for (const std::string& each : declared) list += " " + each;
        FatalIOErrorInFunction(*dict)
            << "extraInputs: no model declares the input '" << name.c_str()
            << "'." << nl << "    The declared inputs are:"
            << (declared.empty() ? " none" : list.c_str())
            << ". Declare it in the model, [inputs." << name.c_str()
            << "], or remove the key." << exit(FatalIOError);
    }
}

} // End anonymous namespace


std::vector<Foam::nearWall::extraInput> Foam::nearWall::extraInput::read
(
    const dictionary& coeffs,
    const dictionary& patch,
    const polyPatch& pp,
    const fvMesh& mesh,
    const nearwall::model& model,
    const string& modelName
)
{
    const inputReader reader{pp, mesh, model, modelName};
    std::vector<extraInput> inputs;
    for (const std::string& name : model.extra_inputs())
    {
        const label index = inputs.size();
        extraInput input;
        input.name = name;
        input.words = model.extra_input_words(index);

        const dictionary* dict = inputsOf(patch);
        if (!findInput(dict, name)) dict = inputsOf(coeffs);
        const entry* const given = findInput(dict, name);
        if (given) reader.readEntry(*dict, *given, index, input);
        else input.value = reader.fallback(coeffs, index, input);
        inputs.push_back(input);
    }
    return inputs;
}


void Foam::nearWall::extraInput::checkNames
(
    const dictionary& coeffs,
    const std::vector<std::string>& declared
)
{
    checkDeclared(inputsOf(coeffs), declared);
    const dictionary patches
    (
        coeffs.isDict("patches") ? coeffs.subDict("patches") : dictionary()
    );
    forAllConstIter(dictionary, patches, iter)
    {
        if ((*iter).isDict()) checkDeclared(inputsOf((*iter).dict()), declared);
    }
}


Foam::scalar Foam::nearWall::extraInput::valueOn
(
    const fvMesh& mesh,
    const label patchi,
    const label face
) const
{
    if (!fromField) return value;
    return
        mesh.lookupObject<volScalarField>(word(name))
       .boundaryField()[patchi][face];
}


std::string Foam::nearWall::extraInput::text(const scalar value) const
{
    if (!std::isfinite(value)) return std::string();
    if (words.empty()) return exactText(value);

    const bool isPlace = value >= 0 && value < scalar(words.size());
    return isPlace ? words[std::size_t(value)] : std::string();
}
