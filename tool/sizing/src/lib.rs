//! Servo sizing for machines whose inertia depends on the angle: which drives of a catalogue suit a machine.
//!
//! Between [`jred_machine`], which reads and analyses a machine, and `jred-report`, which writes what is found here. Results are
//! data; nothing is printed.
//!
//! 1. [`catalogue`]: motors, gearboxes, amplifiers and resistors, and which go together.
//! 2. [`motor`]: what a motor can do: winding, torque-speed envelope.
//! 3. [`cycle`]: what the machine asks of any drive, prepared once, so that a drive takes a fraction of a microsecond.
//! 4. [`thermal`] and [`bus`]: the temperatures of a motor and the voltage of the DC bus, over time.
//! 5. [`judge`]: every rule's figure and rating for one drive.
//! 6. [`select`]: all drives of a catalogue, judged, filtered, ranked.
//! 7. [`study`]: many machines: varied quantities, sensitivities, tolerances.
//! 8. [`explain`] and [`meter`]: why a drive stands where it does, and its limits for the firmware's duty meter.
#![forbid(unsafe_code)]

pub mod bus;
pub mod catalogue;
pub mod cycle;
pub mod explain;
pub mod judge;
pub mod meter;
pub mod motor;
pub mod select;
pub mod study;
pub mod thermal;
pub mod threads;
