//! The columns of the catalogue's own format, in its page and as lists.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use glob::Pattern;
use jred_sizing::catalogue::{Catalogue, CatalogueError, Parts};
use jred_sizing::cell::Cell;
use jred_sizing::select::filter::Filter;

/// The tables of columns between the marks of docs/catalogue.md; `JRED_BLESS=1` writes them anew.
#[test]
fn the_tables_of_columns() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/catalogue.md");
    let page = fs::read_to_string(&path).unwrap();
    let [start, end] = [
        "<!-- columns: made by the test `the_tables_of_columns` -->\n",
        "<!-- end of columns -->",
    ];
    let (before, rest) = page.split_once(start).unwrap();
    let (_, after) = rest.split_once(end).unwrap();
    let mut tables = String::new();
    for parts in Parts::ALL {
        let linear = parts.columns(true);
        let _ = write!(
            tables,
            "### {}\n\n| column | unit | meaning |\n|---|---|---|\n",
            parts.name()
        );
        for (column, linear) in parts.columns(false).iter().zip(linear) {
            let unit = match (column.unit, linear.unit) {
                ("", _) => String::new(),
                (one, other) if one == other => format!("`{one}`"),
                (one, other) => format!("`{one}`, `{other}`"),
            };
            let _ = writeln!(tables, "| `{}` | {unit} | {} |", column.name, column.help);
        }
        tables.push('\n');
    }
    let made = format!("{before}{start}{tables}{end}{after}");
    if std::env::var_os("JRED_BLESS").is_some() {
        fs::write(&path, made).unwrap();
    } else {
        assert!(
            made == page,
            "docs/catalogue.md is not up to date: run this test with JRED_BLESS=1"
        );
    }
}

/// The lists of the built-in catalogue as CSV.
fn listed(catalogue: &Catalogue) -> Vec<(String, String)> {
    let tables = Parts::ALL.map(|parts| {
        let columns = parts.columns(false);
        let mut lines = vec![
            columns
                .iter()
                .map(jred_sizing::catalogue::ColumnTitle::header)
                .collect::<Vec<_>>(),
        ];
        for row in parts.rows(catalogue, false) {
            let cells = row.iter().map(|cell| match cell {
                Cell::Empty => String::new(),
                Cell::Number(x) => x.to_string(),
                Cell::Text(text) => text.clone(),
            });
            lines.push(cells.collect());
        }
        let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
        for line in lines {
            writer.write_record(line).unwrap();
        }
        let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
        (format!("{}.csv", parts.name()), text)
    });
    tables.to_vec()
}

#[test]
fn a_listed_catalogue_is_the_same_catalogue() {
    let own = Catalogue::built_in().unwrap();
    let again = Catalogue::of_texts(listed(&own), false).unwrap();
    assert_eq!(again.gearboxes.len(), own.gearboxes.len());
    let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-10 * b.abs(),
        (None, None) => true,
        _ => false,
    };
    for (a, b) in again.motors.iter().zip(&own.motors) {
        assert_eq!(
            [&a.key, &a.maker, &a.model, &a.source],
            [&b.key, &b.maker, &b.model, &b.source]
        );
        let figures = |m: &jred_sizing::catalogue::Motor| {
            [
                m.rated_torque,
                m.rated_speed,
                m.peak_torque,
                Some(m.rotor_inertia),
                m.winding.rated_current,
                m.winding.voltage_constant,
                m.winding.inductance,
                m.thermal.housing_time,
                m.brake.map(|brake| brake.torque),
                m.brake.and_then(|brake| brake.closing_time),
                m.mass,
                m.shaft_diameter,
                m.mains_voltage,
            ]
        };
        let pairs = figures(a).into_iter().zip(figures(b));
        assert!(pairs.into_iter().all(|(a, b)| near(a, b)), "{a:?}\n{b:?}");
        assert_eq!(a.brake_is_optional, b.brake_is_optional);
    }
    for (a, b) in again.gearboxes.iter().zip(&own.gearboxes) {
        assert!(
            near(a.stiffness, b.stiffness) && near(a.backlash, b.backlash),
            "{a:?}\n{b:?}"
        );
        assert!(
            near(Some(a.inertia), Some(b.inertia)) && near(Some(a.efficiency), Some(b.efficiency))
        );
    }
    for (a, b) in again.amplifiers.iter().zip(&own.amplifiers) {
        assert!(near(Some(a.rated_current), Some(b.rated_current)), "{a:?}");
        assert!(near(a.absorbable_energy, b.absorbable_energy), "{a:?}");
    }
    for (a, b) in again.resistors.iter().zip(&own.resistors) {
        assert!(near(a.pulse_energy, b.pulse_energy), "{a:?}");
    }
}

