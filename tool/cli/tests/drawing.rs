//! Drawings and the page about a mechanism: valid SVG that shows the mechanism's motion.

use std::path::{Path, PathBuf};

use crate::support::{Folder, edited_press, jred, jred_of, near, press_file, within};
use roxmltree::{Document, Node};
use serde_json::Value;

fn page(file: &Path, folder: &Folder) -> String {
    let report = folder.path("page.html");
    let run = jred([&"reduce", &file, &"--report", &report]).ends(0);
    assert!(run.out.contains("report written to"));
    std::fs::read_to_string(report).unwrap()
}

/// The drawing, which is the first SVG of the page, and its animation data.
fn parts(page: &str) -> (&str, Value) {
    let start = page.find("<svg").unwrap();
    let end = start + page[start..].find("</svg>").unwrap() + "</svg>".len();
    let (_, rest) = page.split_once("const track = ").unwrap();
    let (track, _) = rest.split_once(";\n").unwrap();
    (&page[start..end], serde_json::from_str(track).unwrap())
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

/// Points of a polyline.
fn points(node: Node) -> Vec<[f64; 2]> {
    let d = node.attribute("d").unwrap();
    let points = d.trim_start_matches('M').trim_end_matches('Z').split('L');
    points
        .map(|point| {
            let (x, y) = point.split_once(' ').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// All numbers are finite, and nothing is outside the page.
fn check_drawing(svg: &str) {
    let document = Document::parse(svg).unwrap_or_else(|e| panic!("{e}: {svg}"));
    let root = document.root_element();
    let size: Vec<f64> = root
        .attribute("viewBox")
        .unwrap()
        .split(' ')
        .map(|x| x.parse().unwrap())
        .collect();
    for element in document.descendants().filter(Node::is_element) {
        for attribute in element.attributes() {
            let value = attribute.value();
            assert!(!value.contains("NaN") && !value.contains("inf"), "{value}");
        }
        // Paths of points are in the page's coordinates.
        if element.attribute("stroke-dasharray") == Some("5 3") {
            for [x, y] in points(element) {
                assert!(
                    (0.0..=size[2]).contains(&x) && (0.0..=size[3]).contains(&y),
                    "{x} {y}"
                );
            }
        }
    }
}

/// The scale (px/m) according to the scale bar.
fn scale(document: &Document) -> f64 {
    let text = document.descendants().filter_map(|n| n.text());
    let mut labels = text.filter(|t| t.ends_with(" mm"));
    let label = labels.next_back().unwrap();
    let length: f64 = label.trim_end_matches(" mm").parse().unwrap();
    let mut bars = document.descendants().filter(|n| n.has_tag_name("path"));
    let bar = points(bars.next_back().unwrap());
    assert_eq!(bar.len(), 4);
    distance(bar[1], bar[2]) / (length * 1e-3)
}

/// The press, whose ram moves down along x: A moves on a circle of 30 mm about the crank's pivot, B down the page by 60 mm, the rod keeps its length,
/// and every link is at its frame.
#[test]
fn the_press_moves_as_it_should() {
    let folder = Folder::new();
    let page = page(&press_file(), &folder);
    let (svg, track) = parts(&page);
    check_drawing(svg);
    let document = Document::parse(svg).unwrap();
    let scale = scale(&document);
    let paths: Vec<Vec<[f64; 2]>> = document
        .descendants()
        .filter(|n| n.attribute("stroke-dasharray") == Some("5 3"))
        .map(points)
        .collect();
    assert_eq!(paths.len(), 2);
    let links = track["links"].as_array().unwrap();
    let marks = track["points"].as_array().unwrap();
    assert_eq!((links.len(), marks.len()), (180, 180));
    let pivot = numbers(&links[0]);
    let pivot = [pivot[0], pivot[1]];
    for point in &paths[0] {
        within("A", distance(*point, pivot), 0.03 * scale, 0.02);
    }
    let y: Vec<f64> = paths[1].iter().map(|p| p[1]).collect();
    let (low, high) = (
        y.iter().copied().fold(f64::MAX, f64::min),
        y.iter().copied().fold(0.0, f64::max),
    );
    within("stroke", high - low, 0.06 * scale, 0.05);
    for (k, (link, mark)) in links.iter().zip(marks).enumerate() {
        let (link, mark) = (numbers(link), numbers(mark));
        let phi = track["positions"][k].as_f64().unwrap();
        near("φ", phi, 2.0 * k as f64, 1e-12);
        // Clockwise on the page is negative in the plane.
        within("crank", link[2], 90.0 - phi, 1e-3);
        let (a, b) = ([mark[0], mark[1]], [mark[2], mark[3]]);
        let (sin, cos) = phi.to_radians().sin_cos();
        let expected = [pivot[0] + 0.03 * scale * sin, pivot[1] + 0.03 * scale * cos];
        within("A", distance(a, expected), 0.0, 0.02);
        within("rod", distance(a, b), 0.18 * scale, 0.03);
        within("guide", b[0], pivot[0], 0.01);
        within("slider", distance([link[6], link[7]], b), 0.0, 0.01);
        let turn = (b[1] - a[1]).atan2(b[0] - a[0]).to_degrees();
        within("rod's angle", link[5], turn, 0.02);
    }
    // Every path passes through its drawn point.
    let first = track["first"].as_u64().unwrap() as usize;
    let mark = numbers(&marks[first]);
    let nearest = paths[1].iter().map(|p| distance(*p, [mark[2], mark[3]]));
    assert!(nearest.fold(f64::MAX, f64::min) < 2.0);
    // Three links, each with a body and its pins; the script moves the drawing's groups.
    let moved = |name: &str| {
        document
            .descendants()
            .filter(|n| n.has_attribute(name))
            .count()
    };
    assert_eq!((moved("data-link"), moved("data-point")), (6, 2));
    let titles = document.descendants().filter(|n| n.has_tag_name("title"));
    assert!(titles.filter_map(|n| n.text()).any(|t| t == "rod"));
}

/// A millimetre mechanism and one of a hundred metres fill the page equally.
#[test]
fn any_size_fills_the_page() {
    let folder = Folder::new();
    let mut heights = Vec::new();
    for (crank, rod, com) in [
        ("30 mm", "180 mm", "55 mm"),
        ("0.3 mm", "1.8 mm", "0.55 mm"),
        ("30 m", "180 m", "55 m"),
    ] {
        let text = edited_press("length = \"30 mm\"", &format!("length = \"{crank}\""))
            .replace("length = \"180 mm\"", &format!("length = \"{rod}\""))
            .replace("com = [\"55 mm\"", &format!("com = [\"{com}\""));
        let page = page(&folder.file("size.toml", text), &folder);
        let (svg, _) = parts(&page);
        check_drawing(svg);
        let document = Document::parse(svg).unwrap();
        let root = document.root_element();
        heights.push(root.attribute("viewBox").unwrap().to_owned());
        let bar = scale(&document) * rod.split(' ').next().unwrap().parse::<f64>().unwrap();
        let unit = if rod.ends_with("mm") { 1e-3 } else { 1.0 };
        assert!((300.0..700.0).contains(&(bar * unit)), "{bar}");
    }
    assert!(heights.iter().all(|h| *h == heights[0]), "{heights:?}");
}

fn machines() -> impl Iterator<Item = PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let files = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let reducible = |file: &PathBuf| {
        file.extension().is_some_and(|e| e == "toml")
            && !std::fs::read_to_string(file).unwrap().contains("[variator")
    };
    files.filter(move |file| reducible(file))
}

/// The page of every example machine is complete, valid and self-contained.
#[test]
#[ignore = "more than five seconds of a processor"]
fn the_page_of_every_example_machine() {
    let folder = Folder::new();
    for file in machines() {
        let page = page(&file, &folder);
        let name = file.display();
        let (svg, track) = parts(&page);
        check_drawing(svg);
        for row in ["links", "points"] {
            for row in track[row].as_array().unwrap() {
                assert!(numbers(row).iter().all(|x| x.is_finite()), "{name}");
            }
        }
        let mut rest = page.as_str();
        let mut plots = 0;
        while let Some(start) = rest.find("<svg") {
            let end = start + rest[start..].find("</svg>").unwrap() + "</svg>".len();
            let plot = &rest[start..end];
            Document::parse(plot).unwrap_or_else(|e| panic!("{name}: {e}"));
            rest = &rest[end..];
            plots += 1;
        }
        assert!(plots >= 4, "{name}: {plots} figures");
        assert!(!page.contains("NaN"), "{name}");
        for word in [
            "src=", "<link", "@import", "url(http", "<iframe", "<object", "fetch(", "http://",
            "https://",
        ] {
            let page = page.replace("http://www.w3.org/", "");
            assert!(!page.contains(word), "{name}: {word}");
        }
        assert_eq!(page.matches("<script").count(), 1, "{name}");
        assert!(page.contains("<h2>Check</h2>") && page.contains("degrees of freedom"));
        assert!(page.len() < 3_000_000, "{name}: {} bytes", page.len());
    }
}

#[test]
fn a_title_is_text_not_markup() {
    let folder = Folder::new();
    let title = r#"title = "<b>&\"Press\"</title></pre><script>alert(1)</script> $x^2$""#;
    let text = edited_press("title = \"Servo press, 60 mm stroke, 10 kN\"", title);
    let page = page(&folder.file("<machine> & co.toml", text), &folder);
    assert_eq!(page.matches("<script").count(), 1);
    assert!(!page.contains("<b>&\"") && !page.contains("<machine>"));
}

/// A sliding drive link known only by its curves is drawn as a block on a guide as long as its stroke, not as a gear wheel.
#[test]
fn a_slide_of_which_only_the_curves_are_known() {
    let folder = Folder::new();
    folder.file(
        "curves.csv",
        "s [mm],m [kg]\n0,8\n100,8\n150,8.5\n200,9\n300,9\n",
    );
    let text = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "reduced-curves"
file = "curves.csv"
range = "stroke"
"#;
    let page = page(&folder.file("slide.toml", text), &folder);
    let (svg, _) = parts(&page);
    check_drawing(svg);
    assert!(!svg.contains("schematic"), "{svg}");
    let document = Document::parse(svg).unwrap();
    let lines = document
        .descendants()
        .filter(|node| node.has_tag_name("path"));
    let lengths = lines.map(|path| {
        let points = points(path);
        points
            .windows(2)
            .map(|pair| distance(pair[0], pair[1]))
            .fold(0.0, f64::max)
    });
    let longest = lengths.fold(0.0, f64::max);
    // No wheel, and a block that stays on its guide.
    let circles = document
        .descendants()
        .filter(|node| node.has_tag_name("circle"));
    let radii = circles.map(|circle| circle.attribute("r").unwrap().parse::<f64>().unwrap());
    assert!(radii.fold(0.0, f64::max) < 8.0, "{svg}");
    assert!(longest > 0.3 * scale(&document), "{longest}");
}

/// Forces and motions of the page without a motion in the file.
#[test]
fn without_a_motion() {
    let folder = Folder::new();
    let press = edited_press("[motion]", "[motion-not]");
    let (machine, rest) = press.split_once("# One turn from top dead centre").unwrap();
    let (_, rest) = rest.split_once("# Start from rest").unwrap();
    let file = folder.file("still.toml", format!("{machine}#{rest}"));
    let page = page(&file, &folder);
    assert!(page.contains("--speed was not given") && !page.contains("<h2>Forces</h2>"));
    assert!(page.contains("Velocity transfer functions"));
    let report = folder.path("moving.html");
    jred_of("reduce {} --report {} --speed '60 rpm'", [&file, &report]).ends(0);
    let page = std::fs::read_to_string(report).unwrap();
    assert!(page.contains("<h2>Forces</h2>") && page.contains("<h2>Largest forces</h2>"));
}
