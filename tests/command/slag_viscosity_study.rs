//! Which slag viscosity law is wrong, on which oxide, and does an extension hold on references it has not seen?
//!
//! What was fixed before the first figure was seen:
//! - The unit that is held out is a reference, never a row. Every reference weighs the same in fits and in errors,
//!   whether it has 28 rows or 370; figures by row stand beside.
//! - Rows of the compilation Iida et al. 2000 that repeat another reference's row are left out
//!   ([`Measured::repeats`]): held out with one and trained on with the other they would be seen after all.
//! - The residual is `log10(law) - log10(measured)`. A correction is linear in its coefficients and subtracted.
//!   Shares count in 10 wt%, silica, alumina, lime and magnesia from 40, 20, 30 and 10 wt%; the temperature as
//!   `tau = 1e4/T - 5.8` [1/K]. The ridge [`RIDGE`] says that 10 wt% of an oxide move log10 by 0.5 or so; the
//!   offset has none.
//! - An oxide is judged by what it adds, on held-out references, to an offset and a `tau` term that any law may have.
//!   p values: exact sign flips of the gains of the references, two-sided. False discoveries: Benjamini–Hochberg,
//!   5 %, over all laws and terms together.
//! - The extension's terms are chosen forward, at most six, by leaving out references of the training part one by
//!   one; of the sizes within one standard error of the best the smallest is taken.
//! - Intervals: 95 % percentiles of 10 000 draws of references with replacement, ChaCha8, fixed seed.
//!
//! `cargo test --test command slag_viscosity_study -- --nocapture` prints every figure of
//! `docs/why/slag-viscosity.md`; with `NEARWALL_BLESS=1` before it, it also draws the figures there
//! anew.

use crate::common::measured_slags::{Measured, measured};
use nalgebra::{DMatrix, DVector};
use nearwall::slag::urbain::{KALMANOVITCH_FRANK, URBAIN};
use nearwall::slag::watt_fereday::WATT_FEREDAY;
use nearwall::slag::{Oxide, SlagViscosity, ViscosityLaw, measured_range};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const LAWS: [&ViscosityLaw; 3] = [&WATT_FEREDAY, &URBAIN, &KALMANOVITCH_FRANK];

/// The law that this study led to and that was withdrawn: Kalmanovitch and Frank's less
/// [`SILICA_OFFSET`] and [`SILICA_SLOPE`] per 10 wt% SiO2 above 40, in log10.
static SILICA_CORRECTED: ViscosityLaw = ViscosityLaw {
    name: "kalmanovitch-frank-silica",
    stated_for: measured_range::IN_WORDS,
    coefficients: |composition| {
        let [factor, activation] = (KALMANOVITCH_FRANK.coefficients)(composition)?;
        let silica = composition.weight_percent(Oxide::SiO2).clamp(30.0, 70.0);
        let correction = SILICA_OFFSET + SILICA_SLOPE * (silica - 40.0) / 10.0;
        Ok([factor * 10_f64.powf(-correction), activation])
    },
    viscosity: |coefficients, temperature| (KALMANOVITCH_FRANK.viscosity)(coefficients, temperature),
    viscosities: |level, coefficients, temperatures, out| {
        (KALMANOVITCH_FRANK.viscosities)(level, coefficients, temperatures, out);
    },
    range: measured_range::temperatures,
    error: None,
};
const SILICA_OFFSET: f64 = 0.062123384;
const SILICA_SLOPE: f64 = -0.131094130;

/// Squared ratio of the error between references (0.2 in log10) to the effect that is expected of a term (0.5).
const RIDGE: f64 = 0.16;
const DRAWS: usize = 10_000;
const MOST_TERMS: usize = 6;

/// Columns of a correction: name and value of a row.
const OFFSET: usize = 0;
const TAU: usize = 1;
type Column = (String, Box<dyn Fn(&Measured) -> f64>);

/// The oxides with where they are counted from [wt%].
const MAIN: [(&str, f64); 4] = [("SiO2", 40.0), ("Al2O3", 20.0), ("CaO", 30.0), ("MgO", 10.0)];
const MINOR: [&str; 5] = ["FeO", "Fe2O3", "TiO2", "K2O", "MnO"];

