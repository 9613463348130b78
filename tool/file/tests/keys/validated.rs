//! Machine files against the schema: good ones have no violation; misspelt keys, missing keys and wrong units are violations.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use jred_file::text::key::{Key, Need, ValueForm};
use jred_file::units::kind::{
    ANGLE, ANGULAR_SPEED, FORCE, INERTIA, Kind, LENGTH, SHARE, TEMPERATURE, TORQUE, VISCOUS_MOMENT,
};
use jred_file::units::quantity::read;
use jsonschema::Validator;
use serde_json::{Value, json};

use super::pattern::{is_share, quantity};
use super::schema::schema;
use super::{Place, places, root, words_of};

fn validator() -> Validator {
    jsonschema::draft202012::new(&schema()).unwrap()
}

/// Files `*.toml` of the folder and below it that have a mechanism.
pub(super) fn machines(folder: &str) -> Vec<(PathBuf, Value)> {
    fn walk(folder: &Path, found: &mut Vec<(PathBuf, Value)>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|end| end == "toml") {
                let text = fs::read_to_string(&path).unwrap();
                let value: Value = toml::from_str(&text).unwrap();
                if value.get("mechanism").is_some() {
                    found.push((path, value));
                }
            }
        }
    }
    let mut found = Vec::new();
    walk(&root().join(folder), &mut found);
    found.sort_by(|one, other| one.0.cmp(&other.0));
    assert!(!found.is_empty(), "{folder}: no machine");
    found
}

/// The violations of a document.
fn faults(validator: &Validator, document: &Value) -> Vec<String> {
    let faults = validator.iter_errors(document);
    faults
        .map(|fault| format!("{}: {fault}", fault.instance_path))
        .collect()
}

#[test]
fn machines_of_the_repository_have_no_violation() {
    let validator = validator();
    for folder in [
        "machines",
        "examples",
        "tool/file/tests/data",
        "tool/support/engineer",
        "tool/analysis/tests/cross_check",
        "tool/sizing/tests/data/engineer",
    ] {
        for (path, machine) in machines(folder) {
            let faults = faults(&validator, &machine);
            assert!(faults.is_empty(), "{}: {faults:#?}", path.display());
        }
    }
}

/// Every document that `change` makes of a machine in `machines/` at one of its keys is a violation; returns how many there are.
#[track_caller]
fn refused(change: impl Fn(&mut serde_json::Map<String, Value>, &Key) -> bool) -> usize {
    let validator = validator();
    let mut count = 0;
    for (path, machine) in machines("machines") {
        let keys = places(&machine).into_iter().flat_map(|place| {
            let Place { path, keys, .. } = place;
            keys.into_iter().map(move |key| (path.clone(), key))
        });
        for (table, key) in keys {
            if machine.pointer(&table).unwrap().get(key.name).is_none() {
                continue;
            }
            let mut changed = machine.clone();
            let object = changed
                .pointer_mut(&table)
                .unwrap()
                .as_object_mut()
                .unwrap();
            if change(object, key) {
                count += 1;
                assert!(
                    !validator.is_valid(&changed),
                    "{}: {table}/{} is accepted: {}",
                    path.display(),
                    key.name,
                    changed.pointer(&table).unwrap()
                );
            }
        }
    }
    count
}

#[test]
fn a_misspelt_key_is_a_violation() {
    let count = refused(|object, key| {
        let value = object.remove(key.name).unwrap();
        object.insert(format!("{}_", key.name), value);
        true
    });
    assert!(count > 1000, "{count} keys");
}

#[test]
fn a_missing_key_is_a_violation() {
    let count = refused(|object, key| {
        object.remove(key.name);
        // Without its table it is a plain load; that a load acts is for the program to check.
        key.need == Need::Required && key.name != "table"
    });
    assert!(count > 500, "{count} keys");
}

#[test]
fn a_wrong_type_is_a_violation() {
    let count = refused(|object, key| {
        object.insert(key.name.to_owned(), json!([[[1]]]));
        true
    });
    assert!(count > 1000, "{count} keys");
}

/// No key holds a current; a number needs its unit, if it is not a share.
#[test]
fn a_wrong_unit_is_a_violation() {
    let count = refused(|object, key| {
        let wrong = match key.form {
            ValueForm::Quantity([kind, _], _) if is_share(kind) => json!("1 A"),
            ValueForm::Quantity(..) if key.name.len() % 2 == 0 => json!("30"),
            ValueForm::Quantity(..) => json!("1 A"),
            ValueForm::Pair(_) => json!(["0 A", "1 A"]),
            _ => return false,
        };
        object.insert(key.name.to_owned(), wrong);
        true
    });
    assert!(count > 800, "{count} keys");
}

