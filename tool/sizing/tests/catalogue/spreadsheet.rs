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

/// One motor in the units and with the decimal sign of several makers: 8.5 kg cm², 8 N m, 2000 rpm.
#[test]
fn headers_and_numbers_as_makers_print_them() {
    let folder = Folder::new();
    let inertias = [
        ("[kg cm^2]", "8.5"),
        ("[kgcm²]", "8.5"),
        ("[kg.cm2]", "8.5"),
        ("(kgcm²)", "8.5"),
        ("[10^-4 kg m^2]", "8.5"),
        ("[10⁻⁴ kg·m²]", "8.5"),
        ("[x10-4 kgm2]", "8.5"),
        ("(×10⁻⁴ kg·m²)", "8.5"),
        ("[kgm² x10^-4]", "8.5"),
        // 1 lb·in·s² = 0.45359237·9.80665·0.0254 kg·m², 1 oz·in² = 0.45359237/16·0.0254² kg·m².
        ("[lb in s^2]", "0.0075231338"),
        ("[lb-in-s²]", "0.0075231338"),
        ("[oz-in-s²]", "0.12037014"),
        ("[oz in^2]", "46.4735378"),
    ];
    let torques = [
        ("[N.m]", "8"),
        ("[Nm]", "8"),
        ("[N-m]", "8"),
        ("[lb-in]", "70.805966"),
        ("[lb in]", "70.805966"),
        ("[in-lb]", "70.805966"),
        ("[oz in]", "1132.8955"),
    ];
    let speeds = [
        "[1/min]",
        "[min^-1]",
        "[min⁻¹]",
        "[min-1]",
        "[r/min]",
        "[rpm]",
    ];
    for (k, (inertia, j)) in inertias.iter().enumerate() {
        let (torque, t) = torques[k % torques.len()];
        let speed = speeds[k % speeds.len()];
        for separator in [",", ";", "\t"] {
            let comma = |number: &str| {
                if separator == "," {
                    number.to_owned()
                } else {
                    number.replace('.', ",")
                }
            };
            let header = [
                "key",
                "maker",
                "model",
                &format!("rated_torque {torque}"),
                &format!("rated_speed {speed}"),
                "peak_torque [N m]",
                &format!("rotor_inertia {inertia}"),
                "source",
            ]
            .join(separator);
            let row = [
                "m1",
                "M",
                "X",
                &comma(t),
                "2000",
                &comma("36.5"),
                &comma(j),
                "S",
            ]
            .join(separator);
            let file = folder.file("m.csv", format!("{header}\n{row}\n"));
            let read = Catalogue::load(Some(&file), None);
            let motor = read.map_err(|e| format!("{header}: {e:?}")).unwrap().motors[0].clone();
            let near = |found: f64, due: f64| {
                assert!((found / due - 1.0).abs() < 1e-7, "{header} {row}: {found}")
            };
            near(motor.rotor_inertia, 8.5e-4);
            near(motor.rated_torque.unwrap(), 8.0);
            near(
                motor.rated_speed.unwrap(),
                2000.0 * std::f64::consts::PI / 30.0,
            );
            near(motor.peak_torque.unwrap(), 36.5);
        }
    }
}

/// A comma that separates cells is no decimal sign; a temperature in °F has another zero.
#[test]
fn a_decimal_comma_between_commas_is_refused_with_its_cure() {
    let folder = Folder::new();
    let fault = |text: String| {
        let file = folder.file("m.csv", text);
        format!("{:?}", Catalogue::load(Some(&file), None).unwrap_err())
    };
    let quoted = fault(format!("{HEADER}\nm1,M,X,8,2000,36,\"8,5\",S\n"));
    assert!(quoted.contains("\\\"8.5\\\""), "{quoted}");
    let bare = fault(format!("{HEADER}\nm1,M,X,8,2000,36,8,5,S\n"));
    assert!(bare.contains("decimals have a point"), "{bare}");
    let thousands = fault(semicolons(HEADER) + "\nm1;M;X;8;2.000,5;36;8,5;S\n");
    assert!(
        thousands.contains("no separator for thousands"),
        "{thousands}"
    );
    let header = format!("{HEADER},max_winding_temperature [degF]");
    let file = folder.file("m.csv", format!("{header}\nm1,M,X,8,2000,36,8.5,S,311\n"));
    let motors = Catalogue::load(Some(&file), None).unwrap().motors;
    let hottest = motors[0].thermal.max_temperature.unwrap();
    assert!((hottest - 155.0).abs() < 1e-12, "{hottest}");
}
