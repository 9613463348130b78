//! The exact curves, computed once and compared with every table that is tried.

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::f64::consts::TAU;

use jred::error::Error;
use jred::machine::{PoseError, Reducible, Reduction};
use jred::table::CurveValues;
use jred::tabulate::{Part, Request, edge_places, torque_between};
use jred::{Domain, Phase};

use crate::directions::MachineByDirection;

/// Places of the range, a prime number: it has no common divisor with a number of cells, so the places fall on every part of a cell.
const PLACES: u32 = 16_381;

/// Range of one table.
#[derive(Clone, Copy)]
pub(crate) enum Range<'m> {
    /// The machine's whole range.
    Whole(&'m MachineByDirection),
    /// A piece of it.
    Part(Part<'m, MachineByDirection>),
}

impl Range<'_> {
    /// The machine's position for a position of the range (rad, or m): a part counts from its start, perhaps into the next turn.
    pub(crate) fn position(&self, phi: f64) -> f64 {
        match self {
            Self::Whole(_) => phi,
            Self::Part(part) if part.turns() => (part.start() + phi).rem_euclid(TAU),
            Self::Part(part) => part.start() + phi,
        }
    }

    /// Start and end (rad, or m).
    pub(crate) fn ends(&self) -> [f64; 2] {
        let domain = self.domain();
        let from = self.position(domain.position(0.0));
        [from, from + domain.span()]
    }
}

impl Reducible for Range<'_> {
    fn domain(&self) -> Domain {
        match self {
            Self::Whole(machine) => machine.domain(),
            Self::Part(part) => part.domain(),
        }
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        match self {
            Self::Whole(machine) => machine.reduction(phi),
            Self::Part(part) => part.reduction(phi),
        }
    }

    fn edge(&self, k: usize) -> Option<f64> {
        match self {
            Self::Whole(machine) => machine.edge(k),
            Self::Part(part) => part.edge(k),
        }
    }

    fn check_repeats(&self) -> Result<(), PoseError> {
        match self {
            Self::Whole(machine) => machine.check_repeats(),
            Self::Part(part) => part.check_repeats(),
        }
    }
}

/// A machine with a cache of its knots, which tables of different types and layouts share.
pub(crate) struct KnotCache<M> {
    machine: M,
    knots: RefCell<HashMap<u64, Reduction>>,
    most: usize,
    repeats: OnceCell<Result<(), PoseError>>,
}

impl<M: Reducible> KnotCache<M> {
    /// Caches at most this many knots; then it clears the cache.
    pub(crate) fn new(machine: M, most: usize) -> Self {
        Self {
            machine,
            knots: RefCell::default(),
            most,
            repeats: OnceCell::new(),
        }
    }
}

impl<M: Reducible> Reducible for KnotCache<M> {
    fn domain(&self) -> Domain {
        self.machine.domain()
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        if let Some(known) = self.knots.borrow().get(&phi.to_bits()) {
            return Ok(*known);
        }
        let found = self.machine.reduction(phi)?;
        let mut knots = self.knots.borrow_mut();
        if knots.len() >= self.most {
            knots.clear();
        }
        knots.insert(phi.to_bits(), found);
        Ok(found)
    }

    fn edge(&self, k: usize) -> Option<f64> {
        self.machine.edge(k)
    }

    fn check_repeats(&self) -> Result<(), PoseError> {
        *self.repeats.get_or_init(|| self.machine.check_repeats())
    }
}

/// The exact curves at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReferencePoint {
    pub(crate) phase: Phase,
    /// Position (rad, or m).
    pub(crate) phi: f64,
    pub(crate) exact: Reduction,
}

/// The exact curves at places over the whole range, at its edges and between them.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    pub(crate) places: Vec<ReferencePoint>,
}

impl Reference {
    pub(crate) fn new(machine: &impl Reducible) -> Result<Self, Error> {
        let domain = machine.domain();
        let even = (0..PLACES)
            .map(|k| Phase::from_bits(((u64::from(k) << 32) / u64::from(PLACES)) as u32));
        let edges = edge_places(machine).map(|phi| domain.phase(phi));
        // A stroke has no place beyond its end.
        let end = (domain != Domain::Turn).then_some(Phase::from_bits(u32::MAX));
        let place = |phase: Phase| {
            let phi = domain.position(f64::from(phase.to_bits()) / 4_294_967_296.0);
            let exact = machine.reduction(phi)?;
            Ok(ReferencePoint { phase, phi, exact })
        };
        let places = even
            .chain(edges)
            .chain(end)
            .map(place)
            .collect::<Result<_, Error>>()?;
        Ok(Self { places })
    }

    /// The largest bound of a table's torque error (see [`jred::tabulate`]) for |ω|, |α| up to `range`, and the index of its place. The search begins
    /// at index `start` and ends at the first place above `limit`.
    pub(crate) fn error(
        &self,
        read: impl Fn(Phase) -> CurveValues,
        [omega, alpha]: [f64; 2],
        start: usize,
        limit: f64,
    ) -> (f64, usize) {
        let request = Request::new(limit)
            .with_max_speed(omega)
            .with_max_acceleration(alpha);
        let mut worst = (0.0, start);
        let order = (start..self.places.len()).chain(0..start);
        for (index, place) in order.filter_map(|k| Some((k, self.places.get(k)?))) {
            let error = torque_between(&request, &read(place.phase), &place.exact);
            if error > worst.0 {
                worst = (error, index);
                if error > limit {
                    break;
                }
            }
        }
        worst
    }
}
