//! One or two heated bodies against the surroundings, and their exact course while the losses are constant.
//!
//! ```text
//! C_w·θ_w′ = P·(1 + g·θ_w) − (θ_w − θ_h)/R_w            winding
//! C_h·θ_h′ = (θ_w − θ_h)/R_w − θ_h/R_h + Q               housing
//! C·θ′     = P·(1 + g·θ) + Q − θ/R                       the motor as a whole
//! ```
//!
//! θ are rises above the surroundings (K), P the copper loss (W) with the winding at ambient temperature, Q the other losses (W), g the growth of the
//! copper's resistance per kelvin. τ_w = R_w·C_w, τ_h = R_h·C_h, τ = R·C. With constant P and Q the equations are linear, θ′ = A·θ + b, and θ(h) =
//! θ(0) + M·(A·θ(0) + b) with M = ∫₀ʰ e^(A·s) ds.

use jred_file::math;

/// Rises above the surroundings (K): winding, housing. For a single body only the first is used.
pub type Rise = [f64; 2];

type Matrix = [[f64; 2]; 2];

/// Losses that are constant over a time (W).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Losses {
    /// Copper loss with the winding at ambient temperature.
    pub copper: f64,
    /// Other losses: friction. They heat the housing.
    pub other: f64,
}

/// The heated bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bodies {
    /// The motor as one body: resistance to the surroundings (K/W), capacity (W·s/K).
    One([f64; 2]),
    /// Winding and housing: resistance from winding to housing and from housing to the surroundings, capacities.
    Two([f64; 4]),
}

/// Heated bodies whose copper loss may grow with the temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Network {
    bodies: Bodies,
    growth: f64,
}

/// θ ↦ θ + D·θ + g: effect of a stretch of time on the rises. D is stored, not I + D, so that short times lose no digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transition {
    matrix: Matrix,
    shift: Rise,
}

/// The linear equations of a stretch of constant losses.
struct Linear {
    a: Matrix,
    b: Rise,
}

impl Network {
    /// One body: thermal resistance (K/W) and time constant (s), growth of the copper loss (1/K).
    pub fn one(resistance: f64, time: f64, growth: f64) -> Self {
        Self {
            bodies: Bodies::One([resistance, time / resistance]),
            growth,
        }
    }

    /// Winding and housing: thermal resistances \[winding to housing, housing to surroundings\] (K/W), time constants
    /// \[winding, housing\] (s), growth of the copper loss (1/K).
    pub fn two(resistances: [f64; 2], times: [f64; 2], growth: f64) -> Self {
        let ([rw, rh], [tw, th]) = (resistances, times);
        Self {
            bodies: Bodies::Two([rw, rh, tw / rw, th / rh]),
            growth,
        }
    }

    /// Whether winding and housing are separate bodies.
    pub const fn has_housing(&self) -> bool {
        matches!(self.bodies, Bodies::Two(_))
    }

    /// The shortest time (s) in which a rise changes by its own size.
    pub fn fastest(&self) -> f64 {
        match self.bodies {
            Bodies::One([r, c]) => r * c,
            Bodies::Two([rw, _, cw, ch]) => rw * cw.min(ch),
        }
    }

    /// An upper bound of the longest time constant without losses (s): the sum of both.
    pub fn slowest(&self) -> f64 {
        match self.bodies {
            Bodies::One([r, c]) => r * c,
            Bodies::Two([rw, rh, cw, ch]) => (rw + rh) * cw + rh * ch,
        }
    }

    fn linear(&self, losses: Losses) -> Linear {
        let Losses { copper, other } = losses;
        match self.bodies {
            Bodies::One([r, c]) => Linear {
                a: [[(self.growth * copper - 1.0 / r) / c, 0.0], [0.0, 0.0]],
                b: [(copper + other) / c, 0.0],
            },
            Bodies::Two([rw, rh, cw, ch]) => Linear {
                a: [
                    [(self.growth * copper - 1.0 / rw) / cw, 1.0 / (rw * cw)],
                    [1.0 / (rw * ch), -(1.0 / rw + 1.0 / rh) / ch],
                ],
                b: [copper / cw, other / ch],
            },
        }
    }

    /// Change of the rises by `time` (s) of constant losses.
    pub fn change(&self, losses: Losses, time: f64) -> Transition {
        let linear = self.linear(losses);
        let m = linear.integral(time);
        Transition {
            matrix: product(&linear.a, &m),
            shift: apply(&m, linear.b),
        }
    }

    /// The hottest rises during `time` (s) of constant losses, starting `from` and ending with `to`. A rise is a sum of two exponentials, with at
    /// most one extreme.
    pub fn hottest(&self, losses: Losses, time: f64, from: Rise, to: Rise) -> Rise {
        let linear = self.linear(losses);
        let slope = |x: Rise| {
            let [p, q] = apply(&linear.a, x);
            [p + linear.b[0], q + linear.b[1]]
        };
        let (before, after) = (slope(from), slope(to));
        let mut hottest = [from[0].max(to[0]), from[1].max(to[1])];
        for k in 0..2 {
            if !(before[k] > 0.0 && after[k] < 0.0) {
                continue;
            }
            let [slow, fast] = linear.eigenvalues();
            // x′ = α·e^(slow·t) + β·e^(fast·t)
            let [p, q] = apply(&linear.a, before);
            let alpha = ([p, q][k] - fast * before[k]) / (slow - fast);
            let beta = before[k] - alpha;
            let place = math::ln(-beta / alpha) / (slow - fast);
            if place > 0.0 && place < time {
                let there = self.change(losses, place).of(from);
                hottest[k] = hottest[k].max(there[k]);
            }
        }
        hottest
    }
}

