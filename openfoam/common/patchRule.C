// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "patchRule.H"
#include "dictionaryChecks.H"
#include "dictionaryEntry.H"
#include "emptyPolyPatch.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"
#include "versionCompat.H"
#include "wallPolyPatch.H"
#include "wordRe.H"

const Foam::nearWall::Enum<Foam::nearWall::patchRule::ruleType>
Foam::nearWall::patchRule::typeNames
({
    {interact, "interact"},
    {escape, "escape"},
    {rebound, "rebound"},
    {stick, "stick"},
    {pass, "none"}
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


//- Has the patch a rule without an entry?
bool isHandled(const polyPatch& pp)
{
    return !pp.coupled() && !isConstraint(pp);
}


//- May an entry give the patch a rule? OpenFOAM asks the model at cyclic
//  patches and at planes of symmetry, too, but not between ranks. A list of
//  localInteraction even must name planes of symmetry.
bool mayBeNamed(const polyPatch& pp)
{
    return !isA<processorPolyPatch>(pp) && !isA<emptyPolyPatch>(pp);
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


//- The key `patches`: a dictionary, or a list as localInteraction reads it
struct patchEntries
{
    dictionary dict;

    //- In a list the first entry that fits counts, else the best
    bool isList = false;

    const polyBoundaryMesh& pbm;

    patchEntries(const dictionary& coeffs, const polyBoundaryMesh& pbm)
    :
        pbm(pbm)
    {
        if (coeffs.isDict("patches"))
        {
            dict = coeffs.subDict("patches");
        }
        else if (coeffs.found("patches"))
        {
            isList = true;
            readList(coeffs);
        }
        check();
    }

    //- name { ... } name { ... } between brackets
    void readList(const dictionary& coeffs)
    {
        dict.name() = coeffs.name();
        const tokenList& tokens = coeffs.lookup("patches");
        label from = 0;
        while (from < tokens.size() && tokens[from].isLabel()) ++from;
        const auto is = [&](const label i, const token::punctuationToken t)
        {
            return
                i >= 0 && i < tokens.size() && tokens[i].isPunctuation()
             && tokens[i].pToken() == t;
        };
        if
        (
            !is(from, token::BEGIN_LIST)
         || !is(tokens.size() - 1, token::END_LIST)
        )
        {
            FatalIOErrorInFunction(coeffs)
                << "Key 'patches' must be a dictionary or a list of entries,"
                << " as in" << nl << "    patches { floor { type interact; } }"
                << nl << "    Behind the ')' of a list stands a ';'."
                << exit(FatalIOError);
        }
        tokenList inside(SubList<token>(tokens, tokens.size() - from - 2, from + 1));
        ITstream stream(coeffs.name(), inside);
        stream.lineNumber() = coeffs.startLineNumber();
        dict.read(stream, false);
    }

    //- Does an entry fit every patch between which OpenFOAM does not move
    //  parcels to another rank? It then does not mean the coupled ones.
    bool isForAll(const keyType& key) const
    {
        forAll(pbm, patchi)
        {
            if (mayBeNamed(pbm[patchi]) && !fit(key, pbm[patchi])) return false;
        }
        return true;
    }

    //- How well an entry applies to a patch; in a list as in localInteraction
    int applies(const keyType& key, const polyPatch& pp) const
    {
        const int f = fit(key, pp);
        const bool here =
            isHandled(pp) || f == 3
         || (mayBeNamed(pp) && (isList || !isForAll(key)));
        return here ? f : 0;
    }

    //- The entry for a patch, null if there is none
    const entry* find(const polyPatch& pp) const
    {
        const entry* best = nullptr;
        int bestFit = 1;
        forAllConstIter(dictionary, dict, iter)
        {
            const int f = applies((*iter).keyword(), pp);
            if (f < bestFit) continue;

            best = &(*iter);
            bestFit = f;
            if (isList) break;
        }
        return best;
    }

    //- Every entry must be a dictionary and fit a patch that may have a rule
    void check() const
    {
        forAllConstIter(dictionary, dict, iter)
        {
            const keyType& key = (*iter).keyword();
            if (!(*iter).isDict())
            {
                FatalIOErrorInFunction(dict)
                    << "patches: '" << key << "' must be a dictionary, as in"
                    << nl << "    " << key << " { type interact; }"
                    << exit(FatalIOError);
            }
            checkFit(key);
        }
    }

    void checkFit(const keyType& key) const
    {
        wordList names;
        const polyPatch* other = nullptr;
        forAll(pbm, patchi)
        {
            const bool fits = fit(key, pbm[patchi]);
            if (mayBeNamed(pbm[patchi]))
            {
                if (fits) return;
                names.append(pbm[patchi].name());
            }
            else if (fits) other = &pbm[patchi];
        }

        // localInteraction ignores them
        if (other && isList) return;
        if (other)
        {
            FatalIOErrorInFunction(dict)
                << "patches: OpenFOAM itself handles '" << key
                << "', a patch of type " << other->type()
                << ". Remove the entry." << exit(FatalIOError);
        }
        FatalIOErrorInFunction(dict)
            << "patches: '" << key << "' matches no patch and no patch"
            << " group of this mesh." << nl << "    The patches are " << names
            << exit(FatalIOError);
    }
};


//- Stop where a coupled patch with a rule lies between ranks: OpenFOAM moves
//  the parcels there without asking the model
void refuseSplit(const dictionary& dict, const polyPatch& pp)
{
    const polyBoundaryMesh& pbm = pp.boundaryMesh();
    label split = 0;
    forAll(pbm, patchi)
    {
        if (!isA<processorCyclicPolyPatch>(pbm[patchi])) continue;

        const auto& between = refCast<const processorCyclicPolyPatch>(pbm[patchi]);
        if (referPatch(between) == pp.index()) split += between.size();
    }
    if (sumOfRanks(split) == 0) return;

    FatalIOErrorInFunction(dict)
        << "Patch '" << pp.name() << "' and its neighbour lie on different"
        << " ranks, where OpenFOAM passes parcels on without asking a patch"
        << " interaction model." << nl
        << "    Keep them together, in decomposeParDict:" << nl
        << "    constraints { p { type preservePatches; patches ("
        << pp.name() << "); } }" << exit(FatalIOError);
}


scalar readFraction(const dictionary& dict, const word& key, const scalar other)
{
    return readChecked<scalar>
    (
        dict, key, other, [](scalar x) { return x >= 0 && x <= 1; },
        "from 0 to 1"
    );
}


//- Faces whose wall temperature is outside the property tables of the wall:
//  the model refuses impacts there. All of them at the start of a case are a
//  mistake; some, or those of a run that goes on, are counted.
void checkTemperature
(
    const dictionary& dict,
    const polyPatch& pp,
    const fvMesh& mesh,
    const nearwall::model& model,
    const string& modelName,
    const wallRule& rule
)
{
    const nearwall::temperature_ranges known = model.ranges(rule.wall);
    scalarField T(pp.size(), rule.temperature);
    if (rule.temperatureFromField) T = rule.temperatureOn(mesh, pp.index());
    label outside = 0;
    for (const scalar x : T) outside += x < known.wall_low || x > known.wall_high;
    outside = sumOfRanks(outside);
    if (outside == 0) return;

    const label all = sumOfRanks(T.size());
    OStringStream what;
    what<< "the wall temperature is " << gMin(T) << " to " << gMax(T)
        << " K, but the properties of wall '" << rule.wallName.c_str()
        << "' in " << modelName.c_str() << " are known from "
        << known.wall_low << " to " << known.wall_high << " K";
    const bool goesOn = mesh.time().timeIndex() > 0;
    if (rule.temperatureFromField && (goesOn || outside < all))
    {
        Info<< "    nearWallInteraction, warning: patch " << pp.name() << ", "
            << outside << " of " << all << " faces: " << what.str().c_str()
            << "; impacts there cannot be decided" << endl;
        return;
    }
    const std::string source("field " + rule.temperatureField);
    FatalIOErrorInFunction(dict)
        << "Patch '" << pp.name() << "': " << what.str().c_str() << "." << nl
        << "    Correct "
        << (rule.temperatureFromField ? source.c_str() : "wallTemperature")
        << ", or extend the property tables of the wall's material in the"
        << " model." << exit(FatalIOError);
}


//- The type of a patch without an entry, or that of its entry, of which the
//  keys are checked
patchRule::ruleType readType
(
    const dictionary& dict,
    const bool given,
    const polyPatch& pp
)
{
    if (!given)
    {
        return isA<wallPolyPatch>(pp) ? patchRule::interact : patchRule::escape;
    }
    const word name(nearWall::read<word>(dict, "type"));
    const string owner(" of patch '" + pp.name() + "'");
    const patchRule::ruleType type =
        checkedChoice(dict, "type", name, patchRule::typeNames, owner);
    const string where("Patch '" + pp.name() + "', type " + name);
    refuseUnknownKeys(dict, knownKeys(type), where);
    if (pp.coupled()) refuseSplit(dict, pp);
    return type;
}

} // End anonymous namespace


Foam::List<Foam::nearWall::patchRule> Foam::nearWall::patchRule::read
(
    const dictionary& coeffs,
    const fvMesh& mesh,
    const nearwall::model& model,
    const string& modelName
)
{
    const polyBoundaryMesh& pbm = patchesOf(mesh);
    const patchEntries patches(coeffs, pbm);

    // For patches without an entry: messages name the coefficients
    const dictionary none(coeffs.name());

    List<patchRule> rules(pbm.size());
    forAll(pbm, patchi)
    {
        const polyPatch& pp = pbm[patchi];
        const entry* const given = patches.find(pp);
        if (!given && !isHandled(pp)) continue;

        const dictionary& dict = given ? given->dict() : none;
        patchRule& rule = rules[patchi];
        rule.named = given;
        rule.type = readType(dict, given, pp);
        if (rule.type == interact)
        {
            rule.readWall(dict, pp, model, modelName);
            rule.readTemperature(dict, pp);
            rule.findField(dict, pp, mesh);
            checkTemperature(dict, pp, mesh, model, modelName, rule);
            rule.extraInputs =
                extraInput::read(coeffs, dict, pp, mesh, model, modelName);
        }
        rule.e = readFraction(dict, "e", 1);
        rule.mu = readFraction(dict, "mu", 0);
    }
    return rules;
}


std::string Foam::nearWall::patchRule::text() const
{
    OStringStream os;
    os  << typeNames[type];
    if (type == rebound) os << ", e " << e << ", mu " << mu;
    if (type == interact)
    {
        os  << ", wall '" << wallName.c_str() << "', temperature ";
        if (temperatureFromField) os << "from field " << temperatureField;
        else os << temperature << " K";
        for (const extraInput& input : extraInputs)
        {
            os  << ", " << input.name.c_str() << " "
                << (input.fromField ? "from field" : input.text(input.value).c_str());
        }
    }
    return os.str();
}


void Foam::nearWall::patchRule::report(const word& patchName) const
{
    if (type == pass && !named) return;

    Info<< "        " << patchName << ": " << text().c_str()
        << (named ? "" : " (not named, default)") << nl;
}
