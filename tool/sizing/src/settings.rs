//! Figures for the parameters of a servo drive, at the motor shaft.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::judge::Context;
use jred_analysis::duty::{Duty, Instant};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

/// A figure that a drive asks for, in SI.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Setting {
    /// Rotor with its brake (kg·m²).
    RotorInertia,
    /// Constant inertia of load and gearbox that gives the torque of acceleration best: ∫J·α² dt/∫α² dt, or the mean without acceleration (kg·m²).
    LoadInertia,
    /// Least inertia of load and gearbox over the cycle (kg·m²).
    LeastLoadInertia,
    /// Largest inertia of load and gearbox over the cycle (kg·m²).
    LargestLoadInertia,
    /// Rotor and [`Setting::LoadInertia`] (kg·m²).
    TotalInertia,
    /// [`Setting::LoadInertia`] over the rotor.
    InertiaRatio,
    /// S1 torque of the motor at its rated speed (N·m).
    RatedTorque,
    /// S1 torque of the motor at standstill (N·m).
    StandstillTorque,
    /// Torque limit of [`LimitedBy`]: the peak torque, and T2B/i of the gearbox unless the cycle takes more (N·m).
    TorqueLimit,
    /// Largest torque of the cycle (N·m).
    CyclePeakTorque,
    /// RMS torque of the cycle (N·m).
    CycleRmsTorque,
    /// Current at the rated torque (A RMS).
    RatedCurrent,
    /// Current at the torque at standstill (A RMS).
    StandstillCurrent,
    /// Largest current of the motor (A RMS).
    PeakCurrent,
    /// Torque constant (N·m/A RMS).
    TorqueConstant,
    /// Speed limit: the least of the largest speeds of motor and gearbox (rad/s).
    SpeedLimit,
    /// Largest speed of the cycle (rad/s).
    CyclePeakSpeed,
    /// Encoder counts in a turn of the motor.
    CountsPerTurn,
    /// Turns of the motor in [`Setting::ShaftTurns`] of a drive link that turns.
    MotorTurns,
    /// Turns of a drive link that turns.
    ShaftTurns,
    /// 1 if a positive speed of the motor is one of the drive link; -1 if the drive train reverses.
    Direction,
    /// Least position of the motor over the motion, from φ = 0 (counts).
    LeastPosition,
    /// Largest position of the motor over the motion, from φ = 0 (counts).
    LargestPosition,
    /// Mean torque against dry friction while moving, of motor, gearbox and machine, without losses by an efficiency (N·m).
    CoulombFriction,
    /// Viscous friction that takes the power of the cycle's: ∫b·ω² dt/∫ω² dt (N·m·s/rad).
    ViscousFriction,
    /// Mean torque against the weight over the cycle, without losses (N·m).
    WeightTorque,
    /// Bandwidth of the speed loop as asked for (Hz).
    Bandwidth,
    /// Proportional gain of the speed loop, 2π·f·J with the total inertia (N·m·s/rad).
    SpeedGain,
    /// Time until the holding brake is open (s).
    BrakeOpening,
    /// Time until the holding brake holds (s).
    BrakeClosing,
    /// Thermal time constant of the winding (s).
    WindingTime,
    /// Thermal time constant of the motor (s).
    MotorTime,
    /// Brake resistor (Ω).
    Resistance,
    /// Continuous power of the brake resistor (W).
    ResistorPower,
}

/// Choices of a person.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choices {
    /// Encoder counts in a turn of the motor.
    pub counts_per_turn: Option<f64>,
    /// Bandwidth of the speed loop (Hz).
    pub bandwidth: Option<f64>,
}

/// The part that sets [`Setting::TorqueLimit`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitedBy {
    /// The peak torque of motor and amplifier.
    Peak,
    /// T2B/i of the gearbox.
    Gearbox,
    /// The largest torque of the cycle, above T2B/i of the gearbox.
    Cycle,
}

