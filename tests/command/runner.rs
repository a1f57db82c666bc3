//! The command as a user runs it, with a model of wax on glass.

use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

pub const WAX: &str = r#"
[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "thornton-ning"
yield_ratio = 0.7
[tangential]
model = "constant"
e_t = 0.76
"#;

pub fn nearwall(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_nearwall")).current_dir(folder).args(arguments).output().unwrap()
}

/// A new folder with these files.
pub fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

/// Asserts exit 0 and returns what was printed.
pub fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = nearwall(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Asserts exit 1 and that the message holds each of `parts`.
pub fn refused(folder: &Path, arguments: &[&str], parts: &[&str]) {
    is_refusal(&nearwall(folder, arguments), parts);
}

/// Asserts exit 1, no panic, and that the message holds each of `parts`.
pub fn is_refusal(output: &Output, parts: &[&str]) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(!message.contains("panicked"), "{message}");
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}
