//! The suitable gear ratio for a motor and a duty, in closed form.
//!
//! With a gearbox of ratio i in front of the load the motor torque of an instant is
//!
//! ```text
//! T = i·A + B/i + C,   A = J·a + b·n,   B = τ₊/η + τ₋·η_back,   C = c·sgn n
//! ```
//!
//! a, n and τ: acceleration, speed and torque at the gearbox output (τ does not depend on i, even if the inertia varies over the cycle); J: inertia
//! of rotor, brake and gearbox input; b and c: viscous and Coulomb friction of the motor. So the mean square is
//!
//! ```text
//! T_rms²(i) = ⟨A²⟩·i² + 2⟨AC⟩·i + 2⟨AB⟩ + ⟨C²⟩ + 2⟨BC⟩/i + ⟨B²⟩/i²
//! ```
//!
//! Without Coulomb friction it is smallest at i* = √(B_rms/A_rms). There T_rms² = J·β with the load factor β = 2(A_rms·B_rms + ⟨A·B⟩)/J. For b = 0
//! and η = η_back = 1, i* is √(τ_rms/(J·a_rms)) and β is 2(a_rms·τ_rms + ⟨a·τ⟩), which does not depend on the motor. A motor of rated torque T_N can do the duty with some ratio if its accelerating factor T_N²/J is not below β. These ratios
//! follow from the biquadratic ⟨A²⟩·i⁴ + (2⟨AB⟩ − T_N²)·i² + ⟨B²⟩ = 0 (Giberti, Cinquemani, Legnani: Effects of transmission mechanical
//! characteristics on the choice of a motor-reducer, Mechatronics 20, 2010). With Coulomb friction i* and the ends of the range are found
//! numerically, and β is T_rms²(i*)/J.

pub mod obstacle;
pub mod ranges;

use crate::catalogue::Motor;
use crate::cycle::form::loads;
use jred_analysis::duty::Duty;
use jred_file::number::numerics::edge;

/// Properties of the gearbox other than its ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// Inertia at its input (kg·m²).
    pub inertia: f64,
    /// Efficiency, in both directions of power.
    pub efficiency: f64,
}

impl Gear {
    /// A gearbox without inertia and losses.
    pub const IDEAL: Self = Self {
        inertia: 0.0,
        efficiency: 1.0,
    };
}

/// The moments of a duty with a motor: T_rms²(i) as numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// J (kg·m²).
    pub inertia: f64,
    /// ⟨A²⟩, ⟨AC⟩, ⟨AB⟩, ⟨C²⟩, ⟨BC⟩, ⟨B²⟩.
    aa: f64,
    ac: f64,
    ab: f64,
    cc: f64,
    bc: f64,
    bb: f64,
}

/// Range of ratios that satisfies a rule.
pub type Range = [f64; 2];

impl Moments {
    /// The moments of a duty with a motor and a gear.
    pub fn new(duty: &Duty, motor: &Motor, gear: Gear) -> Self {
        let inertia = motor.rotor_with_brake() + gear.inertia;
        let [coulomb, viscous] = motor.friction;
        let mut sums = [0.0; 6];
        for instant in &duty.instants {
            let [alpha, driving, back, speed, sign] = loads(instant);
            let a = inertia * alpha + viscous * speed;
            let b = driving / gear.efficiency + back * gear.efficiency;
            let c = coulomb * sign;
            for (sum, product) in sums
                .iter_mut()
                .zip([a * a, a * c, a * b, c * c, b * c, b * b])
            {
                *sum += instant.weight * product;
            }
        }
        let [aa, ac, ab, cc, bc, bb] = sums.map(|sum| sum / duty.duration);
        Self {
            inertia,
            aa,
            ac,
            ab,
            cc,
            bc,
            bb,
        }
    }

