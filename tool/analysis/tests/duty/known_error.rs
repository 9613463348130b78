//! Integrals over the cycle against closed forms, at any number of instants: over many turns, through stages with losses, over recorded rows; and
//! duties that cannot be found.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::Path;

use crate::reader;
use crate::support::{Folder, budget, near, press_text, within};
use jred_analysis::duty::{Duty, DutyError, Sampling};
use jred_analysis::inspect::Findings;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Motion, Node};

/// 3 kg at 200 mm of a table of 20 kg, which turns about a level axis.
const DRUM: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "500 mm", mass = "20 kg" }
[[mass]]
on = "table"
mass = "3 kg"
at = ["200 mm", "0 mm"]
"#;

/// Its largest torque (N·m).
const TORQUE: f64 = 3.0 * 9.81 * 0.2;

/// Its moment of inertia (kg·m²): a disc of 250 mm radius and a point.
const INERTIA: f64 = 20.0 * 0.25 * 0.25 / 2.0 + 3.0 * 0.2 * 0.2;

fn turning(degrees: f64, more: &str) -> MachineFile {
    let text = format!(
        "{DRUM}{more}[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"constant-speed\"\nmove = \"{degrees} deg\"\nspeed = \"600 rpm\"\n"
    );
    reader::parse("drum.toml", &text, Path::new("")).unwrap()
}

fn duty(file: &MachineFile, sampling: impl Into<Sampling>) -> Result<Duty, DutyError> {
    Duty::new(file, file.motion.as_ref().unwrap(), sampling)
}

/// The weight of an unbalanced drum is a sine over the turn, however many turns there are.
#[test]
fn a_thousand_turns_have_the_load_of_one() {
    for (turns, steps) in [(1.0, 16), (1.0, 2000), (10.0, 16), (1000.0, 2000)] {
        let duty = duty(&turning(360.0 * turns, ""), steps).unwrap();
        let figures = duty.figures(|i| i.input_torque);
        near("RMS", figures.rms, TORQUE / 2f64.sqrt(), budget::DUTY);
        within("mean", figures.mean, 0.0, budget::DUTY * TORQUE);
        near("most", figures.max, TORQUE, budget::DUTY);
        near("least", figures.min, -TORQUE, budget::DUTY);
        let power = duty.figures(|i| i.input_torque * i.input_speed);
        near(
            "power",
            power.rms,
            TORQUE * 20.0 * PI / 2f64.sqrt(),
            budget::DUTY,
        );
        // ⟨|sin|³⟩ = 4/(3π).
        let cubes = duty.integral(|i| i.input_torque.abs().powi(3)) / duty.duration;
        near(
            "cubes",
            cubes,
            TORQUE.powi(3) * 4.0 / (3.0 * PI),
            budget::DUTY,
        );
    }
}

/// A sine through stages with losses: T/(i·η) where power flows to the drum, T·η/i where it flows back.
#[test]
fn losses_change_sides_with_the_power() {
    let stages = |count: usize| {
        let stage = "{ driver = { teeth = 20, inertia = \"0 kg m^2\" }, driven = { teeth = 40, inertia = \"0 kg m^2\" }, efficiency = \"90 %\" }";
        format!(
            "[[drive_train]]\ntype = \"gear-train\"\nstage = [{}]\n",
            vec![stage; count].join(", ")
        )
    };
    for count in [1, 2] {
        let eta = 0.9f64.powi(count as i32);
        let ratio = 2f64.powi(count as i32);
        for (turns, steps) in [(1.0, 16), (1.0, 2000), (100.0, 16)] {
            let duty = duty(&turning(360.0 * turns, &stages(count)), steps).unwrap();
            let figures = duty.figures(|i| i.input_torque.abs());
            let [most, mean] = [TORQUE / ratio, TORQUE / ratio / PI];
            near("mean", figures.mean, mean * (1.0 / eta + eta), budget::DUTY);
            let rms = most * ((1.0 / (eta * eta) + eta * eta) / 4.0).sqrt();
            near("RMS", figures.rms, rms, budget::DUTY);
            // The sign of the speed at the input is that of the gear train.
            let work = duty.integral(|i| i.input_torque * i.input_speed);
            let lost = 2.0 * TORQUE * turns * (1.0 / eta - eta);
            near("lost", work, lost, budget::DUTY);
        }
    }
}

