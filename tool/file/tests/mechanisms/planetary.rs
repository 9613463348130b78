//! `type = "planetary"`.

use jred::machine::Reducible as _;
use jred::machine::{Jointed as _, Mechanism as _};

use super::{close, example, machine, parse, refuses_edit, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/planetary.md");

#[test]
fn the_slewing_drive_is_read_in_si_units() {
    let file = machine("planetary.toml");
    let gear = file.machine.mechanism();
    assert_eq!(gear.kind(), "planetary");
    assert_eq!(gear.link_names(), ["sun", "carrier", "ring", "planets"]);
    assert_eq!(gear.joint_names().len(), 7);
    assert_eq!(gear.drive(), 0);
    let frames = gear.frames(1.0).unwrap();
    close(frames[1].psi.value, 0.2);
    close(frames[2].psi.value, 0.0);
    // ω_p = ω_c − (z_s/z_p)·(ω_s − ω_c)
    close(frames[3].psi.value, 0.2 - 18.0 / 27.0 * 0.8);
    let orbital = 3.0 * 1.05 * 0.0675 * 0.0675;
    let spin = 3.0 * 9.3e-4 * (0.2_f64 - 18.0 / 27.0 * 0.8).powi(2);
    let reduced = file.machine.reduction(0.4).unwrap();
    close(reduced.inertia, 4.1e-4 + (3.4 + orbital) / 25.0 + spin);
}

#[test]
fn the_documented_example_is_read() {
    let base = example(DOC);
    let gear = |text: &str| parse(text).unwrap().machine.mechanism().clone();
    let speed = |text: &str, link: usize| gear(text).frames(0.0).unwrap()[link].psi.d1;
    close(speed(base, 1), 1.0 / (1.0 + 72.0 / 18.0));
    // The document's table; members that move need an inertia.
    let star = base
        .replace("fixed = \"ring\"", "fixed = \"carrier\"")
        .replace("teeth = 72", "teeth = 72\ninertia = \"0.1 kg m^2\"");
    close(1.0 / speed(&star, 2), -72.0 / 18.0);
    let solar = star
        .replace("fixed = \"carrier\"", "fixed = \"sun\"")
        .replace("input = \"sun\"", "input = \"ring\"");
    close(1.0 / speed(&solar, 1), 1.0 + 18.0 / 72.0);
    assert_eq!(gear(&solar).drive(), 2);
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        fixed = "ring" => fixed = "sun" => the input of the planetary gear is fixed | two different
        fixed = "ring" => fixed = "rim" => "rim" | "sun", "carrier", "ring"
        fixed = "ring" => fixed = "carrier" => `inertia` in [mechanism.ring] is missing
        teeth = 72 => teeth = 71 => do not mesh | sun and ring together, 89
        count = 3 => count = 4 => 4 equally spaced planets do not mesh | 90 | change the number
        count = 3 => count = 9 => 9 planets of this size overlap: at most 4 | use fewer
        count = 3 => count = 1 => number of planets is 1
        count = 3 => count = 3\nteeth = 20 => planets with 20 teeth do not fill | remove `teeth`
        teeth = 18 => teeth = 3 => `teeth` in [mechanism.sun] is 3 | between 5 and 100000
        "67.5 mm" => "0 mm" => greater than zero
    "#;
    refuses_edits(base, edits);
}

/// With these teeth the planets' angle comes back after every turn of the sun, but they themselves do not.
#[test]
fn a_force_on_the_planets_does_not_repeat() {
    let base = example(DOC)
        .replace("teeth = 18", "teeth = 40")
        .replace("teeth = 72", "teeth = 80");
    let file = parse(&base).unwrap();
    let planets = |phi| file.machine.mechanism().frames(phi).unwrap()[3].psi.value;
    close(
        planets(std::f64::consts::TAU) - planets(0.0),
        -std::f64::consts::TAU,
    );
    let load = "[[load]]\non = \"planets\"\nforce = [\"5 N\", \"0 N\"]\n\n[mechanism]";
    let words = [
        "acts in a fixed direction on \"planets\"",
        "does not move in the same way in every turn",
    ];
    refuses_edit(&base, "[mechanism]", load, &words);
}
