//! The closure of the joints: positions of all links, proven by the interval Newton method.
//!
//! The coordinates q = (x, y, ψ of every link) satisfy the equations of the joints and of the drive, f(q, φ) = 0. For the middle of a stretch and for
//! all of it, Krawczyk's operator
//!
//! ```text
//! K = m − Y·f(m, φ) + (1 − Y·A)·([q] − m),    A = ∂f/∂q over [q],  Y ≈ A⁻¹ in the middle
//! ```
//!
//! maps a box `[q]` around the pose in double precision into its interior: so it contains exactly one pose for each φ. Then the Taylor coefficients
//! follow order by order from the same equations, A·qₖ = −(contribution of lower orders to order k).

use jred::machine::{Frames, Jointed};
use jred::mechanism::linkage::Pair;

use crate::equation::{Equation, of_drive, of_joint, of_pair};
use crate::error::ProofError;
use crate::interval::Interval;
use crate::link_frame::LinkFrame;
use crate::matrix::{Matrix, Solver};
use crate::series::{Series, TERMS, sin_cos_term};
use crate::taylor_form::TaylorForm;

/// The joints of a mechanism as equations.
#[derive(Clone)]
pub struct Closure<'m> {
    mechanism: &'m dyn Jointed,
    /// Number of links placed by the equations.
    links: usize,
    equations: Vec<Equation>,
}

impl<'m> Closure<'m> {
    /// The closure of the first `links` links and their joints; `phi` is a position where the mechanism can be placed.
    ///
    /// # Errors
    /// A joint with unknown geometry, or too few joints.
    pub fn new(
        mechanism: &'m dyn Jointed,
        links: usize,
        joints: usize,
        phi: f64,
    ) -> Result<Self, ProofError> {
        let frames = mechanism
            .frames(phi)
            .map_err(|_| ProofError::Pose { phi })?;
        let all = mechanism
            .joints(phi, &frames)
            .map_err(|_| ProofError::Pose { phi })?;
        let mut equations = Vec::new();
        for (number, joint) in all.iter().take(joints).enumerate() {
            equations.extend(of_joint(joint, &frames).ok_or(ProofError::Joint { number })?);
        }
        let drive = all.get(mechanism.drive());
        let drive = drive.and_then(|joint| of_drive(joint, &frames, phi));
        Self::closed(mechanism, links, equations, drive)
    }

    /// The closure of a linkage with these pairs, including gears and racks.
    ///
    /// # Errors
    /// A pair with unknown geometry, or too few pairs.
    pub fn of_pairs(
        mechanism: &'m dyn Jointed,
        links: usize,
        pairs: &[Pair],
        phi: f64,
    ) -> Result<Self, ProofError> {
        let frames = mechanism
            .frames(phi)
            .map_err(|_| ProofError::Pose { phi })?;
        let mut equations = Vec::new();
        for (number, pair) in pairs.iter().enumerate() {
            equations.extend(of_pair(pair, &frames).ok_or(ProofError::Joint { number })?);
        }
        let drive = match pairs.get(mechanism.drive()) {
            Some(Pair::Joint(joint)) => of_drive(joint, &frames, phi),
            _ => None,
        };
        Self::closed(mechanism, links, equations, drive)
    }

    /// Adds the equation of the drive, if one degree of freedom is left.
    fn closed(
        mechanism: &'m dyn Jointed,
        links: usize,
        mut equations: Vec<Equation>,
        drive: Option<Equation>,
    ) -> Result<Self, ProofError> {
        equations.push(drive.ok_or(ProofError::Drive)?);
        if equations.len() != 3 * links {
            return Err(ProofError::Freedoms {
                equations: equations.len(),
                coordinates: 3 * links,
            });
        }
        Ok(Self {
            mechanism,
            links,
            equations,
        })
    }

