//! The tests of the library that `scripts/test tests-release` runs again, optimised: of all that wraps on purpose (angles, counters,
//! fixed point, the reading of tables, ticks, pieces), and of the search for tables, which reads them. Elsewhere nothing may
//! wrap, which `tests/main.rs` shows with overflow checked; then an optimised program computes the same.

mod axis;
mod duty;
mod fixed_point;
mod fixed_vs_float;
mod harmonic;
mod harmonic_fit;
mod harmonic_identify;
mod harmonic_refused;
mod image;
mod image_damage;
mod image_refused;
mod image_slices;
mod layouts;
mod no_panic_list;
mod no_wrap;
mod phase;
mod pieces;
mod pieces_refused;
mod proven;
mod range;
mod reciprocal;
mod rows16;
mod scale;
#[cfg(feature = "micromath")]
mod slider_crank_form;
#[cfg(feature = "micromath")]
mod slider_crank_refused;
mod spline;
mod spline_quadratic;
mod support;
mod table;
mod there_and_back;
mod unfold;
