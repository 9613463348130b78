//! The duty of a motion at the input of the drive link: laws, recorded moves, short loads.
// Zeros and copied figures are exact.
#![allow(clippy::float_cmp)]

mod every_machine;
mod known_error;

use std::fmt::Write as _;
use std::path::Path;

use crate::reader;
use crate::support::machines::CONSTANT_SPEED;
use crate::support::{Folder, budget, near, press_text, within};
use jred::machine::motion::Law;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Motion, MotionSegment};
use jred_file::units::RPM;

fn read(text: &str) -> MachineFile {
    reader::parse("machine.toml", text, Path::new("")).unwrap()
}

fn duty_of(file: &MachineFile, steps: usize) -> Duty {
    Duty::new(file, file.motion.as_ref().unwrap(), steps).unwrap()
}

/// A rotor in balance at constant speed needs nothing but what its friction takes.
#[test]
fn constant_speed_needs_only_friction() {
    let duty = duty_of(&read(CONSTANT_SPEED), 50);
    near("cycle", duty.duration, 0.2, 1e-14);
    let speed = -300.0 * RPM;
    let expected = -6.0 / 3.0 + 0.05 * speed;
    for instant in &duty.instants {
        near("torque", instant.input_torque, expected, 1e-14);
        near("speed", instant.input_speed, speed, 1e-15);
        assert_eq!(instant.input_alpha, 0.0);
    }
    assert_eq!(duty.hold_torque, 0.0);
}

/// A segment shorter than rounding, as a calculated motion may hold one, changes nothing of a machine with load windows.
#[test]
fn a_sliver_of_a_segment_changes_nothing() {
    let text = press_text();
    let file = read(&text);
    let of = |segments: &[MotionSegment]| {
        let motion = Motion::segments(std::f64::consts::PI, segments, true).unwrap();
        Duty::new(&file, &motion, 50).unwrap()
    };
    let turn = MotionSegment::law(2.0 * std::f64::consts::PI, 0.4, Law::Polynomial345);
    let [with, without] = [
        of(&[turn.clone(), MotionSegment::dwell(1e-15)]),
        of(std::slice::from_ref(&turn)),
    ];
    assert!(!file.machine.loads().is_empty());
    near("cycle", with.duration, without.duration, 1e-14);
    let largest = |duty: &Duty| {
        let torques = duty.instants.iter().map(|now| now.input_torque.abs());
        torques.fold(0.0, f64::max)
    };
    near("torque", largest(&with), largest(&without), 1e-12);
}

/// Over every law, the integral of ω is the way and that of α nothing; those of ω² and α² are the law's constants.
#[test]
fn laws_integrate_to_their_way() {
    use std::f64::consts::PI;
    let file = read(TABLE);
    // ∫S′² dz and ∫S″² dz in closed form.
    let quarters = Law::Trapezoid {
        accelerate: 0.25,
        decelerate: 0.5,
    };
    let top = 1.0 / (1.0 - 0.375); // largest speed of the trapezoid
    let cases = [
        (
            quarters,
            top * top * (0.25 / 3.0 + 0.25 + 0.5 / 3.0),
            top * top * (1.0 / 0.25 + 1.0 / 0.5),
        ),
        (Law::Polynomial345, 10.0 / 7.0, 120.0 / 7.0),
        (Law::Cycloidal, 1.5, 2.0 * PI * PI),
        (Law::ModifiedSine, f64::NAN, f64::NAN),
    ];
    for (law, speed_squared, alpha_squared) in cases {
        for (way, duration) in [(3.7, 0.8), (-12.0, 0.3)] {
            let segments = [
                MotionSegment::law(way, duration, law),
                MotionSegment::dwell(0.25),
            ];
            let motion = Motion::segments(0.4, &segments, false).unwrap();
            let duty = Duty::new(&file, &motion, 2000).unwrap();
            near("cycle", duty.duration, duration + 0.25, 1e-15);
            near("weights", duty.integral(|_| 1.0), duration + 0.25, 1e-13);
            near("way", duty.integral(|i| i.omega), way, budget::SIMPSON);
            let alpha = way.abs() / duration;
            within(
                "∫α",
                duty.integral(|i| i.alpha),
                0.0,
                budget::SIMPSON * alpha,
            );
            if speed_squared.is_finite() {
                let squares = duty.integral(|i| i.omega * i.omega);
                near(
                    "∫ω²",
                    squares,
                    speed_squared * way * way / duration,
                    budget::SIMPSON,
                );
                let squares = duty.integral(|i| i.alpha * i.alpha);
                let expected = alpha_squared * way * way / duration.powi(3);
                near("∫α²", squares, expected, budget::SIMPSON);
            }
            // ω and α are the derivatives of φ: a step of the motion is what Taylor says.
            for k in 1..200 {
                let t = duration * (f64::from(k) + 0.35) / 200.0;
                let h = duration * 1e-5;
                let (a, b) = (motion.at(t - h), motion.at(t + h));
                let now = motion.at(t);
                let size = way.abs() / duration;
                within("ω", (b.phi - a.phi) / (2.0 * h), now.omega, 1e-8 * size);
                within(
                    "α",
                    (b.omega - a.omega) / (2.0 * h),
                    now.alpha,
                    1e-7 * size / duration,
                );
            }
            let end = motion.at(duration + 0.1);
            near("end", end.phi, 0.4 + way, 1e-14);
            assert_eq!((end.omega, end.alpha), (0.0, 0.0));
        }
    }
}

