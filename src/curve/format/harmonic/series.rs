//! The sums of a tick over harmonics.

use super::coefficient::{Curve, in_use, means, row, terms};
use super::sine::Circular;
use crate::curve::TableError;
use crate::curve::curves::{CurveSet, has};
use crate::{Phase, Scale};

/// Numbers of places in the proof of a positive inertia: at first, and at most.
const PLACES: [u32; 2] = [64, 4096];

/// Values that a tick reads from a table.
#[derive(Clone, Copy, Debug)]
pub struct Series<'a, T> {
    pub(super) means: [T; 5],
    rows: &'a [T],
    /// ½·J_b·ω_b²/T_b
    pub(super) velocity: T,
}

/// All curves at one phase.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values<T> {
    pub(super) inertia: T,
    pub(super) slope: T,
    pub(super) load: T,
    pub(super) viscous: T,
    pub(super) coulomb: T,
}

impl<'a, T: Circular> Series<'a, T> {
    pub(super) fn new(words: &'a [T], set: CurveSet, scale: &Scale) -> Self {
        let [zero, half, _] = T::CONSTANTS;
        let (head, rows) = words.split_at_checked(means(set)).unwrap_or_default();
        let mut given = head.iter().copied();
        let means = Curve::ALL.map(|curve| {
            let there = curve.is_in(set);
            there.then(|| given.next()).flatten().unwrap_or(zero)
        });
        let velocity = half * T::from_single(scale.velocity_base());
        Self {
            means,
            rows,
            velocity,
        }
    }

    #[inline(always)]
    pub(super) fn moved<'b>(&self, words: &'b [T], set: CurveSet) -> Series<'b, T> {
        Series {
            means: self.means,
            rows: words.get(means(set)..).unwrap_or_default(),
            velocity: self.velocity,
        }
    }

    /// Coefficients, harmonic after harmonic.
    #[inline(always)]
    pub(super) fn rows(&self, set: CurveSet) -> core::slice::ChunksExact<'a, T> {
        // Without terms there are no coefficients.
        self.rows.chunks_exact(row(set).max(1))
    }

    #[inline(always)]
    pub(super) fn at(&self, set: CurveSet, phase: Phase) -> Values<T> {
        let [zero, _, one] = T::CONSTANTS;
        let (sin, cos) = T::sin_cos_of(phase);
        let (mut s, mut c, mut order) = (sin, cos, one);
        let [mut inertia, mut load, mut viscous, mut coulomb, constant] = self.means;
        let mut slope = zero;
        let mut sums = [zero; 4];
        for row in self.rows(set) {
            let mut words = row.iter().copied();
            let mut next = |curve| pair(&mut words, set, curve);
            let of_inertia = next(0);
            slope = match of_inertia {
                [Some(a), Some(b)] => slope + order * (b * c - a * s),
                [Some(a), None] => slope - order * (a * s),
                [None, Some(b)] => slope + order * (b * c),
                [None, None] => slope,
            };
            let wave = [c, s];
            let [j, l, v, m] = &mut sums;
            add(j, of_inertia, wave);
            add(l, next(1), wave);
            add(v, next(2), wave);
            add(m, next(3), wave);
            (s, c) = (s * cos + c * sin, c * cos - s * sin);
            order = order + one;
        }
        let [j, l, v, m] = sums;
        inertia = inertia + j;
        load = load + l;
        viscous = viscous + v;
        coulomb = size(coulomb + m) + constant;
        Values {
            inertia,
            slope,
            load,
            viscous,
            coulomb,
        }
    }

    /// ½·J′·ω²
    #[inline(always)]
    pub(super) fn velocity(&self, values: &Values<T>, omega: T) -> T {
        self.velocity * values.slope * (omega * omega)
    }

    /// ½·J′·ω² − load + b·ω, with the machine's curves.
    #[inline(always)]
    pub(super) fn resisting(&self, values: &Values<T>, set: CurveSet, omega: T) -> T {
        let mut sum = self.velocity(values, omega);
        if Curve::Load.is_in(set) {
            sum = sum - values.load;
        }
        if Curve::Viscous.is_in(set) {
            sum = sum + values.viscous * omega;
        }
        sum
    }

    /// Proves that J is positive everywhere: its least value at 64 places must exceed the possible decrease by J″ between two of them, h²/8·Σ
    /// k²·(|aₖ| + |bₖ|), and the rounding. Otherwise the number of places doubles, up to 4096.
    pub(super) fn check_inertia(&self, set: CurveSet) -> Result<(), TableError> {
        let [zero, half, one] = T::CONSTANTS;
        let [mean, ..] = self.means;
        let (mut rounding, mut curvature, mut order) = (size(mean), zero, one);
        for row in self.rows(set) {
            let [a, b] = pair(&mut row.iter().copied(), set, 0);
            let amplitude = size(a.unwrap_or(zero)) + size(b.unwrap_or(zero));
            rounding = rounding + order * amplitude;
            curvature = curvature + order * order * amplitude;
            order = order + one;
        }
        rounding = rounding * T::ROUNDINGS;
        let [first, last] = PLACES;
        // (2π/places)²/8
        let mut share = T::from_f64(4.934_802_200_544_679 / (64.0 * 64.0));
        let mut places = first;
        loop {
            let (mut least, mut place) = (T::from_f64(1e38), Phase::default());
            for k in 0..places {
                let phase = Phase::from_bits(k * (u32::MAX / places + 1));
                let inertia = self.at(set, phase).inertia;
                if inertia <= zero {
                    return Err(TableError::NoInertiaAt { phase });
                }
                if inertia < least {
                    (least, place) = (inertia, phase);
                }
            }
            if least > curvature * share + rounding {
                return Ok(());
            }
            if places >= last {
                return Err(TableError::InertiaNotShown { phase: place });
            }
            places *= 2;
            share = share * half * half;
        }
    }
}

#[inline(always)]
pub(super) fn size<T: Circular>(x: T) -> T {
    let [zero, ..] = T::CONSTANTS;
    if x < zero { -x } else { x }
}

/// The next coefficients of a curve, [cosine, sine], where present.
#[inline(always)]
pub(super) fn pair<T>(
    words: &mut impl Iterator<Item = T>,
    set: CurveSet,
    curve: u8,
) -> [Option<T>; 2] {
    let used = in_use(set);
    let a = if has(used, terms::INERTIA_COS << (2 * curve)) {
        words.next()
    } else {
        None
    };
    let b = if has(used, terms::INERTIA_SIN << (2 * curve)) {
        words.next()
    } else {
        None
    };
    [a, b]
}

/// `sum` + a·c + b·s of the present coefficients: the compiler does not remove a zero times an angle.
#[inline(always)]
fn add<T: Circular>(sum: &mut T, [a, b]: [Option<T>; 2], [c, s]: [T; 2]) {
    *sum = match (a, b) {
        (Some(a), Some(b)) => *sum + (a * c + b * s),
        (Some(a), None) => *sum + a * c,
        (None, Some(b)) => *sum + b * s,
        (None, None) => *sum,
    };
}