/// With an inertia on the shaft between two stages each turns its power at a time of its own: the work at the input is what the stages lose, each by
/// what it delivers.
#[test]
fn each_stage_turns_at_its_own_time() {
    let train = "[[drive_train]]\ntype = \"gear-train\"\nstage = [{ driver = { teeth = 20, inertia = \"0.1 kg m^2\" }, driven = { teeth = 40, \
                 inertia = \"0 kg m^2\" }, efficiency = \"90 %\" }, { driver = { teeth = 20, inertia = \"0.05 kg m^2\" }, driven = { teeth = 40, \
                 inertia = \"0 kg m^2\" }, efficiency = \"80 %\" }]\n";
    let text = format!(
        "{DRUM}{train}[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"720 deg\"\nduration = \"2 s\"\n"
    );
    let file = reader::parse("drum.toml", &text, Path::new("")).unwrap();
    // By trapezoids over the closed form of law and weight: an integrand that vanishes with two derivatives at both ends.
    let count = 1_000_000;
    let mut sums = [0.0; 2];
    for k in 0..count {
        let z = f64::from(k) / f64::from(count);
        let phi = 2.0 * (TAU * z - (TAU * z).sin());
        let omega = TAU * (1.0 - (TAU * z).cos());
        let alpha = PI * TAU * (TAU * z).sin();
        let mut torque = INERTIA * alpha + TORQUE * phi.cos();
        let (mut speed, mut rate) = (omega, alpha);
        for (eta, inertia) in [(0.8, 0.05), (0.9, 0.1)] {
            let side = if torque * speed < 0.0 { eta } else { 1.0 / eta };
            (speed, rate) = (-2.0 * speed, -2.0 * rate);
            torque = -torque / 2.0 * side + inertia * rate;
        }
        sums[0] += torque * torque / f64::from(count);
        sums[1] += torque * speed * 2.0 / f64::from(count);
    }
    for steps in [16, 500, 2000] {
        let duty = duty(&file, steps).unwrap();
        let figures = duty.figures(|i| i.input_torque);
        // The inertia on the driver's side of the first stage and that of the file's teeth are as written.
        near("RMS", figures.rms, sums[0].sqrt(), budget::QUADRATURE);
        let work = duty.integral(|i| i.input_torque * i.input_speed);
        near("work", work, sums[1], budget::QUADRATURE);
    }
}

