//! A turn in pieces: curves with jumps.

use jred::mechanism::SliderCrankDimensions;
use std::f64::consts::TAU;

use crate::support::rows::Rows;
use crate::support::{assert_near, budget, largest, link_of, quantity, value};
use jred::machine::motion::Law;
use jred::machine::{Machine, Reducible, Reduction};
use jred::mechanism::cam::{Program, Segment};
use jred::mechanism::{Branch, DiscCam, Follower, Roller, RollerDimensions, SliderCrank};
use jred::number::Number;
use jred::table::{Format, words_len};
use jred::tabulate::{Part, Request, scratch_len, tabulate};
use jred::{Cubic, CurveSet, Domain, Phase, Pieces, Q31, Quadratic, Scale, Spline, curves};

const SET: CurveSet = curves::LOAD;
/// Speed and acceleration for comparing tables.
const AT: [f64; 2] = [20.0, 300.0];

/// A press whose load is switched on and off without a ramp (N·m, from, to).
struct Switched<M>(M, f64, [f64; 2]);

impl<M: Reducible> Reducible for Switched<M> {
    fn domain(&self) -> Domain {
        self.0.domain()
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        let mut reduction = self.0.reduction(phi)?;
        let [on, off] = self.2;
        if (phi - on).rem_euclid(TAU) < off - on {
            reduction.process -= self.1;
        }
        Ok(reduction)
    }
}

fn press() -> Machine<SliderCrank> {
    let links = [(0.8, 0.0006), (0.45, 0.0021), (3.0, 0.0)]
        .map(|(mass, inertia)| link_of(mass, inertia, [0.0, 0.0]));
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.05,
            rod: 0.2,
            offset: 0.0,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    let machine = Machine::new(mechanism).with_gravity([-9.81, 0.0]).unwrap();
    machine.with_flywheel(0.004).unwrap()
}

/// N·m, for a peak torque of similar size.
const JUMP: f64 = 6.0;

fn switched(on: f64, off: f64) -> Switched<Machine<SliderCrank>> {
    Switched(press(), JUMP, [on, off])
}

/// A cam whose follower's acceleration jumps in the middle of rise and return, where it moves fastest: J has kinks, J′ jumps.
fn cam() -> (Machine<DiscCam>, Vec<f64>) {
    let law = Law::Trapezoid {
        accelerate: 0.5,
        decelerate: 0.5,
    };
    let degrees = |d: f64| d.to_radians();
    let program = Program::new(&[
        Segment::law(law, degrees(130.0), 0.012),
        Segment::dwell(degrees(40.0)),
        Segment::law(law, degrees(140.0), -0.012),
        Segment::dwell(degrees(50.0)),
    ])
    .unwrap();
    let mut breaks: Vec<f64> = program.pieces().map(|piece| piece.from).collect();
    breaks.sort_by(f64::total_cmp);
    let roller = Roller::new(RollerDimensions {
        radius: 0.01,
        mass: 0.15,
        inertia: 8e-6,
    })
    .unwrap();
    let follower = Follower::TranslatingRoller {
        offset: 0.0,
        roller,
    };
    let cam = DiscCam::new(program, 0.06, follower, crate::support::cams::links()).unwrap();
    (
        Machine::new(cam).with_gravity([0.0, -9.81]).unwrap(),
        breaks,
    )
}

/// Torque of the machine at a phase, at plus and minus [`AT`].
fn exact(machine: &impl Reducible, phase: Phase, sign: f64) -> f64 {
    let reduction = machine.reduction(phase.radians()).unwrap();
    reduction.torque(sign * AT[0], sign * AT[1]).total()
}

/// Positions on a grid that no number of cells divides.
fn places(count: u32) -> impl Iterator<Item = Phase> {
    (0..count).map(|k| Phase::from_bits(k.wrapping_mul(0x9e37_79b9)))
}

#[test]
fn one_table_cannot_follow_a_jump() {
    // Thirds of a turn are one or two thirds of a cell past a knot, for any power of two.
    let machine = switched(TAU / 3.0, TAU / 1.5);
    let mut means = Vec::new();
    for cells in [64, 128, 256, 512] {
        let rows = Rows::<Cubic<f64>>::of(&machine, SET, cells, &Scale::SI).unwrap();
        let model = rows.model::<SET>(&Scale::SI);
        let error = |phase| (model.torque(phase, 0.0, 0.0) - exact_at_rest(&machine, phase)).abs();
        let most = largest(places(1 << 18).map(error));
        let mean = places(1 << 18).map(error).sum::<f64>() / f64::from(1 << 18);
        println!("{cells} cells: largest {most:.2}, mean {mean:.2e} N m");
        // A continuous curve has an error of half the jump on one side, and an interpolating one at most the jump.
        let [low, high] = budget::JUMP_LEFT;
        assert!(most >= low * JUMP && most <= high * JUMP, "{most}");
        means.push(mean);
    }
    for pair in means.windows(2) {
        let ratio = pair[0] / pair[1];
        assert_near("order 1", ratio, 2.0, budget::ORDER_SHARE * 2.0);
    }
}

