//! Memory of the caller: the words of an image, and a model.

use core::mem::MaybeUninit;
use core::slice;

use jred::table::Format;
use jred::{AnyModel, Image, ImageError, Model, Set, TableError};

use crate::status::Status;

/// Pointers that a `jred_memory` has room for, as `JRED_MEMORY_POINTERS` of `jred.h` says.
pub(crate) const POINTERS: usize = 37;

/// More than any image has: 65 535 cells of twenty words, and its header.
const MOST_WORDS: usize = 1 << 21;

/// Any set of curves: `JRED_ANY` of `jred.h`. No image has it.
pub(crate) const ANY: Set = !0;

/// The words of an image.
///
/// # Safety
/// `address` is null, or that of `length` words that live and stay the same as long as what is made of them.
pub(crate) unsafe fn words<'a>(address: *const u32, length: usize) -> Result<&'a [u32], Status> {
    if address.is_null() {
        Err(Status::Null)
    } else if !address.is_aligned() {
        Err(Status::Misaligned)
    } else if length > MOST_WORDS {
        Err(Status::Length)
    } else {
        // SAFETY: neither null nor misaligned nor longer than memory is, and the caller promises the rest.
        Ok(unsafe { slice::from_raw_parts(address, length) })
    }
}

/// A model in the memory of a `jred_memory`, or none: zeros are none.
#[repr(C)]
pub(crate) struct Memory<F: Format> {
    /// The set of curves and 1; 0 without a model. `jred.h` looks at it before every tick.
    tag: usize,
    model: MaybeUninit<AnyModel<'static, F>>,
}

impl<F: Format> Memory<F> {
    const FITS: () = assert!(
        size_of::<Self>() <= (1 + POINTERS) * size_of::<usize>()
            && align_of::<Self>() <= align_of::<usize>()
    );

    /// Makes a model of an image that has this set of curves, or any; none if that fails.
    ///
    /// # Safety
    /// As of [`words`], for as long as the model is ticked.
    pub(crate) unsafe fn load(&mut self, set: Set, address: *const u32, length: usize) -> Status {
        let () = Self::FITS;
        self.tag = 0;
        // SAFETY: as promised by the caller.
        match unsafe { words(address, length) } {
            Ok(words) => self.fill(set, words).into(),
            Err(status) => status,
        }
    }

    fn fill(&mut self, set: Set, words: &'static [u32]) -> Result<(), ImageError> {
        let model = Image::new(words)?.any_model::<F>()?;
        let found = model.table().set();
        if set != found && set != ANY {
            return Err(TableError::Curves(found).into());
        }
        self.model.write(model);
        self.tag = usize::from(found) + 1;
        Ok(())
    }

    /// The model, if there is one.
    pub(crate) fn loaded(&self) -> Option<&AnyModel<'static, F>> {
        // SAFETY: the tag says that there is one.
        (self.tag != 0).then(|| unsafe { self.model.assume_init_ref() })
    }

    /// The model of any set.
    ///
    /// # Safety
    /// There is one: `load` has answered that all is well.
    #[inline]
    pub(crate) unsafe fn any(&self) -> &AnyModel<'static, F> {
        // SAFETY: as promised by the caller.
        unsafe { self.model.assume_init_ref() }
    }

    /// The model of this set.
    ///
    /// # Safety
    /// There is one, and the set is its own.
    #[inline]
    pub(crate) unsafe fn known<const SET: Set>(&self) -> &Model<'static, F, SET> {
        // SAFETY: as promised by the caller; a `Model` is transparent over an `AnyModel`, and of a table with its set there is
        // nothing else to it.
        unsafe { &*self.model.as_ptr().cast() }
    }
}
