//! Steady cycles and flywheels against closed forms, simulations and a search by hand.

mod refusals;
mod together;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred_machine::analysis::steady::{Request, Start, Steady, SteadyError, steady};
use jred_machine::model::machine::MachineFile;

use crate::reading::{parse, parse_in, rendered};
use crate::simulate::simulate;
use crate::support::{Folder, budget, edited, near, press_text, within};

/// The steady motion of a machine text, or why there is none.
pub(crate) fn try_of(text: &str, delta: Option<f64>) -> Result<Steady, SteadyError> {
    of_file(
        &parse(text).unwrap_or_else(|report| panic!("{}", rendered(&report))),
        delta,
    )
}

fn of_file(file: &MachineFile, delta: Option<f64>) -> Result<Steady, SteadyError> {
    let request = Request {
        delta,
        positions: 36,
    };
    steady(file, file.simulation.as_ref().unwrap(), &request)
}

#[track_caller]
fn of(text: &str) -> Steady {
    checked(try_of(text, None))
}

/// What holds for every steady cycle.
#[track_caller]
fn checked(found: Result<Steady, SteadyError>) -> Steady {
    checked_to(budget::STEADY_RESIDUAL, found)
}

#[track_caller]
fn checked_to(residual: f64, found: Result<Steady, SteadyError>) -> Steady {
    let found = found.unwrap_or_else(|error| panic!("{}", rendered(&error.into())));
    let own = found.cycle.as_ref().ok();
    for cycle in own
        .into_iter()
        .chain(found.flywheel.as_ref().map(|f| &f.cycle))
    {
        assert!(cycle.residual <= residual, "{:e}", cycle.residual);
        let imbalance = cycle.figures.imbalance;
        assert!(imbalance <= budget::STEADY_BALANCE, "{imbalance:e}");
    }
    found
}

/// A rotor of 0.4 kg m² on the drive link.
pub(crate) fn rotor(loads: &str, simulation: &str) -> String {
    format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"gear-train\"\n[[mechanism.stage]]\n\
         driver = {{ teeth = 20, inertia = \"0.4 kg m^2\" }}\ndriven = {{ teeth = 20, inertia = \"0 kg m^2\" }}\n{loads}\n\
         [simulation]\nstart_angle = \"0 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\n{simulation}"
    )
}

/// A moment that keeps its sign, either way of turning: ±3 N m of the motor and −1 N m of the load against 0.05·ω, 2π of each torque a turn.
#[test]
fn a_moment_resists_one_way_and_drives_the_other() {
    let loads = "[[load]]\non = \"shaft-1\"\nviscous_moment = \"0.05 N m s/rad\"\n\
                 [[load]]\non = \"shaft-1\"\nmoment = \"-1 N m\"";
    let tight = budget::STEADY;
    for (torque, way) in [("3 N m", 1.0), ("-3 N m", -1.0)] {
        let found = of(&rotor(loads, &format!("torque = \"{torque}\"")));
        let figures = found.cycle.unwrap().figures;
        let drag = 3.0 - way;
        near("speed", figures.mean_speed, way * drag / 0.05, tight);
        let [motor, process, losses] = figures.works;
        near("motor", motor, 3.0 * TAU, tight);
        near("process", process, -way * TAU, tight);
        near("losses", losses, drag * TAU, tight);
    }
}

/// Without load and losses a motor comes to the speed at which its torque changes sign, which is one of those looked at.
#[test]
fn a_motor_without_load_turns_at_no_load_speed() {
    let omega = 1000.0 * jred_machine::units::RPM;
    for motor in [
        "induction_motor = { synchronous_speed = \"1000 rpm\", breakdown_torque = \"57 N m\", breakdown_slip = \"24 %\" }",
        "dc_motor = { no_load_speed = \"1000 rpm\", stall_torque = \"50 N m\" }",
        "torque_speed = [[\"0 rpm\", \"50 N m\"], [\"1000 rpm\", \"0 N m\"], [\"1100 rpm\", \"-50 N m\"]]",
    ] {
        let figures = of(&rotor("", motor)).cycle.unwrap().figures;
        near("speed", figures.mean_speed, omega, budget::STEADY);
        within("work", figures.works[0], 0.0, 1e-9);
    }
}

