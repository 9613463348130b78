//! Times at which a part of a machine acts, and the instants that are compared with them.

use crate::number::rounding::figure;

/// A direction of the drive link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Travel {
    /// φ grows.
    Forward,
    /// φ falls.
    Backward,
}

/// Times at which a part of the machine acts or is present.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct When {
    /// Times [from, to) of the motion (s), the last up to its end; `None`: always.
    pub spans: Option<Vec<[f64; 2]>>,
    /// Whether the file names segments for these times.
    pub by_segment: bool,
    /// Only in this direction of travel.
    pub travel: Option<Travel>,
}

impl When {
    /// The times of segments, for example `from 0.3 s to 0.5 s and from 1 s to 1.2 s`; `None` if the file gives times directly, or no times.
    pub fn times_in_words(&self) -> Option<String> {
        let spans = self.spans.as_ref().filter(|_| self.by_segment)?;
        let spans = spans.iter();
        let words =
            spans.map(|[from, to]| format!("from {} s to {} s", figure(*from), figure(*to)));
        Some(words.collect::<Vec<_>>().join(" and "))
    }

    /// Whether the instant is included, in a motion that lasts until `end`: by its time, if there is one, and by the speed ω, if known.
    pub fn holds(&self, now: &ScheduleInstant, end: f64) -> bool {
        let in_time = self.spans.as_ref().is_none_or(|spans| {
            now.t.is_some_and(|t| {
                let within = |[from, to]: &[f64; 2]| *from <= t && (t < *to || *to >= end);
                spans.iter().any(within)
            })
        });
        let ways = self.travel.is_none_or(|travel| {
            let way = now.starts.or(now.moves).or(now.omega);
            way.is_some_and(|way| match travel {
                Travel::Forward => way > 0.0,
                Travel::Backward => way < 0.0,
            })
        });
        in_time && ways
    }
}

/// An instant: a time of the motion (s) and a speed of the drive link, if known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScheduleInstant {
    /// Time of the motion (s).
    pub t: Option<f64>,
    /// Speed of the drive link (rad/s, or m/s).
    pub omega: Option<f64>,
    /// At rest, at the start of a move: its direction, as a sign.
    pub starts: Option<f64>,
    /// In motion: its direction, as a sign, where the speed is zero for an instant.
    pub moves: Option<f64>,
}

impl ScheduleInstant {
    /// A time of the motion, with the speed there.
    pub const fn of(t: f64, omega: f64) -> Self {
        Self {
            t: Some(t),
            omega: Some(omega),
            starts: None,
            moves: None,
        }
    }

    /// A time of the motion, in motion in this direction with the speed there, which may be zero for an instant.
    pub const fn moving(t: f64, omega: f64, direction: f64) -> Self {
        Self {
            moves: Some(direction),
            ..Self::of(t, omega)
        }
    }

    /// A time of the motion at which a move in this direction begins from rest.
    pub const fn starting(t: f64, direction: f64) -> Self {
        Self {
            starts: Some(direction),
            ..Self::of(t, 0.0)
        }
    }

    /// Whether the drive link is known to be at rest.
    pub fn is_at_rest(&self) -> bool {
        self.omega == Some(0.0) && self.moves.is_none()
    }
}
