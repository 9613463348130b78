//! Friction by a coefficient in guides and pins: closed forms, limits, and a constrained multibody system of its own.

use crate::support::machines::{Spec, spec};
use crate::support::{assert_near, config, forces, link_of, samples, spoken};
use jred::Domain;
use jred::machine::{
    Action, Joint, JointFriction, Jointed, Link, Load, Machine, Marker, Mechanism, PoseError,
    Reducible,
};
use jred::mechanism::linkage::{Assembly, Linkage, Pair, Pose};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use proptest::prelude::*;

/// Joints of a slider-crank.
const BEARING: usize = 0;
const CRANK_PIN: usize = 1;
const WRIST_PIN: usize = 2;
const GUIDE: usize = 3;

/// Of closed forms: the masses of their links are this small (kg).
const LIGHT: f64 = 1e-12;

/// Of a closed form with light links.
const CLOSED: f64 = 1e-11;

fn light_crank(crank: f64, rod: f64, force: f64) -> Machine<SliderCrank> {
    let dimensions = SliderCrankDimensions {
        crank,
        rod,
        offset: 0.0,
    };
    let links = [Link::point_mass(LIGHT).unwrap(); 3];
    let mechanism = SliderCrank::new(dimensions, Branch::Right, links).unwrap();
    let load = Load::new(SliderCrank::SLIDER, Action::Force([force, 0.0])).unwrap();
    Machine::new(mechanism).with_load(load).unwrap()
}

fn guide(coefficient: f64) -> JointFriction {
    JointFriction::guide(GUIDE, coefficient, None).unwrap()
}

/// F = P/(1 ∓ μ·tan β): the crosshead presses on its guide with F·tan β, upper sign where the load resists.
#[test]
fn crosshead_in_closed_form() {
    let (r, l, load, mu) = (0.06f64, 0.2f64, -900.0f64, 0.15);
    let machine = light_crank(r, l, load).with_friction(guide(mu)).unwrap();
    for k in 1..48 {
        let phi = 0.13 * f64::from(k);
        for omega in [1.0, -1.0] {
            let beta = (r / l * phi.sin()).asin();
            let slope = -r * (phi + beta).sin() / beta.cos();
            let speed = slope * omega;
            let resists = if load * speed < 0.0 { 1.0 } else { -1.0 };
            let force = load.abs() / (1.0 - resists * mu * beta.tan().abs());
            let expected = force * -load.signum() * slope;
            let found = machine.torque(phi, omega, 0.0).unwrap().total();
            assert_near("T", found, expected, CLOSED * r * load.abs());
            forces::dalembert(&machine, phi, omega, 0.0);
        }
    }
}

/// The force in a rod between two frictional pins touches both friction circles: sin δ = μ·(±r_A ± r_B)/l.
#[test]
fn rod_with_friction_circles() {
    let (r, l, load, mu) = (0.06f64, 0.2f64, 900.0f64, 0.2);
    let radii = [0.025, 0.02, 0.012];
    let mut machine = light_crank(r, l, -load);
    for (joint, radius) in [BEARING, CRANK_PIN, WRIST_PIN].into_iter().zip(radii) {
        let friction = JointFriction::pin(joint, mu, radius).unwrap();
        machine = machine.with_friction(friction).unwrap();
    }
    for k in 0..48 {
        let phi = 0.05 + 0.13 * f64::from(k);
        for omega in [1.0, -1.0] {
            let beta = (r / l * phi.sin()).asin();
            let turn = -r / l * phi.cos() / beta.cos();
            let at = |rate: f64| rate.signum() * f64::signum(omega);
            let [o, a, b] = radii.map(|radius| mu * radius);
            let gamma = beta + ((at(turn - 1.0) * a + at(turn) * b) / l).asin();
            let force = load / gamma.cos();
            let own = omega * force * o - at(turn - 1.0) * force * a;
            let expected = -r * force * (phi + gamma).sin() + own;
            let found = machine.torque(phi, omega, 0.0).unwrap().total();
            assert_near("T", found, expected, CLOSED * r * load);
            forces::balance(&machine, phi, omega, 0.0);
        }
    }
}

