//! Pairing of motors, gearboxes and amplifiers, against lists from plain loops.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use jred_sizing::catalogue::{
    Amplifier, Catalogue, Gearbox, Motor, MotorKind, Pairing, Sources, Winding,
};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use crate::support::Folder;
use crate::support::catalogue::HEADER;

const GEARBOXES: &str = "\
key,maker,model,ratio,rated_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source
p-3,M,P,3,50,6000,1,97,S
p-5,M,P,5,50,6000,1,97,S
q-3,M,Q,3,50,6000,1,97,S
q-own,M,Q,3,50,6000,1,97,S
";
const AMPLIFIERS: &str = "\
key,maker,model,rated_current [A],peak_current [A],source
a-5,M,A,5,15,S
a-10,M,A,10,30,S
";

fn motors(rows: &[&str]) -> String {
    let mut text = format!("{HEADER},built_in_gearbox\n");
    for row in rows {
        let (key, gearbox) = row.split_once(' ').unwrap_or((row, ""));
        writeln!(text, "{key},Maker,Model,8,2000,36,8.5,Sheet,{gearbox}").unwrap();
    }
    text
}

/// Motor, gearbox and amplifier of every drive.
fn names(catalogue: &Catalogue) -> Vec<String> {
    let names = catalogue.drives().map(|(id, drive)| {
        assert_eq!(catalogue.motors[id.motor()].key, drive.motor.key);
        let numbered = id.gearbox().map(|index| &catalogue.gearboxes[index].key);
        assert_eq!(numbered, drive.gearbox.map(|gearbox| &gearbox.key));
        let gearbox = drive.gearbox.map_or("direct", |g| &g.key);
        let amplifier = drive.amplifier.map_or("none", |a| &a.key);
        format!("{} {gearbox} {amplifier}", drive.motor.key)
    });
    let names: Vec<String> = names.collect();
    assert_eq!(names.len(), catalogue.count());
    let different: BTreeSet<&String> = names.iter().collect();
    assert_eq!(different.len(), names.len(), "a drive is there twice");
    names
}

fn open(folders: &[&[(&str, &str)]]) -> Result<Catalogue, String> {
    let folders: Vec<Folder> = folders
        .iter()
        .map(|files| {
            let folder = Folder::new();
            for (name, text) in *files {
                folder.file(name, text);
            }
            folder
        })
        .collect();
    let sources = Sources {
        catalogues: folders.iter().map(|f| f.path("")).collect(),
        ..Sources::default()
    };
    Catalogue::open(&sources).map_err(|e| format!("{:?}", miette::Report::new(e)))
}

#[test]
fn without_a_list_everything_goes_with_everything() {
    let table = motors(&["m1", "m2"]);
    let catalogue = open(&[&[("motors.csv", &table), ("gearboxes.csv", GEARBOXES)]]).unwrap();
    let found = names(&catalogue);
    assert_eq!(found.len(), 2 * 5);
    assert_eq!(found[0], "m1 direct none");
    assert_eq!(found[4], "m1 q-own none");
    let with = open(&[&[
        ("motors.csv", &table),
        ("gearboxes.csv", GEARBOXES),
        ("amplifiers.csv", AMPLIFIERS),
    ]]);
    assert_eq!(names(&with.unwrap()).len(), 2 * 5 * 2);
}

#[test]
fn by_a_list() {
    let table = motors(&["m1", "m2", "m3", "m4", "n1"]);
    let list = "\
motor,gearboxes,direct,amplifiers
m1,p-5; q-3,yes,
m2,p*; p-3,no,a-10
m3,,,a*
";
    let catalogue = open(&[
        &[
            ("motors.csv", table.as_str()),
            ("gearboxes.csv", GEARBOXES),
            ("amplifiers.csv", AMPLIFIERS),
            ("compatibility.csv", list),
        ],
        // A second catalogue without a list pairs freely.
        &[("my_motors.csv", &motors(&["z1"]))],
    ])
    .unwrap();
    let mut expected = Vec::new();
    for (motor, gearboxes, amplifiers) in [
        // Amplifiers of another maker run only the motors for which the list names them.
        ("m1", &["direct", "p-5", "q-3"][..], &["none"][..]),
        ("m2", &["p-3", "p-5"], &["a-10"]),
        ("m3", &["direct"], &["a-5", "a-10"]),
        ("m4", &["direct"], &["none"]),
        ("n1", &["direct"], &["none"]),
        ("z1", &["direct", "p-3", "p-5", "q-3", "q-own"], &["none"]),
    ] {
        for gearbox in gearboxes {
            for amplifier in amplifiers {
                expected.push(format!("{motor} {gearbox} {amplifier}"));
            }
        }
    }
    assert_eq!(names(&catalogue), expected);
    for (index, motor) in catalogue.motors.iter().enumerate() {
        let of: Vec<_> = catalogue.drives_of(index..index + 1).collect();
        let all = catalogue.drives().filter(|(_, d)| d.motor.key == motor.key);
        assert_eq!(of.len(), all.count());
        assert!(of.iter().all(|(id, _)| id.motor() == index));
    }
}

