//! The duty: the load that one cycle of the motion puts on the drive, independent of any motor.

use std::ops::Range;

use jred::machine::TorqueTerms;

use crate::duty::mechanics::{HoldingTorques, Mechanics, Rest, constant_loads};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::number::figures::Figures;

mod error;
mod integrands;
pub mod mechanics;
mod moving_machine;
mod panels;
mod refined;
mod smooth;
mod stretches;

pub use error::DutyError;
use moving_machine::MovingMachine;
pub use panels::MOST_INSTANTS;
use panels::Panels;
use refined::insert_extremes;
pub use smooth::{MOST_RAISED, Panel, PanelPolynomial, Smooth};
pub(crate) use stretches::{passages, smooth_stretches, turns};

/// One instant of the cycle. "Input" is the input shaft of the machine's fixed drive train, which is coupled to a motor or to the output of its
/// gearbox.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// Time (s).
    pub t: f64,
    /// Weight in the integral over the cycle (s).
    pub weight: f64,
    /// φ of the drive link (rad), continuous over several turns.
    pub phi: f64,
    /// ω of the drive link (rad/s).
    pub omega: f64,
    /// α of the drive link (rad/s²).
    pub alpha: f64,
    /// Sign of the motion, or of the motion that begins here from rest.
    pub direction: f64,
    /// J_red of the mechanism at the drive link, without drive train (kg·m²).
    pub inertia: f64,
    /// Torque at the drive link, term by term, without drive train (N·m).
    pub terms: TorqueTerms,
    /// Torque against friction by a coefficient in the joints (N·m), contained in the Coulomb term.
    pub joint_friction: f64,
    /// Torque at the input (N·m), losses and inertia of the drive train included.
    pub input_torque: f64,
    /// Speed at the input (rad/s).
    pub input_speed: f64,
    /// Acceleration at the input (rad/s²).
    pub input_alpha: f64,
    /// J at the input: (J_red + drive train) reduced to it (kg·m²).
    pub input_inertia: f64,
}

/// A cycle as instants with integration weights.
#[derive(Clone, Debug)]
pub struct Duty {
    /// The instants, in order of time.
    pub instants: Vec<Instant>,
    /// Length of the cycle (s).
    pub duration: f64,
    /// Largest torque (N·m) at the input that holds the machine at rest, without losses or the help of friction: against the weight at any position,
    /// with a payload wherever it is carried, and against weight and process loads at standstill.
    pub hold_torque: f64,
    /// Data for the mechanical rules.
    pub mechanics: Mechanics,
    /// Starts of the smooth stretches among the instants.
    pub smooth: Smooth,
}

/// Default least number of instants of a cycle (about).
pub const STEPS: usize = 2000;

/// Share of a smooth stretch by which its ends are moved inside: a jump there belongs to both sides.
pub(crate) const INSIDE: f64 = 1e-9;

/// Sampling of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Relative error of the integrals over the cycle.
    pub tolerance: f64,
    /// Least number of instants of a cycle (about), for its course.
    pub steps: usize,
}

/// Default relative error of the integrals.
pub const TOLERANCE: f64 = 1e-9;

/// Smallest error that can be requested: rounding is close below.
pub const LEAST_TOLERANCE: f64 = 1e-12;

impl Default for Sampling {
    fn default() -> Self {
        STEPS.into()
    }
}

impl From<usize> for Sampling {
    fn from(steps: usize) -> Self {
        Self {
            steps,
            tolerance: TOLERANCE,
        }
    }
}

/// Share of the largest torque of the motion below which weight and loads do not move the machine: the motor's own friction and cogging hold it.
const HELD_SHARE: f64 = 0.01;

/// The machine at these times (s) of its motion, without weights: for a table over the time. Where the acceleration jumps, the later one.
///
/// # Errors
/// An error of the machine.
pub fn course(
    file: &MachineFile,
    motion: &Motion,
    times: impl Iterator<Item = f64>,
) -> Result<Vec<Instant>, DutyError> {
    let mut moving = MovingMachine::new(file, motion);
    let instants = times.map(|t| Ok(moving.at(t)?.instant));
    instants.collect()
}

