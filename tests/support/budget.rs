//! All tolerances of the suite with their reasons. They are bounds on |found − expected|.

/// Golden data are correctly rounded 50-digit numbers; a closed form of some thirty operations, each good to 2⁻⁵³, may
/// lose a few hundred units in the last place: relative to the column's largest magnitude.
pub(crate) const GOLDEN: f64 = 1e-12;

/// Two closed forms of the same quantity, both in f64 with a few tens of operations; relative to the largest term.
pub(crate) const CLOSED_FORM: f64 = 1e-13;

/// Central differences extrapolated twice (order 6) at a step of 1/64: truncation h⁶·f⁽⁷⁾ and rounding 2⁻⁵³/h are both
/// near 1e-11 for functions of size one; geometry close to a dead centre has large high derivatives. Relative to the
/// largest derivative seen.
pub(crate) const RICHARDSON: f64 = 2e-8;

/// Identities of differentiation (sin² + cos² = 1, q·g = f): up to 30 operations on numbers up to 100 in size.
pub(crate) const IDENTITY: f64 = 1e-12;

/// Roundings of one tick in floating point, in units of the type's epsilon times the sum of the terms' sizes: four
/// products, three sums, one quotient, each half a unit, there and back.
pub(crate) const TICK_ROUNDINGS: f64 = 8.0;

/// The ratio of two errors at steps h and h/2 is 2ᵖ for a method of order p; the next order of the series may change it by this share.
pub(crate) const ORDER_SHARE: f64 = 0.2;

/// Energy error of RK4 at 32 steps a cell over four turns, as a share of the energy: 1.4e-8 at 8 steps, and sixteen
/// times less with each halving.
pub(crate) const ENERGY: f64 = 1e-10;

/// At least this with the slope of a linear table, for any step: at 32 cells its J has an error of h²/8·J″, about 1 % of a J that varies by its own
/// size.
pub(crate) const INCONSISTENT_ENERGY: f64 = 1e-2;

/// Power balance: the time derivative of the energy by differences, as a share of the largest power.
pub(crate) const POWER: f64 = 1e-7;

/// Periodic filters and the tridiagonal solution end at 2⁻⁵³ times the samples' size, with a gain of up to 10.
pub(crate) const SPLINE_KNOT: f64 = 4e-15;

/// Slope and curvature multiply that by cells and cells².
pub(crate) const SPLINE_END: f64 = 2e-14;

/// `Phase::from_radians` promises half a unit of 2⁻³² turn; division and TAU add 2⁻⁵³ of a turn (5e-7 units).
pub(crate) const PHASE_UNITS: f64 = 0.5 + 1e-6;

/// `Phase::from_radians_f32` promises 6e-8 of a turn for |φ| ≤ 2π.
pub(crate) const PHASE_F32_TURNS: f64 = 6e-8;

/// A slider-crank in closed form, (r + |e|)/l up to 0.5, as a share of the sum of the largest sizes of the torque's terms: sine and
/// cosine are off by 1.1e-7, τ by as much, 1/cos ψ by 1.5 units of 2⁻²⁴ and, for τ·δτ/(1 − τ²) ≤ ⅔, by 7e-8; J′ takes the cube
/// of it; each coefficient is rounded to 2⁻²⁴.
pub(crate) const SLIDER_CRANK: f64 = 1e-6;

/// The same up to the steepest rod, where τ·δτ/(1 − τ²) is ten times δτ.
pub(crate) const SLIDER_CRANK_STEEP: f64 = 3e-6;

/// A law in f32 against f64: z is rounded to 2⁻²⁴, S″ varies by up to 40 a unit of z, ten roundings of numbers up to
/// 20 in size.
pub(crate) const LAW_F32: f64 = 2e-5;

/// Table in f64 of a smooth machine at 128 cells against the exact reduction: h⁴/384·J⁗ for the value, h³/24·J⁗ for the
/// slope, relative to the torque's size.
pub(crate) const STROKE_TABLE: f64 = 2e-4;

