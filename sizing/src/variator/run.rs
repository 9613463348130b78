//! `jred simulate` for a machine with a variator.
//!
//! States: the angle and speed of the motor, the angle of the drive link, and of a creeping contact the speed behind it.
//! The angle of the drive link is integrated with its own speed, never taken from the motor's.

use std::cell::RefCell;

use jred::Error;
use jred::friction::{Place, Stage};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

use super::{Slip, Variator};
use crate::machine::{MachineFile, Shaft, Simulation};
use crate::output::Columns;
use crate::simulate::{SimulationError, interpolate, stopped};

/// φ₁, ω₁ of the input shaft; φ of the drive link; ω₂ of the output shaft (creep only); work of the motor, work of the
/// process loads, losses; the time.
///
/// The time is a state because the integrator's twelfth stage asks for the forces at the wrong time (`ode_solvers` 0.6.2,
/// node c₁₂ of its table, its pull request 42): with the time among the states no stage needs to be told.
type State = SVector<f64, 8>;

/// Index of the time.
const TIME: usize = 7;

/// Losses may be negative by this share of the power through the contact: rounding.
const ROUNDING: f64 = 1e-9;

/// Step control of the integrator: its own defaults, without its test for stiffness. A creeping contact near standstill is
/// stiff (J·s·ω/torque is some microseconds), but small steps master it.
const CONTROL: [f64; 4] = [0.9, 0.0, 0.333, 6.0];

/// The most steps within one output step.
const MOST_STEPS: u32 = 1_000_000;

/// The machine with its variator, motor torque and direction.
struct Plant<'a> {
    file: &'a MachineFile,
    simulation: &'a Simulation,
    variator: &'a Variator,
    stage: Stage<'a>,
    /// Direction of the drive link that friction opposes: +1, −1, or 0 where friction holds it.
    direction: f64,
    /// The integrator cannot pass on errors: the first one waits here.
    fault: &'a RefCell<Option<Error>>,
}

/// What happens at one state.
#[derive(Clone, Copy, Default)]
struct Instant {
    /// ω̇ of the input shaft, the output shaft and the drive link.
    alpha: [f64; 3],
    /// ω of the output shaft and the drive link.
    omega: [f64; 2],
    ratio: f64,
    slip: f64,
    /// Torque of the contact on the output shaft.
    contact: f64,
    contact_loss: f64,
    motor_torque: f64,
    motor_power: f64,
    process_power: f64,
    loss: f64,
    /// Inertia of the mechanism at its drive link.
    inertia: f64,
    potential: f64,
}

/// What the mechanism and its drive train ask for at the output shaft: torque at no acceleration of the drive link, and
/// by how much each unit of it adds.
struct Behind<'a> {
    plant: &'a Plant<'a>,
    inertia: f64,
    resisting: f64,
    omega: f64,
}

impl Behind<'_> {
    /// Torque at the output shaft, its derivative by the drive link's acceleration, and the drive train's loss.
    fn torque(&self, alpha: f64) -> [f64; 3] {
        let train = &self.plant.file.drive_train;
        let asked = self.inertia * alpha + self.resisting;
        let input = train.input(asked, self.inertia, self.omega, alpha);
        let own = self.plant.variator.inertia[1];
        [
            input.torque + own * train.ratio() * alpha,
            input.torque_per_alpha + own * train.ratio(),
            input.loss,
        ]
    }
}

/// The zero of a rising, piecewise linear function, from its value and slope: the efficiencies of the drive train change
/// sides with its power.
fn newton(f: impl Fn(f64) -> [f64; 2]) -> f64 {
    let mut x = 0.0f64;
    for _ in 0..50 {
        let [value, slope] = f(x);
        let step = value / slope;
        x -= step;
        if step.abs() <= 1e-15 * x.abs() {
            break;
        }
    }
    x
}

