//! A reader of images written from docs/table-image.md alone: it knows nothing of the library but that page.

use std::f64::consts::TAU;

use jred::table::{Cubic, Layout, Quadratic, Spline, Spline16};
use jred::{Image, Phase, Q31, Scalar};

use super::support::{Folder, budget};
use super::{KINDS, export_of, image, words_of};

/// An image, taken apart.
struct Reader {
    words: Vec<u32>,
}

/// The curves at one phase in SI units, b and c with their constants; the reciprocal in its own units.
#[derive(Clone, Copy, Debug, Default)]
struct Read {
    inertia: f64,
    slope: f64,
    load: f64,
    viscous: f64,
    coulomb: f64,
    reciprocal: f64,
}

/// CRC-32/ISO-HDLC, bit by bit.
fn crc(bytes: impl Iterator<Item = u8>) -> u32 {
    let mut crc = 0xffff_ffff_u32;
    for byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
        }
    }
    !crc
}

impl Reader {
    fn new(words: Vec<u32>) -> Self {
        assert_eq!(&words[0].to_le_bytes(), b"JRED");
        assert_eq!(words[1], 2 | 24 << 16);
        assert_eq!(words[2] as usize, words.len());
        let (last, before) = words.split_last().unwrap();
        assert_eq!(crc(before.iter().flat_map(|w| w.to_le_bytes())), *last);
        assert_eq!(words[19..24], [0; 5]);
        Self { words }
    }

    fn kind(&self) -> [u8; 4] {
        self.words[3].to_le_bytes()
    }

    fn float(&self, word: usize) -> f64 {
        f64::from(f32::from_bits(self.words[word]))
    }

    fn range(&self) -> f64 {
        match self.kind()[3] {
            0 => TAU,
            _ => self.float(6) - self.float(5),
        }
    }

    /// Position of a curve (by its bit, 0 for J) among the columns.
    fn column(&self, bit: u8) -> Option<usize> {
        let columns = [0, 1, 2, 4, 8];
        let set = self.kind()[1];
        let mut own = columns.iter().filter(|b| **b == 0 || set & **b != 0);
        own.position(|b| *b == bit)
    }

    fn width(&self) -> usize {
        1 + (self.kind()[1] & 15).count_ones() as usize
    }

    /// A word of f32 or i32 as a number, of the curve with this bit.
    fn number(&self, word: u32, bit: u8) -> f64 {
        if self.kind()[0] == 1 {
            return f64::from(f32::from_bits(word));
        }
        f64::from(word.cast_signed()) / Self::unit(bit)
    }

    /// 1 in units of i32.
    fn unit(bit: u8) -> f64 {
        2f64.powi(match bit {
            0 | 2 => 30,
            1 | 4 => 29,
            _ => 31,
        })
    }

    /// Value and slope by the range/N of a column.
    fn polynomial(&self, cell: usize, place: f64, bit: u8) -> [f64; 2] {
        let Some(column) = self.column(bit) else {
            return [0.0; 2];
        };
        let [number, _, layout, _] = self.kind();
        let (rows, width) = (&self.words[24..], self.width());
        let mut u = place;
        let [p0, p1, p2, p3] = match layout {
            1 | 4 => {
                let point = |k: usize| {
                    if layout == 1 {
                        return self.number(rows[(cell + k) * width + column], bit);
                    }
                    let word = rows[(cell + k) * width.div_ceil(2) + column / 2];
                    let half = if column % 2 == 0 { word } else { word >> 16 };
                    f64::from(half as i16) * self.gain(bit) / Self::unit(bit)
                };
                let [c0, c1, c2, c3] = [0, 1, 2, 3].map(point);
                let offset = if bit == 0 {
                    self.number(self.words[13], 0)
                } else {
                    0.0
                };
                [
                    c0 + 4.0 * c1 + c2 + offset,
                    3.0 * (c2 - c0),
                    3.0 * (c0 - 2.0 * c1 + c2),
                    (c3 - c0) + 3.0 * (c1 - c2),
                ]
            }
            2 => [0, 1, 2, 3].map(|k| self.number(rows[4 * (cell * width + column) + k], bit)),
            _ => {
                let pitch = (3 * width).div_ceil(4) * 4;
                let p = |k| self.number(rows[cell * pitch + 3 * column + k], bit);
                [p(0), p(1), p(2), 0.0]
            }
        };
        if number == 2 && (layout == 2 || layout == 3) {
            u -= 0.5;
        }
        [
            p0 + u * (p1 + u * (p2 + u * p3)),
            p1 + u * (2.0 * p2 + 3.0 * u * p3),
        ]
    }

    fn gain(&self, bit: u8) -> f64 {
        let place = match bit {
            0 => 0,
            1 => 1,
            2 => 2,
            4 => 3,
            _ => 4,
        };
        let word = self.words[16 + place / 2] >> (16 * (place % 2));
        f64::from(word as u16)
    }

