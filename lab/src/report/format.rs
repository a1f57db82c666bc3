//! Numbers as text for a reader.

/// What the names of regimes mean, for captions.
pub const REGIME_NAMES: &str =
    "SP, NSP: sticky and non-sticky particle; SW, NSW: sticky and non-sticky wall.";

/// A number with four significant digits, in powers of ten below 0.001 and from 1e6 on; a dash where it is not finite.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let trimmed = |digits: &str| digits.trim_end_matches('0').trim_end_matches('.').to_owned();
    let magnitude = value.abs().log10().floor();
    if !(-3.0..6.0).contains(&magnitude) {
        let text = format!("{value:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", trimmed(digits));
    }
    if value.fract() == 0.0 {
        return format!("{value:.0}");
    }
    let text = format!("{value:.*}", (3.0 - magnitude).max(0.0) as usize);
    if text.contains('.') { trimmed(&text) } else { text }
}

/// Lengths up to this one [m] are shown in µm.
const LONGEST_IN_MICROMETRES: f64 = 2e-3;

/// How values of an SI unit are shown of which this is the largest: a factor and the name of the unit.
pub fn shown_unit(unit: &str, largest: f64) -> (f64, String) {
    match unit {
        "m" if largest.abs() <= LONGEST_IN_MICROMETRES => (1e6, "µm".to_owned()),
        _ => (1.0, unit.replace("m2", "m²").replace("m3", "m³")),
    }
}

/// How times [s] up to the longest one are shown: the seconds of a unit, and its name.
pub fn time_unit(longest: f64) -> (f64, &'static str) {
    match longest {
        seconds if seconds > 5.0 * 3600.0 => (3600.0, "h"),
        seconds if seconds > 300.0 => (60.0, "min"),
        _ => (1.0, "s"),
    }
}

/// A time [s] in the unit that fits.
pub fn duration(seconds: f64) -> String {
    let (length, unit) = time_unit(seconds);
    format!("{} {unit}", number(seconds / length))
}

/// A mean with its standard deviation, both to the second digit of the deviation.
pub fn with_deviation(mean: f64, deviation: f64) -> String {
    let [mean, deviation] = [mean, deviation].map(|value| number(rounded(value, deviation)));
    format!("{mean} ± {deviation}")
}

/// A value and its interval, all to the second digit of half the interval: "0.17" and "0 to 1.5".
pub fn with_interval(value: f64, [low, high]: [f64; 2]) -> (String, String) {
    let [value, low, high] = [value, low, high].map(|one| number(rounded(one, 0.5 * (high - low))));
    (value, format!("{low} to {high}"))
}

/// A value to the second digit of what it is uncertain by.
fn rounded(value: f64, uncertain_by: f64) -> f64 {
    if !uncertain_by.is_finite() || uncertain_by == 0.0 {
        return value;
    }
    let unit = 10f64.powf(uncertain_by.abs().log10().floor() - 1.0);
    (value / unit).round() * unit
}

/// A number with its unit; shares (unit `1` or empty) have none.
pub fn with_unit(value: f64, unit: &str) -> String {
    let (factor, unit) = shown_unit(unit, value);
    format!("{}{}", number(factor * value), behind(&unit))
}

/// A unit behind a number; nothing for one without.
fn behind(unit: &str) -> String {
    if unit == "1" || unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// Two numbers with their unit: "5 to 200 µm".
pub fn span([low, high]: [f64; 2], unit: &str) -> String {
    let (factor, unit) = shown_unit(unit, low.abs().max(high.abs()));
    format!("{} to {}{}", number(factor * low), number(factor * high), behind(&unit))
}

/// A share in per cent.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    match value.abs() {
        size if !size.is_finite() => "–".to_owned(),
        0.0 => "0 %".to_owned(),
        100.0 => format!("{value} %"),
        size if size >= 0.1 => format!("{value:.1} %"),
        size if size >= 1e-4 => format!("{value:.*} %", (1.0 - size.log10().floor()) as usize),
        _ => format!("{value:.1e} %"),
    }
}

/// A probability as the number of trials in which it happens once, with two digits.
pub fn once_in(probability: f64) -> String {
    if probability < 1e-12 {
        return "> 1e12".to_owned();
    }
    let trials: f64 = format!("{:.1e}", 1.0 / probability).parse().unwrap_or(f64::NAN);
    number(trials)
}

