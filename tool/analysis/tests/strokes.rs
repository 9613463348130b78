//! Cranks that cannot turn fully, over a stroke between their dead points.

use jred::Domain;
use jred::machine::{Joint, Jointed as _, Mechanism as _};
use jred_analysis::inspect::Findings;

use crate::reading::{parse, read, refuses, rendered};

fn slider_crank(crank: f64, rod: f64, offset: f64, stroke: &str) -> String {
    format!(
        "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\n{stroke}\noffset = \"{offset} mm\"\n\
         crank = {{ length = \"{crank} mm\", mass = \"1 kg\", inertia = \"1e-3 kg m^2\" }}\n\
         rod = {{ length = \"{rod} mm\", mass = \"0.5 kg\", inertia = \"1e-3 kg m^2\", com = [\"60 mm\", \"0 mm\"] }}\n\
         slider = {{ mass = \"0.1 kg\" }}\n"
    )
}

fn swings(from: f64, to: f64) -> String {
    format!("stroke = [\"{from:e} deg\", \"{to:e} deg\"]")
}

/// Every pin holds its two points together over the whole range, ends included, to 1e-12 of a metre; both ways to the drive torque agree.
#[track_caller]
fn joints_close(text: &str) {
    let file = read(text);
    let mechanism = file.machine.mechanism();
    let Domain::Stroke { from, to } = mechanism.domain() else {
        panic!("turns fully");
    };
    for k in 0..=500 {
        let phi = from + (to - from) * f64::from(k) / 500.0;
        let frames = mechanism.frames(phi).unwrap();
        for joint in &mechanism.joints(phi, &frames).unwrap() {
            if let Joint::Revolute([first, second]) = joint {
                let [a, b] = [first, second].map(|m| m.position(&frames).map(|c| c.value));
                assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12, "at {phi}");
            }
        }
    }
    let findings = Findings::of(&file).unwrap();
    assert!(
        findings.agreement.dalembert < 1e-10,
        "{:e}",
        findings.agreement.dalembert
    );
    assert!(findings.transmission.is_some_and(|found| found.branch_kept));
}

/// A rod shorter than the crank reaches the guide y = e between the angles with |e − r·sin φ| = l. There it moves as
/// x = r·cos φ + √(l² − (e − r·sin φ)²) says.
#[test]
fn short_rods_move_between_their_dead_points() {
    for (r, l, e) in [
        (200.0_f64, 150.0_f64, 0.0_f64),
        (200.0, 150.0, 30.0),
        (100.0, 120.0, -40.0),
        (100.0, 120.0, 40.0),
    ] {
        // The reach around φ = 0.
        let [up, down] = [(e + l) / r, (e - l) / r];
        let end = |sin: f64| {
            if sin.abs() <= 1.0 {
                sin.asin().to_degrees()
            } else {
                90.0 * sin.signum()
            }
        };
        let [from, to] = [end(down), end(up)];
        let hair = 1e-3;
        joints_close(&slider_crank(r, l, e, &swings(from + hair, to - hair)));
        let file = read(&slider_crank(r, l, e, &swings(from + hair, to - hair)));
        for k in 0..=50 {
            let phi = (from + hair + (to - from - 2.0 * hair) * f64::from(k) / 50.0).to_radians();
            let frames = file.machine.mechanism().frames(phi).unwrap();
            let x = frames.get(2).unwrap().x.value;
            let rest = l * l - (e - r * phi.sin()).powi(2);
            let due = (r * phi.cos() + rest.sqrt()) / 1e3;
            assert!((x - due).abs() < 1e-10, "{r} {l} {e} at {phi}: {x} {due}");
        }
        // A hair beyond a dead point is refused; so is a start where the rod does not reach.
        if up <= 1.0 {
            let beyond = slider_crank(r, l, e, &swings(from + 1.0, to + hair));
            refuses(
                &beyond,
                &[
                    "reaches a dead point",
                    "the rod is perpendicular to the guide",
                ],
            );
            let outside = slider_crank(r, l, e, &swings(to + 1.0, to + 2.0));
            refuses(&outside, &["starts at", "the rod does not reach the guide"]);
        }
        // Without a stroke the cure names one.
        refuses(
            &slider_crank(r, l, e, ""),
            &[
                "too short for a full turn",
                "over a stroke inside its dead points: stroke = ",
            ],
        );
    }
    // One that turns fully may swing as well, over more than a turn it may not.
    joints_close(&slider_crank(50.0, 200.0, 10.0, &swings(-30.0, 300.0)));
    refuses(
        &slider_crank(50.0, 200.0, 10.0, &swings(0.0, 400.0)),
        &["less than a turn"],
    );
    refuses(
        &slider_crank(50.0, 200.0, 300.0, &swings(0.0, 40.0)),
        &["starts at φ = 0.00°", "0.100000 m are missing"],
    );
}

/// The cure's own stroke is accepted.
#[test]
fn the_stroke_of_the_cure_works() {
    for (r, l, e) in [
        (200.0, 150.0, 0.0),
        (100.0, 80.0, 30.0),
        (100.0, 30.0, 60.0),
    ] {
        let text = slider_crank(r, l, e, "");
        let report = rendered(&parse(&text).unwrap_err());
        let line = report
            .split("stroke = ")
            .nth(1)
            .unwrap()
            .split(']')
            .next()
            .unwrap();
        joints_close(&slider_crank(r, l, e, &format!("stroke = {line}]")));
    }
}

