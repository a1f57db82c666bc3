// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "returningMass.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "surfaceFields.H"
#include "wallField.H"

namespace
{

using namespace Foam;
using namespace Foam::nearWall;

//- Names of the terms, in their order: keys of a restart and columns
const wordList names
({
    "left_kg", "returned_kg", "returned_parcels", "landed_kg", "landed_m3",
    "landed_m2", "landed_parcels"
});


//- Diameters and their shares in the mass, which add up to 1
List<Tuple2<scalar, scalar>> readSizes(const dictionary& dict)
{
    typedef List<Tuple2<scalar, scalar>> sizes;
    const sizes given(readOr<sizes>(dict, "sizes", sizes()));
    scalar sum = 0;
    bool sound = true;
    forAll(given, k)
    {
        sound = sound && given[k].first() > 0 && given[k].second() > 0;
        sum += given[k].second();
    }
    if (!sound || (given.size() && mag(sum - 1) > 1e-6))
    {
        FatalIOErrorInFunction(dict)
            << "Key 'sizes' must be a list of diameters [m] above 0 and their"
            << " shares in the mass, which add up to 1, as in" << nl
            << "    sizes ((2e-4 0.3) (1e-3 0.7));" << exit(FatalIOError);
    }
    return given;
}


bool readOn(const dictionary& dict)
{
    refuseUnknownKeys
    (
        dict, wordList({"parcels", "sizes", "parcelMass"}), "memory, shed"
    );
    return readOr<Switch>(dict, "parcels", Switch(false));
}

} // End anonymous namespace


