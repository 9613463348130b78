//! `type = "scotch-yoke"`.

use std::f64::consts::PI;

use jred::machine::Mechanism as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/scotch-yoke.md");

#[test]
fn the_saw_is_read_in_si_units() {
    let file = machine("scotch-yoke.toml");
    let yoke = file.machine.mechanism();
    assert_eq!(yoke.kind(), "scotch-yoke");
    assert_eq!(yoke.link_names(), ["crank", "yoke"]);
    assert_eq!(
        yoke.joint_names(),
        ["crank pivot", "pin in the slot", "guide"]
    );
    let names: Vec<&str> = yoke.points().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["A", "B"]);
    close(yoke.points()[0].at[0], 0.06);
    let [crank, slide] = yoke.links() else {
        panic!("two links")
    };
    close(crank.mass(), 2.4);
    close(crank.inertia(), 0.006);
    close(crank.com()[0], 0.008);
    close(slide.mass(), 6.8);
    close(slide.com()[1], 0.035);
    close(file.flywheel, 0.09);
    // Straight: x = r·cos φ.
    let frames = yoke.frames(PI / 3.0).unwrap();
    close(frames[1].x.value, 0.03);
    assert_eq!(file.machine.loads().len(), 3);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    let yoke = file.machine.mechanism();
    let beta = 75.0_f64.to_radians();
    close(
        yoke.frames(0.5).unwrap()[1].x.value,
        0.06 * (beta - 0.5).sin() / beta.sin(),
    );
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "75 deg" => "0.5 deg" => `slot_angle` in [mechanism] is 0.5 deg | lock the crank | 1 deg to 179 deg
        "75 deg" => "180 deg" => is 180 deg | straight yoke has 90 deg
        "75 deg" => "75 mm" => must be an angle | a length
        slot_angle => slot_angel => did you mean "slot_angle"?
        mass = "6.8 kg" => mass = "6.8 kg"\ninertia = "1 kg m^2" => unknown key `inertia` in [mechanism.yoke] | does not turn
        [mechanism.yoke] => [mechanism.slider] => `yoke` in [mechanism] is missing
        "60 mm" => "0 mm" => `length` in [mechanism.crank] is 0 mm | greater than zero
    "#;
    refuses_edits(base, edits);
}
