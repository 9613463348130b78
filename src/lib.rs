#![no_std]
#![forbid(unsafe_code)]
// An answer or an error, never a panic. The linker proves it for a tick (examples/no_panic.rs); these lints check the rest.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unimplemented,
        clippy::todo
    )
)]
#![allow(
    clippy::inline_always,
    reason = "the curves of a model are constants of its tick: optimised for size, a tick that is not inlined whole takes three times as many instructions (benches/user)"
)]
#![cfg_attr(docsrs, feature(doc_cfg))]
//! Reduced inertia and torque of machines with one degree of freedom: presses, slider-cranks, linkages, gear trains.
//!
//! A machine with one degree of freedom moves like a single rotating link, its *drive link*, whose inertia and load depend on the angle. This crate
//! computes that link from the machine's dimensions, tabulates it, and evaluates it in every control tick: the torque for a motion, and the
//! acceleration for a torque. It is `no_std`, allocates nothing, contains no unsafe code, and its tick has no panic path.
//!
//! # In firmware
//!
//! A program names its table once, by three types, as `jred export` prints them:
//!
//! ```
//! use jred::axis::{FeedForward, MotionState};
//! use jred::number::FrictionSign;
//! use jred::{CurveSet, FirmwareError, Image, Model, Phase, Spline, curves, include_image};
//!
//! const CURVES: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
//! type Layout = Spline<f32>;
//! type Press = Model<'static, Layout, CURVES>;
//! type PressFeedForward = FeedForward<'static, Layout, CURVES>;
//!
//! fn start() -> Result<PressFeedForward, FirmwareError> {
//!     let image = Image::from_bytes(include_image!("../examples/data/press_f32.jred"))?;
//!     let press: Press = image.model()?;
//!     Ok(FeedForward::new(press, image.validity()))
//! }
//!
//! /// Every tick: the torque (N·m) on the crank for 10 rad/s and 50 rad/s² at φ = 0.5 rad.
//! fn tick(press: &PressFeedForward) -> f32 {
//!     let wanted = MotionState { phase: Phase::from_radians(0.5), omega: 10.0, alpha: 50.0 };
//!     press.at_reference(wanted, FrictionSign::OfSpeed(wanted.omega)).torque
//! }
//! # assert!(tick(&start().unwrap()).is_finite());
//! ```
//!
//! [`axis`] has all steps from an encoder's count to the torque command of a motor: phase, filter, lead time, feed-forward with a status, gearbox and
//! limits, plans, and the governor, which slows down ahead of places where the drive could not follow.
//!
//! # The equation
//!
//! ```text
//! J(φ)·α + ½·J′(φ)·ω² = T + T_red(φ, ω)        (7.12)
//! T_red(φ, ω) = load(φ) − b(φ)·ω − c(φ)·sgn ω
//! ```
//!
//! | symbol | meaning | unit | sign |
//! |---|---|---|---|
//! | φ, ω, α | angle, speed, acceleration of the drive link | rad, rad/s, rad/s² | counter-clockwise positive |
//! | J, J′ | reduced inertia and dJ/dφ | kg·m², kg·m²/rad | J > 0 |
//! | T | torque of the drive on the drive link | N·m | in +φ |
//! | load | torque of weight and process loads on the drive link | N·m | in +φ |
//! | b | viscous coefficient | N·m·s/rad | opposes ω |
//! | c | Coulomb friction and other loads that oppose the motion | N·m | opposes ω |
//!
//! For a drive link that slides read s, v, a, the reduced mass m_red and the force F (7.10). Equation numbers refer to V. G. Nazarenko, *Dynamics of
//! mechanisms*, lecture notes, Minsk 2002.
//!
//! # Data flow
//!
//! ```text
//! Link, Mechanism ─► Machine ─► Reduction ─► tabulate ─► Table ─► Model ─► torque, acceleration
//!  masses, closed     gravity,   J, J′, J″,   smallest     f32, f64,        every tick
//!  forms              loads      T_red        for an error  Q31
//!                                                └─► encode ─► Image (flash) ─┘
//! ```
//!
//! The root has what a tick needs. The rest is in the modules of the layers: [`number`]; [`table`] and [`machine`]; [`mechanism`], [`friction`] and
//! the tick ([`image`], [`duty`]); [`axis`]; [`tabulate`], [`harmonic`] and [`error`]. A layer uses only those before it; each can be used alone.
//! Every item has one path.
//!
//! # From dimensions to a tick
//!
//! ```
//! use jred::error::Error;
//! use jred::machine::{Link, Machine, MassProperties, Reducible};
//! use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
//! use jred::table::words_len;
//! use jred::tabulate::{Request, fill, scratch_len, tabulate};
//! use jred::{Model, Phase, Scale, Spline, curves};
//!
//! fn main() -> Result<(), Error> {
//!     // Crank 50 mm, rod 200 mm; masses in kg, inertias about the centres of mass in kg·m².
//!     let crank = Link::new(MassProperties { mass: 0.8, inertia: 0.0006, com: [0.015, 0.0] })?;
//!     let rod = Link::new(MassProperties { mass: 0.45, inertia: 0.0021, com: [0.075, 0.0] })?;
//!     let slider = Link::point_mass(0.6)?;
//!     let dimensions = SliderCrankDimensions { crank: 0.05, rod: 0.2, offset: 0.0 };
//!     let mechanism = SliderCrank::new(dimensions, Branch::Right, [crank, rod, slider])?;
//!     let machine = Machine::new(mechanism).with_gravity([0.0, -9.81])?;
//!
//!     // The smallest f32 table whose drive torque is right to 0.01 N·m up to 60 rad/s and 400 rad/s².
//!     const MOST: u32 = 128;
//!     let request = Request::new(0.01).with_max_speed(60.0).with_max_acceleration(400.0).with_max_cells(MOST);
//!     let mut scratch = [0.0; scratch_len(MOST, curves::LOAD)];
//!     let mut words = [0.0; words_len::<Spline<f32>>(MOST, curves::LOAD)];
//!     let found = tabulate::<Spline<f32>>(&machine, curves::LOAD, &request, &Scale::SI, &mut scratch, &mut words)?;
//!     assert!(found.torque_error <= 0.01);
//!
//!     // The tick: torque for a motion, and back.
//!     let set = curves::LOAD;
//!     let table = fill::<Spline<f32>>(&machine, set, found.cells, &found.scale, &mut scratch, &mut words)?;
//!     let model = Model::<_, { curves::LOAD }>::new(table)?;
//!     let phase = Phase::from_radians(0.5);
//!     let torque = model.torque(phase, 40.0, 200.0);
//!     let alpha = model.acceleration(phase, 40.0, torque).value;
//!     assert!((alpha - 200.0).abs() < 0.01);
//!
//!     // Against the exact reduction.
//!     let exact = machine.reduction(0.5)?.torque(40.0, 200.0).total();
//!     assert!((f64::from(torque) - exact).abs() < 0.01);
//!     Ok(())
//! }
//! ```
//!
//! # Numbers
//!
//! Mechanisms, reduction and tabulation compute in `f64`: once, on the host or in firmware after a change of payload. Ticks compute in the numbers of
//! the table's [`Format`](table::Format): `f32` (SI units, no double precision anywhere), [`Q31`] and [`Q15`] (fixed point in per-unit, see
//! [`Scale`]; integers only), or `f64`. The same code gives the same bits on every processor: digests of a million random ticks of every format in
//! `f32` and fixed point agree on x86-64, AArch64, WebAssembly and Cortex-M (`scripts/test bits`).
//!
//! A table in fixed point needs machine units that fit its curves: [`Scale::covering`] chooses them. [`tabulate::curves_in_use`] finds the curves of
//! a machine.
//!
//! # Features
//!
//! - `mechanics`, the default: everything that creates tables from machines: [`machine`] except its motion laws, [`mechanism`], [`friction`],
//!   [`tabulate`], the search for [`harmonic`]s and [`error::Error`]. It needs `heapless`. Firmware with a finished image does not need it, and
//!   compiles in a third of the time with `default-features = false`; with it firmware creates tables itself. The linked code is the same in both
//!   cases;
//! - `defmt`: `defmt::Format` for the public value types;
//! - `micromath`: `SliderCrankForm`, a slider-crank without a table.

