//! Figures and results of a monitor.

/// Figures of a [`Monitor`](super::Monitor).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Watch {
    /// The largest torque (N·m): that of the drive. Its 2⁻²⁰ is the resolution; beyond twice of it torques are limited.
    pub largest: f32,
    /// Reference cycles for the bins, and as many for the figures of a cycle: 32 or more.
    pub reference: u32,
    /// M: cycles without a false alarm, up to a million.
    pub cycles: u32,
    /// p: probability of a false jam in them, and of false wear or a wrong payload; 10⁻⁹ to 0.5.
    pub false_alarm: f32,
}

/// Result of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Seen {
    /// The reference is not complete.
    #[default]
    Learning,
    /// As usual.
    Usual,
    /// The torque is unusual in its place: a jam, a collision, or a load that is missing.
    Jam,
    /// The reference cycles were never here, or too rarely.
    Unknown,
    /// The torque was NaN. It counts in no figure.
    Invalid,
}

/// Result of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Cycle {
    /// The drifts were judged: the reference is complete, and the cycle had no jam and as many ticks as the mean reference cycle, to an eighth.
    pub judged: bool,
    /// Mean of e − mean over the cycle, without the payload (N·m): of a machine that turns forward, minus the friction that was added.
    pub friction: f32,
    /// Root-mean-square of (e − mean)/σ without payload and friction: 1 as in the reference.
    pub spread: f32,
    /// Payload that was added, in units of the payload.
    pub payload: f32,
    /// Friction or spread drifted.
    pub wear: bool,
    /// The payload is not that of the reference.
    pub wrong_payload: bool,
    /// Number of ticks with a jam.
    pub jams: u32,
}
