//! `lift = "lift.csv"`: a cam program from the lift over the cam angle, optionally with its two derivatives.
//!
//! Rows without both derivatives are interpolated by a periodic cubic spline (twice continuously differentiable). The program consists of polynomials of
//! fifth degree between rows, with the lift and both derivatives at their ends. Of all programs with at most `MAX_SEGMENTS` segments, bisection of
//! the error finds the one that misses the rows, and the middles between them, least.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::motion::{End, Polynomial};
use jred::mechanism::cam::{MAX_SEGMENTS, Program, Segment};

use crate::number::rounding::short;
use crate::number::spline::{FitMethod, MIN_POINTS};
use crate::read::curve_file::{Positions, RowVariable};
use crate::read::mechanism::core;
use crate::text::columns::{self, ColumnSpec, Columns, CsvFault, CsvFile, Format, Layout, known};
use crate::text::file::Files;
use crate::text::item::Item;
use crate::text::problem::{self, Problem};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, CAM_ACCELERATION, CAM_TURNING, CAM_VELOCITY, LENGTH, SHARE};

const POSITION: usize = 0;
const LIFT: usize = 1;
const SLOPE: usize = 2;
const BEND: usize = 3;

/// The columns of a translating follower, and of an oscillating one.
const SLIDES: [ColumnSpec; 4] = [
    known(
        &["phi", "φ", "theta", "cam", "master", "dX", "angle"],
        &ANGLE,
    ),
    known(&["s", "rise", "dY", "lift"], &LENGTH),
    known(&["s'", "v", "velocity", "dV", "slope"], &CAM_VELOCITY),
    known(
        &["s''", "a", "acceleration", "dA", "bend"],
        &CAM_ACCELERATION,
    ),
];
const SWINGS: [ColumnSpec; 4] = [
    known(
        &["phi", "φ", "theta", "cam", "master", "dX", "angle"],
        &ANGLE,
    ),
    known(&["psi", "ψ", "rise", "dY", "lift"], &ANGLE),
    known(&["psi'", "omega", "velocity", "dV", "slope"], &SHARE),
    known(
        &["psi''", "alpha", "acceleration", "dA", "bend"],
        &CAM_TURNING,
    ),
];

/// Share of the stroke by which the program may miss the rows, unless the file gives the tolerance.
const MISSES: f64 = 1e-3;

/// Share of the stroke, or angle (rad), that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// Bisections of the program's error.
const HALVINGS: u32 = 48;

/// Cam angle and lift with both derivatives.
type LiftPoint = (f64, [f64; 3]);

/// The program of the file that `item` names, and a line about it for the report.
pub(super) fn read(
    section: &Section,
    item: &Item,
    oscillating: bool,
    files: &dyn Files,
) -> problem::Result<(Program, String)> {
    let within = section.maybe("lift_within")?;
    let layout = Layout::read(section)?.at_speed("lift_speed", section.maybe("lift_speed")?);
    let file = CsvFile::open(item, "lift.csv", files)?;
    let lift = Lift::of(&file.text, &layout, oscillating).map_err(|fault| file.shows(fault))?;
    let (knots, missed) = lift.fit();
    let shown = |x: f64| {
        if oscillating {
            format!("{} deg", short(x.to_degrees()))
        } else {
            format!("{} um", short(x * 1e6))
        }
    };
    let most = within.unwrap_or(MISSES * lift.stroke);
    if missed > most {
        let what = format!(
            "is a table that {MAX_SEGMENTS} polynomials miss by {}, more than {}",
            shown(missed),
            shown(most)
        );
        return Err(item.problem(&what, "this table").help(format!(
            "smooth its values, give it more digits or the columns of both derivatives, or write lift_within = \"{}\"",
            shown(1.05 * missed)
        )));
    }
    let program = Program::new(&lift.segments(&knots)).map_err(|error| core(section, error))?;
    let about = format!(
        "{} polynomials of fifth degree through {} rows, which miss the table by up to {}{}",
        knots.len() - 1,
        lift.rows.len() - 1,
        shown(missed),
        lift.derivatives_missed(&knots)
    );
    Ok((program, about))
}

/// The rows of a table from 0 to a full turn, both included, and the values between them.
struct Lift {
    rows: Vec<LiftPoint>,
    /// The lift midway between each row and the next, if a spline goes through the rows.
    middles: Option<Vec<f64>>,
    /// First and second derivatives that the table gives, for each row but the last.
    given: [Vec<f64>; 2],
    stroke: f64,
}

