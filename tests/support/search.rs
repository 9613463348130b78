//! A search that tries to exceed a bound: random cases and corners first, then hill climbing from each.

/// Number of cases to climb from, in either direction, and of steps each.
const STARTS: usize = 4;
const STEPS: usize = 10_000;

/// A fixed sequence (xorshift; G. Marsaglia 2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 32) as u32
    }

    fn below(&mut self, end: usize) -> usize {
        self.next() as usize % end
    }

    /// An end or the middle of a range, or close to it.
    fn corner(&mut self) -> u32 {
        const CORNERS: [u32; 4] = [0, u32::MAX, i32::MAX as u32, 1 << 31];
        let off = self.next().checked_shr(self.below(33) as u32).unwrap_or(0);
        CORNERS[self.below(CORNERS.len())] ^ (off >> 6)
    }

    /// Another number: a bit flipped, a little more or less, or a corner.
    fn changed(&mut self, gene: u32) -> u32 {
        let size = 1 << self.below(32);
        match self.below(8) {
            0 => self.corner(),
            1..=3 => gene ^ size,
            4 | 5 => gene.wrapping_add(size),
            _ => gene.wrapping_sub(size),
        }
    }
}

/// The least and the greatest error found over cases of this many genes; `None` is an invalid case.
pub(crate) fn extremes(seed: u64, genes: usize, error: impl Fn(&[u32]) -> Option<f64>) -> [f64; 2] {
    let mut random = Random(seed);
    let mut found = [f64::INFINITY, f64::NEG_INFINITY];
    for start in 0..2 * STARTS {
        let sign = if start % 2 == 0 { 1.0 } else { -1.0 };
        let mut best = f64::NEG_INFINITY;
        let mut case = vec![0; genes];
        for _ in 0..STEPS {
            let mut other = case.clone();
            if best == f64::NEG_INFINITY {
                let corners = start % 4 < 2;
                other.fill_with(|| {
                    if corners {
                        random.corner()
                    } else {
                        random.next()
                    }
                });
            }
            for _ in 0..=random.below(3) {
                let at = random.below(genes);
                other[at] = random.changed(other[at]);
            }
            let Some(error) = error(&other) else { continue };
            found = [found[0].min(error), found[1].max(error)];
            if sign * error >= best {
                (best, case) = (sign * error, other);
            }
        }
    }
    found
}
