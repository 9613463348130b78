//! One rigid link: its mass and its motion.

use crate::math;
use crate::number::error::RangeError;
use crate::number::error::{finite, not_negative};
use crate::number::transfer::Transfer;

/// Mass, inertia and centre of mass of a rigid link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MassProperties {
    /// Mass (kg).
    pub mass: f64,
    /// Inertia about the centre of mass (kg·m²).
    pub inertia: f64,
    /// Centre of mass `[u, v]` in the link's frame (m): u along the link, v = u turned by +90°.
    pub com: [f64; 2],
}

/// A rigid link with checked mass properties.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    mass: f64,
    inertia: f64,
    com: [f64; 2],
}

impl Link {
    /// A link of negligible mass.
    pub const MASSLESS: Self = Self {
        mass: 0.0,
        inertia: 0.0,
        com: [0.0, 0.0],
    };

    /// A link with these mass properties.
    ///
    /// # Errors
    /// Mass or inertia negative, or a value not finite.
    pub fn new(properties: MassProperties) -> Result<Self, RangeError> {
        let MassProperties { mass, inertia, com } = properties;
        Ok(Self {
            mass: not_negative("mass", mass)?,
            inertia: not_negative("inertia", inertia)?,
            com: [
                finite("centre of mass u", com[0])?,
                finite("centre of mass v", com[1])?,
            ],
        })
    }

    /// A body that does not turn, with its mass (kg) at the origin of its frame: a slider, a load on a rope.
    ///
    /// # Errors
    /// Mass negative or not finite.
    pub fn point_mass(mass: f64) -> Result<Self, RangeError> {
        Self::new(MassProperties {
            mass,
            inertia: 0.0,
            com: [0.0, 0.0],
        })
    }

    /// A body that only turns about its own centre of mass: a wheel, a shaft, a flywheel.
    ///
    /// # Errors
    /// Inertia negative or not finite.
    pub fn rotor(inertia: f64) -> Result<Self, RangeError> {
        Self::new(MassProperties {
            mass: 0.0,
            inertia,
            com: [0.0, 0.0],
        })
    }

    /// Mass (kg).
    pub const fn mass(&self) -> f64 {
        self.mass
    }

    /// Inertia about the centre of mass (kg·m²).
    pub const fn inertia(&self) -> f64 {
        self.inertia
    }

    /// Centre of mass in the link's frame (m).
    pub const fn com(&self) -> [f64; 2] {
        self.com
    }

    /// Whether the centre of mass is the origin of the link's frame.
    #[must_use]
    pub fn is_centred(&self) -> bool {
        self.com.iter().all(|c| math::abs(*c) <= 0.0)
    }

    /// This link's share of the reduced inertia, the term m·(x′² + y′²) + J·ψ′² of (6.4), with its first and second derivative with respect to φ.
    #[must_use]
    pub fn reduced_inertia(&self, frame: &Frame) -> [f64; 3] {
        let [x, y] = frame.point(self.com);
        let mut sum = [0.0; 3];
        for (weight, f) in [(self.mass, x), (self.mass, y), (self.inertia, frame.psi)] {
            sum[0] += weight * f.d1 * f.d1;
            sum[1] += weight * 2.0 * f.d1 * f.d2;
            sum[2] += weight * 2.0 * (f.d2 * f.d2 + f.d1 * f.d3);
        }
        sum
    }

    /// Potential energy U = −m·g·r_c in the field `gravity` (m/s²) and its derivative with respect to φ, (3.8), (3.9).
    #[must_use]
    pub fn potential_energy(&self, frame: &Frame, gravity: [f64; 2]) -> [f64; 2] {
        let [x, y] = frame.point(self.com);
        [
            -self.mass * (gravity[0] * x.value + gravity[1] * y.value),
            -self.mass * (gravity[0] * x.d1 + gravity[1] * y.d1),
        ]
    }
}

/// The frame of a link as functions of φ: origin (x, y) and angle ψ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Origin of the frame, x (m).
    pub x: Transfer,
    /// Origin of the frame, y (m).
    pub y: Transfer,
    /// Angle of the frame's u axis from +x (rad).
    pub psi: Transfer,
    sin: Transfer,
    cos: Transfer,
}

impl Frame {
    /// The fixed frame: origin at [0, 0], axes along x and y.
    pub const GROUND: Self = Self::translating([Transfer::constant(0.0); 2]);

    /// A link that turns about the fixed point `pivot` by the angle `psi`.
    #[must_use]
    pub fn turning(pivot: [f64; 2], psi: Transfer) -> Self {
        Self::turned(pivot.map(Transfer::constant), psi)
    }

    /// A link that translates without rotation.
    #[must_use]
    pub const fn translating(origin: [Transfer; 2]) -> Self {
        Self {
            x: origin[0],
            y: origin[1],
            psi: Transfer::constant(0.0),
            sin: Transfer::constant(0.0),
            cos: Transfer::constant(1.0),
        }
    }

