//! Contributions to the motor torque and to the inertia at the motor.
//!
//! At every instant the motor torque is a sum of contributions, one for each part of the machine and each of its effects:
//!
//! ```text
//! T = Σ links, flywheel (J_k·α + ½·J_k′·ω²)/(i_t·i) + Σ links U_k′/(i_t·i) + Σ springs + Σ loads + Σ dampers
//!   + train: J_t·α_in/i + (τ − τ_lossless)/i + gearbox: J_G·i·α_in + (T_out(τ) − τ/i) + no-load torque + (J_M + J_B)·i·α_in
//!   + motor friction
//! ```
//!
//! i_t is the ratio of the machine's drive train, i the ratio of the gearbox, J_t the inertia of the drive train at its input, α_in and τ the
//! acceleration and the torque there. A loss is the torque of a
//! stage beyond its lossless torque. The contributions of an instant add up to the motor torque (test `tests/explain.rs`, 1e-12 of the largest).
//!
//! The share of each in the mean square is ⟨T_k·T⟩/⟨T²⟩, its projection on the whole: the shares add up to one. A share may be negative: without that
//! contribution the RMS torque would be greater.

use jred::error::Error;
use serde::Serialize;

use super::contributions::{Contribution, Contributions, Effect, PartKind};
use crate::catalogue::Drive;
use crate::cycle::form::loads;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::number::figures::Figures;
use jred_file::number::rounding::cleared;
use jred_file::units::Vocabulary;

/// Contribution of one part or effect to the motor torque.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Share {
    /// Name.
    pub name: String,
    /// Torque at the motor over the cycle (N·m).
    #[serde(rename = "torque [N m]")]
    pub torque: Figures,
    /// Share of the mean square torque; all add up to one, or are zero without a torque.
    #[serde(rename = "share of mean square")]
    pub mean_square: f64,
    /// Torque (N·m) at the instant of the largest motor torque.
    #[serde(rename = "at peak [N m]")]
    pub at_peak: f64,
    /// Energy that it takes from the motor in a cycle (J).
    #[serde(rename = "energy [J]")]
    pub energy: f64,
}

impl Share {
    /// Clears figures that are only rounding relative to the whole, or to the energy that flows back and forth (J).
    fn cleared(self, whole: &Self, stored: f64) -> Self {
        Self {
            torque: self.torque.cleared(whole.torque.peak()),
            mean_square: cleared(self.mean_square, 1.0),
            at_peak: cleared(self.at_peak, whole.torque.peak()),
            energy: cleared(self.energy, stored),
            ..self
        }
    }
}

/// Contribution of one part to the inertia at the motor.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct InertiaShare {
    /// Name of the part.
    pub name: String,
    /// Inertia at the motor over the cycle (kg·m²).
    #[serde(rename = "inertia [kg m^2]")]
    pub inertia: Figures,
    /// Share of the mean.
    #[serde(rename = "share of mean")]
    pub of_mean: f64,
}

/// The contributions to the motor torque and to the inertia at the motor.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Breakdown {
    /// Name of the drive.
    pub drive: String,
    /// Names and units of its figures.
    #[serde(skip)]
    pub words: &'static Vocabulary,
    /// Time of the largest motor torque (s).
    #[serde(rename = "peak at [s]")]
    pub peak_time: f64,
    /// Energy that flows back and forth in a cycle (J).
    #[serde(skip)]
    stored: f64,
    /// Total.
    pub total: Share,
    /// By effect.
    pub effects: Vec<Share>,
    /// By part.
    pub parts: Vec<Share>,
    /// The inertia at the motor, by part.
    pub inertia: Vec<InertiaShare>,
    /// Its sum.
    pub total_inertia: InertiaShare,
}

