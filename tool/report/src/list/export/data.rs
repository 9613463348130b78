//! A table and its alternatives as JSON.

use schemars::JsonSchema;
use serde::Serialize;

use super::{headroom, left_out, remark};
use crate::answer::schema;
use jred_export::{Candidate, Export, Proof, ProofError, RangeTable, SearchResult};
use jred_file::model::coordinate::Coordinate;

/// The JSON of `jred export`, with every digit (SI units).
#[derive(Serialize, JsonSchema)]
pub(crate) struct ExportData {
    /// Identification of the machine in the image.
    machine: u32,
    /// Unit of positions: rad or m.
    position_unit: &'static str,
    /// Unit of torques, or of forces.
    effort_unit: &'static str,
    /// Largest speed.
    omega: f64,
    /// Largest acceleration.
    alpha: f64,
    /// Requested torque error.
    torque_error_allowed: Option<f64>,
    /// Requested size of the image (bytes).
    max_bytes: Option<u32>,
    /// Most cells of a table.
    max_cells: u32,
    /// Processor core for which instructions are stated.
    core: &'static str,
    /// Instructions of a tick at most.
    instructions: Option<u32>,
    /// Whether loads depend on the direction of travel.
    by_direction: bool,
    /// Number type.
    #[serde(rename = "type")]
    number: &'static str,
    /// Layout.
    layout: &'static str,
    /// Rust expression that loads the image, or the type of the pieces.
    rust: String,
    /// Parts of the drive train that are not in the table.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<String>,
    /// Figures of the table.
    #[serde(flatten)]
    figures: FiguresData,
    /// Values that 1.0 stands for.
    scale: ScaleData,
    /// Unused part of the number range (bits), of fixed point.
    #[serde(skip_serializing_if = "Option::is_none")]
    bits_unused: Option<HeadroomData>,
    /// proven, or estimated.
    error_between_places: &'static str,
    /// The proof; null: not requested.
    proof: Option<ProofData>,
    /// Every number type and layout.
    alternatives: Vec<AlternativeData>,
    /// The image.
    #[serde(skip_serializing_if = "Option::is_none")]
    words: Option<Vec<u32>>,
    /// The pieces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pieces: Option<Vec<PieceData>>,
}

/// Figures of a table.
#[derive(Serialize, JsonSchema)]
struct FiguresData {
    /// Set of curves, bit by bit.
    curves: u16,
    /// Number of cells.
    cells: u32,
    /// Size of the rows (bytes).
    row_bytes: usize,
    /// Size of the image (bytes).
    image_bytes: usize,
    /// Torque error: the larger one of curves and ticks.
    torque_error: f64,
    /// Torque error of the curves.
    curve_error: f64,
    /// Its position.
    worst: f64,
    /// Torque error of ticks.
    tick_torque_error: f64,
    /// Its position.
    tick_worst: f64,
    /// Acceleration error of ticks.
    tick_acceleration_error: f64,
    /// Largest torque.
    peak_torque: f64,
}

/// Values that 1.0 stands for.
#[derive(Serialize, JsonSchema)]
struct ScaleData {
    /// Torque (N·m), or force (N).
    torque: f32,
    /// Speed (rad/s, or m/s).
    speed: f32,
    /// Inertia (kg·m²), or mass (kg).
    inertia: f32,
    /// Acceleration (rad/s², or m/s²).
    acceleration: f32,
}

/// Unused part of the number range (bits); null: the quantity is zero.
#[derive(Serialize, JsonSchema)]
struct HeadroomData {
    /// J.
    inertia: Option<f64>,
    /// J′·ω²/2.
    velocity: Option<f64>,
    /// Load.
    load: Option<f64>,
    /// b·ω.
    viscous: Option<f64>,
    /// Coulomb friction.
    coulomb: Option<f64>,
    /// Their sum.
    torque: Option<f64>,
}

/// Bounds of the error, or why it is not proven.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum ProofData {
    Open {
        /// The reason.
        not_proven: String,
    },
    Bounded {
        /// Bound of the table's torque error.
        table_torque_error: f64,
        /// Bound of the ticks' torque error.
        tick_torque_error: Option<f64>,
        /// Position near which the error is largest.
        worst: f64,
        /// The error is at least this.
        at_least: f64,
        /// Stretches that the proof needed.
        stretches: u64,
    },
}

