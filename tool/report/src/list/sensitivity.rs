//! Sensitivities of a drive's rules as a sheet.

use crate::answer::sheet::Sheet;
use crate::table::reading::Reading;
use jred_file::number::rounding::{short, significant};
use jred_file::number::words::counted;
use jred_file::units::Vocabulary;
use jred_sizing::cell::Cell;
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::common::{Study, sentence};
use jred_sizing::study::sensitivity::{Dependence, Fixed, Reach, Room, Sensitivity};

/// Name and version of the form in JSON, and its columns; one more for each rule.
pub(crate) const FORM: &str = "jred-sensitivity/1";
pub(crate) const COLUMNS: [&str; 10] = [
    "quantity",
    "value",
    "unit",
    "affects most",
    "slope [% of limit per +1 %]",
    "uncertainty [% of limit per +1 %]",
    "down to [%]",
    "then down",
    "up to [%]",
    "then up",
];

/// An uncertainty below this share of a slope does not show in three digits.
const LAST_DIGIT: f64 = 0.005;

/// Every quantity with the slopes of the rules and the room until one is violated.
pub fn sheet(study: &Study, one: &ChosenDrive, found: &Sensitivity, reach: Reach) -> Sheet {
    let words = one.drive().motor.kind.vocabulary();
    let mut columns: Vec<String> = COLUMNS.map(str::to_owned).to_vec();
    columns.extend(
        found
            .shares
            .iter()
            .map(|(rule, _)| format!("{} [% of limit per +1 %]", rule.named(words))),
    );
    let row = |dependence: &Dependence| -> Vec<Cell> {
        let quantity = study.document.quantities().get(dependence.quantity);
        let steepest = dependence.steepest().filter(|slope| slope.slope != 0.0);
        let [down, up] = dependence.room.each_ref().map(|r| room(r, words));
        let mut cells: Vec<Cell> = vec![
            quantity.map_or(Cell::Empty, |q| q.path.as_str().into()),
            quantity
                .map(jred_sizing::study::edit::Quantity::number)
                .into(),
            quantity.map_or(Cell::Empty, |q| q.unit().into()),
            steepest.map_or("nothing".into(), |slope| slope.rule.named(words).into()),
            steepest.map(|slope| slope.slope).into(),
            steepest.map(|slope| slope.uncertainty).into(),
        ];
        cells.extend(down);
        cells.extend(up);
        cells.extend(found.shares.iter().map(|(rule, _)| {
            let slope = dependence.slopes.iter().find(|slope| slope.rule == *rule);
            Cell::from(slope.map(|slope| slope.slope))
        }));
        cells
    };
    let shares: Vec<String> = (found.shares.iter())
        .map(|(rule, used)| format!("{} {:.1} %", rule.named(words), used * 100.0))
        .collect();
    Sheet {
        schema: FORM,
        title: format!(
            "{}: {}; of the limits: {}",
            study.nominal.title,
            one.name(),
            shares.join(", ")
        ),
        columns,
        rows: found.dependences.iter().map(row).collect(),
        reading: Some(reading(study, found, words)),
        notes: notes(study, found, reach, words),
        // The first violation.
        lead: 1,
    }
}

