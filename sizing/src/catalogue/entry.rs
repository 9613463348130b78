//! A row of jred's own format as an entry of the catalogue, with what must hold within the row.

use super::amplifier::{Amplifier, Resistor};
use super::column::{CYCLES, Column, EFFORT, FACTOR, For, SPEED};
use super::gearbox::Gearbox;
use super::motor::{Brake, Motor, MotorKind, Thermal, Winding};
use super::row::{Read, Row};
use crate::winding::Commutation;

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
};

impl Efforts {
    fn columns(&self) -> [Column; 8] {
        [
            self.rated,
            self.standstill,
            self.peak,
            self.at_max_speed,
            self.inertia,
            self.friction,
            self.brake,
            self.brake_inertia,
        ]
    }
}

/// A motor, and the key of the gearbox that it is built together with.
pub(super) fn motor(row: &mut Row) -> Read<(Motor, Option<String>)> {
    let kind = row.choice(
        Column::MotorKind,
        &[("rotary", MotorKind::Rotary), ("linear", MotorKind::Linear)],
    )?;
    let kind = kind.unwrap_or_default();
    let (own, other, motors) = match kind {
        MotorKind::Rotary => (TORQUES, FORCES, For::Rotary),
        MotorKind::Linear => (FORCES, TORQUES, For::Linear),
    };
    row.expect(motors);
    if let Some(column) = other
        .columns()
        .into_iter()
        .find(|c| row.words(*c).is_some())
    {
        let (have, instead) = match kind {
            MotorKind::Rotary => ("rotary", "linear"),
            MotorKind::Linear => ("linear", "rotary"),
        };
        return Err(row.fault(
            column,
            &format!("is given, but its kind is {have}"),
            "a figure of the other kind of motor",
            format!("write \"{instead}\" into the column \"kind\", or leave this cell empty"),
        ));
    }
    let motor = Motor {
        key: row.text(Column::Key)?,
        maker: row.text(Column::Maker)?,
        model: row.text(Column::Model)?,
        kind,
        rated_torque: row.optional(own.rated)?,
        rated_speed: row.optional(Column::RatedSpeed)?,
        standstill_torque: row.optional(own.standstill)?,
        peak_torque: row.optional(own.peak)?,
        max_speed: row.optional(Column::MaxSpeed)?,
        max_power: row.optional(Column::MaxPower)?,
        rotor_inertia: row.positive(own.inertia)?,
        corner_speed: row.optional(Column::CornerSpeed)?,
        torque_at_max_speed: row.optional(own.at_max_speed)?,
        no_load_speed: row.optional(Column::NoLoadSpeed)?,
        peak_curve: curve(row, Column::PeakCurve)?,
        continuous_curve: curve(row, Column::ContinuousCurve)?,
        friction: [
            row.not_negative(own.friction)?.unwrap_or(0.0),
            row.not_negative(Column::ViscousFriction)?.unwrap_or(0.0),
        ],
        winding: winding(row)?,
        thermal: Thermal {
            winding_resistance: row.optional(Column::WindingThermalResistance)?,
            housing_resistance: row.optional(Column::HousingThermalResistance)?,
            winding_time: row.optional(Column::WindingTime)?,
            housing_time: row.optional(Column::HousingTime)?,
            max_temperature: row.optional(Column::MaxTemperature)?,
        },
        brake: brake(row, &own)?,
        bus_voltage: row.optional(Column::BusVoltage)?,
        mass: row.optional(Column::Mass)?,
        price: row.optional(Column::Price)?,
        from_maker: from_maker(row)?,
        source: row.text(Column::Source)?,
    };
    torque_and_speed(row, &motor, &own)?;
    let built_in = row.words(Column::BuiltInGearbox).map(ToOwned::to_owned);
    if kind == MotorKind::Linear && built_in.is_some() {
        return Err(row.fault(
            Column::BuiltInGearbox,
            "is given, but a linear motor has no gearbox",
            "here",
            "leave this cell empty",
        ));
    }
    Ok((motor, built_in))
}

/// What a motor cannot be judged without, and which figures cannot be below which.
fn torque_and_speed(row: &Row, motor: &Motor, own: &Efforts) -> Read<()> {
    let continuous = motor.rated_torque.or(motor.standstill_torque);
    if continuous.is_none() && motor.continuous_curve.is_empty() {
        return Err(row.missing(own.rated, &[own.standstill, Column::ContinuousCurve]));
    }
    if motor.peak_torque.is_none() && motor.peak_curve.is_empty() {
        return Err(row.missing(own.peak, &[Column::PeakCurve]));
    }
    let speed = motor.rated_speed.or(motor.max_speed);
    if speed.is_none() && motor.continuous_curve.is_empty() {
        return Err(row.missing(
            Column::RatedSpeed,
            &[Column::MaxSpeed, Column::ContinuousCurve],
        ));
    }
    let peak = (own.peak, motor.peak_torque);
    row.at_least(peak, (own.rated, motor.rated_torque))?;
    row.at_least(peak, (own.standstill, motor.standstill_torque))?;
    row.at_least(peak, (own.at_max_speed, motor.torque_at_max_speed))?;
    let max_speed = (Column::MaxSpeed, motor.max_speed);
    row.at_least(max_speed, (Column::RatedSpeed, motor.rated_speed))?;
    let current = (Column::PeakCurrent, motor.winding.peak_current);
    row.at_least(current, (Column::RatedCurrent, motor.winding.rated_current))
}

