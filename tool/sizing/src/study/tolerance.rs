//! Monte Carlo estimate of the probability that a drive satisfies its rules when quantities of the machine file scatter.
//!
//! Sample k draws the deviation of every quantity with a tolerance, in the order of their list, from stream k of ChaCha8 with the seed. So a sample
//! does not depend on the thread, share or run that computes it. A machine that the reader refuses is counted separately. If k of n others satisfy a
//! rule, the probability is given with Wilson's interval,
//!
//! ```text
//! (k + z²/2 ± z·√(k(n − k)/n + z²/4)) / (n + z²),   z = 1.96 for 95 %
//! ```

pub mod summary;

use std::sync::Arc;

use jred_file::plain;
use jred_file::problem;
use jred_file::text::problem::{Problem, Result};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use rand_distr::{Distribution as _, StandardNormal};

use crate::cell::Cell;
use crate::judge::broken;
use crate::study::chosen::ChosenDrive;
use crate::study::common::{PreparedMachine, Study, sentence};
use crate::study::edit::Edit;
use crate::study::header::{Header, digest};
use crate::study::task::RowSource;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Limit;
use jred_file::model::tolerance::{Distribution, Tolerance};

/// One quantity that scatters.
#[derive(Clone, Debug)]
pub struct Scatter {
    /// Index of the quantity in the document.
    pub quantity: usize,
    /// Its path in the machine file.
    pub path: String,
    /// Unit of its figures.
    pub unit: String,
    /// The nominal value, in the unit.
    nominal: f64,
    /// Half the width, or the standard deviation, in the unit.
    pub amount: f64,
    /// Distribution.
    pub shape: Distribution,
}

impl Scatter {
    /// The quantity of a tolerance.
    ///
    /// # Errors
    /// The quantity does not exist, or the amount is of another kind.
    pub fn new(study: &Study, tolerance: &Tolerance) -> Result<Self> {
        let quantity = study.document.find(&tolerance.path)?;
        let own = study.document.quantities().get(quantity);
        let own =
            own.ok_or_else(|| problem!("there is no quantity {}", plain::quoted(&tolerance.path)))?;
        let nominal = own.number();
        let given = &tolerance.amount;
        let amount = if given.unit == "%" && own.unit() != "%" {
            if nominal == 0.0 {
                return Err(problem!(
                    help = "write the tolerance as an amount with its unit",
                    "the tolerance of {} is a share of zero",
                    own.path
                ));
            }
            given.number / 100.0 * nominal.abs()
        } else if given.is_like(&own.literal) {
            given.number * given.scale / own.literal.scale
        } else {
            return Err(problem!(
                help = "write a share, such as \"5 %\", or an amount with a matching unit",
                "the tolerance of {}, which is {}, cannot be {}",
                own.path,
                own.shown(),
                given.shown()
            ));
        };
        Ok(Self {
            quantity,
            path: own.path.clone(),
            unit: own.unit().to_owned(),
            nominal,
            amount,
            shape: tolerance.shape,
        })
    }

    /// The tolerances of the machine file, replaced by `given` ones for the same quantity, and the other given ones.
    ///
    /// # Errors
    /// A tolerance does not suit its quantity; a quantity has two tolerances in the machine file, or two given ones; there are no tolerances.
    pub fn all(study: &Study, given: &[Tolerance]) -> Result<Vec<Self>> {
        let of_file = &study.nominal.tolerances;
        let mut scatters = Self::each(study, of_file)?;
        for scatter in Self::each(study, given)? {
            match scatters.iter_mut().find(|s| s.quantity == scatter.quantity) {
                Some(earlier) => *earlier = scatter,
                None => scatters.push(scatter),
            }
        }
        if scatters.is_empty() {
            return Err(problem!(
                help = "add a [tolerance] with lines such as \"slider.mass\" = \"±5 %\", or give --tolerance slider.mass=5%",
                "no quantity has a tolerance"
            ));
        }
        Ok(scatters)
    }

    /// The tolerances of one source, which gives each quantity one tolerance.
    fn each(study: &Study, tolerances: &[Tolerance]) -> Result<Vec<Self>> {
        let mut scatters: Vec<Self> = Vec::new();
        for tolerance in tolerances {
            let scatter = Self::new(study, tolerance)?;
            if let Some(k) = (scatters.iter()).position(|s| s.quantity == scatter.quantity) {
                let first = tolerances.get(k).unwrap_or(tolerance);
                return Err(twice(study, &scatter.path, [first, tolerance]));
            }
            scatters.push(scatter);
        }
        Ok(scatters)
    }

    /// Draws a value.
    fn draw(&self, rng: &mut ChaCha8Rng) -> f64 {
        let deviation: f64 = match self.shape {
            Distribution::Uniform => 2.0 * rng.random::<f64>() - 1.0,
            Distribution::Normal => StandardNormal.sample(rng),
        };
        self.nominal + self.amount * deviation
    }
}

