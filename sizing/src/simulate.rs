//! `jred simulate`: the free motion φ(t), ω(t) under a motor torque, (7.12) and (7.13).
//!
//! The integrator is Dormand and Prince's method of order 8(5,3) (crate `ode_solvers`) with the tolerance of the
//! file. Beside φ and ω it integrates the work of the motor, of the signed process loads, and the losses, so that
//! the energy balance closes only if motion and reduction agree.

use std::cell::RefCell;

use jred::{Domain, Error, Reducible as _};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

use crate::columns::Columns;
use crate::coordinate::Coordinate;
use crate::machine::{MachineFile, Shaft, Simulation};
use crate::variator;

mod error;
mod watch;

pub use error::SimulationError;
pub(crate) use error::stopped;
pub(crate) use watch::{At, Watch};

/// φ, ω, work of the motor, work of the process loads, losses.
type State = SVector<f64, 5>;

/// The machine with its drive and motor torque, moving in one direction.
struct Plant<'a> {
    file: &'a MachineFile,
    simulation: &'a Simulation,
    /// Direction that friction opposes: +1, −1, or 0 at rest.
    direction: f64,
    /// The integrator cannot pass on errors: the first one waits here.
    fault: &'a RefCell<Option<Error>>,
    /// The joints that can let go.
    watch: &'a Watch<'a>,
}

/// What happens at one state.
struct Instant {
    alpha: f64,
    motor_power: f64,
    process_power: f64,
    loss: f64,
}

impl Plant<'_> {
    fn motor_torque(&self, omega: f64) -> f64 {
        let ratio = match self.simulation.at {
            Shaft::Motor => self.file.drive_train.ratio(),
            Shaft::DriveLink => 1.0,
        };
        interpolate(&self.simulation.torque, omega * ratio)
    }

    /// The acceleration that solves the equation of motion through the losses of the drive train.
    ///
    /// The torque that the motor must give is piecewise linear and monotone in α (each stage's efficiency changes
    /// sides with its power), so Newton's method ends after a few steps.
    fn instant(&self, phi: f64, omega: f64) -> Result<Instant, Error> {
        let point = self.file.machine.bare_reduction(phi)?;
        let load = point.load_torque() - point.viscous * omega - point.coulomb * self.direction;
        let resisting = 0.5 * point.inertia[1] * omega * omega - load;
        let torque = self.motor_torque(omega);
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let rotor = self.simulation.rotor_inertia;
        // With the torque at the drive link, what sits in front of it only drags along.
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        let mut alpha = 0.0;
        let mut input = train.input(0.0, 0.0, omega, alpha);
        for _ in 0..50 {
            let asked = point.inertia[0] * alpha + resisting - at_link;
            input = train.input(asked, point.inertia[0], omega, alpha);
            let excess = input.torque + rotor * ratio * alpha - at_motor;
            let slope = input.torque_per_alpha + rotor * ratio;
            let step = excess / slope;
            alpha -= step;
            if step.abs() <= 1e-15 * alpha.abs() {
                break;
            }
        }
        let motor_speed = match self.simulation.at {
            Shaft::Motor => omega * ratio,
            Shaft::DriveLink => omega,
        };
        Ok(Instant {
            alpha,
            motor_power: torque * motor_speed,
            process_power: point.process * omega,
            loss: input.loss + (point.viscous * omega + point.coulomb * self.direction) * omega,
        })
    }

    /// The way the machine starts to move from rest at `phi`: +1, −1, or 0 if friction holds it.
    fn start_direction(&self, phi: f64) -> Result<f64, Error> {
        for direction in [1.0, -1.0] {
            let plant = Plant { direction, ..*self };
            // A hair of speed puts each stage's losses on the side of the motion to come.
            if plant.instant(phi, direction * 1e-12)?.alpha * direction > 0.0 {
                return Ok(direction);
            }
        }
        Ok(0.0)
    }
}

