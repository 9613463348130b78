//! Writes a plan: on a host, or in firmware with double precision.

use super::image::{HEADER_WORDS, MAGIC, MOST_ROWS, STROKE, TURN, VERSION, check_rows, fits};
use super::row::{ROW_WORDS, Row, TIME_BITS, Units, Window, Words};
use super::{Errors, PlanError};
use crate::Domain;
use crate::math;
use crate::tick::{ImageError, seal};

/// The motion at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Knot {
    /// Time (s).
    pub t: f64,
    /// Position (rad, or m), counted over turns.
    pub position: f64,
    /// Speed (rad/s, or m/s).
    pub omega: f64,
    /// Acceleration before and after the instant (rad/s², or m/s²).
    pub alpha: [f64; 2],
}

/// Words of the image of a plan with `knots` knots.
#[must_use]
pub const fn image_len(knots: usize) -> usize {
    HEADER_WORDS + knots * ROW_WORDS + 1
}

/// Writes into the image of a plan the shortest ramp of the rate (s) with which its drive has the torque: 0 if unknown, infinite if there is no such
/// ramp.
///
/// # Errors
/// Not an image of a plan; a ramp that is negative or NaN.
pub fn with_ramp(image: &mut [u32], ramp: f32) -> Result<(), PlanError> {
    if image.len() < image_len(2) || image.first() != Some(&MAGIC) {
        return Err(PlanError::NotAPlan(
            image.first().copied().unwrap_or_default(),
        ));
    }
    if !(0.0..=f32::INFINITY).contains(&ramp) {
        return Err(PlanError::Image(ImageError::Header(RAMP as u8)));
    }
    if let Some(word) = image.get_mut(RAMP) {
        *word = ramp.to_bits();
    }
    seal(image);
    Ok(())
}

/// Word of the ramp.
const RAMP: usize = 13;

/// 2³²
const RANGE: f64 = 4_294_967_296.0;

/// Limit of a plan's length (s), so that 2⁻⁴⁰ s count it in 64 bits.
const LONGEST: f64 = 8_388_608.0;

/// Smallest exponent of a unit.
const LEAST: i32 = -64;

/// Halvings in the search for a sign change of the acceleration; the speed is flat there.
const HALVINGS: u32 = 40;

/// The polynomial between two knots over u = t/H: its speed (2⁻³² of the range per second), and its coefficients of u² to u⁵ over H², in 2⁻³² of the
/// range per second squared.
#[derive(Clone, Copy, Default)]
struct Segment {
    speed: f64,
    coefficients: [f64; 4],
}

/// A knot in counts: positions in units of 2⁻³² of the range, times in units of the plan.
#[derive(Clone, Copy)]
struct Count {
    start: u32,
    position: i64,
    omega: f64,
    alpha: [f64; 2],
}

/// Writes and returns the plan through these knots, which are in the order of their times, the first at t = 0. `machine` is the identifier of the
/// machine, or 0; `errors` are the plan's errors, written into its header.
///
/// # Errors
/// Knots that are not finite, out of order or out of the stroke, or more than 65,535 of them; a polynomial between two knots that leaves the stroke;
/// a buffer shorter than [`image_len`].
pub fn encode<'b>(
    knots: &[Knot],
    domain: Domain,
    machine: u32,
    errors: Errors,
    buffer: &'b mut [u32],
) -> Result<&'b [u32], PlanError> {
    let needed = image_len(knots.len());
    let given = buffer.len();
    let short = ImageError::BufferTooShort { needed, given };
    let image = buffer.get_mut(..needed).ok_or(short)?;
    let last = knots.last().map_or(0.0, |knot| knot.t);
    let lasts = last > 0.0 && last < LONGEST;
    if !lasts || !(2..=MOST_ROWS).contains(&knots.len()) {
        return Err(PlanError::Order(0));
    }
    // The last time must have 31 bits.
    let time = (30 - exponent(last)).clamp(0, TIME_BITS.cast_signed());
    let mut units = Units {
        time: time.cast_unsigned(),
        speed: LEAST,
        acceleration: LEAST,
    };
    let mut most = [0.0_f64; 2];
    for (k, pair) in pairs(knots, domain, units) {
        let [from, to] = pair?;
        let (length, window) = window(k, [from, to], units)?;
        let segment = segment([from, to], length, window, from.omega, 0.5 * from.alpha[1]);
        for (most, row) in most.iter_mut().zip(segment.most(length / window, window)) {
            *most = most.max(row);
        }
        let [gained, _] = segment.sums();
        let faster = math::abs(from.omega) + window * gained;
        let faster = exponent(faster.max(math::abs(to.omega)));
        units.speed = units.speed.max(faster - 29);
    }
    // The other coefficients take the rounding of the speed: in a long row at constant speed they have nothing else.
    for (k, pair) in pairs(knots, domain, units) {
        let (_, exact) = from_rounded(k, pair?, units)?;
        let [_, raised] = exact.sums();
        units.acceleration = units.acceleration.max(exponent(raised) - 29);
    }
    let (header, rest) = image.split_at_mut(HEADER_WORDS.min(needed));
    let rows: &mut [Words] = match rest.split_last_mut() {
        Some((_, rows)) => bytemuck::cast_slice_mut(rows),
        None => return Err(short.into()),
    };
    for ((k, pair), row) in pairs(knots, domain, units).zip(rows.iter_mut()) {
        let [from, to] = pair?;
        *row = quantised(k, [from, to], units)?.words();
    }
    if let (Some(row), Some(knot)) = (rows.last_mut(), knots.last()) {
        let k = knots.len() as u32 - 1;
        let end = count(k, knot, domain, units)?;
        *row = Row {
            start: end.start,
            position: end.position,
            speed: rounded(k, end.omega / power_of_two(units.speed))?,
            finer: 0,
            coefficients: [0; 4],
        }
        .words();
    }
    check_rows(rows, units, domain.to())?;
    let (range, from, to) = match domain.to::<f32>() {
        Domain::Turn => (TURN, 0.0, 0.0),
        Domain::Stroke { from, to } => (STROKE, from, to),
    };
    let [speed, acceleration] = most.map(|most| (most * domain.span() / RANGE) as f32);
    let words: [u32; HEADER_WORDS] = [
        MAGIC,
        u32::from(VERSION) | (HEADER_WORDS as u32) << 16,
        needed as u32,
        u32::from_le_bytes([
            range,
            units.time as u8,
            (units.speed as i8).cast_unsigned(),
            (units.acceleration as i8).cast_unsigned(),
        ]),
        knots.len() as u32,
        f32::to_bits(from),
        f32::to_bits(to),
        machine,
        speed.to_bits(),
        acceleration.to_bits(),
        errors.position.to_bits(),
        errors.speed.to_bits(),
        errors.acceleration.to_bits(),
        0,
        0,
        0,
    ];
    for (slot, word) in header.iter_mut().zip(words) {
        *slot = word;
    }
    seal(image);
    Ok(image)
}

