//! Data from which an envelope is built, and assumptions for missing data.

use super::circuit::Circuit;
use super::continuous::Continuous;
use super::limit::{Limit, LimitPiece};
use super::{Envelope, voltage};
use crate::catalogue::Commutation;
use crate::catalogue::{Amplifier, Motor, VOLTAGE_CLASS};
use crate::motor::winding::{CurrentCurve, PLAUSIBLE, REFERENCE_TEMPERATURE, usable};
use jred_file::math;
use jred_file::model::site::Site;
use jred_file::units::{Sentence, Vocabulary};

/// Motor data from which an envelope is built.
pub(super) struct Builder<'a> {
    motor: &'a Motor,
    /// Actual bus voltage over that of the data sheet.
    share: f64,
    /// Factor of the S1 torque at the site.
    factor: f64,
    /// Current of a torque.
    pub(super) torques: Option<CurrentCurve>,
    /// The winding at the actual voltage, without reactance if that is not given.
    line: Option<Circuit>,
    /// Peak torque (N·m).
    peak: f64,
    /// Torque at the peak current of the amplifier (N·m).
    cap: f64,
    assumptions: Vec<Sentence>,
}

/// A value; infinite if it is not usable.
fn known(figure: Option<f64>) -> f64 {
    usable(figure).unwrap_or(f64::INFINITY)
}

/// The usable points: increasing speeds, non-increasing torques.
fn falling(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for &[speed, torque] in points {
        let (last, most) = kept.last().map_or((-1.0, f64::INFINITY), |p| (p[0], p[1]));
        let plausible = |x: f64| x == 0.0 || PLAUSIBLE.contains(&x);
        if speed > last && plausible(speed) && plausible(torque) {
            kept.push([speed, torque.min(most)]);
        }
    }
    kept
}

impl<'a> Builder<'a> {
    pub(super) fn new(motor: &'a Motor, amplifier: Option<&Amplifier>, site: &Site) -> Self {
        let mut assumptions: Vec<Sentence> = Vec::new();
        let torques = CurrentCurve::of(motor);
        let sheet = usable(motor.figures_voltage());
        let actual =
            usable(site.bus_voltage).or(usable(amplifier.and_then(Amplifier::nominal_voltage)));
        let share = match (actual, sheet) {
            (Some(actual), Some(sheet)) => actual / sheet,
            _ => 1.0,
        };
        let line = circuit(motor, torques.as_ref(), actual.or(sheet));
        let mut peak = known(motor.peak_torque);
        if motor.peak_torque.is_none()
            && let (Some(torques), Some(current)) = (torques, usable(motor.winding.peak_current))
        {
            peak = torques.torque(current);
            assumptions.push(|Vocabulary { torque, .. }| {
                format!("peak {torque} not given; using the {torque} at peak current")
            });
        }
        let cap = match (amplifier, torques) {
            (Some(amplifier), Some(torques)) => {
                let [_, peak] = amplifier.currents(&site.surroundings);
                torques.torque(known(Some(peak)))
            }
            (Some(_), None) => {
                assumptions.push(
                    |Vocabulary { torque, .. }| format!("{torque} constant not given; peak {torque} not limited by the amplifier's current"),
                );
                f64::INFINITY
            }
            (None, _) => f64::INFINITY,
        };
        if actual.is_some() && sheet.is_none() && line.is_none() {
            assumptions.push(|_| {
                "bus voltage of the motor data not given; using the data at any supply voltage"
                    .to_owned()
            });
        }
        if share > VOLTAGE_CLASS {
            assumptions.push(
                |_| "the supply voltage is more than 4/3 of the voltage that the motor data are for; the effect on \
                 the bearings is not checked".to_owned(),
            );
        }
        Self {
            motor,
            share,
            factor: motor.derated(&site.surroundings).factor,
            torques,
            line,
            peak,
            cap,
            assumptions,
        }
    }

    /// The voltage line of the winding, if enough data are given and the data sheet does not give the envelope itself.
    pub(super) fn circuit(&self) -> Option<Circuit> {
        let motor = self.motor;
        let points = !motor.peak_curve.is_empty();
        let figures =
            usable(motor.corner_speed).is_some() && usable(motor.torque_at_max_speed).is_some();
        if points || figures {
            return None;
        }
        let winding = &motor.winding;
        let whole = winding.commutation == Commutation::Block
            || (usable(winding.inductance).is_some() && usable(winding.pole_pairs).is_some());
        let torques = self.torques?;
        let mut circuit = self.line.filter(|_| whole)?;
        let peak = self.peak.min(self.cap);
        // The corner in the data sheet shows how much of the voltage the drive uses.
        if let Some(corner) = usable(motor.corner_speed).filter(|_| self.peak.is_finite()) {
            let current = torques.current(self.peak);
            let along = circuit.drop * current + circuit.flux * corner;
            circuit.voltage = self.share * math::hypot(along, circuit.reactance * corner * current);
        }
        circuit.current = torques.current(peak);
        let stated = known(motor.max_speed);
        let beyond = stated.is_finite() && stated > circuit.no_load_speed() / self.share;
        circuit.weakens = beyond && circuit.reactance > 0.0 && circuit.current.is_finite();
        // If the data sheet exceeds what the winding allows, the data sheet is used.
        let explained = circuit.weakens || !beyond || motor.corner_speed.is_none();
        let plausible = circuit.voltage.is_finite() && circuit.no_load_speed() > 0.0;
        (explained && plausible).then_some(circuit)
    }

