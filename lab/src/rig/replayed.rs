//! OpenFOAM's recorded impacts as the forward model of a rig.
//!
//! The run's own model, the base, let each parcel go on or caught it; the record holds the impacts
//! up to the capture. A changed law decides the same impacts again. With the probabilities of
//! capture `b_j` of the base and `p_j` of the changed law, the share of a parcel that arrives at
//! its impact `i` under the changed law is
//!
//! `share_i = prod_{j<i} (1 - p_j)/(1 - b_j)`,
//!
//! since the record holds that impact only with the probability `prod_{j<i} (1 - b_j)`. The sums
//! over `share_i p_i` have the expectation of a run with the changed law, if only capture changes.
//! Two limits, which [`ReplayAccount`] states:
//! - Where the base holds a parcel with (almost) certainty, the record says nothing about what
//!   follows. What the changed law lets go there is *without a record*.
//! - If a rebound changes, later impacts are an approximation. Between flat parallel walls the
//!   flight begins again with the new rebound ([`RecordedFlight`]): the next impact has other
//!   speeds and another place, or is missed. Elsewhere later impacts stay as recorded. The relative
//!   change of the rebound velocity, of a flight begun again a quarter of its square, is the share
//!   of what follows that is doubtful; it adds to the variance of the prediction
//!   ([`Tally::set_doubt`]).

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use nalgebra::Vector3;

use super::recorded_flight::{FlatWall, RecordedContact, RecordedFlight};
use super::recording::{Parcel, Recording, ReplayAccount, ReplayedImpact};
use super::replay_error::ReplayError;
use super::tally::{PredictedReading, Tally};
use super::{Forward, ModelChange, PredictionError};
use crate::dataset::{Experiment, RigMeasurements, RigQuantity, RigReading};
use crate::results::openfoam::impact_history;
use nearwall::effect::CurveInput;
use nearwall::model::Model;

/// Recorded impacts of all experiments, decided again for each law.
#[derive(Debug)]
pub struct ReplayedRig {
    base: Model,
    runs: Vec<Recording>,
    experiments: Vec<Experiment>,
    notes: Vec<String>,
}

impl ReplayedRig {
    /// Reads the records of all experiments below `folder`, of cases that were run with the model `base`.
    ///
    /// # Errors
    /// [`ReplayError`] of the first experiment that has one.
    pub fn new(folder: &Path, data: &RigMeasurements, base: &Model) -> Result<Self, ReplayError> {
        let mut notes = Vec::new();
        let mut runs = Vec::new();
        let mut unrecorded: Vec<Vec<String>> = Vec::new();
        for (number, experiment) in data.experiments.iter().enumerate() {
            let place = format!("{}:{}: experiment `{}`", data.file, experiment.line, experiment.name);
            let case = case_of(folder, experiment, data.experiments.len(), &place)?;
            let history = impact_history::read(&case, None, base.extra_inputs())?;
            history.check_complete()?;
            let run = Recording::new(&history, base, number as u64)?;
            run.check(&history, base)?;
            unrecorded.push(history.unrecorded.iter().map(|(patch, _)| patch.clone()).collect());
            if history.unusable > 0 {
                notes.push(format!(
                    "{}: the run's model refused {} impacts, which are not on record.",
                    history.file.display(),
                    history.unusable
                ));
            }
            runs.push(run.thinned(&mut notes));
        }
        check_patches(data, &runs, &unrecorded)?;
        let mut replayed = Self { base: base.clone(), runs, experiments: data.experiments.clone(), notes };
        replayed.find_axes();
        replayed.find_flights();
        Ok(replayed)
    }

    /// What was assumed about the records.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// How well the record of an experiment answers for a model.
    ///
    /// # Errors
    /// Why the model cannot decide an impact.
    pub fn account(&self, experiment: usize, model: &Model) -> Result<ReplayAccount, PredictionError> {
        self.runs[experiment].replay(model, |_, _| {}, |_| {})
    }