/// Points of torque over speed: the torque must not rise.
fn curve(row: &Row, column: Column) -> Read<Vec<[f64; 2]>> {
    let points = row.points(column, [SPEED, EFFORT])?;
    let falls = points.windows(2).all(|two| match two {
        [a, b] => b[1] <= a[1],
        _ => true,
    });
    let help = match points.as_slice() {
        [] => return Ok(points),
        [_] => "give at least two points, the first at standstill",
        [[speed, _], ..] if *speed != 0.0 => "begin with the point at standstill, speed 0",
        [[_, torque], ..] if *torque == 0.0 => "the torque at standstill must be above zero",
        _ if !falls => {
            "the torque may not rise with the speed: check the points against the data sheet"
        }
        _ => return Ok(points),
    };
    Err(row.fault(
        column,
        "is not a falling curve from standstill on",
        "here",
        help,
    ))
}

fn winding(row: &Row) -> Read<Winding> {
    let commutation = row.choice(
        Column::Commutation,
        &[("sine", Commutation::Sine), ("block", Commutation::Block)],
    )?;
    Ok(Winding {
        commutation: commutation.unwrap_or_default(),
        torque_constant: row.optional(Column::TorqueConstant)?,
        voltage_constant: row.optional(Column::VoltageConstant)?,
        resistance: row.optional(Column::WindingResistance)?,
        inductance: row.optional(Column::WindingInductance)?,
        pole_pairs: row.count(Column::PolePairs)?.map(f64::from),
        rated_current: row.optional(Column::RatedCurrent)?,
        standstill_current: row.optional(Column::StandstillCurrent)?,
        peak_current: row.optional(Column::PeakCurrent)?,
        no_load_current: row.optional(Column::NoLoadCurrent)?,
    })
}

fn brake(row: &Row, own: &Efforts) -> Read<Option<Brake>> {
    let inertia = row.not_negative(own.brake_inertia)?;
    match row.optional(own.brake)? {
        Some(torque) => Ok(Some(Brake {
            torque,
            inertia: inertia.unwrap_or(0.0),
        })),
        None if inertia.is_some() => Err(row.missing(own.brake, &[])),
        None => Ok(None),
    }
}

/// A gearbox.
pub(super) fn gearbox(row: &Row) -> Read<Gearbox> {
    let efficiency = row.positive(Column::Efficiency)?;
    if efficiency > 1.0 {
        return Err(row.fault(
            Column::Efficiency,
            "is above 1",
            "too large",
            "check the figure and the unit in the header: 97 needs [%], 0.97 no unit",
        ));
    }
    let gearbox = Gearbox {
        key: row.text(Column::Key)?,
        maker: row.text(Column::Maker)?,
        model: row.text(Column::Model)?,
        ratio: row.positive(Column::Ratio)?,
        reverses: row.yes_or_no(Column::Reverses)?.unwrap_or(false),
        stages: row.count(Column::Stages)?,
        rated_torque: row.optional(Column::RatedOutputTorque)?,
        peak_torque: row.optional(Column::PeakOutputTorque)?,
        emergency_torque: row.optional(Column::EmergencyOutputTorque)?,
        rated_speed: row.optional(Column::RatedInputSpeed)?,
        max_speed: row.optional(Column::MaxInputSpeed)?,
        inertia: row
            .not_negative(Column::InputInertia)?
            .ok_or_else(|| row.missing(Column::InputInertia, &[]))?,
        efficiency,
        efficiency_assumed: false,
        back_efficiency: back_efficiency(row, efficiency)?,
        no_load_torque: row.not_negative(Column::NoLoadTorque)?.unwrap_or(0.0),
        stiffness: row.optional(Column::Stiffness)?,
        backlash: row.not_negative(Column::Backlash)?,
        shock_factors: row.points(Column::ShockFactors, [CYCLES, FACTOR])?,
        mass: row.optional(Column::Mass)?,
        price: row.optional(Column::Price)?,
        from_maker: from_maker(row)?,
        source: row.text(Column::Source)?,
    };
    if gearbox.peak_torque.or(gearbox.rated_torque).is_none() {
        return Err(row.missing(Column::PeakOutputTorque, &[Column::RatedOutputTorque]));
    }
    if gearbox.max_speed.or(gearbox.rated_speed).is_none() {
        return Err(row.missing(Column::MaxInputSpeed, &[Column::RatedInputSpeed]));
    }
    let peak = (Column::PeakOutputTorque, gearbox.peak_torque);
    row.at_least(peak, (Column::RatedOutputTorque, gearbox.rated_torque))?;
    let emergency = (Column::EmergencyOutputTorque, gearbox.emergency_torque);
    row.at_least(emergency, peak)?;
    let speed = (Column::MaxInputSpeed, gearbox.max_speed);
    row.at_least(speed, (Column::RatedInputSpeed, gearbox.rated_speed))?;
    let falling = |two: &[[f64; 2]]| matches!(two, [a, b] if b[1] < a[1]);
    let factors = &gearbox.shock_factors;
    if factors.windows(2).any(falling) || factors.iter().any(|f| f[1] < 1.0) {
        return Err(row.fault(
            Column::ShockFactors,
            "falls, or is below 1",
            "here",
            "a shock factor is at least 1 and rises with the cycles per hour: \"1000/h: 1; 2000/h: 1.2\"",
        ));
    }
    Ok(gearbox)
}

