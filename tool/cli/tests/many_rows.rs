//! Results with many rows: written part by part, within a memory limit.

#[cfg(target_os = "linux")]
use std::{
    fmt::Write as _,
    process::{Command, Stdio},
};

use crate::support::json::row_numbers;
#[cfg(target_os = "linux")]
use crate::support::{Folder, jred_of, jred_with, typed};
use crate::support::{jred, press_file};

/// Number of rows for a result in two parts, the second one short.
const ROWS: usize = 4100;

fn reduced(format: &str) -> String {
    let (file, rows) = (press_file(), ROWS.to_string());
    jred_of(
        "reduce {} --positions {} --format {}",
        [&file, &rows, &format],
    )
    .ends(0)
    .out
}

/// The columns stay aligned across parts.
#[test]
fn a_long_table_is_as_wide_everywhere() {
    let table = reduced("table");
    let (_, rows) = table.split_once("─\n").unwrap();
    let widths: Vec<usize> = rows.lines().map(|line| line.chars().count()).collect();
    assert_eq!(widths.len(), ROWS);
    assert!(widths.iter().all(|width| *width == widths[0]), "{widths:?}");
    let ends: Vec<Vec<usize>> = [4095, 4096]
        .map(|row| {
            let cells = rows.lines().nth(row).unwrap().split(' ');
            let mut place = 0;
            let ends = cells.filter_map(|cell| {
                place += cell.len() + 1;
                (!cell.is_empty()).then_some(place)
            });
            ends.collect()
        })
        .to_vec();
    assert!(ends[0].len() > 5);
    assert_eq!(ends[0], ends[1]);
}

/// CSV and JSON have the same rows, independent of parts.
#[test]
fn long_forms_have_the_same_rows() {
    let csv = reduced("csv");
    let json = reduced("json");
    let rows: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(rows["rows"].as_array().unwrap().len(), ROWS);
    let cells = csv.lines().skip(1).flat_map(|line| line.split(','));
    let of_csv: Vec<Option<f64>> = cells.map(|cell| cell.parse().ok()).collect();
    assert_eq!(row_numbers(&json), of_csv);
}

/// Whether a run succeeds within this much memory for data (KB); only Linux limits it.
#[cfg(target_os = "linux")]
fn runs_within(kilobytes: usize, arguments: &[&str]) -> bool {
    let limited = format!("ulimit -d {kilobytes} && exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command
        .args(["-c", &limited, env!("CARGO_BIN_EXE_jred")])
        .args(arguments)
        .env("RAYON_NUM_THREADS", "2")
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let code = command.status().unwrap().code();
    matches!(code, Some(0 | 1))
}

/// 20,000 rows of a result take some ten megabytes, 100,000 instants of a cycle with all their drives some forty. The limit works: a run with more
/// rows fails.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "more than five seconds of a processor"]
fn heavy_inputs_stay_below_a_ceiling() {
    const CEILING: usize = 48 * 1024;
    const OF_SIZE: usize = 88 * 1024;
    let press = press_file();
    let press = press.to_str().unwrap();
    let reduce = |rows, format| ["reduce", press, "--positions", rows, "--format", format];
    for format in ["table", "csv", "json"] {
        assert!(runs_within(CEILING, &reduce("20000", format)), "{format}");
    }
    let size = ["size", press, "--steps", "100000", "--format", "csv"];
    assert!(runs_within(OF_SIZE, &size), "size");
    assert!(!runs_within(CEILING, &reduce("300000", "csv")));
}

/// The text of a drive takes some kilobytes and is not kept: 1200 drives take no more memory than 400.
#[cfg(target_os = "linux")]
#[test]
fn every_drive_of_a_catalogue_is_written_one_by_one() {
    const CEILING: usize = 32 * 1024;
    let folder = Folder::new();
    let mut motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source\n".to_owned();
    for k in 0..1200 {
        let _ = writeln!(
            motors,
            "m{k},A,B,{},3000,{},{},none",
            1 + k % 40,
            3 * (1 + k % 40),
            1 + k % 90
        );
    }
    let motors = folder.file("motors.csv", motors);
    let (press, motors) = (press_file(), motors.to_str().unwrap());
    let press = press.to_str().unwrap();
    let line = format!("size '{press}' --motors '{motors}' --direct-only --steps 200 --all");
    let fixed = typed(&line);
    let all = |format| [&fixed[..], &["--format", format]].concat();
    for format in ["json", "csv", "table"] {
        assert!(runs_within(CEILING, &all(format)), "{format}");
    }
    let run = jred_with(&all("json")).ends(0);
    let answer: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    let drives = ["fit", "refused"].map(|list| answer[list].as_array().unwrap().len());
    assert_eq!(drives[0] + drives[1], 1200);
    // The same lines up to the last digits of numbers.
    let shape = |text: &str| -> Vec<String> {
        let lines = text.lines();
        let lines = lines.map(|line| line.trim_end_matches(|c| ",.-e0123456789".contains(c)));
        lines.map(ToOwned::to_owned).collect()
    };
    assert_eq!(shape(&run.out), shape(&format!("{answer:#}")));
}

/// Requests too large for memory are refused before computing, with the largest number.
#[test]
fn more_numbers_than_fit_are_refused() {
    let file = press_file();
    let run = jred([&"reduce", &file, &"--points", &"--positions", &"1000000"]);
    run.ends(2).says(&[
        "1000000 positions of",
        "are too many numbers",
        "use --positions",
        "or fewer",
    ]);
}
