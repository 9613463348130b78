//! `[simulation.control]`, `[simulation.stop]` and `[simulation.end_stops]`.

use crate::model::axis::Axis;
use crate::model::characteristic::Characteristic;
use crate::model::drive_train::DriveTrain;
use crate::model::motion::Motion;
use crate::model::simulation::{Control, EndStops, FeedForward, Halt, Shaft};

use super::place::{AxisReader, AxisValue};
use crate::number::rounding::figure;
use crate::read::drive_link::DriveLink;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, LENGTH};

/// The most cycles of a simulation: each adds corners of the motion.
const MOST_CYCLES: f64 = 1000.0;

/// Context of the parts of a simulation.
#[derive(Clone, Copy)]
pub(in crate::read) struct SimulationContext<'a> {
    pub(in crate::read) drive: DriveLink,
    pub(in crate::read) axis: Axis,
    pub(in crate::read) drive_train: &'a DriveTrain,
    pub(in crate::read) motion: Option<&'a Motion>,
    pub(in crate::read) variator: bool,
}

impl SimulationContext<'_> {
    /// Whether the motor acts as a force on a link that slides.
    fn pushes(&self) -> bool {
        self.drive.slides() && self.drive_train.stages().is_empty()
    }

    /// A part that is not allowed in a machine with a variator.
    fn part<'a>(&self, item: &Item<'a>, title: &str) -> Result<Section<'a>> {
        if self.variator {
            return Err(item
                .problem("cannot be used with a [variator]", "here")
                .help("a variator is simulated under a torque of its motor only: remove this part, or the [variator]"));
        }
        item.section(title.to_owned())
    }
}

/// The controller. `at`: the motor's shaft; `duration`: of the simulation (s); `torque`: the motor's torque over the speed.
pub(super) fn control(
    simulation: &Section,
    around: SimulationContext,
    (at, duration): (Shaft, f64),
    torque: Option<&Characteristic>,
) -> Result<Option<Control>> {
    let Some(item) = simulation.get("control") else {
        return Ok(None);
    };
    let section = around.part(&item, "[simulation.control]")?;
    let Some(motion) = around.motion else {
        return Err(section
            .problem(
                "[simulation.control] has no motion to follow",
                "this controller",
            )
            .help("add a [motion] to the file: it is the reference"));
    };
    let cycles = duration / motion.duration();
    if motion.cyclic && cycles > MOST_CYCLES {
        let what = format!("follows {} cycles of [motion]", figure(cycles.floor()));
        return Err(item.problem(&what, "this controller").help(format!(
            "at most {MOST_CYCLES} are possible: give a `duration` of {} s at most",
            figure(MOST_CYCLES * motion.duration())
        )));
    }
    if at == Shaft::DriveLink && !around.drive_train.stages().is_empty() {
        return Err(section
            .problem(
                "the controller acts at the motor, but `at` names the drive link",
                "this controller",
            )
            .help("remove `at`: torque, speed and gains are those of the motor shaft"));
    }
    if let Some(torque) = torque {
        limits(&item, torque)?;
    }
    section.set_slides(around.pushes());
    let speed_gain = section.si("speed_gain")?;
    let position_gain = section.si("position_gain")?;
    let integral_time = section.maybe("integral_time")?.unwrap_or(f64::INFINITY);
    let words = [
        FeedForward::None,
        FeedForward::MeanInertia,
        FeedForward::Model,
    ];
    let feed_forward = section.pick("feed_forward", words)?;
    section.finish()?;
    Ok(Some(Control {
        position_gain,
        speed_gain,
        integral_time,
        feed_forward,
    }))
}

/// Refuses a motor whose torque is not a limit in both directions.
fn limits(control: &Item, torque: &Characteristic) -> Result<()> {
    let fault = match torque {
        Characteristic::Points(points) => points
            .iter()
            .any(|(speed, torque)| *torque < 0.0 || *speed < 0.0),
        Characteristic::Dc { stall_torque, .. } => *stall_torque < 0.0,
        Characteristic::Induction { .. } => true,
    };
    if !fault {
        return Ok(());
    }
    Err(Problem::new("under a controller, the motor's torque is the limit in both directions, over the speed's magnitude")
        .at(control.key_span(), "this controller")
        .help("give torque, torque_speed or dc_motor with speeds and torques that are not negative"))
}

/// The controlled stop during a simulation of this `duration` (s).
pub(super) fn halt(
    simulation: &Section,
    around: SimulationContext,
    duration: f64,
) -> Result<Option<Halt>> {
    let Some(item) = simulation.get("stop") else {
        return Ok(None);
    };
    let section = around.part(&item, "[simulation.stop]")?;
    let given = section.value("time")?;
    if given.si > duration {
        let what = format!("is {}, after the end of the simulation", given.shown());
        return Err(given
            .problem(&what, "never reached")
            .help("stop earlier, or give a longer `duration`"));
    }
    let key = if around.pushes() {
        "brake_force"
    } else {
        "brake_torque"
    };
    let (brake_torque, brake_delay) = (section.si(key)?, section.si("brake_delay")?);
    section.finish()?;
    Ok(Some(Halt {
        time: given.si,
        brake_torque,
        brake_delay,
    }))
}

/// The end stops. `start`: start position of the motion.
pub(super) fn end_stops(
    simulation: &Section,
    around: SimulationContext,
    start: f64,
) -> Result<Option<EndStops>> {
    let Some(item) = simulation.get("end_stops") else {
        return Ok(None);
    };
    let section = around.part(&item, "[simulation.end_stops]")?;
    let places = AxisReader::of(around);
    let kind = if places.is_length() { &LENGTH } else { &ANGLE };
    let example = format!("[\"{}\", \"{}\"]", kind.example, kind.example);
    let at = section.require("at", &format!("at = {example}"))?;
    let [first, second] = at.both("position", &example)?;
    let [first, second] = [places.position(&first)?, places.position(&second)?];
    if first.value.si >= second.value.si {
        return Err(at
            .problem(
                &format!(
                    "is {} to {}: the first must be below the second",
                    first.value.shown(),
                    second.value.shown()
                ),
                "in this order",
            )
            .help("give the lower stop first"));
    }
    let cure = "place the end stops within the stroke";
    let reached = |given: &AxisValue| places.reached(given, "out of reach", cure);
    let [first, second] = [reached(&first)?, reached(&second)?];
    // The axis can count in the opposite direction to the drive link.
    let [from, to] = [first.min(second), first.max(second)];
    if !(from..=to).contains(&start) {
        return Err(at
            .problem("does not contain the start", "between these stops")
            .help("start between the end stops"));
    }
    let restitution = section.figure("restitution")?;
    section.finish()?;
    Ok(Some(EndStops {
        from,
        to,
        restitution,
    }))
}
