//! Quantities as users write them, right and wrong.

use super::{read, unit_of};
use crate::units::kind::{
    ACCELERATION, ANGLE, ANGULAR_SPEED, FORCE, GAIN, INERTIA, Kind, LENGTH, MASS, POWER, SHARE,
    TEMPERATURE, TIME, TORQUE, VELOCITY, VISCOUS_FORCE, VISCOUS_MOMENT,
};

use std::f64::consts::{PI, TAU};

/// The number of doubles between two positive ones.
fn ulps(a: f64, b: f64) -> u64 {
    a.abs().to_bits().abs_diff(b.abs().to_bits())
}

#[test]
fn values_are_exact_to_the_last_digit() {
    let cases: [(&str, &Kind, f64); 56] = [
        ("120 mm", &LENGTH, 0.12),
        ("0.1 mm", &LENGTH, 0.0001),
        ("33.3 cm", &LENGTH, 0.333),
        ("7 µm", &LENGTH, 7e-6),
        ("0.35 kg", &MASS, 0.35),
        ("350 g", &MASS, 0.35),
        ("1.7 t", &MASS, 1700.0),
        ("2.4 kg cm^2", &INERTIA, 2.4e-4),
        ("2.4 kg·cm²", &INERTIA, 2.4e-4),
        ("2.4kg*cm^2", &INERTIA, 2.4e-4),
        ("1.2e-3 kg m^2", &INERTIA, 1.2e-3),
        ("1.2E-3 kg m^2", &INERTIA, 1.2e-3),
        ("1.2 × 10⁻³ kg m²", &INERTIA, 1.2e-3),
        ("12 kg mm^2", &INERTIA, 12e-6),
        ("180 deg", &ANGLE, PI),
        ("360°", &ANGLE, TAU),
        ("0.5 rad", &ANGLE, 0.5),
        ("60 rpm", &ANGULAR_SPEED, TAU),
        ("1450 rpm", &ANGULAR_SPEED, 1450.0 * TAU / 60.0),
        ("10 rad/s", &ANGULAR_SPEED, 10.0),
        ("180 deg/s", &ANGULAR_SPEED, PI),
        ("5 ms", &TIME, 0.005),
        ("0.75 s", &TIME, 0.75),
        ("-20 kN", &FORCE, -20_000.0),
        ("+1e+3 N", &FORCE, 1000.0),
        ("−150 N", &FORCE, -150.0),
        ("14 N m", &TORQUE, 14.0),
        ("14 Nm", &TORQUE, 14.0),
        ("14 N·m", &TORQUE, 14.0),
        ("9.81 m/s^2", &ACCELERATION, 9.81),
        ("9.81 m s⁻²", &ACCELERATION, 9.81),
        ("30 N s/m", &VISCOUS_FORCE, 30.0),
        ("0.4 N m s/rad", &VISCOUS_MOMENT, 0.4),
        ("0.4 N m s", &VISCOUS_MOMENT, 0.4),
        ("1500 1/min", &ANGULAR_SPEED, 50.0 * PI),
        ("1500 min^-1", &ANGULAR_SPEED, 50.0 * PI),
        ("1500 min⁻¹", &ANGULAR_SPEED, 50.0 * PI),
        ("1500 RPM", &ANGULAR_SPEED, 50.0 * PI),
        ("1500 U/min", &ANGULAR_SPEED, 50.0 * PI),
        ("2 rev/s", &ANGULAR_SPEED, 2.0 * TAU),
        ("0.25 turn", &ANGLE, 0.5 * PI),
        ("30 1/min", &GAIN, 0.5),
        ("90 m/min", &VELOCITY, 1.5),
        ("3 min", &TIME, 180.0),
        ("4 kgcm2", &INERTIA, 4e-4),
        ("4 kgcm²", &INERTIA, 4e-4),
        ("4 kg.cm2", &INERTIA, 4e-4),
        ("4 kgm²", &INERTIA, 4.0),
        ("4 kg cm2", &INERTIA, 4e-4),
        ("4 Nms/rad", &VISCOUS_MOMENT, 4.0),
        ("4 N.m", &TORQUE, 4.0),
        ("2 m/s2", &ACCELERATION, 2.0),
        // 550 ft·lbf/s with the exact foot, pound and standard gravity; 75 kgf·m/s.
        (
            "2 hp",
            &POWER,
            2.0 * 550.0 * 0.3048 * 0.453_592_37 * 9.80665,
        ),
        ("2 PS", &POWER, 2.0 * 75.0 * 9.80665),
        ("97 %", &SHARE, 0.97),
        ("0.97", &SHARE, 0.97),
    ];
    for (text, kind, expected) in cases {
        let found = read(text, kind)
            .unwrap_or_else(|fault| panic!("{text}: {fault:?}"))
            .si;
        assert!(found * expected > 0.0, "{text}");
        assert!(
            ulps(found, expected) <= 1,
            "{text} gives {found:e}, not {expected:e}"
        );
    }
    // 0.1 N m/rpm = 0.1·60/2π N m s/rad
    let found = read("0.1 N m/rpm", &VISCOUS_MOMENT).unwrap().si;
    assert!((found / (6.0 / TAU) - 1.0).abs() < 1e-15);
}

