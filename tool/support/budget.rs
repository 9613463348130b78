//! All tolerances of the tool's tests with their reasons. They are bounds on |found − expected|; values measured by a test are in brackets.

/// Two closed forms of some tens of operations, relative to the column's largest [1e-15; 6e-15 for α].
pub(crate) const CLOSED_FORM: f64 = 1e-13;

/// Against differences of order 4 at steps of 2 mrad, J′ and U′, relative to the column's largest [2e-12].
pub(crate) const DIFFERENCES: f64 = 5e-11;

/// Against second differences, J″: truncation at 20 mrad [1.2e-8].
pub(crate) const SECOND_DIFFERENCES: f64 = 1e-7;

/// A torque from a momentum differentiated in steps of 0.1 ms: 2⁻⁵³·J·ω/h [2e-12].
pub(crate) const DERIVATION: f64 = 5e-11;

/// An integral by the trapezoidal rule at 1e5 steps over a function with a kink, h²·Δf′ [1.3e-10].
pub(crate) const QUADRATURE: f64 = 2e-9;

/// Integrals over the cycle against sums over 2000 steps of another kind, with an error of the square of the step at the kinks of the efficiency.
pub(crate) const DEFAULT_STEPS: f64 = 3e-6;

/// Extremes at the default of 2000 steps, from the parabola through three instants, against the largest of 200 000 samples [5.7e-8].
pub(crate) const DEFAULT_PEAK: f64 = 3e-7;

/// The torque at the point closest to the envelope, at any number of steps, against the nearest of 200 000 samples: it is not an extreme, and changes
/// by T′·h with the instant [3.6e-6].
pub(crate) const NEAREST_PEAK: f64 = 1e-5;

/// Extremes at 200 000 steps, against the largest of as many samples, which is up to T″·h²/8 lower [2.3e-8].
pub(crate) const FINE_PEAK: f64 = 1e-6;

/// All figures at 200 000 steps, against as many trapezoids [1e-12; 2e-10 for the energies].
pub(crate) const FINE_STEPS: f64 = 1e-9;

/// The holding torque is searched every 0.5°: the largest is up to (0.25°)²/2 = 1e-5 higher [3.6e-6].
pub(crate) const HOLDING_GRID: f64 = 1e-5;

/// Shares of limits at the default sampling against 8000 instants and a tolerance of 1e-12: the power of the bus is linear between the instants
/// [2.0e-6 for a brake resistor; below 1e-6 all others].
pub(crate) const OTHER_INSTANTS: f64 = 5e-6;

/// Integrals over the cycle at the default tolerance of 1e-9, at any number of instants.
pub(crate) const DUTY: f64 = 1e-9;

/// Golden motion from rest over 0.5 s at a tolerance of 1e-12, relative to the column's largest: the integrator's error grows over the 30 rad [5e-12
/// for φ, 8e-11 for α].
pub(crate) const GOLDEN_MOTION: f64 = 3e-10;

/// Energy balance as a share of the energy turned over, at tolerances of at most 1e-10.
pub(crate) const BALANCE: f64 = 1e-8;

/// Energies recomputed from an angle of some thousand degrees, which rounds to 1e-12 rad [1e-15].
pub(crate) const ANGLE_IN_DEGREES: f64 = 1e-13;

/// Work of the pressing force over several strokes, at a tolerance of 1e-10 [1.7e-8].
pub(crate) const PRESSING_WORK: f64 = 1e-7;

/// Coasting to standstill: the instant of rest is found by bisection to 1e-12 s [5e-15].
pub(crate) const STANDSTILL: f64 = 1e-12;

/// Motions with a closed form at a tolerance of 1e-10 [1.7e-8].
pub(crate) const CLOSED_MOTION: f64 = 1e-9;

/// Relative error of the work in a window of at least a thousandth of a degree: its edges are found to 4e-15 of the position.
pub(crate) const NARROW_WINDOW: f64 = 1e-5;

/// A DC motor with its winding against its damped oscillation, relative to the settled values.
pub(crate) const SIMULATED_WINDING: f64 = 1e-10;

/// Three swings of a pendulum at a tolerance of 1e-12.
pub(crate) const SWING: f64 = 1e-9;

/// A turning point read from samples 1 ms apart: α·dt²/8 with α up to 50 rad/s².
pub(crate) const TURNING_SAMPLE_DEG: f64 = 1e-3;

/// The position where friction stops a pendulum after several swings (deg) [2e-13].
pub(crate) const REST_DEG: f64 = 1e-9;

/// The press over 2 s at a tolerance of 1e-10 against 1e-13.
pub(crate) const TOLERANCE_1E10: f64 = 1e-8;

/// The same sums in another order of operations, relative to the largest term.
pub(crate) const SAME_SUMS: f64 = 1e-11;

