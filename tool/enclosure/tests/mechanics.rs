//! A machine of the core with closed loops, as curves for a proof; and a search for the error of a table.

use jred::machine::{Jointed, Machine, Reducible, Reduction};
use jred::table::{CurveValues, Format, Table, words_len};
use jred::tabulate::{Request, fill, measure, scratch_len, torque_between};
use jred::{CurveSet, Phase, Scale, curves};
use jred_enclosure::{Closure, Curves, Goal, Parts, Proof, ProofError, prove};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

/// A machine in intervals.
pub(crate) struct EnclosedMachine<'m> {
    closure: Closure<'m>,
    parts: Parts<'m>,
}

impl<'m> EnclosedMachine<'m> {
    pub(crate) fn new<M: Jointed>(machine: &'m Machine<M>) -> Self {
        let mechanism = machine.mechanism();
        let phi = mechanism.domain().position(0.1);
        let frames = mechanism.frames(phi).unwrap();
        let joints = mechanism.joints(phi, &frames).unwrap().len();
        Self {
            closure: Closure::new(mechanism, mechanism.links().len(), joints, phi).unwrap(),
            parts: Parts {
                links: mechanism.links(),
                loads: machine.loads(),
                elements: machine.elements(),
                gravity: machine.gravity(),
                flywheel: machine.flywheel(),
            },
        }
    }

    pub(crate) fn curves(&self, stretch: [f64; 2]) -> Result<Curves, ProofError> {
        Curves::of(&self.parts, &self.closure.places(stretch)?, stretch)
    }
}

/// The words of a table, and their shape.
pub(crate) struct TestTable<F: Format> {
    pub(crate) words: Vec<F::Word>,
    pub(crate) shape: jred::table::Shape<F>,
}

pub(crate) fn made<F: Format>(
    machine: &impl Reducible,
    set: CurveSet,
    cells: u32,
    scale: Scale,
) -> TestTable<F> {
    let mut scratch = vec![0.0; scratch_len(cells, set)];
    let mut words = vec![F::Word::default(); words_len::<F>(cells, set)];
    let whole = F::WHOLE_FACTOR.then(|| scale.for_cells(cells, machine.domain().span()));
    let scale = whole.unwrap_or(scale);
    let shape = fill::<F>(machine, set, cells, &scale, &mut scratch, &mut words)
        .unwrap()
        .shape();
    TestTable { words, shape }
}

/// The request for a range of speed and acceleration.
fn request([omega, alpha]: [f64; 2]) -> Request {
    Request::new(1.0)
        .with_max_speed(omega)
        .with_max_acceleration(alpha)
}

/// Proves a table of a turn.
pub(crate) fn proof<F: Format>(
    machine: &impl Reducible,
    made: &TestTable<F>,
    range: [f64; 2],
    curves: &dyn Fn([f64; 2]) -> Result<Curves, ProofError>,
) -> Result<Proof, ProofError> {
    let table = Table::new(&made.words, made.shape).unwrap();
    let found = measure(machine, &table, &request(range)).unwrap();
    let edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
    let goal = Goal {
        start: machine.domain().position(0.0),
        span: machine.domain().span(),
        edges: &edges,
        turns: machine.domain() == jred::Domain::Turn,
        omega: range[0],
        alpha: range[1],
        known: found.torque_error - F::TICK_ROUNDING * f64::from(table.scale().torque()),
        negligible: 1e-12,
    };
    prove(&table, &goal, curves, &mut |_| true)
}

/// The largest error of a table at random positions and around the worst of them, evaluated without the rounding of a tick.
pub(crate) fn searched<F: Format>(
    machine: &impl Reducible,
    made: &TestTable<F>,
    range: [f64; 2],
) -> f64 {
    let table = Table::new(&made.words, made.shape).unwrap();
    let domain = machine.domain();
    let cells = table.cells();
    let error = |phase: Phase| {
        let phi = domain.position(f64::from(phase.to_bits()) / 4_294_967_296.0);
        let exact = machine.reduction(phi).unwrap();
        torque_between(&request(range), &read(&table, phase, cells, domain), &exact)
    };
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut worst = (0.0, 0);
    for _ in 0..20_000 {
        let bits = random.random::<u32>();
        let here = error(Phase::from_bits(bits));
        if here > worst.0 {
            worst = (here, bits);
        }
    }
    let mut step = u32::MAX / cells / 8;
    while step > 0 {
        let next = [worst.1.wrapping_add(step), worst.1.wrapping_sub(step)];
        match next
            .into_iter()
            .find(|bits| error(Phase::from_bits(*bits)) > worst.0)
        {
            Some(bits) => worst = (error(Phase::from_bits(bits)), bits),
            None => step /= 2,
        }
    }
    worst.0
}

/// The curves at a phase, from the polynomials of its cell.
pub(crate) fn read<F: Format>(
    table: &Table<'_, F>,
    phase: Phase,
    cells: u32,
    domain: jred::Domain,
) -> CurveValues {
    let place = f64::from(phase.to_bits()) * f64::from(cells) / 4_294_967_296.0;
    let cell = table.cell_curves(place as u32, domain).unwrap();
    let u = place.fract() - cell.centre;
    let at = |p: [f64; 4]| p[0] + u * (p[1] + u * (p[2] + u * p[3]));
    let mut values = CurveValues::default();
    values.inertia = at(cell.inertia);
    values.inertia_slope = at(cell.inertia_slope);
    values.load = at(cell.load);
    values.viscous = at(cell.viscous);
    values.coulomb = at(cell.coulomb).abs();
    values
}

/// A machine that does not report its edges.
pub(crate) struct Silent<'m, M>(pub(crate) &'m Machine<M>);

impl<M: Jointed> Reducible for Silent<'_, M> {
    fn domain(&self) -> jred::Domain {
        self.0.domain()
    }
    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        self.0.reduction(phi)
    }
}

/// Load and both frictions, where a machine has them.
pub(crate) const EVERY: CurveSet = curves::LOAD | curves::VISCOUS | curves::COULOMB;
