//! The long answer: duty, every rule, certainty of the data, ranking, refused drives.

use super::{Listing, table};
use crate::answer::Answer;
use crate::list::marks;
use crate::list::rule_words::{missing, note, reasons, warnings};
use crate::table::reading::ColumnKind::{self, Quantity, Share, Verdict, Words};
use crate::table::reading::Reading;
use jred_analysis::duty::Instant;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_file::number::figures::Figures;
use jred_file::number::rounding::{cleared, rounded, short, significant};
use jred_file::number::words::counted;
use jred_sizing::catalogue::Drive;
use jred_sizing::cell::Cell;
use jred_sizing::judge::check::Check;
use jred_sizing::judge::{Assessment, cure};
use jred_sizing::select::size::{Candidate, Certainty, Selection};

/// The supply for which motors and amplifiers are judged.
pub(super) fn supply(site: &Site) -> String {
    match (site.mains_voltage, site.bus_voltage) {
        (Some(mains), Some(bus)) => {
            format!("Supply: {} V mains, DC bus {} V", short(mains), short(bus))
        }
        (_, Some(bus)) => format!("Supply: DC bus {} V", short(bus)),
        _ => "Supply: not given; using each motor at the voltage of its data. Give mains_voltage in [supply]".to_owned(),
    }
}

/// Every rule of a drive, those without data, and the warnings.
pub(crate) fn rules(answer: &mut Answer, judged: &Assessment) {
    let header = [
        ("rule", Words),
        ("figure", Quantity),
        ("limit", Quantity),
        ("used", Share),
        ("margin", Quantity),
        ("verdict", Verdict),
        ("limit is", Words),
    ];
    let (open, checked): (Vec<&Check>, Vec<&Check>) =
        (judged.checks.iter()).partition(|check| check.verdict == RuleVerdict::NotChecked);
    let row = |check: &Check| {
        [
            check.rule.to_owned(),
            check.figure(),
            check.bound().unwrap_or_default(),
            check.used(),
            margin(check),
            check.verdict.word().to_owned(),
            note(check),
        ]
    };
    answer.table(table(header, checked.into_iter().map(row), 1));
    let open = open
        .iter()
        .map(|check| format!("{} ({})", check.rule, note(check)));
    let open: Vec<String> = open.collect();
    if !open.is_empty() {
        answer.sentence(format!("not checked: {}", open.join("; ")));
    }
    for warning in warnings(judged) {
        answer.warning(warning);
    }
}

