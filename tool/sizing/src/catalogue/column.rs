//! The columns of jred's own catalogue format: name, units, and the tables that have them.

use jred_file::plain;
use jred_file::units::Fault;
use jred_file::units::kind as units;
use jred_file::units::quantity::unit_of;

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

    /// End of the file name before ".csv", and name of the rows.
    pub(super) const fn plural(self) -> &'static str {
        match self {
            Self::Motors => "motors",
            Self::Gearboxes => "gearboxes",
            Self::Amplifiers => "amplifiers",
            Self::Resistors => "resistors",
            Self::Compatibility => "compatibility",
        }
    }

    /// Name of the tables in TOML.
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
pub(super) enum MotorScope {
    Any,
    Rotary,
    Linear,
}

/// A unit of a column.
#[derive(Debug)]
pub(super) struct Unit {
    pub(super) text: String,
    /// Its SI value.
    pub(super) si: f64,
    pub(super) motors: MotorScope,
    /// The smallest positive and the largest value (SI). Others are mistakes and lead to infinite figures.
    pub(super) range: [f64; 2],
}

/// The range of plain numbers, such as prices.
pub(super) const PLAIN: [f64; 2] = [1e-6, 1e12];

/// The range of the ratio of a gearbox.
pub(super) const RATIO: [f64; 2] = [1e-4, 1e6];

/// Content of a cell or of a point of a curve.
#[derive(Clone, Copy, Debug)]
pub(super) enum CellContent {
    /// Cycles per hour.
    Hourly,
    /// A quantity of one kind, or of two: for a rotary and for a linear motor. Empty: words, quantities with their own units, or plain numbers. The
    /// header of a price names the currency, any word chosen by the user, which is only compared.
    Of(&'static [&'static units::Kind]),
}

/// Speeds of a curve.
pub(super) const SPEED: CellContent = CellContent::Of(&[&units::ANGULAR_SPEED, &units::VELOCITY]);
/// Torques or forces of a curve.
pub(super) const EFFORT: CellContent = CellContent::Of(&[&units::TORQUE, &units::FORCE]);
/// Ambient temperatures.
pub(super) const TEMPERATURE: CellContent = CellContent::Of(&[&units::TEMPERATURE]);
/// Altitudes.
pub(super) const ALTITUDE: CellContent = CellContent::Of(&[&units::ALTITUDE]);
/// Factors.
pub(super) const FACTOR: CellContent = CellContent::Of(&[&units::SHARE]);

impl CellContent {
    /// The kinds of its quantities.
    pub(super) const fn kinds(self) -> &'static [&'static units::Kind] {
        match self {
            Self::Hourly => &[],
            Self::Of(kinds) => kinds,
        }
    }

    /// Reads the unit of a quantity.
    pub(super) fn unit(self, text: &str) -> Result<Unit, Fault> {
        let foreign = |cure| {
            let shown = plain::cut(text);
            Err(Fault::new(format!("has the unit \"{shown}\""), cure))
        };
        let (si, motors, range) = match self {
            Self::Hourly if ["/h", "1/h", "per hour"].contains(&text) => {
                (1.0, MotorScope::Any, PLAIN)
            }
            Self::Hourly => return foreign("write cycles per hour: \"1000/h\""),
            Self::Of([]) if text.is_empty() => (1.0, MotorScope::Any, PLAIN),
            Self::Of([]) => return foreign("write it without a unit"),
            Self::Of(kinds) => {
                let (unit, kind) = unit_of(text, kinds)?;
                let motors = [MotorScope::Rotary, MotorScope::Linear]
                    .into_iter()
                    .nth(kind);
                let motors = motors.filter(|_| kinds.len() > 1);
                let range = kinds.get(kind).map_or(PLAIN, |k| [k.smallest, k.largest]);
                (unit.scale, motors.unwrap_or(MotorScope::Any), range)
            }
        };
        let text = text.to_owned();
        Ok(Unit {
            text,
            si,
            motors,
            range,
        })
    }
}

