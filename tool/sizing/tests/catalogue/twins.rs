//! One part in two rows of a catalogue, and the terms for a fault in each format.

use jred_sizing::catalogue::Catalogue;

use crate::support::catalogue::HEADER;
use crate::support::rows;

/// The two rows of one gearbox that were once in the built-in catalogue: figures of one document for two clamping hubs.
const TP050: &str = "\
key,maker,model,ratio,rated_output_torque [N m],peak_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],stiffness [N m/arcmin],source
tp050ma-38p5,Beckhoff,AG2400 TP050 MA i=38.5,38.5,638,992,6250,3,94,,S
tp050ma-38.5,Beckhoff,AG2400 TP050-MA I=38p5,38.5,638,992,6250,9.9,94,220,S
tp050ma-55,Beckhoff,AG2400 TP050 MA i=55,55,717,992,6250,9.7,94,220,S
";

fn warnings(gearboxes: &str, motors: &str) -> Vec<String> {
    let motors = format!("{HEADER}\n{motors}");
    let files = [
        ("motors.csv", motors.as_str()),
        ("gearboxes.csv", gearboxes),
    ];
    Catalogue::of_texts(files, false).unwrap().warnings
}

const MOTOR: &str = "m1,Maker,Model 1,8,2000,36,8.5,Sheet\n";

#[test]
fn one_part_in_two_rows() {
    let found = warnings(TP050, MOTOR);
    assert_eq!(found.len(), 1, "{found:?}");
    for words in [
        "gearboxes.csv:3: \"tp050ma-38.5\" and \"tp050ma-38p5\" (gearboxes.csv:2) are the same gearbox",
        "their data differ: input_inertia, stiffness",
        "remove one row",
    ] {
        assert!(
            found[0].contains(words),
            "{words:?} is not in\n{}",
            found[0]
        );
    }
    // The same data under two keys do not contradict each other; a model may be a series of ratios.
    let same = TP050.replace("6250,3,94,,S", "6250,9.9,94,220,S");
    assert_eq!(warnings(&same, MOTOR), [""; 0]);
    let series = TP050.replace("38p5,38.5,", "38p5,40,");
    assert_eq!(warnings(&series, MOTOR), [""; 0]);
    // Motors as well, with any spelling of their names.
    let motors = format!(
        "{MOTOR}m2,MAKER,model-1,8.5,2000,36,8.5,Sheet\nm3,Other,Model 1,9,2000,36,8.5,Sheet\n"
    );
    let header = TP050.split_inclusive('\n').next().unwrap();
    let found = warnings(
        &(header.to_owned() + "g,G,G,3,50,90,6000,1,97,,S\n"),
        &motors,
    );
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].contains("motors.csv:3") && found[0].contains("differ: rated_torque."),
        "{found:?}"
    );
}

/// The built-in catalogue: gearboxes, motors and resistors.
#[test]
fn no_part_is_in_the_built_in_catalogue_twice() {
    assert_eq!(super::built_in().warnings, [""; 0]);
    let gearboxes = super::built_in().gearboxes;
    assert_eq!(gearboxes.len(), 111);
    // All ratios of a series have the inertia of the same clamping hub; the smaller hub of 24 mm would give 3.8 and 3 kg cm^2.
    let inertia = |key: &str| gearboxes.iter().find(|g| g.key == key).unwrap().inertia;
    for (key, expected) in [
        ("tp050ma-22", 10.7e-4),
        ("tp050ma-27.5", 10.3e-4),
        ("tp050ma-38.5", 9.9e-4),
    ] {
        assert!((inertia(key) - expected).abs() < 1e-9, "{key}");
    }
}

/// The cure of a fault uses the terms of the file: cells and a header, or keys and tables.
#[test]
fn each_form_has_its_own_words() {
    let toml = "[[motor]]\nkey = \"m\"\nmaker = \"M\"\nmodel = \"1\"\nrated_torque = \"1 N m\"\nrated_speed = \"3000 rpm\"\npeak_torque = \"3 N m\"\nrotor_inertia = \"1 kg cm^2\"\nsource = \"S\"\n";
    let read = |name: &str, text: &str| {
        let error = Catalogue::of_texts([(name, text)], false).unwrap_err();
        format!("{:?}", miette::Report::new(error))
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let cases = r#"
        rated_speed => rated_sped => unknown key "rated_sped"
        source = "S" => => source of "m" is not given
        source = "S" => => add source, or remove the table
        "3 N m" => "0 N m" => remove the key if the data sheet gives no value
        "3 N m" => "0.5 N m" => against the data sheet, and their units
    "#;
    for [from, to, words] in rows(cases) {
        assert!(toml.contains(&from));
        let said = read("own.toml", &toml.replace(&from, &to));
        assert!(said.contains(&words), "{words:?} is not in\n{said}");
        for foreign in ["header", "column", "cell"] {
            assert!(!said.contains(foreign), "{foreign:?} is in\n{said}");
        }
    }
    let empty = read("own.toml", "# nothing\n");
    assert!(
        empty.contains("add at least one table such as [[motor]]") && !empty.contains("header"),
        "{empty}"
    );
    let csv = read("motors.csv", &format!("{HEADER}\n"));
    assert!(csv.contains("add motors: rows of a file"), "{csv}");
}
