//! Process loads that drive the machine: where their power is positive in the direction of motion.

use jred::error::Error;
use jred::machine::Mechanism as _;

use jred_file::model::coordinate::whole_range;
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::rounding::short;

/// Positions or instants that are evaluated.
const STEPS: usize = 720;

/// Share of a load's total work back and forth below which the difference is an error of the sum: a force of constant direction returns over a cycle
/// what it takes.
const BALANCED: f64 = 1e-3;

/// A warning for each process load that drives the machine more than it resists: over the motion, or, without one, towards growing positions. Loads
/// that represent weights are excluded.
pub(super) fn of(file: &MachineFile) -> Result<Vec<String>, Error> {
    let mechanism = file.machine.mechanism();
    let coordinate = mechanism.coordinate();
    let states: Vec<(ScheduleInstant, [f64; 2])> = match &file.motion {
        Some(motion) => (0..=STEPS)
            .map(|k| motion.duration() * k as f64 / STEPS as f64)
            .map(|t| (t, motion.at(t)))
            .map(|(t, state)| {
                (
                    ScheduleInstant::of(t, state.omega),
                    [state.phi, state.omega],
                )
            })
            .collect(),
        None => whole_range(mechanism.domain(), STEPS)
            .map(|phi| (ScheduleInstant::default(), [phi, 1.0]))
            .collect(),
    };
    let loads = file.loads.iter().enumerate();
    // A web pulls in both directions of winding.
    let loads: Vec<_> = loads
        .skip(mechanism.pulls())
        .filter(|(k, named)| !mechanism.is_weight(&named.load) && !file.schedule.is_of_carriage(*k))
        .collect();
    // Position of the largest driving power, that power, the sum of all powers and of their magnitudes.
    let mut found = vec![(0.0, 0.0f64, [0.0f64; 2]); loads.len()];
    for (now, [phi, omega]) in states {
        let frames = mechanism.frames(phi)?;
        let machine = file.machine_at(&now, phi)?;
        let acting = machine.loads();
        for ((k, _), (place, driving, [net, moved])) in loads.iter().zip(&mut found) {
            let load = &acting[*k];
            let Some(frame) = frames.get(load.link()) else {
                continue;
            };
            let power = load.reduce(frame, phi).process * omega;
            *net += power;
            *moved += power.abs();
            if power > *driving {
                (*place, *driving) = (phi, power);
            }
        }
    }
    let drive = loads.iter().zip(&found);
    let drive = drive.filter(|(_, (_, _, [net, moved]))| *net > BALANCED * moved);
    Ok(drive
        .map(|((_, named), (place, driving, _))| {
            let most = if file.motion.is_some() {
                format!("with up to {} W, at {}", short(*driving), coordinate.place(*place))
            } else {
                format!("most at {}", coordinate.place(*place))
            };
            format!(
                "the process load \"{}\" drives the machine {most}: if it should resist, turn its sign",
                named.name
            )
        })
        .collect())
}
