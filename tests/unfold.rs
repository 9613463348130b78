//! Friction in tables: magnitudes with kinks become smooth signed curves, and constants are stored as numbers, not curves.

use jred::mechanism::SliderCrankDimensions;
use std::f64::consts::TAU;

use crate::support::rows::Rows;
use crate::support::{assert_near, budget, config, largest, link_of, quantity, scale_of, value};
use jred::machine::{Action, Link, Load, Machine, Reducible, Reduction};
use jred::mechanism::{Branch, SliderCrank};
use jred::table::Format;
use jred::tabulate::curves_in_use;
use jred::{Cubic, CurveSet, Domain, Phase, Q31, Quadratic, Scale, Spline, curves};
use proptest::prelude::*;

/// J = 1 and c = |v|, for any v.
struct Friction<V> {
    domain: Domain,
    v: V,
}

impl<V: Fn(f64) -> f64> Reducible for Friction<V> {
    fn domain(&self) -> Domain {
        self.domain
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        Ok(Reduction::new([1.0, 0.0, 0.0]).with_coulomb((self.v)(phi).abs()))
    }
}

/// Largest error of c.
fn error<F: Format>(machine: &impl Reducible, cells: u32, scale: &Scale) -> f64 {
    let rows = Rows::<F>::of(machine, curves::COULOMB, cells, scale).unwrap();
    let table = rows.table();
    let places = 48 * cells;
    largest((0..places).map(|k| {
        let phase = Phase::from_bits(((u64::from(2 * k + 1) << 31) / u64::from(places)) as u32);
        let phi = machine
            .domain()
            .position(f64::from(phase.to_bits()) / 4_294_967_296.0);
        let exact = machine.reduction(phi).unwrap().coulomb;
        table.at(phase).coulomb * f64::from(scale.torque()) - exact
    }))
}

/// A slider-crank with friction at its slider, which reverses twice per turn.
fn press() -> Machine<SliderCrank> {
    let link = |mass| link_of(mass, 0.002, [0.01, 0.0]);
    let links = [link(0.8), link(0.5), Link::point_mass(0.6).unwrap()];
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.05,
            rod: 0.2,
            offset: 0.01,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    let friction = Load::new(SliderCrank::SLIDER, Action::OpposingForce(40.0)).unwrap();
    Machine::new(mechanism).with_load(friction).unwrap()
}

fn converges<F: Format>(machine: &impl Reducible, order: i32) {
    for cells in [64, 128] {
        let [coarse, fine] = [cells, 2 * cells].map(|n| error::<F>(machine, n, &Scale::SI));
        println!(
            "{} {cells} cells: {coarse:.1e}, ratio {:.2}",
            F::NAME,
            coarse / fine
        );
        let expected = f64::from(1 << order);
        assert_near(
            "order",
            coarse / fine,
            expected,
            budget::ORDER_SHARE * expected,
        );
    }
}

#[test]
fn friction_of_a_slider_converges_as_a_smooth_curve_does() {
    converges::<Spline<f64>>(&press(), 4);
    converges::<Cubic<f64>>(&press(), 4);
    converges::<Quadratic<f64>>(&press(), 3);
    // Over a stroke with one reversal inside.
    let stroke = Friction {
        domain: Domain::stroke(-0.7, 1.9).unwrap(),
        v: |x: f64| (1.3 * x).sin() * (2.0 + x),
    };
    converges::<Spline<f64>>(&stroke, 4);
    converges::<Quadratic<f64>>(&stroke, 3);
}

/// The prediction is cubic: for a cubic polynomial it is correct even if the sign changes next to the largest value, in either direction.
#[test]
fn signs_of_a_cubic_polynomial_are_right_at_once() {
    let v = |x: f64| (x - 0.5) * (x - 2.5) * (x - 5.3);
    let domain = Domain::stroke(0.0, 5.0).unwrap();
    for error in [
        error::<Cubic<f64>>(&Friction { domain, v }, 5, &Scale::SI),
        error::<Cubic<f64>>(
            &Friction {
                domain,
                v: |x: f64| v(5.0 - x),
            },
            5,
            &Scale::SI,
        ),
    ] {
        assert!(error < 1e-12, "{error}");
    }
}

