//! A speed limit of the tool in a part of its path, as for a press that is fast except through the work.
//!
//! With the transfer function r′ of the tool's point, |r′(φ)|·ω ≤ v limits the drive link's speed by position: ω ≤ v/|r′(φ)|.

use jred_file::math;
use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::Mechanism as _;
use jred_file::model::coordinate::positions;
use jred_file::model::mechanism::AnyMechanism;

/// Positions at which the largest transfer function is searched.
const POSITIONS: usize = 720;

/// Most limits of the tool's speed.
pub const MOST: usize = 8;

/// Share of the largest transfer function below which the tool is at rest and sets no limit.
const ZERO_TRANSFER: f64 = 1e-6;

/// The largest speed of a point of a link, between two positions of the drive link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolSpeed {
    link: usize,
    at: [f64; 2],
    /// Largest speed (m/s).
    speed: f64,
    between: [f64; 2],
    /// Whether the part repeats with every turn.
    repeats: bool,
    /// Transfer function (m/rad, or m/m) below which the point is at rest.
    stands: f64,
}

impl ToolSpeed {
    /// Limits the `speed` (m/s) of a point `at` [u, v] (m) of a link, from the first position (rad, or m) to the second; on a turn the second may lie
    /// a turn later. `None` if the point does not move.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn new(
        mechanism: &AnyMechanism,
        link: usize,
        at: [f64; 2],
        speed: f64,
        between: [f64; 2],
    ) -> Result<Option<Self>, Error> {
        let mut limit = Self {
            link,
            at,
            speed,
            between,
            repeats: true,
            stands: 0.0,
        };
        let mut most = 0.0f64;
        for phi in positions(mechanism.domain(), POSITIONS) {
            most = most.max(limit.slope(mechanism, phi)?);
        }
        limit.stands = ZERO_TRANSFER * most;
        Ok((most > 0.0).then_some(limit))
    }

    /// The same in a part that does not repeat with every turn, such as a length of an axis over several turns: from the smaller position to the
    /// larger one.
    #[must_use]
    pub const fn once(self) -> Self {
        let [a, b] = self.between;
        Self {
            between: [a.min(b), a.max(b)],
            repeats: false,
            ..self
        }
    }

    /// |r′| of the point.
    fn slope(&self, mechanism: &AnyMechanism, phi: f64) -> Result<f64, Error> {
        let frames = mechanism.frames(phi)?;
        let moves = frames.get(self.link).map(|frame| {
            let [x, y] = frame.point(self.at);
            math::hypot(x.d1, y.d1)
        });
        Ok(moves.unwrap_or(0.0))
    }

    /// Length of the part.
    fn width(&self, domain: Domain) -> f64 {
        let [from, to] = self.between;
        match domain {
            Domain::Turn if self.repeats && to <= from => (to - from).rem_euclid(TAU),
            _ => to - from,
        }
    }

    /// The largest speed of the drive link at a position; infinite where the tool has no limit.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn at(&self, mechanism: &AnyMechanism, phi: f64) -> Result<f64, Error> {
        let domain = mechanism.domain();
        let into = match domain {
            Domain::Turn if self.repeats => (phi - self.between[0]).rem_euclid(TAU),
            _ => phi - self.between[0],
        };
        if !(0.0..=self.width(domain)).contains(&into) {
            return Ok(f64::INFINITY);
        }
        Ok(self.speed / self.slope(mechanism, phi)?.max(self.stands))
    }

    /// Positions between which the limit is smooth: the ends of its part, and `count` places inside it in a turn or on a stroke.
    pub fn places(&self, domain: Domain, count: usize) -> impl Iterator<Item = f64> + use<> {
        let (from, width) = (self.between[0], self.width(domain));
        let turns = match domain {
            Domain::Turn => (width / TAU).ceil().max(1.0) as usize,
            Domain::Stroke { .. } => 1,
        };
        let count = count * turns;
        (0..=count).map(move |k| from + width * k as f64 / count as f64)
    }
}

/// Several speed limits of the tool, at most [`MOST`]; initially empty.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolSpeeds([Option<ToolSpeed>; MOST]);

impl ToolSpeeds {
    /// With one more limit; `None` if there are too many.
    #[must_use]
    pub fn with(mut self, limit: ToolSpeed) -> Option<Self> {
        *self.0.iter_mut().find(|own| own.is_none())? = Some(limit);
        Some(self)
    }

    /// Whether there is a limit.
    pub fn is_some(&self) -> bool {
        self.iter().next().is_some()
    }

    /// Each limit.
    pub fn iter(&self) -> impl Iterator<Item = &ToolSpeed> {
        self.0.iter().flatten()
    }

    /// The largest speed of the drive link that all limits allow at a position; infinite: no limit.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn at(&self, mechanism: &AnyMechanism, phi: f64) -> Result<f64, Error> {
        let mut least = f64::INFINITY;
        for limit in self.iter() {
            least = least.min(limit.at(mechanism, phi)?);
        }
        Ok(least)
    }
}

impl From<ToolSpeed> for ToolSpeeds {
    fn from(limit: ToolSpeed) -> Self {
        let mut all = Self::default();
        all.0[0] = Some(limit);
        all
    }
}
