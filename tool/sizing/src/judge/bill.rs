//! The bill of materials: the parts of a drive as they are ordered, and the rule that decided each.

use schemars::JsonSchema;
use serde::Serialize;

use super::Assessment;
use crate::catalogue::Resistor;
use crate::judge::check::Check;
use jred_file::model::rule::Rule;

/// A kind of part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// Motor, with its brake if it has one.
    Motor,
    /// Holding brake, a part of the motor.
    Brake,
    /// Gearbox.
    Gearbox,
    /// Servo amplifier.
    Amplifier,
    /// Brake resistor.
    Resistor,
    /// Machine element between gearbox and machine; it belongs to the machine, not to the bill.
    Element,
}

impl Part {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Motor => "motor",
            Self::Brake => "brake",
            Self::Gearbox => "gearbox",
            Self::Amplifier => "amplifier",
            Self::Resistor => "brake resistor",
            Self::Element => "machine element",
        }
    }

    /// The part whose data a rule judges.
    pub const fn of(rule: Rule) -> Self {
        match rule {
            Rule::RmsTorque
            | Rule::PeakTorque
            | Rule::Speed
            | Rule::HoldingTorque
            | Rule::ConstantTorque
            | Rule::InertiaRatio
            | Rule::WindingTemperature
            | Rule::HousingTemperature
            | Rule::AmbientTemperature
            | Rule::Altitude
            | Rule::MotorVoltage => Self::Motor,
            Rule::BrakeTorque | Rule::BrakeWork => Self::Brake,
            Rule::GearboxPeak
            | Rule::GearboxCubicMean
            | Rule::GearboxEmergency
            | Rule::GearboxMeanSpeed
            | Rule::GearboxSpeed
            | Rule::GearboxCycles
            | Rule::GearboxRadial
            | Rule::GearboxAxial
            | Rule::NaturalFrequency
            | Rule::Backlash => Self::Gearbox,
            Rule::CabinetTemperature
            | Rule::RmsCurrent
            | Rule::PeakCurrent
            | Rule::Overload
            | Rule::AmplifierVoltage
            | Rule::BusVoltage => Self::Amplifier,
            Rule::BrakeResistance
            | Rule::ResistorPower
            | Rule::ResistorPeak
            | Rule::ResistorPulse => Self::Resistor,
            Rule::BeltTension
            | Rule::BeltForce
            | Rule::BeltPretension
            | Rule::ScrewForce
            | Rule::ScrewBuckling
            | Rule::ScrewSpeed
            | Rule::PinionForce => Self::Element,
        }
    }
}

/// A part as it is ordered.
#[derive(Clone, Copy, Debug)]
pub struct BillItem<'c, 'a> {
    /// Its kind.
    pub part: Part,
    /// Maker.
    pub maker: &'c str,
    /// The maker's type designation.
    pub model: &'c str,
    /// Key in the catalogue.
    pub key: &'c str,
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Price, in the currency of the catalogue.
    pub price: Option<f64>,
    /// Whether its figures were taken from the maker's own document.
    pub from_maker: bool,
    /// Source of its figures.
    pub source: &'c str,
    /// The rules on its figures that are checked; the one that uses most of its limit first.
    pub decided: Option<&'a Check>,
}

/// Maker, model, key and source of a part, its mass and price, and whether its figures are its maker's.
macro_rules! item {
    ($part:expr, $of:expr) => {
        BillItem {
            part: $part,
            maker: $of.maker.trim(),
            model: &$of.model,
            key: &$of.key,
            mass: $of.mass,
            price: $of.price,
            from_maker: $of.from_maker,
            source: &$of.source,
            decided: None,
        }
    };
}

impl<'c> BillItem<'c, '_> {
    /// A brake resistor, of a drive or of several on one bus.
    pub fn resistor(of: &'c Resistor) -> Self {
        item!(Part::Resistor, of)
    }
}

impl<'c> Assessment<'c> {
    /// The parts of the drive as they are ordered. A holding brake is ordered with its motor: its line has neither mass nor price of its own.
    pub fn bill(&self) -> Vec<BillItem<'c, '_>> {
        let drive = &self.drive;
        let motor = drive.motor;
        let own = |item: BillItem<'c, '_>| BillItem {
            decided: self.decided(item.part),
            ..item
        };
        let mut bill = vec![item!(Part::Motor, motor)];
        if motor.brake.is_some() {
            bill.push(BillItem {
                mass: Some(0.0),
                price: Some(0.0),
                ..item!(Part::Brake, motor)
            });
        }
        bill.extend(drive.gearbox.map(|part| item!(Part::Gearbox, part)));
        bill.extend(drive.amplifier.map(|part| item!(Part::Amplifier, part)));
        bill.extend(self.resistor.map(BillItem::resistor));
        bill.into_iter().map(own).collect()
    }

    /// The checked rule on this part that uses most of its limit.
    fn decided(&self, part: Part) -> Option<&Check> {
        let own = (self.checks.iter())
            .filter(|check| Part::of(check.id) == part && !check.used().is_empty());
        // A rule that only warns decides nothing.
        let decides = |check: &Check| check.shares.fail.is_some();
        own.max_by(|a, b| (decides(a).cmp(&decides(b))).then(a.used.total_cmp(&b.used)))
    }
}
