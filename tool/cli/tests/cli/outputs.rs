//! `jred size`: options without effect or in conflict are refused before anything is written.

use serde_json::Value;

use crate::support::{Folder, jred, jred_of, jred_with, press_file};

/// The built-in catalogue has no masses of motors: a filter by mass leaves nothing, and no page is written.
#[test]
fn a_filter_that_leaves_nothing_is_an_error() {
    let folder = Folder::new();
    let page = folder.path("r.html");
    let run = jred_of(
        "size {} --steps 64 --max-mass 0.05kg --report {}",
        [&press_file(), &page],
    )
    .ends(2);
    run.says(&[
        "possible drives passes the filter",
        "drives left out: no data for the mass",
        "widen or remove --max-mass",
    ]);
    assert!(run.out.is_empty() && !page.exists(), "{}", run.out);
}

/// The front has neither a list nor a drive to explain.
#[test]
fn the_front_refuses_what_it_does_not_do() {
    let folder = Folder::new();
    let page = folder.path("r.html");
    let page = page.to_str().unwrap();
    for more in [
        &["--report", page][..],
        &["--meter", page],
        &["--why", "fxm33-30a"],
        &["--explain"],
        &["--refused"],
        &["--all"],
        &["--top", "3"],
        &["--nearest", "3"],
        &["--rank", "energy"],
    ] {
        let press = press_file();
        let press = press.to_str().unwrap();
        let front = ["size", press, "--pareto", "power,energy"];
        let run = jred_with(&[&front, more].concat()).ends(2);
        run.says(&["--pareto", more[0], "cannot be used with"]);
    }
    assert!(!folder.path("r.html").exists());
}

/// If no suitable drive has data for an objective, the answer names it instead of an empty front.
#[test]
fn the_front_names_what_is_known_of_none() {
    let press = press_file();
    let run = jred_of("size {} --steps 64 --pareto price,energy", [&press]).ends(2);
    let json = jred([&"size", &press, &"--steps", &"64", &"--format", &"json"])
        .ends(0)
        .json();
    let fit = &json["counts"]["fit"];
    run.says(&[
        &format!("{fit} drives are suitable, but none has data for the price"),
        "use another objective",
    ]);
    assert!(run.out.is_empty(), "{}", run.out);
    assert!(!run.message().contains("energy is"), "{}", run.err);
}

/// In CSV the requested drive comes first with its rank, in the list or not, and only once.
#[test]
fn csv_begins_with_the_drive_asked_for() {
    let press = press_file();
    // Motors of every class of certainty; the whole catalogue would be 100 MB of JSON.
    let some = ["size", press.to_str().unwrap(), "--steps", "64"];
    let motors = ["--motor", "fxm*", "--motor", "sgm7a*", "--motor", "mc20-1*"];
    let size = |more: &[&str]| jred_with(&[&some, &motors[..], more].concat()).ends(0);
    let json = size(&["--all", "--format", "json"]).json();
    let asked = |drive: &Value, rank: &str| {
        let [motor, gearbox] = ["motor", "gearbox"].map(|key| drive[key].as_str().unwrap_or(""));
        let name = format!("{motor}+{gearbox}");
        let name = name.trim_end_matches('+').to_owned();
        let run = size(&[
            "--all-gearboxes",
            "--top",
            "3",
            "--format",
            "csv",
            "--why",
            &name,
        ]);
        let start = format!("{rank},{motor},{gearbox},");
        let rows: Vec<&str> = run.out.lines().skip(1).collect();
        let own = format!(",{motor},{gearbox},");
        let count = drive["checks"].as_array().unwrap().len();
        let (first, rest) = rows.split_at(count);
        assert!(first.iter().all(|row| row.starts_with(&start)), "{first:?}");
        assert!(!rest.iter().any(|row| row.contains(&own)), "{rest:?}");
        let mut ranks: Vec<&str> = rest.iter().map(|r| r.split(',').next().unwrap()).collect();
        ranks.dedup();
        ranks.into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    // The first of each class of certainty is below the list.
    let firsts = json["certainties"].as_array().unwrap().iter();
    let below = firsts.map(|class| class["rank"].as_u64().unwrap());
    let below: Vec<String> = below
        .filter(|rank| *rank > 3)
        .map(|rank| rank.to_string())
        .collect();
    assert_eq!(below.len(), 2);
    let with =
        |listed: &[&'static str]| -> Vec<&str> { [listed, &[&below[0], &below[1], ""]].concat() };
    // In the list, after it, or refused: the other drives keep their ranks.
    assert_eq!(asked(&json["fit"][1], "2"), with(&["1", "3"]));
    assert_eq!(asked(&json["fit"][4], "5"), with(&["1", "2", "3"]));
    assert_eq!(asked(&json["refused"][9], ""), with(&["1", "2", "3"]));
}

/// Two outputs must be two files; stdout is not one of them.
#[test]
fn outputs_are_files_of_their_own() {
    let folder = Folder::new();
    let press = press_file();
    let one = folder.path("one");
    let again = folder.path(".").join("one");
    let run = jred([&"size", &press, &"--report", &one, &"--meter", &again]).ends(2);
    run.says(&["--report and --meter both name", "use two different files"]);
    assert!(!one.exists());
    for option in ["--report", "--meter"] {
        let run = jred([&"size", &press, &option, &"-"]).ends(2);
        run.says(&[option, "stdout is used for the result", "name a file"]);
    }
    let run = jred_of("export {} --torque-error '1 N m' --out -", [&press]).ends(2);
    run.says(&["stdout is used for the result"]);
}

/// A drive removed by a filter is not reported as missing from the catalogue.
#[test]
fn a_drive_that_the_filter_took_out() {
    let press = press_file();
    let press = press.to_str().unwrap();
    let why = ["size", press, "--steps", "64", "--why", "fxm33-30a"];
    let run = jred_with(&[&why[..], &["--motor", "sgm*"]].concat()).ends(2);
    run.says(&[
        "there is no drive \"fxm33-30a\"",
        "drives pass the filter",
        "without --motor, every drive is considered",
    ]);
    assert!(jred_with(&why).ends(0).err.is_empty());
}

/// `--top 1` in CSV: the rules of one ranked drive, of the first drives of the three other classes of certainty, and of the closest refused drives,
/// which `--nearest 0` leaves out.
#[test]
fn the_closest_refused_drives_can_be_left_out() {
    let press = press_file();
    let drives = |nearest: &str| {
        let form = ["--top", "1", "--nearest", nearest, "--format", "csv"];
        let press = press.to_str().unwrap();
        let run = jred_with(&[&["size", press, "--steps", "64"], &form[..]].concat()).ends(0);
        let lines = run.out.lines().skip(1);
        let names = lines.map(|line| line.split(',').take(4).collect::<Vec<_>>().join(","));
        let names: std::collections::BTreeSet<String> = names.collect();
        let ranked = names.iter().filter(|name| name.starts_with("1,")).count();
        (ranked, names.len() - ranked)
    };
    assert_eq!(drives("0"), (1, 3));
    assert_eq!(drives("3"), (1, 6));
}
