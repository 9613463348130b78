//! Forms of an export: image, source text, JSON, and the terminal.

use jred::Image;

use super::{KINDS, export, export_of, image, press_table, words_of};
use crate::support::skip::skip;
use crate::support::{Folder, edited_press, press_file, typed};

/// The hexadecimal words of the rows in a source text; the identifier of the machine before them is on a line of its own.
fn words_in(source: &str) -> Vec<u32> {
    source
        .lines()
        .filter(|line| line.starts_with("    0x"))
        .flat_map(|line| line.split(|c: char| !c.is_ascii_alphanumeric()))
        .filter_map(|word| word.strip_prefix("0x"))
        .map(|word| u32::from_str_radix(word.trim_end_matches('u'), 16).unwrap())
        .collect()
}

#[test]
#[ignore = "more than five seconds of a processor"]
fn source_texts_hold_the_image() {
    let folder = Folder::new();
    for (number, layout) in KINDS {
        let line = format!("--type {number} --layout {layout} --torque-error '0.5 N m'");
        let kind = typed(&line);
        let of = |form: &str| {
            let out = folder.path(&format!("press.{form}"));
            export_of(
                &press_file(),
                &[&kind[..], &["--format", form]].concat(),
                Some(&out),
            )
            .ends(0);
            std::fs::read_to_string(out).unwrap()
        };
        let words = image(&folder, &kind);
        let (rust, c) = (of("rust"), of("c"));
        assert!(rust.contains(&format!("pub static TABLE: [u32; {}] = [", words.len())));
        assert_eq!(words_in(&rust), words);
        assert!(c.contains("#include <stdint.h>"));
        assert!(c.contains(&format!("const uint32_t press_words[{}] = {{", words.len())));
        assert_eq!(words_in(&c), words);
        let machine = format!("0x{:08x}", Image::new(&words).unwrap().machine());
        assert!(rust.contains(&format!("pub const MACHINE: u32 = {machine};")));
        assert!(c.contains(&format!("#define PRESS_MACHINE {machine}u")));
        // From the title; the option sets any number.
        assert_eq!(machine, "0x3d4c7e82");
        let given = image(&folder, &[&kind[..], &["--machine-id", "0x1A2b"]].concat());
        assert_eq!(Image::new(&given).unwrap().machine(), 0x1a2b);
        for text in [&rust, &c] {
            // Outside comments: a declaration, words, and a closing bracket; brackets are balanced.
            let is_code = |line: &&str| !line.starts_with(['/', '#']);
            let code: String = text.lines().filter(is_code).collect();
            let count = |c: char| code.matches(c).count();
            assert_eq!(
                (count('['), count('{'), count('(')),
                (count(']'), count('}'), count(')'))
            );
            assert!(
                ["};", "];", "};}", "}"]
                    .iter()
                    .any(|end| code.ends_with(end))
            );
            assert!(
                text.lines()
                    .all(|line| line.is_ascii() || line.starts_with("//"))
            );
            // The comment names the type to load.
            assert!(text.contains(&format!("// {number}, layout {layout}, ")));
            let set = "{ curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS }";
            let call = match (number, layout) {
                ("f32", "spline") => format!("image.model::<Spline<f32>, {set}>()"),
                ("f32", "cubic") => format!("image.model::<Cubic<f32>, {set}>()"),
                ("f32", _) => format!("image.model::<Quadratic<f32>, {set}>()"),
                ("i32", "spline") => format!("image.model::<Spline<Q31>, {set}>()"),
                ("i32", "spline16") => format!("image.model::<Spline16, {set}>()"),
                ("i32", "cubic") => format!("image.model::<Cubic<Q31>, {set}>()"),
                ("i32", _) => format!("image.model::<Quadratic<Q31>, {set}>()"),
                _ => format!("image.model::<Rows16, {set}>()"),
            };
            assert!(text.contains(&format!("// in Rust: {call}\n")), "{text}");
        }
    }
}

/// The Rust source is compiled here; with another type it would not compile.
#[test]
fn the_rust_file_is_a_program() {
    let folder = Folder::new();
    let out = folder.path("press_table.rs");
    let more = typed("--torque-error '2 N m' --type i32 --layout spline16 --format rust");
    export_of(&press_file(), &more, Some(&out)).ends(0);
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/export/press_table.rs");
    let [written, expected] =
        [out.as_path(), here.as_ref()].map(|path| std::fs::read_to_string(path).unwrap());
    assert_eq!(written, expected, "see CONTRIBUTING.md, Examples");
    let model = press_table::model().unwrap();
    assert_eq!(
        model.table().words().len() * 4,
        4 * (press_table::TABLE.len() - 25)
    );
    assert!(!Image::is_of::<jred::Spline<jred::Q31>, 0>(
        &press_table::TABLE
    ));
}

