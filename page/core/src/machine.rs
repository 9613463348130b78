//! Requests about the machine without a drive: curves, drawing, flywheel, table for the firmware.

use jred_analysis::checked;
use jred_analysis::duty::{Duty, Sampling};
use jred_analysis::reduce::{self, Over, Sets, reduce};
use jred_analysis::simulate::CoupledMachines;
use jred_analysis::steady::{SteadyRequest, steady_together};
use jred_export::{
    BLOCK_NAMES, Core, Export, Failure, LayoutChoice, Name, Number, OutputForm, Task,
};
use jred_file::argument::Argument;
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::number::words::Word as _;
use jred_file::problem;
use jred_file::text::key::EFFORT;
use jred_file::text::problem::{Problem, Result};
use jred_report::answer::Answer;
use jred_report::drawing;
use jred_report::list;
use jred_report::table::output::Format;
use jred_report::table::screen::Screen;
use serde_json::json;

use crate::request::Request;

/// The JSON of an answer.
pub(crate) fn written(answer: &Answer) -> String {
    answer.write(Format::Json, Screen::default()).collect()
}

/// `jred reduce --format json`
pub(crate) fn curves(request: &Request) -> Result<String> {
    let file = request.machine()?;
    variator::refuse(&file, "reduce")?;
    let sets = Sets {
        curves: true,
        ..Sets::default()
    };
    let asked = reduce::Request {
        over: match request.text("over") {
            Some("time") => Over::Time,
            _ => Over::Angle,
        },
        positions: request.count("positions", 36).clamp(2, 10_000),
        sets,
        state: None,
    };
    let columns = reduce(&file, &asked).map_err(Problem::of)?;
    let view = list::reduction::ReductionView {
        file: &file,
        sets,
        columns: &columns,
        largest: &[],
        passed: !(file.motion.is_some() && columns.has_empty_cells(usize::MAX)),
        is_at_positions: false,
        not_contained: &reduce::not_contained(&file, &asked),
    };
    Ok(written(&view.answer()))
}

/// The machine drawn, with the data to move it.
pub(crate) fn drawing(request: &Request) -> Result<String> {
    let file = checked::parse(&request.name(), request.source(), request.files())?;
    let drawn = drawing::moving(&file.machine).map_err(Problem::of)?;
    Ok(format!(
        "{{\"svg\":{},\"track\":{}}}",
        json!(drawn.svg),
        drawn.track
    ))
}

/// `jred steady --format json`
pub(crate) fn flywheel(request: &Request) -> Result<String> {
    let file = checked::parse(&request.name(), request.source(), request.files())?;
    variator::refuse(&file, "steady")?;
    let simulation = file.simulation.clone().ok_or_else(|| {
        problem!(
            help = "add a [simulation] with start_angle, duration, output_step and the motor: torque, torque_speed, dc_motor or induction_motor",
            "{} has no [simulation], which gives the motor",
            file.name
        )
    })?;
    let machines = CoupledMachines::alone(&file);
    let asked = SteadyRequest {
        delta: request.field("delta").as_f64(),
        mean_speed: None,
        turns: None,
        positions: 36,
    };
    let steady = steady_together(&machines, &simulation, &asked)
        .map_err(|why| list::steady::problem(&why))?;
    Ok(written(&list::steady::answer(&machines, &steady)))
}

/// `jred export`: a file to download.
pub(crate) fn export(request: &Request) -> Result<String> {
    let file = request.machine_warned()?;
    file.refuse_joint_friction("export")?;
    variator::refuse(&file, "export")?;
    let form = request.text("form").and_then(OutputForm::of_word);
    let form = form.unwrap_or_default();
    let plc = matches!(form, OutputForm::St | OutputForm::Plcopen);
    let task = task(request, &file, plc)?;
    let export = Export::new(&file, task.clone()).map_err(|why| match why {
        Failure::NotReached(why) => {
            let coordinate = file.machine.mechanism().coordinate();
            Problem::new(list::export::not_reached(&why, &task, coordinate))
        }
        Failure::Impossible(why) => list::export::impossible(&why, &file, &task),
        Failure::Machine(error) => Problem::of(error),
    })?;
    let about = written(&list::export::answer(&export));
    let stem = request.name();
    let stem = stem
        .rsplit_once('.')
        .map_or(stem.as_str(), |(stem, _)| stem);
    let commented = |code: &str| list::export::commented(&export, code);
    let plc_name = || Name::for_plc_of_file(stem, &BLOCK_NAMES);
    let (end, text) = match form {
        OutputForm::C => ("h", commented(&export.c_source(&Name::of_file(stem)))),
        OutputForm::Rust => ("rs", commented(&export.rust_source(None))),
        OutputForm::St => {
            let text = export.structured_text(&plc_name(), &list::export::about_plc(&export));
            ("st", text.unwrap_or_default())
        }
        OutputForm::Plcopen => {
            let day = request.text("day").unwrap_or_default();
            let text = export.plcopen(&plc_name(), &list::export::about_plc(&export), day);
            ("xml", text.unwrap_or_default())
        }
        OutputForm::Json | OutputForm::Cia402 => ("json", about.clone()),
        OutputForm::Image => {
            let bytes = export.image().unwrap_or_default();
            let name = json!(format!("{stem}.jred"));
            return Ok(format!(
                "{{\"name\":{name},\"bytes\":{},\"about\":{about}}}",
                json!(bytes)
            ));
        }
    };
    let (name, text) = (json!(format!("{stem}.{end}")), json!(text));
    Ok(format!(
        "{{\"name\":{name},\"text\":{text},\"about\":{about}}}"
    ))
}

/// The table with the default options of the command.
fn task(request: &Request, file: &MachineFile, plc: bool) -> Result<Task> {
    let coordinate = file.machine.mechanism().coordinate();
    let error = request.text("torqueError").unwrap_or_default();
    let error = Argument::positive(EFFORT).read(error, coordinate);
    let error = error.map_err(|why| problem!("the torque error cannot be used: {why}"))?;
    let motion = file.required_motion()?;
    let duty = Duty::new(file, motion, Sampling::default()).map_err(Problem::from)?;
    let omega = duty.figures(|i| i.omega).peak();
    let alpha = duty.figures(|i| i.alpha).peak();
    Ok(Task {
        number: Number::default(),
        layout: if plc {
            LayoutChoice::Spline
        } else {
            LayoutChoice::default()
        },
        core: Core::default(),
        forward: false,
        reciprocal: false,
        torque_error: Some(error),
        max_bytes: None,
        max_cells: 4096,
        omega,
        alpha: if alpha > 0.0 { alpha } else { omega * omega },
        rotor: 0.0,
        edges: Vec::new(),
        machine: None,
    })
}