/// J = 0.05 kg m² and nothing else.
const TABLE: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.01 kg m^2"
stage = [{ driver = { teeth = 20, inertia = "0.02 kg m^2" }, driven = { teeth = 40, inertia = "0.08 kg m^2" } }]
"#;

/// A move recorded at equal times: the RMS torque is that of the law, with the fourth power of the recording step.
#[test]
fn a_recorded_move_gives_the_torque_of_its_law() {
    use std::f64::consts::{PI, TAU};
    let folder = Folder::new();
    let duration = 0.8;
    let rms_of = |samples: i32, cyclic: bool| {
        let mut csv = "t [s],phi [deg]\n".to_owned();
        for k in 0..=samples {
            let z = f64::from(k) / f64::from(samples);
            let phi = 360.0 * (z - (TAU * z).sin() / TAU);
            let _ = writeln!(csv, "{:.12},{phi:.12}", duration * z);
        }
        folder.file("move.csv", csv);
        let text = format!(
            "{TABLE}\n[motion]\ntype = \"profile\"\nfile = \"move.csv\"\ncyclic = {cyclic}\n"
        );
        let file = reader::parse("m.toml", &text, folder.path("")).unwrap();
        let duty = duty_of(&file, 4000);
        near("cycle", duty.duration, duration, 1e-12);
        duty.figures(|i| i.input_torque).rms
    };
    // α = (2π/T²)·2π·sin: RMS 1/√2 of it.
    let exact = 0.05 * 2.0 * PI * TAU / (duration * duration) / 2f64.sqrt();
    // The curvature of the cubic spline through the samples has an error of order 2 that swings about zero within each
    // cell; in the RMS it cancels to order 4.
    let errors = [25, 50, 100].map(|samples| rms_of(samples, true) / exact - 1.0);
    println!("relative errors of the RMS: {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).abs().log2();
        within("order", order, 4.0, budget::PROFILE_ORDER);
    }
    // With free ends, the end cells add an error of their own.
    for cyclic in [true, false] {
        near("RMS", rms_of(25, cyclic), exact, budget::PROFILE_RMS);
    }
}

/// A blow of 5 MN over 0.1° falls between two steps of the cycle: its work F·Δx must be in the duty all the same.
#[test]
fn a_load_of_a_moment_is_not_missed() {
    let blow = |size: &str| {
        let load = format!(
            "[[load]]\non = \"slider\"\nforce = [\"{size}\", \"0 N\"]\nbetween = [\"330.3 deg\", \"330.4 deg\"]\nramp = \"0.02 deg\"\n"
        );
        let text = press_text().replacen("# Toothed belt", &format!("{load}\n# Toothed belt"), 1);
        let file = read(&text);
        let duty = duty_of(&file, 2000);
        duty.integral(|i| i.terms.total() * i.omega)
    };
    // The ramps of 0.02° pass half the force on average: 0.08° at full size. The ram moves by x′ = dx/dφ a radian, from
    // (4.1): x = r·cos φ + √(l² − r²·sin² φ).
    let (r, l, phi) = (0.03f64, 0.18f64, 330.35f64.to_radians());
    let slope =
        -r * phi.sin() - r * r * phi.sin() * phi.cos() / (l * l - (r * phi.sin()).powi(2)).sqrt();
    let work = 5e6 * slope * 0.08f64.to_radians();
    let found = blow("-5000 kN") - blow("0 N");
    within("work of the blow", found, work, budget::BLOW * work);
}

