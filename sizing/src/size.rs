//! Sizing: every motor with every gearbox of a catalogue, judged and ranked.

use crate::catalogue::Catalogue;
use crate::check::Verdict;
use crate::drive::{Drive, Judged};
use crate::duty::Duty;
use crate::rules::Rules;

/// How drives are ranked, in words for reports.
pub const RANKING: &str = "drives that break no rule, the smallest motor first (rated torque times rated speed), \
     among equal motors without warnings first, then by the largest share of a limit used";

/// All drives, judged.
#[derive(Clone, Debug)]
pub struct Selection<'c> {
    /// Drives that hold every rule, best first; see [`RANKING`].
    pub fit: Vec<Judged<'c>>,
    /// Drives that break a rule, those that miss by least first.
    pub refused: Vec<Judged<'c>>,
}

impl<'c> Selection<'c> {
    /// How many of the drives that fit have a rule that could not be checked.
    pub fn partly_checked(&self) -> usize {
        let open = |j: &&Judged| j.checks.iter().any(|c| c.verdict == Verdict::NotChecked);
        self.fit.iter().filter(open).count()
    }

    /// Judges every motor of the catalogue, directly coupled and with every gearbox.
    pub fn new(catalogue: &'c Catalogue, duty: &Duty, rules: &Rules) -> Self {
        let (mut fit, mut refused) = (Vec::new(), Vec::new());
        for motor in &catalogue.motors {
            let gearboxes = catalogue.gearboxes.iter().map(Some);
            for gearbox in std::iter::once(None).chain(gearboxes) {
                let judged = Judged::new(Drive { motor, gearbox }, duty, rules);
                if judged.holds() {
                    fit.push(judged);
                } else {
                    refused.push(judged);
                }
            }
        }
        fit.sort_by(|a, b| {
            (a.rated_power().total_cmp(&b.rated_power()))
                .then_with(|| a.verdict().cmp(&b.verdict()))
                .then_with(|| a.worst_use().total_cmp(&b.worst_use()))
        });
        refused.sort_by(|a, b| {
            (a.beyond_all_limits().cmp(&b.beyond_all_limits()))
                .then_with(|| a.worst_use().total_cmp(&b.worst_use()))
        });
        Self { fit, refused }
    }
}
