//! The document: title block, inputs as written, the tool's curves, the drawing as the machine stands.

use serde_json::Value;

use super::charts;
use crate::support::{Folder, jred, press_text, within};

fn document(text: &str) -> String {
    let folder = Folder::new();
    let (file, path) = (folder.file("press.toml", text), folder.path("report.html"));
    jred([&"size", &file, &"--report", &path]).ends(0);
    std::fs::read_to_string(&path).unwrap()
}

/// Points of the only curve of a chart.
fn points(chart: &Value) -> Vec<[f64; 2]> {
    let series = &chart["series"][0];
    let of = |key: &str| {
        series[key]
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_f64().unwrap())
            .collect::<Vec<_>>()
    };
    of("x")
        .into_iter()
        .zip(of("y"))
        .map(|(x, y)| [x, y])
        .collect()
}

/// Position, speed and acceleration of the ram by the closed forms of the slider-crank and the 3-4-5 polynomial, and its load by the machine file.
#[test]
fn the_tool_moves_as_in_closed_form() {
    let page = document(&press_text());
    let charts = charts(&page);
    let of = |x: &str, y: &str| {
        let found = charts
            .iter()
            .find(|chart| chart["x"] == x && chart["y"].as_str().unwrap().starts_with(y));
        points(found.unwrap_or_else(|| panic!("{y} over {x}")))
    };
    let (r, l, turn, time) = (0.03, 0.18, std::f64::consts::TAU, 0.4);
    // Angle of the crank and its derivatives.
    let crank = |t: f64| {
        let z = (t / time).min(1.0);
        let angle = turn * z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z) + turn / 2.0;
        let speed = turn / time * 30.0 * z * z * (1.0 - z) * (1.0 - z);
        let rate = turn / (time * time) * 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z);
        [angle, speed, rate]
    };
    let ram = |angle: f64| r * angle.cos() + (l * l - (r * angle.sin()).powi(2)).sqrt();
    for [t, x] in of("time [s]", "position") {
        within("position", x, 1e3 * ram(crank(t)[0]), 1e-2);
    }
    // Derivatives by differences of the closed form.
    let h = 1e-5;
    let slope = |angle: f64| (ram(angle + h) - ram(angle - h)) / (2.0 * h);
    let bend = |angle: f64| (ram(angle + h) - 2.0 * ram(angle) + ram(angle - h)) / (h * h);
    for [t, v] in of("time [s]", "speed [m/s]") {
        let [angle, speed, _] = crank(t);
        within("speed", v, slope(angle) * speed, 1e-4);
    }
    for [t, a] in of("time [s]", "acceleration [m/s²]") {
        let [angle, speed, rate] = crank(t);
        within(
            "acceleration",
            a,
            bend(angle) * speed * speed + slope(angle) * rate,
            2e-3,
        );
    }
    let load = of("time [s]", "load [N]");
    let least = load.iter().map(|p| p[1]).fold(0.0, f64::min);
    // The press force and the friction of the guide, both against the ram on its way down.
    within("load", least, -10_150.0, 0.1);
    // Over the stroke the same values belong to the positions.
    let over: Vec<[f64; 2]> = of("position [mm]", "load [N]");
    assert_eq!(over.len(), load.len());
    for ([t, _], [x, _]) in load.iter().zip(&over) {
        within("stroke", *x, 1e3 * ram(crank(*t)[0]), 1e-2);
    }
}

#[test]
fn the_title_block_and_the_inputs_are_the_users() {
    let more =
        "\n[document]\nproject = \"Line <7>\"\ncustomer = \"Cardboard Ltd\"\nrevision = \"C\"\n";
    let page = document(&(press_text() + more));
    for words in [
        "Line &#60;7&#62;",
        "Cardboard Ltd",
        ">C<",
        "2026-12-01",
        "digest ",
    ] {
        assert!(page.contains(words), "{words:?}");
    }
    // Each entry of the file with its unit and its remark.
    for words in [
        "mechanism.crank.length",
        "30 mm",
        "motion.segment.2.dwell",
        "crank gear and brake disc",
    ] {
        assert!(page.contains(words), "{words:?}");
    }
    let dated = document(&(press_text() + "\n[document]\ndate = \"1 May\"\n"));
    assert!(dated.contains("1 May") && !dated.contains("2026-12-01"));
}

/// The digest is that of the content: the same file elsewhere has the same one, another number another one.
#[test]
fn the_digest_follows_the_content() {
    let digest = |text: &str| {
        let page = document(text);
        let at = page.find("digest ").unwrap();
        page[at..at + 39].to_owned()
    };
    let one = digest(&press_text());
    assert_eq!(one, digest(&press_text()));
    assert_ne!(one, digest(&press_text().replace("42 kg", "42.5 kg")));
}