fn tau(row: &Measured) -> f64 {
    1e4 / row.temperature - 5.8
}

fn oxides() -> Vec<Column> {
    let column = |name: &'static str, from: f64| -> Column {
        (name.to_owned(), Box::new(move |row| (row.share(name) - from) / 10.0))
    };
    let minor = MINOR.map(|name| column(name, 0.0));
    MAIN.map(|(name, from)| column(name, from)).into_iter().chain(minor).collect()
}

/// Offset, tau, then oxide and oxide times tau in turn; with `squares` also products of the four main oxides.
fn dictionary(squares: bool) -> Vec<Column> {
    let mut columns: Vec<Column> =
        vec![("1".to_owned(), Box::new(|_| 1.0)), ("tau".to_owned(), Box::new(tau))];
    for (name, value) in oxides() {
        let (again, with_tau) = (oxides(), format!("{name} tau"));
        columns.push((name.clone(), value));
        let value = again.into_iter().find(|(other, _)| *other == name).unwrap().1;
        columns.push((with_tau, Box::new(move |row| value(row) * tau(row))));
    }
    if squares {
        for (i, (first, from)) in MAIN.into_iter().enumerate() {
            for (second, other) in &MAIN[i..] {
                let (second, other) = (*second, *other);
                columns.push((
                    format!("{first} {second}"),
                    Box::new(move |row| (row.share(first) - from) * (row.share(second) - other) / 100.0),
                ));
            }
        }
    }
    columns
}

/// One reference's rows as the mean products that least squares needs.
struct Block {
    xx: DMatrix<f64>,
    xy: DVector<f64>,
    yy: f64,
    rows: usize,
}

impl Block {
    fn new(rows: &[&Measured], columns: &[Column], law: &'static ViscosityLaw) -> Self {
        let share = 1.0 / rows.len() as f64;
        let x = DMatrix::from_fn(rows.len(), columns.len(), |i, j| columns[j].1(rows[i]));
        let y = DVector::from_iterator(rows.len(), rows.iter().map(|row| residual(row, law)));
        Self { xx: x.tr_mul(&x) * share, xy: x.tr_mul(&y) * share, yy: y.dot(&y) * share, rows: rows.len() }
    }

    /// Mean square of what a correction leaves.
    fn left(&self, terms: &[usize], beta: &DVector<f64>) -> f64 {
        let mut left = self.yy;
        for (i, row) in terms.iter().enumerate() {
            let product: f64 = terms.iter().zip(beta).map(|(j, beta)| self.xx[(*row, *j)] * beta).sum();
            left += beta[i] * (product - 2.0 * self.xy[*row]);
        }
        left
    }
}

fn residual(row: &Measured, law: &'static ViscosityLaw) -> f64 {
    let slag = SlagViscosity::new(law, &row.composition()).unwrap();
    slag.at(row.temperature).log10() - row.log10_viscosity
}

