//! Reports: one self-contained file with every plot and every reason.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod document;
mod motions;
mod words;

use std::path::Path;

use crate::support::{Folder, edited_press, jred, jred_of, press_file, press_text, shipped};

/// The elements `<svg …>…</svg>`, parsed.
fn plots(page: &str) -> Vec<&str> {
    let mut plots = Vec::new();
    let mut rest = page;
    while let Some(start) = rest.find("<svg") {
        let end = start + rest[start..].find("</svg>").expect("an open <svg>") + "</svg>".len();
        plots.push(&rest[start..end]);
        rest = &rest[end..];
    }
    plots
}

/// The charts' data as in the page's script: each series with its abscissae `x`.
fn charts(page: &str) -> Vec<serde_json::Value> {
    let parts = page.split("<script type=\"application/json\" class=\"chart\">");
    parts
        .skip(1)
        .map(|part| {
            let text = part.split("</script>").next().unwrap();
            let mut chart: serde_json::Value = serde_json::from_str(text).unwrap();
            let places = chart["places"].as_array().unwrap().clone();
            let mut once = places.iter().map(ToString::to_string).collect::<Vec<_>>();
            once.sort();
            once.dedup();
            assert_eq!(once.len(), places.len(), "a list of places twice");
            for series in chart["series"].as_array_mut().unwrap() {
                series["x"] = places[series["at"].as_u64().unwrap() as usize].clone();
            }
            chart
        })
        .collect()
}

fn check_plots(page: &str, count: usize) {
    let plots = plots(page);
    assert_eq!(plots.len(), count);
    assert_eq!(page.matches("<figure").count(), count);
    for plot in plots {
        // Inline SVG in HTML needs no namespace; the parser needs one for prefixes.
        let document = roxmltree::Document::parse(plot).unwrap_or_else(|e| panic!("{e}: {plot}"));
        let elements = document.descendants().filter(roxmltree::Node::is_element);
        let mut drawn = 0;
        for element in elements {
            for attribute in element.attributes() {
                let value = attribute.value();
                assert!(!value.contains("NaN") && !value.contains("inf"), "{value}");
            }
            drawn += usize::from(
                ["path", "polyline", "rect", "circle", "line"].contains(&element.tag_name().name()),
            );
        }
        assert!(drawn > 10, "an empty plot: {plot}");
        if plot.contains("class=\"ground\"") {
            continue; // the drawing has no axes
        }
        let texts: String = document.descendants().filter_map(|n| n.text()).collect();
        assert!(texts.contains('['), "axes without units: {texts}");
    }
}

/// Neither an element nor the style loads anything.
fn check_self_contained(page: &str) {
    for word in [
        "src=",
        "<link",
        "@import",
        "url(http",
        "<iframe",
        "<object",
        "srcset",
        "fetch(",
        "XMLHttpRequest",
        "import(",
    ] {
        assert!(!page.contains(word), "{word}");
    }
    // Two kinds of scripts: the page's own, and data.
    let own = page.matches("<script>").count();
    let data = page
        .matches("<script type=\"application/json\" class=\"chart\">")
        .count();
    assert!(own <= 1);
    assert_eq!(page.matches("<script").count(), own + data);
    assert_eq!(page.matches("</script>").count(), own + data);
    for part in page.split("href=").skip(1) {
        assert!(
            part.starts_with("\"#") || part.starts_with("'#"),
            "{}",
            &part[..60.min(part.len())]
        );
    }
    for part in page.split("url(").skip(1) {
        assert!(part.starts_with('#'), "{}", &part[..60.min(part.len())]);
    }
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    assert!(page.contains("<meta charset=\"utf-8\">"));
}

/// The page without the content of its scripts.
fn without_scripts(page: &str) -> String {
    let mut parts = page.split("<script");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        text += part.split_once("</script>").unwrap().1;
    }
    text
}

