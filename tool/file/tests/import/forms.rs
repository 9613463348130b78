//! Records as other programs write them, against the motion behind them: φ = 2π·(10z³ − 15z⁴ + 6z⁵), z = t/1 s, rows each 5 ms, rounded to
//! 1e-6 deg.

use std::f64::consts::TAU;
use std::fmt::Write;

use jred_file::model::motion::Motion;

use super::parse;

pub(super) const MACHINE: &str = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n\
                       table = { inertia = \"1 kg m^2\" }\n[motion]\ntype = \"profile\"\nfile = \"record.csv\"\n";

pub(super) fn read(csv: &str, keys: &str) -> Result<Motion, String> {
    let machine = format!("{MACHINE}{keys}\n");
    parse(&machine, &[("record.csv", csv)]).map(|file| file.motion.unwrap())
}

/// φ, ω and α.
pub(super) fn exact(t: f64) -> [f64; 3] {
    let z = t.clamp(0.0, 1.0);
    [
        TAU * z * z * z * (10.0 - z * (15.0 - 6.0 * z)),
        TAU * 30.0 * z * z * (1.0 - z) * (1.0 - z),
        TAU * 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z),
    ]
}

/// The largest differences from it, between the rows as well.
pub(super) fn worst(motion: &Motion) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for k in 0..=1009 {
        let t = f64::from(k) / 1009.0;
        let state = motion.at(t);
        let found = [state.phi, state.omega, state.alpha];
        for (worst, (found, due)) in worst.iter_mut().zip(found.into_iter().zip(exact(t))) {
            *worst = worst.max((found - due).abs());
        }
    }
    worst
}

/// Digits cut at δ and a spline with steps h: δ/2 + 5/384·h⁴·φ⁗ in the position, 2·δ/h + h³/24·φ⁗ in the speed, at the ends of the cubic
/// not-a-knot some times that.
#[track_caller]
fn is_the_motion(motion: &Motion, digits: f64) {
    assert!((motion.duration() - 1.0).abs() < 1e-9);
    let (h, fourth) = (0.005_f64, TAU * 360.0);
    let [phi, omega, _] = worst(motion);
    assert!(phi < 2.0 * digits + h.powi(4) * fourth, "{phi:e}");
    assert!(omega < 4.0 * digits / h + h.powi(3) * fourth, "{omega:e}");
}

const DIGITS: f64 = 1e-6 * TAU / 360.0;

#[track_caller]
pub(super) fn refused(csv: &str, keys: &str, words: &[&str]) {
    let report = match read(csv, keys) {
        Err(report) => report.split_whitespace().collect::<Vec<_>>().join(" "),
        Ok(_) => panic!("read; expected {words:?}"),
    };
    for word in words {
        assert!(report.contains(word), "{word:?} is not in\n{report}");
    }
}

/// Each form is read with the line that the refusal names, and gives the motion.
#[test]
fn forms_of_other_programs() {
    let solidworks = include_str!("files/solidworks.csv");
    refused(solidworks, "", &["skip_rows = 1", "[motion]"]);
    let line = "columns = { time = \"Time (sec)\", position = \"Angular Displacement1 (deg)\" }";
    refused(solidworks, "skip_rows = 1", &[line]);
    let motion = read(solidworks, &format!("skip_rows = 1\n{line}")).unwrap();
    is_the_motion(&motion, DIGITS);

    let german = include_str!("files/excel-german.csv");
    let line = "columns = { time = \"Zeit [s]\", position = \"Winkel [°]\" }";
    refused(german, "", &[line]);
    is_the_motion(&read(german, line).unwrap(), DIGITS);

    let more = include_str!("files/extra-columns.csv");
    is_the_motion(&read(more, "").unwrap(), DIGITS);

    let inventor = include_str!("files/inventor.csv");
    refused(
        inventor,
        "",
        &["no header", "header = [\"time [s]\", \"position [deg]\"]"],
    );
    let motion = read(inventor, "header = [\"time [s]\", \"position [turn]\"]").unwrap();
    is_the_motion(&motion, 1e-8 * TAU);

    // Its speeds are all zero: they contradict the positions, which are read alone.
    let ros = include_str!("files/ros.csv");
    refused(
        ros,
        "",
        &["columns = { time = \"t [s]\", position = \"q1 [deg]\" }"],
    );
    let all = "columns = { time = \"t [s]\", position = \"q1 [rad]\", speed = \"dq1 [rad/s]\" }";
    refused(
        ros,
        all,
        &["q1 = 0.00162104 rad does not follow from the speeds"],
    );
    let line = "columns = { time = \"t [s]\", position = \"q1 [rad]\" }";
    is_the_motion(&read(ros, line).unwrap(), 1e-9);

    is_the_motion(
        &read(include_str!("files/twincat.csv"), "").unwrap(),
        DIGITS,
    );
}

