//! The source in the firmware: the meter over the cycle has the figures of `jred size`, and its verdicts.

use jred::duty::{Meter, Verdict, Window};
use jred::machine::Reducible as _;
use jred::mechanism::TrainOutput;
use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict as Sized;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::judge::check::Check;

use super::with_limits;
use crate::support::{budget, near, press_file};

/// The source as firmware includes it.
#[allow(unreachable_pub, reason = "a test has nobody to export to")]
mod limits {
    include!("../data/meter_press.rs");
}

/// The meter after one cycle of `ticks` of a drive that follows the motion, sampled in the middle of each tick.
fn metered(file: &MachineFile, c: &Coefficients, ratio: f64, ticks: u32) -> Meter<f32> {
    let motion = file.motion.as_ref().unwrap();
    let step = motion.duration() / f64::from(ticks);
    let window = Window::SinceStart;
    let mut meter = Meter::new(limits::limits().unwrap(), step as f32, window).unwrap();
    let train = &file.drive_train;
    for k in 0..ticks {
        let state = motion.at((f64::from(k) + 0.5) * step);
        let r = file.machine.reduction(state.phi).unwrap();
        let total = r.torque(state.omega, state.alpha).total();
        let output = train.input(&TrainOutput {
            torque: total,
            torque_per_alpha: r.inertia,
            omega: state.omega,
            alpha: state.alpha,
            direction: state.omega,
        });
        let speed = state.omega * train.ratio();
        let back = output.torque * speed < 0.0;
        let [driving, back] = if back {
            [0.0, output.torque]
        } else {
            [output.torque, 0.0]
        };
        let sign = if speed == 0.0 { 0.0 } else { speed.signum() };
        let torque = c.torque(&[state.alpha * train.ratio(), driving, back, speed, sign]);
        meter.tick(torque as f32, (speed * ratio) as f32, output.torque as f32);
    }
    meter.count_cycle();
    meter
}

#[test]
fn the_meter_reads_what_was_sized() {
    let file = checked::read(&press_file()).unwrap();
    with_limits(&file, |context, _| {
        let meter = metered(&file, &context.coefficients, context.ratio, 20_000);
        let (found, sized) = (meter.figures(), limits::SIZED);
        let pairs = [
            ("RMS torque", found.rms_torque, sized.rms_torque),
            ("mean speed", found.mean_speed, sized.mean_speed),
            ("output mean", found.output_mean, sized.output_mean),
            ("motoring power", found.motoring_power, sized.motoring_power),
            (
                "regenerative power",
                found.regenerative_power,
                sized.regenerative_power,
            ),
            (
                "motoring energy",
                found.motoring_energy,
                sized.motoring_energy,
            ),
            (
                "regenerative energy",
                found.regenerative_energy,
                sized.regenerative_energy,
            ),
            ("duration", found.duration, sized.duration),
            ("peak torque", found.peak_torque, sized.peak_torque),
            ("peak speed", found.peak_speed, sized.peak_speed),
            ("output peak", found.output_peak, sized.output_peak),
            (
                "peak share",
                found.peak_share.unwrap(),
                sized.peak_share.unwrap(),
            ),
            ("cycles", found.cycles_per_hour, sized.cycles_per_hour),
        ];
        for (what, found, sized) in pairs {
            near(
                what,
                f64::from(found),
                f64::from(sized),
                budget::METER_SIZED,
            );
        }
        assert_eq!((found.cycles, found.invalid), (sized.cycles, sized.invalid));
        near(
            "cycle",
            f64::from(limits::CYCLE_TIME),
            context.cycle.duration(),
            budget::METER_SIZED,
        );
    });
}

/// The figures and the verdicts of the rules that the meter covers.
#[test]
fn the_meter_judges_as_sizing_does() {
    let file = checked::read(&press_file()).unwrap();
    with_limits(&file, |context, _| {
        let meter = metered(&file, &context.coefficients, context.ratio, 20_000);
        let (figures, verdicts) = (meter.figures(), meter.verdicts());
        let checks = context.checks(&file.rules);
        let of = |rule: Rule| -> &Check {
            let found = checks.iter().find(|check| check.id == rule);
            found.unwrap_or_else(|| panic!("no {rule:?}"))
        };
        let rpm = jred_file::units::RPM;
        let pairs = [
            (
                Rule::RmsTorque,
                figures.rms_torque,
                verdicts.rms_torque,
                1.0,
            ),
            (Rule::Speed, figures.peak_speed, verdicts.speed, rpm),
            (
                Rule::GearboxMeanSpeed,
                figures.mean_speed,
                verdicts.mean_speed,
                rpm,
            ),
            (
                Rule::GearboxPeak,
                figures.output_peak,
                verdicts.output_peak,
                1.0,
            ),
            (
                Rule::GearboxCubicMean,
                figures.output_mean,
                verdicts.output_mean,
                1.0,
            ),
            (
                Rule::GearboxCycles,
                figures.cycles_per_hour,
                verdicts.cycles_per_hour,
                1.0,
            ),
        ];
        for (rule, found, verdict, unit) in pairs {
            let check = of(rule);
            let sized = check.value.unwrap() * unit;
            near(rule.name(), f64::from(found), sized, budget::METER_SIZED);
            assert_eq!(verdict, expected(check), "{rule:?}");
        }
        // The largest share of the envelope, by a curve below it.
        let check = of(Rule::PeakTorque);
        assert_eq!(verdicts.peak_torque, expected(check));
        let share = f64::from(figures.peak_share.unwrap());
        let used = check.value.unwrap() / check.limit.unwrap();
        assert!(
            share >= used * (1.0 - budget::METER_SIZED)
                && share <= used * (1.0 + budget::METER_SHORTFALL),
            "{share} of the curve, {used} of the envelope"
        );
        // There are verdicts of both kinds.
        assert_eq!(verdicts.rms_torque, Verdict::Satisfied);
        assert_eq!(verdicts.cycles_per_hour, Verdict::Exceeded);
    });
}

fn expected(check: &Check) -> Verdict {
    match check.verdict {
        Sized::Pass => Verdict::Satisfied,
        // The meter has one limit: that of the warning, if there is only a warning.
        Sized::Warn | Sized::Fail => Verdict::Exceeded,
        Sized::Off | Sized::NotChecked => Verdict::NotChecked,
    }
}
