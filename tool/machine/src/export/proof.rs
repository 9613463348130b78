//! The error of an exported table, proven over every position.

use jred::image::{encode, identify};
use jred::table::Format;
use jred::{
    Cubic, Domain, Error, Image, Q31, Quadratic, Reducible as _, Rows16, Spline, Spline16, Validity,
};
use jred_enclosure::{Goal, Proof, Unproven, prove};

use super::candidate::{Answer, Made};
use super::choice::{LayoutName, Number};
use super::size::rounded_up;
use super::{Export, Failure, Task, ticks};
use crate::enclose::Enclosed;
use crate::model::machine::MachineFile;
use crate::number::rounding::{bound, rounded};

/// What of the torque error allowed is too small to look closer at.
const NEGLIGIBLE: f64 = 1e-3;
/// The same without one, as a share of the largest torque.
const SHARE: f64 = 1e-9;

/// What came of a proof.
#[derive(Clone, Debug, PartialEq)]
pub enum Proven {
    /// The error is bounded.
    Bounded(Proof),
    /// It could not be.
    Open(Unproven),
}

impl Proven {
    /// The bound: of the ticks, or of the table where nothing is proven of the tick's arithmetic.
    pub fn bound(&self) -> Option<f64> {
        match self {
            Self::Bounded(proof) => Some(proof.ticked.unwrap_or(proof.bound)),
            Self::Open(_) => None,
        }
    }
}

/// How often a smaller table error is asked for, because the proven one is above what is allowed.
const ATTEMPTS: u32 = 4;

impl Export {
    /// As [`new`](Self::new), with a proof of the table's error; of a slider-crank in closed form only if it is asked for, because it is not proven. A table whose proven error is above the one allowed is searched for again, with a
    /// smaller one asked for; the last is what there is.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn proven(
        file: &MachineFile,
        task: &Task,
        watch: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self, Failure> {
        let allowed = task.torque_error;
        let (mut asked, mut last) = (allowed, None);
        for _ in 0..ATTEMPTS {
            let smaller = Task {
                torque_error: asked,
                ..task.clone()
            };
            let mut export = match (Self::found(file, smaller, true), last) {
                (Ok(export), _) => export,
                // Nothing meets the smaller one.
                (Err(_), Some(last)) => return Ok(last),
                (Err(why), None) => return Err(why),
            };
            export.task.torque_error = allowed;
            export.prove(file, watch)?;
            let above = export.excess();
            let (Some(error), Some(above)) = (asked, above) else {
                return Ok(export);
            };
            asked = Some(error / above * 0.999);
            last = Some(export);
        }
        last.ok_or_else(|| Failure::NotReached(String::new()))
    }

    /// How many times the error allowed the proven one is, if it is larger.
    pub fn excess(&self) -> Option<f64> {
        let above = self.proof()?.bound()? / self.task.torque_error?;
        (above > 1.0).then_some(above)
    }

    /// Proves the error of the table that was chosen, or of each of its pieces, and writes what is proven into its images. `watch` is told the share that is
    /// done, and says whether to go on.
    ///
    /// # Errors
    /// Those of the machine; none of a machine that was exported.
    pub fn prove(
        &mut self,
        file: &MachineFile,
        watch: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), Error> {
        if self.by_direction {
            let why = "loads go by the direction of travel, and the proof is of one machine";
            if let Some((_, _, Answer::Meets(candidate))) = self.answers.get_mut(self.chosen) {
                for made in &mut candidate.tables {
                    made.proof = Some(Proven::Open(Unproven::Part(why.to_owned())));
                }
            }
            return Ok(());
        }
        let machine = self.task.whole_machine(file)?;
        let (number, layout) = self.kind();
        let range = [self.task.omega, self.task.alpha];
        let edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
        let enclosed = Enclosed::new(&machine);
        let (id, allowed, domain) = (self.machine, self.task.torque_error, self.domain);
        let Some((_, _, Answer::Meets(candidate))) = self.answers.get_mut(self.chosen) else {
            return Ok(());
        };
        let count = candidate.tables.len() as f64;
        for (index, made) in (0..).zip(&mut candidate.tables) {
            let negligible = allowed.map_or(SHARE * made.ticks.peak_torque, |a| NEGLIGIBLE * a);
            let goal = Goal {
                start: made.range[0],
                span: made.range[1] - made.range[0],
                edges: &edges,
                turns: domain == Domain::Turn,
                omega: range[0],
                alpha: range[1],
                known: made.found.torque_error,
                negligible,
            };
            let mut of_all = |share: f64| watch((f64::from(index) + share) / count);
            let found = match &enclosed {
                Ok(enclosed) => of_type(number, layout, made, &goal, enclosed, &mut of_all)?,
                Err(why) => Err(why.clone()),
            };
            made.proof = Some(match found {
                Ok(proof) => Proven::Bounded(proof),
                Err(why) => Proven::Open(why),
            });
            if let Some(bound) = made.proof.as_ref().and_then(Proven::bound) {
                state(number, layout, made, bound)?;
                identify(&mut made.words, id).map_err(ticks::refusal)?;
            }
        }
        Ok(())
    }

