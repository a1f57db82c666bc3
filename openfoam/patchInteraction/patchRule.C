// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "patchRule.H"
#include "dictionaryChecks.H"
#include "volFields.H"
#include "wallPolyPatch.H"
#include "wordRe.H"

const Foam::nearWall::Enum<Foam::nearWall::patchRule::ruleType>
Foam::nearWall::patchRule::typeNames
({
    {interact, "interact"},
    {escape, "escape"},
    {rebound, "rebound"},
    {stick, "stick"}
});


namespace
{

using namespace Foam;
using namespace Foam::nearWall;

wordList knownKeys(const patchRule::ruleType type)
{
    if (type == patchRule::interact)
    {
        return wordList
        (
            {"type", "wall", "wallTemperature", "field", "extraInputs"}
        );
    }
    if (type == patchRule::rebound) return wordList({"type", "e", "mu"});
    return wordList({"type"});
}


bool isHandled(const polyPatch& pp)
{
    return !pp.coupled() && !polyPatch::constraintType(pp.type());
}


//- How well an entry fits a patch: 0 not, 1 expression, 2 group, 3 name
int fit(const keyType& key, const polyPatch& pp)
{
    if (key.isPattern()) return wordRe(key).match(pp.name()) ? 1 : 0;
    if (key == pp.name()) return 3;
    forAll(pp.inGroups(), i)
    {
        if (pp.inGroups()[i] == key) return 2;
    }
    return 0;
}


//- The entry for a patch, null if there is none
const entry* findEntry(const dictionary& patches, const polyPatch& pp)
{
    const entry* best = nullptr;
    int bestFit = 1;
    forAllConstIter(dictionary, patches, iter)
    {
        const int f = fit((*iter).keyword(), pp);
        if (f >= bestFit)
        {
            best = &(*iter);
            bestFit = f;
        }
    }
    return best;
}


//- Every entry must be a dictionary and fit a patch that is handled here
void checkEntries(const dictionary& patches, const polyBoundaryMesh& pbm)
{
    DynamicList<word> names;
    forAll(pbm, patchi)
    {
        if (isHandled(pbm[patchi])) names.append(pbm[patchi].name());
    }

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
            if (f == 3 && !isHandled(pbm[patchi]))
            {
                FatalIOErrorInFunction(patches)
                    << "patches: OpenFOAM itself handles '" << key
                    << "', a patch of type " << pbm[patchi].type()
                    << ". Remove the entry." << exit(FatalIOError);
            }
        }
        if (best == 0)
        {
            FatalIOErrorInFunction(patches)
                << "patches: '" << key << "' matches no patch and no patch"
                << " group of this mesh." << nl
                << "    The patches are " << wordList(names)
                << exit(FatalIOError);
        }
    }
}


scalar readFraction(const dictionary& dict, const word& key, const scalar other)
{
    return readChecked<scalar>
    (
        dict, key, other, [](scalar x) { return x >= 0 && x <= 1; },
        "from 0 to 1"
    );
}


//- Reads the rule of one patch; FatalIOError on any fault
struct ruleReader
{
    const dictionary& dict;
    const polyPatch& pp;
    const fvMesh& mesh;
    const nearwall::model& model;
    const string& modelName;
    patchRule& rule;

