//! How far a step may go before a condition becomes false, with few trials, each of which is expensive.

/// Result of a trial.
pub(super) struct Trial<T> {
    /// The trial's data.
    pub(super) what: T,
    /// Whether the condition is true.
    pub(super) holds: bool,
    /// Below zero where the condition is true, above where it is false; NaN if the distance is unknown.
    pub(super) height: f64,
}

/// A step, divided like repeated halving.
pub(super) struct Grid {
    /// The start, where the condition is true.
    pub(super) from: f64,
    /// The end, where it is false.
    pub(super) to: f64,
}

/// A grid index, and the height there.
type GridSample = (u32, f64);

impl Grid {
    const HALVINGS: u32 = 16;
    const CELLS: u32 = 1 << Self::HALVINGS;

    /// The position of grid index `k`, rounded exactly as repeated halving does.
    fn place(&self, k: u32) -> f64 {
        let (mut low, mut high) = ((0, self.from), (Self::CELLS, self.to));
        while k > low.0 && k < high.0 {
            let middle = (u32::midpoint(low.0, high.0), 0.5 * (low.1 + high.1));
            if k < middle.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        if k <= low.0 { low.1 } else { high.1 }
    }

    /// The last grid place where the condition is true before one where it is false, with the trial there; given are the height at the start and the
    /// trial at the end.
    ///
    /// For a height with a smooth zero it needs about a third of the trials of bisection: each is placed by a curve through the previous ones. After
    /// as many trials as bisection needs, it bisects the rest.
    pub(super) fn last_held<T>(
        &self,
        height: f64,
        end: Trial<T>,
        at: impl Fn(f64) -> Trial<T>,
    ) -> (f64, T) {
        let (mut low, mut high) = ((0, height), (Self::CELLS, end.height));
        let (mut stopped, mut before) = (end.what, None);
        let mut trials = 0;
        while high.0 - low.0 > 1 {
            let k = if trials < Self::HALVINGS {
                next(low, high, before)
            } else {
                u32::midpoint(low.0, high.0)
            };
            trials += 1;
            let trial = at(self.place(k));
            let here = (k, trial.height);
            if trial.holds {
                (before, low) = (Some(low), here);
            } else {
                (before, high) = (Some(high), here);
                stopped = trial.what;
            }
        }
        (self.place(low.0), stopped)
    }
}

/// The next place between two: on the parabola x(y) through them and `before`, which the newer of them has replaced, if that is sure to be monotonic
/// between them; otherwise the middle. T. R. Chandrupatla, *A new hybrid quadratic/bisection algorithm*, Advances in Engineering Software 28 (1997),
/// p. 145.
fn next(low: GridSample, high: GridSample, before: Option<GridSample>) -> u32 {
    let real = |(k, y): GridSample| (f64::from(k), y);
    let [a, b] = [low, high].map(real);
    let guess = match before.map(real) {
        None => a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1),
        Some(c) => {
            let [new, old] = if c.0 < a.0 { [a, b] } else { [b, a] };
            let share = (new.0 - old.0) / (c.0 - old.0);
            let rise = (new.1 - old.1) / (c.1 - old.1);
            if rise * rise < share && (1.0 - rise) * (1.0 - rise) < 1.0 - share {
                let part = |(x, y), p, q| x * p * q / ((y - p) * (y - q));
                part(a, b.1, c.1) + part(b, a.1, c.1) + part(c, a.1, b.1)
            } else {
                a.0.midpoint(b.0)
            }
        }
    };
    if !guess.is_finite() {
        return u32::midpoint(low.0, high.0);
    }
    // Below the guess: then the next place above mostly ends the search.
    (guess.max(0.0) as u32).clamp(low.0 + 1, high.0 - 1)
}

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// Plain bisection, the reference.
    fn halved(from: f64, to: f64, holds: impl Fn(f64) -> bool) -> f64 {
        let (mut held, mut tried) = (from, to);
        for _ in 0..16 {
            let middle = 0.5 * (held + tried);
            if holds(middle) {
                held = middle;
            } else {
                tried = middle;
            }
        }
        held
    }

    /// The place found with a height, and the number of trials.
    fn found(from: f64, to: f64, height: impl Fn(f64) -> f64) -> (f64, u32) {
        let trials = Cell::new(0);
        let trial = |x: f64| Trial {
            what: x,
            holds: height(x) <= 0.0,
            height: height(x),
        };
        let grid = Grid { from, to };
        let (held, stopped) = grid.last_held(height(from), trial(to), |x| {
            trials.set(trials.get() + 1);
            trial(x)
        });
        let cell = (to - from) / 65536.0;
        assert!(
            height(stopped) > 0.0 && (stopped - held - cell).abs() < 1e-9 * cell,
            "{held}"
        );
        (held, trials.get())
    }

    /// For a smooth height, the place equals that of bisection to the bit, with fewer than half the trials.
    #[test]
    fn a_smooth_height_is_found_where_halving_finds_it() {
        let heights: [fn(f64) -> f64; 6] = [
            |x| x - 0.3,
            |x| x * x - 0.05,
            |x| 0.5 / (0.4 - 0.7 * x) - 2.0,
            |x| x.exp() - 1.25,
            |x| (x - 0.19).max(3.0 * (x - 0.27)),
            |x| 0.9 / (1.0 - x).powi(3) - 1.7,
        ];
        for (number, height) in heights.into_iter().enumerate() {
            for (from, to) in [(0.16, 0.32), (0.0, 0.5)] {
                if height(from) > 0.0 || height(to) <= 0.0 {
                    continue;
                }
                let (held, trials) = found(from, to, height);
                let halved = halved(from, to, |x| height(x) <= 0.0);
                assert_eq!(held.to_bits(), halved.to_bits(), "height {number}");
                assert!(trials <= 8, "height {number}: {trials} trials");
            }
        }
    }

    /// A jump, a jump to an unknown height, and a kink next to a cliff: the same place as bisection, with at most twice its trials.
    #[test]
    fn a_jump_is_found_as_well() {
        let heights: [fn(f64) -> f64; 4] = [
            |x| if x <= 0.211 { -0.4 } else { 0.7 },
            |x| if x <= 0.23 { x - 1.0 } else { f64::INFINITY },
            |x| {
                if x <= 0.167 {
                    1e-3 * (x - 0.5)
                } else {
                    1e6 * x
                }
            },
            |x| if x <= 0.3199 { -1e6 } else { 1e-9 },
        ];
        for (number, height) in heights.into_iter().enumerate() {
            let (held, trials) = found(0.16, 0.32, height);
            let halved = halved(0.16, 0.32, |x| height(x) <= 0.0);
            assert_eq!(held.to_bits(), halved.to_bits(), "height {number}");
            assert!(trials <= 32, "height {number}: {trials} trials");
        }
        let unknown = |x: f64| Trial {
            what: (),
            holds: x <= 0.25,
            height: f64::NAN,
        };
        let grid = Grid { from: 0.0, to: 0.5 };
        let (held, ()) = grid.last_held(f64::NAN, unknown(0.5), unknown);
        assert_eq!(held.to_bits(), 0.25f64.to_bits());
    }
}
