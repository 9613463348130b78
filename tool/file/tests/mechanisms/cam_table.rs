//! `lift = "lift.csv"`: disc cams from tables, against the laws that the tables are made of.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::reader;
use crate::reading::rendered;
use jred::machine::Mechanism as _;
use jred::machine::motion::Law;

const CAM: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "disc-cam"
base_radius = "40 mm"
closure = "form"
cam = { mass = "3 kg", inertia = "0.004 kg m^2" }
follower = { type = "translating-roller", mass = "2.5 kg" }
roller = { radius = "15 mm", mass = "0.12 kg", inertia = "0.15 kg cm^2" }
lift = "lift.csv"
"#;

const RISE: f64 = 0.012;

/// Rise over 110 deg from 40 deg on, dwell, return over 120 deg from 220 deg on: s, s′ and s″.
fn exact(phi: f64, law: Law) -> [f64; 3] {
    let [up, down] = [[40.0, 110.0], [220.0, 120.0]].map(|pair| pair.map(f64::to_radians));
    let part = |[from, angle]: [f64; 2]| {
        let [s, v, a] = law.at(((phi - from) / angle).clamp(0.0, 1.0));
        let inside = phi > from && phi < from + angle;
        let scale = if inside { RISE } else { 0.0 };
        [RISE * s, scale * v / angle, scale * a / (angle * angle)]
    };
    let [a, b] = [part(up), part(down)];
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn table(step: f64, law: Law, derivatives: bool) -> String {
    let mut csv = "phi [deg],s [mm]".to_owned();
    if derivatives {
        csv += ",s' [mm/rad],s'' [mm/rad^2]";
    }
    csv.push('\n');
    for k in 0..=(360.0 / step) as u32 {
        let degrees = step * f64::from(k);
        let row = exact(degrees.to_radians(), law).map(|x| format!("{:e}", x * 1e3));
        let shown = if derivatives { 3 } else { 1 };
        writeln!(csv, "{degrees},{}", row[..shown].join(",")).unwrap();
    }
    csv
}

fn cam(csv: &str, more: &str) -> Result<jred_file::model::machine::MachineFile, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("lift.csv"), csv).unwrap();
    let text = format!("{CAM}{more}");
    reader::parse("cam.toml", &text, folder.path()).map_err(|report| {
        let text = rendered(&report);
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    })
}

/// Largest differences of s, s′ and s″, as shares of RISE/rad^n, all over the turn; and the largest that the program says it misses.
fn worst(csv: &str, law: Law) -> ([f64; 3], f64) {
    let file = cam(csv, "").unwrap();
    let mechanism = file.machine.mechanism();
    let base = mechanism.frames(0.0).unwrap().get(1).unwrap().y.value;
    let mut worst = [0.0_f64; 3];
    for k in 0..3600 {
        let phi = TAU * (f64::from(k) + 0.37) / 3600.0;
        let y = mechanism.frames(phi).unwrap().get(1).unwrap().y;
        let found = [y.value - base, y.d1, y.d2];
        for (worst, (found, due)) in worst.iter_mut().zip(found.into_iter().zip(exact(phi, law))) {
            *worst = worst.max((found - due).abs() / RISE);
        }
    }
    let fact = mechanism
        .facts()
        .iter()
        .find(|fact| fact.label == "lift from the table")
        .unwrap();
    let said = fact
        .text
        .split("by up to ")
        .nth(1)
        .unwrap()
        .split(" um")
        .next()
        .unwrap();
    (worst, said.parse::<f64>().unwrap() * 1e-6 / RISE)
}

/// The program goes through the law that the table is made of, as close as it says; the polynomial 3-4-5 is itself of fifth degree, and
/// with its derivatives in the rows is found again.
#[test]
fn a_cam_from_its_lift() {
    let (off, said) = worst(&table(1.0, Law::Polynomial345, true), Law::Polynomial345);
    assert!(
        off[0] < 1e-9 && off[1] < 1e-7 && said < 1e-9,
        "{off:?} {said:e}"
    );
    for (law, derivatives) in [
        (Law::Cycloidal, true),
        (Law::Cycloidal, false),
        (Law::Polynomial345, false),
        (Law::Polynomial4567, false),
    ] {
        let (off, said) = worst(&table(1.0, law, derivatives), law);
        // Between the rows the spline is off the law itself by 5/384·h⁴·s⁗, with s⁗ of some 300 where the law begins.
        let spline = if derivatives { 0.0 } else { 4e-7 };
        assert!(said < 1e-4, "{law:?}: {said:e}");
        assert!(off[0] < 1.05 * said + spline, "{law:?}: {off:?} {said:e}");
        assert!(off[1] < 3e-3 && off[2] < 0.2, "{law:?}: {off:?}");
    }
}

