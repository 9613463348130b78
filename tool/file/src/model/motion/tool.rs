//! A coordinate of the tool as a function of the drive link's position, and its inverse: the drive link's motion for a motion prescribed at the tool.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::motion::State;
use jred::machine::{Mechanism as _, PoseError};
use jred::number::Transfer;

use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;

mod raw;

use raw::{Knot, Raw};

/// Places per turn or stroke at which the coordinate is tabulated.
const PLACES: u32 = 1440;

/// A transfer function below this share of its largest value is zero: there the tool is at rest whatever the drive link does.
const STANDSTILL: f64 = 1e-9;

/// A transfer function that is nowhere larger than this (m or rad, per rad or m) is rounding: the tool does not move at all.
const NO_MOTION: f64 = 1e-12;

/// Relative variation of the transfer function of a coordinate that is linear in the drive link's: rounding.
const LINEARITY: f64 = 1e-9;

/// Most Newton steps; two are usual, and bisection needs fifty.
const MOST_STEPS: u32 = 100;

/// Measured quantity of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// x (0) or y (1) of a point `[u, v]` of a link (m).
    Position {
        /// Index of the link.
        link: usize,
        /// The point in its frame (m).
        at: [f64; 2],
        /// 0: x, 1: y.
        axis: usize,
    },
    /// Distance of a point `[u, v]` of a link along its path (m).
    Path {
        /// Index of the link.
        link: usize,
        /// The point in its frame (m).
        at: [f64; 2],
    },
    /// Angle of a link (rad).
    Angle {
        /// Index of the link.
        link: usize,
    },
    /// Displacement in a guide (m).
    Slide {
        /// Index of the joint.
        joint: usize,
    },
}

/// Why the coordinate cannot prescribe the drive link.
#[derive(Clone, Debug, PartialEq)]
pub enum Standstill {
    /// It does not move anywhere.
    Everywhere,
    /// Near the requested position, the tool is at rest.
    Here,
    /// The mechanism cannot be placed.
    Unplaced(PoseError),
}

/// A coordinate of the tool on the part of the drive link's range on which it is monotonic.
#[derive(Clone, Debug)]
pub struct ToolCoordinate {
    mechanism: AnyMechanism,
    measure: Measure,
    name: String,
    /// In order of φ, from end to end of the branch; at least two.
    knots: Vec<Knot>,
    /// A position of the drive link on the branch, and the coordinate there.
    near: [f64; 2],
    /// Its increase per turn, if the tool never turns back.
    per_turn: Option<f64>,
}

impl ToolCoordinate {
    /// The coordinate on the branch around the drive link's position `near` (rad, or m). A distance along the path is zero there.
    ///
    /// # Errors
    /// The tool is at rest there, or the mechanism cannot be placed.
    pub fn new(
        mechanism: &AnyMechanism,
        measure: Measure,
        name: String,
        near: f64,
    ) -> Result<Self, Standstill> {
        let raw = Raw { mechanism, measure };
        let domain = mechanism.domain();
        let step = domain.span() / f64::from(PLACES);
        let mut most = 0.0_f64;
        for k in 0..=PLACES {
            let phi = domain.position(f64::from(k) / f64::from(PLACES));
            most = most.max(raw.slope(phi)?.abs());
        }
        let least = STANDSTILL * most;
        let first = raw.slope(near)?;
        if most <= NO_MOTION {
            return Err(Standstill::Everywhere);
        }
        if first.abs() <= least {
            return Err(Standstill::Here);
        }
        let moves = |phi: f64| Ok::<_, Standstill>(raw.slope(phi)? * first.signum() > least);
        let [low, high] = match domain {
            Domain::Turn => [near - TAU, near + TAU],
            Domain::Stroke { from, to } => [from, to],
        };
        let up = raw.reach(near, step, high, &moves)?;
        let endless = domain == Domain::Turn && up.closed;
        let mut places = up.places;
        if !endless {
            let down = raw.reach(near, -step, low, &moves)?;
            places = (down.places.into_iter().rev())
                .chain(places.into_iter().skip(1))
                .collect();
        }
        let knots = raw.knots(&places, near)?;
        let ends = knots.first().zip(knots.last());
        let per_turn = ends.filter(|_| endless).map(|(a, b)| b.value - a.value);
        let here = knots.iter().find(|knot| knot.phi >= near);
        let value = here.map_or(0.0, |knot| knot.value);
        if knots.len() < 2 {
            return Err(Standstill::Here);
        }
        Ok(Self {
            mechanism: mechanism.clone(),
            measure,
            name,
            knots,
            near: [near, value],
            per_turn,
        })
    }

    /// The measured quantity.
    pub const fn measure(&self) -> Measure {
        self.measure
    }

    /// Its name, for example "x of ram".
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it is an angle or a length.
    pub const fn coordinate(&self) -> Coordinate {
        match self.measure {
            Measure::Angle { .. } => Coordinate::Angle,
            _ => Coordinate::Length,
        }
    }

