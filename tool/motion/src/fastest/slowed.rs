//! Which limit that was asked for keeps the machine from taking the kinetic energy that would carry it through its load.

use super::NoMotion;
use super::field::{Binding, Field, Limits};
use super::sweep::{self, Obstacle};
use super::tool_speed::ToolSpeeds;
use super::track::{Ends, Track};

/// The first limit of speed or acceleration without which the machine does not stop; the first one that was asked for where it takes all of
/// them; `None`: it stops without them as well.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub(super) fn by(field: &Field, ends: &Ends, count: usize) -> Result<Option<Binding>, NoMotion> {
    let limits = field.limits;
    let none = ToolSpeeds::default();
    let asked = [
        (Binding::Speed, limits.speed.is_some()),
        (Binding::ToolSpeed, limits.tool != none),
        (Binding::Acceleration, limits.acceleration.is_some()),
    ];
    let asked: Vec<Binding> = asked
        .into_iter()
        .filter_map(|(limit, is_asked)| is_asked.then_some(limit))
        .collect();
    let passes = |without: &[Binding]| {
        let is_kept = |limit: Binding| !without.contains(&limit);
        let field = Field {
            way: field.way,
            limits: Limits {
                speed: limits.speed.filter(|_| is_kept(Binding::Speed)),
                tool: if is_kept(Binding::ToolSpeed) {
                    limits.tool
                } else {
                    none
                },
                acceleration: limits
                    .acceleration
                    .filter(|_| is_kept(Binding::Acceleration)),
                ..limits
            },
        };
        let track = Track::new(&field, ends, count, &[])?;
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
