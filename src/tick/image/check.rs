//! The check of an image in slices, for a program with other work to do meanwhile.

use super::{Image, ImageError, TABLE, covered};

const CRC: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);

/// Progress of the CRC of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Progress {
    /// Words done.
    done: usize,
    /// Their CRC-32.
    crc: u32,
}

impl Progress {
    pub(crate) const START: Self = Self { done: 0, crc: 0 };

    /// Adds at most `words` more words of an image. Returns its verdict, or `None` if words are left; with `words` = 0 it never ends.
    pub(crate) fn advance<'a>(
        &mut self,
        image: &'a [u32],
        words: usize,
    ) -> Option<Result<Image<'a>, ImageError>> {
        let covered = match covered(image, &TABLE) {
            Ok(covered) => covered,
            Err(error) => return Some(Err(error)),
        };
        let rest = covered.get(self.done..).unwrap_or_default();
        self.take(rest.get(..words).unwrap_or(rest));
        (self.done >= covered.len()).then(|| Image::with_crc(image, self.crc))
    }

    /// The CRC-32 of all these words.
    pub(crate) fn all(mut self, covered: &[u32]) -> u32 {
        self.take(covered);
        self.crc
    }

    #[inline(never)] // as `Image::with_crc`
    fn take(&mut self, slice: &[u32]) {
        // The register of the CRC is its complement, and the initial value has its bits reversed.
        let mut digest = CRC.digest_with_initial((!self.crc).reverse_bits());
        digest.update(bytemuck::cast_slice(slice));
        self.crc = digest.finalize();
        self.done += slice.len();
    }
}

/// The check of an image in slices, with the verdict of [`Image::new`] (test `slices_give_the_same_verdict`, and every damaged image of the tests).
///
/// For a program without an operating system that receives a table while it runs: each call takes a bounded time, with time for other work between
/// calls. A tick in an interrupt does not need it: it interrupts [`Image::new`], too. If the program also owns the memory for the next image,
/// [`ImageSlot`](crate::axis::ImageSlot) combines this check with that memory.
///
/// ```
/// use jred::image::ImageCheck;
/// use jred::{Image, ImageError};
///
/// fn check<'a>(words: &'a [u32], mut other_work: impl FnMut()) -> Result<Image<'a>, ImageError> {
///     let mut check = ImageCheck::new(words);
///     loop {
///         if let Some(verdict) = check.advance(64) {
///             return verdict;
///         }
///         other_work();
///     }
/// }
/// # let words: Vec<u32> = jred::include_image!("../../../examples/data/press_f32.jred").chunks(4)
/// #     .map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
/// # let mut slices = 0;
/// # assert!(check(&words, || slices += 1).is_ok());
/// # assert_eq!(slices, (words.len() - 2) / 64);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ImageCheck<'a> {
    words: &'a [u32],
    progress: Progress,
}

impl<'a> ImageCheck<'a> {
    /// The check of these words, not yet started.
    #[must_use]
    pub const fn new(words: &'a [u32]) -> Self {
        Self {
            words,
            progress: Progress::START,
        }
    }

    /// Adds at most `words` more words to the CRC: the verdict, or `None` if words are left. With 0 words it never ends.
    ///
    /// Cost: the CRC takes the same for every word; each call checks the first words of the header, the last one all of it. The checks of
    /// [`Image::model`] are not included.
    ///
    /// # Errors
    /// As [`Image::new`]. The first call finds a wrong header.
    pub fn advance(&mut self, words: usize) -> Option<Result<Image<'a>, ImageError>> {
        self.progress.advance(self.words, words)
    }
}
