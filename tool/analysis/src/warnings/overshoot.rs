//! A segment whose law goes beyond the end of its move and comes back, or first moves the other way.

use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Overshoot;

/// Share of the move below which this is ignored.
const NEGLIGIBLE: f64 = 1e-6;

/// A warning for each segment that turns back although no key of it requires that.
pub(super) fn of(file: &MachineFile) -> Vec<String> {
    let Some(motion) = &file.motion else {
        return Vec::new();
    };
    let drive = file.machine.mechanism().coordinate();
    let all = motion.overshoots().into_iter();
    let seen = all.filter(|overshoot| overshoot.back > NEGLIGIBLE * overshoot.distance);
    seen.map(|overshoot| format!("{}: {}", overshoot.says(motion, drive), cure(&overshoot)))
        .collect()
}

fn cure(overshoot: &Overshoot) -> &'static str {
    match overshoot.pushed {
        [true, true] => {
            "its accelerations at rest are against its start and its end; write start_acceleration and end_acceleration of zero"
        }
        [true, false] => {
            "it starts at rest with an acceleration against its move; write a start_acceleration of zero"
        }
        [false, true] => {
            "it comes to rest with an acceleration in the direction of its move; write an end_acceleration of zero"
        }
        [false, false] => {
            "the speed at its ends is too high for so long a time; give it a shorter duration or a longer move"
        }
    }
}
