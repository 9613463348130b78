use jred::Domain;
use jred::axis::{AxisError, Counter, Counting, Encoder, Mounting, StrokeEncoder, StrokeMounting};
use proptest::prelude::*;

use crate::support::config;

fn mounting() -> impl Strategy<Value = Mounting> {
    let per = prop_oneof![
        2..5000u32,
        any::<u32>().prop_map(|per| per.max(2)),
        (1..31u32).prop_map(|n| 1 << n)
    ];
    let gear = prop_oneof![
        Just([1, 1]),
        [1..200u32, 1..200],
        [any::<u32>(), any::<u32>()]
    ];
    let home = prop_oneof![Just(0), -100_000..100_000i64, any::<i64>()];
    (per, gear, any::<bool>(), home)
        .prop_map(|(counts_per_turn, gear, up, home)| Mounting {
            counts_per_turn,
            gear,
            counting: if up { Counting::Up } else { Counting::Down },
            homing_offset: home,
        })
        .prop_filter("two counts a turn", |m| {
            m.gear[0] > 0
                && m.gear[1] > 0
                && u64::from(m.counts_per_turn) * u64::from(m.gear[0]) >= 2 * u64::from(m.gear[1])
        })
}

/// The error of the phase, in fractions of 2⁻³² turn: with a denominator of at least the encoder's counts per turn.
fn check(mounting: &Mounting, count: i64, phase: u32) {
    let per = i128::from(mounting.counts_per_turn) * i128::from(mounting.gear[0]);
    let from_home = i128::from(count) - i128::from(mounting.homing_offset);
    let counts = match mounting.counting {
        Counting::Up => from_home,
        Counting::Down => -from_home,
    };
    let exact = (counts * i128::from(mounting.gear[1])).rem_euclid(per) << 32;
    let above = (i128::from(phase) * per - exact).rem_euclid(per << 32);
    let above = if above > per << 31 {
        above - (per << 32)
    } else {
        above
    };
    // A whole number of units is exact.
    let most = if exact % per == 0 { 0 } else { per - 1 };
    assert!(
        above.abs() <= most,
        "{mounting:?} at {count}: {above}/{per} of a unit"
    );
}

proptest! {
    #![proptest_config(config(2000, 0xe2c0))]

    #[test]
    fn the_phase_of_every_count_is_within_a_unit(
        mounting in mounting(),
        counts in prop::collection::vec(prop_oneof![any::<i64>(), any::<i32>().prop_map(i64::from), -100..100i64, Just(i64::MIN), Just(i64::MAX), Just(i64::from(i32::MIN))], 8),
    ) {
        let encoder = Encoder::new(mounting).unwrap();
        for count in counts {
            check(&mounting, count, encoder.phase_wide(count).to_bits());
            let narrow = count as i32;
            check(&mounting, narrow.into(), encoder.phase(narrow).to_bits());
        }
        // Home and whole turns.
        let per = i64::from(mounting.counts_per_turn) * i64::from(mounting.gear[0].min(1 << 20));
        if mounting.gear[1] == 1 && mounting.gear[0] < 1 << 20 {
            for turns in [0, 1, -3, 100] {
                let count = mounting.homing_offset.wrapping_add(turns * per);
                if mounting.homing_offset.checked_add(turns * per).is_some() {
                    prop_assert_eq!(encoder.phase_wide(count).to_bits(), 0);
                }
            }
        }
    }

    #[test]
    fn the_phase_along_a_stroke_is_within_a_unit(
        span in 1e-3..10.0f64,
        from in -10.0..10.0f64,
        counts in 16.0..1e9f64,
        down: bool,
        home in -1_000_000..1_000_000i64,
        part in -0.5..1.5,
        at in prop::collection::vec(-1.2..1.2f64, 8),
    ) {
        let to: f64 = from + span;
        let span: f64 = to - from;
        let resolution = if down { -span } else { span } / counts;
        let at_home = from + part * span;
        let domain = Domain::Stroke { from, to };
        let encoder = StrokeEncoder::new(domain, StrokeMounting { resolution, homing_offset: home, home_position: at_home }).unwrap();
        for at in at {
            let count = (at * counts) as i32;
            let counted = f64::from(count) - home as f64;
            let exact = (counted * (resolution / span) + (at_home - from) / span) * 4_294_967_296.0;
            let found = encoder.phase(count);
            let limited = exact.clamp(0.0, 4_294_967_295.0);
            // Half a unit, a quarter for a step with an error of half a unit of 2⁻⁶⁴ up to 2³¹ times from the middle, and the roundings of the
            // reference in double precision.
            let from_middle = counted - (from + 0.5 * span - at_home) / resolution;
            let most = 0.5 + 0.25 * (from_middle.abs() + 1.0) / 2_147_483_648.0 + 1e-5;
            prop_assert!((f64::from(found.value.to_bits()) - limited).abs() < most, "{count}: {exact}");
            let wide = encoder.phase_wide(count.into());
            prop_assert!((f64::from(wide.value.to_bits()) - limited).abs() < 0.5 + 1e-5, "{count}: {exact}");
            if !(-1.0..1.0).contains(&exact) && (exact - 4_294_967_296.0).abs() > 1.0 {
                prop_assert_eq!(found.saturated, !(0.0..4_294_967_296.0).contains(&exact));
            }
        }
    }

    #[test]
    fn a_counter_that_overflows_is_followed(start in any::<i64>(), moves in prop::collection::vec(any::<i16>(), 1..50)) {
        let mut counter = Counter::<16>::at(start);
        let mut wide = Counter::<32>::at(start);
        let mut count = start;
        for moved in moves {
            // At most half of the range.
            count = count.wrapping_add((moved / 2).into());
            prop_assert_eq!(counter.extend(u32::from(count as u16)), count);
            prop_assert_eq!(wide.extend(count as u32), count);
        }
    }
}