/// One unit of Q31.
pub(crate) const Q31_UNIT: f64 = 1.0 / 2_147_483_648.0;

/// Arithmetic of `Model::<Q31>::torque`, in units of 2⁻³¹ of the torque base, found − exact. Every product rounds towards −∞.
/// (1) The velocity coefficient is in Q30: its floor is multiplied by ω and halved, ±½ unit of Q29. (2) That times ω and
/// (3) J·α are in Q29: each lowers the sum by up to a unit. Slope times factor is a whole number and rounds nothing; load
/// and friction are in Q29 as they are. Together −2.5 to 0.5 units of Q29, each of them four of 2⁻³¹.
pub(crate) const Q31_TORQUE_UNITS: [f64; 2] = [-10.0, 2.0];

/// Mean of the same over all speeds: the floors (2) and (3) lose half a unit of Q29 each, (1) averages out with the sign of
/// ω: −4. Three standard errors of 80,000 ticks are 0.02.
pub(crate) const Q31_TORQUE_BIAS: [f64; 2] = [-4.03, -3.97];

/// RMS of the same: variances of 1/12 for (2) and for (3), ¼·⅓·⅓ for (1), times 4²: √(16 + 3.11) = 4.372.
pub(crate) const Q31_TORQUE_RMS: [f64; 2] = [4.34, 4.40];

/// A value and a slope as a fixed-point table reads them, in units of the curve's own format (the slope of a Spline in half of it), lowest and
/// highest. Here for a Spline: coefficient k is stored times 2ᵏ, so each product with the position halves the loss of the floors below it. A value
/// has floors of 1 + ½ + ¼, a slope 1 + 1 + 3/2. The position is rounded down to 2⁻³¹ of a cell, by up to 2⁻³²: times a slope of up to 2³⁰ units per
/// cell and a curvature of up to 1½·2³¹.
pub(crate) const Q31_SPLINE_READ: [[f64; 2]; 2] = [[-2.0, 0.25], [-4.25, 0.75]];

/// The same for a Cubic, with positions from −½ to ½ that are not rounded: value 1 ± ½ + ¼, slope 1 + 1 ± 3/2.
pub(crate) const Q31_CUBIC_READ: [[f64; 2]; 2] = [[-1.75, 0.5], [-3.5, 1.5]];

/// The same for a Quadratic at the position rounded down to 2⁻¹⁶ of a cell: value 1 ± ½, slope two floors of the same product.
pub(crate) const Q31_QUADRATIC_READ: [[f64; 2]; 2] = [[-1.5, 0.5], [-2.0, 0.0]];

/// A value of size one or less as a table in f32 reads it: control points or coefficients and the sums over them, half a unit of
/// 2⁻²³ of the largest for each of six.
pub(crate) const F32_READ: f64 = 4e-7;

/// Values and slopes of magnitude up to one from Q31 tables against f64: stored words have an error of half a unit of Q29, six of them in a Spline,
/// and the floors of [`Q31_SPLINE_READ`]; slopes come from differences of two.
pub(crate) const Q31_READ: [f64; 2] = [6.0 * 4.0 * Q31_UNIT, 12.0 * 4.0 * Q31_UNIT];

/// Weight of a point's own error relative to that of the slope, where the points of a spline are rounded together; half as much for the exact points,
/// which are rounded to 32 bits.
pub(crate) const ROUNDED_VALUE: f64 = 0.03;

/// Forward dynamics by the curve of 1/J, in units of 2⁻³¹ over J_m: product and Newton's step are in Q28 times J_m, eight units each; the step's
/// factor is in Q29, four units of a full acceleration. The curves' own words add as much again.
pub(crate) const RECIPROCAL_UNITS: f64 = 40.0;

/// `Model::reciprocal_error` evaluates four positions of a cell: between them, and in the worst cell, the error may be larger or smaller by this
/// factor.
pub(crate) const RECIPROCAL_STATED: f64 = 1.5;

