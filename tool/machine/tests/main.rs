//! The one test program of the package.
#![allow(clippy::disallowed_methods, reason = "tests show paths that they made")]

mod benchmarks;
mod between_places;
mod cross_check;
mod duty;
mod duty_meter;
mod every_machine;
mod formula;
mod import;
mod largest;
mod linkage_file;
mod machine_file;
mod mechanisms;
mod motion;
mod names;
mod proven_export;
mod reading;
mod rules;
mod schedule;
mod simulate;
mod spline;
mod steady;
mod supply;
#[path = "../../support/mod.rs"]
mod support;
mod swing;
mod variator;
mod warned;
