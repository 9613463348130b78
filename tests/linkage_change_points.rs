//! General linkages through change points, on the branch of their drawing.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use jred::Domain;
use jred::machine::{
    Action, Joint, Jointed, Link, Load, Machine, MachineError, Marker, Mechanism, PoseError,
    Reducible,
};
use jred::mechanism::linkage::{Assembly, Linkage, LinkageError, Pair, Pose};
use jred::mechanism::{FourBar, Side};
use jred::number::Transfer;
use proptest::prelude::*;

use crate::four_bar::change_points::{kept, lengths};
use crate::support::{assert_near, budget, config, forces, link_of, spoken};

type Kept = Assembly<3, 4, 128, 0, 8>;

/// The four-bar as bodies and joints, from a slightly inaccurate drawing at `start`.
fn drawn(four_bar: &FourBar, start: f64) -> Result<Kept, LinkageError> {
    let frames = four_bar.frames(start)?;
    let joints = four_bar.joints(start, &frames)?;
    let pairs: Vec<Pair> = joints.iter().copied().map(Pair::Joint).collect();
    let drawing: Vec<Pose> = (frames.iter())
        .map(|frame| Pose {
            x: frame.x.value + 1e-3,
            y: frame.y.value,
            psi: frame.psi.value + 0.01,
        })
        .collect();
    Linkage::new(four_bar.links(), &pairs, 0)?.assemble_through_change_points(
        four_bar.domain(),
        start,
        &drawing,
    )
}

/// Coordinates against a closed form, each derivative relative to 1 or its size.
#[track_caller]
fn same(name: &str, found: Transfer, exact: Transfer, turns: bool) {
    same_to(budget::CHANGE_POINT, name, found, exact, turns);
}

/// The same with other tolerances.
#[track_caller]
fn same_to(errors: [f64; 4], name: &str, found: Transfer, exact: Transfer, turns: bool) {
    let mut off = found.value - exact.value;
    if turns {
        off -= (off / TAU).round() * TAU;
    }
    let pairs = [
        (off, 0.0),
        (found.d1, exact.d1),
        (found.d2, exact.d2),
        (found.d3, exact.d3),
    ];
    for (order, ((found, exact), error)) in pairs.iter().zip(errors).enumerate() {
        let size = exact.abs().max(1.0);
        assert_near(
            &format!("{name}, derivative {order}"),
            *found,
            *exact,
            error * size,
        );
    }
}

#[track_caller]
fn same_everywhere(assembly: &Kept, four_bar: &FourBar, phi: f64) {
    let [found, exact] = [assembly.frames(phi).unwrap(), four_bar.frames(phi).unwrap()];
    for (link, (found, exact)) in found.iter().zip(&exact).enumerate() {
        let name = |what| format!("φ = {phi}: {what} of link {link}");
        same(&name("x"), found.x, exact.x, false);
        same(&name("y"), found.y, exact.y, false);
        same(&name("ψ"), found.psi, exact.psi, true);
    }
}

prop_compose! {
    fn linkage()(
        kind in 0usize..10,
        p in 0.05..0.2_f64,
        wider in 1.5..3.0_f64,
        r in 0.1..0.3_f64,
        gamma in prop_oneof![Just(0.0), Just(-FRAC_PI_2), -3.2..3.2_f64],
        left in any::<bool>(),
        start in -4.0..4.0_f64,
        mass in [0.1..3.0_f64, 0.1..3.0, 0.1..3.0],
    ) -> FourBar {
        let (lengths, turns) = lengths(kind, p, wider * p, r);
        let side = if left || kind == 2 || kind == 3 { Side::Left } else { Side::Right };
        let domain = if turns { Domain::Turn } else { Domain::stroke(start, start + 2.0 * TAU).unwrap() };
        let links = [0, 1, 2].map(|k| {
            let (m, l) = (mass[k], lengths[k]);
            link_of(m, 0.1 * m * l * l, [0.4 * l, 0.1 * l])
        });
        kept(lengths, gamma, side, domain, links).unwrap()
    }
}