/// The international inch and pound, the standard gravity, and the definitions that follow from them.
const INCH: f64 = 25.4e-3;
const FOOT: f64 = 12.0 * INCH;
const POUND: f64 = 0.453_592_37;
const G: f64 = 9.80665;

#[test]
fn units_of_inches_and_pounds() {
    let lbf = POUND * G;
    let cases: [(&str, &Kind, f64); 55] = [
        ("4 in", &LENGTH, 4.0 * INCH),
        ("1.5 ft", &LENGTH, 1.5 * FOOT),
        ("3 lb", &MASS, 3.0 * POUND),
        ("3 lbm", &MASS, 3.0 * POUND),
        ("24 oz", &MASS, 1.5 * POUND),
        ("2 slug", &MASS, 2.0 * lbf / FOOT),
        ("5 lbf", &FORCE, 5.0 * lbf),
        ("5 lb", &FORCE, 5.0 * lbf),
        ("8 oz", &FORCE, 0.5 * lbf),
        ("8 ozf", &FORCE, 0.5 * lbf),
        ("7 kgf", &FORCE, 7.0 * G),
        ("7 kp", &FORCE, 7.0 * G),
        ("7 daN", &FORCE, 70.0),
        ("12 lb in", &TORQUE, FOOT * lbf),
        ("12 in-lb", &TORQUE, FOOT * lbf),
        ("12 in lb", &TORQUE, FOOT * lbf),
        ("12 lb-in", &TORQUE, FOOT * lbf),
        ("12 lbf in", &TORQUE, FOOT * lbf),
        ("12 lbf·in", &TORQUE, FOOT * lbf),
        ("12 in.lb", &TORQUE, FOOT * lbf),
        ("12 lbin", &TORQUE, FOOT * lbf),
        ("1 ft lb", &TORQUE, FOOT * lbf),
        ("1 ft-lbf", &TORQUE, FOOT * lbf),
        ("1 lbft", &TORQUE, FOOT * lbf),
        ("192 oz in", &TORQUE, FOOT * lbf),
        ("192 oz-in", &TORQUE, FOOT * lbf),
        ("192 ozf in", &TORQUE, FOOT * lbf),
        ("3 kgf m", &TORQUE, 3.0 * G),
        ("3 kgf-cm", &TORQUE, 3.0e-2 * G),
        ("3 kpm", &TORQUE, 3.0 * G),
        ("3 N-m", &TORQUE, 3.0),
        // 1 lbf·s²/in is the mass that one pound of force accelerates by one inch per second squared.
        ("2 lb in s^2", &INERTIA, 2.0 * lbf / INCH * INCH * INCH),
        ("2 lb-in-s²", &INERTIA, 2.0 * lbf * INCH),
        ("2 in-lb-sec²", &INERTIA, 2.0 * lbf * INCH),
        ("32 oz in s^2", &INERTIA, 2.0 * lbf * INCH),
        ("2 lb in^2", &INERTIA, 2.0 * POUND * INCH * INCH),
        ("32 oz-in²", &INERTIA, 2.0 * POUND * INCH * INCH),
        ("2 lb ft^2", &INERTIA, 2.0 * POUND * FOOT * FOOT),
        ("2 slug ft^2", &INERTIA, 2.0 * lbf * FOOT),
        ("4 kgf cm s^2", &INERTIA, 0.04 * G),
        ("2 lb s/in", &VISCOUS_FORCE, 2.0 * lbf / INCH),
        ("2 lb in s/rad", &VISCOUS_MOMENT, 2.0 * lbf * INCH),
        ("60 ft/min", &VELOCITY, FOOT),
        ("12 in/s", &VELOCITY, FOOT),
        ("2 ft/s", &VELOCITY, 2.0 * FOOT),
        ("1 ft/s^2", &ACCELERATION, FOOT),
        ("386.08858267716535 in/s^2", &ACCELERATION, G),
        ("2 HP", &POWER, 1100.0 * FOOT * lbf),
        ("33000 ft lb/min", &POWER, 550.0 * FOOT * lbf),
        ("1500 min-1", &ANGULAR_SPEED, 50.0 * PI),
        ("1500 r/min", &ANGULAR_SPEED, 50.0 * PI),
        ("212 degF", &TEMPERATURE, 100.0),
        ("104 °F", &TEMPERATURE, 40.0),
        ("32 degF", &TEMPERATURE, 0.0),
        ("-40 degF", &TEMPERATURE, -40.0),
    ];
    for (text, kind, expected) in cases {
        let found = read(text, kind).unwrap_or_else(|fault| panic!("{text}: {fault:?}"));
        let away = ulps(found.si, expected);
        assert!(away <= 3, "{text} gives {:e}, not {expected:e}", found.si);
        let number: f64 = text.split(' ').next().unwrap().parse().unwrap();
        assert!((found.unit.number(found.si) - number).abs() <= 1e-13 * number.abs().max(32.0));
    }
}

