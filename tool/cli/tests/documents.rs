//! Workbooks and PDFs of answers.
// Copied figures are exact.
#![allow(clippy::float_cmp)]

#[cfg(unix)]
mod browser;

use std::collections::BTreeSet;
use std::path::Path;

use calamine::{Data, Range, Reader as _, Xlsx, open_workbook};

use crate::support::{Folder, jred_of, press_file, shipped};

/// The sheets of a workbook in their order.
fn sheets(path: &Path) -> Vec<(String, Range<Data>)> {
    let mut book: Xlsx<_> = open_workbook(path).unwrap();
    book.worksheets()
}

/// The rows of a CSV.
fn rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(text.as_bytes());
    let records = reader.records();
    records
        .map(|row| row.unwrap().iter().map(str::to_owned).collect())
        .collect()
}

fn text(sheet: &Range<Data>, row: usize, column: usize) -> String {
    sheet
        .get((row, column))
        .map_or_else(String::new, ToString::to_string)
}

/// Commands that write a workbook.
const COMMANDS: [(&str, &str); 8] = [
    ("reduce {}", "press.toml"),
    ("reduce {} --reactions --over time", "linkage-press.toml"),
    ("size {} --nearest 2", "press.toml"),
    ("require {}", "press.toml"),
    ("steady {} --delta 5%", "eccentric-press.toml"),
    ("simulate {}", "vertical-axis.toml"),
    ("gentlest {}", "press.toml"),
    (
        "fastest {} --torque '60 N m' --motor-speed '3000 rpm' --instants 11",
        "press.toml",
    ),
];

/// One sheet has every cell of the CSV: numbers as the same numbers, words as words. All names of sheets differ.
#[test]
fn a_workbook_has_the_values_of_the_csv() {
    let folder = Folder::new();
    for (line, machine) in COMMANDS {
        let machine = shipped(machine);
        let path = folder.path("answer.xlsx");
        let run = jred_of(&format!("{line} --xlsx {{}}"), [&machine, &path]);
        assert!(run.code < 2, "{}", run.err);
        let csv = jred_of(&format!("{line} --format csv"), [&machine]);
        let rows = rows(&csv.out);
        let sheets = sheets(&path);
        assert_eq!(sheets[0].0, "summary", "{line}");
        let names: BTreeSet<String> = sheets.iter().map(|(name, _)| name.to_lowercase()).collect();
        assert_eq!(names.len(), sheets.len(), "{line}");
        let has_heads = |sheet: &Range<Data>| {
            let heads = rows[0].iter().enumerate();
            heads.clone().all(|(k, head)| text(sheet, 0, k) == *head)
        };
        let (name, sheet) = sheets
            .iter()
            .find(|(_, sheet)| has_heads(sheet))
            .expect(line);
        assert_eq!(sheet.height(), rows.len(), "{line}: {name}");
        let mut numbers = 0;
        for (k, row) in rows.iter().enumerate() {
            for (column, cell) in row.iter().enumerate() {
                match (sheet.get((k, column)), cell.parse::<f64>()) {
                    (None | Some(Data::Empty), _) => assert_eq!(cell, "", "{line}: {k} {column}"),
                    (Some(Data::Float(x)), Ok(y)) => {
                        numbers += 1;
                        assert_eq!(x.to_bits(), (y + 0.0).to_bits(), "{line}: {k} {column}");
                    }
                    (Some(Data::String(text)), Err(_)) => assert_eq!(text, cell),
                    // A number in a column of words, such as "inf" or a key.
                    (Some(Data::String(text)), Ok(y)) => {
                        let words = |row: &Vec<String>| {
                            !row[column].is_empty() && row[column].parse::<f64>().is_err()
                        };
                        assert!(
                            rows[1..].iter().any(words) || !y.is_finite(),
                            "{line}: {text}"
                        );
                    }
                    other => panic!("{line}: {k} {column}: {other:?}"),
                }
            }
        }
        assert!(numbers > 20, "{line}: {numbers}");
    }
}

