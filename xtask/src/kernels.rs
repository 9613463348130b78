//! The kernels: the measured functions, with their numbers and data.
//!
//! To add one: a line in [`KERNELS`], and the function of that name in `benches/tick/`.

use crate::data::Data;
use crate::image::Layout::{self, Cubic, Quadratic, Rows16, SliderCrank, Spline, Spline16};
use crate::image::{BARE, FULL, SEED};
use crate::number::Number;

/// Result of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Inverse dynamics.
    Torque,
    /// Forward dynamics.
    Acceleration,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// The library: its instructions and bytes have ceilings.
    Jred,
    /// For comparison: always available.
    Other,
    /// For comparison: needs `--peers`.
    Peer,
}

/// A function of the on-target program.
pub(crate) struct Kernel {
    /// Its symbol.
    pub(crate) name: &'static str,
    /// Title in tables of results.
    pub(crate) title: &'static str,
    pub(crate) quantity: Quantity,
    pub(crate) origin: Origin,
    pub(crate) number: Number,
    pub(crate) data: Data,
    /// Its first argument is a count of an encoder with [`COUNTS`] per turn, not a phase.
    pub(crate) counts: bool,
}

/// Counts per turn of the encoder in `benches/tick/library.rs` and in `ffi/tests/tick.c`.
pub(crate) const COUNTS: u32 = 10_000;

macro_rules! kernels {
    ($counts:literal: $($name:ident $quantity:ident $origin:ident $number:ident $data:expr, $title:literal;)*) => {
        [$(Kernel {
            name: stringify!($name),
            title: $title,
            quantity: Quantity::$quantity,
            origin: Origin::$origin,
            number: Number::$number,
            data: $data,
            counts: $counts,
        }),*]
    };
}

/// A table of the library: 64 cells, quadratics 256; none for a slider-crank.
const fn table(layout: Layout, set: jred::CurveSet) -> Data {
    let cells = match layout {
        SliderCrank => 0,
        Quadratic | Rows16 => 256,
        Cubic | Spline | Spline16 => 64,
    };
    Data::Jred { layout, set, cells }
}

/// Every kernel, in the order of the tables of results.
#[rustfmt::skip]
pub(crate) const KERNELS: &[Kernel] = &kernels![false:
    // symbol                    quantity     origin number  data, title
    jred_f32_torque              Torque       Jred  PhaseF32 table(Cubic, FULL), "jred f32, cubic";
    jred_f32_spline_torque       Torque       Jred  PhaseF32 table(Spline, FULL), "jred f32, spline";
    jred_f32_slider_crank_torque Torque       Jred  PhaseF32 table(SliderCrank, FULL), "jred f32, slider-crank";
    jred_q31_torque              Torque       Jred  PhaseQ31 table(Cubic, FULL), "jred q31, cubic";
    jred_q31_quadratic_torque    Torque       Jred  PhaseQ31 table(Quadratic, FULL), "jred q31, quadratic";
    jred_q31_spline16_torque     Torque       Jred  PhaseQ31 table(Spline16, FULL), "jred q31, 16-bit spline";
    jred_q15_torque              Torque       Jred  PhaseQ15 table(Rows16, FULL), "jred q15, 16-bit rows";
    hand_f32_torque              Torque       Other Radians  Data::LinearF32, "by hand, f32, one index (Rust)";
    analytic_libm_torque         Torque       Other Radians  Data::Dimensions, "no table, crate libm";
    analytic_micromath_torque    Torque       Other Radians  Data::Dimensions, "no table, crate micromath";
    hand_c_f32_torque            Torque       Peer  Radians  Data::LinearF32, "by hand, f32, one index (C)";
    cmsis_f32_torque             Torque       Peer  Radians  Data::LinearF32, "arm_linear_interp_f32 × 3";
    cmsis_q31_torque             Torque       Peer  PhaseQ31 Data::LinearQ31, "arm_linear_interp_q31 × 3";
    cmsis_q15_torque             Torque       Peer  PhaseQ15 Data::LinearQ15, "arm_linear_interp_q15 × 3";
    cmsis_analytic_torque        Torque       Peer  Radians  Data::Dimensions, "no table, arm_sin_f32, arm_cos_f32";
    jred_f32_acceleration        Acceleration Jred  PhaseF32 table(Cubic, BARE), "jred f32, cubic";
    jred_f32_spline_acceleration Acceleration Jred  PhaseF32 table(Spline, BARE), "jred f32, spline";
    jred_f32_slider_crank_acceleration Acceleration Jred PhaseF32 table(SliderCrank, BARE), "jred f32, slider-crank";
    jred_q31_acceleration        Acceleration Jred  PhaseQ31 table(Cubic, SEED), "jred q31, cubic, 1/J";
    jred_q31_quadratic_acceleration Acceleration Jred PhaseQ31 table(Quadratic, SEED), "jred q31, quadratic, 1/J";
    jred_q31_spline16_acceleration Acceleration Jred PhaseQ31 table(Spline16, SEED), "jred q31, 16-bit spline, 1/J";
    jred_q15_acceleration        Acceleration Jred  PhaseQ15 table(Rows16, SEED), "jred q15, 16-bit rows, 1/J";
    hand_f32_acceleration        Acceleration Other Radians  Data::LinearF32, "by hand, f32, one index (Rust)";
    analytic_libm_acceleration   Acceleration Other Radians  Data::Dimensions, "no table, crate libm";
    analytic_micromath_acceleration Acceleration Other Radians Data::Dimensions, "no table, crate micromath";
    hand_c_f32_acceleration      Acceleration Peer  Radians  Data::LinearF32, "by hand, f32, one index (C)";
    cmsis_f32_acceleration       Acceleration Peer  Radians  Data::LinearF32, "arm_linear_interp_f32 × 2";
    cmsis_q31_acceleration       Acceleration Peer  PhaseQ31 Data::LinearQ31, "arm_linear_interp_q31 × 2, 64-bit division";
    cmsis_q15_acceleration       Acceleration Peer  PhaseQ15 Data::LinearQ15, "arm_linear_interp_q15 × 2";
    cmsis_analytic_acceleration  Acceleration Peer  Radians  Data::Dimensions, "no table, arm_sin_f32, arm_cos_f32";
];

/// From a count to a torque, and along a whole axis to that of the motor, as in a program: for the comparison of C with Rust.
#[rustfmt::skip]
pub(crate) const COUNTED: &[Kernel] = &kernels![true:
    jred_f32_counts              Torque       Jred  PhaseF32 table(Cubic, FULL), "jred f32, cubic, 10,000 counts";
    jred_q31_quadratic_counts    Torque       Jred  PhaseQ31 table(Quadratic, FULL), "jred q31, quadratic, 10,000 counts";
    jred_q15_counts              Torque       Jred  PhaseQ15 table(Rows16, FULL), "jred q15, 16-bit rows, 10,000 counts";
    jred_f32_axis                Torque       Jred  PhaseF32 table(Cubic, FULL), "jred f32, cubic, axis";
    jred_q31_quadratic_axis      Torque       Jred  PhaseQ31 table(Quadratic, FULL), "jred q31, quadratic, axis";
    jred_q15_axis                Torque       Jred  PhaseQ15 table(Rows16, FULL), "jred q15, 16-bit rows, axis";
];

impl Kernel {
    /// Whether this is the other quantity with the same data.
    pub(crate) fn data_of(&self, other: &Self) -> bool {
        let stem = |name: &'static str| name.rsplit_once('_').map(|(stem, _)| stem);
        stem(self.name) == stem(other.name)
    }
}
