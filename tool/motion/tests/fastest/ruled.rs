//! Motions that the sizing rules accept, judged from the profile read back.

use std::path::{Path, PathBuf};

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::axis::Axis;
use jred_file::model::drive_element::{BeltForm, DriveElement, ElementKind};
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Limit, RuleVerdict};
use jred_file::model::{drive_train, variator};
use jred_motion::contact::broken;
use jred_motion::fastest::cycle::{Cycle, cycle, endless};
use jred_motion::fastest::field::Reserve;
use jred_motion::fastest::ruled::{Cap, Judge, Judgement, ruled};
use jred_motion::fastest::{MoveLimits, NoMotion, Rms};
use jred_motion::moves::{Chain, Part, chain};
use jred_motion::path_dynamics::Actuator;
use jred_sizing::catalogue::{Catalogue, Drive, MotorKind};
use jred_sizing::judge::Context;
use jred_sizing::judge::check::Check;
use jred_sizing::motor::envelope::{Envelope, MotorLimits};
use jred_sizing::select::fit::input_kind;
use jred_sizing::select::named::named;

use super::close;
use crate::support::Folder;

const STEPS: usize = 2000;

fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Five motors, three gearboxes with shock factors, three amplifiers.
fn catalogue() -> Catalogue {
    let folder = home().join("support/engineer/cat");
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let names = [
        "amplifiers.csv",
        "compatibility.csv",
        "gearboxes.csv",
        "motors.csv",
        "resistors.csv",
    ];
    Catalogue::of_texts(names.map(|name| (name, text(name))), false).unwrap()
}

fn made(
    file: &MachineFile,
    chain: &Chain,
    drive: Drive,
    rms: Option<Rms>,
) -> Result<(Cycle, Judgement), NoMotion> {
    let actuator = Actuator::new(
        &drive,
        Envelope::at(drive.motor, drive.amplifier, &file.site),
    );
    let gearbox = drive.gearbox;
    let limits = MoveLimits {
        gearbox_torque: gearbox.and_then(|gearbox| gearbox.peak_torque),
        gearbox_speed: gearbox.and_then(|gearbox| gearbox.max_speed),
        ..MoveLimits::default()
    };
    let limits = limits.with_reserve(Reserve::of(&file.rules));
    let judge = Judge::new(file, drive, STEPS.into());
    let make = |limits: &MoveLimits, rms: Option<Rms>| {
        let made = if chain.endless {
            let step = chain.parts.iter().find_map(Part::step).unwrap().0;
            endless(file, &actuator, *limits, &step).map_err(|why| (None, why))
        } else {
            let made = cycle(file, &actuator, *limits, rms, &chain.parts);
            made.map_err(|(index, why)| (Some(index), why))
        };
        made.map(|cycle| (cycle, ()))
    };
    let found = ruled(&judge, &limits, rms, rms.is_some(), make);
    let (cycle, (), judged) = found.map_err(|(_, why)| why)?;
    Ok((cycle, judged))
}

/// The rules of a machine file with the profile of a cycle as its motion, read like in `jred size`.
fn size(path: &Path, cycle: &Cycle, drive: Drive) -> Vec<Check> {
    let text = std::fs::read_to_string(path).unwrap();
    let own = checked::read(path).unwrap();
    // A profile of the tool needs `of`.
    let of_tool = own.axis() != Axis::of_drive(own.machine.mechanism().coordinate());
    let mut lines: Vec<&str> = Vec::new();
    let mut of_motion = false;
    for line in text.lines() {
        if line.starts_with('[') {
            of_motion = line.starts_with("[motion") || line.starts_with("[[motion");
        }
        let key = line.split('=').next().unwrap_or_default().trim();
        if !of_motion || line == "[motion]" || of_tool && ["of", "near"].contains(&key) {
            lines.push(line);
        }
        if line == "[motion]" {
            lines.push("type = \"profile\"\nfile = \"fastest.csv\"");
        }
    }
    let folder = Folder::new();
    for entry in std::fs::read_dir(path.parent().unwrap()).unwrap() {
        let entry = entry.unwrap().path();
        if entry.extension().is_some_and(|ending| ending == "csv") {
            let name = entry.file_name().unwrap().to_str().unwrap();
            folder.file(name, std::fs::read_to_string(&entry).unwrap());
        }
    }
    folder.file("fastest.csv", cycle.trace.of_axis(&own.axis()).profile());
    let judged = folder.file("judged.toml", lines.join("\n"));
    let file = checked::read(&judged).unwrap_or_else(|why| panic!("{}: {why:?}", path.display()));
    let duty = Duty::new(&file, file.required_motion().unwrap(), STEPS).unwrap();
    let cycle = jred_sizing::cycle::Cycle::new(&duty);
    let prepared = MotorLimits::new(drive.motor, drive.amplifier, &file.site);
    Context::new(&cycle, &file.site, drive, &prepared).checks(&file.rules)
}

