//! The motion in time, stopped and restarted where friction changes direction.

mod edges;
mod integrate;
mod look;
mod plant;
mod rows;
mod setup;
mod start;
mod stops;
mod stretch;
mod turns;

use edges::Edges;
pub(crate) use plant::Plant;
pub(crate) use rows::{OutputRow, Terms, Works, cells, heads};

use std::cell::Cell;

use jred::error::Error;

use super::clock::{Corners, EDGE};
use super::drive_state::{DriveState, Passage};
use super::observe::{ControlStatistics, EffortSums, Observer};
use super::result::{Impacts, Rest, SimulationResult, Stall, TurnWorks};
use super::watch::{LinkState, Watch};
use super::{IntegratorStop, SimulationError};
use jred_file::model::machine::MachineFile;
use jred_file::model::simulation::{EndStops, Halt, Simulation};
use jred_file::number::columns::Columns;
use jred_file::number::numerics::dormand_prince::{Accuracy, StatePoint};

/// The most steps within one output step.
const MOST_STEPS: u32 = 1_000_000;

/// Most reversals of the drive link within one output step.
const MOST_TURNS: u32 = 10_000;

/// Smallest speed (rad/s) that determines the direction of a motion to come, and with it the losses of each stage.
pub(crate) const SIGN_SPEED: f64 = 1e-12;

/// Runs a simulation.
///
/// # Errors
/// The machine cannot be placed at the start, or is not closed there.
pub(super) fn run<const N: usize>(
    plant: &impl Plant<N>,
    simulation: &Simulation,
    observer: &mut dyn Observer,
) -> Result<SimulationResult, SimulationError> {
    let machines = plant.machines();
    let corners = plant.corners();
    let guests = machines.guests();
    let mut run = Run::new(plant, &machines, simulation, observer);
    let mut y = plant.start()?;
    run.direction = run.heading(&y)?;
    let DriveState { phi: begin, omega } = plant.link(0.0, &y)?;
    run.begin = (machines.go_by_turns()).then_some(begin);
    if run.to_speed.is_some_and(|to| omega.abs() >= to) {
        run.reached = Some(Passage { t: 0.0, phi: begin });
    }
    run.watch.check(run.at(0.0, &y)?)?;
    if omega == 0.0 {
        run.misses(0.0, &y)?;
    }
    let figures = plant.heads().into_iter().chain(run.observer.columns());
    let has_brake = (simulation.halt).is_some_and(|halt| halt.brake_torque != 0.0);
    let terms = Terms {
        brake: has_brake,
        payloads: guests.payloads,
        carriages: guests.carriages,
    };
    let mut columns = Columns::new(heads(figures.collect(), terms));
    let mut states = Vec::new();
    let mut moments = Vec::new();
    let steps = (simulation.duration / simulation.output_step)
        .round()
        .max(1.0) as usize;
    let mut start_energy = None;
    let mut t = 0.0;
    let mut ended = None;
    for k in 0..=steps {
        let end = simulation.duration * k as f64 / steps as f64;
        let step = run.output_step(&corners, simulation.halt, [t, end], y);
        let row = step.and_then(|state| {
            y = state;
            let at = run.at(end, &y)?;
            let mut row = plant.row(&at.moment, &y)?;
            if let Some(working) = plant.working(&at.moment, &y)? {
                row.figures.extend(run.observer.figures(&working));
            }
            states.push(at.state);
            moments.push(at.moment);
            Ok(row)
        });
        let row = match row {
            Ok(row) => row,
            Err(error) => {
                ended = Some(error);
                break;
            }
        };
        t = end;
        let energy = row.kinetic + row.beyond + row.potential;
        let start = *start_energy.get_or_insert(energy);
        let works = run.works(&y, terms);
        columns.push(cells(t, row, works, start).0);
    }
    let runs_down = run.halt.is_none() && simulation.control.is_none() && ended.is_none();
    let since_start = |at: Passage| Rest {
        time: at.t,
        way: at.phi - begin,
    };
    Ok(SimulationResult {
        columns,
        halted_at: run.halt.map(|at| at.phi),
        held: run.held.filter(|_| runs_down).map(since_start),
        turned: run.turned,
        effort: run.giving.effort(),
        reached: run.reached.map(since_start),
        rest: run.rest,
        turned_back: run.turned_back,
        impacts: run.impacts,
        missing: run.stuck,
        torque_limit: run.controlling.limit,
        following: run.controlling.following,
        states,
        moments,
        ended,
    })
}

