//! The sizing rules: the value that each checks, and the sense of its limit.

use serde::Serialize;

use crate::units::Vocabulary;

/// One table for all rules: its doc, its variant, its name in reports (and for a linear motor), its key in `[rules]`.
macro_rules! rules {
    ($($(#[$doc:meta])+ $rule:ident, $name:literal $(/ $linear:literal)?, $key:literal;)+) => {
        /// One rule. A rule compares a figure of the duty with a share of a rating.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, schemars::JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum Rule {
            $($(#[$doc])+ $rule,)+
        }

        impl Rule {
            /// All rules, in the order of reports.
            pub const ALL: [Self; [$(Self::$rule),+].len()] = [$(Self::$rule),+];

            /// Its name in reports.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$rule => $name,)+
                }
            }

            /// Its name in reports about a kind of motor: "RMS torque" or "RMS force".
            pub const fn named(self, words: &Vocabulary) -> &'static str {
                match self {
                    $($(Self::$rule if words.slides() => $linear,)?)+
                    _ => self.name(),
                }
            }

            /// Its key in `[rules]` and in rule sets.
            pub const fn key(self) -> &'static str {
                match self {
                    $(Self::$rule => $key,)+
                }
            }

            /// The key of its warning limit.
            pub const fn warning_key(self) -> &'static str {
                match self {
                    $(Self::$rule => concat!($key, "_warning"),)+
                }
            }
        }
    };
}

rules! {
    /// RMS torque against the S1 torque at mean speed.
    RmsTorque, "RMS torque" / "RMS force", "rms_torque";
    /// Torque against the torque-speed envelope, at the instant that comes closest.
    PeakTorque, "peak torque" / "peak force", "peak_torque";
    /// Largest speed against the motor's largest speed.
    Speed, "speed", "speed";
    /// Holding torque at rest against the standstill torque.
    HoldingTorque, "holding torque" / "holding force", "gravity_hold";
    /// Torque of weight and friction, without acceleration and process loads, against the standstill torque.
    ConstantTorque, "constant torque" / "constant force", "constant_torque";
    /// Holding torque at rest against the motor's brake.
    BrakeTorque, "brake torque" / "brake force", "brake_torque";
    /// Work of the motor's brake in a stop without supply against its allowed work.
    BrakeWork, "brake work", "brake_work";
    /// Inertia ratio λ.
    InertiaRatio, "inertia ratio" / "mass ratio", "inertia_ratio";
    /// Hottest point of the winding over the cycle, as a rise above the ambient temperature.
    WindingTemperature, "winding temperature", "winding_temperature";
    /// Hottest point of the housing, as a rise above the ambient temperature.
    HousingTemperature, "housing temperature", "housing_temperature";
    /// Ambient temperature of the motor against the end of its derating.
    AmbientTemperature, "ambient temperature", "ambient_temperature";
    /// Ambient temperature of the amplifier against the end of its derating.
    CabinetTemperature, "cabinet temperature", "cabinet_temperature";
    /// Altitude against the end of the derating of motor and amplifier.
    Altitude, "altitude", "altitude";
    /// Largest torque at the gearbox output against T2B.
    GearboxPeak, "gearbox peak torque", "gearbox_peak";
    /// Root-mean-cube torque at the gearbox output against T2N.
    GearboxCubicMean, "gearbox cubic-mean torque", "gearbox_rated";
    /// Torque at the gearbox output in an emergency stop against T2Not.
    GearboxEmergency, "gearbox emergency torque", "gearbox_emergency";
    /// Mean input speed of the gearbox against n1N.
    GearboxMeanSpeed, "gearbox mean speed", "gearbox_mean_speed";
    /// Largest input speed of the gearbox.
    GearboxSpeed, "gearbox largest speed", "gearbox_speed";
    /// Cycles per hour of the gearbox.
    GearboxCycles, "gearbox cycles", "gearbox_cycles";
    /// Radial load of the gearbox's output shaft.
    GearboxRadial, "gearbox radial load", "gearbox_radial";
    /// Axial load of the gearbox's output shaft.
    GearboxAxial, "gearbox axial load", "gearbox_axial";
    /// Force of a belt's tight strand: pretension and its share of the effective force.
    BeltTension, "belt tension", "belt_tension";
    /// Effective force of a belt against that of its teeth in mesh.
    BeltForce, "belt effective force", "belt_force";
    /// The slack strand's share of a belt's effective force against its pretension: above it one strand is slack.
    BeltPretension, "belt pretension", "belt_pretension";
    /// Axial force of a screw.
    ScrewForce, "screw force", "screw_force";
    /// Axial force of a screw against Euler's buckling force.
    ScrewBuckling, "screw buckling", "screw_buckling";
    /// Largest speed of a screw against its critical speed.
    ScrewSpeed, "screw critical speed", "screw_speed";
    /// Tangential force of a pinion.
    PinionForce, "pinion force", "pinion_force";
    /// RMS current against the amplifier's rated current.
    RmsCurrent, "RMS current", "rms_current";
    /// Largest current against the amplifier's peak current.
    PeakCurrent, "peak current", "peak_current";
    /// Overload integral I²t of the amplifier.
    Overload, "amplifier overload", "overload";
    /// Voltage of the supply against the largest that the motor is made for.
    MotorVoltage, "motor voltage", "motor_voltage";
    /// Voltage of the supply against the largest that the amplifier is made for.
    AmplifierVoltage, "amplifier voltage", "amplifier_voltage";
    /// Highest voltage of the DC bus over the cycle.
    BusVoltage, "bus voltage", "bus_voltage";
    /// Resistance of the brake resistor against the smallest that the chopper may switch.
    BrakeResistance, "brake resistance", "brake_resistance";
    /// Mean power of the brake resistor.
    ResistorPower, "brake resistor mean power", "resistor_power";
    /// Largest power of the brake resistor.
    ResistorPeak, "brake resistor peak power", "resistor_peak";
    /// Largest energy of the brake resistor without a pause.
    ResistorPulse, "brake resistor pulse energy", "resistor_pulse";
    /// Lowest natural frequency against the drive frequency (VDI 2149).
    NaturalFrequency, "natural frequency", "natural_frequency";
    /// Backlash at the tool.
    Backlash, "backlash", "backlash";
}

