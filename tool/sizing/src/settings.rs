//! Figures for the parameters of a servo drive, at the motor shaft.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::catalogue::Drive;
use crate::judge::Context;
use crate::motor::winding::CurrentCurve;
use jred_analysis::duty::{Duty, Instant};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

/// A figure that a drive asks for.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Figure {
    /// The figure.
    pub setting: Setting,
    /// Its name.
    pub name: &'static str,
    /// Its value in SI; null if it is not given.
    pub value: Option<f64>,
    /// The unit for reading.
    #[serde(skip)]
    pub unit: Unit,
    /// Where to read a value that is not given, or the part that sets a limit.
    pub remark: String,
}

/// A unit, and a value in it over that in SI.
pub type Unit = (&'static str, f64);

const KG_CM2: Unit = ("kg cm^2", 1e4);
const RPM: Unit = ("rpm", 60.0 / TAU);
const MS: Unit = ("ms", 1e3);

const NAME_PLATE: &str = "read it from the motor's name plate";
const DATA_SHEET: &str = "read it from the motor's data sheet";
const DATA_SHEETS: &str = "read it from the data sheets of motor and gearbox";
const PEAK_TORQUE: &str = "read the peak torque from the data sheets of motor and amplifier";
const ENCODER: &str = "read it from the encoder's data sheet, and give --counts-per-turn";
const COUNTS_PER_TURN: &str = "give --counts-per-turn";
const TURNS: &str = "the drive link slides, or no fraction up to 10000 is exact: then count the teeth of the stages";
const BANDWIDTH: &str = "give --bandwidth";
const WEIGHT: &str = "left out; it changes its sign, so that a constant torque would harm as much as help; `jred export --format cia402` has the whole torque";
const TORQUE_CONSTANT: &str =
    "computed from other figures of the motor; that of the data sheet may be up to a fifth larger";
const BRAKE: &str = "read it from the motor's data sheet, if the motor has a brake";
const RESISTOR: &str = "read it from the amplifier's manual, if it has a brake resistor";

/// Choices of a person.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choices {
    /// Encoder counts in a turn of the motor.
    pub counts_per_turn: Option<f64>,
    /// Bandwidth of the speed loop (Hz).
    pub bandwidth: Option<f64>,
}

/// The figures of a drive with a rotary motor. Positions and torques have the sign of the motor.
#[derive(Clone, Debug)]
pub struct Settings(Vec<Figure>);

