//! Output of the commands that judge drives: size, ratio, bus, vary, sensitivity, tolerance.

use super::listings::{press, sized};
use super::{Desk, compare};

/// The press with ninety times the load.
fn heavy() -> Desk {
    let text = Desk::machine("press.toml").replacen("\"-10 kN\"", "\"-900 kN\"", 1);
    Desk::new().with("heavy.toml", text)
}

#[test]
fn size() {
    let press = press();
    let size = |more: &[&str]| press.run(&sized(&[&["size", "press.toml"], more].concat()));
    compare("size-screen", &size(&[]));
    compare("size", &size(&["--full"]));
    compare("size-explain", &size(&["--explain", "--nearest", "1"]));
    compare("size-motion", &size(&["--motion", "best", "--top", "3"]));
    compare("size-all", &size(&["--all"]));
    compare(
        "size-drive",
        &[
            size(&["--drive", "sgmsh-30a+npt025mf-5"]),
            size(&["--drive", "sgmsh-15a"]),
            size(&["--drive", "sgmsh-15+npt025mf-5"]),
            size(&["--drive", "sgmsh-15a", "--rank", "mass"]),
        ]
        .join("\n"),
    );
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

/// Linear motors: force instead of torque, mass instead of inertia.
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
            &[&size[..], &["--full"]].concat(),
            &[&size[..], &["--explain", "--why", "slide"]].concat(),
        ]),
    );
}

/// Winding data, thermal resistances and an amplifier: for the rules that small catalogues leave unchecked.
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

/// Motors and amplifiers of several voltages with and without a mains voltage.
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
            &sized(&["size", "400.toml", "--refused", "--full"]),
            &sized(&["size", "200.toml", "--top", "9"]),
            &sized(&["size", "none.toml", "--top", "1"]),
            &sized(&["size", "400.toml", "--why", "unknown+npt025mf-5"]),
            &sized(&["size", "400.toml", "--why", "class200+npt025mf-5"]),
            &sized(&["ratio", "400.toml", "--motor", "class*"]),
            &[&["size", "400.toml", "--refused", "--full"], &own[..]].concat(),
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
