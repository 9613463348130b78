//! The winding's limits against a search over all currents.

use jred_file::model::site::Site;
use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Motor, Winding};
use jred_sizing::motor::envelope::{Envelope, MotorLimits};

use super::{RPM, bare, budget, near, servo, site};

/// The three-phase machine, phase by phase: amplitudes of the phase quantities, no line-to-line figure.
struct Phases {
    resistance: f64,
    inductance: f64,
    flux: f64,
    pairs: f64,
    /// Largest amplitude of the phase voltage: the circle inside the bridge's hexagon, U/√3.
    voltage: f64,
    /// Largest amplitude of the phase current.
    current: f64,
}

impl Phases {
    fn of(motor: &Motor, bus: f64, peak: f64) -> Self {
        let winding = &motor.winding;
        let pairs = winding.pole_pairs.unwrap();
        // A line-to-line RMS voltage per speed, as the amplitude of a phase's flux linkage times p.
        let flux = winding.voltage_constant.unwrap() * 2f64.sqrt() / 3f64.sqrt() / pairs;
        Self {
            resistance: winding.resistance.unwrap() / 2.0,
            inductance: winding.inductance.unwrap() / 2.0,
            flux,
            pairs,
            voltage: bus / 3f64.sqrt(),
            current: peak / winding.torque_constant.unwrap() * 2f64.sqrt(),
        }
    }

    /// 3/2·p·ψ·i_q.
    fn torque(&self, q: f64) -> f64 {
        1.5 * self.pairs * self.flux * q
    }

    fn allows(&self, [d, q]: [f64; 2], speed: f64) -> bool {
        let electrical = self.pairs * speed;
        let v_d = self.resistance * d - electrical * self.inductance * q;
        let v_q = self.resistance * q + electrical * (self.inductance * d + self.flux);
        v_d.hypot(v_q) <= self.voltage && d.hypot(q) <= self.current
    }

    /// The largest i_q along (`sign` 1) or against the speed at this i_d: a scan, then bisection. `None`: no current.
    fn across(&self, d: f64, speed: f64, sign: f64) -> Option<f64> {
        let at = |k: u32| [d, sign * self.current * f64::from(k) / 300.0];
        let last = (0..=300).rev().find(|k| self.allows(at(*k), speed))?;
        let (mut low, mut high) = (at(last)[1], at(last + 1)[1]);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.allows([d, middle], speed) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low.abs())
    }

    /// The largest torque along or against the speed: at i_d = 0 only, or over all i_d < 0, refining the best.
    fn largest(&self, speed: f64, sign: f64, weakens: bool) -> f64 {
        if !weakens {
            return self
                .across(0.0, speed, sign)
                .map_or(0.0, |q| self.torque(q));
        }
        let (mut best, mut centre, mut span) = (0.0f64, -0.5 * self.current, 0.5 * self.current);
        for _ in 0..12 {
            let middle = centre;
            for k in -100..=100 {
                let d = (middle + span * f64::from(k) / 100.0).clamp(-self.current, 0.0);
                if let Some(q) = self.across(d, speed, sign)
                    && q > best
                {
                    (best, centre) = (q, d);
                }
            }
            span *= 0.1;
        }
        self.torque(best)
    }
}

fn speeds(envelope: &Envelope) -> impl Iterator<Item = f64> {
    let top = envelope.max_speed();
    (0..=24).map(move |k| top * 0.999 * f64::from(k) / 24.0)
}

fn compare(motor: &Motor, site: &Site, bus: f64, weakens: bool) {
    let envelope = Envelope::at(motor, None, site);
    let peak = motor.peak_torque.unwrap();
    let phases = Phases::of(motor, bus, peak);
    for speed in speeds(&envelope) {
        for sign in [1.0, -1.0] {
            let expected = phases.largest(speed, sign, weakens).min(peak);
            let found = envelope.peak_torque(sign, speed);
            assert!(
                (found - expected).abs() < budget::GRID_SEARCH * peak,
                "{found} and {expected} N·m at {} rpm, sign {sign}",
                speed / RPM
            );
        }
    }
}

#[test]
fn a_servo_motor_reaches_what_a_search_over_its_currents_finds() {
    compare(&servo(), &Site::default(), 560.0, false);
    for bus in [200.0, 325.0, 680.0] {
        compare(&servo(), &site(bus), bus, false);
    }
}

