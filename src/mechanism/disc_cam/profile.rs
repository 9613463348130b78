//! The cam itself: program, base circle and follower determine its shape.

use super::check;
use super::follower::Follower;
use super::geometry::{Geometry, Touch};
use crate::math;
use crate::mechanism::cam::CamError;
use crate::mechanism::cam::{Extreme, Program};
use crate::number::error::positive;
use crate::number::transfer::Transfer;

/// The contact of cam and follower.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct CamContact {
    /// Point of contact, global (m).
    pub point: [f64; 2],
    /// Unit normal from the cam to the follower, global.
    pub normal: [f64; 2],
    /// Pressure angle (rad): from the direction in which the follower rises to the normal, counter-clockwise positive.
    pub pressure_angle: f64,
    /// Curvature of the profile (1/m): positive where it is convex, the reciprocal of its radius.
    pub curvature: f64,
}

/// The shape of a disc cam: a program s(θ), a base circle and a follower, checked against undercut.
///
/// The cam's axis is the origin and θ the cam's angle; [`DiscCam`](super::DiscCam) gives the equations.
#[derive(Clone, Debug, PartialEq)]
pub struct CamProfile {
    program: Program,
    geometry: Geometry,
}

impl CamProfile {
    /// A cam with the base radius r_b (m) that moves the follower by the program.
    ///
    /// # Errors
    /// Dimensions that are not finite or not positive; a follower that cannot be placed on the base circle, or leaves its range; undercut, with the
    /// smallest sufficient base radius. A steep pressure angle is not an error: see [`pressure_angles`](Self::pressure_angles). Intersection of
    /// distant parts of a profile is not checked; if the curvature fits everywhere, that requires a deep hollow and a large roller.
    pub fn new(program: Program, base_radius: f64, follower: Follower) -> Result<Self, CamError> {
        let base_radius = positive("base radius", base_radius)?;
        follower.check()?;
        let geometry = check::checked(&program, follower, base_radius)?;
        Ok(Self { program, geometry })
    }

    /// The cam program.
    pub const fn program(&self) -> &Program {
        &self.program
    }

    /// The follower.
    pub const fn follower(&self) -> &Follower {
        &self.geometry.follower
    }

    /// Base radius (m).
    pub const fn base_radius(&self) -> f64 {
        self.geometry.base_radius
    }

    pub(super) const fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The contact of cam and follower at the cam's angle `theta` (rad).
    #[must_use]
    pub fn contact(&self, theta: f64) -> CamContact {
        let touch = self.touch(theta);
        CamContact {
            point: touch.point,
            normal: touch.normal,
            pressure_angle: touch.pressure_angle,
            curvature: touch.curvature,
        }
    }

    /// The follower's coordinate for the displacement s: translating: height above the cam's axis (m) of the roller's centre or the face;
    /// oscillating: angle of the arm or the face (rad).
    pub(crate) fn coordinate(&self, s: Transfer) -> Transfer {
        self.geometry.coordinate(s)
    }

    /// The point at `distance` (m) outside the profile, along its normal, in the cam's frame: the path of the centre of a
    /// milling cutter or grinding wheel of this radius; at zero the profile itself.
    #[must_use]
    pub fn equidistant(&self, theta: f64, distance: f64) -> [f64; 2] {
        let Touch { point, normal, .. } = self.touch(theta);
        let (sin, cos) = math::sin_cos(theta);
        let [x, y] = [
            point[0] + distance * normal[0],
            point[1] + distance * normal[1],
        ];
        [cos * x + sin * y, cos * y - sin * x]
    }

    /// The smallest and the largest pressure angle (rad), with sign, and their places. Customary limits of the magnitude are 30° for translating and
    /// 45° for oscillating followers.
    #[must_use]
    pub fn pressure_angles(&self) -> [Extreme; 2] {
        check::pressure_angles(&self.program, &self.geometry)
    }

    /// The smallest and the largest curvature of the profile (1/m). The reciprocal of the largest is the smallest radius of a convex part. If the
    /// smallest is negative, its reciprocal is the radius of the sharpest hollow, an upper limit for a grinding wheel.
    #[must_use]
    pub fn curvatures(&self) -> [Extreme; 2] {
        check::curvatures(&self.program, &self.geometry)
    }

    pub(super) fn touch(&self, theta: f64) -> Touch {
        self.geometry.touch(self.program.displacement(theta))
    }
}
