//! The tool over the motion: position, speed, acceleration, and the loads on it, over time and over the stroke.

use jred::error::Error;
use jred::machine::Mechanism as _;
use jred_file::math;

use super::chart::{Chart, ChartKind};
use super::figures::line;
use super::section::{Figure, Section};
use super::thinned::kept;
use crate::plot::{Axes, Axis};
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Measure, ToolCoordinate};
use jred_file::model::schedule::ScheduleInstant;
use jred_file::model::site::ToolPlace;

/// A path straighter than this share of its length is a straight line.
const STRAIGHT: f64 = 1e-6;

/// The point of a machine that does its work: its name, its link, and its place in the link's frame.
struct Tool {
    name: String,
    link: usize,
    at: [f64; 2],
}

impl Tool {
    /// The point of `[tool]`, the one whose motion is prescribed, or the last named point of the mechanism, if possible of a link with a load.
    fn of(file: &MachineFile) -> Option<Self> {
        let mechanism = file.machine.mechanism();
        if let Some(tool) = &file.site.tool
            && let ToolPlace::Point(at) = tool.place
        {
            let (name, link) = (tool.name.clone(), tool.link);
            return Some(Self { name, link, at });
        }
        let prescribed = file.motion.as_ref().and_then(|motion| motion.tool());
        if let Some(Measure::Position { link, at, .. } | Measure::Path { link, at }) =
            prescribed.map(ToolCoordinate::measure)
        {
            let name = mechanism.link_names().get(link)?.clone();
            return Some(Self { name, link, at });
        }
        let points = || mechanism.points().iter().rev();
        let bears = |link| file.machine.loads().iter().any(|load| load.link() == link);
        let last = points()
            .find(|point| bears(point.link))
            .or(points().next())?;
        let on = mechanism.link_names().get(last.link)?;
        Some(Self {
            name: format!("{} of the {on}", last.name),
            link: last.link,
            at: last.at,
        })
    }
}

/// A point over the instants of a motion.
struct Course {
    /// Time (s), and x and y of position (m), speed (m/s), acceleration (m/s²) and load (N).
    rows: Vec<(f64, [[f64; 2]; 4])>,
}

impl Course {
    fn new(file: &MachineFile, duty: &Duty, tool: &Tool) -> Result<Self, Error> {
        let row = |k: usize| {
            let instant = &duty.instants[k];
            let now = ScheduleInstant::moving(instant.t, instant.omega, instant.direction);
            let machine = file.machine_at(&now, instant.phi)?;
            let frames = machine.mechanism().frames(instant.phi)?;
            let Some(frame) = frames.get(tool.link) else {
                return Ok((instant.t, Default::default()));
            };
            let point = frame.point(tool.at);
            let loads = (machine.loads().iter()).filter(|load| load.link() == tool.link);
            let load = loads.fold([0.0; 2], |[x, y], load| {
                let [fx, fy] = load.wrench(frame, instant.phi, instant.omega).force;
                [x + fx, y + fy]
            });
            let place = point.map(|c| c.value);
            let speed = point.map(|c| c.velocity(instant.omega));
            let acceleration = point.map(|c| c.acceleration(instant.omega, instant.alpha));
            Ok((instant.t, [place, speed, acceleration, load]))
        };
        let drawn = kept(
            duty.instants.len(),
            &[&|k| duty.instants[k].omega, &|k| duty.instants[k].alpha],
        );
        let rows = drawn.into_iter().map(row).collect::<Result<_, Error>>()?;
        Ok(Self { rows })
    }

    /// The unit vector from the first position to the farthest one, and whether all positions lie on that line; `None`: the point rests.
    fn direction(&self) -> Option<([f64; 2], bool)> {
        let places = || self.rows.iter().map(|(_, row)| row[0]);
        let first = places().next()?;
        let from_first = |[x, y]: [f64; 2]| [x - first[0], y - first[1]];
        let far = places()
            .map(from_first)
            .max_by(|a, b| math::hypot(a[0], a[1]).total_cmp(&math::hypot(b[0], b[1])))?;
        let length = math::hypot(far[0], far[1]);
        if length <= 0.0 {
            return None;
        }
        let mut way = far.map(|c| c / length);
        // Along the nearer of +x and +y.
        let larger = usize::from(way[0].abs() < way[1].abs());
        if way[larger] < 0.0 {
            way = way.map(|c| -c);
        }
        let off = |place| {
            let [x, y] = from_first(place);
            (x * way[1] - y * way[0]).abs()
        };
        let is_straight = places().all(|place| off(place) <= STRAIGHT * length);
        Some((way, is_straight))
    }
}

/// The section; `None` for a machine without a named point that moves.
///
/// # Errors
/// The mechanism cannot be placed.
pub(super) fn tool(file: &MachineFile, duty: &Duty) -> Result<Option<Section>, Error> {
    let Some(tool) = Tool::of(file) else {
        return Ok(None);
    };
    let course = Course::new(file, duty, &tool)?;
    let Some((way, is_straight)) = course.direction() else {
        return Ok(None);
    };
    let along = |[x, y]: [f64; 2]| x * way[0] + y * way[1];
    let name = &tool.name;
    let direction = match way {
        [x, _] if x > 1.0 - 1e-9 => "x".to_owned(),
        [_, y] if y > 1.0 - 1e-9 => "y".to_owned(),
        [x, y] => format!("the line at {:.1}° to x", math::atan2(y, x).to_degrees()),
    };
    let curved = if is_straight {
        ""
    } else {
        " Its path is curved: these are the components along that line."
    };
    let what = [
        ("position [mm]", 1e3, "Position"),
        ("speed [m/s]", 1.0, "Speed"),
        ("acceleration [m/s²]", 1.0, "Acceleration"),
        (
            "load [N]",
            1.0,
            "Load: all forces on this link but weight and joint forces; against the motion where its sign differs from that of the speed",
        ),
    ];
    let loaded = course.rows.iter().any(|(_, row)| along(row[3]) != 0.0);
    let shown = if loaded { 4 } else { 3 };
    let over_time = what.iter().enumerate().take(shown);
    let mut figures: Vec<Figure> = over_time
        .map(|(k, (y, scale, caption))| {
            let points = course.rows.iter();
            let points = points.map(|(t, row)| (*t, scale * along(row[k]))).collect();
            let axes = Axes {
                title: "",
                x: Axis::new("time [s]"),
                y,
            };
            let chart = Chart::new(ChartKind::Time, &axes, &[line("", points)]);
            Figure::live(&chart, format!("{caption}, over time."))
        })
        .collect();
    let over_stroke = what.iter().enumerate().take(shown).skip(1);
    figures.extend(over_stroke.map(|(k, (y, scale, caption))| {
        let points = course.rows.iter();
        let points = points.map(|(_, row)| (1e3 * along(row[0]), scale * along(row[k])));
        let axes = Axes {
            title: "",
            x: Axis::new("position [mm]"),
            y,
        };
        let chart = Chart::new(ChartKind::Plane, &axes, &[line("", points.collect())]);
        let chart = chart.with_times(0, course.rows.iter().map(|(t, _)| *t));
        Figure::live(&chart, format!("{caption}, over the stroke."))
    }));
    Ok(Some(Section {
        figures,
        ..Section::read(format!("Tool: {name}"), |answer| {
            answer.sentence(format!(
                "Along {direction}, as in the machine file.{curved}"
            ));
        })
    }))
}
