//! The commands in the tutorial and in the pages about commands print the shown output.

use std::path::{Path, PathBuf};

use crate::support::{Folder, jred_in};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A block of a page: the words after its backticks, the name in `<!-- file: NAME -->` above it, its lines.
struct Block<'p> {
    kind: &'p str,
    file: Option<&'p str>,
    lines: Vec<&'p str>,
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut file = None;
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if let Some(name) = line.strip_prefix("<!-- file: ") {
            file = name.strip_suffix(" -->");
        } else if let Some(kind) = line.strip_prefix("```") {
            let lines = lines.by_ref().take_while(|line| !line.starts_with("```"));
            blocks.push(Block {
                kind,
                file: file.take(),
                lines: lines.collect(),
            });
        }
    }
    blocks
}

/// The words of a command line, quoted or not.
fn words(line: &str) -> Vec<String> {
    let parts = line.split('"').enumerate();
    let words = parts.flat_map(|(k, part)| match k % 2 {
        0 => part
            .split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// Whether the lines match the output; the line `…` matches any number of lines.
fn is_output(shown: &[&str], output: &[&str]) -> bool {
    match shown.split_first() {
        None => output.is_empty(),
        Some((&"…", rest)) => (0..=output.len()).any(|k| is_output(rest, &output[k..])),
        Some((line, rest)) => {
            let same = |first: &&str| first.trim_end() == line.trim_end();
            output.first().is_some_and(same) && is_output(rest, &output[1..])
        }
    }
}

/// Runs the commands of a page in a folder with the machines; returns their number.
fn check(page: &Path) -> usize {
    let folder = Folder::new();
    let machines = folder.path("machines");
    for inner in ["", "packing-line"] {
        std::fs::create_dir(machines.join(inner)).unwrap();
        for entry in std::fs::read_dir(root().join("machines").join(inner)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                std::fs::copy(&path, machines.join(inner).join(path.file_name().unwrap())).unwrap();
            }
        }
    }
    let text = std::fs::read_to_string(page).unwrap();
    let mut count = 0;
    for block in blocks(&text) {
        if let Some(name) = block.file {
            folder.file(name, block.lines.join("\n") + "\n");
        }
        if block.kind != "console" {
            continue;
        }
        let mut lines = block.lines.iter().copied().peekable();
        while let Some(line) = lines.next() {
            let command = line
                .strip_prefix("$ jred ")
                .unwrap_or_else(|| panic!("{line}"));
            let mut shown = Vec::new();
            while let Some(line) = lines.next_if(|line| !line.starts_with("$ ")) {
                shown.push(line);
            }
            let (command, file) = match command.split_once(" > ") {
                Some((command, file)) => (command, Some(file)),
                None => (command, None),
            };
            let run = jred_in(&folder.path(""), &words(command));
            if let Some(file) = file {
                folder.file(file, run.out.clone());
            }
            // A message is shown where the page is about one.
            let refused = run.code == 2 && shown.iter().any(|line| line.starts_with("  × "));
            assert!(
                run.code < 2 || refused,
                "{}: {command}\n{}",
                page.display(),
                run.err
            );
            let output = if refused { &run.err } else { &run.out };
            let output: Vec<&str> = output.lines().collect();
            assert!(
                shown.is_empty() || is_output(&shown, &output),
                "{}: jred {command}\nshown:\n{}\nprinted:\n{}",
                page.display(),
                shown.join("\n"),
                output.join("\n")
            );
            count += 1;
        }
    }
    count
}

#[test]
fn the_tutorial_prints_what_it_shows() {
    assert!(check(&root().join("docs/tutorial.md")) > 5);
}

#[test]
fn the_five_steps_print_what_they_show() {
    assert!(check(&root().join("docs/from-cad.md")) >= 3);
}

#[test]
fn the_table_of_a_payload_is_exported() {
    assert_eq!(check(&root().join("docs/observer.md")), 1);
}

#[test]
fn the_pages_about_commands_print_what_they_show() {
    let pages = std::fs::read_dir(root().join("docs/commands")).unwrap();
    let count = pages.map(|page| check(&page.unwrap().path()));
    assert!(count.sum::<usize>() >= 14);
}
