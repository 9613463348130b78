//! Implausible values, mostly wrong units. They cause warnings, never errors: a machine may be unusual.
//!
//! The limits are listed in docs/machine-file.md: all shipped machines keep within them, and a unit that is wrong by a factor of 1000, or of an
//! inertia by 10 000, does not.

use jred::error::Error;
use jred::machine::{Body, Joint, Jointed as _, Link, Marker, Mechanism as _};
use jred_file::math;

use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::ToolCoordinate;
use jred_file::model::with_mass::AttachedMass;
use jred_file::number::rounding::{short, significant};

/// Gravity (m/s²): a tenth of the moon's, five times the earth's.
const GRAVITY: [f64; 2] = [0.16, 50.0];

/// Radius of gyration of a body over its size, the largest distance between its joints and points: a slender rod has 0.29, a crank that is a disc
/// with a large gear several times its length.
const GYRATION: [f64; 2] = [1e-3, 10.0];

/// The same over the size of the mechanism, for a body with one joint.
const OF_MECHANISM: f64 = 10.0;

/// Radius of gyration (m) if nothing has a size: that of a wheel.
const WHEEL: f64 = 10.0;

/// Distance of a centre of mass from a body's origin, relative to its size or that of the mechanism.
const CENTRE: f64 = 10.0;

/// Largest over smallest: sizes, and masses of moving bodies.
const SIZES: f64 = 1e4;
const MASSES: f64 = 1e6;

/// A warning for each value that is implausible.
pub(super) fn of(file: &MachineFile) -> Result<Vec<String>, Error> {
    let mechanism = file.machine.mechanism();
    let start = mechanism.domain().position(0.0);
    let frames = mechanism.frames(start)?;
    let joints = mechanism.joints(start, &frames)?;
    let mut warnings = Vec::new();
    let [x, y] = file.machine.gravity();
    let g = math::hypot(x, y);
    if g > 0.0 && !(GRAVITY[0]..=GRAVITY[1]).contains(&g) {
        warnings.push(format!(
            "gravity is {} m/s^2, not {} to {} m/s^2: is its unit right (m/s^2, mm/s^2)?",
            short(g),
            GRAVITY[0],
            GRAVITY[1]
        ));
    }
    let whole = size(joints.iter().flat_map(markers).map(|marker| {
        let [x, y] = marker.position(&frames);
        [x.value, y.value]
    }));
    let bodies: Vec<BodyProperties> = (mechanism.link_names().iter().zip(mechanism.links()))
        .enumerate()
        .map(|(k, (name, link))| {
            let own = joints.iter().flat_map(markers);
            let own = own.filter(|marker| marker.body == Body::Link(k));
            let named = mechanism.points().iter().filter(|point| point.link == k);
            let points = own
                .map(|marker| marker.at)
                .chain(named.map(|point| point.at));
            let outlines = mechanism.outlines(k).flatten().copied();
            let turns = frames.get(k).is_some_and(|frame| frame.psi.d1 != 0.0);
            BodyProperties::of_link(name, link, size(points.chain(outlines)), turns)
        })
        .collect();
    let payloads = file.schedule.payloads().iter();
    let payloads = payloads.map(|payload| BodyProperties::attached(&payload.name, &payload.mass));
    let carriages = file.schedule.carriages().iter();
    let carriages =
        carriages.map(|carriage| BodyProperties::attached(&carriage.name, &carriage.mass));
    let carried: Vec<BodyProperties> = payloads.chain(carriages).collect();
    for part in bodies.iter().chain(&carried) {
        warnings.extend(part.gyration(whole));
        warnings.extend(part.centre(whole));
    }
    warnings.extend(apart(&bodies));
    Ok(warnings)
}

/// Largest speed and acceleration of a motion: in m/s and m/s², and in rad/s and rad/s².
const LENGTHS: [f64; 2] = [100.0, 1e5];
const ANGLES: [f64; 2] = [1e4, 1e7];

/// Instants per smooth stretch whose speed and acceleration are compared with the limits: only their order of magnitude matters.
const INSTANTS: u32 = 8;

/// A warning for a prescribed motion that is implausibly fast.
pub(super) fn of_motion(file: &MachineFile) -> Option<String> {
    let motion = file.motion.as_ref()?;
    let (coordinate, si) = prescribed(file)?;
    let mut fastest = [[0.0_f64; 2]; 2];
    for (from, to) in motion.stretches() {
        for k in 0..=INSTANTS {
            let t = from + (to - from) * f64::from(k) / f64::from(INSTANTS);
            let state = motion.prescribed(t);
            for ([most, at], size) in fastest.iter_mut().zip([state.omega, state.alpha]) {
                if size.abs() > *most {
                    (*most, *at) = (size.abs(), t);
                }
            }
        }
    }
    let limits = coordinate.pick(ANGLES, LENGTHS);
    let beyond = |k: usize, what: &str, per: &str| {
        let [most, at] = fastest[k];
        (most > limits[k]).then(|| {
            format!(
                "the motion reaches {what} of {} {si}/{per} at {} s, more than {}: are its times and ways right?",
                short(most),
                short(at),
                limits[k]
            )
        })
    };
    beyond(0, "a speed", "s").or_else(|| beyond(1, "an acceleration", "s^2"))
}

