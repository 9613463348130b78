//! The duty of an altered machine: slower, lighter, or under other process loads.
//!
//! All three alterations are exact and need no new sampling of the machine. At the same positions, a cycle that takes s times as long has 1/s times
//! the speeds and 1/s² times the accelerations, so that
//!
//! ```text
//! T(s, m, p) = m·(J·α + ½·J′·ω²)/s² + m·U′_weight + U′_springs + p·process + b·ω/s + c·sgn ω
//! ```
//!
//! m scales every mass and inertia of the mechanism, its payload and its flywheel; p every force and moment of given direction. The drive train keeps
//! its inertia and its losses, which are computed again at every instant. Friction by a coefficient in joints depends on all three, so no such machine
//! is altered.

use jred::error::Error;
use jred::machine::{Machine, TorqueTerms};
use jred::mechanism::TrainOutput;

use jred_analysis::duty::mechanics::{
    Alteration, ElementLoad, HoldingTorques, Mechanics, Rest, constant_loads,
};
use jred_analysis::duty::{Duty, Instant, Smooth};
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;
use jred_file::model::schedule::ScheduleInstant;

/// A machine's duty, prepared for alterations.
#[derive(Clone, Debug)]
pub struct DutyModel<'a> {
    file: &'a MachineFile,
    duty: &'a Duty,
    /// U′ of the weight at every instant (N·m).
    weights: Vec<f64>,
    /// Torque against the constant loads, at every instant at rest (N·m).
    constant: Vec<f64>,
    /// The instants of an [outline](Self::outline), if some can be omitted.
    outline: Option<Vec<usize>>,
    /// [U′ of the weight, U′ of the rest] at positions over the range, and at instants with a payload (N·m).
    range: Vec<[f64; 2]>,
}