#[test]
fn with_its_field_weakened_too() {
    // A short-circuit current above and below the peak current.
    for (inductance, peak) in [(14e-3, 9.0), (60e-3, 9.0), (30e-3, 6.0)] {
        let mut motor = servo();
        motor.winding.inductance = Some(inductance);
        motor.peak_torque = Some(peak);
        let base = Envelope::of(&motor).max_speed();
        motor.max_speed = Some(1.6 * base);
        let envelope = Envelope::of(&motor);
        assert!(
            envelope.max_speed() > 1.01 * base,
            "{}",
            envelope.max_speed() / base
        );
        compare(&motor, &Site::default(), 560.0, true);
        let words = envelope.assumptions().join("; ");
        assert!(words.contains("field weakening assumed: "), "{words}");
    }
}

#[test]
fn where_the_field_cannot_be_weakened_enough_the_speed_ends() {
    // By the peak current, and for a winding of high resistance, in which a smaller weakening current is best, by the voltage.
    for (inductance, resistance) in [(7e-3, 3.8), (7e-3, 60.0), (14e-3, 90.0)] {
        let mut motor = servo();
        motor.max_speed = Some(1e4);
        motor.winding.inductance = Some(inductance);
        motor.winding.resistance = Some(resistance);
        let envelope = Envelope::of(&motor);
        let phases = Phases::of(&motor, 560.0, 9.0);
        let held = |speed: f64| {
            (0..=20_000).any(|k| {
                let d = -phases.current * f64::from(k) / 2e4;
                phases.allows([d, 0.0], speed)
            })
        };
        let top = envelope.max_speed();
        assert!(
            held(top * (1.0 - 1e-6)) && !held(top * (1.0 + 1e-6)),
            "{top}"
        );
        assert_eq!(envelope.peak_torque(1.0, 1.001 * top), 0.0);
    }
}

/// Whether the field is weakened follows from the data sheet's own voltage: only there a given speed above the winding's no-load speed, V/k_e with
/// the amplitude of the phase voltage, shows that the sheet assumes it. The actual supply does not matter.
#[test]
fn the_sheets_voltage_says_whether_the_field_is_weakened() {
    let mut motor = servo();
    // Largest line-to-line RMS voltage: 560 V/√2.
    let no_load = 560.0 / 2f64.sqrt() / (0.85 / 3f64.sqrt());
    let weakens = |motor: &Motor, bus: f64| {
        let prepared = MotorLimits::new(motor, None, &site(bus));
        prepared.circuit.unwrap().weakens
    };
    for bus in [280.0, 560.0, 1120.0] {
        motor.max_speed = Some(0.9 * no_load);
        assert!(!weakens(&motor, bus), "{bus} V");
        motor.max_speed = Some(1.1 * no_load);
        assert!(weakens(&motor, bus), "{bus} V");
    }
}

/// Above the speed at which the magnets take the whole voltage there is no current in either direction; nor at a speed of NaN.
#[test]
fn beyond_the_no_load_speed_there_is_no_current() {
    let circuit = MotorLimits::new(&servo(), None, &Site::default())
        .circuit
        .unwrap();
    assert!(!circuit.weakens);
    for braking in [false, true] {
        let at = |share: f64| circuit.largest_current(share * circuit.no_load_speed(), braking);
        assert!(at(0.9) > 0.0);
        for share in [1.001, 1.5, 100.0, f64::NAN] {
            assert_eq!(at(share).to_bits(), 0, "{share} times the no-load speed");
        }
    }
}

/// A winding without reactance cannot weaken its field: a sheet with a corner and a speed above the no-load speed of that corner contains more than
/// the winding, and is used. Up to that speed the winding is used.
#[test]
fn a_sheet_beyond_its_winding_is_used() {
    let mut motor = direct_current();
    motor.peak_torque = Some(1.0);
    motor.corner_speed = Some(200.0);
    // 20 A at 0.4 Ω, and 0.05 V·s/rad at the corner: 18 V, and so 360 rad/s without a load.
    let from_winding = |motor: &Motor| {
        MotorLimits::new(motor, None, &Site::default())
            .circuit
            .is_some()
    };
    motor.max_speed = Some(350.0);
    assert!(from_winding(&motor));
    motor.max_speed = Some(370.0);
    assert!(!from_winding(&motor));
    // Without a corner only the winding is used.
    motor.corner_speed = None;
    motor.max_speed = Some(1000.0);
    assert!(from_winding(&motor));
}

