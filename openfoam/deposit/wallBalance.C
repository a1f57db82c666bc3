// SPDX-FileCopyrightText: 2026 the nearwall authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wallBalance.H"
#include "surfaceFields.H"
#include "versionCompat.H"

namespace
{

using namespace Foam;

//- Rise of a surface's temperature in a step above which the log warns [K]
const scalar largestSoundRise = 5;

struct largerOf
{
    void operator()(scalar& x, const scalar y) const
    {
        x = max(x, y);
    }
};

} // End anonymous namespace


//- Sums and largest values over the faces of all patches and all ranks, in
//  one exchange each: a reduction for each number would cost the latency of
//  the network some twenty times a patch
struct Foam::nearWall::wallBalance::faceSums
{
    typedef depositFields fields;

    //- For each patch: area, mass of converted deposit, each field by area
    static const label perPatch = 2 + fields::nFields;

    List<scalar> sums;
    List<scalar> largest;

    //- `rise` is the largest one on this rank, kept behind the fields
    faceSums(const label nPatches, const scalar rise)
    :
        sums(nPatches*perPatch, Zero),
        largest(nPatches*fields::nFields + 1, Zero)
    {
        largest.last() = rise;
    }

    //- Known on the master
    scalar rise() const { return largest.last(); }

    void add
    (
        const label i,
        const label patchi,
        const scalarField& area,
        const fields& all
    )
    {
        scalar* const sum = &sums[i*perPatch];
        sum[0] = Foam::sum(area);
        sum[1] = Foam::sum
        (
            (
                all.on(fields::molten, patchi) + all.on(fields::frozen, patchi)
              + all.on(fields::powder, patchi)
            )
           *area*all.on(fields::conversion, patchi)
        );
        for (label f = 0; f < fields::nFields; ++f)
        {
            const fields::field which = fields::field(f);
            if (!fields::table()[f].column || !all.has(which)) continue;

            const scalarField& values = all.on(which, patchi);
            sum[2 + f] = Foam::sum(values*area);
            scalar& most = largest[i*fields::nFields + f];
            for (const scalar x : values) most = max(most, x);
        }
    }

    void overRanks()
    {
        sumOverRanks(sums);
        Pstream::listCombineGather(largest, largerOf());
    }

    scalar converted(const label i) const { return sums[i*perPatch + 1]; }

    scalar integral(const label i, const label f) const
    {
        return sums[i*perPatch + 2 + f];
    }

    scalar mean(const label i, const label f) const
    {
        return integral(i, f)/max(sums[i*perPatch], VSMALL);
    }

    scalar deposited(const label i) const
    {
        return
            integral(i, fields::molten) + integral(i, fields::frozen)
          + integral(i, fields::powder);
    }

    //- Append mean and largest value; the latter is known on the master, which
    //  writes
    void addTo(tableRow& row, const label i, const fields::field f) const
    {
        const std::string name(fields::table()[f].column);
        const std::string unit(fields::table()[f].unit);
        row.add(name + "_mean" + unit, mean(i, f));
        row.add(name + "_max" + unit, largest[i*fields::nFields + f]);
    }
};


Foam::nearWall::wallBalance::wallBalance
(
    const fvMesh& mesh,
    const labelList& patches,
    const depositFields& fields,
    const dictionary& saved,
    const fileName& folder
)
:
    mesh_(mesh),
    patches_(patches),
    names_
    ({
        "initial_kg", "arrived_kg", "drained_kg", "from_other_patches_kg"
    })
{
    for (const nearwall::process& process : nearwall::processes())
    {
        const bool gains = !process.gain.empty();
        losses_.push_back(gains ? process.gain : process.loss);
        signs_.push_back(gains ? -1 : 1);
        if (!losses_.back().empty()) names_.append(word(losses_.back() + "_kg"));
    }
    sums_ = patchSums(mesh, patches_, names_, saved, folder, ".wall.dat");
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        if (!saved.found(sums_[i].name()))
        {
            const scalarField& area = mesh.magSf().boundaryField()[patchi];
            const scalarField& molten = fields.on(depositFields::molten, patchi);
            const scalarField& frozen = fields.on(depositFields::frozen, patchi);
            const scalarField& powder = fields.on(depositFields::powder, patchi);
            add(i, initial, sum((molten + frozen + powder)*area));
        }
    }
}


