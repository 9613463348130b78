//! The tests of the library that `scripts/test tests-release` repeats with optimisation: all code that wraps on purpose (angles, counters, fixed
//! point, table reading, ticks, pieces), and the search for tables, which reads them. No other code may wrap, which `tests/main.rs` shows with
//! overflow checks; so optimisation does not change its results.

mod axis;
mod duty;
mod fixed_point;
mod fixed_vs_float;
mod harmonic;
mod harmonic_fit;
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
