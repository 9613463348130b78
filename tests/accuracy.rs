//! Every statement of accuracy in the documentation names an existing test or proof.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

fn name(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
    &text[..end.unwrap_or(text.len())]
}

/// The paragraphs of a file's documentation, each on one line, without code.
fn paragraphs(text: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    let mut code = false;
    for line in text.lines() {
        let line = line.trim_start();
        let words = ["/// ", "//! "]
            .iter()
            .find_map(|start| line.strip_prefix(start));
        code ^= words.is_some_and(|words| words.starts_with("```"));
        match words {
            Some(words) if !code && !words.starts_with("```") => {
                let last = all.last_mut().unwrap();
                last.push_str(words);
                last.push(' ');
            }
            _ => all.push(String::new()),
        }
    }
    all.retain(|paragraph| !paragraph.is_empty());
    all
}

/// The names in backquotes that follow `test` or `tests`: `a`, `b` and `c`.
fn named(paragraph: &str) -> Vec<&str> {
    let mut found = Vec::new();
    for start in ["test `", "tests `"] {
        for (at, _) in paragraph.match_indices(start) {
            let mut rest = &paragraph[at + start.len()..];
            while let Some((quoted, after)) = rest.split_once('`') {
                found.push(quoted);
                let next = [", `", " and `", "; `"]
                    .iter()
                    .find_map(|more| after.strip_prefix(more));
                let Some(next) = next else { break };
                rest = next;
            }
        }
    }
    found
}

/// The scripts in `tests/proofs` and the files of tests that a paragraph names.
fn files(paragraph: &str) -> impl Iterator<Item = &str> {
    let quoted = paragraph.split('`').skip(1).step_by(2);
    quoted.filter(|quoted| quoted.starts_with("tests/"))
}

#[test]
fn names_are_found() {
    let text = "/// Right (tests `a`,\n/// `b` and `c`).\n///\n/// ```\n/// test `no`\n/// ```\n//! One `d`, test `e`: `tests/proofs`";
    let all = paragraphs(text);
    assert_eq!(all.len(), 2, "{all:?}");
    assert_eq!(named(&all[0]), ["a", "b", "c"]);
    assert_eq!(named(&all[1]), ["e"]);
    assert_eq!(files(&all[1]).collect::<Vec<_>>(), ["tests/proofs"]);
    assert_eq!(name("a_b(c"), "a_b");
}

#[test]
fn what_holds_an_accuracy_exists() {
    const CLAIMS: [&str; 5] = [
        "Accuracy:",
        "**Accuracy**",
        "ccurate to",
        "rror of up to",
        "|error|",
    ];
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // The published package lacks some tests.
    if !root.join("tool").is_dir() {
        return;
    }
    let mut tests = BTreeSet::new();
    let mut all = Vec::new();
    for folder in ["tests", "src", "tool"] {
        sources(&root.join(folder), &mut all);
    }
    for path in &all {
        let text = fs::read_to_string(path).unwrap();
        let functions = text.split("fn ").skip(1);
        tests.extend(functions.map(|rest| name(rest).to_owned()));
    }
    let (mut wrong, mut claims) = (Vec::new(), 0);
    for path in all.iter().filter(|path| path.starts_with(root.join("src"))) {
        for paragraph in paragraphs(&fs::read_to_string(path).unwrap()) {
            let place = path.strip_prefix(root).unwrap().display();
            let names = named(&paragraph);
            for name in &names {
                // A file of tests, or a test.
                if !tests.contains(*name)
                    && !root.join("tests").join(name).exists()
                    && !root.join(name).exists()
                {
                    wrong.push(format!("{place}: no test {name}"));
                }
            }
            for file in files(&paragraph).filter(|file| !root.join(file).exists()) {
                wrong.push(format!("{place}: no file {file}"));
            }
            if CLAIMS.iter().any(|claim| paragraph.contains(claim)) {
                claims += 1;
                if names.is_empty() && files(&paragraph).next().is_none() {
                    wrong.push(format!("{place}: no test named: {paragraph}"));
                }
            }
        }
    }
    assert!(claims > 20, "{claims} claims are found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
