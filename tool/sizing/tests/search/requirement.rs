//! Requirements for any maker: a motor or a gearbox just inside satisfies every rule, one just outside violates that of its figure.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::{Case, RACK, case};
use crate::support::{edited, press_text};
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_sizing::catalogue::{Brake, Drive, Gearbox, Motor, MotorKind};
use jred_sizing::judge::Context;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::select::fit::input_kind;
use jred_sizing::select::ratio::Gear;
use jred_sizing::select::requirement::{CLOSING_TIMES, Inquiry, Requirement};

const HOIST: &str = include_str!("../../../../machines/hoist.toml");
const CONVEYOR: &str = include_str!("../../../../machines/conveyor.toml");
const SCREW: &str = include_str!("../../../../machines/ball-screw.toml");
const LINEAR: &str = include_str!("../../../../machines/linear-gripper.toml");

const GEAR: Gear = Gear {
    inertia: 3e-5,
    efficiency: 0.94,
};

/// A share by which a figure is moved across its limit: more than the rounding of a verdict (1e-9).
const STEP: f64 = 1e-6;

/// The same for the limit over speed, which has a reserve of 1e-5.
const TOUCH: f64 = 3e-5;

/// The machines and ratios of these tests. The rule set of a file may have warnings and errors.
fn cases() -> Vec<(Case, Vec<Option<f64>>)> {
    let gears = || vec![None, Some(4.0), Some(10.0), Some(35.0)];
    // A helical pinion pushes at the gearbox, and a belt pulls.
    let helical = edited(
        RACK,
        "type = \"rack-and-pinion\"",
        "type = \"rack-and-pinion\"\nhelix_angle = \"19.5 deg\"",
    );
    let belt = edited(&press_text(), "\"1 kN\"", "\"3 kN\"");
    let mut all: Vec<_> = [belt.as_str(), &helical, HOIST, CONVEYOR, SCREW]
        .into_iter()
        .map(|text| (case(text, 500), gears()))
        .collect();
    all.push((case(LINEAR, 500), vec![None]));
    all
}

fn inquiry(case: &Case) -> Inquiry<'_> {
    Inquiry {
        file: &case.file,
        cycle: &case.cycle,
        gear: GEAR,
        allowance: 0.2,
    }
}

/// A gearbox with the required ratings.
fn gearbox(found: &Requirement) -> Option<Gearbox> {
    let needed = found.gearbox?;
    Some(Gearbox {
        ratio: found.ratio?,
        inertia: GEAR.inertia,
        efficiency: GEAR.efficiency,
        back_efficiency: GEAR.efficiency,
        peak_torque: Some(needed.peak_torque),
        rated_torque: Some(needed.rated_torque),
        emergency_torque: needed.emergency_torque,
        rated_speed: Some(needed.rated_speed),
        max_speed: Some(needed.max_speed),
        stiffness: needed.stiffness,
        backlash: needed.backlash,
        max_radial_load: needed.radial_load,
        max_axial_load: needed.axial_load,
        ..Gearbox::default()
    })
}

/// The rules that a drive violates.
fn violated(case: &Case, motor: &Motor, gearbox: Option<&Gearbox>) -> Vec<Rule> {
    let drive = Drive {
        motor,
        gearbox,
        amplifier: None,
    };
    let limits = MotorLimits::new(motor, None, &case.file.site);
    let context = Context::new(&case.cycle, &case.file.site, drive, &limits);
    let rules = &case.file.rules;
    let fails = |rule, finding| {
        let only_warns = rules.limit(rule).fail.is_none();
        let verdict = rules.verdict(rule, finding);
        verdict == RuleVerdict::Fail || only_warns && verdict == RuleVerdict::Warn
    };
    let findings = context.findings(rules);
    let broken = findings
        .iter()
        .filter(|(rule, finding)| fails(*rule, *finding));
    // The cycles per hour are those of the machine: a warning without shock factors. The emergency torque of the gearbox belongs to the required
    // peak torque and to the rotors of the window.
    let elsewhere = [Rule::GearboxCycles, Rule::GearboxEmergency];
    let broken = broken
        .map(|(rule, _)| rule)
        .filter(|rule| !elsewhere.contains(rule));
    broken.collect()
}

/// The ends of the window of rotors.
fn ends(found: &Requirement) -> Vec<f64> {
    let [from, to] = found.rotor;
    let mut ends = vec![from.max(1e-3 * if to.is_finite() { to } else { 1.0 })];
    ends.extend([to].into_iter().filter(|to| to.is_finite()));
    ends
}

