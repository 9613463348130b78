//! `type = "toggle-press"`.

use std::f64::consts::TAU;

use jred::machine::Mechanism as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/toggle-press.md");

#[test]
fn the_coining_press_is_read_in_si_units() {
    let file = machine("toggle-press.toml");
    let press = file.machine.mechanism();
    assert_eq!(press.kind(), "toggle-press");
    assert_eq!(
        press.link_names(),
        ["crank", "rod", "upper", "lower", "ram"]
    );
    assert_eq!(press.joint_names().len(), 7);
    let [crank, rod, upper, lower, ram] = press.links() else {
        panic!("five links")
    };
    close(crank.com()[0], 0.012);
    close(rod.com()[0], 0.14);
    close(upper.com()[0], 0.12);
    close(lower.com()[0], 0.125);
    close(ram.mass(), 55.0);
    // The stroke and the knuckle's distance that the file names.
    let places = (0..3600).map(|k| press.frames(TAU * f64::from(k) / 3600.0).unwrap());
    let (mut top, mut bottom, mut nearest) = (f64::MAX, f64::MIN, f64::MAX);
    for frames in places {
        let [_, y] = frames[2].point([0.25, 0.0]).map(|c| c.value);
        nearest = nearest.min(0.4 - y);
        top = top.min(frames[4].x.value);
        bottom = bottom.max(frames[4].x.value);
    }
    assert!((bottom - top - 0.0695).abs() < 0.0002, "{}", bottom - top);
    assert!((nearest - 0.005).abs() < 0.0001, "{nearest}");
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    let bottom = |file: &jred_file::model::machine::MachineFile| {
        let press = file.machine.mechanism();
        let ram = |k: u32| {
            press.frames(TAU * f64::from(k) / 3600.0).unwrap()[4]
                .x
                .value
        };
        (0..3600).map(ram).fold(f64::MIN, f64::max)
    };
    // Stretched: x_P + p + q.
    assert!((bottom(&file) - 0.25).abs() < 1e-6);
    let left = example(DOC).replacen("knee", "branch = \"left\"\nknee", 1);
    let ram = parse(&left)
        .unwrap()
        .machine
        .mechanism()
        .frames(1.0)
        .unwrap()[4];
    assert!(ram.x.value < -0.25 + 0.25);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "60 mm" => "250 mm" => [mechanism]: the crank cannot turn fully | Grashof | this crank
        [mechanism.lower]\nlength = "250 mm" => [mechanism.lower]\nlength = "90 mm" =>
            the lower link no longer reaches the guide at φ =␣ | make the lower link longer than 0. | too short
        guide = "400 mm"\n => => `guide` in [mechanism] is missing
        pivot = ["-250 mm", "400 mm"]\n => => `pivot` in [mechanism] is missing
        "right" => "up" => `knee` | "left", "right"
        mass = "55 kg" => mass = "55 kg"\ninertia = "1 kg m^2" => does not turn
        [mechanism.ram] => [mechanism.slider] => `ram`
    "#;
    refuses_edits(base, edits);
}
