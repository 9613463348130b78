//! Limits of a fastest motion: torque rates, forces in joints, the RMS torque.

use super::{PRESS_DRIVE, run};
use crate::support::{Folder, edited, press_file};

/// Torque rates whose motion takes many times as long as the fastest one, in falling order: each is found, satisfied, and takes longer. One test per
/// machine, so that they run in parallel.
fn found_at(machine: &str, drive: &str, rates: [&str; 2]) {
    let file = format!(
        "{}/../../machines/{machine}.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    let mut last = 0.0;
    for rate in rates {
        let limit = format!("{rate} N m/s");
        let asked = ["--drive", drive, "--max-torque-rate", &limit];
        let made = run(&[&["fastest", &file], &asked[..], &["--format", "json"]].concat())
            .ends(0)
            .json();
        let own = &made["moves"][0];
        let time = own["time"].as_f64().unwrap();
        assert!(own["excess"].as_f64().unwrap() <= 1e-6, "{machine} {rate}");
        assert!(
            time >= own["bound"].as_f64().unwrap() && time > last,
            "{machine} {rate}"
        );
        last = time;
    }
}

#[test]
fn small_torque_rates_of_a_press_are_found() {
    found_at("press", PRESS_DRIVE, ["316.2278", "10"]);
}

#[test]
fn small_torque_rates_of_a_toggle_press_are_found() {
    found_at("toggle-press", "sgm7g-05a+npt015mf-5", ["1e3", "1"]);
}

#[test]
fn small_torque_rates_of_a_six_link_press_are_found() {
    found_at(
        "linkage-press",
        "sgm7j-08a+npt035ma-16",
        ["3.162278", "0.1"],
    );
}

#[test]
fn small_torque_rates_of_a_cam_are_found() {
    found_at(
        "cam-oscillating",
        "sgm7j-c2a+npt015mf-10",
        ["0.3162278", "0.1"],
    );
}

/// The joint force that `fastest` limits is that of `reduce --reactions` for the written motion.
#[test]
fn a_limited_force_is_that_of_the_reactions() {
    let folder = Folder::new();
    let text = include_str!("../../../../machines/scotch-yoke.toml");
    let yoke = folder.file("yoke.toml", text);
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Run-up from rest").unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"p.csv\"\ncyclic = false\n\n";
    let judged = folder.file("judged.toml", edited(text, &text[begin..end], motion));
    let profile = folder.path("p.csv");
    let mut asked = vec![
        "fastest",
        yoke.to_str().unwrap(),
        "--from",
        "30 deg",
        "--to",
        "400 deg",
    ];
    asked.extend(["--torque", "80 N m", "--motor-speed", "1500 rpm"]);
    asked.extend(["--profile", profile.to_str().unwrap(), "--format", "json"]);
    let joint = ["--max-reaction", "pin in the slot=1 kN"];
    for (limit, most) in [(&joint[..], 1000.0), (&[], 2000.0)] {
        let made = run(&[&asked[..], limit].concat()).ends(0).json();
        let phases = made["moves"][0]["phases"].as_array().unwrap();
        let at_limit = phases
            .iter()
            .any(|phase| phase["limit"] == "force in pin in the slot");
        assert_eq!(at_limit, !limit.is_empty());
        let forces = run(&[
            "reduce",
            judged.to_str().unwrap(),
            "--reactions",
            "--over",
            "time",
            "--positions",
            "2000",
            "--format",
            "json",
        ]);
        let largest = forces.ends(0).json()["largest"].clone();
        let of_pin = largest
            .as_array()
            .unwrap()
            .iter()
            .find(|one| one["quantity"] == "pin in the slot F [N]");
        let force = of_pin.unwrap_or_else(|| panic!("{largest}"))["value"]
            .as_f64()
            .unwrap();
        if limit.is_empty() {
            assert!(force > 1.05 * 1000.0 && force < most, "{force}");
        } else {
            assert!((force / most - 1.0).abs() <= 1e-5, "{force}");
        }
    }
}

/// Where a guide reverses, its friction does, too: the largest force is that of the motion's side.
#[test]
fn the_largest_force_has_the_friction_of_its_own_side() {
    let home = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let feeder = home.join("../../machines/shaking-feeder.toml");
    let answer = run(&[
        "fastest",
        feeder.to_str().unwrap(),
        "--torque",
        "100 N m",
        "--motor-speed",
        "3000 rpm",
        "--max-reaction",
        "crank pivot=4 kN",
        "--format",
        "json",
    ])
    .ends(0)
    .json();
    let force = answer["joint_forces"][0]["force"].as_f64().unwrap();
    assert!(
        force <= 4000.0 * (1.0 + 1e-6) && force > 4000.0 * (1.0 - 1e-4),
        "{force}"
    );
}

/// A limit that is far from active lags where the torque has a bend; with this RMS torque that once stopped the search.
#[test]
fn a_limit_far_away_does_not_stop_the_search() {
    let press = press_file();
    let answer = run(&[
        "fastest",
        press.to_str().unwrap(),
        "--drive",
        PRESS_DRIVE,
        "--max-rms",
        "10.40564 N m",
        "--format",
        "json",
    ])
    .ends(0)
    .json();
    let found = answer["motor"]["rms_torque"].as_f64().unwrap();
    assert!(found <= 10.40564 && found > 10.4, "{found}");
}