#[test]
fn a_motor_just_inside_passes_and_just_outside_fails() {
    let mut moved = 0;
    for (case, ratios) in cases() {
        let kind = input_kind(&case.file);
        for ratio in ratios {
            let found = inquiry(&case).requirement(ratio);
            let gearbox = gearbox(&found);
            let gearbox = gearbox.as_ref();
            for rotor in ends(&found) {
                let motor = Motor {
                    brake: found.smallest_motor(kind, rotor).brake,
                    ..found.smallest_motor(kind, rotor)
                };
                assert_eq!(violated(&case, &motor, gearbox), [], "{ratio:?}: {found:?}");
            }
            // The S1 torque at the end of the window, the peak torque at one of its ends, the speed, the brake, the rotor at both ends.
            let [from, to] = found.rotor;
            let large = found.smallest_motor(kind, *ends(&found).last().unwrap());
            let less = 1.0 - STEP;
            if to.is_finite() {
                let weak = Motor {
                    rated_torque: large.rated_torque.map(|t| t * less),
                    standstill_torque: large.standstill_torque.map(|t| t * less),
                    ..large.clone()
                };
                if found.s1_torque >= found.held_torque {
                    assert_eq!(
                        violated(&case, &weak, gearbox),
                        [Rule::RmsTorque],
                        "{ratio:?}"
                    );
                    let heavy = Motor {
                        rotor_inertia: to * (1.0 + STEP),
                        ..large.clone()
                    };
                    assert!(violated(&case, &heavy, gearbox).contains(&Rule::RmsTorque));
                    moved += 1;
                }
            }
            let slow = Motor {
                max_speed: large.max_speed.map(|n| n * less),
                ..large.clone()
            };
            assert!(
                violated(&case, &slow, gearbox).contains(&Rule::Speed),
                "{ratio:?}"
            );
            if from > 0.0 && from <= found.smallest_rotor {
                let light = found.smallest_motor(kind, from * less);
                assert_eq!(
                    violated(&case, &light, gearbox),
                    [Rule::InertiaRatio],
                    "{ratio:?}"
                );
                moved += 1;
            }
            if let Some(brake) = large.brake {
                let mut loose = large.clone();
                loose.brake = Some(Brake {
                    torque: brake.torque * less,
                    ..brake
                });
                assert_eq!(
                    violated(&case, &loose, gearbox),
                    [Rule::BrakeTorque],
                    "{ratio:?}"
                );
                moved += 1;
            }
            let drawn = found.peak_torque > found.standstill_torque * (1.0 + STEP);
            if drawn {
                let fails = ends(&found).into_iter().any(|rotor| {
                    let motor = found.smallest_motor(kind, rotor);
                    let weak = Motor {
                        peak_torque: motor.peak_torque.map(|t| t * less),
                        ..motor
                    };
                    violated(&case, &weak, gearbox) == [Rule::PeakTorque]
                });
                assert!(fails, "{ratio:?}: {found:?}");
                moved += 1;
            }
        }
    }
    assert!(moved >= 40, "{moved}");
}

#[test]
fn a_brake_just_inside_bears_its_stop_and_just_outside_does_not() {
    let mut stopped = 0;
    for (case, ratios) in cases() {
        for ratio in ratios {
            let found = inquiry(&case).requirement(ratio);
            let gearbox = gearbox(&found);
            let Some(works) = found.brake_work else {
                continue;
            };
            let kind = input_kind(&case.file);
            for (time, work) in CLOSING_TIMES.into_iter().zip(works) {
                let with = |rotor: f64, work: f64| {
                    let motor = found.smallest_motor(kind, rotor);
                    let brake = motor.brake.map(|brake| Brake {
                        closing_time: Some(time),
                        work: Some(work),
                        ..brake
                    });
                    violated(&case, &Motor { brake, ..motor }, gearbox.as_ref())
                };
                let rotors = ends(&found);
                for rotor in &rotors {
                    assert_eq!(with(*rotor, work), [], "{ratio:?}: {time} s, {work} J");
                }
                let less = work * (1.0 - STEP);
                let fails = |rotor: &f64| with(*rotor, less) == [Rule::BrakeWork];
                assert!(rotors.iter().any(fails), "{ratio:?}: {time} s, {work} J");
                stopped += 1;
            }
        }
    }
    assert!(stopped >= 8, "{stopped}");
}

