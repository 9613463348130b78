//! `type = "hoist"`.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/hoist.md");

#[test]
fn the_goods_lift_is_read_in_si_units() {
    let file = machine("hoist.toml");
    let hoist = file.machine.mechanism();
    assert_eq!(hoist.kind(), "hoist");
    assert_eq!(hoist.link_names(), ["drum", "load", "counterweight"]);
    assert_eq!(
        hoist.joint_names(),
        [
            "drum bearing",
            "guide of the load",
            "guide of the counterweight",
            "rope of the load",
            "rope of the counterweight"
        ]
    );
    let reduced = file.machine.reduction(2.0).unwrap();
    close(reduced.inertia, 0.92 + (420.0 + 260.0) * 0.075 * 0.075);
    close(reduced.potential_slope, 9.81 * (420.0 - 260.0) * 0.075);
    // One storey.
    close(hoist.frames(3.2 / 0.075).unwrap()[1].y.value, 3.2);
    close(hoist.frames(3.2 / 0.075).unwrap()[2].y.value, -3.2);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    close(file.machine.mechanism().links()[2].mass(), 260.0);
    // Without a counterweight.
    let (plain, _) = example(DOC)
        .split_once("[mechanism.counterweight]")
        .unwrap();
    let file = parse(plain).unwrap();
    assert_eq!(file.machine.mechanism().link_names(), ["drum", "load"]);
    assert_eq!(file.machine.mechanism().joint_names().len(), 3);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "150 mm" => "0 mm" => `radius` in [mechanism.load] is 0 mm | greater than zero
        falls = 2 => falls = 0 => `falls` in [mechanism.load] is 0 | between 1 and 24
        falls = 2 => fals = 2 => did you mean "falls"?
        [mechanism.load] => [mechanism.lode] => `load` in [mechanism] is missing | add [mechanism.load]
        mass = "260 kg" => mass = "260 kg"\ninertia = "1 kg m^2" => unknown key `inertia` in [mechanism.counterweight]
    "#;
    refuses_edits(base, edits);
}
