//! The moves of a machine file, each in the time that it has, in the gentlest way; beside it the motion laws.

use jred::Error;
use jred::machine::motion::Law;
use jred_machine::analysis::duty::Duty;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::motion::{Motion, Segment};
use jred_sizing::cycle::Cycle;

use crate::gentlest::{self, Fault, Gentle, Objective, Optimum, Reason, Travel};
use crate::moves::{self, Move, NoMoves, Part};
use crate::trace::Trace;
use crate::way::{Actuator, Way};

use self::course::trace;
use self::even::constant_energy;
pub use self::figures::{Figures, Goal, WINDING, copper};

mod course;
mod even;
mod figures;
mod law;
mod standing;

/// The laws of VDI 2143 between two rests, by the names of machine files.
pub const LAWS: [(&str, Law); 9] = [
    (
        "parabola",
        Law::Trapezoid {
            accelerate: 0.5,
            decelerate: 0.5,
        },
    ),
    (
        "trapezoid",
        Law::Trapezoid {
            accelerate: 1.0 / 3.0,
            decelerate: 1.0 / 3.0,
        },
    ),
    ("simple-sine", Law::SimpleSine),
    ("cycloidal", Law::Cycloidal),
    ("modified-sine", Law::ModifiedSine),
    ("modified-trapezoid", Law::ModifiedTrapezoid),
    ("gutman", Law::Gutman),
    ("polynomial-345", Law::Polynomial345),
    ("polynomial-4567", Law::Polynomial4567),
];

/// What is asked.
#[derive(Clone, Debug)]
pub struct Request {
    /// What moves the machine.
    pub actuator: Actuator,
    /// Copper loss per square of the torque (W/(N·m)²), where it is known.
    pub copper: Option<f64>,
    /// What is to be least.
    pub goal: Goal,
    /// Share of a move's time over which its acceleration rises and falls; 0: it jumps at rest.
    pub ramp: f64,
    /// Time steps of the duty.
    pub steps: usize,
}

/// A motion of the comparison.
#[derive(Clone, Debug)]
pub struct Row {
    /// What it is called.
    pub name: &'static str,
    /// What it asks.
    pub figures: Figures,
    /// The motion itself.
    pub motion: Motion,
}

/// The result.
#[derive(Clone, Debug)]
pub struct Retimed {
    /// The motion of the file.
    pub own: Figures,
    /// Links that stand still while the drive moves, with the time (s) for which they do in the motion of the file and in the gentlest one, where
    /// these differ.
    pub standing: Vec<(String, [f64; 2])>,
    /// The laws, or of a rotation without rest the classical motions.
    pub laws: Vec<Row>,
    /// The gentlest motion.
    pub best: Figures,
    /// Its moves, one after another.
    pub moves: Vec<Gentle>,
    /// Lower bound of the figure that is to be least, for all motions with these moves in these times.
    pub bound: Option<f64>,
    /// Whether it turns without rest.
    pub endless: bool,
    /// The motion.
    pub motion: Motion,
    /// The same as nodes over the time.
    pub trace: Trace,
}

impl Retimed {
    /// What is known of the optimum: of all moves the least.
    pub fn optimum(&self) -> Optimum {
        let all = self.moves.iter().map(|gentle| gentle.optimum);
        all.fold(Optimum::Global, |all, own| match all {
            Optimum::Global => own,
            Optimum::Local(_) => all,
        })
    }

    /// The law with the smallest figure.
    pub fn best_law(&self, goal: Goal) -> Option<&Row> {
        let by = |a: &&Row, b: &&Row| a.figures.of(goal).total_cmp(&b.figures.of(goal));
        self.laws.iter().min_by(by)
    }
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// The machine cannot be placed somewhere.
    Machine(Error),
    /// The motion is not made of moves, nor does it turn for ever.
    NoMoves(NoMoves),
    /// The figures of the copper loss are not known.
    NoCopper,
    /// A move of the motion, by its number from 1 on.
    Move(usize, Move, Fault),
}

impl From<Error> for Obstacle {
    fn from(error: Error) -> Self {
        Self::Machine(error)
    }
}

/// Share by which the motion may take more than the search counted.
const AGREES: f64 = 1e-3;