/// The least peak torque over speed is a limit of a motor that satisfies the rule, and no less than that.
#[test]
fn the_envelope_is_touched_by_the_duty() {
    for (case, ratios) in cases() {
        let kind = input_kind(&case.file);
        for ratio in ratios {
            let found = inquiry(&case).requirement(ratio);
            let gearbox = gearbox(&found);
            let fails = |scale: f64| {
                ends(&found).into_iter().any(|rotor| {
                    let motor = Motor {
                        corner_speed: None,
                        peak_torque: None,
                        peak_curve: found
                            .envelope
                            .iter()
                            .map(|[n, t]| [*n, t * scale])
                            .collect(),
                        ..found.smallest_motor(kind, rotor)
                    };
                    let broken = violated(&case, &motor, gearbox.as_ref());
                    assert!(
                        broken.iter().all(|rule| matches!(
                            rule,
                            Rule::PeakTorque
                                | Rule::RmsTorque
                                | Rule::HoldingTorque
                                | Rule::ConstantTorque
                        )),
                        "{broken:?}"
                    );
                    !broken.is_empty()
                })
            };
            assert!(!fails(1.0), "{ratio:?} {found:?}");
            // Without a window the S1 torque has a reserve, and it may be the limit.
            let drawn = found.peak_torque > found.s1_torque * 1.001;
            assert!(fails(1.0 - TOUCH) || !drawn, "{ratio:?} {found:?}");
            assert!(
                found
                    .envelope
                    .windows(2)
                    .all(|pair| pair[1][1] <= pair[0][1]),
                "{found:?}"
            );
        }
    }
}

/// Random motors around the boundary satisfy the rules exactly if the boundary says so.
#[test]
fn the_boundary_decides_as_the_rules_do() {
    let mut random = ChaCha8Rng::seed_from_u64(38);
    let (mut inside, mut outside) = (0, 0);
    for (case, ratios) in cases() {
        let kind = input_kind(&case.file);
        let inquiry = inquiry(&case);
        for ratio in ratios {
            let found = inquiry.requirement(ratio);
            let gearbox = gearbox(&found);
            let top = *ends(&found).last().unwrap();
            for _ in 0..100 {
                let mut near = || 10f64.powf(random.random_range(-0.3..0.3));
                let rotor = top * near();
                let need = inquiry.needs(ratio, rotor);
                let (s1, peak, speed) = (
                    need.s1_torque * near(),
                    need.peak_torque * near(),
                    found.max_speed * near(),
                );
                let motor = Motor {
                    rated_torque: Some(s1),
                    standstill_torque: Some(s1),
                    rated_speed: Some(speed),
                    max_speed: Some(speed),
                    corner_speed: Some(speed),
                    peak_torque: Some(peak),
                    ..found.smallest_motor(kind, rotor)
                };
                let expected = rotor >= found.smallest_rotor
                    && s1.min(peak) >= need.s1_torque.max(found.held_torque)
                    && peak >= need.peak_torque
                    && speed >= found.max_speed;
                let broken = violated(&case, &motor, gearbox.as_ref());
                let passes = broken.is_empty();
                assert_eq!(passes, expected, "{ratio:?} {motor:?} {broken:?}");
                *if passes { &mut inside } else { &mut outside } += 1;
            }
        }
    }
    assert!(inside > 100 && outside > 100, "{inside} {outside}");
}

