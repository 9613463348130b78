//! Time, heat and limits of a motion w(u), with first and second derivatives with respect to the values of each piece.
//!
//! ```text
//! v = L·g′·√w/t,   a = L·(g″·w + ½·g′·w′)/t²,   da/dt = L·√w·(g‴·w + 3/2·g″·w′ + ½·g′·w″)/t³
//! ```
//!
//! with t the unit of time. Limits of the squared speed and of the acceleration are linear in w and w′. So is the torque, except for viscous friction
//! (√w). The jerk is limited as |g‴·w + …| ≤ t³·j/(L·√w). Every limit is divided by itself: c ≤ 0, and c = −1 where the limited quantity is zero.

use super::effort::{Effort, StationState, mix};
use super::interior::Term;
use super::mesh::{Local, Mesh, Station, VALUES};
use super::rate::{Rate, smooth_slopes};
use crate::collocation::pieces::{Value, dot};
use crate::fastest::field::{Binding, Field};

/// Difference of speeds for the slope of a torque-speed curve, as a share of the mean speed.
const SPEED_DIFFERENCE: f64 = 1e-6;

/// Least share of w that a step leaves.
const LEAVES: f64 = 0.1;

/// Margins by which limits are lowered, as shares, so that they are satisfied between the stations too.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Margins {
    /// For speed, acceleration and torques.
    pub(super) state: f64,
    /// For the jerk.
    pub(super) jerk: f64,
    /// For the torque rate.
    pub(super) rate: f64,
}

/// The objective: `time` times the duration (s) plus `heat` times ∫T² dt (N²·m²·s). `time` may be negative: where the motor holds a weight, a slower
/// motion has less RMS torque as long as ∫T² grows less than in proportion to the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Price {
    /// Price of a second.
    pub time: f64,
    /// Price of (1 N·m)² for a second (1/(N²·m²)).
    pub heat: f64,
}

impl Price {
    /// The duration only.
    pub const TIME: Self = Self {
        time: 1.0,
        heat: 0.0,
    };
}

/// A programme on a mesh.
pub(super) struct MeshProblem<'a> {
    pub(super) field: &'a Field<'a, 'a>,
    pub(super) mesh: &'a Mesh,
    /// Unit of time (s).
    pub(super) unit: f64,
    /// Mean speed (rad/s, or m/s) in that time.
    pub(super) pace: f64,
    /// The objective.
    pub(super) price: Price,
    /// Range of the load (N·m) over which bends of the torque are rounded.
    pub(super) range: f64,
    /// Factor by which the limits of jerk and torque rate are eased; 1: unchanged.
    pub(super) ease: f64,
    /// The motor's torque limits as straight lines: braking, driving.
    pub(super) lines: [Option<Vec<[f64; 2]>>; 2],
    /// Margins of each piece.
    pub(super) margins: &'a [Margins],
}

const NONE: (f64, Local) = (0.0, [0.0; VALUES]);