    fn read(&self, phase: u32) -> Read {
        let product = u64::from(phase) * u64::from(self.words[4]);
        let (cell, low) = ((product >> 32) as usize, product as u32);
        let [torque, speed, inertia] = [7, 8, 9].map(|word| self.float(word));
        let per_position = f64::from(self.words[4]) / self.range();
        let set = self.kind()[1];
        if self.kind()[0] == 3 {
            return self.short(cell, i64::from(low >> 16));
        }
        let at = |bit| self.polynomial(cell, f64::from(low) / 2f64.powi(32), bit);
        let constant = |of: u8, word: usize, bit| {
            if set & of == 0 {
                0.0
            } else {
                self.number(self.words[word], bit)
            }
        };
        let [value, slope] = at(0);
        Read {
            inertia: value * inertia,
            slope: slope * inertia * per_position,
            load: at(1)[0] * torque,
            viscous: (at(2)[0] + constant(16, 14, 2)) * torque / speed,
            coulomb: (at(4)[0].abs() + constant(32, 15, 4)) * torque,
            reciprocal: at(8)[0],
        }
    }

    fn short(&self, cell: usize, u: i64) -> Read {
        let set = self.kind()[1];
        let more = (set & 15).count_ones() as usize;
        let mut row = self.words[24 + cell * (3 + more)..].iter().copied();
        let mut next = |has: bool| has.then(|| row.next().unwrap());
        let load = next(set & 1 != 0);
        let [j, v, start] = [(); 3].map(|()| next(true).unwrap());
        let [b, c, r] = [2, 4, 8].map(|bit| next(set & bit != 0));
        let line = |word: u32| (i64::from(word.cast_signed()) + i64::from(word as i16) * u) >> 16;
        let number = |word: Option<u32>| word.map_or(0.0, |word| line(word) as f64);
        let constant = |of: u8, word: usize, bits: i32| {
            if set & of == 0 {
                0.0
            } else {
                f64::from(self.words[word].cast_signed()) / 2f64.powi(bits)
            }
        };
        let [torque, speed, inertia] = [7, 8, 9].map(|word| self.float(word));
        let whole = (i64::from(start) + line(j) * u) >> 16;
        let load = load.map_or(0.0, |word| {
            let g = i64::from(start as i16) * 65_536 + line(word) * u;
            2f64.powi(-16) - g as f64 / 2f64.powi(31)
        });
        let velocity = line(v) as f64 / 32_768.0;
        Read {
            inertia: whole as f64 / 65_536.0 * inertia,
            slope: 2.0 * velocity * torque / (speed * speed),
            load: load * torque,
            viscous: (number(b) / 32_768.0 + constant(16, 14, 30)) * torque / speed,
            coulomb: (number(c).abs() / 32_768.0 + constant(32, 15, 31)) * torque,
            reciprocal: number(r) / 2f64.powi(self.words[13].cast_signed()),
        }
    }
}

