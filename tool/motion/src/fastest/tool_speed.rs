//! A limit of the tool's speed in a part of its way: a press that is fast everywhere but through the work.
//!
//! With r′ the transfer function of the tool's point, |r′(φ)|·ω ≤ v is a limit of the drive link's speed that depends on the place, ω ≤ v/|r′(φ)|.

use std::f64::consts::TAU;

use jred::machine::Mechanism as _;
use jred::{Domain, Error};
use jred_machine::model::coordinate::positions;
use jred_machine::model::mechanism::AnyMechanism;

/// Positions at which the largest transfer function is looked for.
const POSITIONS: usize = 720;

/// Share of it below which the tool stands, and limits nothing.
const STANDS: f64 = 1e-6;

/// The largest speed of a point of a link, between two positions of the drive link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolSpeed {
    link: usize,
    at: [f64; 2],
    /// Largest speed (m/s).
    speed: f64,
    between: [f64; 2],
    /// Transfer function (m/rad, or m/m) below which the point stands.
    stands: f64,
}

impl ToolSpeed {
    /// The `speed` (m/s) of a point `at` [u, v] (m) of a link, from the first position (rad, or m) to the second; on a turn the second may lie a turn
    /// later. `None`: the point does not move.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn new(
        mechanism: &AnyMechanism,
        (link, at): (usize, [f64; 2]),
        speed: f64,
        between: [f64; 2],
    ) -> Result<Option<Self>, Error> {
        let mut limit = Self {
            link,
            at,
            speed,
            between,
            stands: 0.0,
        };
        let mut most = 0.0f64;
        for phi in positions(mechanism.domain(), POSITIONS) {
            most = most.max(limit.slope(mechanism, phi)?);
        }
        limit.stands = STANDS * most;
        Ok((most > 0.0).then_some(limit))
    }

    /// |r′| of the point.
    fn slope(&self, mechanism: &AnyMechanism, phi: f64) -> Result<f64, Error> {
        let frames = mechanism.frames(phi)?;
        let moves = frames.get(self.link).map(|frame| {
            let [x, y] = frame.point(self.at);
            x.d1.hypot(y.d1)
        });
        Ok(moves.unwrap_or(0.0))
    }

    /// Width of the part of the way.
    fn width(&self, domain: Domain) -> f64 {
        let [from, to] = self.between;
        match domain {
            Domain::Turn if to <= from => (to - from).rem_euclid(TAU),
            _ => to - from,
        }
    }

    /// The largest speed of the drive link at a position; infinite where the tool may be as fast as it likes.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn at(&self, mechanism: &AnyMechanism, phi: f64) -> Result<f64, Error> {
        let domain = mechanism.domain();
        let into = match domain {
            Domain::Turn => (phi - self.between[0]).rem_euclid(TAU),
            Domain::Stroke { .. } => phi - self.between[0],
        };
        if !(0.0..=self.width(domain)).contains(&into) {
            return Ok(f64::INFINITY);
        }
        Ok(self.speed / self.slope(mechanism, phi)?.max(self.stands))
    }

    /// Positions between which it is smooth: the ends of its part, and so many places inside it.
    pub fn places(&self, domain: Domain, count: usize) -> impl Iterator<Item = f64> {
        let (from, width) = (self.between[0], self.width(domain));
        (0..=count).map(move |k| from + width * k as f64 / count as f64)
    }
}
