//! The holding torque: weight lasts without end, a process load for its dwell.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;

use super::{Stand, near};
use jred_report::list::rule_words::note;

/// A hanging moment of 120 N m, and 300 N m of a process where the shaft rests, on a 3:1 belt of 96 %.
fn press(before: &str, after: &str) -> Stand {
    Stand::new(&format!(
        r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.5 kg m^2"
stage = [{{ driver = {{ teeth = 20, inertia = "0 kg m^2" }}, driven = {{ teeth = 20, inertia = "0 kg m^2" }} }}]
[[load]]
on = "shaft-2"
moment = "120 N m"
[[load]]
name = "pressing"
on = "shaft-2"
moment = "300 N m"
between = ["340 deg", "20 deg"]
ramp = "5 deg"
[[drive_train]]
type = "belt"
driver = {{ radius = "40 mm", inertia = "0 kg m^2" }}
driven = {{ radius = "120 mm", inertia = "0 kg m^2" }}
efficiency = "96 %"
[motion]
type = "cycle"
{before}
[[motion.segment]]
move = "360 deg"
duration = "2 s"
law = "cycloidal"
{after}
"#
    ))
}

const DWELL: &str = "[[motion.segment]]\ndwell = \"1 s\"";

fn held(stand: &mut Stand, winding: Option<f64>) -> f64 {
    stand.motor.thermal.winding_time = winding;
    stand.found(false, Rule::HoldingTorque).value
}

#[test]
fn a_process_load_lasts_as_long_as_its_dwell() {
    let [weight, both] = [120.0, 420.0].map(|moment| moment / 3.0 / 0.96);
    let mut stand = press("", DWELL);
    near("short", held(&mut stand, Some(1.5)), weight, 1e-12);
    near("long", held(&mut stand, Some(0.9)), both, 1e-12);
    // Without a time constant 10 s are used, that of a small motor.
    near("unknown", held(&mut stand, None), weight, 1e-12);
    let check = stand.check(false, &RuleSet::default(), Rule::HoldingTorque);
    for words in ["at most 1 s", "10 s, which is not given", "RMS torque"] {
        assert!(note(&check).contains(words), "{}", note(&check));
    }
    // The brake holds all loads at the moment of closing, however short they are.
    stand.brake(9.0);
    near(
        "brake",
        stand.found(false, Rule::BrakeTorque).value,
        140.0,
        1e-12,
    );
    // The RMS torque counts the dwell: 1 s of 3 s at 420 N m.
    let rest: f64 = stand
        .duty
        .instants
        .iter()
        .filter(|i| i.omega == 0.0)
        .map(|i| i.weight)
        .sum();
    near("rest", rest, 1.0, 1e-9);
    let rms = stand.found(false, Rule::RmsTorque).value;
    assert!(rms * rms * 3.0 > both * both, "{rms}");
}

/// A dwell across the end of the cycle is one dwell.
#[test]
fn a_dwell_goes_on_over_the_end_of_a_cycle() {
    let mut stand = press(DWELL, DWELL);
    let both = 420.0 / 3.0 / 0.96;
    near("whole", held(&mut stand, Some(1.9)), both, 1e-12);
    near(
        "longer",
        held(&mut stand, Some(2.1)),
        120.0 / 3.0 / 0.96,
        1e-12,
    );
}
