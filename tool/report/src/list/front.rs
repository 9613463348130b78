//! The Pareto front.

use schemars::JsonSchema;
use serde::Serialize;

use super::marks;
use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::Reading;
use jred_file::number::rounding::rounded;
use jred_sizing::catalogue::Drive;
use jred_sizing::cell::Cell;
use jred_sizing::select::pareto::{Front, ParetoPoint};
use jred_sizing::select::rank::Objective;

/// The JSON of `jred size --pareto`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct FrontData<'a> {
    /// Names of the objectives, with units.
    columns: Vec<String>,
    /// Number of suitable drives that were compared.
    compared: usize,
    /// Number of suitable drives without data for each objective.
    unknown: &'a [usize],
    /// Drives to which no other is as good in all objectives and better in one.
    front: Vec<PointData<'a>>,
}

impl Data for FrontData<'_> {
    const FORM: &'static str = "jred-pareto/1";
}

#[derive(Serialize, JsonSchema)]
struct PointData<'a> {
    /// Key of the motor.
    motor: &'a str,
    /// Key of the gearbox; none: directly coupled.
    gearbox: Option<&'a str>,
    /// Key of the amplifier.
    amplifier: Option<&'a str>,
    /// Gear ratio.
    ratio: f64,
    /// Mass; none: no data.
    #[serde(rename = "mass [kg]")]
    mass: Option<f64>,
    /// Price; none: no data.
    price: Option<f64>,
    /// Values of the objectives.
    values: &'a [f64],
}

/// The front: each drive with its values.
pub fn answer(front: &Front, title: &str) -> Answer<'static> {
    let columns: Vec<String> = (front.objectives.iter())
        .map(|o| o.column().to_owned())
        .collect();
    let mut answer = Answer::new(title, &data(front, columns.clone()));
    // Each objective has a column of its own.
    let own = |objective: Objective| !front.objectives.contains(&objective);
    let figures = |point: &ParetoPoint| -> Vec<Option<f64>> {
        let ratio = std::iter::once(Some(point.candidate.drive.ratio()));
        let mass = own(Objective::Mass).then_some(point.mass);
        let price = own(Objective::Price).then_some(point.price);
        ratio.chain(mass).chain(price).collect()
    };
    let more = std::iter::once("ratio")
        .chain(own(Objective::Mass).then_some("mass [kg]"))
        .chain(own(Objective::Price).then_some("price"));
    let named = |names: &[&str]| -> Vec<String> {
        let names = names.iter().copied().chain(more.clone());
        names.map(str::to_owned).chain(columns.clone()).collect()
    };
    let keys = |point: &ParetoPoint| {
        let drive = &point.candidate.drive;
        let gearbox = drive.gearbox.map_or_else(String::new, |g| g.key.clone());
        let amplifier = drive.amplifier.map_or_else(String::new, |a| a.key.clone());
        [drive.motor.key.clone(), gearbox, amplifier]
    };
    let full = |point: &ParetoPoint| -> Vec<Cell> {
        let keys = keys(point).into_iter().map(Cell::Text);
        let figures = figures(point).into_iter().map(Cell::from);
        let values = point.values.iter().map(|x| Cell::Number(*x));
        keys.chain(figures).chain(values).collect()
    };
    let read = |point: &ParetoPoint| -> Vec<Cell> {
        let drive = &point.candidate.drive;
        let [motor, gearbox, amplifier] = marks::drive(drive, false);
        let row = [motor, marks::made_for(drive), gearbox, amplifier].into_iter();
        let known = |figure: Option<f64>| figure.map_or("–".to_owned(), rounded);
        let figures = figures(point).into_iter().map(known);
        let values = point.values.iter().map(|x| rounded(*x));
        row.chain(figures).chain(values).map(Cell::Text).collect()
    };
    let all = named(&["motor", "gearbox", "amplifier"]);
    let all = Reading::new(all, front.points.iter().map(full), 1);
    answer.csv(all.csv());
    let gaps = front.gaps();
    if front.compared == 0 && gaps.is_empty() {
        answer.sentence("no drive satisfies the rules: there is nothing to compare");
        return answer;
    }
    let columns = named(&["motor", "made for", "gearbox", "amplifier"]);
    let whole = columns.len();
    answer.table(Reading::new(columns, front.points.iter().map(read), whole));
    answer.sentence(format!(
        "{} of {} drives: no other suitable drive is as good in all of these and better in one",
        front.points.len(),
        front.compared
    ));
    let drives: Vec<Drive> = front.points.iter().map(|p| p.candidate.drive).collect();
    for line in marks::legend(&drives) {
        answer.sentence(line);
    }
    for gap in gaps {
        answer.warning(gap);
    }
    answer
}

fn data<'a>(front: &'a Front, columns: Vec<String>) -> FrontData<'a> {
    let points = front.points.iter().map(|point| {
        let drive = &point.candidate.drive;
        PointData {
            motor: &drive.motor.key,
            gearbox: drive.gearbox.map(|g| g.key.as_str()),
            amplifier: drive.amplifier.map(|a| a.key.as_str()),
            ratio: drive.ratio(),
            mass: point.mass,
            price: point.price,
            values: &point.values,
        }
    });
    FrontData {
        columns,
        compared: front.compared,
        unknown: &front.unknown,
        front: points.collect(),
    }
}
