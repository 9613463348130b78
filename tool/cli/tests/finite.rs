//! No result contains "inf" or "NaN": figures far beyond any drive are refused, with quantity, value and limit.

use std::path::{Path, PathBuf};

use crate::support::{Folder, Run, edited, jred, jred_with, press_file};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name)
}

/// Whether a text has no infinity and no NaN.
fn is_finite(run: &Run) -> bool {
    let mut words = run.out.split(|c: char| !c.is_alphanumeric());
    !words.any(|word| word == "inf" || word == "NaN")
}

/// A motion too fast for any motor to have torque left.
#[test]
#[ignore = "more than five seconds of a processor"]
fn a_ratio_without_end_is_said_in_words() {
    for format in ["table", "csv", "json"] {
        let run = jred([&"ratio", &data("ratio-inf.toml"), &"--format", &format]).ends(1);
        assert!(is_finite(&run), "{}", run.out);
        // In a table the words may be wrapped.
        let words: Vec<&str> = run.out.split_whitespace().collect();
        assert!(
            words.join(" ").contains("nothing of its limit"),
            "{}",
            run.out
        );
    }
}

/// Catalogues with a figure of 1e308 in an otherwise valid row.
#[test]
fn rows_far_beyond_any_drive_are_refused() {
    let press = press_file();
    let press = press.to_str().unwrap();
    for (name, words) in [
        (
            "cat-NAN-3.csv",
            [
                "input_inertia of \"npt035ma-16\" is 1e308 kg cm^2, too large for any gearbox",
                "at most 1e12 kg cm^2",
            ],
        ),
        (
            "cat-NAN-5.csv",
            [
                "stiffness of \"tp010mf-5\" is 1e308 N m/arcmin, too large for any gearbox",
                "at most",
            ],
        ),
    ] {
        let file = data(name);
        let gearboxes = ["size", press, "--gearboxes", file.to_str().unwrap()];
        jred_with(&gearboxes).ends(2).says(&words);
        for format in ["table", "csv", "json"] {
            let more = ["--skip-broken-rows", "--all", "--format", format];
            let run = jred_with(&[&gearboxes[..], &more].concat());
            assert!(is_finite(&run), "{}", run.out);
        }
    }
    let file = data("cat-NAN-1.toml");
    let all = [
        "size",
        press,
        "--catalogue",
        file.to_str().unwrap(),
        "--skip-broken-rows",
        "--all",
    ];
    assert!(is_finite(&jred_with(&all)));
}

/// The same for a ratio, a point of a curve, a motor's figures, and rows of the database.
#[test]
fn every_figure_has_limits() {
    let folder = Folder::new();
    let motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],peak_curve,price [EUR],source\n\
                  m,M,M,20,3000,60,10,0 rpm: 60 N m; 3000 rpm: 60 N m,500,S\n";
    let gearboxes = "key,maker,model,ratio,peak_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source\n\
                     g,M,M,5,500,6000,1,95,S\n";
    for (option, table, from, to, words) in [
        (
            "--motors",
            motors,
            "M,20,",
            "M,1e300,",
            "rated_torque of \"m\" is 1e300 N m, too large for any motor",
        ),
        (
            "--motors",
            motors,
            "M,20,",
            "M,1e-300,",
            "rated_torque of \"m\" is 1e-300 N m, too small for any motor",
        ),
        (
            "--motors",
            motors,
            "3000,60",
            "1e20,60",
            "rated_speed of \"m\" is 1e20 rpm, too large for any motor",
        ),
        (
            "--motors",
            motors,
            "3000 rpm: 60",
            "3000 rpm: 1e99",
            "\"1e99 N m\" is too large for any drive",
        ),
        (
            "--motors",
            motors,
            ",500,S",
            ",1e200,S",
            "price of \"m\" is 1e200, too large for any motor",
        ),
        (
            "--gearboxes",
            gearboxes,
            "M,5,",
            "M,1e200,",
            "ratio of \"g\" is 1e200, too large for any gearbox",
        ),
        (
            "--gearboxes",
            gearboxes,
            "M,5,",
            "M,1e-9,",
            "ratio of \"g\" is 1e-9, too small for any gearbox",
        ),
    ] {
        let file = folder.file("table.csv", edited(table, from, to));
        jred([&"size", &press_file(), &option, &file])
            .ends(2)
            .says(&[words, "is accepted: check the number and its unit"]);
    }
}
