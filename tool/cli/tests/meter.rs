//! `jred size --meter`: limits for the firmware's duty meter that keep below those of sizing, compile, and read its figures.

mod curves;
mod firmware;

use crate::support::{Folder, budget, edited_press, jred, press_file};
use jred_machine::analysis::duty::{Duty, STEPS};
use jred_machine::model::machine::MachineFile;
use jred_machine::read;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::catalogue::Drive;
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::Context;
use jred_sizing::meter::{Bound, Field, MeterLimits};

/// The drive of the source in `tests/data`.
const DRIVE: &str = "sgmsh-30a+npt025mf-3";

/// Runs a test with the limits of [`DRIVE`] at a machine.
fn with_limits(file: &MachineFile, test: impl FnOnce(&Context, &MeterLimits)) {
    let catalogue = Catalogue::load(None, None).unwrap();
    let motors = catalogue.prepare(&file.site);
    let duty = Duty::new(file, file.motion.as_ref().unwrap(), STEPS).unwrap();
    let cycle = Cycle::new(&duty);
    let named = |drive: &Drive| {
        let gearbox = drive.gearbox.map_or("", |gearbox| &gearbox.key);
        format!("{}+{gearbox}", drive.motor.key) == DRIVE
    };
    let (index, drive) = catalogue.drives().find(|(_, d)| named(d)).unwrap();
    let context = Context::new(&cycle, &file.site, drive, &motors[index]);
    test(&context, &MeterLimits::new(&context, &file.rules));
}

/// To make it anew:
///
/// ```text
/// jred size machines/press.toml --why sgmsh-30a+npt025mf-3 --meter tool/cli/tests/data/meter_press.rs
/// ```
#[test]
fn the_source_is_what_the_command_writes() {
    let folder = Folder::new();
    let out = folder.path("limits.rs");
    let run = jred([&"size", &press_file(), &"--why", &DRIVE, &"--meter", &out]).ends(0);
    assert!(
        run.out.contains("limits for the duty meter written to"),
        "{}",
        run.out
    );
    let written = std::fs::read_to_string(out).unwrap();
    assert_eq!(written, include_str!("data/meter_press.rs"));
}

#[test]
fn without_a_drive_that_holds_nothing_is_written() {
    let folder = Folder::new();
    let file = folder.file(
        "press.toml",
        edited_press("[motion]", "[rules]\nrms_torque = 0.001\n\n[motion]"),
    );
    let out = folder.path("limits.rs");
    let run = jred([&"size", &file, &"--meter", &out]).ends(1);
    run.says(&["no drive satisfies every rule", "is not written", "--why"]);
    assert!(!out.exists());
    // That of a drive that does not hold is written when it is named.
    let run = jred([&"size", &file, &"--why", &DRIVE, &"--meter", &out]).ends(1);
    // Not as one that is approved: file and stderr say what it breaks, and by how much.
    run.says(&["violates rules (RMS torque", "does not make it acceptable"]);
    let source = std::fs::read_to_string(&out).unwrap();
    let header: Vec<&str> = source
        .lines()
        .take_while(|line| line.starts_with("//"))
        .collect();
    assert!(
        header
            .iter()
            .any(|l| l.contains("THIS DRIVE VIOLATES RULES")),
        "{source}"
    );
    let violated: Vec<&&str> = header.iter().filter(|l| l.contains("violated:")).collect();
    assert!(
        violated.len() == 1
            && violated[0].starts_with("// violated: RMS torque ")
            && violated[0].ends_with(", > 1000 %"),
        "{violated:?}"
    );
    // Never over the machine file.
    let run = jred([&"size", &file, &"--why", &DRIVE, &"--meter", &file]).ends(2);
    run.says(&["is the machine file"]);
}

/// Rules that are off give no limit, shares stand in the limits, and where no rule is judged the source still says why.
#[test]
fn limits_are_those_of_the_rules() {
    let rules = "[rules]\nrms_torque = \"50 %\"\npeak_torque = \"off\"\nspeed = \"100 %\"\ngearbox_mean_exponent = \"10/3\"\n\n[motion]";
    let text = edited_press("[motion]", rules);
    let file = read::parse("press.toml", &text, std::path::Path::new("")).unwrap();
    with_limits(&file, |context, limits| {
        let of = |field: Field| {
            let entry = limits.entries.iter().find(|entry| entry.field == field);
            entry.unwrap()
        };
        let Bound::Curve(continuous) = &of(Field::Continuous).bound else {
            panic!("{:?}", of(Field::Continuous));
        };
        let standstill = 0.5 * context.motor.envelope.standstill();
        let first = f64::from(continuous.points[0][1]);
        let least = (1.0 - budget::METER_SHORTFALL) * standstill;
        assert!((least..=standstill).contains(&first), "{first}");
        assert_eq!(of(Field::Peak).bound, Bound::Open);
        assert!(of(Field::Peak).words.contains("is not checked"));
        assert_eq!(of(Field::OutputMean).bound, Bound::Open);
        assert!(of(Field::OutputMean).words.contains("10/3"));
        let Bound::Figure(speed) = of(Field::Speed).bound else {
            panic!("{:?}", of(Field::Speed));
        };
        let gearbox = context.drive.gearbox.unwrap().max_speed.unwrap();
        let least = context.motor.envelope.max_speed().min(gearbox);
        let off = least - f64::from(speed);
        assert!((0.0..1e-4).contains(&off), "{speed} of {least}");
        let source = limits.source("press.toml");
        assert!(source.contains("// No limit `peak`: the rule \"peak torque\" is not checked."));
        assert!(source.contains("not monitored by the meter:"));
        assert!(source.contains("peak: None,"));
    });
}
