//! `type = "rack-and-pinion"`.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/rack-and-pinion.md");

#[test]
fn the_gantry_is_read_in_si_units() {
    let file = machine("rack.toml");
    let rack = file.machine.mechanism();
    assert_eq!(rack.kind(), "rack-and-pinion");
    assert_eq!(rack.link_names(), ["pinion", "rack"]);
    assert_eq!(rack.joint_names(), ["pinion bearing", "rack guide", "mesh"]);
    close(rack.links()[0].inertia(), 5.2e-4);
    close(rack.links()[1].mass(), 85.0);
    close(rack.frames(2.0).unwrap()[1].x.value, 0.06);
    close(rack.frames(2.0).unwrap()[1].y.value, -0.03);
    let reduced = file.machine.reduction(0.4).unwrap();
    close(reduced.inertia, 5.2e-4 + 85.0 * 0.03 * 0.03);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    close(file.machine.mechanism().links()[0].mass(), 1.1);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "30 mm" => "0 mm" => `radius` in [mechanism.pinion] is 0 mm | greater than zero
        radius => diameter => `radius` in [mechanism.pinion] is missing
        mass = "85 kg" => mass = "85 kg"\ninertia = "1 kg m^2" => unknown key `inertia` in [mechanism.rack] | does not turn
        [mechanism.rack] => [mechanism.rake] => `rack` in [mechanism] is missing
    "#;
    refuses_edits(base, edits);
    let edits = r#"
        [mechanism] => [[load]]\non = "rack"\nmoment = "5 N m"\n\n[mechanism] => does nothing: "rack" does not turn
    "#;
    refuses_edits(base, edits);
}
