//! `[mechanism]` of the types that the library has.

use jred::machine::MAX_STAGES;
use jred::mechanism::{Geneva, IndexingCam, ParallelShafts, PlanetaryGears, Rope};

use super::inner;
use super::parts::{BALANCED, GUIDED, LEFT_RIGHT, LINK, NO_INERTIA, RIGHT_LEFT, SLIDE, SWING, WHEEL, length, stroke};
use crate::text::key::{ValueForm, Key, ValueRange, KeyTable, key, may, pair, quantity};
use crate::units::kind::{ANGLE, DENSITY, FORCE, INERTIA, LENGTH, MASS, SHARE, VELOCITY};

/// The keys of all types.
pub(crate) static MECHANISM: KeyTable = KeyTable::of("mechanism", &[&[
    key("type", ValueForm::Words(&[]), "one of the [types](mechanisms/README.md): its page lists the other keys, links, joints and points").such_as("\"slider-crank\""),
    may("flywheel", quantity(&INERTIA).not_negative(), "turns with the drive link, which must turn").or("0"),
]])
.variants("type", &[
    &SLIDER_CRANK, &GEAR_TRAIN, &BELT, &super::linkage::LINKAGE, &SCOTCH_YOKE, &INVERTED_SLIDER_CRANK, &GENEVA, &FOUR_BAR, &SIX_LINK, &TOGGLE_PRESS,
    &RACK_AND_PINION, &BALL_SCREW, &HOIST, &PLANETARY, &PARALLEL_SHAFTS, &FRICTION_DRIVE, &BELT_AXIS, &CONVEYOR, &FEED_ROLL, &ROTARY_TABLE, &INDEXING_CAM,
    &WINDER, &super::cam::DISC_CAM, &REDUCED_CURVES,
])
.elsewhere(&[("efficiency", "efficiency belongs to [[drive_train]]")]);

const SLIDER: ValueForm = sliding(&KeyTable::of("", &[SLIDE]).elsewhere(&[("inertia", "the slider does not turn, so it has no moment of inertia")]));
const SLIDING: ValueForm = sliding(&KeyTable::of("", &[SLIDE]).elsewhere(NO_INERTIA));
const ON_GUIDE: ValueForm = sliding(&KeyTable::of("", &[GUIDED]).elsewhere(NO_INERTIA));
const TURNING: ValueForm = sliding(&KeyTable::of("", &[WHEEL]).elsewhere(BALANCED));

const fn sliding(table: &'static KeyTable) -> ValueForm {
    ValueForm::Table(table)
}

const fn branch(help: &'static str) -> Key {
    may("branch", RIGHT_LEFT, help).or("right")
}

pub(crate) static SLIDER_CRANK: KeyTable = KeyTable::of("slider-crank", &[&[
    key("crank", inner!(&[length("r")], LINK), ""),
    key("rod", inner!(&[length("l, greater than r + \\|e\\|; with a `stroke` any that reaches")], LINK), ""),
    key("slider", SLIDER, ""),
    may("offset", quantity(&LENGTH), "e, the guide's y").or("0"),
    branch("side of the crank pin on which the slider is"),
    SWING,
]]);

pub(crate) static FOUR_BAR: KeyTable = KeyTable::of("four-bar", &[&[
    key("pivot", pair(&LENGTH), "C, not `[0, 0]`").such_as("[\"300 mm\", \"0 mm\"]"),
    key("crank", inner!(&[length("a")], LINK), ""),
    key("coupler", inner!(&[length("b")], LINK), ""),
    key("rocker", inner!(&[length("c")], LINK), ""),
    may("side", LEFT_RIGHT, "side of the directed line AC on which B lies").or("left"),
    may("keep_branch", ValueForm::Flag, "guided through its [change points](#change-points), if s + l = p + q").or("false"),
    SWING.meaning("rising: range of a crank that only swings, without a dead point (full turn)"),
]]);

pub(crate) static SIX_LINK: KeyTable = KeyTable::of("six-link", &[&[
    key("centres", quantity(&LENGTH).positive(), "b, not l₁"),
    may("guide", quantity(&LENGTH), "g, y of the guide").or("0"),
    branch("side of B on which the slider is"),
    key("crank", inner!(&[length("l₁")], LINK), ""),
    key("block", inner!(LINK), ""),
    key("rocker", inner!(&[length("l₂")], LINK), ""),
    key("rod", inner!(&[length("l₃")], LINK), ""),
    key("slider", SLIDING, ""),
    SWING,
]]);