/// A number type and layout.
#[derive(Serialize, JsonSchema)]
struct AlternativeData {
    /// Number type.
    #[serde(rename = "type")]
    number: &'static str,
    /// Layout.
    layout: &'static str,
    /// Whether it meets the request.
    meets: bool,
    /// Instructions of a tick at most.
    instructions: Option<u32>,
    /// Its figures.
    #[serde(flatten)]
    figures: Option<FiguresData>,
    /// Why there is no such table.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<String>,
}

/// A piece of the range.
#[derive(Serialize, JsonSchema)]
struct PieceData {
    /// Its start.
    from: f64,
    /// Its end.
    to: f64,
    /// Phase of its start, in units of 2⁻³² of the whole range.
    start: u32,
    /// Number of cells.
    cells: u32,
    /// Torque error.
    torque_error: f64,
    /// The image.
    words: Vec<u32>,
}

impl schema::Data for ExportData {
    const FORM: &'static str = "jred-export/1";
}

/// All of it, with every digit.
pub(super) fn data(export: &Export) -> ExportData {
    let (chosen, task) = (export.chosen(), &export.task);
    let scale = chosen.scale();
    let whole = export.whole();
    let tables = chosen.tables.iter();
    ExportData {
        machine: export.machine,
        position_unit: match export.coordinate {
            Coordinate::Angle => "rad",
            Coordinate::Length => "m",
        },
        effort_unit: export.coordinate.effort_unit(),
        omega: task.omega,
        alpha: task.alpha,
        torque_error_allowed: task.torque_error,
        max_bytes: task.max_bytes,
        max_cells: task.max_cells,
        core: task.core.word(),
        instructions: task.core.instructions(chosen.number, chosen.layout),
        by_direction: export.by_direction,
        number: chosen.number.name(),
        layout: chosen.layout.name(),
        rust: export.rust(),
        left_out: left_out(export),
        figures: figures(chosen),
        scale: ScaleData {
            torque: scale.torque(),
            speed: scale.speed(),
            inertia: scale.inertia(),
            acceleration: scale.acceleration(),
        },
        bits_unused: chosen.number.is_fixed().then(|| HeadroomData {
            inertia: headroom(chosen.usage(|u| u.inertia)),
            velocity: headroom(chosen.usage(|u| u.velocity)),
            load: headroom(chosen.usage(|u| u.load)),
            viscous: headroom(chosen.usage(|u| u.viscous)),
            coulomb: headroom(chosen.usage(|u| u.coulomb)),
            torque: headroom(chosen.usage(|u| u.torque)),
        }),
        error_between_places: match export.proof() {
            Some(Ok(_)) => "proven",
            _ => "estimated",
        },
        proof: export.proof().as_ref().map(proof),
        alternatives: alternatives(export),
        words: whole.map(|table| table.words.clone()),
        pieces: match whole {
            Some(_) => None,
            None => Some(tables.map(|table| piece(export, table)).collect()),
        },
    }
}

fn alternatives(export: &Export) -> Vec<AlternativeData> {
    let answers = export.answers.iter();
    let all = answers.map(|(number, layout, answer)| {
        let found = match answer {
            SearchResult::Meets(c) | SearchResult::Misses(c) => Some(figures(c)),
            _ => None,
        };
        AlternativeData {
            number: number.name(),
            layout: layout.name(),
            meets: matches!(answer, SearchResult::Meets(_)),
            instructions: export.task.core.instructions(*number, *layout),
            why: found.is_none().then(|| remark(answer).to_owned()),
            figures: found,
        }
    });
    all.collect()
}

fn piece(export: &Export, table: &RangeTable) -> PieceData {
    PieceData {
        from: table.range[0],
        to: table.range[1],
        start: export.start(table).to_bits(),
        cells: table.found.cells,
        torque_error: table.error,
        words: table.words.clone(),
    }
}

fn proof(proven: &Result<Proof, ProofError>) -> ProofData {
    match proven {
        Err(why) => ProofData::Open {
            not_proven: why.to_string(),
        },
        Ok(proof) => ProofData::Bounded {
            table_torque_error: proof.bound,
            tick_torque_error: proof.ticked,
            worst: proof.worst,
            at_least: proof.least,
            stretches: proof.stretches,
        },
    }
}

fn figures(c: &Candidate) -> FiguresData {
    let ((curve_error, worst), ticks) = (c.curve_error(), c.ticks());
    FiguresData {
        curves: c.curves(),
        cells: c.cells(),
        row_bytes: c.row_bytes(),
        image_bytes: c.bytes(),
        torque_error: c.error(),
        curve_error,
        worst,
        tick_torque_error: ticks.torque,
        tick_worst: ticks.worst,
        tick_acceleration_error: ticks.acceleration,
        peak_torque: ticks.peak_torque,
    }
}
