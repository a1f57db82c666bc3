// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "advanceInterval.H"
#include "dictionaryChecks.H"
#include "exactText.H"

namespace
{

//- Keys among the saved totals of the patches
const char* const elapsedKey = "all:elapsed";
const char* const stepsKey = "all:steps";

} // End anonymous namespace


Foam::nearWall::advanceInterval::advanceInterval
(
    const dictionary& memory,
    const dictionary& saved
)
:
    length_
    (
        readChecked<scalar>
        (
            memory, "interval", 0, [](scalar s) { return s >= 0; },
            "a time in seconds, not negative"
        )
    ),
    lengthSteps_
    (
        readChecked<label>
        (
            memory, "intervalSteps", 1, [](label n) { return n >= 1; },
            "a number of steps, 1 or more"
        )
    ),
    elapsed_(readExact(saved, elapsedKey)),
    steps_(label(readExact(saved, stepsKey)))
{
    if (memory.found("interval") && memory.found("intervalSteps"))
    {
        FatalIOErrorInFunction(memory)
            << "memory: 'interval' [s] and 'intervalSteps' are both given; keep"
            << " one of them." << exit(FatalIOError);
    }
}


bool Foam::nearWall::advanceInterval::isDue() const
{
    // A sum of steps is as long as the interval but for rounding
    return length_ > 0 ? elapsed_ >= length_*(1 - 1e-6) : steps_ >= lengthSteps_;
}


void Foam::nearWall::advanceInterval::report(Ostream& os) const
{
    if (length_ <= 0 && lengthSteps_ == 1) return;

    os  << "        deposits advance every ";
    if (length_ > 0) os << length_ << " s";
    else os << lengthSteps_ << " steps";
    os  << "; captured mass lies on the wall after its own step" << nl;
}


void Foam::nearWall::advanceInterval::save(dictionary& saved) const
{
    addExact(saved, elapsedKey, elapsed_);
    addExact(saved, stepsKey, steps_);
}