pub(crate) static TOGGLE_PRESS: KeyTable = KeyTable::of("toggle-press", &[&[
    key("pivot", pair(&LENGTH), "P").such_as("[\"-250 mm\", \"400 mm\"]"),
    key("guide", quantity(&LENGTH), "e, y of the guide"),
    may("knee", LEFT_RIGHT, "side of the directed line AP on which the knuckle lies").or("left"),
    branch("side of the knuckle on which the ram is"),
    key("crank", inner!(&[length("r")], LINK), ""),
    key("rod", inner!(&[length("l")], LINK), ""),
    key("upper", inner!(&[length("p")], LINK), ""),
    key("lower", inner!(&[length("q")], LINK), ""),
    key("ram", SLIDING, ""),
    SWING,
]]);

pub(crate) static INVERTED_SLIDER_CRANK: KeyTable = KeyTable::of("inverted-slider-crank", &[&[
    key("crank", inner!(&[length("r")], LINK), ""),
    key("block", inner!(LINK), ""),
    key("lever", inner!(&[
        key("pivot", pair(&LENGTH), "C, from the crank's pivot").such_as("[\"0 mm\", \"-200 mm\"]"),
        may("offset", quantity(&LENGTH), "e, the slot's v in the lever's frame").or("0"),
    ], LINK), ""),
    SWING,
]]);

pub(crate) static SCOTCH_YOKE: KeyTable = KeyTable::of("scotch-yoke", &[&[
    key("crank", inner!(&[length("r")], LINK), ""),
    key("yoke", SLIDING, ""),
    may("slot_angle", quantity(&ANGLE), "β, from +x counter-clockwise to the slot, 1° to 179°").or("90 deg"),
    SWING,
]]);

pub(crate) static RACK_AND_PINION: KeyTable = KeyTable::of("rack-and-pinion", &[&[
    key("pinion", inner!(&[key("radius", quantity(&LENGTH).positive(), "r, pitch radius")], LINK), ""),
    key("rack", ON_GUIDE, ""),
    stroke("positions of the rack along x ([no ends](axes.md#stroke))"),
], super::drive::PINION_LIMITS]);

pub(crate) static BALL_SCREW: KeyTable = KeyTable::of("ball-screw", &[&[
    key("lead", quantity(&LENGTH), "h, travel of the nut a turn; negative: −x"),
    key("screw", TURNING, ""),
    key("nut", ON_GUIDE, ""),
    stroke("positions of the nut along x ([no ends](axes.md#stroke))"),
], super::drive::SCREW_SHAFT, &[super::drive::SCREW_FORCE]]);

const HANGING: ValueForm = ValueForm::Table(&KeyTable::of("", &[&[
    key("radius", quantity(&LENGTH).positive(), "R, of the drum to the rope's centre line"),
    may("falls", ValueForm::Count([1, Rope::MAX_FALLS]), "n, falls of the rope").or("1").such_as("2"),
    key("mass", quantity(&MASS).not_negative(), "with hook and lower block"),
    may("com", pair(&LENGTH), "centre of mass `[u, v]`, from the rope").or("0"),
]]).elsewhere(NO_INERTIA));

pub(crate) static HOIST: KeyTable = KeyTable::of("hoist", &[&[
    key("drum", inner!(LINK), ""),
    key("load", HANGING, ""),
    may("counterweight", HANGING, "on another rope of the drum (no counterweight)"),
    stroke("positions of the load along y ([no ends](axes.md#stroke))"),
]]);

pub(crate) static GENEVA: KeyTable = KeyTable::of("geneva", &[&[
    key("slots", ValueForm::Count([Geneva::MIN_SLOTS, Geneva::MAX_SLOTS]), "n").such_as("4"),
    key("centre_distance", quantity(&LENGTH).positive(), "a"),
    key("crank", ValueForm::Table(&KeyTable::of("", &[LINK]).elsewhere(&[("length", "the crank's length follows from the number of slots: the pin enters them without shock only at r = centre_distance·sin(180°/slots)")])), ""),
    key("wheel", TURNING, ""),
    SWING,
]]);

const TEETH: ValueForm = ValueForm::Count([PlanetaryGears::MIN_TEETH, PlanetaryGears::MAX_TEETH]);

const fn member(name: &'static str, help: &'static str) -> Key {
    key(name, ValueForm::Words(&["sun", "carrier", "ring"]), help)
}

const MEMBER: &[Key] = &[
    may("inertia", quantity(&INERTIA).not_negative(), "about the central axis; required unless it is fixed (0)"),
    may("mass", quantity(&MASS).not_negative(), "for the forces in the bearings").or("0"),
];

