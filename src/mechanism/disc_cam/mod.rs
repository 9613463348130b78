//! The disc cam with a translating or oscillating follower with given motion s(φ).
//!
//! The cam turns about O = (0, 0); in the follower's lowest position, s = 0, roller or face touches the base circle r_b.
//!
//! ```text
//! translating, roller    B = (e, √((r_b + r_r)² − e²) + s)                     e: offset of the guide
//! translating, face      y = r_b + s                                           touches at x = s′
//! oscillating, roller    B = A + l·(cos ψ, sin ψ)    ψ = δ ± (γ₀ + s)          cos γ₀ = (d² + l² − (r_b + r_r)²)/(2·d·l)
//! oscillating, face      line through A, h nearer    ψ = δ ± (γ₀ + s)          sin γ₀ = (r_b + h)/d
//! ```
//!
//! d and δ are length and direction of the line from the follower's pivot A to O; the sign is the swing's.

mod check;
mod follower;
mod geometry;
mod profile;
mod spin;

pub use follower::{Follower, Roller, RollerDimensions, Swing};
pub use profile::{CamContact, CamProfile};

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::cam::CamError;
use crate::number::error::RangeError;
use core::f64::consts::FRAC_PI_2;

use crate::Domain;
use crate::machine::element::Element;
use crate::machine::joint::{Body, Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::mechanism::cam::{Extreme, Program};
use crate::number::error::{finite, not_negative, positive};
use crate::number::transfer::Transfer;
use spin::Spin;

/// A disc cam, driven at the cam, with its follower.
///
/// Links: [`CAM`](Self::CAM) (frame at O, turned by φ), [`FOLLOWER`](Self::FOLLOWER) (translating: frame at the roller's centre, or where the guide's
/// axis meets the face, parallel to the global axes; oscillating: at the pivot A, u along the arm to the roller's centre, or along the face), and
/// with a roller [`ROLLER`](Self::ROLLER) (frame at its centre; it rolls on the cam without slip).
///
/// Accuracy: the drive torque from the point and the normal of contact agrees with the reduced equation to 1e-10 (test
/// `joints_close_and_forces_balance`); the roller touches the profile to 1e-12 of its radius (test `roller_touches_the_profile_all_round`).
#[derive(Clone, Debug, PartialEq)]
pub struct DiscCam {
    profile: CamProfile,
    spin: Option<Spin>,
    links: heapless::Vec<Link, 3>,
}

impl DiscCam {
    /// Index of the cam.
    pub const CAM: usize = 0;
    /// Index of the follower.
    pub const FOLLOWER: usize = 1;
    /// Index of the roller, if the follower has one.
    pub const ROLLER: usize = 2;
    /// Index of the contact joint of cam and follower, for [`contact_force`](crate::mechanism::cam::contact_force) and
    /// [`lift_off`](crate::mechanism::cam::lift_off).
    pub const CONTACT: usize = 2;

    /// A cam with the base radius r_b (m) that moves the follower by the program; `links` are cam and follower, without its roller.
    ///
    /// # Errors
    /// As [`CamProfile::new`].
    pub fn new(
        program: Program,
        base_radius: f64,
        follower: Follower,
        links: [Link; 2],
    ) -> Result<Self, CamError> {
        let profile = CamProfile::new(program, base_radius, follower)?;
        let roller = follower.roller();
        Ok(Self {
            spin: roller.map(|_| Spin::new(profile.program(), profile.geometry())),
            links: links.into_iter().chain(roller.map(Roller::link)).collect(),
            profile,
        })
    }

    /// The cam program.
    pub const fn program(&self) -> &Program {
        self.profile.program()
    }

    /// The follower.
    pub const fn follower(&self) -> &Follower {
        self.profile.follower()
    }

    /// Base radius (m).
    pub const fn base_radius(&self) -> f64 {
        self.profile.base_radius()
    }

    /// The contact of cam and follower at `phi` (rad).
    #[must_use]
    pub fn contact(&self, phi: f64) -> CamContact {
        self.profile.contact(phi)
    }

    /// The point [u, v] (m) of the profile, in the cam's frame, that touches the follower at `phi`. Over a turn the points go around the cam
    /// clockwise; for equal steps of φ their distances vary.
    #[must_use]
    pub fn profile(&self, phi: f64) -> [f64; 2] {
        self.equidistant(phi, 0.0)
    }

    /// The point of the pitch curve, in the cam's frame: the roller's centre at `phi`. For a face the profile.
    #[must_use]
    pub fn pitch_curve(&self, phi: f64) -> [f64; 2] {
        self.equidistant(phi, self.follower().roller_radius())
    }

    /// The point at `distance` (m) outside the profile, along its normal, in the cam's frame: the path of the centre of a
    /// milling cutter or grinding wheel of this radius.
    #[must_use]
    pub fn equidistant(&self, phi: f64, distance: f64) -> [f64; 2] {
        self.profile.equidistant(phi, distance)
    }

    /// The smallest and the largest pressure angle (rad), with sign, and their places. Customary limits of the magnitude are 30° for translating and
    /// 45° for oscillating followers.
    #[must_use]
    pub fn pressure_angles(&self) -> [Extreme; 2] {
        self.profile.pressure_angles()
    }

    /// The smallest and the largest curvature of the profile (1/m). The reciprocal of the largest is the smallest radius of a convex part. If the
    /// smallest is negative, its reciprocal is the radius of the sharpest hollow, an upper limit for a grinding wheel.
    #[must_use]
    pub fn curvatures(&self) -> [Extreme; 2] {
        self.profile.curvatures()
    }

    /// A spring that presses the follower on the cam with `preload` in its lowest position, s = 0, and with `stiffness`·s more above it. Translating:
    /// a compression spring on the guide's axis (N, N/m). Oscillating: a torsion spring about the pivot (N·m, N·m/rad).
    ///
    /// # Errors
    /// A stiffness that is not positive, or a negative preload.
    pub fn closing_spring(&self, stiffness: f64, preload: f64) -> Result<Element, RangeError> {
        let stiffness = positive("spring stiffness", stiffness)?;
        let squeeze = not_negative("preload of the spring", preload)? / stiffness;
        let rest = self.profile.geometry().frame(Transfer::constant(0.0));
        let on_follower = Marker::on(Self::FOLLOWER, [0.0, 0.0]);
        match self.follower().pivot() {
            None => {
                // Any seat beyond the highest position works: only the change of length matters.
                let length = 2.0 * self.program().range()[1].value + self.base_radius();
                let seat = [rest.x.value, rest.y.value + length];
                Element::spring(
                    [Marker::ground(seat), on_follower],
                    stiffness,
                    length + squeeze,
                )
            }
            Some((pivot, swing)) => Element::torsion_spring(
                [Marker::ground(pivot), on_follower],
                stiffness,
                rest.psi.value - swing.sign() * squeeze,
            ),
        }
    }
}

impl Jointed for DiscCam {
    /// Cam pivot: ground and cam; guide or pivot: ground and follower; contact: cam and roller, or follower; with a roller its pin: follower and
    /// roller; and rolling: cam and roller, the friction along the profile that turns the roller.
    fn joints(&self, phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let touch = self.profile.touch(phi);
        let origin = [0.0, 0.0];
        let on_follower = Marker::on(Self::FOLLOWER, origin);
        let guide = match *self.follower() {
            Follower::TranslatingRoller { offset, .. } | Follower::TranslatingFace { offset } => {
                Joint::Prismatic([
                    Marker::ground([offset, 0.0]).with_angle(FRAC_PI_2),
                    on_follower.with_angle(FRAC_PI_2),
                ])
            }
            Follower::OscillatingRoller { pivot, .. } | Follower::OscillatingFace { pivot, .. } => {
                Joint::Revolute([Marker::ground(pivot), on_follower])
            }
        };
        let touching = if self.spin.is_some() {
            Self::ROLLER
        } else {
            Self::FOLLOWER
        };
        let bodies = [Body::Link(Self::CAM), Body::Link(touching)];
        let mut joints = Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::CAM, origin)]),
            guide,
            Joint::contact(bodies, touch.point, touch.normal),
        ]);
        if self.spin.is_some() {
            let along = [touch.normal[1], -touch.normal[0]];
            joints.extend([
                Joint::Revolute([
                    Marker::on(Self::FOLLOWER, self.profile.geometry().roller_at()),
                    Marker::on(Self::ROLLER, origin),
                ]),
                Joint::contact(bodies, touch.point, along),
            ]);
        }
        Ok(joints)
    }
}

impl Mechanism for DiscCam {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    /// Starts of the program's pieces.
    fn edge(&self, k: usize) -> Option<f64> {
        self.program().pieces().nth(k).map(|piece| piece.from)
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("cam angle", phi)?);
        let (program, geometry) = (self.program(), self.profile.geometry());
        let s = program.displacement(phi);
        let cam = Frame::turning([0.0, 0.0], angle);
        let follower = geometry.frame(s);
        let roller = self.spin.as_ref().map(|spin| {
            let pitch_speed = geometry.touch(s).pitch_speed;
            let angle = spin.angle(program, geometry, phi, pitch_speed);
            Frame::turned(follower.point(geometry.roller_at()), angle)
        });
        Ok([cam, follower].into_iter().chain(roller).collect())
    }
}