/// Energy over four turns of a Q31 model, as a share: the resisting torque is low by a unit of Q29 on average ([`Q31_TORQUE_BIAS`]), which does the
/// work 2e-9·T_b·8π; T_b is up to ten times the energy [3e-7 found].
pub(crate) const Q31_ENERGY: f64 = 5e-7;

/// The same by the curve of 1/J: the quotient is low by up to two units of Q28 times J_m, on average half of that, with an effect of up to 1/J_m
/// times as much; a Quadratic's 1/J also differs from that of J, with a sign that changes in every cell [4e-6 to 8e-6 found].
pub(crate) const Q31_ENERGY_RECIPROCAL: f64 = 2e-5;

/// The factor ½·cells/span·J_b·ω_b²/T_b is computed in f32 in six operations with span rounded once: relative.
pub(crate) const FACTOR_ROUNDING: f64 = 7.0 * 5.97e-8;

/// `Scale::for_cells` promises this share of the factor: three bases rounded by up to 2⁻²⁴ relative, the speed squared.
pub(crate) const WHOLE_FACTOR: f64 = 2.5e-7;

/// A quotient of two bases in f32, before and after: five roundings of 2⁻²⁴.
pub(crate) const BASE_ROUNDINGS: f64 = 3e-7;

/// Largest table error on an independent, dense grid over that at the positions checked by `tabulate` (64 per cell), either way: at a distance d from
/// the extreme of a curve u·(1 − u)·(1 − 2u) or u²·(1 − u)² it is lower by up to 16·d², d ≤ 1/128 [6e-4].
pub(crate) const DENSE_GRID: f64 = 1.001;

/// Largest bound of a table's error over the largest error found: an eighth of the difference that roundings may make at three neighbouring
/// positions, where roundings dominate.
pub(crate) const BOUND_SLACK: f64 = 1.5;

/// Smallest share of the stated error that a dense grid finds for a Quadratic, whose slope errs most at the knots: the grid misses them, and within a
/// hundredth of a cell the error falls by 6 % [0.959].
pub(crate) const DENSE_GRID_QUADRATIC: f64 = 0.95;

/// Ends and symmetry of a law: a few roundings of numbers of size one (S″ up to 40 times that).
pub(crate) const LAW_END: f64 = 4e-15;

/// The speed of a law 1e-9 from its end: 1 − z is rounded by 2⁻⁵³, a share of 1.1e-7 with a factor of up to three.
pub(crate) const LAW_NEAR_REST: f64 = 4e-7;

/// Derivatives of a law by extrapolated differences at a step of 1e-3: rounding 2⁻⁵³/2.5e-4.
pub(crate) const LAW_DIFFERENCES: f64 = 1e-10;

/// A maximum on a grid of 1e-5: second order in half a step, with a relative curvature of up to 40.
pub(crate) const LAW_MAXIMUM: f64 = 1e-9;

/// Mean error of a table over its stated error: spline errors change sign in every cell and average out.
pub(crate) const TABLE_BIAS: f64 = 0.1;

/// Left and right of a break by 1e-9: S′ ≤ 2 and S″ ≤ 10, S‴ ≤ 40 times that; ten and a hundred times as much for S′, S″.
pub(crate) const LAW_BREAK: f64 = 1e-8;

/// A polynomial of seventh degree at its ends, as a share of its conditions' sizes: coefficients up to 84 times them, each of some ten
/// roundings; each derivative multiplies by up to the degree.
pub(crate) const POLYNOMIAL_END: f64 = 1e-13;

/// Positions up to 15 in size, a few roundings.
pub(crate) const POSITION: f64 = 2e-13;

/// Work of a windowed load by the trapezoidal rule with 20,000 positions, whose error comes from the jumps of S‴.
pub(crate) const WINDOW_WORK: f64 = 1e-6;

/// Mirror images differ by the rounding of π − φ, which J″ of a short rod enlarges.
pub(crate) const MIRROR: f64 = 1e-11;

/// Effect of the next order of r/l = 1/1000 on the first.
pub(crate) const YOKE: f64 = 0.005;

