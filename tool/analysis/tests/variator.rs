//! `[variator]` and `type = "friction-drive"`: what is read, what is refused, and the motion against closed forms.

mod refusals;

use crate::reading::{parse, says};
use crate::simulate::{imbalance, run, simulate};
use crate::support::machines::SHAFTS;
use crate::support::{budget, edited, near, near_column, phrases, rows, within};
use jred::machine::Mechanism as _;
use jred_file::model::variator::{Adhesion, integrability_text};

const PRESS: &str = include_str!("../../../machines/variator-press.toml");
const FAN: &str = include_str!("../../../machines/friction-fan.toml");
const DOC: &str = include_str!("../../../docs/friction-drives.md");

const INPUT: f64 = 0.006;
const OUTPUT: f64 = 0.01 + 0.04 / 4.0 + 0.0005;

/// The message about `base` with `from` replaced by `to`, which is not simulated.
#[track_caller]
fn refuses(base: &str, from: &str, to: &str, words: &[&str]) {
    match run(&edited(base, from, to)) {
        Err(message) => says(&message, words),
        Ok(_) => panic!("simulated, though the report should contain {words:?}"),
    }
}

/// The same for a table of edits ([`rows`]).
#[track_caller]
fn refuses_all(base: &str, edits: &str) {
    for [from, to, words] in rows(edits) {
        refuses(base, &from, &to, &phrases(&words));
    }
}

#[test]
fn a_free_run_keeps_the_energy() {
    let found = simulate(SHAFTS);
    let (input, output) = (found.get("input omega [rad/s]"), found.get("omega [rad/s]"));
    let ratio = found.get("ratio");
    let start = 10.0 * std::f64::consts::PI;
    let kept = |j: f64| (INPUT + j * j * OUTPUT).sqrt();
    let first = start / 0.5 * kept(0.5);
    for k in 0..ratio.len() {
        near("j", output[k], ratio[k] * input[k], budget::SWING);
        // ω·√J: the factor ½. With the factor 1 it would be ω·J.
        near("ω√J", input[k] * kept(ratio[k]), first, budget::SWING);
    }
    near("first ratio", ratio[0], 0.5, budget::RATIO);
    near("last ratio", ratio[ratio.len() - 1], 1.6, budget::RATIO);
    // The angle of the drive link is its own: j·α of the motor is far off.
    let [phi, motor] =
        ["phi [deg]", "input phi [deg]"].map(|name| *found.get(name).last().unwrap());
    assert!((phi - 1.6 * motor).abs() > 90.0, "{phi} {motor}");
    assert!(imbalance(&found) <= budget::BALANCE);
}

/// The same of a ratio that goes up and down again through points.
#[test]
fn a_ratio_through_points_keeps_the_energy() {
    let points = "ratio = [[\"0.1 s\", 0.5], [\"0.25 s\", 0.8], [\"0.4 s\", 1.4], [\"0.6 s\", 1.5], [\"0.75 s\", 1.1], [\"0.9 s\", 0.9]]";
    let (head, rest) = SHAFTS.split_once("[[variator.shift]]").unwrap();
    let (_, simulation) = rest.split_once("[simulation]").unwrap();
    let text = format!("{head}[simulation]{simulation}");
    let text = edited(&text, "ratio = 0.5", points);
    let found = simulate(&text);
    let (input, output) = (found.get("input omega [rad/s]"), found.get("omega [rad/s]"));
    let (t, ratio) = (found.get("t [s]"), found.get("ratio"));
    let kept = |j: f64| (INPUT + j * j * OUTPUT).sqrt();
    let first = 10.0 * std::f64::consts::PI / 0.5 * kept(0.5);
    for k in 0..ratio.len() {
        near("j", output[k], ratio[k] * input[k], budget::SWING);
        near("ω√J", input[k] * kept(ratio[k]), first, budget::SWING);
    }
    for (time, expected) in [(0.0, 0.5), (0.1, 0.5), (0.4, 1.4), (0.6, 1.5), (1.0, 0.9)] {
        let k = t.iter().position(|t| (t - time).abs() < 1e-9).unwrap();
        near("ratio", ratio[k], expected, budget::RATIO);
    }
    assert!(imbalance(&found) <= budget::BALANCE);
    for (to, words) in [
        (
            "ratio = [[\"0 s\", 0.5], [\"1 s\", 0.6]]",
            "must have 5 to 1000 points",
        ),
        (
            "ratio = [[\"0 s\", 0.5], [\"1 s\", 0.6], [\"0.5 s\", 0.6], [\"2 s\", 0.6], [\"3 s\", 0.6]]",
            "not after the one before",
        ),
        (
            "ratio = [[\"0 s\", 9], [\"1 s\", 9], [\"1.1 s\", 0.01], [\"2 s\", 0.01], [\"3 s\", 0.01]]",
            "swings to",
        ),
    ] {
        refuses(&text, points, to, &[words]);
    }
    refuses(
        SHAFTS,
        "ratio = 0.5",
        points,
        &["together with a `ratio` over time"],
    );
}

