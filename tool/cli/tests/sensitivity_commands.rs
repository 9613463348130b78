//! Output of `jred sensitivity` and `jred tolerance`.

use std::path::Path;

use crate::support::{Folder, jred, jred_of, press_text, study_rows, typed};

const RACK: &str = include_str!("../../../machines/rack.toml");

/// The command lists what the library finds, in CSV every rule.
#[test]
fn the_command_lists_quantities() {
    let folder = Folder::new();
    let rack = folder.file("rack.toml", RACK);
    let run = jred_of("sensitivity {} --steps 64 --most 5 --format csv", [&rack]);
    let names = run.out.lines().next().unwrap();
    assert!(
        names.starts_with("quantity,value,unit,affects most,slope [% of limit per +1 %]"),
        "{names}"
    );
    assert!(
        names.contains("peak torque [% of limit per +1 %]"),
        "{names}"
    );
    assert!(
        run.out
            .lines()
            .any(|line| line.starts_with("mechanism.rack.mass,85,kg,")),
        "{}",
        run.out
    );
    let run = jred([&"sensitivity", &rack, &"--steps", &"64", &"--most", &"5"]);
    assert!(
        run.out
            .contains("not varied: gravity.1: zero has no relative change"),
        "{}",
        run.out
    );
}

/// Quantities without effect are counted, not listed; three digits, no rounding noise, no line wider than a page.
#[test]
fn the_table_leaves_out_what_moves_nothing() {
    let folder = Folder::new();
    let text = RACK.to_owned()
        + "\n[simulation]\nstart_angle = \"0 deg\"\nduration = \"1 s\"\nstart_speed = \"0 rpm\"\noutput_step = \"0.1 s\"\ntorque = \"1 N m\"\n"
        + "\n[tolerance]\n\"rack.mass\" = \"2 kg\"\n";
    let rack = folder.file("rack.toml", text);
    let out = |format: &str| {
        let run = jred_of(
            "sensitivity {} --steps 64 --most 5 --format {}",
            [&rack, &format],
        );
        run.ends(0).out
    };
    let (table, csv) = (out("table"), out("csv"));
    assert!(
        table.contains("5 quantities in [simulation] and [tolerance] left out"),
        "{table}"
    );
    assert!(
        !table.contains("simulation.")
            && !csv.contains("simulation.")
            && !csv.contains("tolerance.")
    );
    let rows = table.lines().skip(3).take_while(|line| {
        !line.starts_with("first violation") && !line.starts_with("no single quantity")
    });
    let rows: Vec<&str> = rows.collect();
    assert!(rows.len() > 3);
    for row in rows {
        assert!(row.chars().count() <= 120, "{row}");
        assert!(!row.contains("nothing") && !row.contains("e-"), "{row}");
        // The first number is the value in the file.
        let numbers = row
            .split_whitespace()
            .filter(|cell| cell.parse::<f64>().is_ok());
        for cell in numbers.skip(1) {
            let digits = cell
                .trim_start_matches(['-', '0', '.'])
                .chars()
                .filter(char::is_ascii_digit);
            assert!(digits.count() <= 3, "{cell} in {row}");
        }
    }
    // Gravity is across the axis: in CSV with a slope of zero, in the table only its name.
    assert!(
        csv.lines()
            .any(|line| line.starts_with("gravity.2,") && line.contains(",nothing,")),
        "{csv}"
    );
    let idle = table
        .lines()
        .find(|line| line.contains("affect no rule"))
        .unwrap();
    assert!(idle.contains("gravity.2"), "{idle}");
}

/// The command: the table of the file, shares with the rows of the whole, a summary of a complete file.
#[test]
fn the_command_sums_up_shares_as_one_run() {
    let folder = Folder::new();
    let text = press_text()
        + "\n[tolerance]\n\"slider.mass\" = \"±5 %\"\n\"crank.length\" = { normal = \"0.1 mm\" }\n";
    let press = folder.file("press.toml", text);
    let whole = folder.path("whole.csv");
    let run = |out: &Path, more: &[&str], code: i32| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_jred"));
        command.arg("tolerance").arg(&press).args(typed(
            "--samples 60 --steps 64 --tolerance drive_train.1.belt_mass=10%",
        ));
        let output = command.args(more).arg("--out").arg(out).output().unwrap();
        assert!(
            output.status.code() == Some(code) || code < 0,
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).unwrap()
    };
    let summary = run(&whole, &[], -1);
    assert!(
        summary.contains("60 machines, seed 1") && summary.contains("every rule"),
        "{summary}"
    );
    assert!(
        summary.contains("mechanism.slider.mass uniform ± 2.1 kg"),
        "{summary}"
    );
    assert!(
        summary.contains("mechanism.crank.length normal ± 0.1 mm"),
        "{summary}"
    );
    let names: Vec<String> = (0..2).map(|k| format!("part-{k}.csv")).collect();
    for (k, name) in names.iter().enumerate() {
        let part = folder.path(name);
        let share = run(&part, &["--shard", &format!("{k}/2")], -1);
        assert!(
            share.contains("30 machines") && share.contains("one share"),
            "{share}"
        );
    }
    assert_eq!(
        study_rows(&folder, &names),
        study_rows(&folder, &["whole.csv".to_owned()])
    );
    assert_eq!(run(&whole, &["--resume"], -1), summary);
    // Another seed is another study.
    let other = run(&whole, &["--resume", "--seed", "2"], 2);
    assert!(other.is_empty(), "{other}");
}

