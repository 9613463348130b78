//! Every rule as text: unit, reference of the limit, and missing data.

use jred_file::model::rules::RuleVerdict;
use jred_file::model::supply::BrakeResistor;
use jred_file::units::RPM;
use jred_report::list::rule_words::note;
use jred_sizing::catalogue::{Amplifier, Motor};
use jred_sizing::motor::envelope::MotorLimits;

use crate::support::rows;

use super::{Check, Context, Drive, Finding, Rule, RuleSet, Stand, near, press_text};

/// A drive with the data of every rule: on its own bus, with a brake, limits of housing and play, and a resistor that switches on.
fn full() -> (Stand, Amplifier) {
    let text = format!(
        "{}\n[tool]\npoint = \"slider\"\nplay = \"1 mm\"\n[stiffness]\nshaft = \"9000 N m/rad\"\nbacklash = \"6 arcmin\"\n",
        press_text()
    );
    let mut stand = Stand::new(&text);
    let site = &mut stand.file.site;
    site.surroundings.housing = Some(80.0);
    site.bus_voltage = Some(560.0);
    let supply = &mut site.supply;
    supply.capacitance = Some(1e-6);
    supply.chopper_voltage = Some(600.0);
    supply.max_voltage = Some(800.0);
    supply.min_resistance = Some(10.0);
    supply.brake_resistor = Some(BrakeResistor {
        resistance: 47.0,
        power: 900.0,
        peak_power: Some(9e3),
        pulse_energy: Some(9e3),
    });
    stand.motor.brake = Some(jred_sizing::catalogue::Brake {
        torque: 12.0,
        closing_time: Some(0.03),
        work: Some(500.0),
        ..Default::default()
    });
    let motor = &mut stand.motor;
    motor.max_bus_voltage = Some(900.0);
    motor.winding.torque_constant = Some(1.2);
    motor.winding.resistance = Some(0.8);
    motor.thermal.winding_resistance = Some(0.2);
    motor.thermal.housing_resistance = Some(0.4);
    motor.thermal.max_temperature = Some(155.0);
    stand.gearbox.stiffness = Some(4000.0);
    stand.gearbox.backlash = Some(1e-3);
    stand.gearbox.max_radial_load = Some(5e3);
    stand.gearbox.shock_factors = vec![[10_000.0, 1.0], [20_000.0, 1.5]];
    let amplifier = Amplifier {
        key: "a".to_owned(),
        rated_current: 6.0,
        peak_current: 60.0,
        peak_time: Some(3.0),
        max_voltage: Some(850.0),
        bus_voltage: Some(560.0),
        ..Amplifier::default()
    };
    (stand, amplifier)
}

/// Findings and checks of the drive after a change of its data.
fn judged(change: impl Fn(&mut Stand, &mut Amplifier)) -> Vec<(Rule, Finding, Check)> {
    let (mut stand, mut amplifier) = full();
    change(&mut stand, &mut amplifier);
    let prepared = MotorLimits::new(&stand.motor, Some(&amplifier), &stand.file.site);
    let drive = Drive {
        amplifier: Some(&amplifier),
        ..stand.drive(true)
    };
    let rules = RuleSet::default();
    let context = Context::new(&stand.cycle, &stand.file.site, drive, &prepared);
    let findings = context.findings(&rules);
    let checks = context.checks(&rules).into_iter();
    checks
        .map(|check| (check.id, findings.get(check.id).unwrap(), check))
        .collect()
}

/// The check of the rule with this name in [`Rule`].
fn found_of<'a>(found: &'a [(Rule, Finding, Check)], name: &str) -> &'a (Rule, Finding, Check) {
    let of = found.iter().find(|(rule, ..)| format!("{rule:?}") == name);
    of.unwrap_or_else(|| panic!("no {name} in {found:?}"))
}

