//! The rules that a drive is judged by, with their limits.

/// Limits of the sizing rules. All can be overridden in `[rules]` of the machine file, and all are printed.
///
/// The defaults and their sources are listed in `docs/sizing-rules.md`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Rules {
    /// RMS torque as a share of the S1 torque at mean speed.
    pub rms_torque: f64,
    /// Torque as a share of the peak-torque envelope at the same speed.
    pub peak_torque: f64,
    /// Largest speed as a share of the motor's maximum speed.
    pub speed: f64,
    /// Largest torque against gravity as a share of the standstill torque.
    pub gravity_hold: f64,
    /// Largest inertia ratio λ allowed.
    pub inertia_ratio: f64,
    /// Inertia ratio λ above which a warning is given.
    pub inertia_ratio_warning: f64,
    /// Gearbox: peak output torque as a share of its acceleration torque.
    pub gearbox_peak: f64,
    /// Gearbox: root-mean-cube output torque as a share of its rated torque.
    pub gearbox_rated: f64,
    /// Gearbox: mean and largest input speed as a share of its rated and maximum input speed.
    pub gearbox_speed: f64,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            rms_torque: 0.8,
            peak_torque: 0.8,
            speed: 0.9,
            gravity_hold: 0.6,
            inertia_ratio: 10.0,
            inertia_ratio_warning: 5.0,
            gearbox_peak: 1.0,
            gearbox_rated: 1.0,
            gearbox_speed: 1.0,
        }
    }
}
