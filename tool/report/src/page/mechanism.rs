//! The page about a mechanism: drawing, animation, check, curves, motions, forces.

use askama::Template;
use jred::error::Error;

use super::extract::{largest_forces, tables};
use super::figures;
use super::section::{Figure, Section};
use crate::answer::Block;
use crate::drawing;
use crate::list::inspection;
use crate::plot::Axis;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::{ColumnQuantity, Columns};
use jred_file::number::rounding::short;

/// Points of each curve.
pub(super) const POINTS: usize = 361;

#[derive(Template)]
#[template(path = "mechanism.html")]
struct Page<'a> {
    title: &'a str,
    version: &'static str,
    file: &'a str,
    kind: &'a str,
    drawing: String,
    track: String,
    last: usize,
    symbol: &'static str,
    unit: &'static str,
    blocks: Vec<Block>,
    sections: Vec<Section>,
}

/// The columns of motions and forces, over the time or the position.
pub(super) struct Source<'f> {
    pub(super) file: &'f MachineFile,
    coordinate: Coordinate,
    pub(super) over: Over,
    pub(super) state: Option<[f64; 2]>,
}

impl Source<'_> {
    pub(super) fn moves(&self) -> bool {
        self.over == Over::Time || self.state.is_some()
    }

    pub(super) fn columns(&self, sets: Sets, positions: usize) -> Result<Columns, Error> {
        let request = Request {
            over: self.over,
            positions,
            sets,
            state: self.state,
        };
        reduce(self.file, &request)
    }

    /// The abscissa and its axis.
    const fn axis(&self) -> (ColumnQuantity, Axis<'static>) {
        match self.over {
            Over::Time => (ColumnQuantity::Time, Axis::new("time [s]")),
            Over::Angle => (ColumnQuantity::Position, Axis::of(self.coordinate)),
        }
    }
}

/// The page about a machine's mechanism. Motions and forces are those of the file's motion over time, or at the speed and acceleration `state` over
/// the range.
///
/// # Errors
/// Those of the machine.
pub fn mechanism_page(
    name: &str,
    file: &MachineFile,
    state: Option<[f64; 2]>,
) -> Result<String, Error> {
    let mechanism = file.machine.mechanism();
    let over = if file.motion.is_some() && state.is_none() {
        Over::Time
    } else {
        Over::Angle
    };
    let source = Source {
        file,
        coordinate: mechanism.coordinate(),
        over,
        state,
    };
    let moving = drawing::moving(mechanism)?;
    let findings = Findings::of(file)?;
    let check = inspection::answer(&findings);
    let mut sections = sections(&source)?;
    sections.extend(largest_forces(&source)?);
    sections.extend(tables(&source)?);
    sections.push(Section::read("Notes", |answer| {
        for note in notes(&source) {
            answer.sentence(note);
        }
    }));
    let page = Page {
        title: &file.title,
        version: env!("CARGO_PKG_VERSION"),
        file: name,
        kind: mechanism.kind(),
        drawing: moving.svg,
        track: moving.track,
        last: drawing::PICTURES - 1,
        symbol: source.coordinate.symbol(),
        unit: source.coordinate.unit(),
        blocks: check.shown(),
        sections,
    };
    // Rendering into a string fails only for a wrong template, which the tests show.
    Ok(page.render().unwrap_or_default())
}

fn sections(source: &Source) -> Result<Vec<Section>, Error> {
    let speed = match (source.state, &source.file.motion) {
        (Some([omega, _]), _) => omega.abs(),
        (None, Some(motion)) => {
            (motion.at(motion.duration()).phi - motion.at(0.0).phi).abs() / motion.duration()
        }
        (None, None) => 1.0,
    };
    let mut sections = vec![Section::new(
        "The machine, reduced to its drive link",
        vec![
            Figure::new(
                figures::reduced_inertia(source.file)?.svg,
                "Reduced inertia with flywheel and drive train, and its derivative with respect to the position of the drive link.",
            ),
            Figure::new(
                figures::reduced_torque(source.file, speed)?.svg,
                format!(
                    "Parts of the reduced {}: weight and springs, process loads, and the magnitudes of viscous and motion-opposing loads.{}",
                    source.coordinate.vocabulary().torque,
                    figures::not_contained(source.file)
                ),
            ),
        ],
    )];
    let points = source.columns(
        Sets {
            points: true,
            ..Sets::default()
        },
        POINTS,
    )?;
    let motions = if source.moves() {
        figures::motions(&points, source.axis())
    } else {
        transfers(source, &points)
    };
    if !motions.is_empty() {
        sections.push(Section::new("Motion of points and links", motions));
    }
    if source.moves() {
        sections.push(forces(source)?);
    }
    Ok(sections)
}

/// Drive, joints, shaking force.
fn forces(source: &Source) -> Result<Section, Error> {
    let reactions = source.columns(
        Sets {
            reactions: true,
            ..Sets::default()
        },
        POINTS,
    )?;
    Ok(Section::new(
        "Forces",
        figures::forces(&reactions, source.axis()),
    ))
}

/// Transfer functions of points and links.
fn transfers(source: &Source, points: &Columns) -> Vec<Figure> {
    let per = source.coordinate.per();
    let of = [
        (
            &*format!("x′ [m/{per}]"),
            ColumnQuantity::XSlope,
            "Velocity transfer functions of every point, x; multiplied by the speed of the drive link they give the velocity.",
        ),
        (
            &*format!("y′ [m/{per}]"),
            ColumnQuantity::YSlope,
            "Velocity transfer functions of every point, y.",
        ),
        (
            &*format!("ψ′ [rad/{per}]"),
            ColumnQuantity::AngleSlope,
            "Velocity transfer functions of every link's angle.",
        ),
    ];
    figures::among(points, source.axis(), &of)
}

fn notes(source: &Source) -> Vec<String> {
    let mut notes = vec![match (source.over, source.state) {
        (Over::Time, _) => "Motions and forces are for the motion in the machine file.".to_owned(),
        (Over::Angle, Some([speed, acceleration])) => {
            let [rate, change] = source.coordinate.rates().map(|rate| rate.title());
            format!(
                "Motions and forces are for {rate} = {} and {change} = {} at every position.",
                short(speed),
                short(acceleration)
            )
        }
        (Over::Angle, None) => {
            "The machine file has no motion and --speed was not given: transfer functions only, no forces."
                .to_owned()
        }
    }];
    notes.push(
        "Forces are computed link by link with d'Alembert's principle, without J_red or its derivative. Flywheel and \
         drive train turn with the drive link: they change the drive torque but no joint force. The pull of a belt or \
         a pinion on the bearing of the drive link is not in the machine file."
            .to_owned(),
    );
    notes.push(
        "Full tables: jred reduce --points, --reactions, --energy, each with --format csv or json."
            .to_owned(),
    );
    notes
}
