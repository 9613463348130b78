//! The sign of Coulomb friction.

use super::Number;

/// The factor of c in the torque: the sign of a speed, or a share of it. Viscous friction always opposes ω itself.
///
/// At standstill friction balances the other forces, up to c in both directions, which a tick does not know: sgn 0 = 0. A *measured* speed changes
/// its sign there with every count, and ±c with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrictionSign<N: Number> {
    /// All of c, with the sign of this speed: of the motion itself, or of its set-point, which does not chatter. Only 0 has no sign, however small
    /// a speed is (test `every_speed_but_zero_has_a_sign`).
    OfSpeed(N::Speed),
    /// This share of c, −1 to 1: a ramp over a width of speed.
    Scaled(N),
}
