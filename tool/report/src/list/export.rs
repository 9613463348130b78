//! The table for the firmware, and every other number type and layout.

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::Reading;
use jred_export::data::{ExportData, FORM};
use jred_export::{Export, SearchResult};
use jred_file::number::rounding::short;
use jred_sizing::study::cell::Cell;

impl Data for ExportData {
    const FORM: &'static str = FORM;
}

/// The selected table, starred, and the sizes of the others.
pub fn answer(export: &Export) -> Answer<'static> {
    let summary = export.summary();
    let mut lines = summary.lines();
    let title = lines.next().unwrap_or_default();
    let mut answer = Answer::new(title, &export.data());
    for line in lines {
        answer.sentence(line);
    }
    answer.heading("every number type and layout");
    answer.table(alternatives(export));
    answer
}

fn alternatives(export: &Export) -> Reading {
    let effort = export.coordinate.effort_unit();
    let columns = [
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
    ];
    let rows = export
        .answers
        .iter()
        .enumerate()
        .map(|(k, (number, layout, answer))| {
            let star = if k == export.chosen { "*" } else { "" };
            let mut row = vec![
                star.to_owned(),
                number.name().to_owned(),
                layout.name().to_owned(),
            ];
            match answer {
                SearchResult::Meets(c) | SearchResult::Misses(c) => {
                    let cost = export.core().instructions(*number, *layout);
                    row.extend([
                        c.cells().to_string(),
                        c.row_bytes().to_string(),
                        c.bytes().to_string(),
                        cost.map_or_else(String::new, |cost| cost.to_string()),
                        short(c.error()),
                        short(c.ticks().torque),
                    ]);
                }
                SearchResult::Refused(_)
                | SearchResult::TooCoarse(..)
                | SearchResult::TooLarge(_) => {
                    row.extend(std::iter::repeat_n(String::new(), 6));
                }
            }
            row.push(answer.remark().to_owned());
            row.into_iter().map(Cell::Text).collect()
        });
    Reading {
        columns: columns.to_vec(),
        rows: rows.collect(),
        whole: columns.len(),
        ..Reading::default()
    }
}