/// The prescribed coordinate, and its SI unit.
pub(super) fn prescribed(file: &MachineFile) -> Option<(Coordinate, &'static str)> {
    let drive = file.machine.mechanism().coordinate();
    let motion = file.motion.as_ref()?;
    let coordinate = motion.tool().map_or(drive, ToolCoordinate::coordinate);
    Some((coordinate, coordinate.per()))
}

/// A body with its figures.
struct BodyProperties<'m> {
    name: &'m str,
    mass: f64,
    inertia: f64,
    com: [f64; 2],
    /// Largest distance between two of its points (m).
    size: f64,
    /// Whether it turns, so that its moment of inertia counts.
    turns: bool,
}

impl<'m> BodyProperties<'m> {
    fn of_link(name: &'m str, link: &Link, size: f64, turns: bool) -> Self {
        Self {
            name,
            mass: link.mass(),
            inertia: link.inertia(),
            com: link.com(),
            size,
            turns,
        }
    }

    fn attached(name: &'m str, mass: &AttachedMass) -> Self {
        Self {
            name,
            mass: mass.mass,
            inertia: mass.inertia,
            com: mass.at,
            size: 0.0,
            turns: false,
        }
    }

    /// The radius of gyration k = √(J/m).
    fn gyration(&self, whole: f64) -> Option<String> {
        if self.mass <= 0.0 {
            return None;
        }
        let radius = (self.inertia / self.mass).sqrt();
        let most = [GYRATION[1] * self.size, OF_MECHANISM * whole, WHEEL];
        let most = if self.size > 0.0 {
            most[0]
        } else if whole > 0.0 {
            most[1]
        } else {
            most[2]
        };
        let least = if self.turns {
            GYRATION[0] * self.size
        } else {
            0.0
        };
        if self.inertia == 0.0 && self.turns && self.size > 0.0 {
            return Some(format!(
                "the {} has a mass of {} kg and no moment of inertia, though it turns: give it (a slender rod of this length has {} kg m^2)",
                self.name,
                short(self.mass),
                significant(self.mass * self.size * self.size / 12.0, 2)
            ));
        }
        if self.inertia == 0.0 || (least..=most).contains(&radius) {
            return None;
        }
        let size = if self.size > 0.0 {
            format!("it is {} m long", short(self.size))
        } else if whole > 0.0 {
            format!("the mechanism is {} m wide", short(whole))
        } else {
            format!("a wheel has at most {WHEEL} m")
        };
        Some(format!(
            "the {} has {} kg m^2 at {} kg, a radius of gyration of {} m, but {size}: are the units right (kg m^2, kg cm^2, kg mm^2)?",
            self.name,
            short(self.inertia),
            short(self.mass),
            short(radius)
        ))
    }

    /// The distance of the centre of mass.
    fn centre(&self, whole: f64) -> Option<String> {
        let distance = math::hypot(self.com[0], self.com[1]);
        let size = self.size.max(whole);
        let most = if size > 0.0 { CENTRE * size } else { WHEEL };
        if self.mass <= 0.0 || distance <= most {
            return None;
        }
        Some(format!(
            "the centre of mass of the {} is {} m away from its origin, {} times the size of the mechanism: is the unit right (mm, m)?",
            self.name,
            short(distance),
            short(distance / size)
        ))
    }
}

/// The smallest and the largest size, and mass, of the bodies.
fn apart(bodies: &[BodyProperties]) -> Vec<String> {
    let ends = |figure: fn(&BodyProperties) -> f64,
                most: f64,
                what: &str,
                unit: &str,
                units: &str| {
        let figures = bodies.iter().filter(|body| figure(body) > 0.0);
        let least = figures
            .clone()
            .min_by(|a, b| figure(a).total_cmp(&figure(b)))?;
        let largest = figures.max_by(|a, b| figure(a).total_cmp(&figure(b)))?;
        let ratio = figure(largest) / figure(least);
        (ratio > most).then(|| {
            format!(
                "the {} {what} {} {unit}, {} times as much as the {} with {} {unit}: are the units right ({units})?",
                largest.name,
                short(figure(largest)),
                short(ratio),
                least.name,
                short(figure(least))
            )
        })
    };
    [
        ends(|body| body.size, SIZES, "has a length of", "m", "mm, m"),
        ends(|body| body.mass, MASSES, "has a mass of", "kg", "g, kg, t"),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The places at which a joint holds its bodies.
fn markers(joint: &Joint) -> &[Marker] {
    match joint {
        Joint::Revolute(markers)
        | Joint::Prismatic(markers)
        | Joint::Fixed(markers)
        | Joint::PinInSlot(markers) => markers,
        Joint::Transmission(_) => &[],
    }
}

/// The largest distance between two of some points.
fn size(points: impl Iterator<Item = [f64; 2]>) -> f64 {
    let points: Vec<[f64; 2]> = points.collect();
    let mut most = 0.0_f64;
    for (k, a) in points.iter().enumerate() {
        for b in &points[..k] {
            most = most.max(math::hypot(a[0] - b[0], a[1] - b[1]));
        }
    }
    most
}