pub(crate) static PLANETARY: KeyTable = KeyTable::of("planetary", &[&[
    member("input", "drive link").such_as("\"sun\""),
    member("fixed", "member at rest").such_as("\"ring\""),
    key("centre_distance", quantity(&LENGTH).positive(), "a"),
    key("sun", ValueForm::Table(&KeyTable::of("", &[&[key("teeth", TEETH, "z_s").such_as("24")], MEMBER]).elsewhere(BALANCED)), ""),
    key("carrier", ValueForm::Table(&KeyTable::of("", &[MEMBER]).elsewhere(BALANCED)), ""),
    key("ring", ValueForm::Table(&KeyTable::of("", &[&[key("teeth", TEETH, "z_r").such_as("24")], MEMBER]).elsewhere(BALANCED)), ""),
    key("planets", ValueForm::Table(&KeyTable::of("", &[&[
        key("count", ValueForm::Count([1, 1000]), "N ≥ 2").such_as("3"),
        may("teeth", TEETH, "z_p ((z_r − z_s)/2)").such_as("20"),
        key("inertia", quantity(&INERTIA).not_negative(), "of one planet about its own axis"),
        may("mass", quantity(&MASS).not_negative(), "of one planet").or("0"),
    ]]).elsewhere(BALANCED)), ""),
    SWING,
]]);

pub(crate) static DRIVEN: KeyTable = KeyTable::of("", &[&[
    may("name", ValueForm::Text, "each once (`driven-1`, …)").such_as("\"fan\""),
    key("ratio", ValueForm::Number([-1e4, 1e4]), "i, ±1e-4 to ±1e4; negative: it turns the other way").such_as("2.5"),
], WHEEL]).elsewhere(BALANCED);

pub(crate) static PARALLEL_SHAFTS: KeyTable = KeyTable::of("parallel-shafts", &[&[
    key("drive", TURNING, ""),
    key("driven", ValueForm::Tables(&DRIVEN, [1, ParallelShafts::MAX_DRIVEN], "combine shafts with the same ratio: add their inertias"), "the driven shafts").such_as(" with ratio = 2.5 and inertia = \"12 kg cm^2\""),
    SWING,
]]);

pub(crate) static GEAR_TRAIN: KeyTable = KeyTable::of("gear-train", &[&[
    key("stage", ValueForm::Tables(&super::drive::GEAR_PAIR, [1, MAX_STAGES], super::drive::COMBINE), "the gear pairs in their order").such_as(super::drive::A_PAIR),
    SWING,
]]);

pub(crate) static BELT: KeyTable = KeyTable::of("belt", &[super::drive::BELT_KEYS, super::drive::BELT_LIMITS, &[SWING]]);

const FRICTION_STAGE: KeyTable = KeyTable::of("", &[&[
    key("ratio", ValueForm::Number([-1e3, 1e3]), "i, ±0.001 to ±1000, negative where the direction reverses").such_as("0.5, the speed of the second shaft over that of the first"),
    may("slip", quantity(&SHARE).not_negative(), "ε < 100 %").or("0"),
    key("inertia", quantity(&INERTIA).not_negative(), "of the stage's second shaft"),
]]);

pub(crate) static FRICTION_DRIVE: KeyTable = KeyTable::of("friction-drive", &[&[
    key("arrangement", ValueForm::Words(&["chain", "fan"]), "stage k between shafts k and k + 1 (III.12), or between shaft 1 and k + 1 (III.19)").such_as("\"chain\" or \"fan\""),
    key("inertia", quantity(&INERTIA).not_negative(), "of `shaft-1`"),
    key("stage", ValueForm::Tables(&FRICTION_STAGE, [1, MAX_STAGES], "a friction drive has at most 8 stages"), "the friction stages").such_as(" with ratio = 0.5 and inertia = \"20 kg cm^2\""),
    may("power_flow", super::drive::FLOW, "[which shaft drives](#ratio-slip-and-who-drives); required with slip"),
    SWING,
]]);

const fn pulley(diameter: &'static str) -> [Key; 5] {
    [
        may("diameter", quantity(&LENGTH).positive(), diameter),
        may("pitch", quantity(&LENGTH).positive(), "p of a toothed pulley"),
        may("teeth", ValueForm::Count([1, 100_000]), "z of a toothed pulley").such_as("40"),
        WHEEL[0],
        WHEEL[1],
    ]
}

const PULLEY: ValueForm = ValueForm::Table(&KeyTable::of("", &[&pulley("effective diameter d; required without pitch and teeth")])
    .either(&[(&["diameter", "pitch"], OR_PITCH), (&["diameter", "teeth"], OR_PITCH)]));
const OR_PITCH: &str = "give the diameter, or pitch and teeth";