/// Coefficients of some terms from some references.
fn fit<'a>(blocks: impl IntoIterator<Item = &'a Block>, terms: &[usize]) -> DVector<f64> {
    let ridge = |i: usize, j: usize| if i == j && terms[i] != OFFSET { RIDGE } else { 0.0 };
    let mut xx = DMatrix::from_fn(terms.len(), terms.len(), ridge);
    let mut xy = DVector::zeros(terms.len());
    for block in blocks {
        for (i, row) in terms.iter().enumerate() {
            xy[i] += block.xy[*row];
            for (j, column) in terms.iter().enumerate().take(i + 1) {
                xx[(i, j)] += block.xx[(*row, *column)];
            }
        }
    }
    // Cholesky reads the lower triangle.
    xx.cholesky().unwrap().solve(&xy)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean square error of every reference, corrected with what the others say.
fn held_out(blocks: &[&Block], terms: &[usize]) -> Vec<f64> {
    (0..blocks.len()).map(|out| blocks[out].left(terms, &fit(without(blocks, out), terms))).collect()
}

fn without<'a>(blocks: &'a [&'a Block], out: usize) -> impl Iterator<Item = &'a Block> {
    blocks.iter().enumerate().filter(move |(i, _)| *i != out).map(|(_, block)| *block)
}

/// Terms chosen forward on these references alone.
fn chosen(blocks: &[&Block], candidates: usize) -> Vec<usize> {
    let mut terms = vec![OFFSET];
    let mut sizes = vec![(terms.clone(), held_out(blocks, &terms))];
    while terms.len() <= MOST_TERMS {
        let more = (1..candidates).filter(|term| !terms.contains(term)).map(|term| {
            let with: Vec<usize> = terms.iter().copied().chain([term]).collect();
            let errors = held_out(blocks, &with);
            (with, errors)
        });
        let best = more.min_by(|(_, a), (_, b)| mean(a).total_cmp(&mean(b))).unwrap();
        terms = best.0.clone();
        sizes.push(best);
    }
    let best = sizes.iter().min_by(|(_, a), (_, b)| mean(a).total_cmp(&mean(b))).unwrap().1.clone();
    let close = sizes.into_iter().find(|(_, errors)| {
        let worse: Vec<f64> = errors.iter().zip(&best).map(|(a, b)| a - b).collect();
        let spread = worse.iter().map(|w| (w - mean(&worse)).powi(2)).sum::<f64>();
        let n = worse.len() as f64;
        mean(&worse) <= (spread / (n * (n - 1.0))).sqrt()
    });
    close.unwrap().0
}

/// 95 % percentile interval of a statistic over references drawn with replacement.
fn interval(references: usize, statistic: impl Fn(&[usize]) -> f64) -> [f64; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut drawn: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let draw: Vec<usize> =
                (0..references).map(|_| (random.next_u64() % references as u64) as usize).collect();
            statistic(&draw)
        })
        .collect();
    drawn.sort_by(f64::total_cmp);
    [drawn[DRAWS / 40], drawn[DRAWS - 1 - DRAWS / 40]]
}

/// Ratio of two root mean square errors, references weighing the same, with its interval.
fn ratio(after: &[f64], before: &[f64]) -> (f64, [f64; 2]) {
    let of = |draw: &[usize]| {
        let sum = |errors: &[f64]| draw.iter().map(|i| errors[*i]).sum::<f64>();
        (sum(after) / sum(before)).sqrt()
    };
    let all: Vec<usize> = (0..before.len()).collect();
    (of(&all), interval(before.len(), of))
}

/// Exact two-sided sign-flip test of the mean of the gains.
fn sign_flip(gains: &[f64]) -> f64 {
    let seen = mean(gains).abs() * gains.len() as f64 * (1.0 - 1e-12);
    let flips = 1_u32 << gains.len();
    let as_far = (0..flips).filter(|flip| {
        let sum: f64 =
            gains.iter().enumerate().map(|(i, g)| if (flip >> i) & 1 == 1 { -g } else { *g }).sum();
        sum.abs() >= seen
    });
    as_far.count() as f64 / f64::from(flips)
}

/// Which hypotheses stand at a false discovery rate of 5 %.
fn benjamini_hochberg(p: &[f64]) -> Vec<bool> {
    let mut sorted = p.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = p.len() as f64;
    let limit = sorted.iter().enumerate().rev().find(|(i, p)| **p <= 0.05 * (*i + 1) as f64 / n);
    let limit = limit.map_or(-1.0, |(_, p)| *p);
    p.iter().map(|p| *p <= limit).collect()
}

/// References with their rows.
type Groups<'a> = Vec<(&'static str, Vec<&'a Measured>)>;

/// The rows of the study by reference: copies in the compilation are left out unless they are wanted.
fn by_reference(rows: &[Measured], copies: bool) -> Groups<'_> {
    const COMPILATION: &str = "Iida et al. 2000";
    let mut sources: Vec<&str> = rows.iter().map(|row| row.source).collect();
    sources.sort_unstable();
    sources.dedup();
    let copied = |row: &Measured| {
        row.source == COMPILATION
            && rows.iter().any(|other| other.source != COMPILATION && other.repeats(row))
    };
    let own = |source: &str| {
        rows.iter().filter(|row| row.source == source && (copies || !copied(row))).collect::<Vec<_>>()
    };
    sources.into_iter().map(|source| (source, own(source))).collect()
}

