//! `[rules]` of a machine file, and files of rule sets: limits that replace those of the set on which they are based.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::keys::site::RULE_SET;
use crate::model::rule::Rule;
use crate::model::rules::{
    Change, Changes, Contradiction, InertiaOf, Limit, MeanTorque, Moves, RuleSet, RuleSetting,
};
use crate::text::file::Files;

use crate::plain;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result, quoted};
use crate::text::section::Section;
use crate::text::tree;
use crate::units::did_you_mean;

/// The built-in rule sets: name and file.
pub(super) const BUILT_IN: [(&str, &str); 9] = [
    ("general", include_str!("../../rules/general.toml")),
    ("fanuc", include_str!("../../rules/fanuc.toml")),
    (
        "fanuc-contouring",
        include_str!("../../rules/fanuc-contouring.toml"),
    ),
    (
        "mitsubishi-mr-j2s",
        include_str!("../../rules/mitsubishi-mr-j2s.toml"),
    ),
    ("parker", include_str!("../../rules/parker.toml")),
    (
        "precision-gearhead",
        include_str!("../../rules/precision-gearhead.toml"),
    ),
    (
        "safety-factor-1.5",
        include_str!("../../rules/safety-factor-1.5.toml"),
    ),
    (
        "safety-factor-2",
        include_str!("../../rules/safety-factor-2.toml"),
    ),
    (
        "beckhoff-ax8000",
        include_str!("../../rules/beckhoff-ax8000.toml"),
    ),
];

/// The set on which all others are based.
const GENERAL: &str = "general";

/// The largest file of a rule set (bytes).
const MAX_SIZE: u64 = 1 << 16;

/// The rule set of a machine file: the set that it names (built in or from `files`), by default the general one, with the file's changes.
pub(super) fn read(root: &Section, files: &dyn Files) -> Result<RuleSet> {
    let Some(section) = root.maybe_table("rules")? else {
        return named(GENERAL);
    };
    let set = match section.get("set") {
        Some(word) => chosen(&word, files)?,
        None => named(GENERAL)?,
    };
    let changes = changes(&section, "[rules] of the machine file")?;
    section.finish_with(explain)?;
    set.with_own(changes).map_err(contradicts)
}

/// The built-in set of this name.
pub(super) fn built_in(name: &str) -> Option<Result<RuleSet>> {
    let (name, text) = BUILT_IN.iter().find(|(known, _)| *known == name)?;
    Some(parse(name, text))
}

fn is_file(word: &str) -> bool {
    word.contains(['/', '\\']) || Path::new(word).extension().is_some_and(|e| e == "toml")
}

/// The set of this name, or of a file if `word` ends in ".toml" or contains a "/".
pub(super) fn named_or_file(word: &str, files: &dyn Files) -> Result<RuleSet> {
    if !is_file(word) {
        return named(word);
    }
    let name = files.shown(word);
    let text = files.text(word, MAX_SIZE).map_err(|fault| {
        Problem::new(format!(
            "cannot read the rule set {name}: {}",
            fault.message
        ))
        .help(fault.help)
    })?;
    parse(&name, &text).map_err(|problem| problem.in_file(&name, &Arc::new(text)))
}

fn named(name: &str) -> Result<RuleSet> {
    built_in(name).unwrap_or_else(|| Err(unknown(name)))
}

fn unknown(name: &str) -> Problem {
    let names = BUILT_IN.map(|(name, _)| name);
    let near = did_you_mean(name, &names);
    let word = plain::cut(name);
    Problem::new(format!("there is no rule set \"{word}\"")).help(format!(
        "{near}possible: {}; or a file such as \"our-rules.toml\"; `jred rules` shows them with their sources",
        quoted(&names)
    ))
}

/// The set that the key `set` names; errors are shown at the key.
fn chosen(word: &Item, files: &dyn Files) -> Result<RuleSet> {
    let name = word.text(GENERAL)?;
    let is_known = BUILT_IN.iter().any(|(known, _)| *known == name);
    if is_known || is_file(name) {
        return named_or_file(name, files);
    }
    Err(unknown(name).at(word.span(), "unknown"))
}

/// Reads a rule set from the text of its file.
fn parse(name: &str, text: &str) -> Result<RuleSet> {
    let tree = tree::parse(text)?;
    let root = Section::described(String::new(), 0..0, tree.get_ref(), (&RULE_SET, false));
    let title = root.need("title")?.words_of_text()?.to_owned();
    let source = root.text("source")?;
    let source = source.map_or_else(|| format!("rule set {name}"), str::to_owned);
    let base = match root.get("based_on") {
        _ if name == GENERAL => RuleSet::empty(name, ""),
        None => named(GENERAL)?,
        Some(item) if item.is_word("none") => RuleSet::empty(name, ""),
        Some(item) => {
            let word = item.text(GENERAL)?;
            let known = BUILT_IN
                .iter()
                .any(|(known, _)| *known == word && *known != name);
            if !known {
                return Err(unknown(word).at(item.span(), "unknown"));
            }
            named(word)?
        }
    };
    let section = root.table("rules")?;
    let changes = changes(&section, &source)?;
    section.finish_with(explain)?;
    root.finish()?;
    let mut set = base.with(&changes).map_err(contradicts)?;
    // The name of a set from a file is the file's name without folder and extension.
    let path = Path::new(name);
    let stem = path
        .file_stem()
        .filter(|_| path.extension().is_some_and(|e| e == "toml"));
    set.name = stem.map_or_else(|| name.to_owned(), plain::path);
    set.title = title;
    Ok(set)
}

