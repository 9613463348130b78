//! A slide with limited travel whose motion advances with every cycle.

use jred::error::Error;
use jred::machine::Mechanism as _;
use jred_file::math;

use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::short;

/// Share of the travel per cycle that is rounding.
const ROUNDING: f64 = 1e-9;

/// A warning for a cycle after which the slide is not back, if the end of its travel is not given.
pub(super) fn of(file: &MachineFile) -> Result<Option<String>, Error> {
    let mechanism = file.machine.mechanism();
    let (Some(link), Some(motion)) = (mechanism.open_end(), &file.motion) else {
        return Ok(None);
    };
    if !motion.cyclic {
        return Ok(None);
    }
    let ends = [0.0, motion.duration()].map(|t| mechanism.frames(motion.at(t).phi));
    let [start, end] = [ends[0].clone()?, ends[1].clone()?];
    let (Some(a), Some(b)) = (start.get(link), end.get(link)) else {
        return Ok(None);
    };
    let way = (b.x.value - a.x.value) + (b.y.value - a.y.value);
    let [speed, _] = motion.drive_peaks();
    let most = speed * motion.duration() * math::hypot(a.x.d1, a.y.d1);
    if way.abs() <= ROUNDING * most {
        return Ok(None);
    }
    let name = mechanism.link_names().get(link).map_or("", String::as_str);
    let [way, unit] = [
        short(Coordinate::Length.shown(way)),
        Coordinate::Length.unit().to_owned(),
    ];
    Ok(Some(format!(
        "the {name} goes on by {way} {unit} with every cycle and never comes back: if its way ends, add the move back, and \
         stroke = [\"…\", \"…\"] in [mechanism], its two ends"
    )))
}
