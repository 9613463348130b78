//! From a machine to its harmonics.

use std::f64::consts::TAU;

use crate::support::harmonics::{
    ALPHA, OMEGA, Waves, fitted, model, peak, phases, press, request, rubbing, terms_of, waves,
    words_of,
};
use crate::support::machines::{Wave, spec};
use crate::support::{assert_near, budget, config};
use jred::error::Error;
use jred::harmonic::{HarmonicError, measure, scratch_len, terms};
use jred::machine::{Action, Load, Reducible, Reduction};
use jred::mechanism::SliderCrank;
use jred::{CurveSet, Domain, Phase, curves};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config(48, 0x4a02))]

    #[test]
    fn a_series_comes_back(waves in waves()) {
        let asked = 1e-10 * peak(&waves);
        let (found, words) = fitted::<f64, { curves::ALL | terms::GENERAL }>(&waves, &request(asked, 32)).unwrap();
        prop_assert!(found.harmonics < waves.inertia.len() as u32, "{found:?}");
        let size = 10.0 * waves.load.len() as f64;
        let made = words_of(&waves);
        for (found, made) in words.iter().zip(&made) {
            assert_near("coefficient", *found, *made, budget::COEFFICIENT * size);
        }
        // The dropped terms are within the requested error.
        let left: f64 = made.iter().skip(words.len()).map(|x| x.abs()).sum();
        prop_assert!(left <= asked);
    }

    /// The bound is valid on a grid without samples, and exceeds the observed error by a limited factor.
    #[test]
    fn the_bound_holds_everywhere(spec in spec(), exponent in 2f64..9.0) {
        let machine = spec.heavy();
        let asked = peak(&machine) * 10f64.powf(-exponent);
        let request = request(asked, 64);
        let (found, words) = fitted::<f64, { curves::LOAD | terms::GENERAL }>(&machine, &request).unwrap();
        prop_assert!(found.bound <= asked && found.torque_error <= asked);
        let model = model::<f64, { curves::LOAD | terms::GENERAL }>(&words).unwrap();
        let (dense, _) = measure(&machine, model.table(), &request, 4001).unwrap();
        prop_assert!(dense <= found.bound, "{dense:e} {found:?}");
        prop_assert!(dense >= found.bound * budget::HARMONIC_BOUND_SLACK, "{dense:e} {found:?}");
        // One harmonic less is not sufficient.
        if found.harmonics > 0 {
            let fewer = request.with_max_cells(found.harmonics - 1);
            let missed = fitted::<f64, { curves::LOAD | terms::GENERAL }>(&machine, &fewer);
            prop_assert!(matches!(missed, Err(Error::Harmonic(HarmonicError::NotConverged { .. }))), "{missed:?}");
        }
    }

    /// J, J′ and load of a machine, from the coefficients.
    #[test]
    fn slope_is_that_of_the_machine(spec in spec(), bits: u32) {
        let machine = spec.heavy();
        let asked = 1e-10 * peak(&machine);
        let (_, words) = fitted::<f64, { curves::LOAD | terms::GENERAL }>(&machine, &request(asked, 128)).unwrap();
        let model = model::<f64, { curves::LOAD | terms::GENERAL }>(&words).unwrap();
        let phase = Phase::from_bits(bits);
        let (read, exact) = (model.table().at(phase), machine.reduction(phase.radians()).unwrap());
        let torque = peak(&machine);
        assert_near("J", read.inertia, exact.inertia, budget::HARMONIC_CURVE * torque / ALPHA);
        assert_near("J'", read.inertia_slope, exact.inertia_slope, budget::HARMONIC_CURVE * 2.0 * torque / (OMEGA * OMEGA));
        assert_near("load", read.load, exact.load_torque(), budget::HARMONIC_CURVE * torque);
    }
}

