//! Which rows of a large file are kept in memory.
//!
//! Up to [`MOST_ROWS`] usable rows all are kept. Of a larger file a share of the groups is kept,
//! and a share of the rows of each of these groups. A group is a set of rows with the same cells in
//! all columns that tell groups apart; a file without such columns is one group. Every row is kept
//! with the same probability. Small groups stay whole and large ones stay present, so that errors
//! that rows share are still seen.
//!
//! Both shares begin at 1 and fall whenever there are too many rows. Whether a row is kept depends
//! only on both shares, its line and its cells, so the same file gives the same rows.

use std::collections::HashMap;

use super::measurements::Measurement;
use nearwall::rng::ImpactRng;

/// Largest number of rows that are kept: a quarter of four fifths of them measures the gain, which needs 20,000.
pub const MOST_ROWS: usize = 100_000;
/// The share of groups falls as long as most rows are in groups with no more rows than this,
/// otherwise the share of rows.
const LARGE_GROUP: usize = 100;
/// Factor on a share when there are too many rows.
const SHARE_STEP: f64 = 0.8;
/// Seed of the draws.
const SELECTION_SEED: u64 = 0x726f_7773;
/// Streams of the draws.
const OF_GROUP: u64 = 0;
const OF_ROW: u64 = 1;
/// An observation with fewer kept rows is noted.
const FEW_OBSERVATIONS: usize = 30;
/// What is counted, in the order of [`observed`].
const COUNTED_OBSERVATIONS: [&str; 4] = ["e_n", "e_t", "a capture", "a rebound"];

/// Draws of a row and its group.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ticket {
    /// Hash of the group.
    group: u64,
    /// Uniformly distributed between 0 and 1; equal in all rows of a group.
    of_group: f64,
    /// The same for each row.
    of_row: f64,
}

impl Ticket {
    /// The ticket of the row on this line; `groups` are its cells in the columns that tell groups
    /// apart. A row without these cells is a group of its own if there are such columns.
    pub(super) fn new<'a>(line: u64, groups: impl Iterator<Item = &'a str> + Clone) -> Self {
        let alone = groups.clone().next().is_some() && groups.clone().all(str::is_empty);
        let group = if alone { line } else { groups.fold(FNV_OFFSET, hashed) };
        let of_group = ImpactRng::new(SELECTION_SEED, group).uniform(OF_GROUP);
        Self { group, of_group, of_row: ImpactRng::new(SELECTION_SEED, line).uniform(OF_ROW) }
    }
}

/// Hash FNV-1a of 64 bits (Fowler, Noll, Vo).
const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0100_0000_01b3;

/// The hash after one more cell, and a byte that no UTF-8 text contains.
fn hashed(hash: u64, cell: &str) -> u64 {
    let one = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(FNV_PRIME);
    one(cell.bytes().fold(hash, one), 0xff)
}

/// The rows that are kept so far.
#[derive(Debug)]
pub(super) struct RowSelection {
    /// Largest number of kept rows.
    most: usize,
    /// Share of the groups, and of the rows of a kept group.
    groups: f64,
    rows: f64,
    kept: Vec<Ticket>,
    /// Rows that are not kept.
    others: usize,
    /// Rows with each observation among them.
    observed: [usize; COUNTED_OBSERVATIONS.len()],
}

impl RowSelection {
    pub(super) fn new(most: usize) -> Self {
        let observed = Default::default();
        Self { most, groups: 1.0, rows: 1.0, kept: Vec::new(), others: 0, observed }
    }

    /// Largest number of kept rows.
    pub(super) fn most(&self) -> usize {
        self.most
    }

    /// Number of rows that are not kept.
    pub(super) fn others(&self) -> usize {
        self.others
    }

    /// Whether a new row is kept.
    pub(super) fn keeps(&mut self, ticket: Ticket) -> bool {
        let keeps = self.accepts(&ticket);
        if keeps && self.most < usize::MAX {
            self.kept.push(ticket);
        }
        keeps
    }

    fn accepts(&self, ticket: &Ticket) -> bool {
        ticket.of_group < self.groups && ticket.of_row < self.rows
    }

    /// Counts a row that is not kept.
    pub(super) fn count(&mut self, row: &Measurement) {
        self.others += 1;
        self.observed.iter_mut().zip(observed(row)).for_each(|(sum, one)| *sum += usize::from(one));
    }

    /// For each kept row whether it is still kept, if there are too many.
    pub(super) fn shrink(&mut self) -> Option<Vec<bool>> {
        if self.kept.len() <= self.most {
            return None;
        }
        let before = self.kept.clone();
        while self.kept.len() > self.most {
            let share = if self.is_in_large_groups() { &mut self.rows } else { &mut self.groups };
            *share *= SHARE_STEP;
            let kept = std::mem::take(&mut self.kept);
            self.kept = kept.into_iter().filter(|ticket| self.accepts(ticket)).collect();
        }
        Some(before.iter().map(|ticket| self.accepts(ticket)).collect())
    }

