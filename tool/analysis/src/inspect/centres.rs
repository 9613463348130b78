//! Dead centres: positions in which a link that slides or swings on the ground comes to rest while the drive moves on.

use jred::Domain;
use jred::error::Error;
use jred::machine::{Body, Joint, Jointed as _, Mechanism as _};
use jred::number::Transfer;
use serde::Serialize;

use jred_file::model::mechanism::AnyMechanism;
use jred_file::number::numerics::edge;

/// Places that are sampled over the range.
const SAMPLES: usize = 1440;

/// Share of the largest transfer function below which a link is at rest.
const REST_TOLERANCE: f64 = 1e-9;

/// Places (rad) closer than this to a whole turn are its start.
const ROUNDING: f64 = 1e-8;

/// How a link on the ground moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TravelKind {
    /// To and fro along a guide.
    Slides,
    /// To and fro on a pin.
    Swings,
    /// Along a guide without end.
    Advances,
    /// On a pin without end.
    Turns,
}

/// Motion of one link on the ground.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Travel {
    /// Name of the link.
    pub link: String,
    /// How it moves.
    pub way: TravelKind,
    /// Stroke, swing, or advance over a turn of the drive (m or rad).
    pub stroke: f64,
    /// Distance that an advancing or turning link moves backwards during a turn of the drive (m or rad).
    pub back: f64,
    /// Dead centres: position of the drive link (rad or m), and the link's own there (m or rad).
    pub dead_centres: Vec<[f64; 2]>,
    /// Dwells: start and end (rad or m of the drive link).
    pub dwells: Vec<[f64; 2]>,
}

/// The travels of every link on a pin or a guide on the ground, except the drive link.
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
        let stands_in = link >= mechanism.own_links();
        if k == mechanism.drive() || !held || stands_in || travels.iter().any(|t| t.link == name) {
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
        let travel = travel(mechanism.domain(), slides, &coordinate)?;
        // A link that does not move at all, such as a wound web by itself, has no travel.
        if travel.stroke.abs() > 0.0 || !travel.dead_centres.is_empty() {
            travels.push(Travel {
                link: name,
                ..travel
            });
        }
    }
    Ok(travels)
}

