//! The accelerations that all limits allow at a place and speed, and the active limit.

use std::borrow::Cow;

use jred::error::Error;
use jred_file::model::machine::MachineFile;
use jred_sizing::catalogue::Drive;
use jred_sizing::select::fit::input_kind;

use super::joint_force::{JointForces, Spot};
pub use super::reserve::Reserve;
use super::sweep::Side;
use super::tool_speed::ToolSpeeds;
use super::track::PathPoint;
use crate::path_dynamics::{PathDynamics, Place};

/// Limits in addition to the motor's torque-speed curve (SI, at the drive link unless noted); `None`: no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MoveLimits {
    /// Largest speed (rad/s, or m/s).
    pub speed: Option<f64>,
    /// Largest speeds of the tool in parts of the path.
    pub tool: ToolSpeeds,
    /// Largest acceleration while the speed grows (rad/s², or m/s²).
    pub acceleration: Option<f64>,
    /// Largest deceleration.
    pub deceleration: Option<f64>,
    /// Largest torque of the gearbox output, in both directions (N·m).
    pub gearbox_torque: Option<f64>,
    /// Largest speed of the gearbox input (rad/s).
    pub gearbox_speed: Option<f64>,
    /// Largest forces in joints.
    pub forces: JointForces,
    /// Largest rate of the acceleration (rad/s³, or m/s³).
    pub jerk: Option<f64>,
    /// Largest rate of the motor torque (N·m/s).
    pub torque_rate: Option<f64>,
    /// Whether the acceleration is zero at both ends; only where jerk or torque rate is limited.
    pub level_ends: bool,
    /// Reserve of motor and gearbox that stays unused.
    pub reserve: Reserve,
}

impl MoveLimits {
    /// The limits of a drive's gearbox.
    pub fn of(drive: &Drive) -> Self {
        Self {
            gearbox_torque: drive.gearbox.and_then(|gearbox| gearbox.peak_torque),
            gearbox_speed: drive.gearbox.and_then(|gearbox| gearbox.max_speed),
            ..Self::default()
        }
    }

    /// Whether jerk or torque rate is limited.
    pub const fn has_rates(&self) -> bool {
        self.jerk.is_some() || self.torque_rate.is_some()
    }

    /// The same without limits of jerk and torque rate.
    #[must_use]
    pub const fn without_rates(self) -> Self {
        Self {
            jerk: None,
            torque_rate: None,
            level_ends: false,
            ..self
        }
    }

    /// The same without one of these limits; unchanged for a limit of the motor or of the whole cycle.
    #[must_use]
    pub(super) fn without(mut self, limit: Binding) -> Self {
        match limit {
            Binding::GearboxTorque => self.gearbox_torque = None,
            Binding::GearboxSpeed => self.gearbox_speed = None,
            Binding::Speed => self.speed = None,
            Binding::ToolSpeed => self.tool = ToolSpeeds::default(),
            Binding::Acceleration => self.acceleration = None,
            Binding::Deceleration => self.deceleration = None,
            Binding::JointForce(joint) => self.forces = self.forces.without(joint.into()),
            Binding::Jerk => self.jerk = None,
            Binding::TorqueRate => self.torque_rate = None,
            Binding::Driving
            | Binding::Braking
            | Binding::MotorSpeed
            | Binding::RmsTorque
            | Binding::WindingTemperature => {}
        }
        self.level_ends &= self.has_rates();
        self
    }

    /// The same limits with a reserve of motor and gearbox.
    #[must_use]
    pub fn with_reserve(self, reserve: Reserve) -> Self {
        let left = |limit: Option<f64>, share| limit.map(|limit| limit * reserve.leaves(share));
        Self {
            gearbox_torque: left(self.gearbox_torque, reserve.gearbox_torque),
            gearbox_speed: left(self.gearbox_speed, reserve.gearbox_speed),
            reserve,
            ..self
        }
    }
}

/// A limit that a motion can be at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// The motor's largest driving torque at its speed.
    Driving,
    /// The motor's largest braking torque.
    Braking,
    /// The motor's largest speed.
    MotorSpeed,
    /// The largest torque of the gearbox output.
    GearboxTorque,
    /// The largest speed of the gearbox input.
    GearboxSpeed,
    /// The largest speed of the drive link.
    Speed,
    /// The largest speed of the tool.
    ToolSpeed,
    /// The largest acceleration.
    Acceleration,
    /// The largest deceleration.
    Deceleration,
    /// The largest force in a joint, by its index.
    JointForce(u16),
    /// The largest rate of the acceleration.
    Jerk,
    /// The largest rate of the motor torque.
    TorqueRate,
    /// The RMS torque of the motor.
    RmsTorque,
    /// The temperature of the motor's winding.
    WindingTemperature,
}