impl Plant<'_> {
    fn creeps(&self) -> bool {
        matches!(self.variator.slip, Slip::Creep(_))
    }

    fn instant(&self, t: f64, y: &State) -> Result<Instant, Error> {
        let n = self.file.drive_train.ratio();
        let ratios = self.stage.at(Place::new(t, y[0], 0.0))?;
        let (i, j) = (ratios.geometric.value, ratios.speed.value);
        // The ratio depends on time alone.
        let rate = ratios.speed.slope[0];
        let second = if self.creeps() { y[3] } else { j * y[1] };
        let omega = second / n;
        let point = self.file.machine.bare_reduction(y[2])?;
        let speed = match self.simulation.at {
            Shaft::Motor => y[1],
            Shaft::DriveLink => omega,
        };
        let torque = interpolate(&self.simulation.torque, speed);
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        let friction = point.viscous * omega + point.coulomb * self.direction;
        let behind = Behind {
            plant: self,
            inertia: point.inertia[0],
            resisting: 0.5 * point.inertia[1] * omega * omega - point.load_torque() + friction
                - at_link,
            omega,
        };
        let input = self.variator.inertia[0] + self.simulation.rotor_inertia;
        let mut now = Instant {
            omega: [second, omega],
            ratio: i,
            motor_torque: torque,
            motor_power: torque * speed,
            process_power: point.process * omega,
            inertia: point.inertia[0],
            potential: point.potential_energy[0],
            ..Instant::default()
        };
        if let Slip::Creep(contact) = self.variator.slip {
            let traction = contact.traction(i * y[1], second);
            let alpha = newton(|alpha| {
                let [torque, slope, _] = behind.torque(alpha);
                [torque - traction.torque, slope]
            });
            now.alpha = [(at_motor - i * traction.torque) / input, alpha * n, alpha];
            now.slip = traction.slip;
            now.contact = traction.torque;
            now.contact_loss = traction.loss;
        } else {
            let force = match self.variator.contact() {
                jred::friction::Contact::Ideal => j,
                jred::friction::Contact::Slipping => i,
            };
            let link = |first: f64| (j * first + rate * y[1]) / n;
            let first = newton(|first| {
                let [torque, slope, _] = behind.torque(link(first));
                [
                    input * first + force * torque - at_motor,
                    input + force * slope * j / n,
                ]
            });
            let alpha = link(first);
            let [torque, ..] = behind.torque(alpha);
            now.alpha = [first, alpha * n, alpha];
            now.slip = ratios.slip.value;
            now.contact = torque;
            now.contact_loss = torque * (force - j) * y[1];
        }
        let [.., train] = behind.torque(now.alpha[2]);
        now.loss = now.contact_loss + train + friction * omega;
        Ok(now)
    }

    /// The way the drive link starts to move from rest: +1, −1, or 0 if friction holds it.
    fn start_direction(&self, t: f64, y: &State) -> Result<f64, Error> {
        for direction in [1.0, -1.0] {
            let plant = Plant { direction, ..*self };
            // A hair of speed puts each stage's losses on the side of the motion to come.
            let hair = direction * 1e-12 * self.file.drive_train.ratio();
            let mut moved = *y;
            if self.creeps() {
                moved[3] = hair;
            } else {
                moved[1] = hair / self.stage.at(Place::new(t, y[0], 0.0))?.speed.value;
            }
            if plant.instant(t, &moved)?.alpha[2] * direction > 0.0 {
                return Ok(direction);
            }
        }
        Ok(0.0)
    }

    fn heading(&self, t: f64, y: &State) -> Result<f64, Error> {
        let omega = self.instant(t, y)?.omega[1];
        if omega == 0.0 {
            self.start_direction(t, y)
        } else {
            Ok(omega.signum())
        }
    }

    /// Whether the drive link has turned round, or friction does not hold it any more.
    fn over(&self, t: f64, y: &State) -> Result<bool, Error> {
        if self.direction == 0.0 {
            return Ok(self.start_direction(t, y)? != 0.0);
        }
        Ok(self.instant(t, y)?.omega[1] * self.direction < 0.0)
    }
}

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
    let mut plant = Plant {
        file,
        simulation,
        variator,
        stage: variator.stage()?,
        direction: 0.0,
        fault: &fault,
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