/// A list in TOML; a list without gearboxes does not restrict them; several motors on one line.
#[test]
fn lists_in_toml() {
    let table = motors(&["m1", "m2", "n1"]);
    let with = |list: &str| {
        let files = [
            ("motors.csv", table.as_str()),
            ("gearboxes.csv", GEARBOXES),
            ("amplifiers.csv", AMPLIFIERS),
            ("list.toml", list),
        ];
        open(&[&files]).map(|c| names(&c))
    };
    let only_amplifiers =
        with("[[compatibility]]\nmotor = \"m*\"\namplifiers = [\"a-5\"]\n").unwrap();
    assert_eq!(only_amplifiers.len(), 5 + 5 + 5);
    let none = with("[[compatibility]]\nmotor = \"*\"\ngearboxes = []\namplifiers = \"a-5\"\n");
    assert_eq!(
        none.unwrap(),
        ["m1 direct a-5", "m2 direct a-5", "n1 direct a-5"]
    );
    // Two lines for one motor add up.
    let two = "[[compatibility]]\nmotor = \"m1\"\ngearboxes = [\"p-3\"]\n\
               [[compatibility]]\nmotor = \"m*\"\ngearboxes = [\"q-3\"]\ndirect = false\n";
    let two = with(two).unwrap();
    assert_eq!(two.len(), 2 * (2 + 1 + 1));
    assert_eq!(
        &two[..4],
        ["m1 p-3 a-5", "m1 p-3 a-10", "m1 q-3 a-5", "m1 q-3 a-10"]
    );
    for (list, words) in [
        (
            "motor = \"m7\"\n",
            ["no motor has the key \"m7\"", "did you mean \"m"],
        ),
        (
            "motor = \"m1\"\ngearboxes = [\"p-4\"]\n",
            ["no gearbox has the key \"p-4\"", "did you mean"],
        ),
        (
            "motor = \"m1\"\ngearboxes = [\"r*\"]\n",
            ["no gearbox has the key \"r*\"", "matches all keys"],
        ),
        (
            "motor = \"m1\"\namplifiers = [\"b-5\"]\n",
            ["no amplifier has the key \"b-5\"", "m1"],
        ),
    ] {
        let error = with(&format!("[[compatibility]]\n{list}")).unwrap_err();
        for word in words {
            assert!(error.contains(word), "{word:?} is not in\n{error}");
        }
    }
}

#[test]
fn gear_motors_keep_their_own_gearbox() {
    let table = motors(&["g1 q-own", "m1"]);
    let catalogue = open(&[&[("motors.csv", &table), ("gearboxes.csv", GEARBOXES)]]).unwrap();
    assert_eq!(
        names(&catalogue),
        [
            "g1 q-own none",
            "m1 direct none",
            "m1 p-3 none",
            "m1 p-5 none",
            "m1 q-3 none"
        ]
    );
    let table = motors(&["g1 q-won", "m1"]);
    let error = open(&[&[("motors.csv", &table), ("gearboxes.csv", GEARBOXES)]]).unwrap_err();
    assert!(
        error.contains("no gearbox has the key \"q-won\""),
        "{error}"
    );
    assert!(error.contains("did you mean \"q-own\"?"), "{error}");
}