/// A limit angle depends on a rounding of 2⁻⁵³ through its square root, 1e-8.
pub(crate) const LIMIT_ANGLE: f64 = 1e-6;

/// A tick in Q31: the floors of [`Q31_TORQUE_UNITS`] and the rounding of the state.
pub(crate) const Q31_TICK_UNITS: f64 = 12.0;

/// Values of b (in Q30) and c (in Q29) of a Spline, in units of 2⁻³¹: six points' weights, each rounded by half a unit.
pub(crate) const Q31_POINTS_UNITS: f64 = 3.0 * 2.0 + 3.0 * 4.0;

/// Rounding of the exact sum in f64, 2⁻⁵³ of terms of 2³³ units.
pub(crate) const Q31_EXACT_UNITS: f64 = 1e-5;

/// Both markers of a joint with their derivatives, relative to the largest term.
pub(crate) const JOINT_CLOSURE: f64 = 1e-12;

/// Drive torque by d'Alembert against the reduced equation, relative to the largest torque in the machine.
pub(crate) const DALEMBERT: f64 = 1e-10;

/// Joint reactions against 50-digit golden data, relative to the column's largest value.
pub(crate) const REACTIONS: f64 = 1e-10;

/// Rounding of a difference: 64 roundings of the curve, over the smallest step of 1/1024; relative to the curve and to its antiderivative.
pub(crate) const DIFFERENCES: f64 = 64.0 * 1024.0 * f64::EPSILON;

/// A derivative by extrapolated differences of order 6 at a step of 1e-2, relative to the curve's magnitude.
pub(crate) const ENERGY_SLOPE: f64 = 1e-8;

/// A library mechanism against its joints solved as a linkage, relative to the derivative's magnitude.
pub(crate) const LINKAGE: f64 = 1e-11;

/// A linkage through a change point against its closed form, for lengths that differ by half or more: position and first to third transfer function,
/// relative to 1 or the largest. At the ends of a window of about 0.05 rad the solver has an error of 2⁻⁵³ over the first to fourth power of that;
/// the polynomial between them amplifies it about ten times.
pub(crate) const CHANGE_POINT: [f64; 4] = [1e-12, 1e-11, 5e-9, 1e-6];

/// The same for an antiparallelogram of 0.28 m and 0.3 m, whose rocker turns at most 29 times as fast as its crank; relative to the largest
/// derivative of an angle.
pub(crate) const CHANGE_POINT_STEEP: [f64; 4] = [2e-10, 1e-8, 1e-6, 1e-5];

/// Work of the drive through a change point at constant speed, by Simpson's rule with 400 steps of a smooth function, against the change of energy,
/// relative to the largest energy.
pub(crate) const CHANGE_POINT_WORK: f64 = 1e-9;

/// Handbook figures of three digits.
pub(crate) const HANDBOOK: f64 = 5e-3;

/// Peaks of ψ′ and ψ″ of a Geneva wheel on a grid of 10,000 steps per half engagement: half a step of 5e-5 rad squared, times the relative curvature,
/// up to 1000 with three slots.
pub(crate) const GENEVA_PEAK: f64 = 1e-6;

/// Reduced curves of a linkage against 50-digit golden data: squares of transfer functions with an error of 1e-12, relative to the column's largest
/// magnitude.
pub(crate) const GOLDEN_REDUCTION: f64 = 1e-11;

/// Figures printed with two decimals.
pub(crate) const PRINTED: f64 = 0.005 + 1e-12;

/// The displacement of a cam program against another form of the same polynomial or sine, relative to the rise over the power of the segment's angle;
/// twenty operations.
pub(crate) const CAM_PROGRAM: f64 = 1e-13;

/// A point of the cam's profile against a circle or an equidistant curve in closed form, relative to the cam's radius.
pub(crate) const CAM_PROFILE: f64 = 1e-12;

/// Curvature of the profile, from second transfer functions, relative to the base circle's.
pub(crate) const CAM_CURVATURE: f64 = 1e-11;