    pub(super) fn build(mut self) -> Envelope {
        let motor = self.motor;
        let winding = self.circuit().zip(self.torques);
        let [driving, braking] = if let Some((circuit, torques)) = winding {
            self.by_winding(&circuit, &torques)
        } else {
            let mut limit = self.by_figures();
            if self.cap.is_finite() {
                limit = limit.min(&Limit::level(self.cap, f64::INFINITY));
            }
            [limit.clone(), limit]
        };
        let rated = known(motor.rated_torque);
        let points = falling(&motor.continuous_curve);
        if motor.standstill_torque.is_none() && rated.is_finite() && points.is_empty() {
            self.assumptions.push(|Vocabulary { torque, .. }| {
                format!("standstill {torque} not given; using the rated {torque}")
            });
        }
        if motor.rated_speed.is_none() && rated.is_finite() && points.is_empty() {
            self.assumptions.push(|Vocabulary { torque, .. }| {
                format!(
                    "rated speed not given; using the rated {torque} as S1 {torque} at every speed"
                )
            });
        }
        Envelope {
            max_speed: driving.end(),
            driving,
            braking,
            continuous: Continuous::of(motor, known, points).times(self.factor),
            assumptions: self.assumptions,
            words: motor.kind.vocabulary(),
        }
    }

    fn by_winding(&mut self, circuit: &Circuit, torques: &CurrentCurve) -> [Limit; 2] {
        let motor = self.motor;
        if motor.max_speed.is_none() {
            self.assumptions.push(|_| {
                "maximum speed not given; using the no-load speed of the winding".to_owned()
            });
        }
        self.assumptions.push(if motor.corner_speed.is_some() {
            |Vocabulary { torque, .. }| format!("peak {torque} at maximum speed not given; using the winding's voltage line through the corner")
        } else {
            |Vocabulary { torque, .. }| format!("corner of the peak {torque} not given; using peak {torque} up to the winding's voltage line")
        });
        self.assumptions
            .push(if usable(motor.thermal.max_temperature).is_some() {
                |_| "using the winding resistance at maximum temperature".to_owned()
            } else {
                |_| {
                    "maximum winding temperature not given; using the winding resistance at 20 °C"
                        .to_owned()
                }
            });
        match motor.winding.commutation {
            Commutation::Block => {}
            Commutation::Sine if circuit.weakens => self.assumptions.push(|_| {
                "field weakening assumed: the maximum speed is above the no-load speed".to_owned()
            }),
            Commutation::Sine => self
                .assumptions
                .push(|_| "no field weakening assumed".to_owned()),
        }
        // The circuit's largest current belongs to the peak torque, including the amplifier's limit.
        let end = circuit.largest_speed(known(motor.max_speed));
        [false, true].map(|braking| voltage::limit(circuit, torques, braking, end))
    }

    /// From points, or from corner and torque at the largest speed; the same in all four quadrants.
    fn by_figures(&mut self) -> Limit {
        let motor = self.motor;
        let rated_torque = known(motor.rated_torque);
        let rated_speed = known(motor.rated_speed);
        let points = falling(&motor.peak_curve);
        let last = points.last().map(|p| p[0]);
        if motor.max_speed.is_none() && last.is_none() && rated_speed.is_finite() {
            self.assumptions
                .push(|_| "maximum speed not given; using the rated speed".to_owned());
        }
        let stated = known(motor.max_speed.or(last).or(Some(rated_speed)));
        let mut is_assumed = false;
        let vertices = if points.is_empty() {
            let corner = motor.corner_speed.map(|n| known(Some(n)));
            is_assumed = corner.is_none();
            let corner = corner.unwrap_or_else(|| {
                if self.peak.is_finite() && rated_speed.is_finite() {
                    self.assumptions.push(
                        |Vocabulary { torque, .. }| format!("corner of the peak {torque} not given; using peak {torque} up to rated speed"),
                    );
                }
                rated_speed
            });
            let corner = corner.min(stated);
            let end = if stated > corner && self.peak.is_finite() {
                usable(motor.torque_at_max_speed).unwrap_or_else(|| {
                    self.assumptions.push(
                        |Vocabulary { torque, .. }| format!("peak {torque} at maximum speed not given; using a straight line to the rated {torque}"),
                    );
                    rated_torque
                })
            } else {
                self.peak
            };
            vec![[corner, self.peak], [stated, end.min(self.peak)]]
        } else {
            points
        };
        let top = stated.min(vertices.last().map_or(stated, |p| p[0]));
        let share = self.share(is_assumed);
        let limit = if is_one(share) {
            through(&vertices)
        } else {
            through(&self.moved(&vertices, share, top))
        };
        let limit = limit.min(&Limit::level(self.peak, top));
        match self.at_standstill(share) {
            Some(most) => limit.min(&Limit::level(most, f64::INFINITY)),
            None => limit,
        }
    }

