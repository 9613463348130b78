//! Memory for an image that is exchanged while the machine runs.

use super::FeedForward;
use crate::Validity;
use crate::curve::{Format, Set};
use crate::tick::{HEADER_WORDS, ImageError, Progress};

/// Memory for an image, and the feed-forward over it: to exchange the table while the machine runs.
///
/// It takes the image in pieces as a link brings them, checks it in slices, and then has a [`FeedForward`] until it is cleared. A program has two. The
/// tick owns the one that it reads, the background the other; to exchange them is to exchange two `&'static mut`, so that no tick ever sees
/// half a table, and the compiler sees to it that nobody writes into the one in use:
///
/// ```compile_fail,E0502
/// # use jred::axis::ImageSlot;
/// # use jred::{Spline, curves};
/// fn no(slot: &mut ImageSlot<'_, Spline<f32>, { curves::LOAD }>, tick: impl Fn(&dyn core::fmt::Debug)) {
///     let in_use = slot.feed_forward();
///     slot.clear();
///     tick(&in_use);
/// }
/// ```
///
/// The bits of a tick are those of a model in flash (test `a_slot_ticks_as_the_image_itself`); `examples/template` of the repository is a firmware that does it.
///
/// ```
/// use jred::axis::{FeedForward, ImageSlot};
/// use jred::{Set, Spline, curves, include_image};
///
/// const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut memory = [0; 600]; // words
/// let mut slot = ImageSlot::<Spline<f32>, PRESS>::new(&mut memory);
/// for packet in include_image!("../../examples/data/press_f32.jred").chunks(50) {
///     slot.receive(packet)?;
/// }
/// // In the background: 16 words at a time.
/// while slot.check(16).is_none() {}
/// let feed_forward: FeedForward<'_, Spline<f32>, PRESS> = slot.feed_forward().ok_or("refused")?;
/// # assert!(feed_forward.status(0.0, 0.0).is_valid());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct ImageSlot<'m, F: Format, const SET: Set> {
    words: &'m mut [u32],
    /// Bytes that were received.
    received: usize,
    progress: Progress,
    /// Of the machine that images must be of; any, if there is none.
    machine: Option<u32>,
    verdict: Option<Verdict<F, SET>>,
}

/// What was found: the feed-forward, without the words, and what it was made for; or why there is none.
type Verdict<F, const SET: Set> = Result<(FeedForward<'static, F, SET>, Validity), ImageError>;

impl<'m, F: Format, const SET: Set> ImageSlot<'m, F, SET> {
    /// Empty, with memory for images of up to so many words.
    #[must_use]
    pub const fn new(memory: &'m mut [u32]) -> Self {
        Self {
            words: memory,
            received: 0,
            progress: Progress::START,
            machine: None,
            verdict: None,
        }
    }

    /// The same, for images of the machine with this identifier alone: that of another may have the same type and the same curves.
    #[must_use]
    pub const fn for_machine(mut self, machine: u32) -> Self {
        self.machine = Some(machine);
        self
    }

    /// Forgets the image, to receive another.
    pub fn clear(&mut self) {
        self.received = 0;
        self.progress = Progress::START;
        self.verdict = None;
    }

    /// Takes the next bytes of the image, any number of them; after a check they are the first of another.
    ///
    /// # Errors
    /// [`ImageError::TooLong`]: more than the slot holds. Nothing of these bytes is kept.
    pub fn receive(&mut self, bytes: &[u8]) -> Result<(), ImageError> {
        if bytes.is_empty() {
            return Ok(());
        }
        if self.verdict.is_some() {
            self.clear();
        }
        let end = self.received.saturating_add(bytes.len());
        let given = self.words.len();
        let memory: &mut [u8] = bytemuck::cast_slice_mut(self.words);
        let place = memory.get_mut(self.received..end);
        let place = place.ok_or(ImageError::TooLong { given })?;
        for (slot, byte) in place.iter_mut().zip(bytes) {
            *slot = *byte;
        }
        self.received = end;
        Ok(())
    }

    /// Checks what was received: takes at most `words` more words into the CRC, and at the end looks at every cell. The verdict, or `None` if something is
    /// left to do: of no words always. After the verdict it is repeated.
    ///
    /// Cost: a slice takes the same for each of its words. The last one makes the model, which takes far longer and grows with the number of
    /// cells, of a slider-crank with the places at which its inertia must be looked at (docs/performance.md): call this in the background, where the tick interrupts it.
    ///
    /// # Errors
    /// As [`Image::new`](crate::Image::new), [`Image::of_machine`](crate::Image::of_machine) and [`Image::model`](crate::Image::model).
    pub fn check(&mut self, words: usize) -> Option<Result<(), ImageError>> {
        if self.verdict.is_none() {
            let image = self.words.get(..self.received / 4).unwrap_or_default();
            let verdict = if self.received.is_multiple_of(4) {
                self.progress.advance(image, words)?
            } else {
                Err(ImageError::Misaligned)
            };
            self.verdict = Some(verdict.and_then(|image| {
                let image = match self.machine {
                    Some(machine) => image.of_machine(machine)?,
                    None => image,
                };
                let validity = image.validity();
                let model = image.model()?;
                Ok((FeedForward::new(model, validity).moved(&[]), validity))
            }));
        }
        self.verdict
            .as_ref()
            .map(|verdict| verdict.as_ref().map(|_| ()).map_err(|error| *error))
    }

    /// Feed-forward over the image; `None` if there is none, or it was not checked or refused.
    ///
    /// Cost: nothing is checked again, so a tick can ask for it every time: 18 instructions on an M4F (docs/performance.md).
    #[inline]
    #[must_use]
    pub fn feed_forward(&self) -> Option<FeedForward<'_, F, SET>> {
        let Some(Ok((found, _))) = &self.verdict else {
            return None;
        };
        let last = (self.received / 4).checked_sub(1)?;
        let rows = self.words.get(HEADER_WORDS..last)?;
        Some(found.moved(bytemuck::try_cast_slice(rows).ok()?))
    }

    /// What the table was made for and how exact it is; `None` as [`feed_forward`](Self::feed_forward).
    #[must_use]
    pub fn validity(&self) -> Option<Validity> {
        let Some(Ok((_, validity))) = &self.verdict else {
            return None;
        };
        Some(*validity)
    }
}
