//! The smallest table of one number type and layout that meets a torque error, or the best one for its bytes.
//!
//! A size is looked at in two steps: against exact curves computed once, which refuses nearly all that miss; then against
//! [`tabulate::measure`], and by ticking its image. What passes both is a table.

use jred::machine::PoseError;
use jred::number::RangeError;
use jred::table::{Format, MAX_CELLS, MIN_CELLS, Usage};
use jred::tabulate::{self, Request, Tabulated};
use jred::{Domain, Error, Machine, Reducible as _, Scale, Set, curves};

use super::choice::{LayoutName, Number};
use super::reference::{Reference, Remembered};
use super::size::{Buffers, Made, Size, bytes};
use super::ticks::Ticks;
use crate::model::mechanism::AnyMechanism;

/// Sizes up to this one are all tried.
pub const EXHAUSTIVE: u32 = 512;

/// A table with its image.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Number type.
    pub number: Number,
    /// Layout.
    pub layout: LayoutName,
    /// Set of [`curves`].
    pub curves: Set,
    /// Accuracy of its curves.
    pub found: Tabulated,
    /// The largest error of the drive torque (N·m, or N): of the curves and of the ticks.
    pub error: f64,
    /// Its torque error at the places of the search alone (N·m, or N).
    pub looked: f64,
    /// Accuracy of its ticks.
    pub ticks: Ticks,
    /// How much of the number range each quantity uses.
    pub usage: Usage,
    /// Its machine units.
    pub scale: Scale,
    /// Bytes of its rows.
    pub row_bytes: usize,
    /// The image.
    pub words: Vec<u32>,
}

impl Candidate {
    /// Bytes of the image.
    pub fn bytes(&self) -> usize {
        4 * self.words.len()
    }
}

/// Result for one number type and layout.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Meets the request.
    Meets(Box<Candidate>),
    /// Even the best one does not meet the request.
    Misses(Box<Candidate>),
    /// No size gives a usable table; the reason for the last one.
    Refused(Error),
    /// The smallest image does not fit; its bytes.
    TooLarge(usize),
}

impl Answer {
    /// Why it is not taken, in a few words; nothing where it meets what is asked for.
    pub const fn remark(&self) -> &'static str {
        match self {
            Self::Meets(_) => "",
            Self::Misses(_) => "misses",
            Self::Refused(_) => "no size is usable",
            Self::TooLarge(_) => "does not fit",
        }
    }
}

/// The request.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    /// Largest error of the drive torque (N·m); without one, the least possible.
    pub(super) torque_error: Option<f64>,
    /// Largest speed and acceleration.
    pub(super) range: [f64; 2],
    /// Largest number of cells to try.
    pub(super) max_cells: u32,
    /// Most bytes of the image.
    pub(super) max_bytes: Option<usize>,
    /// Whether fixed-point tables get the curve of 1/J.
    pub(super) reciprocal: bool,
}

/// Searches for tables of one machine.
pub(super) struct Search<'m> {
    pub(super) machine: &'m Machine<AnyMechanism>,
    pub(super) knots: Remembered<'m, Machine<AnyMechanism>>,
    pub(super) domain: Domain,
    pub(super) reference: Reference,
    pub(super) goal: Goal,
    pub(super) set: Set,
}

impl<'m> Search<'m> {
    pub(super) fn new(machine: &'m Machine<AnyMechanism>, goal: Goal) -> Result<Self, Error> {
        let domain = machine.domain();
        if domain == Domain::Turn {
            machine.check_repeats()?;
        }
        Ok(Self {
            machine,
            knots: Remembered::new(machine),
            domain,
            reference: Reference::new(machine)?,
            goal,
            set: tabulate::curves_in_use(machine, super::choice::PLACES)?,
        })
    }

    /// The table of this type and layout.
    ///
    /// # Errors
    /// Those of the machine.
    pub(super) fn run<F: Format>(
        &self,
        number: Number,
        layout: LayoutName,
    ) -> Result<Answer, Error> {
        let reciprocal = if self.goal.reciprocal && F::accepts(curves::RECIPROCAL) {
            curves::RECIPROCAL
        } else {
            0
        };
        let mut attempt = Attempt::<F> {
            search: self,
            number,
            layout,
            set: self.set | reciprocal,
            scale: number.scale(self.machine, self.goal.range)?,
            buffers: Buffers::default(),
            worst: 0,
            refused: None,
        };
        attempt.run()
    }

    /// The torque error of a table of this format, whose numbers are double precision, and where it is largest.
    pub(super) fn without_rounding<F: Format>(&self, cells: u32) -> Result<(f64, f64), Error> {
        let size = Size {
            search: self,
            set: self.set,
            cells,
            scale: Scale::SI,
        };
        size.without_rounding::<F>()
    }
}

