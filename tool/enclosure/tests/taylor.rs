//! Taylor forms contain their functions, everywhere on their stretch.

use jred::Domain;
use jred::machine::Window;
use jred_enclosure::{Interval, REMAINDER, TaylorForm, factor};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

/// The value of a form at a distance from the middle of its stretch.
fn value(form: &TaylorForm, away: f64) -> Interval {
    let t = Interval::of(away);
    let mut sum = form.over.0[REMAINDER];
    for term in form.at.0[..REMAINDER].iter().rev() {
        sum = sum * t + *term;
    }
    sum
}

/// A form of φ and the same function in double precision.
type Pair = (fn(TaylorForm) -> TaylorForm, fn(f64) -> f64);

fn one() -> TaylorForm {
    TaylorForm::constant(1.0)
}

const FUNCTIONS: [Pair; 6] = [
    (|x| x.sin_cos().0, f64::sin),
    (|x| x.sin_cos().1 * x.sin_cos().1, |x| x.cos() * x.cos()),
    (
        |x| (one() - x.sin_cos().0.square() * 0.3).sqrt(),
        |x| (1.0 - 0.3 * x.sin() * x.sin()).sqrt(),
    ),
    (
        |x| x.sin_cos().0.over(&(one() * 2.0 + x.sin_cos().1)),
        |x| x.sin() / (2.0 + x.cos()),
    ),
    (
        |x| x.polynomial(&[1.0, -2.0, 0.0, 0.5]),
        |x| 1.0 - 2.0 * x + 0.5 * x * x * x,
    ),
    (
        |x| (x.sin_cos().0 * x).derivative(),
        |x| x.sin() + x * x.cos(),
    ),
];

#[test]
fn forms_contain_a_hundred_thousand_values() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut widest = 0.0_f64;
    for _ in 0..1000 {
        let from: f64 = random.random_range(-7.0..7.0);
        let to = from + 10.0_f64.powf(random.random_range(-6.0..-1.0));
        let middle = from.midpoint(to);
        for (form, exact) in FUNCTIONS {
            let form = form(TaylorForm::variable([from, to]));
            for _ in 0..17 {
                let x = random.random_range(from..to);
                let [found, near] = [value(&form, x - middle), Interval::around(exact(x), 1e-14)];
                assert!(
                    found.lo() <= near.hi() && near.lo() <= found.hi(),
                    "{from} {to} {x}: {found:?} {}",
                    exact(x)
                );
                widest = widest.max(found.width());
            }
        }
    }
    // The remainder of a stretch of 0.1 rad, and rounding.
    assert!(widest < 1e-8, "{widest}");
}

#[test]
fn a_stretch_over_a_bend_knows_it() {
    let bend = (TaylorForm::variable([0.9, 1.1]) - one()).magnitude();
    assert!(bend.values().contains(0.0) && bend.values().hi() >= 0.1);
    let sloped = (TaylorForm::variable([1.1, 1.3]) - one()).magnitude();
    assert!((value(&sloped, 0.1).middle() - 0.3).abs() < 1e-15 && sloped.slack(0.1) < 1e-14);
    // The speed of a point that reverses.
    let phi = TaylorForm::variable([-0.1, 0.1]);
    let speed = phi.sin_cos().0.length(&TaylorForm::constant(0.0));
    assert!(speed.values().contains(0.0) && speed.values().hi() > 0.0998);
}

#[test]
fn the_factor_of_a_window_is_the_window() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let turn = Window::new(Domain::Turn, [5.0, 7.5], 0.25).unwrap();
    let stroke = Window::new(Domain::Stroke { from: 0.0, to: 8.0 }, [1.0, 2.0], 0.5).unwrap();
    for window in [turn, stroke] {
        let mut cuts: Vec<f64> = window.edges().to_vec();
        if window.repeats() {
            cuts.extend(window.edges().map(|edge| edge - std::f64::consts::TAU));
        }
        cuts.extend([0.0, 6.25]);
        cuts.retain(|cut| (0.0..=6.25).contains(cut));
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            for _ in 0..400 {
                let at = |share: f64| pair[0] + share * (pair[1] - pair[0]);
                let [a, b] = [random.random(), random.random()].map(at);
                let stretch = match random.random_range(0..4) {
                    0 => [pair[0], b],
                    1 => [a, pair[1]],
                    2 => [pair[0], pair[1]],
                    _ => [a.min(b), a.max(b)],
                };
                if stretch[0] >= stretch[1] {
                    continue;
                }
                let form = factor(&window, stretch);
                let middle = stretch[0].midpoint(stretch[1]);
                let x = random.random_range(stretch[0]..stretch[1]);
                let found = value(&form, x - middle);
                let exact = window.factor(x);
                assert!(
                    found.lo() <= exact + 1e-14 && exact - 1e-14 <= found.hi(),
                    "{stretch:?} {x}: {found:?} {exact}"
                );
                // Of degree five, below the remainder: tight.
                assert!(found.width() < 1e-10, "{stretch:?} {found:?}");
            }
        }
        // Across an edge only its range is known.
        let across = factor(&window, [window.edges()[1] - 0.1, window.edges()[1] + 0.1]);
        assert!(across.values().contains(0.0) && across.values().contains(1.0));
    }
}
