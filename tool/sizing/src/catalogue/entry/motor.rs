//! Reads a row of motors and checks it for consistency.

use super::super::column::{Column, EFFORT, MotorScope, SPEED};
use super::super::motor::{Brake, Motor, MotorKind, Thermal, Winding};
use super::super::row::{CatalogueRow, RowResult};
use super::{derating, from_maker, mains_voltage};
use crate::catalogue::Commutation;
use jred_file::model::supply::rectified;

/// The columns of a motor that depend on its kind: torque and inertia, or force and mass.
struct Efforts {
    rated: Column,
    standstill: Column,
    peak: Column,
    at_max_speed: Column,
    inertia: Column,
    friction: Column,
    brake: Column,
    brake_inertia: Column,
    brake_dynamic: Column,
}

const TORQUES: Efforts = Efforts {
    rated: Column::RatedTorque,
    standstill: Column::StandstillTorque,
    peak: Column::PeakTorque,
    at_max_speed: Column::TorqueAtMaxSpeed,
    inertia: Column::RotorInertia,
    friction: Column::CoulombFriction,
    brake: Column::BrakeTorque,
    brake_inertia: Column::BrakeInertia,
    brake_dynamic: Column::BrakeDynamicTorque,
};

const FORCES: Efforts = Efforts {
    rated: Column::RatedForce,
    standstill: Column::StandstillForce,
    peak: Column::PeakForce,
    at_max_speed: Column::ForceAtMaxSpeed,
    inertia: Column::MovingMass,
    friction: Column::FrictionForce,
    brake: Column::BrakeForce,
    brake_inertia: Column::BrakeMass,
    brake_dynamic: Column::BrakeDynamicForce,
};

impl Efforts {
    fn columns(&self) -> [Column; 9] {
        [
            self.rated,
            self.standstill,
            self.peak,
            self.at_max_speed,
            self.inertia,
            self.friction,
            self.brake,
            self.brake_inertia,
            self.brake_dynamic,
        ]
    }
}

/// A motor, and the key of the gearbox that it is built with.
pub(super) fn motor(row: &mut CatalogueRow) -> RowResult<(Motor, Option<String>)> {
    let kind = row.choice(
        Column::MotorKind,
        &[("rotary", MotorKind::Rotary), ("linear", MotorKind::Linear)],
    );
    row.checked()?;
    let kind = kind.unwrap_or_default();
    let (own, other, motors) = match kind {
        MotorKind::Rotary => (TORQUES, FORCES, MotorScope::Rotary),
        MotorKind::Linear => (FORCES, TORQUES, MotorScope::Linear),
    };
    row.expect(motors);
    let foreign = other.columns().into_iter();
    for column in foreign.filter(|column| row.words(*column).is_some()) {
        let (have, instead) = match kind {
            MotorKind::Rotary => ("rotary", "linear"),
            MotorKind::Linear => ("linear", "rotary"),
        };
        row.add(row.fault(
            column,
            &format!("is given, but the motor is {have}"),
            "only for the other kind of motor",
            format!(
                "set the {} \"kind\" to \"{instead}\", or {}",
                row.form().column(),
                row.form().leave_out()
            ),
        ));
    }
    row.checked()?;
    let brake_is_optional = row.yes_or_no(Column::BrakeOption).unwrap_or(false);
    let whole = row.optional(Column::MassWithBrake);
    let mass = row.optional(Column::Mass);
    let motor = Motor {
        key: row.text(Column::Key),
        maker: row.text(Column::Maker),
        model: row.text(Column::Model),
        kind,
        rated_torque: row.optional(own.rated),
        rated_speed: row.optional(Column::RatedSpeed),
        standstill_torque: row.optional(own.standstill),
        peak_torque: row.optional(own.peak),
        max_speed: row.optional(Column::MaxSpeed),
        stated_power: row.optional(Column::RatedPower),
        max_power: row.optional(Column::MaxPower),
        rotor_inertia: row.positive(own.inertia),
        corner_speed: row.optional(Column::CornerSpeed),
        torque_at_max_speed: row.optional(own.at_max_speed),
        no_load_speed: row.optional(Column::NoLoadSpeed),
        peak_curve: curve(row, Column::PeakCurve),
        continuous_curve: curve(row, Column::ContinuousCurve),
        friction: [
            row.not_negative(own.friction).unwrap_or(0.0),
            row.not_negative(Column::ViscousFriction).unwrap_or(0.0),
        ],
        winding: winding(row),
        thermal: Thermal {
            winding_resistance: row.optional(Column::WindingThermalResistance),
            housing_resistance: row.optional(Column::HousingThermalResistance),
            winding_time: row.optional(Column::WindingTime),
            housing_time: row.optional(Column::HousingTime),
            max_temperature: row.optional(Column::MaxTemperature),
        },
        derating: derating(row),
        brake: brake(row, &own, [mass, whole]),
        brake_is_optional,
        flange: row.optional(Column::Flange),
        shaft_diameter: row.optional(Column::Shaft),
        bus_voltage: row.optional(Column::BusVoltage),
        mains_voltage: mains_voltage(row),
        max_bus_voltage: row.optional(Column::MaxBusVoltage),
        amplifiers_listed: false,
        lacks_amplifier: false,
        // A brake that is no option is always there.
        mass: whole.filter(|_| !brake_is_optional).or(mass),
        price: row.optional(Column::Price),
        from_maker: from_maker(row),
        source: row.text(Column::Source),
    };
    // Values are compared with each other only if all can be read.
    row.checked()?;
    torque_and_speed(row, &motor, &own);
    let built_in = row.words(Column::BuiltInGearbox).map(ToOwned::to_owned);
    if kind == MotorKind::Linear && built_in.is_some() {
        row.add(row.fault(
            Column::BuiltInGearbox,
            "is given, but a linear motor has no gearbox",
            "here",
            row.form().leave_out(),
        ));
    }
    row.checked()?;
    Ok((motor, built_in))
}

