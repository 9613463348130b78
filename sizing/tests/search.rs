//! Finding drives: gear ratios in closed form, ranking, filters, Pareto fronts.
// Copied figures are exact.
#![allow(clippy::float_cmp)]

mod support;

use std::path::Path;

use glob::Pattern;
use jred_sizing::catalogue::{Catalogue, Gearbox, Motor};
use jred_sizing::check::Verdict;
use jred_sizing::cycle::Cycle;
use jred_sizing::drive::{Coefficients, Drive};
use jred_sizing::duty::Duty;
use jred_sizing::filter::Filter;
use jred_sizing::input;
use jred_sizing::judge::Context;
use jred_sizing::machine::MachineFile;
use jred_sizing::pareto::Front;
use jred_sizing::rank::{Objective, rank};
use jred_sizing::ratio::ranges::Trial;
use jred_sizing::ratio::{Gear, Moments, accelerating_factor};
use jred_sizing::rule::Rule;
use jred_sizing::rules::Limit;
use jred_sizing::size::Selection;
use support::{budget, jred, near, press_file, press_text, within};

const RACK: &str = include_str!("../../machines/rack.toml");
const SCREW: &str = include_str!("../../machines/ball-screw.toml");

struct Case {
    file: MachineFile,
    duty: Duty,
    cycle: Cycle,
}

fn case(text: &str, steps: usize) -> Case {
    let file = input::parse("machine.toml", text, Path::new("")).unwrap();
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
    let cycle = Cycle::new(&duty);
    Case { file, duty, cycle }
}

fn catalogue() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

/// The drive of a motor and a gear of some ratio, as the tool's own drives are.
fn coefficients(motor: &Motor, gear: Gear, ratio: f64) -> Coefficients {
    let gearbox = Gearbox {
        ratio,
        inertia: gear.inertia,
        efficiency: gear.efficiency,
        back_efficiency: gear.efficiency,
        ..Gearbox::default()
    };
    Drive {
        motor,
        gearbox: Some(&gearbox),
        amplifier: None,
    }
    .coefficients()
}

/// The least value of a function with one minimum, by golden section over ln x.
fn golden(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let g = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut a, mut b) = (low.ln(), high.ln());
    for _ in 0..200 {
        let (c, d) = (b - g * (b - a), a + g * (b - a));
        if f(c.exp()) < f(d.exp()) {
            b = d;
        } else {
            a = c;
        }
    }
    a.midpoint(b).exp()
}

const GEARS: [Gear; 2] = [
    Gear::IDEAL,
    Gear {
        inertia: 4e-5,
        efficiency: 0.92,
    },
];

/// Motors of the catalogue, and one with friction of both kinds.
fn motors() -> Vec<Motor> {
    let mut motors = catalogue().motors;
    let mut rough = motors[10].clone();
    rough.friction = [0.4, 2e-3];
    motors.push(rough);
    motors
}

/// T_rms of the moments is that of the instants, and i* the ratio where it is smallest.
#[test]
fn best_ratio_by_golden_section() {
    for text in [press_text().as_str(), RACK, SCREW] {
        let case = case(text, 400);
        for motor in motors() {
            for gear in GEARS {
                let moments = Moments::new(&case.duty, &motor, gear);
                let direct = |ratio: f64| {
                    let coefficients = coefficients(&motor, gear, ratio);
                    let torques = case
                        .duty
                        .instants
                        .iter()
                        .map(|i| coefficients.torque(&jred_sizing::drive::loads(i)));
                    case.duty.figures_of(torques).rms
                };
                let best = moments.best_ratio().unwrap();
                for ratio in [0.1 * best, 0.7 * best, best, 3.0 * best, 20.0 * best] {
                    near(
                        &motor.key,
                        moments.rms_torque(ratio),
                        direct(ratio),
                        budget::MOMENTS,
                    );
                }
                let found = golden(|i| moments.rms_torque(i), best / 50.0, best * 50.0);
                near(&motor.key, found, best, budget::BEST_RATIO);
                assert!(
                    direct(best) <= direct(best * 1.001) && direct(best) <= direct(best * 0.999),
                    "{}",
                    motor.key
                );
                // The load factor is what the motor needs at i*.
                let least = moments.rms_torque(best);
                near(
                    "beta",
                    moments.load_factor().unwrap(),
                    least * least / moments.inertia,
                    budget::MOMENTS,
                );
            }
        }
    }
}

