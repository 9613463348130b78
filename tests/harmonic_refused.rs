//! Refused harmonics, with the reason.

use jred::machine::PoseError;
use jred::number::{Bases, RangeError};
use std::f64::consts::TAU;

use crate::support::assert_near;
use crate::support::harmonics::{Waves, fitted, model, press, request, rubbing, terms_of};
use crate::support::machines::Wave;
use jred::error::Error;
use jred::harmonic::{HarmonicError, fit, scratch_len, terms};
use jred::machine::{Action, Load, Window};
use jred::mechanism::SliderCrank;
use jred::table::{Shape, Table, TableError};
use jred::{AnyModel, CurveSet, Domain, Harmonic, Phase, Scale, curves};

/// A load between all samples is evaluated at its edges.
#[test]
fn a_narrow_load_is_not_stepped_over() {
    let force = Load::new(SliderCrank::SLIDER, Action::Force([-100.0, 0.0])).unwrap();
    let window = Window::new(Domain::Turn, [5.0, 5.002], 0.0005).unwrap();
    let machine = press().with_load(force.within(window)).unwrap();
    let found = fitted::<f64, { curves::ALL | terms::ALL }>(&machine, &request(1e-3, 32));
    let Err(Error::Harmonic(HarmonicError::NotConverged { reached, .. })) = found else {
        panic!("{found:?}")
    };
    assert!((1.0..100.0).contains(&reached), "{reached}");
}

#[test]
fn kinks_and_hidden_harmonics_are_refused() {
    let constant = Load::new(SliderCrank::CRANK, Action::OpposingMoment(1.0)).unwrap();
    let force = Load::new(SliderCrank::SLIDER, Action::Force([-100.0, 0.0])).unwrap();
    let pressing = force.within(Window::new(Domain::Turn, [5.0, 6.0], 0.01).unwrap());
    for machine in [
        // Friction that falls to a minimum above zero at both dead centres.
        rubbing().with_load(constant).unwrap(),
        press().with_load(pressing).unwrap(),
    ] {
        for max in [8, 32, 256] {
            let found = fitted::<f64, { curves::ALL | terms::ALL }>(&machine, &request(1e-3, max));
            let Err(error) = found else {
                panic!("{found:?}")
            };
            let Error::Harmonic(HarmonicError::NotConverged { asked, reached, .. }) = error else {
                panic!("{error:?}")
            };
            assert_near("asked", asked, 1e-3, 0.0);
            assert!(reached > 1e-3 && reached < 100.0, "{max}: {reached}");
            assert!(
                error.cure().to_string().contains("needs a table"),
                "{error}"
            );
        }
    }
    // Harmonics that 32 samples, or 64 with their checks, alias with others.
    for order in [31, 32, 33, 63, 64, 128, 256] {
        let mut waves = Waves {
            inertia: vec![[0.0; 2]; order + 1],
            load: vec![[1.0, 0.0]],
            viscous: 0.0,
            coulomb: 0.0,
        };
        waves.inertia[0] = [1.0, 0.0];
        waves.inertia[order] = [1e-3, 0.0];
        let found = fitted::<f64, { curves::LOAD | terms::GENERAL }>(&waves, &request(1e-3, 8));
        assert!(
            matches!(
                found,
                Err(Error::Harmonic(HarmonicError::NotConverged { .. }))
            ),
            "{order}: {found:?}"
        );
        if order <= 128 {
            let (found, _) =
                fitted::<f64, { curves::LOAD | terms::GENERAL }>(&waves, &request(1e-3, 256))
                    .unwrap();
            assert_eq!(found.harmonics as usize, order);
        }
    }
    // Below the resolution of f64: the message names the reached error.
    let found = fitted::<f64, { curves::LOAD | terms::GENERAL }>(&press(), &request(1e-20, 16));
    assert!(
        matches!(found, Err(Error::Harmonic(HarmonicError::NotConverged { reached, .. })) if reached < 1e-9),
        "{found:?}"
    );
}

