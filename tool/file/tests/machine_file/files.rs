//! Files that cannot be read as a whole.

use std::path::Path;

use crate::reader;

use super::{refuses, rendered};

fn refuses_file(path: &Path, words: &[&str]) {
    let report = rendered(&reader::read(path).unwrap_err());
    if std::env::var_os("SHOW_REPORTS").is_some() {
        println!("{report}");
    }
    for word in words.iter().chain(&["cannot read the machine file"]) {
        assert!(report.contains(word), "{word:?} is not in\n{report}");
    }
    assert!(
        report.contains(&path.display().to_string()),
        "no path in\n{report}"
    );
}

#[test]
fn files_that_are_no_machine_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("machine.toml");
    refuses_file(&path, &["no such file", "check the name"]);
    refuses_file(folder.path(), &["is a folder"]);
    std::fs::write(&path, vec![b'#'; 10 << 20]).unwrap();
    refuses_file(
        &path,
        &[
            "10 MiB",
            "the maximum is 1 MiB",
            "CSV file",
            "`file` in [motion]",
        ],
    );
    std::fs::write(&path, [b'a', b'\n', 0xff, 0xfe, 0, 1]).unwrap();
    refuses_file(&path, &["UTF-8", "line 2"]);
}

#[test]
fn texts_that_are_no_machine_files_are_refused() {
    refuses("", &["machine.toml is empty", "gravity", "[mechanism]"]);
    refuses("\n# nothing\n", &["machine.toml is empty"]);
    refuses("a\u{0}b = 1", &["not valid TOML"]);
    refuses("just some text", &["not valid TOML"]);
    refuses("title = \"a\"\n[mechanism", &["not valid TOML"]);
    refuses(
        "gravity = 3",
        &["`gravity` must be a list", "is a plain number"],
    );
    let gravity = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n";
    refuses(gravity, &["`mechanism` is missing", "[mechanism]"]);
    refuses(&format!("{gravity}mechanism = 1"), &["must be a table"]);
    refuses(
        &format!("{gravity}[[mechanism]]\ntype = \"belt\""),
        &["must be a table", "is a list"],
    );
    let deep = format!("gravity = {}", "[".repeat(100_000));
    refuses(&deep, &["not valid TOML"]);
    // A line that would fill the screen is named by its file and number.
    let line = format!("{gravity}title = \"{}\" 3", "x".repeat(5000));
    refuses(&line, &["machine.toml:2:", "not valid TOML"]);
    let long = format!("# {}", "x".repeat(1 << 20));
    refuses(&long, &["the maximum is 1 MiB"]);
}
