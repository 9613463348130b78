//! Rule sets with their sources, as tables, CSV or JSON.

use miette::Result;
use serde_json::{Value, json};

use crate::table::output::{Format, text_table};
use jred_machine::model::rule::{Rule, Sense};
use jred_machine::model::rules::{Moves, RuleSet, shown};
use jred_machine::number::csv;
use jred_machine::number::rounding::figure;
use jred_machine::read;
use jred_machine::text::file::Files;

/// The list of all sets, or one of them in full.
///
/// # Errors
/// Unknown set, or an error in its file.
pub fn show(word: Option<&str>, files: impl Files, format: Format) -> Result<String> {
    let Some(word) = word else {
        let sets = read::rule_set_names().filter_map(read::built_in_rules);
        return Ok(list(&sets.collect::<Vec<_>>(), format));
    };
    let set = read::rule_set(word, files)?;
    Ok(match format {
        Format::Json => format!("{:#}\n", json(&set)),
        Format::Csv => csv(&set),
        Format::Table => {
            let rows = lines(&set).into_iter().map(|line| line.cells().to_vec());
            let choices = choice_words(&set)
                .into_iter()
                .map(|words| format!("{words}\n"));
            format!(
                "{}: {}\n{}\n{}",
                set.name,
                set.title,
                table(&["rule", "key", "limit", "warning", "source"], rows),
                choices.collect::<String>()
            )
        }
    })
}

fn table(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut table = text_table(header);
    table.add_rows(rows);
    table.to_string()
}

fn list(sets: &[RuleSet], format: Format) -> String {
    match format {
        Format::Json => {
            let sets: Vec<Value> = sets.iter().map(json).collect();
            format!("{:#}\n", json!({ "rule sets": sets }))
        }
        Format::Csv => {
            let rows = sets
                .iter()
                .map(|set| [set.name.as_str(), set.title.as_str()]);
            csv::row(["set", "title"]) + &csv::rows(rows)
        }
        Format::Table => {
            let rows = sets
                .iter()
                .map(|set| vec![set.name.clone(), set.title.clone()]);
            format!(
                "{}\n`jred rules NAME` shows the limits of a set and their sources; choose a set with [rules] set = \"NAME\" or --rules NAME\n",
                table(&["set", "description"], rows)
            )
        }
    }
}

/// Limits are numbers with a unit; what is switched off has none, and what depends on the moves neither.
fn csv(set: &RuleSet) -> String {
    let header = [
        "rule", "key", "limit", "warning", "unit", "sense", "state", "source",
    ];
    let rows = lines(set).into_iter().map(|line| {
        let rule = line.rule;
        let (unit, one) = if rule.is_ratio() {
            ("", 1.0)
        } else {
            ("%", 100.0)
        };
        let by_moves = line.limit == BY_MOVES;
        let number = |share: Option<f64>| {
            let share = share.filter(|_| !by_moves);
            share.map_or_else(String::new, |share| figure(share * one))
        };
        let limit = set.limit(rule);
        let sense = match rule.sense() {
            Sense::AtMost => "at most",
            Sense::AtLeast => "at least",
        };
        let state = match (set.is_off(rule), by_moves) {
            (true, _) => "off",
            (false, true) => BY_MOVES,
            (false, false) => "on",
        };
        [
            rule.name().to_owned(),
            rule.key().to_owned(),
            number(limit.fail),
            number(limit.warn),
            unit.to_owned(),
            sense.to_owned(),
            state.to_owned(),
            line.source,
        ]
    });
    csv::row(header) + &csv::rows(rows)
}

/// Limits of the inertia ratio that are a table.
const BY_MOVES: &str = "by moves per minute";

/// One rule of a set, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The rule.
    pub rule: Rule,
    /// Beyond what it is violated, such as `80 %`; "off" where it was switched off.
    pub limit: String,
    /// Beyond what there is a warning.
    pub warning: String,
    /// Where that comes from.
    pub source: String,
}

impl Line {
    fn cells(&self) -> [String; 5] {
        let [name, key] = [self.rule.name(), self.rule.key()].map(str::to_owned);
        [
            name,
            key,
            self.limit.clone(),
            self.warning.clone(),
            self.source.clone(),
        ]
    }
}

/// The rules that are checked or switched off, as text.
pub fn lines(set: &RuleSet) -> Vec<Line> {
    let rules = Rule::ALL.into_iter().filter(|rule| set.shows(*rule));
    let line = |rule: Rule| {
        let limit = set.limit(rule);
        let side = match rule.sense() {
            Sense::AtMost => "",
            Sense::AtLeast => "at least ",
        };
        let words = |share: Option<f64>| {
            share.map_or(String::new(), |share| {
                format!("{side}{}", shown(rule, share))
            })
        };
        let by_moves = &set.choices.inertia_ratio_by_moves;
        Line {
            rule,
            limit: if set.is_off(rule) {
                "off".to_owned()
            } else if rule == Rule::InertiaRatio && !by_moves.is_empty() {
                BY_MOVES.to_owned()
            } else {
                words(limit.fail)
            },
            warning: words(limit.warn),
            source: set.source(rule).to_owned(),
        }
    };
    rules.map(line).collect()
}

/// Choices of the set other than limits, one sentence each.
pub fn choice_words(set: &RuleSet) -> Vec<String> {
    let choices = &set.choices;
    let mut words = vec![
        format!("the inertia ratio is {}", choices.inertia_ratio_of.words()),
        format!(
            "the mean torque of a gearbox has the exponent {}",
            jred_machine::model::rules::MeanTorque::WORDS[choices.gearbox_mean_exponent as usize]
        ),
    ];
    words.extend(
        choices
            .inertia_ratio_by_moves
            .iter()
            .map(|Moves { above, limit }| {
                format!(
                    "an inertia ratio of at most {limit} for more than {above} moves per minute"
                )
            }),
    );
    words
}

/// The set as JSON: name, title, choices, and every rule's limits with their source.
pub fn json(set: &RuleSet) -> Value {
    let rules: Vec<Value> = Rule::ALL
        .into_iter()
        .filter(|rule| set.shows(*rule))
        .map(|rule| {
            let limit = set.limit(rule);
            json!({
                "id": rule,
                "rule": rule.name(),
                "key": rule.key(),
                "off": set.is_off(rule),
                "limit": limit.fail,
                "warning": limit.warn,
                "source": set.source(rule),
            })
        })
        .collect();
    json!({
        "name": set.name,
        "title": set.title,
        "changed in the machine file": set.is_changed(),
        "choices": set.choices,
        "rules": rules,
    })
}
