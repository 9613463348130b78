//! Harmonics from measurements.

use jred::machine::{Link, Machine, MassProperties, Reducible};
use jred::mechanism::SliderCrankDimensions;
use jred::number::RangeError;
use std::f64::consts::TAU;

use crate::support::harmonics::model;
use crate::support::{assert_near, budget, config, largest};
use jred::error::Error;
use jred::harmonic::{
    Coefficient, Curve, HarmonicError, Identification, Identified, Kind, Sample, fit, identify,
    scratch_len, terms,
};
use jred::mechanism::{Branch, SliderCrank};
use jred::table::{Shape, Table, TableError, words_len};
use jred::tabulate::Request;
use jred::{AnyModel, CurveSet, Harmonic, Phase, curves};
use proptest::prelude::*;

const SET: CurveSet = curves::ALL;
/// Ten harmonics of J and load, a viscous and a Coulomb constant.
const WORDS: usize = 24;
const TERMS: CurveSet = terms::SYMMETRIC;

/// A press whose weight acts along the guide.
fn press() -> Machine<SliderCrank> {
    let links = [
        Link::new(MassProperties {
            mass: 9.0,
            inertia: 0.018,
            com: [0.006, 0.0],
        }),
        Link::new(MassProperties {
            mass: 6.5,
            inertia: 0.03,
            com: [0.04, 0.0],
        }),
        Link::point_mass(42.0),
    ]
    .map(Result::unwrap);
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.03,
            rod: 0.12,
            offset: 0.0,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    Machine::new(mechanism)
        .with_gravity([9.81, 0.0])
        .and_then(|m| m.with_flywheel(0.05))
        .unwrap()
}

/// Its harmonics, with b = 0.2 N·m·s/rad and c = 3 N·m.
fn truth() -> [f64; WORDS] {
    let request = Request::new(1e-6)
        .with_max_speed(15.0)
        .with_max_acceleration(200.0)
        .with_max_cells(10);
    let mut scratch = vec![0.0; scratch_len(10)];
    let mut words = [0.0; WORDS];
    let found = fit(&press(), SET | TERMS, &request, &mut scratch, &mut words).unwrap();
    assert!(found.harmonics >= 6, "{found:?}");
    words[found.words..].fill(0.0);
    (words[2], words[3]) = (0.2, 3.0);
    words
}

/// A motion through all phases in both directions, with accelerations: time in steps of 2 ms.
fn motion(k: u32) -> (Phase, f64, f64) {
    let t = 0.002 * f64::from(k);
    let phi = 6.0 * (1.3 * t).sin() + 0.8 * (7.1 * t).sin() + 0.4 * t;
    let omega = 7.8 * (1.3 * t).cos() + 5.68 * (7.1 * t).cos() + 0.4;
    let alpha = -10.14 * (1.3 * t).sin() - 40.328 * (7.1 * t).sin();
    (Phase::from_radians(phi), omega, alpha)
}

fn samples(count: u32, torque: impl Fn(Phase, f64, f64) -> f64) -> Vec<Sample> {
    let sample = |(phase, omega, alpha)| Sample {
        phase,
        omega,
        alpha,
        torque: torque(phase, omega, alpha),
    };
    (0..count).map(|k| sample(motion(k))).collect()
}

fn from_truth(count: u32) -> Vec<Sample> {
    let words = truth();
    let model = model::<f64, { SET | TERMS }>(&words).unwrap();
    samples(count, |phase, omega, alpha| {
        model.torque(phase, omega, alpha)
    })
}

fn found(samples: &[Sample]) -> Result<Identified<WORDS>, Error> {
    identify::<WORDS, { SET | TERMS }>(samples)
}

#[test]
fn without_noise_it_is_exact() {
    let truth = truth();
    let samples = from_truth(3000);
    let found = found(&samples).unwrap();
    let size = largest(truth);
    let errors = found
        .words
        .iter()
        .zip(truth)
        .map(|(found, made)| found - made);
    println!(
        "exact: {:e}, condition {}",
        largest(errors.clone()),
        found.condition
    );
    assert!(largest(errors) <= budget::IDENTIFIED * size * found.condition);
    assert!(found.residual <= budget::IDENTIFIED * largest(samples.iter().map(|s| s.torque)));
    assert!(
        found.condition >= 1.0 && found.condition < 100.0,
        "{}",
        found.condition
    );
    assert!(
        found
            .excitation
            .iter()
            .all(|x| *x > 1e-2 && *x <= 1.0 + 1e-12),
        "{found:?}"
    );
    assert_eq!(found.samples, 3000);
}

