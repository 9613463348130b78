//! Counterweights and springs against closed forms, against the machine file that contains them, and against random bodies.

use std::path::Path;

use jred::machine::Reducible as _;
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::coordinate::positions;
use jred_file::model::machine::MachineFile;
use jred_motion::balance::{
    BalanceError, BalanceGoal, BalanceRequest, BalanceResult, Counterweight, balance,
};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

const STEPS: usize = 200;

fn machine(text: &str) -> MachineFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    checked::parse("machine.toml", text, &folder).unwrap()
}

fn example(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap()
}

/// A lever of 10 kg whose centre of mass is 0.3 m from its bearing, turned at constant speed; `more` is added to it.
fn lever(range: &str, more: &str) -> MachineFile {
    machine(&format!(
        "title = \"lever\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"bearing\"\n{range}\
         ground = {{ O = [\"0 mm\", \"0 mm\"] }}\n\
         body = [{{ name = \"lever\", mass = \"10 kg\", inertia = \"0.2 kg m^2\", com = [\"300 mm\", \"0 mm\"], angle = \"20 deg\", \
         points = {{ tip = [\"400 mm\", \"0 mm\"] }} }}]\n\
         joint = [{{ name = \"bearing\", between = [\"ground.O\", \"lever\"] }}]\n{more}"
    ))
}

/// m·g·r of the lever (N·m).
const WEIGHT: f64 = 10.0 * 9.81 * 0.3;

fn request(
    goal: BalanceGoal,
    counterweights: &[(usize, f64, f64)],
    springs: &[usize],
) -> BalanceRequest {
    let counterweights = counterweights.iter();
    BalanceRequest {
        goal,
        counterweights: counterweights
            .map(|&(link, most, reach)| Counterweight { link, most, reach })
            .collect(),
        springs: springs.to_vec(),
        sampling: STEPS.into(),
    }
}

/// The result is at the bound: nothing is better by more than 1e-5, or than the roundings of the unbalanced figures. A peak is between the instants;
/// with so few steps it is up to 1e-4 above them.
fn is_optimal(found: &BalanceResult, goal: BalanceGoal) {
    let [before, after] = [found.before, found.after].map(|f| f.of(goal));
    let share = if goal == BalanceGoal::Peak {
        1e-4
    } else {
        1e-5
    };
    assert!(
        found.bound <= after * (1.0 + 1e-9) && after - found.bound <= share * after + 5e-5 * before,
        "{after}, bound {}, before {before}",
        found.bound
    );
}

/// S = −m·r takes all of the weight; of the bodies with that moment, none is lighter than 3 kg·m by 0.5 m.
#[test]
fn a_counterweight_balances_a_lever() {
    let file = lever(
        "",
        "[motion]\ntype = \"constant-speed\"\nspeed = \"15 rpm\"\n",
    );
    for goal in [BalanceGoal::Holding, BalanceGoal::Rms, BalanceGoal::Peak] {
        let found = balance(&file, &request(goal, &[(0, 20.0, 0.5)], &[])).unwrap();
        is_optimal(&found, goal);
        let Some(body) = found.masses[0] else {
            panic!("{goal}: no counterweight");
        };
        let moment = body.at.map(|x| x * body.mass);
        assert!(
            (moment[0] + 3.0).abs() < 1e-4 && moment[1].abs() < 1e-4,
            "{goal}: {moment:?}"
        );
        assert!(
            found.after.holding[1] < 1e-4 * WEIGHT,
            "{goal}: {:?}",
            found.after
        );
        let reach = (body.at[0].hypot(body.at[1]).powi(2) + body.inertia / body.mass).sqrt();
        assert!(
            body.mass <= 20.0 && reach <= 0.5 * (1.0 + 1e-9),
            "{goal}: {body:?}"
        );
    }
}

/// With at most 4 kg within 0.5 m a third of the weight remains: the bound is m·R.
#[test]
fn a_counterweight_keeps_within_its_bounds() {
    let file = lever("", "");
    let found = balance(&file, &request(BalanceGoal::Holding, &[(0, 4.0, 0.5)], &[])).unwrap();
    is_optimal(&found, BalanceGoal::Holding);
    let left = found.after.holding[1] / WEIGHT;
    assert!((left - 1.0 / 3.0).abs() < 1e-5, "{left}");
}

/// A spring without free length, k·h·a = m·g·r, holds the lever at every angle.
#[test]
fn a_spring_without_free_length_holds_a_lever() {
    let spring = "[[spring]]\nname = \"balancer\"\nbetween = [\"lever.tip\", { on = \"ground\", at = [\"0 mm\", \"500 mm\"] }]\n\
                  stiffness = \"50 N/m\"\nfree_length = \"200 mm\"\n";
    let file = lever("", spring);
    let found = balance(&file, &request(BalanceGoal::Holding, &[], &[0])).unwrap();
    is_optimal(&found, BalanceGoal::Holding);
    let Some([stiffness, free]) = found.springs[0].and_then(|spring| spring.spring_rate()) else {
        panic!("no spring");
    };
    let wanted = WEIGHT / (0.5 * 0.4);
    assert!(
        (stiffness / wanted - 1.0).abs() < 1e-3 && free == 0.0,
        "{stiffness} N/m, {free} m"
    );
    assert!(found.after.holding[1] < 1e-4 * WEIGHT);
}

