//! Machine files: what they say in SI units, and what a user is told about a wrong one.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

use jred::mechanism::Train;
use jred::{Action, Load, Mechanism, Window};
use jred_sizing::input;
use jred_sizing::machine::{AnyMechanism, MachineFile, Shaft};
use miette::{GraphicalReportHandler, GraphicalTheme, Report};

const PRESS: &str = include_str!("../../machines/press.toml");
const GEARS: &str = include_str!("data/gear-train.toml");

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")
}

fn parse(text: &str) -> Result<MachineFile, Report> {
    input::parse("machine.toml", text, &data())
}

/// The report as a user sees it, without colours.
fn rendered(report: &Report) -> String {
    let mut text = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(1000)
        .render_report(&mut text, report.as_ref())
        .unwrap();
    text
}

/// Reads `base` with `from` replaced by `to`, and checks that the report contains every one of `words`.
fn refuses_edit(base: &str, from: &str, to: &str, words: &[&str]) {
    assert!(base.contains(from), "the example has no {from}");
    refuses(&base.replacen(from, to, 1), words);
}

fn refuses(text: &str, words: &[&str]) {
    let report = match parse(text) {
        Err(report) => rendered(&report),
        Ok(_) => panic!("accepted, though the report should contain {words:?}"),
    };
    if std::env::var_os("SHOW_REPORTS").is_some() {
        println!("{report}");
    }
    for word in words {
        assert!(report.contains(word), "{word:?} is not in\n{report}");
    }
}

fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(error <= 1e-15 * expected.abs().max(1e-3), "{found} is not {expected}");
}

#[test]
fn the_press_is_read_in_si_units() {
    let press = input::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../machines/press.toml"))).unwrap();
    assert_eq!(press.title, "Servo press, 60 mm stroke, 20 kN");
    let AnyMechanism::SliderCrank(mechanism) = press.machine.mechanism() else {
        panic!("not a slider-crank");
    };
    close(mechanism.crank(), 0.03);
    close(mechanism.rod(), 0.18);
    let [crank, rod, slider] = mechanism.links() else { panic!("three links") };
    close(crank.mass(), 9.0);
    close(crank.inertia(), 0.018);
    close(crank.com()[0], 0.006);
    close(rod.mass(), 6.5);
    close(rod.inertia(), 0.03);
    close(rod.com()[0], 0.055);
    close(slider.mass(), 42.0);
    close(press.flywheel, 0.05);
    close(press.machine.flywheel(), 0.05);

    let names: Vec<&str> = press.loads.iter().map(|named| named.name.as_str()).collect();
    assert_eq!(names, ["pressing force", "guide friction", "crank bearings"]);
    assert_eq!(press.machine.loads().len(), 3);
    let window = Window::new(1.75 * PI, TAU, PI / 12.0).unwrap();
    let frames = mechanism.frames(6.0).unwrap();
    let expected = Load::new(2, Action::Force([-20_000.0, 0.0])).unwrap().within(window);
    let (found, expected) = (press.loads[0].load.reduce(&frames[2], 6.0), expected.reduce(&frames[2], 6.0));
    assert!((found.process / expected.process - 1.0).abs() < 1e-9);
    assert_eq!(press.loads[1].load, Load::new(2, Action::OpposingForce(150.0)).unwrap());
    assert_eq!(press.loads[2].load, Load::new(0, Action::ViscousMoment(0.4)).unwrap());

    close(press.drive_train.ratio(), 3.0);
    close(press.drive_train.efficiency(), 0.97);
    close(press.drive_train.inertia_at_input(), 0.0006 + 0.6 * 0.04 * 0.04 + 0.03 / 9.0);

    let motion = press.motion.unwrap();
    assert!(motion.cyclic);
    close(motion.duration(), 1.0);
    close(motion.at(0.0).phi, PI);
    close(motion.at(1.0).phi, 3.0 * PI);

    let simulation = press.simulation.unwrap();
    close(simulation.start_angle, PI);
    close(simulation.duration, 1.5);
    close(simulation.output_step, 0.005);
    assert_eq!(simulation.torque.len(), 3);
    close(simulation.torque[1].0, 50.0 * PI);
    close(simulation.torque[1].1, 10.0);
    assert_eq!(simulation.at, Shaft::Motor);
    close(simulation.rotor_inertia, 0.0012);
    close(simulation.tolerance, 1e-10);
    close(press.rules.rms_torque, 0.8);
}

