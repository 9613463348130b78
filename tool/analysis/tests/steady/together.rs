//! Several machines on one shaft.

use jred_analysis::simulate::CoupledMachines;
use jred_analysis::steady::{Steady, SteadyError, SteadyFigures, SteadyRequest, steady_together};
use jred_file::model::machine::MachineFile;

use super::{checked, checked_to, of};
use crate::reading::{parse, table_behind_gears};
use crate::support::{budget, near, press_text, within};

fn together(
    first: &MachineFile,
    others: &[(&MachineFile, f64)],
    delta: Option<f64>,
) -> Result<Steady, SteadyError> {
    let simulation = first.simulation.as_ref().unwrap();
    let machines = CoupledMachines::alone(first)
        .with(others.iter().copied(), simulation)
        .unwrap();
    let request = SteadyRequest {
        delta,
        ..SteadyRequest::default()
    };
    steady_together(&machines, simulation, &request)
}

/// The press under a motor of this many times the torque and inertia.
fn press(times: f64) -> String {
    press_text()
        .replace(
            "torque_speed = [[\"0 rpm\", \"60 N m\"], [\"500 rpm\", \"45 N m\"], [\"800 rpm\", \"0 N m\"]]",
            &format!(
                "torque_speed = [[\"0 rpm\", \"{} N m\"], [\"500 rpm\", \"{} N m\"], [\"800 rpm\", \"0 N m\"]]",
                60.0 * times,
                45.0 * times
            ),
        )
        .replace("200 kg cm^2", &format!("{} kg cm^2", 200.0 * times))
}

/// Two presses in step under twice the motor are one press under its own; half a turn apart they run more evenly, and need a smaller flywheel.
#[test]
fn two_presses_in_step_are_one() {
    let alone = of(&press(1.0)).cycle.unwrap().figures;
    let (first, second) = (parse(&press(2.0)).unwrap(), parse(&press(1.0)).unwrap());
    let start = first.simulation.as_ref().unwrap().start_angle;
    let cycle = |ahead: f64, delta| {
        let found = together(&first, &[(&second, start + ahead)], delta);
        // With the edges of two machines in a turn.
        checked_to(2.0 * budget::STEADY_RESIDUAL, found)
    };
    let both = cycle(0.0, None).cycle.unwrap().figures;
    near("δ", both.delta, alone.delta, budget::STEADY_BALANCE);
    near(
        "mean speed",
        both.mean_speed,
        alone.mean_speed,
        budget::STEADY_BALANCE,
    );
    let works = |figures: &SteadyFigures| {
        let energy = figures.energy;
        [energy.motor, energy.process, energy.losses]
    };
    for (both, alone) in works(&both).into_iter().zip(works(&alone)) {
        near("works", both, 2.0 * alone, budget::STEADY_BALANCE);
    }
    let apart = cycle(std::f64::consts::PI, None).cycle.unwrap().figures;
    assert!(
        apart.delta < 0.7 * both.delta,
        "{} {}",
        apart.delta,
        both.delta
    );
    let target = 0.6 * apart.delta;
    let wheel = |ahead: f64| cycle(ahead, Some(target)).flywheel.unwrap();
    let (level, odd) = (wheel(0.0), wheel(std::f64::consts::PI));
    assert!(odd.inertia > 0.0 && odd.inertia < 0.7 * level.inertia);
    for found in [level, odd] {
        let delta = found.cycle.figures.delta;
        within("δ", delta, target, 1e-9 * delta);
    }
}

/// A table that turns twice as fast is a flywheel of four times its inertia, and its friction counts twice.
#[test]
fn a_faster_machine_counts_by_its_ratio() {
    let (fast, slow) = (turning(1.0, 0.7, 20), turning(0.5, 0.4, 40));
    let found = checked(together(&slow, &[(&fast, 0.3)], None));
    let figures = found.cycle.unwrap().figures;
    // Motor 20 N m less 0.05 N m s/rad of its speed: its work against 0.4/2 and 0.7 N m of friction.
    let speed = (20.0 - 0.4 / 2.0 - 0.7) / 0.05;
    near(
        "speed",
        figures.motor_speed.abs(),
        speed,
        budget::STEADY_BALANCE,
    );
    // Of the tables and, through gears of 2, of the rotor.
    let heads = figures.course.names();
    let k = heads
        .iter()
        .position(|name| name == "J_red [kg m^2]")
        .unwrap();
    let total = figures.course.rows()[3][k].unwrap();
    near("J", total, 0.5 + 4.0 * 1.0 + 4.0 * 0.02, 1e-12);
    // The other way round a turn of the first is half a turn of the second.
    let refused = together(&fast, &[(&slow, 0.3)], None).unwrap_err();
    let half = matches!(refused, SteadyError::NotWhole { turns: 0.5, .. });
    assert!(half, "{refused:?}");
}

/// A table of this inertia and friction behind gears without loss, under a shunt motor.
fn turning(inertia: f64, friction: f64, driven: u32) -> MachineFile {
    let rest = r#"
[simulation]
start_angle = "0 deg"
duration = "1 s"
output_step = "20 ms"
torque_speed = [["0 rad/s", "20 N m"], ["400 rad/s", "0 N m"]]
rotor_inertia = "0.02 kg m^2"
"#;
    table_behind_gears([inertia, friction], driven, rest)
}
