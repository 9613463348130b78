//! What each command prints: tables as a whole, the heads of CSV and JSON.

use super::{Desk, compare};

const CATALOGUE: [&str; 3] = ["--catalogue", "drives", "--steps"];

/// `jred` with the small catalogue and few time steps.
fn sized<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    let mut all = arguments.to_vec();
    all.extend(CATALOGUE);
    all.push("64");
    all
}

fn press() -> Desk {
    Desk::new().with_machines(&["press.toml"])
}

/// The press with ninety times the load.
fn heavy() -> Desk {
    let text = Desk::machine("press.toml").replacen("\"-10 kN\"", "\"-900 kN\"", 1);
    Desk::new().with("heavy.toml", text)
}

#[test]
fn size() {
    let press = press();
    let size = |more: &[&str]| press.run(&sized(&[&["size", "press.toml"], more].concat()));
    compare("size", &size(&[]));
    compare("size-explain", &size(&["--explain", "--nearest", "1"]));
    compare("size-motion", &size(&["--motion", "best", "--top", "3"]));
    compare("size-all", &size(&["--all"]));
    compare(
        "size-why",
        &[
            size(&["--why", "sgmsh-30a+npt025mf-5"]),
            size(&["--why", "sgmsh-15a"]),
            size(&["--why", "sgmsh-15a+npt035mf-10"]),
        ]
        .join("\n"),
    );
    compare(
        "size-ranked",
        &[
            size(&["--rank", "mass", "--max-mass", "3 kg"]),
            size(&["--pareto", "power,energy"]),
            size(&["--pareto", "mass,energy"]),
            size(&["--motor", "none*"]),
            size(&["--ratio", "500..600"]),
        ]
        .join("\n"),
    );
    let heavy = heavy();
    compare(
        "size-refused",
        &heavy.runs(&[
            &sized(&["size", "heavy.toml"]),
            &sized(&[
                "size",
                "heavy.toml",
                "--refused",
                "--explain",
                "--nearest",
                "1",
            ]),
        ]),
    );
}

/// Linear motors: force for torque, mass for inertia.
#[test]
fn size_linear() {
    let motors = "key,kind,maker,model,rated_force [N],rated_speed [m/s],peak_force [N],max_speed [m/s],moving_mass [kg],\
                  torque_constant [N/A rms],source\n\
                  slide,linear,Maker,Slide,140,3,450,4,1.8,60,Sheet\n";
    let desk = Desk::new()
        .with_machines(&["linear-gripper.toml"])
        .with("linear.csv", motors);
    let size = ["size", "linear-gripper.toml", "--motors", "linear.csv"];
    compare(
        "size-linear",
        &desk.runs(&[
            &size,
            &[&size[..], &["--explain", "--why", "slide"]].concat(),
        ]),
    );
}

/// Winding data, thermal resistances and an amplifier: the rules that small catalogues leave open.
#[test]
fn size_with_every_figure() {
    let motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],max_speed [rpm],rotor_inertia [kg cm^2],\
                  torque_constant [N m/A rms],voltage_constant [V s/rad],winding_resistance [Ohm],winding_inductance [mH],\
                  pole_pairs,rated_current [A rms],peak_current [A rms],thermal_resistance_winding [K/W],\
                  thermal_resistance_housing [K/W],thermal_time_winding [s],thermal_time_housing [s],\
                  max_winding_temperature [C],bus_voltage [V],source\n\
                  m1,Maker,One,8,3000,30,4500,8.5,1.1,0.64,0.9,6.5,4,8,30,0.3,0.4,60,2100,155,560,Sheet\n";
    let amplifiers = "key,maker,model,rated_current [A rms],peak_current [A rms],peak_time [s],capacitance [uF],\
                      chopper_voltage [V],max_voltage [V],min_resistance [Ohm],source\n\
                      a1,Maker,Drive,10,32,3,470,760,820,22,Sheet\n";
    let supply = "\n[supply]\nmains_voltage = \"400 V\"\n";
    let desk = Desk::new()
        .with("drives/motors.csv", motors)
        .with("drives/amplifiers.csv", amplifiers)
        .with("press.toml", Desk::machine("press.toml") + supply);
    compare(
        "size-amplifier",
        &desk.run(&sized(&[
            "size",
            "press.toml",
            "--why",
            "m1+npt025mf-5 on a1",
        ])),
    );
}