#[test]
fn bad_requests_are_named() {
    let machine = press();
    let stroke = Wave {
        domain: Domain::stroke(0.0, 1.0).unwrap(),
        ..Wave::bare(1.0, 0.1)
    };
    let error = fitted::<f64, { terms::INERTIA_COS }>(&stroke, &request(1e-3, 8)).unwrap_err();
    assert_eq!(error, Error::Harmonic(HarmonicError::Stroke));
    assert!(error.cure().to_string().contains("use a table"));
    assert_eq!(terms_of(&stroke, curves::ALL).unwrap_err(), error);
    for (bad, what) in [
        (request(0.0, 8), "torque error"),
        (request(1.0, 8).with_max_speed(-1.0), "largest speed"),
        (
            request(1.0, 8).with_max_acceleration(0.0),
            "largest acceleration",
        ),
    ] {
        let error = fitted::<f64, { terms::INERTIA_COS }>(&machine, &bad).unwrap_err();
        assert!(
            matches!(error, Error::Range(RangeError::NotPositive(name, _)) if name == what),
            "{error:?}"
        );
    }
    let nan = request(1.0, 8).with_max_acceleration(f64::NAN);
    assert_eq!(
        fitted::<f64, { terms::INERTIA_COS }>(&machine, &nan).unwrap_err(),
        Error::Range(RangeError::NotFinite("largest acceleration"))
    );
    let many = fitted::<f64, { terms::INERTIA_COS }>(&machine, &request(1.0, 257)).unwrap_err();
    assert!(
        matches!(
            many,
            Error::Range(RangeError::OutOfRange {
                what: "most harmonics",
                ..
            })
        ),
        "{many:?}"
    );
    let (mut scratch, mut words) = (vec![0.0; scratch_len(8)], vec![0.0; 9]);
    let short = |scratch: &mut [f64], words: &mut [f64]| {
        fit(
            &machine,
            terms::INERTIA_COS,
            &request(1.0, 8),
            scratch,
            words,
        )
        .unwrap_err()
    };
    let needed = scratch_len(8);
    assert_eq!(
        short(&mut scratch[1..], &mut words),
        Error::Range(RangeError::BufferTooShort {
            needed,
            given: needed - 1
        })
    );
    assert_eq!(
        short(&mut scratch, &mut words[1..]),
        Error::Range(RangeError::BufferTooShort {
            needed: 9,
            given: 8
        })
    );
    // J negative in a part of the turn.
    let negative =
        fitted::<f64, { terms::INERTIA_COS }>(&Wave::bare(1.0, 1.1), &request(1.0, 8)).unwrap_err();
    assert!(
        matches!(negative, Error::Pose(PoseError::NoInertia { phi }) if (phi - TAU / 2.0).abs() < 0.5)
            && negative.to_string().contains("rad, or m of a stroke"),
        "{negative:?}"
    );
    // Negative between the 32 samples only: J is 1.2 at all of them.
    let mut waves = Waves {
        inertia: vec![[0.0; 2]; 33],
        load: vec![[1.0, 0.0]],
        viscous: 0.0,
        coulomb: 0.0,
    };
    (waves.inertia[0], waves.inertia[32]) = ([0.1, 0.0], [1.1, 0.0]);
    let between =
        fitted::<f64, { curves::LOAD | terms::GENERAL }>(&waves, &request(1.0, 64)).unwrap_err();
    assert!(
        matches!(between, Error::Pose(PoseError::NoInertia { .. })),
        "{between:?}"
    );
}

#[test]
fn bad_coefficients_are_named() {
    fn check<const SET: CurveSet>(words: &[f32]) -> Option<TableError> {
        model::<f32, SET>(words).err()
    }
    const LOADED: CurveSet = curves::LOAD | terms::SYMMETRIC;
    let length = |needed, given| Some(TableError::Length { needed, given });
    assert_eq!(check::<LOADED>(&[]), length(2, 0));
    assert_eq!(check::<LOADED>(&[1.0, 0.0, 0.1]), length(2, 3));
    assert_eq!(check::<0>(&[1.0, 0.0]), length(1, 2));
    assert_eq!(
        check::<{ terms::INERTIA_COS }>(&[1.0; 258]),
        Some(TableError::Cells(257))
    );
    // 1/J is for fixed point.
    assert_eq!(check::<8>(&[1.0]), Some(TableError::Curves(8)));
    // Harmonics need a full turn.
    let stroke = Shape::<Harmonic<f32>> {
        domain: Domain::Stroke { from: 0.0, to: 1.0 },
        ..Shape::harmonics(0, 0)
    };
    let refused = Table::new(&[1.0], stroke).map(|_| ());
    assert_eq!(refused, Err(TableError::Stroke));
    for bad in [f32::NAN, f32::INFINITY, -1e30] {
        assert_eq!(
            check::<{ terms::INERTIA_COS }>(&[1.0, 0.1, bad]),
            Some(TableError::Range { curve: 0, cell: 2 })
        );
    }
    // Each number is finite, but with this torque base their products are not: inf · 0 at standstill.
    let bases = Bases {
        torque: 1e-38,
        speed: 1.0,
        inertia: 1.0,
    };
    let shape = Shape::<Harmonic<f32>> {
        scale: Scale::new(bases).unwrap(),
        ..Shape::harmonics(1, terms::INERTIA_COS)
    };
    let table = Table::new(&[10.0, 9.0], shape).unwrap();
    assert_eq!(
        AnyModel::new(table).map(|_| ()),
        Err(TableError::TorqueRange { cell: 0 })
    );
    let at = |bits| {
        Some(TableError::NoInertiaAt {
            phase: Phase::from_bits(bits),
        })
    };
    assert_eq!(check::<0>(&[0.0]), at(0));
    assert_eq!(
        check::<{ terms::INERTIA_COS }>(&[1.0, 1.5]),
        at(0x6000_0000)
    );
    // 2.2 at the first 64 evaluated positions, −0.2 half-way between them.
    let mut hidden = [0.0f32; 65];
    (hidden[0], hidden[64]) = (1.0, 1.2);
    assert_eq!(check::<{ terms::INERTIA_COS }>(&hidden), at(1 << 25));
    // Zero in theory at φ = 0, and at π/3 between all evaluated positions.
    let close = check::<{ terms::INERTIA_COS }>(&[1.0, -0.999_999_9]);
    assert_eq!(
        close,
        Some(TableError::InertiaNotShown {
            phase: Phase::default()
        })
    );
    let message = check::<{ terms::INERTIA_COS }>(&hidden)
        .unwrap()
        .to_string();
    assert!(message.contains("φ = 2.81°"), "{message}");
    // J down to a thousandth of its mean is accepted.
    assert_eq!(check::<{ terms::INERTIA_COS }>(&[1.0, -0.999]), None);
}
