//! Your machine and its drive: change this first. Here it is the press of `machines/press.toml` behind a gearbox of ratio 20.

use jred::axis::{Counting, Encoder, Gearbox, Mounting};
use jred::table::{Format, MotorTorqueOf};
use jred::{CurveSet, Image, Phase, curves, include_image};

/// The identifier of the machine, as `jred export` prints it: an image of another machine is refused.
pub const MACHINE: u32 = 0x3d4c_7e82;
/// The curves of the table, as `jred export` prints them.
pub const CURVES: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Layout and numbers of the tables: single precision where the core has it (`--type f32`), otherwise fixed point (`--type i32`).
#[cfg(not(fixed_point))]
pub type Layout = jred::Spline<f32>;
#[cfg(fixed_point)]
pub type Layout = jred::Spline<jred::Q31>;
/// A number of the tick, and a torque of the motor: with `Q31` a type different from a torque on the crank.
pub type Number = <Layout as Format>::Number;
pub type MotorTorque = MotorTorqueOf<Layout>;

/// Words of the largest image: `jred export` prints the bytes, four per word.
pub const WORDS: usize = 320;

/// The table at start-up.
#[cfg(not(fixed_point))]
pub static TABLE: &[u8] = include_image!("../tables/press_f32.jred");
#[cfg(fixed_point)]
pub static TABLE: &[u8] = include_image!("../tables/press_q31.jred");

const _: () = assert!(
    Image::bytes_are_of::<Layout, CURVES>(TABLE_BYTES),
    "the table has another type or other curves: take Layout and CURVES from the line `in Rust` of jred export"
);
#[cfg(not(fixed_point))]
const TABLE_BYTES: &[u8] = include_bytes!("../tables/press_f32.jred");
#[cfg(fixed_point)]
const TABLE_BYTES: &[u8] = include_bytes!("../tables/press_q31.jred");

/// The encoder is on the motor, counts down while φ grows, and shows 1234 at φ = 0. docs/axis.md describes how to find that count.
pub const COUNTS_PER_TURN: u32 = 10_000;
pub const GEAR: [u32; 2] = [20, 1];
pub const HOME: i64 = 1234;
pub const COUNTING: Counting = Counting::Down;
pub const ENCODER: Encoder = match Encoder::new(Mounting {
    counts_per_turn: COUNTS_PER_TURN,
    gear: GEAR,
    counting: COUNTING,
    homing_offset: HOME,
}) {
    Ok(encoder) => encoder,
    Err(_) => panic!("the encoder's figures"), // at compile time
};

/// The table contains everything up to the crank, but not the rotor.
pub const GEARBOX: Gearbox = Gearbox {
    ratio: 20.0,
    efficiency: 0.95,
    rotor: 0.000_3,
};
/// Largest torque of the motor (N·m).
pub const MOST_TORQUE: f32 = 12.0;
/// Coulomb friction rises with the speed up to this one (rad/s of the crank).
pub const FRICTION_RAMP: f32 = 0.5;
/// Delay from a command to the torque (s).
pub const LEAD: f32 = 0.000_2;
/// Corner frequency of the filter of speed and acceleration (Hz).
pub const BANDWIDTH: f32 = 60.0;

/// Position for exchanging tables, where a step of the torque does no harm: here top dead centre.
pub const EXCHANGE_AT: Phase = Phase::from_bits(1 << 31);
