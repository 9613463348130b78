//! Memory of the caller: the words of an image, and a model.

use core::mem::MaybeUninit;
use core::slice;

use jred::table::{Format, TableError};
use jred::{AnyModel, CurveSet, Image, ImageError, Model};

use crate::status::Status;

/// Pointers of memory in a `jred_memory`, as `JRED_MEMORY_POINTERS` of `jred.h`.
pub(crate) const POINTERS: usize = 37;

/// More than any image has: 65 535 cells of twenty words, and its header.
const MOST_WORDS: usize = 1 << 21;

/// Any set of curves: `JRED_ANY` of `jred.h`. No image has this set.
pub(crate) const ANY: CurveSet = !0;

/// The words of an image.
///
/// # Safety
/// `address` is null, or the address of `length` words that stay valid and unchanged as long as the result is used.
pub(crate) unsafe fn words<'a>(address: *const u32, length: usize) -> Result<&'a [u32], Status> {
    if address.is_null() {
        Err(Status::Null)
    } else if !address.is_aligned() {
        Err(Status::Misaligned)
    } else if length > MOST_WORDS {
        Err(Status::Length)
    } else {
        // SAFETY: not null, aligned, and not longer than memory; the caller promises the rest.
        Ok(unsafe { slice::from_raw_parts(address, length) })
    }
}

/// A model in the memory of a `jred_memory`; zeros contain no model.
#[repr(C)]
pub(crate) struct Memory<F: Format> {
    /// The set of curves plus 1; 0 without a model. `jred.h` checks it before every tick.
    tag: usize,
    model: MaybeUninit<AnyModel<'static, F>>,
}

impl<F: Format> Memory<F> {
    const FITS: () = assert!(
        size_of::<Self>() <= (1 + POINTERS) * size_of::<usize>()
            && align_of::<Self>() <= align_of::<usize>()
    );

    /// Creates a model of an image with this set of curves, or any; on failure there is no model.
    ///
    /// # Safety
    /// As [`words`], as long as the model is ticked.
    pub(crate) unsafe fn load(
        &mut self,
        set: CurveSet,
        address: *const u32,
        length: usize,
    ) -> Status {
        let () = Self::FITS;
        self.tag = 0;
        // SAFETY: as promised by the caller.
        match unsafe { words(address, length) } {
            Ok(words) => self.fill(set, words).into(),
            Err(status) => status,
        }
    }

    fn fill(&mut self, set: CurveSet, words: &'static [u32]) -> Result<(), ImageError> {
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
        // SAFETY: the tag shows that there is one.
        (self.tag != 0).then(|| unsafe { self.model.assume_init_ref() })
    }

    /// The model with any set.
    ///
    /// # Safety
    /// There is a model: `load` returned success.
    #[inline]
    pub(crate) unsafe fn any(&self) -> &AnyModel<'static, F> {
        // SAFETY: as promised by the caller.
        unsafe { self.model.assume_init_ref() }
    }

    /// The model with this set.
    ///
    /// # Safety
    /// There is a model, and it has this set.
    #[inline]
    pub(crate) unsafe fn known<const SET: CurveSet>(&self) -> &Model<'static, F, SET> {
        // SAFETY: as promised by the caller; a `Model` is transparent over an `AnyModel`, and has no other invariant than the table's set.
        unsafe { &*self.model.as_ptr().cast() }
    }
}

/// A follower or an observer; zeros contain none.
#[repr(C)]
pub(crate) struct Held<T, const WORDS: usize> {
    /// 1; 0 while it is empty.
    tag: u64,
    content: MaybeUninit<T>,
}

impl<T, const WORDS: usize> Held<T, WORDS> {
    const FITS: () = assert!(
        size_of::<Self>() <= (1 + WORDS) * size_of::<u64>()
            && align_of::<Self>() <= align_of::<u64>()
    );

    /// Writes the content; on failure the memory is empty.
    pub(crate) fn keep(memory: Option<&mut Self>, made: Result<T, Status>) -> Status {
        let () = Self::FITS;
        let Some(memory) = memory else {
            return Status::Null;
        };
        memory.tag = 0;
        match made {
            Ok(made) => {
                memory.content.write(made);
                memory.tag = 1;
                Status::Ok
            }
            Err(status) => status,
        }
    }

    /// The content, unless the memory is empty.
    pub(crate) fn get(&mut self) -> Option<&mut T> {
        // SAFETY: the tag shows that it was written.
        (self.tag == 1).then(|| unsafe { self.content.assume_init_mut() })
    }

    /// The content.
    ///
    /// # Safety
    /// There is something: it was made with success.
    #[inline]
    pub(crate) unsafe fn made(&mut self) -> &mut T {
        // SAFETY: as promised by the caller.
        unsafe { self.content.assume_init_mut() }
    }
}