/// On which side of its limit a figure must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// Not above.
    AtMost,
    /// Not below.
    AtLeast,
}

impl Rule {
    /// Number of rules.
    pub const COUNT: usize = Self::ALL.len();

    /// On which side of its limit the figure must be.
    pub const fn sense(self) -> Sense {
        match self {
            Self::NaturalFrequency | Self::BrakeResistance => Sense::AtLeast,
            _ => Sense::AtMost,
        }
    }

    /// Whether its limits are plain numbers instead of shares of a rating: a ratio of inertias or of frequencies.
    pub const fn is_ratio(self) -> bool {
        matches!(self, Self::InertiaRatio | Self::NaturalFrequency)
    }

    /// Whether another motion of the same moves may satisfy it; other rules depend only on machine and drive.
    pub const fn follows_motion(self) -> bool {
        !matches!(
            self,
            Self::HoldingTorque
                | Self::BrakeTorque
                | Self::InertiaRatio
                | Self::GearboxEmergency
                | Self::MotorVoltage
                | Self::AmplifierVoltage
                | Self::BrakeResistance
                | Self::Backlash
        )
    }

    /// Whether it requires that a part is made for the voltage of the supply.
    pub const fn is_of_voltage(self) -> bool {
        matches!(self, Self::MotorVoltage | Self::AmplifierVoltage)
    }

    /// Whether it is a yes-or-no rule: figure and limit depend on the parts, not on the motion. Such a rule has no margin, and the distance of its
    /// figure from its limit says nothing about a drive that satisfies it.
    pub const fn is_yes_or_no(self) -> bool {
        self.is_of_voltage() || matches!(self, Self::BusVoltage | Self::BrakeResistance)
    }

    /// Whether judging it needs the time course of a state (temperature, charge), sample by sample. Such rules are checked only for drives that
    /// satisfy all others.
    pub const fn follows_time(self) -> bool {
        matches!(
            self,
            Self::WindingTemperature
                | Self::HousingTemperature
                | Self::Overload
                | Self::BusVoltage
                | Self::BrakeResistance
                | Self::ResistorPower
                | Self::ResistorPeak
                | Self::ResistorPulse
        )
    }
}
