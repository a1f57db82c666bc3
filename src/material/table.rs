//! A table: values between which a property is linear in temperature.

/// Points of a table with rising temperatures, as the straight lines between them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PropertyTable {
    lines: Vec<TableSegment>,
    /// Temperature [K] and value of the last point.
    last: [f64; 2],
}

/// The straight line from a point of a table to the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TableSegment {
    /// Temperature [K] of the point.
    from: f64,
    value: f64,
    /// Per kelvin.
    slope: f64,
}

impl TableSegment {
    #[inline(always)]
    fn at(self, temperature: f64) -> f64 {
        self.value + self.slope * (temperature - self.from)
    }
}

impl PropertyTable {
    /// A table of two or more points with rising temperatures [K]; `None` for fewer.
    pub fn new(temperatures: &[f64], values: &[f64]) -> Option<Self> {
        let points: Vec<[f64; 2]> = temperatures.iter().zip(values).map(|(t, v)| [*t, *v]).collect();
        let line = |pair: &[[f64; 2]]| {
            let [[from, value], [to, next]] = [pair[0], pair[1]];
            TableSegment { from, value, slope: (next - value) / (to - from) }
        };
        let lines: Vec<TableSegment> = points.windows(2).map(line).collect();
        let last = *points.last()?;
        (!lines.is_empty()).then_some(Self { lines, last })
    }

    /// Temperature [K] and value of every point.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.lines.iter().map(|line| [line.from, line.value]).chain([self.last])
    }

    /// The table with each value changed.
    pub fn mapped(self, change: impl Fn(f64) -> f64) -> Self {
        let [temperatures, values]: [Vec<f64>; 2] =
            [0, 1].map(|which| self.points().map(|point| point[which]).collect());
        let changed: Vec<f64> = values.into_iter().map(change).collect();
        Self::new(&temperatures, &changed).unwrap_or(self)
    }

    /// First and last temperature [K].
    pub fn range(&self) -> [f64; 2] {
        [self.lines.first().map_or(self.last[0], |line| line.from), self.last[0]]
    }

    /// The value at a temperature [K]; beyond the ends on the first or the last line.
    #[inline(always)]
    pub fn at(&self, temperature: f64) -> f64 {
        // The lines are few: to count them takes less time than a search with its branches.
        let beyond = self.lines.iter().skip(1).filter(|line| line.from < temperature).count();
        self.lines[beyond].at(temperature)
    }

    /// As [`Self::at`] for many temperatures [K]: one pass over them for each line, which the
    /// compiler turns into vector instructions.
    #[inline(always)]
    pub fn each(&self, temperatures: &[f64], out: &mut [f64]) {
        for (number, line) in self.lines.iter().enumerate() {
            for (value, temperature) in out.iter_mut().zip(temperatures) {
                let here = line.at(*temperature);
                *value = if number == 0 || line.from < *temperature { here } else { *value };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_its_points_and_is_linear_between_them() {
        let table = PropertyTable::new(&[300.0, 400.0, 800.0], &[1.0, 3.0, 2.0]).unwrap();
        let temperatures = [300.0, 350.0, 400.0, 600.0, 800.0];
        let mut each = [0.0; 5];
        table.each(&temperatures, &mut each);
        assert_eq!(each, [1.0, 2.0, 3.0, 2.5, 2.0]);
        assert_eq!(temperatures.map(|temperature| table.at(temperature)), each);
        assert_eq!(table.range(), [300.0, 800.0]);
        assert_eq!(table.points().collect::<Vec<_>>(), [[300.0, 1.0], [400.0, 3.0], [800.0, 2.0]]);
        assert_eq!(PropertyTable::new(&[300.0], &[1.0]), None);
    }
}
