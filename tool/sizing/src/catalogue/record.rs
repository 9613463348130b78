//! The entries of a catalogue as rows: every column of a table that an entry has, in the units of a data sheet. A table of such rows can be read again
//! (test `a_listed_catalogue_is_the_same_catalogue`).

use super::column::{CellContent, Column, FACTOR, Kind};
use super::motor::MotorKind;
use super::{Amplifier, Catalogue, Commutation, Gearbox, Motor, Resistor};
use crate::cell::Cell;
use jred_file::number::rounding::rounded;
use jred_file::units::kind as units;

/// A table of parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parts {
    /// Motors.
    #[default]
    Motors,
    /// Gearboxes.
    Gearboxes,
    /// Servo amplifiers.
    Amplifiers,
    /// Brake resistors.
    Resistors,
}

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColumnTitle {
    /// Its name.
    pub name: &'static str,
    /// The unit of its cells; empty: words or plain numbers.
    pub unit: &'static str,
    /// Its meaning, in one line.
    pub help: &'static str,
}

impl ColumnTitle {
    /// Name and unit, as in the header of a CSV file.
    pub fn header(&self) -> String {
        match self.unit {
            "" => self.name.to_owned(),
            unit => format!("{} [{unit}]", self.name),
        }
    }
}

/// The unit in which data sheets state a quantity, for a rotary or a linear motor.
fn unit(column: Column, linear: bool) -> &'static str {
    let kinds = column.holds().kinds();
    let kind = if linear { kinds.last() } else { kinds.first() };
    match (column, kind) {
        (_, None) | (Column::PolePairs, _) => "",
        (Column::Stiffness, _) => "N m/arcmin",
        (Column::Backlash, _) => "arcmin",
        (Column::MaxTemperature, _) => "C",
        (Column::HousingTime, _) => "min",
        (Column::BrakeClosingTime | Column::BrakeOpeningTime, _) => "ms",
        (Column::PulseEnergy | Column::BrakeWork | Column::AbsorbableEnergy, _) => "J",
        (_, Some(kind)) if kind.dimension == units::INERTIA.dimension => "kg cm^2",
        (_, Some(kind)) if kind.dimension == units::CURRENT.dimension => "A rms",
        (_, Some(kind)) if kind.dimension == units::LENGTH.dimension => "mm",
        (_, Some(kind)) if kind.dimension == units::INDUCTANCE.dimension => "mH",
        (_, Some(kind)) => kind.unit,
    }
}

impl Parts {
    const fn kind(self) -> Kind {
        match self {
            Self::Motors => Kind::Motors,
            Self::Gearboxes => Kind::Gearboxes,
            Self::Amplifiers => Kind::Amplifiers,
            Self::Resistors => Kind::Resistors,
        }
    }

    /// All tables.
    pub const ALL: [Self; 4] = [
        Self::Motors,
        Self::Gearboxes,
        Self::Amplifiers,
        Self::Resistors,
    ];

    /// Name of the table.
    pub const fn name(self) -> &'static str {
        self.kind().plural()
    }

    /// Its columns, in the units of data sheets.
    pub fn columns(self, linear: bool) -> Vec<ColumnTitle> {
        let all = Column::of(self.kind());
        all.map(|column| ColumnTitle {
            name: column.name(),
            unit: unit(column, linear),
            help: column.help(),
        })
        .collect()
    }

    /// The rows of a catalogue: a cell for each of [`Parts::columns`], the key first.
    pub fn rows(self, catalogue: &Catalogue, linear: bool) -> Vec<Vec<Cell>> {
        fn rows<'e, T: 'e>(
            kind: Kind,
            linear: bool,
            entries: impl IntoIterator<Item = &'e T>,
            value: impl Fn(&'e T, Column) -> Value<'e>,
        ) -> Vec<Vec<Cell>> {
            let row = |entry: &'e T| -> Vec<Cell> {
                let columns = Column::of(kind);
                let cells = columns.map(|column| value(entry, column).cell(column, linear));
                cells.collect()
            };
            entries.into_iter().map(row).collect()
        }
        match self {
            Self::Motors => {
                let kind = if linear {
                    MotorKind::Linear
                } else {
                    MotorKind::Rotary
                };
                let own = catalogue.motors.iter().filter(|motor| motor.kind == kind);
                rows(Kind::Motors, linear, own, motor)
            }
            Self::Gearboxes => rows(Kind::Gearboxes, linear, &catalogue.gearboxes, gearbox),
            Self::Amplifiers => rows(Kind::Amplifiers, linear, &catalogue.amplifiers, amplifier),
            Self::Resistors => rows(Kind::Resistors, linear, &catalogue.resistors, resistor),
        }
    }
}

