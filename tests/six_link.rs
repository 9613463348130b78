//! The six-link quick-return mechanism: the printed equations, geometry, forces, and refusals.

use crate::support::spoken;
use jred::mechanism::BuildError;
use jred::mechanism::SixLinkDimensions;
use std::f64::consts::{PI, TAU};

use crate::support::{assert_near, budget, config, derivative, jointed, largest, link_of};
use jred::machine::{Action, Jointed, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{Branch, SixLink};
use jred::number::Transfer;
use proptest::prelude::*;

/// A random six-link mechanism.
#[derive(Clone, Debug)]
pub(crate) struct Spec {
    lengths: [f64; 3],
    centres: f64,
    below: f64,
    branch: Branch,
    mass: [f64; 5],
    com: [f64; 5],
}

prop_compose! {
    pub(crate) fn spec()(
        crank in 0.03..0.2_f64,
        turns in any::<bool>(),
        share in 0.1..0.9_f64,
        rocker in 0.1..0.6_f64,
        spare in 1.05..3.0_f64,
        below in -0.3..0.3_f64,
        left in any::<bool>(),
        mass in [0.1..3.0, 0.1..1.0, 0.1..3.0, 0.1..3.0, 0.2..5.0],
        com in [-0.5..0.5, -0.1..0.1, 0.0..1.0, 0.0..1.0, -0.5..0.5],
    ) -> Spec {
        let centres = if turns { share * crank } else { crank / share };
        let rise = if turns { rocker } else { rocker * crank / centres };
        let branch = if left { Branch::Left } else { Branch::Right };
        Spec { lengths: [crank, rocker, spare * (rise + below.abs())], centres, below, branch, mass, com }
    }
}

impl Spec {
    fn mechanism(&self) -> SixLink {
        let [l1, l2, l3] = self.lengths;
        let size = [l1, 0.05, l2, l3, 0.1];
        let links = [0, 1, 2, 3, 4].map(|k| {
            let com = [self.com[k] * size[k], 0.1 * self.com[k] * size[k]];
            link_of(self.mass[k], 0.1 * self.mass[k] * size[k] * size[k], com)
        });
        SixLink::new(
            SixLinkDimensions {
                crank: self.lengths[0],
                rocker: self.lengths[1],
                rod: self.lengths[2],
                centres: self.centres,
                below: self.below,
            },
            self.branch,
            links,
        )
        .unwrap()
    }

    pub(crate) fn machine(&self) -> Machine<SixLink> {
        let load = |link, action| Load::new(link, action).unwrap();
        Machine::new(self.mechanism())
            .with_gravity([1.0, -9.7])
            .and_then(|m| m.with_load(load(SixLink::SLIDER, Action::Force([-300.0, 20.0]))))
            .and_then(|m| m.with_load(load(SixLink::SLIDER, Action::OpposingForce(40.0))))
            .and_then(|m| m.with_load(load(SixLink::ROCKER, Action::ViscousMoment(0.4))))
            .and_then(|m| m.with_load(load(SixLink::BLOCK, Action::Force([3.0, 8.0]))))
            .unwrap()
    }

    /// φ₂, s and φ₃ of the mechanism: s as the slot's coordinate, φ₃ from C to B.
    fn coordinates(&self, phi: f64) -> [Transfer; 3] {
        let mechanism = self.mechanism();
        let frames = mechanism.frames(phi).unwrap();
        let slot = mechanism.joints(phi, &frames).unwrap()[2].coordinate(&frames);
        let phi_3 = frames[SixLink::ROD].psi + Transfer::constant(PI);
        [frames[SixLink::ROCKER].psi, slot, phi_3]
    }
}

proptest! {
    #![proptest_config(config(300, 0x0511))]

    /// (81), its first derivative (82) and its second (84) in time, each written out as in the text.
    #[test]
    fn printed_equations_hold(
        spec in spec(), phi in -7.0..7.0_f64, omega in -40.0..40.0_f64, alpha in -500.0..500.0_f64,
    ) {
        let [l1, l2, l3] = spec.lengths;
        let [q2, q_s, q3] = spec.coordinates(phi);
        let (s, s_t, s_tt) = (q_s.value, q_s.velocity(omega), q_s.acceleration(omega, alpha));
        let (w2, e2) = (q2.velocity(omega), q2.acceleration(omega, alpha));
        let (w3, e3) = (q3.velocity(omega), q3.acceleration(omega, alpha));
        let [(s1, c1), (s2, c2), (s3, c3)] = [phi, q2.value, q3.value].map(f64::sin_cos);
        prop_assert!(s > 0.0);
        let holds = |name: &str, terms: &[f64]| {
            let size = largest(terms.iter().copied());
            assert_near(name, terms.iter().sum(), 0.0, budget::JOINT_CLOSURE * size);
        };
        holds("(81) x", &[l1 * c1, -s * c2, spec.centres]);
        holds("(81) y", &[l1 * s1, -s * s2, spec.centres * 1e-3, -spec.centres * 1e-3]);
        holds("(81) guide", &[l2 * s2, -l3 * s3, spec.below, l3 * 1e-3, -l3 * 1e-3]);
        let size = (l1 + l2 + l3 + s) * (omega.abs() + w2.abs() + w3.abs()) + s_t.abs();
        holds("(82) x", &[w2 * s * s2, -s_t * c2, -l1 * omega * s1, size, -size]);
        holds("(82) y", &[-w2 * s * c2, -s_t * s2, l1 * omega * c1, size, -size]);
        holds("(82) guide", &[w2 * l2 * c2, -w3 * l3 * c3, size, -size]);
        let size = (l1 + l2 + l3 + s) * (alpha.abs() + e2.abs() + e3.abs() + omega * omega + w2 * w2 + w3 * w3)
            + s_tt.abs() + 2.0 * (s_t * w2).abs();
        holds("(84) x", &[
            e2 * s * s2, -s_tt * c2, w2 * w2 * s * c2, 2.0 * s_t * w2 * s2,
            -l1 * (alpha * s1 + omega * omega * c1), size, -size,
        ]);
        holds("(84) y", &[
            -e2 * s * c2, -s_tt * s2, w2 * w2 * s * s2, -2.0 * s_t * w2 * c2,
            l1 * (alpha * c1 - omega * omega * s1), size, -size,
        ]);
        holds("(84) guide", &[
            e2 * l2 * c2, -w2 * w2 * l2 * s2, -e3 * l3 * c3, w3 * w3 * l3 * s3, size, -size,
        ]);
    }

    /// The slider by the loop O₁-O₂-B-C, on the requested side, and its velocity by differences.
    #[test]
    fn slider_is_where_the_loop_puts_it(spec in spec(), phi in -7.0..7.0_f64) {
        let [_, l2, l3] = spec.lengths;
        let [q2, _, q3] = spec.coordinates(phi);
        let mechanism = spec.mechanism();
        let slider = |phi: f64| mechanism.frames(phi).unwrap()[SixLink::SLIDER];
        let expected = l2 * q2.value.cos() - l3 * q3.value.cos() - spec.centres;
        let size = spec.centres + l2 + l3;
        assert_near("x_C", slider(phi).x.value, expected, budget::CLOSED_FORM * 10.0 * size);
        assert_near("y_C", slider(phi).y.value, -spec.below, 0.0);
        let to_the_right = slider(phi).x.value > expected + l3 * q3.value.cos();
        prop_assert!(to_the_right == (spec.branch == Branch::Right));
        let slope = derivative(|phi| slider(phi).x.value, phi, 1.0 / 256.0);
        let here = slider(phi).x;
        assert_near("x_C′", here.d1, slope, 1e-4 * (size + here.d2.abs() + here.d3.abs()));
    }

    /// A swinging rocker stays within ±asin(l₁/b); a turning one goes round with the crank.
    #[test]
    fn rocker_swings_or_turns(spec in spec(), phi in -20.0..20.0_f64) {
        let mechanism = spec.mechanism();
        let psi = |phi: f64| mechanism.frames(phi).unwrap()[SixLink::ROCKER].psi.value;
        let ratio = spec.lengths[0] / spec.centres;
        let turn = psi(phi + TAU) - psi(phi);
        if mechanism.rocker_turns() {
            prop_assert!(ratio > 1.0);
            assert_near("a turn on", turn, TAU, budget::MIRROR);
            prop_assert!((psi(phi) - phi).abs() <= (1.0 / ratio).asin() + 1e-12);
        } else {
            assert_near("a turn on", turn, 0.0, budget::MIRROR);
            prop_assert!(psi(phi).abs() <= ratio.asin() + 1e-7);
            // It reverses where the crank is perpendicular to it: cos φ = −l₁/b.
            let dead = (-ratio).acos();
            assert_near("end of the swing", psi(dead), ratio.asin(), 1e-7);
            let speed = mechanism.frames(dead).unwrap()[SixLink::ROCKER].psi;
            assert_near("reverses", speed.d1, 0.0, 1e-9 * (1.0 + speed.d2.abs()));
        }
    }
}

/// The known ratio of the times of the two strokes: (180° + 2·asin(l₁/b)) : (180° − 2·asin(l₁/b)) for the crank at
/// constant speed.
#[test]
fn shaper_returns_quickly() {
    let mechanism = SixLink::new(
        SixLinkDimensions {
            crank: 0.1,
            rocker: 0.5,
            rod: 0.6,
            centres: 0.2,
            below: -0.3,
        },
        Branch::Right,
        rotors(),
    )
    .unwrap();
    jointed::turns(&mechanism, 720);
    let speed = |phi: f64| mechanism.frames(phi).unwrap()[SixLink::ROCKER].psi.d1;
    let count = 36_000;
    let forward =
        (0..count).filter(|k| speed(TAU * (f64::from(*k) + 0.5) / f64::from(count)) > 0.0);
    let share = forward.count() as f64 / f64::from(count);
    assert_near("share of the forward stroke", share, 240.0 / 360.0, 1e-4);
    let whitworth = SixLink::new(
        SixLinkDimensions {
            crank: 0.2,
            rocker: 0.3,
            rod: 0.9,
            centres: 0.1,
            below: 0.2,
        },
        Branch::Left,
        rotors(),
    )
    .unwrap();
    jointed::turns(&whitworth, 720);
    // Fastest and slowest at φ = 180° and 0°: ω₂/ω = l₁/(l₁ ∓ b).
    let speed = |phi: f64| whitworth.frames(phi).unwrap()[SixLink::ROCKER].psi.d1;
    assert_near("fastest", speed(PI), 2.0, budget::CLOSED_FORM * 10.0);
    assert_near("slowest", speed(0.0), 2.0 / 3.0, budget::CLOSED_FORM * 10.0);
}

/// Only the rocker has inertia: J = J₂·φ₂′², and its derivative by differences.
#[test]
fn reduction_of_the_rocker_alone() {
    let mut links = rotors();
    for link in [0, 1, 3, 4] {
        links[link] = Link::rotor(0.0).unwrap();
    }
    let machine = SixLink::new(
        SixLinkDimensions {
            crank: 0.1,
            rocker: 0.5,
            rod: 0.6,
            centres: 0.25,
            below: -0.3,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    let machine = Machine::new(machine).with_flywheel(1e-3).unwrap();
    for k in 0..40 {
        let phi = 0.17 * f64::from(k);
        // φ₂′ = l₁·(l₁ + b·cos φ)/s².
        let s2 = 0.01 + 0.0625 + 2.0 * 0.025 * phi.cos();
        let slope = 0.1 * (0.1 + 0.25 * phi.cos()) / s2;
        let reduced = machine.reduction(phi).unwrap();
        let expected = 1e-3 + 0.01 * slope * slope;
        assert_near(
            "J",
            reduced.inertia,
            expected,
            budget::CLOSED_FORM * expected * 10.0,
        );
        let by_differences = derivative(
            |phi| machine.reduction(phi).unwrap().inertia,
            phi,
            1.0 / 64.0,
        );
        assert_near(
            "J′",
            reduced.inertia_slope,
            by_differences,
            budget::RICHARDSON * 10.0,
        );
    }
}

fn rotors() -> [Link; 5] {
    [Link::rotor(0.01).unwrap(); 5]
}

fn refused(lengths: [f64; 3], centres: f64, below: f64) -> String {
    spoken(
        SixLink::new(
            SixLinkDimensions {
                crank: lengths[0],
                rocker: lengths[1],
                rod: lengths[2],
                centres,
                below,
            },
            Branch::Right,
            rotors(),
        )
        .unwrap_err(),
    )
}

#[test]
fn what_cannot_turn_is_refused_with_its_reason() {
    assert_eq!(
        refused([0.1, 0.5, 0.6], 0.1, 0.0),
        "the crank cannot turn fully: it is as long as the distance of the pivots, 0.1 m, so its pin passes through the \
         rocker's pivot at φ = 180°; make it shorter for a rocker that swings, or longer for one that turns"
    );
    // sin φ₂ = l₃/l₂ = 0.4 is reached at φ = φ₂ + asin(b·sin φ₂/l₁) = 23.578° + 53.130°.
    assert_eq!(
        refused([0.1, 0.5, 0.2], 0.2, 0.0),
        "the crank cannot turn fully: the rod no longer reaches the guide at φ = 76.71°; make the rod longer than 0.250000 m, shorten the crank, or drive it over a stroke that stays inside φ = -76.71° and 76.71°, its dead points"
    );
    // Guide above: l₂·sin φ₂ ≥ 0.05 is within reach, from φ₂ = asin 0.1 = 5.739° on: φ = φ₂ + asin 0.2, and φ₂ + 180° − asin 0.2.
    assert_eq!(
        refused([0.1, 0.5, 0.3], 0.2, -0.35),
        "the crank cannot turn fully: the rod no longer reaches the guide at φ = 0.00°; make the rod longer than 0.600000 m, shorten the crank, or drive it over a stroke that stays inside φ = 17.28° and 174.20°, its dead points"
    );
    // Whitworth, guide above: the rocker first points down too far at φ₂ = 180° + asin(2/3), φ = φ₂ − asin(1/3), until −asin(2/3), φ = −41.81° −
    // 19.47°.
    assert_eq!(
        refused([0.2, 0.3, 0.4], 0.1, -0.2),
        "the crank cannot turn fully: the rod no longer reaches the guide at φ = 202.34°; make the rod longer than 0.500000 m, shorten the crank, or drive it over a stroke that stays inside φ = -61.28° and 202.34°, its dead points"
    );
    assert_eq!(
        refused([0.1, 0.0, 0.3], 0.2, 0.0),
        "rocker length is 0, but must be greater than zero"
    );
    assert_eq!(
        refused([0.1, 0.2, 0.3], -0.2, 0.0),
        "distance of the pivots is -0.2, but must be greater than zero"
    );
    assert_eq!(
        refused([0.1, 0.2, 0.3], 0.2, f64::NAN),
        "distance of the guide is not a finite number"
    );
}

proptest! {
    #![proptest_config(config(300, 0x0512))]

    /// Up to the angle that the error names, the rod reaches the guide: the same mechanism with the printed equation.
    #[test]
    fn the_angle_of_failure_is_the_first(
        crank in 0.05..0.2_f64, share in 0.2..0.9_f64, turns in any::<bool>(), rocker in 0.1..0.6_f64,
        below in -0.3..0.3_f64, short in 0.05..0.99_f64,
    ) {
        let centres = if turns { share * crank } else { crank / share };
        let rise = if turns { rocker } else { rocker * crank / centres };
        let rod = short * (rise + below.abs());
        let error = SixLink::new(SixLinkDimensions { crank, rocker, rod, centres, below }, Branch::Right, rotors()).unwrap_err();
        let BuildError::Rotation(jred::mechanism::RotationError::TooShort { phi, shortest, .. }) = error else {
            panic!("{error:?}")
        };
        assert_near("shortest", shortest, rise + below.abs(), budget::CLOSED_FORM);
        let spare = |phi: f64| {
            let (x, y) = (centres + crank * phi.cos(), crank * phi.sin());
            rod - (rocker * y / x.hypot(y) + below).abs()
        };
        if phi > 0.0 {
            assert_near("at the angle", spare(phi), 0.0, 1e-9);
        } else {
            prop_assert!(spare(0.0) <= 0.0);
            return Ok(());
        }
        for k in 0..200 {
            let before = phi * f64::from(k) / 200.0;
            prop_assert!(spare(before) > -1e-9, "fails before, at {before}");
        }
    }
}