/// Checks the values that every motor needs, and the order of its ratings.
fn torque_and_speed(row: &CatalogueRow, motor: &Motor, own: &Efforts) {
    let continuous = motor.rated_torque.or(motor.standstill_torque);
    if continuous.is_none() && motor.continuous_curve.is_empty() {
        row.missing(own.rated, &[own.standstill, Column::ContinuousCurve]);
    }
    if motor.peak_torque.is_none() && motor.peak_curve.is_empty() {
        row.missing(own.peak, &[Column::PeakCurve]);
    }
    let speed = motor.rated_speed.or(motor.max_speed);
    if speed.is_none() && motor.continuous_curve.is_empty() {
        row.missing(
            Column::RatedSpeed,
            &[Column::MaxSpeed, Column::ContinuousCurve],
        );
    }
    let peak = (own.peak, motor.peak_torque);
    row.at_least(peak, (own.rated, motor.rated_torque));
    row.at_least(peak, (own.standstill, motor.standstill_torque));
    row.at_least(peak, (own.at_max_speed, motor.torque_at_max_speed));
    let max_speed = (Column::MaxSpeed, motor.max_speed);
    row.at_least(max_speed, (Column::RatedSpeed, motor.rated_speed));
    let bus = (Column::MaxBusVoltage, motor.max_bus_voltage);
    row.at_least(bus, (Column::BusVoltage, motor.bus_voltage));
    let rectified_mains = motor.mains_voltage.map(rectified);
    row.at_least(bus, (Column::MainsVoltage, rectified_mains));
    let current = (Column::PeakCurrent, motor.winding.peak_current);
    row.at_least(current, (Column::RatedCurrent, motor.winding.rated_current));
}

/// Points of torque over speed; the torque must not increase.
fn curve(row: &CatalogueRow, column: Column) -> Vec<[f64; 2]> {
    let points = row.points(column, [SPEED, EFFORT]);
    let falls = points.windows(2).all(|two| match two {
        [a, b] => b[1] <= a[1],
        _ => true,
    });
    let help = match points.as_slice() {
        [] => return points,
        [_] => "give at least two points, the first at standstill",
        [[speed, _], ..] if *speed != 0.0 => "start with the point at standstill (speed 0)",
        [[_, torque], ..] if *torque == 0.0 => "the torque at standstill must be above zero",
        _ if !falls => {
            "the torque must not increase with the speed: check the points against the data sheet"
        }
        _ => return points,
    };
    row.add(row.fault(
        column,
        "is not a decreasing curve that starts at standstill",
        "here",
        help,
    ));
    points
}

fn winding(row: &CatalogueRow) -> Winding {
    let commutation = row.choice(
        Column::Commutation,
        &[("sine", Commutation::Sine), ("block", Commutation::Block)],
    );
    Winding {
        commutation: commutation.unwrap_or_default(),
        torque_constant: row.optional(Column::TorqueConstant),
        voltage_constant: row.optional(Column::VoltageConstant),
        resistance: row.optional(Column::WindingResistance),
        inductance: row.optional(Column::WindingInductance),
        pole_pairs: row.count(Column::PolePairs).map(f64::from),
        rated_current: row.optional(Column::RatedCurrent),
        standstill_current: row.optional(Column::StandstillCurrent),
        peak_current: row.optional(Column::PeakCurrent),
        no_load_current: row.optional(Column::NoLoadCurrent),
    }
}

/// `masses`: of the motor without and with the brake.
fn brake(row: &CatalogueRow, own: &Efforts, masses: [Option<f64>; 2]) -> Option<Brake> {
    let [mass, whole] = masses;
    let inertia = row.not_negative(own.brake_inertia);
    let dynamic_torque = row.optional(own.brake_dynamic);
    let columns = [
        Column::BrakeClosingTime,
        Column::BrakeWork,
        Column::BrakeStops,
        Column::BrakeOpeningTime,
        Column::BrakePower,
    ];
    let figures = columns.map(|column| row.optional(column));
    let [closing_time, work, stops_per_hour, opening_time, power] = figures;
    let mut given = [inertia, dynamic_torque, whole].into_iter().chain(figures);
    if given.any(|figure| figure.is_some()) && row.words(own.brake).is_none() {
        row.missing(own.brake, &[]);
    }
    row.at_least((Column::MassWithBrake, whole), (Column::Mass, mass));
    Some(Brake {
        torque: row.optional(own.brake)?,
        inertia: inertia.unwrap_or(0.0),
        dynamic_torque,
        closing_time,
        work,
        stops_per_hour,
        opening_time,
        power,
        mass: whole.zip(mass).map(|(whole, mass)| whole - mass),
    })
}