/// The figures that are known.
#[derive(Clone, Debug)]
pub struct Settings {
    figures: Vec<(Setting, f64)>,
    /// The part that sets the torque limit.
    pub limited_by: LimitedBy,
    /// Whether the peak torque of motor and amplifier is known.
    pub peak_known: bool,
}

impl Settings {
    /// The figures of a drive with a rotary motor for this machine. Positions and torques have the sign of the motor.
    pub fn new(context: &Context, duty: &Duty, file: &MachineFile, choices: Choices) -> Self {
        let (drive, ratio) = (context.drive, context.ratio);
        let (motor, gearbox) = (drive.motor, drive.gearbox);
        let (winding, brake) = (&motor.winding, motor.brake.as_ref());
        // Negative if the train reverses; rad/m for a link that slides.
        let total = ratio * file.drive_train.ratio();
        let at_motor = |inertia: f64| {
            inertia / (ratio * ratio) + gearbox.map_or(0.0, |gearbox| gearbox.inertia)
        };
        let inertias = duty.figures(|i| i.input_inertia);
        let best = mean(duty, |i| i.input_inertia, |i| i.input_alpha.powi(2));
        let load = at_motor(best.unwrap_or(inertias.mean));
        let rotor = drive.rotor();
        let [dry, viscous, weight] = losses(duty);
        let cycle = context.cycle.motor_duty(&drive);
        let cycle_peak = cycle.torque.max.abs().max(cycle.torque.min.abs());
        let peak = context.motor.envelope.peak_torque(1.0, 0.0);
        let rate = context.cycle.mechanics().move_rate * 3600.0;
        let output = gearbox.and_then(|gearbox| gearbox.acceleration_torque(rate));
        let output = output.map(|torque| torque / ratio);
        let (limit, limited_by) = match output.map(|torque| (torque.max(cycle_peak), torque)) {
            Some((limit, torque)) if limit < peak && torque < limit => (limit, LimitedBy::Cycle),
            Some((limit, _)) if limit < peak => (limit, LimitedBy::Gearbox),
            _ => (peak, LimitedBy::Peak),
        };
        let speeds = [motor.max_speed, gearbox.and_then(|g| g.max_speed)];
        let positions = duty.figures(|i| i.phi * total);
        let counts = choices.counts_per_turn;
        let turns = (file.machine.mechanism().coordinate() == Coordinate::Angle)
            .then(|| fraction(total.abs()))
            .flatten();
        let given = context.site.supply.brake_resistor;
        let chosen = context.resistor();
        let resistor = (given.map(|r| [r.resistance, r.power]))
            .or_else(|| chosen.map(|r| [r.resistance, r.rated_power]));
        let counted = |angle: f64| counts.map(|counts| angle / std::f64::consts::TAU * counts);
        let figures = [
            (Setting::RotorInertia, Some(rotor)),
            (Setting::LoadInertia, Some(load)),
            (Setting::LeastLoadInertia, Some(at_motor(inertias.min))),
            (Setting::LargestLoadInertia, Some(at_motor(inertias.max))),
            (Setting::TotalInertia, Some(rotor + load)),
            (Setting::InertiaRatio, Some(load / rotor)),
            (Setting::RatedTorque, motor.rated_torque),
            (Setting::StandstillTorque, motor.standstill_torque),
            (Setting::TorqueLimit, Some(limit)),
            (Setting::CyclePeakTorque, Some(cycle_peak)),
            (Setting::CycleRmsTorque, Some(cycle.torque.rms)),
            (Setting::RatedCurrent, winding.rated_current),
            (Setting::StandstillCurrent, winding.standstill_current),
            (Setting::PeakCurrent, winding.peak_current),
            (Setting::TorqueConstant, winding.torque_constant),
            (
                Setting::SpeedLimit,
                speeds.into_iter().flatten().reduce(f64::min),
            ),
            (
                Setting::CyclePeakSpeed,
                Some(cycle.speed.max.abs().max(cycle.speed.min.abs())),
            ),
            (Setting::CountsPerTurn, counts),
            (Setting::MotorTurns, turns.map(|[motor, _]| motor)),
            (Setting::ShaftTurns, turns.map(|[_, shaft]| shaft)),
            (Setting::Direction, Some(total.signum())),
            (Setting::LeastPosition, counted(positions.min)),
            (Setting::LargestPosition, counted(positions.max)),
            (
                Setting::CoulombFriction,
                Some(
                    motor.friction[0]
                        + gearbox.map_or(0.0, |gearbox| gearbox.no_load_torque)
                        + dry / total.abs(),
                ),
            ),
            (
                Setting::ViscousFriction,
                Some(motor.friction[1] + viscous / (total * total)),
            ),
            (Setting::WeightTorque, Some(weight / total)),
            (Setting::Bandwidth, choices.bandwidth),
            (
                Setting::SpeedGain,
                choices
                    .bandwidth
                    .map(|f| std::f64::consts::TAU * f * (rotor + load)),
            ),
            (
                Setting::BrakeOpening,
                brake.and_then(|brake| brake.opening_time),
            ),
            (
                Setting::BrakeClosing,
                brake.and_then(|brake| brake.closing_time),
            ),
            (Setting::WindingTime, motor.thermal.winding_time),
            (Setting::MotorTime, motor.thermal.housing_time),
            (
                Setting::Resistance,
                resistor.map(|[resistance, _]| resistance),
            ),
            (Setting::ResistorPower, resistor.map(|[_, power]| power)),
        ];
        let known = figures.into_iter().filter_map(|(setting, figure)| {
            // An unknown limit is infinite.
            Some((setting, figure.filter(|value| value.is_finite())?))
        });
        Self {
            figures: known.collect(),
            limited_by,
            peak_known: peak.is_finite(),
        }
    }

