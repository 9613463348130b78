//! The quadratic spline: through its samples, smooth at the knots, closed, of the stated order.

use jred::number::RangeError;
use std::f64::consts::TAU;

use crate::support::{assert_near, budget, config, largest};
use jred::table::{control_points, fit_quadratic_bounded, fit_quadratic_periodic};
use proptest::prelude::*;

/// Control points h₀, h₁, h₂ (in halves) of every cell.
struct Quadratic(Vec<f64>);

impl Quadratic {
    fn periodic(samples: &[f64]) -> Self {
        let mut control = vec![f64::NAN; control_points(samples.len())];
        fit_quadratic_periodic(samples, &mut control).unwrap();
        Self(control)
    }

    fn bounded(samples: &[f64]) -> Self {
        let mut control = vec![f64::NAN; control_points(samples.len() - 2)];
        fit_quadratic_bounded(samples, &mut control).unwrap();
        Self(control)
    }

    /// Value and slope a cell, by the basis functions of the B-spline.
    fn at(&self, cell: usize, u: f64) -> [f64; 2] {
        let [h0, h1, h2] = [0, 1, 2].map(|k| self.0[cell + k]);
        let v = 1.0 - u;
        [
            h0 * v * v + h1 * (1.0 + 2.0 * u * v) + h2 * u * u,
            2.0 * (h1 - h0) * v + 2.0 * (h2 - h1) * u,
        ]
    }

    fn cells(&self) -> usize {
        self.0.len() - 3
    }

    /// Value and slope meet at every knot inside.
    fn check_knots(&self, size: f64) {
        for cell in 1..self.cells() {
            let [before, after] = [self.at(cell - 1, 1.0), self.at(cell, 0.0)];
            for (order, (a, b)) in before.iter().zip(after).enumerate() {
                assert_near(
                    "knot",
                    *a,
                    b,
                    budget::SPLINE_KNOT * size * (order + 1) as f64,
                );
            }
        }
    }
}

proptest! {
    #![proptest_config(config(128, 0x0051))]

    #[test]
    fn periodic_passes_through_its_samples(samples in prop::collection::vec(-5f64..5.0, 4..70)) {
        let curve = Quadratic::periodic(&samples);
        for (cell, sample) in samples.iter().enumerate() {
            assert_near("middle", curve.at(cell, 0.5)[0], *sample, 5.0 * budget::SPLINE_KNOT);
        }
        curve.check_knots(5.0);
        let (end, start) = (curve.at(samples.len() - 1, 1.0), curve.at(0, 0.0));
        prop_assert_eq!(end.map(f64::to_bits), start.map(f64::to_bits), "the turn closes");
    }

    #[test]
    fn bounded_passes_through_its_samples(samples in prop::collection::vec(-5f64..5.0, 6..70)) {
        let curve = Quadratic::bounded(&samples);
        let cells = samples.len() - 2;
        let budget = 5.0 * budget::SPLINE_KNOT;
        for (cell, sample) in samples[1..=cells].iter().enumerate() {
            assert_near("middle", curve.at(cell, 0.5)[0], *sample, budget);
        }
        assert_near("start", curve.at(0, 0.0)[0], samples[0], budget);
        assert_near("end", curve.at(cells - 1, 1.0)[0], samples[cells + 1], budget);
        curve.check_knots(5.0);
        prop_assert_eq!(curve.0[cells + 2].to_bits(), 0, "the point that no cell reads");
    }

    #[test]
    fn bounded_reproduces_a_quadratic(c in [-3.0..3.0, -3.0..3.0, -3.0f64..3.0], cells in 4usize..100) {
        let value = |x: f64| c[0] + x * (c[1] + x * c[2]);
        let n = cells as f64;
        let samples: Vec<f64> = (0..cells + 2).map(|k| value((k as f64 - 0.5).clamp(0.0, n) / n)).collect();
        let curve = Quadratic::bounded(&samples);
        for cell in 0..cells {
            for u in [0.0, 0.3, 1.0] {
                let x = (cell as f64 + u) / n;
                let [found, slope] = curve.at(cell, u);
                assert_near("value", found, value(x), budget::SPLINE_END * 9.0);
                assert_near("slope", slope, (c[1] + 2.0 * c[2] * x) / n, budget::SPLINE_END * 9.0);
            }
        }
    }
}

/// Largest error of value and slope by x in 0 to 1.
fn errors(curve: &Quadratic, f: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let n = curve.cells() as f64;
    [0, 1].map(|order| {
        let places =
            (0..curve.cells()).flat_map(|cell| (0..=32).map(move |u| (cell, f64::from(u) / 32.0)));
        largest(places.map(|(cell, u)| {
            curve.at(cell, u)[order] * n.powi(order as i32) - f((cell as f64 + u) / n)[order]
        }))
    })
}

#[test]
fn value_converges_with_order_3_and_slope_with_2() {
    let turn = |x: f64| {
        let (sin, cos) = (TAU * x).sin_cos();
        [sin.exp(), TAU * cos * sin.exp()]
    };
    let stroke = |x: f64| [(2.0 * x).exp(), 2.0 * (2.0 * x).exp()];
    let periodic = |cells: usize| {
        let middle = |k| (f64::from(k) + 0.5) / cells as f64;
        let samples: Vec<f64> = (0..cells as u32).map(|k| turn(middle(k))[0]).collect();
        errors(&Quadratic::periodic(&samples), turn)
    };
    let bounded = |cells: usize| {
        let n = cells as f64;
        let place = |k: usize| (k as f64 - 0.5).clamp(0.0, n) / n;
        let samples: Vec<f64> = (0..cells + 2).map(|k| stroke(place(k))[0]).collect();
        errors(&Quadratic::bounded(&samples), stroke)
    };
    for cells in [64, 128] {
        for [coarse, fine] in [
            [periodic(cells), periodic(2 * cells)],
            [bounded(cells), bounded(2 * cells)],
        ] {
            let [value, slope] = [coarse[0] / fine[0], coarse[1] / fine[1]];
            println!("{cells} cells: {coarse:?}, ratios {value:.2} {slope:.2}");
            assert_near("order 3", value, 8.0, 8.0 * budget::ORDER_SHARE);
            assert_near("order 2", slope, 4.0, 4.0 * budget::ORDER_SHARE);
        }
    }
}

#[test]
fn too_few_samples_and_buffers_of_another_length_are_refused() {
    let range = |given: f64, min: f64| RangeError::OutOfRange {
        what: "number of samples",
        value: given,
        min,
        max: f64::INFINITY,
    };
    let length = Err(RangeError::BufferTooShort {
        needed: 7,
        given: 6,
    });
    assert_eq!(
        fit_quadratic_periodic(&[1.0; 3], &mut [0.0; 6]),
        Err(range(3.0, 4.0))
    );
    assert_eq!(
        fit_quadratic_bounded(&[1.0; 5], &mut [0.0; 6]),
        Err(range(5.0, 6.0))
    );
    assert_eq!(fit_quadratic_periodic(&[1.0; 4], &mut [0.0; 6]), length);
    assert_eq!(fit_quadratic_bounded(&[1.0; 6], &mut [0.0; 6]), length);
    assert_eq!(fit_quadratic_bounded(&[1.0; 6], &mut [0.0; 7]), Ok(()));
}
