//! Friction and cogging, found and designed.

use jred_analysis::identify::{Cogging, CurvePoint, Estimate};
use jred_file::number::rounding::short;
use jred_sizing::cell::Cell;

use super::{Designed, IdentifyView, LogResult};
use crate::answer::Answer;
use crate::table::reading::{ColumnKind, Reading};

impl IdentifyView<'_> {
    /// The table of friction, mean load and cogging.
    pub(super) fn friction(&self, answer: &mut Answer) {
        let count = self.designed.len().max(1) as f64;
        let mean = |of: fn(&Designed) -> f64| self.designed.iter().map(of).sum::<f64>() / count;
        let row = |name: &str, found: Estimate, designed: Option<f64>| {
            let designed = designed.map_or(Cell::Empty, Cell::Number);
            let [value, band] = [found.value, found.band].map(Cell::Number);
            vec![Cell::Text(name.to_owned()), value, band, designed]
        };
        let mut rows = vec![
            row(
                "viscous friction b [N m s/rad]",
                self.mean(|f| f.viscous),
                Some(mean(|d| d.viscous)),
            ),
            row(
                "Coulomb friction c, mean [N m]",
                self.mean(|f| f.coulomb),
                Some(mean(|d| d.coulomb)),
            ),
        ];
        if self.logs.iter().all(|log| log.found.mean_load.is_some()) {
            let load = self.mean(|f| f.mean_load.unwrap_or_default());
            rows.push(row("mean load [N m]", load, None));
        }
        let orders = self.logs.first().map_or(&[][..], |log| &log.found.cogging);
        for (k, cogging) in orders.iter().enumerate() {
            let part = |of: fn(&Cogging) -> Estimate| {
                self.mean(|found| found.cogging.get(k).map(of).unwrap_or_default())
            };
            let order = cogging.order;
            rows.push(row(
                &format!("cogging, cos {order}φ [N m]"),
                part(|c| c.cosine),
                None,
            ));
            rows.push(row(
                &format!("cogging, sin {order}φ [N m]"),
                part(|c| c.sine),
                None,
            ));
        }
        answer.table(Reading {
            columns: ["", "identified", "95 % band ±", "designed, mean"]
                .map(str::to_owned)
                .into(),
            kinds: vec![
                ColumnKind::Words,
                ColumnKind::Quantity,
                ColumnKind::Quantity,
                ColumnKind::Quantity,
            ],
            rows,
            ..Reading::default()
        });
    }

    /// The range of Coulomb friction that depends on the angle.
    pub(super) fn friction_over_the_turn(&self, curves: &[CurvePoint], answer: &mut Answer) {
        let varies = |log: &LogResult| !log.found.coulomb_waves.is_empty();
        if self.logs.iter().any(varies) {
            let each = curves.iter().map(|point| point.coulomb.value);
            let [least, most] = each.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], c| {
                [a.min(c), b.max(c)]
            });
            let text = format!("{} to {} N m over the turn", short(least), short(most));
            answer.fact("Coulomb friction", text);
        }
    }
}