    /// Its symbol in columns and messages.
    pub const fn symbol(&self) -> &'static str {
        match self.measure {
            Measure::Position { axis: 0, .. } => "x",
            Measure::Position { .. } => "y",
            Measure::Path { .. } | Measure::Slide { .. } => "s",
            Measure::Angle { .. } => "psi",
        }
    }

    /// Its value at the position that selected the branch.
    pub const fn value_near(&self) -> f64 {
        self.near[1]
    }

    /// Its increase per turn of the drive link; `None` if it turns back within a turn, or the drive link has a stroke.
    pub const fn per_turn(&self) -> Option<f64> {
        self.per_turn
    }

    /// The ends of the branch as [drive link, tool], the smaller value of the tool first; `None` if it never turns back.
    pub fn ends(&self) -> Option<[[f64; 2]; 2]> {
        if self.per_turn.is_some() {
            return None;
        }
        let ends = [self.knots.first()?, self.knots.last()?].map(|knot| [knot.phi, knot.value]);
        let [first, last] = ends;
        Some(if first[1] <= last[1] {
            ends
        } else {
            [last, first]
        })
    }

    /// The coordinate as an [`Axis`], if it is linear in the drive link's.
    pub fn axis(&self) -> Option<Axis> {
        let (first, last) = self.knots.first().zip(self.knots.last())?;
        let scale = (last.value - first.value) / (last.phi - first.phi);
        let even = |knot: &Knot| (knot.slope - scale).abs() <= LINEARITY * scale.abs();
        let zero = first.value - scale * first.phi;
        let axis = Axis::new(self.coordinate(), self.symbol(), [zero, scale]);
        self.knots.iter().all(even).then_some(axis)
    }

    /// The coordinate with its transfer functions at the drive link's position `phi`, which lies on the branch.
    ///
    /// # Errors
    /// The mechanism cannot be placed.
    pub fn at(&self, phi: f64) -> Result<Transfer, PoseError> {
        let raw = Raw {
            mechanism: &self.mechanism,
            measure: self.measure,
        };
        let turns = match (self.per_turn, self.knots.first()) {
            (Some(_), Some(first)) => ((phi - first.phi) / TAU).floor(),
            _ => 0.0,
        };
        let place = phi - turns * TAU;
        let index = self.knots.partition_point(|knot| knot.phi <= place);
        let knot = self.knots.get(index.max(1) - 1).copied();
        let mut found = raw.from(knot.as_ref(), place)?;
        found.value += turns * self.per_turn.unwrap_or(0.0);
        Ok(found)
    }

    /// The drive link's state for a state of the tool: φ̇ = ṡ/s′, φ̈ = (s̈ − s″·φ̇²)/s′. A value beyond the branch is replaced by its end.
    pub fn drive(&self, tool: State<f64>) -> State<f64> {
        let (turns, value) = match (self.per_turn, self.knots.first()) {
            (Some(per_turn), Some(first)) => {
                let turns = ((tool.phi - first.value) / per_turn).floor();
                (turns, tool.phi - turns * per_turn)
            }
            _ => (0.0, tool.phi),
        };
        let (phi, transfer) = self.inverse(value);
        let omega = tool.omega / transfer.d1;
        State {
            phi: phi + turns * TAU,
            omega,
            alpha: (tool.alpha - transfer.d2 * omega * omega) / transfer.d1,
        }
    }

    /// The drive link's position for a value of the tool.
    pub fn drive_at(&self, value: f64) -> f64 {
        let at_rest = State {
            phi: value,
            ..State::default()
        };
        self.drive(at_rest).phi
    }

    /// Newton's method between two knots, starting from their cubic φ(s); bisection where it leaves the bracket.
    fn inverse(&self, value: f64) -> (f64, Transfer) {
        let rising = self.knots.first().zip(self.knots.last());
        let rising = rising.is_none_or(|(first, last)| first.value <= last.value);
        let index = self
            .knots
            .partition_point(|knot| (knot.value <= value) == rising)
            .clamp(1, self.knots.len() - 1);
        let (a, b) = (self.knots[index - 1], self.knots[index]);
        let [least, most] = if rising { [a, b] } else { [b, a] }.map(|knot| knot.value);
        let value = value.clamp(least, most);
        let scale = f64::EPSILON * a.value.abs().max(b.value.abs());
        let (mut low, mut high) = (a.phi, b.phi);
        let mut phi = guess(a, b, value).clamp(low, high);
        let raw = Raw {
            mechanism: &self.mechanism,
            measure: self.measure,
        };
        let mut found = Transfer::constant(value);
        found.d1 = a.slope;
        for _ in 0..MOST_STEPS {
            // The mechanism was placed at both knots, so it can be placed between them.
            let Ok(here) = raw.from(Some(&a), phi) else {
                break;
            };
            found = here;
            let off = here.value - value;
            if (off > 0.0) == rising {
                high = phi;
            } else {
                low = phi;
            }
            let next = phi - off / here.d1;
            let next = if next > low && next < high {
                next
            } else {
                low.midpoint(high)
            };
            if off.abs() <= scale || (next - phi).abs() <= 0.0 {
                break;
            }
            phi = next;
        }
        (phi, found)
    }
}

/// φ by Hermite's cubic over the coordinate between two knots.
fn guess(a: Knot, b: Knot, value: f64) -> f64 {
    let way = b.value - a.value;
    if way == 0.0 {
        return a.phi;
    }
    let z = (value - a.value) / way;
    let (rise, first, last) = (b.phi - a.phi, way / a.slope, way / b.slope);
    let cubic = first + z * (3.0 * rise - 2.0 * first - last + z * (first + last - 2.0 * rise));
    let phi = a.phi + z * cubic;
    if phi.is_finite() {
        phi
    } else {
        a.phi.midpoint(b.phi)
    }
}
