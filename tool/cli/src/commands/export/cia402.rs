//! `jred export --format cia402`: the torque of the motion for a drive.

use miette::{Result, miette};

use crate::commands::core_error::duty_report;
use crate::commands::{Completion, print, quantity, warn};
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

/// Refuses options of the other forms in this one, and the options of this one in others.
///
/// # Errors
/// An option that does not apply.
pub(super) fn check(options: &Export, own: bool) -> Result<()> {
    let of_tables = [
        ("--torque-error", options.torque_error.is_some()),
        ("--max-bytes", options.max_bytes.is_some()),
        ("--omega", options.omega.is_some()),
        ("--alpha", options.alpha.is_some()),
        ("--pieces", options.pieces.is_some()),
        ("--prove", options.prove),
        ("--forward", options.forward),
    ];
    let of_drives = [
        ("--rated-torque", options.rated_torque.is_some()),
        ("--counts-per-turn", options.counts_per_turn.is_some()),
        ("--rows", options.rows.is_some()),
    ];
    let given = |list: &[(&'static str, bool)]| {
        let mut given = list.iter().filter(|(_, given)| *given);
        given.next().map(|(name, _)| *name)
    };
    let wrong = if own {
        given(&of_tables)
    } else {
        given(&of_drives)
    };
    let Some(name) = wrong else {
        return Ok(());
    };
    Err(if own {
        miette!(
            help = format!("remove {name}"),
            "{name} applies to tables over the position; --format cia402 is the torque of the motion"
        )
    } else {
        miette!(
            help = format!("remove {name}, or use --format cia402"),
            "{name} applies to --format cia402; --format {} is a table over the position",
            options.format
        )
    })
}

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
    let rated = quantity(
        "rated-torque",
        rated,
        Argument::positive(EFFORT),
        coordinate,
    )?;
    let Some(rated) = rated else {
        return Err(miette!(
            help = "give --rated-torque, the motor's rated torque as set in object 0x6076 of the drive, such as \"4.2 N m\"",
            "--format cia402 counts thousandths of the rated torque, which is not given"
        ));
    };
    check(options, true)?;
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
    let (ratio, rotor) = (
        file.drive_train.ratio(),
        options.rotor_inertia.unwrap_or(0.0),
    );
    let instants: Vec<ShaftInstant> = course
        .iter()
        .map(|instant| ShaftInstant {
            t: instant.t,
            position: instant.phi * ratio,
            torque: instant.input_torque + rotor * instant.input_alpha,
        })
        .collect();
    let table = TorqueOffsets {
        title: &file.title,
        instants: &instants,
        rated,
        counts_per_turn: options.counts_per_turn,
        rotor,
        unit: coordinate.effort_unit(),
    };
    let text = table
        .csv()
        .map_err(|fault| miette!(help = fault.cure(), "{fault}"))?;
    warn(
        file,
        [
            course
                .iter()
                .fold(0.0, |most, i| f64::max(most, i.omega.abs())),
            0.0,
        ],
    )?;
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
