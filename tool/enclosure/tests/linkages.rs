//! Proofs of tables of linkages.

use jred::machine::{Jointed, MassProperties};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use jred::table::{Format, words_len};
use jred::tabulate::{Request, curves_in_use, fill, measure, scratch_len};
use jred::{Cubic, Link, Machine, Q31, Quadratic, Reducible, Rows16, Scale, Spline, Spline16};
use jred_enclosure::{Closure, Curves, Goal, Parts, prove};

fn press() -> Machine<SliderCrank> {
    let crank = Link::new(MassProperties { mass: 9.0, inertia: 0.018, com: [0.006, 0.0] }).unwrap();
    let rod = Link::new(MassProperties { mass: 6.5, inertia: 0.03, com: [0.055, 0.0] }).unwrap();
    let links = [crank, rod, Link::point_mass(42.0).unwrap()];
    let dimensions = SliderCrankDimensions { crank: 0.03, rod: 0.12, offset: 0.0 };
    let mechanism = SliderCrank::new(dimensions, Branch::Right, links).unwrap();
    Machine::new(mechanism).with_gravity([9.81, 0.0]).unwrap()
}

fn proven<F: Format>(machine: &Machine<impl Jointed>, cells: u32, range: [f64; 2], scale: Scale) {
    let set = curves_in_use(machine, 256).unwrap();
    let mut scratch = vec![0.0; scratch_len(cells, set)];
    let mut words = vec![F::Word::default(); words_len::<F>(cells, set)];
    let scale = if F::WHOLE_FACTOR { scale.for_cells(cells, std::f64::consts::TAU) } else { scale };
    let table = fill::<F>(machine, set, cells, &scale, &mut scratch, &mut words).unwrap();
    let request = Request::new(1.0).with_omega(range[0]).with_alpha(range[1]);
    let found = measure(machine, &table, &request).unwrap();
    let mechanism = machine.mechanism();
    let frames = mechanism.frames(0.1).unwrap();
    let joints = mechanism.joints(0.1, &frames).unwrap().len();
    let closure = Closure::new(mechanism, mechanism.links().len(), joints, 0.1).unwrap();
    let parts = Parts {
        links: mechanism.links(),
        loads: machine.loads(),
        elements: machine.elements(),
        gravity: machine.gravity(),
        flywheel: machine.flywheel(),
    };
    let edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
    let goal = Goal {
        start: 0.0,
        span: std::f64::consts::TAU,
        edges: &edges,
        turns: true,
        omega: range[0],
        alpha: range[1],
        known: found.torque_error,
        negligible: 1e-9,
    };
    let curves = |stretch| Curves::of(&parts, &closure.places(stretch)?, stretch);
    let start = std::time::Instant::now();
    let proof = prove(&table, &goal, &curves, &mut |_| true).unwrap();
    println!("{} {cells}: sampled {} {}, {proof:?} ratio {} in {:?}", F::NAME, found.torque_error, found.bound, proof.bound / found.torque_error, start.elapsed());
}

#[test]
fn a_press() {
    let press = press();
    let range = [12.0, 60.0];
    proven::<Spline<f32>>(&press, 24, range, Scale::SI);
    proven::<Spline<f32>>(&press, 240, range, Scale::SI);
    proven::<Cubic<f32>>(&press, 24, range, Scale::SI);
    proven::<Quadratic<f32>>(&press, 64, range, Scale::SI);
    let scale = Scale::covering(&press, 12.0, 60.0, 1024).unwrap();
    proven::<Spline<Q31>>(&press, 24, range, scale);
    proven::<Cubic<Q31>>(&press, 24, range, scale);
    proven::<Quadratic<Q31>>(&press, 24, range, scale);
    proven::<Spline16>(&press, 24, range, scale);
    let scale = Scale::limited_to(&press, 12.0, 60.0, 1024).unwrap();
    proven::<Rows16>(&press, 64, range, scale);
}
