//! Figures of the machine, and of a simulation.

use jred::machine::Mechanism as _;
use jred::{Error, Reducible as _};

use super::chart::{Chart, ChartKind};
use crate::plot::{Axes, Axis, Series, Style, lines};
use jred_machine::model::coordinate::{Coordinate, whole_range};
use jred_machine::model::machine::MachineFile;
use jred_machine::model::simulation::Simulation;
use jred_machine::number::columns::{Columns, Quantity};

/// Intervals of the figures over the range.
const POSITIONS: usize = 360;

pub(super) fn line(name: &str, points: Vec<(f64, f64)>) -> Series<'_> {
    Series {
        name,
        points,
        style: Style::Line,
    }
}

pub(super) fn dashed(name: &str, points: Vec<(f64, f64)>) -> Series<'_> {
    Series {
        name,
        points,
        style: Style::Dashed,
    }
}

/// What the curves over the position do not contain, as a sentence after a caption; empty if that is nothing.
pub(super) fn not_contained(file: &MachineFile) -> String {
    let missing: Vec<String> = file.scheduled().map(|item| item.what).collect();
    if missing.is_empty() {
        return String::new();
    }
    format!(
        " Not contained, because it goes by the motion: {}.",
        missing.join("; ")
    )
}

/// J_red and J_red′ over the range.
pub(super) fn reduced_inertia(file: &MachineFile) -> Result<Chart, Error> {
    let machine = file.with_drive_train()?;
    let coordinate = machine.mechanism().coordinate();
    let (mut inertia, mut slope) = (Vec::new(), Vec::new());
    for phi in whole_range(machine.domain(), POSITIONS) {
        let point = machine.reduction(phi)?;
        inertia.push((coordinate.shown(phi), point.inertia));
        slope.push((coordinate.shown(phi), point.inertia_slope));
    }
    let (y, slope_y, names) = match coordinate {
        Coordinate::Angle => ("J_red [kg·m²]", "J_red′ [kg·m²/rad]", ["J_red", "J_red′"]),
        Coordinate::Length => ("m_red [kg]", "m_red′ [kg/m]", ["m_red", "m_red′"]),
    };
    let axes = Axes {
        title: "",
        x: Axis::of(coordinate),
        y,
    };
    Ok(Chart::two_axes(
        &axes,
        &[line(names[0], inertia)],
        slope_y,
        &[dashed(names[1], slope)],
    ))
}

/// The parts of the reduced torque over the range; the viscous one at the size of the speed `speed`.
pub(super) fn reduced_torque(file: &MachineFile, speed: f64) -> Result<Chart, Error> {
    let coordinate = file.machine.mechanism().coordinate();
    let mut parts = [const { Vec::new() }; 4];
    let mut sprung = false;
    for phi in whole_range(file.machine.domain(), POSITIONS) {
        let point = file.bare_reduction(phi)?;
        let frames = file.machine.mechanism().frames(phi)?;
        let elements = file.machine.elements();
        sprung |= elements.iter().any(|e| e.effort(&frames, 0.0) != 0.0);
        let values = [
            -point.potential_slope,
            point.process,
            -point.viscous * speed,
            -point.coulomb,
        ];
        for (part, value) in parts.iter_mut().zip(values) {
            part.push((coordinate.shown(phi), value));
        }
    }
    let potential = if sprung {
        "weight and springs −U′"
    } else {
        "weight −U′"
    };
    let viscous = match coordinate {
        Coordinate::Angle => "viscous −b·ω at mean speed",
        Coordinate::Length => "viscous −b·v at mean speed",
    };
    let names = [potential, "process", viscous, "opposing −c"];
    let series: Vec<Series> = names
        .into_iter()
        .zip(parts)
        .filter(|(_, points)| points.iter().any(|p| p.1 != 0.0))
        .map(|(name, points)| line(name, points))
        .collect();
    let axes = Axes {
        title: "",
        x: Axis::of(coordinate),
        y: match coordinate {
            Coordinate::Angle => "reduced torque [N·m]",
            Coordinate::Length => "reduced force [N]",
        },
    };
    Ok(Chart::new(ChartKind::Course, &axes, &series))
}

/// The plots of a simulation, with their headings.
pub(super) fn simulation(
    file: &MachineFile,
    simulation: &Simulation,
    run: &Columns,
) -> Vec<(&'static str, String)> {
    let plot = |y: &str, quantity: Quantity| {
        let chosen = run.of(quantity);
        let titles: Vec<(usize, String)> = chosen.map(|(k, head)| (k, head.title())).collect();
        let series: Vec<Series> = titles
            .iter()
            .map(|(k, title)| {
                let value = |row: &[Option<f64>], k: usize| row.get(k).copied().flatten();
                let points = run.rows().iter();
                let points = points.filter_map(|row| Some((value(row, 0)?, value(row, *k)?)));
                line(title, points.collect())
            })
            .collect();
        let axes = Axes {
            title: "",
            x: Axis::new("time [s]"),
            y,
        };
        lines(&axes, &series)
    };
    let (position, place, speed) = match file.machine.mechanism().coordinate() {
        Coordinate::Angle => ("Angle of the drive link", "φ [deg]", "ω [rad/s]"),
        Coordinate::Length => ("Position of the drive link", "s [mm]", "v [m/s]"),
    };
    let (effort, motor) = if simulation.drives_a_slide(file) {
        ("Motor force", "force [N]")
    } else {
        ("Motor torque", "torque [N·m]")
    };
    vec![
        ("Speed of the drive link", plot(speed, Quantity::DriveSpeed)),
        (position, plot(place, Quantity::Position)),
        (effort, plot(motor, Quantity::MotorEffort)),
        ("Energies", plot("energy [J]", Quantity::Energy)),
        (
            "Energy balance: zero except for the integration error",
            plot("energy [J]", Quantity::EnergyBalance),
        ),
    ]
}
