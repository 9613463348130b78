//! `jred fastest`: moves in minimum time.

mod limits;
mod winding;

use std::f64::consts::PI;

use miette::{Result, miette};

use crate::commands::core_error::core_report;
use crate::commands::vary::{catalogue, study};
use crate::commands::{
    Completion, documents, drive_named, envelope, print_answer, quantity, rate, read_warned,
};
use crate::commands::{plan, series};
use crate::options::fastest::{Fastest as Options, ReserveOption};
use crate::output::{self, Files};
use jred::machine::Reducible as _;
use jred_file::argument::{self, Argument};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::drive_train;
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::number::rounding::short;
use jred_file::plain;
use jred_file::text::key::{EFFORT, SPEED};
use jred_motion::contact::broken;
use jred_motion::fastest::cycle::Cycle;
use jred_motion::fastest::field::Field;
use jred_motion::fastest::joint_force::reached;
use jred_motion::fastest::motion_input::{MotionInput, of_motion};
use jred_motion::fastest::ruled::{Judge, ruled};
use jred_motion::fastest::winding::{Winding, cooled};
use jred_motion::fastest::{KeptPart, MoveLimits, Reserve, Rms, Task};
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_report::list;
use jred_report::list::fastest::WindingHeat;
use jred_report::page;
use jred_report::table::output::Format;
use jred_sizing::catalogue::{Drive, Motor, MotorKind};
use jred_sizing::motor::envelope::Envelope;
use jred_sizing::select::filter::Filter;
use jred_sizing::select::fit;
use jred_sizing::study::chosen::ChosenDrive;
use limits::limits;

/// Share by which a speed may exceed the largest one, for the rounding of its unit.
const ROUNDING: f64 = 1e-9;

/// The motor or drive with its name, and the limits of its gearbox.
struct DriveInput {
    name: String,
    actuator: Actuator,
    limits: MoveLimits,
    /// The drive, if it is from a catalogue.
    drive: Option<ChosenDrive>,
    /// The winding, if a drive is given.
    winding: Option<Winding>,
}

/// Runs `jred fastest`.
///
/// # Errors
/// Bad input, or no motion within the limits.
pub fn fastest(options: &Options) -> Result<Completion> {
    let file = read_warned(&options.file)?;
    variator::refuse(&file, "fastest")?;
    drive_train::refuse(&file, "fastest")?;
    file.refuse_timed("fastest")?;
    file.refuse_joint_friction("fastest")?;
    let task = task(options, &file)?;
    let chosen = chosen(options, &file)?;
    let motions = [
        ("--profile", &options.series.profile),
        ("--cam", &options.series.cam),
        ("--plan", &options.plan.plan),
    ];
    output::check(motions.into_iter().chain(options.documents.files()))?;
    let reserve = reserve(options, &file);
    let (limits, asked) = limits(options, &file, &chosen.limits)?;
    let limits = limits.with_reserve(reserve);
    let rms = rms(options, &file, &chosen)?;
    let warmth = winding::limit(options, &chosen)?;
    let parts = match task {
        Some(task) => {
            let task = Task { limits, ..task };
            passable(options, &file, &chosen.actuator, &task)?;
            MotionInput::Move(Box::new(task))
        }
        None => of_motion(&file, &limits, rms)?,
    };
    let actuator = &chosen.actuator;
    let make = |limits: &MoveLimits, rms: Option<Rms>| {
        let at = |rms: Option<Rms>| parts.fastest(&file, actuator, limits, rms);
        let Some((winding, most)) = warmth else {
            return at(rms).map(|cycle| (cycle, None));
        };
        cooled(winding, most, &file, actuator, rms, at).map(|found| {
            let warmth = WindingHeat {
                ambient: winding.ambient(),
                temperatures: found.temperatures,
                limit: found.limit,
                bound: found.bound,
            };
            (found.cycle, Some(warmth))
        })
    };
    let by_rules = options.reserve == Some(ReserveOption::Rules);
    let made = match chosen.drive.as_ref().filter(|_| by_rules) {
        None => make(&limits, rms).map(|(cycle, warmth)| (cycle, warmth, None)),
        Some(drive) => {
            let judge = Judge::new(&file, drive.drive(), options.supply.course.sampling())
                .with_resistors(drive.resistors());
            let heat = rms.is_some() || warmth.is_some();
            let found = ruled(&judge, &limits, rms, heat, make);
            found.map(|(cycle, warmth, judged)| (cycle, warmth, Some(judged)))
        }
    };
    let (cycle, warmth, judged) = made.map_err(|(number, why)| why.problem(number))?;
    let cycle = cycle.with_costs(&file, actuator);
    let forces = reached(&file, &limits.forces, &cycle.trace).map_err(core_report)?;
    for force in &forces {
        let kept = force.kept_at_rest(&file);
        kept.map_err(|why| why.problem(None))?;
    }
    let broken = broken(&file, &cycle.trace).map_err(core_report)?;
    let trace = cycle.trace.of_axis(&file.axis());
    let mut files = Files::default();
    let written = series::write(&options.series, &file, &trace, &mut files)?;
    let planned = plan::write(
        &options.plan,
        &plan::PlannedMotion {
            file: &file,
            trace: &cycle.trace,
            actuator,
            gearbox: chosen.limits.gearbox_torque,
        },
        &mut files,
    )?;
    let view = list::fastest::FastestView {
        file: &file,
        drive: &chosen.name,
        asked,
        actuator: &chosen.actuator,
        cycle: &cycle,
        chain: parts.chain(),
        warmth: warmth.as_ref(),
        forces: &forces,
        broken: broken.as_ref(),
        reserve,
        judged: judged.as_ref(),
        of_catalogue: options.torque.is_none(),
        instants: options.instants as usize,
    };
    let page = || page::fastest_page(&view).map_err(core_report);
    let workbook = || view.answer(Format::Csv).map_err(core_report);
    let (documents, printed) = documents::write(&options.documents, files, page, workbook)?;
    let mut answer = view.answer(options.format).map_err(core_report)?;
    for line in written.into_iter().chain(documents).chain(planned) {
        answer.sentence(line);
    }
    print_answer(&answer, options.format)?;
    printed?;
    let violated = judged.is_some_and(|judged| judged.violated().next().is_some());
    Ok(completion(&cycle, broken.is_some() || violated))
}

