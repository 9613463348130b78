//! What a motor can do at a supply, from the figures of its data sheet.

pub mod envelope;
pub(crate) mod supply;
pub mod winding;
