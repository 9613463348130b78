//! A recorded motion whose noise is a part of its acceleration, or with a wrong row.

use super::plausible::prescribed;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Outlier;
use jred_file::number::rounding::significant;

/// Share of the acceleration, both RMS, from which noise is reported.
const NOISY: f64 = 0.1;

/// A warning for a recording with an outlier row.
pub(super) fn outlier(file: &MachineFile) -> Option<String> {
    let Outlier {
        row,
        t,
        of_speeds,
        by,
        accelerations: [near, elsewhere],
    } = file.motion.as_ref()?.outlier()?;
    let (coordinate, si) = prescribed(file)?;
    let short = |x: f64| significant(x, 3);
    let (what, by) = if of_speeds {
        ("speed", format!("{} {si}/s", short(by.abs())))
    } else {
        let shown = short(coordinate.shown(by.abs()));
        ("position", format!("{shown} {}", coordinate.unit()))
    };
    let place = if row == 0 {
        "the first row, at which the cycle closes,".to_owned()
    } else {
        format!("row {}, {} s after the first,", row + 1, short(t))
    };
    Some(format!(
        "{place} has a {what} {by} off the curve through its neighbours; there the acceleration reaches {} {si}/s^2, elsewhere {} {si}/s^2, and torques \
         follow it: remove the row, or cut the recording where position and speed match",
        short(near),
        short(elsewhere)
    ))
}

/// A warning for a recording whose curve follows the noise of its rows.
pub(super) fn of(file: &MachineFile) -> Option<String> {
    let motion = file.motion.as_ref()?;
    let noise = motion.noise()?;
    let share = noise.acceleration / noise.of_acceleration;
    if share.is_nan() || share < NOISY {
        return None;
    }
    let (coordinate, si) = prescribed(file)?;
    let unit = coordinate.unit();
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
        || "the motion itself hardly accelerates more than what is left of the noise: write a low frequency as `smoothing`, record finer values, or write the motion as segments".to_owned(),
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
