//! Every word, and the compound units in use, against a table of their sizes and dimensions.

use std::f64::consts::{PI, SQRT_2};

use super::{WORDS, read, read_listed};

/// Unit, size in SI, powers of m, kg, s, rad, A, K.
const GOLDEN: &str = include_str!("golden.tsv");

#[test]
fn sizes_and_dimensions_are_those_of_the_table() {
    for line in GOLDEN.lines() {
        let [text, scale, powers] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line}");
        };
        let unit = read(text).unwrap_or_else(|fault| panic!("{text}: {fault:?}"));
        let scale: f64 = scale.parse().unwrap();
        assert_eq!(unit.scale.to_bits(), scale.to_bits(), "{text}");
        let d = unit.dimension;
        let found = [d.length, d.mass, d.time, d.angle, d.current, d.temperature];
        assert_eq!(
            found.map(|power| power.to_string()).join(" "),
            powers,
            "{text}"
        );
    }
}

#[test]
fn every_word_is_in_the_table_and_has_powers() {
    for word in WORDS {
        let listed = |line: &str| line.split('\t').next() == Some(word.text);
        assert!(GOLDEN.lines().any(listed), "{}", word.text);
        for power in [-4, -3, -2, -1, 2, 3, 4] {
            let text = format!("{}^{power}", word.text);
            if word.text == "%" {
                assert!(read(&text).is_err());
                continue;
            }
            let (unit, one) = (read(&text).unwrap(), read(word.text).unwrap());
            let product = one.scale.powi(power.into());
            assert!((unit.scale / product - 1.0).abs() < 1e-14, "{text}");
            let (raised, one) = (unit.dimension, one.dimension);
            assert_eq!(raised.length, one.length * power, "{text}");
            assert_eq!(raised.mass, one.mass * power, "{text}");
            assert_eq!(raised.time, one.time * power, "{text}");
            assert_eq!(raised.angle, one.angle * power, "{text}");
            assert_eq!(raised.current, one.current * power, "{text}");
            assert_eq!(raised.temperature, one.temperature * power, "{text}");
        }
    }
}

#[test]
fn a_unit_is_not_divided_by_per_cent() {
    for text in ["m/%", "1/%", "N/(m %)"] {
        assert!(read(text).unwrap_err().message.contains("divided by \"%\""));
    }
}

#[test]
fn units_of_data_sheets() {
    let exact = [
        ("kg cm^2", 1e-4),
        ("kgcm²", 1e-4),
        ("kg.cm²", 1e-4),
        ("kg.cm2", 1e-4),
        ("Nmm", 1e-3),
        ("g·cm2", 1e-7),
        ("N m", 1.0),
        ("Nm", 1.0),
        ("mN m/A", 1e-3),
        ("Nms/rad", 1.0),
        ("m/s", 1.0),
        ("%", 1e-2),
        ("kJ", 1e3),
        ("Ω", 1.0),
        ("ohm", 1.0),
        ("µH", 1e-6),
        ("°C", 1.0),
        ("C", 1.0),
        ("A rms", 1.0),
        ("min", 60.0),
    ];
    for (unit, expected) in exact {
        let scale = read_listed(unit).unwrap().scale;
        assert_eq!(scale.to_bits(), f64::to_bits(expected), "{unit}");
    }
    let near = [
        ("rpm", PI / 30.0),
        ("N m/deg", 180.0 / PI),
        ("Nm/arcmin", 10_800.0 / PI),
        ("V/krpm", 30e-3 / PI),
        ("mV/rpm", 30e-3 / PI),
        ("A peak", 1.0 / SQRT_2),
        ("N m/A peak", SQRT_2),
    ];
    for (unit, expected) in near {
        let away = read_listed(unit)
            .unwrap()
            .scale
            .to_bits()
            .abs_diff(f64::to_bits(expected));
        assert!(away <= 1, "{unit}: {away} doubles away");
    }
    for unit in ["apples", "2", "m^9", "N m/rad s"] {
        assert!(read_listed(unit).is_err(), "{unit}");
    }
}

#[test]
fn a_slip_of_the_shift_key_is_not_taken_for_a_product() {
    for (text, cure) in [
        ("Kg", "did you mean \"kg\"?"),
        ("KN", "did you mean \"kN\"?"),
        ("KG cm^2", "did you mean \"kg\"?"),
    ] {
        assert_eq!(read(text).unwrap_err().help, cure, "{text}");
    }
    let fault = read("strokes/min").unwrap_err();
    assert!(fault.help.contains("\"rpm\""), "{fault:?}");
}
