//! Sensitivities and Monte Carlo: slopes by exact derivatives of the duty, room in closed form, probabilities in closed form.

mod tolerance;

use std::path::Path;
use std::sync::Arc;

use crate::support::{Folder, budget, near, press_text, shipped, within};
use jred_analysis::checked;
use jred_analysis::duty::{Duty, Instant, Sampling};
use jred_file::model::rule::Rule;
use jred_file::units::RPM;
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Catalogue, Gearbox};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::Context;
use jred_sizing::select::filter::Filter;
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::common::Study;
use jred_sizing::study::edit::Edit;
use jred_sizing::study::sensitivity::{Reach, Room, Sensitivity};

/// A motor without a speed limit in effect, and no gearbox.
fn strong() -> Catalogue {
    let mut catalogue = Catalogue::load(None, None).unwrap();
    let mut motor = catalogue.motors[0].clone();
    "strong".clone_into(&mut motor.key);
    motor.rated_torque = Some(500.0);
    motor.standstill_torque = Some(500.0);
    motor.peak_torque = Some(2000.0);
    motor.rated_speed = Some(1000.0);
    motor.max_speed = Some(1000.0);
    motor.corner_speed = Some(1000.0);
    motor.rotor_inertia = 0.02;
    catalogue = Catalogue {
        motors: vec![motor],
        ..Catalogue::default()
    };
    catalogue.gearboxes = vec![Gearbox {
        key: "five".to_owned(),
        ratio: 5.0,
        ..Gearbox::default()
    }];
    catalogue
}

fn study(text: &str, steps: usize) -> (Folder, Study) {
    let folder = Folder::new();
    let file = folder.file("machine.toml", text);
    let study = Study::open(&file, strong(), None, steps).unwrap();
    (folder, study)
}

/// Motor torque of every instant with the drive "strong+five".
fn torques(text: &str, steps: usize) -> (Duty, Vec<f64>) {
    let file = checked::parse("machine.toml", text, Path::new("")).unwrap();
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
    let catalogue = strong();
    let drive = Drive {
        motor: &catalogue.motors[0],
        gearbox: Some(&catalogue.gearboxes[0]),
        amplifier: None,
    };
    let torques = duty
        .instants
        .iter()
        .map(|i| drive.motor_point(i).torque)
        .collect();
    (duty, torques)
}

const RACK: &str = include_str!("../../../machines/rack.toml");

/// The motor torque is linear in the carriage's mass, dT/dm = r²·a/i, and so dT_rms/dm = ⟨T·dT/dm⟩/T_rms.
#[test]
fn slope_of_the_rms_torque_by_the_duty_itself() {
    const STEPS: usize = 400;
    let (_folder, study) = study(RACK, STEPS);
    let one = ChosenDrive::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let reach = Reach {
        change: 0.01,
        most: 0.02,
    };
    let found = Sensitivity::new(&study, &one, reach, || ()).unwrap();
    let mass = study.document.find("rack.mass").unwrap();
    let dependence = found
        .dependences
        .iter()
        .find(|d| d.quantity == mass)
        .unwrap();
    let slope = dependence
        .slopes
        .iter()
        .find(|s| s.rule == Rule::RmsTorque)
        .unwrap();

    // dT/dm = r²·a/i.
    let (duty, torque) = torques(RACK, STEPS);
    let figures = duty.figures_of(&torque);
    let by_mass = |i: &Instant| 0.03 * 0.03 * i.input_alpha / 5.0;
    let products = torque
        .iter()
        .zip(&duty.instants)
        .map(|(t, i)| t * by_mass(i));
    let mean = duty.integral_of(products) / duty.duration;
    let share = found
        .shares
        .iter()
        .find(|(rule, _)| *rule == Rule::RmsTorque)
        .unwrap()
        .1;
    // u = T_rms/limit, so du/d ln m = m·dT_rms/dm·u/T_rms.
    let expected = 85.0 * mean / figures.rms * share / figures.rms;
    near("slope", slope.slope, expected, budget::SLOPE);
    assert!(slope.uncertainty < 1e-3 * slope.slope.abs(), "{slope:?}");

    // A quantity without effect has slope zero: gravity is across the axis.
    let gravity = study.document.find("gravity.2").unwrap();
    let gravity = found
        .dependences
        .iter()
        .find(|d| d.quantity == gravity)
        .unwrap();
    for slope in gravity
        .slopes
        .iter()
        .filter(|slope| slope.rule != Rule::HoldingTorque)
    {
        within("gravity", slope.slope, 0.0, 1e-9);
    }
    // The other component is zero.
    let fixed = found.fixed.iter();
    let fixed: Vec<&str> = fixed
        .map(|(k, _)| study.document.quantities()[*k].path.as_str())
        .collect();
    assert_eq!(fixed, ["gravity.1"]);
}

