//! Servo sizing for machines whose inertia depends on the angle: selects the drives of a catalogue that suit a machine.
//!
//! This crate lies between [`jred_analysis`], which analyses the machine that [`jred_file`] reads, and `jred-report`, which writes the results.
//! Nothing is printed.
//!
//! 1. [`catalogue`]: motors, gearboxes, amplifiers and resistors, and their allowed combinations.
//! 2. [`motor`]: the limits of a motor: winding, torque-speed envelope.
//! 3. [`cycle`]: the duty of the machine, prepared once, so that a drive takes a fraction of a microsecond.
//! 4. [`thermal`] and [`bus`]: the temperatures of a motor and the voltage of the DC bus, over time.
//! 5. [`judge`]: every rule's figure and rating for one drive.
//! 6. [`select`]: all drives of a catalogue, judged, filtered, ranked.
//! 7. [`study`]: many machines: varied quantities, sensitivities, tolerances.
//! 8. [`explain`] and [`meter`]: the reasons for a drive's rank, and its limits for the firmware's duty meter.
//! 9. [`settings`]: figures for the parameters of a drive.
#![forbid(unsafe_code)]

pub mod bus;
pub mod catalogue;
pub mod cell;
pub mod cycle;
pub mod explain;
pub mod judge;
pub mod meter;
pub mod motor;
pub mod select;
pub mod settings;
pub mod study;
pub mod thermal;
pub mod threads;