/// Samples that cannot be built are counted separately: the share that satisfies a rule is that of the other rows.
#[test]
fn draws_that_cannot_be_built_are_counted_apart() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let out = folder.path("rows.csv");
    // A crank longer than the rod cannot turn.
    let run = jred_of("tolerance {} --steps 64 --samples 80 --seed 3 --tolerance crank.length=normal:100mm --out {}", [&press, &out])
    .ends(1);
    let text = std::fs::read_to_string(&out).unwrap();
    let refused = text
        .lines()
        .filter(|line| line.contains("machine refused"))
        .count();
    assert!((5..75).contains(&refused), "{refused}");
    let built = 80 - refused;
    let words = format!("because they cannot be built: {refused} of 80 machines drawn");
    assert!(run.out.contains(&words), "{words}: {}", run.out);
    assert!(
        run.out.contains(&format!("shares are of {built} machines")),
        "{}",
        run.out
    );
    // The speed does not depend on the crank: its rule is satisfied in all samples that could be built.
    let speed = run
        .out
        .lines()
        .find(|line| line.starts_with(" speed"))
        .unwrap();
    assert_eq!(speed.split_whitespace().nth(1), Some("100"), "{speed}");
    let header: Vec<&str> = run
        .out
        .lines()
        .skip(1)
        .take_while(|line| !line.contains('─'))
        .collect();
    let header = header.join(" ");
    for word in ["95 %", "use at", "machines", "interval"] {
        assert!(header.contains(word), "{word}: {header}");
    }
    let csv = jred_of(
        "tolerance {} --steps 16 --samples 2 --tolerance slider.mass=5% --format csv",
        [&press],
    );
    assert!(csv.out.starts_with("rule,machines that hold it [%],surely above [%],surely below [%],5 % of machines use at most,"), "{}", csv.out);
    for line in run.out.lines().skip(1).take(16) {
        assert!(line.chars().count() <= 120, "{line}");
    }
}

#[test]
fn wrong_tolerances_are_said() {
    let folder = Folder::new();
    let press =
        |line: &str| folder.file("press.toml", press_text() + "\n[tolerance]\n" + line + "\n");
    let says = |line: &str, words: &[&str]| jred([&"tolerance", &press(line)]).ends(2).says(words);
    says(
        "\"slider.mass\" = \"5\"",
        &["has no unit", "write \"±5 %\""],
    );
    says("\"slider.mass\" = \"-5 %\"", &["must be greater than zero"]);
    says(
        "\"slider.mass\" = \"5 mm\"",
        &["mechanism.slider.mass", "42 kg", "cannot be 5 mm"],
    );
    says(
        "\"slider.mas\" = \"5 %\"",
        &[
            "no quantity \"slider.mas\"",
            "did you mean \"slider.mass\"?",
        ],
    );
    says(
        "\"slider.mass\" = { gauss = \"5 %\" }",
        &["unknown key `gauss`"],
    );
    says("\"slider.mass\" = 5", &["must be a text"]);
    says("\"gravity.2\" = \"5 %\"", &["is a share of zero"]);
    let none = folder.file("none.toml", press_text());
    jred([&"tolerance", &none])
        .ends(2)
        .says(&["no quantity has a tolerance", "[tolerance]"]);
    let argument = jred([&"tolerance", &none, &"--tolerance", &"slider.mass"]);
    argument.ends(2).says(&["has no \"=\""]);
    let drive = jred([&"sensitivity", &none, &"--drive", &"sgmsh-10"]);
    drive.ends(2).says(&["no \"sgmsh-10\"", "did you mean"]);
}
