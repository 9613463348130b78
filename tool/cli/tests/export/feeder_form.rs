// Shaking feeder, 50 mm stroke: reduced machine at the drive link
// f32, layout slider-crank, 12 coefficients, curves: J_red, load, viscous, coulomb, constant coulomb; 48 bytes of rows, 148 bytes of image
// machine 0x7995bc09 (of its title; --machine-id sets another)
// in Rust: image.model::<SliderCrankForm, { curves::LOAD | curves::VISCOUS | curves::COULOMB | curves::CONSTANT_COULOMB | slider_crank::terms::INERTIA_COS | slider_crank::terms::LOAD_SIN | slider_crank::terms::LOAD_COS }>()
// no table: needs jred's feature micromath
// instructions at most on a Cortex-M4F: closed form 119, cubic 63, spline 104
// torque error reached 6.59331e-6 N m of 0.1 N m allowed, at 291.462 deg, for |omega| <= 25.1327 rad/s, |alpha| <= 631.655 rad/s^2
// measured in ticks: torque within 6.59331e-6 N m (2.011e-7 of the largest, 32.789 N m), alpha within 0.000164797 rad/s^2
/// Identifier of the machine: `Image::of_machine` refuses the image of another.
#[allow(dead_code)]
pub const MACHINE: u32 = 0x7995bc09;

/// The machine.
#[allow(dead_code)]
pub type TableModel = jred::Model<'static, jred::SliderCrankForm, { jred::curves::LOAD | jred::curves::VISCOUS | jred::curves::COULOMB | jred::curves::CONSTANT_COULOMB | jred::slider_crank::terms::INERTIA_COS | jred::slider_crank::terms::LOAD_SIN | jred::slider_crank::terms::LOAD_COS }>;

// A table of another type or with other curves does not compile.
const _: () = assert!(jred::Image::is_of::<jred::SliderCrankForm, { jred::curves::LOAD | jred::curves::VISCOUS | jred::curves::COULOMB | jred::curves::CONSTANT_COULOMB | jred::slider_crank::terms::INERTIA_COS | jred::slider_crank::terms::LOAD_SIN | jred::slider_crank::terms::LOAD_COS }>(&TABLE));

/// Checks the table.
#[allow(dead_code)]
pub fn model() -> Result<TableModel, jred::ImageError> {
    jred::Image::new(&TABLE)?.of_machine(MACHINE)?.model()
}

pub static TABLE: [u32; 37] = [
    0x4445524a, 0x00180002, 0x00000025, 0x00072701, 0x00000000, 0x00000000, 0x00000000, 0x3f800000,
    0x3f800000, 0x3f800000, 0x41c90fdb, 0x441de9e6, 0x36dd3c23, 0x00000007, 0x00000000, 0x00000000,
    0x00000000, 0x00000000, 0x00000000, 0x7995bc09, 0x00000000, 0x00000000, 0x00000000, 0x00000000,
    0x3e36db6e, 0x3e124925, 0x3cd23534, 0x3c8779aa, 0x396fa940, 0xb84a39b2, 0x3c1afc9e, 0xbc1afc9e,
    0xbed19747, 0x3d19999a, 0x3f800000, 0x3e99999a, 0x359027b7,
];
