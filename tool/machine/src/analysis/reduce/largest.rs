//! The largest magnitudes of the forces over the motion, and where they occur.

use jred::Error;
use serde::{Serialize, Serializer};

use super::{Over, Request, Sets, reduce};
use crate::model::machine::MachineFile;
use crate::number::columns::{Column, Columns, Quantity};
use crate::number::rounding::short;

/// Positions that are searched at least.
const SEARCHED: usize = 1441;

/// The largest magnitude of one quantity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Largest {
    /// The quantity.
    #[serde(serialize_with = "title")]
    pub quantity: Column,
    /// The value there, with its sign.
    pub value: f64,
    /// What the rows run over.
    #[serde(serialize_with = "title")]
    pub over: Column,
    /// Where it occurs.
    pub at: f64,
}

impl Largest {
    /// Such as `drive 812.4 N m at phi = 341 deg`.
    pub fn sentence(&self) -> String {
        let (quantity, over) = (&self.quantity, &self.over);
        format!(
            "{} {} {} at {} = {} {}",
            quantity.name,
            short(self.value),
            quantity.unit,
            over.name,
            short(self.at),
            over.unit
        )
    }
}

fn title<S: Serializer>(column: &Column, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&column.title())
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
    let Some(over) = columns.heads().first() else {
        return Vec::new();
    };
    let all = columns.rows().iter().flat_map(|row| row.iter().skip(1));
    let scale = all.flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    let mut found = Vec::new();
    // Magnitudes and moments; the components say no more.
    let judged = [Quantity::DriveEffort, Quantity::Force, Quantity::Moment];
    for (k, head) in columns.heads().iter().enumerate() {
        if !judged.contains(&head.quantity) {
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
                quantity: head.clone(),
                value,
                over: over.clone(),
                at,
            });
        }
    }
    found
}
