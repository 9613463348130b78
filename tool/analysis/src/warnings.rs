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

/// The warnings, in sentences.
///
/// # Errors
/// The mechanism cannot be placed somewhere in its range.
pub fn warnings(file: &MachineFile) -> Result<Vec<String>, Error> {
    let mut warnings = driving::of(file)?;
    warnings.extend(endless::of(file)?);
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
