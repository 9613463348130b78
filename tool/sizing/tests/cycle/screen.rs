//! Screening of a whole catalogue against full judging: the same verdicts, the same first drives in order.

use std::cell::Cell;
use std::cmp::Ordering;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_analysis::duty::mechanics::ElementLoad;
use jred_file::model::drive_element::{BeltForm, DriveElement, ElementKind};
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::rules::{Limit, RuleSet};
use jred_file::model::site::Site;
use jred_file::model::supply::BrakeResistor;
use jred_report::list::rule_words::missing;
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Amplifier, Catalogue, Gearbox, Motor};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::{Context, Outcome};
use jred_sizing::select::size::{Candidate, FIRST, Group, Selection};

use super::catalogue::with_more_ratios;
use super::random::duty;
use super::runner;
use crate::press_duty;
use crate::support::press_text;

/// Every drive in full, in the order of docs/sizing-rules.md: suitable ones, then refused ones.
fn plainly(
    catalogue: &Catalogue,
    cycle: &Cycle,
    site: &Site,
    rules: &RuleSet,
) -> [Vec<(String, Outcome)>; 2] {
    let motors = catalogue.prepare(site);
    let mut lists = [Vec::new(), Vec::new()];
    for (id, drive) in catalogue.drives() {
        let outcome = Context::new(cycle, site, drive, &motors[id.motor()]).outcome(rules);
        lists[usize::from(outcome.verdict == RuleVerdict::Fail)].push((drive, outcome));
    }
    let [fit, refused] = &mut lists;
    fit.sort_by(|(a, x), (b, y)| {
        (doubt(a, x).cmp(&doubt(b, y)))
            .then_with(|| by_size((a, x.warnings > 0), (b, y.warnings > 0)))
    });
    refused.sort_by(|(a, x), (b, y)| {
        (x.beyond_all_limits.cmp(&y.beyond_all_limits))
            .then((x.worst_use as f32).total_cmp(&(y.worst_use as f32)))
            .then_with(|| by_size((a, false), (b, false)))
    });
    lists.map(|list| {
        let named = list.into_iter().map(|(drive, found)| (drive.name(), found));
        named.collect()
    })
}

/// Uncertainty of a suitable drive.
fn doubt(drive: &Drive, found: &Outcome) -> i32 {
    let amplifier = drive.amplifier;
    let stranger = amplifier.is_some_and(|a| a.maker != drive.motor.maker);
    let unknown = drive.gearbox.is_some_and(|g| g.peak_torque.is_none());
    let lacks = drive.motor.lacks_amplifier || unknown || found.not_checked.has(Rule::BrakeTorque);
    if found.voltage_unknown {
        5
    } else if stranger && !drive.motor.amplifiers_listed {
        4
    } else {
        2 * i32::from(lacks) + i32::from(!drive.from_makers())
    }
}

/// Order by size as in docs/sizing-rules.md, with a flag for a warning. Data sheets have fewer digits than `f32`.
fn by_size((a, x): (&Drive, bool), (b, y): (&Drive, bool)) -> Ordering {
    let figures = |drive: &Drive, warns: bool| {
        let Drive {
            motor,
            gearbox,
            amplifier,
        } = drive;
        let sum =
            |motor: Option<f64>, gearbox: Option<Option<f64>>, amplifier: Option<Option<f64>>| {
                Some(motor? + gearbox.unwrap_or(Some(0.0))? + amplifier.unwrap_or(Some(0.0))?)
            };
        let size = |g: &Gearbox| g.rated_torque.or(g.peak_torque).unwrap_or(f64::INFINITY);
        let mass = sum(
            motor.mass,
            gearbox.map(|g| g.mass),
            amplifier.map(|a| a.mass),
        );
        let price = sum(
            motor.price,
            gearbox.map(|g| g.price),
            amplifier.map(|a| a.price),
        );
        [
            motor.rated_power(),
            motor.rated_torque.or(motor.standstill_torque),
            Some(f64::from(u8::from(warns))),
            amplifier.map(|a| a.rated_current),
            Some(gearbox.map_or(0.0, size)),
            mass,
            price,
        ]
        .map(|figure| figure.unwrap_or(f64::INFINITY) as f32)
    };
    let keys = |drive: &Drive| {
        let gearbox = drive.gearbox.map_or("", |g| &g.key).to_owned();
        let amplifier = drive.amplifier.map_or("", |a| &a.key).to_owned();
        [drive.motor.key.clone(), gearbox, amplifier]
    };
    let pairs = figures(a, x).into_iter().zip(figures(b, y));
    let order = pairs.map(|(one, other)| one.total_cmp(&other));
    order
        .fold(Ordering::Equal, Ordering::then)
        .then_with(|| keys(a).cmp(&keys(b)))
}

