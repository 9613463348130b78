//! A segment so short within a long motion that its times have few digits left.

use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::short;

/// Share of a segment from which rounding of its times is reported.
const LEAST_SHARE: f64 = 1e-5;

/// A warning for each segment whose times are rounded.
pub(super) fn of(file: &MachineFile) -> Vec<String> {
    let Some(motion) = &file.motion else {
        return Vec::new();
    };
    let end = motion.duration();
    let rounding = f64::EPSILON * end;
    let courses = motion.courses().into_iter();
    let rounded = courses.filter(|course| rounding > LEAST_SHARE * course.duration);
    rounded
        .map(|course| {
            format!(
                "segment {} lasts {} s in a motion of {} s: its times are rounded by {} of it, and so are its speeds and torques; describe it in \
                 a motion of its own, or shorten the pauses",
                course.segment + 1,
                short(course.duration),
                short(end),
                short(rounding / course.duration)
            )
        })
        .collect()
}
