//! Dimensionless products of columns whose units are known, as `d/gap` or `v_n tau/d` (Buckingham 1914): the simplest,
//! of two and three columns, with exponents in halves up to 2. One of them at least is no input: for inputs alone the
//! library has its groups.

use super::data_split::{ColumnKind, Covariate};
use crate::dataset::{ColumnValues, UnitPowers, unit_powers};

/// Most products of a file.
const MOST_PRODUCTS: usize = 12;
/// Most columns of a file that are looked at: triples of hundreds would take minutes.
const MOST_FACTORS: usize = 24;
/// Largest exponent [halves].
const LARGEST: i32 = 4;

/// A product of powers of columns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColumnProduct {
    /// Columns by place, with their exponents [1].
    pub factors: Vec<(usize, f64)>,
}

/// A column that can be a factor.
struct Factor {
    place: usize,
    powers: UnitPowers,
    /// Whether some row has 0: it must not be divided by.
    has_zero: bool,
}

impl ColumnProduct {
    /// As in `omega d/v_n`.
    pub fn name(&self, columns: &[Covariate]) -> String {
        let power = |(place, exponent): &(usize, f64)| match exponent.abs() {
            1.0 => columns[*place].name.clone(),
            exponent => format!("{}^{exponent}", columns[*place].name),
        };
        let of = |sign: f64| self.factors.iter().filter(move |(_, exponent)| exponent * sign > 0.0);
        let [above, below] = [1.0, -1.0].map(|sign| of(sign).map(power).collect::<Vec<String>>());
        let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
        match below.as_slice() {
            [] => above,
            [one] => format!("{above}/{one}"),
            several => format!("{above}/({})", several.join(" ")),
        }
    }

    /// Its value in each row; NaN where a factor is blank.
    pub fn values(&self, columns: &[Covariate]) -> Vec<f64> {
        let rows = self.factors.first().map_or(0, |(place, _)| columns[*place].blank.len());
        let factor = |row: usize, (place, exponent): &(usize, f64)| columns[*place].cell(row).powf(*exponent);
        (0..rows).map(|row| self.factors.iter().map(|one| factor(row, one)).product()).collect()
    }
}

/// The simplest dimensionless products of the columns.
pub(super) fn products(columns: &[Covariate]) -> Vec<ColumnProduct> {
    let factors = (0..columns.len()).filter_map(|place| factor(columns, place));
    let factors: Vec<Factor> = factors.take(MOST_FACTORS).collect();
    let mut found: Vec<(i32, ColumnProduct)> = Vec::new();
    let count = factors.len();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| vec![a, b]));
    let triples =
        (0..count).flat_map(|a| (a + 1..count).flat_map(move |b| (b + 1..count).map(move |c| vec![a, b, c])));
    let has_further =
        |chosen: &Vec<usize>| chosen.iter().any(|place| !columns[factors[*place].place].is_input());
    for chosen in pairs.chain(triples).filter(has_further) {
        let of: Vec<&Factor> = chosen.iter().map(|place| &factors[*place]).collect();
        // What two of three make without the third is a product of its own.
        let has_smaller = of.len() > 2
            && (0..of.len()).any(|without| {
                let rest: Vec<&Factor> = of
                    .iter()
                    .enumerate()
                    .filter(|(place, _)| *place != without)
                    .map(|(_, one)| *one)
                    .collect();
                simplest(&rest).is_some()
            });
        if let Some(exponents) = simplest(&of).filter(|_| !has_smaller) {
            let size = 10 * of.len() as i32 + exponents.iter().map(|one| one.abs()).sum::<i32>();
            found.push((size, product(&of, &exponents)));
        }
    }
    found.sort_by_key(|(size, _)| *size);
    found.into_iter().take(MOST_PRODUCTS).map(|(_, product)| product).collect()
}

/// A column of numbers with a unit, not negative; `None` for others.
fn factor(columns: &[Covariate], place: usize) -> Option<Factor> {
    let column = &columns[place];
    let ColumnValues::Numbers(numbers) = &column.values else { return None };
    let powers = unit_powers(column.unit).filter(|powers| *powers != UnitPowers::default())?;
    let usable = !column.is_group() && numbers.iter().all(|number| *number >= 0.0);
    let has_zero = numbers.contains(&0.0);
    usable.then_some(Factor { place, powers, has_zero })
}

