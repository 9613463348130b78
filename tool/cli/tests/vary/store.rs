//! Files of rows: shares, resuming, threads, clusters.

use std::path::Path;
use std::process::Command;

use crate::support::{Folder, press_file, study_rows};

const STUDY: [&str; 4] = [
    "--vary",
    "slider.mass=30..60kg:7",
    "--vary",
    "segment.1.duration=0.3,0.4s",
];

/// A quick study into a file.
fn study(folder: &Folder, name: &str, more: &[&str]) -> (i32, String) {
    let path = folder.path(name);
    let mut command = Command::new(env!("CARGO_BIN_EXE_jred"));
    command
        .arg("vary")
        .arg(press_file())
        .args(STUDY)
        .args(["--steps", "64", "--motor", "sgmsh-*"]);
    command
        .args(more)
        .arg("--out")
        .arg(path)
        .env("NO_COLOR", "1")
        .env("JRED_PROGRESS", "never");
    let output = command.output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    let words = message.split_whitespace().filter(|w| *w != "│");
    (
        output.status.code().unwrap(),
        words.collect::<Vec<_>>().join(" "),
    )
}

fn read(folder: &Folder, name: &str) -> String {
    std::fs::read_to_string(folder.path(name)).unwrap()
}

/// The shares have the rows of one run, in CSV and JSON.
#[test]
fn shares_have_the_rows_of_the_whole() {
    for format in ["csv", "json"] {
        let folder = Folder::new();
        assert_eq!(study(&folder, "whole", &["--format", format]).0, 0);
        let names: Vec<String> = (0..3).map(|k| format!("part-{k}")).collect();
        for (k, name) in names.iter().enumerate() {
            let shard = format!("{k}/3");
            let more = ["--format", format, "--shard", &shard];
            assert_eq!(study(&folder, name, &more).0, 0);
        }
        let whole = study_rows(&folder, &["whole".to_owned()]);
        assert_eq!(study_rows(&folder, &names), whole);
        assert_eq!(whole.len(), 14);
    }
}

/// Resuming a run that was cut off anywhere gives the file of an uninterrupted run.
#[test]
fn a_run_that_was_cut_off_is_continued() {
    let folder = Folder::new();
    assert_eq!(study(&folder, "whole", &[]).0, 0);
    let whole = read(&folder, "whole");
    // Empty, inside the header, after it, inside a row, at the end of a row, complete.
    let header = whole.find('\n').unwrap();
    for length in [
        0,
        20,
        header + 1,
        header + 30,
        whole.len() / 2,
        whole.len() * 3 / 4,
        whole.len() - 1,
        whole.len(),
    ] {
        folder.file("cut", &whole[..length]);
        let (code, message) = study(&folder, "cut", &["--resume"]);
        if length == 20 {
            // A file without a valid header may belong to somebody else.
            assert_eq!(code, 0, "{message}");
        }
        assert_eq!(code, 0, "{length}: {message}");
        assert_eq!(read(&folder, "cut"), whole, "cut at {length}");
    }
    // A missing file is started.
    assert_eq!(study(&folder, "new", &["--resume"]).0, 0);
    assert_eq!(read(&folder, "new"), whole);
    // Without --resume nothing is overwritten.
    let (code, message) = study(&folder, "new", &[]);
    assert_eq!(code, 2);
    assert!(
        message.contains("already exists") && message.contains("--resume"),
        "{message}"
    );
    // Another study is refused, the file stays.
    let (code, message) = study(&folder, "new", &["--resume", "--rank", "margin"]);
    assert_eq!(code, 2);
    assert!(message.contains("it differs in the options"), "{message}");
    let (code, message) = study(&folder, "new", &["--resume", "--shard", "0/2"]);
    assert_eq!(code, 2);
    assert!(message.contains("another share"), "{message}");
    assert_eq!(read(&folder, "new"), whole);
}

/// Damage in the middle of a file makes its line invalid: nothing is taken over, and the file stays.
#[test]
fn damage_in_the_middle_is_named() {
    for format in ["csv", "json"] {
        let folder = Folder::new();
        let more = ["--format", format];
        assert_eq!(study(&folder, "whole", &more).0, 0);
        let whole = read(&folder, "whole");
        let lines: Vec<&str> = whole.lines().collect();
        let hurt = lines.len() - 6;
        let row = lines[hurt];
        let zeros = "\0".repeat(8);
        for damaged in [
            zeros.clone(),
            row[..row.len() / 2].to_owned(),
            format!("{}{zeros}{}", &row[..10], &row[18..]),
            format!("{}{}", &row[..row.len() / 2], lines[hurt + 1]),
            String::new(),
        ] {
            let mut text = lines.clone();
            text[hurt] = &damaged;
            let text = text.join("\n") + "\n";
            folder.file("hurt", &text);
            let (code, message) = study(&folder, "hurt", &["--format", format, "--resume"]);
            assert_eq!(code, 2, "{damaged:?}: {message}");
            let place = format!("line {} is damaged", hurt + 1);
            let cure = format!("delete line {} and all lines after it", hurt + 1);
            assert!(message.contains(&place), "{damaged:?}: {message}");
            assert!(message.contains(&cure), "{message}");
            assert_eq!(read(&folder, "hurt"), text);
            // The cure.
            folder.file("hurt", lines[..hurt].join("\n") + "\n");
            let (code, message) = study(&folder, "hurt", &["--format", format, "--resume"]);
            assert_eq!(code, 0, "{message}");
            assert_eq!(read(&folder, "hurt"), whole);
        }
    }
}

