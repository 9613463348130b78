//! The one drive that a command is about.

use miette::{Result, miette};

use crate::options::drive::OneDrive;
use jred_machine::model::machine::MachineFile;
use jred_machine::number::words::counted;
use jred_sizing::catalogue::{Catalogue, Drive};
use jred_sizing::select::fit::fit_input;

/// The catalogue of the options, with what fits the input of the machine; `None`: no drive is named.
///
/// # Errors
/// Files that cannot be used; no motor of the kind that the input needs.
pub(super) fn catalogue(options: &OneDrive, file: &MachineFile) -> Result<Option<Catalogue>> {
    if options.motor.is_none() {
        return Ok(None);
    }
    let mut catalogue = options.catalogue.open()?;
    fit_input(&mut catalogue, file)?;
    Ok(Some(catalogue))
}

/// The drive of these keys.
///
/// # Errors
/// A key that the catalogue does not have, or two that it does not combine.
pub(super) fn named<'c>(options: &OneDrive, catalogue: &'c Catalogue) -> Result<Drive<'c>> {
    let is = |key: &str, wanted: &str| key.eq_ignore_ascii_case(wanted);
    let motor = options.motor.as_deref().unwrap_or_default();
    let (index, _) = (catalogue.motors.iter().enumerate())
        .find(|(_, own)| is(&own.key, motor))
        .ok_or_else(|| {
            miette!(
                help = "`jred size` lists drives by the keys of motor and gearbox; --catalogue names another catalogue",
                "no motor for this machine has the key {motor:?}; the catalogue has {}",
                counted(catalogue.motors.len(), "motor", "motors")
            )
        })?;
    let wanted = options.gearbox.as_deref();
    if let Some(gearbox) = wanted
        && !catalogue.gearboxes.iter().any(|own| is(&own.key, gearbox))
    {
        return Err(miette!(
            help = "`jred size` lists drives by the keys of motor and gearbox",
            "no gearbox of the catalogue has the key {gearbox:?}"
        ));
    }
    let mut drives = catalogue.drives_of(index..index + 1);
    let found = drives.find(|(_, drive)| match (drive.gearbox, wanted) {
        (Some(own), Some(wanted)) => is(&own.key, wanted),
        (None, None) => true,
        _ => false,
    });
    let (_, drive) = found.ok_or_else(|| match wanted {
        Some(gearbox) => miette!(
            help = "docs/catalogue.md says which motors and gearboxes are combined",
            "the catalogue does not combine the motor {motor:?} with the gearbox {gearbox:?}"
        ),
        None => miette!(
            help = "add --gearbox KEY",
            "the catalogue does not couple the motor {motor:?} directly"
        ),
    })?;
    Ok(drive)
}
