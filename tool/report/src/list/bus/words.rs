//! Sentences about a bus: conflicts, missing data, cures, brake resistors.

use std::fmt::Write as _;

use jred_file::number::rounding::{down, short, up};
use jred_file::number::words::counted;
use jred_sizing::bus::analysis::BusAnalysis;
use jred_sizing::bus::conflict::Conflict;
use jred_sizing::bus::cure::{Bound, Change, Cure, CureKind};
use jred_sizing::bus::need::{Misses, Need};
use jred_sizing::bus::period::{Common, LOOKED_AT, MOST_CYCLES};
use jred_sizing::bus::verdict::{Missing, Open};

/// Why no brake resistor can work, with the cure.
pub fn conflict(conflict: &Conflict) -> String {
    match *conflict {
        Conflict::Supply { supply, highest } if supply > highest => format!(
            "the bus voltage is always above its maximum of {} V: the supply keeps it at {} V, and no brake \
             resistor, capacitance or regenerative supply lowers that; correct max_voltage or bus_voltage in \
             [supply], or the values of the amplifier and the motor",
            short(highest),
            short(supply)
        ),
        Conflict::Supply { highest, .. } => format!(
            "the supply keeps the bus at its maximum voltage, {} V: no energy can be stored, and no brake resistor \
             can switch on; correct max_voltage or bus_voltage in [supply], or the values of the amplifier and the \
             motor",
            short(highest)
        ),
        Conflict::LateChopper { chopper, highest } => format!(
            "the brake resistor switches on at {} V, which is not below the maximum bus voltage of {} V, so no \
             resistor can limit the voltage: lower chopper_voltage or raise max_voltage in [supply], as the \
             amplifier allows",
            short(chopper),
            short(highest)
        ),
        Conflict::EarlyChopper { chopper, supply } => format!(
            "a brake resistor would always be on: it switches on at {} V, and the supply keeps the bus at {} V; \
             raise chopper_voltage or lower bus_voltage in [supply], as the amplifier allows",
            short(chopper),
            short(supply)
        ),
    }
}

/// The data missing for a check, and the keys to give.
pub fn missing(bus: &BusAnalysis, open: &Open) -> String {
    let of_resistor = |figure: &str| match &bus.chosen {
        Some(chosen) => {
            format!("the catalogue does not give {figure} of {chosen}: ask its maker for it")
        }
        None => format!("not given for the resistor: give brake_resistor.{figure} in [supply]"),
    };
    match open.missing {
        Missing::Capacitance => {
            "no data for the capacitance of the DC bus, and no brake resistor for the regenerated energy: \
             in [supply] give capacitance, or chopper_voltage and brake_resistor, or regenerative = true"
                .to_owned()
        }
        Missing::MaxVoltage { rise, bare } => {
            let rise = rise.map_or(String::new(), |[from, to]| {
                let bare = if bare { " without a brake resistor" } else { "" };
                format!(
                    ", and it rises from {} V to {} V{bare}",
                    short(from),
                    short(to)
                )
            });
            format!(
                "no data for the maximum voltage of the DC bus{rise}: give max_voltage in [supply]"
            )
        }
        Missing::ChopperVoltage { mean, peak } => format!(
            "only bounds of its load are known, at most {} W mean and {} W peak: give chopper_voltage in [supply]",
            short(mean),
            short(peak)
        ),
        Missing::MinResistance => {
            "no data for the minimum resistance of the chopper: give min_resistance in [supply]"
                .to_owned()
        }
        Missing::PeakPower => of_resistor("peak_power"),
        Missing::PulseEnergy => of_resistor("pulse_energy"),
        Missing::NotSearched => format!("no bound exists, and {}", no_search(bus)),
    }
}

