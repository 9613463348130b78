//! Reserves of motor and gearbox.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;

/// Share by which a motion with a reserve stays below the reduced limit, so that a rule with the same reserve is satisfied whatever the last digits:
/// limits are accurate to 1e-9 between the nodes.
const ROUNDING_MARGIN: f64 = 1e-6;

/// Unused shares of torque and speed of motor and gearbox; 0: no reserve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reserve {
    /// Share of the motor's torque, driving and braking.
    pub torque: f64,
    /// Share of the motor's largest speed.
    pub speed: f64,
    /// Share of the gearbox's torque.
    pub gearbox_torque: f64,
    /// Share of the gearbox's largest input speed.
    pub gearbox_speed: f64,
    /// Share of the motor's S1 torque, which limits the RMS torque.
    pub rms: f64,
}

impl Reserve {
    /// The same share of the motor's torque and of its speed.
    pub const fn of_motor(share: f64) -> Self {
        Self {
            torque: share,
            speed: share,
            gearbox_torque: 0.0,
            gearbox_speed: 0.0,
            rms: 0.0,
        }
    }

    /// The reserve that a rule set requires of a motion of a given drive.
    pub fn of(rules: &RuleSet) -> Self {
        let share = |rule: Rule| {
            let limit = rules.limit(rule);
            (1.0 - limit.fail.or(limit.warn).unwrap_or(1.0)).max(0.0)
        };
        Self {
            torque: share(Rule::PeakTorque),
            speed: share(Rule::Speed),
            gearbox_torque: share(Rule::GearboxPeak),
            gearbox_speed: share(Rule::GearboxSpeed),
            rms: share(Rule::RmsTorque),
        }
    }

    /// Whether any share is not zero.
    pub fn is_some(&self) -> bool {
        *self != Self::default()
    }

    /// Factor of a limit after the reserve.
    pub(super) fn leaves(&self, share: f64) -> f64 {
        if self.is_some() {
            (1.0 - share) * (1.0 - ROUNDING_MARGIN)
        } else {
            1.0
        }
    }
}
