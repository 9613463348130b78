//! A judged drive: assumptions, use of limits, and the keys of missing data.

use jred_file::model::rules::{Limit, RuleVerdict};
use jred_report::list::rule_words::{assumptions, reasons, warnings};
use jred_sizing::catalogue::Amplifier;
use jred_sizing::judge::{Assessment, Outcome, cure};

use super::{Context, Drive, Rule, RuleSet, Stand, near, press_text};

/// Every part with second-hand data is named, and no other.
#[test]
fn second_hand_data_are_named() {
    let mut stand = Stand::press();
    let prepared = stand.prepared();
    for k in 0..8_u8 {
        let own = |part: u8| k & (1 << part) != 0;
        stand.motor.from_maker = own(0);
        stand.gearbox.from_maker = own(1);
        let amplifier = Amplifier {
            from_maker: own(2),
            ..Amplifier::default()
        };
        let drive = Drive {
            amplifier: Some(&amplifier),
            ..stand.drive(true)
        };
        let context = Context::new(&stand.cycle, &stand.file.site, drive, &prepared);
        let said = assumptions(&drive, &context.assumptions(&RuleSet::default()));
        for (part, name) in (0..).zip(["motor", "gearbox", "amplifier"]) {
            let words = format!("{name} data not taken from the maker's own document");
            assert_eq!(
                said.iter().any(|said| said.starts_with(&words)),
                !own(part),
                "{said:?}"
            );
        }
    }
}

/// The verdict of a drive is that of its worst rule; its use of a limit is figure over limit, its power T·n of the rated point.
#[test]
fn a_judged_drive_in_figures() {
    let mut stand = Stand::press();
    let judged = |stand: &Stand| {
        let prepared = stand.prepared();
        let context = Context::new(&stand.cycle, &stand.file.site, stand.drive(true), &prepared);
        let judged = Assessment::new(&context, &stand.file.rules);
        let found = context
            .findings(&stand.file.rules)
            .get(Rule::Speed)
            .unwrap();
        let used = (judged.used(Rule::Speed), judged.used(Rule::BusVoltage));
        assert_eq!(
            judged.holds(),
            judged.checks.iter().all(|c| c.verdict != RuleVerdict::Fail)
        );
        near(
            "power",
            judged.rated_power().unwrap(),
            8.0 * 100.0 * std::f64::consts::PI,
            1e-12,
        );
        (
            found.value / found.rating,
            used,
            judged.holds(),
            reasons(&judged),
            warnings(&judged).next(),
        )
    };
    // Only the speed is judged: at 100 %, and at limits of which the drive uses half or twice.
    let (share, ..) = judged(&stand);
    for rule in Rule::ALL {
        stand.file.rules.set(rule, Limit::default());
    }
    for (limit, said, holds) in [
        (2.0 * share, "50 %", true),
        (0.5 * share, "200 %", false),
        (0.05 * share, "> 1000 %", false),
    ] {
        let fail = Some(limit);
        stand
            .file
            .rules
            .set(Rule::Speed, Limit { fail, warn: None });
        let (_, used, found, reasons, _) = judged(&stand);
        assert_eq!(used, (said.to_owned(), String::new()));
        assert_eq!((found, reasons.is_empty()), (holds, holds), "{reasons}");
    }
    // At the limit the rule is satisfied.
    stand.file.rules.set(
        Rule::Speed,
        Limit {
            fail: Some(share),
            warn: None,
        },
    );
    assert!(judged(&stand).2);
    // A rule that only warns is satisfied, and is the first of the warnings.
    for (limit, warns) in [(1.01 * share, false), (0.99 * share, true)] {
        let warn = Some(limit);
        stand
            .file
            .rules
            .set(Rule::Speed, Limit { fail: None, warn });
        let (.., holds, _, warning) = judged(&stand);
        assert!(holds);
        let said = warning.is_some_and(|said| said.starts_with("speed "));
        assert_eq!(said, warns);
    }
}

/// The keys named for a rule's missing data are keys of the catalogue or of the machine file.
#[test]
fn missing_data_have_a_place() {
    let documents = [
        include_str!("../../../../docs/catalogue.md"),
        include_str!("../../../../docs/machine-file.md"),
        include_str!("../../../../docs/thermal-and-bus.md"),
    ]
    .concat();
    for rule in Rule::ALL {
        let words = cure(rule);
        let part = |word: &&str| word.chars().any(|c| c == '_' || c == '[');
        let keys = words.split([' ', ',', ';', '.']).filter(part);
        for key in keys {
            assert!(documents.contains(key), "{rule:?}: {key} is in no document");
        }
        let place = [
            "catalogue",
            "[supply]",
            "[rules]",
            "[stiffness]",
            "motor",
            "machine file",
        ];
        assert!(
            place.iter().any(|place| words.contains(place)),
            "{rule:?}: {words}"
        );
    }
}

/// The unchecked rules are counted: for a motor without limits every rule that needs one of its figures.
#[test]
fn rules_that_are_not_checked_are_counted() {
    let mut stand = Stand::new(&press_text());
    let rules = RuleSet::default();
    let mut open = Vec::new();
    for _ in 0..2 {
        let prepared = stand.prepared();
        let context = Context::new(&stand.cycle, &stand.file.site, stand.drive(true), &prepared);
        let found = Outcome::of(&rules, &context.findings(&rules)).not_checked;
        let checks = context.checks(&rules);
        let unknown = checks
            .iter()
            .filter(|c| c.verdict == RuleVerdict::NotChecked);
        assert_eq!(found.count(), unknown.count());
        assert_eq!(found.count(), found.iter().count());
        open.push(found.count());
        stand.motor.max_speed = None;
        stand.gearbox.max_speed = None;
        stand.gearbox.peak_torque = None;
    }
    assert!(open[0] + 2 <= open[1], "{open:?}");
}