/// A figure in SI, words, or points.
enum Value<'e> {
    Number(Option<f64>),
    Words(&'e str),
    Points(&'e [[f64; 2]], [(CellContent, &'static str); 2]),
}

impl Value<'_> {
    fn cell(self, column: Column, linear: bool) -> Cell {
        match self {
            Self::Number(Some(value)) => {
                let scale = scale(column.holds(), unit(column, linear));
                // Twelve digits: the unit's own rounding is not shown.
                let shown: f64 = format!("{:.11e}", value / scale)
                    .parse()
                    .unwrap_or(value / scale);
                shown.into()
            }
            Self::Number(None) | Self::Words("") | Self::Points([], _) => Cell::Empty,
            Self::Words(words) => words.into(),
            Self::Points(points, [x, y]) => {
                let one = |value: f64, (holds, unit): (CellContent, &str)| {
                    let shown = rounded(value / scale(holds, unit));
                    format!("{shown} {unit}").replace(" /h", "/h")
                };
                let points = points
                    .iter()
                    .map(|[a, b]| format!("{}: {}", one(*a, x), one(*b, y)));
                points.collect::<Vec<_>>().join("; ").into()
            }
        }
    }
}

fn scale(holds: CellContent, unit: &str) -> f64 {
    holds.unit(unit).map_or(1.0, |unit| unit.measure.scale)
}

fn yes(is: bool) -> Value<'static> {
    Value::Words(if is { "yes" } else { "" })
}

fn from(maker: bool) -> Value<'static> {
    Value::Words(if maker { "maker" } else { "other" })
}

fn zero_is_empty(x: f64) -> Value<'static> {
    Value::Number(Some(x).filter(|x| *x != 0.0))
}