fn exact_at_rest(machine: &impl Reducible, phase: Phase) -> f64 {
    -machine.reduction(phase.radians()).unwrap().load_torque()
}

/// Tables of all pieces between the breaks for an error, in N·m.
fn pieces_of<F: Format>(
    machine: &impl Reducible,
    breaks: &[f64],
    torque_error: f64,
) -> Vec<Rows<F>> {
    const MOST: u32 = 512;
    let request = Request::new(torque_error)
        .with_max_speed(AT[0])
        .with_max_acceleration(AT[1])
        .with_max_cells(MOST);
    let ends = breaks.iter().skip(1).copied().chain([breaks[0] + TAU]);
    let pieces = breaks.iter().zip(ends).map(|(from, to)| {
        let part = Part::new(machine, *from, to).unwrap();
        let mut scratch = vec![0.0; scratch_len(MOST, SET)];
        let mut words = vec![F::Word::default(); words_len::<F>(MOST, SET)];
        let found =
            tabulate::<F>(&part, SET, &request, &Scale::SI, &mut scratch, &mut words).unwrap();
        assert!(found.torque_error <= torque_error);
        println!(
            "{from:.3} to {to:.3}: {} cells, {:.1e} N m",
            found.cells, found.torque_error
        );
        Rows::<F>::of(&part, SET, found.cells, &Scale::SI).unwrap()
    });
    pieces.collect()
}

/// Phases on both sides of every break, far enough away for their roundings not to matter.
fn beside(breaks: &[f64]) -> Vec<Phase> {
    let sides = [-4i32, 4].map(|step| step as u32);
    let both = breaks
        .iter()
        .flat_map(|at| sides.map(|step| Phase::from_radians(*at) + Phase::from_bits(step)));
    both.collect()
}

/// The requested error is reached at all positions, including those next to the breaks.
fn reaches<F: Format, const N: usize>(machine: &impl Reducible, breaks: [f64; N], share: f64) {
    let size = largest(places(3600).map(|phase| exact(machine, phase, 1.0)));
    let asked = share * size;
    let rows = pieces_of::<F>(machine, &breaks, asked);
    let models: Vec<_> = rows.iter().map(|r| r.model::<SET>(&Scale::SI)).collect();
    let models = std::array::from_fn(|k| (Phase::from_radians(breaks[k]), models[k]));
    let turn: Pieces<'_, F, SET, N> = Pieces::new(Domain::Turn, models).unwrap();
    let mut most = 0.0f64;
    for phase in places(1 << 16).chain(beside(&breaks)) {
        for sign in [1.0, -1.0] {
            let (omega, alpha) = (quantity(sign * AT[0]), quantity(sign * AT[1]));
            let expected = exact(machine, phase, sign);
            let torque = turn.torque(phase, omega, alpha);
            most = most.max((value(torque) - expected).abs());
            // Both directions, and the range, are those of the model that gave the torque.
            let back = turn.acceleration(phase, omega, torque);
            let range = turn.acceleration_range(phase, omega, torque, torque);
            assert_near(
                "back",
                value(back.value),
                sign * AT[1],
                budget::PIECES_BACK * AT[1],
            );
            assert_eq!([range.least, range.greatest], [back, back]);
        }
    }
    println!(
        "{} {}: {most:.3e} of {asked:.3e} N m",
        <F::Number as Number>::NAME,
        F::NAME
    );
    let rounding = budget::PIECES_F32 * size;
    let grid = match F::NAME {
        "quadratic" => budget::PIECES_QUADRATIC,
        _ => budget::DENSE_GRID,
    };
    assert!(most <= grid * asked + rounding, "{most:e} > {asked:e}");
    assert!(
        most > 0.5 * asked,
        "{most:e}: the request is met by far, so this shows little"
    );
}

#[test]
fn pieces_reach_the_request_beside_a_jump() {
    let (on, off) = (TAU / 3.0, TAU / 3.0 + 1.0);
    let machine = switched(on, off);
    reaches::<Spline<f64>, 2>(&machine, [on, off], 1e-4);
    reaches::<Cubic<f64>, 2>(&machine, [on, off], 1e-6);
    reaches::<Quadratic<f64>, 2>(&machine, [on, off], 1e-3);
    reaches::<Cubic<f32>, 2>(&machine, [on, off], 1e-4);
    reaches::<Spline<f32>, 2>(&machine, [on, off], 1e-4);
    // One piece more than necessary, and one that continues past the end of the turn.
    reaches::<Spline<f64>, 5>(&machine, [0.5, 1.0, on, off, 5.0], 1e-4);
    let machine = switched(5.5, 5.5 + 1.5);
    reaches::<Spline<f64>, 2>(&machine, [5.5 + 1.5 - TAU, 5.5], 1e-4);
}

