//! The machine and its drive along the path: the motor torque required at a place, a speed and an acceleration, and the torque available.
//!
//! A motion in one direction passes each place once, so the place is the variable and the time a quadrature. All quantities are counted along the
//! path: the speed v is not negative, the acceleration a is positive where v grows, and a motor torque is positive where it drives.
//!
//! ```text
//! T(φ, v, a) = c·x,   x = (i·a, τ₊, τ₋, i·v, 1),   τ = train(J·a + ½·J′·v² + F(φ) + b·v + C)
//! ```
//!
//! with the coefficients c of the drive ([`Coefficients`]); J, J′, load F, viscous friction b and Coulomb friction C of the machine, all at the drive
//! link; and the losses of the drive train. T rises with a, in straight lines that meet where the power at a stage changes direction.

mod flows;

use jred::error::Error;
use jred::machine::Reduction;
use jred::machine::motion::State;
use jred::mechanism::TrainOutput;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;
use jred_sizing::catalogue::{Drive, Motor};
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;

use flows::Flows;

/// A drive at its supply, which moves the machine.
#[derive(Clone, Debug)]
pub struct Actuator {
    /// Motor torque as a linear form in the loads at the gearbox output.
    pub coefficients: Coefficients,
    /// Motor speed per speed of the gearbox output, positive.
    pub ratio: f64,
    /// Limits of the motor.
    pub envelope: Envelope,
}

impl Actuator {
    /// A drive of the catalogue with the envelope of its motor and amplifier at the supply.
    pub fn new(drive: &Drive<'_>, envelope: Envelope) -> Self {
        Self {
            coefficients: drive.coefficients(),
            ratio: drive.ratio(),
            envelope,
        }
    }

    /// Least and largest motor torque (N·m) at a motor speed (rad/s, not negative): −braking, driving.
    pub fn torques(&self, speed: f64) -> [f64; 2] {
        let limit = |braking: bool| self.envelope.limit(braking).torque(speed);
        [-limit(true), limit(false)]
    }
}

/// Without a drive: the torque at the input of the machine's drive train, without limits.
pub fn without_drive() -> Actuator {
    Actuator {
        coefficients: GEARBOX_OUTPUT,
        ratio: 1.0,
        envelope: Envelope::of(&Motor::default()),
    }
}

/// The machine with its drive, in one direction.
#[derive(Clone, Debug)]
pub struct PathDynamics<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// The drive.
    pub actuator: Actuator,
    /// +1 where φ grows, −1 where it falls.
    pub direction: f64,
    /// Signed ratio of the drive train.
    ratio: f64,
    /// Torque of the motor.
    motor: Flows,
    /// Torque of the gearbox output, the input of the drive train.
    gearbox: Flows,
}

/// The torque of the gearbox output as a linear form in the loads there.
const GEARBOX_OUTPUT: Coefficients = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);

/// The machine at a place, evaluated once for all speeds.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Position of the drive link (rad, or m).
    pub phi: f64,
    /// J (kg·m²) of the machine at the drive link, without drive train and drive.
    pub inertia: f64,
    /// J′, its slope along the path (kg·m²/rad).
    pub inertia_slope: f64,
    /// F: the torque (N·m) that holds the machine at rest here without friction, positive where weight and loads resist the
    /// motion.
    pub load: f64,
    /// b (N·m·s/rad).
    pub viscous: f64,
    /// C (N·m).
    pub coulomb: f64,
}

/// The required motor torque of a state.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    /// Torque (N·m), positive where it drives.
    pub torque: f64,
    /// Its slope by the acceleration of the drive link (kg·m²), positive.
    pub per_acceleration: f64,
}

impl Place {
    /// Resistance to the motion at a speed without acceleration (N·m), and the inertia (kg·m²).
    fn load(&self, speed: f64) -> [f64; 2] {
        let carried = 0.5 * self.inertia_slope * speed * speed;
        let resisting = carried + self.load + self.viscous * speed + self.coulomb;
        [resisting, self.inertia]
    }
}

impl<'a> PathDynamics<'a> {
    /// The path dynamics of a machine under a drive; `direction` is +1 or −1.
    pub fn new(file: &'a MachineFile, actuator: Actuator, direction: f64) -> Self {
        let train = &file.drive_train;
        Self {
            motor: Flows::new(train, &actuator.coefficients),
            gearbox: Flows::new(train, &GEARBOX_OUTPUT),
            ratio: train.ratio(),
            file,
            actuator,
            direction,
        }
    }

    /// Whether the drive link turns or slides.
    pub fn coordinate(&self) -> Coordinate {
        self.file.machine.mechanism().coordinate()
    }