/// One sample: position of the drive, and the sign of the transfer function there, 0 at rest.
struct TransferSample {
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

/// The samples over the range, starting where the link is fastest, so that no rest crosses the ends of a turn. Also the transfer function below which
/// it is at rest.
fn samples(
    domain: Domain,
    slope: &dyn Fn(f64) -> Result<f64, Error>,
) -> Result<(Vec<TransferSample>, f64), Error> {
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
    let still = REST_TOLERANCE * most;
    let first = if domain == Domain::Turn {
        place(domain, fastest)
    } else {
        place(domain, 0)
    };
    let step = domain.span() / SAMPLES as f64;
    let samples = (0..=SAMPLES)
        .map(|k| {
            let phi = first + step * k as f64;
            Ok(TransferSample {
                phi,
                sign: sign(slope(phi)?, still),
            })
        })
        .collect::<Result<Vec<TransferSample>, Error>>()?;
    Ok((samples, still))
}

/// The rests of a link.
#[derive(Default)]
struct Rests {
    /// Dead centres, as positions of the drive and of the link.
    dead_centres: Vec<[f64; 2]>,
    dwells: Vec<[f64; 2]>,
    /// Positions of the link at all of them, in the order of passage.
    turns: Vec<f64>,
    /// Positions of the link at both ends of the drive's range or turn.
    ends: [f64; 2],
}

/// The edge of a rest between `inside` it and `outside`. Above `still` a link moves. If it starts softly, as (φ − φ₀)ⁿ, it moves before that: three
/// speeds a decade apart lie in a geometric series from φ₀ (Aitken).
fn rest_edge(
    speed: &dyn Fn(f64) -> Result<f64, Error>,
    [inside, outside]: [f64; 2],
    still: f64,
) -> Result<f64, Error> {
    let at = |most: f64| edge(|phi| Ok::<_, Error>(speed(phi)? <= most), inside, outside);
    let [a, b, c] = [at(still)?, at(10.0 * still)?, at(100.0 * still)?];
    let back = (b - a) * (b - a) / ((c - b) - (b - a));
    // A link that starts with a jump has no series, and neither has one that is too slow at `outside`.
    let series = (c - a).abs() > 1e-12
        && back.is_finite()
        && back.abs() < (c - a).abs()
        && speed(outside)? > 100.0 * still;
    Ok(if series { a - back } else { a })
}

/// Allowed speed in a rest from `from` to `to`: above rounding, so that its edges are sharp.
fn stillness(
    speed: &dyn Fn(f64) -> Result<f64, Error>,
    [from, to]: [f64; 2],
    still: f64,
) -> Result<f64, Error> {
    let mut noise = 0.0f64;
    for k in 1..16 {
        noise = noise.max(speed(from + (to - from) * f64::from(k) / 16.0)?);
    }
    Ok((100.0 * noise).clamp(1e-5 * still, still))
}

fn rests(
    domain: Domain,
    coordinate: &dyn Fn(f64) -> Result<Transfer, Error>,
) -> Result<Rests, Error> {
    let slope = |phi: f64| Ok(coordinate(phi)?.d1);
    let (samples, still) = samples(domain, &slope)?;
    let wrap = |phi: f64| match domain {
        Domain::Turn => {
            let phi = phi.rem_euclid(std::f64::consts::TAU);
            // Just before a whole turn within rounding: its start.
            if std::f64::consts::TAU - phi < ROUNDING {
                0.0
            } else {
                phi
            }
        }
        Domain::Stroke { .. } => phi,
    };
    let mut rests = Rests::default();
    if let (Some(first), Some(last)) = (samples.first(), samples.last()) {
        rests.ends = [coordinate(first.phi)?.value, coordinate(last.phi)?.value];
    }
    let mut k = 0;
    while k < samples.len() {
        let before = k.checked_sub(1).and_then(|k| samples.get(k));
        let here = &samples[k];
        if here.sign != 0 {
            if let Some(before) = before.filter(|b| b.sign == -here.sign) {
                let way = f64::from(before.sign);
                let ahead = |phi| Ok::<_, Error>(coordinate(phi)?.d1 * way > 0.0);
                let phi = edge(ahead, before.phi, here.phi)?;
                rests.turns_at(wrap(phi), phi, coordinate)?;
            }
            k += 1;
            continue;
        }
        let end = samples[k..].iter().position(|s| s.sign != 0);
        let after = end.map(|n| &samples[k + n]);
        let count = end.unwrap_or(samples.len() - k);
        let last = &samples[k + count - 1];
        if count >= 3 {
            let middle = here.phi.midpoint(last.phi);
            let speed = |phi: f64| Ok(slope(phi)?.abs());
            let still = stillness(&speed, [here.phi, last.phi], still)?;
            let from = match before {
                Some(before) => rest_edge(&speed, [middle, before.phi], still)?,
                None => here.phi,
            };
            let to = match after {
                Some(after) => rest_edge(&speed, [middle, after.phi], still)?,
                None => last.phi,
            };
            rests.turns.push(coordinate(middle)?.value);
            rests.dwells.push([wrap(from), wrap(to)]);
        } else if before.map(|s| s.sign) != after.map(|s| s.sign) {
            let middle = match (before, after) {
                (Some(before), Some(after)) => {
                    let way = f64::from(before.sign);
                    edge(
                        |phi| Ok::<_, Error>(coordinate(phi)?.d1 * way > 0.0),
                        before.phi,
                        after.phi,
                    )?
                }
                _ => here.phi.midpoint(last.phi),
            };
            rests.turns_at(wrap(middle), middle, coordinate)?;
        }
        k += count;
    }
    rests.dead_centres.sort_by(|a, b| a[0].total_cmp(&b[0]));
    rests.dwells.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Ok(rests)
}

impl Rests {
    /// Adds a dead centre at `phi` of the drive, which is `shown` within the range.
    fn turns_at(
        &mut self,
        shown: f64,
        phi: f64,
        coordinate: &dyn Fn(f64) -> Result<Transfer, Error>,
    ) -> Result<(), Error> {
        self.turns.push(coordinate(phi)?.value);
        self.dead_centres.push([shown, coordinate(shown)?.value]);
        Ok(())
    }

    /// Distance that the link moves against its `advance`.
    fn back(&self, advance: f64) -> f64 {
        let places: Vec<f64> = std::iter::once(self.ends[0])
            .chain(self.turns.iter().copied())
            .chain([self.ends[1]])
            .collect();
        let steps = places
            .windows(2)
            .map(|pair| (pair[1] - pair[0]) * advance.signum());
        steps.filter(|step| *step < 0.0).map(|step| -step).sum()
    }
}

fn travel(
    domain: Domain,
    slides: bool,
    coordinate: &dyn Fn(f64) -> Result<Transfer, Error>,
) -> Result<Travel, Error> {
    let rests = rests(domain, coordinate)?;
    let mut values = rests.turns.clone();
    if let Domain::Stroke { .. } = domain {
        values.extend(rests.ends);
    }
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let range = (high - low).max(0.0);
    let advance = rests.ends[1] - rests.ends[0];
    let on = domain == Domain::Turn && advance.abs() > 1e-9 * range.max(1.0);
    let (way, stroke, back) = match (slides, on) {
        (true, true) => (TravelKind::Advances, advance, rests.back(advance)),
        (false, true) => (TravelKind::Turns, advance, rests.back(advance)),
        (true, false) => (TravelKind::Slides, range, 0.0),
        (false, false) => (TravelKind::Swings, range, 0.0),
    };
    Ok(Travel {
        link: String::new(),
        way,
        stroke,
        back,
        dead_centres: rests.dead_centres,
        dwells: rests.dwells,
    })
}

#[cfg(test)]
mod tests;
