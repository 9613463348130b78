//! Messages about faults in catalogues.

use std::fmt::Write as _;

use super::{Desk, compare};

const HEADER: &str = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source";
const ROW: &str = "m1,Maker,Model,8,2000,36,8.5,Sheet";
const GEAR_HEADER: &str = "key,maker,model,ratio,rated_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source";
const GEAR: &str = "g1,Maker,Gear,5,50,6000,1,97,Sheet";

/// A message for each catalogue, given as files.
fn faults(name: &str, catalogues: &[&[(&str, String)]]) {
    let mut text = String::new();
    for files in catalogues {
        let mut desk = Desk::new().with_machines(&["press.toml"]);
        std::fs::create_dir(desk.0.path("own")).unwrap();
        for (file, contents) in *files {
            desk = desk.with(&format!("own/{file}"), contents);
            writeln!(text, "{file}:\n{}", contents.trim_end()).unwrap();
        }
        let message = desk.run("size press.toml --catalogue own --steps 16 --top 0");
        // The message without the listing, where the catalogue can be used.
        let said = message
            .split_once("--- stderr\n")
            .map_or("nothing\n", |(_, said)| said);
        writeln!(text, "{said}").unwrap();
    }
    compare(name, &text);
}

#[test]
fn headers_and_rows() {
    let motors = |header: String, row: &str| [("motors.csv", format!("{header}\n{row}\n"))];
    let header = |from: &str, to: &str| motors(HEADER.replacen(from, to, 1), ROW);
    let row = |from: &str, to: &str| motors(HEADER.to_owned(), &ROW.replacen(from, to, 1));
    faults(
        "catalogue-rows",
        &[
            &[("motors.csv", String::new())],
            &motors(HEADER.to_owned(), ""),
            &header("rated_torque", "rated_torqe"),
            &header("rated_torque [N m]", "rated_torque [kg m^2]"),
            &header("rated_speed [rpm]", "rated_speed"),
            &header("rated_speed [rpm]", "ratio"),
            &header(",rotor_inertia [kg cm^2]", ""),
            &header("peak_torque [N m]", "rated_torque [mN m]"),
            &row("8,", "eight,"),
            &row("8,", "-8,"),
            &row("8,", ","),
            &row("36,", "3,"),
            &row("Maker", ""),
            &row(",36", ""),
            &motors(HEADER.to_owned(), &format!("{ROW}\n{ROW}")),
            &motors(HEADER.to_owned(), &format!("{ROW}\n{HEADER}")),
            &motors(
                HEADER.to_owned(),
                &format!(
                    "{ROW}\n{}",
                    "m2,Maker,Model,-8,2000,36,8.5,Sheet\n".repeat(12)
                ),
            ),
            &motors(format!("{HEADER},kind"), &format!("{ROW},linear")),
            &motors(
                format!("{HEADER},peak_curve"),
                &format!("{ROW},0 rpm: 36 N m; 10 m/s: 3 N m"),
            ),
            &motors(
                format!("{HEADER},peak_curve"),
                &format!("{ROW},0 rpm: 36 N m; 1000 rpm"),
            ),
            &motors(
                format!("{HEADER},peak_curve"),
                &format!("{ROW},0 rpm: 36 N m; 1000 rpm: 40 N m"),
            ),
            &motors(format!("{HEADER},commutation"), &format!("{ROW},sinus")),
            &motors(format!("{HEADER},mains_voltage"), &format!("{ROW},400")),
            &motors(
                format!("{HEADER},mains_voltage [V]"),
                &format!("{ROW},4000"),
            ),
            &motors(format!("{HEADER},mains_voltage [V]"), &format!("{ROW},0")),
            &motors(
                format!("{HEADER},bus_voltage [V],max_bus_voltage [V]"),
                &format!("{ROW},560,500"),
            ),
            &motors(
                format!("{HEADER},mains_voltage [V],max_bus_voltage [V]"),
                &format!("{ROW},400,560"),
            ),
        ],
    );
}

#[test]
fn gearboxes_and_lists() {
    let with = |gearboxes: String, more: &[(&'static str, String)]| {
        let mut files = vec![
            ("motors.csv", format!("{HEADER}\n{ROW}\n")),
            ("gearboxes.csv", gearboxes),
        ];
        files.extend_from_slice(more);
        files
    };
    let gear = |from: &str, to: &str| {
        with(
            format!("{GEAR_HEADER}\n{}\n", GEAR.replacen(from, to, 1)),
            &[],
        )
    };
    let list = |rows: &str| {
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[("compatibility.csv", format!("motor,gearboxes\n{rows}\n"))],
        )
    };
    let catalogues = [
        gear("97", "103"),
        gear(",5,", ",0,"),
        gear("50", "5e9"),
        with(format!("{GEAR_HEADER},back_driving\n{GEAR},often\n"), &[]),
        with(
            format!("{GEAR_HEADER},shock_factors\n{GEAR},1000/h: 2; 2000/h: 1\n"),
            &[],
        ),
        list("m1,g7"),
        list("m7,g1"),
        list("m1,g1\nm1,g1"),
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[("drives.csv", format!("{HEADER}\n"))],
        ),
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[("more.toml", "[[motr]]\nkey = \"m2\"\n".to_owned())],
        ),
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[("more.toml", "[motor]\nkey = \"m2\"\n".to_owned())],
        ),
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[(
                "more.toml",
                "[[motor]]\nkey = \"m2\"\nrated_torque = 8\n".to_owned(),
            )],
        ),
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[("more.toml", "[[motor]]\nkey = 2 mm\n".to_owned())],
        ),
        with(
            format!("{GEAR_HEADER}\n{GEAR}\n"),
            &[("more.toml", "[mechanism]\ntype = \"belt\"\n".to_owned())],
        ),
    ];
    let catalogues: Vec<&[(&str, String)]> = catalogues.iter().map(|c| &c[..]).collect();
    faults("catalogue-gearboxes", &catalogues);
}

/// Implausible figures are used, with a warning.
#[test]
fn implausible_figures() {
    let motors = format!(
        "{HEADER},mass [kg],max_speed [rpm],torque_constant [N m/A rms],rated_current [A rms],voltage_constant [V s/rad]\n\
         m1,Maker,Model,8,2000,36,85000,Sheet,5,3000,1,8,0.6\n\
         m2,Maker,Model,8,200000,36,8.5,Sheet,0.01,300000,1,8,0.6\n\
         m3,Maker,Model,8,2000,36,8.5,Sheet,8,3000,1,80,6\n"
    );
    let gearboxes = format!(
        "{GEAR_HEADER},backlash [arcmin],mass [kg],peak_output_torque [N m]\n\
         g1,Maker,Gear,5,50,6000,1,0.97,Sheet,8,4,90\n\
         g2,Maker,Gear,5,50,6000,1,97,Sheet,800,0.01,40\n"
    );
    faults(
        "catalogue-implausible",
        &[&[("motors.csv", motors), ("gearboxes.csv", gearboxes)]],
    );
}