macro_rules! settings {
    ($context:ident, $duty:ident, $file:ident, $choices:ident, $limit:ident: { $($given:tt)* }
    $($(#[doc = $doc:literal])? $setting:ident $name:literal [$($si:literal $($shown:ident)?)?] $(or $cure:ident)? = $value:expr;)*) => {
        /// The word of a figure.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum Setting {
            $(#[doc = concat!($name $(, " (", $si, ")")? $(, ":", $doc)?)] $setting,)*
        }

        /// The figures; the remark of each is that of a value that is not given.
        fn figures($context: &Context, $duty: &Duty, $file: &MachineFile, $choices: Choices, $limit: f64) -> Vec<Figure> {
            $($given)*
            vec![$(Figure {
                setting: Setting::$setting,
                name: $name,
                value: $value,
                // The first unit that is given.
                unit: [$($($shown,)? ($si, 1.0),)? ("", 1.0)][0],
                remark: ["not given" $(, $cure)?].join("; "),
            },)*]
        }
    };
}

// Name, SI unit, another unit for reading, where to read it if it is not given, and value; before it what the name does not say.
settings! {
    context, duty, file, choices, limit: {
        let Drive { motor, gearbox, .. } = context.drive;
        let (winding, brake, rotor) = (&motor.winding, motor.brake.as_ref(), context.drive.rotor());
        let curve = CurrentCurve::of(motor);
        let inertias = duty.figures(|i| i.input_inertia);
        let best = mean(duty, |i| i.input_inertia, |i| i.input_alpha.powi(2)).unwrap_or(inertias.mean);
        let [load, least, largest] = [best, inertias.min, inertias.max].map(|inertia| {
            inertia / context.ratio.powi(2) + gearbox.map_or(0.0, |gearbox| gearbox.inertia)
        });
        // Negative if the train reverses; rad/m for a link that slides.
        let ratio = context.ratio * file.drive_train.ratio();
        let turns = (file.machine.mechanism().coordinate() == Coordinate::Angle)
            .then(|| fraction(ratio.abs()))
            .flatten();
        let ([dry, viscous], weight) = losses(duty);
        let dry = dry / ratio.abs() + gearbox.map_or(0.0, |gearbox| gearbox.no_load_torque);
        let cycle = context.cycle.motor_duty(&context.drive);
        let positions = duty.figures(|i| i.phi * ratio);
        let counted = |angle: f64| choices.counts_per_turn.map(|counts| angle / TAU * counts);
        let resistor = context.site.supply.brake_resistor.map(|r| [r.resistance, r.power]);
        let resistor = resistor.or_else(|| context.resistor().map(|r| [r.resistance, r.rated_power]));
    }
    RotorInertia "inertia of the rotor with its brake" ["kg m^2" KG_CM2] = Some(rotor);
    /// gives the torque of acceleration best, ∫J·α² dt/∫α² dt; the mean without acceleration
    LoadInertia "load inertia with gearbox, best constant value" ["kg m^2" KG_CM2] = Some(load);
    LeastLoadInertia "load inertia with gearbox, least" ["kg m^2" KG_CM2] = Some(least);
    LargestLoadInertia "load inertia with gearbox, largest" ["kg m^2" KG_CM2] = Some(largest);
    TotalInertia "total inertia, best constant value" ["kg m^2" KG_CM2] = Some(rotor + load);
    InertiaRatio "inertia ratio, load to rotor" [] = Some(load / rotor);
    RatedTorque "rated torque of the motor" ["N m"] or NAME_PLATE = motor.rated_torque;
    PeakTorque "peak torque of motor and amplifier" ["N m"] or PEAK_TORQUE = Some(context.motor.envelope.peak_torque(1.0, 0.0));
    StandstillTorque "S1 torque at standstill" ["N m"] or DATA_SHEET = motor.standstill_torque;
    /// the peak torque, and T2B/i of the gearbox unless the cycle takes more
    TorqueLimit "torque limit" ["N m"] or PEAK_TORQUE = Some(limit);
    CyclePeakTorque "largest torque of the cycle" ["N m"] = Some(cycle.torque.peak());
    CycleRmsTorque "RMS torque of the cycle" ["N m"] = Some(cycle.torque.rms);
    RatedCurrent "rated current of the motor" ["A RMS"] or NAME_PLATE = winding.rated_current;
    StandstillCurrent "current at standstill" ["A RMS"] or DATA_SHEET = winding.standstill_current;
    PeakCurrent "peak current of the motor" ["A RMS"] or DATA_SHEET = winding.peak_current;
    TorqueConstant "torque constant" ["N m/A RMS"] or DATA_SHEET = curve.map(|curve| curve.torque_constant());
    /// with the saturation of the iron
    CurrentLimit "current at the torque limit" ["A RMS"] or DATA_SHEET = curve.map(|curve| curve.current(limit));
    SpeedLimit "speed limit of motor and gearbox" ["rad/s" RPM] or DATA_SHEETS = speed_limit(context).0;
    CyclePeakSpeed "largest speed of the cycle" ["rad/s" RPM] = Some(cycle.speed.peak());
    CountsPerTurn "encoder counts in a turn of the motor" ["counts"] or ENCODER = choices.counts_per_turn;
    MotorTurns "gear ratio: turns of the motor" [] or TURNS = turns.map(|[motor, _]| motor);
    ShaftTurns "gear ratio: turns of the drive link" [] or TURNS = turns.map(|[_, shaft]| shaft);
    Direction "direction of the motor: 1 as the drive link, -1 against it" [] = Some(ratio.signum());
    LeastPosition "least position of the motion, from 0 of the machine file" ["counts"] or COUNTS_PER_TURN = counted(positions.min);
    LargestPosition "largest position of the motion, from 0 of the machine file" ["counts"] or COUNTS_PER_TURN = counted(positions.max);
    /// of motor, gearbox and machine, without losses by an efficiency
    CoulombFriction "dry friction, mean while moving" ["N m"] = Some(motor.friction[0] + dry);
    /// takes the power of that of the cycle, ∫b·ω² dt/∫ω² dt
    ViscousFriction "viscous friction" ["N m s/rad"] = Some(motor.friction[1] + viscous / ratio.powi(2));
    /// without losses; null if it changes its sign
    WeightTorque "torque against the weight, mean" ["N m"] = weight.map(|weight| weight / ratio);
    Bandwidth "bandwidth of the speed loop" ["Hz"] or BANDWIDTH = choices.bandwidth;
    /// with the total inertia
    SpeedGain "proportional gain of the speed loop, 2π·f·J" ["N m s/rad"] or BANDWIDTH = choices.bandwidth.map(|f| TAU * f * (rotor + load));
    IntegralTime "integral time of the speed loop, 4/(2π·f)" ["s" MS] or BANDWIDTH = choices.bandwidth.map(|f| 4.0 / (TAU * f));
    PositionGain "proportional gain of the position loop, 2π·f/4" ["1/s"] or BANDWIDTH = choices.bandwidth.map(|f| TAU * f / 4.0);
    BrakeOpening "opening time of the holding brake" ["s" MS] or BRAKE = brake.and_then(|brake| brake.opening_time);
    BrakeClosing "closing time of the holding brake" ["s" MS] or BRAKE = brake.and_then(|brake| brake.closing_time);
    WindingTime "thermal time constant of the winding" ["s"] or DATA_SHEET = motor.thermal.winding_time;
    MotorTime "thermal time constant of the motor" ["s"] or DATA_SHEET = motor.thermal.housing_time;
    Resistance "brake resistor" ["Ohm"] or RESISTOR = resistor.map(|[resistance, _]| resistance);
    ResistorPower "brake resistor, continuous power" ["W"] or RESISTOR = resistor.map(|[_, power]| power);
}

impl Settings {
    /// The figures of a drive for this machine.
    pub fn new(context: &Context, duty: &Duty, file: &MachineFile, choices: Choices) -> Self {
        let (limit, limited_by) = torque_limit(context);
        let mut figures = figures(context, duty, file, choices, limit);
        for figure in &mut figures {
            // An unknown limit is infinite.
            figure.value = figure.value.filter(|value| value.is_finite());
            figure.remark = match (figure.setting, figure.value) {
                (Setting::WeightTorque, None) => WEIGHT.to_owned(),
                (_, None) => continue,
                (Setting::TorqueLimit | Setting::CurrentLimit, _) => limited_by.clone(),
                (Setting::TorqueConstant, _)
                    if context.drive.motor.winding.torque_constant.is_none() =>
                {
                    TORQUE_CONSTANT.to_owned()
                }
                (Setting::SpeedLimit, _) => speed_limit(context).1.to_owned(),
                _ => String::new(),
            };
        }
        Self(figures)
    }

    /// All figures.
    pub fn figures(&self) -> &[Figure] {
        &self.0
    }

    /// The value of a figure in SI, and its remark; NaN and where to read it if the data do not give it.
    pub fn get(&self, setting: Setting) -> (f64, &str) {
        let found = self.0.iter().find(|figure| figure.setting == setting);
        found.map_or((f64::NAN, ""), |figure| {
            (figure.value.unwrap_or(f64::NAN), &figure.remark)
        })
    }
}

/// The largest torque that may be set, and the part that sets it.
fn torque_limit(context: &Context) -> (f64, String) {
    let peak = context.motor.envelope.peak_torque(1.0, 0.0);
    let cycle = context.cycle.motor_duty(&context.drive).torque.peak();
    let moves_per_hour = context.cycle.mechanics().move_rate * 3600.0;
    let gearbox = context.drive.gearbox;
    let gearbox = gearbox.and_then(|gearbox| gearbox.acceleration_torque(moves_per_hour));
    let gearbox = gearbox.map_or(f64::INFINITY, |torque| torque / context.ratio);
    let (limit, by) = if gearbox.max(cycle) >= peak {
        (peak, "peak torque of motor and amplifier")
    } else if cycle > gearbox {
        (
            cycle,
            "largest torque of the cycle, above T2B/i of the gearbox",
        )
    } else {
        (gearbox, "T2B/i of the gearbox")
    };
    let unknown = "; the peak torque of motor and amplifier is not given";
    let unknown = if peak.is_finite() { "" } else { unknown };
    (limit, format!("{by}{unknown}"))
}

/// The largest speed of the hardware, and the part that sets it.
fn speed_limit(context: &Context) -> (Option<f64>, &'static str) {
    let motor = context.drive.motor.max_speed;
    let gearbox = context.drive.gearbox.and_then(|gearbox| gearbox.max_speed);
    match gearbox {
        Some(speed) if motor.is_none_or(|motor| speed < motor) => {
            (gearbox, "limit of the gearbox, not of the machine")
        }
        _ => (motor, "limit of the motor, not of the machine"),
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

/// Means at the drive link: dry friction while moving, and viscous friction by its power; and the torque against the weight, if its sign is the same everywhere.
fn losses(duty: &Duty) -> ([f64; 2], Option<f64>) {
    let moving = |i: &Instant| f64::from(u8::from(i.omega != 0.0));
    let dry = mean(duty, |i| i.terms.coulomb.abs(), moving);
    let square = duty.integral(|i| i.omega.powi(2));
    let viscous = duty.integral(|i| i.terms.viscous * i.omega) / square;
    let viscous = if square > 0.0 { viscous } else { 0.0 };
    let weight = duty.figures(|i| i.terms.potential);
    // A balanced machine has a rest by rounding.
    let rounding = 1e-9 * duty.figures(|i| i.terms.total()).peak();
    let one_sign = weight.min >= -rounding || weight.max <= rounding;
    let weight = if weight.peak() > rounding {
        weight.mean
    } else {
        0.0
    };
    ([dry.unwrap_or(0.0), viscous], one_sign.then_some(weight))
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
