//! The gaps of a catalogue: figures that entries lack, and the rules that cannot be checked without them.

use serde::Serialize;

use super::{Amplifier, Catalogue, Gearbox, Motor, Parts, Resistor};
use jred_file::model::rule::Rule;

/// A figure that entries lack.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Gap {
    /// The table: motors, gearboxes, amplifiers or resistors.
    pub table: &'static str,
    /// The columns, one of which would be sufficient.
    pub columns: &'static [&'static str],
    /// Number of entries without it.
    pub missing: usize,
    /// Number of entries.
    pub of: usize,
    /// The rules that are then not checked; empty: see `costs`.
    pub rules: Vec<Rule>,
    /// Further consequences.
    pub costs: &'static str,
}

/// A figure: its columns, whether an entry has it, the rules that need it, other consequences of its lack.
type Figure<T> = (
    &'static [&'static str],
    fn(&T) -> bool,
    &'static [Rule],
    &'static str,
);

const MOTORS: &[Figure<Motor>] = &[
    (
        &["peak_torque", "peak_curve"],
        |m| m.peak_torque.is_some() || !m.peak_curve.is_empty(),
        &[Rule::PeakTorque],
        "",
    ),
    (
        &["max_speed"],
        |m| m.max_speed.is_some() || !m.peak_curve.is_empty(),
        &[],
        "the rated speed is used",
    ),
    (
        &["peak_corner_speed", "peak_curve"],
        |m| m.corner_speed.is_some() || !m.peak_curve.is_empty(),
        &[],
        "the peak torque is used up to the rated speed only",
    ),
    (
        &["mains_voltage", "bus_voltage", "max_bus_voltage"],
        |m| {
            m.mains_voltage
                .or(m.bus_voltage)
                .or(m.max_bus_voltage)
                .is_some()
        },
        &[Rule::MotorVoltage],
        "such drives rank last",
    ),
    (
        &["rated_current", "torque_constant"],
        |m| {
            m.winding
                .rated_current
                .or(m.winding.torque_constant)
                .is_some()
        },
        &[Rule::RmsCurrent, Rule::PeakCurrent, Rule::Overload],
        "",
    ),
    (
        &["brake_torque"],
        |m| m.brake.is_some() || m.brake_is_optional,
        &[Rule::BrakeTorque],
        "only for machines that move without current",
    ),
    (
        &["brake_closing_time"],
        |m| m.brake.is_none_or(|brake| brake.closing_time.is_some()),
        &[Rule::BrakeWork],
        "only for machines that move without current",
    ),
    (
        &["brake_work"],
        |m| m.brake.is_none_or(|brake| brake.work.is_some()),
        &[Rule::BrakeWork],
        "only for machines that move without current",
    ),
    (
        &["thermal_time_winding", "thermal_time_housing"],
        |m| m.thermal.winding_time.or(m.thermal.housing_time).is_some(),
        &[],
        "temperatures are those of the mean losses",
    ),
    (&["mass"], |m| m.mass.is_some(), &[], "not ranked by mass"),
    (
        &["shaft_diameter"],
        |m| m.shaft_diameter.is_some(),
        &[],
        "whether it fits a gearbox is not checked",
    ),
];

const GEARBOXES: &[Figure<Gearbox>] = &[
    (
        &["peak_output_torque"],
        |g| g.peak_torque.is_some(),
        &[Rule::GearboxPeak],
        "",
    ),
    (
        &["rated_output_torque"],
        |g| g.rated_torque.is_some(),
        &[Rule::GearboxCubicMean],
        "",
    ),
    (
        &["emergency_output_torque"],
        |g| g.emergency_torque.is_some(),
        &[Rule::GearboxEmergency],
        "",
    ),
    (
        &["rated_input_speed"],
        |g| g.rated_speed.is_some(),
        &[Rule::GearboxMeanSpeed],
        "",
    ),
    (
        &["max_input_speed"],
        |g| g.max_speed.is_some(),
        &[Rule::GearboxSpeed],
        "",
    ),
    (
        &["shock_factors"],
        |g| !g.shock_factors.is_empty(),
        &[],
        "above 1000 cycles per hour T2B is not reduced, and a warning is given",
    ),
    (
        &["stiffness"],
        |g| g.stiffness.is_some(),
        &[Rule::NaturalFrequency],
        "",
    ),
    (
        &["backlash"],
        |g| g.backlash.is_some(),
        &[Rule::Backlash],
        "",
    ),
    (
        &["max_radial_load"],
        |g| g.max_radial_load.is_some(),
        &[Rule::GearboxRadial],
        "",
    ),
    (
        &["max_axial_load"],
        |g| g.max_axial_load.is_some(),
        &[Rule::GearboxAxial],
        "",
    ),
    (&["mass"], |g| g.mass.is_some(), &[], "not ranked by mass"),
    (
        &["max_motor_shaft"],
        |g| g.max_motor_shaft.is_some(),
        &[],
        "whether it fits a motor is not checked",
    ),
];