/// A motor with an optional brake is offered with and without it; without it, it does not hold a machine that falls.
#[test]
fn an_optional_brake_is_an_order_of_its_own() {
    let text = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],mass [kg],mass_with_brake [kg],\
                brake_option,brake_torque [N m],brake_inertia [kg cm^2],brake_opening_time [ms],brake_power [W],source\n\
                m,A,M1,2,3000,6,1.5,3,3.6,yes,2.5,0.2,60,8,page 1\n\
                n,A,N1,2,3000,6,1.5,3,3.6,,2.5,0.2,,,page 2\n";
    let found = Catalogue::of_texts([("motors.csv", text)], false).unwrap();
    let keys: Vec<&str> = found
        .motors
        .iter()
        .map(|motor| motor.key.as_str())
        .collect();
    assert_eq!(keys, ["m", "m-brake", "n"]);
    let [without, with, fixed] = [0, 1, 2].map(|k| &found.motors[k]);
    assert!(without.brake.is_none() && without.brake_is_optional);
    assert!((without.rotor_with_brake() - 1.5e-4).abs() < 1e-12);
    let brake = with.brake.unwrap();
    assert!((with.rotor_with_brake() - 1.7e-4).abs() < 1e-12 && !with.brake_is_optional);
    assert_eq!(
        (brake.torque, brake.opening_time, brake.power),
        (2.5, Some(0.06), Some(8.0))
    );
    assert!((with.mass.unwrap() - 3.6).abs() < 1e-12 && with.model == "M1 with brake");
    assert!(fixed.brake.is_some() && !fixed.brake_is_optional);
    assert!((fixed.mass.unwrap() - 3.6).abs() < 1e-12);
    // Its key is taken.
    let clash = text.replace("\nn,A,N1,", "\nm-brake,A,N1,");
    assert!(Catalogue::of_texts([("motors.csv", clash)], false).is_err());
}

/// The rows of a motor with an optional brake, and of one without.
fn with_option(torque: &str) -> String {
    format!(
        "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],brake_option,brake_torque [N m],source\n\
         m,A,M1,2,3000,6,1.5,yes,{torque},page 1\n\
         n,A,N1,2,3000,6,1.5,,,page 2\n"
    )
}

/// An option whose torque nobody states is a brake of unknown torque: the motor is offered once, and not as one without a brake. In a list that was
/// written by jred, the motor with its brake is a row of its own.
#[test]
fn an_optional_brake_without_a_torque_is_unknown() {
    let found = Catalogue::of_texts([("motors.csv", with_option(""))], false).unwrap();
    let known: Vec<_> = (found.motors.iter())
        .map(|m| (m.key.as_str(), m.brake.is_some(), m.brake_is_optional))
        .collect();
    assert_eq!(known, [("m", false, false), ("n", false, false)]);
    let listed = with_option("").replace("\nn,", "\nm-brake,");
    let found = Catalogue::of_texts([("motors.csv", listed)], false).unwrap();
    assert!(found.motors[0].brake_is_optional && !found.motors[1].brake_is_optional);
}

/// A pattern for a motor and a row of pairs mean the motor with its optional brake, too; a row may name that alone.
#[test]
fn the_key_of_a_motor_means_it_with_its_brake() {
    let mut found = Catalogue::of_texts([("motors.csv", with_option("3"))], false).unwrap();
    let filter = Filter {
        motors: vec![Pattern::new("M").unwrap()],
        ..Filter::default()
    };
    filter.thin(&mut found).unwrap();
    let keys: Vec<_> = found.motors.iter().map(|m| m.key.as_str()).collect();
    assert_eq!(keys, ["m", "m-brake"]);
    let amplifiers = "key,maker,model,rated_current [A],peak_current [A],source\n\
                      a,A,A1,3,9,page 3\nb,A,B1,3,9,page 3\n";
    let pairs = |rows: &str| {
        let texts = [
            ("motors.csv", with_option("3")),
            ("amplifiers.csv", amplifiers.to_owned()),
            ("compatibility.csv", format!("motor,amplifiers\n{rows}")),
        ];
        let found = Catalogue::of_texts(texts, false)?;
        let of = |motor| -> Vec<String> {
            let amplifiers = found.amplifiers_of(motor).into_iter();
            amplifiers.map(|a| a.key.clone()).collect()
        };
        Ok::<_, CatalogueError>([of(0), of(1)])
    };
    let [without, with] = pairs("m,a\n").unwrap();
    assert_eq!(
        (without, with),
        (vec!["a".to_owned()], vec!["a".to_owned()])
    );
    let [without, with] = pairs("m,a\nm-brake,b\n").unwrap();
    assert_eq!(
        (without, with),
        (vec!["a".to_owned()], vec!["a".to_owned(), "b".to_owned()])
    );
    assert!(pairs("n-brake,b\n").is_err());
}
