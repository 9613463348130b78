//! Belts, screws and pinions: their forces from sums of masses, weight and friction; the limits from statics and from a maker's rounded formulas.

use std::f64::consts::{PI, TAU};

use jred_file::model::drive_element::{BeltForm, ScrewEnds, ScrewShaft};
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::schedule::ScheduleInstant;
use jred_report::list::rule_words::note;

use super::{Stand, edited, near, rows};

/// Largest acceleration and speed of the law 3-4-5 over a unit move in a unit of time.
const ACCELERATION: f64 = 5.773_502_691_896_258;
const SPEED: f64 = 1.875;

/// Peaks between the instants of a duty.
const PEAK: f64 = 1e-7;

const BELT_AXIS: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "belt-axis"
pulley = { diameter = "60 mm", inertia = "4 kg cm^2" }
idler = [{ inertia = "3 kg cm^2", diameter = "40 mm" }]
belt_mass = "0.8 kg"
carriage = { mass = "20 kg", friction = 0.05 }
stroke = ["0 mm", "900 mm"]
pretension = "400 N"
max_tension = "2 kN"
max_effective_force = "900 N"
[[load]]
on = "pulley"
opposing_moment = "0.7 N m"
[motion]
type = "cycle"
of = { point = "carriage", along = "x" }
[[motion.segment]]
law = "polynomial-345"
move = "800 mm"
duration = "0.5 s"
[[motion.segment]]
law = "polynomial-345"
move = "-800 mm"
duration = "0.9 s"
"#;

/// The friction of the pulley does not go through the belt; belt and idler do.
#[test]
fn a_belt_moves_carriage_belt_and_idler() {
    let mut stand = Stand::new(BELT_AXIS);
    let a = ACCELERATION * 0.8 / 0.25;
    let moved = 20.0 + 0.8 + 3e-4 / (0.02 * 0.02);
    let force = moved * a + 0.05 * 20.0 * 9.81;
    let found = |stand: &Stand, rule| stand.found(true, rule);
    near(
        "effective",
        found(&stand, Rule::BeltForce).value,
        force,
        PEAK,
    );
    let tension = found(&stand, Rule::BeltTension);
    near("tension", tension.value, 400.0 + force, PEAK);
    assert_eq!(tension.rating, 2000.0);
    let slack = found(&stand, Rule::BeltPretension);
    near("slack", slack.value, force, PEAK);
    assert_eq!(slack.rating, 400.0);
    // A motor alone needs no shaft of a gearbox, but the same belt.
    assert!(
        stand
            .finding(false, &stand.file.rules, Rule::GearboxRadial)
            .is_none()
    );
    near(
        "direct",
        stand.found(false, Rule::BeltForce).value,
        force,
        PEAK,
    );
    // Both strands pull at the gearbox; the belt has no axial force.
    stand.gearbox.max_radial_load = Some(1000.0);
    let radial = found(&stand, Rule::GearboxRadial);
    near("pull", radial.value, 800.0 + force, PEAK);
    assert_eq!(radial.rating, 1000.0);
    assert!(
        stand
            .finding(true, &stand.file.rules, Rule::GearboxAxial)
            .is_none()
    );
    let check = stand.check(true, &stand.file.rules, Rule::GearboxRadial);
    assert!(
        note(&check).ends_with("output shaft bears, from the belt of the mechanism"),
        "{}",
        note(&check)
    );
    stand.gearbox.max_radial_load = None;
    let check = stand.check(true, &stand.file.rules, Rule::GearboxRadial);
    assert_eq!(check.verdict, RuleVerdict::NotChecked);
    assert!(note(&check).starts_with("no data: radial load that the output shaft bears"));
    // Without the pretension nobody knows the pull.
    let text = edited(
        BELT_AXIS,
        "pretension = \"400 N\"\nmax_tension = \"2 kN\"\n",
        "",
    );
    let mut unknown = Stand::new(&text);
    unknown.gearbox.max_radial_load = Some(1000.0);
    let check = unknown.check(true, &unknown.file.rules, Rule::GearboxRadial);
    assert_eq!(check.verdict, RuleVerdict::NotChecked);
    assert!(
        note(&check).contains("pretension of the belt"),
        "{}",
        note(&check)
    );
}