/// By hand: a pure inertia J_L gives i* = √(J_L/J_M), T_rms = 2·√(J_L·J_M)·a_rms, β = 4·J_L·a_rms².
#[test]
fn a_pure_inertia() {
    let text = RACK.replacen("opposing_force = \"110 N\"", "opposing_force = \"0 N\"", 1);
    let case = case(&text, 400);
    let motor = &catalogue().motors[5];
    let moments = Moments::new(&case.duty, motor, Gear::IDEAL);
    let load = case.cycle.inertia().max;
    let acceleration = case.duty.figures(|i| i.input_alpha).rms;
    let best = moments.best_ratio().unwrap();
    near(
        "i*",
        best,
        (load / motor.rotor_inertia).sqrt(),
        budget::RATIO_END,
    );
    near(
        "T_rms",
        moments.rms_torque(best),
        2.0 * (load * motor.rotor_inertia).sqrt() * acceleration,
        budget::RATIO_END,
    );
    near(
        "beta",
        moments.load_factor().unwrap(),
        4.0 * load * acceleration * acceleration,
        budget::RATIO_END,
    );
}

/// A motor whose S1 torque is the same at every speed.
fn flat(motor: &Motor) -> Motor {
    Motor {
        standstill_torque: motor.rated_torque,
        rated_speed: Some(1e5),
        max_speed: Some(1e5),
        max_power: None,
        continuous_curve: Vec::new(),
        peak_curve: Vec::new(),
        ..motor.clone()
    }
}

/// Every ratio of a catalogue that holds the RMS rule lies inside the range in closed form, and every other outside; there
/// is a range exactly for accelerating factors above the load factor.
#[test]
fn the_range_in_closed_form_is_that_of_the_catalogue_search() {
    let (mut inside, mut outside, mut hopeless) = (0, 0, 0);
    for text in [press_text().as_str(), RACK, SCREW] {
        let case = case(text, 200);
        for motor in motors() {
            let motor = flat(&motor);
            for gear in GEARS {
                let ratios = (0..80).map(|k| 0.3 * 1.08f64.powi(k));
                let gearbox = |ratio| Gearbox {
                    key: format!("i{ratio}"),
                    ratio,
                    inertia: gear.inertia,
                    efficiency: gear.efficiency,
                    back_efficiency: gear.efficiency,
                    ..Gearbox::default()
                };
                let gearboxes: Vec<Gearbox> = ratios.map(gearbox).collect();
                let catalogue = Catalogue {
                    motors: vec![motor.clone()],
                    gearboxes,
                    ..Catalogue::default()
                };
                let prepared = catalogue.prepare(&case.file.site);
                let moments = Moments::new(&case.duty, &motor, gear);
                let limit = 0.8 * motor.rated_torque.unwrap();
                let range = moments.range(limit);
                let factor = accelerating_factor(limit, moments.inertia);
                assert_eq!(
                    range.is_some(),
                    factor >= moments.load_factor().unwrap(),
                    "{}",
                    motor.key
                );
                hopeless += usize::from(range.is_none());
                for (index, drive) in catalogue.drives() {
                    if drive.gearbox.is_none() {
                        continue;
                    }
                    let context =
                        Context::new(&case.cycle, &case.file.site, drive, &prepared[index]);
                    let rules = &case.file.rules;
                    let finding = context.findings(rules).get(Rule::RmsTorque).unwrap();
                    let holds = rules.verdict(Rule::RmsTorque, finding) != Verdict::Fail;
                    let within =
                        range.is_some_and(|[from, to]| (from..=to).contains(&drive.ratio()));
                    assert_eq!(
                        holds,
                        within,
                        "{} at {}: {range:?}",
                        motor.key,
                        drive.ratio()
                    );
                    inside += usize::from(holds);
                    outside += usize::from(!holds);
                }
            }
        }
    }
    assert!(
        inside > 500 && outside > 500 && hopeless > 5,
        "{inside} inside, {outside} outside, {hopeless} too small"
    );
}

