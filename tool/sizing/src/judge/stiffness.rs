//! Whether the machine is rigid enough to be sized as a rigid body (VDI 2149), and its backlash.
//!
//! The gearbox and the shafts are springs in series between two masses, the rotor and the machine. A motor that holds its position is a fixed end,
//! and the machine oscillates with f_1 = √(c/J)/2π. With a free rotor the frequency is higher, √(c/J + c/(i²·J_1))/2π. The first, lower one is
//! checked, at the largest J of the cycle, where it is lowest.

use std::f64::consts::TAU;

use super::{Context, Grounds, Record};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::site::ToolPlace;

/// Measures both; they depend only on gearbox, machine and cycle, not on the motor.
pub(super) fn measure(context: &Context, findings: &mut impl Record) {
    let frequency = stiffness(context).map_or(Finding::UNKNOWN, |stiffness| {
        let fixed = frequency(stiffness, 1.0 / context.cycle.inertia().max);
        Finding::new(fixed, context.cycle.mechanics().drive_frequency)
    });
    findings.set(Rule::NaturalFrequency, frequency);
    if let Some(tool) = &context.site.tool {
        findings.set(
            Rule::Backlash,
            Finding::against(play(context).unwrap_or(f64::NAN), Some(tool.play)),
        );
    }
}

/// Stiffness between rotor and machine at the gearbox output (N·m/rad): gearbox and shafts in series. Shafts not given in the machine file are rigid.
/// `None` without data, or if the gearbox has no data.
fn stiffness(context: &Context) -> Option<f64> {
    let shafts = context.site.shaft_stiffness;
    match context.drive.gearbox {
        None => shafts,
        Some(gearbox) => {
            let own = gearbox.stiffness?;
            Some(shafts.map_or(own, |shafts| own * shafts / (own + shafts)))
        }
    }
}

/// Lowest natural frequency (Hz) over the cycle with a free rotor.
fn free(context: &Context) -> Option<f64> {
    let rotor = context.coefficients.0[0] * context.ratio;
    let inertia = context.cycle.inertia().max;
    Some(frequency(stiffness(context)?, 1.0 / inertia + 1.0 / rotor))
}

/// f = √(c/J)/2π (Hz), from a stiffness (N·m/rad) and the inverse of an inertia (kg·m²).
fn frequency(stiffness: f64, per_inertia: f64) -> f64 {
    (stiffness * per_inertia).sqrt() / TAU
}

/// Backlash at the tool (m or rad): of the gearbox through the drive train, and of the drive train, by the largest transfer function of the motion;
/// `None` if the gearbox has no data.
fn play(context: &Context) -> Option<f64> {
    let mechanics = context.cycle.mechanics();
    let gearbox = match context.drive.gearbox {
        None => 0.0,
        Some(gearbox) => gearbox.backlash?,
    };
    let train = context.site.train_play.unwrap_or(0.0);
    Some(mechanics.tool_slope? * (gearbox / mechanics.train_ratio + train))
}

impl Context<'_> {
    /// The stiffness of a gearbox (N·m/rad) with which the natural frequency is `share` times the drive frequency, in series with the shafts;
    /// infinite if the shafts alone are too soft.
    pub(crate) fn stiffness_for(&self, share: f64) -> f64 {
        let omega = TAU * share * self.cycle.mechanics().drive_frequency;
        let both = self.cycle.inertia().max * omega * omega;
        match self.site.shaft_stiffness {
            None => both,
            Some(shafts) if shafts > both => both * shafts / (shafts - both),
            Some(_) => f64::INFINITY,
        }
    }

    /// The backlash of a gearbox (rad) with which that at the tool is `share` of the allowed one; negative if the drive train alone has more; `None`
    /// without a tool.
    pub(crate) fn backlash_for(&self, share: f64) -> Option<f64> {
        let tool = self.site.tool.as_ref()?;
        let mechanics = self.cycle.mechanics();
        let train = self.site.train_play.unwrap_or(0.0);
        Some((share * tool.play / mechanics.tool_slope? - train) * mechanics.train_ratio)
    }
}

/// Grounds of the natural frequency.
pub(super) fn of_frequency(context: &Context) -> Grounds {
    Grounds::Stiffness {
        free: free(context),
        geared: context.drive.gearbox.is_some(),
        shafts: context.site.shaft_stiffness.is_some(),
    }
}

/// Grounds of the backlash.
pub(super) fn of_backlash(context: &Context) -> Grounds {
    let tool = context.site.tool.as_ref();
    Grounds::Backlash {
        tool: tool.map_or_else(String::new, |tool| tool.name.clone()),
        turns: tool.is_some_and(|tool| tool.place == ToolPlace::Turning),
        train: context.site.train_play.is_some(),
    }
}
