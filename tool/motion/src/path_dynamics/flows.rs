//! The torque of a motion as the highest of linear forms.
//!
//! A stage of efficiency η ≤ 1 needs τ/η where it drives the machine and η·τ where power flows back: always the larger of both. So for the load X and
//! the acceleration a of the drive link
//!
//! ```text
//! T = maxₖ (pₖ·X + qₖ·a) + d·v + e
//! ```
//!
//! with one form for each combination of power directions through the stages. T rises with a, so the acceleration by a torque is the least of the
//! forms' accelerations. Neither needs a search.

use jred_file::model::drive_train::DriveTrain;
use jred_sizing::cycle::form::Coefficients;

use super::Demand;

/// One combination of power directions through the stages with losses.
#[derive(Clone, Copy, Debug)]
struct Flow {
    /// pₖ: torque per torque of the load.
    load: f64,
    /// qₖ: inertia of shafts and rotor, per acceleration of the drive link (kg·m²).
    inertia: f64,
}

/// The torque of a shaft by load, acceleration and speed of the drive link.
#[derive(Clone, Debug)]
pub(super) struct Flows {
    each: Vec<Flow>,
    /// d: friction per speed of the drive link.
    viscous: f64,
    /// e: friction.
    constant: f64,
}

impl Flows {
    /// The torque of the motor before a drive train; its coefficients are by the loads at the train's input. Commands refuse branches here.
    pub(super) fn new(train: &DriveTrain, motor: &Coefficients) -> Self {
        debug_assert!(train.branches().is_empty(), "branches are not counted");
        let first = Flow {
            load: 1.0,
            inertia: 0.0,
        };
        let mut flows = vec![first];
        let mut ratio = 1.0;
        for stage in train.stages().iter().rev() {
            let i = stage.ratio().abs();
            let [driver, driven] = stage.inertias();
            let behind = ratio * driven;
            ratio *= i;
            let efficiency = stage.efficiency();
            flows = through(&flows, behind, [1.0 / (i * efficiency), efficiency / i]);
            for flow in &mut flows {
                flow.inertia += ratio * driver;
            }
        }
        let [rotor, driving, back, viscous, constant] = motor.0;
        flows = through(&flows, 0.0, [driving, back]);
        for flow in &mut flows {
            flow.inertia += ratio * rotor;
        }
        Self {
            each: flows,
            viscous: viscous * ratio,
            constant,
        }
    }

    /// Whether the direction of power makes no difference.
    pub(super) fn is_lossless(&self) -> bool {
        self.each.len() < 2
    }

    /// The torque for load, acceleration and speed, and the index of its form. The slope includes the load's own inertia.
    pub(super) fn demand(&self, load: [f64; 2], acceleration: f64, speed: f64) -> (Demand, usize) {
        let [resisting, inertia] = load;
        let load = resisting + inertia * acceleration;
        let own = |flow: &Flow| flow.load * load + flow.inertia * acceleration;
        let torques = self.each.iter().map(own).zip(0..);
        let higher =
            |one: (f64, usize), other: (f64, usize)| if other.0 > one.0 { other } else { one };
        let (torque, which) = torques.fold((f64::NEG_INFINITY, 0), higher);
        let slope = |flow: &Flow| flow.load * inertia + flow.inertia;
        let demand = Demand {
            torque: torque + self.drag(speed),
            per_acceleration: self.each.get(which).map_or(0.0, slope),
        };
        (demand, which)
    }

    /// The acceleration by a torque: the inverse of [`demand`](Self::demand).
    pub(super) fn acceleration(
        &self,
        [resisting, inertia]: [f64; 2],
        torque: f64,
        speed: f64,
    ) -> f64 {
        let torque = torque - self.drag(speed);
        let of =
            |flow: &Flow| (torque - flow.load * resisting) / (flow.load * inertia + flow.inertia);
        self.each.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    fn drag(&self, speed: f64) -> f64 {
        self.viscous * speed + self.constant
    }
}

/// Each form, driving and back, through a stage with an inertia at its output.
fn through(flows: &[Flow], inertia: f64, factors: [f64; 2]) -> Vec<Flow> {
    let [driving, back] = factors;
    let factors = if driving.total_cmp(&back).is_eq() {
        &factors[..1]
    } else {
        &factors[..]
    };
    let each = flows.iter().flat_map(|flow| {
        factors.iter().map(move |factor| Flow {
            load: factor * flow.load,
            inertia: factor * (flow.inertia + inertia),
        })
    });
    each.collect()
}