/// A position for the drawing, 1 rad or more from every change point.
fn clear(four_bar: &FourBar) -> f64 {
    let first = four_bar.change_points()[0];
    let from = four_bar.domain().position(0.0);
    first + 1.3 + ((from - first) / TAU).ceil() * TAU
}

proptest! {
    #![proptest_config(config(60, 0x04c1))]

    /// Parallelograms, antiparallelograms, kites, Galloway's mechanism and linkages that return after two turns, against their closed forms: at the
    /// change points, on both sides of each window's ends, and anywhere.
    #[test]
    fn linkages_pass_as_their_closed_forms(four_bar in linkage(), at in [0.0..1.0_f64, 0.0..1.0, 0.0..1.0]) {
        let assembly = drawn(&four_bar, clear(&four_bar)).unwrap();
        let flat: Vec<f64> = assembly.change_points().collect();
        prop_assert!(!flat.is_empty());
        for phi in flat {
            let exact = four_bar.change_points().into_iter();
            let off = exact.map(|exact| (phi - exact - ((phi - exact) / TAU).round() * TAU).abs());
            prop_assert!(off.fold(f64::INFINITY, f64::min) < 1e-9, "{phi}");
            for beside in [0.0, 1e-9, -1e-9, 1e-4, -1e-4, 0.01, -0.01, 0.03, -0.03, 0.1, -0.1] {
                // A stroke ends.
                let phi = match four_bar.domain() {
                    Domain::Turn => phi + beside,
                    Domain::Stroke { from, to } => (phi + beside).clamp(from, to),
                };
                same_everywhere(&assembly, &four_bar, phi);
            }
        }
        for at in at {
            same_everywhere(&assembly, &four_bar, four_bar.domain().position(at));
        }
    }

    /// The drive's work through a change point equals the change of energy: T = ½·J′·ω² + U′ at constant speed.
    #[test]
    fn the_drives_work_is_the_change_of_energy(four_bar in linkage(), omega in 1.0..20.0_f64) {
        let assembly = drawn(&four_bar, clear(&four_bar)).unwrap();
        let flat = assembly.change_points().next().unwrap();
        let weight = Load::new(FourBar::COUPLER, Action::Force([5.0, -30.0])).unwrap();
        let machine = Machine::new(assembly).with_gravity([1.0, -9.7]).and_then(|m| m.with_load(weight)).unwrap();
        let [from, to] = [flat - 0.4, flat + 0.4];
        let torque = |phi: f64| machine.reduction(phi).unwrap().torque(omega, 0.0).total();
        let h = (to - from) / 400.0;
        let weigh = |k: i32| if k == 0 || k == 400 { 1.0 } else if k % 2 == 1 { 4.0 } else { 2.0 };
        let work: f64 = (0..=400).map(|k| weigh(k) * torque(from + h * f64::from(k))).sum::<f64>() * h / 3.0;
        // By hand, from positions and velocities of the links, without J and its derivatives.
        let energy = |phi: f64| {
            let frames = machine.mechanism().frames(phi).unwrap();
            let mut sum = 0.0;
            for (k, (link, frame)) in four_bar.links().iter().zip(&frames).enumerate() {
                let [x, y] = frame.point(link.com());
                let push = if k == FourBar::COUPLER { frame.x.value * 5.0 - frame.y.value * 30.0 } else { 0.0 };
                sum += 0.5 * omega * omega * (link.mass() * (x.d1 * x.d1 + y.d1 * y.d1) + link.inertia() * frame.psi.d1.powi(2));
                sum += link.mass() * (9.7 * y.value - x.value) - push;
            }
            sum
        };
        let size = energy(from).abs().max(energy(to).abs()).max(work.abs());
        // Strokes are clamped, turns wrapped.
        if four_bar.domain() == Domain::Turn || (four_bar.domain().position(0.0) < from && to < four_bar.domain().position(1.0)) {
            assert_near("work", work, energy(to) - energy(from), budget::CHANGE_POINT_WORK * size);
        }
    }

    /// Next to the change point the joint forces require the same torque of the drive; close to it they are not computed.
    #[test]
    fn forces_hold_beside_change_points(four_bar in linkage(), near in 0.05..0.2_f64, omega in -5.0..5.0_f64, alpha in -20.0..20.0_f64) {
        let assembly = drawn(&four_bar, clear(&four_bar)).unwrap();
        let within = assembly.flat();
        let flat: Vec<f64> = assembly.change_points().collect();
        let [from, to] = [0.0, 1.0].map(|at| four_bar.domain().position(at));
        let machine = Machine::new(assembly);
        for phi in flat.into_iter().filter(|phi| from < *phi && phi + near < to) {
            forces::dalembert(&machine, phi + near, omega, alpha);
            let error = machine.forces(phi + 0.5 * within, omega, alpha).unwrap_err();
            prop_assert!(matches!(error, MachineError::Pose(PoseError::ChangePoint { .. })), "{error}");
            prop_assert!(machine.forces(phi + 2.0 * within, omega, alpha).is_ok());
        }
    }
}