/// The range of all rules: catalogue drives inside hold every rule of the motor, those outside break one, and just beyond
/// each end the named rule is broken.
#[test]
fn ranges_of_all_rules() {
    let case = case(&press_text(), 200);
    let catalogue = catalogue();
    let prepared = catalogue.prepare(&case.file.site);
    let rules = &case.file.rules;
    let mut ends = 0;
    for (motor, limits) in catalogue.motors.iter().zip(&prepared) {
        let trial = Trial {
            cycle: &case.cycle,
            site: &case.file.site,
            rules,
            motor,
            prepared: limits,
            gear: GEARS[1],
        };
        let best = Moments::new(&case.duty, motor, GEARS[1]).best_ratio();
        let ranges = trial.ranges(best);
        for found in &ranges {
            let [from, to] = found.range;
            if let Some(rule) = found.below {
                assert_eq!(
                    trial.broken(from * (1.0 - 1e-6)),
                    Some(rule),
                    "{}",
                    motor.key
                );
                assert_eq!(trial.broken(from * (1.0 + 1e-6)), None, "{}", motor.key);
                ends += 1;
            }
            if let Some(rule) = found.above {
                assert_eq!(trial.broken(to * (1.0 + 1e-6)), Some(rule), "{}", motor.key);
                ends += 1;
                if rule == Rule::Speed {
                    // By hand: 90 % of the largest speed.
                    let expected = 0.9 * limits.envelope.max_speed() / case.cycle.peak_speed();
                    near(&motor.key, to, expected, budget::RATIO_END);
                }
            }
        }
        for k in 0..60 {
            let ratio = 0.3 * 1.09f64.powi(k);
            let inside = ranges
                .iter()
                .any(|found| (found.range[0]..=found.range[1]).contains(&ratio));
            assert_eq!(
                trial.broken(ratio).is_none(),
                inside,
                "{} at {ratio}: {ranges:?}",
                motor.key
            );
        }
    }
    assert!(ends > 20, "only {ends} ends");
}

/// The drives of a case, with masses and prices where the index says so.
fn priced() -> Catalogue {
    let mut catalogue = catalogue();
    for (k, motor) in catalogue.motors.iter_mut().enumerate() {
        motor.mass = (k % 3 != 0).then_some(2.0 + (k * 7 % 13) as f64);
        motor.price = (k % 4 != 1).then_some(300.0 + (k * 11 % 17) as f64 * 40.0);
    }
    for (k, gearbox) in catalogue.gearboxes.iter_mut().enumerate() {
        gearbox.mass = Some(1.0 + (k % 5) as f64);
        gearbox.price = Some(200.0 + (k % 7) as f64 * 30.0);
    }
    catalogue.amplifiers.clear();
    catalogue
}

#[test]
fn ranked_by_what_was_asked_for() {
    let case = case(&press_text(), 200);
    let catalogue = priced();
    let prepared = catalogue.prepare(&case.file.site);
    let select = || {
        Selection::new(
            &catalogue,
            &prepared,
            &case.cycle,
            &case.file.site,
            &case.file.rules,
        )
    };
    for objective in [
        Objective::Power,
        Objective::Mass,
        Objective::Price,
        Objective::Energy,
        Objective::Margin,
    ] {
        let mut selection = select();
        let before = selection.fit.len();
        let unknown = rank(&mut selection, objective);
        assert_eq!(selection.fit.len(), before);
        let values: Vec<Option<f64>> = selection
            .fit
            .iter()
            .map(|c| objective.value(&selection, c))
            .collect();
        let known = values.len() - unknown;
        assert!(
            values[..known].iter().all(Option::is_some)
                && values[known..].iter().all(Option::is_none)
        );
        let sign = if objective == Objective::Margin {
            -1.0
        } else {
            1.0
        };
        assert!(
            values[..known].is_sorted_by(|a, b| sign * a.unwrap() <= sign * b.unwrap()),
            "{objective:?}: {values:?}"
        );
        let missing = selection.fit.iter().filter(|c| match objective {
            Objective::Mass => c.drive.motor.mass.is_none(),
            Objective::Price => c.drive.motor.price.is_none(),
            _ => false,
        });
        assert_eq!(missing.count(), unknown, "{objective:?}");
    }
    // By hand: mass and energy of a drive.
    let selection = select();
    let candidate = selection
        .fit
        .iter()
        .find(|c| c.drive.motor.mass.is_some() && c.drive.gearbox.is_some())
        .unwrap();
    let drive = candidate.drive;
    let mass = drive.motor.mass.unwrap() + drive.gearbox.unwrap().mass.unwrap();
    assert_eq!(Objective::Mass.value(&selection, candidate), Some(mass));
    let put_in = case.duty.integral(|i| {
        let point = drive.motor_point(i);
        (point.torque * point.speed).max(0.0)
    });
    near(
        "energy",
        Objective::Energy.value(&selection, candidate).unwrap(),
        put_in,
        budget::PREPARED_CYCLE,
    );
    // Without any price the ranking stays, and its words with it.
    let bare = Catalogue {
        amplifiers: Vec::new(),
        ..self::catalogue()
    };
    let prepared = bare.prepare(&case.file.site);
    let mut selection = Selection::new(
        &bare,
        &prepared,
        &case.cycle,
        &case.file.site,
        &case.file.rules,
    );
    let names = |selection: &Selection| {
        selection
            .fit
            .iter()
            .map(|c| c.drive.name())
            .collect::<Vec<_>>()
    };
    let (before, words) = (names(&selection), selection.ranking);
    assert_eq!(rank(&mut selection, Objective::Price), before.len());
    assert_eq!((names(&selection), selection.ranking), (before, words));
}