fn motor(m: &Motor, column: Column) -> Value<'_> {
    use Value::{Number, Words};
    let linear = m.kind == MotorKind::Linear;
    let rotary_only = |x: Option<f64>| Number(x.filter(|_| !linear));
    let linear_only = |x: Option<f64>| Number(x.filter(|_| linear));
    let (speed, effort) = if linear {
        ((super::column::SPEED, "m/s"), (super::column::EFFORT, "N"))
    } else {
        (
            (super::column::SPEED, "rpm"),
            (super::column::EFFORT, "N m"),
        )
    };
    let share = (FACTOR, "%");
    let brake = |of: fn(&super::Brake) -> Option<f64>| m.brake.as_ref().and_then(of);
    let (winding, thermal) = (&m.winding, &m.thermal);
    let [coulomb, viscous] = m.friction;
    match column {
        Column::Key => Words(&m.key),
        Column::Maker => Words(&m.maker),
        Column::Model => Words(&m.model),
        Column::MotorKind => Words(if linear { "linear" } else { "" }),
        Column::RatedTorque => rotary_only(m.rated_torque),
        Column::RatedForce => linear_only(m.rated_torque),
        Column::RatedSpeed => Number(m.rated_speed),
        Column::RatedPower => Number(m.stated_power),
        Column::StandstillTorque => rotary_only(m.standstill_torque),
        Column::StandstillForce => linear_only(m.standstill_torque),
        Column::PeakTorque => rotary_only(m.peak_torque),
        Column::PeakForce => linear_only(m.peak_torque),
        Column::MaxSpeed => Number(m.max_speed),
        Column::MaxPower => Number(m.max_power),
        Column::NoLoadSpeed => Number(m.no_load_speed),
        Column::RotorInertia => rotary_only(Some(m.rotor_inertia)),
        Column::MovingMass => linear_only(Some(m.rotor_inertia)),
        Column::CornerSpeed => Number(m.corner_speed),
        Column::TorqueAtMaxSpeed => rotary_only(m.torque_at_max_speed),
        Column::ForceAtMaxSpeed => linear_only(m.torque_at_max_speed),
        Column::PeakCurve => Value::Points(&m.peak_curve, [speed, effort]),
        Column::ContinuousCurve => Value::Points(&m.continuous_curve, [speed, effort]),
        Column::CoulombFriction if !linear => zero_is_empty(coulomb),
        Column::FrictionForce if linear => zero_is_empty(coulomb),
        Column::ViscousFriction => zero_is_empty(viscous),
        Column::Commutation => Words(match winding.commutation {
            Commutation::Sine => "",
            Commutation::Block => "block",
        }),
        Column::TorqueConstant => Number(winding.torque_constant),
        Column::VoltageConstant => Number(winding.voltage_constant),
        Column::WindingResistance => Number(winding.resistance),
        Column::WindingInductance => Number(winding.inductance),
        Column::PolePairs => Number(winding.pole_pairs),
        Column::RatedCurrent => Number(winding.rated_current),
        Column::StandstillCurrent => Number(winding.standstill_current),
        Column::PeakCurrent => Number(winding.peak_current),
        Column::NoLoadCurrent => Number(winding.no_load_current),
        Column::WindingThermalResistance => Number(thermal.winding_resistance),
        Column::HousingThermalResistance => Number(thermal.housing_resistance),
        Column::WindingTime => Number(thermal.winding_time),
        Column::HousingTime => Number(thermal.housing_time),
        Column::MaxTemperature => Number(thermal.max_temperature),
        Column::BrakeTorque => rotary_only(brake(|b| Some(b.torque))),
        Column::BrakeForce => linear_only(brake(|b| Some(b.torque))),
        Column::BrakeInertia => rotary_only(brake(|b| Some(b.inertia))),
        Column::BrakeMass => linear_only(brake(|b| Some(b.inertia))),
        Column::BrakeDynamicTorque => rotary_only(brake(|b| b.dynamic_torque)),
        Column::BrakeDynamicForce => linear_only(brake(|b| b.dynamic_torque)),
        Column::BrakeClosingTime => Number(brake(|b| b.closing_time)),
        Column::BrakeOpeningTime => Number(brake(|b| b.opening_time)),
        Column::BrakeWork => Number(brake(|b| b.work)),
        Column::BrakeStops => Number(brake(|b| b.stops_per_hour)),
        Column::BrakePower => Number(brake(|b| b.power)),
        Column::BrakeOption => yes(m.brake_is_optional),
        Column::Flange => Number(m.flange),
        Column::Shaft => Number(m.shaft_diameter),
        Column::TemperatureDerating => Value::Points(
            &m.derating.temperature,
            [(super::column::TEMPERATURE, "degC"), share],
        ),
        Column::AltitudeDerating => Value::Points(
            &m.derating.altitude,
            [(super::column::ALTITUDE, "m"), share],
        ),
        Column::BusVoltage => Number(m.bus_voltage),
        Column::MainsVoltage => Number(m.mains_voltage),
        Column::MaxBusVoltage => Number(m.max_bus_voltage),
        Column::Mass => Number(m.mass),
        Column::Price => Number(m.price),
        Column::FiguresFrom => from(m.from_maker),
        Column::Source => Words(&m.source),
        _ => Number(None),
    }
}

