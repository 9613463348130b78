//! Integrates one field of accelerations through a cell.

use jred_file::number::quadrature::GAUSS_3;

use super::field::{Field, speed};
use super::sweep::Side;
use super::track::PathCell;

/// Error of a step as a share of z, from the difference of orders 4 and 3; the real error is much smaller.
const TOLERANCE: f64 = 1e-10;

/// Largest relative change of z in a step over the position. A larger change is integrated over time, which is smooth at rest.
const STEEP: f64 = 0.05;

/// Halvings after which a step is accepted anyway: the field jumps there.
const DEEPEST: u32 = 14;

/// Halvings after which a motion that does not advance has stopped.
const STOPPED: u32 = 48;

/// Halvings to find where a smooth part of the field ends.
const PART_HALVINGS: u32 = 44;

/// Newton steps for the duration of a step.
const MOST_TRIALS: u32 = 12;

/// Relative error of a step's end with which they stop.
const END_TOLERANCE: f64 = 1e-14;

/// A step, in the direction of the motion.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Shares of the cell at its start and end, rising.
    pub u: [f64; 2],
    /// z = ½·v² there.
    pub z: [f64; 2],
    /// Slopes of z there: the accelerations.
    pub a: [f64; 2],
    /// Duration (s), where it was integrated over time.
    pub time: Option<f64>,
}

impl Step {
    /// Duration (s) in a cell of this length.
    pub fn time(&self, length: f64) -> f64 {
        self.time.unwrap_or_else(|| {
            let [v0, v1] = self.z.map(speed);
            let dynamics = (self.u[1] - self.u[0]) * length;
            let (sum, rise) = (v0 + v1, v1 - v0);
            // At the places of constant acceleration, where dx/v is constant.
            let part = |[s, weight]: [f64; 2]| {
                let place = s * (2.0 * v0 + rise * s) / sum;
                weight * (v0 + rise * s) / speed(self.hermite(place, dynamics))
            };
            2.0 * dynamics / sum * GAUSS_3.into_iter().map(part).sum::<f64>()
        })
    }

    /// z at a share of the step: the cubic through both ends and slopes.
    pub fn hermite(&self, s: f64, dynamics: f64) -> f64 {
        let [z0, z1] = self.z;
        let [a0, a1] = self.a.map(|a| a * dynamics);
        let rise = z1 - z0;
        z0 + s * (a0 + s * (3.0 * rise - 2.0 * a0 - a1 + s * (a0 + a1 - 2.0 * rise)))
    }
}

/// Why a leg goes no further than this share of its cell.
#[derive(Clone, Copy, Debug)]
pub enum Stall {
    /// The motion comes to rest.
    AtRest(f64),
    /// It needs too many steps.
    Stiff(f64),
}

/// Most steps of a motion, some seconds. A machine that follows its friction at once would need more.
pub const MOST_STEPS: usize = 1_500_000;

/// A point of a leg: share of the cell, z, slope.
#[derive(Clone, Copy, Debug)]
pub struct PhasePoint {
    /// Share of the cell.
    pub u: f64,
    /// z = ½·v².
    pub z: f64,
    /// Slope of z: the acceleration.
    pub a: f64,
    /// The smooth part of the field that contains it.
    pub part: u32,
}

/// Result of a step: z, its slope with the part of the field, the error, and the duration where it was integrated over time.
type StepResult = (f64, (f64, u32), f64, Option<f64>);

/// A step from a point.
#[derive(Clone, Copy)]
struct FieldStep {
    to: f64,
    z: f64,
    a: f64,
    part: u32,
    time: Option<f64>,
}

impl FieldStep {
    fn end(&self, u: f64) -> PhasePoint {
        PhasePoint {
            u,
            z: self.z,
            a: self.a,
            part: self.part,
        }
    }

    /// As a step in the direction of the motion.
    fn step(&self, from: PhasePoint) -> Step {
        let end = self.end(self.to);
        let [first, last] = if end.u > from.u {
            [from, end]
        } else {
            [end, from]
        };
        Step {
            u: [first.u, last.u],
            z: [first.z, last.z],
            a: [first.a, last.a],
            time: self.time,
        }
    }
}

/// A field in a cell: the largest or the least acceleration at a place and z.
#[derive(Clone, Copy)]
pub struct Leg<'c> {
    /// The accelerations that limits leave.
    pub field: &'c Field<'c, 'c>,
    /// The largest or the least.
    pub side: Side,
    /// The cell.
    pub cell: &'c PathCell,
}

