//! What hits used outside of its stated range: `outsideRange.txt` of the last run of a case, written at
//! the latest write time. A line is the number of hits, the patch, and the range.

use std::path::Path;

use super::time_folders;

/// The lines for the page, from the tables of a cloud; empty without the file.
pub fn read_last(tables: &Path) -> Vec<String> {
    let starts = time_folders(tables).into_iter().rev();
    let mut texts =
        starts.filter_map(|(_, folder)| std::fs::read_to_string(folder.join("outsideRange.txt")).ok());
    texts.next().map_or_else(Vec::new, |text| with_summary(text.lines().filter_map(line).collect()))
}

/// The lines after one that says how many there are; none before none.
fn with_summary(mut lines: Vec<String>) -> Vec<String> {
    if !lines.is_empty() {
        let (ranges, many) = (lines.len(), if lines.len() == 1 { "" } else { "s" });
        let text =
            format!("Hits leave {ranges} stated range{many} of properties and laws, listed at the end");
        lines.insert(0, text);
    }
    lines
}

fn line(line: &str) -> Option<String> {
    let mut parts = line.splitn(3, ' ');
    let (hits, patch, range) = (parts.next()?, parts.next()?, parts.next()?);
    hits.parse::<f64>().ok()?;
    Some(format!("{hits} hits on {patch}: {range}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_name_hits_patch_and_range() {
        assert_eq!(line("# hits patch range, since the start of the case"), None);
        let said = line("120 floor density of wax is stated for T_p 283 to 328 K").unwrap();
        assert_eq!(said, "120 hits on floor: density of wax is stated for T_p 283 to 328 K");
    }
}
