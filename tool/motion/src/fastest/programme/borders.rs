//! Where pieces meet: at the places at which the limit that is met changes.

use super::interior::Programme as _;
use super::limits::Margins;
use super::mesh::{Border, SHARES};
use super::{Asked, Found, RAMP, Warm, inner};
use crate::fastest::field::Binding;
use crate::trace::{Node, Trace};

/// Share of itself within which a limit is met.
const MET: f64 = 1e-3;

/// Share by which a state may exceed its limit between stations without swinging.
const SWINGS: f64 = 1e-4;

/// The same of the rate of the torque, of a piece that is long.
const CHANGES: f64 = 1e-2;

/// A piece in which w falls below this share of its greatest value is too long: a polynomial of fifth degree swings there.
const STEEP: f64 = 0.1;

/// Pieces are not cut to less than this share of u: w″ is a difference of second order, whose last digits are those of w by the square of
/// the length. What a larger limit of the rates leaves of them is less.
const SHORTEST: f64 = 6e-4;

/// A limit that is met at a station: which of its rows, how hard it pushes, and how far away it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) limit: Binding,
    row: usize,
    force: f64,
    pub(super) value: f64,
}

/// The one that pushes hardest.
pub(super) fn strongest(met: &[Met]) -> Option<Met> {
    let each = met.iter().copied().filter(|met| met.force > 0.0);
    each.max_by(|a, b| a.force.total_cmp(&b.force))
}

