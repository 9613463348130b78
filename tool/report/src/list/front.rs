//! The Pareto front as a table, CSV or JSON.

use serde_json::{Value, json};

use super::marks;
use crate::table::output::{Format, text_table};
use crate::table::rows::csv_line;
use jred_machine::number::rounding::rounded;
use jred_sizing::catalogue::Drive;
use jred_sizing::select::pareto::{Front, Point};
use jred_sizing::select::rank::Objective;
use jred_sizing::study::cell::Cell;

/// The front in one of the formats.
pub fn write(front: &Front, format: Format, title: &str) -> String {
    let row = |point: &Point| -> [String; 3] {
        let drive = &point.candidate.drive;
        [
            drive.motor.key.clone(),
            drive.gearbox.map_or_else(String::new, |g| g.key.clone()),
            drive.amplifier.map_or_else(String::new, |a| a.key.clone()),
        ]
    };
    // What is an objective has a column of its own.
    let own = |objective: Objective| !front.objectives.contains(&objective);
    let figures = move |point: &Point| -> Vec<Option<f64>> {
        let ratio = std::iter::once(Some(point.candidate.drive.ratio()));
        let mass = own(Objective::Mass).then_some(point.mass);
        ratio
            .chain(mass)
            .chain(own(Objective::Price).then_some(point.price))
            .collect()
    };
    let more = std::iter::once("ratio")
        .chain(own(Objective::Mass).then_some("mass [kg]"))
        .chain(own(Objective::Price).then_some("price"));
    let names = ["motor", "gearbox", "amplifier"].into_iter().chain(more);
    let names: Vec<String> = names.map(str::to_owned).collect();
    let columns = front.objectives.iter().map(|o| o.column().to_owned());
    match format {
        Format::Table => {
            let mut names = names;
            names.insert(1, "made for".to_owned());
            let mut table = text_table(&names.into_iter().chain(columns).collect::<Vec<_>>());
            for point in &front.points {
                let values = point.values.iter().map(|x| rounded(*x));
                let known = |figure: Option<f64>| figure.map_or("–".to_owned(), rounded);
                let figures = figures(point).into_iter().map(known);
                let drive = &point.candidate.drive;
                let [motor, gearbox, amplifier] = marks::drive(drive);
                let row = [motor, marks::made_for(drive), gearbox, amplifier];
                let row = row.into_iter().chain(figures);
                table.add_row(row.chain(values));
            }
            let drives: Vec<Drive> = front.points.iter().map(|p| p.candidate.drive).collect();
            let legend: Vec<String> = (marks::legend(&drives).iter())
                .map(|line| format!("{line}\n"))
                .collect();
            let gaps: Vec<String> = front
                .gaps()
                .iter()
                .map(|gap| format!("warning: {gap}\n"))
                .collect();
            let gaps = gaps.concat();
            if front.compared == 0 && gaps.is_empty() {
                return format!(
                    "{title}\nno drive satisfies the rules: there is nothing to compare\n"
                );
            }
            format!(
                "{title}\n{table}\n{} of {} drives: no other suitable drive is as good in all of these and better in one\n{}{gaps}",
                front.points.len(),
                front.compared,
                legend.concat()
            )
        }
        Format::Csv => {
            let mut text = csv_line(names.into_iter().chain(columns).map(Cell::Text));
            for point in &front.points {
                let values = point.values.iter().map(|x| Cell::Number(*x));
                let figures = figures(point).into_iter().map(Cell::from);
                let row = row(point).into_iter().map(Cell::Text).chain(figures);
                text += &csv_line(row.chain(values));
            }
            text
        }
        Format::Json => {
            let points = front.points.iter().map(|point| {
                let [motor, gearbox, amplifier] = row(point);
                let named = |key: String| (!key.is_empty()).then_some(key);
                json!({
                    "motor": motor, "gearbox": named(gearbox), "amplifier": named(amplifier),
                    "ratio": point.candidate.drive.ratio(), "mass [kg]": point.mass, "price": point.price, "values": point.values
                })
            });
            let names: Vec<String> = columns.collect();
            let value = json!({
                "schema": "jred-pareto/1",
                "title": title,
                "columns": names,
                "compared": front.compared,
                "unknown": front.unknown,
                "front": points.collect::<Vec<Value>>(),
            });
            format!("{value:#}\n")
        }
    }
}
