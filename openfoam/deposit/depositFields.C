// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "depositFields.H"
#include "versionCompat.H"
#include "wallField.H"

const std::vector<Foam::nearWall::depositFields::faceField>&
Foam::nearWall::depositFields::table()
{
    typedef nw_deposit d;
    const dimensionSet areal(dimMass/dimArea);

    // The member solid is kept as the thickness of the layer
    static const std::vector<faceField> rows
    ({
        {"moltenMass", areal, always, &d::molten, GREAT, "molten", "_kg_m2"},
        {"frozenMass", areal, always, &d::frozen, GREAT, "frozen", "_kg_m2"},
        {"powderMass", areal, always, &d::powder, GREAT, "powder", "_kg_m2"},
        {"enclosedShare", dimless, always, &d::behind, 1, nullptr, nullptr},
        {"closedVoids", dimLength, onCooledWalls, &d::closed, GREAT, nullptr, nullptr},
        {"layerThickness", dimLength, always, &d::solid, GREAT, "layer_thickness", "_m"},
        {"coverArea", dimless, always, &d::cover, GREAT, nullptr, nullptr},
        {"depositConversion", dimless, always, &d::conversion, 1, nullptr, nullptr},
        {
            "resuspendedShare", dimless, whereGasCarriesAway, &d::resuspended, 1,
            nullptr, nullptr
        },
        {"coverage", dimless, always, nullptr, 1, "coverage", ""},
        {
            "wallTemperature", dimTemperature, always, nullptr, GREAT,
            "wall_temperature", "_K"
        },
        {
            "wallHeatFlux", dimPower/dimArea, onCooledWalls, nullptr, GREAT,
            "heat_flux", "_W_m2"
        },
        {
            "underTemperature", dimTemperature, onCooledWalls, nullptr, GREAT,
            nullptr, nullptr
        }
    });
    return rows;
}


Foam::nearWall::depositFields::depositFields
(
    const fvMesh& mesh,
    const word& cloudName,
    const scalar voidage,
    const bool cooled,
    const bool carriesAway
)
:
    mesh_(mesh),
    cloudName_(cloudName),
    voidage_(voidage)
{
    const bool exists[] = {true, cooled, carriesAway};
    for (label f = 0; f < nFields; ++f)
    {
        const faceField& row = table()[f];
        if (!exists[row.present]) continue;

        const word name(cloudName + ":" + row.name);
        fields_[f].reset
        (
            new volScalarField(readWallField(mesh, name, row.dimensions))
        );
    }
}


bool Foam::nearWall::depositFields::isThere(const label f) const
{
    return onAnyRank(fields_[f] && fields_[f]->headerOk());
}


bool Foam::nearWall::depositFields::given() const
{
    bool found = false;
    for (label f = 0; f < nFields; ++f)
    {
        if (table()[f].member && fields_[f]) found = isThere(f) || found;
    }
    return found;
}


std::string Foam::nearWall::depositFields::names() const
{
    std::string all;
    for (label f = 0; f < nFields; ++f)
    {
        if (fields_[f]) all += std::string(table()[f].name) + " ";
    }
    return all;
}


void Foam::nearWall::depositFields::requireComplete
(
    const std::string& saved
) const
{
    const field ofPowder[] = {powder, layer, cover};
    bool anyPowder = false;
    for (const field f : ofPowder) anyPowder = isThere(f) || anyPowder;

    for (label f = 0; f < nFields; ++f)
    {
        const std::string name(table()[f].name);
        const bool wasSaved =
            (" " + saved).find(" " + name + " ") != std::string::npos;
        const bool needed =
            wasSaved || (anyPowder && (f == powder || f == layer || f == cover));
        if (!needed) continue;

        const word file(cloudName_ + ":" + name);
        if (!fields_[f])
        {
            Info<< "    nearWallInteraction, warning: field " << file << " of the"
                << " earlier run is not used: no wall needs it now" << nl;
        }
        else if (!isThere(f))
        {
            FatalErrorInFunction
                << "Field " << file << " of time " << timeName(mesh_.time())
                << " is missing, so that its deposit would be lost." << nl
                << "    "
                << (wasSaved
                  ? "Restore the file, or go on from another time."
                  : "Powder on the walls needs powderMass [kg/m2], layerThickness"
                    " [m] and coverArea [1].")
                << exit(FatalError);
        }
    }
}


void Foam::nearWall::depositFields::check(const labelList& patches) const
{
    for (label f = 0; f < nFields; ++f)
    {
        const faceField& row = table()[f];
        if (!row.member || !fields_[f]) continue;

        const volScalarField& values = *fields_[f];
        for (const label patchi : patches)
        {
            for (const scalar x : values.boundaryField()[patchi])
            {
                if (x >= 0 && x <= row.most) continue;

                FatalErrorInFunction
                    << "Field " << values.name() << " of time "
                    << timeName(values.time()) << " is " << x << " on patch '"
                    << patchesOf(values.mesh())[patchi].name()
                    << "'; it must be from 0 to " << row.most << "."
                    << exit(FatalError);
            }
        }
    }
}


nw_deposit Foam::nearWall::depositFields::deposit
(
    const std::uint32_t wall,
    const label patchi,
    const label facei
) const
{
    nw_deposit d(nearwall::make_deposit(wall));
    for (label f = 0; f < nFields; ++f)
    {
        double nw_deposit::* const member = table()[f].member;
        if (member && fields_[f])
        {
            d.*member = fields_[f]->boundaryField()[patchi][facei];
        }
    }
    d.solid = (d.solid + d.closed)*(1 - voidage_);
    return d;
}


void Foam::nearWall::depositFields::set
(
    const label patchi,
    const label facei,
    const nw_deposit& d
)
{
    nw_deposit kept(d);
    kept.solid = d.solid/(1 - voidage_) - d.closed;
    for (label f = 0; f < nFields; ++f)
    {
        double nw_deposit::* const member = table()[f].member;
        if (member && fields_[f])
        {
            fields_[f]->boundaryFieldRef()[patchi][facei] = kept.*member;
        }
    }
}


void Foam::nearWall::depositFields::setCoverage
(
    const label patchi,
    const label facei
)
{
    const bool hasSlag =
        on(molten, patchi)[facei] + on(frozen, patchi)[facei] > 0;
    const scalar outside = hasSlag ? 1 - on(enclosed, patchi)[facei] : 1;
    on(coverage, patchi)[facei] =
        -std::expm1(-on(cover, patchi)[facei]*outside);
}


void Foam::nearWall::depositFields::setCoverage(const label patchi)
{
    forAll(on(cover, patchi), facei) setCoverage(patchi, facei);
}


void Foam::nearWall::depositFields::spread
(
    const label patchi,
    const scalarField& factor
)
{
    for (const field f : {molten, frozen, powder, closed, layer, cover})
    {
        if (fields_[f]) on(f, patchi) *= factor;
    }
    setCoverage(patchi);
}


void Foam::nearWall::depositFields::archive
(
    stateArchive& state,
    const labelList& patches
)
{
    for (label f = 0; f < nFields; ++f)
    {
        if (!fields_[f]) continue;

        for (const label patchi : patches) state.values(on(field(f), patchi));
    }
}