/// The strands of a belt of constant length: springs EA/l, the load at a place of one of them, or spread over it.
#[test]
fn strands_share_the_force_by_their_stretch() {
    let (pretension, force, length) = (400.0, 300.0, 2.0);
    // Mean force of a strand with `load` at its end beyond the share `at`, so that both stretch as under the pretension alone.
    let tight = |stretched: &dyn Fn(f64) -> f64| {
        let (mut low, mut high) = (0.0, 2.0 * (pretension + force));
        for _ in 0..100 {
            let middle = f64::midpoint(low, high);
            if stretched(middle) > pretension * length {
                high = middle;
            } else {
                low = middle;
            }
        }
        low
    };
    for form in [BeltForm::Pulleys, BeltForm::Carriage, BeltForm::Carrying] {
        let [most, least] = match form {
            BeltForm::Pulleys => {
                let tight = tight(&|t| 0.5 * length * (t + t - force));
                [tight, tight - force]
            }
            BeltForm::Carriage => {
                let at = |a: f64| tight(&|t| a * length * t + (1.0 - a) * length * (t - force));
                [at(0.0), at(1.0) - force]
            }
            BeltForm::Carrying => {
                let carrying = |t: f64| {
                    (0..1000)
                        .map(|k| t - force * (f64::from(k) + 0.5) / 1e3)
                        .sum::<f64>()
                        / 1e3
                };
                let tight = tight(&|t| 0.5 * length * (carrying(t) + t - force));
                [tight, tight - force]
            }
        };
        let [above, below, _] = form.shares();
        near("tight", pretension + above * force, most, 1e-9);
        near("slack", pretension - below * force, least, 1e-9);
    }
}

/// A slack strand leaves all of the force to the other one.
#[test]
fn no_strand_pushes() {
    let mut stand = Stand::new(&edited(
        TABLE,
        "\"350 N\"",
        "\"50 N\"\nmax_tension = \"900 N\"",
    ));
    let force = stand.found(true, Rule::BeltForce).value;
    assert!(force > 200.0, "{force}");
    let of = |stand: &Stand, rule| stand.found(true, rule).value;
    near("tension", of(&stand, Rule::BeltTension), force, PEAK);
    let belt = &stand.file.drive_elements[0];
    assert_eq!(belt.pull(force), Some([force, 0.0]));
    stand.gearbox.max_radial_load = Some(1.0);
    assert!(
        stand
            .finding(true, &stand.file.rules, Rule::GearboxRadial)
            .is_none()
    );
}

/// A limit just inside and just outside.
#[test]
fn a_force_equal_to_its_limit_is_allowed() {
    let exact = Stand::new(BELT_AXIS);
    let of = |rule| exact.found(true, rule).value;
    let (tension, force) = (of(Rule::BeltTension), of(Rule::BeltForce));
    for (rule, from, limit) in [
        (Rule::BeltTension, "max_tension = \"2 kN\"", tension),
        (Rule::BeltForce, "max_effective_force = \"900 N\"", force),
    ] {
        let key = from.split(' ').next().unwrap();
        for (by, verdict) in [(1e-8, RuleVerdict::Pass), (-1e-8, RuleVerdict::Fail)] {
            let to = format!("{key} = \"{} N\"", limit * (1.0 + by));
            let stand = Stand::new(&edited(BELT_AXIS, from, &to));
            assert_eq!(stand.check(true, &stand.file.rules, rule).verdict, verdict);
        }
    }
    // The gearbox alone, too: its shaft bears a newton less.
    let mut stand = Stand::new(BELT_AXIS);
    for (by, verdict) in [(1e-8, RuleVerdict::Pass), (-1e-8, RuleVerdict::Fail)] {
        let most = (800.0 + force) * (1.0 + by);
        stand.gearbox.max_radial_load = Some(most);
        let check = stand.check(true, &stand.file.rules, Rule::GearboxRadial);
        assert_eq!(check.verdict, verdict);
    }
    // A slack strand is a warning.
    let text = edited(BELT_AXIS, "\"400 N\"", "\"100 N\"");
    let stand = Stand::new(&text);
    let check = stand.check(true, &stand.file.rules, Rule::BeltPretension);
    assert_eq!(check.verdict, RuleVerdict::Warn);
}

