//! The tick against its formulas in wide integers, which cannot wrap: random rows, not only those of machines.

use jred::table::RowConstants;
use jred::{CurveSet, Domain, Phase, curves};
use proptest::prelude::*;

use super::{CONSTANT, Short, q15, row_words};
use crate::support::{config, scale_of};

const ALL: CurveSet = curves::ALL;
const FULL: CurveSet = super::EVERY;

/// floor(x/2ⁿ)
fn floor(x: i128, n: u32) -> i128 {
    x.div_euclid(1 << n)
}

/// A word as a line, in wide integers.
fn line(word: u32, u: i128) -> i128 {
    floor(i128::from(word as i32) + i128::from(word as i16) * u, 16)
}

/// Torque and resisting torque, Q31 before the last floor, of the first cell.
fn sums<const SET: CurveSet>(
    words: &[u32],
    constants: RowConstants,
    u: i128,
    [omega, alpha]: [i128; 2],
) -> [i128; 2] {
    let has = |of: CurveSet| SET & of != 0;
    let mut row = words.iter().copied();
    let mut next = || row.next().unwrap();
    let load = if has(curves::LOAD) { next() } else { 0 };
    let [j, v, start] = [next(), next(), next()];
    let mut b = 1i128 << 13;
    if has(curves::VISCOUS) {
        b += line(next(), u) << 15;
    }
    if has(curves::CONSTANT_VISCOUS) {
        b += i128::from(constants.viscous);
    }
    let mut c = 0;
    if has(curves::COULOMB) {
        c += line(next(), u).abs() << 16;
    }
    if has(curves::CONSTANT_COULOMB) {
        c += i128::from(constants.coulomb);
    }
    let minus_load = if has(curves::LOAD) {
        line(load, u) * u + (i128::from(start as i16) << 16)
    } else {
        1 << 15
    };
    let resisting = floor(line(v, u) * omega + b, 14) * omega + minus_load + c * omega.signum();
    let inertia = floor(line(j, u) * u + i128::from(start), 16);
    assert!(inertia > 0);
    [resisting + inertia * alpha, resisting]
}

/// (torque − resisting)/J of the same cell before limiting; and whether it must be limited.
fn quotient<const SET: CurveSet>(words: &[u32], shift: u32, u: i128, net: i128) -> i128 {
    if SET & curves::RECIPROCAL != 0 {
        return floor(line(words[row_words(SET) - 1], u) * net, shift);
    }
    let load = usize::from(SET & curves::LOAD != 0);
    let inertia = floor(line(words[load], u) * u + i128::from(words[load + 2]), 16);
    (net << 16) / inertia
}

fn check<const SET: CurveSet>(random: &Random) -> bool {
    let mut words: Vec<u32> = random.words[..row_words(SET)].to_vec();
    // V must match J, otherwise no model is built: per unit, a slope per cell counts eight times.
    let scale = scale_of(1.0, 1.0, 1.0);
    let load = usize::from(SET & curves::LOAD != 0);
    let slope = f64::from(words[load] as i32 >> 16) / 65_536.0;
    let bend = f64::from(words[load] as i16) / 65_536.0;
    let half = |x: f64| ((x * 8.0 * 32_768.0).round() as i64).clamp(-32_768, 32_767) as i16 as u16;
    words[load + 1] = u32::from(half(slope)) << 16 | u32::from(half(2.0 * bend));
    let start = f64::from(words[load + 2] >> 16) / 65_536.0;
    let shift = 10;
    if SET & curves::RECIPROCAL != 0 {
        let ends = [1.0 / start, 1.0 / (start + slope + bend)].map(|r| r * 1024.0);
        let [r0, rise] = [ends[0], ends[1] - ends[0]].map(|r| (r as i64) as u16);
        words[row_words(SET) - 1] = u32::from(r0) << 16 | u32::from(rise);
    }
    let constants = RowConstants {
        viscous: random.constants[0],
        coulomb: random.constants[1],
        shift,
    };
    let rows = words.repeat(4);
    let mut rows = Short::plain(rows, SET, 4, Domain::stroke(0.0, 0.25).unwrap());
    rows.constants = constants;
    // ½·4/span = 8
    let Ok(model) = rows.try_model::<SET>(&scale) else {
        return false;
    };
    let phase = Phase::from_bits(u32::from(random.u) << 14);
    let u = i128::from(random.u);
    for omega in random.numbers() {
        for alpha in random.numbers() {
            let at = [omega, alpha].map(i128::from);
            let [sum, resisting] = sums::<SET>(&words, constants, u, at);
            assert!(i32::try_from(sum).is_ok(), "{sum} does not fit");
            let torque = model.torque(phase, q15(omega), q15(alpha));
            assert_eq!(i128::from(torque.to_bits()), floor(sum, 16));
            // The same number as a torque.
            let net = i128::from(alpha) - floor(resisting, 16);
            let bare = SET & !curves::RECIPROCAL == curves::INERTIA;
            let omega_wide = i128::from(omega);
            let net = if bare {
                let v = line(words[load + 1], u);
                i128::from(alpha) - floor(floor(v * omega_wide, 15) * omega_wide, 15)
            } else {
                net
            };
            let exact = quotient::<SET>(&words, shift, u, net);
            let back = model.acceleration(phase, q15(omega), q15(alpha));
            let limited = exact.clamp(-32_768, 32_767);
            if back.value == q15(i16::MIN) && SET & curves::RECIPROCAL == 0 {
                // Division gives −1 as saturated, too.
                assert!(back.saturated && exact <= -32_768);
            } else {
                assert_eq!(
                    (i128::from(back.value.to_bits()), back.saturated),
                    (limited, exact != limited)
                );
            }
        }
    }
    true
}

