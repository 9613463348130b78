//! The motor's torque, speed, holding torque and inertia ratio.

use super::{Context, Grounds, Record};
use crate::cycle::Cycle;
use crate::motor::envelope::MotorLimits;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::rules::RuleSet;

/// Seconds of a minute.
const MINUTE: f64 = 60.0;

/// A rating, NaN if it is infinite (no data).
fn known(rating: f64) -> f64 {
    if rating.is_finite() { rating } else { f64::NAN }
}

/// The largest speed; of the drive it needs only the ratio.
pub(super) fn measure_speed(
    cycle: &Cycle,
    motor: &MotorLimits,
    ratio: f64,
    findings: &mut impl Record,
) {
    let rating = known(motor.envelope.max_speed());
    findings.set(
        Rule::Speed,
        Finding::new(cycle.peak_speed() * ratio, rating),
    );
}

/// The inertia ratio.
pub(super) fn measure_inertia(context: &Context, rules: &RuleSet, findings: &mut impl Record) {
    let inertia = rules
        .choices
        .inertia_ratio_of
        .pick(&context.cycle.inertia());
    let lambda = context.drive.inertia_ratio(inertia);
    let rating = rules.choices.inertia_rating(moves_per_minute(context));
    findings.set(Rule::InertiaRatio, Finding::new(lambda, rating));
}

/// Torques that need no search over the cycle.
pub(super) fn measure_torques(context: &Context, findings: &mut impl Record) {
    let cycle = context.cycle;
    let envelope = &context.motor.envelope;
    let s1 = envelope.continuous_torque(cycle.mean_speed() * context.ratio);
    findings.set(
        Rule::RmsTorque,
        Finding::new(cycle.rms_torque(&context.coefficients), known(s1)),
    );
    let standstill = known(envelope.standstill());
    let held = holding(context);
    findings.set(Rule::HoldingTorque, Finding::new(held, standstill));
    let constant = Finding::new(constant(context), standstill);
    findings.set(Rule::ConstantTorque, constant);
}

/// The torque where the cycle comes closest to the envelope.
pub(super) fn measure_peak(context: &Context, findings: &mut impl Record) {
    let envelope = &context.motor.envelope;
    let peak = context
        .cycle
        .peak(&context.coefficients, context.ratio, envelope);
    let limit = envelope.peak_torque(peak.torque, peak.speed);
    findings.set(
        Rule::PeakTorque,
        Finding::new(peak.torque.abs(), known(limit)),
    );
}

fn moves_per_minute(context: &Context) -> f64 {
    context.cycle.mechanics().move_rate * MINUTE
}

/// Whether the gearbox is self-locking.
pub(super) fn locks(context: &Context) -> bool {
    context
        .drive
        .gearbox
        .is_some_and(|g| g.back_efficiency <= 0.0)
}

/// Default thermal time constant of a winding (s): that of a small servo motor.
const WINDING_TIME: f64 = 10.0;

/// Time (s) beyond which a torque at rest counts as permanent: the winding then approaches its steady temperature.
fn lasts(context: &Context) -> f64 {
    (context.drive.motor.thermal.winding_time).unwrap_or(WINDING_TIME)
}

/// Permanent holding torque of the motor (N·m). Friction lets it lie anywhere from τ·η_back/i, where the machine would begin to drive back, to
/// τ/(i·η), where it would begin to move on. The larger end is used, as in the time course. A self-locking gearbox needs no torque.
pub(super) fn holding(context: &Context) -> f64 {
    if locks(context) {
        return 0.0;
    }
    let most = context.cycle.mechanics().rest.lasting(lasts(context));
    let efficiency = context.drive.gearbox.map_or(1.0, |g| g.efficiency);
    most / (context.ratio * efficiency)
}

/// Torque that the brake must hold (N·m): τ/i, without the help of friction, which is not reliable.
pub(super) fn braked(context: &Context) -> f64 {
    if locks(context) {
        0.0
    } else {
        context.cycle.hold_torque() / context.ratio
    }
}

/// Whether weight, springs or loads move the machine when the motor is without current.
pub(super) fn falls(context: &Context) -> bool {
    context.cycle.mechanics().falls && !locks(context)
}

/// The least torque (N·m) of a holding brake, if the machine moves without current and the catalogue gives no brake of this motor.
pub(super) fn least_brake(context: &Context, rules: &RuleSet) -> Option<f64> {
    let share = rules.limit(Rule::BrakeTorque).fail.unwrap_or(1.0);
    let unheld = context.drive.motor.brake.is_none() && falls(context);
    unheld.then(|| braked(context) / share)
}

/// Torque of weight, springs and friction at the motor (N·m), including the motor's and the gearbox's friction at the largest speed.
fn constant(context: &Context) -> f64 {
    let [resisting, driving] = context.cycle.mechanics().constant;
    let [_, forth, back, viscous, coulomb] = context.coefficients.0;
    let own = coulomb + viscous * context.cycle.peak_speed();
    // Where the load drives, friction helps: only the friction present at any speed is counted.
    (resisting * forth + own).max(driving * back - coulomb)
}

/// Grounds of a rule of the motor.
pub(super) fn grounds(context: &Context, rules: &RuleSet, rule: Rule) -> Grounds {
    match rule {
        Rule::PeakTorque => {
            let envelope = &context.motor.envelope;
            let peak = context
                .cycle
                .peak(&context.coefficients, context.ratio, envelope);
            Grounds::PeakAt(peak.speed)
        }
        Rule::HoldingTorque | Rule::BrakeTorque if locks(context) => Grounds::SelfLocking,
        Rule::HoldingTorque => {
            let rest = &context.cycle.mechanics().rest;
            let time = lasts(context);
            Grounds::Holding {
                dwell: rest.longest_above(rest.lasting(time)),
                time,
                given: context.drive.motor.thermal.winding_time.is_some(),
            }
        }
        Rule::InertiaRatio => {
            let by_moves = !rules.choices.inertia_ratio_by_moves.is_empty();
            Grounds::InertiaRatio {
                of: rules.choices.inertia_ratio_of,
                moves: by_moves.then(|| moves_per_minute(context)),
            }
        }
        _ => Grounds::None,
    }
}
