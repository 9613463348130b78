//! The columns of jred's own catalogue format: name, units, and the tables that have them.

use jred_file::plain;
use jred_file::units::Fault;
use jred_file::units::kind as units;
use jred_file::units::quantity::unit_of;
use jred_file::units::unit;

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
    /// Its value in SI.
    pub(super) measure: unit::Unit,
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
        let plain = unit::Unit::plain;
        let (measure, motors, range) = match self {
            Self::Hourly if ["/h", "1/h", "per hour"].contains(&text) => {
                (plain(), MotorScope::Any, PLAIN)
            }
            Self::Hourly => return foreign("write cycles per hour: \"1000/h\""),
            Self::Of([]) if text.is_empty() => (plain(), MotorScope::Any, PLAIN),
            Self::Of([]) => return foreign("write it without a unit"),
            Self::Of(kinds) => {
                let (measure, kind) = unit_of(text, kinds)?;
                let motors = [MotorScope::Rotary, MotorScope::Linear]
                    .into_iter()
                    .nth(kind);
                let motors = motors.filter(|_| kinds.len() > 1);
                let range = kinds.get(kind).map_or(PLAIN, |k| [k.smallest, k.largest]);
                (measure, motors.unwrap_or(MotorScope::Any), range)
            }
        };
        let text = text.to_owned();
        Ok(Unit {
            text,
            measure,
            motors,
            range,
        })
    }
}

macro_rules! columns {
    ($($column:ident $name:literal [$($kind:ident)*] [$($holds:ident)*] $help:literal;)*) => {
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

            /// Its meaning, in one line.
            pub(super) const fn help(self) -> &'static str {
                match self { $(Self::$column => $help,)* }
            }

            /// The tables that contain it.
            pub(super) const fn kinds(self) -> &'static [Kind] {
                match self { $(Self::$column => &[$(Kind::$kind,)*],)* }
            }
        }
    };
}

