//! A selection of drives as text, CSV or JSON.

mod asked;
mod brief;
mod choice;
mod comma;
mod explanation;
mod json;
mod text;

pub use asked::Asked;
pub use choice::{List, explained};
pub use comma::csv;
pub use explanation::Explanation;
pub(crate) use json::SizeData;
pub use json::{Notes, json};
pub use text::text;
pub(crate) use text::{class_text, figure, gap_text, margin, smaller, violations};
