//! The closed form of a slider-crank: coefficients from lengths, masses and loads.
//!
//! ```text
//! λ = r/l,  X = −x_B′/r,  ψ′ = −λ·Ψ;   ψ′·sin ψ = −λ·(sin φ − X),  ψ′·cos ψ = −λ·cos φ
//! ```
//!
//! So the velocity of a point (u, v) of the rod is linear in X, sin φ and cos φ, and its square, with
//! Ψ² = 1 + X² − 2·X·sin φ, in 1, X², X·sin φ and X·cos φ:
//!
//! ```text
//! a = λ·u,  b = λ·v
//! x′ = −(r − a)·sin φ + b·cos φ − a·X          y′ = (r − a)·cos φ + b·sin φ − b·X
//! x′² + y′² = (r − a)² + b² + (a² + b²)·X² + 2·(a·(r − a) − b²)·X·sin φ − 2·b·r·X·cos φ
//! ```

mod error;

pub use error::SliderCrankError;

use crate::curve::curves::CurveSet;
use crate::curve::{COEFFICIENTS, CrankCoefficient as C, SliderCrankForm, TableError, words_len};
use crate::error::Error;
use crate::machine::{Action, Load, Machine, Mechanism as _};
use crate::mechanism::{Branch, SliderCrank};
use crate::number::error::RangeError;
use crate::{Domain, math};

/// A coefficient below this share of the largest of its curve counts as rounding of a rotated drawing.
const NOTHING: f64 = 1e-9;

/// The coefficients of 1, X², X·sin φ and X·cos φ in x′² + y′² or ψ′².
type Square = [f64; 4];

/// The lengths, and the sign of cos ψ.
struct Lengths {
    crank: f64,
    ratio: f64,
    side: f64,
    offset: f64,
}

impl Lengths {
    fn of(mechanism: &SliderCrank) -> Self {
        let lengths = mechanism.dimensions();
        Self {
            crank: lengths.crank,
            ratio: lengths.crank / lengths.rod,
            side: match mechanism.branch() {
                Branch::Right => 1.0,
                Branch::Left => -1.0,
            },
            offset: lengths.offset / lengths.rod,
        }
    }

    /// x′² + y′² of a point of a link.
    fn speed(&self, link: usize, [u, v]: [f64; 2]) -> Square {
        let r = self.crank;
        match link {
            SliderCrank::CRANK => [u * u + v * v, 0.0, 0.0, 0.0],
            SliderCrank::ROD => {
                let (a, b) = (self.ratio * u, self.ratio * v);
                let rest = r - a;
                [
                    rest * rest + b * b,
                    a * a + b * b,
                    2.0 * (a * rest - b * b),
                    -2.0 * b * r,
                ]
            }
            _ => [0.0, r * r, 0.0, 0.0],
        }
    }

    /// ψ′² of a link.
    fn turning(&self, link: usize) -> Square {
        let square = self.ratio * self.ratio;
        match link {
            SliderCrank::CRANK => [1.0, 0.0, 0.0, 0.0],
            SliderCrank::ROD => [square, square, -2.0 * square, 0.0],
            _ => [0.0; 4],
        }
    }

    /// The power of a force at a point of a link, over ω: the coefficients of X, sin φ and cos φ.
    fn power(&self, link: usize, [u, v]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 3] {
        let r = self.crank;
        match link {
            SliderCrank::CRANK => [0.0, -(x * u + y * v), y * u - x * v],
            SliderCrank::ROD => {
                let (a, b) = (self.ratio * u, self.ratio * v);
                [-(x * a + y * b), y * b - x * (r - a), x * b + y * (r - a)]
            }
            _ => [-r * x, 0.0, 0.0],
        }
    }
}

/// Coefficients in double precision.
struct Sums {
    of: [f64; COEFFICIENTS],
}

impl Sums {
    fn add<const N: usize>(&mut self, parts: [C; N], by: f64, shares: [f64; N]) {
        for (part, share) in parts.into_iter().zip(shares) {
            if let Some(sum) = self.of.get_mut(part as usize) {
                *sum += by * share;
            }
        }
    }