/// A driven pendulum: T = J·α + m·g·a·sin φ + μ·r·m·|a_c − g|.
#[test]
fn pendulum_on_a_plain_bearing() {
    let (mass, inertia, arm, mu, radius) = (3.0, 0.2, 0.4f64, 0.12, 0.03);
    let links = [link_of(mass, inertia, [arm, 0.0])];
    let bearing = Joint::Revolute([Marker::ground([0.0; 2]), Marker::on(0, [0.0; 2])]);
    let linkage = Linkage::<1, 1>::new(&links, &[Pair::Joint(bearing)], 0).unwrap();
    let drawing = [[0.0; 3]].map(|[x, y, psi]| Pose { x, y, psi });
    let assembly: Assembly<1, 1, 64> = linkage.assemble(Domain::Turn, 0.0, &drawing).unwrap();
    let machine = Machine::new(assembly)
        .with_gravity([0.0, -9.81])
        .and_then(|m| m.with_friction(JointFriction::pin(0, mu, radius)?.with_preload(40.0)?))
        .unwrap();
    for (phi, omega, alpha) in [
        (0.3, 4.0, 20.0),
        (2.0, -6.0, -90.0),
        (4.0, 0.5, 0.0),
        (5.5, 9.0, 3.0),
    ] {
        let (sin, cos) = f64::sin_cos(phi);
        let x = mass * arm * (-sin * alpha - cos * omega * omega);
        let y = mass * (arm * (cos * alpha - sin * omega * omega) + 9.81);
        let friction = f64::signum(omega) * mu * radius * (x.hypot(y) + 40.0);
        let expected = (inertia + mass * arm * arm) * alpha + mass * 9.81 * arm * cos + friction;
        let found = machine.torque(phi, omega, alpha).unwrap();
        assert_near("T", found.total(), expected, 1e-12 * expected.abs());
        assert_near("friction", found.coulomb, friction, 1e-12 * friction.abs());
        // At rest it has no direction.
        assert_near(
            "at rest",
            machine.torque(phi, 0.0, alpha).unwrap().coulomb,
            0.0,
            0.0,
        );
        // The derivative that the simulation uses.
        let state = machine.friction_at(phi, omega, omega).unwrap();
        let per = |h: f64| state.torque(alpha + h).unwrap()[0];
        let slope = state.torque(alpha).unwrap()[1];
        assert_near("dT/dα", slope, (per(1e-4) - per(-1e-4)) / 2e-4, 1e-8);
    }
}

/// A carriage driven along an incline: F = m·(a + g·sin θ) + μ·m·g·cos θ; with its centre of mass beside the guide, the moment presses on
/// bearings at the distance l: |N₁| + |N₂| = max(m·g·cos θ, 2·|M|/l).
#[test]
fn carriage_on_an_incline() {
    let (mass, tilt, mu, height, length) = (25.0, 0.4f64, 0.1, 0.3, 0.2);
    let machine = |length: Option<f64>| {
        let links = [link_of(mass, 1.0, [0.0, height])];
        let rail = Marker::ground([0.0; 2]).with_angle(tilt);
        let joint = Joint::Prismatic([rail, Marker::on(0, [0.0; 2])]);
        let linkage = Linkage::<1, 1>::new(&links, &[Pair::Joint(joint)], 0).unwrap();
        let drawing = [Pose {
            x: 0.0,
            y: 0.0,
            psi: tilt,
        }];
        let domain = Domain::Stroke { from: 0.0, to: 1.0 };
        let assembly: Assembly<1, 1, 64> = linkage.assemble(domain, 0.0, &drawing).unwrap();
        Machine::new(assembly)
            .with_gravity([0.0, -9.81])
            .and_then(|m| m.with_friction(JointFriction::guide(0, mu, length)?))
            .unwrap()
    };
    let (down, along) = (mass * 9.81 * tilt.cos(), mass * 9.81 * tilt.sin());
    for (speed, alpha) in [(0.5, 0.0), (0.5, 12.0), (-0.2, 3.0), (-0.2, -40.0)] {
        let moment = height * (mass * alpha + along);
        let pads = down.max(2.0 * f64::abs(moment) / length);
        for (length, normal) in [(None, down), (Some(length), pads)] {
            let found = machine(length).torque(0.3, speed, alpha).unwrap().total();
            let expected = mass * alpha + along + f64::signum(speed) * mu * normal;
            assert_near("F", found, expected, 1e-12 * expected.abs());
        }
    }
}