struct Run<'a, P> {
    plant: &'a P,
    file: &'a MachineFile,
    accuracy: Accuracy,
    /// The joints that may separate.
    watch: Watch<'a>,
    /// The end stops of the drive link.
    stops: Option<EndStops>,
    /// The ends of its travel.
    ends: Option<[f64; 2]>,
    impacts: Option<Impacts>,
    /// Works in whole turns.
    turned: Option<TurnWorks>,
    /// Start position, if the drive link can turn endlessly.
    begin: Option<f64>,
    direction: f64,
    /// The corners before and after: forces may jump at either, so a step is evaluated inside.
    inside: [f64; 2],
    edges: Edges<'a>,
    /// The next edge ahead.
    edge: f64,
    /// Number of the integrator's steps.
    steps: Cell<u64>,
    /// Time and position at which the motor was switched off.
    halt: Option<Passage>,
    /// Work of the motor until then (J).
    driven: Option<f64>,
    rest: Option<Rest>,
    turned_back: Option<Rest>,
    stuck: Option<Stall>,
    controlling: ControlStatistics,
    has_payloads: bool,
    /// Effort of the motor.
    giving: EffortSums,
    to_speed: Option<f64>,
    /// Time and position at which that speed was reached.
    reached: Option<Passage>,
    /// Time and position from which friction holds the drive link.
    held: Option<Passage>,
    observer: &'a mut dyn Observer,
}

