//! The reduction of a machine on a stretch, with the equations of `jred::machine::Reduction` in Taylor forms.

use std::f64::consts::TAU;

use jred::machine::Link;
use jred::machine::{Action, Element, ElementLaw, Load, Window};

use crate::error::ProofError;
use crate::interval::Interval;
use crate::link_frame::{LinkFrame, body, direction};
use crate::taylor_form::TaylorForm;

/// Masses, loads and elements of a machine.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'m> {
    /// Mass properties of the links.
    pub links: &'m [Link],
    /// Loads.
    pub loads: &'m [Load],
    /// Springs and dampers.
    pub elements: &'m [Element],
    /// Gravity (m/s²).
    pub gravity: [f64; 2],
    /// Inertia that turns with the drive link (kg·m²).
    pub flywheel: f64,
}

/// The curves of the reduced machine on a stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curves {
    /// J (kg·m²).
    pub inertia: TaylorForm,
    /// J′ (kg·m²/rad).
    pub inertia_slope: TaylorForm,
    /// −U′ + process (N·m).
    pub load: TaylorForm,
    /// b (N·m·s/rad).
    pub viscous: TaylorForm,
    /// c (N·m).
    pub coulomb: TaylorForm,
}

impl Curves {
    /// The curves of links at these places, while the drive link moves from one position to another.
    ///
    /// # Errors
    /// A spring or damper whose ends may meet on the stretch.
    pub fn of(
        parts: &Parts<'_>,
        places: &[LinkFrame<TaylorForm>],
        stretch: [f64; 2],
    ) -> Result<Self, ProofError> {
        let zero = TaylorForm::constant(0.0);
        let mut inertia = TaylorForm::constant(parts.flywheel);
        let mut curves = Self {
            inertia: zero,
            inertia_slope: zero,
            load: zero,
            viscous: zero,
            coulomb: zero,
        };
        for (link, place) in parts.links.iter().zip(places) {
            let [x, y] = place.point(link.com()).map(|c| c.derivative());
            if link.mass() > 0.0 {
                inertia = inertia + (x.square() + y.square()) * link.mass();
                let [g_x, g_y] = parts.gravity.map(|g| g * link.mass());
                curves.load = curves.load + (x * g_x + y * g_y);
            }
            if link.inertia() > 0.0 {
                inertia = inertia + place.psi.derivative().square() * link.inertia();
            }
        }
        curves.inertia = inertia;
        curves.inertia_slope = inertia.derivative();
        for load in parts.loads {
            if let Some(place) = places.get(load.link()) {
                curves.add_load(load, place, stretch);
            }
        }
        for (number, element) in parts.elements.iter().enumerate() {
            let fault = ProofError::EndsMeet {
                number,
                phi: stretch[0].midpoint(stretch[1]),
            };
            curves.add_element(element, places).ok_or(fault)?;
        }
        Ok(curves)
    }

    fn add_load(&mut self, load: &Load, place: &LinkFrame<TaylorForm>, stretch: [f64; 2]) {
        let part = load.window().map(|window| factor(&window, stretch));
        let times = |curve: TaylorForm| part.map_or(curve, |part| part * curve);
        let [x, y] = place.point(load.point()).map(|c| c.derivative());
        let turn = place.psi.derivative();
        match load.action() {
            Action::Force([f_x, f_y]) => self.load = self.load + times(x * f_x + y * f_y),
            Action::Moment(m) => self.load = self.load + times(turn * m),
            Action::OpposingForce(f) => self.coulomb = self.coulomb + times(x.length(&y) * f),
            Action::OpposingMoment(m) => {
                self.coulomb = self.coulomb + times(turn.magnitude() * m);
            }
            Action::ViscousForce(c) => {
                self.viscous = self.viscous + times((x.square() + y.square()) * c);
            }
            Action::ViscousMoment(c) => self.viscous = self.viscous + times(turn.square() * c),
        }
    }

    fn add_element(&mut self, element: &Element, places: &[LinkFrame<TaylorForm>]) -> Option<()> {
        let [a, b] = element.between();
        let length = match element.law() {
            ElementLaw::Spring { .. } | ElementLaw::Damper { .. } => {
                let [from, to] = [&a, &b].map(|end| body(end, places).point(end.at));
                let squared = (to[0] - from[0]).square() + (to[1] - from[1]).square();
                if squared.values().lo() <= 0.0 {
                    return None;
                }
                squared.sqrt()
            }
            ElementLaw::TorsionSpring { .. } | ElementLaw::TorsionDamper { .. } => {
                direction(&b, places) - direction(&a, places)
            }
        };
        let rate = length.derivative();
        match element.law() {
            ElementLaw::Spring {
                stiffness,
                free_length: free,
            }
            | ElementLaw::TorsionSpring {
                stiffness,
                free_angle: free,
            } => {
                let pull = (length - TaylorForm::constant(free)) * stiffness;
                self.load = self.load - pull * rate;
            }
            ElementLaw::Damper { coefficient } | ElementLaw::TorsionDamper { coefficient } => {
                self.viscous = self.viscous + rate.square() * coefficient;
            }
        }
        Some(())
    }
}

/// The share of a load that acts, 0 to 1.
///
/// By rounding, a stretch may begin or end just across an edge of the window. Beyond its end a ramp continues as a constant, which the ramp's
/// polynomial x³·(10 − 15·x + 6·x²) approximates to less than 62·ε³ within ε ≤ 1 of the end.
#[must_use]
pub fn factor(window: &Window, [from, to]: [f64; 2]) -> TaylorForm {
    /// The largest ε, as a part of the ramp.
    const RAMP_MARGIN: f64 = 1e-3;
    let [start, ..] = window.edges();
    let (ramp, width) = (window.ramp(), window.width());
    let middle = from.midpoint(to);
    let turns = if window.repeats() {
        ((middle - start) / TAU).floor()
    } else {
        0.0
    };
    // A turn of the positions is the double below 2π, a turn of the window is exact.
    let into = TaylorForm::variable([from, to])
        - TaylorForm::somewhere(Interval::of(start) + Interval::turn() * turns);
    let at = into.at.0[0].middle();
    let values = into.values();
    let end = |end: f64| (Interval::of(end) - Interval::of(ramp)).middle();
    // The factor on each part, and the ends of the part.
    let (form, [low, high]) = if at < 0.0 {
        (TaylorForm::constant(0.0), [f64::NEG_INFINITY, 0.0])
    } else if at < ramp {
        (rise(&into, ramp), [0.0, ramp])
    } else if at <= end(width) {
        (TaylorForm::constant(1.0), [ramp, end(width)])
    } else if at < width {
        (
            rise(&(TaylorForm::constant(width) - into), ramp),
            [end(width), width],
        )
    } else {
        let next = if window.repeats() { TAU } else { f64::INFINITY };
        (TaylorForm::constant(0.0), [width, next])
    };
    // Includes the rounding of these ends.
    let beyond =
        (low - values.lo()).max(values.hi() - high).max(0.0) + 1e-15 * (1.0 + width + start.abs());
    let beyond = beyond / ramp;
    if beyond > RAMP_MARGIN {
        return TaylorForm::somewhere(Interval::between(0.0, 1.0));
    }
    form + TaylorForm::somewhere(Interval::within(62.1 * beyond * beyond * beyond))
}

/// The 3-4-5 polynomial of a ramp.
fn rise(into: &TaylorForm, ramp: f64) -> TaylorForm {
    let x = into.over(&TaylorForm::constant(ramp));
    x.polynomial(&[0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
}
