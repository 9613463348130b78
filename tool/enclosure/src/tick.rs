//! Rounding of a tick, in addition to the exactly evaluated table: in fixed point the units stated in docs/theory.md and proven by Gappa; in floating
//! point a bound of all rounding of the tick in the given cell.

use jred::Scale;
use jred::number::Number;
use jred::table::{CellCurves, Format};

/// Difference of a table's tick from the same formulas without rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tick {
    arithmetic: Arithmetic,
    /// Error of the place that is read, in cells.
    place: f64,
    /// Relative error of the velocity torque.
    bases: f64,
    /// Largest speed and acceleration.
    range: [f64; 2],
    /// Factor of the slope from per cell to per position; the latter is multiplied by ½·ω².
    cells_per_position: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Arithmetic {
    /// A torque (N·m).
    Fixed(f64),
    /// Half a unit of the last place, as a relative error, and whether the cell's coefficients are computed from control points.
    Float { epsilon: f64, points: bool },
}

impl Tick {
    /// For a table of this format with `cells` cells over `span`, and speeds and accelerations up to `range`. `None` for a format whose arithmetic is
    /// not proven.
    pub(crate) fn new<F: Format>(
        scale: &Scale,
        cells: u32,
        span: f64,
        range: [f64; 2],
    ) -> Option<Self> {
        let [torque, speed, inertia] =
            [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
        let number = <F::Number as Number>::NAME;
        let cells_per_position = f64::from(cells) / span;
        // The velocity torque at the speed base, in slopes per cell: an integer in `Q31`.
        let factor = 0.5 * cells_per_position * inertia * speed * speed / torque;
        let fixed = |step: f64, [torque_units, slope_units]: [f64; 2], place| {
            let exact = factor * 2.0 / step;
            let whole = exact.round();
            Self {
                arithmetic: Arithmetic::Fixed(
                    (torque_units + slope_units * whole) / 2_147_483_648.0 * torque * (1.0 + 1e-12),
                ),
                place,
                bases: (whole / exact - 1.0).abs() + 1e-12,
                range,
                cells_per_position,
            }
        };
        let float = |epsilon: f64, place, bases| Self {
            arithmetic: Arithmetic::Float {
                epsilon,
                points: F::NAME == "spline",
            },
            place,
            bases,
            range,
            cells_per_position,
        };
        Some(match (number, F::NAME) {
            ("i32", "spline" | "spline16") => fixed(2.0, [24.0, 3.5], 2.0_f64.powi(-31)),
            ("i32", "cubic") => fixed(1.0, [24.0, 7.0], 0.0),
            ("i32", "quadratic") => fixed(1.0, [22.0, 4.0], 2.0_f64.powi(-16)),
            ("i16", "rows") => Self {
                arithmetic: Arithmetic::Fixed(5.75 / 32_768.0 * torque * (1.0 + 1e-12)),
                place: 2.0_f64.powi(-16),
                bases: 0.0,
                range,
                cells_per_position,
            },
            ("f32", "spline" | "cubic" | "quadratic") => {
                float(2.0_f64.powi(-24), 2.0_f64.powi(-25), 3e-7)
            }
            ("f64", "spline" | "cubic" | "quadratic") => {
                float(2.0_f64.powi(-53), 2.0_f64.powi(-54), 1e-15)
            }
            _ => return None,
        })
    }

    /// The largest difference (N·m) in one cell.
    pub(crate) fn error(&self, cell: &CellCurves) -> f64 {
        let [omega, alpha] = self.range;
        let reach = cell.centre.max(1.0 - cell.centre);
        // A place that is rounded up may lie beyond the end of the cell by the same amount.
        let moved = |p: &[f64; 4]| {
            1.000_1
                * self.place
                * (p[1].abs() + reach * (2.0 * p[2].abs() + reach * 3.0 * p[3].abs()))
        };
        let largest = |p: &[f64; 4]| {
            p[0].abs() + reach * (p[1].abs() + reach * (p[2].abs() + reach * p[3].abs()))
        };
        let half_square = 0.5 * omega * omega;
        let place = moved(&cell.inertia) * alpha
            + moved(&cell.inertia_slope) * half_square
            + moved(&cell.load)
            + moved(&cell.viscous) * omega
            + moved(&cell.coulomb);
        let bases = self.bases * largest(&cell.inertia_slope) * half_square;
        let arithmetic = match self.arithmetic {
            Arithmetic::Fixed(torque) => torque,
            Arithmetic::Float { epsilon, points } => self.roundings(cell, epsilon, points),
        };
        (place + bases + arithmetic) * (1.0 + 1e-12)
    }

    /// All rounding of a tick in floating point, in the order of its operations.
    fn roundings(&self, cell: &CellCurves, epsilon: f64, points: bool) -> f64 {
        let [omega, alpha] = self.range.map(RoundedValue::exact);
        let ops = Roundings(epsilon);
        let coefficients = |p: &[f64; 4], offset: f64| {
            if points {
                ops.of_points(p, offset)
            } else {
                p.map(RoundedValue::exact)
            }
        };
        let horner = |[p0, p1, p2, p3]: [RoundedValue; 4]| {
            // u ≤ 1.
            let b2 = ops.plus(p2, ops.times(p3, RoundedValue::ONE));
            let b1 = ops.plus(p1, ops.times(b2, RoundedValue::ONE));
            (ops.plus(p0, ops.times(b1, RoundedValue::ONE)), b1, b2, p3)
        };
        let (inertia, b1, b2, p3) = horner(coefficients(&cell.inertia, cell.offset));
        let t3 = ops.times(p3, RoundedValue::ONE);
        let slope = ops.plus(b1, ops.times(ops.plus(b2, t3), RoundedValue::ONE));
        let curve = |p: &[f64; 4]| horner(coefficients(p, 0.0)).0;
        let constant = |p: &[f64; 4]| {
            if p[1..].iter().all(|p| *p == 0.0) {
                RoundedValue::exact(p[0])
            } else {
                curve(p)
            }
        };
        // The exact factor: its rounding is included in the bases.
        let factor = RoundedValue::exact(0.5 * self.cells_per_position);
        let velocity = ops.times(ops.times(slope, factor), omega);
        let speed = ops.plus(velocity, constant(&cell.viscous));
        let sum = ops.plus(ops.times(speed, omega), ops.times(inertia, alpha));
        let sum = ops.plus(sum, curve(&cell.load));
        ops.plus(sum, constant(&cell.coulomb)).error
    }
}

/// The magnitude of a number, and its error.
#[derive(Clone, Copy)]
struct RoundedValue {
    size: f64,
    error: f64,
}

impl RoundedValue {
    const ONE: Self = Self {
        size: 1.0,
        error: 0.0,
    };