impl Leg<'_> {
    /// The acceleration at a share of the cell with this z.
    pub fn at(&self, u: f64, z: f64) -> f64 {
        self.field.side(self.side, &self.cell.spot(u), z)
    }

    /// The point at a share of the cell with this z.
    pub fn point(&self, u: f64, z: f64) -> PhasePoint {
        let (a, part) = self.field.side_part(self.side, &self.cell.spot(u), z);
        PhasePoint { u, z, a, part }
    }

    /// Integrates from a point to a share of the cell, forwards or backwards; adds the steps to `steps` in the order of integration.
    ///
    /// # Errors
    /// The motion comes to rest before, or needs too many steps.
    pub fn go(
        &self,
        from: PhasePoint,
        to: f64,
        steps: &mut Vec<Step>,
    ) -> Result<PhasePoint, Stall> {
        self.halved(from, to, 0, steps)
    }

    fn halved(
        &self,
        from: PhasePoint,
        to: f64,
        depth: u32,
        steps: &mut Vec<Step>,
    ) -> Result<PhasePoint, Stall> {
        if steps.len() > MOST_STEPS {
            return Err(Stall::Stiff(from.u));
        }
        if let Some((step, error)) = self.one(from, to) {
            let end = step.end(to);
            if error <= TOLERANCE * from.z.max(end.z) || depth >= DEEPEST {
                if end.part != from.part
                    && depth < DEEPEST
                    && let Some(crossing) = self.other_part(from, to)
                {
                    steps.push(crossing.step(from));
                    return self.halved(crossing.end(crossing.to), to, depth + 1, steps);
                }
                steps.push(step.step(from));
                return Ok(end);
            }
        } else if depth >= STOPPED {
            return Err(Stall::AtRest(from.u));
        }
        let middle = from.u.midpoint(to);
        let between = self.halved(from, middle, depth + 1, steps)?;
        self.halved(between, to, depth + 1, steps)
    }

    /// One step with its error: over the position where z changes little, else over time.
    fn one(&self, from: PhasePoint, to: f64) -> Option<(FieldStep, f64)> {
        let (z, (a, part), error, time) = self
            .over_way(from, to)
            .or_else(|| self.over_time(from, to))?;
        let one = FieldStep {
            to,
            z,
            a,
            part,
            time,
        };
        Some((one, error))
    }

    /// The step to the nearest place in another part of the field, so that steps end where the field bends.
    fn other_part(&self, from: PhasePoint, to: f64) -> Option<FieldStep> {
        let (mut near, mut far) = (from.u, to);
        let mut found = None;
        for _ in 0..PART_HALVINGS {
            let middle = near.midpoint(far);
            let (one, _) = self.one(from, middle)?;
            if one.part == from.part {
                near = middle;
            } else {
                far = middle;
                found = Some(one);
            }
        }
        found
    }

    /// The classical Runge-Kutta step over the position; `None` where z changes much.
    fn over_way(&self, from: PhasePoint, to: f64) -> Option<StepResult> {
        let h = (to - from.u) * self.cell.length;
        if (from.a * h).abs() > STEEP * from.z {
            return None;
        }
        let [middle, end] = [from.u.midpoint(to), to].map(|u| self.cell.spot(u));
        let f = |place, z| self.field.side(self.side, place, z);
        let k1 = from.a;
        let k2 = f(&middle, from.z + 0.5 * h * k1);
        let k3 = f(&middle, from.z + 0.5 * h * k2);
        let k4 = f(&end, from.z + h * k3);
        let z = from.z + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        if (z - from.z).abs() > 2.0 * STEEP * from.z {
            return None;
        }
        let (a, part) = self.field.side_part(self.side, &end, z);
        Some((z, (a, part), (h / 6.0 * (k4 - a)).abs(), None))
    }

    /// The same over time, with the duration found by Newton's method; `None` where the motion stops before.
    fn over_time(&self, from: PhasePoint, to: f64) -> Option<StepResult> {
        let length = self.cell.length;
        let heading = (to - from.u).signum();
        let dynamics = (to - from.u).abs() * length;
        let start = speed(from.z);
        let a0 = heading * from.a;
        let square = start * start + 2.0 * a0 * dynamics;
        if square <= 0.0 {
            return None;
        }
        let at = |x: f64, v: f64| heading * self.at(from.u + heading * x / length, 0.5 * v * v);
        let mut t = 2.0 * dynamics / (start + square.sqrt());
        for _ in 0..MOST_TRIALS {
            let half = 0.5 * t;
            let v2 = start + half * a0;
            let a2 = at(half * start, v2.max(0.0));
            let v3 = start + half * a2;
            let a3 = at(half * v2, v3.max(0.0));
            let v4 = start + t * a3;
            let a4 = at(t * v3, v4.max(0.0));
            let x = t / 6.0 * (start + 2.0 * (v2 + v3) + v4);
            let v = start + t / 6.0 * (a0 + 2.0 * (a2 + a3) + a4);
            if v <= 0.0 {
                return None;
            }
            let missing = dynamics - x;
            if missing.abs() <= END_TOLERANCE * dynamics {
                let z = 0.5 * v * v;
                let end = self.point(to, z);
                let error = (t / 6.0 * (a4 - heading * end.a)).abs() * v;
                return Some((z, (end.a, end.part), error, Some(t)));
            }
            t += missing / v;
            if t <= 0.0 {
                return None;
            }
        }
        None
    }
}