/// The smallest exponents without a unit [whole numbers]; `None` if there are none.
fn simplest(of: &[&Factor]) -> Option<Vec<i32>> {
    let choices = |count: usize| {
        let all: Vec<i32> = (-LARGEST..=LARGEST).filter(|one| *one != 0).collect();
        let width = all.len();
        let number = width.pow(count as u32);
        (0..number).map(move |code| {
            (0..count).map(|place| all[code / width.pow(place as u32) % width]).collect::<Vec<i32>>()
        })
    };
    let is_possible = |exponents: &Vec<i32>| {
        let power = |base: usize| of.iter().zip(exponents).map(|(one, k)| one.powers[base] * k).sum::<i32>();
        let divides = of.iter().zip(exponents).any(|(one, exponent)| one.has_zero && *exponent < 0);
        let upright = of.iter().any(|one| one.has_zero) || exponents[0] > 0;
        (0..4).all(|base| power(base) == 0) && !divides && upright
    };
    let size = |exponents: &Vec<i32>| exponents.iter().map(|one| one.abs()).sum::<i32>();
    choices(of.len()).filter(is_possible).min_by_key(size)
}

/// The product with these exponents, halved where one is above 2.
fn product(of: &[&Factor], exponents: &[i32]) -> ColumnProduct {
    let is_large = exponents.iter().any(|exponent| exponent.abs() > LARGEST / 2);
    let share = if is_large { 0.5 } else { 1.0 };
    let factors = of.iter().zip(exponents).map(|(one, exponent)| (one.place, share * f64::from(*exponent)));
    ColumnProduct { factors: factors.collect() }
}

/// The factors by name, and the columns of the file among them with their medians.
pub(super) fn kind(product: &ColumnProduct, columns: &[Covariate]) -> ColumnKind {
    let named = |(place, exponent): &(usize, f64)| (columns[*place].name.clone(), *exponent);
    let stated =
        product.factors.iter().map(|(place, _)| &columns[*place]).filter(|column| !column.is_input());
    ColumnKind::Group {
        factors: product.factors.iter().map(named).collect(),
        needs: stated.map(|column| (column.name.clone(), column.median())).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, unit: &'static str, numbers: &[f64]) -> Covariate {
        Covariate::new(name, unit, ColumnValues::Numbers(numbers.to_vec()), ColumnKind::Further)
    }

    fn names(columns: &[Covariate]) -> Vec<String> {
        products(columns).iter().map(|product| product.name(columns)).collect()
    }

    #[test]
    fn products_have_no_unit_and_are_simple() {
        let columns = [
            column("v_n", "m/s", &[1.0, 2.0]),
            column("v_t", "m/s", &[0.0, 2.0]),
            column("d", "m", &[1e-4, 2e-4]),
            column("tau", "s", &[1.0, 3.0]),
            column("humidity", "", &[1.0, 3.0]),
        ];
        assert_eq!(names(&columns), ["v_t/v_n", "v_n tau/d", "v_t tau/d"]);
        let first = &products(&columns)[1];
        let values = first.values(&columns);
        assert!((values[1] - 2.0 * 3.0 / 2e-4).abs() < 1e-9, "{values:?}");
    }

    #[test]
    fn exponents_are_halves_up_to_two() {
        // Bond's number without gravity's constant: acceleration, length and speed.
        let columns = [
            column("a", "m/s2", &[1.0, 2.0]),
            column("l", "m", &[1.0, 2.0]),
            column("u", "m/s", &[1.0, 2.0]),
        ];
        assert_eq!(names(&columns), ["a l/u^2"]);
        assert!(names(&columns[..2]).is_empty());
        // Volume and area: V^(2/3)/A has no halves; V/A^1.5 has.
        assert_eq!(names(&[column("V", "m3", &[1.0, 2.0]), column("A", "m2", &[1.0, 2.0])]), ["V/A^1.5"]);
    }
}
