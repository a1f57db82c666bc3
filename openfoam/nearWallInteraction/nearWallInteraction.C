/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallInteraction.H.
\*---------------------------------------------------------------------------*/

#include "nearWallInteraction.H"
#include "nearWallBuild.H"

// * * * * * * * * * * * * * * * * Set-up  * * * * * * * * * * * * * * * * * //

template<class CloudType>
const Foam::dictionary& Foam::nearWallInteraction<CloudType>::checked
(
    const dictionary& coeffs
)
{
    nearWall::announceBuild(coeffs);
    nearWall::refuseUnknownKeys
    (
        coeffs,
        wordList
        ({
            "model", "patches", "stuck", "writeFields", "seed",
            "statisticsInterval", "particleTemperature", "carbon", "record"
        }),
        "nearWallInteraction"
    );
    return coeffs;
}


template<class CloudType>
bool Foam::nearWallInteraction<CloudType>::readStuck() const
{
    const dictionary& coeffs = nearWall::coefficients(*this, 0);
    const word stuck(nearWall::readOr<word>(coeffs, "stuck", word("keep")));
    if (stuck != "keep" && stuck != "remove")
    {
        FatalIOErrorInFunction(coeffs)
            << "key 'stuck' is '" << stuck << "', must be keep or remove"
            << exit(FatalIOError);
    }
    return stuck == "keep";
}


template<class CloudType>
Foam::label
Foam::nearWallInteraction<CloudType>::readStatisticsInterval() const
{
    const dictionary& coeffs = nearWall::coefficients(*this, 0);
    const label steps =
        nearWall::readOr<label>(coeffs, "statisticsInterval", 1);
    if (steps < 1)
    {
        FatalIOErrorInFunction(coeffs)
            << "key 'statisticsInterval' is " << steps
            << ", must be a number of steps, 1 or more" << exit(FatalIOError);
    }
    return steps;
}


template<class CloudType>
Foam::fileName Foam::nearWallInteraction<CloudType>::tableFolder() const
{
    const Time& time = this->owner().mesh().time();
    return
        nearWall::caseFolder(time)/"postProcessing"/"nearWallInteraction"
       /this->owner().name()/time.timeName();
}


template<class CloudType>
Foam::dictionary Foam::nearWallInteraction<CloudType>::saved
(
    const word& what
) const
{
    dictionary dict;
    this->getModelDict(what, dict);
    return dict;
}


