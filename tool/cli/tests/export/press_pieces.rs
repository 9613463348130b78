// Servo press, 60 mm stroke, 10 kN: reduced machine at the drive link
// f32, layout spline, 29 cells, curves: J_red, load, coulomb, constant viscous; 492 bytes of rows, 892 bytes of image
// machine 0x3d4c7e82 (of its title; --machine-id sets another)
// in Rust: 4 pieces, jred::Pieces<'static, Spline<f32>, { curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS }, 4>
// piece 1: 0 to 315 deg, 15 cells, 316 bytes of image, torque error 1.79591 N m
// piece 2: 315 to 330 deg, 6 cells, 208 bytes of image, torque error 1.24922 N m
// piece 3: 330 to 345 deg, 4 cells, 184 bytes of image, torque error 0.00871153 N m
// piece 4: 345 to 360 deg, 4 cells, 184 bytes of image, torque error 1.11483 N m
// torque error reached 1.79591 N m of 2 N m allowed, at 315 deg, for |omega| <= 29.4524 rad/s, |alpha| <= 226.725 rad/s^2
// measured in ticks: torque within 1.78891 N m (0.009219 of the largest, 194.036 N m), alpha within 12.6882 rad/s^2
/// Identifier of the machine: `Image::of_machine` refuses the image of another.
pub const MACHINE: u32 = 0x3d4c7e82;

/// The machine in pieces.
pub type PiecewiseModel = jred::Pieces<'static, jred::Spline<f32>, { jred::curves::LOAD | jred::curves::COULOMB | jred::curves::CONSTANT_VISCOUS }, 4>;

/// Checks the tables and puts them together.
pub fn pieces() -> Result<PiecewiseModel, jred::ImageError> {
    fn piece(start: u32, words: &'static [u32]) -> Result<(jred::Phase, jred::Model<'static, jred::Spline<f32>, { jred::curves::LOAD | jred::curves::COULOMB | jred::curves::CONSTANT_VISCOUS }>), jred::ImageError> {
        Ok((jred::Phase::from_bits(start), jred::Image::new(words)?.of_machine(MACHINE)?.model()?))
    }
    jred::Pieces::new(jred::Domain::Turn, [
        piece(0x00000000, &TABLE_1)?,
        piece(0xe0000000, &TABLE_2)?,
        piece(0xeaaaaaab, &TABLE_3)?,
        piece(0xf5555555, &TABLE_4)?,
    ])
    .map_err(jred::ImageError::Table)
}

pub static TABLE_1: [u32; 79] = [
    0x4445524a, 0x00180002, 0x0000004f, 0x01011501, 0x0000000f, 0x00000000, 0x40afeddf, 0x3f800000,
    0x3f800000, 0x3f800000, 0x41eb9e94, 0x4362b994, 0x3fe5e06a, 0x3e0bc57a, 0x3ecccccd, 0x00000000,
    0x00000000, 0x00000000, 0x00000000, 0x3d4c7e82, 0x00000000, 0x00000000, 0x00000000, 0x00000000,
    0xbb0b718e, 0x3f86f637, 0xbea752ee, 0xbb81aceb, 0xbba353e2, 0x3ad9a4f8, 0xbb2521ef, 0xbf8468e8,
    0x3ea3ec5a, 0x39d34f56, 0xbff1535a, 0x3f14eb72, 0x3b467d79, 0xc01a2dc0, 0x3f3d457b, 0x3b75ac54,
    0xc02340ad, 0x3f46f87b, 0x3b20cc42, 0xc0159645, 0x3f34c65a, 0x38f65ec4, 0xbfed1a37, 0x3f0e0ad4,
    0xbb0959b9, 0xbf98d356, 0x3eb5cd26, 0xbb5fcab6, 0xbee3b0c1, 0x3e06dc62, 0xbb65caae, 0x3eab071d,
    0xbdca8a2f, 0xbb1a1540, 0x3f8ba04f, 0xbea5f6d8, 0xb96fded0, 0x3fe2264a, 0xbf075350, 0x3b0cfd57,
    0x40120ef7, 0xbf3049d4, 0x3b7167ca, 0x4022a1b8, 0xbf45fcf9, 0x3b535945, 0x401cd87d, 0xbf405b56,
    0x3a83abdb, 0x3ffecd26, 0xbf1d2c2c, 0xbb341e14, 0x3f91fe8a, 0xbeb46d72, 0xab4f4a1c,
];

