//! The ranges of a machine's tables: the whole range, or the pieces between its edges.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use jred::error::Error;
use jred::machine::{Machine, Reducible as _};
use jred::mechanism::SliderCrank;
use jred::table::{Format, TableError};
use jred::tabulate::{self, Part};
use jred::{Cubic, CurveSet, Domain, Q31, Quadratic, Rows16, Spline, Spline16, curves};

use crate::candidate::SearchResult;
use crate::choice::{LayoutName, Number, PLACES};
use crate::directions::MachineByDirection;
use crate::reference::Range;
use crate::search::{Search, TableRequirements};

/// Edges closer than this share of the range are one.
const SAME: f64 = 1e-9;

/// Most knots that are cached over the searches of all pieces: 160 MB.
const MOST_KNOTS: usize = 1 << 20;

/// The pieces between edges: of a turn from the first edge to the same one a turn later, of a stroke from end to end; empty without an edge inside.
/// Edges are rounded to phases, because firmware selects the piece by them.
pub(crate) fn between(domain: Domain, edges: &[f64]) -> Vec<[f64; 2]> {
    let same = SAME * domain.span();
    let phase = |edge: &f64| f64::from(domain.phase(*edge).to_bits()) / 4_294_967_296.0;
    let mut edges: Vec<f64> = edges
        .iter()
        .map(|edge| domain.position(phase(edge)))
        .collect();
    match domain {
        Domain::Turn => {
            // An edge just before a whole turn is at its start.
            for edge in edges.iter_mut().filter(|edge| TAU - **edge < same) {
                *edge = 0.0;
            }
        }
        Domain::Stroke { from, to } => {
            edges.retain(|edge| (from + same..=to - same).contains(edge));
            if !edges.is_empty() {
                edges.extend([from, to]);
            }
        }
    }
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|later, earlier| *later - *earlier < same);
    if let (Domain::Turn, Some(first)) = (domain, edges.first()) {
        edges.push(first + TAU);
    }
    edges.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The searches of all ranges of a machine: of the whole, or of each piece.
pub(crate) struct Searches<'m> {
    pub(crate) machine: &'m MachineByDirection,
    /// The same machine in closed form, if it has one.
    pub(crate) crank: Option<Machine<SliderCrank>>,
    pub(crate) goal: TableRequirements,
    set: CurveSet,
    pub(crate) ranges: Vec<Search<'m>>,
}

impl<'m> Searches<'m> {
    /// Searches of these pieces, or of the whole range if there are no pieces.
    ///
    /// # Errors
    /// The machine cannot be tabulated.
    pub(crate) fn new(
        machine: &'m MachineByDirection,
        crank: Option<Machine<SliderCrank>>,
        pieces: &[[f64; 2]],
        goal: TableRequirements,
    ) -> Result<Self, Error> {
        let domain = machine.domain();
        if domain == Domain::Turn {
            machine.check_repeats()?;
        }
        let set = tabulate::curves_in_use(machine, PLACES)?;
        let most_knots = MOST_KNOTS / pieces.len().max(1);
        let search = |range| Search::new(range, set, goal, most_knots);
        let ranges = if pieces.is_empty() {
            vec![search(Range::Whole(machine))?]
        } else {
            let part = |&[from, to]: &[f64; 2]| search(Range::Part(Part::new(machine, from, to)?));
            pieces.iter().map(part).collect::<Result<_, Error>>()?
        };
        Ok(Self {
            machine,
            crank,
            goal,
            set,
            ranges,
        })
    }

    /// Result of the search for a number type and one of its layouts.
    pub(crate) fn answer(&self, number: Number, layout: LayoutName) -> Result<SearchResult, Error> {
        match (number, layout) {
            (Number::F32, LayoutName::Harmonic) => {
                SearchResult::together(self.ranges.iter().map(Search::harmonics), number, layout)
            }
            (Number::F32, LayoutName::SliderCrank) => {
                let ranges = self.ranges.iter().zip(&self.crank);
                let answers = ranges.map(|(range, crank)| range.slider_crank(crank));
                SearchResult::together(answers, number, layout)
            }
            (Number::F32, LayoutName::Cubic) => self.run::<Cubic<f32>>(number, layout),
            (Number::F32, LayoutName::Quadratic) => self.run::<Quadratic<f32>>(number, layout),
            (Number::F32, _) => self.run::<Spline<f32>>(number, layout),
            (Number::I32, LayoutName::Spline16) => self.run::<Spline16>(number, layout),
            (Number::I32, LayoutName::Cubic) => self.run::<Cubic<Q31>>(number, layout),
            (Number::I32, LayoutName::Quadratic) => self.run::<Quadratic<Q31>>(number, layout),
            (Number::I32, _) => self.run::<Spline<Q31>>(number, layout),
            (Number::I16, _) => self.run::<Rows16>(number, layout),
        }
    }

