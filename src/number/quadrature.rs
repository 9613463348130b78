//! Integrals of smooth functions.

/// Nodes and weights of the five-point Gauss-Legendre rule on [−1, 1] (Abramowitz and Stegun, table 25.4).
#[expect(clippy::excessive_precision, reason = "the table's digits")]
const RULE: [(f64, f64); 5] = [
    (-0.906_179_845_938_663_993, 0.236_926_885_056_189_088),
    (-0.538_469_310_105_683_091, 0.478_628_670_499_366_468),
    (0.0, 0.568_888_888_888_888_889),
    (0.538_469_310_105_683_091, 0.478_628_670_499_366_468),
    (0.906_179_845_938_663_993, 0.236_926_885_056_189_088),
];

/// ∫ f from `from` to `to`, on `cells` equal cells. The error is of order 10.
pub(crate) fn integrate<E>(
    from: f64,
    to: f64,
    cells: u32,
    f: impl Fn(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let half = 0.5 * (to - from) / f64::from(cells);
    let mut sum = 0.0;
    for cell in 0..cells {
        let middle = from + half * f64::from(2 * cell + 1);
        for (place, weight) in RULE {
            sum += weight * f(middle + half * place)?;
        }
    }
    Ok(sum * half)
}
