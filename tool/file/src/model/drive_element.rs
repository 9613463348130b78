//! Belts, screws and pinions between motor and machine, with the limits of their makers.

use crate::model::rule::Rule;

/// A belt, a screw or a pinion.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveElement {
    /// Name in messages: "belt of the drive train (stage 2)".
    pub name: String,
    /// Index of its stage in the drive train; `None`: the mechanism itself.
    pub stage: Option<usize>,
    /// Whether its driving wheel is on the shaft of the motor or its gearbox.
    pub on_input: bool,
    /// Torque (or force) that the stage delivers, or that the drive link gives on, over the force in the element (m, or 1).
    pub arm: f64,
    /// Inertia (kg·m²) that the model has on the driving shaft and the element moves: of the belt and of idlers. Of a stage: mass of the belt (kg).
    pub carried: f64,
    /// Its kind.
    pub kind: ElementKind,
    /// Its limits by rule: forces (N), the speed of a screw (rad/s).
    pub limits: Vec<(Rule, f64)>,
}

/// A kind of element, and what makes it pull at its shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementKind {
    /// A belt, with the static force of one strand (N).
    Belt(BeltForm, Option<f64>),
    /// A screw, coupled at its end.
    Screw,
    /// A pinion in a rack, with its radial and axial force over the tangential one.
    Pinion([f64; 2]),
}

/// Where a belt gives up its effective force F, and so how its strands, with the pretension T₀, share it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BeltForm {
    /// At a second pulley, between strands of equal length: T₀ ± F/2.
    Pulleys,
    /// At a carriage, which divides the belt in lengths a and b: T₀ + F·b/(a + b) and T₀ − F·a/(a + b), at worst T₀ ± F at one end of the way.
    Carriage,
    /// Evenly along the carrying strand: T₀ + ¾·F and T₀ − ¼·F.
    Carrying,
}

impl BeltForm {
    /// Shares of F that the tight strand has above T₀, the slack strand below T₀, and both together above 2·T₀.
    pub const fn shares(self) -> [f64; 3] {
        match self {
            Self::Pulleys => [0.5, 0.5, 0.0],
            Self::Carriage => [1.0, 1.0, 1.0],
            Self::Carrying => [0.75, 0.25, 0.5],
        }
    }
}

/// Modulus of elasticity of steel (Pa).
const STEEL: f64 = 206e9;

/// Stress under the axial force that THK allows a ball screw (Pa): general catalogue 514E, A15-30.
const SCREW_STRESS: f64 = 147e6;

/// Density of steel (kg/m³).
const DENSITY: f64 = 7850.0;

/// Supports of a screw's two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScrewEnds {
    /// Both clamped.
    FixedFixed,
    /// One clamped, the other guided.
    FixedSupported,
    /// Both guided.
    SupportedSupported,
    /// One clamped, the other without a bearing.
    FixedFree,
}

impl ScrewEnds {
    /// All, in the order of their words.
    pub const ALL: [Self; 4] = [
        Self::FixedFixed,
        Self::FixedSupported,
        Self::SupportedSupported,
        Self::FixedFree,
    ];

    /// Effective length of Euler's column over its length: x of the first root of cos x = 1, tan x = x, sin x = 0, cos x = 0 gives π/x.
    const fn buckling(self) -> f64 {
        match self {
            Self::FixedFixed => 0.5,
            Self::FixedSupported => std::f64::consts::PI / 4.493_409_457_909_064,
            Self::SupportedSupported => 1.0,
            Self::FixedFree => 2.0,
        }
    }

    /// First root λ of the bending oscillation of a uniform shaft: cos λ·cosh λ = 1, tan λ = tanh λ, sin λ = 0, cos λ·cosh λ = −1.
    const fn bending(self) -> f64 {
        match self {
            Self::FixedFixed => 4.730_040_744_862_704,
            Self::FixedSupported => 3.926_602_312_047_919,
            Self::SupportedSupported => std::f64::consts::PI,
            Self::FixedFree => 1.875_104_068_711_961,
        }
    }
}

/// The shaft of a screw: steel, as thick as the root of its thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewShaft {
    /// Root diameter of the thread (m).
    pub root_diameter: f64,
    /// Largest length without a support (m).
    pub free_length: f64,
    /// Its supports.
    pub ends: ScrewEnds,
}

impl ScrewShaft {
    /// Euler's force π³·E·d⁴/(64·(K·L)²) (N), at which the shaft buckles.
    pub fn buckling_force(&self) -> f64 {
        let length = self.ends.buckling() * self.free_length;
        std::f64::consts::PI.powi(3) * STEEL * self.root_diameter.powi(4) / (64.0 * length * length)
    }

    /// Force (N) at which the root of the thread has the stress that makers allow.
    pub fn yield_force(&self) -> f64 {
        0.25 * std::f64::consts::PI * self.root_diameter.powi(2) * SCREW_STRESS
    }

    /// Critical speed (λ/L)²·d/4·√(E/ρ) (rad/s), the lowest bending frequency.
    pub fn critical_speed(&self) -> f64 {
        let per_length = self.ends.bending() / self.free_length;
        per_length * per_length * 0.25 * self.root_diameter * (STEEL / DENSITY).sqrt()
    }
}

impl DriveElement {
    /// Radial and axial force (N) on the shaft of the element's driving wheel under its largest force (N); `None`: it pulls at the shaft, but the
    /// machine file does not say how much.
    ///
    /// A belt pulls with both strands, as if they were parallel, or with the effective force where that slackens one strand.
    pub fn pull(&self, force: f64) -> Option<[f64; 2]> {
        match self.kind {
            ElementKind::Belt(form, pretension) => {
                let [_, _, both] = form.shares();
                Some([(2.0 * pretension? + both * force).max(force), 0.0])
            }
            ElementKind::Screw => Some([0.0; 2]),
            ElementKind::Pinion(push) => Some(push.map(|share| share * force)),
        }
    }
}
