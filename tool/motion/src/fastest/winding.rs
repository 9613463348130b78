//! The fastest motion in which the motor's winding stays within a temperature limit.
//!
//! The model is that of sizing and of the simulation ([`Model`]): winding and housing against the surroundings, with the copper's resistance at the
//! winding's temperature. It uses the steady periodic state, when the motion with its pauses repeats endlessly, and takes the greatest temperature of
//! the cycle, ripple included.
//!
//! A cycle that is short against the winding's time constant heats it by its mean losses only, so the limit becomes a limit of the RMS torque R. The
//! greatest temperature rises with R, and a search finds the R at its limit. The next R is the one at which the last motion, with all torques scaled
//! equally, would reach the limit, ripple and growth of the resistance included. Where it leaves the interval between too warm and cool enough, the
//! midpoint is used.
//!
//! For a cycle that is long against the time constant, the search uses the greatest temperature of the periodic state in the same way. The motion is
//! then the fastest one with its RMS torque; another motion that distributes the heat differently over the cycle may be faster.

use jred::error::Error;
use jred_file::model::machine::MachineFile;
use jred_file::model::operation::Operation;
use jred_file::model::surroundings::{REFERENCE, Surroundings};
use jred_file::units::Sentence;
use jred_sizing::catalogue::{DeratingBasis, Drive, Motor};
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::thermal::loss_curve::{LossCurve, PeakRise};
use jred_sizing::thermal::{Heating, Model};

use super::cycle::{Cost, Cycle};
use super::{Binding, NoMotion, Rms};
use crate::path_dynamics::{Actuator, BothDirections};
use crate::trace::Trace;

/// Share of the allowed rise by which the greatest temperature may lie below its limit.
const TEMPERATURE_TOLERANCE: f64 = 1e-4;

/// Relative accuracy of the limit of the RMS torque, and the one with which it is decided that no motion is cool enough.
const RMS_TOLERANCE: f64 = 1e-4;
const COARSE_RMS_TOLERANCE: f64 = 0.02;

/// Most motions that are tried.
const TRIES: u32 = 24;

/// Least and largest number of parts of a step, between which the losses are linear.
const PARTS: [f64; 2] = [4.0, 4096.0];

/// Longest part of a step as a share of the network's fastest time constant, for the mean temperature.
const PART: f64 = 0.02;

/// Accuracy of a proportion of torques.
const PROPORTION: f64 = 1e-5;

/// Least proportion of torques from one try to the next.
const LEAST: f64 = 0.25;

/// Why the temperature of a motor is unknown.
#[derive(Clone, Copy, Debug)]
pub enum UnknownTemperature {
    /// Its model needs data that are missing.
    Figures(Sentence),
    /// The rise is known only as a share of the rated rise, and the winding's maximum temperature is missing.
    RatedRise,
}

/// The motor of a drive as a thermal body.
#[derive(Clone, Debug)]
pub struct Winding {
    motor: Motor,
    prepared: MotorLimits,
    surroundings: Surroundings,
    operation: Operation,
}

/// The temperatures (°C) of a winding in the steady periodic state.
#[derive(Clone, Debug, PartialEq)]
pub struct Temperatures {
    /// The greatest temperature; infinite: unbounded.
    pub greatest: f64,
    /// The mean over an endlessly repeated cycle, and the difference of greatest and least, where they are computed.
    pub mean: Option<[f64; 2]>,
    /// The temperatures over the time (s) of such a cycle.
    pub course: Vec<(f64, f64)>,
    /// Data that the model used.
    pub heating: Heating,
    /// Whether winding and housing are one body.
    pub whole: bool,
}

/// A motion whose winding stays within a temperature limit.
#[derive(Clone, Debug)]
pub struct ThermalResult {
    /// The motion.
    pub cycle: Cycle,
    /// Its temperatures.
    pub temperatures: Temperatures,
    /// The limit (°C).
    pub limit: f64,
    /// Where the limit is active: the duration (s) of the motion without it, and the resulting RMS torque (N·m).
    pub bound: Option<[f64; 2]>,
}

impl Winding {
    /// The winding of a drive in the surroundings and the operation of a machine file.
    pub fn new(drive: &Drive, file: &MachineFile) -> Self {
        Self {
            motor: drive.motor.clone(),
            prepared: MotorLimits::new(drive.motor, drive.amplifier, &file.site),
            surroundings: file.site.surroundings,
            operation: file.site.duty.operation,
        }
    }

    /// Temperature (°C) of the surroundings.
    pub const fn ambient(&self) -> f64 {
        self.surroundings.ambient
    }

