//! The path over a parameter u from 0 to 1, shaped at its ends so that the pace du/dt is smooth up to rest.
//!
//! Near rest the speed is not a smooth function of the position: v² ∝ φ where the acceleration begins with a jump, v² ∝ φ^(4/3) where it begins with
//! a constant jerk. Along g(u) with g ∝ u² or u³ there, the square of the pace is smooth and greater than zero.

/// g(u) with g(0) = 0 and g(1) = 1, in cubic pieces.
#[derive(Clone, Debug)]
pub(crate) struct Parametrization {
    /// Start of each piece, and its Taylor series there.
    pieces: Vec<(f64, [f64; 4])>,
}

impl Parametrization {
    /// A path whose ends are at rest or not, with ramps of the acceleration over a share of u (0: no ramp).
    pub(crate) fn new(rest: [bool; 2], ramp: f64) -> Self {
        Self::with_ramps(rest, [ramp; 2], &[])
    }

    /// The same with a ramp for each end, or no ramp at both. The ramp passes through these points, given as [share of its length, share of its
    /// height]; a straight ramp has no points.
    pub(crate) fn with_ramps(
        [starts, stops]: [bool; 2],
        [first_ramp, last_ramp]: [f64; 2],
        passes: &[[f64; 2]],
    ) -> Self {
        let ramp = first_ramp.max(last_ramp);
        // Knots of the second derivative, which is linear between them.
        let mut knots: Vec<[f64; 2]> = Vec::new();
        if ramp > 0.0 && starts {
            knots.push([0.0, 0.0]);
            knots.extend(
                passes
                    .iter()
                    .map(|[share, height]| [share * first_ramp, *height]),
            );
        }
        let from = if starts { first_ramp } else { 0.0 };
        let to = if stops { 1.0 - last_ramp } else { 1.0 };
        // Between two rests the slope ends as it begins.
        let area = |ramp: f64| ramp * rise(passes) + 0.5 * (to - from);
        let (first, last) = match (starts, stops) {
            (true, true) => (1.0, -area(first_ramp) / area(last_ramp)),
            (true, false) => (1.0, 1.0),
            (false, true) => (-1.0, -1.0),
            (false, false) => (0.0, 0.0),
        };
        knots.push([from, first]);
        knots.push([to, last]);
        if ramp > 0.0 && stops {
            let back = passes.iter().rev();
            knots.extend(back.map(|[share, height]| [1.0 - share * last_ramp, last * height]));
            knots.push([1.0, 0.0]);
        }
        let change: f64 = knots
            .windows(2)
            .map(|k| 0.5 * (k[0][1] + k[1][1]) * (k[1][0] - k[0][0]))
            .sum();
        // The slope at the start makes the slope at an end at rest zero.
        let mut state = [0.0, 0.0];
        if !starts {
            state[1] = if stops { -change } else { 1.0 };
        }
        let mut pieces = Vec::new();
        for pair in knots.windows(2) {
            let [[u, bend], [end, next]] = [pair[0], pair[1]];
            let h = end - u;
            let jerk = (next - bend) / h;
            let [g, slope] = state;
            pieces.push((u, [g, slope, bend, jerk]));
            state = [
                g + h * (slope + h * (bend / 2.0 + h * jerk / 6.0)),
                slope + h * (bend + h * jerk / 2.0),
            ];
        }
        for (_, taylor) in &mut pieces {
            for term in taylor {
                *term /= state[0];
            }
        }
        Self { pieces }
    }

    /// [g, g′, g″] at u.
    pub(crate) fn at(&self, u: f64) -> [f64; 3] {
        let [g, slope, bend, _] = self.series(u, u);
        [g, slope, bend]
    }

    /// [g, g′, g″, g‴] at u in the piece that contains `within`: g‴ jumps between pieces.
    pub(crate) fn series(&self, u: f64, within: f64) -> [f64; 4] {
        let index = self
            .pieces
            .partition_point(|(from, _)| *from <= within)
            .max(1)
            - 1;
        let (from, [g, slope, bend, jerk]) = self.pieces[index];
        let h = u - from;
        [
            g + h * (slope + h * (bend / 2.0 + h * jerk / 6.0)),
            slope + h * (bend + h * jerk / 2.0),
            bend + h * jerk,
            jerk,
        ]
    }

    /// Borders of the pieces, between 0 and 1.
    pub(crate) fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().skip(1).map(|(from, _)| *from)
    }

    /// The u at which g has a value between 0 and 1.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let [mut low, mut high] = [0.0, 1.0];
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.at(middle)[0] < value {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

/// Area under a ramp of length and height one through these points.
fn rise(passes: &[[f64; 2]]) -> f64 {
    let mut area = 0.0;
    let mut before = [0.0, 0.0];
    for &[share, height] in passes.iter().chain(&[[1.0, 1.0]]) {
        area += 0.5 * (share - before[0]) * (height + before[1]);
        before = [share, height];
    }
    area
}

#[cfg(test)]
mod tests {
    use super::Parametrization;

    /// Every path goes from 0 to 1, rises, has no slope at rest, and with ramps no second derivative there.
    #[test]
    fn ends_are_as_asked() {
        for rest in [[true, true], [true, false], [false, true], [false, false]] {
            for ramp in [0.0, 0.1, 0.3] {
                let shape = Parametrization::new(rest, ramp);
                let [first, last] = [0.0, 1.0].map(|u| shape.at(u));
                assert!(first[0].abs() < 1e-15 && (last[0] - 1.0).abs() < 1e-15);
                for (end, rest) in [first, last].into_iter().zip(rest) {
                    assert_eq!(end[1].abs() < 1e-15, rest, "{end:?}");
                    if rest {
                        assert_eq!(end[2].abs() < 1e-14, ramp > 0.0, "{end:?}");
                    }
                }
                assert!((1..100).all(|k| shape.at(f64::from(k) / 100.0)[1] > 0.0));
                let u = shape.place(0.3);
                assert!((shape.at(u)[0] - 0.3).abs() < 1e-14);
            }
        }
    }
}
