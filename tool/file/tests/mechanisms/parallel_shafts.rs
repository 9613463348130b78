//! `type = "parallel-shafts"`.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{close, example, machine, parse, refuses_edit, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/parallel-shafts.md");

#[test]
fn the_roller_table_is_read_in_si_units() {
    let file = machine("parallel-shafts.toml");
    let shafts = file.machine.mechanism();
    assert_eq!(shafts.kind(), "parallel-shafts");
    assert_eq!(
        shafts.link_names(),
        [
            "drive",
            "infeed rollers",
            "table rollers",
            "outfeed rollers",
            "brush"
        ]
    );
    assert_eq!(shafts.joint_names()[1], "bearings of infeed rollers");
    assert_eq!(shafts.joint_names()[8], "drive of brush");
    assert_eq!(shafts.joint_names().len(), 9);
    close(shafts.frames(1.0).unwrap()[4].psi.value, -1.25);
    let sum = 0.004 + 0.036 / 4.0 + 0.036 / 2.25 + 0.024 / 1.44 + 0.021 / 0.64;
    close(file.machine.reduction(0.0).unwrap().inertia, sum);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    let shafts = file.machine.mechanism();
    assert_eq!(shafts.link_names(), ["drive", "rollers", "driven-2"]);
    close(shafts.frames(3.0).unwrap()[1].psi.value, 2.0);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let (head, _) = base.split_once("[[mechanism.driven]]").unwrap();
    let edits = r#"
        ratio = 1.5 => ratio = 0 => `ratio` in [[mechanism.driven]] number 1 is 0 | could not turn
        ratio = 1.5 => ratio = "1.5" => a plain number
        ratio = 1.5 => ratio = 1e6 => between
        ratio = -0.8 => name = "rollers"\nratio = -0.8 => is "rollers", the name of another shaft
        name = "rollers" => name = "drive" => is "drive", the name of another shaft
        inertia = "0.004 kg m^2" => => `inertia` in [mechanism.drive] is missing
    "#;
    refuses_edits(base, edits);
    let edits = r"
        [mechanism.drive] => driven = []\n[mechanism.drive] => at least one [[mechanism.driven]]
        [mechanism.drive] => [mechanism.drive] => `driven` in [mechanism] is missing
    ";
    refuses_edits(head, edits);
    let sixteen = "[[mechanism.driven]]\nratio = 2\ninertia = \"1 kg m^2\"\n\n".repeat(16);
    refuses_edit(
        &format!("{head}{sixteen}"),
        "",
        "",
        &["more than 15 [[mechanism.driven]]", "add their inertias"],
    );
}