#[test]
fn a_pound_that_may_be_mass_or_force_is_refused() {
    let fault = unit_of("lb", &[&MASS, &FORCE]).unwrap_err();
    assert!(fault.message.contains("a mass or a force"), "{fault:?}");
    assert!(fault.help.contains("\"lbf\""), "{fault:?}");
    assert!(unit_of("lbm", &[&MASS, &FORCE]).is_ok_and(|(_, kind)| kind == 0));
    assert!(unit_of("lbf", &[&MASS, &FORCE]).is_ok_and(|(_, kind)| kind == 1));
    assert!(unit_of("lb", &[&FORCE, &TORQUE]).is_ok_and(|(_, kind)| kind == 0));
    assert!(unit_of("oz-in", &[&FORCE, &TORQUE]).is_ok_and(|(_, kind)| kind == 1));
}

#[test]
fn a_header_may_have_a_power_of_ten() {
    for text in [
        "10^-4 kg m^2",
        "10⁻⁴ kg·m²",
        "x10-4 kgm2",
        "×10⁻⁴ kg·m²",
        "10-4 kg.m2",
        "10-4kgm2",
        "1e-4 kg m^2",
        "kgm²·10⁻⁴",
        "kg m^2 x10^-4",
        "kg cm^2",
        "kgcm²",
    ] {
        let (unit, _) = unit_of(text, &[&INERTIA]).unwrap_or_else(|f| panic!("{text}: {f:?}"));
        assert!((unit.scale / 1e-4 - 1.0).abs() < 1e-15, "{text}: {unit:?}");
    }
    // 10E-4 is 1e-3, but who writes it mostly means 1e-4.
    for text in ["10E-4 kgm2", "10^-99 kg m^2", "2^-4 kg m^2", "10 kg m^2"] {
        assert!(unit_of(text, &[&INERTIA]).is_err(), "{text}");
    }
    let (unit, _) = unit_of("10^3 min^-1", &[&ANGULAR_SPEED]).unwrap();
    assert!((unit.scale / (1e3 * PI / 30.0) - 1.0).abs() < 1e-15);
}

