//! The integrands over a panel, and the errors of their integrals.
//!
//! The integrands are the quantities of which all later sums consist: torque, speed, acceleration and inertia at the input and their products in
//! pairs, power and its square, |n|·|T|³ for the cubic mean torque, losses, and the powers of the energy balance.

use super::moving_machine::DutyInstant;
use jred_file::number::quadrature::kronrod::{Estimate, MOST_PLACES, Rule};

/// Number of integrands.
pub(super) const COUNT: usize = 18;

/// Index of the torque at the input.
const TORQUE: usize = 0;

/// Indices of the energy balance.
const WORK: usize = 4;
const LOSS: usize = 13;
const GAIN: usize = 14;
const FRICTION: usize = 16;
const PROCESS: usize = 17;

/// Rounding of a torque, as a share of the sum of its terms' magnitudes.
const ROUNDING: f64 = 1e-13;

/// Allowed error at the ends of the curve through the places, in rounding errors of the time relative to half the panel, as a share of the torque.
const TO_THE_ENDS: f64 = 64.0;

/// Share of the tolerance, relative to the terms' magnitudes, below which an error counts as rounding: where the terms nearly cancel, their sum is
/// known no better.
const OF_TERMS: f64 = 0.01;

/// Shares of the tolerance of a whole integral that one panel, and all panels together, may add by an undetected jump.
const OF_WHOLE: [f64; 2] = [1e-3, 2.0];

/// The least share of the whole integral that is assigned to each of this many panels.
pub(super) fn of_whole(panels: usize) -> f64 {
    OF_WHOLE[0].min(OF_WHOLE[1] / panels as f64)
}

/// The integrands at an instant, and their rounding errors.
pub(super) fn integrands(now: &DutyInstant) -> [[f64; 2]; COUNT] {
    let DutyInstant {
        instant,
        loss,
        magnitude,
        ratio,
        ..
    } = now;
    let (torque, speed) = (instant.input_torque, instant.input_speed);
    let (alpha, inertia) = (instant.input_alpha, instant.input_inertia);
    let (terms, omega) = (&instant.terms, instant.omega);
    let link = terms.total();
    let power = torque * speed;
    let off = ROUNDING * magnitude;
    let twice = 2.0 * torque.abs() * off + off * off;
    let of_power = speed.abs() * off;
    let exact = |value: f64| [value, ROUNDING * value.abs()];
    [
        [torque, off],
        [torque * torque, twice],
        exact(alpha * alpha),
        exact(speed * speed),
        [power, of_power],
        [
            power * power,
            2.0 * power.abs() * of_power + of_power * of_power,
        ],
        exact(alpha * alpha * speed * speed),
        [
            speed.abs() * torque.abs().powi(3),
            speed.abs() * 1.5 * torque.abs() * twice,
        ],
        exact(inertia),
        exact(inertia * inertia),
        [alpha * torque, alpha.abs() * off],
        exact(speed),
        [link * link, 2.0 * link.abs() * off * ratio.abs()],
        [*loss, of_power],
        [(terms.acceleration + terms.velocity) * omega, of_power],
        [terms.potential * omega, of_power],
        [(terms.viscous + terms.coulomb) * omega, of_power],
        [terms.process * omega, of_power],
    ]
}

/// Integrals and their errors.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    integrals: [Estimate; COUNT],
    /// Their values if the terms of the torque did not cancel.
    terms: [f64; COUNT],
}

/// Allowed errors of a panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct PanelTolerance<'s> {
    pub(super) tolerance: f64,
    /// Approximate ∫|f| of each integrand over the motion.
    pub(super) sizes: &'s [f64; COUNT],
    /// The panel's share of the time.
    pub(super) share: f64,
    /// The least share of the whole integral that is assigned to it: see [`of_whole`].
    pub(super) of_whole: f64,
    /// The largest torque at the input; `None` if smaller panels have not improved the curve.
    pub(super) largest: Option<f64>,
}

