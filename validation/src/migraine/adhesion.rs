//! Work of adhesion: what it does to the sticking velocity, and whether any of it explains who stuck.

use nearwall::ImpactRng;
use nearwall::normal::{Contact, NormalLaw};
use nearwall_lab::report::{Chart, Figure, Table, number};

use super::curves::contact;
use super::published::{RATIO, SETS, Set};
use super::sample::{Sampler, Spread};
use super::statistics::binomial;
use super::{MEASURED_ADHESION, PLAIN, Result, model};
use crate::claim::Claim;
use crate::steps::{even, even_in_logarithm};
use crate::study::{Extent, StudyPart, table};

const SEED: u64 = 11;

pub fn part(extent: Extent) -> Result<StudyPart> {
    let plain = model(PLAIN)?;
    let clean = contact(&plain, RATIO[0], None)?;
    let cases = Cases::new(&clean, extent)?;
    Ok(StudyPart {
        heading: "Work of adhesion and who sticks".to_owned(),
        text: text(&clean),
        tables: vec![sets_table()?, speeds_table(&clean), cases.table()],
        figures: vec![figure(&clean)],
        claims: cases.claims(&clean)?,
    })
}

fn text(clean: &Contact) -> Vec<String> {
    let measured = Contact { work_of_adhesion: MEASURED_ADHESION, ..*clean };
    let [first, second, third, fourth, fifth] = SETS.each_ref().map(Set::stuck_percent);
    vec![
        format!(
            "Two works of adhesion are known: 2 gamma of clean tungsten, {} J/m², and {MEASURED_ADHESION} \
             J/m², measured between tungsten and steel. In the law of Thornton & Ning every impact slower \
             than v_s sticks and no faster one. v_s grows with W^(10/9) p_y^(-5/6) R^(-10/9) where v_adh is \
             far above v_y.",
            number(clean.work_of_adhesion)
        ),
        format!(
            "By this closed form no impact of set 1 can stick with either of them: its slowest impact, {} \
             m/s, is faster than v_s. But yielding flattens the contact, which raises the pull-off: by \
             thornton-ning-raised-pull-off v_s of 9 µm is {} m/s with clean metal and {} m/s with \
             {MEASURED_ADHESION} J/m². The paper and the other parts of this study use the closed form.",
            SETS[0].normal[0],
            number(Hold::raised(*clean).sticking(9e-6)),
            number(Hold::raised(measured).sticking(9e-6))
        ),
        format!(
            "A W (or a p_y) can be found with which {first:.0} % of set 1 stick; the table shows the result \
             of this W for the other sets, which had the same dust except set 5. The sets differ in the \
             plasma, and the order is suggestive: sets 1, 2, 3 and 4 stuck {first:.0}, {second:.0}, \
             {third:.1} and {fourth:.0} %, in the order in which the text calls the plasma weaker (set 3 \
             ran at 130 to 150 A). Hotter dust is softer, and v_s goes with p_y^(-5/6); but its temperature \
             is not published, and set 5, larger dust in the plasma of set 1, stuck {fifth:.0} %."
        ),
    ]
}

fn sets_table() -> Result<Table> {
    let mut rows = Vec::new();
    for set in &SETS {
        let [low, high] = binomial(set.stuck, set.impacts, 0.025)?;
        rows.push(vec![
            set.name(),
            set.plasma.to_owned(),
            format!("{} to {}", set.size[0], set.size[2]),
            format!("{} to {}", set.normal[0], set.normal[1]),
            number(set.angle[1]),
            format!("{} of {}", set.stuck, set.impacts),
            format!("{:.1} ({:.1} to {:.1})", set.stuck_percent(), 100.0 * low, 100.0 * high),
        ]);
    }
    Ok(table(
        "The sets as published; in brackets the 95 % binomial interval.",
        2,
        "set | plasma | d [µm] | v_n [m/s] | mean angle [°] | stuck | stuck [%]",
        rows,
    ))
}

/// What holds a particle: a law and a contact.
#[derive(Clone, Copy)]
struct Hold {
    law: NormalLaw,
    contact: Contact,
}

impl Hold {
    /// By the closed form.
    fn closed(contact: Contact) -> Self {
        Self { law: NormalLaw::ThorntonNing, contact }
    }

    /// With the pull-off that yielding raises.
    fn raised(contact: Contact) -> Self {
        Self { law: NormalLaw::PlasticJkr, contact }
    }