/// Steady rises \[winding, housing\] at constant losses behind the thermal resistances \[winding to housing, housing to surroundings\]: θ_w = (R_w +
/// R_h)·P·(1 + g·θ_w) + R_h·Q; `None` without a steady state.
pub fn steady([rw, rh]: [f64; 2], losses: Losses, growth: f64) -> Option<Rise> {
    let left = 1.0 - growth * losses.copper * (rw + rh);
    if left <= 0.0 {
        return None;
    }
    let winding = ((rw + rh) * losses.copper + rh * losses.other) / left;
    let flow = losses.copper * (1.0 + growth * winding) + losses.other;
    Some([winding, rh * flow])
}

impl Linear {
    /// The eigenvalues of A, the larger first. They are real, because the two bodies heat each other.
    fn eigenvalues(&self) -> [f64; 2] {
        let [[a, b], [c, d]] = self.a;
        let middle = 0.5 * (a + d);
        let half = (0.25 * (a - d) * (a - d) + b * c).sqrt();
        [middle + half, middle - half]
    }

    /// M = ∫₀ʰ e^(A·s) ds.
    fn integral(&self, h: f64) -> Matrix {
        // Below this, seven terms of the power series give full precision.
        const SERIES_LIMIT: f64 = 0.02;
        let [[a, b], [c, d]] = self.a;
        let size = (a.abs() + b.abs()).max(c.abs() + d.abs()) * h;
        if size < SERIES_LIMIT {
            let scaled = [[a * h, b * h], [c * h, d * h]];
            let mut sum = [[1.0, 0.0], [0.0, 1.0]];
            for k in (2..=8).rev() {
                let next = product(&scaled, &sum);
                let k = f64::from(k);
                sum = [
                    [1.0 + next[0][0] / k, next[0][1] / k],
                    [next[1][0] / k, 1.0 + next[1][1] / k],
                ];
            }
            return sum.map(|row| row.map(|x| x * h));
        }
        let [slow, fast] = self.eigenvalues();
        let grown = |x: f64| if x == 0.0 { h } else { math::expm1(x * h) / x };
        let (first, second) = (grown(slow), grown(fast));
        let per = (first - second) / (slow - fast);
        [
            [second + per * (a - fast), per * b],
            [per * c, second + per * (d - fast)],
        ]
    }
}

impl Transition {
    /// The rises after it.
    pub fn of(&self, rise: Rise) -> Rise {
        let [p, q] = apply(&self.matrix, rise);
        [rise[0] + p + self.shift[0], rise[1] + q + self.shift[1]]
    }

    /// This change, then another: (I + D₂)(I + D₁) = I + D₁ + D₂ + D₂·D₁.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let both = product(&next.matrix, &self.matrix);
        let moved = apply(&next.matrix, self.shift);
        let entry = |r: usize, c: usize| self.matrix[r][c] + next.matrix[r][c] + both[r][c];
        Self {
            matrix: [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]],
            shift: [
                self.shift[0] + next.shift[0] + moved[0],
                self.shift[1] + next.shift[1] + moved[1],
            ],
        }
    }

    /// This change `count` times.
    #[must_use]
    pub fn repeated(&self, mut count: u64) -> Self {
        let mut result = Self::default();
        let mut power = *self;
        while count > 0 {
            if count & 1 == 1 {
                result = result.then(&power);
            }
            power = power.then(&power);
            count >>= 1;
        }
        result
    }

    /// The rises that repeat after it, if repeating it converges: −D⁻¹·g. `None` if the largest eigenvalue of I + D is one or more, so that the motor
    /// heats up without end. Both matrices have no negative element off their diagonal, so this eigenvalue is real.
    pub fn periodic(&self) -> Option<Rise> {
        let [[a, b], [c, d]] = self.matrix;
        if d == 0.0 && b == 0.0 && c == 0.0 {
            return (a < 0.0).then(|| [-self.shift[0] / a, 0.0]);
        }
        let determinant = a * d - b * c;
        if !(a < 0.0 && d < 0.0 && determinant > 0.0) {
            return None;
        }
        let [p, q] = self.shift;
        Some([(b * q - d * p) / determinant, (c * p - a * q) / determinant])
    }
}

fn apply(m: &Matrix, [x, y]: Rise) -> Rise {
    [m[0][0] * x + m[0][1] * y, m[1][0] * x + m[1][1] * y]
}

fn product(m: &Matrix, n: &Matrix) -> Matrix {
    let entry = |r: usize, c: usize| m[r][0] * n[0][c] + m[r][1] * n[1][c];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}
