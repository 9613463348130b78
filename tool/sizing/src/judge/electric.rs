//! Current of the amplifier, energy of the DC bus, brake resistor.

use std::borrow::Cow;

use super::{Context, Grounds, Record};
use crate::bus::curve::PowerCurve;
use crate::bus::store::BusFigures;
use crate::bus::supply::BusData;
use crate::bus::{self, Need};
use crate::catalogue::{Amplifier, Resistor};
use crate::judge::overload;
use crate::thermal::mean::rms_current;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;

/// Measures currents; returns the largest (A) if the rules need it; NaN if the current of a torque is unknown.
pub(super) fn measure(context: &Context, findings: &mut impl Record) -> Option<f64> {
    let motor_peak = context.drive.motor.winding.peak_current;
    let Some(amplifier) = context.drive.amplifier else {
        findings.set(Rule::RmsCurrent, Finding::UNKNOWN);
        let limit = motor_peak?;
        let peak = peak_current(context);
        findings.set(Rule::PeakCurrent, Finding::new(peak, limit));
        return Some(peak);
    };
    let Context {
        cycle,
        coefficients,
        ratio,
        motor,
        ..
    } = context;
    let rms = rms_current(cycle, coefficients, *ratio, motor).unwrap_or(f64::NAN);
    let peak = peak_current(context);
    let [rated, most] = amplifier.currents(&context.site.surroundings);
    findings.set(Rule::RmsCurrent, Finding::new(rms, rated));
    let limit = motor_peak.map_or(most, |motor| motor.min(most));
    findings.set(Rule::PeakCurrent, Finding::new(peak, limit));
    Some(peak)
}

/// Largest current (A); NaN if the current of a torque is unknown. It occurs at the largest torque, unless the field is weakened.
fn peak_current(context: &Context) -> f64 {
    let Context {
        cycle,
        coefficients,
        ratio,
        motor,
        ..
    } = context;
    let Some(curve) = motor.torques else {
        return f64::NAN;
    };
    if !motor.circuit.as_ref().is_some_and(|c| c.weakens) {
        return curve.current(cycle.peak_torque(coefficients));
    }
    cycle.peak_current(coefficients, *ratio, motor)
}

/// Overload, bus and brake resistor; [`measure`] provides the largest current (A).
pub(super) fn follow(context: &Context, peak_current: Option<f64>, findings: &mut impl Record) {
    overload(context, peak_current.unwrap_or(f64::NAN), findings);
    let fed = fed(context);
    let is_internal = fed.is_internal;
    let mut data = fed.data;
    if data.regenerative {
        return;
    }
    if is_internal {
        data.min_resistance = data.resistor.map(|own| own.resistance);
    } else if let (Some(resistor), Some(least)) = (data.resistor, data.min_resistance) {
        findings.set(
            Rule::BrakeResistance,
            Finding::new(resistor.resistance, least),
        );
    }
    if !regenerates(context) {
        if let (Some(voltage), Some(max)) = (data.voltage, data.max_voltage) {
            findings.set(Rule::BusVoltage, Finding::new(voltage, max));
        }
        return;
    }
    // The course of the bus takes a pass over the cycle, so it needs all data.
    let known = match missing(context, &data) {
        None => fed.figures(context),
        Some(_) => None,
    };
    let Some(figures) = known else {
        findings.set(Rule::BusVoltage, Finding::UNKNOWN);
        // The load of a resistor follows from the bus: without data of the bus, its rules are not checked.
        if data.resistor.is_some() {
            for rule in [Rule::ResistorPower, Rule::ResistorPeak, Rule::ResistorPulse] {
                findings.set(rule, Finding::UNKNOWN);
            }
            if data.min_resistance.is_none() {
                findings.set(Rule::BrakeResistance, Finding::UNKNOWN);
            }
        }
        return;
    };
    let voltage = Finding::against(figures.highest, data.max_voltage);
    findings.set(Rule::BusVoltage, voltage);
    if let Some(resistor) = data.resistor {
        if figures.burnt > 0.0 && data.min_resistance.is_none() {
            let finding = Finding::against(resistor.resistance, None);
            findings.set(Rule::BrakeResistance, finding);
        }
        let mean = figures.burnt / context.cycle.duration();
        let peak = figures.burnt_peak;
        findings.set(Rule::ResistorPower, Finding::new(mean, resistor.power));
        // A resistor that never switches on needs no pulse ratings.
        if !is_internal && (figures.burnt > 0.0 || resistor.peak_power.is_some()) {
            findings.set(
                Rule::ResistorPeak,
                Finding::against(peak, resistor.peak_power),
            );
        }
        if figures.burnt > 0.0 || resistor.pulse_energy.is_some() {
            let pulse = Finding::against(figures.pulse, resistor.pulse_energy);
            findings.set(Rule::ResistorPulse, pulse);
        }
    }
}

