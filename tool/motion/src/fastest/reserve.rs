//! What a motion leaves unused of motor and gearbox.

use jred_machine::model::rule::Rule;
use jred_machine::model::rules::RuleSet;

/// Share of a limit by which a motion with a reserve stays below what the reserve leaves, so that a rule that asks for the same
/// reserve is satisfied whatever the last digits: they are known to 1e-9 between the nodes.
const ROUNDING_MARGIN: f64 = 1e-6;

/// What a motion leaves unused, as shares of torque and speed of motor and gearbox; 0: nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reserve {
    /// Of the motor's torque, driving and braking.
    pub torque: f64,
    /// Of its largest speed.
    pub speed: f64,
    /// Of the gearbox's torque.
    pub gearbox_torque: f64,
    /// Of its largest input speed.
    pub gearbox_speed: f64,
    /// Of the motor's S1 torque, by the RMS torque.
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

    /// What rules for a motion of a given drive ask for.
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

    /// Whether there is one.
    pub fn is_some(&self) -> bool {
        *self != Self::default()
    }

    /// What it leaves of a limit.
    pub(super) fn leaves(&self, share: f64) -> f64 {
        if self.is_some() {
            (1.0 - share) * (1.0 - ROUNDING_MARGIN)
        } else {
            1.0
        }
    }
}
