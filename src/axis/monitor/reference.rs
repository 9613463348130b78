//! The reference of a monitor, for a memory that keeps it without power.

use super::{Monitor, Stage, Watch};
use crate::Phase;
use crate::axis::AxisError;
use crate::axis::error::within;
use crate::number::Number;
use crate::tick::MachineUnits;

/// Of the layout of the words.
const VERSION: u32 = 1;

impl<N: Number, const BINS: usize> Monitor<N, BINS> {
    /// Number of words of a [`reference`](Self::reference).
    pub const REFERENCE_WORDS: usize = 9 + 3 * BINS;

    /// Means and deviations that were learned, as words for [`with_reference`](Self::with_reference); `None`: the reference is not complete.
    ///
    /// ```text
    /// version, largest torque, ticks of a cycle, mean and 1/(2·σ) of friction, spread and payload of a cycle, then for each bin: ticks, mean, σ
    /// ```
    ///
    /// The largest torque, the figures of a cycle and σ are bits of `f32`; mean and σ of a bin count 2⁻²⁰ of the largest torque. No word depends on `N`.
    pub fn reference(&self) -> Option<impl Iterator<Item = u32>> {
        let head = [VERSION, self.watch.largest.to_bits(), self.ticks];
        let drifts = [self.friction, self.spread, self.payload];
        let drifts = drifts.map(|drift| [drift.mean, drift.scale].map(f32::to_bits));
        let bins = self.bins.iter();
        let bins =
            bins.flat_map(|bin| [bin.ticks, bin.mean.cast_unsigned(), bin.deviation.to_bits()]);
        let words = head.into_iter().chain(drifts.into_iter().flatten());
        self.is_watching().then(|| words.chain(bins))
    }

    /// A monitor that watches at once, with the [`reference`](Self::reference) of an earlier one; the rest as for [`new`](Self::new). It answers as the
    /// earlier one did when its reference was complete: sums of drifts start at 0.
    ///
    /// The words do not tell the machine, the motion, the period of the tick or the payload's torque: they must be those of the reference. Keep the words
    /// with a checksum; most flipped bits give another reference, not an error.
    ///
    /// # Errors
    /// As [`new`](Self::new); a reference of another number of bins, largest torque or version; a number in it that no monitor writes: NaN, negative σ.
    pub fn with_reference(
        words: &[u32],
        watch: Watch,
        payload: impl FnMut(Phase) -> f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        // In place: a copy of a monitor is kilobytes of stack.
        let mut made = Self::new(watch, payload, model);
        if let Ok(monitor) = &mut made {
            monitor.restore(words)?;
        }
        made
    }

    fn restore(&mut self, words: &[u32]) -> Result<(), AxisError> {
        within(
            "the number of words of the reference",
            words.len() as f32,
            words.len() == Self::REFERENCE_WORDS,
            "9, and 3 for each bin",
        )?;
        let mut words = words.iter().copied();
        let mut next = || words.next().unwrap_or_default();
        let version = next();
        within(
            "the version of the reference",
            version as f32,
            version == VERSION,
            "1",
        )?;
        let largest = f32::from_bits(next());
        within(
            "the largest torque of the reference",
            largest,
            largest.to_bits() == self.watch.largest.to_bits(),
            "that of the monitor",
        )?;
        self.ticks = next();
        let Monitor {
            friction,
            spread,
            payload,
            ..
        } = self;
        for drift in [friction, spread, payload] {
            [drift.mean, drift.scale] = [f32::from_bits(next()), f32::from_bits(next())];
            for number in [drift.mean.abs(), drift.scale] {
                within(
                    "a figure of the reference's cycles",
                    number,
                    (0.0..f32::INFINITY).contains(&number),
                    "finite, and its deviation not negative",
                )?;
            }
        }
        for bin in &mut self.bins {
            (bin.ticks, bin.mean) = (next(), next().cast_signed());
            bin.deviation = f32::from_bits(next());
            let least = if bin.is_known() { 1.0 } else { 0.0 };
            within(
                "a mean of the reference, in counts,",
                bin.mean as f32,
                bin.mean.unsigned_abs() <= 1 << 21,
                "at most twice the largest torque, in either direction",
            )?;
            within(
                "a deviation of the reference, in counts,",
                bin.deviation,
                (least..=4_194_304.0).contains(&bin.deviation),
                "from 1 to 4194304, or 0 in a bin with less than 16 ticks",
            )?;
        }
        self.set_limits();
        self.stage = Stage::Watching;
        Ok(())
    }
}