    /// T_rms² (N²·m²) with a ratio.
    pub fn mean_square(&self, ratio: f64) -> f64 {
        let square = ratio * ratio;
        self.aa * square
            + 2.0 * self.ac * ratio
            + 2.0 * self.ab
            + self.cc
            + 2.0 * self.bc / ratio
            + self.bb / square
    }

    /// RMS torque of the motor (N·m) with a ratio.
    pub fn rms_torque(&self, ratio: f64) -> f64 {
        self.mean_square(ratio).max(0.0).sqrt()
    }

    /// The ratio i* with the smallest RMS torque. `None` if there is no minimum: a larger ratio is always better (nothing accelerates), or a smaller
    /// one (nothing loads the output).
    pub fn best_ratio(&self) -> Option<f64> {
        if self.aa <= 0.0 || self.bb <= 0.0 {
            return None;
        }
        let frictionless = (self.bb / self.aa).sqrt().sqrt();
        if self.cc == 0.0 {
            return Some(frictionless);
        }
        // i³/2 times the derivative of T_rms²: below zero at 0, above at infinity.
        let rises =
            |i: f64| self.aa * i.powi(4) + self.ac * i.powi(3) - self.bc * i - self.bb > 0.0;
        let (mut low, mut high) = (frictionless, frictionless);
        while rises(low) {
            low *= 0.5;
        }
        while !rises(high) {
            high *= 2.0;
        }
        let found: Result<f64, std::convert::Infallible> = edge(|i| Ok(!rises(i)), low, high);
        found.ok()
    }

    /// The load factor β (W/s): the least accelerating factor of a suitable motor, for any ratio.
    pub fn load_factor(&self) -> Option<f64> {
        self.best_ratio()
            .map(|ratio| self.mean_square(ratio) / self.inertia)
    }

    /// The ratios around i* with which the RMS torque is at most `torque` (N·m); `None` if there are no such ratios. Without i* the range extends to
    /// infinity or to zero.
    pub fn range(&self, torque: f64) -> Option<Range> {
        let Some(best) = self.best_ratio() else {
            return self.open_range(torque);
        };
        if self.mean_square(best) > torque * torque {
            return None;
        }
        if self.cc == 0.0 {
            let half = 0.5 * torque * torque - self.ab;
            let root = (half * half - self.aa * self.bb).max(0.0).sqrt();
            // The product of the two squares is ⟨B²⟩/⟨A²⟩: no difference of nearly equal numbers.
            let larger = (half + root) / self.aa;
            return Some([(self.bb / self.aa / larger).sqrt(), larger.sqrt()]);
        }
        let holds = |i: f64| self.mean_square(i) <= torque * torque;
        let end = |factor: f64| {
            let mut beyond = best;
            while holds(beyond) {
                beyond *= factor;
            }
            let found: Result<f64, std::convert::Infallible> =
                edge(|i| Ok(holds(i)), beyond / factor, beyond);
            found.ok()
        };
        Some([end(0.5)?, end(2.0)?])
    }

    /// The range if nothing accelerates, ⟨C²⟩ + 2⟨BC⟩/i + ⟨B²⟩/i² ≤ T², or nothing loads the output, ⟨A²⟩·i² + 2⟨AC⟩·i + ⟨C²⟩ ≤ T².
    fn open_range(&self, torque: f64) -> Option<Range> {
        let left = torque * torque - self.cc;
        if left <= 0.0 {
            return None;
        }
        // The larger root x of square·x² + 2·half·x = left, which may be infinite.
        let most = |square: f64, half: f64| left / (half + (half * half + square * left).sqrt());
        Some(if self.aa <= 0.0 {
            [1.0 / most(self.bb, self.bc), f64::INFINITY]
        } else {
            [0.0, most(self.aa, self.ac)]
        })
    }
}

/// T_N²/J (W/s): the power that a motor can put into its own acceleration, per second.
pub fn accelerating_factor(torque: f64, inertia: f64) -> f64 {
    torque * torque / inertia
}