template<class CloudType>
Foam::scalar Foam::nearWallInteraction<CloudType>::injectedMass() const
{
    scalar mass = 0;
    forAll(this->owner().injectors(), i)
    {
        mass += this->owner().injectors()[i].massInjected();
    }
    return mass;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::warnAboutRounding() const
{
    const Time& time = this->owner().mesh().time();
    if
    (
        time.writeFormat() == IOstream::ASCII
     && IOstream::defaultPrecision() < 15
    )
    {
        Info<< "    nearWallInteraction: parcels are written with "
            << label(IOstream::defaultPrecision())
            << " digits; after a restart the balance will show the rounding"
            << " as 'read back'" << nl
            << "        (writeFormat binary; in controlDict avoids it)" << endl;
    }
}


template<class CloudType>
Foam::nearWallInteraction<CloudType>::nearWallInteraction
(
    const dictionary& dict,
    CloudType& owner
)
:
    PatchInteractionModel<CloudType>(dict, owner, typeName),
    law_
    (
        nearWall::loadLaw
        (
            checked(nearWall::coefficients(*this, 0)),
            owner.mesh().time()
        )
    ),
    rules_
    (
        nearWall::readPatchRules
        (
            nearWall::coefficients(*this, 0),
            owner.mesh(),
            *law_
        )
    ),
    keepStuck_(readStuck()),
    seed_
    (
        nearWall::readOr<label>(nearWall::coefficients(*this, 0), "seed", 1)
    ),
    statisticsInterval_(readStatisticsInterval()),
    isothermal_
    (
        nearWall::readOr<scalar>
        (
            nearWall::coefficients(*this, 0), "particleTemperature", 293.15
        )
    ),
    carbon_
    (
        nearWall::readOr<word>
        (
            nearWall::coefficients(*this, 0), "carbon", word("C")
        )
    ),
    record_
    (
        std::make_shared<record>
        (
            owner.mesh(), rules_, saved("patches"), tableFolder()
        )
    )
{
    const dictionary& coeffs = nearWall::coefficients(*this, 0);
    if (nearWall::readOr<Switch>(coeffs, "writeFields", Switch(true)))
    {
        record_->fields.reset
        (
            new nearWall::wallFields(owner.mesh(), owner.name())
        );
    }

    const nearWall::injectorNames injectors(owner.injectors());
    record_->statistics.reset
    (
        new nearWall::statistics
        (
            owner.mesh(), injectors, saved("statistics"), tableFolder()
        )
    );
    record_->recorder.reset
    (
        new nearWall::recorder
        (
            coeffs, owner.mesh(), rules_, injectors, saved("record"),
            tableFolder()
        )
    );

    record_->balance = std::make_shared<nearWall::balance>
    (
        saved("balance"), tableFolder(), injectedMass()
    );
    owner.functions().append
    (
        new nearWallStart<CloudType>(owner, record_->balance, coeffs)
    );

    warnAboutRounding();
    Info<< "    nearWallInteraction, model: "
        << nearWall::lawOrigin(coeffs, owner.mesh().time()).c_str() << nl;
    nearWall::reportPatchRules(rules_, owner.mesh());
    if (!nearWall::hasTemperature<parcelType>(0))
    {
        Info<< "    nearWallInteraction: parcels have no temperature, "
            << isothermal_ << " K is taken (particleTemperature)" << endl;
    }
}


template<class CloudType>
Foam::nearWallInteraction<CloudType>::nearWallInteraction
(
    const nearWallInteraction<CloudType>& model
)
:
    PatchInteractionModel<CloudType>(model),
    law_(model.law_),
    rules_(model.rules_),
    keepStuck_(model.keepStuck_),
    seed_(model.seed_),
    statisticsInterval_(model.statisticsInterval_),
    isothermal_(model.isothermal_),
    carbon_(model.carbon_),
    record_(model.record_)
{}


// * * * * * * * * * * * * * * * One impact  * * * * * * * * * * * * * * * * //

template<class CloudType>
typename Foam::nearWallInteraction<CloudType>::approach
Foam::nearWallInteraction<CloudType>::approachOf
(
    const parcelType& p,
    const polyPatch& pp
) const
{
    approach a;
    this->owner().patchData(p, pp, a.normal, a.wall);

    const vector relative(p.U() - a.wall);
    a.vn = relative & a.normal;
    const vector along(relative - a.vn*a.normal);
    a.vt = mag(along);
    a.tangent = a.vt > VSMALL ? vector(along/a.vt) : vector(Zero);
    return a;
}


template<class CloudType>
typename Foam::nearWallInteraction<CloudType>::fullCloudType*
Foam::nearWallInteraction<CloudType>::full() const
{
    return dynamic_cast<fullCloudType*>
    (
        &const_cast<CloudType&>(this->owner())
    );
}


template<class CloudType>
Foam::scalar Foam::nearWallInteraction<CloudType>::conversionOf
(
    const parcelType& p
) const
{
    fullCloudType* const cloud = full();
    return cloud ? nearWall::conversion(*cloud, p, carbon_, 0) : 1;
}


template<class CloudType>
Foam::nearWall::event Foam::nearWallInteraction<CloudType>::eventOf
(
    const parcelType& p,
    const polyPatch& pp,
    const approach& a
) const
{
    nearWall::event e;
    e.patch = pp.index();
    e.face = pp.whichFace(p.face());
    e.injector = p.typeId();
    e.position = p.position();
    e.particles = p.nParticle();
    e.mass = p.nParticle()*p.mass();
    e.speed = sqrt(sqr(a.vn) + sqr(a.vt));
    e.arrived.v_n = a.vn;
    e.arrived.v_t = a.vt;
    e.arrived.d = p.d();
    e.arrived.T_p = nearWall::temperature(p, isothermal_, 0);
    e.arrived.conversion = conversionOf(p);
    return e;
}


template<class CloudType>
Foam::scalar Foam::nearWallInteraction<CloudType>::wallTemperature
(
    const parcelType& p,
    const polyPatch& pp,
    const nearWall::patchRule& rule
) const
{
    if (!rule.temperatureFromField)
    {
        return rule.temperature;
    }
    const volScalarField& T =
        this->owner().mesh().template lookupObject<volScalarField>
        (
            rule.temperatureField
        );
    return T.boundaryField()[pp.index()][pp.whichFace(p.face())];
}


template<class CloudType>
std::uint64_t Foam::nearWallInteraction<CloudType>::keyOf
(
    const parcelType& p,
    const approach& a
) const
{
    const fvMesh& mesh = this->owner().mesh();
    nearWall::impactKey key;
    key << mesh.time().value() << a.vn << p.d();
    key.add(p.position(), mesh.bounds().mag());
    key.add(p.U(), mag(p.U()) + VSMALL);
    return key.value();
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::completeImpact
(
    nw_impact& impact,
    const parcelType& p,
    const polyPatch& pp,
    const nearWall::patchRule& rule,
    const approach& a
) const
{
    const vector gas(this->owner().U()[p.cell()] - a.wall);

    impact.wall = rule.wall;
    impact.T_w = wallTemperature(p, pp, rule);
    impact.v_gas = mag(gas - (gas & a.normal)*a.normal);
    impact.omega = nearWall::forwardSpin(p, a.tangent, a.normal, 0);
    impact.seed = seed_;
    impact.key = keyOf(p, a);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::interact
(
    parcelType& p,
    const polyPatch& pp,
    const nearWall::patchRule& rule,
    bool& keepParticle
)
{
    const approach a(approachOf(p, pp));

    // Leaving the wall already, as on a wall that moves away: no impact
    if (a.vn <= 0) return;

    nearWall::event e(eventOf(p, pp, a));
    completeImpact(e.arrived, p, pp, rule, a);
    nw_outcome outcome;
    nw_outcome_init(&outcome);

    const nw_status status = law_->resolve(e.arrived, outcome);
    if (status != NW_OK)
    {
        refuse(p, a, e, status, keepParticle);
        return;
    }

    e.regime = min(label(outcome.regime), label(3));
    e.outsideRange = outcome.flags & NW_OUTSIDE_VALID_RANGE;
    if (outcome.stuck)
    {
        stick(p, e, keepParticle);
    }
    else
    {
        rebound(p, a, e, outcome.e_n, outcome.e_t);
        nearWall::addForwardSpin
        (
            p, outcome.omega - e.arrived.omega, a.tangent, a.normal, 0
        );
    }
}


// * * * * * * * * * * * * What becomes of the parcel  * * * * * * * * * * * //

template<class CloudType>
void Foam::nearWallInteraction<CloudType>::note(const nearWall::event& e)
{
    if (e.stuck)
    {
        record_->tally.addStick(e);
    }
    else
    {
        record_->tally.addRebound(e);
    }
    record_->statistics->add(e);
    record_->recorder->add(e);
    if (record_->fields)
    {
        record_->fields->addHit(e.patch, e.face, e.speed);
        if (e.stuck) record_->fields->addDeposit(e.patch, e.face, e.mass);
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::bounce
(
    parcelType& p,
    const approach& a,
    const scalar en,
    const scalar et
)
{
    nearWall::setMoving(p, true, 0);
    p.U() = a.wall + et*a.vt*a.tangent - en*a.vn*a.normal;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::escape
(
    parcelType& p,
    const polyPatch& pp,
    bool& keepParticle
)
{
    const nearWall::event e(eventOf(p, pp, approachOf(p, pp)));
    record_->tally.addEscape(e);
    record_->balance->add(nearWall::balance::escaped, e.mass);
    keepParticle = false;
    nearWall::setMoving(p, false, 0);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::stick
(
    parcelType& p,
    nearWall::event& e,
    bool& keepParticle
)
{
    e.stuck = true;
    note(e);
    nearWall::setMoving(p, false, 0);
    p.U() = Zero;
    keepParticle = keepStuck_;
    if (!keepStuck_)
    {
        record_->balance->add(nearWall::balance::stuckRemoved, e.mass);
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::rebound
(
    parcelType& p,
    const approach& a,
    nearWall::event& e,
    const scalar en,
    const scalar et
)
{
    e.en = en;
    e.et = et;
    e.eg = sqrt(sqr(en*a.vn) + sqr(et*a.vt))/e.speed;
    note(e);
    bounce(p, a, en, et);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::refuse
(
    parcelType& p,
    const approach& a,
    nearWall::event& e,
    const nw_status why,
    bool& keepParticle
)
{
    ++record_->unusable.count;
    record_->unusable.why = why;

    // Bounce without loss as long as that makes sense: the mass stays airborne
    if (std::isfinite(e.speed) && std::isfinite(e.mass))
    {
        record_->tally.addUnusable(e);
        bounce(p, a, 1, 1);
        keepParticle = true;
        return;
    }

    // A speed or mass that is no number cannot be tracked or summed
    e.speed = 0;
    e.arrived.v_n = 0;
    if (!std::isfinite(e.mass)) e.mass = 0;
    record_->tally.addUnusable(e);
    record_->balance->add(nearWall::balance::unusableRemoved, e.mass);
    nearWall::setMoving(p, false, 0);
    keepParticle = false;
}


template<class CloudType>
bool Foam::nearWallInteraction<CloudType>::correct
(
    parcelType& p,
    const polyPatch& pp,
    bool& keepParticle
)
{
    const nearWall::patchRule& rule = rules_[pp.index()];
    switch (rule.what)
    {
        case nearWall::fate::pass:
            return false;

        case nearWall::fate::interact:
            interact(p, pp, rule, keepParticle);
            break;

        case nearWall::fate::escape:
            escape(p, pp, keepParticle);
            break;

        case nearWall::fate::stick:
        {
            nearWall::event e(eventOf(p, pp, approachOf(p, pp)));
            stick(p, e, keepParticle);
            break;
        }

        case nearWall::fate::rebound:
        {
            const approach a(approachOf(p, pp));
            if (a.vn > 0)
            {
                nearWall::event e(eventOf(p, pp, a));
                rebound(p, a, e, rule.e, 1 - rule.mu);
            }
            break;
        }
    }
    return true;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::stopStuckParcels()
{
    for (parcelType& p : this->owner())
    {
        if (!nearWall::isMoving(p, 0))
        {
            p.U() = Zero;
        }
    }
}


template<class CloudType>
Foam::nearWall::balance::content
Foam::nearWallInteraction<CloudType>::content() const
{
    nearWall::balance::content now;
    for (const parcelType& p : this->owner())
    {
        const scalar mass = p.nParticle()*p.mass();
        (nearWall::isMoving(p, 0) ? now.airborne : now.stuck) += mass;
    }
    return now;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::reportBalance
(
    Ostream& os,
    const bool writeRow
)
{
    // A steady cloud forgets its parcels after each iteration
    if (this->owner().solution().steadyState()) return;

    nearWall::balance& balance = *record_->balance;
    if (fullCloudType* const cloud = full())
    {
        balance.add
        (
            nearWall::balance::reacted,
            nearWall::reactedMass(*cloud, record_->meters)
        );
    }

    nearWall::balance::content now;
    const scalarList totals(balance.totals(injectedMass(), content(), now));
    balance.report(os, totals, now);

    const Time& time = this->owner().mesh().time();
    if (writeRow)
    {
        balance.writeRow(time.value(), totals, now);
    }
    if (time.writeTime())
    {
        this->setModelProperty("balance", balance.saved(totals));
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::reportUnusable(Ostream& os)
{
    nearWall::unusableNote& note = record_->unusable;
    const label n = returnReduce(note.count, sumOp<label>());
    const label why = returnReduce(note.why, maxOp<label>());
    note = nearWall::unusableNote();

    if (n)
    {
        os  << "    nearWallInteraction: " << n << " impact"
            << (n == 1 ? "" : "s") << " of this step could not be decided ("
            << nw_status_text(nw_status(why))
            << "); the parcels rebound without loss, or are removed when"
            << " their speed or mass is not a number" << nl;
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::info(NEARWALL_INFO_ARGUMENT)
{
    stopStuckParcels();

    const Time& time = this->owner().mesh().time();
    const bool writeRow =
        time.writeTime() || record_->calls % statisticsInterval_ == 0;
    ++record_->calls;

    const List<scalarList> totals(record_->tally.totals());
    record_->tally.report(NEARWALL_INFO_STREAM, totals);
    reportUnusable(NEARWALL_INFO_STREAM);
    reportBalance(NEARWALL_INFO_STREAM, writeRow);

    if (writeRow)
    {
        record_->tally.writeRows(time.value(), totals);
    }
    if (time.writeTime())
    {
        this->setModelProperty("patches", record_->tally.saved(totals));
        this->setModelProperty("statistics", record_->statistics->write());
        if (record_->recorder->on())
        {
            this->setModelProperty
            (
                "record",
                record_->recorder->write(NEARWALL_INFO_STREAM)
            );
        }
    }
}
