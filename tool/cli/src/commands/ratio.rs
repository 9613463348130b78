//! `jred ratio`.

use std::collections::HashSet;

use miette::{Result, miette};
use rayon::prelude::*;

use crate::commands::core_error::core_report;
use crate::commands::vary::catalogue;
use crate::commands::{Done, print};
use crate::options::search::Ratio;
use jred_machine::analysis::duty::Duty;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::rule::Rule;
use jred_machine::number::rounding::{short, significant};
use jred_machine::read;
use jred_report::table::sheet::{Reading, Sheet};
use jred_sizing::catalogue::{Catalogue, Motor, MotorKind};
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::Prepared;
use jred_sizing::select::filter::Filter;
use jred_sizing::select::ratio::obstacle::Obstacle;
use jred_sizing::select::ratio::ranges::{Found, Trial};
use jred_sizing::select::ratio::{Gear, Moments, Range, accelerating_factor};
use jred_sizing::select::size::Selection;
use jred_sizing::study::cell::Cell;
use jred_sizing::study::common::sizeable;

/// Runs `jred ratio`.
///
/// # Errors
/// Bad input.
pub fn ratio(options: &Ratio) -> Result<Done> {
    let mut file = read::read(&options.file)?;
    if let Some(set) = options.supply.rule_set()? {
        file.rules = read::rules_based_on(&file.rules, set)?;
    }
    sizeable(&file)?;
    let motion = file.required_motion()?;
    let named = Filter {
        motors: options.motor.clone(),
        ..Filter::default()
    };
    let mut catalogue = catalogue(&options.supply, &named)?;
    if jred_sizing::select::fit::input_kind(&file) == MotorKind::Linear {
        return Err(miette!(
            help =
                "use `jred size` for linear motors, or add a [[drive_train]] with a rotating input",
            "the drive link slides: there is no ratio to choose for a linear motor"
        ));
    }
    jred_sizing::select::fit::fit_input(&mut catalogue, &file)?;
    let duty = Duty::new(&file, motion, options.supply.steps as usize).map_err(core_report)?;
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
        top: options.top.map_or(usize::MAX, |top| top as usize),
    };
    let rows = study.rows();
    let any = rows.iter().any(|row| row.found.is_ok());
    print(&study.sheet(rows).write(options.format))?;
    Ok(if any { Done::Holds } else { Done::Violated })
}

struct Ratios<'a> {
    file: &'a MachineFile,
    duty: &'a Duty,
    cycle: &'a Cycle,
    motors: &'a [Prepared],
    catalogue: &'a Catalogue,
    gear: Gear,
    /// Largest number of suitable motors to list; `usize::MAX` lists all motors.
    top: usize,
}

/// A motor and a range of ratios in which it satisfies every rule, or the reason why there is none.
struct Row<'a> {
    motor: &'a Motor,
    moments: Moments,
    best: Option<f64>,
    /// The torque that the RMS rule allows (N·m).
    limit: Option<f64>,
    rms: Option<Range>,
    found: Result<Found, Option<Obstacle>>,
    gearboxes: String,
}

const COLUMNS: [&str; 14] = [
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
    "why none",
];

const READING: [&str; 8] = [
    "motor",
    "rated [kW]",
    "alpha/beta",
    "best ratio",
    "RMS [N m]",
    "RMS ratio",
    "ratio",
    "limited by: gearboxes; or why none",
];

impl Row<'_> {
    /// α and β.
    fn factors(&self) -> [Option<f64>; 2] {
        let alpha = self
            .limit
            .map(|limit| accelerating_factor(limit, self.moments.inertia));
        [alpha, self.moments.load_factor()]
    }

    fn rms_torque(&self) -> Option<f64> {
        self.best.map(|best| self.moments.rms_torque(best))
    }

    fn why(&self) -> String {
        match &self.found {
            Ok(_) => String::new(),
            Err(obstacle) => obstacle.as_ref().map_or_else(
                || "narrower than the step of the search".to_owned(),
                Obstacle::words,
            ),
        }
    }

    /// Every figure.
    fn cells(&self) -> Vec<Cell> {
        let found = self.found.as_ref().ok();
        let ended = |rule: Option<Rule>| rule.map_or(Cell::Empty, |rule| rule.name().into());
        let text = |text: String| {
            if text.is_empty() {
                Cell::Empty
            } else {
                text.into()
            }
        };
        let [alpha, beta] = self.factors();
        vec![
            self.motor.key.as_str().into(),
            self.motor.rated_power().into(),
            alpha.into(),
            beta.into(),
            self.best.into(),
            self.rms_torque().into(),
            self.rms.map(|[from, _]| from).into(),
            self.rms.map(|[_, to]| to).into(),
            found.map(|found| found.range[0]).into(),
            ended(found.and_then(|found| found.below)),
            found.map(|found| found.range[1]).into(),
            ended(found.and_then(|found| found.above)),
            text(self.gearboxes.clone()),
            text(self.why()),
        ]
    }

    /// The same for reading: ranges in one cell, and the reason where the range would be.
    fn reading(&self) -> Vec<Cell> {
        let range = |range: Range| -> Cell {
            let [from, to] = range.map(|x| significant(x, 3));
            format!("{from} to {to}").into()
        };
        let [alpha, beta] = self.factors();
        let factors = alpha.zip(beta).map(|(alpha, beta)| alpha / beta);
        let mut cells = vec![
            self.motor.key.as_str().into(),
            self.motor.rated_power().map(|power| power / 1000.0).into(),
            factors.into(),
            self.best.into(),
            self.rms_torque().into(),
            self.rms.map_or_else(|| "none".into(), range),
        ];
        match &self.found {
            Ok(found) => {
                let name = |rule: Option<Rule>| rule.map_or("-", Rule::name);
                let [below, above] = [name(found.below), name(found.above)];
                cells.push(range(found.range));
                let ends = format!("{below} / {above}: {}", self.gearboxes);
                cells.push(ends.trim_end_matches([':', ' ']).into());
            }
            Err(_) => cells.extend(["none".into(), self.why().into()]),
        }
        cells
    }
}

