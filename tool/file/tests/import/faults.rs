//! Faults of a file are shown in the file: row, column, value, cure.

use std::fmt::Write;

use super::{of_curves, parse};
use crate::reading::belt_drive;
use crate::support::{phrases, rows};

fn curves(header: &str, row: impl Fn(i32) -> String) -> String {
    let mut csv = format!("{header}\n");
    for k in 0..12 {
        writeln!(csv, "{}", row(k)).unwrap();
    }
    csv
}

#[track_caller]
pub(super) fn refused<T>(result: Result<T, String>, words: &[&str]) {
    let Err(report) = result else {
        panic!("accepted; expected {words:?}");
    };
    for word in words {
        assert!(report.contains(word), "{word:?} is not in\n{report}");
    }
}

#[test]
fn curves_that_cannot_be_meant_are_refused() {
    let header = "phi [deg],J [kg m^2]";
    let plain = |k: i32| format!("{},{}", 30 * k, 0.5 + 0.01 * f64::from(k % 2));
    let turn = |csv: String| of_curves(&csv, "turn").map(|_| ());
    assert!(turn(curves(header, plain)).is_ok());
    let wrong_rows = r#"
        120,-0.5 => row 5 | J = -0.5 kg m^2 | greater than zero | curves.csv
        80,0.5 => position does not increase | row 5 has 80 deg after 90 deg
        90.00001,0.5 => row 5 | too close | remove one
        120,nan => row 5 | "nan" | J [kg m^2] | not a finite number
        120, => row 5 | leave no cell empty
        120,0,5 => row 5 has 3 values | decimals have a point
        120,1e12 => row 5 | too large for a moment of inertia
    "#;
    for [line, words] in rows(wrong_rows) {
        let row = |k| if k == 4 { line.clone() } else { plain(k) };
        refused(turn(curves(header, row)), &phrases(&words));
    }
    let wrong_headers = r#"
        phi [deg],J [kg] => "J [kg]" must be a moment of inertia | is a mass
        phi [deg],J => "J" has no unit | J [kg m^2]
        phi [deg],Jot [kg m^2] => unknown column "Jot [kg m^2]"
        phi [deg],phi [rad] => duplicate column "phi"
        phi [deg],T [N m] => the column for the reduced inertia is missing
        s [mm],m [kg] => drive link slides | range = "stroke"
    "#;
    for [header, words] in rows(wrong_headers) {
        refused(turn(curves(&header, plain)), &phrases(&words));
    }
    refused(
        turn(curves(header, |k| format!("{},0.5", 20 * k))),
        &["cover 220 deg of a turn", "range = \"stroke\""],
    );
    refused(
        turn(curves(header, |k| format!("{},0.5", 40 * k))),
        &["cover 440 deg of a turn"],
    );
    refused(
        turn(curves(header, plain) + "360,0.7\n"),
        &["row 13", "J = 0.7 kg m^2", "row 1, which has 0.5 kg m^2"],
    );
    refused(
        turn("phi [deg],J [kg m^2]\n0,1\n90,1\n".to_owned()),
        &["has 2 rows", "at least 5"],
    );
    // Steep rows between which the curve would fall below zero.
    let steep = |k: i32| format!("{},{}", 30 * k, if k == 5 { 50.0 } else { 0.01 });
    refused(
        turn(curves(header, steep)),
        &["falls to", "between rows", "add rows"],
    );
    // A weight that lifts for nothing.
    let work = |k: i32| format!("{},0.5,3", 30 * k);
    refused(
        turn(curves("phi [deg],J [kg m^2],T_weight [N m]", work)),
        &["does work over a turn", "belongs in the column T"],
    );
    let drag = |k: i32| format!("{},0.5,{}", 30 * k, if k == 3 { -1 } else { 1 });
    refused(
        turn(curves("phi [deg],J [kg m^2],c [N m]", drag)),
        &["row 4", "c = -1 N m", "must not be negative"],
    );
}

#[test]
fn tables_of_loads_that_cannot_be_meant_are_refused() {
    let machine = |more: &str| belt_drive(&format!("[[load]]\ntable = \"loads.csv\"\n{more}"));
    let read = |csv: &str, more: &str| parse(&machine(more), &[("loads.csv", csv)]).map(|_| ());
    let rows = |value: &str| {
        (0..12).fold(String::new(), |text, k| {
            text + &format!("{},{value}\n", k * 30)
        })
    };
    assert!(read(&format!("Position [deg],Thrust [N m]\n{}", rows("2")), "").is_ok());
    refused(
        read(&format!("Position [deg],Thrust [N m]\n{}", rows("-2")), ""),
        &[
            "row 1",
            "Thrust = -2 N m",
            "opposes the motion",
            "column Torque",
        ],
    );
    refused(
        read(&format!("Position [deg],Thrust [N]\n{}", rows("2")), ""),
        &["is a force", "must be a torque"],
    );
    // A force is not passed over, as a current beside a motion is.
    refused(
        read(
            &format!("Position [deg],Torque [N m],Force x [N]\n{}", rows("2,3")),
            "",
        ),
        &["unknown column \"Force x [N]\""],
    );
    refused(
        read("Position [deg]\n0\n90\n180\n270\n300\n", ""),
        &["no column other than the position"],
    );
    refused(
        read("", "moment = \"3 N m\""),
        &["`moment` in [[load]]", "separate [[load]]"],
    );
    let missing = parse(&machine(""), &[]).map(|_| ());
    refused(missing, &["`table` in [[load]]", "no such file"]);
}

#[test]
fn recordings_that_cannot_be_meant_are_refused() {
    let machine = |more: &str| {
        belt_drive(&format!(
            "[motion]\ntype = \"profile\"\nfile = \"log.csv\"\n{more}"
        ))
    };
    let read = |csv: &str, more: &str| parse(&machine(more), &[("log.csv", csv)]).map(|_| ());
    let steady = "t [s],omega [rpm]\n0,60\n0.25,60\n0.5,60\n0.75,60\n1,60\n";
    assert!(read(steady, "").is_ok());
    refused(
        read(
            "t [s],omega [rpm]\n0,60\n0.25,60\n0.5,60\n0.75,60\n1,80\n",
            "",
        ),
        &["starts with 60 rpm and ends with 80 rpm", "cyclic = false"],
    );
    refused(
        read(
            "t [s],omega [rpm],phi [deg]\n0,1,1\n1,1,1\n2,1,1\n3,1,1\n4,1,1\n",
            "",
        ),
        &[
            "row 2: phi = 1 deg does not follow from the speeds",
            "columns = {",
        ],
    );
    refused(
        read(&steady.replace("t [s],", "phi [deg],"), ""),
        &["no column for the time"],
    );
    refused(
        read("omega [rpm]\n60\n60\n60\n60\n60\n", ""),
        &["no column for the time", "step = \"1 ms\""],
    );
    refused(
        read(steady, "step = \"1 ms\""),
        &["`step` in [motion]", "has a column for the time"],
    );
    refused(
        read(steady, "smoothing = \"40 Hz\""),
        &["is 40 Hz", "too few to be smoothed"],
    );
    refused(
        read(&steady.replace("0.75,", "0.5,"), ""),
        &["time does not increase", "row 4 has 0.5 s after 0.5 s"],
    );
    refused(
        read(
            "t [s],phi [deg]\n0,0\n1,90\n2,180\n3,270\n4,360\n",
            "start = \"5 deg\"",
        ),
        &["`start` in [motion]", "starts at its first position"],
    );
}
