//! The four-bar linkage: geometry and forces.

pub(crate) mod change_points;
mod refused;

use std::f64::consts::{PI, TAU};

use jred::machine::{Action, Link, Load, Machine, Mechanism, PoseError, Reducible};
use jred::mechanism::{BuildError, FourBar, FourBarDimensions, Grashof, Side};
use proptest::prelude::*;

use crate::support::{assert_near, budget, config, derivative, jointed, largest, link_of};

/// A random four-bar with a crank that turns.
#[derive(Clone, Debug)]
pub(crate) struct Spec {
    lengths: [f64; 3],
    ground: f64,
    gamma: f64,
    side: Side,
    mass: [f64; 3],
    com: [[f64; 2]; 3],
}

prop_compose! {
    pub(crate) fn spec()(
        shortest in 0.02..0.2_f64,
        middle in [1.15..4.0, 1.15..4.0],
        stretch in 0.05..0.9,
        double_crank in any::<bool>(),
        order in 0usize..3,
        gamma in -3.2..3.2,
        left in any::<bool>(),
        mass in [0.1..3.0, 0.1..3.0, 0.1..3.0],
        u in [-0.5..1.0, -0.5..1.5, -0.5..1.5],
        v in [-0.3..0.3, -0.3..0.3, -0.3..0.3],
    ) -> Spec {
        // Grashof: the longest is longer than the middle ones, but shortest + longest is less than their sum.
        let [p, q] = middle.map(|ratio: f64| ratio * shortest);
        let longest = p.max(q) + stretch * (p + q - shortest - p.max(q));
        let mut rest = [p, q, longest];
        rest.rotate_left(order);
        let [first, second, third] = rest;
        let (lengths, ground) = if double_crank {
            ([first, second, third], shortest)
        } else {
            ([shortest, first, second], third)
        };
        let com = [0, 1, 2].map(|k| [u[k] * lengths[k], v[k] * lengths[k]]);
        let side = if left { Side::Left } else { Side::Right };
        Spec { lengths, ground, gamma, side, mass, com }
    }
}

impl Spec {
    fn pivot(&self) -> [f64; 2] {
        [
            self.ground * self.gamma.cos(),
            self.ground * self.gamma.sin(),
        ]
    }

    fn links(&self) -> [Link; 3] {
        [0, 1, 2].map(|k| {
            let (m, l) = (self.mass[k], self.lengths[k]);
            link_of(m, 0.1 * m * l * l, self.com[k])
        })
    }

    fn mechanism(&self) -> FourBar {
        FourBar::new(
            FourBarDimensions {
                crank: self.lengths[0],
                coupler: self.lengths[1],
                rocker: self.lengths[2],
                pivot: self.pivot(),
            },
            self.side,
            self.links(),
        )
        .unwrap()
    }

    pub(crate) fn machine(&self) -> Machine<FourBar> {
        let load = |link, action| Load::new(link, action).unwrap();
        Machine::new(self.mechanism())
            .with_gravity([2.0, -9.6])
            .and_then(|m| {
                m.with_load(load(FourBar::COUPLER, Action::Force([20.0, -7.0])).at([0.03, 0.01])?)
            })
            .and_then(|m| m.with_load(load(FourBar::ROCKER, Action::Moment(-3.0))))
            .and_then(|m| m.with_load(load(FourBar::ROCKER, Action::ViscousMoment(0.02))))
            .and_then(|m| m.with_load(load(FourBar::COUPLER, Action::OpposingMoment(0.3))))
            .unwrap()
    }
}

