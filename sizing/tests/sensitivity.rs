//! Sensitivities and Monte Carlo: slopes by exact derivatives of the duty, room in closed form, probabilities in closed form.

mod support;

use std::path::Path;

use jred_sizing::catalogue::{Catalogue, Gearbox};
use jred_sizing::cycle::Cycle;
use jred_sizing::drive::Drive;
use jred_sizing::duty::Duty;
use jred_sizing::filter::Filter;
use jred_sizing::input::{self, tolerance::Tolerance};
use jred_sizing::judge::Context;
use jred_sizing::rule::Rule;
use jred_sizing::sensitivity::{Reach, Room, Sensitivity};
use jred_sizing::tolerance::summary::{Probability, quantile};
use jred_sizing::tolerance::{Samples, Scatter};
use jred_sizing::vary::one::One;
use jred_sizing::vary::rows::Cell;
use jred_sizing::vary::run::Task as _;
use jred_sizing::vary::study::Study;
use support::{Folder, budget, jred, near, press_text, within};

/// A motor that limits nothing by its speed, and no gearbox.
fn strong() -> Catalogue {
    let mut catalogue = Catalogue::load(None, None).unwrap();
    let mut motor = catalogue.motors[0].clone();
    motor.key = "strong".to_owned();
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
    let study = Study::new(&file, strong(), None, steps).unwrap();
    (folder, study)
}

/// Motor torque of every instant with the drive "strong+five".
fn torques(text: &str, steps: usize) -> (Duty, Vec<f64>) {
    let file = input::parse("machine.toml", text, Path::new("")).unwrap();
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

const RACK: &str = include_str!("../../machines/rack.toml");

/// The motor torque is linear in the carriage's mass: dT/dm follows from two duties exactly, and with it
/// dT_rms/dm = ⟨T·dT/dm⟩/T_rms.
#[test]
fn slope_of_the_rms_torque_by_the_duty_itself() {
    const STEPS: usize = 400;
    let (_folder, study) = study(RACK, STEPS);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
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

    let (duty, torque) = torques(RACK, STEPS);
    let (_, heavier) = torques(&RACK.replacen("\"85 kg\"", "\"86 kg\"", 1), STEPS);
    let figures = duty.figures_of(torque.iter().copied());
    let products = torque.iter().zip(&heavier).map(|(t, h)| t * (h - t));
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

    // What moves nothing moves nothing: gravity is across the axis.
    let gravity = study.document.find("gravity.1").unwrap();
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
    // The other component is zero, and the moves of a cycle must close.
    let fixed: Vec<&str> = found
        .fixed
        .iter()
        .map(|(k, _)| study.document.quantities()[*k].path.as_str())
        .collect();
    assert_eq!(
        fixed,
        [
            "gravity.0",
            "motion.segment.0.move",
            "motion.segment.2.move"
        ]
    );
}

/// The room up to a rule's limit, in closed form: torque and speed of a conveyor at constant speed.
#[test]
fn room_in_closed_form() {
    let conveyor = include_str!("../../machines/conveyor.toml");
    // 850 rpm · 5 = 445 rad/s of 1000 rad/s: a limit of 50 % is used by 0.89.
    let text = format!(
        "{conveyor}\n[rules]\nspeed = \"50 %\"\ninertia_ratio = 900\ninertia_ratio_warning = 900\n"
    );
    let (_folder, study) = study(&text, 64);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
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
    let share = 850.0 * std::f64::consts::PI / 30.0 * 5.0 / 500.0;
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
    assert_eq!(speed.room[0], Room::AtLeast(-0.5));
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
    assert_eq!(room, &limit.room[0]);
}

/// Beyond the room the named rule is broken, within it none is: by sizing the changed machine.
#[test]
fn just_beyond_its_room_a_quantity_breaks_the_rule() {
    let folder = Folder::new();
    let file = folder.file("press.toml", press_text());
    let catalogue = Catalogue::load(None, None).unwrap();
    let study = Study::new(&file, catalogue, None, 200).unwrap();
    let one = One::choose(&study, None, &Filter::default(), None).unwrap();
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
                let edit = jred_sizing::vary::edit::Edit {
                    quantity: dependence.quantity,
                    number: quantity.number() * (1.0 + change),
                    unit: quantity.unit(),
                };
                let machine = study.machine(&[edit]).unwrap();
                jred_sizing::vary::one::broken(&machine.file.rules, &one.findings(&machine))
            };
            let step = 3e-5 * change.signum();
            assert_eq!(judge(*change), None, "{}", quantity.path);
            assert_eq!(judge(change + step), Some(*rule), "{}", quantity.path);
            seen += 1;
        }
    }
    assert!(seen >= 6, "only {seen} rooms end at a rule");
}

/// Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine 17 (1998), table I, method 3.
#[test]
fn wilsons_interval_of_published_cases() {
    for (k, n, from, to) in [
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ] {
        let [low, high] = Probability::new(k, n).unwrap().interval;
        within("from", low, from, 5e-5);
        within("to", high, to, 5e-5);
    }
    assert_eq!(Probability::new(0, 0), None);
    let sorted = [1.0, 2.0, 4.0, 8.0];
    assert_eq!(quantile(&sorted, 0.5), Some(3.0));
    assert_eq!(quantile(&sorted, 0.0), Some(1.0));
    assert_eq!(quantile(&sorted, 1.0), Some(8.0));
    assert_eq!(quantile(&[], 0.5), None);
}

fn samples<'s>(
    study: &'s Study,
    one: &'s One,
    tolerances: &[(&str, &str)],
    count: u64,
) -> Samples<'s> {
    let scatter = |(path, text): &(&str, &str)| {
        Scatter::new(study, &Tolerance::parse(path, text).unwrap()).unwrap()
    };
    Samples {
        study,
        one,
        scatters: tolerances.iter().map(scatter).collect(),
        rules: vec![Rule::Speed],
        count,
        seed: 7,
    }
}

/// Draws have the mean and the spread that the file says, and do not depend on each other's order.
#[test]
fn draws_have_their_moments() {
    let (_folder, study) = study(RACK, 64);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    const N: u64 = 40_000;
    let samples = samples(
        &study,
        &one,
        &[("rack.mass", "normal 2 %"), ("pinion.radius", "±0.3 mm")],
        N,
    );
    let values: Vec<Vec<f64>> = (0..N).map(|k| samples.values(k)).collect();
    assert_eq!(samples.values(123), values[123]);
    let moments = |k: usize| {
        let mean = values.iter().map(|v| v[k]).sum::<f64>() / N as f64;
        let variance = values.iter().map(|v| (v[k] - mean).powi(2)).sum::<f64>() / N as f64;
        (mean, variance.sqrt())
    };
    // Five standard errors: σ/√n of the mean, σ/√(2n) of the deviation and less for a bounded one.
    let (mean, deviation) = moments(0);
    within("mass", mean, 85.0, 5.0 * 1.7 / 200.0);
    within(
        "its deviation",
        deviation,
        1.7,
        5.0 * 1.7 / (2.0 * 40_000.0f64).sqrt(),
    );
    let (mean, deviation) = moments(1);
    let sigma = 0.3 / 3.0f64.sqrt();
    within("radius", mean, 30.0, 5.0 * sigma / 200.0);
    within(
        "its deviation",
        deviation,
        sigma,
        5.0 * sigma / (2.0 * 40_000.0f64).sqrt(),
    );
    assert!(values.iter().all(|v| (29.7..=30.3).contains(&v[1])));
    let correlation = values
        .iter()
        .map(|v| (v[0] - 85.0) / 1.7 * (v[1] - 30.0) / sigma)
        .sum::<f64>()
        / N as f64;
    within("correlation", correlation, 0.0, 5.0 / 200.0);
}

/// The speed's share of its limit is proportional to the speed: with ±20 % about a share of 0.89 it holds in
/// (1/0.89 − 1 + 0.2)/0.4 of all machines.
#[test]
fn a_probability_in_closed_form() {
    let conveyor = include_str!("../../machines/conveyor.toml");
    let text = format!(
        "{conveyor}\n[rules]\nspeed = \"50 %\"\ninertia_ratio = 900\ninertia_ratio_warning = 900\n"
    );
    let (_folder, study) = study(&text, 16);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    const N: u64 = 2000;
    let samples = samples(&study, &one, &[("motion.speed", "20 %")], N);
    let mut hold = 0;
    for k in 0..N {
        let row = samples.row(k);
        let speed = row[0].number().unwrap();
        let share = speed * std::f64::consts::PI / 30.0 * 5.0 / 500.0;
        near("share", row[3].number().unwrap(), share, 1e-12);
        assert_eq!(row[1] == Cell::from("holds"), share <= 1.0);
        hold += u64::from(share <= 1.0);
    }
    let share = 850.0 * std::f64::consts::PI / 30.0 * 5.0 / 500.0;
    let expected = (1.0 / share - 1.0 + 0.2) / 0.4;
    let found = Probability::new(hold, N).unwrap();
    let deviation = (expected * (1.0 - expected) / N as f64).sqrt();
    within("probability", found.share, expected, 4.0 * deviation);
}

