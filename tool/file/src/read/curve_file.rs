//! Curves over the drive link's position, from the columns of a CSV file.

use std::f64::consts::TAU;

use jred::Domain;

use super::drive_link::DriveLink;
use crate::number::rounding::figure;
use crate::number::spline::{FitMethod, MIN_POINTS, Spline};
use crate::text::columns::Columns;
use crate::text::problem::{Problem, Result};

/// Rows closer than this share of the range are refused.
const CLOSEST: f64 = 1e-6;

/// Largest difference between the first and the last row of a turn, as a share of the column's largest magnitude.
const CLOSURE_TOLERANCE: f64 = 1e-6;

/// Without a closing last row, a turn may be open by this many of its largest steps.
const OPEN: f64 = 2.0;

/// Share of a range by which its rows may miss its ends: rounding.
const ROUNDING: f64 = 1e-9;

/// The variable of a file's rows.
pub(super) struct RowVariable {
    /// The range of the positions.
    pub(super) domain: Domain,
    /// Name of the moving part.
    pub(super) of: String,
    /// Whether they may cover only a part of it.
    pub(super) partly: bool,
    /// Number of turns after which they repeat, if they are over a turn.
    pub(super) turns: u32,
}

impl RowVariable {
    /// The whole range of the drive link.
    pub(super) fn of(drive: DriveLink) -> Self {
        Self {
            domain: drive.domain,
            of: "the drive link".to_owned(),
            partly: false,
            turns: 1,
        }
    }

    /// Number of turns after which they repeat; 0: never.
    pub(super) fn repeats(&self) -> u32 {
        match self.domain {
            Domain::Turn => self.turns,
            Domain::Stroke { .. } => 0,
        }
    }

    /// The angle after which they repeat (rad).
    fn period(&self) -> f64 {
        f64::from(self.turns) * TAU
    }

    /// The same as text.
    fn whole(&self) -> String {
        if self.turns == 1 {
            "turn".to_owned()
        } else {
            format!("{} turns", self.turns)
        }
    }
}

/// The positions of the rows, checked against the range.
pub(super) struct Positions<'c> {
    columns: &'c Columns,
    /// Positions of the rows that are used (rad or m).
    x: &'c [f64],
    /// Whether the range is one or several turns.
    turn: bool,
    /// The angle after which they then repeat (rad).
    period: f64,
    /// Whether the last row equals the first, a turn later.
    closing: bool,
}

impl<'c> Positions<'c> {
    /// The rising rows of column 0, over a turn or at least the stroke of their variable.
    pub(super) fn of(columns: &'c Columns, rows: &RowVariable) -> Result<Self> {
        columns.check_rising(
            0,
            "position",
            "give one row for each position, in increasing order, and each position once",
        )?;
        let x = columns.get(0).unwrap_or_default();
        let (Some(&first), Some(&last)) = (x.first(), x.last()) else {
            return Err(Problem::new("the file has no rows"));
        };
        let span = rows.domain.span();
        let near = |pair: &[f64]| pair[1] - pair[0] < CLOSEST * span;
        if let Some(row) = x.windows(2).position(near) {
            return Err(columns
                .problem(0, row + 1, "is too close to the row before")
                .help(format!(
                    "rows closer than a millionth of the range, {}, turn rounding errors into slopes: remove one",
                    columns.shown(0, CLOSEST * span)
                )));
        }
        let shown = |position: f64| columns.shown(0, position);
        if rows.partly {
            return Self::part(columns, rows);
        }
        let turn = rows.domain == Domain::Turn;
        if let Domain::Stroke { from, to } = rows.domain {
            let slack = ROUNDING * span;
            if first > from + slack || last < to - slack {
                return Err(Problem::new(format!(
                    "the rows run from {} to {}, but {} moves from {} to {}",
                    shown(first),
                    shown(last),
                    rows.of,
                    shown(from),
                    shown(to)
                ))
                .at(columns.place(0), "first row")
                .at(columns.place(columns.rows() - 1), "last row")
                .help(format!(
                    "give rows over the whole stroke of {}; rows beyond it are allowed",
                    rows.of
                )));
            }
            return Ok(Self {
                columns,
                x,
                turn,
                period: 0.0,
                closing: false,
            });
        }
        let (period, whole) = (rows.period(), rows.whole());
        let open = first + period - last;
        let closing = open.abs() <= ROUNDING * period;
        let widest = x
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .fold(0.0, f64::max);
        if !closing && (open < 0.0 || open > OPEN * widest) {
            return Err(Problem::new(format!(
                "the rows cover {} of {}, from {} to {}",
                shown(last - first),
                if rows.turns == 1 { "a turn" } else { &whole },
                shown(first),
                shown(last)
            ))
            .at(columns.place(0), "first row")
            .at(columns.place(columns.rows() - 1), "last row")
            .help(if rows.turns == 1 {
                "for a drive link that turns fully, give rows over exactly one turn: up to the first position plus one \
                 turn, or one step before it; for a part of a turn write range = \"stroke\""
                    .to_owned()
            } else {
                format!(
                    "give rows over exactly {whole}: up to the first position plus {whole}, or one step before it"
                )
            }));
        }
        let count = x.len() - usize::from(closing);
        if count < MIN_POINTS {
            return Err(Problem::new(format!(
                "{count} different rows in a turn are too few: at least {MIN_POINTS} are required"
            ))
            .at(columns.place(0), "first row")
            .help("give a row every few degrees"));
        }
        Ok(Self {
            columns,
            x: &x[..count],
            turn,
            period,
            closing,
        })
    }

