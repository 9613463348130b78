//! Bounded drives: a boom lifted by a cylinder, and a crank that swings.

use jred::Domain;
use jred::machine::{Mechanism as _, Reducible as _};
use jred_file::model::coordinate::Coordinate;

use super::{FOUR_BAR, close, parse, read, refuses, refuses_edits};
use crate::reading::{parse_in, rendered, says};
use crate::support::Folder;
use crate::support::machines::{LIFT, LIFT_MOTION, SCREW};

/// θ′, and cos θ, of the lift at s.
pub(crate) fn boom(s: f64) -> [f64; 2] {
    let cos = (0.25 + 0.36 - s * s) / 0.6;
    let sin = (1.0 - cos * cos).sqrt();
    [s / (0.3 * sin), cos]
}

#[test]
fn a_cylinder_lifts_a_boom() {
    let file = read(LIFT);
    let mechanism = file.machine.mechanism();
    assert_eq!(mechanism.coordinate(), Coordinate::Length);
    assert_eq!(mechanism.domain(), Domain::Stroke { from: 0.4, to: 0.8 });
    for k in 0..=40 {
        let s = 0.4 + 0.01 * f64::from(k);
        let [slope, cos] = boom(s);
        let mass = (100.0 * 0.64 + 10.0) * slope * slope;
        let force = 100.0 * 9.81 * 0.8 * cos * slope;
        let reduced = file.machine.reduction(s).unwrap();
        close(reduced.inertia, mass, 1e-9);
        close(reduced.load_torque(), -force, 1e-9);
        let drive = file.machine.forces(s, 0.1, 0.5).unwrap().drive;
        close(drive, reduced.torque(0.1, 0.5).total(), 1e-8);
    }
}

#[test]
fn loads_in_a_part_of_the_stroke() {
    let load = "\n[[load]]\non = \"boom\"\nmoment = \"-90 N m\"\nbetween = [\"500 mm\", \"600 mm\"]\nramp = \"20 mm\"\n";
    let text = format!("{LIFT}{load}");
    let file = read(&text);
    let part = |s: f64| file.machine.reduction(s).unwrap().process / (-90.0 * boom(s)[0]);
    for (s, expected) in [
        (0.45, 0.0),
        (0.499, 0.0),
        (0.51, 0.5),
        (0.52, 1.0),
        (0.55, 1.0),
        (0.59, 0.5),
        (0.61, 0.0),
        (0.8, 0.0),
    ] {
        close(part(s), expected, 1e-10);
    }
    let edits = r#"
        ramp = "20 mm" => ramp = "60 mm" => too long for the range of 100 mm | at most 50 mm
        ramp = "20 mm" => ramp = "20 deg" => must be a length | is an angle
        ramp = "20 mm" => => `ramp` in [[load]] number 1 is missing
        ["500 mm", "600 mm"] => ["600 mm", "500 mm"] => runs from 600 mm to 500 mm | the larger one
        ["500 mm", "600 mm"] => ["900 mm", "1000 mm"] => is outside the stroke, 400 mm to 800 mm
        between = ["500 mm", "600 mm"] => => `between` in [[load]] number 1 is missing
    "#;
    refuses_edits(&text, edits);
}

#[test]
fn motions_of_a_sliding_drive() {
    let text = format!("{LIFT}{LIFT_MOTION}");
    let file = read(&text);
    let motion = file.motion.as_ref().unwrap();
    close(motion.at(0.0).phi, 0.45, 0.0);
    close(motion.at(3.5).phi, 0.75, 1e-15);
    close(motion.at(1.5).omega, 1.875 * 0.3 / 3.0, 1e-13);

    let edits = r#"
        move = "300 mm" => move = "400 mm" =>
            [[motion.segment]] number 1 ends at s = 850 mm, outside the stroke, 400 mm to 800 mm | leaves the stroke
        move = "300 mm" => move = "300 deg" => must be a length | is an angle
        move = "-300 mm" => move = "-290 mm" => add up to 10 mm | a move of -10 mm | point-to-point
        start = "450 mm" => start = "300 mm" => is 300 mm, outside the stroke, 400 mm to 800 mm
        start = "450 mm" => start = "45 deg" => must be a length
        type = "cycle" => type = "constant-speed"\nspeed = "0.1 m/s" => cannot move on forever | moves forth and back
        [motion] => [[drive_train]]\ntype = "belt"\ndriver = { radius = "30 mm", inertia = "2 kg cm^2" }\ndriven = { radius = "60 mm", inertia = "2 kg cm^2" }\n[motion] =>
            every stage of [[drive_train]] turns | ball-screw | radius = "30 mm"
        [motion] => [[drive_train]]\ntype = "rack"\nradius = "30 mm"\ninertia = "2 kg cm^2"\n[[drive_train]]\ntype = "belt"\n[motion] =>
            comes after a rack, whose output slides | the last stage
        [motion] => [[drive_train]]\ntype = "ball-screw"\nlead = "0 mm"\ninertia = "2 kg cm^2"\n[motion] =>
            `lead` | greater than zero
    "#;
    refuses_edits(&text, edits);
    let edits = r#"
        drive = "cylinder" => drive = "cylinder"\nflywheel = "1 kg m^2" =>
            `flywheel` in [mechanism] is for a rotating drive link | slides
    "#;
    refuses_edits(LIFT, edits);
    let edits = r#"
        [[load]] => [[drive_train]]\ntype = "rack"\nradius = "30 mm"\ninertia = "2 kg cm^2"\n[[load]] =>
            the drive link of this mechanism turns
    "#;
    refuses_edits(FOUR_BAR, edits);
}