struct Attempt<'s, F: Format> {
    search: &'s Search<'s>,
    number: Number,
    layout: LayoutName,
    set: Set,
    scale: Scale,
    buffers: Buffers<F>,
    /// Index of the place where the table before was worst: the next one is looked at there first.
    worst: usize,
    /// Why the last size that was refused was.
    refused: Option<Error>,
}

impl<'s, F: Format> Attempt<'s, F> {
    fn run(&mut self) -> Result<Answer, Error> {
        let goal = self.search.goal;
        let Some(most) = self.most_cells() else {
            return Ok(Answer::TooLarge(self.bytes(MIN_CELLS as u32)));
        };
        if let Some(allowed) = goal.torque_error
            && let Some((_, candidate)) =
                tabulate::smallest(most, EXHAUSTIVE, |cells| self.make(cells, allowed))?
        {
            return Ok(Answer::Meets(Box::new(candidate)));
        }
        let Some(candidate) = self.best(most)? else {
            let sound = RangeError::NotFinite("torque error of the table");
            return Ok(Answer::Refused(self.refused.unwrap_or(sound.into())));
        };
        let candidate = Box::new(candidate);
        Ok(match goal.torque_error {
            Some(allowed) if candidate.error > allowed => Answer::Misses(candidate),
            _ => Answer::Meets(candidate),
        })
    }

    fn bytes(&self, cells: u32) -> usize {
        bytes::<F>(cells, self.set)
    }

    /// The most cells that may be tried; `None` if not even the fewest fit.
    fn most_cells(&self) -> Option<u32> {
        let goal = &self.search.goal;
        let most = goal.max_cells.min(MAX_CELLS);
        let fits = |cells: u32| goal.max_bytes.is_none_or(|most| self.bytes(cells) <= most);
        let (mut fitting, mut above) = (MIN_CELLS as u32, most + 1);
        if !fits(fitting) {
            return None;
        }
        while fitting + 1 < above {
            let middle = fitting.midpoint(above);
            if fits(middle) {
                fitting = middle;
            } else {
                above = middle;
            }
        }
        Some(fitting)
    }

    /// The most exact table of up to `most` cells: of all sizes up to [`EXHAUSTIVE`], and of growing ones beyond.
    fn best(&mut self, most: u32) -> Result<Option<Candidate>, Error> {
        let all = (MIN_CELLS as u32..=most.min(EXHAUSTIVE)).rev();
        let beyond = tabulate::growing(most).filter(|cells| *cells > EXHAUSTIVE);
        let mut sizes: Vec<(f64, u32)> = Vec::new();
        let mut least = f64::INFINITY;
        for cells in beyond.chain(all) {
            if let Some(error) = self.look(cells, least)? {
                least = error;
                sizes.push((error, cells));
            }
        }
        // The last is the best; should its image be refused, those before it.
        while let Some((_, cells)) = sizes.pop() {
            if let Some(found) = self.make(cells, f64::INFINITY)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    fn size(&self, cells: u32) -> Size<'s> {
        let mut scale = self.scale;
        if F::WHOLE_FACTOR {
            scale = scale.for_cells(cells, self.search.domain.span());
        }
        Size {
            search: self.search,
            set: self.set,
            cells,
            scale,
        }
    }

    /// The bound of the torque error of this size at the places of the reference; `None` if it is above `limit`, or if the
    /// size gives no sound table.
    fn look(&mut self, cells: u32, limit: f64) -> Result<Option<f64>, Error> {
        let size = self.size(cells);
        match size.look(&mut self.buffers, (self.worst, limit)) {
            Ok((error, worst)) => {
                self.worst = worst;
                Ok((error <= limit).then_some(error))
            }
            Err(error) => self.refuse(error),
        }
    }

    /// This size, if it meets the limit everywhere.
    fn make(&mut self, cells: u32, limit: f64) -> Result<Option<Candidate>, Error> {
        let Some(looked) = self.look(cells, limit)? else {
            return Ok(None);
        };
        let [omega, alpha] = self.search.goal.range;
        let request = Request::new(limit)
            .with_omega(omega)
            .with_alpha(alpha)
            .with_max_cells(cells);
        let size = self.size(cells);
        let made = match size.make(&mut self.buffers, &request, looked) {
            Ok(Some(made)) => made,
            Ok(None) => return Ok(None),
            Err(error) => return self.refuse(error),
        };
        let scale = size.scale;
        let Made {
            found,
            error,
            usage,
            ticks,
            row_bytes,
            words,
        } = made;
        Ok(Some(Candidate {
            number: self.number,
            layout: self.layout,
            curves: self.set,
            found,
            error,
            looked,
            ticks,
            usage,
            scale,
            row_bytes,
            words,
        }))
    }

    /// A coarse curve may dip below zero or leave the range: more cells cure it. Everything else is the machine's fault.
    fn refuse<T>(&mut self, error: Error) -> Result<Option<T>, Error> {
        match error {
            Error::Pose(PoseError::NoInertia { .. }) | Error::Table(_) => {
                self.refused = Some(error);
                Ok(None)
            }
            error => Err(error),
        }
    }
}
