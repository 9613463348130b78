//! The Geneva drive: the sourcebook's formulas and figures, dwell and engagement, joints and forces.

use crate::support::spoken;
use jred::machine::PoseError;
use jred::mechanism::BuildError;
use jred::number::RangeError;
use std::f64::consts::{PI, TAU};

use crate::support::machines::loaded;
use crate::support::{assert_near, budget, config, derivative, largest, link_of};
use jred::machine::{Action, Joint, Jointed, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{DimensionError, Geneva};
use proptest::prelude::*;

const WHEEL: usize = Geneva::WHEEL;

fn massless() -> [Link; 2] {
    [0.0; 2].map(|inertia| Link::rotor(inertia).unwrap())
}

fn mechanism(slots: u32) -> Geneva {
    Geneva::new(slots, 0.2, massless()).unwrap()
}

#[test]
fn wheel_textbook() {
    for slots in [3, 4, 6, 12, 24] {
        let geneva = mechanism(slots);
        let n = f64::from(slots);
        let m = (PI / n).sin();
        assert_eq!(geneva.slots(), slots);
        assert_near("distance", geneva.centres(), 0.2, 0.0);
        assert_near("r", geneva.crank(), 0.2 * m, budget::CLOSED_FORM);
        // φ is known to 2⁻⁵³ of thirty turns, which each next derivative enlarges.
        let psi = |phi| geneva.frames(phi).unwrap()[WHEEL].psi;
        let engaged = || (-100..=100).map(|k| psi(0.004_99 * geneva.engagement() * f64::from(k)));
        let largest = [
            largest(engaged().map(|psi| psi.d1)).max(1.0),
            largest(engaged().map(|psi| psi.d2)).max(1.0),
            largest(engaged().map(|psi| psi.d3)).max(1.0),
        ];
        for turn in [-7, -1, 0, 1, 5, 30] {
            for k in -20..=20 {
                let angle = 0.999_999 * (PI / 2.0 - PI / n) * f64::from(k) / 20.0;
                let psi = geneva.frames(TAU * f64::from(turn) + angle).unwrap()[WHEEL].psi;
                let (sin, cos) = angle.sin_cos();
                let square = 1.0 + m * m - 2.0 * m * cos;
                let delta = (m * sin / (1.0 - m * cos)).atan();
                let expected = PI - TAU / n * f64::from(turn) - delta;
                assert_near("ψ", psi.value, expected, budget::GOLDEN * largest[0]);
                let first = -m * (cos - m) / square;
                assert_near("ψ'", psi.d1, first, budget::GOLDEN * largest[1]);
                let second = m * (1.0 - m * m) * sin / (square * square);
                assert_near("ψ''", psi.d2, second, budget::GOLDEN * largest[2]);
            }
        }
    }
}

/// Largest speed and acceleration, and the acceleration at entry, as tabulated in handbooks (4 slots: 2.41, 5.41, 1.00).
#[test]
fn peak_figures_are_the_published_ones() {
    for (slots, speed, acceleration, entry) in [
        (3, 6.46, 31.44, 1.732),
        (4, 2.41, 5.41, 1.000),
        (5, 1.43, 2.30, 0.727),
        (6, 1.00, 1.35, 0.577),
        (8, 0.620, 0.700, 0.414),
        (10, 0.447, 0.465, 0.325),
        (12, 0.349, 0.348, 0.268),
    ] {
        let geneva = mechanism(slots);
        let figure = |what: &str, found: f64, expected: f64| {
            assert_near(
                &format!("{what}, {slots} slots"),
                found,
                expected,
                budget::HANDBOOK * expected,
            );
        };
        figure("speed", geneva.largest_speed(), speed);
        figure("acceleration", geneva.largest_acceleration(), acceleration);
        let psi = |phi| geneva.frames(phi).unwrap()[WHEEL].psi;
        let half = geneva.engagement() / 2.0;
        let inside = half * (1.0 - 1e-12);
        figure("entry", -psi(-inside).d2, entry);
        figure("exit", psi(inside).d2, entry);
        assert_near(
            "entry",
            -psi(-inside).d2,
            (PI / f64::from(slots)).tan(),
            budget::GENEVA_STEP,
        );
        // On a grid the peaks match the formulas: second order in a step of 1e-4.
        let grid = |f: &dyn Fn(f64) -> f64| {
            largest((-10_000..=10_000).map(|k| f(half * f64::from(k) / 10_000.0)))
        };
        let most = grid(&|phi| psi(phi).d1);
        assert_near(
            "peak ψ'",
            most,
            geneva.largest_speed(),
            budget::GENEVA_PEAK * most,
        );
        let most = grid(&|phi| psi(phi).d2);
        assert_near(
            "peak ψ''",
            most,
            geneva.largest_acceleration(),
            budget::GENEVA_PEAK * most,
        );
    }
}

#[test]
fn wheel_dwells_and_advances_by_one_slot_a_turn() {
    for slots in [3, 5, 8] {
        let geneva = mechanism(slots);
        let step = TAU / f64::from(slots);
        let half = geneva.engagement() / 2.0;
        assert_near(
            "engagement",
            geneva.engagement(),
            PI - step,
            budget::CLOSED_FORM,
        );
        let psi = |phi| geneva.frames(phi).unwrap()[WHEEL].psi;
        for turn in -4..9 {
            let start = TAU * f64::from(turn);
            // From exit to the next entry, across the end of the turn, nothing moves.
            let rest = psi(start + half * (1.0 + 1e-9));
            for share in [0.01, 0.3, 0.5, 0.500_001, 0.9, 0.99] {
                let now = psi(start + half + share * (TAU - 2.0 * half));
                assert_near("dwell", now.value, rest.value, budget::POSITION);
                assert!([now.d1, now.d2, now.d3].iter().all(|d| *d == 0.0));
            }
            let next = psi(start + TAU + half * (1.0 + 1e-9));
            assert_near("step", next.value - rest.value, -step, budget::POSITION);
        }
    }
}

#[test]
fn inertia_is_continuous_and_its_slope_too() {
    let (crank, wheel) = (0.002, 0.03);
    let links = [crank, wheel].map(|inertia| Link::rotor(inertia).unwrap());
    let geneva = Geneva::new(6, 0.2, links).unwrap();
    let half = geneva.engagement() / 2.0;
    let speed = geneva.largest_speed();
    let machine = Machine::new(geneva);
    let at = |phi| machine.reduction(phi).unwrap().inertias();
    assert_near(
        "J at φ = 0",
        at(0.0)[0],
        crank + wheel * speed * speed,
        budget::CLOSED_FORM,
    );
    for edge in [-half, half] {
        let (before, after) = (at(edge - 1e-9), at(edge + 1e-9));
        assert_near("J", after[0], before[0], budget::GENEVA_EDGE * wheel);
        assert_near("J'", after[1], before[1], budget::GENEVA_EDGE * wheel);
        // J″ jumps by 2·J₂·tan²(π/n) = ⅔·J₂.
        let jump = (after[2] - before[2]).abs();
        assert_near(
            "J'' jumps",
            jump,
            wheel * 2.0 / 3.0,
            budget::GENEVA_STEP * wheel,
        );
    }
    for phi in [-0.9, -0.4, 0.2, 0.7] {
        let slope = derivative(|phi| at(phi)[0], phi, 1.0 / 256.0);
        assert_near("J'", at(phi)[1], slope, budget::RICHARDSON * wheel);
        let slope = derivative(|phi| at(phi)[1], phi, 1.0 / 256.0);
        assert_near("J''", at(phi)[2], slope, budget::RICHARDSON * wheel);
    }
}

/// The force on the pin: J₂·ψ̈ over the pin's distance from the wheel's axis; in the dwell the locking arc holds the load.
#[test]
fn pin_and_locking_arc_carry_the_wheel() {
    let (slots, centres, inertia, load) = (4, 0.2, 0.05, 3.0);
    let links = [0.001, inertia].map(|inertia| Link::rotor(inertia).unwrap());
    let geneva = Geneva::new(slots, centres, links).unwrap();
    let (r, half) = (geneva.crank(), geneva.engagement() / 2.0);
    let moment = Load::new(WHEEL, Action::Moment(load)).unwrap();
    let machine = Machine::new(geneva).with_load(moment).unwrap();
    let omega = 8.0;
    for turn in [0.0, 1.0, 2.0, 7.0] {
        for angle in [-0.7, -0.2, 0.4, 0.78] {
            let phi = angle + TAU * turn;
            let forces = machine.forces(phi, omega, 0.0).unwrap();
            let psi = machine.mechanism().frames(phi).unwrap()[WHEEL].psi;
            let (sin, cos) = angle.sin_cos();
            let distance = (centres - r * cos).hypot(r * sin);
            let force = (inertia * psi.d2 * omega * omega - load) / distance;
            let [x, y] = forces.reactions[2].force;
            let size = budget::REACTIONS * (force.abs() + load / distance);
            assert_near("pin force", x.hypot(y), force.abs(), size);
            assert_near("wheel's bearing x", forces.reactions[1].force[0], -x, size);
            assert_near("wheel's bearing y", forces.reactions[1].force[1], -y, size);
        }
        for angle in [half + 0.01, 2.0, PI - 1e-3, PI + 1e-3, TAU - half - 0.01] {
            let forces = machine.forces(angle + TAU * turn, omega, 0.0).unwrap();
            assert_near(
                "locking moment",
                forces.reactions[2].moment,
                -load,
                budget::REACTIONS,
            );
            assert_near("drive", forces.drive, 0.0, budget::REACTIONS);
        }
    }
}

#[test]
fn joints_keep_number_and_order() {
    let geneva = mechanism(5);
    for k in 0..100 {
        let phi = -13.0 + 0.29 * f64::from(k);
        let joints = geneva.joints(phi, &geneva.frames(phi).unwrap()).unwrap();
        let engaged = (phi - TAU * (phi / TAU).round()).abs() < geneva.engagement() / 2.0;
        assert_eq!(joints.len(), 3);
        assert_eq!(matches!(joints[2], Joint::PinInSlot(_)), engaged);
        assert_eq!(matches!(joints[2], Joint::Transmission(_)), !engaged);
    }
}

prop_compose! {
    pub(crate) fn machines()(
        slots in 3..=24_u32,
        centres in 0.02..0.6_f64,
        inertia in [1e-4..0.1, 1e-4..0.1],
        mass in [0.1..3.0, 0.1..9.0],
        com in [-0.5..1.0, -0.3..0.3],
        down in 0.0..6.2_f64,
        load in [-30.0..30.0, 0.0..10.0, 0.0..2.0],
    ) -> Machine<Geneva> {
        let links = [
            link_of(mass[0], inertia[0], com.map(|c: f64| c * centres)),
            link_of(mass[1], inertia[1], [0.0, 0.0]),
        ];
        let loads = [Action::Moment(load[0]), Action::OpposingMoment(load[1]), Action::ViscousMoment(load[2])];
        loaded(Geneva::new(slots, centres, links).unwrap(), down, WHEEL, loads)
    }
}

proptest! {
    #![proptest_config(config(200, 43))]

    #[test]
    fn reduction_repeats_with_every_turn(machine in machines(), phi in -3.2..3.2_f64, turns in 1..40_i32) {
        let now = machine.reduction(phi).unwrap();
        let later = machine.reduction(phi + TAU * f64::from(turns)).unwrap();
        let scale = largest(now.inertias());
        for (a, b) in now.inertias().into_iter().zip(later.inertias()) {
            // φ is known to 2⁻⁵³ of forty turns; next to the edge, J″ has its step.
            let edge = (phi.abs() - machine.mechanism().engagement() / 2.0).abs() < 1e-9;
            prop_assert!(edge || (a - b).abs() <= budget::A_TURN_LATER * scale, "{a} {b}");
        }
        prop_assert!((now.load_torque() - later.load_torque()).abs() <= budget::A_TURN_LATER * 300.0);
    }

}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |slots, centres, links| Geneva::new(slots, centres, links).unwrap_err();
    for slots in [0, 2, 25] {
        let what = "number of slots";
        let error = RangeError::OutOfRange {
            what,
            value: f64::from(slots),
            min: 3.0,
            max: 24.0,
        };
        assert_eq!(new(slots, 0.2, massless()), error.into());
    }
    assert_eq!(
        new(4, -0.2, massless()).to_string(),
        "centre distance is -0.2, but must be greater than zero"
    );
    let off = link_of(2.0, 0.1, [0.03, 0.04]);
    let error = new(4, 0.2, [off, off]);
    assert_eq!(
        error,
        BuildError::Dimensions(DimensionError::OffAxis {
            link: "wheel",
            distance: 0.05
        })
    );
    assert_eq!(
        spoken(error),
        "the centre of mass of the wheel is 0.05 m off its axis, so its weight does not repeat with every turn of the \
         drive link; balance it: centre of mass [0, 0]"
    );
    // The crank may be unbalanced: it turns with φ.
    let [_, wheel] = massless();
    assert!(Geneva::new(4, 0.2, [off, wheel]).is_ok());
    assert_eq!(
        mechanism(4).frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("crank angle"))
    );
}

/// A mechanism borrowed by a machine has its own edges: ∓(π/2 − π/n).
#[test]
fn a_mechanism_lent_has_its_edges() {
    let geneva = mechanism(6);
    let lent = Machine::new(&geneva);
    let edges: Vec<f64> = (0..).map_while(|k| lent.edge(k)).collect();
    assert!(!edges.is_empty());
    for edge in edges {
        let off = (edge + PI).rem_euclid(TAU) - PI;
        assert_near(
            "engagement",
            off.abs(),
            PI / 2.0 - PI / 6.0,
            budget::CLOSED_FORM * TAU,
        );
    }
}
