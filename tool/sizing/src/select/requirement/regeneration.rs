//! Power that flows back to the motor, and the brake resistor that it needs.

use serde::Serialize;

use super::Inquiry;
use crate::bus::supply::BusData;
use crate::bus::{self, Need};
use crate::catalogue::Motor;
use crate::motor::envelope::MotorLimits;

/// Energy that flows back over a cycle, without the losses of motor and amplifier, which only reduce it; SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Regeneration {
    /// Energy over a cycle.
    #[serde(rename = "energy per cycle [J]")]
    pub energy: f64,
    /// Its mean power.
    #[serde(rename = "mean [W]")]
    pub mean: f64,
    /// Its largest power.
    #[serde(rename = "peak [W]")]
    pub peak: f64,
    /// Largest energy without a pause, if nothing is stored.
    #[serde(rename = "pulse [J]")]
    pub pulse: f64,
    /// Largest motoring power; losses are added to it.
    #[serde(rename = "motoring peak [W]")]
    pub motoring_peak: f64,
    /// The brake resistor, if `[supply]` gives the voltages and the bus needs one.
    pub resistor: Option<Need>,
    /// Whether the drive with the least peak torque stops the machine with its share of it (`drive_stop` of `[duty]`); `None` without the key.
    pub stops: Option<bool>,
}

impl Inquiry<'_> {
    /// The largest figures of motors with these rotors. A stop by the drive is one with its share of the peak torque (N·m).
    pub(super) fn regeneration(
        &self,
        ratio: Option<f64>,
        rotors: [f64; 2],
        peak_torque: f64,
    ) -> Regeneration {
        let each = rotors.map(|rotor| self.regenerated(ratio, rotor, peak_torque));
        let [first, second] = each;
        let more = |of: fn(&Regeneration) -> f64| of(&first).max(of(&second));
        let power = |need: &Need| need.peak;
        Regeneration {
            energy: more(|r| r.energy),
            mean: more(|r| r.mean),
            peak: more(|r| r.peak),
            pulse: more(|r| r.pulse),
            motoring_peak: more(|r| r.motoring_peak),
            resistor: match (first.resistor, second.resistor) {
                (Some(a), Some(b)) => Some(Need {
                    mean: a.mean.max(b.mean),
                    peak: a.peak.max(b.peak),
                    pulse: a.pulse.max(b.pulse),
                    ..if power(&a) >= power(&b) { a } else { b }
                }),
                (a, b) => a.or(b),
            },
            stops: first.stops.min(second.stops),
        }
    }

    fn regenerated(&self, ratio: Option<f64>, rotor: f64, peak_torque: f64) -> Regeneration {
        let site = &self.file.site;
        let motor = Motor {
            peak_torque: Some(peak_torque),
            ..self.motor(rotor)
        };
        let limits = MotorLimits::new(&motor, None, site);
        let coefficients = self.coefficients(ratio, rotor);
        let ratio = ratio.unwrap_or(1.0);
        let stop = bus::stop(self.cycle, &coefficients, ratio, &limits, site.drive_stop);
        let curve = bus::power(self.cycle, &coefficients, ratio, &motor, &limits, None);
        let stops = site.drive_stop.map(|_| stop.energy.is_finite());
        let [_, energy] = self.cycle.energies(&coefficients, ratio);
        let [least, most] = curve.extremes();
        let data = BusData::new(&site.supply, site.highest_supply(), None, &motor);
        // Without a capacitance nothing is stored, whatever the voltages are.
        let empty = BusData {
            voltage: Some(1.0),
            capacitance: None,
            chopper_voltage: Some(2.0),
            max_voltage: None,
            resistor: None,
            regenerative: false,
            ..data
        };
        Regeneration {
            energy,
            mean: energy / self.cycle.duration(),
            peak: (-least).max(0.0),
            pulse: Need::of(&empty, &curve).map_or(0.0, |need| need.pulse),
            motoring_peak: most.max(0.0),
            resistor: Need::of(
                &data,
                &match stops {
                    Some(true) => curve.with_stop(stop),
                    _ => curve,
                },
            )
            .filter(|_| !data.regenerative),
            stops,
        }
    }
}
