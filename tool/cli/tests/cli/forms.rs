//! Results as CSV and JSON.

use std::collections::HashSet;

use super::run;
use crate::support::json::row_numbers;
use crate::support::{Columns, Folder, jred, jred_of, press_file, typed};

/// Two servo amplifiers.
pub(super) const AMPLIFIERS: &str = "\
key,maker,model,rated_current [A],peak_current [A],source
small,Maker,S,6,12,made up
large,Maker,L,20,40,made up
";

/// Which motors they run.
pub(super) const RUN_BY: &str = "motor,amplifiers\nfxm*,small;large\n";

/// CSV and JSON carry every digit: both read back to the same numbers, bit for bit.
#[test]
fn csv_and_json_carry_every_digit() {
    let press = press_file();
    for arguments in [
        vec!["reduce", "--positions", "97", "--links"],
        vec!["reduce", "--positions", "97", "--over", "time"],
        vec!["simulate"],
        vec!["steady", "--positions", "97"],
    ] {
        let text = |format: &'static str| {
            let mut arguments = arguments.clone();
            arguments.extend([press.to_str().unwrap(), "--format", format]);
            run(&arguments).ends(0).out
        };
        let csv = Columns::of_csv(&text("csv"));
        let json = text("json");
        let numbers = row_numbers(&json);
        let cells: Vec<Option<f64>> = csv.rows.concat();
        assert_eq!(cells.len(), numbers.len());
        assert!(cells.len() > 97 * 10);
        for (a, b) in cells.iter().zip(&numbers) {
            assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits), "{a:?} and {b:?}");
        }
        // Numbers of full precision: most need sixteen or seventeen digits.
        let long = text("csv")
            .split([',', '\n'])
            .filter(|cell| cell.chars().filter(char::is_ascii_digit).count() >= 15)
            .count();
        assert!(long > cells.len() / 4, "{long} of {}", cells.len());
        let parsed = Columns::of_json(&serde_json::from_str(&json).unwrap());
        assert_eq!(parsed.names, csv.names);
    }
}

/// The verdicts in CSV are those in JSON.
#[test]
fn sizes_agree_between_csv_and_json() {
    let press = press_file();
    let csv = jred_of("size {} --motor sgmsh* --all --format csv", [&press]);
    let csv = csv.ends(0).out;
    let json = jred_of("size {} --motor sgmsh* --all --format json", [&press]);
    let json = json.ends(0).json();
    let drives = json["fit"].as_array().unwrap().iter();
    let drives = drives.chain(json["refused"].as_array().unwrap());
    let mut rows = csv::Reader::from_reader(csv.as_bytes());
    let names = rows.headers().unwrap().clone();
    assert_eq!(
        names.iter().collect::<Vec<_>>().join(","),
        "rank,motor,gearbox,amplifier,ratio,verdict,rule,figure,limit,unit,note,certainty,mass [kg],price,brake resistor"
    );
    let mut records = rows.records();
    for (k, drive) in drives.enumerate() {
        for check in drive["checks"].as_array().unwrap() {
            let row = records.next().unwrap().unwrap();
            let fits = k < json["fit"].as_array().unwrap().len();
            assert_eq!(
                row[0],
                if fits {
                    (k + 1).to_string()
                } else {
                    String::new()
                }
            );
            assert_eq!(&row[1], drive["motor"].as_str().unwrap());
            assert_eq!(&row[2], drive["gearbox"].as_str().unwrap_or(""));
            assert_eq!(&row[3], drive["amplifier"].as_str().unwrap_or(""));
            assert_eq!(&row[6], check["rule"].as_str().unwrap());
            let near = |cell: &str, value: &serde_json::Value| {
                let (a, b): (f64, f64) = (cell.parse().unwrap(), value.as_f64().unwrap());
                assert!((a - b).abs() <= 1e-15 * b.abs(), "{a} and {b}");
            };
            for (column, key) in [(4, "ratio"), (12, "mass [kg]"), (13, "price")] {
                match drive[key].as_f64() {
                    Some(_) => near(&row[column], &drive[key]),
                    None => assert_eq!(&row[column], ""),
                }
            }
            assert_eq!(&row[14], drive["brake resistor"].as_str().unwrap_or(""));
            match check["value"].as_f64() {
                Some(_) => near(&row[7], &check["value"]),
                None => assert_eq!(&row[7], ""),
            }
            match check["limit"].as_f64() {
                Some(_) => near(&row[8], &check["limit"]),
                None => assert_eq!(&row[8], ""),
            }
        }
    }
    assert!(records.next().is_none());
}