/// The exit status: also a part of the file's motion that exceeds a limit violates it.
fn completion(cycle: &Cycle, violated: bool) -> Completion {
    if violated || cycle.kept.iter().any(KeptPart::exceeds) {
        Completion::Violated
    } else {
        Completion::Holds
    }
}

fn reserve(options: &Options, file: &MachineFile) -> Reserve {
    match options.reserve {
        None => Reserve::default(),
        Some(ReserveOption::Share(share)) => Reserve::of_motor(share),
        Some(ReserveOption::Rules) => Reserve::of(&file.rules),
    }
}

/// The move of the command line.
fn task(options: &Options, file: &MachineFile) -> Result<Option<Task>> {
    let (Some(from), Some(to)) = (&options.from, &options.to) else {
        return Ok(None);
    };
    let domain = file.machine.domain();
    let axis = file.axis();
    let position = |name: &str, text: &str| {
        let refused =
            |why: String| miette!("--{name} {} cannot be used: {why}", plain::quoted(text));
        argument::axis_position(text, domain, &axis).map_err(refused)
    };
    let speed = |name: &str, text: &Option<String>| {
        let speed = rate(name, text.as_deref(), Argument::any(SPEED), &axis)?.unwrap_or(0.0);
        if speed < 0.0 {
            return Err(miette!(
                help = "speeds count in the direction of the move",
                "--{name} must not be negative"
            ));
        }
        Ok(speed)
    };
    Ok(Some(Task {
        from: position("from", from)?,
        to: position("to", to)?,
        speeds: [
            speed("from-speed", &options.from_speed)?,
            speed("to-speed", &options.to_speed)?,
        ],
        limits: MoveLimits::default(),
        endless: false,
    }))
}

