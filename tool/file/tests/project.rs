//! Project files, the title block, and the entries of a file as the user wrote them.

use jred_file::read::project;
use jred_file::text::entries::entries;

use crate::reading::{rendered, says};
use crate::support::press_text;

const PROJECT: &str = r#"
title = "Line"
bus = "separate"

[document]
author = "A. Miller"
revision = "B"

[supply]
mains_voltage = "400 V"

[[axis]]
machine = "axes/press.toml"
phase = "0 s"

[[axis]]
name = "feed"
machine = "feed.toml"
quantity = 3
phase = "120 ms"
drive = "m+g"
"#;

#[test]
fn a_project_is_read() {
    let project = project("line.toml", PROJECT).unwrap();
    assert_eq!(project.title, "Line");
    assert!(!project.common_bus);
    let document: Vec<_> = project.document.entries().collect();
    assert_eq!(document, [("author", "A. Miller"), ("revision", "B")]);
    assert_eq!(project.site.mains_voltage, Some(400.0));
    let [press, feed] = project.axes.as_slice() else {
        panic!("{project:?}")
    };
    assert_eq!(
        (press.name.as_str(), press.quantity, press.phase),
        ("press", 1, Some(0.0))
    );
    assert_eq!(
        (feed.name.as_str(), feed.quantity, feed.phase),
        ("feed", 3, Some(0.12))
    );
    assert_eq!(feed.drive.as_deref(), Some("m+g"));
}

#[test]
fn faults_of_a_project_are_shown() {
    for (text, words) in [
        (
            PROJECT.replace("quantity = 3", "quantity = 0"),
            ["quantity", "line.toml"],
        ),
        (
            PROJECT.replace("phase = \"120 ms\"\n", ""),
            ["`phase` is given for some axes", "phase = \"0 s\""],
        ),
        (
            PROJECT.replace("name = \"feed\"", "name = \"press\""),
            ["two axes are called \"press\"", "`quantity`"],
        ),
        (
            PROJECT.replace("machine = \"feed.toml\"\n", ""),
            ["machine", "[[axis]]"],
        ),
        (PROJECT.replace("quantity", "count"), ["count", "[[axis]]"]),
        (
            press_text(),
            ["is a machine file, not a project", "jred size"],
        ),
    ] {
        let fault = project("line.toml", &text).expect_err(&text);
        says(&rendered(&fault), &words);
    }
}

/// Every way to write tables; the order and the remarks are those of the file.
#[test]
fn entries_are_as_the_user_wrote_them() {
    let text = "title = \"A # B\" # a remark\n[motion] # of a header\ntype = 'cycle'\n\n[[motion.segment]]\nmove = \"360 deg\"\n\
                [[motion.segment]]\ndwell = \"0.1 s\"   #  to feed\n[mechanism]\npivot = [\"1 mm\", # here\n  \"2 mm\"]\n\
                driver = { teeth = 18, inertia = \"2 kg cm^2\" }\nrod.length = \"3 m\"\nratio = 2.50\n";
    let found: Vec<[String; 3]> = (entries(text).unwrap().into_iter())
        .map(|entry| [entry.path, entry.value, entry.remark])
        .collect();
    let expected = [
        ["title", "A # B", "a remark"],
        ["motion.type", "cycle", ""],
        ["motion.segment.1.move", "360 deg", ""],
        ["motion.segment.2.dwell", "0.1 s", "to feed"],
        ["mechanism.pivot", "[1 mm, 2 mm]", ""],
        [
            "mechanism.driver",
            "{ teeth = 18, inertia = 2 kg cm^2 }",
            "",
        ],
        ["mechanism.rod.length", "3 m", ""],
        ["mechanism.ratio", "2.50", ""],
    ];
    assert_eq!(found, expected.map(|row| row.map(str::to_owned)));
}
