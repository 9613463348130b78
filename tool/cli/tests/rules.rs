//! `jred rules`, and rule sets named on the command line.

use crate::support::{Folder, jred, press_file, press_text};
use jred_file::read as machine_file;

/// An unusable rule set of the user is refused with its file.
#[test]
fn a_wrong_set_of_ones_own() {
    let folder = Folder::new();
    for (text, words) in [
        (
            "title = \"x\"\n[rules]\nrms_torq = \"60 %\"\n",
            &["rms_torq", "did you mean"][..],
        ),
        (
            "title = \"x\"\nbased_on = \"fanux\"\n[rules]\n",
            &["fanux", "fanuc"],
        ),
        ("[rules]\n", &["title"]),
        (
            "title = \"x\"\n[rules]\nrms_torque = \"60\n",
            &["not valid TOML"],
        ),
    ] {
        folder.file("wrong.toml", text);
        let path = folder.path("wrong.toml");
        let run = jred([&"size", &press_file(), &"--rules", &path]).ends(2);
        run.says(words);
        run.says(&["wrong.toml"]);
    }
}

/// The command line: another set; entries of the file are kept; the sets are listed with their sources.
#[test]
fn the_command_line() {
    let folder = Folder::new();
    let file = folder.file(
        "m.toml",
        press_text() + "\n[rules]\ninertia_ratio_warning = 4\n",
    );
    let run = jred([&"size", &file, &"--rules", &"fanuc"]);
    assert!(run.code == 0 || run.code == 1, "{}", run.err);
    // With a limit of 3 the file's warning at 4 is too late.
    let run = jred([&"size", &file, &"--rules", &"fanuc-contouring"]).ends(2);
    run.says(&["contradicts the set", "inertia_ratio_warning", "above"]);
    jred([&"size", &file, &"--rules", &"fanux"])
        .ends(2)
        .says(&["did you mean \"fanuc\"?"]);

    let list = jred([&"rules"]).ends(0).out;
    for name in machine_file::rule_set_names() {
        assert!(list.contains(name), "{name}");
    }
    let one = jred([&"rules", &"fanuc"]).ends(0).out;
    for word in [
        "constant_torque",
        "70 %",
        "B-65262EN/03",
        "at least 10",
        "largest λ",
    ] {
        assert!(one.contains(word), "{word:?} is not in\n{one}");
    }
    let json = jred([&"rules", &"mitsubishi-mr-j2s", &"--format", &"json"])
        .ends(0)
        .json();
    assert_eq!(json["choices"]["inertia_ratio_by_moves"][1]["limit"], 3.0);
    assert_eq!(json["choices"]["inertia_ratio_of"], "max");
    let csv = jred([&"rules", &"general", &"--format", &"csv"])
        .ends(0)
        .out;
    assert!(
        csv.starts_with("rule,key,limit,warning,unit,sense,state,source\nRMS torque,rms_torque,80,,%,at most,on,"),
        "{csv}"
    );
    assert_eq!(
        jred([&"rules", &"--format", &"json"]).ends(0).json()["rule sets"]
            .as_array()
            .unwrap()
            .len(),
        machine_file::rule_set_names().count()
    );
    assert_eq!(
        jred([&"rules", &"--format", &"csv"])
            .ends(0)
            .out
            .lines()
            .count(),
        1 + machine_file::rule_set_names().count()
    );
    jred([&"rules", &"nothing"])
        .ends(2)
        .says(&["there is no rule set \"nothing\""]);
}
