//! The duty: the load that one cycle of the motion puts on the drive, independent of any motor.

use jred::machine::TorqueTerms;
use jred::machine::motion::State;
use jred::mechanism::TrainOutput;
use jred::{Error, Reduction};

use crate::analysis::mechanics::{Held, Mechanics, Rest, constant_loads};
use crate::model::drive_train::DriveTrain;
use crate::model::machine::MachineFile;
use crate::model::motion::Motion;
use crate::model::schedule::Now;
use crate::number::figures::Figures;

mod refined;
mod smooth;
mod stretches;

use refined::{MOST_INSTANTS, MOST_PARTS, insert_extremes, refine_bends};
pub use smooth::{MOST_RAISED, Smooth};
use stretches::{Part, parts};
pub(crate) use stretches::{passages, smooth_stretches};

/// One instant of the cycle. "Input" is the input shaft of the machine's fixed drive train: what a motor or the
/// output of its gearbox is coupled to.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// Time (s).
    pub t: f64,
    /// Weight in the integral over the cycle (s).
    pub weight: f64,
    /// φ of the drive link (rad), as the motion counts it.
    pub phi: f64,
    /// ω of the drive link (rad/s).
    pub omega: f64,
    /// α of the drive link (rad/s²).
    pub alpha: f64,
    /// Its sign is that of the motion, or of the motion that begins here from rest.
    pub direction: f64,
    /// J_red of the mechanism at the drive link, without drive train (kg·m²).
    pub inertia: f64,
    /// Torque at the drive link, term by term, without drive train (N·m).
    pub terms: TorqueTerms,
    /// Torque at the input (N·m), losses and inertia of the drive train included.
    pub input_torque: f64,
    /// Speed at the input (rad/s).
    pub input_speed: f64,
    /// Acceleration at the input (rad/s²).
    pub input_alpha: f64,
    /// J at the input: (J_red + drive train) reduced to it (kg·m²).
    pub input_inertia: f64,
}

/// A cycle as a row of instants with integration weights.
#[derive(Clone, Debug)]
pub struct Duty {
    /// The instants, in order of time.
    pub instants: Vec<Instant>,
    /// Length of the cycle (s).
    pub duration: f64,
    /// Largest torque (N·m) at the input that holds the machine at rest, without losses or the help of friction: against the
    /// weight at any position, with a payload wherever it is carried, and against weight and process loads at standstill.
    pub hold_torque: f64,
    /// Data for the mechanical rules.
    pub mechanics: Mechanics,
    /// Where the instants' smooth stretches begin.
    pub smooth: Smooth,
}

/// Default number of time steps of a cycle.
pub const STEPS: usize = 2000;

/// The ends of a smooth stretch are taken from inside, by this share of it: what jumps there belongs to both sides.
pub(crate) const INSIDE: f64 = 1e-9;

/// Share of a stretch after which a move that begins from rest has a speed; at its start it has this share of that speed at most.
const SLIGHTLY: f64 = 1e-3;

/// How finely a motion is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Time steps of a cycle, about.
    pub steps: usize,
    /// Share of the largest input torque by which the straight line between two instants may miss a peak.
    pub missed: f64,
}

impl Sampling {
    /// Of the many neighbours of a machine whose shares of limits are compared: sums are of fourth order in the step, and a peak is that of
    /// the parabola through three instants (test `neighbours_are_sampled_finely_enough`).
    pub const OF_NEIGHBOURS: Self = Self {
        steps: 250,
        missed: 1e-3,
    };
}

impl From<usize> for Sampling {
    fn from(steps: usize) -> Self {
        Self {
            steps,
            missed: 1e-5,
        }
    }
}

/// Share of the largest torque of the motion below which weight and loads do not move the machine: the motor's own friction
/// and cogging hold that.
const UNHELD: f64 = 0.01;

/// The direction of the move that begins from rest with this stretch, if static friction has to be overcome there.
fn starts(file: &MachineFile, motion: &Motion, [from, to]: [f64; 2]) -> Option<f64> {
    if !file.schedule.has_static_friction() {
        return None;
    }
    let speed = |share: f64| motion.at(from + share * (to - from)).omega;
    let ahead = speed(SLIGHTLY);
    (speed(0.0).abs() <= SLIGHTLY * ahead.abs() && ahead != 0.0).then(|| ahead.signum())
}

/// The machine in its motion. A dwell asks for one position at every step of time: the last one is kept.
struct Moving<'a> {
    file: &'a MachineFile,
    motion: &'a Motion,
    last: Option<(f64, usize, Reduction)>,
}

impl Moving<'_> {
    /// The reduced link, and the torque with which carriages resist by their motion along their guides, which is not among its process
    /// loads.
    fn parts(&mut self, now: &Now, phi: f64) -> Result<(Reduction, f64), Error> {
        if !self.file.schedule.flows() {
            return Ok((self.reduction(now, phi)?, 0.0));
        }
        let machine = self.file.machine_at(now, phi)?;
        let reduction = self.file.reduction_of(&machine, phi)?;
        self.file.apart(&machine, reduction, phi)
    }

    fn reduction(&mut self, now: &Now, phi: f64) -> Result<Reduction, Error> {
        let number = self.file.schedule.number(now);
        if let Some((place, known, reduction)) = &self.last
            && place.to_bits() == phi.to_bits()
            && *known == number
        {
            return Ok(*reduction);
        }
        let reduction = self.file.bare_reduction_at(now, phi)?;
        self.last = Some((phi, number, reduction));
        Ok(reduction)
    }
}

impl Instant {
    /// The machine at time `t` of its motion.
    fn new(moving: &mut Moving, t: f64, weight: f64) -> Result<Self, Error> {
        let state = moving.motion.at(t);
        let (reduction, carriages) = moving.parts(&Now::of(t, state.omega), state.phi)?;
        let mut terms = reduction.torque(state.omega, state.alpha);
        terms.velocity += carriages;
        Ok(Self::with(moving, t, weight, state, &reduction, terms))
    }