/// Among all readings between two correct ones, the number that lead to a wrong count equals the number of counts moved.
#[test]
fn a_wrong_reading_is_corrected_unless_it_is_half_the_range_off() {
    for (start, moved) in [(0, 0), (70_000, 30), (-32_760, -30), (i64::MAX, 5)] {
        let right = start.wrapping_add(moved);
        let mut wrong = 0;
        for reading in 0..1_u32 << 16 {
            let mut counter = Counter::<16>::at(start);
            counter.extend(reading);
            let off = counter.extend(right as u32 & 0xffff).wrapping_sub(right);
            assert!([0, 1 << 16, -(1 << 16)].contains(&off), "{reading}: {off}");
            wrong += u64::from(off != 0);
            let half = (reading as u16).wrapping_sub(start as u16) ^ 1 << 15;
            let from_half = half.cast_signed().unsigned_abs();
            assert!(off == 0 || u64::from(from_half) <= moved.unsigned_abs());
        }
        // Half of the range counts down, not up.
        assert!(wrong > 0 && wrong.abs_diff(moved.unsigned_abs()) <= 1);
    }
}

#[test]
fn an_encoder_that_cannot_be_is_refused() {
    let good = Mounting::direct(10_000);
    let refused = |mounting| Encoder::new(mounting).unwrap_err();
    for (mounting, what) in [
        (
            Mounting {
                counts_per_turn: 0,
                ..good
            },
            "the number of counts of a turn of the encoder",
        ),
        (
            Mounting {
                gear: [0, 1],
                ..good
            },
            "the number of turns of the encoder in its gear",
        ),
        (
            Mounting {
                gear: [1, 0],
                ..good
            },
            "the number of turns of the drive link in the encoder's gear",
        ),
    ] {
        assert_eq!(refused(mounting), AxisError::NotPositive(what, 0.0));
    }
    let coarse = refused(Mounting {
        counts_per_turn: 3,
        gear: [1, 2],
        ..good
    });
    assert_eq!(
        coarse.to_string(),
        "the number of counts of a turn of the drive link is 1.5, but must be at least 2"
    );

    let stroke = Domain::Stroke { from: 0.0, to: 0.5 };
    let good = StrokeMounting {
        resolution: 1e-6,
        homing_offset: 0,
        home_position: 0.0,
    };
    for (domain, scaled, says) in [
        (
            Domain::Stroke { from: 0.6, to: 0.1 },
            good,
            "the number of counts of the stroke is 0, but must be from 16",
        ),
        (
            Domain::Turn,
            good,
            "the number of counts of the stroke is 0, but must be from 16 to 9007199254740992",
        ),
        (
            stroke,
            StrokeMounting {
                resolution: f64::NAN,
                ..good
            },
            "the encoder's resolution is not a finite number",
        ),
        (
            stroke,
            StrokeMounting {
                resolution: 0.0,
                ..good
            },
            "the number of counts of the stroke is infinite, but must be from 16 to 9007199254740992",
        ),
        (
            stroke,
            StrokeMounting {
                resolution: 0.3,
                ..good
            },
            "the number of counts of the stroke is 1.667, but must be from 16",
        ),
        (
            stroke,
            StrokeMounting {
                home_position: f64::INFINITY,
                ..good
            },
            "the position at home is not a finite number",
        ),
        (
            stroke,
            StrokeMounting {
                home_position: 1e9,
                ..good
            },
            "the position at home, in strokes, is 2000000000, but must be from -100000 to 100000",
        ),
    ] {
        let error = StrokeEncoder::new(domain, scaled).unwrap_err().to_string();
        assert!(error.starts_with(says), "{error}");
    }
}

