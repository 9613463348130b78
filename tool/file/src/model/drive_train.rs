//! The drive train: stages in a chain from the motor to the drive link, and branches beside it.
//!
//! A branch is a shaft that one of the train's shafts drives through stages of its own, as a friction disc drives several rollers or a line shaft its
//! pumps: a fan. Each has its own direction of power. While the machine brakes, the inertia of a branch may feed back through its stages although the
//! machine takes power, and its losses change sides with it. With the torque M of the branch's own friction at its end
//!
//! ```text
//! T_k = T_(chain behind k) + Σ T_branch       T_branch = (J·α_b + M·sgn ω_b + b·ω_b) through its stages, by its own flow of power
//! ```

use crate::problem;
use crate::text::problem::Problem;
use jred::error::Error;
use jred::mechanism::{Stage, Train, TrainInput, TrainOutput};

use crate::model::machine::MachineFile;
use crate::number::numerics::sign;

/// Refuses a machine whose drive train has branches, for a command that finds bends of the torque only in the chain.
///
/// # Errors
/// The drive train has branches.
pub fn refuse(file: &MachineFile, command: &str) -> Result<(), Problem> {
    let Some(branch) = file.drive_train.branches().first() else {
        return Ok(());
    };
    Err(problem!(
        help = "for this command refer the branches to the drive link: their inertia as `flywheel`, their friction as a [[load]] on it",
        "`jred {command}` cannot be used with branches of the drive train: {} has losses of its own, which change sides at its own instants",
        branch.name
    ))
}

/// A shaft beside the chain, and its load.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Name in reports.
    pub name: String,
    /// The shaft of the chain that drives it: 0 is the input, then one after each stage.
    pub shaft: usize,
    /// Its stages, seen from that shaft, with the inertia of its load.
    pub train: Train,
    /// Friction of its load (N·m), against its rotation.
    pub opposing: f64,
    /// Viscous friction of its load (N·m·s/rad).
    pub viscous: f64,
}

impl Branch {
    /// The torque that the chain's shaft must give it; `seen` receives each of its stages with its output torque.
    fn input(&self, shaft: &TrainOutput, seen: impl FnMut(&Stage, f64)) -> TrainInput {
        let ratio = self.train.ratio();
        let [omega, alpha, direction] =
            [shaft.omega, shaft.alpha, shaft.direction].map(|of| of / ratio);
        let torque = self.opposing * sign(direction) + self.viscous * omega;
        let at_end = TrainOutput {
            torque,
            torque_per_alpha: 0.0,
            omega,
            alpha,
            direction,
        };
        let mut input = self.train.input_by_stages(&at_end, seen);
        // By the acceleration of the chain's shaft.
        input.torque_per_alpha /= ratio;
        input.loss += torque * omega;
        input
    }

    /// Inertia at the chain's shaft (kg·m²).
    fn inertia(&self) -> f64 {
        self.train.inertia_at_input()
    }
}

/// A stage of the chain, or of a branch.
enum StagePosition<'a> {
    Chain(&'a Stage),
    Branch(&'a Stage),
}

/// The fixed stages between the motor and the drive link, with their branches.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveTrain {
    chain: Train,
    /// Each stage of the chain as a train.
    steps: Vec<Train>,
    branches: Vec<Branch>,
}

impl DriveTrain {
    /// A chain with its branches.
    ///
    /// # Errors
    /// Never for a chain that was built without error.
    pub fn new(chain: Train, branches: Vec<Branch>) -> Result<Self, Error> {
        let steps = chain
            .stages()
            .iter()
            .map(|stage| Ok(Train::new(&[*stage])?));
        Ok(Self {
            steps: steps.collect::<Result<_, Error>>()?,
            chain,
            branches,
        })
    }

    /// The same with a flywheel (kg·m²) on the shaft that drives stage `number`, counted from 0.
    ///
    /// # Errors
    /// The inertia is negative or not finite.
    pub fn with_flywheel(&self, number: usize, inertia: f64) -> Result<Self, Error> {
        let mut stages = self.stages().to_vec();
        if let Some(stage) = stages.get_mut(number) {
            *stage = stage.with_flywheel(inertia)?;
        }
        Self::new(Train::new(&stages)?, self.branches.clone())
    }

    /// The stages of the chain, in order from the motor.
    pub fn stages(&self) -> &[Stage] {
        self.chain.stages()
    }

