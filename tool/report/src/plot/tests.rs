#![expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]

use super::*;
use roxmltree::{Document, Node};
use std::collections::HashSet;

const AXES: Axes = Axes {
    title: "a <&\"> 'b' $x$",
    x: Axis {
        label: "φ [deg]",
        degrees: true,
    },
    y: "ω² <&\">",
};

fn one(points: Vec<(f64, f64)>, style: Style) -> Vec<Series<'static>> {
    vec![Series {
        name: "J′·ω² <&\">",
        points,
        style,
    }]
}

/// Parses as XML, with finite numbers only.
fn sound(svg: &str) -> Document<'_> {
    let document = Document::parse(svg).expect("well-formed");
    let words = |node: Node| {
        node.attributes()
            .map(|a| a.value().to_owned())
            .collect::<Vec<_>>()
    };
    for value in document.descendants().flat_map(words) {
        assert!(!value.contains("NaN") && !value.contains("inf"), "{value}");
    }
    let texts = document.descendants().filter_map(|n| n.text());
    assert!(
        !texts.into_iter().any(|t| t == "NaN" || t == "inf"),
        "{svg}"
    );
    document
}

fn drawn_paths(svg: &str) -> usize {
    sound(svg)
        .descendants()
        .filter(|n| n.has_tag_name("path"))
        .count()
}

#[test]
fn user_text_is_escaped_and_shown_as_given() {
    let points = vec![(0.0, 1.0), (1.0, 2.0)];
    let odd = Series {
        name: "<b&\">\u{1}",
        points: points.clone(),
        style: Style::Line,
    };
    let all = [
        lines(&AXES, &one(points.clone(), Style::Line)),
        lines_two_axes(
            &AXES,
            &one(points.clone(), Style::Dots),
            "<r&\">",
            &one(points, Style::Dashed),
        ),
        lines(&AXES, &[odd]),
    ];
    let shown = [vec!["J′·ω² <&\">"], vec!["<r&\">"], vec!["<b&\"> "]];
    for (svg, shown) in all.iter().zip(shown) {
        let document = sound(svg);
        let texts: HashSet<&str> = document.descendants().filter_map(|n| n.text()).collect();
        for text in [AXES.title, AXES.x.label, AXES.y].iter().chain(&shown) {
            assert!(texts.contains(text), "{text} is missing in {texts:?}");
        }
    }
}

#[test]
fn size_is_left_to_the_page() {
    for series in [vec![], one(vec![(0.0, 0.0), (1.0, 1.0)], Style::Line)] {
        let svg = lines(&AXES, &series);
        let document = sound(&svg);
        let root = document.root_element();
        assert_eq!(root.attribute("viewBox"), Some("0 0 760 340"));
        assert!(root.attribute("width").is_none() && root.attribute("height").is_none());
    }
}

/// A page has many charts; their ids are unique.
#[test]
fn ids_are_unique_on_a_page() {
    let data = || one(vec![(0.0, 1.0), (1.0, 2.0)], Style::Line);
    let plots = [
        lines(&AXES, &data()),
        lines_two_axes(&AXES, &data(), "", &data()),
    ];
    let page = format!("<div>{}</div>", plots.concat());
    let document = sound(&page);
    assert!(document.descendants().all(|n| n.attribute("id").is_none()));
}

/// Curves, numbers and names are within the sheet; nothing is clipped.
#[test]
fn everything_is_on_the_sheet() {
    let far = vec![(-3.0, 1e9), (40.0, -7e8), (41.0, 1e9)];
    let svg = lines_two_axes(
        &AXES,
        &one(far.clone(), Style::Line),
        "right",
        &one(far, Style::Dashed),
    );
    let document = sound(&svg);
    let on = |x: f64, y: f64| {
        assert!(
            (0.0..=WIDTH).contains(&x) && (0.0..=HEIGHT).contains(&y),
            "{x} {y}"
        );
    };
    for node in document.descendants() {
        if let Some(d) = node.attribute("d") {
            for point in d.trim_start_matches('M').split('L') {
                let (x, y) = point.split_once(' ').unwrap();
                on(x.parse().unwrap(), y.parse().unwrap());
            }
        }
        for (x, y) in [("x", "y"), ("x1", "y1"), ("x2", "y2")] {
            if let (Some(x), Some(y)) = (node.attribute(x), node.attribute(y)) {
                on(x.parse().unwrap(), y.parse().unwrap());
            }
        }
    }
}

