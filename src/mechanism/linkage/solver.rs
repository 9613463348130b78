//! Positions and transfer functions of a linkage at one φ: Newton's method for (76), then the linear systems (77), (78).

use crate::machine::link::Frame;
use crate::machine::mechanism::MAX_LINKS;
use crate::number::linear;
use crate::number::transfer::Transfer;

use super::cam::Cams;
use super::structure::{Coordinate, Equation, Group, Method, PSI};
use super::{Linkage, Pair};

/// Greatest number of steps of Newton's method.
const MOST_STEPS: usize = 30;
/// A step smaller than this (rad, or relative to the linkage's size) is the last: the remaining error is its square, below rounding.
const LAST_STEP: f64 = 1e-9;
/// A step smaller than this leaves even the Jacobian unchanged, to rounding.
const NO_STEP: f64 = 1e-15;
/// Limit of a link's rotation per step (rad): Newton's method from a rough drawing.
const LONGEST_TURN: f64 = 0.5;
/// A group whose columns span less than this is at a dead point.
const DEAD: f64 = 1e-9;

/// Quality of a solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solution {
    /// The smallest |det A|/Π‖column‖ of a group's Jacobian A: 0 at a dead point, at most 1.
    pub(super) quality: f64,
    /// The pair with the smallest quality.
    pub(super) weakest: usize,
    /// Bit k: the determinant of group k is negative. It changes only through a dead point.
    pub(super) signs: u64,
    /// Total movement of a coordinate by Newton's method (rad, or relative to the linkage's size).
    pub(super) correction: f64,
}

/// |det A| of each group, 1 for an explicit one: zero where branches meet.
pub(super) type Determinants = [f64; 3 * MAX_LINKS];

/// Why there is no solution near the start.
#[derive(Clone, Copy, Debug)]
pub(super) struct SolveError {
    /// The pair with the largest gap, or the pair that locks.
    pub(super) pair: usize,
    /// Its gap (m, or rad); zero where it locks.
    pub(super) gap: f64,
}

/// An equation's left-hand side, with the drive at `phi`.
#[inline(always)]
pub(super) fn evaluate<const CAMS: usize>(
    pairs: &[Pair],
    cams: &Cams<CAMS>,
    equation: Equation,
    frames: &[Frame],
    phi: Transfer,
) -> Transfer {
    match pairs.get(usize::from(equation.pair)) {
        Some(Pair::Joint(joint)) if equation.component == Equation::DRIVE => {
            joint.coordinate(frames) - phi
        }
        Some(pair) => pair.equation(equation.component.into(), frames, cams),
        None => Transfer::constant(f64::NAN), // cannot occur: the structure was made from these pairs
    }
}

/// Memory for the factors of all groups, in order.
struct Factors<'a> {
    matrices: &'a mut [f64],
    pivots: &'a mut [usize],
}

impl<const LINKS: usize, const PAIRS: usize, const CAMS: usize> Linkage<LINKS, PAIRS, CAMS> {
    /// The derivative of this `ORDER`, 0 to 3, of an equation's left-hand side, with the drive at `phi`.
    fn order<const ORDER: usize>(
        &self,
        equation: Equation,
        frames: &[Frame],
        phi: Transfer,
    ) -> f64 {
        let f = evaluate(&self.pairs, &self.cams, equation, frames, phi);
        match ORDER {
            0 => f.value,
            1 => f.d1,
            2 => f.d2,
            _ => f.d3,
        }
    }

    /// Positions and transfer functions at `phi`, starting from nearby links.
    pub(super) fn solve(&self, phi: f64, frames: &mut [Frame]) -> Result<Solution, SolveError> {
        self.solve_noting(phi, frames, &mut [])
    }

    /// As [`solve`](Self::solve); also stores the groups' determinants if there is memory for them.
    pub(super) fn solve_noting(
        &self,
        phi: f64,
        frames: &mut [Frame],
        determinants: &mut [f64],
    ) -> Result<Solution, SolveError> {
        let mut pivots = [[0; 3]; LINKS];
        let pivots = pivots.as_flattened_mut();
        // Small groups, as almost always; otherwise one group of all coordinates, with memory that takes longer to clear than small groups to solve.
        let mut matrices = [[0.0; 9]; LINKS];
        let matrices = matrices.as_flattened_mut();
        if self.structure.entries() <= matrices.len() {
            return self.solve_in(&mut Factors { matrices, pivots }, phi, frames, determinants);
        }
        self.solve_at_large(pivots, phi, frames, determinants)
    }