/// The figure in its unit is the finding, and the limit a share of the rating that the note names.
#[test]
fn every_rule_has_its_unit_and_names_its_limit() {
    let found = judged(|_, _| {});
    let cases = "
        RmsTorque => N m => S1 torque at mean speed
        PeakTorque => N m => peak torque at that speed
        Speed => rpm => maximum speed
        HoldingTorque => N m => standstill torque
        BrakeTorque => N m => brake torque
        BrakeWork => J => work of the brake in one emergency stop
        InertiaRatio => => times the rotor's inertia
        WindingTemperature => K => rise from 40 °C to the maximum temperature of the winding
        HousingTemperature => K => rise from 40 °C to the maximum temperature of the housing
        GearboxPeak => N m => acceleration torque T2B
        GearboxCubicMean => N m => rated torque T2N
        GearboxEmergency => N m => emergency torque
        GearboxMeanSpeed => rpm => rated input speed n1N
        GearboxSpeed => rpm => maximum input speed
        GearboxCycles => per hour => number up to which the maker gives shock factors
        GearboxRadial => N => radial load that the output shaft bears
        BeltPretension => N => pretension of the belt of the drive train
        RmsCurrent => A => rated current of the amplifier
        PeakCurrent => A => peak current of the amplifier
        Overload => A^2 s => (peak current² − rated current²)·peak time of the amplifier
        MotorVoltage => V => largest bus voltage of the motor
        AmplifierVoltage => V => largest bus voltage of the amplifier
        BusVoltage => V => maximum voltage of the DC bus
        BrakeResistance => Ohm => minimum resistance of the chopper
        ResistorPower => W => continuous power of the brake resistor
        ResistorPeak => W => peak power of the brake resistor
        ResistorPulse => J => pulse energy of the brake resistor
        NaturalFrequency => Hz => drive frequency
        Backlash => mm => backlash allowed at slider
    ";
    for [rule, unit, rating] in rows(cases) {
        let (_, finding, check) = found_of(&found, &rule);
        let scale = match unit.as_str() {
            "rpm" => RPM,
            "mm" => 1e-3,
            _ => 1.0,
        };
        assert!(finding.is_known(), "{check:?}");
        assert_eq!(check.unit, unit, "{rule}");
        near(
            &rule,
            check.value.unwrap_or(f64::INFINITY),
            finding.value / scale,
            1e-12,
        );
        assert!(note(check).contains(&rating), "{rule}: {}", note(check));
        assert_ne!(check.verdict, RuleVerdict::NotChecked, "{rule}");
    }
    // All except the torque without acceleration, which is off without a limit, those of a hot or a high site, and of belts, screws and pinions with
    // their limits.
    assert_eq!(found.len(), Rule::COUNT - 1 - 3 - 7);
}

/// A rule without its figure is not checked, and named; all else is unchanged.
#[test]
fn a_missing_figure_is_named() {
    type Change = fn(&mut Stand, &mut Amplifier);
    let changes: [(Rule, Change, &str); 14] = [
        (
            Rule::Speed,
            |s, _| {
                (s.motor.max_speed, s.motor.rated_speed, s.motor.corner_speed) = (None, None, None);
            },
            "maximum speed",
        ),
        (
            Rule::GearboxPeak,
            |s, _| s.gearbox.peak_torque = None,
            "acceleration torque T2B",
        ),
        (
            Rule::GearboxCubicMean,
            |s, _| s.gearbox.rated_torque = None,
            "rated torque T2N",
        ),
        (
            Rule::GearboxEmergency,
            |s, _| s.gearbox.emergency_torque = None,
            "emergency torque",
        ),
        (
            Rule::GearboxMeanSpeed,
            |s, _| s.gearbox.rated_speed = None,
            "rated input speed n1N",
        ),
        (
            Rule::GearboxSpeed,
            |s, _| s.gearbox.max_speed = None,
            "maximum input speed",
        ),
        (
            Rule::Overload,
            |_, a| a.peak_time = None,
            "time for which the amplifier can supply its peak current",
        ),
        (
            Rule::PeakCurrent,
            |s, _| s.motor.winding.torque_constant = None,
            "torque constant of the motor",
        ),
        (
            Rule::NaturalFrequency,
            |s, _| s.gearbox.stiffness = None,
            "torsional stiffness of the gearbox",
        ),
        (
            Rule::Backlash,
            |s, _| s.gearbox.backlash = None,
            "backlash of the gearbox",
        ),
        (
            Rule::WindingTemperature,
            |s, _| s.motor.thermal.max_temperature = None,
            "maximum temperature of the winding",
        ),
        (
            Rule::ResistorPower,
            |s, a| (s.file.site.supply.chopper_voltage, a.chopper_voltage) = (None, None),
            "voltage at which the brake resistor switches on",
        ),
        (
            Rule::ResistorPeak,
            |s, _| {
                s.file
                    .site
                    .supply
                    .brake_resistor
                    .as_mut()
                    .unwrap()
                    .peak_power = None;
            },
            "peak power of the brake resistor",
        ),
        (
            Rule::BusVoltage,
            |s, a| {
                (
                    s.file.site.supply.max_voltage,
                    a.max_voltage,
                    s.motor.max_bus_voltage,
                ) = (None, None, None);
            },
            "maximum voltage of the DC bus",
        ),
    ];
    for (rule, change, missing) in changes {
        let found = judged(change);
        let (_, _, check) = found.iter().find(|(found, ..)| *found == rule).unwrap();
        assert_eq!(check.verdict, RuleVerdict::NotChecked, "{check:?}");
        let words = format!("no data: {missing}");
        assert!(note(check).starts_with(&words), "{rule:?}: {}", note(check));
        assert_eq!(check.limit, None);
    }
}