/// The front against its definition: every pair compared.
#[test]
fn the_front_is_what_nothing_beats() {
    let mut case = case(&press_text(), 200);
    // More drives to compare.
    for rule in Rule::ALL {
        case.file.rules.set(rule, Limit::default());
    }
    let catalogue = priced();
    let prepared = catalogue.prepare(&case.file.site);
    let selection = Selection::new(
        &catalogue,
        &prepared,
        &case.cycle,
        &case.file.site,
        &case.file.rules,
    );
    for objectives in [
        &[Objective::Mass, Objective::Price][..],
        &[Objective::Energy, Objective::Mass],
        &[Objective::Power, Objective::Energy, Objective::Price],
    ] {
        let front = Front::new(&selection, objectives);
        let values: Vec<(String, Vec<f64>)> = (selection.fit.iter())
            .filter_map(|c| {
                let values: Option<Vec<f64>> =
                    objectives.iter().map(|o| o.value(&selection, c)).collect();
                Some((c.drive.name(), values?))
            })
            .collect();
        assert_eq!(front.compared, values.len());
        let beaten = |own: &[f64]| {
            values.iter().any(|(_, other)| {
                other.iter().zip(own).all(|(a, b)| a <= b)
                    && other.iter().zip(own).any(|(a, b)| a < b)
            })
        };
        let mut expected: Vec<&str> = values
            .iter()
            .filter(|(_, own)| !beaten(own))
            .map(|(name, _)| name.as_str())
            .collect();
        let mut found: Vec<String> = front
            .points
            .iter()
            .map(|p| p.candidate.drive.name())
            .collect();
        expected.sort_unstable();
        found.sort_unstable();
        assert_eq!(found, expected, "{objectives:?}");
        assert!(
            found.len() > 1 && found.len() < values.len() / 4,
            "{} of {}",
            found.len(),
            values.len()
        );
    }
}

fn pattern(text: &str) -> Vec<Pattern> {
    vec![Pattern::new(text).unwrap()]
}

/// A filter leaves exactly the drives that its words describe, counted over the whole catalogue by hand.
#[test]
fn filters_leave_what_they_say() {
    let case = case(&press_text(), 64);
    let all = priced();
    let motors = all.motors.len();
    let count = |filter: &Filter, expected: &dyn Fn(&Drive) -> bool| {
        let mut thinned = all.clone();
        filter.thin(&mut thinned).unwrap();
        let prepared = thinned.prepare(&case.file.site);
        let mut selection = Selection::new(
            &thinned,
            &prepared,
            &case.cycle,
            &case.file.site,
            &case.file.rules,
        );
        filter.sift(&mut selection);
        let mut found: Vec<String> = selection
            .fit
            .iter()
            .chain(&selection.refused)
            .map(|c| c.drive.name())
            .collect();
        let mut wanted: Vec<String> = all
            .drives()
            .filter(|(_, drive)| expected(drive))
            .map(|(_, drive)| drive.name())
            .collect();
        found.sort();
        wanted.sort();
        assert_eq!(found, wanted, "{filter:?}");
        found.len()
    };
    let everything = count(&Filter::default(), &|_| true);
    assert_eq!(everything, all.count());
    assert_eq!(
        count(
            &Filter {
                direct_only: true,
                ..Filter::default()
            },
            &|d| d.gearbox.is_none()
        ),
        motors
    );
    let some = count(
        &Filter {
            motors: pattern("SGM?H-*"),
            ..Filter::default()
        },
        &|d| d.motor.key.starts_with("sgm") && d.motor.key.as_bytes().get(4..6) == Some(b"h-"),
    );
    assert!(some > 0 && some < everything);
    count(
        &Filter {
            gearboxes: pattern("npt0*"),
            ..Filter::default()
        },
        &|d| d.gearbox.is_some_and(|g| g.key.starts_with("npt0")),
    );
    count(
        &Filter {
            makers: pattern("yaskawa"),
            ..Filter::default()
        },
        &|d| d.motor.maker == "Yaskawa" && d.gearbox.is_none_or(|g| g.maker == "Yaskawa"),
    );
    count(
        &Filter {
            ratio: Some([3.0, 5.0]),
            ..Filter::default()
        },
        &|d| (3.0..=5.0).contains(&d.ratio()),
    );
    count(
        &Filter {
            ratio: Some([1.0, 3.0]),
            ..Filter::default()
        },
        &|d| (1.0..=3.0).contains(&d.ratio()),
    );
    count(
        &Filter {
            max_mass: Some(6.0),
            ..Filter::default()
        },
        &|d| {
            d.motor
                .mass
                .is_some_and(|m| m + d.gearbox.map_or(0.0, |g| g.mass.unwrap()) <= 6.0)
        },
    );
    count(
        &Filter {
            max_price: Some(700.0),
            ..Filter::default()
        },
        &|d| {
            d.motor
                .price
                .is_some_and(|m| m + d.gearbox.map_or(0.0, |g| g.price.unwrap()) <= 700.0)
        },
    );
    let nothing = Filter {
        motors: pattern("nobody"),
        ..Filter::default()
    };
    let message = nothing.thin(&mut all.clone()).unwrap_err().to_string();
    assert!(
        message.contains(&format!("none of the {motors} motors")),
        "{message}"
    );
}