const TABLE: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { inertia = "0.9 kg m^2" }
[[load]]
on = "table"
opposing_moment = "12 N m"
[[drive_train]]
type = "gear-train"
stage = [{ driver = { teeth = 20, inertia = "1 kg cm^2" }, driven = { teeth = 50, inertia = "9 kg cm^2" }, efficiency = "96 %" }]
[[drive_train]]
type = "belt"
driver = { radius = "40 mm", inertia = "6 kg cm^2" }
driven = { radius = "120 mm", inertia = "0.03 kg m^2" }
belt_mass = "0.6 kg"
efficiency = "95 %"
pretension = "350 N"
max_effective_force = "900 N"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "180 deg"
duration = "0.6 s"
[[motion.segment]]
dwell = "0.3 s"
"#;

/// The driving pulley has the losses of the belt where power flows to the table.
#[test]
fn a_belt_of_the_drive_train_has_its_losses() {
    let stand = Stand::new(TABLE);
    let alpha = ACCELERATION * PI / 0.36;
    let force = (0.93 * alpha + 12.0) / 0.12 / 0.95 + 0.6 * alpha * 0.12;
    near(
        "force",
        stand.found(true, Rule::BeltForce).value,
        force,
        PEAK,
    );
    // The gears stand between gearbox and belt.
    let radial = stand.finding(true, &stand.file.rules, Rule::GearboxRadial);
    assert!(radial.is_none());
    let check = stand.check(true, &stand.file.rules, Rule::BeltForce);
    let words = "allowed effective force of the belt of the drive train (stage 2)";
    assert!(note(&check).contains(words), "{}", note(&check));
    // Backwards the loss is behind the driven pulley's teeth: a brake of the table.
    let text = edited(TABLE, "opposing_moment = \"12 N m\"", "moment = \"40 N m\"");
    let driven = Stand::new(&text);
    let back = (0.93 * alpha + 40.0) / 0.12 + 0.6 * alpha * 0.12;
    near(
        "back",
        driven.found(true, Rule::BeltForce).value,
        back,
        PEAK,
    );
}

const SCREW: &str = r#"
gravity = { inclination = "90 deg", acceleration = "9.81 m/s^2" }
[mechanism]
type = "ball-screw"
lead = "10 mm"
flywheel = "2 kg cm^2"
screw = { inertia = "3.8 kg cm^2" }
nut = { mass = "62 kg" }
stroke = ["-10 mm", "900 mm"]
root_diameter = "21.9 mm"
free_length = "1000 mm"
ends = "fixed-supported"
max_force = "6 kN"
[[load]]
on = "nut"
opposing_force = "60 N"
[[load]]
on = "screw"
opposing_moment = "0.25 N m"
[[load]]
on = "screw"
viscous_moment = "0.004 N m s/rad"
[[spring]]
between = ["screw", "ground"]
stiffness = "0.001 N m/rad"
free_angle = "0 deg"
[motion]
type = "cycle"
of = { point = "nut", along = "x" }
[[motion.segment]]
law = "polynomial-345"
move = "400 mm"
duration = "0.8 s"
[[motion.segment]]
law = "polynomial-345"
move = "-400 mm"
duration = "1 s"
"#;

/// Friction, spring and flywheel of the screw itself put no force on its thread.
#[test]
fn a_screw_lifts_its_nut() {
    let stand = Stand::new(SCREW);
    let force = 62.0 * (9.81 + ACCELERATION * 0.4 / 0.64) + 60.0;
    let found = stand.found(true, Rule::ScrewForce);
    near("force", found.value, force, PEAK);
    assert_eq!(found.rating, 6000.0);
    near(
        "buckling",
        stand.found(true, Rule::ScrewBuckling).value,
        force,
        PEAK,
    );
    let speed = stand.found(true, Rule::ScrewSpeed);
    near("speed", speed.value, SPEED * 0.4 / 0.8 * TAU / 0.01, PEAK);
    let check = stand.check(true, &stand.file.rules, Rule::ScrewSpeed);
    assert_eq!(check.unit, "rpm");
    // A screw is coupled: it does not pull at the gearbox.
    for rule in [Rule::GearboxRadial, Rule::GearboxAxial] {
        assert!(stand.finding(true, &stand.file.rules, rule).is_none());
    }
}

