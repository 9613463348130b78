//! Writes a motion as a profile and as an electronic cam.

use miette::Result;

use crate::commands::profile_written;
use crate::options::series::SeriesFiles;
use crate::output::Files;
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
        let cam = Cam {
            title: &file.title,
            rows: &trace.cam(options.rows as usize, options.master),
            master: options.master.word(),
            position: [coordinate.pick("phi", "s"), coordinate.unit()],
            turn: coordinate.pick(Some(coordinate.shown(std::f64::consts::TAU)), None),
        };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let text = cam.text(options.cam_form, &name)?;
        files.add(path, text.as_bytes())?;
        let usual = options.cam_form.usual();
        let more = usual.filter(|(most, _)| cam.rows.len() > *most);
        let more = more.map_or_else(String::new, |(most, words)| {
            format!("; {words}: or use --rows {most}")
        });
        written.push(format!("cam table written to {}{more}", plain::path(path)));
    }
    Ok(written)
}
