//! The ratings that a gearbox needs.

use serde::Serialize;

use super::{Inquiry, Requirement};
use crate::judge::Context;
use crate::motor::envelope::MotorLimits;
use jred_file::model::rule::Rule;

/// The ratings that a gearbox needs at its output and input; SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct GearboxRequirement {
    /// Acceleration torque T2B, at the cycles per hour below.
    #[serde(rename = "T2B [N m]")]
    pub peak_torque: f64,
    /// Rated torque T2N.
    #[serde(rename = "T2N [N m]")]
    pub rated_torque: f64,
    /// Emergency torque, if the motor brakes with the required peak torque.
    #[serde(rename = "emergency torque [N m]")]
    pub emergency_torque: Option<f64>,
    /// Rated input speed n1N.
    #[serde(rename = "n1N [rad/s]")]
    pub rated_speed: f64,
    /// Largest input speed.
    #[serde(rename = "maximum input speed [rad/s]")]
    pub max_speed: f64,
    /// Cycles per hour.
    #[serde(rename = "cycles per hour")]
    pub cycles: f64,
    /// Torsional stiffness at the output; infinite if the shafts alone are too soft; `None`: no rule needs it.
    #[serde(rename = "stiffness [N m/rad]")]
    pub stiffness: Option<f64>,
    /// Largest backlash at the output; negative if the drive train alone has too much; `None`: no rule needs it.
    #[serde(rename = "backlash [rad]")]
    pub backlash: Option<f64>,
    /// Radial load that the output shaft must bear; `None`: nothing with a known pull is on it.
    #[serde(rename = "radial load [N]")]
    pub radial_load: Option<f64>,
    /// Axial load that the output shaft must bear; `None`: as above.
    #[serde(rename = "axial load [N]")]
    pub axial_load: Option<f64>,
}

impl Inquiry<'_> {
    pub(super) fn gearbox_requirement(
        &self,
        ratio: f64,
        found: &Requirement,
        rotors: [f64; 2],
    ) -> GearboxRequirement {
        let each = rotors.map(|rotor| {
            let motor = found.smallest_motor(self.motor(rotor).kind, rotor);
            self.findings(Some(ratio), &motor)
        });
        let [first, _] = &each;
        let of = |rule| self.required(first, rule);
        let load = |rule| {
            let found = first.get(rule)?;
            let load = found.value / self.share(rule);
            load.is_finite().then_some(load)
        };
        let stops = each.each_ref().map(|found| {
            let stop = found.get(Rule::GearboxEmergency)?;
            let torque = stop.value / self.share(Rule::GearboxEmergency);
            torque.is_finite().then_some(torque)
        });
        let motor = self.motor(rotors[0]);
        let limits = MotorLimits::new(&motor, None, &self.file.site);
        let (stiffness, backlash) = self.with(Some(ratio), &motor, |drive| {
            let context = Context::new(self.cycle, &self.file.site, drive, &limits);
            let limit = |rule| {
                self.file
                    .rules
                    .limit(rule)
                    .is_set()
                    .then(|| self.share(rule))
            };
            (
                limit(Rule::NaturalFrequency).map(|share| context.stiffness_for(share)),
                limit(Rule::Backlash).and_then(|share| context.backlash_for(share)),
            )
        });
        GearboxRequirement {
            peak_torque: of(Rule::GearboxPeak),
            rated_torque: of(Rule::GearboxCubicMean),
            emergency_torque: match stops {
                [Some(a), Some(b)] => Some(a.max(b)),
                _ => None,
            },
            rated_speed: of(Rule::GearboxMeanSpeed),
            max_speed: of(Rule::GearboxSpeed),
            cycles: first
                .get(Rule::GearboxCycles)
                .map_or(0.0, |found| found.value),
            stiffness,
            backlash,
            radial_load: load(Rule::GearboxRadial),
            axial_load: load(Rule::GearboxAxial),
        }
    }
}
