//! The page for a request for quotation.

use jred_sizing::select::requirement::{Requirement, TorqueNeed};

use super::chart::{Chart, ChartKind};
use super::figures::{dashed, line};
use super::section::{Figure, Page, Section};
use crate::list::require::{RequirementView, name};
use crate::plot::{Axes, Axis};

/// The page of a machine's requirements.
pub fn require_page(shown: &RequirementView) -> String {
    let torque = shown.words().torque;
    let mut sections: Vec<Section> = (shown.described().into_iter())
        .map(|found| plane(shown, found))
        .collect();
    sections.push(Section::new(
        "The region of suitable motors",
        vec![
            region(
                shown,
                &format!("S1 {torque}"),
                |need| need.s1_torque,
                format!("Least S1 {torque} at the mean speed, from the smallest rotor that the inertia ratio allows: a motor on the curve of its ratio or above satisfies the rule."),
            ),
            region(
                shown,
                &format!("peak {torque}"),
                |need| need.peak_torque,
                format!("Least peak {torque}: a motor on the curve of its ratio or above satisfies the rule, if it has this {torque} up to its maximum speed."),
            ),
        ],
    ));
    Page::page(
        shown.inquiry.file,
        "requirements",
        "requirements of the drive, for a request for quotation",
        &shown.answer(),
        sections,
    )
}

/// The duty of the largest motor of the window, and the least limits.
fn plane(shown: &RequirementView, found: &Requirement) -> Section {
    let words = shown.words();
    let (torque, speed) = (words.torque, words.speed);
    let scale = speed.scale;
    let scaled = |points: &[[f64; 2]]| points.iter().map(|[n, t]| (n / scale, *t)).collect();
    let end = found.max_speed;
    let (most, s1) = (found.peak_torque, found.s1_torque);
    let labels = [
        format!("{} [{}]", speed.word, speed.unit),
        format!("{} [{}]", torque.word, torque.unit),
        format!("peak {torque} over speed"),
        format!("peak {torque}, constant"),
        format!("S1 {torque} up to the mean speed"),
    ];
    let [x, y, least, constant, continuous] = &labels;
    let series = [
        line("duty", scaled(&shown.inquiry.duty_points(found))),
        dashed(least, scaled(&found.envelope)),
        dashed(constant, scaled(&[[0.0, most], [end, most]])),
        dashed(continuous, scaled(&[[0.0, s1], [found.mean_speed, s1]])),
    ];
    let axes = Axes {
        title: "",
        x: Axis::new(x),
        y,
    };
    let caption = format!(
        "Magnitudes over the cycle with the largest {} of the window, and limits of a motor that satisfies the rules: constant, or over speed.",
        words.rotor
    );
    let chart = Chart::new(ChartKind::Plane, &axes, &series);
    Section::new(
        format!("Motor at {}", name(found.ratio)),
        vec![Figure::live(&chart, caption)],
    )
}

/// A torque over the rotor's inertia, for every ratio.
fn region(
    shown: &RequirementView,
    what: &str,
    of: fn(&TorqueNeed) -> f64,
    caption: String,
) -> Figure {
    let words = shown.words();
    let inertia = words.inertia;
    let x = format!("{} and brake [{}]", words.rotor, inertia.unit);
    let y = format!("{what} [{}]", words.torque.unit);
    let axes = Axes {
        title: "",
        x: Axis::new(&x),
        y: &y,
    };
    let near = shown.near_described();
    let names: Vec<String> = near.iter().map(|r| name(r.ratio)).collect();
    let each = near.iter().zip(&names);
    let series: Vec<_> = each
        .map(|(found, name)| {
            let allowed = shown.boundary(found);
            let allowed = allowed
                .iter()
                .filter(|need| need.rotor >= found.smallest_rotor);
            line(
                name,
                allowed
                    .map(|need| (need.rotor / inertia.scale, of(need)))
                    .collect(),
            )
        })
        .collect();
    Figure::live(&Chart::new(ChartKind::Course, &axes, &series), caption)
}
