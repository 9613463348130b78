//! Amplifier, DC bus and brake resistor.

use std::fmt::Write as _;

use jred_file::model::rule::Rule;
use jred_file::number::rounding::short;
use jred_sizing::bus::curve::StopPower;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

use crate::list::bus::words::{misses, needed, resistor};

pub(super) fn words(check: &Check) -> (String, String) {
    let place = match &check.grounds {
        Grounds::Bus { .. } => bus(check),
        Grounds::ChosenResistor(key) => {
            format!("of {key}, the smallest brake resistor of the catalogue that fits")
        }
        _ => String::new(),
    };
    (rating(check), place)
}

fn rating(check: &Check) -> String {
    let finding = check.finding;
    let constant = || format!("{} constant of the motor", check.words.torque);
    let rating = match check.id {
        Rule::RmsCurrent if matches!(check.grounds, Grounds::NoAmplifier) => {
            "amplifier (none chosen)"
        }
        Rule::RmsCurrent | Rule::PeakCurrent if finding.value.is_nan() => return constant(),
        Rule::RmsCurrent => return format!("rated current of the amplifier{}", reduced(check)),
        Rule::PeakCurrent if matches!(check.grounds, Grounds::MotorCurrent) => {
            "peak current of the motor"
        }
        Rule::PeakCurrent => return format!("peak current of the amplifier{}", reduced(check)),
        Rule::Overload if finding.rating.is_infinite() => {
            "the current never exceeds the rated current of the amplifier"
        }
        Rule::Overload if finding.value.is_nan() => return constant(),
        Rule::Overload => "(peak current² − rated current²)·peak time of the amplifier",
        Rule::BusVoltage => match check.grounds {
            Grounds::Bus {
                missing: Some(missing),
                ..
            } if !finding.is_known() => missing,
            _ => "maximum voltage of the DC bus",
        },
        Rule::BrakeResistance => "minimum resistance of the chopper",
        Rule::ResistorPower => "continuous power of the brake resistor",
        Rule::ResistorPeak => "peak power of the brake resistor",
        _ => "pulse energy of the brake resistor",
    };
    rating.to_owned()
}

/// Note that the site reduces the amplifier's currents.
fn reduced(check: &Check) -> String {
    match check.grounds {
        Grounds::AmplifierCurrent(factor) if factor < 1.0 => {
            format!(", reduced to {} % at the site", short(100.0 * factor))
        }
        _ => String::new(),
    }
}

/// Regenerated energy, and the brake resistor it would require.
fn bus(check: &Check) -> String {
    let Grounds::Bus {
        back,
        stop,
        taken,
        chopper_voltage,
        need,
        misses: missed,
        ..
    } = &check.grounds
    else {
        return String::new();
    };
    let finding = check.finding;
    if *back == 0.0 && stop.is_none() {
        return "no energy is fed back".to_owned();
    }
    let mut words = format!("{} J are fed back per cycle", short(*back));
    if let Some(StopPower { peak, energy }) = stop {
        let _ = write!(
            words,
            ", {} J and at most {} W in a stop by the drive",
            short(*energy),
            short(*peak)
        );
    }
    if finding.is_known() && finding.value.is_infinite() {
        words += ", more than is drawn: without a brake resistor the voltage rises without limit";
    }
    if *taken {
        return words;
    }
    if let Some(need) = need {
        if finding.value <= finding.rating {
            let on = chopper_voltage.map_or_else(String::new, short);
            return format!(
                "{words}; no brake resistor is needed (one of {} holds the bus at {on} V)",
                resistor(need)
            );
        }
        let none = missed.as_ref().map_or_else(
            || "neither [supply] nor the catalogue has one".to_owned(),
            misses,
        );
        words = format!("{words}, {}; {none}", needed(need));
    } else if chopper_voltage.is_none() && finding.value > finding.rating {
        words += "; no data for the voltage at which a brake resistor switches on, chopper_voltage of the amplifier or of [supply], so that none can be chosen";
    }
    words
}
