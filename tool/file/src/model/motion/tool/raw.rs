//! The coordinate computed from the mechanism, and the branch on which it is monotonic.

use crate::math;
use std::f64::consts::TAU;

use jred::machine::{Jointed as _, Mechanism as _, PoseError};
use jred::number::Transfer;

use crate::model::mechanism::AnyMechanism;
use crate::number::numerics;

use super::{Measure, Standstill};

/// A place at which the coordinate is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Knot {
    pub(super) phi: f64,
    /// The coordinate, without jumps by whole turns.
    pub(super) value: f64,
    pub(super) slope: f64,
}

/// The coordinate computed from the mechanism.
pub(super) struct Raw<'a> {
    pub(super) mechanism: &'a AnyMechanism,
    pub(super) measure: Measure,
}

/// Places from the start of a branch to its end.
pub(super) struct Reach {
    pub(super) places: Vec<f64>,
    /// Whether it covers the whole range.
    pub(super) closed: bool,
}

impl Raw<'_> {
    /// The coordinate at φ: an angle up to whole turns, a distance along the path without its value.
    fn transfer(&self, phi: f64) -> Result<Transfer, PoseError> {
        let frames = self.mechanism.frames(phi)?;
        let frame = |link: usize| frames.get(link).copied();
        Ok(match self.measure {
            Measure::Position { link, at, axis } => frame(link).map(|frame| {
                let [x, y] = frame.point(at);
                if axis == 0 { x } else { y }
            }),
            Measure::Path { link, at } => frame(link).map(|frame| {
                let [x, y] = frame.point(at);
                let speed = math::hypot(x.d1, y.d1);
                let bend = (x.d1 * x.d2 + y.d1 * y.d2) / speed.max(f64::MIN_POSITIVE);
                Transfer {
                    value: 0.0,
                    d1: speed,
                    d2: bend,
                    d3: 0.0,
                }
            }),
            Measure::Angle { link } => frame(link).map(|frame| frame.psi),
            Measure::Slide { joint } => {
                let joints = self.mechanism.joints(phi, &frames)?;
                joints.get(joint).map(|joint| joint.coordinate(&frames))
            }
        }
        .unwrap_or(Transfer::constant(0.0)))
    }

    pub(super) fn slope(&self, phi: f64) -> Result<f64, Standstill> {
        Ok(self.transfer(phi).map_err(Standstill::Unplaced)?.d1)
    }

    /// The same with its value continued from a nearby knot: whole turns, or the distance along the path.
    pub(super) fn from(&self, knot: Option<&Knot>, phi: f64) -> Result<Transfer, PoseError> {
        let mut found = self.transfer(phi)?;
        let Some(knot) = knot else {
            return Ok(found);
        };
        match self.measure {
            Measure::Angle { .. } => {
                let expected = knot.value + knot.slope * (phi - knot.phi);
                found.value += ((expected - found.value) / TAU).round() * TAU;
            }
            Measure::Path { .. } => {
                let speed = |phi: f64| Ok::<_, PoseError>(self.transfer(phi)?.d1);
                found.value = knot.value + numerics::gauss(&speed, [knot.phi, phi])?;
            }
            _ => {}
        }
        Ok(found)
    }

    /// Places from `near` in steps until the tool is at rest or the end is reached.
    pub(super) fn reach(
        &self,
        near: f64,
        step: f64,
        end: f64,
        moves: &impl Fn(f64) -> Result<bool, Standstill>,
    ) -> Result<Reach, Standstill> {
        let count = ((end - near) / step).abs().ceil() as usize;
        let place = |k: usize| {
            if k < count {
                near + step * k as f64
            } else {
                end
            }
        };
        let speed = |phi: f64| Ok::<_, Standstill>(self.slope(phi)?.abs());
        let mut speeds = vec![speed(near)?];
        let mut stop = None;
        for k in 1..=count {
            if !moves(place(k))? {
                stop = Some((k - 1, place(k)));
                break;
            }
            speeds.push(speed(place(k))?);
            // Between places it may be at rest where its speed is least, unless the speed hardly changes: a curve that touches zero there rises to at
            // least four times its value at one of its neighbours.
            if let [.., a, b, c] = speeds[..]
                && b <= a
                && b <= c
                && b < 4.0 * (a.max(c) - b)
            {
                let [from, to] = [place(k - 2), place(k)];
                let slowest = numerics::least(speed, from.min(to), from.max(to))?;
                if !moves(slowest)? {
                    let before = if (place(k - 1) - slowest) * step < 0.0 {
                        k - 1
                    } else {
                        k - 2
                    };
                    stop = Some((before, slowest));
                    break;
                }
            }
        }
        let Some((last, stop)) = stop else {
            let places = (0..=count).map(place).collect();
            return Ok(Reach {
                places,
                closed: true,
            });
        };
        let mut places: Vec<f64> = (0..=last).map(place).collect();
        // The last place at which it still moves.
        let [inside, _] = numerics::sides(moves, place(last), stop)?;
        if (inside - place(last)).abs() > 0.0 {
            places.push(inside);
        }
        Ok(Reach {
            places,
            closed: false,
        })
    }

    /// The coordinate at places in order of φ; along the path it is zero at `near`.
    pub(super) fn knots(&self, places: &[f64], near: f64) -> Result<Vec<Knot>, Standstill> {
        let mut knots: Vec<Knot> = Vec::with_capacity(places.len());
        for &phi in places {
            let found = self.from(knots.last(), phi).map_err(Standstill::Unplaced)?;
            knots.push(Knot {
                phi,
                value: found.value,
                slope: found.d1,
            });
        }
        // Whole turns, and the zero of the path, are defined at `near`.
        let here = knots.iter().find(|knot| knot.phi >= near);
        let shift = match (self.measure, here) {
            (Measure::Path { .. }, Some(here)) => -here.value,
            (Measure::Angle { .. }, Some(here)) => {
                let raw = self.transfer(here.phi).map_err(Standstill::Unplaced)?;
                raw.value - here.value
            }
            _ => 0.0,
        };
        for knot in &mut knots {
            knot.value += shift;
        }
        Ok(knots)
    }
}
