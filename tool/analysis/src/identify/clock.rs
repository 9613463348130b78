//! The uniform clock behind the times of a log, which a recorder may write late.

/// A time off the clock by more than this share of a step does not say which sample it is.
const CLEAR: f64 = 0.4;

/// Share of such times from which on the rows themselves are counted.
const UNCLEAR: f64 = 0.01;

/// The clock follows the times by this share of their distance from it.
const FOLLOW: f64 = 0.02;

/// Passes: each begins with the step of the one before.
const PASSES: usize = 3;

/// The largest distance of a counted row from its clock, in steps: a recorder that writes a few rows at once.
const LATE: f64 = 4.0;

/// A clock with equal steps.
pub(super) struct Clock {
    /// The step of each row.
    pub(super) places: Vec<usize>,
    /// Duration of a step (s).
    pub(super) step: f64,
    /// How late each row is by the clock (s), which follows a drift.
    pub(super) off: Vec<f64>,
    /// Number of rows whose step is not clear.
    unclear: usize,
}

impl Clock {
    /// Of times that do not fall, with missing samples; or, if too many times are off, of rows of which none is missing. `None` if neither fits.
    pub(super) fn new(time: &[f64]) -> Option<Self> {
        let mut steps: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
        steps.retain(|step| *step > 0.0);
        steps.sort_by(f64::total_cmp);
        let median = *steps.get(steps.len() / 2)?;
        // Without those across missing samples.
        steps.retain(|step| (0.5..1.5).contains(&(step / median)));
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        let mut clock = Self::followed(time, mean, false);
        for _ in 1..PASSES {
            clock = Self::followed(time, clock.step, false);
        }
        if clock.unclear as f64 <= UNCLEAR * time.len() as f64 {
            return Some(clock);
        }
        let span = time.last()? - time.first()?;
        let counted = Self::followed(time, span / (time.len() - 1) as f64, true);
        let late = counted
            .off
            .iter()
            .all(|off| off.abs() <= LATE * counted.step);
        late.then_some(counted)
    }

    /// The clock that begins with this step, and follows the times; `counted`: each row is a step.
    fn followed(time: &[f64], step: f64, counted: bool) -> Self {
        let mut now = time.first().copied().unwrap_or_default() - step;
        let (mut place, mut unclear) = (0usize, 0);
        let (mut places, mut off) = (Vec::new(), Vec::new());
        for (row, t) in time.iter().enumerate() {
            let steps = ((t - now) / step).round().max(1.0);
            let steps = if counted { 1.0 } else { steps };
            now += steps * step;
            place = place.saturating_add(if row == 0 { 0 } else { steps as usize });
            let late = t - now;
            let clear = late.abs() <= CLEAR * step;
            unclear += usize::from(!clear);
            if clear || counted {
                // To begin with the mean: the first time is no better than others.
                now += late * FOLLOW.max(1.0 / (row + 1) as f64);
            }
            places.push(place);
            off.push(late);
        }
        Self {
            step: slope(&places, time),
            places,
            off,
            unclear,
        }
    }

    /// The largest distance of a time from the clock (s).
    pub(super) fn scatter(&self) -> f64 {
        self.off.iter().fold(0.0, |most, off| most.max(off.abs()))
    }
}

/// The slope of the line through these points.
fn slope(places: &[usize], time: &[f64]) -> f64 {
    let count = places.len() as f64;
    let x0 = places.iter().map(|x| *x as f64).sum::<f64>() / count;
    let t0 = time.iter().sum::<f64>() / count;
    let both = places.iter().zip(time);
    let [xx, xt] = both.fold([0.0, 0.0], |[xx, xt], (x, t)| {
        let x = *x as f64 - x0;
        [xx + x * x, xt + x * (t - t0)]
    });
    xt / xx.max(f64::MIN_POSITIVE)
}
