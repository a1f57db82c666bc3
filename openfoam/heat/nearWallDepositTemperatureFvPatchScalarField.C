// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallDepositTemperatureFvPatchScalarField.H"
#include "addToRunTimeSelectionTable.H"
#include "basicThermo.H"
#include "dictionaryChecks.H"
#include "physicoChemicalConstants.H"
#include "wallMemory.H"

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- Read a number, with the word before it that a file for
//  externalWallHeatFluxTemperature has: `h uniform 100;`, `Ta constant 300;`
scalar readNumber(const dictionary& dict, const word& key)
{
    const tokenList& given = dict.lookup(key);
    const label n = given.size();
    const bool named =
        n == 2 && given[0].isWord()
     && (given[0].wordToken() == "uniform" || given[0].wordToken() == "constant");
    if ((n == 1 || named) && given[n - 1].isNumber() && given[n - 1].number() > 0)
    {
        return given[n - 1].number();
    }
    FatalIOErrorInFunction(dict)
        << "Key '" << key << "' must be one number above 0, without a unit."
        << exit(FatalIOError);
    return 0;
}


//- Least resistance between the surface and a front below it [m2 K/W]: bare
//  slag that melts has the temperature at which it does
const scalar leastResistance = 1e-10;


//- Refuse keys that this condition does not read; those behind `relaxation`
//  are OpenFOAM's own, or what this condition writes
void refuseOtherKeys(const dictionary& dict, const string& owner)
{
    const word mode(readOr<word>(dict, "mode", word("coefficient")));
    if (mode != "coefficient" || dict.found("Q") || dict.found("q"))
    {
        FatalIOErrorInFunction(dict)
            << "nearWallDepositTemperature computes the heat flux: it knows only"
            << " mode coefficient, without Q and q." << exit(FatalIOError);
    }
    refuseUnknownKeys
    (
        dict,
        wordList
        ({
            "Ta", "h", "thicknessLayers", "kappaLayers", "emissivity",
            "surroundingsTemperature", "qr", "alphat", "cloud", "relaxation", "vapour",
            "bulkTemperature",
            "type", "value", "mode", "kappaMethod", "refValue", "refGradient",
            "refGrad", "valueFraction", "radiating", "patchType", "useImplicit",
            "source", "libs"
        }),
        owner
    );
}

} // End anonymous namespace


