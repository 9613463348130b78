//! The motion of least effort as JSON.

use schemars::JsonSchema;
use serde::Serialize;

use super::{GentlestView, rows, violated, why};
use crate::answer::schema::Data;
use crate::list::contact::of_gentlest;
use crate::list::kept::{self, KeptPart};
use crate::list::rule_words::CheckData;
use jred_motion::gentlest::Optimum;
use jred_motion::gentlest::cycle::{Figures, Goal};

/// The JSON of `jred gentlest` (SI units).
#[derive(Serialize, JsonSchema)]
pub(crate) struct GentlestData<'a> {
    /// Name of the drive; none: torque and speed are those at the input of the drive train.
    drive: Option<&'a str>,
    /// The quantity that is least: rms, energy or peak.
    objective: &'static str,
    /// The motion of the file, the motion laws, and the motion of least effort, which is the last.
    motions: Vec<MotionFigures>,
    /// The least value: RMS or peak torque (N·m, or N), or energy (J).
    least: f64,
    /// A proven lower bound of that value.
    bound: Option<f64>,
    /// Whether no other motion of these moves is better.
    global: bool,
    /// Why the optimum is not proven to be global.
    local_because: Option<&'static str>,
    /// A one-sided contact that the motion loses.
    contact_lost: Option<String>,
    /// Rules of sizing that the motion violates with this drive.
    rules_not_kept: Vec<CheckData>,
    /// Unit of positions: rad or m.
    unit: &'static str,
    /// The moves.
    moves: Vec<MoveData>,
    /// Parts of the file's motion that are kept.
    kept: Vec<KeptPart>,
    /// Parts and limits of the file's motion that are not kept.
    not_kept: Vec<String>,
    /// Nodes of the motion: time (s), position, speed, acceleration before and after the node.
    nodes: Vec<[f64; 5]>,
}

impl Data for GentlestData<'_> {
    const FORM: &'static str = "jred-gentlest/1";
}

/// Figures of a motion (SI units).
#[derive(Serialize, JsonSchema)]
struct MotionFigures {
    /// Of the motor (N·m, or N).
    rms_torque: f64,
    /// Of the motor (N·m, or N).
    peak_torque: f64,
    /// Of the motor (rad/s, or m/s).
    peak_speed: f64,
    /// Mechanical work that the motor delivers while driving (J).
    work_drawn: f64,
    /// Loss in the winding (J).
    copper_loss: Option<f64>,
    /// Largest share of the torque limit at the same speed.
    share_of_limits: Option<f64>,
    /// RMS torque as a share of the S1 torque.
    share_of_s1: Option<f64>,
    /// Largest speed as a share of the maximum speed.
    share_of_largest_speed: Option<f64>,
    /// Name of the motion.
    motion: &'static str,
}

impl MotionFigures {
    fn of((motion, figures): (&'static str, &Figures)) -> Self {
        let known = |share: f64| Some(share).filter(|share| share.is_finite());
        Self {
            rms_torque: figures.rms,
            peak_torque: figures.peak,
            peak_speed: figures.speed,
            work_drawn: figures.drawn,
            copper_loss: figures.copper,
            share_of_limits: known(figures.used),
            share_of_s1: known(figures.rms_used),
            share_of_largest_speed: known(figures.speed_used),
            motion,
        }
    }
}

/// A move (s; rad or m).
#[derive(Serialize, JsonSchema)]
struct MoveData {
    /// Position at its start.
    start: f64,
    /// Signed distance.
    distance: f64,
    /// The motion law that it keeps, if any.
    law: Option<&'static str>,
    /// Its time.
    duration: f64,
    /// Time in motion; the rest it waits.
    moving: f64,
    /// Where it waits.
    waits_at: f64,
    /// Its part of the objective: integral of the squared torque (N²·m²·s), or energy (J).
    cost: Option<f64>,
    /// A proven lower bound of the cost.
    bound: Option<f64>,
    /// Change of the cost per second of duration.
    cost_per_second: Option<f64>,
    /// Estimated relative error of the cost by discretisation.
    discretisation: f64,
    /// Elements of the discretisation.
    elements: usize,
}

pub(super) fn data<'a>(shown: &'a GentlestView) -> GentlestData<'a> {
    let GentlestView {
        request,
        gentlest,
        file,
        ..
    } = *shown;
    let (global, local_because) = match gentlest.optimum() {
        Optimum::Global => (true, None),
        Optimum::Local(reason) => (false, Some(why(reason))),
    };
    let axis = file.axis();
    // The mean of a high power has no useful unit.
    let known = |figure: f64| Some(figure).filter(|_| request.goal != Goal::Peak);
    let moves = gentlest.moves.iter().map(|gentle| {
        let travel = &gentle.travel;
        let ends = [travel.start, travel.start + travel.distance];
        let [start, end] = ends.map(|phi| axis.position(phi));
        MoveData {
            start,
            distance: end - start,
            law: gentle.law,
            duration: travel.duration,
            moving: gentle.moving,
            waits_at: axis.position(gentle.waits_at),
            cost: known(gentle.cost),
            bound: gentle.bound,
            cost_per_second: known(gentle.per_second),
            discretisation: gentle.discretisation,
            elements: gentle.elements,
        }
    });
    let trace = gentlest.trace.of_axis(&axis);
    let nodes = trace.nodes().iter();
    let nodes = nodes.map(|node| [node.t, node.phi, node.omega, node.alpha[0], node.alpha[1]]);
    GentlestData {
        drive: shown.drive.as_deref(),
        objective: request.goal.word(),
        motions: rows(gentlest).into_iter().map(MotionFigures::of).collect(),
        least: gentlest.best.of(request.goal),
        bound: gentlest.bound,
        global,
        local_because,
        contact_lost: shown.broken.map(of_gentlest),
        rules_not_kept: violated(shown).map(CheckData::from).collect(),
        unit: axis.coordinate.per(),
        moves: moves.collect(),
        kept: kept::parts(file, &gentlest.chain),
        not_kept: kept::lost(file, &gentlest.chain),
        nodes: nodes.collect(),
    }
}
