//! Progress bars of long work.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over a number of bytes, shown only when standard error is a terminal.
pub fn bytes(total: u64, what: &'static str) -> ProgressBar {
    styled(ProgressBar::new(total), what, "{msg} [{bar:40}] {bytes}/{total_bytes} {eta}")
}

/// A bar over a number of items, shown only when standard error is a terminal.
pub fn count(total: u64, what: &'static str) -> ProgressBar {
    styled(ProgressBar::new(total), what, "{msg} [{bar:40}] {pos}/{len} {eta}")
}

/// A count of items whose total is unknown, shown only when standard error is a terminal.
pub fn spinner(what: &'static str) -> ProgressBar {
    styled(ProgressBar::new_spinner(), what, "{spinner} {pos} {msg} {elapsed}")
}

/// Counts an item and says which one it is.
pub fn tell(bar: &ProgressBar, what: &str, one: &str) {
    bar.inc(1);
    bar.set_message(format!("{what}: {one}"));
}

fn styled(bar: ProgressBar, what: &'static str, template: &str) -> ProgressBar {
    let bar = bar.with_message(what);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