fn pin(a: Marker, b: Marker) -> Pair {
    Pair::Joint(Joint::Revolute([a, b]))
}

const O: [f64; 2] = [0.0, 0.0];

/// Crank and rod of a slider-crank, and the slider on its guide.
fn slider_crank(crank: f64, rod: f64) -> Linkage<3, 4> {
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::on(0, [crank, 0.0]), Marker::on(1, O)),
        pin(Marker::on(1, [rod, 0.0]), Marker::on(2, O)),
        Pair::Joint(Joint::Prismatic([Marker::ground(O), Marker::on(2, O)])),
    ];
    let links: [Link; 3] = [
        link_of(1.2, 0.003, [0.03, 0.01]),
        link_of(0.8, 0.002, [0.05, 0.0]),
        link_of(2.5, 0.0, O),
    ];
    Linkage::new(&links, &pairs, 0).unwrap()
}

fn slider_drawing(phi: f64, lengths: f64) -> [Pose; 3] {
    let (s, c) = phi.sin_cos();
    let pose = |x, y, psi| Pose { x, y, psi };
    [
        pose(0.0, 0.0, phi),
        pose(lengths * c, lengths * s, -phi),
        pose(2.0 * lengths * c, 0.01, 0.0),
    ]
}

/// Crank and rod of equal length: the slider moves as 2·r·cos φ, through the crank's axis, and the rod turns by −φ (Cardan's circles).
#[test]
fn a_folded_slider_crank_goes_through_the_axis() {
    let r = 0.1;
    for start in [0.4, -0.9, 5.0] {
        let assembly: Kept = slider_crank(r, r)
            .assemble_through_change_points(Domain::Turn, start, &slider_drawing(start, r))
            .unwrap();
        let flat: Vec<f64> = assembly.change_points().collect();
        assert_eq!(flat.len(), 2);
        assert_near("up", flat[0], FRAC_PI_2, 1e-9);
        assert_near("down", flat[1], 1.5 * PI, 1e-9);
        for k in 0..=720 {
            let phi = TAU * f64::from(k) / 720.0 - 3.0;
            let frames = assembly.frames(phi).unwrap();
            let cos = Transfer::variable(phi).sin_cos().1;
            same("slider", frames[2].x, cos * (2.0 * r), false);
            same("rod", frames[1].psi, Transfer::variable(phi) * -1.0, true);
        }
        assert!(!assembly.determined(FRAC_PI_2 + 0.5 * assembly.flat()));
        assert!(assembly.determined(FRAC_PI_2 + 2.0 * assembly.flat()));
    }
}

/// With few stations, several of which are in a window or have one between them, every position is the same.
#[test]
fn few_stations_do_through_change_points() {
    let r = 0.1;
    let drawing = slider_drawing(0.4, r);
    let coarse: Assembly<3, 4, 3, 0, 4> = slider_crank(r, r)
        .assemble_through_change_points(Domain::Turn, 0.4, &drawing)
        .unwrap();
    let five: Assembly<3, 4, 5, 0, 4> = slider_crank(r, r)
        .assemble_through_change_points(Domain::Turn, 0.4, &drawing)
        .unwrap();
    for k in 0..=500 {
        let phi = TAU * f64::from(k) / 500.0;
        let exact = Transfer::variable(phi).sin_cos().1 * (2.0 * r);
        same("slider, 3", coarse.frames(phi).unwrap()[2].x, exact, false);
        same("slider, 5", five.frames(phi).unwrap()[2].x, exact, false);
    }
}

