//! A friction variator between the motor and the drive train.
//!
//! Its ratio is shifted in time, so the constraint between its shafts is not integrable: the angle of the drive link is not a function of the motor's
//! angle, and there is no unique table J_red(φ) at the motor shaft. What remains is the equation of motion, which `jred simulate` integrates.

use crate::problem;
use crate::text::problem::Problem;
use jred::error::Error;
use jred::friction::{
    Arrangement, Contact, Course, CreepContact, Drive, Dual, Flow, OperatingPoint, Ramp, RampShape,
    Stage, Traction, Variable,
};
use jred::machine::motion::Law;
use jred_enclosure::Interval;

use crate::model::machine::MachineFile;
use crate::number::formula::Formula;
use crate::number::spline::{FitMethod, Spline, SplineError};

/// A variator of a machine file.
#[derive(Clone, Debug)]
pub struct Variator {
    /// Its ratio over time.
    pub ratio: Ratio,
    /// Its slip.
    pub slip: Slip,
    /// Inertias of its input and output shaft (kg·m²).
    pub inertia: [f64; 2],
}

/// Slip of the contact.
#[derive(Clone, Debug, PartialEq)]
pub enum Slip {
    /// Zero or constant slip.
    Constant {
        /// ε
        share: f64,
        /// Direction of power.
        flow: Flow,
        /// Whether it loses power.
        contact: Contact,
    },
    /// Slip that grows with the load, up to the friction limit.
    Creep(Adhesion),
}

/// Torque of the contact over its slip, up to the friction limit.
#[derive(Clone, Debug, PartialEq)]
pub enum Adhesion {
    /// Proportional, then sliding.
    Line(CreepContact),
    /// A curve through points, the same in both directions; beyond the last one it slides.
    Curve(Spline),
}

impl Adhesion {
    /// A curve through slips and their torques (N·m), both rising from zero.
    ///
    /// # Errors
    /// There are fewer than three points, or slips do not rise.
    pub fn through(slips: &[f64], torques: &[f64]) -> Result<Self, SplineError> {
        let both = |values: &[f64]| {
            let backward = values.iter().rev().map(|value| -value);
            let forward = values.iter().copied();
            // Zero itself is omitted, because a curve of this kind would be level there: the piece between is odd, and so passes through zero.
            backward.chain(forward).collect::<Vec<f64>>()
        };
        let spline = Spline::bounded(&both(slips), &both(torques), FitMethod::Monotone)?;
        Ok(Self::Curve(spline))
    }

    /// Slips at which its torque has a corner.
    pub fn bends(&self) -> [f64; 2] {
        match self {
            Self::Line(contact) => [-1.0, 1.0].map(|side| side * contact.limit().slip),
            Self::Curve(curve) => curve.range(),
        }
    }

    /// The traction at the speeds of the contact's two surfaces, as angular speeds of the output shaft (rad/s).
    pub fn traction(&self, first: f64, second: f64) -> Traction {
        match self {
            Self::Line(contact) => contact.traction(first, second),
            Self::Curve(curve) => {
                CreepContact::traction_by(first, second, |slip| curve.at(slip)[0])
            }
        }
    }
}

/// A varying ratio i = ω₂/ω₁: by successive shifts, by a curve through points in time, or by a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Ratio {
    start: f64,
    shifts: Vec<Shift>,
    whole: Option<RatioFunction>,
}

/// A course that is given as a whole.
#[derive(Clone, Debug, PartialEq)]
enum RatioFunction {
    Curve(RatioCurve),
    Formula(Formula),
}

/// The variables of a formula: the time (s) and the angle of the input shaft (rad).
pub const VARIABLES: [&str; 2] = ["t", "phi"];

/// A curve through points, level at both ends and constant beyond them.
#[derive(Clone, Debug, PartialEq)]
struct RatioCurve {
    times: Vec<f64>,
    spline: Spline,
}

/// One shift.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shift {
    from: f64,
    to: f64,
    course: Ramp,
}

/// Range of a ratio.
pub const RATIOS: [f64; 2] = [1e-3, 1e3];

impl Ratio {
    /// A constant ratio.
    pub const fn new(start: f64) -> Self {
        Self {
            start,
            shifts: Vec::new(),
            whole: None,
        }
    }

    /// A ratio that follows a twice continuously differentiable curve through points in time (s), level at both ends and constant beyond them; and
    /// its smallest value with its time.
    ///
    /// # Errors
    /// There are too few points, or times do not rise.
    pub fn through(times: &[f64], ratios: &[f64]) -> Result<(Self, [f64; 2]), SplineError> {
        let spline = Spline::bounded(times, ratios, FitMethod::Level)?;
        let (least, at) = spline.least();
        let ratio = Self {
            whole: Some(RatioFunction::Curve(RatioCurve {
                times: times.to_vec(),
                spline,
            })),
            ..Self::new(ratios.first().copied().unwrap_or(1.0))
        };
        Ok((ratio, [at, least]))
    }

    /// A ratio by a formula of [`VARIABLES`].
    pub fn by(formula: Formula) -> Self {
        let start = OperatingPoint::at_time(0.0);
        let ratio = Self::new(formula.at(&[start.t, start.phi]).value);
        Self {
            whole: Some(RatioFunction::Formula(formula)),
            ..ratio
        }
    }

    /// An interval that contains all ratios of a formula over these times (s) and angles of the input shaft (rad); `None` if it is not a formula.
    pub fn bounds(&self, t: Interval, phi: Interval) -> Option<Interval> {
        match &self.whole {
            Some(RatioFunction::Formula(formula)) => Some(formula.bounds(&[t, phi])),
            _ => None,
        }
    }

