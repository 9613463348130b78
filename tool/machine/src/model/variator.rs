//! A friction variator between the motor and the drive train.
//!
//! Its ratio is shifted in time, so the constraint between its shafts is not integrable: the angle of the drive link is not
//! a function of the motor's angle, and there is no one table J_red(φ) of the motor shaft. What remains is the equation of
//! motion, [`simulate`](crate::analysis::simulate).

use jred::Error;
use jred::friction::{
    Arrangement, Contact, Course, CreepContact, Drive, Dual, Flow, OperatingPoint, Ramp, RampShape,
    Stage, Variable,
};
use jred::machine::motion::Law;
use miette::{Report, miette};

use crate::model::machine::MachineFile;
use crate::number::spline::{Fault, Spline, Way};

/// A variator as the machine file gives it.
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slip {
    /// None, or a constant one.
    Constant {
        /// ε
        share: f64,
        /// Which way power flows.
        flow: Flow,
        /// Whether it loses power.
        contact: Contact,
    },
    /// Slip that grows with the load, up to the limit of friction.
    Creep(CreepContact),
}

/// A ratio i = ω₂/ω₁ that is shifted in time: by shifts one after another, or by a curve through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Ratio {
    start: f64,
    shifts: Vec<Shift>,
    curve: Option<Curve>,
}

/// A curve through points, level at both ends and constant beyond them.
#[derive(Clone, Debug, PartialEq)]
struct Curve {
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

impl Ratio {
    /// A ratio that stays `start`.
    pub const fn new(start: f64) -> Self {
        Self {
            start,
            shifts: Vec::new(),
            curve: None,
        }
    }

    /// A ratio that follows a twice continuously differentiable curve through points in time (s), which is level at both ends and stays the
    /// same beyond them; and its smallest value with its time.
    ///
    /// # Errors
    /// Too few points, or times that do not rise.
    pub fn through(times: &[f64], ratios: &[f64]) -> Result<(Self, [f64; 2]), Fault> {
        let spline = Spline::bounded(times, ratios, Way::Level)?;
        let (least, at) = spline.least();
        let ratio = Self {
            curve: Some(Curve {
                times: times.to_vec(),
                spline,
            }),
            ..Self::new(ratios.first().copied().unwrap_or(1.0))
        };
        Ok((ratio, [at, least]))
    }

    /// The ratio after the last shift.
    pub fn last(&self) -> f64 {
        let value = |shift: &Shift| shift.course.at(OperatingPoint::at_time(shift.to)).value;
        self.shifts.last().map_or(self.start, value)
    }

    /// When the last shift, or the curve, ends (s).
    pub fn end(&self) -> f64 {
        let shifted = self.shifts.last().map(|shift| shift.to);
        let curve = self.curve.as_ref();
        let drawn = curve.and_then(|curve| curve.times.last().copied());
        shifted.or(drawn).unwrap_or(f64::NEG_INFINITY)
    }

    /// With one more shift to the ratio `to`, from the time `at` (s) over `duration` (s), after the last one.
    ///
    /// # Errors
    /// A duration that is not positive, or a value that is not finite.
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

    /// The times at which a shift begins or ends, and those of the points of a curve (s), where a derivative of the motion jumps.
    pub fn breaks(&self) -> impl Iterator<Item = f64> {
        let points = self.curve.iter().flat_map(|curve| &curve.times);
        let shifts = self.shifts.iter().flat_map(|s| [s.from, s.to]);
        shifts.chain(points.copied())
    }

    /// Whether it stays the same.
    pub const fn is_constant(&self) -> bool {
        self.shifts.is_empty() && self.curve.is_none()
    }
}

impl Course for Ratio {
    fn at(&self, at: OperatingPoint) -> Dual<3> {
        if let Some(curve) = &self.curve {
            let [ratio, slope, ..] = curve.spline.at(at.t.value);
            return at.t.through(ratio, slope);
        }
        let begun = self.shifts.partition_point(|s| s.from <= at.t.value);
        let current = begun.checked_sub(1).and_then(|k| self.shifts.get(k));
        current.map_or(Dual::constant(self.start), |s| s.course.at(at))
    }
}

impl Variator {
    /// The one stage that it is; of a creeping contact, without its slip.
    ///
    /// # Errors
    /// None for a variator that was read without error.
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

/// Whether the angles of the variator's shafts are related, in words; nothing for a machine without one.
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

/// Refuses a machine with a variator for a command that needs one table of the drive link, or one motion of it, for the
/// motor.
///
/// # Errors
/// The machine has a variator.
pub fn refuse(file: &MachineFile, command: &str) -> Result<(), Report> {
    let Some(variator) = &file.variator else {
        return Ok(());
    };
    let (why, help) = if variator.ratio.is_constant() {
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
    Err(miette!(
        help = help,
        "`jred {command}` cannot be used with a [variator]: {why}"
    ))
}
