//! `docs/axes.md`: toothed-belt axis, conveyor, feed roll, rotary table, winder.

use jred::Domain;
use jred::machine::Reducible as _;

use jred_file::model::coordinate::Coordinate;

use crate::support::{phrases, rows};

use super::{close, machine, parse, refuses, refuses_edit};

const DOC: &str = include_str!("../../../../docs/axes.md");

/// The example of a type in the document.
fn example(kind: &str) -> &'static str {
    let blocks = DOC.split("\n```toml\n").skip(1);
    let mut blocks = blocks.filter_map(|rest| rest.split("\n```").next());
    let wanted = format!("type = \"{kind}\"");
    blocks.find(|block| block.contains(&wanted)).unwrap()
}

#[test]
fn the_belt_axis_is_read_in_si_units() {
    let file = machine("belt-axis.toml");
    let axis = file.machine.mechanism();
    assert_eq!(axis.kind(), "belt-axis");
    assert_eq!(axis.link_names(), ["pulley", "carriage"]);
    assert_eq!(
        axis.joint_names(),
        ["pulley bearing", "carriage guide", "belt"]
    );
    let radius = 0.192 / std::f64::consts::TAU;
    let reduced = file.machine.reduction(0.4).unwrap();
    close(reduced.inertia, 4.1e-4 + 3.6e-4 + 18.9 * radius * radius);
    close(reduced.coulomb, 0.03 * 18.0 * 9.81 * radius);
    assert_eq!(file.loads[0].name, "guide friction of carriage");
}

/// Pitch times teeth, and the diameter that they make, are the same axis.
#[test]
fn a_pulley_by_its_teeth_or_its_diameter() {
    let by_teeth = parse(example("belt-axis")).unwrap();
    let diameter = format!("diameter = \"{} mm\"", 192.0 / std::f64::consts::PI);
    let text = example("belt-axis").replace("pitch = \"8 mm\", teeth = 24", &diameter);
    let by_diameter = parse(&text).unwrap();
    let [a, b] = [by_teeth, by_diameter].map(|file| file.machine.reduction(0.0).unwrap().inertia);
    close(a, b);
}

/// Of gravity on an incline one component drives and the other presses.
#[test]
fn the_inclination_turns_gravity() {
    let text = example("belt-axis").replace("0 deg\"", "30 deg\"");
    let file = parse(&text).unwrap();
    let radius = 0.192 / std::f64::consts::TAU;
    let reduced = file.machine.reduction(0.0).unwrap();
    // The belt's weight balances.
    close(reduced.potential_slope, 18.0 * 9.81 * 0.5 * radius);
    close(
        reduced.coulomb,
        0.03 * 18.0 * 9.81 * 0.75f64.sqrt() * radius,
    );
    let on_the_moon = text.replace("30 deg\"", "30 deg\", acceleration = \"1.62 m/s^2\"");
    let reduced = parse(&on_the_moon).unwrap().machine.reduction(0.0).unwrap();
    close(reduced.potential_slope, 18.0 * 1.62 * 0.5 * radius);
}

/// Rack and screw have the coefficient, too.
#[test]
fn other_guides_have_friction() {
    let level = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]";
    let upright = "gravity = [\"-9.81 m/s^2\", \"0 m/s^2\"]";
    let lead = 0.02 / std::f64::consts::TAU;
    for (name, mass, travel) in [("rack.toml", 85.0, 0.03), ("ball-screw.toml", 140.0, lead)] {
        let text = crate::reading::text_of(name).replace(upright, level);
        let part = format!("mass = \"{mass} kg\"");
        let with = text.replace(&part, &format!("{part}\nfriction = 0.1"));
        let [plain, with] =
            [text, with].map(|t| parse(&t).unwrap().machine.reduction(0.0).unwrap());
        close(with.coulomb - plain.coulomb, 0.1 * mass * 9.81 * travel);
    }
}

#[test]
fn wrong_entries_are_refused_with_their_cure() {
    let edits = r#"
        belt-axis => teeth = 24 => diameter = "60 mm" => both `diameter` and `pitch` | give the diameter, or
        belt-axis => pitch = "8 mm", teeth = 24,␣ => => `diameter` in [mechanism.pulley] is missing
        belt-axis => friction = 0.03 => friction = 3 => `friction` in [mechanism.carriage] is 3 | between 0 and 2
        belt-axis => belt_mass = "0.9 kg" => belt_mass = "-1 kg" => must not be negative
        feed-roll => [mechanism] => [mechanism]\nbelt_mass = "1 kg" => unknown key `belt_mass` in [mechanism]
        conveyor => inclination = "12 deg" => incline = "12 deg" => `inclination` in [gravity] is missing
        conveyor => count = 4 => count = 0 => between 1 and 1000
        rotary-table => , mass = "85 kg" => => `mass` in [mechanism.table] is missing
        rotary-table => diameter = "900 mm" => diameter = "900 mm", inertia = "9 kg m^2" =>
            `diameter` in [mechanism.table] is not used
        winder => "600 mm" => "150 mm" => `full_diameter` in [mechanism] is 150 mm | the core's diameter, 152 mm
        winder => "25 %" => "125 %" => `taper` in [mechanism.web] is 125 % | 100 %
    "#;
    for [kind, from, to, words] in rows(edits) {
        refuses_edit(example(&kind), &from, &to, &phrases(&words));
    }
}