impl Breakdown {
    /// The figures of every part and every effect.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn new(file: &MachineFile, duty: &Duty, drive: &Drive) -> Result<Self, Error> {
        Ok(Self::of(
            duty,
            drive,
            &Contributions::new(file, duty, drive)?,
        ))
    }

    /// Reference energy (J) for recognising rounding errors.
    pub fn turned_over(&self) -> f64 {
        let energies = self.effects.iter().map(|share| share.energy.abs());
        energies
            .fold(self.total.energy.abs(), f64::max)
            .max(self.stored)
    }

    /// The figures of existing contributions.
    pub fn of(duty: &Duty, drive: &Drive, contributions: &Contributions) -> Self {
        let words = drive.motor.kind.vocabulary();
        let coefficients = drive.coefficients();
        let whole: Vec<f64> = duty
            .instants
            .iter()
            .map(|i| coefficients.torque(&loads(i)))
            .collect();
        let peak = (0..whole.len())
            .max_by(|&a, &b| whole[a].abs().total_cmp(&whole[b].abs()))
            .unwrap_or(0);
        let square = duty.integral_of(whole.iter().map(|t| t * t));
        let ratio = drive.ratio();
        let share = |name: &str, torque: &[f64]| {
            let product = duty.integral_of(torque.iter().zip(&whole).map(|(a, b)| a * b));
            let power = duty.instants.iter().zip(torque);
            Share {
                name: name.to_owned(),
                torque: duty.figures_between(torque),
                mean_square: if square > 0.0 { product / square } else { 0.0 },
                at_peak: torque.get(peak).copied().unwrap_or(0.0),
                energy: duty.integral_of(power.map(|(i, t)| t * i.input_speed * ratio)),
            }
        };
        let sum_of = |chosen: &dyn Fn(&Contribution) -> bool| {
            let mut sum = vec![0.0; whole.len()];
            for one in contributions.torques.iter().filter(|one| chosen(one)) {
                for (sum, torque) in sum.iter_mut().zip(&one.torque) {
                    *sum += torque;
                }
            }
            sum
        };
        let acts = |share: &Share| share.torque.peak() > 0.0;
        let mut parts: Vec<(PartKind, &str)> = Vec::new();
        for one in &contributions.torques {
            if !parts.contains(&(one.kind, &one.part)) {
                parts.push((one.kind, &one.part));
            }
        }
        let parts = parts.into_iter().map(|(kind, part)| {
            let own = sum_of(&|one| one.kind == kind && one.part == part);
            share(part, &own)
        });
        let effects = Effect::ALL.into_iter().map(|effect| {
            let own = sum_of(&|one| one.effect == effect);
            share(&effect.name(words), &own)
        });
        let mut inertia_whole = vec![0.0; whole.len()];
        for (_, values) in &contributions.inertias {
            for (sum, value) in inertia_whole.iter_mut().zip(values) {
                *sum += value;
            }
        }
        let mean = duty.figures_of(&inertia_whole).mean;
        let inertia = |name: &str, values: &[f64]| {
            let inertia = duty.figures_of(values);
            InertiaShare {
                name: name.to_owned(),
                inertia,
                of_mean: if mean > 0.0 { inertia.mean / mean } else { 0.0 },
            }
        };
        let stored = {
            let power = duty.instants.iter().zip(&whole);
            duty.integral_of(power.map(|(i, torque)| (torque * i.input_speed * ratio).abs()))
        };
        let total = share(&format!("motor {}", words.torque), &whole);
        let cleared = |share: Share| share.cleared(&total, stored);
        let effects = effects.filter(acts).map(cleared).collect();
        let parts = parts.filter(acts).map(cleared).collect();
        let inertias = contributions.inertias.iter();
        let inertias = inertias.map(|(name, values)| inertia(name, values));
        Self {
            drive: drive.name(),
            words,
            peak_time: duty.instants.get(peak).map_or(0.0, |i| i.t),
            stored,
            total,
            effects,
            parts,
            inertia: inertias.filter(|i| i.inertia.max > 0.0).collect(),
            total_inertia: inertia("at the motor", &inertia_whole),
        }
    }
}