/// Why the phases were not searched.
pub fn no_search(bus: &BusAnalysis) -> String {
    match bus.shared.common() {
        Common::Searched { .. } => "the phases were searched".to_owned(),
        Common::TooLong { period, cycles } => {
            let each: Vec<String> = cycles.iter().map(u32::to_string).collect();
            let axes: Vec<String> = (1..=each.len()).map(|k| k.to_string()).collect();
            format!(
                "the common period of the cycles is {} s ({} cycles of axes {}), longer than the search limit of {MOST_CYCLES} cycles",
                short(*period),
                each.join(", "),
                axes.join(", "),
            )
        }
        Common::None => {
            format!("the cycles have no common period within {LOOKED_AT} cycles")
        }
    }
}

/// The change.
pub fn cure(cure: &Cure) -> String {
    let changes: Vec<String> = cure.changes.iter().map(change).collect();
    let mut words = changes.join(", ");
    match cure.kind {
        CureKind::Changes => {}
        CureKind::LowerChopper => words += ", with a chopper_voltage below max_voltage",
        CureKind::AnyChopper => {
            words += ", with a chopper_voltage and a resistance of at most its square over the peak_power";
        }
        CureKind::StoresAll => {
            words += ", which stores all regenerated energy: the brake resistor never switches on";
        }
        CureKind::Phases { highest, resistor } => {
            let starts = cure.phases.iter().flatten().enumerate().skip(1);
            let starts = starts.map(|(k, phase)| format!("axis {} {} s", k + 1, short(*phase)));
            let starts: Vec<String> = starts.collect();
            let (starts, highest) = (starts.join(", "), short(highest));
            let _ = write!(
                words,
                "axes synchronised, {starts} after axis 1: bus up to {highest} V"
            );
            if let Some([mean, peak, pulse]) = resistor.map(|figures| figures.map(short)) {
                let _ = write!(
                    words,
                    ", brake resistor {mean} W mean, {peak} W peak, {pulse} J a pulse"
                );
            }
        }
        CureKind::Regenerative { peak, mean } => {
            let [peak, mean] = [peak, mean].map(|power| short(up(power)));
            let _ = write!(
                words,
                "regenerative = true without a brake resistor: a supply that feeds back {peak} W peak, at most {mean} W mean"
            );
        }
    }
    words
}

fn change(change: &Change) -> String {
    // Rounded to the safe side.
    let (word, value) = match change.bound {
        Bound::AtLeast(value) => ("at least", up(value)),
        Bound::AtMost(value) => ("at most", down(value)),
    };
    format!("{} {word} {} {}", change.key, short(value), change.unit)
}

/// The brake resistor that is needed.
pub fn needed(need: &Need) -> String {
    format!("requires a brake resistor of {}", resistor(need))
}

/// The figures of the brake resistor that is needed.
pub fn resistor(need: &Need) -> String {
    let largest = short(need.largest_resistance);
    let range = match need.smallest_resistance.map(short) {
        Some(least) if need.is_possible() => format!("{least} to {largest} Ω"),
        Some(least) => {
            format!("at most {largest} Ω (but the chopper requires at least {least} Ω)")
        }
        None => format!("at most {largest} Ω"),
    };
    let [mean, peak] = [need.mean, need.peak].map(short);
    if need.pulse.is_nan() {
        return format!("{range} for {mean} W mean and {peak} W peak");
    }
    let pulse = short(need.pulse);
    format!("{range} for {mean} W mean, {peak} W peak and {pulse} J a pulse")
}

/// Why no resistor of the catalogue fits.
pub fn misses(misses: &Misses) -> String {
    let reasons = [
        (misses.other_amplifier, "another amplifier"),
        (misses.small_resistance, "too small a resistance"),
        (misses.large_resistance, "too large a resistance"),
        (misses.power, "too little continuous power"),
        (misses.peak_power, "too little peak power"),
        (misses.pulse_energy, "too little pulse energy"),
    ];
    let counts = reasons.into_iter().filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts
        .map(|(count, words)| format!("{count} with {words}"))
        .collect();
    let all = counted(misses.resistors, "brake resistor", "brake resistors");
    format!(
        "none of the {all} of the catalogue fits: {}",
        counts.join(", ")
    )
}