    /// The maximum temperature (°C) of the winding, if given.
    pub const fn maximum(&self) -> Option<f64> {
        self.motor.thermal.max_temperature
    }

    fn model(&self, duration: f64) -> Result<Model, UnknownTemperature> {
        Model::of(&self.motor, &self.prepared, &self.surroundings, duration)
            .map_err(UnknownTemperature::Figures)
    }

    /// Kelvin per unit of a model's rise; thin air increases it.
    fn unit(&self, model: &Model) -> Result<f64, UnknownTemperature> {
        let rated = if matches!(model, Model::Relative { .. }) {
            let derated = self.motor.derated(&self.surroundings);
            let from = match derated.temperature {
                // A share of one is the rise after the maker's derating.
                DeratingBasis::Maker => self.surroundings.ambient,
                _ => REFERENCE,
            };
            let limit = self.motor.thermal.max_temperature.map(|t| t - from);
            limit
                .filter(|rise| *rise > 0.0)
                .ok_or(UnknownTemperature::RatedRise)?
        } else {
            1.0
        };
        Ok(rated / self.surroundings.altitude_factor())
    }

    /// Checks that a temperature can be computed.
    ///
    /// # Errors
    /// The missing data.
    pub fn known(&self) -> Result<(), UnknownTemperature> {
        let model = self.model(1.0)?;
        let course = LossCurve::new(&[], 1.0);
        self.heating(&model, &course, 0.0)?;
        self.unit(&model).map(|_| ())
    }

    /// The losses of a motion.
    fn course(
        &self,
        model: &Model,
        file: &MachineFile,
        actuator: &Actuator,
        trace: &Trace,
    ) -> Result<LossCurve, Error> {
        let ways = BothDirections::new(file, actuator);
        let longest = model.network().map(|network| PART * network.fastest());
        let mut points = Vec::new();
        for [a, b] in trace.steps() {
            let [least, most] = PARTS;
            let parts = longest.map_or(least, |longest| (b.step / longest).ceil());
            let parts = parts.clamp(least, most) as u32;
            for k in 0..=parts {
                let share = f64::from(k) / f64::from(parts);
                let state = b.after(a, share);
                let torque = ways.torque(&state, b.phi - a.phi)?;
                let speed = ways.forwards().motor_speed(state.omega);
                let t = a.t + share * b.step;
                points.push(model.point(&self.motor, &self.prepared, t, [torque, speed]));
            }
        }
        Ok(LossCurve::new(&points, trace.duration()))
    }

    /// The hottest rises for losses; at rest beside the cycle the motor gives `held` (N·m).
    fn heating(
        &self,
        model: &Model,
        course: &LossCurve,
        held: f64,
    ) -> Result<Heating, UnknownTemperature> {
        let held = match self.operation {
            Operation::Intermittent { holding: true, .. } => held,
            _ => 0.0,
        };
        let rest = model.at_rest(&self.prepared, held);
        model
            .heated(|| course.clone(), || course.mean(), &self.operation, rest)
            .map_err(UnknownTemperature::Figures)
    }

    fn greatest(&self, unit: f64, heating: &Heating) -> f64 {
        match heating.hottest {
            PeakRise::Rise([winding, _]) => self.ambient() + unit * winding,
            PeakRise::Runaway => f64::INFINITY,
        }
    }

    /// The temperatures of a motion, and the factor for all its torques at which the greatest would be `limit` (°C).
    ///
    /// # Errors
    /// Data are missing, or the mechanism cannot be placed somewhere.
    pub fn temperatures(
        &self,
        file: &MachineFile,
        actuator: &Actuator,
        cycle: &Cycle,
        limit: f64,
    ) -> Result<(Temperatures, f64), NoMotion> {
        let unknown = |_| NoMotion::WindingUnknown;
        let trace = &cycle.trace;
        let model = self.model(trace.duration()).map_err(unknown)?;
        let unit = self.unit(&model).map_err(unknown)?;
        let course = self.course(&model, file, actuator, trace)?;
        let held = cycle.load.holding;
        let at = |share: f64| {
            let scaled = course.scaled(share);
            let heating = self.heating(&model, &scaled, share * held)?;
            Ok::<_, UnknownTemperature>((self.greatest(unit, &heating), heating))
        };
        let (greatest, heating) = at(1.0).map_err(unknown)?;
        let network = model.network();
        let periodic = match (network, self.operation) {
            (Some(network), Operation::Continuous) => course.periodic(&network),
            _ => None,
        };
        let ambient = self.ambient();
        let shown = |(t, [winding, _]): (f64, [f64; 2])| (t, ambient + unit * winding);
        let periodic: Vec<(f64, f64)> = periodic.into_iter().flatten().map(shown).collect();
        // Bracket of the factor: cool enough, and too warm.
        let (mut low, mut high) = (0.0, 1.0);
        while greatest > limit && high - low > PROPORTION {
            let middle = 0.5 * (low + high);
            if at(middle).map_err(unknown)?.0 > limit {
                high = middle;
            } else {
                low = middle;
            }
        }
        let share = if greatest > limit { low } else { 1.0 };
        let temperatures = Temperatures {
            greatest,
            mean: mean(&periodic, greatest),
            course: periodic,
            heating,
            whole: !network.is_some_and(|network| network.has_housing()),
        };
        Ok((temperatures, share))
    }
}

