//! Wrong entries, and the words that tell the user what to do.

use super::{GEARS, PRESS, refuses, refuses_edit, refuses_edits};

#[test]
fn wrong_quantities_are_shown_with_their_cure() {
    let edits = r#"
        length = "30 mm" => length = 30 => machine.toml:15 | `length` in [mechanism.crank] | no unit | "30 mm"
        length = "30 mm" => length = "30" => no unit | "30 mm" | possible units
        length = "30 mm" => length = "30 kg" => must be a length, but "30 kg" is a mass | m, cm, mm
        length = "30 mm" => length = "0 mm" => [mechanism.crank] is 0 mm | greater than zero
        length = "30 mm" => length = "1e-9 mm" => too small for any machine
        length = "30 mm" => length = nan => not a finite number
        length = "30 mm" => length = "nan mm" => not a finite number
        length = "30 mm" => length = ["30 mm"] => text in quotes | is a list | length = "120 mm"
        length = "30 mm" => length = true => is true or false
        length = "30 mm" => length = 30 mm => not valid TOML | length = "30 mm"
        length = "30 mm" => length = "30 mm"\nlength = "31 mm" => duplicate key | remove
        mass = "42 kg" => mass = "-42 kg" => is -42 kg, but must not be negative
        mass = "42 kg" => mass = "42000 t" => too large for any machine | at most 1000 t
        com = ["6 mm", "0 mm"] => com = ["6 mm"] => must have two values, but has 1 | write com = ["0 mm", "120 mm"]
        "9.81 m/s^2" => "9.81 m/s" => value 1 of `gravity` | is a speed | m/s^2
        97 % => 103 % => `efficiency` | is 103 % | 100 %
        efficiency = "97 %" => efficiency = 97 => must not be greater than 1 | "97 %"
    "#;
    refuses_edits(PRESS, edits);
}

