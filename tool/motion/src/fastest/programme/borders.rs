//! Borders of pieces, best placed where the active limit changes. A limit is active where the motion meets it.

use super::limits::Margins;
use super::mesh::{Border, SHARES};
use super::{MeshMotion, MoveRequest, PIECES, RAMP, WarmStart};
use crate::collocation::shape::Parametrization;
use crate::fastest::field::Binding;
use crate::trace::{Node, Trace};

/// Borders that are closer than this share of u are one border.
const BORDER_SPACING: f64 = 1e-9;

/// A limit counts as met within this share of it.
const ACTIVE_TOLERANCE: f64 = 1e-3;

/// Share by which a limit of speed, acceleration or torque may be exceeded between stations. Beyond it the polynomial is considered to oscillate.
const OSCILLATION: f64 = 1e-4;

/// The same for the torque rate; beyond it a long piece is divided.
const RATE_OSCILLATION: f64 = 1e-2;

/// A piece in which w falls below this share of its greatest value is too long: a polynomial of fifth degree oscillates there.
const STEEP: f64 = 0.1;

/// Shortest piece as a share of u. In a piece of length h, rounding of w appears in w″, and so in the jerk, divided by h². With high rate limits the
/// ramps are short, and shorter pieces are allowed.
const SHORTEST: f64 = 6e-4;

/// A limit that is met at a station: its inequality, its multiplier per weight (the gain of easing it), and its value, 0 where it is just met.
#[derive(Clone, Copy, Debug)]
pub(super) struct ActiveConstraint {
    pub(super) limit: Binding,
    row: usize,
    force: f64,
    pub(super) value: f64,
}

/// The limit with the largest gain of easing it.
pub(super) fn strongest(met: &[ActiveConstraint]) -> Option<ActiveConstraint> {
    let each = met.iter().copied().filter(|met| met.force > 0.0);
    each.max_by(|a, b| a.force.total_cmp(&b.force))
}

/// A border at a place where machine and path are smooth.
pub(super) const fn inner(u: f64) -> Border {
    Border {
        u,
        is_corner: false,
        stays: false,
        is_plain: false,
    }
}

impl MoveRequest<'_> {
    /// Equal pieces, cut where the path or the machine is not smooth.
    pub(super) fn first_borders(&self, shape: &Parametrization) -> Vec<Border> {
        let [pieces, _] = PIECES;
        let border = |u: f64, stays: bool| Border { stays, ..inner(u) };
        let corners = self.ends.corners.iter();
        let mut borders: Vec<Border> = (0..=pieces)
            .map(|k| border(k as f64 / pieces as f64, false))
            .chain(shape.knots().map(|u| border(u, true)))
            .chain(corners.map(|x| Border {
                is_corner: true,
                ..border(shape.place(x / self.ends.length), true)
            }))
            .collect();
        borders.sort_by(|a, b| a.u.total_cmp(&b.u));
        borders.dedup_by(|b, a| {
            let same = b.u - a.u <= BORDER_SPACING;
            a.is_corner |= same && b.is_corner;
            a.stays |= same && b.stays;
            same
        });
        borders
    }

    /// The limits that are met at each station.
    pub(super) fn all_met(&self, found: &MeshMotion) -> Vec<Vec<ActiveConstraint>> {
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
            let Some(limit) = row.limit.filter(|_| row.value > -ACTIVE_TOLERANCE) else {
                continue;
            };
            // Where power changes direction the torque bends and the jerk jumps, so the torque rate on each side counts as a limit of its own.
            let flow = if limit == Binding::TorqueRate {
                let station = &mesh.stations[row.station];
                let state = problem.state(station, &mesh.values(&found.point.x, station.element));
                let dynamics = self.field.dynamics;
                dynamics.flow(&station.place, state.speed, state.acceleration)
            } else {
                0
            };
            met[row.station].push(ActiveConstraint {
                limit,
                row: number % 2 + 2 * flow,
                force: multiplier / row.weight,
                value: row.value,
            });
        }
        met
    }

    /// The active limit at each station, and its inequality (upper and lower limits are two).
    pub(super) fn met(&self, found: &MeshMotion) -> Vec<Option<(Binding, usize)>> {
        let met = self.all_met(found).into_iter();
        met.map(|met| strongest(&met).map(|met| (met.limit, met.row)))
            .collect()
    }

    /// For each piece: whether the active limit changes in it or at its borders, and whether it changes in it.
    pub(super) fn changes(&self, found: &MeshMotion) -> Vec<[bool; 2]> {
        let met = self.met(found);
        let all: Vec<_> = met.chunks(SHARES.len()).collect();
        let changes = |(index, own): (usize, &&[_])| {
            let inner = &own[1..SHARES.len() - 1];
            let inside = inner.windows(2).any(|pair| pair[0] != pair[1]);
            // Stations at borders belong to two pieces and describe neither well: the middles of neighbours are compared.
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

    /// Divides the pieces in which limits are exceeded by much, and turns oscillating pieces into cubics. A margin would slow their neighbours
    /// instead. Returns whether anything changed.
    pub(super) fn divide(&self, warm: &mut WarmStart, exceeded: &[[f64; 3]]) -> bool {
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
            let swings = *state > OSCILLATION && self.limits().has_rates();
            border.is_plain |= swings;
            borders.push(border);
            if is_long && (swings || *rate > RATE_OSCILLATION) {
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

    /// Whether w changes in a piece by more than its polynomial can follow.
    fn is_steep(found: &MeshMotion, piece: usize) -> bool {
        let shares = (0..=20).map(|k| f64::from(k) / 20.0);
        let each = shares.map(|z| found.mesh.pace(&found.point.x, piece, z)[0]);
        let [least, most] = each.fold([f64::INFINITY, 0.0_f64], |[least, most], w| {
            [least.min(w), most.max(w)]
        });
        least <= STEEP * most
    }

    /// Middles of the pieces in which the active limit or w changes much.
    pub(super) fn finer(&self, found: &MeshMotion) -> Vec<Border> {
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

    /// The borders, with a new one at each place where the active limit changes, in place of those around it; `None` if it changes only at borders.
    pub(super) fn moved(
        &self,
        borders: &[Border],
        found: &MeshMotion,
        trace: &Trace,
    ) -> Option<Vec<Border>> {
        let met = self.met(found);
        let count = SHARES.len();
        let last = count - 1;
        let nodes = trace.nodes();
        // The limit that is active at all inner stations of a piece.
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
                // Between two pieces with one limit each there is a gap. The jerks on both sides are extrapolated to where the accelerations meet,
                // from time, acceleration and jerk at both ends of the gap.
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
