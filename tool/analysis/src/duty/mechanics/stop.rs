//! The emergency stop: the torque through the gearbox while the motor brakes with its full torque.
//!
//! The motor brakes with T_S against the motion, friction of motor and gearbox with T_F. The motor side, J_1 = J_M + J_G at the motor shaft, takes a
//! part of that; the rest goes through the gearbox. J is the inertia at the gearbox output, d the torque with which the machine drives itself there
//! (weight, ½·J′·ω², process loads, less friction), a the deceleration, and τ the torque through the gearbox, where the power flows back to the
//! motor:
//!
//! ```text
//! machine   τ = J·a + d
//! motor     T_S + T_F = τ·η_back/i + J_1·i·a
//! so        τ = i·((T_S + T_F)·J + J_1·i·d)/(J_1·i² + η_back·J)
//! ```
//!
//! The position of the machine determines J and d. The worst of all positions of the motion is used, each at the motion's speed and at standstill.
//! Between those two speeds d is a convex or a falling function of the speed, so the ends are the worst. Losses of the drive train, which would help
//! to brake, are ignored, and so is friction by a coefficient in the joints.

use std::cmp::Ordering;

use crate::duty::{Instant, Panel, Smooth};

/// Relative difference of inertias that is rounding.
const SAME_INERTIA: f64 = 1e-12;

/// Share of the largest d by which the hull may cut off the curve between two of its states.
const CUT_OFF: f64 = 1e-8;

/// Most parts of the step between the instants next to a state on the hull.
const MOST_PARTS: f64 = 256.0;

/// States (J, d) from which a stop may begin: the upper hull of all, J rising. τ is a quotient of two linear functions of J and d that rises with d,
/// so its maximum lies on that hull, and along the hull it has no other local maximum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stop {
    hull: Vec<[f64; 2]>,
}

/// The motor's side of a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    /// Braking torque of motor and friction at the motor shaft (N·m).
    pub torque: f64,
    /// Inertia of rotor and gearbox at the motor shaft (kg·m²).
    pub inertia: f64,
    /// Ratio of the gearbox.
    pub ratio: f64,
    /// Factor of the torque that flows back through the gearbox.
    pub back_efficiency: f64,
}

impl Braking {
    /// Torque through the gearbox at its output (N·m). Without a back efficiency it is T·J/(J_1·i) + d. A negative one makes it infinite where
    /// J_1·i² + η_back·J ≤ 0: the gearbox locks itself, and rigid bodies then stop at once.
    pub fn torque_at(&self, [inertia, driving]: [f64; 2]) -> f64 {
        let own = self.inertia * self.ratio;
        let below = own * self.ratio + self.back_efficiency * inertia;
        if below > 0.0 {
            self.ratio * (self.torque * inertia + own * driving) / below
        } else {
            f64::INFINITY
        }
    }
}

/// Twice the area of the triangle, negative if the path over `b` turns to the right: `b` then lies above the line from `a` to `c`.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

impl Stop {
    /// The states of a motion whose drive train has this ratio (without sign).
    pub(super) fn of(instants: &[Instant], smooth: &Smooth, ratio: f64) -> Self {
        let states = |instant: &Instant| {
            let terms = &instant.terms;
            // In a stop the joints carry other forces, and so another friction.
            let coulomb = terms.coulomb - instant.joint_friction;
            let slow = terms.potential + terms.process + coulomb;
            let fast = slow + terms.velocity + terms.viscous;
            let driving = |torque: f64| -torque * instant.omega.signum() / ratio;
            [slow, fast].map(|torque| [instant.input_inertia, driving(torque)])
        };
        let moves = |k: &usize| instants[*k].omega != 0.0;
        let moving = || (0..instants.len()).filter(moves);
        let mut all = Self::among(moving().flat_map(|k| states(&instants[k])).collect());
        if !smooth.knows_peaks() {
            return all;
        }
        // Between the instants too, next to each state of the hull.
        let mut parts = all.parts();
        let mut taken = |state: [f64; 2]| {
            let place = all.hull.partition_point(|of_hull| of_hull[0] < state[0]);
            if all.hull.get(place) == Some(&state) {
                std::mem::replace(&mut parts[place], 1)
            } else {
                1
            }
        };
        let mut between = Vec::new();
        for k in moving() {
            let [slow, fast] = states(&instants[k]).map(&mut taken);
            let parts = slow.max(fast);
            if parts == 1 {
                continue;
            }
            for range in smooth.panels_beside(k, instants.len()) {
                let Some(panel) = Panel::of(range, |k| [instants[k].t, instants[k].weight]) else {
                    continue;
                };
                if !panel.indices().iter().all(moves) {
                    continue;
                }
                let [from, to] = panel.around(k, |k| instants[k].t);
                let curve = |speed: usize, figure: usize| {
                    panel.values(|k| states(&instants[k])[speed][figure])
                };
                let curves = [0, 1].map(|speed| [curve(speed, 0), curve(speed, 1)]);
                for part in 1..parts {
                    let x = from + (to - from) * f64::from(part) / f64::from(parts);
                    between.extend(curves.map(|[inertia, driving]| [inertia.at(x), driving.at(x)]));
                }
            }
        }
        between.append(&mut all.hull);
        Self::among(between)
    }

