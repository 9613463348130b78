//! The table for the firmware, and every other number type and layout.

mod data;
mod failure;
mod summary;

use crate::answer::Answer;
use crate::table::reading::Reading;
use jred_export::{Export, SearchResult};
use jred_file::math;
use jred_file::model::coordinate::Coordinate;
use jred_file::number::rounding::short;
use jred_sizing::cell::Cell;

pub(crate) use data::ExportData;
pub use failure::{impossible, not_reached};
pub use summary::exceeded;
use summary::{left_out, summary};

/// The selected table, starred, and the sizes of the others.
pub fn answer(export: &Export) -> Answer<'static> {
    let summary = summary(export);
    let mut lines = summary.lines();
    let title = lines.next().unwrap_or_default();
    let mut answer = Answer::new(export.title.as_str(), &data::data(export)).titled(title);
    for line in lines {
        answer.sentence(line);
    }
    answer.heading("every number type and layout");
    answer.table(alternatives(export));
    answer
}

/// Source code with the summary as its comment.
pub fn commented(export: &Export, code: &str) -> String {
    let lines = summary(export);
    let lines = lines.lines().map(|line| format!("// {line}\n"));
    lines.collect::<String>() + code
}

/// The same summary for a program of a PLC, line by line: without what holds for Rust, and for ticks in single precision.
pub fn about_plc(export: &Export) -> String {
    let lines = summary(export);
    let lines = lines.lines().filter(|line| {
        !["in Rust: ", "measured in ticks: ", "forward dynamics: "]
            .iter()
            .any(|start| line.starts_with(start))
    });
    let computed = "the numbers are those of this table; computed in LREAL";
    lines
        .chain([computed])
        .flat_map(|line| [line, "\n"])
        .collect()
}

const fn effort_name(coordinate: Coordinate) -> &'static str {
    match coordinate {
        Coordinate::Angle => "torque",
        Coordinate::Length => "force",
    }
}

/// The part of a number range that is left, in bits.
fn headroom(usage: f32) -> Option<f64> {
    (usage > 0.0).then(|| -math::log2(f64::from(usage)))
}

/// Why it is not chosen, in a few words; empty if it meets the request.
const fn remark(found: &SearchResult) -> &'static str {
    match found {
        SearchResult::Meets(_) => "",
        SearchResult::Misses(_) => "misses",
        SearchResult::Refused(_) => "no size is usable",
        SearchResult::TooCoarse(..) => "too coarse",
        SearchResult::TooLarge(_) => "does not fit",
    }
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
        format!("instructions\non {}", export.task.core),
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
                    let cost = export.task.core.instructions(*number, *layout);
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
            row.push(remark(answer).to_owned());
            row.into_iter().map(Cell::Text).collect()
        });
    Reading {
        columns: columns.to_vec(),
        rows: rows.collect(),
        whole: columns.len(),
        ..Reading::default()
    }
}