/// What reaches the motor of a torque that drives back: η again (the default), 2 − 1/η for friction, or a share.
fn back_efficiency(row: &Row, efficiency: f64) -> Read<f64> {
    let column = Column::BackDriving;
    match row.words(column) {
        None | Some("same") => Ok(efficiency),
        Some("friction") => Ok(2.0 - 1.0 / efficiency),
        Some("self-locking") => Ok(0.0),
        Some(word) if word.starts_with(|c: char| c.is_alphabetic()) => Err(row.fault(
            column,
            &format!("is \"{word}\""),
            "not known",
            "write \"same\" (the efficiency again), \"friction\" (2 - 1/efficiency), \"self-locking\", or a share",
        )),
        Some(_) => {
            let share = row.not_negative(column)?.unwrap_or(efficiency);
            if share > 1.0 {
                return Err(row.fault(
                    column,
                    "is above 1",
                    "too large",
                    "check the figure and the unit in the header: 90 needs [%], 0.9 no unit",
                ));
            }
            Ok(share)
        }
    }
}

/// A servo amplifier.
pub(super) fn amplifier(row: &Row) -> Read<Amplifier> {
    let amplifier = Amplifier {
        key: row.text(Column::Key)?,
        maker: row.text(Column::Maker)?,
        model: row.text(Column::Model)?,
        rated_current: row.positive(Column::RatedCurrent)?,
        peak_current: row.positive(Column::PeakCurrent)?,
        peak_time: row.optional(Column::PeakTime)?,
        bus_voltage: row.optional(Column::BusVoltage)?,
        capacitance: row.optional(Column::Capacitance)?,
        chopper_voltage: row.optional(Column::ChopperVoltage)?,
        max_voltage: row.optional(Column::MaxVoltage)?,
        min_resistance: row.optional(Column::MinResistance)?,
        losses: [
            row.not_negative(Column::ConstantLoss)?.unwrap_or(0.0),
            row.not_negative(Column::CurrentLoss)?.unwrap_or(0.0),
        ],
        mass: row.optional(Column::Mass)?,
        price: row.optional(Column::Price)?,
        from_maker: from_maker(row)?,
        source: row.text(Column::Source)?,
    };
    row.at_least(
        (Column::PeakCurrent, Some(amplifier.peak_current)),
        (Column::RatedCurrent, Some(amplifier.rated_current)),
    )?;
    let chopper = (Column::ChopperVoltage, amplifier.chopper_voltage);
    let highest = (Column::MaxVoltage, amplifier.max_voltage);
    row.at_least(chopper, (Column::BusVoltage, amplifier.bus_voltage))?;
    row.at_least(highest, (Column::BusVoltage, amplifier.bus_voltage))?;
    row.at_least(highest, chopper)?;
    Ok(amplifier)
}

/// A brake resistor.
pub(super) fn resistor(row: &Row) -> Read<Resistor> {
    let resistor = Resistor {
        key: row.text(Column::Key)?,
        maker: row.text(Column::Maker)?,
        model: row.text(Column::Model)?,
        resistance: row.positive(Column::Resistance)?,
        rated_power: row.positive(Column::RatedPower)?,
        peak_power: row.optional(Column::PeakPower)?,
        pulse_energy: row.optional(Column::PulseEnergy)?,
        price: row.optional(Column::Price)?,
        from_maker: from_maker(row)?,
        source: row.text(Column::Source)?,
    };
    row.at_least(
        (Column::PeakPower, resistor.peak_power),
        (Column::RatedPower, Some(resistor.rated_power)),
    )?;
    Ok(resistor)
}

/// Whether the figures were read in the maker's own document; so if there is no such column or the cell is empty.
fn from_maker(row: &Row) -> Read<bool> {
    let from = row.choice(Column::FiguresFrom, &[("maker", true), ("other", false)])?;
    Ok(from.unwrap_or(true))
}