impl Sums {
    /// The sums over a panel of half the length `half` (s), evaluated at the places of a rule. Also the largest error divided by the allowed one, and
    /// divided by the panel's share of the integral.
    pub(super) fn over(
        rule: &Rule,
        places: &[DutyInstant],
        ends: [&DutyInstant; 2],
        half: f64,
        allowed: PanelTolerance,
    ) -> (Self, [f64; 2]) {
        let mut values = [[0.0; MOST_PLACES]; COUNT];
        let mut roundings = [0.0; COUNT];
        for (place, (now, weight)) in places.iter().zip(rule.weights()).enumerate() {
            for (j, [value, rounding]) in integrands(now).into_iter().enumerate() {
                values[j][place] = value;
                roundings[j] += weight * rounding;
            }
        }
        let mut sums = Self::default();
        let [mut excess, mut rough] = [0.0f64; 2];
        for (j, values) in values.iter().enumerate() {
            let found = rule.estimate(&values[..places.len()]);
            let Estimate {
                integral,
                error,
                size,
            } = found;
            let beyond = if j == TORQUE {
                let values = &values[..places.len()];
                let middle = places[places.len() / 2].instant.t;
                let off = ends.map(|end| {
                    let x = (end.instant.t - middle) / half;
                    (rule.at(values, x) - end.instant.input_torque).abs()
                });
                // Towards the ends the curve through the places amplifies rounding of the times.
                let most = values
                    .iter()
                    .fold(0.0f64, |most, value| most.max(value.abs()));
                let rounding = TO_THE_ENDS * f64::EPSILON * middle.abs() / half * most;
                let off = (off[0] + off[1] - rounding).max(0.0);
                // A peak may lie between the places. Where the terms cancel, their sum is known no better than for the integrals.
                let known = ROUNDING.max(OF_TERMS * allowed.tolerance);
                let known = ends.map(|end| known * end.magnitude);
                if let Some(largest) = allowed.largest {
                    let allowed_off = (allowed.tolerance * largest).max(known[0]).max(known[1]);
                    if off > allowed_off {
                        excess = excess.max(off / allowed_off);
                        rough = rough.max(off / largest);
                    }
                }
                off
            } else {
                0.0
            };
            // A kink between the last place and the end, which neither rule detects.
            let beyond = 0.5 * (1.0 - rule.places()[places.len() - 1]) * beyond;
            let [error, size] = [half * (error + beyond), half * size];
            let whole = allowed.sizes[j] * allowed.share.max(allowed.of_whole);
            let terms = half * roundings[j] / ROUNDING;
            let rounding = terms * ROUNDING.max(OF_TERMS * allowed.tolerance);
            let most = (0.5 * allowed.tolerance * size.max(whole)).max(rounding);
            if error > 0.0 {
                excess = excess.max(error / most);
                // Relative to the share by time: halving does not reduce rounding there.
                if error > most {
                    let even = size.max(allowed.sizes[j] * allowed.share);
                    rough = rough.max(error / even);
                }
            }
            sums.terms[j] = terms.max(size);
            sums.integrals[j] = Estimate {
                integral: half * integral,
                error,
                size,
            };
        }
        (sums, [excess, rough])
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (sum, other) in self.integrals.iter_mut().zip(&other.integrals) {
            sum.integral += other.integral;
            sum.error += other.error;
            sum.size += other.size;
        }
        for (sum, other) in self.terms.iter_mut().zip(other.terms) {
            *sum += other;
        }
    }

    /// The largest error as a share of the integral of the terms.
    pub(super) fn reached(&self) -> f64 {
        self.error(&self.terms)
    }

    /// The largest error as a share of these sizes.
    pub(super) fn error(&self, sizes: &[f64; COUNT]) -> f64 {
        let shares = self.integrals.iter().zip(sizes).map(|(sum, size)| {
            if sum.error > 0.0 {
                sum.error / size
            } else {
                0.0
            }
        });
        shares.fold(0.0, f64::max)
    }

    /// Work at the input, and the part of loads and losses (J).
    pub(super) fn work(&self) -> [f64; 2] {
        let of = |j: usize| self.integrals[j].integral;
        [of(WORK), of(LOSS) + of(FRICTION) + of(PROCESS)]
    }

    /// The exchanged energy (J).
    pub(super) fn moved(&self) -> f64 {
        [WORK, LOSS, GAIN, GAIN + 1, FRICTION, PROCESS]
            .into_iter()
            .map(|j| self.integrals[j].size)
            .fold(0.0, f64::max)
    }
}
