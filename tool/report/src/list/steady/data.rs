//! The JSON of `jred steady`.

use schemars::JsonSchema;
use serde::Serialize;

use super::error::problem;
use crate::answer::schema::Data;
use jred_analysis::steady::{
    Classical, Cycle, Flywheel, ShaftFlywheel, Steady, SteadyError, Wheel,
};

/// The steady motion of a machine.
#[derive(Serialize, JsonSchema)]
pub(crate) struct SteadyData<'s> {
    /// The cycle without a further flywheel.
    cycle: Option<&'s Cycle>,
    /// Why the machine has no steady cycle without a further flywheel.
    no_cycle: Option<String>,
    /// Whether the inductance of the motor's winding is neglected: the torque is that of the settled current at each speed.
    inductance_left_out: bool,
    /// The flywheel for the requested δ.
    flywheel: Option<FlywheelData<'s>>,
}

impl Data for SteadyData<'_> {
    const FORM: &'static str = "jred-steady/1";
    const HAS_COURSE: bool = true;
}

/// The flywheel for a coefficient of speed fluctuation.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Flywheel")]
struct FlywheelData<'s> {
    /// Requested δ.
    delta: f64,
    /// Inertia to add on the drive link (kg·m²); 0: none is needed.
    inertia: f64,
    /// Inertia at the motor's shaft for the same δ (kg·m²), where the motor drives the machine through stages.
    inertia_at_motor: Option<f64>,
    /// The shafts on which it can sit, from the motor to the drive link: the latter alone if the motor acts there, or none is needed.
    places: Vec<ShaftData<'s>>,
    /// The classical estimate.
    classical: Classical,
    /// The cycle with it.
    cycle: &'s Cycle,
}

/// A shaft of the drive train, and the flywheel on it, or why none there makes the fluctuation this small.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "ShaftFlywheel")]
struct ShaftData<'s> {
    /// The stage that the shaft drives, counted from 0; the number of stages means the drive link.
    shaft: usize,
    /// The flywheel.
    #[serde(flatten)]
    wheel: Option<&'s Wheel>,
    /// Why no flywheel here makes the fluctuation this small.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_flywheel: Option<String>,
}

impl<'s> SteadyData<'s> {
    pub(super) fn of(steady: &'s Steady) -> Self {
        Self {
            cycle: steady.cycle.as_ref(),
            no_cycle: words(steady.no_cycle.as_ref()),
            inductance_left_out: steady.inductance_left_out,
            flywheel: steady.flywheel.as_ref().map(FlywheelData::of),
        }
    }
}

impl<'s> FlywheelData<'s> {
    fn of(flywheel: &'s Flywheel) -> Self {
        Self {
            delta: flywheel.delta,
            inertia: flywheel.inertia,
            inertia_at_motor: flywheel.inertia_at_motor,
            places: flywheel.places.iter().map(ShaftData::of).collect(),
            classical: flywheel.classical,
            cycle: &flywheel.cycle,
        }
    }
}

impl<'s> ShaftData<'s> {
    fn of(place: &'s ShaftFlywheel) -> Self {
        Self {
            shaft: place.shaft,
            wheel: place.wheel.as_ref(),
            no_flywheel: words(place.no_flywheel.as_ref()),
        }
    }
}

fn words(error: Option<&SteadyError>) -> Option<String> {
    error.map(|error| problem(error).to_string())
}
