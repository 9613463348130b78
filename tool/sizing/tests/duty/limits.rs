//! The torque-speed limits of motors, and assumptions for missing data.

use jred_file::model::site::Site;
use jred_report::list::rule_words::assumptions;
use jred_sizing::catalogue::{Catalogue, Motor};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::Assessment;
use jred_sizing::judge::Context;
use jred_sizing::motor::envelope::Envelope;

use super::drives::drive;
use super::{RPM, catalogue, duty_of, read};
use crate::support::{Folder, near, press_text};

/// A motor with every figure of the envelope.
const MOTOR: &str = "\
key,maker,model,rated_torque [N m],rated_speed [rpm],standstill_torque [N m],peak_torque [N m],max_speed [rpm],\
rotor_inertia [kg cm^2],peak_corner_speed [rpm],peak_torque_at_max_speed [N m],source,figures_from
m,Maker,Model,8,3000,9,30,5000,8,2500,10,Sheet,maker
";

pub(super) fn motor() -> Motor {
    let path = Folder::new();
    let path = path.file("motor.csv", MOTOR);
    let mut catalogue = Catalogue::load(Some(&path), None).unwrap();
    catalogue.motors.remove(0)
}

fn check_envelope(motor: &Motor) {
    let envelope = Envelope::of(motor);
    let top = envelope.max_speed();
    let n = 20_000;
    let at = |k: i32| {
        // Not beyond the end by rounding.
        (top * f64::from(k) / f64::from(n)).min(top)
    };
    let peak = motor.peak_torque.unwrap();
    let mut before = (
        envelope.peak_torque(1.0, 0.0),
        envelope.continuous_torque(0.0),
    );
    assert_eq!(before.0, peak);
    let standstill = motor.standstill_torque.or(motor.rated_torque);
    assert_eq!(Some(before.1), standstill);
    for k in 1..=n {
        let now = (
            envelope.peak_torque(1.0, at(k)),
            envelope.continuous_torque(at(k)),
        );
        for (a, b) in [(before.0, now.0), (before.1, now.1)] {
            assert!(b <= a * (1.0 + 1e-14), "{}: rises at {}", motor.key, at(k));
            // The steepest allowed part: the whole peak torque over a tenth of the speed range is 1e-3 per step.
            assert!(a - b <= 1e-3 * peak, "{}: jumps at {}", motor.key, at(k));
        }
        assert!(now.1 <= now.0, "{}: S1 above peak at {}", motor.key, at(k));
        // The same in all quadrants.
        assert_eq!(envelope.peak_torque(1.0, -at(k)), now.0);
        assert_eq!(envelope.continuous_torque(-at(k)), now.1);
        before = now;
    }
    near(
        "rated point",
        envelope.continuous_torque(motor.rated_speed.unwrap()),
        motor.rated_torque.unwrap(),
        1e-12,
    );
    for beyond in [1.000_001, 1.3, 10.0] {
        assert_eq!(
            envelope.peak_torque(1.0, beyond * top),
            0.0,
            "{}",
            motor.key
        );
        assert_eq!(
            envelope.continuous_torque(beyond * top),
            0.0,
            "{}",
            motor.key
        );
    }
}

#[test]
fn envelopes_fall_without_jumps() {
    for motor in &catalogue().motors {
        check_envelope(motor);
    }
    for missing in 0..16u8 {
        check_envelope(&without(missing));
    }
}

/// The motor without some of its four figures.
fn without(missing: u8) -> Motor {
    let mut motor = motor();
    if missing & 1 != 0 {
        motor.max_speed = None;
    }
    if missing & 2 != 0 {
        motor.corner_speed = None;
    }
    if missing & 4 != 0 {
        motor.torque_at_max_speed = None;
    }
    if missing & 8 != 0 {
        motor.standstill_torque = None;
    }
    motor
}

#[test]
fn assumptions_are_reported_exactly_where_a_figure_is_missing() {
    for missing in 0..16u8 {
        let motor = without(missing);
        let envelope = Envelope::of(&motor);
        let said = |word: &str| envelope.assumptions().iter().any(|a| a.starts_with(word));
        assert_eq!(said("maximum speed not given"), motor.max_speed.is_none());
        assert_eq!(
            said("corner of the peak torque not given"),
            motor.corner_speed.is_none()
        );
        assert_eq!(
            said("standstill torque not given"),
            motor.standstill_torque.is_none()
        );
        // If the largest speed is the corner speed this figure is not needed.
        let corner = motor.corner_speed.or(motor.rated_speed);
        let needed = motor.max_speed.or(motor.rated_speed) > corner;
        assert_eq!(
            said("peak torque at maximum speed not given"),
            needed && motor.torque_at_max_speed.is_none(),
            "{missing:04b}"
        );
    }
    // Printed with the result as well.
    let file = read(&press_text());
    let duty = duty_of(&file, 100);
    let motor = without(15);
    let (cycle, site) = (Cycle::new(&duty), Site::default());
    let alone = Catalogue {
        motors: vec![motor.clone()],
        ..Catalogue::default()
    };
    let prepared = alone.prepare(&site);
    let context = Context::new(&cycle, &site, drive(&motor, None), &prepared[0]);
    let judged = Assessment::new(&context, &file.rules);
    let expected = Envelope::of(&motor).assumptions();
    assert!(assumptions(&judged.drive, &judged.assumptions).ends_with(&expected));
}

/// Peak torque given up to a speed that the motor does not reach: above its largest speed the torque is still zero.
#[test]
fn no_torque_beyond_the_largest_speed() {
    for max_speed in [None, Some(3500.0 * RPM)] {
        let mut motor = motor();
        motor.max_speed = max_speed;
        motor.corner_speed = Some(4500.0 * RPM);
        let envelope = Envelope::of(&motor);
        let beyond = 1.1 * envelope.max_speed();
        assert!(beyond < 4500.0 * RPM);
        assert_eq!(
            envelope.peak_torque(1.0, beyond),
            0.0,
            "largest speed {max_speed:?}"
        );
    }
}
