//! The fuzzer's bytes as choices and numbers; zeros when they run out.

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
