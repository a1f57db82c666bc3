/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallToml.H. Values are read from the token stream of an entry, as
        lists of dictionaries are kept there unparsed.
\*---------------------------------------------------------------------------*/

#include "nearWallToml.H"
#include "ITstream.H"
#include "nearWallLedger.H"

namespace
{

using namespace Foam;

//- TOML wants a float to look like one
std::string numberText(const double x)
{
    std::string s(nearWall::exactText(x));
    if (s.find_first_of(".en") == std::string::npos)
    {
        s += ".0";
    }
    return s;
}


std::string quoted(const std::string& s)
{
    std::string out("\"");
    for (const char c : s)
    {
        switch (c)
        {
            case '"':  out += "\\\""; break;
            case '\\': out += "\\\\"; break;
            case '\n': out += "\\n"; break;
            case '\t': out += "\\t"; break;
            case '\r': out += "\\r"; break;
            default:   out += c;
        }
    }
    return out + '"';
}


//- A key: bare where TOML allows it, quoted otherwise (dots, regular
//  expressions)
std::string keyText(const std::string& key)
{
    const char* const bare =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

    if (!key.empty() && key.find_first_not_of(bare) == std::string::npos)
    {
        return key;
    }
    return quoted(key);
}


//- Words that OpenFOAM reads as a switch and TOML wants as a boolean
bool isSwitch(const std::string& w, bool& value)
{
    value = (w == "true" || w == "yes" || w == "on");
    return value || w == "false" || w == "no" || w == "off";
}


//- Reads one entry's tokens into inline TOML values
class valueReader
{
    const dictionary& dict_;
    const word key_;
    const tokenList& tokens_;
    label at_;

    void fault(const std::string& what) const
    {
        FatalIOErrorInFunction(dict_)
            << "inline wall model, key '" << key_ << "': " << what.c_str()
            << exit(FatalIOError);
    }

    bool more() const
    {
        return at_ < tokens_.size();
    }

    const token& peek() const
    {
        if (!more()) fault("the value ends too early");
        return tokens_[at_];
    }

    bool isMark(const char c) const
    {
        return more() && tokens_[at_].isPunctuation()
            && tokens_[at_].pToken() == token::punctuationToken(c);
    }

    void skip(const char c)
    {
        if (!isMark(c)) fault(std::string("expected '") + c + "'");
        ++at_;
    }

    // ( a b c ) -> [a, b, c]
    std::string list()
    {
        skip('(');
        std::string out("[");
        while (!isMark(')'))
        {
            if (out.size() > 1) out += ", ";
            out += value();
        }
        skip(')');
        return out + "]";
    }

    // { k v; } -> { k = v }
    std::string table()
    {
        skip('{');
        std::string out("{ ");
        while (!isMark('}'))
        {
            if (out.size() > 2) out += ", ";
            out += pair();
        }
        skip('}');
        return out + " }";
    }

    std::string pair()
    {
        const token& t = peek();
        if (!t.isWord() && !t.isString()) fault("expected a key");
        const std::string key(t.isWord() ? t.wordToken() : t.stringToken());
        ++at_;
        if (isMark('{'))
        {
            return keyText(key) + " = " + table();
        }
        const std::string text(value());
        skip(';');
        return keyText(key) + " = " + text;
    }

    std::string scalarValue()
    {
        const token& t = peek();
        ++at_;
        if (t.isLabel()) return std::to_string(t.labelToken());
        if (t.isNumber()) return numberText(t.number());
        if (t.isString()) return quoted(t.stringToken());
        if (t.isWord())
        {
            bool on;
            if (isSwitch(t.wordToken(), on)) return on ? "true" : "false";
            return quoted(t.wordToken());
        }
        fault("a value that a model file cannot hold");
        return std::string();
    }

public:

    valueReader(const dictionary& dict, const word& key, const tokenList& tokens)
    :
        dict_(dict),
        key_(key),
        tokens_(tokens),
        at_(0)
    {}

    std::string value()
    {
        // A list may be written with its length before it: 3(1 2 3)
        if
        (
            peek().isLabel() && at_ + 1 < tokens_.size()
         && tokens_[at_ + 1].isPunctuation()
         && tokens_[at_ + 1].pToken() == token::BEGIN_LIST
        )
        {
            ++at_;
        }

        if (isMark('(')) return list();
        if (isMark('{')) return table();
        return scalarValue();
    }

    std::string whole()
    {
        const std::string text(value());
        if (more()) fault("one value expected; put several in ( )");
        return text;
    }
};


void writeTable
(
    std::string& out,
    const std::string& path,
    const dictionary& dict
)
{
    if (!path.empty())
    {
        out += "\n[" + path + "]\n";
    }

    forAllConstIter(dictionary, dict, iter)
    {
        const entry& e = *iter;
        if (!e.isDict())
        {
            ITstream& is = e.stream();
            valueReader reader(dict, e.keyword(), is);
            out += keyText(e.keyword()) + " = " + reader.whole() + "\n";
        }
    }

    forAllConstIter(dictionary, dict, iter)
    {
        const entry& e = *iter;
        if (e.isDict())
        {
            const std::string key(keyText(e.keyword()));
            writeTable(out, path.empty() ? key : path + "." + key, e.dict());
        }
    }
}

} // End anonymous namespace


std::string Foam::nearWall::tomlFrom(const dictionary& dict)
{
    std::string out;
    writeTable(out, std::string(), dict);
    return out;
}