#[test]
fn an_end_of_the_stroke_is_in_it() {
    for counts in [1000, 3333, 65_536, 100_000_007] {
        let domain = Domain::Stroke { from: 0.1, to: 0.4 };
        let resolution = (0.4 - 0.1) / f64::from(counts);
        let encoder = StrokeEncoder::new(
            domain,
            StrokeMounting {
                resolution,
                homing_offset: -5,
                home_position: 0.1,
            },
        )
        .unwrap();
        let (first, last) = (encoder.phase(-5), encoder.phase(counts - 5));
        assert_eq!((first.value.to_bits(), first.saturated), (0, false));
        assert_eq!((last.value.to_bits(), last.saturated), (u32::MAX, false));
        assert!(encoder.phase(-6).saturated && encoder.phase(counts - 4).saturated);
        assert!(encoder.phase(i32::MIN).saturated && encoder.phase(i32::MAX).saturated);
    }
}

#[test]
fn the_extremes_keep_the_promises() {
    // The remainder of the step is half a unit of 2⁻⁶⁴, in either direction.
    for counting in [Counting::Up, Counting::Down] {
        let mounting = Mounting {
            counts_per_turn: 4_294_967_294,
            gear: [2_863_311_532, 1],
            counting,
            homing_offset: 0,
        };
        let encoder = Encoder::new(mounting).unwrap();
        for count in [1 << 40, -(1 << 40), i64::MIN, i64::MAX] {
            check(&mounting, count, encoder.phase_wide(count).to_bits());
        }
    }
    // A stroke with the fewest counts and the most distant home.
    let domain = Domain::Stroke { from: 0.0, to: 1.0 };
    for (resolution, home, at_home) in [
        (1.0 / 16.0, i64::from(i32::MIN), 1e5),
        (-1.0 / 16.0, i64::from(i32::MAX), -1e5),
    ] {
        let encoder = StrokeEncoder::new(
            domain,
            StrokeMounting {
                resolution,
                homing_offset: home,
                home_position: at_home,
            },
        )
        .unwrap();
        let far = if resolution > 0.0 { i64::MAX } else { i64::MIN };
        let [up, down] = [far, !far].map(|count| encoder.phase_wide(count));
        assert_eq!((up.value.to_bits(), up.saturated), (u32::MAX, true));
        assert_eq!((down.value.to_bits(), down.saturated), (0, true));
    }
}

/// A screw of 10 mm per turn and a stroke of whole turns: every turn is an exact fraction of the stroke. From encoders of 17 bits to some of 45,
/// whose stroke has 2⁵² counts.
#[test]
fn strokes_of_many_counts_are_within_a_unit() {
    for (bits, turns) in [
        (17, 50),
        (20, 80),
        (24, 60),
        (24, 80),
        (26, 100),
        (32, 100),
        (45, 128),
    ] {
        for (sign, home) in [(1, 0), (-1, 12_345), (1, -(1 << 40)), (-1, 1 << 60)] {
            let a_turn = 1_i64 << bits;
            let scaled = StrokeMounting {
                resolution: sign as f64 * 0.010 / a_turn as f64,
                homing_offset: home,
                home_position: 0.25,
            };
            let stroke = Domain::Stroke {
                from: 0.25,
                to: 0.25 + 0.010 * f64::from(turns),
            };
            let encoder = StrokeEncoder::new(stroke, scaled).unwrap();
            for k in 0..=turns {
                // 2³²·k/turns to half a unit; the ends of the stroke have the rounding error of 0.25 + 0.8 in double precision.
                let exact = f64::from(k) / f64::from(turns) * 4_294_967_296.0;
                let found = encoder.phase_wide(home + sign * i64::from(k) * a_turn);
                let off = (f64::from(found.value.to_bits()) - exact.min(4_294_967_295.0)).abs();
                assert!(off < 0.51, "{bits} bits, {k} of {turns}: {off}");
                assert!(!found.saturated || off < 0.51 && [0, turns].contains(&k));
            }
            let [before, behind] = [-9, i64::from(turns) * a_turn + 9]
                .map(|count| encoder.phase_wide(home + sign * count));
            assert!(bits > 30 || before.saturated && behind.saturated);
        }
    }
}