    /// The machine at a position, with the loads of this direction.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn place(&self, phi: f64) -> Result<Place, Error> {
        self.place_now(&self.now(), phi)
    }

    /// The state of a motion in this direction.
    pub fn now(&self) -> ScheduleInstant {
        ScheduleInstant {
            omega: Some(self.direction),
            ..ScheduleInstant::default()
        }
    }

    /// The machine at a position at rest: loads of one direction do not act.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn place_at_rest(&self, phi: f64) -> Result<Place, Error> {
        let now = ScheduleInstant {
            omega: Some(0.0),
            ..ScheduleInstant::default()
        };
        self.place_now(&now, phi)
    }

    fn place_now(&self, now: &ScheduleInstant, phi: f64) -> Result<Place, Error> {
        let machine = self.file.machine_at(now, phi)?;
        machine.check_curves()?;
        let point: Reduction = machine.bare_reduction(phi)?;
        Ok(Place {
            phi,
            inertia: point.inertia,
            inertia_slope: point.inertia_slope * self.direction,
            load: -point.load_torque() * self.direction,
            viscous: point.viscous,
            coulomb: point.coulomb,
        })
    }

    /// The speed of the motor (rad/s) at a speed of the drive link.
    pub fn motor_speed(&self, speed: f64) -> f64 {
        speed * self.ratio.abs() * self.actuator.ratio
    }

    /// The motor torque required at a place, a speed (not negative) and an acceleration. At rest, friction is that of a starting motion.
    pub fn demand(&self, place: &Place, speed: f64, acceleration: f64) -> Demand {
        self.motor.demand(place.load(speed), acceleration, speed).0
    }

    /// Index of the power flow through the stages: where it changes, the demand bends.
    pub fn flow(&self, place: &Place, speed: f64, acceleration: f64) -> usize {
        self.motor.demand(place.load(speed), acceleration, speed).1
    }

    /// The motor torque that holds the machine at rest, without friction; positive if it acts in the direction of motion.
    pub fn holding(&self, place: &Place) -> f64 {
        let input = self.file.drive_train.input(&TrainOutput {
            torque: place.load,
            ..TrainOutput::default()
        });
        let torque = input.torque * self.ratio.signum();
        self.actuator
            .coefficients
            .torque(&[0.0, torque, 0.0, 0.0, 0.0])
    }

    /// The same at a position.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn holding_at(&self, phi: f64) -> Result<f64, Error> {
        Ok(self.holding(&self.place_at_rest(phi)?))
    }

    /// The torque required at the gearbox output, the input of the drive train; positive where it drives.
    pub fn gearbox_demand(&self, place: &Place, speed: f64, acceleration: f64) -> Demand {
        self.gearbox
            .demand(place.load(speed), acceleration, speed)
            .0
    }

    /// The acceleration by a motor torque: the inverse of [`demand`](Self::demand).
    pub fn acceleration(&self, place: &Place, speed: f64, torque: f64) -> f64 {
        self.motor.acceleration(place.load(speed), torque, speed)
    }

    /// The acceleration by a torque at the gearbox output.
    pub fn gearbox_acceleration(&self, place: &Place, speed: f64, torque: f64) -> f64 {
        self.gearbox.acceleration(place.load(speed), torque, speed)
    }

    /// Whether the motor torque bends where power changes direction.
    pub fn bends(&self) -> bool {
        !self.motor.is_lossless()
    }

    /// Least and largest acceleration that the motor can give at a place and speed; infinite without a limit.
    pub fn accelerations(&self, place: &Place, speed: f64) -> [f64; 2] {
        let limits = self.actuator.torques(self.motor_speed(speed));
        limits.map(|torque| {
            if torque.is_finite() {
                self.acceleration(place, speed, torque)
            } else {
                torque
            }
        })
    }
}

/// The machine with its drive in both directions, for a motion that turns back.
#[derive(Clone, Debug)]
pub struct BothDirections<'a>([PathDynamics<'a>; 2]);

impl<'a> BothDirections<'a> {
    /// The machine under a drive.
    pub fn new(file: &'a MachineFile, actuator: &Actuator) -> Self {
        Self([1.0, -1.0].map(|direction| PathDynamics::new(file, actuator.clone(), direction)))
    }

    /// The direction in which φ grows.
    pub const fn forwards(&self) -> &PathDynamics<'a> {
        &self.0[0]
    }

    /// The motor torque (N·m) of a state, positive towards growing φ; without speed and acceleration the holding torque. `heading` has the sign of
    /// the motion that contains the state: friction needs it at the start and end.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn torque(&self, state: &State<f64>, heading: f64) -> Result<f64, Error> {
        let State { phi, omega, alpha } = *state;
        let back = if omega == 0.0 { heading } else { omega } < 0.0;
        let dynamics = &self.0[usize::from(back)];
        if omega == 0.0 && alpha == 0.0 {
            return Ok(dynamics.holding(&dynamics.place_at_rest(phi)?));
        }
        let place = dynamics.place(phi)?;
        let demand = dynamics.demand(&place, omega.abs(), alpha * dynamics.direction);
        Ok(demand.torque * dynamics.direction)
    }
}
