//! A simulated motion as JSON.

use schemars::JsonSchema;
use serde::Serialize;

use super::{SimulationView, problem};
use crate::answer::schema::Data;
use jred_analysis::simulate::{Impacts, Rest, Stop};
use jred_file::model::axis::Axis;
use jred_motion::drive_simulation::{Loads, Peak};

impl Data for SimulationData<'_> {
    const FORM: &'static str = "jred-simulate/1";
    const HAS_COURSE: bool = true;
}

/// The JSON of `jred simulate` (SI units; positions and distances of the axis in rad or m).
#[derive(Serialize, JsonSchema)]
pub(crate) struct SimulationData<'a> {
    /// Unit of positions: rad or m.
    unit: &'static str,
    /// Loads, payloads and carriages that follow the clock of the motion.
    by_motion: Vec<String>,
    /// Impacts on end stops.
    impacts: Option<ImpactData>,
    /// Rest after the motor was switched off.
    rest: Option<TravelData>,
    /// The first standstill after the motor was switched off, if nothing held the machine there.
    turned_back: Option<TravelData>,
    /// Stops at instants over a cycle.
    stops_over_the_cycle: Option<Vec<StopData>>,
    /// Rest in which friction holds the machine to the end.
    held: Option<TravelData>,
    /// The time and distance to the requested speed.
    reached: Option<TravelData>,
    /// Largest values of the motor until it is switched off.
    motor: Option<MotorData>,
    /// The place where the motor cannot drive the machine on.
    stops: Option<StandstillData>,
    /// Time at the limit of the motor torque.
    torque_limit: Option<LimitData>,
    /// The largest following error.
    following_error: Option<FollowingData>,
    /// Loads of the drive of the catalogue.
    drive: Option<DriveData<'a>>,
    /// Why the simulation ended before its time.
    ended: Option<String>,
}

/// Time (s) and distance (rad, or m) since the start, or since the motor was switched off.
#[derive(Serialize, JsonSchema)]
struct TravelData {
    /// Time (s).
    time: f64,
    /// Distance (rad, or m).
    way: f64,
}

#[derive(Serialize, JsonSchema)]
struct ImpactData {
    /// Number of impacts.
    count: u32,
    /// Time of the first (s).
    time: f64,
    /// Its position.
    position: f64,
    /// Its speed.
    speed: f64,
}

#[derive(Serialize, JsonSchema)]
struct StopData {
    /// Instant at which the motor is switched off (s).
    time: f64,
    /// Position at that instant.
    position: f64,
    /// Distance and time to rest; none: still in motion at the end.
    rest: Option<TravelData>,
}

/// A largest value (SI units).
#[derive(Serialize, JsonSchema)]
struct PeakData {
    /// The value.
    value: f64,
    /// Its time (s).
    time: f64,
}

impl From<[f64; 2]> for PeakData {
    fn from([value, time]: [f64; 2]) -> Self {
        Self { value, time }
    }
}

#[derive(Serialize, JsonSchema)]
struct MotorData {
    /// Largest torque (N·m), or force (N).
    torque: PeakData,
    /// RMS torque (N·m), or force (N).
    rms_torque: f64,
    /// Largest power (W).
    power: PeakData,
    /// Largest speed (rad/s, or m/s).
    speed: PeakData,
}

#[derive(Serialize, JsonSchema)]
struct StandstillData {
    /// Time (s).
    time: f64,
    /// Position.
    position: f64,
    /// Torque of the motor at rest (N·m), or force (N).
    given: f64,
    /// Torque that would be needed (N·m), or force (N).
    needed: f64,
}

#[derive(Serialize, JsonSchema)]
struct LimitData {
    /// Number of times.
    count: u32,
    /// Time in all (s).
    duration: f64,
    /// The first time (s).
    time: f64,
    /// Position at that time.
    position: f64,
}

#[derive(Serialize, JsonSchema)]
struct FollowingData {
    /// The error (rad, or m).
    error: f64,
    /// Its time (s).
    time: f64,
    /// Its position.
    position: f64,
}

#[derive(Serialize, JsonSchema)]
struct DriveData<'a> {
    /// Name of the drive.
    name: &'a str,
    /// Speed of the motor (rad/s, or m/s), against the largest input speed of the gearbox.
    motor_speed: LoadData,
    /// Torque at the gearbox output (N·m), against its acceleration torque.
    gearbox_torque: Option<LoadData>,
    /// Temperature rise of the winding above the surroundings (K), or as a share of the rated rise.
    rise: Option<LoadData>,
    /// Whether the rise is a share of the rated rise.
    rise_is_share: bool,
}

/// A largest value against its limit.
#[derive(Serialize, JsonSchema)]
struct LoadData {
    /// The value.
    value: f64,
    /// Its limit.
    allowed: Option<f64>,
    /// Its time (s).
    time: f64,
    /// Its position.
    position: f64,
}

impl SimulationView<'_> {
    pub(super) fn data(&self) -> SimulationData<'_> {
        let found = self.found;
        let axis = &self.machines.first.axis();
        let position = |phi: f64| axis.position(phi);
        let moved = |rest: Rest| TravelData {
            time: rest.time,
            way: axis.distance(rest.way),
        };
        let stop = |stop: &Stop| StopData {
            time: stop.time,
            position: position(stop.position),
            rest: stop.rest.map(moved),
        };
        SimulationData {
            unit: axis.coordinate.per(),
            by_motion: self.by_motion(),
            impacts: found.impacts.map(|first: Impacts| ImpactData {
                count: first.count,
                time: first.time,
                position: position(first.position),
                speed: axis.rate(first.speed),
            }),
            rest: found.rest.map(moved),
            turned_back: found.turned_back.map(moved),
            stops_over_the_cycle: self.stops.map(|stops| stops.iter().map(stop).collect()),
            held: found.held.map(moved),
            reached: found.reached.map(moved),
            motor: found.effort.map(|effort| MotorData {
                torque: effort.torque.into(),
                rms_torque: effort.rms,
                power: effort.power.into(),
                speed: effort.speed.into(),
            }),
            stops: found.missing.map(|stuck| StandstillData {
                time: stuck.time,
                position: position(stuck.missing.phi),
                given: stuck.missing.given,
                needed: stuck.missing.needed,
            }),
            torque_limit: found.torque_limit.map(|limit| LimitData {
                count: limit.count,
                duration: limit.duration,
                time: limit.time,
                position: position(limit.position),
            }),
            following_error: found.following.map(|following| FollowingData {
                error: axis.distance(following.error),
                time: following.time,
                position: position(following.position),
            }),
            drive: self.drive.map(|(name, loads)| drive(axis, name, loads)),
            ended: found.ended.as_ref().map(|why| problem(why).to_string()),
        }
    }
}

fn drive<'a>(axis: &Axis, name: &'a str, loads: &Loads) -> DriveData<'a> {
    let loaded = |peak: &Peak| LoadData {
        value: peak.value,
        allowed: peak.allowed,
        time: peak.time,
        position: axis.position(peak.phi),
    };
    DriveData {
        name,
        motor_speed: loaded(&loads.motor_speed),
        gearbox_torque: loads.gearbox_torque.as_ref().map(loaded),
        rise: loads.heat.as_ref().map(|heat| loaded(&heat.hottest)),
        rise_is_share: loads.heat.is_some_and(|heat| heat.relative),
    }
}