/// A rotary table whose cycles per hour rise with its speed: T2B, the shock factor at the rate of the motion, and T2N, all from the data sheet.
#[test]
fn a_gearbox_keeps_its_torques_at_the_rate_of_the_motion() {
    let catalogue = catalogue();
    let path = home().join("support/engineer/table.toml");
    let mut file = checked::read(&path).unwrap();
    let (_, drive) = named(&catalogue, "sm100bb+g115-16 on a6").unwrap();
    let chain = chain(file.required_motion().unwrap(), &file.process()).unwrap();
    for rms in [None, Some(Rms::Continuous)] {
        let (cycle, judged) = made(&file, &chain, drive, rms).unwrap();
        assert_eq!(judged.violated().count(), 0, "{:?}", judged.checks);
        for check in size(&path, &cycle, drive) {
            assert_ne!(check.verdict, RuleVerdict::Fail, "{check:?}");
        }
        // Nearly all of T2N = 120 N m is used.
        let mean = judged
            .checks
            .iter()
            .find(|check| check.id == Rule::GearboxCubicMean);
        let used = mean.unwrap().used;
        assert!(used <= 1.0 && used > 0.998, "{used}");
    }
    // Without the rule for T2N only the fixed point of the shock factor remains: constant inertia and friction, a torque of the gearbox output of ±T
    // with the belt's losses on their side.
    let mut changes = file.rules.clone();
    changes.set(Rule::GearboxCubicMean, Limit::default());
    file.rules = changes;
    let (cycle, judged) = made(&file, &chain, drive, None).unwrap();
    let [(Cap::GearboxTorque, torque)] = judged.caps[..] else {
        panic!("{:?}", judged.caps)
    };
    let time = cycle.trace.duration();
    let rate = 3600.0 / time;
    // 1000/h: 1; 2000/h: 1.15; 3000/h: 1.4; 5000/h: 2
    let points = [[1000.0, 1.0], [2000.0, 1.15], [3000.0, 1.4], [5000.0, 2.0]];
    let pair = points.windows(2).find(|pair| rate <= pair[1][0]).unwrap();
    let [[from, low], [to, high]] = [pair[0], pair[1]];
    let factor = low + (high - low) * (rate - from) / (to - from);
    let allowed = 240.0 / factor;
    assert!(
        torque <= allowed && torque > 0.998 * allowed,
        "{torque} {allowed}"
    );
    // The time with that torque: with x of the distance driven and the rest braked, 1/a₁ + 1/a₂ = t²/(2·way).
    let i = 4.0;
    let parts = 12.0 * (4.2 * 0.42 * 0.42 + 0.012);
    let belt = 0.9 * 0.16 * 0.16;
    let inertia = 0.5 * 110.0 * 0.25 + parts;
    let shafts = 0.09 + belt + i * i * 9e-4;
    let (torque, friction, efficiency) = (torque * i, 14.0, 0.97);
    let driven = (torque * efficiency - friction) / (inertia + shafts * efficiency);
    let braked = (torque / efficiency + friction) / (inertia + shafts / efficiency);
    let way = 30f64.to_radians();
    let moving = (2.0 * way * (1.0 / driven + 1.0 / braked)).sqrt();
    close(time, moving + 0.6, 1e-3);
}

/// The belt between gearbox and table bears less than the drive gives: nearly all of its force is used, and no more.
#[test]
fn a_belt_keeps_its_force() {
    let catalogue = catalogue();
    let mut file = checked::read(&home().join("support/engineer/table.toml")).unwrap();
    file.drive_elements = vec![DriveElement {
        name: "belt".to_owned(),
        stage: Some(0),
        on_input: true,
        arm: 0.16,
        carried: 0.9,
        kind: ElementKind::Belt(BeltForm::Pulleys, None),
        limits: vec![(Rule::BeltForce, 700.0)],
    }];
    let (_, drive) = named(&catalogue, "sm100bb+g115-16 on a6").unwrap();
    let chain = chain(file.required_motion().unwrap(), &file.process()).unwrap();
    let (_, judged) = made(&file, &chain, drive, None).unwrap();
    assert_eq!(judged.violated().count(), 0, "{:?}", judged.checks);
    let belt = judged.checks.iter().find(|c| c.id == Rule::BeltForce);
    let used = belt.unwrap().used;
    assert!(used <= 1.0 && used > 0.99, "{used}");
}

/// For any machine and drive, the rules reported as satisfied are satisfied by the profile read back.
#[test]
#[ignore = "more than five seconds of a processor"]
fn what_is_named_as_kept_is_kept() {
    let catalogue = catalogue();
    let mut count = 0;
    let mut capped = 0;
    for entry in std::fs::read_dir(home().join("../machines")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let file = checked::read(&path).unwrap();
        let refused = variator::refuse(&file, "fastest").is_err()
            || drive_train::refuse(&file, "fastest").is_err()
            || file.refuse_timed("fastest").is_err();
        if refused || input_kind(&file) == MotorKind::Linear {
            continue;
        }
        let Some(Ok(chain)) = file.motion.as_ref().map(|own| chain(own, &file.process())) else {
            continue;
        };
        // The small one for every third.
        for name in ["sm60b+g70-5 on a3", "sm100bb+g115-16 on a6"] {
            if name.starts_with("sm60b") && count % 3 != 0 {
                continue;
            }
            let (_, drive) = named(&catalogue, name).unwrap();
            let Ok((cycle, judged)) = made(&file, &chain, drive, None) else {
                continue;
            };
            // `fastest` reports a slack rope, and `size` refuses such a motion.
            if broken(&file, &cycle.trace).unwrap().is_some() {
                continue;
            }
            count += 1;
            capped += usize::from(!judged.caps.is_empty());
            let kept: Vec<Rule> = judged.kept().map(|check| check.id).collect();
            let violated: Vec<Rule> = judged.violated().map(|check| check.id).collect();
            for check in size(&path, &cycle, drive) {
                let says = format!("{} with {name}: {check:?}", path.display());
                let fails = check.verdict == RuleVerdict::Fail;
                assert!(!(fails && kept.contains(&check.id)), "{says}");
                assert!(!fails || violated.contains(&check.id), "{says}");
            }
        }
    }
    assert!(count > 25 && capped > 5, "{count} {capped}");
}
