//! Characteristic values of motion laws: C_v, C_a, C_j, C_Mdyn (VDI 2143 Blatt 1).

use super::law::Law;
use super::sine_constant_cosine as scca;
use crate::math::Real;

/// The characteristic values of a motion law: a rise h in the time T has at most the speed C_v·h/T, the acceleration C_a·h/T² and the jerk C_j·h/T³.
/// Moving an inertia J takes at most the power C_Mdyn·J·h²/T³.
///
/// | law | C_v | C_a | C_j | C_Mdyn |
/// |---|---|---|---|---|
/// | quadratic parabola: trapezoid of halves | 2 | 4 | ∞ | 8 |
/// | simple sine | π/2 = 1.571 | π²/2 = 4.935 | ∞ | π³/8 = 3.876 |
/// | cycloidal (Bestehorn) | 2 | 2π = 6.283 | 4π² = 39.48 | 3√3·π/2 = 8.162 |
/// | modified sine | 1.760 | 5.528 | 69.47 | 5.458 |
/// | modified trapezoid | 2 | 4.888 | 61.43 | 8.090 |
/// | Gutman | 2 | 5.130 | 6π² = 59.22 | 8.125 |
/// | 3-4-5 polynomial | 1.875 | 5.774 | 60 | 6.694 |
/// | 4-5-6-7 polynomial | 2.188 | 7.513 | 52.5 | 10.75 |
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Characteristic {
    /// C_v
    pub velocity: f64,
    /// C_a
    pub acceleration: f64,
    /// C_j; `None` where the acceleration jumps.
    pub jerk: Option<f64>,
    /// C_Mdyn, the largest product S′·S″.
    pub dynamic_torque: f64,
}

impl<R: Real> Law<R> {
    /// C_v, C_a, C_j, C_Mdyn in closed form. The test `coefficients_of_vdi_2143` compares them with the law's own extremes.
    #[must_use]
    pub fn characteristic(self) -> Characteristic {
        use core::f64::consts::PI;
        let (velocity, acceleration, jerk, dynamic_torque) = match self {
            Self::Trapezoid {
                accelerate,
                decelerate,
            } => {
                let (a, d) = (accelerate.to_f64(), decelerate.to_f64());
                let speed = 1.0 / (1.0 - f64::midpoint(a, d));
                let most = speed / a.min(d);
                (speed, most, None, speed * most)
            }
            // 10/√3; 1800·w³·√(1 − 4w) at w = z·(1 − z) = 3/14.
            Self::Polynomial345 => (
                1.875,
                5.773_502_691_896_258,
                Some(60.0),
                6.694_268_727_495_788,
            ),
            // sin·(1 − cos) is largest, 3√3/4, at a third of a turn.
            Self::Cycloidal => (
                2.0,
                2.0 * PI,
                Some(4.0 * PI * PI),
                1.5 * PI * 1.732_050_807_568_877_2,
            ),
            // sin θ·(1 − 3·cos θ) is largest at cos θ = (1 − √73)/12.
            Self::ModifiedSine => {
                let share = 4.0 * PI / (4.0 + PI);
                let most = PI * share;
                let product = share * most / 4.0 * 2.244_369_709_690_986;
                (share, most, Some(4.0 * PI * most), product)
            }
            Self::SimpleSine => (PI / 2.0, PI * PI / 2.0, None, PI * PI * PI / 8.0),
            // 84/(5·√5); 58800·w⁵·√(1 − 4w) at w = 5/22.
            Self::Polynomial4567 => (
                2.1875,
                7.513_188_404_399_293,
                Some(52.5),
                10.750_226_164_702_64,
            ),
            // (1 + π + s)·√(1 − s²) is largest at 2s² + (1 + π)·s = 1.
            Self::ModifiedTrapezoid => {
                let share = 8.0 * PI / (2.0 + PI);
                let product = share * share / (4.0 * PI) * 4.254_739_528_362_83;
                (2.0, share, Some(4.0 * PI * share), product)
            }
            // (3π/2)·(1 − (3c + c³)/4)·(1 + c²)·√(1 − c²) is largest at c = cos 2πz = −0.743013….
            Self::Gutman => (
                2.0,
                2.0 * PI * 0.816_496_580_927_726,
                Some(6.0 * PI * PI),
                8.124_857_839_101_943,
            ),
            Self::SineConstantCosine {
                sine,
                constant,
                cosine,
            } => return scca::characteristic([sine, constant, cosine].map(Real::to_f64)),
        };
        Characteristic {
            velocity,
            acceleration,
            jerk,
            dynamic_torque,
        }
    }
}
