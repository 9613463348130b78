//! The results as pictures.

use jred_report::plot::{Axes, Axis, Series, Style, lines};

use crate::Fault;
use crate::feed_forward::Way;
use crate::machine::{CASES, Deviation};
use crate::study::{Bench, Run};

/// The feedback torque of the press over its pace.
pub(crate) fn over_pace() -> Result<String, Fault> {
    let [press, ..] = CASES;
    let file = press.read()?;
    let bench = Bench::new(press, &file)?;
    let paces = [4_u8, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14].map(|tenths| f64::from(tenths) / 10.0);
    let mut series = Vec::new();
    for way in [
        Way::None,
        Way::MeanInertia,
        Way::MeanFriction,
        Way::TorqueTable,
        Way::Float,
    ] {
        let found = bench.found(way, &paces.map(Run::at))?;
        let points = paces.iter().map(|pace| 120.0 * pace);
        let points = points.zip(found.iter().map(|found| found.feedback));
        series.push(Series {
            name: way.name().trim_end_matches(", `f32`"),
            points: points.collect(),
            style: Style::Line,
        });
    }
    let axes = Axes {
        title: "Press, idle stroke",
        x: Axis::new("strokes a minute"),
        y: "RMS feedback torque [N m]",
    };
    Ok(lines(&axes, &series))
}

/// The feedback torque of the press over a cycle.
pub(crate) fn over_cycle() -> Result<String, Fault> {
    let [press, ..] = CASES;
    let file = press.read()?;
    let bench = Bench::new(press, &file)?;
    let mut series = Vec::new();
    for (name, way, deviation) in [
        ("constant J", Way::MeanInertia, Deviation::None),
        ("jred", Way::Float, Deviation::None),
        ("jred, J +20 %", Way::Float, Deviation::Inertia(1.2)),
    ] {
        let mut points = Vec::new();
        bench.with(way, |ahead| {
            bench.observe(ahead, Run::with(deviation), |time, seen| {
                points.push((1000.0 * time, f64::from(seen.feedback)));
            })
        })?;
        series.push(Series {
            name,
            points,
            style: Style::Line,
        });
    }
    let axes = Axes {
        title: "Press, idle stroke, 120 a minute",
        x: Axis::new("time [ms]"),
        y: "feedback torque [N m]",
    };
    Ok(lines(&axes, &series))
}
