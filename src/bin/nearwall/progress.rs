//! Progress of long work: a bar on a terminal, nothing elsewhere.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over a number of bytes; it shows itself on a terminal's standard error only.
pub fn bytes(total: u64, what: &'static str) -> ProgressBar {
    styled(total, what, "{msg} [{bar:40}] {bytes}/{total_bytes} {eta}")
}

/// A bar over a number of things; it shows itself on a terminal's standard error only.
pub fn count(total: u64, what: &'static str) -> ProgressBar {
    styled(total, what, "{msg} [{bar:40}] {pos}/{len} {eta}")
}

fn styled(total: u64, what: &'static str, template: &str) -> ProgressBar {
    let bar = ProgressBar::new(total).with_message(what);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A count of things whose total is not known; it shows itself on a terminal's standard error only.
pub fn spinner(what: &'static str) -> ProgressBar {
    let bar = ProgressBar::new_spinner().with_message(what);
    match ProgressStyle::with_template("{spinner} {pos} {msg} {elapsed}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
