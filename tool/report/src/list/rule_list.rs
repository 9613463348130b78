//! Rule sets with their sources.

use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::Reading;
use jred_file::model::rule::{Rule, Sense};
use jred_file::model::rules::{Choices, Moves, RuleSet, shown};
use jred_file::number::csv;
use jred_file::number::rounding::figure;
use jred_file::read;
use jred_file::units::Vocabulary;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::cell::Cell;

/// All built-in sets, one line each.
pub fn all() -> Answer<'static> {
    let sets = read::rule_set_names().filter_map(read::built_in_rules);
    let sets: Vec<RuleSet> = sets.collect();
    let data = SetsData {
        sets: sets.iter().map(set_data).collect(),
    };
    let mut answer = Answer::new("rule sets", &data);
    let rows = sets.iter().map(|set| [set.name.clone(), set.title.clone()]);
    answer.table(table(&["set", "description"], rows));
    answer.sentence(
        "`jred rules NAME` shows the limits of a set and their sources; choose a set with [rules] set = \"NAME\" or --rules NAME",
    );
    answer
}

/// One set in full: limits, sources, choices.
pub fn answer(set: &RuleSet) -> Answer<'static> {
    let mut answer = Answer::new(format!("{}: {}", set.name, set.title), &set_data(set));
    answer.csv(csv(set));
    limits(&mut answer, set, MotorKind::Rotary.vocabulary());
    answer
}

/// The limits with their sources, and the choices.
pub(crate) fn limits(answer: &mut Answer, set: &RuleSet, words: &Vocabulary) {
    let rows = lines(set).into_iter().map(|line| {
        let [name, key] = [line.rule.named(words), line.rule.key()].map(str::to_owned);
        [name, key, line.limit, line.warning, line.source]
    });
    answer.table(table(&["rule", "key", "limit", "warning", "source"], rows));
    for choice in choice_words(set) {
        answer.sentence(choice);
    }
}

fn table<const N: usize>(header: &[&str; N], rows: impl Iterator<Item = [String; N]>) -> Reading {
    Reading::new(*header, rows.map(|row| row.map(Cell::Text).to_vec()), N)
}

/// Limits are numbers with a unit; empty for a rule that is off, or whose limit depends on the moves.
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
pub struct RuleLine {
    /// The rule.
    pub rule: Rule,
    /// The limit beyond which it is violated, such as `80 %`; "off" if the rule is off.
    pub limit: String,
    /// The limit beyond which there is a warning.
    pub warning: String,
    /// Source of the limit.
    pub source: String,
}

/// The rules that are checked or switched off, as text.
pub fn lines(set: &RuleSet) -> Vec<RuleLine> {
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
        RuleLine {
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
            jred_file::model::rules::MeanTorque::WORDS[choices.gearbox_mean_exponent as usize]
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

/// The JSON of `jred rules`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct SetsData<'a> {
    /// The built-in sets.
    #[serde(rename = "rule sets")]
    sets: Vec<SetData<'a>>,
}

impl Data for SetsData<'_> {
    const FORM: &'static str = "jred-rule-sets/1";
}

/// A rule set: the JSON of `jred rules NAME`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct SetData<'a> {
    /// Its name.
    name: &'a str,
    /// Its description.
    description: &'a str,
    /// Whether the machine file changes it.
    #[serde(rename = "changed in the machine file")]
    is_changed: bool,
    /// Choices other than limits.
    choices: &'a Choices,
    /// The rules.
    rules: Vec<RuleData<'a>>,
}

impl Data for SetData<'_> {
    const FORM: &'static str = "jred-rules/1";
}

#[derive(Serialize, JsonSchema)]
struct RuleData<'a> {
    /// The rule.
    id: Rule,
    /// Its name.
    rule: &'static str,
    /// Its key in `[rules]`.
    key: &'static str,
    /// Whether it is switched off.
    off: bool,
    /// The limit beyond which it is violated: a share, or a ratio.
    limit: Option<f64>,
    /// The limit beyond which there is a warning.
    warning: Option<f64>,
    /// Source of the limit.
    source: &'a str,
}

fn set_data(set: &RuleSet) -> SetData<'_> {
    let rules = Rule::ALL.into_iter().filter(|rule| set.shows(*rule));
    let rules = rules.map(|rule| {
        let limit = set.limit(rule);
        RuleData {
            id: rule,
            rule: rule.name(),
            key: rule.key(),
            off: set.is_off(rule),
            limit: limit.fail,
            warning: limit.warn,
            source: set.source(rule),
        }
    });
    SetData {
        name: &set.name,
        description: &set.title,
        is_changed: set.is_changed(),
        choices: &set.choices,
        rules: rules.collect(),
    }
}
