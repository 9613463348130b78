//! One friction stage: two shafts whose speeds are coupled by a ratio and a slip.

use super::Dual;
use super::course::{Coefficient, OperatingPoint};
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::{finite, positive};

/// Direction of power through the contact, which determines the shaft that slip slows down.
///
/// The same ε has two meanings: a belt with 2 % slip makes the driven shaft 2 % slower, and either shaft may be the driven one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Flow {
    /// (III.12) as printed, ω₁·i = ω₂·(1 − ε), j = i/(1 − ε): the second shaft drives, and the first is slower than without slip.
    #[default]
    SecondDrives,
    /// ω₂ = ω₁·i·(1 − ε), j = i·(1 − ε): the first shaft drives, and the second is slower than without slip.
    FirstDrives,
}

/// Coefficients of a stage at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ratios {
    /// Geometric ratio i: ratio of the radii, and of the torques.
    pub geometric: Dual<3>,
    /// Slip ε.
    pub slip: Dual<3>,
    /// Velocity coefficient j = ω₂/ω₁.
    pub speed: Dual<3>,
}

/// A friction stage: geometric ratio i = ω₂/ω₁ without slip (negative where the direction reverses), and slip ε.
///
/// Note that for friction drives i is second over first, as in the lecture notes, while [`mechanism::Stage`](crate::mechanism::Stage) uses first over
/// second.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    ratio: Coefficient<'a>,
    slip: Coefficient<'a>,
    flow: Flow,
}

impl<'a> Stage<'a> {
    /// A stage without slip.
    ///
    /// # Errors
    /// A constant ratio of zero or not finite.
    pub fn new(ratio: impl Into<Coefficient<'a>>) -> Result<Self, RangeError> {
        let ratio = ratio.into();
        if let Coefficient::Constant(i) = ratio {
            check_ratio(i)?;
        }
        Ok(Self {
            ratio,
            slip: Coefficient::Constant(0.0),
            flow: Flow::default(),
        })
    }

    /// The same stage with slip, whose meaning depends on `flow`.
    ///
    /// # Errors
    /// A constant slip outside [0, 1): ε = 1 couples nothing.
    pub fn with_slip(
        self,
        slip: impl Into<Coefficient<'a>>,
        flow: Flow,
    ) -> Result<Self, RangeError> {
        let slip = slip.into();
        if let Coefficient::Constant(share) = slip {
            slip_share(share)?;
        }
        Ok(Self { slip, flow, ..self })
    }

    /// Direction of power.
    pub const fn flow(&self) -> Flow {
        self.flow
    }

    /// The velocity coefficient j, if ratio and slip are constant.
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        match (self.ratio, self.slip) {
            (Coefficient::Constant(_), Coefficient::Constant(_)) => {
                let found = self.at(OperatingPoint::at_time(0.0)).ok()?;
                Some(found.speed.value)
            }
            _ => None,
        }
    }

    /// Ratio, slip and velocity coefficient with their derivatives with respect to time, angle and load.
    ///
    /// # Errors
    /// A course that is not finite there, a ratio of zero, or a slip outside (−1, 1).
    pub fn at(&self, at: OperatingPoint) -> Result<Ratios, RangeError> {
        let (geometric, slip) = (self.ratio.at(at), self.slip.at(at));
        check_ratio(geometric.value)?;
        if !geometric.is_finite() {
            return Err(RangeError::NotFinite("rate of the friction stage's ratio"));
        }
        if math::abs(finite("slip of the friction stage", slip.value)?) >= 1.0 {
            return Err(RangeError::OutOfRange {
                what: "slip of the friction stage",
                value: slip.value,
                min: -1.0,
                max: 1.0,
            });
        }
        if !slip.is_finite() {
            return Err(RangeError::NotFinite("rate of the friction stage's slip"));
        }
        let kept = -slip + 1.0;
        let speed = match self.flow {
            Flow::SecondDrives => geometric / kept,
            Flow::FirstDrives => geometric * kept,
        };
        Ok(Ratios {
            geometric,
            slip,
            speed,
        })
    }

    /// Angle of the second shaft while the first turns from `from` to `to` (rad) at the time `t`, unloaded: ∫ j dφ, the finite relation of a stage
    /// whose ratio depends only on the angle.
    ///
    /// Five-point Gauss-Legendre rule on 64 cells (error of order 10).
    ///
    /// # Errors
    /// As [`at`](Self::at).
    pub fn angle(&self, t: f64, from: f64, to: f64) -> Result<f64, RangeError> {
        crate::number::quadrature::integrate(from, to, 64, |phi| {
            Ok(self
                .at(OperatingPoint::at_time(t).with_angle(phi))?
                .speed
                .value)
        })
    }
}

fn check_ratio(i: f64) -> Result<(), RangeError> {
    positive("size of the friction stage's ratio", math::abs(i)).map(|_| ())
}

/// A constant slip in [0, 1).
pub(super) fn slip_share(slip: f64) -> Result<f64, RangeError> {
    if (0.0..1.0).contains(&finite("slip", slip)?) {
        Ok(slip)
    } else {
        Err(RangeError::OutOfRange {
            what: "slip",
            value: slip,
            min: 0.0,
            max: 1.0,
        })
    }
}
