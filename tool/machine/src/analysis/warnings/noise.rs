//! A recorded motion whose noise is a part of its acceleration.

use crate::model::coordinate::Coordinate;
use crate::model::machine::MachineFile;
use crate::model::motion::ToolCoordinate;
use crate::number::rounding::significant;

/// Share of the acceleration, both RMS, from which on noise is named.
const NOISY: f64 = 0.1;

/// A warning for a recording whose curve goes through the noise of its rows.
pub(super) fn of(file: &MachineFile) -> Option<String> {
    let motion = file.motion.as_ref()?;
    let noise = motion.noise()?;
    let share = noise.acceleration / noise.of_acceleration;
    if share.is_nan() || share < NOISY {
        return None;
    }
    let drive = file.machine.mechanism().coordinate();
    let coordinate = motion.tool().map_or(drive, ToolCoordinate::coordinate);
    let (unit, si) = (
        coordinate.unit(),
        match coordinate {
            Coordinate::Angle => "rad",
            Coordinate::Length => "m",
        },
    );
    let short = |x: f64| significant(x, 2);
    let (what, rows, speed) = if noise.of_speeds {
        (
            "speeds",
            format!("{} {si}/s", short(noise.rows)),
            String::new(),
        )
    } else {
        let rows = format!("{} {unit}", short(coordinate.shown(noise.rows)));
        let speed = format!("{} {si}/s in the speed and ", short(noise.speed));
        ("positions", rows, speed)
    };
    let cure = motion.quiet_cutoff(&noise).map_or_else(
        || "no `smoothing` keeps this motion: record it with finer values, or write the motion as segments".to_owned(),
        |cutoff| {
            format!(
                "write smoothing = \"{} Hz\" in [motion], or a lower frequency that is well above those of the motion",
                short(cutoff)
            )
        },
    );
    Some(format!(
        "the recorded {what} have noise of about {rows} (RMS), which makes {speed}{} {si}/s^2 in the acceleration, {} % of the acceleration \
         itself; torques and energies are those of the noise: {cure}",
        short(noise.acceleration),
        short(100.0 * share.min(1.0))
    ))
}
