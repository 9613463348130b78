//! Limits for the firmware's duty meter: below those of sizing, compiled, and read with sizing's figures.

mod curves;
mod firmware;

use crate::brute;
use crate::support::{budget, edited_press, near, press_file, shipped};
use jred::duty::Curve;
use jred_analysis::checked;
use jred_analysis::duty::{Duty, STEPS};
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_report::list::rule_words::assumptions;
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
    let (id, drive) = catalogue.drives().find(|(_, d)| named(d)).unwrap();
    let context = Context::new(&cycle, &file.site, drive, &motors[id.motor()]);
    test(&context, &MeterLimits::new(&context, &file.rules));
}

/// The source with all assumptions about the drive.
fn source(machine: &str, file: &MachineFile, context: &Context, limits: &MeterLimits) -> String {
    let assumed = assumptions(&context.drive, &context.assumptions(&file.rules));
    limits.source(machine, &assumed)
}

/// Rules that are off give no limit, shares are included in the limits, and without judged rules the source still gives the reason.
#[test]
fn limits_are_those_of_the_rules() {
    let rules = "[rules]\nrms_torque = \"50 %\"\npeak_torque = \"off\"\nspeed = \"100 %\"\ngearbox_mean_exponent = \"10/3\"\n\n[motion]";
    let text = edited_press("[motion]", rules);
    let file = checked::parse("press.toml", &text, std::path::Path::new("")).unwrap();
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
        let source = source("press.toml", &file, context, limits);
        assert!(source.contains("// No limit `peak`: the rule \"peak torque\" is not checked."));
        assert!(source.contains("not monitored by the meter:"));
        assert!(!source.contains(".with_peak("));
    });
}

/// Violated rules are named with their figures; without violations there is no such text.
#[test]
fn violated_rules_are_named() {
    for (share, violated) in [("100 %", 0), ("0.1 %", 2)] {
        let rules = format!("[rules]\nspeed = \"{share}\"\nrms_torque = \"{share}\"\n\n[motion]");
        let text = edited_press("[motion]", &rules);
        let file = checked::parse("press.toml", &text, std::path::Path::new("")).unwrap();
        with_limits(&file, |_, limits| {
            let broken = limits.broken();
            assert_eq!(broken.len(), violated, "{broken:?}");
            for (name, words) in ["RMS torque", "speed"].iter().zip(&broken) {
                assert!(words.starts_with(name), "{words}");
            }
        });
    }
}

/// The figures of the cycle in the source are those of plain loops over its samples, for a drive with regeneration.
#[test]
fn sized_figures_are_those_of_the_samples() {
    let file = checked::read(&shipped("hoist.toml")).unwrap();
    with_limits(&file, |context, limits| {
        let source = source("hoist.toml", &file, context, limits);
        let sized = source.split_once("pub const SIZED").unwrap().1;
        let of = |name: &str| -> f64 {
            let after = sized.split_once(&format!("    {name}: ")).unwrap().1;
            let figure = after.split_once(',').unwrap().0;
            figure.replace('_', "").parse().unwrap()
        };
        let (cycle, c, ratio) = (context.cycle, &context.coefficients, context.ratio);
        let [motoring, back] = brute::energies(cycle, c, ratio);
        assert!(
            back > 1.0 && motoring > 1.0 && cycle.duration() > 2.0,
            "the case shows nothing"
        );
        let speeds = || {
            cycle
                .samples()
                .iter()
                .map(|s| (s.weight, s.speed().abs() * ratio))
        };
        let torques = || {
            let samples = cycle.samples().iter();
            samples.map(|s| (c.torque(&s.loads()).abs(), s.speed().abs() * ratio))
        };
        let largest = torques().map(|(torque, _)| torque).fold(0.0, f64::max);
        let time: f64 = cycle.samples().iter().map(|s| s.weight).sum();
        let turned: f64 = speeds().map(|(weight, speed)| weight * speed).sum();
        let fastest = speeds().map(|(_, speed)| speed).fold(0.0, f64::max);
        for (name, expected) in [
            ("rms_torque", brute::rms_torque(cycle, c)),
            ("mean_speed", turned / time),
            ("output_mean", brute::mean_output_torque(cycle, 3.0)),
            ("motoring_power", motoring / time),
            ("regenerative_power", back / time),
            ("motoring_energy", motoring),
            ("regenerative_energy", back),
            ("duration", time),
            ("peak_speed", fastest),
            ("peak_torque", largest),
            ("output_peak", brute::peak_output_torque(cycle)),
            // Once up and once down.
            ("cycles_per_hour", 3600.0 * 2.0 / time),
        ] {
            // Written in single precision.
            near(name, of(name), expected, 1e-6);
        }
        assert!((of("cycles") - 2.0).abs() < 0.5);
        // The largest share of the written curve, as the meter reads it.
        let peak = limits
            .entries
            .iter()
            .find(|e| e.field == Field::Peak)
            .unwrap();
        let Bound::Curve(curve) = &peak.bound else {
            panic!("{peak:?}");
        };
        let curve = Curve::new(&curve.points).unwrap();
        let shares = torques().map(|(torque, speed)| torque / f64::from(curve.at(speed as f32)));
        let share = sized.split_once("peak_share: Some(").unwrap().1;
        let share = share.split_once(')').unwrap().0.replace('_', "");
        near(
            "peak_share",
            share.parse().unwrap(),
            shares.fold(0.0, f64::max),
            1e-5,
        );
    });
}