/// Headers of drives: units in round brackets, behind an underscore, below the titles, in turns and in counts.
#[test]
fn headers_of_drives() {
    let rows = |header: &str, separator: char, per_turn: f64| {
        let mut csv = format!("{header}\n");
        for k in 0..=200 {
            let t = f64::from(k) / 200.0;
            let position = exact(t)[0] / TAU * per_turn;
            let position = format!("{position:.9}");
            let row = format!("{t}{separator}{position}");
            let row = if separator == ',' {
                row
            } else {
                row.replace('.', ",")
            };
            writeln!(csv, "{row}").unwrap();
        }
        csv
    };
    for (header, separator, per_turn) in [
        ("Time (s),Position (deg)", ',', 360.0),
        ("time_s,position_rev", ',', 1.0),
        ("t [s],phi [turn]", ',', 1.0),
        ("t;phi\ns;deg", ';', 360.0),
        ("t;phi\n[s];[deg]", ';', 360.0),
        ("t\tphi\n(sec)\t(rev)", '\t', 1.0),
    ] {
        let motion = read(&rows(header, separator, per_turn), "")
            .unwrap_or_else(|e| panic!("{header}: {e}"));
        is_the_motion(&motion, 1e-9);
    }
    let counts = rows("t [s],position [counts]", ',', 8192.0);
    refused(&counts, "", &["is in counts", "counts_per_turn = 8192"]);
    is_the_motion(&read(&counts, "counts_per_turn = 8192").unwrap(), 1e-9);
    // A recorded current beside the position needs no name.
    let current = rows("t [s],phi [turn]", ',', 1.0)
        .replace('\n', ",0.5\n")
        .replace("[turn],0.5", "[turn],Iq");
    let line = "columns = { time = \"t [s]\", position = \"phi [turn]\" }";
    refused(&current, "", &["unknown column \"Iq\"", line]);
    is_the_motion(&read(&current, line).unwrap(), 1e-9);
}

/// Positions and speeds without accelerations: the motion goes through both; the slope of the curve through the speeds is off by
/// h³/24·ω⁗ at most inside, more at the ends.
#[test]
fn positions_and_speeds() {
    let mut csv = "t [s],phi [rad],omega [rad/s]\n".to_owned();
    for k in 0..=200 {
        let t = f64::from(k) / 200.0;
        let [phi, omega, _] = exact(t);
        writeln!(csv, "{t},{phi:e},{omega:e}").unwrap();
    }
    let motion = read(&csv, "cyclic = false").unwrap();
    let [phi, omega, alpha] = worst(&motion);
    assert!(
        phi < 1e-9 && omega < 1e-6 && alpha < 1e-3,
        "{phi:e} {omega:e} {alpha:e}"
    );
    let slow = csv.replace("omega [rad/s]", "omega [deg/s]");
    refused(&slow, "", &["does not follow from the speeds"]);
    refused(&csv, "smoothing = \"20 Hz\"", &["positions and speeds"]);
}

/// An electronic cam's table, as `jred fastest --cam` and controllers have it: positions of fifth degree, as the motion here, are found again
/// exactly; the speed between two rows is a cubic, off by h⁴/384·ω⁗, its slope by √3/216·h³·ω⁗.
#[test]
fn cam_tables_are_motions() {
    let table = |columns: usize| {
        let header = ["master [deg]", "phi [deg]", "phi' [1]", "phi'' [1/rad]"];
        let mut csv = header[..columns].join(",") + "\n";
        for k in 0..=72 {
            let t = f64::from(k) / 72.0;
            let [phi, omega, alpha] = exact(t);
            let row = [
                360.0 * t,
                phi.to_degrees(),
                omega / TAU,
                alpha / (TAU * TAU),
            ];
            let row: Vec<String> = row[..columns].iter().map(|x| format!("{x:e}")).collect();
            writeln!(csv, "{}", row.join(",")).unwrap();
        }
        csv
    };
    refused(
        &table(4),
        "",
        &["over the angle of a master", "master_speed = \"60 rpm\""],
    );
    let [phi, omega, alpha] = worst(&read(&table(4), "master_speed = \"60 rpm\"").unwrap());
    let (h, fourth) = (1.0 / 72.0_f64, TAU * 720.0);
    assert!(phi < 1e-12, "{phi:e}");
    assert!(omega < 1.001 * h.powi(4) / 384.0 * fourth, "{omega:e}");
    assert!(
        alpha < 1.001 * h.powi(3) * 3.0_f64.sqrt() / 216.0 * fourth,
        "{alpha:e}"
    );
    // Twice as fast, in half the time.
    let motion = read(&table(4), "master_speed = \"120 rpm\"").unwrap();
    assert!((motion.duration() - 0.5).abs() < 1e-12);
    assert!((motion.at(0.25).omega - 2.0 * exact(0.5)[1]).abs() < 1e-10);
    for columns in [2, 3] {
        let [phi, ..] = worst(&read(&table(columns), "master_speed = \"60 rpm\"").unwrap());
        let step = (1.0 / 72.0_f64).powi(4) * TAU * 360.0;
        assert!(phi < step, "{columns}: {phi:e}");
    }
    // A part of a table, thinned: it does not close, and its rows are kept.
    let part = include_str!("files/cam-table.csv");
    refused(
        part,
        "master_speed = \"60 rpm\"",
        &[
            "the cycle starts with 0 and ends with 1.01126",
            "cyclic = false",
        ],
    );
    let motion = read(part, "master_speed = \"60 rpm\"\ncyclic = false").unwrap();
    let state = motion.at(18.18 / 360.0);
    assert!((state.phi - 196.288_378_243_112_2_f64.to_radians()).abs() < 1e-12);
    assert!((state.omega - 1.011_256_236_332_806_8 * TAU).abs() < 1e-11);
}