fn direct_current() -> Motor {
    Motor {
        winding: Winding {
            commutation: Commutation::Block,
            torque_constant: Some(0.05),
            resistance: Some(0.4),
            inductance: Some(1e-3),
            ..Winding::default()
        },
        bus_voltage: Some(24.0),
        ..bare()
    }
}

#[test]
fn a_direct_current_motor_has_a_straight_line_from_stall_to_no_load() {
    let motor = direct_current();
    let envelope = Envelope::of(&motor);
    let (stall, no_load) = (0.05 * 24.0 / 0.4, 24.0 / 0.05);
    near(envelope.max_speed(), no_load, budget::CLOSED_FORM);
    for k in 0..=10 {
        let share = f64::from(k) / 10.0;
        let speed = share * no_load;
        let found = envelope.peak_torque(1.0, speed);
        assert!((found - stall * (1.0 - share)).abs() < budget::CLOSED_FORM * stall);
        // When braking, the magnets' voltage adds to the current.
        let braking = envelope.peak_torque(-1.0, speed);
        let expected = if k == 0 { stall } else { stall * (1.0 + share) };
        near(braking, expected, budget::CLOSED_FORM);
        near(envelope.peak_torque(1.0, -speed), braking, 0.0);
    }
    assert_eq!(envelope.peak_torque(1.0, no_load * 1.001), 0.0);
    assert_eq!(envelope.peak_torque(-1.0, no_load * 1.001), 0.0);
}

#[test]
fn the_peak_current_cuts_the_line() {
    let mut motor = direct_current();
    motor.winding.peak_current = Some(20.0);
    let envelope = Envelope::of(&motor);
    // 20 A leave 24 − 8 V: 320 rad/s.
    near(envelope.peak_torque(1.0, 0.0), 1.0, budget::CLOSED_FORM);
    near(envelope.peak_torque(1.0, 319.0), 1.0, budget::CLOSED_FORM);
    near(envelope.peak_torque(1.0, 400.0), 0.5, budget::CLOSED_FORM);
    near(envelope.peak_torque(-1.0, 400.0), 1.0, budget::CLOSED_FORM);
    let words = envelope.assumptions().join("; ");
    assert!(words.contains("peak torque not given"), "{words}");
}

#[test]
fn a_hot_winding_reaches_less() {
    let mut motor = direct_current();
    let cold = Envelope::of(&motor).peak_torque(1.0, 0.0);
    motor.thermal.max_temperature = Some(120.0);
    let envelope = Envelope::of(&motor);
    near(
        cold / envelope.peak_torque(1.0, 0.0),
        1.0 + 0.00393 * 100.0,
        budget::CLOSED_FORM,
    );
    let words = envelope.assumptions().join("; ");
    assert!(
        words.contains("winding resistance at maximum temperature"),
        "{words}"
    );
}

#[test]
fn without_inductance_a_three_phase_winding_is_not_guessed() {
    let mut motor = servo();
    motor.winding.inductance = None;
    let envelope = Envelope::of(&motor);
    near(envelope.max_speed(), 4000.0 * RPM, budget::CLOSED_FORM);
    let words = envelope.assumptions().join("; ");
    assert!(words.contains("using the rated speed"), "{words}");
}

/// Whether the field is weakened is assumed from the largest speed, and reported either way: 560 V turn this winding at up to 9000 rpm without
/// torque.
#[test]
fn weakening_is_said_either_way() {
    for (rpm, weakens) in [(3000.0, false), (12_000.0, true)] {
        let motor = Motor {
            max_speed: Some(rpm * RPM),
            ..servo()
        };
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        assert_eq!(prepared.circuit.unwrap().weakens, weakens);
        let said = prepared.envelope.assumptions().join("; ");
        assert_eq!(
            said.contains("field weakening assumed: the maximum speed is above"),
            weakens,
            "{said}"
        );
        assert_eq!(
            said.contains("no field weakening assumed"),
            !weakens,
            "{said}"
        );
    }
}
