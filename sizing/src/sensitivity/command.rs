//! `jred sensitivity`.

use indicatif::ProgressBar;
use miette::Result;

use super::{Dependence, Reach, Room, Sensitivity};
use crate::cli::search::Sensitivity as Options;
use crate::commands::{Done, print};
use crate::output::{Format, short};
use crate::vary::command::study;
use crate::vary::one::One;
use crate::vary::rows::Cell;
use crate::vary::sheet::Sheet;
use crate::vary::study::Study;

/// Runs `jred sensitivity`.
///
/// # Errors
/// Bad input.
pub fn sensitivity(options: &Options) -> Result<Done> {
    let filter = options.search.filter();
    let study = study(&options.file, &options.supply, &filter)?;
    let one = One::choose(
        &study,
        options.drive.as_deref(),
        &filter,
        options.search.rank,
    )?;
    let reach = Reach {
        change: options.change / 100.0,
        most: options.most.max(options.change) / 100.0,
    };
    let bar = ProgressBar::new(study.document.quantities().len() as u64);
    let sensitivity = Sensitivity::new(&study, &one, reach, || bar.inc(1))?;
    bar.finish_and_clear();
    let sheet = sheet(&study, &one, &sensitivity, reach, options.format);
    print(&sheet.write(options.format))?;
    let broken = sensitivity
        .dependences
        .iter()
        .any(|d| d.room.contains(&Room::Broken));
    Ok(if broken { Done::Violated } else { Done::Holds })
}

fn sheet(study: &Study, one: &One, found: &Sensitivity, reach: Reach, format: Format) -> Sheet {
    let all_rules = format != Format::Table;
    let mut columns: Vec<String> = [
        "quantity",
        "value",
        "moves most",
        "% of limit per +1 %",
        "+-",
        "down to [%]",
        "then",
        "up to [%]",
        "then (up)",
    ]
    .map(str::to_owned)
    .to_vec();
    if all_rules {
        columns.extend(
            found
                .shares
                .iter()
                .map(|(rule, _)| format!("{} [% of limit per +1 %]", rule.name())),
        );
    }
    let row = |dependence: &Dependence| -> Vec<Cell> {
        let quantity = study.document.quantities().get(dependence.quantity);
        let steepest = dependence.steepest().filter(|slope| slope.slope != 0.0);
        let [down, up] = dependence.room.each_ref().map(room);
        let mut cells: Vec<Cell> = vec![
            quantity.map_or(Cell::Empty, |q| q.path.as_str().into()),
            quantity.map_or(Cell::Empty, |q| q.shown().into()),
            steepest.map_or("nothing".into(), |slope| slope.rule.name().into()),
            steepest.map(|slope| slope.slope).into(),
            steepest.map(|slope| slope.uncertainty).into(),
        ];
        cells.extend(down);
        cells.extend(up);
        if all_rules {
            cells.extend(found.shares.iter().map(|(rule, _)| {
                let slope = dependence.slopes.iter().find(|slope| slope.rule == *rule);
                Cell::from(slope.map(|slope| slope.slope))
            }));
        }
        cells
    };
    let mut notes = Vec::new();
    notes.push(match found.first_to_break() {
        Some((quantity, Room::UpTo(change, rule))) => format!(
            "first to break: {} by {:+.2} % of {}",
            rule.name(),
            change * 100.0,
            study
                .document
                .quantities()
                .get(quantity)
                .map_or("", |q| q.path.as_str())
        ),
        _ if found
            .dependences
            .iter()
            .any(|d| d.room.contains(&Room::Broken)) =>
        {
            "the drive breaks a rule as it is: how far quantities may move is not looked for"
                .to_owned()
        }
        _ => format!(
            "no quantity alone breaks a rule within ±{} %",
            short(reach.most * 100.0)
        ),
    });
    if !all_rules {
        notes.push("--format csv and json have every rule".to_owned());
    }
    notes.extend(found.fixed.iter().map(|(index, why)| {
        let path = study
            .document
            .quantities()
            .get(*index)
            .map_or("", |q| q.path.as_str());
        format!("not moved: {path}: {why}")
    }));
    let shares: Vec<String> = (found.shares.iter())
        .map(|(rule, used)| format!("{} {:.1} %", rule.name(), used * 100.0))
        .collect();
    Sheet {
        schema: "jred-sensitivity/1",
        title: format!(
            "{}: {}; of the limits: {}",
            study.nominal.title,
            one.name(),
            shares.join(", ")
        ),
        columns,
        rows: found.dependences.iter().map(row).collect(),
        notes,
    }
}

/// How far, in per cent, and what comes then.
fn room(room: &Room) -> [Cell; 2] {
    let percent = Cell::from(room.change() * 100.0);
    match room {
        Room::AtLeast(_) => [percent, "holds still".into()],
        Room::UpTo(_, rule) => [percent, rule.name().into()],
        Room::Refused(_, why) => [percent, format!("refused: {why}").into()],
        Room::Broken => [Cell::Empty, Cell::Empty],
    }
}