/// How often something of this probability happens by chance, in words: "once in 43 data sets".
pub fn by_chance(probability: f64) -> String {
    match probability {
        p if !p.is_finite() => "in an unknown share of data sets".to_owned(),
        p if p > 0.995 => "in nearly all data sets".to_owned(),
        p if p >= 0.1 => format!("in {:.0} % of data sets", 100.0 * p),
        p if p < 1e-12 => "less than once in 1e12 data sets".to_owned(),
        p => format!("once in {} data sets", once_in(p)),
    }
}

/// A share in whole per cent; one that is not quite nothing or all does not become it by rounding.
pub fn whole_percent(share: f64) -> String {
    match (100.0 * share).round() {
        value if !value.is_finite() => "–".to_owned(),
        0.0 if share > 0.0 => "less than 1 %".to_owned(),
        100.0 if share < 1.0 => "more than 99 %".to_owned(),
        value => format!("{value:.0} %"),
    }
}

/// The items in a sentence: "a, b or c" with the conjunction `last`.
pub fn listed<T: AsRef<str>>(items: &[T], last: &str) -> String {
    match items {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [first @ .., end] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", first.join(", "), end.as_ref())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let short = [0.0, 1.0, 0.123_456, 12.345_67, 123_456.0, 0.000_012_34, 2.5e9, f64::NAN].map(number);
        assert_eq!(short, ["0", "1", "0.1235", "12.35", "123456", "1.234e-5", "2.5e9", "–"]);
    }

    #[test]
    fn small_lengths_are_in_micrometres() {
        let [short, long] = [[5e-6, 2e-4], [5e-6, 0.2]].map(|ends| span(ends, "m"));
        assert_eq!((short.as_str(), long.as_str()), ("5 to 200 µm", "5e-6 to 0.2 m"));
        assert_eq!((with_unit(7.5e-5, "m").as_str(), with_unit(0.4, "J/m2").as_str()), ("75 µm", "0.4 J/m²"));
        assert_eq!((with_unit(0.5, "1").as_str(), span([0.1, 0.5], "1").as_str()), ("0.5", "0.1 to 0.5"));
    }

    #[test]
    fn times_have_the_unit_that_fits() {
        assert_eq!([0.02, 300.0, 3600.0, 86_400.0].map(duration), ["0.02 s", "300 s", "60 min", "24 h"]);
    }

    #[test]
    fn a_mean_has_no_more_digits_than_its_deviation() {
        let pairs = [(3.4641, 0.7834), (63.52, 21.9), (6.988e-4, 0.0016), (1.0, 0.0), (1234.0, 210.0)];
        let texts = pairs.map(|(mean, deviation)| with_deviation(mean, deviation));
        let (value, interval) = with_interval(0.1721, [8.4e-7, 1.512]);
        assert_eq!((value.as_str(), interval.as_str()), ("0.17", "0 to 1.51"));
        assert_eq!(texts, ["3.46 ± 0.78", "64 ± 22", "7e-4 ± 0.0016", "1 ± 0", "1230 ± 210"]);
    }

    #[test]
    fn shares_keep_two_digits() {
        let short = [0.0, 0.1234, 0.000_057, 1.0, 1e-9, f64::NAN].map(percent);
        assert_eq!(short, ["0 %", "12.3 %", "0.0057 %", "100 %", "1.0e-7 %", "–"]);
    }

    #[test]
    fn probabilities_are_odds_of_chance() {
        assert_eq!([0.0, 2.1e-10, 0.0234, 0.5].map(once_in), ["> 1e12", "4.8e9", "43", "2"]);
        let words = ["less than once in 1e12", "once in 4.8e9", "once in 43", "in 50 % of", "in nearly all"];
        let words = words.map(|words| format!("{words} data sets"));
        assert_eq!([0.0, 2.1e-10, 0.0234, 0.5, 0.9999].map(by_chance), words);
    }

    #[test]
    fn a_rounded_share_is_not_nothing_and_not_all() {
        let short = [0.0, 0.001, 0.855, 0.999, 1.0].map(whole_percent);
        assert_eq!(short, ["0 %", "less than 1 %", "86 %", "more than 99 %", "100 %"]);
    }

    #[test]
    fn a_list_ends_with_its_conjunction() {
        assert_eq!(listed(&["a"], "or"), "a");
        assert_eq!(listed(&["a", "b", "c"], "or"), "a, b or c");
    }
}
