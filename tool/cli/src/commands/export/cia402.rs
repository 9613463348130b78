//! `jred export --format cia402`: the torque of the motion for a drive.

use miette::{Result, miette};

use crate::commands::core_error::duty_report;
use crate::commands::{Completion, drive_asked, print, quantity, warn};
use crate::options::export::Export;
use crate::output;
use crate::terminal;
use jred_analysis::duty;
use jred_export::{ShaftInstant, TorqueOffsets};
use jred_file::argument::Argument;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::plain;
use jred_file::text::key::EFFORT;
use jred_sizing::catalogue::Drive;
use jred_sizing::motor::envelope::Envelope;
use jred_sizing::study::chosen::ChosenDrive;

/// Writes or prints the table.
///
/// # Errors
/// Bad input, a number beyond the range of its object, or a file that cannot be written.
pub(super) fn run(options: &Export, file: &MachineFile) -> Result<Completion> {
    let coordinate = file.machine.mechanism().coordinate();
    // A drive train turns at its input, whatever its output does.
    let coordinate = if file.drive_train.stages().is_empty() {
        coordinate
    } else {
        Coordinate::Angle
    };
    let rated = options.rated_torque.as_deref();
    let positive = Argument::positive(EFFORT);
    let rated = quantity("rated-torque", rated, positive, coordinate)?;
    let chosen = drive_asked(options.drive.as_deref(), &options.catalogue, file)?;
    let drive = chosen.as_ref().map(ChosenDrive::drive);
    let of_motor = drive.as_ref().and_then(|drive| drive.motor.rated_torque);
    let Some(rated) = rated.or(of_motor) else {
        return Err(miette!(
            help = "give --rated-torque, the motor's rated torque as set in object 0x6076 of the drive, such as \"4.2 N m\"",
            "--format cia402 counts thousandths of the rated torque, which is not given"
        ));
    };
    let of_turns = [
        ("--counts-per-turn", options.counts_per_turn.is_some()),
        ("--rotor-inertia", options.rotor_inertia.is_some()),
    ];
    let of_turns = of_turns.into_iter().find(|(_, given)| *given);
    if let (Some((name, _)), Coordinate::Length) = (of_turns, coordinate) {
        return Err(miette!(
            help = format!(
                "remove {name}, or give the [[drive_train]] between the motor and the drive link"
            ),
            "{name} is of a motor that turns, but the drive link of this machine slides and has no drive train"
        ));
    }
    let motion = file.required_motion()?;
    let last = options.rows.unwrap_or(1001).saturating_sub(1).max(1);
    let times = (0..=last).map(|k| motion.duration() * f64::from(k) / f64::from(last));
    let course = duty::course(file, motion, times).map_err(duty_report)?;
    let rotor = options.rotor_inertia.unwrap_or(0.0);
    let rotor = drive.as_ref().map_or(rotor, |drive| {
        drive.rotor() + drive.gearbox.map_or(0.0, |gearbox| gearbox.inertia)
    });
    let gear = drive.as_ref().map_or(1.0, Drive::ratio);
    let instants = course.iter().map(|instant| ShaftInstant {
        t: instant.t,
        position: instant.phi * file.drive_train.ratio() * gear,
        torque: match &drive {
            Some(drive) => drive.motor_point(instant).torque,
            None => instant.input_torque + rotor * instant.input_alpha,
        },
    });
    let instants: Vec<ShaftInstant> = instants.collect();
    let name = drive.as_ref().map(Drive::name);
    let table = TorqueOffsets {
        title: &file.title,
        instants: &instants,
        rated,
        counts_per_turn: options.counts_per_turn,
        rotor,
        drive: name.as_deref(),
        unit: coordinate.effort_unit(),
    };
    let text = table.csv()?;
    let peak = drive.as_ref().map(|drive| {
        let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
        envelope.peak_torque(1.0, 0.0)
    });
    if let Some(warning) = table.excess(peak.filter(|peak| peak.is_finite())) {
        terminal::warn(&warning);
    }
    let fastest = course.iter().map(|instant| instant.omega.abs());
    warn(file, [fastest.fold(0.0, f64::max), 0.0])?;
    let Some(out) = &options.out else {
        return print(&text);
    };
    output::write(out, text.as_bytes())?;
    terminal::say(&format!(
        "torque of the motion written to {}",
        plain::path(out)
    ));
    Ok(Completion::Holds)
}
