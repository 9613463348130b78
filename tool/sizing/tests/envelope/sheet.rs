//! Envelopes from a data sheet's figures and points, and the effect of another voltage or an amplifier.

use jred_file::model::site::Site;
use jred_sizing::catalogue::Motor;
use jred_sizing::motor::envelope::Envelope;

use super::{RPM, amplifier, bare, budget, near, servo, site};

fn figures() -> Motor {
    Motor {
        rated_torque: Some(4.0),
        rated_speed: Some(300.0),
        standstill_torque: Some(5.0),
        peak_torque: Some(15.0),
        max_speed: Some(600.0),
        corner_speed: Some(400.0),
        torque_at_max_speed: Some(6.0),
        bus_voltage: Some(560.0),
        ..bare()
    }
}

#[test]
fn figures_make_a_level_and_a_line() {
    let envelope = Envelope::of(&figures());
    let torque = |n: f64| envelope.peak_torque(1.0, n);
    assert_eq!(
        [torque(0.0), torque(400.0), torque(500.0)],
        [15.0, 15.0, 10.5]
    );
    near(torque(600.0), 6.0, budget::CLOSED_FORM);
    assert_eq!(torque(600.1), 0.0);
    assert_eq!(envelope.peak_torque(-1.0, 500.0), 10.5);
    assert_eq!(envelope.continuous_torque(150.0), 4.5);
    assert_eq!(envelope.continuous_torque(400.0), 3.0);
    assert_eq!(envelope.assumptions(), [""; 0]);
}

#[test]
fn points_go_before_figures() {
    let mut motor = figures();
    motor.peak_curve = vec![[0.0, 14.0], [450.0, 14.0], [550.0, 4.0]];
    motor.continuous_curve = vec![[0.0, 5.0], [200.0, 4.8], [500.0, 1.0]];
    let envelope = Envelope::of(&motor);
    near(envelope.peak_torque(1.0, 450.0), 14.0, budget::CLOSED_FORM);
    near(envelope.peak_torque(1.0, 500.0), 9.0, budget::CLOSED_FORM);
    near(envelope.max_speed(), 550.0, budget::CLOSED_FORM);
    near(envelope.continuous_torque(350.0), 2.9, budget::CLOSED_FORM);
    // Constant power beyond the last point.
    near(
        envelope.continuous_torque(540.0),
        500.0 / 540.0,
        budget::CLOSED_FORM,
    );
}

#[test]
fn the_s1_torque_keeps_to_power_and_peak() {
    let mut motor = figures();
    motor.max_power = Some(900.0);
    near(
        Envelope::of(&motor).continuous_torque(250.0),
        3.6,
        budget::CLOSED_FORM,
    );
    motor.max_power = None;
    motor.torque_at_max_speed = Some(1.0);
    near(
        Envelope::of(&motor).continuous_torque(600.0),
        1.0,
        budget::CLOSED_FORM,
    );
}

#[test]
fn a_lower_voltage_moves_corner_and_largest_speed() {
    // 380 V mains instead of 460 V, without winding data: speeds in proportion.
    let share = 380.0 / 460.0;
    let envelope = Envelope::at(&figures(), None, &site(560.0 * share));
    let torque = |n: f64| envelope.peak_torque(1.0, n);
    near(envelope.max_speed(), 600.0 * share, budget::CLOSED_FORM);
    near(torque(400.0 * share * 0.9999), 15.0, budget::CLOSED_FORM);
    near(torque(500.0 * share), 10.5, budget::CLOSED_FORM);
    assert!(
        envelope
            .assumptions()
            .iter()
            .any(|a| a.contains("in proportion"))
    );
    // Heat does not depend on the voltage.
    near(envelope.continuous_torque(400.0), 3.0, budget::CLOSED_FORM);
}

#[test]
fn a_higher_voltage_moves_the_corner_but_not_the_largest_speed() {
    let envelope = Envelope::at(&figures(), None, &site(1.2 * 560.0));
    near(envelope.peak_torque(1.0, 479.0), 15.0, budget::CLOSED_FORM);
    near(envelope.peak_torque(1.0, 600.0), 10.5, budget::CLOSED_FORM);
    near(envelope.max_speed(), 600.0, budget::CLOSED_FORM);
    let mut assumed = figures();
    assumed.corner_speed = None;
    let [as_stated, higher] = [560.0, 700.0].map(|u| Envelope::at(&assumed, None, &site(u)));
    for n in [100.0, 299.0, 400.0, 590.0] {
        near(
            higher.peak_torque(1.0, n),
            as_stated.peak_torque(1.0, n),
            0.0,
        );
    }
    assert!(
        higher
            .assumptions()
            .iter()
            .any(|a| a.contains("not raised"))
    );
}

