//! `docs/machine-file.md` and `docs/mechanisms/`: their examples are read, the error messages shown are the real ones.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::reader;
use jred_file::read;

use super::{PRESS, parse, parse_as, rendered_in};

const DOC: &str = include_str!("../../../../docs/machine-file.md");

/// The blocks of a document in the language `name`.
fn blocks<'a>(document: &'a str, name: &str) -> Vec<&'a str> {
    let blocks = document.split("\n```").skip(1).step_by(2);
    blocks
        .filter_map(|block| block.strip_prefix(name))
        .collect()
}

/// The files of a folder of the repository whose names end in `.ending`.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let root = &Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let entries = fs::read_dir(root.join(folder)).unwrap();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == ending))
        .collect();
    files.sort();
    files
}

#[test]
fn every_type_of_mechanism_has_a_page_an_example_and_a_machine() {
    let index = include_str!("../../../../docs/mechanisms/README.md");
    let listed: BTreeSet<&str> = index
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| [`\"")?.split_once('"')?.0))
        .collect();
    let types: BTreeSet<&str> = read::mechanism_types().collect();
    assert_eq!(listed, types, "the index and the reader");

    let mut shown = BTreeSet::new();
    let pages = files("docs/mechanisms", "md");
    let others = [files("docs", "md"), files("docs/commands", "md")].concat();
    for page in pages.iter().chain(&others) {
        let text = fs::read_to_string(page).unwrap();
        for example in blocks(&text, "toml\n") {
            if example.contains("gravity =") && example.contains("[mechanism]") {
                match parse(example) {
                    Ok(file) => shown.insert(file.machine.mechanism().kind()),
                    Err(report) => panic!("{}: {report:?}\n{example}", page.display()),
                };
            }
        }
    }
    assert_eq!(shown, types, "types with an example in the documentation");

    let mut started = BTreeSet::new();
    for path in files("machines", "toml") {
        let file = reader::read(&path).unwrap_or_else(|e| panic!("{}: {e:?}", path.display()));
        started.insert(file.machine.mechanism().kind());
        let name = path.file_name().unwrap().to_str().unwrap();
        let mentioned = index.contains(name)
            || others
                .iter()
                .chain(&pages)
                .any(|page| fs::read_to_string(page).unwrap().contains(name));
        assert!(mentioned, "{name} is not mentioned in the documentation");
    }
    assert_eq!(started, types, "types with a machine to start from");
}

/// The joints of a page are those of the machine of its type, by the names that the program prints.
#[test]
fn joints_have_the_names_of_their_pages() {
    // These pages name joints by the link that the file names, or by what the follower is.
    let by_rule = ["disc-cam", "parallel-shafts", "planetary"];
    let mut compared = BTreeSet::new();
    for path in files("machines", "toml") {
        let file = reader::read(&path).unwrap();
        let mechanism = file.machine.mechanism();
        let kind = mechanism.kind();
        let page = files("docs/mechanisms", "md").into_iter();
        let mut page = page.filter(|page| page.file_stem().is_some_and(|stem| stem == kind));
        let Some(text) = page.next().map(|page| fs::read_to_string(page).unwrap()) else {
            continue;
        };
        let Some((_, rest)) = text.split_once("Joints: ") else {
            continue;
        };
        if by_rule.contains(&kind)
            || kind == "reduced-curves"
            || (kind == "hoist" && mechanism.joint_names().len() < 5)
        {
            continue;
        }
        // What is in brackets explains; the sentence ends at its point.
        let (mut list, mut depth) = (String::new(), 0);
        for c in rest.replace('\n', " ").chars() {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                '.' if depth == 0 => break,
                c if depth == 0 => list.push(c),
                _ => {}
            }
        }
        let names: Vec<String> = list.split(',').map(|name| name.trim().to_owned()).collect();
        assert_eq!(names, mechanism.joint_names(), "{}", path.display());
        compared.insert(kind);
    }
    assert!(compared.len() >= 10, "{compared:?}");
}

#[test]
fn every_example_is_read() {
    let examples = blocks(DOC, "toml\n");
    let (whole, parts): (Vec<&str>, Vec<&str>) = examples
        .into_iter()
        .partition(|example| example.contains("gravity ="));
    assert!(parts.len() >= 5);
    for example in &whole {
        assert!(parse(example).is_ok(), "{example}");
    }
    let page = include_str!("../../../../docs/mechanisms/slider-crank.md");
    let slider_crank = blocks(page, "toml\n")[0];
    for part in parts {
        let text = format!("{slider_crank}\n{part}");
        assert!(parse(&text).is_ok(), "{part}");
    }
}

#[test]
fn the_messages_shown_are_the_real_ones() {
    let edits = [
        ("mass = \"42 kg\"", "mass = \"42\""),
        ("offset =", "ofset ="),
    ];
    let mut missing = String::new();
    for (from, to) in edits {
        assert!(PRESS.contains(from));
        let report = parse_as("press.toml", &PRESS.replacen(from, to, 1)).unwrap_err();
        let text: Vec<String> = rendered_in(&report, 110)
            .lines()
            .map(|line| line.trim_end().to_owned())
            .collect();
        let text = text.join("\n");
        if !DOC.contains(text.trim_end()) {
            missing.push_str(&text);
            missing.push_str("\n\n");
        }
    }
    assert!(missing.is_empty(), "not in the document:\n{missing}");
}