    /// Sticking velocity [m/s] of a diameter [m].
    fn sticking(&self, diameter: f64) -> f64 {
        self.law.speeds(&self.contact, diameter).sticking
    }
}

fn speeds_table(clean: &Contact) -> Table {
    let mut rows = Vec::new();
    for work_of_adhesion in [clean.work_of_adhesion, MEASURED_ADHESION] {
        for ratio in RATIO {
            let contact = Contact { work_of_adhesion, yield_ratio: ratio, ..*clean };
            let mut row = vec![number(work_of_adhesion), number(ratio)];
            for diameter in [9e-6, 14e-6] {
                let speeds = NormalLaw::ThorntonNing.speeds(&contact, diameter);
                row.extend([speeds.adhesive, speeds.sticking].map(number));
            }
            rows.push(row);
        }
    }
    table(
        &format!(
            "Adhesive and sticking velocity at 3000 K on 1000 K. Slowest impacts of sets 1 to 5: {} m/s; 9 \
             µm, in set 5 14 µm.",
            SETS.map(|set| number(set.normal[0])).join(", ")
        ),
        0,
        "W [J/m²] | c | v_adh 9 µm [m/s] | v_s 9 µm [m/s] | v_adh 14 µm [m/s] | v_s 14 µm [m/s]",
        rows,
    )
}

fn figure(clean: &Contact) -> Figure {
    let works: Vec<f64> = even_in_logarithm([0.1, 60.0], 60).collect();
    let line = |ratio, diameter| -> Vec<[f64; 2]> {
        let at = |work_of_adhesion| Contact { work_of_adhesion, yield_ratio: ratio, ..*clean };
        works.iter().map(|work| [*work, Hold::closed(at(*work)).sticking(diameter)]).collect()
    };
    let raised: Vec<[f64; 2]> = works
        .iter()
        .map(|&work| [work, Hold::raised(Contact { work_of_adhesion: work, ..*clean }).sticking(9e-6)])
        .collect();
    let [slowest, fastest] = SETS[0].normal;
    let caption = format!(
        "Set 1 stuck {} of {} between {slowest} and {fastest} m/s. By the closed form even its slowest \
         impact exceeds the adhesion of clean metal; with the raised pull-off the slower ones stick.",
        SETS[0].stuck, SETS[0].impacts
    );
    Chart::new("Sticking velocity against work of adhesion", "work of adhesion W [J/m²]", "v_s [m/s]")
        .log_x()
        .log_y()
        .line("9 µm, c = 4", &line(RATIO[0], 9e-6))
        .line("9 µm, c = 2.8", &line(RATIO[1], 9e-6))
        .line("14 µm, c = 4", &line(RATIO[0], 14e-6))
        .line("9 µm, c = 4, raised pull-off", &raised)
        .mark_y(slowest, "slowest of set 1")
        .mark_x(MEASURED_ADHESION, "W–steel")
        .mark_x(clean.work_of_adhesion, "2 gamma")
        .figure("migraine-adhesion", &caption)
}

/// A contact with a name, and how much of each set sticks under it.
struct AdhesionCase {
    name: String,
    hold: Hold,
    shares: Vec<[f64; 2]>,
}

struct Cases {
    list: Vec<AdhesionCase>,
    /// Impacts of each set under both assumed spreads: diameter and normal speed.
    impacts: Vec<[Vec<(f64, f64)>; 2]>,
}

impl Cases {
    fn new(clean: &Contact, extent: Extent) -> Result<Self> {
        let count = extent.count(5000) as u64;
        let mut impacts = Vec::new();
        for set in SETS {
            let mut both = [Vec::new(), Vec::new()];
            for ((spread, _), list) in Spread::ALL.into_iter().zip(&mut both) {
                let sampler = Sampler::new(set, spread)?;
                list.extend((0..count).map(|key| {
                    let impact = sampler.impact(ImpactRng::new(SEED, key));
                    (impact.diameter, impact.normal_speed)
                }));
            }
            impacts.push(both);
        }
        let mut cases = Self { list: Vec::new(), impacts };
        let work = |work_of_adhesion: f64| Contact { work_of_adhesion, ..*clean };
        for ratio in RATIO {
            let contact = Contact { yield_ratio: ratio, ..*clean };
            cases.add(&format!("clean metal, c = {ratio}"), Hold::closed(contact));
            cases.add(&format!("the same with raised pull-off, c = {ratio}"), Hold::raised(contact));
        }
        cases.add(
            &format!("{MEASURED_ADHESION} J/m², c = {}", RATIO[0]),
            Hold::closed(work(MEASURED_ADHESION)),
        );
        cases.add("the same with raised pull-off", Hold::raised(work(MEASURED_ADHESION)));
        for (place, (_, name)) in Spread::ALL.iter().enumerate() {
            let fitted = cases.fitted(place, 0.1, 1e3, work);
            let weak = |weakness: f64| Contact { yield_ratio: RATIO[0] / weakness, ..*clean };
            let pressure = cases.fitted(place, 1.0, 1e4, weak).limiting_pressure() / 1e6;
            let work = number(fitted.work_of_adhesion);
            let name =
                format!("set 1, {name}: W = {work} J/m², or 2 gamma and p_y = {} MPa", number(pressure));
            cases.add(&name, Hold::closed(fitted));
        }
        Ok(cases)
    }

