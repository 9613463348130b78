//! Filters, against the words that describe them.

use glob::Pattern;
use jred_sizing::drive::Drive;
use jred_sizing::filter::Filter;
use jred_sizing::size::Selection;

use super::support::press_text;
use super::{case, priced};

fn pattern(text: &str) -> Vec<Pattern> {
    vec![Pattern::new(text).unwrap()]
}

/// A filter leaves exactly the drives that its words describe, counted over the whole catalogue by hand.
#[test]
fn filters_leave_what_they_say() {
    let case = case(&press_text(), 64);
    let all = priced();
    let motors = all.motors.len();
    let count = |filter: &Filter, expected: &dyn Fn(&Drive) -> bool| {
        let mut thinned = all.clone();
        filter.thin(&mut thinned).unwrap();
        let prepared = thinned.prepare(&case.file.site);
        let mut selection = Selection::new(
            &thinned,
            &prepared,
            &case.cycle,
            &case.file.site,
            &case.file.rules,
        );
        filter.sift(&mut selection);
        let mut found: Vec<String> = selection
            .fit
            .iter()
            .chain(&selection.refused)
            .map(|c| c.drive.name())
            .collect();
        let mut wanted: Vec<String> = all
            .drives()
            .filter(|(_, drive)| expected(drive))
            .map(|(_, drive)| drive.name())
            .collect();
        found.sort();
        wanted.sort();
        assert_eq!(found, wanted, "{filter:?}");
        found.len()
    };
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
        message.contains(&format!("none of the {motors} motors")),
        "{message}"
    );
}