#[deny(clippy::indexing_slicing)]
pub mod axis;
// Code of a tick reads elements by `get`, never by an index that could be out of bounds.
#[deny(clippy::indexing_slicing)]
mod curve;
#[cfg(feature = "mechanics")]
pub mod error;
mod firmware_error;
#[cfg(feature = "mechanics")]
pub mod friction;
pub mod machine;
mod math;
#[cfg(feature = "mechanics")]
pub mod mechanism;
#[deny(clippy::indexing_slicing)]
pub mod number;
#[cfg(feature = "mechanics")]
pub mod tabulate;
#[deny(clippy::indexing_slicing)]
mod tick;

#[cfg(feature = "micromath")]
pub use curve::SliderCrankForm;
pub use curve::{Cubic, CurveSet, Harmonic, Quadratic, Rows16, Spline, Spline16, curves};
pub use firmware_error::FirmwareError;
pub use number::phase::{Domain, Phase};
pub use number::q15::Q15;
pub use number::q31::Q31;
pub use number::quantity::{Acceleration, MotorTorque, Speed, Torque};
pub use number::scalar::Outcome;
pub use number::scale::Scale;
pub use tick::{AccelerationRange, AnyModel, Image, ImageError, Model, Pieces, TorqueTerms, duty};

/// Tables: formats, words and curves, for programs that create or store their own.
///
/// In the data flow between [`tabulate`] and [`Model`].
pub mod table {
    pub use crate::curve::{
        AccelerationOf, CellCurves, Constants, CurveValues, Format, MAX_CELLS, MotorTorqueOf,
        RowConstants, Shape, SpeedOf, Table, TableError, TorqueOf, Usage, words_len,
    };
    pub use crate::number::spline::{
        CubicSpline, MIN_CELLS, control_points, fit_bounded, fit_periodic,
    };
    // For tests of their accuracy: programs fill a quadratic table by `tabulate`.
    #[doc(hidden)]
    pub use crate::number::spline::{fit_quadratic_bounded, fit_quadratic_periodic};
}

