//! Hidden characters, and texts that could be read as code, do no harm.

use std::path::{Path, PathBuf};

use crate::support::{
    Folder, edited_press, jred, jred_of, jred_with, press_file, press_text, typed,
};

/// An input that once did harm.
fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name)
}

/// A line break in a title would end the comment of a C file, and what follows would be compiled.
#[test]
fn a_title_does_not_become_c() {
    let folder = Folder::new();
    let out = folder.path("inj.c");
    jred_of(
        "export {} --torque-error '50 N m' --max-cells 64 --format c -o {}",
        [&data("c-injection.toml"), &out],
    )
    .ends(2)
    .says(&[
        "the text of `title` contains U+000D, an end of line",
        ":5:9]",
        "remove it",
    ]);
    assert!(!out.exists());
}

/// The same in names of a catalogue and the Rust source for the duty meter.
#[test]
fn a_name_does_not_become_rust() {
    let folder = Folder::new();
    let out = folder.path("m.rs");
    jred_of(
        "size {} --motors {} --meter {}",
        [&press_file(), &data("rust-injection-motors.csv"), &out],
    )
    .ends(2)
    .says(&[
        "row 1: the cell in column 1 contains U+000A, an end of line",
        ":2:1]",
    ]);
    assert!(!out.exists());
}

/// Every hidden character, in a machine file, a catalogue in both formats and a rule set, in values and in keys.
#[test]
fn hidden_characters_are_refused_where_they_are_read() {
    let folder = Folder::new();
    let motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source\n";
    let press = press_file();
    for (c, code) in [
        ('\u{7f}', "U+007F, a control character"),
        ('\u{85}', "U+0085, an end of line"),
        ('\u{2028}', "U+2028, an end of line"),
        ('\u{202e}', "U+202E, a mark of the direction of writing"),
        ('\u{2066}', "U+2066, a mark of the direction of writing"),
        ('\u{200f}', "U+200F, a mark of the direction of writing"),
        ('\u{61c}', "U+061C, a mark of the direction of writing"),
        ('\u{200b}', "U+200B, a character that is not seen"),
        ('\u{feff}', "U+FEFF, a character that is not seen"),
        ('\u{ad}', "U+00AD, a character that is not seen"),
        ('\u{3164}', "U+3164, a character that is not seen"),
        ('\u{fe0f}', "U+FE0F, a character that is not seen"),
        ('\u{e0041}', "U+E0041, a character that is not seen"),
    ] {
        let written = format!("\\U{:08x}", u32::from(c));
        let machine = edited_press(
            "title = \"Servo press",
            &format!("title = \"Servo{written} press"),
        );
        let run = jred([&"check", &folder.file("m.toml", machine)]).ends(2);
        run.says(&["the text of `title` contains", code, "m.toml:6:"]);
        let rules = format!("title = \"x\"\n[rules]\n\"{written}\" = \"90 %\"\n");
        let run = jred([&"rules", &folder.file("own.toml", rules)]).ends(2);
        run.says(&["the key `", code, "own.toml:3:"]);
        let list = folder.file("motors.toml", format!("[[motor]]\nkey = \"a{written}b\"\n"));
        let run = jred([&"size", &press, &"--catalogue", &list]).ends(2);
        run.says(&["the text of `key` contains", code, "motors.toml:2:"]);
        let table = folder.file("motors.csv", format!("{motors}a{c}b,M,M,1,1,1,1,S\n"));
        let run = jred([&"size", &press, &"--motors", &table]).ends(2);
        run.says(&[
            "row 1: the cell in column 1 contains",
            code,
            "motors.csv:2:",
        ]);
        let table = folder.file("motors.csv", format!("ke{c}y{motors}"));
        let run = jred([&"size", &press, &"--motors", &table]).ends(2);
        run.says(&["the title of column 1 contains", code, "motors.csv:1:"]);
        // The character does not reach the terminal.
        assert!(!run.message().contains(c));
    }
}

/// A raw control character is not TOML: the message names it, and its cure.
#[test]
fn a_raw_control_character_is_named() {
    let folder = Folder::new();
    for (c, code) in [
        ('\u{1}', "U+0001"),
        ('\u{1b}', "U+001B"),
        ('\u{7f}', "U+007F"),
    ] {
        let file = folder.file("m.toml", format!("title = \"a{c}b\"\n[mechanism]\n"));
        let run = jred([&"check", &file]).ends(2);
        run.says(&[
            "not valid TOML",
            code,
            "a control character",
            "remove it",
            "m.toml:1:11",
        ]);
        assert!(!run.message().contains(c));
    }
}