void Foam::nearWall::wallBalance::addLosses
(
    const label i,
    const nw_deposit_losses& lost
)
{
    label t = nTerms;
    for (std::size_t process = 0; process < losses_.size(); ++process)
    {
        if (losses_[process].empty()) continue;

        add(i, t++, signs_[process]*lost.mass[process]);
    }
}


Foam::scalar Foam::nearWall::wallBalance::lost(const scalarList& totals) const
{
    scalar sum = 0;
    label t = nTerms;
    for (std::size_t process = 0; process < losses_.size(); ++process)
    {
        if (!losses_[process].empty()) sum += signs_[process]*totals[t++];
    }
    return sum;
}


void Foam::nearWall::wallBalance::reportPatch
(
    Ostream& os,
    const label i,
    const faceSums& faces,
    const scalarList& totals,
    const bool film
) const
{
    if (totals[initial] + totals[arrived] <= 0 && faces.deposited(i) <= 0) return;

    os  << "        " << sums_[i].name() << ", memory: molten "
        << faces.integral(i, depositFields::molten) << " kg, powder "
        << faces.integral(i, depositFields::powder) << " kg, coverage "
        << faces.mean(i, depositFields::coverage);
    const scalar frozen = faces.integral(i, depositFields::frozen);
    if (frozen > 0) os << ", frozen " << frozen << " kg";
    if (film) os << ", drained " << totals[drained] << " kg";
    label t = nTerms;
    for (const std::string& loss : losses_)
    {
        if (loss.empty()) continue;

        if (totals[t] > 0) os << ", " << loss.c_str() << ' ' << totals[t] << " kg";
        ++t;
    }
    os  << nl;
}


Foam::nearWall::tableRow Foam::nearWall::wallBalance::row
(
    const label i,
    const faceSums& faces,
    const scalarList& totals,
    const scalar time,
    const bool cooled
) const
{
    typedef depositFields fields;

    const scalar in = totals[initial] + totals[arrived];
    const scalar deposited = faces.deposited(i);
    const scalar gone = lost(totals);
    const scalar rest =
        in + totals[fromOthers] - totals[drained] - gone - deposited;
    const scalar all = max(in, max(in + totals[fromOthers], in - gone));

    tableRow cells;
    cells.add("time_s", time);
    for (label t = 0; t < nTerms; ++t) cells.add(names_[t], totals[t]);
    cells.add("molten_kg", faces.integral(i, fields::molten));
    cells.add("frozen_kg", faces.integral(i, fields::frozen));
    cells.add("powder_kg", faces.integral(i, fields::powder));
    cells.add("residual", all > 0 ? rest/all : 0);
    const fields::field ofDeposit[] =
    {
        fields::molten, fields::frozen, fields::powder, fields::layer,
        fields::coverage
    };
    for (const fields::field f : ofDeposit) faces.addTo(cells, i, f);
    cells.add("conversion_mean", deposited > 0 ? faces.converted(i)/deposited : 0);
    faces.addTo(cells, i, fields::temperature);
    for (label t = nTerms; t < names_.size(); ++t) cells.add(names_[t], totals[t]);
    if (cooled) faces.addTo(cells, i, fields::heatFlux);
    return cells;
}


void Foam::nearWall::wallBalance::reportRise(Ostream& os, const scalar rise)
{
    if (rise <= 2*saidRise_ || rise <= largestSoundRise) return;

    saidRise_ = rise;
    os  << "    nearWallInteraction, warning: the deposit grew so much in this"
        << " step that the surface of a face changes by some " << rise
        << " K; take shorter steps or less acceleration" << nl;
}


void Foam::nearWall::wallBalance::report
(
    Ostream& os,
    const depositFields& fields,
    const List<scalarList>& totals,
    const scalar rise,
    const boolList& cooled,
    const bool film,
    const scalar time,
    const bool writeRow
)
{
    faceSums faces(patches_.size(), rise);
    forAll(patches_, i)
    {
        const label patchi = patches_[i];
        faces.add(i, patchi, mesh_.magSf().boundaryField()[patchi], fields);
    }
    faces.overRanks();
    reportRise(os, faces.rise());

    forAll(patches_, i)
    {
        reportPatch(os, i, faces, totals[i], film);
        if (writeRow) sums_.table(i).write(row(i, faces, totals[i], time, cooled[i]));
    }
}
