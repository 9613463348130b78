//! Encoders: their creation here, and their conversions in the header.

use std::fmt::Write as _;

use core::mem::{MaybeUninit, offset_of};
use jred::Domain;
use jred::axis::{Counter, Counting, Encoder, Mounting, StrokeEncoder, StrokeMounting};

use super::{Numbers, answers};
use crate::encoder::{CMounting, jred_encoder_make, jred_stroke_encoder_make};
use crate::status::Status;

impl Numbers {
    /// Of any magnitude and sign.
    fn long(&mut self) -> i64 {
        let shift = self.below(64);
        self.next().cast_signed() >> shift
    }
    /// Extremes, or any number.
    fn count(&mut self) -> i64 {
        const ENDS: [i64; 9] = [
            0,
            1,
            -1,
            i64::MIN,
            i64::MAX,
            1 << 31,
            -(1 << 31),
            (1 << 31) - 1,
            1 << 32,
        ];
        let k = self.below(30) as usize;
        ENDS.get(k).copied().unwrap_or_else(|| self.long())
    }
    fn mounting(&mut self) -> CMounting {
        loop {
            let [shift, gear] = [self.below(31), self.below(3)];
            let any = |numbers: &mut Self| (numbers.next() as u32) >> numbers.below(32);
            let mounting = CMounting {
                counts_per_turn: (self.next() as u32) >> shift,
                gear: if gear == 0 {
                    [1, 1]
                } else {
                    [any(self), any(self)]
                },
                counts_down: self.below(2) as u8,
                homing_offset: self.count(),
            };
            if Encoder::new(mounting.into()).is_ok() {
                return mounting;
            }
        }
    }
    fn part(&mut self) -> f64 {
        self.next() as f64 / 18_446_744_073_709_551_616.0
    }
}

fn field<T: Copy, E>(encoder: &E, offset: usize) -> T {
    // SAFETY: every field of both is a number, and the offset is one of C.
    unsafe {
        core::ptr::from_ref(encoder)
            .byte_add(offset)
            .cast::<T>()
            .read()
    }
}

#[test]
fn the_header_computes_the_bits_of_rust() {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let (mut asked, mut expected) = (String::new(), Vec::new());
    for _ in 0..2000 {
        let mounting = numbers.mounting();
        let mut memory = MaybeUninit::uninit();
        let made = jred_encoder_make(Some(&mut memory), Some(&mounting));
        assert_eq!(made, Status::Ok);
        // SAFETY: it was written.
        let encoder: Encoder = unsafe { memory.assume_init() };
        assert_eq!(encoder, Encoder::new(mounting.into()).unwrap());
        for _ in 0..8 {
            let count = numbers.count();
            let (lower, upper) = (field::<i32, _>(&encoder, 0), field::<u32, _>(&encoder, 4));
            let start: u64 = field(&encoder, 8);
            let rest: i32 = field(&encoder, 16);
            writeln!(asked, "t {lower} {upper} {start} {rest} {count}").unwrap();
            let [narrow, wide] = [encoder.phase(count as i32), encoder.phase_wide(count)];
            expected.push(format!("{} {}", narrow.to_bits(), wide.to_bits()));
        }
    }
    for _ in 0..2000 {
        let counts = 2f64.powf(4.0 + 49.0 * numbers.part());
        let span = 0.01 + numbers.part();
        let sign = if numbers.below(2) == 0 { 1.0 } else { -1.0 };
        let scaled = StrokeMounting {
            resolution: sign * span / counts,
            homing_offset: numbers.long() >> 2,
            home_position: 3.0 * numbers.part() - 1.0,
        };
        let stroke = Domain::Stroke {
            from: 0.0_f32,
            to: span as f32,
        };
        let Ok(encoder) = StrokeEncoder::new(stroke, scaled) else {
            continue;
        };
        let mut memory = MaybeUninit::uninit();
        let made = jred_stroke_encoder_make(Some(&mut memory), 0.0, span as f32, Some(&scaled));
        assert_eq!(made, Status::Ok);
        // SAFETY: it was written.
        assert_eq!(unsafe { memory.assume_init() }, encoder);
        let fields = [0, 8, 16, 24, 32].map(|at| field::<i64, _>(&encoder, at));
        let (part, rest) = (field::<u32, _>(&encoder, 40), field::<i32, _>(&encoder, 44));
        for _ in 0..8 {
            // Near the stroke, or anywhere.
            let near = ((numbers.part() - 0.5) * 1.2 * counts) as i64;
            let count = match numbers.below(3) {
                0 => numbers.count(),
                _ => fields[3].wrapping_add(near),
            };
            writeln!(
                asked,
                "s {} {} {} {} {} {part} {rest} {count}",
                fields[0], fields[1], fields[2], fields[3], fields[4]
            )
            .unwrap();
            let [narrow, wide] = [encoder.phase(count as i32), encoder.phase_wide(count)]
                .map(|found| format!("{} {}", found.value.to_bits(), u8::from(found.saturated)));
            expected.push(format!("{narrow} {wide}"));
        }
    }
    for _ in 0..4000 {
        let (count, reading) = (numbers.count(), numbers.next() as u32);
        writeln!(
            asked,
            "c 16 {count} {reading}\nc 32 {count} {reading}\nc 1 {count} {reading}"
        )
        .unwrap();
        expected.push(Counter::<16>::at(count).extend(reading).to_string());
        expected.push(Counter::<32>::at(count).extend(reading).to_string());
        expected.push(Counter::<1>::at(count).extend(reading).to_string());
    }
    for short in [false, true] {
        let found = answers("encoder", &asked, short);
        assert_eq!(found.len(), expected.len());
        let asked = asked.lines();
        for ((asked, found), expected) in asked.zip(&found).zip(&expected) {
            assert_eq!(found, expected, "{asked}");
        }
    }
}

