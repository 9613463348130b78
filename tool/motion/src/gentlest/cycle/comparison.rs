//! The machine with the request for its motion: the same parts with other moves, and their cost.

use jred::error::Error;
use jred::machine::motion::{End, Law, Polynomial};
use jred_analysis::duty::{self, Duty};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Motion, MotionSegment, Phase};
use jred_file::number::quadrature::GAUSS_3;
use jred_sizing::cycle::Cycle;

use super::even::constant_energy;
use super::{ComparisonRow, Figures, Goal, LAWS, Obstacle, Request, law};
use crate::gentlest::{self, LeastEffortMove, Objective, Travel};
use crate::moves::{Chain, EndStates, KeptMotion, Move, Part};
use crate::path_dynamics::{BothDirections, PathDynamics};

/// The rotation at constant kinetic energy.
const EVEN_ENERGY: &str = "constant kinetic energy";

/// The machine with the request.
pub(super) struct Comparison<'a> {
    file: &'a MachineFile,
    request: &'a Request,
    cyclic: bool,
    endless: bool,
    parts: &'a [Part],
}

impl<'a> Comparison<'a> {
    /// The request for a motion with these parts.
    pub(super) fn new(
        file: &'a MachineFile,
        motion: &Motion,
        request: &'a Request,
        chain: &'a Chain,
    ) -> Self {
        Self {
            file,
            request,
            cyclic: motion.cyclic,
            endless: chain.endless,
            parts: &chain.parts,
        }
    }

    /// The gentlest motion of each move; `prove`: with lower bounds.
    pub(super) fn gentlest(&self, prove: bool) -> Result<Vec<LeastEffortMove>, Obstacle> {
        let Request {
            goal, copper, ramp, ..
        } = *self.request;
        let objective = match (goal, copper) {
            (Goal::Rms, _) => Objective::Rms,
            (Goal::Peak, _) => Objective::Peak,
            (Goal::Energy, Some(copper)) => Objective::Energy { copper },
            (Goal::Energy, None) => return Err(Obstacle::NoCopper),
        };
        let mut moves = Vec::new();
        for (step, ends) in self.parts.iter().filter_map(Part::step) {
            let travel = Travel {
                start: step.from,
                distance: step.to - step.from,
                duration: step.duration,
                speeds: ends.speeds,
                accelerations: ends.accelerations,
                ramp,
                ring: self.endless,
            };
            let found = gentlest::of(&self.dynamics(&step), &travel, objective, prove);
            let number = moves.len() + 1;
            moves.push(found.map_err(|fault| Obstacle::Move(number, step, fault))?);
        }
        Ok(moves)
    }

    /// The parts with these moves.
    pub(super) fn made_of(&self, moves: &[LeastEffortMove]) -> Result<Motion, Error> {
        let mut moves = moves.iter();
        self.motion(|step, _| {
            let phases = moves.next().map(|gentle| gentle.phases.clone());
            MotionSegment::phases(step.to - step.from, phases.unwrap_or_default())
        })
    }

    /// Cost of the pauses and the kept parts, in the unit of the moves' costs; zero for the peak.
    pub(super) fn held(&self) -> Result<f64, Error> {
        let dynamics = PathDynamics::new(self.file, self.request.actuator.clone(), 1.0);
        let mut cost = 0.0;
        for part in self.parts {
            cost += match part {
                Part::Dwell { at, duration } => {
                    let torque = dynamics.holding(&dynamics.place_at_rest(*at)?);
                    self.heat() * torque * torque * duration
                }
                Part::Kept(kept) => self.of_kept(kept)?[0],
                Part::Move(_) | Part::Passing(..) => 0.0,
            };
        }
        Ok(cost)
    }

    /// Cost per square of the torque and second.
    fn heat(&self) -> f64 {
        match self.request.goal {
            Goal::Energy => self.request.copper.unwrap_or(0.0),
            _ => 1.0,
        }
    }