/// Freudenstein's equation with its derivatives: a relation of φ and the rocker's angle only, derived independently (the square of AB), so a check of
/// every transfer function.
fn freudenstein(spec: &Spec, mechanism: &FourBar, phi: f64) -> [f64; 4] {
    let [a, b, c] = spec.lengths;
    let d = spec.ground;
    let psi = mechanism.frames(phi).unwrap()[FourBar::ROCKER].psi;
    let constant = jred::number::Transfer::constant;
    let angle = jred::number::Transfer::variable(phi) - constant(spec.gamma);
    let rocker = psi - constant(spec.gamma);
    let (_, cos_1) = angle.sin_cos();
    let (_, cos_3) = rocker.sin_cos();
    let (_, cos_13) = (angle - rocker).sin_cos();
    // (d + c·cos ψ − a·cos φ)² + (c·sin ψ − a·sin φ)² = b²
    let sum = constant(a * a + c * c + d * d - b * b) + cos_3 * (2.0 * d * c)
        - cos_1 * (2.0 * a * d)
        - cos_13 * (2.0 * a * c);
    let size = (a + c + d) * (a + c + d);
    [sum.value, sum.d1, sum.d2, sum.d3].map(|x| x / size)
}

proptest! {
    #![proptest_config(config(200, 0x04b1))]

    #[test]
    fn the_rocker_follows_freudenstein(spec in spec(), phi in -7.0..7.0) {
        let mechanism = spec.mechanism();
        let psi = mechanism.frames(phi).unwrap()[FourBar::ROCKER].psi;
        let speed = 1.0 + psi.d1.abs();
        let second = speed * speed + psi.d2.abs();
        let sizes = [1.0, speed, second, second * speed + psi.d3.abs()];
        for (found, size) in freudenstein(&spec, &mechanism, phi).into_iter().zip(sizes) {
            assert_near("Freudenstein", found, 0.0, budget::JOINT_CLOSURE * size);
        }
    }

    /// Angles are continuous, and after a turn every link is back: those of a drag link after a full revolution.
    #[test]
    fn angles_are_continuous(spec in spec(), phi in -20.0..20.0) {
        let mechanism = spec.mechanism();
        let psi = |phi: f64, link: usize| mechanism.frames(phi).unwrap()[link].psi.value;
        let whole = if spec.ground < spec.lengths[0] { TAU } else { 0.0 };
        for link in [FourBar::COUPLER, FourBar::ROCKER] {
            assert_near("a turn on", psi(phi + TAU, link) - psi(phi, link), whole, budget::MIRROR);
            let start = psi(0.0, link);
            prop_assert!(start > -PI && start <= PI, "{start}");
            let mut last = start;
            for k in 1..=2000 {
                let now = psi(TAU * f64::from(k) / 2000.0, link);
                prop_assert!((now - last).abs() < 0.7, "jumps from {last} to {now}");
                last = now;
            }
        }
    }

    /// The law of cosines at B, and the extremes at the ends of the swing of f.
    #[test]
    fn transmission_angle_is_that_of_the_triangle(spec in spec(), phi in -7.0..7.0) {
        let mechanism = spec.mechanism();
        let [a, b, c] = spec.lengths;
        let angle = mechanism.transmission_angle(phi).unwrap();
        let f2 = a * a + spec.ground * spec.ground - 2.0 * a * spec.ground * (phi - spec.gamma).cos();
        let cos = (b * b + c * c - f2) / (2.0 * b * c);
        assert_near("cos μ", angle.value.cos(), cos, budget::MIRROR);
        let slope = derivative(|phi| mechanism.transmission_angle(phi).unwrap().value, phi, 1.0 / 256.0);
        assert_near("μ′", angle.d1, slope, 1e-5 * (1.0 + angle.d2.abs() + angle.d3.abs()));
        let [least, most] = mechanism.transmission_angle_range();
        let seen = |phi: f64| mechanism.transmission_angle(phi).unwrap().value;
        prop_assert!((least - 1e-9..=most + 1e-9).contains(&seen(phi)));
        assert_near("least", seen(spec.gamma), least, 1e-7);
        assert_near("most", seen(spec.gamma + PI), most, 1e-7);
    }

    /// The rocker stops at its dead centres and nowhere else; crank angles are recovered from its angle.
    #[test]
    fn rocker_and_crank_find_each_other(spec in spec(), phi in 0.0..TAU) {
        let mechanism = spec.mechanism();
        let psi = |phi: f64| mechanism.frames(phi).unwrap()[FourBar::ROCKER].psi;
        match mechanism.rocker_dead_centres() {
            Some(dead) => {
                for phi in dead {
                    let at = psi(phi);
                    assert_near("ψ′", at.d1, 0.0, 1e-9 * (1.0 + at.d2.abs()));
                    prop_assert!((0.0..TAU).contains(&phi));
                    // In line: O, A, B.
                    let frames = mechanism.frames(phi).unwrap();
                    let [x, y] = frames[FourBar::ROCKER].point([spec.lengths[2], 0.0]).map(|t| t.value);
                    let across = x * phi.sin() - y * phi.cos();
                    assert_near("in line", across, 0.0, 1e-9 * spec.lengths[1]);
                }
                let ends = dead.map(|phi| psi(phi).value);
                let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                prop_assert!((low - 1e-9..=high + 1e-9).contains(&psi(phi).value));
            }
            None => prop_assert!(mechanism.grashof() == Grashof::DoubleCrank),
        }
        // Near a dead centre two crank angles meet, and each is known only to the square root of a rounding.
        if psi(phi).d1.abs() > 1e-3 {
            let found = mechanism.crank_angles(psi(phi).value);
            let nearest = found.iter().map(|f| (f - phi).abs()).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest < 1e-7, "{found:?}, not {phi}");
        }
    }

    /// Mirrored at the x axis the crank goes from φ to −φ and B changes its side.
    #[test]
    fn sides_mirror_each_other(spec in spec(), phi in -7.0..7.0_f64) {
        let mirrored = Spec {
            gamma: -spec.gamma,
            side: if spec.side == Side::Left { Side::Right } else { Side::Left },
            com: spec.com.map(|[u, v]| [u, -v]),
            ..spec.clone()
        };
        let [here, there] = [(&spec, phi), (&mirrored, -phi)].map(|(spec, phi): (&Spec, f64)| {
            Machine::new(spec.mechanism()).reduction(phi).unwrap().inertias()
        });
        let size = largest(here);
        assert_near("J", there[0], here[0], budget::MIRROR * size);
        assert_near("J′", there[1], -here[1], budget::MIRROR * size);
        assert_near("J″", there[2], here[2], budget::MIRROR * size);
    }

    /// A crank that cannot turn fully moves over the range that the error names, and not beyond.
    #[test]
    fn a_blocked_crank_moves_within_its_range(
        lengths in [0.1..1.0, 0.1..1.0, 0.1..1.0],
        ground in 0.1..1.0,
        gamma in -3.2..3.2,
        left in any::<bool>(),
    ) {
        let all = [lengths[0], lengths[1], lengths[2], ground];
        let sum: f64 = all.iter().sum();
        prop_assume!(all.iter().all(|l| *l < 0.49 * sum));
        prop_assume!(!matches!(Grashof::of(all), Grashof::CrankRocker | Grashof::DoubleCrank));
        let pivot = [ground * f64::cos(gamma), ground * f64::sin(gamma)];
        let side = if left { Side::Left } else { Side::Right };
        let refused = FourBar::new(FourBarDimensions { crank: lengths[0], coupler: lengths[1], rocker: lengths[2], pivot }, side, links()).unwrap_err();
        let BuildError::Rotation(jred::mechanism::RotationError::FourBar { reach: [from, to], .. }) = refused else {
            panic!("{refused:?}");
        };
        let inset = 1e-3 * (to - from);
        let stroke = [from + inset, to - inset];
        let swinging = FourBar::over_stroke(FourBarDimensions { crank: lengths[0], coupler: lengths[1], rocker: lengths[2], pivot }, side, stroke, links()).unwrap();
        jointed::turns(&swinging, 4000);
        for k in 0..=40 {
            let phi = swinging.domain().position(f64::from(k) / 40.0);
            jointed::joints_close(&swinging, phi);
            let [least, most] = swinging.transmission_angle_range();
            let angle = swinging.transmission_angle(phi).unwrap().value;
            prop_assert!((least - 1e-7..=most + 1e-7).contains(&angle));
        }
        for (stroke, phi) in [([from + inset, to + inset], to), ([from - inset, to - inset], from)] {
            let refused = FourBar::over_stroke(FourBarDimensions { crank: lengths[0], coupler: lengths[1], rocker: lengths[2], pivot }, side, stroke, links()).unwrap_err();
            match refused {
                BuildError::Pose(PoseError::DeadPoint { phi: found, joint: 2 }) => assert_near("dead point", found, phi, budget::LIMIT_ANGLE),
                BuildError::Pose(PoseError::CannotAssemble { phi: found, joint: 2, gap }) => {
                    assert_near("start", found, stroke[0], 0.0);
                    prop_assert!(phi <= from && gap > 0.0);
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

fn links() -> [Link; 3] {
    [Link::rotor(1e-3).unwrap(); 3]
}

#[test]
fn grashof_knows_the_textbook_linkages() {
    for (lengths, kind) in [
        ([1.0, 3.0, 2.5, 3.2], Grashof::CrankRocker),
        ([2.5, 3.0, 3.2, 1.0], Grashof::DoubleCrank),
        ([3.0, 1.0, 2.5, 3.2], Grashof::DoubleRocker),
        ([3.0, 2.5, 1.0, 3.2], Grashof::RockerCrank),
        ([2.0, 2.0, 2.0, 3.0], Grashof::TripleRocker),
        ([1.0, 3.0, 1.0, 3.0], Grashof::ChangePoint),
        ([1.0, 1.0, 3.0, 3.0], Grashof::ChangePoint),
        ([0.1, 0.2, 0.3, 0.4], Grashof::ChangePoint),
    ] {
        assert_eq!(Grashof::of(lengths), kind, "{lengths:?}");
    }
}

/// Coupler and rocker can fold but not stretch: the crank passes the far side, between both positions with |AC| = |b − c|.
#[test]
fn a_crank_that_can_only_fold_swings_over_the_far_side() {
    let (crank, coupler, rocker, ground) = (0.3f64, 0.5f64, 0.3f64, 0.3f64);
    let folded = coupler - rocker;
    assert!(coupler + rocker > crank + ground && folded > (ground - crank).abs());
    let theta =
        ((crank * crank + ground * ground - folded * folded) / (2.0 * crank * ground)).acos();
    for gamma in [0.0, 0.7, -2.0f64] {
        let pivot = [ground * gamma.cos(), ground * gamma.sin()];
        let dimensions = FourBarDimensions {
            crank,
            coupler,
            rocker,
            pivot,
        };
        let refused = FourBar::new(dimensions, Side::Left, links()).unwrap_err();
        let BuildError::Rotation(jred::mechanism::RotationError::FourBar { reach, .. }) = refused
        else {
            panic!("{refused:?}");
        };
        let [from, to] = reach;
        assert_near("from", from, gamma + theta, budget::LIMIT_ANGLE);
        assert_near("to", to, gamma - theta + TAU, budget::LIMIT_ANGLE);
    }
}

/// The kind depends on the shape only, at any size: sums that differ by 1e-10 relative differ, 1e-14 is a rounding.
#[test]
fn grashof_does_not_depend_on_the_size() {
    for power in [-20, -10, 0, 10, 20] {
        let size = 2.0f64.powi(power);
        for (more, kind) in [
            (1.4e-10, Grashof::TripleRocker),
            (1.4e-14, Grashof::ChangePoint),
            (-1.4e-14, Grashof::ChangePoint),
            (-1.4e-10, Grashof::CrankRocker),
        ] {
            let lengths = [0.3, 0.5, 0.9, 1.1 * (1.0 + more)].map(|l| l * size);
            assert_eq!(Grashof::of(lengths), kind, "{lengths:?}");
        }
    }
}
