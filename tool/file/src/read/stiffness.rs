//! `[stiffness]`: stiffness of the shafts between gearbox and machine, and backlash of the drive train.

use super::drive_link::DriveLink;
use crate::model::drive_train::DriveTrain;
use crate::text::problem::Result;
use crate::text::section::Section;

/// Values of the section.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stiffness {
    /// Stiffness of the shafts, at the input of the drive train (N·m/rad).
    pub(super) shaft: Option<f64>,
    /// Backlash of the drive train, at the drive link (rad or m).
    pub(super) play: Option<f64>,
}

/// The section, if the file has it.
pub(super) fn read(root: &Section, drive: DriveLink, train: &DriveTrain) -> Result<Stiffness> {
    let Some(section) = root.maybe_table("stiffness")? else {
        return Ok(Stiffness::default());
    };
    let at_input = section.word("at")? == 0;
    section.set_slides(drive.slides() && (!at_input || train.stages().is_empty()));
    let (shaft, play) = (section.maybe("shaft")?, section.maybe("backlash")?);
    section.finish()?;
    if shaft.is_none() && play.is_none() {
        return Err(section
            .problem("[stiffness] gives neither `shaft` nor `backlash`", "empty")
            .help(
                "add shaft = \"12 kN m/rad\" or backlash = \"0.05 deg\", or remove the section",
            ));
    }
    let ratio = train.ratio().abs();
    Ok(Stiffness {
        // ½·c·θ² is equal at both ends.
        shaft: shaft.map(|c| if at_input { c } else { c / (ratio * ratio) }),
        play: play.map(|play| if at_input { play / ratio } else { play }),
    })
}
