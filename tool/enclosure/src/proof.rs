//! The largest error of a table, bounded over all positions by bisection of stretches and of parts of cells.

use jred::Domain;
use jred::table::Table;
use jred::table::{CellCurves, Format};

use crate::curves::Curves;
use crate::difference::{Difference, weights};
use crate::error::ProofError;
use crate::interval::Interval;
use crate::tick::Tick;

/// The range of a table, and the requirements of a proof.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'m> {
    /// Start of its range (rad, or m).
    pub start: f64,
    /// Length of its range (rad, or m).
    pub span: f64,
    /// Positions (rad, or m) where the curves are not smooth, in any turn.
    pub edges: &'m [f64],
    /// Whether the range, with its edges, repeats every turn.
    pub turns: bool,
    /// Largest speed (rad/s, or m/s).
    pub omega: f64,
    /// Largest acceleration (rad/s², or m/s²).
    pub alpha: f64,
    /// An error (N·m) that the table is known to have somewhere: smaller bounds need no refinement.
    pub known: f64,
    /// A negligible error (N·m).
    pub negligible: f64,
}

/// The proven figures of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// Upper bound of the error in the drive torque (N·m, or N) of the exactly evaluated table at every position, for any speed and acceleration of
    /// the range.
    pub bound: f64,
    /// A position near the largest error (rad, or m).
    pub worst: f64,
    /// The same for the tick, with all its rounding; `None` for a format whose arithmetic is not proven.
    pub ticked: Option<f64>,
    /// Lower bound of that upper bound (N·m, or N): the errors of the curves at some place, each with its largest weight. In a torque they add up
    /// only where their signs agree.
    pub least: f64,
    /// Number of stretches of the range.
    pub stretches: u64,
}

impl Proof {
    /// The bound that an image states: of the ticks, or of the table if the tick's arithmetic is not proven.
    pub fn stated(&self) -> f64 {
        self.ticked.unwrap_or(self.bound)
    }
}

/// Initial number of stretches.
const STRETCHES: u32 = 64;
/// Greatest number of stretches.
const MOST: u64 = 1 << 19;
/// Greatest number of halvings of a stretch.
const DEEPEST: u32 = 48;
/// Greatest number of halvings of a part of a cell.
const FINEST: u32 = 12;
/// A bound that exceeds the largest known error by at most this share is close enough.
const CLOSE: f64 = 0.005;
/// The width of the curves, as a share of the error, above which a stretch is halved.
const SLACK: f64 = 0.002;

/// Proves the error of a table, whose machine has these curves on any stretch of its range. `watch` receives the finished share of the range, and
/// returns whether to continue.
///
/// # Errors
/// Why the proof fails, and where.
pub fn prove<F: Format>(
    table: &Table<'_, F>,
    goal: &Goal<'_>,
    curves: &dyn Fn([f64; 2]) -> Result<Curves, ProofError>,
    watch: &mut dyn FnMut(f64) -> bool,
) -> Result<Proof, ProofError> {
    let domain = Domain::Stroke {
        from: 0.0,
        to: goal.span,
    };
    let cell = |index| table.cell_curves(index, domain);
    if cell(0).is_none() {
        return Err(ProofError::Layout { layout: F::NAME });
    }
    let range = [goal.omega, goal.alpha];
    let mut search = ProofSearch {
        goal,
        curves,
        cells: table.cells(),
        cell: &cell,
        tick: Tick::new::<F>(table.scale(), table.cells(), goal.span, range),
        weights: weights(range),
        steepness: Interval::of(f64::from(table.cells())) / Interval::of(goal.span),
        found: Proof {
            bound: 0.0,
            worst: goal.start,
            ticked: Some(0.0),
            least: 0.0,
            stretches: 0,
        },
    };
    let cuts = cuts(goal);
    for pair in cuts.windows(2) {
        let parts = ((pair[1] - pair[0]) / goal.span * f64::from(STRETCHES))
            .ceil()
            .max(1.0);
        let at = |k: f64| {
            if k < parts {
                pair[0] + (pair[1] - pair[0]) * (k / parts)
            } else {
                pair[1]
            }
        };
        let mut k = 0.0;
        while k < parts {
            if !watch((at(k) - goal.start) / goal.span) {
                return Err(ProofError::Stopped);
            }
            search.stretch([at(k), at(k + 1.0)], 0)?;
            k += 1.0;
        }
    }
    if search.tick.is_none() {
        search.found.ticked = None;
    }
    Ok(search.found)
}

/// The start of the range, the edges within it, and its end.
fn cuts(goal: &Goal<'_>) -> Vec<f64> {
    use std::f64::consts::TAU;
    let end = goal.start + goal.span;
    let within = goal.edges.iter().flat_map(|edge| {
        let turns = if goal.turns {
            ((goal.start - edge) / TAU).floor()
        } else {
            0.0
        };
        let count = if goal.turns { 3 } else { 1 };
        (0..count).map(move |k| edge + (turns + f64::from(k)) * TAU)
    });
    let mut cuts: Vec<f64> = within
        .filter(|edge| goal.start < *edge && *edge < end)
        .collect();
    cuts.extend([goal.start, end]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts
}

/// Whether a bound does not exceed a limit; false for NaN.
fn within(bound: f64, limit: f64) -> bool {
    bound <= limit
}

struct ProofSearch<'s> {
    goal: &'s Goal<'s>,
    curves: &'s dyn Fn([f64; 2]) -> Result<Curves, ProofError>,
    cells: u32,
    cell: &'s dyn Fn(u32) -> Option<CellCurves>,
    tick: Option<Tick>,
    weights: [f64; 5],
    /// Cells per rad, or m.
    steepness: Interval,
    found: Proof,
}