impl<'a> DutyModel<'a> {
    /// Prepares a duty.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn new(file: &'a MachineFile, duty: &'a Duty) -> Result<Self, Error> {
        let machine = &file.machine;
        let bare = |machine: &Machine<AnyMechanism>| -> Result<Machine<AnyMechanism>, Error> {
            Ok(Machine::new(machine.mechanism().clone()).with_gravity(machine.gravity())?)
        };
        let weight = |bare: &Machine<AnyMechanism>, phi: f64| -> Result<f64, Error> {
            let links = bare.bare_reduction(phi)?.potential_slope;
            Ok(links + file.payload_weight(phi)?)
        };
        let own = bare(machine)?;
        let laden = (file.schedule.machines().map(bare)).collect::<Result<Vec<_>, Error>>()?;
        let weights = (duty.instants.iter())
            .map(|i| {
                let now = ScheduleInstant::of(i.t, i.omega);
                if file.schedule.flows() {
                    return weight(&bare(&*file.machine_at(&now, i.phi)?)?, i.phi);
                }
                let number = file.schedule.number(&now);
                weight(laden.get(number).unwrap_or(&own), i.phi)
            })
            .collect::<Result<Vec<f64>, Error>>()?;
        let mut range = (file.over_range()?.iter())
            .map(|(phi, reduction)| {
                let weight = weight(&own, *phi)?;
                Ok([weight, reduction.potential_slope - weight])
            })
            .collect::<Result<Vec<[f64; 2]>, Error>>()?;
        let carried = duty.instants.iter().zip(&weights);
        let carried = carried.filter(|(i, _)| file.schedule.is_laden(i.t));
        range.extend(carried.map(|(i, weight)| [*weight, i.terms.potential - weight]));
        Ok(Self {
            range,
            weights,
            constant: constant_loads(file, &duty.instants)?,
            outline: outline(&duty.instants),
            file,
            duty,
        })
    }

    /// Whether alterations of time, masses and loads are exact: friction by a coefficient in the joints depends on all of them.
    pub fn scales(&self) -> bool {
        self.file.machine.frictions().is_empty()
    }

    /// The original duty.
    pub const fn original(&self) -> &'a Duty {
        self.duty
    }

    /// The altered duty.
    pub fn duty(&self, by: Alteration) -> Duty {
        Duty {
            smooth: self.duty.smooth.clone(),
            ..self.of(0..self.duty.instants.len(), by)
        }
    }

    /// The altered duty without the instants that only resolve a peak; `None` if there are no such instants. Its integrals, its moves and the
    /// extremes of its inertia equal those of the whole duty, and no peak is higher. So if it violates a rule that needs no time course, the whole
    /// duty does too.
    pub fn outline(&self, by: Alteration) -> Option<Duty> {
        let some = self.outline.as_ref()?;
        Some(Duty {
            smooth: self.duty.smooth.among(some),
            ..self.of(some.iter().copied(), by)
        })
    }

    /// The altered duty at some of its instants.
    fn of(&self, instants: impl Iterator<Item = usize>, by: Alteration) -> Duty {
        let ratio = self.file.drive_train.ratio();
        let (instants, constant): (Vec<Instant>, Vec<f64>) = instants
            .map(|k| {
                let instant = self.instant(&self.duty.instants[k], self.weights[k], by);
                (instant, by.process * self.constant[k])
            })
            .unzip();
        let duration = self.duty.duration * by.time;
        let held = HoldingTorques {
            instants: &instants,
            constant: &constant,
            duration,
            cyclic: self.file.motion.as_ref().is_some_and(|m| m.cyclic),
        };
        let weights = self.range.iter();
        let weights = weights.map(|[weight, rest]| by.mass * weight + rest);
        let rest = Rest::new(&held, weights).times(1.0 / ratio.abs());
        let hold_torque = rest.largest();
        Duty {
            mechanics: Mechanics {
                elements: ElementLoad::all(self.file, &instants, by),
                ..(self.duty.mechanics).with_loads(
                    self.file,
                    &instants,
                    &Smooth::default(),
                    by.time,
                    rest,
                )
            },
            hold_torque,
            duration,
            instants,
            smooth: Smooth::default(),
        }
    }

    fn instant(&self, instant: &Instant, weight: f64, by: Alteration) -> Instant {
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let rate = 1.0 / by.time;
        let inertia = instant.inertia * by.mass;
        let terms = &instant.terms;
        let terms = TorqueTerms {
            acceleration: terms.acceleration * (by.mass * rate * rate),
            velocity: terms.velocity * (by.mass * rate * rate),
            potential: terms.potential + (by.mass - 1.0) * weight,
            process: terms.process * by.process,
            viscous: terms.viscous * rate,
            coulomb: terms.coulomb,
        };
        let (omega, alpha) = (instant.omega * rate, instant.alpha * rate * rate);
        let input = train.input(&TrainOutput {
            torque: terms.total(),
            torque_per_alpha: inertia,
            omega,
            alpha,
            direction: instant.direction,
        });
        Instant {
            t: instant.t * by.time,
            weight: instant.weight * by.time,
            phi: instant.phi,
            omega,
            alpha,
            direction: instant.direction,
            inertia,
            terms,
            joint_friction: instant.joint_friction,
            input_torque: input.torque,
            input_speed: omega * ratio,
            input_alpha: alpha * ratio,
            input_inertia: inertia / (ratio * ratio) + train.inertia_at_input(),
        }
    }
}

/// The instants with a weight in the integrals, and those of the extremes; `None` if these are all.
fn outline(instants: &[Instant]) -> Option<Vec<usize>> {
    let figures: [fn(&Instant) -> f64; 4] =
        [|i| i.inertia, |i| i.omega, |i| i.alpha, |i| i.input_torque];
    let extremes = figures.into_iter().flat_map(|figure| {
        let by = |a: &usize, b: &usize| figure(&instants[*a]).total_cmp(&figure(&instants[*b]));
        [
            (0..instants.len()).min_by(by),
            (0..instants.len()).max_by(by),
        ]
    });
    let extremes: Vec<usize> = extremes.flatten().collect();
    let all = instants.iter().enumerate();
    let some = all.filter(|(k, instant)| instant.weight > 0.0 || extremes.contains(k));
    let some: Vec<usize> = some.map(|(k, _)| k).collect();
    (some.len() < instants.len()).then_some(some)
}