impl Binding {
    /// Name of the limit.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Driving => "motor torque (driving)",
            Self::Braking => "motor torque (braking)",
            Self::MotorSpeed => "motor speed",
            Self::GearboxTorque => "gearbox torque",
            Self::GearboxSpeed => "gearbox speed",
            Self::Speed => "speed limit",
            Self::ToolSpeed => "tool speed limit",
            Self::Acceleration => "acceleration limit",
            Self::Deceleration => "deceleration limit",
            Self::JointForce(_) => "joint force limit",
            Self::Jerk => "jerk limit",
            Self::TorqueRate => "torque rate limit",
            Self::RmsTorque => "RMS torque limit",
            Self::WindingTemperature => "winding temperature",
        }
    }

    /// Name in a machine: with the name of the joint, and with force instead of torque for a linear motor.
    pub fn name_in(self, file: &MachineFile) -> Cow<'static, str> {
        let names = file.machine.mechanism().joint_names();
        match self {
            Self::JointForce(joint) if usize::from(joint) < names.len() => {
                Cow::Owned(format!("force in {}", names[usize::from(joint)]))
            }
            // A gearbox always turns.
            Self::GearboxTorque => Cow::Borrowed(self.name()),
            _ => input_kind(file).vocabulary().effort_in(self.name()),
        }
    }
}

/// The accelerations that limits leave.
#[derive(Clone, Debug)]
pub struct Field<'w, 'a> {
    /// Machine and drive.
    pub dynamics: &'w PathDynamics<'a>,
    /// The other limits.
    pub limits: MoveLimits,
}

/// The speed at z = ½·v².
pub fn speed(z: f64) -> f64 {
    (2.0 * z).max(0.0).sqrt()
}

impl Field<'_, '_> {
    /// Whether limits may leave no acceleration at a place and speed: limits of different kinds can conflict.
    pub fn may_be_empty(&self) -> bool {
        let MoveLimits {
            acceleration,
            deceleration,
            gearbox_torque,
            forces,
            ..
        } = &self.limits;
        acceleration.is_some()
            || deceleration.is_some()
            || gearbox_torque.is_some()
            || forces.is_some()
    }

    /// The speed limits. Where two are equal, the first one is reported.
    pub fn speeds(&self) -> impl Iterator<Item = (f64, Binding)> {
        let per_speed = self.dynamics.motor_speed(1.0);
        let limits = &self.limits;
        [
            (Some(self.motor_end() / per_speed), Binding::MotorSpeed),
            (
                limits.gearbox_speed.map(|speed| speed / per_speed),
                Binding::GearboxSpeed,
            ),
            (limits.speed, Binding::Speed),
        ]
        .into_iter()
        .filter_map(|(speed, which)| Some((speed?, which)))
    }

