//! The payload of a machine, from its load torque.

use super::torque_count::{FULL, TorqueCount, covariance};
use super::{AxisError, Observer};
use crate::number::Number;
use crate::tick::MachineUnits;

/// How much payload a machine carries, by least squares of the load torque d of an [`Observer`] over the torque of a unit of payload.
///
/// The torque u that moves one unit of payload, such as 1 kg, comes from a second model: that of the same mechanism with the payload alone, for
/// which docs/observer.md has a machine file. In each tick it is the model's torque for the observed motion. Then
///
/// ```text
/// d = −m·u + d₀         m = −cov(u, d)/var(u)
/// ```
///
/// with the constant d₀ of friction that the table lacks. So that d and u belong together, u passes a filter with the observer's own lag.
///
/// The sums are integers: exact in every number type, with the same bits everywhere. After `window` ticks all sums are halved, so that older ticks
/// count less. Memory: 104 bytes, for any window. A tick takes 143 instructions on a Cortex-M4F (`scripts/test counts`), without a division, and in
/// fixed point without floating point; [`estimate`](Self::estimate) has products of 128 bits and a few divisions in single precision.
///
/// Accuracy: a payload of the model is found to 0.2 % (test `a_payload_is_found`), with 1 % noise of the torque to 2 %.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Payload<N> {
    count: TorqueCount<N>,
    lag: Lag,
    window: u32,
    sums: Sums,
}

/// Sums over ticks of u and d, in counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Sums {
    ticks: u32,
    unit: i64,
    load: i64,
    unit_square: i64,
    load_square: i64,
    product: i64,
}

/// An estimate of a [`Payload`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PayloadEstimate {
    /// m, in units of the payload; 0 if not excited.
    pub payload: f32,
    /// d₀ (N·m).
    pub offset: f32,
    /// R²: the share of the variance of d that the payload explains, 0 to 1.
    pub explained: f32,
    /// The unit's torque varied enough: over at least 32 ticks, with a standard deviation of a thousandth of the largest torque or more. Otherwise the
    /// motion says nothing about the payload.
    pub excited: bool,
}

impl<N: Number> Payload<N> {
    /// For torques d and u up to `largest` (N·m) and a memory of `window` ticks, such as those of a cycle; an odd one is one shorter.
    ///
    /// # Errors
    /// A torque that is not positive and finite; a window outside 64 to 2²⁰ ticks.
    pub fn new(
        largest: f32,
        window: u32,
        observer: &Observer<N>,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        if !(64..=1 << 20).contains(&window) {
            return Err(AxisError::OutOfRange {
                what: "the window of the payload",
                value: window as f32,
                range: "from 64 to 1048576 ticks",
            });
        }
        Ok(Self {
            count: TorqueCount::new(largest, model)?,
            lag: Lag::new(observer.memory()),
            // So that half of its ticks is a whole number.
            window: window & !1,
            sums: Sums::default(),
        })
    }

    /// Adds a tick: the observed load, and the torque that moves one unit of payload. A torque that is NaN adds nothing.
    #[inline]
    pub fn update(&mut self, load: N::Torque, unit: N::Torque) {
        let (Some(load), Some(unit)) = (self.count.of(load), self.count.of(unit)) else {
            return;
        };
        let (load, unit) = (i64::from(load), self.lag.update(unit));
        let sums = &mut self.sums;
        sums.ticks += 1;
        sums.unit += unit;
        sums.load += load;
        // Below 2⁴² each, in at most 2²⁰ ticks.
        sums.unit_square += unit * unit;
        sums.load_square += load * load;
        sums.product += unit * load;
        if sums.ticks >= self.window {
            *sums = Sums {
                ticks: sums.ticks / 2,
                unit: sums.unit / 2,
                load: sums.load / 2,
                unit_square: sums.unit_square / 2,
                load_square: sums.load_square / 2,
                product: sums.product / 2,
            };
        }
    }

    /// Forgets all ticks: for a new payload.
    pub fn restart(&mut self) {
        self.sums = Sums::default();
    }

    /// The estimate so far.
    #[must_use]
    pub fn estimate(&self) -> PayloadEstimate {
        let sums = &self.sums;
        if sums.ticks < 32 {
            return PayloadEstimate::default();
        }
        let [unit, load] = [sums.unit, sums.load].map(|sum| sum as f32 / sums.ticks as f32);
        let of = |pair, product| covariance(sums.ticks, pair, product);
        let unit_variance = of([sums.unit; 2], sums.unit_square);
        let load_variance = of([sums.load; 2], sums.load_square);
        let covariance = of([sums.unit, sums.load], sums.product);
        let least = FULL / 1000.0;
        if unit_variance < least * least {
            return PayloadEstimate::default();
        }
        let payload = -covariance / unit_variance;
        let explained = if load_variance > 0.0 {
            (covariance / load_variance * (covariance / unit_variance)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        PayloadEstimate {
            payload,
            offset: self.count.si(load + payload * unit),
            explained,
            excited: true,
        }
    }
}

/// The lag of an [`Observer`]'s load: three first-order lags and the mean of two periods, (1 − θ)³·½·(1 + q)/(1 − θ·q)³.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Lag {
    /// 1 − θ in units of 2⁻³¹.
    gain: i64,
    /// In units of 2⁻⁸ counts.
    lags: [i64; 3],
}

impl Lag {
    fn new(memory: f32) -> Self {
        Self {
            gain: ((1.0 - memory) * 2_147_483_648.0) as i64,
            lags: [0; 3],
        }
    }

    /// For the count of this period.
    #[inline]
    fn update(&mut self, count: i32) -> i64 {
        let before = self.lags.last().copied().unwrap_or_default();
        let mut input = i64::from(count) << 8;
        for lag in &mut self.lags {
            // |input − lag| is below 2³⁰, the gain at most 2³¹.
            *lag += ((input - *lag) * self.gain + (1 << 30)) >> 31;
            input = *lag;
        }
        (input + before) >> 9
    }
}
