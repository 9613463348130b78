//! Entries for sizing: supply, surroundings, duty, tool, rules, tolerances.

use super::inner;
use crate::model::rule::Rule;
use crate::text::key::{ValueForm, Key, ValueRange, KeyTable, key, may, pair, quantity};
use crate::units::kind::{ALTITUDE, ANGLE, CAPACITANCE, ENERGY, LENGTH, POWER, RESISTANCE, SHARE, TEMPERATURE, TIME, VOLTAGE};

pub(crate) static SUPPLY: KeyTable = KeyTable::of("supply", &[&[
    may("bus_voltage", quantity(&VOLTAGE).positive(), "of the DC bus (else the motor's)"),
    may("mains_voltage", quantity(&VOLTAGE).positive(), "instead, 20 to 1000 V: the bus has √2 times it; parts must withstand [10 % more](sizing-rules.md#voltage)"),
    may("capacitance", quantity(&CAPACITANCE).positive(), "of the DC bus"),
    may("chopper_voltage", quantity(&VOLTAGE).positive(), "above the bus: at which the brake resistor comes on"),
    may("max_voltage", quantity(&VOLTAGE).positive(), "above the chopper's: highest voltage of the bus"),
    may("min_resistance", quantity(&RESISTANCE).positive(), "smallest brake resistance that the chopper may switch"),
    may("regenerative", ValueForm::Flag, "whether the supply feeds energy back into the mains").or("false"),
    may("brake_resistor", inner!(&[
        key("resistance", quantity(&RESISTANCE).positive(), "≥ `min_resistance`; the resistor not with `regenerative`"),
        key("power", quantity(&POWER).positive(), "continuous"),
        may("peak_power", quantity(&POWER).positive(), "≥ `power`"),
        may("pulse_energy", quantity(&ENERGY).positive(), "of one pulse"),
    ]), ""),
]]).either(&[(
    &["bus_voltage", "mains_voltage"],
    "give one of them: the DC bus behind a rectifier has √2 times the mains voltage, such as 565 V at 400 V",
)]);

const WARM: ValueForm = quantity(&TEMPERATURE).limited(ValueRange::Between(-60.0, 300.0));

pub(crate) static SURROUNDINGS: KeyTable = KeyTable::of("surroundings", &[&[
    may("ambient", WARM, "around the motor; above 40 °C [ratings are reduced](sizing-rules.md#heat-and-altitude)").or("40 degC"),
    may("cabinet", WARM, "around the amplifier (`ambient`)"),
    may("altitude", quantity(&ALTITUDE), "-500 to 4000 m; above 1000 m the allowed rise falls by 1 % per 100 m").or("0"),
    may("resistance_at", WARM, "of the copper, for its resistance (the winding's own)"),
    may("max_housing", WARM, "highest of the housing, as for touch, above `ambient` (no limit)"),
]]);

