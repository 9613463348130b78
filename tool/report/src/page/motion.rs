//! Pages about motions: the fastest, the gentlest, the steady cycle.

use jred::error::Error;
use jred::machine::motion::State;
use jred_analysis::simulate::CoupledMachines;
use jred_analysis::steady::Steady;
use jred_file::model::axis::Axis as Place;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::number::columns::ColumnQuantity;
use jred_file::number::rounding::short;
use jred_motion::fastest::Binding;
use jred_motion::fastest::cycle::FastestMove;
use jred_motion::fastest::plane::Plane;
use jred_motion::path_dynamics::{Actuator, BothDirections};
use jred_motion::trace::Trace;
use jred_sizing::select::fit::input_kind;

use super::figures::{dashed, line};
use super::section::{Figure, Page, Section, plot};
use crate::list;
use crate::plot::{Axes, Axis, Series, lines};
use crate::table::output::Format;

/// Number of instants of a drawn motion.
const INSTANTS: usize = 1501;

/// Number of motion laws drawn next to the gentlest motion.
const LAWS: usize = 2;

/// Limits above this multiple of the motion's speed are not drawn; they would flatten the curve.
const FAR: f64 = 2.0;

/// A named motion as points over the time: position, speed and acceleration of the axis, torque of the motor.
struct MotionSeries {
    name: String,
    rows: Vec<[f64; 5]>,
}

impl MotionSeries {
    fn of(
        name: impl Into<String>,
        file: &MachineFile,
        actuator: &Actuator,
        states: impl Iterator<Item = (f64, State<f64>, f64)>,
    ) -> Result<Self, Error> {
        let (axis, ways) = (file.axis(), BothDirections::new(file, actuator));
        let row = |(t, state, heading): (f64, State<f64>, f64)| {
            let torque = ways.torque(&state, heading)?;
            let shown = axis.state(&state);
            let position = axis.coordinate.shown(shown.phi);
            Ok([t, position, shown.omega, shown.alpha, torque])
        };
        let rows = states.map(row).collect::<Result<_, Error>>()?;
        Ok(Self {
            name: name.into(),
            rows,
        })
    }

    /// The nodes of a trace, both accelerations at a jump.
    fn of_trace(
        name: &str,
        file: &MachineFile,
        actuator: &Actuator,
        trace: &Trace,
    ) -> Result<Self, Error> {
        let nodes = trace.nodes();
        let stride = nodes.len().div_ceil(INSTANTS).max(1);
        let jumps = |[before, after]: [f64; 2]| before.total_cmp(&after).is_ne();
        let kept = (nodes.windows(2).enumerate())
            .filter(|(k, pair)| k % stride == 0 || jumps(pair[0].alpha) || jumps(pair[1].alpha));
        let states = kept.flat_map(|(_, pair)| {
            let [a, b] = [&pair[0], &pair[1]];
            let heading = b.phi - a.phi;
            [(a, a.alpha[1]), (b, b.alpha[0])].map(|(node, alpha)| {
                let (phi, omega) = (node.phi, node.omega);
                (node.t, State { phi, omega, alpha }, heading)
            })
        });
        Self::of(name, file, actuator, states)
    }

    fn of_motion(
        name: &str,
        file: &MachineFile,
        actuator: &Actuator,
        motion: &Motion,
    ) -> Result<Self, Error> {
        let duration = motion.duration();
        let last = INSTANTS - 1;
        let at = |k: usize| duration * k as f64 / last as f64;
        let states = (0..=last).map(|k| {
            let [t, before, after] = [k, k.saturating_sub(1), (k + 1).min(last)].map(at);
            let heading = motion.at(after).phi - motion.at(before).phi;
            (t, motion.at(t), heading)
        });
        Self::of(name, file, actuator, states)
    }
}