fn named(candidates: &[Candidate]) -> Vec<(String, Outcome)> {
    let named = candidates.iter().map(|c| (c.drive.name(), c.outcome));
    named.collect()
}

fn names(group: &Group) -> Vec<String> {
    let mut names: Vec<String> = group.drives().map(|drive| drive.name()).collect();
    names.sort();
    names
}

/// The first drives must be the expected ones; names the first difference.
#[track_caller]
fn same(found: &[(String, Outcome)], expected: &[(String, Outcome)]) {
    assert_eq!(found.len(), expected.len());
    for (k, pair) in found.iter().zip(expected).enumerate() {
        assert_eq!(pair.0, pair.1, "place {k}");
    }
}

/// Both methods must agree; returns the numbers of suitable and refused drives.
fn compare(catalogue: &Catalogue, cycle: &Cycle, site: &Site, rules: &RuleSet) -> [usize; 2] {
    let motors = catalogue.prepare(site);
    let expected = plainly(catalogue, cycle, site, rules);
    let mut one = Selection::new(catalogue, &motors, cycle, site, rules);
    let all = Selection::parallel(catalogue, &motors, cycle, site, rules);
    for selection in [&one, &all] {
        for (group, expected) in [&selection.fit, &selection.refused].iter().zip(&expected) {
            assert_eq!(group.len(), expected.len());
            let known = group.known();
            assert!(known.len() >= expected.len().min(FIRST));
            same(&named(known), &expected[..known.len()]);
            let mut wanted: Vec<String> = expected.iter().map(|(name, _)| name.clone()).collect();
            wanted.sort();
            assert!(names(group) == wanted);
        }
        let partly = expected[0]
            .iter()
            .filter(|(_, found)| !found.not_checked.is_empty());
        assert_eq!(selection.partly_checked(), partly.count());
    }
    for selection in [&one, &all] {
        survey(selection, &expected[0]);
    }
    // More than the ordered ones, and all.
    for count in [FIRST + 1, 3 * FIRST, usize::MAX] {
        for (found, expected) in [one.first_fit(count), one.first_refused(count)]
            .iter()
            .zip(&expected)
        {
            same(&named(found), &expected[..count.min(expected.len())]);
        }
    }
    one.complete();
    same(&named(one.fit.known()), &expected[0]);
    same(&named(one.refused.known()), &expected[1]);
    expected.map(|list| list.len())
}

/// Counts, ranks and first drives of each certainty, and the number of unchecked rules, match the whole list.
fn survey(selection: &Selection, fit: &[(String, Outcome)]) {
    let classes = selection.classes();
    assert_eq!(
        classes.iter().map(|class| class.count).sum::<usize>(),
        fit.len()
    );
    let mut rank = 1;
    for class in &classes {
        assert_eq!(class.rank, rank);
        assert_eq!(class.first.certainty(), Some(class.certainty));
        assert_eq!(class.first.drive.name(), fit[rank - 1].0);
        rank += class.count;
    }
    assert!(classes.is_sorted_by(|a, b| a.certainty < b.certainty));
    let counted = |rule: Rule| {
        let open = fit.iter().filter(|(_, found)| found.not_checked.has(rule));
        open.count()
    };
    let expected = Rule::ALL.map(|rule| (rule, counted(rule)));
    let expected: Vec<_> = expected.into_iter().filter(|(_, n)| *n > 0).collect();
    let gaps = selection.gaps();
    let found: Vec<_> = gaps.iter().map(|gap| (gap.rule, gap.count)).collect();
    assert_eq!(found, expected);
    assert!(gaps.iter().all(|gap| !missing(&gap.example).is_empty()));
}

/// The same duty scaled to this largest torque and speed (N·m, rad/s).
fn scaled(mut duty: Duty, [torque, speed]: [f64; 2]) -> Duty {
    let most = |of: fn(&jred_analysis::duty::Instant) -> f64| {
        let largest = duty
            .instants
            .iter()
            .map(|i| of(i).abs())
            .fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    };
    let factors = [
        torque / most(|i| i.input_torque),
        speed / most(|i| i.input_speed),
        torque / most(|i| i.input_alpha),
    ];
    for instant in &mut duty.instants {
        instant.input_torque *= factors[0];
        instant.input_speed *= factors[1];
        instant.omega *= factors[1];
        instant.input_alpha *= 10.0 * factors[2];
    }
    duty.hold_torque = 0.5 * torque;
    duty
}

