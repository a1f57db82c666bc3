// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallInteraction.H"
#include "buildCheck.H"
#include "dictionaryChecks.H"
#include "impactKey.H"
#include "nearWallPreEvolve.H"
#include "parcelTraits.H"

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
    nearWall::requireWritable(coeffs(), tableFolder());
    return coeffs();
}


template<class CloudType>
Foam::fileName Foam::nearWallInteraction<CloudType>::tableFolder() const
{
    const Time& time = mesh().time();
    return
        nearWall::caseFolder(time)/"postProcessing"/"nearWallInteraction"
       /this->owner().name()/nearWall::timeName(time);
}


template<class CloudType>
Foam::dictionary Foam::nearWallInteraction<CloudType>::saved
(
    const word& name
) const
{
    return this->properties().subOrEmptyDict(this->baseName())
        .subOrEmptyDict(this->modelType()).subOrEmptyDict(name);
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
Foam::scalar Foam::nearWallInteraction<CloudType>::injectedParcels() const
{
    scalar parcels = 0;
    forAll(this->owner().injectors(), i)
    {
        parcels += this->owner().injectors()[i].parcelsAddedTotal();
    }
    return parcels;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::makeMemory()
{
    if (!coeffs().found("memory")) return;

    if (!coeffs().isDict("memory"))
    {
        FatalIOErrorInFunction(coeffs())
            << "Key 'memory' must be a dictionary, as in" << nl
            << "    memory { film yes; }" << nl
            << "Without the key the walls remember nothing."
            << exit(FatalIOError);
    }
    if (this->owner().solution().steadyState())
    {
        FatalIOErrorInFunction(coeffs())
            << "Key 'memory': a steady cloud has no time in which a deposit"
            << " could grow; remove the key." << exit(FatalIOError);
    }
    run_->memory.reset
    (
        new nearWall::wallMemory
        (
            coeffs().subDict("memory"),
            mesh(),
            this->owner().name(),
            rules(),
            models_.ofCloud().model,
            this->owner().g().value(),
            nearWall::wallShear
            (
                this->owner().rho(), this->owner().U(), this->owner().mu()
            ),
            saved("memory"),
            tableFolder()
        )
    );
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::reportSetup() const
{
    models_.report(coeffs(), mesh().time());
    Info<< "    nearWallInteraction, patches:" << nl;
    forAll(rules(), patchi)
    {
        rules()[patchi].report(nearWall::patchesOf(mesh())[patchi].name());
    }
    Info<< "    nearWallInteraction: impacts have the density rho and the"
        << " diameter d of their parcel" << nl;
    Info<< endl;
    nearWall::report(stuck_, run_->deposit->name());
    if (!nearWall::hasTemperature(static_cast<const parcelType*>(nullptr)))
    {
        Info<< "    nearWallInteraction: parcels have no temperature, "
            << particleTemperature_ << " K is taken (particleTemperature)"
            << endl;
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
Foam::nearWallInteraction<CloudType>::runState::runState
(
    const nearWallInteraction& m
)
:
    totals(m.mesh(), m.rules(), m.saved("patches"), m.tableFolder()),
    distributions
    (
        m.mesh(),
        m.injectors_,
        m.saved("statistics"),
        m.tableFolder()
    ),
    recorder
    (
        m.coeffs(),
        m.mesh(),
        m.rules(),
        m.injectors_,
        m.models_.extraInputs(),
        m.saved("record"),
        m.tableFolder()
    ),
    stay(m.mesh(), m.rules(), m.saved("nearWallStay"), m.tableFolder()),
    density(m.models_.all().size()),
    balance
    (
        std::make_shared<massBalance>
        (
            m.saved("balance"), m.tableFolder(), m.injectedMass()
        )
    ),
    deposit(nearWall::depositCloud::read(m.mesh(), m.owner().name()))
{
    if (nearWall::readOr<Switch>(m.coeffs(), "writeFields", Switch(true)))
    {
        fields.reset
        (
            new nearWall::wallHitFields
            (
                m.mesh(), m.owner().name(), m.models_.erodes()
            )
        );
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::runState::begin(const bool isSteady)
{
    isSolving = true;
    recorder.reserveIdentities();
    if (!isSteady) return;

    deposit->clear();
    totals.clear();
    distributions.clear();
    if (fields) fields->clear();
}


template<class CloudType>
Foam::nearWallInteraction<CloudType>::nearWallInteraction
(
    const dictionary& dict,
    CloudType& owner
)
:
    PatchInteractionModel<CloudType>(dict, owner, typeName),
    injectors_(owner.injectors()),
    models_(checkedCoeffs(), mesh(), injectors_),
    stuck_(nearWall::readStuckTreatment(coeffs())),
    seed_(nearWall::readOr<label>(coeffs(), "seed", 1)),
    statisticsInterval_
    (
        nearWall::readChecked<label>
        (
            coeffs(), "statisticsInterval", 1,
            [](label n) { return n >= 1; }, "a number of steps, 1 or more"
        )
    ),
    particleTemperature_
    (
        nearWall::readOr<scalar>(coeffs(), "particleTemperature", 293.15)
    ),
    carbon_(nearWall::readOr<word>(coeffs(), "carbon", word("C"))),
    run_(std::make_shared<runState>(*this))
{
    if (nearWall::collides(static_cast<const fullCloudType*>(nullptr)))
    {
        nearWall::refuseWallSpring(owner.subModelProperties());
    }
    makeMemory();
    const std::shared_ptr<runState> run(run_);
    owner.functions().append
    (
        new nearWallPreEvolve<CloudType>
        (
            owner,
            run_->balance,
            run_->deposit,
            [run](const bool isSteady) { run->begin(isSteady); },
            coeffs()
        )
    );
    reportSetup();
}


// * * * * * * * * * * * * * * * One impact  * * * * * * * * * * * * * * * * //

template<class CloudType>
typename Foam::nearWallInteraction<CloudType>::relativeVelocity
Foam::nearWallInteraction<CloudType>::velocityTo
(
    const vector& U,
    const vector& normal,
    const vector& wall
)
{
    relativeVelocity v;
    v.normal = normal;
    v.wall = wall;

    const vector relative(U - v.wall);
    v.vn = relative & v.normal;
    const vector along(relative - v.vn*v.normal);
    v.vt = mag(along);
    v.along = along;
    v.tangent = v.vt > VSMALL ? vector(along/v.vt) : vector(Zero);
    return v;
}


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
typename Foam::nearWallInteraction<CloudType>::fullCloudType*
Foam::nearWallInteraction<CloudType>::solverCloud() const
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
    fullCloudType* const cloud = solverCloud();
    return cloud ? nearWall::carbonConversion(*cloud, p, carbon_) : 1;
}


template<class CloudType>
std::uint64_t Foam::nearWallInteraction<CloudType>::keyOf
(
    const parcelType& p
) const
{
    nearWall::impactKey key;
    key.addExact(mesh().time().timeIndex()).add(p.d());
    key.add(nearWall::positionOf(p, mesh()), mesh().bounds().mag());
    key.add(p.U(), mag(p.U()) + VSMALL);
    return key.value();
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
    e.impact.v_n = v.vn;
    e.impact.v_t = v.vt;
    e.impact.d = p.d();
    e.impact.rho_p = p.rho();
    e.impact.T_p = nearWall::temperature(p, particleTemperature_);
    e.impact.conversion = conversionOf(p);
    return e;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::meetWall
(
    impactEvent& e,
    const parcelType& p,
    const relativeVelocity& v
)
{
    const patchRule& rule = rules()[e.patch];
    const vector gas(this->owner().U()[p.cell()] - v.wall);
    e.impact.wall = rule.wall;
    e.impact.T_w =
        rule.temperatureFromField
      ? rule.temperatureOn(mesh(), e.patch)[e.face]
      : rule.temperature;
    e.impact.v_gas = mag(gas - (gas & v.normal)*v.normal);
    e.impact.omega = nearWall::spin(p, v.tangent ^ v.normal);
    e.impact.seed = seed_;
    e.impact.key = keyOf(p);
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
    run_->density.add(place, e);
    if (models_.isUnknown(e.injector)) ++run_->unknownInjector;
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
    meetWall(e, p, v);
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
        rebound(p, v, e, outcome.e_n, outcome.e_t, 1 - outcome.e_t);
        nearWall::addSpin
        (
            p, outcome.omega - e.impact.omega, v.tangent ^ v.normal
        );
    }
}


// * * * * * * * * * * * * * * Result of an impact * * * * * * * * * * * * * //

template<class CloudType>
void Foam::nearWallInteraction<CloudType>::record(const impactEvent& e)
{
    if (isTrial_) return;
    run_->totals.add(e);
    run_->distributions.add(e);
    run_->recorder.add(e);
    if (run_->fields) run_->fields->add(e);
    if (run_->memory && e.stuckByModel()) run_->memory->addCaptured(e);
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::setVelocity
(
    parcelType& p,
    const relativeVelocity& v,
    const scalar en,
    const scalar lost
)
{
    nearWall::setMoving(p, true);

    // In the order of localInteraction: the same constants give the same bits
    vector U(p.U() - v.wall);
    U -= (1.0 + en)*v.vn*v.normal;
    U -= lost*v.along;
    p.U() = U + v.wall;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::escape
(
    parcelType& p,
    impactEvent& e,
    bool& keepParticle
)
{
    e.result = impactEvent::escaped;
    if (!isTrial_)
    {
        run_->totals.add(e);
        run_->balance->add(massBalance::escaped, e.mass);
    }
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
        run_->balance->add(massBalance::stuckRemoved, e.mass);
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
    setVelocity(p, v, en, lost);
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
    ++run_->unusable;
    if (run_->unusableReason.empty())
    {
        run_->unusableReason = e.model->explain(e.impact);
    }
    e.result = impactEvent::unusable;

    // OpenFOAM cannot track or sum a speed or mass that is not a number
    keepParticle = std::isfinite(e.speed) && std::isfinite(e.mass);
    if (keepParticle)
    {
        run_->totals.add(e);
        setVelocity(p, v, 1, 0);
        return;
    }

    e.speed = 0;
    e.impact.v_n = 0;
    if (!std::isfinite(e.mass)) e.mass = 0;
    run_->totals.add(e);
    run_->balance->add(massBalance::unusableRemoved, e.mass);
    nearWall::setMoving(p, false);
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
    const patchRule& rule = rules()[pp.index()];
    const bool leaves = v.vn <= 0;

    // No impact: the parcel leaves the wall, for instance one that moves away
    if (rule.type == patchRule::interact && leaves) return;

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
    if (rules()[pp.index()].type == patchRule::pass) return false;

    vector normal;
    vector wall;
    this->owner().patchData(p, pp, normal, wall);
    const relativeVelocity v(velocityTo(p.U(), normal, wall));
    apply(p, pp, pp.whichFace(p.face()), v, keepParticle);
    return true;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::touch
(
    parcelType& p,
    const label patchi,
    const point& site,
    const vector& wall,
    bool& keepParticle
)
{
    if (!nearWall::isMoving(p) || rules()[patchi].type == patchRule::pass)
    {
        return;
    }
    const vector towards(site - nearWall::positionOf(p, mesh()));
    const vector normal(towards/(mag(towards) + VSMALL));
    const relativeVelocity v(velocityTo(p.U(), normal, wall));
    if (v.vn <= 0) return;

    const polyPatch& pp = nearWall::patchesOf(mesh())[patchi];
    const label facei = faceAt(pp, p.cell(), site);
    if (facei >= 0) apply(p, pp, facei, v, keepParticle);
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
Foam::nearWall::massBalance::content
Foam::nearWallInteraction<CloudType>::content() const
{
    massBalance::content now;
    for (const parcelType& p : this->owner())
    {
        const scalar mass = p.nParticle()*p.mass();
        (nearWall::isMoving(p) ? now.airborne : now.stuck) += mass;
    }
    now.stuck += run_->deposit->mass();
    return now;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::measureStay()
{
    const scalar duration = mesh().time().deltaTValue();
    run_->stay.beginStep(duration);
    for (const parcelType& p : this->owner())
    {
        if (!nearWall::isMoving(p)) continue;
        run_->stay.add(p.cell(), p.nParticle()*p.mass()*duration);
    }
}


template<class CloudType>
Foam::scalar Foam::nearWallInteraction<CloudType>::finishBalance
(
    Ostream& os,
    const bool writeRow
)
{

    massBalance& balance = *run_->balance;
    if (fullCloudType* const cloud = solverCloud())
    {
        const scalar mass = nearWall::reactedMass(*cloud, run_->meters);
        balance.add(massBalance::reacted, mass);
    }

    massBalance::content now;
    const scalarList totals(balance.totals(injectedMass(), content(), now));
    balance.report(os, totals, now);

    const Time& time = mesh().time();
    if (writeRow)
    {
        balance.writeRow(time.value(), totals, now, injectedParcels());
    }
    if (time.writeTime())
    {
        this->setModelProperty("balance", balance.saved(totals));
    }
    return totals[massBalance::injected];
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::finishUnusable(Ostream& os)
{
    const label n = nearWall::sumOfRanks(run_->unusable);
    run_->unusable = 0;
    if (n == 0) return;

    List<string> reasons(Pstream::nProcs());
    reasons[Pstream::myProcNo()] = run_->unusableReason;
    run_->unusableReason.clear();
    Pstream::gatherList(reasons);
    string reason;
    forAll(reasons, i)
    {
        if (reason.empty()) reason = reasons[i];
    }
    os  << "    nearWallInteraction: " << n << " impact" << (n == 1 ? "" : "s")
        << " of this step could not be decided (the first: " << reason.c_str()
        << "); the parcels rebound without loss, or are removed when"
        << " their speed or mass is not a number" << nl;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::finishUnknownInjectors(Ostream& os)
{
    if (models_.all().size() == 1) return;

    const label n = nearWall::sumOfRanks(run_->unknownInjector);
    run_->unknownInjector = 0;
    if (n == 0) return;

    os  << "    nearWallInteraction, warning: " << n << " impact"
        << (n == 1 ? "" : "s") << " of parcels without the number of an"
        << " injector (in the step of their injection OpenFOAM has not set it"
        << " yet); the cloud's model decided" << nl;
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::finishMemory
(
    Ostream& os,
    const bool writeRow
)
{
    if (!run_->memory) return;

    const Time& time = mesh().time();
    nearWall::wallMemory& memory = *run_->memory;
    memory.finishStep(time.deltaTValue());

    const List<scalarList> totals(memory.totals());
    memory.report(os, totals, time.value(), writeRow);
    if (time.writeTime())
    {
        this->setModelProperty("memory", memory.saved(totals));
    }
}


template<class CloudType>
void Foam::nearWallInteraction<CloudType>::info(NEARWALL_INFO_ARGUMENT)
{
    run_->isSolving = false;
    stopStuckParcels();
    run_->deposit->endStep();

    const Time& time = mesh().time();
    const bool writeRow =
        time.writeTime() || run_->calls % statisticsInterval_ == 0;
    ++run_->calls;

    const List<scalarList> totals(run_->totals.totals());
    run_->totals.report(NEARWALL_INFO_STREAM, totals);
    run_->density.report(NEARWALL_INFO_STREAM, models_);
    finishUnusable(NEARWALL_INFO_STREAM);
    finishUnknownInjectors(NEARWALL_INFO_STREAM);
    finishMemory(NEARWALL_INFO_STREAM, writeRow);

    // A steady cloud forgets its parcels after each iteration
    if (!this->owner().solution().steadyState())
    {
        measureStay();
        const scalar injected = finishBalance(NEARWALL_INFO_STREAM, writeRow);
        if (time.writeTime())
        {
            this->setModelProperty("nearWallStay", run_->stay.write(injected));
        }
    }

    if (writeRow) run_->totals.writeRows(time.value(), totals);
    if (!time.writeTime()) return;

    this->setModelProperty("patches", run_->totals.saved(totals));
    this->setModelProperty("statistics", run_->distributions.write());
    if (run_->recorder.on())
    {
        this->setModelProperty
        (
            "record", run_->recorder.write(NEARWALL_INFO_STREAM)
        );
    }
}