/// Harmonics: a smooth machine as short Fourier series instead of a table of cells.
///
/// Found from its mechanism by [`fit`](harmonic::fit), or on the machine by [`Identification`](axis::Identification); ticked by [`Model`] in the format [`Harmonic`].
///
/// ```
/// use jred::error::Error;
/// use jred::harmonic::{fit, scratch_len, terms};
/// use jred::machine::{Link, Machine, MassProperties, Reducible};
/// use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
/// use jred::table::{Shape, Table, words_len};
/// use jred::tabulate::Request;
/// use jred::{CurveSet, Harmonic, Model, Phase, curves};
///
/// fn main() -> Result<(), Error> {
///     // Crank 30 mm, rod 120 mm, ram 42 kg: weight acts along the guide, so J is even and the load odd in φ.
///     let crank = Link::new(MassProperties { mass: 9.0, inertia: 0.018, com: [0.006, 0.0] })?;
///     let rod = Link::new(MassProperties { mass: 6.5, inertia: 0.03, com: [0.055, 0.0] })?;
///     let links = [crank, rod, Link::point_mass(42.0)?];
///     let dimensions = SliderCrankDimensions { crank: 0.03, rod: 0.12, offset: 0.0 };
///     let mechanism = SliderCrank::new(dimensions, Branch::Right, links)?;
///     let machine = Machine::new(mechanism).with_gravity([9.81, 0.0])?;
///
///     const MOST: u32 = 16;
///     const SET: CurveSet = curves::LOAD | terms::SYMMETRIC;
///     let request = Request::new(0.001).with_max_speed(12.0).with_max_acceleration(60.0).with_max_cells(MOST);
///     let (mut scratch, mut words) = ([0.0; scratch_len(MOST)], [0.0; words_len::<Harmonic<f32>>(MOST, SET)]);
///     let found = fit(&machine, SET, &request, &mut scratch, &mut words)?;
///     assert!(found.torque_error <= 0.001 && found.bytes <= 80);
///
///     let table = Table::new(&words[..found.words], Shape::harmonics(found.harmonics, SET))?;
///     let model = Model::<Harmonic<f32>, SET>::new(table)?;
///     let torque = model.torque(Phase::from_radians(0.5), 10.0, 50.0);
///     let exact = machine.reduction(0.5)?.torque(10.0, 50.0).total();
///     assert!((f64::from(torque) - exact).abs() < 0.001);
///     Ok(())
/// }
/// ```
pub mod harmonic {
    pub use crate::curve::{Circular, Coefficient, Curve, Kind, MAX_HARMONICS, terms};
    #[cfg(feature = "mechanics")]
    pub use crate::tabulate::harmonic::{
        Fit, HarmonicError, fit, measure, scratch_len, terms_in_use,
    };
}

