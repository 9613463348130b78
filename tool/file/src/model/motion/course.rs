//! Figures of a motion's segments: largest speed, acceleration and jerk, and the characteristic values of VDI 2143.

use std::convert::Infallible;

use crate::number::numerics;

use super::Motion;
use super::piece::MotionPiece;

/// Places of a smooth piece, and of a recorded one, at which the largest value is searched before it is refined.
const PLACES: u32 = 200;
const RECORDED: u32 = 10_000;

/// Share of the motion's largest acceleration below which a change from one piece to the next is rounding.
const CONTINUOUS: f64 = 1e-6;

/// The same as a share of the largest speed over the shortest piece: rounding of a polynomial without acceleration.
const ROUNDING: f64 = 1e-12;

/// One segment of a motion, in the prescribed coordinate: of the tool or of the drive link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentCourse {
    /// Its index, from 0.
    pub segment: usize,
    /// Whether it prescribes the drive link.
    pub of_drive: bool,
    /// Duration (s).
    pub duration: f64,
    /// Distance (rad, or m).
    pub distance: f64,
    /// Largest speed (per s).
    pub speed: f64,
    /// Largest acceleration (per s²).
    pub acceleration: f64,
    /// Largest jerk (per s³); `None` if the acceleration jumps, inside the segment or at its ends.
    pub jerk: Option<f64>,
    /// Largest product of speed and acceleration (per s³), to which the power of a constant inertia is proportional.
    pub dynamic: f64,
}

impl SegmentCourse {
    /// [C_v, C_a, C_j, C_Mdyn]: its values for a distance of one in a time of one; `None` for a dwell.
    pub fn coefficients(&self) -> Option<[Option<f64>; 4]> {
        let (h, t) = (self.distance.abs(), self.duration);
        (h > 0.0).then(|| {
            [
                Some(self.speed * t / h),
                Some(self.acceleration * t * t / h),
                self.jerk.map(|jerk| jerk * t.powi(3) / h),
                Some(self.dynamic * t.powi(3) / (h * h)),
            ]
        })
    }
}

impl Motion {
    /// The segments in order; a motion without segments is one.
    pub fn courses(&self) -> Vec<SegmentCourse> {
        let mut courses = Vec::new();
        for pieces in self.pieces.chunk_by(|a, b| a.segment == b.segment) {
            let [Some(first), Some(last)] = [pieces.first(), pieces.last()] else {
                continue;
            };
            let course = SegmentCourse {
                segment: first.segment,
                of_drive: first.of_drive || self.tool.is_none(),
                duration: last.end() - first.start,
                distance: last.at(last.duration).phi - first.at(0.0).phi,
                speed: 0.0,
                acceleration: 0.0,
                jerk: Some(0.0),
                dynamic: 0.0,
            };
            courses.push(pieces.iter().fold(course, with_piece));
        }
        let same = [false, true].map(|of_drive| self.same_acceleration(&courses, of_drive));
        for course in &mut courses {
            if self.acceleration_jumps(course.segment, same) {
                course.jerk = None;
            }
        }
        courses
    }

    /// Difference below which two accelerations are equal: of the drive link, or of the prescribed coordinate. It scales with the whole motion,
    /// because a segment of constant speed has no scale of its own.
    fn same_acceleration(&self, courses: &[SegmentCourse], of_drive: bool) -> f64 {
        let most = |value: fn(&SegmentCourse) -> f64| {
            let own = courses.iter().filter(|course| {
                let prescribes = course.of_drive && self.tool.is_some();
                prescribes == of_drive
            });
            own.map(value).fold(0.0, f64::max)
        };
        let own = self.pieces.iter().filter(|p| p.of_drive == of_drive);
        let shortest = own
            .map(|piece| piece.duration)
            .fold(f64::INFINITY, f64::min);
        CONTINUOUS * most(|course| course.acceleration)
            + ROUNDING * most(|course| course.speed) / shortest
    }

    /// The drive link's largest speed and acceleration (per s, s²).
    pub fn drive_peaks(&self) -> [f64; 2] {
        let mut peaks = [0.0_f64; 2];
        for piece in &self.pieces {
            let places = if piece.is_recorded() {
                RECORDED
            } else {
                PLACES
            };
            // The end of a piece belongs to the next one.
            let range = [piece.start, piece.end().next_down().max(piece.start)];
            let speed = |t: f64| self.at(t).omega;
            let acceleration = |t: f64| self.at(t).alpha;
            peaks[0] = peaks[0].max(largest(&speed, range, places));
            peaks[1] = peaks[1].max(largest(&acceleration, range, places));
        }
        peaks
    }

    /// Whether the acceleration jumps within segment number `index`, or at its borders to neighbours or rest, by more than `same` of the prescribed
    /// coordinate and of the drive link.
    fn acceleration_jumps(&self, index: usize, same: [f64; 2]) -> bool {
        let count = self.pieces.len();
        let ends = |piece: &MotionPiece, end: bool| {
            let t = if end { piece.duration } else { 0.0 };
            piece.at(t).alpha
        };
        self.pieces.iter().enumerate().any(|(k, piece)| {
            let neighbour = |other: Option<usize>, end: bool| {
                // Before and after a motion that does not repeat it is at rest.
                let other = other.and_then(|k| self.pieces.get(k));
                // Tool and drive link have different accelerations; a join takes over the existing one.
                let compared = other.is_none_or(|other| other.of_drive == piece.of_drive);
                let beyond = other.map_or(0.0, |other| ends(other, end));
                let same = same[usize::from(piece.of_drive)];
                compared && (beyond - ends(piece, !end)).abs() > same
            };
            let round = |k: usize| self.cyclic.then_some(k);
            let before = k.checked_sub(1).or_else(|| round(count - 1));
            let after = if k + 1 < count { Some(k + 1) } else { round(0) };
            piece.segment == index && (neighbour(before, true) || neighbour(after, false))
        })
    }
}

/// The course updated with the largest values of one more piece.
fn with_piece(course: SegmentCourse, piece: &MotionPiece) -> SegmentCourse {
    let places = if piece.is_recorded() {
        RECORDED
    } else {
        PLACES
    };
    let most = |f: &dyn Fn(f64) -> f64| largest(f, [0.0, piece.duration], places);
    let jerk = |t: f64| piece.jerk(t).unwrap_or(0.0);
    SegmentCourse {
        speed: course.speed.max(most(&|t| piece.at(t).omega)),
        acceleration: course.acceleration.max(most(&|t| piece.at(t).alpha)),
        jerk: course
            .jerk
            .filter(|_| piece.jerk(0.0).is_some())
            .map(|before| before.max(most(&jerk))),
        dynamic: course.dynamic.max(most(&|t| {
            let state = piece.at(t);
            state.omega * state.alpha
        })),
        ..course
    }
}

/// The largest magnitude of `f` in a range.
fn largest(f: &dyn Fn(f64) -> f64, [from, to]: [f64; 2], places: u32) -> f64 {
    let place = |k: u32| from + (to - from) * f64::from(k) / f64::from(places);
    let mut best = (0.0, 0);
    for k in 0..=places {
        let size = f(place(k)).abs();
        if size > best.0 {
            best = (size, k);
        }
    }
    let [low, high] = [best.1.saturating_sub(1), (best.1 + 1).min(places)].map(place);
    let Ok(t) = numerics::least(|t| Ok::<_, Infallible>(-f(t).abs()), low, high);
    best.0.max(f(t).abs())
}