/// At μ·tan β = 1 the crosshead locks: below it moves with a finite torque, above the position is refused with its place and joint.
#[test]
fn a_steep_rod_jams_in_its_guide() {
    let (r, l, load, mu) = (0.09f64, 0.1f64, 100.0, 0.8);
    let machine = light_crank(r, l, -load).with_friction(guide(mu)).unwrap();
    let at = |share: f64| (l / r * (share / mu).atan().sin()).asin();
    // Backwards the load resists.
    let (near, locks) = (at(0.98), at(1.0));
    let beta = f64::atan(0.98 / mu);
    let expected = -load / (1.0 - 0.98) * r * (near + beta).sin() / beta.cos();
    let found = machine.torque(near, -1.0, 0.0).unwrap().total();
    assert_near("T", found, expected, 1e-9 * expected.abs());
    let error = machine.torque(locks + 1e-6, 1.0, 0.0).unwrap_err();
    let spoken = spoken(error);
    assert!(spoken.contains("jams"), "{spoken}");
    assert!(
        spoken.contains("joint 3") && spoken.contains("lower its coefficient"),
        "{spoken}"
    );
    assert!(machine.forces(locks + 1e-6, 1.0, 0.0).is_err());
    // It makes no difference to a machine at rest.
    assert!(machine.forces(locks + 1e-6, 0.0, 0.0).is_ok());
}

#[test]
fn no_table_holds_it_and_no_other_joint() {
    let machine = light_crank(0.05, 0.2, 0.0)
        .with_friction(guide(0.1))
        .unwrap();
    let error = machine.reduction(0.5).unwrap_err();
    assert!(
        matches!(error, PoseError::NoCurve { joint: GUIDE }),
        "{error}"
    );
    assert!(machine.clone().without_frictions().reduction(0.5).is_ok());
    let pin = JointFriction::pin(GUIDE, 0.1, 0.01).unwrap();
    assert!(machine.clone().with_friction(pin).is_err());
    let guide = JointFriction::guide(CRANK_PIN, 0.1, None).unwrap();
    assert!(machine.with_friction(guide).is_err());
    assert!(JointFriction::pin(0, -0.1, 0.01).is_err());
    assert!(JointFriction::pin(0, 0.1, 0.0).is_err());
    assert!(JointFriction::guide(0, 0.1, Some(0.0)).is_err());
    assert!(JointFriction::guide(0, f64::NAN, None).is_err());
}

/// Friction in all joints, from light to heavy.
fn frictions() -> impl Strategy<Value = [f64; 6]> {
    [0.0..0.2, 0.0..0.2, 0.0..0.2, 0.0..0.2, 0.05..0.4, 0.5..4.0]
}

/// The pins' radii are shares of the crank, the guide's length one of the rod's.
fn with_frictions<M: Jointed + Clone>(
    machine: Machine<M>,
    crank: f64,
    [bearing, first, second, guide, radius, length]: [f64; 6],
) -> Machine<M> {
    let pins = [(BEARING, bearing), (CRANK_PIN, first), (WRIST_PIN, second)];
    let mut machine = machine;
    for (joint, mu) in pins {
        let friction = JointFriction::pin(joint, mu, radius * crank).unwrap();
        machine = machine.with_friction(friction).unwrap();
    }
    let friction = JointFriction::guide(GUIDE, guide, Some(length * crank)).unwrap();
    machine.with_friction(friction).unwrap()
}

