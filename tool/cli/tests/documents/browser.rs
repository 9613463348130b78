//! Browsers that print: ones that a test writes, and a real one if there is one.

use std::ffi::OsString;
use std::io::Write as _;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use jred_cli::browser;

use crate::support::{Folder, press_file, shipped, typed};

/// A program of a few lines. Another process writes it: a test that starts a program at this moment would keep it open.
fn program(folder: &Folder, text: &str) -> PathBuf {
    let path = folder.path("browser");
    let mut writer = Command::new("sh")
        .args(["-c", "cat >\"$0\" && chmod +x \"$0\""])
        .arg(&path)
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let text = format!("#!/bin/sh\n{text}\n");
    writer
        .stdin
        .take()
        .unwrap()
        .write_all(text.as_bytes())
        .unwrap();
    assert!(writer.wait().unwrap().success());
    path
}

/// Exit code and message of a command with this browser, and whether it printed its answer.
fn run(line: &str, files: &[&Path], browser: &Path) -> (Option<i32>, String, bool) {
    let mut files = files.iter();
    let words = typed(line).into_iter().map(|word| match word {
        "{}" => files.next().unwrap().into(),
        _ => OsString::from(word),
    });
    let run = Command::new(env!("CARGO_BIN_EXE_jred"))
        .args(words)
        .envs([("NO_COLOR", "1"), ("JRED_PROGRESS", "never")])
        .env("JRED_BROWSER", browser)
        .output()
        .unwrap();
    let said = String::from_utf8(run.stderr)
        .unwrap()
        .replace(['│', '\n'], " ");
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    (run.status.code(), said, !run.stdout.is_empty())
}

fn names(folder: &Folder) -> Vec<String> {
    let entries = std::fs::read_dir(folder.path("")).unwrap();
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.unwrap().file_name().into_string().unwrap()
    };
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

/// Prints eight bytes, and copies what it was given into its own folder.
const COPIES: &str = r#"
home=$(dirname "$0")
printf '%s\n' "$@" >"$home/arguments"
cp page.html "$home/page"
for word; do case $word in --print-to-pdf=*) printf '%%PDF-1.4' >"${word#*=}";; esac; done
"#;

#[test]
fn a_browser_gets_the_page_without_network_and_scripts() {
    let folder = Folder::new();
    let browser = program(&folder, COPIES);
    let pdf = folder.path("a report.pdf");
    let line = "size {} --pdf {} --paper letter";
    let (code, said, printed) = run(line, &[&press_file(), &pdf], &browser);
    assert_eq!(
        (code, said.contains('×'), printed),
        (Some(0), false, true),
        "{said}"
    );
    assert_eq!(std::fs::read(&pdf).unwrap(), b"%PDF-1.4");
    // Nothing else is left in the folder.
    assert_eq!(
        names(&folder),
        ["a report.pdf", "arguments", "browser", "page"]
    );
    let page = std::fs::read_to_string(folder.path("page")).unwrap();
    let policy = page.find("content=\"default-src 'none'; style-src 'unsafe-inline'\"");
    assert!(policy.unwrap() < page.find("<style").unwrap());
    assert!(page.contains("size: letter;"));
    let arguments = std::fs::read_to_string(folder.path("arguments")).unwrap();
    let arguments: Vec<&str> = arguments.lines().collect();
    for word in [
        "--headless",
        "--host-resolver-rules=MAP * ~NOTFOUND",
        "--no-pdf-header-footer",
    ] {
        assert!(arguments.contains(&word), "{word}: {arguments:?}");
    }
    assert_eq!(arguments.last(), Some(&"page.html"));
    let is_root = folder.path("").metadata().unwrap().uid() == 0;
    assert_eq!(arguments.contains(&"--no-sandbox"), is_root);
    // The profile is the run's own.
    let home = folder.path("jred-");
    let home = format!("--user-data-dir={}", home.display());
    assert!(
        arguments
            .iter()
            .any(|word| word.starts_with(&home) && word.ends_with("/profile"))
    );
}

