//! The page of an identified machine.

use super::chart::{Chart, ChartKind};
use super::figures::{dashed, line};
use super::section::{Figure, Page, Section};
use crate::list::identify::IdentifyView;
use crate::plot::{Axes, Axis};

/// The page: the identified curves with their bands against the design.
pub fn identify_page(shown: &IdentifyView) -> String {
    let curves = shown.curves();
    let degrees = |k: usize| k as f64 * 360.0 / curves.len().max(1) as f64;
    let plot = |y: &str, values: Vec<[f64; 3]>, caption: &str| {
        let of = |pick: fn(&[f64; 3]) -> f64| {
            let each = values.iter().enumerate();
            each.map(|(k, v)| (degrees(k), pick(v))).collect()
        };
        let series = [
            line("identified", of(|v| v[0])),
            dashed("designed", of(|v| v[2])),
            dashed("band, upper", of(|v| v[0] + v[1])),
            dashed("band, lower", of(|v| v[0] - v[1])),
        ];
        let axes = Axes {
            title: "",
            x: Axis::new("phi [deg]"),
            y,
        };
        Figure::live(&Chart::new(ChartKind::Course, &axes, &series), caption)
    };
    let inertia = curves.iter().zip(&shown.designed);
    let inertia = inertia.map(|(p, d)| [p.inertia.value, p.inertia.band, d.inertia]);
    let potential = curves.iter().zip(shown.slopes());
    let potential = potential.map(|(p, d)| [p.potential_slope.value, p.potential_slope.band, d]);
    let sections = vec![Section::new(
        "Designed and identified curves",
        vec![
            plot(
                "J [kg·m²]",
                inertia.collect(),
                "Reduced inertia with its 95 % band.",
            ),
            plot(
                "V′ [N·m]",
                potential.collect(),
                "Slope of the potential energy: weight and springs; in a log of one direction with the part of friction that depends on the angle.",
            ),
        ],
    )];
    Page::page(
        shown.file,
        "identified machine",
        "the machine's curves from a log of its drive, against the design",
        &shown.answer(),
        sections,
    )
}
