//! Parts of the motion that are kept unchanged.

use jred::error::Error;
use jred_file::model::machine::MachineFile;

use super::field::{Binding, Field, MoveLimits};
use super::track::PathPoint;
use crate::moves::KeptMotion;
use crate::path_dynamics::{Actuator, PathDynamics};

/// Share by which a kept part may exceed a limit (rounding).
const ROUNDING: f64 = 1e-6;

/// Shares of a step at which limits are checked.
const STEP_SHARES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// A part of the motion that is kept unchanged.
#[derive(Clone, Debug)]
pub struct KeptPart {
    /// The part.
    pub kept: KeptMotion,
    /// The largest share by which it exceeds a limit, and which limit; negative if it exceeds none. For a torque the share is of the motor's torque
    /// at rest.
    pub excess: (f64, Binding),
}

impl KeptPart {
    /// A kept part, checked with the machine itself.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub(super) fn new(
        file: &MachineFile,
        actuator: &Actuator,
        limits: &MoveLimits,
        kept: &KeptMotion,
    ) -> Result<Self, Error> {
        let dynamics = &PathDynamics::new(file, actuator.clone(), (kept.to - kept.from).signum());
        let limits = *limits;
        let field = Field { dynamics, limits };
        let mut excess = (f64::NEG_INFINITY, Binding::Driving);
        for pair in kept.nodes().windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            for share in STEP_SHARES {
                let state = b.after(a, share);
                let (v, alpha) = (state.omega.abs(), state.alpha * dynamics.direction);
                let own = field.excess_by(&PathPoint::new(&field, state.phi)?, v, alpha);
                if own.0 > excess.0 {
                    excess = own;
                }
            }
        }
        Ok(Self {
            kept: kept.clone(),
            excess,
        })
    }

    /// Whether it exceeds a limit.
    pub fn exceeds(&self) -> bool {
        self.excess.0 > ROUNDING
    }
}
