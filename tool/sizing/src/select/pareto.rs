//! The Pareto front of the suitable drives over two or three objectives.

use jred_file::problem;
use jred_file::text::problem::Problem;

use crate::select::rank::Objective;
use crate::select::size::{Candidate, Selection};
use jred_file::number::words::counted;

/// A drive of the front with its values, one for each objective.
#[derive(Clone, Debug)]
pub struct ParetoPoint<'c> {
    /// The drive.
    pub candidate: Candidate<'c>,
    /// Its mass (kg), if in the catalogue.
    pub mass: Option<f64>,
    /// Its price, if in the catalogue.
    pub price: Option<f64>,
    /// Its values.
    pub values: Vec<f64>,
}

/// The front.
#[derive(Clone, Debug)]
pub struct Front<'c> {
    /// The objectives.
    pub objectives: Vec<Objective>,
    /// Its drives, by the first objective.
    pub points: Vec<ParetoPoint<'c>>,
    /// Number of suitable drives.
    pub fit: usize,
    /// Number of drives compared.
    pub compared: usize,
    /// For each objective, the number of drives without data, which are not compared.
    pub unknown: Vec<usize>,
}

impl<'c> Front<'c> {
    /// The suitable drives for which no other suitable drive is as good in every objective and better in one. Drives that
    /// are equal in all objectives are all kept.
    pub fn new(selection: &Selection<'c>, objectives: &[Objective]) -> Self {
        let mut unknown = vec![0; objectives.len()];
        let mut points = Vec::new();
        let fit = selection.first_fit(usize::MAX);
        for candidate in &fit {
            let values: Vec<Option<f64>> = objectives
                .iter()
                .map(|o| o.value(selection, candidate))
                .collect();
            for (count, value) in unknown.iter_mut().zip(&values) {
                *count += usize::from(value.is_none());
            }
            if let Some(values) = values.into_iter().collect() {
                points.push(ParetoPoint {
                    candidate: *candidate,
                    mass: None,
                    price: None,
                    values,
                });
            }
        }
        let compared = points.len();
        let costs = |point: &ParetoPoint| -> Vec<f64> {
            let pairs = objectives.iter().zip(&point.values);
            pairs
                .map(|(objective, value)| objective.cost(*value))
                .collect()
        };
        // In this order no point is dominated by a later one.
        points.sort_by(|a, b| {
            let pairs = costs(a).into_iter().zip(costs(b));
            pairs.fold(std::cmp::Ordering::Equal, |order, (a, b)| {
                order.then(a.total_cmp(&b))
            })
        });
        let mut front: Vec<(Vec<f64>, ParetoPoint)> = Vec::new();
        for point in points {
            let own = costs(&point);
            if !front.iter().any(|(other, _)| beats(other, &own)) {
                front.push((own, point));
            }
        }
        Self {
            objectives: objectives.to_vec(),
            points: (front.into_iter())
                .map(|(_, point)| ParetoPoint {
                    mass: Objective::Mass.value(selection, &point.candidate),
                    price: Objective::Price.value(selection, &point.candidate),
                    ..point
                })
                .collect(),
            fit: fit.len(),
            compared,
            unknown,
        }
    }

    /// Sentences about drives that could not be compared.
    pub fn gaps(&self) -> Vec<String> {
        let pairs = self
            .objectives
            .iter()
            .zip(&self.unknown)
            .filter(|(_, n)| **n > 0);
        pairs
            .map(|(objective, n)| {
                format!(
                    "{n} suitable drives left out: no data for their {objective} in the catalogue; fill in the column, or use another objective"
                )
            })
            .collect()
    }

    /// Why no suitable drive could be compared; `None` if one was, or if no drive is suitable.
    pub fn obstacle(&self) -> Option<Problem> {
        if self.compared > 0 || self.fit == 0 {
            return None;
        }
        let missing = self.objectives.iter().zip(&self.unknown);
        let missing: Vec<String> = missing
            .filter(|(_, n)| **n > 0)
            .map(|(objective, n)| match *n {
                n if n == self.fit => format!("none has data for the {objective}"),
                n => format!("{} no data for the {objective}", counted(n, "has", "have")),
            })
            .collect();
        Some(problem!(
            help =
                "fill in the column of the catalogue (docs/catalogue.md), or use another objective",
            "{} suitable, but {}: there is nothing to compare",
            counted(self.fit, "drive is", "drives are"),
            missing.join(", ")
        ))
    }
}

/// Whether `a` is at most `b` in every value and below it in one.
fn beats(a: &[f64], b: &[f64]) -> bool {
    let pairs = || a.iter().zip(b);
    pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
}