fn blocks(groups: &Groups, columns: &[Column], law: &'static ViscosityLaw) -> Vec<Block> {
    groups.iter().map(|(_, rows)| Block::new(rows, columns, law)).collect()
}

/// Root mean square over rows of mean squares by reference.
fn by_row(blocks: &[&Block], errors: &[f64]) -> f64 {
    let rows: usize = blocks.iter().map(|block| block.rows).sum();
    let sum: f64 = blocks.iter().zip(errors).map(|(block, error)| block.rows as f64 * error).sum();
    (sum / rows as f64).sqrt()
}

/// The three published laws and, on the rows it was fitted to, ours.
#[test]
fn laws_by_reference() {
    let rows = measured();
    let groups = by_reference(&rows, false);
    assert_eq!(groups.len(), 12);
    assert_eq!(groups.iter().map(|(_, rows)| rows.len()).sum::<usize>(), 1117);
    let laws: Vec<&'static ViscosityLaw> = LAWS.into_iter().chain([&SILICA_CORRECTED]).collect();
    println!("{:36} rows {:?}", "reference", laws.iter().map(|law| law.name).collect::<Vec<_>>());
    let columns = dictionary(false);
    let found: Vec<Vec<Block>> = laws.iter().map(|law| blocks(&groups, &columns, law)).collect();
    for (i, (source, own)) in groups.iter().enumerate() {
        let numbers: Vec<String> = found
            .iter()
            .map(|blocks| format!("{:.3} {:+.3}", blocks[i].yy.sqrt(), blocks[i].xy[OFFSET]))
            .collect();
        println!("{source:36} {:4} {}", own.len(), numbers.join("  "));
    }
    for (law, blocks) in laws.iter().zip(&found) {
        let raw: Vec<f64> = blocks.iter().map(|block| block.yy).collect();
        let bias = blocks.iter().map(|block| block.xy[OFFSET]).sum::<f64>() / blocks.len() as f64;
        let rms = |draw: &[usize]| (draw.iter().map(|i| raw[*i]).sum::<f64>() / draw.len() as f64).sqrt();
        let [low, high] = interval(raw.len(), rms);
        println!(
            "{}: rms by reference {:.3} [{low:.3}, {high:.3}], bias {bias:+.3}, by row {:.3}",
            law.name,
            mean(&raw).sqrt(),
            by_row(&blocks.iter().collect::<Vec<_>>(), &raw)
        );
    }
}

#[test]
fn the_oxide_to_blame() {
    let rows = measured();
    let groups = by_reference(&rows, false);
    let columns = dictionary(false);
    let mut table = Vec::new();
    for law in LAWS {
        let blocks = blocks(&groups, &columns, law);
        let all: Vec<&Block> = blocks.iter().collect();
        let raw: Vec<f64> = blocks.iter().map(|block| block.yy).collect();
        let offset = held_out(&all, &[OFFSET]);
        let base = held_out(&all, &[OFFSET, TAU]);
        println!(
            "{}: raw {:.3}, offset {:.3}, offset and tau {:.3}",
            law.name,
            mean(&raw).sqrt(),
            mean(&offset).sqrt(),
            mean(&base).sqrt()
        );
        table.push((law, "1/T".to_owned(), offset.clone(), base.clone(), all.len()));
        for (place, (name, value)) in oxides().iter().enumerate() {
            let carriers = groups.iter().filter(|(_, rows)| {
                rows.iter().any(|row| (value(row) - value(rows[0])).abs() > 0.0 || row.share(name) > 0.0)
            });
            let terms = [OFFSET, TAU, 2 + 2 * place, 3 + 2 * place];
            table.push((law, name.clone(), base.clone(), held_out(&all, &terms), carriers.count()));
        }
    }
    let gains = |before: &[f64], after: &[f64]| -> Vec<f64> {
        before.iter().zip(after).map(|(b, a)| b - a).collect()
    };
    let p: Vec<f64> = table.iter().map(|(_, _, before, after, _)| sign_flip(&gains(before, after))).collect();
    let stands = benjamini_hochberg(&p);
    println!(
        "{} of {} stand at a false discovery rate of 5 %",
        stands.iter().filter(|s| **s).count(),
        p.len()
    );
    for (i, (law, name, before, after, carriers)) in table.iter().enumerate() {
        let (ratio, [low, high]) = ratio(after, before);
        let better = gains(before, after).iter().filter(|gain| **gain > 0.0).count();
        println!(
            "{:20} {name:6} in {carriers:2} references: rms {:.3} -> {:.3}, ratio {ratio:.3} [{low:.3}, {high:.3}], \
             better on {better}, p {:.4}{}",
            law.name,
            mean(before).sqrt(),
            mean(after).sqrt(),
            p[i],
            if stands[i] { " *" } else { "" }
        );
    }
}