    /// The branches.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Signed ratio of the chain, ω_input/ω_output.
    pub fn ratio(&self) -> f64 {
        self.chain.ratio()
    }

    /// Efficiency of the chain.
    pub fn efficiency(&self) -> f64 {
        self.chain.efficiency()
    }

    /// Inertia of all shafts, including the branches, at the input shaft (kg·m²).
    pub fn inertia_at_input(&self) -> f64 {
        let beside = self.branches.iter().map(|branch| {
            let before = self.stages().iter().take(branch.shaft);
            let ratio: f64 = before.map(Stage::ratio).product();
            branch.inertia() / (ratio * ratio)
        });
        self.chain.inertia_at_input() + beside.sum::<f64>()
    }

    /// The torque at the input for the branches at a constant speed of the drive link (N·m), in the direction of motion.
    pub fn beside(&self, omega: f64) -> f64 {
        let input = self.input(&TrainOutput {
            omega,
            direction: omega,
            ..TrainOutput::default()
        });
        input.torque.abs()
    }

    /// The required input of the drive train for the output torque during a motion: shaft by shaft, each stage of the chain and of a branch by its
    /// own direction of power ([`Train::input`]). The losses include the friction of the branches.
    pub fn input(&self, output: &TrainOutput) -> TrainInput {
        if self.branches.is_empty() {
            return self.chain.input(output);
        }
        self.walk(output, |_, _| ())
    }

    /// Output torque of each stage (N·m), in order from the motor.
    pub fn delivered(&self, output: &TrainOutput) -> Vec<f64> {
        let mut delivered = Vec::with_capacity(self.steps.len());
        self.walk(output, |of, torque| {
            if let StagePosition::Chain(_) = of {
                delivered.push(torque);
            }
        });
        delivered.reverse();
        delivered
    }

    /// Whether a stage has losses, which depend on its direction of power.
    pub fn is_lossy(&self) -> bool {
        let branches = self
            .branches
            .iter()
            .flat_map(|branch| branch.train.stages());
        let mut all = self.stages().iter().chain(branches);
        all.any(|stage| stage.efficiency() < 1.0)
    }

    /// Output torque (N·m) of each stage with losses, in the chain and in the branches, always in the same order. While the shafts turn in one
    /// direction, the torque at the input bends where one of these changes sign.
    pub fn lossy_flows(&self, output: &TrainOutput) -> Vec<f64> {
        let mut delivered = Vec::new();
        self.walk(output, |of, torque| {
            let (StagePosition::Chain(stage) | StagePosition::Branch(stage)) = of;
            if stage.efficiency() < 1.0 {
                delivered.push(torque);
            }
        });
        delivered
    }

    /// From the output shaft to the input; `seen` receives the output torque of each stage.
    fn walk(&self, output: &TrainOutput, mut seen: impl FnMut(StagePosition, f64)) -> TrainInput {
        let mut input = TrainInput::default();
        let mut shaft = *output;
        // Per acceleration of the current shaft, which turns `ratio` times as fast as the output.
        let mut ratio = 1.0;
        for k in (0..=self.steps.len()).rev() {
            for branch in self.branches.iter().filter(|branch| branch.shaft == k) {
                let own = branch.input(&shaft, |stage, torque| {
                    seen(StagePosition::Branch(stage), torque);
                });
                shaft.torque += own.torque;
                shaft.torque_per_alpha += own.torque_per_alpha;
                input.loss += own.loss;
            }
            let Some((step, stage)) = k
                .checked_sub(1)
                .and_then(|k| Some((self.steps.get(k)?, self.stages().get(k)?)))
            else {
                break;
            };
            let [_, driven] = stage.inertias();
            seen(
                StagePosition::Chain(stage),
                shaft.torque + driven * shaft.alpha,
            );
            let before = step.input(&shaft);
            input.loss += before.loss;
            let i = stage.ratio();
            ratio *= i;
            shaft = TrainOutput {
                torque: before.torque,
                torque_per_alpha: before.torque_per_alpha / i,
                omega: shaft.omega * i,
                alpha: shaft.alpha * i,
                direction: shaft.direction * i,
            };
        }
        input.torque = shaft.torque;
        input.torque_per_alpha = shaft.torque_per_alpha * ratio;
        input
    }
}
