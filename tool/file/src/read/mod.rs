//! Machine files: TOML in, a checked [`MachineFile`] in SI units out.
//!
//! `docs/machine-file.md` lists all keys. Every error shows the line, names the quantity, its value and the limit, and gives a cure.

mod carriage;
mod curve_file;
mod document;
mod drive_element;
mod drive_link;
mod drive_log;
mod drive_train;
mod duty_type;
mod effect;
mod elements;
mod joint_friction;
mod law;
mod load_table;
mod loads;
mod mass;
mod mechanism;
mod motion;
mod names;
mod profile;
mod project;
mod rules;
mod schedule;
mod simulation;
mod stage;
mod stiffness;
mod supply;
mod surroundings;
mod tolerance;
mod tool;
mod variator;
mod window;

pub use drive_log::{DriveLog, LogLayout, drive_log};
pub use mechanism::mechanism_types;
pub use project::project;

use crate::math;
use std::ops::Range;
use std::path::Path;

use toml::de::DeTable;

use crate::problem;
use jred::machine::Machine;

use crate::keys::MACHINE;
use crate::model::axis::Axis;
use crate::model::drive_element::DriveElement;
use crate::model::machine::{MachineFile, ReductionCache};
use crate::model::mechanism::{AnyMechanism, NamedElement, NamedLoad};
use crate::model::rules::RuleSet;
use crate::plain;
#[cfg(feature = "fs")]
use crate::text::disk;
use crate::text::file::{self, Files};
use crate::units::kind::ACCELERATION;

use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::tree;
use drive_link::DriveLink;

/// The largest machine file (bytes).
const MAX_SIZE: u64 = 1 << 20;

/// Cure for a machine file above the limit.
const LARGE: &str =
    "put recorded motions into a separate CSV file and name it with `file` in [motion]";

/// The built-in rule set of this name.
pub fn built_in_rules(name: &str) -> Option<RuleSet> {
    rules::built_in(name)?.ok()
}

/// The names of the built-in rule sets.
pub fn rule_set_names() -> impl Iterator<Item = &'static str> {
    rules::BUILT_IN.iter().map(|(name, _)| *name)
}

/// The rule set of this name, or of a file if `word` ends in `.toml` or contains a slash.
///
/// # Errors
/// An unknown name, a file that cannot be read, or the first fault in it, with its place.
pub fn rule_set(word: &str, files: impl Files) -> Result<RuleSet> {
    rules::named_or_file(word, &files).map_err(|problem| problem.in_text(word, ""))
}

/// The rules of a machine file applied on top of another set.
///
/// # Errors
/// The machine file contradicts the set.
pub fn rules_based_on(rules: &RuleSet, set: RuleSet) -> Result<RuleSet> {
    let word = set.name.clone();
    rules.based_on(set).map_err(|contradiction| {
        problem!(
            help = contradiction.help,
            "[rules] in the machine file contradicts the set \"{word}\": {}",
            contradiction.message
        )
    })
}

/// The name in messages of the machine file at `path`; `-` is standard input.
pub fn name(path: &Path) -> String {
    if path.as_os_str() == "-" {
        return "standard input".to_owned();
    }
    plain::path(path)
}

/// The text of the machine file at `path`, or of standard input if it is `-`.
///
/// # Errors
/// A file that cannot be read.
#[cfg(feature = "fs")]
pub fn text(path: &Path) -> Result<String> {
    let name = name(path);
    let text = if path.as_os_str() == "-" {
        disk::read_stdin(MAX_SIZE)
    } else {
        disk::read(path, MAX_SIZE)
    };
    text.map_err(|fault| {
        let help = match fault.help.as_str() {
            file::LARGE => LARGE,
            help => help,
        };
        Problem::new(format!(
            "cannot read the machine file {name}: {}",
            fault.message
        ))
        .help(help)
        .in_text(&name, "")
    })
}

/// The folder of a machine file: files that it names are relative to it.
pub fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// A machine file as read: its values are checked one by one, its mechanics are not. `jred_analysis::checked` gives the checked file.
#[derive(Debug)]
pub struct UncheckedFile {
    file: MachineFile,
    mechanism: Range<usize>,
    motion: Range<usize>,
}

impl UncheckedFile {
    /// The machine file, for a text whose mechanics are known to pass the checks.
    pub fn trusted(self) -> MachineFile {
        self.file
    }

    /// The machine file, to be checked.
    pub const fn file(&self) -> &MachineFile {
        &self.file
    }

    /// Marks the header of the mechanism.
    pub fn in_mechanism(&self, problem: Problem, label: &str) -> Problem {
        problem.at(self.mechanism.clone(), label)
    }

    /// Marks the header of the motion.
    pub fn in_motion(&self, problem: Problem, label: &str) -> Problem {
        problem.at(self.motion.clone(), label)
    }
}

/// Reads a machine file from its `text`. `name` is its name in messages; `files` provides the files that it names, for example a profile's CSV.
///
/// # Errors
/// The first fault in the file, with its place and a cure.
pub fn parse(name: &str, text: &str, files: impl Files) -> Result<UncheckedFile> {
    let length = text.len() as u64;
    if length > MAX_SIZE {
        let why = file::too_large(&file::size(length), MAX_SIZE);
        let problem = Problem::new(format!("cannot read the machine file {name}: {why}"));
        return Err(problem.help(LARGE).in_text(name, ""));
    }
    machine(name, text, &files).map_err(|problem| problem.in_text(name, text))
}

/// `gravity`: its components, or the inclination of the x axis.
fn gravity(root: &Section) -> Result<[f64; 2]> {
    let item = root.need("gravity")?;
    if !item.is_table() {
        return Ok(item
            .pair([&ACCELERATION, &ACCELERATION])?
            .map(|value| value.si));
    }
    let section = item.section("[gravity]".to_owned())?;
    let (inclination, size) = (
        section.value("inclination")?.si,
        section.si("acceleration")?,
    );
    section.finish()?;
    let (sin, cos) = math::sin_cos(inclination);
    Ok([-size * sin, -size * cos])
}

