//! `jred simulate` for a machine with a variator.
//!
//! States: the angle and speed of the motor, the angle of the drive link, and of a creeping contact the speed behind it.
//! The angle of the drive link is integrated with its own speed, never taken from the motor's.

use std::cell::RefCell;

use jred::friction::Place;
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, System};

use super::Variator;
use super::plant::{Plant, State, TIME};
use crate::columns::Columns;
use crate::machine::{MachineFile, Simulation};
use crate::simulate::{At, SimulationError, Watch, stopped};

/// Losses may be negative by this share of the power through the contact: rounding.
const ROUNDING: f64 = 1e-9;

/// Step control of the integrator: its own defaults, without its test for stiffness. A creeping contact near standstill is
/// stiff (J·s·ω/torque is some microseconds), but small steps master it.
const CONTROL: [f64; 4] = [0.9, 0.0, 0.333, 6.0];

/// The most steps within one output step.
const MOST_STEPS: u32 = 1_000_000;

impl System<f64, State> for &Plant<'_> {
    fn system(&self, _t: f64, y: &State, dy: &mut State) {
        match self.instant(y[TIME], y) {
            Ok(now) => {
                let held = self.direction == 0.0;
                let free = if held && !self.creeps() { 0.0 } else { 1.0 };
                let moving = if held { 0.0 } else { 1.0 };
                let second = if self.creeps() { now.alpha[1] } else { 0.0 };
                *dy = State::from([
                    y[1] * free,
                    now.alpha[0] * free,
                    now.omega[1] * moving,
                    second * moving,
                    now.motor_power,
                    now.process_power,
                    now.loss,
                    1.0,
                ]);
            }
            Err(error) => {
                self.fault.borrow_mut().get_or_insert(error);
                *dy = State::zeros();
            }
        }
    }

    /// Ends the integration with the step in which friction changes.
    fn solout(&mut self, _t: f64, y: &State, _dy: &State) -> bool {
        self.over(y[TIME], y).unwrap_or(true)
    }
}

/// Runs the simulation of a file with a variator.
pub(crate) fn simulate(
    file: &MachineFile,
    variator: &Variator,
    simulation: &Simulation,
) -> Result<Columns, SimulationError> {
    let fault = RefCell::new(None);
    let watch = Watch::new(file);
    let mut plant = Plant {
        file,
        simulation,
        variator,
        stage: variator.stage()?,
        direction: 0.0,
        fault: &fault,
        watch: &watch,
    };
    let n = file.drive_train.ratio();
    let start = plant.stage.at(Place::new(0.0, 0.0, 0.0))?.speed.value;
    let second = simulation.start_speed * n;
    let own = if plant.creeps() { second } else { 0.0 };
    let mut y = State::from([
        0.0,
        second / start,
        simulation.start_angle,
        own,
        0.0,
        0.0,
        0.0,
        0.0,
    ]);
    plant.direction = plant.heading(0.0, &y)?;
    let mut columns = Columns::new([
        "t [s]",
        "phi [deg]",
        "omega [rad/s]",
        "alpha [rad/s^2]",
        "input phi [deg]",
        "input omega [rad/s]",
        "ratio",
        "slip [%]",
        "contact torque [N m]",
        "motor torque [N m]",
        "J_red [kg m^2]",
        "kinetic energy [J]",
        "potential energy [J]",
        "motor work [J]",
        "process work [J]",
        "losses [J]",
        "energy balance [J]",
    ]);
    let train = file.drive_train.inertia_at_input() + variator.inertia[1];
    let input = variator.inertia[0] + simulation.rotor_inertia;
    let mut start_energy = None;
    let steps = (simulation.duration / simulation.output_step)
        .round()
        .max(1.0) as usize;
    let mut t = 0.0;
    for k in 0..=steps {
        let end = simulation.duration * k as f64 / steps as f64;
        // Up to each begin and end of a shift by itself: the integrator's steps do not pass over a jump.
        let mut breaks: Vec<f64> = variator
            .ratio
            .breaks()
            .filter(|at| *at > t && *at < end)
            .collect();
        breaks.push(end);
        for next in breaks {
            y = advance(&mut plant, t, next, y)?;
            t = next;
        }
        let now = plant.instant(t, &y)?;
        let held = plant.direction == 0.0;
        let [second, omega] = if held { [0.0; 2] } else { now.omega };
        let behind = now.inertia + train * n * n;
        let kinetic = 0.5 * (input * y[1] * y[1] + train * second * second)
            + 0.5 * now.inertia * omega * omega;
        let energy = kinetic + now.potential;
        let before = *start_energy.get_or_insert(energy);
        let speed = plant.stage.at(Place::new(t, y[0], 0.0))?.speed.value;
        columns.push([
            t,
            y[2].to_degrees(),
            omega,
            if held { 0.0 } else { now.alpha[2] },
            y[0].to_degrees(),
            y[1],
            now.ratio,
            now.slip * 100.0,
            now.contact,
            now.motor_torque,
            behind + input * n * n / (speed * speed),
            kinetic,
            now.potential,
            y[4],
            y[5],
            y[6],
            energy - before - y[4] - y[5] + y[6],
        ]);
    }
    Ok(columns)
}