impl Plant<'_> {
    /// Looks at the joints that can let go from one of the `steps` after `t` to the next.
    fn watch_over(&self, t: f64, steps: Option<&[(f64, State)]>) -> Result<(), SimulationError> {
        if self.watch.is_idle() {
            return Ok(());
        }
        let alpha = |phi, omega| Ok::<f64, Error>(self.instant(phi, omega)?.alpha);
        let at = |(x, y): &(f64, State)| {
            let state = [y[0], y[1], alpha(y[0], y[1])?];
            Ok::<At, Error>(At { t: t + x, state })
        };
        for pair in steps.unwrap_or_default().windows(2) {
            let [from, to] = pair else { continue };
            let ends = [at(from)?, at(to)?];
            self.watch
                .check_between(ends, |_, [phi, omega]| Ok(alpha(phi, omega)?))?;
        }
        Ok(())
    }
}

impl System<f64, State> for &Plant<'_> {
    fn system(&self, _t: f64, y: &State, dy: &mut State) {
        match self.instant(y[0], y[1]) {
            Ok(now) => {
                *dy = State::from([
                    y[1],
                    now.alpha,
                    now.motor_power,
                    now.process_power,
                    now.loss,
                ]);
            }
            Err(error) => {
                self.fault.borrow_mut().get_or_insert(error);
                *dy = State::zeros();
            }
        }
    }

    /// Ends the integration with the step in which the machine turns round: friction must not go on with the old sign.
    fn solout(&mut self, _t: f64, y: &State, _dy: &State) -> bool {
        y[1] * self.direction < 0.0
    }
}

/// Runs the simulation of the file: t, φ, ω, α, J, energies, and the balance
/// (E + U) − (E + U)₀ − W_motor − W_process + losses, which is zero up to the tolerance.
///
/// # Errors
/// Those of the machine and the integrator.
pub fn simulate(file: &MachineFile, simulation: &Simulation) -> Result<Columns, SimulationError> {
    if let Some(variator) = &file.variator {
        return variator::simulate(file, variator, simulation);
    }
    let fault = RefCell::new(None);
    let watch = Watch::new(file);
    let mut plant = Plant {
        file,
        simulation,
        direction: 0.0,
        fault: &fault,
        watch: &watch,
    };
    let mut y = State::from([
        simulation.start_angle,
        simulation.start_speed,
        0.0,
        0.0,
        0.0,
    ]);
    plant.direction = heading(&plant, &y)?;
    let coordinate = Coordinate::of(file.machine.mechanism())?;
    let [speed, acceleration] = coordinate.rates();
    let inertia = format!("{} [{}]", coordinate.inertia(), coordinate.inertia_unit());
    let motor = if simulation.drives_a_slide(file, coordinate) {
        "motor force [N]"
    } else {
        "motor torque [N m]"
    };
    let mut columns = Columns::new([
        "t [s]",
        coordinate.column(),
        speed,
        acceleration,
        motor,
        &inertia,
        "kinetic energy [J]",
        "potential energy [J]",
        "motor work [J]",
        "process work [J]",
        "losses [J]",
        "energy balance [J]",
    ]);
    // The rotor and the drive train turn with the drive link.
    let ratio = file.drive_train.ratio();
    let drive = (file.drive_train.inertia_at_input() + simulation.rotor_inertia) * ratio * ratio;
    let mut start_energy = None;
    let steps = (simulation.duration / simulation.output_step)
        .round()
        .max(1.0) as usize;
    let mut t = 0.0;
    for k in 0..=steps {
        let end = simulation.duration * k as f64 / steps as f64;
        y = advance(&mut plant, t, end, y)?;
        t = end;
        let point = file.machine.bare_reduction(y[0])?;
        let now = plant.instant(y[0], y[1])?;
        let alpha = if plant.direction == 0.0 {
            0.0
        } else {
            now.alpha
        };
        if k == 0 {
            let state = [y[0], y[1], alpha];
            watch.check(At { t, state })?;
        }
        let inertia = point.inertia[0] + drive;
        let kinetic = 0.5 * inertia * y[1] * y[1];
        let energy = kinetic + point.potential_energy[0];
        let start = *start_energy.get_or_insert(energy);
        let balance = energy - start - y[2] - y[3] + y[4];
        columns.push([
            t,
            coordinate.shown(y[0]),
            y[1],
            alpha,
            plant.motor_torque(y[1]),
            inertia,
            kinetic,
            point.potential_energy[0],
            y[2],
            y[3],
            y[4],
            balance,
        ]);
    }
    Ok(columns)
}

/// The direction of motion at a state; at rest, the way it will start.
fn heading(plant: &Plant, y: &State) -> Result<f64, Error> {
    if y[1] == 0.0 {
        plant.start_direction(y[0])
    } else {
        Ok(y[1].signum())
    }
}