    fn add(&mut self, name: &str, hold: Hold) {
        self.list.push(AdhesionCase { name: name.to_owned(), hold, shares: self.shares(hold) });
    }

    /// Share of every set that sticks, under both spreads.
    fn shares(&self, hold: Hold) -> Vec<[f64; 2]> {
        (0..SETS.len()).map(|set| [0, 1].map(|spread| self.share(hold, set, spread))).collect()
    }

    /// Share of a set's impacts that stick. `v_s` falls smoothly with the diameter: drawn straight
    /// between nine of them.
    fn share(&self, hold: Hold, set: usize, spread: usize) -> f64 {
        const PIECES: usize = 8;
        let [small, _, large] = SETS[set].size.map(|size| size * 1e-6);
        let sticking: Vec<f64> =
            even([small, large], PIECES + 1).map(|diameter| hold.sticking(diameter)).collect();
        let held = |diameter: f64, speed: f64| {
            let place = (diameter - small) / (large - small) * PIECES as f64;
            let piece = (place as usize).min(PIECES - 1);
            speed <= sticking[piece] + (place - piece as f64) * (sticking[piece + 1] - sticking[piece])
        };
        let impacts = &self.impacts[set][spread];
        impacts.iter().filter(|(diameter, speed)| held(*diameter, *speed)).count() as f64
            / impacts.len() as f64
    }

    /// The contact with which set 1 sticks as published; `make` sticks the more the larger its number. By halving.
    fn fitted(&self, spread: usize, mut low: f64, mut high: f64, make: impl Fn(f64) -> Contact) -> Contact {
        let goal = SETS[0].stuck as f64 / SETS[0].impacts as f64;
        for _ in 0..30 {
            let middle = (low * high).sqrt();
            if self.share(Hold::closed(make(middle)), 0, spread) < goal {
                low = middle
            } else {
                high = middle
            }
        }
        make((low * high).sqrt())
    }

    fn table(&self) -> Table {
        let mut rows = vec![
            std::iter::once("published".to_owned())
                .chain(["–".to_owned()])
                .chain(SETS.iter().map(|set| format!("{} of {}", set.stuck, set.impacts)))
                .collect::<Vec<String>>(),
        ];
        rows.extend(self.list.iter().map(|case| {
            let mut row = vec![case.name.clone(), number(case.hold.sticking(9e-6))];
            row.extend(SETS.iter().zip(&case.shares).map(|(set, shares)| {
                let [a, b] = shares.map(|share| share * set.impacts as f64);
                format!("{a:.1} / {b:.1}")
            }));
            row
        }));
        table(
            "Expected captures, with v_n spread evenly / evenly in its logarithm over the printed range \
             (both assumed; seed 11). Only v_s decides, and W and p_y shift it alike, so a fit of either \
             gives the same result for every set.",
            1,
            "contact | v_s 9 µm [m/s] | set 1 | set 2 | set 3 | set 4 | set 5",
            rows,
        )
    }

    /// Expected captures in a set under both spreads: `63 or 66 of 122`.
    fn expected(shares: &[[f64; 2]], set: usize) -> String {
        let impacts = SETS[set].impacts;
        let [even, slow] = shares[set].map(|share| share * impacts as f64);
        format!("{even:.0} or {slow:.0} of {impacts}")
    }

    fn claims(&self, clean: &Contact) -> Result<Vec<Claim>> {
        let stuck = SETS.map(|set| format!("{} of {}", set.stuck, set.impacts));
        Ok(vec![
            closed_form(clean, &stuck),
            self.raised(clean, &stuck)?,
            self.one_for_all(clean, &stuck)?,
            Claim::unchecked(
                "section 4, sticking events",
                "which of the captures were single grains, doublets or softened dust",
                "\"a small fraction\" were doublets",
                "The paper gives neither their speeds nor the number of doublets.",
            ),
        ])
    }