/// Integrates from `t` to `end`; where friction changes, it turns round, holds or lets go.
fn advance(
    plant: &mut Plant,
    mut t: f64,
    end: f64,
    mut y: State,
) -> Result<State, SimulationError> {
    // Enough for a machine that reverses many times within one output step.
    for _ in 0..10_000 {
        if t >= end {
            return Ok(y);
        }
        let steps = integrate(plant, t, end, &y)?;
        let Some(k) = first_over(plant, &steps)? else {
            return Ok(steps.last().map_or(y, |last| last.1));
        };
        // Friction changes within a step: halve it down to that instant.
        let (start, state) = match k.checked_sub(1).and_then(|before| steps.get(before)) {
            Some((at, state)) => (*at, *state),
            None => (t, y),
        };
        let (mut before, mut after) = ((start, state), steps.get(k).copied().unwrap_or((end, y)));
        while after.0 - before.0 > 1e-12 * (1.0 + end.abs()) {
            let middle = before.0.midpoint(after.0);
            let steps = integrate(plant, start, middle, &state)?;
            let Some(&(at, last)) = steps.last() else {
                break;
            };
            if plant.over(at, &last)? {
                after = (at, last);
            } else {
                before = (at, last);
            }
        }
        t = after.0.min(end);
        // What was held starts where it is let go; what turns round does so from rest.
        y = if plant.direction == 0.0 {
            after.1
        } else {
            before.1
        };
        if plant.creeps() {
            y[3] = 0.0;
        } else {
            y[1] = 0.0;
        }
        plant.direction = plant.start_direction(t, &y)?;
    }
    Ok(y)
}

fn first_over(plant: &Plant, steps: &[(f64, State)]) -> Result<Option<usize>, SimulationError> {
    for (k, (t, y)) in steps.iter().enumerate() {
        if k > 0 && plant.over(*t, y)? {
            return Ok(Some(k));
        }
        let now = plant.instant(*t, y)?;
        if plant.direction != 0.0 {
            let state = [y[2], now.omega[1], now.alpha[2]];
            plant.watch.check(At { t: *t, state })?;
        }
        if now.contact_loss < -ROUNDING * (now.contact * now.omega[0]).abs() {
            return Err(SimulationError::PowerFlowsBack {
                t: *t,
                power: -now.contact_loss,
            });
        }
    }
    Ok(None)
}

/// The integrator's steps from `t` to `end` as (time, state), up to the one in which friction changes.
fn integrate(
    plant: &Plant,
    t: f64,
    end: f64,
    y: &State,
) -> Result<Vec<(f64, State)>, SimulationError> {
    if end <= t {
        return Ok(vec![(t, *y)]);
    }
    let tolerance = plant.simulation.tolerance;
    let span = end - t;
    let mut from = *y;
    from[TIME] = t;
    let [safety, beta, fac_min, fac_max] = CONTROL;
    // Sparse output: the steps themselves, of which the last is the end, to full order.
    let mut solver = Dop853::from_param(
        plant,
        0.0,
        span,
        span,
        from,
        tolerance,
        tolerance,
        safety,
        beta,
        fac_min,
        fac_max,
        span,
        0.0,
        MOST_STEPS,
        u32::MAX,
        OutputType::Sparse,
    );
    let outcome = solver.integrate();
    if let Some(error) = plant.fault.borrow_mut().take() {
        return Err(error.into());
    }
    outcome.map_err(|error| stopped(t, &error))?;
    let steps = solver.x_out().iter().zip(solver.y_out());
    Ok(steps.map(|(x, state)| (t + x, *state)).collect())
}
