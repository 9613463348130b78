//! The reader in plain C99 has the bits of the library, for every set of curves of its formats; and it refuses what is no image.

use std::fmt::Write as _;

use jred::image::{Validity, encode, image_len};
use jred::number::{Bases, FrictionSign, Quantity};
use jred::table::{Constants, Format, RowConstants, Shape, Table, words_len};
use jred::{AnyModel, CurveSet, Domain, Image, Phase, Q31, Rows16, Scale, Spline, curves};

use super::axis::Any;
use super::{Numbers, answers, press};

/// A share between −1 and 1.
fn share(numbers: &mut Numbers) -> f64 {
    numbers.below(1 << 30) as f64 / f64::from(1 << 29) - 1.0
}

/// A table in words, with its constants; a quarter of them on a stroke.
fn image<F: Format>(
    numbers: &mut Numbers,
    set: CurveSet,
    words: &[F::Word],
    made: (u32, Scale, F::Constants),
) -> Vec<u32> {
    let (cells, scale, constants) = made;
    let _ = numbers;
    let shape = Shape {
        set,
        cells,
        domain: domain(cells).to(),
        scale,
        constants,
    };
    let table = Table::<F>::new(words, shape).unwrap_or_else(|error| panic!("{set}: {error:?}"));
    let validity = Validity {
        max_speed: 30.0,
        max_acceleration: 200.0,
        torque_error: 0.01,
    };
    let mut buffer = vec![0; image_len::<F>(cells, set)];
    encode(&table, validity, &mut buffer).unwrap().to_vec()
}

/// A stroke for every fourth number of cells.
fn domain(cells: u32) -> Domain<f32> {
    if cells % 4 == 3 {
        Domain::Stroke {
            from: -0.5,
            to: 1.0,
        }
    } else {
        Domain::Turn
    }
}

/// Control points of a spline: J about 0.3, a load and frictions of about a tenth, all periodic on a turn.
fn points(
    numbers: &mut Numbers,
    set: CurveSet,
    cells: u32,
    unit: impl Fn(usize, f64) -> u32,
) -> Vec<u32> {
    let width = curves::width(set);
    // In the order of the columns.
    let columns: Vec<usize> = (0..5)
        .filter(|k| *k == 0 || set & (1 << (k - 1)) != 0)
        .collect();
    let mut rows: Vec<u32> = Vec::new();
    for row in 0..cells as usize + 3 {
        for column in &columns {
            let value = match column {
                // With 1/J both are constant.
                0 if set & curves::RECIPROCAL != 0 => 0.25,
                0 => 0.3 + 0.004 * share(numbers),
                4 => 1.0,
                2 => 0.02 + 0.01 * share(numbers),
                _ => 0.1 * share(numbers),
            };
            let word = if row >= cells as usize && matches!(domain(cells), Domain::Turn) {
                rows[(row - cells as usize) * width + rows.len() % width]
            } else {
                unit(*column, value / 6.0)
            };
            rows.push(word);
        }
    }
    rows
}

/// Cells and machine units, such that the velocity torque is a whole multiple of the slope.
fn units(numbers: &mut Numbers) -> (u32, Scale) {
    let cells = 4 + numbers.below(60) as u32;
    let bases = Bases {
        torque: 40.0,
        speed: 0.4 + numbers.below(100) as f32 * 0.01,
        inertia: 20.0,
    };
    let span = f64::from(domain(cells).span());
    (cells, Scale::new(bases).unwrap().for_cells(cells, span))
}

fn spline_f32(numbers: &mut Numbers, set: CurveSet) -> Vec<u32> {
    let cells = 4 + numbers.below(60) as u32;
    let words = points(numbers, set, cells, |_, value| (value as f32).to_bits());
    let words: Vec<f32> = words.into_iter().map(f32::from_bits).collect();
    let constants = Constants {
        inertia: 0.05,
        viscous: 0.03,
        coulomb: 0.07,
        ..Constants::default()
    };
    image::<Spline<f32>>(numbers, set, &words, (cells, Scale::SI, constants))
}

