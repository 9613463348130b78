//! `[motion]`, its segments, and motion laws.

use crate::text::key::{ACCELERATIONS, ValueForm, JERKS, Key, ValueRange, POSITION, SPEED, KeyTable, key, may, of_axis, pair, quantity};
use crate::units::kind::{ANGULAR_SPEED, CUTOFF, LENGTH, SHARE, TIME};

/// The laws from rest to rest.
pub(crate) const LAWS: [&str; 10] = [
    "trapezoid", "polynomial-345", "cycloidal", "modified-sine", "modified-trapezoid", "polynomial-4567", "simple-sine", "parabola", "gutman",
    "sine-constant-cosine",
];

/// The laws of a motion: those, and further ones.
pub(crate) const MOTION_LAWS: [&str; 16] = [
    LAWS[0], LAWS[1], LAWS[2], LAWS[3], LAWS[4], LAWS[5], LAWS[6], LAWS[7], LAWS[8], LAWS[9], "constant-speed", "jerk-limited", "join", "polynomial-5",
    "polynomial-6", "polynomial-7",
];

const TRAPEZOID: &[&str] = &["trapezoid"];
const SCCA: &[&str] = &["sine-constant-cosine"];
const BETWEEN_SPEEDS: &[&str] = &["trapezoid", "polynomial-5", "polynomial-6", "polynomial-7", "jerk-limited"];
const BETWEEN_ACCELERATIONS: &[&str] = &["polynomial-5", "polynomial-6", "polynomial-7"];
const BETWEEN_JERKS: &[&str] = &["polynomial-6", "polynomial-7"];
const LIMITED: &[&str] = &["trapezoid", "jerk-limited"];
const ANY_SHARE: ValueForm = quantity(&SHARE).limited(ValueRange::Within(1.0));

/// The law of a part that moves from rest to rest.
pub(super) const REST_TO_REST: &[Key] = &[key("law", ValueForm::Words(&LAWS), "a [law](machine-file.md#motion-laws) from rest to rest").such_as("\"polynomial-345\"")];

/// The shares of two laws.
pub(super) const SHARES: &[Key] = &[
    may("accelerate", quantity(&SHARE).limited(ValueRange::UpTo(1.0)), "of the move; both together ≤ 100 % (1/3)").only(TRAPEZOID),
    may("decelerate", quantity(&SHARE).limited(ValueRange::UpTo(1.0)), "of the move; both together ≤ 100 % (1/3)").only(TRAPEZOID),
    may("sine", ANY_SHARE, "of the move in both halves; the three together 1 % to 100 %").or("0").only(SCCA),
    may("constant", ANY_SHARE, "of the move in both halves; the three together 1 % to 100 %").or("0").only(SCCA),
    may("cosine", ANY_SHARE, "of the move in both halves; the three together 1 % to 100 %").or("0").only(SCCA),
];

static SEGMENT: KeyTable = KeyTable::of("motion.segment", &[&[
    may("dwell", quantity(&TIME).positive(), "pause; no other key"),
    may("move", of_axis(POSITION), "distance, not zero; negative is clockwise"),
    may("law", ValueForm::Words(&MOTION_LAWS), "[motion law](#motion-laws) of a move; required").such_as("\"polynomial-345\""),
    may("duration", quantity(&TIME).positive(), "of a move; required without limits"),
], SHARES, &[
    may("speed", of_axis(SPEED), "not zero: with `move` or `duration`; the third follows").only(&["constant-speed"]),
    may("start_speed", of_axis(SPEED), "at this end (the neighbour's, else rest)").only(BETWEEN_SPEEDS),
    may("end_speed", of_axis(SPEED), "at this end (the neighbour's, else rest)").only(BETWEEN_SPEEDS),
    may("start_acceleration", of_axis(ACCELERATIONS), "at this end (the neighbour's, else 0)").only(BETWEEN_ACCELERATIONS),
    may("end_acceleration", of_axis(ACCELERATIONS), "at this end (the neighbour's, else 0)").only(BETWEEN_ACCELERATIONS),
    may("start_jerk", of_axis(JERKS), "at one end, with polynomial-7 at both (0)").only(BETWEEN_JERKS),
    may("end_jerk", of_axis(JERKS), "at one end, with polynomial-7 at both (0)").only(BETWEEN_JERKS),
    may("max_speed", of_axis(SPEED).positive(), "limit; required with `move`").only(LIMITED),
    may("max_acceleration", of_axis(ACCELERATIONS).positive(), "limit; required without a duration").only(LIMITED),
    may("max_deceleration", of_axis(ACCELERATIONS).positive(), "limit (`max_acceleration`)").only(LIMITED),
    may("max_jerk", of_axis(JERKS).positive(), "limit; required").only(&["jerk-limited"]),
    may("to", of_axis(POSITION), "position of the drive link to come to rest (the start of the cycle); a dwell or another join may follow").only(&["join"]),
]]).by("law").either(&[(&["move", "dwell"], "write two [[motion.segment]] tables, one for the move and one for the dwell")]);

