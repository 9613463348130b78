//! Conversions against the definitions of inch, pound and horsepower.

use super::{UnitSystem, cell, columns, show_in, table, text, title};
use jred_file::number::columns::{Column, Columns};

const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;
const POUND_FORCE: f64 = POUND * 9.80665;

fn near(found: f64, due: f64) {
    assert!((found / due - 1.0).abs() < 1e-14, "{found}, not {due}");
}

#[test]
fn each_unit_has_the_size_of_its_definition() {
    show_in(UnitSystem::Imperial);
    for (unit, to, size) in [
        ("N m", "lb in", POUND_FORCE * INCH),
        ("N·m", "lb·in", POUND_FORCE * INCH),
        ("mN m", "oz in", 1e3 * POUND_FORCE / 16.0 * INCH),
        ("kg m^2", "lb in s^2", POUND_FORCE * INCH),
        ("kg·m²", "lb·in·s²", POUND_FORCE * INCH),
        ("kg cm^2", "lb in s^2", 1e4 * POUND_FORCE * INCH),
        ("kg", "lb", POUND),
        ("m", "in", INCH),
        ("mm", "in", 25.4),
        ("m/s^2", "in/s^2", INCH),
        ("N", "lbf", POUND_FORCE),
        ("kN", "lbf", 1e-3 * POUND_FORCE),
        ("N s/m", "lbf s/in", POUND_FORCE / INCH),
        ("N/mm", "lbf/in", POUND_FORCE / 25.4),
        ("N m s/rad", "lb in s/rad", POUND_FORCE * INCH),
        ("kW", "hp", 0.55 * 12.0 * INCH * POUND_FORCE),
    ] {
        let header = format!("x [{unit}]");
        let (shown, own) = title(&header);
        assert_eq!(shown, format!("x [{to}]"));
        near(own.unwrap().of(1.0), 1.0 / size);
    }
    let celsius = title("t [°C]").1.unwrap();
    near(celsius.of(100.0), 212.0);
    assert!((celsius.of(-40.0) + 40.0).abs() < 1e-12);
    for kept in [
        "n [rpm]",
        "P [W]",
        "t [s]",
        "E [J]",
        "U [V]",
        "phi [deg]",
        "drive",
        "a [N] b [x]",
    ] {
        assert_eq!(title(kept).0, kept);
        assert!(title(kept).1.is_none());
    }
}

#[test]
fn sentences_are_converted_where_a_number_has_a_unit() {
    show_in(UnitSystem::Imperial);
    for (si, imperial) in [
        (
            "peak 12.5 N m at 0.4 s, 1450 rpm",
            "peak 111 lb in at 0.4 s, 1450 rpm",
        ),
        ("3 to 5 N m", "26.6 to 44.3 lb in"),
        ("3.000 of 12.00 N m", "26.55 of 106.2 lb in"),
        ("-254.0 mm, stage 2, 1 kg", "-10 in, stage 2, 2.2 lb"),
        (
            "-1e-3 kg m^2 in 4 m/s^2",
            "-0.00885 lb in s^2 in 157 in/s^2",
        ),
        ("40 °C, then 8 K more", "104 °F, then 8 K more"),
        (
            "1.00 N m/rad and 1.00 N m s/rad",
            "8.85 lb in/rad and 8.85 lb in s/rad",
        ),
        ("5.00 kW, 5 kW s", "6.71 hp, 6.71 hp s"),
        (
            "5 N m/kg, 5 kg m, 5 Nm, 5 min, 5 mA, 5 m², N m",
            "20.1 lb in/lb, 11 lb m, 5 Nm, 5 min, 5 mA, 5 m², N m",
        ),
        ("sgm7a-30 N m, T2 N, 1.5.2 m", "sgm7a-30 N m, T2 N, 1.5.2 m"),
        ("3 motors, 20.0 N", "3 motors, 4.5 lbf"),
        ("", ""),
    ] {
        assert_eq!(text(si), imperial);
    }
    assert_eq!(cell("12.5", title("[N m]").1), "111");
    show_in(UnitSystem::Si);
    assert_eq!(text("3 to 5 N m"), "3 to 5 N m");
}

#[test]
fn any_text_keeps_its_order_and_its_words() {
    show_in(UnitSystem::Imperial);
    let pieces = [
        "1", "-", ".", "e", " ", " to ", "N m", "kg", "mm", "°C", "²", "12.5", "ö", "/", " of ",
    ];
    let mut state = 1_u64;
    for _ in 0..20_000 {
        let mut words = String::new();
        for _ in 0..10 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            words.push_str(pieces[(state >> 33) as usize % pieces.len()]);
        }
        let shown = text(&words);
        assert_eq!(
            shown.matches('ö').count(),
            words.matches('ö').count(),
            "{words}"
        );
        assert_eq!(
            shown.matches('²').count(),
            words.matches('²').count(),
            "{words}"
        );
    }
}

#[test]
fn tables_keep_every_digit() {
    show_in(UnitSystem::Imperial);
    let shown = table(
        "# made by a, b\nkey,torque [N m],mass [kg],n [rpm]\na,1,2,3\n\"b, c\",,x,4\n".into(),
    );
    let lines: Vec<&str> = shown.lines().collect();
    assert_eq!(
        lines[..2],
        ["# made by a, b", "key,torque [lb in],mass [lb],n [rpm]"]
    );
    let cells: Vec<&str> = lines[2].split(',').collect();
    near(cells[1].parse().unwrap(), 1.0 / (POUND_FORCE * INCH));
    near(cells[2].parse().unwrap(), 2.0 / POUND);
    assert_eq!((cells[0], cells[3], lines[3]), ("a", "3", "\"b, c\",,x,4"));
    let mut run = Columns::new([Column::other("x", "mm"), Column::other("t", "s")]);
    run.push([Some(25.4), None]);
    let shown = columns(&run);
    assert_eq!(shown.names(), ["x [in]", "t [s]"]);
    near(shown.rows()[0][0].unwrap(), 1.0);
    assert_eq!(shown.rows()[0][1], None);
}

#[test]
fn bare_numbers_below_a_unit() {
    show_in(UnitSystem::Imperial);
    let (_, own) = title("rotor [kg cm^2]");
    let shown = cell("2.059 to 88", own);
    let (from, to) = shown.split_once(" to ").unwrap();
    // 1 lb in s² is 0.112985 kg m².
    let inertia = POUND_FORCE * INCH * 1e4;
    assert!(
        (from.parse::<f64>().unwrap() * inertia / 2.059 - 1.0).abs() < 1e-3,
        "{shown}"
    );
    assert!(
        (to.parse::<f64>().unwrap() * inertia / 88.0 - 1.0).abs() < 6e-3,
        "{shown}"
    );
    assert_eq!(cell("none", own), "none");
}
