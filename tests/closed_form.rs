//! Kinematics and reduction against textbook formulas, symmetry, and differences of their own values.

use jred::mechanism::SliderCrankDimensions;
use std::f64::consts::{PI, TAU};

use crate::support::machines::{Spec, spec};
use crate::support::{assert_near, budget, config, derivative, largest, link_of};
use jred::Domain;
use jred::machine::{Action, Link, Load, Machine, Mechanism, Reducible, Window};
use jred::mechanism::{Branch, SliderCrank};
use jred::number::Transfer;
use proptest::prelude::*;

/// Step of the differences (rad).
const STEP: f64 = 1.0 / 64.0;

fn massless() -> Link {
    Link::rotor(0.0).unwrap()
}

fn slider_only(r: f64, l: f64, mass: f64) -> Machine<SliderCrank> {
    let links = [massless(), massless(), Link::point_mass(mass).unwrap()];
    Machine::new(
        SliderCrank::new(
            SliderCrankDimensions {
                crank: r,
                rod: l,
                offset: 0.0,
            },
            Branch::Right,
            links,
        )
        .unwrap(),
    )
}

/// The largest derivative over a turn, which bounds the difference between neighbouring frames.
fn over_a_turn(f: impl Fn(f64) -> f64) -> f64 {
    largest((0..64).map(|k| f(TAU * f64::from(k) / 64.0)))
}

#[test]
fn central_slider_crank_is_the_lecture_notes_4_1() {
    let (r, l, m) = (0.07, 0.31, 1.7);
    let machine = slider_only(r, l, m);
    let lambda: f64 = r / l;
    for k in 0..100 {
        let phi = -7.0 + 0.2 * f64::from(k);
        let (sin, cos) = phi.sin_cos();
        let root = (1.0 - lambda * lambda * sin * sin).sqrt();
        // (4.1), its derivative, and the second written out by the quotient rule.
        let x = r * cos + l * root;
        let x1 = -r * sin - r * lambda * (2.0 * phi).sin() / (2.0 * root);
        let x2 = -r * cos
            - r * lambda
                * ((2.0 * phi).cos() / root
                    + lambda * lambda * (2.0 * phi).sin().powi(2) / (4.0 * root.powi(3)));
        let found = machine.mechanism().frames(phi).unwrap()[SliderCrank::SLIDER].x;
        assert_near("x", found.value, x, budget::CLOSED_FORM * l);
        assert_near("x'", found.d1, x1, budget::CLOSED_FORM * r);
        assert_near("x''", found.d2, x2, budget::CLOSED_FORM * r);
        if x1.abs() > 1e-3 * r {
            let reduced = machine.reduction(phi).unwrap();
            assert_near(
                "J",
                reduced.inertia,
                m * x1 * x1,
                budget::CLOSED_FORM * m * r * r,
            );
            assert_near(
                "J'",
                reduced.inertia_slope,
                2.0 * m * x1 * x2,
                budget::CLOSED_FORM * m * r * r,
            );
        }
    }
}

/// With a long rod the slider moves as r·cos φ, and the difference falls with 1/l.
#[test]
fn long_rod_is_a_scotch_yoke() {
    let (r, m) = (0.1, 2.0);
    let miss = |l: f64| {
        let machine = slider_only(r, l, m);
        over_a_turn(|phi| {
            let phi = phi + 0.01; // J = 0 in the dead centres
            machine.reduction(phi).unwrap().inertia - m * (r * phi.sin()).powi(2)
        })
    };
    let [near, far] = [miss(1e2), miss(1e3)];
    // J − m·r²·sin²φ = m·r²·λ·sin φ·sin 2φ + …, largest 2·sin²φ·cos φ = 4/(3√3).
    assert_near(
        "λ·4/(3√3)",
        near,
        m * r * r * 1e-3 * 4.0 / 27f64.sqrt(),
        budget::YOKE * near,
    );
    assert_near("order 1", near / far, 10.0, 10.0 * budget::YOKE);
}

