//! The text of the HTML pages, without drawings, charts and scripts.

use super::{Desk, compare};

/// The visible text of the page, one line per element.
fn read(html: &str) -> String {
    let mut text = String::new();
    let mut rest = html;
    while let Some(start) = rest.find('<') {
        text += &rest[..start];
        rest = &rest[start..];
        // Hidden parts: styles, scripts, drawings.
        let hidden = ["style", "script", "svg"]
            .into_iter()
            .find(|tag| rest[1..].starts_with(tag));
        let end = match hidden {
            Some(tag) => format!("</{tag}>"),
            None => ">".to_owned(),
        };
        let after = rest.find(&end).unwrap() + end.len();
        let tag = &rest[..after];
        let cell = ["</td>", "</th>"].contains(&tag);
        let inline = [
            "<b", "</b>", "<code", "</code>", "<span", "</span>", "<i", "</i>",
        ];
        let inline = inline.iter().any(|start| tag.starts_with(start)) && !tag.starts_with("<br");
        text += if cell {
            " | "
        } else if inline {
            ""
        } else {
            "\n"
        };
        rest = &rest[after..];
    }
    text += rest;
    // Rows of tables are on one line.
    let text = text.replace(" | \n", " | ");
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    lines.join("\n") + "\n"
}

#[test]
fn of_drives() {
    let heavy = Desk::machine("press.toml").replacen("\"-10 kN\"", "\"-900 kN\"", 1);
    let desk = Desk::new()
        .with_machines(&["press.toml"])
        .with("heavy.toml", heavy);
    for (name, file) in [("report", "press.toml"), ("report-refused", "heavy.toml")] {
        desk.run(&format!(
            "size {file} --catalogue drives --steps 64 --report out.html"
        ));
        let html = std::fs::read_to_string(desk.0.path("out.html")).unwrap();
        compare(name, &read(&html));
    }
}

#[test]
fn of_mechanisms_and_simulations() {
    let desk = Desk::new().with_machines(&["press.toml", "linkage-press.toml"]);
    for (name, command) in [
        ("report-mechanism", "reduce press.toml --report out.html"),
        (
            "report-linkage",
            "reduce linkage-press.toml --report out.html",
        ),
        ("report-simulation", "simulate press.toml --report out.html"),
    ] {
        desk.run(command);
        let html = std::fs::read_to_string(desk.0.path("out.html")).unwrap();
        compare(name, &read(&html));
    }
}
