//! Temperature of winding and housing.

use jred_file::model::operation::{Duty, Operation};
use jred_file::model::rule::Rule;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;
use jred_sizing::thermal::classify::DutyType;

pub(super) fn words(check: &Check) -> (String, String) {
    let (heating, surroundings, duty, found) = match &check.grounds {
        Grounds::NoHeat(missing) => return (missing(check.words), String::new()),
        Grounds::Heat {
            heating,
            surroundings,
            duty,
            found,
        } => (heating, surroundings, duty, found),
        _ => return Default::default(),
    };
    let torque = check.words.torque;
    let ambient = surroundings.ambient;
    let rating = match check.id {
        Rule::HousingTemperature if !heating.housing => {
            "thermal resistances of winding and housing".to_owned()
        }
        _ if check.finding.rating.is_nan() => "maximum temperature of the winding".to_owned(),
        Rule::HousingTemperature => {
            format!("rise from {ambient} °C to the maximum temperature of the housing")
        }
        _ if heating.relative => format!("rise at the S1 {torque}"),
        _ => {
            let thin = if surroundings.altitude_factor() < 1.0 {
                let altitude = surroundings.altitude;
                format!(", less 1 % per 100 m above 1000 m at {altitude} m")
            } else {
                String::new()
            };
            format!("rise from {ambient} °C to the maximum temperature of the winding{thin}")
        }
    };
    let mut place = heating.notes(torque);
    place.push(operation(duty, found));
    (rating, place.join(", "))
}

/// The duty type.
fn operation(duty: &Duty, found: &DutyType) -> String {
    match duty.operation {
        Operation::Continuous => match duty.kind {
            Some(stated) if stated != found.number => format!("{found} (given: S{stated})"),
            _ => found.to_string(),
        },
        Operation::Short { operating } => {
            format!("duty type S2, after {operating} s from cold")
        }
        Operation::Intermittent {
            operating, rest, ..
        } => format!(
            "duty type S{}, {operating} s of operation and {rest} s of rest",
            duty.kind.unwrap_or(3)
        ),
    }
}