    #[inline(never)]
    fn solve_at_large(
        &self,
        pivots: &mut [usize],
        phi: f64,
        frames: &mut [Frame],
        determinants: &mut [f64],
    ) -> Result<Solution, SolveError> {
        let mut matrices = [[[[0.0; 3]; 3]; LINKS]; LINKS];
        let matrices = matrices.as_flattened_mut().as_flattened_mut();
        let matrices = matrices.as_flattened_mut();
        self.solve_in(&mut Factors { matrices, pivots }, phi, frames, determinants)
    }

    fn solve_in(
        &self,
        factors: &mut Factors<'_>,
        phi: f64,
        frames: &mut [Frame],
        determinants: &mut [f64],
    ) -> Result<Solution, SolveError> {
        let mut matrices = &mut *factors.matrices;
        let mut pivots = &mut *factors.pivots;
        let mut solved = Solution {
            quality: 1.0,
            weakest: self.drive,
            signs: 0,
            correction: 0.0,
        };
        let mut step = [[0.0; 3]; LINKS];
        for (k, group) in self.structure.groups().enumerate() {
            if let Some((equation, c, sign)) = self.explicit(group) {
                let step = sign * self.order::<0>(equation, frames, Transfer::constant(phi));
                frames[usize::from(c.link)].shift(c.axis, step);
                solved.correction = solved.correction.max(self.moved(c, step));
                continue;
            }
            let size = usize::from(group.size);
            let step = &mut step.as_flattened_mut()[..size];
            let (matrix, rest) = matrices.split_at_mut(size * size);
            matrices = rest;
            let (pivot, rest) = pivots.split_at_mut(size);
            pivots = rest;
            let place = self.place(group, phi, frames, matrix, pivot, step)?;
            solved.correction = solved.correction.max(place.correction);
            if let Some(determinant) = determinants.get_mut(k) {
                *determinant = place.determinant;
            }
            if place.negative {
                solved.signs |= 1 << k;
            }
            if place.quality < solved.quality {
                solved.quality = place.quality;
                solved.weakest = self.pair_of(group);
            }
        }
        self.differentiate(phi, frames, factors);
        Ok(solved)
    }

    /// A group's positions; leaves the factors of its Jacobian.
    #[inline]
    fn place(
        &self,
        group: Group,
        phi: f64,
        frames: &mut [Frame],
        matrix: &mut [f64],
        pivots: &mut [usize],
        step: &mut [f64],
    ) -> Result<GroupSolution, SolveError> {
        let equations = self.structure.equations(group);
        let coordinates = self.structure.coordinates(group);
        let contents = self.structure.contents(group);
        let size = equations.len();
        let phi = Transfer::constant(phi);
        let mut placed = GroupSolution::default();
        let mut last = false;
        let mut widest = SolveError {
            pair: self.pair_of(group),
            gap: 0.0,
        };
        for _ in 0..MOST_STEPS {
            // Columns of the Jacobian, by forward differentiation of the equations themselves.
            let mut lengths = 1.0;
            for (column, c) in matrix.chunks_exact_mut(size).zip(coordinates) {
                let link = usize::from(c.link);
                frames[link].seed(c.axis, 1.0);
                let mut length = 0.0;
                for ((entry, equation), content) in column.iter_mut().zip(equations).zip(contents) {
                    *entry = if c.is_in(*content) {
                        self.order::<1>(*equation, frames, phi)
                    } else {
                        0.0
                    };
                    length += *entry * *entry;
                }
                frames[link].seed(c.axis, 0.0);
                lengths *= length;
            }
            let determinant = linear::factor(matrix, pivots);
            placed.quality = crate::math::abs(determinant) / crate::math::sqrt(lengths);
            placed.negative = determinant < 0.0;
            placed.determinant = crate::math::abs(determinant);
            if placed.quality.is_nan() || placed.quality < DEAD {
                return Err(SolveError { gap: 0.0, ..widest });
            }
            if last {
                return Ok(placed);
            }
            widest.gap = 0.0;
            for (value, equation) in step.iter_mut().zip(equations) {
                *value = -self.order::<0>(*equation, frames, phi);
                if crate::math::abs(*value) > widest.gap {
                    widest = SolveError {
                        pair: equation.pair.into(),
                        gap: crate::math::abs(*value),
                    };
                }
            }
            linear::solve(matrix, pivots, step);
            let mut largest = 0.0_f64;
            let mut turn = 0.0_f64;
            for (value, c) in step.iter().zip(coordinates) {
                largest = largest.max(self.moved(*c, *value));
                if c.axis == PSI {
                    turn = turn.max(crate::math::abs(*value));
                }
            }
            let linear = group.method == Method::Linear;
            let damping = if linear {
                1.0
            } else {
                (LONGEST_TURN / turn).min(1.0)
            };
            for (value, c) in step.iter().zip(coordinates) {
                frames[usize::from(c.link)].shift(c.axis, damping * value);
            }
            placed.correction += damping * largest;
            // The Jacobian of a linear group is independent of the positions.
            if linear || largest < NO_STEP {
                return Ok(placed);
            }
            last = largest < LAST_STEP;
        }
        Err(widest)
    }