/// A study keeps its cycle if a quantity concerns only the drive's surroundings or the rules: the cycle equals that of the changed machine, read and
/// sampled again, for these and all other quantities.
#[test]
fn some_sections_do_not_reach_the_cycle() {
    const STEPS: usize = 60;
    let mut kept = 0;
    for name in ["hoist", "press", "rack", "toggle-press", "turntable"] {
        let path = shipped(format!("{name}.toml"));
        let study = Study::open(&path, strong(), None, STEPS).unwrap();
        let nominal = study.machine(&[]).unwrap().cycle;
        for (quantity, found) in study.document.quantities().iter().enumerate() {
            let edit = Edit {
                quantity,
                number: found.number() * 1.001,
                unit: found.unit(),
            };
            let text = study.document.with(std::slice::from_ref(&edit));
            let anew = checked::parse(&study.name, &text, path.parent().unwrap());
            let machine = study.machine(&[edit]);
            let (Ok(anew), Ok(machine)) = (&anew, &machine) else {
                assert_eq!(anew.is_ok(), machine.is_ok(), "{name}: {}", found.path);
                continue;
            };
            let duty = Duty::new(anew, anew.motion.as_ref().unwrap(), STEPS).unwrap();
            let expected = Cycle::new(&duty);
            let at = format!("{name}: {}", found.path);
            assert_eq!(machine.cycle.samples(), expected.samples(), "{at}");
            let held =
                [&machine.cycle, &expected].map(|cycle: &Cycle| cycle.hold_torque().to_bits());
            assert_eq!(held[0], held[1], "{at}");
            let mechanics = |cycle: &Cycle| format!("{:?}", cycle.mechanics());
            assert_eq!(mechanics(&machine.cycle), mechanics(&expected), "{at}");
            assert_eq!(
                format!("{:?}", machine.file.site),
                format!("{:?}", anew.site),
                "{at}"
            );
            kept += usize::from(Arc::ptr_eq(&machine.cycle, &nominal));
        }
    }
    // The hoist's supply alone has eight.
    assert!(kept >= 8, "{kept} quantities kept the cycle");
}

