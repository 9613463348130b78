//! Finding drives: gear ratios in closed form, ranking, filters, Pareto fronts.
// Copied figures are exact.
#![allow(clippy::float_cmp)]

mod engineer;
mod figures;
mod filter;
mod obstacle;
mod ratio;
mod requirement;

use std::path::Path;

use crate::brute;
use crate::support::{budget, near, press_text};
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Limit;
use jred_sizing::catalogue::{Catalogue, MotorKind};
use jred_sizing::cycle::Cycle;
use jred_sizing::select::pareto::Front;
use jred_sizing::select::rank::{Objective, rank};
use jred_sizing::select::size::{Certainty, Selection};

const RACK: &str = include_str!("../../../machines/rack.toml");

struct Case {
    file: MachineFile,
    duty: Duty,
    cycle: Cycle,
}

fn case(text: &str, steps: usize) -> Case {
    let file = checked::parse("machine.toml", text, Path::new("")).unwrap();
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
    let cycle = Cycle::new(&duty);
    Case { file, duty, cycle }
}

/// A case in which plain loops use the same data as sizing.
fn sampled(text: &str, steps: usize) -> Case {
    let case = case(text, steps);
    let duty = brute::sampled(case.duty);
    let cycle = Cycle::new(&duty);
    Case {
        duty,
        cycle,
        ..case
    }
}

fn catalogue() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

/// The drives of a case, some with masses and prices by their index.
fn priced() -> Catalogue {
    let mut catalogue = catalogue();
    for (k, motor) in catalogue.motors.iter_mut().enumerate() {
        motor.mass = (k % 3 != 0).then_some(2.0 + (k * 7 % 13) as f64);
        // Lighter ones are more expensive.
        motor.price = (k % 4 != 1).then_some(1000.0 - (k * 7 % 13) as f64 * 40.0 + (k % 3) as f64);
    }
    for (k, gearbox) in catalogue.gearboxes.iter_mut().enumerate() {
        gearbox.mass = Some(1.0 + (k % 5) as f64);
        gearbox.price = Some(200.0 + (k % 7) as f64 * 30.0);
    }
    catalogue.amplifiers.clear();
    catalogue
}

#[test]
fn ranked_by_what_was_asked_for() {
    let case = sampled(&press_text(), 200);
    let catalogue = priced();
    let prepared = catalogue.prepare(&case.file.site);
    let select = || {
        Selection::new(
            &catalogue,
            &prepared,
            &case.cycle,
            &case.file.site,
            &case.file.rules,
        )
    };
    for objective in [
        Objective::Power,
        Objective::Mass,
        Objective::Price,
        Objective::Energy,
        Objective::Margin,
    ] {
        let mut selection = select();
        let before = selection.fit.len();
        let unknown = rank(&mut selection, objective);
        assert_eq!(selection.fit.len(), before);
        let values: Vec<Option<f64>> = selection
            .fit
            .known()
            .iter()
            .map(|c| objective.value(&selection, c))
            .collect();
        // Uncertain ones come last, then unknown ones.
        let doubts = selection.fit.known().iter();
        let doubts: Vec<_> = doubts
            .map(|c| Certainty::of(&c.drive, &c.outcome))
            .collect();
        assert!(doubts.is_sorted());
        assert_eq!(
            values.iter().filter(|value| value.is_none()).count(),
            unknown
        );
        let sign = if objective == Objective::Margin {
            -1.0
        } else {
            1.0
        };
        for equal in doubts.chunk_by(|a, b| a == b) {
            let begin = doubts.partition_point(|doubt| doubt < &equal[0]);
            let group = &values[begin..begin + equal.len()];
            let known = group.partition_point(Option::is_some);
            assert!(group[known..].iter().all(Option::is_none));
            assert!(
                group[..known].is_sorted_by(|a, b| sign * a.unwrap() <= sign * b.unwrap()),
                "{objective:?}: {group:?}"
            );
        }
        let missing = selection.fit.known().iter().filter(|c| match objective {
            Objective::Mass => c.drive.motor.mass.is_none(),
            Objective::Price => c.drive.motor.price.is_none(),
            _ => false,
        });
        assert_eq!(missing.count(), unknown, "{objective:?}");
    }
    // By hand: mass and energy of a drive.
    let selection = select();
    let candidate = selection
        .fit
        .known()
        .iter()
        .find(|c| c.drive.motor.mass.is_some() && c.drive.gearbox.is_some())
        .unwrap();
    let drive = candidate.drive;
    let mass = drive.motor.mass.unwrap() + drive.gearbox.unwrap().mass.unwrap();
    assert_eq!(Objective::Mass.value(&selection, candidate), Some(mass));
    let put_in = case.duty.integral(|i| {
        let point = drive.motor_point(i);
        (point.torque * point.speed).max(0.0)
    });
    near(
        "energy",
        Objective::Energy.value(&selection, candidate).unwrap(),
        put_in,
        budget::PREPARED_CYCLE,
    );
    // Without any price the ranking stays, and so does its text.
    let bare = Catalogue {
        amplifiers: Vec::new(),
        ..self::catalogue()
    };
    let prepared = bare.prepare(&case.file.site);
    let mut selection = Selection::new(
        &bare,
        &prepared,
        &case.cycle,
        &case.file.site,
        &case.file.rules,
    );
    let names = |selection: &Selection| {
        let fit = selection.first_fit(usize::MAX);
        fit.iter().map(|c| c.drive.name()).collect::<Vec<_>>()
    };
    let words = |selection: &Selection| selection.ranking(MotorKind::Rotary.vocabulary());
    let (before, ranking) = (names(&selection), words(&selection));
    assert_eq!(rank(&mut selection, Objective::Price), before.len());
    assert_eq!((names(&selection), words(&selection)), (before, ranking));
}