#[test]
fn a_gearbox_just_outside_fails() {
    let mut tried = 0;
    for (case, ratios) in cases() {
        for ratio in ratios {
            let found = inquiry(&case).requirement(ratio);
            let Some(exact) = gearbox(&found) else {
                continue;
            };
            let less = 1.0 - STEP;
            let weaker: [(Rule, Gearbox); 8] = [
                (
                    Rule::GearboxPeak,
                    Gearbox {
                        peak_torque: exact.peak_torque.map(|x| x * less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::GearboxCubicMean,
                    Gearbox {
                        rated_torque: exact.rated_torque.map(|x| x * less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::GearboxMeanSpeed,
                    Gearbox {
                        rated_speed: exact.rated_speed.map(|x| x * less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::GearboxSpeed,
                    Gearbox {
                        max_speed: exact.max_speed.map(|x| x * less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::NaturalFrequency,
                    Gearbox {
                        stiffness: exact.stiffness.map(|x| x * less * less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::Backlash,
                    Gearbox {
                        backlash: exact.backlash.map(|x| x / less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::GearboxRadial,
                    Gearbox {
                        max_radial_load: exact.max_radial_load.map(|x| x * less),
                        ..exact.clone()
                    },
                ),
                (
                    Rule::GearboxAxial,
                    Gearbox {
                        max_axial_load: exact.max_axial_load.map(|x| x * less),
                        ..exact.clone()
                    },
                ),
            ];
            for (rule, gearbox) in weaker {
                if !case.file.rules.limit(rule).is_set()
                    || rule == Rule::Backlash && case.file.site.tool.is_none()
                    || rule == Rule::GearboxRadial && exact.max_radial_load.is_none()
                    || rule == Rule::GearboxAxial && exact.max_axial_load.is_none()
                {
                    continue;
                }
                let rotor = ends(&found)[0];
                let motor = found.smallest_motor(MotorKind::Rotary, rotor);
                assert_eq!(
                    violated(&case, &motor, Some(&gearbox)),
                    [rule],
                    "{ratio:?} {found:?}"
                );
                tried += 1;
            }
        }
    }
    assert!(tried > 60, "{tried}");
}

/// The mean square as a polynomial of the rotor, and the energy that flows back, against sums over the samples.
#[test]
fn figures_by_plain_sums() {
    for (case, ratios) in cases() {
        let inquiry = inquiry(&case);
        for ratio in ratios {
            let found = inquiry.requirement(ratio);
            let gearbox = gearbox(&found);
            let [constant, linear, square] = found.mean_square;
            for rotor in ends(&found) {
                let motor = found.smallest_motor(input_kind(&case.file), rotor);
                let drive = Drive {
                    motor: &motor,
                    gearbox: gearbox.as_ref(),
                    amplifier: None,
                };
                let duty = case.cycle.motor_duty(&drive);
                let rms = (constant + linear * rotor + square * rotor * rotor).sqrt();
                assert!((rms / duty.torque.rms - 1.0).abs() < 1e-7, "{rms} {duty:?}");
                assert!(found.regeneration.energy >= duty.regenerative_energy * (1.0 - 1e-12));
                assert!(found.regeneration.motoring_peak >= duty.power.max * 0.99);
            }
            let back = found.regeneration;
            assert!(back.pulse <= back.energy * (1.0 + 1e-3) + 1e-9, "{back:?}");
            assert!(back.mean <= back.peak, "{back:?}");
        }
    }
}

/// The brake resistor takes the stop by the drive: its share of the peak torque at the largest speed.
#[test]
fn the_resistor_takes_a_stop_by_the_drive() {
    const SUPPLY: &str = "\n[supply]\nmains_voltage = \"400 V\"\nchopper_voltage = \"760 V\"\nmax_voltage = \"800 V\"\n";
    let text = |duty: &str| format!("{CONVEYOR}{SUPPLY}{duty}");
    let [without, with] = ["", "[duty]\ndrive_stop = \"80 %\"\n"].map(|duty| {
        let case = case(&text(duty), 500);
        let found = inquiry(&case).requirement(Some(10.0));
        let power = 0.8 * found.peak_torque * case.cycle.peak_speed() * 10.0;
        let needed = found.regeneration.resistor.map_or(0.0, |need| need.peak);
        (needed, power)
    });
    assert!(without.0 < 0.5 * without.1, "{without:?}");
    assert!((with.0 / with.1 - 1.0).abs() < 1e-9, "{with:?}");
}

/// A share of the peak torque that does not hold the load stops nothing: the resistor takes the cycle alone.
#[test]
fn a_drive_that_cannot_stop_the_load_is_told() {
    const SUPPLY: &str = "\n[supply]\nmains_voltage = \"400 V\"\nchopper_voltage = \"760 V\"\nmax_voltage = \"800 V\"\n";
    let back = |duty: &str| {
        let case = case(
            &format!(
                "{}{SUPPLY}{duty}",
                HOIST.split("[supply]").next().unwrap_or_default()
            ),
            500,
        );
        inquiry(&case).requirement(Some(10.0)).regeneration
    };
    let [none, weak, strong] = [
        "",
        "[duty]\ndrive_stop = \"2 %\"\n",
        "[duty]\ndrive_stop = \"90 %\"\n",
    ]
    .map(back);
    assert_eq!(
        (none.stops, weak.stops, strong.stops),
        (None, Some(false), Some(true))
    );
    assert!(none.resistor.is_some());
    assert_eq!(weak.resistor, none.resistor);
    assert!(strong.resistor.map(|need| need.peak) > none.resistor.map(|need| need.peak));
    // The pulse is that of the cycle.
    assert_eq!([weak.pulse, strong.pulse], [none.pulse; 2]);
}
