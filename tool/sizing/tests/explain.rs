//! Contributions to a drive's torque, and changes that would make it suitable.

mod outline;
mod remedies;

use jred::mechanism::TrainOutput;
use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::catalogue::Drive;
use jred_sizing::explain::{Alteration, Breakdown, Contributions, DutyModel, Effect, Share};

use crate::support::{budget, edited, near, press_text, within};

fn parse(text: &str) -> MachineFile {
    checked::parse("machine.toml", text, Path::new("")).unwrap()
}

fn machine(name: &str) -> MachineFile {
    checked::read(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../machines")
            .join(name),
    )
    .unwrap()
}

fn duty_of(file: &MachineFile) -> Duty {
    Duty::new(file, file.motion.as_ref().unwrap(), 2000).unwrap()
}

fn catalogue() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

/// A drive with all losses: friction, brake, a lossy gearbox.
fn lossy(catalogue: &mut Catalogue) -> Drive<'_> {
    let motor = &mut catalogue.motors[3];
    motor.friction = [0.05, 2e-4];
    motor.brake = Some(jred_sizing::catalogue::Brake {
        torque: 20.0,
        inertia: 3e-4,
        ..Default::default()
    });
    let gearbox = &mut catalogue.gearboxes[2];
    (gearbox.efficiency, gearbox.back_efficiency) = (0.9, 0.85);
    gearbox.no_load_torque = 0.12;
    Drive {
        motor: &catalogue.motors[3],
        gearbox: Some(&catalogue.gearboxes[2]),
        amplifier: None,
    }
}

/// A carriage on a turning arm has its share of J, m·r², under its own name, and the arm keeps its own share; so do torques by inertia, and the sum
/// is the motor's torque.
#[test]
fn a_carriage_has_its_own_share() {
    let text = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "2 m", mass = "4 kg" }
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "360 deg"
duration = "1 s"
[[carriage]]
name = "trolley"
on = "table"
mass = "3 kg"
at = ["0.2 m", "0 mm"]
stroke = ["0 mm", "800 mm"]
[carriage.motion]
type = "cycle"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "800 mm"
duration = "0.4 s"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "-800 mm"
duration = "0.6 s"
"#;
    let file = parse(text);
    let duty = duty_of(&file);
    let mut catalogue = catalogue();
    let drive = lossy(&mut catalogue);
    let ratio = drive.ratio();
    let contributions = Contributions::new(&file, &duty, &drive).unwrap();
    let carriage = &file.schedule.carriages()[0];
    let of = |part: &str, effect: Effect| {
        let all = contributions.torques.iter();
        let mut found = all.filter(|c| c.part == part && c.effect == effect);
        let one = found.next().unwrap_or_else(|| panic!("{part} {effect:?}"));
        assert!(found.next().is_none());
        &one.torque
    };
    let [table, trolley] = ["table", "trolley"].map(|part| of(part, Effect::Acceleration));
    let second = of("trolley", Effect::Carriage);
    let mut most = [0.0f64; 2];
    for (k, i) in duty.instants.iter().enumerate() {
        let s = carriage.motion.at(i.t);
        let r = 0.2 + s.phi;
        within("table", table[k], 2.0 * i.alpha / ratio, 1e-9);
        within("trolley", trolley[k], 3.0 * r * r * i.alpha / ratio, 1e-9);
        let coriolis = 2.0 * 3.0 * r * s.omega * i.omega / ratio;
        within("second axis", second[k], coriolis, 1e-9);
        most = [most[0].max(trolley[k].abs()), most[1].max(coriolis.abs())];
    }
    assert!(most.iter().all(|torque| *torque > 1.0), "{most:?}");
    let breakdown = Breakdown::new(&file, &duty, &drive).unwrap();
    let share = |name: &str| {
        let found = breakdown.inertia.iter().find(|share| share.name == name);
        found.unwrap().inertia
    };
    within("least", share("table").max, 2.0 / (ratio * ratio), 1e-12);
    within("most", share("trolley").max, 3.0 / (ratio * ratio), 1e-9);
}

fn total(shares: &[Share], of: impl Fn(&Share) -> f64) -> f64 {
    shares.iter().map(of).sum()
}