/// A catalogue built in code, as tests and studies do.
#[test]
fn put_together_in_code() {
    let catalogue = Catalogue {
        motors: vec![
            Motor::default(),
            Motor {
                kind: MotorKind::Linear,
                ..Motor::default()
            },
        ],
        gearboxes: vec![Gearbox::default(); 3],
        ..Catalogue::default()
    };
    assert_eq!(catalogue.count(), 4 + 1);
    assert_eq!(catalogue.drives().count(), 4 + 1);
    assert_eq!(Catalogue::default().drives().count(), 0);
}

#[test]
fn amplifiers_that_suit() {
    let motor = |voltage, current| Motor {
        bus_voltage: voltage,
        winding: Winding {
            standstill_current: current,
            rated_current: Some(1e6),
            ..Winding::default()
        },
        ..Motor::default()
    };
    let amplifier = |voltage, current| Amplifier {
        bus_voltage: voltage,
        rated_current: current,
        ..Amplifier::default()
    };
    for (motor_voltage, motor_current, voltage, current, suits) in [
        (None, None, None, 1.0, false),
        (None, Some(5.0), None, 2.5, true),
        (None, Some(5.0), None, 2.4, false),
        (None, Some(5.0), None, 20.0, true),
        (None, Some(5.0), None, 21.0, false),
        (Some(325.0), Some(5.0), Some(282.0), 5.0, true),
        (Some(282.0), Some(5.0), Some(325.0), 5.0, true),
        (Some(325.0), Some(5.0), Some(560.0), 5.0, false),
        (Some(560.0), Some(5.0), Some(325.0), 5.0, false),
        (Some(540.0), Some(5.0), Some(680.0), 5.0, true),
        (Some(560.0), Some(5.0), None, 5.0, true),
    ] {
        let found = Pairing::suits(
            &motor(motor_voltage, motor_current),
            &amplifier(voltage, current),
        );
        assert_eq!(
            found, suits,
            "{motor_voltage:?} {motor_current:?} {voltage:?} {current}"
        );
    }
}

/// The voltage class of a motor widens the range upwards; a mains voltage is compared after its rectifier.
#[test]
fn amplifiers_that_suit_what_a_motor_is_made_for() {
    let amplifier = |mains| Amplifier {
        mains_voltage: Some(mains),
        rated_current: 5.0,
        ..Amplifier::default()
    };
    let motor = |figures, mains, largest| Motor {
        bus_voltage: figures,
        mains_voltage: mains,
        max_bus_voltage: largest,
        winding: Winding {
            rated_current: Some(5.0),
            ..Winding::default()
        },
        ..Motor::default()
    };
    for (figures, mains, largest, on, suits) in [
        (None, Some(200.0), None, 230.0, true),
        (None, Some(200.0), None, 400.0, false),
        (None, Some(400.0), None, 230.0, false),
        (None, Some(400.0), None, 480.0, true),
        (Some(320.0), None, None, 400.0, false),
        (Some(320.0), None, Some(800.0), 400.0, true),
        (Some(320.0), Some(400.0), None, 400.0, true),
        (None, None, Some(500.0), 400.0, false),
        (None, None, None, 400.0, true),
    ] {
        let found = Pairing::suits(&motor(figures, mains, largest), &amplifier(on));
        assert_eq!(found, suits, "{figures:?} {mains:?} {largest:?} on {on}");
    }
}

