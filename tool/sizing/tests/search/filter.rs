//! Filters, against the words that describe them.

use glob::Pattern;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::catalogue::Drive;
use jred_sizing::select::filter::Filter;
use jred_sizing::select::size::Selection;

use super::{case, catalogue, priced};
use crate::support::press_text;

fn pattern(text: &str) -> Vec<Pattern> {
    vec![Pattern::new(text).unwrap()]
}

/// Number of drives that a filter leaves: exactly those of the whole catalogue that satisfy `expected`.
fn count(all: &Catalogue, filter: &Filter, expected: &dyn Fn(&Drive) -> bool) -> usize {
    let case = case(&press_text(), 64);
    let mut thinned = all.clone();
    filter.thin(&mut thinned).unwrap();
    let prepared = thinned.prepare(&case.file.site);
    let (site, rules) = (&case.file.site, &case.file.rules);
    let mut selection = Selection::new(&thinned, &prepared, &case.cycle, site, rules);
    filter.sift(&mut selection);
    let left = selection.fit.drives().chain(selection.refused.drives());
    let mut found: Vec<String> = left.map(|drive| drive.name()).collect();
    let wanted = all.drives().filter(|(_, drive)| expected(drive));
    let mut wanted: Vec<String> = wanted.map(|(_, drive)| drive.name()).collect();
    found.sort();
    wanted.sort();
    assert_eq!(found, wanted, "{filter:?}");
    found.len()
}

/// A filter leaves exactly the drives of its description, counted over the whole catalogue by hand.
#[test]
fn filters_leave_what_they_say() {
    let all = priced();
    let motors = all.motors.len();
    let count = |filter: &Filter, expected: &dyn Fn(&Drive) -> bool| count(&all, filter, expected);
    let everything = count(&Filter::default(), &|_| true);
    assert_eq!(everything, all.count());
    assert_eq!(
        count(
            &Filter {
                direct_only: true,
                ..Filter::default()
            },
            &|d| d.gearbox.is_none()
        ),
        motors
    );
    let some = count(
        &Filter {
            motors: pattern("SGM?H-*"),
            ..Filter::default()
        },
        &|d| d.motor.key.starts_with("sgm") && d.motor.key.as_bytes().get(4..6) == Some(b"h-"),
    );
    assert!(some > 0 && some < everything);
    count(
        &Filter {
            gearboxes: pattern("npt0*"),
            ..Filter::default()
        },
        &|d| d.gearbox.is_some_and(|g| g.key.starts_with("npt0")),
    );
    count(
        &Filter {
            makers: pattern("yaskawa"),
            ..Filter::default()
        },
        &|d| d.motor.maker == "Yaskawa" && d.gearbox.is_none_or(|g| g.maker == "Yaskawa"),
    );
    count(
        &Filter {
            ratio: Some([3.0, 5.0]),
            ..Filter::default()
        },
        &|d| (3.0..=5.0).contains(&d.ratio()),
    );
    count(
        &Filter {
            ratio: Some([1.0, 3.0]),
            ..Filter::default()
        },
        &|d| (1.0..=3.0).contains(&d.ratio()),
    );
    count(
        &Filter {
            max_mass: Some(6.0),
            ..Filter::default()
        },
        &|d| {
            d.motor
                .mass
                .is_some_and(|m| m + d.gearbox.map_or(0.0, |g| g.mass.unwrap()) <= 6.0)
        },
    );
    for (name, gearbox) in [
        ("sgmsh-15a", None),
        ("sgmsh-15a+npt035mf-10", Some("npt035mf-10")),
    ] {
        let found = count(
            &Filter {
                drive: Some(name.to_owned()),
                ..Filter::default()
            },
            &|d| d.motor.key == "sgmsh-15a" && d.gearbox.map(|g| g.key.as_str()) == gearbox,
        );
        assert_eq!(found, 1, "{name}");
    }
    count(
        &Filter {
            max_price: Some(700.0),
            ..Filter::default()
        },
        &|d| {
            d.motor
                .price
                .is_some_and(|m| m + d.gearbox.map_or(0.0, |g| g.price.unwrap()) <= 700.0)
        },
    );
    let nothing = Filter {
        motors: pattern("nobody"),
        ..Filter::default()
    };
    let message = nothing.thin(&mut all.clone()).unwrap_err().to_string();
    assert!(
        message.contains(&format!("no motor in the catalogue ({motors} in total)")),
        "{message}"
    );
}

/// A filter keeps the order of refused drives, however many were refused before: of 200 motors that are all too weak the strongest is closest.
#[test]
fn the_nearest_of_what_a_filter_leaves() {
    let case = case(&press_text(), 100);
    let mut catalogue = catalogue();
    let pattern = catalogue.motors[0].clone();
    catalogue.gearboxes.clear();
    catalogue.amplifiers.clear();
    catalogue.motors = (0..200)
        .map(|k| {
            let torque = 0.01 + 1e-4 * f64::from((k * 37) % 200);
            jred_sizing::catalogue::Motor {
                key: format!("m{k}"),
                rated_torque: Some(torque),
                standstill_torque: Some(torque),
                mass: Some(if k % 2 == 0 { 1.0 } else { 3.0 }),
                ..pattern.clone()
            }
        })
        .collect();
    let motors = catalogue.prepare(&case.file.site);
    let mut selection = Selection::new(
        &catalogue,
        &motors,
        &case.cycle,
        &case.file.site,
        &case.file.rules,
    );
    assert!(selection.fit.is_empty());
    let filter = Filter {
        max_mass: Some(2.0),
        ..Filter::default()
    };
    filter.sift(&mut selection);
    assert_eq!(selection.refused.len(), 100);
    let torques: Vec<f64> = (selection.refused.known().iter())
        .map(|candidate| candidate.drive.motor.rated_torque.unwrap())
        .collect();
    assert!(torques.is_sorted_by(|a, b| a > b), "{torques:?}");
}
