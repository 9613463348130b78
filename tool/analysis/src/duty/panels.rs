//! The instants of a motion: Gauss-Kronrod places on panels that are halved until the errors of all integrals are known to be small.
//!
//! A smooth stretch of the motion starts with panels for about the requested number of instants, and some for each turn. A panel in which the power
//! through a stage with losses, or at the input, changes sign is cut there. A panel that contains rows of a recorded motion is cut at a row until it
//! contains no row.

mod panel;
mod signs;
mod stretch;

use super::error::DutyError;
use super::integrands::{COUNT, Sums, integrands, of_whole};
use super::moving_machine::MovingMachine;
use super::stretches::turns;
use super::{Instant, Sampling, Smooth, refined};
use jred_file::number::quadrature::GAUSS_3;
use panel::{PanelEnd, PanelHistory};
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

/// Factor by which the sum of all panels' errors may exceed the tolerance, because each estimate is cautious.
const MOST_OF_TOLERANCE: f64 = 4.0;

/// Allowed imbalance as a share of the exchanged energy. Rounded positions, speeds and accelerations of recorded rows match only to some digits;
/// those of a law match except for rounding.
const OF_ROWS: f64 = 1e-3;
const OF_LAWS: f64 = 1e-7;

/// A span of time [s, s], and its error.
#[derive(Clone, Copy)]
struct SpanError {
    span: [f64; 2],
    error: f64,
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
    /// The panel with the largest error.
    worst: SpanError,
    /// Gain of energy (J).
    gain: f64,
    /// The stretch with the largest difference of work and energy (J).
    unbalanced: SpanError,
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
        let stretches: Vec<Stretch> = (stretches.iter().zip(&each))
            .map(|(stretch, turns)| {
                let (from, to) = *stretch;
                let by_time = sampling.steps as f64 / 15.0 * (to - from) / duration;
                let count = if *turns > 1.0 {
                    // The same panels in each turn: at constant speed all turns are then alike.
                    near_whole(turns * (by_time / turns).max(of_turn).ceil())
                } else {
                    by_time.max(turns * of_turn).ceil().max(1.0)
                };
                Stretch::new(file, motion, *stretch, count)
            })
            .collect();
        let count: usize = stretches.iter().map(|s| s.borders.len() - 1).sum();
        let rows: usize = stretches.iter().map(|s| s.rows.len()).sum();
        let none = SpanError {
            span: [0.0, duration],
            error: 0.0,
        };
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
            worst: none,
            gain: 0.0,
            unbalanced: none,
        };
        panels.estimate(&stretches, count)?;
        for stretch in &stretches {
            panels.stretch(stretch)?;
        }
        panels.judge()?;
        Ok(panels)
    }

    /// Approximate sizes of the integrals, and the largest torques.
    fn estimate(&mut self, stretches: &[Stretch], count: usize) -> Result<(), DutyError> {
        let stride = count.div_ceil(MOST_FOR_SIZES);
        let mut number = 0;
        let mut noise = 0.0f64;
        for stretch in stretches {
            for ends in stretch.borders.windows(2) {
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

    fn stretch(&mut self, stretch: &Stretch) -> Result<(), DutyError> {
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
        for border in stretch.borders.iter().skip(1) {
            let right = self.end(stretch, *border, false)?;
            self.panel(stretch, [&left, &right], PanelHistory::default())?;
            left = right;
        }
        if stretch.moves {
            let gain = left.now.energy - first.now.energy;
            self.gain += gain;
            let [work, spent] = self.sums.work();
            let [work_before, spent_before] = before.work();
            let error = ((work - work_before) - (spent - spent_before) - gain).abs();
            if error > self.unbalanced.error {
                self.unbalanced = SpanError { span, error };
            }
        } else {
            // Creeping below the standstill speed does no work.
            let [work, spent] = self.sums.work();
            let [work_before, spent_before] = before.work();
            self.gain += (work - work_before) - (spent - spent_before);
        }
        Ok(())
    }

    /// Whether the errors are within the tolerance and the energy balances.
    fn judge(&self) -> Result<(), DutyError> {
        let reached = self.sums.reached();
        if reached > MOST_OF_TOLERANCE * self.tolerance {
            return Err(DutyError::Rough {
                span: self.worst.span,
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
                span: self.unbalanced.span,
            });
        }
        Ok(())
    }
}