/// A line of torque against viscous and Coulomb friction: one constant speed, reached as an exponential function.
#[test]
fn a_line_against_friction() {
    let loads = "[[load]]\non = \"shaft-1\"\nviscous_moment = \"0.05 N m s/rad\"\n\
                 [[load]]\non = \"shaft-1\"\nopposing_moment = \"1.5 N m\"";
    let motor = "dc_motor = { no_load_speed = \"60 rad/s\", stall_torque = \"9 N m\" }";
    let found = of(&rotor(loads, motor));
    let cycle = found.cycle.unwrap();
    let figures = &cycle.figures;
    // 9·(1 − ω/60) = 0.05·ω + 1.5
    let (slope, omega) = (9.0 / 60.0 + 0.05, (9.0 - 1.5) / (9.0 / 60.0 + 0.05));
    let torque = 9.0 * (1.0 - omega / 60.0);
    let tight = budget::STEADY;
    near("speed", figures.mean_speed, omega, tight);
    near("period", figures.period, TAU / omega, tight);
    within("delta", figures.delta, 0.0, tight);
    for (what, value) in ["mean", "RMS", "peak"].iter().zip(figures.torque) {
        near(what, value, torque, tight);
    }
    near("power", figures.power[0], torque * omega, tight);
    near("work", figures.works[0], torque * TAU, tight);
    near("losses", figures.works[2], torque * TAU, tight);
    // A turn shrinks a deviation by exp(−slope·period/J).
    near(
        "left over",
        cycle.left_over,
        (-slope * figures.period / 0.4).exp(),
        budget::STEADY_LEFT_OVER,
    );
    assert_eq!(cycle.caught_from, None);
    // ω = ω∞·(1 − exp(−t·slope/J)) comes within 1 % at t = ln(100)·J/slope, seen at the next 24th of a turn.
    let expected = 100f64.ln() * 0.4 / slope;
    let Start::Reached { time, turns } = cycle.start else {
        panic!("{:?}", cycle.start);
    };
    assert!(
        (expected..expected + figures.period / 20.0).contains(&time),
        "{time} {expected}"
    );
    let angle = omega * (time - 0.4 / slope * (1.0 - (-time * slope / 0.4).exp()));
    near("turns", turns, angle / TAU, budget::STEADY_START);
}

/// A load made for the motion ω = Ω·(1 + ε·cos φ): torque J·ω·ω′ − T(ω), so that every figure has a closed form.
#[test]
fn a_load_made_for_a_motion() {
    let (omega, share, stall, no_load) = (30.0, 0.2, 12.0, 50.0);
    let folder = Folder::new();
    let mut csv = String::from("Position [deg],Torque [N m]\n");
    for k in 0..=1440 {
        let phi = TAU * f64::from(k) / 1440.0;
        let speed = omega * (1.0 + share * phi.cos());
        let inertial = -0.4 * speed * omega * share * phi.sin();
        let motor = stall * (1.0 - speed / no_load);
        writeln!(csv, "{},{:?}", 0.25 * f64::from(k), inertial - motor).unwrap();
    }
    folder.file("loads.csv", csv);
    let text = rotor(
        "[[load]]\ntable = \"loads.csv\"\non = \"shaft-1\"",
        "dc_motor = { no_load_speed = \"50 rad/s\", stall_torque = \"12 N m\" }",
    );
    let file = parse_in(&text, &folder.path("")).unwrap();
    let found = checked_to(budget::STEADY_RESIDUAL_OF_TABLES, of_file(&file, None));
    let figures = found.cycle.unwrap().figures;
    let tight = budget::STEADY_MADE;
    near("begin", figures.begin, omega * (1.0 + share), tight);
    near("fastest", figures.fastest[0], omega * (1.0 + share), tight);
    near("slowest", figures.slowest[0], omega * (1.0 - share), tight);
    within("its place", figures.slowest[1], TAU / 2.0, 1e-6);
    // ∫dφ/(1 + ε·cos φ) = 2π/√(1 − ε²)
    let root = (1.0 - share * share).sqrt();
    near("mean", figures.mean_speed, omega * root, tight);
    near("delta", figures.delta, 2.0 * share / root, tight);
    near("of extremes", figures.delta_of_extremes, 2.0 * share, tight);
    let mean = stall * (1.0 - omega * root / no_load);
    near("mean torque", figures.torque[0], mean, tight);
    // The mean of ω² over the time is Ω²·√(1 − ε²).
    let square = stall
        * stall
        * (1.0 - 2.0 * omega * root / no_load + omega * omega * root / (no_load * no_load));
    near("RMS", figures.torque[1], square.sqrt(), tight);
    let peak = stall * (1.0 - omega * (1.0 - share) / no_load);
    near("peak", figures.torque[2], peak, tight);
    // ∮T dφ = 2π·T(Ω)
    let work = TAU * stall * (1.0 - omega / no_load);
    near("work", figures.works[0], work, tight);
    // The largest power of a line is at half of its no-load speed, which the motion passes.
    near("power", figures.power[1], stall * no_load / 4.0, tight);
}