    /// Whether most kept rows are in large groups.
    fn is_in_large_groups(&self) -> bool {
        let mut sizes: HashMap<u64, usize> = HashMap::new();
        for ticket in &self.kept {
            *sizes.entry(ticket.group).or_default() += 1;
        }
        let large: usize = sizes.values().filter(|size| **size > LARGE_GROUP).sum();
        2 * large > self.kept.len()
    }

    /// What the reader must know of the choice of these `rows`; `groups` are the columns that tell groups apart.
    pub(super) fn notes(&self, rows: &[Measurement], groups: &[String]) -> Vec<String> {
        if self.others == 0 {
            return Vec::new();
        }
        let (kept, all) = (rows.len(), rows.len() + self.others);
        let mut notes =
            vec![format!("{kept} of {all} usable rows were selected at random and stand for all")];
        if self.groups < 1.0 {
            let (every, names) = (1.0 / self.groups, groups.join(", "));
            notes.push(format!("the selected rows belong to one in {every:.1} of the groups of {names}"));
        }
        for (place, name) in COUNTED_OBSERVATIONS.iter().enumerate() {
            let selected = rows.iter().filter(|row| observed(row)[place]).count();
            let all = selected + self.observed[place];
            if selected < FEW_OBSERVATIONS && selected < all {
                notes.push(format!(
                    "only {selected} of {all} rows with {name} were selected; for more use a file of the conditions \
                     under which they occur"
                ));
            }
        }
        notes
    }
}

/// Whether a row has each of [`COUNTED_OBSERVATIONS`].
fn observed(row: &Measurement) -> [bool; COUNTED_OBSERVATIONS.len()] {
    let share = |test: fn(f64) -> bool| row.captured.is_some_and(test);
    [row.e_n.is_some(), row.e_t.is_some(), share(|share| share > 0.0), share(|share| share < 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// The lines that remain of `count` rows, with their groups.
    fn select(most: usize, count: u64, group: impl Fn(u64) -> String) -> Vec<(u64, String)> {
        let mut selection = RowSelection::new(most);
        let mut kept: Vec<(u64, String)> = Vec::new();
        for line in 0..count {
            let name = group(line);
            let cells: Vec<&str> = name.split_terminator('/').collect();
            if selection.keeps(Ticket::new(line, cells.into_iter())) {
                kept.push((line, name));
            }
            if let Some(stays) = selection.shrink() {
                let mut stays = stays.into_iter();
                kept.retain(|_| stays.next().unwrap());
            }
        }
        kept
    }

    fn sizes(kept: &[(u64, String)]) -> BTreeMap<&str, usize> {
        let mut sizes = BTreeMap::new();
        kept.iter().for_each(|(_, group)| *sizes.entry(group.as_str()).or_default() += 1);
        sizes
    }

    #[test]
    fn all_rows_are_kept_up_to_the_limit() {
        assert_eq!(select(1000, 1000, |_| String::new()).len(), 1000);
        assert_eq!(select(usize::MAX, 3000, |_| String::new()).len(), 3000);
    }

    #[test]
    fn every_part_of_a_file_without_groups_is_kept_in_proportion() {
        let kept = select(1000, 100_000, |_| String::new());
        assert!((800..=1000).contains(&kept.len()), "{}", kept.len());
        for part in 0..4 {
            let inside = kept.iter().filter(|(line, _)| line / 25_000 == part).count() as f64;
            let expected = kept.len() as f64 / 4.0;
            assert!((inside - expected).abs() < 5.0 * expected.sqrt(), "{inside}, not {expected}");
        }
    }

    #[test]
    fn small_groups_stay_whole_in_any_order() {
        let bursts: [fn(u64) -> String; 2] =
            [|line| format!("{}/", line / 10), |line| format!("{}/", line % 20_000)];
        for burst in bursts {
            let kept = select(1000, 200_000, burst);
            assert!((700..=1000).contains(&kept.len()), "{}", kept.len());
            assert!(sizes(&kept).values().all(|size| *size == 10));
        }
    }

    #[test]
    fn large_groups_are_all_present() {
        let days: [fn(u64) -> String; 2] =
            [|line| format!("{}/", line / 20_000), |line| format!("{}/", line % 5)];
        for day in days {
            let kept = select(1000, 100_000, day);
            let sizes = sizes(&kept);
            assert_eq!(sizes.len(), 5);
            assert!(sizes.values().all(|size| (100..300).contains(size)), "{sizes:?}");
        }
    }

    #[test]
    fn a_large_group_beside_rows_of_their_own_is_present() {
        let kept = select(1000, 100_000, |line| if line % 10 == 0 { "/".into() } else { "all/".into() });
        let all = sizes(&kept)["all/"] as f64 / kept.len() as f64;
        assert!((all - 0.9).abs() < 0.05, "{all}");
    }
}
