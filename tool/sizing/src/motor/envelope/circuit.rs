//! The voltage limit of a winding, in closed form: see [`winding`](crate::motor::winding) for the equations.
//!
//! With Z² = r² + x², |v| ≤ V is a disc in the plane of (i_d, i_q) about c = −(x, r)·k_e·n/Z² with radius V/Z, and |i| ≤ I a disc about zero. Without
//! field weakening i_d = 0. With field weakening the largest i_q is the top of one disc if it lies in the other (the current limit; maximum torque
//! per volt), otherwise the upper intersection of the circles.

use jred_file::math;

/// The circuit of a motor with its limits of voltage and current, steady state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circuit {
    /// Largest voltage V (V), positive.
    pub voltage: f64,
    /// Voltage constant k_e (V·s/rad), positive.
    pub flux: f64,
    /// Voltage drop per ampere r (V/A), positive.
    pub drop: f64,
    /// Reactance per speed x/n (V·s/(A·rad)); zero for direct current.
    pub reactance: f64,
    /// Largest current I (A); infinite: no data.
    pub current: f64,
    /// Whether the amplifier weakens the field, i_d < 0.
    pub weakens: bool,
}

impl Circuit {
    /// Speed (rad/s) at which the induced voltage alone equals the largest voltage.
    pub fn no_load_speed(&self) -> f64 {
        self.voltage / self.flux
    }

    /// Largest i_q (A) along (`braking` false) or against the speed n ≥ 0 (rad/s); zero where no current is possible.
    pub fn largest_current(&self, speed: f64, braking: bool) -> f64 {
        if self.weakens {
            self.weakened(speed, braking)
        } else {
            self.unweakened(speed, braking).min(self.current)
        }
    }

    fn unweakened(&self, speed: f64, braking: bool) -> f64 {
        let Self {
            voltage: v,
            drop: r,
            ..
        } = *self;
        let back = self.flux * speed;
        let left = (v - back) * (v + back);
        if left.is_nan() || left <= 0.0 {
            return 0.0;
        }
        let x = self.reactance * speed;
        let square = r * r + x * x;
        // V²·Z² − x²·(k_e·n)², both parts positive.
        let root = (v * v * r * r + x * x * left).sqrt();
        // One formula loses its digits near no load, the other does not; braking is the other root.
        if braking {
            (r * back + root) / square
        } else {
            left / (r * back + root)
        }
    }

    fn weakened(&self, speed: f64, braking: bool) -> f64 {
        let Self {
            voltage: v,
            drop: r,
            current: limit,
            ..
        } = *self;
        let sign = if braking { -1.0 } else { 1.0 };
        let back = self.flux * speed;
        let x = self.reactance * speed;
        let q = r * limit + sign * back;
        if q * q + x * x * limit * limit <= v * v {
            return limit;
        }
        if let Some(top) = self.torque_per_volt(speed, braking) {
            return top;
        }
        let impedance = math::hypot(r, x);
        let distance = back / impedance;
        let radius = v / impedance;
        let along = (limit * limit + (distance - radius) * (distance + radius)) / (2.0 * distance);
        let half = (limit - along) * (limit + along);
        if half.is_nan() || half < 0.0 {
            return 0.0;
        }
        ((x * half.sqrt() - sign * r * along) / impedance).clamp(0.0, limit)
    }

    /// i_q (A) at maximum torque per volt, the top of the voltage disc, if the current limit allows it.
    pub(super) fn torque_per_volt(&self, speed: f64, braking: bool) -> Option<f64> {
        let sign = if braking { -1.0 } else { 1.0 };
        let back = self.flux * speed;
        let [r, x] = [self.drop, self.reactance * speed];
        let square = r * r + x * x;
        let top = self.voltage / square.sqrt() - sign * r * back / square;
        let across = x * back / square;
        (top >= 0.0 && math::hypot(across, top) <= self.current).then_some(top)
    }

    /// Speed (rad/s) up to which a current i_q (A, driving) is possible at i_d = 0; zero if the voltage is too low even at standstill.
    pub fn speed_of(&self, current: f64) -> f64 {
        let Self {
            voltage: v,
            flux: e,
            drop: r,
            reactance: l,
            ..
        } = *self;
        let resistive = r * current;
        let left = (v - resistive) * (v + resistive);
        if left.is_nan() || left <= 0.0 {
            return 0.0;
        }
        let inductive = l * current;
        let root = (v * v * e * e + inductive * inductive * left).sqrt();
        // The root of square·n² + 2·r·i·e·n = V² − r²·i², without cancellation.
        left / (resistive * e + root)
    }

    /// Magnitude of the current (A) for `along` (A, positive where it drives) at n ≥ 0 (rad/s), including the field-weakening current. Beyond the
    /// voltage limit, the current at which the voltage is least.
    pub fn total_current(&self, along: f64, speed: f64) -> f64 {
        let back = self.flux * speed;
        let x = self.reactance * speed;
        let square = self.drop * self.drop + x * x;
        let excess = square * along * along
            + 2.0 * back * self.drop * along
            + (back - self.voltage) * (back + self.voltage);
        if !self.weakens || excess <= 0.0 {
            return along.abs();
        }
        let root = (x * x * back * back - square * excess).max(0.0).sqrt();
        // −i_d, the root nearer to zero.
        let across = if root > 0.0 {
            excess / (x * back + root)
        } else {
            x * back / square
        };
        math::hypot(along, across)
    }

    /// The largest speed (rad/s), up to `stated`, at which any current is possible: the amplifier still controls the motor, without torque.
    pub fn largest_speed(&self, stated: f64) -> f64 {
        if !self.weakens {
            return self.no_load_speed().min(stated);
        }
        let within = |speed: f64| self.holds_at_no_torque(speed);
        if !stated.is_finite() || within(stated) {
            return stated;
        }
        let (mut low, mut high) = (self.no_load_speed().min(stated), stated);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if within(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    fn holds_at_no_torque(&self, speed: f64) -> bool {
        let x = self.reactance * speed;
        let back = self.flux * speed;
        let square = self.drop * self.drop + x * x;
        let across = (x * back / square).min(self.current);
        let [d, q] = [self.drop * across, back - x * across];
        d * d + q * q <= self.voltage * self.voltage
    }
}
