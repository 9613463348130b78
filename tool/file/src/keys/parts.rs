//! Keys that several tables have.

use crate::text::key::{ValueForm, Key, key, may, pair, quantity};
use crate::units::kind::{ANGLE, INERTIA, LENGTH, MASS};

/// The length of a link.
pub(super) const fn length(help: &'static str) -> Key {
    key("length", quantity(&LENGTH).positive(), help)
}

/// A link that moves in any way.
pub(super) const LINK: &[Key] = &[
    key("mass", quantity(&MASS).not_negative(), ""),
    key("inertia", quantity(&INERTIA).not_negative(), "about its own centre of mass"),
    COM,
];

/// A link that slides without turning.
pub(super) const SLIDE: &[Key] = &[key("mass", quantity(&MASS).not_negative(), ""), COM];

/// A link that slides on a guide.
pub(super) const GUIDED: &[Key] = &[
    key("mass", quantity(&MASS).not_negative(), "with all that moves with it"),
    may("friction", ValueForm::Number([0.0, 2.0]), "[coefficient of the guide](axes.md)").or("0").such_as("0.05"),
    COM,
];

/// A part that turns about its own axis.
pub(super) const WHEEL: &[Key] = &[
    key("inertia", quantity(&INERTIA).not_negative(), "about its axis, with all that turns with it"),
    may("mass", quantity(&MASS).not_negative(), "for the force in its bearings").or("0"),
];

pub(super) const COM: Key = may("com", pair(&LENGTH), "centre of mass `[u, v]`").or("0");

/// The range of a crank that only swings.
pub(super) const SWING: Key = may("stroke", pair(&ANGLE), "rising, less than a turn: range of a drive link that swings (full turn)").such_as("[\"-30 deg\", \"60 deg\"]");

/// The range of a part that slides.
pub(super) const fn stroke(help: &'static str) -> Key {
    may("stroke", pair(&LENGTH), help).such_as("[\"0 mm\", \"800 mm\"]")
}

/// Where keys belong that a part has not.
pub(super) const NO_INERTIA: &[(&str, &str)] = &[("inertia", "this part does not turn, so it has no moment of inertia")];
pub(super) const BALANCED: &[(&str, &str)] = &[("com", "this part is balanced: its centre of mass is on its axis")];

/// The words of the side on which a link lies.
pub(super) const RIGHT_LEFT: ValueForm = ValueForm::Words(&["right", "left"]);
pub(super) const LEFT_RIGHT: ValueForm = ValueForm::Words(&["left", "right"]);