/// The room up to a rule's limit, in closed form: torque and speed of a conveyor at constant speed.
#[test]
fn room_in_closed_form() {
    let conveyor = include_str!("../../../machines/conveyor.toml");
    // 850 rpm · 5 = 445 rad/s of 1000 rad/s: of a limit of 50 % the used share is 0.89.
    let text = format!(
        "{conveyor}\n[rules]\nspeed = \"50 %\"\ninertia_ratio = 900\ninertia_ratio_warning = 900\n"
    );
    let (_folder, study) = study(&text, 64);
    let one = ChosenDrive::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let reach = Reach {
        change: 0.01,
        most: 0.5,
    };
    let found = Sensitivity::new(&study, &one, reach, || ()).unwrap();
    let of = |path: &str| {
        let quantity = study.document.find(path).unwrap();
        found
            .dependences
            .iter()
            .find(|d| d.quantity == quantity)
            .unwrap()
    };
    let share = 850.0 * RPM * 5.0 / 500.0;
    let speed = of("motion.speed");
    assert!(
        matches!(speed.room[1], Room::UpTo(_, Rule::Speed)),
        "{:?}",
        speed.room
    );
    near(
        "up",
        speed.room[1].change(),
        1.0 / share - 1.0,
        budget::ROOM,
    );
    assert!(matches!(speed.room[0], Room::AtLeast(-0.5)));
    // The limit itself: the share is inversely proportional to it.
    let limit = of("rules.speed");
    assert!(
        matches!(limit.room[0], Room::UpTo(_, Rule::Speed)),
        "{:?}",
        limit.room
    );
    near("down", limit.room[0].change(), share - 1.0, budget::ROOM);
    let slope = |path: &str| {
        of(path)
            .slopes
            .iter()
            .find(|s| s.rule == Rule::Speed)
            .unwrap()
            .slope
    };
    near(
        "slope of the speed",
        slope("motion.speed"),
        share,
        budget::SLOPE,
    );
    near(
        "slope of the limit",
        slope("rules.speed"),
        -share,
        budget::SLOPE,
    );
    let (first, room) = found.first_to_break().unwrap();
    assert_eq!(study.document.quantities()[first].path, "rules.speed");
    assert!(std::ptr::eq(room, &raw const limit.room[0]));
}

/// Beyond its room a quantity violates the named rule, within it none: by sizing the changed machine.
#[test]
fn just_beyond_its_room_a_quantity_breaks_the_rule() {
    let folder = Folder::new();
    let file = folder.file("press.toml", press_text());
    let catalogue = Catalogue::load(None, None).unwrap();
    let study = Study::open(&file, catalogue, None, 200).unwrap();
    let one = ChosenDrive::choose(&study, None, &Filter::default(), None).unwrap();
    let found = Sensitivity::new(
        &study,
        &one,
        Reach {
            change: 0.01,
            most: 0.5,
        },
        || (),
    )
    .unwrap();
    let mut seen = 0;
    for dependence in &found.dependences {
        for room in &dependence.room {
            let Room::UpTo(change, rule) = room else {
                continue;
            };
            let quantity = &study.document.quantities()[dependence.quantity];
            let judge = |change: f64| {
                let edit = Edit {
                    quantity: dependence.quantity,
                    number: quantity.number() * (1.0 + change),
                    unit: quantity.unit(),
                };
                let machine = study.machine(&[edit]).unwrap();
                jred_sizing::judge::broken(&machine.file.rules, &one.findings(&machine))
            };
            let step = 3e-5 * change.signum();
            assert_eq!(judge(*change), None, "{}", quantity.path);
            assert_eq!(judge(change + step), Some(*rule), "{}", quantity.path);
            seen += 1;
        }
    }
    assert!(seen >= 6, "only {seen} rooms end at a rule");
}

/// A context of the study's drive has the same findings as `One`.
#[test]
fn one_drive_is_judged_as_in_the_catalogue() {
    let (_folder, study) = study(RACK, 64);
    let one = ChosenDrive::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let machine = study.machine(&[]).unwrap();
    let motors = study.catalogue.prepare(&machine.file.site);
    let (id, drive) = study.drive("strong+five").unwrap();
    let duty = Duty::new(&machine.file, machine.file.motion.as_ref().unwrap(), 64).unwrap();
    let cycle = Cycle::new(&duty);
    let context = Context::new(&cycle, &machine.file.site, drive, &motors[id.motor()]);
    let (a, b) = (
        one.findings(&machine),
        context.findings(&machine.file.rules),
    );
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}

