//! Checks of a spring or damper over the whole range of the drive link.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::{Element, Mechanism as _};
use jred::number::Transfer;

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::number::numerics;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// Number of positions at which an element is checked.
const PLACES: u32 = 720;

/// Checks over the whole range of the drive link.
pub(super) struct Survey<'a> {
    pub(super) section: &'a Section<'a>,
    pub(super) between: &'a Item<'a>,
    pub(super) key: &'static str,
    pub(super) coordinate: Coordinate,
    pub(super) torsion: bool,
}

impl Survey<'_> {
    pub(super) fn check(&self, element: &Element, mechanism: &AnyMechanism) -> Result<()> {
        let length = |phi: f64| -> Result<Transfer> {
            let frames = mechanism
                .frames(phi)
                .map_err(|error| self.section.error(error, "in this mechanism"))?;
            Ok(element.length(&frames))
        };
        let domain = mechanism.domain();
        let step = 1.0 / f64::from(PLACES);
        let mut moves = false;
        let (mut longest, mut shortest, mut place) = (0.0_f64, f64::INFINITY, 0.0);
        for k in 0..=PLACES {
            let part = step * f64::from(k);
            let now = length(domain.position(part))?;
            // Where the points coincide exactly, the direction and so the slope is NaN.
            moves |= now.d1.is_nan() || now.d1.abs() > 1e-12;
            longest = longest.max(now.value.abs());
            if now.value < shortest {
                (shortest, place) = (now.value, part);
            }
        }
        if !moves {
            return Err(self.nothing());
        }
        if !self.torsion {
            let value = |part: f64| Ok(length(domain.position(part))?.value);
            let [low, high] = [(place - step).max(0.0), (place + step).min(1.0)];
            let phi = domain.position(numerics::least(value, low, high)?);
            if length(phi)?.value <= 1e-9 * longest {
                return Err(self.meets(phi));
            }
        }
        if domain == Domain::Turn {
            self.repeats(length)?;
        }
        Ok(())
    }

    fn nothing(&self) -> Problem {
        let what = if self.torsion { "angle" } else { "length" };
        self.between
            .problem(
                &format!("has ends whose {what} never changes: the {} does nothing", self.key),
                "does nothing",
            )
            .help(if self.torsion {
                "the two bodies never turn relative to each other: choose others, or give a spring along a line"
            } else {
                "the distance of the two points never changes: choose points that move, such as { on = \"crank\", at = [\"30 mm\", \"0 mm\"] }"
            })
    }

    fn meets(&self, phi: f64) -> Problem {
        self.between
            .problem(
                &format!(
                    "has ends that coincide at {}: the direction of the {} is undefined there",
                    self.coordinate.place(phi),
                    self.key
                ),
                "these points coincide",
            )
            .help("move one of the two points aside slightly")
    }

    /// Checks that the element has the same effect after each turn.
    fn repeats(&self, length: impl Fn(f64) -> Result<Transfer>) -> Result<()> {
        for phi in [0.4, 2.9, 5.1] {
            let (now, later) = (length(phi)?, length(phi + TAU)?);
            let (a, b) = match self.key {
                "spring" => (now.value, later.value),
                _ => (now.d1, later.d1),
            };
            if (a - b).abs() > 1e-9 * (1.0 + a.abs()) {
                let what = if self.torsion {
                    format!(
                        "is wound up by {} deg in every turn of the drive link",
                        ((later.value - now.value).to_degrees() * 1e3).round() / 1e3
                    )
                } else {
                    "has another length after a turn of the drive link".to_owned()
                };
                return Err(self
                    .between
                    .problem(&format!("names a {} that {what}", self.key), "does not repeat")
                    .help(
                        "every force must repeat with each turn of the drive link: attach it to bodies that return, or \
                         limit the drive with `stroke` if the mechanism has one",
                    ));
            }
        }
        Ok(())
    }
}