    /// The positions of the links from one position of the drive link to another.
    ///
    /// # Errors
    /// A stretch without a proven unique pose; a shorter one may succeed.
    pub fn places(&self, stretch: [f64; 2]) -> Result<Vec<LinkFrame<TaylorForm>>, ProofError> {
        let [from, to] = stretch;
        let middle = from.midpoint(to);
        let frames = self.mechanism.frames(middle);
        let frames = frames.map_err(|_| ProofError::Pose { phi: middle })?;
        let solve = |phi: Interval| {
            self.series(&frames, phi)
                .ok_or(ProofError::Pose { phi: middle })
        };
        let at = solve(Interval::of(middle))?;
        let over = solve(Interval::between(from, to))?;
        let places = at.iter().zip(&over);
        Ok(places
            .map(|(at, over)| LinkFrame::joined(at, over))
            .collect())
    }

    /// The series of all links for every φ of an interval, around a pose in its middle.
    fn series(&self, frames: &Frames, phi: Interval) -> Option<Vec<LinkFrame<Series>>> {
        let half = 0.5 * phi.width();
        let (start, units) = self.start(frames);
        let (pose, solver) = self.pose(&start, &units, phi, half)?;
        let mut places: Vec<LinkFrame<Series>> = pose.chunks_exact(3).map(place).collect();
        for order in 1..TERMS {
            for place in &mut places {
                raise(place, order);
            }
            let sides = self.equations.iter().map(|equation| {
                let own = if order == 1 {
                    equation.by_drive()
                } else {
                    Interval::ZERO
                };
                -(equation.term(&places, order) + own)
            });
            let sides: Vec<Interval> = sides.collect();
            let terms = solver.solve(&sides, &units)?;
            for (place, terms) in places.iter_mut().zip(terms.chunks_exact(3)) {
                set(place, order, terms);
            }
        }
        Some(places)
    }

    /// The coordinates in double precision, and the speed of each as a measure of its size. Where a coordinate reverses, its first derivative is no
    /// measure.
    fn start(&self, frames: &Frames) -> (Vec<f64>, Vec<f64>) {
        let own = || frames.iter().take(self.links);
        let coordinates = || own().flat_map(|frame| [frame.x, frame.y, frame.psi]);
        let rates: Vec<f64> = coordinates().map(|q| q.d1.abs() + q.d2.abs()).collect();
        // Lengths, then angles.
        let most = [false, true].map(|angles| {
            let own = rates
                .iter()
                .enumerate()
                .filter(|(k, _)| (k % 3 == 2) == angles);
            let most = own.fold(0.0_f64, |most, (_, rate)| most.max(*rate));
            if most > 0.0 { most } else { 1.0 }
        });
        let unit = |(k, rate): (usize, &f64)| rate.max(0.1 * most[usize::from(k % 3 == 2)]);
        let units = rates.iter().enumerate().map(unit).collect();
        (coordinates().map(|q| q.value).collect(), units)
    }

