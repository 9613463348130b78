//! Proofs of tables of linkages, compared with searches for the largest error; and proofs that must fail.

use jred::machine::{
    Action, Element, Jointed, Link, Load, Machine, Marker, MassProperties, Reducible, Window,
};
use jred::mechanism::{
    Branch, FourBar, FourBarDimensions, ScotchYoke, ScotchYokeDimensions, Side, SliderCrank,
    SliderCrankDimensions,
};
use jred::table::{Format, Table};
use jred::tabulate::{Request, measure};
use jred::{Cubic, Domain, Q31, Quadratic, Rows16, Scale, Spline, Spline16, curves};
use jred_enclosure::{Closure, ProofError};

use crate::mechanics::{EVERY, EnclosedMachine, Silent, TestTable, made, proof, read, searched};

const RANGE: [f64; 2] = [12.0, 60.0];

fn link(mass: f64, inertia: f64, com: [f64; 2]) -> Link {
    Link::new(MassProperties { mass, inertia, com }).unwrap()
}

/// A press with weight, a spring, a force that acts in a part of the turn, and friction of each kind.
fn press() -> Machine<SliderCrank> {
    let links = [
        link(9.0, 0.018, [0.006, 0.0]),
        link(6.5, 0.03, [0.055, 0.0]),
        Link::point_mass(42.0).unwrap(),
    ];
    let dimensions = SliderCrankDimensions {
        crank: 0.03,
        rod: 0.12,
        offset: 0.004,
    };
    let mechanism = SliderCrank::new(dimensions, Branch::Right, links).unwrap();
    let slider = SliderCrank::SLIDER;
    let ends = [Marker::ground([0.4, 0.05]), Marker::on(slider, [0.0, 0.02])];
    let window = Window::new(Domain::Turn, [5.2, 6.0], 0.3).unwrap();
    let load = |link, action| Load::new(link, action).unwrap();
    Machine::new(mechanism)
        .with_gravity([9.81, 0.0])
        .and_then(|m| m.with_flywheel(0.05))
        .and_then(|m| m.with_element(Element::spring(ends, 900.0, 0.1)?))
        .and_then(|m| m.with_load(load(slider, Action::Force([-300.0, 20.0])).within(window)))
        .and_then(|m| m.with_load(load(slider, Action::OpposingForce(60.0))))
        .and_then(|m| m.with_load(load(SliderCrank::CRANK, Action::OpposingMoment(0.4))))
        .and_then(|m| m.with_load(load(slider, Action::ViscousForce(11.0))))
        .unwrap()
}

fn four_bar() -> Machine<FourBar> {
    let links = [
        link(0.5, 4e-4, [0.03, -0.005]),
        link(0.9, 6e-3, [0.11, 0.04]),
        link(0.7, 2.5e-3, [0.085, 0.01]),
    ];
    let dimensions = FourBarDimensions {
        crank: 0.08,
        coupler: 0.25,
        rocker: 0.18,
        pivot: [0.3, 0.0],
    };
    let mechanism = FourBar::new(dimensions, Side::Left, links).unwrap();
    let moment = Load::new(FourBar::ROCKER, Action::Moment(-6.0)).unwrap();
    let ends = [
        Marker::ground([0.0, 0.0]),
        Marker::on(FourBar::ROCKER, [0.0, 0.0]),
    ];
    let damper = Element::torsion_damper(ends, 0.02).unwrap();
    Machine::new(mechanism)
        .with_gravity([0.0, -9.81])
        .and_then(|m| m.with_load(moment))
        .and_then(|m| m.with_element(damper))
        .unwrap()
}

fn yoke() -> Machine<ScotchYoke> {
    let dimensions = ScotchYokeDimensions {
        crank: 0.06,
        slot_angle: 1.3,
    };
    let links = [Link::rotor(0.1).unwrap(), Link::point_mass(6.8).unwrap()];
    let friction = Load::new(ScotchYoke::YOKE, Action::OpposingForce(35.0)).unwrap();
    let mechanism = ScotchYoke::new(dimensions, links).unwrap();
    Machine::new(mechanism).with_load(friction).unwrap()
}

