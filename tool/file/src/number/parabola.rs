//! The parabola through three points of a curve, and the peak of the curve by it.

/// Most positions of a curve at which a peak is refined.
const MOST_SUMMITS: usize = 8;

/// Steps to a peak, each to the vertex of the parabola through three positions around it.
const PEAK_STEPS: u32 = 6;

/// The parabola through three points, in Newton's form.
#[derive(Clone, Copy, Debug)]
pub struct Parabola {
    times: [f64; 2],
    value: f64,
    slope: f64,
    bend: f64,
}

impl Parabola {
    /// The parabola through these values at these times.
    pub fn through([a, b, c]: [f64; 3], [u, v, w]: [f64; 3]) -> Self {
        let slope = (v - u) / (b - a);
        Self {
            times: [a, b],
            value: u,
            slope,
            bend: ((w - v) / (c - b) - slope) / (c - a),
        }
    }

    /// Its value at the time `t`.
    pub fn at(&self, t: f64) -> f64 {
        let [a, b] = self.times;
        self.value + (t - a) * (self.slope + (t - b) * self.bend)
    }

    /// The time of its maximum, if it has one.
    pub fn vertex(&self) -> Option<f64> {
        let [a, b] = self.times;
        (self.bend < 0.0).then(|| a.midpoint(b) - 0.5 * self.slope / self.bend)
    }
}

/// The position of the largest value of `f` near three ordered positions, of which the middle one has the largest value: by vertices of parabolas. At
/// an end of a smooth part of a curve the largest value may be an outer one.
///
/// # Errors
/// Those of `f`.
pub fn peak<E>(mut f: impl FnMut(f64) -> Result<f64, E>, around: [f64; 3]) -> Result<f64, E> {
    let [a, b, c] = around;
    let mut three = [(a, f(a)?), (b, f(b)?), (c, f(c)?)];
    for _ in 0..PEAK_STEPS {
        let [a, b, c] = three;
        let vertex = Parabola::through([a.0, b.0, c.0], [a.1, b.1, c.1]).vertex();
        // Equal positions would cause a division by zero.
        let inside = |at: &f64| a.0 < *at && *at < c.0 && at.to_bits() != b.0.to_bits();
        let Some(at) = vertex.filter(inside) else {
            break;
        };
        let new = (at, f(at)?);
        // It joins the three, and the outer one next to the lower of the two inner ones leaves.
        let [left, right] = if at < b.0 { [new, b] } else { [b, new] };
        three = if left.1 > right.1 {
            [a, left, right]
        } else {
            [left, right, c]
        };
    }
    let most = three.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    Ok(most.map_or(b, |most| most.0))
}

/// Whether a peak is higher than another one: of two that differ by rounding the first is kept.
fn is_higher(peak: f64, other: f64) -> bool {
    peak - other > 1e-14 * other.abs()
}

/// Candidates for the peak of a curve, of which `count` values are known: the three positions around each of the most promising ones, in order. Two
/// summits may be almost equally high, and the positions may lie closer to the top of the lower one.
///
/// `around` gives the position `k` and two others, in order, all in one smooth part of the curve.
fn summits(
    count: usize,
    value: impl Fn(usize) -> f64,
    around: impl Fn(usize) -> Option<[usize; 3]>,
) -> Vec<[usize; 3]> {
    // The first of equal ones.
    let by = |j: &usize, k: &usize| value(*j).total_cmp(&value(*k));
    let Some(most) = (0..count).rev().max_by(by) else {
        return Vec::new();
    };
    let top = value(most);
    let mut found = Vec::new();
    for k in 0..count {
        let not_above = |j: usize| j >= count || value(j) <= value(k);
        if k != most && !((k == 0 || not_above(k - 1)) && not_above(k + 1)) {
            continue;
        }
        let Some(around) = around(k) else {
            continue;
        };
        // The rise of a parabola above the middle of three positions is less than the sum of its drops to the others.
        let [a, b, c] = around.map(&value);
        let may_be = value(k) + (2.0 * b - a - c).max(0.0);
        if k == most || may_be > top {
            found.push((may_be, around));
        }
    }
    found.sort_by(|a: &(f64, _), b| b.0.total_cmp(&a.0));
    found.dedup_by_key(|(_, around)| *around);
    found.truncate(MOST_SUMMITS);
    let mut places: Vec<[usize; 3]> = found.into_iter().map(|(_, around)| around).collect();
    places.sort_unstable();
    places
}

/// The highest peak of a curve, if it is higher than `above`: the three known positions around it, and its position. Of peaks that differ by
/// rounding, the first.
///
/// `value` is the value at a known position, of which there are `count`; `place` gives the position; `around` gives it with two others, in order, all
/// in one smooth part of the curve; `f` is the curve.
///
/// # Errors
/// Those of `f`.
pub fn highest<E>(
    (count, value): (usize, impl Fn(usize) -> f64),
    around: impl Fn(usize) -> Option<[usize; 3]>,
    place: impl Fn(usize) -> f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
    above: f64,
) -> Result<Option<([usize; 3], f64)>, E> {
    let mut best = above;
    let mut found = None;
    for around in summits(count, value, around) {
        let at = peak(&mut f, around.map(&place))?;
        let value = f(at)?;
        if is_higher(value, best) {
            best = value;
            found = Some((around, at));
        }
    }
    Ok(found)
}
