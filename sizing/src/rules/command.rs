//! `jred rules`: the rule sets with their sources; `--rules` of the other commands.

use miette::{Result, miette};
use serde_json::{Value, json};

use super::change::shown;
use super::{Moves, RuleSet};
use crate::comma;
use crate::input;
use crate::output::{Format, text_table};
use crate::rule::{Rule, Sense};

/// What a machine file says, on top of another set: `word` is its name or a file.
///
/// # Errors
/// There is no such set, its file is wrong, or what the machine file says contradicts it.
pub fn chosen(rules: &RuleSet, word: &str) -> Result<RuleSet> {
    let set = input::rule_set(word)?;
    rules.based_on(set).map_err(|contradiction| {
        miette!(
            help = contradiction.help,
            "[rules] of the machine file does not go with the set \"{word}\": {}",
            contradiction.message
        )
    })
}

/// The list of all sets, or one of them in full.
///
/// # Errors
/// There is no such set, or its file is wrong.
pub fn show(word: Option<&str>, format: Format) -> Result<String> {
    let Some(word) = word else {
        let sets = input::rule_set_names().filter_map(input::built_in_rules);
        return Ok(list(&sets.collect::<Vec<_>>(), format));
    };
    let set = input::rule_set(word)?;
    Ok(match format {
        Format::Json => format!("{:#}\n", set.json()),
        Format::Csv => csv(&set),
        Format::Table => {
            let rows = set.lines().into_iter().map(|line| line.cells().to_vec());
            let choices = set
                .choice_words()
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
            let sets: Vec<Value> = sets.iter().map(RuleSet::json).collect();
            format!("{:#}\n", json!({ "rule sets": sets }))
        }
        Format::Csv => {
            let rows = sets
                .iter()
                .map(|set| [set.name.as_str(), set.title.as_str()]);
            comma::row(["set", "title"]) + &comma::rows(rows)
        }
        Format::Table => {
            let rows = sets
                .iter()
                .map(|set| vec![set.name.clone(), set.title.clone()]);
            format!(
                "{}\n`jred rules NAME` shows the limits of a set with their sources; [rules] set = \"NAME\" or --rules NAME chooses it\n",
                table(&["set", "what it is"], rows)
            )
        }
    }
}

fn csv(set: &RuleSet) -> String {
    let rows = set.lines().into_iter().map(|line| line.cells());
    comma::row(["rule", "key", "limit", "warning", "source"]) + &comma::rows(rows)
}

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

impl RuleSet {
    /// The rules that are judged or were switched off, in words.
    pub fn lines(&self) -> Vec<Line> {
        let rules = Rule::ALL.into_iter().filter(|rule| self.shows(*rule));
        let line = |rule: Rule| {
            let limit = self.limit(rule);
            let side = match rule.sense() {
                Sense::AtMost => "",
                Sense::AtLeast => "at least ",
            };
            let words = |share: Option<f64>| {
                share.map_or(String::new(), |share| {
                    format!("{side}{}", shown(rule, share))
                })
            };
            let by_moves = &self.choices.inertia_ratio_by_moves;
            Line {
                rule,
                limit: if self.is_off(rule) {
                    "off".to_owned()
                } else if rule == Rule::InertiaRatio && !by_moves.is_empty() {
                    "by moves per minute".to_owned()
                } else {
                    words(limit.fail)
                },
                warning: words(limit.warn),
                source: self.source(rule).to_owned(),
            }
        };
        rules.map(line).collect()
    }

    /// What the set chooses beside its limits, one sentence each.
    pub fn choice_words(&self) -> Vec<String> {
        let choices = &self.choices;
        let mut words = vec![
            format!("the inertia ratio is {}", choices.inertia_ratio_of.words()),
            format!(
                "the mean torque of a gearbox has the exponent {}",
                super::MeanTorque::WORDS[choices.gearbox_mean_exponent as usize]
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
    pub fn json(&self) -> Value {
        let rules: Vec<Value> = Rule::ALL
            .into_iter()
            .filter(|rule| self.shows(*rule))
            .map(|rule| {
                let limit = self.limit(rule);
                json!({
                    "id": rule,
                    "rule": rule.name(),
                    "key": rule.key(),
                    "off": self.is_off(rule),
                    "limit": limit.fail,
                    "warning": limit.warn,
                    "source": self.source(rule),
                })
            })
            .collect();
        json!({
            "name": self.name,
            "title": self.title,
            "changed in the machine file": self.is_changed(),
            "choices": self.choices,
            "rules": rules,
        })
    }
}