/// A machine whose motor torque depends on the gear ratio: friction M at the wheel needs M·z₁/z₂ of the motor at constant speed. The share is
/// proportional to 1/z₂, so du/d ln z₂ = −u, and by one tooth more and less z/2·(1/(z + 1) − 1/(z − 1)) = −z²/(z² − 1) of u.
#[test]
fn teeth_are_moved_by_one() {
    let text = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = { diameter = \"1 m\", mass = \"1 kg\" }\n\
                [[load]]\non = \"table\"\nopposing_moment = \"700 N m\"\n\
                [[drive_train]]\ntype = \"gear-train\"\n[[drive_train.stage]]\n\
                driver = { teeth = 20, inertia = \"1 kg cm^2\" }\ndriven = { teeth = 40, inertia = \"1 kg cm^2\" }\n\
                [motion]\ntype = \"constant-speed\"\nspeed = \"10 rpm\"\n";
    let (_folder, study) = study(text, 60);
    let one = ChosenDrive::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let reach = Reach {
        change: 0.01,
        most: 0.5,
    };
    let found = Sensitivity::new(&study, &one, reach, || ()).unwrap();
    let share = |rule: Rule| found.shares.iter().find(|(r, _)| *r == rule).unwrap().1;
    for (path, z, sign) in [
        ("drive_train.1.stage.1.driven.teeth", 40.0f64, -1.0),
        ("drive_train.1.stage.1.driver.teeth", 20.0, 1.0),
    ] {
        let teeth = study.document.find(path).unwrap();
        let dependence = found.dependences.iter().find(|d| d.quantity == teeth);
        let dependence = dependence.unwrap_or_else(|| panic!("{path}: {:?}", found.fixed));
        assert!(dependence.whole);
        let slope = dependence
            .slopes
            .iter()
            .find(|s| s.rule == Rule::RmsTorque)
            .unwrap();
        let by_one = if sign < 0.0 {
            z * z / (z * z - 1.0)
        } else {
            1.0
        };
        near(
            path,
            slope.slope,
            sign * by_one * share(Rule::RmsTorque),
            1e-9,
        );
        let bend = if sign < 0.0 { z / (z * z - 1.0) } else { 0.0 };
        within(path, slope.uncertainty, bend * share(Rule::RmsTorque), 1e-9);
        for room in &dependence.room {
            let teeth = room.change() * z;
            within("whole", teeth, teeth.round(), 1e-9);
        }
    }
}

/// The default sampling against a finer one: every share of a limit of every example machine that can be sized.
#[test]
fn shares_do_not_depend_on_the_sampling() {
    const FINE: Sampling = Sampling {
        tolerance: 1e-12,
        steps: 8000,
    };
    let (mut worst, mut machines) = (0.0f64, 0);
    for name in [
        "press",
        "linkage-press",
        "excavator-bucket",
        "four-bar",
        "rack",
        "toggle-press",
        "hoist",
    ] {
        let path = shipped(format!("{name}.toml"));
        let shares = |sampling: Sampling| {
            let study = Study::open(&path, strong(), None, sampling).ok()?;
            let filter = Filter::default();
            let one = ChosenDrive::choose(&study, Some("strong+five"), &filter, None).ok()?;
            let machine = study.machine(&[]).unwrap();
            Some(jred_sizing::study::sensitivity::shares(
                &machine.file.rules,
                &one.findings(&machine),
            ))
        };
        let (Some(coarse), Some(fine)) = (shares(Sampling::default()), shares(FINE)) else {
            continue;
        };
        machines += 1;
        assert_eq!(coarse.len(), fine.len(), "{name}");
        for ((rule, coarse), (_, fine)) in coarse.iter().zip(&fine) {
            let off = (coarse - fine).abs() / fine.abs().max(1e-3);
            if off > 1e-6 {
                println!("{name} {}: {coarse} {fine} {off:e}", rule.name());
            }
            worst = worst.max(off);
        }
    }
    assert!(machines >= 5, "{machines}");
    assert!(worst < budget::OTHER_INSTANTS, "{worst:e}");
}
