//! jred's own ticks.
//!
//! The data of each is a table image.

use core::hint::black_box;

use jred::table::{Cubic, Layout, Quadratic, Spline, curves};
use jred::{Image, Model, Phase, Q31, Scalar};

use crate::target::{Kernel, Point, each};

/// Load, and friction of the drive link that does not depend on the angle.
const FULL: u8 = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// The inertia alone.
const BARE: u8 = curves::INERTIA;
/// With a seed of 1/J instead of a division.
const SEED: u8 = curves::RECIPROCAL;

/// A function of that name, with the number type, the layout and the curves of its model.
macro_rules! kernels {
    ($($name:ident: $number:ident $layout:ident $set:ident, $body:expr;)*) => {
        $(
            #[unsafe(no_mangle)]
            #[inline(never)]
            extern "Rust" fn $name(
                model: &Model<$number, $set, $layout>,
                phase: Phase,
                omega: $number,
                third: $number,
            ) -> $number {
                let body: fn(&Model<$number, $set, $layout>, _, _, _) -> _ = $body;
                body(model, phase, omega, third)
            }
        )*

        pub(crate) const KERNELS: &[Kernel] = &[
            $((stringify!($name), |image, points| over(image, points, $name))),*
        ];
    };
}

kernels! {
    jred_f32_torque: f32 Cubic FULL, |m, p, w, a| m.torque(p, w, a);
    jred_f32_acceleration: f32 Cubic BARE, |m, p, w, t| m.acceleration(p, w, t).value;
    jred_f32_spline_torque: f32 Spline FULL, |m, p, w, a| m.torque(p, w, a);
    jred_f32_spline_acceleration: f32 Spline BARE, |m, p, w, t| m.acceleration(p, w, t).value;
    jred_q31_torque: Q31 Cubic FULL, |m, p, w, a| m.torque(p, w, a);
    jred_q31_acceleration: Q31 Cubic SEED, |m, p, w, t| m.acceleration(p, w, t).value;
    jred_q31_quadratic_torque: Q31 Quadratic FULL, |m, p, w, a| m.torque(p, w, a);
    jred_q31_quadratic_acceleration: Q31 Quadratic SEED, |m, p, w, t| m.acceleration(p, w, t).value;
}

/// Calls a kernel over the model that the image holds.
fn over<S: Word, L: Layout, const CURVES: u8>(
    image: &[u32],
    points: &mut [Point],
    kernel: fn(&Model<S, CURVES, L>, Phase, S, S) -> S,
) {
    let kernel = black_box(kernel);
    let image = Image::new(image).expect("a table image");
    let model = image
        .model()
        .expect("of this type, layout and set of curves");
    each(points, |[phase, omega, third]| {
        kernel(
            &model,
            Phase::from_bits(phase),
            S::from(omega),
            S::from(third),
        )
        .into()
    });
}

/// A number of the tick as a word.
trait Word: Scalar {
    fn from(bits: u32) -> Self;
    fn into(self) -> u32;
}

impl Word for f32 {
    fn from(bits: u32) -> Self {
        Self::from_bits(bits)
    }
    fn into(self) -> u32 {
        self.to_bits()
    }
}

impl Word for Q31 {
    fn from(bits: u32) -> Self {
        Self::from_bits(bits.cast_signed())
    }
    fn into(self) -> u32 {
        self.to_bits().cast_unsigned()
    }
}