#[test]
fn with_the_winding_known_the_corner_moves_along_its_voltage_line() {
    let mut motor = servo();
    motor.corner_speed = Some(3000.0 * RPM);
    motor.torque_at_max_speed = Some(3.0);
    motor.max_speed = Some(6000.0 * RPM);
    let envelope = Envelope::at(&motor, None, &site(400.0));
    // The speed at which the peak current meets the voltage limit, phase by phase, by bisection.
    let reach = |bus: f64, torque: f64| {
        let i = torque / 0.85;
        let (mut low, mut high) = (0.0, 1e5);
        for _ in 0..200 {
            let n = 0.5 * (low + high);
            let along = 1.9 * i + 0.85 / 3.0 * n;
            let across = 4.0 * n * 7e-3 * i;
            if along.hypot(across) <= bus / 6f64.sqrt() {
                low = n;
            } else {
                high = n;
            }
        }
        low
    };
    let corner = 3000.0 * RPM * reach(400.0, 9.0) / reach(560.0, 9.0);
    near(
        envelope.peak_torque(1.0, corner * (1.0 - 1e-9)),
        9.0,
        budget::CLOSED_FORM,
    );
    assert!(envelope.peak_torque(1.0, corner * (1.0 + 1e-6)) < 9.0);
    let end = 6000.0 * RPM * reach(400.0, 3.0) / reach(560.0, 3.0);
    near(envelope.peak_torque(1.0, end), 3.0, budget::CLOSED_FORM);
    near(
        envelope.max_speed(),
        6000.0 * RPM * 400.0 / 560.0,
        budget::CLOSED_FORM,
    );
}

#[test]
fn a_stated_corner_says_how_much_voltage_the_drive_makes_use_of() {
    let mut motor = servo();
    motor.corner_speed = Some(2500.0 * RPM);
    let envelope = Envelope::of(&motor);
    near(
        envelope.peak_torque(1.0, 2500.0 * RPM * (1.0 - 1e-9)),
        9.0,
        budget::CLOSED_FORM,
    );
    assert!(envelope.peak_torque(1.0, 2501.0 * RPM) < 9.0);
    // From there along the line of the voltage at the corner.
    let i: f64 = 9.0 / 0.85;
    let needed = |n: f64, i: f64| (1.9 * i + 0.85 / 3.0 * n).hypot(4.0 * n * 7e-3 * i);
    let voltage = needed(2500.0 * RPM, i);
    for rpm in [2600.0, 3200.0, 4000.0] {
        let torque = envelope.peak_torque(1.0, rpm * RPM);
        near(
            needed(rpm * RPM, torque / 0.85),
            voltage,
            budget::CLOSED_FORM,
        );
    }
}

#[test]
fn so_little_voltage_that_the_peak_is_not_reached_at_standstill() {
    let mut motor = figures();
    motor.winding = servo().winding;
    motor.winding.resistance = Some(60.0);
    motor.winding.torque_constant = Some(1.5);
    let envelope = Envelope::at(&motor, None, &site(200.0));
    // 200 V/√6 over 30 Ω and 1.5 N·m/A.
    near(
        envelope.peak_torque(1.0, 0.0),
        1.5 * 200.0 / 6f64.sqrt() / 30.0,
        budget::CLOSED_FORM,
    );
}

#[test]
fn an_amplifier_caps_the_torque_and_brings_its_voltage() {
    let mut motor = figures();
    motor.winding.torque_constant = Some(1.0);
    let on = |a| Envelope::at(&motor, Some(&a), &Site::default());
    near(
        on(amplifier(10.0, None)).peak_torque(1.0, 100.0),
        10.0,
        budget::CLOSED_FORM,
    );
    near(
        on(amplifier(10.0, None)).peak_torque(1.0, 550.0),
        8.25,
        budget::CLOSED_FORM,
    );
    near(
        on(amplifier(3.0, None)).standstill(),
        3.0,
        budget::CLOSED_FORM,
    );
    near(
        on(amplifier(99.0, Some(280.0))).max_speed(),
        300.0,
        budget::CLOSED_FORM,
    );
    // The site's voltage is used.
    let at = Envelope::at(&motor, Some(&amplifier(99.0, Some(280.0))), &site(560.0));
    near(at.max_speed(), 600.0, budget::CLOSED_FORM);
    motor.winding.torque_constant = None;
    let unknown = Envelope::at(&motor, Some(&amplifier(3.0, None)), &Site::default());
    near(unknown.peak_torque(1.0, 0.0), 15.0, budget::CLOSED_FORM);
    assert!(
        unknown
            .assumptions()
            .iter()
            .any(|a| a.contains("not limited by the amplifier"))
    );
}

/// A motor at a supply far above the voltage of its figures is not refused, but reported.
#[test]
fn a_supply_of_another_class_is_remarked_upon() {
    let mut motor = figures();
    motor.bus_voltage = Some(48.0);
    let remarks = |voltage: f64| {
        let site = Site {
            bus_voltage: Some(voltage),
            ..Site::default()
        };
        let envelope = Envelope::at(&motor, None, &site);
        let remarks = envelope.assumptions().into_iter();
        remarks
            .filter(|a| a.contains("more than 4/3 of the voltage"))
            .count()
    };
    assert_eq!(
        [24.0, 48.0, 63.0, 65.0, 566.0].map(remarks),
        [0, 0, 0, 1, 1]
    );
}

#[test]
fn nothing_known_is_no_limit() {
    let envelope = Envelope::of(&bare());
    assert_eq!(envelope.max_speed(), f64::INFINITY);
    assert_eq!(envelope.peak_torque(1.0, 1e6), f64::INFINITY);
    assert_eq!(envelope.continuous_torque(10.0), f64::INFINITY);
    assert_eq!(envelope.standstill(), f64::INFINITY);
    assert_eq!(envelope.assumptions(), [""; 0]);
}
