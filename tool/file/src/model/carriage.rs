//! A mass that a second axis moves along a guide on a link, with its own motion.
//!
//! Its position is r(φ, t), prescribed in time: with s(t) along the direction e of the guide, and ψ the angle of the link,
//!
//! ```text
//! r̈ = r_φ·α + r_φφ·ω² + 2·r_φt·ω + r_tt        r_φt = ψ′·ṡ·e⊥        r_tt = s̈·e
//! T = m·(r̈ − g)·r_φ + J_c·ψ̈·ψ′
//! ```
//!
//! The first two terms of r̈ and the weight are those of a mass fixed to the link at its current position. The other two are a force on it, F =
//! −m·(2·ψ′·ω·ṡ·e⊥ + s̈·e): the reaction of the mass, moving along its guide, on the link that carries guide and axis.

use crate::math;
use jred::machine::Frame;
use jred::machine::motion::State;

use crate::model::motion::Motion;
use crate::model::with_mass::AttachedMass;

/// A mass that a second axis moves along a guide on a link.
#[derive(Clone, Debug)]
pub struct Carriage {
    /// Its name.
    pub name: String,
    /// The moved mass, at s = 0.
    pub mass: AttachedMass,
    /// Direction of the guide in the link's frame.
    pub direction: [f64; 2],
    /// s over the time of the machine's motion (m). After its end the carriage is at rest.
    pub motion: Motion,
    /// Index of its load in the machine; without force when no time is known.
    pub load: usize,
    /// Its description for reports.
    pub words: String,
}

impl Carriage {
    /// s with its speed and acceleration (m, m/s, m/s²) at a time of the machine's motion (s).
    pub fn at(&self, t: f64) -> State<f64> {
        let state = self.motion.at(t);
        if t <= self.motion.duration() {
            return state;
        }
        State {
            omega: 0.0,
            alpha: 0.0,
            ..state
        }
    }

    /// The moved mass, at this time.
    pub fn placed(&self, t: f64) -> AttachedMass {
        let s = self.at(t).phi;
        AttachedMass {
            at: [0, 1].map(|k| self.mass.at[k] + s * self.direction[k]),
            ..self.mass
        }
    }

    /// The guide's direction e and its normal e⊥ in global components.
    fn directions(&self, frame: &Frame) -> [[f64; 2]; 2] {
        let (sin, cos) = math::sin_cos(frame.psi.value);
        let [u, v] = self.direction;
        let along = [u * cos - v * sin, u * sin + v * cos];
        [along, [-along[1], along[0]]]
    }

    /// Force of its motion along the guide on its link (N), global components: −m·(2·ψ′·ω·ṡ·e⊥ + s̈·e).
    pub fn force(&self, frame: &Frame, t: f64, omega: f64) -> [f64; 2] {
        let state = self.at(t);
        let [along, across] = self.directions(frame);
        let coriolis = 2.0 * frame.psi.d1 * omega * state.omega;
        [0, 1].map(|k| -self.mass.mass * (coriolis * across[k] + state.alpha * along[k]))
    }

    /// Its kinetic energy (J) beyond that of a mass fixed to the link: m·v·ṡ + ½·m·ṡ², with v the link's speed along the guide.
    pub fn energy(&self, frame: &Frame, t: f64, omega: f64) -> f64 {
        let speed = self.at(t).omega;
        let [along, _] = self.directions(frame);
        let carried = frame.point(self.placed(t).at).map(|c| c.velocity(omega));
        self.mass.mass * speed * (carried[0] * along[0] + carried[1] * along[1] + 0.5 * speed)
    }

    /// Force of the second axis on it along its guide (N), m·(r̈ − g)·e, positive towards larger s, while the drive link moves with ω and α; without
    /// friction of the guide.
    pub fn effort(
        &self,
        frame: &Frame,
        t: f64,
        [omega, alpha]: [f64; 2],
        gravity: [f64; 2],
    ) -> f64 {
        let [along, _] = self.directions(frame);
        let carried = frame
            .point(self.placed(t).at)
            .map(|c| c.acceleration(omega, alpha));
        let own = self.force(frame, t, omega);
        let force = |k: usize| self.mass.mass * (carried[k] - gravity[k]) - own[k];
        force(0) * along[0] + force(1) * along[1]
    }
}