/// The example press to 1e-6 of its peak torque in 200 bytes, half of it with its symmetry.
#[test]
fn the_press_fits_in_200_bytes() {
    let machine = press();
    assert_eq!(terms_of(&machine, curves::ALL).unwrap(), terms::SYMMETRIC);
    let asked = 1e-6 * peak(&machine);
    let (half, words) =
        fitted::<f32, { curves::LOAD | terms::SYMMETRIC }>(&machine, &request(asked, 16)).unwrap();
    println!("press, f32, symmetric: {half:?} of {:e}", peak(&machine));
    assert!(
        half.bytes <= 100 && half.bytes == 4 * words.len(),
        "{half:?}"
    );
    let (whole, _) =
        fitted::<f32, { curves::LOAD | terms::GENERAL }>(&machine, &request(asked, 16)).unwrap();
    println!("press, f32, general: {whole:?}");
    assert!(whole.bytes <= 200, "{whole:?}");
    let model = model::<f32, { curves::LOAD | terms::SYMMETRIC }>(&words).unwrap();
    for phase in phases(5000) {
        let exact = machine.reduction(phase.radians()).unwrap();
        for (omega, alpha) in [
            (OMEGA, ALPHA),
            (-OMEGA, ALPHA),
            (OMEGA, -ALPHA),
            (0.0, ALPHA),
        ] {
            let torque = model.torque(phase, omega as f32, alpha as f32);
            assert_near(
                "torque",
                f64::from(torque),
                exact.torque(omega, alpha).total(),
                asked,
            );
        }
    }
    for exponent in 3..=9 {
        let asked = peak(&machine) * 10f64.powi(-exponent);
        let (double, _) =
            fitted::<f64, { curves::LOAD | terms::SYMMETRIC }>(&machine, &request(asked, 16))
                .unwrap();
        let single =
            fitted::<f32, { curves::LOAD | terms::SYMMETRIC }>(&machine, &request(asked, 16))
                .map(|f| f.0);
        println!(
            "1e-{exponent}: {} harmonics, {} words, f32 {:?}",
            double.harmonics,
            double.words,
            single.map(|f| f.harmonics)
        );
        assert_eq!(
            double.harmonics,
            budget::PRESS_HARMONICS[exponent as usize - 3],
            "{double:?}"
        );
    }
}

#[test]
fn constant_curves_cost_one_number() {
    let load = |action| Load::new(SliderCrank::CRANK, action).unwrap();
    let machine = press()
        .with_load(load(Action::OpposingMoment(2.0)))
        .and_then(|m| m.with_load(load(Action::ViscousMoment(0.1))))
        .unwrap();
    assert_eq!(terms_of(&machine, curves::ALL).unwrap(), terms::SYMMETRIC);
    let asked = 1e-6 * peak(&machine);
    let (found, words) =
        fitted::<f64, { curves::ALL | terms::SYMMETRIC }>(&machine, &request(asked, 16)).unwrap();
    assert_eq!(found.words, 4 + 2 * found.harmonics as usize);
    assert_near("b", words[2], 0.1, budget::COEFFICIENT);
    assert_near("c", words[3], 2.0, budget::COEFFICIENT);
    // A machine of constant J has one number, and no harmonics.
    let turntable = Wave {
        load: 0.0,
        ..Wave::bare(0.3, 0.0)
    };
    let (found, words) = fitted::<f32, { curves::INERTIA }>(&turntable, &request(1e-3, 8)).unwrap();
    assert_eq!(
        (found.harmonics, words.as_slice()),
        (0, [0.3f32].as_slice())
    );
    let model = model::<f32, { curves::INERTIA }>(&words).unwrap();
    assert_eq!(
        (
            model.table().cells(),
            model.torque(Phase::from_bits(7), 5.0, 2.0)
        ),
        (0, 0.6)
    );
}

#[test]
fn terms_are_told_from_the_curves() {
    let on = |j, load| Waves {
        inertia: vec![[1.0, 0.0], j],
        load: vec![[2.0, 0.0], load],
        viscous: 0.1,
        coulomb: 0.0,
    };
    for (j, load, expected) in [
        ([0.1, 0.0], [0.0, 1.0], terms::SYMMETRIC),
        ([0.0, 0.1], [1.0, 0.0], terms::INERTIA_SIN | terms::LOAD_COS),
        ([0.1, 0.1], [1.0, 1.0], terms::GENERAL),
        ([0.0, 0.0], [0.0, 0.0], 0),
    ] {
        assert_eq!(terms_of(&on(j, load), curves::ALL).unwrap(), expected);
    }
    // Neglected terms count as error.
    let sine = on([0.0, 0.1], [0.0, 0.0]);
    let missed = fitted::<f64, { curves::ALL | terms::INERTIA_COS }>(&sine, &request(1e-3, 8));
    let Err(Error::Harmonic(HarmonicError::NotConverged { reached, .. })) = missed else {
        panic!("{missed:?}");
    };
    // 0.1·√(α² + (ω²/2)²) or, as the bound adds sizes, up to 0.1·(α + ω²/2)
    assert!(
        (0.05 * OMEGA * OMEGA..=0.05 * OMEGA * OMEGA + 0.1 * ALPHA).contains(&reached),
        "{reached}"
    );
    // So does a curve outside the set.
    let missed = fitted::<f64, { curves::LOAD | terms::GENERAL }>(&sine, &request(1e-3, 8));
    assert!(
        matches!(missed, Err(Error::Harmonic(HarmonicError::NotConverged { reached, .. })) if (reached - 0.1 * OMEGA).abs() < 1e-3),
        "{missed:?}"
    );
}

