// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "nearWallDispersion.H"
#include "buildCheck.H"
#include "dictionaryChecks.H"
#include "impactInputs.H"
#include "parcelOfMember.H"

template<class CloudType>
Foam::nearWallDispersion<CloudType>::nearWallDispersion
(
    const dictionary& dict,
    CloudType& owner
)
:
    DispersionRASModel<CloudType>(dict, owner),
    seed_
    (
        nearWall::readOr<label>
        (
            dict.subOrEmptyDict(typeName + "Coeffs"), "seed", 1
        )
    ),
    peakHeight_
    (
        nearWall::readOr<scalar>
        (
            dict.subOrEmptyDict(typeName + "Coeffs"), "peakHeight", -1
        )
    )
{
    nearWall::checkBuild();
    const dictionary coeffs(dict.subOrEmptyDict(typeName + "Coeffs"));
    nearWall::refuseUnknownKeys
    (
        coeffs, wordList({"seed", "peakHeight"}), typeName
    );
    if (coeffs.found("peakHeight") && !(peakHeight_ >= 0))
    {
        FatalIOErrorInFunction(coeffs)
            << "peakHeight: a height of at least 0 m, not " << peakHeight_
            << exit(FatalIOError);
    }
}


template<class CloudType>
Foam::nearWall::walkRecord Foam::nearWallDispersion<CloudType>::recordOf
(
    const parcelType& p,
    const point& place,
    const scalar tTurb
)
{
    if (nearWall::walkRecord::isIn(tTurb)) return nearWall::walkRecord::read(tTurb);

    std::uint64_t key =
        nearWall::keyOf(this->owner().mesh(), place, p.U(), p.d());
    while (!begun_.insert(key).second)
    {
        key = nearWall::impactKey::mix(key + 1);
    }
    return nearWall::walkRecord::start(key);
}


template<class CloudType>
void Foam::nearWallDispersion<CloudType>::warnOfLongSteps()
{
    if (isWarned_) return;
    const label all = nearWall::sumOfRanks(nSteps_);
    const label tooLong = nearWall::sumOfRanks(nLong_);
    nSteps_ = nLong_ = 0;
    if (20*tooLong <= all) return;

    isWarned_ = true;
    if (!Pstream::master()) return;
    WarningInFunction
        << "Cloud " << this->owner().name() << ": " << (100*tooLong)/all
        << " % of the parcels' steps are too long for the turbulence around"
        << " them: the parcels spread too far." << nl
        << "    Lower maxCo of the cloud, or the time step." << endl;
}


template<class CloudType>
void Foam::nearWallDispersion<CloudType>::cacheFields(const bool store)
{
    DispersionRASModel<CloudType>::cacheFields(store);
    const CloudType& owner = this->owner();
    if (!store)
    {
        warnOfLongSteps();
        return;
    }
    begun_.clear();
    if (!gas_) gas_ = std::make_shared<nearWall::gasTurbulence>(owner.mesh());
    gas_->read
    (
        *this->kPtr_, *this->epsilonPtr_, owner.rho(), owner.U(), owner.mu()
    );
}


template<class CloudType>
void Foam::nearWallDispersion<CloudType>::advance
(
    nw_walk& walk,
    const parcelType& p,
    const label celli
)
{
    if (nw_walk_advance(&walk) != NW_OK)
    {
        FatalErrorInFunction
            << "Cloud " << this->owner().name() << ", cell " << celli
            << ": the gas or a parcel is not a number, or negative: k "
            << (*this->kPtr_)[celli] << ", epsilon "
            << (*this->epsilonPtr_)[celli] << ", velocity "
            << vector(walk.flow[0], walk.flow[1], walk.flow[2])
            << ", diameter " << p.d() << "." << exit(FatalError);
    }
    ++nSteps_;
}


template<class CloudType>
Foam::vector Foam::nearWallDispersion<CloudType>::update
(
    const scalar dt,
    const label celli,
    const vector& U,
    const vector& Uc,
    vector& UTurb,
    scalar& tTurb
)
{
    const parcelType& p =
        nearWall::parcelOfMember<parcelType>::find(U, UTurb, tTurb);
    if (!nearWall::isMoving(p)) return Uc;

    const CloudType& owner = this->owner();
    const point place(nearWall::positionOf(p, owner.mesh()));
    nw_walk walk;
    nw_walk_init(&walk);
    if (!gas_->describe(walk, celli, place)) return Uc;

    if (peakHeight_ >= 0 && walk.friction_velocity > 0)
    {
        walk.wall_distance += 0.5*p.d() + peakHeight_;
    }
    nearWall::walkRecord record = recordOf(p, place, tTurb);
    walk.seed = seed_;
    walk.key = record.key;
    walk.step = record.step;
    // Parcels on faces take steps of no length, by rounding, of which ranks
    // differ: these must not use up draws
    const bool isStep = dt > 1e-6*owner.solution().trackTime();
    walk.duration = isStep ? dt : 0;
    walk.relaxation_time = p.rho()*sqr(p.d())/(18*owner.mu()[celli]);
    for (direction i = 0; i < 3; ++i)
    {
        walk.flow[i] = Uc[i];
        walk.values[i] = UTurb[i];
    }

    advance(walk, p, celli);
    if (dt > walk.longest_step) ++nLong_;

    if (isStep || record.step == 0) record.step = walk.step;
    tTurb = record.written();
    UTurb = vector(walk.values[0], walk.values[1], walk.values[2]);
    return Uc + vector(walk.velocity[0], walk.velocity[1], walk.velocity[2]);
}
