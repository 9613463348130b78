//! Forces and moments on the links, other than gravity.

use core::f64::consts::TAU;

use crate::Domain;
use crate::machine::joint::{Body, Wrench};
use crate::machine::link::Frame;
use crate::machine::motion::Law;
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::{finite, not_negative, positive};

/// The action of a load on its link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Action {
    /// A force with the global components [x, y] (N), independent of the direction of motion.
    Force([f64; 2]),
    /// A moment (N·m), counter-clockwise positive, independent of the direction of motion.
    Moment(f64),
    /// A force of this magnitude (N) against the velocity of its point: friction, a blank holder, cutting in both directions.
    OpposingForce(f64),
    /// A moment of this magnitude (N·m) against the link's rotation.
    OpposingMoment(f64),
    /// A force c·v (c in N·s/m) against the velocity of its point.
    ViscousForce(f64),
    /// A moment c·ψ̇ (c in N·m·s/rad) against the link's rotation.
    ViscousMoment(f64),
}

/// The part of the turn, or of the stroke, in which a load acts.
///
/// It rises from zero at `from` to its full value over `ramp`, and falls to zero over `ramp` before `to`, each by the 3-4-5 polynomial, so that the
/// reduced torque has two continuous derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Window {
    from: f64,
    width: f64,
    ramp: f64,
    /// Period in turns; 0 if not periodic.
    turns: u32,
}

impl Window {
    /// The shortest ramp, as a part of the range: 4000 units of a [`Phase`](crate::Phase).
    pub const SHORTEST_RAMP: f64 = 1e-6;

    /// A window between two positions, with edges of width `ramp` (rad, or m), for a drive link with this range.
    ///
    /// On a turn it repeats every turn, and its end may lie beyond the turn. On a stroke it does not repeat, and an end of it may lie beyond the
    /// stroke.
    ///
    /// # Errors
    /// A window narrower than its two ramps, or on a turn wider than the turn; a ramp shorter than [`SHORTEST_RAMP`](Self::SHORTEST_RAMP).
    pub fn new(domain: Domain, ends: [f64; 2], ramp: f64) -> Result<Self, RangeError> {
        let turns = match domain {
            Domain::Turn => 1,
            Domain::Stroke { .. } => 0,
        };
        Self::coming_again(turns, Self::SHORTEST_RAMP * domain.span(), ends, ramp)
    }

    /// A window for a drive link that turns, which repeats after several turns, such as two for a four-stroke engine: positions count over all of
    /// them. Such a load requires code that follows the drive link from turn to turn: a table of one turn cannot contain it.
    ///
    /// # Errors
    /// As [`new`](Self::new); zero turns, or more than [`MAX_TURNS`](Self::MAX_TURNS).
    pub fn over_turns(turns: u32, ends: [f64; 2], ramp: f64) -> Result<Self, RangeError> {
        if !(1..=Self::MAX_TURNS).contains(&turns) {
            return Err(RangeError::OutOfRange {
                what: "turns of the load's window",
                value: f64::from(turns),
                min: 1.0,
                max: f64::from(Self::MAX_TURNS),
            });
        }
        Self::coming_again(turns, Self::SHORTEST_RAMP * TAU, ends, ramp)
    }

    /// Greatest period of a window, in turns.
    pub const MAX_TURNS: u32 = 64;

    fn coming_again(
        turns: u32,
        least: f64,
        [from, to]: [f64; 2],
        ramp: f64,
    ) -> Result<Self, RangeError> {
        let from = finite("start of the load's window", from)?;
        let what = "ramp of the load's window";
        let ramp = positive(what, ramp)?;
        if ramp < least {
            return Err(RangeError::OutOfRange {
                what,
                value: ramp,
                min: least,
                max: f64::INFINITY,
            });
        }
        let width = positive(
            "width of the load's window",
            finite("end of the load's window", to)? - from,
        )?;
        let (what, max) = if turns == 0 {
            ("width of the load's window (m or rad)", f64::INFINITY)
        } else {
            ("width of the load's window (rad)", f64::from(turns) * TAU)
        };
        if width > max || width < 2.0 * ramp {
            return Err(RangeError::OutOfRange {
                what,
                value: width,
                min: 2.0 * ramp,
                max,
            });
        }
        Ok(Self {
            from,
            width,
            ramp,
            turns,
        })
    }

    /// The positions (rad, or m) where the window begins to open, is open, begins to close, and is closed.
    #[must_use]
    pub fn edges(&self) -> [f64; 4] {
        let to = self.from + self.width;
        [self.from, self.from + self.ramp, to - self.ramp, to]
    }

    /// Width of each edge (rad, or m).
    pub const fn ramp(&self) -> f64 {
        self.ramp
    }

    /// Width from opening to closing (rad, or m).
    pub const fn width(&self) -> f64 {
        self.width
    }

    /// Whether it repeats, every turn or every few turns.
    pub const fn repeats(&self) -> bool {
        self.turns > 0
    }

    /// Period in turns; 0 if not periodic.
    pub const fn turns(&self) -> u32 {
        self.turns
    }

