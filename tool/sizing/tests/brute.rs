//! Figures of a cycle for a drive by plain loops over its samples: reference for `Cycle` and for its timing.
#![allow(dead_code)]

use jred_analysis::duty::{Duty, Smooth};
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::cycle::{Cycle, Peak};
use jred_sizing::motor::envelope::Envelope;

/// A duty reduced to its instants, all that plain loops use.
pub(crate) fn sampled(mut duty: Duty) -> Duty {
    duty.smooth = Smooth::default();
    duty
}

/// RMS of the motor torque.
pub(crate) fn rms_torque(cycle: &Cycle, c: &Coefficients) -> f64 {
    let samples = cycle.samples().iter();
    let squares = samples.map(|s| s.weight * c.torque(&s.loads()).powi(2));
    (squares.sum::<f64>() / cycle.duration()).sqrt()
}

/// Mean of the motor torque.
pub(crate) fn mean_torque(cycle: &Cycle, c: &Coefficients) -> f64 {
    let samples = cycle.samples().iter();
    samples
        .map(|s| s.weight * c.torque(&s.loads()))
        .sum::<f64>()
        / cycle.duration()
}

/// Least and largest motor torque.
pub(crate) fn extremes(cycle: &Cycle, c: &Coefficients) -> [f64; 2] {
    let torques = cycle.samples().iter().map(|s| c.torque(&s.loads()));
    torques.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], torque| {
        [low.min(torque), high.max(torque)]
    })
}

/// Least, largest and RMS power.
pub(crate) fn power(cycle: &Cycle, c: &Coefficients, ratio: f64) -> [f64; 3] {
    let (mut low, mut high, mut squares) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
    for sample in cycle.samples() {
        let power = c.torque(&sample.loads()) * (sample.speed() * ratio);
        (low, high) = (low.min(power), high.max(power));
        squares += sample.weight * power * power;
    }
    [low, high, (squares / cycle.duration()).sqrt()]
}

/// Energy delivered and energy regenerated.
pub(crate) fn energies(cycle: &Cycle, c: &Coefficients, ratio: f64) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for sample in cycle.samples() {
        let power = c.torque(&sample.loads()) * (sample.speed() * ratio);
        sums[0] += sample.weight * power.max(0.0);
        sums[1] += sample.weight * (-power).max(0.0);
    }
    sums
}

/// The sample closest to the envelope.
pub(crate) fn peak(cycle: &Cycle, c: &Coefficients, ratio: f64, envelope: &Envelope) -> Peak {
    let mut peak = Peak {
        used: f64::NEG_INFINITY,
        torque: 0.0,
        speed: 0.0,
    };
    for sample in cycle.samples() {
        let torque = c.torque(&sample.loads());
        let speed = sample.speed() * ratio;
        let used = envelope.peak_used(torque, speed);
        if used > peak.used {
            peak = Peak {
                used,
                torque,
                speed,
            };
        }
    }
    peak
}

/// Largest torque at the gearbox output.
pub(crate) fn peak_output_torque(cycle: &Cycle) -> f64 {
    let torques = cycle.samples().iter().map(|s| s.output_torque().abs());
    torques.fold(0.0, f64::max)
}

/// Root-mean-power torque at the gearbox output, weighted with the speed.
pub(crate) fn mean_output_torque(cycle: &Cycle, power: f64) -> f64 {
    let (mut sum, mut turning) = (0.0, 0.0);
    for sample in cycle.samples() {
        let share = sample.weight * sample.speed().abs();
        sum += share * sample.output_torque().abs().powf(power);
        turning += share;
    }
    if turning > 0.0 {
        (sum / turning).powf(1.0 / power)
    } else {
        0.0
    }
}

/// Sum of the magnitudes of a torque's terms, each at its largest; reference for roundings.
pub(crate) fn scale(cycle: &Cycle, c: &Coefficients) -> f64 {
    let largest = |k: usize| {
        let loads = cycle.samples().iter().map(|s| s.loads()[k].abs());
        loads.fold(0.0, f64::max)
    };
    (0..c.0.len()).map(|k| c.0[k].abs() * largest(k)).sum()
}
