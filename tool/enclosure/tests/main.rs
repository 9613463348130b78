//! The one test program of the package.

mod linkages;