Foam::nearWallDepositTemperatureFvPatchScalarField::settings::settings
(
    const dictionary& dict,
    const string& owner
)
:
    Ta(readNumber(dict, "Ta")),
    thicknessLayers(readOr<scalarList>(dict, "thicknessLayers", scalarList())),
    kappaLayers(readOr<scalarList>(dict, "kappaLayers", scalarList())),
    emissivity
    (
        readChecked<scalar>
        (
            dict, "emissivity", 0, [](scalar e) { return e >= 0 && e <= 1; },
            "from 0 to 1"
        )
    ),
    qr(readOr<word>(dict, "qr", word("none"))),
    alphat(readOr<word>(dict, "alphat", word("alphat"))),
    cloud(readOr<word>(dict, "cloud", word())),
    vapour(readOr<word>(dict, "vapour", word("none"))),
    relaxation
    (
        readChecked<scalar>
        (
            dict, "relaxation", 1, [](scalar r) { return r > 0 && r <= 1; },
            "above 0 and at most 1"
        )
    )
{
    refuseOtherKeys(dict, owner);
    if (dict.found("h")) h = readNumber(dict, "h");
    warnOfCelsius(Ta, owner + ": Ta");
    if (dict.found("surroundingsTemperature"))
    {
        surroundingsTemperature = readNumber(dict, "surroundingsTemperature");
    }
    if (dict.found("bulkTemperature"))
    {
        bulkTemperature = readNumber(dict, "bulkTemperature");
        warnOfCelsius(bulkTemperature, owner + ": bulkTemperature");
    }
    checkWall(dict);
    checkGas(dict, owner);
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::settings::checkWall
(
    const dictionary& dict
) const
{
    bool sound = thicknessLayers.size() == kappaLayers.size();
    for (const scalar l : thicknessLayers) sound = sound && l >= 0;
    for (const scalar k : kappaLayers) sound = sound && k > 0;
    if (!sound)
    {
        FatalIOErrorInFunction(dict)
            << "Keys 'thicknessLayers' [m] and 'kappaLayers' [W/m/K] need as"
            << " many numbers, no thickness below 0 and each conductivity"
            << " above 0." << exit(FatalIOError);
    }
    if (resistance() <= 2/VGREAT)
    {
        FatalIOErrorInFunction(dict)
            << "Nothing lies between coolant and deposit: give 'h' [W/m2/K], or"
            << " 'thicknessLayers' and 'kappaLayers'." << exit(FatalIOError);
    }
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::settings::checkGas
(
    const dictionary& dict,
    const string& owner
) const
{
    if ((emissivity > 0) != (surroundingsTemperature > 0))
    {
        FatalIOErrorInFunction(dict)
            << "Give 'emissivity' and 'surroundingsTemperature' [K] together, or"
            << " 'qr' with a radiation model." << exit(FatalIOError);
    }
    if (emissivity > 0 && qr != "none")
    {
        FatalIOErrorInFunction(dict)
            << owner.c_str() << ": 'qr' and 'emissivity' are both given, and the"
            << " wall would take up its radiation twice." << nl
            << "    Remove 'qr', or 'emissivity' and 'surroundingsTemperature'."
            << exit(FatalIOError);
    }
    if (bulkTemperature > 0 && vapour != "none")
    {
        FatalIOErrorInFunction(dict)
            << owner.c_str() << ": 'vapour' and 'bulkTemperature' are both"
            << " given." << nl << "    Remove 'bulkTemperature': the field has"
            << " the vapour of each cell."
            << exit(FatalIOError);
    }
}


Foam::scalar
Foam::nearWallDepositTemperatureFvPatchScalarField::settings::resistance() const
{
    scalar sum = 1/h;
    forAll(thicknessLayers, i) sum += thicknessLayers[i]/kappaLayers[i];
    return sum;
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::settings::write
(
    Ostream& os
) const
{
    writeKey(os, "Ta", Ta);
    if (h < VGREAT) writeKey(os, "h", h);
    if (thicknessLayers.size())
    {
        writeTypedList(os, "thicknessLayers", thicknessLayers);
        writeTypedList(os, "kappaLayers", kappaLayers);
    }
    if (emissivity > 0)
    {
        writeKey(os, "emissivity", emissivity);
        writeKey(os, "surroundingsTemperature", surroundingsTemperature);
    }
    writeKey(os, "qr", qr);
    writeKey(os, "alphat", alphat);
    if (vapour != "none") writeKey(os, "vapour", vapour);
    if (bulkTemperature > 0) writeKey(os, "bulkTemperature", bulkTemperature);
    if (!cloud.empty()) writeKey(os, "cloud", cloud);
    writeKey(os, "relaxation", relaxation);
}


Foam::nearWallDepositTemperatureFvPatchScalarField::
nearWallDepositTemperatureFvPatchScalarField
(
    const fvPatch& p,
    const volScalarField::Internal& iF
)
:
    mixedFvPatchScalarField(p, iF)
{
    refValue() = 0;
    refGrad() = 0;
    valueFraction() = 1;
}


Foam::nearWallDepositTemperatureFvPatchScalarField::
nearWallDepositTemperatureFvPatchScalarField
(
    const fvPatch& p,
    const volScalarField::Internal& iF,
    const dictionary& dict
)
:
    mixedFvPatchScalarField(p, iF),
    given_
    (
        dict,
        "Patch '" + p.name() + "' of " + iF.name()
      + ", nearWallDepositTemperature"
    )
{
    const dimensionSet& K = iF.dimensions();
    fvPatchScalarField::operator=(readField(dict, "value", K, p.size()));
    refValue() = *this;
    refGrad() = 0;
    valueFraction() = 1;
    if (dict.found("refValue"))
    {
        // A run that goes on
        refValue() = readField(dict, "refValue", K, p.size());
        if (dict.found("radiating"))
        {
            radiating_ = readField(dict, "radiating", K, p.size());
        }
        valueFraction() = readField(dict, "valueFraction", dimless, p.size());
    }
}


Foam::nearWallDepositTemperatureFvPatchScalarField::
nearWallDepositTemperatureFvPatchScalarField
(
    const nearWallDepositTemperatureFvPatchScalarField& from,
    const fvPatch& p,
    const volScalarField::Internal& iF,
    const fvPatchFieldMapper& m
)
:
    mixedFvPatchScalarField(from, p, iF, m),
    given_(from.given_)
{
    if (from.radiating_.size()) radiating_ = nearWall::mapped(m, from.radiating_);
}


const Foam::nearWall::wallMemory*
Foam::nearWallDepositTemperatureFvPatchScalarField::memory() const
{
    return nearWall::wallMemory::find
    (
        refCast<const fvMesh>(db()), given_.cloud, patch().index()
    );
}


Foam::tmp<Foam::scalarField>
Foam::nearWallDepositTemperatureFvPatchScalarField::effectiveConductivity() const
{
    const scalarField none(size(), Zero);
    const bool turbulent = db().foundObject<volScalarField>(given_.alphat);
    const scalarField& alphat =
        turbulent
      ? db().lookupObject<volScalarField>(given_.alphat)
       .boundaryField()[patch().index()]
      : none;
    return nearWall::effectiveConductivityOf(thermo(), alphat, patch().index());
}


const Foam::basicThermo&
Foam::nearWallDepositTemperatureFvPatchScalarField::thermo() const
{
    const word& name = nearWall::thermoName();
    if (!db().foundObject<basicThermo>(name))
    {
        FatalErrorInFunction
            << "Patch '" << patch().name() << "' of "
            << internalField().name() << ": nearWallDepositTemperature needs the"
            << " conductivity of the gas, but this solver has no " << name << "."
            << nl << "    Take a compressible solver with thermophysical"
            << " properties, or another condition." << exit(FatalError);
    }
    return db().lookupObject<basicThermo>(name);
}


Foam::tmp<Foam::scalarField>
Foam::nearWallDepositTemperatureFvPatchScalarField::gasCoefficient() const
{
    return effectiveConductivity()*patch().deltaCoeffs();
}


Foam::tmp<Foam::scalarField>
Foam::nearWallDepositTemperatureFvPatchScalarField::fromGas() const
{
    const scalarField& T = *this;
    return gasCoefficient()*(patchInternalField() - T);
}


Foam::tmp<Foam::scalarField>
Foam::nearWallDepositTemperatureFvPatchScalarField::fromRadiation() const
{
    if (given_.qr != "none")
    {
        return tmp<scalarField>(new scalarField(radiated()));
    }
    const scalarField& T = *this;
    const scalar sigma = constant::physicoChemical::sigma.value();
    return
        given_.emissivity*sigma*(pow4(given_.surroundingsTemperature) - pow4(T));
}


Foam::scalar
Foam::nearWallDepositTemperatureFvPatchScalarField::answersAfter() const
{
    const word name("radiationProperties");
    if (given_.qr == "none" || !db().foundObject<IOdictionary>(name)) return 0;

    const label steps =
        readOr<label>(db().lookupObject<IOdictionary>(name), "solverFreq", label(1));
    return steps*db().time().deltaTValue();
}


Foam::List<nw_wall_cooling>
Foam::nearWallDepositTemperatureFvPatchScalarField::heating() const
{
    const label patchi = patch().index();
    const scalarField beside(nearWall::conductivityBeside(thermo(), patchi));
    const scalarField here(nearWall::conductivityOf(thermo(), patchi));
    const scalarField conducted(gasCoefficient());
    const scalarField gas(patchInternalField());
    const scalarField& T = *this;
    const scalar sigma = constant::physicoChemical::sigma.value();
    List<nw_wall_cooling> found(size());
    forAll(found, i)
    {
        nw_wall_cooling& c = found[i];
        c = nearwall::make_wall_cooling();
        c.coolant_temperature = given_.Ta;
        c.wall_resistance = given_.resistance();
        c.gas_temperature = gas[i];
        c.gas_coefficient = conducted[i];
        c.emissivity = given_.emissivity;
        c.irradiation = sigma*pow4(given_.surroundingsTemperature);
        c.gas_conductivity = beside[i];
        c.void_temperature = gas[i];
        c.other_conductivity = here[i];
        c.other_temperature = T[i];
    }
    addVapour(found);
    if (given_.qr != "none")
    {
        const scalarField& qr = radiated();
        const scalarField& then = radiating_.size() == size() ? radiating_ : T;
        forAll(found, i)
        {
            // What a black surface takes from the model, which computed its
            // flux at an earlier temperature: it loses less as it cools
            nw_wall_cooling& c = found[i];
            c.emissivity = 1;
            c.irradiation = max(qr[i] + sigma*pow4(then[i]), scalar(0));
        }
    }
    return found;
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::addVapour
(
    List<nw_wall_cooling>& faces
) const
{
    if (given_.vapour != "none")
    {
        const scalarField vapour(vapourBeside());
        forAll(faces, i) faces[i].vapour_fraction = max(vapour[i], scalar(0));
    }
    if (given_.bulkTemperature <= 0) return;

    const scalarField& T = *this;
    forAll(faces, i)
    {
        // The heat flux from there, through the whole boundary layer
        nw_wall_cooling& c = faces[i];
        const scalar flux = c.gas_coefficient*(c.gas_temperature - T[i]);
        const scalar apart = max(given_.bulkTemperature - T[i], SMALL);
        c.vapour_coefficient = max(flux/apart, VSMALL);
    }
}


Foam::nearWallDepositTemperatureFvPatchScalarField::behindSurface
Foam::nearWallDepositTemperatureFvPatchScalarField::behind() const
{
    behindSurface found
    {
        scalarField(size(), given_.Ta),
        scalarField(size(), 1/given_.resistance()),
        scalarField(size(), Zero),
        scalarField(size(), Zero)
    };
    const nearWall::wallMemory* const deposits = memory();
    if (!deposits)
    {
        reportBare();
        return found;
    }

    const label patchi = patch().index();
    const List<nw_wall_cooling> faces(heating());
    found.landed = deposits->heatOfLanded().coefficient(patchi);
    found.given = deposits->heatOfLanded().given(patchi);
    forAll(faces, facei)
    {
        const nw_wall_heat heat(deposits->heat(patchi, facei, faces[facei]));
        found.temperature[facei] = heat.behind_temperature;
        found.conductance[facei] =
            1/max(heat.behind_resistance, leastResistance);
    }
    return found;
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::reportBare() const
{
    // The cloud is made after the temperature, and works from the first step on
    const Time& time = db().time();
    if (time.timeIndex() <= time.startTimeIndex() + 1 || isSaid_) return;

    isSaid_ = true;
    if (given_.cloud.empty())
    {
        Info<< "nearWallDepositTemperature, warning: no cloud with the key"
            << " 'memory' and a rule 'interact' leaves a deposit on patch "
            << patch().name() << "; the wall stays bare" << endl;
        return;
    }
    FatalErrorInFunction
        << "Patch '" << patch().name() << "' of " << internalField().name()
        << ", key 'cloud': '" << given_.cloud << "' leaves no deposit there."
        << nl << "    Clouds with the key 'memory': "
        << nearWall::wallMemory::clouds(db()) << nl
        << "    Name one of them that has the rule 'interact' for this patch,"
        << " or remove the key." << exit(FatalError);
}


const Foam::scalarField&
Foam::nearWallDepositTemperatureFvPatchScalarField::radiated() const
{
    if (!db().foundObject<volScalarField>(given_.qr))
    {
        FatalErrorInFunction
            << "Patch '" << patch().name() << "' of " << internalField().name()
            << ", key 'qr': there is no field '" << given_.qr << "'." << nl
            << "    The radiation models of OpenFOAM call theirs qr; without"
            << " such a model give 'emissivity' and 'surroundingsTemperature'."
            << exit(FatalError);
    }
    return
        db().lookupObject<volScalarField>(given_.qr)
       .boundaryField()[patch().index()];
}


Foam::tmp<Foam::scalarField>
Foam::nearWallDepositTemperatureFvPatchScalarField::vapourBeside() const
{
    if (!db().foundObject<volScalarField>(given_.vapour))
    {
        FatalErrorInFunction
            << "Patch '" << patch().name() << "' of " << internalField().name()
            << ", key 'vapour': there is no field '" << given_.vapour << "'." << nl
            << "    Give the name of the mass fraction of a species, or remove"
            << " the key: then it is that of the wall model." << exit(FatalError);
    }
    return
        db().lookupObject<volScalarField>(given_.vapour)
       .boundaryField()[patch().index()].patchInternalField();
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::noteRadiation
(
    const scalarField& qr
)
{
    if (radiating_.size() != size()) radiating_ = *this;
    if (radiated_.size() != size()) radiated_ = qr;
    forAll(qr, i)
    {
        if (qr[i] == radiated_[i]) continue;

        radiated_[i] = qr[i];
        radiating_[i] = (*this)[i];
    }
}


#if defined(OPENFOAM)
void Foam::nearWallDepositTemperatureFvPatchScalarField::autoMap
(
    const fvPatchFieldMapper& m
)
{
    mixedFvPatchScalarField::autoMap(m);
    if (radiating_.size()) radiating_.autoMap(m);
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::rmap
(
    const fvPatchScalarField& from,
    const labelList& addressing
)
{
    mixedFvPatchScalarField::rmap(from, addressing);
    const scalarField& radiating =
        refCast<const nearWallDepositTemperatureFvPatchScalarField>(from)
       .radiating_;
    if (radiating.empty()) return;

    if (radiating_.size() != size()) radiating_ = *this;
    radiating_.rmap(radiating, addressing);
}
#elif defined(NEARWALL_PATCH_FIELD_MAP)
void Foam::nearWallDepositTemperatureFvPatchScalarField::map
(
    const fvPatchScalarField& from,
    const fvPatchFieldMapper& m
)
{
    mixedFvPatchScalarField::map(from, m);
    const scalarField& radiating =
        refCast<const nearWallDepositTemperatureFvPatchScalarField>(from)
       .radiating_;
    if (radiating.empty()) return;

    if (radiating_.size() != size()) radiating_ = *this;
    m(radiating_, radiating);
}
#endif


void Foam::nearWallDepositTemperatureFvPatchScalarField::updateCoeffs()
{
    if (updated()) return;

    const scalarField& T = *this;
    const scalarField conducted(gasCoefficient());
    const bool hasModel = given_.qr != "none";
    scalarField qr(size(), Zero);
    if (hasModel)
    {
        qr = radiated();
        noteRadiation(qr);
    }
    const behindSurface inside(behind());
    const scalar sigma = constant::physicoChemical::sigma.value();
    const scalar around = given_.surroundingsTemperature;
    forAll(T, i)
    {
        // Heat leaves by `given` - `taken` T: to what is behind the surface,
        // and by radiation about the present temperature
        const scalar radiated =
            given_.emissivity*sigma*(sqr(T[i]) + sqr(around))
           *(T[i] + around);
        scalar taken = inside.conductance[i] + inside.landed[i] + radiated;
        scalar given =
            inside.temperature[i]*inside.conductance[i] + radiated*around
          + inside.given[i];
        // The radiation model computed its flux at an earlier temperature. So
        // that an insulated surface does not overshoot, it loses more by the
        // slope of a black one in P1; this term vanishes once the temperature
        // stays.
        if (hasModel)
        {
            const scalar slope = 8*sigma*pow3(radiating_[i]);
            taken += slope;
            given += qr[i] + slope*radiating_[i];
        }

        refValue()[i] = given/taken;
        valueFraction()[i] = taken/(taken + conducted[i]);
    }
    refGrad() = 0;
    valueFraction() = given_.relaxation*valueFraction() + (1 - given_.relaxation);
    refValue() = given_.relaxation*refValue() + (1 - given_.relaxation)*T;

    mixedFvPatchScalarField::updateCoeffs();
}


void Foam::nearWallDepositTemperatureFvPatchScalarField::write
(
    Ostream& os
) const
{
    mixedFvPatchScalarField::write(os);
    given_.write(os);
    if (radiating_.size()) nearWall::writePatchField(os, "radiating", radiating_);
}


namespace Foam
{
    makePatchTypeField
    (
        fvPatchScalarField,
        nearWallDepositTemperatureFvPatchScalarField
    );
}
