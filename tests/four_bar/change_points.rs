//! Four-bars that pass change points on their branch: parallelograms, antiparallelograms, kites, and linkages that return after two turns.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use jred::Domain;
use jred::machine::{
    Action, Jointed, Link, Load, Machine, MachineError, Mechanism, PoseError, Reducible,
};
use jred::mechanism::{BuildError, DimensionError, FourBar, FourBarDimensions, Side};
use proptest::prelude::*;

use super::links;
use crate::support::derivatives::derivatives;
use crate::support::{assert_near, budget, config, forces, jointed, link_of, spoken};

/// A linkage kept on its branch: lengths of crank, coupler, rocker and ground, direction of the ground.
pub(crate) fn kept(
    [crank, coupler, rocker, ground]: [f64; 4],
    gamma: f64,
    side: Side,
    domain: Domain,
    links: [Link; 3],
) -> Result<FourBar, BuildError> {
    let dimensions = FourBarDimensions {
        crank,
        coupler,
        rocker,
        pivot: [ground * gamma.cos(), ground * gamma.sin()],
    };
    FourBar::through_change_points(dimensions, side, domain, links)
}

/// Kinds of linkage that fold flat, from two random lengths p < q and a third r; and whether they return after one turn.
pub(crate) fn lengths(kind: usize, p: f64, q: f64, r: f64) -> ([f64; 4], bool) {
    match kind {
        0 => ([p, q, p, q], true), // parallelogram and antiparallelogram
        1 => ([q, p, q, p], true),
        2 => ([p, p, q, q], true), // kite
        3 => ([q, q, p, p], true),
        4 => ([p, q, q, p], false), // Galloway's
        // s + l = p + q, all different: crank, or ground, the shortest.
        5 => ([p, q, q + r, 2.0 * q + r - p], false),
        6 => ([p, 2.0 * q + r - p, q, q + r], false),
        7 => ([p, q, 2.0 * q + r - p, q + r], false),
        8 => ([q, 2.0 * q + r - p, q + r, p], false),
        _ => ([2.0 * q + r - p, q, q + r, p], false),
    }
}

prop_compose! {
    fn linkage()(
        kind in 0usize..10,
        p in 0.05..0.2_f64,
        wider in 1.2..3.0_f64,
        r in 0.03..0.3_f64,
        gamma in -3.2..3.2_f64,
        left in any::<bool>(),
        start in -4.0..4.0_f64,
        mass in [0.1..3.0_f64, 0.1..3.0, 0.1..3.0],
    ) -> (FourBar, [f64; 4]) {
        let (lengths, turns) = lengths(kind, p, wider * p, r);
        // Only one branch of a kite moves its rocker.
        let side = if left || kind == 2 || kind == 3 { Side::Left } else { Side::Right };
        let domain = if turns { Domain::Turn } else { Domain::stroke(start, start + 2.0 * TAU).unwrap() };
        let links = [0, 1, 2].map(|k| {
            let (m, l) = (mass[k], lengths[k]);
            link_of(m, 0.1 * m * l * l, [0.4 * l, 0.1 * l])
        });
        (kept(lengths, gamma, side, domain, links).unwrap(), lengths)
    }
}

fn machine(four_bar: FourBar) -> Machine<FourBar> {
    let load = |link, action| Load::new(link, action).unwrap();
    Machine::new(four_bar)
        .with_gravity([2.0, -9.6])
        .and_then(|m| {
            m.with_load(load(FourBar::COUPLER, Action::Force([20.0, -7.0])).at([0.03, 0.01])?)
        })
        .and_then(|m| m.with_load(load(FourBar::ROCKER, Action::Moment(-3.0))))
        .unwrap()
}

