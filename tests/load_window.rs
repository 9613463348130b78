//! Where a load acts: the part of a turn comes again with every turn, the part of a stroke does not.

use std::f64::consts::TAU;

use crate::support::budget;
use jred::Domain;
use jred::machine::Window;

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
        (0.0, 0.1, 0.06, "outside 0.12 to inf"),
        (1.0, 1.0, 0.1, "width of the load's window is 0"),
        (0.0, 1.0, 0.0, "ramp of the load's window is 0"),
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