/// A magnitude that touches zero an odd number of times per turn has no closed signed curve: it stays as it is, with its kink, of order 1.
#[test]
fn a_single_kink_a_turn_stays() {
    let odd = Friction {
        domain: Domain::Turn,
        v: |phi: f64| (0.5 * phi).sin(),
    };
    for cells in [64, 128] {
        let ratio = error::<Spline<f64>>(&odd, cells, &Scale::SI)
            / error::<Spline<f64>>(&odd, 2 * cells, &Scale::SI);
        // The error of a kink at a knot is proportional to the cell; that of a jump would not fall.
        assert!((1.8..2.2).contains(&ratio), "{ratio}");
    }
    // Over a stroke of the same length no end needs to close.
    let stroke = Friction {
        domain: Domain::stroke(0.0, TAU).unwrap(),
        v: odd.v,
    };
    converges::<Spline<f64>>(&stroke, 4);
    // A curve that touches zero without a change of sign is the same either way: of order 4 or, mirrored, 2.
    let touching = Friction {
        domain: Domain::Turn,
        v: |phi: f64| 1.0 - phi.cos(),
    };
    let found = error::<Spline<f64>>(&touching, 128, &Scale::SI);
    assert!(found < 2.0 * (TAU / 128.0).powi(2), "{found:e}");
}

/// Magnitudes without a zero stay bit-exact.
#[test]
fn a_magnitude_without_zeros_keeps_its_sign() {
    let rippled = Friction {
        domain: Domain::Turn,
        v: |phi: f64| 1.0 + 0.9 * (3.0 * phi).cos(),
    };
    let set = curves::COULOMB;
    let rows = Rows::<Spline<f64>>::of(&rippled, set, 64, &Scale::SI).unwrap();
    for knot in 0..64u32 {
        let exact = 1.0 + 0.9 * (3.0 * f64::from(knot) / 64.0 * TAU).cos();
        let read = rows.exact(Phase::from_bits(knot << 26), !0);
        assert_near("c", read.coulomb, exact, budget::SPLINE_END);
        assert!(rows.words[2 * knot as usize + 1] > 0.0);
    }
}

proptest! {
    #![proptest_config(config(128, 0x00a1))]

    /// Any even number of reversals anywhere on a turn. A sample so close to a zero that the cubic through the four before it does not determine its
    /// sign is smaller than h⁴·f⁗ (at most 2⁴ + 0.2·3⁴), and has an error of at most twice itself; far from zeros the curve is as accurate as any.
    #[test]
    fn reversals_anywhere_are_found(shift in 0.0..TAU, mean in -0.7..0.7, ripple in 0.0..0.2, twice: bool) {
        let waves = if twice { 2.0 } else { 1.0 };
        let v = move |phi: f64| mean + (waves * (phi - shift)).sin() + ripple * (3.0 * phi).cos();
        let machine = Friction { domain: Domain::Turn, v };
        let scale = scale_of(4.0, 1.0, 2.0).for_cells(128, TAU);
        let h = TAU / 128.0;
        let near = 2.0 * 32.2 * h.powi(4);
        // A quadratic's own error is below h³·f‴/24; f‴ is at most 2³ + 0.2·3³.
        let quadratic = near + 13.4 * h.powi(3) / 24.0;
        prop_assert!(error::<Spline<f64>>(&machine, 128, &Scale::SI) < near);
        prop_assert!(error::<Cubic<Q31>>(&machine, 128, &scale) < near);
        prop_assert!(error::<Quadratic<f64>>(&machine, 128, &Scale::SI) < quadratic);
    }
}

/// The same value everywhere.
struct Constant {
    viscous: f64,
    coulomb: f64,
    load: f64,
    domain: Domain,
}

impl Reducible for Constant {
    fn domain(&self) -> Domain {
        self.domain
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        Ok(
            Reduction::new([1.0 + 0.2 * phi.cos(), -0.2 * phi.sin(), -0.2 * phi.cos()])
                .with_process(self.load)
                .with_viscous(self.viscous)
                .with_coulomb(self.coulomb),
        )
    }
}

