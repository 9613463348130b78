//! The given limit that denies the machine the kinetic energy to pass its load.

use super::NoMotion;
use super::field::{Binding, Field, MoveLimits};
use super::sweep::{self, Obstacle};
use super::track::{Ends, Survey, Track};

/// The option that sets such a limit.
pub(super) const fn option(limit: Binding) -> &'static str {
    match limit {
        Binding::Speed => "--max-speed",
        Binding::ToolSpeed => "--max-tool-speed",
        _ => "--max-acceleration",
    }
}

/// The first limit of speed or acceleration without which the machine does not stop. If only removing all of them helps, the first given one; `None`
/// if the machine stops even without them.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub(super) fn by(field: &Field, ends: &Ends, count: usize) -> Result<Option<Binding>, NoMotion> {
    let limits = &field.limits;
    let given = [
        (Binding::Speed, limits.speed.is_some()),
        (Binding::ToolSpeed, limits.tool.is_some()),
        (Binding::Acceleration, limits.acceleration.is_some()),
    ];
    let given = given.into_iter().filter(|(_, is_given)| *is_given);
    let given: Vec<Binding> = given.map(|(limit, _)| limit).collect();
    let passes = |without: &[Binding]| {
        let field = Field {
            dynamics: field.dynamics,
            limits: without.iter().copied().fold(*limits, MoveLimits::without),
        };
        let track = Track::new(&Survey::new(&field, ends.from), ends, count, &[])?;
        let found = sweep::fastest(&field, &track, ends.speeds.map(|v| 0.5 * v * v));
        Ok::<_, NoMotion>(!matches!(found, Err(Obstacle::Stops(..))))
    };
    for limit in &given {
        if passes(&[*limit])? {
            return Ok(Some(*limit));
        }
    }
    Ok(if given.len() > 1 && passes(&given)? {
        given.first().copied()
    } else {
        None
    })
}
