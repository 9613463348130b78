//! The identified curves as the file of a machine of the type reduced-curves.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred_analysis::identify::{Cogging, CurvePoint, Estimate};
use jred_file::number::rounding::short;

use super::IdentifyView;
use crate::answer::Answer;

/// The loads of a file of reduced curves beside V′.
struct Loads {
    mean_load: f64,
    viscous: f64,
    /// Added to c of the curves: viscous friction that is negative, at the mean speed.
    more: f64,
}

impl Loads {
    /// With b and the mean of c, in the only direction of the logs (±1), at their mean speed (rad/s).
    fn new(mean_load: f64, [b, c]: [f64; 2], direction: Option<f64>, speed: f64) -> Self {
        let more = b.min(0.0) * speed;
        Self {
            mean_load: mean_load + direction.unwrap_or_default() * (c + more).min(0.0),
            viscous: b.max(0.0),
            more,
        }
    }

    /// c of the file, for the identified one.
    fn coulomb(&self, c: f64) -> f64 {
        (c + self.more).max(0.0)
    }
}

impl IdentifyView<'_> {
    /// The loads, of which friction is never negative: what is left of c in one direction is a mean load.
    fn loads(&self) -> Loads {
        let mean_load = self.mean(|found| found.mean_load.unwrap_or_default()).value;
        let [b, c] = [
            self.mean(|f| f.viscous).value,
            self.mean(|f| f.coulomb).value,
        ];
        let direction = self.logs.first().and_then(|log| log.found.direction());
        Loads::new(mean_load, [b, c], direction, self.mean_speed())
    }

    /// The mean speed of the logs in motion (rad/s), at which friction that falls with the speed is kept as Coulomb friction.
    fn mean_speed(&self) -> f64 {
        let each = self.logs.iter().map(|log| &log.found.excitation);
        let [turns, time] = each.fold([0.0, 0.0], |[turns, time], one| {
            [turns + one.turns, time + one.moving]
        });
        TAU * turns / time.max(1e-9)
    }

    /// Warnings of friction that is negative.
    pub(super) fn negative_friction(&self, curves: &[CurvePoint], answer: &mut Answer) {
        let b = self.mean(|f| f.viscous);
        if b.value < 0.0 {
            answer.warning(format!(
                "viscous friction is negative ({} ± {} N m s/rad); the CSV has 0, and c at the mean speed: record higher and lower speeds",
                short(b.value),
                short(b.band)
            ));
        }
        // In both directions c may be negative at some angles only.
        let least = curves
            .iter()
            .min_by(|a, b| a.coulomb.value.total_cmp(&b.coulomb.value));
        let least = least.map(|point| point.coulomb).unwrap_or_default();
        let more = self.loads().more;
        if least.value + more < 0.0 {
            let one = self.logs.first().and_then(|log| log.found.direction());
            let written = one.map_or(
                "the CSV has 0",
                |_| "in one direction this is a mean load; the CSV has it in T",
            );
            answer.warning(format!(
                "Coulomb friction{} is negative ({} ± {} N m); {written}: record both directions",
                if more < 0.0 { " at the mean speed" } else { "" },
                short(least.value + more),
                short(least.band)
            ));
        }
    }

    /// A warning of cogging that the points of the file are too few for.
    pub(super) fn cogging_left_out(&self, answer: &mut Answer) {
        let orders = self.logs.first().map_or(&[][..], |log| &log.found.cogging);
        let terms = orders.iter().enumerate().map(|(k, Cogging { order, .. })| {
            let part = |of: fn(&Cogging) -> Estimate| {
                let part = self.mean(|found| found.cogging.get(k).map(of).unwrap_or_default());
                short(part.value)
            };
            let [cosine, sine] = [part(|c| c.cosine), part(|c| c.sine)];
            format!("({cosine})·cos {order}φ + ({sine})·sin {order}φ")
        });
        let terms: Vec<String> = terms.collect();
        if !terms.is_empty() {
            answer.warning(format!(
                "the CSV, and a table exported from it, has no cogging above the order 24: add {} N m to the torque of each tick",
                terms.join(" + ")
            ));
        }
    }

    /// The curves as the file of a machine of the type reduced-curves.
    pub(super) fn reduced_curves(&self, curves: &[CurvePoint]) -> String {
        let loads = self.loads();
        let mut csv =
            "phi [deg],J [kg m^2],T [N m],T_potential [N m],b [N m s/rad],c [N m]\n".to_owned();
        for point in curves {
            // Writing to a text cannot fail. A difference from 0 is never -0.
            let _ = writeln!(
                csv,
                "{},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e}",
                short(point.phi.to_degrees()),
                point.inertia.value,
                0.0 - loads.mean_load,
                0.0 - point.potential_slope.value,
                loads.viscous,
                loads.coulomb(point.coulomb.value)
            );
        }
        csv
    }
}

#[cfg(test)]
mod tests {
    use super::Loads;

    /// b = −0.01 N m s/rad at 10 rad/s is −0.1 N m: with c in one direction the file has the sum, as friction or as a mean load.
    #[test]
    fn the_file_keeps_the_friction_of_one_direction() {
        for (c, sum) in [(0.05, -0.05), (-0.05, -0.15), (0.15, 0.05)] {
            for direction in [1.0, -1.0] {
                let loads = Loads::new(0.0, [-0.01, c], Some(direction), 10.0);
                let written = loads.coulomb(c) + direction * loads.mean_load;
                assert!((written - sum).abs() < 1e-12, "{written} instead of {sum}");
                assert!(loads.coulomb(c) >= 0.0);
            }
        }
    }
}