/// Crank and ground of nearly equal length: the rocker turns 29 times as fast as the crank in one of its change points.
#[test]
fn a_steep_antiparallelogram_is_less_exact() {
    let links = [link_of(1.0, 0.01, O); 3];
    for gamma in [0.0, 0.7] {
        let lengths = [0.28, 0.3, 0.28, 0.3];
        let four_bar = kept(lengths, gamma, Side::Right, Domain::Turn, links).unwrap();
        let assembly = drawn(&four_bar, clear(&four_bar)).unwrap();
        let places = || (0..=20_000).map(|k| TAU * f64::from(k) / 20_000.0);
        let mut largest = [1.0_f64; 4];
        for phi in places() {
            for Transfer { d1, d2, d3, .. } in four_bar.frames(phi).unwrap().iter().map(|it| it.psi)
            {
                let derivatives = [0.0, d1, d2, d3];
                largest = std::array::from_fn(|order| largest[order].max(derivatives[order].abs()));
            }
        }
        // (d + a)/(d − a) at the change point.
        assert_near("steepest", largest[1], 29.0, 0.01);
        let errors =
            std::array::from_fn(|order| budget::CHANGE_POINT_STEEP[order] * largest[order]);
        for phi in places() {
            let [found, exact] = [assembly.frames(phi).unwrap(), four_bar.frames(phi).unwrap()];
            for (found, exact) in found.iter().zip(&exact) {
                same_to(errors, &format!("x, φ = {phi}"), found.x, exact.x, false);
                same_to(errors, &format!("y, φ = {phi}"), found.y, exact.y, false);
                same_to(errors, &format!("ψ, φ = {phi}"), found.psi, exact.psi, true);
            }
        }
    }
}

/// A rod that differs from the crank by 1e-12 of its length counts as equally long.
#[test]
fn lengths_may_differ_by_their_last_digits() {
    let r = 0.1;
    for off in [1e-12, -1e-12] {
        let assembly: Kept = slider_crank(r, r * (1.0 + off))
            .assemble_through_change_points(Domain::Turn, 0.4, &slider_drawing(0.4, r))
            .unwrap();
        assert_eq!(assembly.change_points().count(), 2);
        for k in 0..=720 {
            let phi = TAU * f64::from(k) / 720.0;
            let x = assembly.frames(phi).unwrap()[2].x.value;
            assert_near("slider", x, 2.0 * r * phi.cos(), 1e-11);
        }
    }
}

/// Two folded slider-cranks on one crank: both groups change simultaneously.
#[test]
fn two_groups_may_lie_flat_together() {
    let r = 0.1;
    let guide = |body| Pair::Joint(Joint::Prismatic([Marker::ground(O), Marker::on(body, O)]));
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::on(0, [r, 0.0]), Marker::on(1, O)),
        pin(Marker::on(1, [r, 0.0]), Marker::on(2, O)),
        guide(2),
        pin(Marker::on(0, [-r, 0.0]), Marker::on(3, O)),
        pin(Marker::on(3, [-r, 0.0]), Marker::on(4, O)),
        guide(4),
    ];
    let [first, second, third] = slider_drawing(0.4, r);
    let mirror = |pose: Pose| Pose {
        x: -pose.x,
        y: -pose.y,
        ..pose
    };
    let drawing = [first, second, third, mirror(second), mirror(third)];
    let linkage: Linkage<5, 7> = Linkage::new(&[link_of(1.0, 0.01, O); 5], &pairs, 0).unwrap();
    let assembly: Assembly<5, 7, 64, 0, 2> = linkage
        .assemble_through_change_points(Domain::Turn, 0.4, &drawing)
        .unwrap();
    for k in 0..=360 {
        let phi = TAU * f64::from(k) / 360.0;
        let frames = assembly.frames(phi).unwrap();
        let x = Transfer::variable(phi).sin_cos().1 * (2.0 * r);
        same("right", frames[2].x, x, false);
        same("left", frames[4].x, x * -1.0, false);
    }
}