/// Position of an extreme by golden section: to the square root of the roundings, 1e-8 of a piece, with a reserve for curves as flat as a dwell's
/// edge.
pub(crate) const EXTREME_PLACE: f64 = 1e-6;

/// Its value, relative.
pub(crate) const EXTREME_VALUE: f64 = 1e-11;

/// Distance of a smooth closed curve's points from a fixed point, by differences of order 6 at a step of 1e-3, relative to the curve's size.
pub(crate) const CAM_TANGENT: f64 = 1e-9;

/// Contact force at the limit speed, relative to the spring's force.
pub(crate) const LIFT_OFF: f64 = 1e-9;

/// Length of the pitch curve by Gauss quadrature against a rule of 20,000 steps.
pub(crate) const PITCH_LENGTH: f64 = 1e-9;

/// Energy (or momentum) of a free run with a shifted ratio, by RK4 with thousands of steps: its own error is h⁴.
pub(crate) const FREE_RUN: f64 = 1e-10;

/// Power of a friction drive in motion: about fifty operations, relative to the sum of the terms' magnitudes.
pub(crate) const POWER_BALANCE: f64 = 1e-12;

/// One speed against two discs with a contact force, RK4 on both sides with 10,000 steps; relative.
pub(crate) const NEWTON: f64 = 1e-9;

/// Load and slip solved together, both of magnitude up to one; the converged load has an error of 8 roundings.
pub(crate) const SETTLED: f64 = 1e-14;

/// Finite relation of a holonomic constraint: RK4 with 100 to 400 steps, or a Gauss rule of order 10.
pub(crate) const RELATION: f64 = 1e-9;

/// A spline through 20 to 48 samples of a sine, value and slope: h⁴/384 and h³/24 of its derivatives, more at free ends.
pub(crate) const CURVE: [f64; 2] = [1e-4, 5e-3];

/// The largest rate of a sine on a grid of 129 points over a whole period, one of which is its steepest.
pub(crate) const GRID_MAXIMUM: f64 = 1e-6;

/// Products, quotients and exponentials of up to four stage ratios, relative.
pub(crate) const SPLIT: f64 = 1e-13;

/// Slopes of J over the logarithm of a stage's ratio at the optimum, relative to J: the ratio is known to 2⁻⁵⁶ of its range, the slope changes by up
/// to 16·J with it, and the inner stages' roundings add up.
pub(crate) const SPLIT_SLOPE: f64 = 1e-12;

/// The same curve some turns later: φ up to 300 rad is known to 2⁻⁵³ relative, and a Geneva wheel's J″ changes by up to 10⁴ of its magnitude per
/// radian. Relative to the largest value.
pub(crate) const A_TURN_LATER: f64 = 1e-9;

/// J and J′ of a Geneva drive 1e-9 rad before and after an edge of the engagement, relative to the wheel's inertia: J′ changes by J″ ≤ 1 times the
/// distance.
pub(crate) const GENEVA_EDGE: f64 = 4e-9;

/// The step of J″ there, from neighbours at the same distance: ten times that per radian.
pub(crate) const GENEVA_STEP: f64 = 1e-7;

/// `Circular::sin_cos_of` in f32 promises this: the roundings of phase, angle and result, each up to 2⁻²⁵ of numbers up to one. Over all 2³² phases
/// the maximum is 1.02e-7.
pub(crate) const SIN_COS_F32: f64 = 1.05e-7;

/// The same in f64: `libm`'s and the angle's rounding.
pub(crate) const SIN_COS_F64: f64 = 2.5e-16;

/// A model of `Harmonic<f32>` in f32 promises this, relative to the sum of the coefficients' magnitudes: k times the errors of sine and cosine, and
/// of k rotations.
pub(crate) const HARMONIC_F32: f64 = 4e-7;

/// The same in f64, where the reference series rounds k·φ.
pub(crate) const HARMONIC_F64: f64 = 4e-15;

/// Fourier coefficients from up to 256 samples, relative to the curve's magnitude.
pub(crate) const COEFFICIENT: f64 = 1e-14;