/// A law extended on the references but one, asked on that one.
struct Unseen {
    terms: Vec<usize>,
    beta: DVector<f64>,
    /// Mean square error without and with the extension.
    before: f64,
    after: f64,
}

/// The whole search within every fold.
fn extended(all: &[&Block], candidates: usize) -> Vec<Unseen> {
    let fold = |out: usize| {
        let others: Vec<&Block> = without(all, out).collect();
        let terms = chosen(&others, candidates);
        let beta = fit(others, &terms);
        Unseen { before: all[out].yy, after: all[out].left(&terms, &beta), terms, beta }
    };
    (0..all.len()).map(fold).collect()
}

/// The page about the study has this number.
fn written(number: &str) {
    assert!(
        include_str!("../../docs/why/slag-viscosity.md").contains(number),
        "docs/why/slag-viscosity.md lacks {number}"
    );
}

/// Prints an extension's gain; hands back the ratio's interval.
fn gain(what: &str, all: &[&Block], unseen: &[Unseen]) -> [f64; 2] {
    let before: Vec<f64> = unseen.iter().map(|fold| fold.before).collect();
    let after: Vec<f64> = unseen.iter().map(|fold| fold.after).collect();
    let gains: Vec<f64> = before.iter().zip(&after).map(|(b, a)| b - a).collect();
    let (by_reference, [low, high]) = ratio(&after, &before);
    println!(
        "{what}: rms {:.3} -> {:.3}, ratio {by_reference:.3} [{low:.3}, {high:.3}], better on {} of {}, p {:.4}",
        mean(&before).sqrt(),
        mean(&after).sqrt(),
        gains.iter().filter(|gain| **gain > 0.0).count(),
        all.len(),
        sign_flip(&gains)
    );
    written(&format!("{by_reference:.3} [{low:.3}, {high:.3}]"));
    let rows = |errors: &[f64]| -> Vec<f64> {
        all.iter().zip(errors).map(|(block, error)| block.rows as f64 * error).collect()
    };
    let (by_row_ratio, [by_row_low, by_row_high]) = ratio(&rows(&after), &rows(&before));
    println!(
        "    by row {:.3} -> {:.3}, ratio {by_row_ratio:.3} [{by_row_low:.3}, {by_row_high:.3}]",
        by_row(all, &before),
        by_row(all, &after)
    );
    [low, high]
}

fn names(columns: &[Column], terms: &[usize]) -> String {
    terms.iter().map(|term| columns[*term].0.as_str()).collect::<Vec<_>>().join(", ")
}