/// The mean torque of the gearbox is monitored only if the rule has the exponent 3.
#[test]
fn what_the_meter_does_not_monitor_is_named() {
    for (exponent, monitored) in [("3", true), ("10/3", false)] {
        let rules = format!("[rules]\ngearbox_mean_exponent = \"{exponent}\"\n\n[motion]");
        let text = edited_press("[motion]", &rules);
        let file = checked::parse("press.toml", &text, std::path::Path::new("")).unwrap();
        with_limits(&file, |context, limits| {
            let unseen = limits.unseen();
            assert_eq!(
                !unseen.contains(&Rule::GearboxCubicMean),
                monitored,
                "{unseen:?}"
            );
            let judged = context.findings(&file.rules);
            for rule in &unseen {
                assert!(judged.get(*rule).is_some() && file.rules.limit(*rule).is_set());
            }
            for seen in [
                Rule::RmsTorque,
                Rule::PeakTorque,
                Rule::Speed,
                Rule::GearboxPeak,
            ] {
                assert!(!unseen.contains(&seen), "{unseen:?}");
            }
        });
    }
}

/// The source begins with violated rules, and wraps its arrays like rustfmt: beyond sixty characters.
#[test]
fn the_source_warns_and_is_laid_out() {
    let (mut lines, mut broken) = (0, 0);
    for (share, violated) in [("100 %", false), ("0.1 %", true)] {
        let rules = format!("[rules]\nspeed = \"{share}\"\n\n[motion]");
        let text = edited_press("[motion]", &rules);
        let file = checked::parse("press.toml", &text, std::path::Path::new("")).unwrap();
        with_limits(&file, |context, limits| {
            let source = source("press.toml", &file, context, limits);
            assert_eq!(source.contains("THIS DRIVE VIOLATES RULES"), violated);
            assert_eq!(source.contains("violated: speed"), violated);
            for (start, _) in source.match_indices(" = [") {
                let array = &source[start + 4..];
                let array = &array[..array.find("];").unwrap()];
                let joined: Vec<&str> = array.lines().map(str::trim).collect();
                let joined = joined.join(" ");
                let joined = joined.trim().trim_end_matches(',');
                let in_lines = array.starts_with('\n');
                assert_eq!(in_lines, joined.len() > 60, "{array}");
                lines += usize::from(!in_lines);
                broken += usize::from(in_lines);
            }
        });
    }
    assert!(lines > 0 && broken > 0, "{lines} {broken}");
}

/// The distance of a curve below its rating is stated if larger than rounding, and correct.
#[test]
fn shortfalls_are_said() {
    let file = checked::read(&press_file()).unwrap();
    with_limits(&file, |_, limits| {
        let mut curves = 0;
        for entry in &limits.entries {
            let Bound::Curve(curve) = &entry.bound else {
                continue;
            };
            let said = entry.words.split(", up to ").nth(1);
            assert_eq!(said.is_some(), curve.shortfall > 1e-5, "{}", entry.words);
            if let Some(said) = said {
                let number: f64 = said.split(' ').next().unwrap().parse().unwrap();
                near("shortfall", number, 100.0 * curve.shortfall, 0.05);
                assert!(said.ends_with("% of its largest value below it"), "{said}");
            }
            curves += 1;
        }
        assert_eq!(curves, 2);
    });
}

