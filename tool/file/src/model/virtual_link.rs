//! Tabulated curves as virtual links of a mechanism.
//!
//! A curve in a machine file over the position of the drive link is represented by a *virtual link* ([`VirtualLink`]): a rotor on its own bearing, geared
//! to the drive link with a ratio ψ′(φ) that follows from the curve. The method of reduction then reproduces the curve, with consistent derivatives,
//! and d'Alembert's principle gives the same torque through the gearing:
//!
//! ```text
//! inertia J(φ)            rotor of 1 kg·m²                ψ′ = √J        J_red = ψ′², J_red′ = 2·ψ′·ψ″
//! torque T(φ)             1 N·m on a rotor without mass   ψ′ = T         T·ω = 1 N·m·ψ̇
//! weight, −U′(φ)          spring of 1 N·m/rad             ψ = √(2·U)     U = ½·ψ²
//! opposing torque c(φ)    1 N·m against the rotor         ψ′ = c
//! viscous b(φ)            1 N·m·s/rad on the rotor        ψ′ = √b
//! payload m(φ) on a link  two rotors of 1 kg·m²           ψ′ = √m·x′, √m·y′
//! its weight              1 N·m                           ψ′ = m·(g_x·x′ + g_y·y′)
//! force F against it      1 N·m against the rotor         ψ′ = F·|r′|
//! force F along e         1 N·m                           ψ′ = F·(e_x·x′ + e_y·y′)
//! moment M on a link      1 N·m                           ψ′ = M·ψ_link′
//! ```
//!
//! A curve that acts on a link is geared to that link instead: by its own force at its own point, so that the joints carry it.
//!
//! ψ itself is only computed where a spring needs it; elsewhere nothing depends on it and it stays zero.

mod mechanism;
mod table;

pub(crate) use mechanism::{CurveMechanism, DriveLinkAlone};
pub use table::{LoadTable, TableVariable};

use crate::math;
use jred::error::Error;
use jred::machine::{Action, Body, Element, Frame, Load, Marker, Window, Wrench};
use jred::number::Transfer;

use crate::number::spline::Spline;

/// Kind of curve that a virtual link represents.
#[derive(Clone, Debug)]
pub enum LinkCurve {
    /// A reduced inertia (kg·m², or kg of a sliding drive link).
    Inertia(Spline),
    /// A torque (N·m, or N) in the direction of growing φ.
    Torque(Spline),
    /// A torque from a potential, −U′; its integral over a turn is zero. See [`LinkCurve::potential`].
    Potential {
        /// The torque.
        torque: Spline,
        /// Offset added to −∫T, so that the energy is never close to zero.
        offset: f64,
    },
    /// A torque against the motion, not negative.
    Opposing(Spline),
    /// A viscous coefficient b (N·m·s/rad, or N·s/m), not negative.
    Viscous(Spline),
    /// A mass (kg) at a point of a link: its motion along x or y.
    Payload {
        /// Mass.
        mass: Spline,
        /// Its point.
        on: LinkPoint,
        /// 0: along x, 1: along y.
        axis: usize,
    },
    /// The weight of that mass.
    Weight {
        /// Mass.
        mass: Spline,
        /// Its point.
        on: LinkPoint,
        /// Gravity (m/s²).
        gravity: [f64; 2],
    },
    /// A force (N) against the motion of a point, not negative.
    Thrust {
        /// Force.
        force: LoadTable,
        /// Its point.
        on: LinkPoint,
    },
    /// A force (N) on a point.
    Force {
        /// Force.
        force: LoadTable,
        /// Its point.
        on: LinkPoint,
        /// Its direction.
        along: Direction,
    },
    /// A moment (N·m) on link number `link`.
    Moment {
        /// Moment.
        moment: LoadTable,
        /// Index of the link.
        link: usize,
    },
}

/// A point of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkPoint {
    /// Index of the link.
    pub link: usize,
    /// The point in its frame (m).
    pub at: [f64; 2],
}

impl LinkPoint {
    fn position(self, frames: &[Frame]) -> [Transfer; 2] {
        frames
            .get(self.link)
            .unwrap_or(&Frame::GROUND)
            .point(self.at)
    }
}

