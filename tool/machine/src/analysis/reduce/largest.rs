//! The largest magnitudes of the forces over the motion, and where they occur.

use jred::Error;
use serde::Serialize;

use super::{Over, Request, Sets, reduce};
use crate::model::machine::MachineFile;
use crate::number::columns::Columns;
use crate::number::rounding::short;

/// Positions that are searched at least.
const SEARCHED: usize = 1441;

/// The largest magnitude of one quantity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Largest {
    /// The column's name, with its unit.
    pub quantity: String,
    /// The value there, with its sign.
    pub value: f64,
    /// Name and unit of what the rows run over.
    pub over: String,
    /// Where it occurs.
    pub at: f64,
}

impl Largest {
    /// Such as `drive 812.4 N m at phi = 341 deg`.
    pub fn sentence(&self) -> String {
        let (name, unit) = split(&self.quantity);
        let (place, place_unit) = split(&self.over);
        let value = short(self.value);
        format!(
            "{name} {value} {unit} at {place} = {} {place_unit}",
            short(self.at)
        )
    }
}

/// A column's name without its unit, and the unit.
fn split(name: &str) -> (&str, &str) {
    let (words, unit) = name.split_at(name.find('[').unwrap_or(name.len()));
    (words.trim(), unit.trim_matches(['[', ']']))
}

/// The largest drive torque, joint forces, and shaking force of the request, searched at no fewer than 1441 positions (the
/// quarter degrees of a turn).
///
/// # Errors
/// Those of the machine.
pub fn largest(file: &MachineFile, request: &Request) -> Result<Vec<Largest>, Error> {
    let sets = Sets {
        reactions: true,
        ..Sets::default()
    };
    let positions = match request.over {
        Over::Angle => request.positions.max(SEARCHED - 1),
        Over::Time => request.positions.max(SEARCHED),
    };
    let columns = reduce(
        file,
        &Request {
            positions,
            sets,
            ..*request
        },
    )?;
    Ok(of_columns(&columns))
}

fn of_columns(columns: &Columns) -> Vec<Largest> {
    let names = columns.names();
    let over = names.first().cloned().unwrap_or_default();
    let all = columns.rows().iter().flat_map(|row| row.iter().skip(1));
    let scale = all.flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    let mut found = Vec::new();
    for (k, name) in names.iter().enumerate() {
        // Magnitudes and moments; the components say no more.
        let judged = ["_drive [", " F [N]", " M [N m]"];
        if !judged.iter().any(|part| name.contains(part)) {
            continue;
        }
        let values = columns.rows().iter().filter_map(|row| {
            let value = row.get(k).copied().flatten()?;
            Some((value, row.first().copied().flatten()?))
        });
        let most = values.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        // A guide through the centre of mass of its slider has no moment but roundings.
        if let Some((value, at)) = most.filter(|(value, _)| value.abs() > 1e-12 * scale) {
            found.push(Largest {
                quantity: name.clone(),
                value,
                over: over.clone(),
                at,
            });
        }
    }
    found
}