    /// The same in sentences, over all experiments.
    ///
    /// # Errors
    /// Why the model cannot decide an impact.
    pub fn account_notes(&self, model: &Model) -> Result<Vec<String>, PredictionError> {
        let accounts =
            (0..self.runs.len()).map(|number| self.account(number, model)).collect::<Result<Vec<_>, _>>()?;
        let largest = |of: &dyn Fn(&ReplayAccount) -> f64| {
            let all = accounts.iter().map(of).zip(&self.experiments);
            let (share, experiment) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
            Some((100.0 * share, experiment.name.clone()))
        };
        let mut notes = Vec::new();
        if let Some((percent, name)) =
            largest(&|one| one.without_record).filter(|(percent, _)| *percent >= 0.1)
        {
            notes.push(format!(
                "Without a record: the extended model lets up to {percent:.1} % of the injected mass (experiment \
                    `{name}`) go where the run caught it. Later impacts of it are unknown and counted as not caught; \
                    run the cases with extended.toml, and diagnose again with that record."
            ));
        }
        let later = |one: &ReplayAccount| if one.caught > 0.0 { one.caught_later / one.caught } else { 0.0 };
        if let Some((percent, name)) = largest(&later).filter(|(percent, _)| *percent >= 0.1) {
            let of = |one: &ReplayAccount| if one.caught > 0.0 { one.doubtful / one.caught } else { 0.0 };
            let (doubtful, other) = largest(&of).unwrap_or_default();
            notes.push(format!(
                "Up to {percent:.1} % of the caught mass (experiment `{name}`) is caught at a second or later impact: \
                    exact for a change of capture, approximate for a change of rebounds, which makes up to \
                    {doubtful:.1} % of the caught mass doubtful (experiment `{other}`)."
            ));
        }
        if let Some((percent, name)) = largest(&|one| one.led_away).filter(|(percent, _)| *percent >= 0.1) {
            notes.push(format!(
                "Changed rebounds lead up to {percent:.1} % of the injected mass (experiment `{name}`) to where the \
                    run recorded no impact. It is counted as not caught from there on; run the cases with \
                    extended.toml to see."
            ));
        }
        Ok(notes)
    }

    /// Measures coordinates along the axis of each patch in which its impacts extend farthest.
    fn find_axes(&mut self) {
        let along = |reading: &&RigReading| matches!(reading.quantity, RigQuantity::CapturedAlong(_));
        let readings = self.experiments.iter().flat_map(|experiment| &experiment.readings);
        let patches: BTreeSet<String> = readings.filter(along).map(|reading| reading.wall.clone()).collect();
        for patch in patches {
            let on_patch = |run: &Recording| run.patches.iter().position(|name| *name == patch);
            let mut ends = [f64::INFINITY, f64::NEG_INFINITY].map(Vector3::repeat);
            for run in &self.runs {
                let Some(number) = on_patch(run) else { continue };
                for one in run.impacts.iter().filter(|one| one.patch == number) {
                    ends = [ends[0].inf(&one.position), ends[1].sup(&one.position)];
                }
            }
            // Of equal ones the first.
            let axis = (ends[1] - ends[0]).imax();
            for run in &mut self.runs {
                if let Some(number) = on_patch(run) {
                    run.axes[number] = axis;
                }
            }
            let [low, high] = ends.map(|end| end[axis]);
            self.notes.push(format!(
                "captured_from_Z1_to_Z2@{patch} is along {}, in which the recorded impacts extend farthest: {low:.4} \
                    to {high:.4} m.",
                ["x", "y", "z"][axis]
            ));
        }
    }

    /// Finds the flat patches, from their impacts in all experiments, and the flights between parallel ones.
    fn find_flights(&mut self) {
        let mut points: BTreeMap<String, Vec<Vector3<f64>>> = BTreeMap::new();
        for run in &self.runs {
            for one in &run.impacts {
                points.entry(run.patches[one.patch].clone()).or_default().push(one.position);
            }
        }
        let flat: BTreeMap<&str, FlatWall> = points
            .iter()
            .filter_map(|(patch, points)| Some((patch.as_str(), FlatWall::of(points)?)))
            .collect();
        for run in &mut self.runs {
            run.flat = run.patches.iter().map(|patch| flat.get(patch.as_str()).cloned()).collect();
            for parcel in &run.parcels {
                for place in parcel.impacts.clone().skip(1) {
                    let [from, to] = [&run.impacts[place - 1], &run.impacts[place]];
                    let arriving = [to.impact.normal_speed, to.impact.tangential_speed];
                    let end = |one: &ReplayedImpact, speeds: [f64; 2]| {
                        let wall = run.flat[one.patch].as_ref()?;
                        Some(RecordedContact { wall, position: one.position, age: one.age, speeds })
                    };
                    let ends = end(from, from.recorded).zip(end(to, arriving));
                    run.impacts[place - 1].flight =
                        ends.and_then(|(from, to)| RecordedFlight::new(&from, &to));
                }
            }
        }
    }
}

