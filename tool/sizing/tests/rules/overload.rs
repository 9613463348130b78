//! The overload of an amplifier: known only with the motor's currents and the amplifier's time at peak current.

use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_sizing::catalogue::{Amplifier, Drive};
use jred_sizing::judge::Context;
use jred_sizing::motor::envelope::MotorLimits;

use super::Stand;

fn found(torque_constant: Option<f64>, rated: f64, peak_time: Option<f64>) -> Finding {
    let mut stand = Stand::press();
    stand.motor.winding.torque_constant = torque_constant;
    let amplifier = Amplifier {
        rated_current: rated,
        peak_current: 1e3,
        peak_time,
        ..Amplifier::default()
    };
    let site = &stand.file.site;
    let prepared = MotorLimits::new(&stand.motor, Some(&amplifier), site);
    let drive = Drive {
        amplifier: Some(&amplifier),
        ..stand.drive(true)
    };
    let context = Context::new(&stand.cycle, site, drive, &prepared);
    context
        .findings(&stand.file.rules)
        .get(Rule::Overload)
        .unwrap()
}

#[test]
fn overload_needs_currents_and_a_time() {
    // About 30 N·m of the motor at 1.2 N·m/A.
    let [constant, time] = [Some(1.2), Some(2.0)];
    assert!(!found(None, 5.0, time).is_known());
    assert!(!found(constant, 1.0, None).is_known());
    let known = found(constant, 1.0, time);
    assert!(known.is_known() && known.value > 0.0, "{known:?}");
    // Never above the rated current: no overload, whatever else is missing.
    let never = found(constant, 900.0, None);
    assert!(never.is_known() && never.value.abs() == 0.0, "{never:?}");
}
