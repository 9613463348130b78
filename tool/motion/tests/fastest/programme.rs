//! The press with drives of the catalogue, against a dynamic programme independent of the sweeps.

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_motion::fastest::{Task, solve};
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_sizing::catalogue::{Catalogue, Drive, DriveId};
use jred_sizing::motor::envelope::Envelope;

use super::task;
use crate::support::press_file;

/// Least time from each state (position, speed) to the end. A step goes between any two nodes of a grid of speeds if the motor can give its constant
/// acceleration at the middle of the step. Time of a step: 2·Δx/(v₀ + v₁). The speed grid makes the result slightly slower than the fastest motion,
/// evaluation at the middle slightly faster.
fn programme(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    top: f64,
    [places, speeds]: [usize; 2],
) -> f64 {
    let direction = (task.to - task.from).signum();
    let dynamics = PathDynamics::new(file, actuator.clone(), direction);
    let step = (task.to - task.from).abs() / places as f64;
    // z = ½·v² in equal steps: a difference of one is an acceleration.
    let z = |k: usize| 0.5 * top * top * k as f64 / speeds as f64;
    let v: Vec<f64> = (0..=speeds).map(|k| (2.0 * z(k)).sqrt()).collect();
    let mut least = vec![f64::INFINITY; speeds + 1];
    least[0] = 0.0;
    for place in (0..places).rev() {
        let x = (place as f64 + 0.5) * step;
        let middle = dynamics.place(task.from + direction * x).unwrap();
        let mut next = vec![f64::INFINITY; speeds + 1];
        for (from, time) in next.iter_mut().enumerate() {
            let [low, high] = dynamics.accelerations(&middle, v[from]);
            let spacing = z(1);
            let range = |a: f64| (z(from) + a * step) / spacing + 1e-9;
            let first = range(low).ceil().max(0.0) as usize;
            let last = range(high).floor().min(speeds as f64);
            if last < 0.0 {
                continue;
            }
            for to in first..=(last as usize) {
                if from + to > 0 && least[to].is_finite() {
                    *time = time.min(2.0 * step / (v[from] + v[to]) + least[to]);
                }
            }
        }
        least = next;
    }
    least[0]
}

/// About `count` drives, spread over the catalogue.
fn some(catalogue: &Catalogue, count: usize) -> impl Iterator<Item = (DriveId, Drive<'_>)> {
    catalogue.drives().step_by(catalogue.count() / count + 1)
}

/// The times agree as closely as the grid allows, from both sides.
#[test]
fn a_dynamic_programme_finds_the_same_time() {
    let file = checked::read(&press_file()).unwrap();
    let catalogue = Catalogue::built_in().unwrap();
    let mut compared = 0;
    for (_, drive) in some(&catalogue, 5) {
        let actuator = Actuator::new(
            &drive,
            Envelope::at(drive.motor, drive.amplifier, &file.site),
        );
        let asked = task(3.2, 5.0);
        let Ok(found) = solve(&file, &actuator, &asked) else {
            continue;
        };
        let speeds = found.trace.nodes().iter().map(|node| node.omega.abs());
        let largest = actuator.envelope.max_speed() * found.phases[0].speed[1]
            / PathDynamics::new(&file, actuator.clone(), 1.0).motor_speed(found.phases[0].speed[1]);
        let top = largest.min(1.3 * speeds.fold(0.0, f64::max));
        let expected = programme(&file, &actuator, &asked, top, [60, 1_200]);
        if !expected.is_finite() {
            continue;
        }
        let share = (found.time - expected).abs() / expected;
        assert!(
            share < 0.02,
            "{}: {} s, the programme {expected} s",
            drive.name(),
            found.time
        );
        compared += 1;
    }
    assert!(compared >= 2, "{compared}");
}

/// Moves there and back with drives from all over the catalogue: each is found or refused, each satisfies its limits everywhere, and a longer
/// distance takes longer.
#[test]
fn every_drive_keeps_its_limits_between_the_nodes() {
    let file = checked::read(&press_file()).unwrap();
    let catalogue = Catalogue::built_in().unwrap();
    let (mut found, mut refused) = (0, 0);
    for (_, drive) in some(&catalogue, 12) {
        let actuator = Actuator::new(
            &drive,
            Envelope::at(drive.motor, drive.amplifier, &file.site),
        );
        for (from, to) in [(3.2, 3.201), (3.2, 6.0), (3.2, 9.5), (5.0, 2.0)] {
            match solve(&file, &actuator, &task(from, to)) {
                Ok(motion) => {
                    found += 1;
                    assert!(
                        motion.excess <= 1e-9,
                        "{} {from} {to}: {:e} with {} cells",
                        drive.name(),
                        motion.excess,
                        motion.cells
                    );
                    assert!(motion.error <= 1e-9 * motion.time);
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(found > 10, "{found} found, {refused} refused");
}
