//! The drive of the drive train's input: a motor, with everything between it and the input.

use crate::model::characteristic::Characteristic;
use crate::number::numerics::sign;

/// The motor torque as a linear form in the five loads of an instant: see [`loads_of`].
///
/// ```text
/// T = (J_M + J_G)·i·α + τ₊/(i·η) + τ₋·η_back/i + b·i·n + c·sgn n
/// ```
///
/// α, n and τ are acceleration, speed and torque at the gearbox output; τ₊ is the torque where power flows to the machine
/// (and at rest), τ₋ where it flows back; J_M and J_G inertia of rotor and gearbox, i the ratio, η the efficiencies, b and c
/// viscous and Coulomb friction of motor and gearbox at the motor shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients(pub [f64; LOADS]);

/// Number of loads of an instant.
pub const LOADS: usize = 5;

/// The five loads of acceleration (rad/s²), torque (N·m) and speed (rad/s) at the gearbox output: α, τ₊, τ₋, n, sgn n.
#[inline]
pub fn loads_of(alpha: f64, torque: f64, speed: f64) -> [f64; LOADS] {
    let [driving, back] = if torque * speed < 0.0 {
        [0.0, torque]
    } else {
        [torque, 0.0]
    };
    [alpha, driving, back, speed, sign(speed)]
}

impl Coefficients {
    /// The coefficients of a rotor without gearbox (kg·m²).
    pub const fn rotor(inertia: f64) -> Self {
        Self([inertia, 1.0, 1.0, 0.0, 0.0])
    }

    /// The motor torque (N·m) under these loads.
    #[inline]
    pub fn torque(&self, loads: &[f64; LOADS]) -> f64 {
        let [a, b, c, d, e] = self.0;
        let [alpha, driving, back, speed, sign] = loads;
        a * alpha + (b * driving + c * back) + (d * speed + e * sign)
    }
}

/// A motor with or without a gearbox, in front of the drive train.
pub trait Motor {
    /// Its torque by the loads at the input of the drive train.
    fn coefficients(&self) -> Coefficients;

    /// Speed of the motor per speed of that input, positive.
    fn ratio(&self) -> f64;

    /// The torque (N·m) without a controller at a motor speed (rad/s), continuous in the speed.
    fn torque(&self, speed: f64) -> f64;

    /// Least and largest torque that a controller can command at a speed, continuous in the speed.
    fn limits(&self, speed: f64) -> [f64; 2];

    /// Motor speeds at which its torque or its limits have a corner, other than 0.
    fn bends(&self) -> Vec<f64>;
}

impl<M: Motor + ?Sized> Motor for &M {
    fn coefficients(&self) -> Coefficients {
        (**self).coefficients()
    }
    fn ratio(&self) -> f64 {
        (**self).ratio()
    }
    fn torque(&self, speed: f64) -> f64 {
        (**self).torque(speed)
    }
    fn limits(&self, speed: f64) -> [f64; 2] {
        (**self).limits(speed)
    }
    fn bends(&self) -> Vec<f64> {
        (**self).bends()
    }
}

/// The motor of a machine file: a characteristic and a rotor.
#[derive(Clone, Copy, Debug)]
pub struct OwnMotor<'a> {
    /// Torque over speed.
    pub characteristic: &'a Characteristic,
    /// Inertia of the rotor (kg·m²).
    pub rotor_inertia: f64,
}

impl Motor for OwnMotor<'_> {
    fn coefficients(&self) -> Coefficients {
        Coefficients::rotor(self.rotor_inertia)
    }

    fn ratio(&self) -> f64 {
        1.0
    }

    fn torque(&self, speed: f64) -> f64 {
        self.characteristic.torque(speed)
    }

    fn limits(&self, speed: f64) -> [f64; 2] {
        let most = self.characteristic.torque(speed.abs()).max(0.0);
        [-most, most]
    }

    fn bends(&self) -> Vec<f64> {
        // The limits are equal in both directions.
        let own = self.characteristic.bends().into_iter();
        own.filter(|speed| *speed != 0.0)
            .flat_map(|speed| [speed, -speed])
            .collect()
    }
}