/// Integrates from `t` to `end`; where the machine comes to rest, friction turns round or holds it.
fn advance(
    plant: &mut Plant,
    mut t: f64,
    end: f64,
    mut y: State,
) -> Result<State, SimulationError> {
    // Enough for a machine that reverses many times within one output step.
    for _ in 0..10_000 {
        if t >= end || plant.direction == 0.0 {
            return Ok(y);
        }
        let steps = integrate(plant, t, end, &y)?;
        let turned = |state: &State| state[1] * plant.direction < 0.0;
        let reversal = steps.iter().position(|(_, state)| turned(state));
        plant.watch_over(t, steps.get(..reversal.unwrap_or(steps.len())))?;
        let Some(k) = reversal else {
            return Ok(steps.last().map_or(y, |last| last.1));
        };
        // ω changed its sign within a step: halve it down to the instant of rest.
        let (start, state) = match k.checked_sub(1).and_then(|before| steps.get(before)) {
            Some((x, state)) => (t + x, *state),
            None => (t, y),
        };
        let (mut before, mut after, mut at_rest) =
            (start, steps.get(k).map_or(end, |s| t + s.0), state);
        while after - before > 1e-12 * (1.0 + end.abs()) {
            let middle = 0.5 * (before + after);
            let steps = integrate(plant, start, middle, &state)?;
            match steps.last() {
                Some((_, last)) if !turned(last) => (before, at_rest) = (middle, *last),
                _ => after = middle,
            }
        }
        plant.watch_over(start, Some(&[(0.0, state), (before - start, at_rest)]))?;
        y = at_rest;
        y[1] = 0.0;
        t = after.min(end);
        plant.direction = plant.start_direction(y[0])?;
    }
    Ok(y)
}

/// The integrator's steps from `t` to `end` as (time after `t`, state), up to the one in which ω turns round.
fn integrate(
    plant: &Plant,
    t: f64,
    end: f64,
    y: &State,
) -> Result<Vec<(f64, State)>, SimulationError> {
    if end <= t {
        return Ok(vec![(0.0, *y)]);
    }
    let tolerance = plant.simulation.tolerance;
    // The equations do not contain the time: counted from here, short intervals keep all their digits.
    let span = end - t;
    let mut solver = Dop853::new(plant, 0.0, span, span, *y, tolerance, tolerance);
    // Only the steps themselves: their last is the end, to full order.
    solver.set_output(OutputType::Sparse);
    let outcome = solver.integrate();
    if let Some(error) = plant.fault.borrow_mut().take() {
        return Err(error.into());
    }
    outcome.map_err(|error| stopped(t, &error))?;
    let steps = solver.x_out().iter().zip(solver.y_out());
    let steps: Vec<(f64, State)> = steps.map(|(x, state)| (*x, *state)).collect();
    within_stroke(plant, t, &steps)?;
    Ok(steps)
}

/// Refuses to go on where the drive link has passed the end of its stroke: what stops it there is not in the file.
fn within_stroke(plant: &Plant, t: f64, steps: &[(f64, State)]) -> Result<(), SimulationError> {
    let Domain::Stroke { from, to } = plant.file.machine.domain() else {
        return Ok(());
    };
    let slack = 1e-9 * (to - from);
    let outside = |(_, y): &&(f64, State)| !(from - slack..=to + slack).contains(&y[0]);
    let Some((x, y)) = steps.iter().find(outside) else {
        return Ok(());
    };
    let coordinate = Coordinate::of(plant.file.machine.mechanism())?;
    Err(SimulationError::EndOfStroke {
        t: t + x,
        end: coordinate.place(if y[0] < from { from } else { to }),
        speed: format!("{} {}", (y[1] * 1e6).round() / 1e6, coordinate.speed_unit()),
    })
}

/// Straight lines between (x, y) points, the end values beyond the ends.
pub(crate) fn interpolate(points: &[(f64, f64)], x: f64) -> f64 {
    let right = points.partition_point(|p| p.0 < x);
    match (
        right.checked_sub(1).and_then(|k| points.get(k)),
        points.get(right),
    ) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0),
        (Some(only), None) | (None, Some(only)) => only.1,
        (None, None) => 0.0,
    }
}
