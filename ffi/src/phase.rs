//! Phases from angles and positions.

use jred::{Domain, Phase};

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_phase_from_radians(phi: f32) -> u32 {
    Phase::from_radians_f32(phi).to_bits()
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_phase_from_stroke(position: f32, from: f32, to: f32) -> u32 {
    Domain::Stroke { from, to }.phase(position).to_bits()
}
