//! Arguments come from, and results go to, places unknown to the compiler.

use core::ptr::{read_volatile, write_volatile};

use jred::{Acceleration, Q15, Q31, Speed, Torque};

static mut PORT: [u32; 8] = [0; 8];

pub fn read(index: usize) -> u32 {
    unsafe { read_volatile(&raw const PORT[index & 7]) }
}

pub fn write(word: u32) {
    unsafe { write_volatile(&raw mut PORT[7], word) }
}

/// A number of a tick as a word.
pub trait Word {
    fn read(index: usize) -> Self;
    fn write(self);
}

impl Word for f32 {
    fn read(index: usize) -> Self {
        Self::from_bits(read(index))
    }
    fn write(self) {
        write(self.to_bits());
    }
}

/// A quantity in fixed point.
macro_rules! word {
    ($quantity:ident<Q31>) => {
        impl Word for $quantity<Q31> {
            fn read(index: usize) -> Self {
                Self::from_bits(read(index).cast_signed())
            }
            fn write(self) {
                write(self.to_bits().cast_unsigned());
            }
        }
    };
    ($quantity:ident<Q15>) => {
        impl Word for $quantity<Q15> {
            fn read(index: usize) -> Self {
                Self::from_bits(read(index) as i16)
            }
            fn write(self) {
                write(u32::from(self.to_bits().cast_unsigned()));
            }
        }
    };
}

word!(Speed<Q31>);
word!(Acceleration<Q31>);
word!(Torque<Q31>);
word!(Speed<Q15>);
word!(Acceleration<Q15>);
word!(Torque<Q15>);