/// The direction of a force, as a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// In the coordinates of the mechanism.
    Fixed([f64; 2]),
    /// In the link's frame: it rotates with the link.
    OnLink([f64; 2]),
}

impl Direction {
    fn vector(self, link: usize, frames: &[Frame]) -> [Transfer; 2] {
        match self {
            Self::Fixed(vector) => vector.map(Transfer::constant),
            Self::OnLink(vector) => frames.get(link).unwrap_or(&Frame::GROUND).vector(vector),
        }
    }
}

/// A virtual link.
#[derive(Clone, Debug)]
pub struct VirtualLink {
    /// Its name in tables.
    pub name: String,
    /// The curve it represents.
    pub course: LinkCurve,
    /// The part of the range in which a load acts, if not the whole.
    pub window: Option<Window>,
    /// The drive link's positions at which the curve is not smooth.
    pub edges: Vec<f64>,
}

impl VirtualLink {
    /// A virtual link that acts everywhere and is smooth.
    pub const fn new(name: String, course: LinkCurve) -> Self {
        Self {
            name,
            course,
            window: None,
            edges: Vec::new(),
        }
    }
}

/// √f with its first two derivatives; zero with level derivatives where f is zero.
fn root([value, d1, d2, _]: [f64; 4]) -> [f64; 3] {
    if value <= 0.0 {
        return [0.0; 3];
    }
    let f = Transfer {
        value,
        d1,
        d2,
        d3: 0.0,
    }
    .sqrt();
    [f.value, f.d1, f.d2]
}

/// ψ from ψ′ with its derivatives.
const fn from_rate([d1, d2, d3]: [f64; 3]) -> Transfer {
    Transfer {
        value: 0.0,
        d1,
        d2,
        d3,
    }
}

/// f·g with two derivatives.
fn product(f: [f64; 3], g: [f64; 3]) -> [f64; 3] {
    [
        f[0] * g[0],
        f[1] * g[0] + f[0] * g[1],
        f[2] * g[0] + 2.0 * f[1] * g[1] + f[0] * g[2],
    ]
}

/// x′ with two derivatives.
const fn rate(x: Transfer) -> [f64; 3] {
    [x.d1, x.d2, x.d3]
}

const fn three([a, b, c, _]: [f64; 4]) -> [f64; 3] {
    [a, b, c]
}

/// f with two derivatives.
const fn values(f: Transfer) -> [f64; 3] {
    [f.value, f.d1, f.d2]
}

impl LinkCurve {
    /// The torque of a potential, with an offset larger than its possible fall: a constant in U has no effect.
    pub fn potential(torque: Spline) -> Self {
        let [from, to] = torque.range();
        let offset = 2.0 * (to - from) * torque.largest() + 1e-9;
        Self::Potential { torque, offset }
    }

    /// ψ of the rotor at `phi`, with the mechanism's own links at `frames`.
    fn psi(&self, phi: f64, frames: &[Frame]) -> Transfer {
        match self {
            Self::Inertia(curve) | Self::Viscous(curve) => from_rate(root(curve.at(phi))),
            Self::Torque(curve) | Self::Opposing(curve) => from_rate(three(curve.at(phi))),
            Self::Potential { torque, offset } => {
                let [value, d1, d2, _] = torque.at(phi);
                let energy = Transfer {
                    value: offset - torque.integral(phi),
                    d1: -value,
                    d2: -d1,
                    d3: -d2,
                };
                (energy * 2.0).sqrt()
            }
            Self::Payload { mass, on, axis } => {
                let along = on.position(frames)[*axis % 2];
                from_rate(product(root(mass.at(phi)), rate(along)))
            }
            Self::Weight { mass, on, gravity } => {
                let [x, y] = on.position(frames);
                let fall = x * gravity[0] + y * gravity[1];
                from_rate(product(three(mass.at(phi)), rate(fall)))
            }
            Self::Thrust { force, on } => {
                let [x, y] = on.position(frames).map(rate);
                let speed = math::hypot(x[0], y[0]);
                // The magnitude has a bend where the point is at rest; no mass needs its slope there.
                let bend = if speed > 0.0 {
                    (x[0] * x[1] + y[0] * y[1]) / speed
                } else {
                    0.0
                };
                let force = force.at(phi, frames);
                from_rate(product(values(force), [speed, bend, 0.0]))
            }
            Self::Force { force, on, along } => {
                let force = values(force.at(phi, frames));
                let [x, y] = on.position(frames);
                let [e_x, e_y] = along.vector(on.link, frames).map(values);
                let [along_x, along_y] = [product(e_x, rate(x)), product(e_y, rate(y))];
                let way = [0, 1, 2].map(|k| along_x[k] + along_y[k]);
                from_rate(product(force, way))
            }
            Self::Moment { moment, link } => {
                let turn = frames.get(*link).map_or([0.0; 3], |frame| rate(frame.psi));
                from_rate(product(values(moment.at(phi, frames)), turn))
            }
        }
    }

