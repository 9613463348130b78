//! Temperature of a motor over the cycle.
//!
//! The data given determine the model:
//!
//! | known | model |
//! |---|---|
//! | winding's resistance and current, both thermal resistances, both time constants | [`Model::Bodies`], winding and housing |
//! | the same with only the winding's time constant | winding and housing, with constant housing temperature |
//! | winding's resistance and current, thermal resistance, time constant of the motor as a whole | [`Model::Bodies`], one body |
//! | the same without a time constant | [`Model::Steady`]: mean losses; the ripple over the cycle is not computed |
//! | S1 torques | [`Model::Relative`]: shares of the rated rise, from the squared torque |
//!
//! In the relative model the S1 torque causes the rated rise at each speed, so p(T, n) = T²/M₀² + max(0, 1 − T_S1(n)²/M₀²) are the losses as a share
//! of the rated ones, and τ·ϑ′ = p − ϑ. The loss of S1 torque from standstill to a speed represents friction and iron losses there. Without time
//! constants only the mean losses count: [`mean`].

pub mod classify;
pub mod loss_curve;
pub mod mean;
pub mod network;

use std::fmt::Display;

use crate::catalogue::Motor;
use crate::cycle::Cycle;
use crate::cycle::form::Coefficients;
use crate::motor::envelope::MotorLimits;
use crate::motor::winding::{COPPER, REFERENCE_TEMPERATURE};
use jred_analysis::duty::Panel;
use jred_file::units::{Sentence, Vocabulary};

use jred_file::model::operation::Operation;
use jred_file::model::surroundings::Surroundings;
use loss_curve::{LossCurve, LossPiece, LossSample, MOST_PARTS, PART, PeakRise};
use network::{Losses, Network};

/// Housing time constant assumed when none is given, as a multiple of the longest other one.
const SLOW_FACTOR: f64 = 1e6;

/// A thermal model of a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model {
    /// Bodies with time constants; losses in W, rises in K.
    Bodies {
        /// The bodies.
        network: Network,
        /// Copper loss over squared current (W/A²), with the winding at ambient temperature or at the stated one.
        copper: f64,
        /// Whether the housing's time constant is given (or there is only one body).
        follows_housing: bool,
    },
    /// Thermal resistances without time constants: mean losses, steady rises in K.
    Steady {
        /// Winding to housing, housing to surroundings (K/W).
        resistances: [f64; 2],
        /// Copper loss over squared current (W/A²), with the winding at ambient temperature or at the stated one.
        copper: f64,
        /// Growth of the copper loss (1/K).
        growth: f64,
    },
    /// Shares of the rated rise.
    Relative {
        /// Torque that causes the rated rise at standstill (N·m).
        standstill: f64,
        /// S1 torque at standstill (N·m) at the site.
        s1: f64,
        /// Time constant (s), if given.
        time: Option<f64>,
    },
}

/// Heat sources of a motor in a drive over a cycle.
#[derive(Clone, Copy, Debug)]
pub struct Load<'a> {
    /// The cycle.
    pub cycle: &'a Cycle,
    /// The drive's torque as a linear form.
    pub coefficients: &'a Coefficients,
    /// Its ratio.
    pub ratio: f64,
    /// Its motor.
    pub motor: &'a Motor,
    /// Limits of the motor.
    pub prepared: &'a MotorLimits,
}

/// Result of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating {
    /// The hottest rises; in K, or as shares of the rated rise.
    pub hottest: PeakRise,
    /// Whether they are shares of the rated rise.
    pub relative: bool,
    /// Whether the housing's rise was computed.
    pub housing: bool,
    /// Whether the ripple over the cycle was computed.
    pub ripple: bool,
}