#[test]
fn crank_as_a_disc_off_its_centre_follows_steiner() {
    let (mass, radius, [u, v]) = (3.0, 0.25, [0.04, -0.03]);
    let disc = link_of(mass, 0.5 * mass * radius * radius, [u, v]);
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.1,
            rod: 0.4,
            offset: 0.05,
        },
        Branch::Left,
        [disc, massless(), massless()],
    );
    let machine = Machine::new(mechanism.unwrap())
        .with_gravity([0.0, -9.81])
        .unwrap();
    let steiner = mass * (0.5 * radius * radius + u * u + v * v);
    for phi in [0.0, 0.4, 2.0, 3.9, 6.1] {
        let reduced = machine.reduction(phi).unwrap();
        assert_near("J", reduced.inertia, steiner, budget::CLOSED_FORM * steiner);
        assert_near(
            "J'",
            reduced.inertia_slope,
            0.0,
            budget::CLOSED_FORM * steiner,
        );
        assert_near(
            "J''",
            reduced.inertia_curvature,
            0.0,
            budget::CLOSED_FORM * steiner,
        );
        // A pendulum: U = m·g·(u·sin φ + v·cos φ).
        let height = u * phi.sin() + v * phi.cos();
        let lever = u * phi.cos() - v * phi.sin();
        let (energy, slope) = (reduced.potential_energy, reduced.potential_slope);
        assert_near("U", energy, mass * 9.81 * height, budget::CLOSED_FORM);
        assert_near("U'", slope, mass * 9.81 * lever, budget::CLOSED_FORM);
        assert_near(
            "load",
            reduced.load_torque(),
            -mass * 9.81 * lever,
            budget::CLOSED_FORM,
        );
    }
}

/// The work of a windowed constant torque over a turn: torque·(width − ramp), as the 3-4-5 edge has mean ½.
#[test]
fn windows_bound_a_load_and_keep_its_work() {
    for (from, to, ramp) in [
        (1.0, 2.5, 0.2),
        (5.5, 7.0, 0.3),
        (0.5, 0.5 + TAU, 0.1),
        (-9.0, -8.0, 0.5),
    ] {
        let window = Window::new(Domain::Turn, [from, to], ramp).unwrap();
        let load = Load::new(0, Action::Moment(30.0)).unwrap().within(window);
        let machine = slider_only(0.1, 0.4, 1.0).with_flywheel(1.0).unwrap();
        let machine = machine.with_load(load).unwrap();
        let count = 20_000;
        let places = (0..count).map(|k| TAU * f64::from(k) / f64::from(count));
        let work: f64 = places
            .clone()
            .map(|phi| machine.reduction(phi).unwrap().process)
            .sum();
        let work = work * TAU / f64::from(count);
        assert_near(
            "work",
            work,
            30.0 * (to - from - ramp),
            budget::WINDOW_WORK * 30.0,
        );
        let middle = 0.5 * (from + to);
        assert_near("full", window.factor(middle), 1.0, 0.0);
        assert_near("a turn on", window.factor(middle + TAU), 1.0, 0.0);
        assert_near(
            "half way up",
            window.factor(from + ramp / 2.0),
            0.5,
            budget::IDENTITY,
        );
        assert_near(
            "half way down",
            window.factor(to - ramp / 2.0),
            0.5,
            budget::IDENTITY,
        );
        for phi in places {
            let turns = (phi - from).rem_euclid(TAU);
            let factor = window.factor(phi);
            assert!((0.0..=1.0).contains(&factor), "{factor} at {phi}");
            assert!(
                turns <= to - from + 1e-9 || factor == 0.0,
                "acts outside, at {phi}"
            );
            let whole = turns > ramp + 1e-9 && turns < to - from - ramp - 1e-9;
            assert!(
                !whole || factor >= 1.0 - 1e-15,
                "not whole inside, at {phi}"
            );
        }
        for k in 0..200 {
            let phi = from + (to - from) * f64::from(k) / 200.0;
            let slope = derivative(|x| window.factor(x), phi, 1e-3);
            assert!(
                slope.abs() <= 1.875 / ramp * 1.001,
                "steeper than the law, at {phi}"
            );
        }
    }
}

