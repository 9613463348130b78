//! Where a motion through nodes bends: the rows between which its acceleration is not one parabola.

use crate::number::parabola::Parabola;

use super::Motion;
use super::piece::{Kind, Piece};

/// Most cuts of a motion.
const MOST_CUTS: usize = 100_000;

/// By what the tolerance grows if there are more.
const COARSER: f64 = 10.0;

/// The acceleration over a part of a motion, at its rows and halfway between them.
struct Accelerations(Vec<(f64, f64)>);

impl Accelerations {
    fn of(piece: &Piece, [from, to]: [f64; 2]) -> Self {
        let rows = match &piece.kind {
            Kind::Nodes(nodes) => nodes.as_slice(),
            _ => &[],
        };
        let inner = rows.iter().map(|node| node.t);
        let mut times = vec![from];
        times.extend(inner.filter(|t| from < *t && *t < to));
        times.push(to);
        let at = |t: f64| (t, piece.at(t - piece.start).alpha);
        let steps = times.windows(2);
        let mut places: Vec<_> = steps
            .flat_map(|step| [at(step[0]), at(step[0].midpoint(step[1]))])
            .collect();
        places.push(at(to));
        Self(places)
    }

    fn largest(&self) -> f64 {
        (self.0.iter()).fold(0.0, |most, (_, alpha)| alpha.abs().max(most))
    }

    /// Steps between rows.
    const fn steps(&self) -> usize {
        self.0.len() / 2
    }

    /// Whether no parabola is near enough from the row `first` to the row `last`. Within a step it is one.
    fn bends(&self, first: usize, last: usize, tolerance: f64) -> bool {
        if last - first < 2 {
            return false;
        }
        let three = [2 * first, first + last, 2 * last].map(|k| self.0[k]);
        let parabola = Parabola::through(three.map(|(t, _)| t), three.map(|(_, alpha)| alpha));
        let places = &self.0[2 * first..=2 * last];
        let far = |(t, alpha): &(f64, f64)| (parabola.at(*t) - alpha).abs() > tolerance;
        places.iter().any(far)
    }

    /// The rows, from one after the other, up to which one parabola goes.
    fn cuts(&self, tolerance: f64) -> Vec<f64> {
        let steps = self.steps();
        let mut cuts = Vec::new();
        let mut first = 0;
        while first < steps {
            let bends = |last: usize| self.bends(first, last, tolerance);
            // By doubling, then by halving.
            let mut good = first + 1;
            let mut way = 2;
            while first + way <= steps && !bends(first + way) {
                good = first + way;
                way *= 2;
            }
            let mut bad = (first + way).min(steps + 1);
            while bad - good > 1 {
                let middle = good.midpoint(bad);
                if bends(middle) {
                    bad = middle;
                } else {
                    good = middle;
                }
            }
            first = good;
            if first < steps {
                cuts.push(self.0[2 * first].0);
            }
        }
        cuts
    }
}

impl Motion {
    /// The stretches, each cut at the rows of a motion through nodes so that in every part the acceleration is one parabola to within a share of
    /// the largest. Each stretch is the times (s) with both ends; a motion without nodes is not cut.
    pub(crate) fn cut_at_bends(&self, stretches: &[(f64, f64)], share: f64) -> Vec<Vec<f64>> {
        let through_nodes = |piece: &&Piece| matches!(piece.kind, Kind::Nodes(_));
        let accelerations: Vec<Option<Accelerations>> = stretches
            .iter()
            .map(|&(from, to)| {
                let piece = self.piece(from.midpoint(to)).filter(through_nodes)?;
                Some(Accelerations::of(piece, [from, to]))
            })
            .collect();
        let largest = (accelerations.iter().flatten()).map(Accelerations::largest);
        let mut tolerance = share * largest.fold(0.0, f64::max);
        let cuts = |tolerance: f64| -> Vec<Vec<f64>> {
            let of = |accelerations: &Option<Accelerations>| {
                (accelerations.as_ref()).map_or_else(Vec::new, |known| known.cuts(tolerance))
            };
            accelerations.iter().map(of).collect()
        };
        let mut inner = cuts(tolerance);
        while inner.iter().map(Vec::len).sum::<usize>() > MOST_CUTS {
            tolerance *= COARSER;
            inner = cuts(tolerance);
        }
        let whole = stretches.iter().zip(inner);
        whole
            .map(|(&(from, to), inner)| [&[from], &inner[..], &[to]].concat())
            .collect()
    }
}
