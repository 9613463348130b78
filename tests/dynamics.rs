//! The equation of motion: both directions, its energy, its power, and a sliding drive link.

use jred::mechanism::TrainOutput;
use std::f64::consts::TAU;

use crate::support::machines::{Spec, spec};
use crate::support::rows::Rows;
use crate::support::{assert_near, budget, config, derivative, largest, rk4};
use jred::machine::{Machine, Mechanism, Reducible, Reduction};
use jred::mechanism::{Mesh, SliderCrank, Stage, Train};
use jred::table::{Format, Table};
use jred::{Cubic, CurveSet, Domain, Phase, Quadratic, Scale, Spline, curves};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config(64, 0x0003))]

    /// The same without a table; Coulomb friction changes sign with ω and is zero at rest.
    #[test]
    fn exact_reduction_both_ways(spec in spec(), phi in -7.0..7.0, omega in -60f64..60.0, alpha in -900.0..900.0) {
        let reduced = spec.machine().reduction(phi).unwrap();
        for omega in [omega, -omega, 0.0] {
            let terms = reduced.torque(omega, alpha);
            let size = largest(terms.values());
            let back = reduced.acceleration(omega, terms.total());
            let rounding = budget::TICK_ROUNDINGS * f64::EPSILON * size / reduced.inertia;
            assert_near("alpha", back, alpha, rounding);
            let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
            assert_near("coulomb", terms.coulomb, reduced.coulomb * sign, 0.0);
            let resisting = reduced.load_torque() - reduced.viscous * omega - reduced.coulomb * sign;
            assert_near("T_red", reduced.reduced_torque(omega), resisting, f64::EPSILON * size);
        }
    }

    /// T·ω = d/dt(½·J·ω² + U) − process·ω + b·ω² + c·|ω| along a random motion.
    #[test]
    fn power_balance(
        spec in spec(), phi0 in 0.0..6.2, w in -30f64..30.0, a in 0.1f64..1.0, nu in 5f64..40.0, t in 0.0..1.0,
    ) {
        let machine = spec.machine();
        let phi = |t: f64| phi0 + w * t + a * (nu * t).sin();
        let omega = |t: f64| w + a * nu * (nu * t).cos();
        let energy = |t: f64| {
            let reduced = machine.reduction(phi(t)).unwrap();
            0.5 * reduced.inertia * omega(t).powi(2) + reduced.potential_energy
        };
        let reduced = machine.reduction(phi(t)).unwrap();
        let (omega, alpha) = (omega(t), -a * nu * nu * (nu * t).sin());
        let terms = reduced.torque(omega, alpha);
        let lost = reduced.viscous * omega * omega + reduced.coulomb * omega.abs();
        let expected = derivative(energy, t, 1e-3) - reduced.process * omega + lost;
        let size = largest(terms.values()) * (w.abs() + a * nu) + largest(reduced.inertias()) * (w.abs() + a * nu).powi(3);
        assert_near("power", terms.total() * omega, expected, budget::POWER * size);
        assert!(lost >= 0.0);
    }

    /// The power into a lossy train is its output, the power stored in its wheels, and the loss it reports; never less.
    #[test]
    fn train_balances_its_power(
        i in [1.2f64..8.0, 1.2f64..8.0], j in [0.0..0.1, 0.0..0.1, 0.0..0.1, 0.0..0.1], eta in [0.6..1.0, 0.6..1.0],
        internal: bool, torque in -50f64..50.0, load_inertia in 0.0..2.0, omega in -20.0..20.0, alpha in -90.0..90.0,
    ) {
        let sign = if internal { 1.0 } else { -1.0 };
        let stages = [
            Stage::new(sign * i[0], [j[0], j[1]]).and_then(|s| s.with_efficiency(eta[0])).unwrap(),
            Stage::new(-i[1], [j[2], j[3]]).and_then(|s| s.with_efficiency(eta[1])).unwrap(),
        ];
        let train = Train::new(&stages).unwrap();
        let at = |alpha: f64| train.input(&TrainOutput { torque: torque + load_inertia * alpha, torque_per_alpha: load_inertia, omega, alpha, direction: omega });
        let input = at(alpha);
        let ratio = train.ratio();
        let (omega_in, alpha_in) = (omega * ratio, alpha * ratio);
        let stored = train.inertia_at_input() * alpha_in * omega_in;
        let balance = (torque + load_inertia * alpha) * omega + stored + input.loss;
        let size = 1.0 + balance.abs() + stored.abs() + input.loss;
        assert_near("power", input.torque * omega_in, balance, budget::CLOSED_FORM * size);
        assert!(input.loss >= 0.0, "{input:?}");
        // Without loss the first law is (6.9); with loss, the slope is valid where no stage reverses its power.
        let [before, after] = [at(alpha - 1e-3), at(alpha + 1e-3)];
        if (before.torque_per_alpha - after.torque_per_alpha).abs() == 0.0 {
            let slope = (after.torque - before.torque) / 2e-3;
            let size = slope.abs() + input.torque.abs() / 1e-3;
            assert_near("dT/dα", input.torque_per_alpha, slope, budget::CLOSED_FORM * size);
        }
        assert_near("i", ratio, train.stages().iter().map(Stage::ratio).product(), 0.0);
        assert_near("η", train.efficiency(), eta[0] * eta[1], f64::EPSILON);
        prop_assert!(Mesh::default() == Mesh::External);
    }
}

