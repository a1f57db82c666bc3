// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallModel.H"
#include "ITstream.H"
#include "versionCompat.H"

#include <fstream>
#include <sstream>

namespace
{

using namespace Foam;

//- The text of an inline model; null where the key names a file
const string* inlineText(const dictionary& coeffs)
{
    const tokenList& given = coeffs.lookup("model");
    const bool isInline = given.size() == 1 && nearWall::isVerbatim(given[0]);
    return isInline ? &nearWall::verbatimText(given[0]) : nullptr;
}


fileName modelPath(const dictionary& coeffs, const Time& time)
{
    // <constant> and <system>, which the Foundation's expand() does not know
    fileName path(nearWall::read<fileName>(coeffs, "model"));
    path.replaceAll("<case>/", "");
    for (const char* const folder : {"constant", "system"})
    {
        path.replaceAll("<" + word(folder) + ">", folder);
    }
    path.expand();
    return path.isAbsolute() ? path : nearWall::caseFolder(time)/path;
}

} // End anonymous namespace


Foam::string Foam::nearWall::wallModelOrigin
(
    const dictionary& coeffs,
    const Time& time
)
{
    if (inlineText(coeffs)) return "inline model of " + coeffs.name();
    return modelPath(coeffs, time);
}


std::vector<std::string> Foam::nearWall::wallModelLines
(
    const dictionary& coeffs,
    const Time& time
)
{
    const string* const text = inlineText(coeffs);
    std::stringstream all(text ? std::string(*text) : std::string());
    if (!text) all << std::ifstream(modelPath(coeffs, time).c_str()).rdbuf();

    std::vector<std::string> lines;
    std::string line;
    while (std::getline(all, line))
    {
        const char* const blanks = " \t\r";
        const std::size_t from = line.find_first_not_of(blanks);
        if (from == std::string::npos || line[from] == '#') continue;

        const std::size_t to = line.find_last_not_of(blanks);
        lines.push_back(line.substr(from, to - from + 1));
    }
    return lines;
}


Foam::nearWall::wallModelPtr Foam::nearWall::readWallModel
(
    const dictionary& coeffs,
    const Time& time
)
{
    if (!coeffs.found("model") || coeffs.isDict("model"))
    {
        FatalIOErrorInFunction(coeffs)
            << "Key 'model' is "
            << (coeffs.found("model") ? "a dictionary" : "missing")
            << ". Give the name of the model's file, as in" << nl
            << "    model \"<constant>/nearWall.toml\";" << nl
            << "or the text of such a file as a verbatim string:" << nl
            << "    model #{ ... #};" << exit(FatalIOError);
    }

    try
    {
        const string* const text = inlineText(coeffs);
        const string origin(wallModelOrigin(coeffs, time));
        return std::make_shared<const nearwall::model>
        (
            text
          ? nearwall::model::from_toml(*text, origin)
          : nearwall::model::from_file(origin)
        );
    }
    catch (const nearwall::error& fault)
    {
        FatalIOErrorInFunction(coeffs)
            << "The wall model cannot be used:" << nl
            << fault.what() << exit(FatalIOError);
    }
    return wallModelPtr();
}
