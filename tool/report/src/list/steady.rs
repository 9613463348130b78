//! The steady cycle and the flywheel.

mod cycle;
mod data;
mod error;

use std::borrow::Cow;

use crate::answer::Answer;
use cycle::{describe, rpm};
pub(crate) use data::SteadyData;
pub use error::problem;
use jred_analysis::simulate::CoupledMachines;
use jred_analysis::steady::{Cycle, Flywheel, ShaftFlywheel, Steady, Wheel};
use jred_file::number::rounding::{percent, short};

/// The flywheel and the cycle with it, if one was requested; then the cycle of the machine as it is.
pub fn answer<'s>(machines: &CoupledMachines, steady: &'s Steady) -> Answer<'s> {
    let mut answer = Answer::new(
        format!("{}: steady cycle", machines.title()),
        &SteadyData::of(steady),
    );
    if let Some(last) = steady.last() {
        answer.course(Cow::Borrowed(&last.figures.course));
    }
    if let Some(flywheel) = &steady.flywheel {
        wheel(&mut answer, flywheel, steady.cycle.as_ref());
        if flywheel.inertia > 0.0 {
            answer.heading("with this flywheel");
            describe(&mut answer, &flywheel.cycle);
        }
        answer.heading("without a further flywheel");
    }
    if let Some(cycle) = &steady.cycle {
        describe(&mut answer, cycle);
    }
    if let Some(why) = &steady.no_cycle {
        answer.fact("no steady cycle", problem(why).to_string());
    }
    if steady.inductance_left_out {
        answer.warning(
            "the inductance of the winding is neglected: the torque is that of the settled current at each speed",
        );
    }
    answer
}

fn wheel(answer: &mut Answer, flywheel: &Flywheel, own: Option<&Cycle>) {
    answer.heading(format!("flywheel for δ = {}", short(flywheel.delta)));
    let exact = if flywheel.inertia == 0.0 {
        "not needed: the machine runs as evenly without it".to_owned()
    } else {
        format!("{} kg m^2 on the drive link", short(flywheel.inertia))
    };
    answer.fact("exact", exact);
    let classical = &flywheel.classical;
    answer.fact(
        "Wittenbauer",
        format!(
            "{} kg m^2: ΔW = {} J at {}, ΔW/(δ·ω²) = {} kg m^2, less {} kg m^2 that the machine has on average",
            short(classical.inertia),
            short(classical.work),
            rpm(classical.speed),
            short(classical.total),
            short(classical.own)
        ),
    );
    if flywheel.inertia > 0.0 {
        let more = classical.inertia / flywheel.inertia - 1.0;
        let side = if more < 0.0 { "smaller" } else { "larger" };
        answer.fact(
            "difference",
            format!(
                "the classical value is {} {side}: it assumes constant motor torque, speed and inertia",
                percent(more.abs())
            ),
        );
    }
    if let Some(own) = own.filter(|_| flywheel.inertia > 0.0) {
        let [before, after] = [&own.figures, &flywheel.cycle.figures];
        let ([p, q], [m, n]) = (
            [before.motor_power, after.motor_power],
            [before.motor_torque, after.motor_torque],
        );
        for (name, unit, without, with) in [
            ("mean power", "W", p.mean, q.mean),
            ("peak power", "W", p.peak, q.peak),
            ("RMS torque", "N m", m.rms, n.rms),
            ("peak torque", "N m", m.peak, n.peak),
        ] {
            let [without, with] = [without, with].map(short);
            answer.fact(
                name,
                format!("{without} {unit} without, {with} {unit} with it"),
            );
        }
    }
    if flywheel.places.len() > 1 {
        answer.heading("where it can sit, for the same δ");
        for place in &flywheel.places {
            let seat = place.wheel.as_ref().map(seat);
            let no = place
                .no_flywheel
                .as_ref()
                .map(|why| problem(why).to_string());
            answer.fact(shaft(place, flywheel), seat.or(no).unwrap_or_default());
        }
    }
}

/// The name of the shaft.
fn shaft(place: &ShaftFlywheel, flywheel: &Flywheel) -> String {
    match place.shaft {
        last if last + 1 == flywheel.places.len() => "drive link".to_owned(),
        0 => "motor shaft".to_owned(),
        k => format!("behind stage {k}"),
    }
}

fn seat(wheel: &Wheel) -> String {
    let delivered = wheel.delivered.iter().enumerate();
    let delivered: Vec<String> = delivered
        .map(|(k, torque)| format!("stage {} delivers up to {} N m", k + 1, short(*torque)))
        .collect();
    format!(
        "{} kg m^2 at {}, {} J; {}; motor {} N m RMS, {} N m peak; losses {} J a cycle",
        short(wheel.inertia),
        rpm(wheel.speed),
        short(wheel.stored),
        delivered.join(", "),
        short(wheel.motor_torque.rms),
        short(wheel.motor_torque.peak),
        short(wheel.losses)
    )
}
