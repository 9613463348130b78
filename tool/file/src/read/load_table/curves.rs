//! The rows of a load table, and the curves through them.

use jred::Domain;

use super::Target;
use crate::model::coordinate::Coordinate;
use crate::model::virtual_link::{Direction, LinkCurve, LoadTable, TableVariable, VirtualLink};
use crate::number::rounding::figure;
use crate::number::spline::{FitMethod, MIN_POINTS, Spline};
use crate::read::curve_file::Positions;
use crate::text::columns::{self, ColumnSpec, Columns, CsvFault, Format, known};
use crate::text::csv;
use crate::text::problem::Problem;
use crate::units::kind::{ANGLE, FORCE, INERTIA, LENGTH, MASS, TORQUE};

const POSITION: usize = 0;
const PAYLOAD: usize = 1;
const THRUST: usize = 2;
const TORQUE_COLUMN: usize = 3;
const FORCE_X: usize = 4;
const FORCE_Y: usize = 5;
const FORCE_COLUMN: usize = 6;
const MOMENT: usize = 7;

/// Factor to the usual step from which a step of the rows is a gap, if the force changes over it.
const GAP: f64 = 20.0;

/// Share of a column's largest value by which a smooth curve may exceed all its rows: through a step it exceeds them by 11 %.
const SWING: f64 = 0.1;

/// Share of its last step by which a table may miss the end of the stroke: people round it.
const REST: f64 = 0.1;

type Result<T> = std::result::Result<T, CsvFault>;

/// The columns of a table on the drive link itself.
fn on_drive(coordinate: Coordinate) -> (Vec<ColumnSpec>, &'static str) {
    match coordinate {
        Coordinate::Angle => (
            vec![
                known(&["Position", "phi", "φ", "position"], &ANGLE),
                known(&["Payload", "payload"], &INERTIA),
                known(&["Thrust", "thrust"], &TORQUE),
                known(&["Torque", "torque"], &TORQUE),
            ],
            "\"Position [deg],Payload [kg m^2],Thrust [N m],Torque [N m]\" (the position and at least one other)",
        ),
        Coordinate::Length => (
            vec![
                known(&["Position", "s", "position"], &LENGTH),
                known(&["Payload", "payload"], &MASS),
                known(&["Thrust", "thrust"], &FORCE),
                known(&["Torque", "Force", "force"], &FORCE),
            ],
            "\"Position [mm],Payload [kg],Thrust [N],Force [N]\" (the position and at least one other)",
        ),
    }
}

/// The columns of a table on a link; with `along`, the column Force acts on the link in this direction.
fn on_link(target: &Target) -> (Vec<ColumnSpec>, &'static str) {
    let (mut columns, _) = on_drive(target.drive.coordinate);
    columns[PAYLOAD].kind = &MASS;
    columns[THRUST].kind = &FORCE;
    let along = target.along.is_some() || target.over != TableVariable::Drive;
    if along {
        columns[TORQUE_COLUMN].names = &["Torque"];
    }
    if target.over != TableVariable::Drive {
        columns[POSITION] = known(&["Position", "s", "x", "y", "position"], &LENGTH);
    }
    columns.extend([
        known(&["Force x", "F_x", "force_x"], &FORCE),
        known(&["Force y", "F_y", "force_y"], &FORCE),
        known(&["Force", "F", "force"], &FORCE),
        known(&["Moment", "M", "moment"], &TORQUE),
    ]);
    let example = match target.coordinate() {
        Coordinate::Angle => {
            "\"Position [deg],Payload [kg],Thrust [N],Torque [N m]\", \"Position [deg],Force x [N],Force y [N],Moment [N m]\" (the position and at least one other)"
        }
        Coordinate::Length if target.over != TableVariable::Drive => {
            "\"Position [mm],Force x [N],Force y [N]\" or \"Position [mm],Force [N]\" with `angle` (the position and at least one other)"
        }
        Coordinate::Length => {
            "\"Position [mm],Payload [kg],Thrust [N],Force [N]\" (the position and at least one other)"
        }
    };
    (columns, example)
}

