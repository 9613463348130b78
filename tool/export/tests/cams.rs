//! Each form of a cam is read back as its maker describes it, by readers that share no code with the writers.
// Numbers that are written and read keep their bits.
#![allow(clippy::float_cmp)]

use jred_export::{Cam, CamForm, CamRow};
use jred_file::number::words::Word as _;

const TURN: f64 = 360.0;

/// A lift of 30 mm and back over a turn of the master: y = 15·(1 − cos x), with its derivatives by degrees.
fn rows(count: usize) -> Vec<CamRow> {
    let by_degree = std::f64::consts::PI / 180.0;
    let row = |k: usize| {
        let x = TURN * k as f64 / (count - 1) as f64;
        let (sin, cos) = (x * by_degree).sin_cos();
        let position = 15.0 * (1.0 - cos);
        let slope = 15.0 * by_degree * sin;
        [x, position, slope, 15.0 * by_degree * by_degree * cos]
    };
    (0..count).map(row).collect()
}

fn text(rows: &[CamRow], form: CamForm) -> String {
    let cam = Cam {
        title: "a cam (* with a comment *)\nin its title",
        rows,
        master: "deg",
        position: ["s", "mm"],
        turn: None,
    };
    cam.text(form, "lift__table.xyz").unwrap()
}

/// Members of the structures of an array in Structured Text: `(a := 1.0, b := 2.0)`.
fn structures(text: &str, array: &str) -> Vec<Vec<(String, String)>> {
    let text = text.split_once(&format!("    {array} : ARRAY[")).unwrap().1;
    let text = text.split_once(":= [").unwrap().1;
    let text = text.split_once(']').unwrap().0;
    let parts = text.split(')').filter_map(|part| part.split_once('('));
    let members = |text: &str| {
        let members = text.split(',').map(|member| {
            let (name, value) = member.split_once(":=").unwrap();
            (name.trim().to_owned(), value.trim().to_owned())
        });
        members.collect()
    };
    parts.map(|(_, text)| members(text)).collect()
}

/// The numbers of these members of each structure. A literal of Structured Text has a decimal point.
fn members<const N: usize>(text: &str, array: &str, names: [&str; N]) -> Vec<[f64; N]> {
    let all = structures(text, array);
    let number = |structure: &[(String, String)], name: &str| {
        let found = structure.iter().find(|(member, _)| member == name).unwrap();
        assert!(found.1.contains('.'), "{found:?}");
        found.1.to_lowercase().parse().unwrap()
    };
    all.iter()
        .map(|structure| names.map(|name| number(structure, name)))
        .collect()
}

/// Rows of a text between separators.
fn columns<const N: usize>(lines: &[&str], separator: char) -> Vec<[f64; N]> {
    let row = |line: &&str| {
        let cells: Vec<f64> = (line.split(separator).take(N))
            .map(|cell| cell.parse().unwrap())
            .collect();
        cells.try_into().unwrap()
    };
    lines.iter().map(row).collect()
}

/// The corrected trapezoidal rule joins neighbours: derivatives are by the first column.
fn has_its_derivatives(rows: &[CamRow]) {
    for pair in rows.windows(2) {
        let [x0, y0, v0, a0] = pair[0];
        let [x1, y1, v1, a1] = pair[1];
        let h = x1 - x0;
        let way = 0.5 * h * (v0 + v1) + h * h / 12.0 * (a0 - a1);
        // The rule leaves h⁵/720 of the fifth derivative, and 15 mm over a turn in 360 steps is smooth.
        assert!((y1 - y0 - way).abs() < 1e-9, "{x0}: {}", y1 - y0 - way);
        assert!((v1 - v0 - 0.5 * h * (a0 + a1)).abs() < 1e-6);
    }
}