    /// Cost of a kept part, and its peak torque.
    fn of_kept(&self, kept: &KeptMotion) -> Result<[f64; 2], Error> {
        let ways = BothDirections::new(self.file, &self.request.actuator);
        let [mut cost, mut peak] = [0.0_f64; 2];
        for pair in kept.nodes().windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            for [share, weight] in GAUSS_3 {
                let state = b.after(a, share);
                let torque = ways.torque(&state, b.phi - a.phi)?;
                let mut power = self.heat() * torque * torque;
                if self.request.goal == Goal::Energy {
                    power += (torque * ways.forwards().motor_speed(state.omega)).max(0.0);
                }
                cost += weight * b.step * power;
                peak = peak.max(torque.abs());
            }
        }
        Ok([cost, peak])
    }

    /// The largest torque of the kept parts.
    pub(super) fn kept_peak(&self) -> Result<f64, Error> {
        let mut peak = 0.0_f64;
        for part in self.parts {
            if let Part::Kept(kept) = part {
                peak = peak.max(self.of_kept(kept)?[1]);
            }
        }
        Ok(peak)
    }

    pub(super) fn dynamics(&self, step: &Move) -> PathDynamics<'_> {
        let direction = (step.to - step.from).signum();
        PathDynamics::new(self.file, self.request.actuator.clone(), direction)
    }

    /// The same parts with other moves.
    pub(super) fn motion(
        &self,
        mut with: impl FnMut(&Move, &EndStates) -> MotionSegment,
    ) -> Result<Motion, Error> {
        let segment = |part: &Part| match part {
            Part::Move(step) => with(step, &EndStates::default()),
            Part::Passing(step, ends) => with(step, ends),
            Part::Kept(kept) => MotionSegment::phases(kept.to - kept.from, kept.phases()),
            Part::Dwell { duration, .. } => MotionSegment::dwell(*duration),
        };
        let segments: Vec<MotionSegment> = self.parts.iter().map(segment).collect();
        let start = self.parts.first().map_or(0.0, Part::from);
        let motion = Motion::segments(start, &segments, self.cyclic);
        motion.map_err(|(_, error)| error.into())
    }

    pub(super) fn figures(&self, motion: &Motion) -> Result<Figures, duty::DutyError> {
        let cycle = Cycle::new(&Duty::new(self.file, motion, self.request.sampling)?);
        Ok(self.request.figures(&cycle))
    }

    /// The motion of the list with the lowest peak, if that is below the given peak and it has the requested form at its ends.
    pub(super) fn better_law(&self, laws: &[ComparisonRow], peak: f64) -> Option<&'static str> {
        // No law begins or ends with a speed.
        if self.passes() {
            return None;
        }
        let starts_level = |name: &str| {
            let law = LAWS.iter().find(|(own, _)| *own == name);
            law.is_none_or(|(_, law)| law.at(0.0)[2] == 0.0)
        };
        let rows = laws.iter().filter(|row| row.figures.peak < peak);
        let rows = rows.filter(|row| self.request.ramp == 0.0 || starts_level(row.name));
        let best = rows.min_by(|a, b| a.figures.peak.total_cmp(&b.figures.peak))?;
        Some(best.name)
    }

    /// A move by the law or motion of the list with this name.
    pub(super) fn by_law(&self, name: &str, step: &Move) -> Result<Vec<Phase>, Error> {
        let distance = step.to - step.from;
        if let Some((_, law)) = LAWS.iter().find(|(own, _)| *own == name) {
            return Ok(law::phases(*law, distance, step.duration));
        }
        if name == EVEN_ENERGY {
            return constant_energy(&self.dynamics(step), step);
        }
        Ok(vec![Phase {
            duration: step.duration,
            polynomial: Polynomial::constant_jerk([distance / step.duration, 0.0, 0.0]),
        }])
    }

    /// Whether a move begins or ends with a speed.
    fn passes(&self) -> bool {
        let mut parts = self.parts.iter();
        parts.any(|part| matches!(part, Part::Passing(..)))
    }

    /// The laws; for a rotation without rest the classical motions. Between nonzero speeds no law exists; there it is the polynomial of fifth degree.
    pub(super) fn beside(&self) -> Result<Vec<ComparisonRow>, duty::DutyError> {
        if self.endless {
            return self.classical();
        }
        let row = |name: &'static str, law: Law| {
            let motion = self.motion(|step, ends| {
                if *ends == EndStates::default() {
                    MotionSegment::law(step.to - step.from, step.duration, law)
                } else {
                    between(step, ends)
                }
            })?;
            let figures = self.figures(&motion)?;
            Ok(ComparisonRow {
                name,
                figures,
                motion,
            })
        };
        if self.parts.iter().any(|part| matches!(part, Part::Move(_))) {
            return LAWS.into_iter().map(|(name, law)| row(name, law)).collect();
        }
        Ok(vec![row("polynomial-5", Law::default())?])
    }

    /// Constant speed, and constant kinetic energy: ω ∝ 1/√J.
    fn classical(&self) -> Result<Vec<ComparisonRow>, duty::DutyError> {
        let mut rows = Vec::new();
        for name in ["constant speed", EVEN_ENERGY] {
            let mut phases = Vec::new();
            for (step, _) in self.parts.iter().filter_map(Part::step) {
                phases = self.by_law(name, &step)?;
            }
            let motion =
                self.motion(|step, _| MotionSegment::phases(step.to - step.from, phases.clone()))?;
            rows.push(ComparisonRow {
                name,
                figures: self.figures(&motion)?,
                motion,
            });
        }
        Ok(rows)
    }
}

/// The polynomial of fifth degree from one speed to another, with the accelerations of the kept parts.
fn between(step: &Move, ends: &EndStates) -> MotionSegment {
    let distance = step.to - step.from;
    let direction = distance.signum();
    let end = |k: usize| {
        End::new(
            direction * ends.speeds[k],
            direction * ends.accelerations[k],
        )
    };
    let course = Polynomial::between(distance, step.duration, end(0), end(1));
    MotionSegment::polynomial(distance, step.duration, course)
}