/// Every machine that comes with the tool: links, weights, springs, dampers, belts, slides.
#[test]
fn the_cells_of_every_instant_add_up_to_the_motor_torque() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut machines = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let Ok(file) = checked::read(&path) else {
            continue;
        };
        if file.motion.is_none() || file.variator.is_some() {
            continue;
        }
        let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 400).unwrap();
        let mut catalogue = catalogue();
        let geared = lossy(&mut catalogue);
        let direct = Drive {
            gearbox: None,
            ..geared
        };
        for drive in [geared, direct] {
            let torques: Vec<f64> = duty
                .instants
                .iter()
                .map(|i| drive.motor_point(i).torque)
                .collect();
            let largest = crate::support::largest(&torques);
            let contributions = Contributions::new(&file, &duty, &drive).unwrap();
            for (k, torque) in torques.iter().enumerate() {
                let sum = contributions.torques.iter().map(|cell| cell.torque[k]);
                let name = format!("{} at {k}", path.display());
                within(&name, sum.sum(), *torque, budget::CELLS * largest);
            }
            let breakdown = Breakdown::of(&duty, &drive, &contributions);
            for shares in [&breakdown.effects, &breakdown.parts] {
                let squares = total(shares, |s| s.mean_square);
                within("mean square", squares, 1.0, budget::CELLS);
                let at_peak = total(shares, |s| s.at_peak);
                within("peak", at_peak.abs(), largest, budget::CELLS * largest);
            }
            // The inertias add up to that of λ.
            let rotor = drive.motor.rotor_inertia;
            let brake = drive.motor.brake.unwrap().inertia;
            for (found, load) in [
                (
                    breakdown.total_inertia.inertia.min,
                    duty.figures(|i| i.input_inertia).min,
                ),
                (
                    breakdown.total_inertia.inertia.max,
                    duty.figures(|i| i.input_inertia).max,
                ),
            ] {
                let expected = (drive.inertia_ratio(load) + 1.0) * (rotor + brake);
                near("inertia", found, expected, budget::SAME_SUMS);
            }
        }
        machines += 1;
    }
    assert!(machines > 12, "{machines} machines");
}

/// Properties of the press independent of this code: stored energies return over a closed cycle, losses do not.
#[test]
fn energies_of_the_press() {
    let file = machine("press.toml");
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 40_000).unwrap();
    let mut catalogue = catalogue();
    let drive = lossy(&mut catalogue);
    let breakdown = Breakdown::new(&file, &duty, &drive).unwrap();
    let effect = |start: &str| {
        let mut effects = breakdown.effects.iter();
        effects.find(|e| e.name.starts_with(start)).unwrap()
    };
    let stored = effect("acceleration").energy + effect("velocity").energy;
    let turned_over = duty.integral(|i| (i.terms.acceleration * i.omega).abs());
    within(
        "kinetic energy",
        stored,
        0.0,
        budget::CLOSED_CYCLE * turned_over,
    );
    for name in [
        "weight",
        "rotor",
        "gearbox, inertia",
        "drive train, inertia",
    ] {
        let energy = effect(name).energy;
        within(name, energy, 0.0, budget::CLOSED_CYCLE * turned_over);
    }
    // The belt's losses, stage by stage: the train gives them as power.
    let train = &file.drive_train;
    let loss = duty.integral(|i| {
        train
            .input(&TrainOutput {
                torque: i.terms.total(),
                torque_per_alpha: i.inertia,
                omega: i.omega,
                alpha: i.alpha,
                direction: i.omega,
            })
            .loss
    });
    near(
        "belt",
        effect("drive train, losses").energy,
        loss,
        budget::SAME_SUMS,
    );
    // 150 N over twice the stroke of 60 mm; Coulomb friction of the guide alone.
    near(
        "guide",
        effect("dry friction").energy,
        150.0 * 0.12,
        budget::DEFAULT_STEPS,
    );
    // The motor's and the gearbox's friction: c·∫|n| and b·∫n².
    let angle = duty.integral(|i| i.input_speed.abs()) * drive.ratio();
    let square = duty.integral(|i| i.input_speed.powi(2)) * drive.ratio().powi(2);
    let own = 0.05 * angle + 2e-4 * square;
    near(
        "motor friction",
        effect("motor friction").energy,
        own,
        budget::SAME_SUMS,
    );
    // Together they are the work of the motor.
    let sum = total(&breakdown.effects, |e| e.energy);
    near("work", sum, breakdown.total.energy, budget::SAME_SUMS);
    let work = duty.integral(|i| {
        let point = drive.motor_point(i);
        point.torque * point.speed
    });
    near(
        "work of the motor",
        breakdown.total.energy,
        work,
        budget::SAME_SUMS,
    );
}

