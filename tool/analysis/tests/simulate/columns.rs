//! Points, links and joint forces in the rows of a simulation.

use jred::machine::TorqueTerms;
use jred_analysis::reduce::{DrivePoint, Over, Request, Sets, add_columns, reduce_at};
use jred_analysis::simulate::{CoupledMachines, simulate};

use crate::reading::parse;
use crate::support::{Columns, budget, largest, press_text, within};

/// The columns are those of `jred reduce` at the same states, and its drive torque by d'Alembert is what the motor gives: less the
/// rotor's own at each instant, and as much work as the energies say over the time.
#[test]
fn forces_are_those_of_the_state_and_do_the_work_of_the_motor() {
    let text = press_text();
    let (machine, _) = text.split_once("[[drive_train]]").unwrap();
    let text = format!(
        "{machine}\n[simulation]\nstart_angle = \"180 deg\"\nduration = \"0.2 s\"\noutput_step = \"0.1 ms\"\ntorque_speed = [[\"0 rpm\", \"150 N m\"], [\"500 rpm\", \"20 N m\"]]\nrotor_inertia = \"0.1 kg m^2\"\n"
    );
    let file = parse(&text).unwrap();
    let found = simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
    let narrow = found.columns.heads().len();
    let sets = Sets {
        torques: true,
        points: true,
        reactions: true,
        ..Sets::default()
    };
    let alone = CoupledMachines::alone(&file);
    let machine = alone.all().next().unwrap();
    let states = found.states_of(&machine);
    let all = add_columns(&file, &found.columns, &states, sets, "").unwrap();
    let at: Vec<DrivePoint> = (found.states.iter())
        .map(|[phi, omega, alpha]| DrivePoint {
            phi: *phi,
            state: Some([*omega, *alpha]),
        })
        .collect();
    let request = Request {
        over: Over::Angle,
        positions: 2,
        sets,
        state: None,
    };
    let reduced = reduce_at(&file, &request, &at).unwrap();
    // Position, speed and acceleration of the drive link stand before them there.
    assert_eq!(all.names()[narrow..], reduced.names()[3..]);
    for (row, reduced) in all.rows().iter().zip(reduced.rows()) {
        assert_eq!(row[narrow..], reduced[3..]);
    }
    assert_eq!(all.rows().len(), reduced.rows().len());
    let all = Columns {
        names: all.names(),
        rows: all.rows().to_vec(),
    };
    let drive = all.get("T_drive [N m]");
    let (motor, alpha) = (all.get("motor torque [N m]"), all.get("alpha [rad/s^2]"));
    let most = largest(&drive);
    let parts = TorqueTerms::NAMES.map(|part| all.get(&format!("T_drive {part} [N m]")));
    // The machine starts from rest, where friction has no direction in one row.
    for k in 1..drive.len() {
        let expected = motor[k] - 0.1 * alpha[k];
        within("torque", drive[k], expected, budget::SAME_SUMS * most);
        let parts = parts.iter().map(|part| part[k]).sum::<f64>();
        within("parts", parts, expected, budget::SAME_SUMS * most);
    }
    // Simpson's rule over 2000 steps, against the work that the simulation integrates.
    let omega = all.get("omega [rad/s]");
    let power: Vec<f64> = drive.iter().zip(&omega).map(|(t, w)| t * w).collect();
    let mut work = power[0] + power[power.len() - 1];
    for (k, power) in power.iter().enumerate().skip(1).take(power.len() - 2) {
        work += power * if k % 2 == 1 { 4.0 } else { 2.0 };
    }
    work *= 1e-4 / 3.0;
    let last = omega.len() - 1;
    let expected = all.get("motor work [J]")[last] - 0.05 * omega[last] * omega[last];
    within(
        "work",
        work,
        expected,
        budget::DEFAULT_STEPS * expected.abs(),
    );
}
