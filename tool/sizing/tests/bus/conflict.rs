//! Contradictory voltages of a bus.

use jred_sizing::bus::Need;
use jred_sizing::bus::conflict::Conflict;
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::supply::BusData;

const DATA: BusData = BusData {
    voltage: Some(560.0),
    capacitance: Some(2e-6),
    chopper_voltage: Some(780.0),
    max_voltage: Some(820.0),
    min_resistance: None,
    regenerative: false,
    resistor: None,
};

/// Every order of the three voltages; a resistor is proposed only in the right one.
#[test]
fn three_voltages_in_order() {
    let curve = PowerCurve::new(
        [[0.0, 900.0], [1.0, 900.0], [1.0, -700.0], [2.0, -700.0]],
        2.0,
    );
    let [low, middle, high] = [500.0, 600.0, 700.0];
    for (supply, chopper, highest, right) in [
        (low, middle, high, true),
        (low, high, middle, false),
        (low, middle, middle, false),
        (middle, low, high, false),
        (middle, middle, high, false),
        (middle, high, low, false),
        (middle, high, middle, false),
        (high, low, middle, false),
        (high, middle, low, false),
    ] {
        let data = BusData {
            voltage: Some(supply),
            chopper_voltage: Some(chopper),
            max_voltage: Some(highest),
            ..DATA
        };
        let case = format!("{supply} {chopper} {highest}: {:?}", data.conflict());
        let expected = match () {
            () if supply >= highest => Some(Conflict::Supply { supply, highest }),
            () if chopper >= highest => Some(Conflict::LateChopper { chopper, highest }),
            () if chopper <= supply => Some(Conflict::EarlyChopper { chopper, supply }),
            () => None,
        };
        assert_eq!(data.conflict(), expected, "{case}");
        assert_eq!(expected.is_none(), right, "{case}");
        assert_eq!(Need::of(&data, &curve).is_some(), right, "{case}");
        // A supply that takes energy back needs no chopper.
        let back = BusData {
            regenerative: true,
            ..data
        };
        assert_eq!(back.conflict().is_some(), supply >= highest, "{case}");
    }
    let unknown = BusData {
        max_voltage: None,
        ..DATA
    };
    assert_eq!(unknown.conflict(), None);
}