impl Asked<'_> {
    /// The limits that are met at each station.
    pub(super) fn all_met(&self, found: &Found) -> Vec<Vec<Met>> {
        let mesh = &found.mesh;
        let mut met = vec![Vec::new(); mesh.stations.len()];
        let margins = vec![Margins::default(); mesh.elements.len()];
        let problem = self.problem(mesh, &margins, found.range);
        let Some([_, rows]) = problem.at(&found.point.x) else {
            return met;
        };
        let mut number = 0;
        let mut before = 0;
        for (row, multiplier) in rows.iter().zip(&found.point.multipliers) {
            number = if row.station == before { number + 1 } else { 0 };
            before = row.station;
            let Some(limit) = row.limit.filter(|_| row.value > -MET) else {
                continue;
            };
            // Where power flows another way the torque bends, and with it the jerk jumps: those of the torque rate are others there.
            let flow = if limit == Binding::TorqueRate {
                let station = &mesh.stations[row.station];
                let state = problem.state(station, &mesh.values(&found.point.x, station.element));
                let way = self.field.way;
                way.flow(&station.place, state.speed, state.acceleration)
            } else {
                0
            };
            met[row.station].push(Met {
                limit,
                row: number % 2 + 2 * flow,
                force: multiplier / row.weight,
                value: row.value,
            });
        }
        met
    }

    /// The limit that is met at each station, and which of its rows: driving and braking are two.
    pub(super) fn met(&self, found: &Found) -> Vec<Option<(Binding, usize)>> {
        let met = self.all_met(found).into_iter();
        met.map(|met| strongest(&met).map(|met| (met.limit, met.row)))
            .collect()
    }

    /// Of each piece: whether the limit that is met changes in it or at its borders, and whether it changes in it.
    pub(super) fn changes(&self, found: &Found) -> Vec<[bool; 2]> {
        let met = self.met(found);
        let all: Vec<_> = met.chunks(SHARES.len()).collect();
        let changes = |(index, own): (usize, &&[_])| {
            let inner = &own[1..SHARES.len() - 1];
            let inside = inner.windows(2).any(|pair| pair[0] != pair[1]);
            // What happens at a border of two pieces is known to neither.
            let beside = |other: Option<usize>| {
                let other = other.and_then(|other| all.get(other));
                other.is_some_and(|other| other[3] != own[3])
            };
            [
                inside || beside(index.checked_sub(1)) || beside(Some(index + 1)),
                inside,
            ]
        };
        all.iter().enumerate().map(changes).collect()
    }

    fn shortest(&self) -> f64 {
        if self.limits().has_rates() {
            SHORTEST * (self.ramp() / RAMP[1]).sqrt()
        } else {
            SHORTEST
        }
    }

    /// Divides the pieces in which limits are exceeded by much and makes them cubics: a margin there would slow their neighbours down. Whether
    /// there are any.
    pub(super) fn divide(&self, warm: &mut Warm, exceeded: &[[f64; 3]]) -> bool {
        let shortest = self.shortest();
        let mut borders = Vec::with_capacity(warm.borders.len());
        let mut margins = Vec::with_capacity(warm.margins.len());
        for (k, border) in warm.borders.iter().enumerate() {
            let mut border = *border;
            let (Some(next), Some([state, _, rate])) = (warm.borders.get(k + 1), exceeded.get(k))
            else {
                borders.push(border);
                continue;
            };
            let own = warm.margins[k];
            margins.push(own);
            let is_long = next.u - border.u > 2.0 * shortest;
            let swings = *state > SWINGS && self.limits().has_rates();
            border.is_plain |= swings;
            borders.push(border);
            if is_long && (swings || *rate > CHANGES) {
                margins.push(own);
                borders.push(Border {
                    is_plain: border.is_plain,
                    ..inner(border.u.midpoint(next.u))
                });
            }
        }
        let changes = borders != warm.borders;
        (warm.borders, warm.margins) = (borders, margins);
        changes
    }

    /// Whether w changes in a piece by more than its polynomial bears.
    fn is_steep(found: &Found, piece: usize) -> bool {
        let shares = (0..=20).map(|k| f64::from(k) / 20.0);
        let each = shares.map(|z| found.mesh.pace(&found.point.x, piece, z)[0]);
        let [least, most] = each.fold([f64::INFINITY, 0.0_f64], |[least, most], w| {
            [least.min(w), most.max(w)]
        });
        least <= STEEP * most
    }

    /// Middles of the pieces in which the limit that is met changes, or w by much.
    pub(super) fn finer(&self, found: &Found) -> Vec<Border> {
        let pieces = found.mesh.elements.iter().zip(self.changes(found));
        let shortest = self.shortest();
        let finer = pieces
            .enumerate()
            .filter_map(|(piece, (element, [changes, _]))| {
                let [from, to] = element.span;
                let is_coarse = changes || Self::is_steep(found, piece);
                (is_coarse && to - from > 2.0 * shortest).then(|| inner(from.midpoint(to)))
            });
        finer.collect()
    }

    /// The borders with one where the limit that is met changes, in the place of those around it; `None`: it changes at borders only.
    pub(super) fn moved(
        &self,
        borders: &[Border],
        found: &Found,
        trace: &Trace,
    ) -> Option<Vec<Border>> {
        let met = self.met(found);
        let count = SHARES.len();
        let last = count - 1;
        let nodes = trace.nodes();
        // The limit that is met all through a piece.
        let whole: Vec<_> = met
            .chunks(count)
            .map(|own| {
                let inner = &own[1..last];
                inner.iter().all(|met| *met == inner[0]).then_some(inner[0])
            })
            .collect();
        let mut borders: Vec<Option<Border>> = borders.iter().copied().map(Some).collect();
        let mut new = Vec::new();
        let mut left: Option<usize> = None;
        for (right, own) in whole.iter().enumerate() {
            if own.is_none() {
                continue;
            }
            if let Some(left) = left.replace(right)
                && right > left + 1
                && whole[left] != whole[right]
            {
                // Time, acceleration and jerk where the gap begins and ends.
                let side = |node: usize, other: usize| {
                    let [a, b] = [node, other].map(|k| &nodes[k]);
                    let alpha =
                        |node: &Node, towards: &Node| node.alpha[usize::from(towards.t > node.t)];
                    (a.t, alpha(a, b), (alpha(b, a) - alpha(a, b)) / (b.t - a.t))
                };
                let [from, to] = [(left + 1) * last, right * last];
                let (t0, a0, j0) = side(from, from - 1);
                let (t1, a1, j1) = side(to, to + 1);
                let t = (a1 - a0 + j0 * t0 - j1 * t1) / (j0 - j1);
                if !(t > t0 && t < t1) {
                    continue;
                }
                let k = nodes
                    .partition_point(|node| node.t <= t)
                    .clamp(from + 1, to);
                let share = (t - nodes[k - 1].t) / (nodes[k].t - nodes[k - 1].t);
                let u = |k: usize| found.mesh.stations[k / last * count + k % last].u;
                new.push(Some(inner(u(k - 1) + share * (u(k) - u(k - 1)))));
                for border in &mut borders[left + 1..=right] {
                    *border = border.filter(|border| border.stays);
                }
            }
        }
        if new.is_empty() {
            return None;
        }
        borders.extend(new);
        let mut borders: Vec<Border> = borders.into_iter().flatten().collect();
        borders.sort_by(|a, b| a.u.total_cmp(&b.u));
        Some(borders)
    }
}
