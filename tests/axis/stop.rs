use core::f64::consts::TAU;

use jred::axis::{Braking, Direction, LookAhead, Period};
use jred::table::Format;
use jred::{Cubic, Phase, Q31, Rows16, Scale, Spline};
use proptest::num::u32::ANY;

use super::look_ahead::{BRAKING, FAST, INVISCID, SET, turns, with_ahead};
use super::machine::{si, with_model_of};
use crate::support::machines::Wave;
use crate::support::{assert_near, samples, scale_of, value};

/// Angle until the exact machine stops under the brake.
fn stopped(phi: f64, omega: f64, load: f64, coulomb: f64, viscous: f64) -> f64 {
    let steps = 20_000;
    // In time, because speed-dependent friction has no integral over the angle.
    let step = omega.abs() / 2.0 / f64::from(steps);
    let alpha = |phi: f64, omega: f64| {
        let drag =
            -0.125 * phi.sin() * omega * omega - load * phi.sin() + viscous * omega + coulomb;
        (-8.0 - drag) / (1.0 + 0.25 * phi.cos())
    };
    let [mut at, mut omega] = [phi, omega];
    loop {
        let mid = omega + step / 2.0 * alpha(at, omega);
        let after = omega + step * alpha(at + step / 2.0 * omega, mid);
        if after <= 0.0 {
            // The remainder at constant deceleration.
            return at - phi + omega * omega / (2.0 * -alpha(at, omega));
        }
        at += step * mid;
        omega = after;
    }
}

fn stops<F: Format>(scale: Scale, error: f64) {
    for direction in [Direction::Forward, Direction::Backward] {
        with_ahead::<F, 128>(
            scale,
            direction,
            BRAKING,
            |_| FAST,
            |model, ahead| {
                let scale = *model.table().scale();
                for (bits, omega) in samples(200, 0xff12, &(ANY, 0.0..10.0)) {
                    let forward = direction == Direction::Forward;
                    let (way, phase) = if forward { (1.0, bits) } else { (-1.0, !bits) };
                    let (w, _) = si::<F::Number>(&scale, [way * omega, 0.0]);
                    let omega = (value(w) * f64::from(scale.speed())).abs();
                    let found = ahead.stop(Phase::from_bits(phase), w);
                    assert!(!found.beyond);
                    let to = if forward {
                        found.phase.to_bits()
                    } else {
                        !found.phase.to_bits()
                    };
                    let distance =
                        f64::from(found.turns) + f64::from(to.wrapping_sub(bits)) / 4_294_967_296.0;
                    let phi = f64::from(bits) / 4_294_967_296.0 * TAU;
                    let exact = stopped(phi, omega, 3.0, 0.5, 0.0);
                    let name = format!("{} {direction:?} from {phi} at {omega}", F::NAME);
                    assert_near(&name, distance * TAU, exact, error * (1.0 + exact));
                    // Viscous friction only helps; without the help of load and friction it takes longer.
                    assert!(stopped(phi, omega, 3.0, 0.5, 0.1) <= exact);
                }
                // At rest the stopping position is the current one.
                for bits in [0, 1, 0x1234_5678, u32::MAX - 1] {
                    let found = ahead.stop(Phase::from_bits(bits), Default::default());
                    let off = found.phase.to_bits().wrapping_sub(bits).cast_signed();
                    assert!(
                        found.turns == 0 && off.abs() < 1 << 10,
                        "{bits:x}: {found:x?}"
                    );
                }
            },
        );
    }
}

#[test]
fn it_stops_where_it_was_said() {
    stops::<Cubic<f64>>(Scale::SI, 5e-4);
    stops::<Spline<f32>>(Scale::SI, 5e-4);
    let scale = scale_of(250.0, 12.0, 1.5);
    stops::<Cubic<Q31>>(scale, 5e-4);
    stops::<Rows16>(scale, 5e-3);
}

#[test]
fn a_weak_brake_takes_turns_and_help_is_not_counted() {
    let weak = Braking {
        torque: 3.5,
        helped: false,
        ..BRAKING
    };
    with_ahead::<Cubic<f64>, 128>(
        Scale::SI,
        Direction::Forward,
        weak,
        |_| 30.0,
        |_, ahead| {
            // The load drives in the first half of the turn: 6 N·m·rad of 3.5·2π per turn. From the dead centre, where J is 1.25.
            let a_turn = 3.5 * TAU - 6.0;
            for n in [1, 3, 20] {
                let energy = f64::from(n) * a_turn;
                let found = ahead.stop(Phase::default(), (2.0 * energy / 1.25).sqrt());
                let passed = f64::from(found.turns) + turns(found.phase);
                assert_near(&format!("{n} turns"), passed, f64::from(n), 1e-3);
            }
            // Half a turn later nothing drives it for the next half.
            let found = ahead.stop(Phase::from_bits(1 << 31), (2.0 * 3.5_f64 / 0.75).sqrt());
            assert_near("a radian", (turns(found.phase) - 0.5) * TAU, 1.0, 1e-3);
            assert!(ahead.stop(Phase::default(), -1.0).beyond);
            assert!(ahead.stop(Phase::default(), 61.0).beyond);
            assert!(!ahead.stop(Phase::default(), 59.0).beyond);
            assert!(ahead.stop(Phase::default(), f64::NAN).beyond);
        },
    );
}

#[test]
fn it_does_not_stop_later_where_brake_and_inertia_change() {
    // J from 0.1 to 1.9, a brake of 3 N·m against a load of up to 3: 0.5 to 6.5 N·m with friction.
    let wave = Wave {
        swing: 0.9,
        ..INVISCID
    };
    let braking = Braking {
        torque: 3.0,
        ..BRAKING
    };
    with_model_of::<Cubic<f64>, SET>(&wave, Scale::SI, |model| {
        let period = Period::new(0.000_5, &model).unwrap();
        let ahead =
            LookAhead::<f64, 64>::new(&model, Direction::Forward, braking, |_| 12.0, &period)
                .unwrap();
        let net = |phi: f64| 3.0 + 0.5 - 3.0 * phi.sin();
        for (bits, omega) in samples(300, 0xff13, &(ANY, 0.5..12.0)) {
            let phi = f64::from(bits) / 4_294_967_296.0 * TAU;
            // ½·J·ω² = ∫ (3.5 − 3·sin) dφ, by bisection: the work grows with the angle.
            let energy = 0.5 * (1.0 + 0.9 * phi.cos()) * omega * omega;
            let work = |distance: f64| 3.5 * distance + 3.0 * ((phi + distance).cos() - phi.cos());
            let [mut low, mut high] = [0.0, energy / 0.5 + 1.0];
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if work(middle) < energy {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let found = ahead.stop(Phase::from_bits(bits), omega);
            let said = f64::from(found.turns)
                + f64::from(found.phase.to_bits().wrapping_sub(bits)) / 4_294_967_296.0;
            let late = low - said * TAU;
            // An eighth of an interval at each end, times the relative change of the braking torque in the interval; the curvature of the chords is
            // smaller.
            let step = TAU / 64.0;
            let bound: f64 = [phi, phi + low]
                .iter()
                .map(|at| step / 8.0 * (net(at - step) / net(at + step)).ln().abs())
                .sum();
            assert!(
                late < bound + 1e-4,
                "from {phi} at {omega}: {late} later, {bound}"
            );
            // Nor much too early: the bulge of J between two nodes, half a per cent, twice.
            assert!(
                late > -0.02 * (1.0 + low) - bound,
                "from {phi} at {omega}: {late}"
            );
        }
    });
}
