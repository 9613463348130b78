//! The motor.

use std::fmt::Write as _;

use jred_file::model::rule::Rule;
use jred_file::number::rounding::short;
use jred_file::units::Vocabulary;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

pub(super) fn words(check: &Check) -> (String, String) {
    let Vocabulary {
        torque,
        inertia,
        rotor,
        ..
    } = check.words;
    let mut rating = match check.id {
        Rule::RmsTorque => format!("S1 {torque} at mean speed"),
        Rule::PeakTorque => format!("peak {torque} at that speed"),
        Rule::Speed => "maximum speed".to_owned(),
        Rule::HoldingTorque | Rule::ConstantTorque => format!("standstill {torque}"),
        _ => format!("times the {rotor}'s {inertia}"),
    };
    let place = match check.grounds {
        Grounds::PeakAt(speed) => format!(
            "at {}, where the cycle comes closest to the envelope",
            check.words.speed(speed)
        ),
        Grounds::SelfLocking => "the gearbox is self-locking and holds by itself".to_owned(),
        Grounds::Holding { dwell, time, given } => held(check, dwell, time, given),
        Grounds::InertiaRatio { of, moves: None } => of.words().to_owned(),
        Grounds::InertiaRatio {
            of,
            moves: Some(moves),
        } => {
            let moves = short(moves);
            if !check.finding.is_known() {
                rating = format!(
                    "a limit for {moves} moves per minute; prefer the value from the data sheet"
                );
            }
            format!("{}, for {moves} moves per minute", of.words())
        }
        _ if check.id == Rule::ConstantTorque => format!("{torque} of weight and friction only"),
        _ => String::new(),
    };
    (rating, place)
}

/// How the holding torque was determined.
fn held(check: &Check, dwell: Option<f64>, time: f64, given: bool) -> String {
    let torque = check.words.torque;
    let mut place = String::new();
    if check.finding.value > 0.0 {
        place = format!("{torque} at standstill, with friction that opposes the motor");
    }
    if let Some(longest) = dwell {
        let whose = if given { "" } else { ", which is not given" };
        let before = if place.is_empty() { "" } else { "; " };
        let _ = write!(
            place,
            "{before}process loads in a dwell, held for at most {} s, are judged by RMS {torque} and temperature, \
             because the time constant of the winding is {} s{whose}",
            short(longest),
            short(time)
        );
    }
    place
}
