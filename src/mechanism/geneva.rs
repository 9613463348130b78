//! The external Geneva drive in closed form.
//!
//! Crank axis O = (0, 0), wheel axis C = (a, 0), crank pin A = r·(cos φ, sin φ). The pin enters and leaves the slots
//! without shock, along them, if the crank is perpendicular to the slot there: r = a·sin(π/n). With m = r/a:
//!
//! ```text
//! engaged, |φ| < π/2 − π/n:        tan δ = m·sin φ/(1 − m·cos φ)        wheel: ψ = π − δ
//! dwell:                           δ = ±π/n
//! δ′ = m·(cos φ − m)/(1 + m² − 2m·cos φ)        δ″ = −m·(1 − m²)·sin φ/(1 + m² − 2m·cos φ)²
//! largest |ψ′| = m/(1 − m) at φ = 0;  largest |ψ″| at cos φ = √(q² + 2) − q, q = (1 + m²)/(4m)
//! ```
//!
//! The formulas are those of Sclater and Chironis, *Mechanisms and mechanical devices sourcebook*, "Kinematics of
//! intermittent mechanisms", with m for 1/m.
//!
//! **Smoothness.** At entry and exit ψ′ = 0, and |ψ″| jumps between 0 and tan(π/n). J = J₁ + J₂·ψ′² and J′ = 2·J₂·ψ′·ψ″ are continuous, J″ =
//! 2·J₂·(ψ″² + ψ′·ψ‴) jumps by 2·J₂·tan²(π/n). The torque on the crank has no step; the force on the pin has one, because its lever arm about C is
//! not zero.

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::{PI, TAU};

use super::dimensions::centred;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::number::error::{finite, positive, within};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// An external Geneva drive, driven at the crank, which turns fully.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`WHEEL`](Self::WHEEL) (frame at C, u along slot 0; slot k lies at 2πk/n). Turn k of the
/// crank, from φ = 2πk − π to 2πk + π, engages slot k and advances the wheel by −2π/n: against the crank. So ψ is not periodic with the crank's turn,
/// but J and the force in every joint are, provided that the wheel's centre of mass lies on its axis: the wheel has n-fold symmetry.
///
/// Accuracy: within thirty turns of φ = 0, ψ, ψ′ and ψ″ agree with the formulas above to 1e-12 of the next derivative's largest value, at least 1
/// (test `wheel_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct Geneva {
    slots: u32,
    centres: f64,
    crank: f64,
    links: [Link; 2],
}

impl Geneva {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the wheel.
    pub const WHEEL: usize = 1;
    /// Least number of slots: with two, the pin would have to pass the wheel's axis.
    pub const MIN_SLOTS: u32 = 3;
    /// Greatest number of slots.
    pub const MAX_SLOTS: u32 = 24;

    /// A Geneva drive with `slots` n, the distance `centres` a of the two axes (m) and the links crank, wheel.
    ///
    /// # Errors
    /// A number of slots outside 3 to 24; a distance that is not positive; a wheel whose centre of mass is off its axis, because its weight would
    /// only be periodic over n turns of the crank.
    pub fn new(slots: u32, centres: f64, links: [Link; 2]) -> Result<Self, BuildError> {
        let [min, max] = [Self::MIN_SLOTS, Self::MAX_SLOTS].map(f64::from);
        within("number of slots", f64::from(slots), [min, max])?;
        let centres = positive("centre distance", centres)?;
        centred("wheel", &links[1])?;
        let (sin, _) = math::sin_cos(PI / f64::from(slots));
        Ok(Self {
            slots,
            centres,
            crank: centres * sin,
            links,
        })
    }

    /// Number of slots n.
    pub const fn slots(&self) -> u32 {
        self.slots
    }

    /// Distance a of the axes (m).
    pub const fn centres(&self) -> f64 {
        self.centres
    }

