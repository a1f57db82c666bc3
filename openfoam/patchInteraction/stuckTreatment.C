// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "stuckTreatment.H"
#include "dictionaryChecks.H"

Foam::nearWall::stuckTreatment Foam::nearWall::readStuckTreatment
(
    const dictionary& coeffs
)
{
    static const Enum<stuckTreatment> names
    ({
        {stuckTreatment::keep, "keep"},
        {stuckTreatment::react, "react"},
        {stuckTreatment::remove, "remove"},
        {stuckTreatment::slide, "slide"}
    });
    const word name(readOr<word>(coeffs, "stuck", word("keep")));
    const stuckTreatment treatment =
        checkedChoice(coeffs, "stuck", name, names);

    if
    (
        treatment == stuckTreatment::slide
     && !readOr<Switch>(coeffs.subOrEmptyDict("memory"), "film", Switch(false))
    )
    {
        FatalIOErrorInFunction(coeffs)
            << "Key 'stuck' is 'slide', but no film flows on the walls." << nl
            << "    Add  memory { film yes; }  or choose keep, react or remove."
            << exit(FatalIOError);
    }
    return treatment;
}


void Foam::nearWall::report
(
    const stuckTreatment treatment,
    const word& depositName
)
{
    const std::string inDeposit("kept in the cloud " + depositName + ", inert");
    const std::string texts[] =
    {
        inDeposit,
        "stay in this cloud and go on reacting",
        "removed",
        "molten ones join the film on the wall, others are " + inDeposit
    };
    Info<< "    nearWallInteraction, stuck parcels: "
        << texts[label(treatment)].c_str() << nl;
}
