// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "runState.H"
#include "dictionaryChecks.H"

#include <cmath>

Foam::label Foam::nearWall::toldImpacts::due
(
    const label inStep,
    const std::string& cause,
    const bool writes
)
{
    untold_ += inStep;
    const bool isNew = inStep > 0 && causes_.insert(cause).second;
    const label n = isNew || writes ? untold_ : 0;
    if (n > 0) untold_ = 0;
    return n;
}


Foam::nearWall::runState::runState(const statisticsSource& source)
:
    rewindable(source.mesh, source.cloudName),
    mesh_(source.mesh),
    setup_(source),
    statisticsInterval_
    (
        readChecked<label>
        (
            source.coeffs, "statisticsInterval", 1,
            [](label n) { return n >= 1; }, "a number of steps, 1 or more"
        )
    ),
    totals_(source),
    ranges_(source),
    distributions_(source),
    recorder_(source),
    density_(source.models),
    unknownInjector_(source.models.all().size() > 1 ? 0 : -1),
    balance(source),
    stay(source),
    film(source.mesh),
    deposit(depositCloud::read(source.mesh, source.cloudName))
{
    setup_.reportChanges(Info, source.savedAs("setup"));
    if (readOr<Switch>(source.coeffs, "writeFields", Switch(true)))
    {
        const bool erodes = source.models.erodes();
        fields_.reset(new wallHitFields(mesh_, source.cloudName, erodes));
    }
}


void Foam::nearWall::runState::makeMemory
(
    const statisticsSource& source,
    const bool isSteady,
    const vector& gravity,
    const wallShear& shear
)
{
    const dictionary& coeffs = source.coeffs;
    if (!coeffs.found("memory"))
    {
        if (source.savedAs("memory").empty()) return;

        Info<< "    nearWallInteraction, warning: the walls of the earlier run"
            << " remembered a deposit, and the key 'memory' is gone: impacts meet"
            << " bare walls, and the fields of the deposit are not written" << nl;
        return;
    }

    if (!coeffs.isDict("memory"))
    {
        FatalIOErrorInFunction(coeffs)
            << "Key 'memory' must be a dictionary, as in" << nl
            << "    memory { film yes; }" << nl
            << "Without the key the walls remember nothing."
            << exit(FatalIOError);
    }
    if (isSteady)
    {
        FatalIOErrorInFunction(coeffs)
            << "Key 'memory': a steady cloud has no time in which a deposit"
            << " could grow; remove the key." << exit(FatalIOError);
    }
    memory.reset
    (
        new wallMemory
        (
            coeffs.subDict("memory"), mesh_, source.cloudName, source.rules(),
            source.models.ofCloud().model, gravity, shear,
            source.savedAs("memory"), source.folder
        )
    );
}


void Foam::nearWall::runState::beginStep(const bool isSteady)
{
    isSolving = true;
    if (memory) memory->beginStep();
    recorder_.reserveIdentities();
    if (!isSteady) return;

    deposit->clear();
    totals_.clear();
    ranges_.clear();
    distributions_.clear();
    if (fields_) fields_->clear();
}


void Foam::nearWall::runState::addDecision
(
    const impactEvent& e,
    const label place,
    const bool isUnknown
)
{
    density_.add(place, e);
    unknownInjector_ += isUnknown;
}


void Foam::nearWall::runState::add(const impactEvent& e)
{
    totals_.add(e);
    ranges_.add(e);
    distributions_.add(e);
    recorder_.add(e);
    if (fields_) fields_->add(e);
    if (memory && e.stuckByModel()) memory->addCaptured(e);
    if (memory && e.contactHeat != 0) memory->addContactHeat(e);
}


void Foam::nearWall::runState::addEscaped(const impactEvent& e)
{
    totals_.add(e);
    balance.add(massBalance::escaped, e.mass);
}


bool Foam::nearWall::runState::addUnusable(impactEvent& e)
{
    ++unusable_;
    if (unusableReason_.empty()) unusableReason_ = e.model->explain(e.impact);
    e.result = impactEvent::unusable;

    const bool isFinite = std::isfinite(e.speed) && std::isfinite(e.mass);
    if (!isFinite)
    {
        e.speed = 0;
        e.impact.v_n = 0;
        if (!std::isfinite(e.mass)) e.mass = 0;
        balance.add(massBalance::unusableRemoved, e.mass);
    }
    totals_.add(e);
    return isFinite;
}


