//! Tables as spreadsheets write them, and the units of their headers.

use jred_sizing::catalogue::Catalogue;

use crate::support::Folder;
use crate::support::catalogue::{FIRST, HEADER};

/// A table with semicolons between its cells.
fn semicolons(table: &str) -> String {
    let mut quoted = false;
    let swap = |c: char| {
        quoted ^= c == '"';
        if c == ',' && !quoted { ';' } else { c }
    };
    table.chars().map(swap).collect()
}

/// Quotes, CRLF, a byte order mark and blanks of spreadsheets are read.
#[test]
fn what_spreadsheets_write_is_read() {
    let folder = Folder::new();
    let load = |text: &str| {
        let file = folder.file("m.csv", text);
        Catalogue::load(Some(&file), None)
            .map_err(|e| format!("{e}: {e:?}"))
            .unwrap()
    };
    let quoted = format!(
        "{HEADER}\nm1,\"Maker, Sons & Co\",\"The \"\"big\"\" one\",\"8\",2000,36,8.5,\"Sheet, page 3\"\n"
    );
    for text in [
        quoted.clone(),
        quoted.replace('\n', "\r\n"),
        format!("\u{feff}{quoted}"),
        quoted.trim_end().to_owned(),
        quoted.replace(",2000,", " , 2000 ,\t"),
        format!("# motors of 2026\n\n{quoted}\n\n"),
        semicolons(&quoted),
        format!(
            "\u{feff}# motors\r\n{}",
            semicolons(&quoted).replace('\n', "\r\n")
        ),
        semicolons(&quoted).replace(';', "\t"),
    ] {
        let motors = load(&text).motors;
        assert_eq!(motors.len(), 1);
        assert_eq!(motors[0].key, "m1");
        assert_eq!(motors[0].maker, "Maker, Sons & Co");
        assert_eq!(motors[0].model, "The \"big\" one");
        assert_eq!(motors[0].rated_torque, Some(8.0));
        assert_eq!(motors[0].source, "Sheet, page 3");
    }
}

#[test]
fn units_of_the_header_are_converted() {
    let folder = Folder::new();
    let motor = |header: &str, row: &str| {
        let file = folder.file("m.csv", format!("{header}\n{row}\n"));
        Catalogue::load(Some(&file), None).unwrap().motors[0].clone()
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-15 * b, "{a} and {b}");
    let plain = motor(HEADER, FIRST);
    near(plain.rated_torque.unwrap(), 8.0);
    near(
        plain.rated_speed.unwrap(),
        2000.0 * 2.0 * std::f64::consts::PI / 60.0,
    );
    near(plain.rotor_inertia, 8.5e-4);
    let header = "source,rotor_inertia [g cm^2],peak_torque [mN m],max_speed [rad/s],rated_speed [rad/s],rated_torque [Nm],model,maker,key,mass [g]";
    let other = motor(header, "Sheet,8500,36000,300,209.5,8,Model,Maker,m1,7500");
    near(other.rotor_inertia, 8500.0 * 1e-3 * 1e-4);
    near(other.peak_torque.unwrap(), 36.0);
    near(other.max_speed.unwrap(), 300.0);
    near(other.rated_speed.unwrap(), 209.5);
    near(other.mass.unwrap(), 7.5);
    let header = HEADER.replace("kg cm^2", "kg m^2");
    near(motor(&header, FIRST).rotor_inertia, 8.5);
    // Efficiency in per cent or as a share.
    let gearbox = |header: &str, cell: &str| {
        let text = format!(
            "key,maker,model,ratio,peak_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],{header},source\n\
             g,M,M,3,80,7000,1,{cell},S\n"
        );
        let file = folder.file("g.csv", text);
        Catalogue::load(None, Some(&file))
    };
    near(
        gearbox("efficiency [%]", "97").unwrap().gearboxes[0].efficiency,
        0.97,
    );
    near(
        gearbox("efficiency", "0.97").unwrap().gearboxes[0].efficiency,
        0.97,
    );
    let error = gearbox("efficiency", "97").unwrap_err().to_string();
    assert!(error.contains("efficiency of \"g\" is above 1"), "{error}");
}
