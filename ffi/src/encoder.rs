//! Creates encoders; the conversion of a count is in the header, inlined into the C call.

use core::mem::MaybeUninit;

use jred::Domain;
use jred::axis::{AxisError, Counting, Encoder, Mounting, StrokeEncoder, StrokeMounting};

use crate::status::Status;

/// `jred_mounting` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct CMounting {
    pub(crate) counts_per_turn: u32,
    pub(crate) gear: [u32; 2],
    /// A `bool` of C, with any value.
    pub(crate) counts_down: u8,
    pub(crate) homing_offset: i64,
}

impl From<CMounting> for Mounting {
    fn from(mounting: CMounting) -> Self {
        Self {
            counts_per_turn: mounting.counts_per_turn,
            gear: mounting.gear,
            counting: if mounting.counts_down == 0 {
                Counting::Up
            } else {
                Counting::Down
            },
            homing_offset: mounting.homing_offset,
        }
    }
}

/// Writes what was created; on an error, the replacement.
fn keep<E>(
    memory: &mut MaybeUninit<E>,
    made: Result<E, AxisError>,
    other: MaybeUninit<E>,
) -> Status {
    if let Ok(encoder) = made {
        memory.write(encoder);
        Status::Ok
    } else {
        *memory = other;
        Status::Figure
    }
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_encoder_make(
    encoder: Option<&mut MaybeUninit<Encoder>>,
    mounting: Option<&CMounting>,
) -> Status {
    let (Some(encoder), Some(mounting)) = (encoder, mounting) else {
        return Status::Null;
    };
    // Zeros: an encoder whose phase is 0.
    keep(
        encoder,
        Encoder::new((*mounting).into()),
        MaybeUninit::zeroed(),
    )
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_stroke_encoder_make(
    encoder: Option<&mut MaybeUninit<StrokeEncoder>>,
    from: f32,
    to: f32,
    scaled: Option<&StrokeMounting>,
) -> Status {
    let (Some(encoder), Some(scaled)) = (encoder, scaled) else {
        return Status::Null;
    };
    keep(
        encoder,
        StrokeEncoder::new(Domain::Stroke { from, to }, *scaled),
        MaybeUninit::new(StrokeEncoder::NOWHERE),
    )
}
