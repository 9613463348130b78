//! Why there is no table, and the cure.

use std::fmt::Write as _;

use jred::slider_crank::SliderCrankError;
use jred::table::MAX_CELLS;

use super::effort_name;
use jred_export::{
    AccuracyLimit, Alternative, CellsNeeded, CurveName, Feature, Impossible, Inaccuracy,
    NoClosedForm, NotReached, Task, WindowEdge,
};
use jred_file::model::by_motion::ByMotion;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{rounded, short};
use jred_file::problem;
use jred_file::text::problem::Problem;

/// The request, and the machine's coordinate.
struct Request<'t> {
    task: &'t Task,
    coordinate: Coordinate,
}

/// Why no table meets the torque error, and the cure.
pub fn not_reached(why: &NotReached, task: &Task, coordinate: Coordinate) -> String {
    let request = Request { task, coordinate };
    match why {
        NotReached::Refused(error) => format!("{error}; {}", error.cure()),
        NotReached::TooCoarse {
            layouts,
            alternatives,
        } => {
            let mut text = format!(
                "no {} table of up to {} cells is usable: that is too coarse\n",
                task.number.name(),
                task.max_cells
            );
            for coarse in layouts {
                let _ = writeln!(
                    text,
                    "  {}: {}, in the table, not in the machine; {} cells are enough",
                    coarse.layout.name(),
                    coarse.error,
                    coarse.cells
                );
            }
            let enough = layouts.iter().map(|coarse| coarse.cells).min();
            let _ = write!(
                text,
                "use --max-cells {} or more",
                enough.unwrap_or_default()
            );
            text + &request.cures(alternatives)
        }
        NotReached::Inaccurate(found) => request.inaccurate(found),
    }
}

/// Why the request is impossible.
pub fn impossible(why: &Impossible, file: &MachineFile, task: &Task) -> Problem {
    let coordinate = file.machine.mechanism().coordinate();
    let request = Request { task, coordinate };
    match why {
        Impossible::ByMotion(ByMotion { what, cure }) => problem!(
            help = format!(
                "{cure}, for this command, and give the firmware what acts in one part of the motion as a torque of its own; a payload that \
                 comes and goes is a table each"
            ),
            "{what}: that goes by [motion], and a table is over the position of the drive link alone"
        ),
        Impossible::ViscousByDirection { at } => problem!(
            help = "remove the direction of the viscous load, or give it to the firmware as a torque of its own",
            "the viscous friction goes by the direction: at {} it is another one forwards than backwards, and a table has one b",
            coordinate.place(*at)
        ),
        Impossible::DrivingLoads { at, excess } => problem!(
            help = "remove their direction, or give the firmware what helps the motion as a torque of its own",
            "the loads by direction drive the motion: at {} they take {} {} less forwards than backwards, and friction takes more",
            coordinate.place(*at),
            short(*excess),
            coordinate.effort_unit()
        ),
        Impossible::NoClosedForm(why) => no_closed_form(why, file),
        Impossible::ShortPiece { range, shortest } => problem!(
            help = "make the load's ramp longer, or name positions that are farther apart with --pieces",
            "the piece from {} to {} is shorter than {} {}, 1/65536 of the range",
            coordinate.place(range[0]),
            coordinate.place(range[1]),
            short(coordinate.shown(*shortest)),
            coordinate.unit()
        ),
        Impossible::TooManyCells { pieces, most } => problem!(
            help = format!("use --max-cells {} or fewer", most / pieces),
            "{pieces} pieces of up to {} cells are too many cells; at most {most}",
            task.max_cells
        ),
        Impossible::PieceUnits => problem!(
            help = "take --type f32 or --type i16, or edges at multiples of a simple part of the range, such as whole degrees",
            "the tables of pieces share their machine units, which for {} go with the width of a cell, and these edges \
             leave no common width with up to {} cells",
            task.number.name(),
            task.max_cells
        ),
        Impossible::DoesNotFit {
            best,
            smallest,
            alternatives,
        } => {
            let number = task.number.name();
            let most = task.max_bytes.unwrap_or_default();
            let message = match (best, task.torque_error, smallest) {
                (Some(best), Some(allowed), _) => format!(
                    "no {number} table of {most} bytes meets a {} error of {} {}: the smallest error found in that size is {}, with layout {} and {} cells",
                    effort_name(coordinate),
                    rounded(allowed),
                    coordinate.effort_unit(),
                    request.error(best.error),
                    best.layout.name(),
                    best.cells
                ),
                (_, _, Some(smallest)) => format!(
                    "no {number} table fits into {most} bytes: the smallest image takes {smallest} bytes"
                ),
                _ => format!("no {number} table of {most} bytes is usable: more cells are needed"),
            };
            let larger = match task.torque_error {
                Some(_) => ", or a larger error",
                None => "",
            };
            let cures = request.cures(alternatives);
            problem!(
                help = format!("allow more bytes{larger}{cures}"),
                "{message}"
            )
        }
    }
}

