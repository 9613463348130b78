//! The figures by which drives are compared: missing ones, and shares of the allowed value.

use super::{case, catalogue, priced};
use crate::support::{near, press_text};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Limit;
use jred_sizing::catalogue::{Catalogue, MotorKind};
use jred_sizing::select::fit::{fit_input, input_kind};
use jred_sizing::select::pareto::Front;
use jred_sizing::select::rank::Objective;
use jred_sizing::select::size::{Candidate, Selection};

/// If no suitable drive has a figure there is nothing to compare; the sentence names the missing figures and no other.
#[test]
fn an_empty_front_says_what_is_missing() {
    let case = case(&press_text(), 200);
    let select = |from: &Catalogue, objectives: &[Objective]| {
        let prepared = from.prepare(&case.file.site);
        let (cycle, site, rules) = (&case.cycle, &case.file.site, &case.file.rules);
        let selection = Selection::new(from, &prepared, cycle, site, rules);
        let front = Front::new(&selection, objectives);
        (front.fit, front.obstacle().map(|report| report.to_string()))
    };
    let bare = Catalogue {
        amplifiers: Vec::new(),
        ..catalogue()
    };
    let objectives = [Objective::Power, Objective::Price];
    let (fit, words) = select(&bare, &objectives);
    let words = words.unwrap();
    assert!(
        words.starts_with(&format!("{fit} drives are suitable")),
        "{words}"
    );
    assert!(words.contains("none has data for the price"), "{words}");
    assert!(!words.contains(Objective::Power.word()), "{words}");
    assert_eq!(select(&priced(), &objectives).1, None);
    assert_eq!(select(&Catalogue::default(), &objectives), (0, None));
}

/// At high altitude the allowed rise is smaller, 10 % at 2000 m: the same drive in the same duty uses a larger share of it.
#[test]
fn a_rise_is_compared_with_what_is_allowed() {
    let mut case = case(&press_text(), 200);
    let catalogue = catalogue();
    let share = |case: &super::Case| {
        let motors = catalogue.prepare(&case.file.site);
        let (cycle, site, rules) = (&case.cycle, &case.file.site, &case.file.rules);
        let selection = Selection::new(&catalogue, &motors, cycle, site, rules);
        let wanted = |drive: &jred_sizing::catalogue::Drive| {
            drive.motor.rated_torque.is_some() && drive.gearbox.is_some()
        };
        let candidate = selection.find(wanted).unwrap();
        let finding = selection.context(&candidate).findings(rules);
        let finding = finding.get(Rule::WindingTemperature).unwrap();
        let value = Objective::Temperature
            .value(&selection, &candidate)
            .unwrap();
        near("share", value, finding.value / finding.rating, 1e-12);
        (candidate.drive.name(), value)
    };
    case.file.site.surroundings.altitude = 0.0;
    let (below, low) = share(&case);
    case.file.site.surroundings.altitude = 2000.0;
    let (above, high) = share(&case);
    if below == above {
        near("at 2000 m", high, low / 0.9, 1e-9);
    }
}

/// The next smaller motor against every refused drive: no refused drive has a power between it and the smallest suitable motor, which itself is
/// refused with other gearboxes. Of the next motor's drives the closest one is named.
#[test]
fn no_refused_motor_lies_between_the_smallest_and_the_next() {
    let mut case = case(&press_text(), 200);
    let catalogue = catalogue();
    let prepared = catalogue.prepare(&case.file.site);
    let power = |candidate: &Candidate| candidate.drive.motor.rated_power();
    let select = |case: &super::Case| {
        let (cycle, site, rules) = (&case.cycle, &case.file.site, &case.file.rules);
        let selection = Selection::new(&catalogue, &prepared, cycle, site, rules);
        let ranking = selection.ranking(MotorKind::Rotary.vocabulary());
        assert!(ranking.contains("the smallest motor first"), "{ranking}");
        let next = selection.next_smaller();
        let fit = selection.first_fit(usize::MAX);
        let refused = selection.first_refused(usize::MAX);
        let least = fit.iter().filter_map(power).reduce(f64::min);
        let next = next.map(|next| (power(&next).unwrap(), next.drive.name()));
        (
            next,
            least,
            fit.len(),
            refused
                .iter()
                .map(|c| (power(c), c.drive.name()))
                .collect::<Vec<_>>(),
        )
    };
    let (next, least, _, refused) = select(&case);
    let (next, name) = next.unwrap();
    let least = least.unwrap();
    assert!(next < least, "{next} W, {least} W fit");
    assert!(
        refused.iter().any(|(power, _)| *power == Some(least)),
        "no drive at the edge"
    );
    assert!(
        refused
            .iter()
            .any(|(power, _)| power.is_some_and(|power| power < next))
    );
    let between = |power: &f64| next < *power && *power < least;
    assert!(
        !refused
            .iter()
            .any(|(power, _)| power.as_ref().is_some_and(between))
    );
    let closest = refused
        .iter()
        .find(|(power, _)| *power == Some(next))
        .unwrap();
    assert_eq!(closest.1, name);
    // Without a limit every motor is suitable, and none is smaller; if none is suitable none is next.
    case.file.rules.set(
        Rule::Speed,
        Limit {
            fail: Some(1e-9),
            warn: None,
        },
    );
    let (next, _, fit, _) = select(&case);
    assert_eq!((next, fit), (None, 0));
    for rule in Rule::ALL {
        case.file.rules.set(rule, Limit::default());
    }
    let (next, _, fit, refused) = select(&case);
    assert_eq!(next, None, "of {fit} that fit, {} refused", refused.len());
}

/// Each column is named after its figure, with its unit if it has one.
#[test]
fn columns_are_named_after_their_figures() {
    for (objective, unit) in [
        (Objective::Power, " [W]"),
        (Objective::Mass, " [kg]"),
        (Objective::Price, ""),
        (Objective::Energy, " [J]"),
        (Objective::Margin, ""),
    ] {
        let column = objective.column();
        assert!(column.ends_with(&format!("{objective}{unit}")), "{column}");
    }
    assert!(Objective::Temperature.column().contains("temperature"));
}

/// A sliding drive link needs a linear motor, unless a drive train makes it rotary; a catalogue without one is refused, with the cure.
#[test]
fn motors_are_of_the_kind_of_the_input() {
    let slide = include_str!("../../../../machines/linear-gripper.toml").to_owned();
    let screw = include_str!("../../../../machines/excavator-bucket.toml").to_owned();
    for (text, kind) in [
        (press_text(), MotorKind::Rotary),
        (slide, MotorKind::Linear),
        (screw, MotorKind::Rotary),
    ] {
        let file =
            jred_analysis::checked::parse("machine.toml", &text, std::path::Path::new("")).unwrap();
        assert_eq!(input_kind(&file), kind, "{text}");
        let mut rotary = catalogue();
        rotary.keep_kind(MotorKind::Rotary);
        let all = rotary.motors.len();
        let found = fit_input(&mut rotary, &file);
        if kind == MotorKind::Rotary {
            assert!(found.is_ok() && rotary.motors.len() == all);
        } else {
            let words = found.unwrap_err().to_string();
            assert!(words.contains("rotary motors only"), "{words}");
        }
        let mut none = Catalogue::default();
        let words = fit_input(&mut none, &file).unwrap_err().to_string();
        assert_eq!(
            words.contains("slides"),
            kind == MotorKind::Linear,
            "{words}"
        );
    }
}