columns! {
    Key "key" [Motors Gearboxes Amplifiers Resistors] [] "unique short name";
    Maker "maker" [Motors Gearboxes Amplifiers Resistors] [] "maker";
    Model "model" [Motors Gearboxes Amplifiers Resistors] [] "type designation, with which it is ordered";
    MotorKind "kind" [Motors] [] "rotary (default) or linear";
    RatedTorque "rated_torque" [Motors] [TORQUE] "S1 torque at rated speed";
    RatedForce "rated_force" [Motors] [FORCE] "S1 force at rated speed";
    RatedSpeed "rated_speed" [Motors] [ANGULAR_SPEED VELOCITY] "speed of the rated figures";
    StandstillTorque "standstill_torque" [Motors] [TORQUE] "S1 torque at standstill, M0";
    StandstillForce "standstill_force" [Motors] [FORCE] "S1 force at standstill";
    PeakTorque "peak_torque" [Motors] [TORQUE] "largest short-time torque";
    PeakForce "peak_force" [Motors] [FORCE] "largest short-time force";
    MaxSpeed "max_speed" [Motors] [ANGULAR_SPEED VELOCITY] "largest speed";
    MaxPower "max_power" [Motors] [POWER] "largest continuous power";
    NoLoadSpeed "no_load_speed" [Motors] [ANGULAR_SPEED VELOCITY] "speed without load at bus_voltage";
    RotorInertia "rotor_inertia" [Motors] [INERTIA] "inertia of the rotor without brake";
    MovingMass "moving_mass" [Motors] [MASS] "mass of the moving part";
    CornerSpeed "peak_corner_speed" [Motors] [ANGULAR_SPEED VELOCITY] "the peak torque is available up to this speed";
    TorqueAtMaxSpeed "peak_torque_at_max_speed" [Motors] [TORQUE] "peak torque at the largest speed";
    ForceAtMaxSpeed "peak_force_at_max_speed" [Motors] [FORCE] "peak force at the largest speed";
    PeakCurve "peak_curve" [Motors] [] "points \"0 rpm: 12 N m; 6000 rpm: 4 N m\" from standstill, not rising; replaces the four peak figures";
    ContinuousCurve "continuous_curve" [Motors] [] "S1 torque over speed, as peak_curve";
    CoulombFriction "coulomb_friction" [Motors] [TORQUE] "friction of the shaft; 0 if not given";
    FrictionForce "friction_force" [Motors] [FORCE] "friction of the moving part; 0 if not given";
    ViscousFriction "viscous_friction" [Motors] [VISCOUS_MOMENT VISCOUS_FORCE] "friction that rises with the speed; 0 if not given";
    Commutation "commutation" [Motors] [] "sine (default: three phases, RMS currents, line to line) or block (direct current)";
    TorqueConstant "torque_constant" [Motors] [TORQUE_CONSTANT FORCE_CONSTANT] "torque per ampere RMS, k_t";
    VoltageConstant "voltage_constant" [Motors] [VOLTAGE_CONSTANT LINEAR_VOLTAGE_CONSTANT] "voltage per speed, k_e";
    WindingResistance "winding_resistance" [Motors] [RESISTANCE] "at 20 °C, line to line";
    WindingInductance "winding_inductance" [Motors] [INDUCTANCE] "line to line";
    PolePairs "pole_pairs" [Motors] [] "pairs of poles";
    StandstillCurrent "standstill_current" [Motors] [CURRENT] "current at standstill torque";
    NoLoadCurrent "no_load_current" [Motors] [CURRENT] "current without load at no_load_speed";
    WindingThermalResistance "thermal_resistance_winding" [Motors] [THERMAL_RESISTANCE] "winding to housing, or to the surroundings if alone";
    HousingThermalResistance "thermal_resistance_housing" [Motors] [THERMAL_RESISTANCE] "housing to surroundings";
    WindingTime "thermal_time_winding" [Motors] [TIME] "thermal time constant of the winding";
    HousingTime "thermal_time_housing" [Motors] [TIME] "thermal time constant of the housing, or the only one";
    MaxTemperature "max_winding_temperature" [Motors] [TEMPERATURE] "largest temperature of the winding";
    BrakeTorque "brake_torque" [Motors] [TORQUE] "static torque of the holding brake";
    BrakeForce "brake_force" [Motors] [FORCE] "static force of the holding brake";
    BrakeInertia "brake_inertia" [Motors] [INERTIA] "inertia that the brake adds";
    BrakeMass "brake_mass" [Motors] [MASS] "mass that the brake adds to the moving part";
    BrakeDynamicTorque "brake_dynamic_torque" [Motors] [TORQUE] "mean torque of the brake while it slips";
    BrakeDynamicForce "brake_dynamic_force" [Motors] [FORCE] "mean force of the brake while it slips";
    BrakeClosingTime "brake_closing_time" [Motors] [TIME] "time until the brake has its torque";
    BrakeWork "brake_work" [Motors] [ENERGY] "largest work of one stop";
    BrakeStops "brake_stops" [Motors] [] "such stops per hour";
    BrakeOption "brake_option" [Motors] [] "yes: the motor is offered without and, as KEY-brake, with its brake";
    BrakeOpeningTime "brake_opening_time" [Motors] [TIME] "time until the brake is open";
    BrakePower "brake_power" [Motors] [POWER] "power that keeps the brake open";
    MassWithBrake "mass_with_brake" [Motors] [MASS] "mass with the brake";
    Flange "flange" [Motors Gearboxes] [LENGTH] "size of the flange between motor and gearbox";
    Shaft "shaft_diameter" [Motors] [LENGTH] "diameter of the motor shaft";
    TemperatureDerating "temperature_derating" [Motors Amplifiers] [] "factor of the S1 torque or of the currents, \"40 degC: 100 %; 55 degC: 80 %\", falling";
    AltitudeDerating "altitude_derating" [Motors Amplifiers] [] "the same over the altitude, \"1000 m: 100 %; 3000 m: 80 %\"";
    BuiltInGearbox "built_in_gearbox" [Motors] [] "key of the gearbox of a gear motor: the two fit only each other";
    BusVoltage "bus_voltage" [Motors Amplifiers] [VOLTAGE] "nominal voltage of the DC bus, if not √2 times mains_voltage";
    MainsVoltage "mains_voltage" [Motors Amplifiers] [VOLTAGE] "of the data sheet or its class (\"200 V class\"): figures are valid behind a rectifier on it";
    MaxBusVoltage "max_bus_voltage" [Motors] [VOLTAGE] "largest voltage of the insulation, braking included";
    RatedCurrent "rated_current" [Motors Amplifiers] [CURRENT] "of a motor: at rated torque; of an amplifier: continuous output";
    PeakCurrent "peak_current" [Motors Amplifiers] [CURRENT] "of a motor: at peak torque; of an amplifier: short-time output";
    Ratio "ratio" [Gearboxes] [] "input speed over output speed";
    Reverses "reverses" [Gearboxes] [] "yes: the output turns against the input";
    Stages "stages" [Gearboxes] [] "number of stages";
    RatedOutputTorque "rated_output_torque" [Gearboxes] [TORQUE] "T2N";
    PeakOutputTorque "peak_output_torque" [Gearboxes] [TORQUE] "acceleration torque T2B";
    EmergencyOutputTorque "emergency_output_torque" [Gearboxes] [TORQUE] "emergency torque T2Not, a limited number of times";
    RatedInputSpeed "rated_input_speed" [Gearboxes] [ANGULAR_SPEED] "n1N";
    MaxInputSpeed "max_input_speed" [Gearboxes] [ANGULAR_SPEED] "largest input speed";
    InputInertia "input_inertia" [Gearboxes] [INERTIA] "at the input; may be 0";
    Efficiency "efficiency" [Gearboxes] [SHARE] "at full load";
    BackDriving "back_driving" [Gearboxes] [SHARE] "share of a torque that drives back which reaches the motor: same (as the efficiency, default), friction (2 − 1/η), self-locking (0) or a share";
    NoLoadTorque "no_load_torque" [Gearboxes] [TORQUE] "at the input; leave it out if the efficiency includes it";
    Stiffness "stiffness" [Gearboxes] [TORSION_STIFFNESS] "torsional, at the output";
    Backlash "backlash" [Gearboxes] [ANGLE] "at the output";
    ShockFactors "shock_factors" [Gearboxes] [] "cycles per hour and the maker's factor, \"1000/h: 1; 2000/h: 1.25\", rising";
    MaxMotorShaft "max_motor_shaft" [Gearboxes] [LENGTH] "largest motor shaft that the hub takes; motors with a larger one are not combined";
    PeakTime "peak_time" [Amplifiers] [TIME] "longest time of the peak current from cold";
    Capacitance "capacitance" [Amplifiers] [CAPACITANCE] "of the DC bus";
    ChopperVoltage "chopper_voltage" [Amplifiers] [VOLTAGE] "the brake resistor is on";
    MaxVoltage "max_voltage" [Amplifiers] [VOLTAGE] "largest voltage of the DC bus";
    MinResistance "min_resistance" [Amplifiers] [RESISTANCE] "smallest external brake resistor";
    AbsorbableEnergy "absorbable_energy" [Amplifiers] [ENERGY] "energy that the DC bus absorbs up to chopper_voltage; replaces capacitance";
    InternalResistance "internal_resistance" [Amplifiers] [RESISTANCE] "internal brake resistor";
    InternalPower "internal_resistor_power" [Amplifiers] [POWER] "mean power that the internal brake resistor dissipates";
    ConstantLoss "constant_loss" [Amplifiers] [POWER] "loss without current";
    CurrentLoss "loss_per_current" [Amplifiers] [LOSS] "loss per ampere RMS";
    Resistance "resistance" [Resistors] [RESISTANCE] "resistance";
    RatedPower "rated_power" [Motors Resistors] [POWER] "of a resistor: continuous; of a motor: only compared with rated torque times rated speed";
    PeakPower "peak_power" [Resistors] [POWER] "largest short-time power";
    PulseEnergy "pulse_energy" [Resistors] [ENERGY] "energy of a single pulse";
    Fits "fits" [Resistors] [] "keys of the amplifiers that it is made for, separated by ; or blanks; KEY* matches all that begin so; empty: any";
    Mass "mass" [Motors Gearboxes Amplifiers Resistors] [MASS] "without brake, if that is an option";
    Price "price" [Motors Gearboxes Amplifiers Resistors] [] "with its currency";
    FiguresFrom "figures_from" [Motors Gearboxes Amplifiers Resistors] [] "maker (default), or other than the maker's own document: results say so";
    Source "source" [Motors Gearboxes Amplifiers Resistors] [] "document and page of the figures";
    ListedMotor "motor" [Compatibility] [] "key of a motor; KEY* for all that begin so";
    ListedGearboxes "gearboxes" [Compatibility] [] "keys of gearboxes, separated by ; or blanks; empty: none; no such column: any";
    Direct "direct" [Compatibility] [] "no: the motor may not be coupled directly";
    ListedAmplifiers "amplifiers" [Compatibility] [] "keys of amplifiers; empty: any that is suitable";
}

impl Column {
    pub(super) const COUNT: usize = Self::ALL.len();

    /// The columns of a table.
    pub(super) fn of(kind: Kind) -> impl Iterator<Item = Self> {
        let all = Self::ALL.iter().copied();
        all.filter(move |column| column.kinds().contains(&kind))
    }
}