/// Curves of a machine from harmonics requested to 1e-10 of the peak torque, as shares of it.
pub(crate) const HARMONIC_CURVE: f64 = 1e-10;

/// Least observed error over its bound, which adds up amplitudes.
pub(crate) const HARMONIC_BOUND_SLACK: f64 = 0.05;

/// RK4 with 4096 steps per turn on a J that varies by a factor of five; the phase is rounded to 2⁻³² turn.
pub(crate) const HARMONIC_ENERGY: f64 = 1e-8;

/// Harmonics of the example press for 1e-3 to 1e-9 of its peak torque: the figures of `docs/harmonics.md`.
pub(crate) const PRESS_HARMONICS: [u32; 7] = [5, 6, 8, 9, 10, 11, 12];

/// Remaining error next to a jump in one table, as a share of the jump: at least half of it on one side, and an interpolating spline overshoots by
/// less than half.
pub(crate) const JUMP_LEFT: [f64; 2] = [0.5, 1.5];

/// Torques of pieces in f32 if the requested error is far larger: the roundings of a tick, relative to the largest torque.
pub(crate) const PIECES_F32: f64 = 3e-6;

/// Acceleration recovered from its own torque in f32, relative.
pub(crate) const PIECES_BACK: f64 = 3e-6;

/// A position in a piece read from a straight line in f64, in units of 2⁻³²: 2⁻⁵³ times a few.
pub(crate) const RULER: f64 = 1e-4;

/// Torques of pieces in Q31 against f64: stored words as in [`Q31_READ`], times α and ω of magnitude one, and the floors of [`Q31_TORQUE_UNITS`].
pub(crate) const PIECES_Q31: f64 = Q31_READ[0] * 2.0 + Q31_READ[1] + 10.0 * Q31_UNIT;

/// Curves of 16-bit rows at 300 cells against a machine of magnitude one, in units of 2⁻¹⁵: J, V, load, b, c (whose kinks are next to the knots of a
/// stroke), and J times 1/J.
pub(crate) const ROWS16_CURVES: [f64; 6] = [1.0, 1.7, 1.3, 1.3, 1.3, 15.0];

/// The largest step of a 16-bit curve at a knot, in units of 2⁻¹⁵: the roundings of both sides.
pub(crate) const ROWS16_STEP: f64 = 3.0;

/// `Model::torque` over 16-bit rows promises this against the curves of its table, in units of 2⁻¹⁵.
pub(crate) const ROWS16_TORQUE: f64 = 0.75;

/// Forward after inverse, in units of 2⁻¹⁵ of the torque: one rounding of the torque and one of the resisting torque, half a unit each, and the unit
/// that the floor of the quotient may lose where J is 1.
pub(crate) const ROWS16_BACK: f64 = 1.5;

/// The same with J and V only: two floors instead of the latter.
pub(crate) const ROWS16_BARE_BACK: f64 = 3.0;

/// Cells of the example press with its load for shares of the peak torque: the figures of `docs/table-image.md`.
pub(crate) const ROWS16_PRESS_CELLS: [(f64, u32); 4] =
    [(3e-3, 60), (1e-3, 107), (3e-4, 230), (1.5e-4, 587)];

/// The smallest share of the peak torque that 16 bits reach for the example press with its load [1.31e-4 found].
pub(crate) const ROWS16_FLOOR: [f64; 2] = [1.2e-4, 1.4e-4];

/// Largest error of Quadratic pieces over the stated one, which is also found at the knots: as `DENSE_GRID`.
pub(crate) const PIECES_QUADRATIC: f64 = 1.001;

/// The duty meter in f32 against f64, over 10⁶ ticks of the same readings, relative: a sum is correct to two roundings, terms and figures add three
/// or four, each half of 1.2e-7, and not all of one sign.
pub(crate) const METER_F32: f64 = 2e-7;

/// Rectangle rule with 10⁴ ticks per period for a curve with two bends: h²·|jump of the slope|/24 per bend, relative.
pub(crate) const METER_RECTANGLE: f64 = 3e-7;