#[test]
fn recorded_motions_of_a_sliding_drive() {
    let folder = Folder::new();
    let text =
        format!("{LIFT}\n[motion]\ntype = \"profile\"\nfile = \"way.csv\"\ncyclic = false\n");
    let read = |rows: &str| {
        folder.file("way.csv", rows);
        parse_in(&text, &folder.path(""))
    };
    let file = read("t [s],s [mm]\n0,450\n1,460\n2,480\n3,510\n4,550\n").unwrap();
    close(file.motion.unwrap().at(0.0).phi, 0.45, 0.0);
    let refused = |rows: &str, words: &str| says(&rendered(&read(rows).unwrap_err()), &[words]);
    refused(
        "t [s],phi [deg]\n0,450\n1,460\n2,480\n3,510\n4,550\n",
        "s [mm]",
    );
    refused(
        "t [s],s [mm]\n0,450\n1,460\n2,480\n3,510\n4,950\n",
        "s = 950 mm is outside the stroke, 400 mm to 800 mm",
    );
}

#[test]
fn free_motions_of_a_sliding_drive() {
    let free = format!(
        "{LIFT}\n[simulation]\nstart_position = \"500 mm\"\nstart_speed = \"0.3 m/s\"\nduration = \"0.05 s\"\n\
         output_step = \"5 ms\"\nforce = \"0 N\"\ntolerance = 1e-12\n"
    );
    let edits = r#"
        start_position = "500 mm" => start_angle = "50 deg" => `start_position` in [simulation] | start_angle
        start_position = "500 mm" => start_position = "900 mm" => is 900 mm, outside the stroke
        start_speed = "0.3 m/s" => start_speed = "3 rpm" => must be a speed
        force = "0 N" => torque = "0 N m" => unknown key `torque` in [simulation] | force, force_speed
    "#;
    refuses_edits(&free, edits);
    // With a screw the motor turns, and the drive link itself can be pushed.
    let screw = free.replace(
        "force = \"0 N\"",
        "torque = \"0 N m\"\nrotor_inertia = \"3 kg cm^2\"",
    );
    let screw = screw.replace("[simulation]", &format!("{SCREW}\n[simulation]"));
    assert!(parse(&screw).is_ok());
    let pushed = screw.replace("torque = \"0 N m\"", "at = \"drive-link\"\nforce = \"0 N\"");
    assert!(parse(&pushed).is_ok());
}

#[test]
fn a_crank_that_swings() {
    let text = FOUR_BAR
        .replace(
            "{ A = [\"80 mm\", \"0 mm\"] }",
            "{ A = [\"200 mm\", \"0 mm\"] }",
        )
        .replace(
            "drive = \"crank bearing\"",
            "drive = \"crank bearing\"\nstroke = [\"-60 deg\", \"90 deg\"]",
        );
    let motion = "\n[motion]\ntype = \"cycle\"\nstart = \"-50 deg\"\n[[motion.segment]]\nmove = \"120 deg\"\nlaw = \"cycloidal\"\n\
                  duration = \"1 s\"\n[[motion.segment]]\nmove = \"-120 deg\"\nlaw = \"cycloidal\"\nduration = \"1 s\"\n";
    let text = format!("{text}{motion}");
    let file = read(&text);
    close(
        file.motion.as_ref().unwrap().at(1.0).phi,
        70f64.to_radians(),
        1e-12,
    );
    let edits = r#"
        "-50 deg" => "-10 deg" => ends at φ = 110 deg, outside the stroke, -60 deg to 90 deg
        move = "-120 deg" => move = "-100 deg" => add up to 20 deg
    "#;
    refuses_edits(&text, edits);
    refuses(
        &text.replace(
            "moment = \"-6 N m\"",
            "moment = \"-6 N m\"\nbetween = [\"100 deg\", \"120 deg\"]\nramp = \"5 deg\"",
        ),
        &["is outside the stroke, -60 deg to 90 deg"],
    );
}

/// The stroke is shown as it is written, in its unit; the core's error has a wider range, in rad or m.
#[test]
fn a_stroke_far_from_the_drawing_is_shown_as_it_is_written() {
    let edits = r#"
        drive = "crank bearing" => drive = "crank bearing"\nstroke = ["900 deg", "910 deg"] =>
            the drawing shows the drive at | deg, far from its range from 900 deg to 910 deg | ["900 deg", "910 deg"]
    "#;
    refuses_edits(FOUR_BAR, edits);
}
