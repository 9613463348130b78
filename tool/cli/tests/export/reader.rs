//! A reader of images written from docs/table-image.md alone, without the library.

use std::f64::consts::TAU;

/// A parsed image.
pub(super) struct Reader {
    pub(super) words: Vec<u32>,
}

/// The curves at one phase in SI units, b and c with their constants; the reciprocal in its own units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Read {
    pub(super) inertia: f64,
    pub(super) slope: f64,
    pub(super) load: f64,
    pub(super) viscous: f64,
    pub(super) coulomb: f64,
    pub(super) reciprocal: f64,
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
    pub(super) fn new(words: Vec<u32>) -> Self {
        assert_eq!(&words[0].to_le_bytes(), b"JRED");
        assert_eq!(words[1], 2 | 24 << 16);
        assert_eq!(words[2] as usize, words.len());
        let (last, before) = words.split_last().unwrap();
        assert_eq!(crc(before.iter().flat_map(|w| w.to_le_bytes())), *last);
        assert_eq!(words[20..24], [0; 4]);
        Self { words }
    }

    fn kind(&self) -> [u8; 4] {
        self.words[3].to_le_bytes()
    }

    pub(super) fn float(&self, word: usize) -> f64 {
        f64::from(f32::from_bits(self.words[word]))
    }

    pub(super) fn range(&self) -> f64 {
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

    pub(super) fn read(&self, phase: u32) -> Read {
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