Foam::nearWall::returningMass::returningMass
(
    const dictionary& dict,
    const fvMesh& mesh,
    const word& cloudName,
    const labelList& patches,
    const scalar acceleration,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    patches_(patches),
    acceleration_(acceleration),
    on_(readOn(dict)),
    sizes_(readSizes(dict)),
    parcelMass_
    (
        readChecked<scalar>
        (
            dict, "parcelMass", 0, [](scalar m) { return m >= 0; },
            "0, for that of what landed, or more"
        )
    ),
    waiting_(readWallField(mesh, cloudName + ":waitingMass", dimMass/dimArea)),
    sums_(mesh, patches, names, saved, folder, ".returned.dat"),
    parts_(patches.size()),
    savedParts_(saved.subOrEmptyDict("parts"))
{
    // Another run may go on with what waits
    if (!on_) setWriteOption(waiting_, IOobject::NO_WRITE);
}


void Foam::nearWall::returningMass::setNumberOfParts(const label n)
{
    wordList keys;
    for (const char* const key : {"landed_", "returned_"})
    {
        for (label k = 0; k < n; ++k) keys.append(word(key + Foam::name(k)));
    }
    forAll(parts_, i)
    {
        const word& patch = sums_[i].name();
        parts_[i] = runningTotals(keys, savedParts_.subOrEmptyDict(patch), patch);
    }
}


void Foam::nearWall::returningMass::addCaptured(const impactEvent& e)
{
    if (!on_) return;

    const scalar d = e.impact.d;
    const scalar area = e.particles*constant::mathematical::pi/4*sqr(d);
    forAll(patches_, i)
    {
        if (patches_[i] != e.patch) continue;

        sums_.add(i, landedMass, e.mass);
        sums_.add(i, landedVolume, area*2/3*d);
        sums_.add(i, landedArea, area);
        sums_.add(i, landed, 1);
        forAll(e.parts, k) parts_[i].add(k, e.mass*e.parts[k]);
    }
}


void Foam::nearWall::returningMass::addLost
(
    const label i,
    const label facei,
    const nw_deposit_losses& lost
)
{
    scalar mass = 0;
    for (label k = 0; k < NW_PROCESSES; ++k) mass += max(lost.mass[k], scalar(0));
    if (!on_ || mass <= 0) return;

    const label patchi = patches_[i];
    waiting_.boundaryFieldRef()[patchi][facei] += mass;
    sums_.add(i, left, mass*mesh_.magSf().boundaryField()[patchi][facei]);
}


Foam::scalarList Foam::nearWall::returningMass::partsOfLying
(
    const scalarList& totals,
    const scalarList& parts
) const
{
    // Less than rounding can tell: that of all that landed
    scalar mass = totals[landedMass] - totals[returned]/acceleration_;
    const bool anyLies = mass > 1e-6*totals[landedMass];
    if (!anyLies) mass = totals[landedMass];

    const label n = parts.size()/2;
    scalarList found(n);
    forAll(found, k) found[k] = (parts[k] - (anyLies ? parts[n + k] : 0))/mass;
    return found;
}


void Foam::nearWall::returningMass::formParcels
(
    const label i,
    const scalarList& totals,
    const scalarList& parts,
    std::vector<parcel>& found
)
{
    const label patchi = patches_[i];
    const scalarField& area = mesh_.magSf().boundaryField()[patchi];
    scalarField& waiting = waiting_.boundaryFieldRef()[patchi];
    const scalar density = totals[landedMass]/totals[landedVolume];
    const scalar sauter = 1.5*totals[landedVolume]/totals[landedArea];
    const scalar least =
        parcelMass_ > 0 ? parcelMass_ : totals[landedMass]/totals[landed];
    forAll(waiting, facei)
    {
        const scalar mass = waiting[facei]*area[facei];
        if (mass <= 0 || mass < acceleration_*least) continue;

        waiting[facei] = 0;
        sums_.add(i, returned, mass);
        const scalar flow = mass/acceleration_;
        forAll(parts, k) parts_[i].add(parts.size() + k, flow*parts[k]);
        if (sizes_.empty())
        {
            found.push_back({patchi, facei, sauter, density, flow, parts});
        }
        forAll(sizes_, k)
        {
            found.push_back
            (
                {
                    patchi, facei, sizes_[k].first(), density,
                    sizes_[k].second()*flow, parts
                }
            );
        }
        sums_.add(i, parcels, max(sizes_.size(), 1));
    }
}


std::vector<Foam::nearWall::returningMass::parcel>
Foam::nearWall::returningMass::take()
{
    std::vector<parcel> found;
    if (!on_) return found;

    const List<scalarList> totals(sums_.totals());
    const List<scalarList> parts(runningTotals::totals(parts_));
    forAll(patches_, i)
    {
        if (totals[i][landed] > 0)
        {
            formParcels
            (
                i, totals[i], partsOfLying(totals[i], parts[i]), found
            );
        }
        else if (totals[i][left] > 0 && !isSaid_)
        {
            isSaid_ = true;
            Info<< "    nearWallInteraction, warning: what leaves patch "
                << sums_[i].name() << " waits until a parcel has landed there:"
                << " its density is that of what lands" << nl;
        }
    }
    return found;
}


Foam::nearWall::tableRow Foam::nearWall::returningMass::row
(
    const label i,
    const scalarList& totals,
    const scalar waiting,
    const scalar time
) const
{
    const scalar out = totals[returned] + waiting;
    tableRow cells;
    cells.add("time_s", time);
    for (const label t : {left, returned, parcels}) cells.add(names[t], totals[t]);
    cells.add("waiting_kg", waiting);
    cells.add
    (
        "residual",
        totals[left] > 0 ? (totals[left] - out)/totals[left] : 0
    );
    return cells;
}


Foam::dictionary Foam::nearWall::returningMass::report
(
    Ostream& os,
    const scalar time,
    const bool writeRow
)
{
    if (!on_) return dictionary();

    scalarList waiting(patches_.size(), scalar(0));
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        waiting[i] = sum
        (
            mesh_.magSf().boundaryField()[patchi]
           *waiting_.boundaryField()[patchi]
        );
    }
    sumOverRanks(waiting);
    const List<scalarList> totals(sums_.totals());
    forAll(patches_, i)
    {
        if (totals[i][left] > 0)
        {
            os  << "        " << sums_[i].name() << ", left the wall: "
                << totals[i][left] << " kg, came back in "
                << totals[i][parcels] << " parcels: " << totals[i][returned]
                << " kg, waiting " << waiting[i] << " kg" << nl;
        }
        if (writeRow) sums_.table(i).write(row(i, totals[i], waiting[i], time));
    }
    dictionary saved(sums_.saved(totals));
    if (parts_.size() && parts_[0].base().size())
    {
        saved.add
        (
            "parts",
            runningTotals::saved(parts_, runningTotals::totals(parts_))
        );
    }
    return saved;
}
