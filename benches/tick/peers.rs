//! CMSIS-DSP and hand-written C, from the object that `cargo xtask perf --peers` compiles of `xtask/peers/kernels.c`.

use core::ffi::c_void;
use core::hint::black_box;

use crate::target::{Kernel, Point, each};

type Float = unsafe extern "C" fn(*const c_void, f32, f32, f32) -> f32;
type Fixed = unsafe extern "C" fn(*const c_void, u32, i32, i32) -> i32;
/// Creates a machine from the data, in its own memory.
type Build = unsafe extern "C" fn(*const u32) -> *const c_void;

unsafe extern "C" {
    fn peer_tables_f32(data: *const u32) -> *const c_void;
    fn peer_linear_f32(data: *const u32) -> *const c_void;
    fn peer_linear_q31(data: *const u32) -> *const c_void;
    fn peer_linear_q15(data: *const u32) -> *const c_void;
    fn peer_dimensions(data: *const u32) -> *const c_void;
    fn hand_c_f32_torque(machine: *const c_void, phi: f32, omega: f32, alpha: f32) -> f32;
    fn hand_c_f32_acceleration(machine: *const c_void, phi: f32, omega: f32, torque: f32) -> f32;
    fn cmsis_f32_torque(machine: *const c_void, phi: f32, omega: f32, alpha: f32) -> f32;
    fn cmsis_f32_acceleration(machine: *const c_void, phi: f32, omega: f32, torque: f32) -> f32;
    fn cmsis_analytic_torque(machine: *const c_void, phi: f32, omega: f32, alpha: f32) -> f32;
    fn cmsis_analytic_acceleration(
        machine: *const c_void,
        phi: f32,
        omega: f32,
        torque: f32,
    ) -> f32;
    fn cmsis_q31_torque(machine: *const c_void, phase: u32, omega: i32, alpha: i32) -> i32;
    fn cmsis_q31_acceleration(machine: *const c_void, phase: u32, omega: i32, torque: i32) -> i32;
    fn cmsis_q15_torque(machine: *const c_void, phase: u32, omega: i32, alpha: i32) -> i32;
    fn cmsis_q15_acceleration(machine: *const c_void, phase: u32, omega: i32, torque: i32) -> i32;
}

fn float(build: Build, data: &[u32], points: &mut [Point], kernel: Float) {
    let kernel = black_box(kernel);
    // SAFETY: the host prepared the data for this kernel, and the machine is never freed.
    let machine = unsafe { build(data.as_ptr()) };
    each(points, |p| {
        let [phi, omega, third] = p.map(f32::from_bits);
        // SAFETY: as above.
        unsafe { kernel(machine, phi, omega, third) }.to_bits()
    });
}

fn fixed(build: Build, data: &[u32], points: &mut [Point], kernel: Fixed) {
    let kernel = black_box(kernel);
    // SAFETY: the host prepared the data for this kernel, and the machine is never freed.
    let machine = unsafe { build(data.as_ptr()) };
    each(points, |[phase, omega, third]| {
        let [omega, third] = [omega, third].map(u32::cast_signed);
        // SAFETY: as above.
        unsafe { kernel(machine, phase, omega, third) }.cast_unsigned()
    });
}

#[rustfmt::skip]
pub(crate) const KERNELS: &[Kernel] = &[
    ("hand_c_f32_torque", |d, p| float(peer_tables_f32, d, p, hand_c_f32_torque)),
    ("hand_c_f32_acceleration", |d, p| float(peer_tables_f32, d, p, hand_c_f32_acceleration)),
    ("cmsis_f32_torque", |d, p| float(peer_linear_f32, d, p, cmsis_f32_torque)),
    ("cmsis_f32_acceleration", |d, p| float(peer_linear_f32, d, p, cmsis_f32_acceleration)),
    ("cmsis_analytic_torque", |d, p| float(peer_dimensions, d, p, cmsis_analytic_torque)),
    ("cmsis_analytic_acceleration", |d, p| float(peer_dimensions, d, p, cmsis_analytic_acceleration)),
    ("cmsis_q31_torque", |d, p| fixed(peer_linear_q31, d, p, cmsis_q31_torque)),
    ("cmsis_q31_acceleration", |d, p| fixed(peer_linear_q31, d, p, cmsis_q31_acceleration)),
    ("cmsis_q15_torque", |d, p| fixed(peer_linear_q15, d, p, cmsis_q15_torque)),
    ("cmsis_q15_acceleration", |d, p| fixed(peer_linear_q15, d, p, cmsis_q15_acceleration)),
];
