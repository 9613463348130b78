//! Counterweights and springs that relieve the drive: the best set within given bounds.
//!
//! The torque of a motion is linear in the mass m of a body fixed to a link, in its moments S = m·(u, v) and inertia Θ about the origin of the link's
//! frame, and in the stiffness k of a spring and its product k·l₀ with the free length:
//!
//! ```text
//! T = J·α + ½·J′·ω² + U′ + … = T₀ + Σ p·t,   p = m, S_u, S_v, Θ, k, k·l₀
//! m·Θ ≥ S_u² + S_v²,   m ≤ the most,   Θ ≤ R²·m,   k ≥ 0,   0 ≤ k·l₀ ≤ 3·l_max·k
//! ```
//!
//! The bounds of a real body and a real spring are convex, and so is the RMS or the peak of T. The result is therefore the global optimum, with a
//! stated gap. T is the torque at the drive link, with the inertia of the drive train but without its losses.

use jred::machine::{Element, Mechanism as _, Reducible as _};
use jred_analysis::contact::{OneWay, Separation};
use jred_analysis::duty::{self, Duty, DutyError};
use jred_file::model::coordinate::positions;
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::model::with_mass::AttachedMass;

use self::rows::DesignMatrix;
use self::unknowns::{BalanceParts, Unknowns};

mod barrier;
mod rows;
mod unknowns;

/// Positions over the range at which weight and inertia are evaluated.
const POSITIONS: usize = 1440;

/// Share by which the RMS over the motion may rise for another goal before it is reported.
const RMS_RISE: f64 = 0.1;

/// Share of the largest value below which a value counts as rounding error.
const ROUNDING: f64 = 1e-9;

jred_file::words! {
    /// Quantity to minimise.
    pub enum BalanceGoal default Rms {
        /// RMS of the drive link's torque over the motion: the heat in the motor.
        Rms = "rms",
        /// Its largest value.
        Peak = "peak",
        /// RMS over the positions of the torque that holds the machine at rest: weight, springs and process loads.
        Holding = "holding",
        /// RMS over the positions of the reduced inertia's deviation from its mean.
        Inertia = "inertia",
    }
}

/// A link that may carry a counterweight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counterweight {
    /// Index of the link.
    pub link: usize,
    /// Largest mass (kg).
    pub most: f64,
    /// Largest distance from the origin of the link's frame (m).
    pub reach: f64,
}

impl Counterweight {
    /// Largest m, S_u, S_v and Θ.
    fn most(&self) -> [f64; 4] {
        let moment = self.most * self.reach;
        [self.most, moment, moment, moment * self.reach]
    }
}

/// A balancing request.
#[derive(Clone, Debug)]
pub struct BalanceRequest {
    /// Quantity to minimise.
    pub goal: BalanceGoal,
    /// Links that may carry a counterweight.
    pub counterweights: Vec<Counterweight>,
    /// Springs whose stiffness and free length are unknown, as indices of the file's elements.
    pub springs: Vec<usize>,
    /// How finely the motion is sampled.
    pub sampling: duty::Sampling,
}

/// Why there is no answer.
#[derive(Clone, Debug)]
pub enum BalanceError {
    /// The mechanism cannot be assembled at a position, or the duty of the motion cannot be computed.
    Duty(DutyError),
    /// The goal is a torque over the motion, but the file has no motion.
    NoMotion,
    /// The torque, or the deviation of the inertia, is already zero everywhere.
    Nothing,
    /// No unknown has an effect on the goal.
    NoEffect,
    /// A spring is requested for the inertia, which it does not change.
    SpringForInertia,
    /// With the optimum a follower leaves its cam or a rope goes slack: which one, at which state, with which force, and the cure.
    Parts(Box<Separation>),
}

impl<E: Into<DutyError>> From<E> for BalanceError {
    fn from(error: E) -> Self {
        Self::Duty(error.into())
    }
}