/// The curves of all columns.
pub(super) fn read(text: &str, target: &Target) -> Result<Vec<VirtualLink>> {
    let (known, example) = match target.on {
        Some(_) => on_link(target),
        None => on_drive(target.coordinate()),
    };
    let format = Format {
        known: &known,
        ignored: |_| false,
        of_log: false,
        example,
        min_rows: MIN_POINTS,
    };
    let columns = columns::read(text, &format, &target.layout)?;
    let header = |message: String| {
        Problem::new(message)
            .at(csv::header_place(text), "header")
            .help(format!(
                "the first line gives column names with units: {example}"
            ))
    };
    if columns.get(POSITION).is_none() {
        let message = "the column for the position is missing";
        return Err(columns.lacks(message, text, example).into());
    }
    let has = |column: usize| columns.get(column).is_some();
    for (column, name) in [(PAYLOAD, "Payload"), (TORQUE_COLUMN, "Torque")] {
        if has(column) && target.over != TableVariable::Drive {
            let message =
                format!("the column {name} is for rows over the position of the drive link");
            return Err(header(message).into());
        }
        if has(column) && target.rows.partly {
            return Err(Problem::new(format!(
                "the column {name} needs rows over the whole range of the drive link"
            ))
            .at(csv::header_place(text), "header")
            .help("remove outside = \"zero\", or write a table of its own for this column")
            .into());
        }
    }
    check_direction(target, has(FORCE_COLUMN), text)?;
    if let Some((item, _)) = target.way.as_ref().filter(|_| {
        ![FORCE_X, FORCE_Y, FORCE_COLUMN, MOMENT]
            .into_iter()
            .any(has)
    }) {
        return Err(CsvFault::InMachine(
            item.problem(
                "is for the columns Force x, Force y, Force and Moment",
                "not needed",
            )
            .help("the curves of payload, thrust and torque are monotone between rows"),
        ));
    }
    let rows = Sheet {
        positions: Positions::of(&columns, &target.rows)?,
        columns: &columns,
        target,
    };
    let stand_ins = rows.stand_ins()?;
    if stand_ins.is_empty() {
        let message = "there is no column other than the position";
        return Err(columns.lacks(message, text, example).into());
    }
    Ok(stand_ins)
}

/// Checks that a force has a direction, and a direction a force.
fn check_direction(target: &Target, has_force: bool, text: &str) -> Result<()> {
    match &target.along {
        None if has_force => Err(Problem::new("the column Force has no direction")
            .at(csv::header_place(text), "header")
            .help(
                "add angle = \"180 deg\", counter-clockwise from +x, or angle_on_link, to the [[load]]; or give the columns Force x and Force y",
            )
            .into()),
        Some((item, _)) if target.on.is_none() => Err(CsvFault::InMachine(
            item.problem("is given without `on`", "a force on which link?")
                .help("add on = \"slider\", the link on which the force acts"),
        )),
        Some((item, _)) if !has_force => Err(CsvFault::InMachine(
            item.problem("is given, but the table has no column Force", "not needed")
                .help("name the column of the force Force [N]"),
        )),
        _ => Ok(()),
    }
}

/// The rows of a table.
struct Sheet<'t> {
    columns: &'t Columns,
    positions: Positions<'t>,
    target: &'t Target<'t>,
}