/// Each constant in the source has its unit, and digits grouped by three on both sides of the decimal point.
#[test]
fn constants_have_units_and_grouped_digits() {
    let file = checked::read(&press_file()).unwrap();
    with_limits(&file, |context, limits| {
        let source = source("press.toml", &file, context, limits);
        for (name, unit) in [
            ("CONTINUOUS", "N m over rad/s"),
            ("PEAK", "N m over rad/s"),
            ("SPEED", "rad/s"),
            ("MEAN_SPEED", "rad/s"),
            ("OUTPUT_PEAK", "N m"),
            ("OUTPUT_MEAN", "N m"),
            ("CYCLES_PER_HOUR", "1/h"),
            ("CYCLE_TIME", "s"),
        ] {
            let (before, _) = source
                .split_once(&format!("pub const {name}: "))
                .unwrap_or_else(|| panic!("no {name} in {source}"));
            assert!(before.ends_with(&format!(" ({unit}).\n")), "{name}");
        }
        let (_, code) = source.split_once("pub const").unwrap();
        let code = code
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        let mut long = 0;
        for word in
            code.flat_map(|line| line.split(|c: char| !c.is_ascii_digit() && c != '_' && c != '.'))
        {
            let Some((whole, fraction)) = word.split_once('.') else {
                continue;
            };
            let groups = |text: &str| text.split('_').map(str::len).collect::<Vec<_>>();
            let (whole, fraction) = (groups(whole), groups(fraction));
            assert!(
                whole[0] <= 3 && whole[1..].iter().all(|n| *n == 3),
                "{word}"
            );
            let (last, full) = fraction.split_last().unwrap();
            assert!(*last <= 3 && full.iter().all(|n| *n == 3), "{word}");
            long += usize::from(whole.len() > 1 || fraction.len() > 1);
        }
        assert!(long > 3, "{source}");
    });
}

/// Of two rules for one speed the stricter gives the limit and is named.
#[test]
fn the_stricter_of_two_rules_is_the_limit() {
    for (motor, gearbox) in [("100 %", "20 %"), ("20 %", "100 %")] {
        let rules =
            format!("[rules]\nspeed = \"{motor}\"\ngearbox_speed = \"{gearbox}\"\n\n[motion]");
        let text = edited_press("[motion]", &rules);
        let file = checked::parse("press.toml", &text, std::path::Path::new("")).unwrap();
        with_limits(&file, |context, limits| {
            let entry = limits
                .entries
                .iter()
                .find(|e| e.field == Field::Speed)
                .unwrap();
            let findings = context.findings(&file.rules);
            let (rule, part) = if motor == "20 %" {
                (Rule::Speed, "motor's")
            } else {
                (Rule::GearboxSpeed, "gearbox's")
            };
            let least = 0.2 * findings.get(rule).unwrap().rating;
            let Bound::Figure(limit) = entry.bound else {
                panic!("{entry:?}");
            };
            let off = least - f64::from(limit);
            assert!((0.0..1e-4).contains(&off), "{limit} of {least}");
            assert!(
                entry.words.starts_with("20 % of the") && entry.words.contains(part),
                "{}",
                entry.words
            );
        });
    }
}

/// The constants of the source are those that its function passes to the meter; a time constant of 0 is left out.
#[test]
fn the_limits_that_are_defined_are_used() {
    let file = checked::read(&press_file()).unwrap();
    with_limits(&file, |context, limits| {
        let source = source("press.toml", &file, context, limits);
        let (_, function) = source.split_once("pub fn limits()").unwrap();
        for entry in &limits.entries {
            let (field, name) = (entry.field, entry.field.word().to_uppercase());
            let call = match entry.bound {
                Bound::Open => continue,
                Bound::Figure(_) => format!(".with_{field}({name})"),
                Bound::Curve(_) => format!(".with_{field}(jred::duty::Curve::new(&{name})?)"),
            };
            assert!(function.contains(&call), "{function}");
            assert!(source.contains(&format!("pub const {name}: ")), "{source}");
        }
        for (time, said) in [
            (None, false),
            (Some(0.0), false),
            (Some(f64::INFINITY), false),
            (Some(90.0), true),
        ] {
            let mut motor = context.drive.motor.clone();
            motor.thermal.winding_time = time;
            let drive = Drive {
                motor: &motor,
                ..context.drive
            };
            let context = Context::new(context.cycle, context.site, drive, context.motor);
            let source = MeterLimits::new(&context, &file.rules).source("press.toml", &[]);
            assert_eq!(source.contains("pub const WINDING_TIME: f32 = 90.0;"), said);
            assert_eq!(source.contains("WINDING_TIME"), said, "{time:?}");
        }
    });
}
