//! Newton's method for the unknowns of a mesh: least cost in a given time.
//!
//! Minimise Σ weight·[c(τ)/√w + m·max(τ, 0)·s′] subject to Σ weight/√w = 1 (w in units of 1/T²). Each step solves the bordered system of the
//! Lagrangian. Then all w are scaled to meet the time exactly, and the step is halved until the cost falls.

use super::cost::Cost;
use super::mesh::Mesh;
use crate::collocation::pieces::{Value, dot, hermite};
use crate::collocation::torque::Torque;
use crate::path_dynamics::{PathDynamics, Place};
use jred::error::Error;

/// Most steps of Newton's method.
const STEPS: u32 = 200;

/// Most halvings of a step.
const HALVINGS: u32 = 40;

/// Smallest promised saving of a step, as a share of the cost.
const PROMISE: f64 = 1e-14;

/// A step that lowers the cost by less than this share gains nothing; the search ends after several in a row.
const IDLE: f64 = 1e-12;
const MOST_IDLE: u32 = 3;

/// The problem.
#[derive(Clone, Copy, Debug)]
pub(super) struct Problem<'a> {
    pub(super) dynamics: &'a PathDynamics<'a>,
    pub(super) mesh: &'a Mesh,
    /// Duration of the move (s).
    pub(super) duration: f64,
    /// Unit of the torque (N·m).
    pub(super) unit: f64,
    pub(super) cost: Cost,
    /// Load (N·m) over which bends of the torque are rounded.
    pub(super) range: f64,
    /// Length of the path, and its start and signed distance.
    pub(super) length: f64,
    pub(super) course: [f64; 2],
}

/// A minimum.
#[derive(Clone, Debug)]
pub(super) struct Minimum {
    pub(super) x: Vec<f64>,
    pub(super) cost: f64,
    /// Marginal cost of a unit of time: the Lagrange multiplier.
    pub(super) multiplier: f64,
    /// Whether Newton's method converged.
    pub(super) converged: bool,
}

/// Gradients of cost and time.
struct Gradients {
    cost: Vec<f64>,
    time: Vec<f64>,
}

