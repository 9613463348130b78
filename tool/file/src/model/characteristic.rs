//! Torque of a motor over its speed: a torque-speed curve, the line of a DC motor, or an induction motor by Kloss.

/// Torque (or force) of a motor over its speed.
#[derive(Clone, Debug, PartialEq)]
pub enum Characteristic {
    /// (speed (rad/s), torque (N·m)), speeds rising; one point means a constant torque. Linear between points, constant beyond the ends.
    Points(Vec<(f64, f64)>),
    /// A DC motor at constant voltage: T = T_stall·(1 − ω/ω₀), also as a brake and a generator.
    Dc {
        /// ω₀, the speed without torque (rad/s).
        no_load_speed: f64,
        /// T_stall, at rest (N·m).
        stall_torque: f64,
    },
    /// An induction motor at constant voltage and frequency, by Kloss: T = 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.
    Induction {
        /// T_b, the largest driving torque (N·m).
        breakdown_torque: f64,
        /// s_b, the slip at that torque.
        breakdown_slip: f64,
        /// ω_s (rad/s).
        synchronous_speed: f64,
    },
}

impl Characteristic {
    /// A torque that does not depend on the speed.
    pub fn constant(torque: f64) -> Self {
        Self::Points(vec![(0.0, torque)])
    }

    /// The torque multiplied by a factor at every speed.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        match &mut scaled {
            Self::Points(points) => {
                for (_, torque) in points {
                    *torque *= factor;
                }
            }
            Self::Dc { stall_torque, .. } => *stall_torque *= factor,
            Self::Induction {
                breakdown_torque, ..
            } => *breakdown_torque *= factor,
        }
        scaled
    }

    /// Torque (N·m) at a speed (rad/s).
    pub fn torque(&self, speed: f64) -> f64 {
        match self {
            Self::Points(points) => between(points, speed),
            Self::Dc {
                no_load_speed,
                stall_torque,
            } => stall_torque * (1.0 - speed / no_load_speed),
            Self::Induction {
                breakdown_torque,
                breakdown_slip,
                synchronous_speed,
            } => {
                let slip = 1.0 - speed / synchronous_speed;
                let (own, squared) = (slip * breakdown_slip, slip * slip);
                2.0 * breakdown_torque * own / (squared + breakdown_slip * breakdown_slip)
            }
        }
    }

    /// Speeds (rad/s) at which the curve has a corner, or crosses zero.
    pub fn bends(&self) -> Vec<f64> {
        match self {
            Self::Points(points) => {
                let crossing = points.windows(2).filter_map(|pair| {
                    let [(from, a), (to, b)] = [pair[0], pair[1]];
                    (a * b < 0.0).then(|| from + (to - from) * a / (a - b))
                });
                let corners = points.iter().map(|(speed, _)| *speed);
                let corners = corners.filter(|_| points.len() > 1);
                corners.chain(crossing).collect()
            }
            Self::Dc { no_load_speed, .. } => vec![*no_load_speed],
            Self::Induction {
                synchronous_speed, ..
            } => vec![*synchronous_speed],
        }
    }

    /// Speeds (rad/s) at which the curve bends or has an extreme, and where it crosses zero.
    pub fn marks(&self) -> Vec<f64> {
        match self {
            Self::Points(points) => points.iter().map(|(speed, _)| *speed).collect(),
            Self::Dc { no_load_speed, .. } => vec![*no_load_speed],
            Self::Induction {
                breakdown_slip,
                synchronous_speed,
                ..
            } => {
                let slips = [*breakdown_slip, 0.0, -*breakdown_slip];
                slips.map(|slip| synchronous_speed * (1.0 - slip)).to_vec()
            }
        }
    }
}

fn between(points: &[(f64, f64)], speed: f64) -> f64 {
    let right = points.partition_point(|p| p.0 < speed);
    match (
        right.checked_sub(1).and_then(|k| points.get(k)),
        points.get(right),
    ) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (speed - a.0) / (b.0 - a.0),
        (Some(only), None) | (None, Some(only)) => only.1,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kloss: breakdown torque at the breakdown slip, zero at synchronous speed, and the symmetric generator.
    #[test]
    fn kloss() {
        let motor = Characteristic::Induction {
            breakdown_torque: 50.0,
            breakdown_slip: 0.2,
            synchronous_speed: 100.0,
        };
        assert!((motor.torque(80.0) - 50.0).abs() < 1e-13);
        assert!((motor.torque(120.0) + 50.0).abs() < 1e-13);
        assert!(motor.torque(100.0).abs() < 1e-15);
        // At rest s = 1: 2·50/(5 + 0.2).
        assert!((motor.torque(0.0) - 100.0 / 5.2).abs() < 1e-13);
        let slope = (motor.torque(80.001) - motor.torque(79.999)) / 0.002;
        assert!(slope.abs() < 1e-6, "{slope}");
    }

    #[test]
    fn a_line_and_points_agree() {
        let line = Characteristic::Dc {
            no_load_speed: 300.0,
            stall_torque: 9.0,
        };
        let points = Characteristic::Points(vec![(-300.0, 18.0), (300.0, 0.0), (600.0, -9.0)]);
        for speed in [-200.0, 0.0, 12.0, 300.0, 450.0] {
            assert!((line.torque(speed) - points.torque(speed)).abs() < 1e-13);
        }
    }
}
