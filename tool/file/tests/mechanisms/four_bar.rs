//! `type = "four-bar"`.

use jred::Domain;
use jred::machine::Mechanism as _;

use super::{close, example, machine, parse, refuses_edits, rendered};

const DOC: &str = include_str!("../../../../docs/mechanisms/four-bar.md");

#[test]
fn the_transfer_arm_is_read_in_si_units() {
    let file = machine("four-bar.toml");
    let four_bar = file.machine.mechanism();
    assert_eq!(four_bar.kind(), "four-bar");
    assert_eq!(four_bar.link_names(), ["crank", "coupler", "rocker"]);
    assert_eq!(
        four_bar.joint_names(),
        ["crank pivot", "crank pin", "rocker pin", "rocker pivot"]
    );
    let [crank, coupler, rocker] = four_bar.links() else {
        panic!("three links")
    };
    close(crank.inertia(), 14e-4);
    close(coupler.mass(), 0.9);
    close(rocker.com()[1], -0.012);
    assert_eq!(four_bar.domain(), Domain::Turn);
    let frames = four_bar.frames(0.4).unwrap();
    close(frames[2].x.value, 0.21);
    close(frames[2].y.value, -0.04);
    // The three circles meet in B.
    let [x, y] = frames[2].point([0.13, 0.0]).map(|c| c.value);
    close(
        (x - 0.06 * 0.4f64.cos()).hypot(y - 0.06 * 0.4f64.sin()),
        0.22,
    );
    // The swing that the file names, from its own dead centres.
    let swing = |phi: f64| four_bar.frames(phi).unwrap()[2].psi.value;
    let angles: Vec<f64> = (0..3600)
        .map(|k| swing(f64::from(k) / 3600.0 * std::f64::consts::TAU))
        .collect();
    let most = angles.iter().copied().fold(f64::MIN, f64::max);
    let least = angles.iter().copied().fold(f64::MAX, f64::min);
    assert!(
        ((most - least).to_degrees() - 58.25).abs() < 0.01,
        "{}",
        (most - least).to_degrees()
    );
}

#[test]
fn the_documented_example_is_read() {
    let left = parse(example(DOC)).unwrap();
    let base = example(DOC).replacen("\"four-bar\"", "\"four-bar\"\nside = \"right\"", 1);
    let right = parse(&base).unwrap();
    // Golden: B lies above the line of the pivots on the left side, and mirrored below on the right at φ = 0.
    let psi = |file: &jred_file::model::machine::MachineFile| {
        file.machine.mechanism().frames(0.0).unwrap()[2].psi.value
    };
    close(psi(&left), 1.803_963_973_804_134_9);
    close(psi(&right), -1.803_963_973_804_134_9);
}

#[test]
fn a_swinging_crank_is_driven_over_a_stroke() {
    let text = example(DOC)
        .replacen("\"80 mm\"", "\"180 mm\"", 1)
        .replacen(
            "length = \"180 mm\"\nmass = \"0.7 kg\"",
            "length = \"80 mm\"\nmass = \"0.7 kg\"",
            1,
        );
    let swinging = text.replacen("pivot =", "stroke = [\"32 deg\", \"80 deg\"]\npivot =", 1);
    let file = parse(&swinging).unwrap_or_else(|report| panic!("{}", rendered(&report)));
    let Domain::Stroke { from, to } = file.machine.mechanism().domain() else {
        panic!("a stroke")
    };
    close(from.to_degrees(), 32.0);
    close(to.to_degrees(), 80.0);
    let edits = r#"
        pivot = => stroke = ["32 deg", "90 deg"]\npivot = =>
            `stroke` in [mechanism] reaches a dead point at φ = 82.82° | in line | before it
        pivot = => stroke = ["20 deg", "80 deg"]\npivot = => `stroke` | starts at φ = 20.00° | cannot be connected
        pivot = => stroke = ["80 deg", "32 deg"]\npivot = => `stroke` | is empty | the smaller angle first
    "#;
    refuses_edits(&text, edits);
}

/// The trough translates on a circle: J = 2·(J₁ + m₁·r₁²) + m₂·a² + flywheel at every position, and its weight and those of the cranks'
/// counterweights are what the drive holds, m·g·r·cos φ.
#[test]
fn a_parallelogram_is_kept_on_its_branch() {
    let file = machine("parallel-lift.toml");
    let own = 2.0 * (18e-4 + 2.2 * 0.02 * 0.02) + 24.0 * 0.06 * 0.06 + 0.02;
    let held = 9.81 * (24.0 * 0.06 - 2.0 * 2.2 * 0.02);
    for degrees in [0.0f64, 1e-9, 0.03, 57.0, 180.0, 275.0] {
        let phi = degrees.to_radians();
        let point = file.machine.bare_reduction(phi).unwrap();
        close(point.inertia, own);
        close(point.inertia_slope, 0.0);
        close(point.potential_slope, held * phi.cos());
    }
    assert_eq!(file.machine.mechanism().change_points().len(), 2);
    let text = include_str!("../../../../machines/parallel-lift.toml").to_owned();
    let edits = r#"
        keep_branch = true␣ => keep_branch = false => the crank cannot turn fully | flattens | write keep_branch = true
        ["900 mm", "0 mm"] => ["890 mm", "0 mm"] =>
            there is no change point to pass | 0.960000 m, the other two 0.950000 m | nothing to keep
        keep_branch = true␣ => keep_branch = "yes"␣ => `keep_branch` | true or false
    "#;
    refuses_edits(&text, edits);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        "300 mm" => "360 mm" =>
            [mechanism]: the crank cannot turn fully | crank + ground (shortest and longest) = 0.440000 m |
            shorten the crank or the ground | this crank
        length = "80 mm" => length = "240 mm" => only the shortest link can, the rocker of 0.18
        "300 mm" => "600 mm" => the ground of 0.600000 m is not shorter | 0.510000 m | shorten it
        pivot = ["300 mm", "0 mm"]\n => => `pivot` in [mechanism] is missing
        pivot = => side = "up"\npivot = => "up" | "left", "right"
        "180 mm" => "-180 mm" => must be greater than zero
        [mechanism.coupler] => [mechanism.rod] => `coupler`
    "#;
    refuses_edits(base, edits);
}