/// The options of the command.
#[test]
fn options_of_size() {
    let press = press_file();
    let run = jred([
        &"size",
        &press,
        &"--rank",
        &"energy",
        &"--motor",
        &"sgm*",
        &"--format",
        &"json",
    ])
    .ends(0);
    let json = run.json();
    assert!(
        json["ranking"]
            .as_str()
            .unwrap()
            .contains("least energy put in"),
        "{}",
        json["ranking"]
    );
    let fit = json["fit"].as_array().unwrap();
    let energies: Vec<f64> = fit
        .iter()
        .map(|d| d["duty"]["motoring energy [J]"].as_f64().unwrap())
        .collect();
    assert!(energies.len() > 1 && energies.is_sorted(), "{energies:?}");
    assert!(
        fit.iter()
            .all(|d| d["motor"].as_str().unwrap().starts_with("sgm"))
    );

    let run = jred([
        &"size",
        &press,
        &"--pareto",
        &"power,energy",
        &"--format",
        &"csv",
    ])
    .ends(0);
    assert!(
        run.out
            .starts_with("motor,gearbox,rated power [W],energy [J]\n"),
        "{}",
        run.out
    );
    let rows: Vec<Vec<f64>> = run
        .out
        .lines()
        .skip(1)
        .map(|l| l.split(',').skip(2).map(|x| x.parse().unwrap()).collect())
        .collect();
    assert!(
        !rows.is_empty()
            && rows
                .windows(2)
                .all(|w| w[0][0] <= w[1][0] && w[0][1] >= w[1][1]),
        "{}",
        run.out
    );

    let price = jred([&"size", &press, &"--rank", &"price"]).ends(0);
    assert!(
        price
            .message()
            .contains("the price of no drive that fits is known"),
        "{}",
        price.err
    );
    jred([&"size", &press, &"--pareto", &"mass"])
        .ends(2)
        .says(&["two or three different objectives"]);
    jred([&"size", &press, &"--pareto", &"mass,colour"])
        .ends(2)
        .says(&["power, mass, price, energy, margin, temperature"]);
    jred([&"size", &press, &"--ratio", &"9..3"])
        .ends(2)
        .says(&["no ratio lies between 9 and 3"]);
    jred([&"size", &press, &"--maker", &"Nobody"])
        .ends(2)
        .says(&["none of the", "passes the filter"]);
    jred([&"size", &press, &"--max-mass", &"5 mm"])
        .ends(2)
        .says(&["must be a mass"]);
}

/// The list of ratios: the figures of the library, in the order of power.
#[test]
fn the_command_lists_ratios() {
    let run = jred([&"ratio", &press_file(), &"--format", &"json"]).ends(0);
    let json = run.json();
    let rows = json["rows"].as_array().unwrap();
    let case = case(&press_text(), jred_sizing::duty::STEPS);
    let catalogue = catalogue();
    assert!(rows.len() >= catalogue.motors.len());
    let powers: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["rated power [W]"].as_f64())
        .collect();
    assert!(powers.is_sorted());
    for motor in &catalogue.motors {
        let row = rows
            .iter()
            .find(|row| row["motor"] == motor.key.as_str())
            .unwrap();
        let moments = Moments::new(&case.duty, motor, Gear::IDEAL);
        near(
            "best",
            row["best ratio"].as_f64().unwrap(),
            moments.best_ratio().unwrap(),
            1e-14,
        );
        let range = moments.range(0.8 * motor.rated_torque.unwrap());
        match range {
            None => assert!(row["RMS ratio from"].is_null()),
            Some([from, _]) => within("from", row["RMS ratio from"].as_f64().unwrap(), from, 1e-13),
        }
    }
    jred([&"ratio", &press_file(), &"--efficiency", &"120%"])
        .ends(2)
        .says(&["not above 1"]);
}
