//! The columns of jred's own catalogue format: name, units, and the tables that have them.

use jred_machine::units::scale;

/// A table of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Kind {
    Motors,
    Gearboxes,
    Amplifiers,
    Resistors,
    Compatibility,
}

impl Kind {
    pub(super) const ALL: [Self; 5] = [
        Self::Motors,
        Self::Gearboxes,
        Self::Amplifiers,
        Self::Resistors,
        Self::Compatibility,
    ];

    /// Ending of the name of such a file before ".csv", and name of its rows.
    pub(super) const fn plural(self) -> &'static str {
        match self {
            Self::Motors => "motors",
            Self::Gearboxes => "gearboxes",
            Self::Amplifiers => "amplifiers",
            Self::Resistors => "resistors",
            Self::Compatibility => "compatibility",
        }
    }

    /// The name of its tables in TOML.
    pub(super) const fn singular(self) -> &'static str {
        match self {
            Self::Motors => "motor",
            Self::Gearboxes => "gearbox",
            Self::Amplifiers => "amplifier",
            Self::Resistors => "resistor",
            Self::Compatibility => "compatibility",
        }
    }
}

/// Kind of motor that a unit is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum For {
    Any,
    Rotary,
    Linear,
}

/// A unit that a column accepts.
#[derive(Debug)]
pub(super) struct Unit {
    pub(super) text: &'static str,
    /// Its value in SI.
    pub(super) si: f64,
    pub(super) motors: For,
}

const fn unit(text: &'static str) -> Unit {
    of(text, For::Any)
}

const fn rotary(text: &'static str) -> Unit {
    of(text, For::Rotary)
}

const fn linear(text: &'static str) -> Unit {
    of(text, For::Linear)
}

const fn of(text: &'static str, motors: For) -> Unit {
    Unit {
        text,
        si: scale(text),
        motors,
    }
}

/// What is counted.
const fn count(text: &'static str) -> Unit {
    Unit {
        text,
        si: 1.0,
        motors: For::Any,
    }
}

/// Cells are words, or quantities that carry their units themselves.
const WORDS: &[Unit] = &[unit("")];
const NUMBER: &[Unit] = &[unit("")];
const TORQUE: &[Unit] = &[
    unit("N m"),
    unit("Nm"),
    unit("mN m"),
    unit("mNm"),
    unit("kN m"),
];
const FORCE: &[Unit] = &[linear("N"), linear("kN")];
pub(super) const SPEED: &[Unit] = &[
    rotary("rpm"),
    rotary("rad/s"),
    linear("m/s"),
    linear("mm/s"),
];
const TURNING: &[Unit] = &[unit("rpm"), unit("rad/s")];
/// Torque or force, for the points of a curve.
pub(super) const EFFORT: &[Unit] = &[
    rotary("N m"),
    rotary("Nm"),
    rotary("mN m"),
    rotary("mNm"),
    rotary("kN m"),
    linear("N"),
    linear("kN"),
];
/// Cycles per hour, for shock factors.
pub(super) const CYCLES: &[Unit] = &[count("/h"), count("1/h"), count("per hour")];
pub(super) const FACTOR: &[Unit] = &[unit(""), unit("%")];
const INERTIA: &[Unit] = &[
    unit("kg cm^2"),
    unit("kg m^2"),
    unit("g cm^2"),
    unit("kg mm^2"),
];
const MASS: &[Unit] = &[unit("kg"), unit("g"), unit("t")];
const VOLTAGE: &[Unit] = &[unit("V")];
/// An alternating current is given by its RMS value or by its amplitude.
const CURRENT: &[Unit] = &[unit("A"), unit("A rms"), unit("A peak"), unit("mA")];
const TORQUE_CONSTANT: &[Unit] = &[
    rotary("N m/A"),
    rotary("N m/A rms"),
    rotary("N m/A peak"),
    rotary("mN m/A"),
    linear("N/A"),
    linear("N/A rms"),
    linear("N/A peak"),
];
const VOLTAGE_CONSTANT: &[Unit] = &[
    rotary("V s/rad"),
    rotary("V/krpm"),
    rotary("mV/rpm"),
    linear("V s/m"),
];
const RESISTANCE: &[Unit] = &[unit("Ohm"), unit("ohm"), unit("Ω"), unit("mOhm")];
const INDUCTANCE: &[Unit] = &[unit("H"), unit("mH"), unit("uH")];
const CAPACITANCE: &[Unit] = &[unit("F"), unit("mF"), unit("uF")];
const POWER: &[Unit] = &[unit("W"), unit("kW")];
const ENERGY: &[Unit] = &[unit("J"), unit("kJ")];
const TIME: &[Unit] = &[unit("s"), unit("ms"), unit("min")];
const THERMAL: &[Unit] = &[unit("K/W")];
const TEMPERATURE: &[Unit] = &[unit("C"), unit("°C"), unit("degC")];
const VISCOUS: &[Unit] = &[
    rotary("N m s/rad"),
    rotary("N m s"),
    rotary("N m/krpm"),
    linear("N s/m"),
];
const SHARE: &[Unit] = &[unit("%"), unit("")];
const PLAY: &[Unit] = &[unit("arcmin"), unit("deg"), unit("rad")];
const STIFFNESS: &[Unit] = &[
    unit("N m/arcmin"),
    unit("N m/rad"),
    unit("kN m/rad"),
    unit("N m/deg"),
];
const LOSS: &[Unit] = &[unit("W/A"), unit("V")];
/// The currency is any word chosen by the user; it is only compared.
const PRICE: &[Unit] = &[unit("")];

