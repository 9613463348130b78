//! Figures of the machine, and of a simulation.

use jred::error::Error;
use jred::machine::{Mechanism as _, Reducible as _};

use super::chart::{Chart, ChartKind};
use super::section::{Figure, Section, over};
use crate::plot::{Axes, Axis, Series, Style};
use jred_file::model::coordinate::{Coordinate, whole_range};
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::{Column, ColumnQuantity, Columns};

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

/// Sentence for a caption about parts that the curves over the position do not contain; empty without such parts.
pub(super) fn not_contained(file: &MachineFile) -> String {
    let scheduled = file.scheduled().map(|item| item.what);
    let missing: Vec<String> = scheduled.chain(file.frictions_in_words()).collect();
    if missing.is_empty() {
        return String::new();
    }
    format!(
        " Not contained, because it follows the motion: {}.",
        missing.join("; ")
    )
}

/// J_red and J_red′ over the range.
pub(super) fn reduced_inertia(file: &MachineFile) -> Result<Chart, Error> {
    let machine = file.with_drive_train()?;
    let coordinate = machine.mechanism().coordinate();
    let (mut inertia, mut slope) = (Vec::new(), Vec::new());
    for phi in whole_range(machine.domain(), POSITIONS) {
        let point = machine.bare_reduction(phi)?;
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

/// The parts of the reduced torque over the range, the viscous part at the speed `speed`.
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

/// The sections of a simulation: its columns over the time.
pub(super) fn simulation(run: &Columns) -> Vec<Section> {
    let over_time = (ColumnQuantity::Time, Axis::new("time [s]"));
    let own = |quantity: ColumnQuantity| {
        let label = run.of(quantity).next().map(|(_, head)| label(head));
        over(run, over_time, (&label.unwrap_or_default(), quantity))
    };
    let figure =
        |(quantity, caption): (ColumnQuantity, &str)| Some(Figure::new(own(quantity)?, caption));
    let figures = |of: &[(ColumnQuantity, &str)]| of.iter().copied().filter_map(figure).collect();
    let energies = [
        (ColumnQuantity::Energy, "energy [J]", "Energies and works."),
        (
            ColumnQuantity::EnergyBalance,
            "energy [J]",
            "Energy balance: zero except for the integration error.",
        ),
    ];
    let energies = energies.into_iter().filter_map(|(quantity, y, caption)| {
        Some(Figure::new(over(run, over_time, (y, quantity))?, caption))
    });
    let motion = [
        (ColumnQuantity::Position, "Position."),
        (ColumnQuantity::DriveSpeed, "Speed."),
        (ColumnQuantity::DriveAcceleration, "Acceleration."),
        (ColumnQuantity::FollowingError, "Reference less position."),
    ];
    let motor = [
        (
            ColumnQuantity::MotorEffort,
            "What the motor gives, and the brake after it.",
        ),
        (ColumnQuantity::MotorSpeed, "Speed of the motor."),
        (
            ColumnQuantity::GearboxTorque,
            "Torque at the output of the gearbox.",
        ),
        (ColumnQuantity::Temperature, "Temperature of the motor."),
    ];
    let sections = [
        Section::new("Motion", figures(&motion)),
        Section::new("Motor", figures(&motor)),
        Section::new("Energies", energies.collect()),
        Section::new("Parts of the drive torque", efforts(run, over_time)),
        Section::new("Motion of points and links", motions(run, over_time)),
        Section::new("Forces", forces(run, over_time)),
    ];
    let sections = sections.into_iter();
    sections
        .filter(|section| !section.figures.is_empty())
        .collect()
}

/// The axis label of a single column.
fn label(head: &Column) -> String {
    head.title().replace("^2", "²").replace("N m", "N·m")
}

/// The abscissa and its axis.
pub(super) type Abscissa<'a> = (ColumnQuantity, Axis<'a>);

/// Figures of those of the quantities that exist, each with its label and caption.
pub(super) fn among(
    columns: &Columns,
    along: Abscissa,
    of: &[(&str, ColumnQuantity, &str)],
) -> Vec<Figure> {
    let figures = of.iter().filter_map(|(y, quantity, caption)| {
        Some(Figure::new(over(columns, along, (y, *quantity))?, *caption))
    });
    figures.collect()
}

fn efforts(columns: &Columns, along: Abscissa) -> Vec<Figure> {
    let Some((_, head)) = columns.of(ColumnQuantity::EffortTerm).next() else {
        return Vec::new();
    };
    let y = format!("drive {}", unit(head));
    let caption = "What the drive link must be given: for the acceleration, for the change of the inertia (velocity), for weight and springs \
                   (potential), process loads, viscous and dry friction. The drive train is included, its losses are not.";
    among(columns, along, &[(&y, ColumnQuantity::EffortTerm, caption)])
}

/// Torque or force, with its unit.
fn unit(head: &Column) -> &'static str {
    if head.unit == "N" {
        "force [N]"
    } else {
        "torque [N·m]"
    }
}

/// Positions, speeds and accelerations of points and links.
pub(super) fn motions(columns: &Columns, along: Abscissa) -> Vec<Figure> {
    let of = [
        (
            "speed [m/s]",
            ColumnQuantity::Speed,
            "Speed of every point (magnitude).",
        ),
        (
            "acceleration [m/s²]",
            ColumnQuantity::Acceleration,
            "Acceleration of every point (magnitude).",
        ),
        (
            "angular speed [rad/s]",
            ColumnQuantity::AngularSpeed,
            "Angular speed of every link.",
        ),
        (
            "angular acceleration [rad/s²]",
            ColumnQuantity::AngularAcceleration,
            "Angular acceleration of every link.",
        ),
    ];
    among(columns, along, &of)
}

/// Drive, joints, shaking force.
pub(super) fn forces(columns: &Columns, along: Abscissa) -> Vec<Figure> {
    if columns.of(ColumnQuantity::Force).next().is_none() {
        return Vec::new();
    }
    let drive = columns.of(ColumnQuantity::DriveEffort).next();
    let drive = drive.map_or("torque [N·m]", |(_, head)| unit(head));
    let of = [
        (
            &*format!("drive {drive}"),
            ColumnQuantity::DriveEffort,
            "Required drive torque or force at the drive link by d'Alembert's principle, drive train included.",
        ),
        (
            "force [N]",
            ColumnQuantity::Force,
            "Magnitude of the force in every joint, and of the shaking force of all links on the frame.",
        ),
        (
            "moment [N·m]",
            ColumnQuantity::Moment,
            "Moments in guides and transmissions, and the shaking moment about the origin.",
        ),
    ];
    among(columns, along, &of)
}