/// Without friction, the mean of the motor torque over the *angle* is zero, so that the mean of ω over the angle is the no-load
/// speed, however unbalanced the rotor is.
#[test]
fn an_unbalanced_rotor_turns_at_no_load_speed() {
    let text = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"axle\"\n\
        body = [{ name = \"rotor\", mass = \"20 kg\", inertia = \"0.5 kg m^2\", com = [\"100 mm\", \"0 mm\"], angle = \"0 deg\" }]\n\
        joint = [{ name = \"axle\", between = [\"ground\", \"rotor\"] }]\n\
        [simulation]\nstart_angle = \"-90 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\nat = \"crank\"\n\
        dc_motor = { no_load_speed = \"20 rad/s\", stall_torque = \"30 N m\" }";
    let found = of(text);
    let cycle = found.cycle.unwrap();
    let figures = cycle.figures;
    // ∮T dφ = 30·(2π − ∮ω dφ/20) = 0
    within("work", figures.works[0], 0.0, budget::STEADY * 30.0 * TAU);
    // J = 0.5 + 20·0.1²; E + U is nearly constant: ω² swings by 4·m·g·r/J about its mean.
    let j = 0.5 + 20.0 * 0.01;
    let swing = figures.fastest[0].powi(2) - figures.slowest[0].powi(2);
    near("swing", swing, 4.0 * 20.0 * 9.81 * 0.1 / j, 0.02);
    assert!(
        figures.delta > 0.13 && figures.delta < 0.15,
        "{}",
        figures.delta
    );
}

fn with_start(text: &str, [phi, omega]: [f64; 2], duration: f64, steps: u32) -> String {
    let (before, _) = text.split_once("[simulation]").unwrap();
    let (_, motor) = text.split_once("torque_speed").unwrap();
    format!(
        "{before}[simulation]\nstart_angle = \"{phi:?} rad\"\nstart_speed = \"{omega:?} rad/s\"\nduration = \"{duration:?} s\"\n\
         output_step = \"{:?} s\"\ntolerance = 1e-12\ntorque_speed{motor}",
        duration / f64::from(steps)
    )
}

/// `jred simulate`, over the time and with a method of its own for friction: started on the cycle, it is back after a period; started
/// from rest, it comes to the same cycle.
#[test]
fn simulations_come_to_the_same_cycle() {
    let press = press_text();
    let figures = of(&press).cycle.unwrap().figures;
    let phi = 180f64.to_radians();
    let turn = simulate(&with_start(
        &press,
        [phi, figures.begin],
        figures.period,
        50,
    ));
    let omega = turn.get("omega [rad/s]");
    let tight = budget::STEADY_SIMULATED;
    near("back", *omega.last().unwrap(), figures.begin, tight);
    near(
        "a turn",
        turn.get("phi [deg]")[50] - turn.get("phi [deg]")[0],
        360.0,
        tight,
    );
    near(
        "work",
        turn.get("motor work [J]")[50],
        figures.works[0],
        tight,
    );
    near(
        "losses",
        turn.get("losses [J]")[50],
        figures.works[2],
        tight,
    );
    let torques = turn.get("motor torque [N m]");
    assert!(
        torques
            .iter()
            .all(|t| *t <= figures.torque[2] * (1.0 + tight))
    );

    let long = simulate(&with_start(&press, [phi, 0.0], 20.0, 100));
    let last = long.get("phi [deg]")[100].to_radians().rem_euclid(TAU);
    let there = of(&with_start(&press, [last, 0.0], 1.0, 1)).cycle.unwrap();
    near(
        "from rest",
        long.get("omega [rad/s]")[100],
        there.figures.begin,
        budget::STEADY_FROM_REST,
    );
}