    /// Crank length r = a·sin(π/n) (m).
    pub const fn crank(&self) -> f64 {
        self.crank
    }

    /// Angle π − 2π/n (rad) of the crank's turn in which the wheel moves, half of it on each side of φ = 0.
    #[must_use]
    pub fn engagement(&self) -> f64 {
        PI - TAU / f64::from(self.slots)
    }

    /// Largest |ψ′|, m/(1 − m): speed of the wheel over that of the crank.
    #[must_use]
    pub fn largest_speed(&self) -> f64 {
        let m = self.crank / self.centres;
        m / (1.0 - m)
    }

    /// Largest |ψ″|: acceleration of the wheel over ω² at constant crank speed.
    #[must_use]
    pub fn largest_acceleration(&self) -> f64 {
        let m = self.crank / self.centres;
        let q = (1.0 + m * m) / (4.0 * m);
        let cos = math::sqrt(q * q + 2.0) - q;
        let sin = math::sqrt(1.0 - cos * cos);
        let square = 1.0 + m * m - 2.0 * m * cos;
        m * (1.0 - m * m) * sin / (square * square)
    }

    /// The turn of the crank, and whether the pin is engaged (`None`) or before or after the engagement (∓1).
    fn place(&self, phi: f64) -> (f64, Option<f64>) {
        let turn = math::floor(phi / TAU + 0.5);
        let angle = phi - turn * TAU;
        let dwell = (math::abs(angle) >= self.engagement() / 2.0).then(|| math::sign(angle));
        (turn, dwell)
    }

    /// Angle of the slot (rad) engaged in turn number `turn` of the crank, in the wheel's frame.
    fn slot(&self, turn: f64) -> f64 {
        let slots = f64::from(self.slots);
        let index = turn - slots * math::floor(turn / slots);
        TAU * index / slots
    }
}

impl Jointed for Geneva {
    /// O: ground and crank; C: ground and wheel; and the lock of the wheel: the pin in the engaged slot, or in the dwell the crank's locking arc,
    /// with a moment. The arc is concentric with O, so that it takes no moment from the crank. The pair of bearing forces belonging to the wheel's
    /// moment is omitted: it depends on where the arc touches within its play.
    fn joints(&self, phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        let (turn, dwell) = self.place(finite("crank angle", phi)?);
        let hold = if dwell.is_some() {
            Joint::Transmission([
                Wrench::moment(Body::Link(Self::CRANK), 0.0),
                Wrench::moment(Body::Link(Self::WHEEL), 1.0),
            ])
        } else {
            Joint::PinInSlot([
                Marker::on(Self::CRANK, [self.crank, 0.0]),
                Marker::on(Self::WHEEL, origin).with_angle(self.slot(turn)),
            ])
        };
        Ok(Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::CRANK, origin)]),
            Joint::Revolute([
                Marker::ground([self.centres, 0.0]),
                Marker::on(Self::WHEEL, origin),
            ]),
            hold,
        ]))
    }
}

impl Mechanism for Geneva {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    /// The places where the pin leaves the slot, and where it enters it.
    fn edge(&self, k: usize) -> Option<f64> {
        let half = self.engagement() / 2.0;
        [half, TAU - half].get(k).copied()
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let crank = Frame::turning([0.0, 0.0], angle);
        let (turn, dwell) = self.place(phi);
        let step = TAU / f64::from(self.slots);
        let delta = if let Some(side) = dwell {
            Transfer::constant(0.5 * side * step)
        } else {
            let [x, y] = crank.point([self.crank, 0.0]);
            let x = Transfer::constant(self.centres) - x;
            let distance = (x * x + y * y).sqrt();
            Transfer::angle(y.over(distance), x.over(distance))
        };
        let psi = Transfer::constant(PI - step * turn) - delta;
        let wheel = Frame::turning([self.centres, 0.0], psi);
        Ok(Frames::from_iter([crank, wheel]))
    }
}