/// The rules of the best drive: figure and limit are numbers with their unit beside them, the share has its unit in the head, verdicts are words.
#[test]
fn the_rules_of_a_drive_on_a_sheet() {
    let folder = Folder::new();
    let path = folder.path("size.xlsx");
    let run = jred_of("size {} --xlsx {}", [&press_file(), &path]).ends(0);
    assert!(run.out.contains("workbook written to"));
    let sheets = sheets(&path);
    let (_, rules) = sheets.iter().find(|(name, _)| name == "Rules").unwrap();
    let heads: Vec<String> = (0..rules.width()).map(|k| text(rules, 0, k)).collect();
    assert_eq!(
        heads[..6],
        [
            "rule",
            "figure",
            "figure, unit",
            "limit",
            "limit, unit",
            "used [%]"
        ]
    );
    let verdict = heads.iter().position(|head| head == "verdict").unwrap();
    let csv = rows(&jred_of("size {} --format csv", [&press_file()]).out);
    let of = |name: &str| csv[0].iter().position(|head| head == name).unwrap();
    let (mut compared, mut words) = (0, BTreeSet::new());
    for row in 1..rules.height() {
        let rule = text(rules, row, 0);
        let own = csv
            .iter()
            .find(|line| line[of("rank")] == "1" && line[of("rule")] == rule);
        let own = own.unwrap_or_else(|| panic!("{rule}"));
        words.insert(text(rules, row, verdict));
        for (column, name) in [(1, "figure"), (3, "limit")] {
            let (Some(Data::Float(shown)), Ok(exact)) =
                (rules.get((row, column)), own[of(name)].parse::<f64>())
            else {
                continue;
            };
            if text(rules, row, column + 1) != own[of("unit")] {
                continue; // a share, shown in per cent
            }
            assert!(
                (shown / exact - 1.0).abs() < 6e-4,
                "{rule}: {shown} {exact}"
            );
            compared += 1;
        }
    }
    assert!(compared > 15, "{compared}");
    assert!(
        words.contains("ok") && words.contains("warning"),
        "{words:?}"
    );
    // The ranking and its numbers.
    let ranked = sheets
        .iter()
        .find(|(_, sheet)| text(sheet, 0, 0) == "rank")
        .unwrap();
    assert_eq!(ranked.1.get((1, 0)), Some(&Data::Float(1.0)));
}

/// `--paper` changes the page; without a page it is refused, and so is a workbook that would not be written.
#[test]
fn paper_and_refusals() {
    let folder = Folder::new();
    let path = folder.path("page.html");
    for (paper, is_letter) in [
        ("", false),
        (" --paper a4", false),
        (" --paper letter", true),
    ] {
        jred_of(
            &format!("reduce {{}} --report {{}}{paper}"),
            [&press_file(), &path],
        )
        .ends(0);
        let page = std::fs::read_to_string(&path).unwrap();
        assert!(page.contains("size: A4;") && page.contains("counter(pages)"));
        assert_eq!(page.contains("size: letter;"), is_letter);
        assert_eq!(
            page.matches("<table").count(),
            page.matches("<thead>").count()
        );
    }
    jred_of("reduce {} --pdf {}", [&press_file(), &path])
        .ends(2)
        .says(&["does not write a file of the kind .html", "--report"]);
    jred_of("reduce {} --paper a4", [&press_file()])
        .ends(2)
        .says(&["--report", "--pdf"]);
    for option in ["--xlsx", "--pdf"] {
        let line = format!("size {{}} --pareto mass,energy {option} {{}}");
        jred_of(&line, [&press_file(), &folder.path("answer")])
            .ends(2)
            .says(&["--pareto", option]);
        let missing = folder.path("nowhere/answer");
        let line = format!("reduce {{}} {option} {{}}");
        jred_of(&line, [&press_file(), &missing])
            .ends(2)
            .says(&["nowhere/answer", "make the folder first"]);
    }
}

/// The title is in the style sheet, too, where none of its letters may end a string or the sheet.
#[test]
fn a_title_stays_within_its_string() {
    let folder = Folder::new();
    let file = folder.file(
        "m.toml",
        crate::support::edited_press("title = \"", "title = \"</style>\\\"} \\\\ é "),
    );
    let path = folder.path("page.html");
    jred_of("size {} --report {}", [&file, &path]).ends(0);
    let page = std::fs::read_to_string(&path).unwrap();
    // </style>"} \ é
    assert!(page.contains("content: \"\\3c \\2f \\73 \\74 \\79 \\6c \\65 \\3e \\22 \\7d \\20 \\5c \\20 \\e9 \\20 \\53 "));
    assert_eq!(page.matches("</style>").count(), 1);
}
