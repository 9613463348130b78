//! Gear ratios for every motor: the best ratio, the ranges in which the motor satisfies every rule, and the gearboxes in them.

use std::collections::HashSet;

use crate::catalogue::{Catalogue, Gearbox, Motor};
use crate::cycle::Cycle;
use crate::motor::envelope::MotorLimits;
use crate::select::ratio::obstacle::Obstacle;
use crate::select::ratio::ranges::{RatioRange, Trial};
use crate::select::ratio::{Gear, Moments, Range, accelerating_factor};
use crate::select::size::Selection;
use crate::threads;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;

/// A machine, and the motors whose ratios are computed.
#[derive(Clone, Copy, Debug)]
pub struct Ratios<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Its duty.
    pub duty: &'a Duty,
    /// The prepared duty.
    pub cycle: &'a Cycle,
    /// Motors and gearboxes.
    pub catalogue: &'a Catalogue,
    /// Limits of the motors, in the order of the catalogue.
    pub motors: &'a [MotorLimits],
    /// Data of a gearbox of any ratio.
    pub gear: Gear,
}

/// A motor and a range of ratios in which it satisfies every rule, or the reason why there is no such range.
#[derive(Clone, Debug)]
pub struct MotorRatio<'a> {
    /// The motor.
    pub motor: &'a Motor,
    /// Moments of the duty with it.
    pub moments: Moments,
    /// The ratio with the smallest RMS torque.
    pub best: Option<f64>,
    /// The torque that the RMS rule allows (N·m).
    pub limit: Option<f64>,
    /// The ratios with an RMS torque within this limit.
    pub rms: Option<Range>,
    /// The range, or the obstacle; `Err(None)`: the range is narrower than the step of the search.
    pub found: Result<RatioRange, Option<Obstacle>>,
    /// The gearboxes with a ratio in the range, each with whether the drive satisfies every rule.
    pub gearboxes: Vec<(&'a Gearbox, bool)>,
}

impl MotorRatio<'_> {
    /// The accelerating factor α of the motor and the load factor β (W/s).
    pub fn factors(&self) -> [Option<f64>; 2] {
        let alpha = self
            .limit
            .map(|limit| accelerating_factor(limit, self.moments.inertia));
        [alpha, self.moments.load_factor()]
    }

    /// The RMS torque at the best ratio (N·m).
    pub fn rms_torque(&self) -> Option<f64> {
        self.best.map(|best| self.moments.rms_torque(best))
    }
}

impl<'a> Ratios<'a> {
    /// One row for each motor (smallest first) and range of ratios that satisfies every rule; usually there is one range or none.
    pub fn rows(&self) -> Vec<MotorRatio<'a>> {
        let rules = &self.file.rules;
        let share = self.rms_share();
        let selection = Selection::new(
            self.catalogue,
            self.motors,
            self.cycle,
            &self.file.site,
            rules,
        );
        let fits: HashSet<(&str, &str)> = (selection.fit.drives())
            .filter_map(|drive| Some((drive.motor.key.as_str(), drive.gearbox?.key.as_str())))
            .collect();
        let mut motors: Vec<(&Motor, &MotorLimits)> =
            self.catalogue.motors.iter().zip(self.motors).collect();
        let power = |motor: &Motor| motor.rated_power().unwrap_or(f64::INFINITY);
        motors.sort_by(|a, b| power(a.0).total_cmp(&power(b.0)));
        let rows = threads::map(&motors, |(motor, prepared)| {
            self.of_motor(motor, prepared, share, &fits)
        });
        rows.into_iter().flatten().collect()
    }

    fn of_motor(
        &self,
        motor: &'a Motor,
        prepared: &MotorLimits,
        share: f64,
        fits: &HashSet<(&str, &str)>,
    ) -> Vec<MotorRatio<'a>> {
        let moments = Moments::new(self.duty, motor, self.gear);
        let best = moments.best_ratio();
        let trial = Trial {
            cycle: self.cycle,
            site: &self.file.site,
            rules: &self.file.rules,
            motor,
            prepared,
            gear: self.gear,
        };
        let limit = motor.rated_torque.map(|torque| share * torque);
        let mut found: Vec<Result<RatioRange, Option<Obstacle>>> =
            trial.ranges(best).into_iter().map(Ok).collect();
        if found.is_empty() {
            found.push(Err(trial.obstacle(best)));
        }
        let row = |found: Result<RatioRange, Option<Obstacle>>| MotorRatio {
            motor,
            moments,
            best,
            limit,
            rms: limit.and_then(|limit| moments.range(limit)),
            gearboxes: self.gearboxes(motor, found.as_ref().ok(), fits),
            found,
        };
        found.into_iter().map(row).collect()
    }

    /// The gearboxes with a ratio in a range, and whether the drive satisfies every rule.
    fn gearboxes(
        &self,
        motor: &Motor,
        found: Option<&RatioRange>,
        fits: &HashSet<(&str, &str)>,
    ) -> Vec<(&'a Gearbox, bool)> {
        let inside = self.catalogue.gearboxes.iter().filter(|g| {
            found.is_some_and(|found| (found.range[0]..=found.range[1]).contains(&g.ratio))
        });
        let fits = |g: &Gearbox| fits.contains(&(motor.key.as_str(), g.key.as_str()));
        inside.map(|g| (g, fits(g))).collect()
    }

    /// The share of the rated torque that the RMS rule allows.
    pub fn rms_share(&self) -> f64 {
        let limit = self.file.rules.limit(Rule::RmsTorque);
        limit.fail.unwrap_or(1.0)
    }
}
