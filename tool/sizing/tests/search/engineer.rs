//! Real machines and a small catalogue: the order of the drives against one computed plainly from the catalogue's text and the verdicts of the rules,
//! and the brake resistor against trying one after the other.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::supply::BrakeResistor;
use jred_report::list::rule_words::note;
use jred_sizing::catalogue::{Catalogue, Drive, Sources};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::{Assessment, Context};
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::select::rank::{Objective, rank};
use jred_sizing::select::size::{Certainty, Selection};

/// The machines; the punch has no motion in its file.
const MACHINES: [(&str, &str); 8] = [
    ("knife", ""),
    ("lift", ""),
    ("lift-res", ""),
    (
        "punch",
        "\n[motion]\ntype = \"constant-speed\"\nspeed = \"90 rpm\"\n",
    ),
    ("screw", ""),
    ("sealer", ""),
    ("sealer-dir", ""),
    ("table", ""),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/engineer")
}

fn machine(name: &str, more: &str) -> MachineFile {
    let folder = folder();
    let text = std::fs::read_to_string(folder.join(name).with_extension("toml")).unwrap();
    checked::parse(name, &(text + more), &folder).unwrap()
}

fn catalogue() -> Catalogue {
    let sources = Sources {
        catalogues: vec![folder().join("cat")],
        ..Sources::default()
    };
    Catalogue::open(&sources).unwrap()
}

/// A table of the catalogue: rows of cells by column name without unit.
struct Table(Vec<String>, Vec<Vec<String>>);

impl Table {
    fn open(name: &str) -> Self {
        let text = std::fs::read_to_string(folder().join("cat").join(name)).unwrap();
        let mut rows = text.lines().map(|line| {
            let cells = line.replace("\"1000/h: 1; 2000/h: 1.15; 3000/h: 1.4; 5000/h: 2\"", "");
            cells.split(';').map(ToOwned::to_owned).collect::<Vec<_>>()
        });
        let head = rows.next().unwrap();
        let head = head
            .iter()
            .map(|title| title.split(" [").next().unwrap().to_owned());
        Self(head.collect(), rows.collect())
    }

    /// A figure of the row with this key; zero if the drive has no such part.
    fn figure(&self, key: Option<&str>, column: &str) -> f64 {
        let Some(key) = key else { return 0.0 };
        let row = self.1.iter().find(|row| row[0] == key).unwrap();
        let place = self.0.iter().position(|title| title == column).unwrap();
        row[place].parse().unwrap()
    }
}

/// Keys of motor, gearbox and amplifier.
type Keys = (String, Option<String>, Option<String>);

/// Which of two suitable drives a buyer would prefer: smaller motor by rated power and torque, fewer doubts, smaller amplifier, smaller gearbox, less
/// mass, lower price.
fn buyer(a: &(Keys, bool), b: &(Keys, bool)) -> Ordering {
    let [motors, gearboxes, amplifiers] =
        ["motors.csv", "gearboxes.csv", "amplifiers.csv"].map(Table::open);
    let figures = |((motor, gearbox, amplifier), warns): &(Keys, bool)| {
        let (m, g, a) = (
            Some(motor.as_str()),
            gearbox.as_deref(),
            amplifier.as_deref(),
        );
        let sum = |column: &str| {
            motors.figure(m, column) + gearboxes.figure(g, column) + amplifiers.figure(a, column)
        };
        [
            motors.figure(m, "rated_torque") * motors.figure(m, "rated_speed"),
            motors.figure(m, "rated_torque"),
            f64::from(u8::from(*warns)),
            amplifiers.figure(a, "rated_current"),
            gearboxes.figure(g, "rated_output_torque"),
            sum("mass"),
            sum("price"),
        ]
    };
    // Sums of decimal figures that differ in their last digit only are equal.
    let near = |x: f64, y: f64| {
        if (x - y).abs() <= 1e-9 * x.abs() {
            Ordering::Equal
        } else {
            x.total_cmp(&y)
        }
    };
    let pairs = figures(a).into_iter().zip(figures(b));
    let order = pairs.map(|(x, y)| near(x, y));
    order
        .fold(Ordering::Equal, Ordering::then)
        .then_with(|| a.0.cmp(&b.0))
}

fn keys(drive: &Drive) -> Keys {
    (
        drive.motor.key.clone(),
        drive.gearbox.map(|g| g.key.clone()),
        drive.amplifier.map(|a| a.key.clone()),
    )
}

