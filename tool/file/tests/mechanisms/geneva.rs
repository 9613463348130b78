//! `type = "geneva"`.

use std::f64::consts::{PI, TAU};

use jred::machine::Mechanism as _;

use super::{close, example, machine, parse, refuses_edits};

const DOC: &str = include_str!("../../../../docs/mechanisms/geneva.md");

#[test]
fn the_indexing_table_is_read_in_si_units() {
    let file = machine("geneva.toml");
    let geneva = file.machine.mechanism();
    assert_eq!(geneva.kind(), "geneva");
    assert_eq!(geneva.link_names(), ["crank", "wheel"]);
    assert_eq!(
        geneva.joint_names(),
        ["crank bearing", "wheel bearing", "pin or locking arc"]
    );
    // r = 160 mm·sin 30°.
    close(geneva.points()[0].at[0], 0.08);
    let frames = geneva.frames(0.0).unwrap();
    close(frames[1].x.value, 0.16);
    close(frames[1].psi.value, PI);
    // m/(1 − m) = 1 for six slots.
    close(frames[1].psi.d1, -1.0);
    close(geneva.links()[1].inertia(), 1.15);
    close(geneva.links()[1].mass(), 30.0);
    let angle = |phi| geneva.frames(phi).unwrap()[1].psi.value;
    close(angle(2.0 + TAU) - angle(2.0), -PI / 3.0);
}

#[test]
fn the_documented_example_is_read() {
    let file = parse(example(DOC)).unwrap();
    close(file.machine.mechanism().links()[0].com()[0], 0.005);
    // The table of figures is that of the library.
    for slots in [3, 4, 5, 6, 8, 10, 12_u32] {
        let none = [0.0; 2].map(|inertia| jred::machine::Link::rotor(inertia).unwrap());
        let geneva = jred::mechanism::Geneva::new(slots, 1.0, none).unwrap();
        let digits = |value: f64| {
            let places = 2 - (value * (1.0 + 1e-9)).log10().floor() as i32;
            format!("{value:.*}", places.max(0) as usize)
        };
        for figure in [
            geneva.largest_speed(),
            geneva.largest_acceleration(),
            (PI / f64::from(slots)).tan(),
        ] {
            assert!(DOC.contains(&digits(figure)), "{slots} slots: {figure}");
        }
        assert!(DOC.contains(&format!(" {:.0}°", geneva.engagement().to_degrees())));
    }
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let base = example(DOC);
    let edits = r#"
        slots = 6 => slots = 2 => `slots` in [mechanism] is 2 | between 3 and 24
        slots = 6 => slots = 60 => between 3 and 24
        slots = 6 => slots = 6.5 => a whole number
        [mechanism.crank] => [mechanism.crank]\nlength = "80 mm" =>
            unknown key `length` in [mechanism.crank] | sin(180°/slots)
        inertia = "1.15 kg m^2" => inertia = "1.15 kg m^2"\ncom = ["1 mm", "0 mm"] =>
            unknown key `com` in [mechanism.wheel] | balanced
        "160 mm" => "0 mm" => greater than zero
    "#;
    refuses_edits(base, edits);
    // A force at a place of the wheel does not repeat with the crank.
    let edits = r#"
        [mechanism] => [[load]]\non = "wheel"\nforce = ["5 N", "0 N"]\nat = ["90 mm", "0 mm"]\n\n[mechanism] =>
            acts in a fixed direction on "wheel" | does not repeat
    "#;
    refuses_edits(base, edits);
}
