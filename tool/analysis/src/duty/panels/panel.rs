//! A panel: cut where a power changes sign, halved until its error is small, and then added to the duty.

use super::stretch::Stretch;
use super::{MOST_INSTANTS, Panels, SpanError};
use crate::duty::error::DutyError;
use crate::duty::integrands::{PanelTolerance, Sums};
use crate::duty::moving_machine::DutyInstant;
use crate::duty::{INSIDE, Instant, refined};
use jred_file::number::quadrature::kronrod::{KRONROD_7, KRONROD_15, Rule};

/// Most cuts of a panel at changes of sign; with more it is halved first.
const MOST_CUTS: usize = 16;

/// A halving that leaves a larger share of the error than this is ineffective: over a smooth part it leaves a thousandth, at a kink half.
const INEFFECTIVE: f64 = 0.7;

/// After this number of ineffective halvings, an error up to this share counts as rounding, which smaller panels do not reduce.
const IDLE: [(u32, f64); 2] = [(2, 1e-10), (5, 1e-6)];

/// Largest error by rounding of the times, in rounding errors.
const TIME_ROUNDINGS: f64 = 4.0;

/// Most halvings of a panel.
const DEEPEST: u32 = 60;

/// An end of a panel.
#[derive(Clone, Copy)]
pub(super) struct PanelEnd {
    pub(super) t: f64,
    pub(super) now: DutyInstant,
    /// Whether a torque is zero there, so that its sign is rounding.
    pub(super) is_zero: bool,
}

/// History of a panel.
#[derive(Clone, Copy)]
pub(super) struct PanelHistory {
    /// Halvings.
    depth: u32,
    /// Number of the last halvings that hardly reduced the error.
    idle: u32,
    /// The error as a share of the integral by time.
    error: f64,
}

impl Default for PanelHistory {
    fn default() -> Self {
        Self {
            depth: 0,
            idle: 0,
            error: f64::INFINITY,
        }
    }
}

impl PanelHistory {
    fn further(self, error: f64) -> Self {
        let is_idle = error > INEFFECTIVE * self.error;
        Self {
            depth: self.depth + 1,
            idle: if is_idle { self.idle + 1 } else { 0 },
            error,
        }
    }
}

impl Panels<'_, '_> {
    /// Adds a panel, or its parts.
    pub(super) fn panel(
        &mut self,
        stretch: &Stretch,
        ends: [&PanelEnd; 2],
        history: PanelHistory,
    ) -> Result<(), DutyError> {
        let [from, to] = ends.map(|end| end.t);
        let inner = stretch.between([from, to]);
        let by_rows = !stretch.rows.is_empty() && inner.is_empty();
        let rule: &Rule = if by_rows { &KRONROD_7 } else { &KRONROD_15 };
        let (middle, half) = (from.midpoint(to), 0.5 * (to - from));
        let mut places = [ends[0].now; 15];
        let places = &mut places[..rule.places().len()];
        for (place, x) in places.iter_mut().zip(rule.places()) {
            *place = self.moving.at(stretch.clamp(middle + half * x))?;
        }
        // Where a move comes to rest the sign of the speed is rounding for about this time.
        let shortest = INSIDE * (stretch.to - stretch.from);
        let is_short =
            half <= shortest.max(4.0 * f64::EPSILON * to.abs()) || history.depth > DEEPEST;
        if stretch.moves && !is_short {
            let cuts = self.changes(stretch, ends, places)?;
            if (1..=MOST_CUTS).contains(&cuts.len()) {
                return self.parts(stretch, ends, &cuts, true, history.further(f64::INFINITY));
            }
            if cuts.len() > MOST_CUTS {
                return self.parts(
                    stretch,
                    ends,
                    &[middle],
                    false,
                    history.further(f64::INFINITY),
                );
            }
        }
        let allowed = PanelTolerance {
            tolerance: self.tolerance,
            sizes: &self.sizes,
            share: (to - from) / self.duration,
            of_whole: self.of_whole,
            largest: (history.idle == 0).then_some(self.largest),
        };
        let (sums, [excess, rough]) =
            Sums::over(rule, places, ends.map(|end| &end.now), half, allowed);
        let history = history.further(rough);
        // The times of a short stretch late in a long motion are rounded.
        let rounded = TIME_ROUNDINGS * f64::EPSILON * to.abs() / (stretch.to - stretch.from);
        let is_noise = IDLE
            .iter()
            .any(|(idle, noise)| history.idle >= *idle && rough <= *noise)
            || history.idle >= 1 && rough <= rounded;
        if excess > 1.0 && !is_short && !is_noise {
            let cut = inner.get(inner.len() / 2).copied().unwrap_or(middle);
            return self.parts(stretch, ends, &[cut], false, history);
        }
        self.accept(stretch, ends, rule, places, &sums)
    }

    /// Adds the panel, cut at these times.
    fn parts(
        &mut self,
        stretch: &Stretch,
        [first, last]: [&PanelEnd; 2],
        cuts: &[f64],
        is_zero: bool,
        history: PanelHistory,
    ) -> Result<(), DutyError> {
        let mut left = *first;
        for cut in cuts {
            let right = self.end(stretch, *cut, is_zero)?;
            self.panel(stretch, [&left, &right], history)?;
            left = right;
        }
        self.panel(stretch, [&left, last], history)
    }

    /// Adds the instants and integrals of a panel.
    fn accept(
        &mut self,
        stretch: &Stretch,
        [left, right]: [&PanelEnd; 2],
        rule: &Rule,
        places: &[DutyInstant],
        sums: &Sums,
    ) -> Result<(), DutyError> {
        let span = [left.t, right.t];
        let half = 0.5 * (right.t - left.t);
        self.sums.add(sums);
        let error = sums.error(&self.sizes);
        if error > self.worst.error {
            self.worst = SpanError { span, error };
        }
        self.smooth.panel(self.instants.len());
        let mut before = left.now.instant;
        let mut row = Vec::with_capacity(places.len() + 1);
        for (now, weight) in places.iter().zip(rule.weights()) {
            row.push(Instant {
                weight: half * weight,
                ..now.instant
            });
            self.largest = self.largest.max(now.instant.input_torque.abs());
        }
        row.push(right.now.instant);
        let torques: Vec<(f64, f64)> = ([&before].into_iter().chain(&row))
            .map(|i| (i.t, i.input_torque))
            .collect();
        let parts = refined::parts(&torques, self.largest, self.most_parts);
        for (next, parts) in row.into_iter().zip(parts) {
            for k in 1..parts {
                let t = before.t + (next.t - before.t) * f64::from(k) / f64::from(parts);
                let now = self.moving.at(stretch.clamp(t))?;
                self.instants.push(now.instant);
            }
            self.instants.push(next);
            before = next;
        }
        if self.instants.len() > MOST_INSTANTS {
            return Err(DutyError::Fine {
                until: right.t,
                duration: self.duration,
                tolerance: self.tolerance,
                most: MOST_INSTANTS,
                of_turns: false,
            });
        }
        Ok(())
    }
}