    /// A figure; `None` if the data do not give it.
    pub fn get(&self, setting: Setting) -> Option<f64> {
        let found = self.figures.iter().find(|(known, _)| *known == setting);
        found.map(|(_, value)| *value)
    }
}

/// Mean of a figure with a weight over the cycle, if the weight is anywhere.
fn mean(
    duty: &Duty,
    of: impl Fn(&Instant) -> f64,
    weight: impl Fn(&Instant) -> f64,
) -> Option<f64> {
    let whole = duty.integral(&weight);
    (whole > 0.0).then(|| duty.integral(|i| of(i) * weight(i)) / whole)
}

/// Means at the drive link: dry friction while moving, viscous friction by its power, and the torque against the weight.
fn losses(duty: &Duty) -> [f64; 3] {
    let moving = |i: &Instant| f64::from(u8::from(i.omega != 0.0));
    let dry = mean(duty, |i| i.terms.coulomb.abs(), moving);
    let square = duty.integral(|i| i.omega.powi(2));
    let viscous = duty.integral(|i| i.terms.viscous * i.omega) / square;
    let viscous = if square > 0.0 { viscous } else { 0.0 };
    let weight = duty.integral(|i| i.terms.potential);
    // The mean over whole turns is zero up to rounding.
    let rounding = 1e-9 * duty.integral(|i| i.terms.potential.abs());
    let weight = if weight.abs() > rounding { weight } else { 0.0 };
    [dry.unwrap_or(0.0), viscous, weight / duty.duration]
}

/// The fraction with the least denominator, up to 10000, that equals a positive ratio up to rounding.
fn fraction(ratio: f64) -> Option<[f64; 2]> {
    let near = |below: &f64| {
        let above = (ratio * below).round();
        above >= 1.0 && (above / below - ratio).abs() <= 1e-12 * ratio
    };
    let below = (1..=10_000_u32).map(f64::from).find(near)?;
    Some([(ratio * below).round(), below])
}
