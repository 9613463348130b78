use core::f64::consts::{SQRT_2, TAU};

use jred::axis::{Observer, Payload};
use jred::number::FrictionSign;
use jred::table::Format;
use jred::{CurveSet, Q31, Scale, Spline, curves};

use super::machine::with_model_of;
use super::watched::{CRANK, OMEGA, PAYLOAD, Plant, TICK, bases, machine, peak};
use crate::support::assert_near;

const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// The payload and the constant load that are found after some turns, with their share of the variance, and the same for no motion.
fn found<F: Format>(scale: Scale, payload: f64, friction: f64, noise: f64) -> [f64; 3] {
    let mut found = [0.0; 3];
    with_model_of::<F, SET>(&CRANK, scale, |model| {
        with_model_of::<F, { curves::LOAD }>(&PAYLOAD, scale, |unit| {
            let mut plant = Plant::new(machine(payload, 0.0), noise, 11);
            plant.machine.coulomb += friction;
            let mut observer = Observer::with_bandwidth(60.0, TICK as f32, &model).unwrap();
            let mut estimate = Payload::new(50.0, 4000, &observer, &model).unwrap();
            for k in 0..8000 {
                let command = plant.command();
                let measured = plant.tick(command, 0.0);
                let scale = model.table().scale();
                let friction = FrictionSign::OfSpeed(scale.omega(OMEGA as f32).value);
                let acted = scale.to_torque(command as f32).value;
                let seen = observer.update(&model, measured, acted, friction);
                if k == 1000 {
                    assert!(estimate.estimate().excited);
                    estimate.restart();
                    assert!(!estimate.estimate().excited);
                }
                let motion = seen.motion;
                let torque = unit.torque(motion.phase, motion.omega, motion.alpha);
                estimate.update(seen.load, torque);
            }
            let last = estimate.estimate();
            assert!(last.excited);
            found = [last.payload, last.offset, last.explained].map(f64::from);
        });
    });
    found
}

fn payloads_are_found<F: Format>(scale: Scale) {
    let found = |payload, friction, noise| found::<F>(scale, payload, friction, noise);
    for payload in [0.0, 0.5, 3.0, -1.0] {
        let [mass, offset, explained] = found(payload, 0.0, 0.0);
        assert_near("payload", mass, payload, 0.002 * payload.abs() + 0.002);
        assert_near("offset", offset, 0.0, 0.02);
        assert!(payload == 0.0 || explained > 0.98, "{explained}");
    }
    // Friction that the table lacks is the offset.
    let [mass, offset, _] = found(2.0, 0.7, 0.0);
    assert_near("payload", mass, 2.0, 0.01);
    assert_near("offset", offset, -0.7, 0.02);
    let [mass, ..] = found(2.0, 0.0, 0.01 * peak());
    assert_near("noisy payload", mass, 2.0, 0.04);
}

#[test]
fn a_payload_is_found() {
    payloads_are_found::<Spline<f32>>(Scale::SI);
    payloads_are_found::<Spline<Q31>>(bases());
}

/// A torque that varies little about a mean near the largest one, as one that is just excited does.
#[test]
fn a_large_mean_costs_no_accuracy() {
    with_model_of::<Spline<f32>, SET>(&CRANK, Scale::SI, |model| {
        let observer = Observer::with_bandwidth(60.0, TICK as f32, &model).unwrap();
        for mean in [0.95, 0.951, 0.952, 0.953, 0.954] {
            // An odd window: halves have no half tick. A wave so slow that the lag is nothing, of 1200 counts.
            let mut estimate = Payload::new(50.0, 4001, &observer, &model).unwrap();
            let deviation = 1200.0 * 50.0 / 1_048_576.0;
            for k in 0..9000 {
                let wave = (f64::from(k) * TAU / 4000.0).sin() * SQRT_2 * deviation;
                let unit = mean * 50.0 + wave;
                estimate.update((3.0 - unit) as f32, unit as f32);
                if k == 1000 {
                    estimate.restart();
                }
            }
            let found = estimate.estimate();
            assert!(found.excited);
            assert_near("payload", found.payload.into(), 1.0, 0.002);
            assert_near("offset", found.offset.into(), 3.0, 0.1);
        }
    });
}

/// Without a change of the unit's torque nothing is known, whatever the load.
#[test]
fn a_motion_without_excitation_says_so() {
    with_model_of::<Spline<f32>, SET>(&CRANK, Scale::SI, |model| {
        let observer = Observer::with_bandwidth(60.0, TICK as f32, &model).unwrap();
        let mut estimate = Payload::new(50.0, 200, &observer, &model).unwrap();
        for k in 0..1000u16 {
            estimate.update(f32::from(k % 7), 3.0);
        }
        estimate.update(f32::NAN, 1.0);
        estimate.update(1.0, f32::NAN);
        // The filter's step has left the window.
        let none = estimate.estimate();
        assert!(!none.excited && none.payload == 0.0, "{none:?}");
        for (largest, window) in [
            (0.0, 200),
            (f32::NAN, 200),
            (50.0, 63),
            (50.0, (1 << 20) + 1),
        ] {
            assert!(Payload::new(largest, window, &observer, &model).is_err());
        }
    });
}