/// A torque of forty periods a turn, at few instants: it is found all the same.
#[test]
fn a_torque_of_many_periods_a_turn() {
    let folder = Folder::new();
    let mut csv = "phi [deg],moment [N m]\n".to_owned();
    for k in 0..=3600 {
        let phi = f64::from(k) / 10.0;
        let _ = writeln!(
            csv,
            "{phi:.1},{:.12}",
            7.0 * (40.0 * phi.to_radians()).sin()
        );
    }
    folder.file("teeth.csv", csv);
    let text = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = { diameter = \"500 mm\", mass = \"20 kg\" }\n\
                [[load]]\non = \"table\"\ntable = \"teeth.csv\"\n[motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n";
    let file = reader::parse("teeth.toml", text, folder.path("")).unwrap();
    for steps in [16, 2000] {
        let figures = duty(&file, steps).unwrap().figures(|i| i.input_torque);
        // The curve through 90 rows a period: 5/384·(TAU/90)⁴ of the amplitude.
        near("RMS", figures.rms, 7.0 / 2f64.sqrt(), 1e-6);
        within("mean", figures.mean, 0.0, budget::DUTY * 7.0);
    }
}

/// A recorded speed, in few instants and many: a sine of 36 periods, whose torque is J·α.
#[test]
fn rows_are_seen() {
    let folder = Folder::new();
    let (base, most, rate) = (20.0, 5.0, 0.72);
    let mut csv = "t [s],omega [rad/s]\n".to_owned();
    for k in 0..=5000 {
        let t = f64::from(k) / 100.0;
        let _ = writeln!(csv, "{t:.6},{:.12}", base + most * (TAU * rate * t).sin());
    }
    folder.file("record.csv", csv);
    let text = format!(
        "{}[motion]\ntype = \"profile\"\nfile = \"record.csv\"\ncyclic = false\n",
        DRUM.split("[[mass]]").next().unwrap()
    );
    let file = reader::parse("table.toml", &text, folder.path("")).unwrap();
    let of = |sampling: Sampling| duty(&file, sampling).unwrap().figures(|i| i.input_torque);
    let fine = of(Sampling {
        tolerance: 1e-12,
        steps: 20_000,
    });
    let inertia = 20.0 * 0.25 * 0.25 / 2.0;
    let exact = inertia * most * TAU * rate / 2f64.sqrt();
    // The slope of the curve through 139 rows a period is off by the fourth power of the step in the mean of its square.
    near("RMS", fine.rms, exact, 1e-6);
    for steps in [16, 2000] {
        near("RMS", of(steps.into()).rms, fine.rms, budget::DUTY);
        within("mean", of(steps.into()).mean, 0.0, budget::DUTY * exact);
    }
}

/// The result does not depend on the tolerance otherwise.
#[test]
fn a_smaller_tolerance_changes_nothing() {
    let file = reader::parse("press.toml", &press_text(), Path::new("")).unwrap();
    let of = |tolerance: f64, steps: usize| {
        let duty = duty(&file, Sampling { tolerance, steps }).unwrap();
        let torque = duty.figures(|i| i.input_torque);
        let power = duty.figures(|i| i.input_torque * i.input_speed);
        let cubes = duty.integral(|i| i.input_speed.abs() * i.input_torque.abs().powf(10.0 / 3.0));
        [torque.mean, torque.rms, power.mean, power.rms, cubes]
    };
    let fine = of(1e-12, 20_000);
    for (tolerance, steps) in [(1e-9, 16), (1e-9, 2000), (1e-12, 16), (1e-6, 16)] {
        for (found, fine) in of(tolerance, steps).into_iter().zip(fine) {
            near("integral", found, fine, tolerance.max(1e-11));
        }
    }
}

/// More turns than fit into memory are an error that says so, at once.
#[test]
fn too_many_turns_are_refused() {
    let fault = duty(&turning(360e6, ""), 2000).unwrap_err();
    assert!(matches!(fault, DutyError::Fine { .. }), "{fault}");
    let words = format!("{fault}; {}", fault.cure());
    for part in ["4000000 instants", "of 100000 s", "one cycle that repeats"] {
        assert!(words.contains(part), "{words}");
    }
    // No tolerance helps.
    assert!(!words.contains("--tolerance"), "{words}");
}

/// Dry friction adds its square over the time of the moves to ∫T², for the acceleration's mean is zero: whatever the law, and however its speed is
/// rounded where it comes to rest.
#[test]
fn friction_ends_where_a_move_rests() {
    let of = |moment: f64, segment: &str| {
        let text = format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = {{ inertia = \"0.5 kg m^2\" }}\n\
             [[load]]\non = \"table\"\nopposing_moment = \"{moment} N m\"\n[motion]\ntype = \"cycle\"\n\
             [[motion.segment]]\n{segment}\n[[motion.segment]]\ndwell = \"0.3 s\"\n"
        );
        let file = reader::parse("table.toml", &text, Path::new("")).unwrap();
        let duty = duty(&file, 2000).unwrap_or_else(|fault| panic!("{segment}: {fault}"));
        let time = file.motion.as_ref().unwrap().duration() - 0.3;
        (duty.integral(|i| i.input_torque * i.input_torque), time)
    };
    let mut segments: Vec<String> = [
        "polynomial-345",
        "polynomial-4567",
        "cycloidal",
        "modified-sine",
    ]
    .map(|law| format!("law = \"{law}\"\nmove = \"90 deg\"\nduration = \"0.37 s\""))
    .into();
    for way in [30, 45, 50, 70, 90, 110, 200, 333] {
        for speed in [40, 60, 90] {
            segments.push(format!(
                "law = \"jerk-limited\"\nmove = \"{way} deg\"\nmax_speed = \"{speed} rpm\"\nmax_acceleration = \"40 rad/s^2\"\n\
                 max_jerk = \"1000 rad/s^3\""
            ));
        }
    }
    for segment in &segments {
        let (without, time) = of(0.0, segment);
        for moment in [1e-3, 2.0, 500.0] {
            let (with, _) = of(moment, segment);
            near(
                segment,
                with,
                without + moment * moment * time,
                budget::DUTY,
            );
        }
    }
}

/// J·ω² is no part of the torque at an even speed: a light load of many harmonics on a fast flywheel is found as exactly as on a small one.
#[test]
fn a_flywheel_hides_no_error() {
    let of = |flywheel: &str, tolerance: f64| {
        let text = format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\nflywheel = \"{flywheel} kg m^2\"\n\
             crank = {{ length = \"30 mm\", mass = \"0 kg\", inertia = \"0 kg m^2\" }}\n\
             rod = {{ length = \"30.3 mm\", mass = \"0 kg\", inertia = \"0 kg m^2\" }}\nslider = {{ mass = \"0 kg\" }}\n\
             [[load]]\non = \"slider\"\nviscous_force = \"0.02 N s/m\"\n[motion]\ntype = \"cycle\"\n\
             [[motion.segment]]\nlaw = \"constant-speed\"\nspeed = \"6000 rpm\"\nmove = \"36000 deg\"\n"
        );
        let file = reader::parse("crank.toml", &text, Path::new("")).unwrap();
        let sampling = Sampling {
            tolerance,
            steps: 64,
        };
        duty(&file, sampling).unwrap().figures(|i| i.input_torque)
    };
    // c·ω·(ds/dφ)², s = r·cos φ + √(l² − r²·sin²φ), at equal places: exact but for roundings.
    let (r, l, omega) = (0.03_f64, 0.0303_f64, 200.0 * PI);
    let places = 1 << 16;
    let torque = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(places)).sin_cos();
        let slope = -r * sin - r * r * sin * cos / (l * l - r * r * sin * sin).sqrt();
        0.02 * omega * slope * slope
    };
    let mean = (0..places).map(torque).sum::<f64>() / f64::from(places);
    let square = (0..places).map(|k| torque(k).powi(2)).sum::<f64>() / f64::from(places);
    for flywheel in ["0.001", "2", "200"] {
        for tolerance in [1e-9, 1e-6, 1e-3] {
            let found = of(flywheel, tolerance);
            near(flywheel, found.mean, mean, 4.0 * tolerance);
            near(flywheel, found.rms, square.sqrt(), 4.0 * tolerance);
        }
    }
}