fn overload(context: &Context, peak: f64, findings: &mut impl Record) {
    let Some(amplifier) = context.drive.amplifier else {
        return;
    };
    let [rated, most] = amplifier.currents(&context.site.surroundings);
    if peak <= rated {
        findings.set(Rule::Overload, Finding::new(0.0, f64::INFINITY));
        return;
    }
    let allowed = amplifier
        .peak_time
        .map(|time| overload::allowed(rated, most, time));
    if peak.is_nan() || allowed.is_none() {
        findings.set(Rule::Overload, Finding::UNKNOWN);
        return;
    }
    let cycle = context.cycle;
    let points = cycle.samples().iter().map(|sample| {
        let torque = context.coefficients.torque(&sample.loads());
        let speed = sample.speed() * context.ratio;
        let current = context.motor.current(torque, speed).unwrap_or(0.0);
        [sample.t, current.copysign(torque)]
    });
    let points: Vec<overload::CurrentSample> = points.collect();
    let largest = overload::largest(&points, cycle.duration(), rated);
    findings.set(Rule::Overload, Finding::against(largest, allowed));
}

/// The bus of a drive with its brake resistor: from the machine file, of the amplifier, or chosen from the catalogue.
struct DriveBus<'a> {
    data: BusData,
    /// Its power over the cycle, if it was needed.
    curve: Option<PowerCurve>,
    /// Its figures, if they were needed.
    figures: Option<BusFigures>,
    chosen: Option<&'a Resistor>,
    /// Whether the resistor is that of the amplifier, whose resistance and peak power are the amplifier's own.
    is_internal: bool,
    /// Requirements for a resistor, if one is needed and the file gives no resistor.
    need: Option<Need>,
}

/// The bus of a drive. If the machine file gives no brake resistor, and the bus rises too far without one or its capacitance is unknown, it is that of
/// the amplifier if that can dissipate the mean power, else the smallest suitable resistor of the catalogue.
fn fed<'a>(context: &Context<'a>) -> DriveBus<'a> {
    let site = context.site;
    let drive = &context.drive;
    let data = BusData::new(
        &site.supply,
        site.highest_supply(),
        drive.amplifier,
        drive.motor,
    );
    let mut fed = DriveBus {
        data,
        curve: None,
        figures: None,
        chosen: None,
        is_internal: false,
        need: None,
    };
    let free = data.resistor.is_none() && !data.regenerative && data.chopper_voltage.is_some();
    let internal = drive
        .amplifier
        .and_then(|amplifier| amplifier.internal_resistor);
    let none = context.resistors.is_empty() && internal.is_none();
    if !free || none || !regenerates(context) {
        return fed;
    }
    let curve = power(context);
    let alone = data.bus().ok().map(|bus| bus.run(&curve));
    let rises = alone.is_some_and(|alone| data.asks_for_a_resistor(alone.highest));
    if !rises {
        fed.figures = alone;
        fed.curve = Some(curve);
        return fed;
    }
    let own = internal.and_then(|own| {
        let with = BusData {
            resistor: Some(own),
            ..data
        };
        let run = with.bus().ok()?.run(&curve);
        let pulse = own.pulse_energy.is_none_or(|most| run.pulse <= most);
        let enough = run.burnt <= own.power * curve.period();
        let bounded = data.max_voltage.is_none_or(|most| run.highest <= most);
        (enough && pulse && bounded).then_some((own, run))
    });
    if let Some((own, run)) = own {
        fed.is_internal = true;
        fed.data.resistor = Some(own);
        fed.figures = Some(run);
    } else {
        fed.need = Need::of(&data, &curve);
        fed.chosen = (fed.need).and_then(|need| need.proposal(context.resistors, drive.amplifier));
        fed.data.resistor = fed.chosen.map(Resistor::on_bus);
    }
    fed.curve = Some(curve);
    fed
}