/// Random lists with partial keys, against every pair checked individually.
#[test]
fn random_lists_against_looking_at_every_pair() {
    let mut random = ChaCha8Rng::seed_from_u64(20);
    for _ in 0..30 {
        let word = |random: &mut ChaCha8Rng, most: usize| {
            let length = random.random_range(1..=most);
            let letter = |_| ["a", "b", "c", "*"][random.random_range(0..3)];
            (0..length).map(letter).collect::<String>()
        };
        let mut motor_keys: Vec<String> = (0..6).map(|_| word(&mut random, 4)).collect();
        let mut gearbox_keys: Vec<String> = (0..30).map(|_| word(&mut random, 5)).collect();
        for keys in [&mut motor_keys, &mut gearbox_keys] {
            keys.sort();
            keys.dedup();
        }
        let motors = motors(&motor_keys.iter().map(String::as_str).collect::<Vec<_>>());
        let mut gearboxes = GEARBOXES.lines().next().unwrap().to_owned() + "\n";
        for key in &gearbox_keys {
            writeln!(gearboxes, "{key},M,P,3,50,6000,1,97,S").unwrap();
        }
        let mut lists = Vec::new();
        let mut table = "motor,gearboxes\n".to_owned();
        for key in &motor_keys {
            for _ in 0..random.random_range(0..3) {
                let mut patterns = Vec::new();
                for _ in 0..random.random_range(0..4) {
                    let near = &gearbox_keys[random.random_range(0..gearbox_keys.len())];
                    patterns.push(match random.random_range(0..near.len() + 1) {
                        cut if cut == near.len() => near.clone(),
                        cut => format!("{}*", &near[..cut]),
                    });
                }
                writeln!(table, "{key},{}", patterns.join(";")).unwrap();
                lists.push((key.clone(), patterns));
            }
        }
        if lists.is_empty() {
            continue;
        }
        let files = [
            ("motors.csv", motors.as_str()),
            ("gearboxes.csv", &gearboxes),
            ("compatibility.csv", &table),
        ];
        let found: BTreeSet<String> = names(&open(&[&files]).unwrap()).into_iter().collect();
        let mut expected = BTreeSet::new();
        for motor in &motor_keys {
            expected.insert(format!("{motor} direct none"));
            for gearbox in &gearbox_keys {
                let named = lists
                    .iter()
                    .filter(|(m, _)| m == motor)
                    .any(|(_, patterns)| {
                        patterns.iter().any(|p| match p.strip_suffix('*') {
                            Some(start) => gearbox.starts_with(start),
                            None => gearbox == p,
                        })
                    });
                if named {
                    expected.insert(format!("{motor} {gearbox} none"));
                }
            }
        }
        assert_eq!(found, expected, "{table}");
    }
}

#[test]
fn several_catalogues_are_merged() {
    let one = motors(&["m1"]);
    let error = open(&[&[("motors.csv", &one)], &[("motors.csv", &one)]]).unwrap_err();
    let flat = error.split_whitespace().collect::<String>();
    assert!(flat.contains("duplicatekey\"m1\":in"), "{error}");
    assert_eq!(
        flat.matches("motors.csv").count(),
        3,
        "both files and the place: {error}"
    );
}

/// An amplifier of another maker runs a motor only if a list says so, or if the catalogue pairs no amplifiers and has none of the motor's maker.
/// Names are compared regardless of spelling variants.
#[test]
fn amplifiers_of_another_maker() {
    let table = |maker: &str| motors(&["m1"]).replace(",Maker,", &format!(",{maker},"));
    let with = |maker: &str, list: &str| {
        let table = table(maker);
        let own = AMPLIFIERS.to_owned() + "o-5,Other-Maker,A,5,15,S\n";
        let mut files = vec![
            ("motors.csv", table.as_str()),
            ("amplifiers.csv", own.as_str()),
        ];
        if !list.is_empty() {
            files.push(("compatibility.csv", list));
        }
        open(&[&files]).unwrap()
    };
    for (maker, list, expected) in [
        // No list, and no amplifier of its maker: by the figures, as uncertain.
        ("Maker", "", &["a-5", "a-10", "o-5"][..]),
        // Only those of its own maker.
        ("M", "", &["a-5", "a-10"]),
        ("OTHER MAKER", "", &["o-5"]),
        // A list takes precedence over makers.
        ("M", "motor,amplifiers\nm1,o-5\n", &["o-5"]),
        ("Maker", "motor,amplifiers\nm1,o-5 a-5\n", &["a-5", "o-5"]),
    ] {
        let catalogue = with(maker, list);
        let found: Vec<&str> = catalogue.amplifiers_of(0).iter().map(|a| &*a.key).collect();
        assert_eq!(found, expected, "{maker} {list}");
        let certain = maker != "Maker" || !list.is_empty();
        assert!(
            catalogue
                .drives()
                .all(|(_, drive)| drive.is_paired() == certain)
        );
        let said = |words: &str| {
            catalogue
                .warnings
                .iter()
                .filter(|w| w.contains(words))
                .count()
        };
        let strangers = said("no list of the catalogue pairs motors of Maker with amplifiers of");
        assert_eq!(
            strangers,
            if certain { 0 } else { 2 },
            "{:?}",
            catalogue.warnings
        );
        let idle = said("runs no motor of the catalogue");
        assert_eq!(idle, 3 - expected.len(), "{:?}", catalogue.warnings);
    }
}