    const fn exact(value: f64) -> Self {
        Self {
            size: value.abs(),
            error: 0.0,
        }
    }
}

/// Operations with rounding to the nearest number, each with at most this relative error.
struct Roundings(f64);

impl Roundings {
    fn rounded(&self, size: f64, error: f64) -> RoundedValue {
        // The smallest number in single precision: products may become subnormal.
        const LEAST: f64 = 1.5e-45;
        RoundedValue {
            size,
            error: error + self.0 * (size + error) + LEAST,
        }
    }

    fn plus(&self, a: RoundedValue, b: RoundedValue) -> RoundedValue {
        self.rounded(a.size + b.size, a.error + b.error)
    }

    fn times(&self, a: RoundedValue, b: RoundedValue) -> RoundedValue {
        let error = a.size * b.error + b.size * a.error + a.error * b.error;
        self.rounded(a.size * b.size, error)
    }

    /// The coefficients of a cubic from its control points, whose differences are known from it.
    fn of_points(&self, [p0, p1, p2, p3]: &[f64; 4], offset: f64) -> [RoundedValue; 4] {
        let s0 = p2 / 3.0;
        let [d0, d1] = [(p1 - p2) / 6.0, (p1 + p2) / 6.0];
        let s1 = s0 + p3;
        let point = (p0 - offset - s0).abs();
        // Each as computed: first its operands, then itself.
        let once = |value: f64| self.rounded(value.abs(), 0.0);
        let [d0, d1, d2] = [once(d0), once(d1), once(d1 + s1)];
        let sum = |value: f64, a: RoundedValue, b: RoundedValue| {
            self.rounded(value.abs(), a.error + b.error)
        };
        let (s0, s1) = (sum(s0, d0, d1), sum(s1, d1, d2));
        let plain = sum(p0 - offset, once(point), s0);
        let k =
            |value: f64, times: f64, a: RoundedValue| self.rounded(value.abs(), times * a.error);
        [
            sum(*p0, plain, RoundedValue::exact(offset)),
            k(*p1, 3.0, sum(p1 / 3.0, d0, d1)),
            k(*p2, 3.0, s0),
            sum(*p3, s1, s0),
        ]
    }
}