/// Bytes that are not UTF-8 are reported with their line, and the file stays.
#[test]
fn bytes_that_are_no_text_are_named() {
    let folder = Folder::new();
    assert_eq!(study(&folder, "hurt", &[]).0, 0);
    let mut bytes = read(&folder, "hurt").into_bytes();
    let ends: Vec<usize> = (0..bytes.len()).filter(|k| bytes[*k] == b'\n').collect();
    let hurt = ends.len() - 3;
    bytes[ends[hurt] - 2] = 0xff;
    std::fs::write(folder.path("hurt"), &bytes).unwrap();
    let (code, message) = study(&folder, "hurt", &["--resume"]);
    assert_eq!(code, 2, "{message}");
    let place = format!("line {} is damaged", hurt + 1);
    assert!(message.contains(&place), "{message}");
    assert_eq!(std::fs::read(folder.path("hurt")).unwrap(), bytes);
}

/// No file is started behind a dangling link, and the message does not recommend an option that fails, too.
#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_named() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("rows.csv", folder.path("link")).unwrap();
    for more in [&[][..], &["--resume"]] {
        let (code, message) = study(&folder, "link", more);
        assert_eq!(code, 2);
        assert!(
            message.contains("link is a dangling symbolic link") && !message.contains("--resume"),
            "{message}"
        );
    }
    assert!(!folder.path("rows.csv").exists());
}

/// The number of threads does not change the output.
#[test]
fn rows_do_not_depend_on_threads() {
    let folder = Folder::new();
    assert_eq!(study(&folder, "many", &[]).0, 0);
    let mut command = Command::new(env!("CARGO_BIN_EXE_jred"));
    command
        .arg("vary")
        .arg(press_file())
        .args(STUDY)
        .args(["--steps", "64", "--motor", "sgmsh-*", "--out"]);
    let status = command
        .arg(folder.path("one"))
        .env("RAYON_NUM_THREADS", "1")
        .status()
        .unwrap();
    assert!(status.success());
    assert_eq!(read(&folder, "one"), read(&folder, "many"));
}

/// `script` with the environment of task `index` of `count`.
fn cluster(mut command: Command, folder: &Folder, environment: &[(&str, String)]) {
    let binaries = Path::new(env!("CARGO_BIN_EXE_jred")).parent().unwrap();
    let path = format!("{}:{}", binaries.display(), std::env::var("PATH").unwrap());
    command
        .current_dir(folder.path(""))
        .env("PATH", path)
        .env("MACHINE", press_file());
    command.env("SLIDER", STUDY[1]).env("DURATION", STUDY[3]);
    command.envs(
        environment
            .iter()
            .map(|(name, value)| (*name, value.as_str())),
    );
    let output = command.output().unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// The script of machines/cluster, run as Slurm would, gives the rows of one run.
#[test]
#[cfg_attr(not(unix), ignore = "the script is for a Unix shell")]
fn the_script_for_slurm() {
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/cluster");
    let folder = Folder::new();
    let whole = folder.path("whole.csv");
    let mut command = Command::new(env!("CARGO_BIN_EXE_jred"));
    let status = command
        .arg("vary")
        .arg(press_file())
        .args(STUDY)
        .arg("--out")
        .arg(&whole)
        .status()
        .unwrap();
    assert!(status.success());
    for index in 0..3 {
        let mut command = Command::new("bash");
        command.arg(scripts.join("vary.slurm.sh"));
        let task = [
            ("SLURM_ARRAY_TASK_ID", format!("{index}")),
            ("SLURM_ARRAY_TASK_COUNT", "3".to_owned()),
            ("SLURM_CPUS_PER_TASK", "1".to_owned()),
            ("OUT", "slurm".to_owned()),
        ];
        cluster(command, &folder, &task);
    }
    let names: Vec<String> = (0..3).map(|k| format!("slurm.part-{k}.csv")).collect();
    assert_eq!(
        study_rows(&folder, &names),
        study_rows(&folder, &["whole.csv".to_owned()])
    );
}