#[test]
fn forms_with_derivatives_hold_the_rows() {
    let rows = rows(361);
    let csv = text(&rows, CamForm::Csv);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "master [deg],s [mm],s' [mm/deg],s'' [mm/deg^2]");
    assert_eq!(columns(&lines[1..], ','), rows);
    let codesys = text(&rows, CamForm::Codesys);
    let found = members(&codesys, "lift_table_points", ["dX", "dY", "dV", "dA"]);
    assert_eq!(found, rows);
    has_its_derivatives(&found);
    let reference = "lift_table : MC_CAM_REF := (nElements := 361, byType := 3, xStart := 0.0, xEnd := 360.0, nTappets := 0, \
                     strCAMName := 'lift_table', pce := ADR(lift_table_points));";
    assert!(codesys.contains(reference));
    assert!(codesys.contains("lift_table_points : ARRAY[0..360] OF SMC_CAMXYVA := ["));
    let twincat = text(&rows, CamForm::Twincat);
    let names = ["MasterPos", "SlavePos", "SlaveVelo", "SlaveAcc"];
    let found = members(&twincat, "lift_table_points", names);
    assert_eq!(found, rows);
    has_its_derivatives(&found);
    // Indices begin at 1 without gaps; a plain POLYNOM5 goes from rest to rest.
    for (number, point) in (1..).zip(structures(&twincat, "lift_table_points")) {
        let of = |name: &str| &point.iter().find(|(member, _)| member == name).unwrap().1;
        assert_eq!(*of("PointIndex"), number.to_string());
        assert_eq!(
            of("RelIndexNextPoint"),
            if number < 361 { "1" } else { "0" }
        );
        assert_eq!(of("FunctionType"), "MOTIONFUNCTYPE_POLYNOM5_MM");
        assert_eq!(of("PointType"), "MOTIONPOINTTYPE_MOTION");
    }
    for text in [codesys, twincat] {
        // The title did not end its comment.
        let [opened, closed] = ["(*", "*)"].map(|mark| text.matches(mark).count());
        assert_eq!((opened, closed), (2, 2));
        assert!(text.contains("(* derivatives by the master: [mm/deg], [mm/deg^2] *)"));
    }
}

#[test]
fn forms_of_points_hold_masters_and_slaves() {
    let rows = rows(25);
    let points: Vec<[f64; 2]> = rows.iter().map(|[x, y, ..]| [*x, *y]).collect();
    let sew = text(&rows, CamForm::Sew);
    let lines: Vec<&str> = sew.lines().collect();
    assert_eq!(lines[0], "25");
    assert_eq!(columns(&lines[1..], ';'), points);
    let kollmorgen = text(&rows, CamForm::Kollmorgen);
    let lines: Vec<&str> = kollmorgen.lines().collect();
    assert_eq!(lines[..2], ["CYCLIC;YES;", "TABLE_BEGIN;;"]);
    assert_eq!(lines[27..], ["TABLE_END;;"]);
    assert!(lines[2..27].iter().all(|line| line.ends_with(";SPLINE")));
    assert_eq!(columns(&lines[2..27], ';'), points);
    let lenze = text(&rows, CamForm::Lenze);
    let lines: Vec<&str> = lenze.lines().collect();
    assert!(lines[0].starts_with("0 0 // a cam "), "{}", lines[0]);
    assert_eq!(columns(&lines, ' '), points);
    // The Siemens block: each assignment by its index.
    let siemens = text(&rows, CamForm::Siemens);
    let (head, body) = siemens.split_once("BEGIN\n").unwrap();
    assert!(head.contains("DATA_BLOCK \"lift_table\"\n"));
    assert!(head.contains("Master : Array[1..25] of LReal;"));
    let mut found = vec![[f64::NAN; 2]; 25];
    for line in body.lines().take(50) {
        let (target, value) = line
            .trim()
            .trim_end_matches(';')
            .split_once(" := ")
            .unwrap();
        let (name, index) = target.trim_end_matches(']').split_once('[').unwrap();
        let column = ["Master", "Slave"].iter().position(|known| *known == name);
        let index: usize = index.parse().unwrap();
        found[index - 1][column.unwrap()] = value.to_lowercase().parse().unwrap();
    }
    assert_eq!(found, points);
    assert!(body.ends_with(";\nEND_DATA_BLOCK\n"));
    // A tag of Studio 5000 is of type REAL.
    let rockwell = text(&rows, CamForm::Rockwell);
    assert!(rockwell.contains(
        "(* tag lift_table : CAM[25]; MCCP with Length 25, Start Slope 0.0, End Slope -"
    ));
    let assignments = rockwell.lines().filter(|line| !line.starts_with("(*"));
    for ((k, line), [x, y]) in assignments.enumerate().zip(&points) {
        let parts: Vec<&str> = line.trim_end_matches(';').split("; ").collect();
        let value = |part: &str, member: &str| {
            let found = part.strip_prefix(&format!("lift_table[{k}].{member} := "));
            found.unwrap().to_lowercase().parse::<f32>().unwrap()
        };
        let found = [value(parts[0], "Master"), value(parts[1], "Slave")];
        assert_eq!(found, [*x as f32, *y as f32]);
        assert_eq!(parts[2], format!("lift_table[{k}].SegmentType := 1"));
    }
}

