//! One part in two rows: the same maker and model, in the same or another spelling, with different figures. Either one row is wrong, or the rows are
//! variants that a buyer cannot distinguish by their designation.

use std::collections::HashMap;

use jred_file::number::rounding::figure;

use super::column::{Column, Kind};
use super::entry::Entry;
use super::fault::Remarks;

/// A figure with its column.
type ColumnValue = (Column, Option<f64>);

/// The rows read so far, by kind and designation.
#[derive(Debug, Default)]
pub(super) struct Duplicates {
    seen: HashMap<(Kind, String), FirstRow>,
}

/// The first row of a part.
#[derive(Debug)]
struct FirstRow {
    key: String,
    place: String,
    figures: Vec<ColumnValue>,
}

/// A designation in small letters and digits: a comma or a p between digits is a decimal point, other punctuation is dropped.
fn plain(name: &str) -> String {
    let letters: Vec<char> = name.chars().flat_map(char::to_lowercase).collect();
    let digit = |at: Option<usize>| {
        at.and_then(|at| letters.get(at))
            .is_some_and(char::is_ascii_digit)
    };
    let plain = letters.iter().enumerate().filter_map(|(k, letter)| {
        let between = digit(k.checked_sub(1)) && digit(Some(k + 1));
        match letter {
            '.' | ',' | 'p' if between => Some('.'),
            // Keeps two numbers apart.
            _ if !letter.is_alphanumeric() => between.then_some(' '),
            _ => Some(*letter),
        }
    });
    plain.collect()
}

/// The kind of a part, the figures that its rows must share, and its ratio, because the model of a gearbox is often a series with several ratios;
/// `None` for a list.
fn figures(entry: &Entry) -> Option<(Kind, Vec<ColumnValue>, String)> {
    let mut ratio = String::new();
    let (kind, figures) = match entry {
        Entry::Motor(m, _) => (
            Kind::Motors,
            vec![
                (Column::RatedTorque, m.rated_torque),
                (Column::RatedSpeed, m.rated_speed),
                (Column::StandstillTorque, m.standstill_torque),
                (Column::PeakTorque, m.peak_torque),
                (Column::MaxSpeed, m.max_speed),
                (Column::RotorInertia, Some(m.rotor_inertia)),
                (Column::TorqueConstant, m.winding.torque_constant),
                (Column::WindingResistance, m.winding.resistance),
                (Column::RatedCurrent, m.winding.rated_current),
                (Column::MainsVoltage, m.mains_voltage),
                (Column::BrakeTorque, m.brake.map(|brake| brake.torque)),
                (Column::Mass, m.mass),
            ],
        ),
        Entry::Gearbox(g) => {
            ratio = figure(g.ratio);
            let figures = vec![
                (Column::RatedOutputTorque, g.rated_torque),
                (Column::PeakOutputTorque, g.peak_torque),
                (Column::EmergencyOutputTorque, g.emergency_torque),
                (Column::RatedInputSpeed, g.rated_speed),
                (Column::MaxInputSpeed, g.max_speed),
                (Column::InputInertia, Some(g.inertia)),
                (Column::Efficiency, Some(g.efficiency)),
                (Column::Stiffness, g.stiffness),
                (Column::Backlash, g.backlash),
                (Column::MaxRadialLoad, g.max_radial_load),
                (Column::MaxAxialLoad, g.max_axial_load),
                (Column::Mass, g.mass),
            ];
            (Kind::Gearboxes, figures)
        }
        Entry::Amplifier(a) => (
            Kind::Amplifiers,
            vec![
                (Column::RatedCurrent, Some(a.rated_current)),
                (Column::PeakCurrent, Some(a.peak_current)),
                (Column::PeakTime, a.peak_time),
                (Column::MainsVoltage, a.mains_voltage),
                (Column::BusVoltage, a.bus_voltage),
                (Column::ChopperVoltage, a.chopper_voltage),
                (Column::MaxVoltage, a.max_voltage),
                (Column::Capacitance, a.capacitance),
                (Column::MinResistance, a.min_resistance),
                (Column::Mass, a.mass),
            ],
        ),
        Entry::Resistor(r) => (
            Kind::Resistors,
            vec![
                (Column::Resistance, Some(r.resistance)),
                (Column::RatedPower, Some(r.rated_power)),
                (Column::PeakPower, r.peak_power),
                (Column::PulseEnergy, r.pulse_energy),
            ],
        ),
        Entry::Listing(_) => return None,
    };
    Some((kind, figures, ratio))
}

impl Duplicates {
    /// Warns of an entry whose part has occurred with different figures.
    pub(super) fn check(
        &mut self,
        remarks: &mut Remarks,
        place: &dyn Fn() -> String,
        entry: &Entry,
    ) {
        let Some(((kind, figures, ratio), [key, maker, model])) = figures(entry).zip(entry.names())
        else {
            return;
        };
        let name = format!("{}|{}|{ratio}", plain(maker), plain(model));
        let Some(first) = self.seen.get(&(kind, name.clone())) else {
            let seen = FirstRow {
                key: key.to_owned(),
                place: place(),
                figures,
            };
            self.seen.insert((kind, name), seen);
            return;
        };
        let pairs = first.figures.iter().zip(&figures);
        let differ = pairs.filter(|((_, one), (_, other))| one != other);
        let differ: Vec<&str> = differ.map(|((column, _), _)| column.name()).collect();
        if differ.is_empty() {
            return;
        }
        remarks.add("rows of one part with different data", || {
            format!(
                "{}: \"{key}\" and \"{}\" ({}) are the same {}, {maker} {model}, but their data differ: {}. Compare them with the data sheet and \
                 remove one row, or give each its full designation",
                place(),
                first.key,
                first.place,
                kind.singular(),
                differ.join(", ")
            )
        });
    }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn what_is_written_in_two_ways_is_one_name() {
        for (one, other) in [
            ("TP050 MA i=38.5", "tp050ma-i 38,5"),
            ("tp050ma-38p5", "TP050-MA-38.5"),
            ("SGMGH-20A", "SGMGH 20A"),
            ("1FK7042-5AF71", "1fk7042 5af71"),
        ] {
            assert_eq!(plain(one), plain(other));
        }
        for (one, other) in [("i=3 5", "i=35"), ("SP60", "SP6"), ("X-1-2", "X-12")] {
            assert_ne!(plain(one), plain(other));
        }
    }
}