/// A 32-bit register, signed or not, may overflow anywhere within the stroke.
#[test]
fn a_register_may_overflow_within_the_stroke() {
    let stroke = Domain::Stroke { from: 0.0, to: 0.3 };
    let a_turn = 1_i64 << 20;
    for home in [
        0x7fff_0000,
        -0x8000_0000 - 15 * a_turn,
        0xffff_fff0,
        -3,
        i64::MAX >> 3,
    ] {
        let scaled = StrokeMounting {
            resolution: 0.01 / a_turn as f64,
            homing_offset: home,
            home_position: 0.0,
        };
        let encoder = StrokeEncoder::new(stroke, scaled).unwrap();
        for count in [0, 1, 0xffff, 0x1_0000, a_turn * 15, a_turn * 30] {
            let exact = count as f64 / (30 * a_turn) as f64 * 4_294_967_296.0;
            let found = encoder.phase((home + count) as u32 as i32);
            let off = f64::from(found.value.to_bits()) - exact.min(4_294_967_295.0);
            assert!(
                !found.saturated && off.abs() < 0.76,
                "{home} {count}: {off}"
            );
        }
        for count in [-1, 30 * a_turn + 1, 1 << 30] {
            assert!(encoder.phase((home + count) as u32 as i32).saturated);
        }
    }
    // More counts than the register has: each is flagged, none is read as another position.
    let scaled = StrokeMounting {
        resolution: 1e-11,
        homing_offset: 0,
        home_position: 0.0,
    };
    let encoder = StrokeEncoder::new(stroke, scaled).unwrap();
    for count in [i32::MIN, -1, 0, 1, i32::MAX] {
        assert!(encoder.phase(count).saturated);
    }
    assert!(!encoder.phase_wide(1 << 33).saturated);
    let error = StrokeEncoder::new(
        stroke,
        StrokeMounting {
            homing_offset: i64::MIN,
            ..scaled
        },
    )
    .unwrap_err();
    assert!(
        error.to_string().starts_with(
            "the count in the middle of the stroke is -more than 4000000000, but must be"
        ),
        "{error}"
    );
}

/// A 32-bit register that passes 2³¹ in one direction: with a power of two of counts per turn of the drive link it keeps its angle, otherwise a
/// `Counter` keeps it.
#[test]
fn a_register_that_overflows_keeps_its_angle() {
    for (counts_per_turn, gear) in [
        (4096, [1, 1]),
        (10_000, [1, 1]),
        (1 << 24, [57, 13]),
        (10_000, [16, 625]),
    ] {
        let mounting = Mounting {
            gear,
            ..Mounting::direct(counts_per_turn)
        };
        let encoder = Encoder::new(mounting).unwrap();
        let whole =
            (u128::from(gear[1]) << 32) % (u128::from(counts_per_turn) * u128::from(gear[0])) == 0;
        let mut counter = Counter::<32>::default();
        let (mut position, mut jumped) = (0_i64, false);
        for k in 0..40_000_i64 {
            position += 300_000 + k % 977;
            let register = position as u32;
            let count = counter.extend(register);
            assert_eq!(count, position);
            check(&mounting, position, encoder.phase_wide(count).to_bits());
            let narrow = encoder.phase(register.cast_signed());
            if whole {
                check(&mounting, position, narrow.to_bits());
            } else {
                let off = (narrow - encoder.phase_wide(count)).to_bits().cast_signed();
                jumped |= off.unsigned_abs() > 1 << 8;
            }
        }
        assert!(
            position > 2 << 32 && jumped != whole,
            "{counts_per_turn} {gear:?}"
        );
    }
}
