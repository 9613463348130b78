//! The tick against the curves of its table, and against its own inverse.

use jred::{CurveSet, Phase, Q15, Scale, Torque, curves};
use proptest::prelude::*;

use super::{CONSTANT, EVERY, Short, model, q15, units, velocity};
use crate::support::machines::{Spec, spec};
use crate::support::{budget, config, largest, samples, value};
use jred::table::CurveValues;

const ALL: CurveSet = curves::ALL;
const CONSTANTS: CurveSet = curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;

fn scale(spec: &Spec) -> Scale {
    Scale::limited_to(&spec.machine(), 60.0, 900.0, 256).unwrap()
}

/// The table of the set; without machines whose curves overshoot in so few cells.
fn table(spec: &Spec, set: CurveSet) -> Option<Short> {
    Short::of(&spec.machine(), set, 200, &scale(spec)).ok()
}

fn sgn(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

fn resisting(read: &CurveValues, scale: &Scale, omega: f64) -> f64 {
    (velocity(read, scale) * omega + read.viscous) * omega - read.load + read.coulomb * sgn(omega)
}

/// Torque minus that of the curves, in units of 2⁻¹⁵.
fn torque_error<const SET: CurveSet>(rows: &Short, phase: Phase, omega: i16, alpha: i16) -> f64 {
    let read = rows.table().at(phase);
    let (omega, alpha) = (q15(omega), q15(alpha));
    let (w, a) = (value(omega), value(alpha));
    let exact = read.inertia * a + resisting(&read, &rows.scale, w);
    let torque = model::<SET>(rows).torque(phase, omega, alpha);
    units(torque) - 32_768.0 * exact
}

type Case = (Spec, u32, i16, i16);

fn cases(count: u32) -> Vec<Case> {
    samples(
        count,
        0x5142,
        &(spec(), any::<u32>(), any::<i16>(), any::<i16>()),
    )
}

fn torque_of_set<const SET: CurveSet>() {
    let mut worst = [0.0f64; 2];
    for (spec, phase, omega, alpha) in cases(300) {
        let Some(rows) = table(&spec, SET) else {
            continue;
        };
        let phase = Phase::from_bits(phase);
        for omega in [omega, 0, i16::MAX, i16::MIN] {
            for alpha in [alpha, 0, i16::MAX, i16::MIN] {
                let error = torque_error::<SET>(&rows, phase, omega, alpha);
                worst = [worst[0].min(error), worst[1].max(error)];
            }
        }
    }
    let most = budget::ROWS16_TORQUE;
    assert!(
        worst[0] >= -most && worst[1] <= most,
        "set {SET}: {worst:?}"
    );
    assert!(
        worst[0] < -0.6 * most && worst[1] > 0.6 * most,
        "set {SET}: {worst:?}"
    );
}

#[test]
fn torque_is_that_of_the_curves() {
    torque_of_set::<{ curves::INERTIA }>();
    torque_of_set::<{ curves::LOAD }>();
    torque_of_set::<{ curves::VISCOUS }>();
    torque_of_set::<{ curves::COULOMB }>();
    torque_of_set::<{ ALL }>();
    torque_of_set::<{ curves::LOAD | CONSTANTS }>();
    torque_of_set::<EVERY>();
    torque_of_set::<CONSTANT>();
}

/// Acceleration from the torque for an acceleration, minus that acceleration, over its permitted error: a share of it, and units of the torque over
/// J.
fn there_and_back<const SET: CurveSet>() {
    let mut worst = 0.0f64;
    let mut compared = 0;
    for (spec, phase, omega, alpha) in cases(400) {
        let Some(rows) = table(&spec, SET) else {
            continue;
        };
        let model = model::<SET>(&rows);
        let phase = Phase::from_bits(phase);
        let inertia = model.table().at(phase).inertia;
        for alpha in [alpha / 2, 0, 20_000, -20_000] {
            let torque = model.torque(phase, q15(omega), q15(alpha));
            let back = model.acceleration(phase, q15(omega), torque);
            let roundings = if SET & !curves::RECIPROCAL == curves::INERTIA {
                budget::ROWS16_BARE_BACK
            } else {
                budget::ROWS16_BACK
            };
            let allowed = f64::from(model.table().reciprocal_error()) * f64::from(alpha).abs()
                + roundings / inertia * (1.0 + f64::from(model.table().reciprocal_error()))
                + 1.0;
            let off = units(back.value) - f64::from(alpha);
            if f64::from(alpha).abs() + allowed < 32_767.0 {
                assert!(!back.saturated);
                worst = worst.max(off.abs() / allowed);
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared}");
    assert!((0.5..=1.0).contains(&worst), "set {SET}: {worst}");
}

#[test]
fn forward_undoes_inverse() {
    there_and_back::<{ curves::INERTIA }>();
    there_and_back::<{ curves::RECIPROCAL }>();
    there_and_back::<{ curves::LOAD | CONSTANTS }>();
    there_and_back::<{ curves::LOAD | CONSTANTS | curves::RECIPROCAL }>();
    there_and_back::<EVERY>();
}

/// If the exact acceleration is clearly out of range or clearly within it, the flag agrees, and the value is the nearest.
fn saturation<const SET: CurveSet>(rows: &Short, phase: Phase, omega: i16, torque: i16) {
    let (omega, torque) = (q15(omega), q15(torque));
    let model = model::<SET>(rows);
    let read = model.table().at(phase);
    let exact = (value(torque) - resisting(&read, &rows.scale, value(omega))) / read.inertia;
    let off = f64::from(model.table().reciprocal_error()) * exact.abs()
        + 1e-4 * (1.0 + 3.0 / read.inertia);
    let found = model.acceleration(phase, omega, torque);
    if exact > 1.0 + off {
        assert_eq!((found.value, found.saturated), (q15(i16::MAX), true));
    } else if exact < -1.0 - off {
        assert_eq!((found.value, found.saturated), (q15(i16::MIN), true));
    } else if exact.abs() < 1.0 - off {
        assert!(!found.saturated);
        assert!(
            (value(found.value) - exact).abs() <= off,
            "{found:?} {exact}"
        );
    }
}

proptest! {
    #![proptest_config(config(300, 0x5143))]

    #[test]
    fn forward_saturates_where_it_must(spec in spec(), phase: u32, omega: i16, torque: i16) {
        let phase = Phase::from_bits(phase);
        if let Some(rows) = table(&spec, ALL | curves::RECIPROCAL) {
            saturation::<{ ALL | curves::RECIPROCAL }>(&rows, phase, omega, torque);
        }
        if let Some(rows) = table(&spec, ALL) {
            saturation::<ALL>(&rows, phase, omega, torque);
        }
    }

    #[test]
    fn a_range_is_its_two_accelerations(spec in spec(), phase: u32, omega: i16, torques: [i16; 2]) {
        let phase = Phase::from_bits(phase);
        let [least, greatest] = torques.map(q15);
        if let Some(rows) = table(&spec, EVERY) {
            let model = model::<EVERY>(&rows);
            let range = model.acceleration_range(phase, q15(omega), least, greatest);
            prop_assert_eq!(range.least, model.acceleration(phase, q15(omega), least));
            prop_assert_eq!(range.greatest, model.acceleration(phase, q15(omega), greatest));
        }
    }
}

#[test]
fn many_samples_are_single_ones() {
    let (spec, ..) = cases(1).remove(0);
    let rows = table(&spec, ALL).unwrap();
    let model = model::<ALL>(&rows);
    let phases = [1u32, 1 << 30, 3 << 30].map(Phase::from_bits);
    let omegas = [100, -200, 300].map(q15);
    let alphas = [-4000, 5000, 6000].map(q15);
    let mut torques = [Torque::<Q15>::default(); 4];
    assert_eq!(model.torques(&phases, &omegas, &alphas, &mut torques), 3);
    for k in 0..3 {
        assert_eq!(torques[k], model.torque(phases[k], omegas[k], alphas[k]));
    }
    assert_eq!(torques[3], Torque::default());
}

/// The bound on 1/J is valid everywhere, and close to the observed error.
#[test]
fn reciprocal_error_is_a_bound() {
    let mut nearest = 0.0f64;
    for (spec, ..) in cases(40) {
        let Some(rows) = table(&spec, curves::RECIPROCAL) else {
            continue;
        };
        let table = rows.table();
        let stated = f64::from(table.reciprocal_error());
        let found = largest((0..40_000u32).map(|k| {
            let phase = Phase::from_bits(k * 107_374);
            table.at(phase).inertia * table.reciprocal(phase).unwrap() - 1.0
        }));
        assert!(found <= stated, "{found} {stated}");
        nearest = nearest.max(found / stated);
    }
    assert!(nearest > 0.7, "{nearest}");
}