fn spline_q31(numbers: &mut Numbers, set: CurveSet) -> Vec<u32> {
    let (cells, scale) = units(numbers);
    let unit = |column: usize, value: f64| {
        let unit = [30, 29, 30, 29, 31][column];
        // 1/J of 0.25 is 1 in units of its power of two.
        let value = if column == 4 { value * 0.999 } else { value };
        ((value * 2f64.powi(unit)) as i32).cast_unsigned()
    };
    let words = points(numbers, set, cells, unit);
    let words: Vec<i32> = words.into_iter().map(u32::cast_signed).collect();
    let constants = Constants {
        inertia: 1000,
        viscous: 1 << 24,
        coulomb: 1 << 25,
        ..Constants::default()
    };
    image::<Spline<Q31>>(numbers, set, &words, (cells, scale, constants))
}

fn rows(numbers: &mut Numbers, set: CurveSet) -> Vec<u32> {
    let (cells, scale) = units(numbers);
    let factor = 0.5 * f64::from(cells) / f64::from(domain(cells).span())
        * f64::from(scale.inertia() * scale.speed() / scale.torque() * scale.speed());
    let half = |value: f64| value.round() as i32 as u16;
    let word = |upper: f64, lower: f64| u32::from(half(upper)) << 16 | u32::from(half(lower));
    let mut rows = Vec::new();
    for _ in 0..cells {
        let [j0, j1, j2] = [
            0.3 + 0.02 * share(numbers),
            0.002 * share(numbers),
            0.001 * share(numbers),
        ]
        .map(|j| j * 65_536.0);
        let mut small = || 3000.0 * share(numbers);
        let [g0, g1, g2, b1, c0, c1] = [(); 6].map(|()| small());
        if set & curves::LOAD != 0 {
            rows.push(word(g1, g2));
        }
        // V of the slope of J, in units of 2⁻¹⁵.
        let slope = |j: f64| factor * j / 2.0;
        rows.push(word(j1, j2));
        rows.push(word(slope(j1), slope(2.0 * j2)));
        rows.push(
            u32::from(j0 as u16) << 16
                | if set & curves::LOAD != 0 {
                    u32::from(half(g0))
                } else {
                    0
                },
        );
        if set & curves::VISCOUS != 0 {
            rows.push(word(600.0, b1 / 10.0));
        }
        if set & curves::COULOMB != 0 {
            rows.push(word(c0, c1));
        }
        if set & curves::RECIPROCAL != 0 {
            // In units of 2⁻¹².
            let reciprocal = |u: f64| 4096.0 * 65_536.0 / (j0 + u * (j1 + u * j2));
            rows.push(word(reciprocal(0.0), reciprocal(1.0) - reciprocal(0.0)));
        }
    }
    assert_eq!(rows.len(), words_len::<Rows16>(cells, set));
    let constants = RowConstants {
        viscous: 1 << 24,
        coulomb: 1 << 27,
        shift: 12,
    };
    image::<Rows16>(numbers, set, &rows, (cells, scale, constants))
}

/// Ticks of an image, and what the reader must answer.
fn ticks<F: Format<Number: Any>>(
    numbers: &mut Numbers,
    words: &[u32],
    case: &mut Cases,
    count: u32,
) {
    let image = Image::new(words).unwrap();
    let model: AnyModel<'_, F> = image.any_model().unwrap();
    case.image(words, 0);
    let bits = |x: F::Number| Any::bits(x);
    for _ in 0..count {
        let phase = numbers.next() as u32;
        let [omega, third, friction] = [(); 3].map(|()| F::Number::any(numbers));
        writeln!(
            case.asked,
            "{} {phase:x} {:x} {:x} {:x}",
            F::Number::KIND,
            bits(omega),
            bits(third),
            bits(friction)
        )
        .unwrap();
        let phase = Phase::from_bits(phase);
        let friction = FrictionSign::OfSpeed(Quantity::of(friction));
        let torque = model.torque_with(phase, Quantity::of(omega), Quantity::of(third), friction);
        let acceleration =
            model.acceleration_with(phase, Quantity::of(omega), friction, Quantity::of(third));
        let torque = format!("{:x}", bits(torque.number()));
        let both = format!("{torque} {:x}", bits(acceleration.value.number()));
        case.expected
            .push(if F::Number::KIND == 'l' { torque } else { both });
    }
}

