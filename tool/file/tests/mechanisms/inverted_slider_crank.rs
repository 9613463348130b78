//! `type = "inverted-slider-crank"`.

use std::f64::consts::TAU;

use jred::machine::Mechanism as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/inverted-slider-crank.md");

#[test]
fn the_shaper_is_read_in_si_units() {
    let file = machine("shaper.toml");
    let shaper = file.machine.mechanism();
    assert_eq!(shaper.kind(), "inverted-slider-crank");
    assert_eq!(shaper.link_names(), ["crank", "block", "lever"]);
    assert_eq!(
        shaper.joint_names(),
        ["crank pivot", "crank pin", "slot", "lever pivot"]
    );
    let [crank, block, lever] = shaper.links() else {
        panic!("three links")
    };
    close(crank.inertia(), 0.62);
    close(block.mass(), 1.1);
    close(lever.mass(), 81.0);
    close(lever.com()[0], 0.4);
    // Pin above: the lever stands upright and the block is 330 mm from C.
    let frames = shaper.frames(TAU / 4.0).unwrap();
    close(frames[2].psi.value, TAU / 4.0);
    close(frames[2].y.value, -0.25);
    close(frames[1].y.value, 0.08);
}

#[test]
fn the_slotting_machine_turns_its_lever() {
    let file = machine("whitworth.toml");
    let lever = |phi| file.machine.mechanism().frames(phi).unwrap()[2].psi.value;
    close(lever(1.0 + TAU) - lever(1.0), TAU);
    close(file.flywheel, 0.4);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    close(file.machine.mechanism().links()[2].com()[0], 0.23);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "-250 mm" => "-80 mm" =>
            `pivot` in [mechanism.lever] is 80 mm from the crank's pivot | farther away than crank + |offset| = 80 mm |
            closer than crank − |offset| = 80 mm
        "-250 mm"] => "-250 mm"]\noffset = "-180 mm" => is 250 mm | = 260 mm for a lever that rocks
        pivot = ["0 mm", "-250 mm"] => offset = "1 mm" => `pivot` in [mechanism.lever] is missing
        "-250 mm" => "-250 kg" => must be a length
        "80 mm" => "-80 mm" => must be greater than zero
        inertia = "0.7 kg m^2" => inerta = "0.7 kg m^2" => inertia
    "#;
    refuses_edits(base, edits);
}