    /// A box of coordinates with exactly one pose for each φ, and the systems of its equations.
    fn pose(
        &self,
        start: &[f64],
        units: &[f64],
        phi: Interval,
        half: f64,
    ) -> Option<(Vec<Interval>, Solver)> {
        const ATTEMPTS: usize = 6;
        let middle: Vec<Interval> = start.iter().map(|q| Interval::of(*q)).collect();
        let inverse = self.jacobian(&middle).inverse()?;
        let residual = self.residual(&middle, phi);
        let radius = |(q, unit): (&f64, &f64)| 1.5 * half * unit + 1e-12 * (1.0 + q.abs());
        let mut radii: Vec<f64> = start.iter().zip(units).map(radius).collect();
        for _ in 0..ATTEMPTS {
            let all = start.iter().zip(&radii);
            let all: Vec<Interval> = all.map(|(q, r)| Interval::around(*q, *r)).collect();
            let solver = Solver::new(inverse.clone(), &self.jacobian(&all));
            let newton = solver.approximate(&residual);
            let away = all.iter().zip(&middle).map(|(all, middle)| *all - *middle);
            let rest = solver.rest(&away.collect::<Vec<_>>());
            let image = middle.iter().zip(newton).zip(rest);
            let image: Vec<Interval> = image.map(|((m, n), r)| *m - n + r).collect();
            if image
                .iter()
                .zip(&all)
                .all(|(image, all)| image.is_inside(*all))
            {
                // The pose lies in the image: repeat with it.
                let solver = Solver::new(inverse, &self.jacobian(&image));
                let away = image
                    .iter()
                    .zip(&middle)
                    .map(|(all, middle)| *all - *middle);
                let rest = solver.rest(&away.collect::<Vec<_>>());
                let newton = solver.approximate(&residual);
                let again = middle.iter().zip(newton).zip(rest).zip(&image);
                let again = again.map(|(((m, n), r), before)| (*m - n + r).and(*before));
                return Some((again.collect(), solver));
            }
            for ((radius, image), q) in radii.iter_mut().zip(&image).zip(start) {
                let needed = (*image - Interval::of(*q)).size();
                *radius = radius.max(1.2 * needed);
            }
            let bounded = |radius: &f64| *radius < 1e6;
            if !radii.iter().all(bounded) {
                return None;
            }
        }
        None
    }

    fn residual(&self, pose: &[Interval], phi: Interval) -> Vec<Interval> {
        let places: Vec<LinkFrame<Series>> = pose.chunks_exact(3).map(place).collect();
        let of = |equation: &Equation| equation.term(&places, 0) + equation.by_drive() * phi;
        self.equations.iter().map(of).collect()
    }

    /// ∂f/∂q: the first-order terms, with the first derivative of one coordinate at a time.
    fn jacobian(&self, pose: &[Interval]) -> Matrix<Interval> {
        let mut places: Vec<LinkFrame<Series>> = pose.chunks_exact(3).map(place).collect();
        let mut matrix = Matrix::new(3 * self.links, Interval::ZERO);
        for link in 0..self.links {
            for axis in 0..3 {
                let mut terms = [Interval::ZERO; 3];
                terms[axis] = Interval::ONE;
                set(&mut places[link], 1, &terms);
                for (row, equation) in self.equations.iter().enumerate() {
                    if equation.is_of(link) {
                        matrix.set(row, 3 * link + axis, equation.term(&places, 1));
                    }
                }
                for place in [&mut places[link]] {
                    for series in [
                        &mut place.x,
                        &mut place.y,
                        &mut place.psi,
                        &mut place.sin,
                        &mut place.cos,
                    ] {
                        series.0[1] = Interval::ZERO;
                    }
                }
            }
        }
        matrix
    }
}

/// A link with these coordinates.
fn place(coordinates: &[Interval]) -> LinkFrame<Series> {
    let (sin, cos) = coordinates[2].sin_cos();
    LinkFrame {
        x: Series::constant(coordinates[0]),
        y: Series::constant(coordinates[1]),
        psi: Series::constant(coordinates[2]),
        sin: Series::constant(sin),
        cos: Series::constant(cos),
    }
}

/// Prepares a link for coefficients of this order: sets the part of sine and cosine that depends on lower orders of ψ.
fn raise(place: &mut LinkFrame<Series>, order: usize) {
    (place.sin.0[order], place.cos.0[order]) =
        sin_cos_term(&place.psi.0, &place.sin.0, &place.cos.0, order);
}

/// Sets the coefficients of this order, after [`raise`] for that order.
fn set(place: &mut LinkFrame<Series>, order: usize, terms: &[Interval]) {
    (place.x.0[order], place.y.0[order]) = (terms[0], terms[1]);
    place.psi.0[order] = terms[2];
    place.sin.0[order] = place.sin.0[order] + place.cos.0[0] * terms[2];
    place.cos.0[order] = place.cos.0[order] - place.sin.0[0] * terms[2];
}
