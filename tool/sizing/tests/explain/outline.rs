//! A duty without most of the instants that only resolve a peak: no rule becomes worse than over all of them.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::fmt::Write as _;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{InertiaOf, Limit, RuleSet, RuleVerdict};
use jred_sizing::catalogue::{Amplifier, Drive, Gearbox, Motor, Winding};
use jred_sizing::cycle::Cycle;
use jred_sizing::explain::{Alteration, DutyModel};
use jred_sizing::judge::{Context, Findings};
use jred_sizing::motor::envelope::MotorLimits;
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

use super::parse;
use crate::bus::drive::motor;
use crate::support::{Folder, budget, near, press_text};

/// The press with the data for every rule, with these segments: distance (deg; zero is a dwell) and time (ms).
fn press(segments: &[(i32, u32)]) -> MachineFile {
    let text = press_text();
    let (machine, _) = text.split_once("[[motion.segment]]").unwrap();
    let mut text = machine.to_owned();
    let rest = -segments.iter().map(|(way, _)| way).sum::<i32>() % 360;
    let last = [(rest, 300)];
    for (way, time) in segments.iter().chain(&last) {
        let kind = match way {
            0 => format!("dwell = \"{time} ms\""),
            way => {
                format!("law = \"polynomial-345\"\nmove = \"{way} deg\"\nduration = \"{time} ms\"")
            }
        };
        let _ = writeln!(text, "[[motion.segment]]\n{kind}");
    }
    text += "[tool]\npoint = \"slider\"\nplay = \"0.05 mm\"\n[stiffness]\nshaft = \"9000 N m/rad\"\nbacklash = \"3 arcmin\"\n";
    parse(&text)
}

/// A motor with field weakening, and a gearbox with every rating.
fn parts() -> (Motor, Gearbox, Amplifier) {
    let weakened = motor();
    let motor = Motor {
        max_bus_voltage: Some(150.0),
        friction: [0.1, 1e-3],
        winding: Winding {
            peak_current: Some(220.0),
            ..weakened.winding
        },
        ..weakened
    };
    let gearbox = Gearbox {
        key: "g".to_owned(),
        ratio: 3.0,
        rated_torque: Some(80.0),
        peak_torque: Some(160.0),
        emergency_torque: Some(320.0),
        rated_speed: Some(200.0),
        max_speed: Some(500.0),
        inertia: 8e-5,
        stiffness: Some(9000.0),
        max_radial_load: Some(2500.0),
        backlash: Some(1e-3),
        shock_factors: vec![[1000.0, 1.0], [5000.0, 1.5]],
        ..Gearbox::default()
    };
    let amplifier = Amplifier {
        key: "a".to_owned(),
        mains_voltage: Some(100.0),
        rated_current: 100.0,
        peak_current: 400.0,
        ..Amplifier::default()
    };
    (motor, gearbox, amplifier)
}

fn rules(of: InertiaOf, share: f64) -> RuleSet {
    let mut rules = RuleSet::default();
    let fail = Some(share);
    for rule in Rule::ALL {
        rules.set(rule, Limit { fail, warn: None });
    }
    rules.choices.inertia_ratio_of = of;
    rules
}

fn directly(
    duty: &Duty,
    file: &MachineFile,
    drive: Drive,
    limits: &MotorLimits,
    rules: &RuleSet,
) -> Findings {
    let cycle = Cycle::new(duty);
    let mut findings = Findings::default();
    Context::new(&cycle, &file.site, drive, limits).measure_directly(rules, &mut findings);
    findings
}

/// Segments, steps, instants without a weight, powers of ten of the alteration.
type Drawn = (Vec<(i32, u32)>, usize, Vec<bool>, [f64; 3]);

