//! Parts of the file's motion that `gentlest`, `fastest` and `size --motion best` keep, and their reports about it.

use crate::support::schema::faults;
use crate::support::{Folder, Run, jred_with, squeezed, typed};
use serde_json::json;

fn machine(name: &str) -> String {
    format!("{}/../../machines/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn jred(command: &str, name: &str, options: &[&str]) -> Run {
    let file = machine(name);
    jred_with(&[&[command, file.as_str()][..], options].concat())
}

/// The process of a machine is never dropped silently.
#[test]
#[ignore = "more than five seconds of a processor"]
fn the_process_of_a_machine_is_kept() {
    for (name, speed, drive) in [
        (
            "flying-shear",
            "2 m/s of x of drive",
            "sgm7a-20a+tp050ma-27.5",
        ),
        (
            "drawing-press",
            "0.08 m/s of x of slider",
            "sgm7j-06a+npt035ma-16",
        ),
        ("winder", "4 m/s of x of web", "1ft7108-5af7+sp140mf-3"),
    ] {
        for (command, options) in [
            ("gentlest", &[][..]),
            ("gentlest", &["--ends", "zero"]),
            ("fastest", &["--drive", drive]),
        ] {
            let run = jred(command, name, options);
            assert!(
                run.out.contains("  kept "),
                "{name}: {}{}",
                run.out,
                run.err
            );
            assert!(run.out.contains(speed), "{name}: {}", run.out);
        }
    }
    let run = jred("size", "flying-shear", &["--motion", "best"]);
    let says = squeezed(&run.out);
    assert!(says.contains("\nkept 2 m/s of x of drive"), "{}", run.out);
    let run = jred("gentlest", "shaper", &[]);
    assert!(run.out.contains("  not kept "), "{}", run.out);
}

/// Limits of segments that are not kept are named, with the options that keep them.
#[test]
fn limits_of_segments_are_not_dropped_without_a_word() {
    let drive = ["--torque", "20 N m", "--motor-speed", "3000 rpm"];
    let run = jred("fastest", "belt-axis", &drive);
    let says = "max_speed 1.6 m/s, max_acceleration 10 m/s^2, max_jerk 400 m/s^3 of the segments in the file are not kept; to keep them, give --max-speed, --max-acceleration, --max-jerk";
    assert!(run.out.contains(says), "{}", run.out);
    let limits = [
        &drive[..],
        &["--max-speed", "1.6 m/s", "--max-acceleration", "10 m/s^2"],
    ]
    .concat();
    let run = jred("fastest", "belt-axis", &limits);
    assert!(
        squeezed(&run.out).contains("limits max_jerk 400 m/s^3 of"),
        "{}",
        run.out
    );
    let run = jred("gentlest", "belt-axis", &[]);
    assert!(run.out.contains("max_speed 1.6 m/s"), "{}", run.out);
}

/// The same for `size --motion best`, in text and JSON.
#[test]
fn a_motion_for_a_drive_drops_no_limit_without_a_word() {
    let options = ["--motion", "best", "--top", "1", "--steps", "64"];
    let run = jred("size", "belt-axis", &options);
    let says = "max_speed 1.6 m/s, max_acceleration 10 m/s^2, max_jerk 400 m/s^3 of the segments in the file are not kept";
    assert!(
        squeezed(&run.out).contains(&format!("\nlimits {says}\n")),
        "{}",
        run.out
    );
    let answer = jred(
        "size",
        "belt-axis",
        &[&options[..], &["--format", "json"]].concat(),
    )
    .json();
    let faults = faults(&answer);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert_eq!(answer["motion"]["from"], "gentlest");
    assert_eq!(answer["motion"]["not kept"][0], says);
    let gentlest = jred("gentlest", "belt-axis", &["--format", "json"]).json();
    assert_eq!(gentlest["not_kept"][0], says);
}

/// If every drive that is suitable with its own motion is larger than the best one with the file's motion, the file's motion is kept.
#[test]
fn a_motion_that_needs_a_larger_drive_is_not_taken() {
    for more in [&[][..], &["--max-mass", "10 kg"]] {
        let options = [
            &["--top", "1", "--steps", "64", "--format", "json"][..],
            more,
        ]
        .concat();
        let own = jred("size", "belt-conveyor", &options).json();
        let run = jred(
            "size",
            "belt-conveyor",
            &[&options[..], &["--motion", "best"]].concat(),
        );
        assert!(
            run.message()
                .contains("Motion: that of the file is kept, with which the best drive is"),
            "{}",
            run.err
        );
        let made = run.json();
        let faults = faults(&made);
        assert!(faults.is_empty(), "{}", faults.join("\n"));
        let motion = &made["motion"];
        assert_eq!(motion["from"], "file");
        assert!(motion["made for"].is_null() && motion["not kept"] == json!([]));
        let [before, best] = [
            "best with the file's motion",
            "best with a motion of its own",
        ]
        .map(|key| motion[key]["rated power [W]"].as_f64().unwrap());
        assert!(before < best, "{before} {best}");
        assert_eq!(made["fit"], own["fit"]);
        assert_eq!(
            motion["best with the file's motion"]["motor"],
            own["fit"][0]["motor"]
        );
    }
}

/// A stop whose law overshoots its end by 0.0042° is one move to its end, in every command.
#[test]
fn the_overshoot_of_a_law_is_no_move() {
    let folder = Folder::new();
    let file = folder.file(
        "table.toml",
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n\
         table = { diameter = \"600 mm\", mass = \"20 kg\" }\n\
         [motion]\ntype = \"point-to-point\"\nstart = \"200 deg\"\n\
         [[motion.segment]]\nlaw = \"constant-speed\"\nspeed = \"60 rpm\"\nmove = \"20 deg\"\n\
         [[motion.segment]]\nlaw = \"polynomial-5\"\nmove = \"140 deg\"\nduration = \"1 s\"\n",
    );
    let file = file.to_str().unwrap();
    let says = "segment 2 goes 0.004157 deg beyond its end and comes back";
    let drive = ["--torque", "100 N m", "--motor-speed", "3000 rpm"];
    for (command, options) in [("gentlest", &[][..]), ("fastest", &drive)] {
        let run = jred_with(&[&[command, file][..], options].concat());
        assert!(run.out.contains(says), "{}{}", run.out, run.err);
        assert!(
            run.out.contains("move 1") && !run.out.contains("move 2"),
            "{}",
            run.out
        );
    }
    let run = jred_with(&["check", file]);
    let whole = [&run.out[..], &run.err].concat();
    assert!(whole.contains(&format!("warning: {says}")), "{whole}");
}

/// A move that ends in motion neither repeats nor holds; too fast an end is answered in the given unit.
#[test]
fn a_passing_move_neither_repeats_nor_stands() {
    let passing = typed("--torque '20 N m' --motor-speed '300 rpm' --from '0 deg' --to '360 deg'");
    let speeds = ["--from-speed", "20 rpm", "--to-speed", "10 rpm"];
    let run = jred("fastest", "rotary-table", &[&passing[..], &speeds].concat());
    assert!(run.out.contains("move 1"), "{}{}", run.out, run.err);
    for line in ["more rest each time", "to hold the end"] {
        assert!(!run.out.contains(line), "{}", run.out);
    }
    let fast = ["--from-speed", "6000 rpm"];
    let run = jred("fastest", "rotary-table", &[&passing[..], &fast].concat());
    assert!(run.message().contains("rpm at the most"), "{}", run.err);
    assert!(
        run.message().contains("a longer distance does not help"),
        "{}",
        run.err
    );
}

/// Sentences about equal figures, and cures that help.
#[test]
fn sentences_say_what_they_mean() {
    let run = jred("gentlest", "rotary-table", &["--objective", "peak"]);
    assert!(
        !run.out.contains("as as") && !run.out.contains("than as"),
        "{}",
        run.out
    );
    let run = jred("simulate", "belt-axis", &["--drive", "sgm7g-03a"]);
    assert!(run.message().contains("no [simulation]"), "{}", run.err);
    assert!(!run.message().contains("and torque"), "{}", run.err);
    let run = jred("gentlest", "belt-axis", &["--drive", "sgm7g-45a"]);
    assert!(
        run.message().contains("did you mean \"sgm7g-"),
        "{}",
        run.err
    );
}