impl Heating {
    /// The basis of the temperatures, if some data for the models are missing; `torque` is the word for the motor's effort.
    pub fn notes(&self, torque: impl Display) -> Vec<String> {
        let mut notes = Vec::new();
        if self.hottest == PeakRise::Runaway {
            notes.push("thermal runaway: copper losses rise faster with temperature than the heat flow to the surroundings".to_owned());
        }
        if self.relative {
            notes.push(format!(
                "estimated from the RMS {torque} (thermal resistances and winding data not given)"
            ));
        }
        if !self.ripple {
            notes.push(
                "based on mean losses; temperature ripple ignored (no time constants given)"
                    .to_owned(),
            );
        }
        notes
    }
}

fn usable(figure: Option<f64>) -> Option<f64> {
    figure.filter(|x| x.is_finite() && *x > 0.0)
}

impl Model {
    /// The model for the given data.
    ///
    /// # Errors
    /// The missing data, as a message.
    pub fn of(
        motor: &Motor,
        prepared: &MotorLimits,
        surroundings: &Surroundings,
        cycle_time: f64,
    ) -> Result<Self, Sentence> {
        let thermal = &motor.thermal;
        let reference = surroundings.resistance_at.unwrap_or(surroundings.ambient);
        let resistance = usable(motor.winding.loss_resistance(reference));
        let growth = match surroundings.resistance_at {
            Some(_) => 0.0,
            None => COPPER / (1.0 + COPPER * (surroundings.ambient - REFERENCE_TEMPERATURE)),
        };
        let to_housing = usable(thermal.winding_resistance);
        let to_air = usable(thermal.housing_resistance);
        let times = [thermal.winding_time, thermal.housing_time].map(usable);
        let copper = resistance.filter(|_| prepared.torques.is_some());
        let bodies = |network, copper, follows_housing| Self::Bodies {
            network,
            copper,
            follows_housing,
        };
        if let Some((copper, first)) = copper.zip(to_housing.or(to_air)) {
            let both = to_housing.zip(to_air);
            return Ok(match (both, times) {
                (Some((w, h)), [Some(tw), Some(th)]) => {
                    bodies(Network::two([w, h], [tw, th], growth), copper, true)
                }
                (Some((w, h)), [Some(tw), None]) => {
                    let th = SLOW_FACTOR * tw.max(cycle_time);
                    bodies(Network::two([w, h], [tw, th], growth), copper, false)
                }
                (_, [None, None]) => Self::Steady {
                    resistances: [to_housing.unwrap_or(0.0), to_air.unwrap_or(0.0)],
                    copper,
                    growth,
                },
                (_, [winding, whole]) => {
                    let total = both.map_or(first, |(w, h)| w + h);
                    let time = whole.or(winding).unwrap_or(f64::INFINITY);
                    bodies(Network::one(total, time, growth), copper, true)
                }
            });
        }
        if motor.rated_torque.is_none() && motor.continuous_curve.is_empty() {
            return Err(|Vocabulary { torque, .. }| {
                format!("S1 {torque} over speed (thermal resistances and winding data not given)")
            });
        }
        let s1 = prepared.envelope.standstill();
        if !(s1.is_finite() && s1 > 0.0) {
            return Err(|Vocabulary { torque, .. }| {
                format!(
                    "S1 {torque}, or resistance, {torque} constant and thermal resistances of the winding"
                )
            });
        }
        let [winding, whole] = times;
        let derated = motor.derated(surroundings);
        Ok(Self::Relative {
            // The site reduces the rise, not the torque for the same rise, unless the maker states it so.
            standstill: prepared.envelope.standstill_in_sheet(derated.factor) * derated.torque,
            s1,
            time: whole.or(winding),
        })
    }