/// The machine itself with added friction: the residual is the effect of its higher harmonics, and J is that of the reduction.
#[test]
fn a_press_is_identified_from_its_motion() {
    let machine = press();
    let samples = samples(3000, |phase, omega, alpha| {
        let exact = machine.reduction(phase.radians()).unwrap();
        exact.torque(omega, alpha).total() + 0.2 * omega + 3.0 * omega.signum()
    });
    let found = found(&samples).unwrap();
    let model = model::<f64, { SET | TERMS }>(&found.words).unwrap();
    let size = largest((0..360).map(|k| {
        machine
            .reduction(TAU * f64::from(k) / 360.0)
            .unwrap()
            .inertia
    }));
    for k in 0..360 {
        let phi = TAU * f64::from(k) / 360.0;
        let read = model.table().at(Phase::from_radians(phi));
        let exact = machine.reduction(phi).unwrap();
        assert_near(
            "J",
            read.inertia,
            exact.inertia,
            budget::IDENTIFIED_INERTIA * size,
        );
    }
    assert_near("b", found.words[2], 0.2, budget::IDENTIFIED_INERTIA);
    assert_near("c", found.words[3], 3.0, budget::IDENTIFIED_INERTIA);
}

/// Errors of the coefficients over their standard errors, in many experiments: mean square 1, none above 5, no bias.
#[test]
fn with_noise_it_is_within_its_standard_error() {
    let truth = truth();
    let clean = from_truth(1000);
    // Irwin-Hall: the sum of twelve uniform numbers has variance one.
    let uniform = prop::array::uniform12(-0.5f64..0.5);
    let noise = crate::support::samples(40 * 1000, 0x4b01, &uniform);
    let sigma = 0.5;
    let mut ratios = Vec::new();
    for noise in noise.chunks(1000) {
        let noisy = |(s, noise): (&Sample, &[f64; 12])| {
            let torque = s.torque + sigma * noise.iter().sum::<f64>();
            Sample { torque, ..*s }
        };
        let noisy: Vec<_> = clean.iter().zip(noise).map(noisy).collect();
        let found = found(&noisy).unwrap();
        // 976 degrees of freedom: the standard deviation is known to 1/√(2·976) = 2.3 %.
        assert_near("residual", found.residual, sigma, 5.0 * 0.023 * sigma);
        ratios.extend((0..WORDS).map(|i| (found.words[i] - truth[i]) / found.standard_error[i]));
    }
    let count = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let square = ratios.iter().map(|r| r * r).sum::<f64>() / count;
    println!(
        "noise: largest {}, mean {mean}, mean square {square}",
        largest(ratios.clone())
    );
    assert!(largest(ratios) < 5.0);
    // Coefficients of one experiment are correlated: five standard deviations of a quarter of the number.
    assert_near("mean", mean, 0.0, 5.0 / (count / 4.0).sqrt());
    assert_near(
        "mean square",
        square,
        1.0,
        5.0 * (2.0 / (count / 4.0)).sqrt(),
    );
}

fn not_excited(samples: &[Sample]) -> (Coefficient, Option<Coefficient>) {
    match found(samples) {
        Err(Error::Harmonic(HarmonicError::NotExcited { coefficient, like })) => {
            (coefficient, like)
        }
        other => panic!("{other:?}"),
    }
}

const MEAN_INERTIA: Coefficient = Coefficient {
    curve: Curve::Inertia,
    kind: Kind::Mean,
};

#[test]
fn what_the_samples_do_not_tell_is_named() {
    let all = from_truth(4000);
    // One direction: c·sgn ω is a constant, like the mean of the load.
    let forward: Vec<_> = all.iter().copied().filter(|s| s.omega > 0.0).collect();
    let (a, b) = not_excited(&forward);
    let mut pair = [a.to_string(), b.unwrap().to_string()];
    pair.sort();
    assert_eq!(
        pair,
        ["the mean of the Coulomb friction", "the mean of the load"]
    );
    // No acceleration: the mean of J has no effect.
    let steady: Vec<_> = all.iter().map(|s| Sample { alpha: 0.0, ..*s }).collect();
    assert_eq!(not_excited(&steady), (MEAN_INERTIA, None));
    let message = found(&steady).unwrap_err().to_string();
    assert!(
        message.contains("do not depend on the mean of J"),
        "{message}"
    );
    // Always at the same position: cosines are multiples of each other.
    let still: Vec<_> = all
        .iter()
        .map(|s| Sample {
            phase: Phase::from_bits(1 << 28),
            ..*s
        })
        .collect();
    assert!(not_excited(&still).1.is_some());
    // A sixth of a turn only: harmonics are hard to distinguish, and the error names them.
    let part: Vec<_> = all
        .iter()
        .map(|s| Sample {
            phase: Phase::from_bits(s.phase.to_bits() / 6),
            ..*s
        })
        .collect();
    assert!(matches!(
        not_excited(&part).0.kind,
        Kind::Cosine(_) | Kind::Sine(_)
    ));
}