/// Refuses end speeds above the limit of motor and options, which no distance can reach.
fn passable(options: &Options, file: &MachineFile, actuator: &Actuator, task: &Task) -> Result<()> {
    let dynamics = &PathDynamics::new(file, actuator.clone(), 1.0);
    let limits = task.limits;
    let (top, limit) = Field { dynamics, limits }.top();
    let given = [
        ("from-speed", &options.from_speed),
        ("to-speed", &options.to_speed),
    ];
    for ((name, text), speed) in given.into_iter().zip(task.speeds) {
        if speed <= top * (1.0 + ROUNDING) {
            continue;
        }
        let text = text.as_deref().unwrap_or_default();
        let axis = file.axis();
        let most = axis.rate(top);
        let most = if text.contains("rpm") {
            format!("{} rpm", short(most * 30.0 / PI))
        } else {
            format!("{} {}", short(most), axis.coordinate.speed_unit())
        };
        return Err(miette!(
            help = "give a lower speed, or raise that limit: a longer distance does not help",
            "--{name} {} is too fast: the limit of the {} leaves {most} at the most, everywhere",
            plain::quoted(text),
            limit.name_in(file)
        ));
    }
    Ok(())
}

/// Whether the motor turns or slides.
fn motor_coordinate(file: &MachineFile) -> Coordinate {
    match fit::input_kind(file) {
        MotorKind::Rotary => Coordinate::Angle,
        MotorKind::Linear => Coordinate::Length,
    }
}

/// The limit of the RMS torque.
fn rms(options: &Options, file: &MachineFile, chosen: &DriveInput) -> Result<Option<Rms>> {
    match options.max_rms.as_deref() {
        None => Ok(None),
        Some(text) if text.eq_ignore_ascii_case("s1") => {
            if !chosen.actuator.envelope.continuous_torque(0.0).is_finite() {
                return Err(miette!(
                    help = "give the torque: --max-rms \"2 N m\"",
                    "--max-rms s1 cannot be used: the S1 torque of {} is not known",
                    chosen.name
                ));
            }
            Ok(Some(Rms::Continuous))
        }
        Some(text) => {
            let torque = quantity(
                "max-rms",
                Some(text),
                Argument::positive(EFFORT),
                motor_coordinate(file),
            )?;
            Ok(torque.map(Rms::Torque))
        }
    }
}

/// The drive of the command line, or the best one.
fn chosen(options: &Options, file: &MachineFile) -> Result<DriveInput> {
    if let Some(torque) = &options.torque {
        return plain_motor(options, file, torque);
    }
    let filter = Filter::default();
    let drive = if let Some(name) = &options.drive {
        drive_named(catalogue(&options.supply, &filter)?, name, file)?
    } else {
        file.motion_or("name a --drive, or give --torque and --motor-speed, or ")?;
        let study = study(
            &options.file,
            &options.supply,
            &filter,
            options.supply.course.sampling(),
        )?;
        ChosenDrive::choose(&study, None, &filter, None)?
    };
    let own = drive.drive();
    let envelope = envelope(&own, file);
    Ok(DriveInput {
        name: own.name(),
        actuator: Actuator::new(&own, envelope),
        limits: MoveLimits::of(&own),
        winding: Some(Winding::new(&own, file)),
        drive: Some(drive),
    })
}

/// A motor with constant torque, up to its largest speed if that is given.
fn plain_motor(options: &Options, file: &MachineFile, torque: &str) -> Result<DriveInput> {
    let kind = fit::input_kind(file);
    let coordinate = motor_coordinate(file);
    let effort = quantity(
        "torque",
        Some(torque),
        Argument::positive(EFFORT),
        coordinate,
    )?;
    let speed = quantity(
        "motor-speed",
        options.motor_speed.as_deref(),
        Argument::positive(SPEED),
        coordinate,
    )?;
    let motor = Motor {
        kind,
        peak_torque: effort,
        peak_curve: effort
            .zip(speed)
            .map(|(t, n)| [[0.0, t], [n, t]])
            .into_iter()
            .flatten()
            .collect(),
        max_speed: speed,
        rotor_inertia: options.rotor_inertia.unwrap_or(0.0),
        ..Motor::default()
    };
    let drive = Drive {
        motor: &motor,
        gearbox: None,
        amplifier: None,
    };
    let name = match &options.motor_speed {
        Some(speed) => format!("{torque} up to {speed}"),
        None => format!("{torque} at every speed"),
    };
    Ok(DriveInput {
        name,
        actuator: Actuator::new(&drive, Envelope::of(&motor)),
        limits: MoveLimits::default(),
        drive: None,
        winding: None,
    })
}
