//! What every number type and layout of a firmware table takes.

use comfy_table::CellAlignment;

use crate::table::output::text_table;
use jred_machine::export::{Answer, Export};
use jred_machine::number::rounding::short;

/// Size of every number type and layout; the one chosen is starred.
pub fn alternatives(export: &Export) -> String {
    let effort = export.coordinate.effort_unit();
    let mut table = text_table(&[
        String::new(),
        "type".into(),
        "layout".into(),
        "cells".into(),
        "bytes\nof rows".into(),
        "bytes\nof image".into(),
        format!("instructions\non {}", export.core()),
        format!("error\n[{effort}]"),
        format!("in ticks\n[{effort}]"),
        String::new(),
    ]);
    for (k, (number, layout, answer)) in export.answers.iter().enumerate() {
        let star = if k == export.chosen { "*" } else { "" };
        let mut row = vec![
            star.to_owned(),
            number.name().to_owned(),
            layout.name().to_owned(),
        ];
        let cost = export.core().instructions(*number, *layout);
        let cost = cost.map_or_else(String::new, |cost| cost.to_string());
        match answer {
            Answer::Meets(c) | Answer::Misses(c) => {
                row.extend([
                    c.cells().to_string(),
                    c.row_bytes().to_string(),
                    c.bytes().to_string(),
                    cost,
                    short(c.error()),
                    short(c.ticks().torque),
                    answer.remark().to_owned(),
                ]);
            }
            Answer::Refused(_) | Answer::TooCoarse(..) | Answer::TooLarge(_) => {
                row.extend(std::iter::repeat_n(String::new(), 6));
                row.push(answer.remark().to_owned());
            }
        }
        table.add_row(row);
    }
    for (k, column) in table.column_iter_mut().enumerate() {
        if (3..9).contains(&k) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    format!("{table}\n")
}
