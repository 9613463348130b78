//! Lists with names: each stands for one thing.

use crate::reading::{parse, refuses};

const BELT: &str = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
                    driver = { radius = \"30 mm\", inertia = \"3 kg cm^2\" }\ndriven = { radius = \"90 mm\", inertia = \"35 kg cm^2\" }\n";

const MOTION: &str = "[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"90 deg\"\nduration = \"1 s\"\n\
                      [[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"-90 deg\"\nduration = \"1 s\"\n";

fn load(more: &str) -> String {
    format!("[[load]]\nname = \"goods\"\non = \"shaft-2\"\nopposing_moment = \"14 N m\"\n{more}\n")
}

fn loads(first: &str, second: &str) -> String {
    format!("{BELT}{}{}{MOTION}", load(first), load(second))
}

#[test]
fn two_loads_of_one_name_do_not_add_up() {
    let twice = [
        "two loads have the name \"goods\"",
        "on the same link at the same time",
    ];
    refuses(&loads("", ""), &twice);
    let [first, second] = [
        "between = [\"10 deg\", \"50 deg\"]\nramp = \"5 deg\"",
        "between = [\"50 deg\", \"80 deg\"]\nramp = \"5 deg\"",
    ];
    // In neighbouring places they are one load with two values.
    assert!(parse(&loads(first, second)).is_ok());
    refuses(
        &loads(
            first,
            "between = [\"340 deg\", \"20 deg\"]\nramp = \"5 deg\"",
        ),
        &twice,
    );
    refuses(&loads(first, ""), &twice);
    assert!(parse(&loads("segments = [1]", "segments = [2]")).is_ok());
    refuses(
        &loads("segments = [1]", "segments = [1, 2]"),
        &["act on the same link in segment 1"],
    );
    refuses(
        &loads("segments = [1]", ""),
        &["act on the same link in segment 1"],
    );
    // Where they never meet, the times do not matter.
    assert!(
        parse(&loads(
            &format!("{first}\nsegments = [1]"),
            &format!("{second}\nsegments = [1]")
        ))
        .is_ok()
    );
    let other = loads("", "").replacen("on = \"shaft-2\"", "on = \"shaft-1\"", 1);
    refuses(
        &other,
        &[
            "two loads have the name \"goods\"",
            "act on different links",
        ],
    );
    // Loads without a name act together.
    assert!(parse(&loads("", "").replace("name = \"goods\"\n", "")).is_ok());
}

#[test]
fn every_list_of_names_has_each_once() {
    let mass = "[[mass]]\nname = \"part\"\non = \"shaft-2\"\nmass = \"1 kg\"\nat = [\"0 mm\", \"0 mm\"]\ninertia = \"1 kg cm^2\"\n";
    refuses(
        &format!("{BELT}{}", mass.repeat(2)),
        &["two masses have the name \"part\""],
    );
    let element = |kind: &str, law: &str| {
        format!("[[{kind}]]\nname = \"stop\"\nbetween = [\"shaft-1\", \"ground\"]\n{law}\n")
    };
    let damper = element("damper", "viscous_moment = \"0.1 N m s/rad\"");
    let spring = element(
        "spring",
        "stiffness = \"1 N m/rad\"\nfree_angle = \"0 deg\"",
    );
    let swing = BELT.replace(
        "type = \"belt\"",
        "type = \"belt\"\nstroke = [\"0 deg\", \"90 deg\"]",
    );
    assert!(parse(&format!("{swing}{spring}")).is_ok());
    for second in [&damper, &spring] {
        refuses(
            &format!("{swing}{spring}{second}"),
            &["two springs or dampers have the name \"stop\""],
        );
    }
    let branch = "[[drive_train.branch]]\nname = \"pump\"\ntype = \"belt\"\ndriver = { radius = \"20 mm\", inertia = \"1 kg cm^2\" }\n\
                  driven = { radius = \"40 mm\", inertia = \"1 kg cm^2\" }\n";
    let train = "[[drive_train]]\ntype = \"belt\"\ndriver = { radius = \"20 mm\", inertia = \"1 kg cm^2\" }\n\
                 driven = { radius = \"40 mm\", inertia = \"1 kg cm^2\" }\n";
    assert!(parse(&format!("{BELT}{train}{branch}")).is_ok());
    refuses(
        &format!("{BELT}{train}{}", branch.repeat(2)),
        &["two branches have the name \"pump\""],
    );
}

/// A carriage is listed with the loads.
#[test]
fn a_carriage_has_no_name_of_a_load() {
    let table = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = { inertia = \"1 kg m^2\" }\n";
    let load = "[[load]]\nname = \"slide\"\non = \"table\"\nopposing_moment = \"1 N m\"\n";
    let carriage = "[[carriage]]\nname = \"slide\"\non = \"table\"\nmass = \"2 kg\"\nstroke = [\"0 mm\", \"100 mm\"]\n[carriage.motion]\n\
                    type = \"cycle\"\nsegment = [{ law = \"polynomial-345\", move = \"50 mm\", duration = \"1 s\" }, \
                    { law = \"polynomial-345\", move = \"-50 mm\", duration = \"1 s\" }]\n";
    assert!(parse(&format!("{table}{carriage}{MOTION}")).is_ok());
    refuses(
        &format!("{table}{load}{carriage}{MOTION}"),
        &["two carriages or loads have the name \"slide\""],
    );
    refuses(
        &format!("{table}{}{MOTION}", carriage.repeat(2)),
        &["two carriages or loads have the name \"slide\""],
    );
}