impl MeshProblem<'_> {
    pub(super) fn state(&self, station: &Station, values: &Local) -> StationState {
        let [slope, bend, _] = station.path;
        let [own, change, _] = &station.basis;
        let t = self.unit;
        let w = dot(own, values);
        let by = mix((bend / (t * t), own), (0.5 * slope / (t * t), change));
        StationState {
            speed: slope / t * w.max(0.0).sqrt(),
            acceleration: dot(&by, values),
            w,
            pace: slope / t,
            by,
        }
    }

    /// Slope of the motor's torque by the speed, from friction of the motor itself.
    fn friction(&self) -> f64 {
        let dynamics = self.field.dynamics;
        dynamics.actuator.coefficients.0[3] * dynamics.file.drive_train.ratio().abs()
    }

    fn motor(&self, station: &Station, state: &StationState) -> Effort {
        let dynamics = self.field.dynamics;
        Effort::of(station, state, self.friction(), self.range, |place| {
            dynamics.demand(place, state.speed, state.acceleration)
        })
    }

    fn gearbox(&self, station: &Station, state: &StationState) -> Effort {
        let dynamics = self.field.dynamics;
        Effort::of(station, state, 0.0, self.range, |place| {
            dynamics.gearbox_demand(place, state.speed, state.acceleration)
        })
    }

    /// Limits of the braking and of the driving torque, which depend on the speed. Where the torque-speed curve is the lowest of several straight
    /// lines, each line is a separate limit, because the motion may stay at the speed where two lines meet.
    fn torque_limits(
        &self,
        station: &Station,
        state: &StationState,
        torque: &Effort,
        rows: &mut Vec<Term>,
    ) {
        let field = self.field;
        let margin = self.margins[station.element].state;
        let scale = field.motor_torques(0.0).map(f64::abs);
        let near = SPEED_DIFFERENCE * self.pace;
        for (k, sign) in [(0, -1.0), (1, 1.0)] {
            let limit = if k == 0 {
                Binding::Braking
            } else {
                Binding::Driving
            };
            let size = sign / scale[k];
            // A limit and its slope by the speed. The margin is a share of the torque at rest, as an excess is, because the limit itself may be zero.
            let mut row = |left: f64, slope: f64| {
                let by_w = -slope * state.pace / (2.0 * state.w.sqrt());
                let bend = 0.25 * slope * state.pace / (state.w * state.w.sqrt());
                rows.push(Term {
                    limit: Some(limit),
                    value: (torque.value - left) * size + margin,
                    gradient: mix((size, &torque.gradient), (size * by_w, &station.basis[0])),
                    bends: [
                        (size * (torque.bend + bend), station.basis[0]),
                        torque.turned(size),
                        NONE,
                        NONE,
                    ],
                    ..Term::straight(station.element, station.weight)
                });
            };
            if let Some(lines) = &self.lines[k] {
                for [torque, slope] in lines {
                    row(sign * (torque + slope * state.speed), sign * slope);
                }
                continue;
            }
            let [left, beside] =
                [state.speed, state.speed + near].map(|v| field.motor_torques(v)[k]);
            row(left, (beside - left) / near);
        }
    }

    /// Limits at a station.
    fn limits(
        &self,
        station: &Station,
        values: &Local,
        state: &StationState,
        torque: &Effort,
        rows: &mut Vec<Term>,
    ) {
        let field = self.field;
        let limits = &field.limits;
        let weight = station.weight;
        let straight = |limit: Binding, value: f64, gradient: Local| Term {
            limit: Some(limit),
            value,
            gradient,
            ..Term::straight(station.element, weight)
        };
        let margins = self.margins[station.element];
        let margin = 1.0 + margins.state;
        let (top, which) = field.top();
        if top.is_finite() {
            let factor = (margin * state.pace / top).powi(2);
            let by = station.basis[0].map(|basis| factor * basis);
            rows.push(straight(which, factor * state.w - 1.0, by));
        }
        if limits.tool.is_some() {
            let factor = (margin * state.pace / station.tool).powi(2);
            let by = station.basis[0].map(|basis| factor * basis);
            rows.push(straight(Binding::ToolSpeed, factor * state.w - 1.0, by));
        }
        self.torque_limits(station, state, torque, rows);
        if let Some(limit) = limits.gearbox_torque {
            let torque = self.gearbox(station, state);
            for sign in [1.0, -1.0] {
                let size = margin * sign / limit;
                rows.push(Term {
                    bends: [
                        (size * torque.bend, station.basis[0]),
                        torque.turned(size),
                        NONE,
                        NONE,
                    ],
                    ..straight(
                        Binding::GearboxTorque,
                        size * torque.value - 1.0,
                        torque.gradient.map(|g| size * g),
                    )
                });
            }
        }
        for (sign, limit, which) in [
            (1.0, limits.acceleration, Binding::Acceleration),
            (-1.0, limits.deceleration, Binding::Deceleration),
        ] {
            if let Some(limit) = limit {
                let size = margin * sign / limit;
                rows.push(straight(
                    which,
                    size * state.acceleration - 1.0,
                    state.by.map(|by| size * by),
                ));
            }
        }
        let rates = [
            (limits.jerk, Binding::Jerk, margins.jerk),
            (limits.torque_rate, Binding::TorqueRate, margins.rate),
        ];
        for (limit, which, margin) in rates {
            let Some(limit) = limit else { continue };
            let scale = (1.0 + margin) / (limit * self.ease * self.unit);
            let rate = if which == Binding::Jerk {
                Rate::of_acceleration(station, values, self.unit)
            } else {
                let dynamics = self.field.dynamics;
                let torque =
                    smooth_slopes(&station.place, state.acceleration, self.range, |place| {
                        dynamics.demand(place, state.speed, state.acceleration)
                    });
                Rate::of_torque(station, values, state, &torque, self.friction(), self.unit)
            };
            let own = &station.basis[0];
            let root = state.w.sqrt();
            let rise = 0.5 / (state.w * root);
            for sign in [1.0, -1.0] {
                let size = sign * scale;
                let [(more, one), (less, other)] = rate.turn;
                rows.push(Term {
                    bends: [
                        (size * rate.bend - 1.5 * rise / state.w, *own),
                        (size * more, one),
                        (size * less, other),
                        NONE,
                    ],
                    ..straight(
                        which,
                        size * rate.value - 1.0 / root,
                        mix((size, &rate.gradient), (rise, own)),
                    )
                });
            }
        }
    }

    /// Time and heat of a station.
    fn cost(&self, station: &Station, state: &StationState, torque: &Effort) -> Term {
        let w = state.w;
        let root = w.sqrt();
        let t = torque.value;
        let weight = station.weight;
        let Price { time, heat } = self.price;
        let whole = time + heat * t * t;
        let own = &station.basis[0];
        // The second derivatives of T²/√w are the square of one linear form and a multiple of the square of w's own form.
        let lean = mix((1.0, &torque.gradient), (-0.5 * t / w, own));
        let bend = (0.75 * time + 0.25 * heat * t * t) / (w * w * root)
            + 2.0 * heat * t * torque.bend / root;
        Term {
            value: weight * whole / root,
            gradient: mix(
                (weight * 2.0 * heat * t / root, &torque.gradient),
                (-0.5 * weight * whole / (w * root), own),
            ),
            bends: [
                (weight * 2.0 * heat / root, lean),
                (weight * bend.max(0.1 * time / (w * w * root)), *own),
                torque.turned(weight * 2.0 * heat * t / root),
                NONE,
            ],
            ..Term::straight(station.element, weight)
        }
    }
}

