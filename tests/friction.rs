//! Friction drives: their equation of motion, slip, and the effect of a time-varying ratio.

mod bad_input;
mod constant;
mod courses;
mod creep;
mod integrability;
mod motion;
mod newton;
mod power;

/// One step of the classical Runge-Kutta method for several states.
fn rk4<const N: usize>(
    f: impl Fn(f64, &[f64; N]) -> [f64; N],
    t: f64,
    y: &[f64; N],
    h: f64,
) -> [f64; N] {
    let at = |k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let k1 = f(t, y);
    let k2 = f(t + h / 2.0, &at(&k1, h / 2.0));
    let k3 = f(t + h / 2.0, &at(&k2, h / 2.0));
    let k4 = f(t + h, &at(&k3, h));
    std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
}

/// From `t` on over `steps` steps of `h`.
fn integrate<const N: usize>(
    f: impl Fn(f64, &[f64; N]) -> [f64; N],
    t: f64,
    mut y: [f64; N],
    h: f64,
    steps: usize,
) -> [f64; N] {
    for k in 0..steps {
        y = rk4(&f, t + h * k as f64, &y, h);
    }
    y
}
