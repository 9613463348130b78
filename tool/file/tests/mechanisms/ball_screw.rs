//! `type = "ball-screw"`.

use std::f64::consts::TAU;

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/ball-screw.md");

#[test]
fn the_axis_is_read_in_si_units() {
    let file = machine("ball-screw.toml");
    let screw = file.machine.mechanism();
    assert_eq!(screw.kind(), "ball-screw");
    assert_eq!(screw.link_names(), ["screw", "nut"]);
    assert_eq!(
        screw.joint_names(),
        ["screw bearings", "nut guide", "thread"]
    );
    close(screw.links()[0].mass(), 5.6);
    close(screw.frames(20.0 * TAU).unwrap()[1].x.value, 0.4);
    let reduced = file.machine.reduction(0.4).unwrap();
    close(reduced.inertia, 6.4e-4 + 140.0 * (0.02 / TAU).powi(2));
    close(reduced.potential_slope, 140.0 * 9.81 * 0.02 / TAU);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    close(file.machine.mechanism().links()[1].mass(), 140.0);
    // A negative lead moves the nut the other way.
    let left = parse(&example(DOC).replace("\"20 mm\"", "\"-20 mm\"")).unwrap();
    close(
        left.machine.mechanism().frames(TAU).unwrap()[1].x.value,
        -0.02,
    );
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "20 mm" => "0 mm" => `lead` in [mechanism] is 0 mm | per turn
        "20 mm" => "20 mm/rad" => `lead` in [mechanism]
        lead = => pitch = => `lead` in [mechanism] is missing
        inertia = "6.4 kg cm^2" => inertia = "6.4 kg cm^2"\ncom = ["1 mm", "0 mm"] =>
            unknown key `com` in [mechanism.screw] | balanced
    "#;
    refuses_edits(base, edits);
}
