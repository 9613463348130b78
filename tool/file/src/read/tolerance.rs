//! `[tolerance]`: deviations of quantities from their values in the file.

use crate::model::tolerance::{Distribution, Tolerance};
use crate::text::problem::Result;
use crate::text::section::Section;

/// The tolerances, in the order of the text.
pub(super) fn read(root: &Section) -> Result<Vec<Tolerance>> {
    const EXAMPLE: &str =
        "write \"±5 %\", \"0.1 mm\", or { normal = \"2 %\" } for a standard deviation";
    let Some(section) = root.maybe_table("tolerance")? else {
        return Ok(Vec::new());
    };
    let mut tolerances = Vec::new();
    for (path, item) in section.entries() {
        let place = item.key_span();
        let found = if item.is_table() {
            let table = item.section(format!("[tolerance.\"{path}\"]"))?;
            let [normal, uniform] = ["normal", "uniform"].map(|key| table.get(key));
            table.finish()?;
            let (shape, item) = match (normal, uniform) {
                (Some(item), None) => (Distribution::Normal, item),
                (None, Some(item)) => (Distribution::Uniform, item),
                _ => {
                    return Err(table
                        .problem(
                            format!("{} must have one of `normal` and `uniform`", table.title()),
                            "here",
                        )
                        .help(EXAMPLE));
                }
            };
            Tolerance::of(path, shape, item.text("2 %")?)
        } else {
            Tolerance::parse(path, item.text("±5 %")?)
        };
        let found = found.map_err(|why| {
            item.problem(&format!("is wrong: {why}"), "here")
                .help(EXAMPLE)
        })?;
        tolerances.push(Tolerance {
            place: Some(place),
            ..found
        });
    }
    Ok(tolerances)
}