/// Every element that is opened is closed, in order.
fn check_nesting(page: &str) {
    let mut open: Vec<String> = Vec::new();
    let page = without_scripts(page);
    let mut rest = page.as_str();
    while let Some(start) = rest.find('<') {
        let tag = &rest[start + 1..];
        let end = tag.find('>').expect("an open tag");
        let (tag, after) = (&tag[..end], &tag[end + 1..]);
        rest = after;
        if tag.starts_with('!') || tag.starts_with('?') || tag.ends_with('/') {
            continue;
        }
        let name: String = tag
            .trim_start_matches('/')
            .chars()
            .take_while(char::is_ascii_alphanumeric)
            .collect();
        if tag.starts_with('/') {
            assert_eq!(open.pop().as_deref(), Some(name.as_str()));
        } else if !["meta", "br", "hr"].contains(&name.as_str()) {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

fn size(folder: &Folder, file: &Path, code: i32) -> String {
    let report = folder.path("report.html");
    let run = jred([&"size", &file, &"--report", &report]).ends(code);
    assert!(run.out.contains("report written to"));
    std::fs::read_to_string(report).unwrap()
}

/// HTML as plain text, for searching.
fn plain(page: &str) -> String {
    let mut text = String::new();
    let mut inside = false;
    for c in without_scripts(page).chars() {
        match c {
            '<' => inside = true,
            '>' => inside = false,
            _ if !inside => text.push(c),
            _ => {}
        }
    }
    for (code, c) in [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&#60;", "<"),
        ("&#62;", ">"),
        ("&#34;", "\""),
        ("&#39;", "'"),
        ("&amp;", "&"),
        ("&#38;", "&"),
    ] {
        text = text.replace(code, c);
    }
    text
}

#[test]
fn the_report_of_the_press() {
    let folder = Folder::new();
    let page = size(&folder, &press_file(), 0);
    check_self_contained(&page);
    check_nesting(&page);
    // Operating points, torque, speed, power, effects, ratios, drawing, inertia, reduced torque, λ.
    check_plots(&page, 17);
    check_charts(&page, 16);
    let text = plain(&page);
    let answer = jred([&"size", &press_file(), &"--refused", &"--format", &"json"]).json();
    let best = &answer["fit"][0];
    assert!(text.contains(best["motor"].as_str().unwrap()));
    for word in [
        "drives violate no rule",
        "not checked: ",
        "Source of",
        "warning: ",
        "Servo press, 60 mm stroke, 10 kN",
    ] {
        assert!(text.contains(word), "{word}");
    }
    // The closest refused drives, and every rule that they violate.
    let refused = answer["refused"].as_array().unwrap();
    assert!(text.contains(&format!("{} drives, closest first", refused.len())));
    let (_, mut table) = page.split_once("Refused drives and reasons").unwrap();
    let names = refused[..20].iter().map(|drive| {
        let motor = drive["motor"].as_str().unwrap();
        let on = drive["amplifier"].as_str();
        let on = on.map_or_else(String::new, |amplifier| format!(" on {amplifier}"));
        let name = match drive["gearbox"].as_str() {
            Some(gearbox) => format!("{motor} + {gearbox}{on}"),
            None => format!("{motor}, direct{on}"),
        };
        (drive, format!(">{name}</td>"))
    });
    let mut found = Vec::new();
    for (drive, name) in names {
        let (before, after) = table.split_once(&name).unwrap_or_else(|| panic!("{name}"));
        found.push((drive, before));
        table = after;
    }
    // The rules of a drive stand before the name of the next one.
    for (pair, next) in found.iter().zip(found.iter().skip(1)) {
        for check in pair.0["checks"].as_array().unwrap() {
            if check["verdict"] == "fail" {
                let rule = check["rule"].as_str().unwrap();
                assert!(next.1.contains(rule), "{rule} is not in {}", next.1);
            }
        }
    }
    // Every check of the best drive with its verdict or its missing data.
    for check in best["checks"].as_array().unwrap() {
        let rule = check["rule"].as_str().unwrap();
        let row = if check["verdict"] == "not-checked" {
            format!("{rule} (no data: ")
        } else {
            format!("<td class=\"\">{rule}</td>")
        };
        assert!(page.contains(&row), "{row}");
    }
    for words in [
        "Contributions to the torque",
        "How far each quantity may change",
        "Closest refused drives",
        "<b>cycle time 0.5 s</b><span>may be ",
        "Rules and their sources",
        "uPlot",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
}

/// The charts' data: one set per picture, finite, with the same curves.
fn check_charts(page: &str, count: usize) {
    let charts = charts(page);
    assert_eq!(charts.len(), count);
    for chart in &charts {
        let series = chart["series"].as_array().unwrap();
        assert!(
            !series.is_empty() || page.contains("No drive"),
            "{}",
            chart["y"]
        );
        for one in series {
            let (x, y) = (one["x"].as_array().unwrap(), one["y"].as_array().unwrap());
            assert_eq!(x.len(), y.len());
            assert!(x.iter().chain(y).all(|v| v.is_number() || v.is_null()));
            assert!(
                x.iter().any(serde_json::Value::is_number),
                "{}",
                one["name"]
            );
        }
    }
    // Every plane has the time of each of its points: that of torque and speed, and those of the tool over its stroke.
    let planes = charts.iter().filter(|c| c["form"] == "plane");
    let mut count = 0;
    for plane in planes {
        count += 1;
        let mut series = plane["series"].as_array().unwrap().iter();
        let timed = series.find(|s| s["t"].is_array()).unwrap();
        let times = timed["t"].as_array().unwrap();
        assert_eq!(times.len(), timed["x"].as_array().unwrap().len());
    }
    assert!(count > 1, "{count}");
}

#[test]
fn a_title_is_text_not_markup() {
    let folder = Folder::new();
    let title = r#"title = "<b>&\"Press\"</title><script>alert(1)</script> $x^2$ é""#;
    let text = edited_press("title = \"Servo press, 60 mm stroke, 10 kN\"", title);
    let file = folder.file("<machine> & co.toml", text);
    let page = size(&folder, &file, 0);
    let plot = folder.path("plot.html");
    jred([&"simulate", &file, &"--report", &plot]).ends(0);
    for page in [page, std::fs::read_to_string(plot).unwrap()] {
        assert!(
            !page.contains("<script>alert") && !page.contains("<b>&\""),
            "markup got through"
        );
        check_self_contained(&page);
        check_nesting(&page);
        assert!(plain(&page).contains(r#"<b>&"Press"</title><script>alert(1)</script> $x^2$ é"#));
    }
}

/// Names of a user's catalogue are text as well.
#[test]
fn names_of_the_catalogue_are_text_not_markup() {
    let folder = Folder::new();
    let motors = folder.file(
        "m.csv",
        "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source\n\
         <i>k</i>,A<b>&B,\"M\"\"<script>\",30,3000,90,80,<img>\n",
    );
    let report = folder.path("report.html");
    jred_of(
        "size {} --motors {} --report {}",
        [&press_file(), &motors, &report],
    );
    let page = std::fs::read_to_string(report).unwrap();
    for markup in ["M\"<script", "<img", "<i>k", "A<b>"] {
        assert!(!page.contains(markup), "{markup}");
    }
    check_nesting(&page);
    assert!(plain(&page).contains("A<b>&B M\"<script>"));
}

#[test]
fn a_report_where_no_drive_holds() {
    let folder = Folder::new();
    let file = folder.file("m.toml", edited_press("\"-10 kN\"", "\"-900 kN\""));
    let page = size(&folder, &file, 1);
    check_self_contained(&page);
    check_nesting(&page);
    check_plots(&page, 17);
    let text = plain(&page);
    for word in [
        "What would have to change",
        "drives satisfies every rule; ",
        "Violated:",
        "this is the closest one",
        "Drives that violate no rule (0 of ",
    ] {
        assert!(text.contains(word), "{word}");
    }
}

#[test]
fn the_page_of_a_simulation() {
    let folder = Folder::new();
    let plot = folder.path("plot.html");
    let run = jred([&"simulate", &press_file(), &"--report", &plot]).ends(0);
    assert!(run.out.contains("Servo press"));
    let page = std::fs::read_to_string(plot).unwrap();
    check_self_contained(&page);
    check_nesting(&page);
    // Position, speed, acceleration, motor torque, energies, balance.
    check_plots(&page, 6);
}

/// A sliding drive link has other column names: every chart has its curve.
#[test]
fn the_page_of_a_simulation_that_slides() {
    let folder = Folder::new();
    let plot = folder.path("plot.html");
    let machine = shipped("linear-gripper.toml");
    jred([&"simulate", &machine, &"--report", &plot]).ends(0);
    let page = std::fs::read_to_string(plot).unwrap();
    check_plots(&page, 6);
    assert!(page.contains("motor force [N]") && page.contains("v [m/s]"));
    for plot in plots(&page) {
        assert!(plot.contains("<path"), "no curve: {plot}");
    }
}

/// The curve of the potential energy is named after its parts: a damper stores nothing.
#[test]
fn the_potential_names_its_springs() {
    let folder = Folder::new();
    let page = |name: &str, file: &Path| {
        let report = folder.path(name);
        jred([&"reduce", &file, &"--report", &report]).ends(0);
        std::fs::read_to_string(report).unwrap()
    };
    let press = page("press.html", &press_file());
    assert!(press.contains("weight −U′") && !press.contains("springs −U′"));
    let lever = shipped("linkage-cam-lever.toml");
    let lever = page("lever.html", &lever);
    assert!(lever.contains("weight and springs −U′"));
    assert!(!lever.contains("weight −U′"));
}

/// Machines without loads, without a train, at constant speed: empty plots are valid.
#[test]
fn reports_of_plain_machines() {
    let folder = Folder::new();
    let plain_machine = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "belt"
driver = { radius = "40 mm", inertia = "0.0006 kg m^2" }
driven = { radius = "120 mm", inertia = "0.03 kg m^2" }
[motion]
type = "constant-speed"
speed = "60 rpm"
"#;
    let file = folder.file("belt.toml", plain_machine);
    let page = size(&folder, &file, 0);
    check_self_contained(&page);
    check_nesting(&page);
    assert!(!plain(&page).contains("NaN"));
    // A curve without bends is drawn with the requested instants.
    assert!(page.len() < 500_000, "{} bytes", page.len());
    for plot in plots(&page) {
        roxmltree::Document::parse(plot).unwrap();
        assert!(!plot.contains("NaN") && !plot.contains("inf\""));
    }
    let no_load = press_text();
    let (machine, rest) = no_load.split_once("# Pressing force").unwrap();
    let (_, rest) = rest.split_once("# Toothed belt").unwrap();
    let file = folder.file("no load.toml", format!("{machine}#{rest}"));
    let page = size(&folder, &file, 0);
    check_plots(&page, 15);
}
