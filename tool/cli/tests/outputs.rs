//! No output overwrites an input, and an old file stays until the new one is complete. No input blocks the command without end.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use jred_cli::output::write;

use crate::support::{Folder, edited_press, jred, jred_with, press_file, press_text, shipped};

/// A file of the repository.
fn of_repository(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::fs::read_to_string(root.join(path)).unwrap()
}

/// A command, the option of an output, and a file that the command reads. `@` is the test's folder.
const READ: [[&str; 3]; 15] = [
    ["reduce @press.toml", "--report", "press.toml"],
    ["reduce @load-table.toml", "--report", "load-table.csv"],
    [
        "reduce @reduced-curves.toml",
        "--report",
        "reduced-curves.csv",
    ],
    ["simulate @reduced-curves.toml", "--report", "drive-log.csv"],
    [
        "export @press.toml --torque-error 1Nm",
        "--out",
        "press.toml",
    ],
    ["size @named.toml", "--meter", "own.toml"],
    ["size @press.toml --rules @own.toml", "--report", "own.toml"],
    [
        "size @press.toml --motors @motors.csv",
        "--report",
        "motors.csv",
    ],
    [
        "size @press.toml --gearboxes @gearboxes.csv",
        "--meter",
        "gearboxes.csv",
    ],
    [
        "size @press.toml --catalogue @all",
        "--report",
        "all/gearboxes.csv",
    ],
    [
        "fastest @press.toml --motors @motors.csv",
        "--profile",
        "motors.csv",
    ],
    [
        "gentlest @press.toml --motors @motors.csv --drive sgm7a-25a+npt025mf-4",
        "--report",
        "motors.csv",
    ],
    [
        "simulate @press.toml --motors @motors.csv --drive sgm7a-25a+npt025mf-4",
        "--report",
        "motors.csv",
    ],
    [
        "vary @press.toml --resume --vary crank.length=30mm",
        "--out",
        "press.toml",
    ],
    [
        "tolerance @press.toml --resume --tolerance crank.length=1%",
        "--out",
        "press.toml",
    ],
];

/// Every file that a command reads, under each of its names.
#[test]
fn an_output_is_never_a_file_that_was_read() {
    let folder = Folder::new();
    for name in [
        "load-table.toml",
        "load-table.csv",
        "reduced-curves.toml",
        "reduced-curves.csv",
        "drive-log.csv",
    ] {
        folder.file(name, of_repository(&format!("machines/{name}")));
    }
    std::fs::create_dir(folder.path("all")).unwrap();
    for name in ["motors.csv", "gearboxes.csv"] {
        let table = of_repository(&format!("tool/sizing/catalogue/{name}"));
        folder.file(name, &table);
        folder.file(&format!("all/{name}"), table);
    }
    folder.file("own.toml", "title = \"Own\"\n[rules]\n");
    folder.file("press.toml", press_text());
    let named = edited_press("[motion]", "[rules]\nset = \"own.toml\"\n\n[motion]");
    folder.file("named.toml", named);
    let root = folder.path("");
    for (k, [command, option, read]) in READ.into_iter().enumerate() {
        let file = folder.path(read);
        let before = std::fs::read(&file).unwrap();
        for name in names(&folder, &file, k) {
            let name = name.to_str().unwrap();
            let command = command.replace('@', root.to_str().unwrap());
            let mut arguments: Vec<&str> = command.split(' ').collect();
            arguments.extend([option, name]);
            let run = jred_with(&arguments).ends(2);
            // The message may be wrapped anywhere in a path.
            let message = run.err.replace([' ', '\n', '│'], "");
            for word in [option, name, file.to_str().unwrap(), "notoverwritten"] {
                assert!(message.contains(word), "{word}\n{}", run.err);
            }
            assert!(run.out.is_empty(), "{}", run.out);
            assert_eq!(std::fs::read(&file).unwrap(), before, "{read}");
        }
    }
}

/// The names of a file: its own, a hard link, a symbolic link.
fn names(folder: &Folder, file: &Path, k: usize) -> Vec<PathBuf> {
    let mut names = vec![file.to_owned()];
    if cfg!(unix) {
        let hard = folder.path(&format!("hard-{k}"));
        std::fs::hard_link(file, &hard).unwrap();
        names.push(hard);
    }
    #[cfg(unix)]
    {
        let soft = folder.path(&format!("soft-{k}"));
        std::os::unix::fs::symlink(file, &soft).unwrap();
        names.push(soft);
    }
    names
}

#[cfg(unix)]
mod unix;

/// Existing temporary names, as of killed runs with the same number, do not block an output.
#[test]
fn leftovers_are_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.html");
    for taken in 0..150 {
        let name = format!(".jred-{}-{taken}.part", std::process::id());
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    write(&path, b"new").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"new");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 151);
}

/// A planetary gear has constant inertia: no rounding error of its derivative is printed as a value.
#[test]
fn what_is_zero_is_printed_as_zero() {
    let machine = shipped("linkage-planetary.toml");
    let reduced = jred([&"reduce", &machine, &"--positions", &"12"])
        .ends(0)
        .out;
    let explained = jred([&"size", &machine, &"--explain"]).out;
    assert!(reduced.contains("0.0409043") && explained.contains("velocity"));
    for line in reduced.lines().chain(explained.lines()) {
        assert!(!line.contains("e-1"), "{line}");
    }
    let bucket = shipped("excavator-bucket.toml");
    let explained = jred([&"size", &bucket, &"--explain"]).out;
    assert!(explained.contains(" 0.0 %") && !explained.contains("-0.0 %"));
}

/// Files of one result: if one cannot be written, none is.
#[test]
fn of_files_that_belong_together_all_or_none_are_written() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let drive = ["--torque", "60 N m", "--motor-speed", "3000 rpm"];
    for (command, options) in [("fastest", &drive[..]), ("gentlest", &[])] {
        let cam = folder.path("cam.csv");
        let missing = folder.path("nowhere/report.html");
        for what in ["--report", "--plan"] {
            let outputs = ["--cam", cam.to_str().unwrap(), what];
            let missing = missing.with_extension(if what == "--plan" { "jred" } else { "html" });
            let path = missing.to_str().unwrap();
            let words = [command, press.to_str().unwrap()];
            let run = jred_with(&[&words[..], options, &outputs, &[path]].concat()).ends(2);
            run.says(&["cannot write", "make the folder first"]);
        }
        let left: Vec<_> = std::fs::read_dir(cam.parent().unwrap())
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect();
        assert_eq!(left, ["press.toml"], "{command}");
    }
}
