// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "parcelModels.H"
#include "dictionaryChecks.H"

#include <algorithm>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- The typeId of the parcels of an injector; FatalIOError where they cannot be
//  told from others
label numberOf
(
    const dictionary& dict,
    const injectorNames& injectors,
    const word& name
)
{
    const wordList& all = injectors.all();
    if (!std::count(all.begin(), all.end(), name))
    {
        FatalIOErrorInFunction(dict)
            << "injectors: the cloud has no injector '" << name << "'." << nl
            << "    Its injectors are " << all << exit(FatalIOError);
    }
    const label id = injectors.typeId(name);
    if (id == -1 && !injectors.isOnly(name))
    {
        FatalIOErrorInFunction(dict)
            << "injectors: the parcels of '" << name << "' cannot be told from"
            << " those of other injectors." << nl
            << "    Give each injector a number of its own in injectionModels:"
            << " injectorID 1;" << exit(FatalIOError);
    }
    return id;
}

} // End anonymous namespace


Foam::nearWall::parcelModels::parcelModels
(
    const dictionary& coeffs,
    const fvMesh& mesh,
    const injectorNames& injectors
)
:
    injectors_(injectors)
{
    const wallModelPtr ofCloud(readWallModel(coeffs, mesh.time()));
    all_.push_back({word(), ofCloud, patchRule::read(coeffs, mesh, *ofCloud)});

    const dictionary dict(coeffs.subOrEmptyDict("injectors"));
    forAllConstIter(dictionary, dict, iter)
    {
        const word name((*iter).keyword());
        if (!(*iter).isDict())
        {
            FatalIOErrorInFunction(dict)
                << "injectors: '" << name << "' must be a dictionary, as in"
                << nl << "    " << name
                << " { model \"<constant>/" << name << ".toml\"; }"
                << exit(FatalIOError);
        }
        const string owner("injector '" + name + "'");
        refuseUnknownKeys((*iter).dict(), wordList({"model"}), owner);
        places_[numberOf(dict, injectors, name)] = all_.size();
        if (injectors.isOnly(name)) places_[-1] = all_.size();

        const wallModelPtr model(readWallModel((*iter).dict(), mesh.time()));
        const string modelName("the model of " + owner);
        all_.push_back
        (
            {name, model, patchRule::read(coeffs, mesh, *model, modelName)}
        );
    }
    extraInput::checkNames(coeffs, extraInputs());
    erodes_ = findErosion();
}


std::vector<std::string> Foam::nearWall::parcelModels::extraInputs() const
{
    std::vector<std::string> names;
    for (const entry& each : all_)
    {
        for (const std::string& name : each.model->extra_inputs())
        {
            const auto end = names.end();
            if (std::find(names.begin(), end, name) == end) names.push_back(name);
        }
    }
    return names;
}


bool Foam::nearWall::parcelModels::findErosion() const
{
    nw_impact impact;
    nw_impact_init(&impact);
    impact.v_n = 1;
    impact.v_t = 1;
    for (const entry& each : all_)
    {
        for (const patchRule& rule : each.rules)
        {
            impact.wall = rule.wall;
            scalar volume = 0;
            const bool here = rule.type == patchRule::interact;
            if (here) each.model->erosion(impact, 1, volume);
            if (volume > 0) return true;
        }
    }
    return false;
}


void Foam::nearWall::parcelModels::report
(
    const dictionary& coeffs,
    const Time& time
) const
{
    Info<< "    nearWallInteraction, model: "
        << wallModelOrigin(coeffs, time).c_str() << nl;
    const dictionary dict(coeffs.subOrEmptyDict("injectors"));
    for (const entry& each : all_)
    {
        if (each.injector.empty()) continue;
        Info<< "    nearWallInteraction, model of injector " << each.injector
            << ": "
            << wallModelOrigin(dict.subDict(each.injector), time).c_str() << nl;
    }
}