    //- Find the wall in the model: the given one, or by patch, group, default
    void readWall() const
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
            rule.wallName = names[i];
            if (model.find_wall(rule.wallName, rule.wall)) return;
        }

        FatalIOErrorInFunction(dict)
            << "Patch '" << pp.name() << "': " << modelName.c_str()
            << " has no wall '"
            << names[0].c_str() << "'" << (given ? "" : " and no default")
            << "." << nl << "    Add [walls." << names[0].c_str() << "]"
            << (given ? "" : " or [walls.default]")
            << " to that model, or name one of its walls: " << pp.name()
            << " { type interact; wall ...; }" << exit(FatalIOError);
    }

    //- Take the wall temperature from the field, which must be registered
    void useField() const
    {
        rule.temperatureFromField = true;
        if (mesh.foundObject<volScalarField>(rule.temperatureField)) return;

        FatalIOErrorInFunction(dict)
            << "Patch '" << pp.name() << "': the wall temperature is to come"
            << " from a field, but no field '" << rule.temperatureField
            << "' is registered." << nl
            << "    If this solver has no temperature, give a number in K,"
            << " wallTemperature 300;" << nl
            << "    otherwise give the name of its temperature field, field T;"
            << exit(FatalIOError);
    }

    //- Read where the wall temperature comes from
    void readTemperature() const
    {
        rule.temperatureField = readOr<word>(dict, "field", word("T"));
        if (!dict.found("wallTemperature"))
        {
            const bool isThere =
                mesh.foundObject<volScalarField>(rule.temperatureField);
            if (isThere || dict.found("field")) useField();
            return;
        }

        const tokenList& given = dict.lookup("wallTemperature");
        const token t(given.size() == 1 ? given[0] : token());
        if (t.isWord() && t.wordToken() == "field")
        {
            useField();
            return;
        }
        if (t.isNumber() && t.number() > 0)
        {
            rule.temperature = t.number();
            return;
        }

        FatalIOErrorInFunction(dict)
            << "Patch '" << pp.name()
            << "': wallTemperature must be 'field' or a number above 0, in K."
            << nl
            << "    Give the number without a unit: wallTemperature 673.15;"
            << exit(FatalIOError);
    }

    //- Stop when the wall temperature at the start is outside the property
    //  tables of the wall: the model would refuse every impact
    void checkTemperature() const
    {
        scalar lowest = rule.temperature;
        scalar highest = rule.temperature;
        if (rule.temperatureFromField)
        {
            const scalarField& T = rule.temperatureOn(mesh, pp.index());
            if (returnReduce(T.size(), sumOp<label>()) == 0) return;
            lowest = gMin(T);
            highest = gMax(T);
        }

        const nearwall::temperature_ranges known = model.ranges(rule.wall);
        if (lowest >= known.wall_low && highest <= known.wall_high) return;

        const std::string source
        (
            rule.temperatureFromField
          ? "field " + rule.temperatureField
          : std::string("wallTemperature")
        );
        FatalIOErrorInFunction(dict)
            << "Patch '" << pp.name() << "': the wall temperature is " << lowest
            << " to " << highest << " K, but the properties of wall '"
            << rule.wallName.c_str() << "' in " << modelName.c_str()
            << " are known from " << known.wall_low << " to " << known.wall_high << " K." << nl << "    Correct "
            << source.c_str() << ", or extend the property tables of the wall's"
            << " material in the model." << exit(FatalIOError);
    }
};

} // End anonymous namespace


Foam::List<Foam::nearWall::patchRule> Foam::nearWall::patchRule::read
(
    const dictionary& coeffs,
    const fvMesh& mesh,
    const nearwall::model& model,
    const string& modelName
)
{
    const polyBoundaryMesh& pbm = mesh.boundaryMesh();
    const dictionary patches(coeffs.subOrEmptyDict("patches"));
    checkEntries(patches, pbm);

    // For patches without an entry: messages name the coefficients
    const dictionary none(coeffs.name());

    List<patchRule> rules(pbm.size());
    forAll(pbm, patchi)
    {
        const polyPatch& pp = pbm[patchi];
        if (!isHandled(pp)) continue;

        const entry* const given = findEntry(patches, pp);
        const dictionary& dict = given ? given->dict() : none;
        patchRule& rule = rules[patchi];
        rule.named = given;
        if (given)
        {
            const word type(nearWall::read<word>(dict, "type"));
            const string owner(" of patch '" + pp.name() + "'");
            rule.type = checkedChoice(dict, "type", type, typeNames, owner);
            const string where("Patch '" + pp.name() + "', type " + type);
            refuseUnknownKeys(dict, knownKeys(rule.type), where);
        }
        else
        {
            rule.type = isA<wallPolyPatch>(pp) ? interact : escape;
        }

        if (rule.type == interact)
        {
            const ruleReader reader{dict, pp, mesh, model, modelName, rule};
            reader.readWall();
            reader.readTemperature();
            reader.checkTemperature();
            rule.extraInputs =
                extraInput::read(coeffs, dict, pp, mesh, model, modelName);
        }
        if (rule.type == rebound)
        {
            rule.e = readFraction(dict, "e", 1);
            rule.mu = readFraction(dict, "mu", 0);
        }
    }
    return rules;
}


const Foam::scalarField& Foam::nearWall::patchRule::temperatureOn
(
    const fvMesh& mesh,
    const label patchi
) const
{
    return
        mesh.lookupObject<volScalarField>(temperatureField)
       .boundaryField()[patchi];
}


void Foam::nearWall::patchRule::report(const word& patchName) const
{
    if (type == pass) return;

    Info<< "        " << patchName << ": " << typeNames[type];
    if (type == rebound) Info<< ", e " << e << ", mu " << mu;
    if (type == interact)
    {
        Info<< ", wall '" << wallName.c_str() << "', temperature ";
        if (temperatureFromField) Info<< "from field " << temperatureField;
        else Info<< temperature << " K";
        for (const extraInput& input : extraInputs)
        {
            Info<< ", " << input.name.c_str() << " "
                << (input.fromField ? "from field" : input.text(input.value).c_str());
        }
    }
    Info<< (named ? "" : " (not named, default)") << nl;
}
