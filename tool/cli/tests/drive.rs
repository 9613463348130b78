//! `jred drive`: figures against closed forms, parameters against their data sheets, faults.

use std::f64::consts::{PI, TAU};

use serde_json::Value;

use crate::support::{Folder, jred_of, near, shipped};

/// Motor with gearbox for the press: Yaskawa SGM7A-25A (7.96 N m, 23.9 N m, 15.6 A, 51 A, 3.19 kg cm²) and Beckhoff TP004 MF i=4.
const NAMED: &str = "sgm7a-25a+tp004mf-4";

fn figure(json: &Value, setting: &str) -> Option<f64> {
    let figures = json["figures"].as_array().unwrap();
    let found = figures.iter().find(|f| f["setting"] == setting);
    found.expect(setting)["value"].as_f64()
}

fn remark<'a>(json: &'a Value, setting: &str) -> &'a str {
    let figures = json["figures"].as_array().unwrap();
    let limit = figures.iter().find(|f| f["setting"] == setting);
    limit.unwrap()["remark"].as_str().unwrap()
}

fn parameter<'a>(json: &'a Value, maker: &str, number: &str) -> &'a Value {
    let find = |list: &'a Value, key: &str, word: &str| {
        let list = list.as_array().unwrap();
        list.iter().find(|entry| entry[key] == word).expect(word)
    };
    let parameters = &find(&json["makers"], "key", maker)["parameters"];
    find(parameters, "number", number)
}

#[test]
fn parameters_of_a_named_drive_follow_its_data_sheet() {
    let line = format!(
        "drive {{}} --drive {NAMED} --counts-per-turn 16777216 --bandwidth '40 Hz' --format json"
    );
    let json = jred_of(&line, [&shipped("press.toml")]).json();
    let value = |maker: &str, number: &str| parameter(&json, maker, number)["value"].as_f64();
    assert_eq!(value("cia402", "0x6076"), Some(7960.0));
    assert_eq!(value("cia402", "0x6075"), Some(15600.0));
    assert_eq!(value("cia402", "0x6073"), Some(3269.0)); // 51/15.6
    assert_eq!(value("cia402", "0x608F:01"), Some(16_777_216.0));
    // The gearbox i = 4 and the belt 40 mm to 120 mm.
    assert_eq!(value("cia402", "0x6091:01"), Some(12.0));
    assert_eq!(value("cia402", "0x6091:02"), Some(1.0));
    // T2B/i = 66/4 N m, unless the cycle takes more; never above the motor's peak torque.
    let cycle = figure(&json, "cycle-peak-torque").unwrap();
    let limit = 23.9_f64.min(16.5_f64.max(cycle));
    near("limit", figure(&json, "torque-limit").unwrap(), limit, 1e-9);
    let by = "T2B/i of the gearbox";
    assert_eq!(remark(&json, "torque-limit"), by);
    assert_eq!(parameter(&json, "cia402", "0x6072")["remark"], by);
    let per_mille = (limit / 7.96 * 1000.0).floor();
    assert_eq!(value("cia402", "0x6072"), Some(per_mille));
    assert_eq!(
        value("sigma-7", "Pn402"),
        Some((limit / 7.96 * 100.0).floor())
    );
    assert_eq!(value("sigma-7", "Pn100"), Some(400.0));
    // 4000/(2π·40) ms, in hundredths; 2π·40/4 in tenths.
    assert_eq!(value("sigma-7", "Pn101"), Some(1592.0));
    assert_eq!(value("sigma-7", "Pn102"), Some(628.0));
    // 6000 rpm are 0.1 turns in a millisecond; 16.5 N m of 23.9 N m.
    assert_eq!(value("ax5000", "S-0-0091"), Some(107_374_182.0));
    assert_eq!(value("ax5000", "S-0-0092"), Some(69.0));
    assert_eq!(value("akd", "VL.THRESH"), Some(6000.0));
    let hardware = "limit of the motor, not of the machine";
    assert_eq!(remark(&json, "speed-limit"), hardware);
    // 7.96 N m with 15.6 A, and from there on a line to 23.9 N m with 51 A.
    let constant = 7.96 / 15.6;
    near(
        "MOTOR.KT",
        value("akd", "MOTOR.KT").unwrap(),
        constant,
        1e-4,
    );
    let computed = parameter(&json, "akd", "MOTOR.KT")["remark"].to_string();
    assert!(
        computed.contains("computed from other figures"),
        "{computed}"
    );
    let current = 15.6 + (limit - 7.96) * (51.0 - 15.6) / (23.9 - 7.96);
    let typed = value("akd", "IL.LIMITP").unwrap();
    assert!(typed <= current && typed > current - 2e-3, "{typed}");
    assert_eq!(value("akd", "PL.KP"), Some(62.832));
    assert_eq!(value("akd", "MOTOR.INERTIA"), Some(3.19));
    let ratio = figure(&json, "inertia-ratio").unwrap();
    near("VL.LMJR", value("akd", "VL.LMJR").unwrap(), ratio, 2e-4);
    // A data sheet without the torque at standstill.
    let unknown = parameter(&json, "ax8000", "0x6072");
    assert_eq!(unknown["value"], Value::Null);
    assert_eq!(
        unknown["remark"],
        "not given; read it from the motor's data sheet"
    );
}

