//! `jred project`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::bus::command::figure;
use crate::support::{Folder, Run, jred, near, shipped, squeezed};

/// A table of inertia J on the motor's shaft without losses, which is moved by a turn and back to its start by an even number of moves.
fn table(inertia: f64, turn: f64, move_time: f64, dwell: f64) -> String {
    format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\ninertia = \"{inertia} kg m^2\"\n\
         [motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"{turn} rad\"\nduration = \"{move_time} s\"\n\
         [[motion.segment]]\ndwell = \"{dwell} s\"\n"
    )
}

const ROTOR: f64 = 0.01;

/// Lossless motors, an amplifier for them, and resistors of rising power.
fn catalogue(folder: &Folder) -> PathBuf {
    std::fs::create_dir(folder.path("drives")).unwrap();
    folder.file(
        "drives/motors.csv",
        "key,maker,model,rated_torque [N m],rated_speed [rpm],standstill_torque [N m],peak_torque [N m],max_speed [rpm],rotor_inertia [kg m^2],\
         torque_constant [N m/A],mains_voltage [V],mass [kg],price [EUR],source\n\
         m,Maker,M 1,100,3000,110,900,4000,0.01,2,400,12,1000,test\n",
    );
    folder.file(
        "drives/amplifiers.csv",
        "key,maker,model,rated_current [A],peak_current [A],mains_voltage [V],mass [kg],price [EUR],source\n\
         a,Maker,A 1,200,600,400,3,500,test\n",
    );
    let rows: String = [20, 40, 60, 80, 100, 120, 140, 160, 180, 200, 240, 300]
        .map(|watts| format!("r{watts},Maker,R {watts},10,{watts},100000,100000,1,{watts},test\n"))
        .concat();
    folder.file(
        "drives/resistors.csv",
        "key,maker,model,resistance [Ohm],rated_power [W],peak_power [W],pulse_energy [J],mass [kg],price [EUR],source\n".to_owned() + &rows,
    );
    folder.path("drives")
}

const SUPPLY: &str = "[supply]\nmains_voltage = \"400 V\"\ncapacitance = \"1 uF\"\nchopper_voltage = \"780 V\"\nmax_voltage = \"820 V\"\n";

/// The energies and peaks of one axis by another calculation: kinetic energy at the largest speed of the 3-4-5 polynomial, 15/8 of the mean, and the
/// largest power of J·α·ω over 100,000 steps.
fn expected([inertia, turn, time, dwell]: [f64; 4]) -> [f64; 3] {
    let sum = inertia + ROTOR;
    let top = 15.0 / 8.0 * turn / time;
    let steps = 100_000;
    let peak = (0..=steps).map(|k| {
        let z = f64::from(k) / f64::from(steps);
        let speed = turn / time * 30.0 * z * z * (1.0 - z) * (1.0 - z);
        let acceleration = turn / (time * time) * 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z);
        sum * acceleration * speed
    });
    let energy = 0.5 * sum * top * top;
    [energy, energy / (time + dwell), peak.fold(0.0, f64::max)]
}

/// The answer about a project whose drives all satisfy the rules.
fn sized(file: &Path, drives: &Path, format: &str) -> Run {
    let run = jred([
        &"project",
        &file,
        &"--catalogue",
        &drives,
        &"--format",
        &format,
    ]);
    run.ends(0)
}

/// Supply and resistor of four axes, of which one is there twice, against an independent calculation: in step, and at any phases.
#[test]
fn supply_and_resistor_by_another_calculation() {
    let axes = [
        [0.05, 3.0, 0.5, 0.5],
        [0.08, 2.0, 0.4, 0.6],
        [0.02, 6.0, 0.3, 0.7],
        [0.05, 3.0, 0.5, 0.5],
    ];
    let folder = Folder::new();
    let drives = catalogue(&folder);
    let mut text = format!("title = \"Four tables\"\n{SUPPLY}");
    for (k, [inertia, turn, time, dwell]) in axes.into_iter().enumerate().take(3) {
        folder.file(
            &format!("table-{k}.toml"),
            table(inertia, turn, time, dwell),
        );
        let quantity = if k == 0 { 2 } else { 1 };
        let _ = writeln!(
            text,
            "[[axis]]\nmachine = \"table-{k}.toml\"\nquantity = {quantity}"
        );
    }
    let file = folder.file("project.toml", text);
    let found = sized(&file, &drives, "json").json();
    let each = axes.map(expected);
    let sum = |k: usize| each.iter().map(|figures| figures[k]).sum::<f64>();
    let near = |path: &[&str], expected: f64, share: f64| {
        near(path[path.len() - 1], figure(&found, path), expected, share);
    };
    // The power is a straight line between 2000 instants.
    near(&["supply", "mean drawn [W]"], sum(1), 1e-5);
    near(&["supply", "mean fed back [W]"], sum(1), 1e-5);
    near(&["supply", "peak drawn [W]"], sum(2), 1e-4);
    near(&["bus", "bounds", "peak fed back [W]"], sum(2), 1e-4);
    // A capacitor of 1 uF stores next to nothing: the resistor takes all that is fed back while nothing is drawn. At the worst phases that is all.
    let stored = 0.5e-6 * (780.0f64.powi(2) - 2.0 * 400.0f64.powi(2));
    let need = figure(&found, &["bus", "brake resistor needed", "mean [W]"]);
    assert!(need <= sum(1), "{need} {}", sum(1));
    assert!(need >= 0.9 * sum(1) - 4.0 * stored, "{need} {}", sum(1));
    // The smallest of the catalogue that is large enough.
    let chosen = found["bus"]["brake resistor chosen"].as_str().unwrap();
    let watts: f64 = chosen[1..].parse().unwrap();
    assert!(
        watts >= need && watts < need + 61.0,
        "{chosen} for {need} W"
    );
    let line = |part: &str| {
        let bill = found["bill of materials"].as_array().unwrap();
        bill.iter()
            .find(|line| line["part"] == part)
            .unwrap()
            .clone()
    };
    assert_eq!(line("motor")["quantity"], 4);
    assert_eq!(line("amplifier")["quantity"], 4);
    assert_eq!(line("resistor")["key"], chosen);
    assert_eq!(line("resistor")["quantity"], 1);
}

