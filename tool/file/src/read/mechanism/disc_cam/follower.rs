//! The follower's geometry, of a disc cam and of a cam in a linkage.

use jred::mechanism::{Follower, Roller, Swing};

use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::LENGTH;

/// The kinds of follower.
const FOLLOWERS: [&str; 4] = [
    "translating-roller",
    "translating-flat-face",
    "oscillating-roller",
    "oscillating-flat-face",
];

/// The follower; its `roller` is read if it has one. Other keys of the section may follow.
pub(in crate::read::mechanism) fn follower(
    section: &Section,
    roller: impl FnOnce() -> Result<Roller>,
) -> Result<Follower> {
    let kind = section
        .require("type", "type = \"translating-roller\"")?
        .choice(&FOLLOWERS)?;
    let roller = (kind % 2 == 0).then(roller).transpose()?;
    if kind < 2 {
        let offset = section.optional("offset", &LENGTH)?.map_or(0.0, |v| v.si);
        return Ok(match roller {
            Some(roller) => Follower::TranslatingRoller { offset, roller },
            None => Follower::TranslatingFace { offset },
        });
    }
    let pivot = section
        .require("pivot", "pivot = [\"90 mm\", \"0 mm\"]")?
        .pair([&LENGTH, &LENGTH])?
        .map(|value| value.si);
    let swing = section
        .require("swing", "swing = \"counter-clockwise\"")?
        .choice(&["counter-clockwise", "clockwise"])?;
    let swing = [Swing::CounterClockwise, Swing::Clockwise][swing];
    Ok(match roller {
        Some(roller) => Follower::OscillatingRoller {
            pivot,
            arm: section.quantity("arm", &LENGTH)?.positive()?,
            swing,
            roller,
        },
        None => Follower::OscillatingFace {
            pivot,
            offset: section.optional("offset", &LENGTH)?.map_or(0.0, |v| v.si),
            swing,
        },
    })
}
