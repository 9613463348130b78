//! `[[spring]]` and `[[damper]]` of every mechanism.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{FOUR_BAR, close, read, refuses, refuses_edits};
use crate::support::machines::{COUNTERBALANCE, balanced_press};

/// The four-bar with a spring from its rocker to the ground, one in torsion and two dampers.
fn with_elements() -> String {
    let text = FOUR_BAR.replace(
        "C = [\"300 mm\", \"0 mm\"] }",
        "C = [\"300 mm\", \"0 mm\"], S = [\"450 mm\", \"200 mm\"] }",
    );
    format!(
        r#"{text}
[[spring]]
name = "counterbalance"
between = ["rocker.B", "ground.S"]
stiffness = "4 N/mm"
free_length = "150 mm"

[[spring]]
between = ["ground", "rocker"]
stiffness = "12 N m/rad"
free_angle = "90 deg"

[[damper]]
between = [{{ on = "coupler", at = ["100 mm", "20 mm"] }}, {{ on = "ground", at = ["100 mm", "-300 mm"] }}]
viscous_force = "300 N s/m"

[[damper]]
between = ["crank", "coupler"]
viscous_moment = "0.4 N m s/rad"
"#
    )
}

#[test]
fn springs_and_dampers_of_a_linkage() {
    let (bare, file) = (read(FOUR_BAR), read(&with_elements()));
    let names: Vec<&str> = file.elements.iter().map(|e| e.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "counterbalance",
            "spring from ground to rocker",
            "damper from coupler to ground",
            "damper from crank to coupler"
        ]
    );
    for k in 0..40 {
        let phi = 0.31 * f64::from(k);
        let frames = file.machine.mechanism().frames(phi).unwrap();
        let [x, y] = frames[2].point([0.18, 0.0]);
        let line = [x.value - 0.45, y.value - 0.2];
        let length = line[0].hypot(line[1]);
        let slope = (line[0] * x.d1 + line[1] * y.d1) / length;
        let stretch = length - 0.15;
        let turn = frames[2].psi.value - 90f64.to_radians();
        let energy = 0.5 * 4000.0 * stretch * stretch + 0.5 * 12.0 * turn * turn;
        let force = 4000.0 * stretch * slope + 12.0 * turn * frames[2].psi.d1;
        let [u, v] = frames[1].point([0.1, 0.02]);
        let line = [u.value - 0.1, v.value + 0.3];
        let rate = (line[0] * u.d1 + line[1] * v.d1) / line[0].hypot(line[1]);
        let turning = frames[1].psi.d1 - 1.0;
        let viscous = 300.0 * rate * rate + 0.4 * turning * turning;
        let (found, without) = (
            file.machine.reduction(phi).unwrap(),
            bare.machine.reduction(phi).unwrap(),
        );
        close(
            found.potential_energy - without.potential_energy,
            energy,
            1e-11,
        );
        close(
            found.potential_slope - without.potential_slope,
            force,
            1e-10,
        );
        close(found.viscous - without.viscous, viscous, 1e-12);
        // d'Alembert's principle sees the springs as forces on the bodies.
        let drive = file.machine.forces(phi, 3.0, 20.0).unwrap().drive;
        close(drive, found.torque(3.0, 20.0).total(), 1e-9);
    }
}

#[test]
fn a_library_mechanism_names_its_points() {
    for ends in [
        "[\"A\", \"ground\"]",
        "[\"crank.A\", \"ground\"]",
        "[\"B\", { on = \"crank\", at = [\"0 mm\", \"9 mm\"] }]",
    ] {
        let spring = COUNTERBALANCE.replace(
            "[\"slider\", { on = \"ground\", at = [\"400 mm\", \"0 mm\"] }]",
            ends,
        );
        let text = balanced_press(&spring);
        if ends.contains("\"ground\"") {
            // The crank pin keeps its distance from the crank's bearing.
            refuses(
                &text,
                &[
                    "whose length never changes",
                    "distance of the two points never changes",
                ],
            );
        } else {
            assert_eq!(read(&text).elements.len(), 1);
        }
    }
}

#[test]
fn elements_that_make_no_sense() {
    let text = balanced_press(COUNTERBALANCE);
    let edits = r#"
        "3 N/mm" => "-3 N/mm" => `stiffness` in [[spring]] number 1 is -3 N/mm | greater than zero
        "3 N/mm" => "3 N" => must be a stiffness | is a force | N/mm
        "3 N/mm" => "3 N m/rad" => is a torsional stiffness
        free_length = "330 mm"\n => => `free_length` in [[spring]] number 1 is missing | free_angle
        free_length = "330 mm" => free_length = "330 mm"\nfree_angle = "0 deg" => both `free_length` and `free_angle`
        ["slider",␣ => ["slidr",␣ => is "slidr", which is no body and no point | did you mean "slider"? | "crank.A"
        ["slider", { on = "ground", at = ["400 mm", "0 mm"] }] => ["slider", "B"] => names one body twice
        ["slider", { on = "ground", at = ["400 mm", "0 mm"] }] => ["slider"] => must have two ends, but has 1
        // The ram passes through the point 180 mm from the crank.
        at = ["400 mm", "0 mm"] => at = ["180 mm", "0 mm"] => has ends that coincide at φ =␣ | aside slightly
        ["slider", { on = "ground", at = ["400 mm", "0 mm"] }]\nstiffness = "3 N/mm"\nfree_length = "330 mm" => ["crank", "ground"]\nstiffness = "3 N m/rad"\nfree_angle = "0 deg" =>
            is wound up by | does not repeat
    "#;
    refuses_edits(&text, edits);
    let numbered =
        |k: u32| COUNTERBALANCE.replace("\"counterbalance\"", &format!("\"spring {k}\""));
    let nine: String = (0..9).map(numbered).collect();
    refuses(&balanced_press(&nine), &["more than 8 springs and dampers"]);
    let torsion = "[[spring]]\nbetween = [\"crank.A\", \"slider\"]\nstiffness = \"3 N m/rad\"\nfree_angle = \"0 deg\"\n";
    refuses(
        &balanced_press(torsion),
        &["is the point crank.A", "acts between bodies"],
    );
    let damper =
        "[[damper]]\nbetween = [\"ground\", \"slider\"]\nviscous_moment = \"3 N m s/rad\"\n";
    refuses(
        &balanced_press(damper),
        &["whose angle never changes: the damper does nothing"],
    );
    let both = "[[damper]]\nbetween = [\"ground\", \"crank\"]\nviscous_moment = \"3 N m s/rad\"\nviscous_force = \"3 N s/m\"\n";
    refuses(
        &balanced_press(both),
        &["both `viscous_force` and `viscous_moment`"],
    );
}
