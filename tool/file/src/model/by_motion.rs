//! Descriptions of the parts of a machine that depend on the motion of its file, and the refusals of commands that cannot follow it.

use std::fmt;

use jred::machine::JointFriction;

use crate::model::machine::MachineFile;
use crate::model::motion::Motion;
use crate::model::schedule::When;
use crate::number::rounding::figure;

/// A load, payload or carriage that depends on the motion.
#[derive(Clone, Debug)]
pub struct ByMotion {
    /// For example `load "punch" acts in segment 2`.
    pub what: String,
    /// How to remove the dependence: `remove its segments or during`.
    pub cure: String,
}

impl fmt::Display for ByMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

/// Alternative to a payload or a carriage.
const FIXED: &str = "or fix it to the link with a [[mass]]";

/// Which parts of a schedule matter to a command.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ScheduleParts {
    All,
    /// Parts that depend on the time or on rest, not on the direction only.
    Timed,
    /// The same, and payloads by the direction.
    ButLoadsByDirection,
}

impl MachineFile {
    /// Refuses a machine with parts that depend on the motion of the file, for a command that computes another motion.
    ///
    /// # Errors
    /// It has such a load, payload or carriage.
    pub fn refuse_scheduled(&self, command: &str) -> crate::text::problem::Result<()> {
        match self.scheduled().next() {
            None => Ok(()),
            Some(ByMotion { what, cure }) => Err(crate::problem!(
                help = format!("{cure}, for this command; `jred size` contains it"),
                "{what}: that goes by [motion], but `jred {command}` seeks another motion"
            )),
        }
    }

    /// The same for a command that computes another motion, one direction at a time: parts that depend only on the direction are allowed.
    ///
    /// # Errors
    /// A load, payload or carriage depends on the time of the motion, or a load has a separate value at rest.
    pub fn refuse_timed(&self, command: &str) -> crate::text::problem::Result<()> {
        match self.by_motion(ScheduleParts::Timed).next() {
            None => Ok(()),
            Some(ByMotion { what, cure }) => Err(crate::problem!(
                help = format!("{cure}, for this command; `jred size` contains it"),
                "{what}: that goes by the time of [motion] or by rest, but `jred {command}` seeks another motion"
            )),
        }
    }

    /// Refuses friction by a coefficient, for a command whose curves over the position cannot contain it.
    ///
    /// # Errors
    /// It has such friction.
    pub fn refuse_joint_friction(&self, command: &str) -> crate::text::problem::Result<()> {
        match self.frictions_in_words().next() {
            None => Ok(()),
            Some(friction) => Err(crate::problem!(
                help = "for this command give an opposing_force or opposing_moment of its mean size in [[load]] instead: `jred reduce --over time` shows it; `size`, `simulate` and `steady` follow the coefficient",
                "{friction} depends on the acceleration, but `jred {command}` needs loads that depend on position and speed only"
            )),
        }
    }

    /// Descriptions of the friction by a coefficient, for example `friction in joint "guide"`.
    pub fn frictions_in_words(&self) -> impl Iterator<Item = String> {
        let names = self.machine.mechanism().joint_names();
        let joints = self.machine.frictions().iter().map(JointFriction::joint);
        joints.filter_map(|joint| Some(format!("friction in joint \"{}\"", names.get(joint)?)))
    }

    /// All items of the schedule.
    pub fn scheduled(&self) -> impl Iterator<Item = ByMotion> {
        self.by_motion(ScheduleParts::All)
    }

    /// The same without the loads that depend only on the direction of travel.
    pub fn not_by_direction(&self) -> impl Iterator<Item = ByMotion> {
        self.by_motion(ScheduleParts::ButLoadsByDirection)
    }

    /// The carriages, for example `carriage "trolley" moves along beam by its own motion`.
    pub fn carriages(&self) -> impl Iterator<Item = ByMotion> {
        let carriages = self.schedule.carriages().iter();
        carriages.map(|c| ByMotion {
            what: format!("carriage \"{}\" {}", c.name, c.words),
            cure: format!("remove the carriage, {FIXED}"),
        })
    }

    /// Descriptions of loads and payloads whose times satisfy a condition.
    pub fn scheduled_where(&self, such: impl Fn(&When) -> bool) -> impl Iterator<Item = String> {
        let all = self.timed().filter(move |(.., when)| such(when));
        all.map(|(words, _)| words)
    }

    /// Descriptions of loads and payloads, with their times.
    fn timed(&self) -> impl Iterator<Item = (String, &When)> {
        let loads = self.schedule.loads().iter();
        let loads = loads.map(|load| ("load", &load.name, &load.words, &load.when));
        let payloads = self.schedule.payloads().iter();
        let payloads = payloads.map(|p| ("payload", &p.name, &p.words, &p.when));
        let all = loads.chain(payloads);
        all.map(|(what, name, words, when)| (format!("{what} \"{name}\" {words}"), when))
    }

    /// Descriptions of the parts that depend on the motion in a simulation of this duration (s), with their times, for example `load "punch" acts in
    /// segment 2: from 0.3 s to 0.5 s, again every 1.2 s`.
    pub fn by_the_clock(&self, duration: f64) -> impl Iterator<Item = String> {
        let cycle = self.motion.as_ref().filter(|motion| motion.cyclic);
        let cycle = cycle
            .map(Motion::duration)
            .filter(|cycle| *cycle < duration);
        let again = cycle.map(|cycle| format!(", again every {} s", figure(cycle)));
        let again = again.unwrap_or_default();
        let carriages = self.carriages().zip(std::iter::repeat(again.clone()));
        let carriages = carriages.map(|(carriage, again)| format!("{carriage}{again}"));
        let timed = self.timed().map(move |(words, when)| {
            let times = when.times_in_words();
            let times = times.map_or_else(String::new, |times| format!(": {times}"));
            let again = if when.spans.is_some() { &again } else { "" };
            format!("{words}{times}{again}")
        });
        timed.chain(carriages)
    }

    fn by_motion(&self, which: ScheduleParts) -> impl Iterator<Item = ByMotion> {
        let loads = self.schedule.loads().iter().filter_map(move |load| {
            let keys = [
                (load.when.spans.is_some(), "segments or during"),
                (
                    load.when.travel.is_some() && which == ScheduleParts::All,
                    "direction",
                ),
                (load.at_rest.is_some(), "at_rest"),
            ];
            let keys = keys
                .into_iter()
                .filter_map(|(there, key)| there.then_some(key));
            let keys: Vec<&str> = keys.collect();
            (!keys.is_empty()).then(|| ByMotion {
                what: format!("load \"{}\" {}", load.name, load.words),
                cure: format!("remove its {}", keys.join(" and ")),
            })
        });
        let payloads = self.schedule.payloads().iter();
        let payloads =
            payloads.filter(move |p| which != ScheduleParts::Timed || p.when.spans.is_some());
        let payloads = payloads.map(|payload| ByMotion {
            what: format!("payload \"{}\" {}", payload.name, payload.words),
            cure: format!("remove the payload, {FIXED}"),
        });
        loads.chain(payloads).chain(self.carriages())
    }
}