/// Pairs of consecutive knots, with the index of the first.
fn pairs(
    knots: &[Knot],
    domain: Domain,
    units: Units,
) -> impl Iterator<Item = (u32, Result<[Count; 2], PlanError>)> + '_ {
    let next = knots.iter().skip(1);
    (0..).zip(knots).zip(next).map(move |((k, from), to)| {
        let both = count(k, from, domain, units)
            .and_then(|from| Ok([from, count(k + 1, to, domain, units)?]));
        (k, both)
    })
}

fn count(k: u32, knot: &Knot, domain: Domain, units: Units) -> Result<Count, PlanError> {
    let per_range = RANGE / domain.span();
    let from = match domain {
        Domain::Turn => 0.0,
        Domain::Stroke { from, .. } => from,
    };
    let position = math::rint((knot.position - from) * per_range);
    let Knot {
        t, omega, alpha, ..
    } = *knot;
    let [before, after] = alpha;
    let finite = [t, position, omega, before, after]
        .iter()
        .all(|x| x.is_finite());
    let limit = match domain {
        Domain::Turn => (-8_388_608.0 * RANGE..8_388_608.0 * RANGE).contains(&position),
        // A last digit beyond an end is within it.
        Domain::Stroke { .. } => (-1.0..=RANGE + 1.0).contains(&position),
    };
    let start = math::rint(t * power_of_two(units.time.cast_signed()));
    if !finite || !limit || !(0.0..=RANGE).contains(&start) {
        return Err(PlanError::Number(k));
    }
    if (k == 0) != (start == 0.0) {
        return Err(PlanError::Order(k));
    }
    let position = match domain {
        Domain::Turn => position,
        Domain::Stroke { .. } => position.clamp(0.0, RANGE),
    };
    Ok(Count {
        start: start as u32,
        position: position as i64,
        omega: omega * per_range,
        alpha: alpha.map(|alpha| alpha * per_range),
    })
}

/// Lengths of the row and of its window (s).
fn window(k: u32, [from, to]: [Count; 2], units: Units) -> Result<(f64, f64), PlanError> {
    let length = to
        .start
        .checked_sub(from.start)
        .filter(|length| *length > 0)
        .ok_or(PlanError::Order(k + 1))?;
    let window = Window::of(length, units);
    let seconds = f64::from(length) * power_of_two(-units.time.cast_signed());
    Ok((seconds, power_of_two(window.exponent)))
}

/// The polynomial between two knots that starts with this speed and half acceleration.
fn segment([from, to]: [Count; 2], length: f64, window: f64, speed: f64, half: f64) -> Segment {
    let way = (to.position - from.position) as f64 - length * (speed + length * half);
    let gained = length * (to.omega - speed - 2.0 * length * half);
    let raised = length * length * (to.alpha[0] - 2.0 * half);
    let third = 10.0 * way - 4.0 * gained + 0.5 * raised;
    let fourth = -15.0 * way + 7.0 * gained - raised;
    let fifth = 6.0 * way - 3.0 * gained + 0.5 * raised;
    let stretch = window / length;
    let cube = stretch * stretch * stretch / (window * window);
    Segment {
        speed,
        coefficients: [
            half,
            third * cube,
            fourth * cube * stretch,
            fifth * cube * stretch * stretch,
        ],
    }
}

