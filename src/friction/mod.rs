//! Friction drives and variators: ratios and slips that may vary, and the constraint that follows.
//!
//! Next to the mechanisms in the data flow: [`FrictionDrive`], with constant ratio and slip, is a mechanism; a [`Drive`] with varying ratio or slip
//! has its own equation of motion.
//!
//! A stage couples two shafts by a geometric ratio i and a slip ε, each a number or a [`Course`] over time, angle or load. Its velocity coefficient
//! is j = i/(1 − ε) as in (III.12), (III.19), or i·(1 − ε) where the first shaft drives ([`Flow`]). Stages form a [`Drive`], a chain or a fan.
//!
//! | question | answer |
//! |---|---|
//! | how does it move? | [`Drive::forward`], [`Drive::inverse`]: factor ½ on dJ/dt·ω |
//! | slip that grows with the load, as a separate degree of freedom | [`CreepContact`] |
//! | can the constraint be written between angles? | [`Drive::integrability`] |
//!
//! Equations (III.1)-(III.19): the chapter on holonomic and non-holonomic constraints of friction drives. As in its figure, shaft 1 is the drive
//! shaft.

mod course;
mod creep;
mod drive;
mod dual;
pub(crate) mod error;
mod integrability;
mod mechanism;
mod stage;
mod state;

pub use course::{
    Coefficient, Course, Creep, Curve, OperatingPoint, Ramp, RampShape, Sine, SineShape, Variable,
};
pub use creep::{CreepContact, CreepLimit, Traction};
pub use drive::{Arrangement, Contact, Drive, MAX_SHAFTS};
pub use dual::Dual;
pub use error::FrictionError;
pub use integrability::StageConstraint;
pub use mechanism::FrictionDrive;
pub use stage::{Flow, Ratios, Stage};
pub use state::{ContactMotion, Motion, Shaft, ShaftMotion, State};