    /// The moment before a move in this `direction` begins from rest: static friction, without acceleration. It has no weight.
    fn breakaway(moving: &mut Moving, t: f64, direction: f64) -> Result<Self, Error> {
        let state = State {
            omega: 0.0,
            alpha: 0.0,
            ..moving.motion.at(t)
        };
        let (reduction, carriages) = moving.parts(&Now::starting(t, direction), state.phi)?;
        let terms = TorqueTerms {
            coulomb: reduction.coulomb * direction,
            velocity: carriages,
            ..reduction.torque(0.0, 0.0)
        };
        let instant = Self::with(moving, t, 0.0, state, &reduction, terms);
        Ok(instant.towards(&moving.file.drive_train, direction))
    }

    /// The same with a drive train that is about to move in this direction, which decides on the side of its losses.
    fn towards(mut self, train: &DriveTrain, direction: f64) -> Self {
        self.direction = direction;
        let input = train.input(&TrainOutput {
            torque: self.terms.total(),
            torque_per_alpha: self.inertia,
            omega: self.omega,
            alpha: self.alpha,
            direction,
        });
        self.input_torque = input.torque;
        self
    }

    fn with(
        moving: &Moving,
        t: f64,
        weight: f64,
        state: State<f64>,
        reduction: &Reduction,
        terms: TorqueTerms,
    ) -> Self {
        let train = &moving.file.drive_train;
        let ratio = train.ratio();
        let inertia = reduction.inertia;
        let input = train.input(&TrainOutput {
            torque: terms.total(),
            torque_per_alpha: inertia,
            omega: state.omega,
            alpha: state.alpha,
            direction: state.omega,
        });
        Self {
            t,
            weight,
            phi: state.phi,
            omega: state.omega,
            alpha: state.alpha,
            direction: state.omega,
            inertia,
            terms,
            input_torque: input.torque,
            input_speed: state.omega * ratio,
            input_alpha: state.alpha * ratio,
            input_inertia: inertia / (ratio * ratio) + train.inertia_at_input(),
        }
    }
}

impl Duty {
    /// Samples the machine's motion in about `steps` time steps. Each smooth stretch of the motion, also cut where its acceleration bends,
    /// is cut into an even number of equal steps with Simpson's weights; the ends of a stretch are taken from inside, so that a
    /// jump of the acceleration belongs to both sides.
    ///
    /// # Errors
    /// Those of the machine.
    pub fn new(
        file: &MachineFile,
        motion: &Motion,
        sampling: impl Into<Sampling>,
    ) -> Result<Self, Error> {
        let Sampling { steps, missed } = sampling.into();
        let duration = motion.duration();
        let mut instants = Vec::with_capacity(steps + 1024);
        let mut smooth = Smooth::default();
        let mut moving = Moving {
            file,
            motion,
            last: None,
        };
        let parts = parts(file, motion, Sampling { steps, missed });
        let all: usize = parts.iter().map(|part| part.steps).sum();
        let most_parts = (MOST_INSTANTS / all as f64).clamp(1.0, MOST_PARTS);
        for Part {
            from,
            to,
            steps: n,
            inside,
        } in parts
        {
            let span = to - from;
            let step = span / n as f64;
            if let Some(direction) = starts(file, motion, [from, to]) {
                smooth.begin(instants.len());
                instants.push(Instant::breakaway(&mut moving, from, direction)?);
            }
            let first = instants.len();
            smooth.begin(first);
            for k in 0..=n {
                let weight = match k {
                    _ if k == 0 || k == n => 1.0,
                    _ if k % 2 == 1 => 4.0,
                    _ => 2.0,
                } * step
                    / 3.0;
                let place = (k as f64 / n as f64).clamp(inside, 1.0 - inside);
                instants.push(Instant::new(&mut moving, from + place * span, weight)?);
            }
            refine_bends(&mut moving, first, (missed, most_parts), &mut instants)?;
        }
        insert_extremes(&mut moving, &mut instants, &mut smooth)?;
        let ratio = file.drive_train.ratio();
        let (mut weights, mut unheld) = (Vec::new(), 0.0f64);
        for (_, reduction) in file.over_range()? {
            weights.push(reduction.potential_slope);
            unheld = unheld.max(reduction.potential_slope.abs() - reduction.coulomb);
        }
        let laden = instants.iter().filter(|i| file.schedule.is_laden(i.t));
        weights.extend(laden.map(|i| i.terms.potential));
        let held = Held {
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
            falls: unheld > UNHELD * largest,
            ..Mechanics::new(file, &instants, duration, rest)
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

    /// Extremes, mean and RMS of a quantity over the instants. The extremes of what no motor changes, inertia, speed,
    /// acceleration, torque and power at the input and the torque at the drive link, are instants.
    pub fn figures(&self, quantity: impl Fn(&Instant) -> f64) -> Figures {
        self.figures_at(|k| quantity(&self.instants[k]), |_, _| None)
    }

    /// The same of the values of a quantity, one for each instant.
    pub fn figures_of(&self, values: &[f64]) -> Figures {
        self.figures_at(|k| values[k], |_, _| None)
    }

    /// The same of what a motor changes: its extremes lie between the instants.
    pub fn figures_between(&self, values: &[f64]) -> Figures {
        let time = |k: usize| self.instants[k].t;
        let between = |k: usize, sign: f64| {
            let value = |k: usize| sign * values[k];
            let peak = self.smooth.peak(k, self.instants.len(), time, value)?;
            Some(sign * peak.value)
        };
        self.figures_at(|k| values[k], between)
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