    /// Transfer functions of first, second and third order: (77), (78) and one order higher, group by group. While the unknown order is zero, an
    /// equation's derivative of that order is the right-hand side, with the opposite sign.
    fn differentiate(&self, phi: f64, frames: &mut [Frame], factors: &Factors<'_>) {
        let phi = Transfer::variable(phi);
        let (mut matrices, mut pivots) = (&*factors.matrices, &*factors.pivots);
        for group in self.structure.groups() {
            if let Some((equation, c, sign)) = self.explicit(group) {
                let frame = usize::from(c.link);
                // All other quantities in the equation are known.
                let f = evaluate(&self.pairs, &self.cams, equation, frames, phi);
                frames[frame].differ(c.axis, [f.d1, f.d2, f.d3].map(|d| sign * d));
                continue;
            }
            let size = usize::from(group.size);
            let (matrix, rest) = matrices.split_at(size * size);
            matrices = rest;
            let (pivot, rest) = pivots.split_at(size);
            pivots = rest;
            let factors = (matrix, pivot);
            self.differentiate_once::<1>(group, phi, frames, factors);
            self.differentiate_once::<2>(group, phi, frames, factors);
            self.differentiate_once::<3>(group, phi, frames, factors);
        }
    }

    fn differentiate_once<const ORDER: usize>(
        &self,
        group: Group,
        phi: Transfer,
        frames: &mut [Frame],
        (matrix, pivots): (&[f64], &[usize]),
    ) {
        let coordinates = self.structure.coordinates(group);
        for c in coordinates {
            frames[usize::from(c.link)].raise(c.axis, ORDER);
        }
        let mut right = [[0.0; 3]; LINKS];
        let right = &mut right.as_flattened_mut()[..coordinates.len()];
        for (value, equation) in right.iter_mut().zip(self.structure.equations(group)) {
            *value = -self.order::<ORDER>(*equation, frames, phi);
        }
        linear::solve(matrix, pivots, right);
        for (value, c) in right.iter().zip(coordinates) {
            frames[usize::from(c.link)].set(c.axis, ORDER, *value);
        }
    }

    /// The equation and the coordinate of an explicit group, and the sign of the coordinate's change for the equation's value.
    #[inline]
    fn explicit(&self, group: Group) -> Option<(Equation, Coordinate, f64)> {
        let Method::Explicit { negative } = group.method else {
            return None;
        };
        let equation = self.structure.equations(group).first()?;
        let coordinate = self.structure.coordinates(group).first()?;
        Some((*equation, *coordinate, if negative { 1.0 } else { -1.0 }))
    }

    /// Movement of a coordinate by a step (rad, or relative to the linkage's size).
    #[inline]
    fn moved(&self, c: Coordinate, step: f64) -> f64 {
        let unit = if c.axis == PSI { 1.0 } else { self.size };
        crate::math::abs(step) / unit
    }

    /// The pair named in errors of the group with this number.
    pub(super) fn pair_of_group(&self, k: usize) -> usize {
        let group = self.structure.groups().nth(k);
        group.map_or(self.drive, |group| self.pair_of(group))
    }

    /// The pair named in errors of a group.
    fn pair_of(&self, group: Group) -> usize {
        let first = self.structure.equations(group).first();
        first.map_or(self.drive, |e| e.pair.into())
    }
}

/// Result of placing a group.
#[derive(Clone, Copy, Debug, Default)]
struct GroupSolution {
    quality: f64,
    negative: bool,
    determinant: f64,
    correction: f64,
}
