//! Figures of the machine, and of a simulation.

use jred::{Error, Reducible as _};

use super::chart::{Chart, Form};
use crate::plot::{Axes, Series, Style, lines};
use jred_machine::model::coordinate::{Coordinate, whole_range};
use jred_machine::model::machine::MachineFile;
use jred_machine::number::columns::Columns;

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

/// J_red and J_red′ over the range.
pub(super) fn reduced_inertia(file: &MachineFile) -> Result<Chart, Error> {
    let machine = file.with_drive_train()?;
    let coordinate = Coordinate::of(machine.mechanism())?;
    let (mut inertia, mut slope) = (Vec::new(), Vec::new());
    for phi in whole_range(machine.domain(), POSITIONS) {
        let point = machine.reduction(phi)?;
        inertia.push((coordinate.shown(phi), point.inertia[0]));
        slope.push((coordinate.shown(phi), point.inertia[1]));
    }
    let (y, slope_y, names) = match coordinate {
        Coordinate::Angle => ("J_red [kg·m²]", "J_red′ [kg·m²/rad]", ["J_red", "J_red′"]),
        Coordinate::Length => ("m_red [kg]", "m_red′ [kg/m]", ["m_red", "m_red′"]),
    };
    let axes = Axes {
        title: "",
        x: coordinate.axis(),
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
    let coordinate = Coordinate::of(file.machine.mechanism())?;
    let mut parts = [const { Vec::new() }; 4];
    for phi in whole_range(file.machine.domain(), POSITIONS) {
        let point = file.bare_reduction(phi)?;
        let values = [
            -point.potential_energy[1],
            point.process,
            -point.viscous * speed,
            -point.coulomb,
        ];
        for (part, value) in parts.iter_mut().zip(values) {
            part.push((coordinate.shown(phi), value));
        }
    }
    let names = [
        "weight −U′",
        "process",
        "viscous −b·ω at mean speed",
        "opposing −c",
    ];
    let series: Vec<Series> = names
        .into_iter()
        .zip(parts)
        .filter(|(_, points)| points.iter().any(|p| p.1 != 0.0))
        .map(|(name, points)| line(name, points))
        .collect();
    let axes = Axes {
        title: "",
        x: coordinate.axis(),
        y: match coordinate {
            Coordinate::Angle => "reduced torque [N·m]",
            Coordinate::Length => "reduced force [N]",
        },
    };
    Ok(Chart::new(Form::Course, &axes, &series))
}

/// The plots of a simulation, with their headings.
pub(super) fn simulation(run: &Columns) -> Vec<(&'static str, String)> {
    let column = |name: &str| -> Vec<(f64, f64)> {
        let index = run.names().iter().position(|n| n == name);
        let value = |row: &[Option<f64>], k: usize| row.get(k).copied().flatten();
        let rows = run.rows().iter();
        rows.filter_map(|row| Some((value(row, 0)?, value(row, index?)?)))
            .collect()
    };
    let has = |name: &str| run.names().iter().any(|n| n == name);
    let plot = |y: &str, names: &[&str]| {
        let series: Vec<Series> = names.iter().map(|n| line(n, column(n))).collect();
        let axes = Axes {
            title: "",
            x: "time [s]",
            y,
        };
        lines(&axes, &series)
    };
    let coordinate = if has(Coordinate::Length.column()) {
        Coordinate::Length
    } else {
        Coordinate::Angle
    };
    let (position, place, speed) = match coordinate {
        Coordinate::Angle => ("Angle of the drive link", "φ [deg]", "ω [rad/s]"),
        Coordinate::Length => ("Position of the drive link", "s [mm]", "v [m/s]"),
    };
    let force = "motor force [N]";
    let (effort, motor) = if has(force) {
        ("Motor force", plot("force [N]", &[force]))
    } else {
        let torque = plot("torque [N·m]", &["motor torque [N m]"]);
        ("Motor torque", torque)
    };
    let energies = [
        "kinetic energy [J]",
        "potential energy [J]",
        "motor work [J]",
        "process work [J]",
        "losses [J]",
    ];
    vec![
        (
            "Speed of the drive link",
            plot(speed, &[coordinate.rates()[0]]),
        ),
        (position, plot(place, &[coordinate.column()])),
        (effort, motor),
        ("Energies", plot("energy [J]", &energies)),
        (
            "Energy balance: zero except for the integration error",
            plot("energy [J]", &["energy balance [J]"]),
        ),
    ]
}