/// A slower, lighter press with another force, from an edited file, against the alteration.
#[test]
fn an_altered_duty_is_that_of_the_altered_file() {
    let (time, mass, process) = (1.5, 0.8, 0.6);
    let file = parse(&press_text());
    let duty = duty_of(&file);
    let altered = DutyModel::new(&file, &duty).unwrap();
    let found = altered.duty(Alteration {
        time,
        mass,
        process,
    });
    let mut text = press_text();
    for (from, to) in [
        ("duration = \"0.4 s\"", "duration = \"0.6 s\""),
        ("dwell = \"0.1 s\"", "dwell = \"0.15 s\""),
        ("\"-10 kN\"", "\"-6 kN\""),
        ("flywheel = \"0.05 kg m^2\"", "flywheel = \"0.04 kg m^2\""),
        ("mass = \"9 kg\"", "mass = \"7.2 kg\""),
        ("inertia = \"0.018 kg m^2\"", "inertia = \"0.0144 kg m^2\""),
        ("mass = \"6.5 kg\"", "mass = \"5.2 kg\""),
        (
            "inertia = \"0.03 kg m^2\"\ncom = [\"55 mm\"",
            "inertia = \"0.024 kg m^2\"\ncom = [\"55 mm\"",
        ),
        ("mass = \"42 kg\"", "mass = \"33.6 kg\""),
    ] {
        text = edited(&text, from, to);
    }
    let other = parse(&text);
    let expected = duty_of(&other);
    near(
        "duration",
        found.duration,
        expected.duration,
        budget::SAME_SUMS,
    );
    near(
        "holding torque",
        found.hold_torque,
        expected.hold_torque,
        budget::SAME_SUMS,
    );
    for (name, quantity) in [
        (
            "torque",
            (|i| i.input_torque) as fn(&jred_analysis::duty::Instant) -> f64,
        ),
        ("speed", |i| i.input_speed),
        ("acceleration", |i| i.input_alpha),
        ("inertia", |i| i.input_inertia),
    ] {
        let (a, b) = (found.figures(quantity), expected.figures(quantity));
        near(name, a.rms, b.rms, budget::DEFAULT_STEPS);
        near(name, a.peak(), b.peak(), budget::DEFAULT_PEAK);
    }
    // Unaltered, it is the duty itself.
    let same = altered.duty(Alteration::default());
    for (a, b) in same.instants.iter().zip(&duty.instants) {
        within(
            "unaltered",
            a.input_torque,
            b.input_torque,
            1e-12 * b.input_torque.abs(),
        );
    }
    near(
        "holding torque",
        same.hold_torque,
        duty.hold_torque,
        budget::SAME_SUMS,
    );
}

/// Belts and screws, too: with what the drive link needs for itself, and with a stage before it.
#[test]
fn an_altered_duty_loads_the_elements_as_the_altered_file() {
    let text = "gravity = [\"-9.81 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"ball-screw\"\nlead = \"20 mm\"\n\
        max_force = \"9 kN\"\nscrew = { inertia = \"6.4 kg cm^2\" }\nnut = { mass = \"140 kg\" }\n\
        [[load]]\non = \"nut\"\nforce = [\"-800 N\", \"0 N\"]\n[[load]]\non = \"screw\"\nmoment = \"-2 N m\"\n\
        [[load]]\non = \"screw\"\nopposing_moment = \"0.4 N m\"\n\
        [[drive_train]]\ntype = \"belt\"\nmax_effective_force = \"900 N\"\nbelt_mass = \"0.3 kg\"\nefficiency = \"96 %\"\n\
        driver = { radius = \"20 mm\", inertia = \"1 kg cm^2\" }\ndriven = { radius = \"40 mm\", inertia = \"7 kg cm^2\" }\n\
        [motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"7200 deg\"\nduration = \"1.2 s\"\n\
        [[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"-7200 deg\"\nduration = \"1.2 s\"\n";
    let file = parse(text);
    let duty = duty_of(&file);
    let model = DutyModel::new(&file, &duty).unwrap();
    let found = model.duty(Alteration {
        time: 1.5,
        mass: 0.8,
        process: 0.6,
    });
    let mut text = text.to_owned();
    for (from, to) in [
        ("duration = \"1.2 s\"", "duration = \"1.8 s\""),
        ("duration = \"1.2 s\"", "duration = \"1.8 s\""),
        ("\"-800 N\"", "\"-480 N\""),
        ("\"-2 N m\"", "\"-1.2 N m\""),
        ("\"6.4 kg cm^2\"", "\"5.12 kg cm^2\""),
        ("\"140 kg\"", "\"112 kg\""),
    ] {
        text = edited(&text, from, to);
    }
    let expected = duty_of(&parse(&text)).mechanics.elements;
    let pairs = found.mechanics.elements.iter().zip(&expected);
    assert_eq!(pairs.len(), 2);
    for (a, b) in pairs {
        near("force", a.force, b.force, budget::DEFAULT_PEAK);
        near("speed", a.speed, b.speed, budget::DEFAULT_PEAK);
    }
    let nut = 112.0 * (9.81 + 5.773_502_691_896_258 * 0.4 / 3.24) + 480.0;
    near(
        "nut",
        found.mechanics.elements[1].force,
        nut,
        budget::DEFAULT_PEAK,
    );
}

