//! The unknowns: harmonics of J and of V′, friction and cogging.

use jred_file::math;

/// Which unknowns there are, in this order: J's mean, cosines and sines; V′'s cosines and sines; a mean load; b; c; cogging.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Basis {
    /// Highest harmonic of J and of V′.
    pub(super) harmonics: usize,
    /// Whether there is a mean load: in one direction it is the same as Coulomb friction.
    pub(super) mean: bool,
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

    /// The first of the cogging.
    pub(super) fn cog(&self) -> usize {
        self.viscous() + 2
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
        let k = (1..=self.harmonics).map(|k| k as f64 * phi);
        let waves = k.flat_map(|angle| [math::cos(angle), math::sin(angle)]);
        [1.0].into_iter().chain(waves).collect()
    }

    /// Factors of the unknowns in V′.
    pub(super) fn potential_row(&self, phi: f64) -> Vec<f64> {
        self.inertia_row(phi)[1..].to_vec()
    }

    pub(super) fn at(&self, theta: &[f64], waves: &[[f64; 2]], phi: f64) -> AtPosition {
        let mut at = AtPosition {
            inertia: theta[0],
            inertia_slope: 0.0,
            inertia_curvature: 0.0,
            stiffness: 0.0,
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
        for (q, ab) in self.cogging.iter().zip(theta[self.cog()..].chunks(2)) {
            let order = f64::from(*q);
            let (s, c) = math::sin_cos(order * phi);
            at.stiffness += order * (ab[1] * c - ab[0] * s);
        }
        at
    }

    /// The unknowns of this basis that one with fewer harmonics has too.
    pub(super) fn columns_of(&self, harmonics: usize) -> Vec<usize> {
        let potential = self.potential();
        (0..=2 * harmonics)
            .chain(potential..potential + 2 * harmonics)
            .chain(self.mean_load()..self.unknowns())
            .collect()
    }

    /// The same with fewer harmonics.
    pub(super) fn with_harmonics(&self, harmonics: usize) -> Self {
        Self {
            harmonics,
            ..self.clone()
        }
    }
}
