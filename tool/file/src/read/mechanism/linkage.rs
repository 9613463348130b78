//! `type = "linkage"`: bodies and joints of any topology, with an approximate drawing.

mod bodies;
mod cam;
mod drawing;
mod joints;
mod problems;
mod wheels;

use jred::Domain;
use jred::machine::{Frame, Frames, Joint, Mechanism};
use jred::mechanism::linkage::{LinkageError, Pair};

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::{AnyMechanism, ChangePoint, Inner};
use crate::text::problem::Result;
use crate::text::section::Section;

use bodies::Bodies;
use joints::JointEntry;
use problems::Context;

/// Positions stored along the drive's range: from the nearest of them one step of Newton's method converges.
const STATIONS: usize = 256;

/// The most change points in the drive's range.
const CHANGE_POINTS: usize = 16;

/// The frames at positions over the drive's range. An assembled linkage has a position everywhere.
fn survey(mechanism: &impl Mechanism) -> impl Iterator<Item = Frames> {
    const PLACES: usize = 12;
    let domain = mechanism.domain();
    let last = if domain == Domain::Turn { 0.999 } else { 1.0 };
    let phi = move |k| domain.position(last * k as f64 / PLACES as f64);
    (0..=PLACES).filter_map(move |k| mechanism.frames(phi(k)).ok())
}

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let bodies = Bodies::read(section)?;
    let mut joints = joints::read(section, &bodies)?;
    let drive = drive(section, &joints)?;
    problems::check_topology(section, &bodies, &joints)?;
    let coordinate = match joints.get(drive).map(|joint| joint.kind) {
        Some("prismatic") => Coordinate::Length,
        _ => Coordinate::Angle,
    };
    section.set_slides(coordinate == Coordinate::Length);
    let drawn_at = section.maybe("drawn_at")?;
    let domain = domain(section, coordinate)?;
    let (keep, kept) = (section.get("keep_branch"), section.is("keep_branch")?);
    let poses = drawing::poses(&bodies, &joints, drive, drawn_at)?;
    let frames: Vec<Frame> = poses
        .iter()
        .map(jred::mechanism::linkage::Pose::frame)
        .collect();
    for joint in &mut joints {
        joint.meshing_at(&frames);
    }
    let drawn_at = drawn_at.unwrap_or_else(|| match joints.get(drive).map(|joint| joint.pair) {
        Some(Pair::Joint(joint)) => joint.coordinate(&frames).value,
        _ => 0.0,
    });
    let context = Context {
        section,
        bodies: &bodies,
        joints: &joints,
        drive,
        coordinate,
        poses: &poses,
        frames: &frames,
        drawn_at,
    };
    let (assembly, change_points) = if kept {
        kept_on_branch(&context, domain)
    } else {
        assembled(&context, domain).map(|assembly| (assembly, Vec::new()))
    }
    .map_err(|error| match (error, &keep) {
        (LinkageError::NoChangePoint, Some(keep)) => context.never_flat(keep),
        _ => context.problem(error, kept, || Ok(kept_on_branch(&context, domain)?.1)),
    })?;
    wheels::check(&assembly.as_ref(), &bodies, &joints)?;
    cam::check(&assembly.as_ref(), &bodies, &joints)?;
    inertias(assembly.as_ref(), &bodies)?;

    let names = bodies.names();
    let joint_names = joints.iter().map(|joint| joint.name.clone());
    let pairs: Vec<Pair> = joints.iter().map(|joint| joint.pair).collect();
    let mut mechanism = AnyMechanism::of(section.chosen(), assembly.into(), names, joint_names)
        .with_pairs(&pairs)
        .with_change_points(change_points);
    for (link, body) in bodies.moving.iter().enumerate() {
        for point in &body.points {
            let name = format!("{}.{}", body.name, point.name);
            mechanism = mechanism.with_point(name, link, point.at);
        }
    }
    for point in &bodies.ground {
        mechanism = mechanism.with_ground_point(point.name.clone(), point.at);
    }
    Ok(cam::described(mechanism, &joints))
}

