//! Links, owners, devices and pipes on Unix.

use std::io::Read as _;
use std::os::unix::fs::{MetadataExt as _, PermissionsExt, symlink};
use std::os::unix::process::CommandExt as _;
use std::process::{Command, Stdio};

use super::*;
use crate::support::jred_of;

const EXPORT: [&str; 4] = ["--torque-error", "50 N m", "--max-cells", "64"];

fn export_to(out: &Path) -> crate::support::Run {
    let (press, out) = (press_file(), out.to_str().unwrap());
    jred_with(
        &[
            &["export", press.to_str().unwrap()],
            &EXPORT[..],
            &["--out", out],
        ]
        .concat(),
    )
}

/// The new file is complete before it replaces the old one; permissions and links stay.
#[test]
fn a_file_is_replaced_at_once() {
    let folder = Folder::new();
    let old = folder.file("press.jred", "old");
    std::fs::set_permissions(&old, PermissionsExt::from_mode(0o640)).unwrap();
    let kept = folder.path("kept");
    std::fs::hard_link(&old, &kept).unwrap();
    let link = folder.path("link");
    symlink("press.jred", &link).unwrap();
    export_to(&link).ends(0);
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read(&kept).unwrap(), b"old");
    let new = old.metadata().unwrap();
    assert_eq!(new.permissions().mode() & 0o777, 0o640);
    assert_ne!(new.ino(), kept.metadata().unwrap().ino());
    assert!(std::fs::read(&old).unwrap().starts_with(b"JRED"));
    // A dangling link.
    symlink("new.jred", folder.path("dangling")).unwrap();
    export_to(&folder.path("dangling")).ends(0);
    assert!(folder.path("new.jred").is_file());
    let names = std::fs::read_dir(folder.path(".")).unwrap();
    assert_eq!(names.count(), 5, "nothing is left behind");
}

/// Two outputs must be two files: symbolic links, also dangling ones, and hard links are followed.
#[test]
fn two_outputs_are_two_files() {
    let folder = Folder::new();
    let page = folder.path("b.html");
    let [soft, hard] = ["soft.html", "hard.html"].map(|name| folder.path(name));
    symlink("b.html", &soft).unwrap();
    let refused = |[one, other]: [&Path; 2]| {
        jred_of(
            "size {} --report {} --meter {}",
            [&press_file(), &one, &other],
        )
        .ends(2)
        .says(&["--report and --meter both name one file", "two different"]);
    };
    refused([&page, &soft]);
    refused([&soft, &page]);
    assert!(!page.exists());
    std::fs::write(&page, "old").unwrap();
    std::fs::hard_link(&page, &hard).unwrap();
    refused([&page, &soft]);
    refused([&hard, &page]);
    assert_eq!(std::fs::read(&page).unwrap(), b"old");
}

/// Writes a report in a folder with `mode`, as user 65534 if the test runs as root; returns exit code and message.
fn page_of_another_user(folder: &Folder, mode: u32) -> (i32, String) {
    let permit = |path: &Path, mode| {
        std::fs::set_permissions(path, PermissionsExt::from_mode(mode)).unwrap();
    };
    let [root, jred] = [folder.path(""), folder.path("jred")];
    let machine = folder.file("m.toml", press_text());
    std::fs::copy(env!("CARGO_BIN_EXE_jred"), &jred).unwrap();
    permit(&machine, 0o644);
    permit(&root, mode);
    let mut command = Command::new(&jred);
    command
        .env("NO_COLOR", "1")
        .env("JRED_PROGRESS", "never")
        .arg("reduce")
        .arg(&machine);
    command.arg("--report").arg(folder.path("r.html"));
    if root.metadata().unwrap().uid() == 0 {
        command.uid(65534).gid(65534);
    }
    let run = command.output().unwrap();
    permit(&root, 0o755);
    let error = String::from_utf8(run.stderr).unwrap();
    (run.status.code().unwrap(), error)
}