/// With phases, only these are judged: of two equal axes half a cycle apart, one brakes while nothing else moves; in step both brake at once.
#[test]
fn phases_are_kept() {
    let folder = Folder::new();
    let drives = catalogue(&folder);
    folder.file("table.toml", table(0.05, 3.0, 0.4, 0.6));
    let need = |second: &str, name: &str| {
        let text = format!(
            "{SUPPLY}[[axis]]\nname = \"a\"\nmachine = \"table.toml\"\nphase = \"0 s\"\n[[axis]]\nname = \"b\"\nmachine = \"table.toml\"\nphase = \"{second}\"\n"
        );
        let file = folder.file("project.toml", text);
        let found = sized(&file, &drives, "json").json();
        figure(&found, &["bus", "brake resistor needed", name])
    };
    let peak = |second| need(second, "peak [W]");
    let mean = |second| need(second, "mean [W]");
    let [_, _, one] = expected([0.05, 3.0, 0.4, 0.6]);
    near("in step", peak("0 s"), 2.0 * one, 1e-4);
    near("apart", peak("0.5 s"), one, 1e-4);
    // Braking of the first feeds the acceleration of the second.
    assert!(mean("0.2 s") < 0.7 * mean("0.5 s"));
}

/// Each amplifier on a bus of its own: every axis has its own resistor, and equal parts are one line.
#[test]
fn separate_buses_have_their_own_resistors() {
    let folder = Folder::new();
    let drives = catalogue(&folder);
    folder.file("table.toml", table(0.05, 3.0, 0.4, 0.6));
    let text =
        format!("bus = \"separate\"\n{SUPPLY}[[axis]]\nmachine = \"table.toml\"\nquantity = 3\n");
    let file = folder.file("project.toml", text);
    let run = sized(&file, &drives, "csv");
    let [_, mean, _] = expected([0.05, 3.0, 0.4, 0.6]);
    let out = run.out;
    assert!(out.contains("3,motor,Maker M 1,m,table,12,1000"), "{out}");
    let (_, rest) = out.split_once("3,brake resistor,Maker R ").unwrap();
    let watts: f64 = rest.split(',').next().unwrap().parse().unwrap();
    assert!(watts >= mean, "{watts} W for {mean} W");
}

/// The project of `machines/`, from files to the document.
#[test]
fn the_packing_line() {
    let folder = Folder::new();
    let file = shipped("packing-line/project.toml");
    let page = folder.path("line.html");
    let run = jred([&"project", &file, &"--report", &page]);
    let out = squeezed(&run.ends(0).out);
    for words in [
        "project Line 7",
        "press 1 ",
        "All axes draw",
        "Common DC bus of 4 drives",
    ] {
        assert!(out.contains(words), "{words:?} is not in\n{out}");
    }
    let html = std::fs::read_to_string(page).unwrap();
    for words in [
        "Axis press:",
        "gantry: Duty",
        "feed: Tool:",
        "table: Inputs, as in the machine file",
        "Cardboard Ltd",
        "2026-12-01",
    ] {
        assert!(html.contains(words), "{words:?}");
    }
}

#[test]
fn what_is_wrong_with_a_project_is_said() {
    let folder = Folder::new();
    folder.file("table.toml", table(0.05, 3.0, 0.4, 0.6));
    folder.file(
        "other.toml",
        table(0.05, 3.0, 0.4, 0.6) + &SUPPLY.replace("400 V", "230 V"),
    );
    let axis = "[[axis]]\nmachine = \"table.toml\"\n";
    let cases = [
        (
            "[[axis]]\nmachine = \"tabel.toml\"\n".to_owned(),
            "names the machine file",
            "does not exist",
        ),
        (
            format!("{SUPPLY}[[axis]]\nmachine = \"other.toml\"\n"),
            "other.toml is for mains of 230 V",
            "for mains of 400 V",
        ),
        (
            format!("{axis}{axis}"),
            "two axes are called \"table\"",
            "`quantity`",
        ),
        (
            format!("{axis}phase = \"1 s\"\n{axis}name = \"b\"\n"),
            "`phase` is given for some axes and not for all",
            "phase = \"0 s\"",
        ),
        (
            table(1.0, 1.0, 1.0, 1.0),
            "is a machine file, not a project",
            "jred size",
        ),
        (String::from("title = \"x\"\n"), "axis", "[[axis]]"),
        (format!("{axis}quantity = 0\n"), "quantity", "1"),
        (
            format!("{axis}drive = \"no-such\"\n"),
            "no-such",
            "there is no drive",
        ),
    ];
    for (text, first, second) in cases {
        let file = folder.file("project.toml", &text);
        let run = jred([&"project", &file]).ends(2);
        let said = squeezed(&run.err);
        assert!(
            said.contains(first) && said.contains(second),
            "{text}\n{said}"
        );
    }
}

/// A document that cannot be written is an error.
#[test]
fn the_folder_of_the_document_must_exist() {
    let file = shipped("packing-line/project.toml");
    let run = jred([&"project", &file, &"--report", &"/dev/null/line.html"]).ends(2);
    assert!(
        run.err.contains("cannot write /dev/null/line.html"),
        "{}",
        run.err
    );
}
