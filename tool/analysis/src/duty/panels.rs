//! The instants of a motion: Gauss-Kronrod places on panels that are halved until the errors of all integrals are known to be small.
//!
//! A smooth stretch of the motion starts with panels for about the requested number of instants, and some for each turn. A panel in which the power
//! through a stage with losses, or at the input, changes sign is cut there. A panel that contains rows of a recorded motion is cut at a row until it
//! contains no row.

mod signs;
mod stretch;

use super::error::DutyError;
use super::integrands::{COUNT, PanelTolerance, Sums, integrands, of_whole};
use super::moving_machine::{DutyInstant, MovingMachine};
use super::stretches::turns;
use super::{INSIDE, Instant, Sampling, Smooth, refined};
use jred_file::number::quadrature::GAUSS_3;
use jred_file::number::quadrature::kronrod::{KRONROD_7, KRONROD_15, Rule};
use signs::SIGN_ROUNDING;
use stretch::{Stretch, near_whole};

/// Most instants of a duty; with derived data they take 200 bytes each.
pub const MOST_INSTANTS: usize = 4_000_000;

/// Initial panels per turn: with very many turns, and otherwise.
const OF_TURN: [f64; 2] = [2.0, 8.0];

/// Number of instants up to which the turns get the larger number.
const FOR_TURNS: f64 = 1e6;

/// Most panels that are evaluated for the size of the integrals.
const MOST_FOR_SIZES: usize = 256;

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

/// Factor by which the sum of all panels' errors may exceed the tolerance, because each estimate is cautious.
const MOST_OF_TOLERANCE: f64 = 4.0;

/// Allowed imbalance as a share of the exchanged energy. Rounded positions, speeds and accelerations of recorded rows match only to some digits;
/// those of a law match except for rounding.
const OF_ROWS: f64 = 1e-3;
const OF_LAWS: f64 = 1e-7;

/// An end of a panel.
#[derive(Clone, Copy)]
struct PanelEnd {
    t: f64,
    now: DutyInstant,
    /// Whether a torque is zero there, so that its sign is rounding.
    is_zero: bool,
}

/// History of a panel.
#[derive(Clone, Copy)]
struct PanelHistory {
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

/// The duty under construction.
pub(super) struct Panels<'a, 'm> {
    moving: &'a mut MovingMachine<'m>,
    tolerance: f64,
    duration: f64,
    pub(super) instants: Vec<Instant>,
    pub(super) smooth: Smooth,
    sizes: [f64; COUNT],
    /// The largest torque of each power flow.
    flows: Vec<f64>,
    /// The largest torque at the input.
    largest: f64,
    most_parts: f64,
    of_whole: f64,
    pub(super) sums: Sums,
    /// The panel with the largest error, and the error.
    worst: ([f64; 2], f64),
    /// Gain of energy (J).
    gain: f64,
    /// The stretch with the largest difference of work and energy (J).
    unbalanced: ([f64; 2], f64),
}

impl<'a, 'm> Panels<'a, 'm> {
    /// The instants of a motion with these smooth stretches.
    pub(super) fn new(
        moving: &'a mut MovingMachine<'m>,
        stretches: &[(f64, f64)],
        sampling: Sampling,
    ) -> Result<Self, DutyError> {
        let (file, motion) = (moving.file, moving.motion);
        let duration = motion.duration();
        let each: Vec<f64> = stretches.iter().map(|s| turns(file, motion, *s)).collect();
        let all: f64 = each.iter().sum();
        let of_turn = (FOR_TURNS / 15.0 / all).clamp(OF_TURN[0], OF_TURN[1]);
        let fewest = (15.0 * OF_TURN[0] * all).max(15.0 * stretches.len() as f64);
        if fewest > MOST_INSTANTS as f64 {
            return Err(DutyError::Fine {
                until: duration * MOST_INSTANTS as f64 / fewest,
                duration,
                tolerance: sampling.tolerance,
                most: MOST_INSTANTS,
                of_turns: true,
            });
        }
        let borders: Vec<(Stretch, Vec<f64>)> = (stretches.iter().zip(&each))
            .map(|(stretch, turns)| {
                let (from, to) = *stretch;
                let by_time = sampling.steps as f64 / 15.0 * (to - from) / duration;
                let count = if *turns > 1.0 {
                    // The same panels in each turn: at constant speed all turns are then alike.
                    near_whole(turns * (by_time / turns).max(of_turn).ceil())
                } else {
                    by_time.max(turns * of_turn).ceil().max(1.0)
                };
                let stretch = Stretch::new(file, motion, *stretch);
                let borders = stretch.borders(count);
                (stretch, borders)
            })
            .collect();
        let count: usize = borders.iter().map(|(_, borders)| borders.len() - 1).sum();
        let rows: usize = borders.iter().map(|(stretch, _)| stretch.rows.len()).sum();
        let mut panels = Self {
            moving,
            tolerance: sampling.tolerance,
            duration,
            instants: Vec::with_capacity(20 * count.min(MOST_INSTANTS / 20)),
            smooth: Smooth::default(),
            sizes: [0.0; COUNT],
            flows: Vec::new(),
            largest: 0.0,
            most_parts: refined::most_parts(15 * count),
            of_whole: of_whole(count.max(rows)),
            sums: Sums::default(),
            worst: ([0.0, duration], 0.0),
            gain: 0.0,
            unbalanced: ([0.0, duration], 0.0),
        };
        panels.look(&borders, count)?;
        for (stretch, borders) in &borders {
            panels.stretch(stretch, borders)?;
        }
        panels.judge()?;
        Ok(panels)
    }