void Foam::nearWall::runState::finishUnusable(Ostream& os, const bool writes)
{
    const label n = sumOfRanks(unusable_);
    unusable_ = 0;
    string reason;
    if (n > 0)
    {
        List<string> reasons(Pstream::nProcs());
        reasons[Pstream::myProcNo()] = unusableReason_;
        unusableReason_.clear();
        Pstream::gatherList(reasons);
        forAll(reasons, i)
        {
            if (reason.empty()) reason = reasons[i];
        }
    }

    // One cause, whatever the value of an impact
    const std::string cause(reason.substr(0, reason.find(", asked for")));
    const label told = toldUnusable_.due(n, cause, writes);
    if (told == 0) return;

    os  << "    nearWallInteraction: " << told << " impact"
        << (told == 1 ? "" : "s") << " could not be decided";
    if (!reason.empty()) os << " (the first: " << reason.c_str() << ")";
    os  << "; the parcels rebound without loss, or are removed when"
        << " their speed or mass is not a number" << nl;
}


void Foam::nearWall::runState::finishUnknownInjectors
(
    Ostream& os,
    const bool writes
)
{
    if (unknownInjector_ < 0) return;

    const label n =
        toldUnknown_.due(sumOfRanks(unknownInjector_), "injector", writes);
    unknownInjector_ = 0;
    if (n == 0) return;

    os  << "    nearWallInteraction, warning: " << n << " impact"
        << (n == 1 ? "" : "s") << " of parcels without the number of an"
        << " injector (in the step of their injection OpenFOAM has not set it"
        << " yet); the cloud's model decided" << nl;
}


void Foam::nearWall::runState::finishCarried(Ostream& os)
{
    if (carried_ < 0 || sumOfRanks(carried_) == 0) return;

    carried_ = -1;
    os  << "    nearWallInteraction: parcels rest on walls or slide along them"
        << " from now on; such a contact is no impact, the wall carries them"
        << " without friction" << nl;
}


void Foam::nearWall::runState::finishMemory
(
    Ostream& os,
    const bool writeRow,
    dictionary& saved
)
{
    if (!memory) return;

    const Time& time = mesh_.time();
    const List<scalarList> totals(memory->totals());
    memory->report(os, totals, time.value(), writeRow);
    if (time.writeTime()) memory->reportThick(os);
    if (time.writeTime()) saved.add("memory", memory->saved(totals));
}


void Foam::nearWall::runState::finishBalance
(
    Ostream& os,
    const massBalance::content& content,
    const bool writeRow,
    dictionary& saved
)
{
    const massBalance::state now(balance.now(content));
    balance.report(os, now);
    if (writeRow) balance.writeRow(mesh_.time().value(), now);
    if (!mesh_.time().writeTime()) return;

    saved.add("balance", balance.saved(now));
    saved.add("nearWallStay", stay.write(now.totals[massBalance::injected]));
}


Foam::dictionary Foam::nearWall::runState::finishStep
(
    Ostream& os,
    const massBalance::content* content
)
{
    const bool writes = mesh_.time().writeTime();
    const bool isDue = steps_++ % statisticsInterval_ == 0;
    const bool writeRow = writes || isDue;
    dictionary saved;

    const List<scalarList> totals(totals_.totals());
    totals_.report(os, totals);
    density_.report(os);
    finishUnusable(os, writes);
    finishUnknownInjectors(os, writes);
    finishCarried(os);
    finishMemory(os, writeRow, saved);
    if (content) finishBalance(os, *content, writeRow, saved);
    if (writeRow) totals_.writeRows(mesh_.time().value(), totals);
    if (!writes) return saved;

    saved.add("setup", setup_.saved());
    saved.add("patches", totals_.saved(totals));
    saved.add("outsideRange", ranges_.write(os));
    saved.add("statistics", distributions_.write());
    if (recorder_.on()) saved.add("record", recorder_.write(os));
    return saved;
}


void Foam::nearWall::runState::archive(stateArchive& state)
{
    state(totals_);
    state(ranges_);
    state(distributions_);
    state(recorder_);
    if (fields_) state(*fields_);
    state(unusable_);
    state(toldUnusable_);
    state(unknownInjector_);
    state(toldUnknown_);
    state(carried_);
    state(steps_);
    state(balance);
    state(stay);
    state(*deposit);
    if (memory) state(*memory);
}