fn mirrored(spec: &Spec, com: [f64; 2]) -> [f64; 2] {
    [com[0] * spec.crank, -com[1] * spec.crank]
}

/// A window scales every kind of load by the same factor.
#[test]
fn windows_scale_every_kind_of_load() {
    let window = Window::new(Domain::Turn, [0.5, 2.0], 0.4).unwrap();
    let frame = slider_only(0.1, 0.4, 1.0).mechanism().frames(0.6).unwrap()[SliderCrank::ROD];
    let part = window.factor(0.6);
    assert!(part > 0.01 && part < 0.99);
    for action in [
        Action::Force([3.0, -2.0]),
        Action::Moment(2.0),
        Action::OpposingForce(5.0),
        Action::OpposingMoment(4.0),
        Action::ViscousForce(7.0),
        Action::ViscousMoment(6.0),
    ] {
        let load = Load::new(SliderCrank::ROD, action).unwrap();
        let curves = |load: Load| {
            let c = load.reduce(&frame, 0.6);
            [c.process, c.viscous, c.coulomb]
        };
        let [whole, windowed] = [curves(load), curves(load.within(window))];
        assert!(largest(whole) > 0.0, "{action:?}");
        for (found, whole) in windowed.iter().zip(whole) {
            assert_near(
                "windowed",
                *found,
                part * whole,
                budget::CLOSED_FORM * largest([whole]),
            );
        }
    }
}