/// A torsion spring over a part of the turn: the least-squares line through the weight.
#[test]
fn a_torsion_spring_is_a_straight_line_of_least_squares() {
    let spring = "[[spring]]\nname = \"bar\"\nbetween = [\"ground\", \"lever\"]\nstiffness = \"5 N m/rad\"\nfree_angle = \"0 deg\"\n";
    let file = lever("stroke = [\"10 deg\", \"80 deg\"]\n", spring);
    let found = balance(&file, &request(BalanceGoal::Holding, &[], &[0])).unwrap();
    is_optimal(&found, BalanceGoal::Holding);
    let points: Vec<[f64; 2]> = positions(file.machine.domain(), 1440)
        .map(|phi| [phi, -WEIGHT * phi.cos()])
        .collect();
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let over = |a: usize, b: usize| -> f64 {
        points
            .iter()
            .map(|p| (p[a] - mean[a]) * (p[b] - mean[b]))
            .sum()
    };
    let slope = over(0, 1) / over(0, 0);
    let Some([stiffness, free]) = found.springs[0].and_then(|spring| spring.spring_rate()) else {
        panic!("no spring");
    };
    let zero = mean[0] - mean[1] / slope;
    assert!(
        (stiffness / slope - 1.0).abs() < 1e-5,
        "{stiffness}, not {slope}"
    );
    assert!((free - zero).abs() < 1e-5, "{free}, not {zero}");
}

/// The machine file with the body written into it.
fn with_mass(text: &str, on: &str, at: [f64; 2], mass: f64, inertia: f64) -> MachineFile {
    let [u, v] = at;
    machine(&format!(
        "{text}\n[[mass]]\non = \"{on}\"\nat = [\"{u} m\", \"{v} m\"]\nmass = \"{mass} kg\"\ninertia = \"{inertia} kg m^2\"\n"
    ))
}

/// RMS and peak of the drive link's torque, drive train included, and the deviation of the inertia.
fn figures(file: &MachineFile) -> [f64; 3] {
    let duty = Duty::new(file, file.motion.as_ref().unwrap(), STEPS).unwrap();
    let ratio = file.drive_train.ratio();
    let train = file.drive_train.inertia_at_input() * ratio * ratio;
    let torque = duty.figures(|i| i.terms.total() + train * i.alpha);
    let inertias: Vec<f64> = positions(file.machine.domain(), 1440)
        .map(|phi| file.machine.bare_reduction(phi).unwrap().inertia)
        .collect();
    let n = inertias.len() as f64;
    let mean = inertias.iter().sum::<f64>() / n;
    let squares: f64 = inertias.iter().map(|j| (j - mean).powi(2)).sum();
    [torque.rms, torque.peak(), (squares / n).sqrt()]
}

/// On the crank of a press and the rocker and coupler of four-bars: the result equals the figures of the file that contains it, and no random body
/// within the bounds is better.
#[test]
fn no_body_drawn_at_random_is_better() {
    let mut random = ChaCha8Rng::seed_from_u64(71);
    let mut better = 0;
    for (name, on, link, most, reach) in [
        ("press", "crank", 0, 40.0, 0.2),
        ("four-bar", "rocker", 2, 6.0, 0.3),
        ("four-bar", "coupler", 1, 3.0, 0.2),
    ] {
        let text = example(name);
        let file = machine(&text);
        for (k, goal) in [BalanceGoal::Rms, BalanceGoal::Peak, BalanceGoal::Inertia]
            .into_iter()
            .enumerate()
        {
            if goal == BalanceGoal::Inertia && on == "crank" {
                continue; // The crank's own inertia is the same at every angle.
            }
            let found = balance(&file, &request(goal, &[(link, most, reach)], &[])).unwrap();
            is_optimal(&found, goal);
            if let Some(body) = found.masses[0] {
                let written = with_mass(&text, on, body.at, body.mass, body.inertia);
                let [of_file, said] = [figures(&written)[k], found.after.of(goal)];
                assert!(
                    (of_file / said - 1.0).abs() < 1e-9,
                    "{name}, {goal}: {of_file}, {said}"
                );
                better += usize::from(said < 0.99 * found.before.of(goal));
            }
            for _ in 0..12 {
                let mass = most * random.random_range(0.01..1.0);
                let (distance, angle) = (
                    random.random_range(0.0..reach),
                    random.random_range(0.0..6.3),
                );
                let at = [distance * f64::cos(angle), distance * f64::sin(angle)];
                let own =
                    mass * (reach * reach - distance * distance) * random.random_range(0.0..1.0);
                let other = figures(&with_mass(&text, on, at, mass, own))[k];
                assert!(
                    other >= found.bound * (1.0 - 1e-9),
                    "{name}, {goal}: {other} with {mass} kg at {at:?}"
                );
            }
        }
    }
    assert!(better >= 4, "only {better} are worth anything");
}

