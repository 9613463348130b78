//! The state of the first drive link.

/// Position (rad, or m) and speed (rad/s, or m/s) of the first drive link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DriveState {
    pub(crate) phi: f64,
    pub(crate) omega: f64,
}

impl From<[f64; 2]> for DriveState {
    fn from([phi, omega]: [f64; 2]) -> Self {
        Self { phi, omega }
    }
}

/// A time (s), and the position of the first drive link at that time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Passage {
    pub(super) t: f64,
    pub(super) phi: f64,
}
