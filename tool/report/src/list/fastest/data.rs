//! The fastest motion as JSON.

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::Serialize;

use super::moves::{eased, greatest};
use super::{FastestView, of_fastest};
use crate::answer::schema::Data;
use crate::list::kept::{self, KeptPart};
use crate::list::rule_words::CheckData;
use jred_motion::fastest::Reserve;
use jred_motion::fastest::cycle::FastestMove;
use jred_motion::fastest::joint_force::JointForcePeak;
use jred_motion::fastest::ruled::{Cap, Judgement};

use super::WindingHeat;

impl Data for FastestData<'_> {
    const FORM: &'static str = "jred-fastest/1";
    const HAS_COURSE: bool = true;
}

/// The JSON of `jred fastest` (SI units; positions and speeds of the axis).
#[derive(Serialize, JsonSchema)]
pub(crate) struct FastestData<'a> {
    /// Name of the drive.
    drive: &'a str,
    /// The requested limits, option by option.
    asked: &'a [String],
    /// Duration of the motion (s).
    duration: f64,
    /// Duration of the motion of the file (s).
    duration_before: Option<f64>,
    /// Time at rest (s).
    at_rest: f64,
    /// Shares of the limits that the motion leaves unused.
    reserve: ReserveData,
    /// Load of the motor.
    motor: MotorData,
    /// Temperature of the winding, where it is limited.
    #[serde(skip_serializing_if = "Option::is_none")]
    winding: Option<WindingData>,
    /// Rules of sizing that judge the motion (`--reserve rules`).
    #[serde(skip_serializing_if = "Option::is_none")]
    rules: Option<RulesData>,
    /// Largest forces in the joints whose force is limited.
    joint_forces: Vec<ForceData<'a>>,
    /// A one-sided contact that the motion loses.
    contact_lost: Option<String>,
    /// Unit of positions: rad or m.
    unit: &'static str,
    /// The moves.
    moves: Vec<MoveData<'a>>,
    /// Parts of the file's motion that are kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<Vec<KeptPart>>,
}

#[derive(Serialize, JsonSchema)]
struct ReserveData {
    /// Of the motor torque.
    torque: f64,
    /// Of the motor speed.
    speed: f64,
    /// Of the gearbox torque.
    gearbox_torque: f64,
    /// Of the gearbox speed.
    gearbox_speed: f64,
    /// Of the S1 torque.
    s1_torque: f64,
}

/// Load of the motor (N·m and rad/s, or N and m/s).
#[derive(Serialize, JsonSchema)]
struct MotorData {
    /// RMS torque over the motion.
    rms_torque: f64,
    /// Largest torque.
    peak_torque: f64,
    /// Largest speed.
    peak_speed: f64,
    /// Mean of the speed's magnitude.
    mean_speed: f64,
    /// Torque that holds the machine at the end.
    holding_torque: f64,
    /// S1 torque at the mean speed; none: not known.
    s1_torque: Option<f64>,
    /// Allowed RMS torque, with the reserve.
    rms_allowed: Option<f64>,
    /// Time at rest that a repeated motion needs in addition (s); none: no pause is sufficient.
    pause_needed: Option<f64>,
}

/// Temperatures of the winding (°C) when the motion repeats.
#[derive(Serialize, JsonSchema)]
struct WindingData {
    /// Largest; none: it grows without bound.
    greatest: Option<f64>,
    /// Mean over the cycle.
    mean: Option<f64>,
    /// Largest minus mean (K).
    ripple: Option<f64>,
    /// Limit.
    limit: f64,
    /// Ambient temperature.
    ambient: f64,
    /// Whether the rise is estimated from the rated one.
    estimated: bool,
    /// Whether the temperature is followed within the cycle.
    ripple_followed: bool,
    /// Whether the limit restricts the motion.
    binds: bool,
    /// RMS torque that keeps the limit (N·m, or N).
    rms_torque: Option<f64>,
    /// Duration without the limit (s).
    duration_without: Option<f64>,
}

#[derive(Serialize, JsonSchema)]
struct RulesData {
    /// Rules that limit the search and are satisfied.
    kept: Vec<CheckData>,
    /// Rules that the motion violates.
    not_kept: Vec<CheckData>,
    /// Limits that were lowered for the rules.
    lowered: LoweredLimits,
}

#[derive(Default, Serialize, JsonSchema)]
#[serde(default)]
struct LoweredLimits {
    /// Share of the motor torque that the reserve leaves.
    #[serde(skip_serializing_if = "Option::is_none")]
    share_of_motor_torque: Option<f64>,
    /// Torque at the gearbox output (N·m).
    #[serde(skip_serializing_if = "Option::is_none")]
    gearbox_torque: Option<f64>,
    /// Speed of the motor (rad/s, or m/s).
    #[serde(skip_serializing_if = "Option::is_none")]
    motor_speed: Option<f64>,
    /// RMS torque (N·m, or N).
    #[serde(skip_serializing_if = "Option::is_none")]
    rms_torque: Option<f64>,
}

/// The largest force in a joint.
#[derive(Serialize, JsonSchema)]
struct ForceData<'a> {
    /// Name of the joint.
    joint: &'a str,
    /// Force (N).
    force: f64,
    /// Its limit (N).
    limit: f64,
    /// Position.
    at: f64,
    /// Time (s).
    time: f64,
    /// Whether the machine is at rest there.
    at_rest: bool,
}