/// If a counterweight and a spring can each balance the weight, no body is added that the spring then carries; without effect, nothing is added.
#[test]
fn what_is_not_needed_is_not_taken() {
    let spring = "[[spring]]\nname = \"balancer\"\nbetween = [\"lever.tip\", { on = \"ground\", at = [\"0 mm\", \"500 mm\"] }]\n\
                  stiffness = \"50 N/m\"\nfree_length = \"200 mm\"\n";
    let file = lever("", spring);
    let found = balance(
        &file,
        &request(BalanceGoal::Holding, &[(0, 20.0, 0.5)], &[0]),
    )
    .unwrap();
    is_optimal(&found, BalanceGoal::Holding);
    assert!(found.masses[0].is_none(), "{:?}", found.masses);
    // The jaw slides: only its mass counts, and at constant speed only the cam moves it.
    let four_bar = machine(&example("four-bar"));
    let found = balance(
        &four_bar,
        &request(BalanceGoal::Inertia, &[(0, 5.0, 0.1), (1, 3.0, 0.2)], &[]),
    )
    .unwrap();
    assert!(found.masses[0].is_none(), "{:?}", found.masses);
}

/// Requests without an answer.
#[test]
fn what_cannot_be_balanced() {
    let still = lever("", "");
    let fault = |file: &MachineFile, request: &BalanceRequest| balance(file, request).unwrap_err();
    assert!(matches!(
        fault(&still, &request(BalanceGoal::Rms, &[(0, 1.0, 1.0)], &[])),
        BalanceError::NoMotion
    ));
    assert!(matches!(
        fault(
            &still,
            &request(BalanceGoal::Inertia, &[(0, 1.0, 1.0)], &[])
        ),
        BalanceError::Nothing
    ));
    let press = machine(&example("press"));
    assert!(matches!(
        fault(
            &press,
            &request(BalanceGoal::Inertia, &[(0, 1.0, 1.0)], &[])
        ),
        BalanceError::NoEffect
    ));
    let spring = machine(&example("linkage-four-bar"));
    assert!(matches!(
        fault(&spring, &request(BalanceGoal::Inertia, &[], &[0])),
        BalanceError::SpringForInertia
    ));
    // A spring that closes a cam is refused: its optimum would let the contact open.
    let cam = machine(&example("linkage-cam-lever"));
    assert!(matches!(
        fault(&cam, &request(BalanceGoal::Rms, &[], &[0])),
        BalanceError::Parts(_)
    ));
}

/// Over a range on both sides of the upright position the weight's torque has either sign, and so must the spring's: k·80° each. On one side it has
/// one sign only.
#[test]
fn a_spring_says_whether_it_works_both_ways() {
    let spring = "[[spring]]\nname = \"bar\"\nbetween = [\"ground\", \"lever\"]\nstiffness = \"5 N m/rad\"\nfree_angle = \"0 deg\"\n";
    let efforts = |range: &str| {
        let file = lever(range, spring);
        let found = balance(&file, &request(BalanceGoal::Holding, &[], &[0])).unwrap();
        let rate = found.springs[0]
            .and_then(|spring| spring.spring_rate())
            .unwrap();
        (rate, found.efforts[0].unwrap())
    };
    let ([stiffness, free], [pull, push]) = efforts("stroke = [\"10 deg\", \"170 deg\"]\n");
    let most = stiffness * 80f64.to_radians();
    assert!((free - 90f64.to_radians()).abs() < 1e-5, "{free}");
    assert!((pull / most - 1.0).abs() < 1e-5 && (push / most - 1.0).abs() < 1e-5);
    let ([stiffness, free], [pull, push]) = efforts("stroke = [\"10 deg\", \"80 deg\"]\n");
    let most = stiffness * (free - 10f64.to_radians());
    assert!(
        pull == 0.0 && (push / most - 1.0).abs() < 1e-9,
        "{pull} {push} {most}"
    );
}

/// A goal that costs more than a tenth of the RMS is named.
#[test]
fn a_higher_rms_is_said() {
    let file = lever(
        "",
        "[motion]\ntype = \"constant-speed\"\nspeed = \"15 rpm\"\n",
    );
    let mut found = balance(&file, &request(BalanceGoal::Peak, &[(0, 20.0, 0.5)], &[])).unwrap();
    assert_eq!(found.heats(), None);
    let [rms, peak] = found.before.torque.unwrap();
    for (share, said) in [(0.05, None), (0.12, Some(0.12))] {
        found.after.torque = Some([rms * (1.0 + share), peak]);
        let heats = found.heats();
        assert_eq!(heats.map(|x| (x * 1e6).round() / 1e6), said);
    }
}
