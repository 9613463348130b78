//! Dead centres: where a link that slides or swings on the ground comes to rest while the drive goes on.

use jred::{Body, Domain, Error, Joint, Jointed as _, Mechanism as _, Transfer};
use serde::Serialize;

use crate::coordinate::Coordinate;
use crate::machine::AnyMechanism;

/// Places that are sampled over the range.
const SAMPLES: usize = 1440;

/// Share of the largest transfer function below which a link stands still.
const STILL: f64 = 1e-9;

/// How one link moves on the ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Travel {
    /// Name of the link.
    pub link: String,
    /// `slides`, `swings`, or `advances` (along a guide) or `turns` on and on.
    pub way: &'static str,
    /// Stroke, swing, or advance over a turn of the drive (m or rad).
    pub stroke: f64,
    /// Dead centres: position of the drive link (rad or m), and the link's own there (m or rad).
    pub dead_centres: Vec<[f64; 2]>,
    /// Dwells: from and to (rad or m of the drive link).
    pub dwells: Vec<[f64; 2]>,
}

/// The travels of every link that a pin or a guide holds on the ground, but the drive's.
///
/// # Errors
/// The mechanism cannot be placed.
pub(super) fn travels(mechanism: &AnyMechanism) -> Result<Vec<Travel>, Error> {
    let start = mechanism.domain().position(0.0);
    let joints = mechanism.joints(start, &mechanism.frames(start)?)?;
    let mut travels: Vec<Travel> = Vec::new();
    for (k, joint) in joints.iter().enumerate() {
        let ([Body::Ground, Body::Link(link)] | [Body::Link(link), Body::Ground]) = joint.bodies()
        else {
            continue;
        };
        let name = mechanism
            .link_names()
            .get(link)
            .cloned()
            .unwrap_or_default();
        let held = matches!(joint, Joint::Revolute(_) | Joint::Prismatic(_));
        if k == mechanism.drive() || !held || travels.iter().any(|t| t.link == name) {
            continue;
        }
        let slides = matches!(joint, Joint::Prismatic(_));
        let coordinate = |phi: f64| -> Result<Transfer, Error> {
            let frames = mechanism.frames(phi)?;
            if slides {
                let joints = mechanism.joints(phi, &frames)?;
                Ok(joints
                    .get(k)
                    .map_or(Transfer::default(), |j| j.coordinate(&frames)))
            } else {
                Ok(frames.get(link).map_or(Transfer::default(), |f| f.psi))
            }
        };
        travels.push(Travel {
            link: name,
            ..travel(mechanism.domain(), slides, &coordinate)?
        });
    }
    Ok(travels)
}

/// One sample: position of the drive, and the sign of the transfer function there, 0 at rest.
struct Sample {
    phi: f64,
    sign: i8,
}

fn place(domain: Domain, k: usize) -> f64 {
    domain.position(k as f64 / SAMPLES as f64)
}

/// The sign of a transfer function, 0 if not above `still`.
fn sign(slope: f64, still: f64) -> i8 {
    if slope.abs() <= still {
        0
    } else if slope > 0.0 {
        1
    } else {
        -1
    }
}

/// Pairs of numbers.
type Pairs = Vec<[f64; 2]>;

/// The samples over the range, from where the link is fastest: then no rest of a turn lies across its ends; and the transfer
/// function up to which it stands still.
fn samples(
    domain: Domain,
    slope: &dyn Fn(f64) -> Result<f64, Error>,
) -> Result<(Vec<Sample>, f64), Error> {
    let slopes = (0..=SAMPLES)
        .map(|k| slope(place(domain, k)))
        .collect::<Result<Vec<f64>, Error>>()?;
    let (fastest, most) =
        slopes
            .iter()
            .enumerate()
            .fold((0, 0.0), |most: (usize, f64), (k, slope)| {
                if slope.abs() > most.1 {
                    (k, slope.abs())
                } else {
                    most
                }
            });
    let still = STILL * most;
    let first = if domain == Domain::Turn {
        place(domain, fastest)
    } else {
        place(domain, 0)
    };
    let step = domain.span() / SAMPLES as f64;
    let samples = (0..=SAMPLES)
        .map(|k| {
            let phi = first + step * k as f64;
            Ok(Sample {
                phi,
                sign: sign(slope(phi)?, still),
            })
        })
        .collect::<Result<Vec<Sample>, Error>>()?;
    Ok((samples, still))
}

