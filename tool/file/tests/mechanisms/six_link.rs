//! `type = "six-link"`.

use std::f64::consts::{PI, TAU};

use jred::machine::Mechanism as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/six-link.md");

#[test]
fn the_whitworth_press_is_read_in_si_units() {
    let file = machine("six-link.toml");
    let press = file.machine.mechanism();
    assert_eq!(press.kind(), "six-link");
    assert_eq!(
        press.link_names(),
        ["crank", "block", "rocker", "rod", "slider"]
    );
    assert_eq!(press.joint_names().len(), 7);
    let [crank, block, rocker, rod, slider] = press.links() else {
        panic!("five links")
    };
    close(crank.com()[0], 0.01);
    close(block.inertia(), 0.0004);
    close(rocker.com()[0], -0.008);
    close(rod.mass(), 5.5);
    close(slider.mass(), 38.0);
    let ram = |phi: f64| press.frames(phi).unwrap()[4].x;
    close(ram(0.0).value, -0.03 + 0.06 + 0.26);
    close(ram(0.0).value - ram(PI).value, 0.12);
    let rocker = |phi: f64| press.frames(phi).unwrap()[2].psi;
    close(rocker(0.0).d1, 80.0 / 110.0);
    close(rocker(PI).d1, 80.0 / 50.0);
    close(rocker(1.0 + TAU).value - rocker(1.0).value, TAU);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    let slider = file.machine.mechanism().frames(0.3).unwrap()[4];
    close(slider.y.value, 0.35);
    let left = example(DOC).replacen("centres", "branch = \"left\"\ncentres", 1);
    let other = parse(&left)
        .unwrap()
        .machine
        .mechanism()
        .frames(0.3)
        .unwrap()[4];
    assert!(other.x.value < slider.x.value);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "200 mm" => "100 mm" => as long as the distance of the pivots, 0.1 m | for a rocker that swings
        "700 mm" => "570 mm" => the rod no longer reaches the guide at φ =␣ | make the rod longer than 0.575000 m | too short
        centres = "200 mm" => => `centres` in [mechanism] is missing
        centres => branch = "up"\ncentres => "right", "left"
        mass = "9 kg" => mass = "9 kg"\ninertia = "1 kg m^2" => does not turn
        "450 mm" => "0 mm" => must be greater than zero
    "#;
    refuses_edits(base, edits);
}
