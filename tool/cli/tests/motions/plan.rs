//! A computed motion as a plan for firmware.

use super::run;
use crate::support::{Folder, press_text};

/// Firmware that follows the plan matches the motion within the stated errors; the Rust source has the same words, and the identifier of the table.
#[test]
fn a_plan_is_the_motion() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let press = press.to_str().unwrap();
    let [plan, source, c_source, table] =
        ["p.jred", "p.rs", "press_plan.h", "t.jred"].map(|name| folder.path(name));
    let fastest = |plan: &std::path::Path, format: &str| {
        run(&[
            "fastest",
            press,
            "--torque",
            "50 N m",
            "--motor-speed",
            "3000 rpm",
            "--max-speed",
            "28 rad/s",
            "--format",
            format,
            "--instants",
            "1001",
            "--plan-error",
            "0.02 %",
            "--plan",
            plan.to_str().unwrap(),
        ])
        .ends(0)
    };
    let course = fastest(&plan, "csv").columns();
    assert!(fastest(&source, "table").out.contains("rows, "));
    run(&[
        "export",
        press,
        "--torque-error",
        "2 N m",
        "--layout",
        "spline",
        "--out",
        table.to_str().unwrap(),
    ])
    .ends(0);
    let words = |path: &std::path::Path| -> Vec<u32> {
        let bytes = std::fs::read(path).unwrap();
        bytes
            .chunks(4)
            .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
            .collect()
    };
    let (words, table) = (words(&plan), words(&table));
    fastest(&c_source, "table");
    let [text, c_text] = [&source, &c_source].map(|path| std::fs::read_to_string(path).unwrap());
    for text in [&text, &c_text] {
        let rows = text.lines().filter(|line| line.starts_with("    0x"));
        let hexadecimal = rows
            .flat_map(|row| row.split("0x").skip(1))
            .map(|rest| u32::from_str_radix(&rest[..8], 16).unwrap());
        assert_eq!(hexadecimal.collect::<Vec<_>>(), words);
    }
    // Every C and C++ extension, in any case, gives the same text.
    for ending in ["hh", "hpp", "hxx", "c", "cc", "cpp", "CPP", "cxx"] {
        let other = folder.path(&format!("press_plan.{ending}"));
        fastest(&other, "table");
        assert_eq!(std::fs::read_to_string(&other).unwrap(), c_text, "{ending}");
    }
    let array = format!("const uint32_t press_plan_words[{}] =", words.len());
    assert!(c_text.contains(&array), "{c_text}");
    let image = jred::Image::new(&table).unwrap();
    assert!(text.contains(&format!("MACHINE: u32 = 0x{:08x}", image.machine())));
    let machine = format!("#define PRESS_PLAN_MACHINE 0x{:08x}u", image.machine());
    assert!(c_text.contains(&machine), "{c_text}");
    let model = image.any_model::<jred::Spline<f32>>().unwrap();
    let read = jred::axis::Plan::new(&words, &model).unwrap();
    let read = read.of_machine(image.machine()).unwrap();
    let errors = read.errors();
    let column = |name: &str| course.get(name);
    let [times, positions] = [column("t [s]"), column("phi [deg]")];
    let [speeds, accelerations] = [column("omega [rad/s]"), column("alpha [rad/s^2]")];
    let last = times.len() - 1;
    assert_eq!(last, 1000);
    let mut beyond = 0;
    for k in 0..last {
        let (t, position, speed) = (times[k], positions[k], speeds[k]);
        let acceleration = accelerations[k];
        let place = read.at((t * 2f64.powi(40)) as u64).value;
        let turns =
            f64::from(place.turns) + f64::from(place.motion.phase.to_bits()) / 2f64.powi(32);
        let position_error = (turns * 360.0 - position).to_radians().abs();
        assert!(
            position_error <= 1.01 * f64::from(errors.position) + 1e-7,
            "{t}: {position_error:e}"
        );
        let speed_error = (f64::from(place.motion.omega) - speed).abs();
        assert!(
            speed_error <= 1.01 * f64::from(errors.speed) + 1e-5,
            "{t}: {speed_error:e}"
        );
        let error = (f64::from(place.motion.alpha) - acceleration).abs();
        // An instant may be on a corner.
        beyond += usize::from(error > 1.05 * f64::from(errors.acceleration) + 1e-3);
    }
    assert!(beyond <= 2, "{beyond}");
}

/// An error that is not a share is refused; one that the integers cannot keep is reported.
#[test]
fn the_error_of_a_plan_is_looked_at() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let (press, plan) = (press.to_str().unwrap(), folder.path("p.jred"));
    let refused = |more: &[&str], says: &str| {
        let mut arguments = vec!["gentlest", press];
        arguments.extend(more);
        run(&arguments).ends(2).says(&[says]);
    };
    refused(&["--plan-error", "1 %"], "--plan");
    // Finer than the integers: written, with a warning.
    run(&[
        "fastest",
        press,
        "--torque",
        "50 N m",
        "--motor-speed",
        "3000 rpm",
        "--plan",
        plan.to_str().unwrap(),
        "--plan-error",
        "0.0001 %",
    ])
    .ends(0)
    .says(&[
        "warning: the error of the plan's acceleration is",
        "but --plan-error allows",
        "give a larger --plan-error",
    ]);
    refused(
        &["--plan", plan.to_str().unwrap(), "--plan-error", "50 %"],
        "from 0.0001 % to 10 %",
    );
}

/// An unknown extension is refused before anything is computed.
#[test]
fn a_plan_has_a_known_ending() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    for name in ["q.txt", "q", "q.rs.bak"] {
        let plan = folder.path(name);
        let arguments = [
            "gentlest",
            press.to_str().unwrap(),
            "--plan",
            plan.to_str().unwrap(),
        ];
        run(&arguments).ends(2).says(&[".rs is Rust source"]);
        assert!(!plan.exists(), "{name}");
    }
}