impl Duty {
    /// Samples the machine's motion so that the error of every integral over it is known and not above the tolerance. It uses Gauss-Kronrod
    /// quadrature on panels, each in a smooth part of the motion, and halves the panels until the errors are small enough. The ends of a stretch are
    /// moved inside, so that a jump of the acceleration belongs to both sides.
    ///
    /// # Errors
    /// An error of the machine; integrals that do not reach the tolerance; energy that does not balance.
    pub fn new(
        file: &MachineFile,
        motion: &Motion,
        sampling: impl Into<Sampling>,
    ) -> Result<Self, DutyError> {
        let duration = motion.duration();
        let mut moving = MovingMachine::new(file, motion);
        let stretches = smooth_stretches(file, motion);
        let panels = Panels::new(&mut moving, &stretches, sampling.into())?;
        let Panels {
            mut instants,
            mut smooth,
            ..
        } = panels;
        insert_extremes(&mut moving, &mut instants, &mut smooth)?;
        let ratio = file.drive_train.ratio();
        let (mut weights, mut unheld) = (Vec::new(), 0.0f64);
        for (_, reduction) in file.over_range()? {
            weights.push(reduction.potential_slope);
            unheld = unheld.max(reduction.potential_slope.abs() - reduction.coulomb);
        }
        let laden = instants.iter().filter(|i| file.schedule.is_laden(i.t));
        weights.extend(laden.map(|i| i.terms.potential));
        let held = HoldingTorques {
            instants: &instants,
            constant: &constant_loads(file, &instants)?,
            duration,
            cyclic: file.motion.as_ref().is_some_and(|m| m.cyclic),
        };
        let rest = Rest::new(&held, weights.into_iter()).times(1.0 / ratio.abs());
        let hold_torque = rest.largest();
        let mut looked_at = None;
        for at_rest in instants.iter().filter(|i| i.omega == 0.0) {
            // A dwell has many instants at one place.
            if looked_at.replace(at_rest.phi.to_bits()) != Some(at_rest.phi.to_bits()) {
                let terms = &at_rest.terms;
                let held = file.bare_reduction(at_rest.phi)?.coulomb;
                unheld = unheld.max((terms.potential + terms.process).abs() - held);
            }
        }
        let largest = (instants.iter()).fold(0.0, |most, i| f64::max(most, i.terms.total().abs()));
        let mechanics = Mechanics {
            falls: unheld > HELD_SHARE * largest,
            ..Mechanics::new(file, &instants, &smooth, duration, rest)
        };
        Ok(Self {
            instants,
            duration,
            hold_torque,
            mechanics,
            smooth,
        })
    }

    /// Integral of a quantity over the cycle.
    pub fn integral(&self, quantity: impl Fn(&Instant) -> f64) -> f64 {
        self.integral_of(self.instants.iter().map(quantity))
    }

    /// Integral of the values of a quantity, one for each instant.
    pub fn integral_of(&self, values: impl Iterator<Item = f64>) -> f64 {
        let weighted = self.instants.iter().zip(values);
        weighted
            .map(|(instant, value)| instant.weight * value)
            .sum()
    }

    /// Extremes, mean and RMS of a quantity over the instants. For quantities that do not depend on the motor, the extremes are among the instants:
    /// inertia, speed, acceleration, torque and power at the input, and torque at the drive link.
    pub fn figures(&self, quantity: impl Fn(&Instant) -> f64) -> Figures {
        self.figures_at(|k| quantity(&self.instants[k]), |_, _| None)
    }

    /// The same for the values of a quantity, one for each instant.
    pub fn figures_of(&self, values: &[f64]) -> Figures {
        self.figures_at(|k| values[k], |_, _| None)
    }

    /// The same for a quantity that depends on the motor: its extremes may lie between the instants.
    pub fn figures_between(&self, values: &[f64]) -> Figures {
        let between = |k: usize, sign: f64| {
            let panels = self.smooth.panels_beside(k, self.instants.len());
            let peaks = panels.filter_map(|range| {
                let panel = self.panel(range)?;
                let over = panel.values(|k| sign * values[k]);
                let time = |k: usize| self.instants[k].t;
                let (_, value) = panel.peak(k, time, |k| sign * values[k], |x| over.at(x))?;
                Some(value)
            });
            peaks.max_by(f64::total_cmp).map(|value| sign * value)
        };
        self.figures_at(|k| values[k], between)
    }

    /// The panel of these instants.
    fn panel(&self, range: Range<usize>) -> Option<Panel> {
        let at = |k: usize| [self.instants[k].t, self.instants[k].weight];
        Panel::of(range, at)
    }

    fn figures_at(
        &self,
        value: impl Fn(usize) -> f64,
        between: impl Fn(usize, f64) -> Option<f64>,
    ) -> Figures {
        let (mut sum, mut squares) = (0.0, 0.0);
        let [mut least, mut largest] = [(0, f64::INFINITY), (0, f64::NEG_INFINITY)];
        for (k, instant) in self.instants.iter().enumerate() {
            let value = value(k);
            if value < least.1 {
                least = (k, value);
            }
            if value > largest.1 {
                largest = (k, value);
            }
            sum += instant.weight * value;
            squares += instant.weight * value * value;
        }
        Figures {
            min: between(least.0, -1.0).unwrap_or(least.1),
            mean: sum / self.duration,
            max: between(largest.0, 1.0).unwrap_or(largest.1),
            rms: (squares / self.duration).sqrt(),
        }
    }
}
