//! Implausible figures are used, with a warning.

use jred_sizing::catalogue::{Catalogue, Sources};

use crate::support::{Folder, rows};

/// Figures typical of a servo motor of 1 kW and its gearbox.
const MOTOR: &[(&str, &str)] = &[
    ("key", "m1"),
    ("maker", "Maker"),
    ("model", "Model"),
    ("rated_torque [N m]", "3.2"),
    ("rated_speed [rpm]", "3000"),
    ("peak_torque [N m]", "11"),
    ("rotor_inertia [kg cm^2]", "1.9"),
    ("mass [kg]", "4.5"),
    ("torque_constant [N m/A]", "0.9"),
    ("voltage_constant [V/krpm]", "54.4"),
    ("rated_current [A]", "3.6"),
    ("peak_curve", "0 rpm: 11 N m; 4000 rpm: 5 N m"),
    ("source", "Sheet"),
];
const GEARBOX: &[(&str, &str)] = &[
    ("key", "g1"),
    ("maker", "Maker"),
    ("model", "Model"),
    ("ratio", "5"),
    ("rated_output_torque [N m]", "50"),
    ("peak_output_torque [N m]", "100"),
    ("max_input_speed [rpm]", "6000"),
    ("input_inertia [kg cm^2]", "0.67"),
    ("efficiency [%]", "97"),
    ("backlash [arcmin]", "8"),
    ("mass [kg]", "4.4"),
    ("source", "Sheet"),
];

fn table(columns: &[(&str, &str)], from: &str, to: &str) -> String {
    let header: Vec<&str> = columns.iter().map(|c| c.0).collect();
    let row: Vec<&str> = columns.iter().map(|c| c.1).collect();
    let text = format!("{}\n{}\n", header.join(","), row.join(","));
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

fn warnings(motor: &str, gearbox: &str) -> Vec<String> {
    let folder = Folder::new();
    folder.file("motors.csv", motor);
    folder.file("gearboxes.csv", gearbox);
    let sources = Sources {
        catalogues: vec![folder.path("")],
        ..Sources::default()
    };
    Catalogue::open(&sources).unwrap().warnings
}

#[test]
fn what_is_right_is_not_remarked_upon() {
    assert_eq!(
        warnings(&table(MOTOR, "", ""), &table(GEARBOX, "", "")),
        [""; 0]
    );
    assert_eq!(super::built_in().warnings, [""; 0]);
}

#[test]
fn units_mixed_up() {
    let cases = r#"
        rotor_inertia [kg cm^2] => rotor_inertia [kg m^2] => rotor_inertia of "m1"
        rotor_inertia [kg cm^2] => rotor_inertia [g cm^2] => less than for any known motor
        rotor_inertia [kg cm^2] => rotor_inertia [kg m^2] => solid cylinder
        rotor_inertia [kg cm^2] => rotor_inertia [kg m^2] => would reach its rated speed
        rated_torque [N m] => rated_torque [mN m] => torque per kg
        mass [kg] => mass [g] => torque per kg
        rated_speed [rpm],peak_torque [N m], => rated_speed [rad/s],peak_torque [N m], => "m1"
        rated_current [A] => rated_current [mA] => torque_constant times rated_current
        torque_constant [N m/A] => torque_constant [N m/A peak] => voltage_constant of "m1"
        torque_constant [N m/A] => torque_constant [N m/A peak] => torque_constant times
        54.4 => 94.2 => voltage_constant of "m1"
        0 rpm: 11 N m => 0 rpm: 12 N m => peak_curve of "m1"
    "#;
    for [from, to, words] in rows(cases) {
        let found = warnings(&table(MOTOR, &from, &to), &table(GEARBOX, "", ""));
        if from.starts_with("rated_speed") {
            // 3000 rad/s are 28 600 rpm, possible for a spindle.
            assert_eq!(found, [""; 0]);
            continue;
        }
        assert!(found.iter().any(|w| w.contains(&words)), "{to}: {found:?}");
        assert!(
            found.iter().all(|w| w.contains("motors.csv:2: ")),
            "{found:?}"
        );
    }
    let cases = r#"
        input_inertia [kg cm^2] => input_inertia [kg m^2] => input_inertia of "g1"
        backlash [arcmin] => backlash [deg] => backlash of "g1"
        97, => 0.97, => efficiency of "g1"
        mass [kg] => mass [g] => output torque per kg
    "#;
    for [from, to, words] in rows(cases) {
        let found = warnings(&table(MOTOR, "", ""), &table(GEARBOX, &from, &to));
        assert!(found.iter().any(|w| w.contains(&words)), "{to}: {found:?}");
        assert!(
            found.iter().all(|w| w.contains("gearboxes.csv:2: ")),
            "{found:?}"
        );
    }
}

/// Many rows with the same mistake: the first three are written out, the rest counted.
#[test]
fn many_of_a_kind_are_counted() {
    let mut motors = table(MOTOR, "rotor_inertia [kg cm^2]", "rotor_inertia [g cm^2]");
    let row = motors.lines().last().unwrap().to_owned();
    for number in 2..=50 {
        motors += &row.replacen("m1", &format!("m{number}"), 1);
        motors += "\n";
    }
    let found = warnings(&motors, &table(GEARBOX, "", ""));
    assert_eq!(
        found
            .iter()
            .filter(|w| w.contains("less than for any known motor"))
            .count(),
        3
    );
    let counted = "and 47 more rotor inertias that do not match the torque";
    assert!(found.iter().any(|w| w == counted), "{found:?}");
}
