//! The given limit that denies the machine the kinetic energy to pass its load.

use super::NoMotion;
use super::field::{Binding, Field, MoveLimits};
use super::sweep::{self, Obstacle};
use super::tool_speed::ToolSpeeds;
use super::track::{Ends, Survey, Track};

/// A limit that an option sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SettableLimit {
    /// Speed of the drive link.
    Speed,
    /// Speed of the tool.
    ToolSpeed,
    /// Acceleration.
    Acceleration,
}

impl SettableLimit {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Speed => Binding::Speed.name(),
            Self::ToolSpeed => Binding::ToolSpeed.name(),
            Self::Acceleration => Binding::Acceleration.name(),
        }
    }

    /// The option that sets it.
    pub const fn option(self) -> &'static str {
        match self {
            Self::Speed => "--max-speed",
            Self::ToolSpeed => "--max-tool-speed",
            Self::Acceleration => "--max-acceleration",
        }
    }
}

/// The first limit of speed or acceleration without which the machine does not stop. If only removing all of them helps, the first given one; `None`
/// if the machine stops even without them.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub(super) fn by(
    field: &Field,
    ends: &Ends,
    count: usize,
) -> Result<Option<SettableLimit>, NoMotion> {
    let limits = field.limits;
    let none = ToolSpeeds::default();
    let asked = [
        (SettableLimit::Speed, limits.speed.is_some()),
        (SettableLimit::ToolSpeed, limits.tool != none),
        (SettableLimit::Acceleration, limits.acceleration.is_some()),
    ];
    let asked: Vec<SettableLimit> = asked
        .into_iter()
        .filter_map(|(limit, is_asked)| is_asked.then_some(limit))
        .collect();
    let passes = |without: &[SettableLimit]| {
        let is_kept = |limit: SettableLimit| !without.contains(&limit);
        let field = Field {
            dynamics: field.dynamics,
            limits: MoveLimits {
                speed: limits.speed.filter(|_| is_kept(SettableLimit::Speed)),
                tool: if is_kept(SettableLimit::ToolSpeed) {
                    limits.tool
                } else {
                    none
                },
                acceleration: limits
                    .acceleration
                    .filter(|_| is_kept(SettableLimit::Acceleration)),
                ..limits
            },
        };
        let track = Track::new(&Survey::new(&field, ends.from), ends, count, &[])?;
        let found = sweep::fastest(&field, &track, ends.speeds.map(|v| 0.5 * v * v));
        Ok::<_, NoMotion>(!matches!(found, Err(Obstacle::Stops(..))))
    };
    for limit in &asked {
        if passes(&[*limit])? {
            return Ok(Some(*limit));
        }
    }
    Ok(if asked.len() > 1 && passes(&asked)? {
        asked.first().copied()
    } else {
        None
    })
}