/// A move.
#[derive(Serialize, JsonSchema)]
struct MoveData<'a> {
    /// Position at its start.
    from: f64,
    /// Position at its end.
    to: f64,
    /// Speed at its start.
    from_speed: f64,
    /// Speed at its end.
    to_speed: f64,
    /// Its time (s).
    time: f64,
    /// Its time in the file (s).
    time_before: Option<f64>,
    /// Estimated error of its time (s).
    error: f64,
    /// A lower bound of its time (s), without limits of jerk, torque rate and RMS torque.
    bound: Option<f64>,
    /// Share by which limits may be exceeded between nodes.
    excess: f64,
    /// Its phases, each at one limit.
    phases: Vec<PhaseData<'a>>,
    /// The time without each limit.
    costs: Vec<CostData<'a>>,
}

#[derive(Serialize, JsonSchema)]
struct PhaseData<'a> {
    /// The active limit.
    limit: Cow<'a, str>,
    /// Position at its start.
    from: f64,
    /// Position at its end.
    to: f64,
    /// Start (s).
    from_time: f64,
    /// End (s).
    to_time: f64,
    /// Speed at its start.
    from_speed: f64,
    /// Speed at its end.
    to_speed: f64,
    /// Largest speed in it.
    greatest_speed: f64,
}

#[derive(Serialize, JsonSchema)]
struct CostData<'a> {
    /// The limit.
    limit: Cow<'a, str>,
    /// The change of the limit, in words.
    eased: String,
    /// The time of the move with that change (s).
    time: f64,
}

impl FastestView<'_> {
    pub(super) fn data(&self) -> FastestData<'_> {
        let cycle = self.cycle;
        let load = &cycle.load;
        let known = Some(load.continuous).filter(|torque| torque.is_finite());
        let axis = self.file.axis();
        let Reserve {
            torque,
            speed,
            gearbox_torque,
            gearbox_speed,
            rms,
            ..
        } = self.reserve;
        let force = |force: &JointForcePeak| ForceData {
            joint: force.name(self.file),
            force: force.force,
            limit: force.limit,
            at: axis.position(force.phi),
            time: force.t,
            at_rest: force.stands,
        };
        FastestData {
            drive: self.drive,
            asked: &self.asked,
            duration: cycle.trace.duration(),
            duration_before: cycle.before,
            at_rest: cycle.dwells,
            reserve: ReserveData {
                torque,
                speed,
                gearbox_torque,
                gearbox_speed,
                s1_torque: rms,
            },
            motor: MotorData {
                rms_torque: load.rms,
                peak_torque: load.peaks[0],
                peak_speed: load.peaks[1],
                mean_speed: load.mean_speed,
                holding_torque: load.holding,
                s1_torque: known,
                rms_allowed: known.map(|_| load.allowed),
                pause_needed: load.pause,
            },
            winding: self.warmth.map(winding),
            rules: self.judged.map(rules),
            joint_forces: self.forces.iter().map(force).collect(),
            contact_lost: self.broken.map(|broken| of_fastest(broken, &axis)),
            unit: axis.coordinate.per(),
            moves: cycle.moves.iter().map(|made| self.one(made)).collect(),
            kept: self.chain.map(|chain| kept::parts(self.file, chain)),
        }
    }

    fn one(&self, made: &FastestMove) -> MoveData<'_> {
        let (axis, file) = (self.file.axis(), self.file);
        let phases = made.fastest.phases.iter().map(|phase| PhaseData {
            limit: phase.limit.name_in(file),
            from: axis.position(phase.phi[0]),
            to: axis.position(phase.phi[1]),
            from_time: phase.t[0],
            to_time: phase.t[1],
            from_speed: axis.rate(phase.speed[0]),
            to_speed: axis.rate(phase.speed[1]),
            greatest_speed: axis.rate(greatest(made, phase)),
        });
        let costs = made.costs.iter().map(|cost| CostData {
            limit: cost.limit.name_in(file),
            eased: eased(cost, file),
            time: cost.time,
        });
        MoveData {
            from: axis.position(made.task.from),
            to: axis.position(made.task.to),
            from_speed: axis.rate(made.task.speeds[0]),
            to_speed: axis.rate(made.task.speeds[1]),
            time: made.fastest.time,
            time_before: made.before,
            error: made.fastest.error,
            bound: made.fastest.bound,
            excess: made.fastest.excess,
            phases: phases.collect(),
            costs: costs.collect(),
        }
    }
}

fn winding(warmth: &WindingHeat) -> WindingData {
    let temperatures = &warmth.temperatures;
    WindingData {
        greatest: Some(temperatures.greatest).filter(|t| t.is_finite()),
        mean: temperatures.mean.map(|[mean, _]| mean),
        ripple: temperatures.mean.map(|[_, ripple]| ripple),
        limit: warmth.limit,
        ambient: warmth.ambient,
        estimated: temperatures.heating.relative,
        ripple_followed: temperatures.heating.ripple,
        binds: warmth.bound.is_some(),
        rms_torque: warmth.bound.map(|[_, rms]| rms),
        duration_without: warmth.bound.map(|[free, _]| free),
    }
}

fn rules(judged: &Judgement) -> RulesData {
    let mut lowered = LoweredLimits::default();
    for (cap, value) in &judged.caps {
        let place = match cap {
            Cap::MotorTorque => &mut lowered.share_of_motor_torque,
            Cap::GearboxTorque => &mut lowered.gearbox_torque,
            Cap::Speed => &mut lowered.motor_speed,
            Cap::RmsTorque => &mut lowered.rms_torque,
        };
        *place = Some(*value);
    }
    RulesData {
        kept: judged.kept().map(CheckData::from).collect(),
        not_kept: judged.violated().map(CheckData::from).collect(),
        lowered,
    }
}