/// A file must agree with what the machine file states about it.
#[test]
fn columns_that_are_not_there() {
    let csv = include_str!("files/twincat.csv");
    refused(
        csv,
        "columns = { time = \"Time [ms]\", position = \"psi [deg]\" }",
        &[
            "is \"psi [deg]\", which is no title of the file",
            "did you mean \"phi [deg]\"?",
        ],
    );
    refused(
        csv,
        "columns = { tiem = \"Time [ms]\" }",
        &["no column that is read here", "did you mean \"time\"?"],
    );
    refused(
        csv,
        "columns = { time = \"Time [ms]\", position = \"Time [ms]\" }",
        &["names column 1 of the file once more"],
    );
    refused(
        csv,
        "master_speed = \"60 rpm\"",
        &["no column for the master"],
    );
    let bare = include_str!("files/inventor.csv");
    refused(
        bare,
        "header = [\"t [s]\"]",
        &["gives 1 titles, but the file has 2 columns"],
    );
}

/// A table of loads and reduced curves take the same keys.
#[test]
fn other_files_are_mapped_as_well() {
    let load = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = { inertia = \"1 kg m^2\" }\n\
                [[load]]\ntable = \"loads.csv\"\nskip_rows = 1\ncolumns = { position = \"Winkel (°)\", torque = \"Moment (Nm)\" }\n";
    let mut csv = "Messung 7\nWinkel (°);Moment (Nm);Bemerkung\n".to_owned();
    for k in 0..=12 {
        writeln!(csv, "{};{};x", 30 * k, -3).unwrap();
    }
    let file = parse(load, &[("loads.csv", &csv)]).unwrap();
    let torque = file.bare_reduction(1.0).unwrap().reduced_torque(0.0);
    assert!((torque + 3.0).abs() < 1e-12, "{torque}");
    let curves = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"reduced-curves\"\nfile = \"curves.csv\"\nrange = \"stroke\"\n\
                  header = [\"a [mm]\", \"b [kg]\"]\ncolumns = { position = \"a\", mass = \"b\" }\n";
    let rows = (0..8).map(|k| format!("{},4\n", 20 * k));
    let rows = rows.collect::<Vec<_>>().concat();
    let file = parse(curves, &[("curves.csv", &rows)]).unwrap();
    let mass = file.bare_reduction(0.05).unwrap().inertia;
    assert!((mass - 4.0).abs() < 1e-12, "{mass}");
}

/// Eleven rows of the motion as positions: it begins and ends at rest, where a free cubic has 3 % of the largest speed, and its acceleration there is
/// closer. A record that begins and ends in motion is the same cubic as before.
#[test]
fn a_move_of_few_rows_begins_at_rest() {
    let record = |position: &dyn Fn(f64) -> f64| {
        let mut csv = "time [s],position [rad]\n".to_owned();
        for k in 0..=10 {
            let t = 0.1 * f64::from(k);
            let _ = writeln!(csv, "{t},{:?}", position(t));
        }
        read(&csv, "cyclic = false").unwrap()
    };
    let motion = record(&|t| exact(t)[0]);
    for t in [0.0, 1.0] {
        let state = motion.at(t);
        assert!(state.omega.abs() < 1e-12, "{state:?}");
        // The largest is 36.3 rad/s²; h²/12 of φ⁗ at the end is 1.9.
        assert!(state.alpha.abs() < 2.0, "{state:?}");
    }
    let [_, omega, alpha] = worst(&motion);
    assert!(omega < 0.1 && alpha < 3.0, "{omega} {alpha}");
    let cubic = record(&|t| 1.0 + 2.0 * t - 3.0 * t * t + t * t * t);
    for k in 0..=100 {
        let t = 0.01 * f64::from(k);
        let due = 2.0 - 6.0 * t + 3.0 * t * t;
        let off = cubic.at(t).omega - due;
        assert!(off.abs() < 1e-9, "{t}: {off:e}");
    }
}