/// A peak between two steps of a duty, which resolves it to 1e-5 relative: twice that, for the search.
pub(crate) const PEAK_BETWEEN_STEPS: f64 = 2e-5;

/// Figures over stretches of laws; the ends of a stretch are taken 1e-9 inside.
pub(crate) const SIMPSON: f64 = 1e-8;

/// Order of the RMS of a recorded motion from three recording steps [4.02, 4.00].
pub(crate) const PROFILE_ORDER: f64 = 0.1;

/// RMS torque of a cycloidal move recorded at 26 instants [2.8e-6].
pub(crate) const PROFILE_RMS: f64 = 5e-6;

/// The error that an image states was measured at some ten thousand positions and at the ends of the range of speed and acceleration. Between them a
/// tick may err by this share more.
pub(crate) const BETWEEN_PLACES: f64 = 1e-3;

/// Stated error of an exact table, from roundings only (N·m, or N).
pub(crate) const NO_ERROR: f64 = 1e-9;

/// An image read in double precision by its documentation, against its own arithmetic, relative to the curve's largest value: single precision rounds
/// sums of a few terms of that size [1.3e-7].
pub(crate) const DOCUMENT_F32: f64 = 5e-7;
/// The same for 32-bit fixed point, relative to the base: some units of 2⁻²⁹ [3.1e-9].
pub(crate) const DOCUMENT_I32: f64 = 1e-8;
/// The same if the position in a cell has 16 bits [5.4e-7].
pub(crate) const DOCUMENT_SHORT_PLACE: f64 = 2e-6;
/// The same for rows of 16 bits, in integers: exact.
pub(crate) const DOCUMENT_I16: f64 = 1e-12;

/// The product of the 1/J curve with J, against its nominal value: the units of 16 bits [2.8e-4; 1.6e-5 for 16-bit splines].
pub(crate) const RECIPROCAL_SEED: f64 = 1e-3;

/// Work of a blow over 0.1° from its mean slope: (0.05°)² of the slope's curvature, and the quadrature on its ramps.
pub(crate) const BLOW: f64 = 1e-5;

/// A linkage solved from its joints against golden data and closed forms, relative to the largest value [3e-13].
pub(crate) const LINKAGE: f64 = 1e-11;

/// ½·J·ω² + U of a free motion at a tolerance of 1e-12, as a share of the energy turned over.
pub(crate) const CONSERVED: f64 = 1e-9;

/// The same machine from two kinds of input, tolerance 1e-10 each over 1.5 s, relative to the column's largest value.
pub(crate) const SAME_MOTION: f64 = 1e-7;

/// Ratios over time: a few roundings.
pub(crate) const RATIO: f64 = 1e-12;

/// About twenty cells of an instant against the motor torque, relative to the largest torque: the same products in another order.
pub(crate) const CELLS: f64 = 1e-12;

/// Energy stored over a closed cycle at 40 000 steps, relative to the energy turned over; the ends of a stretch are taken 1e-9 inside.
pub(crate) const CLOSED_CYCLE: f64 = 1e-8;

/// The end of a range in which a drive is suitable, found by bisection to 1e-10, against its closed form.
pub(crate) const RANGE_END: f64 = 1e-8;

/// The largest torque of a circuit from a search over its currents, relative to the peak torque: steps of 2⁻⁴⁰ of the current; at the edge of two
/// circles the search converges slowly [1e-7].
pub(crate) const GRID_SEARCH: f64 = 1e-5;
/// Deviation of a piece of an envelope from its stated curvature, relative to the peak torque: roundings.
pub(crate) const PIECE_SHAPE: f64 = 1e-12;
/// Distance of two pieces of an envelope at a joint without a jump, relative to the peak torque: the joint is found by bisection.
pub(crate) const PIECE_JOINT: f64 = 1e-9;

/// A figure of a prepared cycle against the sum or the extreme over its samples, relative to the sum of its terms at their largest: roundings of some
/// hundred terms, and 64 units of the last place that the search may miss.
pub(crate) const PREPARED_CYCLE: f64 = 1e-12;

/// A peak between samples at 302 steps of an inclined sine, by the parabola through three: (2π/302)⁴/128 of a sine's peak for a
/// vertex halfway between two samples, and less elsewhere.
pub(crate) const PEAK_BETWEEN: f64 = 1.5e-9;

/// The largest force of a motion: six parabola vertices starting from a quarter of a degree reach the rounding of a flat maximum.
pub(crate) const LARGEST_FORCE: f64 = 1e-13;

/// The same at a jump, 1e-9 of the smooth stretch before it.
pub(crate) const LARGEST_AT_JUMP: f64 = 2e-9;

