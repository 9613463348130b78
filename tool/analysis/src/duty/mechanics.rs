//! Data of machine and motion for the mechanical rules, computed once because they do not depend on the drive.

use jred::Domain;
use jred::machine::{Mechanism as _, Reducible as _};
use jred_file::math;

use crate::duty::{Instant, Smooth};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::site::ToolPlace;

pub(super) mod elements;
mod moves;
mod rest;
mod run_on;
mod stop;

pub use elements::{Alteration, ElementLoad};
pub use rest::{HoldingTorques, Rest, constant_loads};
pub use run_on::{BrakeStop, MotorBrake, RunOn};
pub use stop::{Braking, Stop};

/// Figures of machine and motion at the input of the drive train, that is, at the gearbox output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanics {
    /// Moves per cycle: from rest to rest, where a reversal counts as rest. At least one if the drive link accelerates.
    pub moves: u32,
    /// Moves per second.
    pub move_rate: f64,
    /// Highest frequency with which the motion excites the machine (Hz): the higher of the largest turning frequency of the drive link and one over
    /// the time of the shortest move.
    pub drive_frequency: f64,
    /// Torques at rest at which the machine would begin to move on: friction of the drive train may act in either direction.
    pub rest: Rest,
    /// Largest torque of weight, springs and friction over the motion (N·m), where they resist it and where they drive it, without acceleration and
    /// process loads.
    pub constant: [f64; 2],
    /// Whether the unheld machine moves against its own friction, by weight or springs anywhere in the range, or by weight and process loads where
    /// the motion rests.
    pub falls: bool,
    /// States from which an emergency stop may begin.
    pub stop: Stop,
    /// States from which the brake may have to stop the machine.
    pub run_on: RunOn,
    /// Whether the drive link slides.
    pub slides: bool,
    /// Drive ratio: speed at the input over that of the drive link, without sign.
    pub train_ratio: f64,
    /// The belts, screws and pinions of the machine, with their loads.
    pub elements: Vec<ElementLoad>,
    /// Largest |x′| of the tool over the motion, per rad (or m) of the drive link; `None` without a tool.
    pub tool_slope: Option<f64>,
}

impl Mechanics {
    /// The figures of a motion; `rest`: the torques at rest without losses.
    pub fn new(
        file: &MachineFile,
        instants: &[Instant],
        smooth: &Smooth,
        duration: f64,
        rest: Rest,
    ) -> Self {
        let moves = moves::Moves::of(
            instants,
            duration,
            file.motion.as_ref().is_some_and(|m| m.cyclic),
        );
        let speed = instants.iter().map(|i| i.omega.abs()).fold(0.0, f64::max);
        let turning = match file.machine.domain() {
            Domain::Turn => speed / std::f64::consts::TAU,
            Domain::Stroke { .. } => 0.0,
        };
        let accelerates = instants.iter().any(|i| i.alpha != 0.0);
        let count = moves.count.max(u32::from(accelerates));
        let shortest = moves.shortest.map_or(0.0, |time| 1.0 / time);
        let motion = Self {
            moves: count,
            move_rate: f64::from(count) / duration,
            drive_frequency: turning.max(shortest),
            tool_slope: tool_slope(file, instants),
            elements: ElementLoad::all(file, instants, Alteration::default()),
            slides: file.machine.mechanism().coordinate() == Coordinate::Length,
            ..Self::default()
        };
        motion.with_loads(file, instants, smooth, 1.0, rest)
    }

    /// The figures of the same motion in `time` times its time, under other loads, from `instants`, which may be only some of them. `rest`: the
    /// torques at rest without losses. The elements keep their loads.
    #[must_use]
    pub fn with_loads(
        &self,
        file: &MachineFile,
        instants: &[Instant],
        smooth: &Smooth,
        time: f64,
        rest: Rest,
    ) -> Self {
        let ratio = file.drive_train.ratio().abs();
        let efficiency = file.drive_train.efficiency();
        let mut constant = [0.0f64; 2];
        for instant in instants.iter().filter(|i| i.omega != 0.0) {
            let terms = &instant.terms;
            let torque = terms.potential + terms.viscous + terms.coulomb;
            let resisting = torque * instant.omega.signum() / ratio;
            let [most, driving] = &mut constant;
            let beside = file.drive_train.beside(instant.omega);
            *most = most.max(resisting / efficiency + beside);
            *driving = driving.max(-resisting * efficiency - beside);
        }
        Self {
            moves: self.moves,
            move_rate: self.move_rate / time,
            drive_frequency: self.drive_frequency / time,
            run_on: RunOn::of(instants, ratio, rest.largest()),
            slides: self.slides,
            rest: rest.times(1.0 / efficiency),
            constant,
            falls: self.falls,
            stop: Stop::of(instants, smooth, ratio),
            train_ratio: ratio,
            tool_slope: self.tool_slope,
            elements: self.elements.clone(),
        }
    }
}

/// The largest |x′| of the tool, or |ψ′| of a turning tool. Positions in which the mechanism cannot be placed were refused before.
fn tool_slope(file: &MachineFile, instants: &[Instant]) -> Option<f64> {
    let tool = file.site.tool.as_ref()?;
    let mechanism = file.machine.mechanism();
    let slope = |instant: &Instant| {
        let frames = mechanism.frames(instant.phi).ok()?;
        let frame = frames.get(tool.link)?;
        Some(match tool.place {
            ToolPlace::Point(at) => {
                let [x, y] = frame.point(at);
                math::hypot(x.d1, y.d1)
            }
            ToolPlace::Turning => frame.psi.d1.abs(),
        })
    };
    instants
        .iter()
        .map(slope)
        .try_fold(0.0, |most, slope| Some(f64::max(most, slope?)))
}