/// A sheet for another maker's amplifier says so; that of its own maker, and the profile of all makers, do not.
#[test]
fn the_amplifier_of_another_maker_is_named() {
    for (makers, others) in [
        ("", Some("Beckhoff and Kollmorgen")),
        ("--maker akd", Some("Kollmorgen")),
        ("--maker sigma-7", None),
        ("--maker cia402", None),
    ] {
        let line = format!("drive {{}} --drive {NAMED} {makers} --format json");
        let json = jred_of(&line, [&shipped("press.toml")]).json();
        let warnings = json["warnings"].to_string();
        let says = "sgd7s-200a is of Yaskawa: the parameters of ";
        let said = warnings.split_once(says).map(|(_, rest)| rest);
        assert_eq!(said.is_some(), others.is_some(), "{makers}: {warnings}");
        assert!(
            said.unwrap_or_default()
                .starts_with(others.unwrap_or_default()),
            "{warnings}"
        );
    }
}

/// A ram that goes up and down needs no constant torque: none is typed in.
#[test]
fn a_weight_that_changes_its_sign_is_left_out() {
    let line = format!("drive {{}} --drive {NAMED} --format json");
    let json = jred_of(&line, [&shipped("press.toml")]).json();
    assert_eq!(figure(&json, "weight-torque"), None);
    let typed = parameter(&json, "ax8000", "0x3140:05");
    assert_eq!(typed["value"], Value::Null);
    let remark = typed["remark"].as_str().unwrap();
    assert!(remark.contains("changes its sign"), "{remark}");
}

/// Parameters and figures that are not given come last.
#[test]
fn rows_without_a_value_come_last() {
    let line = format!("drive {{}} --drive {NAMED} --format json");
    let json = jred_of(&line, [&shipped("press.toml")]).json();
    let makers = json["makers"].as_array().unwrap();
    let lists = makers.iter().map(|maker| &maker["parameters"]);
    for list in lists.chain([&json["figures"]]) {
        let given = list.as_array().unwrap().iter();
        let given: Vec<bool> = given.map(|row| !row["value"].is_null()).collect();
        assert!(given.is_sorted_by(|a, b| a >= b), "{list}");
        assert!(given.contains(&true));
    }
}

