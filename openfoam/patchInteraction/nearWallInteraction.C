// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallInteraction.H"
#include "buildCheck.H"
#include "dictionaryChecks.H"
#include "nearWallPreEvolve.H"
#include "parcelComposition.H"

// * * * * * * * * * * * * * * * * Set-up  * * * * * * * * * * * * * * * * * //

template<class CloudType>
const Foam::dictionary&
Foam::nearWallInteraction<CloudType>::checkedCoeffs() const
{
    nearWall::checkBuild();
    nearWall::refuseUnknownKeys
    (
        coeffs(),
        wordList
        ({
            "model", "patches", "stuck", "writeFields", "seed",
            "statisticsInterval", "particleTemperature", "carbon", "record",
            "memory", "injectors", "extraInputs"
        }),
        "nearWallInteraction"
    );
    nearWall::requireWritable
    (
        coeffs(), nearWall::tableFolder(mesh(), this->owner().name())
    );
    return coeffs();
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::makeRunState()
{
    const CloudType& cloud = this->owner();
    const nearWall::statisticsSource source
    {
        coeffs(),
        mesh(),
        cloud.name(),
        models_,
        this->properties().subOrEmptyDict(this->baseName())
            .subOrEmptyDict(this->modelType()),
        nearWall::tableFolder(mesh(), cloud.name()),
        injected().injected
    };
    run_ = std::make_shared<nearWall::runState>(source);
    run_->makeMemory
    (
        source,
        cloud.solution().steadyState(),
        cloud.g().value(),
        nearWall::wallShear(cloud.rho(), cloud.U(), cloud.mu())
    );
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::reportSetup() const
{
    models_.report(coeffs(), mesh().time());
    Info<< "    nearWallInteraction, patches:" << nl;
    forAll(nearWall::patchesOf(mesh()), patchi)
    {
        rule(patchi).report(nearWall::patchesOf(mesh())[patchi].name());
    }
    Info<< "    nearWallInteraction: impacts have the density rho and the"
        << " diameter d of their parcel" << nl << endl;
    nearWall::report(stuck_, run_->deposit->name());
    if (!nearWall::hasTemperature(static_cast<const parcelType*>(nullptr)))
    {
        Info<< "    nearWallInteraction: parcels have no temperature, "
            << particleTemperature_ << " K is taken (particleTemperature)"
            << endl;
        for (const auto& line : nearWall::wallModelLines(coeffs(), mesh().time()))
        {
            if (line.find("contact_heat") == std::string::npos) continue;

            Info<< "    nearWallInteraction, warning: the model's contact_heat is"
                << " left out" << endl;
            break;
        }
    }
    if
    (
        mesh().time().writeFormat() == IOstream::ASCII
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
    models_
    (
        checkedCoeffs(), mesh(), nearWall::injectorNames(owner.injectors())
    ),
    stuck_(nearWall::readStuckTreatment(coeffs())),
    seed_(nearWall::readOr<label>(coeffs(), "seed", 1)),
    particleTemperature_
    (
        nearWall::readOr<scalar>(coeffs(), "particleTemperature", 293.15)
    ),
    carbon_(nearWall::readOr<word>(coeffs(), "carbon", word("C"))),
    leavesHeat_
    (
        stuck_ != stuckTreatment::react
     && (
            nearWall::hasTemperature(static_cast<const parcelType*>(nullptr))
         || coeffs().found("particleTemperature")
        )
    )
{
    nearWall::warnOfCelsius(particleTemperature_, "particleTemperature");
    makeRunState();
    if (nearWall::collides(static_cast<const fullCloudType*>(nullptr)))
    {
        nearWall::refuseWallSpring(owner.subModelProperties());
        run_->expectContacts();
    }
    if (run_->memory && run_->memory->returnsParcels())
    {
        nearWall::checkReturning
        (
            coeffs(),
            nearWall::hasDrops(static_cast<const fullCloudType*>(nullptr)),
            stuck_ == stuckTreatment::remove,
            models_.all().size() == 1
        );
    }
    owner.functions().append
    (
        new nearWallPreEvolve<CloudType>(owner, run_, coeffs())
    );
    reportSetup();
}


// * * * * * * * * * * * * * * * One impact  * * * * * * * * * * * * * * * * //

template<class CloudType>
Foam::label Foam::nearWallInteraction<CloudType>::faceAt
(
    const polyPatch& pp,
    const label celli,
    const point& site
) const
{
    const scalar near = sqrt(SMALL)*mesh().bounds().mag();
    const auto isAt = [&](const label facei)
    {
        return
            pp[facei].nearestPoint(site, mesh().points()).distance() < near;
    };

    // Mostly a face of the parcel's cell or of a neighbour
    labelList cells(mesh().cellCells()[celli]);
    cells.append(celli);
    forAll(cells, i)
    {
        for (const label meshFace : mesh().cells()[cells[i]])
        {
            const label facei = meshFace - pp.start();
            if (facei >= 0 && facei < pp.size() && isAt(facei)) return facei;
        }
    }
    forAll(pp, facei)
    {
        if (isAt(facei)) return facei;
    }
    return -1;
}


template<class CloudType>
Foam::nearWall::impactEvent Foam::nearWallInteraction<CloudType>::eventOf
(
    const parcelType& p,
    const polyPatch& pp,
    const label facei,
    const relativeVelocity& v
) const
{
    impactEvent e;
    e.patch = pp.index();
    e.face = facei;
    e.injector = p.typeId();
    e.origProc = p.origProc();
    e.origId = p.origId();
    e.age = p.age();
    e.position = nearWall::positionOf(p, mesh());
    e.particles = p.nParticle();
    e.mass = p.nParticle()*p.mass();
    e.speed = sqrt(sqr(v.vn) + sqr(v.vt));
    e.bringsHeat = leavesHeat_;
    e.heatCapacity = nearWall::heatCapacity(p);
    const nearWall::impactSurroundings at
    {
        particleTemperature_,
        conversionOf(p),
        rule(e.patch).temperatureAt(mesh(), e.patch, facei),
        this->owner().U()[p.cell()]
    };
    nearWall::setInputs(e.impact, p, v, at);
    return e;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::chooseModel
(
    impactEvent& e,
    const parcelType& p
)
{
    e.impact.wall = rule(e.patch).wall;
    e.impact.seed = seed_;
    e.impact.key = nearWall::keyOf(mesh(), e.position, p.U(), p.d());
    if (run_->memory) run_->memory->applyDeposit(e);

    // The deposit is that of the cloud's model, whichever model decides
    const label place = models_.place(e.injector);
    const nearWall::parcelModels::entry& decides = models_.all()[place];
    e.model = decides.model.get();
    e.rule = &decides.rules[e.patch];
    e.impact.wall = e.rule->wall;
    for (std::size_t i = 0; i < e.rule->extraInputs.size(); ++i)
    {
        e.impact.extra[i] =
            e.rule->extraInputs[i].valueOn(mesh(), e.patch, e.face);
    }
    if (isTrial_) return;
    run_->addDecision(e, place, models_.isUnknown(e.injector));
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::interact
(
    parcelType& p,
    impactEvent& e,
    const relativeVelocity& v,
    bool& keepParticle
)
{
    chooseModel(e, p);
    nw_outcome outcome;
    nw_outcome_init(&outcome);

    if (e.model->resolve(e.impact, outcome) != NW_OK)
    {
        handleUnusable(p, v, e, keepParticle);
        return;
    }

    e.regime = min(label(outcome.regime), label(3));
    e.outsideRange = outcome.flags & NW_OUTSIDE_VALID_RANGE;
    if (models_.erodes()) e.model->erosion(e.impact, e.mass, e.eroded);
    if (outcome.stuck)
    {
        stick(p, e, keepParticle);
    }
    else
    {
        giveHeat(p, e);
        rebound(p, v, e, outcome.e_n, outcome.e_t, 1 - outcome.e_t);
        nearWall::addSpin(p, outcome.omega - e.impact.omega, v.axis());
    }
}


// * * * * * * * * * * * * * * Result of an impact * * * * * * * * * * * * * //

template<class CloudType>
void Foam::nearWallInteraction<CloudType>::escape
(
    parcelType& p,
    impactEvent& e,
    bool& keepParticle
)
{
    e.result = impactEvent::escaped;
    if (!isTrial_) run_->addEscaped(e);
    keepParticle = false;
    nearWall::setMoving(p, false);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::stick
(
    parcelType& p,
    impactEvent& e,
    bool& keepParticle
)
{
    e.result = impactEvent::stuck;
    if (run_->memory && run_->memory->returnsParcels())
    {
        e.parts = nearWall::compositionOf(p);
    }
    record(e);
    nearWall::setMoving(p, false);
    p.U() = Zero;
    keepParticle = isTrial_ || stuck_ == stuckTreatment::react;
    if (keepParticle) return;

    const bool isRemoved =
        stuck_ == stuckTreatment::remove
     || (stuck_ == stuckTreatment::slide && run_->memory->joinsFilm(e));
    if (isRemoved)
    {
        run_->balance.add(massBalance::stuckRemoved, e.mass);
    }
    else
    {
        addToDeposit(p, e.regime);
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::addToDeposit
(
    const parcelType& p,
    const label regime
)
{
    nearWall::capturedState state;
    state.d = p.d();
    state.nParticle = p.nParticle();
    state.mass = p.nParticle()*p.mass();
    state.T = nearWall::temperature(p, particleTemperature_);
    state.conversion = conversionOf(p);
    state.captureTime = mesh().time().value();
    state.regime = regime;
    state.typeId = p.typeId();
    run_->deposit->add(p, state);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::giveHeat
(
    parcelType& p,
    impactEvent& e
) const
{
    scalar heat = 0;
    const bool hasHeat = e.heatCapacity > 0 && !isTrial_;
    if (!hasHeat || e.model->contact_heat(e.impact, heat) != NW_OK) return;

    e.contactHeat = e.particles*heat;
    const scalar before = nearWall::temperature(p, particleTemperature_);
    nearWall::setTemperature(p, before - heat/(p.mass()*e.heatCapacity));
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::rebound
(
    parcelType& p,
    const relativeVelocity& v,
    impactEvent& e,
    const scalar en,
    const scalar et,
    const scalar lost
)
{
    e.result = impactEvent::rebounded;
    e.en = en;
    e.et = et;
    e.eg = sqrt(sqr(en*v.vn) + sqr(et*v.vt))/e.speed;
    record(e);
    nearWall::setMoving(p, true);
    p.U() = v.rebound(p.U(), en, lost);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::handleUnusable
(
    parcelType& p,
    const relativeVelocity& v,
    impactEvent& e,
    bool& keepParticle
)
{
    if (isTrial_)
    {
        keepParticle = false;
        return;
    }
    keepParticle = run_->addUnusable(e);
    nearWall::setMoving(p, keepParticle);
    if (keepParticle) p.U() = v.rebound(p.U(), 1, 0);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::apply
(
    parcelType& p,
    const polyPatch& pp,
    const label facei,
    const relativeVelocity& v,
    bool& keepParticle
)
{
    const patchRule& rule = this->rule(pp.index());
    const bool leaves = v.vn <= 0;

    // No impact: the parcel leaves the wall, for instance one that moves away,
    // or moves along it but for rounding
    if (rule.type == patchRule::interact && !v.approaches)
    {
        if (!leaves) p.U() = v.rebound(p.U(), 1, 0);
        return;
    }

    impactEvent e(eventOf(p, pp, facei, v));
    if (rule.type == patchRule::interact)
    {
        interact(p, e, v, keepParticle);
    }
    else if (rule.type == patchRule::escape)
    {
        escape(p, e, keepParticle);
    }
    else if (rule.type == patchRule::stick)
    {
        stick(p, e, keepParticle);
    }
    else if (!leaves)
    {
        rebound(p, v, e, rule.e, 1 - rule.mu, rule.mu);
    }
    else
    {
        // As localInteraction does with a parcel that drag has turned around
        p.U() -= rule.mu*v.along;
    }
}


template<class CloudType>
bool Foam::nearWallInteraction<CloudType>::correct
(
    parcelType& p,
    const polyPatch& pp,
    bool& keepParticle
)
{
    if (rule(pp.index()).type == patchRule::pass) return false;

    vector normal;
    vector wall;
    this->owner().patchData(p, pp, normal, wall);
    const relativeVelocity v(p.U(), normal, wall);
    apply(p, pp, pp.whichFace(p.face()), v, keepParticle);
    return true;
}


template<class CloudType>
bool Foam::nearWallInteraction<CloudType>::touch
(
    parcelType& p,
    const label patchi,
    const point& site,
    const relativeVelocity& v,
    const scalar fromForces,
    bool& keepParticle
)
{
    const patchRule::ruleType type = rule(patchi).type;
    if (!nearWall::isMoving(p) || type == patchRule::pass || !v.approaches)
    {
        return false;
    }
    const bool canRest =
        type == patchRule::interact || type == patchRule::rebound;
    if (canRest && v.vn <= fromForces)
    {
        p.U() -= v.vn*v.normal;
        run_->addCarried();
        return true;
    }
    const polyPatch& pp = nearWall::patchesOf(mesh())[patchi];
    const label facei = faceAt(pp, p.cell(), site);
    if (facei >= 0) apply(p, pp, facei, v, keepParticle);
    return false;
}


// * * * * * * * * * * * * * * * End of a step * * * * * * * * * * * * * * * //

template<class CloudType>
void Foam::nearWallInteraction<CloudType>::stopStuckParcels()
{
    CloudType& cloud = this->owner();
    for (parcelType& p : cloud)
    {
        if (nearWall::isMoving(p)) continue;

        p.U() = Zero;
        if (stuck_ == stuckTreatment::keep || stuck_ == stuckTreatment::slide)
        {
            addToDeposit(p, -1);
            cloud.deleteParticle(p);
        }
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::returnParcels()
{
    fullCloudType* const cloud = solverCloud();
    if (!run_->memory || !cloud) return;

    const fvMesh& mesh = this->mesh();
    const scalar step = mesh.time().deltaTValue();
    for (const auto& back : run_->memory->takeReturned())
    {
        const fvPatch& patch = mesh.boundary()[back.patch];
        const label celli = patch.faceCells()[back.face];

        // Inside of the cell, so far from the face that it does not touch it
        const point& face = patch.Cf()[back.face];
        const vector inwards(mesh.C()[celli] - face);
        const scalar part =
            max(scalar(0.01), 0.5*back.diameter/max(mag(inwards), VSMALL));
        const point at(face + min(part, scalar(1))*inwards);

        const auto& U = this->owner().U().boundaryField()[back.patch];
        parcelType* const p = nearWall::newParcel<parcelType>(mesh, at, celli);
        nearWall::initialise(*cloud, *p, step);
        p->U() = U.fixesValue() ? U[back.face] : vector(Zero);
        p->d() = back.diameter;
        p->rho() = back.density;
        p->nParticle() = back.mass/p->mass();
        nearWall::setTemperature
        (
            *p, run_->memory->surfaceTemperature(back.patch, back.face)
        );
        nearWall::complete(*cloud, *p, step);
        nearWall::setComposition(*p, back.parts);
        run_->balance.add(massBalance::stuckRemoved, -p->nParticle()*p->mass());
        cloud->addParticle(p);
    }
}


template<class CloudType>
Foam::nearWall::massBalance::content
Foam::nearWallInteraction<CloudType>::measure()
{
    const scalar duration = mesh().time().deltaTValue();
    massBalance::content content(injected());
    run_->stay.beginStep(duration);
    for (const parcelType& p : this->owner())
    {
        const scalar mass = p.nParticle()*p.mass();
        if (nearWall::isMoving(p))
        {
            content.airborne += mass;
            run_->stay.add(p.cell(), mass*duration);
        }
        else
        {
            content.stuck += mass;
        }
    }
    content.stuck += run_->deposit->mass();

    if (fullCloudType* const cloud = solverCloud())
    {
        const scalar mass = nearWall::reactedMass(*cloud, meters_);
        run_->balance.add(massBalance::reacted, mass);
    }
    return content;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::info(NEARWALL_INFO_ARGUMENT)
{
    run_->isSolving = false;
    run_->balance.add(massBalance::toFilm, run_->film.end());
    stopStuckParcels();
    run_->deposit->endStep();
    run_->finishWalls();
    returnParcels();

    // A steady cloud forgets its parcels after each iteration
    massBalance::content content;
    const bool isSteady = this->owner().solution().steadyState();
    if (!isSteady) content = measure();
    const dictionary saved
    (
        run_->finishStep(NEARWALL_INFO_STREAM, isSteady ? nullptr : &content)
    );
    forAllConstIter(dictionary, saved, iter)
    {
        this->setModelProperty((*iter).keyword(), (*iter).dict());
    }
}