/// The list has equal positions and the end of the turn, wherever the edges of the loads are: here on one of them.
#[test]
fn the_list_has_equal_positions() {
    let course = of(&press_text()).cycle.unwrap().figures.course;
    let at = course
        .names()
        .iter()
        .position(|name| name == "phi [deg]")
        .unwrap();
    assert_eq!(course.rows().len(), 37);
    for (k, row) in course.rows().iter().enumerate() {
        within("phi", row[at].unwrap(), 180.0 + 10.0 * k as f64, 1e-6);
    }
}

/// The time from rest to within 1 %: `simulate` from rest, compared with the cycle at the same angle.
#[test]
fn the_press_starts_in_the_time_that_a_simulation_takes() {
    let press = press_text();
    let cycle = of(&press).cycle.unwrap();
    let Start::Reached { time, turns } = cycle.start else {
        panic!("{:?}", cycle.start);
    };
    let run = simulate(&with_start(&press, [180f64.to_radians(), 0.0], time, 1));
    near("turns", run.get("phi [deg]")[1] / 360.0 - 0.5, turns, 1e-6);
    // There, the speed is within 1 %; a 20th of a turn before it was not, or had not been for a turn.
    let phi = run.get("phi [deg]")[1].to_radians().rem_euclid(TAU);
    let there = of(&with_start(&press, [phi, 0.0], 1.0, 1)).cycle.unwrap();
    let share = run.get("omega [rad/s]")[1] / there.figures.begin;
    assert!((share - 1.0).abs() <= 0.01 + 1e-6, "{share}");
}

/// The flywheel for δ against bisection over files with a flywheel written into them.
#[test]
fn the_flywheel_is_that_of_a_search_by_hand() {
    let press = press_text();
    let wanted = 0.02;
    let found = checked(try_of(&press, Some(wanted)));
    let flywheel = found.flywheel.unwrap();
    near(
        "delta",
        flywheel.cycle.figures.delta,
        wanted,
        budget::STEADY_FLYWHEEL,
    );
    let own = found.cycle.unwrap().figures.delta;
    assert!(own > 2.0 * wanted, "{own}");
    let with = |inertia: f64| {
        edited(
            &press,
            "\"0.05 kg m^2\"",
            &format!("\"{:?} kg m^2\"", 0.05 + inertia),
        )
    };
    let delta = |inertia: f64| of(&with(inertia)).cycle.unwrap().figures.delta;
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if delta(middle) > wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    near("inertia", flywheel.inertia, 0.5 * (low + high), 1e-5);
    // The classical value is of the same size, and not the same.
    let ratio = flywheel.classical.inertia / flywheel.inertia;
    assert!(
        (0.5..2.0).contains(&ratio) && (ratio - 1.0).abs() > 1e-3,
        "{ratio}"
    );
}

/// Each shaft of the press's drive train needs the flywheel that a search by hand finds there: with the losses of a stage in between it is not that on the drive
/// link by the squared ratio, and without losses it is.
#[test]
fn a_flywheel_on_each_shaft() {
    let press = press_text();
    let wanted = 0.02;
    let driver = "driver = { radius = \"40 mm\", inertia = \"0.0006 kg m^2\" }";
    let with = |text: &str, inertia: f64| {
        let there = driver.replace("0.0006", &format!("{:?}", 0.0006 + inertia));
        of(&edited(text, driver, &there)).cycle.unwrap().figures
    };
    let lossless = edited(&press, "efficiency = \"97 %\"", "efficiency = \"100 %\"");
    for (text, by_ratio) in [(&lossless, true), (&press, false)] {
        let found = checked(try_of(text, Some(wanted))).flywheel.unwrap();
        let [motor, link] = found.places.as_slice() else {
            panic!("{:?}", found.places);
        };
        assert_eq!([motor.shaft, link.shaft], [0, 1]);
        let [motor, link] = [motor, link].map(|place| place.wheel.as_ref().unwrap());
        let there = with(text, motor.inertia);
        near("delta", there.delta, wanted, budget::STEADY_FLYWHEEL);
        near("RMS", motor.torque[0], there.torque[1], 1e-9);
        near("losses", motor.losses, there.works[2], 1e-9);
        near("speed", motor.speed, 3.0 * there.mean_speed, 1e-9);
        near(
            "energy",
            motor.stored,
            0.5 * motor.inertia * motor.speed.powi(2),
            1e-12,
        );
        let share = 9.0 * motor.inertia / link.inertia;
        assert_eq!((share - 1.0).abs() < 1e-7, by_ratio, "{share}");
        assert!((share - 1.0).abs() < 0.1, "{share}");
        near("drive link", link.inertia, found.inertia, 1e-15);
        near("motor", found.at_motor().unwrap(), motor.inertia, 1e-15);
        // In front of the belt the flywheel leaves the peaks to it; behind it, it takes them.
        assert!(
            motor.delivered[0] > 2.0 * link.delivered[0],
            "{motor:?} {link:?}"
        );
    }
}

