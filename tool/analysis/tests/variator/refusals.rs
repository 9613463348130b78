//! Faults of a variator or a friction drive, and their cures.

use super::{FAN, PRESS, SHAFTS, refuses, refuses_all};
use crate::support::{edited, phrases, rows};

#[test]
fn wrong_formulas_are_refused_with_their_place() {
    let (head, rest) = PRESS.split_once("[[variator.shift]]").unwrap();
    let (_, tail) = rest.split_once("# From the variator").unwrap();
    let base = format!("{head}# From the variator{tail}");
    let cases = r#"
        0.5 + 0.2*tim => "tim" is not known here | t, phi, pi | sin, cos
        0.5 +␣ => it ends where a number, a name or ( is expected
        0.5 * (1 + t => this bracket is not closed | at "("
        2 t => "t" is not expected here | such as *
        sin t => the function sin needs its argument in brackets: sin(…)
        0.5 + 1e-9/(t - 2.5) => has no finite value or slope at t = 2.5 s | divided by
        // Between two instants that are tried.
        0.5 + 1e-13/(t - 0.50001)^2 => at t = 0.50001 s, but must be between 0.001 and 1000
        1 - t => is 0 at t = 1 s, but must be between 0.001 and 1000
        1 - 1.2*cos(phi) => is -0.2 at t = 0 s, phi = 0 rad
        // As often as it is tried in a turn, it has the same value there.
        0.5 + 2*sin(62.5*phi) => phi =␣ | but must be between 0.001 and 1000
        1.2.3 => "1.2.3" is not a number
    "#;
    for [formula, words] in rows(cases) {
        let to = format!("ratio = \"{formula}\"");
        refuses(&base, "ratio = 0.35", &to, &phrases(&words));
    }
    refuses(
        PRESS,
        "ratio = 0.35",
        "ratio = \"0.35 + 0*t\"",
        &["together with a `ratio` over time"],
    );
    let long = format!("ratio = \"0.5{}\"", " + 0".repeat(300));
    refuses(
        &base,
        "ratio = 0.35",
        &long,
        &["longer than 1000 characters"],
    );
    let deep = format!("ratio = \"{}1{}\"", "(".repeat(200), ")".repeat(200));
    refuses(
        &base,
        "ratio = 0.35",
        &deep,
        &["nested deeper than 64 times"],
    );
}

#[test]
fn wrong_creep_curves_are_refused() {
    let creep = "creep = { slip = \"3 %\", torque = \"45 N m\" }";
    let cases = r#"
        curve = [["1 %", "15 N m"], ["2 %", "14 N m"], ["3 %", "20 N m"]] =>
            is 14 N m, not more than the one before | slips more
        curve = [["0 %", "0 N m"], ["2 %", "14 N m"], ["3 %", "20 N m"]] => greater than zero
        curve = [["1 %", "15 N m"]] => must have 3 to 1000 points, but has 1
        curve = [["1 %", "15 N m"], ["2 %", "17 N m"], ["100 %", "20 N m"]] => must be below 100 %
        slip = "3 %", curve = [["1 %", "15 N m"], ["2 %", "20 N m"]] => both `curve` and `slip`
    "#;
    for [curve, words] in rows(cases) {
        let to = format!("creep = {{ {curve} }}");
        refuses(PRESS, creep, &to, &phrases(&words));
    }
}

#[test]
fn wrong_variators_are_refused_with_their_cure() {
    let edits = r#"
        ratio = 0.35 => ratio = 0 => `ratio` in [variator] is 0 | between 0.001 and 1000
        ratio = 0.35 => ratios = 0.35 => did you mean "ratio"?
        input_inertia = "60 kg cm^2" => => `input_inertia` in [variator] is missing
        input_inertia = "60 kg cm^2" => input_inertia = "0 kg cm^2" => greater than zero
        slip = "3 %" => slip = "120 %" => must be below 100 % | starts to slide
        slip = "3 %",␣ => => `slip` in `creep` of [variator] is missing
        torque = "45 N m" => torque = "0 N m" => `torque` in `creep` of [variator]
        creep = { => slip = "2 %"\ncreep = { => has both `slip` and `creep` | keep one
        creep = { => power_flow = "input-drives"\ncreep = { => is only used together with a constant `slip`
        at = "3.4 s" => at = "2.2 s" => is 2.2 s, but must not be before 2.3 s | after the previous one has ended
        duration = "0.8 s" => duration = "0 s" => [[variator.shift]] number 1 | greater than zero
        law = "cycloidal" => law = "trapezoid" => "trapezoid" | polynomial-345
    "#;
    refuses_all(PRESS, edits);
    let constant = edited(SHAFTS, "# slip", "slip = \"2 %\"");
    refuses(
        &constant,
        "ratio = 1.6",
        "ratio = 1.5",
        &["`power_flow` in [variator] is missing"],
    );
}

#[test]
fn wrong_friction_drives_are_refused_with_their_cure() {
    let edits = r#"
        arrangement = "fan" => => `arrangement` in [mechanism] is missing
        arrangement = "fan" => arrangement = "tree" => "tree" | possible: "chain", "fan"
        power_flow = "input-drives" => => `power_flow` in [mechanism] is missing | slip always slows down the driven shaft
        ratio = -1.5 => ratio = 0.0 => too close to zero
        slip = "1.5 %" => slip = "100 %" => must be below 100 %
        slip = "1.5 %" => slip = "-1 %" => must not be negative
        inertia = "9 kg cm^2" => mass = "1 kg" => [[mechanism.stage]] number 1
    "#;
    refuses_all(FAN, edits);
}