    /// The losses over a cycle: at every instant the torque's copper loss and the motor's friction, or shares of the rated
    /// losses.
    pub fn course(&self, load: &Load) -> LossCurve {
        let Load {
            cycle,
            coefficients,
            ratio,
            motor,
            prepared,
        } = *load;
        let at =
            |t: f64, [torque, speed]: [f64; 2]| self.point(motor, prepared, t, [torque, speed]);
        let mut pieces = Vec::new();
        let longest = self.network().map_or(f64::INFINITY, |n| PART * n.fastest());
        let is_known = cycle.each_panel(coefficients, ratio, |panel, torques, speeds| {
            let between = |x: f64| {
                let point = at(0.0, [torques.at(x), speeds.at(x)]);
                [point.root * point.root, point.other]
            };
            let known = torques.known().iter().zip(speeds.known());
            let known = known.map(|(torque, speed)| at(0.0, [*torque, *speed]));
            let known: Vec<[f64; 2]> = known.map(|p| [p.root * p.root, p.other]).collect();
            let parts = (2.0 * panel.half() / longest).ceil().clamp(1.0, MOST_PARTS);
            pieces.extend(pieces_of(panel, &known, &between, parts));
        });
        if is_known {
            return LossCurve::of_pieces(pieces, cycle.duration());
        }
        let points: Vec<LossSample> = (cycle.samples().iter())
            .map(|sample| {
                let torque = coefficients.torque(&sample.loads());
                at(sample.t, [torque, sample.speed() * ratio])
            })
            .collect();
        LossCurve::new(&points, cycle.duration())
    }

    /// The losses of a motor at a time (s), a torque (N·m) and a speed of its own (rad/s).
    pub fn point(
        &self,
        motor: &Motor,
        prepared: &MotorLimits,
        t: f64,
        [torque, signed]: [f64; 2],
    ) -> LossSample {
        let [coulomb, viscous] = motor.friction;
        let speed = signed.abs();
        let other = match self {
            Self::Bodies { .. } | Self::Steady { .. } => (coulomb + viscous * speed) * speed,
            Self::Relative { s1, .. } => {
                let s1 = prepared.envelope.continuous_torque(speed) / s1;
                (1.0 - s1 * s1).max(0.0)
            }
        };
        LossSample {
            t,
            root: self.root(prepared, torque, signed),
            other,
        }
    }

    /// The bodies that heat up over time; in the relative model one body, whose rise is a share of the rated one. `None` without time constants.
    pub fn network(&self) -> Option<Network> {
        match *self {
            Self::Bodies { network, .. } => Some(network),
            Self::Relative { time, .. } => time.map(|time| Network::one(1.0, time, 0.0)),
            Self::Steady { .. } => None,
        }
    }

    /// Root of the copper loss (√W), or of its share of the rated one, with the sign of the torque.
    fn root(&self, prepared: &MotorLimits, torque: f64, speed: f64) -> f64 {
        match self {
            Self::Bodies { copper, .. } | Self::Steady { copper, .. } => {
                let current = prepared.current(torque, speed).unwrap_or(0.0);
                (current * copper.sqrt()).copysign(torque)
            }
            Self::Relative { standstill, .. } => torque / standstill,
        }
    }

    /// The losses while the motor holds the machine at rest with `torque` (N·m); zero: without current.
    pub fn at_rest(&self, prepared: &MotorLimits, torque: f64) -> Losses {
        let root = self.root(prepared, torque, 0.0);
        Losses {
            copper: root * root,
            other: 0.0,
        }
    }

    /// The hottest rises in an operation of a cycle; `rest` are the losses at rest.
    ///
    /// # Errors
    /// The missing data, as a message.
    pub fn heating(
        &self,
        load: &Load,
        operation: &Operation,
        rest: Losses,
    ) -> Result<Heating, Sentence> {
        let (course, mean) = (|| self.course(load), || self.mean_losses(load));
        self.heated(course, mean, operation, rest)
    }

