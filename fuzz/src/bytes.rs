//! The fuzzer's bytes read as choices and numbers; zeros after their end.

/// Numbers that break arithmetic.
const HOSTILE: [f64; 20] = [
    0.0,
    -0.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    2.225_073_858_507_201e-308, // the largest denormal
    1e-300,
    1e-30,
    1e-4,
    1.0,
    300.0,
    1e30,
    1e300,
    f64::MAX,
    -1.0,
    -f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    -f64::NAN,
];

pub struct Bytes<'a>(pub &'a [u8]);

impl<'a> Bytes<'a> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn take(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(count.min(self.0.len()));
        self.0 = rest;
        taken
    }

    pub fn byte(&mut self) -> u8 {
        self.take(1).first().copied().unwrap_or(0)
    }

    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub fn word(&mut self) -> u64 {
        let mut word = [0; 8];
        let taken = self.take(8);
        word[..taken.len()].copy_from_slice(taken);
        u64::from_le_bytes(word)
    }

    /// A hostile number, any bits at all, or an ordinary number.
    pub fn number(&mut self) -> f64 {
        match self.byte() {
            choice if usize::from(choice) < HOSTILE.len() => HOSTILE[usize::from(choice)],
            choice if choice < 64 => f64::from_bits(self.word()),
            choice => 10f64.powf((f64::from(choice) - 160.0) / 16.0),
        }
    }
}

/// Numbers as text in a file.
pub const WRITTEN: [&str; 28] = [
    "0",
    "-0.0",
    "1",
    "2",
    "0.5",
    "0.999",
    "-1",
    "-0.5",
    "1e-3",
    "1e-6",
    "1e-9",
    "1e-30",
    "1e-300",
    "5e-324",
    "10",
    "90",
    "300",
    "1e3",
    "1800",
    "1e5",
    "1e8",
    "1e30",
    "1e300",
    "1.7e308",
    "nan",
    "inf",
    "9223372036854775807",
    "[1, 2, 3]",
];

/// An accepted file with some of its numbers replaced: each pair of bytes selects a number and its replacement.
pub fn with_other_numbers(whole: &str, bytes: &[u8]) -> String {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '-' | '+');
    let mut numbers = Vec::new();
    let mut at = 0;
    for line in whole.split_inclusive('\n') {
        // Right of the first equals sign and left of a comment.
        let end = line.find('#').unwrap_or(line.len());
        let mut place = line[..end].find('=').unwrap_or(end);
        while let Some(start) = line[place..end].find(|c: char| c.is_ascii_digit()) {
            let start = place + start;
            let size = line[start..end].find(|c| !is_part(c)).unwrap_or(end - start);
            numbers.push(at + start..at + start + size);
            place = start + size;
        }
        at += line.len();
    }
    let mut changes: Vec<(usize, &str)> = bytes
        .chunks_exact(2)
        .take(6)
        .map(|pair| (usize::from(pair[0]) % numbers.len(), WRITTEN[usize::from(pair[1]) % WRITTEN.len()]))
        .collect();
    changes.sort_by_key(|change| std::cmp::Reverse(change.0));
    changes.dedup_by_key(|change| change.0);
    let mut text = whole.to_owned();
    for (which, number) in changes {
        text.replace_range(numbers[which].clone(), number);
    }
    text
}

/// The text of a file. Bytes that begin with one of 0xF8 to 0xFF, as no UTF-8 text does, select a file of `wholes` and
/// replace numbers in it; other bytes are the text itself.
pub fn file<'a>(wholes: &[&str], bytes: &'a [u8]) -> Option<std::borrow::Cow<'a, str>> {
    match bytes {
        [first @ 0xF8..=0xFF, which, rest @ ..] => {
            let whole = wholes[usize::from(first ^ which) % wholes.len()];
            Some(with_other_numbers(whole, rest).into())
        }
        _ => std::str::from_utf8(bytes).ok().map(Into::into),
    }
}
