//! The largest magnitudes of the forces over the motion, and their positions.

use jred::Domain;
use jred::error::Error;
use jred::machine::motion::State;
use jred::machine::{Mechanism as _, Reducible as _};
use serde::{Serialize, Serializer};

use super::reactions::{self, Reactions};
use super::rows::Pass;
use super::{Over, Request, RowPose, Set as _, Source};
use crate::duty::{INSIDE, smooth_stretches};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::columns::{Column, ColumnQuantity};
use jred_file::number::parabola;
use jred_file::number::rounding::short;

/// Least number of positions that are searched: the quarter degrees of a turn.
const LEAST_POSITIONS: usize = 1440;

/// Fewest steps per turn or stroke, in a motion over many.
const OF_TURN: f64 = 180.0;

/// Fewest steps of a smooth stretch.
const FEWEST: usize = 16;

/// The largest magnitude of one quantity.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Largest {
    /// The quantity.
    #[serde(serialize_with = "title")]
    #[schemars(with = "String")]
    pub quantity: Column,
    /// The value, with its sign.
    pub value: f64,
    /// The variable of the rows.
    #[serde(serialize_with = "title")]
    #[schemars(with = "String")]
    pub over: Column,
    /// Its place.
    pub at: f64,
}

impl Largest {
    /// For example `drive 812.4 N m at phi = 341 deg`.
    pub fn sentence(&self) -> String {
        let (quantity, over) = (&self.quantity, &self.over);
        format!(
            "{} {} {} at {} = {} {}",
            quantity.name,
            short(self.value),
            quantity.unit,
            over.name,
            short(self.at),
            over.unit
        )
    }
}

fn title<S: Serializer>(column: &Column, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&column.title())
}

/// The largest drive torque, joint forces, and shaking force of the request. Each smooth stretch of the motion is searched, with steps of 1440 or
/// more over the whole, then the peak next to the largest value is refined.
///
/// # Errors
/// Errors of the machine.
pub fn largest(file: &MachineFile, request: &Request) -> Result<Vec<Largest>, Error> {
    let source = Source::new(file)?;
    let Some(course) = SearchDomain::of(&source, request) else {
        return Ok(Vec::new());
    };
    let stretches = course.stretches(&source, request.positions.max(LEAST_POSITIONS));
    let search = PeakSearch {
        reactions: Reactions::new(&source)?,
        source: &source,
        course,
    };
    let heads = search.reactions.heads(&source);
    // Magnitudes and moments; the components add no information.
    let judged = [
        ColumnQuantity::DriveEffort,
        ColumnQuantity::Force,
        ColumnQuantity::Moment,
    ];
    // Towards a change point the forces in the joints grow without bound; the drive and the shaking force, which come first and last, do not.
    let guided = !source.machine.mechanism().change_points().is_empty();
    let joints = 1..heads.len().saturating_sub(reactions::LOADS.len());
    let judged: Vec<bool> = (heads.iter().enumerate())
        .map(|(k, head)| judged.contains(&head.quantity) && !(guided && joints.contains(&k)))
        .collect();
    // The places of all stretches in order, and the magnitude of each judged quantity there.
    let mut places = Vec::new();
    let mut sizes = vec![Vec::new(); heads.len()];
    let mut scale = 0.0f64;
    for (number, stretch) in stretches.iter().enumerate() {
        for step in 0..=stretch.steps {
            places.push((number, step));
            let row = search.at(stretch.place(step))?;
            for (k, value) in row.into_iter().enumerate() {
                scale = scale.max(value.abs());
                if judged[k] {
                    sizes[k].push(value.abs());
                }
            }
        }
    }
    let around = |place: usize| {
        let (number, step) = places[place];
        let last = stretches[number].steps - 2;
        let first = place - step + step.saturating_sub(1).min(last);
        Some([first, first + 1, first + 2])
    };
    let mut found = Vec::new();
    for (k, (head, sizes)) in heads.iter().zip(&sizes).enumerate() {
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        // The moment of a guide through the centre of mass of its slider is only rounding.
        if largest <= 1e-12 * scale {
            continue;
        }
        let peak = parabola::highest(
            (sizes.len(), |place| sizes[place]),
            around,
            |place| stretches[places[place].0].place(places[place].1),
            |x| Ok::<_, Error>(search.at(x)?[k].abs()),
            0.0,
        )?;
        let Some(([first, ..], x)) = peak else {
            continue;
        };
        let stretch = &stretches[places[first].0];
        found.push(Largest {
            quantity: head.clone(),
            value: search.at(x)?[k],
            over: match request.over {
                Over::Time => super::time_column(),
                Over::Angle => source.coordinate.column(),
            },
            at: match request.over {
                Over::Time => stretch.snapped(x),
                Over::Angle => search.position(stretch.snapped(x)),
            },
        });
    }
    Ok(found)
}

