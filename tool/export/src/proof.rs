//! The error of an exported table, proven over every position.

use jred::error::Error;
use jred::image::{Validity, encode, identify};
use jred::machine::Reducible as _;
use jred::table::Format;
use jred::{Cubic, Domain, Image, Q31, Quadratic, Rows16, Spline, Spline16};
use jred_enclosure::{Goal, Proof, ProofError, prove};

use crate::candidate::{RangeTable, SearchResult};
use crate::choice::{LayoutName, Number};
use crate::enclose::EnclosedMachine;
use crate::export::Export;
use crate::failure::Failure;
use crate::search::rounded_up;
use crate::task::Task;
use crate::ticks;
use jred_file::model::machine::MachineFile;

/// Share of the allowed torque error below which refinement is unnecessary.
const NEGLIGIBLE: f64 = 1e-3;
/// The same without an allowed error, as a share of the largest torque.
const SHARE: f64 = 1e-9;

/// How often the required table error is reduced because the proven one exceeds the allowed one.
const ATTEMPTS: u32 = 4;

impl Export {
    /// As [`new`](Self::new), with a proof of the table's error. A slider-crank in closed form is used only on request, because it cannot be proven.
    /// If the proven error of a table exceeds the allowed one, the search is repeated with a smaller required error; the last table is returned.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn proven(
        file: &MachineFile,
        task: &Task,
        watch: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self, Failure> {
        let mut export = Self::found(file, task.clone(), true)?;
        export.prove(file, watch)?;
        let mut required = task.torque_error;
        for _ in 1..ATTEMPTS {
            let (Some(error), Some(above)) = (required, export.excess()) else {
                break;
            };
            required = Some(error / above * 0.999);
            let smaller = Task {
                torque_error: required,
                ..task.clone()
            };
            // Otherwise no table meets the smaller error.
            let Ok(next) = Self::found(file, smaller, true) else {
                break;
            };
            export = next;
            export.task.torque_error = task.torque_error;
            export.prove(file, watch)?;
        }
        Ok(export)
    }

    /// Ratio of the proven and the allowed error, if larger than 1.
    pub fn excess(&self) -> Option<f64> {
        let above = self.proof()?.ok()?.stated() / self.task.torque_error?;
        (above > 1.0).then_some(above)
    }

    /// Proves the error of the chosen table, or of each of its pieces, and writes the proven error into its images. `watch` receives the completed
    /// share, and returns whether to continue.
    ///
    /// # Errors
    /// Errors of the machine; never for an exported one.
    pub fn prove(
        &mut self,
        file: &MachineFile,
        watch: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), Error> {
        if self.by_direction {
            let why = "loads go by the direction of travel, and the proof is of one machine";
            if let Some((_, _, SearchResult::Meets(candidate))) = self.answers.get_mut(self.chosen)
            {
                for made in &mut candidate.tables {
                    made.proof = Some(Err(ProofError::Part(why.to_owned())));
                }
            }
            return Ok(());
        }
        let machine = self.task.whole_machine(file)?;
        let (number, layout) = self.kind();
        let range = [self.task.omega, self.task.alpha];
        let edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
        let enclosed = EnclosedMachine::new(&machine);
        let (id, allowed, domain) = (self.machine, self.task.torque_error, self.domain);
        let Some((_, _, SearchResult::Meets(candidate))) = self.answers.get_mut(self.chosen) else {
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
            if found.is_ok() {
                identify(&mut made.words, id).map_err(ticks::refusal)?;
            }
            made.proof = Some(found);
        }
        Ok(())
    }

    /// The proof of all tables together: the largest bounds, or the reason for their absence.
    pub fn proof(&self) -> Option<Result<Proof, ProofError>> {
        let all = self.chosen().tables.iter().map(|table| table.proof.clone());
        let all: Option<Result<Vec<Proof>, ProofError>> = all.collect();
        let all = all?.map(|proofs| {
            proofs.into_iter().reduce(|a, b| Proof {
                ticked: a.ticked.zip(b.ticked).map(|(a, b)| a.max(b)),
                least: a.least.max(b.least),
                stretches: a.stretches + b.stretches,
                ..if b.bound > a.bound { b } else { a }
            })
        });
        all.transpose()
    }
}

/// The error of a table of this type and layout, which its image then states.
fn of_type(
    number: Number,
    layout: LayoutName,
    made: &mut RangeTable,
    goal: &Goal<'_>,
    enclosed: &EnclosedMachine<'_>,
    watch: &mut dyn FnMut(f64) -> bool,
) -> Result<Result<Proof, ProofError>, Error> {
    match (number, layout) {
        (_, LayoutName::Harmonic | LayoutName::SliderCrank) => Ok(Err(ProofError::Layout {
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

/// The error of a table of this format, as contained in its image, which then states it.
fn of<F: Format>(
    made: &mut RangeTable,
    goal: &Goal<'_>,
    enclosed: &EnclosedMachine<'_>,
    watch: &mut dyn FnMut(f64) -> bool,
) -> Result<Result<Proof, ProofError>, Error> {
    let image = Image::new(&made.words).map_err(ticks::refusal)?;
    let table = image.table::<F>().map_err(ticks::refusal)?;
    let curves = |stretch| enclosed.curves(stretch);
    // Without rounding of the tick's sums, which is not an error of the table.
    let rounding = F::TICK_ROUNDING * f64::from(table.scale().torque());
    let goal = Goal {
        known: (goal.known - rounding).max(0.0),
        ..*goal
    };
    let found = prove(&table, &goal, &curves, watch);
    if let Ok(proof) = &found {
        let validity = Validity {
            torque_error: rounded_up(proof.stated()),
            ..image.validity()
        };
        let mut words = vec![0; made.words.len()];
        let written = encode(&table, validity, &mut words)?.len();
        words.truncate(written);
        made.words = words;
    }
    Ok(found)
}