/// Random cycles of all kinds, at torques and speeds that suit a part of the catalogue.
#[test]
fn random_cycles_are_screened_as_in_full() {
    let mut catalogue = with_more_ratios();
    for (k, gearbox) in catalogue.gearboxes.iter_mut().enumerate() {
        gearbox.max_radial_load = (k % 3 > 0).then_some(1000.0 * (k % 3) as f64);
    }
    let ranges = [-1.0..3.0f64, -1.0..2.5f64];
    let loads = (0usize..4, 0.0..2500.0f64);
    let cases = (duty(), ranges, 0usize..3, -20.0..70.0f64, loads);
    let sets = sets();
    let seen = Cell::new([0; 2]);
    let check =
        |(mut duty, tens, set, ambient, loads): (Duty, [f64; 2], usize, f64, (usize, f64))| {
            duty.mechanics.elements = elements(loads);
            let cycle = Cycle::new(&scaled(duty, tens.map(|x| 10f64.powf(x))));
            let mut site = Site::default();
            site.surroundings.ambient = ambient;
            let [fit, refused] = compare(&catalogue, &cycle, &site, &sets[set]);
            let [many_fit, many_refused] = seen.get();
            seen.set([
                many_fit + usize::from(fit > FIRST),
                many_refused + usize::from(refused > FIRST),
            ]);
            Ok(())
        };
    runner(48).run(&cases, check).unwrap();
    let [many_fit, many_refused] = seen.get();
    assert!(
        many_fit >= 5 && many_refused >= 20,
        "{many_fit} {many_refused}"
    );
}

/// No element, or a belt on the gearbox: overloaded, without pretension, or with one that some shafts bear.
fn elements((kind, pretension): (usize, f64)) -> Vec<ElementLoad> {
    let belt = |pretension, tension| ElementLoad {
        element: DriveElement {
            name: "belt".to_owned(),
            stage: Some(0),
            on_input: true,
            arm: 1.0,
            carried: 0.0,
            kind: ElementKind::Belt(BeltForm::Pulleys, pretension),
            limits: vec![(Rule::BeltTension, tension), (Rule::BeltForce, 700.0)],
        },
        force: 600.0,
        speed: 1.0,
    };
    match kind {
        0 => Vec::new(),
        1 => vec![belt(None, 2000.0)],
        2 => vec![belt(Some(pretension), 2000.0)],
        _ => vec![belt(Some(pretension), f64::INFINITY)],
    }
}

/// Three sets of rules: the general one, one with warnings, one with few rules.
fn sets() -> [RuleSet; 3] {
    let with = |rules: &str| {
        let text = format!("{}\n{rules}", press_text());
        let file = checked::parse("press.toml", &text, std::path::Path::new("")).unwrap();
        file.rules
    };
    [
        RuleSet::default(),
        with("[rules]\npeak_torque_warning = 0.5\nrms_torque_warning = 0.3\nspeed_warning = 0.8\n"),
        with("[rules]\npeak_torque = \"off\"\ninertia_ratio = \"off\"\n"),
    ]
}

/// Amplifiers add currents, I²t and the DC bus.
#[test]
fn drives_on_amplifiers_are_screened_as_in_full() {
    let cycle = Cycle::new(&press_duty(300));
    let mut catalogue = with_more_ratios();
    let currents = [2.0, 6.0, 12.0, 25.0];
    catalogue.amplifiers = currents
        .map(|current| Amplifier {
            key: format!("amplifier-{current}"),
            rated_current: current,
            peak_current: 2.0 * current,
            peak_time: (current < 12.0).then_some(2.0),
            ..Amplifier::default()
        })
        .to_vec();
    let (site, rules) = (Site::default(), RuleSet::default());
    let [fit, refused] = compare(&catalogue, &cycle, &site, &rules);
    assert!(fit > FIRST && refused > FIRST, "{fit} {refused}");
    // A drive requested without its amplifier is the first of them in the lists, at any position.
    let motors = catalogue.prepare(&site);
    let selection = Selection::parallel(&catalogue, &motors, &cycle, &site, &rules);
    let expected = plainly(&catalogue, &cycle, &site, &rules).concat();
    for (_, asked) in catalogue.drives().step_by(97) {
        let alone = Drive {
            amplifier: None,
            ..asked
        };
        let alone = alone.name();
        let is_asked = |name: &str| name == alone || name.starts_with(&format!("{alone} on "));
        let found = selection.find(|drive| is_asked(&drive.name()));
        let first = expected.iter().find(|(name, _)| is_asked(name));
        assert_eq!(found.unwrap().drive.name(), first.unwrap().0);
    }
}

