//! Which rule set judges: chosen in the machine file, on the command line, or a file of one's own.

use jred_file::model::rule::Rule;

use super::sets::{set, with_rules};
use crate::reader;
use crate::reading::{read, refuses};
use crate::support::{Folder, press_text};

#[test]
fn a_set_is_chosen_in_the_file() {
    let rules = read(&with_rules("set = \"fanuc\"\nrms_torque = \"75 %\"")).rules;
    assert_eq!(rules.name, "fanuc");
    assert_eq!(rules.limit(Rule::RmsTorque).fail, Some(0.75));
    assert_eq!(rules.limit(Rule::ConstantTorque).fail, Some(0.7));
    assert_eq!(rules.source(Rule::RmsTorque), "[rules] of the machine file");
    assert!(rules.source(Rule::GearboxPeak).contains("T2B"));
    assert!(rules.is_changed());
    // Another set, the same changes.
    let other = rules.based_on(set("safety-factor-2")).unwrap();
    assert_eq!(other.limit(Rule::RmsTorque).fail, Some(0.75));
    assert_eq!(other.limit(Rule::PeakTorque).fail, Some(0.5));
    assert!(!other.shows(Rule::ConstantTorque));
    // Limits by moves give way to one limit.
    let rules = read(&with_rules(
        "set = \"mitsubishi-mr-j2s\"\ninertia_ratio = 8",
    ))
    .rules;
    assert!(rules.choices.inertia_ratio_by_moves.is_empty());
    assert_eq!(rules.limit(Rule::InertiaRatio).fail, Some(8.0));
}

#[test]
fn a_set_of_ones_own() {
    let folder = Folder::new();
    folder.file(
        "house.toml",
        "title = \"Rules of our house\"\nsource = \"house standard 7\"\nbased_on = \"fanuc\"\n[rules]\nrms_torque = \"60 %\"\ngearbox_cycles = \"off\"\n",
    );
    let text = with_rules("set = \"house.toml\"");
    let rules = reader::parse("m.toml", &text, folder.path(""))
        .unwrap()
        .rules;
    assert_eq!(
        (rules.name.as_str(), rules.title.as_str()),
        ("house", "Rules of our house")
    );
    assert_eq!(rules.limit(Rule::RmsTorque).fail, Some(0.6));
    assert_eq!(rules.source(Rule::RmsTorque), "house standard 7");
    assert_eq!(rules.limit(Rule::ConstantTorque).fail, Some(0.7));
    assert!(rules.is_off(Rule::GearboxCycles));
}

#[test]
fn contradictions_are_refused() {
    for (rules, words) in [
        (
            "inertia_ratio = 3",
            &["inertia_ratio_warning", "is 5, above", "which is 3"][..],
        ),
        (
            "rms_torque = \"80 %\"\nrms_torque_warning = \"90 %\"",
            &["rms_torque_warning", "90 %, above", "80 %"],
        ),
        (
            "natural_frequency = 12",
            &["natural_frequency_warning", "is 10, below", "12"],
        ),
        (
            "speed = \"off\"\nspeed_warning = \"80 %\"",
            &["`speed` is \"off\"", "remove one of the two"],
        ),
        ("speed = \"of\"", &["`speed`"]),
        ("speed = \"250 %\"", &["`speed`", "200 %"]),
        ("speed = \"0 %\"", &["`speed`", "greater than zero"]),
        (
            "inertia_ratio = \"10 %\"",
            &["`inertia_ratio`", "plain number"],
        ),
        ("sped = \"80 %\"", &["`sped`", "did you mean \"speed\"?"]),
        ("speed_warnin = \"80 %\"", &["speed_warnin"]),
        (
            "set = \"fanux\"",
            &["\"fanux\"", "did you mean \"fanuc\"?", "jred rules"],
        ),
        (
            "set = \"missing.toml\"",
            &["cannot read the rule set", "missing.toml"],
        ),
        (
            "inertia_ratio_of = \"largest\"",
            &["\"largest\"", "\"max\""],
        ),
        ("gearbox_mean_exponent = \"4\"", &["\"4\"", "\"10/3\""]),
        ("speed = { source = \"x\" }", &["neither limit nor warning"]),
        (
            "inertia_ratio_by_moves = [{ above = 100, limit = 3 }, { above = 60, limit = 5 }]",
            &["not above", "increasing"],
        ),
        ("inertia_ratio_by_moves = []", &["is empty", "at least one"]),
        (
            "inertia_ratio_by_moves = [{ above = 60, limit = 5 }]\ninertia_ratio = 4",
            &["has both `inertia_ratio` and"],
        ),
        (
            "set = \"mitsubishi-mr-j2s\"\ninertia_ratio_warning = 2",
            &["depend on the moves per minute", "inertia_ratio"],
        ),
    ] {
        refuses(&with_rules(rules), words);
    }
}

/// The examples of the documentation: changes to a set, and a set of one's own.
#[test]
fn the_documented_rules_are_read() {
    let documents = [
        include_str!("../../../../docs/sizing-rules.md"),
        include_str!("../../../../docs/machine-file.md"),
    ];
    let blocks = documents
        .iter()
        .flat_map(|text| text.split("```toml\n").skip(1));
    let blocks: Vec<&str> = blocks
        .map(|block| block.split("```").next().unwrap())
        .collect();
    let folder = Folder::new();
    let (mut changes, mut sets) = (0, 0);
    for block in blocks {
        if block.contains("title = \"Rules of our house\"") {
            let path = folder.file("house.toml", block);
            assert_eq!(
                set(path.to_str().unwrap()).limit(Rule::RmsTorque).fail,
                Some(0.6)
            );
            sets += 1;
        } else if ["[rules]", "[stiffness]", "[tool]"]
            .iter()
            .any(|table| block.starts_with(table))
        {
            read(&format!("{}\n{block}", press_text()));
            changes += 1;
        }
    }
    assert_eq!((changes, sets), (3, 1));
}