    /// The speed of the drive link at the tool's speed limit at a position; infinite where the tool is not limited.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn tool_speed(&self, phi: f64) -> Result<f64, Error> {
        self.limits
            .tool
            .at(self.dynamics.file.machine.mechanism(), phi)
    }

    /// The lowest speed limit, and which one it is.
    pub fn top(&self) -> (f64, Binding) {
        let first = (f64::INFINITY, Binding::MotorSpeed);
        self.speeds().fold(
            first,
            |least, own| if own.0 < least.0 { own } else { least },
        )
    }

    pub(super) fn motor_end(&self) -> f64 {
        let envelope = &self.dynamics.actuator.envelope;
        let ends = [false, true].map(|braking| envelope.limit(braking).end());
        let reserve = &self.limits.reserve;
        let most = envelope.max_speed() * reserve.leaves(reserve.speed);
        most.min(ends[0]).min(ends[1])
    }

    /// The motor's torque at a speed of the drive link. The speed is clamped, so that rounding does not step beyond the largest one.
    fn motor_torque(&self, v: f64, braking: bool) -> f64 {
        let limit = self.dynamics.actuator.envelope.limit(braking);
        let reserve = &self.limits.reserve;
        let torque = limit.torque(self.dynamics.motor_speed(v).min(limit.end()));
        let torque = torque * reserve.leaves(reserve.torque);
        if braking { -torque } else { torque }
    }

    /// Least and largest torque of the motor at a speed of the drive link: −braking, driving.
    pub fn motor_torques(&self, v: f64) -> [f64; 2] {
        [true, false].map(|braking| self.motor_torque(v, braking))
    }

    /// For the start of a motion at rest: the torque that keeps the machine moving, and the torque that the limit gives, both at the shaft of the
    /// limit.
    pub fn needed_and_given(&self, place: &Place, limit: Binding, braking: bool) -> [f64; 2] {
        if limit == Binding::GearboxTorque {
            let given = self.limits.gearbox_torque.unwrap_or(f64::INFINITY);
            let needed = self.dynamics.gearbox_demand(place, 0.0, 0.0).torque;
            return [needed, if braking { -given } else { given }];
        }
        let needed = self.dynamics.demand(place, 0.0, 0.0).torque;
        [needed, self.motor_torque(0.0, braking)]
    }

    /// The largest or the least acceleration at a place and z = ½·v².
    pub fn side(&self, side: Side, place: &Spot, z: f64) -> f64 {
        self.side_by(side, place, z).0
    }

    /// The same, with the active limit.
    pub fn side_by(&self, side: Side, place: &Spot, z: f64) -> (f64, Binding) {
        match side {
            Side::Most => self.most_by(place, z),
            Side::Least => self.least_by(place, z),
        }
    }

    /// The same, with an identifier of the smooth part at a place and z: the active limit, the piece of the torque-speed limit, and the direction of
    /// power through the drive train.
    pub fn side_part(&self, side: Side, place: &Spot, z: f64) -> (f64, u32) {
        let (a, limit) = self.side_by(side, place, z);
        (a, self.part(place, z, a, limit))
    }

    /// Whether limits leave an acceleration at a place and z.
    pub fn is_open(&self, place: &Spot, z: f64) -> bool {
        self.least_by(place, z).0 <= self.most_by(place, z).0
    }

    /// The largest acceleration at a place and z, with the active limit.
    pub fn most_by(&self, place: &Spot, z: f64) -> (f64, Binding) {
        let v = speed(z);
        let torque = self.motor_torque(v, false);
        let mut most = (
            self.dynamics.acceleration(place, v, torque),
            Binding::Driving,
        );
        if let Some(torque) = self.limits.gearbox_torque {
            let a = self.dynamics.gearbox_acceleration(place, v, torque);
            most = lower(most, (a, Binding::GearboxTorque));
        }
        if let Some(a) = self.limits.acceleration {
            most = lower(most, (a, Binding::Acceleration));
        }
        for (joint, [_, a]) in place.intervals(z) {
            most = lower(most, (a, Binding::JointForce(joint as u16)));
        }
        most
    }

    /// The least acceleration at a place and z, with the active limit.
    pub fn least_by(&self, place: &Spot, z: f64) -> (f64, Binding) {
        let v = speed(z);
        let torque = self.motor_torque(v, true);
        let mut least = (
            self.dynamics.acceleration(place, v, torque),
            Binding::Braking,
        );
        if let Some(torque) = self.limits.gearbox_torque {
            let a = self.dynamics.gearbox_acceleration(place, v, -torque);
            least = higher(least, (a, Binding::GearboxTorque));
        }
        if let Some(a) = self.limits.deceleration {
            least = higher(least, (-a, Binding::Deceleration));
        }
        for (joint, [a, _]) in place.intervals(z) {
            least = higher(least, (a, Binding::JointForce(joint as u16)));
        }
        least
    }

    /// The largest share by which a state (speed and acceleration along the path) exceeds a limit, and which limit; negative if it exceeds none.
    /// Torques are measured by the motor's torque at rest, because the limit itself may be zero.
    pub fn excess_by(&self, seen: &PathPoint, v: f64, acceleration: f64) -> (f64, Binding) {
        let dynamics = self.dynamics;
        let place = &seen.place;
        let limits = self.motor_torques(v);
        let scale = self.motor_torques(0.0).map(f64::abs);
        let torque = dynamics.demand(place, v, acceleration).torque;
        let (top, which) = self.top();
        let share = |value: f64, limit: Option<f64>| {
            limit.map_or(f64::NEG_INFINITY, |limit| value / limit - 1.0)
        };
        let gearbox = self.limits.gearbox_torque;
        let gearbox = share(
            gearbox.map_or(0.0, |_| {
                dynamics.gearbox_demand(place, v, acceleration).torque.abs()
            }),
            gearbox,
        );
        let MoveLimits {
            acceleration: most,
            deceleration,
            ..
        } = self.limits;
        let all = [
            ((torque - limits[1]) / scale[1], Binding::Driving),
            ((limits[0] - torque) / scale[0], Binding::Braking),
            (v / top - 1.0, which),
            (v / seen.tool - 1.0, Binding::ToolSpeed),
            (gearbox, Binding::GearboxTorque),
            (share(acceleration, most), Binding::Acceleration),
            (share(-acceleration, deceleration), Binding::Deceleration),
        ];
        let forces = seen.forces.iter().map(|force| {
            let share = force.at(v, acceleration) / force.limit - 1.0;
            (share, Binding::JointForce(force.joint as u16))
        });
        let first = (f64::NEG_INFINITY, Binding::Driving);
        all.into_iter().chain(forces).fold(first, higher)
    }

    fn part(&self, place: &Place, z: f64, a: f64, limit: Binding) -> u32 {
        let v = speed(z);
        let piece = |braking: bool| {
            let pieces = self.dynamics.actuator.envelope.limit(braking).pieces();
            if pieces.len() < 2 {
                return 0;
            }
            let speed = self.dynamics.motor_speed(v);
            pieces.iter().take_while(|piece| piece.to < speed).count()
        };
        let (kind, which) = match limit {
            Binding::Driving => (0, piece(false)),
            Binding::Braking => (0, piece(true)),
            Binding::GearboxTorque => (1, 0),
            Binding::JointForce(joint) => (2, joint.into()),
            _ => (3, 0),
        };
        let flow = self.dynamics.flow(place, v, a) as u32;
        kind | (which as u32 & 0xff) << 4 | flow << 12
    }
}

fn lower(one: (f64, Binding), other: (f64, Binding)) -> (f64, Binding) {
    if other.0 < one.0 { other } else { one }
}

fn higher(one: (f64, Binding), other: (f64, Binding)) -> (f64, Binding) {
    if other.0 > one.0 { other } else { one }
}
