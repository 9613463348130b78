//! New machine files: they hold their values and nothing else, name every key, and what they propose is read.

use std::collections::BTreeSet;

use jred_file::keys::{MACHINE, starter};
use jred_file::read::{mechanism_types, parse};
use jred_file::text::key::{Key, KeyTable, ValueForm};
use toml::Table;

use super::tables_of;

/// The file that the starters are made from.
fn values() -> Table {
    include_str!("../../src/keys/starters.toml")
        .parse()
        .unwrap()
}

/// Files that a machine file may name.
fn files() -> std::collections::BTreeMap<String, String> {
    let curves = include_str!("../../../../machines/reduced-curves.csv");
    [("curves.csv".to_owned(), curves.to_owned())].into()
}

fn written(kind: &str, all: bool) -> String {
    starter::machine_file(kind, all).unwrap_or_else(|| panic!("{kind} has no values"))
}

#[test]
fn every_type_can_be_begun_and_is_told() {
    let types: BTreeSet<_> = starter::types().map(|(name, _)| name.to_owned()).collect();
    assert_eq!(types.len(), 24);
    let known: BTreeSet<_> = mechanism_types().map(str::to_owned).collect();
    assert_eq!(types, known);
    let given: BTreeSet<_> = values()
        .keys()
        .filter(|key| *key != "all")
        .cloned()
        .collect();
    assert_eq!(
        types, given,
        "values of a type that does not exist, or none"
    );
    for (name, about) in starter::types() {
        assert!(about.len() > 10, "{name}: {about:?}");
    }
    assert_eq!(starter::machine_file("press", false), None);
}

/// A value without a key, or a required key without a value, would be another table.
#[test]
fn a_file_holds_its_values() {
    let values = values();
    for (kind, _) in starter::types() {
        let mut expected = values["all"].as_table().unwrap().clone();
        expected.extend(values[kind].as_table().unwrap().clone());
        expected.remove("about");
        expected["mechanism"]
            .as_table_mut()
            .unwrap()
            .insert("type".to_owned(), kind.into());
        for all in [false, true] {
            let text = written(kind, all);
            assert!(text.starts_with("#:schema "), "{text}");
            assert_eq!(text.parse::<Table>().unwrap(), expected, "{kind}");
        }
    }
}

/// Names of all keys below a table, but those of the types of mechanisms.
fn names(table: &'static KeyTable, found: &mut BTreeSet<&'static str>) {
    for key in table.keys() {
        found.insert(key.name);
        if let ValueForm::Table(_) | ValueForm::Tables(..) = key.form {
            for table in tables_of(key.form) {
                names(table, found);
            }
        }
    }
}

fn is_told(text: &str, key: &Key) -> bool {
    let name = key.name;
    text.lines().any(|line| {
        let line = line.trim_start_matches("# ");
        line.starts_with(&format!("{name} = "))
            || line.starts_with('[') && line.contains(&format!("{name}]"))
    })
}

#[test]
fn every_key_of_a_type_is_in_its_file() {
    for (kind, _) in starter::types() {
        let text = written(kind, false);
        let mechanism = MACHINE.key("mechanism").unwrap().form;
        let [table] = tables_of(mechanism)[..] else {
            panic!("one table of mechanisms")
        };
        let variant = table
            .variants
            .iter()
            .find(|known| known.name == kind)
            .unwrap();
        // Keys of one law only are not those of another.
        let missing: Vec<_> = variant
            .keys()
            .filter(|key| key.only.is_empty() && !is_told(&text, key))
            .map(|key| key.name)
            .collect();
        assert!(missing.is_empty(), "{kind}: {missing:?}");
    }
    // With `--all` those of every other table.
    let text = written("slider-crank", true);
    let mut known = BTreeSet::new();
    names(&MACHINE, &mut known);
    let told = known.iter().filter(|name| {
        let key = jred_file::text::key::may(name, ValueForm::Text, "");
        is_told(&text, &key)
    });
    let told: BTreeSet<_> = told.copied().collect();
    let missing: Vec<_> = known.difference(&told).collect();
    assert!(known.len() > 150, "{}", known.len());
    assert!(missing.len() < 25, "{missing:?}");
}

/// A proposed line without its `#` is read, or refused for what the machine lacks, but never as an unknown key, unit or form.
#[test]
fn a_proposal_is_a_value_of_its_key() {
    let (mut read, mut refused) = (0, BTreeSet::new());
    for (kind, _) in starter::types() {
        let text = written(kind, false);
        let lines: Vec<&str> = text.lines().collect();
        let mut is_active = true;
        for (k, line) in lines.iter().enumerate() {
            let bare = line.trim_start_matches("# ");
            if bare.starts_with('[') {
                is_active = bare.len() == line.len();
            }
            let is_key = bare.parse::<Table>().is_ok_and(|table| table.len() == 1);
            if !is_active || bare.len() == line.len() || !is_key || bare.starts_with('[') {
                continue;
            }
            let mut lines = lines.clone();
            lines[k] = bare;
            match parse("new.toml", &lines.join("\n"), files()) {
                Ok(_) => read += 1,
                Err(problem) => {
                    let word = bare.split(' ').next().unwrap();
                    refused.insert(format!("{word}: {problem}"));
                }
            }
        }
    }
    assert!(read > 300, "{read}");
    let is_of_form = |problem: &&String| {
        ["unknown key", "must be a ", "must be an ", "unit"]
            .iter()
            .any(|word| problem.contains(word))
    };
    let wrong: Vec<_> = refused.iter().filter(is_of_form).collect();
    // Keys of another form: of a table, of another law or motion, of a value of another kind.
    let others = [
        "columns:",
        "skip_rows:",
        "header:",
        "counts_per_turn:",
        "lift_within:",
        "lift_speed:",
        "accelerate:",
        "decelerate:",
        "duration:",
        "at_rest:",
    ];
    let wrong = wrong
        .iter()
        .filter(|problem| !others.iter().any(|key| problem.starts_with(key)));
    assert_eq!(wrong.collect::<Vec<_>>(), Vec::<&&String>::new());
}
