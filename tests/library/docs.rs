//! Every relative link in the documents leads somewhere.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The Markdown files that git knows.
fn documents(root: &Path) -> Vec<PathBuf> {
    let output = Command::new("git").current_dir(root).args(["ls-files", "*.md"]).output().unwrap();
    String::from_utf8(output.stdout).unwrap().lines().map(|line| root.join(line)).collect()
}

#[test]
fn relative_links_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let documents = documents(root);
    assert!(documents.len() > 5, "{documents:?}");
    for document in documents {
        let text = std::fs::read_to_string(&document).unwrap();
        for part in text.split("](").skip(1) {
            let target = part.split([')', '#']).next().unwrap();
            if target.is_empty() || target.contains("://") {
                continue;
            }
            let path = document.parent().unwrap().join(target);
            assert!(path.exists(), "{}: link to {target}", document.display());
        }
    }
}