/// The proven bound is not below the result of a search, and not far above; the tick's bound is above the table's.
fn holds<F: Format>(machine: &Machine<impl Jointed>, set: u16, cells: u32, scale: Scale) {
    let enclosed = EnclosedMachine::new(machine);
    let made: TestTable<F> = made(machine, set, cells, scale);
    let proof = proof(machine, &made, RANGE, &|stretch| enclosed.curves(stretch)).unwrap();
    let found = searched(machine, &made, RANGE);
    let words = format!("{} {cells}: {found} {proof:?}", F::NAME);
    println!("{words}");
    // Rounding of the search itself.
    let rounding = 1e-11;
    assert!(found <= proof.bound + rounding, "{words}");
    // The known error is read in the table's own arithmetic, which has a part of the tick's rounding.
    let roundings = proof.ticked.unwrap() - proof.bound;
    assert!(
        proof.bound <= 1.01 * found + 0.5 * roundings + 1e-9,
        "{words}"
    );
    assert!(
        proof.least <= proof.bound && 0.5 * proof.bound <= proof.least,
        "{words}"
    );
    assert!(proof.ticked.unwrap() > proof.bound, "{words}");
}

fn holds_for_all<M: Jointed>(machine: &Machine<M>, set: u16) {
    for cells in [64, 150] {
        holds::<Spline<f32>>(machine, set, cells, Scale::SI);
        holds::<Cubic<f32>>(machine, set, cells, Scale::SI);
        holds::<Quadratic<f32>>(machine, set, cells, Scale::SI);
        holds::<Spline<f64>>(machine, set, cells, Scale::SI);
        let [omega, alpha] = RANGE;
        let scale = Scale::covering(machine, omega, alpha, 1024).unwrap();
        holds::<Spline<Q31>>(machine, set, cells, scale);
        holds::<Spline16>(machine, set, cells, scale);
        holds::<Cubic<Q31>>(machine, set, cells, scale);
        holds::<Quadratic<Q31>>(machine, set, cells, scale);
        let scale = Scale::limited_to(machine, omega, alpha, 1024).unwrap();
        holds::<Rows16>(machine, set, cells, scale);
    }
}

#[test]
fn a_search_finds_no_more_than_is_proven() {
    holds_for_all(&press(), EVERY);
    holds_for_all(&four_bar(), curves::LOAD | curves::VISCOUS);
    holds_for_all(&yoke(), curves::COULOMB);
}

#[test]
fn a_wrong_word_is_found_in_any_cell() {
    let machine = four_bar();
    let enclosed = EnclosedMachine::new(&machine);
    let set = curves::LOAD | curves::VISCOUS;
    let curves = |stretch| enclosed.curves(stretch);
    let sound: TestTable<Cubic<f32>> = made(&machine, set, 48, Scale::SI);
    let bound = proof(&machine, &sound, RANGE, &curves).unwrap().bound;
    for (word, by) in [
        (0, 1e-4),
        (48 * 12 - 1, 0.01),
        (24 * 12 + 4, 1e-3),
        (31 * 12 + 1, -1e-3),
    ] {
        let mut wrong: TestTable<Cubic<f32>> = made(&machine, set, 48, Scale::SI);
        wrong.words[word] += by;
        // The wrong word raises the bound.
        let found = proof(&machine, &wrong, RANGE, &curves).unwrap();
        assert!(found.bound > 1.5 * bound, "{word}: {found:?} {bound}");
        let cell = word / 12;
        let at = found.worst / std::f64::consts::TAU * 48.0;
        assert!((at - cell as f64 - 0.5).abs() < 0.51, "{word}: {found:?}");
        assert!(searched(&machine, &wrong, RANGE) <= found.bound + 1e-11);
    }
}

/// A force that acts over 0.0004 of a cell, which the machine does not report as an edge: no sampled position shows it.
#[test]
fn a_peak_between_the_places_is_proven_and_not_estimated() {
    let cells = 32;
    let spacing = std::f64::consts::TAU / f64::from(cells * 64);
    let from = 200.3 * spacing;
    let window = Window::new(
        Domain::Turn,
        [from, from + 0.0201 * spacing],
        0.01 * spacing,
    )
    .unwrap();
    let peak = Load::new(FourBar::ROCKER, Action::Moment(5.0))
        .unwrap()
        .within(window);
    let machine = four_bar().with_load(peak).unwrap();
    let silent = Silent(&machine);
    let set = curves::LOAD | curves::VISCOUS;
    let made: TestTable<Spline<f32>> = made(&silent, set, cells, Scale::SI);
    let table = Table::new(&made.words, made.shape).unwrap();
    let request = Request::new(1.0)
        .with_max_speed(RANGE[0])
        .with_max_acceleration(RANGE[1]);
    let estimated = measure(&silent, &table, &request).unwrap();
    let enclosed = EnclosedMachine::new(&machine);
    let proof = proof(&silent, &made, RANGE, &|stretch| enclosed.curves(stretch)).unwrap();
    let phi = from + 0.01 * spacing;
    let exact = machine.reduction(phi).unwrap();
    let before = four_bar().reduction(phi).unwrap();
    let height = (exact.load_torque() - before.load_torque()).abs();
    assert!(
        height > 0.1 && estimated.bound < 0.1 * height,
        "{height} {estimated:?}"
    );
    assert!(
        proof.bound >= height - estimated.bound,
        "{height} {proof:?}"
    );
    assert!((proof.worst - phi).abs() < spacing, "{phi} {proof:?}");
}