impl Listing<'_> {
    /// The duty from the drive link, in its own terms, to the motor.
    pub(crate) fn duty(&self, answer: &mut Answer, judged: &Assessment) {
        let (of, input, name) = (&judged.duty, self.duty, self.file.input_name());
        let words = judged.drive.motor.kind.vocabulary();
        let link = self.file.machine.mechanism().coordinate().vocabulary();
        let (torque, speed, inertia) = (words.torque, words.speed, words.inertia);
        let at = |value: &dyn Fn(&Instant) -> f64| input.figures(value);
        let rows = [
            (
                format!(
                    "{} at the drive link [{}], without drive train",
                    link.torque, link.torque.unit
                ),
                at(&|i| i.terms.total()),
                1.0,
            ),
            (
                format!("speed of the drive link [{}]", link.speed.unit),
                at(&|i| i.omega),
                link.speed.scale,
            ),
            (
                format!(
                    "{torque} at the {name}, losses and drive train included [{}]",
                    torque.unit
                ),
                at(&|i| i.input_torque),
                1.0,
            ),
            (
                format!("speed at the {name} [{}]", speed.unit),
                at(&|i| i.input_speed),
                speed.scale,
            ),
            (
                format!("power at the {name} [W]"),
                at(&|i| i.input_torque * i.input_speed),
                1.0,
            ),
            (
                format!("{inertia} at the {name} [{}]", inertia.unit),
                at(&|i| i.input_inertia),
                inertia.scale,
            ),
            (format!("motor {}", torque.label()), of.torque, 1.0),
            (format!("motor {}", speed.label()), of.speed, speed.scale),
            ("motor power [W]".to_owned(), of.power, 1.0),
            (format!("{inertia} ratio λ"), of.inertia_ratio, 1.0),
        ];
        answer.heading(format!(
            "Duty of {}, cycle {} s",
            judged.drive.name(),
            rounded(input.duration)
        ));
        let row = |(name, figures, unit): (String, Figures, f64)| {
            // Values below the sixth digit of the largest one are shown as zero.
            let noise = 5e-6 * figures.peak();
            let cells = figures.values();
            let [min, mean, max, rms] =
                cells.map(|x| rounded(if x.abs() <= noise { 0.0 } else { x / unit }));
            [name, min, mean, max, rms]
        };
        let names = ["min", "mean", "max", "RMS"].map(|name| (name, Quantity));
        let header = [("", Words), names[0], names[1], names[2], names[3]];
        answer.table(table(header, rows.into_iter().map(row), 0));
        answer.sentence(format!(
            "per cycle: {} J supplied, {} J regenerated; the brake resistor or the DC bus takes at most the latter",
            rounded(of.motoring_energy),
            rounded(cleared(of.regenerative_energy, of.motoring_energy))
        ));
    }

    /// The number of suitable drives by certainty, with the first drive of each. A single drive needs no comparison.
    pub(crate) fn certainties(&self, answer: &mut Answer) {
        let (fit, all) = (self.selection.fit.len(), self.count());
        if all == 1 || fit == 0 {
            return;
        }
        let violate = if fit == 1 { "violates" } else { "violate" };
        let drives = counted(all, "drive", "drives");
        answer.heading(format!("{fit} of {drives} {violate} no rule"));
        for class in self.selection.classes() {
            let drive = &class.first.drive;
            let power = drive.motor.rated_power();
            let power = power.map_or_else(String::new, |power| format!(", {}", kilowatts(power)));
            answer.sentence(format!(
                "{} {}; the first is rank {}: {}{power}",
                class.count,
                certainty(class.certainty),
                class.rank,
                drive.name()
            ));
        }
    }

    /// The rules that are not checked for some of the suitable drives, with the cure.
    pub(crate) fn gaps(&self, answer: &mut Answer, judged: &Assessment) {
        let words = judged.drive.motor.kind.vocabulary();
        let gaps = self.selection.gaps();
        if gaps.is_empty() {
            return;
        }
        let whole = self.selection.fit.len() - self.selection.partly_checked();
        let whole = counted(whole, "drive", "drives");
        answer.sentence(format!(
            "checked by all rules: {whole}; not checked, because data are missing:"
        ));
        for gap in &gaps {
            let drives = counted(gap.count, "drive", "drives");
            let says = format!(
                "{drives} (no data: {}); needs {}",
                missing(&gap.example),
                cure(gap.rule)
            );
            answer.fact(gap.rule.named(words), says);
        }
    }

    /// Smaller suitable motors, which rank lower because their data are less certain; then the next smaller one with the rules that it violates.
    pub(crate) fn smaller(&self, answer: &mut Answer) {
        let selection = self.selection;
        let power = |candidate: &Candidate| candidate.drive.motor.rated_power();
        let best = selection.fit.first();
        let mut least = best.and_then(power).unwrap_or(f64::INFINITY);
        // Under another ranking the first drive of a class is not its smallest.
        let by_size = selection.ranking.is_none();
        for class in selection.classes().iter().filter(|_| by_size) {
            if let Some(power) = power(&class.first).filter(|power| *power < least) {
                least = power;
                answer.sentence(format!(
                    "smaller motor, {}: {} violates no rule either, but ranks lower ({}): {}",
                    kilowatts(power),
                    class.first.drive.name(),
                    class.rank,
                    doubt(class.certainty)
                ));
            }
        }
        if let Some(next) = next_smaller(selection) {
            answer.sentence(next);
        }
    }

    /// The ranked drives: with the keys of the catalogue, or with makers, models and remarks.
    pub(crate) fn ranking(&self, answer: &mut Answer, judged: &Assessment, in_full: bool) {
        let (list, selection) = (self.list, self.selection);
        let shown = list.ranked(selection);
        let each = shown
            .iter()
            .map(|(rank, candidate)| (*rank, selection.judged(candidate)));
        let each: Vec<(usize, Assessment)> = each.collect();
        let resistors = each.iter().any(|(_, judged)| judged.resistor.is_some());
        let mut header = vec![
            ("rank", Quantity),
            ("motor", Words),
            ("made for", Words),
            ("gearbox", Words),
            ("ratio", Quantity),
            ("amplifier", Words),
            ("rated [kW]", Quantity),
            ("mass [kg]", Quantity),
            ("price", Quantity),
            ("RMS used", Share),
            ("peak used", Share),
            ("speed used", Share),
            ("λ max", Quantity),
        ];
        header.extend(resistors.then_some(("brake resistor", Words)));
        header.extend(in_full.then_some(("remarks", Words)));
        let (columns, kinds): (Vec<&str>, Vec<ColumnKind>) = header.into_iter().unzip();
        let row = |(rank, judged): &(usize, Assessment)| {
            let mut row = rank_row(*rank, judged, in_full).to_vec();
            if resistors {
                row.push(judged.resistor.map_or("–".to_owned(), |r| {
                    marks::part([&r.maker, &r.model, &r.key], r.from_maker, in_full)
                }));
            }
            if in_full {
                row.push(remarks(judged));
            }
            row.into_iter().map(Cell::Text).collect()
        };
        answer.table(Reading {
            columns: columns.into_iter().map(str::to_owned).collect(),
            rows: each.iter().map(row).collect(),
            // Keys are for copying.
            kinds,
            whole: if in_full {
                0
            } else {
                COLUMNS + usize::from(resistors)
            },
            ..Reading::default()
        });
        if self.count() > 1 {
            let words = judged.drive.motor.kind.vocabulary();
            answer.sentence(format!("ranked: {}", selection.ranking(words)));
        }
        let drives: Vec<Drive> = shown.iter().map(|(_, c)| c.drive).collect();
        for line in marks::legend(&drives) {
            answer.sentence(line);
        }
        if resistors {
            answer.sentence(
                "brake resistor: the smallest of the catalogue that fits; the price contains it",
            );
        }
        let more = selection.fit.len() - shown.len();
        if more > 0 && !list.all && !list.all_gearboxes {
            answer.sentence(format!(
                "{}: other gearboxes and amplifiers, or larger motors; --all-gearboxes lists every gearbox, --top N more motors",
                counted(more, "more drive fits", "more drives fit")
            ));
        }
    }

    /// The refused drives with the rules that they violate.
    pub(crate) fn refused(&self, answer: &mut Answer) {
        let header = [
            ("drive", Words),
            ("violates", Words),
            ("figure", Quantity),
            ("limit", Quantity),
            ("used", Share),
            ("limit is", Words),
        ];
        let mut rows = Vec::new();
        for refused in self.list.refused(self.selection) {
            let mut name = refused.drive.name();
            let judged = self.selection.judged(&refused);
            let fails = |check: &&Check| check.verdict == RuleVerdict::Fail;
            for check in judged.checks.iter().filter(fails) {
                rows.push([
                    std::mem::take(&mut name),
                    check.rule.to_owned(),
                    check.figure(),
                    check.bound().unwrap_or_default(),
                    check.used(),
                    note(check),
                ]);
            }
        }
        if !rows.is_empty() {
            answer.table(table(header, rows.into_iter(), 1));
        }
    }
}