fn no_closed_form(why: &NoClosedForm, file: &MachineFile) -> Problem {
    let table = "remove --layout: a table holds any load";
    let load = |k: &usize| {
        let name = file.loads.get(*k).map(|load| load.name.as_str());
        format!("load {:?}", name.unwrap_or_default())
    };
    let (what, help) = match why {
        NoClosedForm::Mechanism(kind) => (
            format!("the mechanism is of type {kind:?}"),
            "remove --layout: a table holds any mechanism; --layout harmonic a smooth one that turns",
        ),
        NoClosedForm::Stroke => (
            "the crank has a stroke, and the closed form is of the whole turn".to_owned(),
            table,
        ),
        NoClosedForm::ByDirection => ("loads go by the direction of travel".to_owned(), table),
        NoClosedForm::Curve(name) => (format!("{name:?} is a curve over the position"), table),
        NoClosedForm::Part(SliderCrankError::Window(k)) => (
            format!("{} acts in a part of the turn", load(k)),
            "remove --layout: a table holds any load; --pieces auto makes one for each piece between its edges",
        ),
        NoClosedForm::Part(SliderCrankError::RubbingRod(k)) => (
            format!("{} rubs on the rod between its pins", load(k)),
            table,
        ),
        NoClosedForm::Part(SliderCrankError::Element(k)) => {
            let name = file.elements.get(*k).map(|element| element.name.as_str());
            (
                format!("{:?} is a spring or a damper", name.unwrap_or_default()),
                "take --layout harmonic, or remove --layout",
            )
        }
        NoClosedForm::Part(error) => (error.to_string(), table),
    };
    problem!(
        help = help,
        "layout slider-crank holds a slider-crank with constant loads and friction only, but {what}"
    )
}