    /// The share of the load at `phi` (rad, or m of a stroke): 0 to 1.
    #[must_use]
    pub fn factor(&self, phi: f64) -> f64 {
        let into = if self.turns > 0 {
            let period = f64::from(self.turns) * TAU;
            let times = (phi - self.from) / period;
            (times - math::floor(times)) * period
        } else {
            phi - self.from
        };
        let edge = into.min(self.width - into).max(0.0);
        Law::Polynomial345.at((edge / self.ramp).min(1.0))[0]
    }
}

/// A load on one link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Load {
    link: usize,
    at: [f64; 2],
    action: Action,
    window: Option<Window>,
}

impl Load {
    /// A load on link number `link` (see the mechanism's list), at the origin of the link's frame and over the whole turn.
    ///
    /// # Errors
    /// A value that is not finite; a motion-opposing or viscous value that is negative.
    pub fn new(link: usize, action: Action) -> Result<Self, RangeError> {
        match action {
            Action::Force([x, y]) => {
                finite("force x", x)?;
                finite("force y", y)?;
            }
            Action::Moment(m) => {
                finite("moment", m)?;
            }
            Action::OpposingForce(f) => {
                not_negative("opposing force", f)?;
            }
            Action::OpposingMoment(m) => {
                not_negative("opposing moment", m)?;
            }
            Action::ViscousForce(c) | Action::ViscousMoment(c) => {
                not_negative("viscous coefficient", c)?;
            }
        }
        Ok(Self {
            link,
            at: [0.0, 0.0],
            action,
            window: None,
        })
    }

    /// The same load at the point `[u, v]` (m) of the link's frame.
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn at(self, point: [f64; 2]) -> Result<Self, RangeError> {
        finite("point of the load u", point[0])?;
        finite("point of the load v", point[1])?;
        Ok(Self { at: point, ..self })
    }

    /// The same load, only in a part of the turn.
    #[must_use]
    pub const fn within(mut self, window: Window) -> Self {
        self.window = Some(window);
        self
    }

    /// The action on its link.
    pub const fn action(&self) -> Action {
        self.action
    }

    /// Point of action: `[u, v]` in the link's frame (m).
    pub const fn point(&self) -> [f64; 2] {
        self.at
    }

    /// The part of the turn in which it acts; `None` for the whole.
    pub const fn window(&self) -> Option<Window> {
        self.window
    }

    /// Whether it is a force that keeps its direction while the link turns.
    pub const fn has_fixed_direction(&self) -> bool {
        matches!(self.action, Action::Force(_))
    }

    /// Index of the link.
    pub const fn link(&self) -> usize {
        self.link
    }

    /// Force and moment of the load on its link at `phi` (rad) and speed `omega` (rad/s), for its link's `frame`. A load that opposes the motion is
    /// zero where its point or its link is at rest.
    #[must_use]
    pub fn wrench(&self, frame: &Frame, phi: f64, omega: f64) -> Wrench {
        let part = self.window.map_or(1.0, |w| w.factor(phi));
        let body = Body::Link(self.link);
        let point = frame.point(self.at);
        let [v_x, v_y] = point.map(|c| c.velocity(omega));
        let turn = frame.psi.velocity(omega);
        let force =
            |force: [f64; 2]| Wrench::force(body, point.map(|c| c.value), force.map(|f| part * f));
        let moment = |moment: f64| Wrench::moment(body, part * moment);
        match self.action {
            Action::Force(given) => force(given),
            Action::Moment(given) => moment(given),
            Action::OpposingForce(size) => {
                let speed = math::sqrt(v_x * v_x + v_y * v_y);
                let direction = if speed > 0.0 { size / speed } else { 0.0 };
                force([-direction * v_x, -direction * v_y])
            }
            Action::OpposingMoment(size) => moment(-size * math::sign(turn)),
            Action::ViscousForce(c) => force([-c * v_x, -c * v_y]),
            Action::ViscousMoment(c) => moment(-c * turn),
        }
    }

    /// The load's share of the reduced torque at `phi` (rad), (6.2), for its link's `frame`.
    #[must_use]
    pub fn reduce(&self, frame: &Frame, phi: f64) -> LoadCurves {
        let part = self.window.map_or(1.0, |w| w.factor(phi));
        let [x, y] = frame.point(self.at);
        let speed_squared = x.d1 * x.d1 + y.d1 * y.d1;
        let turn = frame.psi.d1;
        let mut curves = LoadCurves::default();
        match self.action {
            Action::Force([fx, fy]) => curves.process = part * (fx * x.d1 + fy * y.d1),
            Action::Moment(m) => curves.process = part * m * turn,
            Action::OpposingForce(f) => curves.coulomb = part * f * math::sqrt(speed_squared),
            Action::OpposingMoment(m) => curves.coulomb = part * m * math::abs(turn),
            Action::ViscousForce(c) => curves.viscous = part * c * speed_squared,
            Action::ViscousMoment(c) => curves.viscous = part * c * turn * turn,
        }
        curves
    }
}

/// A load's share of the reduced torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct LoadCurves {
    /// Signed process torque (N·m), in +φ direction.
    pub process: f64,
    /// b in −b·ω (N·m·s/rad).
    pub viscous: f64,
    /// c in −c·sgn ω (N·m).
    pub coulomb: f64,
}
