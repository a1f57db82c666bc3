// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "exactText.H"
#include "versionCompat.H"

#include <cmath>
#include <cstdio>
#include <cstdlib>

std::string Foam::nearWall::exactText(const scalar x)
{
    // Fast path for counts, and for -0, which a restart reads as 0. isless()
    // raises no floating-point trap for NaN.
    if
    (
        std::isless(std::fabs(x), 1e9)
     && x == std::floor(x)
     && (x == 0 || !std::signbit(x))
    )
    {
        return std::to_string(static_cast<long>(x));
    }

    char text[40];
    for (int digits = 15; digits <= 17; ++digits)
    {
        std::snprintf(text, sizeof(text), "%.*g", digits, x);
        if (std::atof(text) == x) break;
    }
    return text;
}


void Foam::nearWall::addExact
(
    dictionary& dict,
    const word& key,
    const scalar x
)
{
    dict.add(keyType(key), string(exactText(x)), true);
}


Foam::scalar Foam::nearWall::readExact(const dictionary& dict, const word& key)
{
    return dict.found(key) ? std::atof(read<string>(dict, key).c_str()) : 0;
}
