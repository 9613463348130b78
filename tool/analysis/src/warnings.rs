//! Possible mistakes in a machine file that can still be computed.

use jred::error::Error;

use jred_file::model::machine::MachineFile;

mod digits;
mod driving;
mod endless;
mod near_centre;
mod noise;
mod overshoot;
mod plausible;

/// Results that friction in joints is not part of.
const WITHOUT_FRICTION: &str = "friction by a coefficient in the joints follows the motion: curves over the position, speeds at which a follower \
    lifts off, emergency stops and torques at rest do not contain it, and `jred size` proposes no other time, masses or loads";

/// The warnings, in sentences.
///
/// # Errors
/// The mechanism cannot be placed somewhere in its range.
pub fn warnings(file: &MachineFile) -> Result<Vec<String>, Error> {
    let mut warnings = driving::of(file)?;
    warnings.extend(endless::of(file)?);
    warnings.extend(
        file.frictions_in_words()
            .next()
            .map(|_| WITHOUT_FRICTION.to_owned()),
    );
    warnings.extend(near_centre::of(file)?);
    warnings.extend(overshoot::of(file));
    warnings.extend(digits::of(file));
    warnings.extend(of_motion(file));
    warnings.extend(plausible::of(file)?);
    Ok(warnings)
}

/// Warnings about the prescribed motion only: noise and wrong rows of a recording, implausible speeds and accelerations.
pub fn of_motion(file: &MachineFile) -> impl Iterator<Item = String> {
    (noise::of(file).into_iter())
        .chain(noise::outlier(file))
        .chain(plausible::of_motion(file))
}
