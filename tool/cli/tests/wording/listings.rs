//! Output of the commands about a machine: full tables, and the heads of CSV and JSON of all commands.

use super::{Desk, compare};

const CATALOGUE: [&str; 3] = ["--catalogue", "drives", "--steps"];

/// `jred` with the small catalogue and few time steps.
pub(super) fn sized<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    let mut all = arguments.to_vec();
    all.extend(CATALOGUE);
    all.push("64");
    all
}

pub(super) fn press() -> Desk {
    Desk::new().with_machines(&["press.toml"])
}

#[test]
fn check() {
    let machines = [
        "press.toml",
        "cam-translating.toml",
        "four-bar.toml",
        "linkage-press.toml",
        "variator-press.toml",
        "parallel-lift.toml",
        "drawing-press.toml",
        "flying-shear.toml",
    ];
    let desk = Desk::new().with_machines(&machines);
    let commands: Vec<[&str; 2]> = machines.map(|machine| ["check", machine]).into();
    let commands: Vec<&[&str]> = commands.iter().map(|c| &c[..]).collect();
    compare("check", &desk.runs(&commands));
}

#[test]
fn reduce() {
    let desk = Desk::new().with_machines(&[
        "press.toml",
        "linear-gripper.toml",
        "cam-translating.toml",
        "pick-and-place.toml",
    ]);
    let press = ["reduce", "press.toml", "--positions", "4"];
    let with = |more: &[&'static str]| [&press[..], more].concat();
    compare(
        "reduce",
        &desk.runs(&[
            &press,
            &with(&["--over", "time"]),
            &with(&["--links"]),
            &with(&["--points"]),
            &with(&["--reactions"]),
            &with(&["--energy", "--speed", "60 rpm"]),
            &[
                "reduce",
                "press.toml",
                "--at",
                "30 deg, 60 rpm, 5 rad/s^2, 200 deg, 300 deg, 30 rpm",
            ],
            &["reduce", "pick-and-place.toml", "--positions", "3"],
            &[
                "reduce",
                "pick-and-place.toml",
                "--positions",
                "7",
                "--over",
                "time",
            ],
            &[
                "reduce",
                "pick-and-place.toml",
                "--positions",
                "2",
                "--format",
                "csv",
            ],
            &["check", "pick-and-place.toml"],
            &["reduce", "linear-gripper.toml", "--positions", "3"],
            &[
                "reduce",
                "cam-translating.toml",
                "--positions",
                "3",
                "--reactions",
                "--speed",
                "600 rpm",
            ],
        ]),
    );
}

#[test]
fn rules() {
    let desk = Desk::new();
    compare(
        "rules",
        &desk.runs(&[
            &["rules"],
            &["rules", "general"],
            &["rules", "fanuc"],
            &["rules", "safety-factor-2"],
        ]),
    );
}

#[test]
fn split() {
    let desk = Desk::new();
    let split = ["split", "--ratio", "30", "--stages"];
    let with = |more: &[&'static str]| [&split[..], more].concat();
    compare(
        "split",
        &desk.runs(&[
            &with(&["2", "--pinion", "0.2 kg cm^2", "--points", "4"]),
            &with(&[
                "3",
                "--pinion",
                "0.2 kg cm^2",
                "--driven",
                "2 kg cm^2",
                "--load",
                "0.01 kg m^2",
                "--points",
                "3",
            ]),
            &with(&["2", "--pinion", "0.2 kg cm^2", "--max-ratio", "5"]),
            &with(&["2", "--pinion", "0.2 kg cm^2", "--min-ratio", "8"]),
            &with(&["2", "--pinion", "0.2 kg cm^2", "--min-ratio", "-8"]),
            &with(&["3", "--pinion", "1 kg cm^2", "--pinion", "2 kg cm^2"]),
        ]),
    );
}

#[test]
fn export() {
    let desk = Desk::new().with_machines(&["press.toml", "shaking-feeder.toml"]);
    let export = ["export", "press.toml"];
    let with = |more: &[&'static str]| [&export[..], more].concat();
    compare(
        "export",
        &desk.runs(&[
            &with(&["--torque-error", "0.5 N m"]),
            &with(&[
                "--torque-error",
                "0.5 N m",
                "--type",
                "i32",
                "--reciprocal",
                "yes",
            ]),
            &with(&["--max-bytes", "1000", "--type", "i16", "--out", "table.bin"]),
            &with(&["--torque-error", "0.5 N m", "--max-cells", "60"]),
            &with(&["--torque-error", "0.02 N m", "--type", "i16"]),
            &with(&["--torque-error", "0.5 N m", "--pieces", "auto"]),
            &with(&[
                "--torque-error",
                "0.02 N m",
                "--pieces",
                "auto",
                "--max-cells",
                "20",
            ]),
            &with(&["--torque-error", "0.5 N m", "--max-bytes", "200"]),
            &with(&["--max-bytes", "20"]),
            &with(&["--torque-error", "0.5 N m", "--layout", "slider-crank"]),
            &["export", "shaking-feeder.toml", "--torque-error", "0.5 N m"],
        ]),
    );
}

/// The first lines of CSV, and the keys of JSON.
#[test]
fn csv_and_json() {
    let desk = Desk::new().with_machines(&["press.toml", "variator-press.toml"]);
    let commands: [&[&str]; 9] = [
        &["reduce", "press.toml"],
        &["check", "press.toml"],
        &["size", "press.toml", "--explain"],
        &["ratio", "press.toml"],
        &["bus", "press.toml"],
        &["sensitivity", "press.toml"],
        &["simulate", "press.toml"],
        &["rules", "general"],
        &[
            "split",
            "--ratio",
            "30",
            "--stages",
            "2",
            "--pinion",
            "1 kg cm^2",
        ],
    ];
    let mut text = String::new();
    for command in commands {
        for format in ["csv", "json"] {
            let mut all = [command, &["--format", format]].concat();
            if ["size", "ratio", "bus", "sensitivity"].contains(&command[0]) {
                all = sized(&all);
            }
            let out = desk.run(&all);
            let (typed, out) = out.split_once('\n').unwrap();
            text += typed;
            text.push('\n');
            match serde_json::from_str(out) {
                Ok(value) if format == "json" => keys(&value, "  ", &mut text),
                _ => {
                    let head = out.lines().take(3).flat_map(|line| [line, "\n"]);
                    text.extend(head);
                }
            }
        }
    }
    compare("csv-and-json", &text);
}

/// The keys of objects in order; for a list those of its first entry.
fn keys(value: &serde_json::Value, indent: &str, text: &mut String) {
    match value {
        serde_json::Value::Object(object) => {
            for (key, value) in object {
                text.extend([indent, key, "\n"]);
                keys(value, &format!("{indent}  "), text);
            }
        }
        serde_json::Value::Array(list) => {
            if let Some(first) = list.first() {
                keys(first, &format!("{indent}- "), text);
            }
        }
        _ => {}
    }
}
