//! A simulated motion, for reading and as JSON.

use serde_json::{Map, json};

use crate::table::output::{Format, json_parts, parts};
use jred_machine::analysis::simulate::Simulated;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::simulation::Simulation;
use jred_machine::number::rounding::short;

/// The motion in one of the formats, part by part; CSV is the rows alone.
pub fn write<'s>(
    file: &MachineFile,
    simulation: &Simulation,
    found: &'s Simulated,
    format: Format,
) -> Box<dyn Iterator<Item = String> + 's> {
    let kind = if simulation.control.is_some() {
        "motion under its controller"
    } else {
        "free motion"
    };
    let title = format!(
        "{}: {kind}, Dormand-Prince 8(5,3), tolerance {:e}",
        file.title, simulation.tolerance
    );
    let coordinate = file.machine.mechanism().coordinate();
    match format {
        Format::Csv => parts(&found.columns, format, ""),
        Format::Table => {
            let lines = [
                impacts(found, coordinate),
                rest(simulation, found, coordinate),
            ];
            let title = lines
                .into_iter()
                .flatten()
                .fold(title, |title, line| title + "\n" + &line);
            parts(&found.columns, format, &title)
        }
        Format::Json => {
            let mut before = Map::new();
            before.insert("title".into(), title.into());
            let rest = found.rest.map(|rest| {
                let way = format!("way [{}]", coordinate.unit());
                json!({ "time [s]": rest.time, way: coordinate.shown(rest.way) })
            });
            let mut after = Map::new();
            if let Some(impacts) = found.impacts {
                let (position, speed) = (
                    format!("position [{}]", coordinate.unit()),
                    format!("speed [{}]", coordinate.speed_unit()),
                );
                let first = json!({
                    "time [s]": impacts.time,
                    position: coordinate.shown(impacts.position),
                    speed: impacts.speed,
                });
                after.insert(
                    "impacts".into(),
                    json!({ "count": impacts.count, "first": first }),
                );
            }
            if simulation.halt.is_some() {
                after.insert("rest".into(), json!(rest));
            }
            if let Some(error) = &found.ended {
                after.insert("ended".into(), error.to_string().into());
            }
            Box::new(json_parts(&found.columns, before, after))
        }
    }
}

/// The sentence about end stops.
fn impacts(found: &Simulated, coordinate: Coordinate) -> Option<String> {
    let impacts = found.impacts?;
    let all = match impacts.count {
        1 => String::new(),
        count => format!("; {count} impacts in all"),
    };
    Some(format!(
        "warning: the drive link hits its end stop, {}, at {} s with {} {}{all}",
        coordinate.place(impacts.position),
        short(impacts.time),
        short(impacts.speed),
        coordinate.speed_unit()
    ))
}

/// The sentence about the stop.
fn rest(simulation: &Simulation, found: &Simulated, coordinate: Coordinate) -> Option<String> {
    let halt = simulation.halt?;
    let off = format!("the motor is switched off at {} s", short(halt.time));
    Some(match found.rest {
        Some(rest) => format!(
            "{off}; the machine comes to rest {} s and {} {} later",
            short(rest.time),
            short(coordinate.shown(rest.way)),
            coordinate.unit()
        ),
        None => format!("{off}; the machine has not come to rest by the end"),
    })
}
