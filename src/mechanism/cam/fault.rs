//! Errors of cams.

use core::fmt;

use crate::number::error::{Curable, RangeError, error};

/// Why a cam program or a cam cannot be created. Segments count from 0 here, and from 1 in messages.
///
/// Displacements of a swinging follower are angles: read rad for m in messages about the program.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum CamError {
    /// A dimension outside its range, or too many segments.
    Range(RangeError),
    /// The program has no segment.
    Empty,
    /// A number of the segment is NaN or infinite.
    NotFinite {
        /// Index of the segment.
        segment: usize,
    },
    /// The angle of the segment is not greater than zero.
    Angle {
        /// Index of the segment.
        segment: usize,
        /// Its angle (rad).
        angle: f64,
    },
    /// A dwell with a rise.
    DwellRises {
        /// Index of the segment.
        segment: usize,
        /// Its rise.
        rise: f64,
    },
    /// The shares of the segment's trapezoid are impossible.
    Shares {
        /// Index of the segment.
        segment: usize,
    },
    /// The segments do not cover exactly one turn.
    NotOneTurn {
        /// Sum of their angles (rad).
        sum: f64,
    },
    /// The follower is not back at its start after the last segment.
    NotClosed {
        /// Index of the last segment that moves the follower.
        segment: usize,
        /// The sum of all rises (m, or rad).
        gap: f64,
    },
    /// The follower's velocity jumps at the end of the segment.
    VelocityJump {
        /// Index of the segment.
        segment: usize,
        /// Angle (rad).
        phi: f64,
        /// s′ at its end (m/rad, or rad/rad).
        from: f64,
        /// s′ at the start of the next segment.
        to: f64,
    },
    /// The roller's centre cannot be on the follower's path: the cam is too small for the guide's offset.
    Offset {
        /// Offset (m).
        offset: f64,
        /// The base radius must be larger than this (m).
        base_radius: f64,
    },
    /// The arm cannot keep the roller on the base circle.
    Arm {
        /// Distance of the arm's pivot from the cam's (m).
        pivot_distance: f64,
        /// Base radius + roller radius must be between these two (m).
        reach: [f64; 2],
    },
    /// The swinging face cannot lie on the base circle: its pivot is too close to the cam.
    Face {
        /// Distance of the pivot from the cam's (m).
        pivot_distance: f64,
        /// It must be larger than this (m).
        least: f64,
    },
    /// The swinging follower moves beyond the position where its arm and the line of the pivots are stretched or folded.
    Swing {
        /// Angle (rad).
        phi: f64,
    },
    /// The follower would reach down to the cam's axis.
    BelowAxis {
        /// Angle (rad).
        phi: f64,
    },
    /// Undercut: the roller or the face does not touch the cam where it should.
    Undercut {
        /// Angle of the worst place (rad).
        phi: f64,
        /// Radius of curvature there (m): of the pitch curve for a roller, of the profile for a flat face.
        radius: f64,
        /// The radius of curvature must be larger than this (m): the roller's radius, or zero.
        limit: f64,
        /// The smallest sufficient base radius (m); `None` if there is no such radius.
        base_radius: Option<f64>,
    },
    /// The cam is so large that it would cover the axis of its swinging follower.
    CoversPivot {
        /// Angle of the profile's farthest point from the cam's axis (rad).
        phi: f64,
        /// That distance (m).
        reach: f64,
        /// Distance of the two axes (m).
        pivot: f64,
    },
    /// A swinging face turns as fast as the cam, so that there is no single point of contact.
    FaceTooFast {
        /// Angle (rad).
        phi: f64,
        /// dψ/dφ of the face, which must be below 1.
        ratio: f64,
    },
}

error!(CamError, Range(RangeError));

impl fmt::Display for CamError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.segment() {
            Some(segment) => write!(f, "segment {}: {}", segment + 1, Cause(self)),
            None => Cause(self).fmt(f),
        }
    }
}

impl CamError {
    /// The segment at fault, if it is a single one.
    const fn segment(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { segment }
            | Self::Angle { segment, .. }
            | Self::DwellRises { segment, .. }
            | Self::Shares { segment }
            | Self::VelocityJump { segment, .. } => Some(segment),
            _ => None,
        }
    }
}

/// The error, without the segment.
struct Cause<'a>(&'a CamError);

