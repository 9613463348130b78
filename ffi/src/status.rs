//! The return value of a function.

use core::ffi::{CStr, c_char};

use jred::ImageError;
use jred::axis::plan::PlanError;
use jred::table::TableError;

macro_rules! statuses {
    ($($(#[$doc:meta])* $variant:ident = $code:literal $name:literal,)*) => {
        /// The return value of a function; 0 is success. [`name`](Self::name) gives the names in C.
        #[repr(i32)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Status {
            $($(#[$doc])* $variant = $code,)*
        }

        impl Status {
            /// Every status.
            pub(crate) const ALL: &[Self] = &[$(Self::$variant),*];

            pub(crate) const fn name(self) -> &'static CStr {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
}

statuses! {
    /// Done.
    Ok = 0 c"JRED_OK",
    /// Done, but the number is outside the range of the number type; the nearest end was used.
    Limited = 1 c"JRED_LIMITED",
    /// A pointer is null.
    Null = 2 c"JRED_NULL",
    /// The words do not lie on a 4-byte boundary.
    Misaligned = 3 c"JRED_MISALIGNED",
    /// Images are little-endian, and this processor is not.
    BigEndian = 4 c"JRED_BIG_ENDIAN",
    /// The number of words is not the image's: truncated, or padded.
    Length = 5 c"JRED_LENGTH",
    /// The words do not begin with "JRED".
    NotAnImage = 6 c"JRED_NOT_AN_IMAGE",
    /// The image has another version of the layout.
    Version = 7 c"JRED_VERSION",
    /// The image is damaged.
    Crc = 8 c"JRED_CRC",
    /// A word of the header is invalid.
    Header = 9 c"JRED_HEADER",
    /// The image contains another number type.
    NumberType = 10 c"JRED_NUMBER_TYPE",
    /// The image has another layout.
    Layout = 11 c"JRED_LAYOUT",
    /// The image has another set of curves.
    Set = 12 c"JRED_SET",
    /// Too few or too many cells or harmonics.
    Cells = 13 c"JRED_CELLS",
    /// The number of rows does not match the cells and curves.
    Rows = 14 c"JRED_ROWS",
    /// A number is not finite or outside its range.
    Range = 15 c"JRED_RANGE",
    /// The inertia is not positive everywhere.
    NoInertia = 16 c"JRED_NO_INERTIA",
    /// A periodic curve does not close.
    NotClosed = 17 c"JRED_NOT_CLOSED",
    /// A torque may leave the number range.
    TorqueRange = 18 c"JRED_TORQUE_RANGE",
    /// The machine units are not those of the table.
    Units = 19 c"JRED_UNITS",
    /// A constant friction is negative or not finite.
    Constant = 20 c"JRED_CONSTANT",
    /// The curve of 1/J does not match J.
    Reciprocal = 21 c"JRED_RECIPROCAL",
    /// Any other error of a table.
    Table = 22 c"JRED_TABLE",
    /// The words do not begin with "JRPL".
    NotAPlan = 23 c"JRED_NOT_A_PLAN",
    /// The plan was made for another range of the drive link than the model.
    OtherRange = 24 c"JRED_OTHER_RANGE",
    /// A row of the plan does not begin after the one before, or has a number that is out of range.
    PlanRow = 25 c"JRED_PLAN_ROW",
    /// A row of the plan does not end where the next begins.
    Gap = 26 c"JRED_GAP",
    /// The plan leaves the stroke.
    Stroke = 27 c"JRED_STROKE",
    /// The end of the plan does not match its start, so that it cannot be repeated.
    Open = 28 c"JRED_OPEN",
    /// A figure out of range: of an encoder; the period or the ramp of the rate; a plan faster than the machine units of the model; a table without a
    /// valid speed.
    Figure = 29 c"JRED_FIGURE",
    /// The memory contains no model, or no follower.
    NotLoaded = 30 c"JRED_NOT_LOADED",
}

impl From<ImageError> for Status {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Misaligned => Self::Misaligned,
            ImageError::BigEndian => Self::BigEndian,
            ImageError::Length { .. } => Self::Length,
            ImageError::NotAnImage(_) => Self::NotAnImage,
            ImageError::Version { .. } => Self::Version,
            ImageError::Crc { .. } => Self::Crc,
            ImageError::Header(_) => Self::Header,
            ImageError::NumberType(_) => Self::NumberType,
            ImageError::Layout(_) => Self::Layout,
            ImageError::Table(error) => error.into(),
            _ => Self::Table,
        }
    }
}

impl From<TableError> for Status {
    fn from(error: TableError) -> Self {
        match error {
            TableError::Curves(_) => Self::Set,
            TableError::Cells(_) => Self::Cells,
            TableError::Length { .. } => Self::Rows,
            TableError::Range { .. } | TableError::Overflow { .. } => Self::Range,
            TableError::NoInertia { .. }
            | TableError::NoInertiaAt { .. }
            | TableError::InertiaNotShown { .. } => Self::NoInertia,
            TableError::NotClosed { .. } => Self::NotClosed,
            TableError::VelocityTorque { .. } | TableError::TorqueRange { .. } => Self::TorqueRange,
            TableError::SpeedBase | TableError::Slope { .. } => Self::Units,
            TableError::Constant => Self::Constant,
            TableError::Reciprocal { .. } => Self::Reciprocal,
            _ => Self::Table,
        }
    }
}

impl From<PlanError> for Status {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Image(error) => error.into(),
            PlanError::NotAPlan(_) => Self::NotAPlan,
            PlanError::Range => Self::OtherRange,
            PlanError::Gap(_) => Self::Gap,
            PlanError::Stroke(_) => Self::Stroke,
            PlanError::Open => Self::Open,
            PlanError::Axis(_) => Self::Figure,
            _ => Self::PlanRow,
        }
    }
}

impl From<Result<(), ImageError>> for Status {
    fn from(result: Result<(), ImageError>) -> Self {
        result.map_or_else(Self::from, |()| Self::Ok)
    }
}

/// The name of a status, such as `JRED_CRC`; `JRED_UNKNOWN` for another number.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn jred_status_name(status: i32) -> *const c_char {
    let found = Status::ALL.iter().find(|known| **known as i32 == status);
    found.map_or(c"JRED_UNKNOWN", |known| known.name()).as_ptr()
}