/// A spline of a single cubic: a few roundings of numbers up to 20, times steps up to 1/30 by which it is divided twice.
pub(crate) const SPLINE_EXACT: f64 = 1e-11;

/// Frequency response of the smoothing spline with 100 rows per wave, against the continuous one: (ω·h)²/12 = 3e-4 at even steps, a few times that
/// for steps that vary by a factor of four.
pub(crate) const SMOOTHING: f64 = 4e-3;

/// Temperatures in closed form: exponentials and, over thousands of cycles, products of matrices.
pub(crate) const THERMAL: f64 = 1e-11;

/// Temperatures of a cycle that is short compared with the time constants, 2000 steps.
pub(crate) const MANY_STEPS: f64 = 1e-10;

/// Continuously changing losses, 2000 steps per cycle.
pub(crate) const THERMAL_STEPS: f64 = 1e-6;

/// Order of the error of these temperatures.
pub(crate) const THERMAL_ORDER: f64 = 0.2;

/// Temperatures by the Runge-Kutta method at steps of 1 ms, whose extremes are missed by half a step.
pub(crate) const RUNGE_KUTTA: f64 = 1e-8;

/// The integral of squared currents over linear pieces.
pub(crate) const OVERLOAD: f64 = 1e-12;

/// Overload of an amplifier with the default number of instants (A²s, or relative), against a finer one: 4e-9.
pub(crate) const OVERLOAD_STEPS: f64 = 1e-6;

/// A catalogue figure in its unit, converted in another order of operations: a few roundings [3e-16].
pub(crate) const UNIT_CONVERSION: f64 = 1e-14;

/// A row of a study against the same machine sized separately: the same operations on the same numbers.
pub(crate) const ROW: f64 = 1e-12;

/// A derivative from differences of at most 1 %, extrapolated: ε⁴ of the function's fifth derivative, and roundings of the shares divided by ε.
pub(crate) const SLOPE: f64 = 1e-7;

/// Room of a quantity, from 16 bisections of a step of at most 25 %: 4e-6 of the quantity, for a room of 11 %.
pub(crate) const ROOM: f64 = 5e-5;

/// The ratio of the smallest RMS torque by golden section: the square root of the rounding at a minimum.
pub(crate) const BEST_RATIO: f64 = 1e-6;

/// RMS torque from its moments and from the instants: sums of some thousand terms in another order, with cancellation.
pub(crate) const MOMENTS: f64 = 1e-10;

/// Ends of a range of ratios, in closed form and by bisection: a limit counts as satisfied up to 1e-9 beyond it.
pub(crate) const RATIO_END: f64 = 2e-9;

/// The least share of a limit over the gear ratios, in steps of 0.01 % against steps of 0.23 %.
pub(crate) const LEAST_USE: f64 = 5e-3;
/// Stall torque and torque at the no-load speed of a data sheet, relative to the stall torque: figures of three digits [2e-3].
pub(crate) const DATA_SHEET: f64 = 4e-3;
/// The same for torque and current at its nominal point [1.7e-2].
pub(crate) const DATA_SHEET_NOMINAL: f64 = 2.5e-2;

/// A natural frequency against a chain with a coupling of a millionth of the machine's inertia between two springs.
pub(crate) const COUPLING: f64 = 1e-5;

/// The DC bus in closed form.
pub(crate) const BUS: f64 = 1e-11;

/// Energies of a period of the DC bus, relative to the energy turned over.
pub(crate) const BUS_BALANCE: f64 = 1e-9;

/// The DC bus in 60 000 explicit steps.
pub(crate) const SMALL_STEPS: f64 = 1e-3;

/// Sums of linear pieces, relative to the largest power.
pub(crate) const CURVES: f64 = 1e-9;

/// A figure read from text with four digits: half a unit of the fourth.
pub(crate) const SHORT: f64 = 5e-4;

/// Worst phases against brute force on another grid: no smaller, except for the grid spacing …
pub(crate) const PHASES: f64 = 1e-6;
/// The same for three axes, searched on a coarser grid: the worst phases may differ by this much [2e-3].
pub(crate) const THREE_PHASES: f64 = 5e-3;
/// … and larger by no more than such a grid misses.
pub(crate) const COARSE_PHASES: f64 = 0.05;

/// The press exported with 360 rows and read back: J and J′ as shares of their largest values; orders h⁴ and h³.
pub(crate) const IMPORTED: [f64; 2] = [2e-9, 1e-6];

/// Acceleration from a speed log of 1 kHz with noise of 0.02 rad/s, smoothed at 20 Hz, as a share of the largest one.
pub(crate) const SMOOTHED_LOG: f64 = 0.02;

/// A housing of constant temperature, against one of 2400 s in a cycle of 0.5 s.
pub(crate) const SLOW_HOUSING: f64 = 1e-3;

