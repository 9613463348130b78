//! Reads a row of jred's own format as an entry of the catalogue, and checks it for consistency.

mod motor;

use super::amplifier::{Amplifier, Resistor};
use super::column::{ALTITUDE, CellContent, Column, FACTOR, Kind, TEMPERATURE};
use super::derating::Derating;
use super::gearbox::Gearbox;
use super::lists::{Listing, listing};
use super::motor::Motor;
use super::row::{CatalogueRow, RowResult};
use jred_file::model::supply::{BrakeResistor, MAINS, rectified};
use jred_file::number::rounding::figure;
use jred_file::plain;
use motor::motor;

/// The entry of a row.
pub(super) enum Entry {
    /// A motor, and the key of the gearbox that it is built with.
    Motor(Box<Motor>, Option<String>),
    Gearbox(Box<Gearbox>),
    Amplifier(Amplifier),
    Resistor(Resistor),
    Listing(Listing),
}

impl Entry {
    /// Reads a row as an entry of its table.
    pub(super) fn read(row: &mut CatalogueRow) -> RowResult<Self> {
        // Faults of keys and units first: figures are checked only once these can be read.
        row.checked()?;
        Ok(match row.kind {
            Kind::Motors => {
                let (motor, gearbox) = motor(row)?;
                Self::Motor(Box::new(motor), gearbox)
            }
            Kind::Gearboxes => Self::Gearbox(Box::new(gearbox(row)?)),
            Kind::Amplifiers => Self::Amplifier(amplifier(row)?),
            Kind::Resistors => Self::Resistor(resistor(row)?),
            Kind::Compatibility => Self::Listing(listing(row)?),
        })
    }

    /// Its key, maker and model; `None` for a list.
    pub(super) fn names(&self) -> Option<[&str; 3]> {
        Some(match self {
            Self::Motor(m, _) => [&m.key, &m.maker, &m.model],
            Self::Gearbox(g) => [&g.key, &g.maker, &g.model],
            Self::Amplifier(a) => [&a.key, &a.maker, &a.model],
            Self::Resistor(r) => [&r.key, &r.maker, &r.model],
            Self::Listing(_) => return None,
        })
    }

    /// Whether it has a price.
    pub(super) fn has_price(&self) -> bool {
        match self {
            Self::Motor(motor, _) => motor.price.is_some(),
            Self::Gearbox(gearbox) => gearbox.price.is_some(),
            Self::Amplifier(amplifier) => amplifier.price.is_some(),
            // A resistor's price is only compared with other resistors' prices, after their power.
            Self::Resistor(_) | Self::Listing(_) => false,
        }
    }
}

