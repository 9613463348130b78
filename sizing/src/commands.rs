//! The commands: read, compute, write.

use std::io::Write as _;
use std::path::Path;

use jred::tabulate::Request;
use miette::{IntoDiagnostic as _, Result, WrapErr as _, miette};
use serde_json::{Value, json};

use crate::catalogue::Catalogue;
use crate::check::Check;
use crate::cli;
use crate::drive::{Judged, RPM};
use crate::duty::{Duty, Figures};
use crate::export::Export;
use crate::machine::MachineFile;
use crate::motion::Motion;
use crate::output::{Format, rounded, short, text_table};
use crate::reduce::{Over, reduce};
use crate::size::{RANKING, Selection};
use crate::{input, report, simulate};

/// How a command ended, short of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// Everything asked for holds.
    Holds,
    /// The answer is no: a rule is violated by every drive, or a torque error is not reached.
    Violated,
}

/// Runs a command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn run(command: &cli::Command) -> Result<Done> {
    match command {
        cli::Command::Reduce(options) => run_reduce(options),
        cli::Command::Size(options) => run_size(options),
        cli::Command::Simulate(options) => run_simulate(options),
        cli::Command::Export(options) => run_export(options),
    }
}

fn run_reduce(options: &cli::Reduce) -> Result<Done> {
    let file = input::read(&options.file)?;
    if options.over == Over::Time {
        motion(&file)?;
    }
    let positions = options.positions as usize;
    let columns = reduce(&file, options.over, positions, options.links).into_diagnostic()?;
    let title = format!(
        "{}: reduced to the drive link, flywheel and drive train included",
        file.title
    );
    print(&columns.write(options.format, &title))
}

fn run_simulate(options: &cli::Simulate) -> Result<Done> {
    let file = input::read(&options.file)?;
    let simulation = file.simulation.as_ref().ok_or_else(|| {
        miette!(
            help = "add a [simulation] with duration, output_step and torque; docs/machine-file.md shows how",
            "the machine file has no [simulation]"
        )
    })?;
    let columns = simulate::simulate(&file, simulation)?;
    if let Some(path) = &options.plot {
        write(
            path,
            report::simulation_page(&file.title, &columns).as_bytes(),
        )?;
    }
    let title = format!(
        "{}: free motion, Dormand-Prince 8(5,3), tolerance {:e}",
        file.title, simulation.tolerance
    );
    print(&columns.write(options.format, &title))
}

fn run_export(options: &cli::Export) -> Result<Done> {
    let file = input::read(&options.file)?;
    let largest = |given: Option<f64>, name: &str, of: fn(&Duty) -> Figures| -> Result<f64> {
        match (given, &file.motion) {
            (Some(given), _) => Ok(given),
            (None, Some(motion)) => {
                let duty = Duty::new(&file, motion, crate::duty::STEPS).into_diagnostic()?;
                Ok(of(&duty).peak())
            }
            (None, None) => Err(miette!(
                help = "give --omega and --alpha, or add a [motion] to the machine file",
                "the largest {name} is not known: the machine file has no [motion]"
            )),
        }
    };
    let request = Request {
        torque_error: options.torque_error,
        omega: largest(options.omega, "speed", |d| d.figures(|i| i.omega))?,
        // A motion at constant speed has no acceleration of its own: the speed reached within a turn stands in.
        alpha: largest(options.alpha, "acceleration", |d| d.figures(|i| i.alpha))?,
        max_cells: options.max_cells,
    };
    let request = Request {
        alpha: if request.alpha > 0.0 {
            request.alpha
        } else {
            request.omega * request.omega
        },
        ..request
    };
    let export = match Export::new(&file, options.number, request) {
        Ok(export) => export,
        Err(error @ jred::Error::TorqueErrorNotReached { .. }) => {
            eprintln!("{error}");
            return Ok(Done::Violated);
        }
        Err(error) => return Err(error).into_diagnostic(),
    };
    write(&options.out, &export.write(options.format))?;
    print(&format!(
        "{}written to {}\n",
        export.summary(),
        options.out.display()
    ))
}