impl Problem<'_> {
    /// The machine at a share of the path.
    pub(super) fn place(&self, share: f64) -> Result<Place, Error> {
        let [start, distance] = self.course;
        self.dynamics.place(start + distance * share)
    }

    /// The minimum, from unknowns that need not meet the time.
    pub(super) fn minimise(&self, start: &[f64]) -> Option<Minimum> {
        let mut x = self.in_time(start.to_vec())?;
        let mut cost = self.value(&x)?;
        let mut multiplier = 0.0;
        let mut converged = false;
        let mut idle = 0;
        for _ in 0..STEPS {
            let gradients = self.gradients(&x);
            multiplier = multiplier_of(&gradients, &x);
            let Some(step) = self.step(&x, &gradients, multiplier) else {
                break;
            };
            let promise =
                -inner(&gradients.cost, &step) - multiplier * inner(&gradients.time, &step);
            if promise.abs() <= PROMISE * cost.abs() || cost == 0.0 {
                converged = true;
                break;
            }
            let mut share = 1.0;
            let mut better = None;
            for _ in 0..HALVINGS {
                let moved = x.iter().zip(&step).map(|(x, d)| x + share * d).collect();
                let moved = self.in_time(moved);
                let value = moved.as_ref().and_then(|moved| self.value(moved));
                if let (Some(moved), Some(value)) = (moved, value)
                    && value < cost - 1e-4 * share * promise.abs()
                {
                    better = Some((moved, value));
                    break;
                }
                share *= 0.5;
            }
            let Some((moved, value)) = better else {
                // Only rounding is left.
                converged = promise.abs() <= 1e-9 * cost.abs();
                break;
            };
            let gained = cost - value;
            (x, cost) = (moved, value);
            idle = if gained <= IDLE * cost.abs() {
                idle + 1
            } else {
                0
            };
            if idle == MOST_IDLE {
                converged = promise.abs() <= 1e-9 * cost.abs();
                break;
            }
        }
        Some(Minimum {
            x,
            cost,
            multiplier,
            converged,
        })
    }

    /// Newton's step. The matrix is stiffened until it is positive in every direction that keeps the time.
    fn step(&self, x: &[f64], gradients: &Gradients, multiplier: f64) -> Option<Vec<f64>> {
        let n = self.mesh.unknowns;
        let mut matrix = self.mesh.matrix();
        let mut stiffness = 1e-13;
        // A negative multiplier makes the Lagrangian concave. Without its part the rest is convex, except for friction and losses.
        let mut share = 1.0;
        loop {
            matrix.clear();
            self.curvature(x, share * multiplier, &mut |i, j, value| {
                matrix.add(i, j, value);
            });
            let diagonal: Vec<f64> = matrix.diagonal().collect();
            for (i, entry) in diagonal.iter().enumerate().take(n) {
                matrix.add(i, i, stiffness * (entry.abs() + f64::MIN_POSITIVE));
            }
            for (i, slope) in gradients.time.iter().enumerate() {
                matrix.add(n, i, *slope);
            }
            let mut right: Vec<f64> = gradients
                .cost
                .iter()
                .zip(&gradients.time)
                .map(|(c, t)| -c - multiplier * t)
                .collect();
            right.push(0.0);
            if let Some((factors, negative)) = matrix.clone().factor()
                && negative == 1
            {
                factors.solve(&mut right);
                if right.iter().all(|d| d.is_finite()) {
                    right.pop();
                    return Some(right);
                }
            }
            if multiplier < 0.0 && share > 0.0 {
                share = if share > 0.1 { 0.5 * share } else { 0.0 };
                continue;
            }
            stiffness = (stiffness * 10.0).max(1e-6);
            if stiffness > 1e12 {
                return None;
            }
        }
    }

    /// The unknowns scaled to the time 1; `None` if w is not positive everywhere.
    fn in_time(&self, mut x: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..60 {
            let time = self.time(&x)?;
            if (time - 1.0).abs() < 1e-15 {
                break;
            }
            // Exact unless end speeds are given.
            let scale = if self.is_free() {
                time * time
            } else {
                // Slope of the time when all unknowns are scaled.
                let free = inner(&self.gradients(&x).time, &x);
                (1.0 + (1.0 - time) / free).clamp(0.25, 4.0)
            };
            for value in &mut x {
                *value *= scale;
            }
            if self.is_free() {
                break;
            }
        }
        self.time(&x)?;
        Some(x)
    }

    fn is_free(&self) -> bool {
        let fixed = |value: &Value| matches!(value, Value::Fixed(value) if *value != 0.0);
        !self
            .mesh
            .elements
            .iter()
            .any(|e| e.values.iter().any(fixed))
    }

    /// Σ weight/√w; `None` if w is not positive everywhere.
    pub(super) fn time(&self, x: &[f64]) -> Option<f64> {
        if !self.mesh.moves(x) {
            return None;
        }
        let mut time = 0.0;
        for station in &self.mesh.stations {
            let [w, _] = self.mesh.pace(x, station);
            if w.is_nan() || w <= 0.0 {
                return None;
            }
            time += station.weight / w.sqrt();
        }
        Some(time)
    }

    /// The torque at a station, in N·m, with speed and acceleration (per s, s²).
    pub(super) fn torque(&self, x: &[f64], station: usize) -> ([f64; 2], Torque) {
        let station = &self.mesh.stations[station];
        let state = station.state(self.mesh.pace(x, station), self.duration);
        (
            state,
            Torque::rounded(self.dynamics, &station.place, state, self.range),
        )
    }

    /// The largest torque (N·m) at the stations.
    pub(super) fn peak(&self, x: &[f64]) -> f64 {
        let torques =
            (0..self.mesh.stations.len()).map(|index| self.torque(x, index).1.value.abs());
        torques.fold(0.0, f64::max)
    }

    /// Σ weight·cost
    pub(super) fn value(&self, x: &[f64]) -> Option<f64> {
        let mut cost = 0.0;
        for (index, station) in self.mesh.stations.iter().enumerate() {
            let [w, _] = self.mesh.pace(x, station);
            let (_, torque) = self.torque(x, index);
            let torque = torque.value / self.unit;
            let [c, ..] = self.cost.torque(torque);
            let [m, ..] = self.cost.drawn(torque);
            cost += station.weight * (c / w.sqrt() + self.cost.drawn * m * station.path[0]);
        }
        cost.is_finite().then_some(cost)
    }

    fn gradients(&self, x: &[f64]) -> Gradients {
        let n = self.mesh.unknowns;
        let mut gradients = Gradients {
            cost: vec![0.0; n],
            time: vec![0.0; n],
        };
        for index in 0..self.mesh.stations.len() {
            let local = self.local(x, index);
            let station = &self.mesh.stations[index];
            let values = &self.mesh.elements[station.element].values;
            for (k, value) in values.iter().enumerate() {
                if let Value::Free(i) = value {
                    let by = [0, 1].map(|z| station.basis[z][k]);
                    gradients.cost[*i] += local.slope[0] * by[0] + local.slope[1] * by[1];
                    gradients.time[*i] += local.time[0] * by[0];
                }
            }
        }
        gradients
    }

    /// Second derivatives of the Lagrangian.
    fn curvature(&self, x: &[f64], multiplier: f64, add: &mut impl FnMut(usize, usize, f64)) {
        for index in 0..self.mesh.stations.len() {
            let local = self.local(x, index);
            let station = &self.mesh.stations[index];
            let [[mut a, b], [_, c]] = local.bend;
            a += multiplier * local.time[1];
            let values = &self.mesh.elements[station.element].values;
            for (k, row) in values.iter().enumerate() {
                for (l, column) in values.iter().enumerate() {
                    let (Value::Free(i), Value::Free(j)) = (row, column) else {
                        continue;
                    };
                    // Both orders of a pair of values occur; together they are one entry of the lower half.
                    if i < j {
                        continue;
                    }
                    let [p, q] = [k, l].map(|k| [station.basis[0][k], station.basis[1][k]]);
                    let entry = a * p[0] * q[0] + b * (p[0] * q[1] + p[1] * q[0]) + c * p[1] * q[1];
                    add(*i, *j, entry);
                }
            }
        }
    }

    /// Derivatives of the Lagrangian at a station by w and by w′, per u.
    pub(super) fn pull(&self, x: &[f64], index: usize, multiplier: f64) -> [f64; 2] {
        let local = self.local(x, index);
        let weight = self.mesh.stations[index].weight;
        let [by_w, by_change] = local.slope;
        [
            (by_w + multiplier * local.time[0]) / weight,
            by_change / weight,
        ]
    }

    /// Cost of a station and its derivatives by w and w′, weight included.
    fn local(&self, x: &[f64], index: usize) -> Local {
        let station = &self.mesh.stations[index];
        let [w, _] = self.mesh.pace(x, station);
        let (_, torque) = self.torque(x, index);
        let place = &station.place;
        let t2 = self.duration * self.duration;
        let [slope, bend] = station.path;
        let root = w.sqrt();
        let speed_by_root = slope / self.duration;
        let rate =
            self.dynamics.actuator.coefficients.0[3] * self.dynamics.file.drive_train.ratio().abs();
        // Derivatives by the load R, the acceleration, and the speed directly.
        let load_w = 0.5 * place.inertia_slope * speed_by_root * speed_by_root
            + place.viscous * speed_by_root / (2.0 * root);
        let [acc_w, acc_c] = [bend / t2, 0.5 * slope / t2];
        let friction = torque.by_load * place.viscous + rate;
        let by = [
            torque.by_load * load_w
                + rate * speed_by_root / (2.0 * root)
                + torque.by_acceleration * acc_w,
            torque.by_acceleration * acc_c,
        ]
        .map(|slope| slope / self.unit);
        let across = [load_w + torque.lean * acc_w, torque.lean * acc_c];
        let bent = torque.bend / self.unit;
        let own = -0.25 * friction * speed_by_root / (w * root) / self.unit;
        let second = [
            [
                bent * across[0] * across[0] + own,
                bent * across[0] * across[1],
            ],
            [0.0, bent * across[1] * across[1]],
        ];
        let value = torque.value / self.unit;
        let [c, c1, c2] = self.cost.torque(value);
        let [_, m1, m2] = self.cost.drawn(value);
        let dynamics = self.cost.drawn * slope;
        let [f1, f2] = [c1 / root + m1 * dynamics, c2 / root + m2 * dynamics];
        let [q1, q2] = [-0.5 / (w * root), 0.75 / (w * w * root)];
        let weight = station.weight;
        Local {
            slope: [f1 * by[0] + c * q1, f1 * by[1]].map(|s| weight * s),
            time: [q1, q2].map(|s| weight * s),
            bend: [
                [
                    f2 * by[0] * by[0] + f1 * second[0][0] + 2.0 * c1 * by[0] * q1 + c * q2,
                    f2 * by[0] * by[1] + f1 * second[0][1] + c1 * by[1] * q1,
                ],
                [0.0, f2 * by[1] * by[1] + f1 * second[1][1]],
            ]
            .map(|row| row.map(|s| weight * s)),
        }
    }
}

/// Derivatives at one station: cost by w and w′; time by w, first and second; second derivatives of the cost (upper half).
struct Local {
    slope: [f64; 2],
    time: [f64; 2],
    bend: [[f64; 2]; 2],
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The multiplier that balances cost and time when all unknowns are scaled.
fn multiplier_of(gradients: &Gradients, x: &[f64]) -> f64 {
    let time = inner(&gradients.time, x);
    -inner(&gradients.cost, x) / time
}

/// w at a value of u.
pub(super) fn pace_at(mesh: &Mesh, x: &[f64], element: usize, u: f64) -> [f64; 3] {
    let [from, to] = mesh.elements[element].span;
    let values = mesh.values(x, element);
    let h = to - from;
    hermite((u - from) / h, h).map(|basis| dot(&basis, &values))
}