/// Paths and arguments are escaped wherever they are printed.
#[cfg(unix)]
#[test]
fn hidden_characters_of_arguments_are_escaped() {
    let folder = Folder::new();
    let evil = "a\u{1b}[31m\u{202e}\u{e0041}\r\nfn evil() {}";
    let shown = "a\\u001b[31m\\u202e\\udb40\\udc41\\u000d\\u000afn evil()";
    let machine = folder.file(
        &format!("{evil}.toml"),
        press_text().replacen("title =", "# title =", 1),
    );
    let hidden = |text: &str| {
        text.contains(['\u{1b}', '\u{202e}', '\u{e0041}', '\r']) || text.contains("\nfn evil")
    };
    // As a title, in C, Rust, CSV, a page, the terminal.
    for (k, form) in ["c", "rust", "json"].iter().enumerate() {
        let out = folder.path(&format!("{k}"));
        let line = format!("--torque-error '50 N m' --max-cells 64 --format {form}");
        let error = typed(&line);
        let machine = machine.to_str().unwrap();
        let run = jred_with(
            &[
                &["export", machine],
                &error[..],
                &["--out", out.to_str().unwrap()],
            ]
            .concat(),
        )
        .ends(0);
        assert!(run.out.contains(shown), "{}", run.out);
        let text = std::fs::read_to_string(&out).unwrap();
        assert!(!hidden(&text) && !hidden(&run.out), "{text}\n{}", run.out);
    }
    let page = folder.path(&format!("{evil}.html"));
    let run = jred([&"reduce", &machine, &"--report", &page]).ends(0);
    let html = std::fs::read_to_string(&page).unwrap();
    assert!(html.contains("evil()") && !hidden(&html) && !hidden(&run.out));
    // In errors, including those of the command line.
    for arguments in [
        &["check", evil][..],
        &["check", "--format", evil],
        &["size", machine.to_str().unwrap(), "--why", evil],
        &["size", machine.to_str().unwrap(), "--rules", evil],
        &["size", machine.to_str().unwrap(), "--motor", evil],
        &["size", machine.to_str().unwrap(), "--catalogue", evil],
        &["export", machine.to_str().unwrap(), "--torque-error", evil],
        &["vary", machine.to_str().unwrap(), "--vary", evil],
    ] {
        let run = jred_with(arguments).ends(2);
        let bad = run
            .message()
            .contains(['\u{1b}', '\u{202e}', '\u{e0041}', '\r']);
        assert!(!bad, "{arguments:?}\n{}", run.err);
    }
}

/// Spreadsheets treat cells that start like a formula as one; numbers stay numbers.
#[test]
fn no_cell_is_a_formula() {
    let folder = Folder::new();
    let table = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source\n\
                 =cmd|' /C calc'!A0,M,M,20,3000,60,10,S\n";
    let table = folder.file("motors.csv", table);
    let run = jred_of(
        "size {} --motors {} --direct-only --all --format csv",
        [&press_file(), &table],
    );
    assert!(run.out.contains(",'=cmd|' /C calc'!A0,"), "{}", run.out);
    let text = edited_press(
        "title = \"Servo press, 60 mm stroke, 10 kN\"",
        "title = \"-2+3 press\"",
    );
    let run = jred([&"reduce", &folder.file("m.toml", text), &"--format", &"csv"]).ends(0);
    assert!(run.out.lines().skip(1).any(|row| row.contains(",-")));
    assert!(!run.out.contains(",'"), "{}", run.out);
}

/// A long value is cut in the message about it.
#[test]
fn long_values_are_cut() {
    let folder = Folder::new();
    let long = "x".repeat(5000);
    let edit = |from: &str, to: String| folder.file("m.toml", edited_press(from, &to));
    let press = press_file();
    let press = press.to_str().unwrap();
    let mut runs = vec![
        jred([&"check", &edit("\"slider-crank\"", format!("\"{long}\""))]),
        jred([
            &"check",
            &edit("offset = \"0 mm\"", format!("offset = \"{long}\"")),
        ]),
        jred([
            &"check",
            &edit("offset = \"0 mm\"", format!("offset = \"1 {long}\"")),
        ]),
        jred([
            &"check",
            &edit(
                "offset = \"0 mm\"",
                format!("offset = \"{} mm\"", "1".repeat(5000)),
            ),
        ]),
        jred([&"check", &edit("offset =", format!("{long} ="))]),
        jred([
            &"size",
            &folder.file(
                "m2.toml",
                edited_press("[motion]", &format!("[rules]\nset = \"{long}\"\n[motion]")),
            ),
        ]),
    ];
    for option in ["--rules", "--why", "--max-mass"] {
        runs.push(jred_with(&["size", press, option, &long]));
    }
    runs.push(jred_with(&["vary", press, "--vary", &long]));
    runs.push(jred_with(&["tolerance", press, "--tolerance", &long]));
    for column in ["key", "kind", "rated_torque [N m]", &long] {
        let table = format!("key,maker,model,{column}\n{long},M,M,{long}\n");
        runs.push(jred_of(
            "size {} --motors {}",
            [&press, &folder.file("motors.csv", table)],
        ));
    }
    for run in runs {
        let run = run.ends(2);
        let message = run.err.replace(['\n', ' ', '│'], "");
        assert!(message.contains('…') || message.len() < 1000, "{}", run.err);
        assert!(!message.contains(&"x".repeat(401)), "{}", run.err);
        // With a long word the message is not printed by clap: it ends like the others.
        assert!(!run.err.ends_with("'--help'.\n\n"), "{}", run.err);
    }
}

/// A line end in an option's value does not start a new line.
#[test]
fn an_end_of_line_in_an_option_is_escaped() {
    let press = press_file();
    for option in ["--rank", "--top", "--ratio"] {
        let run = jred([&"size", &press, &option, &"3\nerror: all is well"]).ends(2);
        run.says(&["3\\u000aerror: all is well"]);
        assert!(!run.err.contains("\nerror: all"), "{}", run.err);
    }
}