/// The command: the table of the file, shares that merge to the whole, a summary from the merged file.
#[test]
fn the_command_sums_up_shares_as_one_run() {
    let folder = Folder::new();
    let text = press_text()
        + "\n[tolerance]\n\"slider.mass\" = \"±5 %\"\n\"crank.length\" = { normal = \"0.1 mm\" }\n";
    let press = folder.file("press.toml", text);
    let [whole, merged] = ["whole.csv", "merged.csv"].map(|name| folder.path(name));
    let run = |out: &Path, more: &[&str], code: i32| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_jred"));
        command.arg("tolerance").arg(&press).args([
            "--samples",
            "60",
            "--steps",
            "64",
            "--tolerance",
            "drive_train.0.belt_mass=10%",
        ]);
        let output = command.args(more).arg("--out").arg(out).output().unwrap();
        assert!(
            output.status.code() == Some(code) || code < 0,
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).unwrap()
    };
    let summary = run(&whole, &[], -1);
    assert!(
        summary.contains("60 machines, seed 1") && summary.contains("every rule"),
        "{summary}"
    );
    assert!(
        summary.contains("mechanism.slider.mass uniform ± 2.1 kg"),
        "{summary}"
    );
    assert!(
        summary.contains("mechanism.crank.length normal ± 0.1 mm"),
        "{summary}"
    );
    let parts: Vec<_> = (0..2)
        .map(|k| {
            let part = folder.path(&format!("part-{k}.csv"));
            let share = run(&part, &["--shard", &format!("{k}/2")], -1);
            assert!(
                share.contains("30 machines") && share.contains("one share"),
                "{share}"
            );
            part
        })
        .collect();
    jred([&"merge", &merged, &parts[0], &parts[1]]).ends(0);
    assert_eq!(
        std::fs::read(&merged).unwrap(),
        std::fs::read(&whole).unwrap()
    );
    assert_eq!(run(&merged, &["--resume"], -1), summary);
    // Another seed is another study.
    let other = run(&merged, &["--resume", "--seed", "2"], 2);
    assert!(other.is_empty(), "{other}");
}

#[test]
fn wrong_tolerances_are_said() {
    let folder = Folder::new();
    let press =
        |line: &str| folder.file("press.toml", press_text() + "\n[tolerance]\n" + line + "\n");
    let says = |line: &str, words: &[&str]| jred([&"tolerance", &press(line)]).ends(2).says(words);
    says(
        "\"slider.mass\" = \"5\"",
        &["has no unit", "write \"±5 %\""],
    );
    says("\"slider.mass\" = \"-5 %\"", &["must be greater than zero"]);
    says(
        "\"slider.mass\" = \"5 mm\"",
        &["mechanism.slider.mass", "42 kg", "cannot be 5 mm"],
    );
    says(
        "\"slider.mas\" = \"5 %\"",
        &[
            "no quantity \"slider.mas\"",
            "did you mean \"slider.mass\"?",
        ],
    );
    says(
        "\"slider.mass\" = { gauss = \"5 %\" }",
        &["`gauss`", "not known"],
    );
    says("\"slider.mass\" = 5", &["must be a text"]);
    says("\"gravity.1\" = \"5 %\"", &["is a share of zero"]);
    let none = folder.file("none.toml", press_text());
    jred([&"tolerance", &none])
        .ends(2)
        .says(&["no quantity has a tolerance", "[tolerance]"]);
    let argument = jred([&"tolerance", &none, &"--tolerance", &"slider.mass"]);
    argument.ends(2).says(&["has no \"=\""]);
    let drive = jred([&"sensitivity", &none, &"--drive", &"sgmsh-10"]);
    drive.ends(2).says(&["no \"sgmsh-10\"", "did you mean"]);
}

/// The command lists what the library finds, in CSV every rule.
#[test]
fn the_command_lists_quantities() {
    let folder = Folder::new();
    let rack = folder.file("rack.toml", RACK);
    let run = jred([
        &"sensitivity",
        &rack,
        &"--steps",
        &"64",
        &"--most",
        &"5",
        &"--format",
        &"csv",
    ]);
    let names = run.out.lines().next().unwrap();
    assert!(
        names.starts_with("quantity,value,moves most,% of limit per +1 %"),
        "{names}"
    );
    assert!(
        names.contains("peak torque [% of limit per +1 %]"),
        "{names}"
    );
    assert!(
        run.out
            .lines()
            .any(|line| line.starts_with("mechanism.rack.mass,85 kg,")),
        "{}",
        run.out
    );
    let run = jred([&"sensitivity", &rack, &"--steps", &"64", &"--most", &"5"]);
    assert!(
        run.out
            .contains("not moved: motion.segment.0.move: the moves of this cycle add up to"),
        "{}",
        run.out
    );
}

/// A context of the study's drive: the same findings as those of `One`.
#[test]
fn one_drive_is_judged_as_in_the_catalogue() {
    let (_folder, study) = study(RACK, 64);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let machine = study.machine(&[]).unwrap();
    let motors = study.catalogue.prepare(&machine.file.site);
    let (index, drive) = study.drive("strong+five").unwrap();
    let duty = Duty::new(&machine.file, machine.file.motion.as_ref().unwrap(), 64).unwrap();
    let cycle = Cycle::new(&duty);
    let context = Context::new(&cycle, &machine.file.site, drive, &motors[index]);
    let (a, b) = (
        one.findings(&machine),
        context.findings(&machine.file.rules),
    );
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}