pub static TABLE_2: [u32; 52] = [
    0x4445524a, 0x00180002, 0x00000034, 0x01011501, 0x00000006, 0x00000000, 0x3e860a92, 0x3f800000,
    0x3f800000, 0x3f800000, 0x41eb9e94, 0x4362b994, 0x3f9fe673, 0x3e0a47f3, 0x3ecccccd, 0x00000000,
    0x00000000, 0x00000000, 0x00000000, 0x3d4c7e82, 0x00000000, 0x00000000, 0x00000000, 0x00000000,
    0x3aac4c00, 0xbfa1e98b, 0x3f1daed3, 0x3a8229fe, 0x4037fa8d, 0x3f17f0c3, 0x3a2deaa7, 0x3fa8f93e,
    0x3f11d0df, 0x39ac68e9, 0xc0a4fe11, 0x3f0b5295, 0xb6fb1371, 0xc17c7f51, 0x3f047950, 0xb9b36d34,
    0xc1c8e456, 0x3efa91e3, 0xba302cb8, 0xc1e6f576, 0x3eeb8b40, 0xba823cec, 0xc1df124b, 0x3edbe7da,
    0xbaaadfa8, 0xc1b7da13, 0x3ecbb0cf, 0x35319c0e,
];

pub static TABLE_3: [u32; 46] = [
    0x4445524a, 0x00180002, 0x0000002e, 0x01011501, 0x00000004, 0x00000000, 0x3e860a92, 0x3f800000,
    0x3f800000, 0x3f800000, 0x41eb9e94, 0x4362b994, 0x3c0ebad0, 0x3dfeadea, 0x3ecccccd, 0x00000000,
    0x00000000, 0x00000000, 0x00000000, 0x3d4c7e82, 0x00000000, 0x00000000, 0x00000000, 0x00000000,
    0x3aa6b05e, 0xc1f11679, 0x3ef34377, 0x3a4db58b, 0xc1da108c, 0x3edc06bf, 0x39a9e755, 0xc1c1c00d,
    0x3ec37d01, 0xb8d1e0e6, 0xc1a84977, 0x3ea9cb00, 0xb9fa6204, 0xc18dd143, 0x3e8f157d, 0xba51a76f,
    0xc164fe9d, 0x3e670942, 0xba8aade6, 0xc12cf6e7, 0x3e2e8128, 0x8e23df5e,
];

pub static TABLE_4: [u32; 46] = [
    0x4445524a, 0x00180002, 0x0000002e, 0x01011501, 0x00000004, 0x00000000, 0x3e860a92, 0x3f800000,
    0x3f800000, 0x3f800000, 0x41eb9e94, 0x4362b994, 0x3f8eb2a7, 0x3df14b59, 0x3ecccccd, 0x00000000,
    0x00000000, 0x00000000, 0x00000000, 0x3d4c7e82, 0x00000000, 0x00000000, 0x00000000, 0x00000000,
    0x3a20802c, 0xc15f9d05, 0x3e8f1518, 0x3997c4ec, 0xc177bad4, 0x3e670922, 0x38013f0d, 0xc11e0b8e,
    0x3e2e8271, 0xb92674f3, 0xc030499a, 0x3de9dc72, 0xb98fc5d6, 0x3e95ae0b, 0x3d6a9264, 0xb9a440e2,
    0x3ea684f6, 0x34889cb6, 0xb98f724b, 0xbfcbf079, 0xbd6a9377, 0x0c46ad63,
];