/// Mean of a course over time, and the difference of its greatest and least value.
fn mean(course: &[(f64, f64)], greatest: f64) -> Option<[f64; 2]> {
    let (first, last) = course.first().zip(course.last())?;
    let pairs = course.windows(2);
    let sum: f64 = pairs
        .map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0))
        .sum();
    let least = course.iter().map(|(_, value)| *value);
    let least = least.fold(f64::INFINITY, f64::min);
    Some([sum / (last.0 - first.0), greatest - least])
}

/// The motion whose winding is no warmer than `limit` (°C), besides a limit of the RMS torque.
///
/// `at` makes the fastest motion under a limit of the RMS torque.
///
/// # Errors
/// Those of `at`, with the index of a move; [`NoMotion::TooWarm`].
pub fn cooled(
    winding: &Winding,
    limit: f64,
    file: &MachineFile,
    actuator: &Actuator,
    rms: Option<Rms>,
    at: impl Fn(Option<Rms>) -> Result<Cycle, (Option<usize>, NoMotion)>,
) -> Result<ThermalResult, (Option<usize>, NoMotion)> {
    let free = at(rms)?;
    let margin = TEMPERATURE_TOLERANCE * (limit - winding.ambient());
    let aim = limit - 0.5 * margin;
    let look = |cycle: &Cycle| {
        let found = winding.temperatures(file, actuator, cycle, aim);
        found.map_err(|why| (None, why))
    };
    let (temperatures, mut share) = look(&free)?;
    if temperatures.greatest <= limit {
        return Ok(ThermalResult {
            cycle: free,
            temperatures,
            limit,
            bound: None,
        });
    }
    let mut coolest = temperatures.greatest;
    let endless = free.moves.iter().any(|made| made.task.endless);
    let refused = |coolest: f64| {
        let why = NoMotion::TooWarm {
            greatest: coolest,
            limit,
            ambient: winding.ambient(),
            endless,
        };
        Err((None, why))
    };
    if endless {
        return refused(coolest);
    }
    // RMS torques that are too small or cool enough, and too large.
    let (mut low, mut high) = (0.0, free.load.rms);
    let mut best: Option<(Cycle, Temperatures)> = None;
    let mut next = high * share.max(LEAST);
    for _ in 0..TRIES {
        match at(Some(Rms::Torque(next))) {
            Ok(cycle) => {
                let (temperatures, own) = look(&cycle)?;
                share = own;
                coolest = coolest.min(temperatures.greatest);
                if temperatures.greatest > limit {
                    high = next;
                    next *= share.max(LEAST);
                } else {
                    low = next;
                    let near = limit - temperatures.greatest <= margin;
                    // Copper loss grows with the square of the torque.
                    let rise = temperatures.greatest - winding.ambient();
                    next *= ((aim - winding.ambient()) / rise).sqrt();
                    best = Some((cycle, temperatures));
                    if near {
                        break;
                    }
                }
            }
            // Motions slower than this are not found.
            Err((_, NoMotion::RmsTooLarge { .. } | NoMotion::NotFound { .. })) => low = next,
            Err(why) => return Err(why),
        }
        if next <= low || next >= high {
            next = low.midpoint(high);
        }
        // If every motion is too warm, less accuracy is enough.
        let near = if best.is_some() {
            RMS_TOLERANCE
        } else {
            COARSE_RMS_TOLERANCE
        };
        if high - low <= near * high {
            break;
        }
    }
    let Some((mut cycle, temperatures)) = best else {
        return refused(coolest);
    };
    for (made, before) in cycle.moves.iter_mut().zip(&free.moves) {
        for phase in &mut made.fastest.phases {
            if phase.limit == Binding::RmsTorque {
                phase.limit = Binding::WindingTemperature;
            }
        }
        made.costs.push(Cost {
            limit: Binding::WindingTemperature,
            time: before.fastest.time,
        });
    }
    Ok(ThermalResult {
        bound: Some([free.trace.duration(), cycle.load.rms]),
        cycle,
        temperatures,
        limit,
    })
}
