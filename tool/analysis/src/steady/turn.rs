//! One cycle, of one or several turns of the drive link: the kinetic energy at its end as a function of that at its start, with the angle as the
//! variable.
//!
//! With z = ½ω², the equation of motion is dz/dφ = α(φ, ω): one equation of first order; time, works and losses are quadratures.

use std::f64::consts::TAU;

use jred::error::Error;

use super::SteadyError;
use crate::simulate::machine::{Instant, Plant};
use crate::simulate::{CoupledMachines, Moment};
use jred_file::model::motor::OwnMotor;
use jred_file::model::simulation::Simulation;
use jred_file::number::numerics;
use jred_file::number::numerics::dormand_prince::{Accuracy, IntegrationError};

/// z = ½ω², time, work of the motor, work of the process loads, losses, ∫T dt and ∫T² dt of the motor.
pub(super) type TurnState = [f64; 7];

/// The accuracy of each step. Only a machine that follows its motor at once needs more steps.
pub(super) const FINE: Accuracy = Accuracy {
    tolerance: 1e-14,
    most_steps: 200_000,
};

/// Accuracy for a yes-or-no question, or for a few digits.
pub(super) const ROUGH: Accuracy = Accuracy {
    tolerance: 1e-9,
    ..FINE
};

/// Share of the works of a cycle below which a gain is computed again more accurately.
const CLOSE: f64 = 1e-6;

/// Share of z at full speed (a three-thousandth of the speed) below which the drive link has stopped.
pub(super) const STANDSTILL_ENERGY: f64 = 1e-7;

/// How far a motion came.
pub(super) enum TurnEnd {
    /// Its end.
    End(TurnState),
    /// It stopped at this distance from the start (rad).
    Stopped(f64),
}

/// A machine that turns in one direction, from a position.
pub(super) struct TurningMachine<'a> {
    pub(super) machines: CoupledMachines<'a>,
    pub(super) plant: Plant<'a, OwnMotor<'a>>,
    /// +1 or −1.
    pub(super) direction: f64,
    start: f64,
    /// Turns per cycle.
    pub(super) turns: u32,
    /// Angles from the start at which a load or the mechanism is not smooth; 0 and the end of the cycle.
    edges: Vec<f64>,
    /// Largest load and Coulomb torque at some positions, and viscous coefficient.
    load: [f64; 2],
    /// J at the start.
    inertia: f64,
}