/// At rest, and where the direction of the start is undetermined, the drive supplies the losses: T/(i·η), and so for every further torque of an
/// acceleration.
#[test]
fn a_train_without_a_direction_drives() {
    let stages = [(-4.0, 0.9), (-2.5, 0.8)]
        .map(|(i, eta)| Stage::new(i, [0.0; 2]).and_then(|s| s.with_efficiency(eta)));
    let train = Train::new(&stages.map(Result::unwrap)).unwrap();
    for (torque, direction) in [
        (12.0, 0.0),
        (-12.0, 0.0),
        (0.0, 1.0),
        (0.0, -1.0),
        (12.0, 1.0),
        (-12.0, -1.0),
    ] {
        let input = train.input(&TrainOutput {
            torque,
            torque_per_alpha: 0.3,
            direction,
            ..TrainOutput::default()
        });
        let share = 1.0 / (10.0 * 0.72);
        assert_near("T", input.torque, torque * share, budget::CLOSED_FORM);
        // The inertia of the load is divided by the ratio once more.
        assert_near(
            "dT/dα",
            input.torque_per_alpha,
            0.3 * share,
            budget::CLOSED_FORM,
        );
    }
    // Braked by the losses: T·η/i.
    for direction in [1.0, -1.0] {
        let output = TrainOutput {
            torque: -12.0 * direction,
            direction,
            ..TrainOutput::default()
        };
        assert_near(
            "T",
            train.input(&output).torque,
            -1.2 * 0.72 * direction,
            budget::CLOSED_FORM,
        );
    }
}

const CELLS: u32 = 32;

/// Largest share by which ½·J·ω² + U of the table changes over four turns without drive torque, with `per_cell` Runge-Kutta steps per cell. dω/dφ =
/// α/ω over steps of a power of two of a turn: phases are exact.
fn energy_drift<L: Format<Number = f64>>(
    table: &Table<'_, L>,
    omega: f64,
    per_cell: u32,
    acceleration: impl Fn(Phase, f64) -> f64,
) -> f64 {
    let steps = CELLS * per_cell;
    let width = TAU / f64::from(steps);
    let phase =
        |places: f64| Phase::from_bits((places * 4_294_967_296.0 / f64::from(steps)) as u64 as u32);
    let (mut speed, mut potential) = (omega, 0.0);
    let energy = |places, speed: f64, potential| {
        0.5 * table.at(phase(places)).inertia * speed * speed + potential
    };
    let start = energy(0.0, speed, 0.0);
    let mut drift = 0.0;
    for step in 0..4 * steps {
        let x = f64::from(step);
        speed = rk4(|x, w| acceleration(phase(x), w) / w * width, x, speed, 1.0);
        // Simpson's rule is exact for the cubic.
        let load = |x| table.at(phase(x)).load;
        potential -= width / 6.0 * (load(x) + 4.0 * load(x + 0.5) + load(x + 1.0));
        drift = largest([drift, (energy(x + 1.0, speed, potential) - start) / start]);
    }
    drift
}