    /// Approximate sizes of the integrals, and the largest torques.
    fn look(&mut self, borders: &[(Stretch, Vec<f64>)], count: usize) -> Result<(), DutyError> {
        let stride = count.div_ceil(MOST_FOR_SIZES);
        let mut number = 0;
        let mut noise = 0.0f64;
        for (stretch, borders) in borders {
            for ends in borders.windows(2) {
                number += 1;
                if (number - 1) % stride != 0 {
                    continue;
                }
                let span = ends[1] - ends[0];
                for [place, weight] in GAUSS_3 {
                    let now = self.moving.at(stretch.clamp(ends[0] + place * span))?;
                    let weight = weight * span * stride as f64;
                    for (size, [value, _]) in self.sizes.iter_mut().zip(integrands(&now)) {
                        *size += weight * value.abs();
                    }
                    let torque = now.instant.input_torque.abs();
                    self.largest = self.largest.max(torque);
                    noise = noise.max(now.magnitude * now.ratio.abs().min(1.0));
                    let flows = self.flows_of(&now.instant);
                    self.flows.resize(flows.len(), 0.0);
                    for (most, flow) in self.flows.iter_mut().zip(flows) {
                        *most = most.max(flow.abs());
                    }
                }
            }
        }
        for most in &mut self.flows {
            *most = if *most < SIGN_ROUNDING * noise {
                f64::INFINITY
            } else {
                // A torque below the rounding of its terms has no sign either.
                most.max(noise)
            };
        }
        Ok(())
    }

    fn end(&mut self, stretch: &Stretch, t: f64, is_zero: bool) -> Result<PanelEnd, DutyError> {
        let now = self.moving.at(stretch.clamp(t))?;
        Ok(PanelEnd { t, now, is_zero })
    }

    fn stretch(&mut self, stretch: &Stretch, borders: &[f64]) -> Result<(), DutyError> {
        let span = [stretch.from, stretch.to];
        let before = self.sums;
        if let Some(direction) = self.moving.starts(span) {
            self.smooth.begin(self.instants.len());
            let breakaway = self.moving.breakaway(stretch.from, direction)?;
            self.instants.push(breakaway);
        }
        self.smooth.begin(self.instants.len());
        let first = self.end(stretch, stretch.from, false)?;
        self.instants.push(first.now.instant);
        let mut left = first;
        for border in borders.get(1..).unwrap_or_default() {
            let right = self.end(stretch, *border, false)?;
            self.panel(stretch, [&left, &right], PanelHistory::default())?;
            left = right;
        }
        if stretch.moves {
            let gain = left.now.energy - first.now.energy;
            self.gain += gain;
            let [work, spent] = self.sums.work();
            let [work_before, spent_before] = before.work();
            let off = (work - work_before) - (spent - spent_before) - gain;
            if off.abs() > self.unbalanced.1 {
                self.unbalanced = (span, off.abs());
            }
        } else {
            // Creeping below the standstill speed does no work.
            let [work, spent] = self.sums.work();
            let [work_before, spent_before] = before.work();
            self.gain += (work - work_before) - (spent - spent_before);
        }
        Ok(())
    }

    /// Adds a panel, or its parts.
    fn panel(
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

    /// The panel cut at these times.
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
        if error > self.worst.1 {
            self.worst = (span, error);
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

    /// Whether the errors are within the tolerance and the energy balances.
    fn judge(&self) -> Result<(), DutyError> {
        let reached = self.sums.reached();
        if reached > MOST_OF_TOLERANCE * self.tolerance {
            return Err(DutyError::Rough {
                span: self.worst.0,
                reached,
                tolerance: self.tolerance,
            });
        }
        let [work, spent] = self.sums.work();
        let spent = spent + self.gain;
        let moved = self.sums.moved();
        let share = if moved > 0.0 {
            (work - spent).abs() / moved
        } else {
            0.0
        };
        // Carriages bring their own energy.
        let is_whole = !self.moving.file.schedule.flows();
        let most = if self.moving.motion.is_recorded() {
            OF_ROWS
        } else {
            OF_LAWS
        };
        if is_whole && share > most + MOST_OF_TOLERANCE * self.tolerance {
            return Err(DutyError::Unbalanced {
                work,
                spent,
                share,
                span: self.unbalanced.0,
            });
        }
        Ok(())
    }
}
