//! Information about an image.

use core::mem::MaybeUninit;

use jred::axis::Units;
use jred::image::Validity;
use jred::number::{Bases, Number};
use jred::{Domain, Image, ImageError};

use crate::memory::words;
use crate::status::Status;

/// `jred_info` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Info {
    set: u32,
    cells: u32,
    /// 0: a turn; 1: a stroke.
    stroke: u32,
    from: f32,
    to: f32,
    torque_base: f32,
    speed_base: f32,
    inertia_base: f32,
    acceleration_base: f32,
    max_speed: f32,
    max_acceleration: f32,
    torque_error: f32,
    machine: u32,
}

impl Info {
    pub(crate) const fn bases(&self) -> Bases {
        Bases {
            torque: self.torque_base,
            speed: self.speed_base,
            inertia: self.inertia_base,
        }
    }

    /// The machine units for parts of an axis.
    pub(crate) fn units<N: Number<Real = f32>>(info: Option<&Self>) -> Result<Units<N>, Status> {
        let info = info.ok_or(Status::Null)?;
        let domain = if info.stroke == 0 {
            Domain::Turn
        } else {
            Domain::Stroke {
                from: info.from,
                to: info.to,
            }
        };
        Units::new(info.bases(), domain).map_err(|_| Status::Figure)
    }

    pub(crate) const fn validity(&self) -> Validity {
        Validity {
            max_speed: self.max_speed,
            max_acceleration: self.max_acceleration,
            torque_error: self.torque_error,
        }
    }

    fn of(words: &[u32]) -> Result<Self, ImageError> {
        let image = Image::new(words)?;
        let (stroke, from, to) = match image.domain() {
            Domain::Turn => (0, 0.0, 0.0),
            Domain::Stroke { from, to } => (1, from, to),
        };
        let (scale, validity) = (image.scale(), image.validity());
        Ok(Self {
            set: image.set().into(),
            cells: image.cells(),
            stroke,
            from,
            to,
            torque_base: scale.torque(),
            speed_base: scale.speed(),
            inertia_base: scale.inertia(),
            acceleration_base: scale.acceleration(),
            max_speed: validity.max_speed,
            max_acceleration: validity.max_acceleration,
            torque_error: validity.torque_error,
            machine: image.machine(),
        })
    }
}

/// # Safety
/// `words` is null, or the address of `length` words; `info` is null or memory of a `jred_info`.
#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn jred_image_info(
    words: *const u32,
    length: usize,
    info: Option<&mut MaybeUninit<Info>>,
) -> Status {
    // SAFETY: as promised by the caller.
    let words = unsafe { self::words(words, length) };
    let (words, info) = match (words, info) {
        (Ok(words), Some(info)) => (words, info),
        (Err(status), _) => return status,
        (_, None) => return Status::Null,
    };
    Info::of(words).map(|found| _ = info.write(found)).into()
}
