//! Keys and values for a place of a machine file.

use jred_file::keys::complete::candidates;
use jred_file::keys::place::Place;
use jred_file::text::key::{ValueForm, ValueRange};

/// The labels at the mark `|` of a text, and the text that they replace.
fn at(text: &str) -> (String, Vec<String>) {
    let place = text.find('|').expect("a mark");
    let text = text.replace('|', "");
    let (range, found) = candidates(&text, place);
    let labels = found.into_iter().map(|candidate| candidate.label);
    (text[range].to_owned(), labels.collect())
}

#[test]
fn a_key_of_a_table_that_is_missing() {
    let text = "gravity = [\"9.81 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\n[mechanism.crank]\nlength = \"30 mm\"\n|\n";
    let (_, labels) = at(text);
    assert_eq!(labels, ["mass", "inertia", "com"]);
}

#[test]
fn a_key_that_is_begun() {
    let (begun, labels) = at("[mechanism]\ntype = \"slider-crank\"\noff|\n");
    assert_eq!((begun.as_str(), labels), ("off", vec!["offset".to_owned()]));
}

#[test]
fn a_word() {
    let (begun, labels) = at("[mechanism]\ntype = \"slider-|\"\n");
    assert_eq!(begun, "\"slider-\"");
    assert_eq!(labels, ["slider-crank", "inverted-slider-crank"]);
}

#[test]
fn a_key_of_an_inline_table_in_a_list() {
    let text = "[mechanism]\ntype = \"linkage\"\nbody = [\n  { name = \"crank\", mass = \"1 kg\" },\n  { name = \"rod\", ine|\n";
    assert_eq!(at(text), ("ine".to_owned(), vec!["inertia".to_owned()]));
}

#[test]
fn a_header() {
    assert_eq!(at("[mot|").1, ["motion"]);
    assert_eq!(
        at("[mechanism]\ntype = \"slider-crank\"\n[mechanism.sl|").1,
        ["slider"]
    );
}

#[test]
fn every_prefix_of_a_file_has_candidates_or_none_without_a_panic() {
    let text = include_str!("../../../machines/linkage-four-bar.toml");
    for (place, _) in text.char_indices() {
        candidates(text, place);
        candidates(&text[..place], place);
    }
}

#[test]
fn a_place_has_the_limits_of_its_key() {
    let text = include_str!("../../../machines/linkage-four-bar.toml");
    let file = toml::Value::Table(text.parse().expect("TOML"));
    let range = |path: &str| {
        let path: Vec<String> = path.split('.').map(str::to_owned).collect();
        match Place::at(&file, &path)?.form {
            ValueForm::Quantity([kind, _], range) => Some((kind.unit, range)),
            _ => None,
        }
    };
    assert_eq!(
        range("mechanism.body.crank.mass"),
        Some(("kg", ValueRange::NotNegative))
    );
    assert_eq!(
        range("mechanism.body.2.points.B.1"),
        Some(("mm", ValueRange::Any))
    );
    assert_eq!(range("mechanism.ground.C.1"), Some(("mm", ValueRange::Any)));
    assert_eq!(
        range("load.part on its rails.opposing_force"),
        Some(("N", ValueRange::NotNegative))
    );
    assert_eq!(range("motion.speed"), Some(("rpm", ValueRange::Any)));
}
