//! The motor of `[simulation]`: its torque or force over the speed.

use super::DriveLink;
use crate::model::characteristic::Characteristic;
use crate::model::simulation::Winding;
use crate::number::rounding::{percent, short};
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::text::value::Value;

/// Motor data of a file.
pub(super) struct MotorModel {
    /// Torque over speed at steady current.
    pub(super) characteristic: Characteristic,
    /// The winding, if the current has a time constant, with its place in the file.
    pub(super) winding: Option<(Winding, Value)>,
}

impl MotorModel {
    const fn of(characteristic: Characteristic) -> Self {
        Self {
            characteristic,
            winding: None,
        }
    }
}

/// The torque or force over the speed; `None` if not given, for the torque of a drive.
pub(super) fn effort(
    section: &Section,
    [key, curve_key]: [&'static str; 2],
    drive: DriveLink,
    [speed, most]: [&str; 2],
) -> Result<Option<MotorModel>> {
    let no_speed = format!("0 {}", drive.speed().unit);
    let no_effort = format!("0 {}", drive.effort().unit);
    let example = format!("[[\"{no_speed}\", \"{most}\"], [\"{speed}\", \"{no_effort}\"]]");
    // Only rotary motors have a formula.
    let formulas: &[&'static str] = if drive.slides() {
        &[]
    } else {
        &["dc_motor", "induction_motor"]
    };
    let keys: Vec<&str> = [key, curve_key].iter().chain(formulas).copied().collect();
    let Some((found, item)) = section.one_of(&keys) else {
        return Ok(None);
    };
    Ok(Some(match found {
        "dc_motor" => dc_motor(&item)?,
        "induction_motor" => MotorModel::of(induction_motor(&item)?),
        found if found == key => MotorModel::of(Characteristic::constant(item.value()?.si)),
        _ => MotorModel::of(Characteristic::Points(points(&item, drive, &example)?)),
    }))
}

/// A DC motor: its line, or its winding.
fn dc_motor(item: &Item) -> Result<MotorModel> {
    let section = item.section("[simulation.dc_motor]".into())?;
    if section.peek("voltage").is_some() {
        return wound(&section);
    }
    let (speed, torque) = (
        section.value("no_load_speed")?,
        section.value("stall_torque")?,
    );
    section.finish()?;
    same_way(&speed, &torque)?;
    Ok(MotorModel::of(Characteristic::Dc {
        no_load_speed: speed.si,
        stall_torque: torque.si,
    }))
}

/// A DC motor from its winding: T_stall = k·U/R, ω₀ = U/k.
fn wound(section: &Section) -> Result<MotorModel> {
    let (voltage, resistance) = (section.value("voltage")?, section.value("resistance")?.si);
    let constant = section.value("torque_constant")?.si;
    let inductance = section.given("inductance")?;
    section.finish()?;
    if voltage.si == 0.0 {
        return Err(voltage
            .problem("is zero, and drives nothing", "this voltage")
            .help("give the voltage at the terminals; a negative one turns the motor backwards"));
    }
    let winding = match inductance {
        None => None,
        Some(value) => {
            let winding = Winding {
                voltage: voltage.si,
                resistance,
                inductance: value.si,
                constant,
            };
            Some((winding, value))
        }
    };
    Ok(MotorModel {
        characteristic: Characteristic::Dc {
            no_load_speed: voltage.si / constant,
            stall_torque: constant * voltage.si / resistance,
        },
        winding,
    })
}

/// An induction motor by Kloss' formula.
fn induction_motor(item: &Item) -> Result<Characteristic> {
    let section = item.section("[simulation.induction_motor]".into())?;
    let speed = section.value("synchronous_speed")?;
    let torque = section.value("breakdown_torque")?;
    same_way(&speed, &torque)?;
    let plate = name_plate(&section, &speed, &torque)?;
    let slip = match (section.get("breakdown_slip"), plate) {
        (None, Some(slip)) => {
            section.finish()?;
            return Ok(Characteristic::Induction {
                breakdown_torque: torque.si,
                breakdown_slip: slip,
                synchronous_speed: speed.si,
            });
        }
        (Some(slip), _) => slip.value()?,
        (None, None) => {
            let example = "breakdown_slip = \"20 %\", or rated_speed = \"950 rpm\" and rated_power = \"2.2 kW\" of the name plate";
            return Err(section.missing("breakdown_slip", example));
        }
    };
    section.finish()?;
    if !(slip.si > 0.0 && slip.si <= 1.0) {
        let what = format!("is {}, but must be above 0 % and up to 100 %", slip.shown());
        return Err(slip
            .problem(&what, "no slip of breakdown")
            .help("10 % to 40 % is usual, such as breakdown_slip = \"20 %\""));
    }
    Ok(Characteristic::Induction {
        breakdown_torque: torque.si,
        breakdown_slip: slip.si,
        synchronous_speed: speed.si,
    })
}

/// The breakdown slip from the name plate. With the rated torque T_n at the slip s_n and k = T_b/T_n, Kloss' formula gives s_b = s_n·(k + √(k² − 1)).
fn name_plate(section: &Section, synchronous: &Value, breakdown: &Value) -> Result<Option<f64>> {
    let (torque, power) = (
        section.given("rated_torque")?,
        section.given("rated_power")?,
    );
    let Some(speed) = section.given("rated_speed")? else {
        return match torque.or(power) {
            None => Ok(None),
            Some(_) => Err(section.lacks("rated_speed")),
        };
    };
    let (given, rated) = match (torque, power) {
        (Some(torque), _) => {
            let si = torque.si;
            (torque, si)
        }
        (None, Some(power)) => {
            let si = power.si / speed.si;
            (power, si)
        }
        (None, None) => {
            let example = "rated_power = \"2.2 kW\", or rated_torque";
            return Err(section.missing("rated_power", example));
        }
    };
    let slip = 1.0 - speed.si / synchronous.si;
    if !(slip > 0.0 && slip < 1.0) {
        let what = format!(
            "is {} with a synchronous speed of {}: it must lie between zero and that",
            speed.shown(),
            synchronous.shown()
        );
        return Err(speed
            .problem(&what, "of the name plate")
            .at(synchronous.span(), "synchronous speed")
            .help("the synchronous speed is 60·f/p rpm with p pairs of poles, such as 1000 rpm at 50 Hz and p = 3"));
    }
    let excess = breakdown.si / rated;
    let implausible = |what: &str, help: &str| {
        let problem = given.problem(what, "of the name plate");
        Err(problem
            .at(breakdown.span(), "breakdown torque")
            .help(help.to_owned()))
    };
    let usual = "the breakdown torque is 1.6 to 3.5 times the rated torque, and the breakdown slip below 100 %";
    if !(excess > 0.0 && excess.is_finite()) {
        let what = format!(
            "gives a rated torque of {} with a breakdown torque of {}: they must have the same sign and not be zero",
            breakdown.show(rated),
            breakdown.shown()
        );
        return implausible(
            &what,
            "a rated power is positive; a rated torque has the sign of the breakdown torque",
        );
    }
    if excess <= 1.0 {
        let what = format!(
            "gives a rated torque of {}, but it must be smaller than the breakdown torque, {}",
            breakdown.show(rated),
            breakdown.shown()
        );
        return implausible(&what, usual);
    }
    let breakdown_slip = slip * (excess + (excess * excess - 1.0).sqrt());
    if breakdown_slip > 1.0 {
        let what = format!(
            "gives a breakdown torque of {} times the rated one, and a breakdown slip of {}",
            short(excess),
            percent(breakdown_slip)
        );
        return implausible(&what, usual);
    }
    Ok(Some(breakdown_slip))
}

/// Refuses a motor whose torque does not drive it towards its own speed.
fn same_way(speed: &Value, torque: &Value) -> Result<()> {
    if speed.si * torque.si > 0.0 {
        return Ok(());
    }
    let what = format!(
        "is {} with a speed of {}: they must have the same sign and not be zero",
        torque.shown(),
        speed.shown()
    );
    Err(torque
        .problem(&what, "torque")
        .at(speed.span(), "speed")
        .help("give both positive; both negative for a motor that runs backwards"))
}

fn points(curve: &Item, drive: DriveLink, example: &str) -> Result<Vec<(f64, f64)>> {
    let list = curve.list("point", example)?;
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(list.len());
    for item in list {
        let [speed, effort] = item.pair([drive.speed(), drive.effort()])?;
        if let Some((before, _)) = points.last().filter(|(before, _)| speed.si <= *before) {
            let what = format!(
                "is {}, but must be greater than the speed of the previous point, {}",
                speed.shown(),
                speed.show(*before)
            );
            return Err(speed
                .problem(&what, "not increasing")
                .help("sort the points by increasing speed"));
        }
        points.push((speed.si, effort.si));
    }
    Ok(points)
}
