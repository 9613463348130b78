//! Parts of a mechanism with the names of a machine file.

use jred::machine::{Element, Load};

/// A point of a link, with the name that tables and drawings use.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// For example `B`.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// Its position in the link's frame (m).
    pub at: [f64; 2],
}

/// A joint in which two surfaces only press on each other, like a follower on its cam.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Index of the joint.
    pub joint: usize,
    /// Whether the file names it; otherwise there is only one.
    pub named: bool,
    /// The pieces of the drive's range in which it is smooth.
    pub pieces: Vec<jred::mechanism::cam::Piece>,
}

/// A position at which bodies of a linkage come into line, and which it passes on its branch, guided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangePoint {
    /// Position of the drive link (rad, or m).
    pub at: f64,
    /// Distance from it below which the forces in the joints are not determined (rad, or m).
    pub within: f64,
}

/// A property of one kind of mechanism, such as the largest pressure angle of a cam.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct Fact {
    /// Its name.
    pub label: String,
    /// The figure, its unit and position.
    pub text: String,
}

/// A load with the name that reports use.
#[derive(Clone, Debug)]
pub struct NamedLoad {
    /// Name from the file, or derived from the load's effect.
    pub name: String,
    /// The load.
    pub load: Load,
}

/// A spring or a damper with the name that reports use.
#[derive(Clone, Debug)]
pub struct NamedElement {
    /// Name from the file, or derived from its ends.
    pub name: String,
    /// The spring or damper.
    pub element: Element,
}