/// The search and its gain on references held out whole, as they were reported. The gain did not hold: see
/// [`the_choice_drawn_anew`].
#[test]
fn the_extension_on_references_held_out_whole() {
    let rows = measured();
    let columns = dictionary(true);
    assert_eq!(columns.len(), 30);
    let groups = by_reference(&rows, false);
    for law in LAWS {
        let blocks = blocks(&groups, &columns, law);
        let all: Vec<&Block> = blocks.iter().collect();
        let unseen = extended(&all, columns.len());
        println!("--- {}", law.name);
        for ((source, _), fold) in groups.iter().zip(&unseen) {
            let (before, after) = (fold.before.sqrt(), fold.after.sqrt());
            println!("{source:36} {before:.3} -> {after:.3}  {}", names(&columns, &fold.terms));
        }
        let [_, high] = gain(law.name, &all, &unseen);
        let base = held_out(&all, &[OFFSET, TAU]);
        let after: Vec<f64> = unseen.iter().map(|fold| fold.after).collect();
        let (against, [low, upper]) = ratio(&after, &base);
        println!("    against an offset and tau alone: ratio {against:.3} [{low:.3}, {upper:.3}]");
        let terms = chosen(&all, columns.len());
        let beta = fit(all.iter().copied(), &terms);
        for (i, term) in terms.iter().enumerate() {
            let [low, high] = interval(all.len(), |draw| fit(draw.iter().map(|d| all[*d]), &terms)[i]);
            println!("    {:12} {:+.9} [{low:+.3}, {high:+.3}]", columns[*term].0, beta[i]);
        }
        if law == &KALMANOVITCH_FRANK {
            let held = |number: &str| unseen.iter().filter(|f| names(&columns, &f.terms) == number).count();
            println!("    silica alone in {} folds", held("1, SiO2"));
            assert_eq!(names(&columns, &terms), "1, SiO2");
            assert!((beta[0] - SILICA_OFFSET).abs() < 1e-6);
            assert!((beta[1] - SILICA_SLOPE).abs() < 1e-6);
            assert!(high < 1.0, "the interval that was reported");
            rows_with_iron(&groups, &columns, &unseen);
            draw_gain(&groups, &unseen);
        }
    }
}

/// The 44 rows with iron, each corrected with what other references say.
fn rows_with_iron(groups: &Groups, columns: &[Column], unseen: &[Unseen]) {
    let law = &KALMANOVITCH_FRANK;
    let (mut count, mut before, mut after) = (0, 0.0, 0.0);
    for ((_, rows), fold) in groups.iter().zip(unseen) {
        let mut left = 0.0;
        for row in rows {
            let correction: f64 =
                fold.terms.iter().zip(&fold.beta).map(|(t, b)| b * columns[*t].1(row)).sum();
            let (raw, corrected) = (residual(row, law), residual(row, law) - correction);
            left += corrected * corrected / rows.len() as f64;
            if row.iron() > 0.0 {
                (count, before, after) = (count + 1, before + raw * raw, after + corrected * corrected);
            }
        }
        assert!((left - fold.after).abs() < 1e-9, "row by row the same as by products");
    }
    let rms = |sum: f64| (sum / f64::from(count)).sqrt();
    println!("    {count} rows with iron, held out: rms {:.3} -> {:.3}", rms(before), rms(after));
}

/// Would other choices than those fixed beforehand say something else?
#[test]
fn other_choices() {
    let rows = measured();
    let columns = dictionary(true);
    let law = &KALMANOVITCH_FRANK;
    let run = |what: &str, groups: Groups, columns: &[Column]| {
        let blocks = blocks(&groups, columns, law);
        let all: Vec<&Block> = blocks.iter().collect();
        gain(what, &all, &extended(&all, columns.len()));
    };
    run("with the copies", by_reference(&rows, true), &columns);
    let merged = |together: &[&str]| {
        let mut groups = by_reference(&rows, true);
        let one: Vec<&Measured> = groups
            .iter()
            .filter(|(source, _)| together.contains(source))
            .flat_map(|(_, rows)| rows.clone())
            .collect();
        groups.retain(|(source, _)| !together.contains(source));
        groups.push(("together", one));
        groups
    };
    let machin = "Machin and Hanna, JACS 28, 310,1945";
    run("Iida, Machin and Hanna, K1960 as one", merged(&["Iida et al. 2000", machin, "K1960"]), &columns);
    run("Machin's laboratory as one", merged(&["MY1954", machin]), &columns);
    let mut groups = by_reference(&rows, false);
    groups.retain(|(source, _)| *source != "MY1954");
    run("without MY1954", groups, &columns);
    let silica: Vec<Column> =
        dictionary(false).into_iter().filter(|(n, _)| n == "1" || n == "SiO2").collect();
    // These terms were chosen on all references: a little too good.
    for left_out in ["none", "MY1954"] {
        let mut groups = by_reference(&rows, false);
        groups.retain(|(source, _)| *source != left_out);
        let blocks = blocks(&groups, &silica, law);
        let all: Vec<&Block> = blocks.iter().collect();
        let raw: Vec<f64> = all.iter().map(|block| block.yy).collect();
        let fixed = held_out(&all, &[0, 1]);
        let (found, [low, high]) = ratio(&fixed, &raw);
        println!(
            "offset and SiO2 given, left out {left_out}: rms {:.3} -> {:.3}, ratio {found:.3} [{low:.3}, {high:.3}]",
            mean(&raw).sqrt(),
            mean(&fixed).sqrt()
        );
    }
}