impl DriveBus<'_> {
    fn curve(&self, context: &Context) -> Cow<'_, PowerCurve> {
        let known = self.curve.as_ref().map(Cow::Borrowed);
        known.unwrap_or_else(|| Cow::Owned(power(context)))
    }

    fn figures(&self, context: &Context) -> Option<BusFigures> {
        let run = || Some(self.data.bus().ok()?.run(&self.curve(context)));
        self.figures.or_else(run)
    }
}

/// The brake resistor chosen for a drive.
pub(super) fn chosen_resistor<'a>(context: &Context<'a>) -> Option<&'a Resistor> {
    fed(context).chosen
}

/// Whether the drive ever feeds energy back.
fn regenerates(context: &Context) -> bool {
    context.site.drive_stop.is_some() || context.cycle.regenerates(&context.coefficients)
}

/// Data missing for the voltage rise of the bus.
fn missing(context: &Context, data: &BusData) -> Option<&'static str> {
    match data.bus() {
        Err(missing) => Some(missing),
        Ok(_) if context.site.drive_stop.is_some() && !context.motor.stop.is_finite() => {
            Some("peak torque of the motor")
        }
        Ok(bus) if bus.resistor.is_none() && data.capacitance.is_none() => {
            Some("capacitance of the DC bus")
        }
        Ok(_) if data.max_voltage.is_none() => Some("maximum voltage of the DC bus"),
        Ok(_) => None,
    }
}

fn power(context: &Context) -> PowerCurve {
    let Context {
        cycle,
        coefficients,
        ratio,
        motor,
        ref drive,
        ..
    } = *context;
    let curve = bus::power(
        cycle,
        &coefficients,
        ratio,
        drive.motor,
        motor,
        drive.amplifier,
    );
    let share = context.site.drive_stop;
    curve.with_stop(bus::stop(cycle, &coefficients, ratio, motor, share))
}

/// Grounds of a rule of amplifier, bus or resistor.
pub(super) fn grounds(context: &Context, rule: Rule, finding: Finding) -> Grounds {
    let site = &context.site.surroundings;
    let amplifier = context.drive.amplifier;
    let reduced = |a: &Amplifier| Grounds::AmplifierCurrent(a.derated(site).factor);
    match rule {
        Rule::RmsCurrent => amplifier.map_or(Grounds::NoAmplifier, reduced),
        Rule::PeakCurrent => {
            let motor = context.drive.motor.winding.peak_current;
            let weaker = |a: &&Amplifier| motor.is_none_or(|motor| a.currents(site)[1] < motor);
            amplifier
                .filter(weaker)
                .map_or(Grounds::MotorCurrent, reduced)
        }
        Rule::Overload if amplifier.is_some_and(|a| a.peak_time.is_none()) => {
            Grounds::Missing("time for which the amplifier can supply its peak current")
        }
        Rule::BusVoltage => of_bus(context, finding),
        Rule::ResistorPower | Rule::ResistorPeak | Rule::ResistorPulse
            if finding.value.is_nan() =>
        {
            Grounds::Missing(
                missing(context, &fed(context).data).unwrap_or("figures of the DC bus"),
            )
        }
        Rule::BrakeResistance => fed(context).chosen.map_or(Grounds::None, |chosen| {
            Grounds::ChosenResistor(chosen.key.clone())
        }),
        _ => Grounds::None,
    }
}

/// Regenerated energy, and the brake resistor it would require.
fn of_bus(context: &Context, finding: Finding) -> Grounds {
    let fed = fed(context);
    let (data, need) = (fed.data, fed.need);
    let curve = fed.curve(context);
    let [_, back] = curve.energies();
    let rises = finding.value > data.chopper_voltage.unwrap_or(f64::INFINITY);
    let need = need.or_else(|| Need::of(&data, &curve).filter(|_| rises));
    let resistors = Some(context.resistors).filter(|resistors| !resistors.is_empty());
    Grounds::Bus {
        missing: missing(context, &data),
        back,
        stop: context.site.drive_stop.map(|_| curve.stop()),
        taken: data.resistor.is_some() || data.regenerative,
        chopper_voltage: data.chopper_voltage,
        need,
        misses: need.and_then(|need| Some(need.misses(resistors?, context.drive.amplifier))),
    }
}

/// Voltage of the bus over a cycle in the periodic state, \[time (s), voltage (V)\]; empty if data are missing.
pub(super) fn trace(context: &Context) -> Vec<[f64; 2]> {
    let fed = fed(context);
    let bus = fed.data.bus();
    bus.map_or_else(|_| Vec::new(), |bus| bus.trace(&fed.curve(context)))
}