/// Two stages: without losses each shaft needs the same flywheel by its squared ratio, and what a stage delivers is the torque of the motor less what the shafts
/// in front of it take, by the ratio.
#[test]
fn a_flywheel_between_two_stages() {
    let text = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"axle\"\n\
        body = [{ name = \"rotor\", mass = \"20 kg\", inertia = \"0.01 kg m^2\", com = [\"100 mm\", \"0 mm\"], angle = \"0 deg\" }]\n\
        joint = [{ name = \"axle\", between = [\"ground\", \"rotor\"] }]\n\
        [[load]]\non = \"rotor\"\nopposing_moment = \"5 N m\"\n\
        [[drive_train]]\ntype = \"gear-train\"\nstage = [\n\
        { driver = { teeth = 20, inertia = \"0 kg m^2\" }, driven = { teeth = 40, inertia = \"0 kg m^2\" } },\n\
        { driver = { teeth = 20, inertia = \"0 kg m^2\" }, driven = { teeth = 60, inertia = \"0 kg m^2\" } }]\n\
        [simulation]\nstart_angle = \"-90 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\n\
        dc_motor = { no_load_speed = \"240 rad/s\", stall_torque = \"4 N m\" }";
    let flywheel = checked(try_of(text, Some(0.02))).flywheel.unwrap();
    let places = flywheel.places.iter();
    let places: Vec<_> = places.map(|place| place.wheel.as_ref().unwrap()).collect();
    let ratios = [6.0, 3.0, 1.0];
    assert_eq!(places.len(), 3);
    for (place, ratio) in places.iter().zip(ratios) {
        near(
            "inertia",
            place.inertia * ratio * ratio,
            flywheel.inertia,
            1e-7,
        );
        near("stored", place.stored, places[2].stored, 1e-7);
    }
    // On the drive link the motor alone drives both stages, without inertia in between.
    let [_, peak] = places[2].torque;
    near("stage 1", places[2].delivered[0], 2.0 * peak, 1e-4);
    near("stage 2", places[2].delivered[1], 6.0 * peak, 1e-4);
    // Between them, the first stage alone.
    near(
        "stage 1",
        places[1].delivered[0],
        2.0 * places[1].torque[1],
        1e-4,
    );
    assert!(
        places[1].delivered[1] > 1.5 * places[2].delivered[1],
        "{places:?}"
    );
}

/// Where a motor hardly reacts to the speed and δ is small, the classical method is right: the exact inertia approaches it.
#[test]
fn the_classical_flywheel_is_the_limit_of_a_soft_motor() {
    let text = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"axle\"\n\
        body = [{ name = \"rotor\", mass = \"20 kg\", inertia = \"0.01 kg m^2\", com = [\"100 mm\", \"0 mm\"], angle = \"0 deg\" }]\n\
        joint = [{ name = \"axle\", between = [\"ground\", \"rotor\"] }]\n\
        [[load]]\non = \"rotor\"\nopposing_moment = \"5 N m\"\n\
        [simulation]\nstart_angle = \"-90 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\nat = \"crank\"\n\
        dc_motor = { no_load_speed = \"4000 rad/s\", stall_torque = \"5.05 N m\" }";
    let found = checked(try_of(text, Some(0.001)));
    let flywheel = found.flywheel.unwrap();
    // ΔW = 2·m·g·r, ω = 4000·(1 − 5/5.05)
    let classical = flywheel.classical;
    near("work", classical.work, 2.0 * 20.0 * 9.81 * 0.1, 1e-9);
    near("speed", classical.speed, 4000.0 * (1.0 - 5.0 / 5.05), 1e-4);
    near("own", classical.own, 0.01 + 0.2, 1e-12);
    near(
        "inertia",
        flywheel.inertia + classical.own,
        classical.total,
        1e-5,
    );
}