/// What let the gain through: the reported interval draws the twelve held-out errors anew and takes
/// the choice of terms, the fit and the references behind them as given. Here the references
/// themselves are drawn, the whole search and fit is repeated on those that were drawn, and asked
/// on those that were not.
#[test]
fn the_choice_drawn_anew() {
    const REDRAWS: usize = 400;
    let rows = measured();
    let columns = dictionary(true);
    let groups = by_reference(&rows, false);
    let blocks = blocks(&groups, &columns, &KALMANOVITCH_FRANK);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let (mut ratios, mut silica_alone, mut worse) = (Vec::new(), 0, 0);
    while ratios.len() < REDRAWS {
        let drawn: std::collections::BTreeSet<usize> =
            blocks.iter().map(|_| (random.next_u64() % blocks.len() as u64) as usize).collect();
        let (seen, unseen): (Vec<usize>, Vec<usize>) = (0..blocks.len()).partition(|i| drawn.contains(i));
        if seen.len() < 3 || unseen.is_empty() {
            continue;
        }
        let train: Vec<&Block> = seen.iter().map(|i| &blocks[*i]).collect();
        let terms = chosen(&train, columns.len());
        let beta = fit(train, &terms);
        let sum = |error: &dyn Fn(&Block) -> f64| unseen.iter().map(|i| error(&blocks[*i])).sum::<f64>();
        let ratio = (sum(&|block| block.left(&terms, &beta)) / sum(&|block| block.yy)).sqrt();
        silica_alone += usize::from(names(&columns, &terms) == "1, SiO2");
        worse += usize::from(ratio > 1.0);
        ratios.push(ratio);
    }
    ratios.sort_by(f64::total_cmp);
    let (low, middle, high) = (ratios[REDRAWS / 40], ratios[REDRAWS / 2], ratios[REDRAWS - 1 - REDRAWS / 40]);
    println!(
        "choice and fit on drawn references, asked on the others: ratio {middle:.3} [{low:.3}, {high:.3}], \
         worse in {worse} of {REDRAWS}, silica alone in {silica_alone}"
    );
    written(&format!("{middle:.3} [{low:.3}, {high:.3}]"));
    assert!(high > 1.0, "the gain does not hold when the choice is drawn anew");
    let mut includes_one = 0;
    for (out, (source, _)) in groups.iter().enumerate() {
        let kept: Vec<&Block> =
            blocks.iter().enumerate().filter(|(i, _)| *i != out).map(|(_, block)| block).collect();
        let unseen = extended(&kept, columns.len());
        let errors = |part: fn(&Unseen) -> f64| unseen.iter().map(part).collect::<Vec<f64>>();
        let (found, [low, high]) = ratio(&errors(|fold| fold.after), &errors(|fold| fold.before));
        println!("    without {source:36} ratio {found:.3} [{low:.3}, {high:.3}]");
        includes_one += usize::from(high > 1.0);
    }
    assert_eq!(includes_one, 7, "docs/why/slag-viscosity.md says seven of twelve");
}

/// The range of Urbain's and of Kalmanovitch and Frank's law is what was measured.
#[test]
fn the_stated_range_is_that_of_the_table() {
    let rows = measured();
    for row in &rows {
        let slag = SlagViscosity::new(&KALMANOVITCH_FRANK, &row.composition()).unwrap();
        assert!(slag.holds_at(row.temperature), "{} at {} K", row.source, row.temperature);
    }
    for (oxide, low, high) in measured_range::MEASURED_OXIDES {
        let shares = rows.iter().map(|row| row.share(oxide.name()));
        let most = shares.clone().fold(0.0, f64::max);
        let least = shares.fold(100.0, f64::min);
        assert!(high - most < 0.2 && least - low < 0.2, "{}: {least} to {most}", oxide.name());
    }
    let iron = rows.iter().map(Measured::iron).fold(0.0, f64::max);
    assert!(measured_range::MOST_IRON - iron < 0.2, "{iron}");
    let temperatures = rows.iter().map(|row| row.temperature);
    let [low, high] = measured_range::MEASURED_TEMPERATURES;
    assert!(temperatures.clone().fold(f64::INFINITY, f64::min) - low < 1.0);
    assert!(high - temperatures.fold(0.0, f64::max) < 1.0);
}

