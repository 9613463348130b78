//! Rule sets as data: what comes with the tool, what a machine file changes, what is refused.

use std::collections::BTreeSet;
use std::path::Path;

use jred_sizing::check::Verdict;
use jred_sizing::input;
use jred_sizing::judge::Finding;
use jred_sizing::rule::{Rule, Sense};
use jred_sizing::rules::{Limit, RuleSet};

use super::support::{Folder, jred, press_file};
use super::{near, press_text, read, refuses};

fn with_rules(rules: &str) -> String {
    format!("{}\n[rules]\n{rules}\n", press_text())
}

fn set(name: &str) -> RuleSet {
    input::rule_set(name).unwrap_or_else(|report| panic!("{name}: {report:?}"))
}

/// Every file of the folder is a set, every set reads, and says where each limit comes from.
#[test]
fn every_set_reads() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("rules");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            entry
                .unwrap()
                .path()
                .file_stem()
                .unwrap()
                .to_str()
                .unwrap()
                .to_owned()
        })
        .collect();
    let names: BTreeSet<String> = input::rule_set_names().map(str::to_owned).collect();
    assert_eq!(names, files);
    for name in &names {
        let set = set(name);
        assert_eq!(&set.name, name);
        assert!(!set.title.is_empty());
        for rule in Rule::ALL.into_iter().filter(|rule| set.shows(*rule)) {
            assert!(set.source(rule).len() > 3, "{name}: {}", rule.key());
        }
    }
    assert_eq!(RuleSet::default(), set("general"));
    // Every rule but that of one maker is judged by the general set.
    for rule in Rule::ALL {
        assert_eq!(
            RuleSet::default().shows(rule),
            rule != Rule::ConstantTorque,
            "{}",
            rule.key()
        );
    }
    let keys: BTreeSet<&str> = Rule::ALL
        .iter()
        .flat_map(|rule| [rule.key(), rule.warning_key()])
        .collect();
    assert_eq!(keys.len(), 2 * Rule::COUNT);
}

/// The published figures.
#[test]
fn the_figures_of_the_sets() {
    let limits = |name: &str, rule: Rule| {
        let Limit { fail, warn } = set(name).limit(rule);
        (fail, warn)
    };
    for (name, rule, fail, warn) in [
        ("general", Rule::RmsTorque, Some(0.8), None),
        ("general", Rule::PeakTorque, Some(0.8), None),
        ("general", Rule::Speed, Some(0.9), None),
        ("general", Rule::HoldingTorque, Some(0.6), None),
        ("general", Rule::InertiaRatio, Some(10.0), Some(5.0)),
        ("general", Rule::GearboxCycles, None, Some(1.0)),
        ("general", Rule::NaturalFrequency, None, Some(10.0)),
        ("fanuc", Rule::ConstantTorque, Some(0.7), None),
        ("fanuc", Rule::HoldingTorque, Some(0.6), None),
        ("fanuc", Rule::InertiaRatio, Some(5.0), Some(3.0)),
        ("fanuc", Rule::RmsTorque, Some(0.8), None),
        ("fanuc-contouring", Rule::InertiaRatio, Some(3.0), Some(1.0)),
        ("fanuc-contouring", Rule::ConstantTorque, Some(0.7), None),
        ("parker", Rule::InertiaRatio, Some(10.0), None),
        (
            "precision-gearhead",
            Rule::PeakTorque,
            Some(1.0 / 1.3),
            None,
        ),
        ("safety-factor-1.5", Rule::RmsTorque, Some(1.0 / 1.5), None),
        ("safety-factor-2", Rule::PeakTorque, Some(0.5), None),
        ("beckhoff-ax8000", Rule::Overload, Some(1.0), Some(0.8)),
    ] {
        let (found, warned) = limits(name, rule);
        for (found, expected) in [(found, fail), (warned, warn)] {
            assert_eq!(
                found.is_some(),
                expected.is_some(),
                "{name}: {}",
                rule.key()
            );
            if let (Some(found), Some(expected)) = (found, expected) {
                near(rule.key(), found, expected, 1e-12);
            }
        }
    }
}

