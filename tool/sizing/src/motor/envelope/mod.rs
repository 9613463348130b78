//! Torque-speed limits of a motor on a given supply and amplifier, in four quadrants.
//!
//! In order of preference the limit of the short-time torque comes from points (`peak_curve`), from the data sheet's corner speed and torque at the
//! largest speed, or from the winding ([`Circuit`]). Missing data are replaced by stated assumptions ([`Envelope::assumptions`]):
//! - no maximum speed: the winding's no-load speed, else the rated speed;
//! - no corner speed: the winding's voltage line, else the peak torque is available up to the rated speed;
//! - no peak torque at maximum speed: the voltage line through the corner, else a straight line to the rated torque there;
//! - no standstill torque: the rated torque;
//! - the S1 torque, reduced for the site ([`Motor::derated`]), falls in a straight line from standstill to rated speed, and above that with constant
//!   power.
//!
//! Equations, units and sources: `docs/motor-limits.md`.

use crate::catalogue::{Amplifier, Catalogue, Motor};
use crate::motor::supply::Voltages;
use crate::motor::winding::CurrentCurve;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{RuleSet, RuleVerdict};
use jred_file::model::site::Site;
use jred_file::model::surroundings::Surroundings;
use jred_file::number::rounding::short;
use jred_file::units::{Sentence, Vocabulary};

mod bound;
mod build;
mod circuit;
mod continuous;
mod floor;
mod limit;
mod segment;
mod voltage;

pub use circuit::Circuit;
pub use limit::{Curvature, Limit, LimitPiece, TorqueCurve};
pub(crate) use segment::TorqueSegment;

use build::Builder;
use continuous::Continuous;

/// Peak and continuous torque over speed. An infinite torque means that there are no data.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    driving: Limit,
    braking: Limit,
    continuous: Continuous,
    max_speed: f64,
    assumptions: Vec<Sentence>,
    words: &'static Vocabulary,
}

impl Envelope {
    /// The envelope of a motor at the voltage of its data sheet, without an amplifier.
    pub fn of(motor: &Motor) -> Self {
        Self::at(motor, None, &Site::default())
    }

    /// The envelope of a motor on an amplifier at a supply. The bus voltage comes from the site, else from the amplifier, else from the motor's data
    /// sheet.
    pub fn at(motor: &Motor, amplifier: Option<&Amplifier>, site: &Site) -> Self {
        Builder::new(motor, amplifier, site).build()
    }

    /// Largest speed (rad/s).
    pub const fn max_speed(&self) -> f64 {
        self.max_speed
    }

    /// S1 torque at standstill (N·m).
    pub fn standstill(&self) -> f64 {
        self.capped(self.continuous.standstill, 0.0)
    }

    /// The same in the surroundings of the data sheet; `factor` is the share left at the site.
    pub fn standstill_in_sheet(&self, factor: f64) -> f64 {
        self.capped(self.continuous.standstill / factor, 0.0)
    }

    /// Assumptions for missing data, for any kind of motor.
    pub fn assumed(&self) -> &[Sentence] {
        &self.assumptions
    }

    /// Assumptions for missing data.
    pub fn assumptions(&self) -> Vec<String> {
        let sentences = self.assumptions.iter();
        sentences.map(|sentence| sentence(self.words)).collect()
    }

    /// The limit of the short-time torque in the quadrants where power flows to the shaft, or, `braking`, from it.
    #[inline]
    pub const fn limit(&self, braking: bool) -> &Limit {
        if braking {
            &self.braking
        } else {
            &self.driving
        }
    }

    /// Largest short-time torque in the direction of `torque` (N·m) at `speed` (rad/s); zero beyond the maximum speed.
    #[inline]
    pub fn peak_torque(&self, torque: f64, speed: f64) -> f64 {
        self.limit(torque * speed < 0.0).torque(speed.abs())
    }

    /// |`torque`| as a share of the peak torque at `speed`; infinite if that is zero.
    #[inline]
    pub fn peak_used(&self, torque: f64, speed: f64) -> f64 {
        let limit = self.peak_torque(torque, speed);
        if limit > 0.0 {
            torque.abs() / limit
        } else if torque == 0.0 {
            0.0
        } else {
            f64::INFINITY
        }
    }

    /// Continuous (S1) torque at `speed` (rad/s), never more than the peak torque; zero beyond the maximum speed.
    pub fn continuous_torque(&self, speed: f64) -> f64 {
        let speed = speed.abs();
        if speed > self.max_speed {
            return 0.0;
        }
        self.capped(self.continuous.torque(speed), speed)
    }

    /// The same short-time torques up to `by` times the speed; the S1 torque stays.
    #[must_use]
    pub fn stretched(&self, by: f64) -> Self {
        Self {
            driving: self.driving.stretched(by),
            braking: self.braking.stretched(by),
            max_speed: self.max_speed * by,
            ..self.clone()
        }
    }

