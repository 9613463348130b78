//! Texts and style of a report: units of the motor's kind, axes, clipped curves, colours.

use std::collections::HashSet;

use super::{charts, plain};
use crate::support::{Folder, jred, jred_of, press_file, shipped, within};

const LINEAR: &str = "\
key,kind,maker,model,rated_force [N],rated_speed [m/s],standstill_force [N],peak_force [N],max_speed [m/s],moving_mass [kg],source
own-m,linear,Own,M,140,3,150,450,4,1.8,invented
";

/// A linear motor has forces and masses; terms of rotation do not occur on its page.
#[test]
fn a_page_of_a_linear_motor_speaks_of_masses() {
    let folder = Folder::new();
    let motors = folder.file("motors.csv", LINEAR);
    let machine = shipped("linear-gripper.toml");
    let path = folder.path("report.html");
    let run = jred_of(
        "size {} --motors {} --report {} --explain --full",
        [&machine, &motors, &path],
    );
    assert!(run.code < 2, "{}", run.err);
    let page = std::fs::read_to_string(&path).unwrap();
    for chart in charts(&page) {
        for key in ["x", "y"] {
            let label = chart[key].as_str().unwrap();
            assert!(
                !label.contains("inertia") && !label.contains("torque"),
                "{label}"
            );
        }
    }
    let shown = page.split("<script").next().unwrap();
    // Names of the machine file and sources of rules are unchanged.
    let shown = shown.split("Rules and their sources").next().unwrap();
    for line in plain(shown).lines().chain(run.out.lines()) {
        for word in ["nertia", "orque", "rotor"] {
            assert!(!line.contains(word), "{word} in {line}");
        }
    }
    assert!(page.contains("mass ratio λ") && page.contains("mass at the motor"));
    assert!(run.out.contains("mass ratio λ") && run.out.contains("mass at the motor"));
    assert!(page.contains("m_red varies") && !page.contains("J_red varies"));
}

/// A slide driven by a rotary motor through a screw: the drive link has newtons and metres per second, the motor newton metres and revolutions. The
/// largest speed is that of a modified sine, 1.75960 times the mean: 80 mm in 0.15 s.
#[test]
fn a_slide_behind_a_screw_has_its_own_units() {
    let folder = Folder::new();
    let gripper = shipped("linear-gripper.toml");
    let gripper = std::fs::read_to_string(gripper).unwrap();
    let (gripper, _) = gripper.split_once("[simulation]").unwrap();
    let screw = "[[drive_train]]\ntype = \"ball-screw\"\nlead = \"20 mm\"\ninertia = \"0.2 kg cm^2\"\n\n[motion]\n";
    let machine = folder.file("screw.toml", gripper.replacen("[motion]\n", screw, 1));
    let path = folder.path("report.html");
    let run = jred([&"size", &machine, &"--report", &path, &"--format", &"json"]);
    assert!(run.code < 2, "{}", run.err);
    let answer = run.json();
    let largest = answer["drive link speed [m/s]"]["max"].as_f64().unwrap();
    let exact = 1.759_60 * 0.08 / 0.15;
    within("speed", largest, exact, 1e-3 * exact);
    let force = answer["drive link force [N]"]["max"].as_f64().unwrap();
    assert!(answer.get("drive link speed [rad/s]").is_none());
    assert!(answer.get("drive link torque [N m]").is_none());
    // The input makes one turn per lead.
    let input = answer["input speed [rad/s]"]["max"].as_f64().unwrap();
    within(
        "input",
        input * 0.02 / std::f64::consts::TAU,
        largest,
        1e-9 * largest,
    );
    let page = std::fs::read_to_string(&path).unwrap();
    let row = |name: &str| {
        let (_, rest) = page.split_once(name).unwrap_or_else(|| panic!("{name}"));
        let cells = rest.split("<td class=\"n\">").skip(1).take(4);
        let cells = cells.map(|cell| cell.split('<').next().unwrap().trim_end_matches('…'));
        cells.map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    let speed = row("speed of the drive link [m/s]");
    within("row", speed[2], largest, 1e-4 * largest);
    let forces = row("force at the drive link [N], without drive train");
    within("row", forces[2], force, 1e-4 * force);
    assert!(
        page.contains(
            "torque at the input of the drive train, losses and drive train included [N m]"
        )
    );
    assert!(page.contains("Parts of the reduced force"));
}

/// An axis without a unit has no empty brackets; a curve that leaves the chart is explained below it; all curves of a chart differ in style.
#[test]
fn charts_explain_themselves() {
    let folder = Folder::new();
    let path = folder.path("report.html");
    jred([&"size", &press_file(), &"--report", &path]).ends(0);
    let page = std::fs::read_to_string(&path).unwrap();
    let charts = charts(&page);
    for chart in &charts {
        let mut looks = HashSet::new();
        for key in ["x", "y", "right"] {
            assert!(
                !chart[key].as_str().unwrap().contains("[]"),
                "{}",
                chart[key]
            );
        }
        for series in chart["series"].as_array().unwrap() {
            let look = format!(
                "{} {} {}",
                series["colour"], series["dash"], series["style"]
            );
            assert!(looks.insert(look.clone()), "{look} twice in {}", chart["y"]);
            assert_eq!(
                series["style"] == "dashed",
                series["dash"] == serde_json::json!([5, 5])
            );
        }
    }
    // The script skips points that are not to the right of the previous one.
    for chart in charts.iter().filter(|c| c["form"] != "plane") {
        for series in chart["series"].as_array().unwrap() {
            let x: Vec<f64> = series["x"]
                .as_array()
                .unwrap()
                .iter()
                .filter_map(serde_json::Value::as_f64)
                .collect();
            let drawn = x.windows(2).filter(|two| two[0] < two[1]).count();
            assert!(
                drawn > 0,
                "{} of {} is not drawn",
                series["name"],
                chart["y"]
            );
        }
    }
    let ratios = charts.iter().find(|c| c["x"] == "gear ratio i").unwrap();
    let series = ratios["series"].as_array().unwrap();
    assert!(series.len() > 7, "{} curves", series.len());
    let cut = series.iter().any(|s| {
        s["y"]
            .as_array()
            .unwrap()
            .iter()
            .any(serde_json::Value::is_null)
    });
    assert!(cut, "no curve leaves the chart");
    assert!(page.contains("A curve ends where it passes 200 %"));
}