/// J = 1, load |sin (φ − from)|³: its third derivative jumps at `from`, and its coefficients fall like 1/k⁴.
struct SlowFall {
    from: f64,
}

impl Reducible for SlowFall {
    fn domain(&self) -> Domain {
        Domain::Turn
    }
    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        Ok(Reduction::new([1.0, 0.0, 0.0]).with_process((phi - self.from).sin().abs().powi(3)))
    }
}

/// Half-way between two samples all neglected terms add up, and those beyond them do not show in the samples.
#[test]
fn what_no_sample_shows_is_in_the_bound() {
    for samples in [32, 64, 128, 256] {
        let machine = SlowFall {
            from: TAU / f64::from(2 * samples),
        };
        for step in 0..30 {
            let asked = 1e-2 * 0.8f64.powi(step);
            let (found, words) =
                fitted::<f64, { curves::LOAD | terms::GENERAL }>(&machine, &request(asked, 64))
                    .unwrap();
            let model = model::<f64, { curves::LOAD | terms::GENERAL }>(&words).unwrap();
            let (dense, _) = measure(&machine, model.table(), &request(asked, 0), 4096).unwrap();
            assert!(
                dense <= found.bound && found.bound <= asked,
                "{dense:e} {found:?}"
            );
        }
    }
}

/// F·|x′| has kinks at the dead centres, F·x′ has none; an additional constant friction has a number of its own.
#[test]
fn friction_of_the_ram_is_smooth() {
    const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_COULOMB;
    const TERMS: CurveSet = terms::SYMMETRIC | terms::COULOMB_SIN;
    for constant in [0.0, 2.0] {
        let load = Load::new(SliderCrank::CRANK, Action::OpposingMoment(constant)).unwrap();
        let machine = rubbing().with_load(load).unwrap();
        assert_eq!(terms_of(&machine, SET).unwrap(), TERMS);
        let asked = 1e-9 * peak(&machine);
        let (found, words) = fitted::<f64, { SET | TERMS }>(&machine, &request(asked, 16)).unwrap();
        assert!(found.harmonics <= 12, "{found:?}");
        assert_near("constant", words[3], constant, budget::COEFFICIENT);
        let model = model::<f64, { SET | TERMS }>(&words).unwrap();
        for phase in phases(1000) {
            let exact = machine.reduction(phase.radians()).unwrap();
            for omega in [-OMEGA, 0.0, OMEGA] {
                let torque = model.torque(phase, omega, ALPHA);
                assert_near("torque", torque, exact.torque(omega, ALPHA).total(), asked);
            }
        }
    }
}

/// Parts of the machine outside the set count as error, and are not terms.
#[test]
fn terms_are_those_of_the_set() {
    let waves = Waves {
        inertia: vec![[1.0, 0.0], [0.2, 0.0]],
        load: vec![[3.0, 0.0], [0.0, 0.5]],
        viscous: 0.1,
        coulomb: 2.0,
    };
    let all = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    for set in [0, curves::LOAD, curves::CONSTANT_COULOMB, all] {
        let load = if set & curves::LOAD == 0 {
            0
        } else {
            terms::LOAD_SIN
        };
        assert_eq!(terms_of(&waves, set), Ok(terms::INERTIA_COS | load));
    }
}

/// A constant curve has no harmonics, not the roundings of its mean.
#[test]
fn a_constant_has_no_harmonics() {
    const SET: CurveSet = curves::LOAD | terms::GENERAL;
    let waves = Waves {
        inertia: vec![[1.0, 0.0], [0.2, 0.1]],
        load: vec![[0.1, 0.0]],
        viscous: 0.0,
        coulomb: 0.0,
    };
    let (found, words) = fitted::<f64, SET>(&waves, &request(1e-9, 8)).unwrap();
    assert_eq!(found.harmonics, 1);
    assert_near("mean", words[1], 0.1, 1e-16);
    assert!(words[4..].iter().all(|word| word.abs() == 0.0), "{words:?}");
}

/// As documented.
#[test]
fn scratch_grows_with_the_harmonics() {
    for harmonics in 0..=8 {
        assert_eq!(scratch_len(harmonics), 576);
    }
    for harmonics in [16, 32, 64, 128] {
        assert_eq!(scratch_len(harmonics), 72 * harmonics as usize);
        assert_eq!(scratch_len(harmonics + 1), 144 * harmonics as usize);
    }
}
