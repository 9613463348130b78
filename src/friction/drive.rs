//! A friction drive: stages in a chain or in a fan, and its equation of motion.
//!
//! Shaft 1 drives; every shaft k has the speed ω_k = j_k·ω (III.12), (III.19). With L the torque of the contact on its second shaft and f·L on its
//! first, Newton's law for each shaft gives, without the contact torques,
//!
//! ```text
//! Σ h_k·J_k·(j_k·ω̇ + j̇_k·ω) = Σ h_k·M_k          h_k: product of the f from shaft 1 to shaft k
//! ideal contact, f = j:   J·ω̇ + ½·(dJ/dt)·ω = T,   J = Σ J_k·j_k²,   T = Σ j_k·M_k        (A)
//! real slip,     f = i:   (J₁ + i·j·J₂)·ω̇ + i·j̇·J₂·ω = T₁ − i·T₂,   loss = L·(i − j)·ω    for two shafts
//! ```
//!
//! The factor ½ comes from the power balance d(½Jω²)/dt = T·ω. With a ratio shifted over time the constraint cannot be integrated
//! ([`Drive::integrability`]); Lagrange's equation for the reduced kinetic energy would give a factor 1 and constant ω·J in a free run, while the
//! machine keeps ω·√J constant. The literature also treats the shifted variator as non-holonomic: M. Čavić, M. Penčić, M. Zlokolica, *Thermal
//! Science* 20 (2016) S525-S536.

use super::course::OperatingPoint;
use super::error::FrictionError;
use super::stage::{Flow, Ratios, Stage};
use super::state::{ContactMotion, Motion, Shaft, ShaftMotion, State};
use crate::machine::MAX_STAGES;
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::finite;

/// Greatest number of shafts.
pub const MAX_SHAFTS: usize = MAX_STAGES + 1;

/// Greatest number of iterations of load and slip.
const ROUNDS: usize = 100;

/// Arrangement of the stages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Arrangement {
    /// In series (III.12): stage k couples shaft k to shaft k + 1.
    #[default]
    Chain,
    /// In parallel (III.19): stage k couples shaft 1 to shaft k + 1.
    Fan,
}

/// Effect of slip on the torque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Contact {
    /// No loss: torques have the ratio j of the speeds.
    #[default]
    Ideal,
    /// Torques have the ratio i of the radii, speeds the ratio j: the power F·v_slip is lost.
    Slipping,
}

/// A friction drive.
#[derive(Clone, Debug)]
pub struct Drive<'a> {
    arrangement: Arrangement,
    contact: Contact,
    stages: heapless::Vec<Stage<'a>, MAX_STAGES>,
}

/// Which quantity is given.
#[derive(Clone, Copy)]
enum Input {
    /// The acceleration is given, the drive's torque unknown.
    Alpha(f64),
    /// All torques are given.
    Torques,
}

/// Coefficients of a shaft.
#[derive(Clone, Copy)]
struct ShaftCoefficients {
    /// j
    speed: f64,
    /// dj/dt
    rate: f64,
    /// h
    force: f64,
}

/// The coefficients at one state.
struct Kinematics {
    shafts: heapless::Vec<ShaftCoefficients, MAX_SHAFTS>,
    stages: heapless::Vec<(Ratios, f64), MAX_STAGES>,
}