/// The front against its definition: every pair compared.
#[test]
#[ignore = "more than five seconds of a processor"]
fn the_front_is_what_nothing_beats() {
    let mut case = case(&press_text(), 200);
    // More drives to compare.
    for rule in Rule::ALL {
        case.file.rules.set(rule, Limit::default());
    }
    let catalogue = priced();
    let prepared = catalogue.prepare(&case.file.site);
    let selection = Selection::new(
        &catalogue,
        &prepared,
        &case.cycle,
        &case.file.site,
        &case.file.rules,
    );
    for objectives in [
        &[Objective::Mass, Objective::Price][..],
        &[Objective::Energy, Objective::Mass],
        &[Objective::Power, Objective::Energy, Objective::Price],
    ] {
        let front = Front::new(&selection, objectives);
        let values: Vec<(String, Vec<f64>)> = (selection.first_fit(usize::MAX).iter())
            .filter_map(|c| {
                let values: Option<Vec<f64>> =
                    objectives.iter().map(|o| o.value(&selection, c)).collect();
                Some((c.drive.name(), values?))
            })
            .collect();
        assert_eq!(front.compared, values.len());
        // One sentence for each objective for which a suitable drive has no data, and no other.
        let missing = |objective: &&Objective| {
            let fit = selection.first_fit(usize::MAX);
            fit.iter().any(|c| objective.value(&selection, c).is_none())
        };
        let missing: Vec<&Objective> = objectives.iter().filter(missing).collect();
        let gaps = front.gaps();
        assert_eq!(gaps.len(), missing.len(), "{gaps:?}");
        for (gap, objective) in gaps.iter().zip(missing) {
            assert!(gap.contains(objective.word()), "{gap}");
        }
        let beaten = |own: &[f64]| {
            values.iter().any(|(_, other)| {
                other.iter().zip(own).all(|(a, b)| a <= b)
                    && other.iter().zip(own).any(|(a, b)| a < b)
            })
        };
        let mut expected: Vec<&str> = values
            .iter()
            .filter(|(_, own)| !beaten(own))
            .map(|(name, _)| name.as_str())
            .collect();
        let mut found: Vec<String> = front
            .points
            .iter()
            .map(|p| p.candidate.drive.name())
            .collect();
        expected.sort_unstable();
        found.sort_unstable();
        assert_eq!(found, expected, "{objectives:?}");
        assert!(
            found.len() > 1 && found.len() < values.len() / 4,
            "{} of {}",
            found.len(),
            values.len()
        );
    }
}

/// Temperatures of motors with different data are compared as shares of the allowed rise, not as kelvins: of two equal motors the one with known
/// thermal resistances does not count as warmer.
#[test]
fn temperatures_are_compared_as_shares() {
    let case = case(&press_text(), 200);
    let catalogue = catalogue();
    let motors = catalogue.prepare(&case.file.site);
    let selection = Selection::new(
        &catalogue,
        &motors,
        &case.cycle,
        &case.file.site,
        &case.file.rules,
    );
    let mut compared = 0;
    for candidate in &selection.first_fit(usize::MAX) {
        let Some(value) = Objective::Temperature.value(&selection, candidate) else {
            continue;
        };
        let judged = selection.judged(candidate);
        let check = judged
            .checks
            .iter()
            .find(|check| check.id == Rule::WindingTemperature)
            .unwrap();
        near(
            "share",
            value,
            check.value.unwrap() / check.limit.unwrap(),
            1e-12,
        );
        compared += 1;
    }
    assert!(compared > 0);
}

/// The search for the best drive alone finds the first of all.
#[test]
fn the_best_drive_is_the_first_of_all() {
    let hoist = include_str!("../../../machines/hoist.toml");
    for text in [&press_text(), RACK, hoist] {
        let (case, catalogue) = (case(text, 200), catalogue());
        let (site, rules) = (&case.file.site, &case.file.rules);
        let motors = catalogue.prepare(site);
        let all = Selection::new(&catalogue, &motors, &case.cycle, site, rules);
        let best = Selection::best(&catalogue, &motors, &case.cycle, site, rules).unwrap();
        assert!(best.is_same_drive(all.fit.first().unwrap()));
    }
}