/// The stroke of an axis in lengths is one of its drive link in radians: x = r·φ, whichever way the screw turns.
#[test]
fn an_axis_may_end() {
    let radius = 0.192 / std::f64::consts::TAU;
    let text = crate::reading::text_of("belt-axis.toml");
    let ends = text.replace(
        "type = \"belt-axis\"",
        "type = \"belt-axis\"\nstroke = [\"-20 mm\", \"600 mm\"]",
    );
    let file = parse(&ends.replace(
        "of = { point = \"carriage\", along = \"x\" }",
        "of = { point = \"carriage\", along = \"x\" }\nstart = \"0 mm\"",
    ))
    .unwrap();
    let Domain::Stroke { from, to } = file.machine.domain() else {
        panic!("a turn");
    };
    close(from, -0.02 / radius);
    close(to, 0.6 / radius);
    assert_eq!(file.machine.mechanism().open_end(), None);
    // Without a motion people speak of the carriage as well.
    let own = ends.split("[motion]").next().unwrap();
    let axis = parse(own).unwrap().axis();
    assert_eq!((axis.coordinate, axis.symbol()), (Coordinate::Length, "x"));
    close(axis.position(from), -0.02);
    close(axis.position(to), 0.6);
    // Nothing else is another machine.
    let endless = parse(&text).unwrap();
    assert_eq!(endless.machine.domain(), Domain::Turn);
    let [a, b] = [&file, &endless].map(|file| file.machine.reduction(7.0).unwrap());
    close(a.inertia, b.inertia);
    close(a.coulomb, b.coulomb);
    let screw = crate::reading::text_of("vertical-axis.toml");
    for (lead, from) in [("10 mm", -0.34), ("-10 mm", -0.1)] {
        let text = screw
            .replace(
                "lead = \"10 mm\"",
                &format!("lead = \"{lead}\"\nstroke = [\"-340 mm\", \"100 mm\"]"),
            )
            .replace("along = \"x\" }", "along = \"x\" }\nstart = \"0 mm\"");
        let Domain::Stroke { from: found, .. } = parse(&text).unwrap().machine.domain() else {
            panic!("a turn");
        };
        close(found, from / 0.01 * std::f64::consts::TAU);
    }
    let hoist = crate::reading::text_of("hoist.toml");
    let text = hoist.replace(
        "type = \"hoist\"",
        "type = \"hoist\"\nstroke = [\"0 m\", \"1 m\"]",
    );
    refuses(&text, &["stroke"]);
    for (stroke, words) in [
        ("[\"0 mm\", \"599 mm\"]", "x = 599 mm"),
        ("[\"0 mm\", \"0 mm\"]", "zero or backwards"),
        ("[\"0 deg\", \"20 deg\"]", "must be a length"),
    ] {
        let text = text_with(&ends, stroke);
        refuses(&text, &[words]);
    }
}

fn text_with(text: &str, stroke: &str) -> String {
    text.replace("[\"-20 mm\", \"600 mm\"]", stroke)
        .replace("along = \"x\" }", "along = \"x\" }\nstart = \"0 mm\"")
}

/// Check says how the axis lies, and where the belt's mass is.
#[test]
fn facts_of_an_axis() {
    let fact = |text: &str, label: &str| {
        let file = parse(text).unwrap();
        let facts = file.machine.mechanism().facts();
        let fact = facts.iter().find(|fact| fact.label == label);
        fact.map_or(String::new(), |fact| fact.text.clone())
    };
    let text = crate::reading::text_of("belt-axis.toml");
    for (gravity, words) in [
        ("{ inclination = \"0 deg\" }", "horizontal; the key"),
        (
            "{ inclination = \"90 deg\" }",
            "vertical, x upwards; the key",
        ),
        (
            "{ inclination = \"-90 deg\" }",
            "vertical, x downwards; the key",
        ),
        ("{ inclination = \"30 deg\" }", "x rises by 30 deg; the key"),
        ("[\"0 m/s^2\", \"-9.81 m/s^2\"]", "horizontal; the key"),
        ("[\"0 m/s^2\", \"0 m/s^2\"]", "without gravity"),
    ] {
        let text = text.replace("{ inclination = \"0 deg\" }", gravity);
        let found = fact(&text, "axis");
        assert!(found.starts_with(words), "{found}");
    }
    assert_eq!(
        fact(&text, "mass of the belt"),
        "0.9 kg, as inertia of the pulley"
    );
}