fn gearbox(g: &Gearbox, column: Column) -> Value<'_> {
    use Value::{Number, Words};
    match column {
        Column::Key => Words(&g.key),
        Column::Maker => Words(&g.maker),
        Column::Model => Words(&g.model),
        Column::Ratio => Number(Some(g.ratio)),
        Column::Reverses => yes(g.reverses),
        Column::Stages => Number(g.stages.map(f64::from)),
        Column::RatedOutputTorque => Number(g.rated_torque),
        Column::PeakOutputTorque => Number(g.peak_torque),
        Column::EmergencyOutputTorque => Number(g.emergency_torque),
        Column::RatedInputSpeed => Number(g.rated_speed),
        Column::MaxInputSpeed => Number(g.max_speed),
        Column::InputInertia => Number(Some(g.inertia)),
        Column::Efficiency => Number(Some(g.efficiency)),
        Column::BackDriving => {
            Number(Some(g.back_efficiency).filter(|back| back.total_cmp(&g.efficiency).is_ne()))
        }
        Column::NoLoadTorque => zero_is_empty(g.no_load_torque),
        Column::Stiffness => Number(g.stiffness),
        Column::Backlash => Number(g.backlash),
        Column::ShockFactors => Value::Points(
            &g.shock_factors,
            [(CellContent::Hourly, "/h"), (FACTOR, "")],
        ),
        Column::MaxMotorShaft => Number(g.max_motor_shaft),
        Column::Flange => Number(g.flange),
        Column::Mass => Number(g.mass),
        Column::Price => Number(g.price),
        Column::FiguresFrom => from(g.from_maker),
        Column::Source => Words(&g.source),
        _ => Number(None),
    }
}

fn amplifier(a: &Amplifier, column: Column) -> Value<'_> {
    use Value::{Number, Words};
    let share = (FACTOR, "%");
    let [constant, per_ampere] = a.losses;
    match column {
        Column::Key => Words(&a.key),
        Column::Maker => Words(&a.maker),
        Column::Model => Words(&a.model),
        Column::RatedCurrent => Number(Some(a.rated_current)),
        Column::PeakCurrent => Number(Some(a.peak_current)),
        Column::PeakTime => Number(a.peak_time),
        Column::BusVoltage => Number(a.bus_voltage),
        Column::MainsVoltage => Number(a.mains_voltage),
        Column::Capacitance => Number(a.capacitance),
        Column::ChopperVoltage => Number(a.chopper_voltage),
        Column::MaxVoltage => Number(a.max_voltage),
        Column::MinResistance => Number(a.min_resistance),
        Column::AbsorbableEnergy => Number(a.absorbable_energy),
        Column::InternalResistance => Number(a.internal_resistor.map(|r| r.resistance)),
        Column::InternalPower => Number(a.internal_resistor.map(|r| r.power)),
        Column::ConstantLoss => zero_is_empty(constant),
        Column::CurrentLoss => zero_is_empty(per_ampere),
        Column::TemperatureDerating => Value::Points(
            &a.derating.temperature,
            [(super::column::TEMPERATURE, "degC"), share],
        ),
        Column::AltitudeDerating => Value::Points(
            &a.derating.altitude,
            [(super::column::ALTITUDE, "m"), share],
        ),
        Column::Mass => Number(a.mass),
        Column::Price => Number(a.price),
        Column::FiguresFrom => from(a.from_maker),
        Column::Source => Words(&a.source),
        _ => Number(None),
    }
}

fn resistor(r: &Resistor, column: Column) -> Value<'_> {
    use Value::{Number, Words};
    match column {
        Column::Key => Words(&r.key),
        Column::Maker => Words(&r.maker),
        Column::Model => Words(&r.model),
        Column::Resistance => Number(Some(r.resistance)),
        Column::RatedPower => Number(Some(r.rated_power)),
        Column::PeakPower => Number(r.peak_power),
        Column::PulseEnergy => Number(r.pulse_energy),
        Column::Fits => Words(&r.fits),
        Column::Mass => Number(r.mass),
        Column::Price => Number(r.price),
        Column::FiguresFrom => from(r.from_maker),
        Column::Source => Words(&r.source),
        _ => Number(None),
    }
}
