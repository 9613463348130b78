//! Quantities that vary: a ratio shifted over time, a slip that grows with the load.

use crate::number::error::RangeError;
use core::f64::consts::TAU;
use core::fmt;

use super::{CreepLimit, Dual};
use crate::machine::motion::Law;
use crate::math;
use crate::number::error::{finite, positive};
use crate::number::spline::CubicSpline;

/// The arguments of a course: time, angle and load of one friction stage, with derivatives with respect to the three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperatingPoint {
    /// Time t (s).
    pub t: Dual<3>,
    /// Angle of the stage's first shaft (rad).
    pub phi: Dual<3>,
    /// Load: contact torque on the stage's second shaft (N·m), positive where power flows in the direction of the stage's [`Flow`](super::Flow),
    /// negative where it flows back.
    pub load: Dual<3>,
}

impl OperatingPoint {
    /// The time `t` (s), at the angle 0 and without load.
    #[must_use]
    pub fn at_time(t: f64) -> Self {
        Self {
            t: Dual::variable(t, 0),
            phi: Dual::variable(0.0, 1),
            load: Dual::variable(0.0, 2),
        }
    }

    /// The same at the angle `phi` (rad).
    #[must_use]
    pub fn with_angle(self, phi: f64) -> Self {
        Self {
            phi: Dual::variable(phi, 1),
            ..self
        }
    }

    /// The same under the load `load` (N·m).
    #[must_use]
    pub fn with_load(self, load: f64) -> Self {
        Self {
            load: Dual::variable(load, 2),
            ..self
        }
    }

    /// One of the three arguments.
    #[must_use]
    pub const fn of(&self, variable: Variable) -> Dual<3> {
        match variable {
            Variable::Time => self.t,
            Variable::Angle => self.phi,
            Variable::Load => self.load,
        }
    }
}

/// The argument of a predefined course.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Variable {
    /// Time (s).
    #[default]
    Time,
    /// Angle of the stage's first shaft (rad).
    Angle,
    /// Load of the stage (N·m).
    Load,
}

/// The variation of a ratio or a slip. Closures on [`OperatingPoint`] are courses as well:
///
/// ```
/// use jred::friction::{Course, Dual, OperatingPoint};
///
/// let ratio = |at: OperatingPoint| (at.t * 3.0).sin_cos().0 * 0.2 + 1.0;
/// let found = ratio.at(OperatingPoint::at_time(0.5));
/// assert!((found.slope[0] - 0.6 * 1.5f64.cos()).abs() < 1e-15);
/// # let _: Dual<3> = found;
/// ```
pub trait Course {
    /// Value with its derivatives with respect to time, angle and load.
    fn at(&self, at: OperatingPoint) -> Dual<3>;
}

impl<F: Fn(OperatingPoint) -> Dual<3>> Course for F {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        self(at)
    }
}

/// A ratio or a slip: a number or a course.
#[derive(Clone, Copy)]
pub enum Coefficient<'a> {
    /// Always the same.
    Constant(f64),
    /// Varying.
    Course(&'a dyn Course),
}

impl Coefficient<'_> {
    /// Value with its derivatives.
    #[must_use]
    pub fn at(&self, at: OperatingPoint) -> Dual<3> {
        match self {
            Self::Constant(value) => Dual::constant(*value),
            Self::Course(course) => course.at(at),
        }
    }
}

impl fmt::Debug for Coefficient<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => f.debug_tuple("Constant").field(value).finish(),
            Self::Course(_) => f.write_str("Course(..)"),
        }
    }
}

impl From<f64> for Coefficient<'_> {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

impl<'a, C: Course> From<&'a C> for Coefficient<'a> {
    fn from(course: &'a C) -> Self {
        Self::Course(course)
    }
}

/// Range and values of a ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RampShape {
    /// Start in the variable.
    pub start: f64,
    /// Length in the variable, > 0.
    pub length: f64,
    /// Value before and value after.
    pub values: [f64; 2],
}

/// A transition from one value to another by a motion law; outside it the end values.
///
/// [`Law::Polynomial345`] shifts without a jump of acceleration. [`Ramp::linear`] is the straight line with limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    over: Variable,
    start: f64,
    length: f64,
    values: [f64; 2],
    law: Option<Law>,
}

impl Ramp {
    /// A ramp of this shape over a variable, by a motion law.
    ///
    /// # Errors
    /// A length that is not positive, a value that is not finite, or an invalid law.
    pub fn new(over: Variable, shape: RampShape, law: Law) -> Result<Self, RangeError> {
        law.check()?;
        Ok(Self {
            law: Some(law),
            ..Self::linear(over, shape)?
        })
    }

