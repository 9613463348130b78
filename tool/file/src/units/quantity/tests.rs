//! Quantities as users write them, right and wrong.

use super::read;
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

#[test]
fn what_is_wrong_is_said_with_its_cure() {
    let cases: [(&str, &Kind, &str, &str); 48] = [
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
        ("3 lb", &MASS, "\"lb\"", "\"1.36077711 kg\""),
        (
            "2 lb in^2",
            &INERTIA,
            "\"lb\"",
            "\"0.0005852793069 kg m^2\"",
        ),
        ("10 ft lbf", &TORQUE, "\"ft\"", "\"13.55817948 N m\""),
        ("230 degF", &TEMPERATURE, "\"degF\"", "times 5/9"),
        ("200 kp", &FORCE, "\"kp\"", "\"1961.33 N\""),
        ("2 h", &MASS, "\"h\"", "3600 s"),
        ("4 in", &LENGTH, "\"in\"", "\"101.6 mm\""),
        ("4 lbf", &FORCE, "\"lbf\"", "4.448"),
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