proptest! {
    #![proptest_config(config(200, 0x0f71))]

    /// The reduced equation with the power of the friction, and every link in equilibrium under it.
    #[test]
    fn friction_is_in_equilibrium(
        spec in spec(),
        frictions in frictions(),
        phi in 0.0..6.3,
        omega in -40.0..40.0,
        alpha in -500.0..500.0,
    ) {
        let machine = with_frictions(spec.machine(), spec.crank, frictions);
        if machine.friction_at(phi, omega, omega).is_ok() {
            forces::dalembert(&machine, phi, omega, alpha);
            forces::balance(&machine, phi, omega, alpha);
            let state = machine.friction_at(phi, omega, omega).unwrap();
            prop_assert!(state.torque(alpha).unwrap()[0] * omega >= 0.0);
        }
    }

    /// For small coefficients the friction is that of the forces without friction, to the second order.
    #[test]
    fn little_friction_is_linear(
        spec in spec(),
        phi in 0.0..6.3,
        omega in -40.0..40.0,
        alpha in -500.0..500.0,
    ) {
        let mu = 1e-6;
        let bare = spec.machine();
        let all = [mu, mu, mu, mu, 0.2, 2.0];
        let machine = with_frictions(bare.clone(), spec.crank, all);
        let frames = bare.mechanism().frames(phi).unwrap();
        let joints = bare.mechanism().joints(phi, &frames).unwrap();
        let forces = bare.forces(phi, omega, alpha).unwrap();
        let mut linear = 0.0;
        for (joint, reaction) in joints.iter().zip(&forces.reactions) {
            let slope = joint.coordinate(&frames).d1.abs();
            let [x, y] = reaction.force;
            let normal = if let Joint::Prismatic(_) = joint {
                y.abs().max(reaction.moment.abs() / spec.crank)
            } else {
                0.2 * spec.crank * x.hypot(y)
            };
            linear += mu * normal * slope;
        }
        let [found, _] = machine.friction_at(phi, omega, omega).unwrap().torque(alpha).unwrap();
        assert_near("T_f", found * omega.signum(), linear, 1e-4 * linear);
    }
}

/// Bodies, coordinates and constraints of a slider-crank as a plain multibody system.
struct Multibody {
    spec: Spec,
    /// μ·r of the pins at O, A, B; μ and half the length of the guide.
    pins: [f64; 3],
    guide: [f64; 2],
}

/// x, y, θ of the three centres of mass.
type Coordinates = [f64; 9];

impl Multibody {
    /// The bodies' points that the constraints join, from the centres of mass.
    fn points(&self) -> [[[f64; 2]; 2]; 2] {
        let s = &self.spec;
        let [u1, v1, u2, v2] = s.com.map(|share| share * s.crank);
        [
            [[-u1, -v1], [s.crank - u1, -v1]],
            [[-u2, -v2], [s.rod() - u2, -v2]],
        ]
    }

    /// The rows of the constraints and of their second derivatives: O, A, B (two each), y and θ of the slider.
    fn constraints(&self, q: &Coordinates, v: &Coordinates) -> ([[f64; 9]; 8], [f64; 8]) {
        let mut rows = [[0.0; 9]; 8];
        let mut right = [0.0; 8];
        let [[o, a1], [a2, b]] = self.points();
        let mut pin = |row: usize, ends: [(usize, [f64; 2], f64); 2]| {
            for (body, [u, w], sign) in ends {
                let (sin, cos) = q[3 * body + 2].sin_cos();
                let arm = [u * cos - w * sin, u * sin + w * cos];
                let rate = v[3 * body + 2];
                for axis in 0..2 {
                    rows[row + axis][3 * body + axis] += sign;
                    right[row + axis] += sign * arm[axis] * rate * rate;
                }
                rows[row][3 * body + 2] -= sign * arm[1];
                rows[row + 1][3 * body + 2] += sign * arm[0];
            }
        };
        pin(0, [(0, o, 1.0), (0, o, 0.0)]);
        pin(2, [(1, a2, 1.0), (0, a1, -1.0)]);
        pin(4, [(2, [0.0; 2], 1.0), (1, b, -1.0)]);
        rows[6][7] = 1.0;
        rows[7][8] = 1.0;
        (rows, right)
    }