/// Rules of a suitable drive that warn or are not checked.
fn remarks(judged: &Assessment) -> String {
    let of = [RuleVerdict::Warn, RuleVerdict::NotChecked].map(|verdict| {
        let checks = judged.checks.iter().filter(|c| c.verdict == verdict);
        let rules: Vec<&str> = checks.map(|c| c.rule).collect();
        (verdict.word(), rules.join(", "))
    });
    let of = of.into_iter().filter(|(_, rules)| !rules.is_empty());
    let of: Vec<String> = of.map(|(word, rules)| format!("{word}: {rules}")).collect();
    of.join("; ")
}

/// The next smaller motor, and the rules that it violates.
fn next_smaller(selection: &Selection) -> Option<String> {
    let next = &selection.judged(&selection.next_smaller()?);
    Some(format!(
        "next smaller motor, {}: {} is refused: {}",
        kilowatts(next.rated_power()?),
        next.drive.name(),
        reasons(next)
    ))
}

/// Columns of the ranking, without the brake resistor.
const COLUMNS: usize = 13;

fn rank_row(rank: usize, judged: &Assessment, in_full: bool) -> [String; COLUMNS] {
    let drive = &judged.drive;
    let power = judged.rated_power();
    let [motor, gearbox, amplifier] = marks::drive(drive, in_full);
    [
        rank.to_string(),
        motor,
        marks::made_for(drive),
        gearbox,
        rounded(drive.ratio()),
        amplifier,
        power.map_or("–".to_owned(), |power| significant(power / 1000.0, 3)),
        figure(drive.mass()),
        figure(judged.price()),
        judged.used(Rule::RmsTorque),
        judged.used(Rule::PeakTorque),
        judged.used(Rule::Speed),
        short(judged.duty.inertia_ratio.max),
    ]
}

/// A power (W) as lists have it.
pub(super) fn kilowatts(power: f64) -> String {
    format!("{} kW", significant(power / 1e3, 3))
}

/// The certainty of a drive's data.
const fn certainty(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Makers => "with the makers' own figures, of known voltage",
        Certainty::Others => "with figures that are not all the makers' own (*), of known voltage",
        Certainty::MakersIncomplete => {
            "with the makers' own figures, but without an amplifier, a brake or the gearbox's peak torque in the catalogue"
        }
        Certainty::OthersIncomplete => {
            "with figures that are not all the makers' own (*), without an amplifier, a brake or the gearbox's peak torque in the catalogue"
        }
        Certainty::Pairing => {
            "whose amplifier no source pairs with the motor (†), of known voltage"
        }
        Certainty::Voltage => "of unknown voltage (–)",
    }
}

/// Why a drive ranks lower than others.
pub(super) const fn doubt(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Makers => "it is larger",
        Certainty::Others => {
            "its figures are not all the makers' own; check them against the data sheets"
        }
        Certainty::MakersIncomplete | Certainty::OthersIncomplete => {
            "the catalogue has no amplifier, no brake or no peak torque of the gearbox for it"
        }
        Certainty::Pairing => "no source pairs this amplifier with this motor; ask the makers",
        Certainty::Voltage => "the catalogue does not give its voltage class; ask the makers",
    }
}

/// Margin in percent.
fn margin(check: &Check) -> String {
    match check.margin {
        Some(margin) if margin > -9.995 => format!("{:+.0} %", margin * 100.0),
        Some(_) => "< -999 %".to_owned(),
        None => String::new(),
    }
}

/// A figure of the catalogue, or a dash without data.
fn figure(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), short)
}