fn gearbox(row: &CatalogueRow) -> RowResult<Gearbox> {
    let efficiency = row.positive(Column::Efficiency);
    if efficiency > 1.0 {
        row.add(row.fault(
            Column::Efficiency,
            "is above 1",
            "too large",
            row.form().share(),
        ));
    }
    let gearbox = Gearbox {
        key: row.text(Column::Key),
        maker: row.text(Column::Maker),
        model: row.text(Column::Model),
        ratio: row.positive(Column::Ratio),
        reverses: row.yes_or_no(Column::Reverses).unwrap_or(false),
        stages: row.count(Column::Stages),
        rated_torque: row.optional(Column::RatedOutputTorque),
        peak_torque: row.optional(Column::PeakOutputTorque),
        emergency_torque: row.optional(Column::EmergencyOutputTorque),
        rated_speed: row.optional(Column::RatedInputSpeed),
        max_speed: row.optional(Column::MaxInputSpeed),
        inertia: row.zero_or_more(Column::InputInertia),
        efficiency,
        efficiency_assumed: false,
        back_efficiency: back_efficiency(row, efficiency),
        no_load_torque: row.not_negative(Column::NoLoadTorque).unwrap_or(0.0),
        stiffness: row.optional(Column::Stiffness),
        backlash: row.not_negative(Column::Backlash),
        max_radial_load: row.optional(Column::MaxRadialLoad),
        max_axial_load: row.optional(Column::MaxAxialLoad),
        shock_factors: row.points(Column::ShockFactors, [CellContent::Hourly, FACTOR]),
        max_motor_shaft: row.optional(Column::MaxMotorShaft),
        flange: row.optional(Column::Flange),
        mass: row.optional(Column::Mass),
        price: row.optional(Column::Price),
        from_maker: from_maker(row),
        source: row.text(Column::Source),
    };
    row.checked()?;
    if gearbox.peak_torque.or(gearbox.rated_torque).is_none() {
        row.missing(Column::PeakOutputTorque, &[Column::RatedOutputTorque]);
    }
    if gearbox.max_speed.or(gearbox.rated_speed).is_none() {
        row.missing(Column::MaxInputSpeed, &[Column::RatedInputSpeed]);
    }
    let peak = (Column::PeakOutputTorque, gearbox.peak_torque);
    row.at_least(peak, (Column::RatedOutputTorque, gearbox.rated_torque));
    let emergency = (Column::EmergencyOutputTorque, gearbox.emergency_torque);
    row.at_least(emergency, peak);
    let speed = (Column::MaxInputSpeed, gearbox.max_speed);
    row.at_least(speed, (Column::RatedInputSpeed, gearbox.rated_speed));
    let falling = |two: &[[f64; 2]]| matches!(two, [a, b] if b[1] < a[1]);
    let factors = &gearbox.shock_factors;
    if factors.windows(2).any(falling) || factors.iter().any(|f| f[1] < 1.0) {
        row.add(row.fault(
            Column::ShockFactors,
            "decreases, or is below 1",
            "here",
            "a shock factor is at least 1 and increases with the cycles per hour: \"1000/h: 1; 2000/h: 1.2\"",
        ));
    }
    row.checked()?;
    Ok(gearbox)
}

/// Factor of the torque where power flows back to the motor: η (the default), 2 − 1/η for friction, or a share.
fn back_efficiency(row: &CatalogueRow, efficiency: f64) -> f64 {
    let column = Column::BackDriving;
    match row.words(column) {
        None | Some("same") => efficiency,
        Some("friction") => 2.0 - 1.0 / efficiency,
        Some("self-locking") => 0.0,
        Some(word) if word.starts_with(|c: char| c.is_alphabetic()) => {
            row.add(row.fault(
                column,
                &format!("is \"{}\"", plain::cut(word)),
                "not known",
                "write \"same\" (equal to the efficiency), \"friction\" (2 - 1/efficiency), \"self-locking\", or a share",
            ));
            efficiency
        }
        Some(_) => {
            let share = row.not_negative(column).unwrap_or(efficiency);
            if share > 1.0 {
                row.add(row.fault(column, "is above 1", "too large", row.form().share()));
            }
            share
        }
    }
}

/// A servo amplifier.
fn amplifier(row: &CatalogueRow) -> RowResult<Amplifier> {
    let amplifier = Amplifier {
        key: row.text(Column::Key),
        maker: row.text(Column::Maker),
        model: row.text(Column::Model),
        rated_current: row.positive(Column::RatedCurrent),
        peak_current: row.positive(Column::PeakCurrent),
        derating: derating(row),
        peak_time: row.optional(Column::PeakTime),
        bus_voltage: row.optional(Column::BusVoltage),
        mains_voltage: mains_voltage(row),
        capacitance: row.optional(Column::Capacitance),
        chopper_voltage: row.optional(Column::ChopperVoltage),
        max_voltage: row.optional(Column::MaxVoltage),
        min_resistance: row.optional(Column::MinResistance),
        absorbable_energy: row.optional(Column::AbsorbableEnergy),
        internal_resistor: internal_resistor(row),
        losses: [
            row.not_negative(Column::ConstantLoss).unwrap_or(0.0),
            row.not_negative(Column::CurrentLoss).unwrap_or(0.0),
        ],
        mass: row.optional(Column::Mass),
        price: row.optional(Column::Price),
        from_maker: from_maker(row),
        source: row.text(Column::Source),
    };
    row.checked()?;
    row.at_least(
        (Column::PeakCurrent, Some(amplifier.peak_current)),
        (Column::RatedCurrent, Some(amplifier.rated_current)),
    );
    let chopper = (Column::ChopperVoltage, amplifier.chopper_voltage);
    let highest = (Column::MaxVoltage, amplifier.max_voltage);
    row.at_least(chopper, (Column::BusVoltage, amplifier.bus_voltage));
    row.at_least(highest, (Column::BusVoltage, amplifier.bus_voltage));
    row.at_least(highest, chopper);
    let mains = (Column::MainsVoltage, amplifier.mains_voltage.map(rectified));
    row.at_least(chopper, mains);
    row.at_least(highest, mains);
    row.checked()?;
    Ok(amplifier)
}

