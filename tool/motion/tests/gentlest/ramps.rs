//! Ramps: the acceleration rises from zero to its first peak in the requested share of the time.

use jred_file::model::machine::MachineFile;
use jred_motion::gentlest::cycle::Goal;
use jred_motion::moves::{Part, chain};
use jred_motion::trace::Trace;

use super::{example, machine, solved};

const RAMPS: [f64; 4] = [0.02, 0.05, 0.1, 0.25];

/// A table that makes one turn in a second.
fn turning_table() -> MachineFile {
    machine(
        "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\ninertia = \"2 kg m^2\"\n\
         [motion]\ntype = \"point-to-point\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"360 deg\"\nduration = \"1 s\"\n",
    )
}

/// Shares of the time, within a move between two times, at which the acceleration first reaches a share of its first peak and last has that share of
/// its last one.
fn rises(trace: &Trace, [from, to]: [f64; 2], reached: f64) -> [f64; 2] {
    let count = 20_000;
    let size = |k: usize| {
        let t = from + (to - from) * k as f64 / count as f64;
        trace.at(t).alpha.abs()
    };
    let all: Vec<f64> = (0..=count).map(size).collect();
    let most = all[1..count].iter().copied().fold(0.0, f64::max);
    // A drop of less than a thousandth of the largest value does not end the rise.
    let first = |values: &mut dyn Iterator<Item = f64>| {
        let mut peak = (0.0, 0);
        for (k, value) in values.enumerate() {
            if value > peak.0 {
                peak = (value, k);
            } else if value < peak.0 - 1e-3 * most {
                break;
            }
        }
        peak
    };
    let ahead: Vec<f64> = all[..count].to_vec();
    let back: Vec<f64> = ahead.iter().rev().copied().collect();
    [ahead, back].map(|values| {
        let (peak, _) = first(&mut values.iter().copied());
        let at = values.iter().position(|value| *value >= reached * peak);
        at.unwrap_or(count) as f64 / count as f64
    })
}

/// Constant inertia has its first peak there; a press, whose torque may rise later, nine tenths of it, which the ramp alone reaches after four
/// fifths.
#[test]
fn the_acceleration_rises_in_the_share_of_the_time() {
    for (name, file, reached, [least, most]) in [
        ("table", turning_table(), 1.0, [0.99, 1.01]),
        ("press", example("press", &[]), 0.9, [0.79, 1.05]),
    ] {
        let parts = chain(file.motion.as_ref().unwrap(), &[]).unwrap().parts;
        for ramp in RAMPS {
            let found = solved(&file, Goal::Rms, ramp);
            let mut t = 0.0;
            for part in &parts {
                if let Part::Move(step) = part {
                    for rise in rises(&found.trace, [t, t + step.duration], reached) {
                        let share = rise / ramp;
                        assert!(
                            least <= share && share <= most,
                            "{name}: {rise}, not {ramp}"
                        );
                    }
                }
                t += part.duration();
            }
        }
    }
}

/// A shorter ramp costs less. A law whose acceleration rises as long or longer costs more: the modified ones take an eighth of the time, the
/// cycloidal one a quarter.
#[test]
fn ramps_take_less_than_laws_that_rise_as_long() {
    for file in [turning_table(), example("press", &[])] {
        let mut last = 0.0;
        for (ramp, laws) in [
            (0.02, &["modified-sine", "modified-trapezoid"][..]),
            (0.05, &["modified-sine", "modified-trapezoid"]),
            (0.1, &["modified-sine", "modified-trapezoid"]),
            (0.125, &["modified-sine", "modified-trapezoid"]),
            (0.25, &["cycloidal", "polynomial-4567"]),
        ] {
            let found = solved(&file, Goal::Rms, ramp);
            assert!(found.best.rms > last, "{ramp}: {}", found.best.rms);
            last = found.best.rms;
            for name in laws {
                let law = found.laws.iter().find(|row| row.name == *name).unwrap();
                assert!(
                    last <= law.figures.rms,
                    "{ramp}: {last}, {name} {}",
                    law.figures.rms
                );
            }
        }
    }
}
