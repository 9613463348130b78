//! The first steps: a new machine file, a machine from standard input, completion, the manual.

use std::io::Write as _;
use std::process::{Command, Stdio};

use crate::support::{COMMANDS, Folder, Run, jred, jred_in, jred_of, shipped};

/// The types that `jred new` lists.
fn types() -> Vec<String> {
    let list = jred([&"new"]).ends(0).out;
    let names = list.lines().filter(|line| line.starts_with("  "));
    let names: Vec<_> = names
        .map(|line| line.split_whitespace().next().unwrap().to_owned())
        .collect();
    assert_eq!(names.len(), 24, "{list}");
    names
}

/// Runs `jred` in a folder with a text on standard input.
fn jred_reads(folder: &Folder, arguments: &[&str], text: &str) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_jred"));
    command
        .current_dir(folder.path(""))
        .env("NO_COLOR", "1")
        .env("JRED_PROGRESS", "never")
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let written = child.stdin.take().unwrap().write_all(text.as_bytes());
    let output = child.wait_with_output().unwrap();
    written.unwrap();
    Run {
        code: output.status.code().unwrap(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

#[test]
fn a_new_machine_of_every_type_is_checked_and_sized() {
    let folder = Folder::new();
    // The curves that `reduced-curves` reads are the user's.
    std::fs::copy(shipped("reduced-curves.csv"), folder.path("curves.csv")).unwrap();
    for kind in types() {
        let text = jred([&"new", &kind]).ends(0).out;
        let file = folder.file(&format!("{kind}.toml"), &text);
        jred([&"check", &file]).ends(0);
        let sized = jred([&"size", &file]).ends(0);
        assert_eq!(sized.err, "", "{kind}");
        assert!(
            sized.out.contains("rules: all satisfied"),
            "{kind}: {}",
            sized.out
        );
        // With all tables as comments it is the same machine.
        let all = jred([&"new", &kind, &"--all"]).ends(0).out;
        assert!(all.len() > text.len() + 5000, "{kind}");
        let again = jred_reads(&folder, &["size", "-"], &all).ends(0);
        assert_eq!(titled(&again.out), titled(&sized.out), "{kind}");
    }
}

/// A listing without its title, the name of the file.
fn titled(listing: &str) -> &str {
    listing.split_once('\n').unwrap().1
}

#[test]
fn a_new_machine_overwrites_nothing_unasked() {
    let folder = Folder::new();
    let path = folder.path("hoist.toml");
    let run = jred_of("new hoist --out {}", [&path]).ends(0);
    assert_eq!(run.out, "");
    run.says(&["machine file written to", "then run `jred size"]);
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text, jred([&"new", &"hoist"]).ends(0).out);
    std::fs::write(&path, "mine").unwrap();
    jred_of("new hoist -o {}", [&path])
        .ends(2)
        .says(&["exists: nothing is written", "--force"]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    jred_of("new hoist --force -o {}", [&path]).ends(0);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    jred([&"new", &"hiost"])
        .ends(2)
        .says(&["invalid value 'hiost' for '[TYPE]'", "'hoist'"]);
}

/// Every command that reads a machine file reads it from standard input, too, with the same answer but for its name.
#[test]
fn a_machine_comes_from_standard_input() {
    let folder = Folder::new();
    for file in [
        "press.toml",
        "scotch-yoke.toml",
        "load-table.toml",
        "load-table.csv",
    ] {
        std::fs::copy(shipped(file), folder.path(file)).unwrap();
    }
    let lines = [
        ("press.toml", "reduce FILE --positions 4"),
        ("press.toml", "check FILE"),
        ("press.toml", "size FILE"),
        (
            "press.toml",
            "vary FILE --vary mechanism.slider.mass=40,42kg",
        ),
        ("press.toml", "ratio FILE --top 2"),
        ("press.toml", "require FILE --ratios 5"),
        (
            "press.toml",
            "sensitivity FILE --drive sgmsh-30a+npt025mf-10 --format csv",
        ),
        ("press.toml", "bus FILE FILE"),
        ("press.toml", "simulate FILE"),
        (
            "press.toml",
            "export FILE --torque-error 1Nm --layout spline",
        ),
        ("press.toml", "gentlest FILE"),
        ("press.toml", "fastest FILE"),
        ("press.toml", "balance FILE --counterweight crank,10kg,50mm"),
        ("scotch-yoke.toml", "steady FILE"),
        // A table that the file names is in the working directory.
        ("load-table.toml", "reduce FILE --positions 4"),
    ];
    for (file, line) in lines {
        let text = std::fs::read_to_string(folder.path(file)).unwrap();
        let named = line.replace("FILE", file);
        let named: Vec<_> = named.split(' ').collect();
        let named = jred_in(&folder.path(""), &named);
        let piped = line.replace("FILE", "-");
        let piped: Vec<_> = piped.split(' ').collect();
        let piped = jred_reads(&folder, &piped, &text);
        assert_eq!(
            piped.code, named.code,
            "{line}\n{}\n{}",
            piped.err, named.err
        );
        assert!(named.code < 2, "{line}\n{}", named.err);
        assert_eq!(
            piped.out.replace("standard input", file),
            named.out,
            "{line}"
        );
    }
}

#[test]
fn faults_of_standard_input_name_it() {
    let folder = Folder::new();
    jred_reads(&folder, &["check", "-"], "gravity = [1")
        .ends(2)
        .says(&["standard input:1:"]);
    jred_reads(&folder, &["size", "-"], "")
        .ends(2)
        .says(&["standard input is empty"]);
    jred_reads(
        &folder,
        &[
            "balance",
            "-",
            "--least",
            "rms",
            "--counterweight",
            "crank,1kg,50mm",
        ],
        &shipped_text(),
    )
    .ends(2)
    .says(&["standard input"]);
    let large = "#".repeat((1 << 20) + 1);
    jred_reads(&folder, &["check", "-"], &large)
        .ends(2)
        .says(&["cannot read the machine file standard input: it has more than 1 MiB"]);
}

/// A machine without a motion.
fn shipped_text() -> String {
    let text = std::fs::read_to_string(shipped("scotch-yoke.toml")).unwrap();
    text.split("[motion]").next().unwrap().to_owned()
}

/// Standard input may be redirected from a file, which no output overwrites.
#[cfg(unix)]
#[test]
fn the_file_behind_standard_input_is_not_overwritten() {
    let folder = Folder::new();
    let path = folder.path("press.toml");
    std::fs::copy(shipped("press.toml"), &path).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_jred"))
        .current_dir(folder.path(""))
        .args(["size", "-", "--report", "press.toml"])
        .stdin(std::fs::File::open(&path).unwrap())
        .output()
        .unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.contains("not overwritten"), "{err}");
    assert!(std::fs::read_to_string(&path).unwrap().contains("gravity"));
}

#[test]
fn without_arguments_the_first_steps_are_shown() {
    let run = jred([]).ends(2);
    assert_eq!(run.out, "");
    let folder = Folder::new();
    let steps: Vec<_> = run
        .err
        .lines()
        .filter(|line| line.starts_with("  jred "))
        .collect();
    assert_eq!(steps.len(), 3, "{}", run.err);
    // They run as shown.
    for step in steps {
        let (command, _) = step.trim().split_once("   ").unwrap();
        let words: Vec<_> = command.split(' ').skip(1).collect();
        jred_in(&folder.path(""), &words).ends(0);
    }
    let page = std::fs::read_to_string(folder.path("press.html")).unwrap();
    assert!(page.contains("<svg"));
    run.says(&["jred --help"]);
}

#[test]
fn a_completion_knows_every_command_and_type() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = jred([&"completion", &shell]).ends(0).out;
        for command in COMMANDS {
            assert!(script.contains(command), "{shell} lacks {command}");
        }
        assert!(
            script.contains("--torque-error") || script.contains("torque-error"),
            "{shell}"
        );
        // Two of the shells complete values as well.
        let values = ["bash", "zsh"].contains(&shell);
        assert!(
            !values || script.contains("inverted-slider-crank"),
            "{shell}"
        );
    }
    let script = jred([&"completion", &"bash"]).ends(0).out;
    let mut bash = Command::new("bash");
    // Where there is no bash, its syntax is not checked.
    if let Ok(mut child) = bash.arg("-n").stdin(Stdio::piped()).spawn() {
        child
            .stdin
            .take()
            .unwrap()
            .write_all(script.as_bytes())
            .unwrap();
        assert!(child.wait().unwrap().success());
    }
    jred([&"completion", &"tcsh"]).ends(2).says(&["bash"]);
}