    /// A link in general plane motion, with its angle in radians.
    #[must_use]
    pub fn turned(origin: [Transfer; 2], psi: Transfer) -> Self {
        let (sin, cos) = psi.sin_cos();
        Self {
            x: origin[0],
            y: origin[1],
            psi,
            sin,
            cos,
        }
    }

    /// A link in general plane motion, with the sine and cosine of its angle.
    #[must_use]
    pub fn moving(origin: [Transfer; 2], sin: Transfer, cos: Transfer) -> Self {
        Self {
            x: origin[0],
            y: origin[1],
            psi: Transfer::angle(sin, cos),
            sin,
            cos,
        }
    }

    /// The same with whole turns added to ψ, so that it lies within half a turn of `near` (rad): sine and cosine leave the turns undetermined, and ψ
    /// must not jump while the link moves.
    #[must_use]
    pub fn unwrapped(mut self, near: f64) -> Self {
        use core::f64::consts::TAU;
        self.psi.value += math::floor((near - self.psi.value) / TAU + 0.5) * TAU;
        self
    }

    /// The same with ψ advanced by `turns` (rad), for a link that repeats its motion.
    #[must_use]
    pub(crate) fn advanced(mut self, turns: f64) -> Self {
        self.psi.value += turns;
        self
    }

    /// A point of the link, given in its frame as `[u, v]` (m), in global coordinates.
    #[inline]
    #[must_use]
    pub fn point(&self, at: [f64; 2]) -> [Transfer; 2] {
        let [x, y] = self.vector(at);
        [self.x + x, self.y + y]
    }

    /// A vector that turns with the link, given in its frame as `[u, v]`, in global components.
    #[inline]
    #[must_use]
    pub fn vector(&self, [u, v]: [f64; 2]) -> [Transfer; 2] {
        [self.cos * u - self.sin * v, self.sin * u + self.cos * v]
    }
}

/// Steps of a linkage's solver, which finds a link's coordinates order by order.
impl Frame {
    /// Sets the first derivative of coordinate 0 = x, 1 = y, 2 = ψ, with the others constant.
    pub(crate) fn seed(&mut self, axis: u8, d1: f64) {
        match axis {
            0 => self.x.d1 = d1,
            1 => self.y.d1 = d1,
            _ => {
                self.psi.d1 = d1;
                self.sin.d1 = self.cos.value * d1;
                self.cos.d1 = -self.sin.value * d1;
            }
        }
    }

    /// Sets the three derivatives of a coordinate.
    #[inline]
    pub(crate) fn differ(&mut self, axis: u8, [d1, d2, d3]: [f64; 3]) {
        let of = |value| Transfer { value, d1, d2, d3 };
        match axis {
            0 => self.x = of(self.x.value),
            1 => self.y = of(self.y.value),
            _ => {
                self.psi = of(self.psi.value);
                (self.sin, self.cos) = self.psi.with_sin_cos(self.sin.value, self.cos.value);
            }
        }
    }

    /// Sine and cosine of ψ.
    #[inline]
    pub(crate) const fn direction(&self) -> (Transfer, Transfer) {
        (self.sin, self.cos)
    }

    /// Moves a coordinate by `step`.
    pub(crate) fn shift(&mut self, axis: u8, step: f64) {
        match axis {
            0 => self.x.value += step,
            1 => self.y.value += step,
            _ => {
                self.psi.value += step;
                let (sin, cos) = math::sin_cos(self.psi.value);
                self.sin.value = sin;
                self.cos.value = cos;
            }
        }
    }

    /// Prepares for derivatives of this `order` (1 to 3) of a coordinate: sets the part of sine and cosine that depends on lower orders of ψ.
    #[inline]
    pub(crate) fn raise(&mut self, axis: u8, order: usize) {
        if axis != 2 {
            return;
        }
        let (s, c) = (self.sin.value, self.cos.value);
        let Transfer { d1, d2, .. } = self.psi;
        match order {
            1 => (self.sin.d1, self.cos.d1) = (0.0, 0.0),
            2 => (self.sin.d2, self.cos.d2) = (-s * d1 * d1, -c * d1 * d1),
            _ => {
                self.sin.d3 = -c * d1 * d1 * d1 - 3.0 * s * d1 * d2;
                self.cos.d3 = s * d1 * d1 * d1 - 3.0 * c * d1 * d2;
            }
        }
    }

    /// Sets the derivative of this `order` (1 to 3) of a coordinate, after [`raise`](Self::raise) for that order.
    #[inline]
    pub(crate) fn set(&mut self, axis: u8, order: usize, derivative: f64) {
        let of = |t: &mut Transfer, d: f64| match order {
            1 => t.d1 += d,
            2 => t.d2 += d,
            _ => t.d3 += d,
        };
        match axis {
            0 => of(&mut self.x, derivative),
            1 => of(&mut self.y, derivative),
            _ => {
                of(&mut self.psi, derivative);
                of(&mut self.sin, self.cos.value * derivative);
                of(&mut self.cos, -self.sin.value * derivative);
            }
        }
    }
}
