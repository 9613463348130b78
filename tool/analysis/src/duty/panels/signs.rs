//! Times within a panel at which the power through a stage with losses, or at the input, changes sign.

use super::Panels;
use super::panel::PanelEnd;
use super::stretch::Stretch;
use crate::duty::Instant;
use crate::duty::error::DutyError;
use crate::duty::moving_machine::{DutyInstant, MovingMachine};
use jred_file::number::numerics;
use jred_file::number::parabola::Parabola;

/// Share of the largest torque below which the sign of a torque is rounding.
pub(super) const SIGN_ROUNDING: f64 = 1e-11;

/// Share of the middle value: where the parabola through three instants comes closer to zero than this, the torque may change sign between them, and
/// the panel is cut there.
const NEAR_ZERO: f64 = 0.1;

impl Panels<'_, '_> {
    /// The torques whose signs determine losses: of the stages with losses, and at the input.
    pub(super) fn flows_of(&self, instant: &Instant) -> Vec<f64> {
        let mut flows = vec![instant.input_torque];
        let train = &self.moving.file.drive_train;
        if train.is_lossy() {
            flows.extend(train.lossy_flows(&instant.output()));
        }
        flows
    }

    /// A power flow at a time.
    fn flow(&mut self, t: f64, which: usize) -> Result<f64, DutyError> {
        let now = self.moving.at(t)?;
        Ok(self
            .flows_of(&now.instant)
            .get(which)
            .copied()
            .unwrap_or(0.0))
    }

    /// The times within the panel at which the power through a stage with losses, or at the input, changes sign.
    pub(super) fn changes(
        &mut self,
        stretch: &Stretch,
        [first, last]: [&PanelEnd; 2],
        places: &[DutyInstant],
    ) -> Result<Vec<f64>, DutyError> {
        let mut times = vec![first.t];
        times.extend(places.iter().map(|now| now.instant.t));
        times.push(last.t);
        let rows: Vec<Vec<f64>> = ([&first.now].into_iter())
            .chain(places)
            .chain([&last.now])
            .map(|now| self.flows_of(&now.instant))
            .collect();
        let mut cuts = Vec::new();
        for which in 0..self.flows.len() {
            let least = SIGN_ROUNDING * self.flows[which];
            if least.is_infinite() {
                continue;
            }
            let value = |k: usize| {
                let is_rounding = k == 0 && first.is_zero || k + 1 == rows.len() && last.is_zero;
                let value = rows[k].get(which).copied().unwrap_or(0.0);
                (!is_rounding && value.abs() > least).then_some(value)
            };
            let known: Vec<(f64, f64)> = (0..rows.len())
                .filter_map(|k| Some((times[k], value(k)?)))
                .collect();
            let mut brackets: Vec<[(f64, f64); 2]> = (known.windows(2))
                .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
                .map(|pair| [pair[0], pair[1]])
                .collect();
            for three in known.windows(3) {
                let [a, b, c] = [three[0], three[1], three[2]];
                let touches =
                    b.1.abs() <= a.1.abs().min(c.1.abs()) && a.1 * b.1 > 0.0 && b.1 * c.1 > 0.0;
                if !touches {
                    continue;
                }
                let sign = -b.1.signum();
                let parabola =
                    Parabola::through([a.0, b.0, c.0], [sign * a.1, sign * b.1, sign * c.1]);
                let Some(at) = parabola.vertex().filter(|at| a.0 < *at && *at < c.0) else {
                    continue;
                };
                if parabola.at(at) > -NEAR_ZERO * b.1.abs() {
                    let beyond = self.flow(stretch.clamp(at), which)?;
                    if beyond * b.1 < 0.0 && beyond.abs() > least {
                        brackets.push([a, (at, beyond)]);
                        brackets.push([(at, beyond), c]);
                    }
                }
            }
            for [a, b] in brackets {
                let f = |t: f64| {
                    let mut moving = MovingMachine::new(self.moving.file, self.moving.motion);
                    let now = moving.at(stretch.clamp(t))?;
                    Ok::<f64, DutyError>(self.flows_of(&now.instant)[which])
                };
                cuts.push(numerics::zero(f, [a.0, b.0], [a.1, b.1], f64::EPSILON)?);
            }
        }
        cuts.sort_by(f64::total_cmp);
        // Changes common to two stages count once.
        let near = 1e-9 * (last.t - first.t);
        cuts.dedup_by(|next, before| *next - *before <= near.max(4.0 * f64::EPSILON * next.abs()));
        cuts.retain(|t| *t - first.t > near && last.t - *t > near);
        Ok(cuts)
    }
}