/// The text of SHAFTS without its shifts, its ratio by a formula.
fn by_formula(formula: &str) -> String {
    let (head, rest) = SHAFTS.split_once("[[variator.shift]]").unwrap();
    let (_, simulation) = rest.split_once("[simulation]").unwrap();
    let text = format!("{head}[simulation]{simulation}");
    edited(&text, "ratio = 0.5", &format!("ratio = \"{formula}\""))
}

/// A ratio by a formula of the time: a free run keeps ω·√J.
#[test]
fn a_ratio_by_a_formula_keeps_the_energy() {
    let found = simulate(&by_formula("0.8 + 0.3*sin(2*pi*t - 0.4)^2"));
    let [input, output, t, ratio] =
        ["input omega [rad/s]", "omega [rad/s]", "t [s]", "ratio"].map(|name| found.get(name));
    let expected = |t: f64| 0.8 + 0.3 * (std::f64::consts::TAU * t - 0.4).sin().powi(2);
    let kept = |j: f64| (INPUT + j * j * OUTPUT).sqrt();
    let first = 10.0 * std::f64::consts::PI / expected(0.0) * kept(expected(0.0));
    for k in 0..ratio.len() {
        near("i", ratio[k], expected(t[k]), budget::RATIO);
        near("j", output[k], ratio[k] * input[k], budget::SWING);
        near("ω√J", input[k] * kept(ratio[k]), first, budget::SWING);
    }
    assert!(imbalance(&found) <= budget::BALANCE);
}

/// Formulas that keep within the range where the file is read, and leave it at angles that the simulation comes to.
#[test]
fn a_ratio_that_leaves_its_range_ends_the_simulation() {
    for formula in ["0.6 - 0.06*phi", "0.8/(10 - phi)"] {
        let Err(message) = run(&by_formula(formula)) else {
            panic!("simulated {formula}");
        };
        says(&message, &["ratio of the variator", "0.001 to 1000"]);
    }
}

/// A ratio that depends on the input shaft's angle alone is a relation between the angles: α₂ = ∫ i dα₁.
#[test]
fn a_ratio_over_the_angle_is_holonomic() {
    let text = by_formula("1 + 0.3*cos(phi)");
    let found = simulate(&text);
    let [input, output, turned] =
        ["input phi [deg]", "phi [deg]", "input omega [rad/s]"].map(|name| found.get(name));
    let kept = |phi: f64| (INPUT + (1.0 + 0.3 * phi.cos()).powi(2) * OUTPUT).sqrt();
    let first = 10.0 * std::f64::consts::PI / 1.3 * kept(0.0);
    for k in 0..input.len() {
        let phi = input[k].to_radians();
        let expected = (phi + 0.3 * phi.sin()).to_degrees();
        within("α₂", output[k] - output[0], expected, 1e-6);
        near("ω√J", turned[k] * kept(phi), first, budget::SWING);
    }
    let file = parse(&text).unwrap();
    let words = integrability_text(&file).unwrap();
    assert!(words.contains("holonomic: α_b - ∫ j(α_a)"), "{words}");
}