impl fmt::Display for Cause<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use CamError as E;
        let deg = |phi: f64| phi.to_degrees();
        match *self.0 {
            E::Range(error) => error.fmt(f),
            E::Empty => f.write_str("the cam program has no segment"),
            E::NotFinite { .. } => f.write_str("a value is not a finite number"),
            E::Angle { angle, .. } => write!(
                f,
                "its angle is {:.6}°, but must be greater than zero",
                deg(angle)
            ),
            E::DwellRises { rise, .. } => write!(f, "a dwell cannot rise by {rise}"),
            E::Shares { .. } => f.write_str(
                "the shares of the trapezoid must be greater than zero and together at most 1",
            ),
            E::NotOneTurn { sum } => write!(
                f,
                "the segments cover {:.6}°, but must cover exactly one turn",
                deg(sum)
            ),
            E::NotClosed { gap, .. } => write!(
                f,
                "after a turn the follower is {gap:.3e} m off its start: the rises must add up to zero"
            ),
            E::VelocityJump { phi, from, to, .. } => write!(
                f,
                "the follower's velocity jumps at its end, φ = {:.2}°, from s′ = {from} to {to} m/rad",
                deg(phi)
            ),
            E::Offset { offset, .. } => write!(
                f,
                "the base radius is too small for the guide's offset of {offset} m"
            ),
            E::Arm {
                pivot_distance,
                reach,
            } => write!(
                f,
                "the arm cannot hold the roller on the base circle: with its pivot {pivot_distance} m from the cam's, base \
                 radius + roller radius must lie between {} m and {} m",
                reach[0], reach[1]
            ),
            E::Face {
                pivot_distance,
                least,
            } => write!(
                f,
                "the face cannot lie on the base circle: its pivot is {pivot_distance} m from the cam's, but must be \
                 farther than base radius + face offset = {least} m"
            ),
            E::Swing { phi } => write!(
                f,
                "the follower swings too far at φ = {:.2}°: beyond the line of the two pivots, or square to it",
                deg(phi)
            ),
            E::BelowAxis { phi } => write!(
                f,
                "the follower goes down to the cam's axis at φ = {:.2}°",
                deg(phi)
            ),
            E::Undercut {
                phi, radius, limit, ..
            } => write!(
                f,
                "undercut at φ = {:.2}°: the radius of curvature is {radius:.6} m, but must be larger than {limit} m",
                deg(phi)
            ),
            E::CoversPivot { phi, reach, pivot } => write!(
                f,
                "the cam reaches {reach:.6} m from its axis at φ = {:.2}° and so covers the follower's pivot, {pivot:.6} m \
                 away",
                deg(phi)
            ),
            E::FaceTooFast { phi, ratio } => write!(
                f,
                "the face turns {ratio:.3} times as fast as the cam at φ = {:.2}°, but must be slower than the cam",
                deg(phi)
            ),
        }
    }
}

impl Curable for CamError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match *self {
            Self::Range(error) => return error.write_cure(f),
            Self::Empty => "give rises, dwells and returns over one turn",
            Self::NotFinite { .. } => "give numbers that are neither NaN nor infinite",
            Self::Angle { .. } => "give it an angle, or leave it out",
            Self::DwellRises { .. } => "give it a motion law",
            Self::Shares { .. } => "make them smaller",
            Self::NotOneTurn { sum } => {
                let left = core::f64::consts::TAU - sum;
                let word = if left > 0.0 { "add" } else { "remove" };
                return write!(f, "{word} {:.6}°", left.abs().to_degrees());
            }
            Self::NotClosed { segment, gap } => {
                let segment = segment + 1;
                return write!(f, "change the rise of segment {segment} by {:.3e}", -gap);
            }
            Self::VelocityJump { .. } => "make both ends equal",
            Self::Offset { base_radius, .. } => {
                return write!(
                    f,
                    "make it larger than {base_radius} m, or reduce the offset"
                );
            }
            Self::Arm { .. } => "change the base radius, or move the pivot",
            Self::Face { .. } => "move the pivot outwards, or make the base radius smaller",
            Self::Swing { .. } => "reduce the rise or move the pivot",
            Self::BelowAxis { .. } => "make the base radius larger",
            Self::Undercut {
                base_radius: Some(least),
                ..
            } => return write!(f, "make the base radius larger than {least:.6} m"),
            Self::Undercut { .. } => {
                "no base radius cures it here: reduce the rise or give it a longer angle"
            }
            Self::CoversPivot { .. } => "make the base radius smaller or move the pivot outwards",
            Self::FaceTooFast { .. } => "reduce the rise or give it a longer angle",
        })
    }
}