/// A vertical screw, directly coupled: J = J_s + m·(h/2π)², T_g = m·g·h/2π, T_f = F·h/2π + T_s.
#[test]
fn a_screw_follows_its_closed_form() {
    let line =
        "drive {} --drive sgm7a-25a --counts-per-turn 1048576 --bandwidth '30 Hz' --format json";
    let json = jred_of(line, [&shipped("ball-screw.toml")]).json();
    let get = |setting| figure(&json, setting).unwrap();
    let (mass, arm) = (140.0, 0.02 / TAU);
    let load = 6.4e-4 + mass * arm * arm;
    for setting in ["load-inertia", "least-load-inertia", "largest-load-inertia"] {
        near(setting, get(setting), load, 1e-9);
    }
    near("ratio", get("inertia-ratio"), load / 3.19e-4, 1e-9);
    near("weight", get("weight-torque"), mass * 9.81 * arm, 1e-9);
    near("dry", get("coulomb-friction"), 180.0 * arm + 0.4, 1e-9);
    near(
        "gain",
        get("speed-gain"),
        2.0 * PI * 30.0 * (load + 3.19e-4),
        1e-9,
    );
    near(
        "position",
        get("largest-position"),
        20.0 * 1_048_576.0,
        1e-9,
    );
    let typed = parameter(&json, "sigma-7", "Pn103")["value"].as_f64();
    assert_eq!(typed, Some((100.0 * load / 3.19e-4).round()));
    // A gain in amperes, of a motor whose data sheet has 0.519 N m/A.
    let line = "drive {} --drive sgm7a-40a --bandwidth '30 Hz' --format json";
    let json = jred_of(line, [&shipped("ball-screw.toml")]).json();
    let akd = |number| parameter(&json, "akd", number)["value"].as_f64().unwrap();
    let gain = figure(&json, "speed-gain").unwrap() / 0.519;
    near("torque constant", akd("MOTOR.KT"), 0.519, 1e-9);
    near("A/(rad/s)", akd("VL.KP"), gain, 1e-3);
    let weight = figure(&json, "weight-torque").unwrap() / 0.519;
    near("IL.OFFSET", akd("IL.OFFSET"), weight, 1e-3);
}

/// ∫J·α² dt/∫α² dt of a Scotch yoke, J = J_0 + m·r²·sin²φ, integrated here over the law 3-4-5.
#[test]
fn the_best_constant_inertia_is_that_of_least_squares() {
    let folder = Folder::new();
    let file = folder.file(
        "yoke.toml",
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"scotch-yoke\"\nslot_angle = \"90 deg\"\nflywheel = \"0.002 kg m^2\"\n\
         [mechanism.crank]\nlength = \"50 mm\"\nmass = \"1 kg\"\ninertia = \"0.001 kg m^2\"\ncom = [\"0 mm\", \"0 mm\"]\n\
         [mechanism.yoke]\nmass = \"2 kg\"\n\
         [motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"360 deg\"\nduration = \"0.5 s\"\n",
    );
    let json = jred_of("drive {} --drive sgm7a-25a --format json", [&file]).json();
    let (mut above, mut below) = (0.0, 0.0);
    for k in 0..20_000 {
        let u = (f64::from(k) + 0.5) / 20_000.0;
        let phi = TAU * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u);
        let alpha = u * (60.0 - 180.0 * u + 120.0 * u * u);
        let inertia = 0.003 + 2.0 * (0.05 * phi.sin()).powi(2);
        above += inertia * alpha * alpha;
        below += alpha * alpha;
    }
    let best = figure(&json, "load-inertia").unwrap();
    near("J", best, above / below, 1e-6);
    near(
        "least",
        figure(&json, "least-load-inertia").unwrap(),
        0.003,
        1e-6,
    );
    near(
        "most",
        figure(&json, "largest-load-inertia").unwrap(),
        0.008,
        1e-4,
    );
    let warnings = json["warnings"].to_string();
    assert!(warnings.contains("varies by the factor"), "{warnings}");
}

#[test]
fn a_value_beyond_the_range_of_its_parameter_is_left_out_with_a_cure() {
    let line =
        format!("drive {{}} --drive {NAMED} --bandwidth '5 kHz' --maker sigma-7 --format json");
    let json = jred_of(&line, [&shipped("press.toml")]).json();
    let gain = parameter(&json, "sigma-7", "Pn100");
    assert_eq!(gain["value"], Value::Null);
    let remark = gain["remark"].as_str().unwrap();
    assert!(
        remark.starts_with("50000 is beyond the range 10 to 20000: give a lower --bandwidth"),
        "{remark}"
    );
    let time = parameter(&json, "sigma-7", "Pn101")["remark"].to_string();
    assert!(
        time.contains("13 is beyond the range 15 to 51200: give a lower"),
        "{time}"
    );
    let warnings = json["warnings"].to_string();
    assert!(
        warnings.contains("Yaskawa Sigma-7 Pn100: 50000"),
        "{warnings}"
    );
    assert_eq!(json["makers"].as_array().unwrap().len(), 1);
}