impl Segment {
    /// Upper bounds of the sums of the speed, over the window, and of the acceleration, including partial sums.
    fn sums(&self) -> [f64; 2] {
        let [a, b, c, d] = self.coefficients.map(math::abs);
        [
            2.0 * a + 3.0 * b + 4.0 * c + 5.0 * d,
            2.0 * a + 6.0 * b + 12.0 * c + 20.0 * d,
        ]
    }

    /// The greatest magnitudes of speed and acceleration up to this share of the window (s).
    ///
    /// The acceleration is greatest at an end or where its derivative 6·(b + 4c·u + 10d·u²) is 0. Between those places it is monotonic, and the speed
    /// is greatest at its zero, or at an end.
    fn most(&self, end: f64, window: f64) -> [f64; 2] {
        let [_, b, c, d] = self.coefficients;
        let root = math::sqrt((4.0 * c * c - 10.0 * b * d).max(0.0));
        // Without cancellation; a missing root becomes an end.
        let sum = -2.0 * c - if c < 0.0 { -root } else { root };
        let [one, other] = [sum / (10.0 * d), b / sum].map(|u| u.max(0.0).min(end));
        let places = [0.0, one.min(other), one.max(other), end];
        let mut most = [0.0_f64; 2];
        let mut look = |u: f64| {
            for (most, rate) in most.iter_mut().zip(self.rates_at(u, window)) {
                *most = most.max(math::abs(rate));
            }
        };
        places.into_iter().for_each(&mut look);
        for (from, to) in places.into_iter().zip(places.into_iter().skip(1)) {
            let rising = |u: f64| {
                let [_, acceleration] = self.rates_at(u, window);
                acceleration > 0.0
            };
            let (mut from, mut to, rises) = (from, to, rising(from));
            if rises == rising(to) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (from + to);
                if rising(middle) == rises {
                    from = middle;
                } else {
                    to = middle;
                }
            }
            look(from);
        }
        most
    }

    /// Speed and acceleration at a share of the window (s).
    fn rates_at(&self, u: f64, window: f64) -> [f64; 2] {
        let [a, b, c, d] = self.coefficients;
        [
            self.speed + window * u * (2.0 * a + u * (3.0 * b + u * (4.0 * c + u * 5.0 * d))),
            2.0 * a + u * (6.0 * b + u * (12.0 * c + u * 20.0 * d)),
        ]
    }
}

/// The speed of a row as an integer, and the polynomial that starts with it.
fn from_rounded(k: u32, pair: [Count; 2], units: Units) -> Result<(i32, Segment), PlanError> {
    let [from, _] = pair;
    let (length, window) = window(k, pair, units)?;
    let of_speed = power_of_two(units.speed);
    let speed = rounded(k, from.omega / of_speed)?;
    let begins = f64::from(speed) * of_speed;
    Ok((
        speed,
        segment(pair, length, window, begins, 0.5 * from.alpha[1]),
    ))
}

/// A row in integers: each rounding is compensated by the coefficients after it.
fn quantised(k: u32, pair: [Count; 2], units: Units) -> Result<Row, PlanError> {
    let [from, _] = pair;
    let (length, window) = window(k, pair, units)?;
    let (speed, exact) = from_rounded(k, pair, units)?;
    // As fine as its greatest sum allows.
    let [_, raised] = exact.sums();
    let finer = (29 + units.acceleration - exponent(raised)).clamp(0, 31);
    let unit = power_of_two(units.acceleration - finer);
    let half = rounded(k, 0.5 * from.alpha[1] / unit)?;
    let rest = segment(pair, length, window, exact.speed, f64::from(half) * unit);
    let mut coefficients = [half; 4];
    for (slot, exact) in coefficients.iter_mut().zip(rest.coefficients).skip(1) {
        *slot = rounded(k, exact / unit)?;
    }
    let row = Row {
        start: from.start,
        position: from.position,
        speed,
        finer: finer.cast_unsigned(),
        coefficients,
    };
    let exponent = math::rint(math::log2(window)) as i32;
    if fits(&row, Window { exponent }.shifts(&row, units)) {
        Ok(row)
    } else {
        Err(PlanError::Number(k))
    }
}

fn rounded(k: u32, x: f64) -> Result<i32, PlanError> {
    let nearest = math::rint(x);
    if math::abs(nearest) < 2_147_483_647.0 {
        Ok(nearest as i32)
    } else {
        Err(PlanError::Number(k))
    }
}

/// ⌊log₂ x⌋ of a normal number; for 0 less than any other.
fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) as i32 & 0x7ff) - 1023
}

/// 2ⁿ, −1022 ≤ n ≤ 1023
fn power_of_two(n: i32) -> f64 {
    f64::from_bits(((n + 1023) as u64 & 0x7ff) << 52)
}
