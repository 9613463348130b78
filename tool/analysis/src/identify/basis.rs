//! The unknowns: harmonics of J, of V′ and of friction, and cogging.

use std::f64::consts::TAU;

use jred_file::math;

/// Which unknowns there are, in this order: J's mean, cosines and sines; V′'s cosines and sines; a mean load; b; c's mean, the factor of
/// the design's c, c's cosines and sines; cogging.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Basis {
    /// Highest harmonic of J and of V′.
    pub(super) harmonics: usize,
    /// Whether there is a mean load: in one direction it is the same as Coulomb friction.
    pub(super) mean: bool,
    /// Highest harmonic of c; 0 in one direction, where it is the same as one of V′.
    pub(super) friction: usize,
    /// The design's c without its mean (N·m) at equal steps of a turn: its corners at dead centres would need many harmonics. Empty: not an unknown.
    pub(super) shape: Vec<f64>,
    /// Orders of the cogging above the harmonics.
    pub(super) cogging: Vec<u32>,
    /// The highest order of cogging that is a harmonic of V′; 0 without one.
    pub(super) least: usize,
}

/// Values at a position.
pub(super) struct AtPosition {
    pub(super) inertia: f64,
    pub(super) inertia_slope: f64,
    pub(super) inertia_curvature: f64,
    /// Slope of V′ and of the cogging.
    pub(super) stiffness: f64,
    /// Slope of c.
    pub(super) friction_slope: f64,
}

impl Basis {
    pub(super) const fn inertias(&self) -> usize {
        1 + 2 * self.harmonics
    }

    /// The first of V′.
    pub(super) const fn potential(&self) -> usize {
        self.inertias()
    }

    pub(super) const fn mean_load(&self) -> usize {
        self.inertias() + 2 * self.harmonics
    }

    pub(super) fn viscous(&self) -> usize {
        self.mean_load() + usize::from(self.mean)
    }

    pub(super) fn coulomb(&self) -> usize {
        self.viscous() + 1
    }

    /// The first wave of c.
    pub(super) fn coulomb_waves(&self) -> usize {
        self.coulomb() + 1 + usize::from(!self.shape.is_empty())
    }

    /// The first of the cogging.
    pub(super) fn cog(&self) -> usize {
        self.coulomb_waves() + 2 * self.friction
    }

    pub(super) fn unknowns(&self) -> usize {
        self.cog() + 2 * self.cogging.len()
    }

    /// Cosines and sines of 0…K times an angle.
    pub(super) fn harmonics_at(&self, phi: f64, into: &mut Vec<[f64; 2]>) {
        let (sin, cos) = math::sin_cos(phi);
        into.clear();
        let mut here = [1.0, 0.0];
        for _ in 0..=self.harmonics {
            into.push(here);
            let [c, s] = here;
            here = [c * cos - s * sin, s * cos + c * sin];
        }
    }

    /// Factors of the unknowns in J.
    pub(super) fn inertia_row(&self, phi: f64) -> Vec<f64> {
        row(self.harmonics, phi)
    }

    /// Factors of the unknowns in V′.
    pub(super) fn potential_row(&self, phi: f64) -> Vec<f64> {
        self.inertia_row(phi)[1..].to_vec()
    }

    /// Factors of the unknowns in c.
    pub(super) fn friction_row(&self, phi: f64) -> Vec<f64> {
        let mut row = row(self.friction, phi);
        if !self.shape.is_empty() {
            row.insert(1, in_turn(&self.shape, phi)[0]);
        }
        row
    }

    pub(super) fn at(&self, theta: &[f64], waves: &[[f64; 2]], phi: f64) -> AtPosition {
        let mut at = AtPosition {
            inertia: theta[0],
            inertia_slope: 0.0,
            inertia_curvature: 0.0,
            stiffness: 0.0,
            friction_slope: 0.0,
        };
        let v = &theta[self.potential()..];
        for (k, [c, s]) in waves.iter().enumerate().skip(1) {
            let order = k as f64;
            let [a, b] = [theta[2 * k - 1], theta[2 * k]];
            let value = a * c + b * s;
            at.inertia += value;
            at.inertia_slope += order * (b * c - a * s);
            at.inertia_curvature -= order * order * value;
            at.stiffness += order * (v[2 * k - 1] * c - v[2 * k - 2] * s);
        }
        if !self.shape.is_empty() {
            at.friction_slope = theta[self.coulomb() + 1] * in_turn(&self.shape, phi)[1];
        }
        let c = theta[self.coulomb_waves()..].chunks(2).take(self.friction);
        for ((k, ab), [cos, sin]) in (1..).zip(c).zip(waves.iter().skip(1)) {
            at.friction_slope += f64::from(k) * (ab[1] * cos - ab[0] * sin);
        }
        for (q, ab) in self.cogging.iter().zip(theta[self.cog()..].chunks(2)) {
            let order = f64::from(*q);
            let (s, c) = math::sin_cos(order * phi);
            at.stiffness += order * (ab[1] * c - ab[0] * s);
        }
        at
    }

    /// The unknowns of this basis that one with fewer harmonics has too.
    pub(super) fn columns_of(&self, fewer: &Self) -> Vec<usize> {
        let (potential, waves) = (self.potential(), self.coulomb_waves());
        (0..fewer.inertias())
            .chain(potential..potential + 2 * fewer.harmonics)
            .chain(self.mean_load()..waves + 2 * fewer.friction)
            .chain(self.cog()..self.unknowns())
            .collect()
    }

    /// The same with fewer harmonics of J and V′; c has no more than they.
    pub(super) fn with_harmonics(&self, harmonics: usize) -> Self {
        Self {
            harmonics,
            friction: self.friction.min(harmonics),
            ..self.clone()
        }
    }

    /// The same with fewer harmonics of c.
    pub(super) fn with_friction(&self, friction: usize) -> Self {
        Self {
            friction,
            ..self.clone()
        }
    }
}

/// Value and slope of a curve that is given at equal steps of a turn, between which it is straight.
pub(super) fn in_turn(curve: &[f64], phi: f64) -> [f64; 2] {
    let count = curve.len();
    let place = phi.rem_euclid(TAU) / TAU * count as f64;
    let before = (place as usize).min(count.saturating_sub(1));
    let rise = curve[(before + 1) % count] - curve[before];
    let value = curve[before] + (place - before as f64) * rise;
    [value, rise * count as f64 / TAU]
}

/// 1, and cosine and sine of each harmonic.
fn row(harmonics: usize, phi: f64) -> Vec<f64> {
    let k = (1..=harmonics).map(|k| k as f64 * phi);
    let waves = k.flat_map(|angle| [math::cos(angle), math::sin(angle)]);
    [1.0].into_iter().chain(waves).collect()
}