const AMPLIFIERS: &[Figure<Amplifier>] = &[
    (
        &["mains_voltage", "bus_voltage"],
        |a| a.mains_voltage.or(a.bus_voltage).is_some(),
        &[Rule::AmplifierVoltage],
        "",
    ),
    (
        &["peak_time"],
        |a| a.peak_time.is_some(),
        &[Rule::Overload],
        "",
    ),
    (
        &["capacitance", "absorbable_energy"],
        |a| a.capacitance.or(a.absorbable_energy).is_some(),
        &[
            Rule::BusVoltage,
            Rule::ResistorPower,
            Rule::ResistorPeak,
            Rule::ResistorPulse,
        ],
        "unless [supply] gives it",
    ),
    (
        &["max_voltage"],
        |a| a.max_voltage.is_some(),
        &[Rule::BusVoltage],
        "unless [supply] gives it",
    ),
    (
        &["chopper_voltage"],
        |a| a.chopper_voltage.is_some(),
        &[],
        "no brake resistor is chosen, unless [supply] gives it",
    ),
    (
        &["min_resistance"],
        |a| a.min_resistance.is_some(),
        &[Rule::BrakeResistance],
        "unless [supply] gives it",
    ),
    (&["mass"], |a| a.mass.is_some(), &[], "not ranked by mass"),
];

const RESISTORS: &[Figure<Resistor>] = &[
    (
        &["peak_power"],
        |r| r.peak_power.is_some(),
        &[Rule::ResistorPeak],
        "chosen after those that have it",
    ),
    (
        &["pulse_energy"],
        |r| r.pulse_energy.is_some(),
        &[Rule::ResistorPulse],
        "",
    ),
    (
        &["fits"],
        |r| !r.fits.is_empty(),
        &[],
        "offered for every amplifier",
    ),
];

fn gaps<'e, T: 'e>(
    parts: Parts,
    entries: &(impl Iterator<Item = &'e T> + Clone),
    figures: &[Figure<T>],
) -> Vec<Gap> {
    let gap = |(columns, has, rules, costs): &Figure<T>| Gap {
        table: parts.name(),
        columns,
        missing: entries.clone().filter(|entry| !has(entry)).count(),
        of: entries.clone().count(),
        rules: rules.to_vec(),
        costs,
    };
    let gaps = figures.iter().map(gap);
    gaps.filter(|gap| gap.missing > 0).collect()
}

impl Catalogue {
    /// The figures that entries lack, table by table.
    pub fn gaps(&self) -> Vec<Gap> {
        // Of a motor with an optional brake, that with the brake.
        let motors = self.motors.iter().filter(|motor| !motor.brake_is_optional);
        let mut found = gaps(Parts::Motors, &motors, MOTORS);
        found.extend(gaps(Parts::Gearboxes, &self.gearboxes.iter(), GEARBOXES));
        found.extend(gaps(Parts::Amplifiers, &self.amplifiers.iter(), AMPLIFIERS));
        found.extend(gaps(Parts::Resistors, &self.resistors.iter(), RESISTORS));
        found
    }

    /// The figures that the part with this key lacks.
    pub fn gaps_of(&self, parts: Parts, key: &str) -> Vec<Gap> {
        match parts {
            Parts::Motors => {
                let own = self.motors.iter().filter(|m| m.key == key);
                gaps(parts, &own, MOTORS)
            }
            Parts::Gearboxes => {
                let own = self.gearboxes.iter().filter(|g| g.key == key);
                gaps(parts, &own, GEARBOXES)
            }
            Parts::Amplifiers => {
                let own = self.amplifiers.iter().filter(|a| a.key == key);
                gaps(parts, &own, AMPLIFIERS)
            }
            Parts::Resistors => {
                let own = self.resistors.iter().filter(|r| r.key == key);
                gaps(parts, &own, RESISTORS)
            }
        }
    }
}