fn six_link(rod: f64, crank: f64, centres: f64, stroke: &str) -> String {
    let link = |name: &str, length: f64| {
        format!(
            "{name} = {{ length = \"{length} mm\", mass = \"1 kg\", inertia = \"2e-3 kg m^2\" }}\n"
        )
    };
    format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"six-link\"\ncentres = \"{centres} mm\"\nguide = \"200 mm\"\n{stroke}\n{}\
         block = {{ mass = \"0.2 kg\", inertia = \"1e-4 kg m^2\" }}\n{}{}slider = {{ mass = \"3 kg\" }}\n",
        link("crank", crank),
        link("rocker", 400.0),
        link("rod", rod)
    )
}

/// Rocker, guide and rod as the drawing has them: |l₂·sin φ₂ − g| = l₃ at the dead points, tan φ₂ = l₁·sin φ/(l₁·cos φ + b).
#[test]
fn a_six_link_with_a_short_rod() {
    // φ₂ at which the rod is perpendicular to the guide, and the crank angle that has it.
    let height = |phi: f64| {
        let (x, y) = (100.0 * phi.cos() + 150.0, 100.0 * phi.sin());
        (400.0 * y / x.hypot(y) - 200.0).abs()
    };
    let rod = 210.0;
    let reaches = |phi: f64| height(phi) < rod;
    let (mut low, mut high) = (0.0, -0.5);
    assert!(reaches(low) && !reaches(high));
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if reaches(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let from = f64::to_degrees(low);
    joints_close(&six_link(rod, 100.0, 150.0, &swings(from + 1e-3, 60.0)));
    refuses(
        &six_link(rod, 100.0, 150.0, &swings(from - 1e-3, 60.0)),
        &["starts at", "the rod does not reach the guide"],
    );
    refuses(
        &six_link(rod, 100.0, 150.0, ""),
        &["too short", "over a stroke that stays inside"],
    );
    // The pin passes through the pivot at 180° only.
    joints_close(&six_link(650.0, 100.0, 100.0, &swings(-120.0, 120.0)));
    refuses(
        &six_link(650.0, 100.0, 100.0, &swings(100.0, 200.0)),
        &["passes through the rocker's pivot"],
    );
}

/// A lever whose pivot lies between its two ranges: the pin comes as near as |e| at cos(φ − γ) = (r² + c² − e²)/(2·r·c).
#[test]
fn a_slotted_lever_between_its_ranges() {
    let lever = |stroke: &str| {
        format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"inverted-slider-crank\"\n{stroke}\n\
             crank = {{ length = \"100 mm\", mass = \"1 kg\", inertia = \"1e-3 kg m^2\" }}\n\
             block = {{ mass = \"0.2 kg\", inertia = \"1e-4 kg m^2\" }}\n\
             lever = {{ pivot = [\"0 mm\", \"110 mm\"], offset = \"40 mm\", mass = \"2 kg\", inertia = \"0.02 kg m^2\" }}\n"
        )
    };
    let near = ((1e4 + 12100.0 - 1600.0) / 22000.0_f64).acos().to_degrees();
    joints_close(&lever(&swings(90.0 + near + 1e-3, 450.0 - near - 1e-3)));
    refuses(
        &lever(&swings(200.0, 450.0 - near + 1e-3)),
        &["reaches a dead point", "as near to the lever's pivot"],
    );
    refuses(
        &lever(&swings(90.0, 100.0)),
        &["starts at", "does not reach the crank pin"],
    );
    refuses(
        &lever(""),
        &["neither rocks nor turns", "swing over a stroke"],
    );
}

/// The dead points that a cure names: "… stays inside φ = 12.00° and 80.00°".
fn dead_points(text: &str) -> [f64; 2] {
    let report = rendered(&parse(text).unwrap_err());
    let rest = report
        .split("stays inside φ = ")
        .nth(1)
        .unwrap_or_else(|| panic!("{report}"));
    let mut ends = rest
        .split('°')
        .map(|end| end.trim_start_matches(" and ").parse().unwrap());
    [ends.next().unwrap(), ends.next().unwrap()]
}

/// A knuckle-joint press with a crank too long to turn, and one with a lower link too short: between the dead points of the cure.
#[test]
fn a_toggle_press_over_a_stroke() {
    let press = |crank: f64, lower: f64, stroke: &str| {
        let link = |name: &str, length: f64| {
            format!(
                "{name} = {{ length = \"{length} mm\", mass = \"5 kg\", inertia = \"0.05 kg m^2\" }}\n"
            )
        };
        format!(
            "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"toggle-press\"\npivot = [\"-250 mm\", \"400 mm\"]\nguide = \"400 mm\"\n\
             knee = \"right\"\n{stroke}\n{}{}{}{}ram = {{ mass = \"80 kg\" }}\n",
            link("crank", crank),
            link("rod", 400.0),
            link("upper", 250.0),
            link("lower", lower)
        )
    };
    for (crank, lower, locked) in [
        (300.0, 300.0, "rod and upper link are in line"),
        (60.0, 60.0, "the lower link is perpendicular to the guide"),
    ] {
        let [from, to] = dead_points(&press(crank, lower, ""));
        assert!(to > from && to - from < 360.0, "{from} {to}");
        joints_close(&press(crank, lower, &swings(from + 0.1, to - 0.1)));
        let beyond = press(crank, lower, &swings(from + 0.1, to + 0.1));
        refuses(&beyond, &["reaches a dead point", locked]);
    }
}