    /// The tables of this type and layout.
    ///
    /// # Errors
    /// Errors of the machine.
    pub(crate) fn run<F: Format>(
        &self,
        number: Number,
        layout: LayoutName,
    ) -> Result<SearchResult, Error> {
        let reciprocal = if self.goal.reciprocal && F::accepts(curves::RECIPROCAL) {
            curves::RECIPROCAL
        } else {
            0
        };
        let set = self.set | reciprocal;
        let mut scale = number.scale(self.machine, self.goal.range)?;
        let mut steps = vec![None; self.ranges.len()];
        // Pieces share their machine units, which here depend on the width of a cell.
        if F::WHOLE_FACTOR && self.ranges.len() > 1 {
            let span = self.machine.domain().span();
            let shares = self.ranges.iter().map(|range| range.domain.span() / span);
            let Some(common) = common_cells(&shares.collect::<Vec<f64>>()) else {
                return Ok(SearchResult::Refused(TableError::PieceUnits.into()));
            };
            scale = scale.for_cells(common.0, span);
            steps = common.1.into_iter().map(Some).collect();
        }
        let ranges = self.ranges.iter().zip(steps);
        let answers = ranges.map(|(range, step)| range.run::<F>(set, scale, step));
        SearchResult::together(answers, number, layout)
    }
}

/// A number of cells for the whole range, which defines a common width, and for each piece (given as a share of the range) the fewest cells of this
/// width, or of a whole part of it, that fill the piece. The number with the fewest cells in total is chosen.
fn common_cells(shares: &[f64]) -> Option<(u32, Vec<u32>)> {
    /// Machine units grow less for narrower cells, but then there are fewer whole parts to choose from.
    const TOTAL: RangeInclusive<u32> = 16..=64;
    /// Relative tolerance: edges are rounded to phases, and a model accepts a velocity factor that is whole to 1e-6.
    const WHOLE: f64 = 6e-7;
    // All shares as whole parts of one number, the shortest at least one part.
    let whole = |parts: u32| {
        let shares = shares.iter().map(|share| {
            let exact = share * f64::from(parts);
            let near = exact.round();
            (near >= 1.0 && (exact - near).abs() <= WHOLE * near).then_some(near as u64)
        });
        Some((u64::from(parts), shares.collect::<Option<Vec<u64>>>()?))
    };
    let (parts, shares) = (1..=1 << 16).find_map(whole)?;
    let steps = |total: u32| {
        let step = |share: &u64| {
            let cells = share * u64::from(total);
            (cells / gcd(cells, parts)) as u32
        };
        (total, shares.iter().map(step).collect())
    };
    TOTAL.map(steps).min_by_key(|(_, steps): &(u32, Vec<u32>)| {
        steps.iter().map(|step| step.max(&4)).sum::<u32>()
    })
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_cut_at_its_edges_and_a_stroke_at_its_ends_too() {
        let edges = [-0.5, 1.0, 1.0 + 1e-12, TAU + 2.0];
        let turn = between(Domain::Turn, &edges);
        let last = [TAU - 0.5, TAU + 1.0];
        assert_eq!(turn.len(), 3);
        for (piece, expected) in turn.iter().zip([[1.0, 2.0], [2.0, TAU - 0.5], last]) {
            // One unit of a phase.
            let near = |k: usize| (piece[k] - expected[k]).abs() < 1.5e-9;
            assert!(near(0) && near(1), "{piece:?}");
        }
        let domain = Domain::Stroke { from: 0.0, to: 1.5 };
        let stroke = between(domain, &edges);
        assert_eq!(stroke.len(), 2);
        assert!((stroke[0][1] - 1.0).abs() < 1e-9 && (stroke[1][0] - 1.0).abs() < 1e-9);
        // Its ends alone do not cut it.
        assert!(between(domain, &[0.0, 1.5]).is_empty());
    }

    #[test]
    fn pieces_share_a_width_of_cells() {
        // 315, 0.5, 44 and 0.5 degrees.
        let shares = [630.0, 1.0, 88.0, 1.0].map(|halves| halves / 720.0);
        let (total, steps) = common_cells(&shares).unwrap();
        for (share, step) in shares.iter().zip(&steps) {
            // A cell of the piece is a whole part of the common one; with fewer cells it would not be.
            let parts = |cells: u32| f64::from(cells) / (share * f64::from(total));
            let is_whole = |x: f64| (x - x.round()).abs() < 1e-9;
            assert!(is_whole(parts(*step)), "{total} {steps:?}");
            assert!(
                (1..*step).all(|fewer| !is_whole(parts(fewer))),
                "{total} {steps:?}"
            );
        }
        assert!(steps.iter().sum::<u32>() < 80, "{total} {steps:?}");
        // Not a whole part, by more than rounding.
        let odd = 1.618_033_988_749_895e-4;
        assert_eq!(common_cells(&[odd, 1.0 - odd]), None);
    }
}
