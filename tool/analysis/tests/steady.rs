//! Steady cycles and flywheels against closed forms, simulations and a search by hand.

mod flywheel;
mod process;
mod refusals;
mod simulated;
mod together;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred_analysis::steady::{Start, Steady, SteadyError, SteadyRequest, steady};
use jred_file::model::machine::MachineFile;

use crate::reading::{parse, parse_in, rendered};
use crate::support::{Folder, budget, near, within};

/// The steady motion of a machine text, or the reason that it has none.
pub(crate) fn try_of(text: &str, delta: Option<f64>) -> Result<Steady, SteadyError> {
    of_file(
        &parse(text).unwrap_or_else(|report| panic!("{}", rendered(&report))),
        delta,
    )
}

fn of_file(file: &MachineFile, delta: Option<f64>) -> Result<Steady, SteadyError> {
    let request = SteadyRequest {
        delta,
        ..SteadyRequest::default()
    };
    steady(file, file.simulation.as_ref().unwrap(), &request)
}

#[track_caller]
fn of(text: &str) -> Steady {
    checked(try_of(text, None))
}

/// Properties of every steady cycle.
#[track_caller]
fn checked(found: Result<Steady, SteadyError>) -> Steady {
    checked_to(budget::STEADY_RESIDUAL, found)
}

#[track_caller]
fn checked_to(residual: f64, found: Result<Steady, SteadyError>) -> Steady {
    let found = found.unwrap();
    let own = found.cycle.as_ref();
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

/// A rotor on the drive link whose centre of mass, 20 kg, is 100 mm beside its axle.
fn unbalanced_rotor(inertia: &str, loads: &str, motor: &str) -> String {
    format!(
        "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"axle\"\n\
         body = [{{ name = \"rotor\", mass = \"20 kg\", inertia = \"{inertia}\", com = [\"100 mm\", \"0 mm\"], angle = \"0 deg\" }}]\n\
         joint = [{{ name = \"axle\", between = [\"ground\", \"rotor\"] }}]\n{loads}\n\
         [simulation]\nstart_angle = \"-90 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\n{motor}"
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
        let energy = figures.energy;
        let [motor, process, losses] = [energy.motor, energy.process, energy.losses];
        near("motor", motor, 3.0 * TAU, tight);
        near("process", process, -way * TAU, tight);
        near("losses", losses, drag * TAU, tight);
    }
}

/// Without load and losses a motor comes to the speed at which its torque changes sign, which is one of those looked at.
#[test]
fn a_motor_without_load_turns_at_no_load_speed() {
    let omega = 1000.0 * jred_file::units::RPM;
    for motor in [
        "induction_motor = { synchronous_speed = \"1000 rpm\", breakdown_torque = \"57 N m\", breakdown_slip = \"24 %\" }",
        "dc_motor = { no_load_speed = \"1000 rpm\", stall_torque = \"50 N m\" }",
        "torque_speed = [[\"0 rpm\", \"50 N m\"], [\"1000 rpm\", \"0 N m\"], [\"1100 rpm\", \"-50 N m\"]]",
    ] {
        let figures = of(&rotor("", motor)).cycle.unwrap().figures;
        near("speed", figures.mean_speed, omega, budget::STEADY);
        within("work", figures.energy.motor, 0.0, 1e-9);
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
    let found = figures.motor_torque;
    let found = [found.mean, found.rms, found.peak];
    for (what, value) in ["mean", "RMS", "peak"].iter().zip(found) {
        near(what, value, torque, tight);
    }
    near("power", figures.motor_power.mean, torque * omega, tight);
    near("work", figures.energy.motor, torque * TAU, tight);
    near("losses", figures.energy.losses, torque * TAU, tight);
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
    near(
        "begin",
        figures.speed_at_start_of_turn,
        omega * (1.0 + share),
        tight,
    );
    near("fastest", figures.max_speed, omega * (1.0 + share), tight);
    near("slowest", figures.min_speed, omega * (1.0 - share), tight);
    within("its place", figures.min_speed_at, TAU / 2.0, 1e-6);
    // ∫dφ/(1 + ε·cos φ) = 2π/√(1 − ε²)
    let root = (1.0 - share * share).sqrt();
    near("mean", figures.mean_speed, omega * root, tight);
    near("delta", figures.delta, 2.0 * share / root, tight);
    near("of extremes", figures.delta_of_extremes, 2.0 * share, tight);
    let mean = stall * (1.0 - omega * root / no_load);
    near("mean torque", figures.motor_torque.mean, mean, tight);
    // The mean of ω² over the time is Ω²·√(1 − ε²).
    let square = stall
        * stall
        * (1.0 - 2.0 * omega * root / no_load + omega * omega * root / (no_load * no_load));
    near("RMS", figures.motor_torque.rms, square.sqrt(), tight);
    let peak = stall * (1.0 - omega * (1.0 - share) / no_load);
    near("peak", figures.motor_torque.peak, peak, tight);
    // ∮T dφ = 2π·T(Ω)
    let work = TAU * stall * (1.0 - omega / no_load);
    near("work", figures.energy.motor, work, tight);
    // The largest power of a line is at half of its no-load speed, which the motion passes.
    near(
        "power",
        figures.motor_power.peak,
        stall * no_load / 4.0,
        tight,
    );
}

/// Without friction, the mean of the motor torque over the *angle* is zero, so that the mean of ω over the angle is the no-load
/// speed, however unbalanced the rotor is.
#[test]
fn an_unbalanced_rotor_turns_at_no_load_speed() {
    let text = &unbalanced_rotor(
        "0.5 kg m^2",
        "",
        "at = \"crank\"\n\
        dc_motor = { no_load_speed = \"20 rad/s\", stall_torque = \"30 N m\" }",
    );
    let found = of(text);
    let cycle = found.cycle.unwrap();
    let figures = cycle.figures;
    // ∮T dφ = 30·(2π − ∮ω dφ/20) = 0
    within(
        "work",
        figures.energy.motor,
        0.0,
        budget::STEADY * 30.0 * TAU,
    );
    // J = 0.5 + 20·0.1²; E + U is nearly constant: ω² swings by 4·m·g·r/J about its mean.
    let j = 0.5 + 20.0 * 0.01;
    let swing = figures.max_speed.powi(2) - figures.min_speed.powi(2);
    near("swing", swing, 4.0 * 20.0 * 9.81 * 0.1 / j, 0.02);
    assert!(
        figures.delta > 0.13 && figures.delta < 0.15,
        "{}",
        figures.delta
    );
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
    near(
        "power",
        figures.motor_power.mean,
        9.0 * 0.25 * 45.0,
        budget::STEADY,
    );
}
