//! Use of every rule's limit over the gear ratio.

use super::remedy::with_ratio;
use crate::catalogue::Drive;
use crate::judge::{Context, Findings};
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;

/// The shares of their limits that the rules use at each ratio, with the rest of the drive unchanged; NaN without data. Rules that follow time and
/// rules without a limit are omitted. A drive without gearbox gets one without losses and inertia.
pub fn ratio_course(context: &Context, rules: &RuleSet, ratios: &[f64]) -> Vec<(Rule, Vec<f64>)> {
    let findings: Vec<Findings> = ratios
        .iter()
        .map(|&ratio| {
            let gearbox = with_ratio(context.drive.gearbox, ratio);
            let drive = Drive {
                gearbox: Some(&gearbox),
                ..context.drive
            };
            let mut findings = Findings::default();
            context.with(drive).measure_directly(rules, &mut findings);
            findings
        })
        .collect();
    let course = |rule: Rule| -> Vec<f64> {
        let used = |found: &Findings| match found.get(rule) {
            Some(finding) if finding.is_known() => rules.use_of_limit(rule, finding),
            _ => f64::NAN,
        };
        findings.iter().map(used).collect()
    };
    Rule::ALL
        .into_iter()
        .filter(|rule| rules.limit(*rule).fail.is_some())
        .map(|rule| (rule, course(rule)))
        .filter(|(_, uses)| uses.iter().any(|used| *used > 0.0))
        .collect()
}