fn drifts<const CURVES: CurveSet, L: Format<Number = f64>>(machine: &impl Reducible, omega: f64) {
    let rows = Rows::<L>::of(machine, CURVES, CELLS, &Scale::SI).unwrap();
    let model = rows.model::<CURVES>(&Scale::SI);
    let forward = |phase, w| model.acceleration(phase, w, 0.0).value;
    let at = |per_cell| energy_drift(model.table(), omega, per_cell, forward);
    let [coarse, fine] = [at(8), at(16)];
    println!("energy drift {coarse:.2e}, {fine:.2e}, {:.2e}", at(32));
    assert_near("order 4", coarse / fine, 16.0, 16.0 * budget::ORDER_SHARE);
    assert_near("energy", at(32), 0.0, budget::ENERGY);

    // The same machine with J′ from the secants of its own J, which does not match the J of the energy.
    let inconsistent = |phase: Phase, w: f64| {
        let cell = phase.cell(CELLS).0;
        let knot = |k: u32| {
            model
                .table()
                .at(Phase::from_bits((1 << 27) * (k % CELLS)))
                .inertia
        };
        let secant = (knot(cell + 1) - knot(cell)) * f64::from(CELLS) / TAU;
        let read = model.table().at(phase);
        (read.load - 0.5 * secant * w * w) / read.inertia
    };
    let [coarse, fine] = [2, 32].map(|n| energy_drift(model.table(), omega, n, inconsistent));
    println!("energy drift with a linear table's slope {coarse:.2e}, {fine:.2e}");
    assert!(
        fine > budget::INCONSISTENT_ENERGY,
        "an inconsistent J' must show: {fine:e}"
    );
}

fn press() -> Spec {
    Spec {
        crank: 0.08,
        rod_ratio: 2.5,
        offset_ratio: 0.2,
        left: false,
        mass: [1.0, 0.8, 2.0],
        com: [0.3, 0.1, 1.0, 0.05],
        down: 0.3,
        loads: [0.0; 4],
        flywheel: 0.6,
    }
}

#[test]
fn energy_is_conserved_through_the_table() {
    drifts::<{ curves::INERTIA }, Spline<f64>>(&press().bare(), 10.0);
    drifts::<{ curves::INERTIA }, Cubic<f64>>(&press().bare(), 10.0);
    drifts::<{ curves::INERTIA }, Quadratic<f64>>(&press().bare(), 10.0);
}

#[test]
fn energy_is_conserved_through_the_table_with_gravity() {
    drifts::<{ curves::LOAD }, Spline<f64>>(&press().heavy(), 60.0);
    drifts::<{ curves::LOAD }, Cubic<f64>>(&press().heavy(), 60.0);
    drifts::<{ curves::LOAD }, Quadratic<f64>>(&press().heavy(), 60.0);
}

/// A slider-crank reduced to the displacement of its slider, over a stroke between its dead centres: (7.10).
struct AtTheSlider {
    machine: Machine<SliderCrank>,
    phi: [f64; 2],
}

impl AtTheSlider {
    fn slider(&self, phi: f64) -> jred::number::Transfer {
        self.machine.mechanism().frames(phi).unwrap()[SliderCrank::SLIDER].x
    }