    /// The same from losses over a cycle or from their mean, as the model requires.
    ///
    /// # Errors
    /// The missing data, as a message.
    pub fn heated(
        &self,
        course: impl Fn() -> LossCurve,
        mean: impl Fn() -> Losses,
        operation: &Operation,
        rest: Losses,
    ) -> Result<Heating, Sentence> {
        let from_cold = matches!(operation, Operation::Short { .. });
        let mean = || {
            let running = operation.running().unwrap_or(1.0);
            let mean = mean();
            Losses {
                copper: running * mean.copper + (1.0 - running) * rest.copper,
                other: running * mean.other,
            }
        };
        let hottest = |network: &Network| course().hottest(network, operation, rest);
        let steady = |resistances, growth| match network::steady(resistances, mean(), growth) {
            Some(rise) => PeakRise::Rise(rise),
            None => PeakRise::Runaway,
        };
        let (hottest, ripple) = match *self {
            Self::Bodies {
                follows_housing: false,
                ..
            } if from_cold => {
                return Err(|_| {
                    "thermal time constant of the housing, required for operation from cold"
                        .to_owned()
                });
            }
            Self::Bodies { network, .. } => (hottest(&network), true),
            Self::Steady { .. } | Self::Relative { time: None, .. } if from_cold => {
                return Err(|_| {
                    "thermal time constants, required for operation from cold".to_owned()
                });
            }
            Self::Steady {
                resistances,
                growth,
                ..
            } => (steady(resistances, growth), false),
            Self::Relative { .. } => match self.network() {
                Some(network) => (hottest(&network), true),
                None => (steady([0.0, 1.0], 0.0), false),
            },
        };
        let relative = matches!(self, Self::Relative { .. });
        let housing = match self {
            Self::Bodies { network, .. } => network.has_housing(),
            Self::Steady { resistances, .. } => resistances.iter().all(|r| *r > 0.0),
            Self::Relative { .. } => false,
        };
        Ok(Heating {
            hottest,
            relative,
            housing,
            ripple,
        })
    }
}

/// Allowed error of the moments of the losses over a panel from its samples, as a share of the losses.
const MOMENT_TOLERANCE: f64 = 1e-10;

/// The losses over a panel in a number of pieces. Their moments come from the panel's quadrature, with the losses at its samples or `between` them. A
/// piece in which they bend is halved.
fn pieces_of(
    panel: &Panel,
    known: &[[f64; 2]],
    between: &impl Fn(f64) -> [f64; 2],
    parts: f64,
) -> Vec<LossPiece> {
    let rule = panel.rule();
    let values = |which: usize| -> Vec<f64> { known.iter().map(|losses| losses[which]).collect() };
    let estimates = [0, 1].map(|which| rule.estimate(&values(which)));
    let least = MOMENT_TOLERANCE * (estimates[0].size + estimates[1].size);
    let constant =
        (known.windows(2)).all(|two| two[0].map(f64::to_bits) == two[1].map(f64::to_bits));
    let parts = if constant { 1.0 } else { parts };
    let mut pieces = Vec::with_capacity(parts as usize);
    let mut k = 0.0;
    while k < parts {
        let [a, b] = [k, k + 1.0].map(|k| 2.0 * k / parts - 1.0);
        // From −½ to ½.
        let share = |x: f64| (x - a.midpoint(b)) / (b - a);
        let moments = |which: usize| {
            if parts <= 1.0 {
                let found = estimates[which];
                if found.error <= least || !found.error.is_finite() {
                    let values = values(which);
                    let places = rule.places().iter().zip(rule.weights()).zip(&values);
                    return places.fold([0.0; 3], |[m, first, second], ((x, weight), value)| {
                        let (x, part) = (0.5 * x, 0.5 * weight * value);
                        [m + part, first + part * x, second + part * x * x]
                    });
                }
            }
            [0, 1, 2].map(|power| {
                let f = |x: f64| between(x)[which] * share(x).powi(power);
                rule.adaptive([a, b], (MOMENT_TOLERANCE, least), &f) / (b - a)
            })
        };
        let time = panel.half() * (b - a);
        pieces.push(LossPiece::of_moments(time, moments(0), moments(1)));
        k += 1.0;
    }
    pieces
}

/// Allowed rise (K, or as a share of the rated rise); `None` without data.
pub fn allowed_rise(motor: &Motor, surroundings: &Surroundings, relative: bool) -> Option<f64> {
    if relative {
        return Some(motor.derated(surroundings).rise);
    }
    let limit = usable(motor.thermal.max_temperature)?;
    Some(surroundings.altitude_factor() * (limit - surroundings.ambient))
}