/// Dead centres, as positions of the drive and of the link, and dwells.
fn rests(
    domain: Domain,
    coordinate: &dyn Fn(f64) -> Result<Transfer, Error>,
) -> Result<(Pairs, Pairs), Error> {
    let slope = |phi: f64| Ok(coordinate(phi)?.d1);
    let (samples, still) = samples(domain, &slope)?;
    let sign = |phi: f64| Ok::<i8, Error>(sign(slope(phi)?, still));
    let wrap = |phi: f64| match domain {
        Domain::Turn => {
            let phi = phi.rem_euclid(std::f64::consts::TAU);
            // What is a rounding before a whole turn is its start.
            if std::f64::consts::TAU - phi < 1e-9 {
                0.0
            } else {
                phi
            }
        }
        Domain::Stroke { .. } => phi,
    };
    let (mut dead_centres, mut dwells) = (Vec::new(), Vec::new());
    let mut k = 0;
    while k < samples.len() {
        let before = k.checked_sub(1).and_then(|k| samples.get(k));
        let here = &samples[k];
        if here.sign != 0 {
            if let Some(before) = before.filter(|b| b.sign == -here.sign) {
                let way = f64::from(before.sign);
                let phi = halve(before.phi, here.phi, |phi| {
                    Ok(coordinate(phi)?.d1 * way > 0.0)
                })?;
                dead_centres.push([wrap(phi), coordinate(phi)?.value]);
            }
            k += 1;
            continue;
        }
        let end = samples[k..].iter().position(|s| s.sign != 0);
        let after = end.map(|n| &samples[k + n]);
        let count = end.unwrap_or(samples.len() - k);
        let last = &samples[k + count - 1];
        if count >= 3 {
            let from = match before {
                Some(before) => halve(before.phi, here.phi, |phi| Ok(sign(phi)? != 0))?,
                None => here.phi,
            };
            let to = match after {
                Some(after) => halve(last.phi, after.phi, |phi| Ok(sign(phi)? == 0))?,
                None => last.phi,
            };
            dwells.push([wrap(from), wrap(to)]);
        } else if before.map(|s| s.sign) != after.map(|s| s.sign) {
            let middle = match (before, after) {
                (Some(before), Some(after)) => {
                    let way = f64::from(before.sign);
                    halve(before.phi, after.phi, |phi| {
                        Ok(coordinate(phi)?.d1 * way > 0.0)
                    })?
                }
                _ => here.phi.midpoint(last.phi),
            };
            dead_centres.push([wrap(middle), coordinate(middle)?.value]);
        }
        k += count;
    }
    dead_centres.sort_by(|a, b| a[0].total_cmp(&b[0]));
    dwells.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Ok((dead_centres, dwells))
}

fn travel(
    domain: Domain,
    slides: bool,
    coordinate: &dyn Fn(f64) -> Result<Transfer, Error>,
) -> Result<Travel, Error> {
    let (dead_centres, dwells) = rests(domain, coordinate)?;
    let ends = [
        coordinate(place(domain, 0))?.value,
        coordinate(place(domain, SAMPLES))?.value,
    ];
    let advance = ends[1] - ends[0];
    let on = domain == Domain::Turn && dead_centres.is_empty() && advance.abs() > 1e-9;
    let mut values: Vec<f64> = dead_centres.iter().map(|c| c[1]).collect();
    if let Domain::Stroke { .. } = domain {
        values.extend(ends);
    }
    for dwell in &dwells {
        values.push(coordinate(dwell[0])?.value);
    }
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (way, stroke) = match (slides, on) {
        (true, true) => ("advances", advance),
        (false, true) => ("turns", advance),
        (true, _) => ("slides", (high - low).max(0.0)),
        (false, _) => ("swings", (high - low).max(0.0)),
    };
    Ok(Travel {
        link: String::new(),
        way,
        stroke,
        dead_centres,
        dwells,
    })
}

/// The place between `a`, where `before` holds, and `b`, where it does not hold any more.
fn halve(
    mut a: f64,
    mut b: f64,
    before: impl Fn(f64) -> Result<bool, Error>,
) -> Result<f64, Error> {
    for _ in 0..60 {
        let middle = a.midpoint(b);
        if before(middle)? {
            a = middle;
        } else {
            b = middle;
        }
    }
    Ok(a.midpoint(b))
}

impl Travel {
    /// In one sentence.
    pub(super) fn sentence(&self, drive: Coordinate) -> String {
        let own = if ["slides", "advances"].contains(&self.way) {
            Coordinate::Length
        } else {
            Coordinate::Angle
        };
        let number = |x: f64| crate::output::rounded((x * 1e6).round() / 1e6 + 0.0);
        let at = |phi: f64| format!("{} {}", number(drive.shown(phi)), drive.unit());
        let centres: Vec<String> = self.dead_centres.iter().map(|c| at(c[0])).collect();
        let centres = match centres.len() {
            0 => "no dead centre".to_owned(),
            1 => format!("dead centre at {} = {}", drive.symbol(), centres[0]),
            _ => format!(
                "dead centres at {} = {}",
                drive.symbol(),
                centres.join(", ")
            ),
        };
        let dwells: Vec<String> = self
            .dwells
            .iter()
            .map(|d| format!("{} to {}", at(d[0]), at(d[1])))
            .collect();
        let rests = if dwells.is_empty() {
            String::new()
        } else {
            format!("; rests from {}", dwells.join(", "))
        };
        let stroke = format!("{} {}", number(own.shown(self.stroke)), own.unit());
        let way = match self.way {
            way @ ("turns" | "advances") => format!("{way} by {stroke} a turn"),
            way => format!("{way} by {stroke}"),
        };
        format!("{} {way}; {centres}{rests}", self.link)
    }
}