#[test]
fn an_encoder_is_that_of_the_header() {
    assert_eq!(size_of::<Encoder>(), 24);
    assert_eq!(size_of::<StrokeEncoder>(), 48);
    assert_eq!(size_of::<StrokeMounting>(), 24);
    assert_eq!(
        (size_of::<CMounting>(), offset_of!(CMounting, homing_offset)),
        (24, 16)
    );
    assert_eq!(offset_of!(CMounting, counts_down), 12);
    let up = Mounting {
        counting: Counting::Up,
        ..Mounting::direct(10_000)
    };
    let encoder = Encoder::new(up).unwrap();
    // A turn in units of 2⁻⁶⁴ over 10,000, rounded; half a unit of a phase at count 0.
    let (lower, upper) = (field::<i32, _>(&encoder, 0), field::<u32, _>(&encoder, 4));
    assert_eq!(
        (i128::from(upper) << 32) + i128::from(lower),
        ((1 << 64) + 5000) / 10_000
    );
    assert_eq!(field::<u64, _>(&encoder, 8), 1 << 31);
}

#[test]
fn an_encoder_that_cannot_be_has_the_phase_0_or_limits_every_count() {
    let good = CMounting {
        counts_per_turn: 10_000,
        gear: [17, 2],
        counts_down: 1,
        homing_offset: 1234,
    };
    for wrong in [
        CMounting {
            counts_per_turn: 0,
            ..good
        },
        CMounting {
            gear: [0, 1],
            ..good
        },
        CMounting {
            gear: [1, 0],
            ..good
        },
        CMounting {
            counts_per_turn: 3,
            gear: [1, 2],
            ..good
        },
    ] {
        let mut memory = MaybeUninit::uninit();
        assert_eq!(
            jred_encoder_make(Some(&mut memory), Some(&wrong)),
            Status::Figure
        );
        // SAFETY: zeros are an encoder.
        let encoder: Encoder = unsafe { memory.assume_init() };
        assert_eq!(
            [encoder.phase(77), encoder.phase_wide(i64::MIN)].map(jred::Phase::to_bits),
            [0, 0]
        );
    }
    assert_eq!(jred_encoder_make(None, Some(&good)), Status::Null);
    assert_eq!(
        jred_encoder_make(Some(&mut MaybeUninit::uninit()), None),
        Status::Null
    );
    let good = StrokeMounting {
        resolution: 1e-6,
        homing_offset: 0,
        home_position: 0.0,
    };
    let nan = f64::NAN;
    for (from, to, wrong) in [
        (0.0, 0.0, good),
        (0.5, 0.0, good),
        (f32::NAN, 0.5, good),
        (0.0, f32::INFINITY, good),
        (
            0.0,
            0.5,
            StrokeMounting {
                resolution: nan,
                ..good
            },
        ),
        (
            0.0,
            0.5,
            StrokeMounting {
                resolution: 0.0,
                ..good
            },
        ),
        (
            0.0,
            0.5,
            StrokeMounting {
                home_position: nan,
                ..good
            },
        ),
        (
            0.0,
            0.5,
            StrokeMounting {
                homing_offset: i64::MAX,
                ..good
            },
        ),
    ] {
        let mut memory = MaybeUninit::uninit();
        let made = jred_stroke_encoder_make(Some(&mut memory), from, to, Some(&wrong));
        assert_eq!(made, Status::Figure, "{from} {to} {wrong:?}");
        // SAFETY: an encoder without a stroke was written.
        let encoder: StrokeEncoder = unsafe { memory.assume_init() };
        assert!(encoder.phase(77).saturated && encoder.phase_wide(77).saturated);
    }
    assert_eq!(
        jred_stroke_encoder_make(None, 0.0, 0.5, Some(&good)),
        Status::Null
    );
}