impl<'a> Ratios<'a> {
    /// For every motor, smallest first, one row for each range of ratios that satisfies every rule; usually there is one
    /// range or none.
    fn rows(&self) -> Vec<Row<'a>> {
        let rules = &self.file.rules;
        let share = rules.limit(Rule::RmsTorque).fail.unwrap_or(1.0);
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
        let mut motors: Vec<(&Motor, &Prepared)> =
            self.catalogue.motors.iter().zip(self.motors).collect();
        let power = |motor: &Motor| motor.rated_power().unwrap_or(f64::INFINITY);
        motors.sort_by(|a, b| power(a.0).total_cmp(&power(b.0)));
        motors
            .par_iter()
            .flat_map_iter(|(motor, prepared)| self.of_motor(motor, prepared, share, &fits))
            .collect()
    }

    fn of_motor(
        &self,
        motor: &'a Motor,
        prepared: &Prepared,
        share: f64,
        fits: &HashSet<(&str, &str)>,
    ) -> Vec<Row<'a>> {
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
        let mut found: Vec<Result<Found, Option<Obstacle>>> =
            trial.ranges(best).into_iter().map(Ok).collect();
        if found.is_empty() {
            found.push(Err(trial.obstacle(best)));
        }
        let row = |found: Result<Found, Option<Obstacle>>| Row {
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

    /// The gearboxes with a ratio in a range; in brackets if the drive violates a rule.
    fn gearboxes(
        &self,
        motor: &Motor,
        found: Option<&Found>,
        fits: &HashSet<(&str, &str)>,
    ) -> String {
        let inside = self.catalogue.gearboxes.iter().filter(|g| {
            found.is_some_and(|found| (found.range[0]..=found.range[1]).contains(&g.ratio))
        });
        let names = inside.map(|g| {
            if fits.contains(&(motor.key.as_str(), g.key.as_str())) {
                g.key.clone()
            } else {
                format!("({})", g.key)
            }
        });
        names.collect::<Vec<_>>().join(" ")
    }

    fn sheet(&self, mut rows: Vec<Row>) -> Sheet {
        let share = self.file.rules.limit(Rule::RmsTorque).fail.unwrap_or(1.0);
        let gear = match self.gear {
            Gear::IDEAL => "no inertia and no losses in the gearbox".to_owned(),
            Gear {
                inertia,
                efficiency,
            } => format!(
                "a gearbox with {} % efficiency and {} kg cm^2 at its input",
                short(efficiency * 100.0),
                short(inertia * 1e4)
            ),
        };
        let mut notes = vec![
            format!(
                "alpha: (rated torque × {})²/J, the accelerating factor; beta: the load factor. A motor with alpha \
                 below beta is too small at any ratio.",
                short(share)
            ),
            "best ratio: the ratio with the smallest RMS torque, which is listed as RMS. RMS ratio: range in which \
             that torque is within the limit for the rated torque. Ratio: range in which the motor satisfies every \
             rule (S1 torque at its speed, peak torque, speed, holding torque and inertia ratio); limited by: the rule \
             violated below and above the range, or the reason why there is none."
                .to_owned(),
            "gearboxes: those in the catalogue with a ratio in the range; in brackets: the drive violates a rule \
             because of the limits, inertia or losses of the gearbox."
                .to_owned(),
        ];
        if self.top < usize::MAX {
            let all = rows.len();
            rows.retain(|row| row.found.is_ok());
            let hold = rows.len();
            rows.truncate(self.top);
            notes.push(format!(
                "--top: {} of {hold} ranges in which a motor satisfies every rule; motors without a suitable ratio: {}.",
                rows.len(),
                all - hold
            ));
        }
        Sheet {
            schema: "jred-ratio/1",
            title: format!(
                "{}: gear ratio for every motor in the catalogue, with {gear}",
                self.file.title
            ),
            columns: COLUMNS.map(str::to_owned).to_vec(),
            reading: Some(Reading {
                columns: READING.map(str::to_owned).to_vec(),
                rows: rows.iter().map(Row::reading).collect(),
                whole: READING.len() - 1,
            }),
            rows: rows.iter().map(Row::cells).collect(),
            notes,
        }
    }
}