/// Random motions of the press in few steps, some instants without a weight, randomly altered. For every rule: no larger share of its limit, and
/// never violated if the whole duty satisfies it.
#[test]
#[ignore = "more than five seconds of a processor"]
#[expect(clippy::too_many_lines, reason = "one random experiment")]
fn what_an_outline_violates_is_violated() {
    let segment = (prop_oneof![1 => Just(0i32), 4 => -400..400i32], 100..900u32);
    let of = prop_oneof![
        Just(InertiaOf::Min),
        Just(InertiaOf::Mean),
        Just(InertiaOf::Rms),
        Just(InertiaOf::Max)
    ];
    let motion = (
        prop::collection::vec(segment, 1..5),
        20usize..200,
        prop::collection::vec(prop::bool::weighted(0.4), 5..40),
        prop::array::uniform3(-1.0..1.0f64),
    );
    let drive = (
        0.2..3.0f64,
        prop::bool::ANY,
        prop::bool::ANY,
        20.0..300.0f64,
        of,
    );
    let (motor, gearbox, amplifier) = parts();
    let (fails, lower) = (Cell::new(0), Cell::new(0));
    let seen = RefCell::new(BTreeSet::new());
    let check = |(motion, drive): (Drawn, (f64, bool, bool, f64, InertiaOf))| {
        let (segments, steps, without, by) = motion;
        let (share, geared, amplified, volts, of) = drive;
        if segments.iter().all(|(way, _)| *way == 0) {
            return Ok(());
        }
        let mut file = press(&segments);
        file.site.bus_voltage = Some(volts);
        let mut duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
        for (instant, without) in duty.instants.iter_mut().zip(without.iter().cycle()) {
            if *without {
                instant.weight = 0.0;
            }
        }
        let altered = DutyModel::new(&file, &duty).unwrap();
        let [time, mass, process] = by.map(|x| 10f64.powf(x));
        let by = Alteration {
            time,
            mass,
            process,
        };
        let Some(outline) = altered.outline(by) else {
            return Ok(());
        };
        let whole = altered.duty(by);
        prop_assert!(outline.instants.len() < whole.instants.len());
        let drive = Drive {
            motor: &motor,
            gearbox: Some(&gearbox).filter(|_| geared),
            amplifier: Some(&amplifier).filter(|_| amplified),
        };
        let limits = MotorLimits::new(&motor, drive.amplifier, &file.site);
        let rules = rules(of, share);
        let [some, all] =
            [&outline, &whole].map(|duty| directly(duty, &file, drive, &limits, &rules));
        for (rule, found) in some.iter() {
            let whole = all.get(rule).unwrap();
            prop_assert_eq!(found.is_known(), whole.is_known(), "{:?}", rule);
            if !found.is_known() {
                continue;
            }
            let [less, more] = [found, whole].map(|found| rules.use_of_limit(rule, found));
            prop_assert!(
                less <= more * (1.0 + budget::SAME_SUMS),
                "{:?}: {} {}",
                rule,
                less,
                more
            );
            lower.set(lower.get() + usize::from(less < 0.999_999 * more));
            let [less, more] = [found, whole].map(|found| rules.verdict(rule, found));
            let failed = less == RuleVerdict::Fail;
            prop_assert!(!failed || more == RuleVerdict::Fail, "{:?}", rule);
            fails.set(fails.get() + usize::from(failed));
            seen.borrow_mut().insert(rule.key());
        }
        Ok(())
    };
    let config = ProptestConfig {
        cases: 400,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let mut runner =
        TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[23; 32]));
    runner.run(&(motion, drive), check).unwrap();
    assert!(fails.get() > 500 && lower.get() > 50, "{fails:?} {lower:?}");
    let seen = seen.into_inner();
    for rule in Rule::ALL {
        // Without a brake, with the site of the data sheets, and with a belt without limits.
        let direct = !rule.follows_time()
            && !matches!(
                rule,
                Rule::BrakeTorque
                    | Rule::BrakeWork
                    | Rule::InertiaRatio
                    | Rule::AmbientTemperature
                    | Rule::CabinetTemperature
                    | Rule::Altitude
                    | Rule::BeltTension
                    | Rule::BeltForce
                    | Rule::ScrewForce
                    | Rule::ScrewBuckling
                    | Rule::ScrewSpeed
                    | Rule::PinionForce
                    | Rule::GearboxAxial
            );
        assert!(!direct || seen.contains(rule.key()), "{rule:?} {seen:?}");
    }
}

/// A recorded motion reverses within one stretch, between two weighted instants: its moves are counted over all instants.
#[test]
fn moves_between_two_weighted_instants_count() {
    let folder = Folder::new();
    let mut csv = "t [s],phi [deg]\n".to_owned();
    for k in 0..=400 {
        let t = f64::from(k) / 400.0;
        let phi = 180.0 - 60.0 * (std::f64::consts::TAU * 11.0 * t).cos();
        let _ = writeln!(csv, "{t:.5},{phi:.12}");
    }
    folder.file("swing.csv", csv);
    let text = press_text();
    let (machine, _) = text.split_once("[motion]").unwrap();
    let text = format!("{machine}\n[motion]\ntype = \"profile\"\nfile = \"swing.csv\"\n");
    let file = checked::parse("m.toml", &text, folder.path("")).unwrap();
    // Eleven times there and back, in sixteen steps.
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 16).unwrap();
    let moves = duty.mechanics.moves;
    let altered = DutyModel::new(&file, &duty).unwrap();
    let by = Alteration {
        time: 2.0,
        ..Alteration::default()
    };
    let outline = altered.outline(by).unwrap();
    assert!(outline.instants.len() < duty.instants.len());
    let turns = outline.instants.windows(2);
    let turns = turns
        .filter(|two| two[0].omega * two[1].omega < 0.0)
        .count();
    assert!(turns + 1 < moves as usize, "{turns} {moves}");
    let mechanics = &outline.mechanics;
    assert_eq!(mechanics.moves, moves);
    near(
        "moves per second",
        mechanics.move_rate,
        0.5 * f64::from(moves),
        budget::SAME_SUMS,
    );
    near(
        "frequency",
        mechanics.drive_frequency,
        0.5 * duty.mechanics.drive_frequency,
        budget::SAME_SUMS,
    );
    let [some, all] = [&outline, &altered.duty(by)]
        .map(|duty| duty.figures(|i| i.input_inertia))
        .map(|inertia| [inertia.min, inertia.max]);
    near("least", some[0], all[0], budget::SAME_SUMS);
    near("largest", some[1], all[1], budget::SAME_SUMS);
}