/// Euler's and the bending oscillation's closed forms for hinged ends, the others against a maker's rounded factors (THK, ball screws: force in N and
/// speed in rpm from mm, with safety 0.5 and 0.8, steel of 206 GPa).
#[test]
fn a_screw_buckles_and_whirls_as_the_maker_says() {
    let shaft = |ends| ScrewShaft {
        root_diameter: 0.0219,
        free_length: 0.96,
        ends,
    };
    let [d, length] = [0.0219f64, 0.96f64];
    let (area, second) = (PI * d * d / 4.0, PI * d.powi(4) / 64.0);
    let hinged = shaft(ScrewEnds::SupportedSupported);
    let euler = PI * PI * 206e9 * second / (length * length);
    near("Euler", hinged.buckling_force(), euler, 1e-12);
    let whirl = (PI / length).powi(2) * (206e9 * second / (7850.0 * area)).sqrt();
    near("whirl", hinged.critical_speed(), whirl, 1e-12);
    for (ends, force, speed) in [
        (ScrewEnds::FixedFixed, 20.0, 21.9),
        (ScrewEnds::FixedSupported, 10.0, 15.1),
        (ScrewEnds::SupportedSupported, 5.0, 9.7),
        (ScrewEnds::FixedFree, 1.3, 3.4),
    ] {
        let shaft = shaft(ends);
        let (d, length) = (21.9f64, 960.0f64);
        let force = force * d.powi(4) / (length * length) * 1e4;
        near("force", 0.5 * shaft.buckling_force(), force, 0.05);
        let speed = speed * d / (length * length) * 1e7;
        near(
            "speed",
            0.8 * shaft.critical_speed() * 30.0 / PI,
            speed,
            0.015,
        );
    }
}

/// A screw in the drive train: its force is that of d'Alembert's principle on the links.
#[test]
fn the_screw_of_a_cylinder_has_the_force_of_the_links() {
    let text = include_str!("../../../../machines/excavator-bucket.toml");
    let limits = "lead = \"10 mm\"\nroot_diameter = \"16 mm\"\nfree_length = \"400 mm\"\nends = \"fixed-free\"\nmax_force = \"20 kN\"\nmass = \"1.5 kg\"\n";
    let stand = Stand::new(&edited(text, "lead = \"10 mm\"\n", limits));
    let file = &stand.file;
    let (mut force, mut speed) = (0.0f64, 0.0f64);
    for instant in &stand.duty.instants {
        let now = ScheduleInstant::of(instant.t, instant.omega);
        let machine = file.machine_at(&now, instant.phi).unwrap();
        let forces = machine.forces(instant.phi, instant.omega, instant.alpha);
        let drive = forces.unwrap().drive + 1.5 * instant.alpha;
        force = force.max(drive.abs());
        speed = speed.max(instant.omega.abs());
    }
    near(
        "force",
        stand.found(true, Rule::ScrewForce).value,
        force,
        1e-9,
    );
    let turning = stand.found(true, Rule::ScrewSpeed).value;
    near("speed", turning, speed * TAU / 0.01, 1e-9);
}

const RACK: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "rack-and-pinion"
pinion = { radius = "30 mm", mass = "1.1 kg", inertia = "5.2 kg cm^2" }
rack = { mass = "85 kg" }
max_force = "5 kN"
helix_angle = "19.5 deg"
[[load]]
on = "rack"
opposing_force = "110 N"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "1000 deg"
duration = "0.6 s"
[[motion.segment]]
dwell = "0.6 s"
"#;

/// Tangential, radial and axial force of a helical pinion as components of one normal force of the tooth.
#[test]
fn a_pinion_pushes_at_the_gearbox() {
    let mut stand = Stand::new(RACK);
    let force = 85.0 * ACCELERATION * 1000f64.to_radians() / 0.36 * 0.03 + 110.0;
    near(
        "force",
        stand.found(true, Rule::PinionForce).value,
        force,
        PEAK,
    );
    stand.gearbox.max_radial_load = Some(1500.0);
    stand.gearbox.max_axial_load = Some(700.0);
    // The normal force N: along the tooth's normal, F_t = N·cos α·cos β, F_a = N·cos α·sin β, F_r = N·sin α.
    let (a, b) = (20f64.to_radians(), 19.5f64.to_radians());
    let normal = force / (a.cos() * b.cos());
    let [radial, axial] = [Rule::GearboxRadial, Rule::GearboxAxial].map(|r| stand.found(true, r));
    near("radial", radial.value, force.hypot(normal * a.sin()), PEAK);
    near("axial", axial.value, normal * a.cos() * b.sin(), PEAK);
    assert_eq!((radial.rating, axial.rating), (1500.0, 700.0));
}