/// Every key of every rule: limit, warning, both at once, off.
#[test]
fn every_key_can_be_set() {
    for rule in Rule::ALL {
        let (key, warning) = (rule.key(), rule.warning_key());
        let [limit, warn] = match rule.sense() {
            Sense::AtMost => [0.5, 0.25],
            Sense::AtLeast => [0.5, 0.75],
        };
        let expected = Limit {
            fail: Some(limit),
            warn: Some(warn),
        };
        for text in [
            format!("{key} = {limit}\n{warning} = {warn}"),
            format!("{key} = {{ limit = {limit}, warning = {warn}, source = \"we say so\" }}"),
        ] {
            let rules = read(&with_rules(&text)).rules;
            assert_eq!(rules.limit(rule), expected, "{key}");
            assert!(!rules.is_off(rule));
            let said = if text.contains("we say so") {
                "we say so"
            } else {
                "[rules] of the machine file"
            };
            assert_eq!(rules.source(rule), said);
        }
        let rules = read(&with_rules(&format!("{key} = \"off\""))).rules;
        assert!(rules.is_off(rule) && rules.shows(rule));
        for finding in [
            Finding::new(1e9, 1.0),
            Finding::new(-1.0, 1.0),
            Finding::UNKNOWN,
        ] {
            assert_eq!(rules.verdict(rule, finding), Verdict::Off, "{key}");
            assert_eq!(rules.use_of_limit(rule, finding), 0.0);
        }
    }
}

/// Limits are held at the limit, and violated just beyond; nothing known is never passed.
#[test]
fn verdicts_turn_at_the_limit() {
    let rules = RuleSet::default();
    let lambda = |value: f64| rules.verdict(Rule::InertiaRatio, Finding::new(value, 1.0));
    assert_eq!(
        [5.0, 5.000_001, 10.0, 10.000_001].map(lambda),
        [Verdict::Pass, Verdict::Warn, Verdict::Warn, Verdict::Fail]
    );
    let frequency = |value: f64| rules.verdict(Rule::NaturalFrequency, Finding::new(value, 2.0));
    assert_eq!(
        [19.999, 20.0].map(frequency),
        [Verdict::Warn, Verdict::Pass]
    );
    for finding in [
        Finding::UNKNOWN,
        Finding::new(1.0, f64::NAN),
        Finding::new(f64::NAN, 1.0),
    ] {
        assert_eq!(rules.verdict(Rule::RmsTorque, finding), Verdict::NotChecked);
    }
    // A warning alone is no limit of which a share could be used.
    assert_eq!(
        rules.use_of_limit(Rule::GearboxCycles, Finding::new(5000.0, 1000.0)),
        0.0
    );
    assert_eq!(
        rules.use_shown(Rule::GearboxCycles, Finding::new(5000.0, 1000.0)),
        5.0
    );
    assert_eq!(
        rules.use_of_limit(Rule::PeakTorque, Finding::new(1.0, 0.0)),
        f64::INFINITY
    );
}

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
    let rules = input::parse("m.toml", &text, &folder.path(""))
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
            &["`speed` is \"off\"", "leave one of the two out"],
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
            &["not above", "rising"],
        ),
        ("inertia_ratio_by_moves = []", &["0 bands"]),
        (
            "inertia_ratio_by_moves = [{ above = 60, limit = 5 }]\ninertia_ratio = 4",
            &["together with `inertia_ratio`"],
        ),
        (
            "set = \"mitsubishi-mr-j2s\"\ninertia_ratio_warning = 2",
            &["go by moves per minute", "inertia_ratio"],
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
    run.says(&["does not go with the set", "inertia_ratio_warning", "above"]);
    jred([&"size", &file, &"--rules", &"fanux"])
        .ends(2)
        .says(&["did you mean \"fanuc\"?"]);

    let list = jred([&"rules"]).ends(0).out;
    for name in input::rule_set_names() {
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
        input::rule_set_names().count()
    );
    assert_eq!(
        jred([&"rules", &"--format", &"csv"])
            .ends(0)
            .out
            .lines()
            .count(),
        1 + input::rule_set_names().count()
    );
    jred([&"rules", &"nothing"])
        .ends(2)
        .says(&["there is no rule set \"nothing\""]);
}

/// The examples of the documentation: changes to a set, and a set of one's own.
#[test]
fn the_documented_rules_are_read() {
    let documents = [
        include_str!("../../../docs/sizing-rules.md"),
        include_str!("../../../docs/machine-file.md"),
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