/// The points left out deviate by less than a tenth of the line width.
#[test]
fn a_thinned_curve_is_the_same_curve() {
    let wave: Vec<[f64; 2]> = (0..2000)
        .map(|k| {
            let x = f64::from(k) * 0.3;
            [
                x,
                100.0 * (x / 40.0).sin() + if k == 777 { 9.0 } else { 0.0 },
            ]
        })
        .collect();
    let kept = thinned(&wave);
    assert!(kept.len() < 500, "{}", kept.len());
    assert!(kept.contains(&wave[0]) && kept.contains(&wave[777]) && kept.contains(&wave[1999]));
    for p in &wave {
        let nearest = kept.windows(2).map(|pair| {
            let [a, b] = pair else { unreachable!() };
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let along = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy);
            let along = along.clamp(0.0, 1.0);
            (p[0] - a[0] - along * dx).hypot(p[1] - a[1] - along * dy)
        });
        assert!(nearest.fold(f64::INFINITY, f64::min) < 0.1);
    }
    let back = [[0.0, 0.0], [5.0, 0.0], [-1.0, 0.0], [2.0, 0.0]];
    assert_eq!(thinned(&back), back, "turning points stay");
}

#[test]
fn long_names_are_broken_into_lines() {
    assert_eq!(wrapped("", 9), Vec::<String>::new());
    assert_eq!(wrapped("a bc def", 4), ["a bc", "def"]);
    assert_eq!(wrapped("longer than that", 4), ["longer", "than", "that"]);
}

#[test]
fn degenerate_input_is_drawn_without_nonsense() {
    let bad = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN_POSITIVE,
        0.0,
    ];
    let mut inputs: Vec<Vec<(f64, f64)>> =
        vec![vec![], vec![(3.0, 4.0)], vec![(0.0, 5.0), (9.0, 5.0)]];
    inputs.extend([
        vec![(2.0, 1.0), (2.0, 7.0)],
        vec![(0.0, 1e6), (1.0, 1e6 + 1e-5)],
        vec![(1e-9, -1e9), (2e-9, 1e-9)],
    ]);
    inputs.extend([
        bad.map(|v| (v, 1.0)).to_vec(),
        bad.map(|v| (1.0, v)).to_vec(),
        vec![(-1e99, 1e99), (1e99, -1e99)],
    ]);
    for points in inputs {
        for style in [Style::Line, Style::Dashed, Style::Dots] {
            sound(&lines(&AXES, &one(points.clone(), style)));
            sound(&lines_two_axes(
                &AXES,
                &one(points.clone(), style),
                "r",
                &[],
            ));
            sound(&lines_two_axes(
                &AXES,
                &[],
                "r",
                &one(points.clone(), style),
            ));
        }
    }
    for empty in [lines(&AXES, &[]), lines_two_axes(&AXES, &[], "r", &[])] {
        let ticks = sound(&empty)
            .descendants()
            .filter(|n| n.attribute("text-anchor") == Some("end"))
            .count();
        assert!(ticks >= 4, "no axes: {empty}");
    }
}

#[test]
fn a_line_is_broken_where_a_point_is_missing() {
    let gap = vec![
        (0.0, 0.0),
        (1.0, 1.0),
        (2.0, f64::NAN),
        (3.0, 1.0),
        (4.0, 0.0),
    ];
    assert_eq!(drawn_paths(&lines(&AXES, &one(gap, Style::Line))), 2);
    let whole = vec![(0.0, 0.0), (1.0, 1.0), (3.0, 1.0), (4.0, 0.0)];
    assert_eq!(drawn_paths(&lines(&AXES, &one(whole, Style::Line))), 1);
}

#[test]
fn two_thousand_points_stay_below_60_kilobytes() {
    let noisy = |i: u32| (f64::from(i), f64::from(i.wrapping_mul(2_654_435_761) >> 7));
    for style in [Style::Line, Style::Dashed, Style::Dots] {
        let svg = lines(&AXES, &one((0..2000).map(noisy).collect(), style));
        assert!(svg.len() < 60_000, "{style:?}: {} bytes", svg.len());
        assert!(svg.len() > 20_000, "{style:?}: points are lost");
    }
}