/// The cube root in f32 promises three units in the last place: the last step has six roundings.
pub(crate) const CUBE_ROOT_ULP: f64 = 3.0;

/// The same machine in another frame and other units, relative to the largest force or torque [1e-13].
pub(crate) const SIMILAR: f64 = 1e-11;

/// Error of a tick's arithmetic, as a script of `tests/proofs` proves it: the torque, and in Q31 the addition for each whole slope per cell in the
/// velocity torque at full speed.
pub(crate) struct Proven {
    pub(crate) torque: [f64; 2],
    pub(crate) slope: [f64; 2],
    /// Smallest share of either end that the search reaches. The roundings are never all at their worst.
    pub(crate) reached: f64,
    /// Rounding of the exact value in f64.
    pub(crate) exact: f64,
}

/// `Spline<Q31>`, in units of 2⁻³¹ of the torque base [−23 to 19 found, and −27 with three slopes per cell].
pub(crate) const Q31_SPLINE: Proven = Proven {
    torque: [-24.0, 23.0],
    slope: [-3.5, 0.0],
    reached: 0.6,
    exact: Q31_EXACT_UNITS,
};

/// `Cubic<Q31>`.
pub(crate) const Q31_CUBIC: Proven = Proven {
    torque: [-24.0, 23.0],
    slope: [-7.0, 3.0],
    reached: 0.5,
    exact: Q31_EXACT_UNITS,
};

/// `Quadratic<Q31>`.
pub(crate) const Q31_QUADRATIC: Proven = Proven {
    torque: [-22.0, 20.0],
    slope: [-4.0, 0.0],
    reached: 0.6,
    exact: Q31_EXACT_UNITS,
};

/// `Rows16`, in units of 2⁻¹⁵ of the torque base.
pub(crate) const Q15_ROWS: Proven = Proven {
    torque: [-5.75, 3.75],
    slope: [0.0, 0.0],
    reached: 0.6,
    exact: 1e-9,
};

/// `Cubic<f32>`, in units of 2⁻²⁴, for coefficients and arguments up to 1. The proof adds up the worst of 31 roundings, of the largest numbers that
/// each may have.
pub(crate) const F32_ROWS: Proven = Proven {
    torque: [-114.5, 114.5],
    slope: [0.0, 0.0],
    reached: 0.1,
    exact: 1e-6,
};

/// `Spline<f32>`, for control points up to ⅛: 68 roundings.
pub(crate) const F32_SPLINE: Proven = Proven {
    torque: [-191.5, 191.5],
    slope: [0.0, 0.0],
    reached: 0.05,
    exact: 1e-6,
};
/// RMS of 200,000 samples of filtered noise, as a share.
pub(crate) const NOISE: f64 = 0.03;

/// Motion in fixed steps of a few ten-thousandths of the time scale, order 2: relative, or in rad near one [3e-9].
pub(crate) const FREE_MOTION: f64 = 1e-7;

/// Lag of the same motion over the time, in turns per turn, between a thousand turns and a hundred times as many: depends on the position in the turn
/// where the first thousand ended [1.3e-6].
pub(crate) const FREE_MOTION_LAG: f64 = 3e-6;

/// The load of an observer for J = 1 kg·m² (N·m): phases floored to a unit of 2⁻³² of a turn, over T² = 1e-6 s² times (1 − θ)³ ≤ 0.08; the single
/// precision of gains, factors and of a load of 5.
pub(crate) const OBSERVED: f64 = 2e-4;

/// The same in Q15, as a share of the torque base: rounding of a unit of 2⁻¹⁵ in each of torque, acceleration and load, and in every period's sum.
pub(crate) const OBSERVED_Q15: f64 = 4.0 / 32_768.0;

/// An observed load where there is none, while J varies as 3 : 1 (N·m): the error of the prediction in the middle of a period, of third order [4.4e-4].
pub(crate) const OBSERVED_BIAS: f64 = 1e-3;
