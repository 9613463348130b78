//! `type = "disc-cam"`.

use jred::machine::Mechanism as _;
use jred::machine::motion::Law;
use jred::mechanism::cam::contact_force;

use super::{close, example, machine, parse, refuses_edit, refuses_edits, rendered};

const DOC: &str = include_str!("../../../../docs/mechanisms/disc-cam.md");

#[test]
fn the_sealing_jaw_is_read_in_si_units() {
    let file = machine("cam-translating.toml");
    let cam = file.machine.mechanism();
    assert_eq!(cam.kind(), "disc-cam");
    assert_eq!(cam.link_names(), ["cam", "follower", "roller"]);
    assert_eq!(
        cam.joint_names(),
        ["cam pivot", "guide", "contact", "roller pin", "rolling"]
    );
    let frames = cam.frames(0.5).unwrap();
    let rest = (0.061_f64.powi(2) - 0.008_f64.powi(2)).sqrt();
    close(frames[1].x.value, 0.008);
    close(frames[1].y.value, rest);
    close(cam.frames(3.0).unwrap()[1].y.value, rest + 0.03);
    close(cam.links()[1].mass(), 5.2);
    close(cam.links()[2].inertia(), 0.22e-4);
    // Base circle over the first dwell; the outline is the profile.
    let profile = cam.outlines(0).next().unwrap();
    close(profile[0][0].hypot(profile[0][1]), 0.045);
    let rim = cam.outlines(2).next().unwrap();
    close(rim[7][0].hypot(rim[7][1]), 0.016);
    // The spring on the jaw and its weight, along the guide, against the contact: the offset leans the normal.
    let force = contact_force(&file.machine, 2, 0.5, 0.0, 0.0).unwrap();
    let weight = (5.2 + 0.16) * 9.81;
    close(force * rest / 0.061, 150.0 + weight);
}

#[test]
fn the_gripper_arm_is_read_in_si_units() {
    let file = machine("cam-oscillating.toml");
    let cam = file.machine.mechanism();
    assert_eq!(
        cam.joint_names(),
        [
            "cam pivot",
            "follower pivot",
            "contact",
            "roller pin",
            "rolling"
        ]
    );
    let deg = f64::to_radians;
    let psi = |phi| cam.frames(deg(phi)).unwrap()[1].psi;
    // The polynomials have taken the velocity of the segment between them: 12° in 60°.
    for phi in [80.0, 100.0, 139.9] {
        close(psi(phi).d1, -0.2);
    }
    close(psi(60.0).value - psi(0.0).value, -risen(0.5));
    close(psi(200.0).value - psi(20.0).value, -deg(20.0));
    close(psi(180.0).d1, 0.0);
    // 9 N m + 0.25 N m/deg·20°.
    let spring = &file.elements[0];
    assert_eq!(spring.name, "closing spring");
    let moment = |phi| spring.element.effort(&cam.frames(deg(phi)).unwrap(), 0.0);
    close(moment(10.0), 9.0);
    close(moment(200.0), 14.0);
}

/// The polynomial of fifth degree from rest to 0.2 over 40° with a rise of 4°, at the share z.
fn risen(z: f64) -> f64 {
    let (h, v) = (4f64.to_radians(), 0.2 * 40f64.to_radians());
    let [c3, c4, c5] = [10.0 * h - 4.0 * v, -15.0 * h + 7.0 * v, 6.0 * h - 3.0 * v];
    z.powi(3) * (c3 + z * (c4 + z * c5))
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    let cam = file.machine.mechanism();
    assert_eq!(cam.contacts()[0].joint, 2);
    close(
        cam.frames(2.0).unwrap()[1].y.value,
        (0.055_f64.powi(2) - 0.005_f64.powi(2)).sqrt() + 0.02,
    );
    // The table of laws is that of the library.
    for (name, law) in [
        ("polynomial-345", Law::<f64>::Polynomial345),
        ("polynomial-4567", Law::Polynomial4567),
        ("cycloidal", Law::Cycloidal),
        ("modified-sine", Law::ModifiedSine),
        ("modified-trapezoid", Law::ModifiedTrapezoid),
        ("simple-sine", Law::SimpleSine),
    ] {
        let c = law.characteristic();
        let jerk = c.jerk.map_or("∞".to_owned(), |jerk| format!("{jerk:.1}"));
        // 2.1875 is a tie that rounds to the even digit when printed.
        let row = format!(
            "| `\"{name}\"` | {:.3} | {:.3} | {jerk} |",
            c.velocity, c.acceleration
        );
        assert!(DOC.contains(&row), "{row}");
    }
}

