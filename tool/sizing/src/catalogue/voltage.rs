//! Which supply motors and amplifiers are made for: largest voltage of the DC bus, from what their data sheets state.

use jred_machine::model::supply::{MAINS_TOLERANCE, rectified};

use super::{Amplifier, Motor};
use jred_machine::number::rounding::short;

/// Classes of mains (V): what is made for any of the voltages of a class is made for the highest of them, because makers build for
/// the class and state one of its voltages (nominal voltages: IEC 60038).
const CLASSES: [[f64; 2]; 3] = [[100.0, 127.0], [200.0, 240.0], [380.0, 480.0]];

/// Extra-low voltage (V DC, decisive voltage class A of IEC 61800-5-1): insulation is the same up to here.
const EXTRA_LOW: f64 = 60.0;

/// Largest ratio of voltages of one class: 24 and 28 V, 282 and 325 V, 540 and 680 V are in one class; 48 and 325 V, or 325
/// and 560 V, are not.
pub(crate) const VOLTAGE_CLASS: f64 = 4.0 / 3.0;

/// Where the largest voltage of the DC bus comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// The data sheet states it.
    Stated,
    /// A mains voltage of the data sheet, and the highest of its class (V).
    Mains([f64; 2]),
    /// The bus voltage of the figures (V), and the highest mains voltage of its class (V); `None`: extra-low voltage.
    Figures(f64, Option<f64>),
}

/// The largest voltage of the DC bus that something is made for, without that of braking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MadeFor {
    /// The voltage (V).
    pub largest: f64,
    /// Where it comes from.
    pub basis: Basis,
}

impl MadeFor {
    /// For lists of drives: "200 V mains", "to 800 V DC", "48 V DC".
    pub fn words(&self) -> String {
        match self.basis {
            Basis::Stated => format!("to {} V DC", short(self.largest)),
            Basis::Mains([stated, _]) => format!("{} V mains", short(stated)),
            Basis::Figures(bus, _) => format!("{} V DC", short(bus)),
        }
    }
}

/// The highest mains voltage of the class of `mains` (V); of no class: itself.
fn class(mains: f64) -> f64 {
    let of = |[least, most]: &[f64; 2]| (least / MAINS_TOLERANCE..=*most).contains(&mains);
    CLASSES
        .iter()
        .find(|class| of(class))
        .map_or(mains, |c| c[1])
}

impl MadeFor {
    fn mains(stated: f64) -> Self {
        let highest = class(stated);
        Self {
            largest: MAINS_TOLERANCE * rectified(highest),
            basis: Basis::Mains([stated, highest]),
        }
    }

    /// Of the bus voltage that figures are valid for.
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
    /// The largest bus voltage that the motor is made for: what its insulation withstands, else the mains that it is made for, else
    /// those that the voltage of its figures belongs to. `None`: none of them is given.
    pub fn made_for(&self) -> Option<MadeFor> {
        let stated = self.max_bus_voltage.map(|largest| MadeFor {
            largest,
            basis: Basis::Stated,
        });
        stated
            .or_else(|| self.mains_voltage.map(MadeFor::mains))
            .or_else(|| self.bus_voltage.map(MadeFor::figures))
    }

    /// Voltage of the DC bus that the figures are valid for (V): stated, or behind a rectifier on the stated mains.
    pub fn figures_voltage(&self) -> Option<f64> {
        self.bus_voltage.or(self.mains_voltage.map(rectified))
    }
}

impl Amplifier {
    /// The largest bus voltage that the amplifier is made for by its supply: the mains, else those that its nominal bus voltage
    /// belongs to, else the voltage at which it switches off. `None`: none of them is given.
    pub fn made_for(&self) -> Option<MadeFor> {
        let mains = self.mains_voltage.map(MadeFor::mains);
        mains
            .or_else(|| self.bus_voltage.map(MadeFor::figures))
            .or_else(|| {
                self.max_voltage.map(|largest| MadeFor {
                    largest,
                    basis: Basis::Stated,
                })
            })
    }

    /// Nominal voltage of its DC bus (V): stated, or behind a rectifier on the stated mains.
    pub fn nominal_voltage(&self) -> Option<f64> {
        self.bus_voltage.or(self.mains_voltage.map(rectified))
    }

    /// Highest voltage (V) of its DC bus without braking, on the mains that it is made for.
    pub fn highest_supply(&self) -> Option<f64> {
        let mains = self.mains_voltage.map(rectified);
        mains.map(|bus| MAINS_TOLERANCE * bus).or(self.bus_voltage)
    }
}

/// Whether motor and amplifier are for supplies of one class: the amplifier's bus is at most a quarter below that of the motor's
/// figures, and at most a third above, or within what the motor is stated to be made for. Missing figures exclude nothing.
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