    /// Accelerations under a torque of the drive, and the power of friction; multipliers and friction by iteration.
    fn accelerations(&self, q: &Coordinates, v: &Coordinates, torque: f64) -> (Coordinates, f64) {
        let s = &self.spec;
        let (r, l, [m1, m2, m3]) = (s.crank, s.rod(), s.mass);
        let flywheel = s.flywheel * m3 * r * r;
        // The slider turns with nothing: any inertia.
        let masses = [
            m1,
            m1,
            0.1 * m1 * r * r + flywheel,
            m2,
            m2,
            0.1 * m2 * l * l,
            m3,
            m3,
            1.0,
        ];
        let (rows, right) = self.constraints(q, v);
        let [gx, gy] = s.gravity();
        let mut given = [0.0; 9];
        for (k, m) in s.mass.into_iter().enumerate() {
            (given[3 * k], given[3 * k + 1]) = (m * gx, m * gy);
        }
        given[2] += torque - 0.01 * s.loads[1] * v[2].signum();
        given[5] -= s.loads[3] * v[5];
        given[6] += s.loads[0] - s.loads[2] * v[6];
        let rates = [v[2], v[5] - v[2], v[8] - v[5]];
        let (mut multipliers, mut found, mut power) = ([0.0f64; 8], [0.0; 9], 0.0);
        // Until it stands still: friction contracts it.
        for _ in 0..300 {
            let before = multipliers;
            let mut force = given;
            power = 0.0;
            for (k, rate) in rates.into_iter().enumerate() {
                let size = multipliers[2 * k].hypot(multipliers[2 * k + 1]);
                let moment = -self.pins[k] * size * rate.signum();
                force[3 * k + 2] += moment;
                if k > 0 {
                    force[3 * k - 1] -= moment;
                }
                power -= moment * rate;
            }
            let [mu, half] = self.guide;
            // The moment of pin B acts on the slider, too, and is in the multiplier of its angle.
            let pressing = multipliers[6].abs().max(multipliers[7].abs() / half);
            force[6] -= mu * pressing * v[6].signum();
            power += mu * pressing * v[6].abs();
            let mut matrix = vec![vec![0.0; 18]; 17];
            for k in 0..9 {
                matrix[k][k] = masses[k];
                matrix[k][17] = force[k];
            }
            for (c, row) in rows.iter().enumerate() {
                for k in 0..9 {
                    (matrix[9 + c][k], matrix[k][9 + c]) = (row[k], -row[k]);
                }
                matrix[9 + c][17] = right[c];
            }
            let solution = eliminate(matrix);
            found.copy_from_slice(&solution[..9]);
            multipliers.copy_from_slice(&solution[9..]);
            let size = multipliers.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            let all = multipliers.iter().zip(before);
            if all.fold(0.0f64, |most, (x, y)| most.max((x - y).abs())) <= 1e-13 * size {
                break;
            }
        }
        (found, power)
    }
}

/// Gauss-Jordan with row pivoting.
fn eliminate(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()));
        rows.swap(k, pivot.unwrap());
        let row = rows[k].clone();
        for (i, other) in rows.iter_mut().enumerate() {
            if i != k {
                let factor = other[k] / row[k];
                for (x, y) in other.iter_mut().zip(&row) {
                    *x -= factor * y;
                }
            }
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}

/// Coordinates and velocities of the bodies at a state of the drive link.
fn bodies(spec: &Spec, phi: f64, omega: f64) -> [Coordinates; 2] {
    let mechanism = spec.mechanism();
    let frames = mechanism.frames(phi).unwrap();
    let mut state = [[0.0; 9]; 2];
    for (k, (link, frame)) in mechanism.links().iter().zip(&frames).enumerate() {
        let [x, y] = frame.point(link.com());
        for (axis, c) in [x, y, frame.psi].into_iter().enumerate() {
            (state[0][3 * k + axis], state[1][3 * k + axis]) = (c.value, c.velocity(omega));
        }
    }
    state
}

