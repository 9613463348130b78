//! Drawing of a mechanism from its joints and frames only, so that any mechanism can be drawn.
//!
//! Links are bars and plates through their joints and named points, or their given outlines. Pins are circles, sliders blocks, guides and slots pairs
//! of lines; fixed parts are hatched. Behind them are the paths of the named points over the whole range and faint copies of the links at other
//! positions.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred::error::Error;
use jred::machine::{Machine, Mechanism as _};

use crate::plot::PALETTE;
use crate::plot::svg::{Anchor, Ink, Svg};
use jred_file::model::coordinate::positions;
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;
use jred_file::model::motion::Motion;

mod glyphs;
mod sketch;
mod view;

use glyphs::Pen;
use sketch::{Pose, Sketch};
use view::View;

/// Frames of an animation over the range.
pub const PICTURES: usize = 180;

/// Number of faint copies.
const GHOSTS: usize = 8;

/// Position of a still drawing as a share of the range; an eighth of a turn shows a crank off its dead centres.
const SHOWN: f64 = 0.125;

/// Ink of hatching and notes.
const QUIET: &str = "#8a949e";

/// A drawing that a script can move.
#[derive(Clone, Debug)]
pub struct Animation {
    /// The drawing at frame `first`.
    pub svg: String,
    /// JSON object of numbers: `positions` (deg or mm), `links` (x, y in px and an angle in deg for each link and frame), `points` (x, y for each
    /// named point and frame), `turn` (whether the first frame follows the last), `first` (the frame to begin with).
    pub track: String,
}

/// Most positions of a motion that are marked.
const MARKED: usize = 12;

/// The machine as it stands, its weight down the page, at the start of its motion, with the positions between the motion's parts marked by numbers;
/// without a motion at one position.
///
/// # Errors
/// The mechanism cannot be placed.
pub fn still(file: &MachineFile) -> Result<String, Error> {
    let mechanism = file.machine.mechanism();
    let sketch = Sketch::new(&file.machine)?;
    let marked = marked(file);
    let shown = mechanism.domain().position(SHOWN);
    let phi = marked.first().copied().unwrap_or(shown);
    let pose = sketch.pose(mechanism, phi)?;
    let poses = marked.iter().map(|phi| sketch.pose(mechanism, *phi));
    let poses = poses.collect::<Result<Vec<Pose>, Error>>()?;
    let place = mechanism.coordinate().place(phi);
    Ok(draw(mechanism, &sketch, &pose, &poses, &place))
}

/// The positions of the drive link between the parts of the motion, each once.
fn marked(file: &MachineFile) -> Vec<f64> {
    let mut places: Vec<f64> = Vec::new();
    let coordinate = file.machine.mechanism().coordinate();
    for (start, _) in file.motion.iter().flat_map(Motion::stretches) {
        let phi = file
            .motion
            .as_ref()
            .map_or(0.0, |motion| motion.at(start).phi);
        // The same place of another turn is drawn once.
        let shown = |phi: f64| coordinate.pick(phi.rem_euclid(TAU), phi);
        let near = |other: &f64| (shown(phi) - shown(*other)).abs() < 1e-6;
        if !places.iter().any(near) && places.len() < MARKED {
            places.push(phi);
        }
    }
    places
}

/// The mechanism at one position, with the data for a script to move it.
///
/// # Errors
/// The mechanism cannot be placed.
pub fn moving(machine: &Machine<AnyMechanism>) -> Result<Animation, Error> {
    let mechanism = machine.mechanism();
    let coordinate = mechanism.coordinate();
    let sketch = Sketch::new(machine)?;
    let view = View::of(&sketch);
    let places: Vec<f64> = positions(mechanism.domain(), PICTURES).collect();
    let poses = places
        .iter()
        .map(|&phi| sketch.pose(mechanism, phi))
        .collect::<Result<Vec<Pose>, Error>>()?;
    let first = (SHOWN * PICTURES as f64) as usize;
    let svg = draw(mechanism, &sketch, &poses[first], &[], "");
    let shown: Vec<f64> = places
        .iter()
        .map(|&phi| (coordinate.shown(phi) * 1e3).round() / 1e3)
        .collect();
    let links = poses.iter().map(|pose| {
        let each = pose.links.iter().map(|[x, y, psi]| {
            let [x, y] = view.page([*x, *y]);
            format!("{x:.2},{y:.2},{:.3}", -psi.to_degrees())
        });
        each.collect::<Vec<_>>().join(",")
    });
    let points = poses.iter().map(|pose| {
        let each = sketch.points.iter().map(|point| {
            let [x, y] = view.page(pose.point(point.link, point.at));
            format!("{x:.2},{y:.2}")
        });
        each.collect::<Vec<_>>().join(",")
    });
    let mut track = format!("{{\"positions\":{shown:?}");
    for (name, rows) in [
        ("links", links.collect::<Vec<_>>()),
        ("points", points.collect::<Vec<_>>()),
    ] {
        let _ = write!(track, ",\"{name}\":[[{}]]", rows.join("],["));
    }
    let turn = mechanism.domain() == jred::Domain::Turn;
    let _ = write!(track, ",\"turn\":{turn},\"first\":{first}}}");
    Ok(Animation { svg, track })
}

