//! Electronic cams as controllers have them: points with polynomials of fifth degree between them.

use std::f64::consts::TAU;
use std::fmt::Write;

use jred_file::model::motion::Motion;

use super::forms::{exact, read, refused, worst};

/// The cam that CODESYS creates first (its help, *Creating Cams Programmatically*): X, Y, V, A at 0, 120, 240 and 360 deg.
const POINTS: [[f64; 4]; 4] = [
    [0.0, 0.0, 0.0, 0.0],
    [120.0, 120.0, 1.0, 0.0],
    [240.0, 240.0, 1.0, 0.0],
    [360.0, 360.0, 0.0, 0.0],
];

/// As a declaration in structured text.
fn structured_text() -> String {
    let points =
        POINTS.map(|[x, y, v, a]| format!("  (dX := {x}, dY:={y:?}, DV := {v},\n   dA := {a:e})"));
    format!(
        "(* generated *)\nVAR_GLOBAL\n  Cam_A : ARRAY[0..3] OF SMC_CAMXYVA := [\n{}];\n  Cam : MC_CAM_REF := (nElements:=4, byType:=3, xStart:=0, \
         xEnd:=360, nTappets:=0, strCAMName:='Cam', pce:=ADR(Cam_A));\nEND_VAR\n",
        points.join(",\n")
    )
}

const OF_TEXT: &str = "columns = { position = \"dY [deg]\", master = \"dX [deg]\", slope = \"dV [1]\", bend = \"dA [1/deg]\" }";

fn keys(columns: &str, speed: &str) -> String {
    format!("{columns}\n{speed}")
}

/// Over u = X/120 deg the first polynomial is 120·(6u³ − 8u⁴ + 3u⁵), found by hand from its six conditions; the second is a line, the third the first
/// backwards.
fn is_that_cam(motion: &Motion) {
    assert!((motion.duration() - 1.0).abs() < 1e-12);
    let third = TAU / 3.0;
    let by_t = 3.0;
    for k in 0..=3000 {
        let t = f64::from(k) / 3000.0;
        let u = (by_t * t).min(3.0);
        let start = |u: f64| {
            [
                u.powi(3) * (6.0 - 8.0 * u + 3.0 * u * u),
                u * u * (18.0 - 32.0 * u + 15.0 * u * u),
                u * (36.0 - 96.0 * u + 60.0 * u * u),
            ]
        };
        let [s, v, a] = if u <= 1.0 {
            start(u)
        } else if u <= 2.0 {
            [u, 1.0, 0.0]
        } else {
            let [s, v, a] = start(3.0 - u);
            [3.0 - s, v, -a]
        };
        let state = motion.at(t);
        assert!((state.phi - third * s).abs() < 1e-12, "{t}");
        assert!((state.omega - third * by_t * v).abs() < 1e-11, "{t}");
        assert!((state.alpha - third * by_t * by_t * a).abs() < 1e-9, "{t}");
    }
}

#[test]
fn points_of_codesys_are_polynomials() {
    let text = structured_text();
    refused(
        &text,
        "",
        &[
            "the column \"dX\" has no unit",
            &OF_TEXT.replace("columns = { ", "").replace(" }", ""),
        ],
    );
    for speed in ["master_speed = \"60 rpm\"", "master_time = \"1 s\""] {
        is_that_cam(&read(&text, &keys(OF_TEXT, speed)).unwrap());
    }
    let rows = POINTS.map(|row| row.map(|x| format!("{x}")).join(";"));
    let csv = format!("X;Y;V;A\n{}\n", rows.join("\n"));
    let line = OF_TEXT.replace("\"d", "\"");
    refused(&csv, "", &["unknown column \"X\"", &line]);
    is_that_cam(&read(&csv, &keys(&line, "master_time = \"1 s\"")).unwrap());
    let part = text.replacen("dV", "dW", 1).replacen("DV", "dW", 1);
    refused(
        &part,
        OF_TEXT,
        &["components than dX, dY, dV, dA", "record.csv starting"],
    );
    let number = text.replace("dX := 240", "dX := 24O");
    refused(
        &number,
        &keys(OF_TEXT, "master_time = \"1 s\""),
        &["row 3: \"24O\"", "label at line 8, columns 10 to 12"],
    );
    let back = text.replace("dX := 240", "dX := 24");
    refused(
        &back,
        &keys(OF_TEXT, "master_time = \"1 s\""),
        &["row 3: dX = 24 deg does not increase"],
    );
}

/// The master by turns and by radians, the derivatives by the same; and given over the time, at the speed of the master.
#[test]
fn derivatives_have_the_units_of_the_file() {
    for (by, turn) in [("deg", 360.0), ("rad", TAU), ("turn", 1.0)] {
        let mut csv = format!("master [{by}],phi [deg],phi' [deg/{by}],phi'' [deg/{by}^2]\n");
        for k in 0..=40 {
            let [phi, omega, alpha] = exact(f64::from(k) / 40.0).map(f64::to_degrees);
            let x = turn * f64::from(k) / 40.0;
            let (slope, bend) = (omega / turn, alpha / (turn * turn));
            writeln!(csv, "{x:e},{phi:e},{slope:e},{bend:e}").unwrap();
        }
        let [phi, omega, alpha] = worst(&read(&csv, "master_time = \"1000 ms\"").unwrap());
        assert!(
            phi < 1e-12 && omega < 1e-11 && alpha < 1e-9,
            "{by}: {phi:e} {omega:e} {alpha:e}"
        );
        // The wrong angle in the derivative.
        if by == "deg" {
            let wrong = csv.replace("[deg/deg]", "[deg/rad]");
            refused(
                &wrong,
                "master_time = \"1 s\"",
                &[
                    "is not the derivative of \"phi [deg]\"",
                    "0.01745 times as long",
                ],
            );
        }
    }
    let mut csv =
        "master [deg],phi [deg],velocity [deg/s],acceleration of it [deg/s^2]\n".to_owned();
    for k in 0..=40 {
        let [phi, omega, alpha] = exact(f64::from(k) / 40.0).map(f64::to_degrees);
        writeln!(csv, "{},{phi:e},{omega:e},{alpha:e}", 9 * k).unwrap();
    }
    let columns = "columns = { master = \"master\", position = \"phi\", slope = \"velocity\", bend = \"acceleration of it\" }";
    let [phi, omega, alpha] =
        worst(&read(&csv, &format!("{columns}\nmaster_speed = \"60 rpm\"")).unwrap());
    assert!(phi < 1e-12 && omega < 1e-11 && alpha < 1e-9);
    refused(
        &csv,
        &format!("{columns}\nmaster_time = \"1 s\""),
        &["is over the time", "master_speed = \"60 rpm\""],
    );
}

#[test]
fn a_master_has_one_speed() {
    let csv = include_str!("files/cam-table.csv");
    refused(
        csv,
        "",
        &["master_speed = \"60 rpm\"", "master_time = \"1 s\""],
    );
    refused(
        csv,
        "master_speed = \"60 rpm\"\nmaster_time = \"1 s\"",
        &["has both `master_speed` and `master_time`"],
    );
    refused(
        "t [s],phi [deg]\n0,0\n1,1\n2,2\n3,3\n4,4\n",
        "master_time = \"1 s\"",
        &["no column for the master"],
    );
}