    /// The same as a straight line. Its slope jumps at both ends, where the equation of motion requires a jump of torque; there it has the slope of
    /// the line.
    ///
    /// # Errors
    /// A length that is not positive, or a value that is not finite.
    pub fn linear(over: Variable, shape: RampShape) -> Result<Self, RangeError> {
        let RampShape {
            start,
            length,
            values,
        } = shape;
        Ok(Self {
            over,
            start: finite("start of the ramp", start)?,
            length: positive("length of the ramp", length)?,
            values: [
                finite("first value of the ramp", values[0])?,
                finite("last value of the ramp", values[1])?,
            ],
            law: None,
        })
    }
}

impl Course for Ramp {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        let z = (at.of(self.over) - self.start) / self.length;
        let [s, slope] = match self.law {
            Some(law) => {
                let [s, slope, _] = law.at(z.value);
                [s, slope]
            }
            None if z.value < 0.0 => [0.0, 0.0],
            None if z.value > 1.0 => [1.0, 0.0],
            None => [z.value, 1.0],
        };
        let [from, to] = self.values;
        z.through(s, slope) * (to - from) + from
    }
}

/// The parameters of a sine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SineShape {
    /// Mean value.
    pub mean: f64,
    /// Largest distance from it.
    pub amplitude: f64,
    /// In rad per unit of x (rad/s over time).
    pub frequency: f64,
    /// Phase at x = 0 (rad).
    pub phase: f64,
}

/// mean + amplitude·sin(frequency·x + phase).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sine {
    over: Variable,
    shape: SineShape,
}

impl Sine {
    /// A sine over the variable x.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn new(over: Variable, shape: SineShape) -> Result<Self, RangeError> {
        finite("mean of the sine", shape.mean)?;
        finite("amplitude of the sine", shape.amplitude)?;
        finite("frequency of the sine", shape.frequency)?;
        finite("phase of the sine", shape.phase)?;
        Ok(Self { over, shape })
    }
}

impl Course for Sine {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        let shape = &self.shape;
        let (sin, _) = (at.of(self.over) * shape.frequency + shape.phase).sin_cos();
        sin * shape.amplitude + shape.mean
    }
}

/// A measured curve: the spline through samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<C> {
    over: Variable,
    start: f64,
    length: f64,
    periodic: bool,
    spline: CubicSpline<C>,
}

impl<C: AsRef<[f64]>> Curve<C> {
    /// A curve over x from `start` to `start + length`, with the end values outside. Compute the control points by
    /// [`fit_bounded`](crate::number::spline::fit_bounded).
    ///
    /// # Errors
    /// A start that is not finite, or a length that is not positive.
    pub fn bounded(
        over: Variable,
        start: f64,
        length: f64,
        spline: CubicSpline<C>,
    ) -> Result<Self, RangeError> {
        Ok(Self {
            over,
            start: finite("start of the curve", start)?,
            length: positive("length of the curve", length)?,
            periodic: false,
            spline,
        })
    }

    /// A curve over one turn of the stage's first shaft, repeated. Compute the control points by
    /// [`fit_periodic`](crate::number::spline::fit_periodic).
    #[must_use]
    pub const fn turn(spline: CubicSpline<C>) -> Self {
        Self {
            over: Variable::Angle,
            start: 0.0,
            length: TAU,
            periodic: true,
            spline,
        }
    }
}

impl<C: AsRef<[f64]>> Course for Curve<C> {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        let place = (at.of(self.over) - self.start) / self.length;
        let x = place.value;
        let inside = if self.periodic { x - math::floor(x) } else { x };
        let [value, slope, _] = self.spline.at(inside);
        let beyond = !(0.0..=1.0).contains(&inside);
        place.through(value, if beyond { 0.0 } else { slope })
    }
}

/// Creep: slip in proportion to the load, ε = s·load/limit. Where power flows back the slip is negative, so that the contact never supplies power.
///
/// Valid for |load| ≤ limit, the capacity of the contact; beyond it slides, and [`Drive`](super::Drive) refuses slips above one.
/// [`CreepContact`](super::CreepContact) also covers sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Creep(CreepLimit);

impl Creep {
    /// Creep up to this limit.
    ///
    /// # Errors
    /// A slip outside [0, 1), or a torque that is not positive.
    pub fn new(limit: CreepLimit) -> Result<Self, RangeError> {
        limit.check()?;
        Ok(Self(limit))
    }
}

impl Course for Creep {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        at.load * (self.0.slip / self.0.torque)
    }
}