pub(crate) static DUTY: KeyTable = KeyTable::of("duty", &[&[
    may("type", ValueForm::Words(&["S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "S9"]), "duty type of IEC 60034-1").or("S1").such_as("\"S3\"; S1 to S9 of IEC 60034-1"),
    may("operating_time", quantity(&TIME).positive(), "S2 to S5: how long the motion repeats; required of S2 and with `rest`"),
    may("rest", quantity(&TIME).positive(), "S3 to S5: how long the machine then rests (rests are in the motion)"),
    may("at_rest", ValueForm::Words(&["off", "holding"]), "in `rest`").or("off"),
    may("emergency_stops", ValueForm::Number([0.001, 1000.0]), "[per hour](sizing-rules.md#the-holding-brake) by the brake alone, without supply (not judged)").such_as("2"),
    may("drive_stop", quantity(&SHARE).limited(ValueRange::UpTo(1.0)), "[stop by the drive](sizing-rules.md#the-stop-by-the-drive), whose energy the bus must take: share of the motor's peak torque (not judged)").such_as("\"100 %\""),
]]);

pub(crate) static TOOL: KeyTable = KeyTable::of("tool", &[&[
    may("point", ValueForm::Name("a point, or of a link"), "whose position matters"),
    may("at", pair(&LENGTH), "a point `[u, v]` of the link").or("0"),
    may("link", ValueForm::Name("a link"), "instead: whose angle matters"),
    key("play", ValueForm::Quantity([&ANGLE, &LENGTH], ValueRange::Positive), "largest play, flank to flank: a length, an angle with `link`"),
]]).either(&[(&["point", "link"], "give either the point whose position matters or the link whose angle matters")]);

const RATIO: ValueForm = ValueForm::Number([0.01, 1000.0]);

/// A limit of a rule: a share of its rating, or a plain ratio.
const fn limit(rule: Rule) -> ValueForm {
    match rule {
        _ if rule.is_ratio() => RATIO,
        Rule::GearboxCycles => quantity(&SHARE).limited(ValueRange::UpTo(1000.0)),
        _ => quantity(&SHARE).limited(ValueRange::UpTo(2.0)),
    }
}

/// A limit and a warning with their source.
macro_rules! both {
    ($limit:expr) => {
        inner!(&[
            may("limit", $limit, "").such_as("5"),
            may("warning", $limit, "").such_as("5"),
            may("source", ValueForm::Text, "where they are from").such_as("\"data sheet, page 4\""),
        ])
    };
}

const OFF: ValueForm = ValueForm::Words(&["off"]);
static OF_RATIO: [ValueForm; 3] = [RATIO, OFF, both!(RATIO)];
static OF_CYCLES: [ValueForm; 3] = [quantity(&SHARE).limited(ValueRange::UpTo(1000.0)), OFF, both!(quantity(&SHARE).limited(ValueRange::UpTo(1000.0)))];
static OF_SHARE: [ValueForm; 3] = [quantity(&SHARE).limited(ValueRange::UpTo(2.0)), OFF, both!(quantity(&SHARE).limited(ValueRange::UpTo(2.0)))];

const LIMIT: &str = "limit of the [rule](sizing-rules.md) of this name, or `{ limit, warning, source }`";

const LIMITS: [Key; 2 * Rule::COUNT] = {
    let mut keys = [may("", ValueForm::Text, ""); 2 * Rule::COUNT];
    let mut at = 0;
    while at < Rule::COUNT {
        let rule = Rule::ALL[at];
        let (forms, help): (&'static [ValueForm; 3], _) = match rule {
            _ if rule.is_ratio() => (&OF_RATIO, LIMIT),
            Rule::GearboxCycles => (&OF_CYCLES, "limit of the cycles per hour, as share of 1000"),
            _ => (&OF_SHARE, LIMIT),
        };
        keys[2 * at] = may(rule.key(), ValueForm::Any(forms), help);
        keys[2 * at + 1] = may(rule.warning_key(), limit(rule), "limit of the warning of a rule, not beyond the limit");
        at += 1;
    }
    keys
};

const CHOICES: &[Key] = &[
    may("inertia_ratio_of", ValueForm::Words(&crate::model::rules::InertiaOf::WORDS), "the λ that is judged").or("max"),
    may("gearbox_mean_exponent", ValueForm::Words(&crate::model::rules::MeanTorque::WORDS), "of the gearbox's mean torque").or("3"),
    may("inertia_ratio_by_moves", ValueForm::Tables(&MOVES, [1, 20], "a list of bands has at most 20"), "limit of λ by the moves per minute, bands rising"),
];

static MOVES: KeyTable = KeyTable::of("", &[&[
    key("above", ValueForm::Number([0.0, 1e6]), "moves per minute").such_as("60, in moves per minute"),
    key("limit", RATIO, "limit of λ there").such_as("5"),
]]);

pub(crate) static RULES: KeyTable = KeyTable::of("rules", &[&[
    may("set", ValueForm::Text, "name or file of the rule set that the other keys change").or("general"),
], &LIMITS, CHOICES])
    .either(&[(&["inertia_ratio", "inertia_ratio_by_moves"], "limits by moves per minute replace the single limit: remove one of the two")]);


/// The file of a rule set.
pub static RULE_SET: KeyTable = KeyTable::of("rule-set", &[&[
    key("title", ValueForm::Text, "").such_as("\"Rules of our house\""),
    may("source", ValueForm::Text, "where its limits are from").such_as("\"data sheet, page 4\""),
    may("based_on", ValueForm::Text, "name of the built-in set that it changes, or `none`").or("general"),
    key("rules", ValueForm::Table(&RULES), ""),
]]);

/// A deviation of a quantity.
const DEVIATION: ValueForm = ValueForm::Any(&[ValueForm::Text, inner!(&[
    may("normal", ValueForm::Text, "standard deviation").such_as("\"2 %\""),
    may("uniform", ValueForm::Text, "amount to both sides").such_as("\"2 %\""),
])]);

pub(super) const TOLERANCE: ValueForm = ValueForm::Named(&DEVIATION);
