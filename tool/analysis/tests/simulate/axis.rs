//! Simulations of axes of which people speak in millimetres.

use jred_analysis::simulate::simulate;

use super::run;
use crate::reading::{parse, rendered};
use crate::support::{Columns, budget, near, within};

/// A carriage of 8 kg on a belt over pulleys of 50 mm; the axis counts in mm from the drive link's zero.
fn axis(simulation: &str) -> String {
    format!(
        r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "belt-axis"
belt_mass = "0 kg"
[mechanism.pulley]
diameter = "100 mm"
inertia = "0.005 kg m^2"
[mechanism.carriage]
mass = "8 kg"
[motion]
type = "cycle"
of = {{ point = "carriage", along = "x" }}
[[motion.segment]]
law = "polynomial-345"
move = "600 mm"
duration = "1 s"
[[motion.segment]]
law = "polynomial-345"
move = "-600 mm"
duration = "1 s"
[simulation]
duration = "1 s"
output_step = "10 ms"
torque = "2 N m"
{simulation}
"#
    )
}

/// x = x₀ + v₀·t + ½·a·t², until the stop is hit.
#[test]
fn rows_starts_and_stops_are_those_of_the_carriage() {
    let text = axis(
        "start_position = \"-100 mm\"\nstart_speed = \"0.2 m/s\"\nend_stops = { at = [\"-200 mm\", \"400 mm\"] }",
    );
    let file = parse(&text).unwrap();
    let found = simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
    let rows = Columns {
        names: found.columns.names(),
        rows: found.columns.rows().to_vec(),
    };
    // J = 8·0.05² + 0.005 kg·m² a pulley, of which there is one.
    let [inertia, ..] = [rows.get("J_red [kg m^2]")[0]];
    assert!(inertia > 0.02 && inertia < 0.04, "{inertia}");
    let a = 2.0 / inertia * 0.05;
    let hit = (-0.2 + (0.2f64 * 0.2 + 2.0 * a * 0.5).sqrt()) / a;
    let mut before = 0;
    for (k, t) in rows.get("t [s]").into_iter().enumerate() {
        let of = |name: &str| rows.get(name)[k];
        if t < hit {
            let x = -0.1 + 0.2 * t + 0.5 * a * t * t;
            within("x", of("x [mm]"), 1e3 * x, budget::CLOSED_MOTION * 600.0);
            within("v", of("v [m/s]"), 0.2 + a * t, budget::CLOSED_MOTION);
            near("a", of("a [m/s^2]"), a, budget::CLOSED_MOTION);
            before += 1;
        } else {
            within("at rest", of("x [mm]"), 400.0, budget::CLOSED_MOTION);
        }
    }
    assert!(before > 20 && before < 100, "{before}");
    let impacts = found.impacts.unwrap();
    near("impact", impacts.time, hit, budget::CLOSED_MOTION);
    let speed = file.axis().rate(impacts.speed);
    near("its speed", speed, 0.2 + a * hit, budget::CLOSED_MOTION);
}

/// The drive link's own angle may be given as well, and is the same place.
#[test]
fn an_angle_is_the_pulley_s() {
    let as_angle = axis("start_angle = \"-114.59155902616465 deg\"\nstart_speed = \"4 rad/s\"");
    let as_length = axis("start_position = \"-100 mm\"\nstart_speed = \"0.2 m/s\"");
    let [angle, length] = [as_angle, as_length].map(|text| {
        let simulation = parse(&text).unwrap().simulation.unwrap();
        [simulation.start_angle, simulation.start_speed]
    });
    near("start", angle[0], -2.0, budget::CLOSED_FORM);
    near("start", length[0], -2.0, budget::CLOSED_FORM);
    near("speed", angle[1], 4.0, budget::CLOSED_FORM);
    near("speed", length[1], 4.0, budget::CLOSED_FORM);
    let both = axis("start_position = \"-100 mm\"\nstart_angle = \"0 deg\"");
    let report = run(&both).err().unwrap();
    assert!(
        report.contains("both `start_angle` and `start_position`"),
        "{report}"
    );
    let none = rendered(&parse(&axis("")).err().unwrap());
    assert!(none.contains("start_position"), "{none}");
    let wrong = axis("start_position = \"3 kg\"");
    let report = run(&wrong).err().unwrap();
    assert!(
        report.contains("start_position") && report.contains("mm"),
        "{report}"
    );
}
