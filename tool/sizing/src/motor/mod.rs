//! The limits of a motor at a supply, from its data sheet.

pub mod envelope;
pub(crate) mod supply;
pub mod winding;
