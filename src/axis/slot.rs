//! Memory for an image that is exchanged while the machine runs.

use super::FeedForward;
use crate::curve::{CurveSet, Format};
use crate::tick::Validity;
use crate::tick::{HEADER_WORDS, ImageError, Progress};

/// Memory for an image and its feed-forward, to exchange the table while the machine runs.
///
/// It takes the image in pieces as they arrive over a link, checks it in slices, and then provides a [`FeedForward`] until it is cleared. A program
/// has two slots. The tick owns the one that it reads, the background the other. They are exchanged by swapping two `&'static mut`, so that no tick
/// ever sees half a table, and the compiler ensures that nobody writes into the one in use:
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
/// The bits of a tick are those of a model in flash (test `a_slot_ticks_as_the_image_itself`); `examples/template` of the repository is a firmware
/// that does this.
///
/// ```
/// use jred::axis::{FeedForward, ImageSlot};
/// use jred::{CurveSet, Spline, curves, include_image};
///
/// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// # fn main() -> Result<(), jred::FirmwareError> {
/// let mut memory = [0; 600]; // words
/// let mut slot = ImageSlot::<Spline<f32>, PRESS>::new(&mut memory);
/// for packet in include_image!("../../examples/data/press_f32.jred").chunks(50) {
///     slot.receive(packet)?;
/// }
/// // In the background: 16 words at a time, up to the verdict.
/// let verdict = loop {
///     if let Some(verdict) = slot.check(16) {
///         break verdict;
///     }
/// };
/// verdict?;
/// let feed_forward: Option<FeedForward<'_, Spline<f32>, PRESS>> = slot.feed_forward();
/// # assert!(feed_forward.unwrap().status(0.0, 0.0).is_valid());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct ImageSlot<'m, F: Format, const SET: CurveSet> {
    words: &'m mut [u32],
    /// Received bytes.
    received: usize,
    progress: Progress,
    /// Identifier of the machine that images must match; `None` accepts any.
    machine: Option<u32>,
    verdict: Option<Verdict<F, SET>>,
}

/// The feed-forward without its words, and its validity; or why the image was refused.
type Verdict<F, const SET: CurveSet> = Result<(FeedForward<'static, F, SET>, Validity), ImageError>;

impl<'m, F: Format, const SET: CurveSet> ImageSlot<'m, F, SET> {
    /// An empty slot, with memory for images of up to `memory.len()` words.
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

    /// The same, only for images of the machine with this identifier: another machine may have the same types and curves.
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

    /// Takes the next bytes of the image, any number of them; after a check they begin the next image.
    ///
    /// # Errors
    /// [`ImageError::TooLong`]: more than the slot's memory. None of these bytes is stored.
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

    /// Checks the received image: adds at most `words` more words to the CRC, and at the end checks every cell. Returns the verdict, repeatedly once
    /// there is one, or `None` if work is left; with `words` = 0 always `None`.
    ///
    /// Cost: every word of a slice costs the same. The last slice creates the model, which takes far longer. Its cost grows with the number of cells,
    /// and for a slider-crank with the places at which its inertia is checked (docs/performance.md): call this in the background, where the tick
    /// interrupts it.
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

    /// Feed-forward over the image; `None` if there is no image, or it was not checked or was refused.
    ///
    /// Cost: nothing is checked again, so a tick can call it every time: 28 instructions on an M4F (docs/performance.md).
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

    /// Validity and accuracy of the table; `None` in the same cases as [`feed_forward`](Self::feed_forward).
    #[must_use]
    pub fn validity(&self) -> Option<Validity> {
        let Some(Ok((_, validity))) = &self.verdict else {
            return None;
        };
        Some(*validity)
    }
}