/// The motion of a file in the gentlest way, beside the laws.
///
/// # Errors
/// See [`Obstacle`].
pub fn retime(file: &MachineFile, motion: &Motion, request: &Request) -> Result<Retimed, Obstacle> {
    let objective = match (request.goal, request.copper) {
        (Goal::Rms, _) => Objective::Rms,
        (Goal::Peak, _) => Objective::Peak,
        (Goal::Energy, Some(copper)) => Objective::Energy { copper },
        (Goal::Energy, None) => return Err(Obstacle::NoCopper),
    };
    let parts = match moves::parts(motion) {
        Ok(parts) => parts,
        Err(why) => vec![Part::Move(
            moves::ring(motion).ok_or(Obstacle::NoMoves(why))?,
        )],
    };
    let endless = moves::parts(motion).is_err();
    let asked = Asked {
        file,
        request,
        cyclic: motion.cyclic,
        start: motion.at(0.0).phi,
    };
    let mut gentle = Vec::new();
    for part in &parts {
        let Part::Move(step) = part else { continue };
        let travel = Travel {
            start: step.from,
            distance: step.to - step.from,
            duration: step.duration,
            speeds: [0.0; 2],
            ramp: request.ramp,
            ring: endless,
        };
        let way = asked.way(step);
        let found = gentlest::gentlest(&way, &travel, objective);
        let number = gentle.len() + 1;
        gentle.push(found.map_err(|fault| Obstacle::Move(number, *step, fault))?);
    }
    let found = |gentle: &[Gentle]| {
        let mut found = gentle.iter();
        asked.motion(&parts, |step| {
            let phases = found.next().map(|gentle| gentle.phases.clone());
            Segment::phases(step.to - step.from, phases.unwrap_or_default())
        })
    };
    let laws = asked.beside(&parts, endless)?;
    let mut best = found(&gentle)?;
    let mut figures = asked.figures(&best)?;
    // The mean of a high power is not quite the peak: a law may have a lower one.
    if request.goal == Goal::Peak
        && let Some((name, law)) = asked.better_law(&laws, figures.peak)
    {
        for gentle in &mut gentle {
            let Travel {
                distance, duration, ..
            } = gentle.travel;
            gentle.phases = law::phases(law, distance, duration);
            gentle.law = Some(name);
            gentle.moving = duration;
        }
        best = found(&gentle)?;
        figures = asked.figures(&best)?;
    }
    let duration = best.duration();
    let pauses = asked.held(&parts)?;
    let bound = bound(&gentle, pauses, duration, request.goal);
    // What the search counts must be what the motion takes.
    let cost = gentle.iter().map(|gentle| gentle.cost).sum::<f64>() + pauses;
    let counted = figure(cost, duration, request.goal);
    let differs = figures.of(request.goal) - counted > AGREES * counted;
    if request.goal != Goal::Peak && differs {
        for gentle in &mut gentle {
            if gentle.optimum == Optimum::Global {
                gentle.optimum = Optimum::Local(Reason::Written);
            }
        }
    }
    let least = figures.of(request.goal);
    Ok(Retimed {
        own: asked.figures(motion)?,
        standing: standing::changed(file, motion, &best)?,
        laws,
        best: figures,
        bound: bound.map(|bound| bound.min(least)),
        endless,
        trace: trace(file, &parts, &gentle),
        moves: gentle,
        motion: best,
    })
}

/// The bound of all moves together, with what the pauses cost. Not that of the motion less what the search left: the written motion may take more than the
/// one that was found.
fn bound(moves: &[Gentle], pauses: f64, duration: f64, goal: Goal) -> Option<f64> {
    if goal == Goal::Peak {
        let least = moves.iter().map(|gentle| gentle.least_peak);
        return least
            .collect::<Option<Vec<f64>>>()
            .map(|all| all.into_iter().fold(0.0, f64::max));
    }
    let least: f64 = moves.iter().map(|gentle| gentle.bound).sum::<Option<_>>()?;
    Some(figure(least + pauses, duration, goal))
}

/// The figure of a cost over all moves and pauses.
fn figure(cost: f64, duration: f64, goal: Goal) -> f64 {
    match goal {
        Goal::Rms => (cost / duration).max(0.0).sqrt(),
        _ => cost,
    }
}

/// The machine with what is asked.
struct Asked<'a> {
    file: &'a MachineFile,
    request: &'a Request,
    cyclic: bool,
    start: f64,
}