/// The error for one quantity with two tolerances, by the same path or by two.
fn twice(study: &Study, path: &str, both: [&Tolerance; 2]) -> Problem {
    let shown = both.map(|tolerance| format!("\"{}\" = {}", tolerance.path, tolerance.shown()));
    let mut problem = Problem::new(format!(
        "{path} has two tolerances: {}",
        shown.join(" and ")
    ))
    .help("both paths are of one quantity: remove one of the two");
    for (tolerance, label) in both.into_iter().zip(["the first", "the second"]) {
        if let Some(place) = &tolerance.place {
            problem = problem.at(place.clone(), label);
        }
    }
    let text = Arc::new(study.document.text().to_owned());
    problem.in_file(&study.name, &text)
}

jred_file::words! {
    /// Result for a machine: the words of the column `verdict`.
    pub enum ToleranceVerdict {
        /// Every rule is satisfied.
        Holds = "holds",
        /// A rule is violated.
        Broken = "broken",
        /// No rule is violated, but one cannot be checked although it can be for the nominal machine.
        NotChecked = "not checked",
        /// The machine cannot be built as drawn.
        Refused = "machine refused",
    }
}

/// Machines that scatter about the machine of the file.
#[derive(Debug)]
pub struct Samples<'s> {
    /// Common data.
    pub study: &'s Study,
    /// The drive that is checked.
    pub one: &'s ChosenDrive,
    /// Quantities that scatter.
    pub scatters: Vec<Scatter>,
    /// The rules that can be checked.
    pub rules: Vec<Rule>,
    /// The rules without data of the nominal machine or the drive.
    pub unknown: Vec<Rule>,
    /// Number of machines to draw.
    pub count: u64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl<'s> Samples<'s> {
    /// `count` machines about the nominal one, with the rules that can be checked for the nominal machine.
    pub fn new(
        study: &'s Study,
        one: &'s ChosenDrive,
        nominal: &PreparedMachine,
        scatters: Vec<Scatter>,
        count: u64,
        seed: u64,
    ) -> Self {
        let findings = one.findings(nominal);
        let limits = &nominal.file.rules;
        let (known, unknown): (Vec<_>, Vec<_>) = findings.iter().partition(|(_, f)| f.is_known());
        let rules = known.iter().map(|(rule, _)| *rule);
        Self {
            study,
            one,
            scatters,
            rules: rules
                .filter(|rule| limits.limit(*rule) != Limit::default())
                .collect(),
            unknown: unknown.iter().map(|(rule, _)| *rule).collect(),
            count,
            seed,
        }
    }

    /// The values of sample `index`, in the order of the scatters.
    pub fn values(&self, index: u64) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        rng.set_stream(index);
        self.scatters
            .iter()
            .map(|scatter| scatter.draw(&mut rng))
            .collect()
    }
}

impl RowSource for Samples<'_> {
    fn header(&self) -> Header {
        let scatters = self.scatters.iter().map(|s| match s.unit.as_str() {
            "" => s.path.clone(),
            unit => format!("{} [{unit}]", s.path),
        });
        let rules = self.rules.iter().map(|rule| rule.name().to_owned());
        let verdict = ["verdict".to_owned(), "worst rule".to_owned()];
        let columns = scatters
            .chain(verdict)
            .chain(rules)
            .chain(["note".to_owned()])
            .collect();
        let mut options: Vec<String> = (self.scatters.iter())
            .map(|s| format!("{} {:?} ± {:?} {}", s.path, s.shape, s.amount, s.unit))
            .collect();
        options.push(format!("seed = {}", self.seed));
        options.push(self.study.accuracy());
        options.push(format!("drive = {}", self.one.name()));
        Header {
            jred: "tolerance/3".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            machine: self.study.name.clone(),
            machine_digest: self.study.machine_digest(),
            catalogue_digest: digest(&self.study.catalogue),
            options,
            rows: self.count,
            columns,
            shard: None,
        }
    }

    fn row(&self, index: u64) -> Vec<Cell> {
        let values = self.values(index);
        let edits: Vec<Edit> = (self.scatters.iter().zip(&values))
            .map(|(scatter, value)| Edit {
                quantity: scatter.quantity,
                number: *value,
                unit: &scatter.unit,
            })
            .collect();
        let mut cells: Vec<Cell> = values.into_iter().map(Cell::from).collect();
        match self.study.machine(&edits) {
            Err(report) => {
                cells.extend([ToleranceVerdict::Refused.word().into(), Cell::Empty]);
                cells.extend(self.rules.iter().map(|_| Cell::Empty));
                cells.push(sentence(&report).into());
            }
            Ok(machine) => {
                let rules = &machine.file.rules;
                let findings = self.one.findings(&machine);
                let broken = broken(rules, &findings);
                let known = |rule: &Rule| findings.get(*rule).is_some_and(|f| f.is_known());
                let verdict = match broken {
                    Some(_) => ToleranceVerdict::Broken,
                    None if self.rules.iter().all(known) => ToleranceVerdict::Holds,
                    None => ToleranceVerdict::NotChecked,
                };
                cells.push(verdict.word().into());
                cells.push(broken.map_or(Cell::Empty, |rule| rule.name().into()));
                cells.extend(self.rules.iter().map(|rule| {
                    let finding = findings
                        .get(*rule)
                        .filter(jred_file::model::rules::Finding::is_known);
                    match finding.map(|finding| rules.use_shown(*rule, finding)) {
                        Some(used) if used.is_infinite() => Cell::Number(used),
                        used => used.into(),
                    }
                }));
                cells.push(Cell::Empty);
            }
        }
        cells
    }
}
