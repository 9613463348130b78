//! The toggle press: geometry against four-bar and slider-crank, dead centres, forces, and refusals.

use jred::mechanism::BuildError;
use jred::mechanism::SliderCrankDimensions;
use jred::mechanism::TogglePressDimensions;
use std::f64::consts::TAU;

use crate::support::{assert_near, budget, config, derivative, jointed, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{Branch, RotationError, Side, SliderCrank, Standstill, TogglePress};
use proptest::prelude::*;

/// A random press: its four-bar is a crank-rocker or a drag link, by Grashof's condition.
#[derive(Clone, Debug)]
pub(crate) struct Spec {
    lengths: [f64; 4],
    pivot: [f64; 2],
    guide: f64,
    sides: (Side, Branch),
    mass: [f64; 5],
    com: [f64; 5],
}

prop_compose! {
    pub(crate) fn spec()(
        shortest in 0.03..0.15_f64,
        middle in [1.2..4.0_f64, 1.2..4.0_f64],
        stretch in 0.05..0.9_f64,
        drag_link in prop::bool::weighted(0.2),
        order in 0usize..3,
        gamma in -3.2..3.2_f64,
        guide in -0.2..0.2_f64,
        spare in 1.05..2.0_f64,
        left in any::<bool>(),
        backward in any::<bool>(),
        mass in [0.1..3.0, 0.1..3.0, 0.1..3.0, 0.1..3.0, 0.2..20.0],
        com in [-0.5..1.0, -0.5..1.5, -0.5..1.5, 0.0..1.0, -0.5..0.5],
    ) -> Spec {
        let [m, n] = middle.map(|ratio: f64| ratio * shortest);
        let longest = m.max(n) + stretch * (m + n - shortest - m.max(n));
        let mut rest = [m, n, longest];
        rest.rotate_left(order);
        let (crank, rod, upper, ground) = if drag_link {
            (rest[0], rest[1], rest[2], shortest)
        } else {
            (shortest, rest[0], rest[1], rest[2])
        };
        let pivot = [ground * gamma.cos(), ground * gamma.sin()];
        // Long enough for an upper link at any angle.
        let lower = spare * (upper + (guide - pivot[1]).abs());
        let knee = if left { Side::Left } else { Side::Right };
        let branch = if backward { Branch::Left } else { Branch::Right };
        Spec { lengths: [crank, rod, upper, lower], pivot, guide, sides: (knee, branch), mass, com }
    }
}

impl Spec {
    fn mechanism(&self) -> TogglePress {
        let links = [0, 1, 2, 3, 4].map(|k| {
            let size = self.lengths.get(k).copied().unwrap_or(0.1);
            let com = [self.com[k] * size, 0.1 * self.com[k] * size];
            link_of(self.mass[k], 0.1 * self.mass[k] * size * size, com)
        });
        TogglePress::new(
            TogglePressDimensions {
                crank: self.lengths[0],
                rod: self.lengths[1],
                upper: self.lengths[2],
                lower: self.lengths[3],
                pivot: self.pivot,
                guide: self.guide,
            },
            self.sides.0,
            self.sides.1,
            links,
        )
        .unwrap()
    }

    pub(crate) fn machine(&self) -> Machine<TogglePress> {
        let load = |link, action| Load::new(link, action).unwrap();
        Machine::new(self.mechanism())
            .with_gravity([9.7, 1.0])
            .and_then(|m| m.with_load(load(TogglePress::RAM, Action::Force([-3000.0, 20.0]))))
            .and_then(|m| m.with_load(load(TogglePress::RAM, Action::OpposingForce(40.0))))
            .and_then(|m| m.with_load(load(TogglePress::LOWER, Action::ViscousMoment(0.4))))
            .unwrap()
    }
}

proptest! {
    #![proptest_config(config(300, 0x0701))]

    /// The ram is the slider of a slider-crank whose crank is the upper link: position and chain rule, to the second order.
    #[test]
    fn ram_follows_the_slider_crank_of_the_upper_link(spec in spec(), phi in -7.0..7.0_f64) {
        let [_, _, upper, lower] = spec.lengths;
        let press = spec.mechanism();
        let frames = press.frames(phi).unwrap();
        let psi = press.four_bar().frames(phi).unwrap()[2].psi;
        let rotor = Link::rotor(1.0).unwrap();
        let offset = spec.guide - spec.pivot[1];
        let second = SliderCrank::new(SliderCrankDimensions { crank: upper, rod: lower, offset }, spec.sides.1, [rotor; 3]).unwrap();
        let x = second.frames(psi.value).unwrap()[SliderCrank::SLIDER].x;
        let ram = frames[TogglePress::RAM].x;
        let size = upper + lower + spec.pivot[0].abs();
        let fast = 1.0 + psi.d1.abs() + psi.d2.abs();
        assert_near("x", ram.value, spec.pivot[0] + x.value, budget::GOLDEN * size);
        let first = size * fast * (1.0 + x.d1.abs() / size);
        assert_near("x′", ram.d1, x.d1 * psi.d1, budget::GOLDEN * first);
        let chain = x.d2 * psi.d1 * psi.d1 + x.d1 * psi.d2;
        let second = size * fast * fast * (1.0 + (x.d1.abs() + x.d2.abs()) / size);
        assert_near("x″", ram.d2, chain, budget::GOLDEN * second);
        // The form in the documentation: x_R′ = p·ψ′·sin(χ − ψ)/cos χ.
        let chi = frames[TogglePress::LOWER].psi.value;
        let printed = upper * psi.d1 * (chi - psi.value).sin() / chi.cos();
        assert_near("printed", ram.d1, printed, budget::GOLDEN * first * 10.0);
    }

    /// The ram stops at its dead centres, moves one way between them, and they bound its stroke.
    #[test]
    fn dead_centres_are_where_the_ram_stands(spec in spec()) {
        let press = spec.mechanism();
        let ram = |phi: f64| press.frames(phi).unwrap()[TogglePress::RAM].x;
        let centres = press.dead_centres().unwrap();
        prop_assert!(centres.len() >= 2);
        let size = spec.lengths[3];
        for centre in &centres {
            let here = ram(centre.phi);
            assert_near("x", centre.ram, here.value, 0.0);
            assert_near("x′", here.d1, 0.0, 1e-7 * (size + here.d2.abs() + here.d3.abs()));
            prop_assert!((0.0..TAU).contains(&centre.phi));
        }
        // Between two neighbours the velocity keeps its sign.
        for (k, centre) in centres.iter().enumerate() {
            let next = centres.get(k + 1).map_or(centres[0].phi + TAU, |next| next.phi);
            let gap = next - centre.phi;
            if gap < 1e-3 {
                continue;
            }
            let way = (ram(next).value - centre.ram).signum();
            for j in 1..100 {
                let speed = ram(centre.phi + gap * f64::from(j) / 100.0).d1;
                prop_assert!(speed * way > -1e-9 * size, "{speed} between {centre:?} and {next}");
            }
        }
        let [top, bottom] = press.stroke().unwrap();
        let down = if spec.sides.1 == Branch::Right { 1.0 } else { -1.0 };
        for k in 0..500 {
            let x = ram(TAU * f64::from(k) / 500.0).value * down;
            prop_assert!(x <= bottom.ram * down + 1e-12 && x >= top.ram * down - 1e-12);
        }
    }

    /// Too short a lower link: the error names the angle at which it is first perpendicular to the guide.
    #[test]
    fn a_short_lower_link_is_refused_at_the_right_angle(spec in spec(), short in 0.05..0.999_f64) {
        let rotors = [Link::rotor(0.1).unwrap(); 5];
        let press = spec.mechanism();
        let off = |phi: f64| {
            let y = press.four_bar().frames(phi).unwrap()[2].point([spec.lengths[2], 0.0])[1].value;
            (spec.guide - y).abs()
        };
        let farthest = (0..20_000).map(|k| off(TAU * f64::from(k) / 20_000.0)).fold(0.0, f64::max);
        let mut lengths = spec.lengths;
        lengths[3] = short * farthest;
        let error = TogglePress::new(TogglePressDimensions { crank: lengths[0], rod: lengths[1], upper: lengths[2], lower: lengths[3], pivot: spec.pivot, guide: spec.guide }, spec.sides.0, spec.sides.1, rotors).unwrap_err();
        let BuildError::Rotation(RotationError::TooShort { phi, shortest, link, .. }) = error else {
            panic!("{error:?}")
        };
        prop_assert!(link == "lower link");
        assert_near("shortest", shortest, farthest, 1e-6 * spec.lengths[3]);
        prop_assert!(shortest >= farthest - 1e-15);
        if phi > 0.0 {
            assert_near("at the angle", off(phi), lengths[3], 1e-9);
            for k in 0..200 {
                prop_assert!(off(phi * f64::from(k) / 200.0) < lengths[3] + 1e-9);
            }
        } else {
            prop_assert!(off(0.0) >= lengths[3]);
        }
        // 1e-9 longer than the named length is sufficient.
        lengths[3] = shortest * (1.0 + 1e-9);
        let press = TogglePress::new(TogglePressDimensions { crank: lengths[0], rod: lengths[1], upper: lengths[2], lower: lengths[3], pivot: spec.pivot, guide: spec.guide }, spec.sides.0, spec.sides.1, rotors).unwrap();
        for k in 0..500 {
            prop_assert!(press.frames(TAU * f64::from(k) / 500.0).is_ok());
        }
    }
}

/// A press whose knuckle is at the guide's line at `l + r − 400 mm` beyond the stretched position.
fn press(rod: f64) -> TogglePress {
    let lengths = [0.06, rod, 0.25, 0.25];
    let rotors = [Link::rotor(0.01).unwrap(); 5];
    let sides = (Side::Right, Branch::Right);
    TogglePress::new(
        TogglePressDimensions {
            crank: lengths[0],
            rod: lengths[1],
            upper: lengths[2],
            lower: lengths[3],
            pivot: [-0.25, 0.4],
            guide: 0.4,
        },
        sides.0,
        sides.1,
        rotors,
    )
    .unwrap()
}

#[test]
fn the_stretched_links_are_no_dead_point() {
    // The knuckle passes the line: the ram is at its bottom twice, and slightly higher in between.
    let passing = press(0.35);
    jointed::turns(&passing, 1440);
    let centres = passing.dead_centres().unwrap();
    let toggles: Vec<_> = centres
        .iter()
        .filter(|c| c.cause == Standstill::Toggle)
        .collect();
    assert_eq!((centres.len(), toggles.len()), (4, 2));
    let [top, bottom] = passing.stroke().unwrap();
    assert_eq!(
        (top.cause, bottom.cause),
        (Standstill::Reversal, Standstill::Toggle)
    );
    for toggle in toggles {
        // Stretched: P, K, R in line, x_R = x_P + p + q.
        assert_near("bottom", toggle.ram, 0.25, 1e-12);
        let frames = passing.frames(toggle.phi).unwrap();
        assert_near("in line", frames[2].psi.value, frames[3].psi.value, 1e-7);
        // The upper link moves on while the ram rests.
        assert!(frames[2].psi.d1.abs() > 0.05, "{:?}", frames[2].psi);
        assert_near("ram", frames[4].x.d1, 0.0, 1e-8);
        assert!(frames[4].x.d2 < 0.0);
    }
    // The knuckle does not reach the line: one bottom, at the reversal.
    let short = press(0.335);
    let centres = short.dead_centres().unwrap();
    assert_eq!(centres.len(), 2);
    let [top, bottom] = short.stroke().unwrap();
    assert_eq!(bottom.cause, Standstill::Reversal);
    assert!(bottom.ram < 0.25 && bottom.ram > 0.2498, "{bottom:?}");
    assert_near("stroke", bottom.ram - top.ram, 0.069_468, 1e-6);
}

/// Virtual work: a force F at the ram needs the torque F·x_R′, here from differences of the position, and almost none near the stretched position.
#[test]
fn the_knuckle_multiplies_the_force() {
    let press = press(0.335);
    let [_, bottom] = press.stroke().unwrap();
    let force = Load::new(TogglePress::RAM, Action::Force([-1e5, 0.0])).unwrap();
    let machine = Machine::new(press.clone()).with_load(force).unwrap();
    let torque = |phi: f64| machine.reduction(phi).unwrap().process;
    for back in [0.05, 0.2, 0.6, 1.2] {
        let phi = bottom.phi - back;
        let slope = derivative(
            |phi| press.frames(phi).unwrap()[4].x.value,
            phi,
            1.0 / 256.0,
        );
        assert_near(
            "torque",
            torque(phi),
            -1e5 * slope,
            1e5 * budget::RICHARDSON,
        );
    }
    assert_near("at the bottom", torque(bottom.phi), 0.0, 1e-6);
    let advantage = |back: f64| -1e5 / torque(bottom.phi - back);
    assert!(
        advantage(0.1) > 10.0 * advantage(1.0),
        "{} {}",
        advantage(0.1),
        advantage(1.0)
    );
}

#[test]
fn what_cannot_turn_is_refused_with_its_reason() {
    let rotors = [Link::rotor(0.01).unwrap(); 5];
    let refused = |lengths: [f64; 4], guide| {
        let sides = (Side::Right, Branch::Right);
        TogglePress::new(
            TogglePressDimensions {
                crank: lengths[0],
                rod: lengths[1],
                upper: lengths[2],
                lower: lengths[3],
                pivot: [-0.25, 0.4],
                guide,
            },
            sides.0,
            sides.1,
            rotors,
        )
        .unwrap_err()
        .to_string()
    };
    assert_eq!(
        refused([0.06, 0.335, 0.25, 0.0], 0.4),
        "lower link length is 0, but must be greater than zero"
    );
    assert_eq!(
        refused([0.06, 0.335, 0.25, 0.25], f64::INFINITY),
        "guide is not a finite number"
    );
    let text = refused([0.2, 0.335, 0.25, 0.25], 0.4);
    assert!(
        text.starts_with(
            "the crank cannot turn fully: by Grashof's condition no link can: crank + ground (shortest and longest) = \
             0.671699 m, but must be less than rocker + coupler = 0.585000 m"
        ),
        "{text}"
    );
    let text = refused([0.06, 0.335, 0.25, 0.1], 0.4);
    assert!(
        text.starts_with(
            "the crank cannot turn fully: the lower link no longer reaches the guide at φ = "
        ),
        "{text}"
    );
}