/// A slider-crank in closed form: lengths and masses instead of a table, ticked by [`Model`] in the format [`SliderCrankForm`].
///
/// ```
/// use jred::error::Error;
/// use jred::machine::{Link, Machine, MassProperties, Reducible};
/// use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
/// use jred::slider_crank::{form, terms};
/// use jred::table::{Shape, Table, words_len};
/// use jred::{CurveSet, Model, Phase, SliderCrankForm, curves};
///
/// fn main() -> Result<(), Error> {
///     // Crank 30 mm, rod 120 mm, ram 42 kg; weight acts along the guide.
///     let crank = Link::new(MassProperties { mass: 9.0, inertia: 0.018, com: [0.006, 0.0] })?;
///     let rod = Link::new(MassProperties { mass: 6.5, inertia: 0.03, com: [0.055, 0.0] })?;
///     let links = [crank, rod, Link::point_mass(42.0)?];
///     let dimensions = SliderCrankDimensions { crank: 0.03, rod: 0.12, offset: 0.0 };
///     let mechanism = SliderCrank::new(dimensions, Branch::Right, links)?;
///     let machine = Machine::new(mechanism).with_gravity([9.81, 0.0])?;
///
///     // Seven numbers: r/l, e/l, three of J, two of the load.
///     const SET: CurveSet = curves::LOAD | terms::LOAD_SIN;
///     let mut words = [0.0; words_len::<SliderCrankForm>(0, SET)];
///     assert_eq!(form(&machine, SET, &mut words)?, 7);
///     let table = Table::new(&words, Shape::slider_crank(SET))?;
///     let model = Model::<SliderCrankForm, SET>::new(table)?;
///     let torque = model.torque(Phase::from_radians(0.5), 10.0, 50.0);
///     let exact = machine.reduction(0.5)?.torque(10.0, 50.0).total();
///     assert!((f64::from(torque) - exact).abs() < 1e-6 * exact.abs());
///     Ok(())
/// }
/// ```
#[cfg(feature = "micromath")]
pub mod slider_crank {
    pub use crate::curve::{CrankCoefficient as Coefficient, STEEPEST, crank_terms as terms};
    #[cfg(feature = "mechanics")]
    pub use crate::tabulate::slider_crank::{SliderCrankError, form, set_in_use};
}

/// Table images: a machine's curves as the tool exports them and firmware uses them, in place in flash.
pub mod image {
    pub use crate::tick::{
        Aligned, HEADER_WORDS, ImageCheck, VERSION, Validity, encode, identify, image_len,
    };
}

mod sealed {
    /// Keeps the number traits closed: their contracts are tested type by type.
    pub trait Sealed {}
    /// The bound of loggable types, with the feature `defmt`.
    #[cfg(feature = "defmt")]
    pub trait Logged: defmt::Format {}
    #[cfg(feature = "defmt")]
    impl<T: defmt::Format> Logged for T {}
    #[cfg(not(feature = "defmt"))]
    pub trait Logged {}
    #[cfg(not(feature = "defmt"))]
    impl<T> Logged for T {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for crate::Q15 {}
    impl Sealed for crate::Q31 {}
    impl<S: crate::number::Scalar> Sealed for crate::Spline<S> {}
    impl Sealed for crate::Spline16 {}
    impl<S: crate::number::Scalar> Sealed for crate::Cubic<S> {}
    impl<S: crate::number::Scalar> Sealed for crate::Quadratic<S> {}
    impl Sealed for crate::Rows16 {}
    impl Sealed for crate::Harmonic<f32> {}
    impl Sealed for crate::Harmonic<f64> {}
    #[cfg(feature = "micromath")]
    impl Sealed for crate::SliderCrankForm {}
}

/// The documentation tests compile and run the README's program.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
