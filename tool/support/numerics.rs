//! Plain numerical methods that the tool does not use.

/// f′(x) by central differences with the steps h and h/2, extrapolated to order 4.
pub(crate) fn derivative(f: impl Fn(f64) -> f64, x: f64, h: f64) -> f64 {
    let central = |h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
    (4.0 * central(h / 2.0) - central(h)) / 3.0
}

/// The place between `a` and `b` where f changes its sign.
pub(crate) fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let left = f(a) > 0.0;
    assert!(
        left != (f(b) > 0.0),
        "no change of sign between {a} and {b}"
    );
    for _ in 0..200 {
        let middle = 0.5 * (a + b);
        if (f(middle) > 0.0) == left {
            a = middle;
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

/// Trapezoidal rule over values at equal steps.
pub(crate) fn trapezoid(step: f64, values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let last = values.len() - 1;
    let weighted = values.enumerate().map(|(k, value)| {
        if k == 0 || k == last {
            0.5 * value
        } else {
            value
        }
    });
    weighted.sum::<f64>() * step
}

/// The complete elliptic integral K(k) by the arithmetic-geometric mean.
pub(crate) fn elliptic_k(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}