/// Position, speed, acceleration and torque of motions over the time, the first as a solid line.
fn over_time(
    file: &MachineFile,
    courses: &[MotionSeries],
    limits: &[(&str, Vec<(f64, f64)>)],
) -> Section {
    let axis = file.axis();
    let torque = input_kind(file).vocabulary().torque;
    let rates = axis.coordinate.rates();
    let [speed, acceleration] = rates.map(|rate| rate.unit.replace("^2", "²"));
    let labels = [
        format!("{} [{}]", axis.symbol(), axis.coordinate.unit()),
        format!("speed [{speed}]"),
        format!("acceleration [{acceleration}]"),
        format!("motor {} [{}]", torque.word, torque.unit),
    ];
    let captions = [
        "Position.".to_owned(),
        "Speed.".to_owned(),
        "Acceleration.".to_owned(),
        format!(
            "{} of the motor{}.",
            torque.capital(),
            if limits.is_empty() {
                ""
            } else {
                ", and what it has at its speed, driving and braking"
            }
        ),
    ];
    let figure = |(k, (label, caption)): (usize, (String, String))| {
        // For a single motion the axis label is enough.
        let named = courses.len() > 1 || (k == 3 && !limits.is_empty());
        let mut series: Vec<Series> = Vec::new();
        for course in courses {
            let points = course.rows.iter().map(|row| (row[0], row[k + 1])).collect();
            series.push(line(if named { &course.name } else { "" }, points));
        }
        if k == 3 {
            series.extend(
                limits
                    .iter()
                    .map(|(name, points)| dashed(name, points.clone())),
            );
        }
        let axes = Axes {
            title: "",
            x: Axis::new("time [s]"),
            y: &label,
        };
        Figure::new(lines(&axes, &series), caption)
    };
    let figures = labels.into_iter().zip(captions).enumerate().map(figure);
    Section::new("Over the time", figures.collect())
}

/// The phase plane of a move.
fn plane(
    file: &MachineFile,
    axis: &Place,
    actuator: &Actuator,
    made: &FastestMove,
) -> Result<Figure, Error> {
    let plane = Plane::of(file, actuator, made)?;
    let shown = |points: &[[f64; 2]]| -> Vec<(f64, f64)> {
        let points = points.iter();
        points
            .map(|[phi, v]| (axis.shown(*phi), axis.rate(*v)))
            .collect()
    };
    // One curve per limit, broken between its stretches.
    let mut curves: Vec<(Binding, Vec<(f64, f64)>)> = Vec::new();
    for (limit, points) in &plane.stretches {
        let at = curves.iter().position(|(known, _)| known == limit);
        let at = at.unwrap_or_else(|| {
            curves.push((*limit, Vec::new()));
            curves.len() - 1
        });
        let (_, curve) = &mut curves[at];
        if !curve.is_empty() {
            curve.push((f64::NAN, f64::NAN));
        }
        curve.extend(shown(points));
    }
    let named = (curves.into_iter()).map(|(limit, points)| (limit.name_in(file), points));
    let curves: Vec<_> = named.collect();
    let mut series: Vec<Series> = curves
        .iter()
        .map(|(name, points)| line(name, points.clone()))
        .collect();
    let most = FAR * plane.fastest();
    for (name, points) in [
        ("largest speed", &plane.ceiling),
        ("largest speed that can be kept", &plane.holding),
    ] {
        let mut points = shown(points);
        let most = axis.rate(most);
        for point in &mut points {
            if point.1 > most {
                point.1 = f64::NAN;
            }
        }
        if points.iter().any(|(_, v)| v.is_finite()) {
            series.push(dashed(name, points));
        }
    }
    let x = format!("{} [{}]", axis.symbol(), axis.coordinate.unit());
    let y = format!("speed [{}]", axis.coordinate.speed_unit());
    let axes = Axes {
        title: "",
        x: Axis {
            label: &x,
            degrees: axis.coordinate == Coordinate::Angle,
        },
        y: &y,
    };
    let caption = format!(
        "From {} to {} in {} s: speed over the position. Each stretch has the colour of its active limit; each change of colour is a switching \
         point. Dashed: speeds that the motion cannot pass, and the largest speed that the limits allow at a position: above it the machine can only slow down.",
        axis.place(made.task.from),
        axis.place(made.task.to),
        short(made.fastest.time)
    );
    Ok(Figure::new(lines(&axes, &series), caption))
}

/// The winding temperature over the time, if it is computed.
fn winding(warmth: &list::fastest::WindingHeat) -> Option<Section> {
    let course = &warmth.temperatures.course;
    let (first, last) = course.first().zip(course.last())?;
    let stride = course.len().div_ceil(INSTANTS).max(1);
    let points = course.iter().step_by(stride).chain(course.last());
    let limit = [first.0, last.0].map(|t| (t, warmth.limit));
    let series = [
        line("winding", points.copied().collect()),
        dashed("limit", limit.to_vec()),
    ];
    let axes = Axes {
        title: "",
        x: Axis::new("time [s]"),
        y: "temperature [°C]",
    };
    let caption = "Temperature of the winding when the motion with its pauses repeats endlessly.";
    let figure = Figure::new(lines(&axes, &series), caption.to_owned());
    Some(Section::new("Winding", vec![figure]))
}

