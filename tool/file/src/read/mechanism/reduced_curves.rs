//! `type = "reduced-curves"`: J(φ) and torques from a CSV file.

use jred::Domain;
use jred::machine::Link;

use super::core;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::model::virtual_link::{DriveLinkAlone, LinkCurve, VirtualLink};
use crate::number::rounding::figure;
use crate::number::spline::{FitMethod, MIN_POINTS, Spline};
use crate::read::curve_file::{Positions, RowVariable};
use crate::read::drive_link::DriveLink;
use crate::text::columns;
use crate::text::columns::{ColumnSpec, Columns, CsvFault, CsvFile, Format, Layout, known};
use crate::text::csv;
use crate::text::file::Files;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{
    ANGLE, FORCE, INERTIA, INERTIA_SLOPE, LENGTH, MASS, MASS_SLOPE, TORQUE, VISCOUS_FORCE,
    VISCOUS_MOMENT,
};

const POSITION: usize = 0;
const INERTIA_COLUMN: usize = 1;
const PROCESS: usize = 2;
const POTENTIAL: usize = 3;
const VISCOUS: usize = 4;
const COULOMB: usize = 5;
const SLOPE: usize = 6;

/// Tolerance of the work of a potential's torque over a turn, as a share of ∫|T|·dφ. The rest is subtracted as a constant torque.
const CONSERVED: f64 = 1e-3;

/// Smaller shares are rounding errors of the file and not reported.
const ROUNDING: f64 = 1e-6;

const ANGLES: [ColumnSpec; 7] = [
    known(&["phi", "φ", "angle", "position"], &ANGLE),
    known(&["J", "J_red", "inertia"], &INERTIA),
    known(&["T", "T_process", "torque"], &TORQUE),
    known(&["T_potential", "T_weight"], &TORQUE),
    known(&["b", "b_viscous"], &VISCOUS_MOMENT),
    known(&["c", "c_coulomb"], &TORQUE),
    known(&["J'", "J_red'"], &INERTIA_SLOPE),
];

const LENGTHS: [ColumnSpec; 7] = [
    known(&["s", "position"], &LENGTH),
    known(&["m", "m_red", "mass"], &MASS),
    known(&["F", "F_process", "force"], &FORCE),
    known(&["F_potential", "F_weight"], &FORCE),
    known(&["b", "b_viscous"], &VISCOUS_FORCE),
    known(&["c", "c_coulomb"], &FORCE),
    known(&["m'", "m_red'"], &MASS_SLOPE),
];

/// Other columns that `jred reduce` writes: derivatives or parts of the columns that are read, or results for a motion.
fn of_reduce(name: &str) -> bool {
    let prefixes = [
        "J_red ", "m_red ", "T_drive", "F_drive", "T_input", "F_input",
    ];
    [
        "J''", "J_red''", "m''", "m_red''", "U", "omega", "alpha", "v", "a",
    ]
    .contains(&name)
        || prefixes.iter().any(|prefix| name.starts_with(prefix))
}

pub(super) fn read(section: &Section, files: &dyn Files) -> Result<AnyMechanism> {
    let item = section.need("file")?;
    let turn = section.word("range")? == 0;
    let file = CsvFile::open(&item, "curves.csv", files)?;
    let layout = Layout::read(section)?;
    let curves =
        CurveFileContents::read(&file.text, turn, &layout).map_err(|fault| file.shows(fault))?;
    let slides = curves.drive.slides();
    let alone = DriveLinkAlone::new(curves.drive.domain, slides, Link::MASSLESS);
    let joint = if slides {
        "drive guide"
    } else {
        "drive bearing"
    };
    let mut mechanism = AnyMechanism::new(section.chosen(), alone, ["drive link"], [joint])
        .with_stand_ins(&curves.stand_ins)
        .map_err(|error| core(section, error))?;
    for (label, text) in curves.facts {
        mechanism = mechanism.with_fact(label, text);
    }
    Ok(mechanism)
}

