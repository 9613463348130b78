//! Grounds of a check: the data that its description needs besides rule and finding.

use crate::bus::Need;
use crate::bus::curve::StopPower;
use crate::bus::need::Misses;
use crate::catalogue::{RatedBusVoltage, SiteRating};
use crate::thermal::Heating;
use crate::thermal::classify::DutyType;
use jred_file::model::operation::Duty;
use jred_file::model::rules::InertiaOf;
use jred_file::model::surroundings::Surroundings;
use jred_file::units::Sentence;

/// Grounds of a check.
#[derive(Clone, Debug)]
pub enum Grounds {
    /// Rule and finding say all.
    None,
    /// Name of the missing figure.
    Missing(&'static str),
    /// The gearbox is self-locking.
    SelfLocking,
    /// A motor that holds the machine at rest.
    Holding {
        /// The longest process load in a dwell (s) that is not judged as permanent.
        dwell: Option<f64>,
        /// Time (s) from which a load is permanent: the time constant of the winding.
        time: f64,
        /// Whether the catalogue gives that time.
        given: bool,
    },
    /// Speed (rad/s or m/s) where the cycle comes closest to the envelope.
    PeakAt(f64),
    /// The inertia ratio that is judged.
    InertiaRatio {
        /// The λ of the cycle.
        of: InertiaOf,
        /// Moves per minute, if its limit depends on them.
        moves: Option<f64>,
    },
    /// A stop by the brake alone, which closes late.
    BrakeStop {
        /// Ways (m or rad) of the tool, or of the drive link: until the brake closes, and until the machine stops.
        ways: [f64; 2],
        /// Whether they are lengths.
        slides: bool,
        /// Name of the tool.
        tool: Option<String>,
        /// Whether the brake's dynamic torque is given; otherwise the static one is used.
        dynamic: bool,
        /// Stops per hour that the brake bears.
        per_hour: Option<f64>,
        /// Stops per hour of the machine file.
        stops: Option<f64>,
    },
    /// Ratings at the site.
    Site {
        /// Of the motor.
        motor: SiteRating,
        /// Of the amplifier.
        amplifier: Option<SiteRating>,
        /// Whether the temperature in the cabinet is given.
        cabinet: bool,
    },
    /// The torque limit of the gearbox is reduced for frequent cycles.
    ShockFactor {
        /// The maker's factor.
        factor: f64,
        /// Cycles per hour.
        cycles: f64,
    },
    /// The maker gives shock factors.
    ShockFactors,
    /// The mean torque has the exponent 10/3.
    RollerBearing,
    /// The motor brakes with its peak torque in an emergency stop, where the machine has this inertia (kg·m²) at the gearbox.
    EmergencyAt(f64),
    /// The data for no thermal model are complete.
    NoHeat(Sentence),
    /// Temperatures of the motor.
    Heat {
        /// The temperatures.
        heating: Heating,
        /// Surroundings of the motor.
        surroundings: Surroundings,
        /// Operation of the machine.
        duty: Duty,
        /// Duty type of the cycle.
        found: DutyType,
    },
    /// The voltage that a part is made for.
    Voltage {
        /// Key of the part.
        part: String,
        /// The voltage; `None`: not stated.
        made_for: Option<RatedBusVoltage>,
        /// The supply.
        supply: SupplySource,
    },
    /// Stiffness between motor and machine.
    Stiffness {
        /// Natural frequency (Hz) with a free rotor; `None` without data.
        free: Option<f64>,
        /// Whether there is a gearbox.
        geared: bool,
        /// Whether the machine file gives the stiffness of the shafts.
        shafts: bool,
    },
    /// Backlash at a tool.
    Backlash {
        /// Its name.
        tool: String,
        /// Whether it turns.
        turns: bool,
        /// Whether the backlash of the drive train is given.
        train: bool,
    },
    /// The element of the drive train or of the mechanism that uses most of its limit.
    Element {
        /// Its name.
        name: String,
        /// Its largest force (N).
        force: f64,
    },
    /// Name of the element on the output shaft of the gearbox.
    OnShaft(String),
    /// No amplifier is chosen.
    NoAmplifier,
    /// The current of the motor is the limit.
    MotorCurrent,
    /// The current of the amplifier is the limit, reduced by this factor at the site.
    AmplifierCurrent(f64),
    /// Energy on the DC bus.
    Bus {
        /// Name of the missing figure.
        missing: Option<&'static str>,
        /// Energy fed back per cycle (J).
        back: f64,
        /// Power fed back in a stop by the drive, if that is judged.
        stop: Option<StopPower>,
        /// Whether a brake resistor or the supply takes it.
        taken: bool,
        /// Voltage (V) at which a brake resistor switches on.
        chopper_voltage: Option<f64>,
        /// The brake resistor that would take it.
        need: Option<Need>,
        /// Why no resistor of the catalogue does, if it has any.
        misses: Option<Misses>,
    },
    /// Key of the brake resistor that was chosen from the catalogue.
    ChosenResistor(String),
}

/// Where the voltage of the supply comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SupplySource {
    /// The mains voltage of the machine file (V).
    Mains(f64),
    /// The bus voltage of the machine file.
    Bus,
    /// The mains voltage of the amplifier (V).
    AmplifierMains(f64),
    /// The bus voltage of the amplifier.
    AmplifierBus,
}