    /// A torque limited by the peak torque; an unknown one stays unknown.
    fn capped(&self, torque: f64, speed: f64) -> f64 {
        if torque.is_finite() {
            torque.min(self.driving.torque(speed))
        } else {
            torque
        }
    }
}

/// Limits of a motor on one amplifier at its supply, computed once for all drives with this pair.
#[derive(Clone, Debug)]
pub struct MotorLimits {
    /// Peak and continuous torque over speed.
    pub envelope: Envelope,
    /// Torque with which the motor brakes in an emergency stop (N·m): an amplifier delivers its peak current at any temperature.
    pub stop: f64,
    /// Current of a torque; `None` if no torque constant is given.
    pub torques: Option<CurrentCurve>,
    /// The circuit from which the envelope is computed; `None` if it comes from the data sheet's speeds and torques.
    pub circuit: Option<Circuit>,
    /// The voltage of the supply against the voltages that motor and amplifier are made for.
    pub(crate) voltages: Voltages,
    /// Limits of the motor on each of its amplifiers, by key.
    amplified: Box<[(String, Self)]>,
}

impl MotorLimits {
    /// The limits of a motor, with its amplifier if one is chosen.
    pub fn new(motor: &Motor, amplifier: Option<&Amplifier>, site: &Site) -> Self {
        let builder = Builder::new(motor, amplifier, site);
        let (torques, circuit) = (builder.torques, builder.circuit());
        let envelope = builder.build();
        let reduced = amplifier.is_some_and(|a| a.derated(&site.surroundings).factor < 1.0);
        let stop = if reduced {
            let cool = Site {
                surroundings: Surroundings::default(),
                ..site.clone()
            };
            Envelope::at(motor, amplifier, &cool).peak_torque(-1.0, 0.0)
        } else {
            envelope.peak_torque(-1.0, 0.0)
        };
        Self {
            torques,
            circuit,
            voltages: Voltages::new(motor, amplifier, site),
            stop,
            envelope,
            amplified: Box::default(),
        }
    }

    /// A message if motor or amplifier is known not to be made for the voltage of the supply.
    pub fn unfit(&self, rules: &RuleSet) -> Option<String> {
        let motor = ("motor", Rule::MotorVoltage, Some(self.voltages.motor));
        let amplifier = ("amplifier", Rule::AmplifierVoltage, self.voltages.amplifier);
        let mut parts = [motor, amplifier].into_iter();
        let refused = |rule, finding| rules.verdict(rule, finding) == RuleVerdict::Fail;
        parts.find_map(|(part, rule, finding)| {
            let finding = finding.filter(|finding| refused(rule, *finding))?;
            Some(format!(
                "the {part} is not made for this supply: up to {} V on the bus, {} V allowed; `jred size` refuses the drive",
                short(finding.value),
                short(finding.rating)
            ))
        })
    }

    /// Adds the motor's limits on each of these amplifiers.
    #[must_use]
    pub fn with<'a>(
        mut self,
        motor: &Motor,
        amplifiers: impl Iterator<Item = &'a Amplifier>,
        site: &Site,
    ) -> Self {
        let on = |a: &Amplifier| (a.key.clone(), Self::new(motor, Some(a), site));
        self.amplified = amplifiers.map(on).collect();
        self
    }

    /// The limits on this amplifier if it was added, else on the motor alone.
    pub fn on(&self, amplifier: Option<&Amplifier>) -> &Self {
        let named = |a: &Amplifier| self.amplified.iter().find(|(key, _)| *key == a.key);
        amplifier.and_then(named).map_or(self, |(_, on)| on)
    }

    /// Current (A, RMS of a three-phase motor) of a torque (N·m) at a speed (rad/s), including field weakening where the envelope uses it; `None` if
    /// no torque constant is given.
    pub fn current(&self, torque: f64, speed: f64) -> Option<f64> {
        let along = self.torques?.current(torque);
        Some(match &self.circuit {
            Some(circuit) if circuit.weakens => {
                let along = if torque * speed < 0.0 { -along } else { along };
                circuit.total_current(along, speed.abs())
            }
            _ => along,
        })
    }
}

impl Catalogue {
    /// Every motor's limits at the supply of the site, with each of its amplifiers, in the order of the motors.
    pub fn prepare(&self, site: &Site) -> Vec<MotorLimits> {
        let prepare = |(index, motor)| {
            let amplifiers = self.amplifiers_of(index).into_iter();
            MotorLimits::new(motor, None, site).with(motor, amplifiers, site)
        };
        self.motors.iter().enumerate().map(prepare).collect()
    }
}