    fn load(
        &mut self,
        lengths: &Lengths,
        load: &Load,
        index: usize,
    ) -> Result<(), SliderCrankError> {
        const LOAD: [C; 3] = [C::Load, C::LoadSin, C::LoadCos];
        const VISCOUS: [C; 4] = [C::Viscous, C::ViscousSquare, C::ViscousSin, C::ViscousCos];
        if load.window().is_some() {
            return Err(SliderCrankError::Window(index));
        }
        let (link, at) = (load.link(), load.point());
        match load.action() {
            Action::Force(force) => self.add(LOAD, 1.0, lengths.power(link, at, force)),
            Action::Moment(moment) => match link {
                SliderCrank::CRANK => self.add([C::LoadConstant], moment, [1.0]),
                // ψ′ = −λ·Ψ, with the sign of cos ψ.
                SliderCrank::ROD => self.add([C::LoadRod], moment, [-lengths.side * lengths.ratio]),
                _ => {}
            },
            Action::OpposingForce(force) => match lengths.speed(link, at) {
                [_, square, _, _] if link > SliderCrank::ROD => {
                    self.add([C::Coulomb], force, [math::sqrt(square)]);
                }
                // A point of the crank, or its pin.
                [square, 0.0, 0.0, 0.0] => {
                    self.add([C::CoulombConstant], force, [math::sqrt(square)]);
                }
                _ => return Err(SliderCrankError::RubbingRod(index)),
            },
            Action::OpposingMoment(moment) => match link {
                SliderCrank::CRANK => self.add([C::CoulombConstant], moment, [1.0]),
                SliderCrank::ROD => self.add([C::CoulombRod], moment, [lengths.ratio]),
                _ => {}
            },
            Action::ViscousForce(c) => self.add(VISCOUS, c, lengths.speed(link, at)),
            Action::ViscousMoment(c) => self.add(VISCOUS, c, lengths.turning(link)),
        }
        Ok(())
    }

    fn new(machine: &Machine<SliderCrank>) -> Result<Self, SliderCrankError> {
        const INERTIA: [C; 4] = [C::Inertia, C::InertiaSquare, C::InertiaSin, C::InertiaCos];
        const LOAD: [C; 3] = [C::Load, C::LoadSin, C::LoadCos];
        if !machine.elements().is_empty() {
            return Err(SliderCrankError::Element(0));
        }
        if machine.mechanism().domain() != Domain::Turn {
            return Err(SliderCrankError::Stroke);
        }
        let lengths = Lengths::of(machine.mechanism());
        let mut sums = Self {
            of: [0.0; COEFFICIENTS],
        };
        let signed = [lengths.ratio, lengths.offset];
        sums.add([C::Ratio, C::Offset], lengths.side, signed);
        sums.add([C::Inertia], machine.flywheel(), [1.0]);
        for (k, link) in machine.mechanism().links().iter().enumerate() {
            sums.add(INERTIA, link.mass(), lengths.speed(k, link.com()));
            sums.add(INERTIA, link.inertia(), lengths.turning(k));
            sums.add(
                LOAD,
                link.mass(),
                lengths.power(k, link.com(), machine.gravity()),
            );
        }
        for (index, load) in machine.loads().iter().enumerate() {
            sums.load(&lengths, load, index)?;
        }
        Ok(sums)
    }

    /// The set of significant coefficients.
    fn set(&self) -> CurveSet {
        let size = |part: C| {
            self.of
                .get(part as usize)
                .map_or(0.0, |sum| math::abs(*sum))
        };
        let mut set = 0;
        for part in C::ALL {
            // The lengths are separate from J.
            let lengths = [C::Ratio, C::Offset];
            let same = C::ALL.into_iter().filter(|other| {
                other.curve() == part.curve() && lengths.contains(other) == lengths.contains(&part)
            });
            let most = same.map(size).fold(0.0, f64::max);
            if size(part) > NOTHING * most {
                set |= part.bits();
            }
        }
        set
    }
}

/// The [`curves`](crate::curves) and [`terms`](crate::slider_crank::terms) of a slider-crank.
///
/// A coefficient below 1e-9 of the largest of its curve counts as rounding of a rotated drawing.
///
/// # Errors
/// As [`SliderCrankError`] lists.
pub fn set_in_use(machine: &Machine<SliderCrank>) -> Result<CurveSet, SliderCrankError> {
    Ok(Sums::new(machine)?.set())
}

/// Computes the coefficients of a slider-crank, in the order of [`Coefficient::ALL`](crate::slider_crank::Coefficient::ALL) as far as `set` has them:
/// the words of a [`SliderCrankForm`]. Returns their number.
///
/// **Accuracy**: in exact arithmetic the form has no error; rounded to `f32` each coefficient has a relative error of 6e-8 (tests
/// `the_tick_rounds_as_stated`, `a_small_machine_keeps_its_small_coefficients`).
///
/// # Errors
/// As [`SliderCrankError`] lists; [`TableError::Curves`] with the machine's set, if `set` lacks a part of it; a buffer too short.
pub fn form(
    machine: &Machine<SliderCrank>,
    set: CurveSet,
    words: &mut [f32],
) -> Result<usize, Error> {
    let sums = Sums::new(machine)?;
    let in_use = sums.set();
    if in_use & !set != 0 {
        return Err(TableError::Curves(in_use).into());
    }
    let (needed, given) = (words_len::<SliderCrankForm>(0, set), words.len());
    let short = RangeError::BufferTooShort { needed, given };
    let words = words.get_mut(..needed).ok_or(short)?;
    let present = C::ALL
        .into_iter()
        .zip(sums.of)
        .filter(|(part, _)| part.is_in(set));
    for (word, (_, sum)) in words.iter_mut().zip(present) {
        *word = sum as f32;
    }
    Ok(needed)
}
