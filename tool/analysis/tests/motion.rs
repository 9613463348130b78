//! Prescribed motions: warnings, and a duty that does not depend on the coordinate that is prescribed.

use std::f64::consts::PI;

use jred_analysis::duty::Duty;
use jred_analysis::warnings::warnings;

use crate::reading::{belt_motion, read, with_motion};
use crate::support::press::slider_derivatives;
use crate::support::within;

fn steady(from: f64) -> String {
    format!("law = \"constant-speed\"; speed = \"60 rpm\"; move = \"{from} deg\"")
}

/// The check says what the segment does, and a cure that helps.
#[test]
fn an_overshoot_is_a_warning_with_a_cure() {
    let said = |segments: &[&str]| {
        let file = read(&belt_motion("point-to-point", segments));
        warnings(&file).unwrap()
    };
    let start = steady(20.0);
    let stop = |more: &str| format!("law = \"polynomial-5\"; move = \"140 deg\"; {more}");
    let warned = said(&[&start, &stop("duration = \"1 s\"")]);
    let says = "segment 2 goes 0.004157 deg beyond its end and comes back: ";
    assert!(
        warned.len() == 1 && warned[0].starts_with(says),
        "{warned:?}"
    );
    assert!(warned[0].contains("shorter duration"), "{warned:?}");
    assert!(said(&[&start, &stop("duration = \"0.97 s\"")]).is_empty());
    let warned = said(&[&stop("duration = \"1 s\""), &start]);
    let says = "segment 1 first goes 0.004157 deg the other way: ";
    assert!(
        warned.len() == 1 && warned[0].starts_with(says),
        "{warned:?}"
    );
    // The acceleration with which the next segment starts makes it come to rest from beyond its end, in however short a time.
    let jump = "law = \"simple-sine\"; move = \"90 deg\"; duration = \"1 s\"";
    let warned = said(&[&start, &stop("duration = \"0.9 s\""), jump]);
    assert!(warned.len() == 1, "{warned:?}");
    assert!(warned[0].contains("end_acceleration of zero"), "{warned:?}");
    let level = stop("duration = \"0.9 s\"; end_acceleration = \"0 rad/s^2\"");
    assert!(said(&[&start, &level, jump]).is_empty());
}

/// The duty of a table that is indexed is the same, whether its motion or that of its motor shaft is given, corners included.
#[test]
fn a_duty_does_not_depend_on_what_is_prescribed() {
    let duty = |motion: &str| {
        let file = read(&with_motion("turntable.toml", motion));
        Duty::new(&file, file.motion.as_ref().unwrap(), 400).unwrap()
    };
    let segments = |way: &str| {
        format!(
            "[[motion.segment]]; law = \"trapezoid\"; move = \"{way}\"; duration = \"0.6 s\"; [[motion.segment]]; dwell = \"0.4 s\""
        )
    };
    let table = duty(&format!(
        "type = \"cycle\"; of = {{ link = \"shaft-3\" }}; {}",
        segments("90 deg")
    ));
    let shaft = duty(&format!("type = \"cycle\"; {}", segments("1080 deg")));
    assert_eq!(table.instants.len(), shaft.instants.len());
    let most = shaft.figures(|i| i.input_torque).max.abs();
    assert!(most > 1.0);
    for (a, b) in table.instants.iter().zip(&shaft.instants) {
        within("t", a.t, b.t, 1e-15);
        within("torque", a.input_torque, b.input_torque, 1e-11 * most);
        within("speed", a.input_speed, b.input_speed, 1e-11 * 60.0);
    }
}

/// Close to a dead centre the crank goes far for little of the ram: the warning has the distance and the factor.
#[test]
fn near_a_dead_centre_is_a_warning() {
    let said = |distance: f64| {
        let motion = format!(
            "type = \"cycle\"; of = {{ point = \"slider\", along = \"x\" }}; near = \"90 deg\"; start = \"180 mm\"; \
             [[motion.segment]]; law = \"modified-sine\"; move = \"{0} mm\"; duration = \"0.2 s\"; \
             [[motion.segment]]; law = \"modified-sine\"; move = \"-{0} mm\"; duration = \"0.2 s\"",
            30.0 - distance
        );
        let file = read(&with_motion("press.toml", &motion));
        let found = warnings(&file).unwrap();
        found
            .into_iter()
            .find(|words| words.contains("dead centre"))
    };
    assert_eq!(said(1.0), None);
    let warning = said(0.01).unwrap();
    // Where x = 209.99 mm: (x² + r² − l²)/(2·x·r) = cos φ by the law of cosines.
    let (r, l, x) = (0.03f64, 0.18f64, 0.20999f64);
    let phi = ((x * x + r * r - l * l) / (2.0 * x * r)).acos();
    let slope = slider_derivatives(phi)[1].abs();
    let most = (0..=9000).map(|k| slider_derivatives(f64::from(k) * PI / 9000.0)[1].abs());
    let most = most.fold(0.0, f64::max);
    assert!(most / slope > 20.0);
    for words in [
        "x of slider comes within 0.01 mm of its dead centre".to_owned(),
        format!("φ = {:.4} deg", phi.to_degrees()),
        format!("the drive link goes {:.2}", (0.001 / slope).to_degrees()),
        format!(" {:.2} times", most / slope),
    ] {
        assert!(warning.contains(&words), "{words:?} is not in {warning}");
    }
}
