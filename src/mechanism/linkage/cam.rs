//! A cam and its follower as a pair of a linkage: one equation, and the force along the normal of contact.

use crate::machine::joint::{Joint, Marker};
use crate::machine::link::Frame;
use crate::mechanism::CamProfile;
use crate::number::transfer::Transfer;

pub(super) type Cams<const CAMS: usize> = heapless::Vec<PlacedCam, CAMS>;

/// A cam and its follower, placed in a linkage, for [`Pair::Cam`](super::Pair::Cam).
///
/// The base is a marker on the body with the bearings of both, usually the ground: its point is the cam's axis, the origin of the [`CamProfile`], and
/// its direction the profile's +x.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedCam {
    profile: CamProfile,
    base: Marker,
}

impl PlacedCam {
    /// The cam with its axis at the point of `base`, with the whole arrangement turned into its direction.
    #[must_use]
    pub const fn new(profile: CamProfile, base: Marker) -> Self {
        Self { profile, base }
    }

    /// The shape of the cam.
    pub const fn profile(&self) -> &CamProfile {
        &self.profile
    }

    /// The cam's axis and the direction of the arrangement.
    pub const fn base(&self) -> &Marker {
        &self.base
    }

    /// The cam's angle θ, the argument of the program.
    fn angle(&self, cam: &Marker, frames: &[Frame]) -> Transfer {
        cam.direction(frames) - self.base.direction(frames)
    }

    /// The follower's coordinate minus its value for the displacement `s`(θ): height above the cam's axis, or angle.
    pub(super) fn equation(
        &self,
        [cam, follower]: [&Marker; 2],
        frames: &[Frame],
        s: impl Fn(Transfer) -> Transfer,
    ) -> Transfer {
        let coordinate = if self.profile.follower().pivot().is_some() {
            follower.direction(frames) - self.base.direction(frames)
        } else {
            super::pair::off_line(&self.base, follower, frames)
        };
        coordinate - self.profile.coordinate(s(self.angle(cam, frames)))
    }

    /// s from the program.
    pub(super) fn displacement(&self, theta: Transfer) -> Transfer {
        self.profile
            .program()
            .displacement(theta.value)
            .after(theta)
    }

    /// The point and the normal of contact.
    pub(super) fn joint(&self, [cam, follower]: [&Marker; 2], frames: &[Frame]) -> Joint {
        let contact = self.profile.contact(self.angle(cam, frames).value);
        let [x, y] = self.base.position(frames).map(|c| c.value);
        let [cos, sin] = self.base.axis(frames).map(|c| c.value);
        let turned = |[u, v]: [f64; 2]| [cos * u - sin * v, sin * u + cos * v];
        let [to_x, to_y] = turned(contact.point);
        Joint::contact(
            [cam.body, follower.body],
            [x + to_x, y + to_y],
            turned(contact.normal),
        )
    }
}
