//! The work of a tick: filter, windows, rows, and a share of the rotations.

use super::column::{Local, Place, accumulate};
use super::solve::{Equations, dot, turn};
use super::weight::WINDOWS;
use super::{Identification, Row};
use crate::Phase;
use crate::curve::{Circular, CurveSet};

impl<T: Circular, const N: usize, const RING: usize, const SET: CurveSet>
    Identification<T, N, RING, SET>
{
    /// The second difference of the angle is beyond its noise and any acceleration.
    pub(super) fn jumps(&self, phase: Phase) -> bool {
        let read = |back: usize| {
            let at = (self.newest + RING - back) % RING;
            self.phases.get(at).copied().unwrap_or(0)
        };
        if self.kept < 2 {
            return false;
        }
        let last = phase.to_bits().wrapping_sub(read(0)) as i32;
        let before = read(0).wrapping_sub(read(1)) as i32;
        let change = self.filter.radians(last.wrapping_sub(before));
        change > self.plan.jump || -change > self.plan.jump
    }

    /// The sample in the middle of those kept.
    pub(super) fn sample(&mut self) {
        let at = (self.newest + RING - self.filter.wide) % RING;
        let (Some(phase), Some(torque), Some(weights)) = (
            self.phases.get(at).map(|bits| Phase::from_bits(*bits)),
            self.torques.get((at + self.plan.late) % RING).copied(),
            self.weights.get(self.tick).copied(),
        ) else {
            return;
        };
        let [zero, half, one] = T::CONSTANTS;
        let seen = self.filter.at(&self.phases, at);
        if self.tick == 0 {
            self.open(phase);
        }
        let omega = seen.omega;
        let speed = if omega < zero { -omega } else { omega };
        let motion = &mut self.equations.motion;
        if speed > self.plan.fastest {
            motion.fast = motion.fast.saturating_add(1);
        }
        if speed < self.plan.slowest || speed > self.plan.fastest {
            self.left_out = [true; WINDOWS];
        } else {
            motion.add(phase, omega, self.plan.remembered);
        }
        let sign = |omega: T| if omega < zero { -one } else { one };

        let moved = self
            .begins
            .map(|begin| self.filter.radians((phase - begin).to_bits() as i32));
        let square = seen.narrow_omega * seen.narrow_omega - self.filter.variance;
        let mut place = Place {
            phase,
            moved,
            half_square: if square > zero { half * square } else { zero },
            sign: sign(seen.narrow_omega),
        };
        accumulate(&mut self.measured, &self.columns, &place, &weights);
        place = Place {
            phase: phase + Phase::from_radians_f32(seen.angle.to_f32()),
            moved: moved.map(|moved| moved + seen.angle),
            half_square: half * omega * omega,
            sign: sign(omega),
        };
        accumulate(&mut self.smoothed, &self.columns, &place, &weights);
        for (sum, weight) in self.right.iter_mut().zip(&weights.torque) {
            *sum = *sum + *weight * torque;
        }

        let local = Local::new(place.phase, &self.columns, &self.nominal);
        let damping = local.slope * omega - local.viscous;
        let stiffness =
            local.slope * seen.alpha + half * local.curvature * omega * omega + local.stiffness;
        let mut effect = weights.plain;
        for ((w, w1), w2) in effect.iter_mut().zip(&weights.first).zip(&weights.second) {
            *w = local.inertia * *w2 + damping * *w1 + stiffness * *w;
        }
        for (age, (sums, mine)) in self.products.iter_mut().zip(effect).enumerate() {
            for (sum, other) in sums.iter_mut().zip(effect.iter().skip(age)) {
                *sum = *sum + mine * *other;
            }
        }

        self.tick += 1;
        if self.tick == self.plan.ticks {
            self.tick = 0;
            self.windows = (self.windows + 1).min(WINDOWS);
            if self.windows == WINDOWS {
                self.close();
            }
        }
    }

    /// Every window is older by a knot, and a young one opens.
    fn open(&mut self, phase: Phase) {
        let [zero, ..] = T::CONSTANTS;
        for row in self.measured.iter_mut().chain(&mut self.smoothed) {
            age(row, zero);
        }
        age(&mut self.right, zero);
        age(&mut self.products, [zero; WINDOWS]);
        age(&mut self.begins, phase);
        age(&mut self.left_out, false);
    }

    /// The oldest window becomes a row, whitened by those before it, and waits to be turned into the equations.
    fn close(&mut self) {
        let [zero, _, one] = T::CONSTANTS;
        let [.., products] = &self.products;
        let mut covariance = self.plan.torque_products;
        for (sum, product) in covariance.iter_mut().zip(products) {
            *sum = *sum + self.plan.angle_variance * *product;
        }
        let [variance, ..] = covariance;
        let mut row = Row {
            factor: [zero; WINDOWS],
            measured: self.measured.map(|[.., oldest]| oldest),
            smoothed: self.smoothed.map(|[.., oldest]| oldest),
            right: self.right[WINDOWS - 1],
        };
        let mut rest = variance;
        for back in (1..WINDOWS).rev() {
            let before = (self.row + WINDOWS - back) % WINDOWS;
            let (Some(before), Some(shared)) = (self.rows.get(before), covariance.get(back)) else {
                continue;
            };
            let [diagonal, couplings @ ..] = &before.factor;
            if *diagonal == zero {
                continue;
            }
            let known = row.factor.iter().skip(back + 1).zip(couplings);
            let known = known.fold(zero, |sum, (a, b)| sum + *a * *b);
            let factor = (*shared - known) / *diagonal;
            if let Some(slot) = row.factor.get_mut(back) {
                *slot = factor;
            }
            rest = rest - factor * factor;
            for (value, known) in row.measured.iter_mut().zip(&before.measured) {
                *value = *value - factor * *known;
            }
            for (value, known) in row.smoothed.iter_mut().zip(&before.smoothed) {
                *value = *value - factor * *known;
            }
            row.right = row.right - factor * before.right;
        }
        let least = self.plan.least_share * variance;
        let diagonal = (if rest > least { rest } else { least }).sqrt();
        let [.., left_out] = self.left_out;
        let used = !left_out && diagonal > zero;
        if used {
            let scale = one / diagonal;
            row.factor[0] = diagonal;
            row.measured = row.measured.map(|value| value * scale);
            row.smoothed = row.smoothed.map(|value| value * scale);
            row.right = row.right * scale;
        } else {
            row.factor = [zero; WINDOWS];
        }
        if let Some(slot) = self.rows.get_mut(self.row) {
            *slot = row;
        }
        self.row = (self.row + 1) % WINDOWS;
        if !used {
            return;
        }
        if self.estimated {
            let error = row.right - dot(&row.measured, &self.estimate);
            self.equations.residual(error, self.plan.residual_kept);
        }
        self.turned = row;
        self.pivot = 0;
        self.equations.row(self.plan.kept * self.plan.kept);
    }

    /// Turns a share of the waiting row into the equations, so that it is done before the next one: Givens rotations of the smoothed row into the
    /// triangle, which the measured row and the torque follow.
    pub(super) fn turn_part(&mut self) {
        let [zero, _, one] = T::CONSTANTS;
        let from = self.pivot;
        if from >= N {
            return;
        }
        self.pivot = from + self.plan.pivots;
        let kept = self.plan.kept;
        let Row {
            smoothed,
            measured,
            right,
            ..
        } = &mut self.turned;
        let Equations { matrix, known, .. } = &mut self.equations;
        let rows = self.triangle.iter_mut().zip(matrix).zip(known).enumerate();
        for (i, ((triangle, row), value)) in rows.skip(from).take(self.plan.pivots) {
            let (Some(diagonal), Some(new)) = (triangle.get(i), smoothed.get(i)) else {
                return;
            };
            let (old, new) = (kept * *diagonal, *new);
            let size = (old * old + new * new).sqrt();
            if size == zero {
                continue;
            }
            let scale = one / size;
            let (c, s) = (old * scale, new * scale);
            turn(triangle.get_mut(i..), smoothed.get_mut(i..), kept, c, s);
            turn(Some(row), Some(measured), kept, c, s);
            turn(
                Some(core::slice::from_mut(value)),
                Some(core::slice::from_mut(right)),
                kept,
                c,
                s,
            );
        }
    }
}

/// Moves each element to the next older window, and puts a young one first.
fn age<E: Copy>(windows: &mut [E; WINDOWS], young: E) {
    let [a, b, c, d, e, _] = *windows;
    *windows = [young, a, b, c, d, e];
}