/// Every machine with every drive of the catalogue, judged one by one.
#[test]
fn drives_stand_in_the_order_in_which_a_buyer_takes_them() {
    let catalogue = catalogue();
    let mut ranked = 0;
    for (name, more) in MACHINES {
        let file = machine(name, more);
        let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 500).unwrap();
        let cycle = Cycle::new(&duty);
        let motors = catalogue.prepare(&file.site);
        let mut expected: Vec<(Keys, bool)> = Vec::new();
        for (motor, limits) in catalogue.motors.iter().zip(&motors) {
            let list: &[&str] = match &motor.key[..4] {
                "sm60" => &["g70-5"],
                "sm80" => &["g70-5", "g90-10"],
                "sm10" => &["g90-10", "g115-16"],
                _ => &["g115-16"],
            };
            let fits = catalogue
                .gearboxes
                .iter()
                .filter(|g| list.contains(&g.key.as_str()));
            for gearbox in std::iter::once(None).chain(fits.map(Some)) {
                // Half to four times the standstill current, at one voltage.
                let current = motor.winding.standstill_current.unwrap();
                let own = 0.5 * current..=4.0 * current;
                let runs = catalogue.amplifiers.iter();
                for amplifier in runs.filter(|a| own.contains(&a.rated_current)) {
                    let drive = Drive {
                        motor,
                        gearbox,
                        amplifier: Some(amplifier),
                    };
                    let context = Context::new(&cycle, &file.site, drive, limits)
                        .with_resistors(&catalogue.resistors);
                    let checks = Assessment::new(&context, &file.rules).checks;
                    let verdicts: Vec<RuleVerdict> = checks.iter().map(|c| c.verdict).collect();
                    if !verdicts.contains(&RuleVerdict::Fail) {
                        expected.push((keys(&drive), verdicts.contains(&RuleVerdict::Warn)));
                    }
                }
            }
        }
        expected.sort_by(buyer);
        let expected: Vec<Keys> = expected.into_iter().map(|(keys, _)| keys).collect();
        let selection = Selection::parallel(&catalogue, &motors, &cycle, &file.site, &file.rules);
        let found = selection.first_fit(usize::MAX);
        let found: Vec<Keys> = found.iter().map(|c| keys(&c.drive)).collect();
        assert_eq!(found, expected, "{name}");
        let best = Selection::best(&catalogue, &motors, &cycle, &file.site, &file.rules);
        let best = best.map(|best| keys(&best.drive));
        assert_eq!(best.as_ref(), expected.first(), "{name}");
        ranked += found.len();
        // One line for each motor: its first drive.
        let mut lines: Vec<(usize, Keys)> = Vec::new();
        for (k, drive) in expected.iter().enumerate() {
            if lines.iter().all(|(_, line)| line.0 != drive.0) {
                lines.push((k + 1, drive.clone()));
            }
        }
        let listed = selection.first_of_motors(usize::MAX).into_iter();
        let listed: Vec<_> = listed.map(|(rank, c)| (rank, keys(&c.drive))).collect();
        assert_eq!(listed, lines, "{name}");
        let classes = selection.classes();
        let certain: Vec<Certainty> = classes.iter().map(|class| class.certainty).collect();
        // Motors and amplifiers are of two makers, and the list pairs gearboxes only.
        assert!(
            certain.iter().all(|c| *c == Certainty::Pairing),
            "{name}: {certain:?}"
        );
    }
    assert!(ranked > 20, "{ranked}");
}

/// The rules of the bus and the resistor, with a resistor connected as if given in the machine file.
fn bears(
    file: &MachineFile,
    cycle: &Cycle,
    drive: Drive,
    limits: &MotorLimits,
    with: Option<BrakeResistor>,
) -> bool {
    let mut site = file.site.clone();
    site.supply.brake_resistor = with;
    let findings = Context::new(cycle, &site, drive, limits).findings(&file.rules);
    [
        Rule::BusVoltage,
        Rule::BrakeResistance,
        Rule::ResistorPower,
        Rule::ResistorPeak,
        Rule::ResistorPulse,
    ]
    .into_iter()
    .filter_map(|rule| Some((rule, findings.get(rule)?)))
    .all(|(rule, finding)| file.rules.verdict(rule, finding) == RuleVerdict::Pass)
}