/// A C file compiles as C and as C++, even if included twice; its names are visible to another file.
#[cfg(unix)]
#[test]
fn the_c_file_is_c_and_cpp() {
    let folder = Folder::new();
    let edges = ["--pieces", "auto"];
    for (pieces, table) in [(&[][..], "table_words"), (&edges[..], "table_tables")] {
        let options = typed("--format c --torque-error '2 N m' --max-cells 200");
        export_of(
            &press_file(),
            &[&options, pieces].concat(),
            Some(&folder.path("table.c")),
        )
        .ends(0);
        let user = format!(
            "#include \"table.c\"\n#include \"table.c\"\nint main(void) {{ return {table}[0] == 0; }}\n"
        );
        let other = format!(
            "#include <stdint.h>\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\nextern const uintptr_t {table}[1];\n\
             #ifdef __cplusplus\n}}\n#endif\n\
             int main(void) {{ return {table}[0] == 0; }}\n"
        );
        folder.file("user.c", user);
        folder.file("other.c", other);
        for language in ["c", "c++"] {
            for sources in [&["user.c"][..], &["other.c", "table.c"]] {
                let run = std::process::Command::new("cc")
                    .current_dir(folder.path(""))
                    .args([
                        "-x",
                        language,
                        "-Wall",
                        "-Wextra",
                        "-pedantic",
                        "-Werror",
                        "-o",
                        "program",
                    ])
                    .args(sources)
                    .output();
                let run = run.expect("a C compiler is what Rust links with");
                let words = String::from_utf8_lossy(&run.stderr);
                // A C compiler may come without one for C++.
                if language == "c++" && words.contains("cc1plus") {
                    skip("a table in C was not compiled as C++: no C++ compiler");
                    continue;
                }
                assert!(run.status.success(), "{language} {sources:?}: {words}");
            }
        }
    }
}

/// Compiles a C program that includes these files; returns the compiler's message on failure.
#[cfg(unix)]
fn compiled(folder: &Folder, files: &[&str]) -> Result<(), String> {
    let include = |file: &&str| format!("#include \"{file}\"\n");
    let text: String = files.iter().map(include).collect();
    folder.file("two.c", text + "int main(void) { return 0; }\n");
    let run = std::process::Command::new("cc")
        .current_dir(folder.path(""))
        .args([
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-pedantic",
            "-Werror",
            "-fsyntax-only",
            "two.c",
        ])
        .output();
    let run = run.expect("a C compiler is what Rust links with");
    let words = String::from_utf8_lossy(&run.stderr).into_owned();
    if run.status.success() {
        Ok(())
    } else {
        Err(words)
    }
}

/// Two tables in one program: named after their files, or by option. Two with the same name do not compile, for any reason of the clash.
#[cfg(unix)]
#[test]
fn two_tables_of_one_name_do_not_compile() {
    let folder = Folder::new();
    let four_bar = crate::support::shipped("four-bar.toml");
    let write = |file: &std::path::Path, out: &str, more: &[&str]| {
        let fixed =
            typed("--format c --torque-error '2 N m' --omega '10 rad/s' --alpha '10 rad/s^2'");
        export_of(file, &[&fixed[..], more].concat(), Some(&folder.path(out))).ends(0);
    };
    // Machine files with one name in two folders; two tables of one machine.
    let machine = folder.file(
        "machine.toml",
        std::fs::read_to_string(press_file()).unwrap(),
    );
    write(&machine, "axis1.h", &[]);
    write(&four_bar, "axis2.h", &[]);
    write(&press_file(), "coarse.h", &["--layout", "cubic"]);
    // Chinese names of equal length.
    write(&press_file(), "\u{51b2}\u{5e8a}.h", &[]);
    write(&four_bar, "\u{538b}\u{673a}.h", &[]);
    let all = [
        "axis1.h",
        "axis2.h",
        "coarse.h",
        "\u{51b2}\u{5e8a}.h",
        "\u{538b}\u{673a}.h",
        "axis1.h",
    ];
    assert_eq!(compiled(&folder, &all), Ok(()));

    write(&press_file(), "press-1.h", &[]);
    write(&four_bar, "press_1.h", &[]);
    write(&four_bar, "four.h", &["--name", "axis1"]);
    // The same machine and name with another layout.
    write(
        &press_file(),
        "other.h",
        &["--name", "coarse", "--layout", "spline"],
    );
    for (files, name) in [
        (["press-1.h", "press_1.h"], "press_1"),
        (["axis1.h", "four.h"], "axis1"),
        (["four.h", "axis1.h"], "axis1"),
        (["coarse.h", "other.h"], "coarse"),
    ] {
        let says = format!(
            "two tables have the name {name} in one program: export one of them with another --name"
        );
        let words = compiled(&folder, &files).unwrap_err();
        assert!(words.contains(&says), "{files:?}: {words}");
    }
    // A name makes them distinct; the same table twice is one.
    write(&four_bar, "press_1.h", &["--name", "bar"]);
    assert_eq!(
        compiled(&folder, &["press-1.h", "press_1.h", "press-1.h"]),
        Ok(())
    );
}