macro_rules! columns {
    ($($column:ident $name:literal [$($kind:ident)*] [$($holds:ident)*];)*) => {
        /// A column; its index is its position in [`Column::ALL`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Column { $($column,)* }

        impl Column {
            pub(super) const ALL: &[Self] = &[$(Self::$column,)*];

            pub(super) const fn name(self) -> &'static str {
                match self { $(Self::$column => $name,)* }
            }

            pub(super) const fn holds(self) -> CellContent {
                match self { $(Self::$column => CellContent::Of(&[$(&units::$holds,)*]),)* }
            }

            /// The tables that contain it.
            pub(super) const fn kinds(self) -> &'static [Kind] {
                match self { $(Self::$column => &[$(Kind::$kind,)*],)* }
            }
        }
    };
}

columns! {
    Key "key" [Motors Gearboxes Amplifiers Resistors] [];
    Maker "maker" [Motors Gearboxes Amplifiers Resistors] [];
    Model "model" [Motors Gearboxes Amplifiers Resistors] [];
    MotorKind "kind" [Motors] [];
    RatedTorque "rated_torque" [Motors] [TORQUE];
    RatedForce "rated_force" [Motors] [FORCE];
    RatedSpeed "rated_speed" [Motors] [ANGULAR_SPEED VELOCITY];
    StandstillTorque "standstill_torque" [Motors] [TORQUE];
    StandstillForce "standstill_force" [Motors] [FORCE];
    PeakTorque "peak_torque" [Motors] [TORQUE];
    PeakForce "peak_force" [Motors] [FORCE];
    MaxSpeed "max_speed" [Motors] [ANGULAR_SPEED VELOCITY];
    MaxPower "max_power" [Motors] [POWER];
    NoLoadSpeed "no_load_speed" [Motors] [ANGULAR_SPEED VELOCITY];
    RotorInertia "rotor_inertia" [Motors] [INERTIA];
    MovingMass "moving_mass" [Motors] [MASS];
    CornerSpeed "peak_corner_speed" [Motors] [ANGULAR_SPEED VELOCITY];
    TorqueAtMaxSpeed "peak_torque_at_max_speed" [Motors] [TORQUE];
    ForceAtMaxSpeed "peak_force_at_max_speed" [Motors] [FORCE];
    PeakCurve "peak_curve" [Motors] [];
    ContinuousCurve "continuous_curve" [Motors] [];
    CoulombFriction "coulomb_friction" [Motors] [TORQUE];
    FrictionForce "friction_force" [Motors] [FORCE];
    ViscousFriction "viscous_friction" [Motors] [VISCOUS_MOMENT VISCOUS_FORCE];
    Commutation "commutation" [Motors] [];
    TorqueConstant "torque_constant" [Motors] [TORQUE_CONSTANT FORCE_CONSTANT];
    VoltageConstant "voltage_constant" [Motors] [VOLTAGE_CONSTANT LINEAR_VOLTAGE_CONSTANT];
    WindingResistance "winding_resistance" [Motors] [RESISTANCE];
    WindingInductance "winding_inductance" [Motors] [INDUCTANCE];
    PolePairs "pole_pairs" [Motors] [];
    StandstillCurrent "standstill_current" [Motors] [CURRENT];
    NoLoadCurrent "no_load_current" [Motors] [CURRENT];
    WindingThermalResistance "thermal_resistance_winding" [Motors] [THERMAL_RESISTANCE];
    HousingThermalResistance "thermal_resistance_housing" [Motors] [THERMAL_RESISTANCE];
    WindingTime "thermal_time_winding" [Motors] [TIME];
    HousingTime "thermal_time_housing" [Motors] [TIME];
    MaxTemperature "max_winding_temperature" [Motors] [TEMPERATURE];
    BrakeTorque "brake_torque" [Motors] [TORQUE];
    BrakeForce "brake_force" [Motors] [FORCE];
    BrakeInertia "brake_inertia" [Motors] [INERTIA];
    BrakeMass "brake_mass" [Motors] [MASS];
    BrakeDynamicTorque "brake_dynamic_torque" [Motors] [TORQUE];
    BrakeDynamicForce "brake_dynamic_force" [Motors] [FORCE];
    BrakeClosingTime "brake_closing_time" [Motors] [TIME];
    BrakeWork "brake_work" [Motors] [ENERGY];
    BrakeStops "brake_stops" [Motors] [];
    TemperatureDerating "temperature_derating" [Motors Amplifiers] [];
    AltitudeDerating "altitude_derating" [Motors Amplifiers] [];
    BuiltInGearbox "built_in_gearbox" [Motors] [];
    BusVoltage "bus_voltage" [Motors Amplifiers] [VOLTAGE];
    MainsVoltage "mains_voltage" [Motors Amplifiers] [VOLTAGE];
    MaxBusVoltage "max_bus_voltage" [Motors] [VOLTAGE];
    RatedCurrent "rated_current" [Motors Amplifiers] [CURRENT];
    PeakCurrent "peak_current" [Motors Amplifiers] [CURRENT];
    Ratio "ratio" [Gearboxes] [];
    Reverses "reverses" [Gearboxes] [];
    Stages "stages" [Gearboxes] [];
    RatedOutputTorque "rated_output_torque" [Gearboxes] [TORQUE];
    PeakOutputTorque "peak_output_torque" [Gearboxes] [TORQUE];
    EmergencyOutputTorque "emergency_output_torque" [Gearboxes] [TORQUE];
    RatedInputSpeed "rated_input_speed" [Gearboxes] [ANGULAR_SPEED];
    MaxInputSpeed "max_input_speed" [Gearboxes] [ANGULAR_SPEED];
    InputInertia "input_inertia" [Gearboxes] [INERTIA];
    Efficiency "efficiency" [Gearboxes] [SHARE];
    BackDriving "back_driving" [Gearboxes] [SHARE];
    NoLoadTorque "no_load_torque" [Gearboxes] [TORQUE];
    Stiffness "stiffness" [Gearboxes] [TORSION_STIFFNESS];
    Backlash "backlash" [Gearboxes] [ANGLE];
    ShockFactors "shock_factors" [Gearboxes] [];
    PeakTime "peak_time" [Amplifiers] [TIME];
    Capacitance "capacitance" [Amplifiers] [CAPACITANCE];
    ChopperVoltage "chopper_voltage" [Amplifiers] [VOLTAGE];
    MaxVoltage "max_voltage" [Amplifiers] [VOLTAGE];
    MinResistance "min_resistance" [Amplifiers] [RESISTANCE];
    ConstantLoss "constant_loss" [Amplifiers] [POWER];
    CurrentLoss "loss_per_current" [Amplifiers] [LOSS];
    Resistance "resistance" [Resistors] [RESISTANCE];
    RatedPower "rated_power" [Resistors] [POWER];
    PeakPower "peak_power" [Resistors] [POWER];
    PulseEnergy "pulse_energy" [Resistors] [ENERGY];
    Mass "mass" [Motors Gearboxes Amplifiers] [MASS];
    Price "price" [Motors Gearboxes Amplifiers Resistors] [];
    FiguresFrom "figures_from" [Motors Gearboxes Amplifiers Resistors] [];
    Source "source" [Motors Gearboxes Amplifiers Resistors] [];
    ListedMotor "motor" [Compatibility] [];
    ListedGearboxes "gearboxes" [Compatibility] [];
    Direct "direct" [Compatibility] [];
    ListedAmplifiers "amplifiers" [Compatibility] [];
}

impl Column {
    pub(super) const COUNT: usize = Self::ALL.len();

    /// The columns of a table.
    pub(super) fn of(kind: Kind) -> impl Iterator<Item = Self> {
        let all = Self::ALL.iter().copied();
        all.filter(move |column| column.kinds().contains(&kind))
    }
}