macro_rules! columns {
    ($($column:ident $name:literal $units:ident [$($kind:ident)*];)*) => {
        /// A column; as an index its place in [`Column::ALL`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Column { $($column,)* }

        impl Column {
            pub(super) const ALL: &[Self] = &[$(Self::$column,)*];

            pub(super) const fn name(self) -> &'static str {
                match self { $(Self::$column => $name,)* }
            }

            /// Units accepted, each with its factor to SI.
            pub(super) const fn units(self) -> &'static [Unit] {
                match self { $(Self::$column => $units,)* }
            }

            /// The tables that have it.
            pub(super) const fn kinds(self) -> &'static [Kind] {
                match self { $(Self::$column => &[$(Kind::$kind,)*],)* }
            }
        }
    };
}

columns! {
    Key "key" WORDS [Motors Gearboxes Amplifiers Resistors];
    Maker "maker" WORDS [Motors Gearboxes Amplifiers Resistors];
    Model "model" WORDS [Motors Gearboxes Amplifiers Resistors];
    MotorKind "kind" WORDS [Motors];
    RatedTorque "rated_torque" TORQUE [Motors];
    RatedForce "rated_force" FORCE [Motors];
    RatedSpeed "rated_speed" SPEED [Motors];
    StandstillTorque "standstill_torque" TORQUE [Motors];
    StandstillForce "standstill_force" FORCE [Motors];
    PeakTorque "peak_torque" TORQUE [Motors];
    PeakForce "peak_force" FORCE [Motors];
    MaxSpeed "max_speed" SPEED [Motors];
    MaxPower "max_power" POWER [Motors];
    NoLoadSpeed "no_load_speed" SPEED [Motors];
    RotorInertia "rotor_inertia" INERTIA [Motors];
    MovingMass "moving_mass" MASS [Motors];
    CornerSpeed "peak_corner_speed" SPEED [Motors];
    TorqueAtMaxSpeed "peak_torque_at_max_speed" TORQUE [Motors];
    ForceAtMaxSpeed "peak_force_at_max_speed" FORCE [Motors];
    PeakCurve "peak_curve" WORDS [Motors];
    ContinuousCurve "continuous_curve" WORDS [Motors];
    CoulombFriction "coulomb_friction" TORQUE [Motors];
    FrictionForce "friction_force" FORCE [Motors];
    ViscousFriction "viscous_friction" VISCOUS [Motors];
    Commutation "commutation" WORDS [Motors];
    TorqueConstant "torque_constant" TORQUE_CONSTANT [Motors];
    VoltageConstant "voltage_constant" VOLTAGE_CONSTANT [Motors];
    WindingResistance "winding_resistance" RESISTANCE [Motors];
    WindingInductance "winding_inductance" INDUCTANCE [Motors];
    PolePairs "pole_pairs" NUMBER [Motors];
    StandstillCurrent "standstill_current" CURRENT [Motors];
    NoLoadCurrent "no_load_current" CURRENT [Motors];
    WindingThermalResistance "thermal_resistance_winding" THERMAL [Motors];
    HousingThermalResistance "thermal_resistance_housing" THERMAL [Motors];
    WindingTime "thermal_time_winding" TIME [Motors];
    HousingTime "thermal_time_housing" TIME [Motors];
    MaxTemperature "max_winding_temperature" TEMPERATURE [Motors];
    BrakeTorque "brake_torque" TORQUE [Motors];
    BrakeForce "brake_force" FORCE [Motors];
    BrakeInertia "brake_inertia" INERTIA [Motors];
    BrakeMass "brake_mass" MASS [Motors];
    BuiltInGearbox "built_in_gearbox" WORDS [Motors];
    BusVoltage "bus_voltage" VOLTAGE [Motors Amplifiers];
    RatedCurrent "rated_current" CURRENT [Motors Amplifiers];
    PeakCurrent "peak_current" CURRENT [Motors Amplifiers];
    Ratio "ratio" NUMBER [Gearboxes];
    Reverses "reverses" WORDS [Gearboxes];
    Stages "stages" NUMBER [Gearboxes];
    RatedOutputTorque "rated_output_torque" TORQUE [Gearboxes];
    PeakOutputTorque "peak_output_torque" TORQUE [Gearboxes];
    EmergencyOutputTorque "emergency_output_torque" TORQUE [Gearboxes];
    RatedInputSpeed "rated_input_speed" TURNING [Gearboxes];
    MaxInputSpeed "max_input_speed" TURNING [Gearboxes];
    InputInertia "input_inertia" INERTIA [Gearboxes];
    Efficiency "efficiency" SHARE [Gearboxes];
    BackDriving "back_driving" SHARE [Gearboxes];
    NoLoadTorque "no_load_torque" TORQUE [Gearboxes];
    Stiffness "stiffness" STIFFNESS [Gearboxes];
    Backlash "backlash" PLAY [Gearboxes];
    ShockFactors "shock_factors" WORDS [Gearboxes];
    PeakTime "peak_time" TIME [Amplifiers];
    Capacitance "capacitance" CAPACITANCE [Amplifiers];
    ChopperVoltage "chopper_voltage" VOLTAGE [Amplifiers];
    MaxVoltage "max_voltage" VOLTAGE [Amplifiers];
    MinResistance "min_resistance" RESISTANCE [Amplifiers];
    ConstantLoss "constant_loss" POWER [Amplifiers];
    CurrentLoss "loss_per_current" LOSS [Amplifiers];
    Resistance "resistance" RESISTANCE [Resistors];
    RatedPower "rated_power" POWER [Resistors];
    PeakPower "peak_power" POWER [Resistors];
    PulseEnergy "pulse_energy" ENERGY [Resistors];
    Mass "mass" MASS [Motors Gearboxes Amplifiers];
    Price "price" PRICE [Motors Gearboxes Amplifiers Resistors];
    FiguresFrom "figures_from" WORDS [Motors Gearboxes Amplifiers Resistors];
    Source "source" WORDS [Motors Gearboxes Amplifiers Resistors];
    ListedMotor "motor" WORDS [Compatibility];
    ListedGearboxes "gearboxes" WORDS [Compatibility];
    Direct "direct" WORDS [Compatibility];
    ListedAmplifiers "amplifiers" WORDS [Compatibility];
}

impl Column {
    pub(super) const COUNT: usize = Self::ALL.len();

    /// The columns of a table.
    pub(super) fn of(kind: Kind) -> impl Iterator<Item = Self> {
        let all = Self::ALL.iter().copied();
        all.filter(move |column| column.kinds().contains(&kind))
    }

    /// Its units for messages: "[N m], [mN m]"; nothing if it has none.
    pub(super) fn unit_list(self) -> String {
        let units = self.units().iter().filter(|unit| !unit.text.is_empty());
        let units: Vec<String> = units.map(|unit| format!("[{}]", unit.text)).collect();
        units.join(", ")
    }
}