#[test]
fn a_word_decides_which_keys_are_used() {
    let validator = validator();
    let named = |name: &str| {
        let mut machines = machines("machines").into_iter();
        let found = machines.find(|(path, _)| path.file_name().is_some_and(|file| file == name));
        found.unwrap().1
    };
    let press = named("press.toml");
    let change = |path: &str, value: Value| {
        let mut changed = press.clone();
        let (table, key) = path.rsplit_once('/').unwrap();
        changed.pointer_mut(table).unwrap()[key] = value;
        faults(&validator, &changed)
    };
    assert_eq!(change("/motion/speed", json!("60 rpm")).len(), 1);
    assert_ne!(change("/motion/type", json!("constant-speed")).len(), 0);
    assert_ne!(change("/mechanism/type", json!("scotch-yoke")).len(), 0);
    assert_ne!(change("/mechanism/type", json!("slider-krank")).len(), 0);
    assert_ne!(change("/mechanism/crank/length", json!("-80 mm")).len(), 0);
    assert_ne!(change("/load/1/moment", json!("1 N m")).len(), 0);
    assert_ne!(change("/drive_train/0/efficiency", json!("-4 %")).len(), 0);
}

/// The reader's verdict on a text, and the pattern's.
fn both(text: &str, kind: &Kind) -> [bool; 2] {
    let schema = json!({ "type": "string", "pattern": quantity(&[kind], false) });
    let pattern = jsonschema::draft202012::new(&schema).unwrap();
    [read(text, kind).is_ok(), pattern.is_valid(&json!(text))]
}

#[test]
fn patterns_accept_what_people_write() {
    let good: [(&Kind, &[&str]); 8] = [
        (
            &LENGTH,
            &[
                "80 mm",
                "80mm",
                " -0.5 m ",
                "+1e-3 km",
                "3.e2 µm",
                ".5 um",
                "2*10^-3 m",
                "−4 cm",
                "3 in",
                "1.5 ft",
            ],
        ),
        (
            &TORQUE,
            &[
                "12 N m",
                "12 Nm",
                "12 N·m",
                "12 kN*mm",
                "1.2e3 m N",
                "3 N.m",
                "4×10^2 mNm",
                "12 lb in",
                "12 in-lb",
                "12 oz-in",
                "3 ft lbf",
                "3 kgf m",
            ],
        ),
        (
            &INERTIA,
            &[
                "2.4 kg cm^2",
                "2 kgcm2",
                "3 kg·m²",
                "5 g mm ^2",
                "7 m^2 kg",
                "2 lb in s^2",
                "2 oz-in-s²",
                "2 lb in^2",
            ],
        ),
        (
            &ANGULAR_SPEED,
            &[
                "60 rpm",
                "60 RPM",
                "60 1/min",
                "60 min^-1",
                "60 min-1",
                "60 min⁻¹",
                "3 rad/s",
                "9 deg / s",
                "3 rad s^-1",
                "20 °/s",
                "60 U/min",
                "1 rev/min",
            ],
        ),
        (
            &VISCOUS_MOMENT,
            &[
                "0.4 N m s/rad",
                "0.4 Nms",
                "0.4 N m/rpm",
                "2 N m s rad^-1",
                "1 mN·m·s",
            ],
        ),
        (&SHARE, &["97 %", "97%", "0.97", "1e-2"]),
        (
            &TEMPERATURE,
            &["40 degC", "40 °C", "-5 C", "104 degF", "104 °F"],
        ),
        (&ANGLE, &["30 deg", "30°", "2 rev", "4 arcmin", "1 mrad"]),
    ];
    for (kind, texts) in good {
        for text in texts {
            assert_eq!(both(text, kind), [true; 2], "\"{text}\" is {}", kind.name);
        }
    }
    let bad: [(&Kind, &[&str]); 6] = [
        (
            &LENGTH,
            &[
                "80", "80 kg", "80 mm 5", "80 Mm", "80,5 mm", "mm", "80 mm^2", "1 1 mm", "",
                "3 inches",
            ],
        ),
        (&TORQUE, &["12 N", "12 N m^2", "12 N/m", "12 J", "12 nm"]),
        (&ANGULAR_SPEED, &["60 Hz", "60 1/s", "60 rad", "60 rad/s^2"]),
        (&TEMPERATURE, &["300 K", "40", "40 F"]),
        (&SHARE, &["97 percent", "97 deg"]),
        (&FORCE, &["12 kg", "12 N m", "1/2 N", "12 psi"]),
    ];
    for (kind, texts) in bad {
        for text in texts {
            assert_eq!(
                both(text, kind),
                [false; 2],
                "\"{text}\" is not {}",
                kind.name
            );
        }
    }
}

/// Every unit of every word that a pattern accepts is one that the reader accepts.
#[test]
fn examples_and_proposed_units_match_their_patterns() {
    let mut kinds: BTreeMap<&str, &Kind> = BTreeMap::new();
    for table in super::named() {
        for key in table.keys() {
            if let ValueForm::Quantity(pair, _) | ValueForm::Pair(pair) = key.form {
                kinds.extend(pair.map(|kind| (kind.name, kind)));
            }
            assert!(words_of(table, key).iter().all(|word| !word.contains(' ')));
        }
    }
    for kind in kinds.into_values() {
        assert_eq!(both(kind.example, kind), [true; 2], "{}", kind.example);
        for unit in kind
            .units
            .split(", ")
            .filter(|unit| !unit.starts_with("or "))
        {
            assert_eq!(both(&format!("2 {unit}"), kind), [true; 2], "{unit}");
        }
    }
}