/// The course that is searched.
enum SearchDomain<'f> {
    /// The motion over time.
    Motion(&'f Motion),
    /// All positions, at this speed and acceleration.
    State([f64; 2]),
}

impl<'f> SearchDomain<'f> {
    /// The course of a request; `None` if no row has a motion.
    fn of(source: &Source<'f>, request: &Request) -> Option<Self> {
        if let Some(state) = request.state {
            return Some(Self::State(state));
        }
        let motion = source.file.motion.as_ref()?;
        // Over the position, forces exist only if the motion passes each position once.
        let domain = source.file.machine.domain();
        let known = request.over == Over::Time || Pass::of(motion, domain).is_some();
        known.then_some(Self::Motion(motion))
    }

    fn state(&self, x: f64) -> State<f64> {
        match self {
            Self::Motion(motion) => motion.at(x),
            Self::State([omega, alpha]) => State {
                phi: x,
                omega: *omega,
                alpha: *alpha,
            },
        }
    }

    /// The smooth stretches, with about `steps` steps in total.
    fn stretches(&self, source: &Source, steps: usize) -> Vec<Stretch> {
        let parts = match self {
            Self::Motion(motion) => smooth_stretches(source.file, motion),
            Self::State(_) => between_edges(source.file),
        };
        let whole: f64 = parts.iter().map(|(from, to)| to - from).sum();
        let span = source.file.machine.domain().span();
        let stretch = |(from, to): (f64, f64)| {
            let way = (self.state(to).phi - self.state(from).phi).abs() / span;
            let even = steps as f64 * (to - from) / whole;
            Stretch {
                from,
                to,
                steps: (even.max(OF_TURN * way).ceil() as usize).max(FEWEST),
            }
        };
        parts.into_iter().map(stretch).collect()
    }
}

/// A part of the course without a jump.
struct Stretch {
    from: f64,
    to: f64,
    steps: usize,
}

impl Stretch {
    fn place(&self, step: usize) -> f64 {
        let part = step as f64 / self.steps as f64;
        self.from + part.clamp(INSIDE, 1.0 - INSIDE) * (self.to - self.from)
    }

    /// A place close to an end of the stretch becomes that end.
    fn snapped(&self, x: f64) -> f64 {
        let near = 2.0 * INSIDE * (self.to - self.from);
        let ends = [self.from, self.to].into_iter();
        ends.filter(|end| (x - end).abs() < near)
            .fold(x, |_, end| end)
    }
}

/// The range of the drive link, cut where a load begins or ends or the segments of a cam meet.
pub(crate) fn between_edges(file: &MachineFile) -> Vec<(f64, f64)> {
    let domain = file.machine.domain();
    let [from, to] = [0.0, 1.0].map(|part| domain.position(part));
    let edges = (0..).map_while(|k| file.machine.edge(k));
    let edges = edges.map(|edge| match domain {
        Domain::Turn => from + (edge - from).rem_euclid(to - from),
        Domain::Stroke { .. } => edge,
    });
    let mut cuts: Vec<f64> = edges.filter(|edge| from < *edge && *edge < to).collect();
    cuts.extend([from, to]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts.windows(2).map(|cut| (cut[0], cut[1])).collect()
}

struct PeakSearch<'s, 'f> {
    source: &'s Source<'f>,
    reactions: Reactions,
    course: SearchDomain<'f>,
}

impl PeakSearch<'_, '_> {
    /// The forces at x.
    fn at(&self, x: f64) -> Result<Vec<f64>, Error> {
        let state = self.course.state(x);
        let now = match self.course {
            SearchDomain::Motion(_) => ScheduleInstant::of(x, state.omega),
            SearchDomain::State(_) => ScheduleInstant {
                omega: Some(state.omega),
                ..ScheduleInstant::default()
            },
        };
        let place = RowPose {
            now,
            phi: state.phi,
            frames: self.source.machine.mechanism().frames(state.phi)?,
            state: Some(state),
        };
        let values = self.reactions.values(self.source, &place)?;
        Ok(values.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// The displayed position of x, on a turn between 0 and 360 degrees.
    fn position(&self, x: f64) -> f64 {
        let phi = self.course.state(x).phi;
        let phi = match self.source.file.machine.domain() {
            Domain::Turn => phi.rem_euclid(std::f64::consts::TAU),
            Domain::Stroke { .. } => phi,
        };
        self.source.coordinate.shown(phi)
    }
}
