//! Every key that is described is read.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use jred_file::keys::MACHINE;
use jred_file::read;
use jred_file::text::key::{KeyTable, ValueForm};
use serde_json::{Value, json};

use super::validated::machines;
use super::{named, places, root, tables_of};
use crate::reader;
use crate::reading::rendered;

/// The machines with the tables of `variants.toml`.
fn variants() -> Vec<(PathBuf, Value)> {
    let mut variants: Value = toml::from_str(include_str!("variants.toml")).unwrap();
    let mut made = Vec::new();
    for variant in variants["variant"].as_array_mut().unwrap() {
        let tables = variant.as_object_mut().unwrap();
        let base = tables.remove("base").unwrap();
        let path = root().join("machines").join(base.as_str().unwrap());
        let mut machine: Value = toml::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        for (name, value) in tables.clone() {
            match value {
                Value::Object(table) if name == "mechanism" => {
                    machine[name].as_object_mut().unwrap().extend(table);
                }
                value => machine[name] = value,
            }
        }
        if let Some(mechanism) = machine["mechanism"].as_object_mut() {
            mechanism.retain(|_, value| *value != json!([]));
        }
        if let Some(rules) = machine
            .get_mut("rules")
            .filter(|rules| **rules == json!({}))
        {
            let Some(ValueForm::Table(table)) = MACHINE.key("rules").map(|key| key.form) else {
                panic!("no table of rules");
            };
            for key in table
                .keys()
                .filter(|key| matches!(key.form, ValueForm::Any(_)))
            {
                rules[key.name] = json!({ "limit": 1 });
            }
        }
        made.push((path, machine));
    }
    made
}

#[test]
fn every_key_is_read() {
    // Why a key seems not to be read; empty of one that is.
    let mut doubts: BTreeMap<String, String> = BTreeMap::new();
    for (path, machine) in machines("machines").into_iter().chain(variants()) {
        for place in places(&machine) {
            for key in place.keys {
                let doubt = doubts.entry(format!("{}.{}", place.name, key.name));
                let doubt = doubt.or_insert_with(|| "in no machine".to_owned());
                if doubt.is_empty()
                    || place
                        .word
                        .as_ref()
                        .is_some_and(|word| !key.is_used_with(word))
                {
                    continue;
                }
                let mut changed = machine.clone();
                let table = changed.pointer_mut(&place.path).unwrap();
                let object = table.as_object_mut().unwrap();
                let others = place.either.iter().filter(|keys| keys.contains(&key.name));
                for other in others.flat_map(|keys| *keys) {
                    object.remove(*other);
                }
                table[key.name] = match key.form {
                    ValueForm::Flag => json!(7),
                    _ => json!(true),
                };
                let text = toml::to_string(&changed).unwrap();
                let answer = reader::parse("machine.toml", &text, root().join("machines"));
                let shown =
                    answer.map_or_else(|refusal| rendered(&refusal), |_| "accepted".to_owned());
                let is_read =
                    shown.contains(&format!("`{}`", key.name)) && !shown.contains("unknown key");
                *doubt = if is_read {
                    String::new()
                } else {
                    format!("{}: {shown}", path.display())
                };
            }
        }
    }
    for name in all_keys() {
        let doubt = doubts.get(&name).map_or("in no machine", |doubt| doubt);
        assert!(doubt.is_empty(), "{name} is not read: {doubt}");
    }
}

/// Every described key of a machine file: "slider-crank.crank.mass".
fn all_keys() -> Vec<String> {
    fn walk(table: &'static KeyTable, name: &str, found: &mut Vec<String>) {
        for key in table.keys() {
            let name = format!("{name}.{}", key.name);
            for inner in tables_of(key.form)
                .iter()
                .filter(|table| table.name.is_empty())
            {
                walk(inner, &name, found);
            }
            found.push(name);
        }
    }
    let mut found = Vec::new();
    // The keys of every mechanism are asked for with those of its type.
    let others = ["rule-set", "project", "axis", "mechanism"];
    for table in named()
        .into_iter()
        .filter(|table| !others.contains(&table.name))
    {
        walk(table, table.name, &mut found);
    }
    found
}

#[test]
fn the_types_of_mechanism_are_those_of_the_descriptions() {
    let described = MACHINE.key("mechanism").map(|key| key.form);
    let Some(ValueForm::Table(mechanism)) = described else {
        panic!("no table of mechanisms");
    };
    let names: Vec<_> = mechanism
        .variants
        .iter()
        .map(|variant| variant.name)
        .collect();
    assert_eq!(names, read::mechanism_types().collect::<Vec<_>>());
}