/// The mechanism with its loads, springs and dampers.
fn loaded(
    mechanism: AnyMechanism,
    loads: &[NamedLoad],
    elements: &[NamedElement],
) -> std::result::Result<Machine<AnyMechanism>, jred::error::Error> {
    let mut machine = Machine::new(mechanism);
    for named in loads {
        machine = machine.with_load(named.load)?;
    }
    for named in elements {
        machine = machine.with_element(named.element)?;
    }
    Ok(machine)
}

/// `title`, or the name of the file.
fn title(root: &Section, name: &str) -> Result<String> {
    let own = || Path::new(name).file_name().map(plain::path);
    let title = root.text("title")?.map(str::to_owned);
    Ok(title.or_else(own).unwrap_or_else(|| name.to_owned()))
}

/// Refuses an empty text and a project.
fn refuse_others(name: &str, table: &DeTable) -> Result<()> {
    if table.is_empty() {
        return Err(Problem::new(format!("the machine file {name} is empty")).help(
            "a machine file needs at least gravity = [\"9.81 m/s^2\", \"0 m/s^2\"] and a [mechanism] with a type, for example type = \"slider-crank\"",
        ));
    }
    if table.contains_key("axis") && !table.contains_key("mechanism") {
        let what = format!("{name} is a project, not a machine file");
        return Err(Problem::new(what).help(
            "size all its axes with `jred project`, or name the machine file of one [[axis]]",
        ));
    }
    Ok(())
}

fn machine(name: &str, text: &str, files: &dyn Files) -> Result<UncheckedFile> {
    if text.len() as u64 > MAX_SIZE {
        let why = file::too_large(&file::size(text.len() as u64), MAX_SIZE);
        return Err(
            Problem::new(format!("cannot read the machine file {name}: {why}")).help(LARGE),
        );
    }
    let tree = tree::parse(text)?;
    refuse_others(name, tree.get_ref())?;
    let root = Section::described(String::new(), 0..0, tree.get_ref(), (&MACHINE, false));
    let title = title(&root, name)?;
    let gravity = gravity(&root)?;
    let section = root.table("mechanism")?;
    let (mechanism, flywheel, element) = mechanism::read(&section, gravity, files)?;
    let drive_link =
        DriveLink::of(&mechanism).map_err(|error| section.error(error, "in this mechanism"))?;
    root.set_slides(drive_link.slides());
    if let (true, Some(item)) = (
        drive_link.slides() && flywheel > 0.0,
        section.peek("flywheel"),
    ) {
        return Err(item
            .problem("is for a rotating drive link, but the drive link of this mechanism slides", "nothing turns with it")
            .help("add a mass that slides with the drive link to its body; rotating parts belong to a stage of [[drive_train]]"));
    }
    let mechanism = mass::read(&root, mechanism)?;
    let (mechanism, tables, table_turns) =
        load_table::read(&root, mechanism, drive_link, gravity, files)?;
    let (mut loads, entries) = loads::read(&root, &mechanism, drive_link, &tables)?;
    let elements = elements::read(&root, &mechanism, drive_link.coordinate)?;
    let (drive_train, mut drive_elements) = drive_train::read(&root, drive_link)?;
    drive_elements.extend(element.map(|element| DriveElement {
        on_input: drive_train.stages().is_empty(),
        ..element
    }));
    let variator = variator::read(&root, drive_link)?;
    let machine = loaded(mechanism, &loads, &elements)
        .and_then(|m| Ok(m.with_gravity(gravity)?.with_flywheel(flywheel)?))
        .map_err(|error| section.error(error, "in this machine"))?;
    let machine = joint_friction::read(&root, machine)?;
    let motion = motion::read(&root, files, drive_link, (&machine, &loads))?;
    let moved = motion.as_ref();
    let (machine, carriages) = carriage::read(&root, files, machine, &mut loads, moved)?;
    let schedule = schedule::read(&root, (&entries, carriages), &loads, &machine, moved)?;
    let machine = schedule.at_no_time().cloned().unwrap_or(machine);
    let around = simulation::SimulationContext {
        drive: drive_link,
        axis: Axis::of(motion.as_ref(), machine.mechanism()),
        drive_train: &drive_train,
        motion: motion.as_ref(),
        variator: variator.is_some(),
    };
    let simulation = simulation::read(&root, around)?;
    let rules = rules::read(&root, files)?;
    let stiffness = stiffness::read(&root, drive_link, &drive_train)?;
    let tool = tool::read(&root, machine.mechanism())?;
    let tolerances = tolerance::read(&root)?;
    let mut site = crate::model::site::Site::default();
    supply::read(&root, &mut site)?;
    surroundings::read(&root, &mut site)?;
    duty_type::read(&root, &mut site)?;
    let document = document::read(&root)?;
    root.finish()?;

    let file = MachineFile {
        name: name.to_owned(),
        title,
        document,
        machine,
        schedule,
        flywheel,
        loads,
        table_turns,
        elements,
        drive_train,
        drive_elements,
        variator,
        motion,
        simulation,
        rules,
        tolerances,
        site: crate::model::site::Site {
            shaft_stiffness: stiffness.shaft,
            train_play: stiffness.play,
            tool,
            ..site
        },
        over_range: ReductionCache::default(),
    };
    let motion = root.maybe_table("motion")?;
    let motion = motion.map_or_else(|| root.header(), |section| section.header());
    Ok(UncheckedFile {
        file,
        mechanism: section.header(),
        motion,
    })
}
