//! The motion in time, stopped and started again where friction changes its direction.

use jred::{Domain, Error, Reducible as _};

use super::SimulationError;
use super::error::stopped;
use super::watch::{At, Watch};
use crate::model::machine::{MachineFile, Simulation};
use crate::number::columns::{Column, Columns, Quantity};
use crate::number::numerics::dormand_prince::{Accuracy, Point};

/// The most steps within one output step.
const MOST_STEPS: u32 = 1_000_000;

/// A hair of speed (rad/s): it puts the losses of each stage on the side of the motion to come.
const HAIR: f64 = 1e-12;

/// A machine in free motion as a system of differential equations of its state y. The last three values of y are the work
/// of the motor, the work of the process loads, and the losses (J).
///
/// `direction` is the one of the drive link, which friction opposes: +1, −1, or 0 where friction holds it.
pub(in crate::analysis) trait Plant<const N: usize> {
    /// The state at the start.
    fn start(&self) -> Result<[f64; N], Error>;

    /// y′ at the time `t`.
    fn slope(&self, direction: f64, t: f64, y: &[f64; N]) -> Result<[f64; N], Error>;

    /// φ and ω of the drive link.
    fn link(&self, t: f64, y: &[f64; N]) -> Result<[f64; 2], Error>;

    /// The state with another φ and ω of the drive link.
    fn with_link(&self, t: f64, y: &[f64; N], link: [f64; 2]) -> Result<[f64; N], Error>;

    /// α of the drive link in motion.
    fn alpha(&self, direction: f64, t: f64, y: &[f64; N]) -> Result<f64, Error>;

    /// Refuses a state that the equations do not describe.
    fn check(&self, direction: f64, t: f64, y: &[f64; N]) -> Result<(), SimulationError>;

    /// Times at which y′ has a corner (s): no step passes over one.
    fn corners(&self) -> impl Iterator<Item = f64>;

    /// The columns of the figures of a [`Row`].
    fn heads(&self) -> Vec<Column>;

    /// What is written about a state.
    fn row(&self, direction: f64, t: f64, y: &[f64; N]) -> Result<Row, Error>;
}

/// What is written about a state, without the time and the columns of energies.
pub(in crate::analysis) struct Row {
    pub(in crate::analysis) figures: Vec<f64>,
    /// (J)
    pub(in crate::analysis) kinetic: f64,
    /// (J)
    pub(in crate::analysis) potential: f64,
}

/// The columns of a motion: the time, the `figures` of a [`Row`], energies and their balance.
pub(in crate::analysis) fn heads(figures: Vec<Column>) -> impl Iterator<Item = Column> {
    let energies = [
        "kinetic energy",
        "potential energy",
        "motor work",
        "process work",
        "losses",
    ]
    .map(|name| Column::new(Quantity::Energy, name, "J"));
    let balance = Column::new(Quantity::EnergyBalance, "energy balance", "J");
    let time = std::iter::once(Column::new(Quantity::Time, "t", "s"));
    time.chain(figures).chain(energies).chain([balance])
}

/// A row of these columns at the time `t`, with the work of the motor, of the process loads, and the losses since a start with
/// the energy `start`; and the balance.
pub(in crate::analysis) fn cells(
    t: f64,
    row: Row,
    [motor, process, losses]: [f64; 3],
    start: f64,
) -> (impl Iterator<Item = f64>, f64) {
    let balance = row.kinetic + row.potential - start - motor - process + losses;
    let energies = [row.kinetic, row.potential, motor, process, losses, balance];
    let cells = std::iter::once(t).chain(row.figures).chain(energies);
    (cells, balance)
}

/// Runs a simulation.
pub(super) fn run<const N: usize>(
    plant: &impl Plant<N>,
    file: &MachineFile,
    simulation: &Simulation,
) -> Result<Columns, SimulationError> {
    let mut run = Run {
        plant,
        file,
        accuracy: Accuracy {
            tolerance: simulation.tolerance,
            most_steps: MOST_STEPS,
        },
        watch: Watch::new(file),
        direction: 0.0,
    };
    let mut y = plant.start()?;
    run.direction = run.heading(&y)?;
    run.watch.check(run.at(0.0, &y)?)?;
    let mut columns = Columns::new(heads(plant.heads()));
    let steps = (simulation.duration / simulation.output_step)
        .round()
        .max(1.0) as usize;
    let mut start_energy = None;
    let mut t = 0.0;
    for k in 0..=steps {
        let end = simulation.duration * k as f64 / steps as f64;
        let corners = plant.corners().filter(|at| *at > t && *at < end);
        for next in corners.chain([end]).collect::<Vec<f64>>() {
            y = run.advance(t, next, y)?;
            t = next;
        }
        let row = plant.row(run.direction, t, &y)?;
        let energy = row.kinetic + row.potential;
        let start = *start_energy.get_or_insert(energy);
        let works = std::array::from_fn(|i| y[N - 3 + i]);
        columns.push(cells(t, row, works, start).0);
    }
    Ok(columns)
}

struct Run<'a, P> {
    plant: &'a P,
    file: &'a MachineFile,
    accuracy: Accuracy,
    /// The joints that can let go.
    watch: Watch<'a>,
    direction: f64,
}