const BINS: [f64; 9] = [30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.1];

/// Where on the silica axis the laws are wrong; the references that have rows in a bin weigh the same there.
#[test]
fn residuals_along_silica() {
    let rows = measured();
    let groups = by_reference(&rows, false);
    let laws: Vec<&'static ViscosityLaw> = LAWS.into_iter().chain([&SILICA_CORRECTED]).collect();
    let mut lines: Vec<Vec<[f64; 2]>> = vec![Vec::new(); laws.len()];
    println!(
        "SiO2 [wt%], references, rows: mean residual of {:?}",
        laws.iter().map(|l| l.name).collect::<Vec<_>>()
    );
    for bin in BINS.windows(2) {
        let inside: Vec<Vec<&Measured>> = groups
            .iter()
            .map(|(_, rows)| {
                let inside = rows.iter().filter(|row| (bin[0]..bin[1]).contains(&row.share("SiO2")));
                inside.copied().collect::<Vec<_>>()
            })
            .filter(|rows| !rows.is_empty())
            .collect();
        let bias = |law: &'static ViscosityLaw| {
            let of = |rows: &Vec<&Measured>| mean(&rows.iter().map(|r| residual(r, law)).collect::<Vec<_>>());
            mean(&inside.iter().map(of).collect::<Vec<_>>())
        };
        let found: Vec<f64> = laws.iter().map(|law| bias(law)).collect();
        let count: usize = inside.iter().map(Vec::len).sum();
        let numbers: Vec<String> = found.iter().map(|f| format!("{f:+.3}")).collect();
        println!("{:.0} to {:.0}, {:2}, {count:4}: {}", bin[0], bin[1], inside.len(), numbers.join(" "));
        let middle = (bin[0] + bin[1]) / 2.0;
        lines.iter_mut().zip(found).for_each(|(line, f)| line.push([middle, f]));
    }
    draw_residuals(&laws, &lines);
}

/// Writes a figure to `docs/images` when `NEARWALL_BLESS` is set.
fn keep(figure: &nearwall_lab::report::Figure) {
    if std::env::var_os("NEARWALL_BLESS").is_some() {
        let path = format!("{}/../docs/images/{}.svg", env!("CARGO_MANIFEST_DIR"), figure.id);
        let white = "><rect width=\"100%\" height=\"100%\" fill=\"white\"/>";
        std::fs::write(path, figure.svg.replacen('>', white, 1) + "\n").unwrap();
    }
}

fn draw_residuals(laws: &[&'static ViscosityLaw], lines: &[Vec<[f64; 2]>]) {
    let chart = nearwall_lab::report::Chart::new(
        "Where the viscosity laws are wrong",
        "SiO2 [wt%]",
        "log10(law) - log10(measured)",
    );
    let chart = laws.iter().zip(lines).fold(chart, |chart, (law, line)| chart.line(law.name, line));
    keep(&chart.x_range(30.0, 70.0).mark_y(0.0, "").figure("slag-viscosity-silica", ""));
}

fn draw_gain(groups: &Groups, unseen: &[Unseen]) {
    let short = |source: &str| match source {
        "MY1954" => "MY54".to_owned(),
        _ if source.starts_with("Machin") => "MH45".to_owned(),
        _ => source.split(' ').next().unwrap().chars().take(6).collect(),
    };
    let names: Vec<String> = groups.iter().map(|(source, _)| short(source)).collect();
    let of = |part: fn(&Unseen) -> f64| unseen.iter().map(|fold| part(fold).sqrt()).collect::<Vec<_>>();
    let bars =
        nearwall_lab::report::BarChart::new("Error on references held out whole", "rms of log10", &names)
            .series("Kalmanovitch-Frank", &of(|fold| fold.before))
            .series("extended on the other references", &of(|fold| fold.after));
    keep(&bars.figure("slag-viscosity-held-out", ""));
}