impl<'a> Drive<'a> {
    /// Stages in order from shaft 1.
    ///
    /// # Errors
    /// No stage, or more than [`MAX_STAGES`].
    pub fn new(
        arrangement: Arrangement,
        contact: Contact,
        stages: &[Stage<'a>],
    ) -> Result<Self, FrictionError> {
        if stages.is_empty() {
            return Err(RangeError::NotPositive("number of friction stages", 0.0).into());
        }
        let stages = heapless::Vec::from_slice(stages).map_err(|_| RangeError::TooMany {
            what: "friction stages",
            capacity: MAX_STAGES,
        })?;
        Ok(Self {
            arrangement,
            contact,
            stages,
        })
    }

    /// Arrangement of the stages.
    pub const fn arrangement(&self) -> Arrangement {
        self.arrangement
    }

    /// The stages.
    pub fn stages(&self) -> &[Stage<'a>] {
        &self.stages
    }

    /// Index of the first shaft of stage `stage`; its second shaft is `stage + 1`.
    #[must_use]
    pub const fn first_shaft(&self, stage: usize) -> usize {
        match self.arrangement {
            Arrangement::Chain => stage,
            Arrangement::Fan => 0,
        }
    }

    /// The acceleration under the given torques.
    ///
    /// Where a ratio or slip depends on the load, load and slip are solved together, to rounding. dj/dt ignores the rate of change of the load: this
    /// is the quasi-static form, valid while the load changes slowly compared with J·s·ω/limit (s: slip at the limit).
    /// [`CreepContact`](super::CreepContact) makes no such assumption.
    ///
    /// Accuracy: energy of a free run with a shifted ratio 1e-10 (test `free_run_keeps_the_energy`); against two shafts with an explicit contact
    /// force 1e-9 (test `two_discs_with_a_contact_force`).
    ///
    /// # Errors
    /// Numbers of angles or shafts that do not match; a course outside its range; no inertia; load and slip that do not converge, because the slip
    /// grows too fast with the load.
    pub fn forward(&self, state: State, shafts: &[Shaft]) -> Result<Motion, FrictionError> {
        self.solve(state, shafts, Input::Torques)
    }

    /// The drive's torque on shaft 1, [`Motion::drive`], for the acceleration `alpha` of shaft 1 (rad/s²). Load and slip as in
    /// [`forward`](Self::forward).
    ///
    /// # Errors
    /// As [`forward`](Self::forward), or an acceleration that is not finite.
    pub fn inverse(
        &self,
        state: State,
        alpha: f64,
        shafts: &[Shaft],
    ) -> Result<Motion, FrictionError> {
        let alpha = finite("acceleration", alpha)?;
        self.solve(state, shafts, Input::Alpha(alpha))
    }

    fn solve(&self, state: State, shafts: &[Shaft], given: Input) -> Result<Motion, FrictionError> {
        let expected = self.stages.len() + 1;
        for (what, count) in [
            ("number of angles", state.angles.len()),
            ("number of shafts", shafts.len()),
        ] {
            if count != expected {
                return Err(RangeError::OutOfRange {
                    what,
                    value: count as f64,
                    min: expected as f64,
                    max: expected as f64,
                }
                .into());
            }
        }
        finite("time", state.t)?;
        finite("speed", state.omega)?;
        for angle in state.angles {
            finite("angle of a shaft", *angle)?;
        }
        let mut loads = [0.0; MAX_STAGES];
        for _ in 0..ROUNDS {
            let kinematics = self.kinematics(&state, &loads)?;
            let motion = self.balance(&state, shafts, given, &kinematics)?;
            if self.settled(&kinematics, &motion, &mut loads) {
                return Ok(motion);
            }
        }
        Err(FrictionError::NotSettled)
    }

    /// Updates `loads`; returns whether they are those used for the coefficients.
    fn settled(
        &self,
        kinematics: &Kinematics,
        motion: &Motion,
        loads: &mut [f64; MAX_STAGES],
    ) -> bool {
        let mut settled = true;
        for (k, (stage, (ratios, _))) in self.stages.iter().zip(&kinematics.stages).enumerate() {
            let (Some(contact), Some(load)) = (motion.contacts.get(k), loads.get_mut(k)) else {
                continue;
            };
            let first = motion.shafts.get(self.first_shaft(k));
            // From rest, the flow of the motion to come.
            let turning = first.map_or(0.0, |s| if s.omega == 0.0 { s.alpha } else { s.omega });
            let along = match stage.flow() {
                Flow::FirstDrives => 1.0,
                Flow::SecondDrives => -1.0,
            };
            let found =
                along * contact.torque * math::sign(ratios.geometric.value) * math::sign(turning);
            let depends = ratios.geometric.slope[2] != 0.0 || ratios.slip.slope[2] != 0.0;
            if depends {
                let change = math::abs(found - *load);
                settled &= change <= 8.0 * f64::EPSILON * math::abs(found);
            }
            *load = found;
        }
        settled
    }

    fn kinematics(
        &self,
        state: &State,
        loads: &[f64; MAX_STAGES],
    ) -> Result<Kinematics, FrictionError> {
        let mut shafts = heapless::Vec::new();
        let mut stages = heapless::Vec::new();
        // Pushes cannot fail: the capacities are the number of stages, and one more.
        let input = ShaftCoefficients {
            speed: 1.0,
            rate: 0.0,
            force: 1.0,
        };
        let _ = shafts.push(input);
        for (k, (stage, load)) in self.stages.iter().zip(loads).enumerate() {
            let first = self.first_shaft(k);
            let a = shafts.get(first).copied().unwrap_or(input);
            let phi = state.angles.get(first).copied().unwrap_or(0.0);
            let ratios = stage.at(OperatingPoint::at_time(state.t)
                .with_angle(phi)
                .with_load(*load))?;
            let j = ratios.speed.value;
            let [by_t, by_phi, _] = ratios.speed.slope;
            let rate = by_t + by_phi * a.speed * state.omega;
            let force = match self.contact {
                Contact::Ideal => j,
                Contact::Slipping => ratios.geometric.value,
            };
            let _ = shafts.push(ShaftCoefficients {
                speed: a.speed * j,
                rate: a.rate * j + a.speed * rate,
                force: a.force * force,
            });
            let _ = stages.push((ratios, force));
        }
        Ok(Kinematics { shafts, stages })
    }

    fn balance(
        &self,
        state: &State,
        shafts: &[Shaft],
        given: Input,
        kinematics: &Kinematics,
    ) -> Result<Motion, FrictionError> {
        let omega = state.omega;
        // Σ h·J·j, Σ h·J·j̇·ω, Σ h·(M − ½·J′·ω_k²)
        let (mut mass, mut drag, mut torque) = (0.0, 0.0, 0.0);
        let mut motion = Motion::default();
        for (shaft, c) in shafts.iter().zip(&kinematics.shafts) {
            let own = c.speed * omega;
            let [inertia, slope] = shaft.inertia;
            mass += c.force * inertia * c.speed;
            drag += c.force * inertia * c.rate * omega;
            torque += c.force * (shaft.external(own) - 0.5 * slope * own * own);
            motion.inertia += inertia * c.speed * c.speed;
            motion.inertia_rate += (2.0 * inertia * c.rate + slope * own * c.speed) * c.speed;
        }
        if finite("inertia of the friction drive", mass)? <= 0.0 {
            return Err(RangeError::NotPositive("inertia of the friction drive", mass).into());
        }
        finite("torques of the friction drive", torque)?;
        (motion.alpha, motion.drive) = match given {
            Input::Alpha(alpha) => (alpha, mass * alpha + drag - torque),
            Input::Torques => ((torque - drag) / mass, 0.0),
        };
        for (k, (shaft, c)) in shafts.iter().zip(&kinematics.shafts).enumerate() {
            let own = c.speed * omega;
            let drive = if k == 0 { motion.drive } else { 0.0 };
            let _ = motion.shafts.push(ShaftMotion {
                coefficient: [c.speed, c.rate],
                omega: own,
                alpha: c.speed * motion.alpha + c.rate * omega,
                torque: shaft.external(own) + drive,
            });
        }
        self.add_contacts(shafts, kinematics, &mut motion);
        Ok(motion)
    }

    /// Contact torques from the last stage to the first: L = J·ω̇_k + ½·J′·ω_k² − M + the torque that the shaft passes on.
    fn add_contacts(&self, shafts: &[Shaft], kinematics: &Kinematics, motion: &mut Motion) {
        let mut passed_on = 0.0;
        let mut torques = [0.0; MAX_STAGES];
        for k in (0..self.stages.len()).rev() {
            let (Some(shaft), Some(moving), Some((_, force))) = (
                shafts.get(k + 1),
                motion.shafts.get(k + 1),
                kinematics.stages.get(k),
            ) else {
                continue;
            };
            let [inertia, slope] = shaft.inertia;
            let own =
                inertia * moving.alpha + 0.5 * slope * moving.omega * moving.omega - moving.torque;
            let torque = own + passed_on;
            if self.arrangement == Arrangement::Chain {
                passed_on = force * torque;
            }
            if let Some(slot) = torques.get_mut(k) {
                *slot = torque;
            }
        }
        for (k, ((ratios, force), torque)) in kinematics.stages.iter().zip(torques).enumerate() {
            let first = motion.shafts.get(self.first_shaft(k));
            let omega = first.map_or(0.0, |s| s.omega);
            let loss = torque * (force - ratios.speed.value) * omega;
            motion.loss += loss;
            let _ = motion.contacts.push(ContactMotion {
                torque,
                slip: ratios.slip.value,
                loss,
            });
        }
    }
}
