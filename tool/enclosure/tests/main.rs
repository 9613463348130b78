//! The test program of the package.

mod golden;
mod intervals;
mod linkages;
mod mechanics;
mod taylor;