proptest! {
    #![proptest_config(config(300, 0x04b2))]

    /// At change points, 1e-12 to 1e-3 rad next to them, and anywhere.
    #[test]
    fn joints_close_through_change_points((four_bar, _) in linkage(), at in 0.0..1.0_f64, turn in 0..2) {
        let flat = four_bar.change_points();
        prop_assert!(!flat.is_empty());
        for phi in flat {
            let phi = phi + f64::from(turn) * TAU;
            for beside in [0.0, 1e-12, -1e-12, 1e-7, -1e-7, 1e-3, -1e-3] {
                jointed::joints_close(&four_bar, phi + beside);
            }
            derivatives(&machine(four_bar.clone()), phi);
        }
        let phi = four_bar.domain().position(at);
        jointed::joints_close(&four_bar, phi);
        derivatives(&machine(four_bar), phi);
    }

    /// Next to the change point, where joint forces are still determined, d'Alembert's torque equals that of the reduced equation. The forces grow
    /// with 1/distance, so the torque is known to rounding over its square.
    #[test]
    fn forces_hold_beside_change_points((four_bar, _) in linkage(), near in 0.02..0.2_f64, omega in -5.0..5.0_f64, alpha in -20.0..20.0_f64) {
        let machine = machine(four_bar);
        for phi in machine.mechanism().change_points() {
            forces::dalembert(&machine, phi + near, omega, alpha);
            let error = machine.forces(phi + 0.5 * FourBar::FLAT, omega, alpha).unwrap_err();
            prop_assert!(matches!(error, MachineError::Pose(PoseError::ChangePoint { .. })), "{error}");
            let far = machine.forces(phi + 2.0 * FourBar::FLAT, omega, alpha);
            prop_assert!(far.is_ok());
        }
    }
}

proptest! {
    #![proptest_config(config(40, 0x04b3))]

    /// No angle jumps over the range, and at its end every pin is back.
    #[test]
    fn it_comes_back((four_bar, _) in linkage()) {
        jointed::turns(&four_bar, 7200);
        let domain = four_bar.domain();
        let [first, last] = [0.0, 1.0].map(|at| four_bar.frames(domain.position(at)).unwrap());
        for (a, b) in first.iter().zip(&last) {
            for (a, b) in [(a.x, b.x), (a.y, b.y), (a.psi.sin_cos().0, b.psi.sin_cos().0)] {
                assert_near("back", b.value, a.value, 1e-11);
                assert_near("back, speed", b.d1, a.d1, 1e-9);
            }
        }
    }
}

/// Circular translation: the coupler does not turn, the rocker turns with the crank, and the reduced inertia is J₁ + J₃ + (m₁·r₁² + m₃·r₃²) + m₂·a²,
/// for any inertia of the coupler.
#[test]
fn a_parallelogram_translates_on_a_circle() {
    let links = [
        link_of(1.5, 0.004, [0.02, 0.01]),
        link_of(4.0, 0.3, [0.11, -0.02]),
        link_of(2.5, 0.006, [-0.03, 0.04]),
    ];
    for gamma in [0.0, 0.8, -2.4, PI] {
        let side = kept([0.1, 0.3, 0.1, 0.3], gamma, Side::Left, Domain::Turn, links).unwrap();
        let flat = side.change_points();
        assert_near("folded", flat[0], gamma.rem_euclid(TAU), 1e-15);
        assert_near("stretched", flat[1], (gamma + PI).rem_euclid(TAU), 1e-15);
        let expected = 0.004
            + 1.5 * (0.02_f64.powi(2) + 0.01_f64.powi(2))
            + 4.0 * 0.1_f64.powi(2)
            + 0.006
            + 2.5 * (0.03_f64.powi(2) + 0.04_f64.powi(2));
        let machine = Machine::new(side);
        for phi in [0.0, 0.3, gamma, gamma + PI, 5.9, 40.0] {
            let [_, coupler, rocker] = machine.mechanism().frames(phi).unwrap()[..] else {
                panic!("three links");
            };
            let turned = (coupler.psi.value - gamma).rem_euclid(TAU);
            assert_near("ψ2", turned.min(TAU - turned), 0.0, 1e-15);
            assert_near("ψ2′", coupler.psi.d1, 0.0, 0.0);
            assert_near("ψ2″", coupler.psi.d2, 0.0, 0.0);
            assert_near("ψ3′", rocker.psi.d1, 1.0, 0.0);
            assert_near("ψ3″", rocker.psi.d2, 0.0, 0.0);
            let [inertia, slope, bend] = machine.reduction(phi).unwrap().inertias();
            assert_near("J", inertia, expected, budget::IDENTITY * expected);
            assert_near("J′", slope, 0.0, budget::IDENTITY * expected);
            assert_near("J″", bend, 0.0, budget::IDENTITY * expected);
        }
    }
}