/// The library's reading of the same image.
fn library(words: &[u32], kind: (&str, &str), phase: Phase) -> Read {
    let image = Image::new(words).unwrap();
    match kind {
        ("f32", "spline") => long::<f32, Spline>(&image, phase),
        ("f32", "cubic") => long::<f32, Cubic>(&image, phase),
        ("f32", _) => long::<f32, Quadratic>(&image, phase),
        ("i32", "spline") => long::<Q31, Spline>(&image, phase),
        ("i32", "spline16") => long::<Q31, Spline16>(&image, phase),
        ("i32", "cubic") => long::<Q31, Cubic>(&image, phase),
        ("i32", _) => long::<Q31, Quadratic>(&image, phase),
        _ => {
            let read = image.short_table().unwrap().at(phase);
            let scale = image.scale();
            let [torque, speed, inertia] =
                [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
            Read {
                inertia: read.inertia * inertia,
                slope: 2.0 * read.velocity * torque / (speed * speed),
                load: read.load * torque,
                viscous: read.viscous * torque / speed,
                coulomb: read.coulomb * torque,
                reciprocal: read.reciprocal,
            }
        }
    }
}

fn long<S: Scalar, L: Layout>(image: &Image<'_>, phase: Phase) -> Read {
    let table = image.table::<S, L>().unwrap();
    let read = table.at(phase);
    let scale = image.scale();
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let span = f64::from(image.domain().span());
    Read {
        inertia: read.inertia.to_f64() * inertia,
        slope: read.inertia_slope.to_f64() * inertia * f64::from(table.cells()) / span,
        load: read.load.to_f64() * torque,
        viscous: read.viscous.to_f64() * torque / speed,
        coulomb: read.coulomb.to_f64() * torque,
        reciprocal: 0.0,
    }
}

fn compare(words: Vec<u32>, kind: (&str, &str)) {
    let reader = Reader::new(words.clone());
    let mut largest = Read::default();
    let mut worst = Read::default();
    for k in 0..4000u32 {
        let bits = k.wrapping_mul(1_073_741).wrapping_add(77) ^ k << 20;
        let (found, library) = (
            reader.read(bits),
            library(&words, kind, Phase::from_bits(bits)),
        );
        for (worst, most, a, b) in [
            (
                &mut worst.inertia,
                &mut largest.inertia,
                found.inertia,
                library.inertia,
            ),
            (
                &mut worst.slope,
                &mut largest.slope,
                found.slope,
                library.slope,
            ),
            (&mut worst.load, &mut largest.load, found.load, library.load),
            (
                &mut worst.viscous,
                &mut largest.viscous,
                found.viscous,
                library.viscous,
            ),
            (
                &mut worst.coulomb,
                &mut largest.coulomb,
                found.coulomb,
                library.coulomb,
            ),
        ] {
            *worst = worst.max((a - b).abs());
            *most = most.max(b.abs());
        }
    }
    let share = match kind {
        ("f32", _) => budget::DOCUMENT_F32,
        ("i32", "quadratic") => budget::DOCUMENT_SHORT_PLACE,
        ("i32", _) => budget::DOCUMENT_I32,
        _ => budget::DOCUMENT_I16,
    };
    // Units of fixed point are those of the bases, however small a curve is.
    let fixed = f64::from(u8::from(kind.0 != "f32"));
    let [torque, speed, inertia] = [7, 8, 9].map(|word| fixed * reader.float(word));
    let per_position = f64::from(reader.words[4]) / reader.range();
    let per_speed = torque / speed.max(f64::MIN_POSITIVE);
    for (what, worst, most) in [
        ("J", worst.inertia, largest.inertia.max(inertia)),
        ("J'", worst.slope, largest.slope.max(inertia * per_position)),
        ("load", worst.load, largest.load.max(torque)),
        ("b", worst.viscous, largest.viscous.max(per_speed)),
        ("c", worst.coulomb, largest.coulomb.max(torque)),
    ] {
        println!("{kind:?} {what}: {:e} of {most}", worst / most.max(1e-300));
        assert!(worst <= share * most, "{kind:?} {what}: {worst} of {most}");
    }
    assert!(largest.inertia > 0.0 && largest.slope > 0.0);
}

#[test]
fn the_document_gives_the_curves_of_every_type_and_layout() {
    let folder = Folder::new();
    for (number, layout) in KINDS {
        for reciprocal in ["no", "yes"] {
            if number == "f32" && reciprocal == "yes" {
                continue;
            }
            let words = image(
                &folder,
                &[
                    "--type",
                    number,
                    "--layout",
                    layout,
                    "--torque-error",
                    "1 N m",
                    "--reciprocal",
                    reciprocal,
                ],
            );
            compare(words, (number, layout));
        }
    }
}

/// Strokes, and friction that is a curve, a constant, or both kinds.
#[test]
fn the_document_gives_the_curves_of_other_machines() {
    let folder = Folder::new();
    for (machine, more) in [
        ("cam-translating.toml", ["--omega", "60 rpm"]),
        ("excavator-bucket.toml", ["--max-cells", "4096"]),
        ("geneva.toml", ["--omega", "60 rpm"]),
    ] {
        let file = super::support::press_file().with_file_name(machine);
        for (number, layout) in KINDS {
            let out = folder.path("other.jred");
            let run = export_of(
                &file,
                &[
                    "--type",
                    number,
                    "--layout",
                    layout,
                    "--max-bytes",
                    "4000",
                    more[0],
                    more[1],
                ],
                Some(&out),
            );
            run.ends(0);
            compare(words_of(&out), (number, layout));
        }
    }
}

/// The curve of 1/J is J_m/J: their product is the same power of two everywhere.
#[test]
fn the_reciprocal_is_a_power_of_two_over_the_inertia() {
    let folder = Folder::new();
    for (number, layout) in &KINDS[3..] {
        let words = image(
            &folder,
            &[
                "--type",
                number,
                "--layout",
                layout,
                "--torque-error",
                "1 N m",
                "--reciprocal",
                "yes",
            ],
        );
        let reader = Reader::new(words);
        let base = reader.float(9);
        let unit = if *number == "i16" {
            1.0
        } else {
            let read = reader.read(0);
            (read.inertia / base * read.reciprocal)
                .log2()
                .round()
                .exp2()
        };
        for k in 0..2000u32 {
            let read = reader.read(k.wrapping_mul(2_147_483));
            let product = read.inertia / base * read.reciprocal / unit;
            assert!(
                (product - 1.0).abs() <= budget::RECIPROCAL_SEED,
                "{number} {layout}: {product}"
            );
        }
    }
}