impl<'a> TurningMachine<'a> {
    pub(super) fn new(
        machines: &CoupledMachines<'a>,
        simulation: &'a Simulation,
        motor: OwnMotor<'a>,
        direction: f64,
        turns: u32,
    ) -> Result<Self, Error> {
        let start = simulation.start_angle;
        let span = TAU * f64::from(turns);
        let edges = machines.all().flat_map(|machine| machine.edges(turns));
        let from_start = edges.map(|phi| ((phi - start) * direction).rem_euclid(span));
        let mut edges: Vec<f64> = from_start.chain([0.0, span]).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|b, a| *b - *a < 1e-9);
        // An edge just before the end of the cycle is replaced by the end.
        if let Some(last) = edges.last_mut() {
            *last = span;
        }
        let mut load = [0.0f64; 2];
        for machine in machines.all() {
            let mut own = [0.0f64; 2];
            for k in 0..24 * turns {
                let [phi, ..] = machine.state([start, 0.0, 0.0]);
                let phi = phi + TAU * f64::from(k) / 24.0;
                let point = machine.file.bare_reduction(phi)?;
                own[0] = own[0].max(point.load_torque().abs() + point.coulomb);
                own[1] = own[1].max(point.viscous);
            }
            let ratio = machine.ratio().abs();
            load[0] += ratio * own[0];
            load[1] += ratio * ratio * own[1];
        }
        let plant = Plant::new(machines.clone(), simulation, motor);
        let [inertia, _] = plant.inertia(start)?;
        Ok(Self {
            machines: machines.clone(),
            plant,
            direction,
            start,
            turns,
            edges,
            load,
            inertia,
        })
    }

    /// The position (rad) `x` after the start.
    pub(super) fn at(&self, x: f64) -> f64 {
        self.start + self.direction * x
    }

    /// The angle of a cycle (rad).
    pub(super) fn span(&self) -> f64 {
        TAU * f64::from(self.turns)
    }

    /// The edges, and `count` equal parts of each turn, each with a flag for the latter.
    pub(super) fn places(&self, count: usize) -> Vec<(f64, bool)> {
        let all = count * self.turns as usize;
        let parts = (0..=all).map(|k| (TAU * k as f64 / count as f64, true));
        let edges = self.edges.iter().map(|x| (*x, false));
        let mut all: Vec<(f64, bool)> = parts.chain(edges).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        all.dedup_by(|b, a| {
            let same = b.0 - a.0 < 1e-9;
            a.1 |= same && b.1;
            same
        });
        if let Some(last) = all.last_mut() {
            *last = (self.span(), true);
        }
        all
    }

    /// In motion; nothing depends on time.
    pub(super) fn moment(&self) -> Moment {
        Moment::new(0.0, self.direction)
    }

    /// Derivatives and forces at a position and speed.
    pub(super) fn instant(&self, x: f64, speed: f64) -> Result<Instant, Error> {
        let link = [self.at(x), self.direction * speed];
        self.plant.instant(&self.moment(), link.into())
    }

    /// Exchanged energy per radian at this speed (J): the scale for works.
    pub(super) fn effort(&self, speed: f64) -> f64 {
        let [torque, _] = self.plant.motor(self.direction * speed);
        let drive = (torque * self.plant.ratio()).abs();
        let load = self.load[0] + self.load[1] * speed;
        drive.max(load).max(1e-9 * self.inertia * speed * speed)
    }

    /// From one place to another, in a motion with the full speed `speed`, through all edges between them.
    pub(super) fn advance(
        &self,
        y: TurnState,
        [from, to]: [f64; 2],
        speed: f64,
    ) -> Result<TurnEnd, SteadyError> {
        self.advance_by(FINE, y, [from, to], speed, &mut |_, _| ())
    }

    pub(super) fn advance_by(
        &self,
        accuracy: Accuracy,
        y: TurnState,
        [from, to]: [f64; 2],
        speed: f64,
        seen: &mut dyn FnMut(f64, &TurnState),
    ) -> Result<TurnEnd, SteadyError> {
        let mut y = y;
        let mut x = from;
        let edges = self.edges.iter().copied();
        for next in edges.filter(|e| *e > from && *e < to).chain([to]) {
            match self.smooth(accuracy, y, [x, next], speed, seen)? {
                TurnEnd::End(end) => y = end,
                stopped @ TurnEnd::Stopped(_) => return Ok(stopped),
            }
            x = next;
        }
        Ok(TurnEnd::End(y))
    }

    /// From one place to another without a jump between them; `seen` receives the end of each step.
    fn smooth(
        &self,
        accuracy: Accuracy,
        y: TurnState,
        [from, to]: [f64; 2],
        speed: f64,
        seen: &mut dyn FnMut(f64, &TurnState),
    ) -> Result<TurnEnd, SteadyError> {
        let full = 0.5 * speed * speed;
        let energy = self.effort(speed);
        let torque = energy / self.plant.ratio().abs();
        // Every value is scaled by its own size, so that the tolerance means the same for each.
        let sizes = [
            full,
            1.0 / speed,
            energy,
            energy,
            energy,
            torque / speed,
            torque * torque / speed,
        ];
        let least = STANDSTILL_ENERGY * full;
        let slope = |x: f64, y: &TurnState| -> Result<TurnState, Error> {
            let speed = (2.0 * (y[0] * full).max(least)).sqrt();
            let now = self.instant(from + x, speed)?;
            let rates = [
                now.alpha * self.direction * speed,
                1.0,
                now.motor_power,
                now.process_power,
                now.loss,
                now.motor_torque,
                now.motor_torque * now.motor_torque,
            ];
            Ok(std::array::from_fn(|i| rates[i] / speed / sizes[i]))
        };
        let bends = |x: f64, y: &TurnState| -> Result<Vec<f64>, Error> {
            let speed = self.direction * (2.0 * (y[0] * full).max(least)).sqrt();
            let [torque, _] = self.plant.motor(speed);
            let link = [self.at(from + x), speed];
            self.plant.bends_under(&self.moment(), link.into(), torque)
        };
        let scaled = std::array::from_fn(|i| y[i] / sizes[i]);
        let steps = accuracy.steps(slope, bends, scaled, to - from, |_, y| {
            Ok(y[0] <= STANDSTILL_ENERGY)
        });
        let steps = steps.map_err(|why| match why {
            IntegrationError::Function(error) => SteadyError::Machine(error),
            IntegrationError::TooManySteps { .. } | IntegrationError::StepTooSmall { .. } => {
                SteadyError::Integrator
            }
        })?;
        let [.., before, (x, end)] = steps.as_slice() else {
            return Ok(TurnEnd::End(y));
        };
        if end[0] <= STANDSTILL_ENERGY {
            // Near rest z falls linearly.
            let share = (before.1[0] / (before.1[0] - end[0])).clamp(0.0, 1.0);
            return Ok(TurnEnd::Stopped(from + before.0 + share * (x - before.0)));
        }
        for (x, y) in steps.iter().skip(1) {
            seen(from + x, &std::array::from_fn(|i| y[i] * sizes[i]));
        }
        Ok(TurnEnd::End(std::array::from_fn(|i| end[i] * sizes[i])))
    }

    /// A whole cycle from the start with this speed.
    pub(super) fn turn(&self, speed: f64) -> Result<TurnEnd, SteadyError> {
        self.advance(starting(speed), [0.0, self.span()], speed)
    }

    /// The same with the ends of the integrator's steps, the start first.
    pub(super) fn course(
        &self,
        speed: f64,
    ) -> Result<(TurnEnd, Vec<(f64, TurnState)>), SteadyError> {
        let mut course = vec![(0.0, starting(speed))];
        let ends = [0.0, self.span()];
        let reached = self.advance_by(FINE, starting(speed), ends, speed, &mut |x, y| {
            course.push((x, *y));
        })?;
        Ok((reached, course))
    }

    /// The mean motor torque over a cycle that keeps a speed without stopping, positive where it drives, negative where the motor must brake (N·m).
    pub(super) fn keeping(&self, speed: f64) -> Result<f64, SteadyError> {
        let needed = |x: f64| {
            let state = [self.at(x), self.direction * speed];
            self.plant.keeping(&self.moment(), state.into())
        };
        let places = self.places(90);
        let size = self.largest(&places, speed, |x| Ok(needed(x)?))?;
        let mut work = 0.0;
        for pair in places.windows(2) {
            work += numerics::integral(needed, [pair[0].0, pair[1].0], 1, 1e-9 * size)?;
        }
        Ok(work / self.span() * self.sense())
    }

    /// Scale for an integral of a torque over these places: the exchanged energy, also between the links at this speed.
    pub(super) fn largest(
        &self,
        places: &[(f64, bool)],
        speed: f64,
        torque: impl Fn(f64) -> Result<f64, SteadyError>,
    ) -> Result<f64, SteadyError> {
        let mut most = self.effort(speed);
        for (x, _) in places {
            most = most.max(torque(*x)?.abs());
        }
        Ok(most)
    }

    /// The sign of a motor torque that drives.
    pub(super) fn sense(&self) -> f64 {
        (self.plant.ratio() * self.direction).signum()
    }

    /// Relative increase of the energy over a cycle from the start with this speed; −1 if the drive link stops.
    pub(super) fn rise(&self, speed: f64) -> Result<f64, SteadyError> {
        Ok(match self.turn(speed)? {
            TurnEnd::End([z, ..]) => z / (0.5 * speed * speed) - 1.0,
            TurnEnd::Stopped(_) => -1.0,
        })
    }

    /// Energy gained in a cycle from the start with this speed, as a share of the kinetic energy there, from the works; −1 if the drive link stops.
    /// Rounding counts as 0.
    pub(super) fn gain(&self, speed: f64) -> Result<f64, SteadyError> {
        Ok(self.gain_by(FINE, speed)?[0])
    }

    /// The same with a certain sign, to some digits.
    pub(super) fn about_gain(&self, speed: f64) -> Result<f64, SteadyError> {
        let [gain, works] = self.gain_by(ROUGH, speed)?;
        if gain.abs() > CLOSE * works {
            Ok(gain)
        } else {
            self.gain(speed)
        }
    }

    /// The gain, with the sum of the works' magnitudes as the same share.
    fn gain_by(&self, accuracy: Accuracy, speed: f64) -> Result<[f64; 2], SteadyError> {
        let ends = [0.0, self.span()];
        let reached = self.advance_by(accuracy, starting(speed), ends, speed, &mut |_, _| ())?;
        let TurnEnd::End([_, _, motor, process, losses, ..]) = reached else {
            return Ok([-1.0, 0.0]);
        };
        let [inertia, before] = self.plant.inertia(self.at(0.0))?;
        let [_, after] = self.plant.inertia(self.at(self.span()))?;
        let won = motor + process - losses - (after - before);
        // Rounding of the sums.
        let works = motor.abs() + process.abs() + losses.abs() + self.effort(speed);
        let won = if won.abs() <= 1e-14 * works { 0.0 } else { won };
        let energy = 0.5 * inertia * speed * speed;
        Ok([won, works].map(|work| work / energy))
    }
}

/// The state at the start of a turn.
pub(super) fn starting(speed: f64) -> TurnState {
    [0.5 * speed * speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
}