#[derive(Default)]
struct Cases {
    asked: String,
    expected: Vec<String>,
}

impl Cases {
    fn image(&mut self, words: &[u32], status: u32) {
        write!(self.asked, "i {}", words.len()).unwrap();
        for word in words {
            write!(self.asked, " {word:x}").unwrap();
        }
        self.asked.push('\n');
        self.expected.push(status.to_string());
    }

    fn check(self) {
        let found = answers("c99", &self.asked, false);
        assert_eq!(found.len(), self.expected.len());
        for ((asked, found), expected) in self.asked.lines().zip(&found).zip(&self.expected) {
            assert_eq!(found, expected, "{}", &asked[..asked.len().min(200)]);
        }
    }
}

#[test]
fn the_reader_in_c99_has_the_bits_of_the_library() {
    let mut numbers = Numbers(0x2545_f491_4f6c_dd1d);
    let mut cases = Cases::default();
    let mut seen = 0;
    for set in 0..64 {
        for _ in 0..4 {
            if <Spline<f32> as Format>::accepts(set) {
                let words = spline_f32(&mut numbers, set);
                ticks::<Spline<f32>>(&mut numbers, &words, &mut cases, 1000);
            }
            if <Rows16 as Format>::accepts(set) {
                let words = spline_q31(&mut numbers, set);
                ticks::<Spline<Q31>>(&mut numbers, &words, &mut cases, 500);
                let words = rows(&mut numbers, set);
                ticks::<Rows16>(&mut numbers, &words, &mut cases, 500);
                seen += 1;
            }
        }
    }
    assert_eq!(seen, 4 * 36);
    assert!(cases.expected.len() > 200_000);
    ticks::<Spline<f32>>(&mut numbers, &press(), &mut cases, 1000);
    cases.check();
}

/// Every shorter length, every flipped bit; and with a right CRC another version, format, set, or number of cells.
#[test]
fn the_reader_in_c99_refuses_what_is_no_image() {
    let words = press();
    let mut cases = Cases::default();
    for length in (0..25).chain([100, words.len() - 1]) {
        cases.image(&words[..length], 2);
    }
    for bit in (0..32 * words.len()).step_by(7) {
        let mut damaged = words.clone();
        damaged[bit / 32] ^= 1 << (bit % 32);
        // Magic, version, length; everything else shows in the CRC.
        let status = match bit / 32 {
            0 => 3,
            1 if bit % 32 < 16 => 4,
            2 => 2,
            _ => 5,
        };
        cases.image(&damaged, status);
    }
    for (word, value, status) in [
        (1, 3 | 24 << 16, 4),
        (1, 2 | 25 << 16, 6),
        (3, words[3] | 64 << 8, 6),
        (3, words[3] | 2 << 24, 6),
        (3, words[3] ^ 5 << 16, 7),
        (3, words[3] & !0xff | 2, 6),
        (3, words[3] ^ 2 << 8, 6),
        (3, words[3] ^ 1 << 8, 2),
        (4, 3, 2),
        (4, 65_536, 2),
        (4, words[4] - 1, 2),
        (7, 0, 6),
        (8, f32::NAN.to_bits(), 6),
        (9, f32::INFINITY.to_bits(), 6),
        (10, (-1f32).to_bits(), 6),
        (20, 1, 6),
        (24, words[24] + 1, 6),
    ] {
        let mut other = words.clone();
        other[word] = value;
        let last = other.len() - 1;
        let bytes: Vec<u8> = other[..last]
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect();
        other[last] = crc(&bytes);
        cases.image(&other, status);
        // No table is left of a refused one.
        writeln!(cases.asked, "f 0 0 3f800000 0").unwrap();
        cases.expected.push("0 0".to_owned());
    }
    cases.check();
}

/// CRC-32/ISO-HDLC.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 }
        })
    })
}
