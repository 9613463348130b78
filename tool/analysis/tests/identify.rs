//! Identification from logs of machines whose curves are known exactly, with the noise of a drive.

mod accuracy;
mod faults;
mod friction;
mod motor;
mod plant;
mod rows;
