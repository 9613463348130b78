//! The drives that no other beats in everything: the Pareto front over two or three objectives.

use serde_json::{Value, json};

use crate::output::{Format, rounded, text_table};
use crate::rank::Objective;
use crate::size::{Candidate, Selection};

/// A drive of the front with its values, one for each objective.
#[derive(Clone, Debug)]
pub struct Point<'c> {
    /// The drive.
    pub candidate: Candidate<'c>,
    /// Its values.
    pub values: Vec<f64>,
}

/// The front.
#[derive(Clone, Debug)]
pub struct Front<'c> {
    /// The objectives.
    pub objectives: Vec<Objective>,
    /// Its drives, by the first objective.
    pub points: Vec<Point<'c>>,
    /// How many drives that fit were compared.
    pub compared: usize,
    /// For each objective, of how many drives it is not known; they are not compared.
    pub unknown: Vec<usize>,
}

impl<'c> Front<'c> {
    /// The drives that fit and that no other drive that fits beats: is as good in every objective and better in one. Of
    /// drives that are equal in all of them each is kept.
    pub fn new(selection: &Selection<'c>, objectives: &[Objective]) -> Self {
        let mut unknown = vec![0; objectives.len()];
        let mut points = Vec::new();
        for candidate in &selection.fit {
            let values: Vec<Option<f64>> = objectives
                .iter()
                .map(|o| o.value(selection, candidate))
                .collect();
            for (count, value) in unknown.iter_mut().zip(&values) {
                *count += usize::from(value.is_none());
            }
            if let Some(values) = values.into_iter().collect() {
                points.push(Point {
                    candidate: *candidate,
                    values,
                });
            }
        }
        let compared = points.len();
        let costs = |point: &Point| -> Vec<f64> {
            let pairs = objectives.iter().zip(&point.values);
            pairs
                .map(|(objective, value)| objective.cost(*value))
                .collect()
        };
        // In this order no point is beaten by one that follows.
        points.sort_by(|a, b| {
            let pairs = costs(a).into_iter().zip(costs(b));
            pairs.fold(std::cmp::Ordering::Equal, |order, (a, b)| {
                order.then(a.total_cmp(&b))
            })
        });
        let mut front: Vec<(Vec<f64>, Point)> = Vec::new();
        for point in points {
            let own = costs(&point);
            if !front.iter().any(|(other, _)| beats(other, &own)) {
                front.push((own, point));
            }
        }
        Self {
            objectives: objectives.to_vec(),
            points: front.into_iter().map(|(_, point)| point).collect(),
            compared,
            unknown,
        }
    }

    /// What could not be compared, in words.
    pub fn gaps(&self) -> Vec<String> {
        let pairs = self
            .objectives
            .iter()
            .zip(&self.unknown)
            .filter(|(_, n)| **n > 0);
        pairs
            .map(|(objective, n)| {
                format!(
                    "{n} drives that fit are left out: their {} is not known",
                    objective.name()
                )
            })
            .collect()
    }

    /// The front in one of the formats.
    pub fn write(&self, format: Format, title: &str) -> String {
        let row = |point: &Point| -> [String; 2] {
            let drive = &point.candidate.drive;
            [
                drive.motor.key.clone(),
                drive.gearbox.map_or_else(String::new, |g| g.key.clone()),
            ]
        };
        let columns = self.objectives.iter().map(|o| o.column().to_owned());
        match format {
            Format::Table => {
                let names = ["motor", "gearbox"].map(str::to_owned);
                let mut table = text_table(&names.into_iter().chain(columns).collect::<Vec<_>>());
                for point in &self.points {
                    let [motor, gearbox] = row(point);
                    let gearbox = if gearbox.is_empty() {
                        "direct".to_owned()
                    } else {
                        gearbox
                    };
                    let values = point.values.iter().map(|x| rounded(*x));
                    table.add_row([motor, gearbox].into_iter().chain(values));
                }
                let gaps: String = self
                    .gaps()
                    .iter()
                    .map(|gap| format!("mind: {gap}\n"))
                    .collect();
                format!(
                    "{title}\n{table}\n{} of {} drives: no other that fits is as good in all of these and better in one\n{gaps}",
                    self.points.len(),
                    self.compared
                )
            }
            Format::Csv => {
                let names = ["motor", "gearbox"].map(str::to_owned);
                let mut text = names
                    .into_iter()
                    .chain(columns)
                    .collect::<Vec<_>>()
                    .join(",")
                    + "\n";
                for point in &self.points {
                    let values = point.values.iter().map(|x| format!("{x:?}"));
                    text += &(row(point)
                        .into_iter()
                        .chain(values)
                        .collect::<Vec<_>>()
                        .join(",")
                        + "\n");
                }
                text
            }
            Format::Json => {
                let points = self.points.iter().map(|point| {
                    let [motor, gearbox] = row(point);
                    let gearbox = (!gearbox.is_empty()).then_some(gearbox);
                    json!({ "motor": motor, "gearbox": gearbox, "values": point.values })
                });
                let names: Vec<String> = columns.collect();
                let value = json!({
                    "schema": "jred-pareto/1",
                    "title": title,
                    "columns": names,
                    "compared": self.compared,
                    "unknown": self.unknown,
                    "front": points.collect::<Vec<Value>>(),
                });
                format!("{value:#}\n")
            }
        }
    }
}

/// Whether `a` costs no more than `b` in anything and less in something.
fn beats(a: &[f64], b: &[f64]) -> bool {
    let pairs = || a.iter().zip(b);
    pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
}