/// Points on a straight line are that line; the curve passes its points in both directions, and slides beyond the last.
#[test]
fn creep_follows_a_measured_curve() {
    let short = edited(PRESS, "duration = \"5 s\"", "duration = \"1.2 s\"");
    let line = simulate(&short);
    let curve =
        "creep = { curve = [[\"1 %\", \"15 N m\"], [\"2 %\", \"30 N m\"], [\"3 %\", \"45 N m\"]] }";
    let drawn = simulate(&edited(
        &short,
        "creep = { slip = \"3 %\", torque = \"45 N m\" }",
        curve,
    ));
    for name in [
        "phi [deg]",
        "omega [rad/s]",
        "slip [%]",
        "contact torque [N m]",
        "losses [J]",
    ] {
        let (a, b) = (line.get(name), drawn.get(name));
        near_column(name, &b, &a, 1e-8);
    }
    let points = ([0.005, 0.015, 0.03], [12.0, 30.0, 36.0]);
    let contact = Adhesion::through(&points.0, &points.1).unwrap();
    for (slip, torque) in points.0.into_iter().zip(points.1).chain([(0.2, 36.0)]) {
        let [forward, backward] = [
            contact.traction(100.0, 100.0 * (1.0 - slip)),
            contact.traction(100.0 * (1.0 - slip), 100.0),
        ];
        near("L", forward.torque, torque, 1e-12);
        near("-L", backward.torque, -torque, 1e-12);
        near("loss", forward.loss, torque * 100.0 * slip, 1e-12);
    }
    // It never carries less for more slip.
    let mut before = 0.0;
    for k in 0..=1000 {
        let now = contact.traction(100.0, 100.0 - 0.004 * f64::from(k)).torque;
        assert!(now >= before, "{now} after {before}");
        before = now;
    }
}

#[test]
fn constant_slip_loses_what_it_should() {
    let slip = "slip = \"4 %\"\npower_flow = \"input-drives\"";
    let text = edited(SHAFTS, "# slip", slip);
    let text = edited(&text, "torque = \"0 N m\"", "torque = \"3 N m\"");
    let text = edited(&text, "at = \"0.2 s\"", "at = \"5 s\"");
    let found = simulate(&text);
    // (J₁ + i·j·J₂)·ω̇ = T, L = J₂·j·ω̇, loss = L·i·ε·ω
    let (i, j) = (0.5, 0.5 * 0.96);
    let alpha = 3.0 / (INPUT + i * j * OUTPUT);
    let start = 10.0 * std::f64::consts::PI / j;
    let turned = start + 0.5 * alpha;
    let end = |name: &str| *found.get(name).last().unwrap();
    near(
        "ω",
        end("input omega [rad/s]"),
        start + alpha,
        budget::SWING,
    );
    near(
        "L",
        end("contact torque [N m]"),
        OUTPUT * j * alpha,
        budget::SWING,
    );
    near(
        "losses",
        end("losses [J]"),
        OUTPUT * j * alpha * (i - j) * turned,
        budget::SWING,
    );
    near("slip", end("slip [%]"), 4.0, budget::SWING);
    assert!(imbalance(&found) <= budget::BALANCE);
    // As printed, with the output driving, the same slip would give power.
    refuses(&text, "input-drives", "output-drives", &["PowerFlowsBack"]);
}

#[test]
fn a_constant_ratio_is_a_belt() {
    let variator = "[variator]\nratio = 0.25\ninput_inertia = \"30 kg cm^2\"\noutput_inertia = \"0.02 kg m^2\"\n";
    let belt = "[[drive_train]]\ntype = \"belt\"\ndriver = { radius = \"25 mm\", inertia = \"30 kg cm^2\" }\n\
                driven = { radius = \"100 mm\", inertia = \"0.02 kg m^2\" }\n";
    let (head, rest) = PRESS.split_once("# Disc and wheel").unwrap();
    let (_, tail) = rest.split_once("# From the variator").unwrap();
    let with = |part: &str| {
        let text = format!("{head}{part}# From the variator{tail}");
        simulate(&edited(&text, "duration = \"5 s\"", "duration = \"1.5 s\""))
    };
    let (found, expected) = (with(variator), with(belt));
    for name in [
        "phi [deg]",
        "omega [rad/s]",
        "J_red [kg m^2]",
        "losses [J]",
        "kinetic energy [J]",
    ] {
        near_column(
            name,
            &found.get(name),
            &expected.get(name),
            budget::SAME_MOTION,
        );
    }
}

