//! The torque-speed envelope of a motor: from its winding, from its data sheet, at another voltage, on an amplifier. References come from grid
//! searches or closed forms, without the tool's formulas.
// Given values must be returned exactly.
#![allow(clippy::float_cmp)]

mod circuit;
mod current;
mod cuts;
mod direction;
mod golden;
mod pieces;
mod sheet;
mod total;

use jred_file::model::site::Site;
use jred_file::units::RPM;
use jred_sizing::catalogue::{Amplifier, Motor, Winding};

use crate::support::budget;

/// A motor with rotor data only.
fn bare() -> Motor {
    Motor {
        key: "m".into(),
        rotor_inertia: 1e-4,
        from_maker: true,
        ..Motor::default()
    }
}

/// A servo motor with its winding: 2.3 N·m, 4 A, four pole pairs, 560 V.
fn servo() -> Motor {
    Motor {
        rated_torque: Some(2.1),
        rated_speed: Some(4000.0 * RPM),
        standstill_torque: Some(2.3),
        peak_torque: Some(9.0),
        winding: Winding {
            torque_constant: Some(0.85),
            voltage_constant: Some(0.85 / 3f64.sqrt()),
            resistance: Some(3.8),
            inductance: Some(14e-3),
            pole_pairs: Some(4.0),
            ..Winding::default()
        },
        bus_voltage: Some(560.0),
        ..bare()
    }
}

fn amplifier(peak_current: f64, bus_voltage: Option<f64>) -> Amplifier {
    Amplifier {
        key: "a".into(),
        rated_current: peak_current / 2.0,
        peak_current,
        bus_voltage,
        ..Amplifier::default()
    }
}

fn site(bus_voltage: f64) -> Site {
    Site {
        bus_voltage: Some(bus_voltage),
        ..Site::default()
    }
}

/// Two figures that must agree to a share of the larger; zero agrees only with zero.
#[track_caller]
fn near(found: f64, expected: f64, budget: f64) {
    let size = found.abs().max(expected.abs());
    assert!(
        (found - expected).abs() <= budget * size,
        "{found} is not {expected} to {budget:e}: {:e}",
        (found - expected) / size
    );
}