/// The duty meter, sampled in the middle of each of 2000 and 20 000 ticks of a press's cycle, against sizing's instants: an extreme is up to half a
/// tick away, with an error of the square of the tick, down to the resolution of f32.
pub(crate) const METERED: [f64; 2] = [1e-3, 5e-6];

/// The duty meter, sampled in the middle of each of 20 000 ticks, against the figures next to its limits: as [`METERED`], and the error of sizing's
/// own 2000 steps [1.4e-6, the regenerated energy; 1e-6 the output's peak].
pub(crate) const METER_SIZED: f64 = 5e-6;

/// Largest distance of a curve of eight points below the limit of a motor, relative to the limit's largest torque.
pub(crate) const METER_SHORTFALL: f64 = 0.05;

/// Additional distance between the 2000 evaluated speeds.
pub(crate) const METER_BETWEEN: f64 = 1e-3;

/// Roundings of a linear system of up to 21 equations against 40 digits, as a share of the largest figure [4e-15].
pub(crate) const CROSS_CHECK: f64 = 1e-13;

/// Angles of up to 16 rad printed with 16 digits, and values derived from them at rest [1e-14].
pub(crate) const PUBLISHED: f64 = 1e-13;

/// Published speeds: with them the constraints move by 2e-9 m/s of 8 m/s [2e-10].
pub(crate) const PUBLISHED_SPEED: f64 = 1e-9;

/// Published accelerations and multipliers, the least exact parts of an index-3 solution. The source's own equations, solved with 40 digits at its
/// own angles and speeds, have residuals of 1.3e-6.
pub(crate) const PUBLISHED_ACCELERATION: f64 = 3e-6;

/// Angle and speed at the end of a motion over 2.5 turns, integrated here with 1e-12 [7e-11 and 9e-11, and no closer with 1e-13].
pub(crate) const PUBLISHED_MOTION: f64 = 1.5e-10;

/// Torque of many turns, squared and summed: with all edges found there are at least 16 instants per stretch, whose sums differ by this share where a
/// dwell takes most of the steps.
pub(crate) const LOADS_FOUND: f64 = 1e-3;

/// Rated power and power rate of a data sheet against its torque, speed and inertia, each rounded to two or three digits [3.8 % and 1.4 %].
pub(crate) const DATA_SHEET_POWER: f64 = 0.05;

/// Energy at the end of a steady turn against that at its start, as a share.
pub(crate) const STEADY_RESIDUAL: f64 = 1e-12;

/// The same with a load from a table of 1440 rows, whose third derivative jumps at each: steps may end on either side [1.6e-11].
pub(crate) const STEADY_RESIDUAL_OF_TABLES: f64 = 1e-10;

/// Energy balance of a steady turn as a share of the energy turned over.
pub(crate) const STEADY_BALANCE: f64 = 1e-10;

/// Figures of a steady cycle with a closed form; a residual of 1e-13 of the energy has more effect the less damping a turn has.
pub(crate) const STEADY: f64 = 1e-10;

/// The same with a load from a table: a spline over steps of 0.25°.
pub(crate) const STEADY_MADE: f64 = 1e-9;

/// Decay of a deviation over a turn, from a difference quotient over ±1e-3: about its square.
pub(crate) const STEADY_LEFT_OVER: f64 = 1e-6;

/// A start from rest, whose first 1e-10 of the energy follows from the acceleration at rest.
pub(crate) const STEADY_START: f64 = 1e-6;

/// A steady cycle against a simulation over the time at a tolerance of 1e-12.
pub(crate) const STEADY_SIMULATED: f64 = 1e-9;

/// The same after 20 s from rest, in which the integrator has passed the edges of a load 80 times: between tolerances of 1e-13 and 1e-12 the speed
/// changes by 6e-9 [2e-9].
pub(crate) const STEADY_FROM_REST: f64 = 1e-8;

/// δ with the flywheel found for it.
pub(crate) const STEADY_FLYWHEEL: f64 = 1e-9;

/// Relative cost of a move by the midpoint rule at 2000 instants: jumps of the slope where the power changes its direction are between two of them.
pub(crate) const MIDPOINTS: f64 = 1e-5;

/// Reduction of the cost that a search with bumps on a motion may find: the error of the midpoint rule.
pub(crate) const NO_BUMP: f64 = 1e-4;

/// Excess of the cost that the same search may leave: bumps converge slowly along a bend of the torque, where the least energy stays for long [3e-3
/// for the RMS torque, 5.2e-2 for the energy].
pub(crate) const SEARCHED: f64 = 6e-2;

/// Excess of a lower bound over the cost: roundings of sums of some thousand terms.
pub(crate) const REFUTED: f64 = 1e-9;
