//! How far a table errs beyond what `TableFigures::bound` says, which rests on places at equal distances: a search by hill climbing
//! between them, for every machine file in `machines/`.

use jred::machine::Reducible;
use jred::table::{Format, Table, words_len};
use jred::tabulate::{Request, curves_in_use, fill, measure, scratch_len, torque_between};
use jred::{Cubic, CurveSet, Phase, Quadratic, Scale, Spline, curves};

use crate::reading::machines;

/// Speed and acceleration of the drive link (rad/s, or m/s).
const OMEGA: f64 = 7.0;
const ALPHA: f64 = 40.0;

/// The search starts from so many places with the largest errors, two of them in each cell, from the worst place that is known, and beside edges.
const CLIMBS: usize = 8;

/// The largest error that is found (N·m), at any phase.
fn searched(worst: f64, machine: &impl Reducible, cells: u32, error: impl Fn(u32) -> f64) -> f64 {
    let domain = machine.domain();
    let edges = (0..).map_while(|k| machine.edge(k));
    let beside = edges.chain([worst]).flat_map(|position| {
        let bits = domain.phase(position).to_bits();
        [bits.wrapping_sub(1), bits, bits.wrapping_add(1)]
    });
    let anywhere = (1..=2 * cells).map(|k| k.wrapping_mul(0x9e37_79b9));
    let mut starts: Vec<_> = beside
        .chain(anywhere)
        .map(|bits| (error(bits), bits))
        .collect();
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    starts.dedup();
    let climb = |&(error_here, bits): &(f64, u32)| {
        let (mut most, mut bits) = (error_here, bits);
        let mut step = u32::MAX / cells / 4;
        while step > 0 {
            let next = [bits.wrapping_add(step), bits.wrapping_sub(step)];
            match next.into_iter().find(|next| error(*next) > most) {
                Some(next) => (most, bits) = (error(next), next),
                None => step /= 2,
            }
        }
        most
    };
    starts.iter().take(CLIMBS).map(climb).fold(0.0, f64::max)
}

/// The largest error found over the largest at the places, and over the bound; of the smallest of some sizes that is a table.
fn beyond<F: Format>(machine: &impl Reducible) -> Option<[f64; 2]> {
    let set: CurveSet = curves_in_use(machine, 256).unwrap();
    let request = Request::new(1.0)
        .with_max_speed(OMEGA)
        .with_max_acceleration(ALPHA);
    let cells = [24, 96, 384]
        .into_iter()
        .find(|cells| table::<F, _>(machine, set, *cells, |_| ()).is_some())?;
    table::<F, _>(machine, set, cells, |table| {
        let found = measure(machine, table, &request).unwrap();
        let domain = machine.domain();
        let error = |bits: u32| {
            let phase = Phase::from_bits(bits);
            let phi = domain.position(f64::from(bits) / 4_294_967_296.0);
            let exact = machine.reduction(phi).unwrap();
            torque_between(&request, &table.si(phase, domain), &exact)
        };
        let most = searched(found.worst, machine, cells, error);
        assert!(
            most >= found.torque_error * (1.0 - 1e-9),
            "{most} {found:?}"
        );
        // Constant curves have no error in double precision.
        [found.torque_error, found.bound].map(|said| if most > 0.0 { most / said } else { 0.0 })
    })
}

fn table<F: Format, T>(
    machine: &impl Reducible,
    set: CurveSet,
    cells: u32,
    with: impl Fn(&Table<'_, F>) -> T,
) -> Option<T> {
    let mut scratch = vec![0.0; scratch_len(cells, set)];
    let mut words = vec![F::Word::default(); words_len::<F>(cells, set)];
    let made = fill::<F>(machine, set, cells, &Scale::SI, &mut scratch, &mut words);
    made.ok().map(|table| with(&table))
}

/// The search finds more than the places do by this share at most [1.3 %]. It finds more than the bound where the error has a corner,
/// which rises above its neighbours by up to half of their second difference, a parabola by an eighth: two machines with loads
/// that begin within the table have some [0.7 %], one with frictions that add up [0.5 %]. Without a corner it finds no more, to rounding.
const BEYOND_PLACES: f64 = 1.02;
const BEYOND_BOUND: f64 = 1.01;
const SMOOTH: f64 = 1.0 + 1e-9;

/// Whether the friction varies and never falls to zero: then its magnitude is in the table, with the kinks where a part of it does.
fn adds_up(machine: &impl Reducible) -> bool {
    let domain = machine.domain();
    let friction = |k: u32| {
        let reduced = machine.reduction(domain.position(f64::from(k) / 1024.0));
        reduced.unwrap().coulomb
    };
    let varies = curves_in_use(machine, 256).unwrap() & curves::COULOMB != 0;
    varies && (0..1024).all(|k| friction(k) > 0.0)
}

#[test]
fn hardly_any_place_errs_more_than_the_bound() {
    let mut most = [0.0_f64; 3];
    for (path, file) in machines() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let machine = &file.machine;
        let edges = (0..).map_while(|k| machine.edge(k)).count();
        for found in [
            beyond::<Spline<f64>>(machine),
            beyond::<Cubic<f32>>(machine),
            beyond::<Quadratic<f32>>(machine),
        ] {
            let [places, bound] = found.unwrap();
            println!("{name}, {edges} edges: {places} of the places, {bound} of the bound");
            assert!(places <= BEYOND_PLACES, "{name}: {places}");
            let corners = edges > 0 || adds_up(machine);
            let limit = if corners { BEYOND_BOUND } else { SMOOTH };
            assert!(bound <= limit, "{name}: {bound}");
            let kind = usize::from(corners);
            most[kind] = most[kind].max(bound);
            most[2] = most[2].max(places);
        }
    }
    // The results of the search are close to the bounds: it evaluates the right positions.
    println!("{most:?}");
    assert!(most[0] > 0.99 && most[1] > 1.002 && most[2] > 1.005);
}