/// The acceleration that a torque gives by the reduced equation, by bisection.
fn forward<M: Jointed>(machine: &Machine<M>, phi: f64, omega: f64, torque: f64) -> f64 {
    let [mut low, mut high] = [-1e7, 1e7];
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if machine.torque(phi, omega, middle).unwrap().total() < torque {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Any torque gives the acceleration of the multibody system, and the same power of friction.
#[test]
fn multibody_system_accelerates_alike() {
    let cases = (spec(), frictions(), 0.0..6.3, 2.0f64..40.0, -60.0..60.0f64);
    let mut compared = 0;
    for (spec, frictions, phi, speed, torque) in samples(60, 0x0f72, &cases) {
        let omega = speed.copysign(torque);
        let machine = with_frictions(spec.machine(), spec.crank, frictions);
        let inertia = machine.bare_reduction(phi).unwrap().inertia;
        let Ok(state) = machine.friction_at(phi, omega, omega) else {
            continue;
        };
        if state.check(inertia).is_err() {
            continue;
        }
        compared += 1;
        let [bearing, first, second, mu, radius, length] = frictions;
        let system = Multibody {
            pins: [bearing, first, second].map(|mu| mu * radius * spec.crank),
            guide: [mu, 0.5 * length * spec.crank],
            spec: spec.clone(),
        };
        let [q, v] = bodies(&spec, phi, omega);
        let (found, power) = system.accelerations(&q, &v, torque);
        let alpha = forward(&machine, phi, omega, torque);
        let scale = found[2].abs().max(omega * omega);
        assert_near("α", alpha, found[2], 1e-8 * scale);
        let loss = state.torque(alpha).unwrap()[0] * omega;
        assert_near("power", loss, power, 1e-7 * power.abs().max(1e-9));
    }
    // The others jam, or might.
    assert!(compared > 40, "{compared}");
}

/// A run of both systems under a constant torque: the same angle, and energy that balances with the work of friction.
#[test]
fn both_run_alike_and_balance_their_energy() {
    let spec = Spec {
        crank: 0.06,
        rod_ratio: 3.0,
        offset_ratio: 0.15,
        left: false,
        mass: [1.2, 0.8, 3.0],
        com: [0.3, 0.1, 1.1, 0.05],
        down: 1.0,
        loads: [-40.0, 3.0, 2.0, 0.002],
        flywheel: 1.0,
    };
    let frictions = [0.1, 0.08, 0.12, 0.15, 0.2, 1.5];
    let machine = with_frictions(spec.machine(), spec.crank, frictions);
    let [bearing, first, second, mu, radius, length] = frictions;
    let system = Multibody {
        pins: [bearing, first, second].map(|mu| mu * radius * spec.crank),
        guide: [mu, 0.5 * length * spec.crank],
        spec: spec.clone(),
    };
    let (start, omega, torque, h, steps) = (0.4, 12.0, 4.0, 2.5e-4, 1200);
    let [mut q, mut v] = bodies(&spec, start, omega);
    let mut state = [start, omega, 0.0];
    let reduced = |[phi, omega, _]: [f64; 3]| {
        let alpha = forward(&machine, phi, omega, torque);
        let friction = machine.friction_at(phi, omega, omega).unwrap();
        let other = machine.bare_reduction(phi).unwrap();
        let loads = other.reduced_torque(omega) + other.potential_slope;
        let power = torque + loads - friction.torque(alpha).unwrap()[0];
        [omega, alpha, power * omega]
    };
    let energy = |[phi, omega, _]: [f64; 3]| {
        let point = machine.bare_reduction(phi).unwrap();
        0.5 * point.inertia * omega * omega + point.potential_energy
    };
    let before = energy(state);
    for _ in 0..steps {
        let move_by = |d: [f64; 3], h: f64| [0, 1, 2].map(|k| state[k] + h * d[k]);
        let a = reduced(state);
        let b = reduced(move_by(a, h / 2.0));
        let c = reduced(move_by(b, h / 2.0));
        let d = reduced(move_by(c, h));
        state = [0, 1, 2].map(|k| state[k] + h / 6.0 * (a[k] + 2.0 * (b[k] + c[k]) + d[k]));
        let by = |x: &Coordinates, d: &Coordinates, h: f64| {
            let mut moved = *x;
            moved.iter_mut().zip(d).for_each(|(x, d)| *x += h * d);
            moved
        };
        let accelerate = |q: &Coordinates, v: &Coordinates| system.accelerations(q, v, torque).0;
        let k1 = (v, accelerate(&q, &v));
        let v2 = by(&v, &k1.1, h / 2.0);
        let k2 = (v2, accelerate(&by(&q, &k1.0, h / 2.0), &v2));
        let v3 = by(&v, &k2.1, h / 2.0);
        let k3 = (v3, accelerate(&by(&q, &k2.0, h / 2.0), &v3));
        let v4 = by(&v, &k3.1, h);
        let k4 = (v4, accelerate(&by(&q, &k3.0, h), &v4));
        for k in 0..9 {
            q[k] += h / 6.0 * (k1.0[k] + 2.0 * (k2.0[k] + k3.0[k]) + k4.0[k]);
            v[k] += h / 6.0 * (k1.1[k] + 2.0 * (k2.1[k] + k3.1[k]) + k4.1[k]);
        }
    }
    // Both meet the bends of friction at other places within their steps.
    let turned = state[0] - start;
    assert!(turned > 3.0, "{turned}");
    assert_near("φ", state[0], q[2], 2e-6 * turned);
    assert_near("ω", state[1], v[2], 2e-5 * state[1]);
    let gained = energy(state) - before;
    assert_near("energy", state[2], gained, 1e-6 * (torque * turned));
}
