//! Positions at which f bends, where a value passes zero. A step ends there, so that its error is that of a smooth f.

use super::{StatePoint, Step};
use crate::number::numerics;

/// Share of a value that is rounding.
const ROUNDING: f64 = 1e-13;

/// Accuracy of a bend's position as a share of a step: the remaining effect is of second order.
const PLACE: f64 = 1e-11;

/// Distance from an end of a step, as a share of it, within which a bend lies on the end.
const ON_END: f64 = 1e-9;

/// Parts of a step at whose ends the values are evaluated.
const PARTS: usize = 4;

/// Halvings of a step in search of a value that is beyond zero only at its start.
const HALVINGS: u32 = 16;

/// The side of zero of each value.
pub(super) struct Sides {
    /// 0 for a value that has only been rounding so far.
    sides: Vec<f64>,
    /// The values at the start of the next step.
    values: Vec<f64>,
}

/// Position of a zero of a value after the start of a step.
enum ZeroCrossing {
    /// None, for steps of these lengths.
    Nowhere,
    /// At the start.
    Here,
    After(f64),
}

/// Result of a step.
pub(super) enum StepResult<const N: usize> {
    /// No bend.
    Nothing,
    /// A bend, at the end of a shorter step.
    Bend { step: Step<N>, which: usize },
}

/// Start of a step.
#[derive(Clone, Copy)]
pub(super) struct StepStart<'a, const N: usize> {
    pub(super) x: f64,
    pub(super) y: &'a [f64; N],
    pub(super) slope: [f64; N],
}

impl Sides {
    pub(super) fn at(values: Vec<f64>) -> Self {
        Self {
            sides: values.iter().map(|value| side(*value)).collect(),
            values,
        }
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.sides.is_empty()
    }

    /// Records that a value passes zero at the start of the next step, with all values there.
    pub(super) fn turn(&mut self, which: usize, values: Vec<f64>) {
        if let Some(side) = self.sides.get_mut(which) {
            *side = -*side;
        }
        self.values = values;
    }

    /// The first bend within a step, at whose end f is `to`. Without a bend, the sides are updated to its end.
    pub(super) fn pass<const N: usize, E>(
        &mut self,
        f: &impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
        bends: &impl Fn(f64, &[f64; N]) -> Result<Vec<f64>, E>,
        begin: StepStart<N>,
        whole: &Step<N>,
        to: [f64; N],
    ) -> Result<StepResult<N>, E> {
        let StepStart { x, y, slope } = begin;
        let h = whole.h;
        let between = |share: f64| hermite([y, &whole.y], [&slope, &to], h, share);
        let at = |share: f64| bends(x + share * h, &between(share));
        let mut seen = Vec::with_capacity(PARTS + 1);
        seen.push((0.0, self.values.clone()));
        for k in 1..=PARTS {
            let share = k as f64 / PARTS as f64;
            seen.push((share, at(share)?));
        }
        for k in self.excursions(&seen, at)? {
            seen.push(k);
        }
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in seen.windows(2) {
            let [(from, _), (until, values)] = pair else {
                continue;
            };
            let mut first: Option<(f64, usize)> = None;
            for (which, value) in values.iter().enumerate() {
                let now = side(*value);
                let before = self.sides[which];
                if before == 0.0 {
                    self.sides[which] = now;
                }
                if now * before >= 0.0 {
                    continue;
                }
                match place(
                    f,
                    bends,
                    (x, y, slope),
                    [from * h, until * h],
                    (which, before),
                )? {
                    ZeroCrossing::After(tau) if tau > ON_END * h && tau < h * (1.0 - ON_END) => {
                        if first.is_none_or(|(earlier, _)| tau < earlier) {
                            first = Some((tau, which));
                        }
                    }
                    ZeroCrossing::After(_) | ZeroCrossing::Here => self.sides[which] = now,
                    ZeroCrossing::Nowhere => {}
                }
            }
            if let Some((tau, which)) = first
                && let Some(step) = Step::new(f, x, tau, y, slope)?
            {
                return Ok(StepResult::Bend { step, which });
            }
        }
        if let Some((_, values)) = seen.pop() {
            self.values = values;
        }
        Ok(StepResult::Nothing)
    }