#[test]
fn what_is_no_change_point_is_refused() {
    let r = 0.1;
    let through = |rod: f64, start: f64| {
        let drawing = slider_drawing(start, r);
        slider_crank(r, rod)
            .assemble_through_change_points::<64, 8>(Domain::Turn, start, &drawing)
            .map(|_| ())
    };
    let error = through(0.25, 0.4).unwrap_err();
    assert_eq!(error, LinkageError::NoChangePoint);
    assert_eq!(
        spoken(error),
        "there is no change point to pass: no two branches of the linkage cross in the drive's range; assemble it without: it stays \
         on the branch on which it is drawn"
    );
    // A slightly short rod locks, a slightly long one stays on its side: neither crosses.
    for short in [1e-2, 1e-3, 1e-4] {
        let error = through(r * (1.0 - short), 0.4).unwrap_err();
        assert!(
            matches!(
                error,
                LinkageError::Pose(PoseError::DeadPoint { .. } | PoseError::BranchChange { .. })
            ),
            "{error}"
        );
    }
    assert_eq!(
        through(r * 1.01, 0.4).unwrap_err(),
        LinkageError::NoChangePoint
    );
    // A drawing at the change point does not determine a branch.
    let error = through(r, FRAC_PI_2).unwrap_err();
    assert!(
        matches!(error, LinkageError::Pose(PoseError::DeadPoint { .. })),
        "{error}"
    );
    // Two flat positions, but capacity for one.
    let error = slider_crank(r, r)
        .assemble_through_change_points::<64, 1>(Domain::Turn, 0.4, &slider_drawing(0.4, r))
        .map(|_| ())
        .unwrap_err();
    assert!(spoken(error).contains("change points"), "{error}");
    // Refused if not requested.
    let error = slider_crank(r, r)
        .assemble::<64>(Domain::Turn, 0.4, &slider_drawing(0.4, r))
        .map(|_| ())
        .unwrap_err();
    assert!(matches!(error, LinkageError::Pose(_)), "{error}");
}

proptest! {
    #![proptest_config(config(60, 0x04c2))]

    /// No linkage passes a change point without a request.
    #[test]
    fn without_a_branch_it_is_refused(four_bar in linkage(), from in 0.2..1.5_f64) {
        let flat = four_bar.change_points()[0];
        let start = flat - from;
        let before = kept_over(&four_bar, start);
        let frames = before.frames(start).unwrap();
        let joints = before.joints(start, &frames).unwrap();
        let pairs: Vec<Pair> = joints.iter().copied().map(Pair::Joint).collect();
        let drawing: Vec<Pose> = frames.iter().map(|f| Pose { x: f.x.value, y: f.y.value, psi: f.psi.value }).collect();
        let linkage: Linkage<3, 4> = Linkage::new(before.links(), &pairs, 0).unwrap();
        let strict = linkage.assemble::<32>(Domain::stroke(start, flat + 0.6).unwrap(), start, &drawing);
        let error = strict.map(|_| ()).unwrap_err();
        let LinkageError::Pose(PoseError::DeadPoint { phi, .. } | PoseError::BranchChange { phi, .. }) = error else {
            panic!("{error}");
        };
        assert_near("where", phi, flat, 1e-6);
    }
}

/// The same four-bar over a stroke with another start.
fn kept_over(four_bar: &FourBar, start: f64) -> FourBar {
    let dimensions = four_bar.dimensions();
    let mut links = [link_of(1.0, 0.01, O); 3];
    links.copy_from_slice(four_bar.links());
    let domain = Domain::stroke(start, start + 1.0).unwrap();
    FourBar::through_change_points(dimensions, Side::Left, domain, links).unwrap()
}
