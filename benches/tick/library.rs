//! jred's own ticks.
//!
//! The data of each is a table image.

use core::hint::black_box;

use jred::table::{Cubic, Layout, Quadratic, Spline, Spline16, curves};
use jred::{Image, Model, Phase, Q15, Q31, Scalar, short};

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
    jred_q31_spline16_torque: Q31 Spline16 FULL, |m, p, w, a| m.torque(p, w, a);
    jred_q31_spline16_acceleration: Q31 Spline16 SEED, |m, p, w, t| m.acceleration(p, w, t).value;
    jred_q31_quadratic_acceleration: Q31 Quadratic SEED, |m, p, w, t| m.acceleration(p, w, t).value;
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn jred_q15_torque(
    model: &short::Model<FULL>,
    phase: Phase,
    omega: Q15,
    alpha: Q15,
) -> Q15 {
    model.torque(phase, omega, alpha)
}

#[unsafe(no_mangle)]
#[inline(never)]
extern "Rust" fn jred_q15_acceleration(
    model: &short::Model<SEED>,
    phase: Phase,
    omega: Q15,
    torque: Q15,
) -> Q15 {
    model.acceleration(phase, omega, torque).value
}

/// The ticks over 16-bit rows.
pub(crate) const SHORT: &[Kernel] = &[
    ("jred_q15_torque", |image, points| {
        over_short(image, points, jred_q15_torque);
    }),
    ("jred_q15_acceleration", |image, points| {
        over_short(image, points, jred_q15_acceleration);
    }),
];

/// As `over`, for 16-bit rows.
fn over_short<const CURVES: u8>(
    image: &[u32],
    points: &mut [Point],
    kernel: fn(&short::Model<CURVES>, Phase, Q15, Q15) -> Q15,
) {
    let kernel = black_box(kernel);
    let image = Image::new(image).expect("a table image");
    let model = image.short_model().expect("of this set of curves");
    let number = |bits: u32| Q15::from_bits(bits as i16);
    each(points, |[phase, omega, third]| {
        let result = kernel(
            &model,
            Phase::from_bits(phase),
            number(omega),
            number(third),
        );
        i32::from(result.to_bits()).cast_unsigned()
    });
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