/// Without an amplifier and without the highest bus voltage: a resistance too small for the chopper is still decisive.
#[test]
fn a_resistor_is_screened_as_in_full() {
    let cycle = Cycle::new(&press_duty(300));
    let [small, large] = [15.0, 25.0].map(|resistance| {
        let mut site = Site::default();
        site.supply.min_resistance = Some(20.0);
        site.supply.brake_resistor = Some(BrakeResistor {
            resistance,
            power: 100.0,
            peak_power: None,
            pulse_energy: None,
        });
        compare(&with_more_ratios(), &cycle, &site, &RuleSet::default())
    });
    assert_eq!((small[0], small[1]), (0, large[0] + large[1]));
    assert!(large[0] > 0, "{large:?}");
}

/// Without an amplifier the highest bus voltage is decisive even if other figures are missing: regenerated energy charges a small capacitor far
/// beyond it.
#[test]
fn a_voltage_is_screened_as_in_full() {
    let cycle = Cycle::new(&press_duty(300));
    let [small, large] = [1e-6, 1.0].map(|capacitance| {
        let mut site = Site {
            bus_voltage: Some(300.0),
            ..Site::default()
        };
        site.supply.capacitance = Some(capacitance);
        site.supply.max_voltage = Some(400.0);
        compare(&with_more_ratios(), &cycle, &site, &RuleSet::default())
    });
    assert!(small[0] < large[0], "{small:?} {large:?}");
}

/// A drive equals itself and no other, in any order and selection.
#[test]
fn a_drive_is_the_same_as_itself_alone() {
    let cycle = Cycle::new(&press_duty(100));
    let catalogue = Catalogue::load(None, None).unwrap();
    let (site, rules) = (Site::default(), RuleSet::default());
    let motors = catalogue.prepare(&site);
    let selections = [0, 1].map(|_| Selection::new(&catalogue, &motors, &cycle, &site, &rules));
    let [one, other] = selections
        .each_ref()
        .map(|selection| selection.first_refused(20));
    assert!(one.len() == 20 && other.len() == 20);
    for (k, a) in one.iter().enumerate() {
        for (l, b) in other.iter().enumerate() {
            assert_eq!(
                a.is_same_drive(b),
                k == l,
                "{} and {}",
                a.drive.name(),
                b.drive.name()
            );
        }
    }
}

/// A catalogue of equal drives keeps its order.
#[test]
fn equal_drives_stand_in_the_order_of_the_catalogue() {
    let cycle = Cycle::new(&press_duty(100));
    let mut all = Catalogue::load(None, None).unwrap();
    let gearbox = all.gearboxes[0].clone();
    all.gearboxes = (0..400)
        .map(|k| {
            let mut other = gearbox.clone();
            other.key = format!("equal-{k}");
            other
        })
        .collect();
    all.motors.truncate(3);
    let [fit, refused] = compare(&all, &cycle, &Site::default(), &RuleSet::default());
    assert!(fit.max(refused) > 400, "{fit} {refused}");
}

/// Motors with a thousandth of the torque, in an equally small duty: no bound may assume a certain size of torque.
#[test]
fn small_motors_are_screened_as_in_full() {
    let duty = press_duty(200);
    let mut catalogue = Catalogue::load(None, None).unwrap();
    catalogue.amplifiers.clear();
    for motor in &mut catalogue.motors {
        let Motor {
            rated_torque,
            standstill_torque,
            peak_torque,
            torque_at_max_speed,
            winding,
            ..
        } = motor;
        let torques = [
            rated_torque,
            standstill_torque,
            peak_torque,
            torque_at_max_speed,
        ];
        let figures = torques
            .into_iter()
            .chain([&mut winding.torque_constant, &mut winding.voltage_constant]);
        for figure in figures.flatten() {
            *figure *= 1e-3;
        }
        for curve in [&mut motor.peak_curve, &mut motor.continuous_curve] {
            for [_, torque] in curve.iter_mut() {
                *torque *= 1e-3;
            }
        }
        motor.rotor_inertia *= 1e-3;
        motor.friction = [0.0; 2];
    }
    for gearbox in &mut catalogue.gearboxes {
        gearbox.inertia *= 1e-3;
        gearbox.no_load_torque = 0.0;
    }
    let mut rules = RuleSet::default();
    for rule in Rule::ALL {
        if rule != Rule::PeakTorque {
            rules.set(rule, Limit::default());
        }
    }
    for torque in [0.03, 0.1, 0.3] {
        let duty = scaled(duty.clone(), [torque, 100.0]);
        let [fit, refused] = compare(&catalogue, &Cycle::new(&duty), &Site::default(), &rules);
        assert!(fit > 0 && refused > 0, "{torque} N m: {fit} {refused}");
    }
}
