//! A page in a real browser. Needs Chromium (`tests/prepare` installs it); without one a test says
//! so and stops, except in CI, where it fails.

use std::path::Path;
use std::process::Command;

/// What the browser made of a page.
pub struct Seen {
    /// The document after loading.
    pub dom: String,
    /// What it said on its console.
    pub complaints: Vec<String>,
}

/// Loads a page; `None` where there is no browser to try it in.
pub fn browse(page: &Path) -> Option<Seen> {
    let profile = tempfile::tempdir().unwrap();
    let mut chromium = Command::new("chromium");
    chromium.args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]);
    chromium.args(["--disable-background-networking", "--disable-component-update", "--disable-sync"]);
    chromium.args(["--enable-logging=stderr", "--window-size=1200,900", "--virtual-time-budget=2000"]);
    chromium.arg(format!("--user-data-dir={}", profile.path().display()));
    match chromium.arg("--dump-dom").arg(format!("file://{}", page.display())).output() {
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr);
            let complaints =
                said.lines().filter(|line| line.contains(":CONSOLE")).map(str::to_owned).collect();
            Some(Seen { dom: String::from_utf8_lossy(&output.stdout).into_owned(), complaints })
        }
        Err(error) if std::env::var_os("CI").is_some() => panic!("chromium: {error}; run tests/prepare"),
        Err(error) => {
            eprintln!("chromium: {error}; run tests/prepare to look at the pages");
            None
        }
    }
}