    /// Whether clean metal with the raised pull-off suits every set.
    fn raised(&self, clean: &Contact, stuck: &[String]) -> Result<Claim> {
        let hold = Hold::raised(*clean);
        let shares = self.shares(hold);
        Ok(Claim::predicted_statement(
            "sets 1 to 5",
            "clean metal by thornton-ning-raised-pull-off, c = 4: captures of every set within their 95 % \
             interval",
            &stuck.join(", "),
            &format!(
                "v_s = {} m/s (9 µm); {} in set 1, {} in set 3",
                number(hold.sticking(9e-6)),
                Self::expected(&shares, 0),
                Self::expected(&shares, 2)
            ),
            fits(&shares)?,
        )
        .because(
            "The flattened contact captures many times more than the closed form: it could explain set 1 \
             alone, but not sets 3 and 4. Capture depends on the law and on W, and neither is known well \
             enough.",
        ))
    }

    /// Whether one adhesion or one pressure suits every set, by either law.
    fn one_for_all(&self, clean: &Contact, stuck: &[String]) -> Result<Claim> {
        let works = even_in_logarithm([0.1, 300.0], 20)
            .map(|work_of_adhesion| Contact { work_of_adhesion, ..*clean });
        let pressures = even_in_logarithm([0.01, 10.0], 20)
            .map(|share| Contact { yield_ratio: RATIO[0] * share, ..*clean });
        let mut any = false;
        for contact in works.chain(pressures) {
            for hold in [Hold::closed(contact), Hold::raised(contact)] {
                any |= fits(&self.shares(hold))?;
            }
        }
        let fitted: Vec<&AdhesionCase> = self.list.iter().rev().take(Spread::ALL.len()).rev().collect();
        let works = fitted.iter().map(|case| number(case.hold.contact.work_of_adhesion)).collect::<Vec<_>>();
        let third: Vec<String> = fitted
            .iter()
            .enumerate()
            .map(|(spread, case)| format!("{:.0}", case.shares[2][spread] * SETS[2].impacts as f64))
            .collect();
        let claim = Claim::fitted_statement(
            "sets 1 to 5",
            "one W (0.1 to 300 J/m²), or one p_y (a hundredth to ten times 1.2 GPa), by either law, gives \
             captures within the 95 % interval of every set",
            &stuck.join(", "),
            &format!(
                "fitted to set 1 (W = {} J/m², closed form) it says {} of {} in set 3",
                works.join(" or "),
                third.join(" or "),
                SETS[2].impacts
            ),
            any,
        );
        Ok(claim.because(&format!(
            "Set 3 has the same dust and slower impacts, yet {} stuck. No law in which the slower of two \
             equal particles sticks first can have both. What differs (plasma, dust temperature, target \
             history) is not in the inputs. The calibrated model uses no fit to captures.",
            stuck[2]
        )))
    }
}

/// Whether the paper's law can hold anything of set 1.
fn closed_form(clean: &Contact, stuck: &[String]) -> Claim {
    let softest = Contact { yield_ratio: RATIO[1], ..*clean };
    let strongest = Hold::closed(softest).sticking(8e-6);
    Claim::predicted_statement(
        "set 1",
        "adhesion by Thornton & Ning can capture impacts of set 1",
        &format!("{} stuck, v_n from {} m/s", stuck[0], SETS[0].normal[0]),
        &format!("v_s at most {} m/s (8 µm, c = {}, clean metal)", number(strongest), RATIO[1]),
        strongest > SETS[0].normal[0],
    )
    .because(
        "With the closed form, which the paper also uses, even the largest adhesion of two clean metals is \
         not sufficient. It omits the flattening of the contact by yielding; see the next row.",
    )
}

/// Whether these shares lie in the 95 % interval of every set's captures, under one of the spreads.
fn fits(shares: &[[f64; 2]]) -> Result<bool> {
    let mut all = [true; 2];
    for (set, shares) in SETS.iter().zip(shares) {
        let [low, high] = binomial(set.stuck, set.impacts, 0.025)?;
        for (fits, share) in all.iter_mut().zip(shares) {
            *fits &= (low..=high).contains(share);
        }
    }
    Ok(all.contains(&true))
}