#[test]
fn the_press_follows_its_creeping_variator() {
    let found = simulate(PRESS);
    assert!(
        imbalance(&found) <= budget::BALANCE,
        "{:e}",
        imbalance(&found)
    );
    let (time, ratio) = (found.get("t [s]"), found.get("ratio"));
    let (slip, torque) = (found.get("slip [%]"), found.get("contact torque [N m]"));
    let losses = found.get("losses [J]");
    for k in 1..time.len() {
        // L = torque·s/slip up to its limit, whichever side drives; and no contact gives power.
        within(
            "L",
            torque[k],
            45.0 * (slip[k] / 3.0).clamp(-1.0, 1.0),
            budget::SWING * 45.0,
        );
        assert!(losses[k] >= losses[k - 1], "t = {}", time[k]);
    }
    assert!(slip.iter().any(|s| *s < 0.0) && slip.iter().any(|s| *s > 0.0));
    let at = |t: f64| time.iter().position(|x| (x - t).abs() < 1e-9).unwrap();
    near("ratio", ratio[at(1.4)], 0.35, budget::RATIO);
    near("ratio", ratio[at(1.9)], 0.625, budget::RATIO);
    near("ratio", ratio[at(3.0)], 0.9, budget::RATIO);
    near("ratio", ratio[at(5.0)], 0.5, budget::RATIO);
    let omega = found.get("omega [rad/s]");
    assert!(omega[at(3.0)] > 2.0 * omega[at(1.4)]);
}

/// A load that friction holds lets go when the ratio has been shifted far enough.
#[test]
fn friction_holds_until_the_ratio_lets_go() {
    for slip in ["", "creep = { slip = \"2 %\", torque = \"50 N m\" }"] {
        let text = edited(SHAFTS, "# slip", slip);
        let text = edited(&text, "ratio = 0.5", "ratio = 1.0");
        let text = edited(&text, "ratio = 1.6", "ratio = 0.5");
        let text = edited(&text, "300 rpm", "0 rpm");
        let text = edited(
            &text,
            "torque = \"0 N m\"\n",
            "torque = \"3 N m\"\n[[load]]\non = \"shaft-1\"\nopposing_moment = \"4 N m\"\n",
        );
        let found = simulate(&text);
        let (omega, ratio) = (found.get("omega [rad/s]"), found.get("ratio"));
        for k in 0..omega.len() {
            // Without creep T/i = 3/i reaches 4 N m at i = 0.75; a creeping contact is dragged along by the motor's inertia.
            if slip.is_empty() {
                assert_eq!(
                    omega[k] > 0.0,
                    ratio[k] < 0.75,
                    "row {k}, ratio {}",
                    ratio[k]
                );
            }
        }
        assert!(omega[omega.len() - 1] > 0.0);
        assert!(
            imbalance(&found) <= budget::BALANCE,
            "{:e}",
            imbalance(&found)
        );
    }
}

#[test]
fn the_constraint_is_named() {
    let text = |file: &str| integrability_text(&parse(file).unwrap());
    assert_eq!(text(FAN), None);
    let shifted = text(SHAFTS).unwrap();
    assert!(shifted.contains("non-holonomic: θ∧dθ"), "{shifted}");
    assert!(text(PRESS).unwrap().contains("not a constraint"));
    let (before, _) = SHAFTS.split_once("[[variator.shift]]").unwrap();
    let constant = text(before).unwrap();
    assert!(
        constant.contains("holonomic, (III.18)") && constant.contains("j = 0.5"),
        "{constant}"
    );
}

#[test]
fn the_documented_examples_are_read() {
    let blocks: Vec<&str> = DOC
        .split("\n```toml\n")
        .skip(1)
        .map(|rest| rest.split("\n```").next().unwrap())
        .collect();
    assert_eq!(blocks.len(), 2);
    let chain = parse(blocks[0]).unwrap();
    let frames = chain.machine.mechanism().frames(1.0).unwrap();
    // j = i·(1 − ε)
    near(
        "ψ₃",
        frames[2].psi.value,
        0.5 * 0.985 * 0.4 * 0.98,
        budget::RATIO,
    );
    assert_eq!(
        chain.machine.mechanism().link_names(),
        ["shaft-1", "shaft-2", "shaft-3"]
    );
    assert!(parse(blocks[1]).unwrap().variator.is_some());
    let printed = parse(&edited(blocks[0], "input-drives", "output-drives")).unwrap();
    let frames = printed.machine.mechanism().frames(1.0).unwrap();
    near("ψ₂", frames[1].psi.value, -0.5 / 0.985, budget::RATIO);
}

#[test]
fn the_fan_is_read() {
    let file = parse(FAN).unwrap();
    let fan = file.machine.mechanism();
    assert_eq!(fan.kind(), "friction-drive");
    assert_eq!(fan.joint_names().last().unwrap(), "contact 3");
    let frames = fan.frames(2.0).unwrap();
    near("ψ₄", frames[3].psi.d1, -2.5 * 0.98, budget::RATIO);
}