/// So it is behind a drive train with losses: the motor feeds them all the time, and no flywheel stores them.
#[test]
fn losses_of_a_drive_train_are_in_no_flywheel() {
    let text = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"axle\"\n\
        body = [{ name = \"rotor\", mass = \"20 kg\", inertia = \"0.01 kg m^2\", com = [\"100 mm\", \"0 mm\"], angle = \"0 deg\" }]\n\
        joint = [{ name = \"axle\", between = [\"ground\", \"rotor\"] }]\n\
        [[load]]\non = \"rotor\"\nopposing_moment = \"5 N m\"\n\
        [[drive_train]]\ntype = \"belt\"\ndriver = { radius = \"40 mm\", inertia = \"0 kg m^2\" }\n\
        driven = { radius = \"80 mm\", inertia = \"0 kg m^2\" }\nefficiency = \"80 %\"\n\
        [simulation]\nstart_angle = \"-90 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\nat = \"motor\"\n\
        dc_motor = { no_load_speed = \"8000 rad/s\", stall_torque = \"3.15625 N m\" }";
    let flywheel = checked(try_of(text, Some(0.001))).flywheel.unwrap();
    let classical = flywheel.classical;
    near("work", classical.work, 2.0 * 20.0 * 9.81 * 0.1, 1e-9);
    near(
        "speed",
        classical.speed,
        4000.0 * (1.0 - 3.125 / 3.15625),
        1e-4,
    );
    let exact = flywheel.inertia + classical.own;
    near("inertia", exact, classical.total, 1e-4);
    // In front of the belt a flywheel gives and takes its energy through it, each time with losses, which this motor does not cover.
    let why = flywheel.places[0].wheel.as_ref().unwrap_err().to_string();
    assert!(why.contains("the machine stops"), "{why}");
}

/// An induction motor has two speeds at which its torque is that of a constant load: the cycle is the higher one, and the lower one is
/// that from which the machine is caught.
#[test]
fn an_induction_motor_has_two_speeds() {
    let motor = "induction_motor = { synchronous_speed = \"100 rad/s\", breakdown_torque = \"50 N m\", breakdown_slip = \"20 %\" }";
    let load = "[[load]]\non = \"shaft-1\"\nopposing_moment = \"30 N m\"";
    let cycle = of(&rotor(load, motor)).cycle.unwrap();
    // 2·50/(s/0.2 + 0.2/s) = 30: s² − (2·50·0.2/30)·s + 0.04 = 0
    let b: f64 = 100.0 * 0.2 / 30.0;
    let root = (0.25 * b * b - 0.04).sqrt();
    near(
        "speed",
        cycle.figures.mean_speed,
        100.0 * (1.0 - (0.5 * b - root)),
        budget::STEADY,
    );
    near(
        "caught",
        cycle.caught_from.unwrap(),
        100.0 * (1.0 - (0.5 * b + root)),
        1e-5,
    );
    assert!(cycle.left_over < 1.0);
    // From rest it gives 2·50/5.2 = 19.2 N m: it does not start.
    let Start::Stuck { turns, missing } = cycle.start else {
        panic!("{:?}", cycle.start);
    };
    within("turns", turns, 0.0, 0.0);
    near("given", missing.given, 100.0 / 5.2, 1e-12);
    near("needed", missing.needed, 30.0, 1e-12);
}

/// Backwards is the mirror image of forwards.
#[test]
fn a_motor_that_runs_backwards() {
    let loads = "[[load]]\non = \"shaft-1\"\nviscous_moment = \"0.05 N m s/rad\"";
    let motor = "dc_motor = { no_load_speed = \"-60 rad/s\", stall_torque = \"-9 N m\" }";
    let figures = of(&rotor(loads, motor)).cycle.unwrap().figures;
    near("speed", figures.mean_speed, -9.0 / 0.2, budget::STEADY);
    near("power", figures.power[0], 9.0 * 0.25 * 45.0, budget::STEADY);
}