/// The polynomials of a cell are the values that the table reads, to the rounding of its arithmetic.
#[test]
fn a_cell_is_what_the_table_reads() {
    fn compare<F: Format>(units: f64, scale: Scale) {
        let machine = press();
        let made: TestTable<F> = made(&machine, EVERY, 40, scale);
        let table = Table::new(&made.words, made.shape).unwrap();
        for k in 0..4001_u32 {
            let phase = jred::Phase::from_bits(k.wrapping_mul(0x9e37_79b9));
            let [a, b] = [
                table.si(phase, Domain::Turn),
                read(&table, phase, 40, Domain::Turn),
            ];
            let [torque, speed, inertia] =
                [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
            for (a, b, base) in [
                (a.inertia, b.inertia, inertia),
                (a.inertia_slope, b.inertia_slope, 40.0 * inertia),
                (a.load, b.load, torque),
                (a.viscous, b.viscous, torque / speed),
                (a.coulomb, b.coulomb, torque),
            ] {
                assert!((a - b).abs() <= units * base, "{} {k}: {a} {b}", F::NAME);
            }
        }
    }
    let machine = press();
    let scale = Scale::covering(&machine, 12.0, 60.0, 1024).unwrap();
    compare::<Spline<f64>>(1e-12, Scale::SI);
    compare::<Spline<f32>>(1e-4, Scale::SI);
    compare::<Cubic<f32>>(1e-4, Scale::SI);
    compare::<Quadratic<f32>>(1e-4, Scale::SI);
    // For 40 cells, the bases are up to twice as large.
    compare::<Spline<Q31>>(1e-7, scale);
    compare::<Spline16>(1e-7, scale);
    compare::<Cubic<Q31>>(1e-7, scale);
    compare::<Quadratic<Q31>>(1e-4, scale);
    compare::<Rows16>(2e-2, Scale::limited_to(&machine, 12.0, 60.0, 1024).unwrap());
}

#[test]
fn what_cannot_be_enclosed_is_named() {
    let links = [Link::rotor(0.1).unwrap(), Link::point_mass(2.0).unwrap()];
    let rack = jred::mechanism::RackAndPinion::new(0.03, links).unwrap();
    let open = Closure::new(&rack, 2, 3, 0.1).err();
    assert_eq!(open, Some(ProofError::Joint { number: 2 }));
    let press = press();
    let missing = Closure::new(press.mechanism(), 3, 3, 0.1).err();
    let expected = ProofError::Freedoms {
        equations: 7,
        coordinates: 9,
    };
    assert_eq!(missing, Some(expected));
    // A stretch of a whole turn has no pose.
    let all = Closure::new(press.mechanism(), 3, 4, 0.1)
        .unwrap()
        .places([0.0, 6.0]);
    assert_eq!(all.err(), Some(ProofError::Pose { phi: 3.0 }));
}

/// A proof that is stopped, or that would take too long, proves nothing.
#[test]
fn a_proof_can_be_stopped() {
    let machine = four_bar();
    let enclosed = EnclosedMachine::new(&machine);
    let made: TestTable<Spline<f32>> =
        made(&machine, curves::LOAD | curves::VISCOUS, 24, Scale::SI);
    let table = Table::new(&made.words, made.shape).unwrap();
    let goal = jred_enclosure::Goal {
        start: 0.0,
        span: std::f64::consts::TAU,
        edges: &[],
        turns: true,
        omega: 1.0,
        alpha: 1.0,
        known: 0.0,
        negligible: 1e-9,
    };
    let mut seen = Vec::new();
    let stopped = jred_enclosure::prove(
        &table,
        &goal,
        &|stretch| enclosed.curves(stretch),
        &mut |share| {
            seen.push(share);
            share < 0.5
        },
    );
    assert_eq!(stopped, Err(ProofError::Stopped));
    assert!(seen.len() > 10 && seen.is_sorted() && seen.last().is_some_and(|share| *share < 0.6));
}