impl Asked<'_> {
    /// What the pauses cost: holding, in the unit of the moves' costs.
    fn held(&self, parts: &[Part]) -> Result<f64, Error> {
        let way = Way::new(self.file, self.request.actuator.clone(), 1.0);
        let per_square = match self.request.goal {
            Goal::Energy => self.request.copper.unwrap_or(0.0),
            _ => 1.0,
        };
        let mut cost = 0.0;
        for part in parts {
            if let Part::Dwell { at, duration } = part {
                let torque = way.holding(&way.place_at_rest(*at)?);
                cost += per_square * torque * torque * duration;
            }
        }
        Ok(cost)
    }

    fn way(&self, step: &Move) -> Way<'_> {
        let direction = (step.to - step.from).signum();
        Way::new(self.file, self.request.actuator.clone(), direction)
    }

    /// The same parts with other moves.
    fn motion(
        &self,
        parts: &[Part],
        mut with: impl FnMut(&Move) -> Segment,
    ) -> Result<Motion, Error> {
        let segments: Vec<Segment> = parts
            .iter()
            .map(|part| match part {
                Part::Move(step) => with(step),
                Part::Dwell { duration, .. } => Segment::dwell(*duration),
            })
            .collect();
        let motion = Motion::segments(self.start, &segments, self.cyclic);
        motion.map_err(|(_, error)| error.into())
    }

    fn figures(&self, motion: &Motion) -> Result<Figures, Error> {
        let duty = Duty::new(self.file, motion, self.request.steps)?;
        let cycle = Cycle::new(&duty);
        let Actuator {
            coefficients,
            ratio,
            envelope,
        } = &self.request.actuator;
        let rms = cycle.rms_torque(coefficients);
        let [drawn, _] = cycle.energies(coefficients, *ratio);
        let copper = (self.request.copper).map(|copper| copper * rms * rms * cycle.duration());
        let speed = cycle.peak_speed() * ratio;
        let continuous = envelope.continuous_torque(cycle.mean_speed() * ratio);
        Ok(Figures {
            rms_used: rms / continuous,
            speed_used: speed / envelope.max_speed(),
            rms,
            peak: cycle.peak_torque(coefficients),
            drawn,
            copper,
            speed,
            used: cycle.peak(coefficients, *ratio, envelope).used,
        })
    }

    /// The law of the list with the lowest peak, if that is below this one and the law has the form of the ends that is asked for.
    fn better_law(&self, laws: &[Row], peak: f64) -> Option<(&'static str, Law)> {
        let rows = laws.iter().filter(|row| row.figures.peak < peak);
        let named = rows.filter_map(|row| {
            let (name, law) = LAWS.into_iter().find(|(name, _)| *name == row.name)?;
            let starts_level = law.at(0.0)[2] == 0.0;
            (self.request.ramp == 0.0 || starts_level).then_some((row.figures.peak, name, law))
        });
        let best = named.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((best.1, best.2))
    }

    /// The laws; of a rotation without rest the classical motions.
    fn beside(&self, parts: &[Part], endless: bool) -> Result<Vec<Row>, Error> {
        if endless {
            self.classical(parts)
        } else {
            let rows = LAWS.into_iter().map(|(name, law)| {
                let motion = self.motion(parts, |step| {
                    Segment::law(step.to - step.from, step.duration, law)
                })?;
                let figures = self.figures(&motion)?;
                Ok(Row {
                    name,
                    figures,
                    motion,
                })
            });
            rows.collect()
        }
    }

    /// Constant speed, and constant kinetic energy: ω ∝ 1/√J.
    fn classical(&self, parts: &[Part]) -> Result<Vec<Row>, Error> {
        let steady = self.motion(parts, |step| {
            let distance = step.to - step.from;
            Segment::constant_speed(distance, step.duration, distance / step.duration)
        })?;
        let mut even = Vec::new();
        for part in parts {
            if let Part::Move(step) = part {
                even = constant_energy(&self.way(step), step)?;
            }
        }
        let even = self.motion(parts, |step| {
            Segment::phases(step.to - step.from, even.clone())
        })?;
        Ok(vec![
            Row {
                name: "constant speed",
                figures: self.figures(&steady)?,
                motion: steady,
            },
            Row {
                name: "constant kinetic energy",
                figures: self.figures(&even)?,
                motion: even,
            },
        ])
    }
}