fn contradicts(contradiction: Contradiction) -> Problem {
    let problem = Problem::new(contradiction.message).help(contradiction.help);
    contradiction
        .places
        .into_iter()
        .fold(problem, |problem, place| problem.at(place, "here"))
}

fn explain(key: &str) -> Option<&'static str> {
    key.ends_with("_warning")
        .then_some("the key of a warning is that of its rule followed by _warning")
}

/// All changes in a table.
fn changes(section: &Section, source: &str) -> Result<Changes> {
    let mut changes = Vec::new();
    let mut change = |what: RuleSetting, source: &str, place: Range<usize>| {
        let source = source.to_owned();
        changes.push(Change {
            what,
            source,
            place,
        });
    };
    for rule in Rule::ALL {
        if let Some(item) = section.get(rule.key()) {
            let place = item.span();
            if item.is_word("off") {
                change(RuleSetting::Off(rule), source, place);
            } else if item.is_table() {
                let (limit, said) = both(&item, rule)?;
                change(
                    RuleSetting::Both(rule, limit),
                    said.as_deref().unwrap_or(source),
                    place,
                );
            } else {
                change(RuleSetting::Fail(rule, limit(&item, rule)?), source, place);
            }
        }
        if let Some(item) = section.get(rule.warning_key()) {
            change(
                RuleSetting::Warn(rule, limit(&item, rule)?),
                source,
                item.span(),
            );
        }
    }
    if let Some(item) = section.get("inertia_ratio_of") {
        let word = InertiaOf::WORDS[item.word()?];
        change(
            RuleSetting::InertiaOf(InertiaOf::of(word).unwrap_or_default()),
            source,
            item.span(),
        );
    }
    if let Some(item) = section.get("gearbox_mean_exponent") {
        let word = MeanTorque::WORDS[item.word()?];
        change(
            RuleSetting::MeanTorque(MeanTorque::of(word).unwrap_or_default()),
            source,
            item.span(),
        );
    }
    if let Some(item) = section.get("inertia_ratio_by_moves") {
        let bands = by_moves(&section.tables("inertia_ratio_by_moves")?)?;
        change(RuleSetting::InertiaByMoves(bands), source, item.span());
    }
    Ok(Changes(changes))
}

/// A limit: a share of the rule's rating, or a plain ratio.
fn limit(item: &Item, rule: Rule) -> Result<f64> {
    if rule.is_ratio() {
        item.figure()
    } else {
        Ok(item.value()?.si)
    }
}

/// `{ limit = …, warning = …, source = "…" }`: limits and their source.
fn both(item: &Item, rule: Rule) -> Result<(Limit, Option<String>)> {
    let section = item.section(format!("[rules.{}]", rule.key()))?;
    let read = |key: &'static str| section.get(key).map(|item| limit(&item, rule)).transpose();
    let limits = Limit {
        fail: read("limit")?,
        warn: read("warning")?,
    };
    let source = section.text("source")?.map(str::to_owned);
    section.finish()?;
    if !limits.is_set() {
        return Err(section
            .problem(
                format!("[rules.{}] has neither limit nor warning", rule.key()),
                "here",
            )
            .help(format!(
                "give at least one of them, or write {} = \"off\"",
                rule.key()
            )));
    }
    Ok((limits, source))
}

/// `[{ above = 60, limit = 5 }, { above = 100, limit = 3 }]`, in moves per minute.
fn by_moves(sections: &[Section]) -> Result<Vec<Moves>> {
    let mut bands: Vec<Moves> = Vec::new();
    for section in sections {
        let above = section.need("above")?;
        let moves = Moves {
            above: above.figure()?,
            limit: section.figure("limit")?,
        };
        section.finish()?;
        if bands
            .last()
            .is_some_and(|before| before.above >= moves.above)
        {
            return Err(above
                .problem("is not above that of the previous band", "here")
                .help("write the bands in order of increasing moves per minute"));
        }
        bands.push(moves);
    }
    Ok(bands)
}

impl Default for RuleSet {
    /// The set `general`.
    fn default() -> Self {
        // Cannot fail: the file is built in, and a test reads it.
        built_in("general")
            .and_then(std::result::Result::ok)
            .unwrap_or_else(|| Self::empty("general", ""))
    }
}