#[test]
fn what_is_wrong_is_said_with_its_cure() {
    let cases: [(&str, &Kind, &str, &str); 47] = [
        ("12 lb", &TORQUE, "is a mass", "N m"),
        ("12 oz", &TORQUE, "is a mass", "N m"),
        ("12 lbf in^2", &INERTIA, "m^3 kg s^-2", "kg m^2"),
        ("30 psi", &FORCE, "is a pressure", "N, kN"),
        ("4 inches", &LENGTH, "\"inches\"", "\"in\""),
        ("70 Fahrenheit", &TEMPERATURE, "\"Fahrenheit\"", "\"degF\""),
        ("120", &LENGTH, "no unit", "120 mm"),
        ("", &LENGTH, "empty", "120 mm"),
        ("  ", &LENGTH, "empty", "120 mm"),
        ("mm", &LENGTH, "number", "120 mm"),
        ("30 kg", &LENGTH, "is a mass", "m, cm, mm"),
        ("30 mm^2", &LENGTH, "is an area", "m, cm, mm"),
        ("3 kg m^2", &MASS, "is a moment of inertia", "kg, g, t"),
        ("3 kg s^3", &MASS, "a quantity in kg s^3", "kg, g, t"),
        ("90 %", &ANGLE, "a plain number", "deg, rad"),
        ("90", &ANGLE, "no unit", "90 deg"),
        ("1 m/m", &ANGLE, "a plain number", "deg"),
        ("25 Hz", &ANGULAR_SPEED, "a frequency", "rpm"),
        ("25 1/s", &ANGULAR_SPEED, "a frequency", "rad/s"),
        ("25 s^-1", &ANGULAR_SPEED, "a frequency", "rad/s"),
        ("2 m/s", &ANGULAR_SPEED, "is a speed", "rpm"),
        ("3 h", &TIME, "\"h\"", "\"10800 s\""),
        ("3 turns", &ANGLE, "\"turns\"", "360 deg"),
        ("2 h", &MASS, "\"h\"", "3600 s"),
        ("4 nm", &TORQUE, "\"nm\"", "N m"),
        ("4 J", &TORQUE, "\"J\"", "N m"),
        ("4 N m/rad", &TORQUE, "torsional stiffness", "N m"),
        ("4 KG", &MASS, "\"KG\"", "kg"),
        ("1,5 mm", &LENGTH, "comma", "1.5"),
        (
            "1 500 rpm",
            &ANGULAR_SPEED,
            "more than one number",
            "without separators",
        ),
        (
            "1_500 rpm",
            &ANGULAR_SPEED,
            "more than one number",
            "without separators",
        ),
        ("1 m + 2 m", &LENGTH, "sum", "one number"),
        ("1 m+2 m", &LENGTH, "\"+\"", "blanks"),
        ("1 m 2 m", &LENGTH, "more than one number", "one number"),
        ("1/0 m", &LENGTH, "more than one number", "one number"),
        ("2*3 m", &LENGTH, "more than one number", "one number"),
        ("(1 m)", &LENGTH, "begin with a number", "120 mm"),
        ("nan mm", &LENGTH, "finite", "120 mm"),
        ("-inf mm", &LENGTH, "finite", "120 mm"),
        ("1e999 mm", &LENGTH, "finite", "120 mm"),
        ("3 N m s/rad s", &VISCOUS_MOMENT, "two ways", "/(rad s)"),
        ("3 m/s/s", &ACCELERATION, "not clear", "at most one"),
        ("3 m/", &LENGTH, "not clear", "at most one"),
        ("3 m^99", &LENGTH, "power", "from -4 to 4"),
        ("3 m^", &LENGTH, "power", "from -4 to 4"),
        ("30 km", &LENGTH, "too large for any machine", "1 km"),
        ("3 bananas", &LENGTH, "\"bananas\"", "mm, m"),
    ];
    for (text, kind, message, cure) in cases {
        let fault = match read(text, kind) {
            Err(fault) => fault,
            Ok(quantity) => panic!("{text} is read as {quantity:?}"),
        };
        assert!(
            fault.message.contains(message),
            "{text}: {fault:?} lacks {message}"
        );
        assert!(fault.help.contains(cure), "{text}: {fault:?} lacks {cure}");
    }
}

#[test]
fn any_text_is_read_or_refused() {
    let pieces = [
        "1", "-", "+", ".", ",", "e", "^", "/", "*", "(", ")", " ", "m", "kg", "N", "rpm", "%",
        "°", "²", "⁻", "µ", "99", "s", "W", "4", "inf", "i", "10", "\u{0}", "é", "deg", "-4",
    ];
    let mut state = 1_u64;
    for _ in 0..20_000 {
        let mut text = String::new();
        for _ in 0..12 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            text.push_str(pieces[(state >> 33) as usize % pieces.len()]);
        }
        for kind in [&LENGTH, &VISCOUS_MOMENT, &SHARE] {
            if let Ok(quantity) = read(&text, kind) {
                assert!(quantity.si.is_finite(), "{text}");
            }
        }
    }
}