/// An impossible thermal figure, which a program may pass, is ignored.
#[test]
fn a_thermal_figure_that_is_none_is_not_used() {
    type Field = fn(&mut Motor) -> &mut Option<f64>;
    let with = |change: &dyn Fn(&mut Motor)| {
        let found = judged(|stand, _| change(&mut stand.motor));
        let winding = found
            .iter()
            .find(|(rule, ..)| *rule == Rule::WindingTemperature);
        let (_, finding, check) = winding.unwrap().clone();
        (finding.value.to_bits(), check.unit, note(&check))
    };
    let fields: [Field; 4] = [
        |motor| &mut motor.thermal.winding_resistance,
        |motor| &mut motor.thermal.housing_resistance,
        |motor| &mut motor.thermal.winding_time,
        |motor| &mut motor.winding.resistance,
    ];
    for field in fields {
        let none = with(&|motor| *field(motor) = None);
        for figure in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            assert_eq!(
                with(&|motor| *field(motor) = Some(figure)),
                none,
                "{figure}"
            );
        }
    }
}

/// Peaks are named after the part with the lower limit; at equal limits after the motor.
#[test]
fn the_peak_current_is_of_the_weaker_part() {
    for (motor, whose, limit) in [
        (59.0, "motor", 59.0),
        (60.0, "motor", 60.0),
        (61.0, "amplifier", 60.0),
    ] {
        let found = judged(|stand, _| stand.motor.winding.peak_current = Some(motor));
        let (_, finding, check) = found
            .iter()
            .find(|(rule, ..)| *rule == Rule::PeakCurrent)
            .unwrap();
        assert_eq!(finding.rating, limit);
        assert!(
            note(check).contains(&format!("peak current of the {whose}")),
            "{}",
            note(check)
        );
    }
}

/// A figure is reported with its position or method.
#[test]
fn places_are_said() {
    let found = judged(|_, _| {});
    let cases = "
        PeakTorque => ␣rpm, where the cycle comes closest to the envelope
        BrakeTorque => torque at standstill without the help of friction
        GearboxEmergency => if the motor brakes with its peak torque where the machine has
        NaturalFrequency => the motor holding its position at the largest inertia of the cycle
        Backlash => at the largest transfer function of slider in the motion
        MotorVoltage => bus voltage of [supply]
        BusVoltage => ␣J are fed back per cycle
        WindingTemperature => duty type S5
    ";
    for [rule, place] in rows(cases) {
        let (_, _, check) = found_of(&found, &rule);
        assert!(note(check).contains(&place), "{rule}: {}", note(check));
    }
}