#[test]
fn faults_have_their_cure() {
    let press = shipped("press.toml");
    let run = jred_of("drive {} --drive nothing", [&press]).ends(2);
    assert!(run.message().contains("there is no drive \"nothing\""));
    let run = jred_of("drive {} --maker nobody", [&press]).ends(2);
    assert!(
        run.message()
            .contains("write one of: cia402, ax8000, sigma-7, akd, ax5000")
    );
    let run = jred_of("drive {}", [&shipped("linear-gripper.toml")]).ends(2);
    assert!(run.message().contains("rotary motors only"));
}

/// A gripper's slide on a rack has no turns; with 30 mm of its pinion the motor turns by s/r.
#[test]
fn a_drive_link_that_slides_has_no_ratio_of_turns() {
    let folder = Folder::new();
    let gripper = std::fs::read_to_string(shipped("linear-gripper.toml")).unwrap();
    let rack = "[[drive_train]]\ntype = \"rack\"\nradius = \"30 mm\"\ninertia = \"0 kg m^2\"\n\n[motion]\n";
    let gripper = gripper.replacen("[motion]\n", rack, 1);
    // The simulation has a torque at the input now.
    let gripper = gripper.replacen("force = \"60 N\"", "torque = \"2 N m\"", 1);
    let file = folder.file("gripper.toml", &gripper);
    let line = "drive {} --drive sgm7a-25a --counts-per-turn 1000000 --format json";
    let json = jred_of(line, [&file]).json();
    for number in ["0x6091:01", "0x6091:02"] {
        let turns = parameter(&json, "cia402", number);
        assert_eq!(turns["value"], Value::Null);
        let remark = turns["remark"].as_str().unwrap();
        assert!(remark.contains("the drive link slides"), "{remark}");
    }
    let way = figure(&json, "largest-position").unwrap() - figure(&json, "least-position").unwrap();
    near("counts", way, 0.08 / 0.03 / TAU * 1e6, 1e-9);
    let turns = parameter(&json, "cia402", "0x608F:02");
    assert_eq!(turns["value"].as_f64(), Some(1.0));
}

/// One pair of gears reverses, two do not.
#[test]
fn a_train_that_reverses_is_named() {
    let folder = Folder::new();
    let axis = std::fs::read_to_string(shipped("belt-axis.toml")).unwrap();
    let idler = "[[drive_train.stage]]\ndriver = { teeth = 20, inertia = \"0 kg m^2\" }\ndriven = { teeth = 20, inertia = \"0 kg m^2\" }\n\n[motion]\n";
    let twice = folder.file("twice.toml", axis.replacen("[motion]\n", idler, 1));
    for (file, direction) in [(shipped("belt-axis.toml"), -1.0), (twice, 1.0)] {
        let line = "drive {} --drive sgm7a-25a --counts-per-turn 1000 --format json";
        let json = jred_of(line, [&file]).json();
        assert_eq!(figure(&json, "direction"), Some(direction));
        let [least, most] =
            ["least-position", "largest-position"].map(|setting| figure(&json, setting).unwrap());
        assert!((least + most) * direction > 0.0, "{least} to {most}");
        let named = json["warnings"].to_string().contains("reverses");
        assert_eq!(named, direction < 0.0);
    }
}

#[test]
fn csv_and_page_have_the_parameters() {
    let folder = Folder::new();
    let page = folder.path("drive.html");
    let line = format!("drive {{}} --drive {NAMED} --report {{}} --format csv");
    let run = jred_of(&line, [&shipped("press.toml"), &page]);
    assert!(
        run.out.starts_with("maker,parameter,name,value,unit\n"),
        "{}",
        run.out
    );
    assert!(
        run.out.contains("cia402,0x6076,Motor rated torque,7960"),
        "{}",
        run.out
    );
    let html = std::fs::read_to_string(page).unwrap();
    for word in ["0x6076", "Pn103", "not given; give --bandwidth"] {
        assert!(html.contains(word), "{word}");
    }
}