/// The chosen resistor is the first, by power, that satisfies every rule when connected; none is chosen if the bus needs none.
#[test]
fn the_resistor_is_the_smallest_that_satisfies_the_rules() {
    let catalogue = catalogue();
    let mut by_power: Vec<_> = catalogue.resistors.iter().collect();
    by_power.sort_by(|a, b| a.rated_power.total_cmp(&b.rated_power));
    let (mut chosen, mut free) = (0, 0);
    for (name, more) in MACHINES {
        let mut file = machine(name, more);
        file.site.supply.brake_resistor = None;
        let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 500).unwrap();
        let cycle = Cycle::new(&duty);
        let motors = catalogue.prepare(&file.site);
        let selection = Selection::new(&catalogue, &motors, &cycle, &file.site, &file.rules);
        for candidate in &selection.first_fit(usize::MAX) {
            let limits = &motors[candidate.id().motor()];
            let drive = candidate.drive;
            let bears = |with| bears(&file, &cycle, drive, limits, with);
            let expected = by_power.iter().find(|r| {
                bears(Some(BrakeResistor {
                    resistance: r.resistance,
                    power: r.rated_power,
                    peak_power: r.peak_power,
                    pulse_energy: r.pulse_energy,
                }))
            });
            let found = selection.context(candidate).resistor();
            if bears(None) {
                assert!(found.is_none(), "{name}, {}", drive.name());
                free += 1;
                continue;
            }
            let [found, expected] = [found, expected.copied()].map(|r| r.map(|r| r.key.as_str()));
            assert_eq!(found, expected, "{name}, {}", drive.name());
            chosen += 1;
        }
    }
    assert!(chosen >= 5 && free >= 5, "{chosen} {free}");
}

/// Without the suitable resistor, the drives that need one are refused for that reason alone, come first among the refused ones, and the text names
/// what the catalogue lacks.
#[test]
fn what_the_catalogue_lacks_is_named() {
    let mut catalogue = catalogue();
    let file = machine("lift", "");
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 500).unwrap();
    let cycle = Cycle::new(&duty);
    let motors = catalogue.prepare(&file.site);
    let with = Selection::new(&catalogue, &motors, &cycle, &file.site, &file.rules)
        .fit
        .len();
    for resistor in &mut catalogue.resistors {
        resistor.rated_power = 1e-3;
    }
    let selection = Selection::new(&catalogue, &motors, &cycle, &file.site, &file.rules);
    assert!(with > 0 && selection.fit.is_empty());
    let violations = selection.violations();
    let bus = violations
        .iter()
        .find(|v| v.rule == Rule::BusVoltage)
        .unwrap();
    assert_eq!((bus.count, bus.alone), (with, with));
    let nearest = selection.refused.first().unwrap();
    assert!(nearest.is_same_drive(&bus.closest));
    let judged = selection.judged(nearest);
    let check = judged
        .checks
        .iter()
        .find(|c| c.id == Rule::BusVoltage)
        .unwrap();
    for words in [
        "requires a brake resistor of 100 to ",
        "none of the 3 brake resistors of the catalogue fits: 2 with too small a resistance, 3 with too little continuous power",
    ] {
        assert!(
            note(check).contains(words),
            "{words:?} is not in\n{}",
            note(check)
        );
    }
    catalogue.resistors.clear();
    let selection = Selection::new(&catalogue, &motors, &cycle, &file.site, &file.rules);
    let judged = selection.judged(selection.refused.first().unwrap());
    let check = judged
        .checks
        .iter()
        .find(|c| c.id == Rule::BusVoltage)
        .unwrap();
    assert!(
        note(check).ends_with("neither [supply] nor the catalogue has one"),
        "{}",
        note(check)
    );
}

/// A voltage class has no margin: neither a share nor a rank by margin.
#[test]
fn what_the_parts_are_made_for_is_no_margin() {
    let catalogue = catalogue();
    let file = machine("lift-res", "");
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 500).unwrap();
    let cycle = Cycle::new(&duty);
    let motors = catalogue.prepare(&file.site);
    let mut selection = Selection::new(&catalogue, &motors, &cycle, &file.site, &file.rules);
    rank(&mut selection, Objective::Margin);
    let all = selection.first_fit(usize::MAX);
    assert!(all.len() > 2);
    for candidate in &all {
        assert!(!candidate.outcome.worst_rule.is_some_and(Rule::is_yes_or_no));
        let checks = selection.judged(candidate).checks;
        let fixed = checks.iter().filter(|check| check.id.is_yes_or_no());
        for check in fixed.clone() {
            assert_eq!(
                (check.used().as_str(), check.margin),
                ("", None),
                "{}",
                check.rule
            );
        }
        assert_eq!(fixed.count(), 4);
        let margins = checks
            .iter()
            .filter(|check| file.rules.limit(check.id).fail.is_some());
        let least = margins.filter_map(|check| check.margin).fold(1.0, f64::min);
        let margin = Objective::Margin.value(&selection, candidate).unwrap();
        assert!((margin - least).abs() < 1e-12, "{margin} {least}");
    }
}
