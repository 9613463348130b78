//! `jred identify`: the machine's curves from a log of its drive.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use miette::{Result, miette};

use crate::commands::core_error::core_report;
use crate::commands::{Completion, documents, print_answer};
use crate::options::identify::Identify;
use crate::output::{self, Files};
use jred::Domain;
use jred::machine::Reducible as _;
use jred_analysis::checked;
use jred_analysis::identify::{self, Identified, Options, Reading, Shaft};
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::number::rounding::short;
use jred_file::plain;
use jred_file::read::{self, LogLayout};
use jred_report::list::identify::{
    Designed, IdentifyView, LogResult, Signs, refusal, slopes, unreadable,
};
use jred_report::page;

/// The longest delay of a logged torque (s).
const LONGEST_DELAY: f64 = 0.05;

/// Friction has corners at dead centres, which need more positions than the curves.
const FINER: usize = 10;

/// Runs the command.
///
/// # Errors
/// Bad input, or a log that does not determine the machine.
pub(super) fn run(options: &Identify) -> Result<Completion> {
    let file = checked::read(&options.machine)?;
    variator::refuse(&file, "identify")?;
    output::check(options.documents.files())?;
    if file.machine.domain() != Domain::Turn {
        return Err(miette!(
            help = "identify a machine whose drive link turns fully",
            "the drive link of {} does not turn fully: its curves cannot be sums of harmonics over a turn",
            file.name
        ));
    }
    refuse(options)?;
    let fine = designed(&file).map_err(core_report)?;
    let friction: Vec<f64> = fine.iter().map(|at| at.coulomb).collect();
    let designed: Vec<Designed> = fine.into_iter().step_by(FINER).collect();
    let each = options.logs.iter();
    let logs = each.map(|log| one(options, &file, &designed, &friction, log));
    let logs = logs.collect::<Result<Vec<LogResult>>>()?;
    let shown = IdentifyView {
        file: &file,
        designed,
        logs,
    };
    shown.refuse_unlike()?;
    let mut answer = shown.answer();
    let page = || Ok(page::identify_page(&shown));
    let workbook = || Ok(answer.clone());
    let (lines, printed) = documents::write(&options.documents, Files::default(), page, workbook)?;
    for line in lines {
        answer.sentence(line);
    }
    print_answer(&answer, options.format)?;
    printed?;
    Ok(if shown.has_fault() {
        Completion::Violated
    } else {
        Completion::Holds
    })
}

/// Refuses options that exclude each other, or are out of range.
fn refuse(options: &Identify) -> Result<()> {
    if options.rotor_inertia.is_some() && options.shaft == Shaft::Link {
        return Err(miette!(
            help = "leave out --rotor-inertia, or give --shaft motor",
            "--rotor-inertia is at the motor, and the log is of the drive link"
        ));
    }
    if let Some(delay) = options.delay.filter(|delay| delay.abs() > LONGEST_DELAY) {
        return Err(miette!(
            help = "give the delay with its unit, for example --delay \"1 ms\", or leave it out: it is found",
            "a delay of {} ms is longer than 50 ms: no drive logs its torque that late",
            short(delay * 1e3)
        ));
    }
    let twice = |k: usize| options.logs[..k].contains(&options.logs[k]);
    if let Some(k) = (0..options.logs.len()).find(|k| twice(*k)) {
        return Err(miette!(
            help = "give each log once: it is no repetition of itself",
            "{} is given twice",
            plain::path(&options.logs[k])
        ));
    }
    let mut orders = options.cogging.clone();
    orders.sort_unstable();
    let mut neighbours = orders.iter().zip(orders.iter().skip(1));
    if let Some((order, _)) = neighbours.find(|(a, b)| a == b) {
        return Err(miette!(
            help = "give each order once",
            "--cogging has the order {} twice",
            order
        ));
    }
    Ok(())
}

/// The result of one log.
fn one(
    options: &Identify,
    file: &MachineFile,
    designed: &[Designed],
    friction: &[f64],
    path: &PathBuf,
) -> Result<LogResult> {
    let layout = LogLayout {
        columns: options.columns.clone(),
        counts_per_turn: options.counts_per_turn,
        torque_constant: options.torque_constant,
        rated_torque: options.rated_torque,
        skipped: options.skip_rows,
    };
    let name = plain::path(path);
    let log = read::drive_log(&path.to_string_lossy(), Path::new(""), &layout)?;
    let torque: Vec<f64> = if options.reverse_torque {
        log.torque.iter().map(|torque| -torque).collect()
    } else {
        log.torque
    };
    let zero = options.zero.unwrap_or_default();
    let sign = if options.reverse_position { -1.0 } else { 1.0 };
    let (mut samples, repairs) = identify::samples(&log.time, &log.position, &torque)
        .map_err(|fault| unreadable(&name, &fault))?;
    for position in &mut samples.position {
        *position = sign * (*position - zero);
    }
    let ratio_of = |shaft| match shaft {
        Shaft::Motor => file.drive_train.ratio(),
        Shaft::Link => 1.0,
    };
    let ratio = ratio_of(options.shaft);
    let counts = options.counts_per_turn.map(f64::from);
    let request = Options {
        cogging: options.cogging.clone(),
        delay: options.delay,
        friction: friction.to_vec(),
        encoder_step: counts.map(|counts| TAU / counts / ratio.abs()),
    };
    let found = |reading: Reading| {
        let (scale, shaft) = match reading {
            Reading::Scaled(scale) => (scale, options.shaft),
            Reading::OtherShaft => (1.0, options.shaft.other()),
        };
        let mut samples = samples.clone();
        for position in &mut samples.position {
            *position *= scale;
        }
        let finer = scale * (ratio / ratio_of(shaft)).abs();
        let request = Options {
            encoder_step: request.encoder_step.map(|step| finer * step),
            ..request.clone()
        };
        match shaft {
            Shaft::Motor => {
                let rotor = options.rotor_inertia.unwrap_or_default();
                identify::of_motor(&samples, file, rotor, &request)
            }
            Shaft::Link => identify::identify(&samples, &request),
        }
    };
    let read = |reading| found(reading).ok();
    let mut found = found(Reading::Scaled(1.0)).map_err(|why| refusal(&name, &why, &repairs))?;
    let design = |found: &Identified| -> Vec<[f64; 2]> {
        let curves = designed.iter().zip(slopes(designed, found.direction()));
        curves.map(|(at, slope)| [at.inertia, slope]).collect()
    };
    let curves = design(&found);
    identify::against_design(&mut found, &curves);
    identify::judge_reading(&mut found, design, read);
    Ok(LogResult {
        name,
        repairs,
        found,
        cogging: request.cogging,
        counts,
        shaft: options.shaft,
        encoder_step: request.encoder_step,
        signs: Signs {
            torque: options.reverse_torque,
            position: options.reverse_position,
        },
        zero,
        ratio,
    })
}

/// The curves of the design, `FINER` times as fine as they are shown.
fn designed(file: &MachineFile) -> std::result::Result<Vec<Designed>, jred::error::Error> {
    let count = 360 * FINER;
    let positions = (0..count).map(|k| k as f64 * TAU / count as f64);
    let each = positions.map(|phi| {
        let reduction = file.bare_reduction(phi)?;
        Ok(Designed {
            inertia: reduction.inertia,
            potential_slope: reduction.potential_slope,
            viscous: reduction.viscous,
            coulomb: reduction.coulomb,
        })
    });
    each.collect()
}