/// A file keeps its owner: root gives the new file to the owner of the old one; other users overwrite the old file in place.
#[test]
fn a_file_keeps_its_owner() {
    let folder = Folder::new();
    let old = folder.file("r.html", "old".repeat(1 << 20));
    if old.metadata().unwrap().uid() != 0 {
        return; // Only root can change owners.
    }
    let owned = || {
        let file = old.metadata().unwrap();
        (file.uid(), file.gid(), file.permissions().mode() & 0o7777)
    };
    std::os::unix::fs::chown(&old, Some(4321), Some(1234)).unwrap();
    std::fs::set_permissions(&old, PermissionsExt::from_mode(0o666)).unwrap();
    let before = old.metadata().unwrap().ino();
    let (code, error) = page_of_another_user(&folder, 0o777);
    assert_eq!(code, 0, "{error}");
    assert_eq!(old.metadata().unwrap().ino(), before);
    let page = std::fs::read_to_string(&old).unwrap();
    assert!(page.starts_with("<!") && page.trim_end().ends_with("</html>"));
    assert_eq!(owned(), (4321, 1234, 0o666));
    jred([&"reduce", &press_file(), &"--report", &old]).ends(0);
    assert_ne!(old.metadata().unwrap().ino(), before);
    assert_eq!(owned(), (4321, 1234, 0o666));
    let names = std::fs::read_dir(folder.path(".")).unwrap();
    assert_eq!(names.count(), 3, "nothing is left behind");
}

/// If the folder is not writable, the message names it, and the old file stays.
#[test]
fn the_folder_of_an_output_is_named() {
    let folder = Folder::new();
    let old = folder.file("r.html", "old");
    std::fs::set_permissions(&old, PermissionsExt::from_mode(0o666)).unwrap();
    let (code, error) = page_of_another_user(&folder, 0o555);
    assert_eq!(code, 2);
    let message = error.replace([' ', '\n', '│'], "");
    let root = old.parent().unwrap().to_str().unwrap();
    let words = format!("nofilecanbemadeinthefolder{root}:Permissiondenied");
    assert!(message.contains(&words), "{words}\n{error}");
    assert_eq!(std::fs::read(&old).unwrap(), b"old");
}

/// A full disk, simulated by a limit on file size, leaves the old file and nothing else.
#[test]
fn a_full_disk_leaves_the_old_file() {
    let folder = Folder::new();
    let old = folder.file("r.html", "old");
    let script = "ulimit -f 1; trap '' XFSZ; exec \"$0\" reduce \"$1\" --report \"$2\"";
    let run = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_jred")])
        .args([&press_file(), &old])
        .output()
        .unwrap();
    let error = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2), "{error}");
    assert!(error.contains("cannot write"), "{error}");
    assert_eq!(std::fs::read(&old).unwrap(), b"old");
    assert_eq!(std::fs::read_dir(folder.path(".")).unwrap().count(), 1);
}

/// Pipes and devices are written directly.
#[test]
fn devices_are_written_directly() {
    let (press, out) = (press_file(), ["--format", "c", "--out", "/dev/stdout"]);
    let run = jred_with(&[&["export", press.to_str().unwrap()], &EXPORT[..], &out].concat());
    assert!(run.out.contains("_words["), "{}", run.out);
    assert!(run.out.contains("written to /dev/stdout"), "{}", run.out);
    if Path::new("/dev/full").exists() {
        export_to(Path::new("/dev/full"))
            .ends(2)
            .says(&["cannot write /dev/full"]);
        let full = std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let mut split = Command::new(env!("CARGO_BIN_EXE_jred"));
        split.args(["rules"]).stdout(full).stderr(Stdio::piped());
        let run = split.output().unwrap();
        assert_eq!(run.status.code(), Some(2));
    }
    export_to(Path::new("/dev/null")).ends(0);
}

/// The file that stdout is redirected to is refused as an output: the result would be lost.
#[test]
fn the_file_behind_stdout_is_refused() {
    let folder = Folder::new();
    let result = folder.path("result");
    let run = Command::new(env!("CARGO_BIN_EXE_jred"))
        .args([Path::new("export"), &press_file()])
        .args(EXPORT)
        .args([Path::new("--out"), &result])
        .stdout(std::fs::File::create(&result).unwrap())
        .output()
        .unwrap();
    let error = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2), "{error}");
    assert!(error.contains("stdout is redirected"), "{error}");
}