/// The linkage, on the heap: with all its stations it is too large for the stack. Not inlined, so that they leave the stack when it returns.
#[inline(never)]
fn assembled(
    context: &Context,
    domain: Domain,
) -> std::result::Result<Box<dyn Inner>, LinkageError> {
    let linkage = context.linkage()?;
    let assembly = linkage.assemble::<STATIONS>(domain, context.drawn_at, context.poses)?;
    Ok(Box::new(assembly))
}

/// The linkage assembled through its change points, and these points.
#[inline(never)]
fn kept_on_branch(
    context: &Context,
    domain: Domain,
) -> std::result::Result<(Box<dyn Inner>, Vec<ChangePoint>), LinkageError> {
    let assembly = context
        .linkage()?
        .assemble_through_change_points::<STATIONS, CHANGE_POINTS>(
            domain,
            context.drawn_at,
            context.poses,
        )?;
    let within = assembly.flat();
    let points = assembly
        .change_points()
        .map(|at| ChangePoint { at, within })
        .collect();
    Ok((Box::new(assembly), points))
}

/// The joint that is driven.
fn drive(section: &Section, joints: &[JointEntry]) -> Result<usize> {
    let names: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
    let item = section.require(
        "drive",
        &format!("drive = \"{}\"", names.first().unwrap_or(&"crank bearing")),
    )?;
    if item.is_list() {
        return Err(item
            .problem(
                "is a list, but a linkage has only one drive",
                "more than one",
            )
            .help(
                "name the one driven joint; a second drive would need a second degree of freedom",
            ));
    }
    let drive = item.choice(&names)?;
    let Some(joint) = joints.get(drive) else {
        return Ok(drive);
    };
    if !matches!(
        joint.pair,
        Pair::Joint(Joint::Revolute(_) | Joint::Prismatic(_))
    ) {
        return Err(item
            .problem(
                &format!("is \"{}\", of type \"{}\"", joint.name, joint.kind),
                "cannot be driven",
            )
            .at(joint.place.clone(), "this joint")
            .help("choose a revolute or a prismatic joint as the drive"));
    }
    Ok(drive)
}

/// A full turn, or the stroke in the file.
fn domain(section: &Section, coordinate: Coordinate) -> Result<Domain> {
    let Some(item) = section.get("stroke") else {
        if coordinate == Coordinate::Length {
            let example =
                "stroke = [\"400 mm\", \"650 mm\"]: a sliding drive needs two ends of its stroke";
            return Err(section.missing("stroke", example));
        }
        return Ok(Domain::Turn);
    };
    let [from, to] = super::parts::ends(&item)?;
    Domain::stroke(from, to).map_err(|error| super::core(section, error))
}

/// Checks that a body that turns has a moment of inertia in the file, even if it is zero.
fn inertias(assembly: &dyn Inner, bodies: &Bodies) -> Result<()> {
    let open: Vec<usize> = (0..bodies.moving.len())
        .filter(|k| bodies.moving.get(*k).is_some_and(|body| !body.has_inertia))
        .collect();
    if open.is_empty() {
        return Ok(());
    }
    for k in 0..=16 {
        let phi = assembly.domain().position(f64::from(k) / 16.0);
        let Ok(frames) = assembly.frames(phi) else {
            continue; // an assembled linkage has a position everywhere
        };
        for &link in &open {
            let turns = frames.get(link).is_some_and(|f| f.psi.d1.abs() > 1e-9);
            if let (true, Some(body)) = (turns, bodies.moving.get(link)) {
                return Err(crate::text::problem::Problem::new(format!(
                    "`inertia` of body \"{}\" is missing, and the body turns",
                    body.name
                ))
                .at(body.place.clone(), "`inertia` belongs here")
                .help("add the moment of inertia about its own centre of mass, such as inertia = \"0.02 kg m^2\"; only \
                       a body that never turns needs none"));
            }
        }
    }
    Ok(())
}