/// The bounds of one part.
#[derive(Clone, Copy)]
struct StretchBounds {
    most: f64,
    ticked: f64,
    worst: f64,
}

impl ProofSearch<'_> {
    /// Bounds below this need no refinement.
    fn enough(&self) -> f64 {
        let known = self.goal.known.max(self.found.least);
        (known * (1.0 + CLOSE)).max(self.goal.negligible)
    }

    /// Bounds the error on a stretch, halving it where that improves the bound.
    fn stretch(&mut self, stretch: [f64; 2], depth: u32) -> Result<(), ProofError> {
        self.found.stretches += 1;
        if self.found.stretches > MOST {
            return Err(ProofError::TooLong { most: MOST });
        }
        let [from, to] = stretch;
        let middle = from.midpoint(to);
        let halves = from < middle && middle < to && depth < DEEPEST;
        let curves = match (self.curves)(stretch) {
            Ok(curves) => curves,
            Err(ProofError::Stopped) => return Err(ProofError::Stopped),
            Err(why) if !halves || (to - from) < 1e-9 * self.goal.span => return Err(why),
            Err(_) => return self.halve(stretch, middle, depth),
        };
        let half = (to - middle).max(middle - from).next_up();
        let forms = [
            &curves.inertia,
            &curves.inertia_slope,
            &curves.load,
            &curves.viscous,
            &curves.coulomb,
        ];
        let slack: f64 = forms
            .iter()
            .zip(self.weights)
            .map(|(form, w)| form.slack(half) * w)
            .sum();
        // NaN is not sharp.
        let sharp = slack <= SLACK * self.enough();
        let finest = if sharp || !halves { FINEST } else { 2 };
        let mut parts = Vec::new();
        for (index, cell) in self.cells_of(stretch) {
            let part = self.part(&curves, index, &cell, stretch, finest);
            if !sharp && halves && !within(part.most, self.enough()) {
                return self.halve(stretch, middle, depth);
            }
            parts.push(part);
        }
        for part in parts {
            if !part.most.is_finite() || part.ticked.is_nan() {
                return Err(ProofError::Unbounded { phi: part.worst });
            }
            if part.most > self.found.bound {
                (self.found.bound, self.found.worst) = (part.most, part.worst);
            }
            self.found.ticked = self.found.ticked.map(|most| most.max(part.ticked));
        }
        Ok(())
    }

    fn halve(&mut self, [from, to]: [f64; 2], middle: f64, depth: u32) -> Result<(), ProofError> {
        self.stretch([from, middle], depth + 1)?;
        self.stretch([middle, to], depth + 1)
    }

    /// The cells of a stretch, with one more where rounding may reach into it.
    fn cells_of(&self, [from, to]: [f64; 2]) -> Vec<(u32, CellCurves)> {
        let place = |phi: f64| (phi - self.goal.start) / self.goal.span * f64::from(self.cells);
        let last = self.cells - 1;
        let first = (place(from) - 1e-9).floor().max(0.0) as u32;
        let end = (place(to) + 1e-9).floor().max(0.0) as u32;
        (first.min(last)..=end.min(last))
            .filter_map(|index| Some((index, (self.cell)(index)?)))
            .collect()
    }

    /// The largest error of one cell on a stretch.
    fn part(
        &mut self,
        curves: &Curves,
        index: u32,
        cell: &CellCurves,
        [from, to]: [f64; 2],
        finest: u32,
    ) -> StretchBounds {
        let middle = from.midpoint(to);
        let (start, span) = (self.goal.start, self.goal.span);
        let cells = f64::from(self.cells);
        // The ends of the cell, beyond which there is only rounding.
        let beside = 1e-15 * (start.abs() + span);
        let ends = [f64::from(index), f64::from(index + 1)].map(|k| start + span * (k / cells));
        let low = if index == 0 {
            from
        } else {
            from.max(ends[0] - beside)
        };
        let high = if index + 1 == self.cells {
            to
        } else {
            to.min(ends[1] + beside)
        };
        let difference = Difference {
            curves,
            cell,
            weights: self.weights,
            steepness: self.steepness,
            place: (Interval::of(middle) - Interval::of(start)) * self.steepness
                - Interval::of(f64::from(index))
                - Interval::of(cell.centre),
        };
        let added = self.tick.map_or(0.0, |tick| tick.error(cell));
        let mut found = StretchBounds {
            most: 0.0,
            ticked: 0.0,
            worst: low,
        };
        if low >= high {
            return found;
        }
        let mut open = vec![([low - middle, high - middle], 0)];
        while let Some(([a, b], depth)) = open.pop() {
            let bounds = difference.bounds([a, b]);
            self.found.least = self.found.least.max(bounds.least);
            let centre = a.midpoint(b);
            let fine = depth >= finest || !(a < centre && centre < b);
            if !fine && !within(bounds.most, self.enough()) {
                open.extend([([a, centre], depth + 1), ([centre, b], depth + 1)]);
                continue;
            }
            if !within(bounds.most, found.most) {
                (found.most, found.worst) = (bounds.most, middle + centre);
            }
            let ticked = (bounds.most + added).next_up();
            if ticked.is_nan() || ticked > found.ticked {
                found.ticked = ticked;
            }
        }
        found
    }
}