#[test]
fn both_vertical_axes_share_the_grid() {
    let curve = |f: f64| {
        one(
            (0..9)
                .map(|i| (f64::from(i), f * f64::from(i * i - 20)))
                .collect(),
            Style::Line,
        )
    };
    for factor in [1.0, 0.013, -7e-5, 123.0] {
        let svg = lines_two_axes(&AXES, &curve(1.0), "right", &curve(factor));
        let document = sound(&svg);
        let heights = |anchor: &str| -> HashSet<String> {
            let ticks = document
                .descendants()
                .filter(|n| n.attribute("text-anchor") == Some(anchor));
            ticks
                .filter_map(|n| n.attribute("y"))
                .map(str::to_owned)
                .collect()
        };
        let (left, right) = (heights("end"), heights("start"));
        assert!(
            left.len() >= 5 && left.is_subset(&right),
            "{factor}: {left:?} {right:?}"
        );
    }
}

/// Twelve curves differ by colour; further ones repeat a colour with their own dashes.
#[test]
fn many_curves_are_told_apart() {
    let names: Vec<String> = (0..17).map(|k| format!("curve {k}")).collect();
    let series: Vec<Series> = names
        .iter()
        .zip(1..)
        .map(|(name, k)| Series {
            name,
            points: vec![(0.0, 0.0), (1.0, f64::from(k))],
            style: Style::Line,
        })
        .collect();
    let svg = lines(&AXES, &series);
    let document = sound(&svg);
    let looks: Vec<(String, String)> = document
        .descendants()
        .filter(|n| n.has_tag_name("path"))
        .filter_map(|n| {
            let dashes = n.attribute("stroke-dasharray").unwrap_or_default();
            Some((n.attribute("stroke")?.to_lowercase(), dashes.to_owned()))
        })
        .collect();
    assert_eq!(looks.len(), 17);
    assert_eq!(looks.iter().collect::<HashSet<_>>().len(), 17, "{looks:?}");
    let colours: HashSet<&String> = looks.iter().map(|look| &look.0).collect();
    assert_eq!(colours.len(), 12);
    assert!(
        looks.iter().take(12).all(|look| look.1.is_empty()),
        "{looks:?}"
    );
    // None of them resembles a limit.
    assert!(looks.iter().all(|look| look.1 != "5 5"), "{looks:?}");
}

/// Colour distance in CIE L*a*b*: 2.3 is just noticeable (Mahy et al., 1994).
#[test]
fn colours_are_far_apart() {
    let lab = |hex: &str| -> [f64; 3] {
        let channel = |k: usize| {
            let c = f64::from(u8::from_str_radix(&hex[k..k + 2], 16).unwrap()) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        };
        let [r, g, b] = [channel(1), channel(3), channel(5)];
        let f = |t: f64| {
            if t > 0.008_856 {
                t.cbrt()
            } else {
                7.787 * t + 16.0 / 116.0
            }
        };
        let x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.950_47);
        let y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
        let z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.088_83);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    };
    for (k, a) in PALETTE.iter().enumerate() {
        for b in PALETTE.iter().take(k) {
            let (p, q) = (lab(a), lab(b));
            let squares: f64 = p.iter().zip(q).map(|(p, q)| (p - q).powi(2)).sum();
            assert!(squares.sqrt() > 25.0, "{a} and {b}: {}", squares.sqrt());
        }
    }
}

/// On paper each colour of a solid curve but the first has dashes, no two the same in one width.
#[test]
fn curves_differ_on_paper_without_colours() {
    let style = include_str!("../../templates/print.css");
    let mut looks = Vec::new();
    for colour in &PALETTE[1..] {
        let rule = style
            .split(&format!("path[stroke=\"{colour}\"]"))
            .nth(1)
            .unwrap();
        let look = rule.split(['{', '}']).nth(1).unwrap();
        assert!(look.contains("stroke-dasharray") && look.contains("stroke-width"));
        looks.push(look);
    }
    looks.sort_unstable();
    looks.dedup();
    assert_eq!(looks.len(), PALETTE.len() - 1);
    assert_eq!(style.matches("path[stroke=").count(), looks.len());
}