/// The same for a lift whose payload comes and goes, with static friction and a load in a segment; also its holding torque.
#[test]
fn an_altered_lift_is_that_of_the_altered_file() {
    let text = include_str!("../../../machines/pick-and-place.toml");
    let file = parse(text);
    let duty = duty_of(&file);
    let altered = DutyModel::new(&file, &duty).unwrap();
    let found = altered.duty(Alteration {
        time: 2.0,
        mass: 0.5,
        process: 0.6,
    });
    let mut text = text.to_owned();
    for (from, to) in [
        ("dwell = \"0.3 s\"", "dwell = \"0.6 s\""),
        ("dwell = \"0.3 s\"", "dwell = \"0.6 s\""),
        ("\"0.7 s\"", "\"1.4 s\""),
        ("\"0.5 s\"", "\"1 s\""),
        ("\"120 N\"", "\"72 N\""),
        ("mass = \"1.4 kg\"", "mass = \"0.7 kg\""),
        ("\"11 kg cm^2\"", "\"5.5 kg cm^2\""),
        ("mass = \"14 kg\"", "mass = \"7 kg\""),
        ("mass = \"8 kg\"", "mass = \"4 kg\""),
    ] {
        text = edited(&text, from, to);
    }
    let expected = duty_of(&parse(&text));
    near("duration", found.duration, 3.6, budget::SAME_SUMS);
    let hold = (7.0 + 4.0) * 9.81 * 0.04;
    near("hold", found.hold_torque, hold, budget::SAME_SUMS);
    near("hold", expected.hold_torque, hold, budget::SAME_SUMS);
    let figures = |duty: &Duty| duty.figures(|i| i.input_torque);
    let (a, b) = (figures(&found), figures(&expected));
    near("rms", a.rms, b.rms, budget::DEFAULT_STEPS);
    near("most", a.max, b.max, budget::DEFAULT_PEAK);
    near("least", a.min, b.min, budget::DEFAULT_PEAK);
    // Weight with the part, static friction of the guide and the brush, before it goes up.
    let broken = found.instants.iter().filter(|i| i.omega == 0.0);
    let most = broken.map(|i| i.input_torque).fold(0.0, f64::max);
    near(
        "static",
        most,
        hold + (60.0 + 45.0) * 0.04,
        budget::SAME_SUMS,
    );
}

/// A spring is not a mass: it keeps its torque without the masses.
#[test]
fn springs_keep_their_torque_without_masses() {
    let file = machine("linkage-four-bar.toml");
    assert!(!file.elements.is_empty(), "a machine with a spring");
    let duty = duty_of(&file);
    let altered = DutyModel::new(&file, &duty).unwrap();
    let light = altered.duty(Alteration {
        mass: 0.0,
        ..Alteration::default()
    });
    let mut catalogue = catalogue();
    let drive = lossy(&mut catalogue);
    let contributions = Contributions::new(&file, &duty, &drive).unwrap();
    let springs = contributions
        .torques
        .iter()
        .filter(|c| c.effect == Effect::Springs);
    let ratio = drive.ratio() * file.drive_train.ratio();
    let springs: Vec<&Vec<f64>> = springs.map(|c| &c.torque).collect();
    let mut largest = 0.0f64;
    for (k, instant) in light.instants.iter().enumerate() {
        let spring: f64 = springs.iter().map(|s| s[k] * ratio).sum();
        let scale = duty.instants[k].terms.potential.abs() + spring.abs();
        within("spring", instant.terms.potential, spring, 1e-11 * scale);
        assert!(instant.inertia.abs() <= 0.0 && instant.terms.acceleration.abs() <= 0.0);
        largest = largest.max(spring.abs());
    }
    assert!(largest > 0.0);
}