#[test]
fn every_command_has_a_manual_page() {
    let page = jred([&"man"]).ends(0).out;
    assert!(
        page.contains(".TH jred 1") && page.contains("Exit codes"),
        "{page}"
    );
    let folder = Folder::new();
    jred_of("man --out {}", [&folder.path("")]).ends(0);
    assert_eq!(
        std::fs::read_to_string(folder.path("jred.1")).unwrap(),
        page
    );
    for command in COMMANDS.iter().chain(&["catalogue-check"]) {
        let page = std::fs::read_to_string(folder.path(&format!("jred-{command}.1"))).unwrap();
        assert!(page.contains("\n.SH OPTIONS\n"), "{command}");
    }
    jred_of("man --out {}", [&folder.path("missing")])
        .ends(2)
        .says(&["cannot write", "make the folder first"]);
}

/// A machine that falls asks for a brake, unless the rule is off: of any maker, and of a motor whose brake nobody describes.
#[test]
fn a_brake_is_asked_for_by_its_rule() {
    let folder = Folder::new();
    let hoist = jred([&"new", &"hoist"]).ends(0).out;
    let off = format!("{hoist}\n[rules]\nbrake_torque = \"off\"\n");
    let asked = jred_reads(&folder, &["require", "-", "--ratios", "50"], &hoist).ends(0);
    assert!(
        asked.out.contains("the machine moves without current"),
        "{}",
        asked.out
    );
    let line = ["require", "-", "--ratios", "50"];
    let run = jred_reads(&folder, &line, &off).ends(0);
    assert!(
        run.out
            .contains("not asked for: brake_torque is off in [rules]"),
        "{}",
        run.out
    );
    assert!(!run.out.contains("with brake"), "{}", run.out);
    let json = jred_reads(&folder, &[&line[..], &["--format", "json"]].concat(), &off).json();
    assert!(!json.to_string().contains("\"brake torque\":1"), "{json}");
    // With the option of a brake whose torque nobody states, a motor is suitable, and the rule is not checked.
    let motors = |option: &str| {
        format!(
            "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],brake_option,source\n\
             m1,Maker,Model,9,3000,36,8.5,{option},Sheet\n"
        )
    };
    for option in ["yes", ""] {
        folder.file("motors.csv", motors(option));
        let run = jred_reads(
            &folder,
            &["size", "-", "--motors", "motors.csv", "--full"],
            &hoist,
        );
        let run = run.ends(0);
        assert!(run.out.contains("brake torque"), "{}", run.out);
    }
}

/// A gearbox may be so light that its inertia is left out; a negative one is a mistake.
#[test]
fn a_gearbox_may_have_no_inertia() {
    let folder = Folder::new();
    let press = std::fs::read_to_string(shipped("press.toml")).unwrap();
    for line in [["ratio", "-", "--top=2"], ["require", "-", "--ratios=5"]] {
        let ask = |inertia: &str| {
            let option = format!("--gearbox-inertia={inertia}");
            jred_reads(&folder, &[&line[..], &[&option]].concat(), &press)
        };
        let without = jred_reads(&folder, &line, &press).ends(0);
        assert_eq!(ask("0 kg m^2").ends(0).out, without.out);
        assert_ne!(ask("20 kg cm^2").ends(0).out, without.out);
        ask("-1 kg cm^2").ends(2).says(&["it must be zero or more"]);
    }
}
