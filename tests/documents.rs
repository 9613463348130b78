//! Links and paths in the documents resolve.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::words::files;

/// The repository; `None` in the published package, which has no documents.
fn repository() -> Option<&'static Path> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("docs").is_dir().then_some(root)
}

/// The text without its blocks of code.
fn prose(text: &str) -> String {
    let parts = text.split("\n```").enumerate();
    parts
        .filter(|(k, _)| k % 2 == 0)
        .map(|(_, part)| part)
        .collect()
}

/// The texts after each `start`, up to the next `end`.
fn between<'a>(text: &'a str, start: &'a str, end: char) -> impl Iterator<Item = &'a str> {
    let after = text.split(start).skip(1);
    after
        .filter_map(move |rest| rest.split_once(end))
        .map(|(inner, _)| inner)
}

/// The anchors of a document: `id="…"`, and those of its headings.
fn anchors(text: &str) -> BTreeSet<String> {
    let ids = between(text, "id=\"", '"').map(ToOwned::to_owned);
    let prose = prose(text);
    let headings = prose.lines().filter_map(|line| {
        let heading = line.trim_start_matches('#').strip_prefix(' ')?;
        let heading = heading.split('<').next()?.trim().to_lowercase();
        let kept = heading
            .chars()
            .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        line.starts_with('#')
            .then(|| kept.collect::<String>().replace(' ', "-"))
    });
    ids.chain(headings).collect()
}

#[test]
fn links_lead_somewhere() {
    let Some(root) = repository() else { return };
    let mut all = Vec::new();
    files(root, ".md", &mut all);
    let mut broken = Vec::new();
    for document in &all {
        let text = fs::read_to_string(document).unwrap();
        for link in between(&prose(&text), "](", ')') {
            if link.contains("://") {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = match file {
                "" => document.clone(),
                file => document.parent().unwrap().join(file),
            };
            let known = match fs::read_to_string(&target) {
                Ok(text) => anchor.is_empty() || anchors(&text).contains(anchor),
                Err(_) => anchor.is_empty() && target.exists(),
            };
            if !known {
                broken.push(format!("{}: {link}", document.display()));
            }
        }
    }
    assert!(all.len() > 30, "documents are found");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// `tests/golden.rs` in backquotes is a file of the repository.
#[test]
fn paths_exist() {
    const FOLDERS: &[&str] = &[
        "benches/",
        "docs/",
        "examples/",
        "ffi/",
        "machines/",
        "scripts/",
        "src/",
        "tests/",
        "tool/",
        "xtask/",
    ];
    let Some(root) = repository() else { return };
    let mut all = Vec::new();
    files(root, ".md", &mut all);
    let mut missing = Vec::new();
    for document in &all {
        let text = prose(&fs::read_to_string(document).unwrap());
        for quoted in text.split('`').skip(1).step_by(2) {
            let path = FOLDERS.iter().any(|folder| quoted.starts_with(folder))
                && quoted
                    .chars()
                    .all(|c| c.is_alphanumeric() || "._/-".contains(c));
            if path && !quoted.contains("NN_") && !root.join(quoted).exists() {
                missing.push(format!("{}: {quoted}", document.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// Each promise of docs/safety.md names steps of `scripts/test`; `paths_exist` checks their files.
#[test]
fn steps_of_promises_exist() {
    let Some(root) = repository() else { return };
    let safety = fs::read_to_string(root.join("docs/safety.md")).unwrap();
    let script = fs::read_to_string(root.join("scripts/test")).unwrap();
    let tables = safety.split("| promise | how it is shown | step |\n");
    let rows = tables.skip(1).flat_map(|table| {
        let rows = table.lines().skip(1);
        rows.take_while(|line| line.starts_with('|'))
    });
    let mut promises = 0;
    for row in rows {
        let cells: Vec<_> = row.trim_matches('|').split('|').collect();
        let [_, _, steps] = cells[..] else {
            panic!("not three cells: {row}")
        };
        for step in steps.split(',') {
            let step = step.trim().trim_matches('`');
            let function = format!("\nstep_{step}() {{");
            assert!(script.contains(&function), "no step `{step}`: {row}");
        }
        promises += 1;
    }
    assert!(promises > 15, "{promises} promises are found");
}
