//! The JSON of `jred check`.

use jred::Domain;
use schemars::JsonSchema;
use serde::Serialize;

use super::words;
use crate::answer::schema::Data;
use jred_analysis::inspect::{
    Agreement, Findings, Inertia, JointFinding, MotionFindings, Transmission, Travel,
};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::mechanism::Fact;

/// The JSON of `jred check` (SI units).
#[derive(Serialize, JsonSchema)]
pub(crate) struct CheckData<'a> {
    /// Kind of the mechanism.
    mechanism: &'static str,
    /// Coordinate of the drive link.
    #[serde(rename = "drive coordinate")]
    coordinate: &'static str,
    /// Degrees of freedom: 3·links − constraints.
    #[serde(rename = "degrees of freedom")]
    freedoms: i64,
    /// Number of moving links.
    links: usize,
    /// Number of constraints.
    constraints: usize,
    /// The joints.
    joints: &'a [JointFinding],
    /// Range of the drive link.
    range: Range,
    /// Difference of the links' speeds after a turn, as a share; none for a stroke.
    closure: Option<f64>,
    /// Travels of the links.
    travels: &'a [Travel],
    /// The smallest transmission index; none without a group of links.
    transmission: Option<&'a Transmission>,
    /// Inertia.
    inertia: &'a Inertia,
    /// Agreement of independent methods.
    agreement: &'a Agreement,
    /// The motion; none without one.
    motion: Option<&'a MotionFindings>,
    /// Figures of its kind.
    facts: Vec<Fact>,
    /// Remarks.
    notes: Vec<String>,
    /// Possible mistakes in the machine file.
    warnings: &'a [String],
    /// Violated checks; empty: every check is satisfied.
    violations: Vec<String>,
}

impl Data for CheckData<'_> {
    const FORM: &'static str = "jred-check/1";
}

/// A whole turn, or a stroke between two positions (rad, or m).
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum Range {
    Turn(#[schemars(extend("const" = "turn"))] &'static str),
    Stroke([f64; 2]),
}

pub(super) fn data(findings: &Findings) -> CheckData<'_> {
    CheckData {
        mechanism: findings.kind,
        coordinate: match findings.coordinate {
            Coordinate::Angle => "angle [rad]",
            Coordinate::Length => "displacement [m]",
        },
        freedoms: findings.freedoms(),
        links: findings.links,
        constraints: findings.constraints(),
        joints: &findings.joints,
        range: match findings.domain {
            Domain::Turn => Range::Turn("turn"),
            Domain::Stroke { from, to } => Range::Stroke([from, to]),
        },
        closure: findings.closure,
        travels: &findings.travels,
        transmission: findings.transmission.as_ref(),
        inertia: &findings.inertia,
        agreement: &findings.agreement,
        motion: findings.motion.as_ref(),
        facts: words::facts(findings),
        notes: [words::before(findings), words::after(findings)].concat(),
        warnings: &findings.warnings,
        violations: words::violations(findings),
    }
}