#[test]
fn a_name_that_is_no_word_is_refused_with_one_that_is() {
    let folder = Folder::new();
    let out = folder.path("table.rs");
    let named = |name: &str, form: &str| {
        let more = ["--torque-error", "2 N m", "--format", form, "--name", name];
        export_of(&press_file(), &more, Some(&out))
    };
    named("press 1", "c").ends(2).says(&[
        "--name",
        "press 1",
        "cannot be used: a name in a program begins with a letter from a to z",
        "use --name press_1",
    ]);
    named("type", "rust").ends(2).says(&[
        "a word of the programming language Rust",
        "use --name type_table",
    ]);
    named("press", "image")
        .ends(2)
        .says(&["--format image has no names", "remove --name"]);
    // In Rust the name is a module: two tables in one file.
    named("press", "rust").ends(0);
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(
        text.contains("\npub mod press {\n")
            && !text.contains("use jred::*")
            && text.ends_with("];\n}\n"),
        "{text}"
    );
}

/// A title in a comment cannot end the comment.
#[test]
fn a_title_stays_in_its_comment() {
    let folder = Folder::new();
    let title = "title = \"one\\nint evil; \\\\\\nend\"";
    let text = edited_press("title = \"Servo press, 60 mm stroke, 10 kN\"", title);
    let file = folder.file("m.toml", text);
    let out = folder.path("table.c");
    let run = export_of(
        &file,
        &["--format", "c", "--torque-error", "1 N m"],
        Some(&out),
    );
    if run.code == 2 {
        return; // Refusing the title is just as good.
    }
    let source = std::fs::read_to_string(out).unwrap();
    for line in source.lines() {
        assert!(line.starts_with("//") || !line.contains("evil"), "{line}");
    }
}

#[test]
fn json_says_everything() {
    let folder = Folder::new();
    let more = typed("--type i32 --torque-error '0.5 N m' --reciprocal yes");
    let (run, path) = export(&folder, &more);
    run.ends(0);
    let words = words_of(&path);
    let with_json = [&more[..], &["--format", "json"]].concat();
    let printed = export_of(&press_file(), &with_json, None).ends(0);
    let value = printed.json();
    let out = folder.path("table.json");
    export_of(&press_file(), &with_json, Some(&out)).ends(0);
    assert_eq!(std::fs::read_to_string(out).unwrap(), printed.out);

    let list = value["words"].as_array().unwrap();
    let list: Vec<u32> = list.iter().map(|w| w.as_u64().unwrap() as u32).collect();
    assert_eq!(list, words);
    assert_eq!(value["image_bytes"], 4 * words.len());
    assert_eq!(value["cells"], words[4]);
    assert_eq!(value["curves"], 1 + 4 + 8 + 16);
    assert_eq!(value["type"], "i32");
    let stated = f64::from(f32::from_bits(words[12]));
    let error = value["torque_error"].as_f64().unwrap();
    assert!(error <= stated && stated < error * (1.0 + 2e-7));
    for (name, word) in [("torque", 7), ("speed", 8), ("inertia", 9)] {
        let base = value["scale"][name].as_f64().unwrap();
        assert_eq!(base as f32, f32::from_bits(words[word]), "{name}");
    }
    // Headroom: the parts of the sum add up to it in each cell, so the sum of the largest parts is not below it.
    let share = |name: &str| 0.5f64.powf(value["bits_unused"][name].as_f64().unwrap());
    let parts = ["inertia", "velocity", "load", "viscous", "coulomb"].map(share);
    assert!(
        parts
            .iter()
            .all(|part| *part > 0.0 && *part <= share("torque"))
    );
    assert!(parts.iter().sum::<f64>() >= share("torque") * (1.0 - 1e-6));
    assert!(share("torque") < 1.0);
    // Every type and layout.
    let all = value["alternatives"].as_array().unwrap();
    let names: Vec<_> = all
        .iter()
        .map(|a| (a["type"].as_str().unwrap(), a["layout"].as_str().unwrap()))
        .collect();
    assert_eq!(names, KINDS);
    assert_eq!(value["core"], "m4f");
    assert_eq!(value["by_direction"], false);
}

#[test]
fn without_a_file_nothing_is_written() {
    let run = export_of(&press_file(), &["--torque-error", "1 N m"], None).ends(0);
    assert!(
        run.out
            .contains("nothing written: use --out to write a file"),
        "{}",
        run.out
    );
    for (number, layout) in KINDS {
        let row = run.out.lines().any(|line| {
            let words: Vec<_> = line.split_whitespace().filter(|w| *w != "*").collect();
            words.len() > 5 && words[..2] == [number, layout]
        });
        assert!(row, "{number} {layout} is not in\n{}", run.out);
    }
    // Unused bits exist in fixed point only.
    assert!(!run.out.contains("unused bits"));
    let fixed = export_of(
        &press_file(),
        &["--torque-error", "1 N m", "--type", "i16"],
        None,
    );
    assert!(fixed.ends(0).out.contains("unused bits: J_red "));
}
