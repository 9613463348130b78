//! All faults are reported at once: those of a row, and duplicate keys next to broken rows. Also duplicate file names and files that are not a
//! catalogue.

use super::{refuses, size_with};
use crate::support::catalogue::{FIRST, HEADER, SECOND};
use crate::support::{Folder, jred, jred_of, press_file, shipped};

const GEARBOX: &str = "key,maker,model,ratio,rated_output_torque [N m],peak_output_torque [N m],max_input_speed [rpm],\
                       input_inertia [kg cm^2],efficiency [%],source\n";

#[test]
fn every_fault_of_a_row() {
    let folder = Folder::new();
    let file = folder.file(
        "g.csv",
        format!("{GEARBOX}g1,M,G,three,50,60,6000,-1,120,S\n"),
    );
    let run = jred_of("size {} --gearboxes {} --steps 16", [&press_file(), &file]).ends(2);
    run.says(&[
        "1 row of the catalogue cannot be used, for 3 faults",
        "ratio of \"g1\" is \"three\"",
        "input_inertia of \"g1\" is \"-1\"",
        "efficiency of \"g1\" is above 1",
    ]);
    for column in [8, 25, 28] {
        let place = format!("g.csv:2:{column}]");
        assert!(
            run.message().contains(&place),
            "{place} is not in {}",
            run.err
        );
    }
    // Checks across two cells run as soon as each can be read.
    let file = folder.file(
        "g.csv",
        format!("{GEARBOX}g1,M,G,3,50,40,6000,1,97,S\ng2,M,G,0,50,40,6000,1,97,S\n"),
    );
    let run = jred_of("size {} --gearboxes {} --steps 16", [&press_file(), &file]).ends(2);
    run.says(&[
        "2 rows of the catalogue cannot be used",
        "peak_output_torque of \"g1\" is below",
        "ratio of \"g2\"",
    ]);
    assert!(
        !run.message().contains("peak_output_torque of \"g2\""),
        "{}",
        run.err
    );
    // In TOML keys and units come first; the duplicate key is still reported.
    let toml = "[[gearbox]]\nkey = \"g1\"\nmaker = \"M\"\nmodel = \"G\"\nratios = 3\nrated_output_torque = \"50 kg\"\n\
                max_input_speed = 6000\n";
    let folder = Folder::new();
    folder.file("list.toml", format!("{toml}{toml}"));
    let run = jred_of(
        "size {} --catalogue {} --steps 16",
        [&press_file(), &folder.path("")],
    );
    run.ends(2).says(&[
        "2 rows of the catalogue cannot be used, for 7 faults",
        "unknown key \"ratios\"",
        "`rated_output_torque` in [[gearbox]] number 1 must be a torque, but \"kg\" is a mass",
        "`max_input_speed` in [[gearbox]] number 1 has no unit: 6000",
        "duplicate key \"g1\"",
    ]);
    // A motor: words and figures.
    refuses(
        &format!("{HEADER}\nm1,,Model,eight,2000,36,-8.5,\n"),
        None,
        &[
            "for 4 faults",
            "maker of",
            "rated_torque of",
            "rotor_inertia of",
            "source of",
        ],
    );
}

#[test]
fn keys_that_clash_are_found_beside_broken_rows() {
    let again = SECOND.replace("m2", "m1");
    let broken = FIRST.replace("m1", "m3").replace("8.5", "x");
    refuses(
        &format!("{HEADER}\n{FIRST}\n{broken}\n{again}\n{broken}\n"),
        None,
        &[
            "3 rows of the catalogue cannot be used, for 4 faults",
            "rotor_inertia of \"m3\" is \"x\"",
            "duplicate key \"m1\"",
            "duplicate key \"m3\"",
        ],
    );
    // A skipped broken row does not reserve its key: its corrected copy is used.
    let mended = FIRST.replace("m1", "m3");
    let folder = Folder::new();
    let file = folder.file("m.csv", format!("{HEADER}\n{broken}\n{mended}\n"));
    let run = jred_of(
        "size {} --motors {} --skip-broken-rows --steps 16",
        [&press_file(), &file],
    );
    assert!(
        run.message()
            .contains("1 broken row of the catalogue skipped"),
        "{}",
        run.err
    );
    assert!(run.out.contains("m3"), "{}", run.out);
}

#[test]
fn given_twice() {
    let folder = Folder::new();
    let file = folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    let (plain, around) = (
        folder.path(""),
        folder
            .path("../")
            .join(folder.path("").file_name().unwrap()),
    );
    let size = |a: &std::path::Path, b: &std::path::Path| {
        jred_of(
            "size {} --steps 16 --catalogue {} --catalogue {}",
            [&press_file(), &a, &b],
        )
    };
    for (a, b) in [
        (&plain, &plain),
        (&plain, &around),
        (&plain, &file),
        (&file, &plain),
    ] {
        let run = size(a, b).ends(2);
        run.says(&["is given twice", "name every folder and every file once"]);
        assert!(!run.message().contains("duplicate key"), "{}", run.err);
    }
    let built_in = std::path::Path::new("built-in");
    size(built_in, built_in)
        .ends(2)
        .says(&["built-in is given twice"]);
    // A copy is another file, so its keys are duplicates.
    let copy = Folder::new();
    copy.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    size(&plain, &copy.path(""))
        .ends(2)
        .says(&["duplicate key \"m1\": in", "and in"]);
}

#[test]
fn a_folder_of_machines_is_no_catalogue() {
    let machines = shipped("");
    for path in [machines.as_path(), &press_file()] {
        let run = jred([&"size", &press_file(), &"--catalogue", &path]).ends(2);
        run.says(&[
            "this is a machine file, not a catalogue",
            "a machine has a [mechanism]",
            "motors and gearboxes",
        ]);
    }
}

#[test]
fn paths_that_lead_nowhere() {
    let folder = Folder::new();
    let file = folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    let near = folder.path("motor.csv");
    let run = |option: &str, path: &std::path::Path| {
        let run = jred([&"size", &press_file(), &option, &path]).ends(2);
        assert!(!run.message().contains("os error"), "{}", run.err);
        run
    };
    for option in ["--catalogue", "--motors", "--gearboxes"] {
        let run = run(option, &near);
        let name = file.file_name().unwrap().to_str().unwrap();
        run.says(&[
            "cannot read the catalogue",
            "no such file or folder",
            "did you mean",
            name,
        ]);
    }
    run("--motors", &folder.path("")).says(&["it is a folder", "a single CSV file with --motors"]);
    run("--catalogue", &folder.path("away/far.csv")).says(&["no such file or folder"]);
    assert!(size_with(format!("{HEADER}\n{FIRST}\n")).code < 2);
}