impl MeshProblem<'_> {
    /// Whether a motion satisfies the limits of jerk and torque rate.
    pub(super) fn keeps_rates(&self, x: &[f64]) -> bool {
        let is_kept = |row: &Term| {
            row.value <= 0.0 || !matches!(row.limit, Some(Binding::Jerk | Binding::TorqueRate))
        };
        self.at(x).is_some_and(|[_, rows]| rows.iter().all(is_kept))
    }

    /// The same with bends of the torque (if any) rounded over a share of the largest load of a motion.
    pub(super) fn ranged(self, x: &[f64], share: f64) -> Self {
        let load = |station: &Station| {
            let state = self.state(station, &self.mesh.values(x, station.element));
            let place = &station.place;
            let carried = 0.5 * place.inertia_slope * state.speed * state.speed;
            let resisting = carried + place.load + place.viscous * state.speed + place.coulomb;
            (place.inertia * state.acceleration + resisting).abs()
        };
        let range = if self.field.dynamics.bends() {
            share * self.mesh.stations.iter().map(load).fold(0.0, f64::max)
        } else {
            0.0
        };
        Self { range, ..self }
    }

    /// Cost of a motion.
    pub(super) fn whole_cost(&self, x: &[f64]) -> f64 {
        let costs = self.at(x).map(|[costs, _]| costs);
        costs.map_or(f64::INFINITY, |costs| {
            costs.iter().map(|cost| cost.value).sum()
        })
    }

    /// Terms of the objective, and limits, at a point; always the same number of each. `None` if w is not positive, so that there is no motion.
    pub(super) fn at(&self, x: &[f64]) -> Option<[Vec<Term>; 2]> {
        let stations = &self.mesh.stations;
        let mut costs = Vec::with_capacity(stations.len());
        let mut rows = Vec::with_capacity(stations.len() * 8);
        for (index, station) in stations.iter().enumerate() {
            let values = self.mesh.values(x, station.element);
            let state = self.state(station, &values);
            if !(state.w > 0.0 && state.w.is_finite()) {
                return None;
            }
            let torque = self.motor(station, &state);
            if !torque.value.is_finite() {
                return None;
            }
            costs.push(self.cost(station, &state, &torque));
            let first = rows.len();
            self.limits(station, &values, &state, &torque, &mut rows);
            for row in &mut rows[first..] {
                row.station = index;
            }
        }
        Some([costs, rows])
    }

    /// The largest share of a step after which w is still positive.
    pub(super) fn reach(&self, x: &[f64], step: &[f64]) -> f64 {
        let mut share = 1.0_f64;
        for station in &self.mesh.stations {
            let values = self.mesh.values(x, station.element);
            let steps = self.mesh.elements[station.element]
                .values
                .map(|value| match value {
                    Value::Free(index) => step[index],
                    Value::Fixed(_) => 0.0,
                });
            let [w, change] = [&values, &steps].map(|values| dot(&station.basis[0], values));
            if change < 0.0 {
                share = share.min((1.0 - LEAVES) * w / -change);
            }
        }
        share
    }
}