/// Without a limit there is no rule of an element, but the shaft of the gearbox bears its pull.
#[test]
fn an_element_without_limits_only_pulls() {
    let mut stand = Stand::press();
    stand.gearbox.max_radial_load = Some(2500.0);
    for rule in [Rule::BeltForce, Rule::BeltTension] {
        assert!(stand.finding(true, &stand.file.rules, rule).is_none());
    }
    let radial = stand.found(true, Rule::GearboxRadial);
    assert_eq!((radial.value, radial.rating), (2000.0, 2500.0));
    let with = Stand::new(RACK).found(true, Rule::GearboxRadial).value;
    let bare = Stand::new(&edited(RACK, "max_force = \"5 kN\"\n", ""));
    near(
        "of a rack",
        bare.found(true, Rule::GearboxRadial).value,
        with,
        PEAK,
    );
}

/// Of two belts the one with the larger share of its limit counts.
#[test]
fn the_weaker_of_two_belts_counts() {
    let first = "type = \"belt\"\npretension = \"200 N\"\nmax_effective_force = \"80 N\"\n\
        driver = { radius = \"30 mm\", inertia = \"0 kg m^2\" }\ndriven = { radius = \"75 mm\", inertia = \"0 kg m^2\" }\n[motion]";
    let at = TABLE
        .find("[[drive_train]]\ntype = \"gear-train\"")
        .unwrap();
    let end = TABLE.find("[[drive_train]]\ntype = \"belt\"").unwrap();
    let belts = format!(
        "{}[[drive_train]]\n{}{}",
        &TABLE[..at],
        first.replace("[motion]", ""),
        &TABLE[end..]
    );
    let stand = Stand::new(&belts);
    let found = stand.found(true, Rule::BeltForce);
    let alpha = ACCELERATION * PI / 0.36;
    let second = (0.93 * alpha + 12.0) / 0.12 / 0.95 + 0.6 * alpha * 0.12;
    // The first belt gives on the force of the second, at the other radius, and turns its pulley.
    let force = (second * 0.04 + 6e-4 * 3.0 * alpha) / 0.075;
    near("force", found.value, force, PEAK);
    assert_eq!(found.rating, 80.0);
    let note = note(&stand.check(true, &stand.file.rules, Rule::BeltForce));
    assert!(note.contains("stage 1"), "{note}");
    assert!(
        stand
            .finding(true, &stand.file.rules, Rule::GearboxRadial)
            .is_some()
    );
}

/// Units, and the references of the notes.
#[test]
fn notes_name_their_limit() {
    let cases = "
        BELT => BeltTension => N => allowed force of the belt of the mechanism
        BELT => BeltForce => N => allowed effective force of the belt of the mechanism
        BELT => BeltPretension => N => pretension of the belt of the mechanism
        SCREW => ScrewForce => N => allowed axial force of the screw of the mechanism
        SCREW => ScrewBuckling => N => 50 % of
        SCREW => ScrewBuckling => N => buckling force (Euler) of the screw
        SCREW => ScrewSpeed => rpm => critical speed of the screw
        RACK => PinionForce => N => allowed tangential force of the pinion
    ";
    let stands = [("BELT", BELT_AXIS), ("SCREW", SCREW), ("RACK", RACK)];
    let stands = stands.map(|(name, text)| (name, Stand::new(text)));
    for [machine, rule, unit, words] in rows(cases) {
        let (_, stand) = stands.iter().find(|(name, _)| *name == machine).unwrap();
        let rule = Rule::ALL.into_iter().find(|r| format!("{r:?}") == rule);
        let check = stand.check(true, &stand.file.rules, rule.unwrap());
        assert_eq!(check.unit, unit);
        assert!(note(&check).contains(&words), "{}", note(&check));
    }
}
