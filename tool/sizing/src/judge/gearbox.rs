//! The gearbox's torques, speeds and cycles.

use super::{Context, Grounds, Record};
use crate::catalogue::Gearbox;
use jred_analysis::duty::mechanics::Braking;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::rules::{MeanTorque, RuleSet};

/// Seconds of an hour.
const HOUR: f64 = 3600.0;

/// The rules that depend only on gearbox and cycle, not on the motor.
pub(super) fn measure_alone(context: &Context, rules: &RuleSet, findings: &mut impl Record) {
    let Some(gearbox) = context.drive.gearbox else {
        return;
    };
    let cycle = context.cycle;
    let cycles = cycles_per_hour(context);
    findings.set(
        Rule::GearboxPeak,
        Finding::against(
            cycle.peak_output_torque(),
            gearbox.acceleration_torque(cycles),
        ),
    );
    let exponent = rules.choices.gearbox_mean_exponent.exponent();
    findings.set(
        Rule::GearboxCubicMean,
        Finding::against(cycle.mean_output_torque(exponent), gearbox.rated_torque),
    );
    findings.set(
        Rule::GearboxMeanSpeed,
        Finding::against(cycle.mean_speed() * context.ratio, gearbox.rated_speed),
    );
    findings.set(
        Rule::GearboxSpeed,
        Finding::against(cycle.peak_speed() * context.ratio, gearbox.max_speed),
    );
    if cycles > 0.0 {
        let most = gearbox.most_cycles();
        findings.set(Rule::GearboxCycles, Finding::new(cycles, most));
    }
}

/// The emergency stop, in which the motor brakes.
pub(super) fn measure_stop(context: &Context, findings: &mut impl Record) {
    let Some(gearbox) = context.drive.gearbox else {
        return;
    };
    let stop = gearbox.emergency_torque.and_then(|rating| {
        let [torque, _] = emergency(context, gearbox)?;
        Some(Finding::new(torque, rating))
    });
    findings.set(Rule::GearboxEmergency, stop.unwrap_or(Finding::UNKNOWN));
}

/// Moves of the drive link per hour: each loads the teeth with an acceleration torque.
fn cycles_per_hour(context: &Context) -> f64 {
    context.cycle.mechanics().move_rate * HOUR
}

/// Torque through the gearbox (N·m) in the worst emergency stop, and the inertia at its output (kg·m²) there. The motor brakes with the larger of its
/// peak torque at standstill and its brake torque. `None` if that torque is unknown, or if the gearbox locks itself
/// under the inertia of the machine, so that its stiffness decides: its back efficiency is far enough below zero ([`Braking::torque_at`]).
fn emergency(context: &Context, gearbox: &Gearbox) -> Option<[f64; 2]> {
    let motor = context.drive.motor;
    let mechanics = context.cycle.mechanics();
    let peak = context.motor.stop;
    let [_, _, _, viscous, coulomb] = context.coefficients.0;
    let friction = coulomb + viscous * context.cycle.peak_speed();
    let braking = Braking {
        torque: peak.max(motor.brake.map_or(0.0, |brake| brake.torque)) + friction,
        inertia: context.coefficients.0[0] / context.ratio,
        ratio: context.ratio,
        back_efficiency: gearbox.back_efficiency,
    };
    let worst = mechanics.stop.worst(&braking);
    worst
        .or(Some([0.0, 0.0]))
        .filter(|[torque, _]| torque.is_finite())
}

/// Grounds of a rule of the gearbox.
pub(super) fn grounds(context: &Context, rules: &RuleSet, rule: Rule, finding: Finding) -> Grounds {
    let Some(gearbox) = context.drive.gearbox else {
        return Grounds::None;
    };
    match rule {
        Rule::GearboxPeak => {
            let cycles = cycles_per_hour(context);
            let factor = gearbox.shock_factor(cycles);
            if factor > 1.0 {
                return Grounds::ShockFactor { factor, cycles };
            }
        }
        Rule::GearboxCubicMean
            if rules.choices.gearbox_mean_exponent == MeanTorque::RollerBearing =>
        {
            return Grounds::RollerBearing;
        }
        Rule::GearboxEmergency if finding.is_known() => {
            if let Some([_, inertia]) = emergency(context, gearbox) {
                return Grounds::EmergencyAt(inertia);
            }
        }
        Rule::GearboxEmergency if gearbox.emergency_torque.is_some() => {
            // Only below zero does it lock: see [`Braking::torque_at`].
            return if gearbox.back_efficiency < 0.0 {
                Grounds::SelfLocking
            } else {
                Grounds::Missing("peak torque of the motor")
            };
        }
        Rule::GearboxCycles if !gearbox.shock_factors.is_empty() => return Grounds::ShockFactors,
        _ => {}
    }
    Grounds::None
}