/// Every kind of follower, and a cam that needs no force.
#[test]
fn every_follower_is_read() {
    let base = example(DOC);
    let roller =
        "[mechanism.roller]\nradius = \"15 mm\"\nmass = \"0.12 kg\"\ninertia = \"0.15 kg cm^2\"\n";
    let face = base
        .replace("translating-roller", "translating-flat-face")
        .replace(roller, "")
        .replace("\"40 mm\"", "\"60 mm\"");
    let file = parse(&face).unwrap_or_else(|report| panic!("{}", rendered(&report)));
    let mechanism = file.machine.mechanism();
    assert_eq!(mechanism.link_names(), ["cam", "follower"]);
    assert_eq!(mechanism.joint_names(), ["cam pivot", "guide", "contact"]);
    close(mechanism.frames(2.0).unwrap()[1].y.value, 0.08);

    let swinging = face
        .replace("translating-flat-face\"", "oscillating-flat-face\"\npivot = [\"150 mm\", \"0 mm\"]\nswing = \"clockwise\"\ninertia = \"0.01 kg m^2\"")
        .replace("= \"20 mm\"", "= \"7 deg\"")
        .replace("\"3 N/mm\"", "\"60 N m/rad\"")
        .replace("\"80 N\"", "\"12 N m\"");
    let file = parse(&swinging).unwrap_or_else(|report| panic!("{}", rendered(&report)));
    let psi = file.machine.mechanism().frames(0.0).unwrap()[1].psi.value;
    // The face lies 5 mm nearer to the cam than its pivot.
    close(psi, std::f64::consts::PI - (0.065_f64 / 0.15).asin());

    let form = base
        .replace("base_radius", "closure = \"form\"\nbase_radius")
        .replace("\"200 rpm\"", "\"2000 rpm\"");
    assert!(
        parse(&form)
            .unwrap()
            .machine
            .mechanism()
            .contacts()
            .is_empty()
    );
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        offset = "5 mm" => offset = "70 mm" => is too small for the offset of the guide, 70 mm | greater than 55 mm
        dwell = "100 deg" => dwell = "90 deg" => cover 350 deg, but must cover exactly one turn | add 10 deg
        return = "20 mm" => return = "19 mm" =>
            the follower is 1 mm off | change the rise in [[mechanism.segment]] number 3 by -1 mm
        law = "cycloidal" => law = "constant-velocity" => velocity jumps at φ =␣ | polynomial-5
        law = "cycloidal" => law = "cycloid" => did you mean "cycloidal"? | "constant-velocity"
        return = "20 mm" => return = "20 mm"\nrise = "20 mm" => has both `rise` and `return`
        rise = "20 mm" => rise = "-20 mm" => greater than zero
        rise = "20 mm" => rise = "20 deg" => must be a length
        dwell = "60 deg" => dwell = "60 deg"\nlaw = "cycloidal" => a dwell has no law
        angle = "90 deg" => angle = "90 deg"\nend_velocity = "2 mm/rad" => `end_velocity` is for law = "polynomial-5"
        angle = "90 deg" => duration = "90 deg" => unknown key `duration` | over the angle of the cam | add angle =␣
        type = "translating-roller" => type = "translating-roller"\ninertia = "1 kg m^2" => does not turn
        type = "translating-roller" => type = "translating-flat-face" => unknown key `roller` in [mechanism]
        type = "translating-roller" => type = "oscillating-roller" => `pivot` in [mechanism.follower] is missing
        stiffness = "3 N/mm" => stiffness = "3 N m/rad" => must be a stiffness
    "#;
    refuses_edits(base, edits);
    // A small cam cannot drive a large roller.
    let large = base.replace("radius = \"15 mm\"", "radius = \"40 mm\"");
    let undercut: &[&str] = &[
        "`base_radius` in [mechanism] is too small",
        "undercut at φ = ",
        "make the base radius greater than",
    ];
    refuses_edit(&large, "\"40 mm\"", "\"5 mm\"", undercut);
    // Two polynomials that both leave the velocity between them open.
    let two = base
        .replace(
            "law = \"modified-sine\"\nrise = \"20 mm\"\nangle = \"90 deg\"",
            "law = \"polynomial-5\"\nrise = \"20 mm\"\nangle = \"90 deg\"",
        )
        .replace(
            "dwell = \"60 deg\"",
            "law = \"polynomial-5\"\nrise = \"1 mm\"\nangle = \"60 deg\"",
        );
    let edits = r#"
        return = "20 mm" => return = "21 mm" => needs `end_velocity` | number 2, does not give the velocity
    "#;
    refuses_edits(&two, edits);
    let reversal = two
        .replace("return = \"20 mm\"", "return = \"21 mm\"")
        .replace(
            "rise = \"1 mm\"",
            "rise = \"1 mm\"\nstart_velocity = \"1 mm/rad\"",
        );
    assert!(parse(&reversal).is_ok());
    // An arm that does not reach.
    let arm = base.replace(
        "type = \"translating-roller\"\noffset = \"5 mm\"",
        "type = \"oscillating-roller\"\npivot = [\"200 mm\", \"0 mm\"]\narm = \"100 mm\"\nswing = \"clockwise\"\ninertia = \"0.01 kg m^2\"",
    ).replace("= \"20 mm\"", "= \"7 deg\"");
    let arm = arm.replace("\"3 N/mm\"", "\"60 N m/rad\"");
    let reach: &[&str] = &[
        "cannot hold the roller on the base circle",
        "between 100 mm and 300 mm",
    ];
    refuses_edit(&arm, "\"100 mm\"", "\"100 mm\"", reach);
    let torque: &[&str] = &["`preload` in [mechanism.spring]", "must be a torque"];
    refuses_edit(&arm, "\"100 mm\"", "\"190 mm\"", torque);
}
