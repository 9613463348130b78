//! The supply that motors and amplifiers are made for: the largest voltage of the DC bus, from their data sheets.

use jred_file::model::supply::{MAINS_TOLERANCE, rectified};

use super::{Amplifier, Motor};
use jred_file::number::rounding::short;

/// Classes of mains (V). A device for any voltage of a class is made for the highest one, because makers build for the class and state one of its
/// voltages (nominal voltages: IEC 60038).
const CLASSES: [[f64; 2]; 3] = [[100.0, 127.0], [200.0, 240.0], [380.0, 480.0]];

/// Extra-low voltage (V DC, decisive voltage class A of IEC 61800-5-1): insulation is the same up to this voltage.
const EXTRA_LOW: f64 = 60.0;

/// Largest ratio of voltages of one class: 24 and 28 V, 282 and 325 V, 540 and 680 V are in one class; 48 and 325 V, or 325
/// and 560 V, are not.
pub(crate) const VOLTAGE_CLASS: f64 = 4.0 / 3.0;

/// Source of the largest voltage of the DC bus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// The data sheet.
    Stated,
    /// A mains voltage of the data sheet, and the highest of its class (V).
    Mains([f64; 2]),
    /// The bus voltage of the data (V), and the highest mains voltage of its class (V); `None`: extra-low voltage.
    Figures(f64, Option<f64>),
}

/// The largest voltage of the DC bus without braking that a device is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatedBusVoltage {
    /// The voltage (V).
    pub largest: f64,
    /// Its source.
    pub basis: Basis,
}

impl RatedBusVoltage {
    /// For lists of drives: "200 V mains", "to 800 V DC", "48 V DC".
    pub fn words(&self) -> String {
        match self.basis {
            Basis::Stated => format!("to {} V DC", short(self.largest)),
            Basis::Mains([stated, _]) => format!("{} V mains", short(stated)),
            Basis::Figures(bus, _) => format!("{} V DC", short(bus)),
        }
    }
}

/// The highest mains voltage of the class of `mains` (V); without a class, `mains` itself.
fn class(mains: f64) -> f64 {
    let of = |[least, most]: &[f64; 2]| (least / MAINS_TOLERANCE..=*most).contains(&mains);
    CLASSES
        .iter()
        .find(|class| of(class))
        .map_or(mains, |c| c[1])
}

impl RatedBusVoltage {
    fn mains(stated: f64) -> Self {
        let highest = class(stated);
        Self {
            largest: MAINS_TOLERANCE * rectified(highest),
            basis: Basis::Mains([stated, highest]),
        }
    }

    /// From the bus voltage of the data.
    fn figures(bus: f64) -> Self {
        if bus <= EXTRA_LOW {
            return Self {
                largest: EXTRA_LOW,
                basis: Basis::Figures(bus, None),
            };
        }
        let highest = class(bus / rectified(1.0));
        Self {
            largest: MAINS_TOLERANCE * rectified(highest),
            basis: Basis::Figures(bus, Some(highest)),
        }
    }
}

impl Motor {
    /// The largest bus voltage that the motor is made for: the limit of its insulation, else its mains, else the mains of its data's voltage; `None`
    /// if no voltage is given.
    pub fn made_for(&self) -> Option<RatedBusVoltage> {
        let stated = self.max_bus_voltage.map(|largest| RatedBusVoltage {
            largest,
            basis: Basis::Stated,
        });
        stated
            .or_else(|| self.mains_voltage.map(RatedBusVoltage::mains))
            .or_else(|| self.bus_voltage.map(RatedBusVoltage::figures))
    }

    /// Bus voltage for which the data are valid (V): given, or behind a rectifier on the given mains.
    pub fn figures_voltage(&self) -> Option<f64> {
        self.bus_voltage.or(self.mains_voltage.map(rectified))
    }
}

impl Amplifier {
    /// The largest supply bus voltage that the amplifier is made for: from its mains, else from the class of its nominal bus voltage, else the
    /// voltage at which it switches off; `None` if no voltage is given.
    pub fn made_for(&self) -> Option<RatedBusVoltage> {
        let mains = self.mains_voltage.map(RatedBusVoltage::mains);
        mains
            .or_else(|| self.bus_voltage.map(RatedBusVoltage::figures))
            .or_else(|| {
                self.max_voltage.map(|largest| RatedBusVoltage {
                    largest,
                    basis: Basis::Stated,
                })
            })
    }

    /// Nominal voltage of its DC bus (V): given, or behind a rectifier on the given mains.
    pub fn nominal_voltage(&self) -> Option<f64> {
        self.bus_voltage.or(self.mains_voltage.map(rectified))
    }

    /// Highest voltage (V) of its DC bus without braking, on the mains that it is made for.
    pub fn highest_supply(&self) -> Option<f64> {
        let mains = self.mains_voltage.map(rectified);
        mains.map(|bus| MAINS_TOLERANCE * bus).or(self.bus_voltage)
    }
}

/// Whether motor and amplifier are for supplies of one class: the amplifier's bus voltage is at most a quarter below the voltage of the motor's data,
/// and at most a third above it or within the voltage that the motor is stated to be made for. Missing data exclude nothing.
pub(super) fn of_one_class(motor: &Motor, amplifier: &Amplifier) -> bool {
    let Some(bus) = amplifier.nominal_voltage() else {
        return true;
    };
    let stated = motor.max_bus_voltage.is_some() || motor.mains_voltage.is_some();
    let within = motor.made_for().is_some_and(|made| bus <= made.largest);
    motor
        .figures_voltage()
        .map_or(!stated || within, |figures| {
            let low = figures > bus * VOLTAGE_CLASS;
            let high = bus > figures * VOLTAGE_CLASS;
            !low && (!high || stated && within)
        })
}