/// The case of an experiment: the sub-folder of its name. Rows without a name, and a single
/// experiment, may be of `folder` itself.
fn case_of(
    folder: &Path,
    experiment: &Experiment,
    count: usize,
    place: &str,
) -> Result<PathBuf, ReplayError> {
    let own = folder.join(&experiment.name);
    if own.is_dir() {
        return Ok(own);
    }
    let nameless = experiment.name == format!("line {}", experiment.line);
    let has_cases = folder.join("system").is_dir() || folder.join("postProcessing").is_dir();
    if nameless || !folder.is_dir() || (count == 1 && has_cases) {
        return Ok(folder.to_owned());
    }
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let folders = entries.filter(|entry| entry.path().is_dir());
    let mut found: Vec<String> =
        folders.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    found.sort();
    found.truncate(12);
    Err(ReplayError::NoCase { place: place.to_owned(), folder: own, found })
}

/// Checks that the patches of all readings are recorded. Where a patch has impacts in another
/// experiment, and none in this one, none arrived.
fn check_patches(
    data: &RigMeasurements,
    runs: &[Recording],
    unrecorded: &[Vec<String>],
) -> Result<(), ReplayError> {
    let found: BTreeSet<String> = runs.iter().flat_map(|run| run.patches.clone()).collect();
    for ((experiment, run), unrecorded) in data.experiments.iter().zip(runs).zip(unrecorded) {
        let known =
            |wall: &String| run.patches.contains(wall) || found.contains(wall) && !unrecorded.contains(wall);
        if let Some(reading) = experiment.readings.iter().find(|reading| !known(&reading.wall)) {
            let place = format!("{}:{}: experiment `{}`", data.file, reading.line, experiment.name);
            let (column, file) = (reading.column.clone(), run.file.clone());
            return Err(ReplayError::NoPatch { place, column, file, found: found.into_iter().collect() });
        }
    }
    Ok(())
}

impl Forward for ReplayedRig {
    fn experiments(&self) -> &[Experiment] {
        &self.experiments
    }

    fn base(&self, _experiment: usize) -> &Model {
        &self.base
    }

    fn predict(
        &self,
        experiment: usize,
        change: &ModelChange<'_>,
    ) -> Result<Vec<PredictedReading>, PredictionError> {
        let run = &self.runs[experiment];
        let model = change(&self.base);
        let tally = std::cell::RefCell::new(Tally::new(&self.experiments[experiment].readings, &run.patches));
        run.replay(
            &model,
            |hit, doubt| {
                let mut tally = tally.borrow_mut();
                tally.set_doubt(doubt);
                tally.hit(hit);
            },
            |parcel| tally.borrow_mut().end_particle(parcel.injected),
        )?;
        let mut tally = tally.into_inner();
        tally.end_missed(run.missed.0, run.missed.1);
        Ok(tally.predicted())
    }

    fn most_causes(&self) -> usize {
        // A second cause would be judged by impacts that the first one has changed.
        1
    }

