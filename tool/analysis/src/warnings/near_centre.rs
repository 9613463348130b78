//! A motion of the tool that comes close to a dead centre, where the drive link moves far for little travel of the tool.

use jred::Domain;
use jred::error::Error;
use jred::machine::Mechanism as _;

use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::short;

/// Instants that are evaluated.
const STEPS: usize = 720;

/// Share of the largest transfer function on the branch below which a motion is close to a dead centre.
const CLOSE: f64 = 0.05;

/// A warning for a motion of the tool whose transfer function becomes small.
pub(super) fn of(file: &MachineFile) -> Result<Option<String>, Error> {
    let Some((motion, tool)) = (file.motion.as_ref()).and_then(|m| Some((m, m.tool()?))) else {
        return Ok(None);
    };
    let Some(ends) = tool.ends() else {
        return Ok(None);
    };
    let at_end = |phi: f64| match file.machine.mechanism().domain() {
        Domain::Turn => false,
        Domain::Stroke { from, to } => (phi - from).min(to - phi) <= CLOSE * (to - from),
    };
    let mut most = 0.0f64;
    for k in 0..=STEPS {
        let share = k as f64 / STEPS as f64;
        let phi = ends[0][0] + share * (ends[1][0] - ends[0][0]);
        most = most.max(tool.at(phi)?.d1.abs());
    }
    let mut least: Option<(f64, f64, f64)> = None;
    for reach in motion.reaches().iter().filter(|reach| !reach.of_drive) {
        let phi = tool.drive_at(reach.position);
        let slope = tool.at(phi)?.d1.abs();
        if least.is_none_or(|(so_far, ..)| slope < so_far) {
            least = Some((slope, phi, reach.position));
        }
    }
    let Some((slope, phi, position)) = least.filter(|(slope, ..)| *slope < CLOSE * most) else {
        return Ok(None);
    };
    let nearest = ends.into_iter().filter(|[phi, _]| !at_end(*phi));
    let nearest =
        nearest.min_by(|a, b| (a[1] - position).abs().total_cmp(&(b[1] - position).abs()));
    let Some([_, centre]) = nearest else {
        return Ok(None);
    };
    let (coordinate, drive) = (tool.coordinate(), file.machine.mechanism().coordinate());
    let distance = coordinate.shown((position - centre).abs());
    let per = drive.shown(1.0) / coordinate.shown(1.0) / slope;
    Ok(Some(format!(
        "{} comes within {} {} of its dead centre, at {}; there the drive link goes {} {} for {} of it, {} times as far as where \
         it moves fastest: play and errors of position grow as much",
        tool.name(),
        short(distance),
        coordinate.unit(),
        drive.place(phi),
        short(per),
        drive.unit(),
        coordinate.pick("1 deg", "1 mm"),
        short(most / slope),
    )))
}