/// Motors and amplifiers of several voltages on one mains, and on none.
#[test]
fn size_by_voltage() {
    let motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],max_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],rated_current [A rms],\
                  mains_voltage [V],bus_voltage [V],max_bus_voltage [V],figures_from,source\n\
                  low,Maker,48 V,9.8,3000,5000,29.4,7,18.8,,48,,maker,Sheet\n\
                  class200,Maker,200 V,9.8,3000,5000,29.4,7,18.8,200,,,maker,Sheet\n\
                  insulated,Maker,800 V,9.8,3000,5000,29.4,7,18.8,,320,800,maker,Sheet\n\
                  class400,Maker,400 V,12,3000,5000,36,9,18.8,400,,,maker,Sheet\n\
                  elsewhere,Maker,other,9.8,3000,5000,29.4,7,18.8,400,,,other,Sheet\n\
                  unknown,Maker,unknown,9.8,3000,5000,29.4,7,18.8,,,,maker,Sheet\n";
    let amplifiers = "key,maker,model,rated_current [A rms],peak_current [A rms],mains_voltage [V],source\n\
                      a230,Maker,Drive 230,20,60,230,Sheet\n\
                      a400,Maker,Drive 400,20,60,400,Sheet\n";
    let press = Desk::machine("press.toml");
    let at = |volts: &str| format!("{press}\n[supply]\nmains_voltage = \"{volts} V\"\n");
    let desk = Desk::new();
    let gearboxes = std::fs::read_to_string(desk.0.path("drives/gearboxes.csv")).unwrap();
    std::fs::create_dir(desk.0.path("own")).unwrap();
    let desk = desk
        .with("drives/motors.csv", motors)
        .with("own/motors.csv", motors)
        .with("own/amplifiers.csv", amplifiers)
        .with("own/gearboxes.csv", gearboxes)
        .with("none.toml", &press)
        .with("200.toml", at("200"))
        .with("400.toml", at("400"));
    let own = [
        "--catalogue",
        "own",
        "--gearbox",
        "npt025mf-5",
        "--steps",
        "64",
    ];
    compare(
        "size-voltage",
        &desk.runs(&[
            &sized(&["size", "400.toml", "--refused"]),
            &sized(&["size", "200.toml", "--top", "9"]),
            &sized(&["size", "none.toml", "--top", "1"]),
            &sized(&["size", "400.toml", "--why", "unknown+npt025mf-5"]),
            &sized(&["size", "400.toml", "--why", "class200+npt025mf-5"]),
            &sized(&["ratio", "400.toml", "--motor", "class*"]),
            &[&["size", "400.toml", "--refused"], &own[..]].concat(),
            &[&["size", "none.toml", "--top", "9"], &own[..]].concat(),
        ]),
    );
}

#[test]
fn ratio() {
    let press = press();
    compare(
        "ratio",
        &[
            press.run(&sized(&["ratio", "press.toml"])),
            press.run(&sized(&[
                "ratio",
                "press.toml",
                "--efficiency",
                "0.9",
                "--top",
                "1",
            ])),
            heavy().run(&sized(&["ratio", "heavy.toml"])),
        ]
        .join("\n"),
    );
}

#[test]
fn bus() {
    let supply = "\n[supply]\nmains_voltage = \"230 V\"\ncapacitance = \"2600 uF\"\nchopper_voltage = \"380 V\"\n\
                  max_voltage = \"410 V\"\n";
    let text = Desk::machine("press.toml");
    let desk = Desk::new()
        .with("press.toml", text.clone())
        .with("powered.toml", text.clone() + supply)
        .with("slow.toml", text.replacen("\"0.1 s\"", "\"0.2 s\"", 1));
    let bus = |files: &[&str]| desk.run(&sized(&[&["bus"], files].concat()));
    compare(
        "bus",
        &[
            bus(&["press.toml"]),
            bus(&["powered.toml", "slow.toml"]),
            bus(&["powered.toml", "press.toml", "--in-step"]),
            bus(&["powered.toml", "--drive", "1=sgmsh-30a+npt025mf-5"]),
        ]
        .join("\n"),
    );
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

#[test]
fn vary() {
    let desk = press();
    let vary = ["vary", "press.toml", "--vary", "slider.mass=40..400kg:3"];
    let with = |more: &[&'static str]| sized(&[&vary[..], more].concat());
    compare(
        "vary",
        &desk.runs(&[
            &with(&[]),
            &with(&["--format", "csv"]),
            &with(&["--vary", "pressing force.force.1=-10,-900kN"]),
            &with(&["--out", "a.csv", "--format", "csv", "--shard", "0/2"]),
            &with(&["--out", "b.csv", "--format", "csv", "--shard", "1/2"]),
            &["merge", "all.csv", "a.csv", "b.csv"],
            &["merge", "more.csv", "a.csv"],
            &["merge", "more.csv", "a.csv", "a.csv"],
            &["merge", "a.csv", "a.csv", "b.csv"],
            &["merge", "all.csv", "a.csv", "b.csv"],
            &["merge", "more.csv", "press.toml"],
            &with(&["--out", "a.csv", "--format", "csv"]),
            &with(&[
                "--out", "a.csv", "--format", "csv", "--resume", "--rank", "mass",
            ]),
            &with(&["--out", "a.csv", "--format", "csv", "--resume"]),
        ]),
    );
}

#[test]
fn sensitivity_and_tolerance() {
    let desk = press();
    compare(
        "sensitivity",
        &[
            desk.run(&sized(&["sensitivity", "press.toml"])),
            desk.run(&sized(&[
                "sensitivity",
                "press.toml",
                "--drive",
                "sgmsh-15a",
            ])),
        ]
        .join("\n"),
    );
    let tolerance = ["tolerance", "press.toml", "--samples", "100"];
    let with = |more: &[&'static str]| sized(&[&tolerance[..], more].concat());
    compare(
        "tolerance",
        &desk.runs(&[
            &with(&["--tolerance", "slider.mass=5%"]),
            &with(&[
                "--tolerance",
                "crank.length=normal:2%",
                "--tolerance",
                "segment.1.duration=10%",
            ]),
            &with(&[]),
            &with(&["--tolerance", "slider.mass"]),
            &with(&["--tolerance", "slider.mas=5%"]),
            &with(&["--tolerance", "slider.mass=5mm"]),
        ]),
    );
}

/// The first lines of CSV, and of JSON the keys.
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

/// The keys of objects in their order; of a list those of its first entry.
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