/// `check` sees every turn, or some whole ones; a motion at an even speed, whose acceleration is a rounding, and one with times that are
/// rounded satisfy it.
#[test]
fn work_and_energy_of_many_turns_agree() {
    let holds = |file: &MachineFile| {
        let findings = Findings::of(file).unwrap();
        assert!(findings.holds(), "{:?}", findings.violations());
    };
    for turns in [1.0, 1000.0, 3000.0, 5000.0, 1e6] {
        holds(&turning(360.0 * turns, ""));
    }
    for tiny in [
        "dwell = \"1e7 s\"",
        "dwell = \"1 us\"",
        "law = \"polynomial-345\"\nmove = \"360 deg\"\nduration = \"1 us\"",
    ] {
        let text = format!(
            "{DRUM}[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"360 deg\"\nduration = \"3600 s\"\n\
             [[motion.segment]]\n{tiny}\n"
        );
        holds(&reader::parse("drum.toml", &text, Path::new("")).unwrap());
    }
    let folder = Folder::new();
    for (header, scale) in [
        ("phi [deg]", 3.6),
        ("phi [rad]", 0.06),
        ("phi [turn]", 0.01),
    ] {
        let rows =
            (0..=200).map(|k| format!("{:.4},{:.6}\n", 0.005 * f64::from(k), scale * f64::from(k)));
        folder.file(
            "log.csv",
            format!("t [s],{header}\n{}", rows.collect::<String>()),
        );
        let text = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = { inertia = \"1 kg m^2\" }\n\
                    [motion]\ntype = \"profile\"\nfile = \"log.csv\"\ncyclic = false\n";
        holds(&reader::parse("table.toml", text, folder.path("").as_path()).unwrap());
    }
}

/// A microsecond in an hour is resolved, or is an error that names it; a nanosecond is refused when the file is read.
#[test]
fn a_microsecond_in_an_hour() {
    let text = |tiny: &str| {
        format!(
            "{DRUM}[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"360 deg\"\nduration = \"3600 s\"\n\
             [[motion.segment]]\n{tiny}\n"
        )
    };
    let parse = |tiny: &str| reader::parse("drum.toml", &text(tiny), Path::new(""));
    let of = |tiny: &str| duty(&parse(tiny).unwrap(), 2000);
    assert!(parse("dwell = \"1e-9 s\"").is_err());
    let [still, without] = ["1e-6", "1e-5"].map(|time| {
        let duty = of(&format!("dwell = \"{time} s\"")).unwrap();
        duty.figures(|i| i.input_torque).rms
    });
    near("RMS", still, without, 1e-8);
    // A whole turn in that time: its acceleration is all that counts, 2π·2π/T² in the sine, and the time is known to 5e-7 of it.
    match of("law = \"cycloidal\"\nmove = \"360 deg\"\nduration = \"1e-6 s\"") {
        Ok(duty) => {
            let squares = duty.integral(|i| i.input_torque * i.input_torque);
            let most = INERTIA * TAU * TAU / 1e-12;
            near("T²", squares, most * most * 0.5e-6, 1e-5);
        }
        Err(fault) => {
            let words = fault.to_string();
            assert!(words.contains("between 3600"), "{words}");
        }
    }
}

/// Positions that do not belong to the speeds: the weight would give energy from nowhere.
#[test]
fn energy_from_nowhere_is_an_error() {
    let file = turning(360.0, "");
    let node = |t: f64, phi: f64| Node {
        t,
        step: if t > 0.0 { 0.5 } else { 0.0 },
        phi,
        omega: 1.0,
        alpha: [0.0; 2],
    };
    // 1 rad/s for 1 s is 1 rad, not 1.2 rad.
    let right = Motion::nodes(&[node(0.0, 0.0), node(0.5, 0.5), node(1.0, 1.0)], false);
    assert!(Duty::new(&file, &right, 2000).is_ok());
    let wrong = Motion::nodes(&[node(0.0, 0.0), node(0.5, 0.5), node(1.0, 1.2)], false);
    let fault = Duty::new(&file, &wrong, 2000).unwrap_err();
    let DutyError::Unbalanced { work, spent, .. } = fault else {
        panic!("{fault}");
    };
    near("gain", spent, TORQUE * 1.2f64.sin(), 1e-8);
    assert!((work - spent).abs() > 1e-3, "{work} {spent}");
    let words = format!("{fault}; {}", fault.cure());
    for part in ["does not balance", "between 0", "must belong together"] {
        assert!(words.contains(part), "{words}");
    }
}
