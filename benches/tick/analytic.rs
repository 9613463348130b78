//! Without a table: the slider-crank in closed form in every tick, with sine, cosine and root of two usual crates.
//!
//! ```text
//! x = r·cos φ + l·√(1 − λ²·sin²φ)    J = J₀ + m·x′²    ½·J′ = m·x′·x″
//! ```
//!
//! The data: r, λ, m, J₀, m·g, b, c.
#![allow(clippy::disallowed_methods, reason = "libm itself is what is measured")]

use core::hint::black_box;

use micromath::F32Ext;

use crate::target::{Kernel, Point, each};

/// The machine's dimensions (SI).
#[repr(C)]
struct Machine {
    radius: f32,
    ratio: f32,
    mass: f32,
    rotating: f32,
    weight: f32,
    viscous: f32,
    coulomb: f32,
}

impl Machine {
    fn new(data: &[u32]) -> Self {
        let [radius, ratio, mass, rotating, weight, viscous, coulomb] = <[u32; 7]>::try_from(data)
            .expect("seven numbers")
            .map(f32::from_bits);
        Self {
            radius,
            ratio,
            mass,
            rotating,
            weight,
            viscous,
            coulomb,
        }
    }

    /// x′ and x″, given the sine and cosine of the crank angle.
    #[inline]
    fn transfer(&self, [sin, cos]: [f32; 2], sqrt: fn(f32) -> f32) -> [f32; 2] {
        let [s, c] = [self.ratio * sin, self.ratio * cos];
        // One division, by the root; (l/r)·(√(1 − s²))′ = −s·cos φ/√(1 − s²).
        let inverse = 1.0 / sqrt(1.0 - s * s);
        let tilt = s * inverse;
        let first = -(sin + tilt * cos);
        let second = -(cos + (c * cos - s * sin + tilt * tilt * c * cos) * inverse);
        [self.radius * first, self.radius * second]
    }

    #[inline]
    fn torque(&self, [first, second]: [f32; 2], omega: f32, alpha: f32) -> f32 {
        let friction = if omega > 0.0 {
            self.coulomb
        } else if omega < 0.0 {
            -self.coulomb
        } else {
            0.0
        };
        (self.rotating + self.mass * first * first) * alpha
            + self.mass * first * second * omega * omega
            + self.weight * first
            + self.viscous * omega
            + friction
    }

    #[inline]
    fn acceleration(&self, [first, second]: [f32; 2], omega: f32, torque: f32) -> f32 {
        (torque - self.mass * first * second * omega * omega)
            / (self.rotating + self.mass * first * first)
    }
}

#[inline]
fn libm_sin_cos(phi: f32) -> [f32; 2] {
    [libm::sinf(phi), libm::cosf(phi)]
}

#[inline]
fn micromath_sin_cos(phi: f32) -> [f32; 2] {
    [F32Ext::sin(phi), F32Ext::cos(phi)]
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn analytic_libm_torque(machine: &Machine, phi: f32, omega: f32, alpha: f32) -> f32 {
    let transfer = machine.transfer(libm_sin_cos(phi), libm::sqrtf);
    machine.torque(transfer, omega, alpha)
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn analytic_libm_acceleration(
    machine: &Machine,
    phi: f32,
    omega: f32,
    torque: f32,
) -> f32 {
    let transfer = machine.transfer(libm_sin_cos(phi), libm::sqrtf);
    machine.acceleration(transfer, omega, torque)
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn analytic_micromath_torque(
    machine: &Machine,
    phi: f32,
    omega: f32,
    alpha: f32,
) -> f32 {
    let transfer = machine.transfer(micromath_sin_cos(phi), F32Ext::sqrt);
    machine.torque(transfer, omega, alpha)
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn analytic_micromath_acceleration(
    machine: &Machine,
    phi: f32,
    omega: f32,
    torque: f32,
) -> f32 {
    let transfer = machine.transfer(micromath_sin_cos(phi), F32Ext::sqrt);
    machine.acceleration(transfer, omega, torque)
}

fn over(data: &[u32], points: &mut [Point], kernel: fn(&Machine, f32, f32, f32) -> f32) {
    let kernel = black_box(kernel);
    let machine = Machine::new(data);
    each(points, |p| {
        let [phi, omega, third] = p.map(f32::from_bits);
        kernel(&machine, phi, omega, third).to_bits()
    });
}

pub(crate) const KERNELS: &[Kernel] = &[
    ("analytic_libm_torque", |d, p| {
        over(d, p, analytic_libm_torque);
    }),
    ("analytic_libm_acceleration", |d, p| {
        over(d, p, analytic_libm_acceleration);
    }),
    ("analytic_micromath_torque", |d, p| {
        over(d, p, analytic_micromath_torque);
    }),
    ("analytic_micromath_acceleration", |d, p| {
        over(d, p, analytic_micromath_acceleration);
    }),
];
