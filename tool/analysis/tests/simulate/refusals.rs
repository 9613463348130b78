//! Controllers, stops and end stops that make no sense.

use jred_analysis::simulate::SimulationError;

use super::run;
use crate::reading::{parse, says};
use crate::support::{edited, near, phrases, rows};

const CONTROLLED: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "linkage"
drive = "slide"
stroke = ["0 mm", "1000 mm"]
body = [{ name = "table", mass = "2 kg", inertia = "0 kg m^2" }]
joint = [{ name = "slide", type = "prismatic", between = ["ground", "table"], direction = "0 deg" }]
[motion]
type = "cycle"
start = "100 mm"
[[motion.segment]]
move = "500 mm"
law = "polynomial-345"
duration = "1 s"
[[motion.segment]]
move = "-500 mm"
law = "polynomial-345"
duration = "1 s"
[simulation]
duration = "1 s"
output_step = "10 ms"
force = "400 N"
control = { speed_gain = "400 N s/m" }
end_stops = { at = ["0 mm", "800 mm"] }
stop = { time = "0.5 s" }
"#;

#[test]
fn bad_controllers_and_stops_are_refused() {
    assert!(run(CONTROLLED).is_ok());
    let cases = r#"
        speed_gain = "400 N s/m" => => speed_gain | is missing
        400 N s/m => 0 N s/m => speed_gain | 0 N s/m
        400 N s/m => 400 N m s/rad => N s/m
        "400 N s/m" => "400 N s/m", position_gain = "-2 1/s" => position_gain | -2 1/s
        "400 N s/m" => "400 N s/m", integral_time = "0 s" => integral_time | 0 s
        "400 N s/m" => "400 N s/m", feed_forward = "all" => feed_forward | mean-inertia | model
        force = "400 N" => force = "-400 N" => limit in both directions | not negative
        "800 mm" => "0 mm" => first must be below the second | lower stop first
        "800 mm" => "1200 mm" => 1200 mm | outside the stroke
        at = ["0 mm" => at = ["200 mm" => does not contain the start
        "800 mm"] => "800 mm"], restitution = 1 => restitution | between
        time = "0.5 s" => time = "5 s" => 5 s | after the end of the simulation
        time = "0.5 s" => time = "-1 s" => time | -1 s
        time = "0.5 s" => time = "0.5 s", brake_torque = "2 N m" => brake_torque | brake_force
    "#;
    for [from, to, words] in rows(cases) {
        let report = run(&edited(CONTROLLED, &from, &to)).err().unwrap();
        says(&report, &phrases(&words));
    }
    let (before, after) = CONTROLLED.split_once("[motion]").unwrap();
    let (_, after) = after.split_once("[simulation]").unwrap();
    let report = run(&format!(
        "{before}[simulation]\nstart_position = \"100 mm\"{after}"
    ))
    .err()
    .unwrap();
    assert!(report.contains("has no motion to follow"), "{report}");
}

/// Rows before the drive link left its stroke are kept.
#[test]
fn rows_before_an_error_are_kept() {
    let text = edited(
        CONTROLLED,
        "control = { speed_gain = \"400 N s/m\" }",
        "start_position = \"100 mm\"",
    );
    let text = edited(&text, "end_stops = { at = [\"0 mm\", \"800 mm\"] }\n", "");
    let file = parse(&text).unwrap();
    let found =
        jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
    // 400 N on 2 kg: 0.9 m take 95 ms.
    assert_eq!(found.columns.rows().len(), 10);
    let Some(SimulationError::EndOfStroke { t, end, speed, .. }) = found.ended else {
        panic!("{:?}", found.ended);
    };
    // √(2·0.9/200) s and √(2·0.9·200) m/s, whatever the output step.
    near("t", t, (2.0f64 * 0.9 / 200.0).sqrt(), 1e-9);
    near("v", speed, (2.0f64 * 0.9 * 200.0).sqrt(), 1e-9);
    near("end", end, 1.0, 2e-9);
}