/// The internal brake resistor: both figures or none.
fn internal_resistor(row: &CatalogueRow) -> Option<BrakeResistor> {
    let [resistance, power] = [Column::InternalResistance, Column::InternalPower];
    match (row.optional(resistance), row.optional(power)) {
        (Some(resistance), Some(power)) => Some(BrakeResistor {
            resistance,
            power,
            peak_power: None,
            pulse_energy: None,
        }),
        (Some(_), None) => {
            row.missing(power, &[]);
            None
        }
        (None, Some(_)) => {
            row.missing(resistance, &[]);
            None
        }
        (None, None) => None,
    }
}

/// The maker's derating factors at the site.
fn derating(row: &CatalogueRow) -> Derating {
    let points = |column, place| {
        let points = row.points(column, [place, FACTOR]);
        let rises = points.windows(2).any(|two| two[1][1] > two[0][1]);
        if rises || points.len() == 1 {
            row.add(row.fault(
                column,
                "is not a decreasing curve",
                "here",
                "give at least two points up to the highest value that the maker allows, such as \"40 degC: 100 %; 55 degC: 80 %\" or \
                 \"1000 m: 100 %; 3000 m: 80 %\"",
            ));
        }
        points
    };
    Derating {
        temperature: points(Column::TemperatureDerating, TEMPERATURE),
        altitude: points(Column::AltitudeDerating, ALTITUDE),
    }
}

/// A brake resistor.
fn resistor(row: &CatalogueRow) -> RowResult<Resistor> {
    let resistor = Resistor {
        key: row.text(Column::Key),
        maker: row.text(Column::Maker),
        model: row.text(Column::Model),
        resistance: row.positive(Column::Resistance),
        rated_power: row.positive(Column::RatedPower),
        peak_power: row.optional(Column::PeakPower),
        pulse_energy: row.optional(Column::PulseEnergy),
        fits: row.words(Column::Fits).unwrap_or_default().to_owned(),
        mass: row.optional(Column::Mass),
        price: row.optional(Column::Price),
        from_maker: from_maker(row),
        source: row.text(Column::Source),
    };
    row.checked()?;
    row.at_least(
        (Column::PeakPower, resistor.peak_power),
        (Column::RatedPower, Some(resistor.rated_power)),
    );
    row.checked()?;
    Ok(resistor)
}

/// A mains voltage; it must be in the range of real mains.
fn mains_voltage(row: &CatalogueRow) -> Option<f64> {
    let mains = row.optional(Column::MainsVoltage)?;
    let [least, most] = MAINS;
    if (least..=most).contains(&mains) {
        return Some(mains);
    }
    row.add(row.fault(
        Column::MainsVoltage,
        &format!("is {} V, but mains have {least} V to {most} V", figure(mains)),
        "no such mains",
        "write the mains voltage of the data sheet, such as 230 V or 400 V; a DC voltage is bus_voltage or max_bus_voltage",
    ));
    None
}

/// Whether the data come from the maker's own document; true if the column is missing or the cell empty.
fn from_maker(row: &CatalogueRow) -> bool {
    let from = row.choice(Column::FiguresFrom, &[("maker", true), ("other", false)]);
    from.unwrap_or(true)
}
