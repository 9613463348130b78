//! Cached results by place.

use std::cell::RefCell;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

/// Hash for places: spreads their bits over the table. Places differ in the middle of the word, and nobody chooses them to collide.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spreader(u64);

impl Hasher for Spreader {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u64(&mut self, bits: u64) {
        // 2⁶⁴ over the golden ratio; the lower half gets the bits of the upper one.
        let product = (self.0 ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = product ^ product >> 32;
    }
}

/// Values by place; the key is the bits of the place's numbers.
#[derive(Debug)]
pub(crate) struct Memo<K, V>(RefCell<HashMap<K, V, BuildHasherDefault<Spreader>>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(RefCell::default())
    }
}

impl<K: Copy + Eq + Hash, V: Clone> Memo<K, V> {
    /// The value of a place, computed by `make` the first time.
    ///
    /// # Errors
    /// Those of `make`.
    pub(crate) fn of<E>(&self, place: K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
        if let Some(known) = self.0.borrow().get(&place) {
            return Ok(known.clone());
        }
        let value = make()?;
        self.0.borrow_mut().insert(place, value.clone());
        Ok(value)
    }
}