/// Layout of another program's CSV file.
pub(super) const LAYOUT: [Key; 4] = [
    may("columns", ValueForm::Named(&ValueForm::Text), "titles of the [columns](import.md#csv) by their names: which column is which"),
    may("skip_rows", ValueForm::Count([1, 10_000]), "number of lines above the header").such_as("1"),
    may("header", ValueForm::List(&ValueForm::Text, [1, usize::MAX]), "titles of a file without a header").such_as("[\"t [s]\", \"phi [deg]\"]"),
    may("counts_per_turn", ValueForm::Count([1, u32::MAX]), "of an encoder, for columns in `counts`, `counts/s`").such_as("8192"),
];

const fn with<const N: usize>(mut keys: [Key; N], only: &'static [&'static str]) -> [Key; N] {
    let mut at = 0;
    while at < N {
        keys[at] = keys[at].only(only);
        at += 1;
    }
    keys
}

const PROFILE: &[&str] = &["profile"];

/// The proposed values of `of`.
pub(crate) const SUCH_AS: &str = "write of = { point = \"slider\", along = \"x\" }, of = { link = \"table\" } or of = { slide = \"guide\" }";

static OF: KeyTable = KeyTable::of("motion.of", &[&[
    may("point", ValueForm::Name("a point, or of a link"), "the coordinate is its position"),
    may("at", pair(&LENGTH), "a point `[u, v]` of the link").or("0"),
    may("along", ValueForm::Words(&["x", "y", "path"]), "required with `point`").such_as("\"x\", \"y\" or \"path\""),
    may("link", ValueForm::Name("a link"), "the coordinate is its angle"),
    may("slide", ValueForm::Name("a joint that is a guide"), "the coordinate is the displacement in it"),
]]).either(&[(&["point", "link", "slide"], SUCH_AS)]).elsewhere(&[("along", "`along` is for a point"), ("at", "`at` gives a point of a link named with `point`")]);

const START: Key = may("start", of_axis(POSITION), "φ, or the tool's coordinate, at the start; of a profile only if it has no positions (0; a stroke's first end; the tool's at `near`)");
const OF_SEGMENTS: Key = key("segment", ValueForm::Tables(&SEGMENT, [0, usize::MAX], ""), "1 to 1000 moves and dwells").only(&["cycle", "point-to-point"]);

const OF_PROFILE: &[Key] = &with([
    key("file", ValueForm::File, "relative to the machine file, at most 64 MiB").such_as("\"profile.csv\""),
    may("cyclic", ValueForm::Flag, "whether it repeats").or("true"),
    may("step", quantity(&TIME).positive(), "between rows without a time column"),
    may("smoothing", quantity(&CUTOFF).positive(), "at which the amplitude is halved"),
    may("close_within", of_axis(POSITION).positive(), "how far a cycle may miss its end (1e-5 of a turn or of the stroke)"),
    may("master_speed", quantity(&ANGULAR_SPEED).positive(), "of the master of an [electronic cam](import.md#master)"),
    may("master_time", quantity(&TIME).positive(), "instead: in which the master passes its table"),
    LAYOUT[0].meaning("titles of the [columns](import.md#csv) `time`, `position`, `speed`, `acceleration`, `master`, `slope`, `bend`"),
    LAYOUT[1], LAYOUT[2], LAYOUT[3],
], PROFILE);

const MASTER: &[(&[&str], &str)] = &[(&["master_speed", "master_time"], "give the speed of the master, or the time in which it passes its table")];

const TOOL: &[(&str, &str)] = &[
    ("point", "a motion of the tool is written of = { point = \"slider\", along = \"x\" }"),
    ("link", "a motion of the tool is written of = { point = \"slider\", along = \"x\" }"),
    ("along", "a motion of the tool is written of = { point = \"slider\", along = \"x\" }"),
    ("slide", "a motion of the tool is written of = { point = \"slider\", along = \"x\" }"),
];

pub(crate) static MOTION: KeyTable = KeyTable::of("motion", &[&[
    key("type", ValueForm::Words(&["constant-speed", "cycle", "point-to-point", "profile"]), "see above").such_as("\"cycle\""),
    may("of", ValueForm::Table(&OF), "[whose motion it is](#motion-of-the-tool) (the drive link's)"),
    may("near", of_axis(POSITION), "of the drive link, on the branch on which the [tool](#motion-of-the-tool) works; no dead centre").or("0"),
    START,
    key("speed", of_axis(SPEED), "not zero; negative is clockwise").only(&["constant-speed"]),
    OF_SEGMENTS,
], OF_PROFILE]).by("type").either(MASTER).elsewhere(TOOL);

/// The motion of a second axis.
pub(super) static OF_CARRIAGE: KeyTable = KeyTable::of("carriage.motion", &[&[
    key("type", ValueForm::Words(&["cycle", "point-to-point", "profile"]), "").such_as("\"cycle\""),
    START,
    OF_SEGMENTS,
], OF_PROFILE]).by("type").either(MASTER).elsewhere(TOOL);