    /// Positions between the evaluated ones at which a value that approaches zero and moves away again is beyond it.
    fn excursions<E>(
        &self,
        seen: &[(f64, Vec<f64>)],
        at: impl Fn(f64) -> Result<Vec<f64>, E>,
    ) -> Result<Vec<(f64, Vec<f64>)>, E> {
        let mut found = Vec::new();
        for (which, own) in self.sides.iter().enumerate() {
            for three in seen.windows(3) {
                let [a, b, c] = [0, 1, 2].map(|k| three[k].1[which] * own);
                let bow = a - 2.0 * b + c;
                // The vertex of the parabola, which may lie on either side of the middle, and its value.
                let shift = 0.5 * (a - c) / bow;
                let least = a.min(b).min(c);
                let bottom = b - 0.125 * (a - c).powi(2) / bow;
                if bow > 0.0 && shift.abs() < 1.0 && least >= 0.0 && bottom < 0.1 * least {
                    let share = three[1].0 + shift * (three[2].0 - three[1].0);
                    found.push((share, at(share)?));
                }
            }
        }
        Ok(found)
    }
}

fn side(value: f64) -> f64 {
    if value.abs() <= ROUNDING {
        0.0
    } else {
        value.signum()
    }
}

/// The length of a step that ends at the zero of a value, which is on the side `before` at the first of two lengths and on the other side at the
/// second.
fn place<const N: usize, E>(
    f: &impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
    bends: &impl Fn(f64, &[f64; N]) -> Result<Vec<f64>, E>,
    (x, y, slope): (f64, &[f64; N], [f64; N]),
    mut ends: [f64; 2],
    (which, before): (usize, f64),
) -> Result<ZeroCrossing, E> {
    let value = |tau: f64| -> Result<f64, E> {
        let (x, y): StatePoint<N> = match Step::new(f, x, tau, y, slope)? {
            Some(step) if tau > 0.0 => (x + tau, step.y),
            _ => (x, *y),
        };
        Ok(bends(x, &y)?
            .get(which)
            .map_or(before, |value| value * before))
    };
    let mut values = [value(ends[0])?, value(ends[1])?];
    if values[0] <= 0.0 && ends[0] > 0.0 {
        (ends, values) = ([0.0, ends[0]], [value(0.0)?, values[0]]);
    }
    if values[1] >= 0.0 {
        Ok(ZeroCrossing::Nowhere)
    } else if values[0] <= 0.0 {
        // It has just passed zero, and may be beyond it for a short time.
        let mut until = (ends[1], values[1]);
        for _ in 0..HALVINGS {
            let near = 0.5 * until.0;
            let there = value(near)?;
            if there > 0.0 {
                let (ends, values) = ([near, until.0], [there, until.1]);
                return numerics::zero(value, ends, values, PLACE).map(ZeroCrossing::After);
            }
            until = (near, there);
        }
        Ok(ZeroCrossing::Here)
    } else {
        numerics::zero(value, ends, values, PLACE).map(ZeroCrossing::After)
    }
}

/// The cubic with these values and slopes at its ends.
fn hermite<const N: usize>(
    [y, z]: [&[f64; N]; 2],
    [v, w]: [&[f64; N]; 2],
    h: f64,
    share: f64,
) -> [f64; N] {
    if share <= 0.0 {
        return *y;
    }
    if share >= 1.0 {
        return *z;
    }
    let rest = 1.0 - share;
    std::array::from_fn(|i| {
        let line = y[i] + share * (z[i] - y[i]);
        let bow = rest * (h * v[i] - (z[i] - y[i])) - share * (h * w[i] - (z[i] - y[i]));
        line + share * rest * bow
    })
}