    /// What is proven of all tables together: the largest bounds, or why there is none.
    pub fn proof(&self) -> Option<Proven> {
        let all = self.chosen().tables.iter().map(|table| table.proof.clone());
        all.reduce(|a, b| {
            Some(match (a?, b?) {
                (Proven::Bounded(a), Proven::Bounded(b)) => {
                    let worse = if b.bound > a.bound { b } else { a };
                    Proven::Bounded(Proof {
                        ticked: a.ticked.zip(b.ticked).map(|(a, b)| a.max(b)),
                        least: a.least.max(b.least),
                        stretches: a.stretches + b.stretches,
                        ..worse
                    })
                }
                (open @ Proven::Open(_), _) | (_, open) => open,
            })
        })?
    }
}

/// Its words.
impl Export {
    /// What is proven of the error, if that was asked for.
    pub(super) fn proof_text(&self) -> String {
        let (coordinate, word) = (self.coordinate, self.effort());
        let effort = coordinate.effort_unit();
        match self.proof() {
            None => String::new(),
            Some(Proven::Open(why)) => format!("not proven: {why}\n"),
            Some(Proven::Bounded(proof)) => {
                let ticks = match proof.ticked {
                    Some(ticked) => format!("ticks within {} {effort}", bound(ticked)),
                    None => "the arithmetic of its ticks is not proven".to_owned(),
                };
                format!(
                    "proven over every position: {word} error of the table within {} {effort}, largest near {} {}; {ticks}\n",
                    bound(proof.bound),
                    rounded(coordinate.shown(proof.worst)),
                    coordinate.unit(),
                )
            }
        }
    }

    /// That the proven error is above the one allowed, and where.
    pub fn exceeded(&self) -> String {
        let coordinate = self.coordinate;
        let effort = coordinate.effort_unit();
        match (self.proof(), self.task.torque_error) {
            (Some(found @ Proven::Bounded(proof)), Some(allowed)) => format!(
                "the proven {} error, {} {effort} near {} {}, is above the {} {effort} allowed",
                self.effort(),
                bound(found.bound().unwrap_or(proof.bound)),
                rounded(coordinate.shown(proof.worst)),
                coordinate.unit(),
                rounded(allowed)
            ),
            _ => String::new(),
        }
    }
}

/// The error of a table of this type and layout.
fn of_type(
    number: Number,
    layout: LayoutName,
    made: &Made,
    goal: &Goal<'_>,
    enclosed: &Enclosed<'_>,
    watch: &mut dyn FnMut(f64) -> bool,
) -> Result<Result<Proof, Unproven>, Error> {
    match (number, layout) {
        (_, LayoutName::Harmonic | LayoutName::SliderCrank) => Ok(Err(Unproven::Layout {
            layout: layout.name(),
        })),
        (Number::F32, LayoutName::Cubic) => of::<Cubic<f32>>(made, goal, enclosed, watch),
        (Number::F32, LayoutName::Quadratic) => of::<Quadratic<f32>>(made, goal, enclosed, watch),
        (Number::F32, _) => of::<Spline<f32>>(made, goal, enclosed, watch),
        (Number::I32, LayoutName::Spline16) => of::<Spline16>(made, goal, enclosed, watch),
        (Number::I32, LayoutName::Cubic) => of::<Cubic<Q31>>(made, goal, enclosed, watch),
        (Number::I32, LayoutName::Quadratic) => of::<Quadratic<Q31>>(made, goal, enclosed, watch),
        (Number::I32, _) => of::<Spline<Q31>>(made, goal, enclosed, watch),
        (Number::I16, _) => of::<Rows16>(made, goal, enclosed, watch),
    }
}

/// The error of a table of this format, as its image holds it.
fn of<F: Format>(
    made: &Made,
    goal: &Goal<'_>,
    enclosed: &Enclosed<'_>,
    watch: &mut dyn FnMut(f64) -> bool,
) -> Result<Result<Proof, Unproven>, Error> {
    let image = Image::new(&made.words).map_err(ticks::refusal)?;
    let table = image.table::<F>().map_err(ticks::refusal)?;
    let curves = |stretch| enclosed.curves(stretch);
    // Without the rounding of the tick's sums, which is not the table's.
    let rounding = F::TICK_ROUNDING * f64::from(table.scale().torque());
    let goal = Goal {
        known: (goal.known - rounding).max(0.0),
        ..*goal
    };
    Ok(prove(&table, &goal, &curves, watch))
}

/// Writes the error that is proven into the image.
fn state(number: Number, layout: LayoutName, made: &mut Made, error: f64) -> Result<(), Error> {
    match (number, layout) {
        (Number::F32, LayoutName::Cubic) => stated::<Cubic<f32>>(made, error),
        (Number::F32, LayoutName::Quadratic) => stated::<Quadratic<f32>>(made, error),
        (Number::F32, _) => stated::<Spline<f32>>(made, error),
        (Number::I32, LayoutName::Spline16) => stated::<Spline16>(made, error),
        (Number::I32, LayoutName::Cubic) => stated::<Cubic<Q31>>(made, error),
        (Number::I32, LayoutName::Quadratic) => stated::<Quadratic<Q31>>(made, error),
        (Number::I32, _) => stated::<Spline<Q31>>(made, error),
        (Number::I16, _) => stated::<Rows16>(made, error),
    }
}

fn stated<F: Format>(made: &mut Made, error: f64) -> Result<(), Error> {
    let image = Image::new(&made.words).map_err(ticks::refusal)?;
    let table = image.table::<F>().map_err(ticks::refusal)?;
    let validity = Validity {
        torque_error: rounded_up(error),
        ..image.validity()
    };
    let mut words = vec![0; made.words.len()];
    let written = encode(&table, validity, &mut words)?.len();
    words.truncate(written);
    made.words = words;
    Ok(())
}
