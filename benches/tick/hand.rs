//! Code as a careful engineer writes it by hand: three curves in separate linear tables, one index and one fraction for all of them, single
//! precision, the angle in radians.
//!
//! The data: number of cells N, N/2π, b, c; then J, ½·J′ and the load torque, N + 1 values each. N is known at compile time, as in such firmware.

use core::hint::black_box;

use crate::target::{Kernel, Point, each};

/// Cells of the tables.
const CELLS: usize = 256;
/// Values of a table, with the first one repeated at its end.
const VALUES: usize = CELLS + 1;

/// The hand-written machine.
#[repr(C)]
pub(crate) struct Machine {
    /// Cells per radian.
    per_radian: f32,
    viscous: f32,
    coulomb: f32,
    inertia: [f32; VALUES],
    half_slope: [f32; VALUES],
    load: [f32; VALUES],
}

impl Machine {
    /// The machine over the words after N.
    pub(crate) fn new(data: &[u32]) -> &Self {
        let (cells, rest) = data.split_first().expect("data");
        assert!(*cells as usize == CELLS && size_of_val(rest) == size_of::<Self>());
        // SAFETY: both have the same number of words, and only words; f32 accepts any bits.
        unsafe { &*rest.as_ptr().cast() }
    }

    /// Index and fraction of an angle from 0 to 2π.
    #[inline]
    fn place(&self, phi: f32) -> (usize, f32) {
        let place = phi * self.per_radian;
        let cell = place as i32;
        ((cell as usize).min(CELLS - 1), place - cell as f32)
    }
}

#[inline]
fn interpolated(table: &[f32; VALUES], cell: usize, u: f32) -> f32 {
    table[cell] + u * (table[cell + 1] - table[cell])
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn hand_f32_torque(machine: &Machine, phi: f32, omega: f32, alpha: f32) -> f32 {
    let (cell, u) = machine.place(phi);
    let friction = if omega > 0.0 {
        machine.coulomb
    } else if omega < 0.0 {
        -machine.coulomb
    } else {
        0.0
    };
    interpolated(&machine.inertia, cell, u) * alpha
        + interpolated(&machine.half_slope, cell, u) * omega * omega
        + interpolated(&machine.load, cell, u)
        + machine.viscous * omega
        + friction
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn hand_f32_acceleration(
    machine: &Machine,
    phi: f32,
    omega: f32,
    torque: f32,
) -> f32 {
    let (cell, u) = machine.place(phi);
    (torque - interpolated(&machine.half_slope, cell, u) * omega * omega)
        / interpolated(&machine.inertia, cell, u)
}

fn over(data: &[u32], points: &mut [Point], kernel: fn(&Machine, f32, f32, f32) -> f32) {
    let kernel = black_box(kernel);
    let machine = Machine::new(data);
    each(points, |p| {
        let [phi, omega, third] = p.map(f32::from_bits);
        kernel(machine, phi, omega, third).to_bits()
    });
}

pub(crate) const KERNELS: &[Kernel] = &[
    ("hand_f32_torque", |d, p| {
        over(d, p, hand_f32_torque);
    }),
    ("hand_f32_acceleration", |d, p| {
        over(d, p, hand_f32_acceleration);
    }),
];