/// The page about the fastest motion.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub fn fastest_page(view: &list::fastest::FastestView) -> Result<String, Error> {
    let list::fastest::FastestView {
        file,
        actuator,
        cycle,
        ..
    } = *view;
    let axis = file.axis();
    let mut planes = Vec::new();
    for made in &cycle.moves {
        planes.push(plane(file, &axis, actuator, made)?);
    }
    let course = MotionSeries::of_trace("motion", file, actuator, &cycle.trace)?;
    let ways = BothDirections::new(file, actuator);
    let limits = [("upper limit", 1), ("lower limit", 0)].map(|(name, k)| {
        let limit = |row: &[f64; 5]| {
            let drive = row[2].signum() * axis.drive_rate(row[2].abs());
            let speed = ways.forwards().motor_speed(drive.abs());
            let torques = actuator.torques(speed);
            // Driving is in the direction of motion.
            let torque = if drive < 0.0 {
                -torques[1 - k]
            } else {
                torques[k]
            };
            (row[0], torque)
        };
        let points: Vec<(f64, f64)> = course.rows.iter().map(limit).collect();
        (name, points)
    });
    let mut sections = vec![
        Section::new("Phase plane", planes),
        over_time(file, &[course], &limits),
    ];
    sections.extend(view.warmth.and_then(winding));
    Ok(Page::page(
        file,
        "fastest motion",
        format!(
            "The motion in minimum time within the limits of the drive, {}",
            view.drive
        ),
        &view.answer(Format::Table)?,
        sections,
    ))
}

/// The page about the gentlest motion, with the motion of the file and the best laws.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub fn gentlest_page(shown: &list::gentlest::GentlestView, own: &Motion) -> Result<String, Error> {
    let list::gentlest::GentlestView {
        file,
        request,
        gentlest,
        ..
    } = *shown;
    let actuator = &request.actuator;
    let mut courses = vec![
        MotionSeries::of_trace("gentlest", file, actuator, &gentlest.trace)?,
        MotionSeries::of_motion("as in the file", file, actuator, own)?,
    ];
    let mut laws: Vec<_> = gentlest.laws.iter().collect();
    let figure = |row: &jred_motion::gentlest::cycle::ComparisonRow| row.figures.of(request.goal);
    laws.sort_by(|a, b| figure(a).total_cmp(&figure(b)));
    for law in laws.into_iter().take(LAWS) {
        courses.push(MotionSeries::of_motion(
            law.name,
            file,
            actuator,
            &law.motion,
        )?);
    }
    Ok(Page::page(
        file,
        "gentlest motion",
        format!(
            "{}, with the motion of the file and the best laws",
            list::gentlest::subject(shown)
        ),
        &list::gentlest::answer(shown),
        vec![over_time(file, &courses, &[])],
    ))
}

/// The page about the steady cycle; `steady` contains the positions to draw.
pub fn steady_page(machines: &CoupledMachines, steady: &Steady) -> String {
    let file = machines.first;
    let own = steady.cycle.as_ref();
    let wheel = steady.flywheel.as_ref().filter(|wheel| wheel.inertia > 0.0);
    let mut runs = Vec::new();
    if let Some(cycle) = own {
        let name = if wheel.is_some() {
            "without a further flywheel"
        } else {
            ""
        };
        runs.push((name, &cycle.figures.course));
    }
    if let Some(wheel) = wheel {
        runs.push(("with the flywheel", &wheel.cycle.figures.course));
    }
    let coordinate = file.machine.mechanism().coordinate();
    let along = (ColumnQuantity::Position, Axis::of(coordinate));
    let section = |heading: &str, y: &str, quantity: ColumnQuantity| {
        Section::of(heading, plot(&runs, along, (y, quantity)))
    };
    let speed = format!("speed [{}]", coordinate.speed_unit());
    let mut sections = vec![
        section("Speed over the cycle", &speed, ColumnQuantity::DriveSpeed),
        section("Motor torque", "torque [N·m]", ColumnQuantity::MotorEffort),
    ];
    let energies = runs.iter().map(|(name, course)| {
        let heading = ["Energies", name].join(if name.is_empty() { "" } else { " " });
        let energies = ("energy [J]", ColumnQuantity::Energy);
        Section::of(&heading, plot(&[("", *course)], along, energies))
    });
    sections.extend(energies);
    Page::page(
        file,
        "steady cycle",
        format!(
            "The cycle that repeats under the motor{}",
            machines.beside_in_words()
        ),
        &list::steady::answer(machines, steady),
        sections,
    )
}