impl Sheet<'_> {
    fn stand_ins(&self) -> Result<Vec<VirtualLink>> {
        let target = self.target;
        let place = target.on.as_ref().map(|(_, place)| *place);
        let mut stand_ins = Vec::new();
        let mut add = |what: &str, course: LinkCurve, edges: &[f64]| {
            let name = format!("{}: {what}", target.name);
            stand_ins.push(VirtualLink {
                name,
                window: target.window,
                edges: edges.to_vec(),
                course,
            });
        };
        if let Some(payload) = self.positions.magnitudes(
            PAYLOAD,
            true,
            "a payload is a mass or an inertia: write zero where there is none",
        )? {
            if target.window.is_some() {
                return Err(Problem::new("a payload cannot act in a part of the range only")
                    .at(self.columns.place(0), "first row")
                    .help("remove `between` and `ramp`: write zero rows where there is no payload")
                    .into());
            }
            let mass = self.positions.curve(&payload, FitMethod::Monotone)?;
            match place {
                None => add("payload", LinkCurve::Inertia(mass), &[]),
                Some(on) => {
                    for (axis, letter) in ["x", "y"].into_iter().enumerate() {
                        let mass = mass.clone();
                        add(
                            &format!("payload {letter}"),
                            LinkCurve::Payload { mass, on, axis },
                            &[],
                        );
                    }
                    if target.gravity.iter().any(|g| *g != 0.0) {
                        let gravity = target.gravity;
                        add("weight", LinkCurve::Weight { mass, on, gravity }, &[]);
                    }
                }
            }
        }
        if let Some(thrust) = self.positions.magnitudes(
            THRUST,
            true,
            "a thrust always opposes the motion: give its magnitude; a force with a sign belongs in the column Torque, Force or Force x",
        )? {
            self.check_ends(THRUST, &thrust)?;
            let curve = self.positions.curve(&thrust, FitMethod::Monotone)?;
            match place {
                Some(on) => {
                    let edges = self.edges()?;
                    let force = self.table(curve);
                    add("thrust", LinkCurve::Thrust { force, on }, &edges);
                }
                None => add("thrust", LinkCurve::Opposing(curve), &[]),
            }
        }
        if let Some(torque) = self.positions.values(TORQUE_COLUMN)? {
            let torque = self.positions.curve(&torque, FitMethod::Monotone)?;
            add("torque", LinkCurve::Torque(torque), &[]);
        }
        let along = target.along.as_ref().map(|(_, along)| *along);
        let forces = [
            (FORCE_X, "force x", Some(Direction::Fixed([1.0, 0.0]))),
            (FORCE_Y, "force y", Some(Direction::Fixed([0.0, 1.0]))),
            (FORCE_COLUMN, "force", along),
        ];
        for (column, name, along) in forces {
            let Some((force, along)) = self.positions.values(column)?.zip(along) else {
                continue;
            };
            let fixed = matches!(along, Direction::Fixed(_));
            let on = (target.check_effect(true, fixed)).map_err(CsvFault::InMachine)?;
            let force = self.table(self.smooth(column, &force)?);
            add(name, LinkCurve::Force { force, on, along }, &self.edges()?);
        }
        if let Some(moment) = self.positions.values(MOMENT)? {
            let on = (target.check_effect(false, false)).map_err(CsvFault::InMachine)?;
            let moment = self.table(self.smooth(MOMENT, &moment)?);
            let link = on.link;
            add("moment", LinkCurve::Moment { moment, link }, &self.edges()?);
        }
        Ok(stand_ins)
    }

    fn table(&self, curve: Spline) -> LoadTable {
        let (over, rows) = (self.target.over, &self.target.rows);
        if rows.partly {
            LoadTable::new(curve, over, rows.repeats())
        } else {
            LoadTable::whole(curve, over)
        }
    }

    /// The ends of the rows, as positions of the drive link.
    fn edges(&self) -> Result<Vec<f64>> {
        let x = self.positions.x();
        let (true, Some(first), Some(last)) = (self.target.rows.partly, x.first(), x.last()) else {
            return Ok(Vec::new());
        };
        let passes = self
            .target
            .over
            .passes(self.target.mechanism, &[*first, *last]);
        passes.map_err(|error| {
            let problem = Problem::new(format!("the rows cannot be placed: {error}"));
            CsvFault::InMachine(problem.help(error.cure().to_string()))
        })
    }

    /// Whether the first and the last row reach the end of the stroke or way, up to [`REST`], over which the row's value acts.
    fn reaches(&self) -> [bool; 2] {
        match (self.target.rows.domain, self.positions.x()) {
            (Domain::Stroke { from, to }, [first, second, .., before, last]) => {
                let rest = [first - from, to - last];
                let step = [second - first, last - before];
                [0, 1].map(|end| rest[end] <= REST * step[end])
            }
            _ => [false; 2],
        }
    }

    /// Checks that rows over a part of the range begin and end with zero, unless they reach the end of the stroke.
    fn check_ends(&self, column: usize, values: &[f64]) -> Result<()> {
        let last = values.len().saturating_sub(1);
        let ends = [(0, values.first()), (last, values.last())];
        for ((row, value), reaches) in ends.into_iter().zip(self.reaches()) {
            if self.target.rows.partly && !reaches && value.is_some_and(|value| *value != 0.0) {
                let to_end = match self.target.rows.domain {
                    Domain::Turn => String::new(),
                    Domain::Stroke { from, to } => {
                        let end = if row == 0 { from } else { to };
                        let end = self.columns.shown(POSITION, end);
                        format!(
                            "; or give rows up to the end of the way of {}, {end}, where a force need not be zero",
                            self.target.rows.of
                        )
                    }
                };
                return Err(self
                    .columns
                    .problem(column, row, "is next to the end of the table, outside of which it is zero: a jump")
                    .help(format!(
                        "begin and end the rows with zero: add a row where it has fallen to nothing{to_end}"
                    ))
                    .into());
            }
        }
        Ok(())
    }

    /// The curve through the rows of a force: twice continuously differentiable, unless monotone is requested.
    fn smooth(&self, column: usize, values: &[f64]) -> Result<Spline> {
        self.check_ends(column, values)?;
        self.check_gaps(column, values)?;
        let rests = [values.first(), values.last()]
            .iter()
            .all(|end| *end == Some(&0.0));
        let way = match &self.target.way {
            Some((_, FitMethod::Monotone)) => {
                return Ok(self.positions.curve(values, FitMethod::Monotone)?);
            }
            _ if self.target.rows.partly && rests => FitMethod::Level,
            _ => FitMethod::Interpolating,
        };
        let curve = self.positions.curve(values, way)?;
        let most = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
        let turned: Vec<f64> = values.iter().map(|v| -v).collect();
        let (least, at_least) = curve.least();
        let (largest, at_largest) = self.positions.curve(&turned, way)?.least();
        let row_least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let row_most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        for (value, at, beyond) in [
            (least, at_least, row_least - least),
            (-largest, at_largest, -largest - row_most),
        ] {
            if beyond > SWING * most {
                let after = self.positions.x().partition_point(|x| *x <= at);
                let row = after.clamp(1, values.len()) - 1;
                return Err(self
                    .columns
                    .problem(
                        column,
                        row,
                        &format!(
                            "is where the smooth curve swings to {}, beyond all rows",
                            self.columns.shown(column, value)
                        ),
                    )
                    .help("add rows where the force bends, or write curve = \"monotone\", which never goes beyond two neighbouring rows")
                    .into());
            }
        }
        Ok(curve)
    }

    /// Checks that no step is so long that the force inside it would be a guess.
    fn check_gaps(&self, column: usize, values: &[f64]) -> Result<()> {
        let steps: Vec<f64> = (self.positions.x().windows(2))
            .map(|x| x[1] - x[0])
            .collect();
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let usual = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
        let changes = values
            .windows(2)
            .map(|pair| pair[0].to_bits() != pair[1].to_bits());
        let gap = steps
            .iter()
            .zip(changes)
            .position(|(step, changes)| changes && *step > GAP * usual);
        let Some(row) = gap else {
            return Ok(());
        };
        let shown = |step: f64| self.columns.shown(POSITION, step);
        Err(self
            .columns
            .problem(
                column,
                row + 1,
                &format!(
                    "is {} after the previous row; the usual step is {}",
                    shown(steps[row]),
                    shown(usual)
                ),
            )
            .help(format!(
                "a curve through a gap of more than {} steps would be guesswork: add the missing rows",
                figure(GAP)
            ))
            .into())
    }
}