impl Lift {
    fn of(text: &str, layout: &Layout, oscillating: bool) -> Result<Self, CsvFault> {
        let (known, example) = if oscillating {
            (
                &SWINGS,
                "\"phi [deg],psi [deg]\", and psi' [1], psi'' [1/rad] if there are any",
            )
        } else {
            (
                &SLIDES,
                "\"phi [deg],s [mm]\", and s' [mm/rad], s'' [mm/rad^2] if there are any",
            )
        };
        let format = Format {
            known,
            ignored: |_| false,
            of_log: true,
            example,
            min_rows: MIN_POINTS,
        };
        let columns = columns::read(text, &format, layout)?;
        if columns.get(POSITION).is_none() || columns.get(LIFT).is_none() {
            let message = "the header must have the angle of the cam and the lift";
            return Err(columns.lacks(message, text, example).into());
        }
        let positions = Positions::of(
            &columns,
            &RowVariable {
                domain: Domain::Turn,
                of: "the cam".to_owned(),
                partly: false,
                turns: 1,
            },
        )?;
        let column = |index: usize| Ok::<_, Problem>(positions.values(index)?.unwrap_or_default());
        let [lift, slope, bend] = [column(LIFT)?, column(SLOPE)?, column(BEND)?];
        columns.check_slope(LIFT, SLOPE, columns.get(POSITION).unwrap_or_default())?;
        columns.check_slope(SLOPE, BEND, columns.get(POSITION).unwrap_or_default())?;
        let curve = (slope.is_empty() || bend.is_empty())
            .then(|| positions.curve(&lift, FitMethod::Interpolating))
            .transpose()?;
        let (slopes, bends) = (&slope, &bend);
        let point = |(k, (x, s)): (usize, (&f64, &f64))| {
            let derivatives = match &curve {
                Some(curve) => [curve.at(*x)[1], curve.at(*x)[2]],
                None => [slopes, bends]
                    .map(|values: &Vec<f64>| values.get(k).copied().unwrap_or_default()),
            };
            let turned = x.rem_euclid(TAU);
            // An angle just below a full turn is the start of the turn.
            let turned = if TAU - turned < ROUNDING { 0.0 } else { turned };
            (turned, [*s, derivatives[0], derivatives[1]])
        };
        let rows = positions.x().iter().zip(&lift).enumerate();
        let mut rows: Vec<(LiftPoint, usize)> = rows.map(|(k, row)| (point((k, row)), k)).collect();
        rows.sort_by(|(a, _), (b, _)| a.0.total_cmp(&b.0));
        let sorted = |values: &Vec<f64>| -> Vec<f64> {
            let order = rows.iter().map(|(_, k)| values.get(*k).copied());
            order.flatten().collect()
        };
        let given = [sorted(&slope), sorted(&bend)];
        let mut rows: Vec<LiftPoint> = rows.into_iter().map(|(row, _)| row).collect();
        let stroke = stroke(&lift);
        Self::check_start(&rows, stroke, &columns)?;
        if let Some((start, state)) = rows.first().copied() {
            rows.push((start + TAU, state));
        }
        let middles = curve.map(|curve| {
            let pairs = rows.windows(2);
            pairs
                .map(|pair| curve.at(pair[0].0.midpoint(pair[1].0))[0])
                .collect()
        });
        Ok(Self {
            rows,
            middles,
            given,
            stroke,
        })
    }

    /// Checks that the first row is at the start of the turn, on the base circle.
    fn check_start(rows: &[LiftPoint], stroke: f64, columns: &Columns) -> Result<(), CsvFault> {
        let Some((start, [lift, ..])) = rows.first() else {
            return Ok(());
        };
        if *start > ROUNDING {
            return Err(
                Problem::new("the table has no row at 0 deg, where the program begins")
                    .at(columns.place(0), "first row")
                    .help("add the row of 0 deg, or count the angle of the cam from a row")
                    .into(),
            );
        }
        if lift.abs() > ROUNDING * stroke {
            let shown = columns.shown(LIFT, *lift);
            return Err(Problem::new(format!("the lift at 0 deg is {shown}, but must be zero"))
                .at(columns.place(0), "first row")
                .help(format!(
                    "the lift is counted from the base circle, on which the follower is at 0 deg: take {shown} off every row, and add it to \
                     base_radius if the cam is to be the same"
                ))
                .into());
        }
        Ok(())
    }

    /// The polynomial from one row to another, over the angle from the first of them.
    fn polynomial(&self, [from, to]: [usize; 2]) -> Polynomial {
        let [(x, a), (end, b)] = [self.rows[from], self.rows[to]];
        Polynomial::between(
            b[0] - a[0],
            end - x,
            End::new(a[1], a[2]),
            End::new(b[1], b[2]),
        )
    }