impl<P> Run<'_, P> {
    /// Integrates from `t` to `end`; where friction changes, it turns round, holds or lets go.
    fn advance<const N: usize>(
        &mut self,
        mut t: f64,
        end: f64,
        mut y: [f64; N],
    ) -> Result<[f64; N], SimulationError>
    where
        P: Plant<N>,
    {
        // Enough for a machine that reverses many times within one output step.
        for _ in 0..10_000 {
            if t >= end {
                return Ok(y);
            }
            let steps = self.integrate(t, end, &y)?;
            let over = match steps.split_last() {
                Some(((last, state), [_, ..])) => self.is_over(*last, state)?,
                _ => false,
            };
            let before = steps.len() - usize::from(over);
            for pair in steps[..before].windows(2) {
                let [from, to] = pair else { continue };
                self.check(from, to)?;
            }
            let Some(&last) = steps.last().filter(|_| over) else {
                return Ok(steps.last().map_or(y, |last| last.1));
            };
            // Friction changes within the last step: halve it down to that instant.
            let start = steps.get(before - 1).copied().unwrap_or((t, y));
            let (mut before, mut after) = (start, last);
            while after.0 - before.0 > 1e-12 * (1.0 + end.abs()) {
                let middle = before.0.midpoint(after.0);
                let steps = self.integrate(start.0, middle, &start.1)?;
                let Some(&(at, state)) = steps.last() else {
                    break;
                };
                if self.is_over(at, &state)? {
                    after = (at, state);
                } else {
                    before = (at, state);
                }
            }
            self.check(&start, &before)?;
            t = after.0.min(end);
            // What was held starts where it is let go; what turns round does so from rest.
            y = if self.direction == 0.0 {
                after.1
            } else {
                before.1
            };
            let [phi, _] = self.plant.link(t, &y)?;
            y = self.plant.with_link(t, &y, [phi, 0.0])?;
            self.direction = self.start_direction(t, &y)?;
        }
        Err(SimulationError::Integrator {
            t,
            reason: "the drive link turns round again and again",
        })
    }

    /// The integrator's steps from `t` to `end`, up to the one in which friction changes.
    fn integrate<const N: usize>(
        &self,
        t: f64,
        end: f64,
        y: &[f64; N],
    ) -> Result<Vec<Point<N>>, SimulationError>
    where
        P: Plant<N>,
    {
        if end <= t {
            return Ok(vec![(t, *y)]);
        }
        // Counted from here, short intervals keep all their digits.
        let steps = self.accuracy.steps(
            |x, y| self.plant.slope(self.direction, t + x, y),
            *y,
            end - t,
            |x, y| self.is_over(t + x, y),
        );
        let mut steps = steps.map_err(|error| stopped(t, error))?;
        for (x, y) in &mut steps {
            *x += t;
            self.within_stroke(*x, y)?;
        }
        Ok(steps)
    }

    /// The direction of motion at the start; at rest, the way it will start.
    fn heading<const N: usize>(&self, y: &[f64; N]) -> Result<f64, Error>
    where
        P: Plant<N>,
    {
        let [_, omega] = self.plant.link(0.0, y)?;
        if omega == 0.0 {
            self.start_direction(0.0, y)
        } else {
            Ok(omega.signum())
        }
    }

    /// The way the drive link starts to move from rest: +1, −1, or 0 if friction holds it.
    fn start_direction<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<f64, Error>
    where
        P: Plant<N>,
    {
        let [phi, _] = self.plant.link(t, y)?;
        for direction in [1.0, -1.0] {
            let moved = self.plant.with_link(t, y, [phi, direction * HAIR])?;
            if self.plant.alpha(direction, t, &moved)? * direction > 0.0 {
                return Ok(direction);
            }
        }
        Ok(0.0)
    }

    /// Whether the drive link has turned round, or friction does not hold it any more.
    fn is_over<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<bool, Error>
    where
        P: Plant<N>,
    {
        if self.direction == 0.0 {
            return Ok(self.start_direction(t, y)? != 0.0);
        }
        Ok(self.plant.link(t, y)?[1] * self.direction < 0.0)
    }

    fn at<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<At, Error>
    where
        P: Plant<N>,
    {
        let [phi, omega] = self.plant.link(t, y)?;
        let alpha = if self.direction == 0.0 {
            0.0
        } else {
            self.plant.alpha(self.direction, t, y)?
        };
        let state = [phi, omega, alpha];
        Ok(At { t, state })
    }

    /// Refuses the way from one step to the next where a joint lets go or the equations do not hold.
    fn check<const N: usize>(&self, from: &Point<N>, to: &Point<N>) -> Result<(), SimulationError>
    where
        P: Plant<N>,
    {
        for (t, y) in [from, to] {
            self.plant.check(self.direction, *t, y)?;
        }
        if self.watch.is_idle() || self.direction == 0.0 {
            return Ok(());
        }
        let ends = [self.at(from.0, &from.1)?, self.at(to.0, &to.1)?];
        self.watch.check_between(ends, |t, link| {
            let share = (t - from.0) / (to.0 - from.0);
            let y = std::array::from_fn(|i| from.1[i] + share * (to.1[i] - from.1[i]));
            let y = self.plant.with_link(t, &y, link)?;
            Ok(self.plant.alpha(self.direction, t, &y)?)
        })
    }

    /// Refuses to go on where the drive link has passed the end of its stroke: what stops it there is not in the file.
    fn within_stroke<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<(), SimulationError>
    where
        P: Plant<N>,
    {
        let Domain::Stroke { from, to } = self.file.machine.domain() else {
            return Ok(());
        };
        let [phi, omega] = self.plant.link(t, y)?;
        let slack = 1e-9 * (to - from);
        if (from - slack..=to + slack).contains(&phi) {
            return Ok(());
        }
        let coordinate = self.file.machine.mechanism().coordinate();
        Err(SimulationError::EndOfStroke {
            t,
            end: coordinate.place(if phi < from { from } else { to }),
            speed: format!(
                "{} {}",
                (omega * 1e6).round() / 1e6,
                coordinate.speed_unit()
            ),
        })
    }
}
