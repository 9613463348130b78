//! Linkages drawn by hand: what a drawn machine file lacks, and the pins and guides of a machine for the sheet.

use jred::Domain;
use jred::machine::{Body, Joint, Jointed as _, Marker, Mechanism as _};
use jred_analysis::checked;
use jred_analysis::inspect::Findings;
use jred_file::text::problem::{Problem, Result};
use serde_json::{Value, json};

use crate::request::Request;

/// Position of the drive link on the sheet as a share of its range.
const SHOWN: f64 = 0.125;

/// Whether a drawn linkage moves: what hinders it with its cure, the range of its drive, dead points and dead centres in words.
pub(crate) fn draw(request: &Request) -> Result<String> {
    let file = match checked::parse(&request.name(), request.source(), request.files()) {
        Ok(file) => file,
        Err(why) => {
            return Ok(json!({
                "obstacle": why.to_string(),
                "cure": why.cure().unwrap_or_default(),
                "range": null,
                "dead": [],
            })
            .to_string());
        }
    };
    let mechanism = file.machine.mechanism();
    let coordinate = mechanism.coordinate();
    let range = match mechanism.domain() {
        Domain::Turn => None,
        Domain::Stroke { from, to } => Some([from, to].map(|end| coordinate.shown(end))),
    };
    let travels = Findings::of(&file).map_err(Problem::of)?.travels;
    let dead = travels.iter().flat_map(|travel| {
        let centres = travel.dead_centres.iter();
        centres.map(|[at, _]| format!("{} at {}", travel.link, coordinate.place(*at)))
    });
    let dead: Vec<String> = dead.collect();
    Ok(json!({"obstacle": "", "cure": "", "range": range, "dead": dead}).to_string())
}

/// Links, pins and guides of the machine where it is drawn (m, rad), and what the sheet cannot hold.
pub(crate) fn linkage(request: &Request) -> Result<String> {
    let file = checked::parse(&request.name(), request.source(), request.files())?;
    let mechanism = file.machine.mechanism();
    let phi = mechanism.domain().position(SHOWN);
    let frames = mechanism.frames(phi).map_err(Problem::of)?;
    let joints = mechanism.joints(phi, &frames).map_err(Problem::of)?;
    let at = |marker: &Marker| marker.position(&frames).map(|c| c.value);
    let name = |body: Body| match body {
        Body::Ground => Value::Null,
        Body::Link(link) => json!(mechanism.link_names().get(link)),
    };
    let ends = |[a, b]: &[Marker; 2]| json!([name(a.body), name(b.body)]);
    let drawn = joints.iter().map(|joint| match joint {
        Joint::Revolute(pair) => json!({"bodies": ends(pair), "at": at(&pair[0])}),
        Joint::Prismatic(pair) => {
            json!({"bodies": ends(pair), "at": at(&pair[1]), "angle": pair[0].direction(&frames).value})
        }
        _ => json!({"bodies": []}),
    });
    let links = mechanism.links().iter().zip(&frames).enumerate();
    let links = links.take(mechanism.own_links()).map(|(k, (link, frame))| {
        let points = mechanism.points().iter().filter(|point| point.link == k);
        let points =
            points.map(|p| json!({"name": p.name, "at": frame.point(p.at).map(|c| c.value)}));
        let axis = [[0.0, 0.0], [1.0, 0.0]].map(|at| frame.point(at).map(|c| c.value));
        json!({
            "name": mechanism.link_names().get(k),
            "mass": link.mass(),
            "inertia": link.inertia(),
            "com": frame.point(link.com()).map(|c| c.value),
            "points": points.collect::<Vec<_>>(),
            "frame": axis,
        })
    });
    let lost = [
        ("loads", file.machine.loads().is_empty()),
        ("springs and dampers", file.machine.elements().is_empty()),
        ("the drive train", file.drive_train.stages().is_empty()),
        ("the motion", file.motion.is_none()),
    ];
    let lost = lost.iter().filter(|(_, none)| !none).map(|(what, _)| *what);
    let (drawn, links, lost): (Vec<_>, Vec<_>, Vec<_>) =
        (drawn.collect(), links.collect(), lost.collect());
    Ok(json!({
        "title": file.title,
        "gravity": file.machine.gravity(),
        "flywheel": file.flywheel,
        "joints": drawn,
        "links": links,
        "drive": mechanism.drive(),
        "lost": lost,
    })
    .to_string())
}