/// The antiparallelogram's rocker turns against the crank like rolling ellipses: tan(ψ/2)·tan(θ/2) = ∓(d − a)/(d + a), the rocker's speed ψ′ = −(d² −
/// a²)/(d² + a² − 2·a·d·cos θ), at the change points −(d + a)/(d − a) and −(d − a)/(d + a).
#[test]
fn an_antiparallelogram_rolls_as_ellipses_do() {
    let (a, d) = (0.1, 0.3);
    let crossed = kept([a, d, a, d], 0.0, Side::Right, Domain::Turn, links()).unwrap();
    for k in 0..=24 {
        let phi = TAU * f64::from(k) / 24.0;
        let psi = crossed.frames(phi).unwrap()[FourBar::ROCKER].psi;
        let speed = -(d * d - a * a) / (d * d + a * a - 2.0 * a * d * phi.cos());
        assert_near("ψ′", psi.d1, speed, budget::IDENTITY * 3.0);
    }
    for (phi, speed) in [(0.0, -2.0), (PI, -0.5)] {
        let psi = crossed.frames(phi).unwrap()[FourBar::ROCKER].psi;
        assert_near("flat", psi.d1, speed, budget::IDENTITY * 2.0);
    }
}

/// A kite of two equal cranks: B is the mirror image of O in the line AC, so the rocker has twice the angle of CA.
#[test]
fn a_kite_mirrors_the_pivot() {
    for [a, d] in [[0.1, 0.3], [0.3, 0.1]] {
        let kite = kept([a, a, d, d], 0.4, Side::Left, Domain::Turn, links()).unwrap();
        for k in 0..=24 {
            let phi = 0.4 + TAU * f64::from(k) / 24.0;
            let [x, y] = kite.frames(phi).unwrap()[FourBar::ROCKER].point([d, 0.0]);
            let c = [d * 0.4_f64.cos(), d * 0.4_f64.sin()];
            let line = [a * phi.cos() - c[0], a * phi.sin() - c[1]];
            let share =
                -(c[0] * line[0] + c[1] * line[1]) / (line[0] * line[0] + line[1] * line[1]);
            // The foot of O on the line, twice as far.
            assert_near(
                "x",
                x.value,
                2.0 * (c[0] + share * line[0]),
                budget::IDENTITY,
            );
            assert_near(
                "y",
                y.value,
                2.0 * (c[1] + share * line[1]),
                budget::IDENTITY,
            );
            assert!(k % 12 == 0 || x.value.hypot(y.value) > 1e-3, "not at O");
        }
    }
}

/// Galloway's mechanism: a = d, b = c. The rocker turns once for two turns of the crank, at half its mean speed, and its angle has the closed form ψ
/// = θ/2 + asin(a/b·sin θ/2) + constant.
#[test]
fn galloways_rocker_turns_once_for_two_turns() {
    let (a, b) = (0.1, 0.25);
    let two = Domain::stroke(0.2, 0.2 + 2.0 * TAU).unwrap();
    for (side, sign) in [(Side::Left, 1.0), (Side::Right, -1.0)] {
        let galloway = kept([a, b, b, a], 0.2, side, two, links()).unwrap();
        let psi = |phi: f64| galloway.frames(phi).unwrap()[FourBar::ROCKER].psi;
        assert_near(
            "turns",
            psi(0.2 + 2.0 * TAU).value - psi(0.2).value,
            TAU,
            1e-12,
        );
        for k in 0..=48 {
            let theta = 2.0 * TAU * f64::from(k) / 48.0;
            let expected = 0.5 * theta + sign * (a / b * (0.5 * theta).sin()).asin();
            let found = psi(0.2 + theta).value - psi(0.2).value;
            assert_near("ψ", found, expected, 1e-12);
            let bent = 0.5
                + sign * 0.5 * a / b * (0.5 * theta).cos()
                    / (1.0 - (a / b * (0.5 * theta).sin()).powi(2)).sqrt();
            assert_near("ψ′", psi(0.2 + theta).d1, bent, 1e-12);
        }
        // μ at B is that of the triangle, and 0 where coupler and rocker coincide.
        assert_near(
            "μ",
            galloway.transmission_angle(0.2 + PI).unwrap().value,
            2.0 * (a / b).asin(),
            1e-12,
        );
        assert_near(
            "μ flat",
            galloway.transmission_angle(0.2 + TAU).unwrap().value,
            0.0,
            1e-7,
        );
    }
}