fn run_size(options: &cli::Size) -> Result<Done> {
    let file = input::read(&options.file)?;
    let motion = motion(&file)?;
    let catalogue = Catalogue::load(options.motors.as_deref(), options.gearboxes.as_deref())?;
    let duty = Duty::new(&file, motion, options.steps as usize).into_diagnostic()?;
    let selection = Selection::new(&catalogue, &duty, &file.rules);
    if let Some(path) = &options.report {
        let name = options.file.display().to_string();
        let page = report::page(&name, &file, &duty, &selection).into_diagnostic()?;
        write(path, page.unwrap_or_default().as_bytes())?;
    }
    match options.format {
        Format::Table => print(&size_text(options, &file, &duty, &selection))?,
        Format::Csv => print(&size_csv(&selection)?)?,
        Format::Json => print(&format!("{:#}\n", size_json(&file, &duty, &selection)))?,
    };
    Ok(if selection.fit.is_empty() {
        Done::Violated
    } else {
        Done::Holds
    })
}

fn motion(file: &MachineFile) -> Result<&Motion> {
    file.motion.as_ref().ok_or_else(|| {
        miette!(
            help = "add a [motion], for example type = \"constant-speed\", speed = \"60 rpm\"",
            "the machine file has no [motion]"
        )
    })
}

fn size_text(
    options: &cli::Size,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
) -> String {
    let input_power = |i: &crate::duty::Instant| i.input_torque * i.input_speed;
    let input = figures_table(&[
        ("torque [N m]", duty.figures(|i| i.input_torque), 1.0),
        ("speed [rpm]", duty.figures(|i| i.input_speed), RPM),
        ("power [W]", duty.figures(input_power), 1.0),
        ("inertia [kg cm^2]", duty.figures(|i| i.input_inertia), 1e-4),
    ]);
    let mut text = format!(
        "{}\n\nDuty at the input of the drive train, cycle {} s\n{input}\n\n",
        file.title,
        rounded(duty.duration)
    );
    let all = selection.fit.len() + selection.refused.len();
    if let Some(best) = selection.fit.first() {
        text += &format!("Best drive: {}\n{}\n", best.drive.name(), drive_text(best));
        text += &format!(
            "\n{} of {all} drives hold every rule\n",
            selection.fit.len()
        );
        let mut table = text_table(&[
            "rank",
            "motor",
            "gearbox",
            "rated [kW]",
            "RMS used",
            "peak used",
            "speed used",
            "λ max",
        ]);
        for (k, judged) in selection.fit.iter().take(options.top).enumerate() {
            table.add_row(rank_row(k + 1, judged));
        }
        text += &format!("{table}\nranked: {RANKING}\n");
    } else if let Some(nearest) = selection.refused.first() {
        text += &format!(
            "No drive of {all} holds every rule. The one that misses by least: {}\n{}\n",
            nearest.drive.name(),
            drive_text(nearest)
        );
    }
    if options.refused {
        text += "\nRefused\n";
        for judged in &selection.refused {
            text += &format!("  {}: {}\n", judged.drive.name(), judged.reasons());
        }
    } else if !selection.refused.is_empty() {
        text += &format!(
            "{} refused; --refused lists them with their reasons\n",
            selection.refused.len()
        );
    }
    if let Some(path) = &options.report {
        text += &format!("report written to {}\n", path.display());
    }
    text
}

/// Rows of min, mean, max and RMS, each in its unit.
fn figures_table(rows: &[(&str, Figures, f64)]) -> String {
    let mut table = text_table(&["", "min", "mean", "max", "RMS"]);
    for (name, figures, unit) in rows {
        let Figures {
            min,
            mean,
            max,
            rms,
        } = figures;
        let cells = [min, mean, max, rms].map(|x| rounded(x / unit));
        table.add_row(std::iter::once((*name).to_owned()).chain(cells));
    }
    table.to_string()
}

/// A drive's duty and how every rule came out.
fn drive_text(judged: &Judged) -> String {
    let duty = &judged.duty;
    let figures = figures_table(&[
        ("motor torque [N m]", duty.torque, 1.0),
        ("motor speed [rpm]", duty.speed, RPM),
        ("motor power [W]", duty.power, 1.0),
        ("inertia ratio λ", duty.inertia_ratio, 1.0),
    ]);
    format!(
        "{figures}\nper cycle {} J put in, {} J regenerated\n\n{}",
        rounded(duty.motoring_energy),
        rounded(duty.regenerative_energy),
        rules_table(judged)
    )
}