/// The page and the workbook are written, the old PDF stays.
#[test]
fn a_browser_that_fails_leaves_the_other_documents() {
    let cases = [
        (
            "echo 'no display' >&2; exit 3",
            ["ended with exit status: 3", "no display"],
        ),
        ("kill -9 $$", ["ended with signal: 9", "JRED_BROWSER"]),
        (
            "exit 0",
            ["exit status: 0 and wrote no PDF", "install chromium"],
        ),
    ];
    for (text, says) in cases {
        let folder = Folder::new();
        let browser = program(&folder, text);
        let pdf = folder.file("a.pdf", "old");
        let [html, xlsx] = ["a.html", "a.xlsx"].map(|name| folder.path(name));
        let line = "reduce {} --pdf {} --report {} --xlsx {}";
        let (code, said, printed) = run(line, &[&press_file(), &pdf, &html, &xlsx], &browser);
        assert_eq!((code, printed), (Some(2), true));
        for word in says
            .into_iter()
            .chain(["the PDF cannot be printed", "print it"])
        {
            assert!(said.contains(word), "{word}: {said}");
        }
        assert_eq!(std::fs::read(&pdf).unwrap(), b"old");
        assert_eq!(names(&folder), ["a.html", "a.pdf", "a.xlsx", "browser"]);
    }
}

#[test]
fn without_a_browser_the_error_says_what_to_do() {
    let folder = Folder::new();
    let [html, pdf] = ["a.html", "a.pdf"].map(|name| folder.path(name));
    let missing = folder.path("nowhere/browser");
    let (code, said, printed) = run(
        "reduce {} --pdf {} --report {}",
        &[&press_file(), &pdf, &html],
        &missing,
    );
    assert_eq!((code, printed), (Some(2), true));
    for word in [
        "no browser is found",
        "nowhere",
        "--report in any browser",
        "install chromium",
    ] {
        assert!(said.contains(word), "{word}: {said}");
    }
    assert_eq!(names(&folder), ["a.html"]);
}

/// A browser that does not end is stopped.
#[test]
fn a_browser_has_a_time_limit() {
    let folder = Folder::new();
    let browser = program(&folder, "exec sleep 300");
    let begun = Instant::now();
    let patience = Duration::from_millis(200);
    let path = folder.path("a.pdf");
    let error = browser::printed(&[browser.into()], "<head>", &path, patience).unwrap_err();
    assert!(
        error.to_string().contains("did not end within 0.2 s"),
        "{error}"
    );
    assert!(begun.elapsed() < Duration::from_secs(250));
    assert_eq!(names(&folder), ["browser"]);
}

#[test]
fn a_full_disk_is_reported() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let folder = Folder::new();
    let browser = program(&folder, COPIES);
    for option in ["--pdf", "--xlsx"] {
        let line = format!("reduce {{}} {option} {{}}");
        let (code, said, printed) = run(&line, &[&press_file(), Path::new("/dev/full")], &browser);
        assert_eq!((code, printed), (Some(2), option == "--pdf"));
        for word in ["cannot write /dev/full", "free some space"] {
            assert!(said.contains(word), "{word}: {said}");
        }
    }
}

/// The pages that a PDF has, by their sizes in points. Chromium writes these objects uncompressed.
fn pages(pdf: &[u8]) -> Vec<[i32; 2]> {
    let text = String::from_utf8_lossy(pdf);
    let boxes = text.split("/MediaBox [").skip(1).map(|rest| {
        let rest = rest.split(']').next().unwrap();
        let sides: Vec<f64> = rest
            .split_whitespace()
            .map(|x| x.parse().unwrap())
            .collect();
        [sides[2].round() as i32, sides[3].round() as i32]
    });
    boxes.collect()
}

/// A real browser prints the paper that is asked for, with a landscape page for a wide table. Most machines of CI have none: there the test says so.
#[test]
fn a_real_browser_prints_the_pages() {
    let found = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| {
            let version = Command::new(name)
                .arg("--version")
                .stderr(Stdio::null())
                .output();
            version.is_ok_and(|version| version.status.success())
        });
    let Some(browser) = found else {
        let note = "\nno browser is installed: no page was printed";
        let _ = writeln!(std::io::stderr(), "{note}");
        return;
    };
    // A browser from a snap reads no folder of temporary files.
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let pdf = folder.path().join("a.pdf");
    for (paper, size) in [("a4", [595, 842]), ("letter", [612, 792])] {
        let line = format!("reduce {{}} --pdf {{}} --paper {paper}");
        let machine = shipped("four-bar.toml");
        let (code, said, _) = run(&line, &[&machine, &pdf], Path::new(browser));
        assert_eq!(code, Some(0), "{said}");
        let pages = pages(&std::fs::read(&pdf).unwrap());
        let [width, height] = size;
        let wide = pages
            .iter()
            .filter(|page| **page == [height, width])
            .count();
        let high = pages.iter().filter(|page| **page == size).count();
        assert_eq!((wide, high + 1), (1, pages.len()), "{pages:?}");
        assert!((4..10).contains(&pages.len()), "{pages:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}