    /// Largest deviation of a polynomial from the rows and middles between its ends; the search stops above `most`.
    fn missed(&self, ends: [usize; 2], most: f64) -> f64 {
        let (course, [from, to]) = (self.polynomial(ends), ends);
        let (start, [base, ..]) = self.rows[from];
        let at = |x: f64| base + course.at(x - start)[0];
        let mut missed = 0.0_f64;
        for k in from..to {
            let (x, [lift, ..]) = self.rows[k];
            missed = missed.max((at(x) - lift).abs());
            if let Some(middle) = self.middles.as_ref().and_then(|middles| middles.get(k)) {
                let x = x.midpoint(self.rows[k + 1].0);
                missed = missed.max((at(x) - middle).abs());
            }
            if missed > most {
                break;
            }
        }
        missed
    }

    /// The end rows of segments that deviate by at most `most`, each as long as possible; `None` if they are more than a program can have.
    fn within(&self, most: f64) -> Option<Vec<usize>> {
        let last = self.rows.len() - 1;
        let fits = |ends: [usize; 2]| self.missed(ends, most) <= most;
        let mut knots = vec![0];
        let mut from = 0;
        while from < last {
            if knots.len() > MAX_SEGMENTS {
                return None;
            }
            // The step doubles while it fits; bisection finds the end.
            let mut step = 1;
            while from + 2 * step <= last && fits([from, from + 2 * step]) {
                step *= 2;
            }
            let (mut good, mut bad) = (from + step, (from + 2 * step).min(last + 1));
            while bad - good > 1 {
                let middle = good.midpoint(bad);
                if fits([from, middle]) {
                    good = middle;
                } else {
                    bad = middle;
                }
            }
            from = good;
            knots.push(from);
        }
        Some(knots)
    }

    /// The end rows of the best program's segments, and its largest deviation.
    fn fit(&self) -> (Vec<usize>, f64) {
        let floor = ROUNDING * ROUNDING.sqrt() * self.stroke;
        let (mut low, mut high) = (floor, self.stroke.max(floor));
        let mut best = self.within(low);
        if best.is_none() {
            // Geometric bisection: the error is a small share of the stroke.
            for _ in 0..HALVINGS {
                let middle = (low * high).sqrt();
                match self.within(middle) {
                    Some(knots) => (best, high) = (Some(knots), middle),
                    None => low = middle,
                }
            }
        }
        let knots = best.unwrap_or_else(|| vec![0, self.rows.len() - 1]);
        let each = knots
            .windows(2)
            .map(|pair| self.missed([pair[0], pair[1]], f64::INFINITY));
        let missed = each.fold(0.0, f64::max);
        (knots, missed)
    }

    /// The largest deviations of the program from the derivatives in the table, as an addition to a line; empty if it has none.
    fn derivatives_missed(&self, knots: &[usize]) -> String {
        let names = ["velocities", "accelerations"];
        let missed = names.into_iter().zip(&self.given).enumerate();
        let missed = missed.filter_map(|(k, (name, given))| {
            let most = given.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let mut worst = 0.0_f64;
            for pair in knots.windows(2) {
                let (course, start) = (self.polynomial([pair[0], pair[1]]), self.rows[pair[0]].0);
                let rows = self.rows[pair[0]..=pair[1]]
                    .iter()
                    .zip(given.get(pair[0]..)?);
                for ((x, _), due) in rows {
                    worst = worst.max((course.at(x - start)[k + 1] - due).abs());
                }
            }
            (most > 0.0).then(|| {
                format!(
                    ", its {name} by up to {} % of the largest",
                    short(100.0 * worst / most)
                )
            })
        });
        missed.collect()
    }

    fn segments(&self, knots: &[usize]) -> Vec<Segment> {
        let segment = |pair: &[usize]| {
            let [(from, a), (to, b)] = [self.rows[pair[0]], self.rows[pair[1]]];
            let rest = [a[1], a[2], b[1], b[2], b[0] - a[0]];
            if rest.iter().all(|value| *value == 0.0) {
                return Segment::dwell(to - from);
            }
            Segment::polynomial(to - from, b[0] - a[0], [a[1], a[2]], [b[1], b[2]])
        };
        knots.windows(2).map(segment).collect()
    }
}

/// Largest less smallest lift.
fn stroke(lift: &[f64]) -> f64 {
    let most = lift.iter().fold(f64::NEG_INFINITY, |most, s| most.max(*s));
    let least = lift.iter().fold(f64::INFINITY, |least, s| least.min(*s));
    most - least
}