/// A load that hangs on a drum is a moment: what holds it at rest must be in the holding torque.
#[test]
fn a_hanging_moment_is_held() {
    let text = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
                driver = { radius = \"30 mm\", inertia = \"3 kg cm^2\" }\n\
                driven = { radius = \"90 mm\", inertia = \"0.35 kg m^2\" }\n\
                [[load]]\non = \"shaft-2\"\nmoment = \"-13.5 N m\"\n\
                [motion]\ntype = \"cycle\"\n[[motion.segment]]\nmove = \"360 deg\"\nduration = \"1 s\"\n\
                law = \"cycloidal\"\n[[motion.segment]]\ndwell = \"20 s\"\n";
    within("held", duty_of(&read(text), 2000).hold_torque, 4.5, 1e-12);
}

/// A recorded dwell is a dwell: the roundings of the curve through its positions are no motion that friction resists.
#[test]
fn a_recorded_dwell_stands_still() {
    let folder = Folder::new();
    let mut csv = "t [s],phi [deg]\n".to_owned();
    for k in 0..=400 {
        let z = (f64::from(k) / 200.0).min(1.0); // a 3-4-5 polynomial in 1 s, then 1 s at rest
        let phi = 360.0 * z * z * z * (10.0 - 15.0 * z + 6.0 * z * z);
        let _ = writeln!(csv, "{:.4},{phi:.12}", f64::from(k) / 200.0);
    }
    folder.file("dwell.csv", csv);
    let friction = "\n[[load]]\non = \"shaft-1\"\nopposing_moment = \"3 N m\"\n";
    let text = format!("{TABLE}{friction}[motion]\ntype = \"profile\"\nfile = \"dwell.csv\"\n");
    let duty = duty_of(
        &reader::parse("m.toml", &text, folder.path("")).unwrap(),
        2000,
    );
    // The curve swings on for some samples after the move: 10 of 5 ms, and as many before the next.
    let dwell = duty.instants.iter().filter(|i| i.t > 1.05 && i.t < 1.95);
    let (count, resisted) = dwell.fold((0, 0.0f64), |(count, most), i| {
        (count + 1, most.max(i.terms.coulomb.abs()))
    });
    assert!(count > 500, "{count}");
    assert_eq!(resisted, 0.0);
}

/// A dwell without torque bends nowhere: it takes the steps that were asked for, and no more.
#[test]
fn a_dwell_without_torque_takes_no_more_instants() {
    let text = format!(
        "{TABLE}[motion]\ntype = \"cycle\"\n[[motion.segment]]\nmove = \"360 deg\"\nduration = \"1 s\"\n\
         law = \"cycloidal\"\n[[motion.segment]]\ndwell = \"1 s\"\n"
    );
    let duty = duty_of(&read(&text), 2000);
    let dwell = duty.instants.iter().filter(|i| i.t > 1.0).count();
    assert!((900..=1100).contains(&dwell), "{dwell}");
}

/// The press under a force on a short way, at `turns` turns forth and back.
fn turning(turns: u32) -> String {
    let text = press_text();
    let (machine, _) = text.split_once("[[motion.segment]]").unwrap();
    let law = "law = \"polynomial-345\"\nduration = \"1000 s\"";
    format!(
        "{machine}\n[[motion.segment]]\n{law}\nmove = \"{0} deg\"\n[[motion.segment]]\n{law}\nmove = \"-{0} deg\"\n",
        360 * turns
    )
}

/// The force has four edges, so that 600 turns forth and back pass 4800, and 700 turns too many. A motion of a million radians
/// took 90 s to check and a gigabyte to sample.
#[test]
fn a_motion_that_passes_too_many_edges_is_refused() {
    let parse = |turns| reader::parse("machine.toml", &turning(turns), Path::new(""));
    assert!(parse(600).is_ok());
    for turns in [700, 159_155] {
        let problem = parse(turns).unwrap_err();
        let words = format!("{problem} {}", problem.cure().unwrap());
        let passed = format!(
            "passes edges of loads or cams {} times; at most 5000",
            8 * turns
        );
        assert!(words.contains(&passed), "{words}");
        assert!(words.contains("describe one cycle that repeats"), "{words}");
    }
}

/// Many turns in a small share of the cycle: a dwell after them, however long, changes nothing of what they need.
#[test]
fn every_turn_of_a_long_cycle_has_its_load() {
    let text = press_text();
    let (machine, _) = text.split_once("[[motion.segment]]").unwrap();
    let square = |dwell: &str| {
        let text = format!(
            "{machine}\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"72000 deg\"\nduration = \"200 s\"\n\
             [[motion.segment]]\ndwell = \"{dwell}\"\n"
        );
        duty_of(&read(&text), 2000).integral(|i| i.input_torque * i.input_torque)
    };
    let [short, long] = ["1 s", "20000 s"].map(square);
    assert!(
        (long / short - 1.0).abs() < budget::LOADS_FOUND,
        "{short} {long}"
    );
}

/// However many segments bend sharply, and in however many steps: the instants between the steps are limited in number.
#[test]
fn instants_between_steps_are_limited() {
    let mut text = CONSTANT_SPEED.split("[motion]").next().unwrap().to_owned();
    text += "[motion]\ntype = \"cycle\"\n";
    for _ in 0..1000 {
        text += "[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"0.36 deg\"\nduration = \"0.4 ms\"\n";
    }
    let file = read(&text);
    for steps in [100, 200_000] {
        let duty = duty_of(&file, steps);
        let (count, weighed) = (duty.instants.len(), duty.instants.iter());
        let weighed = weighed.filter(|i| i.weight > 0.0).count();
        assert!(weighed >= steps && count > weighed, "{weighed} of {count}");
        assert!(count <= 1_000_000 + weighed, "{count}");
    }
}
