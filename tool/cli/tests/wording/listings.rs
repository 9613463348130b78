//! Output of the commands about a machine: full tables, and the heads of CSV and JSON of all commands.

use super::{Desk, compare};

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
    let commands = machines.map(|machine| format!("check {machine}"));
    compare("check", &desk.runs(&commands.join("\n")));
}

#[test]
fn reduce() {
    let desk = Desk::new().with_machines(&[
        "press.toml",
        "linear-gripper.toml",
        "cam-translating.toml",
        "pick-and-place.toml",
    ]);
    let commands = "
        reduce press.toml --positions 4
        reduce press.toml --positions 4 --over time
        reduce press.toml --positions 4 --links
        reduce press.toml --positions 4 --points
        reduce press.toml --positions 4 --reactions
        reduce press.toml --positions 4 --energy --speed '60 rpm'
        reduce press.toml --at '30 deg, 60 rpm, 5 rad/s^2, 200 deg, 300 deg, 30 rpm'
        reduce pick-and-place.toml --positions 3
        reduce pick-and-place.toml --positions 7 --over time
        reduce pick-and-place.toml --positions 2 --format csv
        check pick-and-place.toml
        reduce linear-gripper.toml --positions 3
        reduce cam-translating.toml --positions 3 --reactions --speed '600 rpm'
    ";
    compare("reduce", &desk.runs(commands));
}

#[test]
fn rules() {
    let desk = Desk::new();
    let commands = "
        rules
        rules general
        rules fanuc
        rules safety-factor-2
    ";
    compare("rules", &desk.runs(commands));
}

#[test]
fn split() {
    let desk = Desk::new();
    let commands = "
        split --ratio 30 --stages 2 --pinion '0.2 kg cm^2' --points 4
        split --ratio 30 --stages 3 --pinion '0.2 kg cm^2' --driven '2 kg cm^2' --load '0.01 kg m^2' --points 3
        split --ratio 30 --stages 2 --pinion '0.2 kg cm^2' --max-ratio 5
        split --ratio 30 --stages 2 --pinion '0.2 kg cm^2' --min-ratio 8
        split --ratio 30 --stages 2 --pinion '0.2 kg cm^2' --min-ratio -8
        split --ratio 30 --stages 3 --pinion '1 kg cm^2' --pinion '2 kg cm^2'
    ";
    compare("split", &desk.runs(commands));
}

#[test]
fn drive() {
    let desk = press();
    let commands = "
        drive press.toml --drive sgm7a-25a+tp004mf-4 --counts-per-turn 16777216 --bandwidth '40 Hz'
        drive press.toml --drive sgm7a-25a+tp004mf-4 --maker sigma-7 --bandwidth '5 kHz'
        drive press.toml --drive nothing
        drive press.toml --maker nobody
    ";
    compare("drive", &desk.runs(commands));
}

#[test]
fn export() {
    let desk = Desk::new().with_machines(&["press.toml", "shaking-feeder.toml"]);
    let commands = "
        export press.toml --torque-error '0.5 N m'
        export press.toml --torque-error '0.5 N m' --type i32 --reciprocal yes
        export press.toml --max-bytes 1000 --type i16 --out table.bin
        export press.toml --torque-error '0.5 N m' --max-cells 60
        export press.toml --torque-error '0.02 N m' --type i16
        export press.toml --torque-error '0.5 N m' --pieces auto
        export press.toml --torque-error '0.02 N m' --pieces auto --max-cells 20
        export press.toml --torque-error '0.5 N m' --max-bytes 200
        export press.toml --max-bytes 20
        export press.toml --torque-error '0.5 N m' --layout slider-crank
        export shaking-feeder.toml --torque-error '0.5 N m'
    ";
    compare("export", &desk.runs(commands));
}

/// The first lines of CSV, and the keys of JSON.
#[test]
fn csv_and_json() {
    let desk = Desk::new().with_machines(&["press.toml", "variator-press.toml"]);
    let sized = "--catalogue drives --steps 64";
    let mut text = String::new();
    for (command, more) in [
        ("reduce press.toml", ""),
        ("check press.toml", ""),
        ("size press.toml --explain", sized),
        ("ratio press.toml", sized),
        ("bus press.toml", sized),
        ("sensitivity press.toml", sized),
        ("simulate press.toml", ""),
        ("rules general", ""),
        ("split --ratio 30 --stages 2 --pinion '1 kg cm^2'", ""),
    ] {
        for format in ["csv", "json"] {
            let out = desk.run(format!("{command} --format {format} {more}").trim_end());
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