    /// Factor by which the voltage changes the speeds; adds an assumption.
    fn share(&mut self, is_assumed: bool) -> f64 {
        if is_one(self.share) {
            return 1.0;
        }
        if self.share > 1.0 && is_assumed {
            self.assumptions.push(|_| {
                "bus voltage above that of the data sheet; the assumed corner is not raised"
                    .to_owned()
            });
            return 1.0;
        }
        self.assumptions.push(if self.line.is_some() {
            |_| "bus voltage differs from the data sheet; speeds of the envelope shifted along the winding's voltage line".to_owned()
        } else {
            |_| "bus voltage differs from the data sheet; speeds of the envelope scaled in proportion (resistance and voltage constant not given)".to_owned()
        });
        self.share
    }

    /// Vertices at another voltage, and the zero-torque point at the largest speed.
    fn moved(&self, vertices: &[[f64; 2]], share: f64, top: f64) -> Vec<[f64; 2]> {
        let ratio = |torque: f64| match (&self.line, &self.torques) {
            (Some(line), Some(torques)) if torque.is_finite() => {
                let current = torques.current(torque);
                let sheet = Circuit {
                    voltage: line.voltage / share,
                    ..*line
                };
                let before = sheet.speed_of(current);
                if before > 0.0 {
                    line.speed_of(current) / before
                } else {
                    share
                }
            }
            _ => share,
        };
        let mut moved: Vec<[f64; 2]> = vertices.iter().map(|&[n, t]| [n * ratio(t), t]).collect();
        if share < 1.0 && top.is_finite() {
            moved.push([top * share, 0.0]);
        }
        moved
    }

    /// The torque at standstill that a lower voltage allows (N·m).
    fn at_standstill(&self, share: f64) -> Option<f64> {
        let (line, torques) = (self.line.filter(|_| share < 1.0)?, self.torques?);
        Some(torques.torque(line.voltage / line.drop))
    }
}

/// Whether the voltage is that of the data sheet, except for rounding.
fn is_one(share: f64) -> bool {
    (share - 1.0).abs() <= f64::EPSILON
}

/// Straight lines through vertices, level before the first.
fn through(vertices: &[[f64; 2]]) -> Limit {
    let Some(&first) = vertices.first() else {
        return Limit::new([]);
    };
    let mut pieces = vec![LimitPiece::level(0.0, first[0], first[1])];
    let mut last = first;
    for &vertex in vertices.get(1..).unwrap_or_default() {
        if vertex[0] > last[0] {
            pieces.push(LimitPiece::line(last, vertex));
            last = vertex;
        } else {
            last = [last[0], vertex[1].min(last[1])];
        }
    }
    Limit::new(pieces)
}

/// The winding of a motor at a bus voltage, as far as data are given.
fn circuit(
    motor: &Motor,
    torques: Option<&CurrentCurve>,
    bus_voltage: Option<f64>,
) -> Option<Circuit> {
    let winding = &motor.winding;
    let commutation = winding.commutation;
    let hot = usable(motor.thermal.max_temperature).unwrap_or(REFERENCE_TEMPERATURE);
    let per_constant = commutation.torque_per_voltage_constant();
    let flux = usable(winding.voltage_constant)
        .or_else(|| Some(torques?.torque_constant() / per_constant))?;
    let drop = commutation.drop_factor();
    let reactance = match (
        commutation,
        usable(winding.inductance),
        usable(winding.pole_pairs),
    ) {
        (Commutation::Sine, Some(inductance), Some(pairs)) => drop * pairs * inductance,
        _ => 0.0,
    };
    usable(winding.resistance)?;
    Some(Circuit {
        voltage: commutation.voltage_share() * bus_voltage?,
        flux,
        drop: drop * winding.resistance_at(hot)?,
        reactance,
        current: f64::INFINITY,
        weakens: false,
    })
}