const IDLER: KeyTable = KeyTable::of("", &[&[
    key("inertia", quantity(&INERTIA).not_negative(), "J_k of one of the other wheels that turn with the belt or strip"),
    may("diameter", quantity(&LENGTH).positive(), "d_k (the driven wheel's)"),
    may("count", ValueForm::Count([1, 1000]), "number of equal ones").or("1").such_as("2"),
]]);

const IDLERS: Key = may("idler", ValueForm::Tables(&IDLER, [0, usize::MAX], ""), "");
const BELT_MASS: Key = may("belt_mass", quantity(&MASS).not_negative(), "of the whole loop").or("0");

pub(crate) static BELT_AXIS: KeyTable = KeyTable::of("belt-axis", &[&[
    key("pulley", PULLEY, ""),
    IDLERS,
    BELT_MASS,
    key("carriage", ON_GUIDE, ""),
    stroke("positions of the carriage along x (no [ends](#stroke))"),
], super::drive::BELT_LIMITS]);

pub(crate) static CONVEYOR: KeyTable = KeyTable::of("conveyor", &[&[key("drum", PULLEY, ""), IDLERS, BELT_MASS, key("goods", ON_GUIDE, ""), SWING], super::drive::BELT_LIMITS]);

pub(crate) static FEED_ROLL: KeyTable = KeyTable::of("feed-roll", &[&[key("roll", PULLEY, ""), IDLERS, key("strip", ON_GUIDE, ""), SWING]]);

const PARTS: KeyTable = KeyTable::of("", &[&[
    key("count", ValueForm::Count([1, 1000]), "n of a group of equal parts, spread evenly").such_as("8"),
    key("mass", quantity(&MASS).not_negative(), "m of one part"),
    key("pitch_circle", quantity(&LENGTH).not_negative(), "diameter D"),
    may("inertia", quantity(&INERTIA).not_negative(), "J_part of one, about its own axis").or("0"),
]]);

pub(super) const TABLE: &[Key] = &[
    key("table", inner!(&[
        may("inertia", quantity(&INERTIA).not_negative(), "J_table; required without a diameter"),
        may("diameter", quantity(&LENGTH).positive(), "of a disc, instead of the inertia; with the mass"),
        may("mass", quantity(&MASS).not_negative(), "of a disc, or for the force in its bearing").or("0").such_as("\"60 kg\""),
    ]), ""),
    may("parts", ValueForm::Tables(&PARTS, [0, usize::MAX], ""), ""),
];

pub(crate) static ROTARY_TABLE: KeyTable = KeyTable::of("rotary-table", &[TABLE, &[SWING]]);

pub(crate) static INDEXING_CAM: KeyTable = KeyTable::of("indexing-cam", &[&[
    key("stops", ValueForm::Count([1, IndexingCam::MAX_STOPS]), "n, stations of the table").such_as("8"),
    key("index_angle", quantity(&ANGLE).positive(), "β, up to 360° over the indexes"),
    may("indexes", ValueForm::Count([1, IndexingCam::MAX_INDEXES]), "indexes a turn of the cam shaft").or("1"),
    may("reverses", ValueForm::Flag, "whether the table turns against the cam shaft").or("false"),
], super::motion::REST_TO_REST, super::motion::SHARES, &[key("cam", TURNING, "")], TABLE, &[SWING]]).by("law");

pub(crate) static WINDER: KeyTable = KeyTable::of("winder", &[&[
    key("full_diameter", quantity(&LENGTH).positive(), "where the stroke ends, greater than the core"),
    key("core", inner!(&[
        key("diameter", quantity(&LENGTH).positive(), "2·r₀"),
        key("inertia", quantity(&INERTIA).positive(), "J₀ of core and shaft"),
    ]), ""),
    key("web", inner!(&[
        key("thickness", quantity(&LENGTH).positive(), "h"),
        key("width", quantity(&LENGTH).positive(), "b"),
        key("density", quantity(&DENSITY).positive(), "ρ"),
        key("tension", quantity(&FORCE).not_negative(), "F₀ at the core"),
        may("taper", quantity(&SHARE).limited(ValueRange::Within(1.0)), "t").or("0"),
        may("speed", quantity(&VELOCITY).not_negative(), "v_line, see below").or("0"),
    ]), ""),
]]);

pub(crate) static REDUCED_CURVES: KeyTable = KeyTable::of("reduced-curves", &[&[
    key("file", ValueForm::File, "relative to the machine file, at most 64 MiB").such_as("\"curves.csv\""),
    key("range", ValueForm::Words(&["turn", "stroke"]), "whether the drive link turns fully").such_as("\"turn\", or \"stroke\" for a part of a turn and for a drive link that slides"),
], &super::motion::LAYOUT, &[SWING]]);
