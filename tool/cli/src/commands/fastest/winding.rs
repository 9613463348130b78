//! `--max-winding-temperature`.

use miette::{Result, miette};

use super::DriveInput;
use crate::options::fastest::Fastest as Options;
use crate::terminal;
use jred_file::argument;
use jred_file::number::rounding::short;
use jred_file::plain;
use jred_motion::fastest::winding::{UnknownTemperature, Winding};
use jred_sizing::catalogue::MotorKind;

/// The winding whose temperature is limited, and the limit (°C).
///
/// # Errors
/// A limit below the ambient temperature, or a motor without thermal data.
pub(super) fn limit<'a>(
    options: &Options,
    chosen: &'a DriveInput,
) -> Result<Option<(&'a Winding, f64)>> {
    let Some(text) = &options.max_winding_temperature else {
        return Ok(None);
    };
    let given = format!("--max-winding-temperature {}", plain::quoted(text));
    let limit = argument::any(&jred_file::units::kind::TEMPERATURE)(text)
        .map_err(|why| miette!("{given} cannot be used: {why}"))?;
    let Some(winding) = &chosen.winding else {
        return Err(miette!(
            help = "name a motor of the catalogue with --drive, or limit the RMS torque with --max-rms",
            "{given} cannot be used: a motor given by --torque has no thermal data"
        ));
    };
    let ambient = winding.ambient();
    if limit <= ambient {
        return Err(miette!(
            help = "give a temperature above it, or change `ambient` in [surroundings] of the machine file",
            "{given} cannot be used: the ambient temperature is {} °C",
            short(ambient)
        ));
    }
    winding.known().map_err(|unknown| {
        let missing = match unknown {
            UnknownTemperature::Figures(sentence) => sentence(MotorKind::Rotary.vocabulary()),
            UnknownTemperature::RatedRise => "maximum temperature of the winding (max_winding_temperature), or its resistance, torque constant and thermal resistances".to_owned(),
        };
        miette!(
            help = "fill them in in the catalogue (docs/catalogue.md), or limit the RMS torque with --max-rms",
            "{given} cannot be used: {} lacks {missing}",
            chosen.name
        )
    })?;
    if let Some(maximum) = winding.maximum().filter(|maximum| limit > *maximum) {
        terminal::say(&format!(
            "warning: {given} is above the {} °C that the winding of {} withstands (max_winding_temperature of the catalogue)",
            short(maximum),
            chosen.name
        ));
    }
    Ok(Some((winding, limit)))
}