    /// The gearing wrench for one unit of effort of the rotor, whose frame is `rotor`. It acts on the point or link of the curve, otherwise it is the
    /// `drive`'s unit effort times −ψ′. With 1 N·m on the rotor it does no work.
    fn gearing(&self, phi: f64, frames: &[Frame], rotor: &Frame, drive: Wrench) -> Wrench {
        let force = |on: &LinkPoint, force: [f64; 2]| {
            let point = on.position(frames).map(|c| c.value);
            Wrench::force(Body::Link(on.link), point, force).times(-1.0)
        };
        match self {
            Self::Inertia(_)
            | Self::Torque(_)
            | Self::Potential { .. }
            | Self::Opposing(_)
            | Self::Viscous(_) => drive.times(-rotor.psi.d1),
            Self::Payload { mass, on, axis } => {
                let [root, ..] = root(mass.at(phi));
                force(on, if *axis == 0 { [root, 0.0] } else { [0.0, root] })
            }
            Self::Weight { mass, on, gravity } => {
                let [mass, ..] = mass.at(phi);
                force(on, gravity.map(|g| mass * g))
            }
            Self::Thrust { force: size, on } => {
                let velocity = on.position(frames).map(|c| c.d1);
                let speed = math::hypot(velocity[0], velocity[1]);
                let share = if speed > 0.0 {
                    size.at(phi, frames).value / speed
                } else {
                    0.0
                };
                force(on, velocity.map(|v| share * v))
            }
            Self::Force {
                force: size,
                on,
                along,
            } => {
                let size = size.at(phi, frames).value;
                force(on, along.vector(on.link, frames).map(|e| size * e.value))
            }
            Self::Moment { moment, link } => {
                Wrench::moment(Body::Link(*link), -moment.at(phi, frames).value)
            }
        }
    }

    /// Whether it is a mass or an inertia, or the weight of a mass.
    pub(crate) const fn is_payload(&self) -> bool {
        matches!(
            self,
            Self::Inertia(_) | Self::Payload { .. } | Self::Weight { .. }
        )
    }

    /// Inertia of the rotor (kg·m²).
    const fn inertia(&self) -> f64 {
        match self {
            Self::Inertia(_) | Self::Payload { .. } => 1.0,
            _ => 0.0,
        }
    }

    /// The load on the rotor, link number `link`.
    ///
    /// # Errors
    /// Never: the loads are constants.
    pub(crate) fn load(&self, link: usize) -> Result<Option<Load>, Error> {
        let action = match self {
            Self::Torque(_) | Self::Weight { .. } | Self::Force { .. } | Self::Moment { .. } => {
                Action::Moment(1.0)
            }
            Self::Opposing(_) | Self::Thrust { .. } => Action::OpposingMoment(1.0),
            Self::Viscous(_) => Action::ViscousMoment(1.0),
            Self::Inertia(_) | Self::Potential { .. } | Self::Payload { .. } => return Ok(None),
        };
        Ok(Some(Load::new(link, action)?))
    }

    /// The spring on the rotor, link number `link`.
    ///
    /// # Errors
    /// Never: the spring is a constant.
    pub(crate) fn spring(&self, link: usize) -> Result<Option<Element>, Error> {
        let Self::Potential { .. } = self else {
            return Ok(None);
        };
        let ends = [Marker::ground([0.0, 0.0]), Marker::on(link, [0.0, 0.0])];
        Ok(Some(Element::torsion_spring(ends, 1.0, 0.0)?))
    }
}