fn draw(
    mechanism: &AnyMechanism,
    sketch: &Sketch,
    pose: &Pose,
    marked: &[Pose],
    place: &str,
) -> String {
    let view = View::of(sketch);
    let mut svg = Svg::new(view.width, view.height);
    let mut pen = Pen {
        svg: &mut svg,
        scale: view.scale,
    };
    pen.svg.open("class=\"ground\"", "");
    for part in &sketch.ground {
        pen.ground(part, &|at| view.page(at));
    }
    pen.svg.close();

    let step = (sketch.poses.len() / GHOSTS).max(1);
    for ghost in sketch.poses.iter().step_by(step) {
        for (link, parts) in sketch.links.iter().enumerate() {
            let Some(&[x, y, psi]) = ghost.links.get(link) else {
                continue;
            };
            let [x, y] = view.page([x, y]);
            let turn = -psi.to_degrees();
            if parts.iter().any(sketch::BodyPart::leaves_ghosts) {
                pen.svg.open(&placed([x, y], turn, "class=\"ghost\""), "");
                for part in parts {
                    pen.ghost(part);
                }
                pen.svg.close();
            }
        }
    }
    for (k, path) in sketch.paths.iter().enumerate() {
        let path: Vec<[f64; 2]> = path.iter().map(|&at| view.page(at)).collect();
        let ink = Ink::line(colour(sketch.points[k].link), 1.4).dashed(&[5, 3]);
        pen.svg.path(&path, false, &ink);
    }

    // Bodies first, pins above all of them.
    let names = mechanism.link_names();
    for layer in [false, true] {
        for (link, parts) in sketch.links.iter().enumerate() {
            let Some(&[x, y, psi]) = pose.links.get(link) else {
                continue;
            };
            let [x, y] = view.page([x, y]);
            let turn = -psi.to_degrees();
            let name = names.get(link).map_or("", String::as_str);
            pen.svg.open(
                &placed([x, y], turn, &format!("data-link=\"{link}\"")),
                name,
            );
            for part in parts.iter().filter(|part| part.is_pin() == layer) {
                pen.part(part, colour(link));
            }
            pen.svg.close();
        }
    }
    for (k, point) in sketch.points.iter().enumerate() {
        let [x, y] = view.page(pose.point(point.link, point.at));
        pen.svg
            .open(&placed([x, y], 0.0, &format!("data-point=\"{k}\"")), "");
        pen.svg.circle(
            [0.0, 0.0],
            2.2,
            &Ink::line("#1d2733", 0.0).filled("#1d2733"),
        );
        pen.svg.text(
            [9.0, -9.0],
            Anchor::Start,
            &lettering("#1d2733"),
            &point.name,
        );
        pen.svg.close();
    }
    // The last point does the machine's work.
    if let Some(tool) = sketch.points.last().filter(|_| marked.len() > 1) {
        for (k, pose) in marked.iter().enumerate() {
            let [x, y] = view.page(pose.point(tool.link, tool.at));
            svg.circle([x, y], 3.5, &Ink::line("#1d2733", 1.2));
            let number = (k + 1).to_string();
            svg.text(
                [x, y + 20.0],
                Anchor::Middle,
                &lettering("#1d2733"),
                &number,
            );
        }
    }
    view.axes(&mut svg, sketch.turn);
    view.legend(&mut svg, sketch.schematic, place);
    svg.finish()
}

/// Attributes of a group that is moved and turned by `turn` (deg).
fn placed([x, y]: [f64; 2], turn: f64, mark: &str) -> String {
    format!("transform=\"translate({x:.2} {y:.2}) rotate({turn:.3})\" {mark}")
}

/// Attributes of a text.
fn lettering(colour: &str) -> String {
    format!("font-size=\"13\" fill=\"{colour}\"")
}

fn colour(link: usize) -> &'static str {
    PALETTE[link % PALETTE.len()]
}
