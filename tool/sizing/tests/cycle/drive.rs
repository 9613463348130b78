//! Figures of a drive over a cycle, against the drive's torque and speed at every instant.

use std::path::Path;

use super::runner;
use crate::brute;
use crate::support::{budget, near, press_text, within};
use jred_analysis::checked;
use jred_analysis::duty::{Duty, Instant};
use jred_sizing::catalogue::{Brake, Drive, Gearbox, Motor};
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;

use super::random::{coefficients, duty};

fn press() -> Duty {
    let file = checked::parse("press.toml", &press_text(), Path::new("")).unwrap();
    brute::sampled(Duty::new(&file, file.motion.as_ref().unwrap(), 1000).unwrap())
}

fn motor() -> Motor {
    Motor {
        rotor_inertia: 6e-4,
        brake: Some(Brake {
            torque: 9.0,
            inertia: 2e-4,
            ..Default::default()
        }),
        friction: [0.3, 4e-3],
        ..Motor::default()
    }
}

/// J_load/J_rotor at the motor, T and n at its shaft, their product: means over time, extremes and root mean squares, with and without a gearbox.
#[test]
fn figures_at_the_motor_are_those_of_its_instants() {
    let (duty, motor) = (press(), motor());
    let cycle = Cycle::new(&duty);
    let gearbox = Gearbox {
        ratio: 7.0,
        inertia: 3e-4,
        efficiency: 0.9,
        back_efficiency: 0.85,
        no_load_torque: 0.2,
        ..Gearbox::default()
    };
    for gearbox in [None, Some(&gearbox)] {
        let drive = Drive {
            motor: &motor,
            gearbox,
            amplifier: None,
        };
        let found = cycle.motor_duty(&drive);
        let ratio = gearbox.map_or(1.0, |g| g.ratio);
        // By hand: power flows to the machine where torque and speed have one sign.
        let torque = |i: &Instant| {
            let drives = i.input_torque * i.input_speed >= 0.0;
            let [there, back, own, drag] = gearbox.map_or([1.0, 1.0, 0.0, 0.0], |g| {
                [
                    1.0 / g.efficiency,
                    g.back_efficiency,
                    g.inertia,
                    g.no_load_torque,
                ]
            });
            let sign = if i.input_speed == 0.0 {
                0.0
            } else {
                i.input_speed.signum()
            };
            i.input_torque / ratio * if drives { there } else { back }
                + (8e-4 + own) * ratio * i.input_alpha
                + 4e-3 * ratio * i.input_speed
                + (0.3 + drag) * sign
        };
        let speed = |i: &Instant| ratio * i.input_speed;
        let power = |i: &Instant| torque(i) * speed(i);
        let own = gearbox.map_or(0.0, |g| g.inertia) / 8e-4;
        let load = |i: &Instant| own + i.input_inertia / (ratio * ratio * 8e-4);
        for (what, found, expected) in [
            ("torque", found.torque, duty.figures(torque)),
            ("speed", found.speed, duty.figures(speed)),
            ("power", found.power, duty.figures(power)),
            ("inertia ratio", found.inertia_ratio, duty.figures(load)),
        ] {
            let size = expected.max.abs().max(expected.min.abs());
            for (found, expected) in [
                (found.min, expected.min),
                (found.mean, expected.mean),
                (found.max, expected.max),
                (found.rms, expected.rms),
            ] {
                within(what, found, expected, budget::PREPARED_CYCLE * size);
            }
        }
        let mean_speed = duty.integral(|i| speed(i).abs()) / duty.duration;
        near(
            "mean |n|",
            found.mean_speed,
            mean_speed,
            budget::PREPARED_CYCLE,
        );
        let motoring = duty.integral(|i| power(i).max(0.0));
        near(
            "motoring",
            found.motoring_energy,
            motoring,
            budget::PREPARED_CYCLE,
        );
        let back = duty.integral(|i| (-power(i)).max(0.0));
        near(
            "regenerative",
            found.regenerative_energy,
            back,
            budget::PREPARED_CYCLE,
        );
        assert!(back > 0.0);
    }
}

/// Whether any power is regenerated, as by a loop over the samples, up to roundings.
#[test]
fn power_that_comes_back_is_known() {
    let seen = std::cell::Cell::new([0; 2]);
    let check = |(duty, c): (_, Coefficients)| {
        let cycle = Cycle::new(&duty);
        let along = cycle.samples().iter().map(|s| {
            let speed = s.speed();
            let sign = if speed == 0.0 { 0.0 } else { speed.signum() };
            c.torque(&s.loads()) * sign
        });
        let least = along.fold(f64::INFINITY, f64::min);
        let rounding = 1e-12 * brute::scale(&cycle, &c);
        if least.abs() > rounding {
            let expected = least < 0.0;
            assert_eq!(cycle.regenerates(&c), expected, "{least:e}");
            let mut counts = seen.get();
            counts[usize::from(expected)] += 1;
            seen.set(counts);
        }
        Ok(())
    };
    runner(1500).run(&(duty(), coefficients()), check).unwrap();
    // Friction that exceeds everything else except at one position of the press, and everywhere.
    let cycle = Cycle::new(&press());
    let with = |coulomb: f64| Coefficients([1e-3, 1.0, 1.0, 0.0, coulomb]);
    let least = |coulomb: f64| {
        let along = |s: &jred_sizing::cycle::LoadSample| {
            with(coulomb).torque(&s.loads()) * s.speed().signum()
        };
        let moving = cycle.samples().iter().filter(|s| s.speed() != 0.0);
        moving.map(along).fold(f64::INFINITY, f64::min)
    };
    let needed = -least(0.0);
    assert!(needed > 0.0);
    for k in 1..50 {
        let share = 0.04 * f64::from(k);
        assert_eq!(
            cycle.regenerates(&with(share * needed)),
            share < 1.0 - 1e-9,
            "{share}"
        );
    }
    assert!(
        seen.get().iter().all(|count| *count > 30),
        "{:?}",
        seen.get()
    );
}