/// Numbers for one cell.
#[derive(Clone, Debug)]
struct Random {
    words: [u32; 7],
    constants: [i32; 2],
    u: u16,
    numbers: [i16; 2],
}

impl Random {
    /// Includes the ends of the range.
    fn numbers(&self) -> [i16; 7] {
        let [a, b] = self.numbers;
        [i16::MIN, i16::MAX, 0, 1, -1, a, b]
    }
}

prop_compose! {
    /// Halves small enough that many tables are valid, some close to the limit.
    fn random()(
        starts in prop::array::uniform7(-9000i32..9000),
        rises in prop::array::uniform7(-4000i32..4000),
        start in 8000u32..40_000,
        viscous in -1i32 << 27..1 << 27,
        coulomb in -1i32 << 28..1 << 28,
        u: u16,
        numbers: [i16; 2],
        shrink in 0u32..3,
        load: bool,
    ) -> Random {
        let mut words = [0; 7];
        for (word, (start, rise)) in words.iter_mut().zip(starts.iter().zip(rises)) {
            *word = ((*start >> shrink) as u32) << 16 | (rise >> shrink) as u32 & 0xffff;
        }
        // The start of J is at another position with a load than without.
        words[if load { 3 } else { 2 }] = start << 16 | (starts[0] >> shrink) as u32 & 0xffff;
        Random { words, constants: [viscous, coulomb], u, numbers }
    }
}

proptest! {
    #![proptest_config(config(3000, 0x5140))]

    #[test]
    fn no_bit_differs(random in random()) {
        // Half of the cases are for sets with a load, and give no table for the others.
        check::<{ curves::INERTIA }>(&random);
        check::<{ curves::LOAD }>(&random);
        check::<{ ALL }>(&random);
        check::<{ FULL }>(&random);
        check::<{ CONSTANT }>(&random);
        check::<{ curves::LOAD | curves::RECIPROCAL }>(&random);
        check::<{ curves::RECIPROCAL }>(&random);
        check::<{ curves::CONSTANT_COULOMB }>(&random);
        check::<{ curves::VISCOUS | curves::COULOMB }>(&random);
    }
}

/// The comparison above is not vacuous.
#[test]
fn many_random_rows_are_tables() {
    let cases = crate::support::samples(3000, 0x5141, &random());
    let count = |check: fn(&Random) -> bool| cases.iter().filter(|case| check(case)).count();
    for (set, found) in [
        count(check::<{ curves::INERTIA }>),
        count(check::<{ curves::LOAD }>),
        count(check::<{ ALL }>),
        count(check::<{ FULL }>),
        count(check::<{ CONSTANT }>),
        count(check::<{ curves::LOAD | curves::RECIPROCAL }>),
        count(check::<{ curves::RECIPROCAL }>),
        count(check::<{ curves::CONSTANT_COULOMB }>),
        count(check::<{ curves::VISCOUS | curves::COULOMB }>),
    ]
    .into_iter()
    .enumerate()
    {
        println!("{set} {found}");
        assert!(found > 30, "{set}: {found}");
    }
}
