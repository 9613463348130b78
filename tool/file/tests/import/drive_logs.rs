//! Logs of drives: columns, counts and lines above the header by options of the command line.

use std::collections::BTreeMap;

use super::faults::refused;
use jred_file::read::{DriveLog, LogLayout, drive_log};

fn read(csv: &str, layout: LogLayout) -> Result<DriveLog, String> {
    let files = BTreeMap::from([("log.csv".to_owned(), csv.to_owned())]);
    let layout = LogLayout {
        skipped: 1,
        ..layout
    };
    drive_log("log.csv", files, &layout).map_err(|problem| {
        let cure = problem.cure().unwrap_or_default();
        format!("{problem}; {cure}")
    })
}

fn named(columns: &[(&str, &str)]) -> LogLayout {
    let columns = columns.iter();
    LogLayout {
        columns: columns
            .map(|(name, title)| ((*name).to_owned(), (*title).to_owned()))
            .collect(),
        counts_per_turn: Some(4),
        torque_constant: Some(2.0),
        ..LogLayout::default()
    }
}

#[test]
fn options_name_the_columns_of_a_log() {
    let csv = "drive 7\nTime (ms);ActPos;Iq,RMS\n0;0;1,5\n250;3;-0,5\n";
    let columns = [
        ("time", "Time (ms)"),
        ("position", "ActPos [counts]"),
        ("current", "Iq,RMS [A]"),
    ];
    let log = read(csv, named(&columns)).unwrap();
    assert_eq!(log.time, [0.0, 0.25]);
    // Three of four counts.
    let quarter = std::f64::consts::FRAC_PI_2;
    assert_eq!(log.position, [0.0, 3.0 * quarter]);
    assert_eq!(log.torque, [3.0, -1.0]);
}

#[test]
fn an_option_that_names_no_column_is_refused() {
    let csv = "drive 7\nt [s],pos,M [N m]\n0,0,1\n1,1,1\n";
    let wrong = |column| read(csv, named(&[("time", "t"), column]));
    refused(
        wrong(("position", "Place [rad]")),
        &["`position` in --columns is \"Place [rad]\"", "its titles: "],
    );
    refused(
        wrong(("place", "pos")),
        &[
            "`place` in --columns is no column that is read here",
            "possible: ",
        ],
    );
    refused(
        wrong(("position", "pos [N m]")),
        &["`position` in --columns", "angle"],
    );
}