fn constants_are_curves<F: Format>(units: f64) {
    const CURVES: CurveSet = curves::VISCOUS | curves::COULOMB;
    const CONSTANTS: CurveSet = curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    let scale = scale_of(4.0, 3.0, 5.0).for_cells(32, TAU);
    let machine = Constant {
        viscous: 0.3,
        coulomb: 0.7,
        load: 0.0,
        domain: Domain::Turn,
    };
    let curves = Rows::<F>::of(&machine, CURVES, 32, &scale).unwrap();
    let constants = Rows::<F>::of(&machine, CONSTANTS, 32, &scale).unwrap();
    assert!(constants.words.len() < curves.words.len());
    let [a, b] = [curves.table(), constants.table()];
    let (model_a, model_b) = (
        curves.model::<CURVES>(&scale),
        constants.model::<CONSTANTS>(&scale),
    );
    for k in 0..97u32 {
        let phase = Phase::from_bits(k.wrapping_mul(0x9E37_79B9));
        let [a, b] = [a.at(phase), b.at(phase)];
        assert_near("b", b.viscous, a.viscous, units);
        assert_near("c", b.coulomb, a.coulomb, units);
        for omega in [-0.8, 0.0, 0.8] {
            let (omega, alpha) = (quantity(omega), quantity(0.1));
            let [a, b] = [
                model_a.torque(phase, omega, alpha),
                model_b.torque(phase, omega, alpha),
            ];
            assert_near("T", value(b), value(a), 2.0 * units);
            let back = value(model_b.acceleration(phase, omega, b).value);
            assert_near("α", back, value(alpha), 2.0 * units / 0.15);
        }
    }
}

#[test]
fn a_constant_equals_a_curve_that_is_constant() {
    constants_are_curves::<Spline<f64>>(budget::SPLINE_KNOT);
    constants_are_curves::<Spline<f32>>(budget::F32_READ);
    constants_are_curves::<Quadratic<f32>>(budget::F32_READ);
    let q31 = (budget::Q31_POINTS_UNITS + budget::Q31_TICK_UNITS) * budget::Q31_UNIT;
    constants_are_curves::<Spline<Q31>>(q31);
    constants_are_curves::<Cubic<Q31>>(q31);
    constants_are_curves::<Quadratic<Q31>>(q31);
}

#[test]
fn the_set_in_use_has_what_the_machine_has() {
    let set = |viscous, coulomb, load, domain| {
        let machine = Constant {
            viscous,
            coulomb,
            load,
            domain,
        };
        curves_in_use(&machine, 64).unwrap()
    };
    let stroke = Domain::stroke(-1.0, 2.0).unwrap();
    for domain in [Domain::Turn, stroke] {
        assert_eq!(set(0.0, 0.0, 0.0, domain), curves::INERTIA);
        assert_eq!(set(0.0, 0.0, -1.0, domain), curves::LOAD);
        assert_eq!(set(0.2, 0.0, 0.0, domain), curves::CONSTANT_VISCOUS);
        assert_eq!(set(0.0, 0.2, 0.0, domain), curves::CONSTANT_COULOMB);
        let both = curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
        assert_eq!(set(0.1, 0.2, 1.0, domain), curves::LOAD | both);
    }
    // A varying magnitude is a curve, whatever its first value.
    let friction = |v: fn(f64) -> f64| {
        let domain = Domain::Turn;
        curves_in_use(&Friction { domain, v }, 64).unwrap()
    };
    assert_eq!(friction(f64::sin), curves::COULOMB);
    assert_eq!(
        friction(|phi| if phi > 6.0 { 1.0 } else { 0.0 }),
        curves::COULOMB
    );
    assert_eq!(friction(|phi| 1.0 + 1e-9 * phi.sin()), curves::COULOMB);
    assert_eq!(
        friction(|phi| 1.0 + 1e-14 * phi.sin()),
        curves::CONSTANT_COULOMB
    );
    assert_eq!(curves_in_use(&press(), 64).unwrap(), curves::COULOMB);
}