    fn input_values(&self, experiment: usize, input: CurveInput) -> Vec<(f64, f64)> {
        let run = &self.runs[experiment];
        let first = |parcel: &Parcel| {
            let one = run.impacts.get(parcel.impacts.start)?;
            Some((self.base.group_value(one.wall, &one.impact, input).ok()?, parcel.particles))
        };
        run.parcels.iter().filter_map(first).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nearwall::impact::Impact;
    use nearwall::rng::ImpactRng;

    const HEADER: &str = "time,x,y,z,origProcId,origId,parcel_age,n_particles,v_n,v_t,d,T_p,patch,wall,injector,mass,regime,outcome,e_n,e_t";

    /// Rebounds with e_n 0.5 and e_t 0.8; captures half of the particles at this temperature, a
    /// fifth of those 6.93 K below.
    fn model(temperature: f64, e_n: f64) -> Model {
        let text = format!(
            "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n[normal]\nmodel \
                = \"constant\"\n\
             e_n = {e_n}\n[tangential]\nmodel = \"constant\"\ne_t = 0.8\n[[effects]]\nkind = \"melting-transition\"\n\
             temperature = {temperature}\nwidth = 5\nsoftening = 0\n"
        );
        Model::from_toml("base.toml", &text).unwrap()
    }

    /// An impact to be recorded.
    struct Hit {
        parcel: usize,
        number: usize,
        temperature: f64,
        mass: f64,
        captured: bool,
    }

    /// Writes the case `folder` with these impacts; impact `number` of a parcel is at z = 0.1 `number`.
    fn write(folder: &Path, hits: &[Hit], injected: f64, parcels: usize) {
        let tables = folder.join("postProcessing/nearWallInteraction/cloud/0");
        std::fs::create_dir_all(&tables).unwrap();
        let row = |hit: &Hit| {
            let Hit { parcel, number, temperature, mass, captured } = hit;
            let outcome = if *captured { "stick,," } else { "rebound,0.5,0.8" };
            format!(
                "{number},0.01,0,{},0,{parcel},{number},1,{},1,1e-4,{temperature},floor,default,jet,{mass},SP-NSW,{outcome}\n",
                0.1 * *number as f64,
                2.0 * 0.5_f64.powi(*number as i32)
            )
        };
        let rows: String = hits.iter().map(row).collect();
        std::fs::write(tables.join("impacts.csv"), format!("# recorded impacts: all\n{HEADER}\n{rows}"))
            .unwrap();
        let sticks = hits.iter().filter(|hit| hit.captured).count();
        let rebounds = hits.len() - sticks;
        let floor =
            format!("# time_s hits rebounds sticks e_n_sum\n9 {} {rebounds} {sticks} 1\n", hits.len());
        std::fs::write(tables.join("floor.dat"), floor).unwrap();
        let balance = format!("# time_s injected_kg injected_parcels residual\n9 {injected} {parcels} 0\n");
        std::fs::write(tables.join("balance.dat"), balance).unwrap();
    }

    fn data(text: &str) -> RigMeasurements {
        RigMeasurements::read("rig.csv", text.as_bytes()).unwrap()
    }

    fn captures(pattern: &[(usize, f64, &str)], temperature: f64) -> Vec<Hit> {
        let all = pattern.iter().flat_map(|(parcel, mass, path)| {
            path.chars().enumerate().map(move |(number, decision)| (*parcel, *mass, number, decision == 'c'))
        });
        let hit = |(parcel, mass, number, captured)| Hit { parcel, number, temperature, mass, captured };
        all.map(hit).collect()
    }

    #[test]
    fn capture_is_reweighted_as_by_hand() {
        let folder = tempfile::tempdir().unwrap();
        let hits = captures(&[(1, 1.0, "rrc"), (2, 2.0, "c"), (3, 1.0, "rr")], 350.0);
        write(&folder.path().join("a"), &hits, 5.0, 4);
        let data = data(
            "experiment,captured@floor,capture_efficiency@floor,captured_from_0.05_to_0.15@floor,mean_e_n@floor\n\
             a,0.5,0.5,0.1,0.5\n",
        );
        let replayed = ReplayedRig::new(folder.path(), &data, &model(350.0, 0.5)).unwrap();
        assert!(replayed.notes()[0].contains("along z"), "{:?}", replayed.notes());
        // p = 0.5 in the run, 0.2 in the changed law: shares 1, 1.6, 2.56.
        let changed = model(350.0 + 5.0 * 4.0_f64.ln(), 0.5);
        let predicted = replayed.predict(0, &|_| changed.clone()).unwrap();
        let expected =
            [0.2 * (5.16 + 2.0 + 2.6) / 5.0, 0.2 * (5.16 + 1.0 + 2.6) / 3.0, 0.2 * (1.6 + 1.6) / 5.0, 0.5];
        for (predicted, expected) in predicted.iter().zip(expected) {
            assert!((predicted.value - expected).abs() < 1e-9, "{} {expected}", predicted.value);
        }
        let account = replayed.account(0, &changed).unwrap();
        assert!((account.caught - expected[0]).abs() < 1e-9);
        assert!((account.caught_later - 0.2 * (4.16 + 1.6) / 5.0).abs() < 1e-9);
        assert_eq!(account.without_record, 0.0);
        // The base itself has weights of 1.
        let base = replayed.predict(0, &Model::clone).unwrap();
        assert!((base[0].value - 0.5 * (3.0 + 2.0 + 2.0) / 5.0).abs() < 1e-9);
        assert_eq!(base[0].particles, 4.0);
        let temperature = CurveInput::named("T_p", &replayed.base.declared()).unwrap();
        assert_eq!(replayed.input_values(0, temperature), vec![(350.0, 1.0); 3]);
    }

    #[test]
    fn changed_rebounds_lead_elsewhere() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &captures(&[(1, 1.0, "rrr"), (2, 1.0, "c")], 350.0), 2.0, 2);
        let data = data(
            "captured_from_0_to_0.01@floor,captured_from_0.047_to_0.048@floor,captured_from_0.067_to_0.069@floor,\
             captured_from_0.09_to_0.3@floor\n0.5,0.1,0.1,0.1\n",
        );
        let replayed = ReplayedRig::new(folder.path(), &data, &model(350.0, 0.5)).unwrap();
        // Bounces of 1 s with 1 and 0.5 m/s take 0.5 and 0.25 s with 0.5 and 0.125 m/s. Along the
        // floor the speed grows by 0.2 m/s in a second: of 0.9 m, 0.1 m in the record, the particle
        // gets 0.425 m and 0.18625 m far.
        let predicted = replayed.predict(0, &|_| model(350.0, 0.25)).unwrap();
        for (predicted, expected) in predicted.iter().zip([0.5, 0.25, 0.25, 0.0]) {
            assert!((predicted.value - expected).abs() < 1e-9, "{} {expected}", predicted.value);
        }
        assert_eq!(replayed.account(0, &model(350.0, 0.25)).unwrap().led_away, 0.0);
        // Twice as fast it leaves the floor that the record knows.
        let account = replayed.account(0, &model(350.0, 0.99)).unwrap();
        assert!(account.led_away > 0.2, "{account:?}");
    }

    #[test]
    fn what_a_certain_capture_hides_is_stated() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &captures(&[(1, 1.0, "c"), (2, 3.0, "c")], 500.0), 8.0, 4);
        let data = data("captured@floor\n0.5\n");
        let replayed = ReplayedRig::new(folder.path(), &data, &model(350.0, 0.5)).unwrap();
        let changed = model(500.0 + 5.0 * 4.0_f64.ln(), 0.5);
        let account = replayed.account(0, &changed).unwrap();
        assert!((account.caught - 0.1).abs() < 1e-9 && (account.without_record - 0.4).abs() < 1e-9);
        let notes = replayed.account_notes(&changed).unwrap();
        assert!(notes[0].contains("up to 40.0 % of the injected mass"), "{notes:?}");
    }

    #[test]
    fn a_wrong_model_file_and_wrong_names_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let hits = captures(&[(1, 1.0, "rrc"), (2, 2.0, "c"), (3, 1.0, "rr")], 350.0);
        write(&folder.path().join("a"), &hits, 5.0, 4);
        let fault = |text: &str, model: &Model| {
            ReplayedRig::new(folder.path(), &data(text), model).unwrap_err().to_string()
        };
        let good = "experiment,captured@floor\na,0.5\n";
        let said = fault(good, &model(350.0, 0.6));
        assert!(said.contains("not the one of the run: on line 3 the run has e_n = 0.500000"), "{said}");
        let said = fault(good, &model(900.0, 0.5));
        assert!(said.contains("the run captured 2 of 6 impacts, the model file 0.0"), "{said}");
        let said = fault("experiment,captured@floor\nb,0.5\n", &model(350.0, 0.5));
        assert!(said.contains("there is no folder") && said.contains("there are a"), "{said}");
        let said = fault("experiment,captured@lid\na,0.5\n", &model(350.0, 0.5));
        assert!(said.contains("`captured@lid`") && said.contains("only on floor"), "{said}");
    }

    /// Random numbers of a world, each with its place.
    fn chance(seed: u64, parcel: usize, number: usize) -> f64 {
        ImpactRng::new(seed, (parcel * 64 + number) as u64).uniform(7)
    }

    /// A world in which a particle rebounds up to six times: its hits under a law, with random captures.
    fn world(law: &Model, seed: u64, parcels: usize) -> Vec<Hit> {
        let mut hits = Vec::new();
        for parcel in 0..parcels {
            let temperature = 335.0 + 25.0 * chance(seed, parcel, 60);
            let mass = 0.5 + chance(seed, parcel, 61);
            for number in 0..6 {
                let impact = Impact {
                    normal_speed: 2.0 * 0.5_f64.powi(number as i32),
                    tangential_speed: 1.0,
                    diameter: 1e-4,
                    particle_temperature: temperature,
                    ..Impact::default()
                };
                let captured = chance(seed, parcel, number)
                    < law.resolve(0, &impact, ImpactRng::default()).unwrap().sticking_probability;
                hits.push(Hit { parcel, number, temperature, mass, captured });
                if captured {
                    break;
                }
            }
        }
        hits
    }

    #[test]
    fn replay_and_brute_force_agree() {
        let (base, changed) = (model(355.0, 0.5), model(362.0, 0.5));
        let parcels = 4000;
        let folder = tempfile::tempdir().unwrap();
        let mass = |hits: &[Hit]| hits.iter().filter(|hit| hit.number == 0).map(|hit| hit.mass).sum::<f64>();
        let run = world(&base, 1, parcels);
        write(folder.path(), &run, mass(&run), parcels);
        let bins = [0.0, 0.05, 0.15, 0.35, 0.6];
        let columns: Vec<String> =
            bins.windows(2).map(|bin| format!("captured_from_{}_to_{}@floor", bin[0], bin[1])).collect();
        let cells = vec!["0.1"; columns.len()].join(",");
        let data = data(&format!("captured@floor,{}\n0.5,{cells}\n", columns.join(",")));
        let replayed = ReplayedRig::new(folder.path(), &data, &base).unwrap();
        // Both better and worse capture than in the run.
        for law in [&changed, &model(349.0, 0.5)] {
            let predicted = replayed.predict(0, &|_| law.clone()).unwrap();
            let truth = world(law, 2, 10 * parcels);
            let caught = |low: f64, high: f64| {
                let inside = truth.iter().filter(|hit| hit.captured);
                let inside = inside.filter(|hit| (low..high).contains(&(0.1 * hit.number as f64)));
                inside.map(|hit| hit.mass).sum::<f64>() / mass(&truth)
            };
            let mut expected = vec![caught(0.0, 1.0)];
            expected.extend(bins.windows(2).map(|bin| caught(bin[0], bin[1])));
            for (predicted, expected) in predicted.iter().zip(&expected) {
                let error =
                    (predicted.variance + 1.3 * expected * (1.0 - expected) / (10 * parcels) as f64).sqrt();
                let off = (predicted.value - expected) / error;
                println!("{:.4} {expected:.4} +- {error:.4}", predicted.value);
                assert!(off.abs() < 4.0, "{} {expected} +- {error}", predicted.value);
                assert!(error < 0.02, "{error}");
            }
        }
    }

    #[test]
    fn large_records_are_thinned_evenly() {
        let base = model(365.0, 0.5);
        let run = world(&base, 1, 8000);
        let folder = tempfile::tempdir().unwrap();
        let mass: f64 = run.iter().filter(|hit| hit.number == 0).map(|hit| hit.mass).sum();
        write(folder.path(), &run, 2.0 * mass, 16000);
        let replayed = ReplayedRig::new(folder.path(), &data("captured@floor\n0.5\n"), &base).unwrap();
        assert!(replayed.notes()[0].contains("of 8000 parcels are replayed"), "{:?}", replayed.notes());
        let [predicted] = replayed.predict(0, &Model::clone).unwrap()[..] else { unreachable!() };
        let counted: f64 =
            run.iter().filter(|hit| hit.captured).map(|hit| hit.mass).sum::<f64>() / (2.0 * mass);
        assert!(
            (predicted.value - counted).abs() < 4.0 * predicted.variance.sqrt(),
            "{predicted:?} {counted}"
        );
    }
}