proptest! {
    #![proptest_config(config(64, 0x0001))]

    /// Mirrored at the y axis the crank goes from φ to π − φ and the right branch becomes the left one.
    #[test]
    fn branches_mirror_each_other(spec in spec(), phi in -7.0..7.0) {
        let [crank, rod, slider] = spec.links();
        let [u1, v1, u2, v2] = spec.com;
        let flip = |link: Link, com| link_of(link.mass(), link.inertia(), com);
        let links = [flip(crank, mirrored(&spec, [u1, v1])), flip(rod, mirrored(&spec, [u2, v2])), slider];
        let branch = if spec.left { Branch::Right } else { Branch::Left };
        let offset = spec.offset_ratio * spec.crank;
        let image = SliderCrank::new(SliderCrankDimensions { crank: spec.crank, rod: spec.rod(), offset }, branch, links).unwrap();
        let image = Machine::new(image).with_gravity([-spec.gravity()[0], spec.gravity()[1]]).unwrap();
        let machine = Machine::new(spec.mechanism()).with_gravity(spec.gravity()).unwrap();
        let [a, b] = [machine.reduction(phi).unwrap(), image.reduction(PI - phi).unwrap()];
        let size = over_a_turn(|phi| machine.reduction(phi).unwrap().inertia_curvature.abs());
        let size = size + machine.reduction(phi).unwrap().inertia;
        let rounding = budget::MIRROR;
        assert_near("J", b.inertia, a.inertia, rounding * size);
        assert_near("J'", b.inertia_slope, -a.inertia_slope, rounding * size);
        assert_near("J''", b.inertia_curvature, a.inertia_curvature, rounding * size);
        let scale = 1.0 + over_a_turn(|phi| machine.reduction(phi).unwrap().potential_slope);
        assert_near("U", b.potential_energy, a.potential_energy, rounding * scale);
        assert_near("U'", b.potential_slope, -a.potential_slope, rounding * scale);
    }

    /// f′, f″ and f‴ of every link's frame and points are the derivatives of f, f′ and f″.
    #[test]
    fn transfer_functions_are_derivatives(spec in spec(), phi in -7.0..7.0) {
        let mechanism = spec.mechanism();
        for link in 0..3 {
            let quantity = |phi: f64, which: usize| {
                let frame = mechanism.frames(phi).unwrap()[link];
                let [px, py] = frame.point([0.6 * spec.crank, -0.2 * spec.crank]);
                [frame.x, frame.y, px, py, frame.psi][which]
            };
            for which in 0..5 {
                let of = |phi| quantity(phi, which);
                let size = |f: fn(Transfer) -> f64| 1e-3 * spec.crank + over_a_turn(|phi| f(of(phi)));
                let here = of(phi);
                let turning = |x| {
                    let t = of(x).value;
                    // ψ may cross ±π between the samples of the difference.
                    if which == 4 { here.value + (t - here.value + PI).rem_euclid(TAU) - PI } else { t }
                };
                let budget = budget::RICHARDSON;
                assert_near("f'", here.d1, derivative(turning, phi, STEP), budget * size(|t| t.d1));
                assert_near("f''", here.d2, derivative(|x| of(x).d1, phi, STEP), budget * size(|t| t.d2));
                assert_near("f'''", here.d3, derivative(|x| of(x).d2, phi, STEP), budget * size(|t| t.d3));
            }
        }
    }

    #[test]
    fn reduced_curves_are_derivatives_of_each_other(spec in spec(), phi in -7.0..7.0) {
        let machine = spec.machine();
        let of = |phi| machine.reduction(phi).unwrap();
        let here = of(phi);
        let size = |k: usize| over_a_turn(|phi| of(phi).inertias()[k]);
        let budget = budget::RICHARDSON;
        assert_near("J'", here.inertia_slope, derivative(|x| of(x).inertia, phi, STEP), budget * size(1));
        assert_near("J''", here.inertia_curvature, derivative(|x| of(x).inertia_slope, phi, STEP), budget * size(2));
        let slope = derivative(|x| of(x).potential_energy, phi, STEP);
        assert_near("U'", here.potential_slope, slope, budget * over_a_turn(|x| of(x).potential_slope));
    }

    /// Loads by their power: force times the velocity of its point, from differences of positions.
    #[test]
    fn loads_are_power_over_speed(
        spec in spec(), phi in -7.0..7.0, link in 0usize..3, u in -1.0..1.0, v in -1.0..1.0,
        fx in -100.0..100.0, fy in -100.0..100.0,
    ) {
        let (machine, at) = (spec.bare(), [u * spec.crank, v * spec.crank]);
        let frame = |phi| machine.mechanism().frames(phi).unwrap()[link];
        let speed = |axis: usize| derivative(|phi| frame(phi).point(at)[axis].value, phi, STEP);
        let (vx, vy) = (speed(0), speed(1));
        let psi = derivative(|x| (frame(x).psi.value - frame(phi).psi.value + PI).rem_euclid(TAU), phi, STEP);
        let reduce = |action| {
            let load = Load::new(link, action).and_then(|l| l.at(at)).unwrap();
            machine.clone().with_load(load).unwrap().reduction(phi).unwrap()
        };
        let size = budget::RICHARDSON * 100.0 * (spec.crank * 3.0 + 1.0);
        assert_near("force", reduce(Action::Force([fx, fy])).process, fx * vx + fy * vy, size);
        assert_near("moment", reduce(Action::Moment(fx)).process, fx * psi, size);
        let fric = reduce(Action::OpposingForce(fx.abs()));
        assert_near("friction", fric.coulomb, fx.abs() * vx.hypot(vy), size);
        let brake = reduce(Action::OpposingMoment(fx.abs()));
        assert_near("brake", brake.coulomb, fx.abs() * psi.abs(), size);
        let oil = reduce(Action::ViscousForce(fx.abs()));
        assert_near("viscous", oil.viscous, fx.abs() * (vx * vx + vy * vy), size);
        let fan = reduce(Action::ViscousMoment(fx.abs()));
        assert_near("fan", fan.viscous, fx.abs() * psi * psi, size);
        for r in [fric, brake, oil, fan] {
            assert!(r.process == 0.0 && r.load_torque() == 0.0, "opposing loads are no signed torque");
            assert!(r.reduced_torque(1.0) <= 0.0 && r.reduced_torque(-1.0) >= 0.0);
            assert!(r.reduced_torque(0.0) == 0.0);
        }
    }
}