impl<P> Run<'_, P> {
    /// The works up to a state.
    fn works<const N: usize>(&self, y: &[f64; N], terms: Terms) -> Works
    where
        P: Plant<N>,
    {
        let [at_shaft, process, losses] = std::array::from_fn(|i| y[N - 3 + i]);
        // Once the motor is switched off, the work at its shaft is the brake's.
        let motor = self.driven.filter(|_| terms.brake).unwrap_or(at_shaft);
        let guest = |k: usize, has: bool| {
            let at = self.plant.guests().filter(|_| has)?;
            y.get(at + k).copied()
        };
        Works {
            motor,
            brake: terms.brake.then_some(at_shaft - motor),
            payloads: guest(0, terms.payloads),
            carriages: guest(1, terms.carriages),
            process,
            losses,
        }
    }

    /// Integrates over an output step, from corner to corner.
    fn output_step<const N: usize>(
        &mut self,
        corners: &Corners,
        halt: Option<Halt>,
        [mut t, end]: [f64; 2],
        mut y: [f64; N],
    ) -> Result<[f64; N], SimulationError>
    where
        P: Plant<N>,
    {
        for _ in 0..MOST_STEPS {
            let [before, after] = corners.around(t);
            let inset = EDGE * (1.0 + t);
            let inside = [
                before.map_or(f64::NEG_INFINITY, |at| at + inset),
                after.map_or(f64::INFINITY, |at| at - inset),
            ];
            y = self.enter(inside, t, y)?;
            if self.halt.is_none() && halt.is_some_and(|halt| halt.time <= t) {
                let DriveState { phi, omega } = self.plant.link(t, &y)?;
                self.halt = Some(Passage { t, phi });
                self.driven = Some(y[N - 3]);
                if omega == 0.0 {
                    self.stands(Passage { t, phi });
                }
            }
            // A held link may be released now, or a brake may hold a link at rest.
            if before == Some(t) && self.plant.link(t, &y)?.omega == 0.0 {
                self.leave_rest(t, &y)?;
            }
            if t >= end {
                return Ok(y);
            }
            let next = after.map_or(end, |at| at.min(end));
            y = self.advance(t, next, y)?;
            t = next;
        }
        Err(SimulationError::Integrator {
            t,
            why: IntegratorStop::Corners,
        })
    }

    /// The drive link is at rest: held, or reversing.
    fn stands(&mut self, at: Passage) {
        let Some(halt) = self.halt else {
            return;
        };
        let rest = Rest {
            time: at.t - halt.t,
            way: at.phi - halt.phi,
        };
        if self.direction == 0.0 {
            self.rest = self.rest.or(Some(rest));
        } else if at.t > halt.t {
            self.turned_back = self.turned_back.or(Some(rest));
        }
    }

    /// Integrates from `t` to `end`; where friction changes, the link reverses, is held or is released.
    fn advance<const N: usize>(
        &mut self,
        mut t: f64,
        end: f64,
        mut y: [f64; N],
    ) -> Result<[f64; N], SimulationError>
    where
        P: Plant<N>,
    {
        let mut turned = 0;
        while turned < MOST_TURNS {
            if t >= end {
                return Ok(y);
            }
            let phi = self.plant.link(t, &y)?.phi;
            self.edge = if self.direction == 0.0 {
                f64::INFINITY
            } else {
                self.edges.ahead(phi, self.direction)
            };
            let steps = self.integrate(t, end, &y)?;
            let [over, passed] = match steps.split_last() {
                Some(((last, state), [_, ..])) => {
                    let phi = self.plant.link(*last, state)?.phi;
                    [self.is_over(*last, state)?, self.has_passed(phi)]
                }
                _ => [false; 2],
            };
            let whole = steps.len() - usize::from(over || passed);
            for pair in steps[..whole].windows(2) {
                let [from, to] = pair else { continue };
                self.check(from, to)?;
            }
            let Some(&last) = steps.last().filter(|_| over || passed) else {
                return Ok(steps.last().map_or(y, |last| last.1));
            };
            let start = steps.get(whole - 1).copied().unwrap_or((t, y));
            if !over {
                let edge = self.on_edge(start, last)?;
                self.check(&start, &edge)?;
                (t, y) = edge;
                continue;
            }
            turned += 1;
            // Friction changes within the last step: bisect to that instant.
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
            let link = self.plant.link(t, &after.1)?;
            if let Some(phi) = self.stop_behind(link) {
                y = self.impact(t, &after.1, DriveState { phi, ..link })?;
                continue;
            }
            // A held link starts where it is released; a reversing link starts from rest.
            y = if self.direction == 0.0 {
                after.1
            } else {
                before.1
            };
            let phi = self.plant.link(t, &y)?.phi;
            y = self
                .plant
                .with_link(t, &y, DriveState { phi, omega: 0.0 })?;
            self.misses(t, &y)?;
            self.leave_rest(t, &y)?;
            self.stands(Passage { t, phi });
            if self.direction == 0.0 {
                self.held = self.held.or(Some(Passage { t, phi }));
            }
        }
        Err(SimulationError::Integrator {
            t,
            why: IntegratorStop::Reversals,
        })
    }

    /// Whether the drive link has reversed, or friction no longer holds it.
    fn is_over<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<bool, Error>
    where
        P: Plant<N>,
    {
        if self.direction == 0.0 {
            return Ok(self.start_direction(t, y)? != 0.0);
        }
        let link = self.plant.link(t, y)?;
        Ok(link.omega * self.direction < 0.0 || self.stop_behind(link).is_some())
    }

    fn at<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<LinkState, Error>
    where
        P: Plant<N>,
    {
        let DriveState { phi, omega } = self.plant.link(t, y)?;
        let moment = self.moment(t);
        let alpha = if self.direction == 0.0 {
            0.0
        } else {
            self.plant.alpha(&moment, y)?
        };
        let state = [phi, omega, alpha];
        Ok(LinkState { moment, state })
    }

    /// Refuses the interval from one step to the next if a joint separates or the equations become invalid.
    fn check<const N: usize>(
        &mut self,
        from: &StatePoint<N>,
        to: &StatePoint<N>,
    ) -> Result<(), SimulationError>
    where
        P: Plant<N>,
    {
        for (t, y) in [from, to] {
            self.plant.check(&self.moment(*t), y)?;
        }
        self.observe(from, to)?;
        self.count_turns(from, to)?;
        if self.watch.is_idle() || self.direction == 0.0 {
            return Ok(());
        }
        let ends = [self.at(from.0, &from.1)?, self.at(to.0, &to.1)?];
        self.watch.check_between(ends, |t, link| {
            let share = (t - from.0) / (to.0 - from.0);
            let y = std::array::from_fn(|i| from.1[i] + share * (to.1[i] - from.1[i]));
            let y = self.plant.with_link(t, &y, link)?;
            Ok(self.plant.alpha(&self.moment(t), &y)?)
        })
    }
}