/// A motion that starts from rest with an acceleration and stops with another one cannot repeat without a jump.
#[test]
fn a_cam_that_does_not_repeat_says_so() {
    let mut rows = rows(25);
    rows[0][3] = 0.0;
    assert!(text(&rows, CamForm::Kollmorgen).starts_with("CYCLIC;NO;\n"));
}

#[test]
fn a_table_that_the_maker_does_not_take_is_refused() {
    for (form, count, because) in [
        (
            CamForm::Codesys,
            32_768,
            "at most 32767: nElements of MC_CAM_REF is an INT",
        ),
        (
            CamForm::Rockwell,
            65_536,
            "at most 65535: Length of MCCP is a UINT",
        ),
        (
            CamForm::Siemens,
            10_001,
            "at most 10000: the points of a TO_Cam_10k",
        ),
        (
            CamForm::Sew,
            16_384,
            "at most 16383: gc_uMaxNumberOfInterpPoints of MOVI-C",
        ),
        (
            CamForm::Kollmorgen,
            4,
            "at least 5: KAS imports four segments or more",
        ),
    ] {
        let rows = rows(count);
        let cam = Cam {
            title: "",
            rows: &rows,
            master: "deg",
            position: ["s", "mm"],
            turn: None,
        };
        let fault = cam.text(form, "cam.st").unwrap_err();
        let said = fault.to_string();
        assert!(
            said.contains(because) && said.contains(form.word()),
            "{said}"
        );
        let cure = fault.cure().unwrap();
        let taken: usize = cure.strip_prefix("use --rows ").unwrap().parse().unwrap();
        let rows = self::rows(taken);
        assert!(Cam { rows: &rows, ..cam }.text(form, "cam.st").is_ok());
    }
    assert_eq!(CamForm::WORDS.len(), 8);
}

/// From rest to rest by the law 3-4-5: only whole turns of a link that turns may repeat.
#[test]
fn a_cam_repeats_only_where_its_position_does() {
    for (stroke, turn, cyclic) in [
        (600.0, None, "NO"),
        (720.0, None, "NO"),
        (720.0, Some(360.0), "YES"),
        (-360.0, Some(360.0), "YES"),
        (600.0, Some(360.0), "NO"),
        (0.0, None, "YES"),
    ] {
        let rows: Vec<CamRow> = (0..=20)
            .map(|k| {
                let u = f64::from(k) / 20.0;
                let lift = u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u);
                let slope = 30.0 * (u * (1.0 - u)).powi(2) / TURN;
                let curvature = 60.0 * u * (1.0 - 3.0 * u + 2.0 * u * u) / (TURN * TURN);
                [
                    TURN * u,
                    120.0 + stroke * lift,
                    stroke * slope,
                    stroke * curvature,
                ]
            })
            .collect();
        let cam = Cam {
            title: "",
            rows: &rows,
            master: "deg",
            position: ["s", "mm"],
            turn,
        };
        let text = cam.text(CamForm::Kollmorgen, "cam").unwrap();
        let head = format!("CYCLIC;{cyclic};\n");
        assert!(text.starts_with(&head), "{stroke} {turn:?}");
    }
}
