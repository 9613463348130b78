//! `docs/machine-file.md`: its examples are read, its error messages are the real ones.

use crate::{PRESS, parse, parse_as, rendered_in};

const DOC: &str = include_str!("../../../docs/machine-file.md");

/// The blocks of the document in the language `name`.
fn blocks(name: &str) -> Vec<&'static str> {
    let blocks = DOC.split("\n```").skip(1).step_by(2);
    blocks
        .filter_map(|block| block.strip_prefix(name))
        .collect()
}

#[test]
fn every_example_is_read() {
    let examples = blocks("toml\n");
    let (whole, parts): (Vec<&str>, Vec<&str>) = examples
        .into_iter()
        .partition(|example| example.contains("gravity ="));
    assert!(whole.len() >= 3 && parts.len() >= 5);
    for example in &whole {
        assert!(parse(example).is_ok(), "{example}");
    }
    let slider_crank = whole
        .iter()
        .find(|example| example.contains("crank"))
        .unwrap();
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
        ("\"180 mm\"", "\"25 mm\""),
        ("360 deg\"\nduration", "350 deg\"\nduration"),
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
