//! Writes a motion as a profile and as an electronic cam.

use miette::Result;

use crate::commands::profile_written;
use crate::options::series::SeriesFiles;
use crate::output::Files;
use crate::terminal;
use jred_export::Cam;
use jred_file::model::machine::MachineFile;
use jred_file::plain;
use jred_motion::trace::Trace;

/// Writes the files of a motion in the coordinate of the axis; returns sentences about them.
///
/// # Errors
/// A cam table that the maker's program does not take, or a file that cannot be written.
pub(super) fn write(
    options: &SeriesFiles,
    file: &MachineFile,
    trace: &Trace,
    files: &mut Files,
) -> Result<Vec<String>> {
    let mut written = Vec::new();
    if let Some(path) = &options.profile {
        files.add(path, trace.profile().as_bytes())?;
        written.push(profile_written(file, path));
    }
    if let Some(path) = &options.cam {
        let coordinate = trace.coordinate;
        let form = options.cam_form;
        let rows = options.rows.unwrap_or(form.usual_rows()) as usize;
        let cam = Cam {
            title: &file.title,
            rows: &trace.cam(rows, options.master),
            master: options.master.word(),
            position: [coordinate.pick("phi", "s"), coordinate.unit()],
            turn: coordinate.pick(Some(coordinate.shown(std::f64::consts::TAU)), None),
        };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let text = cam.text(form, &name)?;
        if let Some(warning) = form.excess(rows) {
            terminal::warn(&warning);
        }
        let named = form.name(&name).and_then(|cam| cam.changed(&name));
        let named = named.unwrap_or_default();
        files.add(path, text.as_bytes())?;
        written.push(format!("cam table written to {}{named}", plain::path(path)));
    }
    Ok(written)
}
