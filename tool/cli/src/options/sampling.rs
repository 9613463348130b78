//! Sampling of a cycle.

use clap::Args;
use jred_analysis::duty::{LEAST_TOLERANCE, STEPS, Sampling, TOLERANCE};

/// Largest allowed tolerance.
const MOST_TOLERANCE: f64 = 1e-2;

/// Error of the integrals.
#[derive(Clone, Copy, Debug, Args)]
pub struct Accuracy {
    /// Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01.
    #[arg(long, default_value_t = TOLERANCE, value_parser = tolerance)]
    pub tolerance: f64,
}

/// Instants of the course.
#[derive(Clone, Copy, Debug, Args)]
pub struct Steps {
    /// Approximate least number of instants in a cycle; there are more where the torque bends.
    #[arg(long, default_value_t = STEPS as u32, value_parser = clap::value_parser!(u32).range(16..=super::MOST_STEPS))]
    pub steps: u32,
}

/// Both.
#[derive(Clone, Copy, Debug, Args)]
pub struct SamplingOptions {
    /// Error of the integrals.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// Instants of the course.
    #[command(flatten)]
    pub course: Steps,
}

impl Steps {
    /// The sampling for integrals of this accuracy.
    pub const fn with(&self, accuracy: &Accuracy) -> Sampling {
        Sampling {
            tolerance: accuracy.tolerance,
            steps: self.steps as usize,
        }
    }

    /// The sampling for integrals of the default accuracy.
    pub fn sampling(&self) -> Sampling {
        (self.steps as usize).into()
    }
}

impl SamplingOptions {
    /// The sampling.
    pub const fn sampling(&self) -> Sampling {
        self.course.with(&self.accuracy)
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance: f64 = text
        .parse()
        .map_err(|_| "write a plain number, such as 1e-9")?;
    if (LEAST_TOLERANCE..=MOST_TOLERANCE).contains(&tolerance) {
        Ok(tolerance)
    } else {
        Err(format!(
            "it must be between {LEAST_TOLERANCE:e} and {MOST_TOLERANCE}"
        ))
    }
}