impl Request<'_> {
    fn error(&self, bound: f64) -> String {
        format!("{} {}", short(bound), self.coordinate.effort_unit())
    }

    fn inaccurate(&self, found: &Inaccuracy) -> String {
        let (task, coordinate) = (self.task, self.coordinate);
        let number = task.number.name();
        let mut text = format!(
            "no table meets a {} error of {} {}: type {number}, up to {} cells\n",
            effort_name(coordinate),
            rounded(task.torque_error.unwrap_or_default()),
            coordinate.effort_unit(),
            task.max_cells
        );
        for least in &found.layouts {
            let counted = least.layout.counted();
            let piece = if found.in_pieces {
                let [from, to] = least.range.map(|end| coordinate.place(end));
                format!(" in the piece from {from} to {to}")
            } else {
                String::new()
            };
            let limit = match least.limit {
                AccuracyLimit::Rounding => {
                    format!(
                        "this is the rounding floor of {number}: more {counted} do not lower it"
                    )
                }
                AccuracyLimit::Cells => format!("more {counted} hardly lower it"),
                AccuracyLimit::Order(order, needed) => format!(
                    "the error falls with the number of cells to the power of {order:.1}{}",
                    match needed {
                        CellsNeeded::Irregular =>
                            " so far, but does not reach the error asked for".to_owned(),
                        CellsNeeded::Enough(cells) =>
                            format!("; at this rate, --max-cells {cells} would be enough"),
                        CellsNeeded::TooMany =>
                            format!("; at this rate, even {MAX_CELLS} are too few"),
                    }
                ),
            };
            let _ = writeln!(
                text,
                "  {}: {} {counted} reach {}{piece}; {limit}",
                least.layout.name(),
                least.cells,
                self.error(least.error),
            );
        }
        let _ = write!(
            text,
            "the largest error is at {}",
            coordinate.place(found.worst)
        );
        if let Some(feature) = &found.feature {
            text += if found.finer {
                "; with more cells, it is where "
            } else {
                ": "
            };
            text += &feature_words(feature, coordinate);
        }
        text += "\nincrease the allowed error";
        text += &self.cures(&found.alternatives);
        let cells = found.layouts.iter().filter_map(|least| match least.limit {
            AccuracyLimit::Order(_, CellsNeeded::Enough(cells)) => Some(cells),
            _ => None,
        });
        if let Some(cells) = cells.min() {
            let _ = write!(text, ", or --max-cells {cells}");
        }
        // For pieces, the cure is a cut there.
        if let (Some(Feature::Window { load, .. }), false) = (&found.feature, found.in_pieces) {
            let _ = write!(
                text,
                ", or a longer ramp of the load {load:?} in the machine file, or --pieces auto, a table for each piece between edges"
            );
        }
        let best = found.layouts.first().map(|least| least.limit);
        if best == Some(AccuracyLimit::Rounding) {
            text += ", or give a smaller range with --omega and --alpha";
        }
        text
    }

    /// Options that give these tables.
    fn cures(&self, alternatives: &[Alternative]) -> String {
        let cures = alternatives.iter().map(|found| {
            let (number, layout) = (found.number.name(), found.layout.name());
            let option = if found.number == self.task.number {
                format!("--layout {layout}")
            } else if self.task.layout.allows(found.layout) {
                format!("--type {number}")
            } else {
                format!("--type {number} --layout {layout}")
            };
            let (cells, bytes) = (found.cells, found.bytes);
            format!(", or take {option} ({cells} cells, {bytes} bytes)")
        });
        cures.collect()
    }
}

fn feature_words(feature: &Feature, coordinate: Coordinate) -> String {
    let segment = |end: &f64| {
        let place = coordinate.place(*end);
        format!("a segment of the cam's program ends at {place}")
    };
    match feature {
        Feature::Window {
            load,
            edge,
            at,
            ramp,
        } => {
            let edge = match edge {
                WindowEdge::Begins => "begins",
                WindowEdge::Full => "reaches its full value",
                WindowEdge::Falls => "begins to fall",
                WindowEdge::Ends => "ends",
            };
            format!(
                "the load {load:?} {edge} at {}, over a ramp of {} {}",
                coordinate.place(*at),
                rounded(coordinate.shown(*ramp)),
                coordinate.unit()
            )
        }
        Feature::SegmentEnd(end) => segment(end),
        Feature::Break {
            curve,
            jumps,
            at,
            segment_end,
        } => {
            let before = segment_end.as_ref().map(|end| segment(end) + ", and ");
            let inertia = coordinate.inertia();
            let curve = match curve {
                CurveName::Inertia => inertia.to_owned(),
                CurveName::Slope => format!("{inertia}'"),
                CurveName::Load => "the curve of load".to_owned(),
                CurveName::Viscous => "the curve of viscous".to_owned(),
                CurveName::Coulomb => "the curve of coulomb".to_owned(),
            };
            let verb = if *jumps { "jumps" } else { "has a kink" };
            let place = coordinate.place(*at);
            format!("{}{curve} {verb} at {place}", before.unwrap_or_default())
        }
    }
}