#[test]
fn every_column_has_a_unit() {
    let press = press_file();
    for columns in [
        jred([&"reduce", &press, &"--format", &"csv", &"--links"]),
        jred([&"reduce", &press, &"--format", &"csv", &"--over", &"time"]),
        jred([&"simulate", &press, &"--format", &"csv"]),
    ] {
        let columns = columns.ends(0).columns();
        for name in &columns.names {
            assert!(name.ends_with(']') && name.contains(" ["), "{name}");
        }
        let mut names = columns.names.clone();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), columns.names.len(), "a name is there twice");
    }
}

#[test]
fn positions_and_times() {
    let press = press_file();
    for positions in [2usize, 7, 36] {
        let run = jred_of(
            "reduce {} --format csv --positions {}",
            [&press, &positions.to_string()],
        );
        let phi = run.ends(0).columns().get("phi [deg]");
        assert_eq!(phi.len(), positions);
        for (k, phi) in phi.iter().enumerate() {
            let expected = 360.0 * k as f64 / positions as f64;
            assert!((phi - expected).abs() < 1e-12, "{phi} and {expected}");
        }
    }
    let run = jred_of("reduce {} --over time --positions 6 --format csv", [&press]);
    let times = run.ends(0).columns().get("t [s]");
    assert_eq!(times.len(), 6);
    for (k, t) in times.iter().enumerate() {
        assert!((t - 0.1 * k as f64).abs() < 1e-15);
    }
}

/// Two drives that differ only in the amplifier have distinct rows in CSV.
#[test]
fn rows_tell_amplifiers_apart() {
    let (press, folder) = (press_file(), Folder::new());
    folder.file("amplifiers.csv", AMPLIFIERS);
    folder.file("compatibility.csv", RUN_BY);
    let arguments = ["--all", "--motor", "fxm3*", "--format", "csv"];
    let run = run(&[
        &["size", press.to_str().unwrap(), "--catalogue", "built-in"] as &[&str],
        &["--catalogue", folder.path("").to_str().unwrap()],
        &arguments,
    ]
    .concat());
    let mut rows = csv::Reader::from_reader(run.out.as_bytes());
    let mut seen = HashSet::new();
    let (mut amplifiers, mut count) = (HashSet::new(), 0);
    for record in rows.records().map(Result::unwrap) {
        let name = [&record[1], &record[2], &record[3], &record[6]].map(str::to_owned);
        amplifiers.insert(record[3].to_owned());
        assert!(seen.insert(name.clone()), "{name:?} is there twice");
        count += 1;
    }
    assert_eq!(amplifiers.len(), 2, "{amplifiers:?}");
    assert!(count > 100, "{count} rows");
}

/// Every command's CSV is valid for a strict reader: all rows have as many cells as the first.
#[test]
fn every_command_writes_csv_that_reads_back() {
    let press = press_file();
    let press = press.to_str().unwrap();
    for arguments in [
        &["reduce", press] as &[&str],
        &["simulate", press],
        &["size", press],
        &["size", press, "--pareto", "power,energy"],
        &[
            "vary",
            press,
            "--vary",
            "slider.mass=30,-5 kg",
            "--steps",
            "64",
        ],
        &["sensitivity", press, "--steps", "64"],
        &["ratio", press, "--steps", "64"],
        &["rules"],
        &["rules", "general"],
        &typed("split --ratio 20 --stages 2 --pinion '1 kg cm^2'"),
    ] {
        let text = run(&[arguments, &["--format", "csv"]].concat()).out;
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(text.as_bytes());
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert!(rows.len() > 1, "{arguments:?}: {text}");
        assert!(
            text.ends_with('\n') && !text.contains('\r'),
            "{arguments:?}"
        );
    }
}