#[test]
fn a_gear_train_with_every_optional_key_is_read() {
    let file = parse(GEARS).unwrap();
    let AnyMechanism::Train(train) = file.machine.mechanism() else { panic!("not a train") };
    close(train.ratio(), -3.0 * 4.0);
    close(file.drive_train.ratio(), -2.0);
    close(file.drive_train.efficiency(), 0.98);
    assert_eq!(file.loads[0].name, "opposing moment on shaft-3");
    let motion = file.motion.unwrap();
    assert!(!motion.cyclic);
    close(motion.at(0.6).phi, PI);
    let simulation = file.simulation.unwrap();
    assert_eq!(simulation.torque, [(0.0, 2.5)]);
    assert_eq!(simulation.at, Shaft::DriveLink);
    close(file.rules.rms_torque, 0.7);
    close(file.rules.peak_torque, 0.75);
    close(file.rules.inertia_ratio, 8.0);
}

#[test]
fn a_belt_and_a_constant_speed_are_read() {
    let text = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
                driver = { radius = \"2 cm\", inertia = \"1 kg cm^2\" }\n\
                driven = { radius = \"5 cm\", inertia = \"6 kg cm^2\" }\n\
                [motion]\ntype = \"constant-speed\"\nspeed = \"-60 rpm\"\n";
    let file = parse(text).unwrap();
    assert_eq!(file.title, "machine.toml");
    assert_eq!(file.drive_train, Train::new(&[]).unwrap());
    let motion = file.motion.unwrap();
    close(motion.duration(), 1.0);
    close(motion.at(0.25).phi, -TAU / 4.0);
}

#[test]
fn every_line_of_the_press_is_optional_or_missed_by_name() {
    let optional = [
        "title", "offset", "branch", "flywheel", "com", "name", "between", "ramp", "belt_mass", "efficiency",
        "start", "start_speed", "at", "rotor_inertia",
    ];
    for (number, line) in PRESS.lines().enumerate() {
        let Some((key, _)) = line.split_once(" = ").filter(|_| !line.starts_with('#')) else { continue };
        let text: String = PRESS
            .lines()
            .enumerate()
            .filter(|(k, _)| *k != number)
            .map(|(_, line)| format!("{line}\n"))
            .collect();
        match parse(&text) {
            Ok(_) => assert!(optional.contains(&key), "line {}: {line}", number + 1),
            Err(report) => {
                let report = rendered(&report);
                let pair = ["between", "ramp"].contains(&key);
                assert!(pair || !optional.contains(&key), "line {}: {report}", number + 1);
                let named = report.contains(&format!("`{key}`")) && report.contains("missing");
                // Some keys leave nothing behind that could be named: the other alternative is named, too.
                let key = if key == "torque_speed" || key.starts_with("opposing") || key.starts_with("viscous") || key == "force" || key == "dwell" { report.contains(key) } else { named };
                assert!(key, "line {}: {line}\n{report}", number + 1);
            }
        }
    }
}

#[test]
fn wrong_quantities_are_shown_with_their_cure() {
    let length = "length = \"30 mm\"";
    let edits: [(&str, &str, &[&str]); 16] = [
        (length, "length = 30", &["machine.toml:15", "`length` in [mechanism.crank]", "no unit", "\"30 mm\""]),
        (length, "length = \"30\"", &["no unit", "\"30 mm\"", "possible units"]),
        (length, "length = \"30 kg\"", &["must be a length, but \"30 kg\" is a mass", "m, cm, mm"]),
        (length, "length = \"0 mm\"", &["[mechanism.crank] is 0 mm", "greater than zero"]),
        (length, "length = \"1e-9 mm\"", &["smaller than any machine"]),
        (length, "length = nan", &["not a finite number"]),
        (length, "length = \"nan mm\"", &["not a finite number"]),
        (length, "length = [\"30 mm\"]", &["text in quotes", "is a list", "length = \"120 mm\""]),
        (length, "length = true", &["is true or false"]),
        (length, "length = 30 mm", &["not valid TOML", "length = \"30 mm\""]),
        (length, "length = \"30 mm\"\nlength = \"31 mm\"", &["duplicate key", "remove"]),
        ("mass = \"42 kg\"", "mass = \"-42 kg\"", &["is -42 kg, but must not be negative"]),
        ("mass = \"42 kg\"", "mass = \"42000 t\"", &["larger than any machine", "at most 1000 t"]),
        ("com = [\"6 mm\", \"0 mm\"]", "com = [\"6 mm\"]", &["must have two values, but has 1"]),
        ("\"9.81 m/s^2\"", "\"9.81 m/s\"", &["value 1 of `gravity`", "is a speed", "m/s^2"]),
        ("97 %", "103 %", &["`efficiency`", "is 103 %", "100 %"]),
    ];
    for (from, to, words) in edits {
        refuses_edit(PRESS, from, to, words);
    }
    refuses_edit(PRESS, "efficiency = \"97 %\"", "efficiency = 97", &["must not be larger than 1", "\"97 %\""]);
}

#[test]
fn wrong_words_are_shown_with_the_right_ones() {
    let edits: [(&str, &str, &[&str]); 20] = [
        ("length = \"30 mm\"", "lenght = \"30 mm\"", &["`lenght`", "did you mean \"length\"?"]),
        ("offset =", "ofset =", &["`ofset` in [mechanism]", "did you mean \"offset\"?", "branch"]),
        ("[simulation]", "[simulaton]", &["`simulaton`", "did you mean \"simulation\"?"]),
        ("\"slider-crank\"", "\"slidercrank\"", &["did you mean \"slider-crank\"?", "\"belt\""]),
        ("\"right\"", "\"up\"", &["\"up\"", "\"right\", \"left\""]),
        ("\"polynomial-345\"", "\"poly5\"", &["`law`", "\"poly5\"", "modified-sine"]),
        ("on = \"crank\"", "on = \"shaft\"", &["`on` in [[load]] number 3", "\"crank\", \"rod\", \"slider\""]),
        ("opposing_force", "opposing_moment", &["must be a torque", "is a force"]),
        ("opposing_force = \"150 N\"", "opposing_moment = \"150 N m\"", &["the slider does not turn"]),
        ("opposing_force = \"150 N\"", "opposing_force = \"-150 N\"", &["must not be negative", "against the motion"]),
        ("opposing_force = \"150 N\"", "opposing_force = \"150 N\"\nmoment = \"1 N m\"", &["both `moment` and `opposing_force`"]),
        ("opposing_force = \"150 N\"", "", &["action is missing", "exactly one of", "opposing_force"]),
        ("viscous_moment = \"0.4 N m s/rad\"", "opposing_force = \"3 N\"", &["fixed pivot", "at = ["]),
        ("viscous_moment", "at = [\"1 mm\", \"0 mm\"]\nviscous_moment", &["`at` has no meaning", "remove"]),
        ("ramp = \"15 deg\"", "ramp = \"25 deg\"", &["too long for the range of 45 deg", "at most 22.5 deg"]),
        ("\"360 deg\"]", "\"315 deg\"]", &["`between`", "at most one turn", "315 deg"]),
        ("driver = { radius = \"40 mm\",", "driver = { diameter = \"80 mm\",", &["`radius`", "missing"]),
        ("gravity =", "# gravity =", &["`gravity` is missing", "horizontal plane"]),
        ("flywheel =", "efficiency = 0.9\nflywheel =", &["efficiency belongs to [[drive_train]]"]),
        ("mass = \"42 kg\"", "mass = \"42 kg\"\ninertia = \"1 kg m^2\"", &["the slider does not turn"]),
    ];
    for (from, to, words) in edits {
        refuses_edit(PRESS, from, to, words);
    }
}

#[test]
fn machines_that_cannot_work_are_refused_with_figures() {
    refuses_edit(PRESS, "180 mm", "25 mm", &["too short", "φ = 56.44°", "crank + |offset| = 30 mm"]);
    refuses_edit(PRESS, "offset = \"0 mm\"", "offset = \"-200 mm\"", &["`length` in [mechanism.rod]", "230 mm"]);
    let bare = ["flywheel = \"0.05", "inertia = \"0.018", "mass = \"9", "mass = \"6.5", "inertia = \"0.03 kg m^2\"\ncom", "inertia = \"0.0006", "inertia = \"0.03 kg m^2\" }", "belt_mass = \"0.6"];
    let massless = bare.iter().fold(PRESS.to_owned(), |text, from| {
        let (key, _) = from.split_once('"').unwrap();
        let unit_and_rest = text.split_once(from).unwrap_or_else(|| panic!("{from}")).1.to_owned();
        let tail = from.split_once('"').unwrap().1;
        let kept = tail.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
        let before = text.split_once(from).unwrap().0;
        format!("{before}{key}\"0{kept}{unit_and_rest}")
    });
    refuses(&massless, &["reduced inertia is not positive", "flywheel = "]);
    let stage = GEARS.split("[[mechanism.stage]]").nth(1).unwrap();
    let many = GEARS.replacen("[[mechanism.stage]]", &format!("[[mechanism.stage]]{stage}").repeat(8), 1);
    refuses(&many, &["more than 8 stages", "combine stages"]);
    let load = "[[load]]\non = \"slider\"\nopposing_force = \"1 N\"\n";
    refuses(&format!("{PRESS}\n{}", load.repeat(14)), &["more than 16 loads"]);
}

#[test]
fn motions_and_simulations_that_make_no_sense_are_refused() {
    let edits: [(&str, &str, &[&str]); 16] = [
        ("\"360 deg\"\nduration", "\"350 deg\"\nduration", &["add up to 350 deg", "a move of 10 deg", "point-to-point"]),
        ("dwell = \"0.25 s\"", "dwell = \"0.25 s\"\nmove = \"10 deg\"", &["both `move` and `dwell`", "two [[motion.segment]]"]),
        ("dwell = \"0.25 s\"", "dwell = \"0 s\"", &["`dwell` in [[motion.segment]] number 2", "greater than zero"]),
        ("dwell = \"0.25 s\"", "duration = \"0.25 s\"", &["missing", "dwell = \"0.25 s\""]),
        ("move = \"360 deg\"", "move = \"0 deg\"", &["nothing moves", "dwell"]),
        ("move = \"360 deg\"", "move = \"360\"", &["no unit", "\"360 deg\""]),
        ("\"polynomial-345\"", "\"trapezoid\"\naccelerate = \"80 %\"", &["113.333 %", "together at most 100 %"]),
        ("\"polynomial-345\"", "\"cycloidal\"\naccelerate = \"80 %\"", &["only the law \"trapezoid\""]),
        ("type = \"cycle\"", "type = \"cycles\"", &["did you mean \"cycle\"?"]),
        ("type = \"cycle\"", "type = \"constant-speed\"\nspeed = \"0 rpm\"", &["`segment`"]),
        ("at = \"motor\"", "at = \"motor\"\ntorque = \"3 N m\"", &["both `torque` and `torque_speed`"]),
        ("\"1500 rpm\"", "\"3500 rpm\"", &["is 3000 rpm", "larger than the speed of the point before, 3500 rpm"]),
        ("\"1500 rpm\"", "\"25 Hz\"", &["is a frequency", "rpm", "rad/s"]),
        ("output_step = \"5 ms\"", "output_step = \"5 us\"", &["300000 steps", "from 15 us"]),
        ("rotor_inertia", "tolerance = 1\nrotor_inertia", &["`tolerance`", "between"]),
        ("rotor_inertia = \"12 kg cm^2\"", "[rules]\ninertia_ratio = 3", &["inertia_ratio_warning", "above"]),
    ];
    for (from, to, words) in edits {
        refuses_edit(PRESS, from, to, words);
    }
}

#[test]
fn random_damage_never_panics() {
    let mut state = 7_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let spare: Vec<char> = "\"[]{}=.,-+e0919 \n#kmNs^/%²é\u{0}\u{feff}".chars().collect();
    for round in 0..500 {
        let base = if round % 3 == 0 { GEARS } else { PRESS };
        let mut text: Vec<char> = base.chars().collect();
        for _ in 0..=random(4) {
            let at = random(text.len());
            match random(4) {
                0 => drop(text.remove(at)),
                1 => text[at] = spare[random(spare.len())],
                2 => text.insert(at, spare[random(spare.len())]),
                _ => drop(text.drain(at..(at + random(60)).min(text.len()))),
            }
        }
        let text: String = text.into_iter().collect();
        if let Err(report) = parse(&text) {
            assert!(rendered(&report).len() > 20);
        }
    }
}