    /// Rows over a part of the range; outside it the curve is zero.
    fn part(columns: &'c Columns, rows: &RowVariable) -> Result<Self> {
        let x = columns.get(0).unwrap_or_default();
        let (Some(&first), Some(&last)) = (x.first(), x.last()) else {
            return Err(Problem::new("the file has no rows"));
        };
        let fault = |message: String| {
            Problem::new(message)
                .at(columns.place(0), "first row")
                .at(columns.place(columns.rows() - 1), "last row")
        };
        let shown = |position: f64| columns.shown(0, position);
        match rows.domain {
            Domain::Turn if last - first > rows.period() * (1.0 + ROUNDING) => Err(fault(format!(
                "the rows cover more than {}, from {} to {}",
                if rows.turns == 1 {
                    "a turn".to_owned()
                } else {
                    rows.whole()
                },
                shown(first),
                shown(last)
            ))
            .help("give each position of the turn once")),
            Domain::Stroke { from, to } if last <= from || first >= to => Err(fault(format!(
                "the rows run from {} to {}, but {} moves from {} to {}: it never meets them",
                shown(first),
                shown(last),
                rows.of,
                shown(from),
                shown(to)
            ))
            .help("give positions that are reached")),
            _ => Ok(Self {
                columns,
                x,
                turn: false,
                period: 0.0,
                closing: false,
            }),
        }
    }

    /// Positions of the rows that are used.
    pub(super) const fn x(&self) -> &[f64] {
        self.x
    }

    /// The column's values at these positions; on a turn its last row must equal its first.
    pub(super) fn values(&self, index: usize) -> Result<Option<Vec<f64>>> {
        let Some(values) = self.columns.get(index) else {
            return Ok(None);
        };
        if let (true, [first, .., last]) = (self.closing, values) {
            let most = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
            if (last - first).abs() > CLOSURE_TOLERANCE * most {
                return Err(self
                    .columns
                    .problem(
                        index,
                        values.len() - 1,
                        &format!(
                            "one turn after row 1, which has {}",
                            self.columns.shown(index, *first)
                        ),
                    )
                    .help(format!(
                        "after a turn the machine is back where it was: make the two rows equal to within {} of the \
                         largest value, or remove the last row",
                        figure(CLOSURE_TOLERANCE)
                    )));
            }
        }
        Ok(Some(values[..self.x.len()].to_vec()))
    }

    /// The values of the column, which must not be negative (nor zero, unless `zero`).
    pub(super) fn magnitudes(
        &self,
        index: usize,
        zero: bool,
        why: &str,
    ) -> Result<Option<Vec<f64>>> {
        let values = self.values(index)?;
        let bad = |value: &f64| *value < 0.0 || (!zero && *value == 0.0);
        if let Some(row) = values.as_deref().and_then(|v| v.iter().position(bad)) {
            let what = if zero {
                "must not be negative"
            } else {
                "must be greater than zero"
            };
            return Err(self.columns.problem(index, row, what).help(why));
        }
        Ok(values)
    }

    /// A curve through values at these positions.
    pub(super) fn curve(&self, values: &[f64], way: FitMethod) -> Result<Spline> {
        let spline = if self.turn {
            Spline::periodic(self.x, values, self.period, way)
        } else {
            Spline::bounded(self.x, values, way)
        };
        spline.map_err(|fault| {
            Problem::new(format!("no curve fits these rows: {fault}"))
                .at(self.columns.place(0), "first row")
        })
    }

    /// Error of a curve through every second row at the rows between, as a share of the largest magnitude: through all rows it is about a sixteenth
    /// of that.
    pub(super) fn resolution(&self, values: &[f64]) -> Option<f64> {
        let every_second = |v: &[f64]| -> Vec<f64> { v.iter().copied().step_by(2).collect() };
        let (x, y) = (every_second(self.x), every_second(values));
        let coarse = if self.turn {
            Spline::periodic(&x, &y, self.period, FitMethod::Interpolating)
        } else {
            Spline::bounded(&x, &y, FitMethod::Interpolating)
        }
        .ok()?;
        let [from, to] = coarse.range();
        let rows = self
            .x
            .iter()
            .zip(values)
            .filter(|(x, _)| (from..=to).contains(*x));
        let missed = rows.map(|(x, y)| (coarse.at(*x)[0] - y).abs());
        let most = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
        Some(missed.fold(0.0, f64::max) / most)
    }
}
