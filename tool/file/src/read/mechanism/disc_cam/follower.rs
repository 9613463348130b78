//! The follower's geometry, of a disc cam and of a cam in a linkage.

use jred::mechanism::{Follower, Roller, Swing};

use crate::keys::cam::FOLLOWERS;
use crate::text::problem::Result;
use crate::text::section::Section;

/// The follower; its `roller` is read if it has one. Other keys of the section may follow.
pub(in crate::read::mechanism) fn follower(
    section: &Section,
    roller: impl FnOnce() -> Result<Roller>,
) -> Result<Follower> {
    let kind = section.word("type")?;
    section.choose(FOLLOWERS[kind]);
    let roller = (kind % 2 == 0).then(roller).transpose()?;
    if kind < 2 {
        let offset = section.si("offset")?;
        return Ok(match roller {
            Some(roller) => Follower::TranslatingRoller { offset, roller },
            None => Follower::TranslatingFace { offset },
        });
    }
    let pivot = section.two("pivot")?;
    let swing = section.pick("swing", [Swing::CounterClockwise, Swing::Clockwise])?;
    Ok(match roller {
        Some(roller) => Follower::OscillatingRoller {
            pivot,
            arm: section.si("arm")?,
            swing,
            roller,
        },
        None => Follower::OscillatingFace {
            pivot,
            offset: section.si("offset")?,
            swing,
        },
    })
}
