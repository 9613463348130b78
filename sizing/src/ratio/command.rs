//! `jred ratio`.

use std::collections::HashSet;

use miette::{IntoDiagnostic as _, Result, miette};
use rayon::prelude::*;

use super::ranges::{Found, Trial};
use super::{Gear, Moments, accelerating_factor};
use crate::catalogue::{Catalogue, MotorKind, Prepared};
use crate::cli::search::Ratio;
use crate::commands::{Done, print};
use crate::cycle::Cycle;
use crate::duty::Duty;
use crate::filter::Filter;
use crate::input;
use crate::machine::MachineFile;
use crate::output::short;
use crate::rule::Rule;
use crate::size::Selection;
use crate::vary::command::catalogue;
use crate::vary::rows::Cell;
use crate::vary::sheet::Sheet;
use crate::vary::study::sizeable;

/// Runs `jred ratio`.
///
/// # Errors
/// Bad input.
pub fn ratio(options: &Ratio) -> Result<Done> {
    let mut file = input::read(&options.file)?;
    if let Some(word) = &options.supply.rules {
        file.rules = crate::rules::command::chosen(&file.rules, word)?;
    }
    sizeable(&file)?;
    let motion = file
        .motion
        .as_ref()
        .ok_or_else(|| miette!("the machine file has no [motion]"))?;
    let mut catalogue = catalogue(&options.supply, &Filter::default())?;
    if crate::commands::input_kind(&file)? == MotorKind::Linear {
        return Err(miette!(
            help = "`jred size` takes linear motors; a [[drive_train]] makes the input turn",
            "the drive link slides: a linear motor has no ratio to choose"
        ));
    }
    crate::commands::fit_input(&mut catalogue, &file)?;
    let duty = Duty::new(&file, motion, options.supply.steps as usize).into_diagnostic()?;
    let gear = Gear {
        inertia: options.gearbox_inertia.unwrap_or(0.0),
        efficiency: options.efficiency,
    };
    let study = Ratios {
        file: &file,
        duty: &duty,
        cycle: &Cycle::new(&duty),
        motors: &catalogue.prepare(&file.site),
        catalogue: &catalogue,
        gear,
    };
    let sheet = study.sheet();
    print(&sheet.write(options.format))?;
    let possible = sheet.columns.iter().position(|name| name == "ratio from");
    let any = sheet
        .rows
        .iter()
        .any(|row| possible.is_some_and(|k| row.get(k) != Some(&Cell::Empty)));
    Ok(if any { Done::Holds } else { Done::Violated })
}

struct Ratios<'a> {
    file: &'a MachineFile,
    duty: &'a Duty,
    cycle: &'a Cycle,
    motors: &'a [Prepared],
    catalogue: &'a Catalogue,
    gear: Gear,
}

const COLUMNS: [&str; 13] = [
    "motor",
    "rated power [W]",
    "alpha [W/s]",
    "beta [W/s]",
    "best ratio",
    "RMS torque there [N m]",
    "RMS ratio from",
    "RMS ratio to",
    "ratio from",
    "ended by",
    "ratio to",
    "ended by (above)",
    "gearboxes",
];

impl Ratios<'_> {
    fn sheet(&self) -> Sheet {
        let rules = &self.file.rules;
        let share = rules.limit(Rule::RmsTorque).fail.unwrap_or(1.0);
        let selection = Selection::new(
            self.catalogue,
            self.motors,
            self.cycle,
            &self.file.site,
            rules,
        );
        let fits: HashSet<(&str, &str)> = (selection.fit.iter())
            .filter_map(|c| Some((c.drive.motor.key.as_str(), c.drive.gearbox?.key.as_str())))
            .collect();
        let mut order: Vec<usize> = (0..self.catalogue.motors.len()).collect();
        let power = |k: &usize| {
            let motor = self.catalogue.motors.get(*k);
            motor
                .and_then(crate::catalogue::Motor::rated_power)
                .unwrap_or(f64::INFINITY)
        };
        order.sort_by(|a, b| power(a).total_cmp(&power(b)));
        let rows = order
            .par_iter()
            .flat_map_iter(|k| self.rows(*k, share, &fits))
            .collect();
        let gear = match self.gear {
            Gear::IDEAL => "no inertia and no losses of the gearbox".to_owned(),
            Gear {
                inertia,
                efficiency,
            } => format!(
                "a gearbox of {} % efficiency and {} kg cm^2 at its input",
                short(efficiency * 100.0),
                short(inertia * 1e4)
            ),
        };
        Sheet {
            schema: "jred-ratio/1",
            title: format!("{}: gear ratio for every motor of the catalogue, with {gear}", self.file.title),
            columns: COLUMNS.map(str::to_owned).to_vec(),
            rows,
            notes: vec![
                format!(
                    "alpha: (rated torque × {})²/J, the accelerating factor; beta: the load factor. A motor with alpha below \
                     beta is too small with any ratio.",
                    short(share)
                ),
                "best ratio: smallest RMS torque. RMS ratio: where that torque is within the limit, for the rated torque. \
                 Ratio: where the motor holds every rule, with the S1 torque of its speed and its peak torque, speed, holding \
                 torque and inertia ratio; ended by: the rule that is broken beyond."
                    .to_owned(),
                "gearboxes: those of the catalogue with a ratio in the range; in brackets, a drive with it breaks a rule, by \
                 the gearbox's own limits, inertia or losses."
                    .to_owned(),
            ],
        }
    }

    /// One row for each range of ratios with which the motor holds every rule; nearly always there is one, or none.
    fn rows(&self, index: usize, share: f64, fits: &HashSet<(&str, &str)>) -> Vec<Vec<Cell>> {
        let parts = self.catalogue.motors.get(index).zip(self.motors.get(index));
        let Some((motor, prepared)) = parts else {
            return Vec::new();
        };
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
        let rms = limit.and_then(|limit| moments.range(limit));
        let of_motor: [Cell; 8] = [
            motor.key.as_str().into(),
            motor.rated_power().into(),
            limit
                .map(|limit| accelerating_factor(limit, moments.inertia))
                .into(),
            moments.load_factor().into(),
            best.into(),
            best.map(|best| moments.rms_torque(best)).into(),
            rms.map(|[from, _]| from).into(),
            rms.map(|[_, to]| to).into(),
        ];
        let ranges = trial.ranges(best).into_iter().map(Some);
        let mut ranges: Vec<Option<Found>> = ranges.collect();
        if ranges.is_empty() {
            ranges.push(None);
        }
        let row = |found: Option<Found>| -> Vec<Cell> {
            let ended = |rule: Option<Rule>| rule.map_or(Cell::Empty, |rule| rule.name().into());
            let gearboxes = self.catalogue.gearboxes.iter();
            let inside = gearboxes.filter(|g| {
                found.is_some_and(|found| (found.range[0]..=found.range[1]).contains(&g.ratio))
            });
            let names = inside.map(|g| {
                if fits.contains(&(motor.key.as_str(), g.key.as_str())) {
                    g.key.clone()
                } else {
                    format!("({})", g.key)
                }
            });
            let names: Vec<String> = names.collect();
            let of_range = [
                found.map(|found| found.range[0]).into(),
                ended(found.and_then(|found| found.below)),
                found.map(|found| found.range[1]).into(),
                ended(found.and_then(|found| found.above)),
                names.join(" ").into(),
            ];
            of_motor.iter().cloned().chain(of_range).collect()
        };
        ranges.into_iter().map(row).collect()
    }
}