    /// The ratio after the last shift.
    pub fn last(&self) -> f64 {
        let value = |shift: &Shift| shift.course.at(OperatingPoint::at_time(shift.to)).value;
        self.shifts.last().map_or(self.start, value)
    }

    /// End of the last shift, or of the curve (s).
    pub fn end(&self) -> f64 {
        let shifted = self.shifts.last().map(|shift| shift.to);
        let drawn = self.times().last().copied();
        shifted.or(drawn).unwrap_or(f64::NEG_INFINITY)
    }

    /// With one more shift to the ratio `to`, from the time `at` (s) over `duration` (s), after the last one.
    ///
    /// # Errors
    /// The duration is not positive, or a value is not finite.
    pub fn shift(&mut self, at: f64, duration: f64, to: f64, law: Law) -> Result<(), Error> {
        let course = Ramp::new(
            Variable::Time,
            RampShape {
                start: at,
                length: duration,
                values: [self.last(), to],
            },
            law,
        )?;
        self.shifts.push(Shift {
            from: at,
            to: at + duration,
            course,
        });
        Ok(())
    }

    /// The times at which a shift begins or ends, and the times of a curve's points (s): there a derivative of the motion jumps.
    pub fn breaks(&self) -> impl Iterator<Item = f64> {
        let points = self.times().iter();
        let shifts = self.shifts.iter().flat_map(|s| [s.from, s.to]);
        shifts.chain(points.copied())
    }

    /// The times of the points of a curve.
    fn times(&self) -> &[f64] {
        match &self.whole {
            Some(RatioFunction::Curve(curve)) => &curve.times,
            _ => &[],
        }
    }

    /// Whether it changes with time.
    pub fn is_shifted(&self) -> bool {
        match &self.whole {
            Some(RatioFunction::Formula(formula)) => formula.contains(0),
            Some(RatioFunction::Curve(_)) => true,
            None => !self.shifts.is_empty(),
        }
    }

    /// Whether it changes with the angle of the input shaft.
    pub fn is_turned(&self) -> bool {
        matches!(&self.whole, Some(RatioFunction::Formula(formula)) if formula.contains(1))
    }
}

impl Course for Ratio {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        match &self.whole {
            Some(RatioFunction::Curve(curve)) => {
                let [ratio, slope, ..] = curve.spline.at(at.t.value);
                return at.t.through(ratio, slope);
            }
            Some(RatioFunction::Formula(formula)) => return formula.at(&[at.t, at.phi]),
            None => {}
        }
        let begun = self.shifts.partition_point(|s| s.from <= at.t.value);
        let current = begun.checked_sub(1).and_then(|k| self.shifts.get(k));
        current.map_or(Dual::constant(self.start), |s| s.course.at(at))
    }
}

impl Variator {
    /// The variator as a single stage; for a creeping contact, without its slip.
    ///
    /// # Errors
    /// Never for a variator that was read without error.
    pub fn stage(&self) -> Result<Stage<'_>, Error> {
        let stage = Stage::new(&self.ratio)?;
        match self.slip {
            Slip::Constant { share, flow, .. } => Ok(stage.with_slip(share, flow)?),
            Slip::Creep(_) => Ok(stage),
        }
    }

    /// Factor of slip on torques; a creeping contact transmits torque by the ratio of the radii.
    pub const fn contact(&self) -> Contact {
        match self.slip {
            Slip::Constant { contact, .. } => contact,
            Slip::Creep(_) => Contact::Slipping,
        }
    }
}

/// Text on whether the angles of the variator's shafts are related; `None` for a machine without a variator.
pub fn integrability_text(file: &MachineFile) -> Option<String> {
    let variator = file.variator.as_ref()?;
    if let Slip::Creep(_) = variator.slip {
        return Some(
            "variator: not a constraint: its slip depends on the load, so the contact force couples its shafts, and \
             each keeps its degree of freedom"
                .to_owned(),
        );
    }
    let end = file.simulation.as_ref().map_or(0.0, |s| s.duration);
    let last = variator.ratio.end().max(end);
    let answer = variator.stage().and_then(|stage| {
        let drive = Drive::new(Arrangement::Chain, variator.contact(), &[stage])?;
        Ok(drive.integrability([0.0, last], [0.0, std::f64::consts::TAU])?)
    });
    Some(match answer.as_deref() {
        Ok([constraint, ..]) => {
            format!("variator (α_a: input shaft, α_b: output shaft): {constraint}")
        }
        Ok([]) => return None,
        Err(error) => format!("variator: {error}"),
    })
}

/// Refuses a machine with a variator, for a command that needs a unique table of the drive link, or a unique motion of it, for the motor.
///
/// # Errors
/// The machine has a variator.
pub fn refuse(file: &MachineFile, command: &str) -> Result<(), Problem> {
    let Some(variator) = &file.variator else {
        return Ok(());
    };
    let (why, help) = if !variator.ratio.is_shifted() && variator.ratio.is_turned() {
        (
            "its ratio changes with the angle of the input shaft, by which no table of the drive link is made",
            "use `jred simulate` to integrate the motion; for the machine behind the variator alone, remove [variator]",
        )
    } else if !variator.ratio.is_shifted() {
        (
            "a variator can only be simulated, with or without slip",
            "write a constant ratio as a stage: a belt with its efficiency under [[drive_train]], without [variator]",
        )
    } else {
        (
            "its ratio changes with time, so the angle of the drive link is not a function of the motor angle \
             (non-holonomic), and no single table of reduced inertia exists for the motor",
            "use `jred simulate` to integrate the motion; for the machine behind the variator alone, remove [variator]",
        )
    };
    Err(problem!(
        help = help,
        "`jred {command}` cannot be used with a [variator]: {why}"
    ))
}