/// The first violation, quantities left out of the table, and reasons why quantities were not varied.
fn notes(study: &Study, found: &Sensitivity, reach: Reach, words: &Vocabulary) -> Vec<String> {
    let path = |index: usize| {
        let quantity = study.document.quantities().get(index);
        quantity.map_or("", |q| q.path.as_str())
    };
    let mut notes = Vec::new();
    notes.push(match found.first_to_break() {
        Some((quantity, Room::UpTo(change, rule))) => format!(
            "first violation: {}, at {:+.2} % of {}",
            rule.named(words),
            change * 100.0,
            path(quantity)
        ),
        _ if found.is_broken() => {
            "the drive already violates a rule, so no margins are computed".to_owned()
        }
        _ => format!(
            "no single quantity causes a violation within ±{} %",
            short(reach.most * 100.0)
        ),
    });
    let idle = found.dependences.iter().filter(|d| d.is_idle());
    let idle: Vec<&str> = idle.map(|d| path(d.quantity)).collect();
    if !idle.is_empty() {
        notes.push(format!(
            "{} no rule: {}",
            counted(idle.len(), "quantity affects", "quantities affect"),
            idle.join(", ")
        ));
    }
    if found.left_out > 0 {
        notes.push(format!(
            "{} in [simulation] and [tolerance] left out: no rule depends on them",
            counted(found.left_out, "quantity", "quantities")
        ));
    }
    for dependence in &found.dependences {
        for room in &dependence.room {
            if let Room::Refused(change, why) = room {
                let change = significant(change * 100.0, 3);
                let path = path(dependence.quantity);
                let why = sentence(why);
                notes.push(format!("invalid beyond {change} % of {path}: {why}"));
            }
        }
    }
    let whole = found.dependences.iter().filter(|d| d.whole);
    let whole: Vec<&str> = whole.map(|d| path(d.quantity)).collect();
    if !whole.is_empty() {
        notes.push(format!(
            "by one more and one less, because they are whole numbers: {}",
            whole.join(", ")
        ));
    }
    notes.extend(
        (found.fixed.iter())
            .map(|(index, why)| format!("not varied: {}: {}", path(*index), fixed(why))),
    );
    notes
}

fn fixed(why: &Fixed) -> String {
    match why {
        Fixed::Zero => "zero has no relative change".to_owned(),
        Fixed::Refused(why) => sentence(why),
        Fixed::OneLess(why) => format!("one less: {}", sentence(why)),
        Fixed::OneMore(why) => format!("one more: {}", sentence(why)),
    }
}

/// The table for reading; shows the uncertainty of a slope only if it affects the digits shown.
fn reading(study: &Study, found: &Sensitivity, words: &Vocabulary) -> Reading {
    let columns = [
        "quantity",
        "value",
        "affects most",
        "% of limit per +1 %",
        "may fall",
        "may rise",
    ];
    let row = |dependence: &Dependence| -> Vec<Cell> {
        let quantity = study.document.quantities().get(dependence.quantity);
        let steepest = dependence.steepest().filter(|slope| slope.slope != 0.0);
        let slope = steepest.map(|slope| {
            let sure = slope.uncertainty <= LAST_DIGIT * slope.slope.abs();
            let own = significant(slope.slope, 3);
            if sure {
                own
            } else {
                format!("{own} ± {}", significant(slope.uncertainty, 1))
            }
        });
        let mut cells: Vec<Cell> = vec![
            quantity.map_or(Cell::Empty, |q| q.path.as_str().into()),
            quantity.map_or(Cell::Empty, |q| q.shown().into()),
            steepest.map_or("nothing".into(), |slope| slope.rule.named(words).into()),
            slope.map_or(Cell::Empty, Cell::from),
        ];
        cells.extend(dependence.room.iter().map(|room| room_words(room, words)));
        cells
    };
    let moving = found.dependences.iter().filter(|d| !d.is_idle());
    Reading::new(columns, moving.map(row), 2)
}

/// The same as text; a note tells why the machine file becomes invalid.
fn room_words(room: &Room, words: &Vocabulary) -> Cell {
    let change = significant(room.change() * 100.0, 3);
    match room {
        Room::AtLeast(_) => format!("satisfied at {change} %").into(),
        Room::UpTo(_, rule) => format!("{change} %, then {}", rule.named(words)).into(),
        Room::Refused(..) => format!("{change} %, then invalid").into(),
        Room::Broken => Cell::Empty,
    }
}

/// Room in per cent, and its limit.
fn room(room: &Room, words: &Vocabulary) -> [Cell; 2] {
    let percent = Cell::from(room.change() * 100.0);
    match room {
        Room::AtLeast(_) => [percent, "still satisfied".into()],
        Room::UpTo(_, rule) => [percent, rule.named(words).into()],
        Room::Refused(_, why) => [percent, format!("invalid: {}", sentence(why)).into()],
        Room::Broken => [Cell::Empty, Cell::Empty],
    }
}