fn rules_table(judged: &Judged) -> String {
    let mut table = text_table(&["rule", "figure", "limit", "used", "verdict", "limit is"]);
    for check in &judged.checks {
        let with_unit = |x: f64| format!("{} {}", short(x), check.unit);
        table.add_row([
            check.rule.to_owned(),
            with_unit(check.value),
            check.limit.map_or(String::new(), with_unit),
            used(check),
            check.verdict.word().to_owned(),
            check.note.clone(),
        ]);
    }
    let mut text = table.to_string();
    for assumption in &judged.assumptions {
        text += &format!("\nassumed: {assumption}");
    }
    text
}

fn used(check: &Check) -> String {
    let share = check.limit.map(|_| check.use_of_limit() * 100.0);
    share.map_or(String::new(), |percent| format!("{percent:.0} %"))
}

fn rank_row(rank: usize, judged: &Judged) -> [String; 8] {
    let of = |rule: &str| {
        let check = judged.checks.iter().find(|c| c.rule == rule);
        check.map_or(String::new(), used)
    };
    let drive = &judged.drive;
    [
        rank.to_string(),
        drive.motor.key.clone(),
        drive.gearbox.map_or("direct".to_owned(), |g| g.key.clone()),
        format!("{:.2}", judged.rated_power() / 1000.0),
        of("RMS torque"),
        of("peak torque"),
        of("speed"),
        short(judged.duty.inertia_ratio.max),
    ]
}

fn size_csv(selection: &Selection) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record([
            "rank", "motor", "gearbox", "ratio", "verdict", "rule", "figure", "limit", "unit",
            "note",
        ])
        .into_diagnostic()?;
    let ranks = (1..=selection.fit.len()).map(|k| k.to_string());
    let ranks = ranks.chain(std::iter::repeat(String::new()));
    for (rank, judged) in ranks.zip(selection.fit.iter().chain(&selection.refused)) {
        for check in &judged.checks {
            let drive = &judged.drive;
            writer
                .write_record([
                    rank.as_str(),
                    &drive.motor.key,
                    drive.gearbox.map_or("", |g| g.key.as_str()),
                    &drive.ratio().to_string(),
                    check.verdict.word(),
                    check.rule,
                    &check.value.to_string(),
                    &check.limit.map_or(String::new(), |l| l.to_string()),
                    check.unit,
                    &check.note,
                ])
                .into_diagnostic()?;
        }
    }
    let bytes = writer.into_inner().map_err(|e| miette!("{e}"))?;
    String::from_utf8(bytes).into_diagnostic()
}

fn size_json(file: &MachineFile, duty: &Duty, selection: &Selection) -> Value {
    let judged = |judged: &Judged| {
        let drive = &judged.drive;
        json!({
            "motor": drive.motor.key,
            "gearbox": drive.gearbox.map(|g| &g.key),
            "ratio": drive.ratio(),
            "rated power [W]": judged.rated_power(),
            "verdict": judged.verdict(),
            "duty": judged.duty,
            "checks": judged.checks,
            "assumptions": judged.assumptions,
        })
    };
    json!({
        "schema": "jred-size/1",
        "title": file.title,
        "cycle [s]": duty.duration,
        "drive link torque [N m]": duty.figures(|i| i.terms.total()),
        "drive link speed [rad/s]": duty.figures(|i| i.omega),
        "input torque [N m]": duty.figures(|i| i.input_torque),
        "input speed [rad/s]": duty.figures(|i| i.input_speed),
        "input inertia [kg m^2]": duty.figures(|i| i.input_inertia),
        "holding torque [N m]": duty.hold_torque,
        "rules": file.rules,
        "ranking": RANKING,
        "fit": selection.fit.iter().map(judged).collect::<Vec<_>>(),
        "refused": selection.refused.iter().map(judged).collect::<Vec<_>>(),
    })
}

/// Prints to stdout; a closed pipe (`jred … | head`) is no error.
fn print(text: &str) -> Result<Done> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error)
            .into_diagnostic()
            .wrap_err("cannot write the result"),
        _ => Ok(Done::Holds),
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    std::fs::write(path, bytes)
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot write {}", path.display()))
}