/// A single speed and acceleration: J·α and b·ω are exactly proportional.
#[test]
fn coefficients_that_are_alike_are_both_named() {
    let sample = Sample {
        phase: Phase::default(),
        omega: 2.0,
        alpha: 2.0,
        torque: 1.0,
    };
    let found = identify::<2, { curves::INERTIA | curves::VISCOUS }>(&[sample; 5]);
    let Err(Error::Harmonic(HarmonicError::NotExcited { coefficient, like })) = found else {
        panic!("{found:?}")
    };
    let mut both = [coefficient.curve, like.unwrap().curve].map(|curve| curve as u8);
    both.sort_unstable();
    assert_eq!(both, [Curve::Inertia as u8, Curve::Viscous as u8]);
    // Next to them the mean of the load, which samples at rest determine.
    let moves = |omega| Sample {
        omega,
        alpha: omega,
        ..sample
    };
    let samples = [2.0, -2.0, 0.0, 0.0].map(moves);
    let found = identify::<3, { curves::INERTIA | curves::LOAD | curves::VISCOUS }>(&samples);
    let Err(Error::Harmonic(HarmonicError::NotExcited { coefficient, like })) = found else {
        panic!("{found:?}")
    };
    let both = [coefficient.curve, like.unwrap().curve];
    assert!(
        both.contains(&Curve::Inertia) && both.contains(&Curve::Viscous),
        "{both:?}"
    );
    // A second acceleration separates them: T = 3·α + 0.5·ω.
    let truth = [(2.0, 2.0), (2.0, -1.0), (1.0, 4.0)].map(|(omega, alpha)| Sample {
        omega,
        alpha,
        torque: 3.0 * alpha + 0.5 * omega,
        ..sample
    });
    let found = identify::<2, { curves::INERTIA | curves::VISCOUS }>(&truth).unwrap();
    assert_near("J", found.words[0], 3.0, 1e-12);
    assert_near("b", found.words[1], 0.5, 1e-12);
}

#[test]
fn bad_samples_are_named() {
    // Far enough apart to cover all phases.
    let all: Vec<_> = from_truth(160 * (WORDS as u32 + 1))
        .into_iter()
        .step_by(160)
        .collect();
    let few = found(&all[..WORDS]).unwrap_err();
    let needed = WORDS as u32 + 1;
    assert_eq!(
        few,
        HarmonicError::TooFewSamples {
            needed,
            given: needed - 1
        }
        .into()
    );
    assert!(found(&all).is_ok());
    let mut kept = Identification::<WORDS, { SET | TERMS }>::new().unwrap();
    for (bad, what) in [
        (
            Sample {
                omega: f64::NAN,
                ..all[3]
            },
            "measured speed",
        ),
        (
            Sample {
                alpha: f64::INFINITY,
                ..all[3]
            },
            "measured acceleration",
        ),
        (
            Sample {
                torque: f64::NAN,
                ..all[3]
            },
            "measured torque",
        ),
    ] {
        assert_eq!(kept.add(&bad), Err(RangeError::NotFinite(what).into()));
    }
    // They had no effect.
    for sample in &all {
        kept.add(sample).unwrap();
    }
    assert_eq!(kept.solve(), found(&all));
    let length = Identification::<23, { SET | TERMS }>::new().unwrap_err();
    let expected = TableError::Length {
        needed: 22,
        given: 23,
    };
    assert_eq!(length, Error::Table(expected));
}

proptest! {
    #![proptest_config(config(256, 0x4b02))]

    /// Words and their names are in the order in which the tick reads them: ∂T/∂word by differences.
    #[test]
    fn names_are_those_of_the_words(
        set in 0usize..10, word in 0usize..24, bits: u32, omega in 1f64..9.0, alpha in -50f64..50.0,
    ) {
        fn check<const SET: CurveSet>(word: usize, phase: Phase, omega: f64, alpha: f64) {
            const TERMS: CurveSet = terms::ALL & !terms::LOAD_COS;
            let harmonics = 3;
            let len = words_len::<Harmonic<f64>>(harmonics, SET | TERMS);
            assert!(Coefficient::of_word(len, SET | TERMS).is_some(), "of the next harmonic");
            let Some(name) = Coefficient::of_word(word, SET | TERMS).filter(|_| word < len) else { return };
            let mut words = vec![0.0; len];
            words[..=SET.count_ones() as usize].fill(20.0);
            let torque = |words: &[f64]| {
                let shape = Shape::<Harmonic<f64>>::harmonics(harmonics, SET | TERMS);
                AnyModel::new(Table::new(words, shape).unwrap()).unwrap().torque(phase, omega, alpha)
            };
            let before = torque(&words);
            words[word] += 1.0;
            let phi = phase.radians();
            let (wave, slope) = match name.kind {
                Kind::Mean => (1.0, 0.0),
                Kind::Cosine(k) => ((f64::from(k) * phi).cos(), -f64::from(k) * (f64::from(k) * phi).sin()),
                Kind::Sine(k) => ((f64::from(k) * phi).sin(), f64::from(k) * (f64::from(k) * phi).cos()),
            };
            let expected = match name.curve {
                Curve::Inertia => wave * alpha + 0.5 * slope * omega * omega,
                Curve::Load => -wave,
                Curve::Viscous => wave * omega,
                Curve::Coulomb | Curve::Constant => wave,
            };
            assert_near(&name.to_string(), torque(&words) - before, expected, budget::IDENTITY * 2000.0);
        }
        let phase = Phase::from_bits(bits);
        [
            check::<0>, check::<1>, check::<2>, check::<3>, check::<4>, check::<5>, check::<6>, check::<7>,
            // With constant friction beside the other, and with constants only.
            check::<37>, check::<48>,
        ][set](word, phase, omega, alpha);
    }
}
