//! The image of a plan: its header, and the checks before use.

use super::inside::stays_inside;
use super::row::{Row, TIME_BITS, Units, Window, Words};
use super::{Errors, PlanError};
use crate::Domain;
use crate::tick::{Beginning, ImageError, Progress, covered};

/// Version of the layout.
pub const VERSION: u16 = 1;
/// Words of the header.
pub const HEADER_WORDS: usize = 16;
/// "JRPL" in the file's first four bytes.
pub(super) const MAGIC: u32 = u32::from_le_bytes(*b"JRPL");
/// Range codes, as in a table image.
pub(super) const TURN: u8 = 0;
pub(super) const STROKE: u8 = 1;
/// Most rows: 2 MB.
pub(super) const MOST_ROWS: usize = 65_535;
/// Exponents of units.
const EXPONENTS: core::ops::RangeInclusive<i32> = -64..=64;

pub(super) const PLAN: Beginning = Beginning {
    magic: MAGIC,
    version: VERSION,
    header: HEADER_WORDS,
};

/// The header, decoded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) domain: Domain<f32>,
    pub(super) units: Units,
    pub(super) machine: u32,
    /// Greatest speed and acceleration (SI).
    pub(super) most: [f32; 2],
    pub(super) errors: Errors,
    /// The shortest ramp of the rate (s).
    pub(super) ramp: f32,
    /// Time of the end.
    pub(super) last: u32,
    /// The first step of a bisection of the rows.
    pub(super) half: usize,
}

/// Header and rows of an image, checked.
pub(super) fn checked(words: &[u32]) -> Result<(Header, &[Words]), PlanError> {
    let inside = covered(words, &PLAN).map_err(|error| match error {
        ImageError::NotAnImage(word) => PlanError::NotAPlan(word),
        other => PlanError::Image(other),
    })?;
    let computed = Progress::START.all(inside);
    let stored = words.last().copied().unwrap_or_default();
    if computed != stored {
        return Err(ImageError::Crc { stored, computed }.into());
    }
    let Some((header, rows)) = inside.split_first_chunk::<HEADER_WORDS>() else {
        return Err(PlanError::NotAPlan(0));
    };
    let refused = |word| PlanError::Image(ImageError::Header(word));
    let &[
        _,
        version,
        _,
        kinds,
        count,
        from,
        to,
        machine,
        speed,
        acceleration,
        in_position,
        in_speed,
        in_acceleration,
        ramp,
        reserved @ ..,
    ] = header;
    if (version >> 16) as usize != HEADER_WORDS {
        return Err(refused(1));
    }
    let [range, time, of_speed, of_acceleration] = kinds.to_le_bytes();
    let units = Units {
        time: time.into(),
        speed: of_speed.cast_signed().into(),
        acceleration: of_acceleration.cast_signed().into(),
    };
    let (from, to) = (f32::from_bits(from), f32::from_bits(to));
    let domain = match range {
        TURN => Domain::Turn,
        STROKE if to > from && (to - from).is_finite() => Domain::Stroke { from, to },
        STROKE => return Err(refused(5)),
        _ => return Err(refused(3)),
    };
    let known = EXPONENTS.contains(&units.speed) && EXPONENTS.contains(&units.acceleration);
    if units.time > TIME_BITS || !known {
        return Err(refused(3));
    }
    let figures = [speed, acceleration, in_position, in_speed, in_acceleration].map(f32::from_bits);
    if !figures.iter().all(|x| x.is_finite() && *x >= 0.0) {
        return Err(refused(8));
    }
    let ramp = f32::from_bits(ramp);
    if !(0.0..=f32::INFINITY).contains(&ramp) {
        return Err(refused(13));
    }
    if reserved != [0; 2] {
        return Err(refused(14));
    }
    let rows: &[Words] = bytemuck::try_cast_slice(rows).map_err(|_| refused(4))?;
    if rows.len() != count as usize || !(2..=MOST_ROWS).contains(&rows.len()) {
        return Err(refused(4));
    }
    // Times in units of 2⁻⁴⁰ s have 64 bits.
    let latest = rows.last().map_or(0, |row| Row::read(row).start);
    if latest.leading_zeros() + 32 < TIME_BITS - units.time {
        return Err(refused(3));
    }
    let last = check_rows(rows, units, domain)?;
    let [speed, acceleration, in_position, in_speed, in_acceleration] = figures;
    let header = Header {
        domain,
        units,
        machine,
        most: [speed, acceleration],
        errors: Errors {
            position: in_position,
            speed: in_speed,
            acceleration: in_acceleration,
        },
        ramp,
        last,
        half: rows.len().next_power_of_two() / 2,
    };
    Ok((header, rows))
}

/// Checks that every row follows the one before, fits, ends where the next begins and stays within the stroke. Returns the start of the last row.
pub(super) fn check_rows(
    rows: &[Words],
    units: Units,
    domain: Domain<f32>,
) -> Result<u32, PlanError> {
    let all = || rows.iter().map(Row::read);
    let on_stroke = matches!(domain, Domain::Stroke { .. });
    let mut last = 0;
    for ((k, row), next) in (0..).zip(all()).zip(all().skip(1).map(Some).chain([None])) {
        if k == 0 && row.start != 0 || next.is_some_and(|next| next.start <= row.start) {
            return Err(PlanError::Order(k));
        }
        let within = !on_stroke || (0..=1 << 32).contains(&row.position);
        if !within || row.finer > 31 {
            return Err(PlanError::Number(k));
        }
        last = row.start;
        let Some(next) = next else { continue };
        let length = next.start - row.start;
        let window = Window::of(length, units);
        if !fits(&row, window.shifts(&row, units)) {
            return Err(PlanError::Number(k));
        }
        let end = u64::from(next.start) << ((TIME_BITS - units.time) & 63);
        let reached = row.at(end, length, units);
        let [to_speed, to_position, moved] = window.shifts(&row, units);
        // Coefficients and speeds are rounded to their unit, and products down.
        let slack = |shift: i32| 1_u64 << shift.clamp(0, 40);
        let position = reached.position.wrapping_sub(next.position).unsigned_abs();
        let speed = reached.speed.wrapping_sub(next.speed).unsigned_abs();
        let most = 8 + 16 * slack(to_position) + slack(moved + 32);
        if position > most || u64::from(speed) > 8 + 16 * slack(to_speed) {
            return Err(PlanError::Gap(k));
        }
        // Half a unit of each coefficient, of the speed, and of the position.
        let rounding = 8 + 2 * slack(to_position) + slack(moved + 32);
        if on_stroke && !stays_inside(&row, length, units, rounding) {
            return Err(PlanError::Stroke(k));
        }
    }
    Ok(last)
}

/// Whether the sums of a row fit: for coefficients and speeds into 32 bits, for positions into 56.
pub(super) fn fits(row: &Row, [to_speed, to_position, moved]: [i32; 3]) -> bool {
    let sum = |factors: [u64; 4]| -> u64 {
        let each = row.coefficients.iter().zip(factors);
        each.map(|(c, factor)| u64::from(c.unsigned_abs()) * factor)
            .sum()
    };
    let most = (1 << 31) - 64;
    let gained = sum([2, 3, 4, 5]);
    let even = row.speed == 0 || moved <= -8;
    let still = gained == 0 || (to_speed <= 31 && to_position <= 24);
    even && still
        && sum([2, 6, 12, 20]) <= most
        && u64::from(row.speed.unsigned_abs())
            + super::row::shifted(gained.cast_signed(), if gained == 0 { 0 } else { to_speed })
                .unsigned_abs()
            <= most
}