/// The contents of a file.
struct CurveFileContents {
    drive: DriveLink,
    stand_ins: Vec<VirtualLink>,
    facts: Vec<(&'static str, String)>,
}

impl CurveFileContents {
    fn read(text: &str, turn: bool, layout: &Layout) -> std::result::Result<Self, CsvFault> {
        let (columns, coordinate) = read_columns(text, turn, layout)?;
        let x = columns.get(POSITION).unwrap_or_default();
        let domain = match (turn, x) {
            (false, [first, .., last]) if last > first => Domain::Stroke {
                from: *first,
                to: *last,
            },
            (false, _) => Domain::Stroke { from: 0.0, to: 1.0 },
            (true, _) => Domain::Turn,
        };
        let drive = DriveLink { coordinate, domain };
        let positions = Positions::of(&columns, &RowVariable::of(drive))?;
        let mut facts = vec![(
            "rows of the file",
            format!(
                "{} from {} to {}",
                columns.rows(),
                columns.shown(0, x[0]),
                columns.shown(0, x[x.len() - 1])
            ),
        )];
        let mut stand_ins = Vec::new();
        let mut add = |name: &str, course: LinkCurve| {
            let name = name.to_owned();
            stand_ins.push(VirtualLink::new(name, course));
        };

        let inertia = positions
            .magnitudes(
                INERTIA_COLUMN,
                false,
                "the reduced inertia of a machine that moves is positive everywhere; add the inertia of the drive link itself",
            )?
            .unwrap_or_default();
        let curve = positions.curve(&inertia, FitMethod::Interpolating)?;
        let (least, at) = curve.least();
        if least <= 0.0 {
            let row = x.partition_point(|x| *x <= at).saturating_sub(1);
            return Err(Problem::new(format!(
                "the curve through the rows falls to {} at {}, between rows",
                columns.shown(INERTIA_COLUMN, least),
                columns.shown(POSITION, at)
            ))
            .at(columns.place(row), "after this row")
            .help("the curve must stay positive: add rows where it is steep")
            .into());
        }
        facts.extend(agreement(&positions, &columns, &curve, &inertia));
        add("inertia", LinkCurve::Inertia(curve));

        if let Some(torque) = positions.values(PROCESS)? {
            add(
                "process",
                LinkCurve::Torque(positions.curve(&torque, FitMethod::Interpolating)?),
            );
        }
        if let Some(torque) = positions.values(POTENTIAL)? {
            let (torque, fact) = conserved(&positions, &columns, torque, turn)?;
            facts.extend(fact);
            add("weight", LinkCurve::potential(torque));
        }
        let why =
            "friction dissipates power in both directions of motion: its value is never negative";
        if let Some(viscous) = positions.magnitudes(VISCOUS, true, why)? {
            add(
                "viscous",
                LinkCurve::Viscous(positions.curve(&viscous, FitMethod::Monotone)?),
            );
        }
        if let Some(coulomb) = positions.magnitudes(COULOMB, true, why)? {
            add(
                "coulomb",
                LinkCurve::Opposing(positions.curve(&coulomb, FitMethod::Monotone)?),
            );
        }
        facts.push((
            "weight",
            "from the column T_potential or F_potential; `gravity` in the file has no effect here"
                .to_owned(),
        ));
        Ok(Self {
            drive,
            stand_ins,
            facts,
        })
    }
}

/// The columns; the position column decides whether the drive link turns or slides.
fn read_columns(
    text: &str,
    turn: bool,
    layout: &Layout,
) -> std::result::Result<(Columns, Coordinate), CsvFault> {
    let format = |known: &'static [ColumnSpec], example: &'static str| Format {
        known,
        ignored: of_reduce,
        of_log: false,
        example,
        min_rows: MIN_POINTS,
    };
    let angles = format(
        &ANGLES,
        "\"phi [deg],J [kg m^2]\", and T, T_potential [N m], b [N m s/rad], c [N m] if there are any",
    );
    let lengths = format(
        &LENGTHS,
        "\"s [mm],m [kg]\", and F, F_potential [N], b [N s/m], c [N] if there are any",
    );
    // By its name, or by its unit if the name is also that of an angle.
    let slides = columns::has(
        text,
        layout,
        &lengths.known[POSITION],
        &angles.known[POSITION],
    )?;
    let (format, coordinate) = if slides {
        (lengths, Coordinate::Length)
    } else {
        (angles, Coordinate::Angle)
    };
    let columns = columns::read(text, &format, layout)?;
    for (index, what) in [(POSITION, "position"), (INERTIA_COLUMN, "reduced inertia")] {
        if columns.get(index).is_none() {
            let message = format!("the column for the {what} is missing");
            return Err(columns.lacks(&message, text, format.example).into());
        }
    }
    if slides && turn {
        return Err(
            Problem::new("the drive link slides, so its range is not a turn")
                .at(csv::header_place(text), "s is a displacement")
                .help("write range = \"stroke\" in [mechanism]")
                .into(),
        );
    }
    Ok((columns, coordinate))
}

/// How well the rows resolve the curve, and how well its slope agrees with the slope in the file.
fn agreement(
    positions: &Positions,
    columns: &Columns,
    curve: &Spline,
    inertia: &[f64],
) -> Vec<(&'static str, String)> {
    let mut facts = Vec::new();
    if let Some(missed) = positions.resolution(inertia) {
        facts.push((
            "curve through the rows",
            format!(
                "a curve through every second row misses the rows between by {} % of the largest inertia; the curve \
                 through all rows by about a sixteenth of that, where they are smooth",
                figure(missed * 100.0)
            ),
        ));
    }
    if let Some(slopes) = columns.get(SLOPE) {
        let rows = positions.x().iter().zip(slopes);
        let off = rows
            .map(|(x, slope)| (curve.at(*x)[1] - slope).abs())
            .fold(0.0, f64::max);
        let most = slopes.iter().fold(0.0f64, |most, s| most.max(s.abs()));
        if most > 0.0 {
            facts.push((
                "slope of the curve",
                format!(
                    "within {} % of the largest slope in the file",
                    figure(off / most * 100.0)
                ),
            ));
        }
    }
    facts
}

/// The torque of a potential, which does no work over a turn.
fn conserved(
    positions: &Positions,
    columns: &Columns,
    mut torque: Vec<f64>,
    turn: bool,
) -> Result<(Spline, Option<(&'static str, String)>)> {
    let curve = positions.curve(&torque, FitMethod::Interpolating)?;
    if !turn {
        return Ok((curve, None));
    }
    let [from, to] = curve.range();
    let work = curve.integral(to);
    let sizes: Vec<f64> = torque.iter().map(|t| t.abs()).collect();
    let size = positions.curve(&sizes, FitMethod::Monotone)?.integral(to);
    if work.abs() > CONSERVED * size {
        return Err(Problem::new(format!(
            "the torque of weight and springs does work over a turn: {} J of {} J",
            figure(work),
            figure(size)
        ))
        .at(columns.place(0), "first row")
        .help("a mass lifted in a turn must come down in the same turn; a torque whose work is not returned belongs in the column T"));
    }
    let mean = work / (to - from);
    for value in &mut torque {
        *value -= mean;
    }
    let fact = format!(
        "{} N m were subtracted from its torque so that its work over a turn is zero",
        figure(mean)
    );
    // The curve is linear in its values: without the mean, its integral is rounding error only.
    let curve = positions.curve(&torque, FitMethod::Interpolating)?;
    Ok((
        curve,
        (work.abs() > ROUNDING * size).then_some(("weight over a turn", fact)),
    ))
}