    /// Number of parts for the steps next to each state: the sagitta falls with the square.
    fn parts(&self) -> Vec<u32> {
        let largest = self.hull.iter().map(|state| state[1].abs());
        let allowed = CUT_OFF * largest.fold(0.0, f64::max);
        let sagittas = self.hull.windows(3).map(|three| match three {
            [a, b, c] => -turn(*a, *b, *c) / (c[0] - a[0]),
            _ => 0.0,
        });
        let mut sagittas: Vec<f64> = sagittas.collect();
        // The ends use their neighbours' values.
        let [first, last] = [sagittas.first(), sagittas.last()].map(Option::<&f64>::copied);
        sagittas.insert(0, first.unwrap_or(f64::INFINITY));
        sagittas.push(last.unwrap_or(f64::INFINITY));
        let parts = sagittas.iter().map(|sagitta| {
            if *sagitta > allowed {
                (sagitta / allowed).sqrt().ceil().min(MOST_PARTS) as u32
            } else {
                1
            }
        });
        parts.take(self.hull.len()).collect()
    }

    /// The upper hull of states [J (kg·m²), d (N·m)].
    pub fn among(mut states: Vec<[f64; 2]>) -> Self {
        // Most states lie below the lines from the upper left end over the top to the right end: they need no sorting.
        let most = |key: fn(&[f64; 2]) -> [f64; 2]| {
            let by = |a: &&[f64; 2], b: &&[f64; 2]| key(a).partial_cmp(&key(b));
            let later = |a, b| {
                if by(&a, &b) == Some(Ordering::Less) {
                    b
                } else {
                    a
                }
            };
            states.iter().reduce(later).copied()
        };
        let corners = most(|[j, d]| [-j, *d])
            .zip(most(|[j, d]| [*d, *j]))
            .zip(most(|[j, d]| [*j, *d]));
        if let Some(((left, top), right)) = corners {
            states.retain(|state| {
                let [from, to] = if state[0] <= top[0] {
                    [left, top]
                } else {
                    [top, right]
                };
                turn(from, *state, to) <= 0.0
            });
        }
        states.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let mut hull: Vec<[f64; 2]> = Vec::new();
        for point in states {
            // States of equal inertia within rounding are merged: the search along the hull must not meet a level stretch.
            if let Some(last) = hull.last().copied()
                && point[0] - last[0] <= SAME_INERTIA * point[0]
            {
                if point[1] <= last[1] {
                    continue;
                }
                hull.pop();
            }
            while let [.., a, b] = hull.as_slice() {
                if turn(*a, *b, point) < 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(point);
        }
        Self { hull }
    }

    /// Largest torque through the gearbox at its output (N·m), and the inertia (kg·m²) at which it occurs; `None` if nothing ever moves.
    pub fn worst(&self, braking: &Braking) -> Option<[f64; 2]> {
        let at = |k: usize| self.hull.get(k).map(|state| braking.torque_at(*state));
        // Unimodal along the hull: the first state from which it no longer rises.
        let (mut low, mut high) = (0, self.hull.len().checked_sub(1)?);
        while low < high {
            let middle = usize::midpoint(low, high);
            if at(middle + 1) > at(middle) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        Some([at(low)?, self.hull.get(low)?[0]])
    }
}
