//! The shortest stop from a plan: the governor takes over from the follower and brakes from its state.

use core::f64::consts::TAU;

use jred::axis::plan::Knot;
use jred::axis::{
    Braking, Direction, Envelope, Governor, Limits, LookAhead, Override, Period, Plan, PlanFollower,
};
use jred::number::Quantity as _;
use jred::table::Format;
use jred::{Cubic, CurveSet, Domain, Q31, Rows16, Scale, Spline, curves};

use super::machine::{si, with_model};
use super::plan::image;
use crate::support::{scale_of, value};

const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
const TICK: f32 = 0.000_5;
/// Braking torque of the drive (N·m).
const BRAKE: f32 = 8.0;
/// Time in which a follower changes its rate by 100 % (s).
const RAMP: f32 = 0.8;

/// From rest to 6 rad/s in a second, then constant for three.
fn knots() -> [Knot; 3] {
    let knot = |t, position, omega, before, after| Knot {
        t,
        position,
        omega,
        alpha: [before, after],
    };
    [
        knot(0.0, 0.0, 0.0, 0.0, 6.0),
        knot(1.0, 3.0, 6.0, 6.0, 0.0),
        knot(4.0, 21.0, 6.0, 0.0, 0.0),
    ]
}

fn stops<F: Format>(scale: Scale, error: f64) {
    with_model::<F, SET>(scale, |model| {
        let scale = *model.table().scale();
        let words = image(&knots(), Domain::Turn);
        let plan = Plan::new(&words, &model).unwrap();
        let period = Period::new(TICK, &model).unwrap();
        let envelope = Envelope::new([[6.0, BRAKE], [12.0, BRAKE]], BRAKE, &model).unwrap();
        let limits = Limits::new(envelope, 11.0, 40.0, period, &model).unwrap();
        let braking = Braking {
            torque: 0.97 * BRAKE,
            deceleration: 40.0,
            helped: false,
        };
        let ahead =
            LookAhead::<F::Number, 64>::new(&model, Direction::Forward, braking, |_| 10.0, &period)
                .unwrap();
        let governor = Governor::one_way(&ahead);
        let torque_base = f64::from(scale.torque());
        for leave in (100..7900).step_by(650) {
            let mut follower = PlanFollower::new(plan, TICK, RAMP, &model).unwrap();
            follower.start();
            for _ in 0..leave {
                follower.next(Override::FULL);
            }
            let mut motion = follower.next(Override::FULL).motion;
            let told = ahead.stop(motion.phase, motion.omega);
            let begin = motion.phase.to_bits();
            let told = f64::from(told.turns) * TAU
                + f64::from(told.phase.to_bits().wrapping_sub(begin)) / 4_294_967_296.0 * TAU;
            let still = si::<F::Number>(&scale, [0.0, 0.0]).0;
            let (mut way, mut ticks) = (0.0, 0);
            while speed_of::<F>(&scale, motion.omega.number()) > 1e-6 {
                let governed = governor.govern(&limits, &model, &motion, still);
                motion.alpha = governed.alpha;
                let torque =
                    model.torque_with(motion.phase, motion.omega, motion.alpha, governed.friction);
                let torque = value(torque) * torque_base;
                let at = format!("{} left at {leave}, tick {ticks}: {torque} N·m", F::NAME);
                assert!(torque > -f64::from(BRAKE) - error, "{at}");
                let before = motion.phase.to_bits();
                motion = period.later(motion).value;
                let step = motion.phase.to_bits().wrapping_sub(before).cast_signed();
                way += f64::from(step) / 4_294_967_296.0 * TAU;
                ticks += 1;
                assert!(ticks < 4000, "{at}");
            }
            assert!(way <= told * 1.02 + 0.01, "{}: {way} {told}", F::NAME);
            // The follower's own ramp, which ignores torque, takes longer or needs more torque than the drive has.
            let (mut slow, mut least) = (0.0, 0.0f64);
            for _ in 0..=(RAMP / TICK) as u32 {
                let planned = follower.next(Override::STILL).motion;
                slow += speed_of::<F>(&scale, planned.omega.number()) * f64::from(TICK);
                let torque = model.torque(planned.phase, planned.omega, planned.alpha);
                least = least.min(value(torque) * torque_base);
            }
            assert!(
                way < slow || least < -f64::from(BRAKE),
                "{}: {way} {slow} {least}",
                F::NAME
            );
        }
    });
}

fn speed_of<F: Format>(scale: &Scale, number: F::Number) -> f64 {
    use jred::number::Number as _;
    number.to_f64() * f64::from(scale.speed())
}

/// The torque stays within the drive's limits, and the machine stops no later than `LookAhead::stop` predicts.
#[test]
fn a_plan_is_left_for_the_shortest_stop() {
    stops::<Cubic<f64>>(Scale::SI, 1e-3);
    stops::<Spline<f32>>(Scale::SI, 2e-3);
    let scale = scale_of(250.0, 11.5, 1.5);
    stops::<Cubic<Q31>>(scale, 2e-3);
    stops::<Rows16>(scale, 0.15);
}