#[test]
fn wrong_words_are_shown_with_the_right_ones() {
    let edits = r#"
        length = "30 mm" => lenght = "30 mm" => `lenght` | did you mean "length"?
        offset = => ofset = => `ofset` in [mechanism] | did you mean "offset"? | branch
        [simulation] => [simulaton] => `simulaton` | did you mean "simulation"?
        "slider-crank" => "slidercrank" => did you mean "slider-crank"? | "belt"
        "right" => "up" => "up" | "right", "left"
        "polynomial-345" => "poly5" => `law` | "poly5" | modified-sine
        driver = { radius = "40 mm", => driver = { diameter = "80 mm", => `diameter` | by its radius | half
        gravity = => # gravity = => `gravity` is missing | horizontal plane
        flywheel = => efficiency = 0.9\nflywheel = => efficiency belongs to [[drive_train]]
        mass = "42 kg" => mass = "42 kg"\ninertia = "1 kg m^2" => the slider does not turn
    "#;
    refuses_edits(PRESS, edits);
}

/// Limits of belts, screws and pinions that need another one, or are of another type.
#[test]
fn limits_of_drive_elements_are_whole() {
    let edits = r#"
        belt_mass = => max_tension = "2 kN"\nbelt_mass = => `pretension` in [[drive_train]] number 1 is missing | pretension = "150 N"
        belt_mass = => pretension = "0 N"\nbelt_mass = => `pretension` | greater than zero
        belt_mass = => max_force = "2 kN"\nbelt_mass = => `max_force` is for type = "ball-screw", "rack"
        belt_mass = => ends = "fixed-free"\nbelt_mass = => `ends` is for type = "ball-screw"
    "#;
    refuses_edits(PRESS, edits);
    let screw = "gravity = { inclination = \"0 deg\" }\n[mechanism]\ntype = \"ball-screw\"\nlead = \"10 mm\"\n\
        root_diameter = \"16 mm\"\nfree_length = \"0.8 m\"\nends = \"fixed-free\"\n\
        screw = { inertia = \"1 kg cm^2\" }\nnut = { mass = \"9 kg\" }\n";
    let edits = r#"
        root_diameter = "16 mm" => => `root_diameter` in [mechanism] is missing
        free_length = "0.8 m" => => `free_length` in [mechanism] is missing
        ends = "fixed-free" => => `ends` in [mechanism] is missing | ends = "fixed-fixed"
        "fixed-free" => "free-free" => "free-free" | "fixed-fixed", "fixed-supported", "supported-supported", "fixed-free"
        root_diameter => pretension = "1 N"\nroot_diameter => unknown key `pretension`
    "#;
    refuses_edits(screw, edits);
}

#[test]
fn loads_that_make_no_sense_are_refused() {
    let edits = r#"
        on = "crank" => on = "shaft" => `on` in [[load]] number 3 | "crank", "rod", "slider"
        opposing_force => opposing_moment => must be a torque | is a force
        opposing_force = "150 N" => opposing_moment = "150 N m" => "slider" does not turn
        opposing_force = "150 N" => opposing_force = "-150 N" => must not be negative | against the motion
        opposing_force = "150 N" => opposing_force = "150 N"\nmoment = "1 N m" => both `moment` and `opposing_force`
        opposing_force = "150 N" => => action is missing | exactly one of | opposing_force
        viscous_moment = "0.4 N m s/rad" => opposing_force = "3 N" => fixed pivot | at = [
        viscous_moment => at = ["1 mm", "0 mm"]\nviscous_moment => `at` is not used | remove
        ramp = "15 deg" => ramp = "25 deg" => too long for the range of 45 deg | at most 22.5 deg
        "360 deg"] => "315 deg"] => `between` | at most one turn | 315 deg
    "#;
    refuses_edits(PRESS, edits);
}

#[test]
fn machines_that_cannot_work_are_refused_with_figures() {
    let edits = r#"
        180 mm => 25 mm => too short | φ = 56.44° | crank + |offset| = 30 mm
        offset = "0 mm" => offset = "-200 mm" => `length` in [mechanism.rod] | 230 mm
    "#;
    refuses_edits(PRESS, edits);
    let stage = GEARS.split("[[mechanism.stage]]").nth(1).unwrap();
    let stage = format!("[[mechanism.stage]]{stage}");
    let many = GEARS.replacen(&stage, &stage.repeat(8), 1);
    refuses(
        &many,
        &["more than 8 [[mechanism.stage]]", "combine stages"],
    );
    let load = "[[load]]\non = \"slider\"\nopposing_force = \"1 N\"\n";
    refuses(
        &format!("{PRESS}\n{}", load.repeat(14)),
        &["more than 16 loads"],
    );
}

#[test]
fn motions_and_simulations_that_make_no_sense_are_refused() {
    let edits = r#"
        "360 deg"\nduration => "350 deg"\nduration => add up to 350 deg | a move of 10 deg | point-to-point
        dwell = "0.25 s" => dwell = "0.25 s"\nmove = "10 deg" => both `move` and `dwell` | two [[motion.segment]]
        dwell = "0.25 s" => dwell = "0 s" => `dwell` in [[motion.segment]] number 2 | greater than zero
        dwell = "0.25 s" => duration = "0.25 s" => missing | dwell = "0.25 s"
        move = "360 deg" => move = "0 deg" => nothing moves | dwell
        move = "360 deg" => move = "360" => no unit | "360 deg"
        "polynomial-345" => "trapezoid"\naccelerate = "80 %" => 113.333 % | at most 100 % in total
        "polynomial-345" => "cycloidal"\naccelerate = "80 %" => `accelerate` is for law = "trapezoid"
        type = "cycle" => type = "cycles" => did you mean "cycle"?
        type = "cycle" => type = "constant-speed"\nspeed = "0 rpm" => `segment` | is for type = "cycle", "point-to-point"
        type = "cycle" => type = "profile"\nfile = "turn.csv" => `segment` | is for type = "cycle", "point-to-point"
        at = "motor" => at = "motor"\ntorque = "3 N m" => both `torque` and `torque_speed`
        "1500 rpm" => "3500 rpm" => is 3000 rpm | greater than the speed of the previous point, 3500 rpm
        "1500 rpm" => "25 Hz" => is a frequency | rpm | rad/s
        output_step = "5 ms" => output_step = "5 us" => 300000 steps | from 15 us
        rotor_inertia => tolerance = 1\nrotor_inertia => `tolerance` | between
        rotor_inertia = "12 kg cm^2" => [rules]\ninertia_ratio = 3 => inertia_ratio_warning | above
    "#;
    refuses_edits(PRESS, edits);
}

#[test]
fn a_force_that_does_not_repeat_with_the_drive_link_is_refused() {
    let edits = r#"
        on = "shaft-1"\nat => on = "shaft-3"\nat => `force` | shaft-3 | does not move in the same way in every turn | moment
    "#;
    refuses_edits(GEARS, edits);
}

/// What is missing and what is unknown is said in one answer, and no key that will be read is called unknown: not where any one line of
/// any example is left out.
#[test]
fn missing_and_unknown_keys_in_one_answer() {
    let screw = "gravity = { inclination = \"0 deg\" }\n[mechanism]\ntype = \"ball-screw\"\npitch = \"10 mm\"\nturns = 3\n\
                 screw = { inertia = \"1 kg cm^2\" }\nnut = { mass = \"1 kg\" }\n";
    refuses(
        screw,
        &[
            "`lead` in [mechanism] is missing",
            "unknown here: `pitch`, `turns`",
            "known here: type, flywheel, lead, screw, nut, stroke",
        ],
    );
    let mut said = 0;
    for (path, _) in crate::reading::machines() {
        let (name, text) = (
            path.display().to_string(),
            std::fs::read_to_string(&path).unwrap(),
        );
        let lines: Vec<&str> = text.lines().collect();
        let mechanism = lines.iter().position(|line| line.trim() == "[mechanism]");
        let from = mechanism.unwrap() + 1;
        for left_out in from..lines.len() {
            if lines[left_out].trim_start().starts_with('[') && left_out > from {
                break;
            }
            let mut rest = lines.clone();
            rest.remove(left_out);
            if let Err(report) = crate::reading::parse_as(&name, &rest.join("\n")) {
                let words = crate::reading::rendered(&report);
                assert!(!words.contains("unknown here"), "{name}: {words}");
                said += usize::from(words.contains("is missing"));
            }
        }
    }
    assert!(said > 20, "{said}");
}

/// A word that is a part of the right one is known as well.
#[test]
fn a_part_of_a_word_is_understood() {
    let screw = "gravity = { inclination = \"0 deg\" }\n[mechanism]\ntype = \"screw\"\n";
    refuses(screw, &["did you mean \"ball-screw\"?"]);
    for (law, meant) in [("sine", "simple-sine"), ("modified sine", "modified-sine")] {
        refuses_edit(
            PRESS,
            "law = \"polynomial-345\"",
            &format!("law = \"{law}\""),
            &[&format!("did you mean \"{meant}\"?")],
        );
    }
}

#[test]
fn friction_belongs_to_a_guide_a_slot_or_a_pin() {
    let friction =
        "[[friction]]\njoint = \"guide\"\ncoefficient = 0.1\nguide_length = \"150 mm\"\n";
    let (before, after) = PRESS.split_once("[motion]").unwrap();
    let press = format!("{before}{friction}\n[motion]{after}");
    crate::reading::parse(&press).unwrap();
    let edits = r#"
        joint = "guide" => joint = "gide" => `joint` in [[friction]] | "crank pivot", "crank pin", "slider pin", "guide"
        joint = "guide" => joint = "crank pin" => `pin_radius` in [[friction]] number 1 is missing
        guide_length => pin_radius => `guide_length` in [[friction]] number 1 is missing
        guide_length = "150 mm" => guide_length = "150 mm"\npin_radius = "1 mm" => `pin_radius` | not used here
        guide_length = "150 mm" => guide_length = "0 mm" => greater than zero
        coefficient = 0.1 => coefficient = -0.1 => `coefficient` | 0 | 2
        coefficient = 0.1 => coefficient = "10 %" => `coefficient`
    "#;
    refuses_edits(&press, edits);
    refuses_edit(
        GEARS,
        "[motion]",
        "[[friction]]\njoint = \"stage 1\"\ncoefficient = 0.1\n[motion]",
        &[
            "has no friction by a coefficient",
            "efficiency of [[drive_train]]",
        ],
    );
}
