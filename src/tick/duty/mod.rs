//! Duty: the actual load of a drive, measured tick by tick in the figures of its sizing.
//!
//! A [`Meter`] receives in every control tick the motor's torque and speed, and the torque at the gearbox output. It computes the same figures as
//! `jred size` does from the machine file:
//!
//! ```text
//! T_rms = √(1/t ∫T² dt)       n̄ = 1/t ∫|n| dt       T_m = (∫|n|·|T_out|³ dt / ∫|n| dt)^⅓
//! P⁺ = 1/t ∫max(T·n, 0) dt    P⁻ = 1/t ∫max(−T·n, 0) dt
//! max |T|    max |n|    max |T_out|    max |T|/T_peak(|n|)    cycles an hour
//! ```
//!
//! with the rectangle rule: every reading represents one tick. [`Verdicts`] compare them with the [`Limits`] of the sizing, so that a machine can
//! tell whether it is loaded as intended. T_rms is compared with the continuous torque at the mean speed n̄, as in sizing; T_m is the root-mean-cube
//! torque of gears. `jred size --meter` writes the limits of a drive as Rust source (docs/duty-meter.md).
//!
//! Means cover the time since the start, or a [`Window::Exponential`], which forgets; then t above is the window's effective length. Extremes and
//! counts always cover the time since the start.
//!
//! # Accuracy
//!
//! All sums are compensated (W. Kahan, *Further remarks on reducing truncation errors*, CACM 8 (1965) 40): a sum of n terms of one sign is accurate
//! to (2 + n·ε)·ε, so that no machine runs long enough to lose a digit in `f32`. After 10⁶ ticks in `f32`, every figure agrees to 2e-7 with the same
//! sums in `f64` (test `single_precision_keeps_its_digits_over_a_million_ticks`); a plain sum is wrong by 2e-4.
//!
//! # Cost
//!
//! A tick has no division, no root, no double precision in `f32`, and no panic path: 165 instructions on a Cortex-M4F with a peak curve of three
//! points, 171 with an exponential window (`scripts/test counts`). [`Meter::figures`] and [`Meter::verdicts`], which need not run in the control
//! loop, need two roots and a few divisions.
//!
//! ```
//! use jred::duty::{Curve, LimitError, Limits, Meter, Verdict, Window};
//!
//! # fn main() -> Result<(), LimitError> {
//! // A motor of 3.2 N·m at standstill and 2.4 N·m at 314 rad/s, 9.6 N·m peak up to 250 rad/s; limits at 80 %.
//! let limits = Limits::new()
//!     .with_continuous(Curve::new(&[[0.0, 0.8 * 3.2], [314.0, 0.8 * 2.4]])?)
//!     .with_peak(Curve::new(&[[250.0, 0.8 * 9.6], [314.0, 0.8 * 6.0]])?)
//!     .with_speed(0.9 * 314.0);
//! let mut meter = Meter::<f32>::new(limits, 1e-3, Window::SinceStart)?;
//! for k in 0..1000 {
//!     let torque = if k < 250 { 6.0 } else { 0.5 };
//!     meter.tick(torque, 100.0, 0.0);
//! }
//! meter.count_cycle();
//! let figures = meter.figures();
//! assert!((figures.rms_torque - 3.0311).abs() < 1e-4);
//! let verdicts = meter.verdicts();
//! assert_eq!(verdicts.rms_torque, Verdict::Exceeded); // 3.03 N·m of 2.36 N·m
//! assert_eq!(verdicts.peak_torque, Verdict::Satisfied);
//! assert_eq!(verdicts.output_peak, Verdict::NotChecked);
//! # Ok(())
//! # }
//! ```

mod curve;
mod error;
mod limits;
mod meter;
mod sum;

pub use curve::{Curve, MAX_POINTS};
pub use error::LimitError;
pub use limits::{Limits, Verdict, Verdicts};
pub use meter::{Figures, MOST_SPEED, MOST_TORQUE, Meter, Window};
