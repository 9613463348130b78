//! Every possible or likely set of curves of a format has its own functions.

use std::collections::BTreeSet;

use jred::harmonic::terms;
use jred::table::Format;
use jred::{
    Cubic, CurveSet, Harmonic, Q31, Quadratic, Rows16, SliderCrankForm, Spline, Spline16, curves,
};

/// The sets in a list of `families.rs`, which begins after the first `start`.
fn listed(start: &str) -> BTreeSet<CurveSet> {
    let (_, rest) = include_str!("../families.rs").split_once(start).unwrap();
    let list = rest.split_once("not(few_sets)").unwrap().1;
    let list = list.split_once('[').unwrap().1.split_once(']').unwrap().0;
    let list = list.strip_prefix("cfg").unwrap_or(list);
    list.split_whitespace()
        .map(|set| set.parse().unwrap())
        .collect()
}

fn accepted<F: Format>(sets: core::ops::Range<u32>) -> BTreeSet<CurveSet> {
    sets.map(|set| set as CurveSet)
        .filter(|set| F::accepts(*set))
        .collect()
}

#[test]
fn every_set_of_polynomials_has_a_family() {
    let float = listed("macro_rules! polynomials");
    assert_eq!(float.len(), 18);
    for format in [
        accepted::<Spline<f32>>,
        accepted::<Cubic<f32>>,
        accepted::<Quadratic<f32>>,
    ] {
        assert_eq!(format(0..1024), float);
    }
    let fixed = listed("$number:ty, reciprocal)");
    assert_eq!(fixed.len(), 36);
    for format in [
        accepted::<Spline<Q31>>,
        accepted::<Cubic<Q31>>,
        accepted::<Quadratic<Q31>>,
        accepted::<Spline16>,
        accepted::<Rows16>,
    ] {
        assert_eq!(format(0..1024), fixed);
    }
}

#[test]
fn harmonics_with_constant_friction_have_a_family() {
    let families = listed("// Harmonics have");
    let has = |set: CurveSet, bits: CurveSet| set & bits != 0;
    let meant = accepted::<Harmonic<f32>>(0..1 << 16)
        .into_iter()
        .filter(|set| {
            let load = terms::LOAD_COS | terms::LOAD_SIN;
            let others = terms::ALL & !(terms::INERTIA_COS | terms::INERTIA_SIN | load);
            !has(*set, curves::VISCOUS | curves::COULOMB | others)
                && (has(*set, curves::LOAD) || !has(*set, load))
        });
    assert_eq!(families, meant.collect());
}

#[test]
fn slider_cranks_with_plain_loads_have_a_family() {
    use jred::slider_crank::terms;
    let meant = accepted::<SliderCrankForm>(0..1 << 16)
        .into_iter()
        .filter(|set| {
            let others = terms::ALL & !(terms::LOAD_SIN | terms::LOAD_COS);
            set & (curves::VISCOUS | others) == 0
        });
    assert_eq!(listed("// For a slider-crank"), meant.collect());
}
