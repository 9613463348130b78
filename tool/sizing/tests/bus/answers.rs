//! Shortages of a bus, and cures.

mod cures;
mod judged;

use jred_file::model::supply::{BrakeResistor, Supply};
use jred_sizing::bus::analysis::{BusAnalysis, BusAxis};
use jred_sizing::bus::curve::{PowerCurve, StopPower};
use jred_sizing::bus::supply::BusData;
use jred_sizing::catalogue::{Catalogue, Motor};

const NOTHING: Supply = Supply {
    given: true,
    capacitance: None,
    chopper_voltage: None,
    max_voltage: None,
    min_resistance: None,
    regenerative: false,
    brake_resistor: None,
};

const RESISTOR: BrakeResistor = BrakeResistor {
    resistance: 47.0,
    power: f64::INFINITY,
    peak_power: None,
    pulse_energy: None,
};

fn answer(curves: &[PowerCurve], supply: &Supply, only_in_step: bool) -> BusAnalysis {
    let axis = |curve: &PowerCurve| BusAxis {
        title: String::new(),
        drive: String::new(),
        curve: curve.clone(),
        data: BusData::new(supply, Some(560.0), None, &Motor::default()),
        loses: true,
        holds: true,
    };
    let axes = curves.iter().map(axis).collect();
    BusAnalysis::new(axes, only_in_step, supply, &Catalogue::default(), &()).unwrap()
}

/// Without the peak torque of a motor, the energy of its stop is unknown: refused, and never taken as zero.
#[test]
fn an_unknown_stop_is_refused() {
    let supply = Supply::default();
    for peak in [f64::NAN, f64::INFINITY] {
        let stop = StopPower { peak, energy: 1.0 };
        let axis = BusAxis {
            title: "press".to_owned(),
            drive: "m".to_owned(),
            curve: PowerCurve::new([], 1.0).with_stop(stop),
            data: BusData::new(&supply, Some(560.0), None, &Motor::default()),
            loses: true,
            holds: true,
        };
        let found = BusAnalysis::new(vec![axis], true, &supply, &Catalogue::default(), &());
        let message = found.unwrap_err().to_string();
        assert!(
            message.contains("the peak torque of m is missing"),
            "{message}"
        );
    }
}
