//! The machine at an instant of its motion.

use jred::error::Error;
use jred::machine::motion::State;
use jred::machine::{Reduction, TorqueTerms};
use jred::mechanism::TrainOutput;

use super::Instant;
use jred_file::model::drive_train::DriveTrain;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;

/// Share of a stretch at which a move from rest counts as moving; at its start it has at most this share of that speed.
const START_SHARE: f64 = 1e-3;

/// The machine in its motion. A dwell requests one position at every time step, so the last one is cached.
pub(super) struct MovingMachine<'a> {
    pub(super) file: &'a MachineFile,
    pub(super) motion: &'a Motion,
    last: Option<(f64, usize, Reduction)>,
}

/// An instant, with additional data for its integrals.
#[derive(Clone, Copy, Debug)]
pub(super) struct DutyInstant {
    pub(super) instant: Instant,
    /// Power lost in the drive train, including friction of its branches (W).
    pub(super) loss: f64,
    /// Sum of the magnitudes of the torque's terms at the input (N·m), the scale of its rounding.
    pub(super) magnitude: f64,
    /// Speed of the input per speed of the drive link.
    pub(super) ratio: f64,
    /// Kinetic and potential energy, including the drive train (J).
    pub(super) energy: f64,
}

impl<'a> MovingMachine<'a> {
    pub(super) const fn new(file: &'a MachineFile, motion: &'a Motion) -> Self {
        Self {
            file,
            motion,
            last: None,
        }
    }

    /// The reduction, and the torque of carriages from their motion along their guides, which is not a process load.
    fn parts(&mut self, now: &ScheduleInstant, phi: f64) -> Result<(Reduction, f64), Error> {
        if !self.file.schedule.flows() {
            return Ok((self.reduction(now, phi)?, 0.0));
        }
        let machine = self.file.machine_at(now, phi)?;
        let reduction = self.file.reduction_of(&machine, phi)?;
        self.file.apart(&machine, reduction, phi)
    }

    fn reduction(&mut self, now: &ScheduleInstant, phi: f64) -> Result<Reduction, Error> {
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

    /// Torque against friction in the joints, in a motion or in the direction of the one that begins.
    fn friction(
        &self,
        now: &ScheduleInstant,
        state: &State<f64>,
        direction: f64,
    ) -> Result<f64, Error> {
        if self.file.machine.frictions().is_empty() {
            return Ok(0.0);
        }
        let machine = self.file.machine_at(now, state.phi)?;
        let friction = machine.friction_at(state.phi, state.omega, direction)?;
        Ok(friction.torque(state.alpha)?[0])
    }

    /// The direction of the move that begins from rest with this stretch, if it must overcome static friction.
    pub(super) fn starts(&self, [from, to]: [f64; 2]) -> Option<f64> {
        if !self.file.schedule.has_static_friction() {
            return None;
        }
        let speed = |share: f64| self.motion.at(from + share * (to - from)).omega;
        let ahead = speed(START_SHARE);
        (speed(0.0).abs() <= START_SHARE * ahead.abs() && ahead != 0.0).then(|| ahead.signum())
    }

    /// The machine at time `t` of its motion.
    pub(super) fn at(&mut self, t: f64) -> Result<DutyInstant, Error> {
        let state = self.motion.at(t);
        let now = ScheduleInstant::of(t, state.omega);
        let (reduction, carriages) = self.parts(&now, state.phi)?;
        let mut terms = reduction.torque(state.omega, state.alpha);
        terms.velocity += carriages;
        let friction = self.friction(&now, &state, state.omega)?;
        Ok(self.with(t, state, &reduction, terms, friction))
    }

    /// The moment before a move in this `direction` begins from rest: with static friction, without acceleration. It has no weight.
    pub(super) fn breakaway(&mut self, t: f64, direction: f64) -> Result<Instant, Error> {
        let state = State {
            omega: 0.0,
            alpha: 0.0,
            ..self.motion.at(t)
        };
        let now = ScheduleInstant::starting(t, direction);
        let (reduction, carriages) = self.parts(&now, state.phi)?;
        let terms = TorqueTerms {
            coulomb: reduction.coulomb * direction,
            velocity: carriages,
            ..reduction.torque(0.0, 0.0)
        };
        let friction = self.friction(&now, &state, direction)?;
        let DutyInstant { instant, .. } = self.with(t, state, &reduction, terms, friction);
        Ok(instant.towards(&self.file.drive_train, direction))
    }

    fn with(
        &self,
        t: f64,
        state: State<f64>,
        reduction: &Reduction,
        mut terms: TorqueTerms,
        joint_friction: f64,
    ) -> DutyInstant {
        terms.coulomb += joint_friction;
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let inertia = reduction.inertia;
        let input = train.input(&TrainOutput {
            torque: terms.total(),
            torque_per_alpha: inertia,
            omega: state.omega,
            alpha: state.alpha,
            direction: state.omega,
        });
        let instant = Instant {
            t,
            weight: 0.0,
            phi: state.phi,
            omega: state.omega,
            alpha: state.alpha,
            direction: state.omega,
            inertia,
            terms,
            joint_friction,
            input_torque: input.torque,
            input_speed: state.omega * ratio,
            input_alpha: state.alpha * ratio,
            input_inertia: inertia / (ratio * ratio) + train.inertia_at_input(),
        };
        let speed = instant.input_speed;
        let squared = instant.input_inertia * speed * speed;
        let magnitudes: f64 = terms.values().into_iter().map(f64::abs).sum();
        let accelerating = (instant.input_inertia * instant.input_alpha).abs();
        DutyInstant {
            loss: input.loss,
            magnitude: magnitudes / ratio.abs() + accelerating,
            ratio,
            energy: 0.5 * squared + reduction.potential_energy,
            instant,
        }
    }
}

impl Instant {
    /// The same with a drive train about to move in this direction, which selects its losses.
    fn towards(mut self, train: &DriveTrain, direction: f64) -> Self {
        self.direction = direction;
        self.input_torque = train.input(&self.output()).torque;
        self
    }

    /// The required output of the drive train.
    pub(super) fn output(&self) -> TrainOutput {
        TrainOutput {
            torque: self.terms.total(),
            torque_per_alpha: self.inertia,
            omega: self.omega,
            alpha: self.alpha,
            direction: self.direction,
        }
    }
}
