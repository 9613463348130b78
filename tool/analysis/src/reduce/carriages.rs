//! Carriages as columns: position and motion of each along its guide, and the force that its own axis needs.

use jred::error::Error;

use super::{RowPose, Set, Source};
use jred_file::number::columns::{Column, ColumnQuantity};

/// s, ṡ, s̈ and F of every carriage: data for sizing the axis that moves it.
pub(super) struct Carriages {
    /// Also each carriage's share of J_red.
    pub(super) shares: bool,
}

/// Symbols and units of its columns.
const COLUMNS: [(&str, &str); 4] = [("s", "m"), ("v", "m/s"), ("a", "m/s^2"), ("F", "N")];

impl Set for Carriages {
    fn heads(&self, source: &Source) -> Vec<Column> {
        let carriages = source.file.schedule.carriages().iter();
        let coordinate = source.coordinate;
        let mut heads = Vec::new();
        for carriage in carriages {
            let name = &carriage.name;
            heads.extend(
                COLUMNS.map(|(symbol, unit)| Column::of(ColumnQuantity::Other, name, symbol, unit)),
            );
            if self.shares {
                let name = format!("{} {name}", coordinate.inertia());
                heads.push(Column::other(name, coordinate.inertia_unit()));
            }
        }
        heads
    }

    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let gravity = source.machine.gravity();
        let mut values = Vec::new();
        for carriage in source.file.schedule.carriages() {
            let state = place.now.t.map(|t| carriage.at(t));
            values.extend([
                state.map(|s| s.phi),
                state.map(|s| s.omega),
                state.map(|s| s.alpha),
            ]);
            let frame = place.frames.get(carriage.mass.link);
            let at = place.now.t.zip(place.state).zip(frame);
            values.push(at.map(|((t, drive), frame)| {
                carriage.effort(frame, t, [drive.omega, drive.alpha], gravity)
            }));
            if self.shares {
                let share = place.now.t.zip(frame).map(|(t, frame)| {
                    let [inertia, ..] = carriage.placed(t).alone()?.reduced_inertia(frame);
                    Ok::<_, Error>(inertia)
                });
                values.push(share.transpose()?);
            }
        }
        Ok(values)
    }
}
