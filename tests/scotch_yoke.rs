//! The Scotch yoke: its formula, its joints, its forces.

use jred::machine::PoseError;
use jred::mechanism::{BuildError, ScotchYokeDimensions};
use jred::number::RangeError;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::support::{assert_near, budget, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::ScotchYoke;
use proptest::prelude::*;

fn massless() -> [Link; 2] {
    [0.0, 0.0].map(|inertia| Link::rotor(inertia).unwrap())
}

#[test]
fn yoke_is_a_harmonic_motion() {
    let r = 0.07;
    for degrees in [90.0_f64, 60.0, 135.0, 20.0] {
        let beta = degrees.to_radians();
        let yoke = ScotchYoke::new(
            ScotchYokeDimensions {
                crank: r,
                slot_angle: beta,
            },
            massless(),
        )
        .unwrap();
        let amplitude = r / beta.sin();
        assert_near(
            "stroke",
            yoke.stroke(),
            2.0 * amplitude,
            budget::CLOSED_FORM,
        );
        for k in 0..40 {
            let phi = -9.0 + 0.5 * f64::from(k);
            // x = A·sin(β − φ): derivatives −A·cos, −A·sin, A·cos.
            let (sin, cos) = (beta - phi).sin_cos();
            let x = yoke.frames(phi).unwrap()[ScotchYoke::YOKE].x;
            let size = budget::CLOSED_FORM * amplitude;
            assert_near("x", x.value, amplitude * sin, size);
            assert_near("x'", x.d1, -amplitude * cos, size);
            assert_near("x''", x.d2, -amplitude * sin, size);
            assert_near("x'''", x.d3, amplitude * cos, size);
        }
    }
}

#[test]
fn straight_yoke_is_the_textbook_one() {
    let (r, inertia, mass, force) = (0.07, 0.004, 3.0, 120.0);
    let links = [
        Link::rotor(inertia).unwrap(),
        link_of(mass, 0.0, [0.02, 0.05]),
    ];
    let load = Load::new(ScotchYoke::YOKE, Action::Force([force, 0.0])).unwrap();
    let machine = Machine::new(
        ScotchYoke::new(
            ScotchYokeDimensions {
                crank: r,
                slot_angle: FRAC_PI_2,
            },
            links,
        )
        .unwrap(),
    )
    .with_load(load)
    .unwrap();
    for k in 0..24 {
        let phi = TAU * f64::from(k) / 24.0;
        let (sin, cos) = phi.sin_cos();
        let reduced = machine.reduction(phi).unwrap();
        let size = budget::CLOSED_FORM * (inertia + mass * r * r);
        let moving = mass * r * r;
        assert_near("J", reduced.inertia, inertia + moving * sin * sin, size);
        assert_near("J'", reduced.inertia_slope, 2.0 * moving * sin * cos, size);
        assert_near(
            "J''",
            reduced.inertia_curvature,
            2.0 * moving * (2.0 * phi).cos(),
            size,
        );
        assert_near(
            "T",
            reduced.process,
            -force * r * sin,
            budget::CLOSED_FORM * force * r,
        );

        // At constant speed the slot pushes the yoke with m·ẍ − F, along x only: the slot has no friction.
        let omega = 11.0;
        let forces = machine.forces(phi, omega, 0.0).unwrap();
        let push = -mass * r * omega * omega * cos - force;
        let size = budget::REACTIONS * (mass * r * omega * omega + force);
        assert_near("slot", forces.reactions[1].force[0], push, size);
        assert_near("slot y", forces.reactions[1].force[1], 0.0, size);
        assert_near("guide", forces.reactions[2].force[1], 0.0, size);
        // The guide's moment balances the pin's and the inertia force's moments: Σ M about the yoke's origin.
        let inertia_force = -mass * (-r * omega * omega * cos);
        let moment = push * r * sin + 0.05 * inertia_force;
        assert_near("guide moment", forces.reactions[2].moment, moment, size);
    }
}

prop_compose! {
    pub(crate) fn machines()(
        r in 0.01..0.5,
        beta in 0.2..2.9,
        mass in [0.1..5.0, 0.1..5.0],
        com in [-0.5..1.0, -0.3..0.3, -1.0..1.0, -1.0..1.0],
        down in 0.0..6.2_f64,
        load in [-300.0..300.0, 0.0..100.0, 0.0..20.0],
    ) -> Machine<ScotchYoke> {
        let [u1, v1, u2, v2] = com.map(|c: f64| c * r);
        let links = [
            link_of(mass[0], 0.2 * mass[0] * r * r, [u1, v1]),
            link_of(mass[1], 0.0, [u2, v2]),
        ];
        let on = |action| Load::new(ScotchYoke::YOKE, action).unwrap();
        Machine::new(ScotchYoke::new(ScotchYokeDimensions { crank: r, slot_angle: beta }, links).unwrap())
            .with_gravity([9.81 * down.cos(), 9.81 * down.sin()])
            .and_then(|m| m.with_flywheel(0.1 * mass[1] * r * r))
            .and_then(|m| m.with_load(on(Action::Force([load[0], 0.3 * load[0]]))))
            .and_then(|m| m.with_load(on(Action::OpposingForce(load[1]))))
            .and_then(|m| m.with_load(on(Action::ViscousForce(load[2]))))
            .unwrap()
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let said = |crank, angle| {
        ScotchYoke::new(
            ScotchYokeDimensions {
                crank,
                slot_angle: angle,
            },
            massless(),
        )
        .unwrap_err()
        .to_string()
    };
    assert_eq!(
        said(-0.1, FRAC_PI_2),
        "crank length is -0.1, but must be greater than zero"
    );
    assert_eq!(said(f64::NAN, 1.0), "crank length is not a finite number");
    assert_eq!(
        said(0.1, f64::INFINITY),
        "slot angle is not a finite number"
    );
    let (min, max) = (ScotchYoke::FLATTEST, PI - ScotchYoke::FLATTEST);
    for angle in [0.0, 0.9 * min, max + 0.1 * min, PI, -FRAC_PI_2] {
        let error = ScotchYoke::new(
            ScotchYokeDimensions {
                crank: 0.1,
                slot_angle: angle,
            },
            massless(),
        )
        .unwrap_err();
        let what = "slot angle (rad, from the direction of motion)";
        assert_eq!(
            error,
            BuildError::Range(RangeError::OutOfRange {
                what,
                value: angle,
                min,
                max
            })
        );
    }
    let yoke = ScotchYoke::new(
        ScotchYokeDimensions {
            crank: 0.1,
            slot_angle: min,
        },
        massless(),
    )
    .unwrap();
    assert_eq!(
        yoke.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("crank angle"))
    );
}