/// Every reader stops at inputs without end: a device at its limit in bytes, a pipe without a writer after some seconds.
#[test]
fn what_does_not_end_is_given_up() {
    let folder = Folder::new();
    let pipe = folder.path("pipe-motors.csv");
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let press = press_file();
    let (press, pipe) = (press.to_str().unwrap(), pipe.to_str().unwrap());
    let from_zero = folder.file(
        "zero.toml",
        edited_press("[motion]", "[rules]\nset = \"/dev/zero\"\n[motion]"),
    );
    let zero = "/dev/zero";
    let cases: [(&[&str], &str); 7] = [
        (&["check", zero], "the maximum is 1 MiB"),
        (&["rules", "/dev/zero"], "the maximum is 65536 bytes"),
        (&["size", press, "--motors", zero], "the maximum is 64 MiB"),
        (
            &["reduce", from_zero.to_str().unwrap()],
            "the maximum is 65536 bytes",
        ),
        (&["check", pipe], "did not end within 5 s"),
        (&["rules", pipe], "did not end within 5 s"),
        (
            &["size", press, "--catalogue", pipe],
            "did not end within 5 s",
        ),
    ];
    let runs = cases.map(|(arguments, words)| {
        let run = Command::new(env!("CARGO_BIN_EXE_jred"))
            .args(arguments)
            .env("NO_COLOR", "1")
            .env("JRED_PROGRESS", "never")
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        (run, arguments, words)
    });
    for (mut run, arguments, words) in runs {
        let mut error = String::new();
        run.stderr
            .take()
            .unwrap()
            .read_to_string(&mut error)
            .unwrap();
        let words_of_it = error.split_whitespace().filter(|w| *w != "│");
        let message = words_of_it.collect::<Vec<_>>().join(" ");
        assert!(message.contains(words), "{arguments:?}: {error}");
        assert_eq!(run.wait().unwrap().code(), Some(2));
    }
}

/// A pipe that ends is read.
#[test]
fn a_machine_may_come_from_a_pipe() {
    let run = assert_cmd::Command::new(env!("CARGO_BIN_EXE_jred"))
        .args(["check", "/dev/stdin"])
        .write_stdin(press_text())
        .output()
        .unwrap();
    assert_eq!(
        run.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
}

/// A message that cannot be written is dropped: exit code and outputs are unaffected.
#[test]
fn a_message_that_nobody_reads_is_dropped() {
    let folder = Folder::new();
    let full = || {
        std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap()
    };
    let run = |arguments: &[&str], stderr: Stdio| {
        Command::new(env!("CARGO_BIN_EXE_jred"))
            .args(arguments)
            .stdout(Stdio::null())
            .stderr(stderr)
            .status()
            .unwrap()
            .code()
    };
    let closed = || {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        Stdio::from(writer)
    };
    for stderr in [Stdio::from(full()), closed()] {
        assert_eq!(run(&["check", "nosuch.toml"], stderr), Some(2));
    }
    // It prints a warning and writes its report.
    let page = folder.path("page.html");
    let press = press_file();
    let arguments = [
        "fastest",
        press.to_str().unwrap(),
        "--torque",
        "60 N m",
        "--report",
        page.to_str().unwrap(),
    ];
    let quiet = run(&arguments, Stdio::null());
    std::fs::remove_file(&page).unwrap();
    assert_eq!(run(&arguments, Stdio::from(full())), quiet);
    assert!(page.is_file());
}

/// `jred reduce F >> F` leaves F unchanged.
#[test]
fn an_input_is_not_appended_to() {
    let folder = Folder::new();
    let file = folder.file("press.toml", press_text());
    let before = std::fs::read(&file).unwrap();
    for command in [
        &["reduce"][..],
        &["check"],
        &["vary", "--vary", "crank.length=30mm", "--format", "csv"],
    ] {
        let appended = std::fs::OpenOptions::new()
            .append(true)
            .open(&file)
            .unwrap();
        let run = Command::new(env!("CARGO_BIN_EXE_jred"))
            .args(command)
            .arg(&file)
            .stdout(appended)
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(2), "{command:?}");
        let message = String::from_utf8_lossy(&run.stderr).replace([' ', '\n', '│'], "");
        assert!(message.contains("whichthiscommandreads"), "{message}");
        assert_eq!(std::fs::read(&file).unwrap(), before, "{command:?}");
    }
}

/// Writing to a pipe without a reader stops after some seconds.
#[test]
fn a_pipe_without_a_reader_is_given_up() {
    let folder = Folder::new();
    let pipe = folder.path("pipe");
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let error = jred_cli::output::patiently(&pipe, std::time::Duration::from_millis(20));
    assert_eq!(error.unwrap_err().kind(), ErrorKind::TimedOut);
}