/// Figures of a machine, before or after balancing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BalanceFigures {
    /// RMS and peak of the drive link's torque over the motion (N·m); `None` without a motion.
    pub torque: Option<[f64; 2]>,
    /// RMS and peak at the input of the drive train, with its losses (N·m).
    pub input: Option<[f64; 2]>,
    /// RMS and peak over the positions of the torque that holds it at rest (N·m).
    pub holding: [f64; 2],
    /// Smallest, mean and largest reduced inertia over the positions (kg·m²).
    pub inertia: [f64; 3],
    /// RMS deviation of the inertia from its mean (kg·m²).
    pub deviation: f64,
}

impl BalanceResult {
    /// Share by which the RMS over the motion rises, if by more than a tenth.
    pub fn heats(&self) -> Option<f64> {
        let [Some([was, _]), Some([is, _])] = [self.before.torque, self.after.torque] else {
            return None;
        };
        (is > (1.0 + RMS_RISE) * was).then(|| is / was - 1.0)
    }
}

impl BalanceFigures {
    /// The figure that a goal minimises.
    pub fn of(&self, goal: BalanceGoal) -> f64 {
        let [rms, peak] = self.torque.unwrap_or_default();
        match goal {
            BalanceGoal::Rms => rms,
            BalanceGoal::Peak => peak,
            BalanceGoal::Holding => self.holding[0],
            BalanceGoal::Inertia => self.deviation,
        }
    }
}

/// The optimum.
#[derive(Clone, Debug)]
pub struct BalanceResult {
    /// The counterweights, in the order of the request; `None`: no counterweight is best.
    pub masses: Vec<Option<AttachedMass>>,
    /// The springs, in the order of the request; `None`: no spring is best.
    pub springs: Vec<Option<Element>>,
    /// Largest pull and push of each spring (N; for a torsion spring N·m against and towards growing angles), over the motion, or without a motion
    /// over the range.
    pub efforts: Vec<Option<[f64; 2]>>,
    /// With the springs of the file, without counterweights.
    pub before: BalanceFigures,
    /// With the optimum.
    pub after: BalanceFigures,
    /// Lower bound: no counterweight and spring within the bounds reaches less.
    pub bound: f64,
}

/// Finds the optimum.
///
/// # Errors
/// The machine cannot be assembled, the motion is missing, there is nothing to balance, or nothing has an effect.
pub fn balance(
    file: &MachineFile,
    request: &BalanceRequest,
) -> Result<BalanceResult, BalanceError> {
    if request.goal == BalanceGoal::Inertia && !request.springs.is_empty() {
        return Err(BalanceError::SpringForInertia);
    }
    let rows = DesignMatrix::new(file, request)?;
    let scale = largest(&rows.base);
    if scale <= ROUNDING * rows.largest {
        return Err(BalanceError::Nothing);
    }
    let unknowns = Unknowns::new(file, request, &rows, scale)?;
    let (x, least) = unknowns.least(request.goal, &rows, scale);
    let bound = match request.goal {
        BalanceGoal::Peak => least * scale,
        _ => least.sqrt() * scale,
    };
    let BalanceParts { masses, springs } = unknowns.made(&x, &rows)?;
    let before = figures(file, duty(file, request)?.as_ref())?;
    let mut after = file.clone();
    let replaced = request.springs.iter().copied().zip(springs.iter().copied());
    after.rebuild(masses.iter().flatten(), replaced)?;
    let duty = duty(&after, request)?;
    if let Some(duty) = &duty {
        hold_together(&after, duty)?;
    }
    Ok(BalanceResult {
        efforts: efforts(&after, duty.as_ref(), &springs)?,
        after: figures(&after, duty.as_ref())?,
        before,
        masses,
        springs,
        bound,
    })
}

/// Names of the links on which a counterweight of the request has an effect. Each is tried alone.
pub fn effective(file: &MachineFile, request: &BalanceRequest) -> Vec<String> {
    let Some(asked) = request.counterweights.first() else {
        return Vec::new();
    };
    let mechanism = file.machine.mechanism();
    let links = mechanism.link_names().iter().enumerate();
    let links = links.filter(|(link, _)| {
        let alone = BalanceRequest {
            counterweights: vec![Counterweight {
                link: *link,
                ..*asked
            }],
            springs: Vec::new(),
            ..request.clone()
        };
        let has_effect = || -> Result<(), BalanceError> {
            let rows = DesignMatrix::new(file, &alone)?;
            Unknowns::new(file, &alone, &rows, largest(&rows.base)).map(|_| ())
        };
        has_effect().is_ok()
    });
    links.map(|(_, name)| name.clone()).collect()
}

