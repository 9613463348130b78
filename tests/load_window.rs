//! Range of a load: a part of a turn repeats every turn, a part of a stroke does not.

use std::f64::consts::TAU;

use crate::support::budget;
use crate::support::harmonics::press;
use jred::error::Error;
use jred::machine::{Action, Link, Load, Machine, Mechanism as _, Reducible as _, Window};
use jred::mechanism::{Geneva, SliderCrank};
use jred::table::words_len;
use jred::tabulate::{Part, Request, edge_places, fill, measure, scratch_len, tabulate};
use jred::{CurveSet, Domain, Scale, Spline, curves};

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= budget::CLOSED_FORM,
        "{found} is not {expected}"
    );
}

#[test]
fn on_a_turn_and_on_a_stroke() {
    let (turn, stroke) = (
        Window::new(Domain::Turn, [1.0, 2.0], 0.2).unwrap(),
        Window::new(Domain::Stroke { from: 0.0, to: 9.0 }, [1.0, 2.0], 0.2).unwrap(),
    );
    assert!(turn.repeats() && !stroke.repeats());
    for (position, factor) in [(0.9, 0.0), (1.1, 0.5), (1.5, 1.0), (1.9, 0.5), (2.1, 0.0)] {
        near(turn.factor(position), factor);
        near(stroke.factor(position), factor);
        near(turn.factor(position + TAU), factor);
        near(turn.factor(position - 2.0 * TAU), factor);
        near(stroke.factor(position + TAU), 0.0);
        near(stroke.factor(position - TAU), 0.0);
    }
    // A stroke may be longer than 2π metres.
    let long = Window::new(Domain::Stroke { from: 0.0, to: 9.0 }, [3.0, 20.0], 1.0).unwrap();
    near(long.factor(10.0), 1.0);
    near(long.factor(3.5), 0.5);
    for (found, expected) in long.edges().into_iter().zip([3.0, 4.0, 19.0, 20.0]) {
        near(found, expected);
    }
}

#[test]
fn windows_that_are_not_possible() {
    for (from, to, ramp, words) in [
        (0.0, 0.1, 0.06, "less than 0.12"),
        (1.0, 1.0, 0.1, "width of the load's window is 0"),
        (0.0, 1.0, 0.0, "ramp of the load's window is 0"),
        (0.0, 1.0, 8.9e-6, "less than 0.000009"),
        (
            f64::NAN,
            1.0,
            0.1,
            "start of the load's window is not a finite number",
        ),
        (
            0.0,
            f64::INFINITY,
            0.1,
            "end of the load's window is not a finite number",
        ),
    ] {
        let error = Window::new(Domain::Stroke { from: 0.0, to: 9.0 }, [from, to], ramp)
            .unwrap_err()
            .to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// A reciprocating machine with a force of 10 kN in a window of a thousandth of a degree.
fn press_with_a_narrow_load() -> Machine<SliderCrank> {
    let window = Window::new(Domain::Turn, [4.0, 4.0 + 1.8e-5], 8e-6).unwrap();
    let force = Load::new(SliderCrank::SLIDER, Action::Force([-1e4, 0.0])).unwrap();
    press().with_load(force.within(window)).unwrap()
}

/// The table error of a load is found, however narrow the load is.
#[test]
fn a_narrow_load_is_not_stepped_over() {
    const CELLS: u32 = 200;
    const SET: CurveSet = curves::LOAD | curves::VISCOUS | curves::COULOMB;
    let machine = press_with_a_narrow_load();
    let height = (machine.reduction(4.000_009).unwrap().process
        - machine.reduction(3.99).unwrap().process)
        .abs();
    assert!(height > 100.0, "{height}");
    let request = Request::new(1.0)
        .with_max_speed(10.0)
        .with_max_acceleration(10.0)
        .with_max_cells(CELLS);
    let mut scratch = vec![0.0; scratch_len(CELLS, SET)];
    let mut words = vec![0.0f64; words_len::<Spline<f64>>(CELLS, SET)];
    let found = tabulate::<Spline<f64>>(
        &machine,
        SET,
        &request,
        &Scale::SI,
        &mut scratch,
        &mut words,
    );
    let Err(Error::TorqueErrorNotReached { reached, .. }) = found else {
        panic!("{found:?}")
    };
    assert!((0.9 * height..1.1 * height).contains(&reached), "{reached}");
    // The table with that many cells, measured.
    let table =
        fill::<Spline<f64>>(&machine, SET, CELLS, &Scale::SI, &mut scratch, &mut words).unwrap();
    let found = measure(&machine, &table, &request).unwrap();
    assert!(found.bound >= found.torque_error && found.torque_error > 0.9 * height);
    assert!((4.0..4.000_018).contains(&found.worst), "{}", found.worst);
}

#[test]
fn edges_are_those_of_the_mechanism_and_of_the_loads() {
    let machine = press_with_a_narrow_load();
    let edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
    assert_eq!(edges.len(), 4);
    for (found, expected) in edges
        .into_iter()
        .zip([4.0, 4.000_008, 4.000_010, 4.000_018])
    {
        near(found, expected);
    }
    // Seven positions between neighbours, and the last one.
    assert_eq!(
        edge_places(&machine)
            .filter(|phi| (4.0..4.000_019).contains(phi))
            .count(),
        32
    );
    // A part starts at its first position, and a turn wraps.
    let part = Part::new(&machine, 5.0, 10.5).unwrap();
    near(part.edge(0).unwrap(), 4.0 - 5.0 + TAU);
    assert_eq!(part.edge(4), None);
    // A Geneva drive: where its pin leaves the slot and enters it, the acceleration jumps.
    let geneva = Geneva::new(6, 0.1, [Link::MASSLESS; 2]).unwrap();
    let jump = |k: usize| {
        let edge = geneva.edge(k).unwrap();
        let wheel = |phi: f64| geneva.frames(phi).unwrap()[Geneva::WHEEL].psi.d2;
        (wheel(edge - 1e-9) - wheel(edge + 1e-9)).abs()
    };
    assert!(jump(0) > 0.1 && jump(1) > 0.1, "{} {}", jump(0), jump(1));
    assert_eq!(geneva.edge(2), None);
}

/// Positions this close have no information about the range between them: the bound is the largest error there, and little more.
#[test]
fn a_narrow_load_does_not_loosen_the_bound() {
    const CELLS: u32 = 64;
    const SET: CurveSet = curves::LOAD;
    let window = Window::new(Domain::Turn, [4.0, 4.0 + 1.8e-5], 8e-6).unwrap();
    let force = Load::new(SliderCrank::SLIDER, Action::Force([-0.01, 0.0])).unwrap();
    let machine = press().with_load(force.within(window)).unwrap();
    let request = Request::new(1.0)
        .with_max_speed(0.1)
        .with_max_acceleration(0.1)
        .with_max_cells(CELLS);
    let mut scratch = vec![0.0; scratch_len(CELLS, SET)];
    let mut words = vec![0.0f64; words_len::<Spline<f64>>(CELLS, SET)];
    let table =
        fill::<Spline<f64>>(&machine, SET, CELLS, &Scale::SI, &mut scratch, &mut words).unwrap();
    let found = measure(&machine, &table, &request).unwrap();
    assert!(found.torque_error < 1e-3, "{found:?}");
    assert!(
        (1.0..1.3).contains(&(found.bound / found.torque_error)),
        "{found:?}"
    );
}