#[test]
fn one_piece_is_the_turn() {
    let machine = press();
    reaches::<Spline<f64>, 1>(&machine, [0.0], 1e-4);
    reaches::<Spline<f64>, 1>(&machine, [4.0], 1e-4);
}

#[test]
fn pieces_reach_the_request_beside_the_kinks_of_a_cam() {
    let (machine, breaks) = cam();
    println!("{breaks:?}");
    let breaks: [f64; 6] = breaks.try_into().unwrap();
    reaches::<Cubic<f64>, 6>(&machine, breaks, 1e-7);
    // A single table has an error of at least half the jump of ½·J′·ω².
    let jump = largest(breaks.map(|at| {
        let side = |d: f64| machine.reduction(at + d).unwrap().inertia_slope;
        0.5 * (side(1e-9) - side(-1e-9)) * AT[0] * AT[0]
    }));
    let size = largest(places(3600).map(|phase| exact(&machine, phase, 1.0)));
    assert!(jump > 0.01 * size, "{jump} of {size}");
    for cells in [128, 1024] {
        let rows = Rows::<Cubic<f64>>::of(&machine, SET, cells, &Scale::SI).unwrap();
        let model = rows.model::<SET>(&Scale::SI);
        let error = |phase| {
            model.torque(phase, AT[0], 0.0) - {
                let reduction = machine.reduction(phase.radians()).unwrap();
                reduction.torque(AT[0], 0.0).total()
            }
        };
        let most = largest(beside(&breaks).into_iter().map(error));
        println!("{cells} cells: {most:.3} of a jump of {jump:.3} N m");
        let [low, high] = budget::JUMP_LEFT;
        assert!(most >= low * jump && most <= high * jump, "{most}");
    }
}

/// In fixed point with cells of the same width, against the same in f64.
fn fixed_agrees<F: Format<Number = Q31>, E: Format<Number = f64>>() {
    // 24, 40 and 32 of 96 cells.
    let starts = [0.25, 0.5, 11.0 / 12.0];
    let cells = [24, 40, 32];
    let breaks = starts.map(|turns| turns * TAU);
    let machine = Switched(press(), JUMP, [breaks[0], breaks[1]]);
    let scale = Scale::covering(&machine, AT[0], AT[1], 720)
        .unwrap()
        .for_cells(96, TAU);
    let parts: [_; 3] = std::array::from_fn(|k| {
        let to = if k == 2 {
            breaks[0] + TAU
        } else {
            breaks[k + 1]
        };
        Part::new(&machine, breaks[k], to).unwrap()
    });
    let fixed: Vec<_> = (0..3)
        .map(|k| Rows::<F>::of(&parts[k], SET, cells[k], &scale).unwrap())
        .collect();
    let float: Vec<_> = (0..3)
        .map(|k| Rows::<E>::of(&parts[k], SET, cells[k], &scale).unwrap())
        .collect();
    let start = |k: usize| Phase::from_radians(breaks[k]);
    let fixed: Pieces<'_, F, SET, 3> = Pieces::new(
        Domain::Turn,
        std::array::from_fn(|k| (start(k), fixed[k].model(&scale))),
    )
    .unwrap();
    let float: Pieces<'_, E, SET, 3> = Pieces::new(
        Domain::Turn,
        std::array::from_fn(|k| (start(k), float[k].model(&scale))),
    )
    .unwrap();
    let mut most = 0.0f64;
    for phase in places(1 << 14).chain(beside(&breaks)) {
        for sign in [1.0, -1.0] {
            let omega = scale.omega((sign * AT[0]) as f32);
            let alpha = scale.alpha((sign * AT[1]) as f32);
            assert!(!omega.saturated && !alpha.saturated);
            let torque = fixed.torque(phase, omega.value, alpha.value);
            let expected = float.torque(phase, value(omega.value), value(alpha.value));
            most = most.max((value(torque) - expected).abs());
            let back = fixed.acceleration(phase, omega.value, torque);
            assert!(!back.saturated);
        }
    }
    println!("{}: {:.1} units of 2^-31", F::NAME, most / budget::Q31_UNIT);
    assert!(most <= budget::PIECES_Q31, "{most:e}");
}

#[test]
fn fixed_point_agrees_with_f64() {
    fixed_agrees::<Spline<Q31>, Spline<f64>>();
    fixed_agrees::<Cubic<Q31>, Cubic<f64>>();
}
