//! Times on the host, in times of one sine with cosine of the same run.
#![allow(dead_code, reason = "every benchmark uses its own part")]

use std::hint::black_box;
use std::time::Instant;

use jred::Real;

use crate::support::{self, Verdict};

/// Each time is the best of so many runs.
pub(crate) const RUNS: u32 = 7;
/// Attempts before a ratio out of bounds counts.
const ATTEMPTS: u32 = 3;

/// The shortest time of several runs (s).
pub(crate) fn best(mut run: impl FnMut()) -> f64 {
    let mut shortest = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        run();
        shortest = shortest.min(start.elapsed().as_secs_f64());
    }
    shortest
}

/// Time of one sine with cosine (s): the reference.
pub(crate) fn sin_cos() -> f64 {
    let count = 20_000;
    let time = best(|| {
        for k in 0..count {
            black_box(Real::sin_cos(black_box(f64::from(k) * 1e-3)));
        }
    });
    time / f64::from(count)
}

/// Prints, and remembers what was out of bounds.
#[derive(Default)]
pub(crate) struct Report {
    failures: u32,
}

impl Report {
    /// How many figures were out of bounds.
    pub(crate) const fn failures(&self) -> u32 {
        self.failures
    }

    /// Prints a line whose figure has a ceiling in `ceilings.txt`: a time (s) in sines. It is measured again if it is above,
    /// at most twice: another program on the machine may have disturbed it. Returns the time and its sines.
    pub(crate) fn cost(
        &mut self,
        name: &str,
        mut measure: impl FnMut() -> f64,
        line: impl Fn(f64) -> String,
    ) -> [f64; 2] {
        let mut found = [0.0; 2];
        let mut verdict = Verdict::Missing;
        for _ in 0..ATTEMPTS {
            let time = measure();
            let sines = time / sin_cos();
            found = [time, sines];
            verdict = support::judge("host", name, sines);
            if matches!(verdict, Verdict::Within(_) | Verdict::Slack(_)) {
                break;
            }
        }
        let [time, sines] = found;
        println!("{name:26} {} {sines:9.0}  {verdict:?}", line(time));
        self.remember(name, verdict);
        found
    }

    /// Prints a line whose figure, a number of reductions, has a ceiling in `ceilings.txt`.
    pub(crate) fn count(&mut self, name: &str, count: u32, line: &str) {
        let verdict = support::judge("host", name, f64::from(count));
        println!("{name:26} {line} {count:9}  {verdict:?}");
        self.remember(name, verdict);
    }

    fn remember(&mut self, name: &str, verdict: Verdict) {
        if !matches!(verdict, Verdict::Within(_) | Verdict::Slack(_)) {
            println!("FAILED: {name} {verdict:?}");
            self.failures += 1;
        }
    }

    /// Measures a ratio that must lie in `[low, high]`.
    pub(crate) fn band(
        &mut self,
        what: &str,
        [low, high]: [f64; 2],
        mut measure: impl FnMut() -> f64,
    ) {
        let mut found = measure();
        for _ in 1..ATTEMPTS {
            if found >= low && found <= high {
                break;
            }
            found = measure();
        }
        println!("{what}: {found:.2}, allowed {low} to {high}");
        if !(found >= low && found <= high) {
            println!("FAILED: {what}");
            self.failures += 1;
        }
    }
}
