// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "setupRecord.H"
#include "versionCompat.H"

#include <cstdint>
#include <set>
#include <sstream>

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- FNV-1a of a line, in hexadecimal digits
std::string checksum(const std::string& line)
{
    std::uint64_t sum = 14695981039346656037u;
    for (const unsigned char c : line) sum = (sum ^ c)*1099511628211u;
    std::ostringstream digits;
    digits << std::hex << sum;
    return digits.str();
}


//- A text as a word of one token: dictionaries expand some characters of others
void addText(dictionary& dict, const word& key, const std::string& text)
{
    dict.add(keyType(key), string(text), true);
}


std::string textOf(const dictionary& dict, const word& key)
{
    return dict.found(key) ? std::string(read<string>(dict, key)) : "not given";
}


//- The entries of a dictionary, as `memory { film yes; }`
std::string entriesOf(const dictionary& dict)
{
    std::string text;
    forAllConstIter(dictionary, dict, iter)
    {
        OStringStream value;
        if (!(*iter).isDict())
        {
            const tokenList& tokens = (*iter).stream();
            forAll(tokens, i) value << (i ? " " : "") << tokens[i];
        }
        text += (text.empty() ? "" : ", ") + (*iter).keyword() + " " + value.str();
    }
    return text.empty() ? "defaults" : text;
}

} // End anonymous namespace


Foam::nearWall::setupRecord::setupRecord(const statisticsSource& source)
:
    model_(wallModelLines(source.coeffs, source.mesh.time()))
{
    const dictionary& coeffs = source.coeffs;
    std::string sums;
    for (const std::string& line : model_) sums += checksum(line) + " ";
    addText(now_, "model", sums);
    addText
    (
        now_, "memory",
        coeffs.isDict("memory") ? entriesOf(coeffs.subDict("memory")) : "none"
    );
    addText(now_, "stuck", readOr<word>(coeffs, "stuck", word("keep")));
    for (const char* const key : {"seed", "particleTemperature"})
    {
        OStringStream value;
        if (coeffs.found(key)) value << read<scalar>(coeffs, key);
        else value << "default";
        addText(now_, key, value.str());
    }
    forAll(source.rules(), patchi)
    {
        const patchRule& rule = source.rules()[patchi];
        if (rule.type == patchRule::pass) continue;

        const word& name = patchesOf(source.mesh)[patchi].name();
        addText(now_, word("patch:" + name), rule.text());
    }
}


void Foam::nearWall::setupRecord::reportChanges
(
    Ostream& os,
    const dictionary& before
) const
{
    if (before.empty()) return;

    const std::string start("    nearWallInteraction, changed since the earlier run: ");
    forAllConstIter(dictionary, now_, iter)
    {
        const word key((*iter).keyword());
        const std::string was(textOf(before, key));
        const std::string is(textOf(now_, key));
        if (key == "model" || was == is) continue;

        os  << start.c_str() << key << " was '" << was.c_str() << "', is '"
            << is.c_str() << "'" << nl;
    }

    std::istringstream sums(textOf(before, "model"));
    std::multiset<std::string> old;
    for (std::string sum; sums >> sum;) old.insert(sum);
    label changed = 0;
    for (const std::string& line : model_)
    {
        const auto same = old.find(checksum(line));
        if (same != old.end())
        {
            old.erase(same);
            continue;
        }
        ++changed;
        os  << start.c_str() << "the model now has the line  " << line.c_str() << nl;
    }
    if (label(old.size()) > changed)
    {
        os  << start.c_str() << "the model lacks "
            << label(old.size()) - changed << " of its lines" << nl;
    }
}
