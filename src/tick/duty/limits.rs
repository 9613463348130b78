//! Limits of the figures, and verdicts.

use super::{Curve, Figures, LimitError};
use crate::math::Real;

/// Limits of a drive. A limit that is `None` is not checked; its verdict is [`Verdict::NotChecked`].
///
/// Sizing rules that allow a share of a rating (80 % of the S1 torque, say) become limits that include the share.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Limits<R> {
    /// RMS torque of the motor over the mean speed (N·m over rad/s).
    pub continuous: Option<Curve<R>>,
    /// Torque of the motor over speed, instant by instant (N·m over rad/s).
    pub peak: Option<Curve<R>>,
    /// Largest speed of the motor (rad/s).
    pub speed: Option<R>,
    /// Mean speed of the motor, for example of a gearbox input (rad/s).
    pub mean_speed: Option<R>,
    /// Largest torque at the gearbox output, T2B (N·m).
    pub output_peak: Option<R>,
    /// Root-mean-cube torque at the gearbox output, T2N (N·m).
    pub output_mean: Option<R>,
    /// Mean regenerative power, for example of a brake resistor (W).
    pub regenerative_power: Option<R>,
    /// Cycles per hour up to which T2B applies.
    pub cycles_per_hour: Option<R>,
}

impl<R: Copy> Limits<R> {
    /// No limits.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            continuous: None,
            peak: None,
            speed: None,
            mean_speed: None,
            output_peak: None,
            output_mean: None,
            regenerative_power: None,
            cycles_per_hour: None,
        }
    }

    /// Adds a limit of the motor's RMS torque over the mean speed (N·m over rad/s).
    #[must_use]
    pub const fn with_continuous(self, limit: Curve<R>) -> Self {
        Self {
            continuous: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the motor's torque over speed, instant by instant (N·m over rad/s).
    #[must_use]
    pub const fn with_peak(self, limit: Curve<R>) -> Self {
        Self {
            peak: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the motor's speed (rad/s).
    #[must_use]
    pub const fn with_speed(self, limit: R) -> Self {
        Self {
            speed: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the motor's mean speed (rad/s).
    #[must_use]
    pub const fn with_mean_speed(self, limit: R) -> Self {
        Self {
            mean_speed: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the torque at the gearbox output, T2B (N·m).
    #[must_use]
    pub const fn with_output_peak(self, limit: R) -> Self {
        Self {
            output_peak: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the root-mean-cube torque at the gearbox output, T2N (N·m).
    #[must_use]
    pub const fn with_output_mean(self, limit: R) -> Self {
        Self {
            output_mean: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the mean regenerative power (W).
    #[must_use]
    pub const fn with_regenerative_power(self, limit: R) -> Self {
        Self {
            regenerative_power: Some(limit),
            ..self
        }
    }

    /// Adds a limit of the cycles per hour up to which T2B applies.
    #[must_use]
    pub const fn with_cycles_per_hour(self, limit: R) -> Self {
        Self {
            cycles_per_hour: Some(limit),
            ..self
        }
    }
}

impl<R: Copy> Default for Limits<R> {
    fn default() -> Self {
        Self::new()
    }
}

impl<R: Real> Limits<R> {
    pub(super) fn check(&self) -> Result<(), LimitError> {
        for (what, limit) in [
            ("limit of the speed", self.speed),
            ("limit of the mean speed", self.mean_speed),
            ("limit of the output's peak torque", self.output_peak),
            ("limit of the output's mean torque", self.output_mean),
            ("limit of the regenerative power", self.regenerative_power),
            ("limit of the cycles an hour", self.cycles_per_hour),
        ] {
            let Some(limit) = limit else { continue };
            if !limit.is_finite() {
                return Err(LimitError::NotFinite(what));
            }
            if limit < R::from_f64(0.0) {
                return Err(LimitError::Negative(what));
            }
        }
        Ok(())
    }
}

/// Whether a figure satisfies its limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Verdict {
    /// There is no limit, or no reading yet.
    #[default]
    NotChecked,
    /// At or below the limit.
    Satisfied,
    /// Above the limit.
    Exceeded,
}

/// One verdict for each of the [`Limits`], and one for the readings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Verdicts {
    /// RMS torque, against the continuous torque at the mean speed.
    pub rms_torque: Verdict,
    /// Torque at every instant, against the peak torque at its speed.
    pub peak_torque: Verdict,
    /// Largest speed.
    pub speed: Verdict,
    /// Mean speed.
    pub mean_speed: Verdict,
    /// Largest torque at the gearbox output.
    pub output_peak: Verdict,
    /// Root-mean-cube torque at the gearbox output.
    pub output_mean: Verdict,
    /// Mean regenerative power.
    pub regenerative_power: Verdict,
    /// Cycles per hour.
    pub cycles_per_hour: Verdict,
    /// Exceeded if a reading was invalid: see [`Figures::invalid`].
    pub readings: Verdict,
}

impl Verdicts {
    pub(super) fn of<R: Real>(limits: &Limits<R>, figures: &Figures<R>) -> Self {
        if figures.ticks == 0 {
            return Self {
                readings: match figures.invalid {
                    0 => Verdict::NotChecked,
                    _ => Verdict::Exceeded,
                },
                ..Self::default()
            };
        }
        let judge = |figure: R, limit: Option<R>| match limit {
            None => Verdict::NotChecked,
            Some(limit) if figure <= limit => Verdict::Satisfied,
            Some(_) => Verdict::Exceeded,
        };
        let one = R::from_f64(1.0);
        Self {
            rms_torque: judge(
                figures.rms_torque,
                limits.continuous.map(|curve| curve.at(figures.mean_speed)),
            ),
            peak_torque: match figures.peak_share {
                None => Verdict::NotChecked,
                Some(share) => judge(share, Some(one)),
            },
            speed: judge(figures.peak_speed, limits.speed),
            mean_speed: judge(figures.mean_speed, limits.mean_speed),
            output_peak: judge(figures.output_peak, limits.output_peak),
            output_mean: judge(figures.output_mean, limits.output_mean),
            regenerative_power: judge(figures.regenerative_power, limits.regenerative_power),
            cycles_per_hour: match figures.cycles {
                0 => Verdict::NotChecked,
                _ => judge(figures.cycles_per_hour, limits.cycles_per_hour),
            },
            readings: match figures.invalid {
                0 => Verdict::Satisfied,
                _ => Verdict::Exceeded,
            },
        }
    }

    /// All verdicts, in the order of the fields.
    #[must_use]
    pub const fn all(&self) -> [Verdict; 9] {
        [
            self.rms_torque,
            self.peak_torque,
            self.speed,
            self.mean_speed,
            self.output_peak,
            self.output_mean,
            self.regenerative_power,
            self.cycles_per_hour,
            self.readings,
        ]
    }

    /// Whether no limit is exceeded. Limits that were not checked do not count.
    #[must_use]
    pub fn satisfied(&self) -> bool {
        !self.all().contains(&Verdict::Exceeded)
    }
}
