//! Which rule set judges: chosen in the machine file, on the command line, or a file of one's own.

use jred_machine::model::rule::Rule;
use jred_machine::read as machine_file;

use super::sets::{set, with_rules};
use super::{press_text, read, refuses};
use crate::support::{Folder, jred, press_file};

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
    let rules = machine_file::parse("m.toml", &text, folder.path(""))
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
    for (text, words) in [
        (
            "title = \"x\"\n[rules]\nrms_torq = \"60 %\"\n",
            &["rms_torq", "did you mean"][..],
        ),
        (
            "title = \"x\"\nbased_on = \"fanux\"\n[rules]\n",
            &["fanux", "fanuc"],
        ),
        ("[rules]\n", &["title"]),
        (
            "title = \"x\"\n[rules]\nrms_torque = \"60\n",
            &["not valid TOML"],
        ),
    ] {
        folder.file("wrong.toml", text);
        let path = folder.path("wrong.toml");
        let run = jred([&"size", &press_file(), &"--rules", &path]).ends(2);
        run.says(words);
        run.says(&["wrong.toml"]);
    }
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
        ("inertia_ratio_by_moves = []", &["0 bands"]),
        (
            "inertia_ratio_by_moves = [{ above = 60, limit = 5 }]\ninertia_ratio = 4",
            &["together with `inertia_ratio`"],
        ),
        (
            "set = \"mitsubishi-mr-j2s\"\ninertia_ratio_warning = 2",
            &["depend on the moves per minute", "inertia_ratio"],
        ),
    ] {
        refuses(&with_rules(rules), words);
    }
}

/// The command line: another set, what the file says stays; the sets are listed with their sources.
#[test]
fn the_command_line() {
    let folder = Folder::new();
    let file = folder.file("m.toml", with_rules("inertia_ratio_warning = 4"));
    let run = jred([&"size", &file, &"--rules", &"fanuc"]);
    assert!(run.code == 0 || run.code == 1, "{}", run.err);
    // With a limit of 3 the file's warning at 4 comes too late.
    let run = jred([&"size", &file, &"--rules", &"fanuc-contouring"]).ends(2);
    run.says(&["contradicts the set", "inertia_ratio_warning", "above"]);
    jred([&"size", &file, &"--rules", &"fanux"])
        .ends(2)
        .says(&["did you mean \"fanuc\"?"]);

    let list = jred([&"rules"]).ends(0).out;
    for name in machine_file::rule_set_names() {
        assert!(list.contains(name), "{name}");
    }
    let one = jred([&"rules", &"fanuc"]).ends(0).out;
    for word in [
        "constant_torque",
        "70 %",
        "B-65262EN/03",
        "at least 10",
        "largest λ",
    ] {
        assert!(one.contains(word), "{word:?} is not in\n{one}");
    }
    let json = jred([&"rules", &"mitsubishi-mr-j2s", &"--format", &"json"])
        .ends(0)
        .json();
    assert_eq!(json["choices"]["inertia_ratio_by_moves"][1]["limit"], 3.0);
    assert_eq!(json["choices"]["inertia_ratio_of"], "max");
    let csv = jred([&"rules", &"general", &"--format", &"csv"])
        .ends(0)
        .out;
    assert!(
        csv.starts_with("rule,key,limit,warning,source\nRMS torque,rms_torque,80 %,,"),
        "{csv}"
    );
    assert_eq!(
        jred([&"rules", &"--format", &"json"]).ends(0).json()["rule sets"]
            .as_array()
            .unwrap()
            .len(),
        machine_file::rule_set_names().count()
    );
    assert_eq!(
        jred([&"rules", &"--format", &"csv"])
            .ends(0)
            .out
            .lines()
            .count(),
        1 + machine_file::rule_set_names().count()
    );
    jred([&"rules", &"nothing"])
        .ends(2)
        .says(&["there is no rule set \"nothing\""]);
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
    assert_eq!((changes, sets), (4, 1));
}