/// What the program is off the velocities and accelerations of the table, as it says it: against the law, at the rows.
#[test]
fn derivatives_of_the_table_are_compared() {
    let said = |csv: &str, more: &str| {
        let file = cam(csv, more).unwrap();
        let facts = file.machine.mechanism().facts();
        let fact = facts
            .iter()
            .find(|fact| fact.label == "lift from the table");
        fact.unwrap().text.clone()
    };
    let share = |text: &str, name: &str| -> Option<f64> {
        let (_, rest) = text.split_once(&format!("its {name} by up to "))?;
        rest.split(' ').next()?.parse().ok()
    };
    let law = Law::Cycloidal;
    let csv = table(1.0, law, true);
    let text = said(&csv, "");
    let [v, a] = ["velocities", "accelerations"].map(|name| share(&text, name).unwrap());
    let file = cam(&csv, "").unwrap();
    let rows = (0..360).map(|k| f64::from(k).to_radians());
    let (mut most, mut off) = ([0.0_f64; 2], [0.0_f64; 2]);
    for phi in rows {
        let y = file
            .machine
            .mechanism()
            .frames(phi)
            .unwrap()
            .get(1)
            .unwrap()
            .y;
        let [_, slope, bend] = exact(phi, law);
        for (k, (found, due)) in [(y.d1, slope), (y.d2, bend)].into_iter().enumerate() {
            most[k] = most[k].max(due.abs());
            off[k] = off[k].max((found - due).abs());
        }
    }
    for (said, (off, most)) in [v, a].into_iter().zip(off.into_iter().zip(most)) {
        let due = 100.0 * off / most;
        assert!((said / due - 1.0).abs() < 0.02, "{said} % {due} %");
    }
    // Velocities alone are compared, too, and over the time at the speed of the cam: 60 rpm.
    let alone: Vec<String> = csv
        .lines()
        .map(|line| line.rsplit_once(',').unwrap().0.to_owned() + "\n")
        .collect();
    let text = said(&alone.concat(), "");
    assert!(
        share(&text, "velocities").unwrap() < 1.0 && share(&text, "accelerations").is_none(),
        "{text}"
    );
    let mut timed = "phi [deg],s [mm],v [mm/s],a [mm/s^2]\n".to_owned();
    for k in 0..=360 {
        let [s, v, a] = exact(f64::from(k).to_radians(), law).map(|x| x * 1e3);
        writeln!(timed, "{k},{s:e},{:e},{:e}", v * TAU, a * TAU * TAU).unwrap();
    }
    let text = said(&timed, "lift_speed = \"60 rpm\"\n");
    assert!(
        (share(&text, "accelerations").unwrap() / a - 1.0).abs() < 0.02,
        "{text}"
    );
    let report = cam(&timed, "").map(|_| ()).unwrap_err();
    assert!(
        report.contains("is over the time") && report.contains("lift_speed = \"60 rpm\""),
        "{report}"
    );
    // A velocity by the degree that is said to be by the radian, and the other way round.
    for (wrong, ratio) in [
        (csv.replace("s' [mm/rad]", "s' [mm/deg]"), "57.3 times"),
        (
            csv.replace("s'' [mm/rad^2]", "s'' [mm/deg^2]"),
            "3282 times",
        ),
    ] {
        let report = cam(&wrong, "").map(|_| ()).unwrap_err();
        assert!(
            report.contains("is not the derivative of") && report.contains(ratio),
            "{report}"
        );
    }
}

#[test]
fn tables_that_make_no_cam() {
    let refused = |csv: &str, more: &str, words: &[&str]| {
        let report = cam(csv, more).map(|_| ()).unwrap_err();
        for word in words {
            assert!(report.contains(word), "{word:?} is not in\n{report}");
        }
    };
    let good = table(2.0, Law::Cycloidal, false);
    assert!(cam(&good, "").is_ok());
    refused(
        &good,
        "segment = [{ dwell = \"360 deg\" }]\n",
        &["has both `lift` and `segment`"],
    );
    let raised: Vec<String> = (0..=180).map(|k| format!("{},3\n", 2 * k)).collect();
    let raised = raised.concat();
    refused(
        &format!("phi [deg],s [mm]\n{raised}"),
        "",
        &["lift at 0 deg is 3 mm", "base circle"],
    );
    refused(
        &good.replace("s [mm]", "lift"),
        "",
        &["has no unit", "columns = {"],
    );
    assert!(
        cam(
            &good.replace("s [mm]", "lift"),
            "columns = { angle = \"phi\", lift = \"lift [mm]\" }\n"
        )
        .is_ok()
    );
    // Too rough for sixteen polynomials.
    let rough: Vec<String> = (0..180)
        .map(|k| format!("{},{}\n", 2 * k, 2.0 * (f64::from(k) * 0.9).sin()))
        .collect();
    refused(
        &format!("phi [deg],s [mm]\n{}", rough.concat()),
        "",
        &["16 polynomials miss by", "lift_within = "],
    );
    let text = CAM.replace(
        "lift = \"lift.csv\"",
        "segment = [{ law = \"table\", rise = \"10 mm\", angle = \"360 deg\" }]",
    );
    let report = reader::parse("cam.toml", &text, std::path::Path::new("")).unwrap_err();
    let report = rendered(&report);
    assert!(report.contains("lift = \"lift.csv\""), "{report}");
}
