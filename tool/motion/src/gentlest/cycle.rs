//! The gentlest moves of a machine file, each in its own time, compared with the motion laws.

use jred::machine::motion::Law;
use jred_analysis::duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;

use crate::gentlest::{Fault, LeastEffortMove, Optimum, Reason};
use crate::moves::{self, Chain, Move, NoMoves, Part};
use crate::path_dynamics::Actuator;
use crate::trace::Trace;

use self::comparison::Comparison;
use self::course::trace;
pub use self::figures::{Figures, Goal, WINDING, copper};

mod comparison;
mod course;
mod even;
mod figures;
mod law;
mod standing;

/// The laws of VDI 2143 between two rests, by their names in machine files.
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

/// A request.
#[derive(Clone, Debug)]
pub struct Request {
    /// The drive.
    pub actuator: Actuator,
    /// Copper loss per square of the torque (W/(N·m)²), if known.
    pub copper: Option<f64>,
    /// Quantity to minimise.
    pub goal: Goal,
    /// Share of a move's time over which its acceleration rises and falls; 0: it jumps at rest.
    pub ramp: f64,
    /// How finely the duty is sampled.
    pub sampling: duty::Sampling,
}

/// A motion of the comparison.
#[derive(Clone, Debug)]
pub struct ComparisonRow {
    /// Its name.
    pub name: &'static str,
    /// Its figures.
    pub figures: Figures,
    /// The motion itself.
    pub motion: Motion,
}

/// The result.
#[derive(Clone, Debug)]
pub struct GentlestResult {
    /// The motion of the file.
    pub own: Figures,
    /// Links that are at rest while the drive moves, with the time (s) of that in the motion of the file and in the gentlest one, where these differ.
    pub standing: Vec<(String, [f64; 2])>,
    /// The motion laws; for a rotation without rest the classical motions.
    pub laws: Vec<ComparisonRow>,
    /// The gentlest motion.
    pub best: Figures,
    /// Its moves, in order.
    pub moves: Vec<LeastEffortMove>,
    /// Lower bound of the goal's figure, for all motions with these moves in these times.
    pub bound: Option<f64>,
    /// The parts of the motion.
    pub chain: Chain,
    /// The motion.
    pub motion: Motion,
    /// The same as nodes over the time.
    pub trace: Trace,
}

impl GentlestResult {
    /// Quality of the optimum: the worst of all moves.
    pub fn optimum(&self) -> Optimum {
        let all = self.moves.iter().map(|gentle| gentle.optimum);
        all.fold(Optimum::Global, |all, own| match all {
            Optimum::Global => own,
            Optimum::Local(_) => all,
        })
    }

    /// The law with the smallest figure.
    pub fn best_law(&self, goal: Goal) -> Option<&ComparisonRow> {
        let by = |a: &&ComparisonRow, b: &&ComparisonRow| {
            a.figures.of(goal).total_cmp(&b.figures.of(goal))
        };
        self.laws.iter().min_by(by)
    }
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// The machine cannot be placed somewhere, or the duty of a motion cannot be computed.
    Duty(duty::DutyError),
    /// The motion neither consists of moves nor turns endlessly.
    NoMoves(NoMoves),
    /// Data for the copper loss are missing.
    NoCopper,
    /// A move of the motion cannot be made, by its number from 1.
    Move(usize, Move, Fault),
}

impl<E: Into<duty::DutyError>> From<E> for Obstacle {
    fn from(error: E) -> Self {
        Self::Duty(error.into())
    }
}

/// Share by which the motion's cost may exceed the one that the search computed.
const COST_TOLERANCE: f64 = 1e-3;

/// The gentlest motion of a file, compared with the laws.
///
/// # Errors
/// See [`Obstacle`].
pub fn gentlest_cycle(
    file: &MachineFile,
    motion: &Motion,
    request: &Request,
) -> Result<GentlestResult, Obstacle> {
    let chain = moves::chain(motion, &file.process()).map_err(Obstacle::NoMoves)?;
    let asked = Comparison::new(file, motion, request, &chain);
    let mut gentle = asked.gentlest(true)?;
    let laws = asked.beside()?;
    let mut best = asked.made_of(&gentle)?;
    let mut figures = asked.figures(&best)?;
    // The mean of a high power is not quite the peak: a law may have a lower peak.
    if request.goal == Goal::Peak
        && let Some(name) = asked.better_law(&laws, figures.peak)
    {
        let steps = chain.parts.iter().filter_map(Part::step);
        for (gentle, (step, _)) in gentle.iter_mut().zip(steps) {
            gentle.phases = asked.by_law(name, &step)?;
            gentle.law = Some(name);
            gentle.moving = step.duration;
        }
        best = asked.made_of(&gentle)?;
        figures = asked.figures(&best)?;
    }
    let duration = best.duration();
    let fixed = [asked.held()?, asked.kept_peak()?];
    let bound = bound(&gentle, fixed, duration, request.goal);
    // The cost of the search must agree with the cost of the motion.
    let cost = gentle.iter().map(|gentle| gentle.cost).sum::<f64>() + fixed[0];
    let counted = figure(cost, duration, request.goal);
    let differs = figures.of(request.goal) - counted > COST_TOLERANCE * counted;
    if request.goal != Goal::Peak && differs {
        for gentle in &mut gentle {
            if gentle.optimum == Optimum::Global {
                gentle.optimum = Optimum::Local(Reason::Written);
            }
        }
    }
    let least = figures.of(request.goal);
    Ok(GentlestResult {
        own: asked.figures(motion)?,
        standing: standing::changed(file, motion, &best)?,
        laws,
        best: figures,
        bound: bound.map(|bound| bound.min(least)),
        trace: trace(file, &chain.parts, &gentle),
        chain,
        moves: gentle,
        motion: best,
    })
}

/// The gentlest motion alone: without a lower bound and without the laws.
///
/// # Errors
/// See [`Obstacle`].
pub(crate) fn alone(
    file: &MachineFile,
    motion: &Motion,
    request: &Request,
) -> Result<Motion, Obstacle> {
    let chain = moves::chain(motion, &file.process()).map_err(Obstacle::NoMoves)?;
    let asked = Comparison::new(file, motion, request, &chain);
    let moves = asked.gentlest(false)?;
    Ok(asked.made_of(&moves)?)
}

/// The bound of all moves together, with the cost of pauses and kept parts, and their peak. It does not use the cost of the final motion, which may
/// exceed that of the search.
fn bound(
    moves: &[LeastEffortMove],
    [cost, peak]: [f64; 2],
    duration: f64,
    goal: Goal,
) -> Option<f64> {
    if goal == Goal::Peak {
        let least = moves.iter().map(|gentle| gentle.least_peak);
        return least
            .collect::<Option<Vec<f64>>>()
            .map(|all| all.into_iter().fold(peak, f64::max));
    }
    let least: f64 = moves.iter().map(|gentle| gentle.bound).sum::<Option<_>>()?;
    Some(figure(least + cost, duration, goal))
}

/// The figure of a cost over all moves and pauses.
fn figure(cost: f64, duration: f64, goal: Goal) -> f64 {
    match goal {
        Goal::Rms => (cost / duration).max(0.0).sqrt(),
        _ => cost,
    }
}
