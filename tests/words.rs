//! The words of comments, documents and messages: what the glossary lists under "What we do not write" is counted, below ceilings that
//! only fall.

use std::fs;
use std::path::{Path, PathBuf};

/// A phrase (lower case), and how often it may be in comments, documents and messages: those of the snapshots, as a user reads them.
const CEILINGS: [(&str, [usize; 3]); 14] = [
    ("// what ", [12, 1, 0]),
    ("no number", [4, 1, 0]),
    ("is none", [4, 1, 2]),
    ("are none", [0, 1, 0]),
    ("for ever", [1, 1, 0]),
    ("for want of", [0, 1, 0]),
    ("looked at", [1, 1, 0]),
    (" a hair", [1, 1, 0]),
    ("of itself", [0, 1, 0]),
    ("so many", [5, 0, 0]),
    ("whichever", [2, 1, 0]),
    ("sought", [0, 1, 0]),
    ("mind: ", [0, 0, 0]),
    ("stands beside", [0, 1, 0]),
];

/// A count may be this much below its ceiling; then the ceiling must fall.
const SLACK: usize = 4;

/// All files with this ending in the folder and below it, without hidden ones, compiler output and what others wrote.
pub(super) fn files(folder: &Path, end: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy();
        if name.starts_with('.') || matches!(&*name, "target" | "vendor" | "node_modules") {
            continue;
        }
        if path.is_dir() {
            files(&path, end, found);
        } else if name.ends_with(end) && name != "words.rs" {
            found.push(path);
        }
    }
}

/// The lines of all files with this ending that `keeps` accepts, in lower case.
fn lines(root: &Path, end: &str, keeps: fn(&str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    files(root, end, &mut found);
    let texts = found.iter().map(|path| fs::read_to_string(path).unwrap());
    let lines = texts.flat_map(|text| {
        let lines = text.lines().map(|line| line.trim_start().to_lowercase());
        lines.filter(|line| keeps(line)).collect::<Vec<_>>()
    });
    lines.collect()
}

/// Whether a line has the phrase as whole words.
fn has(line: &str, phrase: &str) -> bool {
    let is_letter = |c: char| c.is_alphabetic();
    let mut ends = line
        .match_indices(phrase)
        .map(|(at, _)| &line[at + phrase.len()..]);
    ends.any(|rest| phrase.ends_with(' ') || !rest.starts_with(is_letter))
}

#[test]
fn nobody_writes_the_dialect() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    if !root.join("docs").is_dir() {
        return; // in the published package, which has no documents
    }
    let comments = lines(root, ".rs", |line| line.starts_with("//"));
    // `//! What`, `/// What` and `// What` are one.
    let comments: Vec<String> = comments
        .iter()
        .map(|line| line.replace("//! ", "// ").replace("/// ", "// "))
        .collect();
    let documents = lines(root, ".md", |_| true);
    let messages = lines(root, ".snap", |_| true);
    assert!(comments.len() > 5000 && documents.len() > 2000 && messages.len() > 5000);
    let mut wrong = Vec::new();
    for (phrase, ceilings) in CEILINGS {
        for (place, (lines, ceiling)) in ["comments", "documents", "messages"]
            .iter()
            .zip([&comments, &documents, &messages].into_iter().zip(ceilings))
        {
            let count = lines.iter().filter(|line| has(line, phrase)).count();
            if count > ceiling {
                wrong.push(format!("{phrase:?} is in {count} lines of {place}, above {ceiling}: docs/glossary.md has better words"));
            } else if count + SLACK < ceiling {
                wrong.push(format!(
                    "{phrase:?} is in {count} lines of {place} only: lower the ceiling of {ceiling}"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