    /// φ for a position of the slider, by bisection: x falls monotonically between the dead centres.
    fn phi(&self, place: f64) -> f64 {
        let [mut low, mut high] = self.phi;
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.slider(middle).value > place {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

impl Reducible for AtTheSlider {
    fn domain(&self) -> Domain {
        let [far, near] = self.phi.map(|phi| self.slider(phi).value);
        Domain::stroke(near, far).unwrap()
    }

    fn reduction(&self, place: f64) -> Result<Reduction, jred::machine::PoseError> {
        let phi = self.phi(place);
        let (x, by_phi) = (self.slider(phi), self.machine.reduction(phi)?);
        let [j, j1, _] = by_phi.inertias();
        Ok(Reduction::new([
            j / (x.d1 * x.d1),
            (j1 - 2.0 * j * x.d2 / x.d1) / x.d1.powi(3),
            f64::NAN,
        ])
        .with_potential_energy([by_phi.potential_energy, by_phi.potential_slope / x.d1])
        .with_process(by_phi.process / x.d1)
        .with_viscous(by_phi.viscous / (x.d1 * x.d1))
        .with_coulomb(by_phi.coulomb / x.d1.abs()))
    }
}

#[test]
fn sliding_drive_link_is_the_same_machine() {
    let spec = Spec {
        loads: [150.0, 40.0, 12.0, 0.01],
        ..press()
    };
    let sliding = AtTheSlider {
        machine: spec.machine(),
        phi: [0.6, 2.4],
    };
    let domain = sliding.domain();
    let rows = Rows::<Spline<f64>>::of(&sliding, curves::ALL, 128, &Scale::SI).unwrap();
    let model = rows.model::<{ curves::ALL }>(&Scale::SI);
    let mut worst = 0.0;
    for k in 0..200 {
        let phi = 0.62 + 1.76 * f64::from(k) / 199.0;
        let x = sliding.slider(phi);
        for (omega, alpha) in [(12.0, 80.0), (-12.0, 80.0), (0.0, -50.0)] {
            let terms = spec.machine().reduction(phi).unwrap().torque(omega, alpha);
            let (speed, acceleration) = (x.velocity(omega), x.acceleration(omega, alpha));
            let phase = domain.phase(x.value);
            let force = model.torque(phase, speed, acceleration);
            // T·ω = F·v, and at rest by virtual work: T = F·x′.
            let size = largest(terms.values());
            worst = largest([worst, (force * x.d1 - terms.total()) / size]);
            assert_near(
                "T = F·x'",
                force * x.d1,
                terms.total(),
                budget::STROKE_TABLE * size,
            );
            let back = model.acceleration(phase, speed, terms.total() / x.d1).value;
            let found = (back - x.d2 * omega * omega) / x.d1;
            let inertia = terms.acceleration / alpha;
            assert_near("α", found, alpha, budget::STROKE_TABLE * size / inertia);
        }
    }
    println!("sliding drive link: {worst:.1e} of the largest term");
}

/// A reduction assembled by hand: every part in its place, and the drive torque from them.
#[test]
fn a_reduction_is_what_it_is_made_of() {
    let made = Reduction::new([2.0, 0.5, -0.1])
        .with_potential_energy([7.0, 3.0])
        .with_process(11.0)
        .with_viscous(0.25)
        .with_coulomb(1.5);
    let near = |what: &str, found: f64, expected: f64| assert_near(what, found, expected, 0.0);
    for (found, expected) in made.inertias().into_iter().zip([2.0, 0.5, -0.1]) {
        near("J", found, expected);
    }
    near("U", made.potential_energy, 7.0);
    near("U′", made.potential_slope, 3.0);
    near("load", made.load_torque(), 8.0);
    let terms = made.torque(-2.0, 10.0);
    // J·α + ½·J′·ω² + U′ − process + b·ω + c·sgn ω
    let parts = [20.0, 1.0, 3.0, -11.0, -0.5, -1.5];
    for (found, expected) in terms.values().into_iter().zip(parts) {
        near("term", found, expected);
    }
    near("T", terms.total(), parts.iter().sum());
    assert_near("α", made.acceleration(-2.0, terms.total()), 10.0, 1e-15);
}