/// On the way to a change point it equals the plain linkage over a stroke.
#[test]
fn beside_change_points_it_is_the_plain_linkage() {
    let lengths = [0.1, 0.3, 0.1, 0.3];
    for (range, side) in [([0.3, 2.8], Side::Left), ([3.5, 5.9], Side::Right)] {
        let guided = kept(lengths, 0.0, Side::Left, Domain::Turn, links()).unwrap();
        let dimensions = guided.dimensions();
        let plain = FourBar::over_stroke(dimensions, side, range, links()).unwrap();
        for k in 0..=20 {
            let phi = plain.domain().position(f64::from(k) / 20.0);
            jointed::same_frames(&guided, &plain, phi, 1e-11);
        }
        assert!(plain.change_points().is_empty());
        assert!(plain.determined(0.1));
    }
    // A linkage that returns after two turns uses both sides.
    let once = [0.1, 0.2, 0.3, 0.4];
    let two = Domain::stroke(0.0, 2.0 * TAU).unwrap();
    let guided = kept(once, 0.0, Side::Left, two, links()).unwrap();
    assert_near("flat", guided.change_points()[0], PI, 1e-15);
    for (stroke, side) in [
        ([0.3, 2.8], Side::Left),
        ([3.5, TAU + 2.8], Side::Right),
        ([TAU + 3.5, 2.0 * TAU], Side::Left),
    ] {
        let plain = FourBar::over_stroke(guided.dimensions(), side, stroke, links()).unwrap();
        for k in 0..=20 {
            let phi = plain.domain().position(f64::from(k) / 20.0);
            jointed::same_frames(&guided, &plain, phi, 1e-11);
        }
    }
}

#[test]
fn what_has_no_branch_to_keep_is_refused() {
    let refused =
        |lengths, side, domain| spoken(kept(lengths, 0.0, side, domain, links()).unwrap_err());
    assert_eq!(
        refused([0.08, 0.25, 0.18, 0.3], Side::Left, Domain::Turn),
        "there is no change point to pass: shortest and longest link together are 0.380000 m, the other two 0.430000 m; do not \
         guide it through change points: this linkage stays on the branch on which it is assembled"
    );
    assert_eq!(
        refused([0.1, 0.2, 0.3, 0.4], Side::Left, Domain::Turn),
        "the linkage lies flat once in a turn of the crank and leaves on the other side, so it comes back after two turns; \
         drive it over a stroke, at most of two turns for the whole motion"
    );
    assert_eq!(
        refused([0.1, 0.1, 0.3, 0.3], Side::Right, Domain::Turn),
        "the rocker stands still on this side: the rocker pin stays at the crank's pivot, and the coupler lies on the crank; \
         take the other side"
    );
    // a + d = b + c, but the coupler is the shortest link: it swings through the stretched position and folds at ±120° from it.
    let error = kept([0.2, 0.1, 0.4, 0.3], 0.0, Side::Left, Domain::Turn, links()).unwrap_err();
    assert!(
        matches!(error, BuildError::Pose(PoseError::CannotAssemble { .. })),
        "{error:?}"
    );
    let folded = f64::acos((0.2 * 0.2 + 0.3 * 0.3 - 0.3 * 0.3) / (2.0 * 0.2 * 0.3));
    let inside = Domain::stroke(folded + 0.01, TAU - folded - 0.01).unwrap();
    let swings = kept([0.2, 0.1, 0.4, 0.3], 0.0, Side::Left, inside, links()).unwrap();
    jointed::turns(&swings, 7200);
    let beyond = Domain::stroke(FRAC_PI_2, TAU - folded + 0.01).unwrap();
    let error = kept([0.2, 0.1, 0.4, 0.3], 0.0, Side::Left, beyond, links()).unwrap_err();
    let BuildError::Pose(PoseError::DeadPoint { phi, joint: 2 }) = error else {
        panic!("{error:?}");
    };
    assert_near("dead point", phi, TAU - folded, budget::LIMIT_ANGLE);
    let empty = Domain::Stroke { from: 1.0, to: 1.0 };
    assert!(matches!(
        kept([0.1, 0.3, 0.1, 0.3], 0.0, Side::Left, empty, links()),
        Err(BuildError::Range(_))
    ));
    let error = kept([0.1, 0.2, 0.3, 0.4], 0.0, Side::Left, Domain::Turn, links()).unwrap_err();
    assert_eq!(error, BuildError::Dimensions(DimensionError::TwoTurns));
}