/// Largest pull and push of these springs over the motion, or without a motion over the range.
fn efforts(
    file: &MachineFile,
    duty: Option<&Duty>,
    springs: &[Option<Element>],
) -> Result<Vec<Option<[f64; 2]>>, BalanceError> {
    let mechanism = file.machine.mechanism();
    let mut efforts: Vec<Option<[f64; 2]>> = springs.iter().map(|s| s.map(|_| [0.0; 2])).collect();
    let range = || positions(mechanism.domain(), POSITIONS).collect();
    let places: Vec<f64> = duty.map_or_else(range, |d| d.instants.iter().map(|i| i.phi).collect());
    for phi in places {
        let frames = mechanism.frames(phi)?;
        for (spring, most) in springs.iter().zip(&mut efforts) {
            if let (Some(spring), Some([pull, push])) = (spring, most) {
                let effort = spring.effort(&frames, 0.0);
                (*pull, *push) = (pull.max(-effort), push.max(effort));
            }
        }
    }
    Ok(efforts)
}

/// The motion of a machine, if it has one.
fn duty(file: &MachineFile, request: &BalanceRequest) -> Result<Option<Duty>, BalanceError> {
    let motion = file.motion.as_ref();
    let duty = motion.map(|motion| Duty::new(file, motion, request.sampling));
    Ok(duty.transpose()?)
}

/// Checks that contacts press and ropes pull over the motion.
fn hold_together(file: &MachineFile, duty: &Duty) -> Result<(), BalanceError> {
    let joints = OneWay::all(file.machine.mechanism());
    if joints.is_empty() {
        return Ok(());
    }
    for instant in &duty.instants {
        let machine =
            file.machine_at(&ScheduleInstant::of(instant.t, instant.omega), instant.phi)?;
        for joint in &joints {
            let force = joint.force(&machine, [instant.phi, instant.omega, instant.alpha])?;
            if !joint.holds(force) {
                let parted = joint.parted(&machine, [instant.phi, instant.omega], force)?;
                return Err(BalanceError::Parts(Box::new(parted)));
            }
        }
    }
    Ok(())
}

/// RMS and largest magnitude over the positions.
fn over_positions(values: &[f64]) -> [f64; 2] {
    let squares: f64 = values.iter().map(|v| v * v).sum();
    [(squares / values.len() as f64).sqrt(), largest(values)]
}

/// Largest magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| most.max(v.abs()))
}

fn figures(file: &MachineFile, duty: Option<&Duty>) -> Result<BalanceFigures, BalanceError> {
    let reductions = positions(file.machine.domain(), POSITIONS)
        .map(|phi| file.machine.bare_reduction(phi))
        .collect::<Result<Vec<_>, _>>()?;
    let holding: Vec<f64> = reductions.iter().map(|r| -r.load_torque()).collect();
    let inertias: Vec<f64> = reductions.iter().map(|r| r.inertia).collect();
    let mean = inertias.iter().sum::<f64>() / inertias.len() as f64;
    let off: Vec<f64> = inertias.iter().map(|j| j - mean).collect();
    let mut figures = BalanceFigures {
        holding: over_positions(&holding),
        inertia: [
            inertias.iter().copied().fold(f64::INFINITY, f64::min),
            mean,
            inertias.iter().copied().fold(0.0, f64::max),
        ],
        deviation: over_positions(&off)[0],
        ..BalanceFigures::default()
    };
    if let Some(duty) = duty {
        let train = file.train_inertia();
        let link = duty.figures(|i| i.terms.total() + train * i.alpha);
        let input = duty.figures(|i| i.input_torque);
        figures.torque = Some([link.rms, link.peak()]);
        figures.input = Some([input.rms, input.peak()]);
    }
    Ok(figures)
}
